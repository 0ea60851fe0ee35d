//! What the compiler knows about a mechanism, and the code it emitted for it.
//!
//! [`Mechanism`] is implemented by [`multibody!`](crate::multibody), never by hand. Notation is that of Zhao, Zhen & Chen 2013:
//! M q̈ = Q (eq. 1), A q̈ = b (eq. 5), c the non-ideal force (eq. 8). `n` is the number of coordinates, `m` of constraints,
//! `h` of holonomic ones, which come first.

use crate::error::Error;
use crate::plan::Plan;
use crate::scalar::Scalar;

mod prepared;

pub use prepared::Prepared;
pub(crate) use prepared::{Dynamics, Equations, Switches};

use crate::spec::{Guess, OutputSpec, Spec};

/// A declared mechanism: its parameters (`self`), what is known about it (`SPEC`), and its equations as straight-line code.
///
/// The functions that evaluate the equations take `prepared`: what depends on parameters only, then for each switch the branch it is held
/// in, as a sign, or 0 where it is followed. [`Prepared`] holds it, and is how they are called.
///
/// All matrices are column-major. Into matrices the emitted code writes **structural non-zeros only**: the caller passes buffers that
/// were zeroed once, and may reuse them for the same mechanism type. Vectors are written completely. No method allocates. Every method
/// panics if a slice has not the stated length; [`Solver`](crate::Solver) and [`Simulation`](crate::Simulation) check what users pass in
/// before that.
pub trait Mechanism: Clone + Default + Into<Prepared> + Send + Sync + 'static {
    /// Names, structure and readable equations.
    const SPEC: &'static Spec;

    /// The emitted functions, in the order of this trait: name and text, which [`code::laid_out`](crate::plan::laid_out) makes readable.
    /// The numbers in it are those that run. Nothing of it is in a program that does not read it.
    const CODE: &'static [(&'static str, &'static str)] = &[];

    /// Names of the integrals along a motion.
    const INTEGRALS: &'static [OutputSpec] = &[];

    /// Value of parameter `index` (order of `SPEC.params`).
    fn parameter(&self, index: usize) -> f64;
    /// Sets parameter `index` (order of `SPEC.params`).
    fn set_parameter(&mut self, index: usize, value: f64);

    /// The values that depend on parameters only, `SPEC.prepared`, from the parameters (order of `SPEC.params`).
    fn prepare<S: Scalar>(given: &[S], prepared: &mut [S]);

    /// M, Q, c, A and b at (t, q, q̇): eqs. 1, 5 and 8. Q includes −∂V/∂q and, with `kinetic`, Lagrange's velocity terms.
    fn dynamics<S: Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], out: &mut Terms<'_, S>);
    /// M(q, t), n × n.
    fn mass_matrix<S: Scalar>(prepared: &[S], t: S, q: &[S], mass: &mut [S]);
    /// A(q, q̇, t), m × n.
    fn jacobian<S: Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], jacobian: &mut [S]);
    /// φ(q, t) of the `h` holonomic constraints (eq. 3).
    fn residual<S: Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]);
    /// All `m` constraints at velocity level: φ̇ of the holonomic (eq. 3 differentiated once), φ(q, q̇, t) of the nonholonomic (eq. 4).
    fn residual_rate<S: Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], rate: &mut [S]);
    /// Kinetic energy T and potential V at (t, q, q̇); V is 0 where none is declared.
    fn energy<S: Scalar>(prepared: &[S], t: S, q: &[S], v: &[S]) -> Energy<S>;
    /// The declared outputs.
    fn outputs<S: Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], outputs: &mut [S]);

    /// What the declared integrals integrate by time, as many as `INTEGRALS`.
    fn integrands<S: Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], integrands: &mut [S]) {
        let _ = (prepared, t, q, v, integrands);
    }

    /// Calls `each` with the name of each spatial body and, by the parameters (order of `SPEC.params`), ten numbers: its mass, and its
    /// inertia about the centre of mass by rows.
    fn inertias(given: &[f64], each: &mut dyn FnMut(&'static str, &[f64])) {
        let _ = (given, each);
    }

    /// The numbers of the shapes of `SPEC.drawing` at (t, q, q̇), one after the other.
    fn drawing<S: Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], drawing: &mut [S]) {
        let _ = (prepared, t, q, v, drawing);
    }

    /// Calls `each` with all that start number `start` (order of `SPEC.starts`) says, by the parameters (order of `SPEC.params`) and behind
    /// them the options of the start.
    fn guess(start: usize, given: &[f64], each: &mut dyn FnMut(Guess)) {
        let _ = (start, given, each);
    }

    /// The functions at whose zeros abs, sign, min or max change their branch, `SPEC.switches`, as they are: held branches do not count.
    fn switching<S: Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], switching: &mut [S]) {
        let _ = (prepared, t, q, v, switching);
    }

    /// q̈ at (t, q, q̇) by straight-line elimination of [M Aᵀ; A 0], and its certificate: 1 where each pivot d of the elimination keeps a
    /// safe share d/G of the diagonal G it started from, 0 where M or A is singular or nearly so, and q̈ is not to be used. Exists if
    /// [`Structure::straight_line`](crate::spec::Structure::straight_line); else the certificate is 0.
    ///
    /// Where rows of [`Solve::redundant`](crate::spec::Solve::redundant) were left out it is 1 − k/1024 for k rows of which nothing but
    /// rounding is left, and 1/2 − k/1024 where what is left may come from a distance to the constraints, which it does not know: then q̈
    /// is to be used only if their constraints are seen to be met otherwise, as by projection.
    ///
    /// Where inertias are a factor of 10⁴ or more apart, so that accelerations of light coordinates may be rounding, all of these are 1/4
    /// less: then q̈ is to be used only if no coordinate is light beside those that constraints tie it to. [`Solver`](crate::Solver) keeps
    /// to all that.
    fn acceleration<S: Scalar>(prepared: &[S], t: S, q: &[S], v: &[S], out: &mut [S]) -> S {
        let _ = (prepared, t, q, v, out);
        S::from_f64(0.0)
    }
    /// The smallest Δ in the mass metric with A Δ = −`residual`, and its certificate, as for [`Mechanism::acceleration`].
    fn correction<S: Scalar>(
        prepared: &[S],
        t: S,
        q: &[S],
        v: &[S],
        residual: &[S],
        out: &mut [S],
    ) -> S {
        let _ = (prepared, t, q, v, residual, out);
        S::from_f64(0.0)
    }

    /// The mechanism with these parameters, ready to be evaluated with numbers of type `S`.
    fn prepared<S: Scalar>(&self) -> Prepared<S> {
        let given = (0..Self::SPEC.params.len()).map(|i| S::from_f64(self.parameter(i)));
        Prepared::of::<Self>(given.collect())
    }

    /// What the compiler decided about this mechanism, with reasons, costs and the sparsity of its equations: print it.
    #[must_use]
    fn plan() -> Plan {
        Plan::new(Self::SPEC)
    }

    /// Value of the parameter called `name` (`"m"`, `"m[3]"`).
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    fn get(&self, name: &str) -> Result<f64, Error> {
        Ok(self.parameter(Self::SPEC.parameter_index(name)?))
    }

    /// Sets the parameter called `name` (`"m"`, `"m[3]"`; a family's bare name sets all its members).
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    fn set(&mut self, name: &str, value: f64) -> Result<(), Error> {
        for i in Self::SPEC.parameter_indices(name)? {
            self.set_parameter(i, value);
        }
        Ok(())
    }
}

