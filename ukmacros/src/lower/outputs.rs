//! Outputs and integrals.

use super::constraints::Names;
use super::units::Measured;
use super::{Env, Lowering, NoValue, Place};
use crate::model::Scope;
use crate::parse::{Block, Entry, Measure};
use proc_macro2::Ident;
use std::collections::BTreeMap;
use ukalgebra::expr::Id;
use ukalgebra::expr::OutputValue;

impl<'m> Lowering<'m> {
    /// The `value` of an output in the unit that it is declared with.
    fn in_unit(&mut self, output: &Entry, result: NoValue, value: Id) -> Id {
        let Some(Measure { unit, .. }) = &output.key.measure else {
            return value;
        };
        let of = Measured::known(unit.dimension(), true);
        let what = match unit.to_string().as_str() {
            "" => "as `[-]` says".to_owned(),
            text => format!("as `[{text}]` says"),
        };
        let loc = output.value.loc;
        match result {
            NoValue::Integral => self.expect_rate(value, of, &what, loc),
            _ => self.expect(value, of, &what, loc),
        }
        match unit.is_coherent() {
            true => value,
            false => self.graph.scale(unit.from_si(1.0), value),
        }
    }

    /// Outputs or integrals.
    pub(super) fn reported(
        &mut self,
        blocks: &[Block<Entry>],
        result: NoValue,
        top: &Scope<'m>,
        names: &mut Names,
    ) -> Vec<OutputValue> {
        let mut out: Vec<OutputValue> = Vec::new();
        // How often each name is declared, and where an index of it is called like a unit.
        let mut declared: BTreeMap<Ident, (usize, Option<Ident>)> = BTreeMap::new();
        let (what, place) = match result {
            NoValue::Integral => ("integral", Place::Integral),
            _ => ("output", Place::Output),
        };
        top.unroll(blocks, self.diag, &mut |output, scope| {
            let key = &output.key;
            let Some(mut item) = self.item(key, scope) else {
                return;
            };
            let (members, hidden) = declared.entry(key.name.clone()).or_default();
            *members += 1;
            if let [index] = &key.indices[..] {
                *hidden = self.hidden_unit(index, scope).cloned();
            }
            let looped = !scope.variables.is_empty();
            let free = self.model.column(&key.name);
            if let Err(reason) = free.and_then(|()| names.enter(what, &item, looped)) {
                self.diag.error(key.loc, reason);
                return;
            }
            let value = self.value(&output.value, &Env::new(scope, place));
            for (components, value) in self.components(&value) {
                let value = self.in_unit(output, result, value);
                item.components = components;
                let text = item.text();
                let coordinates = &self.model.coord_elements;
                if coordinates.iter().any(|c| c.name == text) {
                    self.diag.error(
                        key.loc,
                        format!(
                            "`{text}` is a coordinate and in the output anyway; choose another name"
                        ),
                    );
                    return;
                }
                out.push(OutputValue {
                    item: item.clone(),
                    docs: output.docs.clone(),
                    unit: key.measure.as_ref().map(|m| m.unit.to_string()),
                    value,
                    loaded: self.graph.uses(value).multiplier,
                });
            }
        });
        for (name, of) in declared {
            if let (1, Some(unit)) = of {
                let message = format!(
                    "`{name}[{unit}]` is one member of a family: `{unit}` is the constant here, and no unit; rename the constant"
                );
                self.diag.error(unit.span(), message);
            }
        }
        out
    }
}
