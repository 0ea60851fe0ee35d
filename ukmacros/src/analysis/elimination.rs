//! The constrained solve as part of the graph: [M Aᵀ; A 0] [q̈; −λ] = [Q; b] eliminated symbolically, in an order chosen here.
//!
//! Pivots, in this order of preference:
//! 1. A massless coordinate, or one that a constraint prescribes alone, together with a constraint in which its coefficient is a
//!    number: the 2 × 2 pivot [μ a; a 0] with a ≠ 0 is safe whatever the state.
//! 2. Coordinates with inertia, and constraints all of whose coordinates are eliminated: 1 × 1 pivots that are definite where A has full
//!    rank, since what is eliminated is then a saddle-point matrix of its own. Coordinates that share no inertia with others come first; then what has the fewest neighbours (least fill); among equals what waits for the
//!    shortest chain of divisions, so that a chain of links is taken from both ends at once.
//!
//! # The certificate
//!
//! Every 1 × 1 pivot d is compared at run time with the diagonal G it started from. Let B be the rows of A M^−½ (of what is left of them
//! once the 2 × 2 pivots are gone), each scaled to length 1, and σ its smallest singular value: the distance to rank loss.
//! The share d/G of a constraint is the squared distance of its row of B from the span of the rows eliminated before it. Hence
//!
//! - d/G ≥ σ² for every constraint: a state with σ ≥ 1/32 is never refused.
//! - One row within δ of the span of those before has d/G ≤ δ², and is refused for δ < 1/32, wherever else it stands.
//! - What is accepted is accurate. The LDLᵀ of a definite matrix is stable whatever its scaling (Higham 2002, theorem 10.6 with
//!   van der Sluis's scaling): λ is off by (n + m) ε κ(B Bᵀ), and q̈ by that part of it which B does not damp. While one row at a time comes near
//!   the others κ(B Bᵀ) is 1/σ² and about G/d, so that the error of q̈ is below (n + m) ε · 1024 of the larger of q̈ and M⁻¹ Q, in the mass
//!   metric. (Shares of rows that are dependent in steps, each near those before, could multiply in the worst case; chains of
//!   links nearly in line do not. Measured over approaches to rank loss, errors reach a tenth of the bound: tests/tests/certificate.rs.)
//!
//! 1/1024 is `RANK_CEILING`² of the rank-revealing solve: above it that would not doubt the rank either, at states off the constraints included. Where a
//! share is less it takes over; it works on A itself, whose condition is the root of G's, and keeps twice the digits. What depends on
//! parameters only also has to be finite: an infinite mass would vanish by its reciprocal.

use super::dynamics::Dynamics;
use crate::expr::{Graph, Id, Node, Symbol, System, is_power_of_two};
use std::collections::{BTreeMap, BTreeSet};

/// A 1 × 1 pivot d and the diagonal G it started from, both times a positive number: rank is lost where d/G falls to rounding.
#[derive(Clone)]
pub(crate) struct Pivot {
    /// Of the coordinate or constraint.
    pub(crate) name: String,
    /// Its position: coordinates first, then constraints.
    pub(crate) position: usize,
    pub(crate) value: Id,
    pub(crate) reference: Id,
    /// Its right-hand side, times the same number.
    right: Option<Id>,
}

/// Longest chain of pivots whose divisions are put off. Their numerators are products of as many pivots, and must stay in the range of
/// numbers: with lengths of 1e-15 or 1e15 a constraint's pivot is 1e∓30, and its ninth power still has room.
const CHAIN: usize = 8;

/// The straight-line solve.
#[derive(Clone)]
pub(crate) struct Elimination {
    /// q̈.
    pub(crate) acceleration: Vec<Id>,
    /// Δ of least M-norm with A Δ = −residual (residuals are [`Symbol::Residual`]).
    pub(crate) correction: Vec<Id>,
    pub(crate) pivots: Vec<Pivot>,
    /// Right-hand sides of the pivots in the solution for the correction.
    correction_rights: Vec<Id>,
    /// The order: names of coordinates (positions below n) and constraints (n + row); pairs for 2 × 2 pivots.
    pub(crate) order: Vec<Pivoting>,
    /// Names of pivots, factors and multipliers.
    pub(crate) hints: Vec<(Id, String)>,
}

/// One pivot of the order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pivoting {
    One(usize),
    /// Coordinate and constraint.
    Two(usize, usize),
}

