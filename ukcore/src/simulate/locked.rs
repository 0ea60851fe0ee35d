//! Switches that make nothing: those of dry friction in a joint that other constraints lock, which take up all of its force.

use crate::integrate::sample::Sample;
use crate::mechanism::{Branch, Evaluated};
use crate::solver::Solver;

/// Forces differ between branches where they do by more than this share of themselves: less is rounding of their terms.
const DIFFERENT: f64 = 1e-12;

/// Whether constraints take up all that forces of the two branches of switch `k` differ by at a state on them. `solver` is one for the
/// purpose, in the branches of the run.
pub(super) fn takes_up(solver: &mut Solver, k: usize, at: Sample<'_>) -> bool {
    let spec = solver.mechanism().spec();
    let mut sides = [(); 2].map(|()| Evaluated::new(spec.n(), spec.m()));
    for (side, held) in sides.iter_mut().zip(solver.mechanism().on_both_sides(k)) {
        side.dynamics(&held, at.t, at.q, at.v);
    }
    let [one, other] = &sides;
    let [
        [mass, force, nonideal, a, b],
        [mass_, force_, nonideal_, a_, b_],
    ] = [one.all(), other.all()];
    if [mass, a, b] != [mass_, a_, b_] {
        return false;
    }
    let (mut change, mut size) = (vec![0.0; force.len()], 0.0_f64);
    for (one, other) in [(force, force_), (nonideal, nonideal_)] {
        for (change, (one, other)) in change.iter_mut().zip(one.iter().zip(other)) {
            *change += one - other;
            size = size.max(one.abs()).max(other.abs());
        }
    }
    let most = change.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    // In either of its branches.
    solver.mechanism_mut().hold(k, Branch::Positive);
    let lost = f64::EPSILON * size / most;
    most > DIFFERENT * size && solver.takes_up((at.t, at.q, at.v), &mut change, lost)
}
