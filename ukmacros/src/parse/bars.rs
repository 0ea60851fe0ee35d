//! Magnitudes as they are written on paper: `|x|` is no expression of Rust, which reads a function without a body.

use crate::diag::{Diagnostics, Loc};
use proc_macro2::{Delimiter, Group, Spacing, TokenStream, TokenTree};

/// `tokens` with `(x)` in the place of `|x|`, each of which is reported.
pub(super) fn mend(tokens: TokenStream, diag: &Diagnostics) -> TokenStream {
    mended(&tokens, diag).unwrap_or(tokens)
}

/// What becomes of `tokens`; nothing where there are no magnitudes.
fn mended(tokens: &TokenStream, diag: &Diagnostics) -> Option<TokenStream> {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    let mut out: Vec<TokenTree> = Vec::new();
    let mut changed = false;
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        let inside = match token {
            TokenTree::Group(group) => mended(&group.stream(), diag),
            _ => None,
        };
        if let (TokenTree::Group(group), Some(inside)) = (token, inside) {
            let mut new = Group::new(group.delimiter(), inside);
            new.set_span(group.span());
            out.push(new.into());
            changed = true;
        } else if let Some(end) = closing(&tokens, at) {
            let between: TokenStream = tokens[at + 1..end].iter().cloned().collect();
            if is_magnitude(&tokens, at, end) {
                let loc = Loc {
                    start: token.span(),
                    end: tokens[end].span(),
                };
                let message = "a magnitude is written `abs(x)`, that of a vector `norm(v)`";
                diag.error(loc, message);
                let between = mended(&between, diag).unwrap_or(between);
                let mut group = Group::new(Delimiter::Parenthesis, between);
                group.set_span(token.span());
                out.push(group.into());
                changed = true;
            } else {
                out.extend(tokens[at..=end].iter().cloned());
            }
            at = end;
        } else {
            out.push(token.clone());
        }
        at += 1;
    }
    changed.then(|| out.into_iter().collect())
}

fn is_sign(token: Option<&TokenTree>, signs: &str) -> bool {
    matches!(token, Some(TokenTree::Punct(p)) if signs.contains(p.as_char()))
}

/// The place of the bar that closes what the one at this place opens.
fn closing(tokens: &[TokenTree], at: usize) -> Option<usize> {
    if !is_sign(tokens.get(at), "|") {
        return None;
    }
    // A function without arguments.
    let joint = matches!(&tokens[at], TokenTree::Punct(p) if p.spacing() == Spacing::Joint);
    if joint && is_sign(tokens.get(at + 1), "|") {
        return Some(at + 1);
    }
    (at + 1..tokens.len()).find(|k| is_sign(tokens.get(*k), "|"))
}

/// Whether what stands between these bars is no list of arguments: those are names, a function stands behind `=` or `,`, and has a body.
fn is_magnitude(tokens: &[TokenTree], at: usize, end: usize) -> bool {
    let inside = &tokens[at + 1..end];
    let called = |pair: &[TokenTree]| matches!(pair, [TokenTree::Ident(_), TokenTree::Group(_)]);
    let formula =
        inside.iter().any(|token| is_sign(Some(token), "+-*/.")) || inside.windows(2).any(called);
    let before = at.checked_sub(1).and_then(|at| tokens.get(at));
    let next = tokens.get(end + 1);
    let no_body = next.is_none() || is_sign(next, ",;=+*/.");
    let operand = is_sign(before, "+-*/") || is_sign(before, ":") && is_sign(next, "-");
    let one = !inside.is_empty() && !inside.iter().any(|token| is_sign(Some(token), ";:"));
    one && (no_body || formula || operand)
}
