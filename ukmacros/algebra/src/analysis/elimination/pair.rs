//! A coordinate that is eliminated with a constraint.

use super::Pair;
use super::entry::Entry;
use super::matrix::Matrix;
use crate::expr::{Graph, Id};
use std::collections::BTreeSet;

/// What the pivot [μ a; a 0] of a coordinate with a constraint leaves.
pub(super) struct Double {
    pub(super) pair: Pair,
    /// μ.
    pub(super) inertia: Id,
    /// a.
    pub(super) coefficient: Id,
    pub(super) touched: Vec<Touched>,
}

/// A neighbour of the coordinate j or of the constraint c of a 2 × 2 pivot.
pub(super) struct Touched {
    pub(super) at: usize,
    /// K_rj.
    pub(super) with: Id,
    /// K_rc/a: by how much of it q̈_j is less.
    pub(super) factor: Id,
    /// K_rj − μ K_rc/a.
    left: Id,
}

impl Double {
    /// The constraint's part of the solution, from the row of the coordinate with the right-hand side `given`, where all that is eliminated
    /// later is known, and the coordinate.
    pub(super) fn multiplier(&self, given: Id, known: &[Option<Id>], g: &mut Graph) -> Option<Id> {
        let own = known[self.pair.coordinate]?;
        let mut terms = vec![(1.0, given), (-1.0, g.mul(self.inertia, own))];
        for touched in &self.touched {
            if !g.is_zero(touched.with) {
                terms.push((-1.0, g.mul(touched.with, known[touched.at]?)));
            }
        }
        let rest = g.factored_sum(&terms);
        Some(g.div(rest, self.coefficient))
    }

    /// q̈_j follows from the constraint's row alone: its other entries, divided by a.
    pub(super) fn factors(&self, g: &Graph) -> Vec<(usize, Id)> {
        let factors = self.touched.iter().map(|t| (t.at, t.factor));
        factors.filter(|(_, id)| !g.is_zero(*id)).collect()
    }
}

