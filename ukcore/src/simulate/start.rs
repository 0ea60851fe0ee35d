//! From the start that is given to one on the constraints.

use super::agenda::Agenda;
use super::integrals::Integrals;
use super::record::{Recorder, Sink};
use super::{START_BOUND, Simulation, obstacles};
use crate::assemble::{Residuals, State};
use crate::dense::Rows;
use crate::error::Error;
use crate::integrate::{Method, Settings, Tolerance};
use crate::manifold::{Projector, STALLED, Stabilisation};
use crate::measure::Measure;
use crate::mechanism::Prepared;
use crate::naming;
use crate::solver::Solver;
use crate::spec::Spec;
use crate::trajectory::{Trajectory, Work};

/// States between the ends of steps are off by some ten tolerances; so many times that much is expected at most, of RATTLE's of this one.
const INTERPOLATED: f64 = 100.0;
const RATTLE: f64 = 1e-5;

/// Velocities of a start that are next to along its constraints are known to this share of the tolerance.
const EXACT: f64 = 1e-3;

/// An angle whose rounding is above this, in rad, is no angle any more: sines and cosines of it have lost two thirds of their digits.
const BLUR: f64 = 1e-5;

impl Simulation {
    /// What takes the records of a run to `t_end`, the consistent start, and what a method is to be told.
    pub(super) fn admit<'s>(
        &mut self,
        t_end: f64,
        sink: Option<Sink<'s>>,
    ) -> Result<(Recorder<'s>, State, Settings), Error> {
        self.check(t_end, sink.is_none())?;
        let backward = self.start.as_ref().is_some_and(|start| t_end < start.t);
        if let Stabilisation::Baumgarte(feedback) = &mut self.stabilisation
            && backward
        {
            feedback.alpha = -feedback.alpha;
        }
        let mut trajectory = self.trajectory();
        let mut projector = Projector::new(&self.mechanism);
        let (start, floor, tolerance) =
            self.consistent_start(t_end, &mut projector, &mut trajectory.work)?;
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
        t_end: f64,
        projector: &mut Projector,
        work: &mut Work,
    ) -> Result<(State, f64, Tolerance), Error> {
        let spec = self.mechanism.spec();
        let Some(start) = self.start.clone() else {
            return Err(Error::invalid("start", "is missing"));
        };
        let mech = &self.mechanism;
        start.check(mech)?;
        let State { t, q, v } = start;
        check_angles(mech, &q)?;
        let (mut new_q, mut new_v) = (q.clone(), v.clone());
        let position = projector.position(t, &mut new_q, &v)?;
        let measure = Measure::at(mech, t, [&new_q, &v]);
        let mut size = measure.size(&q).max(measure.size(&v));
        // Where nothing is known of the mechanism, the unit is what things are compared with.
        let reach = measure.reach(mech, t, [&new_q, &v], size, self.tolerance);
        let most = reach.unwrap_or(1.0);
        if size > 0.0 && size < most {
            // Coordinates may be measured from where they start; rounding, for one, is then not that of their size.
            size = size.max(projector.length(&new_q, &v));
        }
        // A start at zero in all coordinates has no size.
        let size = if size > 0.0 { size.min(most) } else { most };
        let speed = self.speed(size, &measure, [&new_q, &v], t_end - t);
        let tolerance = self.tolerance_of([size, speed], &measure);
        let of_q = tolerance.floors[..q.len()].iter();
        let absolute: Vec<f64> = of_q.map(|x| tolerance.relative * x).collect();
        // Beside what the equations know of lengths less than its rounding is nothing, and may be all that assembly has left of zeros.
        let nothing = f64::EPSILON * reach.unwrap_or(0.0);
        let units = absolute.iter().zip(&measure.scale);
        let allowed: Vec<f64> = units.map(|(x, unit)| x + nothing * unit).collect();
        let velocity = projector.velocity(t, &new_q, &mut new_v);
        let stays = near([&q, &new_q], &allowed, &measure);
        let keeps = velocity.is_ok() && near([&v, &new_v], &absolute, &measure);
        let exact: Vec<f64> = absolute.iter().map(|x| EXACT * x).collect();
        let exactly = EXACT * tolerance.relative;
        let unmoved = [[&q, &new_q], [&v, &new_v]]
            .into_iter()
            .all(|[old, new]| within(exactly, [old, new], &exact, &measure));
        if !unmoved
            && projector.is_met(t, &q, &v)
            && goes_along(mech, (t, &q, &v), &measure, exactly)
        {
            // Beside a singular position what rounding leaves of residuals moves a state by more than that.
            work.projections += 1;
            return Ok((State { t, q, v }, size, tolerance));
        }
        if !stays {
            let residual = Residuals::at(mech, t, &q, &v).position;
            return Err(off_constraint(spec, "position", &residual));
        }
        let velocity = velocity?;
        if !keeps {
            let residual = Residuals::at(mech, t, &new_q, &v).velocity;
            return Err(off_constraint(spec, "velocity", &residual));
        }
        work.projections += 1;
        work.projection_iterations += position.iterations + velocity.iterations;
        let (q, v) = (new_q, new_v);
        Ok((State { t, q, v }, size, tolerance))
    }

    /// What velocities that are less count as, measured, in a run over the time `span`: `size` in a unit of time, but no more than what the
    /// motion has at its start, or gets to within `size` by its acceleration there, or needs to go that far at all; and no less than a
    /// small part of these, as the unit of time may be long beside the motion.
    fn speed(&self, size: f64, measure: &Measure, [q, v]: [&[f64]; 2], span: f64) -> f64 {
        let moving = measure.size(v);
        let start = self.start.as_ref().filter(|_| moving < size);
        let Some(State { t, .. }) = start else {
            return size.max(FAST * moving);
        };
        let mut acceleration = vec![0.0; q.len()];
        let mut solver = Solver::new(&self.mechanism, self.solver_options());
        // Where there is none, nothing is known.
        match solver.acceleration(*t, q, v, &mut acceleration) {
            Ok(()) => {
                let gained = (size * measure.size(&acceleration)).sqrt();
                let known = moving.max(size / span.abs()).max(gained);
                size.min(known).max(FAST * gained)
            }
            Err(_) => size,
        }
    }

    /// The tolerance of a run with these sizes of coordinates and velocities, measured.
    fn tolerance_of(&self, sizes: [f64; 2], measure: &Measure) -> Tolerance {
        let floors = sizes.into_iter().flat_map(|size| {
            measure.scale.iter().map(move |unit| match self.absolute {
                Some(absolute) => absolute / self.tolerance,
                None => size * unit,
            })
        });
        Tolerance {
            relative: self.tolerance,
            floors: floors.collect(),
        }
    }
}

