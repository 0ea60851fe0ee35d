//! What errors are measured against, and in which norm.

use ukcore::model::Reference;
use ukcore::spec::Spec;
use ukcore::{Method, Prepared, Simulation, State, Trajectory};

use crate::failure::Failure;

/// Steps of the reference are at most this part of the mean step of DOP853 at 1e-13: its truncation error then falls below rounding, also
/// where the motion is faster than in the mean. (A tolerance below rounding would do the same, but fails where rounding is all that is
/// left of the error estimate.)
const SHORT: f64 = 0.1;
/// Steps of the run that it is compared with are longer by this, which multiplies an error of order 8 by 26; its tolerance is larger by
/// ten.
const LONGER: f64 = 1.5;
/// Tolerance of the reference.
const TIGHT: f64 = 1e-13;
/// A reference with no larger error, scaled, serves every accuracy that is looked at.
const GOOD: f64 = 1e-12;
/// One that is computed takes the place of one that is shipped if its error is at most this part of the other's.
const MUCH: f64 = 0.1;
/// Equal intervals at whose ends states are compared where no reference is shipped.
const INTERVALS: u32 = 12;

/// States along a motion, and the sizes of its coordinates.
#[derive(Debug, Clone)]
pub(super) struct Truth {
    pub(super) source: String,
    /// Largest error that the states may have, in the norm of [`Truth::distance`].
    pub(super) floor: f64,
    /// Times of the states, in order.
    pub(super) times: Vec<f64>,
    /// (q, q̇) at these times.
    pub(super) states: Vec<Vec<f64>>,
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
    /// The truth that is shipped with the model.
    pub(super) fn shipped(spec: &Spec, start: &State, reference: &Reference) -> Self {
        let states: Vec<Vec<f64>> = reference.states.iter().map(stacked).collect();
        let scale = scale(spec, start, &states);
        let least = scale.iter().copied().fold(f64::INFINITY, f64::min);
        Truth {
            source: reference.source.to_owned(),
            floor: (reference.error / least).max(f64::EPSILON),
            times: reference.states.iter().map(|s| s.t).collect(),
            states,
            scale,
        }
    }

    /// The best that there is for a motion to `end`: what is shipped; what is computed where that is known better by far and agrees with
    /// what is shipped, or where nothing is.
    pub(super) fn of(
        mechanism: &Prepared,
        start: &State,
        end: f64,
        reference: Option<&Reference>,
    ) -> Result<Self, Failure> {
        let Some(reference) = reference else {
            let interval = (end - start.t) / f64::from(INTERVALS);
            let times = (1..=INTERVALS).map(|k| start.t + f64::from(k) * interval);
            return Truth::computed(mechanism, start, times.collect());
        };
        let shipped = Truth::shipped(mechanism.spec(), start, reference);
        if shipped.floor <= GOOD {
            return Ok(shipped);
        }
        let Ok(mut computed) = Truth::computed(mechanism, start, shipped.times.clone()) else {
            return Ok(shipped);
        };
        let apart = computed.largest(&shipped.states);
        if computed.floor > MUCH * shipped.floor || apart > shipped.floor {
            return Ok(shipped);
        }
        computed.source += &format!("; {}, differs by {apart:.1e}", reference.source);
        Ok(computed)
    }

    /// The truth computed by DOP853 with short steps. What a run with longer ones differs by is taken as its error; by how much another
    /// method differs is told.
    pub(super) fn computed(
        mechanism: &Prepared,
        start: &State,
        times: Vec<f64>,
    ) -> Result<Self, Failure> {
        let end = times.last().copied().unwrap_or(start.t);
        // With steps as short as those of a reference, interpolation adds nothing.
        let run = |method, tolerance, max_step: Option<f64>| {
            let mut simulation = Simulation::new(mechanism)
                .start(start.clone())
                .method(method)
                .tolerance(tolerance)
                .at(times.clone());
            if let Some(step) = max_step {
                simulation = simulation.max_step(step);
            }
            match simulation.until(end) {
                Ok(run) => Ok((states(&run), run.work().steps)),
                Err(failed) => Err(Failure::Failed(format!(
                    "there is no reference: {}",
                    failed.error
                ))),
            }
        };
        let (_, steps) = run(Method::Dop853, TIGHT, None)?;
        let short = SHORT * (end - start.t).abs() / steps.max(1) as f64;
        let (states, _) = run(Method::Dop853, TIGHT, Some(short))?;
        let (coarser, _) = run(Method::Dop853, 10.0 * TIGHT, Some(LONGER * short))?;
        let (other, _) = run(Method::Dopri5, TIGHT, None)?;
        let scale = scale(mechanism.spec(), start, &states);
        let mut truth = Truth {
            source: String::new(),
            floor: f64::EPSILON,
            times,
            states,
            scale,
        };
        truth.floor = truth.floor.max(truth.largest(&coarser));
        truth.source = format!(
            "made here: DOP853 with steps of at most {short:.1e} s; its error is its difference from a run with steps {LONGER} times as \
             long. DOPRI5 at {TIGHT:.0e} differs by {:.1e}",
            truth.largest(&other)
        );
        Ok(truth)
    }

