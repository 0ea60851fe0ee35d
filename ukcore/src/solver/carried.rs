//! What rounding of all that goes into the equations makes of accelerations.

use super::{Given, Solver, SolverOptions};
use crate::mechanism::Prepared;
use crate::noise::Noise;
use crate::rounding::signs;

/// The most that rounding makes of the acceleration of each coordinate: that of numbers that no state shows, too, as of large forces that
/// cancel, or of a phase beside an angle. Nothing where there are no accelerations.
#[cold]
pub(crate) fn carried(mechanism: &Prepared, at: Given<'_>) -> Option<Vec<f64>> {
    let (t, q, v) = at;
    let (n, m) = (mechanism.spec().n(), mechanism.spec().m());
    let (mut acceleration, mut multipliers) = (vec![0.0; n], vec![0.0; m]);
    let mut solver = Solver::new(mechanism.clone(), SolverOptions::default());
    let formula = solver.balance(at, &mut acceleration, &mut multipliers);
    let formula = formula.ok()?;
    let mut noise = Noise::new(mechanism);
    noise.go(mechanism, t, [q, v], |_| [0.0; 2]);
    let (mut force, mut rhs) = (vec![0.0; n], vec![0.0; m]);
    noise.motion(&acceleration, &mut rhs);
    noise.balance(&acceleration, &multipliers, &mut force);
    // They are off in any direction, and what directions make of them differs little where there are several.
    let mut most = vec![0.0_f64; n];
    for signs in signs() {
        let mut signs = signs.map(|sign| f64::EPSILON * sign);
        let mut off = |bounds: &[f64]| -> Vec<f64> {
            let pairs = bounds.iter().zip(&mut signs);
            pairs.map(|(bound, sign)| bound * sign).collect()
        };
        let (force, rhs) = (off(&force), off(&rhs));
        let mut out = vec![0.0; n];
        solver.respond(formula, &force, &rhs, &mut out);
        let pairs = most.iter_mut().zip(out);
        pairs.for_each(|(most, x)| *most = most.max(x.abs()));
    }
    Some(most)
}
