//! Directions in the plane as cosine and sine: one rate of turning each, for which at most one row is solved. Accelerations against what
//! the drives prescribe, and where nothing does against the same equations in 31 digits.

use std::fmt::Debug;
use tests::assert_all_close;
use ukcore::equations::precise;
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Solver};

ukcore::multibody! {
    /// A crank that is turned.
    Driven {
        params { i = 0.4 }
        coords { c, s }
        kinetic { 0.5 * i * sq(c * dot(s) - s * dot(c)) }
        holonomic { unit: sq(c) + sq(s) = 1, drive: 2 * c * s * cos(2 * t) = (sq(c) - sq(s)) * sin(2 * t) }
    }
}

ukcore::multibody! {
    /// A crank that is turned, and one that is turned against it, by twice the angle.
    Relative {
        params { i[2] = [0.4, 0.7] }
        coords { c[2], s[2] }
        kinetic { for k in 0..2 { 0.5 * i[k] * sq(c[k] * dot(s[k]) - s[k] * dot(c[k])) } }
        holonomic {
            for k in 0..2 { unit[k]: sq(c[k]) + sq(s[k]) = 1 }
            drive: 2 * c[0] * s[0] * cos(2 * t) = (sq(c[0]) - sq(s[0])) * sin(2 * t)
            against: c[0] * s[1] - s[0] * c[1] = sin(2 * t)
        }
    }
}

ukcore::multibody! {
    /// Two cranks that are turned, one of them by two drives that say the same.
    Twice {
        params { i[2] = [0.4, 0.7] }
        coords { c[2], s[2] }
        kinetic { for k in 0..2 { 0.5 * i[k] * sq(c[k] * dot(s[k]) - s[k] * dot(c[k])) } }
        holonomic {
            for k in 0..2 { unit[k]: sq(c[k]) + sq(s[k]) = 1 }
            drive: 2 * c[0] * s[0] * cos(2 * t) = (sq(c[0]) - sq(s[0])) * sin(2 * t)
            other: 2 * c[1] * s[1] * cos(6 * t) = (sq(c[1]) - sq(s[1])) * sin(6 * t)
            again: 2 * c[1] * s[1] = sin(6 * t)
        }
    }
}

ukcore::multibody! {
    /// Cranks geared to each other, which a weight turns.
    Geared {
        params { i[2] = [0.4, 0.7], torque = 1.3 }
        coords { c[2], s[2] }
        kinetic { for k in 0..2 { 0.5 * i[k] * sq(c[k] * dot(s[k]) - s[k] * dot(c[k])) } }
        potential { torque * s[0] + sq(c[1]) }
        holonomic {
            for k in 0..2 { unit[k]: sq(c[k]) + sq(s[k]) = 1 }
            gears: s[1] * (sq(c[0]) - sq(s[0])) = 2 * c[1] * s[0] * c[0]
        }
    }
}

/// q, q̇ and q̈ of cranks at the angles rate · t, cosines first.
fn turned(rates: &[f64], t: f64) -> [Vec<f64>; 3] {
    let entries = |of: fn(f64, f64) -> [f64; 2]| {
        let both: Vec<[f64; 2]> = rates.iter().map(|w| of(*w, w * t)).collect();
        [0, 1]
            .map(|k| both.iter().map(|b| b[k]).collect::<Vec<f64>>())
            .concat()
    };
    [
        entries(|_, a| [a.cos(), a.sin()]),
        entries(|w, a| [-w * a.sin(), w * a.cos()]),
        entries(|w, a| [-w * w * a.cos(), -w * w * a.sin()]),
    ]
}

/// Accelerations by the straight line alone, if `straight`.
fn check<M: Mechanism + Debug>(
    mechanism: &M,
    rates: &[f64],
    straight: bool,
    expected: impl Fn(f64, [Vec<f64>; 3]) -> Vec<f64>,
) {
    let mut solver = Solver::new(mechanism, SolverOptions::default());
    for t in [0.0, 0.1, 0.3, 1.7, -2.2, 4.4, 31.0] {
        let [q, v, a] = turned(rates, t);
        let mut found = vec![0.0; q.len()];
        if let Err(error) = solver.acceleration(t, &q, &v, &mut found) {
            panic!("{mechanism:?} at {t}: {error}");
        }
        let expected = expected(t, [q, v, a]);
        assert_all_close(&format!("{mechanism:?} at {t}"), &found, &expected, 1e-12);
    }
    assert!(!straight || solver.work().fallbacks == 0, "{mechanism:?}");
}

#[test]
fn cranks_turn_as_they_are_driven() {
    let prescribed = |_: f64, [_, _, a]: [Vec<f64>; 3]| a;
    check(&Driven::default(), &[1.0], true, prescribed);
    check(&Relative::default(), &[1.0, 3.0], true, prescribed);
    check(&Twice::default(), &[1.0, 3.0], true, prescribed);
}

#[test]
fn cranks_turn_as_they_are_geared() {
    let geared = Geared::default();
    check(&geared, &[1.0, 2.0], true, |t, [q, v, _]| {
        precise::accelerations(&geared, t, &q, &v).expect("independent constraints")
    });
}
