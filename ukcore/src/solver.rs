//! Accelerations, constraint forces and multipliers at a state.

use crate::error::Error;
use crate::mechanism::Mechanism;

/// Which formula computes the accelerations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Formula {
    /// Udwadia-Kalaba where M is regular, Udwadia-Phohomsiri where it is singular.
    #[default]
    Auto,
    /// Eq. 13, for regular M.
    UdwadiaKalaba,
    /// Eq. 19, also for singular M.
    UdwadiaPhohomsiri,
    /// The saddle-point system [M Aᵀ; A 0].
    Kkt,
}

/// Baumgarte's stabilisation: b − 2αφ̇ − β²φ for holonomic, b − αψ for nonholonomic constraints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Baumgarte {
    /// α in 1/s.
    pub alpha: f64,
    /// β in 1/s.
    pub beta: f64,
}

/// Settings of a [`Solver`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverOptions {
    /// The formula.
    pub formula: Formula,
    /// Relative rank tolerance.
    pub rank_tolerance: f64,
    /// Baumgarte's stabilisation, if wanted.
    pub baumgarte: Option<Baumgarte>,
}

impl Default for SolverOptions {
    fn default() -> Self {
        SolverOptions {
            formula: Formula::Auto,
            rank_tolerance: 1e-11,
            baumgarte: None,
        }
    }
}

/// What a [`Solver`] has done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SolverWork {
    /// Evaluations of [`Mechanism::dynamics`].
    pub evaluations: usize,
    /// Evaluations that had to leave the formula first tried for a more general one.
    pub fallbacks: usize,
}

/// Everything about one state.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// q̈.
    pub acceleration: Vec<f64>,
    /// Qc_id.
    pub ideal_force: Vec<f64>,
    /// Qc_nid.
    pub nonideal_force: Vec<f64>,
    /// λ.
    pub multipliers: Vec<f64>,
    /// Rank of A.
    pub rank: usize,
    /// n − rank.
    pub degrees_of_freedom: usize,
    /// The formula used.
    pub formula: Formula,
    /// Constraints implied by the others.
    pub redundant: Vec<usize>,
}

/// Solves M q̈ = Q + Qc with A q̈ = b in preallocated buffers.
#[derive(Debug, Clone)]
pub struct Solver {
    options: SolverOptions,
    work: SolverWork,
}

impl Solver {
    /// A solver for mechanisms of type `M`.
    #[must_use]
    pub fn new<M: Mechanism>(options: SolverOptions) -> Self {
        let work = SolverWork::default();
        Solver { options, work }
    }

    /// q̈ at (t, q, q̇) into `out`.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn acceleration<M: Mechanism>(
        &mut self,
        mech: &M,
        t: f64,
        q: &[f64],
        v: &[f64],
        out: &mut [f64],
    ) -> Result<(), Error> {
        let solution = self.solve(mech, t, q, v)?;
        out.copy_from_slice(&solution.acceleration);
        Ok(())
    }

    /// Everything at (t, q, q̇).
    ///
    /// # Errors
    /// See [`Error`].
    pub fn solve<M: Mechanism>(
        &mut self,
        _mech: &M,
        _t: f64,
        _q: &[f64],
        _v: &[f64],
    ) -> Result<Solution, Error> {
        self.work.evaluations += 1;
        Err(Error::InvalidSetting {
            what: "formula",
            reason: format!("{:?} is being written", self.options.formula),
        })
    }

    /// What has been done so far.
    #[must_use]
    pub fn work(&self) -> SolverWork {
        self.work
    }
}
