//! Events: zeros of functions of the state, located while integrating.

use std::fmt;

use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::zero::locate;
use looks::Looks;

mod looks;

/// So many steps whose looks do not tell how events go are tried shorter; after that it is noise, and so many steps go by before more looks
/// are tried again, the next time twice as many.
const PATIENCE: usize = 8;
const REST: usize = 64;

/// Which sign changes count. Signs are compared in the order in which the run passes them, also when it runs backward.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Direction {
    /// Crossings from negative to positive.
    Rising,
    /// Crossings from positive to negative.
    Falling,
    /// Crossings in both directions.
    #[default]
    Both,
}

type Function = Box<dyn FnMut(f64, &[f64], &[f64]) -> f64>;

/// A function g(t, q, q̇) whose zeros are to be located.
///
/// A zero counts where g changes its sign, or arrives at exactly 0; a g that starts at exactly 0 is not an event. Its time is
/// located to rounding on the interpolant of the step, at projected states. Where dry friction has the motion stick at a zero of its
/// switch, a zero of g that the error of the step leaves ahead counts as met there: the hit has the state where the run stands.
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

    /// Ends the run at the first crossing that counts; what others cross at the time at which that is located still counts.
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
    /// The name of the event.
    pub name: String,
    /// The time of the zero.
    pub t: f64,
    /// The coordinates there, projected.
    pub q: Vec<f64>,
    /// The velocities there, projected.
    pub v: Vec<f64>,
    /// The direction of the crossing: [`Direction::Rising`] or [`Direction::Falling`].
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
        self.accepted = values(&mut self.events, at)?;
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
        let mut looks = Looks::new(events, current, [t_old, t], states, state)?;
        if *rest > 0 {
            *rest -= 1;
        } else {
            let few = looks.clone();
            if looks.refine(events, states, state)? {
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
        looks.find_dips(events, states, state)?;
        let mut a = t_old;
        for (b, values) in looks.all {
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
            let terminal = crossings.iter().find(|c| events[c.event].terminal);
            if let Some(end) = terminal.map(|c| c.t) {
                crossings.retain(|c| sign * c.t <= sign * end);
                break;
            }
            a = b;
        }
        Ok(true)
    }

    /// The events that are crossed between the end of the last step and a state just `beyond` it, and their directions.
    pub(crate) fn up_to(&mut self, beyond: Sample<'_>) -> Result<Vec<(&Event, Direction)>, Error> {
        let after = values(&mut self.events, beyond)?;
        let pairs = self.events.iter().zip(self.accepted.iter().zip(after));
        let met = pairs
            .filter_map(|(event, (before, after))| Some((event, event.crosses(*before, after)?)));
        Ok(met.collect())
    }

    /// The step is accepted: the next one begins at its end.
    pub(crate) fn accept(&mut self) {
        std::mem::swap(&mut self.accepted, &mut self.current);
    }
}

/// Values of all events at a state.
fn values(events: &mut [Event], at: Sample<'_>) -> Result<Vec<f64>, Error> {
    events.iter_mut().map(|event| evaluate(event, at)).collect()
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
            Event::new("meanwhile", |_, q, _| q[0] - 0.51),
        ];
        let found = crossings(events, &[0.0, 1.0]);
        let names: Vec<usize> = found.iter().map(|c| c.0).collect();
        assert_eq!(names, [2, 1, 3]);
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
