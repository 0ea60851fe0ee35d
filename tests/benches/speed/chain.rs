//! The U-chain as a patient expert writes it.
//!
//! e_i is the link from particle i to particle i + 1, the last one to the support. With λ_i m e_i the force of link i on particle i,
//! q̈_i = g + λ_i e_i − λ_{i−1} e_{i−1}, so masses and lengths drop out, and e·ë = −ė² gives one tridiagonal system for all λ:
//! 2 e_i² λ_i − (e_i·e_{i+1}) λ_{i+1} − (e_{i−1}·e_i) λ_{i−1} = ė_i², in its last row e² λ − … = ė² − e·g.

use std::ops::{Add, Div, Mul, Neg, Sub};

use wide::f64x2;

/// Scalar or lanes.
pub(crate) trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + From<f64>
{
}
impl Number for f64 {}
impl Number for f64x2 {}
impl Number for wide::f64x4 {}
impl Number for wide::f64x8 {}

/// Parameters, as the declared model has them.
#[derive(Clone, Copy)]
pub(crate) struct Chain {
    /// Mass of a particle; it drops out.
    #[expect(dead_code, reason = "a parameter that the solution does not need")]
    pub(crate) m: f64,
    /// Length of a link; it drops out, as the link is taken as it is.
    #[expect(dead_code, reason = "a parameter that the solution does not need")]
    pub(crate) l: f64,
    /// Gravity.
    pub(crate) g: f64,
}

/// The system: links e, diagonal, −(off-diagonal), right-hand side.
struct System<T, const N: usize> {
    ex: [T; N],
    ey: [T; N],
    diagonal: [T; N],
    off: [T; N],
    rhs: [T; N],
}

/// A vector of 2N numbers, x first, as two of N.
#[inline(always)]
fn split<T, const N: usize>(both: &[T]) -> (&[T; N], &[T; N]) {
    let (x, y) = both.split_at(N);
    (
        x.try_into().expect("2 N numbers"),
        y.try_into().expect("2 N numbers"),
    )
}

impl<T: Number, const N: usize> System<T, N> {
    #[inline(always)]
    fn of(g: T, q: &[T], v: &[T]) -> Self {
        let ((x, y), (vx, vy)) = (split::<T, N>(q), split::<T, N>(v));
        let zero = T::from(0.0);
        let mut system = System {
            ex: [zero; N],
            ey: [zero; N],
            diagonal: [zero; N],
            off: [zero; N],
            rhs: [zero; N],
        };
        for i in 0..N - 1 {
            let (ex, ey) = (x[i + 1] - x[i], y[i + 1] - y[i]);
            let (wx, wy) = (vx[i + 1] - vx[i], vy[i + 1] - vy[i]);
            (system.ex[i], system.ey[i]) = (ex, ey);
            system.diagonal[i] = T::from(2.0) * (ex * ex + ey * ey);
            system.rhs[i] = wx * wx + wy * wy;
        }
        let k = N - 1;
        (system.ex[k], system.ey[k]) = (-x[k], -y[k]);
        system.diagonal[k] = x[k] * x[k] + y[k] * y[k];
        system.rhs[k] = vx[k] * vx[k] + vy[k] * vy[k] + y[k] * g;
        for i in 0..N - 1 {
            system.off[i] = system.ex[i] * system.ex[i + 1] + system.ey[i] * system.ey[i + 1];
        }
        system
    }

    /// q̈ from λ.
    #[inline(always)]
    fn accelerate(&self, g: T, lambda: &[T; N], out: &mut [T]) {
        let (ax, ay) = out.split_at_mut(N);
        ax[0] = lambda[0] * self.ex[0];
        ay[0] = g + lambda[0] * self.ey[0];
        for i in 1..N {
            ax[i] = lambda[i] * self.ex[i] - lambda[i - 1] * self.ex[i - 1];
            ay[i] = g + lambda[i] * self.ey[i] - lambda[i - 1] * self.ey[i - 1];
        }
    }
}

