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

ukcore::multibody! {
    /// A coin that rolls.
    Coin {
        params { m = 0.1, r = 0.1, g = 9.81 }
        gravity { [0, 0, -g] }
        bodies { spatial coin { mass: m, inertia: [m * sq(r) / 4, m * sq(r) / 2, m * sq(r) / 4] } }
        holonomic { touches: disc(coin.at([0, 0, 0]), [0, 1, 0], r) }
        nonholonomic { rolls: rolls(coin.at([0, 0, 0]), [0, 1, 0], r) }
        start leaning(lean = 0.5, spin = 0.0) {
            coin.e0 near cos(lean / 2)
            coin.e1 near sin(lean / 2)
            coin.x = 0
            coin.y = 0
            coin.z near r * cos(lean)
            coin.spin = [0, 0, spin]
        }
    }
}

/// A coin with next to no spin falls until it is all but flat, whirls about by half a turn in next to no time, and gets up again.
#[test]
fn a_coin_that_falls_all_but_flat_gets_up_again() {
    // 5/4 m r² a'' = m g r sin a, from lean 0.5 to flat: with a = 0.5 + u² the time is ∫ 2 u du/a'.
    let (coin, top, flat) = (Coin::default(), 0.5_f64, std::f64::consts::FRAC_PI_2);
    let factor = 1.6 * coin.g / coin.r;
    let share = |u: f64| {
        let a = top + u * u;
        // cos 0.5 − cos a, without cancellation.
        let fall = 2.0 * (0.5 * (a + top)).sin() * (0.5 * u * u).sin();
        2.0 * u / (factor * fall).sqrt()
    };
    let (end, steps) = ((flat - top).sqrt(), 2000);
    let h = end / f64::from(steps);
    let midpoints: f64 = (0..steps).map(|i| share((f64::from(i) + 0.5) * h)).sum();
    let fallen = h * midpoints;
    for spin in [0.1, 1e-3, 1e-6] {
        let start = coin.start("leaning", &[("spin", spin)].into());
        let start = start.expect("a start");
        for (method, tolerance) in [
            (Method::Dop853, 1e-6),
            (Method::Dop853, 1e-9),
            (Method::Dop853, 1e-12),
            (Method::Dopri5, 1e-6),
            (Method::Dopri5, 1e-9),
            (Method::Radau5, 1e-9),
        ] {
            let name = format!("{method}, {tolerance:e}, spin {spin:e}");
            let run = Simulation::new(coin.clone())
                .start(start.clone())
                .method(method)
                .tolerance(tolerance)
                .until(2.0 * fallen);
            let run = run.unwrap_or_else(|failure| panic!("{name}: {failure}"));
            let drift = run.energy_drift();
            assert!(drift < 1e-7 + 100.0 * tolerance, "{name}: {drift:e}");
            // Up again, but for what the spin changes.
            let up = run.last().expect("an end").q[2] / coin.r - top.cos();
            assert!(
                up.abs() < 1e-6 + spin * spin + 100.0 * tolerance,
                "{name}: {up:e}"
            );
        }
    }
}
