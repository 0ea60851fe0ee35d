//! A, b, M and Q of every model against derivatives of its constraints and energies: by dual numbers (exact) and by differences.

use models::{FishRobot, Model};
use tests::{Check, Dense, Random, assert_close, every_model, largest};
use ukcore::scalar::Dual;
use ukcore::{Mechanism, State};

type Dual2 = Dual<Dual<f64>>;

/// Random states and parameters tried per model.
const STATES: usize = 10;
/// Agreement asked for, relative to the largest entry.
const ACCURACY: f64 = 1e-7;

fn constants(x: &[f64]) -> Vec<Dual<f64>> {
    x.iter().map(|x| Dual::new(*x, 0.0)).collect()
}

fn along(x: &[f64], direction: &[f64]) -> Vec<Dual<f64>> {
    x.iter()
        .zip(direction)
        .map(|(x, d)| Dual::new(*x, *d))
        .collect()
}

/// x + (ε₁ + ε₂) d: the coefficient of ε₁ε₂ in f is then the second derivative of f along d.
fn twice_along(x: f64, d: f64) -> Dual2 {
    Dual::new(Dual::new(x, d), Dual::new(d, 0.0))
}

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
        let state = random.state(&M::default(), 0.2);
        test(&random.parameters(0.2), &state);
    }
}

