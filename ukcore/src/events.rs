//! Events: zeros of functions of the state, located while integrating.

use std::fmt;

use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::zero::{below, locate};

/// Part of a step after which events are looked at first: a run that goes on from an event may begin a rounding behind its zero. So much
/// sooner, again and again, where a function has less than a share of what it has then at the start.
const SOON: f64 = 1e-3;
const NEARER: f64 = 0.5;
const SOONEST: f64 = 1e-16;

/// What is no more than so many times what an error of ε in the state makes of it is rounding.
const ROUNDING: f64 = 8.0;

/// Where they are looked at then, so unevenly that no turns come out even at all of them.
const LOOKS: [f64; 8] = [0.11, 0.27, 0.36, 0.52, 0.61, 0.77, 0.88, 1.0];

/// A value that differs from what those beside it say by more than this share of their range is of a function that changes too often to
/// tell; there are to be more then, with others between at this part of the way.
const ROUGH: f64 = 0.1;
const BETWEEN: f64 = 0.45;

/// What differs by less than this share of itself does not change.
const CHANGE: f64 = 1e-10;

/// Looks at a step at most, none nearer than this share of it. Where so many do not tell, shorter steps may, until so many of them
/// do not either: then it is noise, and so many steps go by before more looks are tried again, the next time twice as many.
const MOST: usize = 4096;
const NEAREST: f64 = 1e-5;
const PATIENCE: usize = 8;
const REST: usize = 64;

/// Which sign changes count. Signs are compared in the order in which the run passes them, also when it runs backward.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Direction {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both.
    #[default]
    Both,
}

type Function = Box<dyn FnMut(f64, &[f64], &[f64]) -> f64>;

/// A function g(t, q, q̇) whose zeros are to be located.
///
/// A zero counts where g changes its sign, or arrives at exactly 0; a g that starts at exactly 0 is not an event. Its time is
/// located to rounding on the interpolant of the step, at projected states.
/// Where g is not a number, the run fails with an error that says so.
///
/// Signs are compared soon after the start of a step, at some eight places along it, at more where these do not tell how g goes, as along a
/// long step while a wheel turns many times, and where g is nearest to zero between them; a step on which four thousand do not tell is made
/// shorter. Two zeros of g can be missed where it changes for less than an eighth of a step and is smooth beside that;
/// [`max_step`](crate::Simulation::max_step) makes the search finer.
///
/// ```
/// use ukcore::simulate::{Direction, Event};
/// let bottom = Event::new("bottom", |_t, q, _v| q[0]).direction(Direction::Rising);
/// let floor = Event::new("floor", |_t, q, _v| q[1]).direction(Direction::Falling).terminal();
/// # let _ = (bottom, floor);
/// ```
pub struct Event {
    pub(crate) name: String,
    pub(crate) function: Function,
    pub(crate) direction: Direction,
    pub(crate) terminal: bool,
}

impl Event {
    /// An event called `name` where `function` of (t, q, q̇) crosses zero, in either direction.
    pub fn new(
        name: impl Into<String>,
        function: impl FnMut(f64, &[f64], &[f64]) -> f64 + 'static,
    ) -> Self {
        Event {
            name: name.into(),
            function: Box::new(function),
            direction: Direction::Both,
            terminal: false,
        }
    }

    /// Counts crossings in this direction only.
    #[must_use]
    pub fn direction(mut self, direction: Direction) -> Self {
        self.direction = direction;
        self
    }

    /// The direction in which a zero is crossed from one value to the next, if it counts.
    fn crosses(&self, before: f64, after: f64) -> Option<Direction> {
        let direction = match before {
            g if g < 0.0 && after >= 0.0 => Direction::Rising,
            g if g > 0.0 && after <= 0.0 => Direction::Falling,
            _ => return None,
        };
        let wanted = self.direction == Direction::Both || self.direction == direction;
        wanted.then_some(direction)
    }

    /// Ends the run at the first crossing that counts.
    #[must_use]
    pub fn terminal(mut self) -> Self {
        self.terminal = true;
        self
    }
}

impl fmt::Debug for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Event")
            .field("name", &self.name)
            .field("direction", &self.direction)
            .field("terminal", &self.terminal)
            .finish_non_exhaustive()
    }
}

/// A located event.
#[derive(Debug, Clone, PartialEq)]
pub struct EventHit {
    /// Name of the event.
    pub name: String,
    /// Time.
    pub t: f64,
    /// Coordinates, projected.
    pub q: Vec<f64>,
    /// Velocities, projected.
    pub v: Vec<f64>,
    /// [`Direction::Rising`] or [`Direction::Falling`].
    pub direction: Direction,
}

/// A crossing found in one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing {
    /// Index of the event.
    pub(crate) event: usize,
    pub(crate) t: f64,
    pub(crate) direction: Direction,
}

