//! What becomes of displacements where no potential tells: by feedback, and beside nonholonomic constraints.

use tests::{assert_all_close, at_rest};
use ukcore::studies::Stability::{self, Neutral, Stable, Unstable};
use ukcore::{Mechanism, Simulation, equilibrium, modes};

macro_rules! mechanisms {
    ($($name:ident { $($body:tt)* })*) => { $(ukcore::multibody! { $name { $($body)* } })* };
}

mechanisms! {
    // A pendulum upside down on a cart, of which a part of the state is fed back.
    Upright {
        params { g = 9.81, back[4] = 0.0 }
        coords { s, a }
        kinetic { 0.5 * 2 * sq(dot(s)) + 0.5 * (sq(dot(s) + cos(a) * dot(a)) + sq(sin(a) * dot(a))) }
        potential { g * cos(a) }
        force { s: -(back[0] * s + back[1] * a + back[2] * dot(s) + back[3] * dot(a)) }
    }
    // A motor whose shaft nothing holds; the current is a coordinate without inertia.
    Motor {
        params { l = 0.05, r = 1.0, ke = 0.3, hold = 0.0 }
        coords { th, i }
        mass { th: 0.01 }
        potential { 0.5 * hold * sq(th) }
        force { th: ke * i - 0.02 * dot(th) }
        nonholonomic { circuit: l * dot(i) = -r * i - ke * dot(th) }
    }
    // A pendulum held at an angle by the integral of what is missing.
    Controlled {
        params { goal = 1.0, kp = 60.0, ki = 80.0, kd = 8.0 }
        coords { a, z }
        mass { a: 0.25 }
        potential { -4.905 * cos(a) }
        force { a: kp * (goal - a) + ki * z - kd * dot(a) }
        nonholonomic { collect: dot(z) = goal - a }
    }
    // A coil that draws a weight on a spring, and one on a rod that it turns.
    Magnet {
        params { u = 1.0, r = 2.0 }
        coords { x, i }
        mass { x: 0.1 }
        potential { 50 * sq(x), 0.981 * x }
        force { x: 0.5 * sq(i) / sq(1 + x) - dot(x) }
        nonholonomic { coil: 0.1 * dot(i) = u - r * i }
    }
    Turned {
        params { ke = 0.3, u = 0.5 }
        coords { x, y, i }
        mass { x: 1, y: 1 }
        potential { 9.81 * y }
        force { x: -ke * i * y - 0.2 * dot(x), y: ke * i * x }
        holonomic { rod: sq(x) + sq(y) = 1 }
        nonholonomic { circuit: 0.05 * dot(i) = u - i - ke * (x * dot(y) - y * dot(x)) }
    }
    Belt { coords { x, y } mass { x: 1, y: 1 } potential { sq(y) } nonholonomic { belt: dot(x) = 2 } }
    // An inflection of the potential, in oil.
    Inflection { coords { x } mass { x: 1 } potential { x.powi(3) } force { x: -3 * dot(x) } }
}

#[track_caller]
fn stability<M: Mechanism>(mechanism: &M, q: &[f64]) -> Stability {
    let found = equilibrium(mechanism, &at_rest(q), &[]);
    found
        .unwrap_or_else(|e| panic!("{} from {q:?}: {e}", M::SPEC.name))
        .stability
}

/// The gains put all eigenvalues of the upright position on the left, though its stiffness is symmetric in nothing.
#[test]
fn feedback_that_drives_all_back_makes_a_position_stable() {
    // λ⁴ + (b₂ − b₃)/2 λ³ + (b₀ − b₁ − 3g)/2 λ² − g/2 (b₂ λ + b₀) with the roots −1, −1.5, −2 and −3.
    let g = Upright::default().g;
    let [place, rate] = [-18.0 / g, -45.0 / g];
    let back = [place, place - 40.0 - 3.0 * g, rate, rate - 15.0];
    let held = Upright { g, back };
    assert_eq!(stability(&held, &[0.0; 2]), Stable);
    let run = Simulation::new(&held).start(at_rest(&[0.0, 0.05]));
    let run = run.until(30.0).expect("it stands");
    let (last, found) = (
        run.last().expect("an end"),
        modes(&held, &at_rest(&[0.0; 2])),
    );
    let mut growths: Vec<f64> = found
        .expect("it rests")
        .iter()
        .map(|mode| mode.growth)
        .collect();
    growths.sort_by(f64::total_cmp);
    assert_all_close("λ", &growths, &[-3.0, -2.0, -1.5, -1.0], 1e-9);
    assert!(last.q.iter().all(|x| x.abs() < 1e-4), "{last:?}");
    // Without, it falls; hanging, with the cart left alone, it goes nowhere; and damping beside an inflection holds nothing.
    assert_eq!(stability(&Upright::default(), &[0.0; 2]), Unstable);
    let hanging = Upright {
        g: -9.81,
        ..Upright::default()
    };
    assert_eq!(stability(&hanging, &[0.0; 2]), Neutral);
    assert_eq!(stability(&Inflection::default(), &[0.1]), Unstable);
}

