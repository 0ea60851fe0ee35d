//! The algebra of the compiler in `ukmacros`: equations of a mechanism as a graph, their derivatives, and what is emitted for them.
//!
//! It knows neither the language nor the emitted text, and is a crate of its own so that it can be optimised where those are not: in a
//! build without optimisation it is most of the time that a macro takes.

#![allow(missing_docs)] // The compiler alone reads it.

pub mod analysis;
pub mod expr;
mod place;

pub use place::Loc;
