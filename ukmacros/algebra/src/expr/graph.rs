//! Hash-consed arena of expressions.
//!
//! Invariants, kept by the constructors in `fold`:
//! - operands stand before their users, so ascending ids are a topological order;
//! - terms and factors are sorted by id, each id once: `a + b` and `b + a` are one node;
//! - a constant is only ever a [`Node::Const`], a sum's constant or a coefficient; [`Node::Scale`] is never nested and never 0 or 1;
//! - a sum without constant starts with a positive coefficient, and its coefficients are neither all of one magnitude other than 1
//!   nor all integer multiples of a power of two above 1 among them (the common factor is a [`Node::Scale`] around it), so `a − b` and `b −
//!   a` share their node;
//! - a product has no product or scale among its factors. A sum may have a sum among its terms: parentheses are kept,
//!   since regrouping a sum changes its rounding.

use super::functions::{Cost, Func};
use std::collections::{BTreeSet, HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};

/// A map whose hashes cost little where the compiler is not optimised, as macros are not.
pub type Map<K, V> = HashMap<K, V, BuildHasherDefault<Hash>>;
/// A set of the same kind.
pub type Set<K> = HashSet<K, BuildHasherDefault<Hash>>;

/// Multiplies and rotates; keys are not chosen by an adversary.
#[derive(Default)]
pub struct Hash(u64);

impl Hasher for Hash {
    fn finish(&self) -> u64 {
        self.0.rotate_left(26)
    }
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|b| self.write_u64(u64::from(*b)));
    }
    fn write_u32(&mut self, x: u32) {
        self.write_u64(u64::from(x));
    }
    fn write_u64(&mut self, x: u64) {
        self.0 = (self.0.rotate_left(5) ^ x).wrapping_mul(0xF135_7AEA_2E62_A9C5);
    }
    fn write_usize(&mut self, x: usize) {
        self.write_u64(x as u64);
    }
}

/// A node's place in the arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Id(u32);

impl Id {
    fn at(index: usize) -> Self {
        Id(u32::try_from(index).unwrap_or(u32::MAX))
    }
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An `f64` compared by its bits (−0 is stored as 0).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Num(u64);

impl Num {
    pub fn new(x: f64) -> Self {
        Num((x + 0.0).to_bits())
    }
    pub fn get(self) -> f64 {
        f64::from_bits(self.0)
    }
}

/// A quantity that is given at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Symbol {
    /// A parameter, by its position.
    Param(usize),
    /// A coordinate q, by its position.
    Coord(usize),
    /// The velocity q̇ of a coordinate, by its position.
    Velocity(usize),
    /// Time t.
    Time,
    /// Residual of a constraint, by its position.
    Residual(usize),
    /// A value that depends on parameters only, by its position among the prepared ones.
    Prepared(usize),
    /// The branch that a switch is held in, by the switch's position: its sign ±1, or 0 where none is held.
    Branch(usize),
    /// The multiplier of a constraint by its position, as ideal constraint forces have it, until what it is solved to stands in its place.
    Multiplier(usize),
}

/// A node.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    Const(Num),
    Symbol(Symbol),
    /// constant + Σ coefficient · term.
    Sum(Num, Vec<(Num, Id)>),
    /// coefficient · node.
    Scale(Num, Id),
    /// Π factor^exponent, exponents not zero.
    Product(Vec<(Id, i32)>),
    Call(Func, Vec<Id>),
    /// The node itself, kept whole: products do not open it, so that it is computed once for all its users.
    Held(Id),
    /// One of four operands [a, b, c, d]: c where a ≤ b, else d.
    Select([Id; 4]),
}

/// What a node depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Uses {
    pub param: bool,
    pub coord: bool,
    pub velocity: bool,
    pub time: bool,
    pub residual: bool,
    pub branch: bool,
    pub multiplier: bool,
}

