//! Steps onto the zeros of switching functions.
//!
//! Where y' has a kink or a jump, at a zero of a switching function g, a step across it loses its order. So y' is held in the branches of
//! the step's start: where g passes zero within a step y' goes on smoothly, and the step has the full order of its method. If g has left
//! its branch, the step is repeated up to the first zero, found on the interpolant, and the next step begins there in the other branch.
//!
//! A branch may end at its zero, as that of max(x, 0)^1.5 does: where y' has no value beyond it, the step follows its switches, as short as
//! its error demands.
//!
//! That a function has left its branch shows at the end of a step, or, if it comes back before that, at a stage, or in what [`dips`] finds
//! on the cubic through the ends of the step; the interpolant is made only then.

use super::Problem;
use super::dense::interpolate;
use super::sample::Sample;
use crate::mechanism::Branch;
use crate::zero::locate;

mod dips;
mod hover;
mod turn;

pub(super) use dips::Seen;
pub(super) use hover::{on_by, to_zeros};
pub(super) use turn::Stuck;

/// Parts into which a step is divided in the search for sign changes.
const PARTS: usize = 8;

/// Distances from a place within a step where branches are taken, at which the step is divided more finely.
const SOON: [f64; 4] = [1e-8, 1e-6, 1e-4, 1e-2];

/// A zero nearer than this part of a step to its end is at its end.
const AT_END: f64 = 1e-13;

/// A function that was at its zero but for an error of a step has jumped away from it where it has changed by so many times as much, and by
/// more than this share of its values, which is rounding.
const JUMP: f64 = 1e3;
const ROUNDED: f64 = 1e-10;

/// A function counts as zero at a start, which may be off by so many times its rounding, for constraints to lock it.
const GIVEN: f64 = 1e6;

/// Zeros of several functions within this part of a step are one.
const TOGETHER: f64 = 1e-10;

/// How a step leaves its branches, with the switches that do first.
#[derive(Debug, PartialEq)]
pub(super) enum Leaving {
    /// The switches stand at zero at the start of the step, and go the other way.
    AtOnce(Vec<usize>),
    /// The switches leave at this part of the step.
    Within(f64, Vec<usize>),
    /// The switches leave at the end of the step, as far as rounding can tell.
    AtEnd(Vec<usize>),
    /// The constraints do not lock the switches any more.
    Unlocked(Vec<usize>),
}

/// The branches of a run.
pub(super) struct Switches {
    /// None where no switch is to be located.
    branches: Vec<Branch>,
    /// Their signs.
    signs: Vec<f64>,
    /// What counts as the zero of each function. A landing misses it by an error of integration; until the function has left, that is 0 to
    /// it.
    levels: Vec<f64>,
    values: Vec<f64>,
    /// The largest value of each function at ends of steps.
    sizes: Vec<f64>,
    /// Up to where on the way each switch is followed, whatever its value is: it hovers at its zero, where y' has a kink at most.
    loose: Vec<f64>,
    /// Where constraints have locked each switch last, and did no longer a step later.
    unlocked: Vec<f64>,
    /// When each switch was last turned.
    turned: Vec<hover::Turned>,
    /// Distances into the branches at the start of a part of a step.
    before: Vec<f64>,
    state: Vec<f64>,
    /// Parts of the step in hand at which functions may be outside of their branches, though nothing else shows it.
    dips: Vec<f64>,
    buffers: dips::Buffers,
    /// Whether an evaluation of the step in hand was outside of the branches held.
    pub(super) doubt: bool,
    /// The attempted step goes onto zeros of these.
    pub(super) targets: Vec<usize>,
}

