//! After setup, an acceleration allocates nothing.

use crate::every::{every_model, start};
use tests::solver_by;
use ukcore::manifold::Projector;
use ukcore::solver::Formula;

#[test]
fn acceleration_allocates_nothing() {
    every_model(|model| {
        let mechanism = &model.mechanism;
        let spec = mechanism.spec();
        let state = start(model);
        for formula in [Formula::Auto, Formula::Kkt, Formula::UdwadiaPhohomsiri] {
            let mut solver = solver_by(formula, mechanism);
            let mut out = vec![0.0; spec.n()];
            let count = allocation_counter::measure(|| {
                for k in 0..10 {
                    let t = state.t + 1e-3 * f64::from(k);
                    let result = solver.acceleration(t, &state.q, &state.v, &mut out);
                    assert!(result.is_ok(), "{}: {result:?}", model.id);
                }
            });
            assert_eq!(count.count_total, 0, "{}, {formula:?}: {count:?}", model.id);
        }
    });
}

#[test]
fn evaluation_and_projection_allocate_nothing() {
    every_model(|model| {
        let mechanism = &model.mechanism;
        let spec = mechanism.spec();
        let mut state = start(model);
        let mut projector = Projector::new(mechanism);
        let mut phi = vec![0.0; spec.holonomic];
        let mut rate = vec![0.0; spec.m()];
        let mut outputs = vec![0.0; spec.outputs.len()];
        let mut steps = 0;
        let count = allocation_counter::measure(|| {
            for k in 0..3 {
                // Off the constraints, so that there is something to project.
                for (j, (q, v)) in state.q.iter_mut().zip(&mut state.v).enumerate() {
                    let off = 1e-6 * f64::from(k + 1) * (j as f64 + 1.0).sin();
                    *q += off;
                    *v -= off;
                }
                mechanism.residual(state.t, &state.q, &mut phi);
                mechanism.residual_rate(state.t, &state.q, &state.v, &mut rate);
                mechanism.outputs(state.t, &state.q, &state.v, &mut outputs);
                let energy = mechanism.energy(state.t, &state.q, &state.v);
                assert!(energy.total().is_finite(), "{}", model.id);
                let position = projector.position(state.t, &mut state.q, &state.v);
                let velocity = projector.velocity(state.t, &state.q, &mut state.v);
                assert!(position.is_ok() && velocity.is_ok(), "{}", model.id);
                for correction in [position, velocity] {
                    steps += correction.map_or(0, |c| c.iterations);
                }
            }
        });
        assert!(
            spec.m() == 0 || steps > 0,
            "{}: nothing was projected",
            model.id
        );
        assert_eq!(count.count_total, 0, "{}: {count:?}", model.id);
    });
}
