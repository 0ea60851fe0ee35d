//! Rest positions, against statics.

mod falls;
mod feedback;
mod idle;
mod tops;

use std::f64::consts::TAU;

use tests::FourBar;
use tests::{assert_all_close, assert_close, at};
use ukcore::studies::Stability;
use ukcore::{Error, Mechanism, State, equilibrium};

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

ukcore::multibody! {
    /// A pendulum on a cart that nothing holds, in oil that turns with the cart.
    pub Dragged {
        params { big = 2.0, m = 1.0, l = 0.5, g = 9.81, c = 0.3 }
        coords { s, x, y }
        mass { s: big, x: m, y: m }
        potential { m * g * y }
        force { x: -c * (dot(x) - dot(s)), s: c * (dot(x) - dot(s)) }
        holonomic { rod: sq(x - s) + sq(y) = sq(l) }
    }
}

macro_rules! mechanisms {
    ($($name:ident { $($body:tt)* })*) => { $(ukcore::multibody! { $name { $($body)* } })* };
}

fn guess(q: &[f64]) -> State {
    at(q, &vec![0.1; q.len()])
}

/// The horizontal part of the tension is one for all rods; the vertical parts differ by the weights.
#[test]
fn a_rope_hangs_as_its_weights_pull() {
    let rope = Rope::default();
    let start = rope.start("flat", &[].into()).expect("a start");
    let found = equilibrium(&rope, &start, &[]).expect("it hangs");
    assert_eq!(found.stability, Stability::Stable);
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
    assert!(
        arch.stability == Stability::Unstable && arch.state.q[Rope::Y[2]] > 0.0,
        "{arch:?}"
    );
    // A little off it falls down.
    let mut off = arch.state.q.clone();
    off[Rope::Y[1]] += 1e-3;
    let fallen = equilibrium(&rope, &guess(&off), &[]).expect("it hangs");
    assert_all_close("places", &fallen.state.q, q, 1e-8);
}

/// Forces without a potential move what costs nothing no more than others do: the centre of mass stays.
#[test]
fn what_nothing_holds_stays_where_it_is_guessed() {
    let dragged = Dragged::default();
    for (at, angle) in [(0.0, 0.9), (3.0, 0.2), (-40.0, 1.5)] {
        let (sin, cos) = f64::sin_cos(angle);
        let start = [at, at + 0.5 * sin, -0.5 * cos];
        let found = equilibrium(&dragged, &guess(&start), &[]).expect("rest");
        let [s, x, y] = found.state.q[..] else {
            panic!("three coordinates")
        };
        assert_eq!(found.stability, Stability::Neutral);
        assert_close("height", y, -0.5, 1e-12);
        assert_close("it hangs", x - s, 0.0, 1e-9);
        assert_close(
            "centre",
            s,
            (2.0 * at + start[1]) / 3.0,
            1e-9 * (1.0 + at.abs()),
        );
    }
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
    assert_eq!([free.stability, held.stability], [Stability::Stable; 2]);
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
    assert_eq!(
        (free.stability, &free.state.q[..]),
        (Stability::Neutral, &[3.0][..])
    );
    assert!(equilibrium(Free::default(), &guess(&[3.0]), &["y"]).is_err());
}

