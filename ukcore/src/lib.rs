//! Dynamics of constrained multibody systems after Udwadia and Kalaba.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod assemble;
pub mod error;
pub mod mechanism;
pub mod pinv;
pub mod scalar;
pub mod solver;
pub mod stabilise;

pub use assemble::{Residuals, State, assemble, residuals};
pub use error::Error;
pub use mechanism::{
    ConstraintKind, ConstraintSpec, Energy, Equations, Mechanism, Operations, OutputSpec,
    ParamSpec, Spec, Structure, Terms,
};
pub use scalar::{Dual, Scalar};
pub use solver::{Baumgarte, Formula, Solution, Solver, SolverOptions, SolverWork};
pub use stabilise::{Correction, Projector, Stabilisation};
pub use ukmacros::multibody;
