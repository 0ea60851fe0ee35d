//! A member under way in a lane.

use super::Member;
use crate::assemble::State;
use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::integrate::{
    Course, Method, PROJECTION_LIMIT, Settings, StepSize, Trial, projection_norm, sized,
};
use crate::simulate::record::Recorder;
use crate::simulate::vanishing::RowWatch;
use crate::simulate::{Simulation, obstacles};
use crate::solver::SolverWork;

/// A member under way.
pub(super) struct Running {
    pub(super) index: usize,
    /// The state where the member began.
    start: State,
    pub(super) course: Course,
    pub(super) size: StepSize,
    /// The step in hand.
    pub(super) trial: Trial,
    pub(super) settings: Settings,
    /// Takes its samples, and has what projects them, and states that its lane leaves to it.
    pub(super) recorder: Recorder<'static>,
    rows: RowWatch,
}

impl Running {
    /// Member `index`, checked, at its consistent start, in a run to `t_end`.
    pub(super) fn admit(
        index: usize,
        mut simulation: Simulation,
        t_end: f64,
    ) -> Result<Self, Error> {
        let (mut recorder, start, settings) = simulation.admit(t_end, None)?;
        recorder.start(Sample::from(&start))?;
        Ok(Running {
            index,
            course: Course::new(start.t, t_end, &settings),
            size: StepSize::default(),
            trial: Trial::default(),
            rows: RowWatch::new(Method::Dop853, settings.tolerance.relative),
            settings,
            recorder,
            start,
        })
    }

    /// Whether there is nowhere to go.
    pub(super) fn has_arrived(&self) -> bool {
        self.course.now == self.course.end
    }

    /// An error at this state refuses the step in hand.
    pub(super) fn note(&mut self, at: Sample<'_>, error: Error) {
        let cause = self.course.note(at, error);
        self.course.blame(cause);
    }

    /// Projects the state y at the end of the step in hand; returns whether that does.
    pub(super) fn project(&mut self, y: &mut [f64]) -> bool {
        let (raw, t) = (y.to_vec(), self.trial.end.t);
        let (q, v) = y.split_at_mut(raw.len() / 2);
        let result = self.recorder.project(t, q, v);
        let noted = result.map_err(|error| self.note(Sample::of(t, &raw), error));
        noted.is_ok()
    }

    /// Whether a projection of `raw` to `new` is small without what rounding makes of it.
    pub(super) fn is_near(&mut self, new: &[f64], raw: &[f64], old: &[f64]) -> bool {
        let Sample { t, q, v, .. } = Sample::of(self.trial.end.t, raw);
        let mut excess: Vec<f64> = new.iter().zip(raw).map(|(new, raw)| new - raw).collect();
        self.recorder.projector.excess(t, q, v, &mut excess);
        let tolerance = &self.settings.tolerance;
        projection_norm(excess.into_iter(), [old, raw], tolerance) <= PROJECTION_LIMIT
    }

    /// Whether the member is to go on alone: steps are short about what may be the zero of a length, or A loses a row on the step in hand,
    /// from and to the states that `states` gives, between which the motion turns back or not.
    pub(super) fn leaves(&mut self, rests: bool, states: impl Fn() -> [Vec<f64>; 2]) -> bool {
        if self.course.pace.is_slow() {
            return true;
        }
        let mechanism = self.recorder.trajectory.mechanism();
        if mechanism.spec().m() == 0 {
            return false;
        }
        let Trial { start, end, .. } = self.trial;
        if !rests && !self.rows.is_due(start.t, end.t) {
            return false;
        }
        let states = states();
        let [old, new] =
            [(start.t, &states[0]), (end.t, &states[1])].map(|(t, y)| Sample::of(t, y));
        let found = self.rows.vanishing(mechanism, old, new);
        found.is_some_and(|found| obstacles::vanishing(mechanism, found, old).is_some())
    }

    /// The step in hand is accepted.
    pub(super) fn accept(&mut self) {
        self.rows.accept(self.trial.end.t);
    }

    /// Whether a sample lies within the step in hand.
    pub(super) fn wants_interpolant(&self) -> bool {
        self.settings.dense || self.course.covers(self.trial, self.recorder.agenda.next)
    }

    /// Takes the samples of the step in hand, and what is integrated along it, from states at its ends, the coefficients of its
    /// interpolant, and its error with the size that this has; none of them, with `false`, if one fails or an integral is not exact enough.
    pub(super) fn record(
        &mut self,
        [old, new]: [Vec<f64>; 2],
        coefficients: &[f64],
        (mut error, norm): (Vec<f64>, f64),
    ) -> bool {
        sized(&mut error, [&old, &new], &self.settings.tolerance, norm);
        let mut step = (self.course).show(self.trial, [&old, &new], Some(coefficients));
        step.error = Some(&error);
        let recorded = self.recorder.step(&step);
        let recorded = recorded.map_err(|error| self.note(step.new, error));
        recorded.is_ok_and(|error| error <= 1.0)
    }

    /// Why the member ends with `error` at the state `y`, where it stands.
    pub(super) fn fail(mut self, error: Error, y: &[f64]) -> Error {
        let here = Sample::of(self.course.now.t, y);
        let trouble = self.course.explain(error, here);
        let mechanism = self.recorder.trajectory.mechanism();
        let start = Sample::from(&self.start);
        obstacles::explain(mechanism, start, &self.settings.tolerance, trouble)
    }

    /// The motion of a member that has arrived at the state `y`, with what its lane has done for it.
    pub(super) fn finish(mut self, y: &[f64], lane: SolverWork) -> Member {
        let integrals = self.recorder.trajectory.end_integrals.clone();
        let end = Sample {
            integrals: &integrals,
            ..Sample::of(self.course.now.t, y)
        };
        self.recorder.trajectory.reach(end);
        let mut trajectory = self.recorder.finish();
        let work = &mut trajectory.work;
        work.steps = self.course.steps;
        work.rejected = self.course.rejected();
        work.evaluations = lane.evaluations;
        (work.fallbacks, work.refined) = (lane.fallbacks, lane.refined);
        Member::of(&trajectory, &self.start)
    }
}
