//! K with symbolic entries, eliminated in a given order.

use super::dropping::reciprocal;
use super::entry::Entry;
use super::pair::Double;
use super::rotation::{Turned, apart};
use super::{Divisor, Pair, Pivoting, Task};
use crate::analysis::dynamics::Dynamics;
use crate::expr::{Graph, Id};
use std::collections::{BTreeMap, BTreeSet};

/// Longest chain of pivots whose divisions are put off. Their numerators are products of as many pivots, and must stay in the range of
/// numbers: with lengths of 1e-15 or 1e15 a constraint's pivot is 1e∓30, and its ninth power still has room.
const CHAIN: usize = 8;

/// K, with entries that are sums still open.
pub(super) struct Matrix<'a> {
    pub(super) n: usize,
    /// The names of coordinates and constraints.
    pub(super) names: &'a [String],
    /// Names of what is computed.
    pub(super) hints: Vec<(Id, String)>,
    /// (row ≥ column) → terms.
    entries: BTreeMap<(usize, usize), Entry>,
    pub(super) rows: Vec<BTreeSet<usize>>,
    /// What one constraint before takes off each, its division put off.
    deferred: Vec<Option<Deferred>>,
    /// How many divisions in a row were put off.
    depth: Vec<usize>,
    /// When each is eliminated alone.
    turn: Vec<usize>,
    /// Constraints that may be left out.
    droppable: BTreeSet<usize>,
    /// How many rotations that were not scaled come before each coordinate that took the place of two.
    pub(super) turned: Vec<Option<usize>>,
    /// How many coordinates and constraints are the mechanism's: they come first.
    pub(super) own: (usize, usize),
    /// Coordinates of the mechanism with its constraints that they are eliminated with, until the first of them is.
    pub(super) given: Vec<Pair>,
    /// How far the coordinates [move](Matrix::mobility) that each coordinate gives, where that varies.
    pub(super) mobilities: BTreeMap<usize, Id>,
    /// Whether what stands for different coordinates shares little inertia, whatever the state.
    pub(super) apart: bool,
    /// Whether what a pair leaves is computed once, with all its factors: many entries are made up of it.
    pub(super) whole: bool,
}

/// An update d − p²/(N/D) of a diagonal that is not yet divided by N.
#[derive(Clone, Copy)]
struct Deferred {
    /// N.
    pivot: Id,
    /// p² D.
    square: Id,
}

/// One step of an elimination, as right-hand sides see it.
pub(super) enum Factor {
    Single(Single),
    Double(Double),
    Turned(Turned),
}

/// What one coordinate or constraint leaves: x_at = sign · right/pivot − Σ factor · x.
pub(super) struct Single {
    pub(super) at: usize,
    /// −1 for constraints, whose pivots are negative in K.
    pub(super) sign: f64,
    /// The pivot is `numerator`/`denominator`, but for its sign.
    pub(super) numerator: Id,
    /// The number that the pivot is still to be divided by, where the division of the one before was put off; else the pivot is
    /// `numerator`.
    pub(super) denominator: Option<Id>,
    /// The diagonal that the pivot started from.
    pub(super) reference: Id,
    /// What stands for one over the pivot of a row that may be left out.
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

impl<'a> Matrix<'a> {
    /// K = [M Aᵀ; A 0] of a task, as `d` has it.
    pub(super) fn new(
        d: &Dynamics,
        task: &Task<'a>,
        order: &[Pivoting],
        droppable: BTreeSet<usize>,
        g: &Graph,
    ) -> Self {
        let n = d.force.len();
        let size = n + d.rhs.len();
        let jacobian = d.jacobian.iter();
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
        let given = order.iter().filter_map(|step| match *step {
            Pivoting::Pair(pair) => Some(pair).filter(|pair| pair.is_of(task.own, n)),
            _ => None,
        });
        let given = given.collect();
        let mut turn = vec![0; size];
        for (at, step) in order.iter().enumerate() {
            match *step {
                Pivoting::Single(k) => turn[k] = at,
                Pivoting::Pair(pair) => {
                    (turn[pair.coordinate], turn[pair.constraint]) = (at, at);
                }
                Pivoting::Rotation(rotation) => {
                    (turn[rotation.coordinates[1]], turn[rotation.constraint]) = (at, at);
                }
            }
        }
        Matrix {
            n,
            names: task.names,
            hints: Vec::new(),
            entries,
            rows,
            deferred: vec![None; size],
            depth: vec![0; size],
            turn,
            droppable,
            turned: vec![None; n],
            own: task.own,
            given,
            mobilities: BTreeMap::new(),
            apart: apart(&d.mass, g),
            whole: !task.turned.is_empty(),
        }
    }

    pub(super) fn take_off(&mut self, a: usize, b: usize, term: Id, reduces: bool, g: &Graph) {
        if g.is_zero(term) {
            return;
        }
        self.entry_mut(a, b).take_off(term, reduces);
        self.link(a, b);
    }

    /// The entry at (a, b), zero where there is none.
    pub(super) fn entry(&self, a: usize, b: usize) -> Entry {
        let entry = self.entries.get(&(a.max(b), a.min(b)));
        entry.cloned().unwrap_or_default()
    }

    pub(super) fn entry_mut(&mut self, a: usize, b: usize) -> &mut Entry {
        self.entries.entry((a.max(b), a.min(b))).or_default()
    }

    /// Enters `a` and `b` as each other's neighbours.
    pub(super) fn link(&mut self, a: usize, b: usize) {
        if a != b {
            self.rows[a].insert(b);
            self.rows[b].insert(a);
        }
    }

