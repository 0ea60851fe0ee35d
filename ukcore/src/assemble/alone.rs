//! Whether rows have one solution at most in a box.

use nalgebra::{DMatrix, DVector};

use crate::interval::Interval;
use crate::manifold::{At, Part};
use crate::mechanism::{Equations, Evaluated, Prepared};
use crate::scan::or_one;

/// Boxes are no larger, so that sums over them are finite.
const LARGEST: f64 = 1e100;

/// Shares of a length w with w − P w = 1 are at most so large: beyond, rounding may have made P as small as it is.
const MOST: f64 = 1e4;

/// A mechanism whose coordinates vary.
pub(super) struct Alone {
    mechanism: Prepared<Interval, dyn Equations<Interval>>,
    residual: Vec<Interval>,
    terms: Evaluated<Interval>,
}

impl Alone {
    pub(super) fn new(mechanism: &Prepared) -> Self {
        let (n, m) = (mechanism.spec().n(), mechanism.spec().m());
        Alone {
            mechanism: mechanism.varied(),
            residual: vec![Interval::exact(0.0); mechanism.spec().holonomic],
            terms: Evaluated::new(n, m),
        }
    }

    /// Whether the rows of `part` are seen to have one solution at most where each of its unknowns j differs from `middle` by at most
    /// `reach` · `ease[j]`, and all other coordinates are those of `x`. They may have no other one where this is not seen.
    ///
    /// Let J hold ∂φ/∂x over the box, and C be a left inverse of its middle. Of two solutions x and y, by the mean value theorem row by
    /// row, 0 = J (x − y) for some J in it, so |x − y| ≤ P |x − y| with P ≥ |1 − C J|, elementwise: if w − P w > 0 for some w > 0, then
    /// x = y. (Neumaier 1990, Interval methods for systems of equations, §§4.1, 5.1; where J is Lipschitz this is the theorem of Newton
    /// and Kantorovich.)
    pub(super) fn holds(
        &mut self,
        at: &At<'_, f64>,
        part: &Part,
        (x, middle): (&[f64], &[f64]),
        (reach, ease): (f64, &dyn Fn(usize) -> f64),
    ) -> bool {
        if !part.is_determined() {
            return false;
        }
        let mut q: Vec<Interval> = x.iter().map(|x| Interval::exact(*x)).collect();
        for j in &part.unknowns {
            q[*j] = Interval::around(middle[*j], (reach * ease(*j)).min(LARGEST));
        }
        let v: Vec<Interval> = at.other.iter().map(|v| Interval::exact(*v)).collect();
        let t = Interval::exact(at.t);
        self.mechanism.residual(t, &q, &mut self.residual);
        // A function that jumps has no mean value.
        if part.rows().any(|c| !self.residual[c].radius().is_finite()) {
            return false;
        }
        self.terms.dynamics(&self.mechanism, t, &q, &v);
        let m = self.mechanism.spec().m();
        let matrix = |of: fn(Interval) -> f64| {
            DMatrix::from_fn(part.rows.len(), part.unknowns.len(), |c, j| {
                let j = part.unknowns[j];
                of(self.terms.jacobian[j * m + part.rows[c]]) * ease(j)
            })
        };
        let (mut middles, mut radii) = (matrix(Interval::middle), matrix(Interval::radius));
        for (mut row, mut radii) in middles.row_iter_mut().zip(radii.row_iter_mut()) {
            let norm = or_one(row.norm());
            row /= norm;
            radii /= norm;
        }
        let Some(normal) = middles.tr_mul(&middles).cholesky() else {
            return false;
        };
        let inverse = normal.solve(&middles.transpose());
        let one = DMatrix::identity(part.unknowns.len(), part.unknowns.len());
        let share = (&one - &inverse * middles).abs() + inverse.abs() * radii;
        if !share.iter().all(|x| x.is_finite()) {
            return false;
        }
        let ones = DVector::from_element(part.unknowns.len(), 1.0);
        let Some(w) = (one - &share).lu().solve(&ones) else {
            return false;
        };
        let left = &w - share * &w;
        w.iter()
            .zip(&left)
            .all(|(w, left)| (0.0..MOST).contains(w) && *left > 0.5)
    }
}
