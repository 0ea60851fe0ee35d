//! What a mechanism may say of itself beyond its equations, and a mechanism as tools handle it.
//!
//! [`Model`] is a trait of defaults: a name, start states that are computed, motions that are known otherwise. [`Entry`] carries any
//! mechanism, with what it says or without, under a name; a slice of entries is a registry.

use std::fmt;
use std::marker::PhantomData;

use crate::assemble::State;
use crate::error::Error;
use crate::mechanism::{Mechanism, Prepared};
pub use crate::spec::{StartOption, StartSpec};
pub use crate::start::{Chosen, StartOptions};

/// What a mechanism says of itself beyond its declaration. Everything has a default; what is given serves the tools.
pub trait Model: Mechanism {
    /// Name on the command line, such as `"uchain"`; if empty, the name of the type, `UChain` as `u-chain`.
    const ID: &'static str = "";

    /// The start states on offer, those declared if not given; the first is the default. Where there is none, a start is
    /// [assembled](crate::assemble()) from a guess.
    #[must_use]
    fn starts() -> &'static [StartSpec] {
        Self::SPEC.starts
    }

    /// The start state called `name`, on all constraints, for the parameters of `self`: the declared one, by [`Prepared::start`], if not
    /// given. What is given takes the options by [`Chosen::among`].
    ///
    /// # Errors
    /// [`Error::UnknownName`] for an unknown start or option, [`Error::InvalidSetting`] for a value with which the mechanism cannot
    /// be put together, what [`Prepared::start`] reports.
    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        self.prepared().start(name, options)
    }

    /// Duration of a typical run from the default start, s.
    #[must_use]
    fn duration() -> f64 {
        StartSpec::typical(Self::starts().first())
    }

    /// What is known about the motion from [`default_start`](Model::default_start) with default parameters, once for each end that is of
    /// interest; empty where nothing is.
    #[must_use]
    fn references() -> Vec<Reference> {
        Vec::new()
    }

    /// Sets of parameters, besides the defaults, that make another problem of the mechanism, so that it is worth being measured with them
    /// too.
    #[must_use]
    fn variations() -> &'static [&'static [(&'static str, f64)]] {
        &[]
    }

    /// The first start with default options.
    ///
    /// # Errors
    /// What [`Model::start`] reports; [`Error::UnknownName`] if there is no start.
    fn default_start(&self) -> Result<State, Error> {
        let name = Self::starts().first().map_or("", |s| s.name);
        self.start(name, &StartOptions::new())
    }
}

/// States of a motion that are known in closed form, or from integrations with more digits than an `f64` holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// The origin of the states, in a few words.
    pub source: &'static str,
    /// Bound of the error of every coordinate and velocity, in their own units.
    pub error: f64,
    /// The states, in order of time; the motion ends with the last one.
    pub states: Vec<State>,
}

/// States in closed form: so many equal intervals of the duration of a model.
const INTERVALS: u32 = 16;

impl Reference {
    /// The closed form `at` time t of q and q̇, at equal intervals up to the duration of `M`; `error` bounds what its evaluation is off.
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

    /// The part of this reference up to the time `end`, s.
    #[must_use]
    pub fn up_to(&self, end: f64) -> Self {
        let mut shorter = self.clone();
        shorter.states.retain(|state| state.t <= end);
        shorter
    }
}

/// Makes a start: mechanism, name and options.
type Start = fn(&Prepared, &str, &StartOptions) -> Result<State, Error>;

/// A mechanism as tools handle it: an object with a name, its default parameters, and what it says of itself.
#[derive(Clone)]
pub struct Entry {
    /// Name on the command line: [`Model::ID`], or the name of the type, `UChain` as `u-chain`.
    pub id: String,
    /// What the mechanism is, in one line.
    pub summary: &'static str,
    /// The mechanism with its default parameters.
    pub mechanism: Prepared,
    /// The start states on offer; the first is the default.
    pub starts: &'static [StartSpec],
    /// The duration of a run, s: [`Model::duration`].
    pub duration: f64,
    /// Sets of parameters worth being measured with, too: [`Model::variations`].
    pub variations: &'static [&'static [(&'static str, f64)]],
    /// The emitted functions: name and text.
    pub code: &'static [(&'static str, &'static str)],
    start: Start,
    references: fn() -> Vec<Reference>,
}

impl Entry {
    /// The entry of the model `M`.
    #[must_use]
    pub fn of<M: Model>() -> Self {
        let start: Start = |mechanism, name, options| {
            let mut model = M::default();
            for (i, value) in mechanism.parameters().iter().enumerate() {
                model.set_parameter(i, *value);
            }
            model.start(name, options)
        };
        let named = Entry::plain::<M>();
        Entry {
            id: if M::ID.is_empty() {
                named.id
            } else {
                M::ID.to_owned()
            },
            starts: M::starts(),
            duration: M::duration(),
            variations: M::variations(),
            start,
            references: M::references,
            ..named
        }
    }

    /// The mechanism `M` with the defaults of [`Model`], whether it is one or not.
    #[must_use]
    pub fn plain<M: Mechanism>() -> Self {
        Entry {
            id: kebab_case(M::SPEC.name),
            summary: M::SPEC.doc.trim().lines().next().unwrap_or_default().trim(),
            mechanism: M::default().prepared(),
            starts: M::SPEC.starts,
            duration: StartSpec::typical(M::SPEC.starts.first()),
            variations: &[],
            code: M::CODE,
            start: Prepared::start,
            references: Vec::new,
        }
    }

    /// The start called `name`, for the parameters of `mechanism`, which is this one with other values.
    ///
    /// # Errors
    /// What [`Model::start`] reports.
    pub fn start(
        &self,
        mechanism: &Prepared,
        name: &str,
        options: &StartOptions,
    ) -> Result<State, Error> {
        (self.start)(mechanism, name, options)
    }

    /// The states to compare motions with: [`Model::references`].
    #[must_use]
    pub fn references(&self) -> Vec<Reference> {
        (self.references)()
    }
}

impl fmt::Debug for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Entry")
            .field("id", &self.id)
            .field("mechanism", &self.mechanism)
            .field("starts", &self.starts)
            .finish_non_exhaustive()
    }
}

