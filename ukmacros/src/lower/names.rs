//! Names, members, and what may stand where.

use super::array::{MAX_ENTRIES, Value, describe};
use super::bodies::Frame;
use super::{Binding, Env, Lowering, NoValue, Place};
use crate::diag::{Diagnostics, Loc, suggest};
use crate::model::{Family, Name, Reported, Scope};
use crate::parse::{Expr, Key};
use proc_macro2::Ident;
use std::collections::BTreeMap;
use ukalgebra::expr::indexed;
use ukalgebra::expr::{Id, Symbol};

/// What is written before and behind the name of a coordinate elsewhere for its velocity.
const RATES: [[&str; 2]; 5] = [["", "_dot"], ["", "dot"], ["v_", ""], ["v", ""], ["d", ""]];

impl<'m> Lowering<'m> {
    /// What `name` stands for; of a family or vector the member or part that `indices` choose.
    pub(super) fn name(&mut self, name: &Ident, indices: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        let shown = format!("`{text}`");
        let argument = env.args.iter().rev().find(|(n, _)| *n == text);
        let value = match (argument, env.scope.lookup(&text)) {
            (Some((_, value)), _) => value.clone(),
            #[allow(
                clippy::cast_precision_loss,
                reason = "an integer in a formula is a number"
            )]
            (None, Some(i)) => Value::Scalar(self.graph.constant(i as f64)),
            (None, None) if text == "t" => self.allowed(Symbol::Time, name.span(), env),
            (None, None) if text == "PI" => {
                Value::Scalar(self.graph.constant(std::f64::consts::PI))
            }
            _ => return self.declared(name, indices, env),
        };
        self.part(value, &shown, indices, env)
    }

    /// What is declared under `name`, or its part.
    fn declared(&mut self, name: &Ident, indices: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        match self.model.names.get(&text) {
            Some(Name::Body(f)) => self.body(name, *f, indices, env),
            Some(Name::Part) => {
                let message = format!(
                    "`{text}` is a part; choose what belongs to it, `{text}.name`, or of a family `{text}[0].name`"
                );
                self.error(name.span(), message)
            }
            Some(Name::Joint) => {
                let message = format!(
                    "`{text}` is a joint of the tree; {}",
                    self.its_coordinates(&text)
                );
                self.error(name.span(), message)
            }
            Some(Name::Param(f)) => {
                self.members(name, indices, &self.model.params[*f], Symbol::Param, env)
            }
            Some(Name::Coord(f)) => {
                self.members(name, indices, &self.model.coords[*f], Symbol::Coord, env)
            }
            Some(Name::Float(i)) => match self.floats.get(*i) {
                Some(id) => self.part(Value::Scalar(*id), &format!("`{text}`"), indices, env),
                None => self.error(
                    name.span(),
                    format!("`{text}` is declared further down; move its declaration up"),
                ),
            },
            Some(Name::Integer) | None => match self.lets.get(&text) {
                Some(Binding::Value(value)) => {
                    let value = value.clone();
                    let part = self.part(value, &format!("`{text}`"), indices, env);
                    self.allowed_value(part, name.span().into(), env)
                }
                Some(Binding::Family(_)) => {
                    let part = self.of_family(name, indices, env);
                    self.allowed_value(part, name.span().into(), env)
                }
                Some(Binding::Function(_)) => self.error(
                    name.span(),
                    format!("`{text}` is a function; call it: `{text}(…)`"),
                ),
                None if text == "ground" && indices.is_empty() => Value::Body(Frame::ground()),
                None => self.unknown(name, env),
            },
        }
    }

    /// The part of `value`, called `name`, that `indices` choose.
    pub(super) fn part(
        &mut self,
        value: Value,
        name: &str,
        indices: &[Expr],
        env: &Env<'m>,
    ) -> Value {
        if indices.is_empty() || value.is_error() {
            return value;
        }
        let shape = value.shape();
        if let Some(surplus) = indices.get(shape.len()) {
            let message = match (shape.len(), self.hidden_unit(surplus, &env.scope)) {
                (_, Some(unit)) => {
                    format!("`{unit}` is the constant here, and no unit; rename the constant")
                }
                (0, None) => format!("{name} is a number; write it without an index"),
                (n, None) => format!(
                    "{name} is {}; it takes no index beyond {n}",
                    describe(shape)
                ),
            };
            return self.error(surplus.loc, message);
        }
        let Some(chosen) = self.indices(indices, &env.scope) else {
            return Value::Error;
        };
        value.block(&chosen).unwrap_or_else(|wrong| {
            let (index, size) = (chosen[wrong], shape[wrong]);
            let what = match shape.len() {
                1 => format!("{name} has {size} components"),
                _ => format!("{name} is {}", describe(shape)),
            };
            let message = format!("index {index} is out of range: {what}");
            self.error(indices[wrong].loc, message)
        })
    }

    /// Members of a family of values declared by `let`.
    fn of_family(&mut self, name: &Ident, indices: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        let Some(chosen) = self.indices(indices, &env.scope) else {
            return Value::Error;
        };
        let Some(Binding::Family(members)) = self.lets.get(&text) else {
            return Value::Error;
        };
        // The loop that declares it ended at an error.
        let broken = || members.values().any(Value::is_error);
        let own = members.keys().next().map_or(0, Vec::len);
        if chosen.len() >= own {
            let (chosen, rest) = (&chosen[..own], &indices[own..]);
            let shown = format!("`{}`", indexed(&text, chosen));
            return match members.get(chosen).cloned() {
                Some(value) => self.part(value, &shown, rest, env),
                None if broken() => Value::Error,
                None => self.error(
                    indices[own - 1].loc,
                    format!("{shown} is not declared (yet)"),
                ),
            };
        }
        if broken() {
            return Value::Error;
        }
        let entries = Value::count(below(members, &chosen).map(|(_, value)| value));
        if entries > MAX_ENTRIES {
            return self.too_long("array", entries, name.span().into());
        }
        let whole = together(members, &chosen, own, self.graph.zero());
        let shown = indexed(&text, &chosen);
        match whole {
            _ if self.unfinished.contains(&text) => self.error(
                name.span(),
                format!("`{shown}` is a family whose members are still being declared; index it: `{text}[i]`"),
            ),
            Some(value) => value,
            None => self.error(
                name.span(),
                format!("`{shown}` is no vector: its members are not of one shape with indices 0, 1, 2, …; index it: `{text}[i]`"),
            ),
        }
    }

    fn unknown(&mut self, name: &Ident, env: &Env<'m>) -> Value {
        let text = name.to_string();
        // Once for all its uses; of a constant in error where that is.
        if self.model.names.contains_key(&text) || !self.unknown.insert(text.clone()) {
            return Value::Error;
        }
        if let Some(result) = self.results.get(&text) {
            let message = match result {
                NoValue::Constraint => format!(
                    "`{text}` is a constraint, which no expression can use; its force is `reaction({text})`, under `output`, `integral`, `draw` and `nonideal`"
                ),
                NoValue::Output => format!(
                    "`{text}` is an output, which no expression can use; declare its value by `let`"
                ),
                NoValue::Integral => format!(
                    "`{text}` is an integral, which no expression can use: it is no coordinate, and nothing depends on it"
                ),
            };
            return self.error(name.span(), message);
        }
        let velocity = RATES.iter().find_map(|[before, after]| {
            let x = text.strip_prefix(before)?.strip_suffix(after)?;
            matches!(self.model.names.get(x), Some(Name::Coord(_))).then_some(x)
        });
        if let Some(x) = velocity {
            let message = format!("unknown name `{text}`; the velocity of `{x}` is `dot({x})`");
            return self.error(name.span(), message);
        }
        let names = self.model.names.keys().chain(self.lets.keys());
        let names = names.map(String::as_str);
        let names = names.chain(env.args.iter().map(|(n, _)| n.as_str()));
        let remedy = "declare it under `params`, `coords` or by `let` before its use";
        let end = suggest(&text, names.chain(["t", "PI"]), remedy);
        self.error(name.span(), format!("unknown name `{text}`{end}"))
    }

    /// Members of a family of parameters or coordinates, or the scalar itself.
    fn members(
        &mut self,
        name: &Ident,
        indices: &[Expr],
        family: &'m Family,
        symbol: fn(usize) -> Symbol,
        env: &Env<'m>,
    ) -> Value {
        let Some((positions, shape)) = self.member(name, indices, family, &env.scope) else {
            return Value::Error;
        };
        let mut entries = Vec::with_capacity(positions.len());
        for position in positions {
            match self.allowed(symbol(*position), name.span(), env) {
                Value::Scalar(id) => entries.push(id),
                _ => return Value::Error,
            }
        }
        Value::new(shape, entries)
    }

    /// What stands in a part, if that is where `e` leads.
    pub(super) fn in_part(&mut self, e: &Expr, env: &Env<'m>) -> Option<Value> {
        if self.model.part_families.is_empty() {
            return None;
        }
        let segments = e.segments()?;
        if env.args.iter().any(|(n, _)| segments[0].0 == n) {
            return None;
        }
        match env.scope.in_part(&segments, self.diag)? {
            Err(Reported) => Some(Value::Error),
            Ok(found) if found.used == segments.len() => {
                Some(self.name(&found.name, &found.indices, env))
            }
            Ok(_) => None,
        }
    }

    /// `elbow.angle`, where `base` names a joint of the tree.
    pub(super) fn of_joint(&mut self, base: &Expr, field: &Ident, env: &Env<'m>) -> Option<Value> {
        let segments = base.segments()?;
        let (name, indices) = match env.scope.in_part(&segments, &Diagnostics::default()) {
            Some(Ok(found)) if found.used == segments.len() => (found.name, found.indices),
            None if segments.len() == 1 => segments[0].clone(),
            _ => return None,
        };
        let text = name.to_string();
        let hidden = env.args.iter().any(|(n, _)| *n == text);
        if hidden || !matches!(self.model.names.get(&text), Some(Name::Joint)) {
            return None;
        }
        let key = Key {
            name,
            indices,
            fields: vec![(field.clone(), Vec::new())],
            measure: None,
            loc: base.loc.to(field.span().into()),
        };
        let Some((positions, shape)) = self.of_owner(&key, &env.scope) else {
            return Some(Value::Error);
        };
        let ids = positions
            .iter()
            .map(|i| self.graph.symbol(Symbol::Coord(*i)));
        let value = Value::new(shape, ids.collect());
        Some(self.allowed_value(value, key.loc, env))
    }

    /// Integers, if all are.
    pub(super) fn indices(&self, indices: &[Expr], scope: &Scope<'m>) -> Option<Vec<i64>> {
        let indices = indices.iter().map(|i| scope.integer(i, self.diag));
        indices.collect()
    }

    pub(super) fn allowed(
        &mut self,
        symbol: Symbol,
        span: proc_macro2::Span,
        env: &Env<'m>,
    ) -> Value {
        let id = self.graph.symbol(symbol);
        if env.place == Place::Default
            && let Symbol::Param(i) = symbol
            && i >= self.defaults.len()
        {
            return self.error(span, "a default may use parameters declared above it only");
        }
        self.allowed_value(Value::Scalar(id), span.into(), env)
    }

    /// Checks that what `value` depends on may stand in this section.
    pub(super) fn allowed_value(&mut self, value: Value, loc: Loc, env: &Env<'m>) -> Value {
        for id in value.entries() {
            let uses = self.graph.uses(*id);
            let refusal = match env.place {
                Place::Const if uses.param || !uses.constant() => Some(
                    "a constant is known at compile time; make it a parameter, or a value by `let`",
                ),
                Place::Until if uses.param || !uses.constant() => Some(
                    "how long a motion lasts is a number of units of time, or of constants; parameters and options do not change it",
                ),
                Place::Choice if uses.param || !uses.constant() => Some(
                    "the default of an option is a number, or made of constants; parameters stand in what the start says, beside the option",
                ),
                Place::Default if !uses.constant() => Some(
                    "a parameter is a number; what changes with coordinates or time is declared by `let`",
                ),
                Place::Body if !uses.constant() => {
                    Some("what a body consists of does not change: it depends on parameters only")
                }
                Place::Joint if !uses.constant() => Some(
                    "where a joint of the tree sits does not change: it depends on parameters only; what changes goes under `holonomic`",
                ),
                Place::Given if !uses.constant() => Some(
                    "a parameter of a part does not change with the motion: it depends on parameters only",
                ),
                Place::Start if !uses.constant() => {
                    Some("a start is given by parameters and its options")
                }
                Place::Gravity if uses.coord || uses.velocity => Some(
                    "gravity is one vector for all places, of parameters and `t`; a field that depends on the place goes under `potential`",
                ),
                Place::Mass if uses.velocity => Some(
                    "M depends on coordinates and time only; forces that depend on velocities go under `force`",
                ),
                Place::Potential if uses.velocity => Some(
                    "a potential depends on coordinates and time only; forces that depend on velocities go under `force`",
                ),
                Place::Holonomic if uses.velocity => Some(
                    "a velocity in a holonomic constraint; move the constraint under `nonholonomic`",
                ),
                _ => None,
            };
            if let Some(message) = refusal {
                return self.error(loc, message);
            }
        }
        value
    }
}

