//! A member under way in a lane.

use super::Member;
use crate::assemble::State;
use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::integrate::{
    Cause, Conflict, Course, Interpolant, PROJECTION_LIMIT, Settings, Trial, Trouble, error_norm,
};
use crate::manifold::Projector;
use crate::simulate::Simulation;
use crate::simulate::agenda::Agenda;
use crate::simulate::record::project;
use crate::solver::SolverWork;
use crate::trajectory::Work;

/// A member under way.
pub(super) struct Running {
    pub(super) index: usize,
    pub(super) course: Course,
    /// The step in hand.
    pub(super) trial: Trial,
    pub(super) settings: Settings,
    pub(super) conflict: Conflict,
    /// What refuses the step in hand.
    cause: Cause,
    /// For its start, samples, and projections that its lane leaves to it.
    projector: Projector,
    agenda: Agenda,
    samples: Vec<State>,
    pub(super) work: Work,
}

impl Running {
    /// Member `index`, checked, in a run to `t_end`, and its consistent start.
    pub(super) fn admit(
        index: usize,
        simulation: Simulation,
        t_end: f64,
    ) -> Result<(Self, State), Error> {
        simulation.check(t_end, true)?;
        let mut work = Work::default();
        let mut projector = Projector::new(&simulation.mechanism);
        let (start, tolerance) = simulation.consistent_start(&mut projector, &mut work)?;
        let settings = simulation.settings(tolerance);
        let mut agenda = Agenda::new(simulation.sampling, start.t, t_end);
        let takes_start = agenda.takes_start(start.t);
        let running = Running {
            index,
            course: Course::new(start.t, t_end, &settings),
            trial: Trial::default(),
            settings,
            conflict: Conflict::default(),
            cause: None,
            projector,
            agenda,
            samples: takes_start.then(|| start.clone()).into_iter().collect(),
            work,
        };
        Ok((running, start))
    }

    /// Whether there is nowhere to go.
    pub(super) fn has_arrived(&self) -> bool {
        self.course.now == self.course.end
    }

    /// An error at this state refuses the step in hand.
    pub(super) fn note(&mut self, at: Sample<'_>, error: Error) {
        self.conflict.note(at, &error);
        self.cause = Trouble::cause(at, error);
    }

    /// What refuses the step in hand is of no consequence.
    pub(super) fn forget(&mut self) {
        self.cause = None;
    }

    /// The step in hand is refused; the next attempt has the size `h`.
    pub(super) fn refuse(&mut self, h: f64) {
        self.course.refuse(self.cause.take());
        self.course.h = h;
    }

    /// Projects a state, and takes note where that fails.
    pub(super) fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), ()> {
        let raw = y.to_vec();
        let state = y.split_at_mut(raw.len() / 2);
        let result = project(&mut self.projector, &mut self.work, t, state);
        result.map_err(|error| self.note(Sample::of(t, &raw), error))
    }

    /// Whether a projection of `raw` to `new` is small without what rounding makes of it.
    pub(super) fn is_near(&mut self, new: &[f64], raw: &[f64], old: &[f64]) -> bool {
        let Sample { t, q, v } = Sample::of(self.trial.end.t, raw);
        let mut excess: Vec<f64> = new.iter().zip(raw).map(|(new, raw)| new - raw).collect();
        self.projector.excess(t, q, v, &mut excess);
        let changes = excess.iter().zip(old).zip(raw);
        let changes = changes.map(|((excess, old), raw)| (*excess, *old, *raw));
        error_norm(changes, self.settings.tolerance) <= PROJECTION_LIMIT
    }

    /// Whether a sample lies within the step in hand.
    pub(super) fn wants_interpolant(&self) -> bool {
        let (clock, end) = (self.course.clock, self.trial.end);
        let next = self.agenda.next();
        next.is_some_and(|t| clock.passed(t, end.s))
    }

    /// Takes the samples of the step in hand, which ends in the state `end`; none of them, with `false`, if one fails.
    pub(super) fn take_samples(&mut self, end: &[f64], coefficients: &[f64]) -> bool {
        let before = (self.agenda.taken(), self.samples.len());
        let interpolant = Interpolant {
            clock: self.course.clock,
            s_old: self.course.now.s,
            h: self.trial.size,
            coefficients,
        };
        let (sign, t_end) = (self.course.clock.sign, self.trial.end.t);
        let passed = |t: &f64| sign * (t - t_end) <= 0.0;
        while let Some(t) = self.agenda.next().filter(passed) {
            let mut y = end.to_vec();
            if t != t_end {
                interpolant.state(t, &mut y);
                if self.project(t, &mut y).is_err() {
                    self.agenda.return_to(before.0);
                    self.samples.truncate(before.1);
                    return false;
                }
            }
            self.agenda.take();
            self.samples.push(Sample::of(t, &y).to_state());
        }
        true
    }

    /// Why the member ends with `error` at the state `y`, where it stands.
    pub(super) fn fail(mut self, error: Error, y: &[f64]) -> Error {
        self.course.refuse(self.cause.take());
        let here = Sample::of(self.course.now.t, y);
        let trouble = self.course.explain(error, here, &mut self.conflict);
        trouble.into_error()
    }

    /// The motion of a member that has arrived at the state `y`, with what its lane has done for it.
    pub(super) fn finish(mut self, y: &[f64], lane: SolverWork) -> Member {
        let end = Sample::of(self.course.now.t, y).to_state();
        if self.agenda.wants_ends() && self.samples.last().is_none_or(|s| s.t != end.t) {
            self.samples.push(end.clone());
        }
        self.work.steps = self.course.steps;
        self.work.rejected = self.course.rejected();
        self.work.evaluations = lane.evaluations;
        self.work.fallbacks = lane.fallbacks;
        Member {
            end,
            samples: self.samples,
            work: self.work,
        }
    }
}
