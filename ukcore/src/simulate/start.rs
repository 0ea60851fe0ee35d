//! From the start that is given to one on the constraints.

use super::agenda::Agenda;
use super::integrals::Integrals;
use super::record::{Recorder, Sink};
use super::{START_BOUND, Simulation, angles, obstacles};
use crate::assemble::State;
use crate::diagnose;
use crate::error::Error;
use crate::integrate::{Method, Settings, Tolerance};
use crate::manifold::{Projector, Stabilisation};
use crate::measure::Measure;
use crate::spec::Spec;
use crate::trajectory::{Trajectory, Work};

/// States between the ends of steps are off by some ten tolerances; so many times that much is expected at most, of RATTLE's of this one.
const INTERPOLATED: f64 = 100.0;
const RATTLE: f64 = 1e-5;

impl Simulation {
    /// What takes the records of a run to `t_end`, the consistent start, and what a method is to be told.
    pub(super) fn admit<'s>(
        &mut self,
        t_end: f64,
        sink: Option<Sink<'s>>,
    ) -> Result<(Recorder<'s>, State, Settings), Error> {
        self.check(t_end, sink.is_none())?;
        let mut trajectory = self.trajectory();
        let mut projector = Projector::new(&self.mechanism);
        let (start, floor, tolerance) =
            self.consistent_start(&mut projector, &mut trajectory.work)?;
        if let Some(error) = obstacles::leaves_no_branch(&self.mechanism, &start) {
            return Err(error);
        }
        // The accuracy of RATTLE is that of its step.
        let relative = match self.method {
            Method::Rattle { .. } => RATTLE,
            _ => tolerance.relative,
        };
        let share = tolerance.relative / relative;
        let floors = &tolerance.floors[start.v.len()..];
        trajectory.error = Tolerance {
            relative: INTERPOLATED * relative,
            floors: floors.iter().map(|floor| share * floor).collect(),
        };
        trajectory.start = start.t;
        trajectory.end = Some(start.clone());
        let integrals = Integrals::new(
            &self.mechanism,
            [tolerance.relative, floor],
            t_end - start.t,
        );
        let settings = Settings {
            tolerance,
            first_step: self.first_step,
            max_step: self.max_step,
            max_steps: self.max_steps,
            dense: self.dense || !self.events.is_empty() || integrals.is_some(),
            switches: self.mechanism.spec().switches,
        };
        let agenda = Agenda::new(self.sampling.clone(), start.t, t_end);
        let events = std::mem::take(&mut self.events);
        let mut recorder = Recorder::new(trajectory, projector, agenda, events, sink);
        recorder.integrals = integrals;
        Ok((recorder, start, settings))
    }

    /// The trajectory of a run that has not started.
    pub(super) fn trajectory(&self) -> Trajectory {
        let mut trajectory = Trajectory::new(self.mechanism.clone(), self.solver_options());
        trajectory.watched = self.events.iter().map(|event| event.name.clone()).collect();
        trajectory.projected = self.stabilisation == Stabilisation::Projection;
        trajectory.segments = self.dense.then(Vec::new);
        trajectory
    }

    /// The start, checked and projected; what coordinates that are less count as, measured; and the tolerance of a run from there.
    fn consistent_start(
        &self,
        projector: &mut Projector,
        work: &mut Work,
    ) -> Result<(State, f64, Tolerance), Error> {
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
        let measure = Measure::at(mech, t, [&new_q, &v]);
        let mut size = measure.size(&q).max(measure.size(&v));
        // Where nothing is known of the mechanism, the unit is what things are compared with.
        let most = measure.reach(mech, t, [&new_q, &v], size).unwrap_or(1.0);
        if size > 0.0 && size < most {
            // Coordinates may be measured from where they start; rounding, for one, is then not that of their size.
            size = size.max(projector.length(t, &new_q, &v, &measure.scale));
        }
        // A start at zero in all coordinates has no size.
        let size = if size > 0.0 { size.min(most) } else { most };
        let tolerance = self.tolerance_of(size, &measure);
        let floors = tolerance.floors.iter();
        let absolute: Vec<f64> = floors.map(|floor| tolerance.relative * floor).collect();
        let (of_q, of_v) = absolute.split_at(q.len());
        if !near([&q, &new_q], of_q, &measure) {
            let mut residual = vec![0.0; spec.holonomic];
            mech.residual(t, &q, &mut residual);
            return Err(off_constraint(spec, "position", &residual));
        }
        let velocity = projector.velocity(t, &new_q, &mut new_v)?;
        if !near([&v, &new_v], of_v, &measure) {
            let mut residual = vec![0.0; spec.m()];
            mech.residual_rate(t, &new_q, &v, &mut residual);
            return Err(off_constraint(spec, "velocity", &residual));
        }
        work.projections += 1;
        work.projection_iterations += position.iterations + velocity.iterations;
        let (q, v) = (new_q, new_v);
        Ok((State { t, q, v }, size, tolerance))
    }

    /// The tolerance of a run whose start has this size, measured.
    fn tolerance_of(&self, size: f64, measure: &Measure) -> Tolerance {
        let floors = measure.scale.iter().map(|unit| match self.absolute {
            Some(absolute) => absolute / self.tolerance,
            None => size * unit,
        });
        let floors: Vec<f64> = floors.collect();
        Tolerance {
            relative: self.tolerance,
            floors: [&floors[..], &floors].concat(),
        }
    }
}

/// Whether a projection from `before` to `after` is within [`START_BOUND`] and the absolute tolerances.
fn near([before, after]: [&[f64]; 2], absolute: &[f64], measure: &Measure) -> bool {
    let size = START_BOUND * measure.size(before);
    let changes = before
        .iter()
        .zip(after)
        .map(|(before, after)| (after - before).abs());
    let mut all = changes.zip(measure.scale.iter().zip(absolute));
    all.all(|(change, (unit, absolute))| change <= size * unit + absolute)
}

fn off_constraint(spec: &Spec, level: &'static str, residual: &[f64]) -> Error {
    let scale = vec![1.0; residual.len()];
    Error::OffConstraint {
        level,
        constraints: diagnose::offending(spec, residual, &scale),
    }
}