/// Forces that grow without bound towards a place, or fade on the way to nowhere, hold nothing; those that vanish at a place without
/// stiffness do.
#[test]
fn pits_and_slopes_that_fade_are_no_rest_positions() {
    mechanisms! {
        Centre { coords { x, y } mass { x: 1.0, y: 1.0 } potential { -1.0 / norm([x, y]) } }
        Pit { coords { x, y } mass { x: 1.0, y: 1.0 } potential { -1.0 / sq(x - 0.3), sq(y) } }
        Fading { coords { x, y } mass { x: 1.0, y: 1.0 } potential { exp(-x), sq(y) } }
        Shelf { coords { x, y } mass { x: 1.0, y: 1.0 } potential { atan(x), sq(y) } }
        Flat { coords { x, y } mass { x: 1.0, y: 1.0 } potential { sq(sq(x)), sq(y) } }
    }
    let at = guess(&[1.0, 0.2]);
    let found = [
        equilibrium(Centre::default(), &at, &[]),
        equilibrium(Pit::default(), &at, &[]),
        equilibrium(Fading::default(), &at, &[]),
        equilibrium(Shelf::default(), &at, &[]),
    ];
    for found in found {
        let told = found.expect_err("it does not rest").to_string();
        assert!(told.contains("`x` is still driven most"), "{told}");
    }
    let flat = equilibrium(Flat::default(), &at, &[]).expect("it rests at zero");
    assert!(flat.state.q[0].abs() < 1e-5, "{flat:?}");
}

/// Where forces jump there is no stiffness, whether they are zero there or not; corners that forces go round are rest positions.
#[test]
fn kinks_and_apexes_are_told() {
    mechanisms! {
        Kink { coords { x } mass { x: 1.0 } potential { abs(x) } }
        Tip { coords { x, y } mass { x: 1.0, y: 1.0 } potential { norm([x, y]) } }
        Hole { coords { x, y, z } mass { x: 1.0, y: 1.0, z: 2.0 } potential { 19.62 * z } holonomic { string: norm([x, y]) - z = 2.0 } }
        Cone { coords { x, y, z } mass { x: 1.0, y: 1.0, z: 1.0 } potential { z } holonomic { c: sq(x) + sq(y) = sq(z) } }
        Corner { coords { x, y } mass { x: 1.0, y: 1.0 } potential { 0.5 * sq(max(0, x)) + 0.5 * 1e9 * sq(max(0, -x)) + 0.1 * sq(x), sq(y) } }
        Stop { coords { y } mass { y: 1.0 } potential { 9.81 * y + 0.5 * 1e9 * sq(max(0, -y)) } }
    }
    let found = [
        equilibrium(Kink::default(), &guess(&[0.3]), &[]),
        equilibrium(Tip::default(), &guess(&[1.0, 0.5]), &[]),
        equilibrium(Hole::default(), &guess(&[0.5, 0.3, -1.5]), &[]),
        equilibrium(Hole::default(), &guess(&[0.5, 0.0, -1.5]), &[]),
        equilibrium(Cone::default(), &guess(&[0.3, 0.4, 0.5]), &[]),
    ];
    for found in found {
        let told = found.expect_err("forces jump").to_string();
        assert!(told.contains("jumps"), "{told}");
    }
    // Contacts and laws that are as stiff or narrow as that are smooth all the same, beside coordinates of any size.
    mechanisms! {
        Wall { params { k = 1e11 } coords { a, b } mass { a: 1.0, b: 1.0 } potential { 0.5 * sq(a - b), 0.5 * k * sq(max(b - 1.0, 0.0)) } force { a: 5.0 } }
        Floor { params { k = 1e11, h = 1e3 } coords { x, y } mass { x: 1.0, y: 1.0 } force { y: -9.81 + max(0.0, k * (h - y)), x: -x } }
        Narrow { params { l = 1e3, e = 1e-7 } coords { x, th } mass { x: 1.0, th: 1.0 } force { x: -1e-3 * (x - l), th: -tanh(th / e) } }
    }
    for k in [1e9, 1e10, 1e11, 1e12] {
        let wall = equilibrium(Wall { k }, &guess(&[0.5, 1.1]), &[]).expect("rest");
        assert_close("at the wall", wall.state.q[1], 1.0 + 5.0 / k, 1e-15);
        for h in [0.0, 1e3] {
            equilibrium(Floor { k, h }, &guess(&[0.3, h - 1.0]), &[]).expect("rest");
        }
    }
    equilibrium(Narrow::default(), &guess(&[900.0, 1e-8]), &[]).expect("rest");
    let corner = equilibrium(Corner::default(), &guess(&[0.4, 0.2]), &[]).expect("rest");
    assert_eq!(corner.stability, Stability::Stable);
    let stop = equilibrium(Stop::default(), &guess(&[0.4]), &[]).expect("rest");
    assert_close("under its weight", stop.state.q[0], -9.81e-9, 1e-15);
}

