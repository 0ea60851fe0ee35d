//! DOP853 and DOPRI5 of the crate `ivp` as a [`Method`].
//!
//! What its source (0.6) does, and what is done about it here:
//!
//! - Its test for a requested output time assumes that time increases. So integration always runs forward, in s = ±(t − t0).
//!   Counting from t0 also keeps a large t0 from rounding the step sizes: at t = 1e9 the sum t + h would keep seven digits of h = 1.
//! - A callback can hand back a changed solution *or* ask for output at a time, not both, and a changed solution costs an
//!   evaluation more. So the projection is not left to the callback. Both methods evaluate f at the end of the step before they
//!   call back, since the next step begins with that value; that evaluation is recognised by its place in the sequence
//!   of calls ([`Tableau::closing`]), and made at the projected state, which the callback then puts in place. If the sequence
//!   were ever another one, the callback notices that, projects by itself, and pays for the evaluation.
//! - It counts rejected steps only after the second accepted one: counted here as attempted − accepted.
//! - Its stiffness test gives up on steps that error control would accept: switched off.
//! - It cannot be told to redo a step: interrupted, and entered again at the last accepted state with half the step.

use std::cell::RefCell;

use ivp::dense::{DenseSegment, StepInterpolant};
use ivp::ivp::FirstOrderSystem;
use ivp::methods::{DOP853, DOPRI5, IntegrationResult, Tolerance};
use ivp::solout::{ControlFlag, SolOut};
use ivp::status::Status;

use super::{
    Formula, Interpolant, Method, Next, Outcome, PROJECTION_LIMIT, Problem, Report, Segment,
    Settings, Step, error_norm,
};
use crate::error::Error;

/// End times that differ by so many units of rounding are the same: `x + (x_end - x)` rounds twice.
const END_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Conversion between t and s.
#[derive(Clone, Copy)]
pub(super) struct Clock {
    t0: f64,
    /// 1 going forward, −1 going backward.
    sign: f64,
}

impl Clock {
    pub(super) fn t(self, s: f64) -> f64 {
        self.t0 + self.sign * s
    }

    pub(super) fn s(self, t: f64) -> f64 {
        self.sign * (t - self.t0)
    }
}

/// What the wrapper has to know of a method.
#[derive(Clone, Copy)]
struct Tableau {
    /// Evaluations in an attempted step, whether accepted or not.
    stages: usize,
    /// The evaluation at the end of the step is one of them (else it follows on acceptance).
    closing_is_stage: bool,
    /// Formula of the interpolant.
    formula: Formula,
}

impl Tableau {
    fn of(method: Method) -> Self {
        match method {
            Method::Dop853 => Tableau {
                stages: 11,
                closing_is_stage: false,
                formula: DOP853::interpolate,
            },
            Method::Dopri5 => Tableau {
                stages: 6,
                closing_is_stage: true,
                formula: DOPRI5::interpolate,
            },
        }
    }

    /// Whether call number `call` since the last accepted step, 1 the first, can be the evaluation at the end of a step.
    fn closing(self, call: usize) -> bool {
        if self.closing_is_stage {
            call.is_multiple_of(self.stages)
        } else {
            call > 1 && (call - 1).is_multiple_of(self.stages)
        }
    }
}

/// State of the evaluation at the end of the step.
enum Closing {
    /// Not seen.
    Open,
    /// Made at the projected state.
    Done { s: f64 },
    /// The projection or the evaluation failed, or the projection was too large.
    Failed,
}

/// Steps shorter than this share (ε²) of the run are not retried: near s = 0, where no rounding of s stops it, halving could go on
/// through three hundred decades.
const SHORTEST: f64 = f64::EPSILON * f64::EPSILON;

/// Why the callback interrupted.
enum Verdict {
    None,
    Stop,
    /// Redo the step of that size.
    Redo(f64),
    /// A step of that size does not advance t.
    Underflow(f64),
    /// f cannot be evaluated at the start.
    Hopeless,
    TooManySteps,
}

/// An error and where it arose.
struct Trouble {
    t: f64,
    y: Vec<f64>,
    error: Error,
}

