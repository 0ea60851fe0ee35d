//! Which branches a motion takes from a state where switching functions are zero.

use crate::integrate::scheme::Equations;
use crate::mechanism::Branch;

/// A function that gets to zero within this part of a step was put on the other side of it by an error.
const AWAKE: f64 = 1e-3;

/// Switches whose functions the motion drives back to zero in either branch: no step leads away from there.
pub(in crate::integrate) struct Stuck(pub(in crate::integrate) Vec<usize>);

impl Equations<'_> {
    /// Makes y' that of `branch` of switch k from here on, whatever the sign of its function.
    pub(super) fn set(&mut self, k: usize, branch: Branch) {
        self.switches.hold(k, branch);
        self.problem.set_branch(k, branch);
    }

    /// Puts `switches` into `branch`, at this state.
    pub(in crate::integrate) fn set_branch(
        &mut self,
        switches: &[usize],
        branch: Branch,
        y: &[f64],
    ) {
        if switches.is_empty() {
            return;
        }
        let before = self.values(y);
        switches.iter().for_each(|k| self.set(*k, branch));
        self.follow_jumps(before, y);
    }

    /// Puts `switches` into their other branches, at this state.
    pub(in crate::integrate) fn flip(&mut self, switches: &[usize], y: &[f64]) {
        if switches.is_empty() {
            return;
        }
        let before = self.values(y);
        self.turn_over(switches);
        self.follow_jumps(before, y);
    }

    fn turn_over(&mut self, switches: &[usize]) {
        for k in switches {
            let other = match self.switches.branches[*k] {
                Branch::Negative => Branch::Positive,
                Branch::Positive => Branch::Negative,
                same => same,
            };
            self.set(*k, other);
            self.switches.levels[*k] = 0.0;
        }
    }

    /// Functions that were zero all along in the branches of others, and are no longer, go where they move from there, whichever side of
    /// zero an error of a step has put them on.
    fn wake(&mut self, before: &[f64], after: &[f64], y: &[f64]) {
        let asleep = |k: &usize| {
            let all = &self.switches;
            all.branches[*k] == Branch::Followed && all.loose[*k].is_nan() && before[*k] == 0.0
        };
        let awake: Vec<usize> = (0..after.len()).filter(asleep).collect();
        let awake: Vec<usize> = awake.into_iter().filter(|k| after[*k] != 0.0).collect();
        let (along, soon) = (self.course.along, AWAKE * self.course.h.abs());
        let back = self.moving(&awake, y, |k, _, rate| {
            along * rate * after[k] < 0.0 && after[k].abs() < soon * rate.abs()
        });
        for k in awake {
            match (after[k] > 0.0) != back.contains(&k) {
                true => self.set(k, Branch::Positive),
                false => self.set(k, Branch::Negative),
            }
        }
    }

    /// The functions at this state, in the branches held.
    pub(super) fn values(&mut self, y: &[f64]) -> Vec<f64> {
        let at = self.at(self.course.now.s, y);
        let mut values = vec![0.0; self.switches.branches.len()];
        self.problem.switching(at, &mut values);
        values
    }

    /// Branches have been set at this state, where the functions had the values `before`: those that depend on them, as a limit on a force
    /// depends on the sign of its velocity, may have jumped into their other branches, and take these. (Each once: what jumps is nested.)
    /// One that is zero all along in the branches of others, as what is left beyond a play is within it, is followed.
    fn follow_jumps(&mut self, start: Vec<f64>, y: &[f64]) {
        let mut before = start.clone();
        for _ in 0..start.len() {
            let after = self.values(y);
            let all = &self.switches;
            let jumped = |k: &usize| {
                let (from, to, sign) = (before[*k], after[*k], all.signs[*k]);
                to != from
                    && to * sign < 0.0
                    && (from * sign >= 0.0 || all.has_jumped(*k, from, to))
            };
            let jumped: Vec<usize> = (0..after.len()).filter(jumped).collect();
            if jumped.is_empty() {
                let held = |k: &usize| self.switches.branches[*k].is_side();
                // (At the start of a run they are asked about by themselves.)
                let none = |k: &usize| self.course.steps > 0 && after[*k] == 0.0 && held(k);
                let none: Vec<usize> = (0..after.len()).filter(none).collect();
                let none = self.at_rest(&none, y);
                none.iter().for_each(|k| self.set(*k, Branch::Followed));
                self.wake(&start, &after, y);
                return;
            }
            self.turn_over(&jumped);
            before = after;
        }
    }

    /// The run has got to this state: each switch that is followed takes the branch of its value, unless that is zero, and what is beyond
    /// the zero of another is from now on the zero to it.
    pub(in crate::integrate) fn settle(&mut self, y: &[f64]) {
        let at = self.at(self.course.now.s, y);
        if self.switches.is_empty() {
            return;
        }
        self.problem.switching(at, &mut self.switches.values);
        for k in 0..self.switches.values.len() {
            let all = &mut self.switches;
            let (g, branch) = (all.values[k], all.branches[k]);
            match branch {
                Branch::Followed if self.course.is_before(self.course.now.s, all.loose[k]) => {}
                Branch::Followed if g != 0.0 => {
                    all.loose[k] = f64::NAN;
                    self.set(
                        k,
                        if g > 0.0 {
                            Branch::Positive
                        } else {
                            Branch::Negative
                        },
                    );
                }
                Branch::Followed => {}
                _ if g * branch.sign() > 0.0 => all.levels[k] = 0.0,
                _ if all.is_outside(k, g) => all.levels[k] = g,
                _ => {}
            }
        }
    }

    /// Follows all switches again where the step in hand was outside of a branch; returns whether it was.
    pub(in crate::integrate) fn release(&mut self) -> bool {
        let doubt = std::mem::take(&mut self.switches.doubt);
        if doubt {
            let all: Vec<usize> = (0..self.switches.branches.len()).collect();
            all.iter().for_each(|k| self.set(*k, Branch::Followed));
        }
        doubt
    }

    /// Chooses branches at the start of a run, where coordinates and velocities are known to the sizes `floors`. A function that is zero
    /// there goes where it moves; returns these.
    pub(in crate::integrate) fn choose(
        &mut self,
        y: &[f64],
        floors: &[f64],
    ) -> Result<Vec<usize>, Stuck> {
        if self.switches.is_empty() {
            return Ok(Vec::new());
        }
        self.settle(y);
        let at = self.at(self.course.now.s, y);
        let near = self.switches.near(self.problem, at, floors);
        self.lock(&near, y);
        let branches = self.switches.branches.iter().enumerate();
        let zeros = branches.filter(|(_, branch)| **branch == Branch::Followed);
        let zeros: Vec<usize> = zeros.map(|(k, _)| k).collect();
        self.go_where_they_move(&zeros, y)?;
        Ok(zeros)
    }

    /// Puts `switches`, which are at their zeros at this state, into the branches that they move to.
    fn go_where_they_move(&mut self, switches: &[usize], y: &[f64]) -> Result<(), Stuck> {
        self.set_branch(switches, Branch::Positive, y);
        let mut down = self.driven_out(switches, y);
        let rest = self.at_rest(switches, y);
        self.set_branch(&rest, Branch::Followed, y);
        // What is at rest in its branch alone, as under a force of just the limit of friction, does not stay at its zero without it.
        let along = self.course.along;
        let up = self.moving(&rest, y, |_, _, rate| along * rate > 0.0);
        down.extend(self.moving(&rest, y, |_, _, rate| along * rate < 0.0));
        self.set_branch(&up, Branch::Positive, y);
        self.set_branch(&down, Branch::Negative, y);
        let back = self.driven_out(&down, y);
        // Driven back from both sides, it may stay between them: at rest under friction, without a force, or where a constraint leaves it
        // no way, and friction makes nothing.
        self.set_branch(&back, Branch::Followed, y);
        match self.at_rest(&back, y).len() == back.len() || self.is_smooth(&back, y) {
            true => Ok(()),
            false => Err(Stuck(back)),
        }
    }

    /// Puts `switches`, which constraints have locked up to this state but not to the end of a step of size `h` from it, into the branches
    /// that they move to.
    pub(in crate::integrate) fn unlock(&mut self, switches: &[usize], h: f64, y: &[f64]) {
        for k in switches {
            self.switches.unlocked[*k] = self.course.now.s;
        }
        if let Err(Stuck(stuck)) = self.go_where_they_move(switches, y) {
            self.follow_for_a_while(&stuck, h);
        }
    }

    /// A step has got to this state, where the switches that it went onto take their other branches, unless they are driven back; returns
    /// these.
    pub(in crate::integrate) fn arrive(&mut self, y: &[f64]) -> Result<Vec<usize>, Stuck> {
        let targets = std::mem::take(&mut self.switches.targets);
        if targets.is_empty() {
            self.settle(y);
            return Ok(targets);
        }
        let before = self.values(y);
        self.flip(&targets, y);
        self.settle(y);
        let after = self.values(y);
        // What has jumped away from its zero, with others that have turned there, is in its branch.
        let stand = |k: &usize| !self.switches.has_jumped(*k, before[*k], after[*k]);
        let stand: Vec<usize> = targets.iter().copied().filter(stand).collect();
        self.turn(&stand, y)?;
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
        self.flip(&out, y);
        self.settle(y);
        let stuck = self.driven_out(&out, y);
        match stuck.is_empty() {
            true => Ok(true),
            false => Err(Stuck(stuck)),
        }
    }

    /// The switches among these whose functions leave the branches they are in.
    fn driven_out(&mut self, switches: &[usize], y: &[f64]) -> Vec<usize> {
        let along = self.course.along;
        self.moving(switches, y, |_, branch, rate| {
            along * branch.sign() * rate < 0.0
        })
    }

    /// The switches whose functions are positive and get to zero within the step proposed from here, at the rate that they have here;
    /// none where q̈ has no value.
    pub(in crate::integrate) fn carried_across(&mut self, y: &[f64]) -> Vec<usize> {
        let (s, h) = (self.course.now.s, self.course.h);
        let at = self.at(s, y);
        let mut acceleration = vec![0.0; at.v.len()];
        if self.acceleration(s, y, &mut acceleration).is_err() {
            return Vec::new();
        }
        // Of all of them, be they located or not.
        let mut values = vec![0.0; self.course.pace.switches.len()];
        let mut rates = values.clone();
        self.problem.switching(at, &mut values);
        self.problem.switching_rate(at, &acceleration, &mut rates);
        let across = |k: &usize| values[*k] > 0.0 && values[*k] + h * rates[*k] < 0.0;
        (0..values.len()).filter(across).collect()
    }

    /// The switches among these whose functions stay as they are.
    fn at_rest(&mut self, switches: &[usize], y: &[f64]) -> Vec<usize> {
        self.moving(switches, y, |_, _, rate| rate == 0.0)
    }

    /// The switches among these for which `which` of them, their branch and the rate of their function holds at this state; none where q̈
    /// has no value.
    fn moving(
        &mut self,
        switches: &[usize],
        y: &[f64],
        which: impl Fn(usize, Branch, f64) -> bool,
    ) -> Vec<usize> {
        let s = self.course.now.s;
        let at = self.at(s, y);
        let mut acceleration = vec![0.0; at.v.len()];
        if switches.is_empty() || self.acceleration(s, y, &mut acceleration).is_err() {
            return Vec::new();
        }
        let branches = &self.switches.branches;
        let mut rates = vec![0.0; branches.len()];
        self.problem.switching_rate(at, &acceleration, &mut rates);
        let found = switches.iter().copied();
        found
            .filter(|k| which(*k, branches[*k], rates[*k]))
            .collect()
    }
}
