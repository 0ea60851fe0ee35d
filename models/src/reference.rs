//! Reading of the reference data in `models/data`.

use serde_json::Value;
use ukcore::{Mechanism, State};

/// A file of `models/data`.
///
/// # Panics
/// If it is not JSON: the file is part of the program, and the tests read each of them.
pub(crate) fn data(text: &str) -> Value {
    serde_json::from_str(text).expect("data files are JSON")
}

/// A number, given as such or as decimals with more digits than an `f64` holds; NaN if there is none.
pub(crate) fn number(value: &Value) -> f64 {
    let read = |text: &str| text.parse().ok();
    value
        .as_f64()
        .or_else(|| value.as_str().and_then(read))
        .unwrap_or(f64::NAN)
}

/// A list of numbers; empty if there is none.
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .map_or_else(Vec::new, |list| list.iter().map(number).collect())
}

/// A state of `M` whose coordinates `places` have the values `q` and `v`; the others are 0.
pub(crate) fn placed<M: Mechanism>(
    t: f64,
    places: impl IntoIterator<Item = usize>,
    q: &[f64],
    v: &[f64],
) -> State {
    let n = M::SPEC.n();
    let mut state = State {
        t,
        q: vec![0.0; n],
        v: vec![0.0; n],
    };
    for (place, (q, v)) in places.into_iter().zip(q.iter().zip(v)) {
        state.q[place] = *q;
        state.v[place] = *v;
    }
    state
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, Visitor};
    use ukcore::manifold::Projector;

    /// Every state of every reference: finite, of the right length, later than the one before, and on the constraints.
    struct Sound;

    impl Visitor for Sound {
        type Output = usize;

        fn visit<M: Model>(self) -> usize {
            let mechanism = M::default();
            let start = mechanism.default_start().expect("a start");
            let references = M::references();
            for reference in &references {
                let mut t = start.t;
                for state in &reference.states {
                    assert!(state.t > t, "{}: {t}", M::ID);
                    t = state.t;
                    assert_eq!((state.q.len(), state.v.len()), (M::SPEC.n(), M::SPEC.n()));
                    let mut projector = Projector::new(&mechanism);
                    let (mut q, mut v) = (state.q.clone(), state.v.clone());
                    projector
                        .position(t, &mut q, &v)
                        .expect("near the constraints");
                    projector
                        .velocity(t, &q, &mut v)
                        .expect("near the constraints");
                    let moved = state.q.iter().zip(&q).chain(state.v.iter().zip(&v));
                    for (is, should) in moved {
                        // The size of a coordinate times rounding, beside the bound itself.
                        let bound = reference.error + 1e-14 * (1.0 + should.abs());
                        assert!(
                            (is - should).abs() <= bound,
                            "{} at {t}: {is} {should}",
                            M::ID
                        );
                    }
                }
            }
            references.len()
        }
    }

    #[test]
    fn references_are_states_of_their_models() {
        let known: usize = crate::ids()
            .into_iter()
            .map(|id| crate::visit(id, Sound).expect("its name"))
            .sum();
        assert!(known >= 8, "{known}");
    }

    /// The pendulum's closed form against 28 digits, at the times that both have.
    #[test]
    fn the_closed_form_keeps_its_bound() {
        let reference = crate::Pendulum::references().remove(0);
        let data = data(include_str!("../data/pendulum.json"));
        let points = data["reference"].as_array().expect("a list");
        let mut compared = 0;
        for point in points {
            let t = number(&point["t"]);
            let Some(state) = reference.states.iter().find(|s| s.t == t) else {
                continue;
            };
            let values = state.q.iter().chain(&state.v);
            for (value, key) in values.zip(["x", "y", "vx", "vy"]) {
                let error = (value - number(&point[key])).abs();
                assert!(error <= reference.error, "{key} at {t}: {error:e}");
            }
            compared += 1;
        }
        assert_eq!(compared, 2, "5 s and 10 s");
    }

    #[test]
    fn numbers_are_read_in_both_ways() {
        let list = data(r#"[1.5, "0.333333333333333333333333", null]"#);
        let read = numbers(&list);
        assert_eq!(&read[..2], &[1.5, 1.0 / 3.0]);
        assert!(read[2].is_nan());
    }
}