impl Switches {
    /// Followed branches of `count` switches, and buffers for states of length `n`.
    pub(super) fn new(count: usize, n: usize) -> Self {
        Switches {
            branches: vec![Branch::Followed; count],
            signs: vec![0.0; count],
            levels: vec![0.0; count],
            values: vec![0.0; count],
            sizes: vec![0.0; count],
            loose: vec![f64::NAN; count],
            unlocked: vec![f64::NAN; count],
            turned: vec![hover::Turned::NEVER; count],
            before: vec![0.0; count],
            state: vec![0.0; n],
            dips: Vec::new(),
            buffers: dips::Buffers::new(count, n),
            doubt: false,
            targets: Vec::new(),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.branches.is_empty()
    }

    /// Whether function k has jumped away from its zero, from one value to another, for other branches.
    fn has_jumped(&self, k: usize, before: f64, after: f64) -> bool {
        (after - before).abs() > (JUMP * before.abs()).max(ROUNDED * self.sizes[k])
    }

    /// Switch k is in this branch, and functions need not be what they were where the run stands.
    fn hold(&mut self, k: usize, branch: Branch) {
        (self.branches[k], self.signs[k]) = (branch, branch.sign());
        self.buffers.forget();
    }

    /// How far switch k with the value `g` is within its branch; negative outside.
    fn inside(&self, k: usize, g: f64) -> f64 {
        self.signs[k] * (g - self.levels[k])
    }

    /// Whether switch k with the value `g` is outside of its branch.
    fn is_outside(&self, k: usize, g: f64) -> bool {
        self.inside(k, g) < 0.0
    }

    /// The functions that may be zero at a start where they have been evaluated last, as far as that is known.
    fn near(&self, problem: &mut dyn Problem, at: Sample<'_>, floors: &[f64]) -> Vec<usize> {
        let mut roundings = vec![0.0; self.values.len()];
        problem.switching_rounding(at, floors, &mut roundings);
        let near = |k: &usize| self.values[*k].abs() <= GIVEN * roundings[*k];
        (0..self.values.len()).filter(near).collect()
    }

    /// y' is to be evaluated at this state.
    #[inline]
    pub(super) fn look(&mut self, problem: &mut dyn Problem, at: Sample<'_>) {
        if self.doubt {
            return;
        }
        problem.switching(at, &mut self.values);
        // Levels are at zeros or beyond.
        let mut held = self.values.iter().zip(&self.signs);
        if held.all(|(g, sign)| sign * g >= 0.0) {
            return;
        }
        let outside = |k: usize| self.is_outside(k, self.values[k]);
        self.doubt = (0..self.values.len()).any(|k| outside(k) && !self.targets.contains(&k));
    }

    /// How a step first leaves its branches between two parts of it, if it does. `time` is that of a part of the step, `coefficients` are
    /// those of its interpolant. Switches that the step goes onto do not count. Where the first part is not the start of the step, it is
    /// there that the branches are taken.
    pub(super) fn search(
        &mut self,
        problem: &mut dyn Problem,
        time: impl Fn(f64) -> f64,
        coefficients: &[f64],
        [from, to]: [f64; 2],
    ) -> Option<Leaving> {
        let levels = self.levels.clone();
        let mut state = std::mem::take(&mut self.state);
        let mut values = std::mem::take(&mut self.values);
        let mut evaluate = |theta: f64, values: &mut [f64]| {
            interpolate(theta, coefficients, &mut state);
            problem.switching(Sample::of(time(theta), &state), values);
        };
        evaluate(from, &mut values);
        for (k, g) in values.iter().enumerate() {
            if from > 0.0 {
                let inside = g * self.signs[k] > 0.0;
                self.levels[k] = if inside { 0.0 } else { *g };
            }
            self.before[k] = self.inside(k, *g);
        }
        let mut found = None;
        let mut a = from;
        let mut parts = std::mem::take(&mut self.dips);
        parts.extend((1..PARTS).map(|part| part as f64 / PARTS as f64));
        parts.push(to);
        if from > 0.0 {
            parts.extend(SOON.map(|part| from + part * (to - from)));
        }
        parts.retain(|part| *part > from && *part <= to);
        parts.sort_by(f64::total_cmp);
        for b in parts {
            evaluate(b, &mut values);
            let mut at_once = Vec::new();
            let mut zeros: Vec<(f64, usize)> = Vec::new();
            for k in 0..self.branches.len() {
                let (before, after) = (self.before[k], self.inside(k, values[k]));
                self.before[k] = after;
                if !self.is_outside(k, values[k]) || self.targets.contains(&k) {
                    continue;
                }
                if before <= 0.0 {
                    // It is zero just where this part begins.
                    match a == from {
                        true => at_once.push(k),
                        false => zeros.push((a, k)),
                    }
                    continue;
                }
                let outside = |theta: f64| -> Result<f64, std::convert::Infallible> {
                    let mut values = vec![0.0; values.len()];
                    evaluate(theta, &mut values);
                    Ok(-self.inside(k, values[k]))
                };
                let Ok(zero) = locate(outside, a, b);
                zeros.push((zero, k));
            }
            let first = zeros
                .iter()
                .fold(f64::INFINITY, |s, (zero, _)| s.min(*zero));
            if !at_once.is_empty() {
                found = Some(Leaving::AtOnce(at_once));
                break;
            }
            if first.is_finite() {
                let together = zeros.iter().filter(|(zero, _)| zero - first <= TOGETHER);
                let switches = together.map(|(_, k)| *k).collect();
                found = Some(match first < to - AT_END {
                    true => Leaving::Within(first, switches),
                    false => Leaving::AtEnd(switches),
                });
                break;
            }
            a = b;
        }
        (self.state, self.values, self.levels) = (state, values, levels);
        found
    }
}
