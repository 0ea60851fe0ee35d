//! Rows of A that vanish by themselves on the way of a motion, as in the node of a figure of eight or at the apex of a cone.
//!
//! Such a row says nothing there of the motion, and its direction is reversed behind the place: along a smooth motion it goes through zero.
//! So it shows between two states of the motion, however far stages are from the place, while rows that turn without vanishing are told
//! from it by their length on the way. Rows are looked at before any of them can have changed by half of itself; that is at each step only
//! where steps are long.

use crate::assemble::State;
use crate::integrate::sample::Sample;
use crate::mechanism::Prepared;
use crate::zero::locate;

/// Rows are looked at again before they have changed by this share of themselves, going on as they did, and after this many times the time
/// since they were looked at last.
const CHANGE: f64 = 0.5;
const LONGEST: f64 = 16.0;

/// A row that keeps this share of its length on the way from one state to the other has turned, and not vanished.
const DIP: f64 = 0.25;

/// A row that is this share of what it has been is near to vanishing.
const SMALL: f64 = 1.0 / 32.0;

/// How far before the place where a row is least a search for the singular position begins, as a share of the step: there it has a
/// direction.
const BEFORE: f64 = 0.01;

/// A row that all but vanishes.
pub(super) struct Vanishing {
    pub(super) row: usize,
    /// Its largest entry where it was largest.
    pub(super) size: f64,
    /// A state of the motion near the place.
    pub(super) near: State,
    /// When the row is least, and what it is then as a share of its size.
    pub(super) t: f64,
    pub(super) least: f64,
    /// The least share of its size that it has at a state of the run.
    pub(super) reached: f64,
}

/// The rows of A along a run.
#[derive(Default)]
pub(super) struct RowWatch {
    /// The largest entry of each so far.
    sizes: Vec<f64>,
    /// A at the start of the step in hand or before it, and at the last state that was looked at.
    seen: Matrix,
    here: Matrix,
    /// When to look again.
    due: f64,
}

/// A at a time; there is none at NaN.
struct Matrix {
    t: f64,
    entries: Vec<f64>,
}

impl Default for Matrix {
    fn default() -> Self {
        let (t, entries) = (f64::NAN, Vec::new());
        Matrix { t, entries }
    }
}

impl Matrix {
    fn take(&mut self, mech: &Prepared, at: Sample<'_>) {
        if self.t == at.t {
            return;
        }
        self.t = at.t;
        self.entries.resize(at.q.len() * mech.spec().m(), 0.0);
        mech.jacobian(at.t, at.q, at.v, &mut self.entries);
    }
}

/// The entries of A that are not zero for all states, in two places: row and values.
fn entries<'a>(
    mech: &Prepared,
    [a, b]: [&'a Matrix; 2],
) -> impl Iterator<Item = (usize, f64, f64)> + use<'a> {
    let m = mech.spec().m();
    let pattern = mech.spec().structure.jacobian_pattern.iter();
    pattern.map(move |(c, i)| (*c, a.entries[i * m + c], b.entries[i * m + c]))
}

/// The largest entry of each row of A.
fn largest(mech: &Prepared, matrix: &Matrix) -> Vec<f64> {
    let mut largest = vec![0.0_f64; mech.spec().m()];
    for (c, a, _) in entries(mech, [matrix; 2]) {
        largest[c] = largest[c].max(a.abs());
    }
    largest
}

impl RowWatch {
    /// The row that vanishes on the step from `old` to `new`, or is all but zero at its end, if one does or is.
    pub(super) fn vanishing(
        &mut self,
        mech: &Prepared,
        old: Sample<'_>,
        new: Sample<'_>,
    ) -> Option<Vanishing> {
        let first = self.seen.t.is_nan();
        if mech.spec().m() == 0 || !first && (new.t - self.due) * (new.t - old.t) < 0.0 {
            return None;
        }
        if first {
            self.seen.take(mech, old);
            self.grow(mech);
        }
        self.here.take(mech, new);
        let mut rows = self.reversed(mech);
        if !rows.is_empty() {
            self.seen.take(mech, old);
            rows = self.reversed(mech);
        }
        let vanish = rows
            .into_iter()
            .filter_map(|c| self.least(mech, c, old, new));
        let first = vanish.min_by(|a, b| a.least.total_cmp(&b.least));
        first.or_else(|| self.smallest(mech, &self.here, new))
    }

    /// The row that is all but zero where the motion stands, if one is.
    pub(super) fn small(&mut self, mech: &Prepared, here: Sample<'_>) -> Option<Vanishing> {
        if self.sizes.is_empty() {
            return None;
        }
        self.seen.take(mech, here);
        self.smallest(mech, &self.seen, here)
    }

