//! Steps with a safeguard, from far off.

use nalgebra::{DMatrix, DVector};

use super::Manifold;
use super::acceptance::{Acceptance, ROUNDING};
use super::level::At;
use super::newton::Newton;
use crate::mechanism::Prepared;
use crate::scan::Size;

/// Steps at most from one guess. They converge quadratically at the end; a long chain laid out wrongly takes some tens of steps to unfold.
const MAX_STEPS: usize = 200;

/// Damping to start with, relative to rows of unit norm: near Gauss-Newton, yet proof against a vanishing singular value.
const DAMPING: f64 = 1e-3;

/// The damping grows by this after a step that made things worse, and falls by it after one that helped.
const DAMPING_FACTOR: f64 = 10.0;

/// Beyond this damping steps are below rounding: a minimum that is not zero.
const DAMPING_LIMIT: f64 = 1e16;

/// Where the search ends as near to the constraints as this share of lengths, √ε, it has found the place, and Newton's method does the
/// rest.
const NEAR: f64 = 1.5e-8;

/// The best place so far: residuals and A there, each row scaled to unit norm, each column by how readily its coordinate moves.
struct Best {
    x: Vec<f64>,
    /// 1/‖row‖, 1 for a row of zeros.
    scale: Vec<f64>,
    residual: DVector<f64>,
    matrix: DMatrix<f64>,
}

impl Best {
    /// The place `x`, where residuals and A are known.
    fn new(newton: &Newton<f64>, rows: usize, x: &[f64], ease: &[f64]) -> Self {
        let m = newton.residual.len();
        let mut matrix =
            DMatrix::from_fn(rows, x.len(), |c, j| newton.jacobian[j * m + c] * ease[j]);
        let norm = |c: usize| match matrix.row(c).norm() {
            norm if norm > 0.0 => norm.recip(),
            _ => 1.0,
        };
        let scale: Vec<f64> = (0..rows).map(norm).collect();
        for (mut row, scale) in matrix.row_iter_mut().zip(&scale) {
            row.scale_mut(*scale);
        }
        Best {
            x: x.to_vec(),
            residual: DVector::from_fn(rows, |c, _| newton.residual[c] * scale[c]),
            scale,
            matrix,
        }
    }

    /// Σ (s_c φ_c)².
    fn cost(&self, residual: &[f64]) -> f64 {
        let scaled = residual.iter().zip(&self.scale);
        scaled.map(|(r, s)| (r * s).powi(2)).sum()
    }

    /// d that minimises |J d + φ|² + μ|d|²: Jᵀ (J Jᵀ + μ)⁻¹ (−φ). What is below rounding of J Jᵀ does not count in μ.
    fn step(&self, mu: f64) -> Option<DVector<f64>> {
        let mut normal = &self.matrix * self.matrix.transpose();
        let mu = mu.max(ROUNDING * normal.nrows() as f64);
        (0..normal.nrows()).for_each(|c| normal[(c, c)] += mu);
        let multipliers = normal.cholesky()?.solve(&self.residual);
        Some(-self.matrix.tr_mul(&multipliers))
    }
}

impl Manifold {
    /// One in which coordinates move as readily as `ease` says, and those `held` not at all.
    pub(crate) fn with_ease(mechanism: &Prepared, ease: Vec<f64>, held: Vec<usize>) -> Self {
        let mut manifold = Manifold::new(mechanism);
        let acceptance = &mut manifold.newton.acceptance;
        (acceptance.ease, acceptance.held) = (ease, held);
        manifold
    }

    /// From here on coordinates move as readily as each other.
    pub(crate) fn even(&mut self) {
        let ease = &mut self.newton.acceptance.ease;
        let mean = ease.iter().map(|x| x.ln()).sum::<f64>() / ease.len().max(1) as f64;
        ease.fill(mean.exp());
    }

    /// Moves `x`, which is at or near `guess`, onto the constraints from far off, by Levenberg and Marquardt's method, and by projection
    /// in the end. Returns 0, or the sum of the squares of the scaled residuals where it is least.
    pub(crate) fn search(&mut self, at: &At<'_, f64>, guess: &[f64], x: &mut [f64]) -> f64 {
        let Acceptance { ease, held, .. } = &self.newton.acceptance;
        let (rows, size, mut ease) = (at.rows(), Size::of(guess, ease), ease.clone());
        held.iter().for_each(|j| ease[*j] = 0.0);
        let (mut best, mut cost): (Option<Best>, f64) = (None, f64::INFINITY);
        let (mut damping, mut stalls) = (DAMPING, 0);
        let noise = &mut self.noise;
        self.newton.iterate(at, x, 1.0, MAX_STEPS, |newton, x, _| {
            let residual = &newton.residual[..rows];
            let trial = best.as_ref().map_or(0.0, |best| best.cost(residual));
            if trial < cost {
                // At the rounding level costs may fall for ever by tiny amounts.
                stalls = if trial > 0.99 * cost { stalls + 1 } else { 0 };
                damping = (damping / DAMPING_FACTOR).max(f64::EPSILON);
                newton.acceptance.size = size;
                newton.weigh(at, x);
                newton.measure(at, x, noise, None);
                let there = Best::new(newton, rows, x, &ease);
                cost = there.residual.norm_squared();
                best = Some(there);
                if newton.violated(at).next().is_none() {
                    return (1.0, 0.0);
                }
            } else {
                damping *= DAMPING_FACTOR;
            }
            let hopeless = stalls > 3 || damping > DAMPING_LIMIT;
            let Some(best) = best.as_ref().filter(|_| !hopeless) else {
                return (0.0, 0.0);
            };
            // √cost → 0 takes the damping with it: quadratic convergence at the end.
            let Some(step) = best.step(damping * cost.sqrt().min(1.0)) else {
                return (0.0, 0.0);
            };
            let steps = newton.step.iter_mut().zip(x).enumerate();
            steps.for_each(|(j, (d, x))| *d = best.x[j] + ease[j] * step[j] - x);
            (0.0, 1.0)
        });
        if let Some(best) = best {
            x.copy_from_slice(&best.x);
        }
        let met = self.meets(at, x, size);
        let (acceptance, residual) = (&self.newton.acceptance, &self.newton.residual);
        let near = met || acceptance.distance(&residual[..rows]) <= NEAR * acceptance.length(rows);
        if near && self.project(at, x).is_ok() || met {
            return 0.0;
        }
        cost
    }
}
