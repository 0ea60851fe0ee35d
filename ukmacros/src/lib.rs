//! Compiler from declarations of constrained mechanical systems to the code of their dynamics. Used through `ukcore`.
//!
//! Layers, each using only those before it: `diag` (errors), `parse` (tokens to syntax tree), `model` (names, families, loops),
//! `expr` (hash-consed graph, derivatives), `analysis` (M, Q, A, b; structure; checks; order of computation), `emit` (Rust).

mod analysis;
mod diag;
mod emit;
mod expr;
mod model;
mod parse;

#[cfg(test)]
mod tests;

use proc_macro2::TokenStream;

/// Declares a mechanism; see `ukcore` for the language.
#[proc_macro]
pub fn multibody(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into()).0.into()
}

/// The pipeline.
fn expand(input: TokenStream) -> (TokenStream, diag::Diagnostics) {
    let diag = diag::Diagnostics::default();
    let Some(mut decl) = parse::parse(input, &diag) else {
        return (diag.to_tokens(), diag);
    };
    let model = model::resolve(&mut decl, &diag);
    let mut system = expr::lower(&decl, &model, &diag);
    if diag.is_empty() {
        let dynamics = analysis::derive(&mut system, model.coord_elements.len());
        analysis::check(&system, &dynamics, &model, &diag);
        if diag.is_empty() {
            if cfg!(debug_assertions) {
                for what in analysis::verify(&system, &dynamics, model.coord_elements.len()) {
                    diag.error(decl.name.span(), format!("defect in `multibody!`: wrong derivatives of constraint `{what}`; please report it"));
                }
            }
            let structure = analysis::structure(&mut system, &dynamics);
            let code = emit::emit(&decl, &model, &system, &dynamics, &structure);
            if diag.is_empty() {
                return (code, diag);
            }
        }
    }
    let mut tokens = diag.to_tokens();
    tokens.extend(emit::fallback(&decl, &model, &system));
    (tokens, diag)
}
