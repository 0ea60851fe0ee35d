//! The expression graph: one node per distinct value, exact simplification, derivatives.

mod collected;
mod diff;
mod display;
mod eval;
mod fold;
mod formula;
mod functions;
mod graph;
mod jet;
mod lower;
mod probe;

pub(crate) use diff::{Adjoint, Derivative, Gradient};
pub(crate) use display::Printer;
pub(crate) use eval::{Point, Sweep, eval, eval_shaken};
pub(crate) use fold::{common_power, is_power_of_two};
pub(crate) use formula::{Block, Formula, Letters, Name, families};
pub(crate) use functions::{Cost, Func};
pub(crate) use graph::{Graph, Id, Map, Node, Num, Set, Symbol};
pub(crate) use jet::Jet;
#[cfg(test)]
pub(crate) use lower::vocabulary;
pub(crate) use lower::{
    Constraint, ConstraintRef, Drawing, Kind, NamedUnit, OptionValue, OutputValue, StartValue,
    System, lower, units,
};
pub(crate) use probe::{Probe, Random, Shake};
