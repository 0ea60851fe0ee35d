//! What is declared by `const`, `params` and `let`.

use super::array::{Value, describe};
use super::{Binding, Env, Lowering, Place};
use crate::diag::Loc;
use crate::model::{Preset, Scope, every};
use crate::parse::{Declaration, Expr, Function, Given, Let, LetValue};
use std::collections::BTreeMap;
use std::rc::Rc;
use ukalgebra::expr::Id;
use ukalgebra::expr::indexed;
use ukalgebra::expr::{Point, eval};

impl<'m> Lowering<'m> {
    /// Values of the `f64` constants.
    pub(super) fn constants(&mut self, top: &Scope<'m>) -> Vec<f64> {
        let mut values = Vec::new();
        for constant in &self.model.floats {
            let what = format!("constant `{}`", constant.name);
            let (id, value) = self.fixed(&constant.value, &what, top, Place::Const);
            self.floats.push(id);
            values.push(value);
        }
        values
    }

    /// The number that `e` is, known at compile time; reports `what` it is of if it is not finite.
    pub(super) fn fixed(
        &mut self,
        e: &Expr,
        what: &str,
        top: &Scope<'m>,
        place: Place,
    ) -> (Id, f64) {
        let before = self.diag.len();
        let id = self.scalar(e, &Env::new(top, place));
        let value = eval(&self.graph, &[id], &Point::NOWHERE)[0];
        if self.diag.len() == before {
            self.finite_number(what, value, e.loc);
        }
        (id, value)
    }

    /// Reports `what` if its `value` is not finite. Where dimensions are looked at, symbols stand for values.
    pub(super) fn finite_number(&self, what: &str, value: f64, loc: Loc) {
        if !value.is_finite() && self.dimensions.is_none() {
            self.diag
                .error(loc, format!("{what} is not a finite number"));
        }
    }

    /// Enters the values of the parameters' defaults, each of which may use those before it.
    pub(super) fn enter_defaults(&mut self) {
        // The default that the one before had, and the numbers of it that are left.
        let mut shared: Option<(&Rc<Preset>, std::vec::IntoIter<f64>)> = None;
        for element in &self.model.param_elements {
            let Some(preset) = &element.default else {
                self.defaults.push(f64::NAN);
                continue;
            };
            let same = shared.take().filter(|(last, _)| Rc::ptr_eq(last, preset));
            let mut rest = match same {
                Some((_, rest)) => rest,
                None => self.preset(preset, &element.name).into_iter(),
            };
            self.defaults.push(rest.next().unwrap_or(f64::NAN));
            shared = Some((preset, rest));
        }
    }

    /// The numbers that a default gives to all that is declared with it, of which the first is `name`.
    fn preset(&mut self, preset: &Preset, name: &str) -> Vec<f64> {
        let count = preset.shape.iter().product();
        let (scope, loc) = (
            Scope::with(self.model, preset.variables.clone()),
            preset.value.loc,
        );
        let value = self.value(&preset.value, &Env::new(&scope, Place::Default));
        let ids: Vec<Id> = match &value {
            Value::Scalar(id) => vec![*id; count],
            Value::Error => Vec::new(),
            _ if value.shape() == preset.shape => value.entries().to_vec(),
            _ => {
                let mut expected = describe(&[]);
                if !preset.shape.is_empty() {
                    expected += &format!(" or {}", describe(&preset.shape));
                }
                let found = describe(value.shape());
                self.diag
                    .error(loc, format!("expected {expected}, found {found}"));
                Vec::new()
            }
        };
        self.measure_parameters(&ids, count);
        let numbers = eval(&self.graph, &ids, &Point::of_parameters(&self.defaults));
        if let Some(wrong) = numbers.iter().find(|x| !x.is_finite()) {
            self.finite_number(&format!("default of `{name}`"), *wrong, loc);
        }
        numbers
    }

    pub(super) fn lower_lets(&mut self, decl: &Declaration, top: &Scope<'m>) {
        for block in &decl.lets {
            let before = self.diag.len();
            top.unroll(
                std::slice::from_ref(block),
                self.diag,
                &mut |binding, scope| {
                    self.binding(binding, scope);
                },
            );
            self.unfinished.clear();
            if self.diag.len() > before {
                // What is not declared because of an error is not unknown.
                block.each(&mut |binding| {
                    let name = binding.key.name.to_string();
                    if !self.lets.contains_key(&name) {
                        self.unknown.insert(name);
                    }
                });
            }
        }
    }

