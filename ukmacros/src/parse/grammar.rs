//! Sections.
//! The grammar stands in the documentation of `multibody!`.
//! `expr` is Rust's expression grammar, of which `+ - * /`, calls, method calls, indexing, vectors `[a, b]` and `sum(a..b, |i| …)` have a
//! meaning.

use super::entries::{
    acting, applied, body, coord_entry, entry, equation, joint, let_entry, mass_entry,
    output_entry, param_entry, part, shape, start, term,
};
use super::expr::{Expr, Range};
use super::item::{Block, Const, Declaration, Key, Measure, Merged};
use super::{bars, nesting, units, words};
use crate::diag::{Diagnostics, Loc, located, suggest};
use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use quote::ToTokens as _;
use std::collections::BTreeMap;
use syn::parse::ParseStream;
use syn::{Token, braced, bracketed};

const SECTIONS: &str = "const params coords bodies tree parts gravity let mass kinetic force forces potential dissipation holonomic nonholonomic nonideal output integral start draw";

/// Types that a mechanism's would hide.
const TYPES: &str = "bool char f32 f64 i8 i16 i32 i64 i128 isize str u8 u16 u32 u64 u128 usize";

/// Parses a declaration; `None` if not even its name could be read.
pub(crate) fn parse(mut tokens: TokenStream, diag: &Diagnostics) -> Option<Declaration> {
    if let Some(place) = nesting::too_deep(&tokens) {
        diag.damage(place, "nested too deeply; name parts of it with `let`");
        tokens = nesting::head(tokens);
    }
    let tokens = bars::mend(words::free(tokens, diag), diag);
    let marked = units::mark(&tokens, diag);
    let units = marked.is_some();
    let mut read = None;
    let parser = |input: ParseStream<'_>| {
        read = Some(Declaration {
            units,
            ..declaration(input, diag)?
        });
        Ok(())
    };
    let tokens = marked.unwrap_or(tokens);
    if let Err(e) = syn::parse::Parser::parse2(parser, tokens) {
        // Within a declaration errors are told where they are met; what they left unread is found once more behind it.
        if read.is_none() || diag.is_empty() {
            diag.syntax(&e);
        }
    }
    read
}

