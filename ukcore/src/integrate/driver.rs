//! A run: steps until the end, and what becomes of those that fail.

use super::course::{Course, Trial};
use super::dense::Interpolant;
use super::explicit::Explicit;
use super::radau::Radau;
use super::rattle::Rattle;
use super::sample::Sample;
use super::scheme::{Attempt, Equations, Scheme};
use super::stepper::Stepper;
use super::sums::error_norm;
use super::switches::{Leaving, Switches};
use super::trouble::{Cause, Trouble};
use super::{Method, Next, Outcome, PROJECTION_LIMIT, Problem, Report, Settings, Step};
use crate::error::Error;
use crate::scan::{all_finite, all_pairs};
use passage::Passage;
use switching::Goal;

mod passage;
mod switching;

/// Why an attempted step is not accepted.
enum Refusal {
    /// It could not be made.
    Stage(Cause),
    /// Its error is that many times too large.
    Inaccurate(f64),
    /// The state at its end does not do.
    End(Cause),
    /// It goes over a singular position where it was not to.
    Unplanned,
    /// There is a singular position ahead of which nobody can tell whether the motion passes it.
    Undecided(Box<Trouble>),
    /// It is good, with this error, but leaves the branches of its start.
    Leaves(Leaving, f64),
}

struct Driver<'p> {
    equations: Equations<'p>,
    settings: &'p Settings,
    scheme: Box<dyn Scheme>,
    course: Course,
    /// Last accepted state.
    y: Vec<f64>,
    /// State at the end of the attempted step before its projection.
    raw: Vec<f64>,
    /// The step to be tried next, where it goes onto the zero of a switch.
    goal: Option<Goal>,
    passage: Passage,
    /// Time and state up to which the steps are known already.
    shown: Option<(f64, Vec<f64>)>,
    /// Steps that were good but left their branches; those onto zeros of switches.
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
    Driver::new(method, problem, t0, y0, t_end, settings)
        .travel()
        .0
}

impl<'p> Driver<'p> {
    fn new(
        method: Method,
        problem: &'p mut dyn Problem,
        t0: f64,
        y0: &[f64],
        t_end: f64,
        settings: &'p Settings,
    ) -> Self {
        let n = y0.len();
        let scheme: Box<dyn Scheme> = match method {
            Method::Dop853 => Box::new(Explicit::new(Stepper::dop853(n))),
            Method::Dopri5 => Box::new(Explicit::new(Stepper::dopri5(n))),
            Method::Radau5 => Box::new(Radau::new(n)),
            Method::Rattle { step } => Box::new(Rattle::new(n, step, (t_end - t0).abs())),
        };
        let located = match method {
            // Its steps are of one size.
            Method::Rattle { .. } => 0,
            _ => problem.switches(),
        };
        Driver {
            equations: Equations::new(problem, t0, Switches::new(located, n)),
            settings,
            scheme,
            course: Course::new(t0, t_end, settings),
            y: y0.to_vec(),
            raw: y0.to_vec(),
            goal: None,
            passage: Passage::default(),
            shown: None,
            repeated: 0,
            landings: 0,
        }
    }

    /// All steps. Returns the state at the end, too.
    fn travel(mut self) -> (Report, Vec<f64>) {
        let outcome = self.run().unwrap_or_else(|error| {
            let here = Sample::of(self.course.now.t, &self.y);
            let conflict = &mut self.equations.conflict;
            Outcome::Failed(self.course.explain(error, here, conflict))
        });
        let report = Report {
            outcome,
            steps: self.course.steps,
            rejected: self.course.rejected() - self.repeated,
            landings: self.landings,
            factorisations: self.scheme.factorisations(),
        };
        (report, self.y)
    }
}

