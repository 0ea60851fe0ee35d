//! Where a motion does not get through: branches of the constraints that meet, jumps, accelerations out of all proportion.

use super::crossing;
use super::standstill;
use super::vanishing::{BEFORE, Loss, Vanishing, between_states};
use crate::assemble::{Residuals, State};
use crate::dense::Rows;
use crate::diagnosis::{STANDS, dead_centre, lost_reactions};
use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::integrate::{Singular, Step, Tolerance, Trouble};
use crate::manifold::{Projector, STALLED};
use crate::measure::Measure;
use crate::mechanism::{Branch, Prepared};
use crate::naming;
use crate::noise::Noise;
use crate::scan::{axpy, largest};
use crate::solver::{Accepted, RANK_CEILING, Solver, SolverOptions};
use crate::spec::Spec;

/// Significance of a constraint, √ε, below which the state cannot tell on which side of a singular position it is.
const SINGULAR: f64 = 1.5e-8;

/// The share of its size below which a row that reverses its direction is taken to be zero there.
const UNTOLD: f64 = 1e-5;

/// The share of its size below which a row tells where it is going to vanish: a nonholonomic one, of which that is looked at; one of
/// branches that come near each other without touching.
const NEARLY: f64 = 1e-3;
const HARDLY: f64 = 1e-8;

/// The share of the time since it was largest in which a row vanishes that falls to these as a power of the time left.
const SOON: f64 = 0.01;

/// The usual way of a motion to a singular position, as a share of that in which the mechanism takes another shape.
const WAY: f64 = 0.1;

/// A motion that has gone no further than this share of the coordinates has only begun.
const BEGUN: f64 = 1e-3;

/// A velocity below this share of the one that is reached within the size of the coordinates is what rounding leaves of rest.
const STILL: f64 = 64.0 * f64::EPSILON;

/// A velocity along an acceleration, in units of the one that is reached within the size of the coordinates: what its path asks for
/// outweighs the forces.
const FAST: f64 = 4.0;

/// Accelerations that are so many times those of the start, and change velocities by this share within the rounding of the time, are no
/// matter of a late time.
const GROWN: f64 = 1e9;
const TURNED: f64 = 0.01;

/// A coordinate without mass that accelerates so many times as much as all that has mass, beside what is allowed, is left to itself.
const LEFT_ALONE: f64 = 1e3;

/// Refuses a step that ends where constraints all but imply each other and that did not begin there.
///
/// A significance δ leaves q off by ε/δ, so below √ε the state does not say on which side of the singular position it is, nor which
/// branch of the motion it takes: any of them conserves energy. A step that passes over the place is not concerned.
pub(super) fn check_branch(
    solver: &mut Solver,
    weakest: f64,
    step: &Step<'_>,
) -> Result<(), Error> {
    if weakest > 16.0 * SINGULAR || weakest_at(solver, step.new)? > SINGULAR {
        return Ok(());
    }
    let error = singular(solver, SINGULAR);
    match weakest_at(solver, step.old)? > SINGULAR {
        true => Err(error),
        false => Ok(()),
    }
}

/// An error that names the constraints whose significance in the last solution was not above `significance`.
fn singular(solver: &Solver, significance: f64) -> Error {
    let spec = solver.mechanism().spec();
    let constraints = spec.constraint_names(solver.rows_below(significance));
    Error::Singular { constraints }
}

/// The least significance of a constraint that counts at a state.
fn weakest_at(solver: &mut Solver, at: Sample<'_>) -> Result<f64, Error> {
    let mut acceleration = vec![0.0; at.q.len()];
    let solved = solver.acceleration_in_run((at.t, at.q, at.v), &mut acceleration);
    // In any case: what is left there would hide what the next step meets.
    let weakest = solver.take_weakest();
    solved.map(|()| weakest)
}

