//! Statements of one emitted function.

use super::names::Namer;
use crate::analysis::{Operations, Program, Sequence, Step, count, schedule};
use crate::expr::{Graph, Id, Node, Symbol, System};
use crate::model::Model;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// A value to compute, where it goes, and what for (names its helpers).
pub(super) struct Root {
    pub(super) id: Id,
    pub(super) place: TokenStream,
    pub(super) purpose: String,
}

/// A function's statements and their cost.
pub(super) struct Body {
    pub(super) tokens: TokenStream,
    pub(super) operations: Operations,
}

/// Writes straight-line code for `roots`, with the coordinates, velocities and parameters that it reads.
pub(super) fn body(
    system: &System,
    model: &Model,
    prepared: &[Id],
    roots: &[Root],
    sequence: Sequence<'_>,
) -> Body {
    let g = &system.graph;
    let ids: Vec<Id> = roots.iter().map(|r| r.id).collect();
    let program = schedule(g, &ids, &system.hints, sequence);
    let mut writer = Writer {
        graph: g,
        namer: Namer::new(g, model, system.constraints.len(), &system.hints, prepared),
    };
    let inputs = writer.inputs(model, system.constraints.len(), prepared.len(), &program);
    let mut statements = TokenStream::new();
    // Helpers are named for the value whose computation needs them first: the next one stored.
    let mut next = 0;
    for step in &program.steps {
        match *step {
            Step::Let(id) => {
                let value = writer.definition(id);
                // The value itself, if it is stored in several places; else a part of it.
                let purpose = &roots[next].purpose;
                let purpose = match roots[next].id == id {
                    true => purpose.clone(),
                    false => format!("{purpose}_part"),
                };
                let name = writer.namer.declare(id, &purpose);
                statements.extend(quote! { let #name = #value; });
            }
            Step::Reciprocal(id) => {
                let receiver = writer.receiver(id);
                let name = writer.namer.declare_reciprocal(id, &roots[next].purpose);
                statements.extend(quote! { let #name = #receiver.recip(); });
            }
            Step::SinCos { sin, cos } => {
                let argument = g.operands(sin)[0];
                let argument = writer.receiver(argument);
                let sin = writer.namer.declare(sin, &roots[next].purpose);
                let cos = writer.namer.declare(cos, &roots[next].purpose);
                statements.extend(quote! { let (#sin, #cos) = #argument.sin_cos(); });
            }
            Step::Store(k) => {
                let place = &roots[k].place;
                let value = writer.expression(roots[k].id);
                statements.extend(quote! { #place = #value; });
                next = (k + 1).min(roots.len() - 1);
            }
        }
    }
    Body {
        tokens: quote! { #inputs #statements },
        operations: count(g, &program.needed, &program.reciprocals),
    }
}

/// How tightly an emitted expression binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Call,
}

struct Writer<'a> {
    graph: &'a Graph,
    namer: Namer<'a>,
}

impl Writer<'_> {
    /// `lit`, and the inputs that the program reads.
    fn inputs(
        &self,
        model: &Model,
        constraints: usize,
        prepared: usize,
        program: &Program,
    ) -> TokenStream {
        let used = |symbol: Symbol| {
            let node = program.needed.iter();
            let mut nodes = node.map(|id| self.graph.node(*id));
            nodes.any(|n| *n == Node::Symbol(symbol))
        };
        let mut out = TokenStream::new();
        let n = model.coord_elements.len();
        let params = model.param_elements.len();
        for (text, n, symbol) in [
            ("given", params, Symbol::Param as fn(usize) -> Symbol),
            ("prepared", prepared, Symbol::Prepared),
            ("q", n, Symbol::Coord),
            ("v", n, Symbol::Velocity),
            ("residual", constraints, Symbol::Residual),
        ] {
            let slice = format_ident!("{text}");
            let names: Vec<Option<Ident>> = (0..n)
                .map(|i| used(symbol(i)).then(|| self.namer.symbol(symbol(i))))
                .collect();
            if names.iter().any(Option::is_some) {
                let patterns = names.iter().map(|name| match name {
                    Some(name) => quote! { #name },
                    None => quote! { _ },
                });
                let n = Literal::usize_unsuffixed(n);
                out.extend(quote! {
                    let [#(#patterns),*] = *::ukcore::emitted::exact::<S, #n>(#slice, #text);
                });
            }
        }
        if program.needed.iter().any(|id| self.has_literal(*id)) {
            out.extend(quote! { let lit = S::from_f64; });
        }
        out
    }

    /// Whether the code of node `id` writes a number with `lit`.
    fn has_literal(&self, id: Id) -> bool {
        match self.graph.node(id) {
            Node::Const(_) => true,
            Node::Scale(c, _) => c.get() != -1.0,
            Node::Sum(c, terms) => {
                c.get() != 0.0 || terms.iter().any(|(k, _)| k.get().abs() != 1.0)
            }
            _ => false,
        }
    }

    /// The variable of `id`, or its expression.
    fn expression(&self, id: Id) -> TokenStream {
        self.write(id).0
    }

    fn write(&self, id: Id) -> (TokenStream, Binding) {
        match self.namer.variable(id) {
            Some(name) => (quote! { #name }, Binding::Call),
            None => self.node(id),
        }
    }

    fn definition(&self, id: Id) -> TokenStream {
        self.node(id).0
    }

    fn wrapped(&self, id: Id, least: Binding) -> TokenStream {
        wrap(self.write(id), least)
    }

    /// As the receiver of a method.
    fn receiver(&self, id: Id) -> TokenStream {
        self.wrapped(id, Binding::Call)
    }

    fn node(&self, id: Id) -> (TokenStream, Binding) {
        match self.graph.node(id) {
            Node::Const(x) => (constant(x.get()), Binding::Call),
            Node::Symbol(s) => {
                let name = self.namer.symbol(*s);
                (quote! { #name }, Binding::Call)
            }
            Node::Sum(c, terms) => {
                let terms: Vec<(f64, Id)> = terms.iter().map(|(k, t)| (k.get(), *t)).collect();
                (self.sum(c.get(), &terms), Binding::Sum)
            }
            Node::Scale(c, inner) => self.scale(c.get(), *inner),
            Node::Product(factors) => self.product(factors),
            Node::Held(inner) => self.write(*inner),
            Node::Call(func, args) => {
                let receiver = self.receiver(args[0]);
                let name = format_ident!("{}", func.name());
                let rest = args[1..].iter().map(|a| self.expression(*a));
                (quote! { #receiver.#name(#(#rest),*) }, Binding::Call)
            }
            Node::Select {
                a,
                b,
                then,
                otherwise,
            } => {
                let args = [a, b, then, otherwise].map(|id| self.expression(*id));
                (quote! { S::select_le(#(#args),*) }, Binding::Call)
            }
        }
    }

    /// What is known first is added first, behind a positive term, so that a difference needs no negation.
    fn sum(&self, c: f64, terms: &[(f64, Id)]) -> TokenStream {
        let mut terms = terms.to_vec();
        terms.sort_by_key(|(_, term)| self.graph.latency(*term));
        let first = terms.iter().position(|(k, _)| *k > 0.0);
        if let Some(first) = first {
            terms[..=first].rotate_right(1);
        }
        let mut out = TokenStream::new();
        let leading = c != 0.0 && (c > 0.0 || first.is_none());
        if leading {
            out = constant(c);
        }
        for (k, term) in &terms {
            let factor = |least| self.wrapped(*term, least);
            let magnitude = |k: f64| {
                if k == 1.0 {
                    return factor(Binding::Product);
                }
                let (value, factor) = (constant(k), factor(Binding::Sign));
                quote! { #value * #factor }
            };
            out = match (out.is_empty(), *k) {
                (true, -1.0) => {
                    let factor = factor(Binding::Call);
                    quote! { -#factor }
                }
                (true, k) => magnitude(k),
                (false, k) if k < 0.0 => {
                    let term = magnitude(-k);
                    quote! { #out - #term }
                }
                (false, k) => {
                    let term = magnitude(k);
                    quote! { #out + #term }
                }
            };
        }
        if c != 0.0 && !leading {
            let value = constant(c.abs());
            out = if c > 0.0 {
                quote! { #out + #value }
            } else {
                quote! { #out - #value }
            };
        }
        out
    }

    fn scale(&self, c: f64, inner: Id) -> (TokenStream, Binding) {
        // −(a − b) is b − a.
        if c == -1.0
            && self.namer.variable(inner).is_none()
            && let Node::Sum(constant, terms) = self.graph.node(inner)
        {
            let flipped: Vec<(f64, Id)> = terms.iter().map(|(k, t)| (-k.get(), *t)).collect();
            return (self.sum(-constant.get(), &flipped), Binding::Sum);
        }
        if c == -1.0 {
            let factor = self.wrapped(inner, Binding::Call);
            return (quote! { -#factor }, Binding::Sign);
        }
        let (value, factor) = (constant(c), self.wrapped(inner, Binding::Sign));
        (quote! { #value * #factor }, Binding::Product)
    }

    fn product(&self, factors: &[(Id, i32)]) -> (TokenStream, Binding) {
        // What is known first is multiplied first.
        let mut factors = factors.to_vec();
        factors.sort_by_key(|(base, e)| self.graph.latency(*base) + if *e < 0 { 14 } else { 0 });
        let factors = factors.as_slice();
        let by_variable =
            |(base, e): &(Id, i32)| *e == -1 && self.namer.reciprocal(*base).is_some();
        let above = self.powers(factors.iter().filter(|f| f.1 > 0 || by_variable(f)));
        let below = self.powers(factors.iter().filter(|f| f.1 < 0 && !by_variable(f)));
        let (top, bottom) = (join(&above), join(&below));
        match (above.is_empty(), below.is_empty()) {
            (_, true) => (top, Binding::Product),
            (true, false) if matches!(factors, [(_, -1)]) => {
                let base = self.receiver(factors[0].0);
                (quote! { #base.recip() }, Binding::Call)
            }
            (true, false) => (quote! { (#bottom).recip() }, Binding::Call),
            (false, false) if below.len() == 1 && factors.iter().all(|(_, e)| *e >= -1) => {
                (quote! { #top / #bottom }, Binding::Product)
            }
            (false, false) => (quote! { #top / (#bottom) }, Binding::Product),
        }
    }

    /// Factors with positive exponents, squares and cubes written out.
    fn powers<'f>(&self, factors: impl Iterator<Item = &'f (Id, i32)>) -> Vec<TokenStream> {
        factors
            .map(|(base, exponent)| {
                if *exponent == -1
                    && let Some(name) = self.namer.reciprocal(*base)
                {
                    return quote! { #name };
                }
                let n = exponent.unsigned_abs();
                if n > 3 {
                    let receiver = self.receiver(*base);
                    let n = Literal::i32_unsuffixed(exponent.saturating_abs());
                    return quote! { #receiver.powi(#n) };
                }
                let factor = self.wrapped(*base, Binding::Sign);
                let copies = std::iter::repeat_n(factor, n as usize).collect::<Vec<_>>();
                join(&copies)
            })
            .collect()
    }
}

/// a * b * c
fn join(factors: &[TokenStream]) -> TokenStream {
    let joined = factors.iter().cloned().reduce(|a, b| quote! { #a * #b });
    joined.unwrap_or_default()
}

fn wrap((tokens, binding): (TokenStream, Binding), least: Binding) -> TokenStream {
    if binding < least {
        quote! { (#tokens) }
    } else {
        tokens
    }
}

/// A number as a scalar; a negative one as the negation, π by its name.
fn constant(x: f64) -> TokenStream {
    let value = float(x);
    quote! { lit(#value) }
}

/// A literal `f64`.
pub(super) fn float(x: f64) -> TokenStream {
    let name = [
        (std::f64::consts::PI, "PI"),
        (std::f64::consts::TAU, "TAU"),
        (std::f64::consts::FRAC_PI_2, "FRAC_PI_2"),
    ]
    .into_iter()
    .find(|(value, _)| *value == x.abs());
    let magnitude = match name {
        Some((_, name)) => {
            let name = format_ident!("{name}");
            quote! { ::core::f64::consts::#name }
        }
        None if x.is_nan() => quote! { f64::NAN },
        None if x.is_infinite() => quote! { f64::INFINITY },
        None => {
            let literal = Literal::f64_unsuffixed(x.abs());
            quote! { #literal }
        }
    };
    if x.is_sign_negative() && !x.is_nan() {
        quote! { -#magnitude }
    } else {
        magnitude
    }
}
