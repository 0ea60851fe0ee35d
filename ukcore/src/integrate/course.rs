//! Where a run stands, which step it tries next, and what became of those before: the same for a run of its own and for each lane of an
//! ensemble.

use super::control::StepSize;
use super::dense::Clock;
use super::sample::Sample;
use super::scheme::Attempt;
use super::trouble::{Cause, Conflict, Pace, Trouble};
use super::{Report, Settings};
use crate::error::Error;

/// A step is the last one if what would remain behind it is less than this part of it.
const LAST: f64 = 0.01;

/// Steps shorter than this share (ε²) of the run are not tried: near s = 0, where no rounding of s stops it, halving could go on
/// through three hundred decades.
const SHORTEST: f64 = f64::EPSILON * f64::EPSILON;

/// A step of this share of the run is short enough to tell when a constraint jumps, and what lies so close ahead is still an obstacle.
const NEAR: f64 = 1e-9;

/// A place on the way: s, which counts from the start of the run, and the time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Place {
    pub(crate) s: f64,
    pub(crate) t: f64,
}

/// A step to be tried.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Trial {
    /// Its positive size.
    pub(crate) size: f64,
    pub(crate) end: Place,
    /// It ends at the end of the run.
    pub(crate) last: bool,
}

/// The course of a run.
#[derive(Debug)]
pub(crate) struct Course {
    pub(crate) clock: Clock,
    /// The end of the run, and of the last accepted step.
    pub(crate) end: Place,
    pub(crate) now: Place,
    /// Size proposed for the next step, and what its choice remembers.
    pub(crate) h: f64,
    pub(crate) size: StepSize,
    settings: Settings,
    pace: Pace,
    /// What went wrong since the last accepted step, nearest to it.
    trouble: Cause,
    /// Steps attempted and accepted.
    attempts: usize,
    pub(crate) steps: usize,
}

impl Course {
    pub(crate) fn new(t0: f64, t_end: f64, settings: &Settings) -> Self {
        let sign = if t_end < t0 { -1.0 } else { 1.0 };
        let clock = Clock { t0, sign };
        let place = |t: f64| Place { s: clock.s(t), t };
        Course {
            clock,
            end: place(t_end),
            now: place(t0),
            h: 0.0,
            size: StepSize::default(),
            pace: Pace::new(settings.switches, settings.tolerance, settings.max_steps),
            settings: *settings,
            trouble: None,
            attempts: 0,
            steps: 0,
        }
    }

    /// Attempted steps that were not accepted.
    pub(crate) fn rejected(&self) -> usize {
        self.attempts - self.steps
    }

    /// Largest size of the first step.
    pub(crate) fn largest_first(&self) -> f64 {
        self.largest().min(self.end.s)
    }

    fn largest(&self) -> f64 {
        self.settings.max_step.unwrap_or(self.end.s)
    }

    /// Where a part of size `size` of a step from here ends; `None` where it would be lost in rounding.
    pub(crate) fn within(&self, size: f64) -> Option<Trial> {
        let s = self.now.s + size;
        let end = Place {
            s,
            t: self.clock.t(s),
        };
        let last = false;
        (end.t != self.now.t && s > self.now.s).then_some(Trial { size, end, last })
    }

    /// The step to be tried next: `goal` if there is one, else one of the proposed size.
    ///
    /// # Errors
    /// [`Error::TooManySteps`]; [`Error::StepTooSmall`] where it would be lost in rounding, [`Error::InvalidSetting`] where the end of the
    /// run is to blame.
    pub(crate) fn plan(&mut self, goal: Option<Trial>) -> Result<Trial, Error> {
        if self.attempts >= self.settings.max_steps {
            return Err(self.too_many_steps());
        }
        let trial = match goal {
            Some(goal) => goal,
            None => self.proposed().ok_or_else(|| self.no_step())?,
        };
        self.attempts += 1;
        Ok(trial)
    }

