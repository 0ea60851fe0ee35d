//! Each small model against its motion in closed form.

use models::{
    DoublePendulum, DoublePendulumAngles, DoubleScottRussell, FourBars, KapitzaPendulum, KnifeEdge,
    MasslessSpring, Model, Pendulum, RigidBody, RoughBlock, SliderCrank, StartOptions,
};
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, PI};
use tests::{Random, assert_all_close, assert_close, cause, largest, outputs};
use ukcore::simulate::Direction;
use ukcore::solver::SolverOptions;
use ukcore::{Error, Event, Simulation, Solver, State, Trajectory};

/// Tolerance of the runs; motions are compared with 100 to 1000 times as much, for the error that accumulates.
const TOLERANCE: f64 = 1e-11;

fn run<M: Model>(model: M, options: StartOptions, until: f64) -> Trajectory {
    let name = M::starts()[0].name;
    let start = model
        .start(name, &options)
        .unwrap_or_else(|e| panic!("{}: {e}", M::ID));
    run_from(model, start, until)
}

fn run_from<M: Model>(model: M, start: State, until: f64) -> Trajectory {
    Simulation::new(&model)
        .start(start)
        .tolerance(TOLERANCE)
        .until(until)
        .unwrap_or_else(|e| panic!("{}: {}", M::ID, e.error))
}

fn decimals(value: &Value) -> f64 {
    value.as_str().expect("decimals").parse().expect("a number")
}

#[test]
fn pendulum_in_elliptic_functions() {
    let pendulum = Pendulum::default();
    let run = run(pendulum.clone(), StartOptions::new(), 10.0);
    for sample in run.samples() {
        let (angle, rate) = pendulum.swing(-FRAC_PI_2, sample.t);
        let (q, v) = pendulum.at_angle(angle, rate);
        assert_all_close("q", sample.q, &q, 1e-9);
        assert_all_close("v", sample.v, &v, 1e-8);
    }
    let tension = run.output("tension").expect("declared");
    for (solution, tension) in run.solutions().expect("solvable").iter().zip(tension) {
        let force = solution.ideal_force[0].hypot(solution.ideal_force[1]);
        assert_close("tension", force, tension, 1e-9);
    }
}

#[test]
fn pendulum_reference() {
    let data: Value = serde_json::from_str(include_str!("../data/pendulum.json")).expect("JSON");
    let pendulum = Pendulum::default();
    let period = decimals(&data["period"]);
    assert_close("period", pendulum.period(FRAC_PI_2), period, 1e-15 * period);
    for point in data["reference"].as_array().expect("a list") {
        let t = decimals(&point["t"]);
        // The closed form at t is as good as ω₀ t is: rounding grows with t.
        let (angle, rate) = pendulum.swing(-FRAC_PI_2, t);
        let (q, v) = pendulum.at_angle(angle, rate);
        let accuracy = 1e-13 * (1.0 + t);
        assert_all_close(
            "q",
            &q,
            &[decimals(&point["x"]), decimals(&point["y"])],
            accuracy,
        );
        assert_all_close(
            "v",
            &v,
            &[decimals(&point["vx"]), decimals(&point["vy"])],
            10.0 * accuracy,
        );
        let (q, v) = (q.to_vec(), v.to_vec());
        assert_close(
            "tension",
            outputs(&pendulum, &State { t, q, v })[Pendulum::OUT_TENSION],
            decimals(&point["tension"]),
            30.0 * accuracy,
        );
    }
}

#[test]
fn pendulum_period_by_event() {
    for amplitude in [0.1, 1.0, 3.0] {
        let pendulum = Pendulum {
            l: 0.7,
            ..Pendulum::default()
        };
        let options = StartOptions::new().with("from", amplitude);
        let start = pendulum.start("released", &options).expect("a start");
        let period = pendulum.period(amplitude);
        let bottom = Event::new("bottom", |_t, q, _v| q[0]).direction(Direction::Falling);
        let run = Simulation::new(pendulum)
            .start(start)
            .tolerance(TOLERANCE)
            .event(bottom)
            .until(1.5 * period)
            .unwrap_or_else(|e| panic!("{}", e.error));
        let bottom = run.events("bottom").expect("watched");
        let times: Vec<f64> = bottom.map(|hit| hit.t).collect();
        assert_all_close("bottoms", &times, &[0.25 * period, 1.25 * period], 1e-9);
    }
}

