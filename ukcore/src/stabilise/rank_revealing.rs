//! Newton's method with the rank-revealing solve, for any mechanism and any state.

use super::{Correction, Level, PROGRESS, Projector, rows_of};
use crate::diagnose;
use crate::error::Error;
use crate::metric::MassFault;
use crate::scan::{all_finite, largest, largest_difference};
use crate::solver::{RANK_CEILING, RANK_TOLERANCE, leading, mass_error};
use crate::workspace::Route;

/// The factors of an earlier step are used again while they divide the residual by this.
const KEEP_FACTORS: f64 = 1e-2;

/// Newton steps at most. Quadratic convergence needs about six from any useful state; some more for states far off.
const MAX_STEPS: usize = 40;

/// Steps without progress before giving up: far from the manifold the residual need not fall at once.
const MAX_STALLS: usize = 6;

impl Projector {
    /// Newton's method on `x`: q with `other` = q̇, or q̇ with `other` = q. Where it fails, `x` is left somewhere.
    pub(super) fn rank_revealing(
        &mut self,
        t: f64,
        x: &mut [f64],
        other: &[f64],
        level: Level,
    ) -> Result<Correction, Error> {
        let rows = self.rows(level);
        let mut correction = Correction::default();
        self.rounding.fill(0.0);
        self.evaluate(t, x, other, level);
        let mut factored =
            level == Level::Velocity && self.factored_at == Some(t) && self.factored_q == other;
        self.jacobian(t, x, other, level);
        self.weigh(x);
        correction.residual = largest(&self.residual[..rows]);
        if !all_finite(&self.residual[..rows]) {
            return Err(self.non_finite(t, x, other, level));
        }
        if self.at_rounding(rows) {
            return Ok(correction);
        }
        if !factored {
            self.cautious = true;
            self.factor(t, if level == Level::Position { x } else { other }, rows)?;
        }
        self.best.copy_from_slice(x);
        let mut merit = self.merit(rows);
        let (mut best_merit, mut stalls) = (merit, 0);
        while correction.iterations < MAX_STEPS {
            correction.iterations += 1;
            self.advance(x, rows);
            self.evaluate(t, x, other, level);
            self.weigh(x);
            let previous = merit;
            merit = self.merit(rows);
            if merit.is_finite() && merit < best_merit {
                best_merit = merit;
                self.best.copy_from_slice(x);
            }
            if merit.is_finite() && self.at_rounding(rows) {
                break;
            }
            let progress = merit <= PROGRESS * previous;
            if progress && merit <= KEEP_FACTORS * previous {
                continue;
            }
            if !progress && !factored {
                // Fresh factors and no progress: rows left out are not implied after all, or this is rounding, or far away.
                if self.widen() {
                    continue;
                }
                stalls += 1;
                self.measure_rounding(t, x, other, level);
                if self.acceptable(x, rows) || stalls > MAX_STALLS || !merit.is_finite() {
                    break;
                }
            }
            factored = false;
            self.jacobian(t, x, other, level);
            self.weigh(x);
            self.factor(t, if level == Level::Position { x } else { other }, rows)?;
            merit = self.merit(rows);
        }
        x.copy_from_slice(&self.best);
        self.evaluate(t, x, other, level);
        self.weigh(x);
        correction.residual = largest(&self.residual[..rows]);
        correction.norm = largest_difference(x, &self.start);
        if !self.at_rounding(rows) {
            self.measure_rounding(t, x, other, level);
            if !self.acceptable(x, rows) {
                return Err(self.off_constraint(x, level));
            }
        }
        if level == Level::Position && rows == self.m {
            // The factors belong to a q that differs by the correction: good enough for what is then a chord step.
            self.factored_at = Some(t);
            self.factored_q.copy_from_slice(x);
        }
        Ok(correction)
    }

