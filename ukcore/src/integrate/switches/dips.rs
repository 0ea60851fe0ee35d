//! Switching functions that leave their branch and come back within a step, between all that it evaluates: a body that meets a stiff
//! stop for a moment on a long way without forces, the tip of an oscillation just beyond a bumper.

use std::convert::Infallible;

use super::Switches;
use crate::integrate::sample::Sample;
use crate::integrate::{Problem, between};
use crate::mechanism::Branch;
use crate::zero::below;

/// Part of a step over which the rates of functions are taken at its ends.
const END: f64 = 1.0 / 64.0;

/// Parts of a step at which functions are looked at, to have their rates at its ends.
const ENDS: [f64; 4] = [0.0, END, 1.0 - END, 1.0];

/// A step without forces is looked at in so many parts, and as near to its ends as that.
const LOOKS: usize = 32;
const NEAR: f64 = 1e-3;
const ALONG: [f64; LOOKS + 3] = {
    let mut along = [NEAR; LOOKS + 3];
    along[0] = 0.0;
    let mut k = 1;
    while k < LOOKS {
        along[k + 1] = k as f64 / LOOKS as f64;
        k += 1;
    }
    (along[LOOKS + 1], along[LOOKS + 2]) = (1.0 - NEAR, 1.0);
    along
};

/// Extrema between looks up to which these show where they are; a function that gets within this share of its range to zero and has more
/// is looked at in shorter steps.
const EXTREMA: usize = LOOKS / 4;
const WITHIN: f64 = 0.25;

/// The cubic through the ends of a step is off by less than this share of its range, where the step is not too long for its method.
const SHAPE: f64 = 0.1;

/// What a function goes beyond its zero counts from this share of its range within the step: less is rounding.
const DEPTH: f64 = 1e-10;

/// What dips are searched in.
#[derive(Default)]
pub(super) struct Buffers {
    state: Vec<f64>,
    values: Vec<f64>,
    /// Values of all functions, place after place.
    looks: Vec<f64>,
    /// The values of all functions at the end of the last step that was looked at, and its time.
    known: Vec<f64>,
    known_at: f64,
}

impl Buffers {
    /// Buffers for `count` functions of states of length `n`.
    pub(super) fn new(count: usize, n: usize) -> Self {
        Buffers {
            state: vec![0.0; n],
            values: vec![0.0; count],
            looks: Vec::new(),
            known: vec![0.0; count],
            known_at: f64::NAN,
        }
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

impl Switches {
    /// Whether functions are outside of their branches at the end of a step of size `h` between two states, which makes it doubtful, or may
    /// leave them within it, though they are within them at both; if it is `free` of forces, from close up. `time` is that of a part of the
    /// step.
    pub(in crate::integrate) fn dips(
        &mut self,
        problem: &mut dyn Problem,
        time: impl Fn(f64) -> f64,
        h: f64,
        [old, new]: [&[f64]; 2],
        free: bool,
    ) -> Seen {
        let mut found = std::mem::take(&mut self.dips);
        found.clear();
        let count = self.branches.len();
        let mut buffers = std::mem::take(&mut self.buffers);
        let Buffers {
            state,
            values,
            looks,
            known,
            known_at,
        } = &mut buffers;
        let mut look = |theta: f64, values: &mut [f64]| {
            if theta == 1.0 {
                state.copy_from_slice(new);
            } else {
                let n = state.len() / 2;
                let (q, v) = state.split_at_mut(n);
                between(theta, h, [old, new].map(|y| [&y[..n], &y[n..]]), [q, v]);
            }
            problem.switching(Sample::of(time(theta), state), values);
        };
        let places = if free { &ALONG[..] } else { &ENDS[..] };
        looks.resize(places.len() * count, 0.0);
        let from = time(0.0);
        for (place, values) in looks.chunks_exact_mut(count).enumerate() {
            match place {
                // The last step has ended here.
                0 if *known_at == from => values.copy_from_slice(known),
                _ => look(places[place], values),
            }
        }
        known.copy_from_slice(&looks[looks.len() - count..]);
        *known_at = time(1.0);
        let outside = |k: usize| self.inside(k, known[k]) < 0.0 && !self.targets.contains(&k);
        self.doubt |= (0..count).any(outside);
        let mut rough = self.turns_early(&looks[..count], &mut look, values);
        for k in 0..count {
            if self.branches[k] == Branch::Followed || self.targets.contains(&k) {
                continue;
            }
            let at = |place: usize| self.inside(k, looks[place * count + k]);
            let value = |theta: f64| {
                look(theta, values);
                self.inside(k, values[k])
            };
            rough |= search((places, free), at, value, &mut found);
        }
        (self.buffers, self.dips) = (buffers, found);
        match self.dips.is_empty() {
            false => Seen::Dips,
            true if rough => Seen::Rough,
            true => Seen::Whole,
        }
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
            from[k] * half[k] < 0.0 || later.abs() < 3.0 * soon.abs()
        };
        let changes = |k: usize| soon[k] * half[k] < 0.0 && early(k);
        (0..half.len()).any(|k| self.branches[k] == Branch::Followed && changes(k))
    }
}

/// Adds to those `found` the places where a function, known `at` some `places` of a step that may be without forces, gets below zero.
/// Whether it is too rough to tell.
fn search(
    (places, free): (&[f64], bool),
    at: impl Fn(usize) -> f64 + Copy,
    mut value: impl FnMut(f64) -> f64,
    found: &mut Vec<f64>,
) -> bool {
    let range = (0..places.len()).fold(0.0_f64, |most, place| most.max(at(place).abs()));
    let mut within = |a: f64, b: f64| {
        let g = |theta: f64| -> Result<f64, Infallible> { Ok(value(theta)) };
        let Ok(place) = below(g, -DEPTH * range, a, b);
        found.extend(place);
    };
    if !free {
        if may_dip([0, 1, 2, 3].map(at), range) {
            within(0.0, 1.0);
        }
        return false;
    }
    for place in 1..places.len() - 1 {
        if at(place - 1) > at(place) && at(place) <= at(place + 1) {
            within(places[place - 1], places[place + 1]);
        }
    }
    is_rough(places.len(), at, range)
}

/// Whether a function with these values along a step has more extrema than they show for certain, and may get to zero at one of them.
fn is_rough(count: usize, at: impl Fn(usize) -> f64, range: f64) -> bool {
    let (mut extrema, mut last) = (0, 0.0);
    let [mut least, mut most] = [at(0); 2];
    for place in 1..count {
        let change = at(place) - at(place - 1);
        (least, most) = (least.min(at(place)), most.max(at(place)));
        if change.abs() > DEPTH * range {
            extrema += usize::from(last * change < 0.0);
            last = change;
        }
    }
    extrema > EXTREMA && least < WITHIN * (most - least)
}

/// Whether a function with these values at the start of a step, soon after, shortly before its end and there falls first and rises last,
/// and may get to zero between.
fn may_dip([a, soon, late, b]: [f64; 4], range: f64) -> bool {
    let (falls, rises) = ((soon - a) / END, (b - late) / END);
    if falls >= 0.0 || rises <= 0.0 {
        return false;
    }
    let at = |theta: f64| {
        let [mut g, mut rate] = [[0.0]; 2];
        let ends = [[&[a][..], &[falls]], [&[b], &[rises]]];
        between(theta, 1.0, ends, [&mut g, &mut rate]);
        g[0]
    };
    let least = (1..8)
        .map(|k| at(f64::from(k) / 8.0))
        .fold(a.min(b), f64::min);
    least < SHAPE * (range - least)
}