impl Uses {
    fn join(self, o: Uses) -> Uses {
        Uses {
            param: self.param | o.param,
            coord: self.coord | o.coord,
            velocity: self.velocity | o.velocity,
            time: self.time | o.time,
            residual: self.residual | o.residual,
            branch: self.branch | o.branch,
            multiplier: self.multiplier | o.multiplier,
        }
    }

    /// Whether the value depends neither on q, q̇ nor t: it is fixed once the parameters are.
    pub fn constant(self) -> bool {
        let along = self.coord || self.velocity || self.time || self.multiplier;
        !(along || self.residual || self.branch)
    }

    /// t, and else nothing but parameters.
    pub fn only_time(self) -> bool {
        let others = Uses {
            time: false,
            ..self
        };
        self.time && others.constant()
    }
}

/// The arena.
#[derive(Clone, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    uses: Vec<Uses>,
    /// Estimated latency of each node, in cycles: its place on the critical path.
    latency: Vec<u32>,
    /// The last node that has a hash, by the hash: nodes stand in the arena alone, which is often copied.
    known: Map<u64, Id>,
    /// The node before each node with the same hash.
    alike: Vec<Option<Id>>,
}

impl Graph {
    /// Number of nodes.
    pub fn size(&self) -> usize {
        self.nodes.len()
    }

    /// The nodes from number `first` on.
    pub fn nodes_from(&self, first: usize) -> &[Node] {
        &self.nodes[first..]
    }

    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id.index()]
    }

    pub fn uses(&self, id: Id) -> Uses {
        self.uses[id.index()]
    }

    /// Estimated cycles until `id` is known.
    pub fn latency(&self, id: Id) -> u32 {
        self.latency[id.index()]
    }

    /// Coordinates and velocities that `id` depends on.
    pub fn support(&self, id: Id) -> BTreeSet<Symbol> {
        let moving = |id: &Id| self.uses(*id).coord || self.uses(*id).velocity;
        let mut stack: Vec<Id> = [id].into_iter().filter(moving).collect();
        let (mut seen, mut found) = (Set::default(), BTreeSet::new());
        while let Some(id) = stack.pop() {
            match *self.node(id) {
                Node::Symbol(symbol) => drop(found.insert(symbol)),
                _ if seen.insert(id) => self.each_operand(id, |operand| {
                    if moving(&operand) {
                        stack.push(operand);
                    }
                }),
                _ => {}
            }
        }
        found
    }

    /// The node itself if it is known, else a new one. Only `fold` calls this: it keeps the invariants.
    pub(super) fn intern(&mut self, node: Node) -> Id {
        let hash = hashed(&node);
        if let Some(id) = self.find(hash, &node) {
            return id;
        }
        let id = Id::at(self.nodes.len());
        let (mut slowest, mut uses) = (0, Uses::default());
        each_operand(&node, |operand| {
            slowest = slowest.max(self.latency[operand.index()]);
            uses = uses.join(self.uses[operand.index()]);
        });
        self.latency.push(slowest + own_latency(&node));
        if let Node::Symbol(s) = node {
            match s {
                Symbol::Param(_) | Symbol::Prepared(_) => uses.param = true,
                Symbol::Coord(_) => uses.coord = true,
                Symbol::Velocity(_) => uses.velocity = true,
                Symbol::Time => uses.time = true,
                Symbol::Residual(_) => uses.residual = true,
                Symbol::Branch(_) => uses.branch = true,
                Symbol::Multiplier(_) => uses.multiplier = true,
            }
        }
        self.nodes.push(node);
        self.uses.push(uses);
        self.alike.push(self.known.insert(hash, id));
        id
    }

    /// The `node` of this hash, if it is known.
    fn find(&self, hash: u64, node: &Node) -> Option<Id> {
        let mut next = self.known.get(&hash).copied();
        while let Some(id) = next.filter(|id| self.node(*id) != node) {
            next = self.alike[id.index()];
        }
        next
    }

    /// The value if `id` is a constant.
    pub fn as_const(&self, id: Id) -> Option<f64> {
        match self.node(id) {
            Node::Const(x) => Some(x.get()),
            _ => None,
        }
    }

    pub fn is_zero(&self, id: Id) -> bool {
        self.as_const(id) == Some(0.0)
    }

    /// `id` without its coefficient.
    pub fn unscaled(&self, id: Id) -> (f64, Id) {
        match self.node(id) {
            Node::Scale(c, inner) => (c.get(), *inner),
            _ => (1.0, id),
        }
    }

    /// The node `func(arg)`, if there is one.
    pub fn find_call(&self, func: Func, arg: Id) -> Option<Id> {
        let call = Node::Call(func, vec![arg]);
        self.find(hashed(&call), &call)
    }

    /// Factors of `id` without its coefficient: itself where it is no product.
    pub fn factors(&self, id: Id) -> Vec<(Id, i32)> {
        let (_, inner) = self.unscaled(id);
        match self.node(inner) {
            Node::Product(factors) => factors.clone(),
            _ => vec![(inner, 1)],
        }
    }

    /// The nodes that `roots` are made of, themselves included, operands before users.
    pub fn reachable(&self, roots: &[Id]) -> Vec<Id> {
        let mut index = roots.iter().map(|r| r.index() + 1).max().unwrap_or(0);
        let mut wanted = vec![false; index];
        roots.iter().for_each(|root| wanted[root.index()] = true);
        // From the last down, so that there is nothing to be sorted; by a plain loop, which is quick where the compiler is not optimised.
        let mut found = Vec::new();
        while index > 0 {
            index -= 1;
            if wanted[index] {
                let id = Id::at(index);
                self.each_operand(id, |operand| wanted[operand.index()] = true);
                found.push(id);
            }
        }
        found.reverse();
        found
    }

    /// `id` if it is `known`, else its known factors: a product of it with others has been taken apart.
    pub fn open_products(&self, id: Id, known: impl Fn(Id) -> bool) -> Vec<Id> {
        let (mut found, mut stack) = (Vec::new(), vec![id]);
        while let Some(id) = stack.pop() {
            match self.node(id) {
                _ if known(id) => found.push(id),
                Node::Scale(..) | Node::Product(_) | Node::Held(_) => {
                    stack.extend(self.operands(id));
                }
                _ => {}
            }
        }
        found
    }

    /// Operands of `id`.
    pub fn operands(&self, id: Id) -> Vec<Id> {
        let mut operands = Vec::new();
        self.each_operand(id, |operand| operands.push(operand));
        operands
    }

    /// Calls `take` with each operand of `id`.
    pub fn each_operand(&self, id: Id, take: impl FnMut(Id)) {
        each_operand(self.node(id), take);
    }
}

