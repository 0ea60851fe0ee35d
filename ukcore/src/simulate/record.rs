//! What is taken from accepted steps: events, samples, the interpolant; and who gets it.

use std::ops::ControlFlow;

use super::agenda::Agenda;
use super::integrals::{Along, Integrals};
use crate::assemble::State;
use crate::error::Error;
use crate::events::{Direction, Event, EventHit, States, Watch};
use crate::integrate::sample::Sample;
use crate::integrate::{Next, Step, Tolerance};
use crate::manifold::Projector;
use crate::trajectory::{Ending, Record, Trajectory, Work};

/// What takes the samples and events of a streamed run.
pub(super) type Sink<'a> = &'a mut dyn FnMut(Record<'_>) -> ControlFlow<()>;

/// Takes from accepted steps what is to be kept or handed over.
pub(super) struct Recorder<'s> {
    pub(super) trajectory: Trajectory,
    /// Projects steps, and samples and events within them.
    pub(super) projector: Projector,
    pub(super) agenda: Agenda,
    watch: Watch,
    /// Takes what is not to be kept, until it wants no more.
    sink: Option<Sink<'s>>,
    pub(super) handed: ControlFlow<()>,
    /// Time of the last sample.
    sampled: Option<f64>,
    /// A state within a step.
    between: Vec<f64>,
    /// What is integrated along the run, if there is anything.
    pub(super) integrals: Option<Integrals>,
}

impl<'s> Recorder<'s> {
    /// A recorder for a run from where `trajectory` stands.
    pub(super) fn new(
        trajectory: Trajectory,
        projector: Projector,
        agenda: Agenda,
        events: Vec<Event>,
        sink: Option<Sink<'s>>,
    ) -> Self {
        let coordinates = trajectory.spec().n();
        Recorder {
            trajectory,
            projector,
            agenda,
            watch: Watch::new(events, coordinates),
            sink,
            handed: ControlFlow::Continue(()),
            sampled: None,
            between: vec![0.0; 2 * coordinates],
            integrals: None,
        }
    }

    /// Events and sample at the start of the run.
    pub(super) fn start(&mut self, at: Sample<'_>) -> Result<(), Error> {
        let count = self.integrals.as_ref().map_or(0, Integrals::len);
        self.trajectory.end_integrals = vec![0.0; count];
        if self.agenda.takes_start(at.t) {
            let integrals = &vec![0.0; count][..];
            self.trajectory.push(Sample { integrals, ..at });
        }
        self.watch.start(at).map_err(|error| at.locate(error))?;
        self.hand_over();
        Ok(())
    }

    /// Takes from a step what is wanted of it, and nothing if that fails. Returns the error of what is integrated along it as a part of
    /// what is allowed: if that is above 1, nothing is taken either.
    pub(super) fn step(&mut self, step: &Step<'_>) -> Result<f64, Error> {
        let taken = self.agenda.taken;
        let Trajectory { ending, .. } = self.trajectory;
        let (samples, events) = (self.trajectory.len(), self.trajectory.events.len());
        let recorded = self.record(step);
        if !matches!(recorded, Ok(error) if error <= 1.0) {
            self.agenda.return_to(taken);
            self.trajectory.truncate(samples, events);
            self.trajectory.ending = ending;
            return recorded;
        }
        self.watch.accept();
        if let Some(integrals) = &mut self.integrals {
            integrals.accept();
        }
        self.hand_over();
        recorded
    }

    /// Takes the events whose zeros lie between the state where the run stands and one just `beyond`, into which it does not get. Whether
    /// one of them ends the run.
    pub(super) fn rests(&mut self, beyond: Sample<'_>) -> Result<Next, Error> {
        let Some(here) = self.trajectory.end.clone() else {
            return Ok(Next::Continue);
        };
        let events = &mut self.trajectory.events;
        let mut ends = false;
        for (event, direction) in self.watch.up_to(beyond)? {
            ends |= meet(events, event, direction, here.clone());
        }
        if ends {
            self.trajectory.ending = Ending::Event;
        }
        self.hand_over();
        Ok(if ends { Next::Stop } else { Next::Continue })
    }

    /// Takes from a step what is wanted of it, and returns the error of what is integrated along it; a failure leaves behind what was taken
    /// before.
    fn record(&mut self, step: &Step<'_>) -> Result<f64, Error> {
        let trajectory = &mut self.trajectory;
        let mut within = Within {
            projector: &mut self.projector,
            project: trajectory.projected,
            step,
            error: &trajectory.error,
            work: &mut trajectory.work,
        };
        let between = &mut self.between;
        // Steps of one size have no estimate.
        let shorter = step.error.is_some();
        let told = (self.watch).search(step.old.t, step.until, shorter, &mut within)?;
        if !told {
            return Ok(UNTOLD);
        }
        let mut t_stop = step.until;
        for crossing in &self.watch.crossings {
            let event = &self.watch.events[crossing.event];
            let t = crossing.t;
            within.consistent(t, between)?;
            let here = Sample::of(t, between).to_state();
            if meet(&mut trajectory.events, event, crossing.direction, here) {
                (t_stop, trajectory.ending) = (t, Ending::Event);
            }
        }
        if let Some(integrals) = &mut self.integrals {
            integrals.begin(step.old.t);
        }
        let sign = if step.until < step.old.t { -1.0 } else { 1.0 };
        let passed = |t: &f64| sign * t <= sign * t_stop;
        while let Some(t) = self.agenda.next.filter(passed) {
            within.consistent(t, between)?;
            self.agenda.take();
            let sums = sums(&mut self.integrals, &mut within, t)?;
            trajectory.times.push(t);
            trajectory.states.extend_from_slice(between);
            trajectory.integrals.extend_from_slice(sums);
        }
        within.consistent(t_stop, between)?;
        sums(&mut self.integrals, &mut within, t_stop)?;
        let reached = self.integrals.as_ref().map(Integrals::reached);
        let (integrals, error) = reached.unwrap_or_default();
        if error > 1.0 {
            return Ok(error);
        }
        let end = Sample {
            integrals,
            ..Sample::of(t_stop, between)
        };
        if self.agenda.wants_steps() {
            trajectory.push(end);
        }
        if let (Some(segments), Some(interpolant)) = (&mut trajectory.segments, step.interpolant) {
            segments.push(interpolant.segment());
        }
        trajectory.reach(end);
        Ok(error)
    }

