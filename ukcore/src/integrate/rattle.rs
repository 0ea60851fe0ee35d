//! RATTLE, composed to order 4: a symplectic method with a fixed step for conservative motion under holonomic constraints.
//!
//! One stage of size h from (q₀, v₀) to (q₁, v₁) (Hairer, Lubich & Wanner, *Geometric Numerical Integration*, §VII.1.4):
//!
//! v½ = v₀ + h/2 (M⁻¹Q(q₀) + M⁻¹A(q₀)ᵀλ),  q₁ = q₀ + h v½ with φ(q₁) = 0,
//! v₁ = v½ + h/2 (M⁻¹Q(q₁) + M⁻¹A(q₁)ᵀμ) with A(q₁) v₁ = 0.
//!
//! As λ and μ are whatever meets the constraints, q̈ may stand for M⁻¹Q: the two differ by M⁻¹Aᵀ times something. q̈ includes a good
//! guess of λ, which leaves little to Newton's method; and one evaluation, at q₁ and the projected v½, serves the end of a stage and the
//! start of the next one.
//!
//! A stage is symmetric and of order 2. Five of them with sizes γh, γh, (1 − 4γ)h, γh, γh make order 4 (Suzuki's composition, §II.4).

use super::course::Trial;
use super::dense::cubic;
use super::scheme::{Equations, Scheme};
use super::stepper::Rates;
use super::sums::keeping;
use super::trouble::{Cause, Trouble};
use crate::error::{Error, named};

/// γ = 1/(4 − ∛4).
const GAMMA: f64 = 0.414_490_771_794_375_7;

/// Sizes of the stages, as shares of the step.
const SHARES: [f64; 5] = [GAMMA, GAMMA, 1.0 - 4.0 * GAMMA, GAMMA, GAMMA];

/// The state at the start of a step with n coordinates, and buffers.
pub(super) struct Rattle {
    n: usize,
    /// Signed size of all steps.
    step: f64,
    /// State at the start of the step, and in the course of the attempted one.
    start: Vec<f64>,
    end: Vec<f64>,
    /// q̇ and q̈ at the start of the step, where q̈ may be off by M⁻¹Aᵀ times something.
    rate: Vec<f64>,
    /// q̇ and q̈ in the course of the attempted step.
    stage_rate: Vec<f64>,
    /// What rounding took from the state at the start of the step, and in the course of the attempted one.
    lost: Vec<f64>,
    losing: Vec<f64>,
    /// q at the start of a stage.
    base: Vec<f64>,
    /// What the constraints add to q in a stage.
    shift: Vec<f64>,
    dense: Vec<f64>,
}

impl Rattle {
    /// The method at a state, over the time `span` of either sign, in equal steps of at most `step`.
    pub(super) fn new(start: &[f64], step: f64, span: f64) -> Self {
        let n = start.len() / 2;
        let zeros = |rows: usize| vec![0.0; rows * n];
        Rattle {
            n,
            step: span / (span.abs() / step).ceil().max(1.0),
            start: start.to_vec(),
            end: zeros(2),
            rate: zeros(2),
            stage_rate: zeros(2),
            lost: zeros(2),
            losing: zeros(2),
            base: zeros(1),
            shift: zeros(1),
            dense: zeros(8),
        }
    }

