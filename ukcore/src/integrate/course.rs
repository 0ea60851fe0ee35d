//! Where a run stands, which step it tries next, and what became of those before: the same for a run of its own and for each lane of an
//! ensemble.

use super::dense::Interpolant;
use super::sample::Sample;
use super::trouble::{Cause, Conflict, Pace, Trouble};
use super::{Report, Settings, Step};
use crate::error::Error;

/// A step is the last one if what would remain behind it is less than this part of it.
const LAST: f64 = 0.01;

/// Steps shorter than this share (ε²) of the run are not tried: near s = 0, where no rounding of s stops it, halving could go on
/// through three hundred decades.
const SHORTEST: f64 = f64::EPSILON * f64::EPSILON;

/// A step of this share of the run is short enough to tell when a constraint jumps, and what lies so close ahead is still an obstacle.
const NEAR: f64 = 1e-9;

/// A sample counts as within a step that ends so many units of rounding before it.
const END_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A place on the way: the time t, and s = t − t0.
///
/// Counting from the start t0 keeps a large t0 from rounding the step sizes: at t = 1e9 the sum t + h would keep seven digits of h = 1.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Place {
    pub(crate) s: f64,
    pub(crate) t: f64,
}

/// A step to be tried.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Trial {
    pub(crate) start: Place,
    pub(crate) end: Place,
    /// The step's signed size; more than the way to its end where it is cut, and goes on behind that.
    pub(crate) h: f64,
    /// Whether the step ends at the end of the run.
    pub(crate) last: bool,
}

/// The course of a run.
#[derive(Debug)]
pub(crate) struct Course {
    pub(crate) t0: f64,
    /// 1 going forward, −1 going backward.
    pub(crate) along: f64,
    /// The end of the run, and of the last accepted step.
    pub(crate) end: Place,
    pub(crate) now: Place,
    /// Signed size proposed for the next step.
    pub(crate) h: f64,
    settings: Settings,
    pub(crate) pace: Pace,
    /// What went wrong since the last accepted step, nearest to it; the contradiction ahead.
    pub(crate) trouble: Cause,
    conflict: Conflict,
    /// Steps attempted and accepted.
    pub(super) attempts: usize,
    pub(crate) steps: usize,
}

impl Course {
    pub(crate) fn new(t0: f64, t_end: f64, settings: &Settings) -> Self {
        let (s, t) = (t_end - t0, t_end);
        Course {
            t0,
            along: if t_end < t0 { -1.0 } else { 1.0 },
            end: Place { s, t },
            now: Place { s: 0.0, t: t0 },
            h: 0.0,
            pace: Pace::new(settings),
            settings: settings.clone(),
            trouble: None,
            conflict: Conflict::default(),
            attempts: 0,
            steps: 0,
        }
    }

    /// Attempted steps that were not accepted.
    pub(crate) fn rejected(&self) -> usize {
        self.attempts - self.steps
    }

    /// Largest size of the first step, signed.
    pub(crate) fn largest_first(&self) -> f64 {
        self.along * self.largest().min(self.end.s.abs())
    }

    fn largest(&self) -> f64 {
        self.settings.max_step.unwrap_or(self.end.s.abs())
    }

    fn place(&self, s: f64) -> Place {
        Place { s, t: self.t0 + s }
    }

    /// How far ahead the time `t` lies; negative where it is passed.
    pub(super) fn ahead(&self, t: f64) -> f64 {
        self.along * (t - self.t0 - self.now.s)
    }

    /// Whether the place `a` comes before `b` on the way.
    pub(super) fn is_before(&self, a: f64, b: f64) -> bool {
        self.along * a < self.along * b
    }

    /// The step of size `h` from here; `None` where it would be lost in rounding. Where no time lies between its end and that of the run,
    /// it is the last one.
    pub(crate) fn step(&self, h: f64) -> Option<Trial> {
        let end = self.place(self.now.s + h);
        match end.t == self.end.t {
            true => self.towards(self.end, self.end.s - self.now.s, true),
            false => self.towards(end, h, false),
        }
    }

    /// The step of the proposed size as the last one: it may go on behind the end of the run.
    pub(super) fn step_beyond(&self) -> Option<Trial> {
        self.towards(self.place(self.now.s + self.h), self.h, true)
    }

    /// Whether `trial` goes on behind the end of the run.
    pub(super) fn is_beyond(&self, trial: Trial) -> bool {
        self.is_before(self.end.s, trial.end.s)
    }

    /// The step of size `h` from here to `end`; `None` where it would be lost in rounding.
    fn towards(&self, end: Place, h: f64, last: bool) -> Option<Trial> {
        let start = self.now;
        let moves = end.t != start.t && self.is_before(start.s, end.s);
        moves.then_some(Trial {
            start,
            end,
            h,
            last,
        })
    }