/// A support that just turns about moves all the same.
#[test]
fn supports_that_stand_for_a_moment_are_told() {
    mechanisms! {
        Shaken { coords { x, y } mass { x: 1.0, y: 1.0 } potential { 9.81 * y } holonomic { rod: sq(x) + sq(y - 0.1 * cos(3 * t)) = 1.0 } }
        Still { params { a = 0.0 } coords { x, y } mass { x: 1.0, y: 1.0 } potential { 9.81 * y } holonomic { rod: sq(x) + sq(y - a * cos(3 * t)) = 1.0 } }
    }
    let told = equilibrium(Shaken::default(), &guess(&[0.6, -0.7]), &[]).expect_err("it moves");
    assert!(
        told.to_string().contains("`rod` changes with time"),
        "{told}"
    );
    // Others have come to rest, but for rounding.
    mechanisms! {
        Cycloid { coords { x, y } mass { x: 1.0, y: 1.0 } potential { 0.5 * sq(y - x) } holonomic { drive: x = t - sin(2 * PI * t) / (2 * PI) } }
        Ramp { coords { x, y } mass { x: 1.0, y: 1.0 } potential { 0.5 * sq(y - x) } let u = min(t / 0.3, 1.0);
            holonomic { drive: x = u.powi(3) * (10 - 15 * u + 6 * sq(u)) } }
    }
    for t in [1.0, 2.0, 3.0, 5.0, 10.0] {
        let at = State {
            t,
            ..guess(&[t, 0.0])
        };
        let rest = equilibrium(Cycloid::default(), &at, &[]).expect("rest");
        assert_close("there", rest.state.q[1], t, 1e-9);
    }
    equilibrium(
        Ramp::default(),
        &State {
            t: 0.3,
            ..guess(&[1.0, 0.0])
        },
        &[],
    )
    .expect("rest");
    let still = equilibrium(Still::default(), &guess(&[0.6, -0.8]), &[]).expect("it hangs");
    assert_close("below", still.state.q[1], -1.0, 1e-12);
}

/// Forces vanish at an inflection of the potential and drive on what is beyond it, from whatever side the search comes.
#[test]
fn an_inflection_of_the_potential_is_no_stable_rest() {
    mechanisms! {
        Inflection { coords { x } mass { x: 1.0 } potential { x.powi(3) } }
        Fifth { coords { x } mass { x: 1.0 } potential { x.powi(5) } }
        Tilted { coords { x, y } mass { x: 1.0, y: 2.0 } holonomic { line: x = y } potential { x.powi(3) } }
        Fourth { coords { x } mass { x: 1.0 } potential { sq(sq(x)) } }
        Uneven { params { k = 1e-6 } coords { x } mass { x: 1.0 } potential { 0.5 * k * sq(x) + x.powi(3) } }
    }
    fn stability<M: Mechanism>(mechanism: M, q: &[f64]) -> Stability {
        let found = equilibrium(mechanism, &guess(q), &[]);
        found
            .unwrap_or_else(|e| panic!("{} from {q:?}: {e}", M::SPEC.name))
            .stability
    }
    for scale in [1e-3, 0.1, 1.0, 30.0] {
        assert_eq!(
            stability(Inflection::default(), &[scale]),
            Stability::Unstable,
            "{scale}"
        );
        assert_eq!(
            stability(Tilted::default(), &[scale; 2]),
            Stability::Unstable,
            "{scale}"
        );
        assert_eq!(
            stability(Fourth::default(), &[scale]),
            Stability::Stable,
            "{scale}"
        );
    }
    assert_eq!(stability(Fifth::default(), &[0.1]), Stability::Unstable);
    assert_eq!(stability(Uneven::default(), &[0.1]), Stability::Stable);
}