/// Why the nearest consistent state is far from the one `at` which a step arrived that began at `t_old`: a constraint jumps, or
/// constraints all but imply each other there. `None` if neither is found.
pub(super) fn jump(solver: &mut Solver, at: Sample<'_>, t_old: f64) -> Option<Error> {
    let Sample { t, q, v, .. } = at;
    let spec = solver.mechanism().spec();
    // Branches that are not followed do not jump.
    let mut followed = solver.mechanism().clone();
    for k in 0..spec.switches.len() {
        followed.hold(k, Branch::Followed);
    }
    let mut projector = Projector::new(&followed);
    let (mut near_q, mut near_v) = (q.to_vec(), v.to_vec());
    projector.position(t, &mut near_q, v).ok()?;
    projector.velocity(t, &near_q, &mut near_v).ok()?;
    let measure = Measure::at(&followed, t, [q, v]);
    let change = |old: &[f64], new: &[f64]| {
        let changes: Vec<f64> = old.iter().zip(new).map(|(a, b)| a - b).collect();
        measure.size(&changes)
    };
    // Where velocities jump, positions are off by no more than what that makes of them within the step.
    let position = change(q, &near_q) >= 2.0 * (t - t_old).abs() * change(v, &near_v);
    let residual = |t: f64| match position {
        true => Residuals::at(&followed, t, q, v).position,
        false => Residuals::at(&followed, t, &near_q, v).velocity,
    };
    // What the time alone has made of it since the last step, which may have gone just onto the jump.
    let after = residual(t);
    let size = largest(&after);
    let mut rounding = vec![0.0; after.len()];
    let mut noise = Noise::new(&followed);
    noise.go(
        &followed,
        t,
        [if position { q } else { &near_q }, v],
        |_| [0.0; 2],
    );
    match position {
        true => noise.residual(&mut rounding),
        false => noise.residual_rate(&mut rounding),
    }
    let pairs = after.iter().zip(residual(2.0 * t_old - t));
    let jumps = pairs.zip(rounding).map(|((after, before), rounding)| {
        let alone = (after - before).abs() > 0.5 * size;
        // Late, or far off, the time makes that of it by its rounding.
        let known = after.abs() > STALLED * rounding;
        if alone && known { *after } else { 0.0 }
    });
    let jumps: Vec<f64> = jumps.collect();
    if jumps.iter().any(|r| *r != 0.0) {
        return Some(Error::Jump {
            level: if position { "position" } else { "velocity" },
            constraints: naming::offending(spec, &jumps, |_| 1.0),
        });
    }
    let (q, v) = (&near_q[..], &near_v[..]);
    let weakest = weakest_at(solver, Sample { q, v, ..at }).ok()?;
    (weakest <= RANK_CEILING).then(|| singular(solver, RANK_CEILING))
}

/// The error of a motion that steps of this size do not follow, with the coordinate that accelerates most: one without mass, if all that
/// has mass moves as before, and tells ever less of where it is.
fn too_fast(
    spec: &Spec,
    v: &[f64],
    acceleration: &[f64],
    tolerance: &Tolerance,
    step: f64,
) -> Error {
    let n = v.len();
    let share = |i: &usize| acceleration[*i].abs() / tolerance.at(n + i, v[*i].abs());
    let first = (0..n).max_by(|i, j| share(i).total_cmp(&share(j)));
    let name = |i: usize| spec.coords[i].to_owned();
    let massless = spec.structure.massless;
    let massive = (0..n).filter(|i| !massless.contains(i));
    let most = massive.map(|i| share(&i)).fold(0.0, f64::max);
    match first {
        Some(i) if massless.contains(&i) && share(&i) > LEFT_ALONE * most => {
            Error::Underdetermined {
                coordinates: vec![name(i)],
                rank: n - 1,
                needed: n,
            }
        }
        _ => Error::StepTooSmall {
            step,
            fastest: first.map(|i| (name(i), acceleration[i])),
        },
    }
}