    /// Takes away the entry at (a, b), off the diagonal.
    pub(super) fn remove(&mut self, a: usize, b: usize) {
        self.entries.remove(&(a.max(b), a.min(b)));
    }

    /// The entries of `k` with `others` that are not zero, as `value` gives them.
    pub(super) fn row(
        &self,
        others: &BTreeSet<usize>,
        k: usize,
        value: fn(&Entry, &mut Graph) -> Id,
        g: &mut Graph,
    ) -> Vec<(usize, Id)> {
        let values = others.iter().map(|a| (*a, value(&self.entry(*a, k), g)));
        let values: Vec<(usize, Id)> = values.collect();
        let zero = |(_, id): &(usize, Id)| !g.is_zero(*id);
        values.into_iter().filter(zero).collect()
    }

    /// Neighbours of `k`, which leaves the matrix.
    pub(super) fn take(&mut self, k: usize) -> BTreeSet<usize> {
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
        let entry = self.entries.get(&(k, k))?;
        let (reference, (_, diagonal)) = (entry.reference(g), entry.values(g));
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

    /// Takes one step of the elimination; and what may vanish of what it divides by.
    pub(super) fn step(
        &mut self,
        step: Pivoting,
        g: &mut Graph,
    ) -> Result<(Factor, Vec<Divisor>), String> {
        Ok(match step {
            Pivoting::Rotation(rotation) => {
                let (turned, divisors) = self.rotate(rotation, g)?;
                (Factor::Turned(turned), divisors)
            }
            Pivoting::Pair(pair) => {
                let double = self.eliminate_pair(pair, g)?;
                // Parameters may make it vanish, or all but cancel.
                let divisor = (!pair.coefficient.number).then(|| {
                    let entry = self.entry(pair.coordinate, pair.constraint);
                    let value = g.square(double.coefficient);
                    Divisor {
                        reference: entry.square(g),
                        ..Divisor::positive(pair.constraint, value, self.names)
                    }
                });
                (Factor::Double(double), divisor.into_iter().collect())
            }
            Pivoting::Single(k) => {
                let (single, divisor) = self.eliminate(k, g)?;
                (Factor::Single(single), vec![divisor])
            }
        })
    }

    /// Eliminates a coordinate or constraint.
    fn eliminate(&mut self, k: usize, g: &mut Graph) -> Result<(Single, Divisor), String> {
        let constraint = k >= self.n;
        let pivot = self.pivot(k, g).or_else(|| self.nothing_left(k, g));
        let (numerator, reference, denominator) = pivot.ok_or_else(|| self.vanished(k))?;
        let droppable = self.droppable.contains(&k);
        let name = &self.names[k];
        self.hints.push((numerator, format!("pivot_{name}")));
        self.hints.push((reference, format!("diagonal_{name}")));
        let divisor = Divisor {
            reference,
            droppable,
            ..Divisor::positive(k, numerator, self.names)
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
        let neighbours_values: Vec<(usize, Id)> =
            self.row(&neighbours, k, |entry, g| entry.values(g).1, g);
        let mut single = Single {
            at: k,
            sign: self.sign(k),
            numerator,
            denominator,
            reference,
            reciprocal,
            shared: constraint || neighbours.range(..self.n).next().is_some(),
            row: neighbours_values,
            factors: Vec::new(),
            defers: false,
        };
        if constraint {
            for (a, entry) in single.row.iter().filter(|(a, _)| *a >= self.n) {
                let hint = format!("{}_with_{name}", self.names[*a]);
                self.hints.push((*entry, hint));
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
                let hint = format!("{}_by_{name}", self.names[*a]);
                self.hints.push((factor, hint));
            }
            single.factors.push((*a, factor));
        }
        self.spread(&single, inverse, g);
        Ok((single, divisor))
    }

    /// Why there is no pivot at `k`.
    pub(super) fn vanished(&self, k: usize) -> String {
        let name = &self.names[k];
        match k < self.n {
            true => format!("nothing is left of the inertia of `{name}`, whatever the state"),
            false => format!(
                "`{name}` is implied by the constraints eliminated before it, whatever the state"
            ),
        }
    }

    /// The pivot of a constraint of which nothing is left whatever the state, as it follows from others: zero, beside what it could be.
    fn nothing_left(&mut self, k: usize, g: &mut Graph) -> Option<(Id, Id, Option<Id>)> {
        let reference = self.entries.get(&(k, k))?.reference(g);
        let reference = g.scale(self.sign(k), reference);
        if k < self.n || g.is_zero(reference) {
            return None;
        }
        self.droppable.insert(k);
        Some((g.zero(), reference, None))
    }

    /// Takes what the elimination of `single` leaves off its neighbours; `inverse` is one over its pivot.
    fn spread(&mut self, single: &Single, inverse: Id, g: &mut Graph) {
        for (p, (a, factor)) in single.factors.iter().enumerate() {
            for (b, entry) in &single.row[..=p] {
                let term = g.mul(*factor, *entry);
                // What a coordinate adds to constraints makes up G; all else is taken off a diagonal that stood before.
                let adds = single.at < self.n && *a >= self.n;
                if !adds || a != b {
                    self.take_off(*a, *b, term, !adds, g);
                    continue;
                }
                let own = self.entry(*a, single.at);
                let size = match own.size {
                    None => term,
                    Some(_) => {
                        let square = own.square(g);
                        g.mul(square, inverse)
                    }
                };
                self.entry_mut(*a, *a).take_off_sized(&[term], size);
            }
        }
    }
}
