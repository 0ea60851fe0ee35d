//! A run: steps until the end, and what becomes of those that fail.

use super::control::{Guess, Plan, StepSize};
use super::dense::{Clock, Interpolant};
use super::stepper::Stepper;
use super::sums::error_norm;
use super::{Method, Next, Outcome, PROJECTION_LIMIT, Problem, Report, Settings, Step};
use crate::error::Error;
use crate::scan::{all_finite, all_pairs};

/// An error and where it arose.
struct Trouble {
    t: f64,
    y: Vec<f64>,
    error: Error,
}

/// Why f has no value: an error of the problem, or none where y is not finite, as happens after far too long a step.
type NoRate = Option<Trouble>;

/// f as a function of ±s.
fn right_hand_side<P: Problem>(
    problem: &mut P,
    t0: f64,
) -> impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), NoRate> {
    move |s, y, rate| {
        let t = t0 + s;
        problem.derivative(t, y, rate).map_err(|error| {
            let y = y.to_vec();
            all_finite(&y).then_some(Trouble { t, y, error })
        })
    }
}

/// Why an attempted step is not accepted.
enum Refusal {
    /// A stage has no rate.
    Stage(NoRate),
    /// Its error is that many times too large.
    Inaccurate(f64),
    /// The state at its end does not do.
    End(NoRate),
}

struct Driver<'p, P> {
    problem: &'p mut P,
    settings: &'p Settings,
    clock: Clock,
    t_end: f64,
    s_end: f64,
    stepper: Stepper<f64>,
    step_size: StepSize,
    /// Last accepted state.
    s: f64,
    t: f64,
    y: Vec<f64>,
    /// State at the end of the attempted step before its projection.
    raw: Vec<f64>,
    /// What went wrong since the last accepted step, nearest to it.
    trouble: Option<Trouble>,
    /// Steps attempted and accepted.
    attempts: usize,
    steps: usize,
}

/// [`Method::run`](super::Method::run).
pub(super) fn run<P: Problem>(
    method: Method,
    problem: &mut P,
    t0: f64,
    y0: &[f64],
    t_end: f64,
    settings: &Settings,
) -> Report {
    let sign = if t_end < t0 { -1.0 } else { 1.0 };
    let clock = Clock { t0, sign };
    let mut driver = Driver {
        problem,
        settings,
        clock,
        t_end,
        s_end: clock.s(t_end),
        stepper: Stepper::new(method, y0.len()),
        step_size: StepSize::new(),
        s: 0.0,
        t: t0,
        y: y0.to_vec(),
        raw: y0.to_vec(),
        trouble: None,
        attempts: 0,
        steps: 0,
    };
    let outcome = driver.run().unwrap_or_else(|error| {
        let Trouble { t, y, error } = driver.trouble.take().unwrap_or_else(|| {
            let (t, y) = (driver.t, driver.y.clone());
            Trouble { t, y, error }
        });
        Outcome::Failed { t, y, error }
    });
    Report {
        outcome,
        steps: driver.steps,
        rejected: driver.attempts - driver.steps,
    }
}

