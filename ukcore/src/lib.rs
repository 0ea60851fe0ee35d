//! Dynamics of constrained multibody systems after Udwadia and Kalaba.
//!
//! A mechanism is declared with [`multibody!`]: coordinates, masses or kinetic energy, forces or potential, and constraints of any
//! kind. The macro differentiates the constraints and emits straight-line code for M, Q, A and b as an implementation of
//! [`Mechanism`]. This crate does the rest:
//!
//! - [`Solver`]: accelerations, constraint forces and multipliers at a state, for regular and singular M, for redundant
//!   constraints, with ideal and non-ideal constraint forces. Without heap allocation once it is made.
//! - [`assemble`](assemble()): a consistent state from a rough guess; [`branches`](branches()): the other ways to put it together.
//!   [`manifold::Projector`]: the nearest consistent state.
//! - [`Simulation`]: adaptive integration with projection, events, dense output and named CSV; `Ensemble` (feature `ensemble`): many
//!   motions at once, in lanes and on all cores.
//! - [`Linearisation`]: exact derivatives of the accelerations. [`equilibrium`](equilibrium()): where a mechanism rests;
//!   [`modes`](modes()): how it vibrates. [`diagnose`](diagnose()): degrees of freedom, what follows from what, singular positions.
//!   [`kinematics`](kinematics()): swept drives, and limits of motion. [`inverse`](inverse()), [`inverse_forces`](inverse_forces()): what
//!   it takes to drive it. [`verify!`]: a test of the emitted code. [`lanes`]: several mechanisms at once, in the lanes of wide numbers.
//! - [`equations`]: the formulas as printed. [`spec`] and [`plan`]: what the compiler knows about a mechanism, and decided. [`model`]: what
//!   a mechanism may say of itself besides.
//!
//! The types that most programs name are here at the root, and the functions; the rest is in the modules, each with what belongs to it:
//! settings of a solver in [`solver`], those of a run in [`simulate`], what a study returns in [`studies`].
//!
//! Notation is that of Zhao, Zhen & Chen 2013 (DOI 10.3901/CJME.2013.05.839), whose equation numbers the documentation cites:
//! n coordinates q, m constraints of which the first h are holonomic, M q̈ = Q + Qc (eqs. 1, 13), A q̈ = b (eq. 5).
//!
//! What goes wrong is an [`Error`] in the modeller's own names: which coordinates nothing determines, which constraints contradict
//! each other, what is not a finite number. Redundant constraints are not an error.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod assemble;
mod branches;
mod dense;
mod diagnosis;
mod displacements;
pub mod equations;
mod equilibrium;
mod error;
mod events;
pub mod explain;
#[cfg(test)]
mod fixture;
mod integrate;
mod interval;
mod inverse;
mod kinematics;
mod kinks;
pub mod lanes;
mod linearise;
mod lu;
pub mod manifold;
mod measure;
pub mod mechanism;
mod metric;
pub mod model;
mod modes;
mod naming;
mod nearby;
mod noise;
pub mod numbers;
mod pinv;
pub mod plan;
mod random;
mod rounding;
mod saddle;
pub mod scalar;
mod scan;
pub mod simulate;
pub mod solver;
pub mod spec;
mod spectrum;
mod start;
mod trajectory;
mod verify;
mod zero;

pub use assemble::{State, assemble};
pub use branches::{assemble_with_alternatives, branches};
pub use diagnosis::{diagnose, diagnose_along, lost_digits, lost_reactions};
pub use equilibrium::equilibrium;
pub use error::Error;
pub use inverse::{inverse, inverse_forces};
pub use kinematics::kinematics;
pub use linearise::Linearisation;
pub use mechanism::{Mechanism, Prepared};
pub use modes::modes;
#[cfg(feature = "ensemble")]
pub use simulate::Ensemble;
pub use simulate::{Event, Method, Simulation, Trajectory};
pub use solver::{Solution, Solver};
pub use ukmacros::multibody;
pub use verify::verify;

/// What the studies of a mechanism, which are functions at the root, return: [`assemble_with_alternatives`], [`diagnose`],
/// [`equilibrium`](equilibrium()), [`modes`](modes()), [`kinematics`](kinematics()), [`inverse`](inverse()) and [`verify`](verify()).
pub mod studies {
    pub use crate::branches::Assembled;
    pub use crate::diagnosis::{Diagnosis, Redundant};
    pub use crate::equilibrium::{Equilibrium, Stability};
    pub use crate::inverse::{Effort, Inverse, Posture};
    pub use crate::kinematics::{Kinematics, Limit};
    pub use crate::modes::Mode;
    pub use crate::verify::{Unverified, Verified};
}

/// What emitted code calls. Not for other use.
#[doc(hidden)]
pub mod emitted {
    pub use crate::assemble::State;
    pub use crate::error::Error;
    pub use crate::mechanism::emitted::*;
    pub use crate::start::StartOptions;
}