/// Whether velocities change within `rounding` of the time by accelerations out of all proportion to those of the start, as where a motion
/// ends in finite time: at an early time it would end there, too.
fn ends(
    solver: &mut Solver,
    start: Sample<'_>,
    (v, acceleration): (&[f64], &[f64]),
    rounding: f64,
) -> bool {
    let mut first = vec![0.0; v.len()];
    let known = solver.acceleration(start.t, start.q, start.v, &mut first);
    let first = largest(&first);
    let grew = known.is_ok() && first > 0.0 && largest(acceleration) > GROWN * first;
    let mut pairs = acceleration.iter().zip(v);
    grew && pairs.any(|(a, v)| (a * rounding).abs() > TURNED * v.abs() && *v != 0.0)
}

/// The error of a motion that constraints do not let go on in the direction of its velocity: those which its next positions violate end
/// there without a gradient, as a length does that is zero.
pub(super) fn stuck(mechanism: &Prepared, at: Sample<'_>) -> Option<Error> {
    let spec = mechanism.spec();
    let residual = Residuals::at(mechanism, at.t, at.q, at.v).position;
    let ended = naming::offending(spec, &residual, |_| 1.0);
    let constraints: Vec<String> = ended.into_iter().map(|(name, _)| name).collect();
    (!constraints.is_empty()).then_some(Error::Singular { constraints })
}

/// The place where a motion from `old` meets the one where A loses a row; `None` where that is of no concern.
pub(super) fn vanishing(mech: &Prepared, found: Loss, old: Sample<'_>) -> Option<Singular> {
    match found {
        Loss::Rows(rows) => {
            let holonomic = mech.spec().holonomic;
            // Beside one that is of no concern nonholonomic ones may be, or one where the motion rests.
            let mut rows = rows.into_iter().enumerate();
            rows.find_map(
                |(k, found)| match k == 0 || found.row >= holonomic || found.rest {
                    true => vanishing_row(mech, found, old),
                    false => None,
                },
            )
        }
        Loss::Within {
            mut row,
            ends: [from, to],
            otherwise,
        } => {
            // Also where nothing tells whether the motion turns there: shorter steps do.
            let met = |position: &Singular| (position.t - from) * (to - position.t) > 0.0;
            let found = crossing::counts(mech, &mut row)
                .then(|| crossing::find(mech, &row.near, Some(&row)))
                .flatten();
            match found.filter(met) {
                Some(position) => Some(Singular {
                    significance: row.reached,
                    ..position
                }),
                None => otherwise.and_then(|other| vanishing(mech, *other, old)),
            }
        }
        Loss::Rank {
            states,
            whole,
            rank,
        } => {
            let [near, behind] = &*states;
            crossing::between(mech, old.t, [near, behind], whole, rank)
        }
    }
}