    /// Largest scaled distance of states at the same times.
    pub(super) fn largest(&self, states: &[Vec<f64>]) -> f64 {
        largest(states, &self.states, &self.scale)
    }

    pub(super) fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Distance of (q, q̇) from the last of the states.
    pub(super) fn at_end(&self, state: &[f64]) -> Distance {
        self.distance(state, &self.states[self.states.len() - 1])
    }

    /// Distance of two (q, q̇).
    pub(super) fn distance(&self, a: &[f64], b: &[f64]) -> Distance {
        distance(a, b, &self.scale)
    }
}

/// Distance of two (q, q̇) whose coordinates have the sizes `scale`.
fn distance(a: &[f64], b: &[f64], scale: &[f64]) -> Distance {
    let mut distance = Distance {
        scaled: 0.0,
        absolute: 0.0,
    };
    for ((a, b), scale) in a.iter().zip(b).zip(scale) {
        let difference = (a - b).abs();
        grow(&mut distance.absolute, difference);
        grow(&mut distance.scaled, difference / scale);
    }
    distance
}

/// The largest distance of states that belong to each other, in units of the sizes of their coordinates.
pub(crate) fn largest(a: &[Vec<f64>], b: &[Vec<f64>], scale: &[f64]) -> f64 {
    let mut largest = 0.0;
    for (a, b) in a.iter().zip(b) {
        grow(&mut largest, distance(a, b, scale).scaled);
    }
    largest
}

/// Takes the larger one; what is no number stays.
fn grow(so_far: &mut f64, value: f64) {
    if value.is_nan() || value > *so_far {
        *so_far = value;
    }
}

/// (q, q̇).
pub(crate) fn stacked(state: &State) -> Vec<f64> {
    [state.q.as_slice(), &state.v].concat()
}

/// (q, q̇) of all samples of a run.
pub(crate) fn states(run: &Trajectory) -> Vec<Vec<f64>> {
    let samples = run.samples();
    samples.map(|sample| stacked(&sample.to_state())).collect()
}

/// The size of each coordinate and velocity: the largest of its kind along the motion; of all kinds, where its own stays at zero. The
/// kind of a coordinate is its name up to the first digit or bracket: `x1`, `x[3]` and `x` are of one kind.
pub(crate) fn scale(spec: &Spec, start: &State, states: &[Vec<f64>]) -> Vec<f64> {
    let coords = spec.coords;
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
    use ukcore::Mechanism;

    ukcore::multibody! {
        /// A mass on a spring, let go at 1.
        Oscillator {
            params { k = 4.0 }
            coords { x1 }
            mass { x1: 1.0 }
            potential { 0.5 * k * sq(x1) }
        }
    }

    fn start() -> State {
        State {
            q: vec![1.0],
            ..State::zeros::<Oscillator>()
        }
    }

    fn closed() -> Reference {
        let states = (1..=4).map(|k| {
            let t = 0.5 * f64::from(k);
            let (sin, cos) = (2.0 * t).sin_cos();
            State {
                t,
                q: vec![cos],
                v: vec![-2.0 * sin],
            }
        });
        Reference {
            source: "closed form",
            error: 1e-15,
            states: states.collect(),
        }
    }

    #[test]
    fn kinds_are_names_without_their_number() {
        assert_eq!(
            ["x1", "x[3]", "x", "th2", "joint"].map(kind),
            ["x", "x", "x", "th", "joint"]
        );
    }

    #[test]
    fn what_is_computed_agrees_with_what_is_shipped() {
        let mechanism = Oscillator::default().prepared();
        let shipped = Truth::shipped(mechanism.spec(), &start(), &closed());
        let computed = Truth::computed(&mechanism, &start(), shipped.times.clone());
        let computed = computed.expect("the runs succeed");
        let error = shipped.at_end(&computed.states[computed.states.len() - 1]);
        let bound = 3.0 * (shipped.floor + computed.floor);
        assert!(error.scaled < bound, "{error:?} {bound:e}");
    }

    #[test]
    fn a_state_that_is_no_number_is_infinitely_far_or_not_a_number() {
        let truth = Truth::shipped(Oscillator::SPEC, &start(), &closed());
        let distance = truth.at_end(&[f64::NAN, 0.0]);
        assert!(distance.scaled.is_nan() && distance.absolute.is_nan());
        assert!(truth.floor < 1e-13);
    }
}
