//! What errors are measured against, and in which norm.

use models::{Model, Reference};
use ukcore::{Error, Method, Simulation, State};

use crate::failure::Failure;

/// Tolerance of the run that serves as reference where none is shipped, and of the one that it is compared with. Both are as tight as rounding
/// allows their method.
const TIGHT: [(Method, f64); 2] = [(Method::Dop853, 1e-14), (Method::Dopri5, 1e-13)];
/// Equal intervals at whose ends states are compared where no reference is shipped.
const INTERVALS: u32 = 12;

/// States along a motion, and the sizes of its coordinates.
#[derive(Debug, Clone)]
pub(super) struct Truth {
    /// Where the states come from.
    pub(super) source: String,
    /// Largest error that the states may have, in the norm of [`Truth::errors`].
    pub(super) floor: f64,
    /// Times of the states, in order.
    pub(super) times: Vec<f64>,
    /// (q, q̇) at these times.
    states: Vec<Vec<f64>>,
    /// Sizes of (q, q̇).
    pub(super) scale: Vec<f64>,
}

/// The distance of two states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Distance {
    /// Largest difference as a part of the size of the coordinate's kind.
    pub(super) scaled: f64,
    /// Largest difference, in units of the coordinates.
    pub(super) absolute: f64,
}

impl Truth {
    /// From what is shipped with the model.
    pub(super) fn shipped<M: Model>(start: &State, reference: &Reference) -> Self {
        let states: Vec<Vec<f64>> = reference.states.iter().map(stacked).collect();
        let scale = scale::<M>(start, &states);
        let least = scale.iter().copied().fold(f64::INFINITY, f64::min);
        Truth {
            source: reference.source.to_owned(),
            floor: (reference.error / least).max(f64::EPSILON),
            times: reference.states.iter().map(|s| s.t).collect(),
            states,
            scale,
        }
    }

    /// By two runs with different methods, each started anew at each of the times, so that nothing is interpolated; what they differ by is
    /// taken as the error of the first.
    ///
    /// # Errors
    /// [`Failure::Failed`] naming the run.
    pub(super) fn computed<M: Model>(
        mechanism: &M,
        start: &State,
        end: f64,
    ) -> Result<Self, Failure> {
        let step = (end - start.t) / f64::from(INTERVALS);
        let times: Vec<f64> = (1..=INTERVALS)
            .map(|k| start.t + f64::from(k) * step)
            .collect();
        let [best, other] = TIGHT.map(|(method, tolerance)| {
            along(mechanism, start, &times, method, tolerance)
                .map_err(|error| Failure::Failed(format!("no reference for `{}`: {error}", M::ID)))
        });
        let (states, others) = (best?, other?);
        let scale = scale::<M>(start, &states);
        let mut truth = Truth {
            source: "made here: DOP853 at 1e-14, compared with DOPRI5 at 1e-13".to_owned(),
            floor: f64::EPSILON,
            times,
            states,
            scale,
        };
        for (k, other) in others.iter().enumerate() {
            truth.floor = truth.floor.max(truth.errors(k, other).scaled);
        }
        Ok(truth)
    }

    /// End of the motion.
    pub(super) fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Number of the last state.
    pub(super) fn last(&self) -> usize {
        self.times.len().saturating_sub(1)
    }

    /// (q, q̇) number `index`.
    pub(super) fn state(&self, index: usize) -> &[f64] {
        &self.states[index]
    }

    /// Distance of (q, q̇) from state number `index`.
    pub(super) fn errors(&self, index: usize, state: &[f64]) -> Distance {
        self.distance(state, &self.states[index])
    }

    /// Distance of two (q, q̇).
    pub(super) fn distance(&self, a: &[f64], b: &[f64]) -> Distance {
        let mut distance = Distance {
            scaled: 0.0,
            absolute: 0.0,
        };
        let grow = |so_far: &mut f64, value: f64| {
            // What is no number stays.
            if value.is_nan() || value > *so_far {
                *so_far = value;
            }
        };
        for ((a, b), scale) in a.iter().zip(b).zip(&self.scale) {
            let difference = (a - b).abs();
            grow(&mut distance.absolute, difference);
            grow(&mut distance.scaled, difference / scale);
        }
        distance
    }
}