/// The singular position at which the row `found` vanishes by itself, if it is one.
fn vanishing_row(mech: &Prepared, mut found: Vanishing, old: Sample<'_>) -> Option<Singular> {
    let stood = found.near.t;
    if found.reached < UNTOLD && !found.rest {
        // Where it stands nothing but rounding gives the row a direction.
        found.near = between_states(old, Sample::from(&found.near), 1.0 - BEFORE);
    }
    let mut met = None;
    let spec = mech.spec();
    if !crossing::counts(mech, &mut found) {
        let implied = found.row < spec.holonomic && !found.rest;
        return implied
            .then(|| crossing::implied(mech, old.t, &found))
            .flatten();
    }
    let Vanishing {
        row, near, reached, ..
    } = &found;
    // The row when it is least, and where the step began.
    let sizes = || {
        let mut place = near.q.clone();
        axpy(found.t - near.t, &near.v, &mut place);
        [(found.t, &place[..]), (old.t, old.q)].map(|(t, q)| {
            let mut jacobian = vec![0.0; q.len() * spec.m()];
            mech.jacobian(t, q, old.v, &mut jacobian);
            found.size_in(Rows::all(&jacobian, spec.m()))
        })
    };
    // When it vanishes where it is not reversed yet, if it goes on as it does.
    let ends = |[there, here]: [f64; 2], share: f64| {
        let nearly = there < here.min(share);
        let ahead = (near.t - old.t) * there / (here - there);
        // One that only fades is nowhere soon.
        let soon = ahead.abs() <= SOON * (near.t - found.largest).abs();
        (nearly && soon).then_some(near.t + ahead)
    };
    let reversed = Some(found.t).filter(|t| *t != stood);
    if found.rest {
        // It may leave in any direction, whichever way it came.
    } else if *row < spec.holonomic {
        if let Some(position) = crossing::find(mech, near, Some(&found)) {
            // A motion that had met it would have the row reversed.
            let behind = (position.t - near.t) * (near.t - old.t) < 0.0;
            if behind && reversed.is_none() && position.isolated {
                return None;
            }
            return Some(Singular {
                significance: *reached,
                ..position
            });
        }
        if reversed.is_none() {
            let ends = ends(sizes(), HARDLY);
            met = ends.filter(|ends| crossing::touches(mech, &found, *ends));
        }
    } else {
        let [there, here] = sizes();
        let ends = reversed.or_else(|| ends([there, here], NEARLY));
        met = ends.and_then(|ends| crossing::scattering(mech, &found, ends));
        // A row that vanishes there whatever the velocity says nothing for a moment alone; nor is one of concern that is small already, and
        // not zero where it is least.
        let dips = there <= RANK_CEILING && found.least >= UNTOLD;
        if met.is_none() && (dips || there <= RANK_CEILING * here) {
            return None;
        }
    }
    // Steps are too long yet to tell, or there is more than one way to go on.
    let t = met.unwrap_or(found.t);
    let way = (t - old.t).abs();
    let least = found.least;
    // Where it rests the row grows with the square of the time.
    let (told, share, significance) = match found.rest {
        true => (
            *reached >= UNTOLD,
            (least / (reached - least)).sqrt(),
            least,
        ),
        false => (least >= UNTOLD, least, *reached),
    };
    let missed = (told && met.is_none()).then_some(share);
    let constraints = vec![spec.constraints[*row].name.to_owned()];
    (t != stood).then(|| Singular::seen(t, way, missed, significance, constraints))
}

/// The size of the coordinates at a state, measured; where all are zero, of a radian, or of the lengths in the constraints.
fn size(mechanism: &Prepared, at: Sample<'_>, measure: &Measure) -> f64 {
    let lengths = || Projector::new(mechanism).length(at.q, at.v);
    let sizes = [measure.size(at.q), measure.radian()].into_iter();
    let mut sizes = sizes.chain(std::iter::once_with(lengths)).chain([1.0]);
    let good = |size: &f64| *size > 0.0 && size.is_finite();
    sizes.find(good).unwrap_or(1.0)
}

/// The kinetic energy of a mechanism that is at rest but for rounding: with velocities that move each coordinate by a rounding of their
/// size in the time `step`.
pub(super) fn rounded_rest(mechanism: &Prepared, at: Sample<'_>, step: f64) -> f64 {
    let measure = Measure::at(mechanism, at.t, [at.q, at.v]);
    let way = f64::EPSILON * size(mechanism, at, &measure);
    let mut v = vec![0.0; at.q.len()];
    let units = measure.scale.iter().enumerate();
    let each = units.map(|(i, unit)| {
        v[i] = way * unit / step;
        let kinetic = mechanism.energy(at.t, at.q, &v).kinetic;
        v[i] = 0.0;
        kinetic
    });
    each.sum()
}

/// Whether a motion from `start` can have gone no further than `way` till it got to a state: neither as far as that is off, nor as its
/// velocity and its acceleration at the start would take it in the time.
fn has_begun(
    mechanism: &Prepared,
    start: Sample<'_>,
    there: &State,
    way: f64,
    measure: &Measure,
) -> bool {
    let change: Vec<f64> = there.q.iter().zip(start.q).map(|(a, b)| a - b).collect();
    let time = (there.t - start.t).abs();
    let mut acceleration = vec![0.0; start.q.len()];
    let mut solver = Solver::new(mechanism, SolverOptions::default());
    // Where there is none the velocity tells alone.
    if (solver.acceleration(start.t, start.q, start.v, &mut acceleration)).is_err() {
        acceleration.fill(0.0);
    }
    let gone = time * (measure.size(start.v) + 0.5 * time * measure.size(&acceleration));
    measure.size(&change) <= way && gone <= 2.0 * way
}

