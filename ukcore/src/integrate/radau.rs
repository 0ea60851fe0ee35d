//! Radau IIA of order 5 for mechanical systems.
//!
//! After Hairer & Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., Springer 1996, §IV.8: simplified Newton with a
//! factorisation kept over steps, an embedded estimate of the error, Gustafsson's predictive choice of the step size; with the constants
//! of the authors' code RADAU5.
//!
//! The state is y = (q, q̇) and y' = (q̇, a(t, q, q̇)). With wᵢ = q̇ᵢ − q̇ at the stages, positions are qᵢ = q + h (cᵢ q̇ + Σ aᵢⱼ wⱼ) and
//! only the wᵢ are unknown: A⁻¹ w / h = a. Newton's matrix for an eigenvalue λ of A⁻¹ is then n × n, a quarter of what it is for y:
//!
//! (λ/h)² − (λ/h) ∂a/∂q̇ − ∂a/∂q,
//!
//! once for the real eigenvalue, once for the complex pair.
//!
//! One Jacobian for a whole step is not enough where a stiff direction turns within it, as that of a hard spring does: measured on a
//! spring pendulum of stiffness k, the iterations then converge for steps below k^−¼ only. Where they do not, the Jacobians of the three
//! stages go into one matrix 3n × 3n, and Newton's method takes steps as the slow motion allows them. At tolerance 1e-6 these are four
//! times as long at k = 10⁸, and twenty-five times at 10¹².

pub(super) mod newton;

use super::Tolerance;
use super::control::{SAFETY, StepSize, first_size};
use super::course::Trial;
use super::sample::Sample;
use super::scheme::{Equations, Scheme};
use super::stepper::Rates;
use super::sums::{sized, sum_of_squares, weights};
use super::trouble::Cause;
use newton::{Matrices, Newton, Solved};

/// (4 ∓ √6)/10 and 1: the stages, §IV.5 (table 5.6).
pub(super) const C: [f64; 3] = [0.155_051_025_721_682_2, 0.644_948_974_278_317_8, 1.0];

/// Weights of the stages in the estimate of the error, eq. (8.19) with γ₀⁻¹ taken out: (−13 ∓ 7√6)/3, −1/3.
const ERROR: [f64; 3] = [-10.048_809_399_827_416, 1.382_142_733_160_749, -1.0 / 3.0];

/// Least and largest factor between two steps.
const FACTORS: (f64, f64) = (0.2, 8.0);

/// The error is estimated as one of a method of order 3, and falls with the power 4 of the step.
const ORDER: f64 = 4.0;

/// A step that would grow by less than this factor keeps its size, and with it the factors.
const KEEP: f64 = 1.2;

/// Newton's method converging faster than this keeps the Jacobian.
const FAST: f64 = 1e-3;

/// Errors count as at least this much where the next step looks back on them.
const SMALLEST_PREVIOUS: f64 = 1e-2;

/// A step that would damp away velocities with more than this share of the kinetic energy is to be as short as they ask for.
const MUCH: f64 = 1e-4;

/// Relative tolerance of the estimate, which is of order 3, for a step of order 5 to have that of the run: 0.1 run^⅔, as in RADAU5.
fn estimate_tolerance(run: f64) -> f64 {
    0.1 * run.powf(2.0 / 3.0)
}

/// The relative tolerance of a run, where that of the estimate is `estimate`.
fn run_tolerance(estimate: f64) -> f64 {
    (10.0 * estimate).powf(1.5)
}

/// Whether the Jacobian changes so much within steps that one of it will not do.
#[derive(Default)]
struct Turning {
    /// Steps for which that is taken for granted.
    left: usize,
    /// The number of such steps the last time.
    before: usize,
}

impl Turning {
    fn expected(&mut self) -> bool {
        let expected = self.left > 0;
        self.left = self.left.saturating_sub(1);
        expected
    }

    /// Whether one Jacobian did. If not, it is tried again ever more seldom.
    fn tried(&mut self, solved: bool) {
        self.before = if solved {
            0
        } else {
            (2 * self.before).clamp(4, 64)
        };
        self.left = self.before;
    }
}

/// The state at the start of a step with n coordinates, buffers, and what the last attempted one left in them.
pub(super) struct Radau {
    n: usize,
    newton: Newton,
    /// The tolerance of the estimate of the error.
    tolerance: Tolerance,
    size: StepSize,
    /// State at the start of the step, and at its end.
    start: Vec<f64>,
    end: Vec<f64>,
    /// f at the start and at the end of the step.
    rate: Vec<f64>,
    end_rate: Vec<f64>,
    weights: Vec<f64>,
    error: Vec<f64>,
    /// Coefficients of the collocation polynomial: of the closed step, and of the accepted one before, whose size is `h_previous`.
    dense: Vec<f64>,
    previous: Vec<f64>,
    h_previous: Option<f64>,
    turning: Turning,
    /// What Newton's method, where it failed, takes the step times.
    shorten: f64,
    /// The largest kinetic energy of a step's start so far.
    liveliest: f64,
}

