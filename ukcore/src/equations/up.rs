//! The Udwadia-Phohomsiri equation, for singular M.

use nalgebra::{DMatrix, DVector};

use crate::pinv::pseudo_inverse;

/// Eq. 19: q̈ = \[(I − A⁺A) M; A\]⁺ \[Q; b\]. With non-ideal constraints `force` is Q + c.
///
/// `None` unless rank \[M | Aᵀ\] = n, the condition for q̈ to be unique; the stacked matrix has full column rank just then.
#[must_use]
pub fn acceleration(
    mass: &DMatrix<f64>,
    force: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    rhs: &DVector<f64>,
    tolerance: f64,
) -> Option<DVector<f64>> {
    let (m, n) = jacobian.shape();
    let (a_plus, _) = pseudo_inverse(jacobian, tolerance);
    let mut stacked = DMatrix::zeros(n + m, n);
    let projector = DMatrix::identity(n, n) - a_plus * jacobian;
    stacked.rows_mut(0, n).copy_from(&(projector * mass));
    stacked.rows_mut(n, m).copy_from(jacobian);
    let mut right = DVector::zeros(n + m);
    right.rows_mut(0, n).copy_from(force);
    right.rows_mut(n, m).copy_from(rhs);
    let (inverse, rank) = pseudo_inverse(&stacked, tolerance);
    (rank == n).then(|| inverse * right)
}
