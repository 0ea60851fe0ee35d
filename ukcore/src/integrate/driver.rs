//! A run: steps until the end, and what becomes of those that fail.

use super::control::StepSize;
use super::course::{Course, Trial};
use super::explicit::Explicit;
use super::radau::Radau;
use super::rattle::Rattle;
use super::sample::Sample;
use super::scheme::{Equations, Scheme};
use super::stepper::Stepper;
use super::sums::projection_norm;
use super::switches::{Leaving, Switches};
use super::trouble::{Cause, Trouble};
use super::{Method, Next, Outcome, PROJECTION_LIMIT, Problem, Report, Settings, Tolerance};
use crate::error::Error;
use crate::scan::all_finite;
use noise::{CLEARLY, LOST, Noise, OFTEN, SELDOM};
use passage::Passage;
use switching::Goal;

mod before;
mod launch;
mod noise;
mod passage;
mod switching;

/// Steps shorter than this share of the run would never end, and are asked whether they get anywhere; so many in a row are not by chance.
const CREEPING: f64 = 1e-7;
const STUCK: usize = 100;

/// Why an attempted step is not accepted.
enum Refusal {
    /// The step could not be made.
    Stage(Cause),
    /// The step's error is that many times too large.
    Inaccurate(f64),
    /// The state at the end of the step does not do.
    End(Cause),
    /// The step goes over a singular position where it was not to.
    Unplanned,
    /// The step does not lead through a state that is known.
    Astray,
    /// There is a singular position ahead of which nobody can tell whether the motion passes it.
    Undecided(Box<Trouble>),
    /// The step is good, with this error, but leaves the branches of its start.
    Leaves(Leaving, f64),
}

struct Driver<'p> {
    equations: Equations<'p>,
    settings: &'p Settings,
    scheme: Box<dyn Scheme>,
    /// The tolerance of the step in hand.
    tolerance: Tolerance,
    /// State at the end of the attempted step before its projection.
    raw: Vec<f64>,
    /// The step to be tried next, where it goes onto the zero of a switch.
    goal: Option<Goal>,
    /// [`Goal::cut`] of the step in hand: it goes on behind its end.
    cut: Option<f64>,
    passage: Passage,
    /// [`Scheme::gap`] of the scheme.
    gap: Option<[f64; 2]>,
    /// Time and state up to which the steps are known already.
    shown: Option<(f64, Vec<f64>)>,
    /// The switches that have taken other branches where the run stands.
    turned: Vec<usize>,
    /// Those at whose zeros it stays.
    rests: Vec<usize>,
    /// How often the run has gone back from one place in a row, each time in other branches.
    relaunches: usize,
    /// Whether it has been asked if the start is to blame for first steps that come to nothing.
    launched: bool,
    /// The state at the end of the run, where the last step goes on behind it and nobody else is told.
    reached: Option<Vec<f64>>,
    /// Steps that were good but left their branches; those onto zeros of switches; those whose error is rounding.
    repeated: usize,
    /// The last steps whose way their projection took back for the greater part.
    undone: usize,
    landings: usize,
    rounded: usize,
    noise: Noise,
    /// Whether the step in hand is granted it, and its tolerance then.
    granted: bool,
    raised: Tolerance,
    /// Whether a method feels all of it: an implicit one none of that of stiff forces.
    explicit: bool,
    /// When it was measured, if steps are not of one size; and the longest step since.
    measured: Option<usize>,
    longest: f64,
}