    /// The step of the proposed size; `None` where it would be lost in rounding.
    fn proposed(&self) -> Option<Trial> {
        let (h, Place { s, t }) = (self.h, self.now);
        let last = s + (1.0 + LAST) * h > self.end.s;
        let (size, end) = if last {
            (self.end.s - s, self.end)
        } else {
            let s = s + h;
            let t = self.clock.t(s);
            (h, Place { s, t })
        };
        // The proposed size counts, not what is left to the end.
        let lost = 0.1 * h <= s * f64::EPSILON || size < SHORTEST * self.end.s;
        (!lost && end.t != t).then_some(Trial { size, end, last })
    }

    fn no_step(&self) -> Error {
        let h = self.h;
        let chosen = self.attempts == 0 && self.settings.first_step.is_none();
        if !(chosen && h > 0.0 && h < f64::EPSILON * self.end.s) {
            return Error::StepTooSmall { step: h };
        }
        let t = self.end.t;
        let reason = format!(
            "is {t:e}, so far that a first step of {h:.1e} is nothing beside it; take a nearer one"
        );
        let what = "t_end";
        Error::InvalidSetting { what, reason }
    }

    fn too_many_steps(&mut self) -> Error {
        self.trouble = None;
        let steps = self.settings.max_steps;
        self.pace.explain(Error::TooManySteps { steps })
    }

    /// `trial` as a method takes it.
    pub(super) fn attempt(&self, trial: Trial) -> Attempt {
        let sign = self.clock.sign;
        Attempt {
            s: sign * self.now.s,
            s_end: sign * trial.end.s,
            h: sign * trial.size,
            tolerance: self.settings.tolerance,
            unproven: self.size.unproven(),
        }
    }

    /// The step in hand is refused, for this cause if one is known.
    pub(crate) fn refuse(&mut self, cause: Cause) {
        self.trouble = cause.or(self.trouble.take());
    }

    /// Whether `t` is so close to where the run stands that only what happens there is in the way.
    pub(crate) fn is_close(&self, t: f64) -> bool {
        (t - self.now.t).abs() <= NEAR * self.end.s
    }

    /// `trial` is accepted.
    pub(crate) fn advance(&mut self, trial: Trial) {
        self.now = trial.end;
        self.steps += 1;
        // What lies close ahead is still to come, and may leave no room for a step.
        let (sign, reach) = (self.clock.sign, NEAR * self.end.s);
        let ahead = |t: f64| (0.0..=reach).contains(&(sign * (t - trial.end.t)));
        let passed = |trouble: &mut Box<Trouble>| !ahead(trouble.state.t);
        self.trouble.take_if(passed);
    }

    /// Another run has got to `end`.
    pub(super) fn detour(&mut self, end: Place, report: &Report) {
        self.now = end;
        self.steps += report.steps;
        self.attempts += report.steps + report.rejected;
        self.trouble = None;
    }

    /// Watches `trial`, which is about to be accepted, with the states at its start and its end.
    pub(crate) fn watch<Y: AsRef<[f64]>>(&mut self, trial: Trial, states: impl FnOnce() -> (Y, Y)) {
        if self.pace.watches() {
            let (old, new) = states();
            let time = trial.end.t - self.now.t;
            self.pace.step(time, old.as_ref(), new.as_ref());
        }
    }

    /// Gives up where the run would use up its steps without getting on.
    ///
    /// # Errors
    /// [`Error::Chattering`].
    pub(crate) fn check_pace(&mut self) -> Result<(), Error> {
        if self.pace.hopeless(self.end.t - self.now.t) {
            return Err(self.too_many_steps());
        }
        Ok(())
    }

    /// Proposes a size for the step after an accepted one.
    pub(crate) fn propose(&mut self, h: f64) {
        self.h = h.min(self.largest());
    }

    /// The error of a motion that is driven onto the zeros of `switches`, from either side of them.
    pub(crate) fn stuck(&mut self, switches: &[usize]) -> Error {
        self.trouble = None;
        self.pace.stuck(switches)
    }

    /// What to report of a run that ends with `error` `here`, where it stands.
    pub(crate) fn explain(
        &mut self,
        error: Error,
        here: Sample<'_>,
        conflict: &mut Conflict,
    ) -> Trouble {
        let cause = self.trouble.take();
        conflict.explain(cause.map_or_else(|| Trouble::new(here, error), |cause| *cause))
    }
}