/// A branch of a switch. Functions of a mechanism whose switches are all held are smooth where a switching function passes zero: each
/// abs, sign, min or max goes on in the branch it is held in. Energies and outputs follow their switches always.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Branch {
    /// The branch that the sign of the switching function says.
    #[default]
    Followed,
    /// The branch of negative values of the switching function.
    Negative,
    /// The branch of positive values of the switching function.
    Positive,
    /// What is at the zero of the switching function, whatever its value is: sign is 0 there.
    Zero,
}

impl Branch {
    /// The sign of the switching function in the branch: −1 or 1; 0 at its zero, and where none is held.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Branch::Followed | Branch::Zero => 0.0,
            Branch::Negative => -1.0,
            Branch::Positive => 1.0,
        }
    }

    /// Whether it is on one side of the zero.
    pub(crate) fn is_side(self) -> bool {
        self.sign() != 0.0
    }

    /// What emitted functions take for it; see [`Scalar::branch`].
    pub(crate) fn held(self) -> f64 {
        match self {
            Branch::Zero => 2.0,
            other => other.sign(),
        }
    }
}

/// Buffers that [`Mechanism::dynamics`] writes to (column-major, zeroed once by the caller).
#[derive(Debug)]
pub struct Terms<'a, S> {
    /// The mass matrix M, n × n, both triangles (eq. 1).
    pub mass: &'a mut [S],
    /// The generalised force Q, n numbers (eq. 1).
    pub force: &'a mut [S],
    /// The force c of non-ideal constraints, n numbers (eq. 8).
    pub nonideal: &'a mut [S],
    /// The constraint Jacobian A, m × n (eq. 5).
    pub jacobian: &'a mut [S],
    /// The right-hand side b of A q̈ = b, m numbers (eq. 5).
    pub rhs: &'a mut [S],
}

/// [`Terms`] in buffers of their own.
#[derive(Debug, Clone)]
pub(crate) struct Evaluated<S = f64> {
    pub(crate) mass: Vec<S>,
    pub(crate) force: Vec<S>,
    pub(crate) nonideal: Vec<S>,
    pub(crate) jacobian: Vec<S>,
    pub(crate) rhs: Vec<S>,
}

