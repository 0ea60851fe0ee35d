//! The energy of a run with steps of a fixed size: too long ones make it grow without bound, and nothing else would tell.

use crate::error::Error;
use crate::mechanism::Energy;

/// Largest change of the energy, as a share of the energy exchanged, with which a motion still counts as one of the mechanism.
const ASTRAY: f64 = 0.1;

/// Changes of the energy below this share of its terms may be rounding.
const NO_CHANGE: f64 = 1e-9;

/// Watches the energy of a run with steps of a fixed size.
pub(super) struct EnergyWatch {
    step: f64,
    first: Energy,
    /// Largest energy exchanged so far.
    exchanged: f64,
}

impl EnergyWatch {
    /// For steps of size `step`, from the energy `first`.
    pub(super) fn new(step: f64, first: Energy) -> Self {
        EnergyWatch {
            step,
            first,
            exchanged: 0.0,
        }
    }

    /// Refuses an energy that a motion cannot have which began with the first one.
    pub(super) fn check(&mut self, now: Energy) -> Result<(), Error> {
        let gained = now.potential - self.first.potential;
        let change = (gained + (now.kinetic - self.first.kinetic)).abs();
        self.exchanged = self.exchanged.max(now.kinetic).max(gained.abs());
        let terms = now.kinetic + now.potential.abs() + self.first.potential.abs();
        // The energy of a motion gone astray may not be a number.
        if change <= ASTRAY * self.exchanged || change <= NO_CHANGE * terms {
            return Ok(());
        }
        let what = "step";
        let reason = format!(
            "is {:?}, which is too long here: the energy has changed by {:.0} % of the energy exchanged; take a smaller one",
            self.step,
            100.0 * change / self.exchanged
        );
        Err(Error::InvalidSetting { what, reason })
    }
}