/// The least share d/G of a pivot that the straight line accepts: the square of `ukcore::solver::RANK_CEILING`; see the module's
/// section on the certificate.
pub(crate) const SAFE_SHARE: f64 = 1.0 / 1024.0;

/// A program with more pivots leaves early, after each [`STRETCH`] of them, if the certificate does not hold. That is seldom; what it is for is
/// the compiler of the emitted code: it packs scalars of one stretch without branches into vectors, and in long stretches finds pairs that are far
/// apart and have to be kept for each other. The U-chain with 65 links takes 280 ns with exits and 450 without, that with 17 links 79 and 67.
const UNBROKEN: usize = 24;
/// See [`UNBROKEN`].
const STRETCH: usize = 12;

/// Programs larger than this are not worth their compile time: the solve is then left to the runtime.
const MAX_ENTRIES: usize = 20_000;

/// Eliminates; or says why the structure does not allow it.
pub(crate) fn eliminate(
    d: &Dynamics,
    names: &[String],
    g: &mut Graph,
) -> Result<Elimination, String> {
    let n = d.force.len();
    let order = order(d, names, g)?;
    let zero = g.zero();
    // A factor that all of M shares, as the one mass of all parts, only scales the multipliers: it is taken out of M and Q.
    let (factor, d) = &without_common_factor(d, g);
    let mut pivots = Vec::new();
    let first = d.mass.keys().next().map_or(0, |(i, _)| *i);
    let unit = g.one();
    if *factor != unit {
        pivots.push(Pivot {
            name: names[first].clone(),
            position: first,
            value: *factor,
            reference: *factor,
            right: None,
        });
    }
    let force: Vec<Id> = (0..n).map(|i| g.add(d.force[i], d.nonideal[i])).collect();
    // A constraint may be divided by a number: one that all its coefficients share would be multiplied through everything.
    let scales: Vec<f64> = (0..d.rhs.len()).map(|row| share(d, row, g)).collect();
    let scaled = |ids: &[Id], g: &mut Graph| -> Vec<Id> {
        let rows = ids.iter().zip(&scales);
        rows.map(|(id, s)| g.scale(1.0 / s, *id)).collect()
    };
    let mut jacobian = d.jacobian.clone();
    for ((row, _), a) in &mut jacobian {
        *a = g.scale(1.0 / scales[*row], *a);
    }
    let rhs = scaled(&d.rhs, g);
    let mut system = Matrix::new(d, &jacobian, g);
    system.load(&force, &rhs);
    let mut hints = Vec::new();
    let (acceleration, own) = system.solve(&order, names, g, &mut hints)?;
    pivots.extend(own);
    let residuals: Vec<Id> = (0..d.rhs.len())
        .map(|i| {
            let r = g.symbol(Symbol::Residual(i));
            g.neg(r)
        })
        .collect();
    let residuals = scaled(&residuals, g);
    let mut system = Matrix::new(d, &jacobian, g);
    system.load(&vec![zero; n], &residuals);
    // The same pivots, with other right-hand sides.
    let (correction, again) = system.solve(&order, names, g, &mut hints)?;
    Ok(Elimination {
        acceleration,
        correction,
        pivots,
        correction_rights: again.iter().filter_map(|p| p.right).collect(),
        order,
        hints,
    })
}

/// The product of parameters that all entries of M have in front, and the equations with M, Q and c divided by it.
fn without_common_factor(d: &Dynamics, g: &mut Graph) -> (Id, Dynamics) {
    let mut entries = d.mass.values();
    let mut common = entries.next().map_or(Vec::new(), |m| g.factors(*m));
    common.retain(|(base, _)| g.uses(*base).constant() && g.as_const(*base).is_none());
    for entry in entries {
        let factors = g.factors(*entry);
        common.retain(|factor| factors.contains(factor));
    }
    let factor = g.product(&common);
    let mut scaled = d.clone();
    if !common.is_empty() {
        let vectors = scaled.force.iter_mut().chain(&mut scaled.nonideal);
        for value in scaled.mass.values_mut().chain(vectors) {
            // Term by term, so that the factor cancels where it can.
            let terms = g.open(1.0, *value);
            let divided: Vec<(f64, Id)> = terms
                .into_iter()
                .map(|(k, term)| (k, g.div(term, factor)))
                .collect();
            *value = g.sum(&divided);
        }
    }
    (factor, scaled)
}