/// What right-hand side and callback share.
struct Shared<'p, P> {
    problem: &'p mut P,
    tableau: Tableau,
    tolerance: f64,
    clock: Clock,
    t_end: f64,
    s_end: f64,
    max_steps: usize,
    /// Last accepted state.
    s: f64,
    y: Vec<f64>,
    /// State at the end of the attempted step, as integrated and as projected.
    raw: Vec<f64>,
    projected: Vec<f64>,
    closing: Closing,
    /// Evaluations since the last callback, and the time of the last one.
    calls: usize,
    last_call: f64,
    /// Steps attempted and accepted.
    attempts: usize,
    steps: usize,
    /// The first callback of an entry into `ivp`, at its start, is still to come.
    entering: bool,
    verdict: Verdict,
    /// What went wrong since the last accepted step, nearest to it.
    trouble: Option<Trouble>,
}

impl<P: Problem> Shared<'_, P> {
    fn note(&mut self, s: f64, y: &[f64], error: Error) {
        let t = self.clock.t(s);
        let y = y.to_vec();
        self.trouble = Some(Trouble { t, y, error });
    }

    /// σ f into `rate`, or NaN, which makes the method reject the step.
    fn derivative(&mut self, s: f64, y: &[f64], rate: &mut [f64]) {
        self.calls += 1;
        let closing = self.tableau.closing(self.calls) && s == self.last_call;
        self.last_call = s;
        let done = if closing {
            self.close(s, y, rate)
        } else {
            self.evaluate(s, y, rate)
        };
        if !done {
            rate.fill(f64::NAN);
        } else if self.clock.sign < 0.0 {
            for r in rate {
                *r = -*r;
            }
        }
    }

    fn evaluate(&mut self, s: f64, y: &[f64], rate: &mut [f64]) -> bool {
        if y.iter().any(|y| !y.is_finite()) {
            // After a failed stage this is its consequence; otherwise the step was far too long, and is rejected.
            return false;
        }
        match self.problem.derivative(self.clock.t(s), y, rate) {
            Ok(()) => true,
            Err(error) => {
                self.note(s, y, error);
                false
            }
        }
    }

    /// Evaluation at the end of a step: project first.
    fn close(&mut self, s: f64, y: &[f64], rate: &mut [f64]) -> bool {
        self.raw.copy_from_slice(y);
        self.closing = Closing::Failed;
        if !self.project(s) {
            return false;
        }
        let projected = std::mem::take(&mut self.projected);
        let done = self.evaluate(s, &projected, rate);
        self.projected = projected;
        if done {
            self.closing = Closing::Done { s };
        }
        done
    }

    /// Projects `raw` into `projected`; `false` if that fails or the change says that the step was a bad one.
    fn project(&mut self, s: f64) -> bool {
        self.projected.copy_from_slice(&self.raw);
        if self.raw.iter().any(|y| !y.is_finite()) {
            return false;
        }
        match self.problem.project(self.clock.t(s), &mut self.projected) {
            Ok(()) => {
                let pairs = self.raw.iter().zip(&self.projected);
                let change = pairs
                    .zip(&self.y)
                    .map(|((raw, new), old)| (new - raw, *old, *raw));
                error_norm(change, self.tolerance) <= PROJECTION_LIMIT
            }
            Err(error) => {
                let raw = std::mem::take(&mut self.raw);
                self.note(s, &raw, error);
                self.raw = raw;
                false
            }
        }
    }

    /// Asks for the interpolant of the step in which the next sample lies; a little early, since ends of steps are rounded.
    fn ask(&self) -> ControlFlag {
        ControlFlag::XOut(self.problem.next_sample().map_or(f64::INFINITY, |t| {
            let s = self.clock.s(t);
            s - END_ROUNDING * s.abs()
        }))
    }

    fn interrupt(&mut self, verdict: Verdict) -> ControlFlag {
        self.verdict = verdict;
        ControlFlag::Interrupt
    }

    /// The callback after an accepted step; `ivp` has evaluated f at its end.
    fn accepted(
        &mut self,
        s: f64,
        y: &mut [f64],
        interpolant: Option<&StepInterpolant<'_>>,
    ) -> ControlFlag {
        let redo = Verdict::Redo(s - self.s);
        let mut evaluate_again = false;
        match std::mem::replace(&mut self.closing, Closing::Open) {
            Closing::Done { s: closed } if closed == s && self.raw == y => {}
            Closing::Failed => return self.interrupt(redo),
            Closing::Open | Closing::Done { .. } => {
                self.raw.copy_from_slice(y);
                if !self.project(s) {
                    return self.interrupt(redo);
                }
                evaluate_again = self.raw != self.projected;
            }
        }
        y.copy_from_slice(&self.projected);
        let last = (s - self.s_end).abs() <= END_ROUNDING * self.s_end;
        let t_old = self.clock.t(self.s);
        let t = if last { self.t_end } else { self.clock.t(s) };
        if t == t_old || s - self.s < SHORTEST * self.s_end {
            return self.interrupt(Verdict::Underflow(s - self.s));
        }
        let states = interpolant.map(|inner| States {
            inner,
            clock: self.clock,
            formula: self.tableau.formula,
        });
        let step = Step {
            t_old,
            t,
            y,
            interpolant: states.as_ref().map(|s| s as &dyn Interpolant),
        };
        match self.problem.step(&step) {
            Ok(next) => {
                self.s = s;
                self.y.copy_from_slice(y);
                self.steps += 1;
                self.trouble = None;
                match next {
                    Next::Stop => self.interrupt(Verdict::Stop),
                    Next::Continue if self.attempts >= self.max_steps && !last => {
                        self.interrupt(Verdict::TooManySteps)
                    }
                    Next::Continue if evaluate_again => ControlFlag::ModifiedSolution,
                    Next::Continue => self.ask(),
                }
            }
            Err(error) => {
                self.note(s, y, error);
                self.interrupt(redo)
            }
        }
    }
}

