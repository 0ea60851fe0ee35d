//! Whether a solution stands: redundant constraints agree with the others as far as drift and rounding let them.

use super::{DRIFT_FACTOR, Given, RANK_CEILING, Solver};
use crate::dense::Rows;
use crate::error::Error;
use crate::mechanism::Evaluated;
use crate::naming;
use crate::scan::{all_finite, or_one};

/// The equations at the nearest state on the manifold.
#[derive(Debug, Clone)]
pub(super) struct Drift {
    pub(super) known: bool,
    pub(super) there: Evaluated,
    pub(super) q: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) correction: Vec<f64>,
}

impl Drift {
    /// Buffers for n coordinates and m constraints.
    pub(super) fn new(n: usize, m: usize) -> Self {
        Drift {
            known: false,
            there: Evaluated::new(n, m),
            q: vec![0.0; n],
            v: vec![0.0; n],
            correction: vec![0.0; n],
        }
    }

    /// What it explains of the residual of row `c` of A q̈ = b, where A is `a` and b is `rhs`.
    fn explains(&self, a: Rows<'_>, rhs: &[f64], c: usize, acceleration: &[f64]) -> f64 {
        if !self.known {
            return 0.0;
        }
        let there = self.there.rows();
        let change = a.row(c).zip(there.row(c)).zip(acceleration);
        let change: f64 = change.map(|((a, b), x)| ((a - b) * x).abs()).sum();
        (self.there.rhs[c] - rhs[c]).abs() + change
    }
}

impl Solver {
    /// Redundant rows must agree with the others, and q̈ must be finite.
    pub(super) fn check(
        &mut self,
        (t, q, v): Given<'_>,
        tolerance: f64,
        acceleration: &[f64],
    ) -> Result<(), Error> {
        let spec = self.mechanism.spec();
        if !all_finite(acceleration) {
            let pairs = spec.coords.iter().zip(acceleration);
            let broken = pairs.filter(|(_, x)| !x.is_finite());
            let what = broken.map(|(name, _)| format!("acceleration of {name}"));
            return Err(Error::NonFinite {
                what: what.collect(),
            });
        }
        if self.dense.cod.rank() == self.m || self.agrees(acceleration, tolerance) {
            return Ok(());
        }
        if !self.drift.known {
            self.measure_drift((t, q, v));
            if self.agrees(acceleration, tolerance) {
                return Ok(());
            }
        }
        self.noise.go(&self.mechanism, t, [q, v], |_| [0.0; 2]);
        self.noise.motion(acceleration, &mut self.carried);
        if self.agrees(acceleration, tolerance) {
            return Ok(());
        }
        let a = self.here.rows();
        let residual = (0..self.m).map(|c| a.product(c, acceleration) - self.rhs[c]);
        let residual: Vec<f64> = residual.collect();
        Err(Error::Inconsistent {
            // A row of zeros has no scale: 0 = b.
            constraints: naming::offending(spec, &residual, |c| or_one(self.dense.row_scale[c])),
        })
    }

    /// Whether A q̈ = b holds up to `tolerance`, drift and the rounding that is known. At rest q̈ is the difference of what the forces and
    /// what the constraints do, so the tolerance refers to these.
    fn agrees(&mut self, acceleration: &[f64], tolerance: f64) -> bool {
        let (m, a, scale) = (self.m, self.here.rows(), &self.dense.row_scale);
        let free = &self.dense.unconstrained;
        let size =
            |c: usize| self.rhs[c].abs() + a.magnitude(c, acceleration) + a.magnitude(c, free);
        let largest = (0..m).map(|c| scale[c] * size(c)).fold(0.0, f64::max);
        let rounding = DRIFT_FACTOR * tolerance.min(RANK_CEILING) * largest;
        for (c, scale) in scale.iter().enumerate() {
            let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
            // Both the size of the terms that b is made of, which may cancel, and in units of ε their rounding.
            let carried = finite(self.carried[c]);
            let most = RANK_CEILING * carried.max(largest / scale);
            let drift = finite(self.drift.explains(a, &self.rhs, c, acceleration));
            self.granted[c] =
                (DRIFT_FACTOR * drift).min(most) + DRIFT_FACTOR * f64::EPSILON * carried;
        }
        let met = |scale: &[f64], granted: &[f64]| {
            (0..m).all(|c| {
                let excess = (self.rhs[c] - a.product(c, acceleration)).abs() - granted[c];
                excess <= 0.0 || scale[c] > 0.0 && scale[c] * excess <= rounding
            })
        };
        // Rows that imply each other are granted it together.
        met(&self.dense.row_scale, &self.granted)
            || self.drift.known && {
                self.dense.share(&mut self.granted);
                met(&self.dense.row_scale, &self.granted)
            }
    }
}
