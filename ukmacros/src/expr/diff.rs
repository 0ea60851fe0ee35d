//! Derivatives.
//!
//! Domains: where a function has no derivative, one is chosen and the emitted code follows it. abs′ is sign, with 0 at 0;
//! sign′ is 0; min and max take the branch of the smaller (larger) argument, the first at a tie. sqrt′ is unbounded at 0,
//! asin′ and acos′ at ±1, ln′ and negative powers at 0, atan2′ and hypot′ at (0, 0): there the result is not finite.

use super::graph::{Func, Graph, Id, Node, Symbol};
use std::collections::{HashMap, HashSet};

/// A derivation: how symbols change. Remembers what it has differentiated.
pub(crate) struct Derivative {
    seed: Seed,
    known: HashMap<Id, Id>,
}

#[derive(Clone, Copy)]
enum Seed {
    /// ∂/∂symbol.
    Partial(Symbol),
    /// d/dt with q → q̇, t → 1 and q̇ fixed: the total derivative without its q̈ terms.
    Total,
}

impl Derivative {
    /// ∂/∂symbol.
    pub(crate) fn partial(symbol: Symbol) -> Self {
        Derivative {
            seed: Seed::Partial(symbol),
            known: HashMap::new(),
        }
    }

    /// d/dt at q̈ = 0 (q → q̇, q̇ → 0, t → 1). Of φ(q, t) this is φ̇ itself; of φ̇ it is φ̈ without A q̈.
    pub(crate) fn total() -> Self {
        Derivative {
            seed: Seed::Total,
            known: HashMap::new(),
        }
    }

    fn of_symbol(&self, symbol: Symbol, g: &mut Graph) -> Id {
        match (self.seed, symbol) {
            (Seed::Partial(s), _) if s == symbol => g.one(),
            (Seed::Total, Symbol::Coord(i)) => g.symbol(Symbol::Velocity(i)),
            (Seed::Total, Symbol::Time) => g.one(),
            _ => g.zero(),
        }
    }

    /// Whether the derivative of `id` is zero for want of dependence.
    fn blind(&self, id: Id, g: &Graph) -> bool {
        let uses = g.uses(id);
        match self.seed {
            Seed::Partial(s @ (Symbol::Coord(_) | Symbol::Velocity(_))) => !g.depends(id, s),
            Seed::Partial(Symbol::Time) => !uses.time,
            Seed::Partial(Symbol::Param(_) | Symbol::Prepared(_)) => !uses.param,
            Seed::Partial(Symbol::Residual(_)) => !uses.residual,
            Seed::Partial(Symbol::Branch(_)) => !uses.branch,
            Seed::Total => !(uses.coord || uses.time),
        }
    }

    /// The derivative of `id`.
    pub(crate) fn of(&mut self, id: Id, g: &mut Graph) -> Id {
        if let Some(known) = self.known(id, g) {
            return known;
        }
        // Operands before their users, without recursion: a chain of values can be long.
        let mut needed = vec![id];
        let mut seen = HashSet::from([id]);
        let mut at = 0;
        while let Some(next) = needed.get(at) {
            for operand in g.operands(*next) {
                if self.known(operand, g).is_none() && seen.insert(operand) {
                    needed.push(operand);
                }
            }
            at += 1;
        }
        needed.sort_unstable();
        for id in needed {
            let derivative = self.of_node(id, g);
            self.known.insert(id, derivative);
        }
        self.known[&id]
    }

    /// The derivative of `id` if there is nothing to compute.
    fn known(&self, id: Id, g: &mut Graph) -> Option<Id> {
        if self.blind(id, g) {
            return Some(g.zero());
        }
        self.known.get(&id).copied()
    }

