//! Names that nothing uses, as items that nothing uses: the compiler warns of them in its own words, at their place.

use crate::model::{Model, Unused, unused as names};
use crate::parse::Declaration;
use proc_macro2::{Ident, TokenStream};
use quote::{quote, quote_spanned};

/// Items with the names of unused parameters, of unused values and functions declared by `let` and of unused options of starts, on which
/// the lint `dead_code` works.
pub(super) fn unused(decl: &Declaration, model: &Model) -> TokenStream {
    let Unused {
        params,
        values,
        functions,
        options,
    } = names(decl, model);
    if [&params, &values, &functions].iter().all(|n| n.is_empty()) && options.is_empty() {
        return TokenStream::new();
    }
    let lints = &decl.lints;
    let mechanism = (!params.is_empty()).then(|| unread(&decl.name, &params));
    let starts = options.iter().map(|(start, options)| {
        let start = unread(start, options);
        // A start may have the name of the mechanism, or of what a `let` declares.
        quote! { const _: () = { #start }; }
    });
    let values = values.iter().map(|value| {
        quote_spanned! { value.span()=> #[allow(non_upper_case_globals)] const #value: () = (); }
    });
    let functions = functions.iter().map(|function| {
        quote_spanned! { function.span()=> #[allow(non_snake_case)] fn #function() {} }
    });
    quote! {
        #lints
        const _: () = {
            #mechanism
            #(#starts)*
            #(#values)*
            #(#functions)*
        };
    }
}

/// A type called `name` with `fields` that nothing reads. The compiler is silent on items of macros: this is the user's by the spans of all
/// its tokens.
fn unread(name: &Ident, fields: &[&Ident]) -> TokenStream {
    let fields = fields
        .iter()
        .map(|field| quote_spanned! { field.span()=> #field: () });
    let fields: Vec<TokenStream> = fields.collect();
    quote_spanned! { name.span()=>
        #[allow(non_snake_case, non_camel_case_types)]
        struct #name { #(#fields),* }
        const _: #name = #name { #(#fields),* };
    }
}
