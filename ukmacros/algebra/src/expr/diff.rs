//! Derivatives. Those of functions stand in their table.

use super::functions::{Form, Func};
use super::graph::{Graph, Id, Map, Node, Num, Symbol};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::rc::Rc;

/// A derivation: how symbols change. Remembers what it has differentiated.
pub struct Derivative {
    seed: Seed,
    known: Map<Id, Id>,
    /// The terms of sums that matter.
    sums: Rc<Sums>,
}

/// The terms of long sums that depend on a symbol: all derivatives of a sum cost one look at each term.
#[derive(Default)]
struct Sums(HashMap<Id, BTreeMap<Symbol, Vec<(Num, Id)>>>);

/// Sums of more terms are long.
const LONG: usize = 8;

impl Sums {
    /// Enters `id` and the sums it is a sum of.
    fn of(id: Id, g: &Graph) -> Self {
        let mut sums = Sums::default();
        let mut stack = vec![id];
        while let Some(id) = stack.pop() {
            let (_, id) = g.unscaled(id);
            let Node::Sum(_, terms) = g.node(id) else {
                continue;
            };
            stack.extend(terms.iter().map(|(_, term)| *term));
            if terms.len() > LONG && !sums.0.contains_key(&id) {
                let of_sum = sums.0.entry(id).or_default();
                for (c, term) in terms {
                    for symbol in g.support(*term) {
                        of_sum.entry(symbol).or_default().push((*c, *term));
                    }
                }
            }
        }
        sums
    }

    /// The terms of the sum `id` that depend on `symbol`, if it was entered.
    fn terms(&self, id: Id, seed: Seed) -> Option<&[(Num, Id)]> {
        let (Seed::Partial(symbol), Some(sum)) = (seed, self.0.get(&id)) else {
            return None;
        };
        Some(sum.get(&symbol).map_or(&[], Vec::as_slice))
    }
}

/// Partial derivatives of a value by all the coordinates and velocities it depends on.
pub struct Gradient {
    of: Id,
    sums: Rc<Sums>,
    symbols: BTreeSet<Symbol>,
}

impl Gradient {
    pub fn of(id: Id, g: &Graph) -> Self {
        Gradient {
            of: id,
            sums: Rc::new(Sums::of(id, g)),
            symbols: g.support(id),
        }
    }

    /// What the value depends on.
    pub fn symbols(&self) -> impl Iterator<Item = Symbol> {
        self.symbols.iter().copied()
    }

    /// ∂/∂symbol.
    pub fn along(&self, symbol: Symbol, g: &mut Graph) -> Id {
        self.by(&mut Derivative::partial(symbol), g)
    }

    /// The derivative of the value by `derivative`, which is kept for others.
    pub fn by(&self, derivative: &mut Derivative, g: &mut Graph) -> Id {
        match derivative.seed {
            Seed::Partial(symbol) if !self.symbols.contains(&symbol) => g.zero(),
            _ => {
                derivative.sums = self.sums.clone();
                derivative.of(self.of, g)
            }
        }
    }
}

/// Partial derivatives of a value by all that it depends on, in one sweep from the value down: for a few times the cost of the value.
pub struct Adjoint(BTreeMap<Symbol, Id>);

impl Adjoint {
    /// The derivatives of `id` by coordinates and velocities.
    pub fn of(id: Id, g: &mut Graph) -> Self {
        let mut adjoint = Adjoint(BTreeMap::new());
        // What each node adds to the value, per unit.
        let mut slopes: Map<Id, Vec<(f64, Id)>> = Map::default();
        let one = g.one();
        slopes.insert(id, vec![(1.0, one)]);
        for id in g.reachable(&[id]).into_iter().rev() {
            let moving = |id: Id, g: &Graph| g.uses(id).coord || g.uses(id).velocity;
            let Some(terms) = slopes.remove(&id).filter(|_| moving(id, g)) else {
                continue;
            };
            let slope = g.sum(&terms);
            if let Node::Symbol(symbol) = *g.node(id) {
                adjoint.0.insert(symbol, slope);
                continue;
            }
            for (operand, k, value) in locals(id, g) {
                if moving(operand, g) {
                    let term = g.mul(slope, value);
                    slopes.entry(operand).or_default().push((k, term));
                }
            }
        }
        adjoint
    }

    /// ∂/∂symbol, if it is not zero.
    pub fn along(&self, symbol: Symbol) -> Option<Id> {
        self.0.get(&symbol).copied()
    }
}

