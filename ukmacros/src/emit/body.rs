//! Statements of one emitted function.

use super::names::{Namer, Slots, plain};
use crate::analysis::{Function, Place, Program, Role, Slice, Step};
use crate::expr::{Graph, Id, Node, Symbol, System};
use crate::model::Model;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::HashSet;

/// A function to write.
pub(super) struct Writing<'a> {
    pub(super) system: &'a System,
    pub(super) model: &'a Model,
    pub(super) prepared: Slots<'a>,
    pub(super) function: &'a Function,
}

/// The steps of a function beyond which its variables are declared in groups: the compiler of the emitted code opens a scope within a scope
/// at each `let`, and recurses on them where it writes what debuggers read.
const MANY: usize = 1000;
/// Variables of a group.
const GROUP: usize = 64;
/// The steps of a function beyond which a border follows each group, for the optimiser: packing scalars into vectors takes time that grows
/// as the square of the statements in sight. A function without borders runs faster: what crosses one waits in memory, and nothing is
/// packed across it.
const VAST: usize = 2000;

/// Writes the straight-line code of a function, with the coordinates, velocities and parameters that it reads.
pub(super) fn body(writing: &Writing<'_>) -> TokenStream {
    let Writing {
        system,
        model,
        prepared,
        function,
    } = *writing;
    let (g, roots, program) = (&system.graph, &function.roots, &function.program);
    let hints = system.all_hints();
    let mut writer = Writer {
        graph: g,
        namer: Namer::new(g, model, system.constraints.len(), &hints, prepared),
    };
    let inputs = writer.inputs(model, system.constraints.len(), prepared, program);
    let purpose = |root: usize| writing.purpose(roots[root].0);
    let exits: HashSet<Id> = function.exits.iter().copied().collect();
    let (many, vast) = (program.steps.len() > MANY, program.steps.len() > VAST);
    let declare = (!many).then(|| quote! { let });
    let (mut statements, mut group, mut declared) =
        (TokenStream::new(), TokenStream::new(), Vec::new());
    // Helpers are named for the value whose computation needs them first: the next one stored.
    let mut next = 0;
    for step in &program.steps {
        match *step {
            Step::Let(id) => {
                let value = writer.definition(id);
                // The value itself, if it is stored in several places; else a part of it.
                let purpose = match roots[next].1 == id {
                    true => purpose(next),
                    false => format!("{}_part", purpose(next)),
                };
                let name = writer.namer.declare(id, &purpose);
                group.extend(quote! { #declare #name = #value; });
                if exits.contains(&id) {
                    group.extend(quote! { if #name.is_zero() { return #name; } });
                }
                declared.push(name);
            }
            Step::Reciprocal(id) => {
                let receiver = writer.receiver(id);
                let name = writer.namer.declare_reciprocal(id, &purpose(next));
                group.extend(quote! { #declare #name = #receiver.recip(); });
                declared.push(name);
            }
            Step::SinCos { sin, cos } => {
                let argument = g.operands(sin)[0];
                let argument = writer.receiver(argument);
                let sin = writer.namer.declare(sin, &purpose(next));
                let cos = writer.namer.declare(cos, &purpose(next));
                group.extend(quote! { #declare (#sin, #cos) = #argument.sin_cos(); });
                declared.extend([sin, cos]);
            }
            Step::Store(k) => {
                let (place, id) = roots[k];
                let value = writer.expression(id);
                let place = stored(place);
                group.extend(quote! { #place = #value; });
                next = (k + 1).min(roots.len() - 1);
            }
        }
        if declared.len() >= GROUP {
            let names = std::mem::take(&mut declared);
            let names = many.then(|| quote! { let (#(#names),*); });
            let border = vast.then(|| quote! { ukcore::emitted::border(); });
            statements.extend(quote! { #names #group #border });
            group = TokenStream::new();
        }
    }
    let names = (many && !declared.is_empty()).then(|| quote! { let (#(#declared,)*); });
    quote! { #inputs #statements #names #group }
}

/// The left side of an assignment to `place`.
fn stored(place: Place) -> TokenStream {
    match place {
        Place::Element(slice, at) => {
            let (slice, at) = (
                format_ident!("{}", slice.name()),
                Literal::usize_unsuffixed(at),
            );
            quote! { #slice[#at] }
        }
        Place::Kinetic => quote! { let kinetic },
        Place::Potential => quote! { let potential },
        Place::Certificate => quote! { let safe },
    }
}

impl Writing<'_> {
    /// What a value at `place` is for: the name of its helpers.
    fn purpose(&self, place: Place) -> String {
        let Place::Element(slice, at) = place else {
            let name = match place {
                Place::Kinetic => "kinetic",
                Place::Potential => "potential",
                _ => "safe",
            };
            return name.to_owned();
        };
        let n = self.model.coord_elements.len();
        let coord = |i: usize| plain(&self.model.coord_elements[i].name);
        match slice {
            Slice::Mass => format!("mass_{}_{}", coord(at % n), coord(at / n)).to_lowercase(),
            Slice::Jacobian => {
                let constraints = &self.system.constraints;
                let constraint = constraints[at % constraints.len()].item.text();
                format!("a_{}", plain(&constraint)).to_lowercase()
            }
            Slice::Rhs => format!("b_{at}"),
            Slice::Outputs => format!("output_{at}"),
            Slice::Out if self.function.role == Role::Correction => format!("correction_{at}"),
            Slice::Out => format!("acceleration_{at}"),
            slice => format!("{}_{at}", slice.name()),
        }
    }
}

/// The outermost operator of an emitted expression, in the order of precedence.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Operator {
    Sum,
    Product,
    Sign,
    Call,
}

/// Sums of more terms are written in parts: the compiler of the emitted code recurses on `a.mul_add(b, c.mul_add(d, …))`.
const LONGEST: usize = 64;

/// Factors of a product, each wrapped so that it can be multiplied.
type Factors = Vec<(TokenStream, Operator)>;

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
        prepared: Slots<'_>,
        program: &Program,
    ) -> TokenStream {
        let symbol = |id: &Id| match self.graph.node(*id) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        };
        let used: HashSet<Symbol> = program.needed.iter().filter_map(symbol).collect();
        let mut out = TokenStream::new();
        let n = model.coord_elements.len();
        let params = model.param_elements.len() + prepared.options.len();
        let all = |n: usize, symbol: fn(usize) -> Symbol| (0..n).map(symbol).collect::<Vec<_>>();
        for (text, symbols) in [
            ("given", all(params, Symbol::Param)),
            ("prepared", prepared.symbols().collect()),
            ("q", all(n, Symbol::Coord)),
            ("v", all(n, Symbol::Velocity)),
            ("residual", all(constraints, Symbol::Residual)),
        ] {
            let slice = format_ident!("{text}");
            let names: Vec<Option<Ident>> = symbols
                .iter()
                .map(|s| used.contains(s).then(|| self.namer.symbol(*s)))
                .collect();
            if names.iter().any(Option::is_some) {
                let patterns = names.iter().map(|name| match name {
                    Some(name) => quote! { #name },
                    None => quote! { _ },
                });
                let n = Literal::usize_unsuffixed(symbols.len());
                out.extend(quote! {
                    let [#(#patterns),*] = *ukcore::emitted::exact::<S, #n>(#slice, #text);
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

    fn write(&self, id: Id) -> (TokenStream, Operator) {
        match self.namer.variable(id) {
            Some(name) => (quote! { #name }, Operator::Call),
            None => self.node(id),
        }
    }

    fn definition(&self, id: Id) -> TokenStream {
        self.node(id).0
    }

    fn wrapped(&self, id: Id, least: Operator) -> TokenStream {
        wrap(self.write(id), least).0
    }

    /// The value of `id` as the receiver of a method.
    fn receiver(&self, id: Id) -> TokenStream {
        self.wrapped(id, Operator::Call)
    }

    fn node(&self, id: Id) -> (TokenStream, Operator) {
        match self.graph.node(id) {
            Node::Const(x) => (constant(x.get()), Operator::Call),
            Node::Symbol(s) => {
                let name = self.namer.symbol(*s);
                (quote! { #name }, Operator::Call)
            }
            Node::Sum(c, terms) => {
                let terms: Vec<(f64, Id)> = terms.iter().map(|(k, t)| (k.get(), *t)).collect();
                self.sum(c.get(), &terms)
            }
            Node::Scale(c, inner) => self.scale(c.get(), *inner),
            Node::Product(factors) => self.product(factors),
            Node::Held(inner) => self.write(*inner),
            Node::Call(func, args) => {
                let receiver = self.receiver(args[0]);
                let name = format_ident!("{}", func.row().name);
                let rest = args[1..].iter().map(|a| self.expression(*a));
                (quote! { #receiver.#name(#(#rest),*) }, Operator::Call)
            }
            Node::Select(args) => {
                let args = args.map(|id| self.expression(id));
                (quote! { S::select_le(#(#args),*) }, Operator::Call)
            }
        }
    }

    /// Products are added in one step where the processor can.
    fn sum(&self, c: f64, terms: &[(f64, Id)]) -> (TokenStream, Operator) {
        let (leading, terms) = ascending(self.graph, c, terms.to_vec());
        let mut out = None;
        let mut before = TokenStream::new();
        if leading {
            out = Some((constant(c), Operator::Call));
        }
        for (at, (k, term)) in terms.iter().enumerate() {
            if at % LONGEST == LONGEST - 1
                && let Some((sum, _)) = out
            {
                before.extend(quote! { let sum = #sum; });
                out = Some((quote! { sum }, Operator::Call));
            }
            let factors = self.term(k.abs(), *term);
            let negative = *k < 0.0;
            let Some((sum, _)) = out else {
                let operator = match factors.len() {
                    1 => factors[0].1,
                    _ => Operator::Product,
                };
                let product = (join(&factors), operator);
                out = Some(match negative {
                    false => product,
                    true => {
                        let (product, _) = wrap(product, Operator::Call);
                        (quote! { -#product }, Operator::Sign)
                    }
                });
                continue;
            };
            out = Some(match factors.as_slice() {
                // The last factor is known last.
                [factors @ .., (last, _)] if !factors.is_empty() => {
                    let receiver = match factors {
                        [factor] => wrap(factor.clone(), Operator::Call).0,
                        _ => {
                            let product = join(factors);
                            quote! { (#product) }
                        }
                    };
                    let method = if negative { "neg_mul_add" } else { "mul_add" };
                    let method = format_ident!("{method}");
                    (quote! { #receiver.#method(#last, #sum) }, Operator::Call)
                }
                factors => {
                    let factor = join(factors);
                    let sum = match negative {
                        true => quote! { #sum - #factor },
                        false => quote! { #sum + #factor },
                    };
                    (sum, Operator::Sum)
                }
            });
        }
        let (sum, operator) = out.unwrap_or_else(|| (constant(c), Operator::Call));
        let value = constant(c.abs());
        let (sum, operator) = match c {
            _ if c == 0.0 || leading => (sum, operator),
            _ if c > 0.0 => (quote! { #sum + #value }, Operator::Sum),
            _ => (quote! { #sum - #value }, Operator::Sum),
        };
        match before.is_empty() {
            true => (sum, operator),
            // In parentheses, as a statement may begin with it.
            false => (quote! { ({ #before #sum }) }, Operator::Call),
        }
    }

    /// c · id as factors, in the order in which they are known; a single one may be added, several may be multiplied.
    fn term(&self, c: f64, id: Id) -> Factors {
        let mut out = Vec::new();
        if c != 1.0 {
            out.push((constant(c), Operator::Call));
        }
        let factors = match self.graph.node(id) {
            Node::Product(factors) if self.namer.variable(id).is_none() => {
                Some(self.sides(factors)).filter(|(_, below)| below.is_empty())
            }
            _ => None,
        };
        match factors {
            Some((above, _)) => out.extend(above),
            None => {
                let least = if out.is_empty() {
                    Operator::Product
                } else {
                    Operator::Sign
                };
                out.push(wrap(self.write(id), least));
            }
        }
        out
    }

    fn scale(&self, c: f64, inner: Id) -> (TokenStream, Operator) {
        // −(a − b) is b − a.
        if c == -1.0
            && self.namer.variable(inner).is_none()
            && let Node::Sum(constant, terms) = self.graph.node(inner)
        {
            let flipped: Vec<(f64, Id)> = terms.iter().map(|(k, t)| (-k.get(), *t)).collect();
            return self.sum(-constant.get(), &flipped);
        }
        if c == -1.0 {
            let factor = self.wrapped(inner, Operator::Call);
            return (quote! { -#factor }, Operator::Sign);
        }
        let (value, factor) = (constant(c), self.wrapped(inner, Operator::Sign));
        (quote! { #value * #factor }, Operator::Product)
    }

    fn product(&self, factors: &[(Id, i32)]) -> (TokenStream, Operator) {
        let (above, below) = self.sides(factors);
        let (top, bottom) = (join(&above), join(&below));
        match (above.is_empty(), below.is_empty()) {
            (_, true) => (top, Operator::Product),
            (true, false) if matches!(factors, [(_, -1)]) => {
                let base = self.receiver(factors[0].0);
                (quote! { #base.recip() }, Operator::Call)
            }
            (true, false) => (quote! { (#bottom).recip() }, Operator::Call),
            (false, false) if below.len() == 1 => (quote! { #top / #bottom }, Operator::Product),
            (false, false) => (quote! { #top / (#bottom) }, Operator::Product),
        }
    }

    /// Factors above and below the fraction bar; what is known first is multiplied first.
    fn sides(&self, factors: &[(Id, i32)]) -> (Factors, Factors) {
        let mut sides = (Vec::new(), Vec::new());
        for (base, exponent) in known_first(self.graph, factors) {
            if exponent == -1
                && let Some(name) = self.namer.reciprocal(base)
            {
                sides.0.push((quote! { #name }, Operator::Call));
                continue;
            }
            let side = if exponent > 0 {
                &mut sides.0
            } else {
                &mut sides.1
            };
            let n = exponent.unsigned_abs();
            // Squares and cubes are written out.
            if n > 3 {
                let receiver = self.receiver(base);
                let n = Literal::i32_unsuffixed(exponent.saturating_abs());
                side.push((quote! { #receiver.powi(#n) }, Operator::Call));
                continue;
            }
            let factor = wrap(self.write(base), Operator::Sign);
            side.extend(std::iter::repeat_n(factor, n as usize));
        }
        sides
    }
}

/// The terms of a sum with the constant `c` in the order in which they are added, what is known first first, behind a positive one, so that
/// a difference needs no negation; and whether the constant comes before them.
pub(super) fn ascending(
    graph: &Graph,
    c: f64,
    mut terms: Vec<(f64, Id)>,
) -> (bool, Vec<(f64, Id)>) {
    terms.sort_by_key(|(_, term)| graph.latency(*term));
    let first = terms.iter().position(|(k, _)| *k > 0.0);
    if let Some(first) = first {
        terms[..=first].rotate_right(1);
    }
    (c != 0.0 && (c > 0.0 || first.is_none()), terms)
}

/// The factors of a product in the order in which they are multiplied: what is known first first.
pub(super) fn known_first(graph: &Graph, factors: &[(Id, i32)]) -> Vec<(Id, i32)> {
    let mut factors = factors.to_vec();
    factors.sort_by_key(|(base, e)| graph.latency(*base) + if *e < 0 { 14 } else { 0 });
    factors
}

/// a * b * c
fn join(factors: &[(TokenStream, Operator)]) -> TokenStream {
    let mut product = TokenStream::new();
    for (k, (factor, _)) in factors.iter().enumerate() {
        let times = (k > 0).then(|| quote! { * });
        product.extend(quote! { #times #factor });
    }
    product
}

/// Puts an expression in parentheses unless it binds as tightly as `least`.
fn wrap((tokens, operator): (TokenStream, Operator), least: Operator) -> (TokenStream, Operator) {
    match operator < least {
        true => (quote! { (#tokens) }, Operator::Call),
        false => (tokens, operator),
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
            let x = x.abs();
            let plain = x == 0.0 || (1e-6..1e16).contains(&x);
            let power = (!plain).then(|| format!("{x:e}").parse().ok()).flatten();
            let literal: Literal = power.unwrap_or_else(|| Literal::f64_unsuffixed(x));
            quote! { #literal }
        }
    };
    if x.is_sign_negative() && !x.is_nan() {
        quote! { -#magnitude }
    } else {
        magnitude
    }
}
