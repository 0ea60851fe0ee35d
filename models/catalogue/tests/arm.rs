//! The serial arm.

use catalogue::{Arm, Pose};
use nalgebra::{Quaternion, Vector3};
use tests::assert_close;
use ukcore::model::Model;
use ukcore::{Solver, SolverOptions};

/// q̈ of the joint angles as an articulated-body library (Pinocchio 4.1) gives it.
#[test]
fn its_accelerations_are_those_of_its_joints() {
    let expected = [
        -0.226_082_528_672_934_5,
        22.873_151_785_849_11,
        -26.051_230_188_451_06,
        -0.182_111_134_019_642_4,
        5.580_395_585_970_376,
        2.076_642_635_644_206,
    ];
    let state = Arm::default().default_start().expect("a start");
    let solution = Solver::new(Arm::default(), SolverOptions::default())
        .solve(0.0, &state.q, &state.v)
        .expect("accelerations");
    let (mut carried, mut before) = (Vector3::zeros(), Vector3::zeros());
    let mut turn = nalgebra::UnitQuaternion::identity();
    for (link, x) in Arm::LINK_X.into_iter().enumerate() {
        let pose = Pose::of(&state.q, &state.v, x);
        let a = &solution.acceleration[x..];
        let twice = Quaternion::new(a[3], a[4], a[5], a[6]);
        let alpha = (twice * pose.turn.conjugate().into_inner()).vector() * 2.0;
        // α of a link is that of the link before, what its joint adds, and the turning of the joint's axis.
        let own = pose.omega - carried;
        let joint = alpha - before - carried.cross(&own);
        let axis = turn * Arm::axis(link);
        assert_close("q̈", axis.dot(&joint), expected[link], 1e-9);
        (before, carried, turn) = (alpha, pose.omega, pose.turn);
    }
}