mechanisms! {
    Spring { params { k = 4.0 } coords { x } mass { x: 1.0 } potential { 0.5 * k * sq(x) } }
    Swing { coords { a } kinetic { 0.5 * sq(dot(a)) } potential { -9.81 * cos(a) } }
    Mixed { params { k = 1e3 } coords { x, y } mass { x: 1.0, y: 1.0 } potential { 0.5 * k * sq(x - 1.0), 0.5 * sq(y - 1.0) } }
    Row {
        coords { x[3] } mass { x: 1.0 }
        potential { 0.5e8 * sq(x[0]), 0.5 * sq(x[1] - x[0]), 0.5e8 * sq(x[2] - x[1]), -9.81 * (x[0] + x[1] + x[2]) }
    }
    Turning {
        params { k = -4.0, w = 3.0 }
        coords { x, y } mass { x: 1.0, y: 1.0 }
        potential { 0.5 * k * (sq(x - 1.0) + sq(y - 1.0)) }
        force { x: 2.0 * w * dot(y), y: -2.0 * w * dot(x) }
    }
    Fed { coords { x } mass { x: 1.0 } potential { 0.5 * sq(x) } dissipation { -0.25 * sq(dot(x)) } }
    Circling {
        params { k = 5.0, p = 1.0 }
        coords { x, y } mass { x: 1.0, y: 1.0 }
        potential { 0.5 * k * (sq(x - 1.0) + sq(y - 1.0)) }
        force { x: -p * (y - 1.0), y: p * (x - 1.0) }
    }
}

/// Rest positions at zero, stiff beside soft, with forces that have no potential.
#[test]
fn zeros_stiffness_and_forces_without_a_potential() {
    fn rest<M: Mechanism>(q: &[f64], expected: &[f64], stability: Stability) {
        let name = M::SPEC.name;
        let found = equilibrium(M::default(), &guess(q), &[]);
        let found = found.unwrap_or_else(|e| panic!("{name} from {q:?}: {e}"));
        let size = q
            .iter()
            .chain(expected)
            .fold(0.0, |s: f64, x| s.max(x.abs()));
        assert_all_close(name, &found.state.q, expected, 1e-9 * size);
        assert_eq!(found.stability, stability, "{name} from {q:?}");
    }
    use Stability::{Stable, Unstable};
    for k in 1..=100 {
        rest::<Spring>(&[0.05 * f64::from(k)], &[0.0], Stable);
    }
    for small in [1e-9, 1e-300, 0.0] {
        rest::<Spring>(&[small], &[0.0], Stable);
    }
    for angle in [0.1, -1.4, 2.0, 3.1] {
        rest::<Swing>(&[angle], &[0.0], Stable);
    }
    rest::<Swing>(&[std::f64::consts::PI], &[std::f64::consts::PI], Unstable);
    rest::<Mixed>(&[0.1, 0.0], &[1.0, 1.0], Stable);
    for ratio in [1e4, 1e6, 1e8] {
        let mixed = Mixed { k: ratio };
        let found = equilibrium(&mixed, &guess(&[0.1, 0.0]), &[]).expect("rest");
        assert_eq!(found.stability, Stable, "{ratio:e}");
        assert_all_close("place", &found.state.q, &[1.0, 1.0], 1e-9);
    }
    let g = 9.81;
    let row = [
        3.0 * g / 1e8,
        3.0 * g / 1e8 + 2.0 * g,
        3.0 * g / 1e8 + 2.0 * g + g / 1e8,
    ];
    rest::<Row>(&[0.0, 0.0, 0.0], &row, Stable);
    // Held up by turning alone.
    rest::<Turning>(&[0.3, 0.8], &[1.0, 1.0], Stability::Neutral);
    rest::<Fed>(&[0.3], &[0.0], Unstable);
    rest::<Circling>(&[0.3, 0.0], &[1.0, 1.0], Unstable);
}

