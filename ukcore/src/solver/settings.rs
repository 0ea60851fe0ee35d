//! What a solver is told, and what it tells.

use std::fmt;

use super::RANK_TOLERANCE;
use crate::scalar::Scalar;

/// Which formula computes the accelerations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Formula {
    /// Udwadia-Kalaba where M is regular, Udwadia-Phohomsiri where it is singular.
    #[default]
    Auto,
    /// Eq. 13, for regular M only.
    UdwadiaKalaba,
    /// Eq. 19, for regular and singular M.
    UdwadiaPhohomsiri,
    /// Gaussian elimination of \[M Aᵀ; A 0\]. Where constraints are redundant or nearly so, or are not met by the result, eq. 19 takes over
    /// (a fallback).
    Kkt,
}

/// The formula in words, with its equation.
impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Formula::Auto => "chosen by the rank of M",
            Formula::UdwadiaKalaba => "Udwadia-Kalaba (eq. 13; M is regular)",
            Formula::UdwadiaPhohomsiri => "Udwadia-Phohomsiri (eq. 19; M is singular)",
            Formula::Kkt => "saddle-point system",
        })
    }
}

/// Baumgarte's stabilisation: b − 2αφ̇ − β²φ for holonomic, b − αψ for nonholonomic constraints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Baumgarte {
    /// The rate α in 1/s.
    pub alpha: f64,
    /// The rate β in 1/s; β = α is critical damping.
    pub beta: f64,
}

/// α = β = 20/s: critical damping, under which an error decays in a twentieth of a second, fast against the seconds that mechanisms move
/// for, and slow against the steps of an explicit method.
impl Default for Baumgarte {
    fn default() -> Self {
        let rate = 20.0;
        Baumgarte {
            alpha: rate,
            beta: rate,
        }
    }
}

impl Baumgarte {
    /// Takes the terms off b, from φ of the holonomic constraints and the rates of all.
    pub(crate) fn apply<S: Scalar>(self, position: &[S], rate: &[S], rhs: &mut [S]) {
        let [alpha, twice, square] =
            [self.alpha, 2.0 * self.alpha, self.beta * self.beta].map(S::from_f64);
        for (i, (b, rate)) in rhs.iter_mut().zip(rate).enumerate() {
            *b = *b
                - match position.get(i) {
                    Some(phi) => twice * *rate + square * *phi,
                    None => alpha * *rate,
                };
        }
    }
}

/// Settings of a [`Solver`](super::Solver).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverOptions {
    /// The formula for the accelerations.
    pub formula: Formula,
    /// Significance up to which a constraint counts as implied by the others (see the [module](crate::solver)); between ε and
    /// [`RANK_CEILING`](super::RANK_CEILING); values outside are moved there.
    pub rank_tolerance: f64,
    /// Baumgarte's stabilisation, if wanted.
    pub baumgarte: Option<Baumgarte>,
}

impl Default for SolverOptions {
    fn default() -> Self {
        SolverOptions {
            formula: Formula::Auto,
            rank_tolerance: RANK_TOLERANCE,
            baumgarte: None,
        }
    }
}

/// What a [`Solver`](super::Solver) has done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SolverWork {
    /// Evaluations of [`Mechanism::dynamics`](crate::Mechanism::dynamics), those for drift estimates included.
    pub evaluations: usize,
    /// Solutions that had to leave the formula first tried for a more general one: a mass matrix that looked regular at compile
    /// time and is singular at run time, redundant constraints under [`Formula::Kkt`], or pivots of the straight line that refinement could
    /// not save.
    pub fallbacks: usize,
    /// Solutions by the straight line whose digits refinement gave back.
    pub refined: usize,
}

/// What is known of the motion and its forces at one state.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The accelerations q̈, n numbers.
    pub acceleration: Vec<f64>,
    /// The force Qc_id of ideal constraints (eq. 11), which does no work in a virtual displacement.
    pub ideal_force: Vec<f64>,
    /// The non-ideal part Qc_nid of the constraint force (eq. 12), so that M q̈ = Q + Qc_id + Qc_nid.
    pub nonideal_force: Vec<f64>,
    /// The multipliers λ with Qc_id = Aᵀλ, one a constraint; those of least norm where constraints are redundant.
    pub multipliers: Vec<f64>,
    /// The rank of the constraint Jacobian A.
    pub rank: usize,
    /// The degrees of freedom n − rank A.
    pub degrees_of_freedom: usize,
    /// The formula that was used, which is never [`Formula::Auto`].
    pub formula: Formula,
    /// Indices of redundant constraints, which the others imply, in ascending order. They are no error.
    pub redundant: Vec<usize>,
}