/// The magnitude that the coefficients of all entries of a row of A share, if it is a power of two (so that dividing is exact); else 1.
fn share(d: &Dynamics, row: usize, g: &Graph) -> f64 {
    let mut sizes = d
        .jacobian
        .range((row, 0)..(row + 1, 0))
        .map(|(_, a)| match g.as_const(*a) {
            Some(x) => x.abs(),
            None => g.unscaled(*a).0.abs(),
        });
    let Some(first) = sizes.next() else {
        return 1.0;
    };
    if is_power_of_two(first) && sizes.all(|s| s == first) {
        first
    } else {
        1.0
    }
}

/// An elimination with its certificate.
#[derive(Clone)]
pub(crate) struct Straight {
    pub(crate) elimination: Elimination,
    /// 1 where every pivot is safe, 0 where one is not.
    pub(crate) certificate: Id,
    /// What is computed first, in this order: pivots, their right-hand sides, links of the certificate.
    pub(crate) stages: Vec<Id>,
    /// Links of the certificate after which the code leaves if it does not hold.
    pub(crate) exits: Vec<Id>,
    /// What the certificate compares: positions, and whether against the diagonal that the pivot started from (else against zero).
    pub(crate) checks: Vec<(usize, bool)>,
}

impl Straight {
    /// All values, in a fixed order.
    pub(crate) fn values_mut(&mut self) -> impl Iterator<Item = &mut Id> {
        let Elimination {
            acceleration,
            correction,
            ..
        } = &mut self.elimination;
        let solutions = acceleration.iter_mut().chain(correction);
        solutions.chain([&mut self.certificate])
    }

    /// Adds the certificate, and enters the names.
    pub(crate) fn new(mut elimination: Elimination, system: &mut System) -> Self {
        let g = &mut system.graph;
        let (certificate, chain) = elimination.certificate(g);
        let mut stages = Vec::new();
        for (k, pivot) in elimination.pivots.iter().enumerate() {
            stages.push(pivot.value);
            let links = chain.iter().filter(|(of, _)| *of == k);
            stages.extend(links.map(|(_, link)| *link));
            stages.extend(pivot.right);
        }
        stages.extend(&elimination.correction_rights);
        let varying = chain.iter().filter(|(_, link)| !g.uses(*link).constant());
        let exits: Vec<Id> = match varying.clone().count() {
            0..=UNBROKEN => Vec::new(),
            _ => varying
                .skip(STRETCH - 1)
                .step_by(STRETCH)
                .map(|(_, link)| *link)
                .collect(),
        };
        let pivots = &elimination.pivots;
        let checked = chain.iter().map(|(of, _)| &pivots[*of]);
        let checks = checked
            .map(|p| (p.position, p.value != p.reference))
            .collect();
        for (of, link) in chain {
            let name = &elimination.pivots[of].name;
            system.inner_hints.insert(link, format!("safe_{name}"));
        }
        for (id, name) in std::mem::take(&mut elimination.hints) {
            let (_, mut inner) = g.unscaled(id);
            // Of a product with parameters, the part that varies.
            if let Node::Product(factors) = g.node(inner) {
                let mut varying = factors.iter().filter(|(f, _)| !g.uses(*f).constant());
                if let (Some((factor, 1)), None) = (varying.next(), varying.next()) {
                    inner = *factor;
                }
            }
            if !g.operands(inner).is_empty() {
                system.inner_hints.entry(inner).or_insert(name);
            }
        }
        Straight {
            elimination,
            certificate,
            stages,
            exits,
            checks,
        }
    }
}