    /// Gives samples and events to the sink, if there is one, in the order in which the run passes them.
    fn hand_over(&mut self) {
        let trajectory = &mut self.trajectory;
        self.sampled = trajectory.times.last().copied().or(self.sampled);
        let Some(sink) = &mut self.sink else {
            return;
        };
        let passed = |t: f64| (t - trajectory.start).abs();
        let mut hand_all = || {
            let mut events = trajectory.events.iter().peekable();
            for sample in trajectory.samples() {
                while let Some(event) = events.next_if(|e| passed(e.t) <= passed(sample.t)) {
                    sink(Record::Event(event))?;
                }
                sink(Record::Sample(sample))?;
            }
            events.try_for_each(|event| sink(Record::Event(event)))
        };
        if self.handed.is_continue() {
            self.handed = hand_all();
        }
        trajectory.truncate(0, 0);
    }

    /// The state with which the run ended becomes its last sample, if samples are not at given times only.
    pub(super) fn finish(mut self) -> Trajectory {
        if let Some(end) = self.trajectory.end.clone()
            && self.agenda.wants_ends()
            && self.sampled.is_some_and(|t| t != end.t)
        {
            let integrals = &self.trajectory.end_integrals.clone()[..];
            self.trajectory.push(Sample {
                integrals,
                ..Sample::from(&end)
            });
        }
        self.hand_over();
        self.trajectory
    }

    /// Projects the state at the end of a step, and counts it.
    pub(super) fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<(), Error> {
        let work = &mut self.trajectory.work;
        work.projections += 1;
        let position = self.projector.position(t, q, v)?;
        work.projection_iterations += position.iterations;
        let velocity = self.projector.velocity(t, q, v)?;
        work.projection_iterations += velocity.iterations;
        Ok(())
    }
}

/// Takes a hit of `event` at a state. Whether the run ends there.
fn meet(events: &mut Vec<EventHit>, event: &Event, direction: Direction, here: State) -> bool {
    let State { t, q, v } = here;
    let name = event.name.clone();
    events.push(EventHit {
        name,
        t,
        q,
        v,
        direction,
    });
    event.terminal
}

/// Counts as the error of a step that is too long to tell how events go.
const UNTOLD: f64 = 1e3;

/// The integrals at `t`.
fn sums<'a>(
    integrals: &'a mut Option<Integrals>,
    within: &mut Within<'_, '_>,
    t: f64,
) -> Result<&'a [f64], Error> {
    let Some(integrals) = integrals else {
        return Ok(&[]);
    };
    let Step {
        old, new, error, ..
    } = *within.step;
    let mut along = Along {
        states: within,
        from: old.t,
        to: new.t,
        error,
    };
    integrals.go(&mut along, t)
}

/// The states of one step.
struct Within<'a, 'b> {
    projector: &'a mut Projector,
    project: bool,
    step: &'a Step<'b>,
    /// Most that is expected of the interpolant's, in velocities.
    error: &'a Tolerance,
    work: &'a mut Work,
}

impl Within<'_, '_> {
    /// The state at an end of the step, which needs neither interpolation nor projection.
    fn end(&self, t: f64) -> Option<Sample<'_>> {
        let Step { old, new, .. } = self.step;
        [new, old].into_iter().find(|end| end.t == t).copied()
    }
}

impl States for Within<'_, '_> {
    fn state(&mut self, t: f64, y: &mut [f64]) {
        let (q, v) = y.split_at_mut(self.step.new.q.len());
        match (self.end(t), self.step.interpolant) {
            (Some(end), _) => {
                q.copy_from_slice(end.q);
                v.copy_from_slice(end.v);
            }
            (None, Some(interpolant)) => interpolant.state(t, y),
            // A method owes the interpolant where it was asked for; without it there is no value, and that is seen.
            (None, None) => y.fill(f64::NAN),
        }
    }

    fn consistent(&mut self, t: f64, y: &mut [f64]) -> Result<(), Error> {
        self.state(t, y);
        if !self.project || self.end(t).is_some() {
            return Ok(());
        }
        let n = self.step.new.q.len();
        let (q, v) = y.split_at_mut(n);
        if self.step.nearby {
            return self.projector.settle(t, q, v);
        }
        let Within {
            projector,
            step,
            work,
            ..
        } = self;
        let error = self.error;
        let too_much = |old: &[f64], new: &[f64]| error.excess(0, old, new) > 1.0;
        let again = |y: &mut [f64]| {
            if let Some(interpolant) = &step.interpolant {
                interpolant.state(t, y);
            }
        };
        let corrections = projector.interpolated(t, y, too_much, again)?;
        work.projections += 1;
        work.projection_iterations += corrections.iter().map(|c| c.iterations).sum::<usize>();
        Ok(())
    }
}
