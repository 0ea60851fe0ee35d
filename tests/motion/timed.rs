//! Switches whose zeros lie at round times and places, where steps are looked at, and motions that stay at a zero.

use tests::at;
use ukcore::simulate::{Direction, Ending};
use ukcore::{Event, Mechanism, Method, Simulation, Trajectory};

ukcore::multibody! {
    /// A thrust between two times.
    Thrust {
        params { a = 1.5, on = 2.0, off = 2.5 }
        coords { x }
        mass { x: 1.0 }
        force { x: a * (sign(t - on) - sign(t - off)) / 2.0 }
    }
}

ukcore::multibody! {
    /// A field between two plates.
    Plates {
        params { a = 0.3, from = 2.0, to = 2.5 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        force { y: a * (sign(x - from) - sign(x - to)) / 2.0 }
    }
}

ukcore::multibody! {
    /// A force that rises from one time to the next, and falls to the third one.
    Pulse {
        params { h = 10.0, s[3] = [1.0, 1.5, 2.0] }
        coords { x }
        mass { x: 1.0 }
        let up = s[1] - s[0];
        let down = s[2] - s[1];
        force { x: h * (max(0.0, t - s[0]) / up - max(0.0, t - s[1]) * (1.0 / up + 1.0 / down) + max(0.0, t - s[2]) / down) }
    }
}

ukcore::multibody! {
    /// A motor with a trapezoidal velocity.
    Motor {
        params { a = 1.0, s[3] = [1.0, 2.0, 3.0] }
        coords { x }
        mass { x: 2.0 }
        holonomic {
            motor: x = 0.5 * a * (sq(max(0.0, t)) - sq(max(0.0, t - s[0])) - sq(max(0.0, t - s[1])) + sq(max(0.0, t - s[2])))
        }
    }
}

ukcore::multibody! {
    /// A block that a spring holds on a belt with friction.
    Belt {
        params { k = 100.0, f = 5.0, speed = 0.3 }
        coords { x }
        mass { x: 1.0 }
        force { x: -k * x - f * sign(dot(x) - speed) }
    }
}

const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];

fn run(mechanism: impl Mechanism + 'static, v: f64, method: Method, end: f64) -> Trajectory {
    let n = ukcore::Prepared::from(&mechanism).spec().n();
    let mut rates = vec![0.0; n];
    rates[0] = v;
    let start = at(&vec![0.0; n], &rates);
    let run = Simulation::new(mechanism)
        .start(start)
        .method(method)
        .until(end);
    run.unwrap_or_else(|failure| panic!("{method}: {failure}"))
}

/// Halves, eighths and others, and ends that make parts of steps of them.
fn times() -> impl Iterator<Item = [f64; 3]> {
    let ends = [4.0, 5.0, 8.0, 12.0];
    let spans = (1..8).flat_map(|i| (1..6).map(move |k| [0.5 * f64::from(i), 0.5 * f64::from(k)]));
    let each = spans.flat_map(move |[from, span]| ends.map(|end| [from, from + span, end]));
    each.filter(|[_, to, end]| to < end)
}

#[test]
fn a_thrust_between_round_times_gives_its_momentum() {
    for method in METHODS {
        for [on, off, end] in times() {
            let thrust = Thrust {
                on,
                off,
                ..Thrust::default()
            };
            let ran = run(thrust, 0.0, method, end);
            let v = ran.last().expect("an end").v[0];
            assert!(
                (v - 1.5 * (off - on)).abs() < 1e-7,
                "{method}, {on}, {off}, {end}: {v}"
            );
        }
    }
}

#[test]
fn a_field_between_round_places_turns_what_goes_through() {
    for method in METHODS {
        for [from, to, end] in times() {
            for v in [1.0, 2.0] {
                let plates = Plates {
                    from,
                    to,
                    ..Plates::default()
                };
                let ran = run(plates, v, method, end);
                let side = ran.last().expect("an end").v[1];
                let time = (to.min(v * end) - from.min(v * end)) / v;
                assert!(
                    (side - 0.3 * time).abs() < 1e-7,
                    "{method}, {from}, {to}, {end}: {side}"
                );
            }
        }
    }
}

