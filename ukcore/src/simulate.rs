//! Simulation of a mechanism: from a consistent state to a [`Trajectory`].

use std::fmt;
use std::ops::ControlFlow;
use std::str::FromStr;

use crate::assemble::State;
use crate::error::Error;
use crate::manifold::Stabilisation;
use crate::mechanism::Prepared;
use crate::solver::{Formula, Solver, SolverOptions};

pub use crate::events::{Direction, Event, EventHit};
pub use crate::integrate::{Method, PROJECTION_LIMIT};
pub use crate::trajectory::{CsvWriter, Drift, Ending, Record, Residual, Sample, Trajectory, Work};
#[cfg(feature = "ensemble")]
pub use ensemble::{Ensemble, Member};

mod agenda;
mod check;
mod crossing;
mod energy;
#[cfg(feature = "ensemble")]
mod ensemble;
mod grid;
mod independence;
mod integrals;
mod leaves;
mod locked;
mod obstacles;
mod record;
mod run;
mod standstill;
mod start;
#[cfg(test)]
mod tests;
mod vanishing;

use agenda::Sampling;
use energy::EnergyWatch;
use record::Sink;
use run::{Progress, Run};
use vanishing::RowWatch;

/// How far a start may be off the constraints: projection may move a coordinate by this part of the largest one (a
/// velocity likewise), plus the tolerance of the run.
///
/// Six digits are what tables and papers print; a state further away is another state, and is refused with the names of
/// the constraints rather than silently replaced. [`assemble`](crate::assemble()) takes rougher guesses.
pub const START_BOUND: f64 = 1e-6;

/// Smallest tolerance accepted: ten units of rounding. Below, the error estimate is rounding alone, and steps shrink to nothing.
pub const SMALLEST_TOLERANCE: f64 = 10.0 * f64::EPSILON;

/// A simulation: settings, then [`until`](Simulation::until).
///
/// Each accepted step is projected back onto the constraints, at position and velocity level, unless
/// [`stabilise`](Simulation::stabilise) says otherwise; so are samples and events within steps. (RATTLE needs no projection of its steps.)
///
/// A projection does not make a bad step a good one: where it moves the state by more than
/// [`PROJECTION_LIMIT`] in the norm of error control, the step is rejected and
/// repeated with half its size.
///
/// Where constraints come to imply the others and branches of the motion cross, it goes on in the branch it came on, its velocity without a
/// jump; where rounding does not tell whether they do, or a constraint has no gradient and leaves more than one way to go on, the run ends
/// before with [`Error::Singular`].
///
/// Where abs, sign, min or max change their branch within a step, it is repeated up to there, unless [`switching`](Simulation::switching)
/// says otherwise. A length that the equations divide by, as in v/|v|, is stepped across: a motion that passes straight through its zero
/// has the error of a jump there; one that comes to rest ends with [`Error::Chattering`].
pub struct Simulation {
    mechanism: Prepared,
    start: Option<State>,
    method: Method,
    tolerance: f64,
    absolute: Option<f64>,
    stabilisation: Stabilisation,
    switching: Switching,
    formula: Formula,
    sampling: Sampling,
    dense: bool,
    events: Vec<Event>,
    max_steps: usize,
    max_step: Option<f64>,
    first_step: Option<f64>,
    progress: Option<Progress>,
}

/// What a run does about [switches](crate::spec::SwitchSpec), the zeros at which abs, sign, min and max change their branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Switching {
    /// Steps go onto the zeros, and each step has the full order of its method. A motion that is driven onto a zero from both sides, as
    /// at rest under dry friction, ends with [`Error::Chattering`].
    #[default]
    Located,
    /// Steps go across, and are as short there as their errors demand. A motion that rests on a zero for a while chatters along it, in
    /// steps of about the tolerance over the jump of the acceleration: one second at rest may take millions.
    Ignored,
}

/// Reads `located` or `ignored`.
impl FromStr for Switching {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        match text {
            "located" => Ok(Switching::Located),
            "ignored" => Ok(Switching::Ignored),
            _ => {
                let reason = format!("is `{text}`; it is `located` or `ignored`");
                Err(Error::invalid("switching", reason))
            }
        }
    }
}

/// A run that failed: why, and the motion up to there.
pub struct Failure {
    /// What happened; [`Error::At`] with time and state if it happened on the way.
    pub error: Error,
    /// Everything up to the last step that succeeded; empty if the run could not start.
    pub trajectory: Box<Trajectory>,
}

impl Simulation {
    /// A simulation of `mechanism` with the defaults: [`Method::Dop853`] at tolerance 1e-9, projection, a sample at each accepted step, at
    /// most 10⁷ steps.
    pub fn new(mechanism: impl Into<Prepared>) -> Self {
        Simulation {
            mechanism: mechanism.into(),
            start: None,
            method: Method::default(),
            tolerance: 1e-9,
            absolute: None,
            stabilisation: Stabilisation::default(),
            switching: Switching::default(),
            formula: Formula::default(),
            sampling: Sampling::Steps,
            dense: false,
            events: Vec::new(),
            max_steps: 10_000_000,
            max_step: None,
            first_step: None,
            progress: None,
        }
    }

