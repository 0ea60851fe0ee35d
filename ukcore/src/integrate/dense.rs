//! The states within a step.

use crate::scalar::Scalar;

/// A sample counts as within a step that ends so many units of rounding before it.
const END_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// From s to t and back: s counts from the start of the run, upward in either direction.
///
/// Counting from t0 keeps a large t0 from rounding the step sizes: at t = 1e9 the sum t + h would keep seven digits of h = 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clock {
    pub(crate) t0: f64,
    /// 1 going forward, −1 going backward.
    pub(crate) sign: f64,
}

impl Clock {
    pub(crate) fn t(self, s: f64) -> f64 {
        self.t0 + self.sign * s
    }

    pub(crate) fn s(self, t: f64) -> f64 {
        self.sign * (t - self.t0)
    }

    /// Whether a sample at `t` is within a step that ends at `s`.
    pub(crate) fn passed(self, t: f64, s: f64) -> bool {
        let sample = self.s(t);
        sample - END_ROUNDING * sample.abs() <= s
    }
}

/// Interpolant of a step: the time it covers, and coefficients.
#[derive(Clone, Copy)]
pub(crate) struct Interpolant<'a> {
    pub(crate) clock: Clock,
    pub(crate) s_old: f64,
    /// Positive size of the step.
    pub(crate) h: f64,
    /// Rows c₀, c₁, … of [`interpolate`].
    pub(crate) coefficients: &'a [f64],
}

impl Interpolant<'_> {
    /// State at `t`, as interpolated: not projected.
    pub(crate) fn state(&self, t: f64, y: &mut [f64]) {
        interpolate(
            (self.clock.s(t) - self.s_old) / self.h,
            self.coefficients,
            y,
        );
    }

    /// A copy to keep.
    pub(crate) fn segment(&self) -> Segment {
        Segment {
            clock: self.clock,
            s_old: self.s_old,
            h: self.h,
            coefficients: self.coefficients.to_vec(),
        }
    }
}

/// An [`Interpolant`] that is kept.
#[derive(Debug, Clone)]
pub(crate) struct Segment {
    clock: Clock,
    s_old: f64,
    h: f64,
    coefficients: Vec<f64>,
}

impl Segment {
    /// Time at the start of the step.
    pub(crate) fn t_old(&self) -> f64 {
        self.clock.t(self.s_old)
    }

    /// State at `t`, as interpolated: not projected.
    pub(crate) fn state(&self, t: f64, y: &mut [f64]) {
        let interpolant = Interpolant {
            clock: self.clock,
            s_old: self.s_old,
            h: self.h,
            coefficients: &self.coefficients,
        };
        interpolant.state(t, y);
    }
}

/// The first four rows of [`interpolate`], from states and rates at both ends of a step of signed size `h`.
pub(super) fn cubic<S: Scalar>(rows: &mut [S], h: S, y: &[S], new: &[S], start: &[S], end: &[S]) {
    let n = y.len();
    let (c0, rows) = rows.split_at_mut(n);
    let (c1, rows) = rows.split_at_mut(n);
    let (c2, c3) = rows.split_at_mut(n);
    c0.copy_from_slice(y);
    // A loop for each row: several at once do not become vector instructions.
    for (c1, (y, new)) in c1.iter_mut().zip(y.iter().zip(new)) {
        *c1 = *new - *y;
    }
    for (c2, (c1, start)) in c2.iter_mut().zip(c1.iter().zip(start)) {
        *c2 = h * *start - *c1;
    }
    for (c3, ((c1, c2), end)) in c3.iter_mut().zip(c1.iter().zip(&*c2).zip(end)) {
        *c3 = *c1 - h * *end - *c2;
    }
}

/// y = c₀ + θ (c₁ + (1−θ) (c₂ + θ (c₃ + (1−θ) (c₄ + …)))), rows of the length of y; θ from 0 to 1 over the step.
///
/// The first four make the cubic through states and rates at both ends; the others vanish there.
pub(super) fn interpolate(theta: f64, coefficients: &[f64], y: &mut [f64]) {
    y.fill(0.0);
    if y.is_empty() {
        return;
    }
    for (index, row) in coefficients.chunks_exact(y.len()).enumerate().rev() {
        let factor = if index % 2 == 0 { theta } else { 1.0 - theta };
        for (y, c) in y.iter_mut().zip(row) {
            *y = *c + factor * *y;
        }
    }
}
