//! Switches that stay at their zeros but for rounding: contacts that touch, ropes that are neither taut nor slack; a play, within which
//! what is left beyond it is zero all along; functions whose terms all but cancel along the motion.

use tests::{apart, at, cause};
use ukcore::simulate::Switching::{self, Ignored, Located};
use ukcore::{Error, Mechanism, Method, Simulation, State, Trajectory};

ukcore::multibody! {
    /// Five pendulums side by side whose balls touch.
    Cradle {
        params { m = 0.1, r = 0.02, l = 0.3, k = 1e5, g = 9.81 }
        coords { a[5] }
        mass { a: m * l * l }
        let x = |i| 2.0 * r * i + l * sin(a[i]);
        potential {
            for i in 0..5 { m * g * l * (1.0 - cos(a[i])) }
            for i in 0..4 { 0.5 * k * sq(max(0.0, 2.0 * r - (x(i + 1) - x(i)))) }
        }
    }
}

ukcore::multibody! {
    /// Points on a rope that hangs on the ground, and pulls alone; y points up.
    Rope {
        params { m = 0.1, h = 0.1, k = 1e4, g = 9.81 }
        coords { p[6][2] }
        mass { p: m }
        potential {
            m * g * sum(0..6, |i| p[i][1]),
            0.5 * k * sq(max(0.0, norm(p[0]) - h)),
            for i in 0..5 { 0.5 * k * sq(max(0.0, norm(p[i + 1] - p[i]) - h)) }
        }
    }
}

ukcore::multibody! {
    /// A relay with a dead zone: the sign of what is left beyond it, and by the signs of its two ends.
    Relay {
        params { d = 0.1 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        let beyond = |e| e - max(-d, min(d, e));
        force {
            x: -sign(beyond(x)) - 0.05 * dot(x),
            y: -0.5 * (sign(y - d) + sign(y + d)) - 0.05 * dot(y),
        }
    }
}

ukcore::multibody! {
    /// A relay without, whose limits leave room for its sign alone: at rest it is friction.
    Rubbing {
        coords { x }
        mass { x: 1.0 }
        force { x: -max(-1.0, min(1.0, 20.0 * (x + 0.2 * sign(dot(x))))) }
    }
}

ukcore::multibody! {
    /// A pendulum on a rod beside a rope that is all but as long.
    Slack {
        params { k = 1e4, l = 1.0001, g = 9.81 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { g * y, 0.5 * k * sq(max(0.0, norm([x, y]) - l)) }
        holonomic { rod: hypot(x, y) = 1.0 }
    }
}

const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];

#[track_caller]
fn run<M: Mechanism>(
    mechanism: &M,
    start: &[f64],
    until: f64,
    (method, tolerance, switching): (Method, f64, Switching),
) -> Trajectory {
    let start = at(start, &vec![0.0; start.len()]);
    let run = Simulation::new(mechanism.clone())
        .start(start)
        .method(method);
    let run = run
        .tolerance(tolerance)
        .switching(switching)
        .max_steps(20_000);
    run.until(until)
        .unwrap_or_else(|error| panic!("{method}, {tolerance:e}: {error}"))
}

fn end(run: &Trajectory) -> Vec<f64> {
    let State { q, v, .. } = run.last().expect("an end").to_state();
    [q, v].concat()
}

#[test]
fn contacts_that_touch_hold_no_run_up() {
    for angle in [-0.24, -0.4, -0.66] {
        let start = [angle, 0.0, 0.0, 0.0, 0.0];
        let exact = end(&run(
            &Cradle::default(),
            &start,
            0.6,
            (Method::Dop853, 1e-12, Ignored),
        ));
        for method in METHODS {
            for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
                let run = run(
                    &Cradle::default(),
                    &start,
                    0.6,
                    (method, tolerance, Located),
                );
                let off = apart(&end(&run), &exact);
                let most = (1e3 * tolerance).max(1e-8);
                assert!(
                    off < most,
                    "{angle}, {method}, {tolerance:e}: off by {off:e}"
                );
            }
        }
    }
}

