//! Where switching functions first leave their branches within a step, whatever shows of it at what the step evaluates: a body that meets a
//! stiff stop for a moment on a long way without forces, the tip of an oscillation just beyond a bumper, pulses of a force much shorter
//! than its steps.
//!
//! The state is taken to move along the cubic through the ends of the step. Between two places on it a function stays on its side of zero
//! where the interval of its values does, or where it does at both and its derivative has one sign; else the way between them is halved
//! (Moore 1966, Interval Analysis; Snyder 1992, Interval analysis for computer graphics).

use std::convert::Infallible;

use super::Switches;
use crate::integrate::sample::Sample;
use crate::integrate::{Problem, between};
use crate::interval::{Along, Interval};
use crate::mechanism::Branch;
use crate::scalar::{Dual, Scalar};
use crate::zero::below;

/// Part of a step up to which what is followed leaves its zero.
const NEAR: f64 = 1e-3;

/// What a function goes beyond its zero counts from this share of its values at the ends of the step: less is rounding.
const DEPTH: f64 = 1e-10;

/// Part of a step that is not halved: a function all but touches its zero there, or has no value.
const LEAST: f64 = 1e-9;

/// Parts of a step in which the bounds of a function are sought. They are wide of one whose terms all but cancel along the motion: where
/// they do not tell in so many, it is looked at in places in the next steps, each time in twice as many as before.
const PARTS: usize = 256;
const MOST_SKIPPED: usize = 255;

/// Places at which a function is looked at where its bounds do not tell, and the extrema between them up to which they show where these
/// are; a function that gets within this share of its range to zero and has more is looked at in shorter steps.
const LOOKS: usize = 32;
/// (At unequal distances, as what changes evenly shows nothing at equal ones.)
const LOOKED_AT: [f64; LOOKS + 1] = {
    let mut places = [1.0; LOOKS + 1];
    let mut place = 0;
    while place < LOOKS {
        let golden = 0.618_033_988_749_895 * place as f64;
        places[place] = (place as f64 + 0.8 * (golden - golden as usize as f64)) / LOOKS as f64;
        place += 1;
    }
    places
};
const EXTREMA: usize = LOOKS / 4;
const WITHIN: f64 = 0.25;

/// What dips are searched in.
#[derive(Default)]
pub(super) struct Buffers {
    state: Vec<f64>,
    values: Vec<f64>,
    /// The values of all functions at the start of the step.
    from: Vec<f64>,
    /// The values of all functions at the end of the last step that was looked at, and its time.
    known: Vec<f64>,
    known_at: f64,
    /// Time and state along a part of the step, and the functions there.
    along: Vec<Along>,
    within: Vec<Along>,
    /// The functions of which bounds along the whole step do not tell.
    open: Vec<usize>,
    /// In how many steps the bounds of each function are not sought any more, and in how many they were not when they had not told last.
    skipped: Vec<[usize; 2]>,
}

impl Buffers {
    /// Buffers for `count` functions of states of length `n`.
    pub(super) fn new(count: usize, n: usize) -> Self {
        let nothing = Along::from_f64(0.0);
        Buffers {
            state: vec![0.0; n],
            values: vec![0.0; count],
            from: vec![0.0; count],
            known: vec![0.0; count],
            known_at: f64::NAN,
            along: vec![nothing; n],
            within: vec![nothing; count],
            open: Vec::with_capacity(count),
            skipped: vec![[0; 2]; count],
        }
    }

    /// The bounds of function k were `wide`, or not.
    fn skip(&mut self, k: usize, wide: bool) {
        let longer = (2 * self.skipped[k][1] + 1).min(MOST_SKIPPED);
        self.skipped[k] = [if wide { longer } else { 0 }; 2];
    }

    /// What was looked at last is no longer known.
    pub(super) fn forget(&mut self) {
        self.known_at = f64::NAN;
    }
}

/// What is seen of functions within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::integrate) enum Seen {
    /// The functions stay in their branches.
    Whole,
    /// There are places where the functions may be outside of their branches.
    Dips,
    /// The functions change too often to tell.
    Rough,
}

