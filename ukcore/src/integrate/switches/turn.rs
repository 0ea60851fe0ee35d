//! Which branches a motion takes from a state where switching functions are zero.

use super::Switches;
use crate::integrate::Problem;
use crate::integrate::scheme::Equations;
use crate::mechanism::Branch;

/// Switches whose functions the motion drives back to zero in either branch: no step leads away from there.
pub(in crate::integrate) struct Stuck(pub(in crate::integrate) Vec<usize>);

impl<'p> Equations<'p> {
    /// The switches, with the problem that is told of their branches.
    fn parts(&mut self) -> (&mut Switches, &mut (dyn Problem + 'p)) {
        (&mut self.switches, &mut *self.problem)
    }

    /// Puts `switches` into `branch`.
    pub(in crate::integrate) fn set_branch(&mut self, switches: &[usize], branch: Branch) {
        let (all, problem) = self.parts();
        switches.iter().for_each(|k| all.set(problem, *k, branch));
    }

    /// Follows all switches again where the step in hand was outside of a branch; returns whether it was.
    pub(in crate::integrate) fn release(&mut self) -> bool {
        let doubt = std::mem::take(&mut self.switches.doubt);
        if doubt {
            let all: Vec<usize> = (0..self.switches.branches.len()).collect();
            self.set_branch(&all, Branch::Followed);
        }
        doubt
    }

    /// Chooses branches at the start of a run. A function that is zero there goes where it moves; returns these.
    pub(in crate::integrate) fn choose(&mut self, y: &[f64]) -> Result<Vec<usize>, Stuck> {
        let at = self.at(self.course.now.s, y);
        let (all, problem) = self.parts();
        let zeros = all.start(problem, at);
        self.set_branch(&zeros, Branch::Positive);
        let down = self.driven_out(&zeros, y);
        let rest = self.at_rest(&zeros, y);
        self.set_branch(&rest, Branch::Followed);
        self.set_branch(&down, Branch::Negative);
        let back = self.driven_out(&down, y);
        // Driven back from both sides, it may stay between them: at rest under friction, without a force.
        self.set_branch(&back, Branch::Followed);
        match self.at_rest(&back, y).len() == back.len() {
            true => Ok(zeros),
            false => Err(Stuck(back)),
        }
    }

    /// A step has got to this state, where the switches that it went onto take their other branches, unless they are driven back; returns
    /// these.
    pub(in crate::integrate) fn arrive(&mut self, y: &[f64]) -> Result<Vec<usize>, Stuck> {
        let at = self.at(self.course.now.s, y);
        let (all, problem) = self.parts();
        let targets = std::mem::take(&mut all.targets);
        targets.iter().for_each(|k| all.flip(problem, *k));
        all.arrive(problem, at);
        if !targets.is_empty() {
            self.turn(&targets, y)?;
        }
        Ok(targets)
    }

    /// Puts those of `switches`, which stand at zero, into their other branches whose functions leave the ones they are in. Returns
    /// whether there are any.
    pub(in crate::integrate) fn turn(
        &mut self,
        switches: &[usize],
        y: &[f64],
    ) -> Result<bool, Stuck> {
        let out = self.driven_out(switches, y);
        if out.is_empty() {
            return Ok(false);
        }
        let at = self.at(self.course.now.s, y);
        let (all, problem) = self.parts();
        out.iter().for_each(|k| all.flip(problem, *k));
        all.arrive(problem, at);
        let stuck = self.driven_out(&out, y);
        match stuck.is_empty() {
            true => Ok(true),
            false => Err(Stuck(stuck)),
        }
    }

    /// Those of `switches` whose functions leave the branches they are in.
    fn driven_out(&mut self, switches: &[usize], y: &[f64]) -> Vec<usize> {
        let along = self.course.along;
        let out = |branch: Branch, rate: f64| along * branch.sign() * rate < 0.0;
        self.moving(switches, y, out)
    }

    /// Those of `switches` whose functions stay as they are.
    fn at_rest(&mut self, switches: &[usize], y: &[f64]) -> Vec<usize> {
        self.moving(switches, y, |_, rate| rate == 0.0)
    }

    /// Those of `switches` for which `which` of their branch and the rate of their function holds at this state; none where q̈ has no
    /// value.
    fn moving(
        &mut self,
        switches: &[usize],
        y: &[f64],
        which: impl Fn(Branch, f64) -> bool,
    ) -> Vec<usize> {
        let s = self.course.now.s;
        let at = self.at(s, y);
        let mut acceleration = vec![0.0; at.v.len()];
        if switches.is_empty() || self.acceleration(s, y, &mut acceleration).is_err() {
            return Vec::new();
        }
        let (all, problem) = self.parts();
        let mut rates = vec![0.0; all.branches.len()];
        problem.switching_rate(at, &acceleration, &mut rates);
        let found = switches.iter().copied();
        found
            .filter(|k| which(all.branches[*k], rates[*k]))
            .collect()
    }
}
