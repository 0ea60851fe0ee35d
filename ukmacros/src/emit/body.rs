//! Statements of one emitted function, as text: it is what is shown of it, and becomes tokens in one step.

use super::names::{Namer, Slots, plain};
use super::tokens;
use crate::model::Model;
use proc_macro2::TokenStream;
use std::borrow::Cow;
use std::collections::HashSet;
use ukalgebra::analysis::{Function, Place, Program, Role, Slice, Step};
use ukalgebra::expr::{Graph, Id, Node, Symbol, System};

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
pub(super) fn body(writing: &Writing<'_>) -> String {
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
    let declare = if many { "" } else { "let " };
    let (mut statements, mut group, mut declared) = (inputs, String::new(), Vec::new());
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
                group += &format!("{declare}{name} = {value}; ");
                if exits.contains(&id) {
                    group += &format!("if {name}.is_zero() {{ return {name}; }} ");
                }
                declared.push(name);
            }
            Step::Reciprocal(id) => {
                let receiver = writer.receiver(id);
                let name = writer.namer.declare_reciprocal(id, &purpose(next));
                group += &format!("{declare}{name} = {receiver}.recip(); ");
                declared.push(name);
            }
            Step::SinCos { sin, cos } => {
                let argument = g.operands(sin)[0];
                let argument = writer.receiver(argument);
                let sin = writer.namer.declare(sin, &purpose(next));
                let cos = writer.namer.declare(cos, &purpose(next));
                group += &format!("{declare}({sin}, {cos}) = {argument}.sin_cos(); ");
                declared.extend([sin, cos]);
            }
            Step::Store(k) => {
                let (place, id) = roots[k];
                let value = writer.expression(id);
                let place = stored(place);
                group += &format!("{place} = {value}; ");
                next = (k + 1).min(roots.len() - 1);
            }
        }
        if declared.len() >= GROUP {
            let names = std::mem::take(&mut declared).join(", ");
            if many {
                statements += &format!("let ({names}); ");
            }
            statements += &std::mem::take(&mut group);
            if vast {
                statements += "ukcore::emitted::border(); ";
            }
        }
    }
    if many && !declared.is_empty() {
        statements += &format!("let ({},); ", declared.join(", "));
    }
    statements + &group
}

