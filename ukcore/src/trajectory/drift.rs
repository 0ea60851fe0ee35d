//! How far samples are off the constraints, and how far off the energy of the first one.

use super::Sample;
use crate::assemble::Residuals;
use crate::mechanism::{Energy, Prepared};

/// How far a sample is off the constraints.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Residual {
    /// Largest |φ| of the holonomic constraints, in their units.
    pub position: f64,
    /// Largest |φ̇| of the holonomic and |φ| of the nonholonomic constraints, in their units.
    pub velocity: f64,
}

impl Residual {
    /// The residual of a sample of `mechanism`.
    pub(super) fn of(mechanism: &Prepared, sample: Sample<'_>) -> Self {
        let all = Residuals::at(mechanism, sample.t, sample.q, sample.v);
        let largest = |values: &[f64]| values.iter().fold(0.0, |m, r| nan_max(m, r.abs()));
        Residual {
            position: largest(&all.position),
            velocity: largest(&all.velocity),
        }
    }

    /// The larger one of the residuals of position and velocity.
    #[must_use]
    pub fn largest(self) -> f64 {
        nan_max(self.position, self.velocity)
    }
}

/// The largest residuals and the energy drift of samples that come one by one, as those of a [streamed](crate::Simulation::stream) run do.
#[derive(Debug, Clone)]
pub struct Drift {
    mechanism: Prepared,
    samples: usize,
    residual: Residual,
    energy: EnergyDrift,
}

impl Drift {
    /// The drift of `mechanism` over no sample yet.
    #[must_use]
    pub fn new(mechanism: impl Into<Prepared>) -> Self {
        Drift {
            mechanism: mechanism.into(),
            samples: 0,
            residual: Residual::default(),
            energy: EnergyDrift::default(),
        }
    }

    /// Takes one more sample into account.
    ///
    /// # Panics
    /// If the sample has not as many coordinates as the mechanism.
    pub fn add(&mut self, sample: Sample<'_>) {
        self.samples += 1;
        let Residual { position, velocity } = Residual::of(&self.mechanism, sample);
        self.residual.position = nan_max(self.residual.position, position);
        self.residual.velocity = nan_max(self.residual.velocity, velocity);
        let Sample { t, q, v, .. } = sample;
        self.energy.add(self.mechanism.energy(t, q, v));
    }

    /// Number of samples that were added.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Largest residual of the samples at either level; not a number if that of any sample is not.
    #[must_use]
    pub fn residual(&self) -> Residual {
        self.residual
    }

    /// Energy drift of the samples, as [`Trajectory::energy_drift`](super::Trajectory::energy_drift) defines it.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.energy.share()
    }

    /// The energy exchanged, of which [`energy`](Drift::energy) is a part: the largest T or |V − V₀| of the samples, J.
    #[must_use]
    pub fn exchanged(&self) -> f64 {
        self.energy.exchanged
    }
}

/// Changes of the energy below this share of its terms may be rounding of these.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The largest change of the energy since the first sample, the largest energy exchanged, and the largest terms.
#[derive(Debug, Clone, Default)]
pub(crate) struct EnergyDrift {
    first: Option<Energy>,
    change: f64,
    pub(crate) exchanged: f64,
    terms: f64,
}

impl EnergyDrift {
    /// Returns the change of this sample, and the size of the terms that it is a difference of.
    pub(crate) fn add(&mut self, now: Energy) -> (f64, f64) {
        let first = self.first.get_or_insert(now);
        // V − V₀ first: a large constant in V must not hide the rest.
        let gained = now.potential - first.potential;
        let change = (gained + (now.kinetic - first.kinetic)).abs();
        self.change = nan_max(self.change, change);
        self.exchanged = nan_max(self.exchanged, now.kinetic.abs());
        self.exchanged = nan_max(self.exchanged, gained.abs());
        let terms = now.kinetic + now.potential.abs() + first.potential.abs();
        self.terms = nan_max(self.terms, terms);
        (change, terms)
    }

    /// The change as a share of the energy exchanged; where it may be rounding of the energies, as a share of these, if they are larger. As
    /// it is where nothing moves.
    pub(super) fn share(&self) -> f64 {
        let rounding = self.change <= ROUNDING * self.terms;
        let size = match rounding {
            true => nan_max(self.terms, self.exchanged),
            false => self.exchanged,
        };
        if size == 0.0 {
            self.change
        } else {
            self.change / size
        }
    }
}

/// The larger one, or NaN if either is.
fn nan_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