fn hashed(node: &Node) -> u64 {
    let mut hash = Hash::default();
    std::hash::Hash::hash(node, &mut hash);
    hash.finish()
}

/// Cycles of the last operations of a node, roughly as on current processors; only comparisons matter.
fn own_latency(node: &Node) -> u32 {
    match node {
        Node::Const(_) | Node::Symbol(_) | Node::Held(_) => 0,
        Node::Sum(..) | Node::Scale(..) => 4,
        Node::Product(factors) if factors.iter().any(|(_, e)| *e < 0) => 18,
        Node::Product(_) => 4,
        Node::Select(_) => 4,
        Node::Call(func, _) => match func.row().cost {
            Cost::Selection => 4,
            Cost::SquareRoot => 18,
            Cost::Transcendental => 50,
        },
    }
}

fn each_operand(node: &Node, mut take: impl FnMut(Id)) {
    match node {
        Node::Const(_) | Node::Symbol(_) => {}
        Node::Sum(_, terms) => terms.iter().for_each(|(_, id)| take(*id)),
        Node::Scale(_, inner) | Node::Held(inner) => take(*inner),
        Node::Product(factors) => factors.iter().for_each(|(id, _)| take(*id)),
        Node::Call(_, args) => args.iter().for_each(|id| take(*id)),
        Node::Select(args) => args.iter().for_each(|id| take(*id)),
    }
}
