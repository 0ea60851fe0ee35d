//! What counts as zero.

use crate::lanes::Lanes;
use crate::scan::{excess, excess_by, largest_by, or_one};

/// A residual is at rounding level if it does not exceed this many ε of the size Σ|A_ij q_j| of what q's own rounding contributes:
/// one for q, one or two for the evaluation of φ.
pub(super) const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A residual that no step makes less will do if it does not exceed this many ε of the rounding that evaluating it carries, where
/// coordinates are known to rounding of the largest of them: terms that cancel, or constraints that nearly lose rank, can keep it above
/// [`ROUNDING`]. Lengths of links among coordinates thirty times as large still hold to 1e-12.
pub(crate) const STALLED: f64 = 64.0 * f64::EPSILON;

/// The largest coordinate counts into the size of every constraint's terms with this share: a coordinate that the constraints put
/// to zero takes rounding errors from the others through the solve, and has no size of its own to measure them by. The share is
/// small because coordinates of one unit need not be of one size.
pub(super) const NEIGHBOUR: f64 = 1e-4;

/// What coordinates that are zero themselves are measured by: the others.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Size<L> {
    /// max|x_j|, of coordinates of different units by these.
    pub(super) largest: L,
    /// max|x_j|/inertial_j, where inertias count.
    even: L,
}

impl Size<f64> {
    pub(super) fn larger(self, other: Self) -> Self {
        Size {
            largest: self.largest.max(other.largest),
            even: self.even.max(other.even),
        }
    }
}

/// Sizes of the constraints' terms at a place x, and with them the residuals that count as zero there.
#[derive(Debug, Clone)]
pub(crate) struct Acceptance<L> {
    /// How readily coordinates move in a search; empty where inertia alone says it.
    pub(super) ease: Vec<f64>,
    /// How readily coordinates move by their inertias: coordinates of one unit need not be of one size, which these may tell. Empty where
    /// `ease` is.
    pub(super) inertial: Vec<f64>,
    /// What makes coordinates of different units comparable; empty where all are of one unit.
    pub(super) units: Vec<f64>,
    /// Coordinates that do not move at all.
    pub(super) held: Vec<usize>,
    /// What coordinates that are zero themselves are measured by: the size of x where the search began.
    pub(super) size: Size<L>,
    /// Σ|A_cj| (|x_j| + [`NEIGHBOUR`] size).
    terms: Vec<L>,
    /// max|A_cj|, of coordinates of different units by these.
    entries: Vec<L>,
    /// What rounding the evaluation of each residual carries, in units of ε.
    pub(super) rounding: Vec<f64>,
}

impl<L: Lanes> Acceptance<L> {
    /// Buffers for `m` constraints.
    pub(super) fn new(m: usize) -> Self {
        let zero = L::from_f64(0.0);
        Acceptance {
            ease: Vec::new(),
            inertial: Vec::new(),
            units: Vec::new(),
            held: Vec::new(),
            size: Size {
                largest: zero,
                even: zero,
            },
            terms: vec![zero; m],
            entries: vec![zero; m],
            rounding: vec![0.0; m],
        }
    }

    /// Takes the sizes at `x`, where A has the entries `jacobian`.
    pub(super) fn weigh(&mut self, pattern: &[(usize, usize)], jacobian: &[L], x: &[L]) {
        let (m, zero) = (self.terms.len(), L::from_f64(0.0));
        self.terms.fill(zero);
        self.entries.fill(zero);
        for &(c, j) in pattern {
            let unit = self.units.get(j).unwrap_or(&1.0);
            let least = L::from_f64(NEIGHBOUR) * self.least(self.size, j);
            let entry = jacobian[j * m + c].abs();
            self.terms[c] = self.terms[c] + entry * (x[j].abs() + least);
            self.entries[c] = (L::from_f64(*unit) * entry).larger(self.entries[c]);
        }
    }

