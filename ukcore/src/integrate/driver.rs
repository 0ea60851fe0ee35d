//! A run: steps until the end, and what becomes of those that fail.

use super::control::Plan;
use super::dense::{Clock, Interpolant};
use super::explicit::Explicit;
use super::radau::Radau;
use super::rattle::Rattle;
use super::scheme::{Attempt, Equations, NoRate, Scheme, Trouble};
use super::stepper::Stepper;
use super::sums::error_norm;
use super::switches::{Leaving, Switches};
use super::{Method, Next, Outcome, PROJECTION_LIMIT, Problem, Report, Settings, Step};
use crate::error::Error;
use crate::mechanism::Branch;
use crate::scan::{all_finite, all_pairs};

/// Why an attempted step is not accepted.
enum Refusal {
    /// It could not be made.
    Stage(NoRate),
    /// Its error is that many times too large.
    Inaccurate(f64),
    /// The state at its end does not do.
    End(NoRate),
    /// It is good, with this error, but leaves the branches of its start.
    Leaves(Leaving, f64),
}

/// A step onto the zero of a switch.
struct Goal {
    plan: Plan,
    /// Size and error of the step that would have gone across.
    size: f64,
    error: f64,
}

/// A step of this share of the run is short enough to tell when a constraint jumps.
const NEAR: f64 = 1e-9;

struct Driver<'p, X> {
    equations: Equations<'p>,
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
    /// The step to be tried next, where it goes onto the zero of a switch.
    goal: Option<Goal>,
    /// Steps attempted and accepted; those that were good but left their branches; those onto zeros of switches.
    attempts: usize,
    steps: usize,
    repeated: usize,
    landings: usize,
}

/// [`Method::run`](super::Method::run).
pub(super) fn run(
    method: Method,
    problem: &mut dyn Problem,
    t0: f64,
    y0: &[f64],
    t_end: f64,
    settings: &Settings,
) -> Report {
    let n = y0.len();
    let switches = Switches::new(problem.switches(), n);
    match method {
        Method::Dop853 => {
            let scheme = Explicit::new(Stepper::dop853(n));
            drive(scheme, switches, problem, t0, y0, t_end, settings)
        }
        Method::Dopri5 => {
            let scheme = Explicit::new(Stepper::dopri5(n));
            drive(scheme, switches, problem, t0, y0, t_end, settings)
        }
        Method::Radau5 => {
            let scheme = Radau::new(n);
            drive(scheme, switches, problem, t0, y0, t_end, settings)
        }
        Method::Rattle { step } => {
            let scheme = Rattle::new(n, step, (t_end - t0).abs());
            // Its steps are of one size.
            drive(scheme, Switches::none(), problem, t0, y0, t_end, settings)
        }
    }
}

/// The same with a scheme.
fn drive<X: Scheme>(
    scheme: X,
    switches: Switches,
    problem: &mut dyn Problem,
    t0: f64,
    y0: &[f64],
    t_end: f64,
    settings: &Settings,
) -> Report {
    let sign = if t_end < t0 { -1.0 } else { 1.0 };
    let clock = Clock { t0, sign };
    let equations = Equations {
        problem,
        t0,
        switches,
    };
    let mut driver = Driver {
        equations,
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
        goal: None,
        attempts: 0,
        steps: 0,
        repeated: 0,
        landings: 0,
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
        rejected: driver.attempts - driver.steps - driver.repeated,
        landings: driver.landings,
        factorisations: driver.scheme.factorisations(),
    }
}

