//! How well a motion keeps the constraints and the energy, as it is told in tables and JSON.

use serde::{Deserialize, Serialize};
use ukcore::Trajectory;
use ukcore::spec::Spec;

/// How far a motion leaves its constraints and its energy at the worst of its samples.
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
    /// Measures the samples of `trajectory`.
    #[must_use]
    pub fn of(trajectory: &Trajectory) -> Self {
        let mut measured = ukcore::simulate::Drift::new(trajectory.mechanism());
        trajectory.samples().for_each(|sample| measured.add(sample));
        Drift::measured(&measured, trajectory.spec())
    }

    /// Reads what was measured of samples that came one by one, of a mechanism with this `spec`.
    #[must_use]
    pub fn measured(measured: &ukcore::simulate::Drift, spec: &Spec) -> Self {
        let residual = measured.residual();
        Drift {
            position_residual: residual.position,
            velocity_residual: residual.velocity,
            energy_drift: spec.structure.conservative.then(|| measured.energy()),
        }
    }
}
