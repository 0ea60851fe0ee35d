//! Dynamics of constrained multibody systems after Udwadia and Kalaba.
//!
//! A mechanism is declared with [`multibody!`]: coordinates, masses or kinetic energy, forces or potential, and constraints of any
//! kind. The macro differentiates the constraints and emits straight-line code for M, Q, A and b as an implementation of
//! [`Mechanism`]. This crate does the rest:
//!
//! - [`Solver`]: accelerations, constraint forces and multipliers at a state, for regular and singular M, for redundant
//!   constraints, with ideal and non-ideal constraint forces. Without heap allocation once it is made.
//! - [`assemble`](assemble()): a consistent state from a rough guess. [`Projector`]: the nearest consistent state.
//! - `Simulation` (feature `simulate`, on by default): adaptive integration with projection, events, dense output and named CSV.
//! - [`LaneSolver`]: accelerations of several mechanisms at once, in lanes. [`Linearisation`]: exact derivatives of the accelerations.
//! - [`equations`]: the formulas as printed, [`pinv`]: the pseudo-inverse under them, [`diagnose`]: rank and redundancy by name.
//!
//! Notation is that of Zhao, Zhen & Chen 2013 (DOI 10.3901/CJME.2013.05.839), whose equation numbers the documentation cites:
//! n coordinates q, m constraints of which the first h are holonomic, M q̈ = Q + Qc (eqs. 1, 13), A q̈ = b (eq. 5).
//!
//! What goes wrong is an [`Error`] in the modeller's own names: which coordinates nothing determines, which constraints contradict
//! each other, what is not a finite number. Redundant constraints are not an error.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod assemble;
pub mod code;
pub mod diagnose;
pub mod double;
pub mod equations;
pub mod error;
#[cfg(feature = "simulate")]
pub mod events;
#[cfg(test)]
mod fixture;
#[cfg(feature = "simulate")]
pub mod integrate;
pub mod lanes;
pub mod linearise;
mod lu;
pub mod mechanism;
mod metric;
pub mod model;
pub mod pinv;
pub mod plan;
mod rounding;
mod saddle;
pub mod scalar;
mod scan;
#[cfg(feature = "simulate")]
pub mod simulate;
pub mod solver;
mod spec;
pub mod stabilise;
#[cfg(feature = "simulate")]
pub mod trajectory;
mod workspace;
#[cfg(feature = "simulate")]
mod zero;

pub use assemble::{Residuals, State, assemble, residuals};
pub use double::DoubleDouble;
pub use error::Error;
pub use lanes::{LaneSolver, Lanes};
pub use linearise::Linearisation;
#[doc(hidden)]
pub use mechanism::emitted;
pub use mechanism::{
    Branch, Check, ConstraintKind, ConstraintSpec, Costs, Energy, Equations, Mechanism, Operations,
    OutputSpec, ParamSpec, Pivot, Prepared, Solve, Spec, Structure, SwitchSpec, Terms,
};
pub use plan::Plan;
pub use scalar::{Dual, Scalar};
pub use solver::{Baumgarte, Formula, Solution, Solver, SolverOptions, SolverWork};
pub use stabilise::{Correction, Projector, Stabilisation};
pub use ukmacros::multibody;

#[cfg(feature = "simulate")]
pub use events::{Direction, Event, EventHit};
#[cfg(feature = "simulate")]
pub use integrate::Method;
#[cfg(feature = "ensemble")]
pub use simulate::ensemble::{Ensemble, Member};
#[cfg(feature = "simulate")]
pub use simulate::{Failure, Simulation, Switching};
#[cfg(feature = "simulate")]
pub use trajectory::{CsvWriter, Drift, Ending, Record, Residual, Sample, Trajectory, Work};
