//! Programs to Rust. The only place that writes code.

mod body;
mod docs;
mod fallback;
mod functions;
mod item;
mod listing;
mod names;
mod part;
mod spec;
mod tape;
mod unused;

pub(crate) use fallback::fallback;
pub(crate) use part::{ask, part};

use crate::constants::Constant;
use crate::model::Model;
use crate::parse::Declaration;
use proc_macro2::TokenStream;
use quote::quote;
use ukalgebra::analysis::Analysis;
use ukalgebra::expr::System;

/// Everything the declaration becomes.
pub(crate) fn emit(
    decl: &Declaration,
    model: &Model,
    system: &System,
    constants: &[Constant],
    analysis: &Analysis,
) -> TokenStream {
    let listing = listing::listing(system, model, analysis);
    let docs = docs::derived(&listing, analysis, system, model);
    let item = item::item(decl, model, system, &docs);
    let constants = item::associated(decl, constants);
    let spec = spec::spec(decl, model, system, analysis, &listing);
    let parameters = item::parameters(model);
    let functions = functions::functions(system, model, analysis);
    let implementation = implementation(decl, system, &quote! { #spec #parameters #functions });
    let unused = unused::unused(decl, model);
    quote! { #item #constants #implementation #unused }
}

/// `impl Mechanism` with these `members`, where `ukcore` is known by that name, whatever it is called in the user's crate.
fn implementation(decl: &Declaration, system: &System, members: &TokenStream) -> TokenStream {
    let name = &decl.name;
    let start = item::start(decl, system);
    let runtime = decl.runtime.clone().unwrap_or_else(|| quote! { ::ukcore });
    quote! {
        const _: () = {
            use #runtime::emitted as ukcore;
            #[automatically_derived]
            impl ::core::convert::From<#name> for ukcore::Prepared {
                fn from(mechanism: #name) -> Self {
                    ukcore::Mechanism::prepared(&mechanism)
                }
            }
            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl ukcore::Mechanism for #name { #members }
            #start
        };
    }
}

/// Code that is written as text.
fn tokens(text: &str) -> TokenStream {
    // (Of its own accord `proc_macro2` would read all of it once more.)
    let parsed = match proc_macro::is_available() {
        true => text
            .parse()
            .map(|all: proc_macro::TokenStream| all.into())
            .map_err(|error| error.to_string()),
        false => text
            .parse()
            .map_err(|error: proc_macro2::LexError| error.to_string()),
    };
    parsed.unwrap_or_else(|error| {
        let message = format!("defect in `multibody!`: {error} in {text}; please report it");
        quote! { ::core::compile_error!(#message); }
    })
}
