//! From equations of a mechanism to what is emitted: derivatives, structure, checks.

mod check;
mod constants;
mod cost;
mod dynamics;
mod elimination;
mod plan;
mod presolve;
mod schedule;
mod sparsity;
mod structure;
mod switches;
mod verify;

pub(crate) use check::check;
pub(crate) use constants::{Constant, ConstantValue, Positions, constants};
pub(crate) use cost::{Operations, count};
pub(crate) use dynamics::{Dynamics, derive};
pub(crate) use elimination::{Elimination, Straight, eliminate};
pub(crate) use plan::{Chosen, Plan, plan};
pub(crate) use presolve::{Hoisted, hoist, verify_hoisting};
pub(crate) use schedule::{Program, Sequence, Step, schedule};
pub(crate) use structure::{Structure, structure};
pub(crate) use switches::{Switch, hold};
pub(crate) use verify::verify;