/// (q, q̇).
pub(super) fn stacked(state: &State) -> Vec<f64> {
    [state.q.as_slice(), &state.v].concat()
}

fn along<M: Model>(
    mechanism: &M,
    start: &State,
    times: &[f64],
    method: Method,
    tolerance: f64,
) -> Result<Vec<Vec<f64>>, Error> {
    let mut state = start.clone();
    let mut states = Vec::with_capacity(times.len());
    for &t in times {
        let run = Simulation::new(mechanism.clone())
            .start(state)
            .method(method)
            .tolerance(tolerance)
            .at(Vec::new())
            .until(t)
            .map_err(|failure| failure.error)?;
        let Some(last) = run.last() else { break };
        state = last.to_state();
        states.push(stacked(&state));
    }
    Ok(states)
}

/// The size of each coordinate and velocity: the largest of its kind along the motion; of all kinds, where its own stays at zero. The kind of a
/// coordinate is its name up to the first digit or bracket: `x1`, `x[3]` and `x` are of one kind.
fn scale<M: Model>(start: &State, states: &[Vec<f64>]) -> Vec<f64> {
    let coords = M::SPEC.coords;
    let n = coords.len();
    let start = stacked(start);
    let all = || states.iter().chain([&start]);
    let largest = |level: usize, of: &dyn Fn(usize) -> bool| {
        let wanted = (0..n).filter(|&j| of(j)).map(|j| level * n + j);
        wanted
            .flat_map(|j| all().map(move |s| s[j].abs()))
            .fold(0.0, f64::max)
    };
    let mut scale = Vec::with_capacity(2 * n);
    for level in [0, 1] {
        let whole = largest(level, &|_| true);
        for name in coords {
            let own = largest(level, &|j| kind(coords[j]) == kind(name));
            // Below a millionth of the others it is rounding, or a coordinate that hardly takes part.
            let size = if own > 1e-6 * whole { own } else { whole };
            scale.push(if size > 0.0 { size } else { 1.0 });
        }
    }
    scale
}

fn kind(name: &str) -> &str {
    let end = name.find(|c: char| c.is_ascii_digit() || c == '[');
    &name[..end.unwrap_or(name.len())]
}

#[cfg(test)]
mod tests {
    use super::*;
    use models::{DoublePendulum, Pendulum};

    #[test]
    fn kinds_are_names_without_their_number() {
        assert_eq!(
            ["x1", "x[3]", "x", "th2", "joint"].map(kind),
            ["x", "x", "x", "th", "joint"]
        );
    }

    #[test]
    fn what_is_computed_agrees_with_what_is_shipped() {
        fn check<M: Model>() {
            let mechanism = M::default();
            let start = mechanism.default_start().expect("a start");
            let reference = M::references().pop().expect("shipped");
            let shipped = Truth::shipped::<M>(&start, &reference);
            let computed =
                Truth::computed(&mechanism, &start, shipped.end()).expect("the runs succeed");
            let error = shipped.errors(shipped.last(), computed.state(computed.last()));
            let bound = 3.0 * (shipped.floor + computed.floor);
            assert!(error.scaled < bound, "{}: {error:?} {bound:e}", M::ID);
        }
        check::<Pendulum>();
        check::<DoublePendulum>();
    }

    #[test]
    fn a_state_that_is_no_number_is_infinitely_far_or_not_a_number() {
        let start = Pendulum::default().default_start().expect("a start");
        let truth = Truth::shipped::<Pendulum>(&start, &Pendulum::references()[0]);
        let distance = truth.errors(0, &[f64::NAN, 0.0, 0.0, 0.0]);
        assert!(distance.scaled.is_nan() && distance.absolute.is_nan());
        assert!(truth.floor < 1e-13);
    }
}
