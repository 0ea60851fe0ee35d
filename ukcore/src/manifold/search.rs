//! Steps with a safeguard, from far off.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::Manifold;
use super::acceptance::ROUNDING;
use super::level::{At, Level};
use super::newton::Newton;
use super::parts::Part;
use super::rank_revealing::LIGHT;
use crate::mechanism::Prepared;
use crate::scan::or_one;

/// Steps at most from one guess. They converge quadratically at the end; a long chain laid out wrongly takes some tens of steps to unfold.
const MAX_STEPS: usize = 200;

/// Damping to start with, relative to rows of unit norm: near Gauss-Newton, yet proof against a vanishing singular value.
const DAMPING: f64 = 1e-3;

/// The damping grows by this after a step that made things worse, and falls by it after one that helped.
const DAMPING_FACTOR: f64 = 10.0;

/// Beyond this damping steps are below rounding: a minimum that is not zero.
const DAMPING_LIMIT: f64 = 1e16;

/// The share of its sum of squares at the guess at which rounding is measured again in a part of a mechanism: that takes the whole
/// mechanism.
const CLOSE: f64 = 1e-16;

/// A search that ends as near to the constraints as this share of lengths, √ε, has found the place, and Newton's method does the rest.
const NEAR: f64 = 1.5e-8;

/// Searches for a solution that keeps what is told.
const TIMES: usize = 2;

/// What follows from other rows has this share of a singular value at most, at a place that is as near as [`NEAR`].
const FLAT: f64 = 1e-6;

/// The rounding of so many terms adds up in a constraint with lengths.
const TERMS: f64 = 16.0;

/// No step turns an angle by more than this: beyond, it leads no nearer, but to angles so large that their rounding would explain any
/// residual.
const MOST: f64 = PI;