/// The double pendulum with these parameters in Cartesian coordinates.
fn cartesian(angles: &DoublePendulumAngles) -> DoublePendulum {
    let DoublePendulumAngles { m1, m2, l1, l2, g } = *angles;
    DoublePendulum { m1, m2, l1, l2, g }
}

/// The state of the double pendulum with these angles of the rods and their rates.
fn at_angles(pendulum: &DoublePendulum, angles: &[f64], rates: &[f64]) -> State {
    let options = StartOptions::new()
        .with("from1", angles[0])
        .with("from2", angles[1])
        .with("rate1", rates[0])
        .with("rate2", rates[1]);
    pendulum.start("released", &options).expect("a start")
}

#[test]
fn double_pendulum_reference() {
    let data: Value =
        serde_json::from_str(include_str!("../data/double_pendulum.json")).expect("JSON");
    let pendulum = DoublePendulum::default();
    let angles = DoublePendulumAngles::default();
    let mut state = pendulum.default_start().expect("a start");
    let mut angle_state = angles.default_start().expect("a start");
    for point in data["states"].as_array().expect("a list") {
        let t = decimals(&point["t"]);
        let amplification = point["error_amplification"].as_f64().expect("a number");
        if t > 15.0 {
            break;
        }
        let numbers = |key: &str| -> Vec<f64> {
            let list = point[key].as_array().expect("a list");
            list.iter().map(decimals).collect()
        };
        // Errors made on the way grow, too; the worst amplification so far is 40 but at t = 15.
        let accuracy = 1e-9 * amplification.max(10.0);
        let agrees = |what: &str, q: &[f64], v: &[f64]| {
            assert_all_close(&format!("q {what}, {t}"), q, &numbers("q"), accuracy);
            assert_all_close(&format!("v {what}, {t}"), v, &numbers("v"), 10.0 * accuracy);
        };
        let run = run_from(pendulum.clone(), state, t);
        let last = run.last().expect("an end");
        agrees("in places", last.q, last.v);
        state = last.to_state();
        let run = run_from(angles.clone(), angle_state, t);
        let last = run.last().expect("an end");
        let placed = at_angles(&pendulum, last.q, last.v);
        agrees("in angles", &placed.q, &placed.v);
        angle_state = last.to_state();
    }
}

#[test]
fn double_pendulum_accelerates_alike_in_both_formulations() {
    let mut random = Random::new(11);
    for _ in 0..50 {
        let angles: DoublePendulumAngles = random.parameters(0.5);
        let cartesian = cartesian(&angles);
        let (a, b) = (PI * random.signed(), PI * random.signed());
        let (u, w) = (3.0 * random.signed(), 3.0 * random.signed());
        let mut angular = vec![0.0; 2];
        Solver::new(&angles, SolverOptions::default())
            .acceleration(0.0, &[a, b], &[u, w], &mut angular)
            .expect("regular");
        let state = at_angles(&cartesian, &[a, b], &[u, w]);
        let mut found = vec![0.0; 4];
        Solver::new(&cartesian, SolverOptions::default())
            .acceleration(0.0, &state.q, &state.v, &mut found)
            .expect("regular");
        let rod = |l: f64, angle: f64, rate: f64, acceleration: f64| {
            let (sin, cos) = angle.sin_cos();
            let centripetal = rate * rate;
            [
                l * (acceleration * cos - centripetal * sin),
                l * (acceleration * sin + centripetal * cos),
            ]
        };
        let inner = rod(angles.l1, a, u, angular[0]);
        let outer = rod(angles.l2, b, w, angular[1]);
        let expected = [inner[0], inner[1], inner[0] + outer[0], inner[1] + outer[1]];
        assert_all_close("q̈", &found, &expected, 1e-11 * largest(&expected).max(1.0));
    }
}

