//! The fish robot against a reference solution, and the paper's claims on its sweeps.

use models::{FishRobot, Model, StartOptions};
use std::f64::consts::PI;
use tests::{Dense, Random, assert_all_close, assert_close, largest, rates, residuals};
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Simulation, Solver, State, Trajectory, assemble};

/// A gait: A3, ω/π, φ in degrees; and what an independent integration (equations derived by a computer algebra system, tolerance 1e-9)
/// gives for it: ẍ1(0), m/s², and the mean ẋ1 over t ∈ [3, 4] s, m/s.
const SWEEPS: [(f64, f64, f64, f64, f64); 10] = [
    (0.1, 2.0, 15.0, -0.191_562_7, -0.098_647_5),
    (0.2, 2.0, 15.0, -0.223_384_1, -0.106_945_9),
    (0.4, 2.0, 15.0, -0.292_362_1, -0.121_537_0),
    (0.6, 2.0, 15.0, -0.367_899_0, -0.132_748_3),
    (0.6, 2.5, 15.0, -0.574_842_1, -0.166_840_8),
    (0.6, 3.0, 15.0, -0.827_772_7, -0.201_285_7),
    (0.6, 3.5, 15.0, -1.126_690_6, -0.235_936_3),
    (0.6, 2.0, 0.0, -0.381_219_3, -0.138_774_3),
    (0.6, 2.0, 30.0, -0.331_604_5, -0.124_537_4),
    (0.6, 2.0, 60.0, -0.227_006_5, -0.102_176_5),
];

fn fish(a3: f64, w_over_pi: f64, phi_degrees: f64) -> FishRobot {
    FishRobot {
        a3,
        w: w_over_pi * PI,
        phi: phi_degrees.to_radians(),
        ..FishRobot::default()
    }
}

fn swim(fish: &FishRobot, tolerance: f64, times: Vec<f64>) -> Trajectory {
    let end = times.last().copied().expect("there are times");
    Simulation::new(fish.clone())
        .start(fish.default_start().expect("the start is consistent"))
        .tolerance(tolerance)
        .at(times)
        .until(end)
        .unwrap_or_else(|e| panic!("{}", e.error))
}

fn start_acceleration(fish: &FishRobot) -> f64 {
    let start = fish.default_start().expect("the start is consistent");
    let mut out = vec![0.0; FishRobot::SPEC.n()];
    Solver::new(fish, SolverOptions::default())
        .acceleration(start.t, &start.q, &start.v, &mut out)
        .expect("[M | Aᵀ] has full rank");
    out[FishRobot::X1]
}

#[test]
fn states_agree_with_the_reference() {
    let reference = FishRobot::references().remove(0);
    let times = reference.states.iter().map(|state| state.t).collect();
    let run = swim(&FishRobot::default(), 1e-10, times);
    assert_eq!(run.samples().len(), 3);
    for (sample, expected) in run.samples().zip(&reference.states) {
        let case = format!("t = {}", sample.t);
        assert_all_close(&case, sample.q, &expected.q, 1e-8);
        assert_all_close(&case, sample.v, &expected.v, 1e-8);
    }
}

#[test]
fn sweeps() {
    for (a3, w, phi, acceleration, speed) in SWEEPS {
        let case = format!("A3 = {a3}, ω = {w} π, φ = {phi}°");
        let fish = fish(a3, w, phi);
        assert_close(&case, start_acceleration(&fish), acceleration, 1e-6);
        let run = swim(&fish, 1e-8, vec![3.0, 4.0]);
        let x = run.coordinate("x1").expect("the fish has a body");
        assert_close(&case, x[1] - x[0], speed, 1e-5);
    }
}

#[test]
fn paper_claims_on_the_sweeps() {
    // Speeds and starting accelerations are towards −x. Rows 0-3 vary A3, rows 3-6 ω, rows 7, 3, 8, 9 φ.
    let grows = |rows: &[usize]| {
        for pair in rows.windows(2) {
            let (a, b) = (SWEEPS[pair[0]], SWEEPS[pair[1]]);
            assert!(-b.3 > -a.3 && -b.4 > -a.4, "{a:?} to {b:?}");
        }
    };
    grows(&[0, 1, 2, 3]);
    grows(&[3, 4, 5, 6]);
    grows(&[9, 8, 3, 7]);
}