#[test]
fn a_shaft_that_stays_where_it_is_turned_to_is_not_stable() {
    let motor = Motor::default();
    assert_eq!(stability(&motor, &[0.0; 2]), Neutral);
    let run = Simulation::new(&motor).start(at_rest(&[0.1, 0.0]));
    let turned = run.until(10.0).expect("it rests");
    assert_eq!(turned.last().expect("an end").q, [0.1, 0.0]);
    let hold = 2.0;
    assert_eq!(stability(&Motor { hold, ..motor }, &[0.0; 2]), Stable);
    for (ki, expected) in [
        (80.0, Stable),
        (0.0, Neutral),
        (-10.0, Unstable),
        (3000.0, Unstable),
    ] {
        let held = Controlled {
            goal: 0.0,
            ki,
            ..Controlled::default()
        };
        assert_eq!(stability(&held, &[0.0; 2]), expected, "{ki}");
    }
}

/// The part without velocities of the row has to vanish, too, from wherever the search begins.
#[test]
fn rows_with_a_part_without_velocities_come_to_rest() {
    fn rests<M: Mechanism>(mechanism: &M, guess: &[f64], expected: &[f64], stability: Stability) {
        let found = equilibrium(mechanism, &at_rest(guess), &[]);
        let found = found.unwrap_or_else(|e| panic!("{} from {guess:?}: {e}", M::SPEC.name));
        assert_all_close(M::SPEC.name, &found.state.q, expected, 1e-12);
        assert_eq!(
            found.stability,
            stability,
            "{} from {guess:?}",
            M::SPEC.name
        );
        modes(mechanism, &found.state).unwrap_or_else(|e| panic!("{}: {e}", M::SPEC.name));
    }
    let controlled = Controlled::default();
    let held = [1.0, 4.905 * 1.0_f64.sin() / controlled.ki];
    for guess in [
        held,
        [1.0 + 1e-6, held[1]],
        [1.0, 0.0],
        [0.0; 2],
        [-2.0, 5.0],
    ] {
        rests(&controlled, &guess, &held, Stable);
    }
    for current in [1.0, -3e4, 1e-9, 0.0] {
        rests(&Motor::default(), &[0.7, current], &[0.7, 0.0], Neutral);
        rests(
            &Motor {
                hold: 2.0,
                ..Motor::default()
            },
            &[0.7, current],
            &[0.0; 2],
            Stable,
        );
    }
    // 100 x + 0.981 = ½ i²/(1 + x)².
    let mut x = 0.0;
    for _ in 0..20 {
        x = (0.125 / (1.0_f64 + x).powi(2) - 0.981) / 100.0;
    }
    for guess in [[0.0; 2], [0.3, 0.0], [0.1, -3.0]] {
        rests(&Magnet::default(), &guess, &[x, 0.5], Stable);
    }
    // 9.81 sin = 0.15.
    let sin = 0.15 / 9.81_f64;
    let cos = (1.0 - sin * sin).sqrt();
    for guess in [[0.0, -1.0, 0.0], [0.6, -0.7, 3.0]] {
        rests(&Turned::default(), &guess, &[sin, -cos, 0.5], Stable);
    }
    rests(
        &Turned::default(),
        &[0.3, 0.9, 0.0],
        &[sin, cos, 0.5],
        Unstable,
    );
    let told = equilibrium(Belt::default(), &at_rest(&[0.0; 2]), &[]).expect_err("it runs");
    let told = told.to_string();
    assert!(
        told.contains("`belt` asks for velocities") && !told.contains("time"),
        "{told}"
    );
}
