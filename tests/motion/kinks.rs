//! Runs across kinks and jumps of abs, sign, min and max: what stepping onto them gives.

use models::{FishRobot, Model, RoughBlock};
use std::f64::consts::PI;
use tests::{Random, assert_all_close, assert_close, at, cause, largest};
use ukcore::simulate::Switching::{self, Ignored, Located};
use ukcore::simulate::{Direction, Work};
use ukcore::solver::Formula;
use ukcore::{Error, Event, Mechanism, Method, Simulation, State, assemble};

ukcore::multibody! {
    /// A mass that flies freely between two springs.
    Stops {
        params { m = 1.0, k = 100.0, gap = 0.5 }
        coords { x }
        mass { x: m }
        force { x: -k * max(x - gap, 0.0) - k * min(x + gap, 0.0) }
    }
}

ukcore::multibody! {
    /// A force that jumps with time.
    Jumps {
        params { w = 3.0 }
        coords { x }
        mass { x: 1.0 }
        force { x: sign(sin(w * t)) }
    }
}

ukcore::multibody! {
    /// x = 1 + cos t touches the kink at 0 and goes back.
    Touching {
        params { c = 5.0 }
        coords { x }
        mass { x: 1.0 }
        force { x: 1.0 - x + c * (abs(x) - x) }
    }
}

ukcore::multibody! {
    /// A block that friction brings to rest.
    Rubbing {
        params { mu = 0.5, g = 9.81 }
        coords { s }
        mass { s: 1.0 }
        force { s: -mu * g * sign(dot(s)) }
    }
}

