//! Rows that may follow from those before them: left out at states where they do.
//!
//! Let row k, in the metric of M and of length √G, keep √d beside the span of the rows eliminated before it, and let R be what it asks for
//! beyond what they do: R = b_k − a_k q̈⁰ with q̈⁰ the accelerations without it. With it they would be q̈⁰ + (R/d) M⁻¹ rᵀ, where r, |r|² =
//! d, is what a_k keeps: a change of R/√d in the mass metric. Without it, its multiplier is 0, and what is left of A q̈ = b is R.
//!
//! - Where the row follows from the others d and R are zero, and both accelerations are the same. Computed, d/G is a few ε over the least
//!   share that was accepted: [`NOTHING`] is above. R is compared with what accelerations are, N² = Σ M_ii q̈_i² + Q_i²/M_ii over all
//!   coordinates that are coupled to the row, and with its b: R ≤ [`MET`] √(G N² + b²) is what any row that counts is met to. R/√d is then
//!   bounded where d tells anything; where d is too small to tell, whoever asks has the rank decided once by the dense solve.
//! - At a distance δ from the constraints redundant rows keep √d of order δ, and R is of order δ: both are what drift lends. (For φ_k = Σ
//!   μ_j φ_j, as holds near states that are regular in the other rows, the row keeps Σ φ_j ∇μ_j, and R is Σ 2 μ̇_j φ̇_j + μ̈_j φ_j.)
//!   Accelerations without the row go on smoothly there; that its constraint is met is for the projection to show, which checks the rows
//!   left out as all others; the certificate says so, by [`DRIFTED`]. What drift is granted is bounded: d/G by [`SAFE_SHARE`], above which
//!   the row counts, and R by [`GRANTED`].
//!
//! Of rows that imply each other any may be the one too many, and which of them keeps least may change along a motion (the crank of an
//! elliptic trammel is needed nowhere, but alone it has dead centres): so each of them may be left out. How many are left out is what
//! counts, and the certificate tells it: as long as they are as many as follow from the others, all that is kept is independent, to
//! [`SAFE_SHARE`], and has as many rows as the rank. At a singular position they are more.

use super::certificate::{MET, SAFE_SHARE};
use super::matrix::Factor;
use super::solution::{Forward, Solution};
use crate::analysis::dynamics::Dynamics;
use crate::analysis::groups::Groups;
use crate::expr::{Func, Graph, Id, Random};
use std::collections::BTreeMap;

/// A share d/G of a row that is nothing but rounding: (n + m) ε/[`SAFE_SHARE`] for some sixty rows and coordinates.
const NOTHING: f64 = 1.5e-11;
/// What drift may lend R, as a share of √(G N² + b²), squared.
const GRANTED: f64 = 1.0 / 16.0;
/// What a certificate loses for each row that was left out, so that it tells how many there are; exact for some hundreds.
const DROPPED: f64 = 1.0 / 1024.0;
/// What it loses where that is more than rounding of one of them.
const DRIFTED: f64 = 0.5;

/// A row that may be left out, and the state of its elimination.
#[derive(Clone)]
pub(super) struct Dropping {
    /// The position of the row.
    pub(super) at: usize,
    /// d, but for a row whose pivot is zero whatever the state.
    pivot: Option<Id>,
    /// G.
    reference: Id,
    /// R.
    right: Id,
    /// G N² + b².
    size: Id,
}

/// 1/`pivot`, or 0 where that is so small a share of `reference` that its row may be left out.
pub(super) fn reciprocal(pivot: Id, reference: Id, g: &mut Graph) -> Id {
    let zero = g.zero();
    if g.is_zero(pivot) {
        return zero;
    }
    let least = g.scale(SAFE_SHARE, reference);
    let inverse = g.pow(pivot, -1);
    g.select(least, pivot, inverse, zero)
}

/// The least that the pivot of a row that may be left out has to be.
pub(super) fn least(reference: Id, g: &mut Graph) -> Id {
    g.scale(-NOTHING, reference)
}

/// What there is to check of the rows that may be left out, where `motion` solves the equations of `d`.
pub(super) fn droppings(
    factors: &[Factor],
    motion: &Solution,
    d: &Dynamics,
    g: &mut Graph,
) -> Vec<Dropping> {
    let n = d.force.len();
    let steps = factors.iter().zip(&motion.rights);
    let singles = steps.filter_map(|step| match step {
        (Factor::Single(single), Some(right)) => Some((single, right)),
        _ => None,
    });
    let dropped: Vec<_> = singles.filter(|(s, _)| s.reciprocal.is_some()).collect();
    if dropped.is_empty() {
        return Vec::new();
    }
    // N² of each part.
    let mut parts = parts(factors, n + d.rhs.len());
    let mut squares: BTreeMap<usize, Vec<(f64, Id)>> = BTreeMap::new();
    for (i, (x, q)) in motion.coordinates.iter().zip(&d.force).enumerate() {
        if let Some(m) = d.mass.get(&(i, i)) {
            let done = g.product(&[(*x, 2), (*m, 1)]);
            let free = g.product(&[(*q, 2), (*m, -1)]);
            let part = squares.entry(parts.of(i)).or_default();
            part.extend([(1.0, done), (1.0, free)]);
        }
    }
    let dropped = dropped.into_iter().map(|(single, right)| {
        let squares = squares.get(&parts.of(single.at));
        let square = g.sum(squares.map_or(&[], |squares| squares));
        let own = g.square(d.rhs[single.at - n]);
        let size = g.mul(single.reference, square);
        Dropping {
            at: single.at,
            pivot: (!g.is_zero(single.numerator)).then_some(single.numerator),
            reference: single.reference,
            right: *right,
            size: g.add(size, own),
        }
    });
    dropped.collect()
}