/// Which unknowns are angles.
fn angles(at: &At<'_, f64>) -> &'static [usize] {
    match at.level {
        Level::Position => at.mech.spec().structure.angles,
        Level::Velocity => &[],
    }
}

/// The largest turn of an angle among the unknowns of `part`, where the k-th of them changes by `step(k)`.
fn turned(at: &At<'_, f64>, part: &Part, step: impl Fn(usize) -> f64) -> f64 {
    let (angles, unknowns) = (angles(at), part.unknowns.iter().enumerate());
    let turns = unknowns.filter(|(_, j)| angles.contains(j));
    turns.fold(0.0, |most: f64, (k, _)| most.max(step(k).abs()))
}

/// The best place so far: residuals and A there, of the rows and unknowns of a part, each row scaled to unit norm, each column by how
/// readily its coordinate moves.
struct Best {
    x: Vec<f64>,
    /// 1/‖row‖, 1 for a row of zeros.
    scale: Vec<f64>,
    residual: DVector<f64>,
    /// Jᵀ, so that the products of rows are those of numbers that stand beside each other.
    matrix: DMatrix<f64>,
    /// J Jᵀ on and below its diagonal: for all dampings the same.
    normal: DMatrix<f64>,
}

impl Best {
    /// The place `x`, where residuals and A are known.
    fn new(newton: &Newton<f64>, Part { rows, unknowns, .. }: &Part, x: &[f64]) -> Self {
        let (m, ease) = (newton.residual.len(), &newton.acceptance.ease);
        let mut matrix = DMatrix::from_fn(unknowns.len(), rows.len(), |j, c| {
            newton.jacobian[unknowns[j] * m + rows[c]] * ease[unknowns[j]]
        });
        let norm = |c: usize| or_one(matrix.column(c).norm()).recip();
        let scale: Vec<f64> = (0..rows.len()).map(norm).collect();
        for (mut row, scale) in matrix.column_iter_mut().zip(&scale) {
            row.scale_mut(*scale);
        }
        let product = |c, d| match c >= d {
            true => matrix.column(c).dot(&matrix.column(d)),
            false => 0.0,
        };
        let normal = DMatrix::from_fn(rows.len(), rows.len(), product);
        Best {
            x: x.to_vec(),
            residual: DVector::from_fn(rows.len(), |c, _| newton.residual[rows[c]] * scale[c]),
            scale,
            matrix,
            normal,
        }
    }

    /// Σ (s_c φ_c)².
    fn cost(&self, part: &Part, residual: &[f64]) -> f64 {
        let scaled = part.rows.iter().zip(&self.scale);
        scaled.map(|(c, s)| (residual[*c] * s).powi(2)).sum()
    }

    /// d that minimises |J d + φ|² + μ|d|²: Jᵀ (J Jᵀ + μ)⁻¹ (−φ). What is below rounding of J Jᵀ does not count in μ.
    fn step(&self, mu: f64) -> Option<DVector<f64>> {
        let mut normal = self.normal.clone();
        let mu = mu.max(ROUNDING * normal.nrows() as f64);
        (0..normal.nrows()).for_each(|c| normal[(c, c)] += mu);
        let multipliers = normal.cholesky()?.solve(&self.residual);
        Some(-(&self.matrix * multipliers))
    }
}

impl Newton<f64> {
    /// Whether the place, of which all is known, is so near to where the rows of `part` are met that projection does the rest.
    fn is_near(&self, part: &Part) -> bool {
        let off = self.acceptance.distance(part.rows(), &self.residual);
        off <= NEAR * self.acceptance.length(part.rows())
    }
}

impl Manifold {
    /// One in which coordinates move as readily as `ease` says, and those `held` not at all. What makes coordinates of different units
    /// comparable is taken from a state before `ease` is asked.
    pub(crate) fn with_ease(
        mech: &Prepared,
        (t, q, v): (f64, &[f64], &[f64]),
        ease: impl FnOnce(&Self) -> Vec<f64>,
        held: Vec<usize>,
    ) -> Self {
        let mut manifold = Manifold::new(mech);
        manifold.measure(mech, t, q, v);
        let ease = ease(&manifold);
        let acceptance = &mut manifold.newton.acceptance;
        acceptance.inertial.clone_from(&ease);
        (acceptance.ease, acceptance.held) = (ease, held);
        manifold
    }

    /// How readily each coordinate moves.
    pub(crate) fn ease(&self) -> &[f64] {
        &self.newton.acceptance.ease
    }

    /// Lets `coordinates` follow the others, as if they had next to no inertia.
    pub(crate) fn lighten(&mut self, coordinates: &[usize]) {
        self.factors.light = coordinates.to_vec();
    }

    /// What makes coordinates of different units comparable.
    pub(crate) fn unit(&self, j: usize) -> f64 {
        *self.newton.acceptance.units.get(j).unwrap_or(&1.0)
    }

    /// The size of `x`, coordinates of different units by these.
    pub(crate) fn size(&self, x: &[f64]) -> f64 {
        self.newton.acceptance.largest(x)
    }

    /// How large coordinates are next to `guess`, each in its unit: as large as the largest there, or as the lengths in the constraints;
    /// angles half a turn at most.
    pub(crate) fn extents(&mut self, at: &At<'_, f64>, guess: &[f64]) -> Vec<f64> {
        self.meets(at, guess, guess);
        let length = self.newton.acceptance.length(0..at.rows());
        let mut size = self.size(guess).max(length / TERMS);
        if !(size > 0.0 && size < f64::INFINITY) {
            size = 1.0;
        }
        let angles = angles(at);
        let extent = |j: usize| match size * self.unit(j) {
            extent if angles.contains(&j) => extent.min(PI),
            extent => extent,
        };
        (0..guess.len()).map(extent).collect()
    }

    /// Makes coordinates move as readily as each other from here on, those of different units as these say.
    pub(crate) fn even(&mut self) {
        let ease = self.ease().iter().enumerate();
        let readily = ease.map(|(j, ease)| (ease / self.unit(j)).ln());
        let mean = (readily.sum::<f64>() / self.ease().len().max(1) as f64).exp();
        let even = (0..self.ease().len()).map(|j| mean * self.unit(j));
        self.newton.acceptance.ease = even.collect();
    }

    /// Whether the rows of `part` determine all its unknowns beside the solution `x`.
    pub(crate) fn determines(&mut self, at: &At<'_, f64>, part: &Part, x: &[f64]) -> bool {
        self.newton.evaluate(at, x);
        self.newton.weigh(at, x);
        let values = Best::new(&self.newton, part, x).matrix.singular_values();
        let (least, most) = (values.min(), values.max());
        values.len() >= part.unknowns.len() && least > FLAT * most
    }

    /// A solution of `part` next to `x` in which coordinates other than those `untold`, where rows leave them free, have the values that
    /// they have in `guess`; none where there are no others to follow them.
    pub(crate) fn settled(
        &mut self,
        at: &At<'_, f64>,
        part: &Part,
        (x, guess): (&[f64], &[f64]),
        untold: &[usize],
    ) -> Option<Vec<f64>> {
        let mut settled = x.to_vec();
        let told = part.unknowns.iter().filter(|j| !untold.contains(j));
        let count = told.clone().count();
        if count == 0 || count == part.unknowns.len() {
            return None;
        }
        let ease = self.ease().to_vec();
        for j in untold {
            self.newton.acceptance.ease[*j] /= LIGHT;
        }
        // What the others take from them falls each time.
        let near = (0..TIMES).all(|_| {
            told.clone().for_each(|j| settled[*j] = guess[*j]);
            self.search_part(at, part, guess, &mut settled).0
        });
        self.newton.acceptance.ease = ease;
        near.then_some(settled)
    }

    /// The sign of det ∂φ/∂x at `x`, of the rows and unknowns of `part`: 0 where they are not as many as each other, or depend on each
    /// other.
    pub(crate) fn orientation(&mut self, at: &At<'_, f64>, part: &Part, x: &[f64]) -> i32 {
        if part.rows.len() != part.unknowns.len() {
            return 0;
        }
        self.newton.evaluate(at, x);
        self.newton.weigh(at, x);
        let factors = Best::new(&self.newton, part, x).matrix.lu();
        let even: f64 = factors.p().determinant();
        let signs = factors.u().diagonal().map(|d| (d > 0.0, d < 0.0));
        signs
            .iter()
            .fold(even as i32, |sign, (positive, negative)| {
                sign * (i32::from(*positive) - i32::from(*negative))
            })
    }

    /// Moves `x`, which is at or near `guess`, onto the constraints from far off, by Levenberg and Marquardt's method, and by projection
    /// in the end. Fails with the sum of the squares of the scaled residuals where it is least.
    pub(crate) fn search(
        &mut self,
        at: &At<'_, f64>,
        guess: &[f64],
        x: &mut [f64],
    ) -> Result<(), f64> {
        let held = &self.newton.acceptance.held;
        let free = (0..x.len()).filter(|j| !held.contains(j)).collect();
        let whole = Part::whole(at.rows(), free);
        let (near, met, cost) = self.search_part(at, &whole, guess, x);
        let met = met || self.meets(at, x, guess);
        let projected = (met || near) && self.project(at, x).is_ok();
        match met || projected {
            true => Ok(()),
            false => Err(cost),
        }
    }

    /// Moves the unknowns of `part` in `x`, which is at or near `guess`, to where its rows are met as nearly as projection needs. Returns
    /// whether there is such a place, whether they are met there but for rounding, as far as that has been measured, and the sum of the
    /// squares of the scaled residuals where it is least.
    pub(crate) fn search_part(
        &mut self,
        at: &At<'_, f64>,
        part: &Part,
        guess: &[f64],
        x: &mut [f64],
    ) -> (bool, bool, f64) {
        let size = self.newton.acceptance.measured(guess);
        let (mut best, mut cost): (Option<Best>, f64) = (None, f64::INFINITY);
        let (mut damping, mut stalls) = (DAMPING, 0);
        let noise = &mut self.noise;
        let (mut near, mut begun) = (None, 0.0_f64);
        let whole = part.rows.len() == at.rows();
        // Points that coincide, and leave rows without a direction, are those of the guess.
        let drawn = part.unknowns.iter().all(|j| x[*j] == guess[*j]);
        let (met, _) = self.newton.iterate(at, x, 1.0, MAX_STEPS, |newton, x, _| {
            let trial = best
                .as_ref()
                .map_or(0.0, |best| best.cost(part, &newton.residual));
            if trial < cost {
                // At the rounding level costs may fall for ever by tiny amounts.
                stalls = if trial > 0.99 * cost { stalls + 1 } else { 0 };
                damping = (damping / DAMPING_FACTOR).max(f64::EPSILON);
                newton.acceptance.size = size;
                newton.weigh(at, x);
                let measured = whole || drawn && best.is_none() || trial <= CLOSE * begun;
                if measured {
                    newton.measure(at, x, noise, None);
                }
                let there = Best::new(newton, part, x);
                cost = there.residual.norm_squared();
                begun = begun.max(cost);
                best = Some(there);
                near = measured.then(|| newton.is_near(part));
                let violated = newton.acceptance.violated(part.rows(), &newton.residual);
                if measured && violated.take(1).count() == 0 {
                    near = Some(true);
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
            let back = newton.step.iter_mut().zip(&best.x).zip(x);
            back.for_each(|((d, best), x)| *d = best - x);
            let ease = &newton.acceptance.ease;
            let turned = turned(at, part, |k| ease[part.unknowns[k]] * step[k]);
            let share = if turned > MOST { MOST / turned } else { 1.0 };
            for (j, d) in part.unknowns.iter().zip(step.iter()) {
                newton.step[*j] += share * ease[*j] * d;
            }
            (0.0, 1.0)
        });
        if let Some(best) = best {
            x.copy_from_slice(&best.x);
        }
        let near = near.unwrap_or_else(|| {
            self.meets(at, x, guess);
            self.newton.is_near(part)
        });
        (near, met > 0.5, cost)
    }
}
