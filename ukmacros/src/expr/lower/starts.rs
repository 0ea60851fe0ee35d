//! Starts: where coordinates and velocities are, by parameters and options.

use super::array::Value;
use super::system::{GuessValue, OptionValue, StartValue};
use super::units::Measured;
use super::{Env, Lowering, Place};
use crate::expr::eval::{Point, eval};
use crate::expr::graph::Symbol;
use crate::model::Scope;
use crate::parse::{Declaration, Guess, Start};
use std::collections::HashSet;
use ukunits::Dimension;

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
            let mut guesses: Vec<GuessValue> = Vec::new();
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
            let before = self.diag.len();
            let id = self.scalar(&option.default, &Env::new(top, Place::Const));
            let default = eval(&self.graph, &[id], &Point::NOWHERE)[0];
            if self.diag.len() == before {
                let what = format!("default of `{name}`");
                self.finite_number(&what, default, option.default.loc);
            }
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

    fn guess(&mut self, guess: &Guess, env: &Env<'m>, out: &mut Vec<GuessValue>) {
        let coordinates = self.coordinates(&guess.key, &env.scope);
        let value = self.value(&guess.value, env);
        let Some((positions, shape)) = coordinates else {
            return;
        };
        let values = self.fitting(&value, shape, &guess.value);
        for (coordinate, value) in positions.iter().copied().zip(values) {
            let place = self.of_coordinate(coordinate);
            let (expected, what) = match guess.rate {
                true => (
                    place.per(Measured::of(Dimension::TIME)),
                    "as this velocity is",
                ),
                false => (place, "as this coordinate is"),
            };
            self.expect(value, expected, what, guess.value.loc);
            let again =
                |other: &GuessValue| (other.coordinate, other.rate) == (coordinate, guess.rate);
            if out.iter().any(again) {
                let name = &self.model.coord_elements[coordinate].name;
                let shown = match guess.rate {
                    true => format!("dot({name})"),
                    false => name.clone(),
                };
                let message = format!("`{shown}` is given twice in this start; remove one");
                self.diag.error(guess.key.loc, message);
                return;
            }
            out.push(GuessValue {
                coordinate,
                rate: guess.rate,
                held: guess.held,
                value,
            });
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