/// What is seen of one function.
enum Sight {
    /// It stays in its branch.
    Stays,
    /// It leaves it once before this part of the step, where it is outside.
    Leaves(f64),
    /// It changes too often to tell.
    Rough,
}

impl Sight {
    /// That of a function that is first outside at a place, or nowhere, where that is infinite.
    fn of(place: f64) -> Self {
        match place.is_finite() {
            true => Sight::Leaves(place),
            false => Sight::Stays,
        }
    }
}

/// The way of a step: its size, its time by the part of it, and the states at its ends.
struct Way<'a, T> {
    h: f64,
    time: T,
    ends: [[&'a [f64]; 2]; 2],
}

impl<T: Fn(f64) -> f64> Way<'_, T> {
    /// The functions of `problem` at a place.
    fn look(&self, problem: &mut dyn Problem, place: f64, state: &mut [f64], values: &mut [f64]) {
        let n = state.len() / 2;
        let (q, v) = state.split_at_mut(n);
        between(place, self.h, self.ends, [q, v]);
        problem.switching(Sample::of((self.time)(place), state), values);
    }

    /// The functions of `problem` between two places, and their derivatives by the place.
    fn look_along(
        &self,
        problem: &mut dyn Problem,
        [a, b]: [f64; 2],
        state: &mut [Along],
        values: &mut [Along],
    ) {
        let (h, [[q0, v0], [q1, v1]]) = (self.h, self.ends);
        let (q, v) = state.split_at_mut(q0.len());
        for i in 0..q0.len() {
            // The derivative of q by the place, in the form of Bernstein: between two places it lies among its values there and a third.
            let change = q1[i] - q0[i];
            let [d0, d1, d2] = [v0[i] * h, 3.0 * change - (v0[i] + v1[i]) * h, v1[i] * h];
            let third = |a: f64, b: f64| {
                d0 * (1.0 - a) * (1.0 - b) + d1 * (a * (1.0 - b) + b * (1.0 - a)) + d2 * a * b
            };
            let rates = [third(a, a), third(a, b), third(b, b)];
            let bend = |at: f64| 2.0 * ((d1 - d0) * (1.0 - at) + (d2 - d1) * at);
            let place = |at: f64| {
                let rest = 1.0 - at;
                q0[i] + at * change + at * rest * ((d0 - change) * rest + (change - d2) * at)
            };
            let (from, to) = (place(a), place(b));
            let part = (b - a) / 3.0;
            let values = [from, from + part * rates[0], to - part * rates[2], to];
            q[i] = Dual::new(Interval::over(values), Interval::over(rates));
            let over_h = |[low, high]: [f64; 2]| Interval::over([low / h, high / h]);
            v[i] = Dual::new(over_h(q[i].eps.ends()), over_h([bend(a), bend(b)]));
        }
        let times = Interval::over([a, b].map(|place| (self.time)(place)));
        problem.switching_along(Dual::new(times, Interval::exact(h)), q, v, values);
    }
}

