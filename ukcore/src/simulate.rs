//! Simulation of a mechanism: from a consistent state to a [`Trajectory`].

use std::fmt;
use std::ops::ControlFlow;

use crate::assemble::State;
use crate::error::Error;
use crate::events::{Event, EventHit, States, Watch};
use crate::integrate::{Method, Next, Outcome, Problem, Settings, Step};
use crate::mechanism::Mechanism;
use crate::solver::{Formula, Solver, SolverOptions};
use crate::stabilise::{Projector, Stabilisation};
use crate::trajectory::{Ending, Trajectory, Work};

/// How far a start may be off the constraints: projection may move a coordinate by this part of the largest one (a
/// velocity likewise), plus the tolerance of the run.
///
/// Six digits are what tables and papers print; a state further away is another state, and is refused with the names of
/// the constraints rather than silently replaced. [`assemble`](crate::assemble()) takes rougher guesses.
pub const START_BOUND: f64 = 1e-6;

/// Smallest tolerance accepted: ten units of rounding. Below, the error estimate is rounding alone, and steps shrink to nothing.
pub const SMALLEST_TOLERANCE: f64 = 10.0 * f64::EPSILON;

/// A constraint is named in [`Error::OffConstraint`] if its residual exceeds this part of the largest one; smaller ones are side effects.
const NAMED_PART: f64 = 1e-3;

/// A sample within so many units of rounding of the end time is the end: k dt and t_end are rounded once each.
const SAME_TIME: f64 = 4.0 * f64::EPSILON;

#[derive(Debug, Clone)]
enum Sampling {
    Steps,
    Every(f64),
    At(Vec<f64>),
}

type Progress = Box<dyn FnMut(f64) -> ControlFlow<()>>;

/// A simulation: settings, then [`until`](Simulation::until).
///
/// Each accepted step is projected back onto the constraints, at position and velocity level, unless
/// [`stabilise`](Simulation::stabilise) says otherwise; so are samples and events within steps.
///
/// A projection does not make a bad step a good one: where it moves the state by more than
/// [`PROJECTION_LIMIT`](crate::integrate::PROJECTION_LIMIT) in the norm of error control, the step is rejected and
/// repeated with half its size.
pub struct Simulation<M> {
    mechanism: M,
    start: Option<State>,
    method: Method,
    tolerance: f64,
    stabilisation: Stabilisation,
    formula: Formula,
    sampling: Sampling,
    dense: bool,
    events: Vec<Event>,
    max_steps: usize,
    max_step: Option<f64>,
    first_step: Option<f64>,
    progress: Option<Progress>,
}

/// A run that failed: why, and the motion up to there.
pub struct Failure<M> {
    /// What happened; [`Error::At`] with time and state if it happened on the way.
    pub error: Error,
    /// Everything up to the last step that succeeded; empty if the run could not start.
    pub trajectory: Box<Trajectory<M>>,
}