/// The left side of an assignment to `place`.
fn stored(place: Place) -> String {
    match place {
        Place::Element(slice, at) => format!("{}[{at}]", slice.name()),
        Place::Kinetic => "let kinetic".to_owned(),
        Place::Potential => "let potential".to_owned(),
        Place::Certificate => "let safe".to_owned(),
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

/// An expression, and its outermost operator.
type Written = (String, Operator);

/// Factors of a product, each wrapped so that it can be multiplied.
type Factors = Vec<Written>;

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
    ) -> String {
        let symbol = |id: &Id| match self.graph.node(*id) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        };
        let used: HashSet<Symbol> = program.needed.iter().filter_map(symbol).collect();
        let mut out = String::new();
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
            if symbols.iter().any(|s| used.contains(s)) {
                let names = symbols.iter().map(|s| match used.contains(s) {
                    true => self.namer.symbol(*s),
                    false => "_",
                });
                let (names, n) = (names.collect::<Vec<_>>().join(", "), symbols.len());
                out += &format!(
                    "let [{names}] = *ukcore::emitted::exact::<S, {n}>({text}, \"{text}\"); "
                );
            }
        }
        if program.needed.iter().any(|id| self.has_literal(*id)) {
            out += "let lit = S::from_f64; ";
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
    fn expression(&self, id: Id) -> String {
        self.write(id).0
    }

    fn write(&self, id: Id) -> Written {
        match self.namer.variable(id) {
            Some(name) => (name.to_owned(), Operator::Call),
            None => self.node(id),
        }
    }

    fn definition(&self, id: Id) -> String {
        self.node(id).0
    }

    fn wrapped(&self, id: Id, least: Operator) -> String {
        wrap(self.write(id), least).0
    }

    /// The value of `id` as the receiver of a method.
    fn receiver(&self, id: Id) -> String {
        self.wrapped(id, Operator::Call)
    }

    fn node(&self, id: Id) -> Written {
        match self.graph.node(id) {
            Node::Const(x) => (constant(x.get()), Operator::Call),
            Node::Symbol(s) => (self.namer.symbol(*s).to_owned(), Operator::Call),
            Node::Sum(c, terms) => {
                let terms: Vec<(f64, Id)> = terms.iter().map(|(k, t)| (k.get(), *t)).collect();
                self.sum(c.get(), &terms)
            }
            Node::Scale(c, inner) => self.scale(c.get(), *inner),
            Node::Product(factors) => self.product(factors),
            Node::Held(inner) => self.write(*inner),
            Node::Call(func, args) => {
                let (receiver, name) = (self.receiver(args[0]), func.row().name);
                let rest = self.listed(&args[1..]);
                (format!("{receiver}.{name}({rest})"), Operator::Call)
            }
            Node::Select(args) => {
                let args = self.listed(args);
                (format!("S::select_le({args})"), Operator::Call)
            }
        }
    }

    fn listed(&self, ids: &[Id]) -> String {
        let all: Vec<String> = ids.iter().map(|id| self.expression(*id)).collect();
        all.join(", ")
    }

    /// Products are added in one step where the processor can.
    fn sum(&self, c: f64, terms: &[(f64, Id)]) -> Written {
        let (leading, terms) = ascending(self.graph, c, terms.to_vec());
        let mut out = None;
        let mut before = String::new();
        if leading {
            out = Some((constant(c), Operator::Call));
        }
        for (at, (k, term)) in terms.iter().enumerate() {
            if at % LONGEST == LONGEST - 1
                && let Some((sum, _)) = out
            {
                before += &format!("let sum = {sum}; ");
                out = Some(("sum".to_owned(), Operator::Call));
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
                        (format!("-{product}"), Operator::Sign)
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
                            format!("({})", join(factors))
                        }
                    };
                    let method = if negative { "neg_mul_add" } else { "mul_add" };
                    (
                        format!("{receiver}.{method}({last}, {sum})"),
                        Operator::Call,
                    )
                }
                factors => {
                    let (sign, factor) = (if negative { '-' } else { '+' }, join(factors));
                    (format!("{sum} {sign} {factor}"), Operator::Sum)
                }
            });
        }
        let (sum, operator) = out.unwrap_or_else(|| (constant(c), Operator::Call));
        let value = constant(c.abs());
        let (sum, operator) = match c {
            _ if c == 0.0 || leading => (sum, operator),
            _ if c > 0.0 => (format!("{sum} + {value}"), Operator::Sum),
            _ => (format!("{sum} - {value}"), Operator::Sum),
        };
        match before.is_empty() {
            true => (sum, operator),
            // In parentheses, as a statement may begin with it.
            false => (format!("({{ {before}{sum} }})"), Operator::Call),
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

    fn scale(&self, c: f64, inner: Id) -> Written {
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
            return (format!("-{factor}"), Operator::Sign);
        }
        let (value, factor) = (constant(c), self.wrapped(inner, Operator::Sign));
        (format!("{value} * {factor}"), Operator::Product)
    }

    fn product(&self, factors: &[(Id, i32)]) -> Written {
        let (above, below) = self.sides(factors);
        let (top, bottom) = (join(&above), join(&below));
        match (above.is_empty(), below.is_empty()) {
            (_, true) => (top, Operator::Product),
            (true, false) if matches!(factors, [(_, -1)]) => {
                let base = self.receiver(factors[0].0);
                (format!("{base}.recip()"), Operator::Call)
            }
            (true, false) => (format!("({bottom}).recip()"), Operator::Call),
            (false, false) if below.len() == 1 => (format!("{top} / {bottom}"), Operator::Product),
            (false, false) => (format!("{top} / ({bottom})"), Operator::Product),
        }
    }

    /// Factors above and below the fraction bar; what is known first is multiplied first.
    fn sides(&self, factors: &[(Id, i32)]) -> (Factors, Factors) {
        let mut sides = (Vec::new(), Vec::new());
        for (base, exponent) in known_first(self.graph, factors) {
            if exponent == -1
                && let Some(name) = self.namer.reciprocal(base)
            {
                sides.0.push((name.to_owned(), Operator::Call));
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
                let (receiver, n) = (self.receiver(base), exponent.saturating_abs());
                side.push((format!("{receiver}.powi({n})"), Operator::Call));
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
fn join(factors: &[Written]) -> String {
    let factors: Vec<&str> = factors.iter().map(|(factor, _)| factor.as_str()).collect();
    factors.join(" * ")
}

/// Puts an expression in parentheses unless it binds as tightly as `least`.
fn wrap((text, operator): Written, least: Operator) -> Written {
    match operator < least {
        true => (format!("({text})"), Operator::Call),
        false => (text, operator),
    }
}

/// A number as a scalar; a negative one as the negation, π by its name.
fn constant(x: f64) -> String {
    format!("lit({})", literal(x))
}

/// A literal `f64`.
pub(super) fn float(x: f64) -> TokenStream {
    tokens(&literal(x))
}

fn literal(x: f64) -> String {
    let size = x.abs();
    let magnitude: Cow<'_, str> = match size {
        std::f64::consts::PI => "::core::f64::consts::PI".into(),
        std::f64::consts::TAU => "::core::f64::consts::TAU".into(),
        std::f64::consts::FRAC_PI_2 => "::core::f64::consts::FRAC_PI_2".into(),
        _ if x.is_nan() => "f64::NAN".into(),
        _ if x.is_infinite() => "f64::INFINITY".into(),
        _ if size != 0.0 && !(1e-6..1e16).contains(&size) => format!("{size:e}").into(),
        _ if size.fract() == 0.0 => format!("{size}.0").into(),
        _ => size.to_string().into(),
    };
    match x.is_sign_negative() && !x.is_nan() {
        true => format!("-{magnitude}"),
        false => magnitude.into_owned(),
    }
}
