//! Whether the settings of a simulation make sense, with each other and for its mechanism.

use super::agenda::{Sampling, rounding};
use super::{SMALLEST_TOLERANCE, Simulation};
use crate::assemble::State;
use crate::error::Error;
use crate::integrate::Method;
use crate::manifold::Stabilisation;

/// Most samples that [`Simulation::every`] keeps: a slip in its unit must not fill the memory.
const MAX_SAMPLES: f64 = 1e8;

fn invalid(what: &'static str, reason: impl Into<String>) -> Result<(), Error> {
    Err(Error::invalid(what, reason))
}

/// Refuses a size that is given and not positive or not finite.
fn check_size(what: &'static str, size: Option<f64>) -> Result<(), Error> {
    match size {
        Some(size) if !(size.is_finite() && size > 0.0) => invalid(
            what,
            format!("is {size:?}, but must be positive and finite"),
        ),
        _ => Ok(()),
    }
}

impl Simulation {
    /// Refuses what a run to `t_end` cannot be made with. Its samples are `kept` or not.
    pub(super) fn check(&self, t_end: f64, kept: bool) -> Result<(), Error> {
        self.check_numbers(t_end)?;
        let Some(start) = &self.start else {
            let reason = "is missing; give the simulation a state, for example one from `assemble`";
            return invalid("start", reason);
        };
        if !(t_end - start.t).is_finite() && start.t.is_finite() {
            return invalid("t_end", format!("is {t_end:?}, too far from {:?}", start.t));
        }
        match &self.sampling {
            Sampling::Steps => Ok(()),
            Sampling::Every(dt) => check_every(*dt, start, t_end, kept),
            Sampling::At(times) => check_times(times, start, t_end),
        }
    }

    /// Ranges of the numbers, each by itself.
    fn check_numbers(&self, t_end: f64) -> Result<(), Error> {
        if !(SMALLEST_TOLERANCE..1.0).contains(&self.tolerance) {
            let tolerance = self.tolerance;
            let reason =
                format!("is {tolerance:?}, but {SMALLEST_TOLERANCE:?} to below 1 is allowed");
            return invalid("tolerance", reason);
        }
        if !t_end.is_finite() {
            return invalid("t_end", format!("is {t_end}, but must be finite"));
        }
        if let Sampling::Every(dt) = self.sampling {
            check_size("every", Some(dt))?;
        }
        check_size("max_step", self.max_step)?;
        check_size("first_step", self.first_step)?;
        check_size("absolute_tolerance", self.absolute)?;
        if let Method::Rattle { step } = self.method {
            self.check_rattle(step)?;
        }
        if self.max_steps == 0 {
            return invalid("max_steps", "is 0, but must be at least 1");
        }
        if let Stabilisation::Baumgarte(b) = self.stabilisation {
            for (what, value) in [("alpha", b.alpha), ("beta", b.beta)] {
                if !(value.is_finite() && value >= 0.0) {
                    let reason = format!("is {value:?}, but must be finite and not negative");
                    return invalid(what, reason);
                }
            }
        }
        Ok(())
    }

    /// Whether RATTLE with steps of `step` fits the mechanism and the other settings.
    fn check_rattle(&self, step: f64) -> Result<(), Error> {
        check_size("step", Some(step))?;
        let spec = self.mechanism.spec();
        let structure = &spec.structure;
        let obstacle = if let Some(i) = structure.massless.first() {
            Some(format!("`{}` has no mass", spec.coords[*i]))
        } else if let Some(c) = spec.constraints.get(spec.holonomic) {
            Some(format!("`{}` is a nonholonomic constraint", c.name))
        } else if !structure.mass_constant {
            Some("the mass matrix is not constant".to_owned())
        } else if !structure.conservative {
            let other = "there are other forces than those from a potential, or explicit time";
            Some(other.to_owned())
        } else {
            None
        };
        if let Some(obstacle) = obstacle {
            let reason = format!(
                "is RATTLE, which `{}` does not admit, because {obstacle}; take `Method::Dop853`",
                spec.name
            );
            return invalid("method", reason);
        }
        if let Stabilisation::Baumgarte(_) = self.stabilisation {
            let reason = "is Baumgarte's, but RATTLE keeps the constraints by itself; leave it out";
            return invalid("stabilise", reason);
        }
        let sizes = [("first_step", self.first_step), ("max_step", self.max_step)];
        if let Some((what, _)) = sizes.into_iter().find(|(_, size)| size.is_some()) {
            let reason = "is given, but RATTLE has its own step; leave it out";
            return invalid(what, reason);
        }
        Ok(())
    }
}

/// Whether multiples of `dt` can be told from each other, and kept if they are to be.
fn check_every(dt: f64, start: &State, t_end: f64, kept: bool) -> Result<(), Error> {
    let rounding = f64::EPSILON * start.t.abs().max(t_end.abs());
    if dt <= rounding {
        let reason = format!("is {dt:?}, which is below the rounding of the times");
        return invalid("every", reason);
    }
    let samples = (t_end - start.t).abs() / dt;
    if kept && samples > MAX_SAMPLES {
        let reason = format!(
            "is {dt:?}, which asks for {samples:.1e} samples; at most {MAX_SAMPLES:.0e} are kept, and any number by `stream`"
        );
        return invalid("every", reason);
    }
    Ok(())
}

/// Whether a run from `start` to `t_end` passes `times` in their order.
fn check_times(times: &[f64], start: &State, t_end: f64) -> Result<(), Error> {
    let (low, high) = (start.t.min(t_end), start.t.max(t_end));
    let rounding = rounding(low, high, times.len());
    let near = low - rounding..=high + rounding;
    if let Some(t) = times.iter().find(|t| !near.contains(*t)) {
        let reason = format!("contain {t}, which is not between {low} and {high}");
        return invalid("times", reason);
    }
    let sign = if t_end < start.t { -1.0 } else { 1.0 };
    let times = times.iter().map(|t| sign * t.clamp(low, high));
    if !times.is_sorted_by(|a, b| a < b) {
        let reason = "are not in the order in which the run passes them, each once";
        return invalid("times", reason);
    }
    Ok(())
}
