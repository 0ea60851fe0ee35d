//! Starts: where coordinates and velocities are, by parameters and options.

use super::array::Value;
use super::units::Measured;
use super::{Env, Lowering, Place};
use crate::diag::Loc;
use crate::model::{Name, Scope};
use crate::parse::{Declaration, Expr, Guess, Key, Start};
use proc_macro2::Ident;
use std::collections::HashSet;
use ukalgebra::expr::Symbol;
use ukalgebra::expr::{GuessKind, GuessValue, OptionValue, StartValue};
use ukunits::Dimension;

/// A vector of a body that a start says something of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum OfBody {
    Centre,
    /// The angular velocity in axes of the ground.
    Omega,
    /// The angular velocity in axes of the body.
    Spin,
}

impl<'m> Lowering<'m> {
    /// The starts, in their order.
    pub(super) fn starts(&mut self, decl: &Declaration, top: &Scope<'m>) -> Vec<StartValue> {
        let mut names = HashSet::new();
        let mut starts = Vec::new();
        for start in &decl.starts {
            let name = start.name.to_string();
            if !names.insert(name.clone()) {
                let message = format!("start `{name}` is declared twice; names must be unique");
                self.diag.error(start.name.span(), message);
            }
            let (options, args) = self.options(start, top);
            let until = start.until.as_ref();
            let until = until.and_then(|until| self.lasting(until, top));
            let mut guesses = Vec::new();
            top.unroll(&start.guesses, self.diag, &mut |guess, scope| {
                let mut env = Env::new(scope, Place::Start);
                env.args.clone_from(&args);
                self.guess(guess, &env, &mut guesses);
            });
            self.upright(&mut guesses);
            starts.push(StartValue {
                name,
                docs: start.docs.clone(),
                options,
                until,
                guesses,
            });
        }
        starts
    }

    /// Options, and what their names stand for.
    fn options(
        &mut self,
        start: &Start,
        top: &Scope<'m>,
    ) -> (Vec<OptionValue>, Vec<(String, Value)>) {
        let parameters = self.model.param_elements.len();
        let (mut options, mut args) = (Vec::<OptionValue>::new(), Vec::new());
        for option in &start.options {
            let name = option.name.to_string();
            let again = options.iter().any(|o| o.name == name);
            let taken = match self.free(&option.name) {
                Ok(()) if again => Err(format!("`{name}` is declared twice; names must be unique")),
                other => other,
            };
            if let Err(reason) = taken {
                self.diag.error(option.name.span(), reason);
            }
            let what = format!("default of `{name}`");
            let (id, default) = self.fixed(&option.default, &what, top, Place::Choice);
            let symbol = self.measured_option(id);
            let symbol = symbol.unwrap_or(Symbol::Param(parameters + options.len()));
            args.push((name.clone(), Value::Scalar(self.graph.symbol(symbol))));
            options.push(OptionValue {
                name,
                docs: option.docs.clone(),
                default,
                unit: self.dimension(id).unit(&option.default),
            });
        }
        (options, args)
    }

    /// How long a motion lasts.
    fn lasting(&mut self, until: &Expr, top: &Scope<'m>) -> Option<f64> {
        let before = self.diag.len();
        let (id, value) = self.fixed(until, "the duration", top, Place::Until);
        if self.diag.len() > before {
            return None;
        }
        if value <= 0.0 {
            let message = format!("a motion lasts a time above 0, not {value}");
            self.diag.error(until.loc, message);
        }
        self.expect(
            id,
            Measured::of(Dimension::TIME),
            "as a duration is",
            until.loc,
        );
        Some(value)
    }