impl<M: Mechanism> Simulation<M> {
    /// A simulation of `mechanism` with the defaults: [`Method::Dop853`] at tolerance 1e-9, projection, a sample at each accepted step, at most 10⁷ steps.
    pub fn new(mechanism: M) -> Self {
        Simulation {
            mechanism,
            start: None,
            method: Method::default(),
            tolerance: 1e-9,
            stabilisation: Stabilisation::default(),
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

    /// Relative and absolute tolerance of each step, per coordinate and velocity; from [`SMALLEST_TOLERANCE`] to below 1.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// How drift off the constraints is kept down. The start is projected in any case.
    #[must_use]
    pub fn stabilise(mut self, stabilisation: Stabilisation) -> Self {
        self.stabilisation = stabilisation;
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
    /// Samples lie on the interpolant, then are projected; they do not influence the steps. Their error is that of the
    /// interpolant: compared with runs that end at the sample times it was found at most three times larger with
    /// DOP853 at tolerances 1e-6 to 1e-12. To have a state at the accuracy of steps, let the run end there.
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

    /// Keeps the interpolant, for [`Trajectory::at`]. Costs three evaluations a step with DOP853, none with DOPRI5, and memory.
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

    /// Calls `f` with the time after every accepted step; `Break` ends the run there, which is no failure.
    #[must_use]
    pub fn progress(mut self, f: impl FnMut(f64) -> ControlFlow<()> + 'static) -> Self {
        self.progress = Some(Box::new(f));
        self
    }

    /// Runs from the start to `t_end`, which may lie before it.
    ///
    /// # Errors
    /// [`Error::InvalidSetting`] for settings outside of their range; [`Error::WrongLength`], [`Error::NonFinite`] or
    /// [`Error::OffConstraint`] for a bad start; on the way [`Error::At`] with time, state and cause: what the solver or
    /// the projection reports, [`Error::StepTooSmall`], [`Error::TooManySteps`]. The trajectory up to there is in the [`Failure`].
    pub fn until(self, t_end: f64) -> Result<Trajectory<M>, Failure<M>> {
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
        trajectory.projected = self.stabilisation == Stabilisation::Projection;
        let fail = |error, trajectory| Failure {
            error,
            trajectory: Box::new(trajectory),
        };
        if let Err(error) = self.check(t_end) {
            return Err(fail(error, trajectory));
        }
        let mut projector = Projector::new::<M>();
        let state = match self.consistent_start(&mut projector, &mut trajectory) {
            Ok(state) => state,
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
            tolerance: self.tolerance,
            first_step: self.first_step,
            max_step: self.max_step,
            max_steps: self.max_steps,
            dense: self.dense || !self.events.is_empty(),
        };
        let n = M::SPEC.n();
        let mut run = Run {
            mechanism: &self.mechanism,
            solver: Solver::new::<M>(options),
            projector,
            project: trajectory.projected,
            n,
            agenda: Agenda::new(self.sampling, t0, t_end),
            watch: Watch::new(self.events, n),
            progress: self.progress,
            t: t0,
            y: y.clone(),
            between: vec![0.0; 2 * n],
            trajectory: &mut trajectory,
        };
        let error = run.start(t0, &y).and_then(|()| {
            if t_end == t0 {
                run.trajectory.ending = Ending::Completed;
                return Ok(());
            }
            let report = self.method.run(&mut run, t0, &y, t_end, &settings);
            run.trajectory.work.steps = report.steps;
            run.trajectory.work.rejected = report.rejected;
            match report.outcome {
                Outcome::Reached => run.trajectory.ending = Ending::Completed,
                Outcome::Stopped => {}
                Outcome::Failed { t, y, error } => return Err(at(t, &y, error)),
            }
            Ok(())
        });
        run.finish();
        match error {
            Ok(()) => Ok(trajectory),
            Err(error) => Err(fail(error, trajectory)),
        }
    }

    /// Ranges of all settings.
    fn check(&self, t_end: f64) -> Result<(), Error> {
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
        let sizes = [
            ("max_step", self.max_step),
            ("first_step", self.first_step),
            (
                "dt",
                match self.sampling {
                    Sampling::Every(dt) => Some(dt),
                    _ => None,
                },
            ),
        ];
        for (what, size) in sizes {
            if size.is_some_and(|size| !(size.is_finite() && size > 0.0)) {
                let size = size.unwrap_or_default();
                return invalid(
                    what,
                    format!("is {size:?}, but must be positive and finite"),
                );
            }
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

    /// The start, checked and projected.
    fn consistent_start(
        &self,
        projector: &mut Projector,
        trajectory: &mut Trajectory<M>,
    ) -> Result<State, Error> {
        let spec = M::SPEC;
        let Some(State { t, q, v }) = self.start.clone() else {
            let what = "start";
            let reason = "is missing".to_owned();
            return Err(Error::InvalidSetting { what, reason });
        };
        let expected = spec.n();
        for (what, found) in [("q", q.len()), ("v", v.len())] {
            if found != expected {
                return Err(Error::WrongLength {
                    what,
                    found,
                    expected,
                });
            }
        }
        let mut what = Vec::new();
        if !t.is_finite() {
            what.push("start time".to_owned());
        }
        for (i, param) in spec.params.iter().enumerate() {
            if !self.mechanism.parameter(i).is_finite() {
                what.push(format!("parameter {}", param.name));
            }
        }
        for (name, (q, v)) in spec.coords.iter().zip(q.iter().zip(&v)) {
            if !q.is_finite() {
                what.push(format!("coordinate {name}"));
            }
            if !v.is_finite() {
                what.push(format!("velocity of {name}"));
            }
        }
        if !what.is_empty() {
            return Err(Error::NonFinite { what });
        }

        let (mut new_q, mut new_v) = (q.clone(), v.clone());
        let position = projector.position(&self.mechanism, t, &mut new_q, &v)?;
        if !self.near(&q, &new_q) {
            let mut residual = vec![0.0; spec.holonomic];
            self.mechanism.residual(t, &q, &mut residual);
            return Err(off_constraint::<M>("position", &residual));
        }
        let velocity = projector.velocity(&self.mechanism, t, &new_q, &mut new_v)?;
        if !self.near(&v, &new_v) {
            let mut residual = vec![0.0; spec.m()];
            self.mechanism.residual_rate(t, &new_q, &v, &mut residual);
            return Err(off_constraint::<M>("velocity", &residual));
        }
        trajectory.work.projections += 1;
        trajectory.work.projection_iterations += position.iterations + velocity.iterations;
        Ok(State {
            t,
            q: new_q,
            v: new_v,
        })
    }

    /// Whether a projection from `before` to `after` is within [`START_BOUND`].
    fn near(&self, before: &[f64], after: &[f64]) -> bool {
        let size = before.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let bound = START_BOUND * size + self.tolerance;
        let mut pairs = before.iter().zip(after);
        pairs.all(|(before, after)| (after - before).abs() <= bound)
    }
}

fn off_constraint<M: Mechanism>(level: &'static str, residual: &[f64]) -> Error {
    let largest = residual.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
    let named = M::SPEC.constraints.iter().zip(residual);
    Error::OffConstraint {
        level,
        constraints: named
            .filter(|(_, r)| r.abs() >= NAMED_PART * largest)
            .map(|(c, r)| (c.name.to_owned(), *r))
            .collect(),
    }
}

fn at(t: f64, y: &[f64], error: Error) -> Error {
    let (q, v) = y.split_at(y.len() / 2);
    Error::At {
        t,
        q: q.to_vec(),
        v: v.to_vec(),
        source: Box::new(error),
    }
}

/// Which samples are still to be taken.
struct Agenda {
    sampling: Sampling,
    t0: f64,
    t_end: f64,
    /// Samples taken from it so far.
    taken: usize,
}

impl Agenda {
    fn new(sampling: Sampling, t0: f64, t_end: f64) -> Self {
        Agenda {
            sampling,
            t0,
            t_end,
            taken: 0,
        }
    }

    /// Time of the next sample that does not come by itself at the end of a step.
    fn next(&self) -> Option<f64> {
        match &self.sampling {
            Sampling::Steps => None,
            Sampling::Every(dt) => {
                let span = self.t_end - self.t0;
                // The start is sample 0.
                let t = self.t0 + ((self.taken + 1) as f64 * dt).copysign(span);
                let rounding = SAME_TIME * self.t0.abs().max(self.t_end.abs());
                let left = (self.t_end - t) * span.signum();
                (left > rounding).then_some(t)
            }
            Sampling::At(times) => times.get(self.taken).copied(),
        }
    }

    /// Whether the end of the run is a sample in any case.
    fn wants_end(&self) -> bool {
        !matches!(self.sampling, Sampling::At(_))
    }
}

/// The simulation as a problem for the integrator.
struct Run<'a, M> {
    mechanism: &'a M,
    solver: Solver,
    projector: Projector,
    project: bool,
    n: usize,
    agenda: Agenda,
    watch: Watch,
    progress: Option<Progress>,
    /// Time and state at the end of the last accepted step; the time is that of the event where a terminal one ended it.
    t: f64,
    y: Vec<f64>,
    /// A state within a step.
    between: Vec<f64>,
    trajectory: &'a mut Trajectory<M>,
}

impl<M: Mechanism> Run<'_, M> {
    /// Events and sample at the start.
    fn start(&mut self, t: f64, y: &[f64]) -> Result<(), Error> {
        let asked = !self.agenda.wants_end() && self.agenda.next() == Some(t);
        if asked {
            self.agenda.taken += 1;
        }
        if asked || self.agenda.wants_end() {
            self.trajectory.times.push(t);
            self.trajectory.states.extend_from_slice(y);
        }
        let watched = self.watch.start(t, y);
        watched.map_err(|error| at(t, y, error))
    }

    /// The state with which the run ended becomes its last sample, if samples are not at given times only.
    fn finish(&mut self) {
        let work = self.solver.work();
        self.trajectory.work.evaluations = work.evaluations;
        self.trajectory.work.fallbacks = work.fallbacks;
        let Trajectory {
            times, states, end, ..
        } = &mut *self.trajectory;
        if let Some(end) = end
            && self.agenda.wants_end()
            && times.last().is_some_and(|t| *t != end.t)
        {
            times.push(end.t);
            states.extend_from_slice(&end.q);
            states.extend_from_slice(&end.v);
        }
    }

    /// What is to be kept of an accepted step.
    fn record(&mut self, step: &Step<'_>) -> Result<(), Error> {
        let mut within = Within {
            mechanism: self.mechanism,
            projector: &mut self.projector,
            project: self.project,
            step,
            y_old: &self.y,
            trajectory: &mut *self.trajectory,
        };
        self.watch.search(step.t_old, step.t, &mut within)?;
        let mut t_stop = step.t;
        for crossing in &self.watch.crossings {
            let event = &self.watch.events[crossing.event];
            within.consistent(crossing.t, &mut self.between)?;
            let (q, v) = self.between.split_at(self.n);
            within.trajectory.events.push(EventHit {
                name: event.name.clone(),
                t: crossing.t,
                q: q.to_vec(),
                v: v.to_vec(),
                direction: crossing.direction,
            });
            if event.terminal {
                t_stop = crossing.t;
                within.trajectory.ending = Ending::Event;
            }
        }
        let forward = step.t >= step.t_old;
        while let Some(t) = self.agenda.next() {
            if if forward { t > t_stop } else { t < t_stop } {
                break;
            }
            within.consistent(t, &mut self.between)?;
            self.agenda.taken += 1;
            within.trajectory.times.push(t);
            within.trajectory.states.extend_from_slice(&self.between);
        }
        within.consistent(t_stop, &mut self.between)?;
        let Trajectory {
            times,
            states,
            segments,
            ..
        } = within.trajectory;
        if let Sampling::Steps = self.agenda.sampling {
            times.push(t_stop);
            states.extend_from_slice(&self.between);
        }
        if let (Some(segments), Some(interpolant)) = (segments, step.interpolant) {
            segments.push(interpolant.segment());
        }
        self.t = t_stop;
        Ok(())
    }
}

impl<M: Mechanism> Problem for Run<'_, M> {
    fn derivative(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Error> {
        let (q, v) = y.split_at(self.n);
        let (q_rate, v_rate) = rate.split_at_mut(self.n);
        q_rate.copy_from_slice(v);
        self.solver.acceleration(self.mechanism, t, q, v, v_rate)
    }

    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), Error> {
        if self.project {
            let work = &mut self.trajectory.work;
            project(self.mechanism, &mut self.projector, work, t, y)?;
        }
        Ok(())
    }

    fn next_sample(&self) -> Option<f64> {
        self.agenda.next()
    }

    fn step(&mut self, step: &Step<'_>) -> Result<Next, Error> {
        let taken = self.agenda.taken;
        let samples = self.trajectory.times.len();
        let events = self.trajectory.events.len();
        let ending = self.trajectory.ending;
        if let Err(error) = self.record(step) {
            self.agenda.taken = taken;
            self.trajectory.times.truncate(samples);
            self.trajectory.states.truncate(2 * self.n * samples);
            self.trajectory.events.truncate(events);
            self.trajectory.ending = ending;
            return Err(error);
        }
        self.watch.accept();
        self.y.copy_from_slice(step.y);
        if let Some(end) = &mut self.trajectory.end {
            end.t = self.t;
            end.q.copy_from_slice(&self.between[..self.n]);
            end.v.copy_from_slice(&self.between[self.n..]);
        }
        let go_on = self.progress.as_mut().map(|progress| progress(self.t));
        if self.trajectory.ending == Ending::Event {
            return Ok(Next::Stop);
        }
        if go_on == Some(ControlFlow::Break(())) && self.t != self.agenda.t_end {
            self.trajectory.ending = Ending::Interrupted;
            return Ok(Next::Stop);
        }
        Ok(Next::Continue)
    }
}

/// Projects y = [q; q̇], positions first, and counts it.
fn project<M: Mechanism>(
    mechanism: &M,
    projector: &mut Projector,
    work: &mut Work,
    t: f64,
    y: &mut [f64],
) -> Result<(), Error> {
    let (q, v) = y.split_at_mut(y.len() / 2);
    work.projections += 1;
    let position = projector.position(mechanism, t, q, v)?;
    work.projection_iterations += position.iterations;
    let velocity = projector.velocity(mechanism, t, q, v)?;
    work.projection_iterations += velocity.iterations;
    Ok(())
}

/// The states of one step.
struct Within<'a, 'b, M> {
    mechanism: &'a M,
    projector: &'a mut Projector,
    project: bool,
    step: &'a Step<'b>,
    y_old: &'a [f64],
    trajectory: &'a mut Trajectory<M>,
}

impl<M: Mechanism> Within<'_, '_, M> {
    /// The state at an end of the step, which needs neither interpolation nor projection.
    fn end(&self, t: f64) -> Option<&[f64]> {
        if t == self.step.t {
            Some(self.step.y)
        } else if t == self.step.t_old {
            Some(self.y_old)
        } else {
            None
        }
    }
}

impl<M: Mechanism> States for Within<'_, '_, M> {
    fn state(&mut self, t: f64, y: &mut [f64]) {
        match (self.end(t), self.step.interpolant) {
            (Some(end), _) => y.copy_from_slice(end),
            (None, Some(interpolant)) => interpolant.state(t, y),
            // A method owes the interpolant where it was asked for; without it there is no value, and that is seen.
            (None, None) => y.fill(f64::NAN),
        }
    }

    fn consistent(&mut self, t: f64, y: &mut [f64]) -> Result<(), Error> {
        self.state(t, y);
        if self.project && self.end(t).is_none() {
            let work = &mut self.trajectory.work;
            project(self.mechanism, self.projector, work, t, y)?;
        }
        Ok(())
    }
}

impl<M: Mechanism> fmt::Debug for Simulation<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("mechanism", &M::SPEC.name)
            .field("start", &self.start)
            .field("method", &self.method)
            .field("tolerance", &self.tolerance)
            .field("stabilisation", &self.stabilisation)
            .field("formula", &self.formula)
            .field("sampling", &self.sampling)
            .field("dense", &self.dense)
            .field("events", &self.events)
            .finish_non_exhaustive()
    }
}

impl<M: Mechanism> fmt::Debug for Failure<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Failure")
            .field("error", &self.error)
            .field("trajectory", &self.trajectory)
            .finish()
    }
}

impl<M: Mechanism> fmt::Display for Failure<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "simulation of `{}` failed: {}", M::SPEC.name, self.error)
    }
}

impl<M: Mechanism> std::error::Error for Failure<M> {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        // The error itself is part of the message.
        self.error.source()
    }
}
