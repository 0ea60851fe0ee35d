//! Passes over vectors that become vector instructions: sums and maxima in several parts, so that not every operation waits for the one
//! before.

use crate::scalar::Scalar;

/// Whether all numbers are finite. A sum is finite only if all its terms are; where it is not, it may have overflowed, and each is looked
/// at.
#[inline]
pub(crate) fn all_finite(x: &[f64]) -> bool {
    sum(x).is_finite() || x.iter().all(|x| x.is_finite())
}

/// Σ x.
#[inline]
pub(crate) fn sum<S: Scalar>(x: &[S]) -> S {
    reduce(x, x, |x, _| x, |s, x| s + x)
}

/// max|x|, 0 of none. Passes over NaN in an `f64`.
#[inline]
pub(crate) fn largest<S: Scalar>(x: &[S]) -> S {
    reduce(x, x, |x, _| x.abs(), |s, x| x.larger(s))
}

/// The place where |x| is largest, first; 0 of none.
pub(crate) fn place_of_largest(x: &[f64]) -> usize {
    (0..x.len()).fold(0, |b, i| if x[i].abs() > x[b].abs() { i } else { b })
}

/// max|x_j|/unit_j, 0 of none; all units are 1 where there are none. Passes over NaN in an `f64`.
#[inline]
pub(crate) fn largest_by<S: Scalar>(x: &[S], units: &[f64]) -> S {
    if units.is_empty() {
        return largest(x);
    }
    let sizes = x
        .iter()
        .zip(units)
        .map(|(x, unit)| x.abs() / S::from_f64(*unit));
    sizes.fold(S::from_f64(0.0), |s, x| x.larger(s))
}

/// max|x − y|, 0 of none. Passes over NaN in an `f64`.
#[inline]
pub(crate) fn largest_difference<S: Scalar>(x: &[S], y: &[S]) -> S {
    reduce(x, y, |x, y| (x - y).abs(), |s, x| x.larger(s))
}

/// Joins what `f` makes of each pair of numbers, starting from 0.
#[inline(always)]
pub(crate) fn reduce<S: Scalar>(
    x: &[S],
    y: &[S],
    f: impl Fn(S, S) -> S,
    join: impl Fn(S, S) -> S,
) -> S {
    // Lanes fill registers by themselves.
    if size_of::<S>() > size_of::<f64>() {
        reduce_in::<S, 2>(x, y, f, join)
    } else {
        reduce_in::<S, 8>(x, y, f, join)
    }
}

/// Joins what `f` makes of each pair of numbers, in `PARTS` parts that are joined at the end.
#[inline(always)]
fn reduce_in<S: Scalar, const PARTS: usize>(
    x: &[S],
    y: &[S],
    f: impl Fn(S, S) -> S,
    join: impl Fn(S, S) -> S,
) -> S {
    let mut s = [S::from_f64(0.0); PARTS];
    let ((x, x_rest), (y, y_rest)) = (x.as_chunks::<PARTS>(), y.as_chunks::<PARTS>());
    for (x, y) in x.iter().zip(y) {
        for part in 0..PARTS {
            s[part] = join(s[part], f(x[part], y[part]));
        }
    }
    let mut rest = S::from_f64(0.0);
    for (x, y) in x_rest.iter().zip(y_rest) {
        rest = join(rest, f(*x, *y));
    }
    let mut half = PARTS / 2;
    while half > 0 {
        for part in 0..half {
            s[part] = join(s[part], s[part + half]);
        }
        half /= 2;
    }
    join(s[0], rest)
}

/// x, or 1 where it is not positive: a size to compare with.
pub(crate) fn or_one(x: f64) -> f64 {
    if x > 0.0 { x } else { 1.0 }
}

/// 0 where each |d_j| is at most `share` (|x_j| + `least`), else more. Passes over NaN in an `f64`.
#[inline]
pub(crate) fn excess<S: Scalar>(d: &[S], x: &[S], share: S, least: S) -> S {
    let beyond = |d: S, x: S| d.abs() - share * (x.abs() + least);
    reduce(d, x, beyond, |s, x| x.larger(s))
}

/// 0 where each |d_j| is at most `share` (|x_j| + `least` unit_j), else more: for coordinates of different `units`.
pub(crate) fn excess_by<S: Scalar>(d: &[S], x: &[S], share: S, least: S, units: &[f64]) -> S {
    let all = d.iter().zip(x).zip(units);
    let beyond = all.map(|((d, x), unit)| {
        let unit = S::from_f64(*unit);
        (d.abs() - share * (x.abs() + least * unit)) / unit
    });
    beyond.fold(S::from_f64(0.0), |s, x| x.larger(s))
}

/// Σ aᵢ bᵢ, in four sums at a time, which the processor adds in parallel.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    let (a, b) = (a[..n].chunks_exact(4), b[..n].chunks_exact(4));
    let rest = a.remainder().iter().zip(b.remainder());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    let mut sums = [0.0; 4];
    for (a, b) in a.zip(b) {
        for ((s, a), b) in sums.iter_mut().zip(a).zip(b) {
            *s += a * b;
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// max |aᵢ| bᵢ.
pub(crate) fn largest_product(a: &[f64], b: &[f64]) -> f64 {
    reduce(a, b, |a, b| a.abs() * b, |s, x| x.larger(s))
}

/// y ← y + s x.
pub(crate) fn axpy(s: f64, x: &[f64], y: &mut [f64]) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += s * x);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_number_at_any_place_is_seen() {
        for len in 1..40 {
            for place in 0..len {
                let mut x = vec![-1.0; len];
                x[place] = -2.0;
                assert_eq!((all_finite(&x), largest(&x)), (true, 2.0));
                for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    x[place] = bad;
                    assert!(!all_finite(&x), "{bad} at {place} of {len}");
                }
            }
        }
        assert!(all_finite(&[]) && largest::<f64>(&[]) == 0.0);
        assert_eq!(largest_difference(&[1.0, -2.0, 3.0], &[1.0, 3.0, 4.0]), 5.0);
    }

    #[test]
    fn steps_are_compared_with_their_own_coordinate() {
        for len in 1..20 {
            for place in 0..len {
                let (mut d, x) = (vec![1e-6; len], vec![1.0; len]);
                d[place] = -3e-6;
                assert!(excess(&d, &x, 2e-6, 0.6) == 0.0, "{place} of {len}");
                assert!(excess(&d, &x, 2e-6, 0.4) > 0.0, "{place} of {len}");
            }
        }
        assert_eq!(excess(&[0.0], &[0.0], 1.0, 0.0), 0.0);
    }

    #[test]
    fn a_sum_that_overflows_is_no_infinite_number() {
        assert!(all_finite(&[f64::MAX; 20]));
        assert!(!all_finite(&[f64::INFINITY, f64::NEG_INFINITY]));
    }
}