fn declaration(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Declaration> {
    let Attributes {
        docs,
        runtime,
        lints,
        part,
    } = attributes(input, diag)?;
    let vis: syn::Visibility = input.parse()?;
    let _: Option<Token![struct]> = input.parse()?;
    let mut name: Ident = input.parse()?;
    if TYPES.split(' ').any(|ty| name == ty) {
        let message =
            format!("`{name}` is a type of Rust, which what is emitted uses; choose another name");
        diag.error(name.span(), message);
        name = Ident::new(&format!("{name}_"), name.span());
    }
    let mut out = Declaration {
        docs,
        runtime,
        lints,
        part,
        units: false,
        vis: vis.to_token_stream(),
        name,
        sections: BTreeMap::new(),
        consts: Vec::new(),
        params: Vec::new(),
        coords: Vec::new(),
        bodies: Vec::new(),
        tree: Vec::new(),
        parts: Vec::new(),
        before_parts: 0,
        merged: Merged::default(),
        gravity: Vec::new(),
        lets: Vec::new(),
        mass: Vec::new(),
        kinetic: Vec::new(),
        force: Vec::new(),
        forces: Vec::new(),
        dissipation: Vec::new(),
        potential: Vec::new(),
        holonomic: Vec::new(),
        nonholonomic: Vec::new(),
        nonideal: Vec::new(),
        outputs: Vec::new(),
        integrals: Vec::new(),
        starts: Vec::new(),
        drawing: Vec::new(),
    };
    let body;
    braced!(body in input);
    while !body.is_empty() {
        // What follows a syntax error inside a declaration cannot be trusted: stop there, keep what was read.
        if let Err(e) = section(&body, &mut out, diag) {
            diag.syntax(&e);
            let _: TokenStream = body.parse()?;
        }
    }
    if !input.is_empty() {
        diag.error(
            input.span(),
            "one declaration per `multibody!`; put this in a macro call of its own",
        );
        let _: TokenStream = input.parse()?;
    }
    Ok(out)
}

fn section(input: ParseStream<'_>, out: &mut Declaration, diag: &Diagnostics) -> syn::Result<()> {
    if let Some(error) = comment(input) {
        return Err(error);
    }
    let docs = docs(input, diag)?;
    if input.peek(Token![const]) {
        out.consts.push(constant(input, docs, diag)?);
        return Ok(());
    }
    if input.peek(Token![let]) {
        let _: Token![let] = input.parse()?;
        if input.peek(syn::token::Brace) {
            blocks(input, &mut out.lets, diag, let_entry)?;
        } else {
            out.lets.push(Block::One(let_entry(input, diag)?));
            let _: Token![;] = input.parse()?;
        }
        return Ok(());
    }
    if input.peek(Token![,]) || input.peek(Token![;]) {
        return Err(input.error("nothing stands between sections; remove this"));
    }
    let keyword: Ident = input
        .parse()
        .map_err(|e| syn::Error::new(e.span(), format!("expected a section: {}", sections())))?;
    let name = keyword.to_string();
    if name == "start" {
        start(input, docs, &mut out.starts, diag)?;
        return Ok(());
    }
    let place = keyword.span();
    if out.sections.contains_key(&name) {
        // Its names may be those of the first one, or others.
        let message = format!("section `{name}` appears twice; put its entries into one");
        diag.damage(place, message);
        skip(input);
        return Ok(());
    }
    out.sections.insert(name.clone(), keyword);
    match name.as_str() {
        "params" => blocks(input, &mut out.params, diag, param_entry),
        "coords" => blocks(input, &mut out.coords, diag, coord_entry),
        "bodies" => blocks(input, &mut out.bodies, diag, body),
        "parts" => {
            out.before_parts = out.lets.len();
            blocks(input, &mut out.parts, diag, part)
        }
        "tree" => blocks(input, &mut out.tree, diag, joint),
        "gravity" => blocks(input, &mut out.gravity, diag, term),
        "mass" => blocks(input, &mut out.mass, diag, mass_entry),
        "kinetic" => blocks(input, &mut out.kinetic, diag, term),
        "potential" => blocks(input, &mut out.potential, diag, term),
        "force" => blocks(input, &mut out.force, diag, entry),
        "forces" => blocks(input, &mut out.forces, diag, acting),
        "dissipation" => blocks(input, &mut out.dissipation, diag, term),
        "nonideal" => blocks(input, &mut out.nonideal, diag, applied),
        "holonomic" => blocks(input, &mut out.holonomic, diag, equation),
        "nonholonomic" => blocks(input, &mut out.nonholonomic, diag, equation),
        "output" => blocks(input, &mut out.outputs, diag, output_entry),
        "integral" => blocks(input, &mut out.integrals, diag, output_entry),
        "draw" => blocks(input, &mut out.drawing, diag, shape),
        _ => {
            let near = match name.starts_with("constrain") {
                true => "; constraints stand under `holonomic`, those with velocities under `nonholonomic`".to_owned(),
                false => {
                    let remedy = format!("sections are {}", sections());
                    suggest(&name, SECTIONS.split(' '), &remedy)
                }
            };
            diag.damage(place, format!("unknown section `{name}`{near}"));
            skip(input);
            Ok(())
        }
    }
}

/// Skips a section: up to its braces or semicolon.
fn skip(input: ParseStream<'_>) {
    while let Ok(token) = input.parse::<TokenTree>() {
        let last = match &token {
            TokenTree::Group(g) => g.delimiter() == Delimiter::Brace,
            TokenTree::Punct(p) => p.as_char() == ';',
            _ => false,
        };
        if last {
            break;
        }
    }
}

fn sections() -> String {
    format!("`{}`", SECTIONS.replace(' ', "`, `"))
}

/// What stands before a declaration, a section or an entry.
#[derive(Default)]
struct Attributes {
    /// The text of doc comments.
    docs: Vec<String>,
    /// The path in `#[ukcore(crate = path)]`.
    runtime: Option<TokenStream>,
    /// `#[allow(…)]`, as written.
    lints: TokenStream,
    /// `#[ukcore(part)]` is among them.
    part: bool,
}

/// Doc comments, and before a declaration the path of the crate `ukcore` and the lints allowed.
fn attributes(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Attributes> {
    let mut found = Attributes::default();
    for attribute in input.call(syn::Attribute::parse_outer)? {
        match &attribute.meta {
            syn::Meta::NameValue(syn::MetaNameValue {
                path,
                value:
                    syn::Expr::Lit(syn::ExprLit {
                        lit: syn::Lit::Str(text),
                        ..
                    }),
                ..
            }) if path.is_ident("doc") => {
                found
                    .docs
                    .extend(text.value().lines().map(|l| l.trim().to_owned()));
            }
            syn::Meta::List(list) if list.path.is_ident("ukcore") => {
                if list.parse_args::<Ident>().is_ok_and(|word| word == "part") {
                    found.part = true;
                    continue;
                }
                let named = |input: ParseStream<'_>| {
                    let _: Token![crate] = input.parse()?;
                    let _: Token![=] = input.parse()?;
                    input.call(syn::Path::parse_mod_style)
                };
                match list.parse_args_with(named) {
                    Ok(path) => found.runtime = Some(path.to_token_stream()),
                    Err(_) => diag.error(
                        located(&attribute.meta),
                        "this attribute is written `#[ukcore(part)]` or `#[ukcore(crate = my::path::to::ukcore)]`",
                    ),
                }
            }
            syn::Meta::List(list) if list.path.is_ident("allow") => {
                attribute.to_tokens(&mut found.lints);
            }
            other => diag.error(located(other), "only doc comments are allowed here"),
        }
    }
    Ok(found)
}

/// The text of doc comments; other attributes are refused.
pub(super) fn docs(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Vec<String>> {
    let place = input.span();
    let found = attributes(input, diag)?;
    let misplaced = [
        (found.part, "#[ukcore(part)]"),
        (found.runtime.is_some(), "#[ukcore(crate = …)]"),
        (!found.lints.is_empty(), "#[allow(…)]"),
    ];
    for (_, attribute) in misplaced.into_iter().filter(|(found, _)| *found) {
        let message = format!("`{attribute}` stands before the whole declaration");
        diag.error(place, message);
    }
    Ok(found.docs)
}

/// The error for a comment as other languages have it, if one comes next.
fn comment(input: ParseStream<'_>) -> Option<syn::Error> {
    let attribute = input.peek2(syn::token::Bracket) || input.peek2(Token![!]);
    let found = input.peek(Token![#]) && !attribute;
    found.then(|| {
        input.error(
            "a comment begins with `//`, and one that documents an entry with `///` before it",
        )
    })
}

fn constant(input: ParseStream<'_>, docs: Vec<String>, diag: &Diagnostics) -> syn::Result<Const> {
    let _: Token![const] = input.parse()?;
    let name: Ident = input.parse()?;
    let _: Token![:] = needed(input, &name, || {
        format!("a constant needs its type: `const {name}: usize = 3;`")
    })?;
    let ty: Ident = input.parse()?;
    if ty != "usize" && ty != "f64" {
        diag.error(
            ty.span(),
            format!("a constant is a `usize` or an `f64`, not `{ty}`"),
        );
    }
    let _: Token![=] = input.parse()?;
    let value = expression(input, diag)?;
    let _: Token![;] = input.parse()?;
    Ok(Const {
        docs,
        name,
        integer: ty != "f64",
        value,
    })
}

/// The `:` behind a name that is given something.
pub(super) fn colon(input: ParseStream<'_>, name: &Ident) -> syn::Result<()> {
    if input.peek(Token![=]) && !input.peek(Token![==]) {
        let message =
            format!("here stands `:`, as in `{name}: 1.0`; `=` is for equations and defaults");
        return Err(input.error(message));
    }
    needed(input, name, || {
        format!("behind `{name}` stands `:`, as in `{name}: 1.0`; a product is written with `*`")
    })
    .map(|_: Token![:]| ())
}

/// The `=` behind a name that is declared as a value.
pub(super) fn equals(input: ParseStream<'_>, name: &Ident) -> syn::Result<()> {
    if input.peek(Token![:]) {
        return Err(input.error(format!("here stands `=`: `{name} = …`")));
    }
    input.parse().map(|_: Token![=]| ())
}

/// What has to stand next; where it does not, `message` is told of `name`.
pub(super) fn needed<T: syn::parse::Parse>(
    input: ParseStream<'_>,
    name: &Ident,
    message: impl FnOnce() -> String,
) -> syn::Result<T> {
    let found = input.parse();
    found.map_err(|_| syn::Error::new(name.span(), message()))
}

pub(super) fn expression(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Expr> {
    let e: syn::Expr = input.parse()?;
    let number = match &e {
        syn::Expr::Unary(negative) => &*negative.expr,
        e => e,
    };
    if let syn::Expr::Lit(number) = number {
        units::bare(number, input)?;
    }
    Ok(Expr::convert(e, diag))
}

pub(super) fn key(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Key> {
    let mut key = declared(input, diag)?;
    if let Some(Measure { loc, size, .. }) = key.measure.take() {
        let size = size.map_or(String::new(), |name| {
            format!("; an index is a constant, `const {name}: usize = 3;`, or a variable of a loop")
        });
        let message = format!(
            "a unit stands behind numbers, as in `l = 0.3 [m]`, and behind names of coordinates, outputs and integrals where these are declared{size}"
        );
        diag.error(loc, message);
    }
    Ok(key)
}

/// A key, with the unit of what it declares.
pub(super) fn declared(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Key> {
    let name: Ident = input.parse()?;
    let mut indices = Vec::new();
    let mut loc: Loc = name.span().into();
    let mut measure = None;
    while input.peek(syn::token::Bracket) {
        if let Some(unit) = units::next(input, loc.end) {
            measure = unit;
            break;
        }
        let inner;
        let bracket = bracketed!(inner in input);
        loc.end = bracket.span.close();
        indices.push(expression(&inner, diag)?);
        if !inner.is_empty() {
            let error = inner.error("each index has its own brackets, such as `x[i][j]`");
            let _: TokenStream = inner.parse()?;
            return Err(error);
        }
    }
    Ok(Key {
        name,
        indices,
        fields: Vec::new(),
        measure,
        loc,
    })
}

/// The name of coordinates: a key, or `link[i].angle` of a body, or `leg[i].knee.angle` of a part's.
pub(super) fn coordinates(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Key> {
    if input.peek(syn::token::Bracket) {
        let message =
            "an entry belongs to one coordinate or family; write one for each: `x: …, y: …`";
        return Err(input.error(message));
    }
    if !input.peek(syn::Ident) {
        return Err(input.error("an entry begins with the coordinate that it belongs to: `x: …`"));
    }
    let mut key = key(input, diag)?;
    while input.peek(Token![.]) {
        let _: Token![.] = input.parse()?;
        let Key {
            name, indices, loc, ..
        } = self::key(input, diag)?;
        key.loc.end = loc.end;
        key.fields.push((name, indices));
    }
    Ok(key)
}

type EntryParser<T> = fn(ParseStream<'_>, &Diagnostics) -> syn::Result<T>;

/// `{ entry entry, for i in a..b { entry } }` appended to `out`, so that entries before a syntax error are kept.
pub(super) fn blocks<T>(
    input: ParseStream<'_>,
    out: &mut Vec<Block<T>>,
    diag: &Diagnostics,
    parse: EntryParser<T>,
) -> syn::Result<()> {
    let body;
    braced!(body in input);
    // Whether what is read next may be the rest of an entry that is told of already.
    let mut told = false;
    while !body.is_empty() {
        let before = diag.len();
        let block = if body.peek(Token![for]) {
            for_block(&body, diag, parse)
        } else if let Some(error) = comment(&body) {
            Err(error)
        } else if body.peek(Token![let]) {
            Err(body.error(
                "`let` stands beside sections, before the first that uses it, not within one",
            ))
        } else {
            parse(&body, diag).map(Block::One)
        };
        match block {
            Ok(block) => out.push(block),
            // The rest of this section cannot be trusted; the next ones can.
            Err(e) => {
                match told {
                    true => diag.doubt(),
                    false => diag.syntax(&e),
                }
                let _: TokenStream = body.parse()?;
            }
        }
        let comma: Option<Token![,]> = body.parse()?;
        let semicolon: Option<Token![;]> = body.parse()?;
        told = diag.len() > before && comma.is_none() && semicolon.is_none();
    }
    Ok(())
}

fn for_block<T>(
    input: ParseStream<'_>,
    diag: &Diagnostics,
    parse: EntryParser<T>,
) -> syn::Result<Block<T>> {
    let _: Token![for] = input.parse()?;
    let var: Ident = input.parse()?;
    let _: Token![in] = input.parse()?;
    let range = syn::Expr::parse_without_eager_brace(input)?;
    let range = Range::convert(range, diag);
    let mut body = Vec::new();
    blocks(input, &mut body, diag, parse)?;
    match range {
        Some(range) => Ok(Block::For { var, range, body }),
        // Reported already; an empty loop keeps the rest going.
        None => Ok(Block::For {
            range: Range {
                from: Box::new(Expr::error(var.span().into())),
                to: Box::new(Expr::error(var.span().into())),
                inclusive: false,
            },
            var,
            body: Vec::new(),
        }),
    }
}
