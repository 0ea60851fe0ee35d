//! Names, members, and what may stand where.

use super::array::{MAX_ENTRIES, Value, describe};
use super::{Binding, Env, Lowering, NoValue, Place};
use crate::diag::{Diagnostics, Loc, suggest};
use crate::expr::graph::{Id, Symbol};
use crate::model::{Family, Field, Name, Reported, Scope, block, indexed};
use crate::parse::{Expr, Key};
use proc_macro2::Ident;
use std::collections::BTreeMap;

impl<'m> Lowering<'m> {
    /// What `name` stands for; of a family or vector the member or part that `indices` choose.
    pub(super) fn name(&mut self, name: &Ident, indices: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        let shown = format!("`{text}`");
        let argument = env.args.iter().rev().find(|(n, _)| *n == text);
        if let Some((_, value)) = argument {
            let value = value.clone();
            return self.part(value, &shown, indices, env);
        }
        if let Some(i) = env.scope.lookup(&text) {
            #[allow(
                clippy::cast_precision_loss,
                reason = "an integer in a formula is a number"
            )]
            let value = Value::Scalar(self.graph.constant(i as f64));
            return self.part(value, &shown, indices, env);
        }
        let value = match text.as_str() {
            "t" => self.allowed(Symbol::Time, name.span(), env),
            "PI" => Value::Scalar(self.graph.constant(std::f64::consts::PI)),
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
                None if text == "ground" && indices.is_empty() => Self::ground(),
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
            let message = match shape.len() {
                0 => format!("{name} is a number; write it without an index"),
                n => format!(
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
        // Once for all its uses.
        if !self.unknown.insert(text.clone()) {
            return Value::Error;
        }
        match self.results.get(&text) {
            Some(NoValue::Constraint) => {
                return self.error(
                    name.span(),
                    format!("`{text}` is a constraint, which no expression can use; its force is `reaction({text})`, under `output`, `integral` and `nonideal`"),
                );
            }
            Some(NoValue::Output) => {
                return self.error(
                    name.span(),
                    format!("`{text}` is an output, which no expression can use; declare its value by `let`"),
                );
            }
            Some(NoValue::Integral) => {
                return self.error(
                    name.span(),
                    format!("`{text}` is an integral, which no expression can use: it is no coordinate, and nothing depends on it"),
                );
            }
            None => {}
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

    /// Positions of the members of a family that `indices` choose, and the shape of what they make up.
    pub(super) fn member(
        &mut self,
        name: &Ident,
        indices: &[Expr],
        family: &'m Family,
        scope: &Scope<'m>,
    ) -> Option<(&'m [usize], &'m [usize])> {
        let shape = &family.shape;
        if let Some(surplus) = indices.get(shape.len()) {
            let message = match shape.len() {
                0 => format!("`{name}` is not a family; write it without an index"),
                1 => format!("members of `{name}` are numbers: they take one index"),
                n => format!("members of `{name}` are numbers: they take {n} indices"),
            };
            self.diag.error(surplus.loc, message);
            return None;
        }
        let chosen = self.indices(indices, scope)?;
        match block(shape, &chosen) {
            Ok(range) => Some((&family.members[range], &shape[chosen.len()..])),
            Err(wrong) => {
                let (count, members) = (family.members.len(), range_of(name, shape));
                let message = format!(
                    "index {} is out of range: `{name}` has {count} members, {members}",
                    chosen[wrong]
                );
                self.diag.error(indices[wrong].loc, message);
                None
            }
        }
    }

    /// Positions in q of the coordinates that `key` names, and the shape of what they make up.
    pub(super) fn coordinates(
        &mut self,
        key: &Key,
        scope: &Scope<'m>,
    ) -> Option<(&'m [usize], &'m [usize])> {
        let key = &self.within(key, scope)?;
        let name = key.name.to_string();
        let family = match self.model.names.get(&name) {
            Some(Name::Coord(family)) => Some(*family),
            Some(Name::Body(_) | Name::Joint) => return self.of_owner(key, scope),
            _ => None,
        };
        let Some(family) = family else {
            // Once for all its uses.
            if !self.unknown.insert(name.clone()) {
                return None;
            }
            let coords = self.model.coords.iter().take(self.model.plain);
            let coords: Vec<String> = coords.map(|f| f.name.to_string()).collect();
            let remedy = match coords.len() {
                0 => "those of bodies are written `link.x`".to_owned(),
                1..=8 => format!("coordinates are `{}`", coords.join("`, `")),
                _ => "declare it under `coords`".to_owned(),
            };
            let end = suggest(&name, coords.iter().map(String::as_str), &remedy);
            self.diag.error(
                key.name.span(),
                format!("`{name}` is not a coordinate{end}"),
            );
            return None;
        };
        if let Some((field, _)) = key.fields.first() {
            let message = "no fields here; a coordinate is written by its name alone, such as `x`";
            self.diag.error(field.span(), message);
            return None;
        }
        let family = &self.model.coords[family];
        self.member(&key.name, &key.indices, family, scope)
    }

    /// `key` by the name that what it says has in the whole, where it is of a part.
    pub(super) fn within(&mut self, key: &Key, scope: &Scope<'m>) -> Option<Key> {
        let name = key.name.to_string();
        if !matches!(self.model.names.get(&name), Some(Name::Part)) {
            return Some(key.clone());
        }
        let mut segments = vec![(key.name.clone(), key.indices.clone())];
        segments.extend(key.fields.iter().cloned());
        let found = scope.in_part(&segments, self.diag)?.ok()?;
        let key = Key {
            name: found.name,
            indices: found.indices,
            fields: segments.split_off(found.used),
            loc: key.loc,
        };
        self.within(&key, scope)
    }

    /// Positions in q of the coordinates of bodies, or of joints of the tree, that `key` names.
    fn of_owner(&mut self, key: &Key, scope: &Scope<'m>) -> Option<(&'m [usize], &'m [usize])> {
        let (model, name) = (self.model, key.name.to_string());
        let body = match model.names.get(&name) {
            Some(Name::Body(family)) => Some(model.body_kinds[*family].coordinates()),
            _ => None,
        };
        let what = if body.is_some() { "body" } else { "joint" };
        let Some((field, behind)) = key.fields.first() else {
            let message = format!("`{name}` is a {what}; {}", self.its_coordinates(&name));
            self.diag.error(key.loc, message);
            return None;
        };
        let surplus = behind.first().map(|index| index.loc);
        let surplus = surplus.or(key.fields.get(1).map(|(name, _)| name.span().into()));
        if let Some(loc) = surplus {
            let message = "a coordinate is a number, and nothing follows it; indices stand behind the body or joint";
            self.diag.error(loc, message);
            return None;
        }
        let text = field.to_string();
        let fields = model.fields.get(&name);
        match fields.and_then(|fields| fields.get(text.as_str())) {
            Some(Field::Family(family)) => {
                let chosen = self.indices(&key.indices, scope)?;
                let family = &model.coords[*family];
                let shown = indexed(model.shown(&name), &chosen);
                let owners = model.joints.iter().map(|joint| &joint.name);
                let bodies = model.body_elements.iter().map(|body| &body.name);
                let whole = family.shape.len() == chosen.len();
                if whole
                    && block(&family.shape, &chosen).is_err()
                    && owners.chain(bodies).any(|owner| *owner == shown)
                {
                    let message = format!("`{shown}` has no coordinate `{text}`");
                    self.diag.error(key.loc, message);
                    return None;
                }
                self.member(&key.name, &key.indices, family, scope)
            }
            Some(Field::Scattered(families)) => {
                let chosen = self.indices(&key.indices, scope)?;
                let places: Option<Vec<usize>> =
                    chosen.iter().map(|i| usize::try_from(*i).ok()).collect();
                let family = places.and_then(|places| families.get(&places));
                if family.is_none() {
                    let shown = indexed(&name, &chosen);
                    let message = format!("`{shown}` has no coordinate `{text}`");
                    self.diag.error(key.loc, message);
                }
                let family = &model.coords[*family?];
                Some((&family.members[..], &family.shape[..]))
            }
            None if body.is_some_and(|names| names.contains(&text.as_str())) => {
                let message = format!(
                    "`{name}` hangs on a joint of the tree: its coordinates are those of the joint{}; what acts on it goes under `forces`",
                    self.carrying(&name)
                );
                self.diag.error(field.span(), message);
                None
            }
            None => {
                let names = body.into_iter().flatten().copied();
                let names = names.chain(fields.into_iter().flat_map(|f| f.keys().copied()));
                let remedy = match body {
                    Some(names) => format!("they are `{}`", names.join("`, `")),
                    None => self.its_coordinates(&name),
                };
                let end = suggest(&text, names, &remedy);
                let message = format!("{what} `{name}` has no coordinate `{text}`{end}");
                self.diag.error(field.span(), message);
                None
            }
        }
    }

    /// The coordinates of the joint that the bodies called `name` hang on, as written, if all hang on joints of one name.
    fn carrying(&self, name: &str) -> String {
        let model = self.model;
        let Some(Name::Body(family)) = model.names.get(name) else {
            return String::new();
        };
        let members = model.bodies[*family].members.iter();
        let joints = members.map(|at| model.hung[*at].map(|joint| &model.joints[joint]));
        let joints: Option<Vec<_>> = joints.collect();
        let Some([first, rest @ ..]) = joints.as_deref() else {
            return String::new();
        };
        if rest.iter().any(|joint| joint.key != first.key) {
            return String::new();
        }
        let index = if first.indices.is_empty() { "" } else { "[i]" };
        let names = first.kind.coordinates.iter();
        let names = names.map(|coordinate| format!(", `{}{index}.{coordinate}`", first.key));
        names.collect()
    }

    /// What coordinates the bodies or joints called `name` have, in words.
    fn its_coordinates(&self, name: &str) -> String {
        match (self.model.fields.get(name), self.model.names.get(name)) {
            (Some(fields), Some(Name::Joint)) => {
                let names = fields.keys().map(|field| format!("`{name}.{field}`"));
                format!(
                    "its coordinates are {}",
                    names.collect::<Vec<_>>().join(", ")
                )
            }
            (Some(_), Some(Name::Body(family))) => {
                let names = self.model.body_kinds[*family].coordinates().join("`, `");
                format!("choose a coordinate of it: `{names}`")
            }
            (_, Some(Name::Joint)) => "it has no coordinates".to_owned(),
            _ => "its coordinates are those of the joint that it hangs on".to_owned(),
        }
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

    /// Position in q of the coordinate that `key` names.
    pub(super) fn coordinate(&mut self, key: &Key, scope: &Scope<'m>) -> Option<usize> {
        match self.coordinates(key, scope)? {
            ([position], []) => Some(*position),
            (_, shape) => {
                let message = self.choose_a_member(key, shape);
                self.diag.error(key.loc, message);
                None
            }
        }
    }

    /// The message about a family that stands where a number is needed; `shape` is what is left of it.
    pub(super) fn choose_a_member(&self, key: &Key, shape: &[usize]) -> String {
        let name = &key.name;
        let members = match self.model.names.get(&name.to_string()) {
            Some(Name::Coord(f)) => range_of(name, &self.model.coords[*f].shape),
            _ => String::new(),
        };
        let whole = describe(shape);
        format!("`{name}` is a family; choose a member, {members}, or give {whole}")
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
            && i >= self.known_params
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

/// `x[0]` to `x[2]`: the members of a family of this shape.
pub(super) fn range_of(name: &Ident, shape: &[usize]) -> String {
    let last: Vec<usize> = shape.iter().map(|size| size - 1).collect();
    let first = indexed(name, &vec![0; shape.len()]);
    format!("`{first}` to `{}`", indexed(name, &last))
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