impl<S: Scalar> Evaluated<S> {
    /// Buffers for n coordinates and m constraints.
    pub(crate) fn new(n: usize, m: usize) -> Self {
        let zeros = |len: usize| vec![S::from_f64(0.0); len];
        Evaluated {
            mass: zeros(n * n),
            force: zeros(n),
            nonideal: zeros(n),
            jacobian: zeros(m * n),
            rhs: zeros(m),
        }
    }

    /// All five terms, in the order M, Q, c, A, b.
    pub(crate) fn all(&self) -> [&[S]; 5] {
        [
            &self.mass,
            &self.force,
            &self.nonideal,
            &self.jacobian,
            &self.rhs,
        ]
    }

    /// The terms of `mech` at (t, q, q̇).
    pub(crate) fn dynamics<C: ?Sized + Equations<S>>(
        &mut self,
        mech: &Prepared<S, C>,
        t: S,
        q: &[S],
        v: &[S],
    ) {
        let mut terms = Terms {
            mass: &mut self.mass,
            force: &mut self.force,
            nonideal: &mut self.nonideal,
            jacobian: &mut self.jacobian,
            rhs: &mut self.rhs,
        };
        mech.dynamics(t, q, v, &mut terms);
    }
}

/// The kinetic and the potential energy of a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy<S = f64> {
    /// The kinetic energy T, from `kinetic` or as ½ q̇ᵀ M q̇.
    pub kinetic: S,
    /// The potential energy V, from `potential`; 0 where none is declared.
    pub potential: S,
}

impl Energy<f64> {
    /// The sum T + V of both energies.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential
    }
}

/// What emitted code calls. Not for other use.
#[doc(hidden)]
pub mod emitted {
    pub use super::{Energy, Mechanism, Prepared, Terms};
    pub use crate::emitted;
    pub use crate::scalar::{Scalar, Tape};
    pub use crate::spec::*;

    /// `slice` as an array of its one right length.
    #[inline]
    #[track_caller]
    pub fn exact<'a, S, const N: usize>(slice: &'a [S], what: &str) -> &'a [S; N] {
        match slice.try_into() {
            Ok(array) => array,
            Err(_) => wrong_length(what, N, slice.len()),
        }
    }

    /// `slice` as an array of its one right length.
    #[inline]
    #[track_caller]
    pub fn exact_mut<'a, S, const N: usize>(slice: &'a mut [S], what: &str) -> &'a mut [S; N] {
        let found = slice.len();
        match slice.try_into() {
            Ok(array) => array,
            Err(_) => wrong_length(what, N, found),
        }
    }

    /// A place that the optimiser does not see across. What it does with the statements between two of them takes time that grows faster
    /// than their number, so long functions have some. It costs a load, and a branch that is never taken.
    #[inline(always)]
    pub fn border() {
        if std::hint::black_box(false) {
            beyond_border();
        }
    }

    #[cold]
    fn beyond_border() -> ! {
        unreachable!("`false` is false")
    }

    /// A parameter's position that is none.
    #[cold]
    #[track_caller]
    pub fn no_parameter(index: usize) -> ! {
        panic!("there is no parameter number {index}")
    }

    #[cold]
    #[track_caller]
    fn wrong_length(what: &str, expected: usize, found: usize) -> ! {
        panic!("`{what}` must have length {expected}, but has length {found}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{Pendulum, Twice};

    #[test]
    fn parameters_by_name() {
        let mut mech = Pendulum::default();
        mech.set("l", 2.5).unwrap();
        assert_eq!((mech.get("l"), mech.parameter(1)), (Ok(2.5), 2.5));
        let error = Error::UnknownName {
            kind: "parameter",
            name: "L1".into(),
            nearest: Some("l".into()),
            known: Pendulum::SPEC
                .params
                .iter()
                .map(|p| p.name.into())
                .collect(),
        };
        assert_eq!(mech.set("L1", 0.0), Err(error.clone()));
        assert_eq!(mech.get("L1"), Err(error));
    }

    #[test]
    fn indices_by_name() {
        let spec = Twice::SPEC;
        assert_eq!((spec.n(), spec.m()), (4, 3));
        assert_eq!(spec.coordinate_index("y2"), Ok(3));
        assert_eq!(spec.constraint_index("rod[1]"), Ok(1));
        assert!(
            matches!(spec.constraint_index("rod[2]"), Err(Error::UnknownName { nearest: Some(n), .. }) if n == "rod[0]")
        );
        assert!(spec.output_index("fall").is_err());
    }

    #[test]
    #[should_panic(expected = "`q` must have length 2, but has length 3")]
    fn lengths_are_stated() {
        let _: &[f64; 2] = emitted::exact(&[0.0; 3], "q");
    }
}
