//! The stages of a step, by simplified Newton iterations.

use nalgebra::Complex;

use super::C;
use crate::integrate::course::Trial;
use crate::integrate::scheme::Equations;
use crate::integrate::trouble::Cause;
use crate::lu::Lu;
use crate::scan::axpy;

/// Most iterations.
pub(super) const MOST: usize = 7;

/// Changes that do not shrink below this multiple of what rounding makes of them have converged as far as they can.
const ROUNDING: f64 = 10.0;

/// A, book §IV.5, table 5.6.
pub(in crate::integrate) const A: [[f64; 3]; 3] = [
    [
        0.196_815_477_223_660_4,
        -0.065_535_425_850_198_39,
        0.023_770_974_348_220_15,
    ],
    [
        0.394_424_314_739_087_3,
        0.292_073_411_665_228_5,
        -0.041_548_752_125_997_93,
    ],
    [
        0.376_403_062_700_467_25,
        0.512_485_826_188_421_6,
        0.111_111_111_111_111_1,
    ],
];

/// The eigenvalues of A: the real one and, of the pair, the one with negative imaginary part. λ of the module are their reciprocals.
pub(in crate::integrate) const REAL: f64 = 0.274_888_829_595_677_34;
pub(in crate::integrate) const PAIR: Complex<f64> =
    Complex::new(0.162_555_585_202_161_32, -0.184_949_324_407_140_8);

/// T: w = T (W₁, Re W₂, Im W₂) makes A⁻¹ diagonal, and T⁻¹; §IV.8, with the digits of the authors' code.
pub(in crate::integrate) const T: [[f64; 3]; 3] = [
    [
        0.091_232_394_870_892_95,
        -0.141_255_295_020_954_2,
        -0.030_029_194_105_147_424,
    ],
    [
        0.241_717_932_707_107,
        0.204_129_352_293_799_94,
        0.382_942_112_757_261_9,
    ],
    [0.966_048_182_615_093, 1.0, 0.0],
];
pub(in crate::integrate) const T_INVERSE: [[f64; 3]; 3] = [
    [
        4.325_579_890_063_155,
        0.339_199_251_815_809_84,
        0.541_770_539_935_874_9,
    ],
    [
        -4.178_718_591_551_905,
        -0.327_682_820_761_062_37,
        0.476_623_554_500_550_44,
    ],
    [
        -0.502_872_634_945_786_8,
        2.571_926_949_855_605,
        -0.596_039_204_828_224_9,
    ],
];

/// Iterations that converge more slowly than this use new matrices of the stages.
const SLOW: f64 = 0.1;

/// Changes that shrink by this factor only do not converge.
const CONVERGING: f64 = 0.99;

/// Iterations with new matrices before it is judged whether they converge.
const PATIENCE: usize = 5;

/// Which Jacobians the iterations use.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Matrices {
    /// The Jacobian at the start of the step, or an older one, for all stages: two matrices n × n, kept over steps.
    Start,
    /// One at each stage: a matrix 3n × 3n, for this step alone. Where stiff directions turn with the motion, as a spring does, this takes
    /// far longer steps.
    Stages,
}

/// The convergence of the iterations of the step before.
#[derive(Debug, Clone, Copy)]
enum Known {
    /// θ/(1 − θ): what remains of the solution's error after a change, over the change.
    Linear(f64),
    /// The second change over the square of the first: Newton's method with new matrices.
    Quadratic(f64),
}

/// Factor on the change that the next iteration would make, where it is not made: stiff directions turn errors that are small into forces
/// that are not.
const CAUTION: f64 = 10.0;

/// What the equations may be off, or a further change be, after one iteration, in the error norm.
const LEFT: f64 = 0.03;

/// How the iterations ended.
pub(super) enum Solved {
    /// The iterations converged.
    Yes,
    /// The iterations did not converge, and the step should be that many times as long.
    No { shorten: f64 },
}

/// The matrix of all stages: 1 − h A (∂a/∂q̇ + ∂a/∂q h A), with the derivatives of each stage.
struct Stages {
    n: usize,
    jacobians: [Vec<f64>; 3],
    lu: Lu<f64>,
}

impl Stages {
    fn new(n: usize) -> Self {
        Stages {
            n,
            jacobians: [(); 3].map(|()| vec![0.0; 2 * n * n]),
            lu: Lu::new(3 * n),
        }
    }

