//! Tests of the compiler from inside: a procedural macro's crate exports nothing else.

/// A test for each of some declarations: its name, what is wrong marked by `«»`, and what is told of that, as a function checks it.
macro_rules! cases {
    ($check:ident; $($name:ident: $source:literal => $($message:literal),+;)*) => {
        $(#[test] fn $name() { $check($source, &[$($message),+]); })*
    };
}

mod bodies;
mod constants;
mod counts;
mod derivatives;
mod elimination;
mod errors;
mod facts;
mod golden;
mod limits;
mod parts;
mod random;
mod regular;
mod share;
mod speed;
mod tree;
mod units;
mod vectors;
mod verify;
mod words;

use crate::diag::{Diagnostic, Diagnostics};
use crate::model::Model;
use crate::parse::Declaration;
use proc_macro2::TokenStream;
use ukalgebra::analysis::Analysis;
use ukalgebra::expr::System;

/// Expands the text of a declaration; lexical errors are the caller's.
fn expand(source: &str) -> (TokenStream, Vec<Diagnostic>) {
    let tokens: TokenStream = source.parse().expect("test sources are Rust tokens");
    let (code, diagnostics) = crate::expand(tokens);
    (code, diagnostics.take())
}

/// A declaration without errors, its names and its equations.
fn lowered(tokens: TokenStream) -> (Declaration, Model, System) {
    let diag = Diagnostics::default();
    let (table, tokens) = crate::parse::split(tokens);
    let mut declaration = crate::parse::parse(tokens, &diag).expect("a declaration");
    crate::model::merge(&mut declaration, &table, &diag);
    let functions = ukalgebra::expr::Func::all().map(|f| f.row().name);
    let model = crate::model::resolve(&mut declaration, functions, &diag);
    let system = crate::lower::lower(&declaration, &model, &diag);
    assert!(diag.is_empty(), "{:?}", diag.take());
    (declaration, model, system)
}

/// The equations of a declaration without errors.
fn system(source: &str) -> (System, Model) {
    let (_, model, system) = lowered(source.parse().expect("test sources are Rust tokens"));
    (system, model)
}

/// The names of coordinates.
fn coordinates(model: &Model) -> Vec<&str> {
    let names = model.coord_elements.iter();
    names.map(|c| c.name.as_str()).collect()
}

/// What is known about a declaration without errors.
fn analysis(tokens: TokenStream) -> Analysis {
    let (declaration, model, mut system) = lowered(tokens);
    let diag = Diagnostics::default();
    let analysis = crate::analysed(&declaration, &model, &mut system, &diag);
    analysis.unwrap_or_else(|| panic!("{:?}", diag.take()))
}
