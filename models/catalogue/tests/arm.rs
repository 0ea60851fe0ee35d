//! The serial arm.

use catalogue::Arm;
use tests::assert_all_close;
use ukcore::Solver;
use ukcore::solver::SolverOptions;

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
    let state = super::start(&Arm::default());
    let solution = Solver::new(Arm::default(), SolverOptions::default())
        .solve(0.0, &state.q, &state.v)
        .expect("accelerations");
    assert_all_close("q̈", &solution.acceleration, &expected, 1e-9);
}