    fn factor(&mut self, h: f64) -> bool {
        let n = self.n;
        let entries = self.lu.entries_mut();
        for (j, column) in entries.chunks_exact_mut(3 * n).enumerate() {
            // Component `own` of stage `stage` changes.
            let (stage, own) = (j / n, j % n);
            for (i, row) in A.iter().enumerate() {
                let out = &mut column[i * n..][..n];
                out.fill(0.0);
                for (k, jacobian) in self.jacobians.iter().enumerate() {
                    let factor = h * row[k] * h * A[k][stage];
                    axpy(-factor, &jacobian[own * n..][..n], out);
                }
                let by_velocity = &self.jacobians[stage][(n + own) * n..][..n];
                axpy(-h * row[stage], by_velocity, out);
            }
            column[j] += 1.0;
        }
        self.lu.factor(0.0)
    }
}

/// Matrices and iterates.
pub(super) struct Newton {
    n: usize,
    /// ∂a/∂q and ∂a/∂q̇, n × 2n, column-major.
    jacobian: Vec<f64>,
    /// The Jacobian is that of the start of this step; it is to be computed anew.
    fresh: bool,
    pub(super) stale: bool,
    /// The matrices of both eigenvalues, times (h/λ)², and the step they belong to.
    real: Lu<f64>,
    pair: Lu<Complex<f64>>,
    factored: Option<f64>,
    /// Made where it is needed first.
    stages: Option<Stages>,
    /// Velocities and positions of the stages less those at the start.
    pub(super) w: Vec<f64>,
    pub(super) z: Vec<f64>,
    /// W, and its changes.
    diagonal: Vec<f64>,
    change_real: Vec<f64>,
    change_pair: Vec<Complex<f64>>,
    /// State of a stage, accelerations of all.
    stage: Vec<f64>,
    acceleration: Vec<f64>,
    /// Iterations of the last attempt, their rate of convergence θ, and what the next step may know of it.
    pub(super) iterations: usize,
    theta: f64,
    /// Size of the last change, and how it was found.
    size: f64,
    matrices: Matrices,
    known: Option<Known>,
    /// Factorisations of pairs of matrices so far.
    pub(super) factorisations: usize,
}

impl Newton {
    /// Buffers for n coordinates.
    pub(super) fn new(n: usize) -> Self {
        let zeros = |rows: usize| vec![0.0; rows * n];
        Newton {
            n,
            jacobian: zeros(2 * n),
            fresh: false,
            stale: true,
            real: Lu::new(n),
            pair: Lu::new(n),
            factored: None,
            stages: None,
            w: zeros(3),
            z: zeros(3),
            diagonal: zeros(3),
            change_real: zeros(1),
            change_pair: vec![Complex::ZERO; n],
            stage: zeros(2),
            acceleration: zeros(3),
            iterations: 1,
            theta: 0.0,
            size: 0.0,
            matrices: Matrices::Start,
            known: None,
            factorisations: 0,
        }
    }

    /// The run has moved on.
    pub(super) fn advance(&mut self) {
        self.fresh = false;
        self.stale = self.theta > super::FAST;
    }

    /// f has changed.
    pub(super) fn forget(&mut self) {
        (self.fresh, self.stale) = (false, true);
    }

    /// The step is tried again.
    pub(super) fn refused(&mut self) {
        self.stale = !self.fresh;
    }

    /// Jacobian and factors for `step` from `y`, as far as those in hand will not do.
    pub(super) fn prepare(
        &mut self,
        equations: &mut Equations<'_>,
        step: Trial,
        y: &[f64],
    ) -> Result<(), Cause> {
        if self.stale {
            let out = &mut self.acceleration[..self.n];
            equations.jacobian(step.start.s, y, out, &mut self.jacobian)?;
            (self.fresh, self.stale, self.factored) = (true, false, None);
        }
        if self.factored == Some(step.h) {
            return Ok(());
        }
        self.factored = None;
        let (real, pair) = (step.h * REAL, PAIR * step.h);
        let (by_position, by_velocity) = self.jacobian.split_at(self.n * self.n);
        let entries = by_position.iter().zip(by_velocity);
        let targets = self.real.entries_mut().iter_mut();
        let targets = targets.zip(self.pair.entries_mut());
        for ((x, z), (q, v)) in targets.zip(entries) {
            *x = -real * (v + real * q);
            *z = -pair * (pair * *q + v);
        }
        for i in 0..self.n {
            self.real.entries_mut()[i * self.n + i] += 1.0;
            self.pair.entries_mut()[i * self.n + i] += 1.0;
        }
        self.factorisations += 1;
        // Singular by chance, or with entries that are no numbers: of no step that is short enough.
        if !(self.real.factor(0.0) && self.pair.factor(0.0)) {
            return Err(None);
        }
        self.factored = Some(step.h);
        Ok(())
    }