impl Driver<'_> {
    /// All steps. An error says that there is no next one; what went wrong before, if that is known, is its cause.
    fn run(&mut self) -> Result<Outcome, Error> {
        self.start()?;
        loop {
            if let Some(outcome) = self.detour()? {
                return Ok(outcome);
            }
            let goal = self.goal.take();
            self.approach(goal.is_some());
            let trial = self.course.plan(goal.as_ref().map(|goal| goal.trial))?;
            // How long a step may be was found out by the one that a step onto a zero was cut from.
            let whole = |error: f64| goal.as_ref().map_or((trial.size, error), |goal| goal.whole);
            match self.attempt(trial) {
                Ok((Next::Stop, _)) => return Ok(Outcome::Stopped),
                Ok(_) if trial.last => return Ok(Outcome::Reached),
                Ok((Next::Continue, error)) => self.accept(whole(error))?,
                Err(refusal) => self.refuse(refusal, trial, whole)?,
            }
        }
    }

    /// Evaluates f at the start and chooses the size of the first step.
    fn start(&mut self) -> Result<(), Error> {
        self.choose()?;
        let largest = self.course.largest_first();
        self.course.h = match self.settings.first_step {
            Some(h) => h.min(largest),
            None => {
                let (sign, tolerance) = (self.course.clock.sign, self.settings.tolerance);
                let equations = &mut self.equations;
                (self.scheme).first_size(equations, &self.y, sign, tolerance, largest)
            }
        };
        Ok(())
    }

    /// Evaluates f where the run stands.
    fn begin(&mut self) -> Result<(), Cause> {
        let s = self.course.clock.sign * self.course.now.s;
        self.scheme.begin(&mut self.equations, s, &self.y)
    }

    /// Chooses the size of the next step after one that was accepted; size and error are those that count.
    fn accept(&mut self, (size, error): (f64, f64)) -> Result<(), Error> {
        self.passage.plans = 0;
        self.course.check_pace()?;
        let next = self.scheme.accepted(&mut self.course.size, size, error);
        self.course.propose(next.max(self.passage.wanted));
        if self.arrive()? {
            // The other branch is not known yet.
            self.course.h = self.course.h.min(size);
        }
        Ok(())
    }

    /// Chooses the size of the next attempt; `whole` makes of an error the size and the error that count.
    fn refuse(
        &mut self,
        refusal: Refusal,
        trial: Trial,
        whole: impl Fn(f64) -> (f64, f64),
    ) -> Result<(), Error> {
        self.equations.switches.targets.clear();
        let (h, size) = (trial.size, &mut self.course.size);
        let (next, cause) = match refusal {
            Refusal::Leaves(leaving, error) => return self.follow(leaving, trial, whole(error)),
            Refusal::Unplanned => (self.course.h, None),
            Refusal::Undecided(trouble) => {
                self.course.refuse(Some(trouble));
                return Err(Error::StepTooSmall { step: h });
            }
            Refusal::Inaccurate(error) => (self.scheme.inaccurate(size, h, error), None),
            // Beyond a zero there may be no value in the branch held.
            Refusal::Stage(Some(_)) | Refusal::End(Some(_)) if self.equations.release() => {
                (h, None)
            }
            Refusal::Stage(cause) => (self.scheme.inaccurate(size, h, f64::NAN), cause),
            Refusal::End(cause) => (self.scheme.unfit(size, h), cause),
        };
        self.course.h = next;
        self.course.refuse(cause);
        Ok(())
    }

    /// Tries a step, and moves to its end if it is good. Returns its error.
    fn attempt(&mut self, trial: Trial) -> Result<(Next, f64), Refusal> {
        let mut step = self.course.attempt(trial);
        step.tolerance = self.tolerance();
        self.equations.switches.begin();
        let made = self.make(step, trial);
        self.survey(trial, made.is_ok())?;
        let error = made?;
        let interpolated = self.stay(step, trial, error)?;
        let next = self.show(step, trial, interpolated)?;
        self.equations.conflict.pass(self.course.now.t, trial.end.t);
        self.course
            .watch(trial, || (&self.y[..], self.scheme.state()));
        if self.scheme.gap().is_none() {
            let (t, y) = self.passage.before.get_or_insert_default();
            *t = self.course.now.t;
            y.clone_from(&self.y);
        }
        self.course.advance(trial);
        self.scheme.advance(&mut self.y);
        Ok((next, error))
    }

    /// Makes a step up to its projected end. Returns its error.
    fn make(&mut self, step: Attempt, trial: Trial) -> Result<f64, Refusal> {
        let error = self.scheme.attempt(&mut self.equations, step, &self.y);
        let early = small(error.map_err(Refusal::Stage)?)?;
        self.project(trial.end.t)?;
        let error = self.scheme.close(&mut self.equations, step, &self.y);
        let late = small(error.map_err(Refusal::End)?)?;
        Ok(early.max(late))
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
        let tolerance = self.tolerance();
        let new = self.scheme.state_mut();
        self.raw.copy_from_slice(new);
        let raw = Sample::of(t, &self.raw);
        let refuse = |error| Refusal::End(Some(Box::new(Trouble::new(raw, error))));
        let (q, v) = new.split_at_mut(raw.q.len());
        if let Err(error) = self.equations.problem.project(t, q, v) {
            self.equations.conflict.note(raw, &error);
            return Err(refuse(error));
        }
        // No weight of the norm is above 1 / absolute tolerance.
        let least = PROJECTION_LIMIT * tolerance.absolute;
        if all_pairs(&self.raw, new, |raw, new| (new - raw).abs() <= least) {
            return Ok(());
        }
        let pairs = self.raw.iter().zip(&*new).zip(&self.y);
        let change = pairs.map(|((raw, new), old)| (new - raw, *old, *raw));
        if error_norm(change, tolerance) <= PROJECTION_LIMIT {
            return Ok(());
        }
        // Asked close to the place alone, so that the error has its time.
        let jump = match self.course.is_close(t) {
            true => self.equations.problem.jump(raw, self.course.now.t),
            false => None,
        };
        Err(jump.map_or(Refusal::End(None), refuse))
    }

    /// Shows the problem the step, with its interpolant if one is wanted.
    fn show(&mut self, step: Attempt, trial: Trial, interpolated: bool) -> Result<Next, Refusal> {
        let Trial { size, end, .. } = trial;
        let (clock, now) = (self.course.clock, self.course.now);
        let known = self.shown.as_ref().map(|(t, y)| Sample::of(*t, y));
        if known.is_some_and(|known| end.s <= clock.s(known.t)) {
            return Ok(Next::Continue);
        }
        let within = |sample: f64| clock.passed(sample, end.s);
        let wanted =
            self.settings.dense || (self.equations.problem.next_sample()).is_some_and(within);
        if wanted && !interpolated {
            let stages = (self.scheme).interpolate(&mut self.equations, step, &self.y);
            stages.map_err(Refusal::End)?;
        }
        let new = Sample::of(end.t, self.scheme.state());
        let step = Step {
            old: known.unwrap_or(Sample::of(now.t, &self.y)),
            new,
            nearby: self.equations.nearby,
            interpolant: wanted.then_some(Interpolant {
                clock,
                s_old: now.s,
                h: size,
                coefficients: self.scheme.dense(),
            }),
        };
        let shown = self.equations.problem.step(&step);
        let next = shown.map_err(|error| Refusal::End(Some(Box::new(Trouble::new(new, error)))));
        if next.is_ok() {
            self.shown = None;
        }
        next
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