    /// The step to be tried next: `goal` if there is one, else one of the proposed size.
    ///
    /// # Errors
    /// [`Error::TooManySteps`], [`Error::Chattering`] where the run would use up its steps without getting on; [`Error::StepTooSmall`]
    /// where it stands still, or the step would be lost in rounding; [`Error::TooLate`] where that of a late start is to blame,
    /// [`Error::InvalidSetting`] where the end of the run is.
    pub(crate) fn plan(&mut self, goal: Option<Trial>) -> Result<Trial, Error> {
        let used_up = self.attempts >= self.settings.max_steps;
        if let Some(error) = self.pace.verdict(used_up, self.end.s - self.now.s) {
            self.trouble = None;
            return Err(error);
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
        let s = self.now.s;
        let last = self.is_before(self.end.s, s + (1.0 + LAST) * self.h);
        let (h, end) = match last {
            true => (self.end.s - s, self.end),
            false => (self.h, self.place(s + self.h)),
        };
        // The proposed size counts, not what is left to the end.
        let shortest = SHORTEST * self.end.s.abs();
        let lost = 0.1 * self.h.abs() <= s.abs() * f64::EPSILON || h.abs() < shortest;
        self.towards(end, h, last).filter(|_| !lost)
    }

    fn no_step(&self) -> Error {
        let step = self.h.abs();
        let [rounding, own] = [self.now.t, self.now.s].map(|t| f64::EPSILON * t.abs());
        if step > 10.0 * own && step < rounding {
            return Error::TooLate { step, rounding };
        }
        let chosen = self.attempts == 0 && self.settings.first_step.is_none();
        if !(chosen && step > 0.0 && step < f64::EPSILON * self.end.s.abs()) {
            return Error::too_small(step);
        }
        let t = self.end.t;
        let reason = format!(
            "is {t:e}, so far that a first step of {step:.1e} is nothing beside it; take a nearer one"
        );
        Error::invalid("t_end", reason)
    }

    /// Takes note of a failure at a state of the step in hand; returns it as its cause.
    pub(crate) fn note(&mut self, at: Sample<'_>, error: Error) -> Cause {
        self.conflict.note(at, &error);
        Trouble::cause(at, error)
    }

    /// The step in hand is refused, for this cause if one is known.
    pub(crate) fn blame(&mut self, cause: Cause) {
        self.trouble = cause.or(self.trouble.take());
    }

    /// Whether `t` is so close to where the run stands that only what happens there is in the way.
    pub(crate) fn is_close(&self, t: f64) -> bool {
        (t - self.now.t).abs() <= NEAR * self.end.s.abs()
    }

    /// Whether a sample at `t`, if there is one, is within the step `trial`.
    pub(crate) fn covers(&self, trial: Trial, t: Option<f64>) -> bool {
        let s = t.map(|t| self.along * (t - self.t0));
        s.is_some_and(|s| s - END_ROUNDING * s.abs() <= self.along * trial.end.s)
    }

    /// What is to be seen of `trial`, with these states at its start and its end and the coefficients of its interpolant.
    pub(crate) fn show<'a>(
        &self,
        trial: Trial,
        [old, new]: [&'a [f64]; 2],
        coefficients: Option<&'a [f64]>,
    ) -> Step<'a> {
        let Trial { start, end, h, .. } = trial;
        Step {
            old: Sample::of(start.t, old),
            new: Sample::of(end.t, new),
            until: match self.is_beyond(trial) {
                true => self.end.t,
                false => end.t,
            },
            interpolant: coefficients.map(|coefficients| Interpolant {
                t0: self.t0,
                s: start.s,
                h,
                from: start.t,
                coefficients,
            }),
            error: None,
            nearby: false,
        }
    }

    /// `trial` is accepted, with these states at its start and its end.
    pub(crate) fn advance<Y: AsRef<[f64]>>(
        &mut self,
        trial: Trial,
        states: impl FnOnce() -> [Y; 2],
    ) {
        let most = self.settings.max_step;
        let largest = most.is_some_and(|most| trial.h.abs() >= most);
        self.pace.step(trial.h, largest, states);
        self.conflict.pass(self.now.t, trial.end.t);
        self.now = trial.end;
        self.steps += 1;
        // What lies close ahead is still to come, and may leave no room for a step.
        let (along, reach) = (self.along, NEAR * self.end.s.abs());
        let ahead = |t: f64| (0.0..=reach).contains(&(along * (t - trial.end.t)));
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

    /// Proposes a size for the step after an accepted one.
    pub(crate) fn propose(&mut self, h: f64) {
        self.h = h;
        self.limit(self.largest());
    }

    /// The next step is at most of this size.
    pub(crate) fn limit(&mut self, largest: f64) {
        self.h = self.along * self.h.abs().min(largest.abs());
    }

    /// The error of a motion that is driven onto the zeros of `switches`, from either side of them.
    pub(crate) fn stuck(&mut self, switches: &[usize]) -> Error {
        self.trouble = None;
        self.pace.stuck(switches)
    }

    /// What to report of a run that ends with `error` `here`, where it stands.
    pub(crate) fn explain(&mut self, error: Error, here: Sample<'_>) -> Trouble {
        let cause = self.trouble.take();
        let last = cause.map_or_else(|| Trouble::new(here, error), |cause| *cause);
        self.conflict.explain(last)
    }
}
