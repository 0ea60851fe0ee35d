//! Tests of the compiler from inside: a procedural macro's crate exports nothing else.

mod derivatives;
mod errors;
mod golden;
mod random;

use crate::diag::Diagnostic;
use proc_macro2::TokenStream;

/// Expands the text of a declaration; lexical errors are the caller's.
fn expand(source: &str) -> (TokenStream, Vec<Diagnostic>) {
    let tokens: TokenStream = source.parse().expect("test sources are Rust tokens");
    let (code, diagnostics) = crate::expand(tokens);
    (code, diagnostics.take())
}
