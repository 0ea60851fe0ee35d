//! What a run asks of a method.
//!
//! The loop over steps, their ends, projections, failures and samples is [`driver`](super::driver)'s and the same for all methods. A
//! [`Scheme`] makes one step at a time and says how long the next one should be.

use super::course::{Course, Trial};
use super::sample::Sample;
use super::stepper::Rates;
use super::switches::Switches;
use super::trouble::Cause;
use super::{Problem, Tolerance};

/// The problem's functions over s, the signed time since the start of the run, and what they were found to do.
pub(super) struct Equations<'p> {
    pub(super) problem: &'p mut (dyn Problem + 'p),
    pub(super) switches: Switches,
    pub(super) course: Course,
    /// f is that at the nearest consistent state, as near a singular position.
    pub(super) nearby: bool,
    pub(super) consistent: Vec<f64>,
}

impl Rates<f64> for Equations<'_> {
    type Error = Cause;

    fn rate(&mut self, s: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Cause> {
        let (q_rate, v_rate) = rate.split_at_mut(y.len() / 2);
        q_rate.copy_from_slice(&y[v_rate.len()..]);
        self.acceleration(s, y, v_rate)?;
        if self.nearby {
            q_rate.copy_from_slice(&self.consistent[v_rate.len()..]);
        }
        Ok(())
    }
}

impl Equations<'_> {
    /// The state y = [q; q̇] at s.
    pub(super) fn at<'y>(&self, s: f64, y: &'y [f64]) -> Sample<'y> {
        Sample::of(self.course.t0 + s, y)
    }

    /// The consistent state that is nearest to (s, y), in the buffer for it.
    #[cold]
    fn nearest(&mut self, s: f64, y: &[f64]) -> Result<Vec<f64>, Cause> {
        let mut nearest = std::mem::take(&mut self.consistent);
        nearest.clear();
        nearest.extend_from_slice(y);
        let (q, v) = nearest.split_at_mut(y.len() / 2);
        let projected = self.problem.project(self.course.t0 + s, q, v);
        projected.map_err(|error| self.course.note(self.at(s, y), error))?;
        Ok(nearest)
    }

    /// q̈ at (s, y) into `out`.
    pub(super) fn acceleration(&mut self, s: f64, y: &[f64], out: &mut [f64]) -> Result<(), Cause> {
        if self.nearby {
            let nearest = self.nearest(s, y)?;
            let result = self.evaluate(s, &nearest, out);
            self.consistent = nearest;
            return result;
        }
        self.evaluate(s, y, out)
    }

    #[inline(always)]
    fn evaluate(&mut self, s: f64, y: &[f64], out: &mut [f64]) -> Result<(), Cause> {
        if !self.switches.is_empty() {
            let at = self.at(s, y);
            self.switches.look(self.problem, at);
        }
        // One that were kept for an error would be copied at each evaluation.
        let result = self.problem.acceleration(self.at(s, y), out);
        result.map_err(|error| self.course.note(self.at(s, y), error))
    }

    /// [`Problem::jacobian`] at (s, y), with q̈ into `acceleration` and 0 for derivatives that do not exist: iterations that use it go on
    /// as well as they can without.
    pub(super) fn jacobian(
        &mut self,
        s: f64,
        y: &[f64],
        acceleration: &mut [f64],
        out: &mut [f64],
    ) -> Result<(), Cause> {
        let at = self.at(s, y);
        let result = self.problem.jacobian(at, acceleration, out);
        result.map_err(|error| self.course.note(at, error))?;
        let broken = out.iter_mut().filter(|x| !x.is_finite());
        broken.for_each(|x| *x = 0.0);
        Ok(())
    }
}

/// A one-step method: the state where the run stands, what the last attempt to step from there left, and the choice of the step size.
/// States are y = [q; q̇].
///
/// For each step come [`attempt`](Scheme::attempt), a projection of [`end_mut`](Scheme::end_mut), [`close`](Scheme::close),
/// [`interpolate`](Scheme::interpolate) if wanted, [`advance`](Scheme::advance), [`accepted`](Scheme::accepted). Where one of them fails,
/// what follows is left out, [`inaccurate`](Scheme::inaccurate) or [`unfit`](Scheme::unfit) shortens the step, and it is tried again.
pub(super) trait Scheme {
    /// State at the start of a step, where the run stands, and at the end of the attempted step.
    fn states(&self) -> [&[f64]; 2];

    /// State at the start of a step.
    fn start(&self) -> &[f64] {
        self.states()[0]
    }

    /// State at the end of the attempted step.
    fn end(&self) -> &[f64] {
        self.states()[1]
    }

    /// State at the end of the attempted step, to be projected before the step is closed.
    fn end_mut(&mut self) -> &mut [f64];

    /// Whether that state is on the constraints by the method's own doing, and not to be projected.
    fn keeps_constraints(&self) -> bool {
        false
    }

    /// Evaluates f where the run stands, at its start or where f has changed there: nothing before counts any more.
    fn begin(&mut self, equations: &mut Equations<'_>) -> Result<(), Cause>;

    /// Signed size of the first step, at most `largest`. Comes after [`begin`](Scheme::begin).
    fn first_size(&mut self, equations: &mut Equations<'_>, largest: f64) -> f64;

    /// Makes the step up to its unprojected end. Returns its error in the [error norm](super); 0 if that is known only when the step is
    /// closed.
    fn attempt(&mut self, equations: &mut Equations<'_>, step: Trial) -> Result<f64, Cause>;

    /// Evaluates f at the end of the attempted step. Returns its error if that is known only now, else 0.
    fn close(&mut self, equations: &mut Equations<'_>, step: Trial) -> Result<f64, Cause>;

    /// Makes the coefficients of the interpolant of the closed step, if closing did not, for [`dense`](Scheme::dense).
    fn interpolate(&mut self, _equations: &mut Equations<'_>, _step: Trial) -> Result<(), Cause> {
        Ok(())
    }

    /// Coefficients of the interpolant, rows as [`Interpolant`](super::dense::Interpolant) wants them.
    fn dense(&self) -> &[f64];

    /// Gives [`error`](Scheme::error) of the closed step the size `norm` in the error norm.
    fn scale_error(&mut self, _norm: f64) {}

    /// What the state at the end of the closed step is thought to be off; `None` where there is no telling.
    fn error(&self) -> Option<&[f64]> {
        None
    }

    /// Moves on to the end of the closed step.
    fn advance(&mut self);

    /// Size of the step after one of size `h` that was accepted with the error `error`. Sizes here and below are signed.
    fn accepted(&mut self, h: f64, error: f64) -> f64;

    /// Size of the next attempt after one of size `h` with an error above 1; NaN where the step could not be made.
    fn inaccurate(&mut self, h: f64, error: f64) -> f64;

    /// Size of the next attempt after one of size `h` whose end did not do.
    fn unfit(&mut self, h: f64) -> f64;

    /// Gives the steps from the next attempt on this tolerance.
    fn tolerate(&mut self, _tolerance: &Tolerance) {}

    /// The times between which no stage lies, in the widest such gap, as shares of the step; `None` where steps are of one size, and cannot
    /// be put so that a place lies in it.
    fn gap(&self) -> Option<[f64; 2]> {
        None
    }

    /// Factorisations so far.
    fn factorisations(&self) -> usize {
        0
    }
}