impl Radau {
    /// The method at a state, with the tolerance of the run.
    pub(super) fn new(start: &[f64], mut tolerance: Tolerance) -> Self {
        tolerance.relative = estimate_tolerance(tolerance.relative);
        let n = start.len() / 2;
        let zeros = |rows: usize| vec![0.0; rows * start.len()];
        Radau {
            n,
            newton: Newton::new(n),
            tolerance,
            size: StepSize::default(),
            start: start.to_vec(),
            end: zeros(1),
            rate: zeros(1),
            end_rate: zeros(1),
            weights: zeros(1),
            error: zeros(1),
            dense: zeros(4),
            previous: zeros(4),
            h_previous: None,
            turning: Turning::default(),
            shorten: 0.5,
            liveliest: 0.0,
        }
    }

    /// Starting values of the stages: the polynomial of the step before, extrapolated. Where there is none they stay at the start.
    fn extrapolate(&mut self, h: f64) {
        let n = self.n;
        let Some(h_previous) = self.h_previous else {
            self.newton.w.fill(0.0);
            return;
        };
        let row = |k: usize| &self.previous[(2 * k + 1) * n..][..n];
        for (w, c) in self.newton.w.chunks_exact_mut(n).zip(C) {
            // p(1 + s) − p(1) of the form of `Interpolant`.
            let s = c * h / h_previous;
            for (i, w) in w.iter_mut().enumerate() {
                *w = s * (row(1)[i] - (1.0 + s) * (row(2)[i] + (1.0 + s) * row(3)[i]));
            }
        }
    }

    /// The stages; `false` if they are not found.
    fn solve(
        &mut self,
        matrices: Matrices,
        equations: &mut Equations<'_>,
        step: Trial,
    ) -> Result<bool, Cause> {
        self.extrapolate(step.h);
        let (y, weights, tolerance) = (&self.start, &self.weights, self.tolerance.relative);
        let solved = (self.newton).solve(matrices, equations, step, y, weights, tolerance)?;
        if let Solved::No { shorten } = solved {
            self.shorten = shorten;
        }
        Ok(matches!(solved, Solved::Yes))
    }

    /// The error of the attempted step in the error norm, eq. (8.20); where a first or repeated step fails by it, the estimate of eq.
    /// (8.21).
    fn estimate(&mut self, equations: &mut Equations<'_>, step: Trial) -> f64 {
        let norm = |error: &[f64], weights: &[f64]| {
            (sum_of_squares(error, weights) / weights.len().max(1) as f64).sqrt()
        };
        self.newton
            .filter(step.h, &ERROR, &self.rate, &mut self.error);
        let error = norm(&self.error, &self.weights);
        let again = self.size.rejected || self.size.last.is_none();
        if error < 1.0 || !again || self.takes_out(equations, step) {
            return error;
        }
        for (x, y) in self.error.iter_mut().zip(&self.start) {
            *x += y;
        }
        let rate = &mut self.end_rate;
        if equations.rate(step.start.s, &self.error, rate).is_err() {
            return error;
        }
        self.newton
            .filter(step.h, &ERROR, &self.end_rate, &mut self.error);
        norm(&self.error, &self.weights)
    }

    /// Whether velocities that stiff forces take back within the step hold much of the kinetic energy: those of a body that strikes a hard
    /// spring do, and the step would damp its impact away.
    fn takes_out(&self, equations: &mut Equations<'_>, step: Trial) -> bool {
        let start = equations.at(step.start.s, &self.start);
        let end = equations.at(step.end.s, &self.end);
        let v = &self.error[self.n..];
        let lost = Sample { v, ..start };
        let all = [start, end, lost].map(|at| equations.problem.kinetic(at));
        let [has, gets, lost] = all;
        lost > MUCH * self.liveliest.max(has).max(gets)
    }

    /// What the size `h` is to be divided by to meet the tolerance: less of it is risked where Newton's method took long.
    fn quotient(&self, error: f64) -> f64 {
        let most = 1.0 + 2.0 * newton::MOST as f64;
        let slow = most / (self.newton.iterations as f64 + 2.0 * newton::MOST as f64);
        let safety = SAFETY * slow.min(1.0);
        error.max(1e-10).powf(1.0 / ORDER) / safety
    }
}

impl Scheme for Radau {
    fn gap(&self) -> Option<[f64; 2]> {
        Some([0.155, 0.645])
    }

    fn tolerate(&mut self, tolerance: &Tolerance) {
        self.tolerance.clone_from(tolerance);
        self.tolerance.relative = estimate_tolerance(tolerance.relative);
    }

    fn states(&self) -> [&[f64]; 2] {
        [&self.start, &self.end]
    }

    fn end_mut(&mut self) -> &mut [f64] {
        &mut self.end
    }

    fn begin(&mut self, equations: &mut Equations<'_>) -> Result<(), Cause> {
        self.newton.forget();
        self.h_previous = None;
        equations.rate(equations.course.now.s, &self.start, &mut self.rate)
    }

    fn first_size(&mut self, equations: &mut Equations<'_>, largest: f64) -> f64 {
        let start = [&self.start[..], &self.rate];
        let s = equations.course.now.s;
        first_size(equations, s, start, largest, ORDER, &self.tolerance)
    }