impl Elimination {
    /// 1 where every pivot is safe, 0 where one is not, as a chain of selections, and its links with the
    /// pivots they check: what depends on parameters only first, then
    /// in the order of the elimination, so that no pivot has to be kept for it.
    fn certificate(&self, g: &mut Graph) -> (Id, Vec<(usize, Id)>) {
        let (zero, tiny) = (g.zero(), g.constant(f64::MIN_POSITIVE));
        let largest = g.constant(f64::MAX);
        let positive: BTreeSet<Id> = self
            .pivots
            .iter()
            .filter(|p| p.value == p.reference && g.unscaled(p.value).0 > 0.0)
            .map(|p| g.unscaled(p.value).1)
            .collect();
        let mut conditions: Vec<(usize, Id, Id)> = Vec::new();
        for (
            k,
            Pivot {
                value, reference, ..
            },
        ) in self.pivots.iter().enumerate()
        {
            let (value, least) = if value == reference {
                // Nothing was taken off the diagonal: it has to be positive.
                (sign_of(*value, &positive, g), tiny)
            } else {
                let (value, reference) = reduced(*value, *reference, &positive, g);
                (value, g.scale(SAFE_SHARE, reference))
            };
            let holds = g.as_const(value).is_some_and(|x| x > 0.0) && least == tiny;
            let known = conditions.iter().any(|c| (c.1, c.2) == (value, least));
            if !holds && !known {
                conditions.push((k, value, least));
            }
        }
        conditions.sort_by_key(|(_, a, b)| !(g.uses(*a).constant() && g.uses(*b).constant()));
        let mut safe = g.one();
        let mut chain = Vec::new();
        for (k, value, least) in conditions {
            // In this order a pivot that is not a number is not safe.
            safe = g.select(least, value, safe, zero);
            if g.uses(value).constant() {
                // Computed once, so that it costs nothing: an infinite mass would vanish by its reciprocal.
                safe = g.select(value, largest, safe, zero);
            }
            chain.push((k, safe));
        }
        (safe, chain)
    }
}

/// Why there is no pivot at `k`.
fn vanished(k: usize, n: usize, names: &[String]) -> String {
    let name = &names[k];
    match k < n {
        true => format!("nothing is left of the inertia of `{name}`, whatever the state"),
        false => format!(
            "`{name}` is implied by the constraints eliminated before it, whatever the state"
        ),
    }
}

/// `id` without its positive factors, if anything else is left.
fn sign_of(id: Id, positive: &BTreeSet<Id>, g: &mut Graph) -> Id {
    let (c, inner) = g.unscaled(id);
    let mut open = g.factors(id);
    open.retain(|(base, _)| !positive.contains(base));
    let rest = match open.as_slice() {
        [] => inner,
        open => g.product(open),
    };
    g.scale(c.signum(), rest)
}

/// Both without the `positive` factors that they share.
fn reduced(a: Id, b: Id, positive: &BTreeSet<Id>, g: &mut Graph) -> (Id, Id) {
    let others = g.factors(b);
    let mut common = Vec::new();
    for (base, e) in g.factors(a) {
        let Some((_, other)) = others.iter().find(|(b, _)| *b == base) else {
            continue;
        };
        if (e > 0) == (*other > 0) {
            let least = if e > 0 { e.min(*other) } else { e.max(*other) };
            if positive.contains(&base) {
                common.push((base, -least));
            }
        }
    }
    let mut divide = |id: Id| {
        let mut all = common.clone();
        all.push((id, 1));
        g.product(&all)
    };
    (divide(a), divide(b))
}

/// Adjacency of K = [M Aᵀ; A 0]: coordinates 0..n, constraints n..n + m.
fn adjacency(d: &Dynamics) -> Vec<BTreeSet<usize>> {
    let n = d.force.len();
    let mut near = vec![BTreeSet::new(); n + d.rhs.len()];
    let mut join = |a: usize, b: usize| {
        if a != b {
            near[a].insert(b);
            near[b].insert(a);
        }
    };
    for (i, j) in d.mass.keys() {
        join(*i, *j);
    }
    for (row, column) in d.jacobian.keys() {
        join(n + row, *column);
    }
    near
}