/// The state where an event function is evaluated.
pub(crate) trait States {
    /// Interpolated state at `t` into `y`; the ends of the step are exact.
    fn state(&mut self, t: f64, y: &mut [f64]);
    /// Interpolated state at `t`, projected onto the constraints, into `y`.
    fn consistent(&mut self, t: f64, y: &mut [f64]) -> Result<(), Error>;
}

/// Watches events over the steps of a run.
pub(crate) struct Watch {
    pub(crate) events: Vec<Event>,
    /// g of each event at the end of the last accepted step, and at the end of the current one.
    accepted: Vec<f64>,
    current: Vec<f64>,
    /// Crossings of the current step in the order of time.
    pub(crate) crossings: Vec<Crossing>,
    state: Vec<f64>,
    /// Steps that were too long to tell how events go, less those that were not; steps that are not asked.
    untold: usize,
    rest: usize,
    next_rest: usize,
}

impl Watch {
    /// Nothing has been evaluated yet: [`Watch::start`] comes first.
    pub(crate) fn new(events: Vec<Event>, coordinates: usize) -> Self {
        let values = vec![0.0; events.len()];
        Watch {
            accepted: values.clone(),
            current: values,
            crossings: Vec::new(),
            state: vec![0.0; 2 * coordinates],
            untold: 0,
            rest: 0,
            next_rest: REST,
            events,
        }
    }

    /// Evaluates the events at the start of the run.
    pub(crate) fn start(&mut self, at: Sample<'_>) -> Result<(), Error> {
        for (event, value) in self.events.iter_mut().zip(&mut self.accepted) {
            *value = evaluate(event, at)?;
        }
        Ok(())
    }

    /// Finds the crossings in the step from `t_old` to `t`, up to the first terminal one; nothing, and false, where a `shorter` step may be
    /// made and is needed to tell them.
    pub(crate) fn search(
        &mut self,
        t_old: f64,
        t: f64,
        shorter: bool,
        states: &mut impl States,
    ) -> Result<bool, Error> {
        let Watch {
            events,
            accepted,
            current,
            crossings,
            state,
            untold,
            rest,
            next_rest,
        } = self;
        crossings.clear();
        if events.is_empty() {
            return Ok(true);
        }
        current.copy_from_slice(accepted);
        let mut looks = looks(events, current, [t_old, t], states, state)?;
        if *rest > 0 {
            *rest -= 1;
        } else {
            let few = looks.clone();
            if refine(events, current, [t_old, t], &mut looks, states, state)? {
                *untold = untold.saturating_sub(1);
            } else {
                *untold += 1;
                if *untold < PATIENCE && shorter {
                    return Ok(false);
                }
                looks = few;
            }
            if *untold >= PATIENCE {
                (*untold, *rest) = (PATIENCE - 1, *next_rest);
                *next_rest *= 2;
            }
        }
        beside(events, current, t_old, &mut looks, states, state)?;
        let mut a = t_old;
        for (b, values) in looks {
            let found = crossings.len();
            for (i, after) in values.into_iter().enumerate() {
                let before = current[i];
                current[i] = after;
                if let Some(direction) = events[i].crosses(before, after) {
                    crossings.push(Crossing {
                        event: i,
                        t: b,
                        direction,
                    });
                }
            }
            for crossing in &mut crossings[found..] {
                let event = &mut events[crossing.event];
                let mut g = |t: f64| {
                    states.consistent(t, state)?;
                    evaluate(event, Sample::of(t, state))
                };
                let falls = crossing.direction == Direction::Falling;
                let sign = if falls { -1.0 } else { 1.0 };
                crossing.t = locate(|t| Ok(sign * g(t)?), a, b)?;
            }
            let sign = if t < t_old { -1.0 } else { 1.0 };
            crossings[found..].sort_by(|x, y| (sign * x.t).total_cmp(&(sign * y.t)));
            if let Some(last) = crossings.iter().position(|c| events[c.event].terminal) {
                crossings.truncate(last + 1);
                break;
            }
            a = b;
        }
        Ok(true)
    }

    /// The step is accepted: the next one begins at its end.
    pub(crate) fn accept(&mut self) {
        std::mem::swap(&mut self.accepted, &mut self.current);
    }
}

/// Values of all events next to the start of a step, where coordinates go by their velocities alone: what an interpolant makes of them is off
/// by more than that.
fn beginning(
    events: &mut [Event],
    [t_old, t]: [f64; 2],
    states: &mut impl States,
    state: &mut [f64],
) -> Result<Vec<f64>, Error> {
    let mut old = state.to_vec();
    states.state(t_old, &mut old);
    states.state(t, state);
    let (q, v) = state.split_at_mut(old.len() / 2);
    let (old_q, old_v) = old.split_at(old.len() / 2);
    for (i, q) in q.iter_mut().enumerate() {
        *q = old_q[i] + 0.5 * (t - t_old) * (old_v[i] + v[i]);
    }
    let values = events.iter_mut();
    values
        .map(|event| evaluate(event, Sample::of(t, state)))
        .collect()
}