impl<P: Problem> Driver<'_, P> {
    /// All steps. An error says that there is no next one; [`Driver::trouble`], if there is one, is its cause.
    fn run(&mut self) -> Result<Outcome, Error> {
        let largest = self.largest_step();
        let mut h = self.start()?;
        loop {
            if self.attempts >= self.settings.max_steps {
                self.trouble = None;
                let steps = self.settings.max_steps;
                return Err(Error::TooManySteps { steps });
            }
            let end = (self.s_end, self.t_end);
            let Some(plan) = Plan::new(h, (self.s, self.t), end, self.clock) else {
                return Err(Error::StepTooSmall { step: h });
            };
            let Plan { size, s, t, last } = plan;
            self.attempts += 1;
            let control = &self.stepper.tableau().control;
            h = match self.attempt(size, s, t) {
                Ok((Next::Stop, _)) => return Ok(Outcome::Stopped),
                Ok(_) if last => return Ok(Outcome::Reached),
                Ok((Next::Continue, error)) => {
                    self.step_size.accepted(control, size, error).min(largest)
                }
                Err(Refusal::Inaccurate(error)) => self.step_size.inaccurate(control, size, error),
                Err(Refusal::Stage(cause)) => {
                    self.trouble = cause.or(self.trouble.take());
                    self.step_size.inaccurate(control, size, f64::NAN)
                }
                Err(Refusal::End(cause)) => {
                    self.trouble = cause.or(self.trouble.take());
                    self.step_size.unfit(size)
                }
            };
        }
    }

    fn largest_step(&self) -> f64 {
        self.settings.max_step.unwrap_or(self.s_end)
    }

    /// Evaluates f at the start and returns the size of the first step.
    fn start(&mut self) -> Result<f64, Error> {
        let largest = self.largest_step().min(self.s_end);
        let tolerance = self.settings.tolerance;
        let mut f = right_hand_side(self.problem, self.clock.t0);
        if let Err(trouble) = self.stepper.begin(&mut f, 0.0, &self.y) {
            self.trouble = trouble;
            return Err(Error::StepTooSmall { step: 0.0 });
        }
        if let Some(h) = self.settings.first_step {
            return Ok(h.min(largest));
        }
        let start = self.y.iter().zip(self.stepper.rate());
        let guess = Guess::new(start.map(|(y, rate)| (*y, *rate)), tolerance, largest);
        // Buffers are free at the start.
        self.raw.copy_from_slice(self.stepper.rate());
        let step = self.clock.sign * guess.h;
        let control = &self.stepper.tableau().control;
        let Ok(after) = self.stepper.probe(f, 0.0, step, &self.y) else {
            return Ok(guess.h);
        };
        let start = self.y.iter().zip(&self.raw).zip(after);
        let start = start.map(|((y, rate), after)| (*y, *rate, *after));
        Ok(guess.refine(start, control, tolerance, largest))
    }

    /// Tries the step of size `h` that ends at `s`, which is `t`, and moves to its end if it is good. Returns its error.
    fn attempt(&mut self, h: f64, s: f64, t: f64) -> Result<(Next, f64), Refusal> {
        let Clock { t0, sign } = self.clock;
        let (start, step) = (sign * self.s, sign * h);
        let f = right_hand_side(self.problem, t0);
        let stages = self.stepper.attempt(f, start, step, &self.y);
        stages.map_err(Refusal::Stage)?;
        let mut error = 0.0;
        if !self.stepper.tableau().closing_in_error {
            error = self.error(step)?;
        }
        self.project(t)?;
        let f = right_hand_side(self.problem, t0);
        self.stepper.close(f, sign * s).map_err(Refusal::End)?;
        if self.stepper.tableau().closing_in_error {
            error = self.error(step)?;
        }
        let next = self.show(h, s, t)?;
        self.stepper.advance(&mut self.y, |new, _| new);
        (self.s, self.t) = (s, t);
        self.steps += 1;
        self.trouble = None;
        Ok((next, error))
    }

    /// Estimated error of the attempted step, if it is small enough.
    fn error(&mut self, step: f64) -> Result<f64, Refusal> {
        let error = self.stepper.error(step, &self.y, self.settings.tolerance);
        if error <= 1.0 {
            Ok(error)
        } else {
            Err(Refusal::Inaccurate(error))
        }
    }

    /// Projects the new state. Refuses if that fails or the change says that the step was a bad one.
    fn project(&mut self, t: f64) -> Result<(), Refusal> {
        let new = self.stepper.state_mut();
        if !all_finite(new) {
            return Err(Refusal::End(None));
        }
        self.raw.copy_from_slice(new);
        if let Err(error) = self.problem.project(t, new) {
            let y = self.raw.clone();
            return Err(Refusal::End(Some(Trouble { t, y, error })));
        }
        // No weight of the norm is above 1 / tol.
        let least = PROJECTION_LIMIT * self.settings.tolerance;
        if all_pairs(&self.raw, new, |raw, new| (new - raw).abs() <= least) {
            return Ok(());
        }
        let pairs = self.raw.iter().zip(&*new).zip(&self.y);
        let change = pairs.map(|((raw, new), old)| (new - raw, *old, *raw));
        if error_norm(change, self.settings.tolerance) <= PROJECTION_LIMIT {
            Ok(())
        } else {
            Err(Refusal::End(None))
        }
    }

    /// Shows the problem the step, with its interpolant if one is wanted.
    fn show(&mut self, h: f64, s: f64, t: f64) -> Result<Next, Refusal> {
        let clock = self.clock;
        let within = |sample: f64| clock.passed(sample, s);
        let wanted = self.settings.dense || self.problem.next_sample().is_some_and(within);
        if wanted {
            let f = right_hand_side(self.problem, clock.t0);
            let (start, step) = (clock.sign * self.s, clock.sign * h);
            let stages = self.stepper.interpolate(f, start, step, &self.y);
            stages.map_err(Refusal::End)?;
        }
        let y = self.stepper.state();
        let step = Step {
            t_old: self.t,
            t,
            y,
            interpolant: wanted.then_some(Interpolant {
                clock,
                s_old: self.s,
                h,
                coefficients: self.stepper.dense(),
            }),
        };
        self.problem.step(&step).map_err(|error| {
            let y = y.to_vec();
            Refusal::End(Some(Trouble { t, y, error }))
        })
    }
}