fn order(d: &Dynamics, names: &[String], g: &Graph) -> Result<Vec<Pivoting>, String> {
    let n = d.force.len();
    let mut near = adjacency(d);
    // The coordinates in each constraint.
    let mut contained: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); near.len()];
    for (row, column) in d.jacobian.keys() {
        contained[n + row].insert(*column);
    }
    let mut inertia: Vec<bool> = (0..n).map(|i| d.mass.contains_key(&(i, i))).collect();
    let mut alive: BTreeSet<usize> = (0..near.len()).collect();
    let mut depth = vec![0_usize; near.len()];
    let mut order = Vec::new();
    let number = |row: usize, j: usize| d.jacobian.get(&(row, j)).and_then(|a| g.as_const(*a));
    // Prescribed and massless coordinates. A substitution that is not trivial gives its neighbours new entries, so that later
    // coefficients are no longer those of A: only untouched rows and columns are taken.
    let mut touched: BTreeSet<usize> = BTreeSet::new();
    loop {
        let candidate = (0..n)
            .filter(|j| alive.contains(j) && !touched.contains(j))
            .find_map(|j| {
                let rows = near[j]
                    .iter()
                    .copied()
                    .filter(|c| *c >= n && !touched.contains(c));
                let fit = rows.filter(|c| number(c - n, j).is_some_and(|a| a != 0.0));
                // Prescribed: the constraint contains nothing else that is alive.
                let alone = |c: usize| near[c].len() == 1;
                let massless = !inertia[j];
                fit.filter(|c| massless || alone(*c))
                    .min_by_key(|c| near[*c].len())
                    .map(|c| (j, c))
            });
        let Some((j, c)) = candidate else { break };
        order.push(Pivoting::Two(j, c));
        let (of_j, of_c) = (near[j].clone(), near[c].clone());
        for r in of_j
            .iter()
            .chain(&of_c)
            .copied()
            .filter(|r| *r != j && *r != c)
        {
            near[r].remove(&j);
            near[r].remove(&c);
        }
        alive.remove(&j);
        alive.remove(&c);
        let massive = inertia[j];
        // The update couples the neighbours of one with those of the other, and, if j has inertia, those of c among themselves.
        let mut couple = |a: usize, b: usize| {
            if a == b {
                if a < n {
                    inertia[a] = true;
                }
            } else {
                near[a].insert(b);
                near[b].insert(a);
                for (c, q) in [(a, b), (b, a)] {
                    if c >= n && q < n {
                        contained[c].insert(q);
                    }
                }
            }
            touched.insert(a);
            touched.insert(b);
        };
        for a in of_j.iter().copied().filter(|r| *r != c) {
            for b in of_c.iter().copied().filter(|r| *r != j) {
                couple(a, b);
            }
        }
        if massive {
            for a in of_c.iter().copied().filter(|r| *r != j) {
                for b in of_c.iter().copied().filter(|r| *r != j) {
                    couple(a, b);
                }
            }
        }
    }
    let mut coordinates = alive.range(..n);
    if let Some(j) = coordinates.find(|j| !inertia[**j]) {
        return Err(format!(
            "`{}` has no mass, and no constraint in which its coefficient is a number",
            names[*j]
        ));
    }
    // Definite pivots.
    let mut entries = 0;
    let mut coupled = vec![false; near.len()];
    while !alive.is_empty() {
        // With all its coordinates gone, what is left of a constraint is definite, though it may be coupled to others that share inertia.
        let ready = |k: &usize| *k < n || contained[*k].iter().all(|q| !alive.contains(q));
        // A coordinate that shares no inertia comes first: the constraints on it must wait for it in any case.
        let single = |k: usize| k < n && near[k].iter().all(|r| *r >= n);
        let candidates = alive.iter().copied().filter(ready);
        // Among equals what was coupled by an elimination comes first, so that a chain is taken link by link; then what waits least.
        let next =
            candidates.min_by_key(|k| (!single(*k), near[*k].len(), !coupled[*k], depth[*k], *k));
        let Some(k) = next else {
            let left: Vec<&str> = alive.iter().map(|k| names[*k].as_str()).collect();
            return Err(format!(
                "no definite pivot is left among {}",
                left.join(", ")
            ));
        };
        order.push(Pivoting::One(k));
        alive.remove(&k);
        let neighbours: Vec<usize> = near[k].iter().copied().collect();
        // Only constraints divide on the critical path; coordinates with constant inertia do not.
        let later = depth[k] + usize::from(k >= n);
        for (p, a) in neighbours.iter().enumerate() {
            near[*a].remove(&k);
            coupled[*a] = true;
            depth[*a] = depth[*a].max(later);
            for b in &neighbours[p + 1..] {
                near[*a].insert(*b);
                near[*b].insert(*a);
            }
            entries += neighbours.len();
        }
        if entries > MAX_ENTRIES {
            return Err(format!(
                "its elimination would compute more than {MAX_ENTRIES} entries (at `{}`)",
                names[k]
            ));
        }
    }
    Ok(order)
}

/// K and its right-hand side, with entries that are sums still open.
struct Matrix {
    n: usize,
    /// (row ≥ column) → terms.
    entries: BTreeMap<(usize, usize), Entry>,
    rows: Vec<BTreeSet<usize>>,
    rhs: Vec<Entry>,
    /// What one constraint before takes off each, its division put off.
    deferred: Vec<Option<Deferred>>,
    /// How many divisions in a row were put off.
    depth: Vec<usize>,
}

