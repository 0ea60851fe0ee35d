//! Blocks of M that are singular, everywhere or somewhere, made regular by rows of A.
//!
//! Let a q̈ = b be a row of A q̈ = b. Then (M + μ aᵀa) q̈ = Q + μ aᵀb + Aᵀλ has the same q̈ and the same λ as M q̈ = Q + Aᵀλ, whatever μ:
//! where the row holds, what is added to both sides is the same. And M + μ aᵀa is definite for μ > 0 if M is on all directions that the row
//! leaves free. The kinetic energy of a body turned by a quaternion knows nothing of the quaternion's length, so M is singular along it;
//! its constraint |e|² = 1 fixes nothing else. For corrections the same holds, with b = −residual: Δ is the one of least M-norm of the
//! original M.
//!
//! μ = Σ M_ii/Σ a_i² over the block's coordinates in the row: what is added is as large as M, in its units, at any scale of masses and
//! lengths.
//!
//! Where M is singular is found numerically: at random states, and at states where some of the coordinates that M contains are zero (the
//! identity among orientations, half turns; a mechanism's own singular states are likely there). What stays in doubt afterwards is checked
//! at run time: see [`Regular::met`].

use super::dynamics::Dynamics;
use super::groups::Groups;
use super::redundant::{Redundant, redundant};
use crate::expr::{Graph, Id, Node, Num, Probe, Random, Symbol, System, eval};
use std::collections::{BTreeMap, BTreeSet};

/// A pivot of a block of M below this share of what its diagonal is at other states is singular: rounding of the entries makes 1e-15,
/// masses of one block that differ by nine orders are not touched.
const SINGULAR: f64 = 1e-10;
/// A diagonal that varies by more than this over the states looked at may vanish at states that were not.
const VARIES: f64 = 16.0;
/// States with every choice of zeros are looked at up to so many coordinates; else those with one zero, and all zeros but one.
const CHOICES: usize = 5;
/// Random states looked at.
const GENERIC: usize = 24;
/// Larger blocks are only looked at where they are random.
const LARGE: usize = 48;

/// Equations for the elimination.
#[derive(Clone)]
pub struct Regular {
    /// The equations with M and Q of the blocks that are made regular.
    pub dynamics: Dynamics,
    /// What was added to M.
    pub added: BTreeMap<(usize, usize), Id>,
    /// What was added to Q.
    pub pulled: BTreeMap<usize, Id>,
    /// (row, coordinate, μ a_i): what was added, per unit of b, to Q.
    pub weights: Vec<(usize, usize, Id)>,
    /// The constraints that make M regular.
    pub rows: Vec<usize>,
    /// Constraints whose row of A q̈ = b is checked, as they act on a coordinate whose inertia may vanish. There λ is a difference of
    /// numbers as large as 1/M_ii, and the pivot cannot show it, being positive and exact. The residual does: computed q̈ and λ satisfy M
    /// q̈ = Q + Aᵀλ up to a few ε of these terms (each q̈_i is found from its row), so that with A q̈ = b to rounding they are those of
    /// equations as near, and K = [M Aᵀ; A 0] is what has to be well conditioned, not M.
    pub met: Vec<usize>,
    /// Coordinates of a block that is singular at any state, and that no constraint makes regular.
    pub singular: Vec<usize>,
    /// Constraints that imply each other; not looked for where `singular` refuses the straight line.
    pub redundant: Redundant,
}

/// Makes M regular as far as constraints do.
pub(super) fn regular(system: &mut System, d: &Dynamics) -> Regular {
    let mut found = Regular::of(d.clone());
    let g = &mut system.graph;
    for block in blocks(d, g) {
        let states = States::of(&block, d, &system.defaults, g);
        let (rows, singular) = states.restoring(&block, d);
        if singular {
            found.singular.extend(&block.coordinates);
        }
        let regular = !rows.is_empty();
        for row in rows {
            found.add(row, &block, d, g);
        }
        let own = block.coordinates.iter();
        let own: Vec<Id> = own.map(|i| found.dynamics.mass[&(*i, *i)]).collect();
        if states.may_vanish(&own, regular, g) {
            found.met.extend(&block.rows);
        }
    }
    found.rows.sort_unstable();
    found.met.sort_unstable();
    found.met.dedup();
    if found.singular.is_empty() {
        found.redundant = redundant(d, &system.defaults, &system.graph);
    }
    found
}