impl<X: Scheme> Driver<'_, X> {
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
            let goal = self.goal.take();
            let plan = match &goal {
                Some(goal) => Some(goal.plan),
                None => Plan::new(h, (self.s, self.t), end, self.clock),
            };
            let Some(plan) = plan else {
                let chosen = self.attempts == 0 && self.settings.first_step.is_none();
                return Err(if chosen && h > 0.0 && h < f64::EPSILON * self.s_end {
                    let t = self.t_end;
                    let reason = format!(
                        "is {t:e}, so far that a first step of {h:.1e} is nothing beside it; take a nearer one"
                    );
                    let what = "t_end";
                    Error::InvalidSetting { what, reason }
                } else {
                    Error::StepTooSmall { step: h }
                });
            };
            let Plan { size, s, t, last } = plan;
            self.attempts += 1;
            let result = self.attempt(size, s, t);
            if result.is_err() {
                self.equations.switches.targets.clear();
            }
            // How long a step may be was found out by the one that a step onto a zero was cut from.
            let whole = |error: f64| goal.as_ref().map_or((size, error), |g| (g.size, g.error));
            h = match result {
                Ok((Next::Stop, _)) => return Ok(Outcome::Stopped),
                Ok(_) if last => return Ok(Outcome::Reached),
                Ok((Next::Continue, error)) => {
                    let (size, error) = whole(error);
                    let next = self.scheme.accepted(size, error).min(largest);
                    match self.arrive()? {
                        // The other branch is not known yet.
                        true => next.min(size),
                        false => next,
                    }
                }
                Err(Refusal::Leaves(leaving, error)) => {
                    self.repeated += 1;
                    let (whole, error) = whole(error);
                    self.follow(leaving, plan, whole, error)?
                }
                Err(Refusal::Inaccurate(error)) => self.scheme.inaccurate(size, error),
                // Beyond a zero there may be no value in the branch held.
                Err(Refusal::Stage(Some(_)) | Refusal::End(Some(_))) if self.release() => size,
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
        let zeros = self.choose()?;
        self.begin_at(&zeros)?;
        if let Some(h) = self.settings.first_step {
            return Ok(h.min(largest));
        }
        let (sign, tolerance) = (self.clock.sign, self.settings.tolerance);
        let equations = &mut self.equations;
        Ok(self
            .scheme
            .first_size(equations, &self.y, sign, tolerance, largest))
    }

    /// Evaluates f where the run stands.
    fn begin(&mut self) -> Result<(), Error> {
        let s = self.clock.sign * self.s;
        let result = self.scheme.begin(&mut self.equations, s, &self.y);
        result.map_err(|trouble| {
            self.trouble = trouble;
            Error::StepTooSmall { step: 0.0 }
        })
    }

    /// The same where `switches` stand at zero: those are followed if f has no value there in their branches.
    fn begin_at(&mut self, switches: &[usize]) -> Result<(), Error> {
        if self.begin().is_ok() {
            return Ok(());
        }
        self.hold(switches, Branch::Followed);
        self.trouble = None;
        self.begin()
    }

    fn release(&mut self) -> bool {
        let Equations {
            problem, switches, ..
        } = &mut self.equations;
        switches.release(*problem)
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
        self.equations.switches.begin();
        let error = self.scheme.attempt(&mut self.equations, step, &self.y);
        let early = small(error.map_err(Refusal::Stage)?)?;
        self.project(t)?;
        let error = self.scheme.close(&mut self.equations, step, &self.y);
        let late = small(error.map_err(Refusal::End)?)?;
        let error = early.max(late);
        let interpolated = self.stay(step, t, error)?;
        let next = self.show(step, s, t, interpolated)?;
        self.scheme.advance(&mut self.y);
        (self.s, self.t) = (s, t);
        self.steps += 1;
        // What lies close ahead is still to come, and may leave no room for a step.
        let (sign, reach) = (self.clock.sign, NEAR * self.s_end);
        let ahead = |trouble: &mut Trouble| (0.0..=reach).contains(&(sign * (trouble.t - t)));
        self.trouble = self.trouble.take_if(ahead);
        Ok((next, error))
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
        // Asked close to the place alone, so that the error has its time.
        let close = (t - self.t).abs() <= NEAR * self.s_end;
        let error = close.then(|| self.equations.problem.jump(t, &self.raw));
        Err(Refusal::End(error.flatten().map(|error| {
            let y = self.raw.clone();
            Trouble { t, y, error }
        })))
    }

    /// Shows the problem the step, with its interpolant if one is wanted.
    fn show(&mut self, step: Attempt, s: f64, t: f64, interpolated: bool) -> Result<Next, Refusal> {
        let clock = self.clock;
        let within = |sample: f64| clock.passed(sample, s);
        let wanted =
            self.settings.dense || (self.equations.problem.next_sample()).is_some_and(within);
        if wanted && !interpolated {
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

    /// Refuses the closed step, which ends at `t`, if it leaves the branches of its start. Returns whether its interpolant had to be made for that.
    fn stay(&mut self, step: Attempt, t: f64, error: f64) -> Result<bool, Refusal> {
        let Equations {
            problem, switches, ..
        } = &mut self.equations;
        if switches.is_empty() || !switches.suspect(*problem, t, self.scheme.state()) {
            return Ok(false);
        }
        let stages = (self.scheme).interpolate(&mut self.equations, step, &self.y);
        stages.map_err(Refusal::End)?;
        let Equations {
            problem,
            switches,
            t0,
        } = &mut self.equations;
        let time = |theta: f64| *t0 + step.s + theta * step.h;
        match switches.search(*problem, time, self.scheme.dense()) {
            None => {}
            Some(Leaving::AtEnd(targets)) => switches.targets.extend(targets),
            Some(leaving) => return Err(Refusal::Leaves(leaving, error)),
        }
        Ok(true)
    }

    /// Goes on after a step as planned that left its branches, cut from one of size `whole` with the error `error`: plans the step onto the zero, or takes the
    /// other branch if it stands there. Returns the size of the next attempt otherwise.
    fn follow(
        &mut self,
        leaving: Leaving,
        plan: Plan,
        whole: f64,
        error: f64,
    ) -> Result<f64, Error> {
        let switches = match leaving {
            Leaving::AtOnce(switches) | Leaving::AtEnd(switches) => switches,
            Leaving::Within(theta, switches) => {
                let size = theta * plan.size;
                let s = self.s + size;
                let t = self.clock.t(s);
                if t != self.t && s > self.s {
                    self.equations.switches.targets = switches;
                    let last = false;
                    let plan = Plan { size, s, t, last };
                    self.goal = Some(Goal {
                        plan,
                        size: whole,
                        error,
                    });
                    return Ok(whole);
                }
                switches
            }
        };
        if self.turn(&switches)? {
            self.begin_at(&switches)?;
            return Ok(whole);
        }
        // The motion goes into its branch, and leaves it before the step's first part ends.
        Ok(self.scheme.unfit(plan.size))
    }

    /// The last step is accepted: where it went onto zeros of switches, the next one begins in their other branches. Returns whether it did.
    fn arrive(&mut self) -> Result<bool, Error> {
        let targets = std::mem::take(&mut self.equations.switches.targets);
        let Equations {
            problem, switches, ..
        } = &mut self.equations;
        for k in &targets {
            switches.flip(*problem, *k);
        }
        switches.arrive(*problem, self.t, &self.y);
        if targets.is_empty() {
            return Ok(false);
        }
        self.landings += 1;
        self.turn(&targets)?;
        self.begin_at(&targets)?;
        Ok(true)
    }

    /// Puts those of `switches`, which stand at zero, into their other branches whose functions leave the ones they are in. Returns whether there are
    /// any.
    fn turn(&mut self, switches: &[usize]) -> Result<bool, Error> {
        let out = self.driven_out(switches);
        if out.is_empty() {
            return Ok(false);
        }
        let Equations {
            problem, switches, ..
        } = &mut self.equations;
        for k in &out {
            switches.flip(*problem, *k);
        }
        switches.arrive(*problem, self.t, &self.y);
        let stuck = self.driven_out(&out);
        match stuck.is_empty() {
            true => Ok(true),
            false => Err(self.stuck(&stuck)),
        }
    }

    /// Branches at the start of the run. A function that is zero there goes where it moves; returns these.
    fn choose(&mut self) -> Result<Vec<usize>, Error> {
        let Equations {
            problem, switches, ..
        } = &mut self.equations;
        let zeros = switches.start(*problem, self.t, &self.y);
        self.hold(&zeros, Branch::Positive);
        let down = self.driven_out(&zeros);
        let rest = self.at_rest(&zeros);
        self.hold(&rest, Branch::Followed);
        self.hold(&down, Branch::Negative);
        let back = self.driven_out(&down);
        // Driven back from both sides, it may stay between them: at rest under friction, without a force.
        self.hold(&back, Branch::Followed);
        match self.at_rest(&back).len() == back.len() {
            true => Ok(zeros),
            false => Err(self.stuck(&back)),
        }
    }

    fn hold(&mut self, switches: &[usize], branch: Branch) {
        for k in switches {
            let problem = &mut *self.equations.problem;
            self.equations.switches.hold(problem, *k, branch);
        }
    }

    /// Those of `switches` whose functions leave the branches they are in.
    fn driven_out(&mut self, switches: &[usize]) -> Vec<usize> {
        let along = self.clock.sign;
        let out = |branch: Branch, rate: f64| along * branch.sign() * rate < 0.0;
        self.moving(switches, out)
    }

    /// Those of `switches` whose functions stay as they are.
    fn at_rest(&mut self, switches: &[usize]) -> Vec<usize> {
        self.moving(switches, |_, rate| rate == 0.0)
    }

    /// Those of `switches` for which `which` of their branch and the rate of their function holds where the run stands; none where f has no value.
    fn moving(&mut self, switches: &[usize], which: impl Fn(Branch, f64) -> bool) -> Vec<usize> {
        // No step is in hand.
        let rate = &mut self.raw;
        let s = self.clock.sign * self.s;
        if switches.is_empty() || self.equations.rate(s, &self.y, rate).is_err() {
            return Vec::new();
        }
        let Equations {
            problem,
            switches: all,
            ..
        } = &mut self.equations;
        let rates = all.rates(*problem, self.t, &self.y, rate);
        let found = switches.iter().copied();
        found.filter(|k| which(all.branch(*k), rates[*k])).collect()
    }

    fn stuck(&mut self, switches: &[usize]) -> Error {
        let error = self.equations.problem.stuck(switches);
        self.trouble = Some(Trouble {
            t: self.t,
            y: self.y.clone(),
            error: error.clone(),
        });
        error
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
