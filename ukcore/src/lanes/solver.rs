//! Accelerations in lanes.

use super::Lanes;
use crate::error::Error;
use crate::mechanism::{Mechanism, Prepared};
use crate::scalar::Scalar;
use crate::scan::sum;
use crate::solver::{Accepted, Solver, SolverOptions, SolverWork};

/// Solves for q̈ of several mechanisms at once, one in each lane.
///
/// The emitted elimination computes all lanes. Where its certificate does not hold in a lane, or something is not finite there, a
/// [`Solver`] of that lane's own solves it again; so a lane has the acceleration, or the error, that it would have alone.
#[derive(Debug, Clone)]
pub struct LaneSolver<L: Scalar> {
    mechanisms: Vec<Prepared>,
    prepared: Prepared<L>,
    /// A lane's own solver, once it needs one.
    own: Vec<Option<Box<Own>>>,
    errors: Vec<Option<Error>>,
    evaluations: Vec<usize>,
    /// Certificates with which a lane's acceleration may be used, which its own solver knows once it was needed.
    accepted: Vec<Accepted>,
    /// Whether states are projected after each step.
    projected: bool,
}

#[derive(Debug, Clone)]
struct Own {
    solver: Solver,
    /// State and acceleration: q, q̇, q̈.
    state: [Vec<f64>; 3],
}

/// 0 in the lanes where all numbers are finite, NaN where one is not, or where their sum overflows.
fn zero_if_finite<L: Lanes>(t: L, [q, v, out]: [&[L]; 3]) -> L {
    (t + sum(q) + sum(v) + sum(out)) * L::from_f64(0.0)
}

impl<L: Lanes> LaneSolver<L> {
    /// A solver with `mechanism` in each lane.
    #[must_use]
    pub fn new<M: Mechanism>(mechanism: &M) -> Self {
        LaneSolver::with(mechanism.prepared(), mechanism.prepared())
    }

    /// A solver for the mechanism that is given in lanes, as `prepared`, and alone.
    pub(crate) fn with(prepared: Prepared<L>, mechanism: Prepared) -> Self {
        LaneSolver {
            mechanisms: vec![mechanism; L::WIDTH],
            prepared,
            own: (0..L::WIDTH).map(|_| None).collect(),
            errors: vec![None; L::WIDTH],
            evaluations: vec![0; L::WIDTH],
            accepted: vec![Accepted::WHOLE; L::WIDTH],
            projected: false,
        }
    }

    /// Takes each step from here on to end with a projection, as for a solver of one lane.
    #[cfg(feature = "ensemble")]
    pub(crate) fn project(mut self) -> Self {
        self.projected = true;
        self
    }

    /// Puts `mechanism`, with its parameters, into lane `lane`, below [`Lanes::WIDTH`], and begins to count its work anew.
    ///
    /// # Errors
    /// [`Error::InvalidSetting`] if it is not the mechanism that the solver was made for.
    pub fn set(&mut self, lane: usize, mechanism: impl Into<Prepared>) -> Result<(), Error> {
        let mechanism = mechanism.into();
        self.mechanisms[lane].check_same(&mechanism, "solver")?;
        self.put(lane, mechanism);
        Ok(())
    }

    /// Puts `mechanism` into lane `lane`, without asking whether it is the one that the solver was made for.
    pub(crate) fn put(&mut self, lane: usize, mechanism: Prepared) {
        self.mechanisms[lane] = mechanism;
        let mechanisms = &self.mechanisms;
        let parameter = |i| L::from_lanes(|k| mechanisms[k].parameters()[i]);
        let count = self.prepared.parameters().len();
        self.prepared.set_parameters((0..count).map(parameter));
        self.own[lane] = None;
        self.accepted[lane] = Accepted::WHOLE;
        self.errors[lane] = None;
        self.evaluations[lane] = 0;
    }

    /// The mechanisms, for what needs no solver.
    #[must_use]
    pub fn prepared(&self) -> &Prepared<L> {
        &self.prepared
    }

    /// q̈ at (t, q, q̇) into `out` (each of length n), in the lanes for which `wanted` holds; the others are left as they come.
    /// Returns whether all of them have one; where one has not, [`LaneSolver::error`] says why, and `out` is NaN.
    ///
    /// # Panics
    /// If a slice has not the stated length.
    pub fn acceleration(
        &mut self,
        t: L,
        q: &[L],
        v: &[L],
        out: &mut [L],
        wanted: impl Fn(usize) -> bool,
    ) -> bool {
        let straight_line = self.prepared.spec().structure.straight_line;
        let mut safe = L::from_f64(0.0);
        if straight_line {
            safe = self.prepared.acceleration(t, q, v, out);
            // A coordinate that no equation contains must not hide that it is not a number.
            safe = safe + zero_if_finite(t, [q, v, out]);
        }
        let mut all = true;
        for lane in (0..L::WIDTH).filter(|&k| wanted(k)) {
            self.errors[lane] = None;
            if self.accepted[lane].has(safe.lane(lane)) {
                self.evaluations[lane] += 1;
            } else {
                all &= self.alone(lane, t, q, v, out);
            }
        }
        all
    }

    /// Solves lane `lane` by its own solver.
    #[cold]
    fn alone(&mut self, lane: usize, t: L, q: &[L], v: &[L], out: &mut [L]) -> bool {
        let mechanism = &self.mechanisms[lane];
        let own = self.own[lane].get_or_insert_with(|| {
            let mut solver = Solver::new(mechanism, SolverOptions::default());
            if self.projected {
                solver.dropping.project();
            }
            Box::new(Own {
                solver,
                state: std::array::from_fn(|_| vec![0.0; mechanism.spec().n()]),
            })
        });
        let [own_q, own_v, own_out] = &mut own.state;
        for (own, all) in [(&mut *own_q, q), (&mut *own_v, v)] {
            own.iter_mut().zip(all).for_each(|(x, y)| *x = y.lane(lane));
        }
        let result = own.solver.acceleration(t.lane(lane), own_q, own_v, own_out);
        self.accepted[lane] = own.solver.dropping.accepted;
        if let Err(error) = result {
            own_out.fill(f64::NAN);
            self.errors[lane] = Some(error);
        }
        for (out, x) in out.iter_mut().zip(own_out) {
            out.set_lane(lane, *x);
        }
        self.errors[lane].is_none()
    }

    /// How near lane `lane` has come to a singular position, as [`Solver::weakest`] has it.
    #[cfg(feature = "ensemble")]
    pub(crate) fn weakest(&self, lane: usize) -> f64 {
        let own = self.own[lane].as_ref();
        own.map_or(1.0, |own| own.solver.weakest())
    }

    /// Why lane `lane` had no acceleration when it was wanted last.
    #[must_use]
    pub fn error(&self, lane: usize) -> Option<&Error> {
        self.errors[lane].as_ref()
    }

    /// What has been done in lane `lane` since its mechanism was set. A fallback is a solution that the lane's own solver had to find in
    /// place of the emitted elimination.
    #[must_use]
    pub fn work(&self, lane: usize) -> SolverWork {
        let own = self.own[lane].as_ref();
        let mut work = own.map_or_else(SolverWork::default, |own| own.solver.work());
        work.evaluations += self.evaluations[lane];
        work
    }
}
