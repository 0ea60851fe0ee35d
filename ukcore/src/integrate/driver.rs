//! A run: steps until the end, and what becomes of those that fail.

use super::control::Plan;
use super::dense::{Clock, Interpolant};
use super::explicit::Explicit;
use super::radau::Radau;
use super::rattle::Rattle;
use super::scheme::{Attempt, Equations, NoRate, Scheme, Trouble};
use super::stepper::Stepper;
use super::sums::error_norm;
use super::{Method, Next, Outcome, PROJECTION_LIMIT, Problem, Report, Settings, Step};
use crate::error::Error;
use crate::scan::{all_finite, all_pairs};

/// Why an attempted step is not accepted.
enum Refusal {
    /// It could not be made.
    Stage(NoRate),
    /// Its error is that many times too large.
    Inaccurate(f64),
    /// The state at its end does not do.
    End(NoRate),
}

struct Driver<'p, P, X> {
    equations: Equations<'p, P>,
    settings: &'p Settings,
    clock: Clock,
    t_end: f64,
    s_end: f64,
    scheme: X,
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
    let n = y0.len();
    match method {
        Method::Dop853 => {
            let scheme = Explicit::new(Stepper::dop853(n));
            drive(scheme, problem, t0, y0, t_end, settings)
        }
        Method::Dopri5 => {
            let scheme = Explicit::new(Stepper::dopri5(n));
            drive(scheme, problem, t0, y0, t_end, settings)
        }
        Method::Radau5 => drive(Radau::new(n), problem, t0, y0, t_end, settings),
        Method::Rattle { step } => {
            let scheme = Rattle::new(n, step, (t_end - t0).abs());
            drive(scheme, problem, t0, y0, t_end, settings)
        }
    }
}

/// The same with a scheme.
fn drive<P: Problem, X: Scheme>(
    scheme: X,
    problem: &mut P,
    t0: f64,
    y0: &[f64],
    t_end: f64,
    settings: &Settings,
) -> Report {
    let sign = if t_end < t0 { -1.0 } else { 1.0 };
    let clock = Clock { t0, sign };
    let mut driver = Driver {
        equations: Equations { problem, t0 },
        settings,
        clock,
        t_end,
        s_end: clock.s(t_end),
        scheme,
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
        factorisations: driver.scheme.factorisations(),
    }
}

impl<P: Problem, X: Scheme> Driver<'_, P, X> {
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
            h = match self.attempt(size, s, t) {
                Ok((Next::Stop, _)) => return Ok(Outcome::Stopped),
                Ok(_) if last => return Ok(Outcome::Reached),
                Ok((Next::Continue, error)) => self.scheme.accepted(size, error).min(largest),
                Err(Refusal::Inaccurate(error)) => self.scheme.inaccurate(size, error),
                Err(Refusal::Stage(cause)) => {
                    self.trouble = cause.or(self.trouble.take());
                    self.scheme.inaccurate(size, f64::NAN)
                }
                Err(Refusal::End(cause)) => {
                    self.trouble = cause.or(self.trouble.take());
                    self.scheme.unfit(size)
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
        if let Err(trouble) = self.scheme.begin(&mut self.equations, &self.y) {
            self.trouble = trouble;
            return Err(Error::StepTooSmall { step: 0.0 });
        }
        if let Some(h) = self.settings.first_step {
            return Ok(h.min(largest));
        }
        let (sign, tolerance) = (self.clock.sign, self.settings.tolerance);
        let equations = &mut self.equations;
        Ok(self
            .scheme
            .first_size(equations, &self.y, sign, tolerance, largest))
    }

    /// Tries the step of size `h` that ends at `s`, which is `t`, and moves to its end if it is good. Returns its error.
    fn attempt(&mut self, h: f64, s: f64, t: f64) -> Result<(Next, f64), Refusal> {
        let sign = self.clock.sign;
        let step = Attempt {
            s: sign * self.s,
            s_end: sign * s,
            h: sign * h,
            tolerance: self.settings.tolerance,
        };
        let error = self.scheme.attempt(&mut self.equations, step, &self.y);
        let early = small(error.map_err(Refusal::Stage)?)?;
        self.project(t)?;
        let error = self.scheme.close(&mut self.equations, step, &self.y);
        let late = small(error.map_err(Refusal::End)?)?;
        let next = self.show(step, s, t)?;
        self.scheme.advance(&mut self.y);
        (self.s, self.t) = (s, t);
        self.steps += 1;
        self.trouble = None;
        Ok((next, early.max(late)))
    }

    /// Projects the new state. Refuses if that fails or the change says that the step was a bad one.
    fn project(&mut self, t: f64) -> Result<(), Refusal> {
        let new = self.scheme.state_mut();
        if !all_finite(new) {
            return Err(Refusal::End(None));
        }
        if self.scheme.keeps_constraints() {
            return Ok(());
        }
        let new = self.scheme.state_mut();
        self.raw.copy_from_slice(new);
        if let Err(error) = self.equations.problem.project(t, new) {
            let y = self.raw.clone();
            return Err(Refusal::End(Some(Trouble { t, y, error })));
        }
        // No weight of the norm is above 1 / absolute tolerance.
        let least = PROJECTION_LIMIT * self.settings.tolerance.absolute;
        if all_pairs(&self.raw, new, |raw, new| (new - raw).abs() <= least) {
            return Ok(());
        }
        let pairs = self.raw.iter().zip(&*new).zip(&self.y);
        let change = pairs.map(|((raw, new), old)| (new - raw, *old, *raw));
        if error_norm(change, self.settings.tolerance) <= PROJECTION_LIMIT {
            return Ok(());
        }
        let error = self.equations.problem.jump(t, &self.raw);
        Err(Refusal::End(error.map(|error| {
            let y = self.raw.clone();
            Trouble { t, y, error }
        })))
    }

    /// Shows the problem the step, with its interpolant if one is wanted.
    fn show(&mut self, step: Attempt, s: f64, t: f64) -> Result<Next, Refusal> {
        let clock = self.clock;
        let within = |sample: f64| clock.passed(sample, s);
        let wanted =
            self.settings.dense || (self.equations.problem.next_sample()).is_some_and(within);
        if wanted {
            let stages = (self.scheme).interpolate(&mut self.equations, step, &self.y);
            stages.map_err(Refusal::End)?;
        }
        let y = self.scheme.state();
        let step = Step {
            t_old: self.t,
            t,
            y,
            interpolant: wanted.then_some(Interpolant {
                clock,
                s_old: self.s,
                h: step.h.abs(),
                coefficients: self.scheme.dense(),
            }),
        };
        self.equations.problem.step(&step).map_err(|error| {
            let y = y.to_vec();
            Refusal::End(Some(Trouble { t, y, error }))
        })
    }
}

/// `error` if it is small enough.
fn small(error: f64) -> Result<f64, Refusal> {
    if error <= 1.0 {
        Ok(error)
    } else {
        Err(Refusal::Inaccurate(error))
    }
}
