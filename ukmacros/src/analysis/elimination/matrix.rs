//! K with symbolic entries, eliminated in a given order.

use super::dropping::reciprocal;
use super::rotation::{Turned, apart};
use super::{Divisor, Pair, Pivoting};
use crate::analysis::dynamics::Dynamics;
use crate::expr::{Graph, Id};
use std::collections::{BTreeMap, BTreeSet};

/// Longest chain of pivots whose divisions are put off. Their numerators are products of as many pivots, and must stay in the range of
/// numbers: with lengths of 1e-15 or 1e15 a constraint's pivot is 1e∓30, and its ninth power still has room.
const CHAIN: usize = 8;

/// K, with entries that are sums still open.
pub(super) struct Matrix {
    pub(super) n: usize,
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
    /// Of what took the place of two coordinates, how many rotations before it were not scaled.
    pub(super) turned: Vec<Option<usize>>,
    /// Whether what stands for different coordinates shares little inertia, whatever the state.
    pub(super) apart: bool,
    /// Whether what a pair leaves is computed once, with all its factors: many entries are made up of it.
    whole: bool,
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
    /// What the entry could be, where terms of its gram are themselves what is left of larger ones: of a diagonal the sum of these, of a
    /// coefficient of a constraint the sum of their squares.
    size: Option<Vec<(f64, Id)>>,
}

impl Entry {
    pub(super) fn of(id: Id) -> Self {
        Entry {
            gram: vec![(1.0, id)],
            ..Entry::default()
        }
    }

    /// A coefficient whose square the diagonal of its constraint has counted in.
    pub(super) fn counted(id: Id) -> Self {
        Entry {
            size: Some(Vec::new()),
            ..Entry::of(id)
        }
    }

    /// Takes terms off a diagonal that could be `size`.
    pub(super) fn take_off_sized(&mut self, terms: &[Id], size: Id) {
        if self.size.is_some() || terms != [size] {
            let gram = &self.gram;
            let sizes = self.size.get_or_insert_with(|| gram.clone());
            sizes.push((-1.0, size));
        }
        self.gram.extend(terms.iter().map(|term| (-1.0, *term)));
    }

    /// The value as an open sum, to be part of others.
    pub(super) fn open(&self, g: &mut Graph) -> Id {
        g.factored_sum(&[&self.gram[..], &self.schur].concat())
    }

    /// The value, with terms collected that have a factor in common: two rods at one joint have a difference of its coordinates.
    pub(super) fn collected(&self, g: &mut Graph) -> Id {
        let terms = [&self.gram[..], &self.schur].concat();
        let mut by_factor: BTreeMap<Id, Vec<(f64, Id)>> = BTreeMap::new();
        let mut rest = Vec::new();
        for (c, term) in terms {
            let (k, inner) = g.unscaled(term);
            match g.factors(inner)[..] {
                [(one, 1), (other, 1)] => {
                    let known = by_factor.contains_key(&other);
                    let (by, of) = if known { (other, one) } else { (one, other) };
                    by_factor.entry(by).or_default().push((c * k, of));
                }
                _ => rest.push((c, term)),
            }
        }
        for (by, of) in by_factor {
            let sum = g.sum(&of);
            rest.push((1.0, g.mul(by, sum)));
        }
        g.factored_sum(&rest)
    }

    /// What a diagonal could be: what it started from.
    pub(super) fn reference(&self, g: &mut Graph) -> Id {
        match &self.size {
            Some(size) => g.factored_sum(size),
            None => self.values(g).0,
        }
    }

    /// What the square of a coefficient could be.
    pub(super) fn square(&self, g: &mut Graph) -> Id {
        match &self.size {
            Some(size) => g.factored_sum(size),
            None => {
                let value = self.open(g);
                g.square(value)
            }
        }
    }

