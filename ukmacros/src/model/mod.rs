//! Syntax tree to names: constants, parameters, coordinates, and what loops run over.

mod elsewhere;
mod in_part;
mod parts;
mod renaming;
mod resolve;
mod scope;
mod sizes;
mod tree;
mod types;
mod unused;

/// The functions whose arguments are constraints.
pub(crate) const LOADS: [&str; 2] = ["reaction", "moment"];

pub(crate) use elsewhere::elsewhere;
pub(crate) use in_part::Reported;
pub(crate) use parts::{merge, missing};
pub(crate) use resolve::resolve;
pub(crate) use scope::{Scope, arguments, arity};
pub(crate) use tree::{Joint, Step};
pub(crate) use types::{BodyKind, Family, Field, Model, Name, Preset, Variable, block, every};
pub(crate) use unused::{Unused, unused, uses};
