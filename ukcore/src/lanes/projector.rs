//! Projection onto the constraints in lanes: Newton's method with the emitted elimination. Lanes in which it does not settle at once are left to a
//! [`Projector`](crate::Projector).

use super::Lanes;
use crate::mechanism::{Prepared, Spec};
use crate::stabilise::{NEIGHBOUR, ROUNDING, STALLED};

/// Newton steps at most; the state at the end of a good step needs one or two.
const STEPS: usize = 4;

/// Buffers for the projection of states in lanes.
pub(crate) struct LaneProjector<L> {
    jacobian: Vec<L>,
    residual: Vec<L>,
    step: Vec<L>,
    /// Σ|A_cj x_j| and max|A_cj|, then bounds of a residual at rounding level and of one that will do where no step makes it less.
    strict: Vec<L>,
    loose: Vec<L>,
}

impl<L: Lanes> LaneProjector<L> {
    pub(crate) fn new(spec: &Spec) -> Self {
        let (n, m) = (spec.n(), spec.m());
        let zeros = |len: usize| vec![L::from_f64(0.0); len];
        LaneProjector {
            jacobian: zeros(m * n),
            residual: zeros(m),
            step: zeros(n),
            strict: zeros(m),
            loose: zeros(m),
        }
    }

    /// Projects q, then q̇, in the lanes where `wanted` is 1 (and not 0). Adds the Newton steps to `steps`, lane by lane. Returns 1 for those that are consistent now, 0 for the others.
    pub(crate) fn project(
        &mut self,
        mech: &Prepared<L>,
        t: L,
        q: &mut [L],
        v: &mut [L],
        wanted: L,
        steps: &mut L,
    ) -> L {
        let spec = mech.spec();
        let mut good = wanted;
        if spec.holonomic > 0 {
            // Only all rows together have an elimination.
            let solvable = spec.structure.straight_line && spec.holonomic == spec.m();
            mech.jacobian(t, q, v, &mut self.jacobian);
            self.bounds(spec, spec.holonomic, q);
            good = self.newton(spec.holonomic, q, good, solvable, steps, |x, own, solve| {
                if solve {
                    mech.correction(t, x, v, own.0, own.1)
                } else {
                    mech.residual(t, x, own.0);
                    L::from_f64(1.0)
                }
            });
        }
        if spec.m() > 0 {
            mech.jacobian(t, q, v, &mut self.jacobian);
            self.bounds(spec, spec.m(), v);
            let solvable = spec.structure.straight_line;
            good = self.newton(spec.m(), v, good, solvable, steps, |x, own, solve| {
                if solve {
                    mech.correction(t, q, x, own.0, own.1)
                } else {
                    mech.residual_rate(t, q, x, own.0);
                    L::from_f64(1.0)
                }
            });
        }
        good
    }

    /// The bounds, as [`Projector`](crate::Projector) has them.
    fn bounds(&mut self, spec: &Spec, rows: usize, x: &[L]) {
        let zero = L::from_f64(0.0);
        let size = x.iter().fold(zero, |size, x| size.max(x.abs()));
        self.strict.fill(zero);
        self.loose.fill(zero);
        for &(c, j) in spec.structure.jacobian_pattern {
            let entry = self.jacobian[j * spec.m() + c].abs();
            self.strict[c] = entry.mul_add(x[j].abs(), self.strict[c]);
            self.loose[c] = self.loose[c].max(entry);
        }
        for (strict, loose) in self.strict[..rows].iter_mut().zip(&mut self.loose) {
            let largest = *loose * size;
            let terms = L::from_f64(NEIGHBOUR).mul_add(largest, *strict);
            *strict = terms * L::from_f64(ROUNDING * f64::EPSILON);
            *loose = largest * L::from_f64(STALLED * f64::EPSILON);
        }
    }

    /// Newton's method on `x`. `evaluate(x, (residual, step), false)` makes the residual, with `true` the step and its certificate.
    fn newton(
        &mut self,
        rows: usize,
        x: &mut [L],
        mut good: L,
        solvable: bool,
        steps: &mut L,
        evaluate: impl Fn(&[L], (&mut [L], &mut [L]), bool) -> L,
    ) -> L {
        let (zero, half, one) = (L::from_f64(0.0), L::from_f64(0.5), L::from_f64(1.0));
        let residual = &mut self.residual[..rows];
        let mut left = good;
        for count in 0..=STEPS {
            evaluate(x, (&mut *residual, &mut self.step), false);
            let bounds = if count < 2 { &self.strict } else { &self.loose };
            let mut met = one;
            for (r, bound) in residual.iter().zip(bounds) {
                met = L::select_le(r.abs(), *bound, met, zero);
            }
            left = L::select_le(met, half, left, zero);
            if (0..L::WIDTH).all(|k| left.lane(k) == 0.0) {
                return good;
            }
            if !solvable || count == STEPS {
                break;
            }
            let safe = evaluate(x, (&mut *residual, &mut self.step), true);
            // No step where the certificate fails (or is NaN): that lane is given up.
            let go = L::select_le(half, safe, left, zero);
            good = good - (left - go);
            left = go;
            *steps = *steps + left;
            for (x, d) in x.iter_mut().zip(&self.step) {
                *x = L::select_le(half, left, *x + *d, *x);
            }
        }
        good - left
    }
}
