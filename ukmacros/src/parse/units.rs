//! Units, found before anything else is read, since `[kg m^2]` is no expression of Rust.
//!
//! Brackets behind a number hold a unit. Behind a name or a vector they do where they can be no index: indices are made of constants, loop
//! variables and arguments, none of which is called like a unit that is meant. The unit's text takes the place of what is in the brackets.

use super::item::Measure;
use crate::diag::{Diagnostics, suggest};
use proc_macro2::{Delimiter, Group, Literal, Span, TokenStream, TokenTree};
use std::collections::HashSet;
use syn::parse::ParseStream;
use ukunits::{Refusal, Unit};

/// `tokens` with the contents of brackets that hold units as texts; nothing where there are none.
pub(super) fn mark(tokens: &TokenStream, diag: &Diagnostics) -> Option<TokenStream> {
    let mut integers = HashSet::new();
    find_integers(tokens, &mut integers);
    marked(tokens, &integers, diag)
}

/// Names that an index may be made of: behind `const` and `for`, and between bars.
fn find_integers(tokens: &TokenStream, found: &mut HashSet<String>) {
    let (mut declares, mut bars) = (false, false);
    for token in tokens.clone() {
        match &token {
            TokenTree::Ident(name) => {
                if declares || bars {
                    found.insert(name.to_string());
                }
                declares = name == "const" || name == "for";
            }
            TokenTree::Punct(p) => {
                bars ^= p.as_char() == '|';
                declares = false;
            }
            TokenTree::Group(group) => find_integers(&group.stream(), found),
            TokenTree::Literal(_) => {}
        }
    }
}

/// What stands before a token.
#[derive(Clone, Copy, PartialEq)]
enum Before {
    Number,
    Operand,
    Other,
}

/// As [`mark`]. Groups without units stay as they are, since the spans of their delimiters do not survive another group.
fn marked(
    tokens: &TokenStream,
    integers: &HashSet<String>,
    diag: &Diagnostics,
) -> Option<TokenStream> {
    let (mut before, mut changed) = (Before::Other, false);
    let mut each = |token: TokenTree| {
        let stands = std::mem::replace(&mut before, Before::Other);
        match &token {
            TokenTree::Group(group) => {
                before = Before::Operand;
                let holds = group.delimiter() == Delimiter::Bracket
                    && match stands {
                        Before::Number => true,
                        Before::Operand => is_unit(&group.stream(), integers),
                        Before::Other => false,
                    };
                let stream = match holds {
                    true => Some(text(group, diag)),
                    false => marked(&group.stream(), integers, diag),
                };
                let Some(stream) = stream else {
                    return token;
                };
                changed = true;
                let mut new = Group::new(group.delimiter(), stream);
                new.set_span(group.span());
                return new.into();
            }
            TokenTree::Ident(_) => before = Before::Operand,
            TokenTree::Literal(_) => before = Before::Number,
            TokenTree::Punct(_) => {}
        }
        token
    };
    let stream = tokens.clone().into_iter().map(&mut each).collect();
    changed.then_some(stream)
}

/// Whether this is written as a unit, and can be no index.
fn is_unit(tokens: &TokenStream, integers: &HashSet<String>) -> bool {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    if let [TokenTree::Punct(only)] = &tokens[..] {
        return only.as_char() == '-';
    }
    let names = tokens.iter().filter_map(|token| match token {
        TokenTree::Ident(name) => Some(name.to_string()),
        _ => None,
    });
    let names: Vec<String> = names.collect();
    let power = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == '^');
    let allowed = |token: &TokenTree| match token {
        TokenTree::Ident(_) | TokenTree::Literal(_) => true,
        TokenTree::Punct(p) => ['*', '/', '^', '-'].contains(&p.as_char()),
        TokenTree::Group(_) => false,
    };
    let beside = |pair: &[TokenTree]| matches!(pair, [TokenTree::Ident(_), TokenTree::Ident(_)]);
    let no_index = tokens.iter().any(power) || tokens.windows(2).any(beside);
    !names.is_empty()
        && tokens.iter().all(allowed)
        && names.iter().all(|name| !integers.contains(name))
        && (no_index || names.iter().all(|name| ukunits::is_known(name)))
}

/// The unit in these brackets as a text; an empty one where it is in error, which is told.
fn text(group: &Group, diag: &Diagnostics) -> TokenStream {
    let text = group.stream().to_string();
    let told = |span: Span, message: String| {
        diag.error(span, message);
        "".to_owned()
    };
    let inside = |name: &str| {
        let same = |token: &TokenTree| matches!(token, TokenTree::Ident(ident) if ident == name);
        let token = group.stream().into_iter().find(same);
        token.map_or(group.span(), |token| token.span())
    };
    let unit = match Unit::parse(&text) {
        Ok(unit) if unit.factors().any(|name| name == "Hz") => told(
            group.span(),
            "a hertz may be meant as a turn a second or as 1/s; write `rpm`, `rad/s` or `1/s`"
                .to_owned(),
        ),
        Ok(_) => text,
        Err(Refusal::Unknown(name)) => {
            let remedy = "a unit is a product of powers of kg, m, s, rad, deg, N, J and others, such as `[kg m^2]`";
            let end = suggest(&name, ukunits::names(), remedy);
            told(inside(&name), format!("unknown unit `{name}`{end}"))
        }
        Err(refusal) => told(group.span(), refusal.to_string()),
    };
    let mut literal = Literal::string(&unit);
    literal.set_span(group.span());
    TokenTree::Literal(literal).into()
}

/// The unit that comes next, if one does; nothing inside where it is in error.
pub(super) fn next(input: ParseStream<'_>) -> Option<Option<Measure>> {
    let inside = |input: ParseStream<'_>| {
        let inner;
        let bracket = syn::bracketed!(inner in input);
        let text: syn::LitStr = inner.parse()?;
        Ok((text.value(), bracket.span.join()))
    };
    if !input.peek(syn::token::Bracket) || inside(&input.fork()).is_err() {
        return None;
    }
    let (text, span) = inside(input).ok()?;
    let measure = |unit| Measure {
        unit,
        loc: span.into(),
    };
    Some(Unit::parse(&text).ok().map(measure))
}
