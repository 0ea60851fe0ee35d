//! What stands on the way of a step.

use nalgebra::{DMatrix, DVector};

use super::{BALANCED, Place, Search};
use crate::assemble::assembled;
use crate::displacements::reversed;
use crate::spectrum;

/// A step longer than this part of the coordinates may have come over what stands in its way; it is looked at after these parts.
const SHORT: f64 = 0.05;
const LOOKS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];
/// What constraints allow turns by at most this angle, rad, between two looks.
const TURN: f64 = 0.5;

impl Search {
    /// Whether nothing stands between one place and the other on the way by `step`, as far as places between tell: no singular position,
    /// where a combination of constraints is reversed, or beside which what they allow turns at once; and no barrier, behind which a
    /// potential that has risen falls once more.
    pub(super) fn is_clear(&self, from: &Place, step: &DVector<f64>, to: &Place) -> bool {
        let change = self.change(from, step);
        let looks = if from.part(&change) > SHORT {
            &LOOKS[..]
        } else {
            &[]
        };
        let between = looks.iter().map(|share| {
            let guess = from.aside(&change, *share);
            let state = assembled(&self.mech, &guess, self.positions()).ok()?;
            let energy = self.mech.energy(state.t, &state.q, &state.v);
            let (basis, rows) = self.ways_at(&state, &from.units);
            Some((basis, rows, energy.potential))
        });
        let [first, last] = [from, to].map(|place| {
            let potential = place.potential.unwrap_or_default();
            (place.basis.clone(), place.rows.clone(), potential)
        });
        let falls = from.potential.is_some() && to.potential.is_some();
        let (mut before, mut risen) = (first, false);
        between.chain([Some(last)]).all(|there| {
            let Some((basis, rows, potential)) = there else {
                return false;
            };
            let turned = basis.ncols() == before.0.ncols() && turn(&before.0, &basis) > TURN;
            let clear = !turned && !reversed(before.1.clone(), rows.clone());
            let rounding = BALANCED * (potential.abs() + before.2.abs());
            let barred = falls && risen && potential < before.2 - rounding;
            risen |= potential > before.2 + rounding;
            before = (basis, rows, potential);
            clear && !barred
        })
    }
}

/// The largest angle by which directions of one of two orthonormal bases of as many are off those of the other one.
fn turn(basis: &DMatrix<f64>, other: &DMatrix<f64>) -> f64 {
    let off = other - basis * basis.tr_mul(other);
    let off = spectrum::singular(off, false, false).map(|svd| svd.singular_values.amax());
    off.map_or(f64::INFINITY, |sine| sine.min(1.0).asin())
}