    fn binding(&mut self, binding: &Let, scope: &Scope<'m>) {
        let key = &binding.key;
        let name = key.name.to_string();
        let Some(indices) = self.indices(&key.indices, scope) else {
            return;
        };
        if let LetValue::Function(f) = &binding.value {
            let again = |k: &usize| f.args[..*k].contains(&f.args[*k]);
            if let Some(k) = (0..f.args.len()).find(again) {
                let arg = &f.args[k];
                self.diag.error(
                    arg.span(),
                    format!("argument `{arg}` is declared twice; names must be unique"),
                );
            }
        }
        let taken = match (self.model.free(&key.name), self.lets.get(&name)) {
            (Err(reason), _) => Some(reason),
            (Ok(()), None) => None,
            (Ok(()), Some(Binding::Family(members)))
                if !indices.is_empty() && !members.contains_key(&indices) =>
            {
                // All members have as many indices as the first.
                let first = members.keys().next();
                let other = first.is_some_and(|first| first.len() != indices.len());
                other.then(|| {
                    format!("`{name}` is declared with different numbers of indices; rename one")
                })
            }
            _ => Some(format!("`{name}` is declared twice; names must be unique")),
        };
        if let Some(reason) = taken {
            self.diag.error(key.loc, reason);
            return;
        }
        match &binding.value {
            LetValue::Function(f) if indices.is_empty() => {
                let (args, body) = (f.args.clone(), f.body.clone());
                let function = Binding::Function(Rc::new(Function { args, body }));
                self.lets.insert(name, function);
            }
            LetValue::Function(f) => self.diag.error(
                f.body.loc,
                "a function cannot be indexed; pass the index as an argument",
            ),
            LetValue::Value(e) => {
                let value = match &binding.given {
                    Some(given) => self.given(&name, e, given, scope),
                    None => self.argument(e, &Env::new(scope, Place::Let)),
                };
                let shown = indexed(self.model.shown(&name), &indices);
                self.hint(&shown, &value);
                if indices.is_empty() {
                    self.lets.insert(name, Binding::Value(value));
                    return;
                }
                self.unfinished.insert(name.clone());
                let family = Binding::Family(BTreeMap::new());
                if let Binding::Family(members) = self.lets.entry(name).or_insert(family) {
                    members.insert(indices, value);
                }
            }
        }
    }

    /// What is given to a part for a parameter of these sizes: numbers for all of it, or one.
    fn given(&mut self, name: &str, e: &Expr, given: &Given, scope: &Scope<'m>) -> Value {
        let value = self.value(e, &Env::new(scope, Place::Given));
        if self.dimensions.is_some() {
            let default = self.value(&given.default, &Env::new(scope, Place::Given));
            self.fits(&value, &default, e.loc);
        }
        let sizes = given.sizes.iter().map(|size| {
            let n = scope.integer(size, self.diag)?;
            usize::try_from(n).ok()
        });
        let Some(shape) = sizes.collect::<Option<Vec<usize>>>() else {
            return Value::Error;
        };
        match value {
            Value::Scalar(id) if !shape.is_empty() => {
                Value::new(&shape, vec![id; shape.iter().product()])
            }
            Value::Array(_) if shape.is_empty() => {
                let name = self.model.shown(name).rsplit('.').next().unwrap_or(name);
                let found = describe(value.shape());
                let message = format!(
                    "`{name}` is a number, found {found}; a value for each part is given in a loop: `for i in 0..2 {{ leg[i]: Leg {{ l: v[i] }} }}`"
                );
                self.error(e.loc, message)
            }
            value => match self.of_shape(&value, &shape, e.loc) {
                Some(entries) => Value::new(&shape, entries),
                None => Value::Error,
            },
        }
    }

    /// Remembers the modeller's name of a value, for emitted code and printed equations.
    pub(super) fn hint(&mut self, name: &str, value: &Value) {
        let mut enter = |id: Id, name: String| {
            let (c, inner) = self.graph.unscaled(id);
            // The graph keeps coefficients apart: a name must not pass to a value without its coefficient.
            let (id, name) = match c {
                1.0 => (id, name),
                -1.0 => (inner, format!("neg_{name}")),
                _ => return,
            };
            if !self.graph.operands(id).is_empty() {
                self.hints.entry(id).or_insert(name);
            }
        };
        for (id, indices) in value.entries().iter().zip(every(value.shape())) {
            enter(*id, indexed(name, &indices));
        }
    }
}
