//! Declarations that are parts of others, as macros that hand their tokens on.

use crate::parse::{Declaration, PartUse, Table};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

/// The macro, called as the type is, that hands the tokens of the declaration and those of its parts on to another, or, where it is no part,
/// that it is none. There may be an error in the tokens, which is told.
pub(crate) fn part(
    decl: &Declaration,
    tokens: &TokenStream,
    table: &Table,
    faulty: bool,
) -> TokenStream {
    let (vis, name, parts) = (&decl.vis, &decl.name, &table.tokens);
    let public = vis.to_string() == "pub";
    let export = (public && decl.part).then(|| quote! { #[macro_export] });
    let vis = match public && !decl.part {
        true => quote! { pub(crate) },
        false => vis.clone(),
    };
    let (handed, parts) = match (decl.part, faulty) {
        (false, _) => (quote! { ? }, TokenStream::new()),
        (true, true) => (quote! { ! #tokens }, parts.clone()),
        (true, false) => (tokens.clone(), parts.clone()),
    };
    // An exported macro stands at the root of its crate, whatever module it is declared in: its name tells the place.
    let own = match decl.part {
        false => format_ident!("__part_{name}"),
        true => {
            let place = format!("{:?} {tokens}", name.span());
            let number = place.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
            });
            format_ident!("__part_{name}_{number:016x}")
        }
    };
    quote! {
        #export
        #[doc(hidden)]
        #[allow(unused_macros, non_local_definitions)]
        macro_rules! #own {
            (($($callback:tt)*) ($($path:tt)*) [$($known:tt)*] $($rest:tt)*) => {
                $($callback)* ! { @parts [$($known)* { $($path)* } { #handed } { #parts }] $($rest)* }
            };
        }
        #[doc(hidden)]
        #[allow(unused_imports)]
        #vis use #own as #name;
    }
}

/// The call that asks for the declaration of a part, for the declaration made of `rest`, of which the parts in the `table` are known.
pub(crate) fn ask(
    decl: &Declaration,
    part: &PartUse,
    table: &Table,
    rest: &TokenStream,
) -> TokenStream {
    let runtime = decl.runtime.clone().unwrap_or_else(|| quote! { ::ukcore });
    let (path, known) = (&part.path, &table.tokens);
    quote! { #path ! { (#runtime::multibody) (#path) [#known] #rest } }
}
