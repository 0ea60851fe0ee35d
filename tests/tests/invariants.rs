//! What must hold whatever the motion: energy, momentum, d'Alembert's and Gauss's principles.

use models::{Entry, KnifeEdge, Model, Pendulum, RigidBody, StartOptions};
use nalgebra::DVector;
use tests::{Check, Dense, Random, assert_close, every_model, largest};
use ukcore::{Simulation, Solver, SolverOptions};

/// Relative accuracy of quantities computed once from a state: a solve loses some digits to the condition of the constraints.
const ROUNDING: f64 = 1e-9;

/// Random consistent states tried per model.
const STATES: usize = 20;

#[test]
fn energy_is_conserved() {
    struct Energy;
    impl Check for Energy {
        fn check<M: Model>(&self) {
            if !M::SPEC.structure.conservative {
                return;
            }
            let model = M::default();
            let start = model.default_start().expect("the default start exists");
            let run = Simulation::new(model)
                .start(start)
                .tolerance(1e-12)
                .until(M::duration())
                .unwrap_or_else(|e| panic!("{}: {}", M::ID, e.error));
            let drift = run.energy_drift();
            assert!(drift < 1e-9, "{}: energy drifts by {drift:e}", M::ID);
        }
    }
    every_model(&Energy);
}

#[test]
fn the_right_models_are_conservative() {
    struct List;
    impl Check for List {
        fn check<M: Model>(&self) {
            let expected = !["fish", "kapitza", "rough_block"].contains(&M::ID);
            assert_eq!(M::SPEC.structure.conservative, expected, "{}", M::ID);
        }
    }
    every_model(&List);
}

#[test]
fn ideal_forces_do_no_virtual_work() {
    struct Work;
    impl Check for Work {
        fn check<M: Model>(&self) {
            let mut random = Random::new(21);
            let model = M::default();
            let mut solver = Solver::new(&model, SolverOptions::default());
            for _ in 0..STATES {
                let state = random.consistent_state(&model, 0.01);
                let solution = solver
                    .solve(state.t, &state.q, &state.v)
                    .unwrap_or_else(|e| panic!("{}: {e}", M::ID));
                let dense = Dense::of(&model, &state);
                let force = DVector::from_vec(solution.ideal_force.clone());
                let virtual_displacement =
                    dense.tangent() * DVector::from_vec(random.vector(M::SPEC.n()));
                let work = force.dot(&virtual_displacement);
                let scale = force.norm() * virtual_displacement.norm();
                assert!(
                    work.abs() <= ROUNDING * scale.max(1.0),
                    "{}: {work:e} of {scale:e}",
                    M::ID
                );

                // The multipliers give the same force: Qc_id = Aᵀ λ.
                let by_multipliers = dense
                    .jacobian
                    .tr_mul(&DVector::from_vec(solution.multipliers.clone()));
                let off = (by_multipliers - &force).norm();
                assert!(
                    off <= ROUNDING * force.norm().max(1.0),
                    "{}: Aᵀλ off by {off:e}",
                    M::ID
                );

                // Eq. 13 and eq. 5 hold.
                let acceleration = DVector::from_vec(solution.acceleration.clone());
                let balance = &dense.mass * &acceleration
                    - &dense.force
                    - &force
                    - DVector::from_vec(solution.nonideal_force.clone());
                let scale = dense.force.norm() + force.norm();
                assert!(
                    balance.norm() <= ROUNDING * scale.max(1.0),
                    "{}: M q̈ off by {:e}",
                    M::ID,
                    balance.norm()
                );
                let off = &dense.jacobian * &acceleration - &dense.rhs;
                let scale = dense.jacobian.norm() * acceleration.norm() + dense.rhs.norm();
                assert!(
                    off.norm() <= ROUNDING * scale.max(1.0),
                    "{}: A q̈ off by {:e}",
                    M::ID,
                    off.norm()
                );
                assert_eq!(
                    solution.degrees_of_freedom + solution.rank,
                    M::SPEC.n(),
                    "{}",
                    M::ID
                );
            }
        }
    }
    every_model(&Work);
}