impl Regular {
    /// Equations to which nothing is done, and nothing of which is in doubt.
    pub fn of(dynamics: Dynamics) -> Self {
        Regular {
            dynamics,
            added: BTreeMap::new(),
            pulled: BTreeMap::new(),
            weights: Vec::new(),
            rows: Vec::new(),
            met: Vec::new(),
            singular: Vec::new(),
            redundant: Redundant::default(),
        }
    }

    /// Why there is no straight line, if M is singular whatever the state.
    pub fn refusal(&self, names: &[String]) -> Option<String> {
        let list = self.singular.iter().map(|i| format!("`{}`", names[*i]));
        let list = list.collect::<Vec<_>>().join(", ");
        (!list.is_empty()).then(|| {
            format!("M is singular at any state, in the rows of {list}, and no constraint makes it regular")
        })
    }

    /// Adds μ aᵀa to M and μ aᵀb to Q.
    fn add(&mut self, row: usize, block: &Block, d: &Dynamics, g: &mut Graph) {
        let entries: Vec<(usize, Id)> = d.row(row).collect();
        let within = |(i, _): &&(usize, Id)| block.coordinates.contains(i);
        let own = || entries.iter().filter(within);
        let trace: Vec<(f64, Id)> = own().map(|(i, _)| (1.0, d.mass[&(*i, *i)])).collect();
        let trace = g.factored_sum(&trace);
        let length: Vec<(f64, Id)> = own().map(|(_, a)| (1.0, g.square(*a))).collect();
        let length = g.factored_sum(&length);
        let weight = g.div(trace, length);
        let weight = g.hold_whole(weight);
        for (k, (i, a)) in entries.iter().enumerate() {
            let weighed = g.mul(weight, *a);
            let weighed = g.hold_whole(weighed);
            for (j, b) in &entries[..=k] {
                let term = g.mul(weighed, *b);
                let at = ((*i).max(*j), (*i).min(*j));
                for matrix in [&mut self.dynamics.mass, &mut self.added] {
                    let before = matrix.get(&at).copied().unwrap_or_else(|| g.zero());
                    matrix.insert(at, g.factored_sum(&[(1.0, before), (1.0, term)]));
                }
            }
            let term = g.mul(weighed, d.rhs[row]);
            self.dynamics.force[*i] = g.add(self.dynamics.force[*i], term);
            let before = self.pulled.get(i).copied().unwrap_or_else(|| g.zero());
            self.pulled.insert(*i, g.add(before, term));
            self.weights.push((row, *i, weighed));
        }
        self.rows.push(row);
    }
}

/// Coordinates that share inertia.
struct Block {
    /// The coordinates in ascending order.
    coordinates: Vec<usize>,
    /// Whether their part of M is the same at all states.
    constant: bool,
    /// The constraints on them.
    rows: BTreeSet<usize>,
}

/// The blocks of M that may be singular without being zero, and that constraints act on.
fn blocks(d: &Dynamics, g: &Graph) -> Vec<Block> {
    let n = d.force.len();
    let mut groups = Groups::new(n);
    for (i, j) in d.mass.keys() {
        groups.join(*i, *j);
    }
    let mut blocks: BTreeMap<usize, Block> = BTreeMap::new();
    let mut roots = Vec::with_capacity(n);
    for i in 0..n {
        let at = groups.of(i);
        roots.push(at);
        let block = blocks.entry(at).or_insert_with(|| Block {
            coordinates: Vec::new(),
            constant: true,
            rows: BTreeSet::new(),
        });
        block.coordinates.push(i);
    }
    for ((i, _), m) in &d.mass {
        let constant = g.uses(*m).constant();
        blocks
            .entry(roots[*i])
            .and_modify(|b| b.constant &= constant);
    }
    for (row, i) in d.jacobian.keys() {
        let block = blocks.entry(roots[*i]);
        block.and_modify(|b| b.rows.extend([*row]));
    }
    let doubtful = |b: &Block| {
        let inert = b.coordinates.iter().all(|i| d.mass.contains_key(&(*i, *i)));
        inert && (b.coordinates.len() > 1 || !b.constant) && !b.rows.is_empty()
    };
    blocks.into_values().filter(doubtful).collect()
}