/// The entry of a mechanism type, as [`Entry::of`] where it is a [`Model`], as [`Entry::plain`] where it is not.
///
/// ```
/// ukcore::multibody! {
///     /// A mass that falls.
///     pub FallingMass { coords { y } mass { y: 1.0 } potential { 9.81 * y } }
/// }
///
/// let entry = ukcore::entry!(FallingMass);
/// assert_eq!((entry.id.as_str(), entry.summary), ("falling-mass", "A mass that falls."));
/// ```
#[macro_export]
macro_rules! entry {
    ($mechanism:ty) => {{
        #[allow(unused_imports, reason = "one of the two is used")]
        use $crate::model::{AsMechanism as _, AsModel as _};
        // A method that takes its receiver as it is comes before one that borrows it once more.
        (&$crate::model::Type::<$mechanism>::NEW).entry()
    }};
}

/// Stands for a type in [`entry!`](crate::entry).
#[doc(hidden)]
pub struct Type<M>(PhantomData<M>);

impl<M> Type<M> {
    /// The only value of the type.
    pub const NEW: Self = Type(PhantomData);
}

/// Makes [`entry!`](crate::entry) take a [`Model`] as such.
#[doc(hidden)]
pub trait AsModel {
    fn entry(&self) -> Entry;
}

impl<M: Model> AsModel for Type<M> {
    fn entry(&self) -> Entry {
        Entry::of::<M>()
    }
}

/// Makes [`entry!`](crate::entry) take a [`Mechanism`] that is no [`Model`].
#[doc(hidden)]
pub trait AsMechanism {
    fn entry(&self) -> Entry;
}

impl<M: Mechanism> AsMechanism for &Type<M> {
    fn entry(&self) -> Entry {
        Entry::plain::<M>()
    }
}

/// The name of a type as it is written on a command line: `UChain` as `u-chain`, `HTTPServer2` as `http-server2`.
pub(crate) fn kebab_case(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let mut text = String::new();
    for (i, letter) in letters.iter().enumerate() {
        let after_small = i > 0 && !letters[i - 1].is_uppercase();
        let before_small = i > 0 && letters.get(i + 1).is_some_and(|next| next.is_lowercase());
        if letter.is_uppercase() && (after_small || before_small) {
            text.push('-');
        }
        text.extend(letter.to_lowercase());
    }
    text.replace("_", "-").replace("--", "-")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{Pendulum, Twice};

    impl Model for Twice {
        const ID: &'static str = "two";

        fn variations() -> &'static [&'static [(&'static str, f64)]] {
            &[&[]]
        }
    }

    #[test]
    fn what_is_no_model_has_the_defaults() {
        let plain = crate::entry!(Pendulum);
        assert_eq!((plain.id.as_str(), plain.variations.len()), ("pendulum", 0));
        let model = crate::entry!(Twice);
        assert_eq!((model.id.as_str(), model.variations.len()), ("two", 1));
        let error = plain.start(&plain.mechanism, "rest", &StartOptions::new());
        assert!(matches!(
            error,
            Err(Error::UnknownName { kind: "start", .. })
        ));
    }

    #[test]
    fn names_of_types_are_written_in_kebab_case() {
        for (name, written) in [
            ("Cart", "cart"),
            ("UChain", "u-chain"),
            ("DoublePendulum", "double-pendulum"),
            ("HTTPServer2", "http-server2"),
            ("Two_Bars", "two-bars"),
        ] {
            assert_eq!(kebab_case(name), written);
        }
    }
}
