//! Random states on the constraints near a given one, the same in every run.

use nalgebra::DVector;

use crate::assemble::State;
use crate::displacements::{constraint_matrix, null_space, units};
use crate::manifold::Projector;
use crate::mechanism::{Evaluated, Prepared};
use crate::random::Random;
use crate::scan::{all_finite, largest, or_one};

/// Displacements are this part of the largest coordinate, and times are as far off; half as much each time it is too far.
const SPREAD: f64 = 0.2;
/// The number of halvings after which the state itself is taken.
const HALVINGS: i32 = 24;

/// States near one that tell what holds at it alone.
const NEIGHBOURS: usize = 3;

/// Some states [near](nearby) `from`, as far as they are found; the same each time.
pub(crate) fn neighbours(mech: &Prepared, from: &State) -> impl Iterator<Item = State> {
    let mut random = Random::new(0x5eed);
    (0..NEIGHBOURS).filter_map(move |_| nearby(mech, from, &mut random))
}

/// A random state on the constraints near `from`, which is on them or nearly so: displaced in the directions that the constraints allow,
/// with other velocities, and at another time where constraints depend on time. `None` where none is found at which all terms of the
/// equations are finite.
pub(crate) fn nearby(mech: &Prepared, from: &State, random: &mut Random) -> Option<State> {
    let spec = mech.spec();
    let n = spec.n();
    let units = units(mech, from);
    let free = null_space(constraint_matrix(mech, from), &units);
    let mut projector = Projector::new(mech);
    let size = or_one(largest(&from.q).max(projector.length(&from.q, &from.v)));
    let shares = DVector::from_vec(random.vector(free.ncols()));
    let mut way = (free * shares).component_mul(&units);
    let longest = way.amax();
    if longest > 0.0 {
        way *= size / longest;
    }
    let later = 0.5 * (random.signed() + 1.0);
    let speed = size.max(largest(&from.v));
    let pushes = random.vector(n);
    let factors = (0..HALVINGS).map(|k| SPREAD * 0.5_f64.powi(k));
    factors.chain([0.0]).find_map(|factor| {
        let mut t = from.t;
        if !spec.structure.scleronomic {
            t += factor * later;
        }
        let moved = from.q.iter().zip(way.iter());
        let mut q: Vec<f64> = moved.map(|(q, d)| q + factor * d).collect();
        let pushed = from.v.iter().zip(&pushes);
        let mut v: Vec<f64> = pushed.map(|(v, d)| v + SPREAD * speed * d).collect();
        projector.position(t, &mut q, &v).ok()?;
        projector.velocity(t, &q, &mut v).ok()?;
        let state = State { t, q, v };
        is_finite(mech, &state).then_some(state)
    })
}

/// Whether all terms of the equations of motion are finite at `state`.
pub(crate) fn is_finite(mech: &Prepared, state: &State) -> bool {
    let mut terms = Evaluated::new(mech.spec().n(), mech.spec().m());
    terms.dynamics(mech, state.t, &state.q, &state.v);
    terms.all().into_iter().all(all_finite)
}
