//! Dead centres of what constraints drive by the time.

use nalgebra::{DMatrix, DVector, Dyn, SVD};

use crate::assemble::State;
use crate::displacements::{constraint_matrix, null_space, units};
use crate::error::Error;
use crate::mechanism::Prepared;
use crate::scan::{largest, or_one};
use crate::spec::Spec;
use crate::spectrum::singular;

use super::measured_rows;

/// Next to a dead centre drives move a mechanism that is free to go on by less than this share of its way, in units of inertia: no run gets
/// nearer, as what is driven is off by the square of it.
pub(crate) const STANDS: f64 = 1e-4;
/// So much nearer than most positions reactions have grown until they are no numbers any more.
pub(crate) const NEARLY: f64 = 1e-2;
/// So far beside a dead centre, as an angle, drives move the mechanism again, by at least this part of that.
const BESIDE: f64 = 1e-2;
const AWAY: f64 = 0.1;
/// A drive takes part if it has this share of what takes most.
const SHARE: f64 = 1e-3;

/// The limit of motion that `state` is at, or next to, to the share `still`: on a way that the other constraints leave free what the time
/// prescribes stands still, while it is to go on. An [`Error::DeadCentre`]; `None` elsewhere.
pub(crate) fn dead_centre(mech: &Prepared, state: &State, still: f64) -> Option<Error> {
    let spec = mech.spec();
    let State { t, q, v } = state;
    if spec.structure.scleronomic || !q.iter().chain(v).all(|x| x.is_finite()) {
        return None;
    }
    // ∂φ/∂t, which is all that a mechanism at rest has of φ̇.
    let mut pace = vec![0.0; spec.m()];
    mech.residual_rate(*t, q, &vec![0.0; q.len()], &mut pace);
    let most = largest(&pace[..spec.holonomic]);
    let moves = |row: &usize| *row < spec.holonomic && pace[*row].abs() > SHARE * most;
    let (drives, joints): (Vec<usize>, Vec<usize>) = (0..spec.m()).partition(moves);
    if drives.is_empty() {
        return None;
    }
    let (svd, free) = driven(mech, state, &drives, &joints)?;
    let least = svd.singular_values.imin();
    if svd.singular_values[least] > still {
        return None;
    }
    let (shares, way) = (
        svd.u?.column(least).into_owned(),
        svd.v_t?.row(least).transpose(),
    );
    let asked = shares
        .iter()
        .zip(&drives)
        .map(|(share, row)| share * pace[*row]);
    if asked.sum::<f64>().abs() <= SHARE * most * shares.amax() {
        return None;
    }
    let way: DVector<f64> = free * way;
    let moved = way.component_mul(&units(mech, state));
    // Drives that say the same are none that stand still: they do so on the way, too.
    let goes = |part: f64| {
        let beside = State {
            q: beside(mech, q, moved.as_slice(), part),
            ..state.clone()
        };
        let there = driven(mech, &beside, &drives, &joints);
        there.is_some_and(|(there, _)| there.singular_values.min() >= AWAY * BESIDE)
    };
    if ![BESIDE, -BESIDE].into_iter().any(goes) {
        return None;
    }
    let taking = drives.iter().zip(shares.iter());
    let taking = taking.filter(|(_, share)| share.abs() > SHARE * shares.amax());
    let taking: Vec<usize> = taking.map(|(row, _)| *row).collect();
    Some(Error::DeadCentre {
        constraints: spec.constraint_names(&taking),
        leader: spec.coords[leader(spec, way.as_slice())].to_owned(),
    })
}

/// The coordinate that goes farthest on a `way`, measured: an angle, if one goes at least half as far, since that can be driven all around.
pub(crate) fn leader(spec: &Spec, way: &[f64]) -> usize {
    let farthest = |all: &mut dyn Iterator<Item = usize>| {
        all.max_by(|i, j| way[*i].abs().total_cmp(&way[*j].abs()))
    };
    let any = farthest(&mut (0..way.len())).unwrap_or_default();
    let angle = farthest(&mut spec.structure.angles.iter().copied());
    let angle = angle.filter(|j| way[*j].abs() >= 0.5 * way[any].abs());
    angle.unwrap_or(any)
}

/// How far rows of `drives` go, each measured and of length 1, on the ways that those of `joints` leave free, as a decomposition, and these
/// ways, measured, in columns; `None` where nothing is free.
fn driven(
    mech: &Prepared,
    state: &State,
    drives: &[usize],
    joints: &[usize],
) -> Option<(SVD<f64, Dyn, Dyn>, DMatrix<f64>)> {
    let units = units(mech, state);
    let free = null_space(constraint_matrix(mech, state).select_rows(joints), &units);
    let acting = measured_rows(mech, state).select_rows(drives) * &free;
    let svd = (!free.is_empty()).then(|| singular(acting, true, true))??;
    Some((svd, free))
}

/// `q` and a `part` of the way `moved`, by the angle that goes farthest, or the coordinate beside the size of all that are none.
fn beside(mech: &Prepared, q: &[f64], moved: &[f64], part: f64) -> Vec<f64> {
    let angles = mech.spec().structure.angles;
    let others = (0..q.len()).filter(|j| !angles.contains(j));
    let size = or_one(others.fold(0.0, |most: f64, j| most.max(q[j].abs())));
    let sizes = moved
        .iter()
        .enumerate()
        .map(|(j, by)| match angles.contains(&j) {
            true => by.abs(),
            false => by.abs() / size,
        });
    let far = or_one(sizes.fold(0.0, f64::max));
    let pairs = q.iter().zip(moved);
    pairs.map(|(q, by)| q + part / far * by).collect()
}
