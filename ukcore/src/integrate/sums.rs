//! The sums of a Runge-Kutta step over all components, for any scalar. Written so that they become vector instructions where the scalar is
//! one lane.

use crate::scalar::Scalar;

/// Sums over components are added up in so many parts, so that not every addition waits for the one before.
const PARTS: usize = 4;

/// Rows k and factors h c of `terms` = (row, c).
#[inline(always)]
fn rows<'a, S: Scalar, const N: usize>(
    n: usize,
    h: S,
    rates: &'a [S],
    terms: &[(usize, f64); N],
) -> ([&'a [S]; N], [S; N]) {
    // Loops, since `map` of arrays of this length is not inlined.
    let (mut k, mut c) = ([&rates[..n]; N], [h; N]);
    for j in 0..N {
        let (row, factor) = terms[j];
        k[j] = &rates[row * n..][..n];
        c[j] = h * S::from_f64(factor);
    }
    (k, c)
}

/// Σ c k of component `i`.
#[inline(always)]
fn dot<S: Scalar, const N: usize>(c: &[S; N], k: &[&[S]; N], i: usize) -> S {
    let mut sum = c[0] * k[0][i];
    for j in 1..N {
        sum = sum + c[j] * k[j][i];
    }
    sum
}

/// `out` = `base` + h Σ c k over rows k of `rates`; without a base h Σ c k.
#[inline(always)]
pub(super) fn sum<S: Scalar, const N: usize>(
    out: &mut [S],
    base: Option<&[S]>,
    h: S,
    rates: &[S],
    terms: &[(usize, f64); N],
) {
    let n = out.len();
    let (k, c) = rows(n, h, rates, terms);
    if let Some(base) = base {
        for (i, (out, base)) in out.iter_mut().zip(&base[..n]).enumerate() {
            *out = *base + dot(&c, &k, i);
        }
    } else {
        for (i, out) in out.iter_mut().enumerate() {
            *out = dot(&c, &k, i);
        }
    }
}

/// What error is allowed in each component: relative · (its size + its floor), so that relative · floor is its absolute tolerance.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tolerance<S = f64> {
    pub(crate) relative: f64,
    /// The floor of each component in its unit: the size that a component near zero is measured by.
    pub(crate) floors: Vec<S>,
}

impl<S: Scalar> Tolerance<S> {
    /// The error that is allowed in component `i`, of this size.
    #[inline(always)]
    pub(crate) fn at(&self, i: usize, size: S) -> S {
        S::from_f64(self.relative) * (self.floors[i] + size)
    }
}

impl Tolerance {
    /// The largest difference of these components, the first of which is `first`, over what is allowed where each has the size of the
    /// largest, by the floors: one that is small is no more exact than others.
    pub(crate) fn excess(&self, first: usize, old: &[f64], new: &[f64]) -> f64 {
        let (mut size, mut change) = (0.0_f64, 0.0_f64);
        for ((old, new), floor) in old.iter().zip(new).zip(self.floors.iter().skip(first)) {
            size = size.max(old.abs().max(new.abs()) / floor);
            change = change.max((new - old).abs() / floor);
        }
        change / (self.relative * (1.0 + size))
    }
}

/// x + `change`, and what rounding takes from it; exact where |change| ≤ |x|. (Kahan's summation; Hairer, Lubich & Wanner, *Geometric
/// Numerical Integration*, §VIII.5.)
#[inline(always)]
pub(super) fn keeping<S: Scalar>(x: S, change: S) -> (S, S) {
    let new = x + change;
    (new, change - (new - x))
}

/// `out` = 1 / tolerance at max(|old|, |new|), the weights of the [error norm](super).
pub(super) fn weights<S: Scalar>(out: &mut [S], old: &[S], new: &[S], tolerance: &Tolerance<S>) {
    let relative = S::from_f64(tolerance.relative);
    let states = old.iter().zip(new).zip(&tolerance.floors);
    for (out, ((old, new), floor)) in out.iter_mut().zip(states) {
        *out = (relative * (*floor + old.abs().max(new.abs()))).recip();
    }
}

/// Σ (x w)² over all components.
pub(super) fn sum_of_squares<S: Scalar>(x: &[S], weights: &[S]) -> S {
    let mut sums = [S::from_f64(0.0); PARTS];
    let (chunks, rest) = x.as_chunks::<PARTS>();
    let (weight_chunks, weight_rest) = weights.as_chunks::<PARTS>();
    for (x, w) in chunks.iter().zip(weight_chunks) {
        for part in 0..PARTS {
            let weighted = x[part] * w[part];
            sums[part] = sums[part] + weighted * weighted;
        }
    }
    for (x, w) in rest.iter().zip(weight_rest) {
        let weighted = *x * *w;
        sums[0] = sums[0] + weighted * weighted;
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// Gives `error`, of a step between these states, the size `norm` in the error norm; 0 stays 0.
pub(crate) fn sized(error: &mut [f64], states: [&[f64]; 2], tolerance: &Tolerance, norm: f64) {
    let size = projection_norm(error.iter().copied(), states, tolerance);
    let factor = if size > 0.0 { norm / size } else { 0.0 };
    error.iter_mut().for_each(|error| *error *= factor);
}

/// The norm of `change`, which a projection makes of `raw`, the end of a step that begins at `old`.
pub(crate) fn projection_norm<S: Scalar>(
    change: impl Iterator<Item = S>,
    [old, raw]: [&[S]; 2],
    tolerance: &Tolerance<S>,
) -> S {
    let states = old.iter().zip(raw);
    let change = change.zip(states).map(|(d, (old, raw))| (d, *old, *raw));
    error_norm(change, tolerance)
}

/// Root mean square of change / tolerance at max(|y_old|, |y_new|) of triples (change, y_old, y_new): the norm in which the methods measure
/// their error.
pub(crate) fn error_norm<S: Scalar>(
    change: impl Iterator<Item = (S, S, S)>,
    tolerance: &Tolerance<S>,
) -> S {
    let (mut sum, mut count) = (S::from_f64(0.0), 0.0_f64);
    for (i, (delta, old, new)) in change.enumerate() {
        let weighted = delta / tolerance.at(i, old.abs().max(new.abs()));
        sum = sum + weighted * weighted;
        count += 1.0;
    }
    (sum / S::from_f64(count.max(1.0))).sqrt()
}
