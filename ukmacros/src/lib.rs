//! Compiler from declarations of constrained mechanical systems to the code of their dynamics. Used through `ukcore`.
//!
//! Layers, each using only those before it: `diag` (errors), `parse` (tokens to syntax tree), `model` (names, families, loops),
//! `lower` (to a graph, which `ukalgebra` differentiates and solves), `check` (what is wrong with the equations), `constants`, `emit`
//! (Rust).

mod check;
mod constants;
mod diag;
mod emit;
mod lower;
mod model;
mod parse;

#[cfg(test)]
mod tests;

use proc_macro2::TokenStream;
use ukalgebra::{analysis, expr};

/// Declares a mechanism and emits its dynamics.
///
#[doc = include_str!("../../docs/language.md")]
#[proc_macro]
pub fn multibody(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into()).0.into()
}

/// The pipeline.
fn expand(input: TokenStream) -> (TokenStream, diag::Diagnostics) {
    let diag = diag::Diagnostics::default();
    let (table, source) = parse::split(input);
    let Some(mut decl) = parse::parse(source.clone(), &diag) else {
        return (diag.to_tokens(), diag);
    };
    if let Some(part) = model::missing(&decl, &table, &diag) {
        return (emit::ask(&decl, part, &table, &source), diag);
    }
    let parsed = diag.len();
    model::merge(&mut decl, &table, &diag);
    // Where names are missing because of an error, what follows from that is not reported.
    let quiet = diag::Diagnostics::default();
    let heard = if diag.len() == parsed { &diag } else { &quiet };
    let model = model::resolve(&mut decl, expr::Func::all().map(|f| f.row().name), heard);
    let faulty = decl.merged.faulty;
    let trusted = !faulty && !diag.damaged() && diag.len() == parsed;
    let heard = if trusted { &diag } else { &quiet };
    let mut system = lower::lower(&decl, &model, heard);
    let constants = constants::constants(&model, &system, heard);
    if !faulty {
        lower::units(&decl, &model, &mut system, &diag);
    }
    let handed = |faulty| emit::part(&decl, &source, &table, faulty);
    if !faulty && let Some(analysis) = analysed(&decl, &model, &mut system, &diag) {
        let mut code = emit::emit(&decl, &model, &system, &constants, &analysis);
        code.extend(handed(false));
        return (code, diag);
    }
    diag.within(&model.shown, &decl.merged.places);
    let mut tokens = diag.to_tokens();
    tokens.extend(handed(true));
    tokens.extend(emit::fallback(&decl, &model, &system, &constants));
    (tokens, diag)
}

/// What is known about a mechanism, if there is no error.
fn analysed(
    decl: &parse::Declaration,
    model: &model::Model,
    system: &mut expr::System,
    diag: &diag::Diagnostics,
) -> Option<analysis::Analysis> {
    if !diag.is_empty() {
        return None;
    }
    let n = model.coord_elements.len();
    let dynamics = analysis::derive(system, n);
    check::check(system, &dynamics, model, diag);
    if !diag.is_empty() {
        return None;
    }
    let mut defects = Vec::new();
    let checked = cfg!(debug_assertions);
    if checked {
        let wrong = analysis::verify(system, &dynamics, n).into_iter();
        defects.extend(wrong.map(|what| format!("wrong derivatives of {what}")));
    }
    let analysis = analysis::analyse(system, &model.coordinates(), dynamics, checked);
    if let (Some(reason), Some(place)) = (&analysis.unsolved, system.reaction) {
        let message = format!(
            "reactions cannot be used here, as they are not solved for on a straight line: {reason}; ask the solution of a run for its multipliers"
        );
        diag.error(place, message);
    }
    let changed = analysis.defect.iter();
    defects.extend(changed.map(|k| format!("value {k} changed by hoisting")));
    for defect in defects {
        let message = format!("defect in `multibody!`: {defect}; please report it");
        diag.error(decl.name.span(), message);
    }
    diag.is_empty().then_some(analysis)
}
