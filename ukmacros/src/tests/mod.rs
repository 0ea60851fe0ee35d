//! Tests of the compiler from inside: a procedural macro's crate exports nothing else.

mod constants;
mod derivatives;
mod elimination;
mod errors;
mod facts;
mod golden;
mod limits;
mod random;
mod speed;
mod verify;

use crate::diag::{Diagnostic, Diagnostics};
use crate::expr::System;
use crate::model::Model;
use proc_macro2::TokenStream;

/// Expands the text of a declaration; lexical errors are the caller's.
fn expand(source: &str) -> (TokenStream, Vec<Diagnostic>) {
    let tokens: TokenStream = source.parse().expect("test sources are Rust tokens");
    let (code, diagnostics) = crate::expand(tokens);
    (code, diagnostics.take())
}

/// The equations of a declaration without errors.
fn system(source: &str) -> (System, Model) {
    let tokens: TokenStream = source.parse().expect("test sources are Rust tokens");
    let diag = Diagnostics::default();
    let mut declaration = crate::parse::parse(tokens, &diag).expect("a declaration");
    let model = crate::model::resolve(&mut declaration, &diag);
    let system = crate::expr::lower(&declaration, &model, &diag);
    assert!(diag.is_empty(), "{:?}", diag.take());
    (system, model)
}
