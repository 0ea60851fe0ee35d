//! Starts that a mechanism declares: guesses by options, assembled.

use std::collections::BTreeMap;

use crate::assemble::{Held, State, assembled};
use crate::error::Error;
use crate::mechanism::Prepared;
use crate::spec::{GuessKind, StartOption, StartSpec};

/// Values for the options of a start; what is absent has its default.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StartOptions {
    values: BTreeMap<String, f64>,
}

impl StartOptions {
    /// Options of which none is given: all have their defaults.
    #[must_use]
    pub fn new() -> Self {
        StartOptions::default()
    }

    /// These options with the value of `name` set to `value`, in the unit of its [`StartOption`].
    #[must_use]
    pub fn with(mut self, name: &str, value: f64) -> Self {
        self.set(name, value);
        self
    }

    /// Gives the option `name` the value `value`, in the unit of its [`StartOption`].
    pub fn set(&mut self, name: &str, value: f64) {
        self.values.insert(name.to_owned(), value);
    }

    /// The value given for `name`, if any.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }

    /// Names and values given, by name.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.values
            .iter()
            .map(|(name, &value)| (name.as_str(), value))
    }
}

impl<const N: usize> From<[(&str, f64); N]> for StartOptions {
    /// The options with these names and values.
    fn from(values: [(&str, f64); N]) -> Self {
        values.into_iter().collect()
    }
}

impl<T: Into<String>> FromIterator<(T, f64)> for StartOptions {
    /// The options with these names and values, the last of those with one name.
    fn from_iter<I: IntoIterator<Item = (T, f64)>>(values: I) -> Self {
        let values = values.into_iter().map(|(name, value)| (name.into(), value));
        StartOptions {
            values: values.collect(),
        }
    }
}

/// A start of a model with the values of all its options: what an implementation of `Model::start` begins with.
#[derive(Debug, Clone)]
pub struct Chosen {
    /// The start that was chosen.
    pub spec: &'static StartSpec,
    values: Vec<f64>,
}

impl Chosen {
    /// The start `name` among `starts` with `options`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name, [`Error::NonFinite`] for a value that is not finite.
    pub fn among(
        starts: &'static [StartSpec],
        name: &str,
        options: &StartOptions,
    ) -> Result<Self, Error> {
        let spec = starts.iter().find(|s| s.name == name).ok_or_else(|| {
            Error::unknown_name("start", name, &mut starts.iter().map(|s| s.name))
        })?;
        for (name, value) in options.iter() {
            if !spec.options.iter().any(|o| o.name == name) {
                let mut known = spec.options.iter().map(|o| o.name);
                return Err(Error::unknown_name("start option", name, &mut known));
            }
            if !value.is_finite() {
                return Err(Error::non_finite(format!("start option {name}")));
            }
        }
        let value = |o: &StartOption| options.get(o.name).unwrap_or(o.default);
        let values = spec.options.iter().map(value).collect();
        Ok(Chosen { spec, values })
    }

    /// Values of the first `K` options, in declared order; 0 for those that the start has not.
    #[must_use]
    pub fn values<const K: usize>(&self) -> [f64; K] {
        std::array::from_fn(|i| self.values.get(i).copied().unwrap_or(0.0))
    }
}

impl Prepared {
    /// The declared start called `name` with `options`, for the parameters of now: what it holds has its value, all else is where the
    /// constraints put it next to what the start says, or to 0. The first start is the default one.
    /// [`Prepared::start_with_alternatives`] tells of other places that are as near.
    ///
    /// # Errors
    /// - [`Error::UnknownName`] with the nearest name for a start or option that is not declared, [`Error::NonFinite`] for a value that is
    ///   not finite.
    /// - [`Error::NotAssembled`] where no state near what it says satisfies all constraints.
    pub fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let Said { guess, held } = self.said(name, options)?;
        assembled(self, &guess, held)
    }

    /// What the declared start called `name` says with `options`.
    pub(crate) fn said(&self, name: &str, options: &StartOptions) -> Result<Said, Error> {
        let (spec, n) = (self.spec(), self.spec().n());
        let chosen = Chosen::among(spec.starts, name, options)?;
        let place = spec.starts.iter().position(|s| s.name == name);
        let guess = State::at_rest(0.0, vec![0.0; n]);
        let held = Held {
            untold: (0..n).collect(),
            untold_rates: (0..n).collect(),
            ..Held::default()
        };
        let mut said = Said { guess, held };
        self.guess(place.unwrap_or(0), &chosen.values, &mut |told| {
            let (values, held) = match told.kind {
                GuessKind::Position => (&mut said.guess.q, &mut said.held.positions),
                _ => (&mut said.guess.v, &mut said.held.velocities),
            };
            values[told.coordinate] = told.value;
            held.extend(told.held.then_some(told.coordinate));
            let untold = match told.kind {
                GuessKind::Position => &mut said.held.untold,
                _ => &mut said.held.untold_rates,
            };
            untold.retain(|j| *j != told.coordinate);
            if let GuessKind::Omega | GuessKind::Spin = told.kind {
                said.held.turning.push((told.coordinate, told.kind));
            }
        });
        Ok(said)
    }
}

/// What a declared start says.
pub(crate) struct Said {
    /// 0 where it says nothing.
    pub(crate) guess: State,
    pub(crate) held: Held,
}
