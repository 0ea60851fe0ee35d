//! The equations as printed in Zhao, Zhen & Chen 2013, over dense matrices: for reading, teaching, and as the oracle of every
//! faster path. They allocate; [`Solver`](crate::Solver) computes the same without.
//!
//! Symbols: M mass matrix (n × n), Q given force (n), A and b of the constraint equation A q̈ = b (m × n, m), c the non-ideal
//! force (n), a = M⁻¹Q the unconstrained acceleration. `tolerance` is the relative tolerance of
//! the rank-revealing pseudo-inverse. Shapes must agree as in nalgebra, which panics where they do not.
//!
//! - [`uk`]: the Udwadia-Kalaba equation and its parts, for regular M (eqs. 2, 11, 12, 13, 15, 17, 18).
//! - [`up`]: the Udwadia-Phohomsiri equation, for singular M too (eq. 19).
//! - [`kkt`]: the saddle-point system of Lagrange's multipliers, as a third opinion.
//! - [`precise`]: the same system in 31 digits, as a reference.

pub mod kkt;
pub mod precise;
pub mod uk;
pub mod up;
