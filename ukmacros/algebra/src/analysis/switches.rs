//! Switching functions: where abs, sign, min and max change their branch.
//!
//! abs(u) and sign(u) turn where u changes its sign, min(a, b), max(a, b) and their derivatives where a − b does. Each such g that the
//! equations of motion depend on is a switch. An integrator may hold it in one branch: the emitted code then goes on smoothly across g =
//! 0. Functions that turn at the zeros of one g, of −g or of a multiple of it by a number have one switch.
//!
//! A length that the equations divide by, as in v/|v|, is a switch too: the direction of the vector turns where it vanishes. It does not
//! change its sign there, so no branch of it is held; a run that stays about its zero is told of it.

use super::dynamics::Dynamics;
use super::structure::vanishes_at_rest;
use crate::expr::{Func, Graph, Id, Map, Node, Num, Symbol, System, is_power_of_two};
use std::collections::HashSet;

/// A constant up to this under the root of a length keeps it from zero by less than errors of velocities are.
const TINY: f64 = 1e-20;

/// A switch.
#[derive(Clone)]
pub struct Switch {
    /// g.
    pub function: Id,
    /// The terms of the equations of motion that turn at its zeros, in words.
    pub terms: Vec<String>,
    /// Whether the function is a length, which reaches zero and does not change its sign.
    pub length: bool,
    /// Whether the function is zero wherever nothing moves.
    pub at_rest: bool,
}

/// What decides the branch of a node: the sign of `sign` · g.
#[derive(Clone, Copy)]
struct Decision {
    function: Id,
    sign: f64,
}

/// Finds the switches and makes the equations depend on the branches held, [`Symbol::Branch`]; energies stay as they are. `names` are
/// those of the coordinates, then of the constraints. Without a switch the equations are returned as they are. The switches come as they
/// are declared, and as they are where branches are held: a function that depends on the sign of another goes on smoothly at its zero.
pub(super) fn hold(
    system: &mut System,
    dynamics: &Dynamics,
    names: &[String],
) -> (Dynamics, [Vec<Switch>; 2]) {
    let g = &mut system.graph;
    let mut held = dynamics.clone();
    let roots: Vec<Id> = held.equations_mut().map(|id| *id).collect();
    let turns = |id: &Id| branches(g.node(*id)).is_some() || !lengths_below(*id, g).is_empty();
    let order = g.reachable(&roots);
    if !order.iter().any(turns) {
        return (held, [Vec::new(), Vec::new()]);
    }
    let mut switches = Found::default();
    let mut lengths = Found::default();
    for (term, root) in terms(dynamics, names) {
        for id in g.reachable(&[root]) {
            if let Some(Decision { function, .. }) = decision(id, g) {
                switches.add(function, &term, false);
            }
            for function in lengths_below(id, g) {
                lengths.add(function, &term, true);
            }
        }
    }
    let Found { numbers, mut list } = switches;
    for switch in &mut list {
        switch.at_rest = vanishes_at_rest(switch.function, g);
    }
    if list.is_empty() {
        return (held, [lengths.list.clone(), lengths.list]);
    }
    let mut pass = Pass {
        numbers,
        values: Map::default(),
        branches: Map::default(),
    };
    let known = g.rewritten(&order, |g, id, known| pass.rewrite(id, known, g));
    for id in held.equations_mut() {
        *id = known[id];
    }
    system.carry_names(&known);
    let switches: Vec<Switch> = list.into_iter().chain(lengths.list).collect();
    let located = switches.iter().map(|switch| Switch {
        function: *pass
            .values
            .get(&switch.function)
            .unwrap_or(&switch.function),
        ..switch.clone()
    });
    let located = located.collect();
    (held, [switches, located])
}

/// Switches with their terms, and their positions by their functions.
#[derive(Default)]
struct Found {
    list: Vec<Switch>,
    numbers: Map<Id, usize>,
}

impl Found {
    fn add(&mut self, function: Id, term: &str, length: bool) {
        let k = *self.numbers.entry(function).or_insert(self.list.len());
        if k == self.list.len() {
            let terms = Vec::new();
            self.list.push(Switch {
                function,
                terms,
                length,
                at_rest: false,
            });
        }
        let known = &mut self.list[k].terms;
        if !known.iter().any(|t| t == term) {
            known.push(term.to_owned());
        }
    }
}

/// The lengths of vectors of velocities that the node `id` divides by.
fn lengths_below(id: Id, g: &Graph) -> Vec<Id> {
    let Node::Product(factors) = g.node(id) else {
        return Vec::new();
    };
    let below = factors.iter().filter(|(_, power)| *power < 0);
    let lengths = below.filter(|(factor, _)| {
        g.uses(*factor).velocity
            && match g.node(*factor) {
                Node::Call(Func::Hypot, _) => true,
                // With a constant in it, it does not vanish.
                Node::Call(Func::Sqrt, args) => {
                    !matches!(g.node(args[0]), Node::Sum(constant, _) if constant.get() > TINY)
                }
                _ => false,
            }
    });
    lengths.map(|(factor, _)| *factor).collect()
}