/// An update d − p²/(N/D), r + p (R/D)/(N/D) that is not yet divided by N.
#[derive(Clone, Copy)]
struct Deferred {
    /// N.
    pivot: Id,
    /// p² D.
    square: Id,
    /// p R.
    right: Id,
}

/// A pivot numerator/denominator (without its sign), with its right-hand side right/denominator.
struct Fraction {
    numerator: Id,
    denominator: Id,
    right: Id,
}

/// Σ gram + Σ schur: what makes up an entry of M or G, and what elimination takes off it.
#[derive(Clone, Default)]
struct Entry {
    gram: Vec<(f64, Id)>,
    schur: Vec<(f64, Id)>,
}

impl Entry {
    fn of(id: Id, g: &Graph) -> Self {
        let gram = if g.is_zero(id) {
            Vec::new()
        } else {
            vec![(1.0, id)]
        };
        Entry {
            gram,
            schur: Vec::new(),
        }
    }

    /// The value before and after the terms of constraints.
    fn values(&self, g: &mut Graph) -> (Id, Id) {
        let gram = g.factored_sum(&self.gram);
        let gram = match g.unscaled(gram).0.abs() {
            1.0 => gram,
            _ => g.hold_whole(gram),
        };
        if self.schur.is_empty() {
            return (gram, gram);
        }
        let mut terms = vec![(1.0, gram)];
        terms.extend(&self.schur);
        (gram, g.factored_sum(&terms))
    }
}

impl Matrix {
    fn new(d: &Dynamics, jacobian: &BTreeMap<(usize, usize), Id>, g: &Graph) -> Self {
        let n = d.force.len();
        let mut entries = BTreeMap::new();
        for (at, m) in &d.mass {
            entries.insert(*at, Entry::of(*m, g));
        }
        for ((row, column), a) in jacobian {
            entries.insert((n + row, *column), Entry::of(*a, g));
        }
        let mut rows = vec![BTreeSet::new(); n + d.rhs.len()];
        for (a, b) in entries.keys().filter(|(a, b)| a != b) {
            rows[*a].insert(*b);
            rows[*b].insert(*a);
        }
        Matrix {
            n,
            entries,
            deferred: vec![None; rows.len()],
            depth: vec![0; rows.len()],
            rows,
            rhs: Vec::new(),
        }
    }

    fn load(&mut self, force: &[Id], rhs: &[Id]) {
        let all = force.iter().chain(rhs);
        self.rhs = all
            .map(|id| Entry {
                gram: vec![(1.0, *id)],
                schur: Vec::new(),
            })
            .collect();
    }

    fn value(&self, a: usize, b: usize, g: &mut Graph) -> Id {
        match self.entries.get(&(a.max(b), a.min(b))) {
            Some(entry) => entry.values(g).1,
            None => g.zero(),
        }
    }

    fn update(&mut self, a: usize, b: usize, reduces: bool, term: Id, g: &Graph) {
        if g.is_zero(term) {
            return;
        }
        let entry = self.entries.entry((a.max(b), a.min(b))).or_default();
        if reduces {
            entry.schur.push((-1.0, term));
        } else {
            entry.gram.push((-1.0, term));
        }
        if a != b {
            self.rows[a].insert(b);
            self.rows[b].insert(a);
        }
    }

    fn update_rhs(&mut self, a: usize, reduces: bool, term: Id, g: &Graph) {
        if g.is_zero(term) {
            return;
        }
        let list = if reduces {
            &mut self.rhs[a].schur
        } else {
            &mut self.rhs[a].gram
        };
        list.push((-1.0, term));
    }

    /// Neighbours of `k`, which leaves the matrix.
    fn take(&mut self, k: usize) -> Vec<usize> {
        let neighbours: Vec<usize> = std::mem::take(&mut self.rows[k]).into_iter().collect();
        for a in &neighbours {
            self.rows[*a].remove(&k);
        }
        neighbours
    }

    /// The pivot of `k`. In a chain of constraints (each coupled to the next alone) divisions would wait for each other; written as
    /// N' = d N − p² D over D' = N the pivots need none, and all reciprocals are independent.
    fn fraction(&self, k: usize, diagonal: Id, right: Id, g: &mut Graph) -> Fraction {
        let Some(Deferred {
            pivot,
            square,
            right: before,
        }) = self.deferred[k]
        else {
            return Fraction {
                numerator: diagonal,
                denominator: g.one(),
                right,
            };
        };
        let (diagonal, right) = (g.mul(diagonal, pivot), g.mul(right, pivot));
        Fraction {
            numerator: g.factored_sum(&[(1.0, diagonal), (-1.0, square)]),
            denominator: pivot,
            right: g.factored_sum(&[(1.0, right), (1.0, before)]),
        }
    }