    fn guess(&mut self, guess: &Guess, env: &Env<'m>, out: &mut Vec<GuessValue>) {
        if let ([key], false) = (&guess.keys[..], guess.vector)
            && let Some((key, vector, spatial)) = self.vector_of(key, guess.rate, &env.scope)
        {
            return self.vector_guess(guess, &key, (vector, spatial), env, out);
        }
        let found = guess.keys.iter().map(|key| self.told_of(key, &env.scope));
        let found: Vec<_> = found.collect();
        let value = self.value(&guess.value, env);
        let Some(found) = found.into_iter().collect::<Option<Vec<_>>>() else {
            return;
        };
        let shape = found[0].1;
        if let Some(k) = found.iter().position(|(_, other)| *other != shape) {
            let message = "those of one vector are numbers all, or families of one size";
            self.diag.error(guess.keys[k].loc, message);
            return;
        }
        let width: usize = shape.iter().product();
        let shape = match guess.vector {
            true => [&[found.len()], shape].concat(),
            false => shape.to_vec(),
        };
        let values = self.fitting(&value, &shape, &guess.value);
        for (part, ((positions, _), key)) in found.iter().zip(&guess.keys).enumerate() {
            let values = values.iter().skip(part * width);
            for (coordinate, value) in positions.iter().zip(values) {
                let place = self.of_coordinate(*coordinate);
                let (expected, what) = match guess.rate {
                    true => (place.rate(), "as this velocity is"),
                    false => (place, "as this coordinate is"),
                };
                self.expect(*value, expected, what, guess.value.loc);
                let said = GuessValue {
                    coordinate: *coordinate,
                    kind: match guess.rate {
                        true => GuessKind::Velocity,
                        false => GuessKind::Position,
                    },
                    held: guess.held,
                    value: *value,
                };
                if !self.tell(said, key.loc, out) {
                    return;
                }
            }
        }
    }

    /// The coordinates that a start speaks of.
    fn told_of(&mut self, key: &Key, scope: &Scope<'m>) -> Option<(&'m [usize], &'m [usize])> {
        let whole = self.within(key, scope)?.into_owned();
        if let ([(field, _)], Some(family)) = (&whole.fields[..], self.body_of(&whole)) {
            let (name, text) = (whole.name.to_string(), field.to_string());
            let own = self.model.fields.get(&name);
            let own = own.is_some_and(|fields| fields.contains_key(text.as_str()));
            let names = self.model.body_kinds[family].coordinates();
            if !own && names.contains(&text.as_str()) {
                self.hangs(&name, field);
                return None;
            }
        }
        self.coordinates(&whole, scope)
    }

    /// Adds what is said, unless it was said before, which is reported.
    fn tell(&mut self, said: GuessValue, loc: Loc, out: &mut Vec<GuessValue>) -> bool {
        let rate = said.kind != GuessKind::Position;
        let again = |other: &GuessValue| {
            other.coordinate == said.coordinate && (other.kind != GuessKind::Position) == rate
        };
        if !out.iter().any(again) {
            out.push(said);
            return true;
        }
        let name = &self.model.coord_elements[said.coordinate].name;
        let shown = match rate {
            true => format!("dot({name})"),
            false => name.clone(),
        };
        let message = format!("`{shown}` is given twice in this start; remove one");
        self.diag.error(loc, message);
        false
    }

    /// What `arm.centre`, `arm.omega` or `arm.spin` names: the key of the body, which vector it is, and whether the body is spatial.
    fn vector_of(
        &mut self,
        key: &Key,
        rate: bool,
        scope: &Scope<'m>,
    ) -> Option<(Key, OfBody, bool)> {
        let (last, _) = key.fields.last()?;
        let vector = match last.to_string().as_str() {
            "centre" => OfBody::Centre,
            "omega" if !rate => OfBody::Omega,
            "spin" if !rate => OfBody::Spin,
            _ => return None,
        };
        let key = self.within(key, scope)?.into_owned();
        let spatial = self.model.body_kinds[self.body_of(&key)?].spatial;
        let [(_, behind)] = &key.fields[..] else {
            return None;
        };
        let known = behind.is_empty() && (spatial || vector != OfBody::Spin);
        known.then_some((key, vector, spatial))
    }

    /// The bodies whose name `key` begins with.
    fn body_of(&self, key: &Key) -> Option<usize> {
        match self.model.names.get(&key.name.to_string()) {
            Some(Name::Body(family)) => Some(*family),
            _ => None,
        }
    }