impl Switches {
    /// Whether functions are outside of their branches at the end of a step of size `h` between two states, which makes it doubtful, or may
    /// leave them within it, though they are within them at both. `time` is that of a part of the step.
    pub(in crate::integrate) fn dips(
        &mut self,
        problem: &mut dyn Problem,
        time: impl Fn(f64) -> f64,
        h: f64,
        ends: [&[f64]; 2],
    ) -> Seen {
        self.dips.clear();
        let mut buffers = std::mem::take(&mut self.buffers);
        let n = ends[0].len() / 2;
        let way = Way {
            h,
            ends: ends.map(|y| [&y[..n], &y[n..]]),
            time,
        };
        let (from, to) = ((way.time)(0.0), (way.time)(1.0));
        match buffers.known_at == from {
            // The last step has ended here.
            true => buffers.from.copy_from_slice(&buffers.known),
            false => problem.switching(Sample::of(from, ends[0]), &mut buffers.from),
        }
        problem.switching(Sample::of(to, ends[1]), &mut buffers.known);
        buffers.known_at = to;
        for (size, value) in self.sizes.iter_mut().zip(&buffers.known) {
            *size = size.max(value.abs());
        }
        let held = |k: &usize| self.branches[*k].is_side() && !self.targets.contains(k);
        let mut open = std::mem::take(&mut buffers.open);
        open.extend((0..self.branches.len()).filter(held));
        let outside = |k: &usize| self.is_outside(*k, buffers.known[*k]);
        self.doubt |= open.iter().any(outside);
        let mut look = |place: f64, values: &mut [f64]| {
            way.look(problem, place, &mut buffers.state, values);
        };
        let mut rough = self.turns_early(&buffers.from, &mut look, &mut buffers.values);
        if !open.is_empty() {
            let (along, within) = (&mut buffers.along, &mut buffers.within);
            way.look_along(problem, [0.0, 1.0], along, within);
            open.retain(|k| {
                if buffers.skipped[*k][0] > 0 {
                    return true;
                }
                let ends = self.ends(*k, &buffers);
                self.leaves(*k, buffers.within[*k], ends[1], self.beyond(*k, ends)) != Some(false)
            });
        }
        for k in open.drain(..) {
            match self.sight(k, &way, problem, &mut buffers) {
                Sight::Stays => {}
                Sight::Leaves(place) => self.dips.push(place),
                Sight::Rough => rough = true,
            }
        }
        buffers.open = open;
        self.buffers = buffers;
        match self.dips.is_empty() {
            false => Seen::Dips,
            true if rough => Seen::Rough,
            true => Seen::Whole,
        }
    }

    /// From where function k, which is within its branch by these at the ends of the step, counts as outside within it.
    fn beyond(&self, k: usize, ends: [f64; 2]) -> f64 {
        let rounding = f64::EPSILON * self.sizes[k];
        -(DEPTH * ends[0].abs().max(ends[1].abs())).max(rounding)
    }

    /// How far function k is within its branch at the ends of the step.
    fn ends(&self, k: usize, buffers: &Buffers) -> [f64; 2] {
        [&buffers.from, &buffers.known].map(|values| self.inside(k, values[k]))
    }

    /// Whether function k leaves its branch on a part of a step, if that is told by the bounds of it and its derivative there and by how
    /// far it is within its branch at the end of it; it is outside from `beyond` on.
    fn leaves(&self, k: usize, within: Along, end: f64, beyond: f64) -> Option<bool> {
        let sides = within.re.ends().map(|g| self.inside(k, g));
        let [falls, rises] = within.eps.ends();
        // Where it jumps, as an angle does, it has no bounds.
        let one_way = (falls >= 0.0 || rises <= 0.0) && sides.iter().all(|side| side.is_finite());
        match end < beyond {
            true => one_way.then_some(true),
            false => (one_way || sides[0].min(sides[1]) >= beyond).then_some(false),
        }
    }

    /// What is seen of function k on a way: parts of it, the longest first, are halved until all are told up to where it first leaves.
    fn sight<T: Fn(f64) -> f64>(
        &self,
        k: usize,
        way: &Way<'_, T>,
        problem: &mut dyn Problem,
        buffers: &mut Buffers,
    ) -> Sight {
        if buffers.skipped[k][0] > 0 {
            buffers.skipped[k][0] -= 1;
            return self.sampled(k, way, problem, buffers, f64::INFINITY);
        }
        let ends = self.ends(k, buffers);
        let least = self.beyond(k, ends);
        let mut outside = if ends[1] < least { 1.0 } else { f64::INFINITY };
        let mut parts: Vec<([f64; 2], [f64; 2])> = vec![([0.0, 1.0], ends)];
        for _ in 0..PARTS {
            let long = |i: &usize| parts[*i].0[1] - parts[*i].0[0];
            let longest = (0..parts.len()).max_by(|i, j| long(i).total_cmp(&long(j)));
            let Some(longest) = longest else {
                buffers.skip(k, false);
                return Sight::of(outside);
            };
            let ([a, b], [at_a, at_b]) = parts.swap_remove(longest);
            let (along, within) = (&mut buffers.along, &mut buffers.within);
            way.look_along(problem, [a, b], along, within);
            let within = within[k];
            if self.leaves(k, within, at_b, least).is_some() || b - a < LEAST {
                continue;
            }
            let middle = 0.5 * (a + b);
            way.look(problem, middle, &mut buffers.state, &mut buffers.values);
            let value = self.inside(k, buffers.values[k]);
            if value < least {
                // Behind it nothing matters any more.
                outside = middle;
                parts.retain(|([from, _], _)| *from < middle);
                parts.push(([a, middle], [at_a, value]));
                continue;
            }
            // It is nowhere farther from its middle than its derivative lets it.
            let [falls, rises] = within.eps.ends().map(f64::abs);
            if at_b >= least && value - 0.5 * (b - a) * falls.max(rises) >= least {
                continue;
            }
            parts.push(([a, middle], [at_a, value]));
            parts.push(([middle, b], [value, at_b]));
        }
        buffers.skip(k, true);
        self.sampled(k, way, problem, buffers, outside)
    }