/// The state at time `t` whose body is at `body` = (x1, y1, θ1), m and rad, and moves with `rate`: peduncle and fin follow from the gait
/// and the joints (eqs. 40, 41, 44, 45, 48).
fn follow(fish: &FishRobot, t: f64, body: [f64; 3], rate: [f64; 3]) -> State {
    let (sin2, cos2) = (fish.w * t).sin_cos();
    let (sin3, cos3) = (fish.w * t - fish.phi).sin_cos();
    let gait = [
        (fish.a2 * sin2, fish.a2 * fish.w * cos2),
        (fish.a3 * sin3, fish.a3 * fish.w * cos3),
    ];
    let (mut q, mut v) = (body.to_vec(), rate.to_vec());
    let ([mut x, mut y, mut angle], [mut vx, mut vy, mut spin]) = (body, rate);
    // From the centre of a link to the joint behind it, and from there to the centre of the next.
    let lengths = [[fish.a, fish.l2 / 2.0], [fish.l2 / 2.0, fish.b]];
    for ([behind, before], (next, next_spin)) in lengths.into_iter().zip(gait) {
        for (length, angle, spin) in [(behind, angle, spin), (before, next, next_spin)] {
            let (sin, cos) = angle.sin_cos();
            x += length * cos;
            y += length * sin;
            vx -= length * spin * sin;
            vy += length * spin * cos;
        }
        (angle, spin) = (next, next_spin);
        q.extend([x, y, angle]);
        v.extend([vx, vy, spin]);
    }
    State { t, q, v }
}

#[test]
fn start_is_consistent() {
    let mut random = Random::new(3);
    for _ in 0..10 {
        let fish: FishRobot = random.parameters(0.3);
        let [x, y, angle] = std::array::from_fn(|_| random.signed());
        let options = StartOptions::new()
            .with("x", x)
            .with("y", y)
            .with("angle", angle);
        let state = fish.start("table3", &options).expect("a start");
        let expected = follow(&fish, 0.0, [x, y, angle], [0.0; 3]);
        assert_all_close("start, q", &state.q, &expected.q, 2e-15);
        assert_all_close("start, v", &state.v, &expected.v, 1e-14);
        // In the middle of a stroke, with the body under way.
        let rate = std::array::from_fn(|_| random.signed());
        let expected = follow(&fish, random.signed(), [x, y, angle], rate);
        let mut guess = State {
            t: expected.t,
            ..state
        };
        guess.v[..3].copy_from_slice(&rate);
        let found = assemble(&fish, &guess, &["x1", "y1", "th1"]).expect("a state");
        assert_all_close("under way, q", &found.q, &expected.q, 2e-15);
        assert_all_close("under way, v", &found.v, &expected.v, 1e-14);
        for State { t, q, v } in [&found, &expected] {
            let (phi, phi_dot) = (residuals(&fish, *t, q), rates(&fish, *t, q, v));
            assert!(
                largest(&phi) < 1e-15 && largest(&phi_dot) < 1e-14,
                "{phi:?} {phi_dot:?}"
            );
        }
    }
}

#[test]
fn forces_are_equations_29_to_34() {
    let mut random = Random::new(4);
    for _ in 0..20 {
        let fish: FishRobot = random.parameters(0.3);
        let state = random.moved(fish.default_start().expect("a start"), 0.5);
        let force = Dense::of(&fish, &state).force;
        let (q, v) = (&state.q, &state.v);
        let velocity = [v[FishRobot::X3], v[FishRobot::Y3]];
        let lift = fish.lift(q[FishRobot::TH3], velocity);
        let mut expected = vec![0.0; 9];
        expected[FishRobot::X1] = fish.drag(fish.s, v[FishRobot::X1]);
        expected[FishRobot::Y1] = fish.drag(fish.s1, v[FishRobot::Y1]);
        expected[FishRobot::Y2] = fish.drag(fish.s2, v[FishRobot::Y2]);
        expected[FishRobot::X3] = lift[0];
        expected[FishRobot::Y3] = fish.drag(fish.s3, v[FishRobot::Y3]) + lift[1];
        let size = largest(&expected);
        assert_all_close("Q", force.as_slice(), &expected, 1e-13 * size);
        // Lift is perpendicular to the inflow.
        assert_close(
            "power of lift",
            lift[0] * velocity[0] + lift[1] * velocity[1],
            0.0,
            1e-12 * size,
        );
    }
}