ukcore::multibody! {
    /// A puck on a rough slope that falls towards +x, with a rudder that turns its way.
    Puck {
        params { mu = 0.5, g = 9.81, slope = 0.0, turn = 0.0 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        let grip = mu * g * cos(slope) / hypot(dot(x), dot(y));
        force { x: g * sin(slope) - grip * dot(x) - turn * dot(y), y: -grip * dot(y) + turn * dot(x) }
    }
}

ukcore::multibody! {
    /// A stone on a spring that an invisible hand rubs in space; the constraint keeps it in a plane.
    Stone {
        params { mu = 0.3, k = 5.0 }
        coords { x, y, z }
        mass { x: 1.0, y: 2.0, z: 3.0 }
        potential { 0.5 * k * sq([x, y, z]) }
        let speed = norm(dot([x, y, z]));
        holonomic { plane: x + y + z = 1.0 }
        nonideal { x: -mu * dot(x) / speed, y: -mu * dot(y) / speed, z: -mu * dot(z) / speed }
    }
}

ukcore::multibody! {
    /// A driven block whose friction is written with a quotient.
    Quotient {
        params { mu = 3.2, drive = 6.0 }
        coords { s }
        mass { s: 1.0 }
        force { s: drive - mu * dot(s) / abs(dot(s)) }
    }
}

ukcore::multibody! {
    /// A ball that bounces on Hertz's spring, which has no force to be continued above the ground.
    Ball {
        params { m = 1.0, g = 9.81, k = 1e4 }
        coords { h }
        mass { h: m }
        potential { m * g * h, 0.4 * k * max(-h, 0.0).powf(2.5) }
    }
}

ukcore::multibody! {
    /// Kinks and jumps in M, Q, A and b at once.
    Broken {
        params { m = 1.5, c = 0.3, k = 20.0, gap = 0.2 }
        coords { x, y, z, w }
        mass { x: m * (3.0 + max(x, y).min(2.0).max(-2.0)), y: m, z: m, w: m }
        potential { k * max(gap - x, 0.0).powi(2), 2.0 * abs(y), k * sq(z) }
        force {
            x: -c * dot(x).abs() * dot(x) - abs(-2.0 * dot(x)) + sin(t),
            y: sign(sin(3.0 * t)) - min(x, y),
            z: min(1.0 - z, z) + 0.1 * max(z - 0.5, 0.0)
        }
        holonomic { track: w = x + y * abs(y - t) }
    }
}

fn state(t: f64, q: f64, v: f64) -> State {
    State {
        t,
        q: vec![q],
        v: vec![v],
    }
}

fn simulation<M: Mechanism>(mechanism: M, start: State) -> Simulation {
    Simulation::new(mechanism).start(start).tolerance(1e-10)
}

/// The fish after 4 s: the largest error of its body's position and velocity, and the work.
fn swim(settings: impl Fn(Simulation) -> Simulation) -> (f64, Work) {
    let reference = FishRobot::references().remove(0);
    let expected = reference.states.last().expect("to 4 s");
    let fish = FishRobot::default();
    let start = fish.default_start().expect("the start is consistent");
    let run = settings(Simulation::new(fish).start(start))
        .until(4.0)
        .unwrap_or_else(|e| panic!("{}", e.error));
    let end = run.last().expect("a sample");
    let body = [FishRobot::X1, FishRobot::Y1, FishRobot::TH1];
    let places = body.iter().map(|&i| end.q[i] - expected.q[i]);
    let rates = body.iter().map(|&i| end.v[i] - expected.v[i]);
    let errors: Vec<f64> = places.chain(rates).collect();
    (largest(&errors), run.work())
}

/// With steps of one size the error falls with the method's order, where those across the kinks of |v| v stay at the order of a jump in the
/// second derivative.
#[test]
fn steps_onto_the_kinks_have_the_order_of_the_method() {
    let error = |method: Method, switching: Switching, h: f64| {
        let fixed = swim(|s| {
            s.method(method)
                .switching(switching)
                .tolerance(0.9)
                .first_step(h)
                .max_step(h)
        });
        fixed.0
    };
    for (method, least, h) in [(Method::Dop853, 7.0, 0.2), (Method::Dopri5, 4.5, 0.04)] {
        let order = |switching| {
            let (long, short) = (
                error(method, switching, h),
                error(method, switching, h / 4.0),
            );
            (long / short).log2() / 2.0
        };
        let (located, ignored) = (order(Located), order(Ignored));
        assert!(located > least, "{method:?}: {located}");
        assert!(ignored < 4.0, "{method:?}: {ignored}");
    }
}

#[test]
fn the_fish_needs_fewer_evaluations_for_smaller_errors() {
    let mut rejected = (0, 0);
    for (tolerance, bound) in [(1e-6, 1e-5), (1e-8, 1e-7), (1e-10, 1e-9), (1e-12, 5e-12)] {
        let (error, work) = swim(|s| s.tolerance(tolerance));
        let (across, ignored) = swim(|s| s.tolerance(tolerance).switching(Ignored));
        // Steps across the switches may be lucky.
        let other = swim(|s| s.tolerance(0.9 * tolerance).switching(Ignored)).0;
        let across = across.max(other);
        assert!(error < bound, "{tolerance:e}: {error:e}");
        assert!(error < 0.1 * across, "{tolerance:e}: {error:e}, {across:e}");
        assert_eq!((work.switches, ignored.switches), (24, 0));
        if tolerance == 1e-10 {
            assert!(
                10 * work.evaluations < 7 * ignored.evaluations,
                "{work:?}, {ignored:?}"
            );
        }
        rejected = (rejected.0 + work.rejected, rejected.1 + ignored.rejected);
        // The rank-revealing solve is held in the same branches.
        let (dense, other) = swim(|s| s.tolerance(tolerance).formula(Formula::UdwadiaPhohomsiri));
        assert!(
            dense < bound && other.switches == 24,
            "{dense:e}, {other:?}"
        );
        assert!(other.steps.abs_diff(work.steps) <= 5, "{other:?}, {work:?}");
    }
    assert!(4 * rejected.0 < rejected.1, "{rejected:?}");
}

/// A period of the mass between springs is that of one spring and the time of two flights.
#[test]
fn a_mass_between_springs_comes_back_after_its_period() {
    let mech = Stops::default();
    let (omega, speed) = ((mech.k / mech.m).sqrt(), 2.0);
    let period = 2.0 * PI / omega + 4.0 * mech.gap / speed;
    for method in [Method::Dop853, Method::Dopri5] {
        for span in [3.0 * period, -3.0 * period] {
            let t0 = 0.7;
            let run = simulation(mech.clone(), state(t0, 0.0, speed))
                .method(method)
                .tolerance(1e-12)
                .until(t0 + span)
                .expect("a motion");
            let end = run.last().expect("a sample");
            assert_close("x", end.q[0], 0.0, 1e-10);
            assert_close("v", end.v[0], speed, 1e-10);
            assert_eq!(run.work().switches, 12, "{:?}", run.work());
        }
    }
}

/// The same between springs so hard that contact is a stiff motion, with the implicit method: its Jacobian jumps at each zero.
#[test]
fn the_implicit_method_steps_onto_kinks() {
    let mech = Stops {
        k: 1e6,
        ..Stops::default()
    };
    let (omega, speed) = ((mech.k / mech.m).sqrt(), 2.0);
    let period = 2.0 * PI / omega + 4.0 * mech.gap / speed;
    let run = |switching| {
        let run = simulation(mech.clone(), state(0.0, 0.0, speed))
            .method(Method::Radau5)
            .tolerance(1e-9)
            .switching(switching)
            .until(3.0 * period)
            .expect("a motion");
        let end = run.last().expect("a sample");
        (end.q[0].abs(), run.work())
    };
    let (located, ignored) = (run(Located), run(Ignored));
    assert!(located.0 < 1e-7, "{located:?}");
    assert_eq!(located.1.switches, 12);
    assert!(
        located.1.evaluations < ignored.1.evaluations,
        "{located:?}, {ignored:?}"
    );
}

/// Samples, events and the interpolant are right on both sides of a kink within the same proposed step.
#[test]
fn what_is_seen_between_steps_is_right_about_kinks() {
    let mech = Stops::default();
    let (omega, speed) = ((mech.k / mech.m).sqrt(), 2.0);
    let flight = mech.gap / speed;
    let exact = |t: f64| {
        if t <= flight {
            speed * t
        } else {
            mech.gap + speed / omega * (omega * (t - flight)).sin()
        }
    };
    let event = Event::new("inside", |_, q, _| q[0] - 0.6).direction(Direction::Rising);
    let run = simulation(mech.clone(), state(0.0, 0.0, speed))
        .every(0.01)
        .dense()
        .event(event)
        .until(0.5)
        .expect("a motion");
    assert_eq!(run.work().switches, 1);
    for sample in run.samples() {
        assert_close("sample", sample.q[0], exact(sample.t), 1e-8);
    }
    for k in 0..100 {
        let t = 0.005 * f64::from(k);
        let between = run.at(t).expect("within the run");
        assert_close("between", between.q[0], exact(t), 1e-8);
    }
    let mut hits = run.events("inside").expect("it is watched");
    let hit = hits.next().expect("it happens");
    assert_close("event", exact(hit.t), 0.6, 1e-8);
}

/// The velocity is a triangle in time, and each period carries the mass by (π/ω)².
#[test]
fn a_force_that_jumps_with_time_is_followed_to_rounding() {
    let mech = Jumps::default();
    let periods = 10.0;
    let span = periods * 2.0 * PI / mech.w;
    for (t0, span) in [(0.0, span), (0.0, -span)] {
        let run = simulation(mech.clone(), state(t0, 1.0, 0.0))
            .tolerance(1e-6)
            .until(t0 + span)
            .expect("a motion");
        let end = run.last().expect("a sample");
        let way = periods * (PI / mech.w).powi(2);
        assert_close("x", end.q[0], 1.0 + span.signum() * way, 1e-12);
        assert_close("v", end.v[0], 0.0, 1e-12);
        // The last jump may fall on the end.
        assert!(run.work().switches.abs_diff(19) <= 1, "{:?}", run.work());
        assert!(run.work().rejected < 10, "{:?}", run.work());
    }
}

/// A motion that comes within 1e-9 of the kink, on either side, or touches it, goes on as if there were none; one that dips into the other
/// branch is followed there.
#[test]
fn a_touch_is_no_crossing() {
    let run = |offset: f64, tolerance: f64, switching: Switching| {
        let run = simulation(Touching::default(), state(0.0, 2.0 + offset, 0.0))
            .tolerance(tolerance)
            .switching(switching)
            .until(20.0)
            .expect("a motion");
        (run.last().expect("a sample").q[0], run.work())
    };
    for offset in [0.0, 1e-9, -1e-9] {
        for tolerance in [1e-8, 1e-10, 1e-12] {
            let (x, work) = run(offset, tolerance, Located);
            let smooth = 1.0 + (1.0 + offset) * 20.0_f64.cos();
            assert_close("x", x, smooth, 10.0 * tolerance + 10.0 * offset.abs());
            assert!(work.switches <= 6 && work.rejected < 10, "{work:?}");
        }
    }
    let (x, work) = run(1e-3, 1e-10, Located);
    let (expected, _) = run(1e-3, 1e-13, Ignored);
    assert_close("x", x, expected, 1e-8);
    assert_eq!(work.switches, 6, "{work:?}");
}

/// From any start, steps onto the zeros lead to where short steps across them do. Where y = t the track turns by an angle, so that no
/// velocity satisfies the constraint before and after: such a run ends there either way.
#[test]
fn random_motions_are_those_of_short_steps_across() {
    let mut random = Random::new(9);
    let mut arrived = 0;
    for _ in 0..40 {
        let mech = Broken::default();
        let guess = random.state(4);
        let start = assemble(&mech, &guess, &["x", "y", "z"]).expect("w takes it up");
        let run = |switching, tolerance| {
            Simulation::new(mech.clone())
                .start(start.clone())
                .switching(switching)
                .tolerance(tolerance)
                .until(5.0)
        };
        match (run(Located, 1e-9), run(Ignored, 1e-11)) {
            (Ok(located), Ok(ignored)) => {
                arrived += 1;
                let (found, expected) = (located.last(), ignored.last());
                let (found, expected) = (found.expect("an end"), expected.expect("an end"));
                assert_all_close("q", found.q, expected.q, 1e-7);
                assert!(3 * located.work().evaluations < ignored.work().evaluations);
            }
            (Err(located), Err(ignored)) => {
                let [(located, _), (ignored, _)] = [&located, &ignored].map(|e| cause(&e.error));
                assert_close("end", located, ignored, 1e-6);
            }
            (located, ignored) => panic!("{:?}, {:?}", located.is_ok(), ignored.is_ok()),
        }
    }
    assert!(arrived > 10, "{arrived}");
}

#[test]
fn a_branch_that_ends_at_its_zero_is_left_and_entered() {
    for method in [Method::Dop853, Method::Dopri5] {
        // Bounces, to and fro in time; from the ground itself, up and down.
        for (h, v, span) in [
            (1.0, 0.0, 5.0),
            (1.0, 0.0, -5.0),
            (0.0, 2.0, 1.0),
            (0.0, -2.0, 1.0),
        ] {
            let run = |switching| {
                let run = simulation(Ball::default(), state(0.0, h, v))
                    .method(method)
                    .switching(switching)
                    .until(span)
                    .expect("a motion");
                (run.energy_drift(), run.work().evaluations)
            };
            let (located, ignored) = (run(Located), run(Ignored));
            assert!(located.0 < 1e-7, "{located:?}, {ignored:?}");
            assert!(10 * located.1 < 11 * ignored.1, "{located:?}, {ignored:?}");
        }
    }
}

/// Up and down a rough slope: one jump, between two parabolas, which the method follows exactly.
#[test]
fn a_block_turns_on_its_slope() {
    let block = RoughBlock::default();
    let start = block.default_start().expect("the start is consistent");
    let run = |switching| {
        Simulation::new(block.clone())
            .start(start.clone())
            .tolerance(1e-6)
            .switching(switching)
            .until(2.0)
            .expect("a motion")
    };
    let way = |run: &ukcore::Trajectory| {
        let last = run.last().expect("a sample");
        last.q[0] * block.slope.cos() - last.q[1] * block.slope.sin()
    };
    let speed = -5.0_f64;
    let (up, down) = [1.0, -1.0]
        .map(|sign| block.g * (block.slope.sin() + sign * block.mu * block.slope.cos()))
        .into();
    let turn = -speed / up;
    let exact = speed * turn + 0.5 * up * turn * turn + 0.5 * down * (2.0 - turn).powi(2);
    let (located, ignored) = (run(Located), run(Ignored));
    assert_close("way", way(&located), exact, 1e-13);
    assert_eq!(located.work().switches, 1);
    assert!(
        located.work().evaluations < ignored.work().evaluations,
        "{:?} {:?}",
        located.work(),
        ignored.work()
    );
}

/// Where friction holds a body both branches drive it back: that is found in a few steps.
#[test]
fn rest_under_friction_is_found_at_once() {
    let mech = Rubbing::default();
    let rest = 1.0 / (mech.mu * mech.g);
    let failure = simulation(mech.clone(), state(0.0, 0.0, 1.0))
        .until(1e3)
        .expect_err("it comes to rest");
    let (t, source) = cause(&failure.error);
    assert!(matches!(source, Error::Chattering { terms, .. } if terms == &["force on `s`"]));
    assert_close("t", t, rest, 1e-9);
    assert!(
        failure.trajectory.work().evaluations < 300,
        "{:?}",
        failure.trajectory.work()
    );
    let message = failure.to_string();
    assert!(
        message.contains("drive the motion back") && message.contains("terminal event"),
        "{message}"
    );
    // Without a force it may stand from the start.
    let run = simulation(mech, state(0.0, 0.0, 0.0))
        .until(10.0)
        .expect("rest");
    assert_eq!(run.last().expect("a sample").q[0], 0.0);
}

const STEPPING: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];

