//! Sections and entries.
//! The grammar stands in the documentation of `multibody!`.
//! `expr` is Rust's expression grammar, of which `+ - * /`, calls, method calls, indexing, vectors `[a, b]` and `sum(a..b, |i| …)` have a
//! meaning.

use super::expr::{Expr, Range, location};
use super::item::{
    Block, Body, Const, Coord, Declaration, Entry, Equation, Function, Guess, Key, Let, LetValue,
    MassEntry, Output, Param, Section, Shape, Start, StartOption,
};
use super::nesting;
use crate::diag::{Diagnostics, Loc, suggest};
use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use quote::ToTokens as _;
use syn::parse::ParseStream;
use syn::{Token, braced, bracketed, parenthesized};

const SECTIONS: &str = "const params coords bodies gravity let mass kinetic force forces potential dissipation holonomic nonholonomic nonideal output start draw";

/// Parses a declaration; `None` if not even its name could be read.
pub(crate) fn parse(mut tokens: TokenStream, diag: &Diagnostics) -> Option<Declaration> {
    if let Some(place) = nesting::too_deep(&tokens) {
        diag.damage(place, "nested too deeply; name parts of it with `let`");
        tokens = nesting::head(tokens);
    }
    let parser = |input: ParseStream<'_>| declaration(input, diag);
    match syn::parse::Parser::parse2(parser, tokens) {
        Ok(declaration) => Some(declaration),
        Err(e) => {
            diag.syntax(&e);
            None
        }
    }
}

