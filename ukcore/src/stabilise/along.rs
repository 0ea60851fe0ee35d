//! Onto the constraints in directions that are those of another place, as RATTLE needs it.

use super::{Correction, Level, Projector, ROUNDING};
use crate::error::Error;
use crate::scan::{all_finite, all_pairs, largest};

/// The method converges linearly, for a step of size h as h^k; more than that is no useful step.
const MAX_STEPS: usize = 50;

impl Projector {
    /// Moves `q` onto φ(q, t) = 0 along M⁻¹A(`base`)ᵀ, for mechanisms with holonomic constraints alone; `shift` is the sum of all moves, which is more exact than the
    /// difference of coordinates.
    ///
    /// # Errors
    /// [`Error::OffConstraint`] with the constraints that cannot be met that way; [`Error::NonFinite`], [`Error::IndefiniteMass`].
    pub(crate) fn position_along(
        &mut self,
        t: f64,
        base: &[f64],
        q: &mut [f64],
        shift: &mut [f64],
    ) -> Result<Correction, Error> {
        let level = Level::Position;
        shift.fill(0.0);
        let mut correction = Correction::default();
        if self.m == 0 {
            return Ok(correction);
        }
        self.size = largest(q);
        self.factored_at = None;
        let mut factored = false;
        let mut previous = f64::INFINITY;
        loop {
            self.evaluate(t, q, base, level);
            correction.residual = largest(&self.residual);
            if !all_finite(&self.residual) {
                return Err(self.non_finite(t, q, base, level));
            }
            if factored || !self.eliminate(t, base) {
                if !factored {
                    self.jacobian(t, base, base, level);
                    self.cautious = true;
                    self.factor(t, base, self.m)?;
                    factored = true;
                }
                self.minimal_step(self.m);
            }
            let change = largest(&self.step);
            let rounding = ROUNDING * f64::EPSILON;
            let done = all_pairs(&self.step, q, |d, x| d.abs() <= rounding * x.abs());
            // Not a fraction of the last one: rounding alone is left, or it does not converge.
            let stalled = change > 0.5 * previous;
            if done || stalled || correction.iterations == MAX_STEPS {
                if done || change <= rounding * self.size {
                    break;
                }
                self.jacobian(t, q, base, level);
                self.weigh(q);
                self.measure_rounding(t, q, base, level);
                if self.acceptable(q, self.m) {
                    break;
                }
                return Err(self.off_constraint(q, level));
            }
            q.iter_mut().zip(&self.step).for_each(|(x, d)| *x += d);
            shift.iter_mut().zip(&self.step).for_each(|(x, d)| *x += d);
            correction.iterations += 1;
            correction.norm = correction.norm.max(change);
            previous = change;
        }
        Ok(correction)
    }

    /// The step by the emitted elimination at `base`; `false` where there is none, or it is not safe.
    fn eliminate(&mut self, t: f64, base: &[f64]) -> bool {
        self.mechanism.spec().structure.straight_line
            && self
                .mechanism
                .correction(t, base, base, &self.residual, &mut self.step)
                > 0.5
            && all_finite(&self.step)
    }
}