#[test]
fn rest_under_friction_in_the_plane_is_found_and_named() {
    let (v, g) = ([2.0, 1.0], 9.81);
    let (rest, speed) = (f64::hypot(v[0], v[1]) / (0.5 * g), f64::hypot(v[0], v[1]));
    for (method, tolerance) in STEPPING
        .into_iter()
        .flat_map(|m| [1e-4, 1e-7, 1e-10].map(|tol| (m, tol)))
    {
        let start = at(&[0.0; 2], &v);
        let run = simulation(Puck::default(), start)
            .method(method)
            .tolerance(tolerance);
        let failure = run.until(5.0).expect_err("it does not slide so long");
        let Error::At { t, q, source, .. } = &failure.error else {
            panic!("{}", failure.error)
        };
        assert!(
            matches!(&**source, Error::Chattering { terms, .. } if terms == &["force on `x`", "force on `y`"]),
            "{method}, {tolerance:e}: {source}"
        );
        // Which of the steps about rest is the last one is a matter of luck.
        let near = 100.0 * tolerance.sqrt();
        assert_close("time", *t, rest, near);
        let way = 0.5 * speed * rest;
        assert_all_close("place", q, &[way * v[0] / speed, way * v[1] / speed], near);
        assert!(
            failure.trajectory.work().steps < 100,
            "{method}: {:?}",
            failure.trajectory.work()
        );
    }
}