/// From the tip to the support (Thomas): each pivot waits for the division by the one before.
#[inline(never)]
pub(crate) fn one_sided<const N: usize>(chain: &Chain, q: &[f64], v: &[f64], out: &mut [f64]) {
    let s = System::<f64, N>::of(chain.g, q, v);
    let (mut w, mut r) = ([0.0; N], [0.0; N]);
    let mut inverse = 1.0 / s.diagonal[0];
    w[0] = s.off[0] * inverse;
    r[0] = s.rhs[0] * inverse;
    for i in 1..N {
        inverse = 1.0 / (s.diagonal[i] - s.off[i - 1] * w[i - 1]);
        w[i] = s.off[i] * inverse;
        r[i] = (s.rhs[i] + s.off[i - 1] * r[i - 1]) * inverse;
    }
    for i in (0..N - 1).rev() {
        r[i] += w[i] * r[i + 1];
    }
    s.accelerate(chain.g, &r, out);
}

/// From the tip to the support by leading minors: pivot i is minor i over minor i − 1, so that no division waits for another.
#[inline(never)]
pub(crate) fn one_sided_minors<const N: usize>(
    chain: &Chain,
    q: &[f64],
    v: &[f64],
    out: &mut [f64],
) {
    let s = System::<f64, N>::of(chain.g, q, v);
    let (mut minor, mut r, mut inverse) = ([0.0; N], [0.0; N], [0.0; N]);
    let (mut before, mut last) = (1.0, s.diagonal[0]);
    (minor[0], r[0]) = (last, s.rhs[0]);
    for i in 1..N {
        let p = s.off[i - 1];
        r[i] = s.rhs[i] * last + p * r[i - 1];
        (before, last) = (last, s.diagonal[i] * last - p * p * before);
        minor[i] = last;
    }
    for i in 0..N {
        inverse[i] = 1.0 / minor[i];
    }
    let mut w = [0.0; N];
    w[0] = s.off[0] * inverse[0];
    for i in 1..N {
        w[i] = s.off[i] * minor[i - 1] * inverse[i];
    }
    for i in 0..N {
        r[i] *= inverse[i];
    }
    for i in (0..N - 1).rev() {
        r[i] += w[i] * r[i + 1];
    }
    s.accelerate(chain.g, &r, out);
}

/// From both ends to the middle, at once: half as many divisions in a row.
#[inline(never)]
pub(crate) fn both_ends<const N: usize>(chain: &Chain, q: &[f64], v: &[f64], out: &mut [f64]) {
    let s = System::<f64, N>::of(chain.g, q, v);
    let (mut w, mut r) = ([0.0; N], [0.0; N]);
    let (h, k) = (N / 2, N - 1);
    let (mut a, mut b) = (1.0 / s.diagonal[0], 1.0 / s.diagonal[k]);
    (w[0], r[0]) = (s.off[0] * a, s.rhs[0] * a);
    (w[k], r[k]) = (s.off[k - 1] * b, s.rhs[k] * b);
    for i in 1..h {
        let j = k - i;
        a = 1.0 / (s.diagonal[i] - s.off[i - 1] * w[i - 1]);
        b = 1.0 / (s.diagonal[j] - s.off[j] * w[j + 1]);
        w[i] = s.off[i] * a;
        w[j] = s.off[j - 1] * b;
        r[i] = (s.rhs[i] + s.off[i - 1] * r[i - 1]) * a;
        r[j] = (s.rhs[j] + s.off[j] * r[j + 1]) * b;
    }
    r[h] = (s.rhs[h] + s.off[h - 1] * r[h - 1] + s.off[h] * r[h + 1])
        / (s.diagonal[h] - s.off[h - 1] * w[h - 1] - s.off[h] * w[h + 1]);
    for i in (0..h).rev() {
        let j = k - i;
        r[i] += w[i] * r[i + 1];
        r[j] += w[j] * r[j - 1];
    }
    s.accelerate(chain.g, &r, out);
}

