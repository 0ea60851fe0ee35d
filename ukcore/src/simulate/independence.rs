//! Whether rows of A that are independent at one state stay so on the way to another.
//!
//! A Cholesky factorisation of the symmetric part S of A₀ W A₁ᵀ, with A at both states and any positive W, tells: by what
//! [`none_vanishes`](crate::displacements::none_vanishes) says. Here it is sparse.

use std::collections::BTreeSet;

use crate::mechanism::Prepared;
use crate::pinv::Decomposition;
use crate::scan::or_one;

/// Pivots of a factorisation below this share of their diagonals are of rows that the others imply.
const IMPLIED: f64 = 1e-3;

/// Entries of A, squared, above this share of the largest before in their column are weighed anew.
const WEIGHTY: f64 = 4.0;

/// The factorisation, in an order of rows that keeps it sparse.
#[derive(Debug, Clone)]
pub(super) struct Independence {
    /// W.
    weights: Vec<f64>,
    /// 1 over the largest entries of rows where the run began.
    scales: Vec<f64>,
    /// Rows that others do not imply.
    counts: Vec<bool>,
    /// Whether none is left out.
    pub(super) whole: bool,
    /// The lower triangle: for each term of S its place, its entries of A and its coordinate.
    terms: Vec<[u32; 4]>,
    /// Rows in the order of elimination, and where their columns of the factor begin and end.
    columns: Vec<Column>,
    /// Places that the elimination of a column changes, one column after the other.
    changed: Vec<u32>,
    /// The entries of S, then of its factor; the diagonal of S in the order of elimination.
    values: Vec<f64>,
    own: Vec<f64>,
}

/// A column of the factor: the row, its place on the diagonal, and where the others end.
#[derive(Debug, Clone)]
struct Column {
    row: usize,
    diagonal: usize,
    end: usize,
}

impl Independence {
    /// The rows among some `rows` of A (column-major) that others do not imply at a state; `None` if there are fewer than two.
    pub(super) fn new(mech: &Prepared, jacobian: &[f64], rows: Vec<bool>) -> Option<Self> {
        let m = mech.spec().m();
        let mut all = Independence {
            weights: vec![0.0; mech.spec().n()],
            scales: vec![0.0; m],
            counts: rows,
            whole: true,
            terms: Vec::new(),
            columns: Vec::new(),
            changed: Vec::new(),
            values: Vec::new(),
            own: Vec::new(),
        };
        for (c, i) in mech.spec().structure.jacobian_pattern {
            all.scales[*c] = jacobian[i * m + c].abs().max(all.scales[*c]);
        }
        let size = |x: &mut f64| *x = if *x > 0.0 { x.recip() } else { 1.0 };
        all.scales.iter_mut().for_each(size);
        all.weigh(mech, jacobian);
        all.arrange(mech);
        all.load(jacobian, jacobian);
        all.whole = all.imply();
        if !all.whole {
            all.arrange(mech);
        }
        (all.columns.len() > 1).then_some(all)
    }

    /// Takes W such that no coordinate's entries hide those of others, whatever the units of both, nor one row's those of another. Entries
    /// that are larger than all before count from now on.
    pub(super) fn weigh(&mut self, mech: &Prepared, jacobian: &[f64]) {
        let m = self.counts.len();
        let pattern = mech.spec().structure.jacobian_pattern;
        for (c, i) in pattern {
            let share = (jacobian[i * m + c] * self.scales[*c]).abs();
            let weight = &mut self.weights[*i];
            if share > 0.0 && (*weight == 0.0 || share * share * *weight > WEIGHTY) {
                *weight = (share * share).recip();
            }
        }
    }

