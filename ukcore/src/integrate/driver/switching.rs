//! What switches ask of the driver: steps onto their zeros, and a new start in their other branches.

use super::{Driver, Refusal};
use crate::error::Error;
use crate::integrate::course::Trial;
use crate::integrate::sample::Sample;
use crate::integrate::sums::projection_norm;
use crate::integrate::switches::{Leaving, Seen, Stuck, on_by, to_zeros};
use crate::integrate::{Next, PROJECTION_LIMIT, Problem};
use crate::mechanism::Branch;

/// Constraints that ask for other velocities beside the zero of a switch than in the branch before, and by no more than this share of that
/// at the zero, and than any step may be projected by, do so for being beside it.
const CONTINUOUS: f64 = 0.1;

/// How often the way over a zero is doubled where rounding hides it.
const BEHIND: usize = 8;

/// A step onto the zero of a switch.
pub(super) struct Goal {
    pub(super) trial: Trial,
    /// Size and error of the step that would have gone across.
    pub(super) whole: (f64, f64),
    /// The part of it up to the zero, where that is too near to a singular position, which the step goes over, for a step to end there.
    pub(super) cut: Option<f64>,
}

impl Driver<'_> {
    /// Chooses branches at the start of the run, and evaluates f there.
    pub(super) fn choose(&mut self) -> Result<(), Error> {
        let floors = &self.settings.tolerance.floors;
        let zeros = self.equations.choose(self.scheme.start(), floors);
        let zeros = zeros.map_err(|stuck| self.stuck(&stuck))?;
        match self.begin_at(&zeros) {
            Err(error) => self.launch()?.then_some(()).ok_or(error),
            begun => begun,
        }
    }

    /// Evaluates f where `switches` stand at zero: those are followed if f has no value there in their branches.
    fn begin_at(&mut self, switches: &[usize]) -> Result<(), Error> {
        if self.scheme.begin(&mut self.equations).is_ok() {
            return Ok(());
        }
        self.equations
            .set_branch(switches, Branch::Followed, self.scheme.start());
        self.begin()
    }

    /// Refuses the closed step if it leaves the branches of its start. Returns whether its interpolant had to be made for that.
    pub(super) fn stay(&mut self, trial: Trial, error: f64) -> Result<bool, Refusal> {
        let equations = &mut self.equations;
        if equations.switches.is_empty() {
            return Ok(false);
        }
        let unlocked = equations.unlocked(trial, self.scheme.states());
        if !unlocked.is_empty() {
            return Err(Refusal::Leaves(Leaving::Unlocked(unlocked), error));
        }
        let t0 = equations.course.t0;
        let time = |theta: f64| t0 + trial.start.s + theta * trial.h;
        // What comes before a place where the run has gone back from is none of it; nor is what comes behind a cut.
        let known = self.shown.as_ref().map(|(t, _)| equations.course.ahead(*t));
        let from = known.map_or(0.0, |ahead| ahead / trial.h.abs()).max(0.0);
        let to = self.cut.unwrap_or(1.0);
        if from >= to {
            return Ok(false);
        }
        let (ends, problem) = (self.scheme.states(), &mut *equations.problem);
        match (equations.switches).dips(problem, time, trial.h, ends) {
            _ if from > 0.0 || to < 1.0 => {}
            Seen::Rough => return Err(Refusal::End(None)),
            Seen::Whole if !equations.switches.doubt => return Ok(false),
            Seen::Whole | Seen::Dips => {}
        }
        let stages = self.scheme.interpolate(equations, trial);
        stages.map_err(Refusal::End)?;
        let coefficients = self.scheme.dense();
        let (switches, problem) = (&mut equations.switches, &mut *equations.problem);
        match switches.search(problem, time, coefficients, [from, to]) {
            None => {}
            Some(Leaving::AtEnd(targets)) => equations.switches.targets.extend(targets),
            Some(leaving) => return Err(Refusal::Leaves(leaving, error)),
        }
        Ok(true)
    }

    /// Goes on after a step that left its branches, cut from one of size and error `whole`: plans the step onto the zero, or takes the
    /// other branch if it stands there.
    pub(super) fn follow(
        &mut self,
        leaving: Leaving,
        trial: Trial,
        whole: (f64, f64),
    ) -> Result<(), Error> {
        self.repeated += 1;
        self.equations.course.h = whole.0;
        let switches = match leaving {
            Leaving::AtOnce(switches) if self.shown.is_some() => return self.relaunch(&switches),
            Leaving::AtOnce(switches) | Leaving::AtEnd(switches) => switches,
            Leaving::Unlocked(switches) => {
                self.equations
                    .unlock(&switches, whole.0, self.scheme.start());
                return self.begin_at(&switches);
            }
            Leaving::Within(theta, switches) if self.passage.passes_near(self.gap, theta) => {
                self.equations.switches.targets = switches;
                let trial = Trial {
                    last: false,
                    ..trial
                };
                let cut = Some(theta);
                self.goal = Some(Goal { trial, whole, cut });
                return Ok(());
            }
            Leaving::Within(theta, switches) => {
                if let Some(trial) = self.equations.course.step(theta * trial.h) {
                    self.equations.switches.targets = switches;
                    let cut = None;
                    self.goal = Some(Goal { trial, whole, cut });
                    return Ok(());
                }
                switches
            }
        };
        if self
            .equations
            .hover(&switches, whole.0, self.scheme.start())
        {
            return self.begin_at(&switches);
        }
        match self.equations.turn(&switches, self.scheme.start()) {
            Ok(true) => {
                self.turned.clone_from(&switches);
                return self.begin_at(&switches);
            }
            Ok(false) => {}
            Err(Stuck(stuck)) => {
                self.equations.flip(&stuck, self.scheme.start());
                let loose = (self.equations).loosen(&stuck, whole.0, self.scheme.start());
                return match loose {
                    true => self.begin_at(&switches),
                    false => Err(self.rests(Stuck(stuck))),
                };
            }
        }
        // The motion goes into its branch, and leaves it before the step's first part ends.
        self.equations.course.h = self.scheme.unfit(trial.h);
        Ok(())
    }

    /// Ends a step that goes over a singular position at a zero near that, if it is to be cut. Returns whether its interpolant is made,
    /// too.
    pub(super) fn end_at_zero(
        &mut self,
        trial: Trial,
        interpolated: bool,
    ) -> Result<(Trial, bool), Refusal> {
        let (Some(theta), Some(position)) = (self.cut, self.passage.ahead()) else {
            return Ok((trial, interpolated));
        };
        if !interpolated {
            let stages = self.scheme.interpolate(&mut self.equations, trial);
            stages.map_err(Refusal::End)?;
        }
        let lost = || Refusal::End(None);
        let part = self.equations.course.step(theta * trial.h);
        let end = part.ok_or_else(lost)?.end;
        let start = self.scheme.start().to_vec();
        let state = self.go_over(&position, [trial.start.t, end.t], &start);
        self.scheme
            .end_mut()
            .copy_from_slice(&state.ok_or_else(lost)?);
        Ok((Trial { end, ..trial }, true))
    }

    /// The last step is accepted: where it went onto zeros of switches, the next one begins in their other branches. Returns whether it
    /// did.
    pub(super) fn arrive(&mut self) -> Result<bool, Error> {
        let landed = !self.equations.switches.targets.is_empty();
        self.landings += usize::from(landed);
        let (start, h) = (self.scheme.start(), self.equations.course.h);
        let targets = match self.equations.arrive(start) {
            Ok(targets) => targets,
            Err(Stuck(switches)) if self.equations.loosen(&switches, h, start) => switches,
            Err(stuck) => return Err(self.rests(stuck)),
        };
        self.equations.hover(&targets, h, start);
        // Steps go across lengths, whether they go onto other switches or not.
        if self.equations.course.pace.is_slow() {
            let across = self.equations.carried_across(self.scheme.start());
            self.equations.course.pace.across(&across)?;
        }
        let launched = self.cut.take().is_some() && self.launch()?;
        if landed && !launched {
            self.begin_at(&targets)?;
            self.turned = targets;
        }
        Ok(landed)
    }

    /// Moves velocities onto the constraints of the branches that switches have taken where the run stands, which is beside their zeros by
    /// what its tolerance allows. Returns whether it did: not where constraints jump at the zeros themselves, and once at most.
    pub(super) fn enter(&mut self) -> bool {
        let switches = std::mem::take(&mut self.turned);
        let (now, y) = (self.equations.course.now, self.scheme.start().to_vec());
        if switches.is_empty() || self.shown.is_some() {
            return false;
        }
        // It has come by the accelerations of the branches before.
        let (n, at) = (y.len() / 2, Sample::of(now.t, &y));
        let mut acceleration = vec![0.0; n];
        self.equations.flip(&switches, &y);
        let before = (self.equations.problem).acceleration(at, &mut acceleration);
        self.equations.flip(&switches, &y);
        self.equations.settle(&y);
        if before.is_err() {
            return false;
        }
        let problem = &mut *self.equations.problem;
        let [values, rates] = moving(problem, at, &acceleration);
        let Some(way) = to_zeros(&switches, &values, &rates) else {
            return false;
        };
        let zero = on_by(way, &y, &acceleration);
        let tolerance = &self.settings.tolerance;
        let mut entered = |t: f64, y: &[f64]| {
            let mut entered = y.to_vec();
            let (q, v) = entered.split_at_mut(n);
            problem.project(t, q, v).ok()?;
            let changes = entered.iter().zip(y).map(|(new, old)| new - old);
            Some((projection_norm(changes, [y, y], tolerance), entered))
        };
        match (entered(now.t, &y), entered(now.t + way, &zero)) {
            (Some((here, state)), Some((there, _)))
                if there <= (CONTINUOUS * here).min(PROJECTION_LIMIT) =>
            {
                self.stand(now, &state);
                self.begin().is_ok()
            }
            _ => false,
        }
    }

    fn stuck(&mut self, Stuck(switches): &Stuck) -> Error {
        self.equations.course.stuck(switches)
    }

    /// The error of a motion that is stuck in the branches that it came in.
    fn rests(&mut self, stuck: Stuck) -> Error {
        let error = self.stuck(&stuck);
        self.rests = stuck.0;
        error
    }

    /// Whether a motion that stays at the zeros of switches meets there what its run was to end with. A step onto a zero ends before it, or
    /// behind, by its error: what has its own zero on the rest of the way counts as met.
    pub(super) fn ends_at_rest(&mut self) -> bool {
        let switches = std::mem::take(&mut self.rests);
        if switches.is_empty() || self.shown.is_some() {
            return false;
        }
        let (now, y) = (self.equations.course.now, self.scheme.start().to_vec());
        let (n, at) = (y.len() / 2, Sample::of(now.t, &y));
        let mut acceleration = vec![0.0; n];
        let direction = self.equations.course.along;
        let problem = &mut *self.equations.problem;
        if problem.acceleration(at, &mut acceleration).is_err() {
            return false;
        }
        let [values, rates] = moving(problem, at, &acceleration);
        // What lies behind them already the step has met.
        if (switches.iter()).any(|k| values[*k] * rates[*k] * direction > 0.0) {
            return false;
        }
        let left = switches.iter().map(|k| (values[*k] / rates[*k]).abs());
        let mut way = left.fold(f64::EPSILON * now.t.abs(), f64::max);
        let mut behind = vec![0.0; values.len()];
        for _ in 0..BEHIND {
            let along = direction * way;
            let beyond = on_by(along, &y, &acceleration);
            let beyond = Sample::of(now.t + along, &beyond);
            problem.switching(beyond, &mut behind);
            let passed = |k: &usize| behind[*k] * rates[*k] * along > 0.0;
            if switches.iter().all(passed) {
                return matches!(problem.rests(beyond), Ok(Next::Stop));
            }
            way *= 2.0;
        }
        false
    }
}

/// The values of the switches of a problem at a state, and their rates with these accelerations.
fn moving(problem: &mut dyn Problem, at: Sample<'_>, acceleration: &[f64]) -> [Vec<f64>; 2] {
    let mut values = vec![0.0; problem.switches()];
    let mut rates = values.clone();
    problem.switching(at, &mut values);
    problem.switching_rate(at, acceleration, &mut rates);
    [values, rates]
}
