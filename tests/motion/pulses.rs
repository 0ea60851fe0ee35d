//! Forces that are switched on and off more often than steps are long, by the time or by an angle that turns fast: pulses, square waves,
//! duty cycles; and switches that depend on the sign of another.

use std::f64::consts::{PI, TAU};

use tests::{apart, at, largest};
use ukcore::{Mechanism, Method, Simulation, State};

/// The stiffness of the springs.
const STIFFNESS: f64 = 4.0;

ukcore::multibody! {
    /// Bodies on springs that are pushed for a part of each turn: of the time's, of a rotor's.
    Pushed {
        params { w = 50.0, f = 3.0, level = 0.95 }
        coords { x, y, a }
        mass { x: 1.0, y: 1.0, a: 1.0 }
        potential { 2.0 * sq(x), 2.0 * sq(y) }
        force {
            x: 0.5 * f * (1.0 + sign(sin(w * t) - level)),
            y: 0.5 * f * (1.0 + sign(sin(a) - level)),
        }
    }
}

ukcore::multibody! {
    /// A body on a spring that is driven by a motor for a part of each period, from its middle on.
    Duty {
        params { w = 50.0, f = 3.0, share = 0.3 }
        coords { x }
        mass { x: 1.0 }
        potential { 2.0 * sq(x) }
        force { x: 0.5 * f * (1.0 + sign(share - acos(-cos(w * t)) / PI)) }
    }
}

ukcore::multibody! {
    /// Bodies that are drawn back, and pushed the way that they move: by a force that grows without bound and is limited, by one whose
    /// direction is the sign of a sum with a sign in it, and by one that is limited in a limit.
    Limited {
        params { g = 2.0, u = 0.5, k = 50.0 }
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        force {
            x: g + max(-u, min(u, k * (1.0 + sq(x)) * sign(dot(x)))),
            y: g + u * sign(k * sign(dot(y)) + 0.1),
            z: g + max(-u, min(u, 2.0 * max(-1.0, min(1.0, k * sign(dot(z)))))),
        }
    }
}

ukcore::multibody! {
    /// A brake that only brakes, within limits that turn with the velocity that it acts against; signs that jump as they get to zero.
    Turning {
        params { l = 0.5 }
        coords { x, brake, y, s, z }
        mass { x: 1.0, brake: 1.0, y: 1.0, s: 1.0, z: 1.0 }
        force {
            x: -x,
            brake: max(-l - l * sign(dot(x)), min(l - l * sign(dot(x)), -2.0 * dot(x))),
            s: sign(y + 0.5 * sign(z)),
        }
    }
}

ukcore::multibody! {
    /// Pushes at places on the way of a body that moves evenly: behind a way where their function has no value, between poles and places
    /// where it touches its zero.
    Places {
        coords { x, a, b, c }
        mass { x: 1.0, a: 1.0, b: 1.0, c: 1.0 }
        force {
            a: max(0.0, 0.001 * sqrt(sq(x) - 1.0) + 0.01 - sq(x - 9.0)),
            b: max(0.0, 0.01 - sq(x - 9.0) - 1e-4 / sq(sin(x))),
            c: max(0.0, -sq(sin(3.0 * x)) * (sq(x - 30.0) - 1.0)),
        }
    }
}

const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];
const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

ukcore::multibody! {
    /// A free body that a rectified sine pushes.
    Rectified {
        params { w = 50.0 }
        coords { x }
        mass { x: 1.0 }
        force { x: abs(sin(w * t)) }
    }
}

/// Runs by all methods end where `end` says.
#[track_caller]
fn check<M: Mechanism>(what: &str, mechanism: &M, start: &State, until: f64, end: &[f64]) {
    for method in METHODS {
        for tolerance in TOLERANCES {
            let run = Simulation::new(mechanism.clone())
                .start(start.clone())
                .method(method)
                .tolerance(tolerance)
                .until(until)
                .unwrap_or_else(|error| panic!("{what}, {method}, {tolerance:e}: {error}"));
            let last = run.last().expect("an end");
            let found = [last.q, last.v].concat();
            let off = apart(&found, end);
            assert!(
                off < 1e2 * tolerance,
                "{what}, {method}, {tolerance:e}: off by {off:e}"
            );
        }
    }
}

/// Where a body on a spring is at `until`, that starts at rest and is pushed by `f` between these shares of each turn.
fn pushed(w: f64, f: f64, [on, off]: [f64; 2], until: f64) -> [f64; 2] {
    let (rate, mut state, mut t) = (STIFFNESS.sqrt(), [0.0, 0.0], 0.0);
    let turns = (until * w / TAU).ceil() as usize;
    let changes = (0..turns).flat_map(|turn| {
        [(on, 0.0), (off, f), (1.0, 0.0)].map(|(share, f)| (turn as f64 + share, f))
    });
    for (turns, force) in changes {
        let next = (TAU * turns / w).min(until);
        let (sin, cos) = (rate * (next - t)).sin_cos();
        let (x, v) = (state[0] - force / STIFFNESS, state[1] / rate);
        state = [
            force / STIFFNESS + x * cos + v * sin,
            rate * (v * cos - x * sin),
        ];
        t = next;
    }
    state
}

