//! Switches that make nothing: those of dry friction in a joint that other constraints lock, which take up all of its force.

use crate::integrate::sample::Sample;
use crate::mechanism::{Branch, Dynamics, Evaluated, Prepared};
use crate::scalar::{Scalar, Sloped, Slopes};
use crate::solver::Solver;

/// Forces differ between branches where they do by more than this share of themselves: less is rounding of their terms.
const DIFFERENT: f64 = 1e-12;

/// Those of the switches `among` that constraints lock at a state on them: the functions are rates that these keep at zero, and they take
/// up all that forces of both branches differ by. `solver` is one for the purpose, in the branches of the run.
pub(super) fn locked(
    solver: &mut Solver,
    sloped: &Prepared<Sloped, dyn Dynamics<Sloped>>,
    among: &[usize],
    at: Sample<'_>,
) -> Vec<usize> {
    let spec = solver.mechanism().spec();
    let rates = among.iter().copied().filter(|k| spec.switches[*k].at_rest);
    let changes = rates.filter_map(|k| Some((k, change(solver.mechanism(), k, at)?)));
    let (rates, mut forces): (Vec<usize>, Vec<(Vec<f64>, f64)>) = changes.unzip();
    if rates.is_empty() {
        return Vec::new();
    }
    forces.extend(
        slopes(sloped, &rates, at)
            .into_iter()
            .map(|slope| (slope, 0.0)),
    );
    // In any of their branches.
    let mechanism = solver.mechanism_mut();
    rates
        .iter()
        .for_each(|k| mechanism.hold(*k, Branch::Positive));
    let Ok(taken) = solver.takes_up((at.t, at.q, at.v), &mut forces) else {
        return Vec::new();
    };
    let (forces, slopes) = taken.split_at(rates.len());
    let pairs = rates.into_iter().zip(forces.iter().zip(slopes));
    pairs
        .filter_map(|(k, (force, slope))| (*force && *slope).then_some(k))
        .collect()
}

/// What forces of the two branches of switch `k` differ by, and which share of that is rounding; nothing if that is all, or more differs.
fn change(mechanism: &Prepared, k: usize, at: Sample<'_>) -> Option<(Vec<f64>, f64)> {
    let spec = mechanism.spec();
    let mut sides = [(); 2].map(|()| Evaluated::new(spec.n(), spec.m()));
    for (side, held) in sides.iter_mut().zip(mechanism.on_both_sides(k)) {
        side.dynamics(&held, at.t, at.q, at.v);
    }
    let [one, other] = &sides;
    let alike = |of: fn(&Evaluated) -> &Vec<f64>| of(one) == of(other);
    if !(alike(|of| &of.mass) && alike(|of| &of.jacobian) && alike(|of| &of.rhs)) {
        return None;
    }
    let (mut change, mut size) = (vec![0.0; spec.n()], 0.0_f64);
    for (one, other) in [(&one.force, &other.force), (&one.nonideal, &other.nonideal)] {
        for (change, (one, other)) in change.iter_mut().zip(one.iter().zip(other)) {
            *change += one - other;
            size = size.max(one.abs()).max(other.abs());
        }
    }
    let most = change.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    (most > DIFFERENT * size).then(|| (change, f64::EPSILON * size / most))
}

/// The derivatives of switching functions by velocities.
fn slopes(
    sloped: &Prepared<Sloped, dyn Dynamics<Sloped>>,
    switches: &[usize],
    at: Sample<'_>,
) -> Vec<Vec<f64>> {
    let constants = |x: &[f64]| x.iter().map(|x| Sloped::from_f64(*x)).collect::<Vec<_>>();
    let (q, n) = (constants(at.q), at.v.len());
    let mut values = constants(&vec![0.0; sloped.spec().switches.len()]);
    let mut slopes = vec![vec![0.0; n]; switches.len()];
    for first in (0..n).step_by(Slopes::COUNT) {
        let seeds = at.v.iter().enumerate();
        let seeds = seeds.map(|(j, v)| Sloped::new(*v, Slopes::unit(j, first)));
        let v: Vec<Sloped> = seeds.collect();
        sloped.switching(Sloped::from_f64(at.t), &q, &v, &mut values);
        for (slope, k) in slopes.iter_mut().zip(switches) {
            let parts = slope[first..].iter_mut().take(Slopes::COUNT);
            for (j, part) in parts.enumerate() {
                *part = values[*k].eps.along(j);
            }
        }
    }
    slopes
}