/// From both ends by minors: one division in a row, in the middle. Over lanes, one chain a lane.
#[inline(always)]
fn by_minors<T: Number, const N: usize>(g: T, q: &[T], v: &[T], out: &mut [T]) {
    let s = System::<T, N>::of(g, q, v);
    let (one, zero) = (T::from(1.0), T::from(0.0));
    let (h, k) = (N / 2, N - 1);
    let (mut minor, mut r, mut w) = ([one; N], [zero; N], [zero; N]);
    (minor[0], r[0]) = (s.diagonal[0], s.rhs[0]);
    (minor[k], r[k]) = (s.diagonal[k], s.rhs[k]);
    let (mut a0, mut a, mut b0, mut b) = (one, minor[0], one, minor[k]);
    for i in 1..h {
        let j = k - i;
        let (p, o) = (s.off[i - 1], s.off[j]);
        r[i] = s.rhs[i] * a + p * r[i - 1];
        r[j] = s.rhs[j] * b + o * r[j + 1];
        (a0, a) = (a, s.diagonal[i] * a - p * p * a0);
        (b0, b) = (b, s.diagonal[j] * b - o * o * b0);
        (minor[i], minor[j]) = (a, b);
    }
    let (p, o) = (s.off[h - 1], s.off[h]);
    minor[h] = s.diagonal[h] * a * b - p * p * a0 * b - o * o * a * b0;
    r[h] = s.rhs[h] * a * b + p * r[h - 1] * b + o * r[h + 1] * a;
    let mut inverse = [zero; N];
    for i in 0..N {
        inverse[i] = one / minor[i];
    }
    for i in 0..N {
        r[i] = r[i] * inverse[i];
    }
    w[0] = s.off[0] * inverse[0];
    w[k] = s.off[k - 1] * inverse[k];
    for i in 1..h {
        w[i] = s.off[i] * minor[i - 1] * inverse[i];
    }
    for j in h + 1..k {
        w[j] = s.off[j - 1] * minor[j + 1] * inverse[j];
    }
    for i in (0..h).rev() {
        let j = k - i;
        r[i] = r[i] + w[i] * r[i + 1];
        r[j] = r[j] + w[j] * r[j - 1];
    }
    s.accelerate(g, &r, out);
}

/// See [`by_minors`].
#[inline(never)]
pub(crate) fn both_ends_minors<const N: usize>(
    chain: &Chain,
    q: &[f64],
    v: &[f64],
    out: &mut [f64],
) {
    by_minors::<f64, N>(chain.g, q, v, out);
}

/// A chain in each lane; see [`by_minors`].
#[inline(never)]
pub(crate) fn lanes<T: Number, const N: usize>(chain: &Chain, q: &[T], v: &[T], out: &mut [T]) {
    by_minors::<T, N>(T::from(chain.g), q, v, out);
}

/// By minors, with the two ends as the two halves of one register.
#[inline(never)]
pub(crate) fn both_ends_paired<const N: usize>(
    chain: &Chain,
    q: &[f64],
    v: &[f64],
    out: &mut [f64],
) {
    let s = System::<f64, N>::of(chain.g, q, v);
    let (h, k) = (N / 2, N - 1);
    let pair = |a: f64, b: f64| f64x2::new([a, b]);
    let (mut r, mut w) = ([f64x2::ZERO; N], [f64x2::ZERO; N]);
    let (mut before, mut last) = (f64x2::ONE, pair(s.diagonal[0], s.diagonal[k]));
    let mut right = pair(s.rhs[0], s.rhs[k]);
    let mut off = pair(s.off[0], s.off[k - 1]);
    for i in 1..h {
        let j = k - i;
        let inverse = f64x2::ONE / last;
        (r[i - 1], w[i - 1]) = (right * inverse, off * before * inverse);
        right = pair(s.rhs[i], s.rhs[j]) * last + off * right;
        let next = pair(s.diagonal[i], s.diagonal[j]) * last - off * off * before;
        (before, last) = (last, next);
        off = pair(s.off[i], s.off[j - 1]);
    }
    let inverse = f64x2::ONE / last;
    (r[h - 1], w[h - 1]) = (right * inverse, off * before * inverse);
    let ([a0, b0], [a, b]) = (before.to_array(), last.to_array());
    let ([ra, rb], [p, o]) = (right.to_array(), off.to_array());
    let mut lambda = [0.0; N];
    lambda[h] = (s.rhs[h] * (a * b) + p * ra * b + o * rb * a)
        / (s.diagonal[h] * (a * b) - p * p * a0 * b - o * o * b0 * a);
    let mut x = f64x2::splat(lambda[h]);
    for i in (0..h).rev() {
        x = r[i] + w[i] * x;
        [lambda[i], lambda[k - i]] = x.to_array();
    }
    s.accelerate(chain.g, &lambda, out);
}