/// The square of the length of each constraint's row of `d`, in units of inertia.
pub(super) fn squares(d: &Dynamics, g: &mut Graph) -> Vec<Id> {
    let mut squares: Vec<Vec<(f64, Id)>> = vec![Vec::new(); d.rhs.len()];
    for ((row, i), a) in &d.jacobian {
        if let Some(mass) = d.mass.get(&(*i, *i)) {
            squares[*row].push((1.0, g.product(&[(*a, 2), (*mass, -1)])));
        }
    }
    squares.iter().map(|terms| g.sum(terms)).collect()
}

/// Multipliers without forces, over the `scales` of their rows: what the rows left out follow from.
///
/// Of a row k that is left out K, of `n` coordinates, has a null vector: with 1 for its multiplier, back substitution alone gives the
/// others of Σ λ_j a_j = 0. All rows that are left out are taken at once, in shares that no structure makes cancel: a multiplier that has
/// nothing of it is the same however the others share their load. `squares` are those of the mechanism's own rows.
pub(super) fn kernel(
    factors: &[Factor],
    n: usize,
    scales: &[f64],
    squares: &[Id],
    names: &[String],
    g: &mut Graph,
) -> Result<Vec<Id>, String> {
    let zero = g.zero();
    let mut kernel = Forward::new(&vec![zero; n], &vec![zero; scales.len()]);
    let mut random = Random::new(3);
    for factor in factors {
        kernel.step(factor, g);
        if let Factor::Single(single) = factor
            && single.reciprocal.is_some()
        {
            let row = single.at - n;
            let weight = g.constant(scales[row] * random.positive());
            let length = g.call1(Func::Sqrt, squares[row]);
            let mut own = g.div(weight, length);
            if !g.is_zero(single.numerator) {
                let counts = g.scale(SAFE_SHARE, single.reference);
                own = g.select(counts, single.numerator, zero, own);
            }
            kernel.begin(own);
        }
    }
    let found = kernel.solution(factors, true, names, g, &mut Vec::new())?;
    Ok(found.constraints)
}

/// The share of each constraint in what the rows left out follow from, squared: its part of the `kernel`, compared with what a row of its
/// length could be; `None` where it has none that could be measured.
pub(super) fn shares(kernel: &[Id], squares: &[Id], g: &mut Graph) -> Vec<Option<Id>> {
    let shares = kernel.iter().zip(squares).map(|(x, square)| {
        let share = g.product(&[(*x, 2), (*square, 1)]);
        (g.is_zero(*x) || !g.is_zero(*square)).then_some(share)
    });
    shares.collect()
}

/// The parts of the mechanism that positions, so many, are in: parts are not coupled.
fn parts(factors: &[Factor], positions: usize) -> Groups {
    let mut parts = Groups::new(positions);
    let mut join = |at: usize, touched: &mut dyn Iterator<Item = usize>| {
        touched.for_each(|other| parts.join(at, other));
    };
    for factor in factors {
        match factor {
            Factor::Single(single) => join(single.at, &mut single.row.iter().map(|(a, _)| *a)),
            Factor::Double(double) => {
                let touched = double.touched.iter().map(|touched| touched.at);
                let own = [double.pair.constraint].into_iter();
                join(double.pair.coordinate, &mut own.chain(touched));
            }
            Factor::Turned(turned) => {
                let own = turned.rotation.coordinates.into_iter();
                let touched = turned.touched.iter().map(|(at, _)| *at);
                join(turned.rotation.constraint, &mut own.chain(touched));
            }
        }
    }
    parts
}

impl Dropping {
    /// 1 where the row is left out, else 0.
    pub(super) fn left_out(&self, g: &mut Graph) -> Id {
        let (zero, one) = (g.zero(), g.one());
        let Some(pivot) = self.pivot else {
            return one;
        };
        let counts = g.scale(SAFE_SHARE, self.reference);
        g.select(counts, pivot, zero, one)
    }

    /// `safe`, or what is left of it where the row is left out.
    pub(super) fn allows(&self, safe: Id, g: &mut Graph) -> Id {
        let zero = g.zero();
        if self.pivot.is_none() && g.is_zero(self.right) {
            // 0 q̈ = 0, whatever the state.
            return safe;
        }
        let square = g.square(self.right);
        let [dropped, drift, half] = [DROPPED, DRIFTED, 0.5].map(|x| g.constant(x));
        let rounded = g.sub(safe, dropped);
        let drifted = g.sub(rounded, drift);
        let drifted = g.select(safe, half, rounded, drifted);
        let bounded = g.scale(GRANTED, self.size);
        let drifted = g.select(square, bounded, drifted, zero);
        let met = g.scale(MET * MET, self.size);
        let dropped = g.select(square, met, rounded, drifted);
        let Some(pivot) = self.pivot else {
            return dropped;
        };
        let nothing = g.scale(NOTHING, self.reference);
        let dropped = g.select(pivot, nothing, dropped, drifted);
        let counts = g.scale(SAFE_SHARE, self.reference);
        g.select(counts, pivot, safe, dropped)
    }
}