#[test]
fn double_pendulum_small_oscillations() {
    let pendulum = DoublePendulumAngles {
        m1: 1.3,
        m2: 0.7,
        l1: 0.9,
        l2: 1.1,
        ..Default::default()
    };
    for frequency in cartesian(&pendulum).small_oscillations() {
        // The mode's shape, from the first row of (K − ω² M) θ = 0. The frequency is off by the amplitude squared.
        let both = pendulum.m1 + pendulum.m2;
        let square = frequency * frequency;
        let own = both * pendulum.l1 * (pendulum.g - square * pendulum.l1);
        let ratio = own / (square * pendulum.m2 * pendulum.l1 * pendulum.l2);
        let amplitude = 1e-4;
        let options = StartOptions::new()
            .with("from1", amplitude)
            .with("from2", ratio * amplitude);
        let start = pendulum.start("released", &options).expect("a start");
        let run = run_from(pendulum.clone(), start, 2.0 * PI / frequency);
        let last = run.last().expect("an end");
        assert_all_close(
            "one period",
            last.q,
            &[amplitude, ratio * amplitude],
            1e-8 * amplitude.sqrt(),
        );
        let half = run_from(
            pendulum.clone(),
            run.sample(0).expect("a start").to_state(),
            PI / frequency,
        );
        let last = half.last().expect("an end");
        assert_all_close(
            "half a period",
            last.q,
            &[-amplitude, -ratio * amplitude],
            1e-8 * amplitude.sqrt(),
        );
    }
}

#[test]
fn kapitza_in_its_angle() {
    let mut random = Random::new(5);
    for _ in 0..50 {
        let pendulum: KapitzaPendulum = random.parameters(0.5);
        let mut solver = Solver::new(&pendulum, SolverOptions::default());
        let (t, angle, rate) = (random.signed(), PI * random.signed(), 5.0 * random.signed());
        let [height, velocity, pivot] = pendulum.pivot(t);
        let (sin, cos) = angle.sin_cos();
        let (l, speed) = (pendulum.l, pendulum.l * rate);
        let (q, v) = (
            [l * sin, height + l * cos],
            [speed * cos, velocity - speed * sin],
        );
        let mut found = vec![0.0; 2];
        solver.acceleration(t, &q, &v, &mut found).expect("regular");
        let acceleration = pendulum.angular_acceleration(t, angle);
        let expected = [
            l * (acceleration * cos - rate * rate * sin),
            pivot - l * (acceleration * sin + rate * rate * cos),
        ];
        assert_all_close("q̈", &found, &expected, 1e-11 * largest(&expected));
    }
}

#[test]
fn kapitza_stands_on_its_head() {
    let pendulum = KapitzaPendulum::default();
    assert!(pendulum.inverted_is_stable());
    let run = run(pendulum.clone(), StartOptions::new(), 5.0);
    let angles = run.output("angle").expect("declared");
    // It swings through ±0.2 slowly; the shaking adds (a/l) sin θ.
    assert!(largest(&angles) < 0.23, "{}", largest(&angles));
    // The slow swing crosses zero every half period: the mean of five, within the order a/l of the average.
    let half = PI / pendulum.slow_frequency();
    let crossings: Vec<f64> = run
        .times()
        .windows(2)
        .zip(angles.windows(2))
        .filter(|(_, a)| a[0] * a[1] < 0.0)
        .map(|(t, _)| 0.5 * (t[0] + t[1]))
        .collect();
    let first = crossings.first().copied().expect("it swings");
    let last = crossings.last().copied().expect("it swings");
    let halves = ((last - first) / half).round();
    assert_close(
        "slow half period",
        (last - first) / halves,
        half,
        0.05 * half,
    );

    let slow = KapitzaPendulum {
        w: 30.0,
        ..pendulum
    };
    assert!(!slow.inverted_is_stable());
    let angles = run_from(slow.clone(), slow.default_start().expect("a start"), 5.0)
        .output("angle")
        .expect("declared");
    assert!(largest(&angles) > 1.0, "it falls");
}

#[test]
fn slider_crank_with_one_degree_of_freedom() {
    let crank = SliderCrank {
        torque: 0.4,
        ..SliderCrank::default()
    };
    let run = run(crank.clone(), StartOptions::new(), 1.0);
    let start = run.sample(0).expect("a start").to_state();
    let kinetic = |angle: f64, rate: f64| 0.5 * crank.reduced_inertia(angle) * rate * rate;
    let angle = start.q[SliderCrank::CRANK_ANGLE];
    let energy = kinetic(angle, start.v[SliderCrank::CRANK_ANGLE]) + crank.reduced_potential(angle);
    for sample in run.samples() {
        let angle = sample.q[SliderCrank::CRANK_ANGLE];
        assert_close(
            "stroke",
            sample.q[SliderCrank::SLIDE_X],
            crank.stroke(angle),
            1e-13,
        );
        let work = energy - crank.reduced_potential(angle);
        let rate = (2.0 * work / crank.reduced_inertia(angle)).sqrt();
        assert_close(
            "rate of the crank",
            sample.v[SliderCrank::CRANK_ANGLE],
            rate,
            1e-8,
        );
        let options = [("angle", angle), ("speed", rate)].into();
        let expected = crank.start("turning", &options).expect("the rod reaches");
        assert_all_close("q", sample.q, &expected.q, 1e-12);
        assert_all_close("q̇", sample.v, &expected.v, 1e-8);
    }
    let solution = Solver::new(&crank, SolverOptions::default())
        .solve(start.t, &start.q, &start.v)
        .expect("regular");
    assert_eq!((solution.rank, solution.degrees_of_freedom), (8, 1));
    assert!(solution.redundant.is_empty());
}

