//! Switches and events whose functions are beyond their zeros for a moment only, on a way that long steps go over: contact with a stiff
//! stop after free flight, pulses of a force that is zero else, bounces shorter than a step.

use tests::at;
use ukcore::simulate::Direction;
use ukcore::{Event, Mechanism, Method, Simulation, State};

ukcore::multibody! {
    /// Two equal discs that repel each other while they overlap.
    Discs {
        params { k = 1e6, d = 0.1 }
        coords { a[2], b[2] }
        mass { a: 1.0, b: 1.0 }
        potential { 0.5 * k * sq(max(0.0, d - norm(b - a))) }
    }
}

ukcore::multibody! {
    /// A ball under a stiff ceiling; y points up.
    Ceiling {
        params { k = 1e6, h = 1.0, g = 10.0 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { g * y, 0.5 * k * sq(max(0.0, y - h)) }
    }
}

ukcore::multibody! {
    /// A swing with a bumper just below its amplitude.
    Bumper {
        params { w = 2.0, k = 1e4 }
        coords { x }
        mass { x: 1.0 }
        potential { 0.5 * sq(w * x), 0.5 * k * sq(max(0.0, x - 1.0)) }
    }
}

ukcore::multibody! {
    /// A free body that is pushed at each top of a sine.
    Pulses {
        params { w = 20.0, f = 1000.0, c = 0.999 }
        coords { x }
        mass { x: 1.0 }
        force { x: f * max(0.0, sin(w * t) - c) }
    }
}

ukcore::multibody! {
    /// A body on a road with one bump, over which its height pushes it aside.
    Road {
        params { w = 0.05, h = 0.02 }
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        let s = max(0.0, 1.0 - sq((x - 5.0) / w));
        holonomic { road: y = h * s * s * s }
        force { z: 1e4 * y }
    }
}

ukcore::multibody! {
    /// A ball; y points up.
    Ball {
        params { g = 9.81 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { g * y }
    }
}

const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];
const TOLERANCES: [f64; 3] = [1e-6, 1e-9, 1e-12];

/// What is off at the end of runs by all methods, which must be less than some errors of a step.
#[track_caller]
fn check<M: Mechanism>(mechanism: &M, start: &State, end: f64, off: impl Fn(&State) -> f64) {
    for method in METHODS {
        for tolerance in TOLERANCES {
            let run = Simulation::new(mechanism.clone())
                .start(start.clone())
                .method(method)
                .tolerance(tolerance)
                .until(end)
                .unwrap_or_else(|error| panic!("{method}, {tolerance:e}: {error}"));
            let off = off(&run.last().expect("an end").to_state());
            let most = (1e3 * tolerance).max(1e-10);
            assert!(off < most, "{method}, {tolerance:e}: off by {off:e}");
        }
    }
}

#[test]
fn discs_that_meet_head_on_change_places() {
    for gap in [0.5, 5.0, 50.0] {
        let start = at(&[-gap, 0.0, 0.0, 0.0], &[1.0, 0.0, 0.0, 0.0]);
        let swapped = |end: &State| (end.v[0].abs()).max((end.v[2] - 1.0).abs());
        check(&Discs::default(), &start, 2.0 * gap, swapped);
    }
}

#[test]
fn discs_that_graze_keep_energy_and_momentum_and_part() {
    for offset in [0.05, 0.09, 0.0999] {
        let start = at(&[-5.0, offset, 0.0, 0.0], &[1.0, 0.0, 0.0, 0.0]);
        // The first one has given off what it had along the line between both, to the spring's finite turn of it.
        let off = |end: &State| {
            let energy: f64 = end.v.iter().map(|v| v * v).sum();
            let met = end.v[2].hypot(end.v[3]) > 1e-4;
            let momentum = (end.v[0] + end.v[2] - 1.0).abs();
            let kept = (energy - 1.0).abs().max(momentum);
            if met { kept } else { f64::INFINITY }
        };
        check(&Discs::default(), &start, 10.0, off);
    }
}

#[test]
fn a_ball_thrown_a_little_too_high_meets_the_ceiling() {
    let (k, h, g) = (1e6_f64, 1.0, 10.0_f64);
    for above in [1e-1, 1e-2, 1e-3, 1e-4] {
        let (speed, met) = (2.0 * g * (h + above), 2.0 * g * above);
        let (speed, met) = (speed.sqrt(), met.sqrt());
        // In contact z = y − h follows z'' = −g − k z.
        let w = k.sqrt();
        let contact = 2.0 * (met / w).atan2(g / k) / w;
        let end = (speed - met) / g + contact + 0.3;
        let y = h - met * 0.3 - 0.5 * g * 0.09;
        let start = at(&[0.0, 0.0], &[0.5, speed]);
        check(&Ceiling::default(), &start, end, |end| (end.q[1] - y).abs());
    }
}

#[test]
fn a_swing_meets_its_bumper_at_each_turn() {
    let (w, k) = (2.0_f64, 1e4_f64);
    for depth in [1e-2_f64, 1e-4] {
        let most = 1.0 + depth;
        // In contact it swings about the middle of both springs.
        let (rate, met) = ((w * w + k).sqrt(), w * (most * most - 1.0).sqrt());
        let middle = k / (w * w + k);
        let contact = 2.0 * (met / rate).atan2(1.0 - middle) / rate;
        let free = 2.0 * (std::f64::consts::PI - (1.0 / most).acos()) / w;
        let run = Simulation::new(Bumper::default())
            .start(at(&[-most], &[0.0]))
            .until(20.0 * (free + contact))
            .expect("the swing swings");
        let off = (run.last().expect("an end").q[0] + most).abs();
        assert!(off < 1e-6, "{depth:e}: off by {off:e}");
    }
}

#[test]
fn pulses_of_a_force_that_is_zero_else_are_all_felt() {
    let (w, f, c) = (20.0_f64, 1000.0, 0.999_f64);
    let pulse = 2.0 * f / w * ((1.0 - c * c).sqrt() - c * c.acos());
    let off = |end: &State| (end.v[0] / (32.0 * pulse) - 1.0).abs();
    check(&Pulses::default(), &at(&[0.0], &[0.0]), 10.0, off);
}

#[test]
fn a_bump_that_a_step_would_leap_is_felt() {
    // Energy keeps ẋ² + ẏ² at 1, so ż is ∫ 10⁴ y √(1 + y'²) dx: by Simpson's rule.
    for w in [5e-2, 2e-2, 1e-2] {
        bump(w);
    }
}

fn bump(w: f64) {
    let (h, parts) = (0.4 * w, 2000);
    let push = |k: usize| {
        let u = 2.0 * k as f64 / parts as f64 - 1.0;
        let s = 1.0 - u * u;
        let (y, slope) = (h * s * s * s, -6.0 * h * s * s * u / w);
        1e4 * y * slope.hypot(1.0)
    };
    let weight = |k: usize| match k {
        0 => 1.0,
        k if k == parts => 1.0,
        k if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let sum: f64 = (0..=parts).map(|k| weight(k) * push(k)).sum();
    let aside = sum * 2.0 * w / parts as f64 / 3.0;
    let start = at(&[0.0; 3], &[1.0, 0.0, 0.0]);
    let road = Road { w, h };
    check(&road, &start, 10.0, |end| (end.v[2] / aside - 1.0).abs());
}

#[test]
fn a_ball_that_is_thrown_back_from_the_floor_never_falls_through() {
    for method in METHODS {
        for tolerance in [1e-3, 1e-5, 1e-7, 1e-9] {
            for i in 0..5 {
                let mut start = at(&[0.0, 1.0 + 0.17 * f64::from(i)], &[1.0, 0.0]);
                for bounce in 0..25 {
                    let floor = Event::new("floor", |_, q, _| q[1]);
                    let run = Simulation::new(Ball::default())
                        .method(method)
                        .tolerance(tolerance)
                        .start(start)
                        .event(floor.direction(Direction::Falling).terminal())
                        .until(10.0)
                        .expect("the ball flies");
                    start = run.last().expect("an end").to_state();
                    let label = format!("{method}, {tolerance:e}, {i}, bounce {bounce}");
                    assert!(start.q[1].abs() < 1e-9, "{label}: at {:e}", start.q[1]);
                    start.v[1] *= -0.8;
                }
            }
        }
    }
}

/// Hops of 0.1 s to a microsecond, from the floor, from a rounding above it and below, with the whole fall behind them in one run.
#[test]
fn a_hop_is_seen_however_short_it_is() {
    for method in METHODS {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            for (vx, y) in [0.0, 1.0]
                .into_iter()
                .flat_map(|vx| [0.0, -8e-17, 1e-17].map(|y| (vx, y)))
            {
                for time in [0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
                    let floor = Event::new("floor", |_, q, _| q[1]);
                    let run = Simulation::new(Ball::default())
                        .method(method)
                        .tolerance(tolerance)
                        .start(at(&[0.0, y], &[vx, 0.5 * 9.81 * time]))
                        .event(floor.direction(Direction::Falling).terminal())
                        .until(5.0)
                        .expect("the ball flies");
                    let end = run.last().expect("an end").t;
                    let label = format!("{method}, {tolerance:e}, {vx}, {y:e}, {time:e}: {end:e}");
                    assert!((end / time - 1.0).abs() < 1e-3, "{label}");
                }
            }
        }
    }
}

/// A ball that flies while something else turns: steps are as long as the flight allows, with hundreds of turns within each.
#[test]
fn turns_within_a_step_are_all_counted() {
    for method in METHODS {
        for rate in [0.5, 5.0, 50.0, 500.0, 2000.0] {
            let turns = Event::new("turns", move |t, _, _| (rate * t + 0.1).sin());
            // It jumps each time.
            let laps = Event::new("laps", move |t, _, _| (rate * t).rem_euclid(6.0) - 3.0);
            let run = Simulation::new(Ball::default())
                .method(method)
                .start(at(&[0.0, 1.0], &[1.0, 0.0]))
                .event(turns)
                .event(laps.direction(Direction::Rising))
                .until(10.0)
                .expect("the ball flies");
            let count = |name: &str| run.events(name).expect("an event").count() as f64;
            let all = ((rate * 10.0 + 0.1) / std::f64::consts::PI).floor();
            assert_eq!(count("turns"), all, "{method}, {rate}");
            assert_eq!(
                count("laps"),
                ((rate * 10.0 + 3.0) / 6.0).floor(),
                "{method}, {rate}"
            );
        }
    }
}

/// The evaluations of an event in a run of a swing from rest at 1, and its zeros.
fn watched(
    start: f64,
    (method, tolerance): (Method, f64),
    function: impl Fn(f64, f64) -> f64 + 'static,
) -> (usize, Vec<f64>) {
    let calls = std::rc::Rc::new(std::cell::Cell::new(0));
    let counted = std::rc::Rc::clone(&calls);
    let event = Event::new("event", move |t, q, _| {
        counted.set(counted.get() + 1);
        function(t, q[0])
    });
    let run = Simulation::new(Bumper { k: 0.0, w: 1.0 })
        .method(method)
        .tolerance(tolerance)
        .start(State {
            t: start,
            ..at(&[1.0], &[0.0])
        })
        .event(event)
        .until(start + 10.0)
        .expect("it swings");
    let hits = run.events("event").expect("an event");
    (calls.get(), hits.map(|hit| hit.t - start).collect())
}

/// What does not change, jumps, or is nothing but rounding is looked at seldom, and found; nor are steps refused for it for long.
#[test]
fn events_that_are_not_smooth_are_looked_at_seldom() {
    let rattle = Method::Rattle { step: 0.01 };
    for method in METHODS.into_iter().chain([rattle]) {
        for tolerance in [1e-4, 1e-8, 1e-12] {
            for start in [0.0, 1e4] {
                let name = format!("{method}, {tolerance:e}, {start:e}");
                let pair = (method, tolerance);
                let (plain, _) = watched(start, pair, |_, x| x + 3.0);
                for constant in [0.1, 1.0, -1e-300] {
                    let (calls, hits) = watched(start, pair, move |_, _| constant);
                    assert!(
                        hits.is_empty() && calls <= 2 * plain,
                        "{name}: {calls} {plain}"
                    );
                }
                let (calls, hits) = watched(start, pair, |_, x| if x > 0.0 { 1.0 } else { -1.0 });
                assert!(
                    hits.len() == 3 && calls < 3 * plain + 1500,
                    "{name}: {calls} {hits:?}"
                );
                let (_, hits) = watched(start, pair, move |t, _| t - start - 2.51);
                assert!(
                    hits.len() == 1 && (hits[0] - 2.51).abs() < 1e-9,
                    "{name}: {hits:?}"
                );
                // It is at rest where it starts: no zero is passed.
                let (_, hits) = watched(start, pair, |_, x| x - 1.0);
                assert!(hits.iter().all(|t| *t > 6.0), "{name}: {hits:?}");
                let (calls, _) = watched(start, pair, move |t, x| x - (t - start).cos());
                assert!(calls < 200_000, "{name}: {calls}");
            }
        }
    }
    // Steps of one size cannot be shorter.
    let (_, hits) = watched(0.0, (rattle, 1e-6), |t, _| {
        if t > 0.0251 && t < 0.0349 { 1.0 } else { -1.0 }
    });
    assert!(
        hits.len() == 2 && (hits[0] - 0.0251).abs() < 1e-9,
        "{hits:?}"
    );
}

/// An event that is nothing but rounding does not take a run longer than a moment.
#[test]
fn noise_is_not_looked_at_for_long() {
    let noise = Event::new("noise", |t, q, _| q[0] - t);
    let run = Simulation::new(Ball::default())
        .start(at(&[0.0, 1.0], &[1.0, 0.0]))
        .max_step(0.01)
        .event(noise)
        .until(10.0)
        .expect("the ball flies");
    assert!(run.work().steps < 1100, "{}", run.work().steps);
}