/// Everything that M, Q, c, A and b consist of, with the words for it.
fn terms(d: &Dynamics, names: &[String]) -> Vec<(String, Id)> {
    let n = d.force.len();
    let force = (0..).zip(&d.force).map(|(i, id)| ("force on", i, id));
    let nonideal = (0..).zip(&d.nonideal);
    let nonideal = nonideal.map(|(i, id)| ("non-ideal force on", i, id));
    let mass = d.mass.iter().map(|((i, _), id)| ("mass on", *i, id));
    let rhs = (n..).zip(&d.rhs).map(|(row, id)| ("constraint", row, id));
    let jacobian = d.jacobian.iter();
    let jacobian = jacobian.map(|((row, _), id)| ("constraint", n + row, id));
    let all = force.chain(nonideal).chain(mass).chain(rhs).chain(jacobian);
    let named = all.map(|(what, at, id)| (format!("{what} `{}`", names[at]), *id));
    let mut seen = HashSet::new();
    named.filter(|term| seen.insert(term.clone())).collect()
}

/// What is compared where a node has branches: a number with zero, or with another one.
fn branches(node: &Node) -> Option<(Id, Option<Id>)> {
    match *node {
        Node::Call(Func::Abs | Func::Sign, ref args) => Some((args[0], None)),
        Node::Call(Func::Min | Func::Max, ref args) => Some((args[0], Some(args[1]))),
        Node::Select([a, b, ..]) => Some((a, Some(b))),
        _ => None,
    }
}

/// What decides the branch of the node `id`, if it has branches and they vary along a motion.
fn decision(id: Id, g: &mut Graph) -> Option<Decision> {
    let (a, b) = branches(g.node(id))?;
    let mut terms = g.open(1.0, a);
    if let Some(b) = b {
        terms.extend(g.open(-1.0, b));
    }
    let difference = g.sum(&terms);
    if g.uses(difference).constant() {
        return None;
    }
    let (c, mut function) = g.unscaled(difference);
    let mut sign = c.signum();
    // A sum with a constant keeps its coefficients: 1 − 2 x is x − 1/2 from the other side.
    if let Node::Sum(constant, terms) = g.node(function).clone()
        && let Some((first, _)) = terms.first()
        && is_power_of_two(first.get().abs())
    {
        let divide = |k: Num| k.get() / first.get();
        let mut divided: Vec<(f64, Id)> =
            terms.iter().map(|(k, term)| (divide(*k), *term)).collect();
        divided.push((divide(constant), g.one()));
        function = g.sum(&divided);
        sign *= first.get().signum();
    }
    Some(Decision { function, sign })
}

struct Pass {
    /// Positions of the switches by their functions.
    numbers: Map<Id, usize>,
    /// Each g where branches are held.
    values: Map<Id, Id>,
    /// What stands for g in decisions: the branch where one is held.
    branches: Map<Id, Id>,
}

impl Pass {
    /// What becomes of a node with branches, where its operands are `known`; nothing of others.
    fn rewrite(&mut self, id: Id, known: &Map<Id, Id>, g: &mut Graph) -> Option<Id> {
        let decision = decision(id, g).filter(|d| self.numbers.contains_key(&d.function));
        let Decision { function, sign } = decision?;
        let branch = self.branch(function, known, g);
        let zero = g.zero();
        // u ≤ 0 where low ≤ high, for u = sign · g.
        let (low, high) = match sign > 0.0 {
            true => (branch, zero),
            false => (zero, branch),
        };
        Some(match g.node(id).clone() {
            Node::Call(Func::Sign, _) => {
                let value = g.call1(Func::Sign, branch);
                g.scale(sign, value)
            }
            Node::Call(Func::Abs, args) => {
                let u = known[&args[0]];
                let negative = g.neg(u);
                g.select(high, low, u, negative)
            }
            Node::Call(func, args) => {
                let (a, b) = (known[&args[0]], known[&args[1]]);
                match func {
                    Func::Min => g.select(low, high, a, b),
                    _ => g.select(low, high, b, a),
                }
            }
            Node::Select([.., then, otherwise]) => {
                let (then, otherwise) = (known[&then], known[&otherwise]);
                g.select(low, high, then, otherwise)
            }
            _ => id,
        })
    }

    fn branch(&mut self, function: Id, known: &Map<Id, Id>, g: &mut Graph) -> Id {
        if let Some(branch) = self.branches.get(&function) {
            return *branch;
        }
        // A difference a − b may be no part of the equations, but what it consists of is.
        let value = match known.get(&function) {
            Some(value) => *value,
            None => g.with_operands(function, |_, operand| known[&operand]),
        };
        self.values.insert(function, value);
        let held = g.symbol(Symbol::Branch(self.numbers[&function]));
        let branch = g.call2(Func::Branch, value, held);
        self.branches.insert(function, branch);
        branch
    }
}
