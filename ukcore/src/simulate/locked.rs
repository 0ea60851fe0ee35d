//! Switches that stay at their zeros: rates of joints that constraints lock, of which dry friction takes the sign. It is 0 there, whatever
//! rounding makes of the rate: constraints take up the force in the joint, but off them, at stages of a step, not all of one that flips.

use crate::integrate::sample::Sample;
use crate::kinks::slopes;
use crate::mechanism::{Branch, Dynamics, Prepared};
use crate::scalar::Sloped;
use crate::solver::Solver;

/// Those of the switches `among` whose functions constraints keep at zero at a state: what is 0 where nothing moves, and which no velocity
/// changes that they allow. `solver` is one for the purpose, in the branches of the run.
pub(super) fn locked(
    solver: &mut Solver,
    sloped: &Prepared<Sloped, dyn Dynamics<Sloped>>,
    among: &[usize],
    at: Sample<'_>,
) -> Vec<usize> {
    let switches = solver.mechanism().spec().switches;
    let rates = among.iter().copied().filter(|k| switches[*k].at_rest);
    let rates: Vec<usize> = rates.collect();
    if rates.is_empty() {
        return rates;
    }
    // In any of their branches.
    let mechanism = solver.mechanism_mut();
    rates
        .iter()
        .for_each(|k| mechanism.hold(*k, Branch::Positive));
    let n = at.v.len();
    let slopes = slopes(sloped, at.t, [at.q, at.v], n..2 * n);
    let own = rates
        .iter()
        .map(|k| slopes.row(*k).iter().copied().collect());
    let mut own: Vec<Vec<f64>> = own.collect();
    let locked = solver.locks((at.t, at.q, at.v), &mut own);
    let pairs = rates.into_iter().zip(locked.unwrap_or_default());
    pairs
        .filter_map(|(k, locked)| locked.then_some(k))
        .collect()
}
