//! The states within a step.

use crate::scalar::Scalar;

/// Interpolant of a step: the time it covers, and coefficients, which are borrowed or kept.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Interpolant<C> {
    /// Start of the run, from which s = t − t0 counts.
    pub(crate) t0: f64,
    /// s at the start of the step.
    pub(crate) s: f64,
    /// Signed size of the step.
    pub(crate) h: f64,
    /// The time from which it counts: that of the start of the step, or where a run that has gone back is again where it was.
    pub(crate) from: f64,
    /// Rows c₀, c₁, … of [`interpolate`].
    pub(crate) coefficients: C,
}

/// An interpolant that is kept.
pub(crate) type Segment = Interpolant<Vec<f64>>;

impl<C: AsRef<[f64]>> Interpolant<C> {
    /// State at `t`, as interpolated: not projected.
    pub(crate) fn state(&self, t: f64, y: &mut [f64]) {
        let theta = (t - self.t0 - self.s) / self.h;
        interpolate(theta, self.coefficients.as_ref(), y);
    }

    /// A copy to keep.
    pub(crate) fn segment(&self) -> Segment {
        Interpolant {
            t0: self.t0,
            s: self.s,
            h: self.h,
            from: self.from,
            coefficients: self.coefficients.as_ref().to_vec(),
        }
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

/// Coordinates and velocities at a part of a step of size `h` between two states (q, q̇), on the cubics through both.
pub(crate) fn between(
    part: f64,
    h: f64,
    [[q0, v0], [q1, v1]]: [[&[f64]; 2]; 2],
    [q, v]: [&mut [f64]; 2],
) {
    let rest = 1.0 - part;
    for i in 0..q.len() {
        let change = q1[i] - q0[i];
        // The chord, and what the velocities at both ends add to it.
        let (a, b) = (v0[i] * h - change, change - v1[i] * h);
        let (bend, slope) = (a * rest + b * part, change / h);
        q[i] = q0[i] + part * change + part * rest * bend;
        v[i] = slope + ((1.0 - 2.0 * part) * bend + part * rest * (b - a)) / h;
    }
}
