//! Velocities y that the kinetic energy is written in, as unknowns of the elimination.
//!
//! Where T is a sum of ½ D_ab y_a y_b, with y linear in q̇ and each given by others before it (the velocity of a link by that of the link
//! it hangs on), M = Yᵀ D Y need not be expanded: with w = Y q̈, M q̈ = Q + Aᵀλ is the system
//!
//! ```text
//! ⎡ 0   0   Y₀ᵀ  Aᵀ⎤ ⎡ q̈⎤   ⎡Q⎤
//! ⎢ 0   D   Lᵀ   0 ⎥ ⎢ w⎥ = ⎢0⎥      Y₀ q̈ + L w = 0 are the definitions, w_k with the coefficient −1 in its own
//! ⎢ Y₀  L   0    0 ⎥ ⎢ ·⎥   ⎢0⎥
//! ⎣ A   0   0    0 ⎦ ⎣−λ⎦   ⎣b⎦
//! ```
//!
//! which is as sparse as the declaration. Each w is eliminated with its definition, leaf first: for links in a tree that is the recursion
//! over articulated bodies. The same with no other pivots leaves M, as sums of composite inertias.

use super::dynamics::Dynamics;
use crate::expr::{Derivative, Graph, Id, Node, Symbol};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// An unknown of the lifted system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Unknown {
    /// q̇_i.
    Coordinate(usize),
    /// The y that is this sum.
    Velocity(Id),
}

/// The kinetic energy T = ½ Σ D_ab u_a u_b in unknowns u, and the equations of motion in them.
#[derive(Clone)]
pub struct Lift {
    /// What each y is the sum of: y_l = Σ c_lk u_k.
    definitions: BTreeMap<Id, BTreeMap<Unknown, Id>>,
    /// Lower triangle of D, as far as it is not zero: (later, earlier).
    inertia: BTreeMap<(Unknown, Unknown), Id>,
    /// The generalised forces on the unknowns: what T contributes to the right-hand side of M q̈ = Q, before it is carried over to q̇.
    force: BTreeMap<Unknown, Id>,
    /// Q without that, per coordinate.
    pub(super) applied: Vec<Id>,
}

/// The kinetic energy in the velocities it is written in, without other forces; nothing if it is written in q̇ alone, or is no sum of
/// products of such velocities.
pub(super) fn lift(kinetic: Id, g: &mut Graph) -> Option<Lift> {
    let degrees = degrees(kinetic, g);
    let degree = |id: Id| degrees.get(&id).copied().unwrap_or(0);
    if degree(kinetic) != 2 {
        return None;
    }
    let mut inertia: Terms<(Unknown, Unknown)> = Terms::new();
    let mut open = vec![(g.one(), kinetic)];
    while let Some((weight, id)) = open.pop() {
        match g.node(id).clone() {
            // With terms of lower degree T is not a sum of squares.
            _ if degree(id) < 2 => return None,
            Node::Sum(_, terms) => {
                let terms = terms.into_iter();
                open.extend(terms.map(|(k, term)| (g.scale(k.get(), weight), term)));
            }
            Node::Scale(c, inner) => open.push((g.scale(c.get(), weight), inner)),
            Node::Held(inner) => open.push((weight, inner)),
            Node::Product(factors) => {
                let (moving, weight) = moving(factors, weight, g);
                let (one, other) = match moving[..] {
                    [(quadratic, 1)] => {
                        open.push((weight, quadratic));
                        continue;
                    }
                    [(one, 2)] => (one, one),
                    [(one, 1), (other, 1)] => (one, other),
                    _ => return None,
                };
                let ((a, x), (b, y)) = (unknown(one, g)?, unknown(other, g)?);
                let term = g.product(&[(weight, 1), (a, 1), (b, 1)]);
                let both = if x == y { 2.0 } else { 1.0 };
                let entry = inertia.entry((x.max(y), x.min(y))).or_default();
                entry.push((both, term));
            }
            _ => return None,
        }
    }
    let mut definitions = BTreeMap::new();
    let mut open: Vec<Unknown> = inertia.keys().flat_map(|(a, b)| [*a, *b]).collect();
    while let Some(next) = open.pop() {
        let Unknown::Velocity(id) = next else {
            continue;
        };
        if let Entry::Vacant(entry) = definitions.entry(id) {
            let definition = entry.insert(definition(id, g)?);
            open.extend(definition.keys());
        }
    }
    let inertia = summed(inertia, g);
    if definitions.is_empty() {
        return None;
    }
    let mut lift = Lift {
        definitions,
        inertia,
        force: BTreeMap::new(),
        applied: Vec::new(),
    };
    lift.force = lift.forces(g);
    Some(lift)
}

