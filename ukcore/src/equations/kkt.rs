//! The saddle-point system of Lagrange's multipliers.

use nalgebra::{DMatrix, DVector};

/// q̈ and λ of \[M Aᵀ; A 0\] \[q̈; −λ\] = \[Q; b\] by LU decomposition. With non-ideal constraints `force` is Q + c.
///
/// `None` where the system is singular: redundant constraints, or rank \[M | Aᵀ\] < n.
#[must_use]
pub fn solve(
    mass: &DMatrix<f64>,
    force: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    rhs: &DVector<f64>,
) -> Option<(DVector<f64>, DVector<f64>)> {
    let (m, n) = jacobian.shape();
    let mut system = DMatrix::zeros(n + m, n + m);
    system.view_mut((0, 0), (n, n)).copy_from(mass);
    system.view_mut((n, 0), (m, n)).copy_from(jacobian);
    system
        .view_mut((0, n), (n, m))
        .copy_from(&jacobian.transpose());
    let mut right = DVector::zeros(n + m);
    right.rows_mut(0, n).copy_from(force);
    right.rows_mut(n, m).copy_from(rhs);
    let solution = system.lu().solve(&right)?;
    Some((
        solution.rows(0, n).into_owned(),
        -solution.rows(n, m).into_owned(),
    ))
}
