//! Expressions as a reader writes them.

use super::graph::{Graph, Id, Map, Node, Symbol};

/// Prints expressions with the modeller's names.
pub(crate) struct Printer<'a> {
    pub(crate) graph: &'a Graph,
    pub(crate) coords: &'a [String],
    pub(crate) params: &'a [String],
    pub(crate) constraints: &'a [String],
    /// Nodes that have a name of their own.
    pub(crate) named: Map<Id, String>,
}

/// How tightly the outermost operator of a printed expression binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Precedence {
    Sum,
    Sign,
    Product,
    Power,
    Atom,
}

/// A number without trailing `.0`.
fn number(x: f64) -> String {
    if x == std::f64::consts::PI {
        return "π".to_owned();
    }
    match x == 0.0 || (1e-6..1e16).contains(&x.abs()) {
        true => format!("{x}"),
        false => format!("{x:e}"),
    }
}

impl Printer<'_> {
    /// The text of `id`.
    pub(crate) fn text(&self, id: Id) -> String {
        self.print(id, true).0
    }

    /// The text of `id` itself, even if it has a name.
    pub(crate) fn definition(&self, id: Id) -> String {
        self.print(id, false).0
    }

    fn wrapped(&self, id: Id, least: Precedence) -> String {
        let (text, precedence) = self.print(id, true);
        if precedence < least {
            format!("({text})")
        } else {
            text
        }
    }

    fn print(&self, id: Id, by_name: bool) -> (String, Precedence) {
        if by_name && let Some(name) = self.named.get(&id) {
            return (name.clone(), Precedence::Atom);
        }
        match self.graph.node(id) {
            Node::Const(x) if x.get() < 0.0 => (number(x.get()), Precedence::Sign),
            Node::Const(x) => (number(x.get()), Precedence::Atom),
            Node::Symbol(s) => (self.symbol(*s), Precedence::Atom),
            Node::Sum(c, terms) => {
                let terms: Vec<(f64, Id)> = terms.iter().map(|(k, t)| (k.get(), *t)).collect();
                (self.sum(c.get(), &terms), Precedence::Sum)
            }
            Node::Scale(c, inner) => self.scale(c.get(), *inner),
            Node::Product(factors) => self.product(1.0, factors),
            Node::Held(inner) => self.print(*inner, by_name),
            Node::Call(func, args) => {
                let args: Vec<String> = args.iter().map(|a| self.text(*a)).collect();
                let name = func.row().name;
                (format!("{name}({})", args.join(", ")), Precedence::Atom)
            }
            Node::Select(args) => {
                let [a, b, then, otherwise] = args.map(|id| self.text(id));
                let text = format!("({a} ≤ {b} ? {then} : {otherwise})");
                (text, Precedence::Atom)
            }
        }
    }

    fn symbol(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Param(i) => self.params[i].clone(),
            Symbol::Coord(i) => self.coords[i].clone(),
            Symbol::Velocity(i) => format!("dot({})", self.coords[i]),
            Symbol::Time => "t".to_owned(),
            Symbol::Residual(i) => format!("residual[{i}]"),
            Symbol::Prepared(i) => format!("prepared[{i}]"),
            Symbol::Branch(i) => format!("branch[{i}]"),
            Symbol::Multiplier(i) => format!("reaction({})", self.constraints[i]),
        }
    }

    fn sum(&self, constant: f64, terms: &[(f64, Id)]) -> String {
        let mut out = String::new();
        // A positive term first reads better: x[1] − x[0], not −x[0] + x[1].
        let positive = terms.iter().filter(|(c, _)| *c > 0.0);
        let negative = terms.iter().filter(|(c, _)| *c <= 0.0);
        if constant > 0.0 {
            out += &number(constant);
        }
        for (c, term) in positive.chain(negative) {
            let sign = match (out.is_empty(), *c < 0.0) {
                (true, false) => "",
                (true, true) => "-",
                (false, false) => " + ",
                (false, true) => " - ",
            };
            out += sign;
            out += &match c.abs() {
                1.0 => self.wrapped(*term, Precedence::Product),
                k => self.scale(k, *term).0,
            };
        }
        if constant < 0.0 {
            out += &format!(" - {}", number(-constant));
        }
        out
    }

    fn scale(&self, c: f64, inner: Id) -> (String, Precedence) {
        if !self.named.contains_key(&inner) {
            match self.graph.node(inner) {
                // −(a − b) reads b − a, and −2·(a − b) reads 2·(b − a).
                Node::Sum(constant, terms)
                    if c < 0.0 && terms.iter().any(|(k, _)| k.get() < 0.0) =>
                {
                    let flipped: Vec<(f64, Id)> =
                        terms.iter().map(|(k, t)| (-k.get(), *t)).collect();
                    let sum = self.sum(-constant.get(), &flipped);
                    if c == -1.0 {
                        return (sum, Precedence::Sum);
                    }
                    return (format!("{}*({sum})", number(-c)), Precedence::Product);
                }
                Node::Product(factors) => return self.product(c, factors),
                _ => {}
            }
        }
        if c == -1.0 {
            return (
                format!("-{}", self.wrapped(inner, Precedence::Product)),
                Precedence::Sign,
            );
        }
        let text = format!("{}*{}", number(c), self.wrapped(inner, Precedence::Product));
        (
            text,
            if c < 0.0 {
                Precedence::Sign
            } else {
                Precedence::Product
            },
        )
    }

    fn product(&self, coefficient: f64, factors: &[(Id, i32)]) -> (String, Precedence) {
        let power = |(id, e): &(Id, i32)| match e.abs() {
            1 => self.wrapped(*id, Precedence::Power),
            2 => format!("sq({})", self.text(*id)),
            n => format!("{}^{n}", self.wrapped(*id, Precedence::Atom)),
        };
        let mut above: Vec<String> = factors.iter().filter(|(_, e)| *e > 0).map(power).collect();
        let below: Vec<String> = factors.iter().filter(|(_, e)| *e < 0).map(power).collect();
        let magnitude = coefficient.abs();
        if magnitude != 1.0 || above.is_empty() {
            above.insert(0, number(magnitude));
        }
        let mut text = above.join("*");
        match below.as_slice() {
            [] => {}
            [one] => text += &format!("/{one}"),
            many => text += &format!("/({})", many.join("*")),
        }
        if coefficient < 0.0 {
            return (format!("-{text}"), Precedence::Sign);
        }
        (text, Precedence::Product)
    }
}