    /// Starts at `state`, which must satisfy the constraints up to [`START_BOUND`]; it is then projected onto them.
    #[must_use]
    pub fn start(mut self, state: State) -> Self {
        self.start = Some(state);
        self
    }

    /// Sets the integration method.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.method = method;
        self
    }

    /// Tolerance of each step, relative to each coordinate and velocity; from [`SMALLEST_TOLERANCE`] to below 1. The
    /// [absolute](Simulation::absolute_tolerance) one follows it. RATTLE does not look at it.
    ///
    /// Hard springs make forces of the rounding of coordinates. In a long run by an explicit method with a tolerance below that, steps
    /// are not refined past it, and [`Work::rounded`] counts them.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Absolute tolerance of each step: the error allowed in a coordinate or velocity near zero; positive. It is one plain number for all
    /// of them, in metres or radians, or in these by a second, whatever each is: the smallest that matters should decide.
    ///
    /// By default each coordinate has its own, the relative one times what is small for it. That is the size of the start (the largest
    /// coordinate or velocity there or, if that is more, the largest length in a holonomic constraint), but at most what takes the
    /// mechanism into another shape: a turn by a radian, or the length of the shortest rod where nothing turns. The constraints tell what
    /// of a length a radian is worth. So a mechanism with lengths in its constraints takes the same steps in micrometres, metres and
    /// kilometres. Where there is neither an angle nor a curved constraint, nothing tells what is large, and the size is at most 1: of
    /// coordinates of 1e9 m that move by metres those metres count. Velocities have the same numbers as their coordinates, by the unit of
    /// time, or less where the motion is slower at its start and by its acceleration there, or a ten-thousandth of these where
    /// that is more.
    #[must_use]
    pub fn absolute_tolerance(mut self, tolerance: f64) -> Self {
        self.absolute = Some(tolerance);
        self
    }

    /// How drift off the constraints is kept down. The start is projected in any case.
    #[must_use]
    pub fn stabilise(mut self, stabilisation: Stabilisation) -> Self {
        self.stabilisation = stabilisation;
        self
    }

    /// What becomes of the kinks and jumps of abs, sign, min and max. Without effect where the equations of motion have none.
    #[must_use]
    pub fn switching(mut self, switching: Switching) -> Self {
        self.switching = switching;
        self
    }

    /// Sets the formula for the accelerations.
    #[must_use]
    pub fn formula(mut self, formula: Formula) -> Self {
        self.formula = formula;
        self
    }

    /// Samples at t₀ + k `dt` (t₀ − k `dt` going backward) and at the end, instead of each accepted step.
    ///
    /// Times are the numbers nearest to what is written: 0.3 is taken for three tenths and 1.0 / 3.0 for a third, so that sample 3 lies at
    /// 0.9 and 1.
    ///
    /// Samples lie on the interpolant, then are projected; they do not influence the steps. Interpolation by DOP853 adds an
    /// error of some ten tolerances to that which the steps have gathered; measured on swings of a pendulum at tolerances
    /// 1e-4 to 1e-12 against runs that end at the sample times, the largest error of samples was up to 9 times larger within
    /// the first swing, and the same after a few. With DOPRI5 it was at most 1.25 times larger. The interpolant of Radau5 is of order 3,
    /// its steps are of order 5: within the first swing 1.4 times at 1e-4, 22 at 1e-10, 71 at 1e-12, and the same after ten. For a state
    /// at the full accuracy of the steps, let a run end there.
    #[must_use]
    pub fn every(mut self, dt: f64) -> Self {
        self.sampling = Sampling::Every(dt);
        self
    }

    /// Samples at these times and no others, instead of each accepted step; given in the order in which the run passes them. What is beyond
    /// an end of the run by rounding, as multiples of a step and their sums may be, is that end. See [`every`](Simulation::every) for their
    /// accuracy.
    #[must_use]
    pub fn at(mut self, times: Vec<f64>) -> Self {
        self.sampling = Sampling::At(times);
        self
    }

    /// Keeps the interpolant, for [`Trajectory::at`]. Costs three evaluations a step with DOP853, none with the other methods, and memory.
    #[must_use]
    pub fn dense(mut self) -> Self {
        self.dense = true;
        self
    }

    /// Watches an event. Costs the interpolant of each step, as [`dense`](Simulation::dense) does. Events may share a name, which then
    /// stands for all of them.
    #[must_use]
    pub fn event(mut self, event: Event) -> Self {
        self.events.push(event);
        self
    }

    /// Largest number of attempted steps, at least 1.
    #[must_use]
    pub fn max_steps(mut self, steps: usize) -> Self {
        self.max_steps = steps;
        self
    }

    /// Sets the largest step size. The last step may be a hundredth larger, to arrive at the end.
    #[must_use]
    pub fn max_step(mut self, step: f64) -> Self {
        self.max_step = Some(step);
        self
    }

    /// Sets the size of the first step to be tried.
    #[must_use]
    pub fn first_step(mut self, step: f64) -> Self {
        self.first_step = Some(step);
        self
    }

    /// Calls `f` after every accepted step with the state that the run has reached; `Break` ends the run there, which is no failure.
    #[must_use]
    pub fn progress(mut self, f: impl FnMut(Sample<'_>) -> ControlFlow<()> + 'static) -> Self {
        self.progress = Some(Box::new(f));
        self
    }

    /// Runs from the start to `t_end`, which may lie before it.
    ///
    /// # Errors
    /// [`Error::InvalidSetting`] for settings outside of their range; [`Error::WrongLength`], [`Error::NonFinite`] or
    /// [`Error::OffConstraint`] for a bad start; on the way [`Error::At`] with time, state and cause: what the solver or
    /// the projection reports, [`Error::StepTooSmall`], [`Error::TooLate`], [`Error::TooManySteps`], [`Error::Chattering`]. The trajectory
    /// up to there is in the [`Failure`].
    pub fn until(self, t_end: f64) -> Result<Trajectory, Failure> {
        self.run(t_end, None)
    }

    /// Runs from the start to `t_end` as [`until`](Simulation::until) does, and hands each sample and each event to `sink` instead of
    /// keeping it, so that memory does not grow with the run. [`CsvWriter`] writes samples as they come, [`Drift`] measures them.
    ///
    /// They come in the order in which the run passes them, each once, as soon as its step is accepted; those of the start and the end
    /// are among them. `Break` ends the run after the step in hand, which is no failure; nothing more is handed over then. The trajectory
    /// has neither samples nor events, but how the run [ended](Trajectory::ending), with which [state](Trajectory::last), at what
    /// [cost](Trajectory::work). [`dense`](Simulation::dense) keeps the interpolant all the same.
    ///
    /// # Errors
    /// What [`until`](Simulation::until) reports.
    pub fn stream(
        self,
        t_end: f64,
        mut sink: impl FnMut(Record<'_>) -> ControlFlow<()>,
    ) -> Result<Trajectory, Failure> {
        self.run(t_end, Some(&mut sink))
    }

    fn run(mut self, t_end: f64, sink: Option<Sink<'_>>) -> Result<Trajectory, Failure> {
        let failure = |error, trajectory| Failure {
            error,
            trajectory: Box::new(trajectory),
        };
        let admitted = self.admit(t_end, sink);
        let (recorder, start, settings) =
            admitted.map_err(|error| failure(error, self.trajectory()))?;
        let has_switches = !self.mechanism.spec().switches.is_empty();
        let (located, energy) = match self.method {
            // Its steps are of one size: they go across switches, as do those made in their place.
            Method::Rattle { step } => {
                let first = self.mechanism.energy(start.t, &start.q, &start.v);
                (false, Some(EnergyWatch::new(step, first)))
            }
            _ => (self.switching == Switching::Located, None),
        };
        let mut solver = Solver::new(&self.mechanism, recorder.trajectory.options);
        match recorder.trajectory.projected {
            true => solver.dropping.project(),
            false => solver.dropping.keep(),
        }
        let mut run = Run {
            solver,
            located,
            sloped: has_switches.then(|| self.mechanism.sloped()),
            along: has_switches.then(|| self.mechanism.along()),
            noise: None,
            locked: None,
            columns: None,
            energy,
            recorder,
            progress: self.progress,
            t_end,
            weakest: 1.0,
            nearest: None,
            stands: start.t,
            provisional: false,
            rows: RowWatch::new(self.method, settings.tolerance.relative),
        };
        let result = run.integrate(Sample::from(&start), self.method, &settings);
        let trajectory = run.finish();
        match result {
            Ok(()) => Ok(trajectory),
            Err(error) => Err(failure(error, trajectory)),
        }
    }

    fn solver_options(&self) -> SolverOptions {
        let baumgarte = match self.stabilisation {
            Stabilisation::Baumgarte(baumgarte) => Some(baumgarte),
            Stabilisation::Projection | Stabilisation::None => None,
        };
        SolverOptions {
            formula: self.formula,
            baumgarte,
            ..SolverOptions::default()
        }
    }
}

impl fmt::Debug for Simulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("mechanism", &self.mechanism.spec().name)
            .field("start", &self.start)
            .field("method", &self.method)
            .field("tolerance", &self.tolerance)
            .field("absolute", &self.absolute)
            .field("stabilisation", &self.stabilisation)
            .field("formula", &self.formula)
            .field("sampling", &self.sampling)
            .field("dense", &self.dense)
            .field("events", &self.events)
            .finish_non_exhaustive()
    }
}

/// Writes the failure as `Display` does: `main` prints the error it returns by `Debug`.
impl fmt::Debug for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "simulation of `{}` failed: {}",
            self.trajectory.spec().name,
            self.error
        )
    }
}

impl std::error::Error for Failure {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        // The error itself is part of the message.
        self.error.source()
    }
}
