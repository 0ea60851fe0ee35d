//! A mechanism as an object: its emitted functions behind tables, and its parameters.
//!
//! Emitted functions are generic over numbers, so [`Mechanism`] itself makes no trait object. Everything that runs on them does so
//! through [`Prepared`], which is one type for all mechanisms: solver, projection, integration and trajectories are compiled once, here,
//! and a crate that declares a mechanism compiles its emitted functions and little else.

use std::any::TypeId;
use std::fmt;
use std::marker::PhantomData;

use crate::error::Error;
use crate::interval::{Along, Interval};
use crate::mechanism::{Branch, Energy, Mechanism, Terms};
use crate::plan::Plan;
use crate::rounding::Rounded;
use crate::scalar::{Scalar, Sloped};
use crate::spec::{Guess, OutputSpec, Spec};

/// What each table of emitted functions begins with, in numbers `S`.
pub trait Code<S>: Send + Sync + 'static {
    /// What is known about the mechanism, and its functions in other numbers.
    fn face(&self) -> &'static Face;
    /// [`Mechanism::prepare`].
    fn prepare(&self, given: &[S], prepared: &mut [S]);
}

impl<M: Mechanism, S: Scalar> Code<S> for Of<M> {
    fn face(&self) -> &'static Face {
        Of::<M>::FACE
    }
    fn prepare(&self, given: &[S], prepared: &mut [S]) {
        M::prepare(given, prepared);
    }
}