#[test]
fn a_stone_that_is_rubbed_in_its_plane_comes_to_rest() {
    for (method, v) in STEPPING
        .into_iter()
        .flat_map(|m| [[0.3, -0.3, 0.0], [1e-9, 2.0, -2.0]].map(|v| (m, v)))
    {
        let guess = at(&[2.0, -0.5, -0.5], &v);
        let start = assemble(Stone::default(), &guess, &[]).expect("a plane");
        let failure = simulation(Stone::default(), start)
            .method(method)
            .until(50.0)
            .expect_err("rest");
        let told = failure.error.to_string();
        assert!(
            told.contains("v/|v| in the non-ideal force on `x`"),
            "{told}"
        );
        let (last, work) = (
            failure.trajectory.last().expect("samples"),
            failure.trajectory.work(),
        );
        assert!(
            largest(last.v) < 1e-6 && work.steps < 3000,
            "{method}: {last:?} {work:?}"
        );
    }
}

#[test]
fn a_puck_that_goes_on_is_not_held_up() {
    let slope: f64 = 0.8;
    let (down, grip) = (9.81 * slope.sin(), 0.5 * 9.81 * slope.cos());
    for (method, tolerance) in STEPPING
        .into_iter()
        .flat_map(|m| [1e-4, 1e-7, 1e-10].map(|tol| (m, tol)))
    {
        let run = |v: [f64; 2], turn, switching| {
            let start = at(&[0.0; 2], &v);
            let puck = Puck {
                slope,
                turn,
                ..Puck::default()
            };
            let run = simulation(puck, start).method(method).tolerance(tolerance);
            run.switching(switching)
                .until(4.0)
                .unwrap_or_else(|f| panic!("{method}, {tolerance:e}: {}", f.error))
        };
        // Straight up, through rest, and down again; nothing steps onto a length, so the error is that of a jump stepped across.
        let up = 3.0 / (down + grip);
        let expect = [0.5 * (down - grip) * (4.0 - up).powi(2) - 1.5 * up, 0.0];
        let there = run([-3.0, 0.0], 0.0, Located);
        assert_all_close("passage", there.last().expect("samples").q, &expect, 0.1);
        // Past rest, and never near it: nothing is evaluated for the watch.
        for (v, turn) in [([-3.0, 0.01], 0.0), ([2.0, 1.0], 3.0)] {
            let (watched, alone) = (run(v, turn, Located), run(v, turn, Ignored));
            let (a, b) = (
                watched.last().expect("samples"),
                alone.last().expect("samples"),
            );
            assert_all_close("the same motion", a.q, b.q, 0.0);
            assert_eq!(watched.work(), alone.work());
        }
    }
}

#[test]
fn a_number_over_its_size_is_its_sign() {
    assert_eq!(Quotient::SPEC.switches[0].function, "dot(s)");
    for (method, k) in STEPPING
        .into_iter()
        .flat_map(|m| (0..20).map(move |k| (m, k)))
    {
        let (mech, v) = (Quotient::default(), -2.0 - 0.2 * f64::from(k));
        let (up, down) = (mech.drive + mech.mu, mech.drive - mech.mu);
        let rest = -v / up;
        let expect = 0.5 * v * rest + 0.5 * down * (2.0 - rest).powi(2);
        let run = simulation(mech, state(0.0, 0.0, v))
            .method(method)
            .until(2.0);
        let run = run.unwrap_or_else(|f| panic!("{method}, {v}: {}", f.error));
        assert_close("way", run.last().expect("samples").q[0], expect, 1e-9);
    }
}
