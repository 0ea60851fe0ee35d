//! From the graph to formulas with the modeller's names.

use super::formula::{Formula, Name};
use super::graph::{Graph, Id, Map, Node, Symbol};

/// Writes expressions with the modeller's names.
pub struct Printer<'a> {
    pub graph: &'a Graph,
    pub coords: &'a [String],
    pub params: &'a [String],
    pub constraints: &'a [String],
    /// Nodes that have a name of their own.
    pub named: Map<Id, String>,
}

impl Printer<'_> {
    /// The text of `id`.
    pub fn text(&self, id: Id) -> String {
        self.formula(id).to_string()
    }

    /// What `id` reads as.
    pub fn formula(&self, id: Id) -> Formula {
        match self.named.get(&id) {
            Some(name) => Formula::name(name),
            None => self.definition(id),
        }
    }

    /// What `id` itself reads as, even if it has a name.
    pub fn definition(&self, id: Id) -> Formula {
        match self.graph.node(id) {
            Node::Const(x) => Formula::number(x.get()),
            Node::Symbol(s) => self.symbol(*s),
            Node::Sum(c, terms) => {
                let terms: Vec<(f64, Id)> = terms.iter().map(|(k, t)| (k.get(), *t)).collect();
                self.sum(c.get(), &terms)
            }
            Node::Scale(c, inner) => self.scale(c.get(), *inner),
            Node::Product(factors) => self.product(1.0, factors),
            Node::Held(inner) => self.formula(*inner),
            Node::Call(func, args) => {
                let args = args.iter().map(|a| self.formula(*a));
                Formula::Call(func.row().name, args.collect())
            }
            Node::Select(args) => Formula::Select(Box::new(args.map(|id| self.formula(id)))),
        }
    }

    fn symbol(&self, symbol: Symbol) -> Formula {
        match symbol {
            Symbol::Param(i) => Formula::name(&self.params[i]),
            Symbol::Coord(i) => Formula::name(&self.coords[i]),
            Symbol::Velocity(i) => Formula::Rate(Name::from(self.coords[i].as_str())),
            Symbol::Time => Formula::name("t"),
            Symbol::Residual(i) => Formula::name(&format!("residual[{i}]")),
            Symbol::Prepared(i) => Formula::name(&format!("prepared[{i}]")),
            Symbol::Branch(i) => Formula::name(&format!("branch[{i}]")),
            Symbol::Multiplier(i) => {
                Formula::Call("reaction", vec![Formula::name(&self.constraints[i])])
            }
        }
    }

    fn sum(&self, constant: f64, terms: &[(f64, Id)]) -> Formula {
        // A positive term first reads better: x[1] − x[0], not −x[0] + x[1].
        let positive = terms.iter().filter(|(c, _)| *c > 0.0);
        let negative = terms.iter().filter(|(c, _)| *c <= 0.0);
        let mut out = Vec::new();
        if constant > 0.0 {
            out.push((false, Formula::Number(constant)));
        }
        for (c, term) in positive.chain(negative) {
            let term = match c.abs() {
                1.0 => self.formula(*term),
                k => self.scale(k, *term),
            };
            out.push((*c < 0.0, term));
        }
        if constant < 0.0 {
            out.push((true, Formula::Number(-constant)));
        }
        Formula::Sum(out)
    }

    fn scale(&self, c: f64, inner: Id) -> Formula {
        if !self.named.contains_key(&inner) {
            match self.graph.node(inner) {
                // −(a − b) reads b − a, and −2·(a − b) reads 2·(b − a).
                Node::Sum(constant, terms)
                    if c < 0.0 && terms.iter().any(|(k, _)| k.get() < 0.0) =>
                {
                    let flipped: Vec<(f64, Id)> =
                        terms.iter().map(|(k, t)| (-k.get(), *t)).collect();
                    let sum = self.sum(-constant.get(), &flipped);
                    return match c == -1.0 {
                        true => sum,
                        false => Formula::Product(vec![Formula::Number(-c), sum], Vec::new()),
                    };
                }
                Node::Product(factors) => return self.product(c, factors),
                _ => {}
            }
        }
        let inner = self.formula(inner);
        let magnitude = match c.abs() {
            1.0 => inner,
            k => Formula::Product(vec![Formula::Number(k), inner], Vec::new()),
        };
        magnitude.signed(c)
    }

    fn product(&self, coefficient: f64, factors: &[(Id, i32)]) -> Formula {
        let power = |(id, e): &(Id, i32)| match (e.unsigned_abs(), self.graph.node(*id)) {
            (1, _) => self.formula(*id),
            // Of even powers the sign below does not matter: the coordinate declared first is the positive one.
            (e, Node::Sum(c, terms)) if e % 2 == 0 && !self.named.contains_key(id) => {
                let first = terms
                    .iter()
                    .min_by_key(|(_, term)| match self.graph.node(*term) {
                        Node::Symbol(symbol) => Some(*symbol),
                        _ => None,
                    });
                let sign = first.map_or(1.0, |(k, _)| k.get().signum());
                let terms: Vec<(f64, Id)> =
                    terms.iter().map(|(k, t)| (sign * k.get(), *t)).collect();
                Formula::Power(Box::new(self.sum(sign * c.get(), &terms)), e)
            }
            (e, _) => Formula::Power(Box::new(self.formula(*id)), e),
        };
        let mut above: Vec<Formula> = factors.iter().filter(|(_, e)| *e > 0).map(power).collect();
        let below: Vec<Formula> = factors.iter().filter(|(_, e)| *e < 0).map(power).collect();
        let magnitude = coefficient.abs();
        if magnitude != 1.0 || above.is_empty() {
            above.insert(0, Formula::Number(magnitude));
        }
        let product = match (above.len(), below.is_empty()) {
            (1, true) => above.remove(0),
            _ => Formula::Product(above, below),
        };
        product.signed(coefficient)
    }
}