/// A table of emitted functions, for numbers `S`: the trait, which each mechanism has, and the methods of [`Prepared`] that call through
/// it.
macro_rules! table {
    ($(#[$about:meta])* $Table:ident: $Before:ident {
        $($(#[$doc:meta])* fn $name:ident($($x:ident: $X:ty),*) $(-> $out:ty)?;)*
    }) => {
        $(#[$about])*
        pub trait $Table<S>: $Before<S> {
            $($(#[$doc])* fn $name(&self, $($x: $X,)* prepared: &[S]) $(-> $out)?;)*
        }

        impl<M: Mechanism, S: Scalar> $Table<S> for Of<M> {
            // With `prepared` first, two arguments would be read off the stack at once that have come there one by one: a processor
            // waits for that, some 10 ns a call.
            $(fn $name(&self, $($x: $X,)* prepared: &[S]) $(-> $out)? {
                M::$name(prepared, $($x),*)
            })*
        }

        impl<S: Scalar, C: ?Sized + $Table<S>> Prepared<S, C> {
            $($(#[$doc])* #[inline] pub fn $name(&self, $($x: $X),*) $(-> $out)? {
                self.code.$name($($x,)* &self.values)
            })*
        }
    };
}

table! {
    /// What decides branches.
    Switches: Code {
        /// All switching functions at (t, q, q̇); see [`Mechanism::switching`].
        fn switching(t: S, q: &[S], v: &[S], switching: &mut [S]);
    }
}

table! {
    /// The equations of motion and the constraints.
    Equations: Switches {
        /// φ of the h holonomic constraints at (t, q); see [`Mechanism::residual`].
        fn residual(t: S, q: &[S], phi: &mut [S]);
        /// φ̇ of the holonomic and φ of the nonholonomic constraints at (t, q, q̇), m numbers; see [`Mechanism::residual_rate`].
        fn residual_rate(t: S, q: &[S], v: &[S], rate: &mut [S]);
        /// M, Q, c, A and b at (t, q, q̇); see [`Mechanism::dynamics`].
        fn dynamics(t: S, q: &[S], v: &[S], out: &mut Terms<'_, S>);
    }
}

table! {
    /// What else derivatives are taken of.
    Dynamics: Equations {
        /// q̈ by the emitted elimination and its certificate at (t, q, q̇); see [`Mechanism::acceleration`]. [`Solver`](crate::Solver)
        /// wraps it with the rank-revealing solve.
        fn acceleration(t: S, q: &[S], v: &[S], out: &mut [S]) -> S;
    }
}

table! {
    /// All emitted functions.
    Emitted: Dynamics {
        /// M at (t, q), n × n, column-major; see [`Mechanism::mass_matrix`].
        fn mass_matrix(t: S, q: &[S], mass: &mut [S]);
        /// A at (t, q, q̇), m × n, column-major; see [`Mechanism::jacobian`].
        fn jacobian(t: S, q: &[S], v: &[S], jacobian: &mut [S]);
        /// Kinetic and potential energy at (t, q, q̇); see [`Mechanism::energy`].
        #[must_use]
        fn energy(t: S, q: &[S], v: &[S]) -> Energy<S>;
        /// The declared outputs at (t, q, q̇), in the order of [`Spec::outputs`]; see [`Mechanism::outputs`].
        fn outputs(t: S, q: &[S], v: &[S], outputs: &mut [S]);
        /// What is integrated along with a motion, at (t, q, q̇), in the order of [`integrals`](Prepared::integrals); see
        /// [`Mechanism::integrands`].
        fn integrands(t: S, q: &[S], v: &[S], integrands: &mut [S]);
        /// The smallest Δ with A Δ = −`residual` in the mass metric, and its certificate; see [`Mechanism::correction`].
        fn correction(t: S, q: &[S], v: &[S], residual: &[S], out: &mut [S]) -> S;
    }
}

type Inertias = fn(&[f64], &mut dyn FnMut(&'static str, &[f64]));
type AtState = fn(&[f64], f64, &[f64], &[f64], &mut [f64]);

/// What a mechanism is in all numbers that the runtime needs. Only functions that it calls are in a table, for each one in it is compiled.
pub struct Face {
    /// [`Mechanism::INTEGRALS`].
    integrals: &'static [OutputSpec],
    /// The identity of the mechanism's type.
    id: fn() -> TypeId,
    /// [`Mechanism::inertias`].
    inertias: Inertias,
    /// [`Mechanism::drawing`].
    drawing: AtState,
    /// [`Mechanism::guess`].
    guess: fn(usize, &[f64], &mut dyn FnMut(Guess)),
    /// The functions in numbers that carry derivatives.
    sloped: &'static dyn Dynamics<Sloped>,
    /// The functions in numbers that add up their rounding.
    rounded: &'static dyn Equations<Rounded>,
    /// The functions in numbers that may vary.
    varied: &'static dyn Equations<Interval>,
    /// The functions in numbers that vary along a way.
    along: &'static dyn Switches<Along>,
}

/// The functions of `M`.
struct Of<M>(PhantomData<fn() -> M>);

impl<M: Mechanism> Of<M> {
    const FACE: &'static Face = &Face {
        integrals: M::INTEGRALS,
        id: TypeId::of::<M>,
        inertias: M::inertias,
        drawing: M::drawing,
        guess: M::guess,
        sloped: &Of::<M>(PhantomData),
        rounded: &Of::<M>(PhantomData),
        varied: &Of::<M>(PhantomData),
        along: &Of::<M>(PhantomData),
    };
}

/// A mechanism with its parameters, as an object: one type for all mechanisms, in numbers `S`. What depends on parameters alone is computed
/// once, here.
///
/// It is made by [`Mechanism::prepared`], or from a mechanism or a reference to one by `Prepared::from`; whatever solves, projects or
/// simulates takes either. With [`Dual`](crate::scalar::Dual) parameters come derivatives by parameters. Its methods do not check lengths;
/// each panics if a slice has not the stated one.
pub struct Prepared<S: Scalar = f64, C: ?Sized + 'static = dyn Emitted<S>> {
    code: &'static C,
    spec: &'static Spec,
    given: Vec<S>,
    /// What depends on parameters only, then the branches held.
    values: Vec<S>,
}

impl<S: Scalar> Prepared<S> {
    /// The mechanism `M` with the parameters `given` (order of `SPEC.params`).
    ///
    /// # Panics
    /// If `given` has not the length of `SPEC.params`.
    #[must_use]
    pub fn of<M: Mechanism>(given: Vec<S>) -> Self {
        Prepared::with(&Of::<M>(PhantomData), M::SPEC, given)
    }

    /// The mechanism with other parameters (order of [`Spec::params`]) and the branches held here.
    ///
    /// # Panics
    /// If `given` has not the length of [`Spec::params`].
    #[must_use]
    pub fn with_parameters(&self, given: Vec<S>) -> Self {
        let mut other = Prepared::with(self.code, self.spec, given);
        let fixed = self.spec.prepared.len();
        other.values[fixed..].copy_from_slice(&self.values[fixed..]);
        other
    }
}

impl<S: Scalar, C: ?Sized + Code<S>> Prepared<S, C> {
    fn with(code: &'static C, spec: &'static Spec, given: Vec<S>) -> Self {
        assert_eq!(given.len(), spec.params.len(), "one value a parameter");
        let mut prepared = Prepared {
            code,
            spec,
            given,
            values: vec![S::from_f64(0.0); spec.slots()],
        };
        prepared.prepare();
        prepared
    }

    fn prepare(&mut self) {
        let fixed = self.spec.prepared.len();
        self.code.prepare(&self.given, &mut self.values[..fixed]);
    }

    /// What is known about the mechanism: names, structure, readable equations.
    #[must_use]
    pub fn spec(&self) -> &'static Spec {
        self.spec
    }

    /// The parameters, in the order of [`Spec::params`].
    #[must_use]
    pub fn parameters(&self) -> &[S] {
        &self.given
    }

    /// Gives the parameters these values, in their order; held branches stay so.
    pub(crate) fn set_parameters(&mut self, given: impl Iterator<Item = S>) {
        self.given.iter_mut().zip(given).for_each(|(p, x)| *p = x);
        self.prepare();
    }

    /// What emitted functions take as `prepared`, to call them directly, without a table: `Pendulum::acceleration(mech.values(), t, q, v,
    /// out)`.
    #[must_use]
    pub fn values(&self) -> &[S] {
        &self.values
    }

    /// Holds switch `switch` (order of [`Spec::switches`]) in `branch`, until told otherwise. A new mechanism follows all its switches.
    ///
    /// # Panics
    /// If there is no such switch.
    pub fn hold(&mut self, switch: usize, branch: Branch) {
        self.values[self.spec.prepared.len()..][switch] = S::from_f64(branch.held());
    }

    /// Holds all switches as `other` does.
    pub fn hold_as(&mut self, other: &Prepared) {
        let branches = other.values.iter().zip(&mut self.values);
        for (from, to) in branches.skip(self.spec.prepared.len()) {
            *to = S::from_f64(*from);
        }
    }
}

impl<S: Scalar, C: ?Sized + Emitted<S>> Prepared<S, C> {
    /// Names of what is integrated along with a motion.
    #[must_use]
    pub fn integrals(&self) -> &'static [OutputSpec] {
        self.code.face().integrals
    }

    /// Whether `other` is the same mechanism, whatever its parameters are.
    fn is_of_type<D: ?Sized + Emitted<T>, T: Scalar>(&self, other: &Prepared<T, D>) -> bool {
        (self.code.face().id)() == (other.code.face().id)()
    }

    /// An error unless `other` is the same mechanism; `what` is made for this one.
    pub(crate) fn check_same(&self, other: &Prepared, what: &str) -> Result<(), Error> {
        if self.is_of_type(other) {
            return Ok(());
        }
        let (name, own) = (other.spec.name, self.spec.name);
        Err(Error::invalid(
            "mechanism",
            format!("is a `{name}`, but this {what} was made for `{own}`"),
        ))
    }
}

impl Prepared {
    /// Calls `each` with the name of each spatial body, its mass and its inertia by rows; see [`Mechanism::inertias`].
    pub(crate) fn inertias(&self, each: &mut dyn FnMut(&'static str, &[f64])) {
        (self.code.face().inertias)(&self.given, each);
    }

    /// The numbers of the shapes of [`Spec::drawing`] at (t, q, q̇), one after the other; as many as
    /// [`Drawing::numbers`](crate::spec::Drawing::numbers) says.
    pub fn drawing(&self, t: f64, q: &[f64], v: &[f64], drawing: &mut [f64]) {
        (self.code.face().drawing)(&self.values, t, q, v, drawing);
    }

    /// Calls `each` with all that start number `start` says with these values of its options; see [`Mechanism::guess`].
    pub(crate) fn guess(&self, start: usize, options: &[f64], each: &mut dyn FnMut(Guess)) {
        let given = [&self.given, options].concat();
        (self.code.face().guess)(start, &given, each);
    }

    /// The switching functions at (t, q, q̇).
    pub(crate) fn switches_at(&self, t: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; self.spec.switches.len()];
        self.switching(t, q, v, &mut values);
        values
    }

    /// The mechanism with a switch held in its one branch and in the other.
    pub(crate) fn on_both_sides(&self, switch: usize) -> [Self; 2] {
        [Branch::Negative, Branch::Positive].map(|branch| {
            let mut held = self.clone();
            held.hold(switch, branch);
            held
        })
    }

    /// What the compiler decided about this mechanism, with reasons, costs and the sparsity of its equations: print it.
    #[must_use]
    pub fn plan(&self) -> Plan {
        Plan::new(self.spec)
    }

    /// Value of the parameter called `name` (`"m"`, `"m[3]"`).
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn get(&self, name: &str) -> Result<f64, Error> {
        Ok(self.given[self.spec.parameter_index(name)?])
    }

    /// Sets the parameter called `name` (`"m"`, `"m[3]"`; a family's bare name sets all its members).
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), Error> {
        for i in self.spec.parameter_indices(name)? {
            self.given[i] = value;
        }
        self.prepare();
        Ok(())
    }

    /// The mechanism in numbers that carry derivatives, with its parameters and held branches.
    pub(crate) fn sloped(&self) -> Prepared<Sloped, dyn Dynamics<Sloped>> {
        self.lift(self.code.face().sloped, Sloped::from_f64)
    }

    /// The mechanism in numbers that add up their rounding, with its parameters, taken to be exact, and held branches.
    pub(crate) fn rounded(&self) -> Prepared<Rounded, dyn Equations<Rounded>> {
        self.lift(self.code.face().rounded, Rounded::exact)
    }

    /// The mechanism in numbers that may vary, with its parameters, which do not, and held branches.
    pub(crate) fn varied(&self) -> Prepared<Interval, dyn Equations<Interval>> {
        self.lift(self.code.face().varied, Interval::exact)
    }

    /// The switching functions in numbers that vary along a way, with the parameters, which do not.
    pub(crate) fn along(&self) -> Prepared<Along, dyn Switches<Along>> {
        self.lift(self.code.face().along, Along::from_f64)
    }

    fn lift<T: Scalar, C: ?Sized + Code<T>>(
        &self,
        code: &'static C,
        number: fn(f64) -> T,
    ) -> Prepared<T, C> {
        let given = self.given.iter().map(|p| number(*p)).collect();
        let mut lifted = Prepared::with(code, self.spec, given);
        lifted.hold_as(self);
        lifted
    }
}

impl<M: Mechanism> From<&M> for Prepared {
    fn from(mechanism: &M) -> Self {
        mechanism.prepared()
    }
}

impl From<&Prepared> for Prepared {
    fn from(prepared: &Prepared) -> Self {
        prepared.clone()
    }
}

impl<S: Scalar, C: ?Sized> Clone for Prepared<S, C> {
    fn clone(&self) -> Self {
        Prepared {
            code: self.code,
            spec: self.spec,
            given: self.given.clone(),
            values: self.values.clone(),
        }
    }
}

impl<S: Scalar + PartialEq> PartialEq for Prepared<S> {
    fn eq(&self, other: &Self) -> bool {
        self.is_of_type(other) && self.given == other.given && self.values == other.values
    }
}

impl<S: Scalar, C: ?Sized> fmt::Debug for Prepared<S, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self.spec.params.iter().map(|p| p.name);
        f.debug_struct(self.spec.name)
            .field("parameters", &names.zip(&self.given).collect::<Vec<_>>())
            .finish_non_exhaustive()
    }
}