    /// The place in q that a vector of the body at `position` tells of: its own coordinates, or for an angular velocity those of the joint
    /// of the tree between it and the ground that turn it freely.
    fn place_of(&self, position: usize, vector: OfBody, spatial: bool) -> Option<usize> {
        let offset = match (vector, spatial) {
            (OfBody::Centre, _) => 0,
            (_, false) => 2,
            (_, true) => 3,
        };
        if let Some(first) = self.model.own[position] {
            return Some(first + offset);
        }
        let joint = &self.model.joints[self.model.hung[position]?];
        let turns = if spatial { "e0" } else { "angle" };
        let place = joint.kind.coordinates.iter().position(|c| *c == turns)?;
        let free = vector != OfBody::Centre && joint.parent.is_none();
        free.then_some(joint.first + place)
    }

    /// Reports that a start speaks of a body that hangs on a joint of the tree, not of the coordinates of the joint.
    fn hangs(&mut self, name: &str, field: &Ident) {
        let (coordinates, name) = (self.carrying(name), self.model.shown(name));
        let message = format!(
            "`{name}` hangs on a joint of the tree: a start gives the coordinates of the joint{coordinates} and their rates by `dot`, no `{field}` of the body"
        );
        self.diag.error(field.span(), message);
    }

    /// The place of a body's centre of mass, or its velocity; or its angular velocity: the rate of the angle of a planar one, those of the
    /// quaternion of a spatial one.
    fn vector_guess(
        &mut self,
        guess: &Guess,
        key: &Key,
        (vector, spatial): (OfBody, bool),
        env: &Env<'m>,
        out: &mut Vec<GuessValue>,
    ) {
        let value = self.value(&guess.value, env);
        let Some(family) = self.body_of(key) else {
            return;
        };
        let bodies = &self.model.bodies[family];
        let Some((positions, shape)) = self.member(&key.name, &key.indices, bodies, &env.scope)
        else {
            return;
        };
        let places = positions.iter().map(|p| self.place_of(*p, vector, spatial));
        let Some(places) = places.collect::<Option<Vec<usize>>>() else {
            return self.hangs(&key.name.to_string(), &key.fields[0].0);
        };
        let size = match (spatial, vector) {
            (true, _) => 3,
            (false, OfBody::Centre) => 2,
            (false, _) => 1,
        };
        let shape = match size {
            1 => shape.to_vec(),
            _ => [shape, &[size]].concat(),
        };
        let values = self.fitting(&value, &shape, &guess.value);
        let loc = guess.keys[0].loc;
        let zero = self.graph.zero();
        for (first, values) in places.iter().zip(values.chunks(size)) {
            let kind = match vector {
                OfBody::Centre if !guess.rate => GuessKind::Position,
                OfBody::Omega if spatial => GuessKind::Omega,
                OfBody::Spin => GuessKind::Spin,
                _ => GuessKind::Velocity,
            };
            let turns = matches!(kind, GuessKind::Omega | GuessKind::Spin);
            let (expected, what) = match vector {
                OfBody::Centre if guess.rate => {
                    (self.of_coordinate(*first).rate(), "as this velocity is")
                }
                OfBody::Centre => (self.of_coordinate(*first), "as this place is"),
                _ => (
                    Measured::of(Dimension::NUMBER).rate(),
                    "as an angular velocity is",
                ),
            };
            for value in values {
                self.expect(*value, expected, what, guess.value.loc);
            }
            let values = turns.then_some(&zero).into_iter().chain(values);
            for (k, value) in values.enumerate() {
                let said = GuessValue {
                    coordinate: first + k,
                    kind,
                    held: guess.held,
                    value: *value,
                };
                if !self.tell(said, loc, out) {
                    return;
                }
            }
        }
    }

    /// Spatial bodies of which nothing is said are near the orientation in which their axes are those of the ground, and where they hang on
    /// a spherical joint, those of the body before.
    fn upright(&mut self, out: &mut Vec<GuessValue>) {
        let one = self.graph.one();
        for first in self.model.quaternions() {
            let own = first..first + 4;
            let placed =
                |g: &GuessValue| g.kind == GuessKind::Position && own.contains(&g.coordinate);
            if out.iter().any(placed) {
                continue;
            }
            out.push(GuessValue {
                coordinate: first,
                kind: GuessKind::Position,
                held: false,
                value: one,
            });
        }
    }
}