    /// Whether constraint `k` puts off its division, with `a` its only neighbour: not where another one is eliminated into `a`, nor after
    /// [`CHAIN`] in a row.
    fn defers(&self, k: usize, a: usize, position: &[usize]) -> bool {
        let another = self.rows[a].iter().any(|b| position[*b] < position[a]);
        !another && self.deferred[a].is_none() && self.depth[k] < CHAIN
    }

    /// Forward elimination and back substitution; the coordinates' part of the solution, and the 1 × 1 pivots.
    fn solve(
        mut self,
        order: &[Pivoting],
        names: &[String],
        g: &mut Graph,
        hints: &mut Vec<(Id, String)>,
    ) -> Result<(Vec<Id>, Vec<Pivot>), String> {
        let size = self.rows.len();
        let mut pivots = Vec::new();
        let mut position = vec![0; size];
        for (at, step) in order.iter().enumerate() {
            if let Pivoting::One(k) = *step {
                position[k] = at;
            }
        }
        // For back substitution, each divided by the pivot: the row's entries, the right-hand side.
        let mut eliminated: Vec<(Vec<(usize, Id)>, Id)> = Vec::new();
        for step in order {
            match *step {
                Pivoting::One(k) => {
                    let Some(entry) = self.entries.get(&(k, k)) else {
                        return Err(vanished(k, self.n, names));
                    };
                    let (reference, diagonal) = entry.values(g);
                    let constraint = k >= self.n;
                    // Constraint pivots are negative in K.
                    let sign = if constraint { -1.0 } else { 1.0 };
                    let (reference, diagonal) = (g.scale(sign, reference), g.scale(sign, diagonal));
                    let right = self.rhs[k].values(g).1;
                    let pivot = self.fraction(k, diagonal, right, g);
                    if g.is_zero(pivot.numerator) {
                        return Err(vanished(k, self.n, names));
                    }
                    let reference = g.mul(reference, pivot.denominator);
                    pivots.push(Pivot {
                        name: names[k].clone(),
                        position: k,
                        value: pivot.numerator,
                        reference,
                        right: Some(pivot.right),
                    });
                    hints.push((pivot.numerator, format!("pivot_{}", names[k])));
                    hints.push((pivot.right, format!("right_{}", names[k])));
                    hints.push((reference, format!("diagonal_{}", names[k])));
                    // x_k = solved − Σ row · x / value
                    let value = g.div(pivot.numerator, pivot.denominator);
                    let value = g.scale(sign, value);
                    let solved = g.div(pivot.right, pivot.numerator);
                    let solved = g.scale(sign, solved);
                    let neighbours = self.take(k);
                    // What constraints or shared inertia divide by is computed once; for a coordinate that shares none, products are
                    // left open, so that terms of different coordinates can be collected.
                    let shared = constraint || neighbours.iter().any(|a| *a < self.n);
                    let mut row: Vec<(usize, Id)> = neighbours
                        .iter()
                        .map(|a| (*a, self.value(*a, k, g)))
                        .collect();
                    for (a, entry) in row.iter().filter(|(a, _)| constraint && *a >= self.n) {
                        hints.push((*entry, format!("{}_with_{}", names[*a], names[k])));
                    }
                    if let [(a, off)] = row[..]
                        && constraint
                        && a >= self.n
                        && self.defers(k, a, &position)
                    {
                        self.depth[a] = self.depth[k] + 1;
                        self.deferred[a] = Some(Deferred {
                            pivot: pivot.numerator,
                            square: g.product(&[(off, 2), (pivot.denominator, 1)]),
                            right: g.mul(off, pivot.right),
                        });
                        eliminated.push((vec![(a, g.div(off, value))], solved));
                        continue;
                    }
                    let mut right = right;
                    if shared {
                        row.iter_mut().for_each(|(_, ka)| *ka = g.hold_whole(*ka));
                        right = g.hold_whole(right);
                    }
                    let factors: Vec<(usize, Id)> = row
                        .iter()
                        .map(|(a, ka)| {
                            let factor = g.div(*ka, value);
                            let factor = if shared { g.hold_whole(factor) } else { factor };
                            if shared {
                                hints.push((factor, format!("{}_by_{}", names[*a], names[k])));
                            }
                            (*a, factor)
                        })
                        .collect();
                    for (p, (a, factor)) in factors.iter().enumerate() {
                        for (b, kb) in &row[..=p] {
                            let term = g.mul(*factor, *kb);
                            // What a coordinate adds to constraints makes up G; all else is taken off a diagonal that stood before.
                            self.update(*a, *b, constraint || *a < self.n, term, g);
                        }
                        let term = match self.deferred[k] {
                            None => g.mul(*factor, right),
                            Some(_) => g.mul(row[p].1, solved),
                        };
                        self.update_rhs(*a, constraint, term, g);
                    }
                    eliminated.push((factors, solved));
                }
                Pivoting::Two(j, c) => {
                    let a = self.value(j, c, g);
                    let mu = self.value(j, j, g);
                    let (fj, fc) = (self.rhs[j].values(g).1, self.rhs[c].values(g).1);
                    let of_j = self.take(j);
                    let of_c = self.take(c);
                    let row =
                        |list: &[usize], k: usize, m: &Matrix, g: &mut Graph| -> Vec<(usize, Id)> {
                            let others = list.iter().filter(|r| **r != j && **r != c);
                            others.map(|r| (*r, m.value(*r, k, g))).collect()
                        };
                    let row_j = row(&of_j, j, &self, g);
                    let row_c = row(&of_c, c, &self, g);
                    // P⁻¹ = [0 1/a; 1/a −μ/a²].
                    let touched: BTreeSet<usize> =
                        row_j.iter().chain(&row_c).map(|(r, _)| *r).collect();
                    let entry = |list: &[(usize, Id)], r: usize, g: &mut Graph| {
                        list.iter()
                            .find(|(k, _)| *k == r)
                            .map_or(g.zero(), |(_, id)| *id)
                    };
                    for &r in &touched {
                        let (rj, rc) = (entry(&row_j, r, g), entry(&row_c, r, g));
                        for &s in touched.range(..=r) {
                            let (sj, sc) = (entry(&row_j, s, g), entry(&row_c, s, g));
                            let first = g.product(&[(rj, 1), (sc, 1), (a, -1)]);
                            let second = g.product(&[(rc, 1), (sj, 1), (a, -1)]);
                            let third = g.product(&[(rc, 1), (sc, 1), (mu, 1), (a, -2)]);
                            let third = g.neg(third);
                            for term in [first, second, third] {
                                self.update(r, s, false, term, g);
                            }
                        }
                        let first = g.product(&[(rj, 1), (fc, 1), (a, -1)]);
                        let second = g.product(&[(rc, 1), (fj, 1), (a, -1)]);
                        let third = g.product(&[(rc, 1), (fc, 1), (mu, 1), (a, -2)]);
                        let third = g.neg(third);
                        for term in [first, second, third] {
                            self.update_rhs(r, false, term, g);
                        }
                    }
                    // q̈_j follows from the constraint's row alone.
                    let factors = row_c.iter().map(|(r, id)| (*r, g.div(*id, a))).collect();
                    eliminated.push((factors, g.div(fc, a)));
                }
            }
        }
        let mut solution: Vec<Option<Id>> = vec![None; size];
        for (step, (row, right)) in order.iter().zip(&eliminated).rev() {
            let unknown = match *step {
                Pivoting::One(k) => k,
                Pivoting::Two(j, _) => j,
            };
            let mut terms = vec![(1.0, *right)];
            for (other, factor) in row {
                // A multiplier that no coordinate left needs (of a 2 × 2 pivot) is not computed.
                let Some(x) = solution[*other] else {
                    return Err(format!(
                        "the order leaves out the multiplier of `{}`",
                        names[*other]
                    ));
                };
                terms.push((-1.0, g.mul(*factor, x)));
            }
            // Varying factors in front would have to be multiplied by each other.
            let x = g.factored_sum_of(&terms, |g, id| g.uses(id).constant());
            if unknown >= self.n {
                hints.push((x, format!("lambda_{}", names[unknown])));
            }
            solution[unknown] = Some(x);
        }
        let n = self.n;
        let coordinates: Option<Vec<Id>> = solution[..n].iter().copied().collect();
        let coordinates = coordinates.ok_or_else(|| "a coordinate was left over".to_owned())?;
        Ok((coordinates, pivots))
    }
}