struct States<'a> {
    inner: &'a StepInterpolant<'a>,
    clock: Clock,
    formula: Formula,
}

impl Interpolant for States<'_> {
    fn state(&self, t: f64, y: &mut [f64]) {
        self.inner.interpolate(self.clock.s(t), y);
    }

    fn segment(&self) -> Segment {
        let DenseSegment { cont, xold, h, .. } = self.inner.to_segment();
        Segment {
            clock: self.clock,
            s_old: xold,
            h,
            coefficients: cont,
            formula: self.formula,
        }
    }
}

struct RightHandSide<'a, 'p, P>(&'a RefCell<Shared<'p, P>>);

impl<P: Problem> FirstOrderSystem for RightHandSide<'_, '_, P> {
    fn derivative(&self, s: f64, y: &[f64], rate: &mut [f64]) {
        self.0.borrow_mut().derivative(s, y, rate);
    }
}

struct Callback<'a, 'p, P>(&'a RefCell<Shared<'p, P>>);

impl<P: Problem> SolOut for Callback<'_, '_, P> {
    fn solout(
        &mut self,
        _s_old: f64,
        s: &mut f64,
        y: &mut [f64],
        interpolant: Option<&StepInterpolant<'_>>,
    ) -> ControlFlag {
        let shared = &mut *self.0.borrow_mut();
        let calls = std::mem::take(&mut shared.calls);
        if std::mem::take(&mut shared.entering) {
            // Trouble that is new at the start of a run is f failing there, or in the probe for the first step size.
            let here = shared.clock.t(shared.s);
            return match &shared.trouble {
                Some(trouble) if shared.steps == 0 && trouble.t == here => {
                    shared.interrupt(Verdict::Hopeless)
                }
                _ => shared.ask(),
            };
        }
        // At most four further evaluations belong to an accepted step, fewer than an attempt takes.
        shared.attempts += calls / shared.tableau.stages;
        shared.accepted(*s, y, interpolant)
    }
}

