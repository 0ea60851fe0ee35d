//! Derivatives. Those of functions stand in their table.

use super::functions::{Form, Func};
use super::graph::{Graph, Id, Node, Symbol};
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
        let derived: Vec<Id> = args.iter().map(|arg| self.of(*arg, g)).collect();
        match (&func.row().form, args, &derived[..]) {
            (Form::One { slope, .. }, [u], [du]) => {
                let slope = slope(g, *u, value);
                g.mul(slope, *du)
            }
            (Form::Two { derivative, .. }, [u, w], [du, dw]) => {
                derivative(g, (*u, *du), (*w, *dw), value)
            }
            _ => g.zero(),
        }
    }
}