/// The constraints that have no gradient at `start`, or are implied there by the others and not beside it, where a motion that is to leave
/// `start` as the state of a contradiction says would contradict them: branches cross there, and it goes along none of them. Constraints
/// that change with time may come apart by themselves.
fn lost_at_start(mechanism: &Prepared, start: Sample<'_>, there: &State) -> Vec<String> {
    let spec = mechanism.spec();
    let measure = Measure::at(mechanism, start.t, [start.q, start.v]);
    let size = size(mechanism, start, &measure);
    if !(spec.structure.scleronomic && has_begun(mechanism, start, there, BEGUN * size, &measure)) {
        return Vec::new();
    }
    let speed = measure.size(&there.v);
    let way = if speed > 0.0 {
        BEGUN * size / speed
    } else {
        0.0
    };
    let pairs = start.q.iter().zip(&there.v);
    let beside: Vec<f64> = pairs.map(|(q, v)| q + way * v).collect();
    let sizes = |q: &[f64]| -> Vec<f64> {
        let mut jacobian = vec![0.0; spec.n() * spec.m()];
        mechanism.jacobian(start.t, q, &there.v, &mut jacobian);
        let rows = Rows::all(&jacobian, spec.m());
        let largest = |c: usize| rows.largest(c, &measure.scale);
        (0..spec.holonomic).map(largest).collect()
    };
    let pairs = sizes(start.q).into_iter().zip(sizes(&beside));
    let lost = pairs.enumerate().filter(|(_, (a, b))| *a < BEGUN * b);
    let lost: Vec<usize> = lost.map(|(c, _)| c).collect();
    match lost.is_empty() {
        true => crossing::at(mechanism, start, &there.v, size, &measure).unwrap_or_default(),
        false => spec.constraint_names(&lost),
    }
}

/// The singular position that a motion is at in a state, or has less to go to than its usual way, and how long that takes.
pub(super) fn just_ahead(mech: &Prepared, at: Sample<'_>, along: f64) -> Option<(f64, Singular)> {
    if mech.spec().m() == 0 {
        return None;
    }
    let measure = Measure::at(mech, at.t, [at.q, at.v]);
    let size = size(mech, at, &measure);
    let reach = measure.reach(mech, at.t, [at.q, at.v], size, 0.0);
    let time = WAY * reach.unwrap_or(size) / measure.size(at.v);
    let found = || crossing::just_ahead(mech, &at.to_state(), along * time);
    let moves = time > 0.0 && time.is_finite();
    moves.then(found).flatten().map(|found| (time, found))
}

/// The error of a run that begins at rest where branches cross, with an acceleration along none of them: a motion that had it for its
/// velocity would contradict the constraints. Such a run would take any.
pub(super) fn leaves_no_branch(mechanism: &Prepared, start: &State) -> Option<Error> {
    let State { t, q, v } = start;
    let spec = mechanism.spec();
    if spec.m() == 0 || !spec.structure.scleronomic {
        return None;
    }
    let mut acceleration = vec![0.0; q.len()];
    if spec.structure.straight_line {
        let certificate = mechanism.acceleration(*t, q, v, &mut acceleration);
        if Accepted::INDEPENDENT.has(certificate) {
            return None;
        }
    }
    let mut solver = Solver::new(mechanism, SolverOptions::default());
    solver.acceleration(*t, q, v, &mut acceleration).ok()?;
    let measure = Measure::at(mechanism, *t, [q, v]);
    let (most, size) = (
        measure.size(&acceleration),
        size(mechanism, start.into(), &measure),
    );
    let rests = measure.size(v) <= STILL * (size * most).sqrt();
    if !(rests && most > 0.0) {
        return None;
    }
    let time = FAST * (size / most).sqrt();
    let there = State {
        v: acceleration.iter().map(|a| a * time).collect(),
        ..start.clone()
    };
    let along = solver.acceleration(*t, q, &there.v, &mut acceleration);
    let trouble = Trouble::new(Sample::from(&there), along.err()?);
    let constraints = match trouble.is_contradiction() {
        true => lost_at_start(mechanism, start.into(), &there),
        false => Vec::new(),
    };
    (!constraints.is_empty()).then(|| start.locate(Error::Singular { constraints }))
}