/// What errors of ε in the time and the state make of each event.
fn roundings(
    events: &mut [Event],
    t: f64,
    values: &[f64],
    state: &[f64],
) -> Result<Vec<f64>, Error> {
    let mut most = vec![0.0_f64; events.len()];
    for (k, moved) in crate::rounding::beside(state).enumerate() {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let t = t + sign * f64::EPSILON * t;
        for (i, event) in events.iter_mut().enumerate() {
            let there = evaluate(event, Sample::of(t, &moved))?;
            most[i] = most[i].max((there - values[i]).abs());
        }
    }
    Ok(most)
}

/// Values of all events at a time.
type Look = (f64, Vec<f64>);

/// Looks at events along a step whose start they have the values `before` at, up to where a terminal one has changed its sign.
fn looks(
    events: &mut [Event],
    before: &[f64],
    [t_old, t]: [f64; 2],
    states: &mut impl States,
    state: &mut [f64],
) -> Result<Vec<Look>, Error> {
    let at = |part: f64| match part {
        1.0 => t,
        part => t_old + (t - t_old) * part,
    };
    let mut soon = Vec::new();
    let mut part = SOON;
    loop {
        let values = match part < SOON {
            true => beginning(events, [t_old, at(part)], states, state)?,
            false => all(events, at(part), states, state)?,
        };
        let mut pairs = before.iter().zip(&values);
        let nearer = pairs.any(|(a, b)| a.abs() < NEARER * b.abs());
        if part < SOON {
            let known = roundings(events, at(part), &values, state)?;
            let mut pairs = values.iter().zip(known);
            if pairs.any(|(value, known)| value.abs() <= ROUNDING * known) {
                break;
            }
        }
        soon.push((at(part), values));
        part *= SOON;
        if !nearer || part < SOONEST {
            break;
        }
    }
    let mut looks: Vec<Look> = Vec::new();
    let later = LOOKS.into_iter().map(|part| (at(part), Vec::new()));
    for (b, known) in soon.into_iter().rev().chain(later) {
        let values = match known.is_empty() {
            true => all(events, b, states, state)?,
            false => known,
        };
        let last = looks.last().map_or(before, |(_, values)| values);
        let mut pairs = last.iter().zip(&values).zip(&*events);
        let ends = |((a, b), event): ((&f64, &f64), &Event)| {
            event.terminal && event.crosses(*a, *b).is_some()
        };
        let ended = pairs.any(ends);
        looks.push((b, values));
        if ended {
            break;
        }
    }
    Ok(looks)
}