#[test]
fn a_pulse_with_round_corners_gives_its_way() {
    for method in METHODS {
        for [from, to, end] in times() {
            let s = [from, to, 2.0 * to - from];
            let (h, cube) = (10.0, |s: f64| (end - s).max(0.0).powi(3) / 6.0);
            let (up, down) = (s[1] - s[0], s[2] - s[1]);
            let way = cube(s[0]) / up - cube(s[1]) * (1.0 / up + 1.0 / down) + cube(s[2]) / down;
            let ran = run(Pulse { h, s }, 0.0, method, end);
            let x = ran.last().expect("an end").q[0];
            let most = 1e-7 * (1.0 + h * way);
            assert!(
                (x - h * way).abs() < most,
                "{method}, {s:?}, {end}: {x} for {}",
                h * way
            );
        }
    }
}

#[test]
fn a_motor_with_round_times_gets_there() {
    for method in METHODS {
        for [from, to, end] in times() {
            let motor = Motor {
                s: [from, to, from + to],
                ..Motor::default()
            };
            let s = motor.s;
            let ran = run(motor, 0.0, method, end);
            let part = |s: f64| 0.5 * (end - s).max(0.0).powi(2);
            let way = part(0.0) - part(s[0]) - part(s[1]) + part(s[2]);
            let x = ran.last().expect("an end").q[0];
            assert!(
                (x - way).abs() < 1e-8,
                "{method}, {s:?}, {end}: {x} for {way}"
            );
        }
    }
}

/// The block takes the belt's speed and sticks: there a run ends, if its velocity is that of a terminal event, and else with its term.
#[test]
fn a_block_that_sticks_to_its_belt_ends_the_run_there() {
    for method in METHODS {
        for speed in [0.3, 0.25, 0.1, 0.35] {
            for x in [0.0, 0.01, -0.01] {
                for direction in [Direction::Both, Direction::Rising] {
                    let place = format!("{method}, {speed}, {x}, {direction:?}");
                    let start = at(&[x], &[0.0]);
                    let simulation = || {
                        let belt = Belt {
                            speed,
                            ..Belt::default()
                        };
                        Simulation::new(belt).start(start.clone()).method(method)
                    };
                    let stick =
                        || Event::new("stick", move |_, _, v| v[0] - speed).direction(direction);
                    let ran = simulation().event(stick().terminal()).until(10.0);
                    let ran = ran.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                    assert_eq!(ran.ending(), Ending::Event, "{place}");
                    assert_eq!(ran.events("stick").map_or(0, Iterator::count), 1, "{place}");
                    // (x̄ + x) cos ωt − x̄ with x̄ = −f/k, so v² = ω² ((x − f/k)² − (x(t) − f/k)²).
                    let end = ran.last().expect("an end");
                    let (from, to) = (x - 0.05, end.q[0] - 0.05);
                    let v = 10.0 * (from * from - to * to).max(0.0).sqrt();
                    assert!(
                        (v - speed).abs() < 1e-6 && (end.v[0] - speed).abs() < 1e-7,
                        "{place}"
                    );
                    // One that does not end it is taken, too.
                    let told = simulation()
                        .event(stick())
                        .until(10.0)
                        .expect_err("it sticks");
                    assert!(told.to_string().contains("force on `x`"), "{place}: {told}");
                    let taken = told.trajectory.events("stick").ok();
                    let last = taken.and_then(Iterator::last).expect("it is taken").t;
                    let end = told.trajectory.last().expect("it has begun").t;
                    assert!((last - end).abs() < 1e-8, "{place}: {last}, {end}");
                }
            }
        }
    }
}