/// Degrees in q̇ of what `root` is made of, as far as it is a polynomial of at most second degree; 3 for all else.
fn degrees(root: Id, g: &Graph) -> HashMap<Id, u32> {
    let mut degrees: HashMap<Id, u32> = HashMap::new();
    for id in g.reachable(&[root]) {
        if !g.uses(id).velocity {
            continue;
        }
        let of = |id: &Id| degrees.get(id).copied().unwrap_or(0);
        let degree = match g.node(id) {
            Node::Symbol(_) => 1,
            Node::Sum(_, terms) => terms.iter().map(|(_, t)| of(t)).max().unwrap_or(0),
            Node::Scale(_, inner) | Node::Held(inner) => of(inner),
            Node::Product(factors) => {
                let of = |(f, e): &(Id, i32)| match (of(f), u32::try_from(*e)) {
                    (0, _) => 0,
                    (degree, Ok(e)) => degree.saturating_mul(e),
                    _ => 3,
                };
                factors.iter().map(of).sum()
            }
            _ => 3,
        };
        degrees.insert(id, degree.min(3));
    }
    degrees
}

/// The factors that contain velocities, and the product of the others with `weight`.
fn moving(factors: Vec<(Id, i32)>, weight: Id, g: &mut Graph) -> (Vec<(Id, i32)>, Id) {
    let moves = |(f, _): &(Id, i32)| g.uses(*f).velocity;
    let (moving, mut rest): (Vec<_>, Vec<_>) = factors.into_iter().partition(moves);
    rest.push((weight, 1));
    (moving, g.product(&rest))
}

/// `id`, linear in q̇, as a multiple of an unknown; nothing if it is linear by anything else than arithmetic.
fn unknown(id: Id, g: &mut Graph) -> Option<(Id, Unknown)> {
    let (mut factor, mut id) = (g.one(), id);
    loop {
        match g.node(id).clone() {
            Node::Symbol(Symbol::Velocity(i)) => return Some((factor, Unknown::Coordinate(i))),
            Node::Sum(..) => return Some((factor, Unknown::Velocity(id))),
            Node::Scale(c, inner) => (factor, id) = (g.scale(c.get(), factor), inner),
            Node::Held(inner) => id = inner,
            Node::Product(factors) => {
                let (moving, rest) = moving(factors, factor, g);
                let [(inner, 1)] = moving[..] else {
                    return None;
                };
                (factor, id) = (rest, inner);
            }
            _ => return None,
        }
    }
}

/// What the sum `id` gives as multiples of unknowns; nothing if it contains anything else.
fn definition(id: Id, g: &mut Graph) -> Option<BTreeMap<Unknown, Id>> {
    let Node::Sum(rest, terms) = g.node(id).clone() else {
        return None;
    };
    if rest.get() != 0.0 {
        return None;
    }
    let mut definition: Terms<Unknown> = Terms::new();
    for (k, term) in terms {
        let (factor, unknown) = unknown(term, g)?;
        definition
            .entry(unknown)
            .or_default()
            .push((k.get(), factor));
    }
    Some(summed(definition, g))
}

/// The sums that are not zero.
fn summed<K: Ord>(terms: Terms<K>, g: &mut Graph) -> BTreeMap<K, Id> {
    let terms = terms.into_iter();
    let mut sums: BTreeMap<K, Id> = terms
        .map(|(at, terms)| (at, g.factored_sum(&terms)))
        .collect();
    sums.retain(|_, sum| !g.is_zero(*sum));
    sums
}

/// Terms of a sum for each unknown, or for what else there is a sum of.
type Terms<K> = BTreeMap<K, Vec<(f64, Id)>>;

impl Unknown {
    fn value(self, g: &mut Graph) -> Id {
        match self {
            Unknown::Coordinate(i) => g.symbol(Symbol::Velocity(i)),
            Unknown::Velocity(id) => id,
        }
    }
}

impl Lift {
    /// The y, each after those that give it.
    pub fn velocities(&self) -> impl Iterator<Item = Id> {
        self.definitions.keys().copied()
    }

