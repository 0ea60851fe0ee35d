//! Keeping the state on the constraints.

use crate::error::Error;
use crate::mechanism::Mechanism;
use crate::solver::Baumgarte;

/// How drift off the constraints is kept down during integration.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Stabilisation {
    /// Projection of q and q̇ after each accepted step.
    #[default]
    Projection,
    /// Feedback in b.
    Baumgarte(Baumgarte),
    /// Nothing.
    None,
}

/// What a projection did.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Correction {
    /// Size of the change: largest |Δ| over the coordinates (or velocities).
    pub norm: f64,
    /// Newton steps taken.
    pub iterations: usize,
    /// Largest |φ| (or |φ̇|, |ψ|) left.
    pub residual: f64,
}

/// Projects states onto the constraints, in preallocated buffers.
#[derive(Debug, Clone)]
pub struct Projector {}

impl Projector {
    /// A projector for mechanisms of type `M`.
    #[must_use]
    pub fn new<M: Mechanism>() -> Self {
        Projector {}
    }

    /// Minimal change of q in the mass metric with φ(q, t) = 0.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn position<M: Mechanism>(
        &mut self,
        _mech: &M,
        _t: f64,
        _q: &mut [f64],
        _v: &[f64],
    ) -> Result<Correction, Error> {
        Ok(Correction::default())
    }

    /// Minimal change of q̇ in the mass metric with φ̇ = 0 and ψ = 0.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn velocity<M: Mechanism>(
        &mut self,
        _mech: &M,
        _t: f64,
        _q: &[f64],
        _v: &mut [f64],
    ) -> Result<Correction, Error> {
        Ok(Correction::default())
    }
}