    /// A stage of signed size `h` that ends at `s`.
    fn stage(&mut self, equations: &mut Equations<'_>, s: f64, h: f64) -> Result<(), Cause> {
        let n = self.n;
        let t = equations.course.t0 + s;
        let (q, v) = self.end.split_at_mut(n);
        let (q_lost, v_lost) = self.losing.split_at_mut(n);
        self.base.copy_from_slice(q);
        add(v, v_lost, 0.5 * h, &self.stage_rate[n..]);
        add(q, q_lost, h, v);
        let problem = &mut *equations.problem;
        if let Err(error) = problem.project_along(t, &self.base, [q, &mut self.shift]) {
            let step = self.step.abs();
            let reason = match &error {
                Error::OffConstraint { constraints, .. } => format!(
                    "is {step}, which is too long here: from its start no way leads onto the constraints at its end; of them is left \
                     (residual): {}; take a shorter one",
                    named(constraints)
                ),
                other => format!("is {step}, which is too long here: {other}"),
            };
            let error = Error::invalid("step", reason);
            return Err(Trouble::cause(equations.at(s, &self.end), error));
        }
        add(v, v_lost, h.recip(), &self.shift);
        // v½ as it is does not satisfy the constraints, and redundant ones would contradict each other there.
        self.project_velocity(equations, s)?;
        equations.rate(s, &self.end, &mut self.stage_rate)?;
        let (v, v_lost) = (&mut self.end[n..], &mut self.losing[n..]);
        add(v, v_lost, 0.5 * h, &self.stage_rate[n..]);
        self.project_velocity(equations, s)
    }

    fn project_velocity(&mut self, equations: &mut Equations<'_>, s: f64) -> Result<(), Cause> {
        let (q, v) = self.end.split_at_mut(self.n);
        let result = (equations.problem).project_velocity(equations.course.t0 + s, q, v);
        result.map_err(|error| Trouble::cause(equations.at(s, &self.end), error))
    }
}

/// x ← x + c d, with what rounding takes from it in `lost`.
fn add(x: &mut [f64], lost: &mut [f64], c: f64, d: &[f64]) {
    for ((x, lost), d) in x.iter_mut().zip(lost).zip(d) {
        (*x, *lost) = keeping(*x, c * d + *lost);
    }
}

impl Scheme for Rattle {
    fn states(&self) -> [&[f64]; 2] {
        [&self.start, &self.end]
    }

    fn end_mut(&mut self) -> &mut [f64] {
        &mut self.end
    }

    fn keeps_constraints(&self) -> bool {
        true
    }

    fn begin(&mut self, equations: &mut Equations<'_>) -> Result<(), Cause> {
        self.lost.fill(0.0);
        equations.rate(equations.course.now.s, &self.start, &mut self.rate)
    }

    fn first_size(&mut self, _: &mut Equations<'_>, _: f64) -> f64 {
        self.step
    }

    fn attempt(&mut self, equations: &mut Equations<'_>, step: Trial) -> Result<f64, Cause> {
        self.end.copy_from_slice(&self.start);
        self.losing.copy_from_slice(&self.lost);
        self.stage_rate.copy_from_slice(&self.rate);
        let mut s = step.start.s;
        for share in SHARES {
            s += share * step.h;
            self.stage(equations, s, share * step.h)?;
        }
        Ok(0.0)
    }

    fn close(&mut self, _: &mut Equations<'_>, _: Trial) -> Result<f64, Cause> {
        Ok(0.0)
    }

    /// The cubic through states and rates at both ends: of the order of the method.
    fn interpolate(&mut self, equations: &mut Equations<'_>, step: Trial) -> Result<(), Cause> {
        // A stage leaves q̈ at its v½; the interpolant needs those of the ends.
        let (mut start, mut end) = (self.rate.clone(), self.rate.clone());
        equations.rate(step.start.s, &self.start, &mut start)?;
        equations.rate(step.end.s, &self.end, &mut end)?;
        cubic(
            &mut self.dense,
            step.h,
            &self.start,
            &self.end,
            &start,
            &end,
        );
        Ok(())
    }

    fn dense(&self) -> &[f64] {
        &self.dense
    }

    fn advance(&mut self) {
        self.start.copy_from_slice(&self.end);
        self.lost.copy_from_slice(&self.losing);
        self.rate.copy_from_slice(&self.stage_rate);
    }

    fn accepted(&mut self, _: f64, _: f64) -> f64 {
        self.step
    }

    /// A shorter step would be another method: there is none.
    fn inaccurate(&mut self, _: f64, _: f64) -> f64 {
        0.0
    }

    fn unfit(&mut self, _: f64) -> f64 {
        0.0
    }
}
