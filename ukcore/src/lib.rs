//! Dynamics of constrained multibody systems after Udwadia and Kalaba.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod assemble;
pub mod diagnose;
pub mod equations;
pub mod error;
#[cfg(feature = "simulate")]
pub mod events;
#[cfg(feature = "simulate")]
pub mod integrate;
#[cfg(test)]
mod fixture;
pub mod mechanism;
mod metric;
pub mod pinv;
mod saddle;
pub mod scalar;
#[cfg(feature = "simulate")]
pub mod simulate;
pub mod solver;
pub mod stabilise;
mod workspace;
#[cfg(feature = "simulate")]
pub mod trajectory;

pub use assemble::{Residuals, State, assemble, residuals};
pub use error::Error;
#[doc(hidden)]
pub use mechanism::emitted;
pub use mechanism::{
    ConstraintKind, ConstraintSpec, Energy, Equations, Mechanism, Operations, OutputSpec,
    ParamSpec, Spec, Structure, Terms,
};
pub use scalar::{Dual, Scalar};
pub use solver::{Baumgarte, Formula, Solution, Solver, SolverOptions, SolverWork};
pub use stabilise::{Correction, Projector, Stabilisation};
pub use ukmacros::multibody;

#[cfg(feature = "simulate")]
pub use events::{Direction, Event, EventHit};
#[cfg(feature = "simulate")]
pub use integrate::Method;
#[cfg(feature = "simulate")]
pub use simulate::{Failure, Simulation};
#[cfg(feature = "simulate")]
pub use trajectory::{Ending, Residual, Sample, Trajectory, Work};
