//! What switches ask of the driver: steps onto their zeros, and a new start in their other branches.

use super::{Driver, Refusal};
use crate::error::Error;
use crate::integrate::course::Trial;
use crate::integrate::switches::{Leaving, Seen, Stuck};
use crate::mechanism::Branch;

/// A step with less than this share of the error granted may be as long as it is for lack of any force: switches are looked at all along.
const FREE: f64 = 1e-4;

/// A step onto the zero of a switch.
pub(super) struct Goal {
    pub(super) trial: Trial,
    /// Size and error of the step that would have gone across.
    pub(super) whole: (f64, f64),
}

impl Driver<'_> {
    /// Chooses branches at the start of the run, and evaluates f there.
    pub(super) fn choose(&mut self) -> Result<(), Error> {
        let zeros = self.equations.choose(self.scheme.start());
        let zeros = zeros.map_err(|stuck| self.stuck(stuck))?;
        self.begin_at(&zeros)
    }

    /// Evaluates f where `switches` stand at zero: those are followed if f has no value there in their branches.
    fn begin_at(&mut self, switches: &[usize]) -> Result<(), Error> {
        if self.scheme.begin(&mut self.equations).is_ok() {
            return Ok(());
        }
        self.equations.set_branch(switches, Branch::Followed);
        self.begin()
    }

    /// Refuses the closed step if it leaves the branches of its start. Returns whether its interpolant had to be made for that.
    pub(super) fn stay(&mut self, trial: Trial, error: f64) -> Result<bool, Refusal> {
        let equations = &mut self.equations;
        if equations.switches.is_empty() {
            return Ok(false);
        }
        let t0 = equations.course.t0;
        let time = |theta: f64| t0 + trial.start.s + theta * trial.h;
        // A method without an estimate has no error that would tell.
        let free = error < FREE && self.scheme.error().is_some();
        let (ends, problem) = (self.scheme.states(), &mut *equations.problem);
        match (equations.switches).dips(problem, time, trial.h, ends, free) {
            _ if equations.switches.doubt => {}
            Seen::Whole => return Ok(false),
            Seen::Dips => {}
            Seen::Rough => return Err(Refusal::End(None)),
        }
        let stages = self.scheme.interpolate(equations, trial);
        stages.map_err(Refusal::End)?;
        let coefficients = self.scheme.dense();
        match equations
            .switches
            .search(equations.problem, time, coefficients)
        {
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
            Leaving::AtOnce(switches) | Leaving::AtEnd(switches) => switches,
            Leaving::Within(theta, switches) => {
                if let Some(trial) = self.equations.course.step(theta * trial.h) {
                    self.equations.switches.targets = switches;
                    self.goal = Some(Goal { trial, whole });
                    return Ok(());
                }
                switches
            }
        };
        let turned = self.equations.turn(&switches, self.scheme.start());
        if turned.map_err(|stuck| self.stuck(stuck))? {
            return self.begin_at(&switches);
        }
        // The motion goes into its branch, and leaves it before the step's first part ends.
        self.equations.course.h = self.scheme.unfit(trial.h);
        Ok(())
    }

    /// The last step is accepted: where it went onto zeros of switches, the next one begins in their other branches. Returns whether it
    /// did.
    pub(super) fn arrive(&mut self) -> Result<bool, Error> {
        let landed = !self.equations.switches.targets.is_empty();
        self.landings += usize::from(landed);
        let targets = self.equations.arrive(self.scheme.start());
        let targets = targets.map_err(|stuck| self.stuck(stuck))?;
        // Steps go across lengths, whether they go onto other switches or not.
        if self.equations.course.pace.is_slow() {
            let across = self.equations.carried_across(self.scheme.start());
            self.equations.course.pace.across(&across)?;
        }
        if landed {
            self.begin_at(&targets)?;
        }
        Ok(landed)
    }

    fn stuck(&mut self, Stuck(switches): Stuck) -> Error {
        self.equations.course.stuck(&switches)
    }
}