/// The error of a motion that comes within a few steps of the size `step` to the zero of a switch behind which constraints ask for another
/// velocity.
fn kink(mechanism: &Prepared, at: &State, step: f64) -> Option<Error> {
    let spec = mechanism.spec();
    let [before, behind] = [-standstill::FEW, standstill::FEW].map(|steps| {
        let (time, mut q) = (steps * step, at.q.clone());
        axpy(time, &at.v, &mut q);
        mechanism.switches_at(at.t + time, &q, &at.v)
    });
    let mut near =
        (0..before.len()).filter(|k| before[*k] * behind[*k] <= 0.0 && before[*k] != behind[*k]);
    let speed = Measure::at(mechanism, at.t, [&at.q, &at.v]).size(&at.v);
    near.find_map(|k| {
        let [one, other] = mechanism.on_both_sides(k).map(|held| {
            let mut rate = vec![0.0; spec.m()];
            held.residual_rate(at.t, &at.q, &at.v, &mut rate);
            rate
        });
        let change: Vec<f64> = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).collect();
        (largest(&change) > BEGUN * speed).then(|| Error::Jump {
            level: "velocity",
            constraints: naming::offending(spec, &change, |_| 1.0),
        })
    })
}

/// The error of a run from `start` with this tolerance that ends with `trouble`; where its steps became too small, with the acceleration
/// that has them so.
pub(super) fn explain(
    mechanism: &Prepared,
    start: Sample<'_>,
    tolerance: &Tolerance,
    mut trouble: Trouble,
) -> Error {
    if trouble.is_contradiction() {
        let constraints = lost_at_start(mechanism, start, &trouble.state);
        if !constraints.is_empty() {
            trouble = Trouble::new(start, Error::Singular { constraints });
        }
    }
    let obstacle = matches!(
        trouble.error,
        Error::StepTooSmall { .. }
            | Error::Singular { .. }
            | Error::Jump { .. }
            | Error::OffConstraint { .. }
            | Error::Inconsistent { .. }
    );
    if obstacle && let Some(limit) = dead_centre(mechanism, &trouble.state, STANDS) {
        trouble.error = limit;
    }
    if let Error::StepTooSmall { step, .. } | Error::TooLate { step, .. } = trouble.error {
        let State { t, q, v } = &trouble.state;
        let mut acceleration = vec![0.0; q.len()];
        let mut solver = Solver::new(mechanism, SolverOptions::default());
        let known = solver.acceleration(*t, q, v, &mut acceleration).is_ok();
        let late = match trouble.error {
            Error::TooLate { rounding, .. } => {
                !ends(&mut solver, start, (v, &acceleration), rounding)
            }
            _ => false,
        };
        if known && !late {
            let terms = standstill::terms(&mut solver, &trouble.state, &acceleration, step);
            if !terms.is_empty() {
                trouble.error = Error::Chattering { step, terms };
                return trouble.state.locate(trouble.error);
            }
            if let Some(kink) = kink(mechanism, &trouble.state, step) {
                return trouble.state.locate(kink);
            }
            trouble.error = too_fast(mechanism.spec(), v, &acceleration, tolerance, step);
        }
    }
    let State { t, q, v } = &trouble.state;
    trouble.error = naming::undirected(mechanism, (*t, q, v), trouble.error);
    if let Error::NonFinite { what } = &mut trouble.error
        && mechanism.spec().structure.loaded
        && let Some(last) = what.last_mut()
        && let Some(cause) = lost_reactions(mechanism, &trouble.state)
    {
        *last += &format!("; {cause}");
    }
    trouble.state.locate(trouble.error)
}
