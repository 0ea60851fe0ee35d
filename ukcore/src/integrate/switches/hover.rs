//! Switches that come back to their zeros again and again, though nothing turns there: contacts that touch, ropes that are neither taut nor
//! slack. Where accelerations have a kink at most, the error of a step tells what becomes of it, and they are followed for a while.

use crate::integrate::course::{Place, Trial};
use crate::integrate::dense::between;
use crate::integrate::scheme::Equations;
use crate::mechanism::Branch;
use crate::scan::axpy;

/// A switch that is turned so often, each time within this part of a step from where it was before, hovers at its zero, and is followed
/// for as many steps.
const TURNS: usize = 4;
const HOVERING: f64 = 1e-3;
const FOLLOWED: f64 = 10.0;

/// Accelerations that differ by less than this share between the branches of a switch at its zero have a kink there at most; or that
/// differ by less of what they do little off it.
const KINK: f64 = 1e-6;
const LESS: f64 = 0.1;

/// Parts of a step at which it is asked whether constraints lock what they did at its start.
const ASKED: [f64; 4] = [1.0, 0.5, 0.3, 0.75];

/// Where and in which step a switch was last turned, and how often it was before without getting away from its zero.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turned {
    s: f64,
    step: usize,
    times: usize,
    /// How often that is to be to ask if it hovers.
    enough: usize,
}

impl Turned {
    /// That of a switch that was not yet.
    pub(super) const NEVER: Turned = Turned {
        s: f64::NAN,
        step: 0,
        times: 0,
        enough: TURNS,
    };
}

