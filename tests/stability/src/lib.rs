//! How far stiff and extreme cases go: each sweeps one thing until it breaks, and compares with an oracle.
//!
//! The program `uk-stability` runs them; the cases are a library so that program and tests share one build.

#![forbid(unsafe_code)]

mod cases;
mod mechanisms;

pub use cases::all as cases;