/// States at which a block is looked at, with what M and A are there.
struct States<'a> {
    /// The random ones first.
    probes: Vec<Probe<'a>>,
    generic: usize,
    /// The block at each state, column by column, and the rows that meet it, both over the square roots of the largest diagonals.
    scaled: Vec<Vec<f64>>,
    rows: Vec<(usize, Vec<Vec<f64>>)>,
}

impl<'a> States<'a> {
    /// Evaluates a block of the equations `d` where they can be.
    fn of(block: &Block, d: &Dynamics, defaults: &'a [f64], g: &Graph) -> Self {
        let k = block.coordinates.len();
        let mut ids = Vec::with_capacity(k * k);
        for i in &block.coordinates {
            let entry = |j: &usize| d.mass.get(&((*i).max(*j), (*i).min(*j)));
            ids.extend(block.coordinates.iter().map(|j| entry(j).copied()));
        }
        let mut all: Vec<Id> = ids.iter().flatten().copied().collect();
        let (probes, generic) = probes(block, &all, d.force.len(), defaults, g);
        // Rows that may be added: with inertia at each of their coordinates.
        let inert = |i: usize| d.mass.contains_key(&(i, i));
        let usable = |row: &&usize| d.row(**row).all(|(i, _)| inert(i));
        let candidates: Vec<usize> = block.rows.iter().filter(usable).copied().collect();
        for row in &candidates {
            let own = d.row(*row).filter(|(i, _)| block.coordinates.contains(i));
            all.extend(own.map(|(_, a)| a));
        }
        let values = probes.iter().map(|p| eval(g, &all, &p.point()));
        let values: Vec<Vec<f64>> = values.collect();
        let finite = |values: &Vec<f64>| values.iter().all(|x| x.is_finite());
        let generic = values[..generic].iter().filter(|v| finite(v)).count();
        let known = probes.into_iter().zip(values);
        let (probes, values): (Vec<_>, Vec<_>) = known.filter(|(_, v)| finite(v)).unzip();
        let mut states = States {
            probes,
            generic,
            scaled: Vec::new(),
            rows: candidates.iter().map(|row| (*row, Vec::new())).collect(),
        };
        for values in &values {
            let mut values = values.iter().copied();
            let mut value = || values.next().unwrap_or(f64::NAN);
            let matrix = ids.iter().map(|id| id.map_or(0.0, |_| value()));
            states.scaled.push(matrix.collect());
            for (row, at) in &mut states.rows {
                let mut dense = vec![0.0; k];
                for (i, _) in d.row(*row) {
                    if let Ok(place) = block.coordinates.binary_search(&i) {
                        dense[place] = value();
                    }
                }
                at.push(dense);
            }
        }
        states.scale(k);
        states
    }

    /// Makes entries of different units comparable; rows get the length 1.
    fn scale(&mut self, k: usize) {
        let largest = |i: usize| {
            let own = self.scaled.iter().map(|m| m[i * k + i]);
            own.fold(0.0_f64, f64::max).sqrt()
        };
        let unit = |s: f64| if s > 0.0 { s } else { 1.0 };
        let scale: Vec<f64> = (0..k).map(largest).map(unit).collect();
        for matrix in &mut self.scaled {
            for (at, x) in matrix.iter_mut().enumerate() {
                *x /= scale[at / k] * scale[at % k];
            }
        }
        for row in self.rows.iter_mut().flat_map(|(_, at)| at) {
            row.iter_mut().zip(&scale).for_each(|(a, s)| *a /= s);
            let length = row.iter().map(|a| a * a).sum::<f64>().sqrt();
            if length > 0.0 {
                row.iter_mut().for_each(|a| *a /= length);
            }
        }
    }