    /// Iterates from starting values w to the stages of `step` from `y`. `tolerance` is that of `weights`.
    pub(super) fn solve(
        &mut self,
        matrices: Matrices,
        equations: &mut Equations<'_>,
        step: Trial,
        y: &[f64],
        weights: &[f64],
        tolerance: f64,
    ) -> Result<Solved, Cause> {
        let enough = enough(tolerance);
        self.matrices = matrices;
        self.positions(step.h, y);
        match matrices {
            Matrices::Start => transform(&T_INVERSE, &self.w, &mut self.diagonal),
            Matrices::Stages => {}
        }
        // What is known of the convergence from before fades, and holds for the same kind of matrices only.
        let (mut remaining, mut quadratic) = match (matrices, self.known.take()) {
            (Matrices::Start, Some(Known::Linear(known))) => {
                (known.max(f64::EPSILON).powf(0.8), None)
            }
            (Matrices::Stages, Some(Known::Quadratic(known))) => (1.0, Some(2.0 * known)),
            _ => (1.0, None),
        };
        self.theta = 0.0;
        let (mut before, mut ratio_before) = (None, None);
        for iteration in 1..=MOST {
            self.iterations = iteration;
            let anew = matrices == Matrices::Stages && (iteration == 1 || self.theta > SLOW);
            if !self.evaluate(anew, equations, step, y)? {
                return Ok(Solved::No { shorten: 0.5 });
            }
            let size = self.improve(step.h, y, weights);
            if !size.is_finite() {
                return Ok(Solved::No { shorten: 0.5 });
            }
            if let (1, Some(quadratic)) = (iteration, quadratic) {
                remaining = f64::min(CAUTION * quadratic * size, 1.0);
            }
            if let Some(before) = before {
                let ratio: f64 = size / before;
                self.theta = match matrices {
                    Matrices::Start => (ratio * ratio_before.unwrap_or(ratio)).sqrt(),
                    Matrices::Stages => ratio,
                };
                ratio_before = Some(ratio);
                if iteration == 2 {
                    quadratic = Some(ratio / before);
                }
                remaining = if self.theta < CONVERGING {
                    self.theta / (1.0 - self.theta)
                } else {
                    f64::INFINITY
                };
                // Newton's method may go astray at first; nothing follows from its first steps.
                let judge = matrices == Matrices::Start || iteration >= PATIENCE;
                if judge && let Some(shorten) = self.hopeless(remaining * size / enough) {
                    return Ok(if size <= self.rounding(step.h, y, weights) {
                        Solved::Yes
                    } else {
                        Solved::No { shorten }
                    });
                }
            }
            if remaining * size <= enough {
                self.known = match matrices {
                    Matrices::Start => Some(Known::Linear(remaining)),
                    Matrices::Stages => quadratic.map(Known::Quadratic),
                };
                return Ok(Solved::Yes);
            }
            before = Some(size);
        }
        Ok(Solved::No { shorten: 0.5 })
    }

    /// Whether a step that was solved in one iteration, for what was known of the convergence before, is solved indeed: where forces jump,
    /// or are stiff for a moment only, the first change may be all wrong or hardly be one. `residual` is what is left of the equations of
    /// the last stage, times h; the iteration is repeated where it says so.
    pub(super) fn confirms(
        &mut self,
        equations: &mut Equations<'_>,
        step: Trial,
        y: &[f64],
        weights: &[f64],
        tolerance: f64,
        residual: &mut [f64],
    ) -> Result<bool, Cause> {
        let n = self.n;
        let norm = |x: &[f64]| {
            let pairs = x.iter().zip(&weights[n..]);
            let square: f64 = pairs.map(|(x, weight)| (x * weight).powi(2)).sum();
            (square / n.max(1) as f64).sqrt()
        };
        let before = self.size;
        if self.iterations > 1 || norm(residual) <= LEFT {
            return Ok(true);
        }
        let left = match (self.matrices, &mut self.stages) {
            (Matrices::Stages, Some(stages)) => {
                for (x, row) in self.diagonal.chunks_exact_mut(n.max(1)).zip(A) {
                    let pairs = x.iter_mut().zip(&*residual);
                    pairs.for_each(|(x, residual)| *x = row[2] * residual);
                }
                stages.lu.solve(&mut self.diagonal);
                norm(&self.diagonal[2 * n..])
            }
            _ => {
                self.real.solve(residual);
                norm(residual)
            }
        };
        if left <= LEFT && left <= 0.5 * before {
            return Ok(true);
        }
        let anew = self.matrices == Matrices::Stages;
        if !self.evaluate(anew, equations, step, y)? {
            return Ok(false);
        }
        transform(&T_INVERSE, &self.w, &mut self.diagonal);
        let size = self.improve(step.h, y, weights);
        (self.theta, self.known) = (size / before, None);
        let remaining = self.theta / (1.0 - self.theta);
        let converges = self.theta < CONVERGING && remaining * size <= enough(tolerance);
        Ok(converges || size <= self.rounding(step.h, y, weights))
    }