    /// What each y is the sum of, in that order, if that is coordinates alone.
    pub(super) fn of_coordinates(&self) -> Vec<Option<BTreeMap<usize, Id>>> {
        let entry = |(of, c): (&Unknown, &Id)| match of {
            Unknown::Coordinate(i) => Some((*i, *c)),
            Unknown::Velocity(_) => None,
        };
        let definitions = self.definitions.values();
        definitions.map(|d| d.iter().map(entry).collect()).collect()
    }

    /// The y that are but a part of one other, as they stand or times a number: what a declaration has in parentheses.
    pub(super) fn parts(&self, g: &Graph) -> BTreeSet<Id> {
        let heavy: BTreeSet<Unknown> = self.inertia.keys().flat_map(|(a, b)| [*a, *b]).collect();
        let mut uses: BTreeMap<Id, Vec<Id>> = BTreeMap::new();
        for (of, c) in self.definitions.values().flatten() {
            if let Unknown::Velocity(id) = of {
                uses.entry(*id).or_default().push(*c);
            }
        }
        uses.retain(|id, uses| {
            let once = matches!(uses[..], [c] if g.as_const(c).is_some());
            once && !heavy.contains(&Unknown::Velocity(*id))
        });
        uses.into_keys().collect()
    }

    /// The lift in which the y that are `wanted` have, in the place of parts, what these are the sums of; nothing if they have no parts.
    pub(super) fn opened(&self, wanted: impl Fn(Id) -> bool, g: &mut Graph) -> Option<Lift> {
        let (parts, mut lift) = (self.parts(g), self.clone());
        for (id, definition) in &self.definitions {
            if parts.contains(id) || !wanted(*id) {
                continue;
            }
            let mut terms: Terms<Unknown> = Terms::new();
            let mut open = vec![(1.0, definition)];
            while let Some((factor, definition)) = open.pop() {
                for (of, c) in definition {
                    let part = match of {
                        Unknown::Velocity(part) if parts.contains(part) => Some(part),
                        _ => None,
                    };
                    match (part, g.as_const(*c)) {
                        (Some(part), Some(c)) => {
                            lift.definitions.remove(part);
                            open.push((factor * c, &self.definitions[part]));
                        }
                        _ => terms.entry(*of).or_default().push((factor, *c)),
                    }
                }
            }
            lift.definitions.insert(*id, summed(terms, g));
        }
        (lift.definitions.len() < self.definitions.len()).then_some(lift)
    }

    /// Whether T has no term in q̇_i but through the y.
    pub(super) fn has_no_inertia(&self, i: usize) -> bool {
        let own = Unknown::Coordinate(i);
        self.inertia.keys().all(|(a, b)| *a != own && *b != own)
    }

    /// All values, in a fixed order.
    pub(super) fn values_mut(&mut self) -> impl Iterator<Item = &mut Id> {
        let coefficients = self.definitions.values_mut().flat_map(|d| d.values_mut());
        let inertia = self.inertia.values_mut();
        let forces = self.force.values_mut().chain(&mut self.applied);
        coefficients.chain(inertia).chain(forces)
    }

    /// Carries what acts on the y over to what they are given by, last y first: x_k += Σ c_lk x_l.
    fn carried(&self, mut terms: Terms<Unknown>, g: &mut Graph) -> BTreeMap<Unknown, Id> {
        let mut carried = BTreeMap::new();
        for (id, definition) in self.definitions.iter().rev() {
            let own = terms.remove(&Unknown::Velocity(*id)).unwrap_or_default();
            let own = g.factored_sum(&own);
            carried.insert(Unknown::Velocity(*id), own);
            if g.is_zero(own) {
                continue;
            }
            for (of, c) in definition {
                let term = g.mul(*c, own);
                terms.entry(*of).or_default().push((1.0, term));
            }
        }
        carried.extend(summed(terms, g));
        carried
    }

    /// k D x for each unknown, as terms.
    fn momenta(&self, k: f64, x: &BTreeMap<Unknown, Id>, g: &mut Graph) -> Terms<Unknown> {
        let mut terms = Terms::new();
        let zero = g.zero();
        let at = |unknown: &Unknown| x.get(unknown).copied().unwrap_or(zero);
        for ((a, b), inertia) in &self.inertia {
            for (to, from) in [(a, b), (b, a)] {
                let term = g.mul(*inertia, at(from));
                if !g.is_zero(term) {
                    terms.entry(*to).or_default().push((k, term));
                }
                if a == b {
                    break;
                }
            }
        }
        terms
    }