    fn attempt(&mut self, equations: &mut Equations<'_>, step: Trial) -> Result<f64, Cause> {
        let n = self.n;
        self.shorten = 0.5;
        self.newton.prepare(equations, step, &self.start)?;
        weights(&mut self.weights, &self.start, &self.start, &self.tolerance);
        let by_stages = self.turning.expected();
        let matrices = if by_stages {
            Matrices::Stages
        } else {
            Matrices::Start
        };
        let mut solved = self.solve(matrices, equations, step)?;
        if !by_stages {
            self.turning.tried(solved);
            if !solved {
                solved = self.solve(Matrices::Stages, equations, step)?;
            }
        }
        if !solved {
            self.turning = Turning::default();
            return Err(None);
        }
        let changes = self.newton.z[2 * n..].iter().chain(&self.newton.w[2 * n..]);
        for (end, (start, change)) in self.end.iter_mut().zip(self.start.iter().zip(changes)) {
            *end = start + change;
        }
        weights(&mut self.weights, &self.start, &self.end, &self.tolerance);
        Ok(self.estimate(equations, step))
    }

    fn close(&mut self, equations: &mut Equations<'_>, step: Trial) -> Result<f64, Cause> {
        equations.rate(step.end.s, &self.end, &mut self.end_rate)?;
        let kinetic = (equations.problem).kinetic(equations.at(step.start.s, &self.start));
        self.liveliest = self.liveliest.max(kinetic);
        // The polynomial through start and stages; the end is the projected one.
        let n = self.n;
        let (c0, rest) = self.dense.split_at_mut(2 * n);
        let (c1, rest) = rest.split_at_mut(2 * n);
        let (c2, c3) = rest.split_at_mut(2 * n);
        c0.copy_from_slice(&self.start);
        for (half, stages) in [&self.newton.z, &self.newton.w].into_iter().enumerate() {
            for i in 0..n {
                let end = stages[2 * n + i];
                let [first, second] =
                    [0, 1].map(|k| (stages[k * n + i] / C[k] - end) / (1.0 - C[k]));
                let slope = (second - first) / (C[1] - C[0]);
                let i = half * n + i;
                c1[i] = self.end[i] - self.start[i];
                c2[i] = first - C[0] * slope;
                c3[i] = slope;
            }
        }
        // What the polynomial's slope misses of the acceleration at the end, which is the last stage.
        let residual = &mut self.error[..n];
        for (i, residual) in residual.iter_mut().enumerate() {
            let slope = self.newton.w[2 * n + i] - c2[n + i] - c3[n + i];
            *residual = step.h * self.end_rate[n + i] - slope;
        }
        let (y, weights, tolerance) = (&self.start, &self.weights, self.tolerance.relative);
        let solved = (self.newton).confirms(equations, step, y, weights, tolerance, residual)?;
        Ok(if solved { 0.0 } else { f64::NAN })
    }

    fn dense(&self) -> &[f64] {
        &self.dense
    }

    /// Scales the error to this norm, in the direction of the error of order 3.
    fn scale_error(&mut self, norm: f64) {
        let states = [&self.start[..], &self.end];
        let share = run_tolerance(self.tolerance.relative) / self.tolerance.relative;
        sized(&mut self.error, states, &self.tolerance, share * norm);
    }

    fn error(&self) -> Option<&[f64]> {
        Some(&self.error)
    }

    fn advance(&mut self) {
        self.start.copy_from_slice(&self.end);
        std::mem::swap(&mut self.rate, &mut self.end_rate);
        std::mem::swap(&mut self.dense, &mut self.previous);
        self.newton.advance();
    }

    fn accepted(&mut self, h: f64, error: f64) -> f64 {
        let (shrink, grow) = FACTORS;
        let clamp = |quotient: f64| quotient.clamp(1.0 / grow, 1.0 / shrink);
        let mut quotient = clamp(self.quotient(error));
        if let Some((h_before, before)) = self.size.last {
            // Eq. (8.25).
            let before = before.max(SMALLEST_PREVIOUS);
            let predicted = h_before / h * (error * error / before).powf(1.0 / ORDER);
            quotient = quotient.max(clamp(predicted / SAFETY));
        }
        if self.size.rejected {
            quotient = quotient.max(1.0);
        }
        self.size.accept(h, error);
        self.h_previous = Some(h);
        let factor = quotient.recip();
        if (1.0..=KEEP).contains(&factor) && !self.newton.stale {
            h
        } else {
            h * factor
        }
    }

    fn inaccurate(&mut self, h: f64, error: f64) -> f64 {
        self.newton.refused();
        self.size.rejected = true;
        let (shrink, grow) = FACTORS;
        if error.is_nan() {
            h * self.shorten
        } else if self.size.last.is_none() {
            0.1 * h
        } else {
            h / self.quotient(error).clamp(1.0 / grow, 1.0 / shrink)
        }
    }

    fn unfit(&mut self, h: f64) -> f64 {
        self.newton.refused();
        self.size.unfit(h)
    }

    fn factorisations(&self) -> usize {
        self.newton.factorisations
    }
}