    /// The factor to multiply the step by, where the iterations will not get from `error` to below 1.
    fn hopeless(&self, error: f64) -> Option<f64> {
        if error.is_infinite() {
            return Some(0.5);
        }
        let left = MOST.checked_sub(1 + self.iterations)? as i32;
        let last = error * self.theta.powi(left);
        let power = 1.0 / f64::from(4 + left);
        (last >= 1.0).then(|| 0.8 * last.min(20.0).powf(-power))
    }

    /// z = h (c q̇ + A w).
    fn positions(&mut self, h: f64, y: &[f64]) {
        let n = self.n;
        transform(&A, &self.w, &mut self.z);
        for (z, c) in self.z.chunks_exact_mut(n).zip(C) {
            for (z, v) in z.iter_mut().zip(&y[n..]) {
                *z = h * (c * v + *z);
            }
        }
    }

    /// a at the stages; `anew` also the Jacobians there, and the matrix of all stages, factored. `false` if that is singular.
    fn evaluate(
        &mut self,
        anew: bool,
        equations: &mut Equations<'_>,
        step: Trial,
        y: &[f64],
    ) -> Result<bool, Cause> {
        let n = self.n;
        if anew {
            self.stages.get_or_insert_with(|| Stages::new(n));
        }
        for (k, c) in C.into_iter().enumerate() {
            let changes = self.z[k * n..][..n].iter().chain(&self.w[k * n..][..n]);
            for (stage, (y, change)) in self.stage.iter_mut().zip(y.iter().zip(changes)) {
                *stage = y + change;
            }
            let (s, out) = (
                step.start.s + c * step.h,
                &mut self.acceleration[k * n..][..n],
            );
            match &mut self.stages {
                Some(stages) if anew => {
                    let jacobian = &mut stages.jacobians[k];
                    equations.jacobian(s, &self.stage, out, jacobian)?;
                }
                _ => equations.acceleration(s, &self.stage, out)?,
            }
        }
        if let (true, Some(stages)) = (anew, &mut self.stages) {
            self.factorisations += 1;
            return Ok(stages.factor(step.h));
        }
        Ok(true)
    }

    /// W changes by (h/λ T⁻¹ a − W) through the factors; the new w comes into the place of a.
    fn improve_by_start(&mut self, h: f64) {
        let n = self.n;
        let (first, pair) = self.diagonal.split_at_mut(n);
        let (second, third) = pair.split_at_mut(n);
        for i in 0..n {
            let a = [0, 1, 2].map(|k| self.acceleration[k * n + i]);
            let [x, re, im] = T_INVERSE.map(|row| row[0] * a[0] + row[1] * a[1] + row[2] * a[2]);
            self.change_real[i] = h * REAL * x - first[i];
            self.change_pair[i] =
                PAIR * h * Complex::new(re, im) - Complex::new(second[i], third[i]);
        }
        self.real.solve(&mut self.change_real);
        self.pair.solve(&mut self.change_pair);
        for i in 0..n {
            first[i] += self.change_real[i];
            second[i] += self.change_pair[i].re;
            third[i] += self.change_pair[i].im;
        }
        transform(&T, &self.diagonal, &mut self.acceleration);
    }

    /// w changes by (h A a − w) through the factors of all stages; the new w comes into the place of a.
    fn improve_by_stages(&mut self, h: f64) {
        let Some(stages) = &mut self.stages else {
            return;
        };
        let x = &mut self.diagonal;
        transform(&A, &self.acceleration, x);
        for (x, w) in x.iter_mut().zip(&self.w) {
            *x = h * *x - w;
        }
        stages.lu.solve(x);
        for (a, (w, x)) in self.acceleration.iter_mut().zip(self.w.iter().zip(x)) {
            *a = w + *x;
        }
    }