    /// What T contributes to the forces on the unknowns, at q̈ = 0. With λ = ∂T/∂u as far as the unknowns after u give it, Lagrange's d/dt
    /// ∂T/∂q̇ − ∂T/∂q is, before it is carried over: D u̇ + Ḋ u + Σ_l λ_l ċ_l for each unknown, less Σ_lk λ_l u_k ∂c_lk/∂q + ½ uᵀ ∂D/∂q u
    /// for each coordinate.
    fn forces(&self, g: &mut Graph) -> BTreeMap<Unknown, Id> {
        let mut total = Derivative::total();
        let mut values = BTreeMap::new();
        let mut unknowns: Vec<Unknown> = self
            .definitions
            .values()
            .flat_map(|d| d.keys())
            .copied()
            .collect();
        unknowns.extend(self.inertia.keys().flat_map(|(a, b)| [*a, *b]));
        for unknown in unknowns {
            values.insert(unknown, unknown.value(g));
        }
        let momenta = self.momenta(1.0, &values, g);
        let lambda = self.carried(momenta, g);
        // u̇ at q̈ = 0, first y first.
        let mut rates: BTreeMap<Unknown, Id> = BTreeMap::new();
        for (id, definition) in &self.definitions {
            let mut terms = Vec::new();
            for (of, c) in definition {
                let change = total.of(*c, g);
                terms.push((1.0, g.mul(change, values[of])));
                if let Some(rate) = rates.get(of) {
                    terms.push((1.0, g.mul(*c, *rate)));
                }
            }
            let rate = g.factored_sum(&terms);
            rates.insert(Unknown::Velocity(*id), rate);
        }
        let mut changes = Changes {
            total,
            partials: BTreeMap::new(),
            forces: self.momenta(-1.0, &rates, g),
        };
        for (id, definition) in &self.definitions {
            let weight = lambda[&Unknown::Velocity(*id)];
            for (of, c) in definition {
                changes.carry(*c, *of, weight, g);
                changes.pull(*c, weight, values[of], 1.0, g);
            }
        }
        for ((a, b), inertia) in &self.inertia {
            let (x, y) = (values[a], values[b]);
            changes.carry(*inertia, *a, y, g);
            if a == b {
                changes.pull(*inertia, x, y, 0.5, g);
            } else {
                changes.carry(*inertia, *b, x, g);
                changes.pull(*inertia, x, y, 1.0, g);
            }
        }
        summed(changes.forces, g)
    }

    /// Q, per coordinate.
    pub(super) fn generalised(&self, n: usize, g: &mut Graph) -> Vec<Id> {
        let forces = self.force.iter().map(|(of, f)| (*of, vec![(1.0, *f)]));
        let mut forces: Terms<Unknown> = forces.collect();
        for (i, applied) in self.applied.iter().enumerate() {
            let terms = forces.entry(Unknown::Coordinate(i)).or_default();
            terms.extend(g.open(1.0, *applied));
        }
        let carried = self.carried(forces, g);
        let zero = g.zero();
        let at = |i| carried.get(&Unknown::Coordinate(i)).copied();
        (0..n).map(|i| at(i).unwrap_or(zero)).collect()
    }