impl Method {
    /// Integrates from (t0, y0) to `t_end` ≠ t0, in either direction.
    pub(crate) fn run(
        self,
        problem: &mut dyn Problem,
        t0: f64,
        y0: &[f64],
        t_end: f64,
        settings: &Settings,
    ) -> Report {
        Driver::new(self, problem, t0, y0, t_end, settings)
            .travel()
            .0
    }
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
        let tolerance = settings.tolerance.clone();
        let scheme_tolerance = || settings.tolerance.clone();
        let explicit = matches!(method, Method::Dop853 | Method::Dopri5);
        let varies = !matches!(method, Method::Rattle { .. });
        let by_stepper = |stepper| {
            let size = StepSize::default();
            Box::new(Explicit { stepper, size })
        };
        let scheme: Box<dyn Scheme> = match method {
            Method::Dop853 => by_stepper(Stepper::dop853(y0.to_vec(), scheme_tolerance())),
            Method::Dopri5 => by_stepper(Stepper::dopri5(y0.to_vec(), scheme_tolerance())),
            Method::Radau5 => Box::new(Radau::new(y0, scheme_tolerance())),
            Method::Rattle { step } => Box::new(Rattle::new(y0, step, t_end - t0)),
        };
        Driver {
            equations: Equations {
                switches: Switches::new(problem.switches(), y0.len()),
                problem,
                course: Course::new(t0, t_end, settings),
                nearby: false,
                consistent: Vec::new(),
            },
            settings,
            tolerance,
            gap: scheme.gap(),
            scheme,
            raw: y0.to_vec(),
            goal: None,
            cut: None,
            passage: Passage::default(),
            shown: None,
            turned: Vec::new(),
            rests: Vec::new(),
            relaunches: 0,
            launched: false,
            reached: None,
            repeated: 0,
            undone: 0,
            landings: 0,
            rounded: 0,
            noise: Noise::default(),
            granted: false,
            raised: settings.tolerance.clone(),
            explicit,
            measured: varies.then_some(0),
            longest: 0.0,
        }
    }

    /// Makes all steps. Returns the state at the end, too.
    fn travel(mut self) -> (Report, Vec<f64>) {
        let outcome = match self.run() {
            Err(_) if self.ends_at_rest() => Ok(Outcome::Stopped),
            outcome => outcome,
        };
        let (scheme, course) = (self.scheme, &mut self.equations.course);
        // Of what lies before states that are shown already nobody has been told.
        let shown = self.shown.filter(|(t, _)| course.ahead(*t) > 0.0);
        let report = Report {
            outcome: outcome.unwrap_or_else(|error| {
                let lost = matches!(error, Error::StepTooSmall { .. });
                let obstacle = lost.then(|| self.passage.obstacle()).flatten();
                let error = obstacle.unwrap_or(error);
                let here = Sample::of(course.now.t, scheme.start());
                let mut trouble = course.explain(error, here);
                if let Some((t, y)) = shown
                    && course.ahead(trouble.state.t) < course.ahead(t)
                {
                    trouble.state = Sample::of(t, &y).to_state();
                }
                Outcome::Failed(trouble)
            }),
            steps: course.steps,
            rejected: course.rejected() - self.repeated,
            landings: self.landings,
            rounded: self.rounded,
            factorisations: scheme.factorisations(),
        };
        let reached = self.reached.unwrap_or_else(|| scheme.start().to_vec());
        (report, reached)
    }
}