#[test]
fn redundant_scott_russell_linkages_with_one_degree_of_freedom() {
    let linkage = DoubleScottRussell::default();
    let run = run(linkage.clone(), StartOptions::new(), 1.0);
    let start = run.sample(0).expect("a start").to_state();
    let crank = DoubleScottRussell::CRANK_ANGLE[0];
    let (angle, rate) = (start.q[crank], start.v[crank]);
    let kinetic = 0.5 * linkage.reduced_inertia(angle) * rate * rate;
    let energy = kinetic + linkage.reduced_potential(angle);
    for sample in run.samples() {
        let (angle, rate) = (sample.q[crank], sample.v[crank]);
        let options = [("angle", angle), ("speed", rate)].into();
        let expected = linkage.start("turning", &options).expect("it closes");
        assert_all_close("q", sample.q, &expected.q, 1e-12);
        assert_all_close("q̇", sample.v, &expected.v, 1e-11);
        let work = energy - linkage.reduced_potential(angle);
        let square = 2.0 * work / linkage.reduced_inertia(angle);
        assert_close("rate of the crank", rate * rate, square, 1e-8);
    }
    for solution in run.solutions().expect("redundant is no error") {
        assert_eq!((solution.rank, solution.degrees_of_freedom), (14, 1));
        assert_eq!(solution.redundant.len(), 2);
    }
}

#[test]
fn knife_edge_paths() {
    for (turn, glide, heading) in [
        (1.0, 0.0, 0.0),
        (1.3, 0.7, -0.4),
        (-2.0, 1.0, 2.0),
        (0.0, 0.5, 0.3),
    ] {
        let options = StartOptions::new()
            .with("turn", turn)
            .with("glide", glide)
            .with("heading", heading);
        let knife = KnifeEdge::default();
        let run = run(knife.clone(), options, 5.0);
        for sample in run.samples() {
            let expected = knife.path(turn, glide, heading, sample.t);
            let size = largest(&expected).max(1.0);
            assert_all_close("path", sample.q, &expected, 1e-9 * size);
        }
    }
    // A whole number of half turns from rest: it has drifted across the slope only.
    let knife = KnifeEdge::default();
    let run = run(knife.clone(), StartOptions::new(), PI);
    let last = run.last().expect("an end");
    assert_close("down", last.q[KnifeEdge::X], 0.0, 1e-9);
    assert_close("across", last.q[KnifeEdge::Y], PI * knife.drift(1.0), 1e-9);
}

#[test]
fn block_slides_by_coulomb() {
    let block = RoughBlock::default();
    for kick in [-5.0, 0.5] {
        // Through the turn the friction jumps; the step that meets the jump is as good as the tolerance.
        let run = run(block.clone(), StartOptions::new().with("kick", kick), 3.0);
        let ways = run.output("way").expect("declared");
        let speeds = run.output("speed").expect("declared");
        for ((t, way), speed) in run.times().iter().zip(ways).zip(speeds) {
            let (expected_way, expected_speed) = block.slide(kick, *t);
            assert_close("way", way, expected_way, 1e-8);
            assert_close("speed", speed, expected_speed, 1e-8);
        }
    }
    // The normal force is ideal, friction is not, and neither contains the other.
    let start = block.default_start().expect("a start");
    let solution = Solver::new(&block, SolverOptions::default())
        .solve(start.t, &start.q, &start.v)
        .expect("regular");
    let size = |force: &[f64]| force[0].hypot(force[1]);
    let normal = block.m * block.g * block.slope.cos();
    assert_close("normal force", size(&solution.ideal_force), normal, 1e-13);
    assert_close(
        "friction",
        size(&solution.nonideal_force),
        block.mu * normal,
        1e-13,
    );
    // Friction that can hold it does so where it turns.
    let rough = RoughBlock { mu: 0.6, ..block };
    let start = rough.default_start().expect("a start");
    let failure = Simulation::new(&rough)
        .start(start)
        .until(3.0)
        .expect_err("it would stick");
    let (t, source) = cause(&failure.error);
    assert!(matches!(source, Error::Chattering { .. }), "{source}");
    assert_close("where it turns", t, rough.turning_time(-5.0), 1e-6);
}

