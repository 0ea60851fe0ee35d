//! Names that Rust keeps to itself.

use crate::diag::Diagnostics;
use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use std::collections::BTreeSet;

/// Reserved words of Rust that have no meaning in a declaration, and so can only be meant as names.
const RESERVED: &str = "abstract become box do enum extern final macro mod override priv static trait try type typeof unsized virtual where yield";

/// `tokens` with names in the place of reserved words, each of which is reported where it stands first.
pub(super) fn free(tokens: TokenStream, diag: &Diagnostics) -> TokenStream {
    match any(&tokens) {
        true => freed(tokens, &mut BTreeSet::new(), diag),
        false => tokens,
    }
}

/// Whether `name` stands in the place of a reserved word, of which that has been told.
pub(crate) fn is_freed(name: &str) -> bool {
    name.strip_suffix('_').is_some_and(is_reserved)
}

fn any(tokens: &TokenStream) -> bool {
    tokens.clone().into_iter().any(|token| match token {
        TokenTree::Ident(name) => is_reserved(&name),
        TokenTree::Group(group) => any(&group.stream()),
        _ => false,
    })
}

fn is_reserved<N: PartialEq<str> + ?Sized>(name: &N) -> bool {
    RESERVED.split(' ').any(|word| name == word)
}

fn freed(tokens: TokenStream, told: &mut BTreeSet<String>, diag: &Diagnostics) -> TokenStream {
    let mut free = |token| match token {
        TokenTree::Ident(name) if is_reserved(&name) => {
            let other = format!("{name}_");
            if told.insert(name.to_string()) {
                let message = format!(
                    "`{name}` is a reserved word of Rust; use another name, such as `{other}`"
                );
                diag.error(name.span(), message);
            }
            Ident::new(&other, name.span()).into()
        }
        TokenTree::Group(group) => {
            let inside = freed(group.stream(), told, diag);
            let mut out = Group::new(group.delimiter(), inside);
            out.set_span(group.span());
            out.into()
        }
        other => other,
    };
    tokens.into_iter().map(&mut free).collect()
}
