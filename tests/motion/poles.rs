//! Motions just past places where coordinates tell little of them: rounding there must not become the motion.

use tests::at;
use ukcore::{Mechanism, Method, Simulation, State};

ukcore::multibody! {
    /// A spherical pendulum in two angles, the first from the top; at the bottom and at the top the second has no meaning.
    Angles {
        params { g = 9.81 }
        coords { th, ph }
        kinetic { 0.5 * (sq(dot(th)) + sq(sin(th)) * sq(dot(ph))) }
        potential { g * cos(th) }
    }
}

ukcore::multibody! {
    /// A rod on a universal joint, whose axes fall in line where it lies across.
    Cross {
        params { a = 0.4 }
        coords { first, second }
        kinetic { 0.5 * a * (sq(dot(second)) + sq(cos(second) * dot(first))) }
    }
}

/// Runs past the place, which either are right or say that they cannot be.
#[track_caller]
fn check<M: Mechanism>(mechanism: M, start: State, end: f64, runs: &[(Method, f64)]) -> usize {
    let mut through = 0;
    for (method, tolerance) in runs {
        let run = Simulation::new(mechanism.clone())
            .start(start.clone())
            .method(*method)
            .tolerance(*tolerance)
            .max_steps(100_000)
            .every(end / 200.0)
            .until(end);
        if let Ok(run) = run {
            through += 1;
            let drift = run.energy_drift();
            assert!(
                drift < 1e-4,
                "{method}, {tolerance:e}, {start:?}: {drift:e}"
            );
        }
    }
    through
}

#[test]
fn rounding_beside_a_pole_does_not_become_the_motion() {
    let runs = [
        (Method::Dop853, 1e-6),
        (Method::Dop853, 1e-9),
        (Method::Dop853, 1e-12),
        (Method::Dopri5, 1e-9),
        (Method::Radau5, 1e-9),
    ];
    let mut through = 0;
    for rate in [1e-5, 1e-7, 1e-8, 1e-9, 1e-10] {
        let swing = at(&[1.5, 0.0], &[0.0, rate]);
        through += check(Angles::default(), swing, 5.0, &runs);
        let turn = at(&[0.0, 0.3], &[rate, 6.0]);
        through += check(Cross::default(), turn, 1.5, &runs);
    }
    // Most get there.
    assert!(through >= 30, "{through} of 50");
}