fn declaration(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Declaration> {
    let Attributes {
        docs,
        runtime,
        lints,
    } = attributes(input, diag)?;
    let vis: syn::Visibility = input.parse()?;
    let _: Option<Token![struct]> = input.parse()?;
    let name: Ident = input.parse()?;
    let mut out = Declaration {
        docs,
        runtime,
        lints,
        vis: vis.to_token_stream(),
        name,
        consts: Vec::new(),
        params: Vec::new(),
        coords: Vec::new(),
        bodies: Vec::new(),
        gravity: None,
        lets: Vec::new(),
        mass: None,
        kinetic: None,
        force: Vec::new(),
        forces: Vec::new(),
        dissipation: None,
        potential: None,
        holonomic: Vec::new(),
        nonholonomic: Vec::new(),
        nonideal: None,
        outputs: Vec::new(),
        starts: Vec::new(),
        drawing: None,
    };
    let body;
    braced!(body in input);
    let mut seen: Vec<String> = Vec::new();
    while !body.is_empty() {
        // What follows a syntax error inside a declaration cannot be trusted: stop there, keep what was read.
        if let Err(e) = section(&body, &mut out, &mut seen, diag) {
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

fn section(
    input: ParseStream<'_>,
    out: &mut Declaration,
    seen: &mut Vec<String>,
    diag: &Diagnostics,
) -> syn::Result<()> {
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
    let keyword: Ident = input
        .parse()
        .map_err(|e| syn::Error::new(e.span(), format!("expected a section: {}", sections())))?;
    let name = keyword.to_string();
    if name == "start" {
        out.starts.push(start(input, docs, diag)?);
        return Ok(());
    }
    if seen.contains(&name) {
        diag.error(
            keyword.span(),
            format!("section `{name}` appears twice; put its entries into one"),
        );
    }
    seen.push(name.clone());
    match name.as_str() {
        "params" => blocks(input, &mut out.params, diag, param_entry),
        "coords" => blocks(input, &mut out.coords, diag, coord_entry),
        "bodies" => blocks(input, &mut out.bodies, diag, body),
        "gravity" => present(input, keyword, &mut out.gravity, diag, term),
        "mass" => present(input, keyword, &mut out.mass, diag, mass_entry),
        "kinetic" => present(input, keyword, &mut out.kinetic, diag, term),
        "potential" => present(input, keyword, &mut out.potential, diag, term),
        "force" => blocks(input, &mut out.force, diag, entry),
        "forces" => blocks(input, &mut out.forces, diag, acting),
        "dissipation" => present(input, keyword, &mut out.dissipation, diag, term),
        "nonideal" => present(input, keyword, &mut out.nonideal, diag, entry),
        "holonomic" => blocks(input, &mut out.holonomic, diag, equation),
        "nonholonomic" => blocks(input, &mut out.nonholonomic, diag, equation),
        "output" => blocks(input, &mut out.outputs, diag, output_entry),
        "draw" => present(input, keyword, &mut out.drawing, diag, shape),
        _ => {
            let remedy = format!("sections are {}", sections());
            let near = suggest(&name, SECTIONS.split(' '), &remedy);
            diag.damage(keyword.span(), format!("unknown section `{name}`{near}"));
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
struct Attributes {
    /// The text of doc comments.
    docs: Vec<String>,
    /// The path in `#[ukcore(crate = path)]`.
    runtime: Option<TokenStream>,
    /// `#[allow(…)]`, as written.
    lints: TokenStream,
}

/// Doc comments, and before a declaration the path of the crate `ukcore` and the lints allowed.
fn attributes(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Attributes> {
    let (mut docs, mut runtime, mut lints) = (Vec::new(), None, TokenStream::new());
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
                docs.extend(text.value().lines().map(|l| l.trim().to_owned()));
            }
            syn::Meta::List(list) if list.path.is_ident("ukcore") => {
                let named = |input: ParseStream<'_>| {
                    let _: Token![crate] = input.parse()?;
                    let _: Token![=] = input.parse()?;
                    input.call(syn::Path::parse_mod_style)
                };
                match list.parse_args_with(named) {
                    Ok(path) => runtime = Some(path.to_token_stream()),
                    Err(_) => diag.error(
                        Loc::of(&attribute.meta),
                        "this attribute is written `#[ukcore(crate = my::path::to::ukcore)]`",
                    ),
                }
            }
            syn::Meta::List(list) if list.path.is_ident("allow") => {
                attribute.to_tokens(&mut lints);
            }
            other => diag.error(Loc::of(other), "only doc comments are allowed here"),
        }
    }
    Ok(Attributes {
        docs,
        runtime,
        lints,
    })
}

/// The text of doc comments; other attributes are refused.
fn docs(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Vec<String>> {
    let place = input.span();
    let Attributes {
        docs,
        runtime,
        lints,
    } = attributes(input, diag)?;
    let misplaced = [
        (runtime.is_some(), "#[ukcore(crate = …)]"),
        (!lints.is_empty(), "#[allow(…)]"),
    ];
    for (_, attribute) in misplaced.into_iter().filter(|(found, _)| *found) {
        let message = format!("`{attribute}` stands before the whole declaration");
        diag.error(place, message);
    }
    Ok(docs)
}

fn constant(input: ParseStream<'_>, docs: Vec<String>, diag: &Diagnostics) -> syn::Result<Const> {
    let _: Token![const] = input.parse()?;
    let name: Ident = input.parse()?;
    if !input.peek(Token![:]) {
        let message = format!("a constant needs its type: `const {name}: usize = 3;`");
        return Err(syn::Error::new(name.span(), message));
    }
    let _: Token![:] = input.parse()?;
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

fn expression(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Expr> {
    let e: syn::Expr = input.parse()?;
    Ok(Expr::convert(e, diag))
}

fn key(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Key> {
    let name: Ident = input.parse()?;
    let mut indices = Vec::new();
    let mut loc: Loc = name.span().into();
    while input.peek(syn::token::Bracket) {
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
        field: None,
        loc,
    })
}

/// The name of coordinates: a key, or `link[i].angle` of a body.
fn coordinates(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Key> {
    let mut key = key(input, diag)?;
    if input.peek(Token![.]) {
        let _: Token![.] = input.parse()?;
        let field: Ident = input.parse()?;
        key.loc.end = field.span();
        key.field = Some(field);
    }
    Ok(key)
}

type EntryParser<T> = fn(ParseStream<'_>, &Diagnostics) -> syn::Result<T>;

/// `{ entry entry, for i in a..b { entry } }` appended to `out`, so that entries before a syntax error are kept.
fn blocks<T>(
    input: ParseStream<'_>,
    out: &mut Vec<Block<T>>,
    diag: &Diagnostics,
    parse: EntryParser<T>,
) -> syn::Result<()> {
    let body;
    braced!(body in input);
    while !body.is_empty() {
        let block = if body.peek(Token![for]) {
            for_block(&body, diag, parse)
        } else {
            parse(&body, diag).map(Block::One)
        };
        match block {
            Ok(block) => out.push(block),
            // The rest of this section cannot be trusted; the next ones can.
            Err(e) => {
                diag.syntax(&e);
                let _: TokenStream = body.parse()?;
            }
        }
        let _: Option<Token![,]> = body.parse()?;
        let _: Option<Token![;]> = body.parse()?;
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

fn present<T>(
    input: ParseStream<'_>,
    keyword: Ident,
    out: &mut Option<Section<T>>,
    diag: &Diagnostics,
    parse: EntryParser<T>,
) -> syn::Result<()> {
    let section = out.get_or_insert(Section {
        keyword,
        blocks: Vec::new(),
    });
    blocks(input, &mut section.blocks, diag, parse)
}

fn param_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Param> {
    let docs = docs(input, diag)?;
    let key = key(input, diag)?;
    if !input.peek(Token![=]) {
        return Err(syn::Error::new(
            key.name.span(),
            format!("parameter `{0}` needs a default: `{0} = 1.0`", key.name),
        ));
    }
    let _: Token![=] = input.parse()?;
    let default = expression(input, diag)?;
    Ok(Param { docs, key, default })
}

fn coord_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Coord> {
    let docs = docs(input, diag)?;
    let key = key(input, diag)?;
    Ok(Coord { docs, key })
}

/// `planar link[i] { mass: m, inertia: j, centre: [a, b] }`.
fn body(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Body> {
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
        let _: Token![:] = parts.parse()?;
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

fn let_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Let> {
    let key = key(input, diag)?;
    let _: Token![=] = input.parse()?;
    let e: syn::Expr = input.parse()?;
    let value = match e {
        syn::Expr::Closure(closure) => {
            let mut args = Vec::new();
            for pattern in &closure.inputs {
                match pattern {
                    syn::Pat::Ident(p) if p.subpat.is_none() && p.by_ref.is_none() => {
                        args.push(p.ident.clone());
                    }
                    other => diag.error(
                        Loc::of(other),
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
    Ok(Let { key, value })
}

fn mass_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<MassEntry> {
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
    let _: Token![:] = input.parse()?;
    let value = expression(input, diag)?;
    Ok(MassEntry {
        key: first,
        other,
        value,
    })
}

fn term(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Expr> {
    expression(input, diag)
}

/// `spring(p, q, k, l)`.
fn acting(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Expr> {
    let e = expression(input, diag)?;
    if input.peek(Token![:]) {
        let message = "the force on a coordinate goes under `force`; here stands what acts on bodies, such as `spring(p, q, k, l)`";
        return Err(input.error(message));
    }
    Ok(e)
}

fn entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Entry> {
    let key = coordinates(input, diag)?;
    let _: Token![:] = input.parse()?;
    let value = expression(input, diag)?;
    Ok(Entry { key, value })
}

fn equation(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Equation> {
    let key = key(input, diag)?;
    if !input.peek(Token![:]) {
        return Err(syn::Error::new(
            key.name.span(),
            format!(
                "a constraint needs a name: `name: lhs = rhs` (found `{}` first)",
                key.name
            ),
        ));
    }
    let _: Token![:] = input.parse()?;
    let e: syn::Expr = input.parse()?;
    let (lhs, rhs) = match e {
        syn::Expr::Assign(assign) => (*assign.left, Some(*assign.right)),
        // A joint, perhaps.
        syn::Expr::Call(_) | syn::Expr::MethodCall(_) => (e, None),
        e => {
            let loc = location(&e);
            diag.error(loc, "a constraint is an equation: `lhs = rhs`");
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

fn output_entry(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Output> {
    let docs = docs(input, diag)?;
    let key = key(input, diag)?;
    let _: Token![=] = input.parse()?;
    let value = expression(input, diag)?;
    Ok(Output { docs, key, value })
}

/// `start name(option = number, …) { guesses }`.
fn start(input: ParseStream<'_>, docs: Vec<String>, diag: &Diagnostics) -> syn::Result<Start> {
    let name: Ident = input.parse().map_err(|e| {
        let message = "a start needs a name: `start released { x = 1.0 }`";
        syn::Error::new(e.span(), message)
    })?;
    let mut options = Vec::new();
    if input.peek(syn::token::Paren) {
        let list;
        parenthesized!(list in input);
        while !list.is_empty() {
            options.push(start_option(&list, diag)?);
            if !list.is_empty() {
                let _: Token![,] = list.parse()?;
            }
        }
    }
    let mut guesses = Vec::new();
    blocks(input, &mut guesses, diag, guess)?;
    Ok(Start {
        docs,
        name,
        options,
        guesses,
    })
}

fn start_option(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<StartOption> {
    let docs = docs(input, diag)?;
    let name: Ident = input.parse()?;
    if !input.peek(Token![=]) {
        let message = format!("option `{name}` needs a default: `{name} = 1.0`");
        return Err(syn::Error::new(name.span(), message));
    }
    let _: Token![=] = input.parse()?;
    let default = expression(input, diag)?;
    Ok(StartOption {
        docs,
        name,
        default,
    })
}

fn guess(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Guess> {
    let rate = input.peek2(syn::token::Paren) && input.fork().parse::<Ident>()? == "dot";
    let key = if rate {
        let _: Ident = input.parse()?;
        let inner;
        parenthesized!(inner in input);
        let key = coordinates(&inner, diag)?;
        if !inner.is_empty() {
            let error =
                inner.error("a start gives velocities of coordinates, such as `dot(x) = 1.0`");
            let _: TokenStream = inner.parse()?;
            return Err(error);
        }
        key
    } else {
        coordinates(input, diag)?
    };
    let held = input.peek(Token![=]);
    if held {
        let _: Token![=] = input.parse()?;
    } else {
        let near: Option<Ident> = input.parse()?;
        if near.is_none_or(|word| word != "near") {
            let message = format!(
                "a start says where `{0}` is: `{0} = 1.0`, which holds, or `{0} near 1.0`, from where it may move",
                key.name
            );
            return Err(syn::Error::new(key.name.span(), message));
        }
    }
    let value = expression(input, diag)?;
    Ok(Guess {
        key,
        rate,
        held,
        value,
    })
}

/// `line(p, q)`, or with a text at the end `text(p, "driver")`.
fn shape(input: ParseStream<'_>, diag: &Diagnostics) -> syn::Result<Shape> {
    let name: Ident = input.parse()?;
    if !input.peek(syn::token::Paren) {
        let message = format!("a shape is written with its points: `{name}(p, q)`");
        return Err(syn::Error::new(name.span(), message));
    }
    let list;
    parenthesized!(list in input);
    let (mut args, mut label) = (Vec::new(), None);
    while !list.is_empty() {
        if list.peek(syn::LitStr) {
            label = Some(list.parse::<syn::LitStr>()?.value());
        } else {
            args.push(expression(&list, diag)?);
        }
        if !list.is_empty() {
            let _: Token![,] = list.parse()?;
        }
    }
    Ok(Shape { name, args, label })
}
