//! Degrees of freedom as they are counted by hand, redundant rows, and energies.

use catalogue::{
    Andrews, Arm, Bicycle, Bricard, Governor, HeavyTop, JansenLeg, RollingDisc, Stewart, Walker,
};
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Solver};

ukcore::verify!(
    Andrews,
    Arm,
    Bicycle,
    Bricard,
    Governor,
    HeavyTop,
    JansenLeg,
    RollingDisc,
    Stewart,
    Walker
);

#[test]
fn mechanisms_have_the_freedoms_counted_by_hand() {
    fn check<M: Mechanism>(freedoms: usize, redundant: usize) {
        let (mechanism, name) = (M::default(), M::SPEC.name);
        let start = super::start(&mechanism);
        let solution = Solver::new(mechanism, SolverOptions::default())
            .solve(start.t, &start.q, &start.v)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(
            (solution.degrees_of_freedom, solution.redundant.len()),
            (freedoms, redundant),
            "{name}"
        );
    }
    check::<Andrews>(1, 0);
    // Speed, lean and steering.
    check::<Bicycle>(3, 0);
    check::<JansenLeg>(1, 0);
    check::<Walker>(1, 0);
    check::<Bricard>(1, 1);
    // Spin, slider, two rods.
    check::<Governor>(4, 0);
    check::<Stewart>(0, 0);
    check::<HeavyTop>(3, 0);
    check::<RollingDisc>(3, 0);
    check::<Arm>(6, 0);
}

#[test]
fn energy_is_conserved() {
    fn check<M: Mechanism>(end: f64) {
        let run = super::run::<M>(1e-11, end, end);
        let drift = run.energy_drift();
        assert!(drift < 1e-9, "{}: {drift:e}", M::SPEC.name);
    }
    check::<Bicycle>(2.0);
    check::<HeavyTop>(1.0);
    check::<RollingDisc>(1.0);
    check::<Arm>(1.0);
}
