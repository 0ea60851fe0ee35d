//! Where a row of A is zero as a whole, next to a motion that leads there.

use nalgebra::{DMatrix, DVector};

use crate::dense::Rows;
use crate::mechanism::Prepared;
use crate::scan::{axpy, largest_by};
use crate::simulate::vanishing::Vanishing;
use crate::spectrum;

/// Steps at most: towards a zero that is none of first order each goes half of the way.
const MOST: usize = 60;

/// Each step leaves so much of the row, some of them more at first; those that leave more in the long run lead to no zero.
const GAIN: f64 = 0.7;
const FIRST: f64 = 10.0;

/// The row is zero there where it is this share of what it is before.
const ZERO: f64 = 1e-6;

/// Differences are taken over this share of the way; what the row changes by less, as a share, it does not depend on.
const DIFFERENCE: f64 = 1e-3;
const RANK: f64 = 1e-9;

/// The place is beside the motion by less than this share of the way, and no farther than so many times it. As much dearer than the time
/// are displacements.
const ASIDE: f64 = 0.2;
const FARTHEST: f64 = 3.0;

/// When a motion is next to such a place, on from the state near it to where it is about at the time `t`; `None` if there is none.
pub(super) fn find(mech: &Prepared, vanishing: &Vanishing, t: f64) -> Option<f64> {
    let Vanishing {
        row, near, scale, ..
    } = vanishing;
    let (n, m) = (near.q.len(), mech.spec().m());
    let speed = largest_by(&near.v, scale);
    let way = speed * (t - near.t).abs();
    if !(way > 0.0 && way.is_finite()) {
        return None;
    }
    // The way along the motion, then displacements beside it, in units of `ASIDE`.
    let place = |z: &DVector<f64>| {
        let mut q = near.q.clone();
        axpy(z[0] / speed, &near.v, &mut q);
        let pairs = q.iter_mut().zip(scale).zip(z.iter().skip(1));
        pairs.for_each(|((q, unit), x)| *q += ASIDE * unit * x);
        (near.t + z[0] / speed, q)
    };
    let entries = |z: &DVector<f64>| {
        let (t, q) = place(z);
        let mut jacobian = vec![0.0; n * m];
        mech.jacobian(t, &q, &near.v, &mut jacobian);
        let rows = Rows::all(&jacobian, m);
        let row = rows.row(*row).zip(scale);
        DVector::from_iterator(n, row.map(|(x, unit)| x * unit))
    };
    let mut z = DVector::zeros(n + 1);
    let before = entries(&z).amax();
    z[0] = speed * (t - near.t);
    let mut most = FIRST * before;
    for _ in 0..MOST {
        let here = entries(&z);
        let left = here.amax();
        if left <= ZERO * before {
            return (before > 0.0).then_some(near.t + z[0] / speed);
        }
        if !left.is_finite() || left > most {
            return None;
        }
        most *= GAIN;
        let mut change = DMatrix::zeros(n, n + 1);
        for k in 0..=n {
            let [mut after, mut back] = [z.clone(), z.clone()];
            after[k] += DIFFERENCE * way;
            back[k] -= DIFFERENCE * way;
            let by = (entries(&after) - entries(&back)) / (2.0 * DIFFERENCE * way);
            change.set_column(k, &by);
        }
        let svd = spectrum::singular(change, true, true)?;
        let least = RANK * svd.singular_values.max();
        z -= svd.solve(&here, least).ok()?;
        let off = z.rows(1, n).amax();
        if !(off <= way && z[0].abs() <= FARTHEST * way) {
            return None;
        }
    }
    None
}
