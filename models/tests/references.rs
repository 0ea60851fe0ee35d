//! What is known about motions: states of their models, and closed forms against decimals.

use models::{Model, Pendulum, UChain, Visitor, visit};
use serde_json::Value;
use ukcore::manifold::Projector;

/// Every state of every reference: finite, of the right length, later than the one before, and on the constraints. How many references
/// there are.
struct Sound(usize);

impl Visitor for Sound {
    fn visit<M: Model>(&mut self) {
        let mechanism = M::default();
        let start = mechanism.default_start().expect("a start");
        for reference in M::references() {
            self.0 += 1;
            assert!(!reference.states.is_empty(), "{}", M::ID);
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
                    let off = (is - should).abs();
                    assert!(off <= bound, "{} at {t}: {is} {should}", M::ID);
                }
            }
        }
    }
}

#[test]
fn references_are_states_of_their_models() {
    let mut sound = Sound(0);
    visit(&mut sound);
    assert!(sound.0 >= 8, "{}", sound.0);
}

/// The data has more digits than an `f64` holds, as text; they are read to the nearest one.
#[test]
fn data_is_read_to_the_last_digit() {
    let states = UChain::references().remove(0).states;
    let [first, ..] = &states[..] else {
        panic!("no state")
    };
    assert_eq!((first.t, first.q[0]), (0.5, 11.968_076_656_262_75));
    assert_eq!(states.last().map(|state| state.t), Some(1.5));
}

/// The pendulum's closed form against 28 digits, at the times that both have.
#[test]
fn the_closed_form_keeps_its_bound() {
    let reference = Pendulum::references().remove(0);
    let data: Value = serde_json::from_str(include_str!("../data/pendulum.json")).expect("JSON");
    let number = |value: &Value| -> f64 { value.as_str().expect("decimals").parse().expect("one") };
    let mut compared = 0;
    for point in data["reference"].as_array().expect("a list") {
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