#[test]
fn gauss_principle() {
    struct Gauss;
    impl Check for Gauss {
        fn check<M: Model>(&self) {
            let mut random = Random::new(22);
            let model = M::default();
            let mut solver = Solver::new(&model, SolverOptions::default());
            for _ in 0..STATES {
                let state = random.consistent_state(&model, 0.01);
                let mut actual = vec![0.0; M::SPEC.n()];
                solver
                    .acceleration(state.t, &state.q, &state.v, &mut actual)
                    .unwrap_or_else(|e| panic!("{}: {e}", M::ID));
                let actual = DVector::from_vec(actual);
                let dense = Dense::of(&model, &state);
                let constraint = dense.gauss(&actual);
                let tangent = dense.tangent();
                let scale = actual.norm().max(1.0);
                for _ in 0..5 {
                    // Any feasible acceleration differs from the actual one by a virtual displacement.
                    let change = &tangent * DVector::from_vec(random.vector(M::SPEC.n())) * scale;
                    let feasible = &actual + &change;
                    let excess = dense.gauss(&feasible) - constraint;
                    let expected = 0.5 * change.dot(&(&dense.mass * &change));
                    let size = dense.mass.norm() * scale * scale + dense.force.norm() * scale;
                    assert_close(M::ID, excess, expected, ROUNDING * size.max(1.0));
                    assert!(excess >= -ROUNDING * size.max(1.0), "{}: {excess:e}", M::ID);
                }
            }
        }
    }
    every_model(&Gauss);
}

#[test]
fn momentum_of_the_free_body_is_fixed_in_space() {
    let body = RigidBody::default();
    let start = body.default_start().expect("a start");
    let run = Simulation::new(body)
        .start(start)
        .tolerance(1e-12)
        .until(20.0)
        .unwrap_or_else(|e| panic!("{}", e.error));
    let outputs = run.outputs();
    for row in &outputs {
        for k in RigidBody::OUT_MOMENTUM_X..=RigidBody::OUT_MOMENTUM_Z {
            assert_close("momentum", row[k], outputs[0][k], 1e-9);
        }
    }
}

#[test]
fn momentum_about_a_pivot_without_gravity() {
    let pendulum = Pendulum {
        g: 0.0,
        ..Pendulum::default()
    };
    let options = StartOptions::new().with("rate", 2.0);
    let start = pendulum.start("released", &options).expect("a start");
    let run = Simulation::new(pendulum)
        .start(start)
        .tolerance(1e-12)
        .until(10.0)
        .unwrap_or_else(|e| panic!("{}", e.error));
    for s in run.samples() {
        assert_close("momentum", s.q[0] * s.v[1] - s.q[1] * s.v[0], 2.0, 1e-10);
    }
}

#[test]
fn spin_of_the_knife_edge_is_constant() {
    let knife = KnifeEdge::default();
    let start = knife.default_start().expect("a start");
    let run = Simulation::new(knife)
        .start(start)
        .tolerance(1e-12)
        .until(10.0)
        .unwrap_or_else(|e| panic!("{}", e.error));
    for s in run.samples() {
        assert_close("spin", s.v[KnifeEdge::TH], 1.0, 1e-13);
    }
}

#[test]
fn starts_are_consistent() {
    struct Starts;
    impl Check for Starts {
        fn check<M: Model>(&self) {
            let model = M::default();
            for start in M::starts() {
                let state = model
                    .start(start.name, &StartOptions::new())
                    .unwrap_or_else(|e| panic!("{}, {}: {e}", M::ID, start.name));
                let residuals = ukcore::assemble::residuals(&model, &state)
                    .unwrap_or_else(|e| panic!("{}, {}: {e}", M::ID, start.name));
                let off = largest(residuals.position.iter().chain(&residuals.velocity));
                assert!(off < 1e-13, "{}, {}: {off:e}", M::ID, start.name);
                for option in start.options {
                    assert!(
                        model.get(option.name).is_err(),
                        "{}: `{}` is a parameter, too",
                        M::ID,
                        option.name
                    );
                }
                let wrong = StartOptions::new().with("no such option", 1.0);
                assert!(model.start(start.name, &wrong).is_err(), "{}", M::ID);
            }
            assert!(
                model.start("no such start", &StartOptions::new()).is_err(),
                "{}",
                M::ID
            );
            assert!(
                M::duration() > 0.0 && !Entry::of::<M>().summary.is_empty(),
                "{}",
                M::ID
            );
        }
    }
    every_model(&Starts);
    let mut ids = models::ids();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), models::ids().len(), "two models share a name");
}
