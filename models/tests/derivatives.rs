//! A and b of every model against differences of its constraints, which share nothing with what is differentiated otherwise; patterns of
//! zeros.

use models::{Model, Visitor, visit};
use tests::{Dense, Random, assert_all_close, difference, largest, rates, residuals};
use ukcore::State;

/// Random states and parameters tried per model.
const STATES: usize = 10;
/// Agreement asked for, relative to the largest entry.
const ACCURACY: f64 = 1e-7;

/// Runs `test` on a few random models at random states, which satisfy no constraint.
fn random_states<M: Model>(seed: u64, mut test: impl FnMut(&M, &State)) {
    let mut random = Random::new(seed);
    for _ in 0..STATES {
        // Only states matter here, so parameters may well be such that no start exists: default ones make the state.
        let state = random.moved(M::default().default_start().expect("a start"), 0.2);
        test(&random.parameters(0.2), &state);
    }
}

/// The step of differences.
const H: f64 = 1e-4;

#[test]
fn jacobian_and_rhs_by_differences() {
    struct Differences;
    impl Visitor for Differences {
        fn visit<M: Model>(&mut self) {
            random_states::<M>(32, |model, state| {
                let dense = Dense::of(model, state);
                let scale = largest(dense.jacobian.iter()).max(1.0);
                let moved = |x: &[f64], direction: &[f64], h: f64| -> Vec<f64> {
                    x.iter().zip(direction).map(|(x, d)| x + h * d).collect()
                };
                for j in 0..M::SPEC.n() {
                    let mut unit = vec![0.0; M::SPEC.n()];
                    unit[j] = 1.0;
                    let found: Vec<f64> = dense.jacobian.column(j).iter().copied().collect();
                    let (bound, holonomic) = (ACCURACY * scale, &found[..M::SPEC.holonomic]);
                    let column =
                        difference(H, |h| residuals(model, state.t, &moved(&state.q, &unit, h)));
                    let what = format!("{}: ∂φ/∂q[{j}]", M::ID);
                    assert_all_close(&what, holonomic, &column, bound);
                    let column = difference(H, |h| {
                        rates(model, state.t, &state.q, &moved(&state.v, &unit, h))
                    });
                    let what = format!("{}: A, column {j}", M::ID);
                    assert_all_close(&what, &found, &column, bound);
                }
                let slopes = difference(H, |h| {
                    rates(model, state.t + h, &moved(&state.q, &state.v, h), &state.v)
                });
                let scale = largest(dense.rhs.iter()).max(1.0);
                let rhs: Vec<f64> = slopes.iter().map(|slope| -slope).collect();
                let what = format!("{}: b", M::ID);
                assert_all_close(&what, dense.rhs.as_slice(), &rhs, ACCURACY * scale);
            });
        }
    }
    visit(&mut Differences);
}

#[test]
fn patterns_hold_all_that_is_not_zero() {
    struct Patterns;
    impl Visitor for Patterns {
        fn visit<M: Model>(&mut self) {
            random_states::<M>(35, |model, state| {
                let dense = Dense::of(model, state);
                let structure = &M::SPEC.structure;
                for (matrix, pattern) in [
                    (&dense.mass, structure.mass_pattern),
                    (&dense.jacobian, structure.jacobian_pattern),
                ] {
                    for i in 0..matrix.nrows() {
                        for j in 0..matrix.ncols() {
                            let known = pattern.contains(&(i, j));
                            assert!(
                                known || matrix[(i, j)] == 0.0,
                                "{}: entry ({i}, {j})",
                                M::ID
                            );
                        }
                    }
                }
                for i in structure.massless {
                    assert!(
                        dense.mass.row(*i).iter().all(|x| *x == 0.0),
                        "{}: row {i}",
                        M::ID
                    );
                }
                if structure.mass_diagonal {
                    assert!(
                        structure.mass_pattern.iter().all(|(i, j)| i == j),
                        "{}",
                        M::ID
                    );
                }
                if !structure.nonideal {
                    assert!(dense.nonideal.iter().all(|x| *x == 0.0), "{}", M::ID);
                }
            });
        }
    }
    visit(&mut Patterns);
}
