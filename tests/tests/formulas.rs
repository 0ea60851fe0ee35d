//! All formulas give one acceleration: eqs. 13 and 19, the saddle-point system, the solver's fast paths, and a dense oracle of the
//! tests' own.

use models::Model;
use tests::{Check, Dense, Random, assert_close, every_model, largest};
use ukcore::{Formula, Solver, SolverOptions};

/// Agreement asked for, relative to the largest acceleration.
const ACCURACY: f64 = 1e-9;
/// Random consistent states tried per model.
const STATES: usize = 20;

#[test]
fn formulas_agree_with_the_oracle() {
    struct Formulas;
    impl Check for Formulas {
        fn check<M: Model>(&self) {
            let mut random = Random::new(41);
            for _ in 0..STATES {
                let model = M::default();
                let state = random.consistent_state(&model, 0.01);
                let dense = Dense::of(&model, &state);
                let expected = dense.udwadia_phohomsiri();
                let scale = largest(expected.iter()).max(1.0);
                // Regularity relative to the largest mass.
                let values = dense.mass.clone().symmetric_eigenvalues();
                let regular = values.min() > 1e-9 * values.max();
                for formula in [
                    Formula::Auto,
                    Formula::UdwadiaKalaba,
                    Formula::UdwadiaPhohomsiri,
                    Formula::Kkt,
                ] {
                    if formula == Formula::UdwadiaKalaba && !regular {
                        continue;
                    }
                    let options = SolverOptions {
                        formula,
                        ..SolverOptions::default()
                    };
                    let mut solver = Solver::new::<M>(options);
                    let solution = solver
                        .solve(&model, state.t, &state.q, &state.v)
                        .unwrap_or_else(|e| panic!("{}, {formula:?}: {e}", M::ID));
                    let mut fast = vec![0.0; M::SPEC.n()];
                    solver
                        .acceleration(&model, state.t, &state.q, &state.v, &mut fast)
                        .unwrap_or_else(|e| panic!("{}, {formula:?}: {e}", M::ID));
                    for i in 0..M::SPEC.n() {
                        let what = format!("{}, {formula:?}, {}", M::ID, M::SPEC.coords[i]);
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
                        assert_eq!(solution.formula, chosen, "{}", M::ID);
                    }
                }
            }
        }
    }
    every_model(&Formulas);
}
