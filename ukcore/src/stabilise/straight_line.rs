//! Newton's method with the emitted elimination: no matrix is formed, and it is known beforehand where one step is enough.

use super::{Correction, Level, NEIGHBOUR, PROGRESS, Projector, ROUNDING};
use crate::scan::{all_finite, is_within, largest, largest_difference};

/// Steps before the rank-revealing solve takes over.
const MAX_STEPS: usize = 8;

/// A Newton step that changes every coordinate by at most this share of itself is the last one: it leaves residuals of second order, a share
/// of 1e-18 of the coordinates, below ε even where the lengths in a constraint are a hundredth of the coordinates.
const QUADRATIC: f64 = 1e-9;

/// The same where the constraints are linear in what is changed: only rounding remains, of which the elimination may have made a thousand ε
/// of the change.
const LINEAR: f64 = 1e-3;

impl Projector {
    /// As [`Projector::rank_revealing`]; `None` if the certificate of the elimination does not hold or the method does not converge at
    /// once, with `x` left somewhere.
    pub(super) fn straight_line(
        &mut self,
        t: f64,
        x: &mut [f64],
        other: &[f64],
        level: Level,
    ) -> Option<Correction> {
        let linear = level == Level::Velocity && self.holonomic == self.m;
        let trusted = if linear { LINEAR } else { QUADRATIC };
        let mut correction = Correction::default();
        let mut previous = f64::INFINITY;
        self.evaluate(t, x, other, level);
        correction.residual = largest(&self.residual);
        loop {
            let (q, v) = match level {
                Level::Position => (&*x, other),
                Level::Velocity => (other, &*x),
            };
            let certificate = self
                .mechanism
                .correction(t, q, v, &self.residual, &mut self.step);
            if certificate.is_nan() || certificate <= 0.5 || !all_finite(&self.step) {
                return None;
            }
            let change = largest(&self.step);
            let least = NEIGHBOUR * self.size;
            if change <= ROUNDING * f64::EPSILON * self.size {
                // Where rounding alone is left. As |φ_c| ≤ Σ|A_cj Δ_j|, Δ at the rounding of x has φ at rounding level; the rows say
                // it more exactly, but cost more than a step.
                let rounding = ROUNDING * f64::EPSILON;
                if is_within(&self.step, x, rounding, least) {
                    break;
                }
                self.jacobian(t, x, other, level);
                self.weigh(x);
                if self.at_rounding(self.m) {
                    break;
                }
            }
            if change > PROGRESS * previous {
                self.jacobian(t, x, other, level);
                self.weigh(x);
                self.measure_rounding(t, x, other, level);
                if self.acceptable(x, self.m) {
                    break;
                }
                return None;
            }
            if correction.iterations == MAX_STEPS {
                return None;
            }
            let last = is_within(&self.step, x, trusted, least);
            x.iter_mut().zip(&self.step).for_each(|(x, d)| *x += d);
            correction.iterations += 1;
            previous = change;
            self.evaluate(t, x, other, level);
            let before = correction.residual;
            correction.residual = largest(&self.residual);
            if last && correction.residual <= before {
                break;
            }
        }
        if correction.iterations > 0 {
            correction.norm = largest_difference(x, &self.start);
        }
        Some(correction)
    }
}