#[test]
fn a_rope_falls_from_its_length() {
    let start: Vec<f64> = (1..7).flat_map(|i| [0.0, -0.1 * f64::from(i)]).collect();
    let exact = end(&run(
        &Rope::default(),
        &start,
        0.2,
        (Method::Dop853, 1e-12, Ignored),
    ));
    for method in METHODS {
        let run = run(&Rope::default(), &start, 0.2, (method, 1e-9, Located));
        let off = apart(&end(&run), &exact);
        assert!(off < 1e-5, "{method}: off by {off:e}");
    }
}

#[test]
fn nothing_is_left_beyond_a_play_within_it() {
    for method in METHODS {
        for tolerance in [1e-4, 1e-8, 1e-12] {
            let run = run(
                &Relay::default(),
                &[1.0, 1.0],
                12.0,
                (method, tolerance, Located),
            );
            let [x, y, v, w] = end(&run)[..] else {
                unreachable!()
            };
            let off = (x - y).abs().max((v - w).abs());
            assert!(
                off < 1e3 * tolerance,
                "{method}, {tolerance:e}: apart by {off:e}"
            );
            assert!(
                x.abs() > 0.3 && v.abs() > 0.7,
                "{method}, {tolerance:e}: {x} {v}"
            );
        }
    }
}

#[test]
fn a_sign_in_limits_that_stops_a_motion_is_told() {
    for method in METHODS {
        let run = Simulation::new(Rubbing::default()).method(method);
        let run = run.start(at(&[1.0], &[0.0])).max_steps(1000).until(12.0);
        let error = run.expect_err("it sticks").error;
        assert!(
            matches!(cause(&error).1, Error::Chattering { .. }),
            "{method}: {error}"
        );
    }
}

#[test]
fn steps_along_what_stays_near_its_zero_are_as_long_as_others() {
    for method in METHODS {
        for tolerance in [1e-6, 1e-10] {
            let [located, ignored] = [Located, Ignored].map(|switching| {
                run(
                    &Slack::default(),
                    &[1.0, 0.0],
                    2.0,
                    (method, tolerance, switching),
                )
            });
            let [located, ignored] = [located.work(), ignored.work()];
            assert_eq!(located.steps, ignored.steps, "{method}, {tolerance:e}");
            assert_eq!(
                located.rejected, ignored.rejected,
                "{method}, {tolerance:e}"
            );
        }
    }
}

ukcore::multibody! {
    /// Two bodies with a spring between them that pushes alone, far from the origin.
    Distant {
        params { far = 1e8, k = 1e4 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { 0.5 * k * sq(max(0.0, (x + far) - (y + far) - 0.1)) }
    }
}

/// What rounding hides of the gap takes no part in the motion: they do not stick to each other while it does.
#[test]
fn bodies_far_away_part_after_they_have_met() {
    let (speed, k) = (0.01, Distant::default().k);
    let until = 0.2 / speed + std::f64::consts::PI / (2.0 * k).sqrt() + 0.5;
    for method in METHODS {
        for tolerance in [1e-5, 1e-7] {
            let run = Simulation::new(Distant::default())
                .method(method)
                .tolerance(tolerance)
                .start(at(&[0.0, 0.1], &[speed, 0.0]))
                .until(until);
            let run = run.unwrap_or_else(|e| panic!("{method}, {tolerance:e}: {e}"));
            let off = apart(run.last().expect("an end").v, &[0.0, speed]);
            assert!(off < 1e-3 * speed, "{method}, {tolerance:e}: {off:e}");
        }
    }
}

ukcore::multibody! {
    /// A push that turns as another body, far slower and nearer to its zero, goes through that.
    Creeping {
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        force { y: sign(x) }
    }
}

#[test]
fn what_creeps_through_its_zero_turns_there_however_near_it_is() {
    for (rate, part) in [(1e-6, 1e-9), (1e-12, 1e-9), (1e-12, 0.3), (1e-15, 1e-3)] {
        for method in METHODS {
            let run = Simulation::new(Creeping::default())
                .method(method)
                .start(at(&[-rate * part, 1.0], &[rate, 0.0]))
                .until(1.0)
                .unwrap_or_else(|e| panic!("{method}, {rate:e}: {e}"));
            let rest = 1.0 - part;
            let end = 1.0 - 0.5 * part * part - part * rest + 0.5 * rest * rest;
            let off = (run.last().expect("an end").q[1] - end).abs();
            assert!(off < 1e-8, "{method}, {rate:e}, {part}: {off:e}");
        }
    }
}