    /// Takes `term` off a coefficient, where the square of that could be `square`.
    fn substitute(&mut self, term: Id, square: Id, g: &mut Graph) {
        let before = self.square(g);
        self.gram.push((-1.0, term));
        let size = vec![(1.0, before), (1.0, square)];
        let value = self.open(g);
        let (value, sum) = (g.square(value), g.factored_sum(&size));
        let ((c, value), (least, sum)) = (g.unscaled(value), g.unscaled(sum));
        // What is added up without cancelling is as large as it could be.
        let plain = value == sum && c >= least;
        self.size = (!plain).then_some(size);
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
    Turned(Turned),
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
        whole: bool,
        g: &Graph,
    ) -> Self {
        let n = d.force.len();
        let size = n + d.rhs.len();
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
            entries,
            rows,
            deferred: vec![None; size],
            depth: vec![0; size],
            turn,
            droppable,
            turned: vec![None; n],
            apart: apart(&d.mass, g),
            whole,
        }
    }

    fn take_off(&mut self, a: usize, b: usize, term: Id, reduces: bool, g: &Graph) {
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

    /// Those entries of `k` with `others` that are not zero, as `value` gives them.
    fn row(
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
        names: &[String],
        g: &mut Graph,
        hints: &mut Vec<(Id, String)>,
    ) -> Result<(Factor, Vec<Divisor>), String> {
        Ok(match step {
            Pivoting::Rotation(rotation) => {
                let (turned, divisors) = self.rotate(rotation, names, g, hints)?;
                (Factor::Turned(turned), divisors)
            }
            Pivoting::Pair(pair) => {
                let double = self.eliminate_pair(pair, names, g)?;
                // Parameters may make it vanish, or all but cancel.
                let divisor = (!pair.coefficient.number).then(|| {
                    let entry = self.entry(pair.coordinate, pair.constraint);
                    let value = g.square(double.coefficient);
                    Divisor {
                        reference: entry.square(g),
                        ..Divisor::positive(pair.constraint, value, names)
                    }
                });
                (Factor::Double(double), divisor.into_iter().collect())
            }
            Pivoting::Single(k) => {
                let (single, divisor) = self.eliminate(k, names, g, hints)?;
                (Factor::Single(single), vec![divisor])
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
        let pivot = self.pivot(k, g).or_else(|| self.nothing_left(k, g));
        let (numerator, reference, denominator) =
            pivot.ok_or_else(|| vanished(k, self.n, names))?;
        let droppable = self.droppable.contains(&k);
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
        self.spread(&single, inverse, g);
        Ok((single, divisor))
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

    /// Eliminates a coordinate with a constraint, whose pivot P = [μ a; a 0] has P⁻¹ = [0 1/a; 1/a −μ/a²].
    fn eliminate_pair(
        &mut self,
        pair: Pair,
        names: &[String],
        g: &mut Graph,
    ) -> Result<Double, String> {
        let (j, c) = (pair.coordinate, pair.constraint);
        let (a, mu) = (self.entry(j, c).open(g), self.entry(j, j).open(g));
        if g.is_zero(a) || !g.uses(a).constant() {
            let (name, of) = (&names[j], &names[c]);
            return Err(format!("the coefficient of `{name}` in `{of}` vanishes"));
        }
        let largest = match self.entries.get(&(j, j)) {
            Some(entry) => entry.reference(g),
            None => mu,
        };
        if pair.massive {
            self.weigh(pair, mu, g);
        }
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

    /// Constraints remember that the coordinate of `pair`, of inertia `mu`, was theirs: where what gives it cannot move it, as a crank at its
    /// dead centre, all that is left of a constraint vanishes, and would else be compared with itself.
    fn weigh(&mut self, pair: Pair, mu: Id, g: &mut Graph) {
        let constraints = self.rows[pair.coordinate].range(self.n..).copied();
        let others: Vec<usize> = constraints.filter(|r| *r != pair.constraint).collect();
        for r in others {
            let square = self.entry(r, pair.coordinate).square(g);
            let size = g.div(square, mu);
            self.entry_mut(r, r).take_off_sized(&[], size);
        }
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