/// [`Method::run`].
pub(super) fn run(
    method: Method,
    problem: &mut impl Problem,
    t0: f64,
    y0: &[f64],
    t_end: f64,
    settings: &Settings,
) -> Report {
    let sign = if t_end < t0 { -1.0 } else { 1.0 };
    let clock = Clock { t0, sign };
    let shared = RefCell::new(Shared {
        problem,
        tableau: Tableau::of(method),
        tolerance: settings.tolerance,
        clock,
        t_end,
        s_end: clock.s(t_end),
        max_steps: settings.max_steps,
        s: 0.0,
        y: y0.to_vec(),
        raw: y0.to_vec(),
        projected: y0.to_vec(),
        closing: Closing::Open,
        calls: 0,
        last_call: f64::NAN,
        attempts: 0,
        steps: 0,
        entering: true,
        verdict: Verdict::None,
        trouble: None,
    });
    let mut first_step = settings.first_step;
    loop {
        let (s, y, remaining, attempts) = {
            let mut shared = shared.borrow_mut();
            shared.entering = true;
            shared.calls = 0;
            shared.closing = Closing::Open;
            let remaining = settings.max_steps.saturating_sub(shared.attempts);
            (shared.s, shared.y.clone(), remaining, shared.attempts)
        };
        let result = enter(method, &shared, s, &y, first_step, remaining, settings);
        let mut shared = shared.borrow_mut();
        if let Ok(result) = &result {
            shared.attempts = attempts + result.steps.total;
        }
        let report = |shared: &Shared<'_, _>, outcome| Report {
            outcome,
            steps: shared.steps,
            rejected: shared.attempts - shared.steps,
        };
        let failed = |shared: &mut Shared<'_, _>, error| {
            let here = Trouble {
                t: clock.t(shared.s),
                y: shared.y.clone(),
                error,
            };
            let Trouble { t, y, error } = shared.trouble.take().unwrap_or(here);
            report(shared, Outcome::Failed { t, y, error })
        };
        let too_many = Error::TooManySteps {
            steps: settings.max_steps,
        };
        return match (
            std::mem::replace(&mut shared.verdict, Verdict::None),
            result,
        ) {
            (Verdict::Redo(step), _) if step < SHORTEST * shared.s_end => {
                failed(&mut shared, Error::StepTooSmall { step })
            }
            (Verdict::Redo(step), _) if shared.attempts < settings.max_steps => {
                first_step = Some(0.5 * step);
                continue;
            }
            (Verdict::Redo(_) | Verdict::TooManySteps, _) => {
                shared.trouble = None;
                failed(&mut shared, too_many)
            }
            (Verdict::Stop, _) => report(&shared, Outcome::Stopped),
            (Verdict::Underflow(step), _) => failed(&mut shared, Error::StepTooSmall { step }),
            (Verdict::Hopeless, _) => failed(&mut shared, Error::StepTooSmall { step: 0.0 }),
            (Verdict::None, Ok(IntegrationResult { status, h, .. })) => match status {
                Status::Success => report(&shared, Outcome::Reached),
                Status::NeedLargerNMax => {
                    shared.trouble = None;
                    failed(&mut shared, too_many)
                }
                _ => failed(&mut shared, Error::StepTooSmall { step: h }),
            },
            // Settings are in the ranges `ivp` accepts, or it would say so here.
            (Verdict::None, Err(refused)) => failed(
                &mut shared,
                Error::InvalidSetting {
                    what: "method",
                    reason: refused.to_string(),
                },
            ),
        };
    }
}

/// Enters `ivp` at (s, y).
fn enter<P: Problem>(
    method: Method,
    shared: &RefCell<Shared<'_, P>>,
    s: f64,
    y: &[f64],
    first_step: Option<f64>,
    max_steps: usize,
    settings: &Settings,
) -> Result<IntegrationResult, ivp::error::Error> {
    let s_end = shared.borrow().s_end;
    let span = s_end - s;
    let first_step = first_step.map(|h| h.min(settings.max_step.unwrap_or(span)).min(span));
    let tolerance = Tolerance::Scalar(settings.tolerance);
    // `ivp` attempts one step more than it is told.
    let max_steps = max_steps.saturating_sub(1).max(1);
    let f = RightHandSide(shared);
    let mut callback = Callback(shared);
    match method {
        Method::Dop853 => DOP853 {
            max_step: settings.max_step,
            first_step,
            max_steps,
            stiff_test: usize::MAX,
            dense_output: settings.dense,
            ..DOP853::default()
        }
        .solve(
            &f,
            s,
            y,
            s_end,
            tolerance.clone(),
            tolerance,
            Some(&mut callback),
        ),
        Method::Dopri5 => DOPRI5 {
            max_step: settings.max_step,
            first_step,
            max_steps,
            stiff_test: usize::MAX,
            dense_output: settings.dense,
            ..DOPRI5::default()
        }
        .solve(
            &f,
            s,
            y,
            s_end,
            tolerance.clone(),
            tolerance,
            Some(&mut callback),
        ),
    }
}