/// Two rods hold a point, and a drive that stands still a slide: nothing is left to move.
#[test]
fn what_has_no_freedom_rests_where_it_is() {
    mechanisms! {
        Held { params { g = 9.81 } coords { x, y } mass { x: 1.0, y: 1.0 } potential { g * y } holonomic {
            left: sq(x) + sq(y) = 1.0, right: sq(x - 1.0) + sq(y) = 1.0
        } }
    }
    let place = [0.5, 0.75_f64.sqrt()];
    let found = equilibrium(Held::default(), &guess(&[0.4, 0.9]), &[]).expect("rest");
    assert_all_close("place", &found.state.q, &place, 1e-14);
    assert_eq!(found.stability, Stability::Stable);
    assert_eq!(ukcore::modes(Held::default(), &found.state), Ok(Vec::new()));
    let held = equilibrium(Spring::default(), &guess(&[0.3]), &["x"]).expect("rest");
    assert_eq!(
        (&held.state.q[..], held.stability),
        (&[0.3][..], Stability::Stable)
    );
}

/// Where two constraints touch one of them tells nothing of the motion, and beside it nothing is left to move.
#[test]
fn what_loses_its_freedom_on_the_way_rests_where_it_is() {
    mechanisms! {
        Touching { coords { x, y } mass { x: 1.0, y: 1.0 } potential { 9.81 * y } holonomic { round: sq(x) + sq(y) = 1.0, wall: x = 1.0 } }
    }
    let found = equilibrium(Touching::default(), &guess(&[1.0, 0.0]), &[]).expect("rest");
    assert_all_close("place", &found.state.q, &[1.0, 0.0], 1e-7);
    assert_eq!(found.stability, Stability::Stable);
}

mechanisms! {
    Keel {
        coords { x, y, th } mass { x: 1.0, y: 1.0, th: 0.2 }
        potential { sq(x - 1), 3.0 * sq(y), 0.1 * sq(th) }
        nonholonomic { blade: -sin(th) * dot(x) + cos(th) * dot(y) = 0.0 }
    }
}

/// λ² = −2 and −1 wherever the blade stands, and 0 across it: its stiffness is triangular, not symmetric, and no less firm for that.
#[test]
fn what_a_blade_holds_is_told_by_its_modes() {
    for y in [-2.0, -0.7, 0.7, 5.0] {
        let found = equilibrium(Keel::default(), &guess(&[1.0, y, 0.0]), &[]).expect("rest");
        assert_eq!(found.stability, Stability::Neutral, "{y}");
        let found = ukcore::modes(Keel::default(), &found.state).expect("rest");
        let frequencies: Vec<f64> = found.iter().map(|mode| mode.frequency).collect();
        assert_all_close("ω", &frequencies, &[0.0, 1.0, 2.0_f64.sqrt()], 1e-9);
        assert!(found.iter().all(|mode| mode.growth == 0.0), "{found:?}");
    }
}

/// The crank turns all the way, so that the linkage has two branches that never meet. The angle between coupler and rocker keeps its sign
/// in each; the rest position has that of the start, also where a spring would
/// rather have the other one.
#[test]
fn a_mechanism_rests_in_the_branch_in_which_it_starts() {
    let fold = |state: &State| {
        let [_, coupler, rocker] = FourBar::BAR_ANGLE.map(|j| state.q[j]);
        (rocker - coupler).sin()
    };
    let mut signs = [0; 2];
    for k in [0.0, 30.0, 300.0] {
        let linkage = FourBar {
            k,
            fold: -2.0,
            ..FourBar::default()
        };
        for crank in 0..24 {
            for side in [1.0, -1.0] {
                let crank = TAU * f64::from(crank) / 24.0;
                let guess = [
                    ("crank", crank),
                    ("coupler", 0.7 * side),
                    ("rocker", 1.6 * side),
                ];
                let start = linkage.start("open", &guess.into()).unwrap();
                let found = equilibrium(&linkage, &start, &[]).unwrap();
                assert!(
                    fold(&start) * fold(&found.state) > 0.0,
                    "{k} {crank} {side}: {found:?}"
                );
                signs[usize::from(fold(&start) > 0.0)] += 1;
            }
        }
    }
    assert!(signs.iter().all(|count| *count > 30), "{signs:?}");
}

