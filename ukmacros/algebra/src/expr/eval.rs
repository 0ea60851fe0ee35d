//! Numeric value of an expression: parameter defaults, and the check of each pass by substitution.

use super::graph::{Graph, Id, Node, Symbol};

/// Values of the symbols.
pub struct Point<'a> {
    pub params: &'a [f64],
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub t: f64,
    pub residual: &'a [f64],
    pub prepared: &'a [f64],
}

impl<'a> Point<'a> {
    /// No values: for what contains no symbol.
    pub const NOWHERE: Point<'static> = Point::of_parameters(&[]);

    /// Parameters alone: for what contains no other symbol.
    pub const fn of_parameters(params: &'a [f64]) -> Self {
        Point {
            params,
            q: &[],
            v: &[],
            t: f64::NAN,
            residual: &[],
            prepared: &[],
        }
    }
}

/// Values of `roots`, in one sweep over what they are made of.
pub fn eval(g: &Graph, roots: &[Id], point: &Point<'_>) -> Vec<f64> {
    eval_shaken(g, roots, point, &mut |x| x)
}

/// Values of `roots` with `shake` applied to the value of each node: what small changes do to them shows what rounding may do.
pub fn eval_shaken(
    g: &Graph,
    roots: &[Id],
    point: &Point<'_>,
    shake: &mut dyn FnMut(f64) -> f64,
) -> Vec<f64> {
    Sweep::new(g, roots).shaken(g, point, shake)
}

/// An evaluation that is done at many points.
pub struct Sweep {
    roots: Vec<Id>,
    order: Vec<Id>,
    values: Vec<f64>,
}

impl Sweep {
    pub fn new(g: &Graph, roots: &[Id]) -> Self {
        let top = roots.iter().map(|r| r.index() + 1).max().unwrap_or(0);
        Sweep {
            roots: roots.to_vec(),
            order: g.reachable(roots),
            values: vec![0.0; top],
        }
    }

    /// Number of nodes.
    pub fn size(&self) -> usize {
        self.order.len()
    }

    /// Values of the roots.
    pub fn at(&mut self, g: &Graph, point: &Point<'_>) -> Vec<f64> {
        self.shaken(g, point, &mut |x| x)
    }

    /// Values of the roots with `shake` applied to the value of each node.
    pub fn shaken(
        &mut self,
        g: &Graph,
        point: &Point<'_>,
        shake: &mut dyn FnMut(f64) -> f64,
    ) -> Vec<f64> {
        for id in &self.order {
            self.values[id.index()] = shake(value(g.node(*id), &self.values, point));
        }
        self.roots.iter().map(|r| self.values[r.index()]).collect()
    }
}

fn value(node: &Node, values: &[f64], point: &Point<'_>) -> f64 {
    let at = |id: &Id| values[id.index()];
    let pick = |list: &[f64], i: usize| list.get(i).copied().unwrap_or(f64::NAN);
    match node {
        Node::Const(x) => x.get(),
        Node::Symbol(Symbol::Param(i)) => pick(point.params, *i),
        Node::Symbol(Symbol::Coord(i)) => pick(point.q, *i),
        Node::Symbol(Symbol::Velocity(i)) => pick(point.v, *i),
        Node::Symbol(Symbol::Time) => point.t,
        Node::Symbol(Symbol::Residual(i)) => pick(point.residual, *i),
        Node::Symbol(Symbol::Prepared(i)) => pick(point.prepared, *i),
        // Values are those of switches that are followed.
        Node::Symbol(Symbol::Branch(_)) => 0.0,
        Node::Symbol(Symbol::Multiplier(_)) => f64::NAN,
        Node::Sum(c, terms) => c.get() + terms.iter().map(|(k, t)| k.get() * at(t)).sum::<f64>(),
        Node::Scale(c, inner) => c.get() * at(inner),
        Node::Held(inner) => at(inner),
        Node::Product(factors) => factors.iter().map(|(f, e)| at(f).powi(*e)).product(),
        Node::Call(func, args) => {
            let u = at(&args[0]);
            let w = args.get(1).map_or(f64::NAN, at);
            func.value(u, w)
        }
        Node::Select([a, b, then, otherwise]) => {
            if at(a) <= at(b) {
                at(then)
            } else {
                at(otherwise)
            }
        }
    }
}
