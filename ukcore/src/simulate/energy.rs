//! The energy of a run with steps of a fixed size: too long ones make it grow without bound, and nothing else would tell.

use crate::error::Error;
use crate::mechanism::Energy;
use crate::trajectory::EnergyDrift;

/// Largest change of the energy, as a share of the energy exchanged, with which a motion still counts as one of the mechanism.
const ASTRAY: f64 = 0.1;

/// Changes of the energy below this share of its terms may be rounding.
const NO_CHANGE: f64 = 1e-9;

/// Watches the energy of a run with steps of a fixed size.
pub(super) struct EnergyWatch {
    step: f64,
    drift: EnergyDrift,
}

impl EnergyWatch {
    /// A watch over steps of size `step`, from the energy `first`.
    pub(super) fn new(step: f64, first: Energy) -> Self {
        let mut drift = EnergyDrift::default();
        drift.add(first);
        EnergyWatch { step, drift }
    }

    /// Refuses an energy that a motion cannot have which began with the first one. `rounded` is the kinetic energy that rounding makes of
    /// none, over a step.
    pub(super) fn check(
        &mut self,
        now: Energy,
        rounded: impl FnOnce(f64) -> f64,
    ) -> Result<(), Error> {
        let (change, terms) = self.drift.add(now);
        let exchanged = self.drift.exchanged;
        // The energy of a motion gone astray may not be a number.
        if change <= ASTRAY * exchanged || change <= NO_CHANGE * terms {
            return Ok(());
        }
        let step = self.step;
        // At rest all that is exchanged may be rounding, too.
        if change <= rounded(step) {
            return Ok(());
        }
        let share = 100.0 * change / exchanged;
        let reason = format!(
            "is {step:?}, which is too long here: the energy has changed by {share:.0} % of the energy exchanged; take a smaller one"
        );
        Err(Error::invalid("step", reason))
    }
}