    /// Factors M and the first `rows` rows of A. While `cautious`, rows of a significance below the ceiling are left out: off the
    /// manifold nobody can tell whether they are implied; if they are not, the residual will not fall, and they are taken in.
    pub(super) fn factor(&mut self, t: f64, q: &[f64], rows: usize) -> Result<(), Error> {
        self.mechanism.mass_matrix(t, q, &mut self.mass);
        if !all_finite(&self.mass) || !all_finite(&self.jacobian) {
            let (mass, jacobian) = (&self.mass, &self.jacobian);
            let what = diagnose::non_finite_matrices(self.mechanism.spec(), mass, jacobian);
            return Err(Error::NonFinite { what });
        }
        let a = rows_of(&self.jacobian, self.m, rows);
        let massless = !self.mechanism.spec().structure.massless.is_empty();
        let route = if massless {
            Route::Singular
        } else {
            Route::Regular
        };
        let result = match self.dense.factor(route, &self.mass, a, RANK_TOLERANCE) {
            Err(MassFault::Singular(_)) => {
                self.dense
                    .factor(Route::Singular, &self.mass, a, RANK_TOLERANCE)
            }
            result => result,
        };
        result.map_err(|fault| mass_error(self.mechanism.spec(), fault))?;
        let pivots = self.dense.cod.pivots();
        let rank = if self.cautious {
            leading(pivots, RANK_CEILING)
        } else {
            pivots.len()
        };
        self.dense
            .set_rank(rank, &self.mass)
            .map_err(|fault| mass_error(self.mechanism.spec(), fault))
    }

    /// Takes in the rows left out so far; `false` if there are none.
    fn widen(&mut self) -> bool {
        let all = self.dense.cod.pivots().len();
        if !self.cautious || self.dense.cod.rank() == all {
            return false;
        }
        self.cautious = false;
        // An indefinite M would show at the next full factorisation; here the directions concerned stay at rest.
        self.dense.set_rank(all, &self.mass).is_ok()
    }

    /// x ← x + Δ with A Δ = −residual, Δ minimal.
    fn advance(&mut self, x: &mut [f64], rows: usize) {
        self.minimal_step(rows);
        x.iter_mut().zip(&self.step).for_each(|(x, d)| *x += d);
    }

    /// The minimal Δ with A Δ = −residual into `step`.
    pub(super) fn minimal_step(&mut self, rows: usize) {
        let rhs = &mut self.rhs[..rows];
        rhs.iter_mut()
            .zip(&self.residual)
            .for_each(|(b, r)| *b = -r);
        let a = rows_of(&self.jacobian, self.m, rows);
        self.dense.solve(&self.mass, a, None, rhs, &mut self.step);
    }

    /// How far off: |φ_c| / max|A_cj|, the largest over the rows that are not at rounding level yet.
    fn merit(&self, rows: usize) -> f64 {
        (0..rows)
            .filter(|&c| !self.row_at_rounding(c))
            .fold(0.0, |s: f64, c| {
                // A row of zeros has no scale.
                let scale = if self.largest[c] > 0.0 {
                    self.largest[c]
                } else {
                    1.0
                };
                let off = self.residual[c].abs() / scale;
                if off.is_nan() || s.is_nan() {
                    f64::NAN
                } else {
                    s.max(off)
                }
            })
    }

    pub(super) fn non_finite(&self, t: f64, x: &[f64], other: &[f64], level: Level) -> Error {
        let rows = self.rows(level);
        let (q, v) = if level == Level::Position {
            (x, other)
        } else {
            (other, x)
        };
        diagnose::bad_input(&self.mechanism, t, q, v).unwrap_or_else(|| {
            diagnose::non_finite_residual(self.mechanism.spec(), &self.residual[..rows])
        })
    }

    pub(super) fn off_constraint(&self, x: &[f64], level: Level) -> Error {
        let rows = self.rows(level);
        // Rows at rounding level are met.
        let mut residual = self.residual[..rows].to_vec();
        for (c, r) in residual.iter_mut().enumerate() {
            if self.row_acceptable(c, x) {
                *r = 0.0;
            }
        }
        Error::OffConstraint {
            level: match level {
                Level::Position => "position",
                Level::Velocity => "velocity",
            },
            constraints: diagnose::offending(
                self.mechanism.spec(),
                &residual,
                &self.dense.residual_scale(),
            ),
        }
    }
}
