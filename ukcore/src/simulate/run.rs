//! A simulation as the [`Problem`] that a [`Method`](crate::integrate::Method) advances.

use std::ops::ControlFlow;

use super::agenda::Agenda;
use super::trouble::{self, Conflict, Pace};
use crate::diagnose;
use crate::error::Error;
use crate::events::{EventHit, States, Watch};
use crate::integrate::{Next, Problem, Step};
use crate::linearise::Slopes;
use crate::manifold::Projector;
use crate::mechanism::{Branch, Dynamics, Energy, Prepared};
use crate::scalar::Dual;
use crate::scan::largest;
use crate::solver::{RANK_CEILING, Solver};
use crate::trajectory::{Ending, Record, Sample, Trajectory, Work};

pub(super) type Progress = Box<dyn FnMut(Sample<'_>) -> ControlFlow<()>>;

/// What takes the samples and events of a streamed run.
pub(super) type Sink<'a> = &'a mut dyn FnMut(Record<'_>) -> ControlFlow<()>;

/// `error` with the place where it arose.
pub(super) fn at(t: f64, y: &[f64], error: Error) -> Error {
    let (q, v) = y.split_at(y.len() / 2);
    Error::At {
        t,
        q: q.to_vec(),
        v: v.to_vec(),
        source: Box::new(error),
    }
}

/// The simulation as a problem for the integrator.
pub(super) struct Run<'a, 's> {
    /// For the derivatives of switching functions, if steps are to go onto their zeros.
    pub(super) located: Option<Prepared<Dual, dyn Dynamics<Dual>>>,
    pub(super) solver: Solver,
    pub(super) projector: Projector,
    pub(super) project: bool,
    pub(super) n: usize,
    pub(super) agenda: Agenda,
    pub(super) watch: Watch,
    pub(super) progress: Option<Progress>,
    /// Takes what is not to be kept, until it wants no more.
    pub(super) sink: Option<Sink<'s>>,
    pub(super) handed: ControlFlow<()>,
    /// Time of the last sample.
    pub(super) sampled: Option<f64>,
    /// Time and state at the end of the last accepted step; the time is that of the event where a terminal one ended it.
    pub(super) t: f64,
    pub(super) y: Vec<f64>,
    /// A state within a step.
    pub(super) between: Vec<f64>,
    /// Made when a method asks for the first Jacobian.
    pub(super) slopes: Option<Slopes>,
    pub(super) conflict: Conflict,
    pub(super) pace: Pace,
    /// For a method with a fixed step.
    pub(super) keeper: Option<Keeper>,
    pub(super) trajectory: &'a mut Trajectory,
}

/// Watches the energy of a run with steps of a fixed size: too long ones make it grow without bound, and nothing else would tell.
pub(super) struct Keeper {
    pub(super) step: f64,
    first: Energy,
    /// Largest energy exchanged so far.
    exchanged: f64,
}

/// Largest change of the energy, as a share of the energy exchanged, with which a motion still counts as one of the mechanism.
const ASTRAY: f64 = 0.5;

/// Changes of the energy below this share of its terms may be rounding.
const NO_CHANGE: f64 = 1e-9;

impl Keeper {
    pub(super) fn new(step: f64, first: Energy) -> Self {
        Keeper {
            step,
            first,
            exchanged: 0.0,
        }
    }

    fn check(&mut self, now: Energy) -> Result<(), Error> {
        let gained = now.potential - self.first.potential;
        let change = (gained + (now.kinetic - self.first.kinetic)).abs();
        self.exchanged = self.exchanged.max(now.kinetic).max(gained.abs());
        let terms = now.kinetic + now.potential.abs() + self.first.potential.abs();
        // The energy of a motion gone astray may not be a number.
        let kept = change <= ASTRAY * self.exchanged || change <= NO_CHANGE * terms;
        if kept {
            return Ok(());
        }
        let what = "step";
        let reason = format!(
            "is {:?}, which is too long here: the energy has changed by {:.0} % of the energy exchanged; take a smaller one",
            self.step,
            100.0 * change / self.exchanged
        );
        Err(Error::InvalidSetting { what, reason })
    }
}

/// Significance of a constraint, √ε, below which the state cannot tell on which side of a singular position it is.
const SINGULAR: f64 = 1.5e-8;

impl Run<'_, '_> {
    /// Refuses a step that ends where constraints all but imply each other and that did not begin there.
    ///
    /// A significance δ leaves q off by ε/δ, so below √ε the state does not say on which side of the singular position it is, nor which branch of the motion it
    /// takes: any of them conserves energy. A step that passes over the place is not concerned.
    fn check_branch(&mut self, step: &Step<'_>) -> Result<(), Error> {
        if self.solver.take_weakest() > 16.0 * SINGULAR {
            return Ok(());
        }
        if self.weakest_at(step.t, step.y)? > SINGULAR {
            return Ok(());
        }
        let error = self.singular(SINGULAR);
        let began = self.y.clone();
        if self.weakest_at(step.t_old, &began)? > SINGULAR {
            return Err(error);
        }
        Ok(())
    }

    /// An error that names the constraints whose significance in the last solution was not above `significance`.
    fn singular(&self, significance: f64) -> Error {
        let weak = self.solver.rows_below(significance).iter();
        let names = weak.map(|c| self.trajectory.spec().constraints[*c].name.to_owned());
        Error::Singular {
            constraints: names.collect(),
        }
    }

    /// [`Solver::take_weakest`] at (t, y).
    fn weakest_at(&mut self, t: f64, y: &[f64]) -> Result<f64, Error> {
        let (q, v) = y.split_at(self.n);
        let mut rate = vec![0.0; self.n];
        self.solver.acceleration_in_run(t, q, v, &mut rate)?;
        Ok(self.solver.take_weakest())
    }

    /// Events and sample at the start.
    pub(super) fn start(&mut self, t: f64, y: &[f64]) -> Result<(), Error> {
        if self.agenda.takes_start(t) {
            self.trajectory.times.push(t);
            self.trajectory.states.extend_from_slice(y);
        }
        let watched = self.watch.start(t, y);
        watched.map_err(|error| at(t, y, error))?;
        self.hand_over();
        Ok(())
    }

    /// Gives samples and events to the sink, if there is one, in the order in which the run passes them.
    fn hand_over(&mut self) {
        let Trajectory {
            times,
            states,
            events,
            start,
            ..
        } = &mut *self.trajectory;
        self.sampled = times.last().copied().or(self.sampled);
        let Some(sink) = &mut self.sink else {
            return;
        };
        let mut hand_all = || {
            let mut events = events.iter().peekable();
            let passed = |t: f64| (t - *start).abs();
            for (t, y) in times.iter().zip(states.chunks_exact((2 * self.n).max(1))) {
                while let Some(event) = events.next_if(|event| passed(event.t) <= passed(*t)) {
                    sink(Record::Event(event))?;
                }
                let (q, v) = y.split_at(self.n);
                sink(Record::Sample(Sample { t: *t, q, v }))?;
            }
            events.try_for_each(|event| sink(Record::Event(event)))
        };
        if self.handed.is_continue() {
            self.handed = hand_all();
        }
        times.clear();
        states.clear();
        events.clear();
    }

    /// The state with which the run ended becomes its last sample, if samples are not at given times only.
    pub(super) fn finish(&mut self) {
        let work = self.solver.work();
        self.trajectory.work.evaluations = work.evaluations;
        self.trajectory.work.fallbacks = work.fallbacks;
        let Trajectory {
            times, states, end, ..
        } = &mut *self.trajectory;
        if let Some(end) = end
            && self.agenda.wants_ends()
            && self.sampled.is_some_and(|t| t != end.t)
        {
            times.push(end.t);
            states.extend_from_slice(&end.q);
            states.extend_from_slice(&end.v);
        }
        self.hand_over();
    }

    /// What is to be kept of an accepted step.
    fn record(&mut self, step: &Step<'_>) -> Result<(), Error> {
        let mut within = Within {
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
            self.agenda.take();
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
        if self.agenda.wants_steps() {
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

impl Problem for Run<'_, '_> {
    fn derivative(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Error> {
        let (q, v) = y.split_at(self.n);
        let (q_rate, v_rate) = rate.split_at_mut(self.n);
        q_rate.copy_from_slice(v);
        let solver = &mut self.solver;
        let result = solver.acceleration_in_run(t, q, v, v_rate);
        result.inspect_err(|error| self.conflict.note(t, y, error))
    }

    fn jacobian(
        &mut self,
        t: f64,
        y: &[f64],
        rate: &mut [f64],
        out: &mut [f64],
    ) -> Result<(), Error> {
        let (q, v) = y.split_at(self.n);
        let (q_rate, v_rate) = rate.split_at_mut(self.n);
        q_rate.copy_from_slice(v);
        let solver = &mut self.solver;
        let slopes = (self.slopes).get_or_insert_with(|| Slopes::new(solver.mechanism()));
        self.trajectory.work.jacobians += 1;
        let result = slopes.columns(solver, (t, q, v), v_rate, out);
        result.inspect_err(|error| self.conflict.note(t, y, error))
    }

    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), Error> {
        if self.project {
            let work = &mut self.trajectory.work;
            let result = project(&mut self.projector, work, t, y);
            result.inspect_err(|error| self.conflict.note(t, y, error))?;
        }
        Ok(())
    }

    fn reach(
        &mut self,
        t: f64,
        base: &[f64],
        q: &mut [f64],
        shift: &mut [f64],
    ) -> Result<(), Error> {
        let work = &mut self.trajectory.work;
        work.projections += 1;
        let projector = &mut self.projector;
        let correction = projector.position_along(t, base, q, shift)?;
        work.projection_iterations += correction.iterations;
        Ok(())
    }

    fn settle(&mut self, t: f64, q: &[f64], v: &mut [f64]) -> Result<(), Error> {
        let correction = self.projector.velocity(t, q, v)?;
        self.trajectory.work.projection_iterations += correction.iterations;
        Ok(())
    }

    fn jump(&mut self, t: f64, y: &[f64]) -> Option<Error> {
        let (q, v) = y.split_at(self.n);
        let spec = self.trajectory.spec();
        // Held branches do not jump.
        let mut followed = self.solver.mechanism().clone();
        for k in 0..spec.switches.len() {
            followed.hold(k, Branch::Followed);
        }
        let mut projector = Projector::new(&followed);
        let mechanism = &followed;
        let mut near = y.to_vec();
        let (near_q, near_v) = near.split_at_mut(self.n);
        projector.position(t, near_q, v).ok()?;
        projector.velocity(t, near_q, near_v).ok()?;
        let change = |old: &[f64], new: &[f64]| {
            let pairs = old.iter().zip(new);
            pairs.fold(0.0, |s: f64, (a, b)| s.max((a - b).abs() / (1.0 + a.abs())))
        };
        let position = change(q, near_q) >= change(v, near_v);
        let residual = |t: f64| {
            let mut residual = vec![0.0; spec.m()];
            if position {
                mechanism.residual(t, q, &mut residual[..spec.holonomic]);
            } else {
                mechanism.residual_rate(t, near_q, v, &mut residual);
            }
            residual
        };
        // What the time alone has made of it since the last step, which may have gone just onto the jump.
        let after = residual(t);
        let size = largest(&after);
        let pairs = after.iter().zip(residual(2.0 * self.t - t));
        let jumps = pairs.map(|(after, before)| {
            let alone = (after - before).abs() > 0.5 * size;
            if alone { *after } else { 0.0 }
        });
        let jumps: Vec<f64> = jumps.collect();
        if jumps.iter().any(|r| *r != 0.0) {
            return Some(Error::Jump {
                level: if position { "position" } else { "velocity" },
                constraints: diagnose::offending(spec, &jumps, &vec![1.0; jumps.len()]),
            });
        }
        let weakest = self.weakest_at(t, &near).ok()?;
        (weakest <= RANK_CEILING).then(|| self.singular(RANK_CEILING))
    }

    fn next_sample(&self) -> Option<f64> {
        self.agenda.next()
    }

    fn switches(&self) -> usize {
        match self.located {
            Some(_) => self.trajectory.spec().switches.len(),
            None => 0,
        }
    }

    fn switching(&mut self, t: f64, y: &[f64], values: &mut [f64]) {
        let (q, v) = y.split_at(self.n);
        self.solver.mechanism().switching(t, q, v, values);
    }

    fn switching_rate(&mut self, t: f64, y: &[f64], rate: &[f64], values: &mut [f64]) {
        let Some(mechanism) = &self.located else {
            return;
        };
        let pairs = y.iter().zip(rate);
        let y: Vec<Dual> = pairs.map(|(y, rate)| Dual::new(*y, *rate)).collect();
        let (q, v) = y.split_at(self.n);
        let mut duals = vec![Dual::new(0.0, 0.0); values.len()];
        mechanism.switching(Dual::new(t, 1.0), q, v, &mut duals);
        let rates = duals.iter().map(|dual| dual.eps);
        values.iter_mut().zip(rates).for_each(|(x, rate)| *x = rate);
    }

    fn hold(&mut self, k: usize, branch: Branch) {
        self.solver.mechanism_mut().hold(k, branch);
        self.projector.hold(k, branch);
    }

    fn stuck(&self, switches: &[usize]) -> Error {
        trouble::stuck(self.trajectory.spec(), switches)
    }

    fn step(&mut self, step: &Step<'_>) -> Result<Next, Error> {
        if let Some(keeper) = &mut self.keeper {
            let (q, v) = step.y.split_at(self.n);
            keeper.check(self.solver.mechanism().energy(step.t, q, v))?;
        }
        let taken = self.agenda.taken();
        let samples = self.trajectory.times.len();
        let events = self.trajectory.events.len();
        let ending = self.trajectory.ending;
        let recorded = self.check_branch(step).and_then(|()| self.record(step));
        if let Err(error) = recorded {
            self.agenda.return_to(taken);
            self.trajectory.times.truncate(samples);
            self.trajectory.states.truncate(2 * self.n * samples);
            self.trajectory.events.truncate(events);
            self.trajectory.ending = ending;
            return Err(error);
        }
        self.watch.accept();
        self.conflict.pass(step.t_old, step.t);
        self.pace.step(step.t - step.t_old, &self.y, step.y);
        self.y.copy_from_slice(step.y);
        if let Some(end) = &mut self.trajectory.end {
            end.t = self.t;
            end.q.copy_from_slice(&self.between[..self.n]);
            end.v.copy_from_slice(&self.between[self.n..]);
        }
        self.hand_over();
        let go_on = match (&mut self.progress, self.trajectory.last()) {
            (Some(progress), Some(last)) => progress(last),
            _ => ControlFlow::Continue(()),
        };
        if self.trajectory.ending == Ending::Event {
            return Ok(Next::Stop);
        }
        if (self.handed.is_break() || go_on.is_break()) && self.t != self.agenda.t_end() {
            self.trajectory.ending = Ending::Interrupted;
            return Ok(Next::Stop);
        }
        if self.pace.hopeless(self.agenda.t_end() - self.t) {
            return Ok(Next::Stop);
        }
        Ok(Next::Continue)
    }
}

/// Projects y = [q; q̇], positions first, and counts it.
pub(super) fn project(
    projector: &mut Projector,
    work: &mut Work,
    t: f64,
    y: &mut [f64],
) -> Result<(), Error> {
    let (q, v) = y.split_at_mut(y.len() / 2);
    work.projections += 1;
    let position = projector.position(t, q, v)?;
    work.projection_iterations += position.iterations;
    let velocity = projector.velocity(t, q, v)?;
    work.projection_iterations += velocity.iterations;
    Ok(())
}

/// The states of one step.
struct Within<'a, 'b> {
    projector: &'a mut Projector,
    project: bool,
    step: &'a Step<'b>,
    y_old: &'a [f64],
    trajectory: &'a mut Trajectory,
}

impl Within<'_, '_> {
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

impl States for Within<'_, '_> {
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
            project(self.projector, work, t, y)?;
        }
        Ok(())
    }
}
