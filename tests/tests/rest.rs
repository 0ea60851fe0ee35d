//! Rest positions, against statics.

use tests::{assert_all_close, assert_close};
use ukcore::{Error, State, equilibrium};

ukcore::multibody! {
    /// Masses on rods of one length between two supports at one height; y points up.
    pub Rope {
        const N: usize = 5;
        params { l = 0.4, m[N] = [1.0, 2.0, 0.5, 1.5, 1.0], span = 1.6, g = 9.81 }
        coords { x[N], y[N] }
        mass { x: m, y: m }
        potential { for i in 0..N { m[i] * g * y[i] } }
        holonomic {
            first: sq(x[0]) + sq(y[0]) = sq(l)
            for i in 1..N { rod[i]: sq(x[i] - x[i - 1]) + sq(y[i] - y[i - 1]) = sq(l) }
            last: sq(span - x[N - 1]) + sq(y[N - 1]) = sq(l)
        }
        start flat { for i in 0..N { x[i] near span * (i + 1) / (N + 1); y[i] near -0.3 } }
    }
}

ukcore::multibody! {
    /// A pendulum that an elastic string pulls sideways, on a slide.
    pub Pulled {
        params { m = 2.0, l = 1.0, k = 30.0, g = 9.81 }
        coords { s, x, y }
        mass { s: 1.0, x: m, y: m }
        potential { m * g * y, 0.5 * k * sq(x - 0.5), 0.5 * sq(s) }
        holonomic { rod: sq(x - s) + sq(y) = sq(l) }
    }
}

fn guess(q: &[f64]) -> State {
    State {
        t: 0.0,
        q: q.to_vec(),
        v: vec![0.1; q.len()],
    }
}

/// The horizontal part of the tension is one for all rods; the vertical parts differ by the weights.
#[test]
fn a_rope_hangs_as_its_weights_pull() {
    let rope = Rope::default();
    let start = rope.start("flat", &[].into()).expect("a start");
    let found = equilibrium(&rope, &start, &[]).expect("it hangs");
    assert!(found.stable);
    let State { q, v, .. } = &found.state;
    assert!(v.iter().all(|v| *v == 0.0));
    let at = |i: usize| match i {
        0 => [0.0, 0.0],
        i if i > Rope::N => [rope.span, 0.0],
        i => [q[Rope::X[i - 1]], q[Rope::Y[i - 1]]],
    };
    let slope = |i: usize| (at(i + 1)[1] - at(i)[1]) / (at(i + 1)[0] - at(i)[0]);
    let tension = rope.m[0] * rope.g / (slope(1) - slope(0));
    for i in 1..Rope::N {
        let weight = tension * (slope(i + 1) - slope(i));
        assert_close("weight", weight, rope.m[i] * rope.g, 1e-8);
    }
    // Thrown upside down it is at rest, too, where nothing moves it off.
    let arch: Vec<f64> = (0..2 * Rope::N)
        .map(|k| if k < Rope::N { q[k] } else { -q[k] })
        .collect();
    let arch = equilibrium(&rope, &guess(&arch), &[]).expect("it stands");
    assert!(!arch.stable && arch.state.q[Rope::Y[2]] > 0.0, "{arch:?}");
    // A little off it falls down.
    let mut off = arch.state.q.clone();
    off[Rope::Y[1]] += 1e-3;
    let fallen = equilibrium(&rope, &guess(&off), &[]).expect("it hangs");
    assert_all_close("places", &fallen.state.q, q, 1e-8);
}

#[test]
fn what_is_held_keeps_its_place() {
    let pulled = Pulled::default();
    let free = equilibrium(&pulled, &guess(&[0.0, 0.3, -0.9]), &[]).expect("rest");
    let held = equilibrium(&pulled, &guess(&[0.2, 0.3, -0.9]), &["s"]).expect("rest");
    let balance = |state: &State, s_pulls: f64| {
        let [s, x, y] = state.q[..] else {
            panic!("three coordinates")
        };
        // Weight and string across the rod; the slide's spring along it.
        let pull = pulled.k * (0.5 - x);
        assert_close("across", pull * -y, pulled.m * pulled.g * (x - s), 1e-9);
        assert_close("slide", s_pulls * (s - pull), 0.0, 1e-9);
    };
    balance(&free.state, 1.0);
    balance(&held.state, 0.0);
    assert_eq!(held.state.q[0], 0.2);
    assert!(free.stable && held.stable);
}

#[test]
fn what_does_not_rest_is_told() {
    ukcore::multibody! { Falling { coords { y } mass { y: 1.0 } potential { 9.81 * y } } }
    ukcore::multibody! { Driven { coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { drive: x = 2.0 * t } } }
    ukcore::multibody! { Free { coords { x } mass { x: 1.0 } } }
    let told = |error: Error| error.to_string();
    let falling = equilibrium(Falling::default(), &guess(&[0.0]), &[]).unwrap_err();
    assert!(told(falling).contains("`y` is still driven most"));
    let driven = equilibrium(Driven::default(), &guess(&[0.0, 0.0]), &[]).unwrap_err();
    assert!(told(driven).contains("constraints that change with time move `x`"));
    let free = equilibrium(Free::default(), &guess(&[3.0]), &[]).expect("anywhere");
    assert!(!free.stable && free.state.q == [3.0]);
    assert!(equilibrium(Free::default(), &guess(&[3.0]), &["y"]).is_err());
}
