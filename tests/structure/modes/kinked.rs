//! Rest positions at the zero of a switch, where linear motions differ by side or are one.

use std::f64::consts::PI;

use tests::{assert_all_close, assert_close, at_rest};
use ukcore::simulate::Direction;
use ukcore::studies::Stability::{self, Neutral, Stable, Undecided};
use ukcore::{Error, Event, Mechanism, Simulation, State, equilibrium, modes};

macro_rules! mechanisms {
    ($($name:ident { $($body:tt)* })*) => { $(ukcore::multibody! { $name { $($body)* } })* };
}

mechanisms! {
    // A joint that is stiffer in one direction, in three ways to write it.
    Pulled { params { k1 = 100, k2 = 400 } coords { x } mass { x: 1 } potential { 0.5 * k1 * sq(max(0, x)) + 0.5 * k2 * sq(max(0, -x)) } }
    Signed { coords { x } mass { x: 1 } potential { 0.5 * (250 - 150 * sign(x)) * sq(x) } }
    Forced { coords { x } mass { x: 1 } force { x: -250 * x + 150 * abs(x) } }
    // One that two unlike sides hold alike.
    Between { params { k = 1e4 } coords { x } mass { x: 1 } potential { 5 * sq(x) + 0.5 * k * sq(max(0, x)) + 0.5 * k * sq(max(0, -x)) } }
    Gears {
        coords { a, b, c } mass { a: 1, b: 2, c: 0.5 }
        let flanks = |u| 500 * sq(max(0, u)) + 1500 * sq(max(0, -u));
        potential { flanks(a - b), flanks(b - c) }
    }
    Wagons {
        params { length = 12.3 } coords { x[6] } mass { x: 2e4 }
        potential { for i in 0..5 { 1e6 * sq(max(0, length - (x[i + 1] - x[i]))) } }
    }
    Cradle {
        params { m = 0.1, r = 0.0123, l = 0.3, g = 9.81 } coords { a[5] } mass { a: m * sq(l) }
        let along = |i| 2 * r * i + l * sin(a[i]);
        potential { for i in 0..5 { -m * g * l * cos(a[i]) } for i in 0..4 { 5e4 * sq(max(0, 2 * r - (along(i + 1) - along(i)))) } }
    }
    Tether {
        coords { x, y } mass { x: 1, y: 1 }
        potential { 500 * sq(max(0, norm([x, y]) - 1.1)), 1.5 * sq([x - 1.1, y]) }
    }
    // A damper that is harder on its way back.
    Shock { params { back = 5 } coords { x, y } mass { x: 1, y: 1 } potential { 2 * sq(x), sq(y - x) }
        force { x: -max(0, dot(x)) - back * min(0, dot(x)) } }
    Drawn { params { back = 5 } coords { x } mass { x: 1 } force { x: -max(0, dot(x)) - back * min(0, dot(x)) } }
    Led { coords { x, y } mass { x: 1, y: 1 } force { x: -x - 0.5 * y - max(0, dot(x)), y: 0.5 * x - 3 * y - dot(y) } }
    // Forces that are smooth to first order, and dry friction.
    Drag { coords { x } mass { x: 1 } potential { 2 * sq(x) } force { x: -3 * abs(dot(x)) * dot(x) } }
    Cubic { params { k = 5, at = 0.3 } coords { x } mass { x: 1 } force { x: -k * (x - at) * abs(x - at) - (x - at) } }
    Third { params { at = 0.3 } coords { x } mass { x: 1 } potential { 5 * abs(x - at).powi(3) } }
    Rubbing { coords { x, y } mass { x: 1 + sq(y), y: 1 } potential { 2 * sq(x - 1), sq(y) } nonideal { x: -3 * (1 + sq(x)) * sign(dot(x)) } }
    Loaded { params { k = 1e12, high = 1e3 } coords { y } mass { y: 1 } potential { 9.81 * y + 0.5 * k * sq(max(0, high - y)) } }
}

#[track_caller]
fn rests<M: Mechanism>(mechanism: &M, guess: &[f64], stability: Stability) -> State {
    let name = M::SPEC.name;
    let found = equilibrium(mechanism, &at_rest(guess), &[]);
    let found = found.unwrap_or_else(|e| panic!("{name} from {guess:?}: {e}"));
    assert_eq!(found.stability, stability, "{name} from {guess:?}");
    found.state
}

#[track_caller]
fn refused<M: Mechanism>(mechanism: &M, state: &State, term: &str) {
    match modes(mechanism, state) {
        Err(Error::Kink { terms, .. }) if terms.iter().any(|known| known == term) => {}
        found => panic!("{} at {:?}: {found:?}", M::SPEC.name, state.q),
    }
}

