//! Exact derivatives of the accelerations against differences of them, and against closed forms.

use models::{Model, Pendulum, Visitor, visit};
use tests::{Random, accelerations, assert_all_close, at, difference, largest};
use ukcore::manifold::Projector;
use ukcore::solver::SolverOptions;
use ukcore::{Error, Linearisation, Solver, State};

/// Truncation and rounding of differences of fourth order, relative to the largest derivative.
const ACCURACY: f64 = 1e-7;

/// Whether some constraints follow from others at the default start.
fn redundant<M: Model>() -> bool {
    let mechanism = M::default();
    let s = mechanism.default_start().expect("the default start exists");
    let solution = Solver::new(&mechanism, SolverOptions::default())
        .solve(s.t, &s.q, &s.v)
        .expect("the start is regular");
    !solution.redundant.is_empty()
}

#[test]
fn columns_are_differences_of_the_accelerations() {
    struct Columns;
    impl Visitor for Columns {
        fn visit<M: Model>(&mut self) {
            let mut random = Random::new(5);
            // Off the manifold, where most columns lead, redundant constraints are not redundant: see the next test.
            for _ in 0..if redundant::<M>() { 0 } else { 3 } {
                let (mechanism, state) = random.member::<M>();
                let found = Linearisation::at(&mechanism, &state)
                    .unwrap_or_else(|e| panic!("{}: {e}", M::ID));
                let n = M::SPEC.n();
                let scale = largest(&accelerations(&mechanism, &state)).max(1.0);
                assert_all_close(
                    M::ID,
                    &found.acceleration,
                    &accelerations(&mechanism, &state),
                    1e-11 * scale,
                );
                let check = |name: &str, expected: Vec<f64>| {
                    let column = found.by(name).expect("known");
                    let bound = ACCURACY * largest(&expected).max(scale);
                    assert_all_close(&format!("{} by {name}", M::ID), column, &expected, bound);
                };
                for (i, name) in M::SPEC.coords.iter().enumerate() {
                    let moved = |part: fn(&mut State) -> &mut Vec<f64>| {
                        difference(1e-3, |h| {
                            let mut state = state.clone();
                            part(&mut state)[i] += h;
                            accelerations(&mechanism, &state)
                        })
                    };
                    check(name, moved(|s| &mut s.q));
                    check(&format!("dot({name})"), moved(|s| &mut s.v));
                }
                for (i, parameter) in M::SPEC.params.iter().enumerate() {
                    let value = mechanism.parameter(i);
                    let expected = difference(1e-4 * value.abs().max(1e-2), |h| {
                        let mut mechanism = mechanism.clone();
                        mechanism.set_parameter(i, value + h);
                        accelerations(&mechanism, &state)
                    });
                    check(parameter.name, expected);
                }
                // Time is shaken fast in one model.
                let expected = difference(1e-4, |h| {
                    let mut state = state.clone();
                    state.t += h;
                    accelerations(&mechanism, &state)
                });
                check("t", expected);
                assert_eq!(found.by_position.len(), n * n);
            }
        }
    }
    visit(&mut Columns);
}

#[test]
fn along_the_manifold_derivatives_hold_with_redundant_constraints_too() {
    struct Along;
    impl Visitor for Along {
        fn visit<M: Model>(&mut self) {
            let mut random = Random::new(6);
            for _ in 0..3 {
                let (mechanism, state) = random.member::<M>();
                let found = Linearisation::at(&mechanism, &state)
                    .unwrap_or_else(|e| panic!("{}: {e}", M::ID));
                let n = M::SPEC.n();
                let direction = random.vector(2 * n);
                // Consistent states in that direction.
                let at = |h: f64| {
                    let mut s = state.clone();
                    let all = s.q.iter_mut().chain(&mut s.v).zip(&direction);
                    all.for_each(|(x, d)| *x += h * d);
                    let mut projector = Projector::new(&mechanism);
                    projector.position(s.t, &mut s.q, &s.v).expect("near");
                    projector.velocity(s.t, &s.q, &mut s.v).expect("near");
                    s
                };
                let h = 2e-4;
                let dq = difference(h, |h| at(h).q);
                let dv = difference(h, |h| at(h).v);
                let expected = difference(h, |h| accelerations(&mechanism, &at(h)));
                let mut sum = vec![0.0; n];
                for (d, column) in dq
                    .iter()
                    .zip(found.by_position.chunks_exact(n))
                    .chain(dv.iter().zip(found.by_velocity.chunks_exact(n)))
                {
                    sum.iter_mut().zip(column).for_each(|(s, c)| *s += d * c);
                }
                let scale = largest(&found.by_position).max(largest(&found.by_velocity));
                assert_all_close(M::ID, &sum, &expected, ACCURACY * scale.max(1.0));
            }
        }
    }
    visit(&mut Along);
}

#[test]
fn the_pendulum_in_closed_form() {
    // q̈ = −(0, g) − s q with s = (q̇² − g y)/q², at any state.
    let mechanism = Pendulum {
        m: 2.0,
        l: 0.7,
        g: 9.7,
    };
    let (x, y, vx, vy) = (0.6, -0.5, 1.1, 0.3);
    let state = at(&[x, y], &[vx, vy]);
    let found = Linearisation::at(&mechanism, &state).unwrap();
    let square = x * x + y * y;
    let s = (vx * vx + vy * vy - 9.7 * y) / square;
    let column = |ds: f64, own: [f64; 2]| [own[0] - ds * x, own[1] - ds * y];
    for (name, expected) in [
        ("x", column(-2.0 * x * s / square, [-s, 0.0])),
        ("y", column((-9.7 - 2.0 * y * s) / square, [0.0, -s])),
        ("dot(x)", column(2.0 * vx / square, [0.0; 2])),
        ("dot(y)", column(2.0 * vy / square, [0.0; 2])),
        ("g", column(-y / square, [0.0, -1.0])),
        ("m", [0.0; 2]),
        ("l", [0.0; 2]),
        ("t", [0.0; 2]),
    ] {
        assert_all_close(name, found.by(name).unwrap(), &expected, 1e-13);
    }
    assert_all_close("q̈", &found.acceleration, &[-s * x, -9.7 - s * y], 1e-13);
    assert!(matches!(
        found.by("dot(z)"),
        Err(Error::UnknownName { nearest: Some(name), .. }) if name == "dot(x)"
    ));
    let state = State {
        v: vec![0.0; 3],
        ..state
    };
    assert!(matches!(
        Linearisation::at(&mechanism, &state),
        Err(Error::WrongLength { what: "v", .. })
    ));
}
