//! The Stewart platform.

use crate::pose::Pose;
use catalogue::Stewart;
use nalgebra::{Matrix6, UnitQuaternion, Vector3, Vector6};
use tests::assert_all_close;
use ukcore::solver::SolverOptions;
use ukcore::{Solver, State, assemble};

/// The pose that the lengths of the legs are made for, at time t, s.
fn pose(stewart: &Stewart, t: f64) -> Pose {
    let (sin, cos) = (stewart.w * t).sin_cos();
    let yaw = UnitQuaternion::from_scaled_axis(Vector3::z() * (stewart.turn * sin));
    let nod = UnitQuaternion::from_scaled_axis(Vector3::x() * (stewart.turn * (1.0 - cos)));
    Pose {
        centre: Vector3::z() * (stewart.height + stewart.rise * sin),
        turn: yaw * nod,
        velocity: Vector3::z() * (stewart.rise * stewart.w * cos),
        omega: Vector3::z() * (stewart.turn * stewart.w * cos)
            + yaw * Vector3::x() * (stewart.turn * stewart.w * sin),
    }
}

/// Joint (i, s) on the ground, and that on the platform in its frame.
fn ends(stewart: &Stewart, i: usize, s: usize) -> [Vector3<f64>; 2] {
    let third = std::f64::consts::TAU / 3.0;
    let (turn, side) = (third * i as f64, 2.0 * s as f64 - 1.0);
    let ring = |r: f64, angle: f64| Vector3::new(r * angle.cos(), r * angle.sin(), 0.0);
    [
        ring(stewart.base, turn + side * stewart.spread),
        ring(stewart.plate, turn + side * (third / 2.0 - stewart.spread)),
    ]
}

fn at(t: f64) -> State {
    let mut state = State::zeros::<Stewart>();
    state.t = t;
    pose(&Stewart::default(), t).enter(&mut state, Stewart::PLATFORM_X);
    state
}

#[test]
fn it_goes_where_its_legs_drive_it() {
    let run = super::run::<Stewart>(1e-10, 0.2, 5.0);
    for sample in run.samples() {
        let expected = at(sample.t);
        assert_all_close("q", sample.q, &expected.q, 1e-9);
        assert_all_close("q̇", sample.v, &expected.v, 1e-8);
    }
}

/// Place and attitude from the lengths of the legs, from a sketch half a step away.
#[test]
fn its_pose_follows_from_the_lengths() {
    for t in [0.3, 0.9, 1.7, 2.6] {
        let guess = State { t, ..at(t - 0.15) };
        let found = assemble(Stewart::default(), &guess, &[]).expect("a start");
        assert_all_close("q", &found.q, &at(t).q, 1e-12);
        assert_all_close("q̇", &found.v, &at(t).v, 1e-11);
    }
}

/// Σ F = m (a + g) and Σ arm × F = J ω̇ + ω × J ω for the six legs; λ is half the force over the length.
#[test]
fn its_legs_push_as_newton_and_euler_say() {
    let stewart = Stewart::default();
    for t in [0.0, 0.4, 1.1, 2.3] {
        let state = at(t);
        let solution = Solver::new(&stewart, SolverOptions::default())
            .solve(t, &state.q, &state.v)
            .expect("accelerations");
        let pose = self::pose(&stewart, t);
        let h = 1e-3;
        // Of fourth order.
        let rate = |of: &dyn Fn(Pose) -> Vector3<f64>| {
            let at = |k: f64| of(self::pose(&stewart, t + k * h));
            ((at(1.0) - at(-1.0)) * 8.0 - at(2.0) + at(-2.0)) / (12.0 * h)
        };
        let (a, alpha) = (rate(&|p| p.velocity), rate(&|p| p.omega));
        let turned = |v: Vector3<f64>| {
            let inertia = Vector3::from(stewart.inertia);
            pose.turn * inertia.component_mul(&(pose.turn.inverse() * v))
        };
        let force = (a + Vector3::z() * stewart.g) * stewart.m;
        let moment = turned(alpha) + pose.omega.cross(&turned(pose.omega));
        let mut columns = Matrix6::zeros();
        for leg in 0..6 {
            let [foot, head] = ends(&stewart, leg / 2, leg % 2);
            let arm = pose.turn * head;
            let along = pose.centre + arm - foot;
            columns.fixed_view_mut::<3, 1>(0, leg).copy_from(&along);
            columns
                .fixed_view_mut::<3, 1>(3, leg)
                .copy_from(&arm.cross(&along));
        }
        let both = Vector6::from_iterator(force.iter().chain(&moment).copied());
        let expected = columns.lu().solve(&both).expect("regular") / 2.0;
        let found: Vec<f64> = Stewart::LEG
            .as_flattened()
            .iter()
            .map(|row| solution.multipliers[*row])
            .collect();
        assert_all_close("λ", &found, expected.as_slice(), 1e-7);
    }
}
