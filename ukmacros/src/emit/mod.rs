//! Program to Rust. The only place that writes code.

mod body;
mod docs;
mod fallback;
mod impls;
mod names;
mod print;
mod spec;

pub(crate) use fallback::fallback;
pub(crate) use impls::{Derived, emit};
