//! After setup, an acceleration allocates nothing.

use models::Model;
use tests::{Check, every_model};
use ukcore::manifold::Projector;
use ukcore::solver::Formula;
use ukcore::{Solver, SolverOptions};

#[test]
fn acceleration_allocates_nothing() {
    struct Acceleration;
    impl Check for Acceleration {
        fn check<M: Model>(&self) {
            let model = M::default();
            let state = model.default_start().expect("the default start exists");
            for formula in [Formula::Auto, Formula::Kkt, Formula::UdwadiaPhohomsiri] {
                let options = SolverOptions {
                    formula,
                    ..SolverOptions::default()
                };
                let mut solver = Solver::new(&model, options);
                let mut out = vec![0.0; M::SPEC.n()];
                let count = allocation_counter::measure(|| {
                    for k in 0..10 {
                        let t = state.t + 1e-3 * f64::from(k);
                        let result = solver.acceleration(t, &state.q, &state.v, &mut out);
                        assert!(result.is_ok(), "{}: {result:?}", M::ID);
                    }
                });
                assert_eq!(count.count_total, 0, "{}, {formula:?}: {count:?}", M::ID);
            }
        }
    }
    every_model(&Acceleration);
}

#[test]
fn evaluation_and_projection_allocate_nothing() {
    struct Evaluation;
    impl Check for Evaluation {
        fn check<M: Model>(&self) {
            let model = M::default();
            let mut state = model.default_start().expect("the default start exists");
            let mut projector = Projector::new(&model);
            let mut phi = vec![0.0; M::SPEC.holonomic];
            let mut rate = vec![0.0; M::SPEC.m()];
            let mut outputs = vec![0.0; M::SPEC.outputs.len()];
            let mut steps = 0;
            let prepared = model.prepared();
            let count = allocation_counter::measure(|| {
                for k in 0..3 {
                    // Off the constraints, so that there is something to project.
                    for (j, (q, v)) in state.q.iter_mut().zip(&mut state.v).enumerate() {
                        let off = 1e-6 * f64::from(k + 1) * (j as f64 + 1.0).sin();
                        *q += off;
                        *v -= off;
                    }
                    prepared.residual(state.t, &state.q, &mut phi);
                    prepared.residual_rate(state.t, &state.q, &state.v, &mut rate);
                    prepared.outputs(state.t, &state.q, &state.v, &mut outputs);
                    let energy = prepared.energy(state.t, &state.q, &state.v);
                    assert!(energy.total().is_finite(), "{}", M::ID);
                    let position = projector.position(state.t, &mut state.q, &state.v);
                    let velocity = projector.velocity(state.t, &state.q, &mut state.v);
                    assert!(position.is_ok() && velocity.is_ok(), "{}", M::ID);
                    for correction in [position, velocity] {
                        steps += correction.map_or(0, |c| c.iterations);
                    }
                }
            });
            assert!(
                M::SPEC.m() == 0 || steps > 0,
                "{}: nothing was projected",
                M::ID
            );
            assert_eq!(count.count_total, 0, "{}: {count:?}", M::ID);
        }
    }
    every_model(&Evaluation);
}
