//! Starts: where coordinates and velocities are, by parameters and options.

use super::array::Value;
use super::system::{GuessValue, OptionValue, StartValue};
use super::{Env, Lowering, Place};
use crate::diag::Loc;
use crate::expr::eval::{Point, eval};
use crate::expr::graph::{Id, Symbol};
use crate::model::{Name, Scope};
use crate::parse::{Declaration, Expr, Guess, Key, Start};
use proc_macro2::Ident;
use std::collections::HashSet;

/// What a start says.
#[derive(Default)]
struct Told {
    guesses: Vec<GuessValue>,
    turning: Vec<Turning>,
}

/// That a spatial body turns.
struct Turning {
    /// The position in q of its quaternion's first component.
    quaternion: usize,
    omega: Vec<Id>,
    /// In its own axes.
    own: bool,
    held: bool,
    loc: Loc,
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
            let mut told = Told::default();
            top.unroll(&start.guesses, self.diag, &mut |guess, scope| {
                let mut env = Env::new(scope, Place::Start);
                env.args.clone_from(&args);
                self.guess(guess, &env, &mut told);
            });
            self.upright(&mut told.guesses);
            self.turning_at(&mut told);
            starts.push(StartValue {
                name,
                docs: start.docs.clone(),
                options,
                until,
                guesses: told.guesses,
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
            let before = self.diag.len();
            let id = self.scalar(&option.default, &Env::new(top, Place::Const));
            let default = eval(&self.graph, &[id], &Point::NOWHERE)[0];
            if self.diag.len() == before {
                let what = format!("default of `{name}`");
                self.finite_number(&what, default, option.default.loc);
            }
            let symbol = Symbol::Param(parameters + options.len());
            args.push((name.clone(), Value::Scalar(self.graph.symbol(symbol))));
            options.push(OptionValue {
                name,
                docs: option.docs.clone(),
                default,
            });
        }
        (options, args)
    }

    /// How long a motion lasts.
    fn lasting(&mut self, until: &Expr, top: &Scope<'m>) -> Option<f64> {
        let before = self.diag.len();
        let id = self.scalar(until, &Env::new(top, Place::Const));
        let value = eval(&self.graph, &[id], &Point::NOWHERE)[0];
        if self.diag.len() > before {
            return None;
        }
        self.finite_number("the duration", value, until.loc);
        if value <= 0.0 {
            let message = format!("a motion lasts a time above 0, not {value}");
            self.diag.error(until.loc, message);
        }
        Some(value)
    }