    /// The size of `x`.
    #[inline]
    pub(super) fn measured(&self, x: &[L]) -> Size<L> {
        let largest = self.largest(x);
        let even = match self.inertial.is_empty() {
            true => largest,
            false => largest_by(x, &self.inertial),
        };
        Size { largest, even }
    }

    /// What coordinate j is measured by beside coordinates of this size.
    pub(super) fn least(&self, size: Size<L>, j: usize) -> L {
        let by = |units: &[f64], size: L| L::from_f64(*units.get(j).unwrap_or(&1.0)) * size;
        let largest = by(&self.units, size.largest);
        match self.inertial.is_empty() {
            true => largest,
            false => largest.min(by(&self.inertial, size.even)),
        }
    }

    /// max|x|, of coordinates of different units by these: the size of coordinates, or of their changes.
    #[inline]
    pub(super) fn largest(&self, x: &[L]) -> L {
        largest_by(x, &self.units)
    }

    /// 0 where each change in `d` is at most `share` of x and of [`NEIGHBOUR`] of the size, or of none, else more.
    #[inline]
    pub(super) fn excess(&self, d: &[L], x: &[L], share: L, exact: bool) -> L {
        let neighbour = L::from_f64(if exact { 0.0 } else { NEIGHBOUR });
        match self.units.is_empty() {
            true => excess(d, x, share, neighbour * self.size.largest),
            false => excess_by(d, x, share, neighbour * self.size.largest, &self.units),
        }
    }

    /// 1 in the lanes where every residual is at rounding level, 0 in the others.
    pub(super) fn strict(&self, residual: &[L]) -> L {
        let mut met = L::from_f64(1.0);
        for (c, r) in residual.iter().enumerate() {
            met = L::select_le(r.abs(), self.bound(c), met, L::from_f64(0.0));
        }
        met
    }

    /// The largest residual of constraint `c` at rounding level.
    pub(super) fn bound(&self, c: usize) -> L {
        L::from_f64(ROUNDING) * self.terms[c]
    }
}

impl Acceptance<f64> {
    /// max|A_cj|, or 1 for a row of zeros, which has no scale.
    pub(super) fn scale(&self, c: usize) -> f64 {
        or_one(self.entries[c])
    }

    /// How far off the constraints `rows` x is, by its size: the largest |φ_c| / max|A_cj| of those not at rounding level; NaN where
    /// one is not a number.
    pub(super) fn distance(&self, rows: impl Iterator<Item = usize>, residuals: &[f64]) -> f64 {
        rows.map(|c| (c, residuals[c]))
            .filter(|(c, r)| r.is_nan() || r.abs() > ROUNDING * self.terms[*c])
            .map(|(c, r)| r.abs() / self.scale(c))
            .fold(0.0, |most: f64, off| match most.is_nan() || off <= most {
                true => most,
                false => off,
            })
    }

    /// The constraints among `rows` whose `residuals` would not do even where no step makes them less.
    pub(super) fn violated(
        &self,
        rows: impl Iterator<Item = usize>,
        residuals: &[f64],
    ) -> impl Iterator<Item = usize> {
        let bound = |c: usize| (STALLED * self.rounding[c]).max(ROUNDING * self.terms[c]);
        rows.filter(move |c| residuals[*c].is_nan() || residuals[*c].abs() > bound(*c))
    }

    /// Takes off `residuals` what rounding makes of them.
    pub(super) fn clear(&self, residuals: &mut [f64]) {
        for (r, size) in residuals.iter_mut().zip(&self.rounding) {
            *r -= r.clamp(-STALLED * size, STALLED * size);
        }
    }

    /// The largest length in the constraints `rows`, by the size of x: the rounding of a residual as the change of a coordinate that makes
    /// it.
    pub(super) fn length(&self, rows: impl Iterator<Item = usize>) -> f64 {
        rows.filter(|c| self.entries[*c] > 0.0)
            .map(|c| self.rounding[c] / self.entries[c])
            .fold(0.0, f64::max)
    }
}
