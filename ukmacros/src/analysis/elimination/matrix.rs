//! K with symbolic entries, and its elimination.

use super::{Pivot, Pivoting};
use crate::analysis::dynamics::Dynamics;
use crate::expr::{Graph, Id};
use std::collections::{BTreeMap, BTreeSet};

/// Longest chain of pivots whose divisions are put off. Their numerators are products of as many pivots, and must stay in the range of
/// numbers: with lengths of 1e-15 or 1e15 a constraint's pivot is 1e∓30, and its ninth power still has room.
const CHAIN: usize = 8;

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

/// K and its right-hand side, with entries that are sums still open.
pub(super) struct Matrix {
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
    pub(super) fn new(d: &Dynamics, jacobian: &BTreeMap<(usize, usize), Id>, g: &Graph) -> Self {
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

    pub(super) fn load(&mut self, force: &[Id], rhs: &[Id]) {
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
    pub(super) fn solve(
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