#[test]
fn jacobian_and_rhs_by_dual_numbers() {
    struct Duals;
    impl Check for Duals {
        fn check<M: Model>(&self) {
            random_states::<M>(31, |model, state| {
                let (n, m) = (M::SPEC.n(), M::SPEC.m());
                let dense = Dense::of(model, state);
                let scale = largest(dense.jacobian.iter()).max(1.0);
                let zero = Dual::new(0.0, 0.0);
                for j in 0..n {
                    let mut unit = vec![0.0; n];
                    unit[j] = 1.0;
                    // A = ∂φ̇/∂q̇ = ∂ψ/∂q̇.
                    let mut rate = vec![zero; m];
                    model.prepared().residual_rate(
                        Dual::new(state.t, 0.0),
                        &constants(&state.q),
                        &along(&state.v, &unit),
                        &mut rate,
                    );
                    for (i, rate) in rate.iter().enumerate() {
                        assert_close(
                            &format!("{}: A[{i}, {j}]", M::ID),
                            dense.jacobian[(i, j)],
                            rate.eps,
                            ACCURACY * scale,
                        );
                    }
                    // A = ∂φ/∂q for the holonomic ones.
                    let mut phi = vec![zero; M::SPEC.holonomic];
                    model.prepared().residual(
                        Dual::new(state.t, 0.0),
                        &along(&state.q, &unit),
                        &mut phi,
                    );
                    for (i, phi) in phi.iter().enumerate() {
                        assert_close(
                            &format!("{}: ∂φ[{i}]/∂q[{j}]", M::ID),
                            dense.jacobian[(i, j)],
                            phi.eps,
                            ACCURACY * scale,
                        );
                    }
                }
                let mut jacobian = vec![0.0; m * n];
                model
                    .prepared()
                    .jacobian(state.t, &state.q, &state.v, &mut jacobian);
                assert_eq!(
                    jacobian,
                    dense.jacobian.as_slice(),
                    "{}: `jacobian` and `dynamics`",
                    M::ID
                );

                // b = −d/dt (φ̇, ψ) along q̈ = 0.
                let mut rate = vec![zero; m];
                model.prepared().residual_rate(
                    Dual::new(state.t, 1.0),
                    &along(&state.q, &state.v),
                    &constants(&state.v),
                    &mut rate,
                );
                let scale = largest(dense.rhs.iter()).max(1.0);
                for (i, rate) in rate.iter().enumerate() {
                    assert_close(
                        &format!("{}: b[{i}]", M::ID),
                        dense.rhs[i],
                        -rate.eps,
                        ACCURACY * scale,
                    );
                }

                // φ̇ itself, and b once more from φ alone: φ̈ along q̈ = 0 by nested dual numbers.
                let q: Vec<Dual2> = state
                    .q
                    .iter()
                    .zip(&state.v)
                    .map(|(q, v)| twice_along(*q, *v))
                    .collect();
                let mut phi = vec![twice_along(0.0, 0.0); M::SPEC.holonomic];
                model
                    .prepared()
                    .residual(twice_along(state.t, 1.0), &q, &mut phi);
                for (i, phi) in phi.iter().enumerate() {
                    assert_close(
                        &format!("{}: φ̇[{i}]", M::ID),
                        rate[i].re,
                        phi.re.eps,
                        ACCURACY * scale,
                    );
                    assert_close(
                        &format!("{}: −φ̈[{i}]", M::ID),
                        dense.rhs[i],
                        -phi.eps.eps,
                        ACCURACY * scale,
                    );
                }
            });
        }
    }
    every_model(&Duals);
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
    impl Check for Differences {
        fn check<M: Model>(&self) {
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
    every_model(&Differences);
}

#[test]
fn mass_is_the_hessian_of_the_kinetic_energy() {
    struct Hessian;
    impl Check for Hessian {
        fn check<M: Model>(&self) {
            random_states::<M>(33, |model, state| {
                let n = M::SPEC.n();
                let dense = Dense::of(model, state);
                let scale = largest(dense.mass.iter()).max(1.0);
                let constant = |x: f64| twice_along(x, 0.0);
                let q: Vec<Dual2> = state.q.iter().map(|q| constant(*q)).collect();
                for i in 0..n {
                    for j in 0..n {
                        let mut v: Vec<Dual2> = state.v.iter().map(|v| constant(*v)).collect();
                        v[i].re.eps = 1.0;
                        v[j].eps.re = 1.0;
                        let energy = model.prepared().energy(constant(state.t), &q, &v);
                        let entry = energy.kinetic.eps.eps;
                        assert_close(
                            &format!("{}: M[{i}, {j}]", M::ID),
                            dense.mass[(i, j)],
                            entry,
                            ACCURACY * scale,
                        );
                    }
                }
                let mut mass = vec![0.0; n * n];
                model.prepared().mass_matrix(state.t, &state.q, &mut mass);
                assert_eq!(
                    mass,
                    dense.mass.as_slice(),
                    "{}: `mass_matrix` and `dynamics`",
                    M::ID
                );
            });
        }
    }
    every_model(&Hessian);
}

#[test]
fn force_is_lagrange() {
    struct Lagrange;
    impl Check for Lagrange {
        fn check<M: Model>(&self) {
            // The only model with forces that have no potential; `paper_fish` compares them with their equations.
            if M::ID == FishRobot::ID {
                return;
            }
            random_states::<M>(34, |model, state| {
                let torque = M::SPEC.params.iter().position(|p| p.name == "torque");
                assert!(
                    torque.is_none_or(|i| model.parameter(i) != 0.0),
                    "{}",
                    M::ID
                );
                let dense = Dense::of(model, state);
                let scale = largest(dense.force.iter()).max(1.0);
                for i in 0..M::SPEC.n() {
                    let mut unit = vec![0.0; M::SPEC.n()];
                    unit[i] = 1.0;
                    // ∂(T − V)/∂q_i.
                    let energy = model.prepared().energy(
                        Dual::new(state.t, 0.0),
                        &along(&state.q, &unit),
                        &constants(&state.v),
                    );
                    let slope = energy.kinetic.eps - energy.potential.eps;
                    // d/dt ∂T/∂q̇_i along q̈ = 0: ε₁ along the motion, ε₂ along q̇_i.
                    let q: Vec<Dual2> = state
                        .q
                        .iter()
                        .zip(&state.v)
                        .map(|(q, v)| Dual::new(Dual::new(*q, *v), Dual::new(0.0, 0.0)))
                        .collect();
                    let v: Vec<Dual2> = state
                        .v
                        .iter()
                        .zip(&unit)
                        .map(|(v, u)| Dual::new(Dual::new(*v, 0.0), Dual::new(*u, 0.0)))
                        .collect();
                    let t = Dual::new(Dual::new(state.t, 1.0), Dual::new(0.0, 0.0));
                    let momentum_rate = model.prepared().energy(t, &q, &v).kinetic.eps.eps;
                    assert_close(
                        &format!("{}: Q[{i}]", M::ID),
                        dense.force[i],
                        slope - momentum_rate,
                        ACCURACY * scale,
                    );
                }
            });
        }
    }
    every_model(&Lagrange);
}

#[test]
fn patterns_hold_all_that_is_not_zero() {
    struct Patterns;
    impl Check for Patterns {
        fn check<M: Model>(&self) {
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
    every_model(&Patterns);
}