impl Matrix<'_> {
    /// Eliminates a coordinate with a constraint, whose pivot P = [μ a; a 0] has P⁻¹ = [0 1/a; 1/a −μ/a²].
    pub(super) fn eliminate_pair(&mut self, pair: Pair, g: &mut Graph) -> Result<Double, String> {
        let (j, c) = (pair.coordinate, pair.constraint);
        let (a, mu) = (self.entry(j, c).open(g), self.entry(j, j).open(g));
        if g.is_zero(a) || !g.uses(a).constant() {
            let (name, of) = (&self.names[j], &self.names[c]);
            return Err(format!("the coefficient of `{name}` in `{of}` vanishes"));
        }
        let largest = self.entry(j, j).reference(g);
        self.know_mobilities(g);
        let mobility = match pair.massive {
            true => g.product(&[(mu, -1)]),
            false if pair.is_of(self.own, self.n) => self.mobility(pair, g),
            // Of the definition of a velocity all is counted where that is.
            false => g.zero(),
        };
        self.weigh(j, c, mobility, g);
        let mut of_j = self.take(j);
        of_j.remove(&c);
        let of_c = self.take(c);
        let row_j = self.row(&of_j, j, Entry::open, g);
        let row_c = self.row(&of_c, c, Entry::open, g);
        let zero = g.zero();
        let entry = |row: &[(usize, Id)], r: usize| {
            row.binary_search_by_key(&r, |(at, _)| *at)
                .map_or(zero, |at| row[at].1)
        };
        let both: BTreeSet<usize> = row_j.iter().chain(&row_c).map(|(r, _)| *r).collect();
        let touched = both.into_iter().map(|at| {
            let (with, factor) = (entry(&row_j, at), g.div(entry(&row_c, at), a));
            let whole = |id: Id, g: &mut Graph| match self.whole {
                true => g.hold_all(id),
                false => id,
            };
            let (with, factor) = (whole(with, g), whole(factor, g));
            let moved = g.mul(mu, factor);
            let left = g.factored_sum(&[(1.0, with), (-1.0, moved)]);
            let left = whole(left, g);
            Touched {
                at,
                with,
                factor,
                left,
            }
        });
        let touched: Vec<Touched> = touched.collect();
        for (p, r) in touched.iter().enumerate() {
            for s in &touched[..=p] {
                self.substitute(pair, r, s, largest, g);
            }
        }
        Ok(Double {
            pair,
            inertia: mu,
            coefficient: a,
            touched,
        })
    }

    /// Constraints remember that coordinate `i`, which moves by `mobility`, was theirs, but for the one it is eliminated `with`: where what
    /// gives it cannot move it, as a crank at its dead centre, all that is left of a constraint vanishes, and would else be compared with
    /// itself.
    pub(super) fn weigh(&mut self, i: usize, with: usize, mobility: Id, g: &mut Graph) {
        if g.is_zero(mobility) {
            return;
        }
        let constraints = self.rows[i].range(self.n..).copied();
        let others: Vec<usize> = constraints.filter(|r| *r != with).collect();
        for r in others {
            let square = self.entry(r, i).square(g);
            let size = g.mul(square, mobility);
            self.entry_mut(r, r).take_off_sized(&[], size);
        }
    }

    /// What stands for 1/μ of a coordinate without inertia: Σ (a_i/a)²/μ_i over the coordinates i that give it. At a dead centre these do
    /// not move it, but others that they give (the height of a crank's pin, for its reach); so it has their part where its own varies.
    fn mobility(&self, pair: Pair, g: &mut Graph) -> Id {
        let parts = self.moves(pair, g).into_iter();
        let parts = parts.map(|(i, part)| match g.uses(part).constant() {
            true => (1.0, part),
            false => (1.0, self.mobilities.get(&i).copied().unwrap_or(part)),
        });
        let parts: Vec<(f64, Id)> = parts.collect();
        g.factored_sum(&parts)
    }

    /// Sums up how far coordinates move others, before any of these is gone.
    fn know_mobilities(&mut self, g: &mut Graph) {
        let given = std::mem::take(&mut self.given);
        if given.iter().all(|pair| pair.massive) {
            return;
        }
        for pair in given {
            for (i, part) in self.moves(pair, g) {
                if !g.uses(part).constant() {
                    let sum = self.mobilities.get(&i).copied();
                    let sum = sum.map_or(part, |sum| g.add(sum, part));
                    self.mobilities.insert(i, sum);
                }
            }
        }
    }

    /// (a_i/a)²/μ_i of the coordinates i with inertia that give this one.
    fn moves(&self, pair: Pair, g: &mut Graph) -> Vec<(usize, Id)> {
        let (j, c) = (pair.coordinate, pair.constraint);
        let a = self.entry(c, j).open(g);
        let others = self.rows[c].range(..self.n).copied().filter(|i| *i != j);
        let others: Vec<usize> = others.collect();
        let others = others.into_iter().filter_map(|i| {
            let inertia = self.entry(i, i).open(g);
            let square = self.entry(c, i).square(g);
            (!g.is_zero(inertia)).then(|| (i, g.product(&[(square, 1), (inertia, -1), (a, -2)])))
        });
        others.collect()
    }

    /// What the substitution of a coordinate leaves of the entry of `r` and `s`, of which r is not before s.
    fn substitute(&mut self, pair: Pair, r: &Touched, s: &Touched, largest: Id, g: &mut Graph) {
        // Either form is the same; the second has one term if s shares no inertia with the coordinate.
        let (one, other) = match g.is_zero(r.with) {
            true => (s, r),
            false => (r, s),
        };
        let terms = [g.mul(other.factor, one.left), g.mul(one.factor, other.with)];
        let terms: Vec<Id> = terms.into_iter().filter(|id| !g.is_zero(*id)).collect();
        if terms.is_empty() {
            return;
        }
        let (j, c) = (pair.coordinate, pair.constraint);
        let (a, b) = (r.at, s.at);
        let coefficient = self.entry(j, c).open(g);
        if a == b {
            // Without the inertia shared with the coordinate: it may cancel the rest, and is not larger.
            let square = self.entry(c, a).square(g);
            let size = g.product(&[(square, 1), (largest, 1), (coefficient, -2)]);
            let size = g.neg(size);
            self.entry_mut(a, a).take_off_sized(&terms, size);
        } else if b < self.n && a >= self.n {
            let (f, o) = (self.entry(a, j).square(g), self.entry(c, b).square(g));
            let square = g.product(&[(f, 1), (o, 1), (coefficient, -2)]);
            self.link(a, b);
            let entry = self.entry_mut(a, b);
            terms
                .iter()
                .for_each(|term| entry.substitute(*term, square, g));
        } else {
            terms
                .iter()
                .for_each(|term| self.take_off(a, b, *term, false, g));
        }
    }
}
