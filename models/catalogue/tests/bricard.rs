//! Bricard's linkage.

use crate::pose::Pose;
use catalogue::Bricard;
use nalgebra::{UnitQuaternion, Vector3};
use tests::{Dense, Random, assert_all_close, assert_close, largest};
use ukcore::equations::up;
use ukcore::manifold::Projector;
use ukcore::simulate::Sample;
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Simulation, Solver};

/// Two periods at a tight tolerance: the closed form of the angles, energy, no dense solve, and back at the start.
#[test]
fn it_moves_with_a_row_to_spare() {
    let start = super::start(&Bricard::default());
    let run = Simulation::new(Bricard::default())
        .tolerance(1e-12)
        .start(start)
        .every(0.25)
        .until(10.0)
        .expect("a run");
    assert_eq!(run.work().fallbacks, 0);
    let drift = run.energy_drift();
    println!("energy drift over 10 s: {drift:e}");
    assert!(drift < 1e-9, "{drift:e}");
    let bodies = [
        Bricard::R0_X,
        Bricard::R1_X,
        Bricard::R2_X,
        Bricard::R3_X,
        Bricard::R4_X,
    ];
    let axes = [
        Vector3::y(),
        Vector3::z(),
        Vector3::x(),
        Vector3::y(),
        Vector3::z(),
    ];
    let mut widest = 0.0_f64;
    for sample in run.samples() {
        let mut before = UnitQuaternion::identity();
        // Relative angles (a, b, a, b, a) with sin a + sin b + sin a sin b = 0.
        let angles = std::array::from_fn::<f64, 5, _>(|i| {
            let turn = Pose::of(sample.q, sample.v, bodies[i]).turn;
            let relative = before.inverse() * turn;
            before = turn;
            2.0 * relative.imag().dot(&axes[i]).atan2(relative.w)
        });
        let [a, b] = [angles[0].sin(), angles[1].sin()];
        widest = widest.max(a.abs());
        assert_close("the law of the angles", a + b + a * b, 0.0, 1e-9);
        for (i, angle) in angles.into_iter().enumerate() {
            let twin = [a, b][i % 2];
            assert_close("every other angle", angle.sin(), twin, 1e-9);
        }
    }
    assert!(widest > 0.3, "it moves: {widest}");
}

/// Below what independent rows keep in this mechanism, above what drift of 1e-6 lends to the spare one.
const RANK: f64 = 1e-4;

/// Against eq. 19 as it is printed, on the constraints and off them, where the spare row is not redundant.
#[test]
fn its_accelerations_are_those_of_eq_19() {
    let mut random = Random::new(5);
    let mechanism = Bricard::default().prepared::<f64>();
    let mut solver = Solver::new(&mechanism, SolverOptions::default());
    for state in super::run::<Bricard>(1e-9, 0.8, 5.6)
        .samples()
        .map(Sample::to_state)
    {
        let dense = Dense::of(&mechanism, &state);
        let expected =
            up::acceleration(&dense.mass, &dense.force, &dense.jacobian, &dense.rhs, RANK)
                .expect("M and A determine the motion");
        let scale = 1.0 + largest(expected.as_slice());
        let mut found = vec![0.0; expected.len()];
        for off in [0.0, 1e-12, 1e-10, 1e-8, 1e-6] {
            let mut near = state.clone();
            for x in near.q.iter_mut().chain(&mut near.v) {
                *x += off * random.signed();
            }
            let bound = (1e-9 + 1e5 * off) * scale;
            let certificate = mechanism.acceleration(near.t, &near.q, &near.v, &mut found);
            assert!(certificate > 0.0 && certificate < 1.0, "{certificate}");
            assert_all_close("straight line", &found, expected.as_slice(), bound);
            (solver.acceleration(near.t, &near.q, &near.v, &mut found))
                .unwrap_or_else(|e| panic!("{off:e} off: {e}"));
            assert_all_close("q̈", &found, expected.as_slice(), bound);
        }
        for off in [1e-10, 1e-6, 1e-3] {
            let (mut q, mut v) = (state.q.clone(), state.v.clone());
            for x in q.iter_mut().chain(&mut v) {
                *x += off * random.signed();
            }
            let mut projector = Projector::new(&mechanism);
            let position = projector.position(state.t, &mut q, &v).expect("near");
            let velocity = projector.velocity(state.t, &q, &mut v).expect("near");
            let rest = position.residual.max(velocity.residual);
            assert!(rest < 1e-12, "{off:e} off: {rest:e}");
        }
    }
}