    /// Rank of the block at a state, with `rows` added.
    fn rank(&self, state: usize, rows: &[usize]) -> usize {
        let mut matrix = self.scaled[state].clone();
        let k = matrix.len().isqrt();
        for row in rows {
            let a = &self.rows[*row].1[state];
            for (at, x) in matrix.iter_mut().enumerate() {
                *x += a[at / k] * a[at % k];
            }
        }
        rank(matrix, k)
    }

    /// The constraints that make the block regular where it is not; and whether it is singular at each random state with them.
    fn restoring(&self, block: &Block, d: &Dynamics) -> (Vec<usize>, bool) {
        let k = block.coordinates.len();
        let outside = |row: usize| {
            let others = d.row(row).filter(|(i, _)| !block.coordinates.contains(i));
            others.count()
        };
        let mut chosen: Vec<usize> = Vec::new();
        let mut deficient: Vec<(usize, usize)> = (0..self.scaled.len())
            .map(|state| (state, self.rank(state, &[])))
            .filter(|(_, rank)| *rank < k)
            .collect();
        let mut candidates: Vec<usize> = (0..self.rows.len()).collect();
        candidates.sort_by_key(|at| outside(self.rows[*at].0));
        for at in candidates {
            let generic = deficient.iter().any(|(state, _)| *state < self.generic);
            // A row of other coordinates too would couple them: only for a block that is singular everywhere.
            if deficient.is_empty() || (outside(self.rows[at].0) > 0 && !generic) {
                break;
            }
            chosen.push(at);
            let mut after = deficient.clone();
            (after.iter_mut()).for_each(|(state, rank)| *rank = self.rank(*state, &chosen));
            if after
                .iter()
                .zip(&deficient)
                .any(|(after, before)| after.1 > before.1)
            {
                after.retain(|(_, rank)| *rank < k);
                deficient = after;
            } else {
                chosen.pop();
            }
        }
        let left = deficient.iter().filter(|(s, _)| *s < self.generic).count();
        let excluded = self.rows.len() < block.rows.len();
        let singular = self.generic > 0 && left == self.generic && !excluded;
        let rows = chosen.into_iter().map(|at| self.rows[at].0);
        (rows.collect(), singular)
    }

    /// Whether one of these diagonal entries of M may come near zero. Where rows made the block `regular` that is meant relative to all of
    /// it: it is small as a whole only where the rows themselves vanish.
    fn may_vanish(&self, own: &[Id], regular: bool, g: &Graph) -> bool {
        if own.iter().all(|m| g.uses(*m).constant() || bounded(*m, g)) {
            return false;
        }
        let values = self.probes.iter().map(|p| eval(g, own, &p.point()));
        let mut values: Vec<Vec<f64>> = values.collect();
        let scale_by = |values: &mut Vec<Vec<f64>>| {
            for at in 0..own.len() {
                let largest = values.iter().fold(0.0_f64, |s, v| s.max(v[at].abs()));
                values.iter_mut().for_each(|v| v[at] /= largest);
            }
        };
        scale_by(&mut values);
        if regular {
            for at in &mut values {
                let whole: f64 = at.iter().sum();
                at.iter_mut().for_each(|x| *x /= whole);
            }
            scale_by(&mut values);
        }
        let values = &values;
        let open = own.iter().enumerate();
        let open = open.filter(|(_, m)| !(g.uses(**m).constant() || bounded(**m, g)));
        let open = open.flat_map(|(at, _)| values.iter().map(move |v| v[at]));
        let least = open.fold(f64::INFINITY, f64::min);
        least.is_nan() || least * VARIES < 1.0
    }
}