    /// What some places show of function k, which is known to be `outside` at one, if that is finite.
    fn sampled<T: Fn(f64) -> f64>(
        &self,
        k: usize,
        way: &Way<'_, T>,
        problem: &mut dyn Problem,
        buffers: &mut Buffers,
        outside: f64,
    ) -> Sight {
        let [from, to] = self.ends(k, buffers);
        let mut values = [from; LOOKS + 1];
        values[LOOKS] = to;
        for place in 1..LOOKS {
            way.look(
                problem,
                LOOKED_AT[place],
                &mut buffers.state,
                &mut buffers.values,
            );
            values[place] = self.inside(k, buffers.values[k]);
        }
        let least = self.beyond(k, [from, to]);
        if is_rough(&values, -least) {
            return Sight::Rough;
        }
        let first = values.iter().position(|value| *value < least);
        let mut outside = first.map_or(outside, |place| outside.min(LOOKED_AT[place]));
        for place in 1..LOOKS {
            let [before, here, after] = [place - 1, place, place + 1].map(|place| values[place]);
            if before > here && here <= after && LOOKED_AT[place - 1] < outside {
                let value = |theta: f64| -> Result<f64, Infallible> {
                    way.look(problem, theta, &mut buffers.state, &mut buffers.values);
                    Ok(self.inside(k, buffers.values[k]))
                };
                let Ok(dip) = below(value, least, LOOKED_AT[place - 1], LOOKED_AT[place + 1]);
                outside = dip.map_or(outside, |dip| outside.min(dip));
            }
        }
        Sight::of(outside)
    }

    /// Whether what is followed, and has values `from` at the start of a step, changes its sign in the first half of it, as `look` has it.
    /// It does so once, and not long before the end: else there is more to it than the estimate of the error, made at some places, can
    /// tell. What leaves its zero at no rate, by a high power as a contact makes it, changes its sign on the cubic alone.
    fn turns_early(
        &self,
        from: &[f64],
        mut look: impl FnMut(f64, &mut [f64]),
        values: &mut [f64],
    ) -> bool {
        if !self.branches.contains(&Branch::Followed) {
            return false;
        }
        let [soon, later, half] = [NEAR, 2.0 * NEAR, 0.5].map(|place| {
            look(place, values);
            values.to_vec()
        });
        let early = |k: usize| {
            let [soon, later] = [&soon, &later].map(|values| values[k] - from[k]);
            from[k] * half[k] < 0.0 || later / soon < 3.0
        };
        let followed = |k: usize| self.branches[k] == Branch::Followed && self.loose[k].is_nan();
        let changes = |k: usize| soon[k] * half[k] < 0.0 && early(k);
        (0..half.len()).any(|k| followed(k) && changes(k))
    }
}

/// Whether a function with these values along a step has more extrema than they show for certain, and may get to zero at one of them;
/// `least` is rounding.
fn is_rough(values: &[f64], least: f64) -> bool {
    let (mut extrema, mut last) = (0, 0.0);
    let [mut lowest, mut highest] = [values[0]; 2];
    for pair in values.windows(2) {
        let change = pair[1] - pair[0];
        (lowest, highest) = (lowest.min(pair[1]), highest.max(pair[1]));
        if change.abs() > least {
            extrema += usize::from(last * change < 0.0);
            last = change;
        }
    }
    extrema > EXTREMA && lowest < WITHIN * (highest - lowest)
}
