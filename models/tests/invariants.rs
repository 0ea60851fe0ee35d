//! What must hold whatever the motion: energy, momentum, d'Alembert's and Gauss's principles.

use crate::every::{every_model, every_state, start};
use models::{KnifeEdge, Model, Pendulum, RigidBody, StartOptions};
use nalgebra::DVector;
use std::collections::BTreeSet;
use tests::{Dense, assert_close, largest};
use ukcore::{Prepared, Simulation, State, Trajectory};

/// Relative accuracy of quantities computed once from a state: a solve loses some digits to the condition of the constraints.
const ROUNDING: f64 = 1e-9;

/// The motion from `start` to `end` at a tolerance of 1e-12.
fn exactly(mechanism: impl Into<Prepared>, start: State, end: f64) -> Trajectory {
    let mechanism = mechanism.into();
    let name = mechanism.spec().name;
    Simulation::new(mechanism)
        .start(start)
        .tolerance(1e-12)
        .until(end)
        .unwrap_or_else(|e| panic!("{name}: {}", e.error))
}

#[test]
fn energy_is_conserved() {
    every_model(|model| {
        let mechanism = &model.mechanism;
        let spec = mechanism.spec();
        if !spec.structure.conservative {
            return;
        }
        let run = exactly(mechanism, start(model), model.duration);
        let drift = run.energy_drift();
        assert!(drift < 1e-9, "{}: energy drifts by {drift:e}", model.id);
    });
}

#[test]
fn the_right_models_are_conservative() {
    every_model(|model| {
        let mechanism = &model.mechanism;
        let spec = mechanism.spec();
        let expected = !["fish", "kapitza", "rough-block"].contains(&model.id.as_str());
        assert_eq!(spec.structure.conservative, expected, "{}", model.id);
    });
}

#[test]
fn ideal_forces_do_no_virtual_work() {
    every_state(21, |model, state, solver, random| {
        let spec = model.mechanism.spec();
        let solution = solver
            .solve(state.t, &state.q, &state.v)
            .unwrap_or_else(|e| panic!("{}: {e}", model.id));
        let dense = Dense::of(&model.mechanism, state);
        let force = DVector::from_vec(solution.ideal_force.clone());
        let virtual_displacement = dense.tangent() * DVector::from_vec(random.vector(spec.n()));
        let work = force.dot(&virtual_displacement);
        let scale = force.norm() * virtual_displacement.norm();
        assert!(
            work.abs() <= ROUNDING * scale.max(1.0),
            "{}: {work:e} of {scale:e}",
            model.id
        );

        // The multipliers give the same force: Qc_id = Aᵀ λ.
        let by_multipliers = dense
            .jacobian
            .tr_mul(&DVector::from_vec(solution.multipliers.clone()));
        let off = (by_multipliers - &force).norm();
        assert!(
            off <= ROUNDING * force.norm().max(1.0),
            "{}: Aᵀλ off by {off:e}",
            model.id
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
            model.id,
            balance.norm()
        );
        let off = &dense.jacobian * &acceleration - &dense.rhs;
        let scale = dense.jacobian.norm() * acceleration.norm() + dense.rhs.norm();
        assert!(
            off.norm() <= ROUNDING * scale.max(1.0),
            "{}: A q̈ off by {:e}",
            model.id,
            off.norm()
        );
        assert_eq!(
            solution.degrees_of_freedom + solution.rank,
            spec.n(),
            "{}",
            model.id
        );
    });
}

#[test]
fn gauss_principle() {
    every_state(22, |model, state, solver, random| {
        let spec = model.mechanism.spec();
        let mut actual = vec![0.0; spec.n()];
        solver
            .acceleration(state.t, &state.q, &state.v, &mut actual)
            .unwrap_or_else(|e| panic!("{}: {e}", model.id));
        let actual = DVector::from_vec(actual);
        let dense = Dense::of(&model.mechanism, state);
        let constraint = dense.gauss(&actual);
        let tangent = dense.tangent();
        let scale = actual.norm().max(1.0);
        for _ in 0..5 {
            // Any feasible acceleration differs from the actual one by a virtual displacement.
            let change = &tangent * DVector::from_vec(random.vector(spec.n())) * scale;
            let feasible = &actual + &change;
            let excess = dense.gauss(&feasible) - constraint;
            let expected = 0.5 * change.dot(&(&dense.mass * &change));
            let size = dense.mass.norm() * scale * scale + dense.force.norm() * scale;
            assert_close(&model.id, excess, expected, ROUNDING * size.max(1.0));
            assert!(
                excess >= -ROUNDING * size.max(1.0),
                "{}: {excess:e}",
                model.id
            );
        }
    });
}

#[test]
fn momentum_of_the_free_body_is_fixed_in_space() {
    let body = RigidBody::default();
    let start = body.default_start().expect("a start");
    let run = exactly(body, start, 20.0);
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
    let run = exactly(pendulum, start, 10.0);
    for s in run.samples() {
        assert_close("momentum", s.q[0] * s.v[1] - s.q[1] * s.v[0], 2.0, 1e-10);
    }
}

#[test]
fn spin_of_the_knife_edge_is_constant() {
    let knife = KnifeEdge::default();
    let start = knife.default_start().expect("a start");
    let run = exactly(knife, start, 10.0);
    for s in run.samples() {
        assert_close("spin", s.v[KnifeEdge::TH], 1.0, 1e-13);
    }
}

#[test]
fn starts_are_consistent() {
    every_model(|model| {
        let mechanism = &model.mechanism;
        for start in model.starts {
            let state = model
                .start(mechanism, start.name, &StartOptions::new())
                .unwrap_or_else(|e| panic!("{}, {}: {e}", model.id, start.name));
            let residuals = ukcore::assemble::residuals(mechanism, &state)
                .unwrap_or_else(|e| panic!("{}, {}: {e}", model.id, start.name));
            let off = largest(residuals.position.iter().chain(&residuals.velocity));
            assert!(off < 1e-13, "{}, {}: {off:e}", model.id, start.name);
            for option in start.options {
                assert!(
                    mechanism.get(option.name).is_err(),
                    "{}: `{}` is a parameter, too",
                    model.id,
                    option.name
                );
            }
            let wrong = StartOptions::new().with("no such option", 1.0);
            assert!(
                model.start(mechanism, start.name, &wrong).is_err(),
                "{}",
                model.id
            );
        }
        assert!(
            model
                .start(mechanism, "no such start", &StartOptions::new())
                .is_err(),
            "{}",
            model.id
        );
        assert!(
            model.duration > 0.0 && !model.summary.is_empty(),
            "{}",
            model.id
        );
    });
    let entries = models::entries();
    let ids: BTreeSet<_> = entries.iter().map(|model| &model.id).collect();
    assert_eq!(ids.len(), entries.len(), "two models share a name");
}
