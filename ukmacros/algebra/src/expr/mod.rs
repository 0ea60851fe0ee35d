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
mod probe;
mod system;

pub use diff::{Adjoint, Derivative, Gradient};
pub use display::Printer;
pub use eval::{Point, Sweep, eval, eval_shaken};
pub use fold::{common_power, is_power_of_two};
pub use formula::{Block, Formula, Letters, Name, families};
pub use functions::{Cost, Func};
pub use graph::{Graph, Id, Map, Node, Num, Set, Symbol, Uses};
pub use jet::Jet;
pub use probe::{Probe, Random, Shake};
pub use system::{
    Constraint, ConstraintRef, Coordinates, Drawing, GuessKind, GuessValue, Kind, NamedUnit,
    OptionValue, OutputValue, ShapeKind, ShapeValue, StartValue, System, indexed,
};