    fn guess(&mut self, guess: &Guess, env: &Env<'m>, out: &mut Told) {
        if let ([key], false) = (&guess.keys[..], guess.rate || guess.vector)
            && let Some(turn) = self.turn_of(key, &env.scope)
        {
            return self.turning_guess(guess, turn, env, out);
        }
        let found: Vec<_> = guess
            .keys
            .iter()
            .map(|key| self.coordinates(key, &env.scope))
            .collect();
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
                let said = GuessValue {
                    coordinate: *coordinate,
                    rate: guess.rate,
                    held: guess.held,
                    value: *value,
                };
                self.tell(said, key.loc, &mut out.guesses);
            }
        }
    }

    /// Adds what is said, unless it was said before.
    fn tell(&mut self, said: GuessValue, loc: Loc, out: &mut Vec<GuessValue>) {
        let again = |other: &GuessValue| (other.coordinate, other.rate) == (said.coordinate, said.rate);
        if !out.iter().any(again) {
            return out.push(said);
        }
        let name = &self.model.coord_elements[said.coordinate].name;
        let shown = match said.rate {
            true => format!("dot({name})"),
            false => name.clone(),
        };
        let message = format!("`{shown}` is given twice in this start; remove one");
        self.diag.error(loc, message);
    }

    /// Of `arm.omega` and `arm.spin`: the key of the body's first coordinate, and whether its own axes are meant.
    fn turn_of(&mut self, key: &Key, scope: &Scope<'m>) -> Option<(Key, bool)> {
        let (last, _) = key.fields.last()?;
        let own = match last.to_string().as_str() {
            "omega" => false,
            "spin" => true,
            _ => return None,
        };
        let mut key = self.within(key, scope)?;
        let body = self.model.names.get(&key.name.to_string());
        let Some(Name::Body(family)) = body else {
            return None;
        };
        let planar = !self.model.body_kinds[*family].spatial;
        let [(field, behind)] = &mut key.fields[..] else {
            return None;
        };
        if !behind.is_empty() || planar && own {
            return None;
        }
        *field = Ident::new("x", field.span());
        Some((key, own))
    }

    /// An angular velocity: of a planar body the rate of its angle, of a spatial one those of its quaternion.
    fn turning_guess(
        &mut self,
        guess: &Guess,
        (key, own): (Key, bool),
        env: &Env<'m>,
        out: &mut Told,
    ) {
        let found = self.coordinates(&key, &env.scope);
        let value = self.value(&guess.value, env);
        let Some((places, shape)) = found else {
            return;
        };
        let model = self.model;
        let body = |place| model.own.iter().position(|own| *own == Some(place));
        let kind = |place| body(place).map(|k| model.body_kinds[model.body_elements[k].family]);
        let spatial = kind(places[0]).is_some_and(|kind| kind.spatial);
        let shape = match spatial {
            true => [shape, &[3]].concat(),
            false => shape.to_vec(),
        };
        let values = self.fitting(&value, &shape, &guess.value);
        let loc = guess.keys[0].loc;
        for (first, values) in places.iter().zip(values.chunks(if spatial { 3 } else { 1 })) {
            match *values {
                [value] => {
                    let said = GuessValue {
                        coordinate: first + 2,
                        rate: true,
                        held: guess.held,
                        value,
                    };
                    self.tell(said, loc, &mut out.guesses);
                }
                _ => out.turning.push(Turning {
                    quaternion: first + 3,
                    omega: values.to_vec(),
                    own,
                    held: guess.held,
                    loc,
                }),
            }
        }
    }

    /// The rates of quaternions whose bodies have a given angular velocity: ė = ½ ω e of ω in axes of the ground, ½ e ω of it in the body's.
    fn turning_at(&mut self, told: &mut Told) {
        for turning in std::mem::take(&mut told.turning) {
            let zero = self.graph.zero();
            let of = |k: usize| {
                let mut said = told.guesses.iter().filter(|guess| !guess.rate);
                let found = said.find(|guess| guess.coordinate == turning.quaternion + k);
                found.map_or(zero, |guess| guess.value)
            };
            let (e, w) = ([of(0), of(1), of(2), of(3)], &turning.omega);
            let sign = if turning.own { -0.5 } else { 0.5 };
            for k in 0..4 {
                let terms = match k {
                    0 => [(-0.5, 0, 1), (-0.5, 1, 2), (-0.5, 2, 3)],
                    _ => {
                        let (i, j) = (k % 3 + 1, (k + 1) % 3 + 1);
                        [(0.5, k - 1, 0), (sign, i - 1, j), (-sign, j - 1, i)]
                    }
                };
                let terms = terms.map(|(c, i, j)| (c, self.graph.mul(w[i], e[j])));
                let said = GuessValue {
                    coordinate: turning.quaternion + k,
                    rate: true,
                    held: turning.held,
                    value: self.graph.sum(&terms),
                };
                self.tell(said, turning.loc, &mut told.guesses);
            }
        }
    }

    /// Spatial bodies of which nothing is said are near the orientation in which their axes are those of the ground, and where they hang on a
    /// spherical joint, those of the body before.
    fn upright(&mut self, out: &mut Vec<GuessValue>) {
        let one = self.graph.one();
        for first in self.model.quaternions() {
            let own = first..first + 4;
            if out.iter().any(|g| !g.rate && own.contains(&g.coordinate)) {
                continue;
            }
            out.push(GuessValue {
                coordinate: first,
                rate: false,
                held: false,
                value: one,
            });
        }
    }
}