    /// M: the y substituted by what they are given by, last y first.
    pub(super) fn mass(&self, g: &mut Graph) -> BTreeMap<(usize, usize), Id> {
        let mut rows: BTreeMap<Unknown, Terms<Unknown>> = BTreeMap::new();
        let add =
            |rows: &mut BTreeMap<Unknown, Terms<Unknown>>, a: Unknown, b: Unknown, term: Id| {
                // At the later one.
                let (a, b) = (a.max(b), a.min(b));
                rows.entry(a)
                    .or_default()
                    .entry(b)
                    .or_default()
                    .push((1.0, term));
            };
        for ((a, b), inertia) in &self.inertia {
            add(&mut rows, *a, *b, *inertia);
        }
        for (id, definition) in self.definitions.iter().rev() {
            let own = Unknown::Velocity(*id);
            let row = summed(rows.remove(&own).unwrap_or_default(), g);
            let zero = g.zero();
            let at = |unknown: &Unknown| row.get(unknown).copied().unwrap_or(zero);
            let mu = at(&own);
            let others = row.keys().filter(|u| **u != own);
            let touched: BTreeSet<Unknown> = others.chain(definition.keys()).copied().collect();
            let touched: Vec<(Unknown, Id, Id, Id)> = touched
                .into_iter()
                .map(|u| {
                    let c = definition.get(&u).copied().unwrap_or(zero);
                    let moved = g.mul(c, mu);
                    let with = at(&u);
                    (u, c, with, g.factored_sum(&[(1.0, with), (1.0, moved)]))
                })
                .collect();
            for (k, (a, ca, _, sum)) in touched.iter().enumerate() {
                for (b, cb, wb, _) in &touched[..=k] {
                    for term in [g.mul(*cb, *sum), g.mul(*ca, *wb)] {
                        if !g.is_zero(term) {
                            add(&mut rows, *a, *b, term);
                        }
                    }
                }
            }
        }
        let mut mass = BTreeMap::new();
        for (a, row) in rows {
            for (b, m) in summed(row, g) {
                if let (Unknown::Coordinate(i), Unknown::Coordinate(j)) = (a, b) {
                    mass.insert((i.max(j), i.min(j)), m);
                }
            }
        }
        mass
    }

    /// The equations `d` with the y as further coordinates, and their definitions as further constraints; `mass` was added to M and `force`
    /// to Q.
    pub fn extended(
        &self,
        d: &Dynamics,
        mass: &BTreeMap<(usize, usize), Id>,
        force: &BTreeMap<usize, Id>,
        g: &mut Graph,
    ) -> Dynamics {
        let (n, m) = (d.force.len(), d.rhs.len());
        let (zero, minus) = (g.zero(), g.constant(-1.0));
        let places: BTreeMap<Id, usize> = self.velocities().zip(n..).collect();
        let place = |unknown: &Unknown| match unknown {
            Unknown::Coordinate(i) => *i,
            Unknown::Velocity(id) => places[id],
        };
        let mut extended = d.clone();
        extended.widen(places.len(), zero);
        extended.mass = BTreeMap::new();
        for ((a, b), inertia) in &self.inertia {
            let (a, b) = (place(a), place(b));
            extended.mass.insert((a.max(b), a.min(b)), *inertia);
        }
        for (at, more) in mass {
            let before = extended.mass.get(at).copied().unwrap_or(zero);
            let sum = g.factored_sum(&[(1.0, before), (1.0, *more)]);
            extended.mass.insert(*at, sum);
        }
        extended.force = self.applied.clone();
        extended.force.resize(n + places.len(), zero);
        let more = force.iter().map(|(i, force)| (*i, force));
        let own = self.force.iter().map(|(of, force)| (place(of), force));
        for (at, force) in more.chain(own) {
            let all = &mut extended.force[at];
            let mut terms = g.open(1.0, *all);
            terms.extend(g.open(1.0, *force));
            *all = g.sum(&terms);
        }
        for (k, definition) in self.definitions.values().enumerate() {
            extended.jacobian.insert((m + k, n + k), minus);
            let entries = definition.iter();
            extended
                .jacobian
                .extend(entries.map(|(of, a)| ((m + k, place(of)), *a)));
        }
        extended
    }
}

/// Forces that come from the change of coefficients.
struct Changes {
    total: Derivative,
    partials: BTreeMap<usize, Derivative>,
    forces: Terms<Unknown>,
}

impl Changes {
    /// −weight ċ on what c multiplies.
    fn carry(&mut self, c: Id, of: Unknown, weight: Id, g: &mut Graph) {
        let change = self.total.of(c, g);
        let term = g.mul(weight, change);
        if !g.is_zero(term) {
            self.forces.entry(of).or_default().push((-1.0, term));
        }
    }

    /// k x y ∂c/∂q on each coordinate.
    fn pull(&mut self, c: Id, x: Id, y: Id, k: f64, g: &mut Graph) {
        for symbol in g.support(c) {
            let Symbol::Coord(i) = symbol else {
                continue;
            };
            let partial = self.partials.entry(i);
            let partial = partial.or_insert_with(|| Derivative::partial(symbol));
            let slope = partial.of(c, g);
            let term = g.product(&[(slope, 1), (x, 1), (y, 1)]);
            let terms = self.forces.entry(Unknown::Coordinate(i)).or_default();
            terms.push((k, term));
        }
    }
}
