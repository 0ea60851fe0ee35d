//! All formulas give one acceleration: eqs. 13 and 19, the saddle-point system, the solver's fast paths, and a dense oracle of the
//! tests' own.

use crate::every::every_state;
use models::UChain;
use nalgebra::DVector;
use tests::{Dense, FORMULAS, Random, assert_close, largest, solver_by};
use ukcore::Solver;
use ukcore::equations::{kkt, uk, up};
use ukcore::solver::{Formula, SolverOptions};

/// Agreement asked for, relative to the largest acceleration.
const ACCURACY: f64 = 1e-9;
/// Relative rank tolerance of the printed formulas: above the rounding of projected states, below any dependence in the models.
const RANK: f64 = 1e-10;

#[test]
fn formulas_agree_with_the_oracle() {
    every_state(41, |model, state, _, _| {
        let spec = model.mechanism.spec();
        let dense = Dense::of(&model.mechanism, state);
        let expected = dense.udwadia_phohomsiri();
        let scale = largest(expected.iter()).max(1.0);
        // Regularity relative to the largest mass.
        let values = dense.mass.clone().symmetric_eigenvalues();
        let regular = values.min() > 1e-9 * values.max();
        for formula in FORMULAS {
            if formula == Formula::UdwadiaKalaba && !regular {
                continue;
            }
            let mut solver = solver_by(formula, &model.mechanism);
            let solution = solver
                .solve(state.t, &state.q, &state.v)
                .unwrap_or_else(|e| panic!("{}, {formula:?}: {e}", model.id));
            let mut fast = vec![0.0; spec.n()];
            solver
                .acceleration(state.t, &state.q, &state.v, &mut fast)
                .unwrap_or_else(|e| panic!("{}, {formula:?}: {e}", model.id));
            for i in 0..spec.n() {
                let what = format!("{}, {formula:?}, {}", model.id, spec.coords[i]);
                assert_close(
                    &what,
                    solution.acceleration[i],
                    expected[i],
                    ACCURACY * scale,
                );
                assert_close(&what, fast[i], expected[i], ACCURACY * scale);
            }
            if formula == Formula::Auto {
                let chosen = if regular {
                    Formula::UdwadiaKalaba
                } else {
                    Formula::UdwadiaPhohomsiri
                };
                assert_eq!(solution.formula, chosen, "{}", model.id);
            }
        }
    });
}

#[test]
fn printed_formulas_agree_with_the_solver() {
    every_state(42, |model, state, solver, _| {
        let spec = model.mechanism.spec();
        let solution = solver
            .solve(state.t, &state.q, &state.v)
            .unwrap_or_else(|e| panic!("{}: {e}", model.id));
        let Dense {
            mass,
            force,
            nonideal,
            jacobian,
            rhs,
        } = Dense::of(&model.mechanism, state);
        let expected = DVector::from_vec(solution.acceleration);
        let scale = largest(expected.iter()).max(1.0);
        let agrees = |equation: &str, found: &DVector<f64>| {
            let off = largest((found - &expected).iter());
            assert!(
                off <= ACCURACY * scale,
                "{}, {equation}: {off:e} off",
                model.id
            );
        };
        let all = &force + &nonideal;
        let by_19 =
            up::acceleration(&mass, &all, &jacobian, &rhs, RANK).expect("[M | Aᵀ] has full rank");
        agrees("eq. 19", &by_19);
        // The saddle-point matrix is regular only without redundant constraints.
        if solution.redundant.is_empty() {
            let (by_kkt, _) = kkt::solve(&mass, &all, &jacobian, &rhs)
                .expect("the saddle-point matrix is regular");
            agrees("saddle point", &by_kkt);
        }
        if solution.formula != Formula::UdwadiaKalaba {
            return;
        }
        let by_13 = uk::acceleration_nonideal(&mass, &force, &nonideal, &jacobian, &rhs, RANK);
        agrees("eq. 13", &by_13.expect("M is regular"));
        if !spec.structure.nonideal {
            let by_15 = uk::acceleration(&mass, &force, &jacobian, &rhs, RANK);
            agrees("eq. 15", &by_15.expect("M is regular"));
        }
        let ideal = uk::ideal_force(&mass, &force, &jacobian, &rhs, RANK).expect("M is regular");
        let nonideal = uk::nonideal_force(&mass, &nonideal, &jacobian, RANK).expect("M is regular");
        let size = ideal.norm().max(1.0);
        for (equation, found, expected) in [
            ("eq. 11", ideal, solution.ideal_force),
            ("eq. 12", nonideal, solution.nonideal_force),
        ] {
            let off = (found - DVector::from_vec(expected)).norm();
            assert!(
                off <= ACCURACY * size,
                "{}, {equation}: {off:e} off",
                model.id
            );
        }
    });
}

#[test]
fn equal_masses_have_the_short_formulas() {
    // Eqs. 17 and 18: the chain has M = m I.
    let mut random = Random::new(43);
    for g in [9.8, 0.0] {
        let chain = UChain {
            m: 0.3,
            g,
            ..UChain::default()
        };
        let state = random.consistent_state(&chain, 0.01);
        let solution = Solver::new(&chain, SolverOptions::default())
            .solve(state.t, &state.q, &state.v)
            .expect("the chain's constraints are independent");
        let Dense {
            force,
            jacobian,
            rhs,
            ..
        } = Dense::of(&chain, &state);
        let expected = DVector::from_vec(solution.ideal_force);
        let by_17 = uk::equal_masses(chain.m, &force, &jacobian, &rhs, RANK);
        assert!(
            (by_17 - &expected).norm() <= ACCURACY * expected.norm(),
            "eq. 17"
        );
        if g == 0.0 {
            let by_18 = uk::equal_masses_free(chain.m, &jacobian, &rhs, RANK);
            assert!(
                (by_18 - &expected).norm() <= ACCURACY * expected.norm(),
                "eq. 18"
            );
        }
    }
}