#[test]
fn pulses_much_shorter_than_steps_are_all_felt() {
    for w in [7.0, 10.0, 19.0, 30.0, 40.0, 113.0, 400.0] {
        for level in [0.0_f64, 0.95] {
            let from = level.asin() / TAU;
            let [x, v] = pushed(w, 3.0, [from, 0.5 - from], 2.0);
            let pushed = Pushed {
                w,
                level,
                ..Pushed::default()
            };
            let start = at(&[0.0; 3], &[0.0, 0.0, w]);
            let end = [x, x, 2.0 * w, v, v, w];
            check(
                &format!("{w} rad/s above {level}"),
                &pushed,
                &start,
                2.0,
                &end,
            );
        }
    }
}

#[test]
fn a_duty_cycle_keeps_its_share() {
    for w in [15.0, 60.0, 500.0] {
        for share in [0.02, 0.3] {
            let duty = Duty {
                w,
                share,
                ..Duty::default()
            };
            let [x, v] = pushed(w, 3.0, [0.5 - 0.5 * share, 0.5 + 0.5 * share], 2.0);
            check(
                &format!("{w} rad/s for {share}"),
                &duty,
                &at(&[0.0], &[0.0]),
                2.0,
                &[x, v],
            );
        }
    }
}

#[test]
fn pulses_are_felt_late_and_backward() {
    let w = 64.0;
    let period = TAU / w;
    let [x, v] = pushed(w, 3.0, [0.0, 0.5], 20.0 * period);
    let pushed = Pushed {
        w,
        level: 0.0,
        ..Pushed::default()
    };
    for turns in [1e3_f64, 1e5] {
        let t = turns * period;
        let start = State {
            t,
            q: vec![0.0; 3],
            v: vec![0.0, 0.0, w],
        };
        let run = Simulation::new(pushed.clone())
            .start(start)
            .until(t + 20.0 * period);
        let run = run.expect("it is pushed");
        let end = run.last().expect("an end").to_state();
        let off = apart(&[end.q[0], end.q[1], end.v[0], end.v[1]], &[x, x, v, v]);
        assert!(off < 1e-7, "after {turns} turns: off by {off:e}");
        let back = Simulation::new(pushed.clone()).start(end).until(t);
        let back = back.expect("it goes back");
        let off = largest(&back.last().expect("an end").q[..2]);
        assert!(off < 1e-7, "back by {turns} turns: off by {off:e}");
    }
}

#[test]
fn a_limit_turns_with_the_sign_that_it_limits() {
    let (speed, until) = (1.0, 2.0);
    let (before, after) = (1.5, 2.5);
    let left = until - speed / before;
    let x = -0.5 * speed * speed / before + 0.5 * after * left * left;
    let end = [[x; 3], [after * left; 3]].concat();
    check(
        "limited",
        &Limited::default(),
        &at(&[0.0; 3], &[-speed; 3]),
        until,
        &end,
    );
    // From rest it goes where it is drawn.
    let end = [[0.5 * after * until * until; 3], [after * until; 3]].concat();
    check(
        "from rest",
        &Limited::default(),
        &at(&[0.0; 3], &[0.0; 3]),
        until,
        &end,
    );
}

#[test]
fn what_turns_with_another_at_one_zero_is_where_it_has_jumped_to() {
    // The brake is what clamps 2 sin t to 1.
    let brake = 2.0 * (1.0 - 0.75_f64.sqrt()) + PI / 3.0;
    for side in [1.0, -1.0] {
        let q = [1.0, 0.0, 1.5 * side, 0.0, -side];
        let v = [0.0, 0.0, -side, 0.0, side];
        for method in METHODS {
            for tolerance in TOLERANCES {
                let run = Simulation::new(Turning::default())
                    .start(at(&q, &v))
                    .method(method)
                    .tolerance(tolerance);
                let run = run.until(1.5 * PI).expect("nothing sticks");
                let end = run.last().expect("an end");
                // y falls through 1/2 at 1 s, as z rises, and through −1/2 at 2 s.
                let sign = side * (4.0 - 1.5 * PI);
                let off = apart(&[end.v[1], end.v[3]], &[brake, sign]);
                assert!(
                    off < 1e2 * tolerance,
                    "{method}, {tolerance:e}: off by {off:e}"
                );
            }
        }
    }
}

#[test]
fn places_without_a_value_and_poles_hide_no_others() {
    for from in [-20.0, -3.0] {
        let start = at(&[from, 0.0, 0.0, 0.0], &[1.0, 0.0, 0.0, 0.0]);
        let run = |method, tolerance, step| {
            let run = Simulation::new(Places::default())
                .start(start.clone())
                .method(method);
            let run = run.tolerance(tolerance).max_step(step).until(60.0);
            let run = run.expect("it is pushed");
            run.last().expect("an end").v[1..].to_vec()
        };
        let exact = run(Method::Dop853, 1e-10, 5e-3);
        for method in METHODS {
            for tolerance in [1e-4, 1e-8] {
                let off = apart(&run(method, tolerance, 1e3), &exact);
                assert!(
                    off < 1e2 * tolerance,
                    "{from}, {method}, {tolerance:e}: off by {off:e}"
                );
            }
        }
    }
}

#[test]
fn a_rectified_sine_turns_at_each_half_turn() {
    for w in [3.0, 15.0, 64.0, 500.0] {
        // After n half turns: the velocity is that of n halves of a sine, whose mean it has been.
        let rectified = Rectified { w };
        let (half, count) = (PI / w, (2.0 * w / PI).floor());
        let v = 2.0 * count / w;
        let end = [0.5 * v * half * count, v];
        check(
            &format!("{w} rad/s"),
            &rectified,
            &at(&[0.0], &[0.0]),
            half * count,
            &end,
        );
    }
}
