//! Bricard's linkage.

use catalogue::{Bricard, Pose};
use nalgebra::{UnitQuaternion, Vector3};
use tests::assert_close;
use ukcore::Simulation;
use ukcore::model::Model;

/// Two periods at a tight tolerance: the closed form of the angles, energy, no dense solve, and back at the start.
#[test]
fn it_moves_with_a_row_to_spare() {
    let start = Bricard::default().default_start().expect("a start");
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