    /// An iteration. Returns the size of the change in the error norm.
    fn improve(&mut self, h: f64, y: &[f64], weights: &[f64]) -> f64 {
        match self.matrices {
            Matrices::Start => self.improve_by_start(h),
            Matrices::Stages => self.improve_by_stages(h),
        }
        self.size = self.change(h, y, weights);
        self.size
    }

    /// Takes over the new w, computes z. Returns the size of the change in the error norm.
    fn change(&mut self, h: f64, y: &[f64], weights: &[f64]) -> f64 {
        let n = self.n;
        let mut square = 0.0;
        let mut add = |change: f64, weight: f64| square += (change * weight) * (change * weight);
        std::mem::swap(&mut self.w, &mut self.acceleration);
        for (i, (new, old)) in self.w.iter().zip(&self.acceleration).enumerate() {
            add(new - old, weights[n + i % n]);
        }
        self.acceleration.copy_from_slice(&self.z);
        self.positions(h, y);
        for (i, (new, old)) in self.z.iter().zip(&self.acceleration).enumerate() {
            add(new - old, weights[i % n]);
        }
        (square / (6.0 * n.max(1) as f64)).sqrt()
    }

    /// Size in the error norm of changes that may be rounding: a stiff force multiplies the rounding of positions by as much as the
    /// matrices divide by, so that positions keep theirs, and velocities have that of positions by λ/h; a force that is not so stiff gives
    /// them that of its impulse.
    fn rounding(&self, h: f64, y: &[f64], weights: &[f64]) -> f64 {
        let n = self.n;
        let (q, v) = y.split_at(n);
        let by_stages = self.stages.iter().flat_map(|stages| &stages.jacobians);
        let by_stages = by_stages.filter(|_| self.matrices == Matrices::Stages);
        let jacobians = by_stages.chain([&self.jacobian]);
        let force = |i: usize| {
            let terms = |jacobian: &Vec<f64>| -> f64 {
                (0..n).map(|j| (jacobian[j * n + i] * q[j]).abs()).sum()
            };
            jacobians.clone().map(terms).fold(0.0, f64::max)
        };
        let mut square = 0.0;
        for i in 0..n {
            let position = q[i].abs() + (h * v[i]).abs();
            let stiff = q[i].abs() / (h.abs() * REAL);
            let velocity = v[i].abs() + stiff.min(h.abs() * force(i));
            square += (position * weights[i]).powi(2) + (velocity * weights[n + i]).powi(2);
        }
        ROUNDING * f64::EPSILON * (square / (2.0 * n.max(1) as f64)).sqrt()
    }

    /// (γ/h − J)⁻¹ (f + Σ e (z, w) / h) into `out`, with f = `rate` and γ the real eigenvalue: an error as stiff equations damp it.
    pub(super) fn filter(&mut self, h: f64, e: &[f64; 3], rate: &[f64], out: &mut [f64]) {
        let n = self.n;
        // (p, r) = h f + Σ e (z, w).
        for (i, (out, rate)) in out.iter_mut().zip(rate).enumerate() {
            let (stages, i) = if i < n {
                (&self.z, i)
            } else {
                (&self.w, i - n)
            };
            *out = h * rate + e[0] * stages[i] + e[1] * stages[n + i] + e[2] * stages[2 * n + i];
        }
        let (p, r) = out.split_at_mut(n);
        // q: E x = μ p + h μ² (r − ∂a/∂q̇ p); q̇: (x / μ − p) / h.
        for (p, column) in p.iter().zip(self.jacobian[n * n..].chunks_exact(n)) {
            axpy(-p, column, r);
        }
        let x = &mut self.change_real;
        for i in 0..n {
            x[i] = REAL * p[i] + h * REAL * REAL * r[i];
        }
        self.real.solve(x);
        for i in 0..n {
            r[i] = (x[i] / REAL - p[i]) / h;
            p[i] = x[i];
        }
    }
}

/// What is left to iterate, in the error norm of this tolerance, is to be small against the error of the step.
fn enough(tolerance: f64) -> f64 {
    f64::max(10.0 * f64::EPSILON / tolerance, tolerance.sqrt().min(0.03))
}

/// `out` = matrix `x`, of three stages.
fn transform(matrix: &[[f64; 3]; 3], x: &[f64], out: &mut [f64]) {
    let n = x.len() / 3;
    for (row, out) in matrix.iter().zip(out.chunks_exact_mut(n.max(1))) {
        for (i, out) in out.iter_mut().enumerate() {
            *out = row[0] * x[i] + row[1] * x[n + i] + row[2] * x[2 * n + i];
        }
    }
}
