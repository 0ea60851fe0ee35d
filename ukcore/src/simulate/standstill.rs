//! Whether a run ends where dry friction brings a body to rest: where that is far from the start, steps are lost in the rounding of the
//! time before enough of them have gone to and fro to tell.

use crate::assemble::State;
use crate::scan::largest;
use crate::solver::Solver;
use crate::spec::SwitchSpec;

/// A motion that comes to rest within so many of the shortest steps is there.
pub(super) const FEW: f64 = 64.0;

/// A force without bound has grown by more than this factor where half of a length is left: the root of it by 1.4.
const GROWN: f64 = 1.2;

/// The terms that divide by a length which comes to zero within a few steps of the size `step` from a state, where accelerations stay as
/// they are on the way there: those of dry friction do, and not those of a force without bound.
pub(super) fn terms(
    solver: &mut Solver,
    from: &State,
    acceleration: &[f64],
    step: f64,
) -> Vec<String> {
    let (switches, reach) = (solver.mechanism().spec().switches, FEW * step);
    let moved = |time: f64| {
        let along = |x: &[f64], rate: &[f64]| -> Vec<f64> {
            let pairs = x.iter().zip(rate);
            pairs.map(|(x, rate)| x + time * rate).collect()
        };
        State {
            t: from.t + time,
            q: along(&from.q, &from.v),
            v: along(&from.v, acceleration),
        }
    };
    let lengths = |State { t, q, v }: &State| solver.mechanism().switches_at(*t, q, v);
    let [here, there] = [0.0, reach].map(|time| lengths(&moved(time)));
    let near = |k: &usize| switches[*k].length && here[*k] < 0.5 * there[*k];
    let near: Vec<usize> = (0..switches.len()).filter(near).collect();
    // At the rate at which it changes over those steps, half of the length is left then.
    let stays = |k: &usize| {
        let half = 0.5 * here[*k] * reach / (there[*k] + here[*k]);
        let State { t, q, v } = &moved(half);
        let mut then = vec![0.0; q.len()];
        let found = solver.acceleration(*t, q, v, &mut then).is_ok();
        found && largest(&then) <= GROWN * largest(acceleration)
    };
    let found: Vec<usize> = near.into_iter().filter(stays).collect();
    SwitchSpec::terms(found.iter().map(|k| &switches[*k]))
}