/// The members whose indices begin with `chosen`.
fn below<'a>(
    members: &'a BTreeMap<Vec<i64>, Value>,
    chosen: &'a [i64],
) -> impl Iterator<Item = (&'a Vec<i64>, &'a Value)> {
    let from = members.range(chosen.to_vec()..);
    from.take_while(move |(indices, _)| indices.starts_with(chosen))
}

/// The members that begin with `chosen` as an array, if their indices, `own` each, are 0, 1, 2, … and their shapes are one.
fn together(
    members: &BTreeMap<Vec<i64>, Value>,
    chosen: &[i64],
    own: usize,
    zero: Id,
) -> Option<Value> {
    let found = below(members, chosen).map(|(indices, value)| (indices, value.clone()));
    let (indices, parts): (Vec<&Vec<i64>>, Vec<Value>) = found.unzip();
    let mut shape = Vec::new();
    for d in chosen.len()..own {
        let least = indices.iter().map(|i| i[d]).min()?;
        let most = indices.iter().map(|i| i[d]).max()?;
        shape.push(usize::try_from(most).ok().filter(|_| least == 0)? + 1);
    }
    // As many as there are places: each has one.
    let full = shape
        .iter()
        .try_fold(1, |n: usize, size| n.checked_mul(*size))
        == Some(parts.len());
    let stacked = Value::stack(&parts, zero).ok().filter(|_| full)?;
    shape.extend_from_slice(&stacked.shape()[1..]);
    Some(Value::new(&shape, stacked.entries().to_vec()))
}