/// Adds looks until they tell how the events go. Whether they do.
fn refine(
    events: &mut [Event],
    before: &[f64],
    [t_old, t]: [f64; 2],
    looks: &mut Vec<Look>,
    states: &mut impl States,
    state: &mut [f64],
) -> Result<bool, Error> {
    let mut known = None;
    loop {
        let mut all_looks = vec![(t_old, before.to_vec())];
        all_looks.append(looks);
        let mut rough = vec![false; all_looks.len()];
        for (k, five) in all_looks.windows(5).enumerate() {
            let mut rough_here = (0..events.len()).any(|i| is_rough(five, i, 0.0));
            if rough_here {
                let known = match &mut known {
                    Some(known) => known,
                    None => {
                        let values = all(events, five[2].0, states, state)?;
                        known.insert(roundings(events, five[2].0, &values, state)?)
                    }
                };
                rough_here = (0..known.len()).any(|i| is_rough(five, i, known[i]));
            }
            rough[k + 1..k + 5]
                .iter_mut()
                .for_each(|rough| *rough |= rough_here);
        }
        let least = NEAREST * (t - t_old).abs();
        let mut more = Vec::new();
        for (k, pair) in all_looks.windows(2).enumerate() {
            let way = pair[1].0 - pair[0].0;
            if rough[k + 1] && way.abs() > least {
                more.push(pair[0].0 + BETWEEN * way);
            }
        }
        looks.extend(all_looks.drain(1..));
        if more.is_empty() {
            return Ok(true);
        }
        if looks.len() + more.len() > MOST {
            return Ok(false);
        }
        for b in more {
            looks.push((b, all(events, b, states, state)?));
        }
        in_order(looks, t_old);
    }
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

fn in_order(looks: &mut [Look], t_old: f64) {
    let way = |look: &Look| (look.0 - t_old).abs();
    looks.sort_by(|a, b| way(a).total_cmp(&way(b)));
}

/// Adds a look where an event that is nearest to zero between others has changed its sign there.
fn beside(
    events: &mut [Event],
    before: &[f64],
    t_old: f64,
    looks: &mut Vec<Look>,
    states: &mut impl States,
    state: &mut [f64],
) -> Result<(), Error> {
    let start = (t_old, before.to_vec());
    let all_looks: Vec<&Look> = [&start].into_iter().chain(&*looks).collect();
    let mut more = Vec::new();
    for window in all_looks.windows(3) {
        let &[(a, first), (_, middle), (b, last)] = window else {
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
    for b in more {
        looks.push((b, all(events, b, states, state)?));
    }
    in_order(looks, t_old);
    Ok(())
}

fn all(
    events: &mut [Event],
    t: f64,
    states: &mut impl States,
    state: &mut [f64],
) -> Result<Vec<f64>, Error> {
    states.state(t, state);
    let values = events.iter_mut();
    values
        .map(|event| evaluate(event, Sample::of(t, state)))
        .collect()
}

fn evaluate(event: &mut Event, at: Sample<'_>) -> Result<f64, Error> {
    let value = (event.function)(at.t, at.q, at.v);
    if value.is_nan() {
        return Err(Error::non_finite(format!("event {}", event.name)));
    }
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Line;
    impl States for Line {
        fn state(&mut self, t: f64, y: &mut [f64]) {
            y[0] = t;
        }
        fn consistent(&mut self, t: f64, y: &mut [f64]) -> Result<(), Error> {
            self.state(t, y);
            Ok(())
        }
    }

    fn crossings(events: Vec<Event>, steps: &[f64]) -> Vec<(usize, f64, Direction)> {
        let mut watch = Watch::new(events, 1);
        let start = [steps[0], 0.0];
        watch.start(Sample::of(steps[0], &start)).unwrap();
        let mut found = Vec::new();
        for step in steps.windows(2) {
            watch.search(step[0], step[1], true, &mut Line).unwrap();
            found.extend(watch.crossings.iter().map(|c| (c.event, c.t, c.direction)));
            watch.accept();
        }
        found
    }

    #[test]
    fn several_events_in_one_step_come_in_the_order_of_time() {
        let events = || {
            vec![
                Event::new("late", |_, q, _| q[0] - 0.7),
                Event::new("both", |_, q, _| (q[0] - 0.2) * (q[0] - 0.65)),
                Event::new("falling", |_, q, _| (q[0] - 0.3) * (q[0] - 0.9))
                    .direction(Direction::Falling),
            ]
        };
        let check = |steps: &[f64], expect: &[(usize, f64)]| {
            let found = crossings(events(), steps);
            assert_eq!(found.len(), expect.len());
            for ((event, t, _), expect) in found.into_iter().zip(expect) {
                assert_eq!(event, expect.0);
                assert!((t - expect.1).abs() < 1e-15, "{t} is not {}", expect.1);
            }
        };
        check(&[0.0, 1.0], &[(1, 0.2), (2, 0.3), (1, 0.65), (0, 0.7)]);
        check(&[1.0, 0.5, 0.0], &[(2, 0.9), (0, 0.7), (1, 0.65), (1, 0.2)]);
    }

    #[test]
    fn an_exact_zero_counts_on_arrival_and_not_at_the_start() {
        let event = || vec![Event::new("zero", |_, q, _| q[0] - 0.5)];
        assert_eq!(crossings(event(), &[0.5, 1.0, 2.0]), []);
        let at = (0, 0.5, Direction::Rising);
        assert_eq!(crossings(event(), &[0.0, 0.5, 1.0]), [at]);
        assert_eq!(crossings(event(), &[0.0, 1.0]), [at]);
    }

    #[test]
    fn a_terminal_event_ends_the_search() {
        let events = vec![
            Event::new("later", |_, q, _| q[0] - 0.52),
            Event::new("end", |_, q, _| q[0] - 0.51).terminal(),
            Event::new("earlier", |_, q, _| q[0] - 0.1),
        ];
        let found = crossings(events, &[0.0, 1.0]);
        let names: Vec<usize> = found.iter().map(|c| c.0).collect();
        assert_eq!(names, [2, 1]);
    }

    #[test]
    fn a_function_that_is_not_a_number_is_an_error() {
        let mut watch = Watch::new(vec![Event::new("root", |_, q, _| q[0].sqrt())], 1);
        watch.start(Sample::of(1.0, &[1.0, 0.0])).unwrap();
        let error = watch.search(1.0, -1.0, true, &mut Line).unwrap_err();
        let what = vec!["event root".to_owned()];
        assert_eq!(error, Error::NonFinite { what });
    }
}
