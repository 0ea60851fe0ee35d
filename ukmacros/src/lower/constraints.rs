//! Constraints: equations and joints as rows, and what they, outputs and integrals are called.

use super::array::Value;
use super::parts::PARTS;
use super::{Env, Lowering, Place};
use crate::model::{Scope, every};
use crate::parse::{Equation, Expr, ExprKind, Key};
use proc_macro2::Ident;
use std::collections::{HashMap, HashSet};
use ukalgebra::expr::Id;
use ukalgebra::expr::{Constraint, ConstraintRef, Kind};

/// Names of constraints or outputs declared so far.
#[derive(Default)]
pub(super) struct Names {
    items: HashSet<String>,
    /// Whether a base is indexed: `rod` and `rod[0]` are not both declared, so that `T::ROD` has one meaning.
    indexed: HashMap<String, bool>,
}

impl Names {
    /// Enters a name; the reason if it is taken. `what` it names and whether it is `looped` go into the reason.
    pub(super) fn enter(
        &mut self,
        what: &str,
        item: &ConstraintRef,
        looped: bool,
    ) -> Result<(), String> {
        let (base, text) = (item.base.to_string(), item.text());
        let indexed = !item.indices.is_empty();
        if *self.indexed.entry(base.clone()).or_insert(indexed) != indexed {
            return Err(format!(
                "{what} `{base}` is declared both with and without an index; rename one"
            ));
        }
        if self.items.insert(text.clone()) {
            return Ok(());
        }
        Err(if looped && !indexed {
            format!("{what} `{base}` is declared twice; in a loop, index it: `{base}[i]`")
        } else {
            format!("{what} `{text}` is declared twice; names must be unique")
        })
    }
}

impl<'m> Lowering<'m> {
    /// Whether nothing is declared under `name`; the reason if something is.
    pub(super) fn free(&self, name: &Ident) -> Result<(), String> {
        self.model.free(name)?;
        match self.lets.contains_key(&name.to_string()) {
            true => Err(format!("`{name}` is declared twice; names must be unique")),
            false => Ok(()),
        }
    }

    /// What `key` calls an equation, output or integral, whole.
    pub(super) fn item(&mut self, key: &Key, scope: &Scope<'m>) -> Option<ConstraintRef> {
        Some(ConstraintRef {
            base: key.name.clone(),
            shown: self.model.shown(&key.name.to_string()).to_owned(),
            indices: self.indices(&key.indices, scope)?,
            components: Vec::new(),
            row: None,
        })
    }

    /// The constraints that an equation is, as many as it has components.
    pub(super) fn equation(
        &mut self,
        equation: &Equation,
        kind: Kind,
        scope: &Scope<'m>,
        names: &mut Names,
    ) {
        let key = &equation.key;
        let Some(mut item) = self.item(key, scope) else {
            return;
        };
        let looped = !scope.variables.is_empty();
        let free = self.free(&key.name);
        if let Err(reason) = free.and_then(|()| names.enter("constraint", &item, looped)) {
            self.diag.error(key.loc, reason);
            return;
        }
        let place = match kind {
            Kind::Holonomic => Place::Holonomic,
            Kind::Nonholonomic => Place::Nonholonomic,
        };
        let env = Env::new(scope, place);
        let before = self.diag.len();
        let (mut terms, mut rows, mut load) = (Vec::new(), Vec::new(), None);
        let mut joint = None;
        let mut known = true;
        match &equation.lhs.kind {
            ExprKind::Call(..) => {
                let value = self.argument(&equation.lhs, &env);
                known = !value.is_error();
                if let Value::Joint(whole) = &value {
                    rows.clone_from(&whole.names);
                    load.clone_from(&whole.load);
                    // With a right side it is compared with what is in axes of the ground.
                    joint = Some(whole.clone()).filter(|_| equation.rhs.is_none());
                }
                let value = self.numbers(value, equation.lhs.loc);
                self.term(&equation.lhs, value, 1.0, &mut terms);
            }
            _ => self.chain(&equation.lhs, 1.0, &env, &mut terms),
        }
        let left = terms.len();
        match &equation.rhs {
            Some(rhs) => self.chain(rhs, -1.0, &env, &mut terms),
            None if !known || self.is_joint(&equation.lhs) => {}
            None => self
                .diag
                .error(equation.lhs.loc, "a constraint is an equation: `lhs = rhs`"),
        }
        // A slip on both sides, such as a velocity under `holonomic`, is one.
        self.diag.distinct(before);
        let clash = self.dimensions.is_some() && {
            let (left, right) = terms.split_at(left);
            self.sides_clash(left, right)
        };
        let total = match clash {
            true => Value::Error,
            false => self.total(&terms, true),
        };
        let (total, ground) = match joint.as_ref().and_then(|joint| joint.carried.as_ref()) {
            Some(carried) => {
                if let Some(load) = &mut load {
                    load.turn(carried.axes.clone());
                }
                let ground = total.entries().to_vec();
                (Value::new(total.shape(), carried.rows.clone()), ground)
            }
            None => (total, Vec::new()),
        };
        let (first, whole) = (self.constraints.len(), item.text());
        for (k, (components, phi)) in self.components(&total).into_iter().enumerate() {
            item.components = components;
            item.row = rows.get(k).copied();
            self.constraints.push(Constraint {
                item: item.clone(),
                kind,
                phi,
                loc: key.loc,
            });
            self.measure_row(phi, kind);
        }
        // What is in error has no reaction that could be judged.
        if !total.is_error() {
            self.know(whole, first, total.shape(), rows, load, ground);
        }
    }

    /// Whether `e` applies a joint, or a function of the declaration, which may be one.
    fn is_joint(&self, e: &Expr) -> bool {
        let ExprKind::Call(name, _) = &e.kind else {
            return matches!(e.kind, ExprKind::Error);
        };
        let joint = PARTS.iter().any(|part| name == part.name);
        joint || self.is_function(&name.to_string())
    }

    /// The numbers that a value consists of, with their indices in it. The name of a faulty one stays declared, as zero: what uses it gives
    /// no second message.
    pub(super) fn components(&mut self, value: &Value) -> Vec<(Vec<usize>, Id)> {
        let numbers = match value {
            Value::Error => vec![self.graph.zero()],
            _ => value.entries().to_vec(),
        };
        every(value.shape()).zip(numbers).collect()
    }
}
