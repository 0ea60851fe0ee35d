//! How well a trajectory keeps the constraints and the energy.

use models::Model;
use serde::{Deserialize, Serialize};
use ukcore::Trajectory;

/// The worst of all samples of a trajectory.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct Drift {
    /// Largest |φ| of the holonomic constraints, in their units.
    pub position_residual: f64,
    /// Largest |φ̇| of the holonomic and |φ| of the nonholonomic constraints, in their units.
    pub velocity_residual: f64,
    /// Largest change of T + V since the start, as a part of the energy exchanged; none where energy is not conserved.
    pub energy_drift: Option<f64>,
}

impl Drift {
    /// The drift of `trajectory`.
    pub fn of<M: Model>(trajectory: &Trajectory<M>) -> Self {
        let (mut position_residual, mut velocity_residual) = (0.0_f64, 0.0_f64);
        for residual in trajectory.residuals() {
            position_residual = position_residual.max(residual.position);
            velocity_residual = velocity_residual.max(residual.velocity);
        }
        let conserved = M::SPEC.structure.conservative;
        let energy_drift = conserved.then(|| trajectory.energy_drift());
        Drift {
            position_residual,
            velocity_residual,
            energy_drift,
        }
    }
}