#[track_caller]
fn frequencies<M: Mechanism>(mechanism: &M, state: &State, expected: &[f64]) {
    let found = modes(mechanism, state).unwrap_or_else(|e| panic!("{}: {e}", M::SPEC.name));
    let found: Vec<f64> = found.iter().map(|mode| mode.frequency).collect();
    assert_all_close(
        M::SPEC.name,
        &found,
        expected,
        1e-9 * expected[expected.len() - 1],
    );
}

/// The motion takes half a period of each side.
#[test]
fn about_a_kink_there_is_no_linear_motion() {
    for from in [0.0, 0.1, -0.1] {
        let rest = rests(&Pulled::default(), &[from], Stable);
        refused(&Pulled::default(), &rest, "force on `x`");
        refused(
            &Signed::default(),
            &rests(&Signed::default(), &[from], Stable),
            "force on `x`",
        );
        refused(
            &Forced::default(),
            &rests(&Forced::default(), &[from], Undecided),
            "force on `x`",
        );
    }
    let run = Simulation::new(Pulled::default())
        .event(Event::new("back", |_, q, _| q[0]).direction(Direction::Rising))
        .start(at_rest(&[1e-6]))
        .until(2.0)
        .expect("it swings");
    let back = run.all_events();
    assert_close("the period", back[1].t - back[0].t, PI * 0.15, 1e-7);
    // Two springs that it loses on one side, and what hangs in one place by its own weight.
    for place in [1e-8, -1e-8] {
        refused(&Gears::default(), &at_rest(&[0.0; 3]), "force on `a`");
        let side = modes(Pulled::default(), &at_rest(&[1e-3 * place])).expect("near enough");
        assert_close(
            "a side",
            side[0].frequency,
            if place > 0.0 { 10.0 } else { 20.0 },
            1e-9,
        );
    }
    for from in [&[0.0; 3], &[0.1, 0.2, 0.05]] {
        rests(&Gears::default(), from, Undecided);
    }
    let tether = Tether::default();
    refused(
        &tether,
        &rests(&tether, &[1.0, 0.3], Stable),
        "force on `x`",
    );
}

/// Places that are touched are so for the rounding of 12.3 k, too.
#[test]
fn contacts_that_just_touch_do_so_within_rounding() {
    for length in [12.3, 1.0 / 3.0, 7.7e3] {
        let wagons = Wagons { length };
        let touching: Vec<f64> = (0..6).map(|k| length * f64::from(k)).collect();
        refused(&wagons, &at_rest(&touching), "force on `x[1]`");
        let apart: Vec<f64> = (0..6).map(|k| 1.001 * length * f64::from(k)).collect();
        frequencies(&wagons, &at_rest(&apart), &[0.0; 12]);
    }
    let cradle = Cradle::default();
    for from in [[0.0; 5], [-0.3, -0.1, 0.0, 0.1, 0.2]] {
        refused(&cradle, &rests(&cradle, &from, Stable), "force on `a[1]`");
    }
}

/// Where both sides agree their linear motion is that of the place, whichever branch its rounding takes.
#[test]
fn sides_that_agree_have_one_linear_motion() {
    for from in [0.0, 0.1, -0.1] {
        let rest = rests(&Between::default(), &[from], Stable);
        frequencies(&Between::default(), &rest, &[10_010.0_f64.sqrt()]);
        frequencies(
            &Drag::default(),
            &rests(&Drag::default(), &[from], Stable),
            &[2.0],
        );
        frequencies(
            &Cubic::default(),
            &rests(&Cubic::default(), &[0.3 + 5.0 * from], Stable),
            &[1.0],
        );
        frequencies(
            &Rubbing::default(),
            &rests(&Rubbing::default(), &[1.0 + from, from], Stable),
            &[2.0_f64.sqrt(), 2.0],
        );
        let even = Pulled {
            k1: 400.0,
            k2: 400.0,
        };
        frequencies(&even, &rests(&even, &[from], Stable), &[20.0]);
    }
    for from in [0.0, 1.0] {
        rests(&Third::default(), &[from], Stable);
    }
    let loaded = Loaded::default();
    for from in [999.0, 1000.0, 1001.0] {
        frequencies(&loaded, &rests(&loaded, &[from], Stable), &[1e6]);
    }
}

/// Dampers change no verdict of the potential, but the motion.
#[test]
fn a_damper_that_differs_by_direction_leaves_the_verdict() {
    let (shock, even) = (Shock::default(), Shock { back: 1.0 });
    for from in [[0.0; 2], [1.0, 0.3]] {
        refused(&shock, &rests(&shock, &from, Stable), "force on `x`");
        let same = modes(&even, &rests(&even, &from, Stable)).expect("one damper");
        assert!(same.iter().all(|mode| mode.growth < 0.0), "{same:?}");
    }
    let drawn = Drawn::default();
    refused(&drawn, &rests(&drawn, &[0.3], Neutral), "force on `x`");
    refused(
        &Led::default(),
        &rests(&Led::default(), &[0.0; 2], Undecided),
        "force on `x`",
    );
}
