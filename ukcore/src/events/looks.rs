//! Where events are looked at along a step, until that tells how they go.

use super::{Event, States, evaluate, values};
use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::rounding::beside;
use crate::zero::below;

/// Part of a step after which events are looked at first: a run that goes on from an event may begin a rounding behind its zero. So much
/// sooner, again and again, where a function has less than a share of what it has then at the start.
const SOON: f64 = 1e-3;
const NEARER: f64 = 0.5;
const SOONEST: f64 = 1e-16;

/// What is no more than so many times what an error of ε in the state makes of it is rounding.
const ROUNDING: f64 = 8.0;

/// The parts of a step at which events are looked at then, so unevenly that no turns come out even at all of them.
const LOOKS: [f64; 8] = [0.11, 0.27, 0.36, 0.52, 0.61, 0.77, 0.88, 1.0];

/// A value that differs from what those beside it say by more than this share of their range is of a function that changes too often to
/// tell; there are to be more then, with others between at this part of the way.
const ROUGH: f64 = 0.1;
const BETWEEN: f64 = 0.45;

/// What differs by less than this share of itself does not change.
const CHANGE: f64 = 1e-10;

/// Looks at a step at most, none nearer than this share of it.
const MOST: usize = 4096;
const NEAREST: f64 = 1e-5;

/// Values of all events at a time.
type Look = (f64, Vec<f64>);

/// Looks at all events along a step in the order in which the run passes them, its start first; up to where a terminal one has changed its
/// sign.
#[derive(Clone)]
pub(super) struct Looks {
    pub(super) all: Vec<Look>,
    ends: [f64; 2],
}

impl Looks {
    /// Few, along a step at whose start events have the values `before`.
    pub(super) fn new(
        events: &mut [Event],
        before: &[f64],
        [t_old, t]: [f64; 2],
        states: &mut impl States,
        state: &mut [f64],
    ) -> Result<Self, Error> {
        let at = |part: f64| match part {
            1.0 => t,
            part => t_old + (t - t_old) * part,
        };
        let mut first = look(events, at(SOON), states, state)?;
        let mut soon = Vec::new();
        let mut part = SOON * SOON;
        while part >= SOONEST && is_nearer(before, &first.1) {
            let next = beginning(events, [t_old, at(part)], states, state)?;
            let known = roundings(events, &next, state)?;
            let mut pairs = next.1.iter().zip(known);
            if pairs.any(|(value, known)| value.abs() <= ROUNDING * known) {
                break;
            }
            soon.push(std::mem::replace(&mut first, next));
            part *= SOON;
        }
        soon.push(first);
        let mut looks = Looks {
            all: vec![(t_old, before.to_vec())],
            ends: [t_old, t],
        };
        while let Some(next) = soon.pop() {
            if looks.ends_with(events, next) {
                return Ok(looks);
            }
        }
        for part in LOOKS {
            let next = look(events, at(part), states, state)?;
            if looks.ends_with(events, next) {
                break;
            }
        }
        Ok(looks)
    }

    /// Adds one at the end. Whether a terminal event has changed its sign there.
    fn ends_with(&mut self, events: &[Event], next: Look) -> bool {
        let ended = self.all.last().is_some_and(|(_, last)| {
            let mut pairs = last.iter().zip(&next.1).zip(events);
            pairs.any(|((a, b), event)| event.terminal && event.crosses(*a, *b).is_some())
        });
        self.all.push(next);
        ended
    }

    /// Adds looks until they tell how the events go. Whether they do.
    pub(super) fn refine(
        &mut self,
        events: &mut [Event],
        states: &mut impl States,
        state: &mut [f64],
    ) -> Result<bool, Error> {
        let least = NEAREST * (self.ends[1] - self.ends[0]).abs();
        let mut known = None;
        loop {
            let mut rough = vec![false; self.all.len()];
            for (k, five) in self.all.windows(5).enumerate() {
                if !(0..events.len()).any(|i| is_rough(five, i, 0.0)) {
                    continue;
                }
                let known = match &mut known {
                    Some(known) => known,
                    None => {
                        let here = look(events, five[2].0, states, state)?;
                        known.insert(roundings(events, &here, state)?)
                    }
                };
                if (0..events.len()).any(|i| is_rough(five, i, known[i])) {
                    rough[k + 1..k + 5].fill(true);
                }
            }
            let mut more = Vec::new();
            for (k, pair) in self.all.windows(2).enumerate() {
                let way = pair[1].0 - pair[0].0;
                if rough[k + 1] && way.abs() > least {
                    more.push(pair[0].0 + BETWEEN * way);
                }
            }
            if more.is_empty() {
                return Ok(true);
            }
            if self.all.len() + more.len() > MOST {
                return Ok(false);
            }
            self.add(more, events, states, state)?;
        }
    }

