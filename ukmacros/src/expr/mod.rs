//! The expression graph: one node per distinct value, exact simplification, derivatives.

mod diff;
mod display;
mod eval;
mod fold;
mod graph;
mod lower;
mod rest;

pub(crate) use diff::Derivative;
pub(crate) use display::Printer;
pub(crate) use eval::{Point, eval, eval_shaken};
pub(crate) use fold::is_power_of_two;
pub(crate) use graph::{Func, Graph, Id, Node, Num, Symbol};
pub(crate) use lower::{ConstraintRef, Kind, System, lower};
