//! Simulation of a mechanism: from a consistent state to a [`Trajectory`].

use std::fmt;
use std::ops::ControlFlow;

use crate::assemble::State;
use crate::diagnose;
use crate::error::Error;
use crate::events::{Event, Watch};
use crate::integrate::{Method, Outcome, Settings, Tolerance};
use crate::mechanism::{Prepared, Spec};
use crate::scan::largest;
use crate::solver::{Formula, Solver, SolverOptions};
use crate::stabilise::{Projector, Stabilisation};
use crate::trajectory::{Ending, Record, Sample, Trajectory, Work};

mod agenda;
mod angles;
#[cfg(feature = "ensemble")]
pub mod ensemble;
mod grid;
mod run;
#[cfg(test)]
mod tests;
mod trouble;

use agenda::{Agenda, Sampling};
use run::{Keeper, Progress, Run, Sink, at};
use trouble::{Conflict, Pace};

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
/// [`PROJECTION_LIMIT`](crate::integrate::PROJECTION_LIMIT) in the norm of error control, the step is rejected and
/// repeated with half its size.
///
/// Where abs, sign, min or max change their branch within a step, it is repeated up to there, unless
/// [`switching`](Simulation::switching) says otherwise.
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

/// What a run does about [switches](crate::SwitchSpec), the zeros at which abs, sign, min and max change their branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Switching {
    /// Steps go onto the zeros, and each step has the full order of its method. A motion that is driven onto a zero from both sides, as at rest under dry
    /// friction, ends with [`Error::Chattering`].
    #[default]
    Located,
    /// Steps go across, and are as short there as their errors demand. A motion that rests on a zero for a while chatters along it.
    Ignored,
}

/// Most samples of [`Simulation::every`]: a slip in its unit must not fill the memory.
const MAX_SAMPLES: f64 = 1e8;

/// A run that failed: why, and the motion up to there.
pub struct Failure {
    /// What happened; [`Error::At`] with time and state if it happened on the way.
    pub error: Error,
    /// Everything up to the last step that succeeded; empty if the run could not start.
    pub trajectory: Box<Trajectory>,
}

impl Simulation {
    /// A simulation of `mechanism` with the defaults: [`Method::Dop853`] at tolerance 1e-9, projection, a sample at each accepted step, at most 10⁷ steps.
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

