//! Names that nothing uses, as items that nothing uses: the compiler warns of them in its own words, at their place.

use crate::model::{Model, Unused, unused as names};
use crate::parse::Declaration;
use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};

/// Items with the names of unused parameters and of unused values and functions declared by `let`, on which the lint `dead_code` works.
pub(super) fn unused(decl: &Declaration, model: &Model) -> TokenStream {
    let Unused {
        params,
        values,
        functions,
    } = names(decl, model);
    if params.is_empty() && values.is_empty() && functions.is_empty() {
        return TokenStream::new();
    }
    let (lints, name) = (&decl.lints, &decl.name);
    // The compiler is silent on items of macros: these are the user's by the spans of all their tokens.
    let fields = params
        .iter()
        .map(|param| quote_spanned! { param.span()=> #param: () });
    let fields: Vec<TokenStream> = fields.collect();
    // Fields of the mechanism that nothing reads.
    let mechanism = (!fields.is_empty()).then(|| {
        quote_spanned! { name.span()=>
            #[allow(non_snake_case, non_camel_case_types)]
            struct #name { #(#fields),* }
            const _: #name = #name { #(#fields),* };
        }
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
            #(#values)*
            #(#functions)*
        };
    }
}