    /// The derivative of a node whose operands have theirs.
    fn of_node(&mut self, id: Id, g: &mut Graph) -> Id {
        match g.node(id).clone() {
            Node::Const(_) => g.zero(),
            Node::Symbol(s) => self.of_symbol(s, g),
            Node::Scale(c, inner) => {
                let d = self.of(inner, g);
                g.scale(c.get(), d)
            }
            Node::Sum(_, terms) => {
                let mut derived = Vec::with_capacity(terms.len());
                for (c, term) in terms {
                    // A group stays a group; the product rule's terms are opened.
                    let grouped = matches!(g.node(term), Node::Sum(..));
                    let d = self.of(term, g);
                    if grouped {
                        derived.push((c.get(), d));
                    } else {
                        derived.extend(g.open(c.get(), d));
                    }
                }
                g.sum(&derived)
            }
            Node::Product(factors) => {
                let mut terms = Vec::new();
                for (k, &(base, exponent)) in factors.iter().enumerate() {
                    let d = self.of(base, g);
                    if g.is_zero(d) {
                        continue;
                    }
                    let mut rest = factors.clone();
                    rest[k].1 = exponent - 1;
                    rest.push((d, 1));
                    let term = g.product(&rest);
                    terms.push((f64::from(exponent), term));
                }
                g.sum(&terms)
            }
            Node::Call(func, args) => self.of_call(func, &args, id, g),
            Node::Held(inner) => self.of(inner, g),
            Node::Select {
                a,
                b,
                then,
                otherwise,
            } => {
                let then = self.of(then, g);
                let otherwise = self.of(otherwise, g);
                g.select(a, b, then, otherwise)
            }
        }
    }

    fn of_call(&mut self, func: Func, args: &[Id], value: Id, g: &mut Graph) -> Id {
        let u = args[0];
        let du = self.of(u, g);
        if let [_, w] = *args {
            let dw = self.of(w, g);
            return of_call2(func, (u, du), (w, dw), value, g);
        }
        let slope = match func {
            Func::Sqrt => {
                let r = g.pow(value, -1);
                g.scale(0.5, r)
            }
            Func::Sin => g.call1(Func::Cos, u),
            Func::Cos => {
                let s = g.call1(Func::Sin, u);
                g.neg(s)
            }
            Func::Tan => {
                let (one, square) = (g.one(), g.square(value));
                g.add(one, square)
            }
            Func::Asin | Func::Acos => {
                let (one, square) = (g.one(), g.square(u));
                let radicand = g.sub(one, square);
                let root = g.call1(Func::Sqrt, radicand);
                let r = g.pow(root, -1);
                g.scale(if func == Func::Asin { 1.0 } else { -1.0 }, r)
            }
            Func::Atan => {
                let (one, square) = (g.one(), g.square(u));
                let d = g.add(one, square);
                g.pow(d, -1)
            }
            Func::Sinh => g.call1(Func::Cosh, u),
            Func::Cosh => g.call1(Func::Sinh, u),
            Func::Tanh => {
                let (one, square) = (g.one(), g.square(value));
                g.sub(one, square)
            }
            Func::Exp => value,
            Func::Ln => g.pow(u, -1),
            Func::Abs => g.call1(Func::Sign, u),
            Func::Sign
            | Func::Atan2
            | Func::Min
            | Func::Max
            | Func::Hypot
            | Func::Powf
            | Func::Branch => g.zero(),
        };
        g.mul(slope, du)
    }
}

/// Derivative of a function of two arguments, each with its own derivative.
fn of_call2(func: Func, (u, du): (Id, Id), (w, dw): (Id, Id), value: Id, g: &mut Graph) -> Id {
    match func {
        Func::Min => g.select(u, w, du, dw),
        Func::Max => g.select(w, u, du, dw),
        Func::Hypot => {
            let (a, b) = (g.mul(u, du), g.mul(w, dw));
            let sum = g.add(a, b);
            g.div(sum, value)
        }
        Func::Atan2 => {
            let (a, b) = (g.mul(w, du), g.mul(u, dw));
            let top = g.sub(a, b);
            let (uu, ww) = (g.square(u), g.square(w));
            let bottom = g.add(uu, ww);
            g.div(top, bottom)
        }
        Func::Powf => {
            // u^w: w u^(w−1) u′ + u^w ln u · w′; the second only where the exponent varies.
            let one = g.one();
            let lower = g.sub(w, one);
            let power = g.call2(Func::Powf, u, lower);
            let base = g.product(&[(w, 1), (power, 1), (du, 1)]);
            if g.is_zero(dw) {
                return base;
            }
            let ln = g.call1(Func::Ln, u);
            let exponent = g.product(&[(value, 1), (ln, 1), (dw, 1)]);
            g.add(base, exponent)
        }
        _ => g.zero(),
    }
}