impl Equations<'_> {
    /// `switches` are turned at this state, within a step of size `h`: those that come back to their zeros again and again, within a small
    /// part of steps or with nothing in their other branches meanwhile, and where y' has a kink at most, are followed for a while. Returns
    /// whether there are any.
    pub(in crate::integrate) fn hover(&mut self, switches: &[usize], h: f64, y: &[f64]) -> bool {
        let (s, step) = (self.course.now.s, self.course.steps);
        let mut often = Vec::new();
        for k in switches {
            let last = self.switches.turned[*k];
            let back = s - last.s;
            let near = back.abs() <= HOVERING * h.abs();
            // (Each of several that do so is turned once in as many steps.)
            let soon = step <= last.step + 2 * self.switches.branches.len();
            let times = if near || soon && back.is_finite() {
                last.times + 1
            } else {
                0
            };
            let turned = Turned {
                s,
                step,
                times,
                ..last
            };
            self.switches.turned[*k] = match times < turned.enough {
                true => turned,
                false if near || self.made_nothing(*k, 0.5 * back, y) => {
                    often.push(*k);
                    turned
                }
                // It is asked seldom of what goes far.
                false => Turned {
                    times: 0,
                    enough: 2 * turned.enough,
                    ..turned
                },
            };
        }
        !often.is_empty() && self.loosen(&often, h, y)
    }

    /// Locks those of `switches` that constraints lock at their zeros, at this state; returns the others.
    pub(super) fn lock(&mut self, switches: &[usize], y: &[f64]) -> Vec<usize> {
        let now = self.course.now.s;
        let asked = |k: &usize| self.switches.unlocked[*k] != now;
        let asked: Vec<usize> = switches.iter().copied().filter(asked).collect();
        let at = self.at(now, y);
        let locked = self.problem.locked(&asked, at);
        locked.iter().for_each(|k| self.set(*k, Branch::Zero));
        let others = switches.iter().copied();
        others.filter(|k| !locked.contains(k)).collect()
    }

    /// The switches that are locked, but are not on the way of a step between two states, or at its end.
    pub(in crate::integrate) fn unlocked(&mut self, step: Trial, ends: [&[f64]; 2]) -> Vec<usize> {
        let all = 0..self.switches.branches.len();
        let locked = |k: &usize| self.switches.branches[*k] == Branch::Zero;
        let held: Vec<usize> = all.filter(locked).collect();
        if held.is_empty() {
            return held;
        }
        let n = ends[0].len() / 2;
        let ends = ends.map(|y| [&y[..n], &y[n..]]);
        let mut state = vec![0.0; 2 * n];
        for part in ASKED {
            let (q, v) = state.split_at_mut(n);
            between(part, step.h, ends, [q, v]);
            let at = self.at(step.start.s + part * step.h, &state);
            let locked = self.problem.locked(&held, at);
            if locked.len() < held.len() {
                return held.into_iter().filter(|k| !locked.contains(k)).collect();
            }
        }
        Vec::new()
    }

    /// Whether accelerations were the same in both branches of switch k so long before this state.
    fn made_nothing(&mut self, k: usize, back: f64, y: &[f64]) -> bool {
        let mut acceleration = vec![0.0; y.len() / 2];
        if self
            .acceleration(self.course.now.s, y, &mut acceleration)
            .is_err()
        {
            return false;
        }
        let before = on_by(-back, y, &acceleration);
        let sides = self.sides(&[k], -back, &before);
        sides.is_some_and(|sides| jump(&sides) <= KINK * size(&sides))
    }

    /// Locks `switches`, at whose zeros this state is, where constraints do, and follows the others for some steps of size `h`, if y' has a
    /// kink at most there. Returns whether it does.
    pub(in crate::integrate) fn loosen(&mut self, switches: &[usize], h: f64, y: &[f64]) -> bool {
        let others = self.lock(switches, y);
        let smooth = self.is_smooth(&others, y);
        if smooth {
            self.follow_for_a_while(&others, h);
        }
        smooth
    }

    /// Follows `switches` for some steps of size `h`.
    pub(super) fn follow_for_a_while(&mut self, switches: &[usize], h: f64) {
        let until = self.course.now.s + FOLLOWED * h;
        for k in switches {
            self.set(*k, Branch::Followed);
            self.switches.loose[*k] = until;
        }
    }

    /// Whether accelerations are the same on both sides of the zeros of `switches`, which are at this state but for an error of a step.
    pub(super) fn is_smooth(&mut self, switches: &[usize], y: &[f64]) -> bool {
        let Some(here) = self.sides(switches, 0.0, y) else {
            return false;
        };
        if jump(&here) <= KINK * size(&here) {
            return true;
        }
        // What is left of it nearer to the zeros.
        let values = self.values(y);
        let mut rates = values.clone();
        let sample = self.at(self.course.now.s, y);
        self.problem.switching_rate(sample, &here[0], &mut rates);
        let Some(late) = to_zeros(switches, &values, &rates) else {
            return false;
        };
        let there = self.sides(switches, late, &on_by(late, y, &here[0]));
        there.is_some_and(|there| jump(&there) <= LESS * jump(&here))
    }

    /// Accelerations in both branches of `switches` at a state so much later than where the run stands.
    fn sides(&mut self, switches: &[usize], by: f64, y: &[f64]) -> Option<[Vec<f64>; 2]> {
        let held = (self.switches.branches.clone(), self.switches.levels.clone());
        let now = self.course.now;
        let (s, t) = (now.s + by, now.t + by);
        self.course.now = Place { s, t };
        let mut side = |branch: Branch| {
            self.set_branch(switches, branch, y);
            let mut side = vec![0.0; y.len() / 2];
            let told = self.acceleration(s, y, &mut side).is_ok();
            (0..held.0.len()).for_each(|k| self.set(k, held.0[k]));
            self.switches.levels.clone_from(&held.1);
            told.then_some(side)
        };
        let sides = [side(Branch::Negative), side(Branch::Positive)];
        self.course.now = now;
        let [Some(negative), Some(positive)] = sides else {
            return None;
        };
        Some([negative, positive])
    }
}

/// The largest difference of two accelerations.
fn jump([a, b]: &[Vec<f64>; 2]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// The largest of two accelerations.
fn size(sides: &[Vec<f64>; 2]) -> f64 {
    sides
        .iter()
        .flatten()
        .fold(0.0, |most, a| most.max(a.abs()))
}

/// The state that a motion in `y` goes on to in a time, with these accelerations.
pub(in crate::integrate) fn on_by(time: f64, y: &[f64], acceleration: &[f64]) -> Vec<f64> {
    let n = acceleration.len();
    let mut on = y.to_vec();
    axpy(time, &y[n..], &mut on[..n]);
    axpy(time, acceleration, &mut on[n..]);
    on
}

/// The time in which the last of `switches` gets to its zero from these values at these rates; none where it does not.
pub(in crate::integrate) fn to_zeros(
    switches: &[usize],
    values: &[f64],
    rates: &[f64],
) -> Option<f64> {
    let times = switches.iter().map(|k| -values[*k] / rates[*k]);
    let last = times.max_by(|a, b| a.abs().total_cmp(&b.abs()));
    last.filter(|time| time.is_finite())
}