mechanisms! {
    Damped {
        params { l = 1.0, g = 9.81, c = 0.5 }
        coords { a }
        mass { a: sq(l) }
        potential { -g * l * cos(a) }
        dissipation { 0.5 * c * sq(dot(a)) }
    }
    Truss {
        params { k = 1000.0, f = 5.0, c = 0.5 }
        coords { y }
        mass { y: 1 }
        potential { k * sq(hypot(1, y) - 1.1) + f * y }
        force { y: -c * dot(y) * (1 + abs(dot(y))) }
    }
    Wells {
        coords { x }
        mass { x: 1 }
        potential { 0.25 * x.powi(4) - 0.5 * sq(x) }
        nonideal { x: -dot(x) }
    }
    Pushed {
        params { l = 1.0, g = 9.81, push = 0.0 }
        coords { a }
        mass { a: sq(l) }
        potential { -g * l * cos(a) }
        force { a: push * cos(a) - dot(a) }
    }
}

mechanisms! {
    Spun {
        coords { x, y, z }
        mass { x: 1, y: 1, z: 1 }
        potential { 0.5 * (sq(z) - sq(x) - sq(y)) }
        force { x: 10 * dot(y), y: -10 * dot(x), z: -dot(z) }
    }
}

/// A hill, and a damper across.
#[test]
fn what_turns_holds_a_top_whatever_damps_beside_it() {
    let found = equilibrium(Spun::default(), &guess(&[0.1, 0.2, 0.3]), &[]);
    let found = found.expect("the top");
    assert_all_close("at the top", &found.state.q, &[0.0; 3], 1e-9);
    assert_eq!(found.stability, Stability::Neutral);
}

/// What vanishes at rest, as dampers do, leads nowhere: a search falls where a damped motion does, over a top if it must.
#[test]
fn damped_mechanisms_fall_as_undamped_ones_do() {
    fn rests<M: Mechanism>(mechanism: M, from: f64) -> f64 {
        let name = format!("{} from {from}", M::SPEC.name);
        let found = equilibrium(mechanism, &guess(&[from]), &[]);
        let found = found.unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(
            found.stability,
            Stability::Stable,
            "{name}: {:?}",
            found.state.q
        );
        found.state.q[0]
    }
    for from in [0.5, 1.5, 2.0, 2.5, 3.0, 3.1, -2.2] {
        assert_close("a swing", rests(Damped::default(), from), 0.0, 1e-9);
    }
    for from in [0.1, 0.3, 0.5, 0.57, 0.6, 2.0, -0.1] {
        let from: f64 = from;
        assert_close("wells", rests(Wells::default(), from), from.signum(), 1e-9);
    }
    // 2 k (1 − 1.1/√(1 + y²)) y + f = 0.
    let balance = |y: f64, f: f64| 2000.0 * (1.0 - 1.1 / 1.0_f64.hypot(y)) * y + f;
    for (f, from, up) in [
        (5.0, 0.4, true),
        (5.0, 0.1, true),
        (5.0, 0.02, false),
        (5.0, -0.1, false),
        (60.0, 0.4, false),
        (60.0, 0.0, false),
        (60.0, -0.4, false),
    ] {
        let y = rests(
            Truss {
                f,
                ..Truss::default()
            },
            from,
        );
        assert!(
            balance(y, f).abs() < 1e-8 && (y > 0.0) == up,
            "{f}, {from}: {y}"
        );
    }
    // A force that the potential does not have holds it aside, where it is the nearer one.
    let pushed = rests(
        Pushed {
            push: 3.0,
            ..Pushed::default()
        },
        0.2,
    );
    assert_close("pushed", pushed, (3.0_f64 / 9.81).atan(), 1e-9);
}