impl Driver<'_> {
    /// All steps. An error says that there is no next one; what went wrong before, if that is known, is its cause.
    fn run(&mut self) -> Result<Outcome, Error> {
        self.choose()?;
        let largest = self.equations.course.largest_first();
        self.equations.course.h = match self.settings.first_step {
            Some(h) => h.min(largest.abs()).copysign(largest),
            None => self.scheme.first_size(&mut self.equations, largest),
        };
        loop {
            if let Some(outcome) = self.detour()? {
                return Ok(outcome);
            }
            if self.equations.course.steps == 0 && !self.launched {
                self.launch_if_stuck()?;
            }
            self.retreat()?;
            let goal = self.goal.take();
            self.approach(goal.as_ref());
            let planned = goal.as_ref().map(|goal| goal.trial).or(self.passage.beyond);
            let trial = self.equations.course.plan(planned)?;
            // How long a step may be was found out by the one that a step onto a zero was cut from.
            let whole = |error: f64| goal.as_ref().map_or((trial.h, error), |goal| goal.whole);
            match self.attempt(trial) {
                Ok((Next::Stop, _)) => return Ok(Outcome::Stopped),
                Ok(_) if trial.last => return Ok(Outcome::Reached),
                Ok((Next::Continue, error)) => self.accept(whole(error))?,
                Err(refusal) => self.refuse(refusal, trial, whole)?,
            }
        }
    }

    /// Chooses the size of the next step after one that was accepted; size and error are those that count.
    fn accept(&mut self, (h, error): (f64, f64)) -> Result<(), Error> {
        // Steps may be so short that none is refused for the rounding in it.
        self.measure(SELDOM);
        self.uncover(h);
        (self.passage.plans, self.passage.astray) = (0, false);
        self.turned.clear();
        let next = self.scheme.accepted(h, error).abs();
        self.equations.course.propose(next.max(self.passage.wanted));
        if self.arrive()? {
            // The other branch is not known yet.
            self.equations.course.limit(h);
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
        // There may be nothing behind the end of the run.
        let made = !matches!(refusal, Refusal::Stage(_) | Refusal::End(_));
        self.passage.bounded |= self.passage.beyond.is_some() && !made;
        let h = trial.h;
        let (next, cause) = match refusal {
            Refusal::Leaves(leaving, error) => return self.follow(leaving, trial, whole(error)),
            Refusal::Astray => return self.turn_back(),
            Refusal::Unplanned => (self.equations.course.h, None),
            Refusal::Undecided(trouble) => {
                self.equations.course.blame(Some(trouble));
                return Err(Error::too_small(h.abs()));
            }
            Refusal::Inaccurate(error) => {
                let rounding = f64::EPSILON * self.equations.course.now.t.abs();
                let lost = h.abs() < CLEARLY * rounding;
                self.measure(if lost { OFTEN } else { SELDOM });
                (self.scheme.inaccurate(h, error), None)
            }
            // Beyond a zero there may be no value in the branch held.
            Refusal::Stage(Some(_)) | Refusal::End(Some(_)) if self.equations.release() => {
                (h, None)
            }
            Refusal::Stage(cause) => (self.scheme.inaccurate(h, f64::NAN), cause),
            Refusal::End(cause) => (self.scheme.unfit(h), cause),
        };
        self.equations.course.h = next;
        self.equations.course.blame(cause);
        Ok(())
    }

    /// Tries a step, and moves to its end if it is good. Returns its error.
    fn attempt(&mut self, trial: Trial) -> Result<(Next, f64), Refusal> {
        self.equations.switches.doubt = false;
        // What is left of an error above the tolerance when it is rounding: a shorter step would have as much of it in the same time.
        let rounding = f64::max(1.0, self.noise.own * trial.h.abs());
        self.grant(trial.h);
        let made = self.make(trial);
        self.survey(trial, &made)?;
        let error = made?;
        self.weigh(error * rounding, trial.h)?;
        self.progress(trial)?;
        let interpolated = self.stay(trial, error)?;
        let (trial, interpolated) = self.end_at_zero(trial, interpolated)?;
        let (next, along) = self.show(trial, interpolated, error)?;
        let error = error.max(small(along)?);
        (self.passage.before).keep(self.equations.course.now, self.scheme.start());
        (self.equations.course).advance(trial, || self.scheme.states());
        self.scheme.advance();
        self.rounded += usize::from(error * rounding > 1.0);
        Ok((next, error))
    }

    /// Makes a step up to its projected end. Returns its error as a part of the tolerance.
    fn make(&mut self, trial: Trial) -> Result<f64, Refusal> {
        let error = self.scheme.attempt(&mut self.equations, trial);
        let early = small(error.map_err(Refusal::Stage)?)?;
        self.project(trial.end.t)?;
        let error = self.scheme.close(&mut self.equations, trial);
        let late = small(error.map_err(Refusal::End)?)?;
        Ok(early.max(late))
    }

    /// Projects the new state. Refuses if that fails or the change says that the step was a bad one.
    fn project(&mut self, t: f64) -> Result<(), Refusal> {
        if !all_finite(self.scheme.end()) {
            return Err(Refusal::End(None));
        }
        if self.scheme.keeps_constraints() {
            return Ok(());
        }
        let tolerance = &self.tolerance;
        let Equations {
            problem, course, ..
        } = &mut self.equations;
        self.raw.copy_from_slice(self.scheme.end());
        let raw = Sample::of(t, &self.raw);
        let (q, v) = self.scheme.end_mut().split_at_mut(raw.q.len());
        let projected = problem.project(t, q, v);
        projected.map_err(|error| Refusal::End(course.note(raw, error)))?;
        let [old, new] = self.scheme.states();
        // No weight of the norm is above 1 / absolute tolerance.
        let least = PROJECTION_LIMIT * tolerance.relative;
        let changes = self.raw.iter().zip(new).zip(&tolerance.floors);
        if changes.fold(true, |all, ((raw, new), floor)| {
            all & ((new - raw).abs() <= least * floor)
        }) {
            return Ok(());
        }
        let change = || new.iter().zip(&self.raw).map(|(new, raw)| new - raw);
        let states = [old, &self.raw];
        if projection_norm(change(), states, tolerance) <= PROJECTION_LIMIT {
            return Ok(());
        }
        let mut excess: Vec<f64> = change().collect();
        problem.excess(raw, &mut excess);
        if projection_norm(excess.into_iter(), states, tolerance) <= PROJECTION_LIMIT {
            return Ok(());
        }
        if self.enter() {
            return Err(Refusal::Unplanned);
        }
        let Equations {
            problem, course, ..
        } = &mut self.equations;
        let raw = Sample::of(t, &self.raw);
        // Asked close to the place alone, so that the error has its time.
        let jump = match course.is_close(t) {
            true => problem.jump(raw, course.now.t),
            false => None,
        };
        Err(Refusal::End(
            jump.map(|error| Box::new(Trouble::new(raw, error))),
        ))
    }

    /// Refuses where projections have taken back the greater part of the way for many steps: velocities that lead off the constraints
    /// however short the steps are.
    fn progress(&mut self, trial: Trial) -> Result<(), Refusal> {
        let Equations {
            problem, course, ..
        } = &mut self.equations;
        if trial.h.abs() > CREEPING * course.end.s.abs() || self.scheme.keeps_constraints() {
            self.undone = 0;
            return Ok(());
        }
        let [old, new] = self.scheme.states();
        let mut along = [0.0; 2];
        let pairs = old.iter().zip(&self.raw).zip(new).take(old.len() / 2);
        for (i, ((old, raw), new)) in pairs.enumerate() {
            let allowed = self.tolerance.at(i, old.abs());
            let [way, back] = [raw - old, raw - new].map(|x| x / allowed);
            along[0] += way * way;
            along[1] += way * back;
        }
        let [way, back] = along;
        let undone = way > 0.0 && back > 0.5 * way;
        self.undone = if undone { self.undone + 1 } else { 0 };
        if self.undone < STUCK {
            return Ok(());
        }
        self.undone = 0;
        let raw = Sample::of(trial.end.t, &self.raw);
        match problem.stuck(raw) {
            Some(error) => Err(Refusal::Undecided(Box::new(Trouble::new(raw, error)))),
            None => Ok(()),
        }
    }

    /// Shows the problem the step, whose error is `error`, with its interpolant if one is wanted. Returns the error of what the problem
    /// makes of it, too.
    fn show(
        &mut self,
        trial: Trial,
        interpolated: bool,
        error: f64,
    ) -> Result<(Next, f64), Refusal> {
        let course = &self.equations.course;
        let ahead = self.shown.as_ref().map(|(t, _)| course.ahead(*t));
        // A step that is cut ends before its size.
        if ahead.is_some_and(|ahead| ahead >= course.ahead(trial.end.t)) {
            if course.is_beyond(trial) {
                let reached = self.read_off(trial, interpolated);
                self.reached = Some(reached.ok_or(Refusal::End(None))?);
            }
            return Ok((Next::Continue, 0.0));
        }
        let equations = &mut self.equations;
        let next = equations.problem.next_sample();
        let wanted = self.settings.dense
            || equations.course.covers(trial, next)
            || equations.course.is_beyond(trial)
            || self.passage.retreated.is_some();
        if wanted {
            let stages = match interpolated {
                true => Ok(()),
                false => self.scheme.interpolate(equations, trial),
            };
            self.survey_interpolant(trial)?;
            stages.map_err(Refusal::End)?;
        }
        let equations = &mut self.equations;
        let known = self.shown.as_ref().map(|(t, y)| Sample::of(*t, y));
        if wanted {
            self.scheme.scale_error(error);
        }
        let coefficients = wanted.then(|| self.scheme.dense());
        let mut step = (equations.course).show(trial, self.scheme.states(), coefficients);
        if let (Some(_), Some(known)) = (self.passage.retreated, known)
            && !step.leads_through(known, &self.tolerance)
        {
            return Err(Refusal::Astray);
        }
        step.old = known.unwrap_or(step.old);
        let from = step.old.t;
        (step.interpolant.iter_mut()).for_each(|interpolant| interpolant.from = from);
        step.nearby = equations.nearby;
        step.error = self.scheme.error().filter(|_| wanted);
        let shown = equations.problem.step(&step);
        let (next, along) =
            shown.map_err(|error| Refusal::End(Some(Box::new(Trouble::new(step.new, error)))))?;
        if along <= 1.0 {
            (self.shown, self.passage.retreated, self.relaunches) = (None, None, 0);
        }
        Ok((next, along))
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