/// Velocities count as no less than this part of what a motion begins with, or gains at once.
const FAST: f64 = 1e-4;

/// Whether velocities are along the constraints but for rounding, or this share of what their rows are where they do not all but vanish.
fn goes_along(
    mech: &Prepared,
    (t, q, v): (f64, &[f64], &[f64]),
    measure: &Measure,
    relative: f64,
) -> bool {
    let m = mech.spec().m();
    let (mut rates, mut jacobian) = (vec![0.0; m], vec![0.0; q.len() * m]);
    mech.residual_rate(t, q, v, &mut rates);
    mech.jacobian(t, q, v, &mut jacobian);
    let rows = Rows::all(&jacobian, m);
    let rounding = STALLED.max(relative) * measure.size(v);
    rates.iter().enumerate().all(|(c, rate)| {
        let size = rows.largest(c, &measure.scale);
        let size = measure.size_of_vanishing(c, size).unwrap_or(size);
        rate.abs() <= rounding * size
    })
}

/// An error where a coordinate in a sine, cosine or tangent of the equations, or a parameter added to something there, is so large that it
/// is rounded by more than [`BLUR`]. An error control relative to the coordinate does not see it.
fn check_angles(mech: &Prepared, q: &[f64]) -> Result<(), Error> {
    let spec = mech.spec();
    let refuse = |what, name, x: f64, times: f64| {
        let rounding = times * x.abs() * f64::EPSILON;
        if rounding <= BLUR {
            return Ok(());
        }
        let reason = format!(
            "has `{name}` = {x:e}, an angle that is rounded by {rounding:.0e} rad; take whole turns off it"
        );
        Err(Error::invalid(what, reason))
    };
    let mut angles = spec.structure.angles.iter();
    angles.try_for_each(|i| refuse("start", spec.coords[*i], q[*i], 1.0))?;
    let (mut phases, values) = (spec.structure.phases.iter(), mech.parameters());
    phases.try_for_each(|(i, times)| refuse("mechanism", spec.params[*i].name, values[*i], *times))
}

/// Whether a projection from `before` to `after` is within [`START_BOUND`] and the absolute tolerances.
fn near(pair: [&[f64]; 2], absolute: &[f64], measure: &Measure) -> bool {
    within(START_BOUND, pair, absolute, measure)
}

/// Whether each coordinate changes from `before` to `after` by no more than this share of the state's size, plus its absolute tolerance.
fn within(share: f64, [before, after]: [&[f64]; 2], absolute: &[f64], measure: &Measure) -> bool {
    let size = share * measure.size(before);
    let changes = before
        .iter()
        .zip(after)
        .map(|(before, after)| (after - before).abs());
    let mut all = changes.zip(measure.scale.iter().zip(absolute));
    all.all(|(change, (unit, absolute))| change <= size * unit + absolute)
}

fn off_constraint(spec: &Spec, level: &'static str, residual: &[f64]) -> Error {
    let constraints = naming::offending(spec, residual, |_| 1.0);
    Error::OffConstraint { level, constraints }
}