    /// Chooses the order of elimination, by least degree, and finds the places of the factor.
    fn arrange(&mut self, mech: &Prepared) {
        let (n, m) = (mech.spec().n(), mech.spec().m());
        let mut rows: Vec<Vec<usize>> = vec![Vec::new(); n];
        for (c, i) in mech.spec().structure.jacobian_pattern {
            if self.counts[*c] {
                rows[*i].push(*c);
            }
        }
        // The rows that each shares a coordinate with.
        let mut beside = vec![BTreeSet::new(); m];
        for column in &rows {
            for c in column {
                beside[*c].extend(column.iter().filter(|d| *d != c));
            }
        }
        let mut left: Vec<usize> = (0..m).filter(|c| self.counts[*c]).collect();
        let mut places = vec![u32::MAX; m * m];
        let mut parts = Vec::with_capacity(left.len());
        self.columns.clear();
        let mut end = 0;
        while let Some(next) = (0..left.len()).min_by_key(|k| beside[left[*k]].len()) {
            let row = left.swap_remove(next);
            let part: Vec<usize> = std::mem::take(&mut beside[row]).into_iter().collect();
            let diagonal = end;
            places[row * m + row] = diagonal as u32;
            for (k, c) in part.iter().enumerate() {
                (places[row * m + c], places[c * m + row]) =
                    ((end + 1 + k) as u32, (end + 1 + k) as u32);
                beside[*c].extend(part.iter().filter(|d| *d != c));
                beside[*c].remove(&row);
            }
            end += 1 + part.len();
            self.columns.push(Column { row, diagonal, end });
            parts.push(part);
        }
        self.values = vec![0.0; end];
        let place = |c: usize, d: usize| places[c * m + d];
        self.changed.clear();
        for part in &parts {
            for (k, c) in part.iter().enumerate() {
                self.changed
                    .extend(part[..=k].iter().map(|d| place(*c, *d)));
            }
        }
        self.terms.clear();
        for (i, column) in rows.iter().enumerate() {
            for (k, c) in column.iter().enumerate() {
                let entry = |d: usize| (i * m + d) as u32;
                let terms = column[..=k]
                    .iter()
                    .map(|d| [place(*c, *d), entry(*c), entry(*d), i as u32]);
                self.terms.extend(terms);
            }
        }
    }

    /// Loads 2 S.
    fn load(&mut self, a: &[f64], b: &[f64]) {
        self.values.fill(0.0);
        for [place, c, d, i] in &self.terms {
            let (c, d) = (*c as usize, *d as usize);
            self.values[*place as usize] += self.weights[*i as usize] * (a[c] * b[d] + b[c] * a[d]);
        }
        self.own.clear();
        let diagonal = self
            .columns
            .iter()
            .map(|column| self.values[column.diagonal]);
        self.own.extend(diagonal);
    }

    /// Leaves out the rows whose pivots say that others imply them. Returns whether there were none.
    fn imply(&mut self) -> bool {
        let mut counts = std::mem::take(&mut self.counts);
        let mut none = true;
        self.eliminate(|row, pivot, own| {
            counts[row] = pivot > IMPLIED * own;
            none &= counts[row];
            Some(counts[row])
        });
        self.counts = counts;
        none
    }

    /// Eliminates S column by column, but for those that `judge` leaves out by their row, their pivot and what it was; until it gives none.
    fn eliminate(&mut self, mut judge: impl FnMut(usize, f64, f64) -> Option<bool>) -> Option<()> {
        let mut changed = &self.changed[..];
        for (Column { row, diagonal, end }, own) in self.columns.iter().zip(&self.own) {
            let part = end - diagonal - 1;
            let (mine, rest) = changed.split_at(part * (part + 1) / 2);
            changed = rest;
            if judge(*row, self.values[*diagonal], *own)? {
                eliminate(&mut self.values, *diagonal, *end, mine);
            }
        }
        Some(())
    }

    /// The least part of a row, as a share of its length, that those eliminated before it do not have, for A at a state.
    pub(super) fn left(&mut self, a: &[f64]) -> f64 {
        self.share(a, a).unwrap_or(0.0).sqrt()
    }

    /// The least share that a pivot of S, for A at two states, has of its diagonal; `None` if S is not positive definite.
    pub(super) fn share(&mut self, a: &[f64], b: &[f64]) -> Option<f64> {
        self.load(a, b);
        let mut least = 1.0_f64;
        self.eliminate(|_, pivot, own| {
            least = least.min(pivot / own);
            (pivot > 0.0).then_some(true)
        })?;
        Some(least)
    }
}

/// How many of the `m` rows of A (column-major) have more than `floor` beside each other.
pub(super) fn counting(a: &[f64], m: usize, floor: f64) -> usize {
    let n = a.len() / m;
    let mut system = Decomposition::new(m, n);
    let rows = system.load(m).chunks_exact_mut(n).enumerate();
    for (c, row) in rows {
        let entries = a.iter().skip(c).step_by(m);
        let size = entries.clone().fold(0.0_f64, |most, x| most.max(x.abs()));
        let pairs = row.iter_mut().zip(entries);
        pairs.for_each(|(x, a)| *x = a / or_one(size));
    }
    system.factor(&vec![1.0; n], &vec![1.0; m], floor);
    system.pivots().len()
}

/// Eliminates the column with this diagonal, which changes these places.
#[inline]
fn eliminate(values: &mut [f64], diagonal: usize, end: usize, changed: &[u32]) {
    let inverse = values[diagonal].recip();
    let mut changed = changed.iter();
    for c in diagonal + 1..end {
        let share = values[c] * inverse;
        for d in diagonal + 1..=c {
            let product = share * values[d];
            if let Some(place) = changed.next() {
                values[*place as usize] -= product;
            }
        }
    }
}