    /// The integration method.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.method = method;
        self
    }

    /// Tolerance of each step, relative to each coordinate and velocity; from [`SMALLEST_TOLERANCE`] to below 1. The
    /// [absolute](Simulation::absolute_tolerance) one follows it. RATTLE does not look at it.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Absolute tolerance of each step: the error allowed in a coordinate or velocity near zero, in its own unit; positive.
    ///
    /// By default it is the relative one times the size of the start: the largest coordinate or velocity there or, if that is more, the largest length in a
    /// holonomic constraint; but at most times 1. So a mechanism of micrometres is as exact in metres as one of metres. Coordinates of different units share
    /// it: the smallest that matters should decide.
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

    /// The formula for the accelerations.
    #[must_use]
    pub fn formula(mut self, formula: Formula) -> Self {
        self.formula = formula;
        self
    }

    /// Samples at t₀ + k `dt` (t₀ − k `dt` going backward) and at the end, instead of each accepted step.
    ///
    /// Times are the numbers nearest to what is written: 0.3 is taken for three tenths and 1.0 / 3.0 for a third, so that sample 3 lies at 0.9 and 1.
    ///
    /// Samples lie on the interpolant, then are projected; they do not influence the steps. Interpolation by DOP853 adds an
    /// error of some ten tolerances to that which the steps have gathered; measured on swings of a pendulum at tolerances
    /// 1e-4 to 1e-12 against runs that end at the sample times, the largest error of samples was up to 9 times larger within
    /// the first swing, and the same after a few. With DOPRI5 it was at most 1.25 times larger. For a state
    /// at the full accuracy of the steps, let a run end there.
    #[must_use]
    pub fn every(mut self, dt: f64) -> Self {
        self.sampling = Sampling::Every(dt);
        self
    }

    /// Samples at these times and no others, instead of each accepted step; given in the order in which the run passes them. See [`every`](Simulation::every) for their accuracy.
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

    /// Watches an event. Costs the interpolant of each step, as [`dense`](Simulation::dense) does.
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

    /// Largest step size. (The last step may be a hundredth larger, to arrive at the end.)
    #[must_use]
    pub fn max_step(mut self, step: f64) -> Self {
        self.max_step = Some(step);
        self
    }

    /// Size of the first step to be tried.
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
    /// the projection reports, [`Error::StepTooSmall`], [`Error::TooManySteps`], [`Error::Chattering`]. The trajectory up to there is in the [`Failure`].
    pub fn until(self, t_end: f64) -> Result<Trajectory, Failure> {
        self.run(t_end, None)
    }

    /// Runs from the start to `t_end` as [`until`](Simulation::until) does, and hands each sample and each event to `sink` instead of keeping it, so that
    /// memory does not grow with the run. [`CsvWriter`](crate::CsvWriter) writes samples as they come, [`Drift`](crate::Drift) measures them.
    ///
    /// They come in the order in which the run passes them, each once, as soon as its step is accepted; those of the start and the end are among them.
    /// `Break` ends the run after the step in hand, which is no failure; nothing more is handed over then. The trajectory has neither samples nor events, but how the run
    /// [ended](Trajectory::ending), with which [state](Trajectory::last), at what [cost](Trajectory::work). [`dense`](Simulation::dense) keeps the
    /// interpolant all the same.
    ///
    /// # Errors
    /// Those of [`until`](Simulation::until).
    pub fn stream(
        self,
        t_end: f64,
        mut sink: impl FnMut(Record<'_>) -> ControlFlow<()>,
    ) -> Result<Trajectory, Failure> {
        self.run(t_end, Some(&mut sink))
    }

    fn run(self, t_end: f64, sink: Option<Sink<'_>>) -> Result<Trajectory, Failure> {
        let baumgarte = match self.stabilisation {
            Stabilisation::Baumgarte(baumgarte) => Some(baumgarte),
            Stabilisation::Projection | Stabilisation::None => None,
        };
        let options = SolverOptions {
            formula: self.formula,
            baumgarte,
            ..SolverOptions::default()
        };
        let mut trajectory = Trajectory::new(self.mechanism.clone(), options);
        trajectory.watched = self.events.iter().map(|event| event.name.clone()).collect();
        trajectory.projected = self.stabilisation == Stabilisation::Projection;
        let fail = |error, trajectory| Failure {
            error,
            trajectory: Box::new(trajectory),
        };
        if let Err(error) = self.check(t_end, sink.is_none()) {
            return Err(fail(error, trajectory));
        }
        let spec = self.mechanism.spec();
        let mut projector = Projector::new(&self.mechanism);
        let start = self.consistent_start(&mut projector, &mut trajectory.work);
        let (state, tolerance) = match start {
            Ok(start) => start,
            Err(error) => return Err(fail(error, trajectory)),
        };
        let t0 = state.t;
        trajectory.start = t0;
        let mut y = state.q.clone();
        y.extend_from_slice(&state.v);
        trajectory.end = Some(state);
        if self.dense {
            trajectory.segments = Some(Vec::new());
        }
        let settings = Settings {
            tolerance,
            first_step: self.first_step,
            max_step: self.max_step,
            max_steps: self.max_steps,
            dense: self.dense || !self.events.is_empty(),
        };
        let n = spec.n();
        let locate = self.switching == Switching::Located && !spec.switches.is_empty();
        let mut keeper = None;
        if let Method::Rattle { step } = self.method {
            let (q, v) = y.split_at(n);
            let energy = self.mechanism.energy(t0, q, v);
            keeper = Some(Keeper::new(step, energy));
        }
        let mut run = Run {
            keeper,
            located: locate.then(|| self.mechanism.dual()),
            solver: Solver::new(self.mechanism, options),
            projector,
            project: trajectory.projected,
            n,
            agenda: Agenda::new(self.sampling, t0, t_end),
            watch: Watch::new(self.events, n),
            progress: self.progress,
            sink,
            handed: ControlFlow::Continue(()),
            sampled: None,
            t: t0,
            y: y.clone(),
            between: vec![0.0; 2 * n],
            slopes: None,
            conflict: Conflict::default(),
            pace: Pace::new(spec, tolerance, self.max_steps),
            trajectory: &mut trajectory,
        };
        let error = run.start(t0, &y).and_then(|()| {
            if t_end == t0 {
                run.trajectory.ending = Ending::Completed;
                return Ok(());
            }
            if run.handed.is_break() {
                run.trajectory.ending = Ending::Interrupted;
                return Ok(());
            }
            let report = self.method.run(&mut run, t0, &y, t_end, &settings);
            run.trajectory.work.steps = report.steps;
            run.trajectory.work.rejected = report.rejected;
            run.trajectory.work.factorisations = report.factorisations;
            run.trajectory.work.switches = report.landings;
            match report.outcome {
                Outcome::Reached => run.trajectory.ending = Ending::Completed,
                // Given up: the steps allowed would be used up without getting on.
                Outcome::Stopped if run.trajectory.ending == Ending::Failed => {
                    let steps = self.max_steps;
                    let error = run.pace.explain(Error::TooManySteps { steps });
                    return Err(at(run.t, &run.y, error));
                }
                Outcome::Stopped => {}
                Outcome::Failed { t, y, error } => {
                    let (t, y, error) = run.conflict.explain(t, y, run.pace.explain(error));
                    return Err(at(t, &y, error));
                }
            }
            Ok(())
        });
        run.finish();
        match error {
            Ok(()) => Ok(trajectory),
            Err(error) => Err(fail(error, trajectory)),
        }
    }

    /// Ranges of all settings of a run to `t_end` whose samples are `kept` or not.
    fn check(&self, t_end: f64, kept: bool) -> Result<(), Error> {
        let invalid = |what, reason: String| Err(Error::InvalidSetting { what, reason });
        if !(SMALLEST_TOLERANCE..1.0).contains(&self.tolerance) {
            let tolerance = self.tolerance;
            let reason =
                format!("is {tolerance:?}, but {SMALLEST_TOLERANCE:.1e} to below 1 is allowed");
            return invalid("tolerance", reason);
        }
        if !t_end.is_finite() {
            return invalid("t_end", format!("is {t_end}, but must be finite"));
        }
        let dt = match self.sampling {
            Sampling::Every(dt) => Some(dt),
            Sampling::Steps | Sampling::At(_) => None,
        };
        let sizes = [
            ("every", dt),
            ("max_step", self.max_step),
            ("first_step", self.first_step),
            ("absolute_tolerance", self.absolute),
        ];
        for (what, size) in sizes {
            if let Some(size) = size
                && !(size.is_finite() && size > 0.0)
            {
                let reason = format!("is {size:?}, but must be positive and finite");
                return invalid(what, reason);
            }
        }
        if let Method::Rattle { step } = self.method {
            self.check_rattle(step)?;
        }
        if self.max_steps == 0 {
            return invalid("max_steps", "is 0, but must be at least 1".to_owned());
        }
        if let Stabilisation::Baumgarte(b) = self.stabilisation {
            for (what, value) in [("alpha", b.alpha), ("beta", b.beta)] {
                if !(value.is_finite() && value >= 0.0) {
                    let reason = format!("is {value:?}, but must be finite and not negative");
                    return invalid(what, reason);
                }
            }
        }
        let Some(start) = &self.start else {
            let reason = "is missing; give the simulation a state, for example one from `assemble`";
            return invalid("start", reason.to_owned());
        };
        if !(t_end - start.t).is_finite() && start.t.is_finite() {
            return invalid("t_end", format!("is {t_end:?}, too far from {:?}", start.t));
        }
        if let Some(dt) = dt {
            let rounding = f64::EPSILON * start.t.abs().max(t_end.abs());
            if dt <= rounding {
                let reason = format!("is {dt:?}, which is below the rounding of the times");
                return invalid("every", reason);
            }
            let samples = (t_end - start.t).abs() / dt;
            if kept && samples > MAX_SAMPLES {
                let reason = format!(
                    "is {dt:?}, which asks for {samples:.1e} samples; at most {MAX_SAMPLES:.0e} are kept, and any number by `stream`"
                );
                return invalid("every", reason);
            }
        }
        if let Sampling::At(times) = &self.sampling {
            let (low, high) = (start.t.min(t_end), start.t.max(t_end));
            if let Some(t) = times.iter().find(|t| !(low..=high).contains(*t)) {
                let reason = format!("contain {t}, which is not between {low} and {high}");
                return invalid("times", reason);
            }
            let ordered = if t_end < start.t {
                times.is_sorted_by(|a, b| a > b)
            } else {
                times.is_sorted_by(|a, b| a < b)
            };
            if !ordered {
                let reason = "are not in the order in which the run passes them, each once";
                return invalid("times", reason.to_owned());
            }
        }
        Ok(())
    }

    /// Whether RATTLE with steps of `step` fits the mechanism and the other settings.
    fn check_rattle(&self, step: f64) -> Result<(), Error> {
        let spec = self.mechanism.spec();
        let invalid = |what, reason: String| Err(Error::InvalidSetting { what, reason });
        if !(step.is_finite() && step > 0.0) {
            let reason = format!("is {step:?}, but must be positive and finite");
            return invalid("step", reason);
        }
        let structure = &spec.structure;
        let obstacle = if let Some(i) = structure.massless.first() {
            format!("`{}` has no mass", spec.coords[*i])
        } else if let Some(c) = spec.constraints.get(spec.holonomic) {
            format!("`{}` is a nonholonomic constraint", c.name)
        } else if !structure.mass_constant {
            "the mass matrix is not constant".to_owned()
        } else if !structure.conservative {
            "there are other forces than those from a potential, or explicit time".to_owned()
        } else {
            String::new()
        };
        if !obstacle.is_empty() {
            let reason = format!(
                "is RATTLE, which `{}` does not admit, because {obstacle}; take `Method::Dop853`",
                spec.name
            );
            return invalid("method", reason);
        }
        if let Stabilisation::Baumgarte(_) = self.stabilisation {
            let reason = "is Baumgarte's, but RATTLE keeps the constraints by itself; leave it out";
            return invalid("stabilise", reason.to_owned());
        }
        let sizes = [("first_step", self.first_step), ("max_step", self.max_step)];
        if let Some((what, _)) = sizes.into_iter().find(|(_, size)| size.is_some()) {
            let reason = "is given, but RATTLE has its own step; leave it out";
            return invalid(what, reason.to_owned());
        }
        Ok(())
    }

    /// The start, checked and projected, and the tolerance of a run from there.
    fn consistent_start(
        &self,
        projector: &mut Projector,
        work: &mut Work,
    ) -> Result<(State, Tolerance), Error> {
        let spec = self.mechanism.spec();
        let Some(State { t, q, v }) = self.start.clone() else {
            let what = "start";
            let reason = "is missing".to_owned();
            return Err(Error::InvalidSetting { what, reason });
        };
        diagnose::check_length("q", q.len(), spec.n())?;
        diagnose::check_length("v", v.len(), spec.n())?;
        let mech = &self.mechanism;
        if let Some(error) = diagnose::bad_input(mech, t, &q, &v) {
            return Err(error);
        }
        angles::check(spec, &q)?;
        let (mut new_q, mut new_v) = (q.clone(), v.clone());
        let position = projector.position(t, &mut new_q, &v)?;
        let mut size = largest(&q).max(largest(&v));
        if size > 0.0 && size < 1.0 {
            // Coordinates may be measured from where they start; rounding, for one, is then not that of their size.
            size = size.max(projector.length(t, &new_q, &v));
        }
        let tolerance = self.tolerance_of(size);
        let absolute = tolerance.absolute;
        if !near(&q, &new_q, absolute) {
            let mut residual = vec![0.0; spec.holonomic];
            mech.residual(t, &q, &mut residual);
            return Err(off_constraint(spec, "position", &residual));
        }
        let velocity = projector.velocity(t, &new_q, &mut new_v)?;
        if !near(&v, &new_v, absolute) {
            let mut residual = vec![0.0; spec.m()];
            mech.residual_rate(t, &new_q, &v, &mut residual);
            return Err(off_constraint(spec, "velocity", &residual));
        }
        work.projections += 1;
        work.projection_iterations += position.iterations + velocity.iterations;
        let state = State {
            t,
            q: new_q,
            v: new_v,
        };
        Ok((state, tolerance))
    }

    /// The tolerance of a run whose start has this size.
    fn tolerance_of(&self, size: f64) -> Tolerance {
        // A start at zero in all coordinates has no size.
        let size = if size > 0.0 { size.min(1.0) } else { 1.0 };
        Tolerance {
            relative: self.tolerance,
            absolute: self.absolute.unwrap_or(self.tolerance * size),
        }
    }
}

/// Whether a projection from `before` to `after` is within [`START_BOUND`] and the absolute tolerance.
fn near(before: &[f64], after: &[f64], absolute: f64) -> bool {
    let bound = START_BOUND * largest(before) + absolute;
    let mut pairs = before.iter().zip(after);
    pairs.all(|(before, after)| (after - before).abs() <= bound)
}

fn off_constraint(spec: &Spec, level: &'static str, residual: &[f64]) -> Error {
    let scale = vec![1.0; residual.len()];
    Error::OffConstraint {
        level,
        constraints: diagnose::offending(spec, residual, &scale),
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

/// As `Display`: `main` prints the error it returns by `Debug`.
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
