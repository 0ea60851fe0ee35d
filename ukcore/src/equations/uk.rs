//! The Udwadia-Kalaba equation, for regular M.

use nalgebra::{DMatrix, DVector};

use crate::pinv::pseudo_inverse;
use crate::spectrum::symmetric;

/// M^½ and M^−½ by the eigenvalues of M; `None` if M is not positive definite.
#[must_use]
pub fn square_roots(mass: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let eigen = symmetric(mass.clone())?;
    if !eigen.eigenvalues.iter().all(|x| *x > 0.0) {
        return None;
    }
    let u = &eigen.eigenvectors;
    let build =
        |f: fn(f64) -> f64| u * DMatrix::from_diagonal(&eigen.eigenvalues.map(f)) * u.transpose();
    Some((build(f64::sqrt), build(|x| x.sqrt().recip())))
}

/// Eq. 2: a = M⁻¹ Q, the acceleration without constraints. `None` if M is singular.
#[must_use]
pub fn unconstrained(mass: &DMatrix<f64>, force: &DVector<f64>) -> Option<DVector<f64>> {
    mass.clone().lu().solve(force)
}

/// Eq. 11: Qc_id = M^½ B⁺ (b − A M⁻¹ Q) with B = A M^−½, the force of ideal constraints. `None` if M is not positive definite.
#[must_use]
pub fn ideal_force(
    mass: &DMatrix<f64>,
    force: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    rhs: &DVector<f64>,
    tolerance: f64,
) -> Option<DVector<f64>> {
    let (root, inverse_root) = square_roots(mass)?;
    let (b_plus, _) = pseudo_inverse(&(jacobian * inverse_root), tolerance);
    let a = unconstrained(mass, force)?;
    Some(root * b_plus * (rhs - jacobian * a))
}

/// Eq. 12: Qc_nid = M^½ (I − B⁺B) M^−½ c, the non-ideal part of the constraint force. `None` if M is not positive definite.
#[must_use]
pub fn nonideal_force(
    mass: &DMatrix<f64>,
    nonideal: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    tolerance: f64,
) -> Option<DVector<f64>> {
    let (root, inverse_root) = square_roots(mass)?;
    let b = jacobian * &inverse_root;
    let (b_plus, _) = pseudo_inverse(&b, tolerance);
    let identity = DMatrix::identity(mass.nrows(), mass.nrows());
    Some(root * (identity - b_plus * b) * inverse_root * nonideal)
}

/// Eq. 13: q̈ from M q̈ = Q + Qc_id + Qc_nid. `None` if M is not positive definite.
#[must_use]
pub fn acceleration_nonideal(
    mass: &DMatrix<f64>,
    force: &DVector<f64>,
    nonideal: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    rhs: &DVector<f64>,
    tolerance: f64,
) -> Option<DVector<f64>> {
    let ideal = ideal_force(mass, force, jacobian, rhs, tolerance)?;
    let nonideal = nonideal_force(mass, nonideal, jacobian, tolerance)?;
    unconstrained(mass, &(force + ideal + nonideal))
}

/// Eq. 15, the Udwadia-Kalaba equation: q̈ from M q̈ = Q + M^½ B⁺ (b − A M⁻¹ Q). `None` if M is not positive definite.
#[must_use]
pub fn acceleration(
    mass: &DMatrix<f64>,
    force: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    rhs: &DVector<f64>,
    tolerance: f64,
) -> Option<DVector<f64>> {
    let ideal = ideal_force(mass, force, jacobian, rhs, tolerance)?;
    unconstrained(mass, &(force + ideal))
}

/// Eq. 17: Fc = m A⁺ (b − A M⁻¹ Q), the constraint force where M = m I.
#[must_use]
pub fn equal_masses(
    m: f64,
    force: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    rhs: &DVector<f64>,
    tolerance: f64,
) -> DVector<f64> {
    let (a_plus, _) = pseudo_inverse(jacobian, tolerance);
    m * a_plus * (rhs - jacobian * force / m)
}

/// Eq. 18: Fc = m A⁺ b, the constraint force where M = m I and Q = 0.
#[must_use]
pub fn equal_masses_free(
    m: f64,
    jacobian: &DMatrix<f64>,
    rhs: &DVector<f64>,
    tolerance: f64,
) -> DVector<f64> {
    let (a_plus, _) = pseudo_inverse(jacobian, tolerance);
    m * a_plus * rhs
}
