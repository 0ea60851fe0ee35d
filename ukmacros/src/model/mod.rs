//! Syntax tree to names: constants, parameters, coordinates, and what loops run over.

mod resolve;
mod types;

pub(crate) use resolve::{Scope, resolve};
pub(crate) use types::{Family, Model, Name};
