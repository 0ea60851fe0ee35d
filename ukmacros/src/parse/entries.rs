//! Entries of sections, each by itself.

use super::expr::{Expr, ExprKind, TWO_SIGNS, location};
use super::grammar::{blocks, colon, coordinates, declared, docs, equals, expression, key, needed};
use super::item::{
    Applied, Body, Coord, Entry, Equation, Function, Guess, Key, Let, LetValue, MassEntry, PartUse,
    Shape, Start, StartOption,
};
use crate::diag::{Diagnostics, located, suggest};
use proc_macro2::{Ident, TokenStream};
use quote::ToTokens as _;
use syn::parse::ParseStream;
use syn::{Token, braced, bracketed, parenthesized};

pub(super) fn param_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Entry> {
    let docs = docs(input, diag)?;
    let key = key(input, diag)?;
    if input.peek(Token![-]) {
        return Err(input.error("names have no `-`; `_` joins words"));
    }
    let _: Token![=] = needed(input, &key.name, || {
        format!("parameter `{0}` needs a default: `{0} = 1.0`", key.name)
    })?;
    let mut value = expression(input, diag)?;
    if let (ExprKind::Vector(row), true) = (&value.kind, key.indices.is_empty()) {
        let (name, count) = (&key.name, row.len());
        let message = format!("a row of {count} parameters is declared `{name}[{count}] = […]`");
        diag.error(value.loc, message);
        value = Expr::error(value.loc);
    }
    Ok(Entry { docs, key, value })
}

pub(super) fn coord_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Coord> {
    let docs = docs(input, diag)?;
    let key = declared(input, diag)?;
    if input.peek(syn::token::Paren) {
        let message = format!("a unit stands in brackets: `{} [m]`", key.name);
        return Err(input.error(message));
    }
    if input.peek(Token![:]) || input.peek(Token![=]) {
        let message =
            "a coordinate is declared by its name alone; `mass`, `params` and starts say the rest";
        return Err(input.error(message));
    }
    Ok(Coord { docs, key })
}