/// The derivatives of a node by its operands: each a number of times a value.
fn locals(id: Id, g: &mut Graph) -> Vec<(Id, f64, Id)> {
    let (one, zero) = (g.one(), g.zero());
    match g.node(id).clone() {
        Node::Const(_) | Node::Symbol(_) => Vec::new(),
        Node::Sum(_, terms) => {
            let terms = terms.into_iter();
            terms.map(|(k, term)| (term, k.get(), one)).collect()
        }
        Node::Scale(k, inner) => vec![(inner, k.get(), one)],
        Node::Held(inner) => vec![(inner, 1.0, one)],
        Node::Product(factors) => {
            let without = |k: usize| {
                let mut rest = factors.clone();
                rest[k].1 -= 1;
                rest
            };
            let locals = factors.iter().enumerate().map(|(k, (base, exponent))| {
                let rest = g.product(&without(k));
                (*base, f64::from(*exponent), rest)
            });
            locals.collect()
        }
        Node::Call(func, args) => match (&func.row().form, &args[..]) {
            (Form::One { slope, .. }, [u]) => vec![(*u, 1.0, slope(g, *u, id))],
            (Form::Two { derivative, .. }, [u, w]) => {
                let by_u = derivative(g, (*u, one), (*w, zero), id);
                let by_w = derivative(g, (*u, zero), (*w, one), id);
                vec![(*u, 1.0, by_u), (*w, 1.0, by_w)]
            }
            _ => Vec::new(),
        },
        Node::Select([a, b, then, otherwise]) => {
            let (first, second) = (g.select(a, b, one, zero), g.select(a, b, zero, one));
            vec![(then, 1.0, first), (otherwise, 1.0, second)]
        }
    }
}

#[derive(Clone, Copy)]
enum Seed {
    /// ∂/∂symbol.
    Partial(Symbol),
    /// d/dt with q → q̇, t → 1 and q̇ fixed: the total derivative without its q̈ terms.
    Total,
    /// Nothing but what was entered has a derivative.
    Entered,
}

impl Derivative {
    fn new(seed: Seed) -> Self {
        Derivative {
            seed,
            known: Map::default(),
            sums: Rc::default(),
        }
    }

    /// Along a direction: of each of these symbols the given one.
    pub fn along(direction: Vec<(Id, Id)>) -> Self {
        let mut derivative = Derivative::new(Seed::Entered);
        derivative.known.extend(direction);
        derivative
    }

    /// ∂/∂symbol.
    pub fn partial(symbol: Symbol) -> Self {
        Derivative::new(Seed::Partial(symbol))
    }

    /// d/dt at q̈ = 0 (q → q̇, q̇ → 0, t → 1). Of φ(q, t) this is φ̇ itself; of φ̇ it is φ̈ without A q̈.
    pub fn total() -> Self {
        Derivative::new(Seed::Total)
    }

    fn of_symbol(&self, symbol: Symbol, g: &mut Graph) -> Id {
        match (self.seed, symbol) {
            (Seed::Partial(s), _) if s == symbol => g.one(),
            (Seed::Total, Symbol::Coord(i)) => g.symbol(Symbol::Velocity(i)),
            (Seed::Total, Symbol::Time) => g.one(),
            _ => g.zero(),
        }
    }

    /// Whether the derivative of `id` is zero because nothing below can depend on the symbol.
    fn blind(&self, id: Id, g: &Graph) -> bool {
        let uses = g.uses(id);
        match self.seed {
            Seed::Partial(Symbol::Coord(_)) => !uses.coord,
            Seed::Partial(Symbol::Velocity(_)) => !uses.velocity,
            Seed::Partial(Symbol::Time) => !uses.time,
            Seed::Partial(Symbol::Param(_) | Symbol::Prepared(_)) => !uses.param,
            Seed::Partial(Symbol::Residual(_)) => !uses.residual,
            Seed::Partial(Symbol::Branch(_)) => !uses.branch,
            Seed::Partial(Symbol::Multiplier(_)) => !uses.multiplier,
            Seed::Total => !(uses.coord || uses.time),
            Seed::Entered => !uses.coord,
        }
    }

    /// The derivative of `id`.
    pub fn of(&mut self, id: Id, g: &mut Graph) -> Id {
        if let Some(known) = self.known(id, g) {
            return known;
        }
        // Operands before their users, without recursion: a chain of values can be long.
        let mut needed = vec![id];
        let mut seen = HashSet::from([id]);
        let mut at = 0;
        while let Some(next) = needed.get(at) {
            let operands = match self.sums.terms(*next, self.seed) {
                Some(terms) => terms.iter().map(|(_, term)| *term).collect(),
                None => g.operands(*next),
            };
            for operand in operands {
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
            Node::Sum(_, mut terms) => {
                if let Some(those) = self.sums.terms(id, self.seed) {
                    terms = those.to_vec();
                }
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
            Node::Select([a, b, then, otherwise]) => {
                let then = self.of(then, g);
                let otherwise = self.of(otherwise, g);
                g.select(a, b, then, otherwise)
            }
        }
    }

    fn of_call(&mut self, func: Func, args: &[Id], value: Id, g: &mut Graph) -> Id {
        let derived: Vec<Id> = args.iter().map(|arg| self.of(*arg, g)).collect();
        if derived.iter().all(|d| g.is_zero(*d)) {
            return g.zero();
        }
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