#[test]
fn massless_joint_oscillates_with_the_mass() {
    let spring = MasslessSpring {
        m: 0.3,
        ..MasslessSpring::default()
    };
    let (pull, speed) = (0.1, -0.7);
    let run = run(
        spring.clone(),
        StartOptions::new().with("pull", pull).with("speed", speed),
        5.0,
    );
    for sample in run.samples() {
        let (x, v) = spring.oscillation(pull, speed, sample.t);
        let ratio = spring.ratio();
        assert_all_close("q", sample.q, &[ratio * x, x], 1e-9);
        assert_all_close("q̇", sample.v, &[ratio * v, v], 1e-8);
    }
    for solution in run.solutions().expect("[M | Aᵀ] has full rank") {
        assert!(
            largest(&solution.ideal_force) < 1e-12,
            "the balance needs no force"
        );
    }
}

#[test]
fn rigid_body_tumbles_by_euler() {
    let body = RigidBody::default();
    for spin in [
        [0.01, 2.0, 0.02],
        [0.3, -1.0, 0.4],
        [1.0, 0.2, -0.3],
        [-1.0, 0.5, 0.1],
        [0.1, 0.3, -1.0],
    ] {
        let options = StartOptions::new()
            .with("rate1", spin[0])
            .with("rate2", spin[1])
            .with("rate3", spin[2]);
        let run = run(body.clone(), options, 10.0);
        for (t, outputs) in run.times().iter().zip(run.outputs()) {
            let expected = body.spin(spin, *t).expect("three different moments");
            assert_all_close("spin", &outputs[..3], &expected, 2e-8);
        }
    }
    // Equal to the start at t = 0, and constant about a principal axis.
    let still = body
        .spin([0.0, 0.0, 1.5], 3.0)
        .expect("three different moments");
    assert_all_close("principal axis", &still, &[0.0, 0.0, 1.5], 1e-15);
}

#[test]
fn four_bars_fall_as_one_pendulum() {
    let bars = FourBars::default();
    let run = run(bars.clone(), StartOptions::new(), 0.6);
    // θ̇² = ω² + 2k (1 − cos θ), with the tops at the speed ω l at first.
    let (k, start_rate) = (bars.toppling(), 1.0 / bars.l);
    let rate = |lean: f64| (start_rate * start_rate + 2.0 * k * (1.0 - lean.cos())).sqrt();
    let mut last = 0.0;
    for sample in run.samples() {
        let lean = sample.q[FourBars::X[0]].atan2(sample.q[FourBars::Y[0]]);
        let (sin, cos) = lean.sin_cos();
        for (i, (&x, &y)) in FourBars::X.iter().zip(&FourBars::Y).enumerate() {
            let top = [sample.q[x] - i as f64 * bars.l, sample.q[y]];
            assert_all_close("top", &top, &[bars.l * sin, bars.l * cos], 1e-9);
            let speed = bars.l * rate(lean);
            let velocity = [sample.v[x], sample.v[y]];
            assert_all_close("velocity", &velocity, &[speed * cos, -speed * sin], 1e-8);
        }
        // t = ∫ dθ/θ̇ by Simpson's rule, whose error is below 1e-12 with a thousand intervals.
        let (pieces, part) = (1000, lean / 1000.0);
        let weight = |i: i32| [2.0, 4.0][(i % 2) as usize] - f64::from(i % pieces == 0);
        let sum: f64 = (0..=pieces)
            .map(|i| weight(i) / rate(part * f64::from(i)))
            .sum();
        assert_close("time", sum * part / 3.0, sample.t, 1e-9);
        last = lean;
    }
    assert!(last > 1.0, "the cranks lean far, but {last}");
}