    /// Adds a look where an event that is nearest to zero between others has changed its sign there.
    pub(super) fn find_dips(
        &mut self,
        events: &mut [Event],
        states: &mut impl States,
        state: &mut [f64],
    ) -> Result<(), Error> {
        let mut more = Vec::new();
        for window in self.all.windows(3) {
            let [(a, first), (_, middle), (b, last)] = window else {
                continue;
            };
            for i in 0..events.len() {
                let sign = middle[i].signum();
                let [first, middle, last] = [first, middle, last].map(|values| sign * values[i]);
                if !(middle > 0.0 && first > middle && last >= middle) {
                    continue;
                }
                let g = |t: f64| {
                    states.state(t, state);
                    Ok(sign * evaluate(&mut events[i], Sample::of(t, state))?)
                };
                more.extend(below(g, 0.0, *a, *b)?);
            }
        }
        self.add(more, events, states, state)
    }

    fn add(
        &mut self,
        times: Vec<f64>,
        events: &mut [Event],
        states: &mut impl States,
        state: &mut [f64],
    ) -> Result<(), Error> {
        for t in times {
            self.all.push(look(events, t, states, state)?);
        }
        let start = self.ends[0];
        let way = |look: &Look| (look.0 - start).abs();
        self.all.sort_by(|a, b| way(a).total_cmp(&way(b)));
        Ok(())
    }
}

fn look(
    events: &mut [Event],
    t: f64,
    states: &mut impl States,
    state: &mut [f64],
) -> Result<Look, Error> {
    states.state(t, state);
    Ok((t, values(events, Sample::of(t, state))?))
}

/// Whether an event is so much nearer to zero `before` that it may have been there between.
fn is_nearer(before: &[f64], values: &[f64]) -> bool {
    let mut pairs = before.iter().zip(values);
    pairs.any(|(a, b)| a.abs() < NEARER * b.abs())
}

/// A look next to the start of a step, where coordinates go by their velocities alone: what an interpolant makes of them is off by more
/// than that.
fn beginning(
    events: &mut [Event],
    [t_old, t]: [f64; 2],
    states: &mut impl States,
    state: &mut [f64],
) -> Result<Look, Error> {
    let mut old = state.to_vec();
    states.state(t_old, &mut old);
    states.state(t, state);
    let (q, v) = state.split_at_mut(old.len() / 2);
    let (old_q, old_v) = old.split_at(old.len() / 2);
    for (i, q) in q.iter_mut().enumerate() {
        *q = old_q[i] + 0.5 * (t - t_old) * (old_v[i] + v[i]);
    }
    Ok((t, values(events, Sample::of(t, state))?))
}

/// What errors of ε in the time and the state make of each event, beside a look at it.
fn roundings(events: &mut [Event], (t, here): &Look, state: &[f64]) -> Result<Vec<f64>, Error> {
    let mut most = vec![0.0_f64; events.len()];
    for (k, moved) in beside(state).enumerate() {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let t = t + sign * f64::EPSILON * t;
        let there = values(events, Sample::of(t, &moved))?;
        let pairs = most.iter_mut().zip(there.iter().zip(here));
        pairs.for_each(|(most, (there, here))| *most = most.max((there - here).abs()));
    }
    Ok(most)
}

/// Whether the third of five looks at event `i`, known to this, is off the cubic through the others.
fn is_rough(five: &[Look], i: usize, known: f64) -> bool {
    let others = [0, 1, 3, 4];
    let middle = five[2].0;
    let mut value = 0.0;
    for k in others {
        let parts = others.into_iter().filter(|l| *l != k);
        let share = parts.map(|l| (middle - five[l].0) / (five[k].0 - five[l].0));
        value += five[k].1[i] * share.product::<f64>();
    }
    let values = five.iter().map(|(_, values)| values[i]);
    let most = values.clone().fold(f64::NEG_INFINITY, f64::max);
    let least = values.fold(f64::INFINITY, f64::min);
    let size = most.abs().max(least.abs());
    let changes = most - least > (CHANGE * size).max(ROUNDING * known);
    changes && (five[2].1[i] - value).abs() > ROUGH * (most - least)
}
