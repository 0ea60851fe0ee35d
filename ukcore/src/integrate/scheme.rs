//! What a run asks of a method.
//!
//! The loop over steps, their ends, projections, failures and samples is [`driver`](super::driver)'s and the same for all methods. A
//! [`Scheme`] makes one step at a time and says how long the next one should be.

use super::control::StepSize;
use super::sample::Sample;
use super::switches::Switches;
use super::trouble::{Cause, Conflict, Trouble};
use super::{Problem, Tolerance};
use crate::error::Error;

/// The problem's functions over s, the signed time since the start of the run, and what they were found to do.
pub(super) struct Equations<'p> {
    pub(super) problem: &'p mut (dyn Problem + 'p),
    pub(super) t0: f64,
    pub(super) switches: Switches,
    pub(super) conflict: Conflict,
    /// f is that at the nearest consistent state, as near a singular position.
    pub(super) nearby: bool,
    consistent: Vec<f64>,
}

impl<'p> Equations<'p> {
    pub(super) fn new(problem: &'p mut (dyn Problem + 'p), t0: f64, switches: Switches) -> Self {
        Equations {
            problem,
            t0,
            switches,
            conflict: Conflict::default(),
            nearby: false,
            consistent: Vec::new(),
        }
    }

    /// y' at (s, y) into `rate`.
    pub(super) fn rate(&mut self, s: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Cause> {
        if self.nearby {
            return self.rate_nearby(s, y, rate);
        }
        let at = Sample::of(self.t0 + s, y);
        let (q_rate, v_rate) = rate.split_at_mut(at.q.len());
        q_rate.copy_from_slice(at.v);
        self.acceleration(at, v_rate)
    }

    /// The same at the nearest consistent state.
    fn rate_nearby(&mut self, s: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Cause> {
        let mut nearby = std::mem::take(&mut self.consistent);
        nearby.clear();
        nearby.extend_from_slice(y);
        let t = self.t0 + s;
        let (q, v) = nearby.split_at_mut(y.len() / 2);
        let projected = self.problem.project(t, q, v);
        let result = match projected {
            Ok(()) => {
                let at = Sample::of(t, &nearby);
                let (q_rate, v_rate) = rate.split_at_mut(at.q.len());
                q_rate.copy_from_slice(at.v);
                self.acceleration(at, v_rate)
            }
            Err(error) => Err(self.refuse(Sample::of(t, y), error)),
        };
        self.consistent = nearby;
        result
    }

    /// q̈ at a state into `out`.
    pub(super) fn acceleration(&mut self, at: Sample<'_>, out: &mut [f64]) -> Result<(), Cause> {
        self.switches.look(self.problem, at);
        let result = self.problem.acceleration(at, out);
        result.map_err(|error| self.refuse(at, error))
    }

    /// [`Problem::jacobian`] at (s, y), with y' into `rate` and 0 for derivatives that do not exist: iterations that use it go on as well
    /// as they can without.
    pub(super) fn jacobian(
        &mut self,
        s: f64,
        y: &[f64],
        rate: &mut [f64],
        out: &mut [f64],
    ) -> Result<(), Cause> {
        let at = Sample::of(self.t0 + s, y);
        let (q_rate, v_rate) = rate.split_at_mut(at.q.len());
        q_rate.copy_from_slice(at.v);
        let result = self.problem.jacobian(at, v_rate, out);
        result.map_err(|error| self.refuse(at, error))?;
        let broken = out.iter_mut().filter(|x| !x.is_finite());
        broken.for_each(|x| *x = 0.0);
        Ok(())
    }

    fn refuse(&mut self, at: Sample<'_>, error: Error) -> Cause {
        self.conflict.note(at, &error);
        Trouble::cause(at, error)
    }
}

/// A step to be tried.
#[derive(Clone, Copy)]
pub(super) struct Attempt {
    /// Where it starts and where it ends.
    pub(super) s: f64,
    pub(super) s_end: f64,
    /// Its signed size.
    pub(super) h: f64,
    /// Of the run.
    pub(super) tolerance: Tolerance,
    /// It is the first step, or one that is tried again.
    pub(super) unproven: bool,
}

/// A one-step method: buffers, what the last attempt left in them, and the choice of the step size.
///
/// For each step come [`attempt`](Scheme::attempt), a projection of [`state_mut`](Scheme::state_mut), [`close`](Scheme::close),
/// [`interpolate`](Scheme::interpolate) if wanted, [`advance`](Scheme::advance), [`accepted`](Scheme::accepted). Where one of them fails,
/// what follows is left out, [`inaccurate`](Scheme::inaccurate) or [`unfit`](Scheme::unfit) shortens the step, and it is tried again.
pub(super) trait Scheme {
    /// Evaluates f at (s, y), at the start of the run or where f has changed there: nothing before counts any more.
    fn begin(&mut self, equations: &mut Equations<'_>, s: f64, y: &[f64]) -> Result<(), Cause>;

    /// Size of the first step, at most `largest`, going in the direction `sign`. Comes after [`begin`](Scheme::begin).
    fn first_size(
        &mut self,
        equations: &mut Equations<'_>,
        y: &[f64],
        sign: f64,
        tolerance: Tolerance,
        largest: f64,
    ) -> f64;

    /// Makes the step from `y` up to its unprojected end. Returns its error in the [error norm](super); 0 if that is known only when the
    /// step is closed.
    fn attempt(
        &mut self,
        equations: &mut Equations<'_>,
        step: Attempt,
        y: &[f64],
    ) -> Result<f64, Cause>;

    /// State at the end of the attempted step.
    fn state(&self) -> &[f64];

    /// The same, to be projected before the step is closed.
    fn state_mut(&mut self) -> &mut [f64];

    /// Whether that state is on the constraints by the method's own doing, and not to be projected.
    fn keeps_constraints(&self) -> bool {
        false
    }

    /// Evaluates f at the end of the attempted step. Returns its error if that is known only now, else 0.
    fn close(
        &mut self,
        equations: &mut Equations<'_>,
        step: Attempt,
        y: &[f64],
    ) -> Result<f64, Cause>;

    /// Makes the [coefficients](Scheme::dense) of the interpolant of the closed step.
    fn interpolate(
        &mut self,
        equations: &mut Equations<'_>,
        step: Attempt,
        y: &[f64],
    ) -> Result<(), Cause>;

    /// Coefficients of the interpolant, rows as [`Interpolant`](super::dense::Interpolant) wants them.
    fn dense(&self) -> &[f64];

    /// Moves `y`, and itself, on to the end of the closed step.
    fn advance(&mut self, y: &mut [f64]);

    /// Size of the step after one of size `h` > 0 that was accepted with the error `error`; `size` is what is remembered of those before.
    fn accepted(&mut self, size: &mut StepSize, h: f64, error: f64) -> f64;

    /// Size of the next attempt after one of size `h` with an error above 1; NaN where the step could not be made.
    fn inaccurate(&mut self, size: &mut StepSize, h: f64, error: f64) -> f64;

    /// Size of the next attempt after one of size `h` whose end did not do.
    fn unfit(&mut self, size: &mut StepSize, h: f64) -> f64 {
        size.unfit(h)
    }

    /// Where the widest gap between the times of stages begins and ends, as shares of the step; `None` where steps are of one size, and
    /// cannot be put so that a place lies in it.
    fn gap(&self) -> Option<[f64; 2]>;

    /// Factorisations so far.
    fn factorisations(&self) -> usize {
        0
    }
}
