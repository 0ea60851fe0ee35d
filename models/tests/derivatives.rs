//! A and b of every model against differences of its constraints, which share nothing with what is differentiated otherwise; patterns of
//! zeros.

use models::{Model, Visitor, visit};
use tests::{Dense, Random, assert_close, largest};
use ukcore::{Mechanism, State};

/// Random states and parameters tried per model.
const STATES: usize = 10;
/// Agreement asked for, relative to the largest entry.
const ACCURACY: f64 = 1e-7;

/// φ̇ and ψ at velocity `v`.
fn rates<M: Mechanism>(model: &M, t: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
    let mut rate = vec![0.0; M::SPEC.m()];
    model.prepared().residual_rate(t, q, v, &mut rate);
    rate
}

/// Runs `test` on a few random models at random states, which satisfy no constraint.
fn random_states<M: Model>(seed: u64, mut test: impl FnMut(&M, &State)) {
    let mut random = Random::new(seed);
    for _ in 0..STATES {
        // Only states matter here, so parameters may well be such that no start exists: default ones make the state.
        let state = random.moved(M::default().default_start().expect("a start"), 0.2);
        test(&random.parameters(0.2), &state);
    }
}

/// Derivative at 0 by central differences of order 4: error h⁴ f⁗′/30 and rounding/h, so h = 1e-4 leaves nine digits of functions
/// that vary over 1, and eight of those that oscillate with 100 rad/s.
fn difference(f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    const H: f64 = 1e-4;
    let at = |k: f64| f(k * H);
    let (a, b, c, d) = (at(-2.0), at(-1.0), at(1.0), at(2.0));
    (0..a.len())
        .map(|i| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * H))
        .collect()
}

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
                    let column = difference(|h| {
                        let mut phi = vec![0.0; M::SPEC.holonomic];
                        model
                            .prepared()
                            .residual(state.t, &moved(&state.q, &unit, h), &mut phi);
                        phi
                    });
                    for (i, slope) in column.iter().enumerate() {
                        assert_close(
                            &format!("{}: ∂φ[{i}]/∂q[{j}]", M::ID),
                            dense.jacobian[(i, j)],
                            *slope,
                            ACCURACY * scale,
                        );
                    }
                    let column =
                        difference(|h| rates(model, state.t, &state.q, &moved(&state.v, &unit, h)));
                    for (i, slope) in column.iter().enumerate() {
                        assert_close(
                            &format!("{}: A[{i}, {j}]", M::ID),
                            dense.jacobian[(i, j)],
                            *slope,
                            ACCURACY * scale,
                        );
                    }
                }
                let slopes = difference(|h| {
                    rates(model, state.t + h, &moved(&state.q, &state.v, h), &state.v)
                });
                let scale = largest(dense.rhs.iter()).max(1.0);
                for (i, slope) in slopes.iter().enumerate() {
                    assert_close(
                        &format!("{}: b[{i}]", M::ID),
                        dense.rhs[i],
                        -slope,
                        ACCURACY * scale,
                    );
                }
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