/// States of `n` coordinates to look at a block at, with these entries; and how many of them, the first ones, are random.
fn probes<'a>(
    block: &Block,
    entries: &[Id],
    n: usize,
    defaults: &'a [f64],
    g: &Graph,
) -> (Vec<Probe<'a>>, usize) {
    let mut random = Random::new(5);
    let generic = if block.constant { 1 } else { GENERIC };
    let probes = (0..generic).map(|_| Probe::signed(defaults, n, &mut random));
    let mut probes: Vec<Probe<'_>> = probes.collect();
    if block.coordinates.len() > LARGE {
        return (probes, generic);
    }
    let support = entries.iter().flat_map(|id| g.support(*id));
    let support = support.filter_map(|symbol| match symbol {
        Symbol::Coord(i) => Some(i),
        _ => None,
    });
    let support: BTreeSet<usize> = support.collect();
    for zeros in choices(&support.into_iter().collect::<Vec<_>>()) {
        let mut probe = Probe::signed(defaults, n, &mut random);
        zeros.iter().for_each(|i| probe.q[*i] = 0.0);
        probes.push(probe);
    }
    (probes, generic)
}

/// Which of `coordinates` are zero.
fn choices(coordinates: &[usize]) -> Vec<Vec<usize>> {
    let k = coordinates.len();
    let pick = |zero: &dyn Fn(usize) -> bool| -> Vec<usize> {
        let zeros = (0..k).filter(|at| zero(*at));
        zeros.map(|at| coordinates[at]).collect()
    };
    if k <= CHOICES {
        let sets = 1..1_usize << k;
        return sets.map(|set| pick(&|at| set >> at & 1 == 1)).collect();
    }
    let one = (0..k).map(|only| pick(&|at| at == only));
    let others = (0..k).map(|only| pick(&|at| at != only));
    one.chain(others).collect()
}

/// Rank of a symmetric semi-definite k × k matrix, by a Cholesky factorisation with interchanges.
fn rank(mut a: Vec<f64>, k: usize) -> usize {
    let mut left: Vec<usize> = (0..k).collect();
    while let Some(at) = (0..left.len()).max_by(|x, y| {
        let own = |at: &usize| a[left[*at] * k + left[*at]];
        own(x).total_cmp(&own(y))
    }) {
        let p = left[at];
        let pivot = a[p * k + p];
        if pivot < SINGULAR {
            break;
        }
        left.swap_remove(at);
        let near = left.iter().filter(|i| a[*i * k + p] != 0.0);
        let near: Vec<usize> = near.copied().collect();
        for i in &near {
            let factor = a[i * k + p] / pivot;
            for j in &near {
                a[i * k + j] -= factor * a[p * k + j];
            }
        }
    }
    k - left.len()
}

/// Whether `id` is at least a positive number at any state, parameters being positive.
fn bounded(id: Id, g: &Graph) -> bool {
    if g.uses(id).constant() {
        return !g.is_zero(id) && never_negative(id, g);
    }
    match g.node(id) {
        Node::Sum(c, terms) => {
            let positive = |(k, term): &(Num, Id)| k.get() > 0.0 && bounded(*term, g);
            (c.get() > 0.0 || terms.iter().any(positive)) && never_negative(id, g)
        }
        Node::Scale(c, inner) => c.get() > 0.0 && bounded(*inner, g),
        Node::Held(inner) => bounded(*inner, g),
        Node::Product(factors) => factors.iter().all(|(f, e)| *e > 0 && bounded(*f, g)),
        Node::Call(func, _) => func.row().least.is_some_and(|least| least > 0.0),
        _ => false,
    }
}

/// Whether `id` is at no state negative, parameters being positive.
fn never_negative(id: Id, g: &Graph) -> bool {
    match g.node(id) {
        Node::Const(c) => c.get() >= 0.0,
        Node::Symbol(symbol) => matches!(symbol, Symbol::Param(_)),
        Node::Sum(c, terms) => {
            let rest = |(k, t): &(Num, Id)| k.get() >= 0.0 && never_negative(*t, g);
            c.get() >= 0.0 && terms.iter().all(rest)
        }
        Node::Scale(c, inner) => c.get() >= 0.0 && never_negative(*inner, g),
        Node::Held(inner) => never_negative(*inner, g),
        Node::Product(factors) => {
            let rest = |(f, e): &(Id, i32)| e % 2 == 0 || never_negative(*f, g);
            factors.iter().all(rest)
        }
        Node::Call(func, _) => func.row().least.is_some(),
        Node::Select(_) => false,
    }
}
