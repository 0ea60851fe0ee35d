//! Whether what acts at rest has the potential that is declared.

use nalgebra::{DMatrix, DVector};

use super::Search;
use crate::assemble::State;
use crate::mechanism::Evaluated;
use crate::scalar::{Scalar, Sloped, Slopes};

/// A displacement for differences of the potential, as a part of the coordinates, and the share of forces that these are known to.
const SLOPE: f64 = 1e-5;
const MATCHED: f64 = 1e-6;

impl Search {
    /// Whether Q and c at this state of rest are those of the potential, as far as its differences tell: those to both sides of the state,
    /// or, beside a kink of its slope as at a stop, those to one.
    pub(super) fn is_driven_by_potential(&self, state: &State, units: &DVector<f64>) -> bool {
        let (mech, State { t, q, v }) = (&self.mech, state);
        if mech.spec().structure.conservative {
            return true;
        }
        let mut terms = Evaluated::new(mech.spec().n(), mech.spec().m());
        terms.dynamics(mech, *t, q, v);
        let here = mech.energy(*t, q, v).potential;
        let (mut off, mut parts) = (0.0_f64, 0.0);
        let mut moved = q.clone();
        for (i, unit) in units.iter().enumerate() {
            let h = SLOPE * self.size * unit;
            let mut rise = |part: f64| {
                moved[i] = q[i] + part * h;
                let there = mech.energy(*t, &moved, v).potential;
                moved[i] = q[i];
                (there - here, f64::EPSILON * (there.abs() + here.abs()))
            };
            let force = terms.force[i] + terms.nonideal[i];
            let (mut slope, mut rounding, mut miss) = (0.0, 0.0, f64::INFINITY);
            for [one, other] in [[1.0, -1.0], [1.0, 2.0], [-1.0, -2.0]] {
                let shares = [other / one, -one / other].map(|x| x / (other - one) / h);
                let (near, far) = (rise(one), rise(other));
                let tried = shares[0] * near.0 + shares[1] * far.0;
                if (force + tried).abs() < miss {
                    (slope, miss) = (tried, (force + tried).abs());
                    rounding = shares[0].abs() * near.1 + shares[1].abs() * far.1;
                }
                if miss <= MATCHED * slope.abs() {
                    break;
                }
            }
            off = off.max(miss * unit);
            // What rounding makes of the difference, too.
            parts += (force.abs() + slope.abs() + rounding / MATCHED) * unit;
        }
        off <= MATCHED * parts && !self.is_held_by_turning(state, units)
    }

    /// Whether forces turn velocities, as those of a frame that turns do: they may hold what is at the top of a potential, whatever else
    /// damps it. That is so where ∂(Q + c)/∂q̇ is not symmetric at rest; what has no derivative there, as friction, resists whatever moves.
    fn is_held_by_turning(&self, state: &State, units: &DVector<f64>) -> bool {
        let (n, sloped) = (state.q.len(), self.mech.sloped());
        let constant = |x: &f64| Sloped::from_f64(*x);
        let (t, q) = (constant(&state.t), state.q.iter().map(constant));
        let q: Vec<Sloped> = q.collect();
        let mut terms = Evaluated::<Sloped>::new(n, self.mech.spec().m());
        let mut slopes = DMatrix::<f64>::zeros(n, n);
        for first in (0..n).step_by(Slopes::COUNT) {
            let v = (0..n).map(|j| Sloped::new(0.0, Slopes::unit(j, first)));
            terms.dynamics(&sloped, t, &q, &v.collect::<Vec<_>>());
            for j in first..n.min(first + Slopes::COUNT) {
                for i in 0..n {
                    let along = |force: &[Sloped]| force[i].eps.along(j - first);
                    let slope = along(&terms.force) + along(&terms.nonideal);
                    slopes[(i, j)] = units[i] * units[j] * slope;
                }
            }
        }
        let largest = |matrix: &DMatrix<f64>| {
            let finite = matrix.iter().filter(|x| x.is_finite());
            finite.fold(0.0_f64, |most, x| most.max(x.abs()))
        };
        largest(&(&slopes - slopes.transpose())) > MATCHED * largest(&slopes)
    }
}
