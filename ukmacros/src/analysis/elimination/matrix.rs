//! K with symbolic entries, eliminated in a given order.

use super::dropping::reciprocal;
use super::{Divisor, Pair, Pivoting};
use crate::analysis::dynamics::Dynamics;
use crate::expr::{Func, Graph, Id};
use std::collections::{BTreeMap, BTreeSet};

/// Longest chain of pivots whose divisions are put off. Their numerators are products of as many pivots, and must stay in the range of
/// numbers: with lengths of 1e-15 or 1e15 a constraint's pivot is 1e∓30, and its ninth power still has room.
const CHAIN: usize = 8;

/// K, with entries that are sums still open.
pub(super) struct Matrix {
    n: usize,
    /// (row ≥ column) → terms.
    entries: BTreeMap<(usize, usize), Entry>,
    rows: Vec<BTreeSet<usize>>,
    /// What one constraint before takes off each, its division put off.
    deferred: Vec<Option<Deferred>>,
    /// How many divisions in a row were put off.
    depth: Vec<usize>,
    /// When each is eliminated alone.
    turn: Vec<usize>,
    /// Constraints that may be left out.
    droppable: BTreeSet<usize>,
    /// Of each row of A its entries a with M_ii, where there is inertia.
    inert: BTreeMap<usize, Vec<(Id, Id)>>,
    /// Rows with a coordinate that was eliminated with a constraint.
    substituted: BTreeSet<usize>,
}

/// An update d − p²/(N/D) of a diagonal that is not yet divided by N.
#[derive(Clone, Copy)]
struct Deferred {
    /// N.
    pivot: Id,
    /// p² D.
    square: Id,
}

/// Σ gram + Σ schur: what makes up an entry of M or G, and what elimination takes off it.
#[derive(Clone, Default)]
pub(super) struct Entry {
    gram: Vec<(f64, Id)>,
    schur: Vec<(f64, Id)>,
}

impl Entry {
    pub(super) fn of(id: Id) -> Self {
        Entry {
            gram: vec![(1.0, id)],
            schur: Vec::new(),
        }
    }

    /// Takes `term` off: off what stood before if it `reduces`, else as a part of what the entry is made up of.
    pub(super) fn take_off(&mut self, term: Id, reduces: bool) {
        let list = match reduces {
            true => &mut self.schur,
            false => &mut self.gram,
        };
        list.push((-1.0, term));
    }

