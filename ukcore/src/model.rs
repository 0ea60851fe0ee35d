//! What a mechanism may say of itself beyond its equations: a name, start states with options, a duration, known motions.

use std::collections::BTreeMap;

use crate::assemble::State;
use crate::error::Error;
use crate::mechanism::Mechanism;

/// A mechanism that says more of itself than its equations: a name, consistent start states, a typical duration, what is known of its motion.
pub trait Model: Mechanism {
    /// Name on the command line, such as `"uchain"`.
    const ID: &'static str = Self::SPEC.name;

    /// The model in one line: the first of its documentation where nothing else is said.
    #[must_use]
    fn summary() -> &'static str {
        Self::SPEC.doc.trim().lines().next().unwrap_or_default()
    }

    /// The start states on offer; the first is the default.
    #[must_use]
    fn starts() -> &'static [StartSpec] {
        &[]
    }

    /// A state on all constraints, for the parameters of `self`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] for an unknown start or option, [`Error::InvalidSetting`] for a value with which the mechanism cannot
    /// be put together.
    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        Chosen::of::<Self>(name, options)?;
        Ok(State::zeros::<Self>())
    }

    /// Duration of a typical run, s: 10 s where nothing else is said.
    #[must_use]
    fn duration() -> f64 {
        10.0
    }

    /// What is known about the motion from [`default_start`](Model::default_start) with default parameters, once for each end that is of
    /// interest; empty where nothing is.
    #[must_use]
    fn references() -> Vec<Reference> {
        Vec::new()
    }

    /// The first start with default options.
    ///
    /// # Errors
    /// [`Error::InvalidSetting`] if the parameters of `self` do not admit it.
    fn default_start(&self) -> Result<State, Error> {
        let name = Self::starts().first().map_or("", |s| s.name);
        self.start(name, &StartOptions::new())
    }
}

/// A start state on offer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartSpec {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is, in one line.
    pub doc: &'static str,
    /// Its options.
    pub options: &'static [StartOption],
}

/// An option of a start state. No option is called like a parameter of its model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartOption {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is, in one line.
    pub doc: &'static str,
    /// Its value where none is given.
    pub default: f64,
    /// Its unit, such as `"m"`; empty for a plain number.
    pub unit: &'static str,
}

/// Values for the options of a start; what is absent has its default.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StartOptions {
    values: BTreeMap<String, f64>,
}

impl StartOptions {
    /// No option given: all defaults.
    #[must_use]
    pub fn new() -> Self {
        StartOptions::default()
    }

    /// These options and `name` = `value`.
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

/// A start of a model with the values of all its options: what an implementation of [`Model::start`] begins with.
#[derive(Debug, Clone)]
pub struct Chosen {
    /// The start.
    pub spec: &'static StartSpec,
    values: Vec<f64>,
}

impl Chosen {
    /// The start `name` of the model `M` with `options`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name, [`Error::NonFinite`] for a value that is not finite.
    pub fn of<M: Model>(name: &str, options: &StartOptions) -> Result<Self, Error> {
        let spec = M::starts().iter().find(|s| s.name == name).ok_or_else(|| {
            Error::unknown_name("start", name, &mut M::starts().iter().map(|s| s.name))
        })?;
        for (name, value) in options.iter() {
            if !spec.options.iter().any(|o| o.name == name) {
                let mut known = spec.options.iter().map(|o| o.name);
                return Err(Error::unknown_name("start option", name, &mut known));
            }
            if !value.is_finite() {
                let what = vec![format!("start option {name}")];
                return Err(Error::NonFinite { what });
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

/// Checks a value that a start was given.
///
/// # Errors
/// [`Error::InvalidSetting`], which calls it `what`, unless `value` is positive and finite.
pub fn positive(what: &'static str, value: f64) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    let reason = format!("is {value:?}; it must be positive and finite");
    Err(Error::InvalidSetting { what, reason })
}

/// States of a motion that are known in closed form, or from integrations with more digits than an `f64` holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Where the states come from, in a few words.
    pub source: &'static str,
    /// Bound of the error of every coordinate and velocity, in their own units.
    pub error: f64,
    /// The states, in order of time; the motion ends with the last one.
    pub states: Vec<State>,
}

/// States in closed form: so many equal intervals of the duration of a model.
const INTERVALS: u32 = 16;

impl Reference {
    /// The closed form `at` time t of q and q̇, at equal intervals up to the duration of `M`.
    #[must_use]
    pub fn closed<M: Model>(error: f64, at: impl Fn(f64) -> (Vec<f64>, Vec<f64>)) -> Self {
        let states = (1..=INTERVALS).map(|k| {
            let t = M::duration() * f64::from(k) / f64::from(INTERVALS);
            let (q, v) = at(t);
            State { t, q, v }
        });
        Reference {
            source: "closed form",
            error,
            states: states.collect(),
        }
    }

    /// These states up to the time `end`.
    #[must_use]
    pub fn up_to(&self, end: f64) -> Self {
        let mut shorter = self.clone();
        shorter.states.retain(|state| state.t <= end);
        shorter
    }
}
