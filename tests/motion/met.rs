//! States on a crossing of branches to rounding, and beside one: samples, states between them, ends of runs and of steps have the velocity
//! of their branch, though nothing but rounding gives the row that vanishes there a direction. And states where a motion turns.

use std::f64::consts::PI;

use tests::{at, at_rest};
use ukcore::{Event, Method, Simulation, State, Trajectory};

ukcore::multibody! {
    /// A parallelogram in angles relative to each other: along the line of the axles the row of its closing along that line vanishes.
    pub Parallelogram {
        params { l = 0.3, span = 1.0, g = 0.0 }
        bodies { for i in 0..3 { planar b[i] { mass: 1, inertia: 0.1 * sq(l), centre: [l / 2.0, 0] } } }
        gravity { [0, -g] }
        tree {
            o: pin(ground.at([0, 0]), b[0].at([0, 0]))
            k: pin(b[0].at([l, 0]), b[1].at([0, 0]))
            r: pin(ground.at([span, 0]), b[2].at([0, 0]))
        }
        holonomic { c: pin(b[1].at([span, 0]), b[2].at([l, 0])) }
    }
}

ukcore::multibody! {
    /// A slider-crank with equal arms, driven evenly.
    Driven {
        params { w = PI }
        coords { a, b, x }
        mass { a: 1, b: 1, x: 1 }
        holonomic { l: [cos(a) + cos(b), sin(a) + sin(b)] = [x, 0], m: a = w * t }
    }
}

ukcore::multibody! {
    /// A bead on a ring with a spring.
    Ring {
        params { k = 30.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        potential { 0.5 * k * sq(x - 0.6) }
        holonomic { ring: sq(x) + sq(y) = 1 }
    }
}

const METHODS: [(Method, f64); 5] = [
    (Method::Dop853, 1e-6),
    (Method::Dop853, 1e-9),
    (Method::Dop853, 1e-12),
    (Method::Dopri5, 1e-6),
    (Method::Radau5, 1e-6),
];

/// Crank, coupler and rocker at an angle, and at a rate.
fn turning(angle: f64, rate: f64) -> State {
    at(&[angle, -angle, angle], &[rate, -rate, rate])
}

/// The largest difference of velocities, at times that are quarters, from what `velocity` has.
fn off(states: impl Iterator<Item = State>, velocity: impl Fn(f64) -> [f64; 3]) -> f64 {
    let off = |s: State| {
        let pairs = s.v.into_iter().zip(velocity(s.t));
        pairs.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
    };
    states.map(off).fold(0.0, f64::max)
}

fn samples(run: &Trajectory) -> impl Iterator<Item = State> {
    run.samples().map(|s| s.to_state())
}

#[test]
fn states_on_crossings_have_the_velocity_of_their_branch() {
    let even = |_t: f64| [PI, -PI, PI];
    let slider = |t: f64| [PI, -PI, -2.0 * PI * (PI * t).sin()];
    let out = at(&[0.0, 0.0, 2.0], &[PI, -PI, 0.0]);
    for (method, tolerance) in METHODS {
        let place = format!("{method}, {tolerance:e}");
        let bound = (3.0 * tolerance).max(1e-8);
        let parallelogram = || {
            let run = Simulation::new(Parallelogram::default()).method(method);
            run.tolerance(tolerance).start(turning(-0.5 * PI, PI))
        };
        let driven = || {
            let run = Simulation::new(Driven::default()).method(method);
            run.tolerance(tolerance).start(out.clone())
        };
        let quarters = || (0..=41).map(|k| 0.25 * f64::from(k));
        let run = parallelogram().every(0.25).until(10.25).expect("a motion");
        let worst = off(samples(&run), even);
        assert!(worst < bound, "{place}: {worst:e} in samples");
        let run = parallelogram().dense().until(10.25).expect("a motion");
        let worst = off(quarters().map(|t| run.at(t).expect("a state")), even);
        assert!(worst < bound, "{place}: {worst:e} between samples");
        let run = driven().dense().until(10.25).expect("a motion");
        let worst = off(quarters().map(|t| run.at(t).expect("a state")), slider);
        assert!(worst < bound, "{place}: {worst:e} between samples, driven");
        for step in [0.05, 0.25, 0.5] {
            let run = parallelogram().max_step(step).until(5.0).expect("a motion");
            let worst = off(samples(&run), even);
            assert!(worst < bound, "{place}: {worst:e} by steps of {step}");
        }
    }
}

#[test]
fn ends_on_crossings_and_beside_them_have_the_velocity_of_their_branch() {
    for (method, tolerance) in METHODS {
        // The one of the hunt whose step ends on it to rounding, and others.
        for rate in [
            13.0,
            12.0 + 10.0 * (26.0 * 0.618_033_988_7_f64).fract(),
            19.3,
        ] {
            let falling = || {
                let mechanism = Parallelogram {
                    g: 9.81,
                    ..Parallelogram::default()
                };
                let run = Simulation::new(mechanism).start(turning(0.4, rate));
                run.method(method).tolerance(tolerance)
            };
            let fold = Event::new("fold", |_t, q, _v| q[0].sin()).terminal();
            let run = falling().event(fold).until(1.5).expect("a motion");
            let there = run.last().expect("an end").t;
            let parted = |run: &Trajectory| {
                let v = run.last().expect("an end").v.to_vec();
                (v[0] + v[1]).abs().max((v[2] - v[0]).abs())
            };
            let bound = (3.0 * tolerance).max(1e-8);
            let apart = parted(&run);
            assert!(
                apart < bound,
                "{method}, {tolerance:e}, {rate}: {apart:e} at the event"
            );
            for aside in [-5e-7, -5e-10, -5e-12, 0.0, 5e-12, 5e-8] {
                let run = falling().until(there + aside).expect("a motion");
                let apart = parted(&run);
                let place = format!("{method}, {tolerance:e}, {rate}, {aside:e}");
                assert!(apart < bound, "{place}: {apart:e}");
            }
        }
    }
}

/// There velocities are nothing beside what a projection changes them by, so that this tells nothing.
#[test]
fn events_where_a_motion_turns_are_on_the_constraints() {
    for (k, method, tolerance) in [
        (30.0, Method::Dop853, 1e-4),
        (30.0, Method::Dopri5, 1e-6),
        (1e7, Method::Dopri5, 1e-3),
        (1e7, Method::Radau5, 1e-3),
    ] {
        for absolute in [1e-6, 1e-9] {
            let angle = 0.2 + 0.09 * 7.0_f64;
            let start = at_rest(&[angle.cos(), angle.sin()]);
            let turn = Event::new("turn", |_t, q, v| q[0] * v[1] - q[1] * v[0]);
            let run = Simulation::new(Ring { k }).start(start).event(turn);
            let run = run.method(method).tolerance(tolerance);
            let run = run.absolute_tolerance(absolute).until(40.0 / k.sqrt());
            let run = run.expect("a motion");
            let events = run.all_events();
            assert!(events.len() > 5, "{k}, {method}: {} events", events.len());
            for event in events {
                let off = event.q[0].hypot(event.q[1]) - 1.0;
                assert!(off.abs() < 1e-13, "{k}, {method}, {tolerance:e}: {off:e}");
            }
        }
    }
}