    /// The value before and after the terms of constraints.
    pub(super) fn values(&self, g: &mut Graph) -> (Id, Id) {
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

/// One step of an elimination, as right-hand sides see it.
pub(super) enum Factor {
    Single(Single),
    Double(Double),
}

/// What one coordinate or constraint leaves: x_at = sign · right/pivot − Σ factor · x.
pub(super) struct Single {
    pub(super) at: usize,
    /// −1 for constraints, whose pivots are negative in K.
    pub(super) sign: f64,
    /// The pivot is `numerator`/`denominator`, but for its sign.
    pub(super) numerator: Id,
    /// Where the division of the one before was put off; else the pivot is `numerator`.
    pub(super) denominator: Option<Id>,
    /// The diagonal that the pivot started from.
    pub(super) reference: Id,
    /// Of a row that may be left out, what stands for one over the pivot.
    pub(super) reciprocal: Option<Id>,
    /// What is divided by the pivot is computed once. For a coordinate that shares no inertia, products are left open, so that terms of
    /// different coordinates can be collected.
    pub(super) shared: bool,
    /// The row's other entries.
    pub(super) row: Vec<(usize, Id)>,
    /// The row's other entries divided by the pivot.
    pub(super) factors: Vec<(usize, Id)>,
    /// Whether the division is put off to the one neighbour there is.
    pub(super) defers: bool,
}

/// What the pivot [μ a; a 0] of a coordinate with a constraint leaves.
pub(super) struct Double {
    pub(super) pair: Pair,
    /// μ.
    pub(super) inertia: Id,
    /// a.
    pub(super) coefficient: Id,
    /// Of each neighbour its entries with the coordinate and with the constraint.
    pub(super) touched: Vec<(usize, Id, Id)>,
    /// The constraint's other entries, divided by a.
    pub(super) factors: Vec<(usize, Id)>,
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

impl Matrix {
    /// K = [M Aᵀ; A 0] with the given A.
    pub(super) fn new(
        d: &Dynamics,
        jacobian: &BTreeMap<(usize, usize), Id>,
        order: &[Pivoting],
        droppable: BTreeSet<usize>,
        g: &Graph,
    ) -> Self {
        let n = d.force.len();
        let size = n + d.rhs.len();
        let mut inert: BTreeMap<usize, Vec<(Id, Id)>> = BTreeMap::new();
        for ((row, i), a) in jacobian {
            if let Some(m) = d.mass.get(&(*i, *i)) {
                inert.entry(n + row).or_default().push((*a, *m));
            }
        }
        let jacobian = jacobian.iter();
        let below = jacobian.map(|((row, column), a)| ((n + row, *column), *a));
        let declared = d.mass.iter().map(|(at, m)| (*at, *m)).chain(below);
        let (mut entries, mut rows) = (BTreeMap::new(), vec![BTreeSet::new(); size]);
        for ((a, b), id) in declared.filter(|(_, id)| !g.is_zero(*id)) {
            entries.insert((a, b), Entry::of(id));
            if a != b {
                rows[a].insert(b);
                rows[b].insert(a);
            }
        }
        let mut turn = vec![0; size];
        for (at, step) in order.iter().enumerate() {
            if let Pivoting::Single(k) = *step {
                turn[k] = at;
            }
        }
        Matrix {
            n,
            entries,
            rows,
            deferred: vec![None; size],
            depth: vec![0; size],
            turn,
            droppable,
            inert,
            substituted: BTreeSet::new(),
        }
    }

    fn value(&self, a: usize, b: usize, g: &mut Graph) -> Id {
        match self.entries.get(&(a.max(b), a.min(b))) {
            Some(entry) => entry.values(g).1,
            None => g.zero(),
        }
    }

    fn take_off(&mut self, a: usize, b: usize, term: Id, reduces: bool, g: &Graph) {
        if g.is_zero(term) {
            return;
        }
        let entry = self.entries.entry((a.max(b), a.min(b))).or_default();
        entry.take_off(term, reduces);
        if a != b {
            self.rows[a].insert(b);
            self.rows[b].insert(a);
        }
    }

    /// Neighbours of `k`, which leaves the matrix.
    fn take(&mut self, k: usize) -> BTreeSet<usize> {
        let neighbours = std::mem::take(&mut self.rows[k]);
        for a in &neighbours {
            self.rows[*a].remove(&k);
        }
        neighbours
    }

    /// The pivot of `k` and the diagonal that it started from, both times a positive number, without the sign that constraints have in K;
    /// and the number, if it is not 1. In a chain of constraints (each coupled to the next alone) divisions would wait for each other;
    /// written as N' = d N − p² D over D' = N the pivots need none, and all reciprocals are independent.
    fn pivot(&self, k: usize, g: &mut Graph) -> Option<(Id, Id, Option<Id>)> {
        let (reference, diagonal) = self.entries.get(&(k, k))?.values(g);
        let sign = self.sign(k);
        let (reference, diagonal) = (g.scale(sign, reference), g.scale(sign, diagonal));
        let (numerator, reference, denominator) = match self.deferred[k] {
            None => (diagonal, reference, None),
            Some(Deferred { pivot, square }) => {
                let whole = g.mul(diagonal, pivot);
                let numerator = g.factored_sum(&[(1.0, whole), (-1.0, square)]);
                (numerator, g.mul(reference, pivot), Some(pivot))
            }
        };
        (!g.is_zero(numerator)).then_some((numerator, reference, denominator))
    }

    /// Constraint pivots are negative in K.
    fn sign(&self, k: usize) -> f64 {
        if k >= self.n { -1.0 } else { 1.0 }
    }

    /// Whether constraint `k` puts off its division to its only neighbour `a`: not to a coordinate, nor where another one is eliminated
    /// into `a`, nor after [`CHAIN`] in a row.
    fn defers(&self, k: usize, a: usize) -> bool {
        let another = || self.rows[a].iter().any(|b| self.turn[*b] < self.turn[a]);
        let room = self.deferred[a].is_none() && self.depth[k] < CHAIN;
        let counts = !self.droppable.contains(&k) && !self.droppable.contains(&a);
        k >= self.n && a >= self.n && room && counts && !another()
    }

    /// Σ a²/M_ii of a row of A, if there is inertia at any of its coordinates.
    fn length(&self, k: usize, g: &mut Graph) -> Option<Id> {
        let squares = self.inert.get(&k)?.iter();
        let squares = squares.map(|(a, m)| (1.0, g.product(&[(*a, 2), (*m, -1)])));
        let squares: Vec<(f64, Id)> = squares.collect();
        Some(g.sum(&squares))
    }

    /// Takes one step of the elimination; with a 1 × 1 pivot, what it divides by.
    pub(super) fn step(
        &mut self,
        step: Pivoting,
        names: &[String],
        g: &mut Graph,
        hints: &mut Vec<(Id, String)>,
    ) -> Result<(Factor, Option<Divisor>), String> {
        Ok(match step {
            Pivoting::Pair(pair) => (Factor::Double(self.eliminate_pair(pair, g)), None),
            Pivoting::Single(k) => {
                let (single, divisor) = self.eliminate(k, names, g, hints)?;
                (Factor::Single(single), Some(divisor))
            }
        })
    }

    /// Eliminates a coordinate or constraint.
    fn eliminate(
        &mut self,
        k: usize,
        names: &[String],
        g: &mut Graph,
        hints: &mut Vec<(Id, String)>,
    ) -> Result<(Single, Divisor), String> {
        let constraint = k >= self.n;
        let zero = g.zero();
        let pivot = self.pivot(k, g).or_else(|| {
            // Whatever the state.
            let length = self.length(k, g)?;
            self.droppable.insert(k);
            Some((zero, length, None))
        });
        let droppable = self.droppable.contains(&k);
        let (numerator, mut reference, denominator) =
            pivot.ok_or_else(|| vanished(k, self.n, names))?;
        if droppable
            && self.substituted.contains(&k)
            && let Some(length) = self.length(k, g)
        {
            // What was substituted into the row may have taken all of it away but for rounding.
            reference = g.call2(Func::Max, reference, length);
        }
        hints.push((numerator, format!("pivot_{}", names[k])));
        hints.push((reference, format!("diagonal_{}", names[k])));
        let divisor = Divisor {
            name: names[k].clone(),
            position: k,
            value: numerator,
            reference,
            droppable,
        };
        let one = g.one();
        // Of a row that may be left out no division is put off.
        let reciprocal = droppable.then(|| reciprocal(numerator, reference, g));
        let inverse = match reciprocal {
            Some(inverse) => inverse,
            None => {
                let value = g.div(numerator, denominator.unwrap_or(one));
                g.pow(value, -1)
            }
        };
        let inverse = g.scale(self.sign(k), inverse);
        let neighbours = self.take(k);
        let neighbours_values = neighbours.iter().map(|a| (*a, self.value(*a, k, g)));
        let mut single = Single {
            at: k,
            sign: self.sign(k),
            numerator,
            denominator,
            reference,
            reciprocal,
            shared: constraint || neighbours.range(..self.n).next().is_some(),
            row: neighbours_values.collect(),
            factors: Vec::new(),
            defers: false,
        };
        if constraint {
            for (a, entry) in single.row.iter().filter(|(a, _)| *a >= self.n) {
                hints.push((*entry, format!("{}_with_{}", names[*a], names[k])));
            }
        }
        if let [(a, off)] = single.row[..]
            && self.defers(k, a)
        {
            self.depth[a] = self.depth[k] + 1;
            self.deferred[a] = Some(Deferred {
                pivot: numerator,
                square: g.product(&[(off, 2), (denominator.unwrap_or(one), 1)]),
            });
            single.factors = vec![(a, g.mul(off, inverse))];
            single.defers = true;
            return Ok((single, divisor));
        }
        if single.shared {
            let entries = single.row.iter_mut();
            entries.for_each(|(_, entry)| *entry = g.hold_whole(*entry));
        }
        for (a, entry) in &single.row {
            let mut factor = g.mul(*entry, inverse);
            if single.shared {
                factor = g.hold_whole(factor);
                hints.push((factor, format!("{}_by_{}", names[*a], names[k])));
            }
            single.factors.push((*a, factor));
        }
        for (p, (a, factor)) in single.factors.iter().enumerate() {
            for (b, entry) in &single.row[..=p] {
                let term = g.mul(*factor, *entry);
                // What a coordinate adds to constraints makes up G; all else is taken off a diagonal that stood before.
                self.take_off(*a, *b, term, constraint || *a < self.n, g);
            }
        }
        Ok((single, divisor))
    }

    /// Eliminates a coordinate with a constraint: P⁻¹ = [0 1/a; 1/a −μ/a²].
    fn eliminate_pair(&mut self, pair: Pair, g: &mut Graph) -> Double {
        let Pair {
            coordinate: j,
            constraint: c,
            ..
        } = pair;
        let (a, mu) = (self.value(j, c, g), self.value(j, j, g));
        let mut of_j = self.take(j);
        of_j.remove(&c);
        let of_c = self.take(c);
        let mut values = |of: &BTreeSet<usize>, k: usize| -> BTreeMap<usize, Id> {
            of.iter().map(|r| (*r, self.value(*r, k, g))).collect()
        };
        let (row_j, row_c) = (values(&of_j, j), values(&of_c, c));
        let zero = g.zero();
        let entry = |row: &BTreeMap<usize, Id>, r: &usize| row.get(r).copied().unwrap_or(zero);
        let touched: Vec<(usize, Id, Id)> = of_j
            .union(&of_c)
            .map(|r| (*r, entry(&row_j, r), entry(&row_c, r)))
            .collect();
        self.substituted.extend(touched.iter().map(|(r, ..)| *r));
        for (p, (r, rj, rc)) in touched.iter().enumerate() {
            for (s, sj, sc) in &touched[..=p] {
                for term in products((*rj, *rc), (*sj, *sc), a, mu, g) {
                    self.take_off(*r, *s, term, false, g);
                }
            }
        }
        // q̈_j follows from the constraint's row alone.
        let factors = row_c.iter().map(|(r, id)| (*r, g.div(*id, a)));
        Double {
            factors: factors.collect(),
            pair,
            inertia: mu,
            coefficient: a,
            touched,
        }
    }
}

/// The terms of [u w] P⁻¹ [x; y] for P = [μ a; a 0].
pub(super) fn products(
    (u, w): (Id, Id),
    (x, y): (Id, Id),
    a: Id,
    mu: Id,
    g: &mut Graph,
) -> [Id; 3] {
    let first = g.product(&[(u, 1), (y, 1), (a, -1)]);
    let second = g.product(&[(w, 1), (x, 1), (a, -1)]);
    let third = g.product(&[(w, 1), (y, 1), (mu, 1), (a, -2)]);
    [first, second, g.neg(third)]
}