/// `planar link[i] { mass: m, inertia: j, centre: [a, b] }`.
pub(super) fn body(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Body> {
    let docs = docs(input, diag)?;
    let kind: Ident = input.parse()?;
    if kind != "planar" && kind != "spatial" {
        let message = format!(
            "a body is `planar` or `spatial`, not `{kind}`: `planar link {{ mass: m, inertia: j }}`"
        );
        return Err(syn::Error::new(kind.span(), message));
    }
    let key = key(input, diag)?;
    if !input.peek(syn::token::Brace) {
        let message = format!(
            "a body needs what it consists of: `{kind} {} {{ mass: m, inertia: j }}`",
            key.name
        );
        return Err(syn::Error::new(key.name.span(), message));
    }
    let parts;
    braced!(parts in input);
    let mut out = Body {
        docs,
        spatial: kind == "spatial",
        key,
        mass: None,
        inertia: None,
        centre: None,
    };
    while !parts.is_empty() {
        let name: Ident = parts.parse()?;
        colon(&parts, &name)?;
        let value = expression(&parts, diag)?;
        let _: Option<Token![,]> = parts.parse()?;
        let known = ["mass", "inertia", "centre"];
        let place = match name.to_string().as_str() {
            "mass" => &mut out.mass,
            "inertia" => &mut out.inertia,
            "centre" => &mut out.centre,
            text => {
                let end = suggest(text, known, "it has `mass`, `inertia` and `centre`");
                diag.error(name.span(), format!("a body has no `{text}`{end}"));
                continue;
            }
        };
        if place.replace(value).is_some() {
            diag.error(name.span(), format!("`{name}` is given twice; remove one"));
        }
    }
    Ok(out)
}

/// `leg[6]: legs::Leg { phase: 0.1 }`.
pub(super) fn part(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<PartUse> {
    docs(input, diag)?;
    let key = key(input, diag)?;
    let _: Token![:] = needed(input, &key.name, || {
        format!(
            "a part needs the type that it is: `{0}: Leg` or `{0}: Leg {{ mass: m }}`",
            key.name
        )
    })?;
    let path = input.call(syn::Path::parse_mod_style)?;
    let name = path.segments.last().map(|segment| segment.ident.clone());
    let mut out = PartUse {
        name: name.unwrap_or_else(|| key.name.clone()),
        path: path.to_token_stream(),
        key,
        given: Vec::new(),
    };
    if input.peek(syn::token::Brace) {
        let given;
        braced!(given in input);
        while !given.is_empty() {
            let name: Ident = given.parse()?;
            // As in Rust, `{ mass }` is short for `{ mass: mass }`.
            let value = match given.peek(Token![:]) || given.peek(Token![=]) {
                true => {
                    colon(&given, &name)?;
                    expression(&given, diag)?
                }
                false => Expr::name(name.clone()),
            };
            let _: Option<Token![,]> = given.parse()?;
            if out.given.iter().any(|(n, _)| *n == name) {
                diag.error(name.span(), format!("`{name}` is given twice; remove one"));
                continue;
            }
            out.given.push((name, value));
        }
    }
    Ok(out)
}

/// `elbow: hinge(p, q, u)`.
pub(super) fn joint(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Entry> {
    let docs = docs(input, diag)?;
    let key = key(input, diag)?;
    let _: Token![:] = needed(input, &key.name, || {
        format!(
            "a joint needs a name: `name: pin(p, q)` (found `{}` first)",
            key.name
        )
    })?;
    let value = match input.parse()? {
        syn::Expr::Assign(e) => {
            let message = "a joint of the tree says what is free, and has no `=`; equations go under `holonomic`";
            diag.error(e.eq_token.span, message);
            Expr::error(location(&e.left))
        }
        e => Expr::convert(e, diag),
    };
    Ok(Entry { docs, key, value })
}

pub(super) fn let_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Let> {
    let key = key(input, diag)?;
    equals(input, &key.name)?;
    let e: syn::Expr = input.parse()?;
    let value = match e {
        syn::Expr::Closure(closure) => {
            let mut args = Vec::new();
            for pattern in &closure.inputs {
                match pattern {
                    syn::Pat::Ident(p) if p.subpat.is_none() && p.by_ref.is_none() => {
                        args.push(p.ident.clone());
                    }
                    other => diag.damage(
                        located(other),
                        "an argument is a plain name, such as `|v| …`",
                    ),
                }
            }
            LetValue::Function(Function {
                args,
                body: Expr::convert(*closure.body, diag),
            })
        }
        value => LetValue::Value(Expr::convert(value, diag)),
    };
    Ok(Let {
        key,
        given: None,
        value,
    })
}

pub(super) fn mass_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<MassEntry> {
    let (first, other) = if input.peek(syn::token::Paren) {
        let pair;
        parenthesized!(pair in input);
        let first = coordinates(&pair, diag)?;
        let _: Token![,] = pair.parse()?;
        let second = coordinates(&pair, diag)?;
        let _: Option<Token![,]> = pair.parse()?;
        if !pair.is_empty() {
            return Err(pair.error("an entry of M belongs to one or two coordinates"));
        }
        (first, Some(second))
    } else {
        (coordinates(input, diag)?, None)
    };
    if input.peek(syn::token::Paren) {
        let name = &first.name;
        let message = format!("a member of a family is chosen in brackets: `{name}[0]: 1.0`");
        return Err(input.error(message));
    }
    colon(input, &first.name)?;
    let value = expression(input, diag)?;
    Ok(MassEntry {
        key: first,
        other,
        value,
    })
}

pub(super) fn term(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Expr> {
    let e = expression(input, diag)?;
    let goes_on = input.peek(syn::Ident) || input.peek(syn::token::Paren) || input.peek(syn::Lit);
    if goes_on && !input.peek(Token![for]) && e.loc.end.end().line == input.span().start().line {
        diag.join(e.loc, input.span());
    }
    Ok(e)
}

/// `spring(p, q, k, l)`.
pub(super) fn acting(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Expr> {
    let e = expression(input, diag)?;
    if input.peek(Token![:]) {
        let message = "the force on a coordinate goes under `force`; here stands what acts on bodies, such as `spring(p, q, k, l)`";
        return Err(input.error(message));
    }
    Ok(e)
}

/// `x: value`, or `torque(a, b, m)`.
pub(super) fn applied(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Applied> {
    if input.peek(syn::Ident) && input.peek2(syn::token::Paren) {
        return Ok(Applied::By(expression(input, diag)?));
    }
    Ok(Applied::To(entry(input, diag)?))
}

pub(super) fn entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Entry> {
    let key = coordinates(input, diag)?;
    if input.peek(syn::token::Paren) {
        let message = "a generalised force belongs to a coordinate; a force at a point of a body goes under `forces`: `force(link.at([0, 0]), [fx, fy])`, or under `nonideal`";
        return Err(syn::Error::new(key.name.span(), message));
    }
    colon(input, &key.name)?;
    let (docs, value) = (Vec::new(), expression(input, diag)?);
    Ok(Entry { docs, key, value })
}

pub(super) fn equation(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Equation> {
    let key = key(input, diag)?;
    let _: Token![:] = needed(input, &key.name, || {
        format!(
            "a constraint needs a name: `name: lhs = rhs` (found `{}` first)",
            key.name
        )
    })?;
    let e: syn::Expr = input.parse()?;
    let (lhs, rhs) = match e {
        syn::Expr::Assign(assign) => (*assign.left, Some(*assign.right)),
        // A joint, perhaps.
        syn::Expr::Call(_) | syn::Expr::MethodCall(_) => (e, None),
        e => {
            let loc = location(&e);
            let message = match &e {
                syn::Expr::Binary(e) if matches!(e.op, syn::BinOp::Eq(_)) => TWO_SIGNS,
                _ => "a constraint is an equation: `lhs = rhs`",
            };
            diag.error(loc, message);
            return Ok(Equation {
                key,
                lhs: Expr::error(loc),
                rhs: None,
            });
        }
    };
    Ok(Equation {
        key,
        lhs: Expr::convert(lhs, diag),
        rhs: rhs.map(|rhs| Expr::convert(rhs, diag)),
    })
}

pub(super) fn output_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Entry> {
    let docs = docs(input, diag)?;
    let key = declared(input, diag)?;
    equals(input, &key.name)?;
    let value = expression(input, diag)?;
    Ok(Entry { docs, key, value })
}

/// `start name(option = number, …) until number { guesses }`. What is known of it stays where there is an error.
pub(super) fn start(
    input: ParseStream<'_>,
    docs: Vec<String>,
    starts: &mut Vec<Start>,
    diag: &Diagnostics,
) -> syn::Result<()> {
    let name: Ident = input.parse().map_err(|e| {
        let message = "a start needs a name: `start released { x = 1.0 }`";
        syn::Error::new(e.span(), message)
    })?;
    let mut start = Start {
        docs,
        name,
        options: Vec::new(),
        until: None,
        guesses: Vec::new(),
    };
    let read = rest_of(&mut start, input, diag);
    starts.push(start);
    read
}

fn rest_of(start: &mut Start, input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<()> {
    if input.peek(syn::token::Paren) {
        let list;
        parenthesized!(list in input);
        start.options = listed(&list, |list| start_option(list, diag))?;
    }
    if input.peek(syn::Ident) {
        let word: Ident = input.parse()?;
        if word != "until" {
            let message = format!(
                "unexpected `{word}`; behind name and options of a start stands how long a motion from it lasts, `until 2.0`, or `{{`"
            );
            return Err(syn::Error::new(word.span(), message));
        }
        if input.peek(syn::token::Brace) {
            let message = "`until` needs how long a motion lasts: `until 2.0`";
            return Err(syn::Error::new(word.span(), message));
        }
        // In front of a brace, as behind `if` and `for`.
        start.until = Some(Expr::convert(
            input.call(syn::Expr::parse_without_eager_brace)?,
            diag,
        ));
    }
    blocks(input, &mut start.guesses, diag, guess)?;
    if input
        .fork()
        .parse::<Ident>()
        .is_ok_and(|word| word == "until")
    {
        let word: Ident = input.parse()?;
        let message = format!(
            "`until` of a start stands before its braces: `start {} until 2.0 {{ … }}`",
            start.name
        );
        diag.error(word.span(), message);
        input.call(syn::Expr::parse_without_eager_brace)?;
    }
    Ok(())
}

/// All that is left of `input`; commas may be left out where the next entry starts with a name, as in sections.
fn listed<T>(
    input: ParseStream<'_>,
    mut entry: impl FnMut(ParseStream<'_>) -> syn::Result<T>,
) -> syn::Result<Vec<T>> {
    let mut entries = Vec::new();
    while !input.is_empty() {
        entries.push(entry(input)?);
        let _: Option<Token![,]> = input.parse()?;
    }
    Ok(entries)
}

fn start_option(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<StartOption> {
    let docs = docs(input, diag)?;
    let Key { name, indices, .. } = key(input, diag)?;
    if !indices.is_empty() {
        let message = format!("option `{name}` is one number; declare one for each");
        return Err(syn::Error::new(name.span(), message));
    }
    let _: Token![=] = needed(input, &name, || {
        format!("option `{name}` needs a default: `{name} = 1.0`")
    })?;
    let default = expression(input, diag)?;
    Ok(StartOption {
        docs,
        name,
        default,
    })
}

fn guess(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Guess> {
    let rate = input.peek2(syn::token::Paren) && input.fork().parse::<Ident>()? == "dot";
    let (keys, vector) = if rate {
        let _: Ident = input.parse()?;
        let inner;
        parenthesized!(inner in input);
        let found = guessed(&inner, diag)?;
        if !inner.is_empty() {
            let error =
                inner.error("a start gives velocities of coordinates, such as `dot(x) = 1.0`");
            let _: TokenStream = inner.parse()?;
            return Err(error);
        }
        found
    } else {
        guessed(input, diag)?
    };
    if input.peek(Token![==]) {
        return Err(input.error(TWO_SIGNS));
    }
    let held = input.peek(Token![=]);
    if held {
        let _: Token![=] = input.parse()?;
    } else {
        let near: Option<Ident> = input.parse()?;
        if near.is_none_or(|word| word != "near") {
            let name = keys[0].name.to_string();
            let unit = match ukunits::Unit::parse(&name) {
                Ok(_) => format!("; a unit stands in brackets: `2.0 [{name}]`"),
                Err(_) => String::new(),
            };
            let message = format!(
                "a start says where `{name}` is: `{name} = 1.0`, which holds, or `{name} near 1.0`, from where it may move{unit}"
            );
            return Err(syn::Error::new(keys[0].name.span(), message));
        }
    }
    let value: syn::Expr = input.parse()?;
    if let syn::Expr::Assign(e) = &value
        && matches!(*e.left, syn::Expr::Index(_))
    {
        return Err(indexed_by_the_next("=", e.eq_token.span));
    }
    let value = Expr::convert(value, diag);
    Ok(Guess {
        keys,
        vector,
        rate,
        held,
        value,
    })
}

/// The error for `x = 1.0 [y, z] near 2.0`, which is read as `1.0[y, z]`.
fn indexed_by_the_next(word: impl std::fmt::Display, span: proc_macro2::Span) -> syn::Error {
    let message = format!(
        "what stands before `{word}` is read as an index of the entry before it; put `,` between them"
    );
    syn::Error::new(span, message)
}

/// `x`, or `[x, y]`: what a start says something of, and whether it is a vector.
fn guessed(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<(Vec<Key>, bool)> {
    if !input.peek(syn::token::Bracket) {
        let word = input.fork().parse::<Ident>()?;
        if word == "near" {
            return Err(indexed_by_the_next(&word, word.span()));
        }
        return Ok((vec![coordinates(input, diag)?], false));
    }
    let list;
    let bracket = bracketed!(list in input);
    let keys = listed(&list, |list| coordinates(list, diag))?;
    match keys.is_empty() {
        true => Err(syn::Error::new(
            bracket.span.join(),
            "a vector of coordinates, such as `[x, y] near [1.0, 0.0]`, needs one at least",
        )),
        false => Ok((keys, true)),
    }
}

/// `line(p, q)`, or with a text at the end `text(p, "driver")`.
pub(super) fn shape(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Shape> {
    let name: Ident = input.parse()?;
    if !input.peek(syn::token::Paren) {
        let message = format!("a shape is written with its points: `{name}(p, q)`");
        return Err(syn::Error::new(name.span(), message));
    }
    let list;
    parenthesized!(list in input);
    let mut label = None;
    let args = listed(&list, |list| {
        if list.peek(syn::LitStr) {
            label = Some(list.parse::<syn::LitStr>()?.value());
            return Ok(None);
        }
        expression(list, diag).map(Some)
    })?;
    let args = args.into_iter().flatten().collect();
    Ok(Shape { name, args, label })
}