    /// The row of `matrix`, which is A at `here`, that is all but zero, if one is.
    fn smallest(&self, mech: &Prepared, matrix: &Matrix, here: Sample<'_>) -> Option<Vanishing> {
        let largest = largest(mech, matrix);
        let pairs = largest.iter().zip(&self.sizes).enumerate();
        let shares = pairs.map(|(row, (x, size))| (row, x / size, *size));
        let (row, least, size) = shares.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (least < SMALL).then(|| Vanishing {
            row,
            size,
            near: here.to_state(),
            t: here.t,
            least,
            reached: least,
        })
    }

    /// The run has got to the time `t`.
    pub(super) fn accept(&mut self, mech: &Prepared, t: f64) {
        if self.here.t != t || self.seen.t == t {
            return;
        }
        let mut changes = vec![0.0_f64; mech.spec().m()];
        for (c, a, b) in entries(mech, [&self.seen, &self.here]) {
            changes[c] = changes[c].max((a - b).abs());
        }
        let way = t - self.seen.t;
        std::mem::swap(&mut self.seen, &mut self.here);
        let largest = self.grow(mech);
        let pairs = changes.iter().zip(&largest);
        let change = pairs.fold(0.0, |most: f64, (change, x)| most.max(change / x));
        self.due = t + way * (CHANGE / change).min(LONGEST);
    }

    /// The largest entry of each row seen, which may be its largest so far.
    fn grow(&mut self, mech: &Prepared) -> Vec<f64> {
        let largest = largest(mech, &self.seen);
        self.sizes.resize(largest.len(), 0.0);
        let pairs = self.sizes.iter_mut().zip(&largest);
        pairs.for_each(|(size, x)| *size = size.max(*x));
        largest
    }

    /// The rows that have turned by more than a right angle.
    fn reversed(&self, mech: &Prepared) -> Vec<usize> {
        let mut products = vec![0.0; mech.spec().m()];
        for (c, a, b) in entries(mech, [&self.seen, &self.here]) {
            products[c] += a * b;
        }
        (0..products.len()).filter(|c| products[*c] < 0.0).collect()
    }

    /// Where row `c`, reversed on the way from `old` to `new`, goes through zero, if it does not only turn.
    fn least(
        &self,
        mech: &Prepared,
        c: usize,
        old: Sample<'_>,
        new: Sample<'_>,
    ) -> Option<Vanishing> {
        let m = mech.spec().m();
        let row = |matrix: &Matrix| -> Vec<f64> {
            matrix.entries.iter().skip(c).step_by(m).copied().collect()
        };
        let size = |row: &[f64]| row.iter().fold(0.0, |s: f64, x| s.max(x.abs()));
        let (before, after) = (row(&self.seen), row(&self.here));
        let mut between = Matrix::default();
        let mut along = |part: f64| {
            let state = between_states(old, new, part);
            between.take(mech, Sample::from(&state));
            (state, row(&between))
        };
        let turned = |part: f64| -> Result<f64, std::convert::Infallible> {
            let (_, row) = along(part);
            let pairs = row.iter().zip(before.iter().zip(&after));
            Ok(pairs.map(|(x, (a, b))| x * (b - a)).sum())
        };
        let Ok(part) = locate(turned, 0.0, 1.0);
        let (state, row) = along(part);
        let ends = size(&before).min(size(&after));
        let least = size(&row) / ends;
        (least < DIP).then(|| Vanishing {
            row: c,
            size: self.sizes[c],
            near: along((part - BEFORE).max(0.0)).0,
            t: state.t,
            least,
            reached: ends / self.sizes[c],
        })
    }
}

/// The state at a part of the step from `old` to `new`, on the cubics through both.
fn between_states(old: Sample<'_>, new: Sample<'_>, part: f64) -> State {
    let h = new.t - old.t;
    let rest = 1.0 - part;
    let mut state = State {
        t: old.t + part * h,
        q: Vec::with_capacity(old.q.len()),
        v: Vec::with_capacity(old.q.len()),
    };
    for i in 0..old.q.len() {
        let (v0, v1, change) = (old.v[i], new.v[i], new.q[i] - old.q[i]);
        // The chord, and what the velocities at both ends add to it.
        let (a, b) = (v0 * h - change, change - v1 * h);
        let (bend, slope) = (a * rest + b * part, change / h);
        state.q.push(old.q[i] + part * change + part * rest * bend);
        state
            .v
            .push(slope + ((1.0 - 2.0 * part) * bend + part * rest * (b - a)) / h);
    }
    state
}
