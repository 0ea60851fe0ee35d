//! Switches that stay at their zeros: rates of joints that constraints lock, of which dry friction takes the sign. It is 0 there, whatever
//! rounding makes of the rate: constraints take up the force in the joint, but off them, at stages of a step, not all of one that flips.

use crate::integrate::sample::Sample;
use crate::mechanism::{Branch, Dynamics, Prepared};
use crate::scalar::{Scalar, Sloped, Slopes};
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
    let mut slopes = slopes(sloped, &rates, at);
    let locked = solver.locks((at.t, at.q, at.v), &mut slopes);
    let pairs = rates.into_iter().zip(locked.unwrap_or_default());
    pairs
        .filter_map(|(k, locked)| locked.then_some(k))
        .collect()
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
