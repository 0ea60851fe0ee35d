//! Andrews' mechanism.

use catalogue::Andrews;
use tests::{assert_all_close, assert_close};
use ukcore::Solver;
use ukcore::solver::SolverOptions;

#[test]
fn it_is_where_the_literature_has_it() {
    let state = super::start(&Andrews::default());
    let solution = Solver::new(Andrews::default(), SolverOptions::default())
        .solve(0.0, &state.q, &state.v)
        .expect("accelerations");
    let [crank, rod] = [0, 1].map(|k| solution.acceleration[Andrews::K_ANGLE[k]]);
    assert_close("β̈", crank, 14_222.443_919_954_114, 1e-5);
    assert_close("Θ̈", rod - crank, -10_666.832_939_965_586, 1e-5);
    let run = super::run::<Andrews>(1e-12, 0.03, 0.03);
    let expected = [
        15.810_771_195_153_707,
        -15.756_371_058_411_839,
        0.040_822_240_119_645_8,
        -0.534_730_116_342_079_6,
        0.524_409_965_879_954_1,
        0.534_730_116_342_079_6,
        1.048_080_741_041_938,
    ];
    let found: Vec<f64> = run.outputs().last().expect("the end").clone();
    assert_all_close("angles at 0.03 s", &found, &expected, 1e-10);
    // What the torque has done.
    let energy: Vec<f64> = run.energy().iter().map(|e| e.total()).collect();
    let work = Andrews::default().mom * (found[0] - state.q[Andrews::K_ANGLE[0]]);
    assert_close("energy", energy[1] - energy[0], work, 1e-11);
}
