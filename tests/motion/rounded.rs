//! Rounding that changes with no state: of phases, and of a late time.

use tests::{assert_close, at, at_rest};
use ukcore::{Mechanism, Method, Prepared, Simulation, State, Trajectory};

ukcore::multibody! {
    /// A pendulum whose angle is counted from elsewhere.
    Turned { params { phase = 0.0 } coords { a } mass { a: 1 } potential { -cos(a - phase) } }
}

ukcore::multibody! {
    /// A point that is driven in time.
    Driven { params { w = 10.0, phase = 0.0 } coords { x } mass { x: 1 } holonomic { drive: x = 0.1 * cos(w * t + phase) } }
}

ukcore::multibody! {
    /// The phase stands alone in its functions: nothing is lost of it.
    Alone { params { phase = 0.0 } coords { x } mass { x: 1 } force { x: sin(phase) * cos(x) } }
}

ukcore::multibody! {
    /// Phases times numbers.
    Scaled { params { fine = 0.0, coarse = 0.0 } coords { x } mass { x: 1 } force { x: -sin(x + 1e-9 * fine + 1e9 * coarse) } }
}

ukcore::multibody! {
    /// Places and times far off, in which waves are long, and two angles that differ by one.
    Wave {
        params { x0 = 1.5e11 [m], k = 1e-9 [1/m], t0 = 2e11 [s], w = 1e-6 [rad/s], big = 1e11 [m], a = 100000000001.0 [rad], b = 1e11 [rad], f = 1 [N] }
        coords { x [m] }
        mass { x: 1 [kg] }
        force { x: f * (sin(k * (x - x0)) + sin(w * (t - t0)) + sin(x / (big + x0)) + cos(a - b)) }
    }
}

fn run(
    mechanism: impl Into<Prepared>,
    start: State,
    (method, tolerance): (Method, f64),
    until: f64,
) -> Trajectory {
    let run = Simulation::new(mechanism)
        .start(start)
        .method(method)
        .tolerance(tolerance);
    run.until(until)
        .unwrap_or_else(|e| panic!("{method}, {tolerance:e}: {e}"))
}

const METHODS: [Method; 3] = [Method::Dopri5, Method::Dop853, Method::Radau5];

#[test]
fn phases_that_are_rounded_away_are_refused_by_name() {
    let refused = |mechanism: Prepared, start: State| {
        let error = Simulation::new(mechanism)
            .start(start)
            .until(1.0)
            .expect_err("rounded away")
            .to_string();
        assert!(
            error.contains("`phase`") && error.contains("take whole turns off it"),
            "{error}"
        );
    };
    for phase in [-1e12, 1e12, 1e15, 1e17] {
        refused(Turned { phase }.prepared(), at_rest(&[0.3]));
        let drive = Driven {
            phase,
            ..Driven::default()
        };
        let start = at(&[0.1 * f64::cos(phase)], &[-f64::sin(phase)]);
        refused(drive.prepared(), start);
    }
    // What is added counts by the angle that it is.
    let refused_by =
        |coarse: Scaled, start: State| Simulation::new(coarse).start(start).until(1.0).is_err();
    assert!(refused_by(
        Scaled {
            fine: 0.0,
            coarse: 1e5
        },
        at_rest(&[0.3])
    ));
    assert!(!refused_by(
        Scaled {
            fine: 1e11,
            coarse: 0.0
        },
        at_rest(&[0.3])
    ));
    // Nor is a length or a time one, or what cancels before it is added.
    let wave = Wave::default();
    let run_on = |tolerance| {
        let start = State {
            t: 2e11,
            ..at_rest(&[1.5e11])
        };
        Simulation::new(&wave)
            .start(start)
            .tolerance(tolerance)
            .until(2e11 + 1.0)
    };
    assert!(run_on(1e-9).is_ok());
    // An exact number in a function of its own is as good as any other.
    let run = run(
        Alone { phase: 1e15 },
        at_rest(&[0.0]),
        (Method::Dop853, 1e-9),
        0.1,
    );
    assert_close(
        "x",
        run.last().expect("an end").q[0],
        0.5 * 1e15_f64.sin() * 0.01,
        1e-4,
    );
}

#[test]
fn phases_that_are_known_are_taken_as_they_are() {
    for method in METHODS {
        for turns in [1.0, 1e3, 1e7] {
            let phase = turns * std::f64::consts::TAU;
            let [near, far] = [0.0, phase].map(|phase| {
                let run = run(Turned { phase }, at_rest(&[0.3]), (method, 1e-9), 1.0);
                run.last().expect("an end").q[0]
            });
            assert_close("a", far, near, 1e-7);
        }
    }
}

#[test]
fn a_late_time_is_named() {
    for t in [1e9, 1e10] {
        let w = 100.0;
        let start = State {
            t,
            ..at(&[0.1 * f64::cos(w * t)], &[-0.1 * w * f64::sin(w * t)])
        };
        let drive = Driven { w, phase: 0.0 };
        let run = Simulation::new(drive).start(start).until(t + 1.0);
        let error = run.expect_err("not known so late").to_string();
        assert!(error.contains("so late the time is known to"), "{error}");
    }
}

ukcore::multibody! {
    /// An oscillator with friction that may be 0.
    Rubbed {
        params { mu = 0.0 }
        coords { x }
        mass { x: 1 }
        force { x: -4 * x - mu * sign(dot(x)) }
    }
}

/// Between the zero and the end there may be no time.
#[test]
fn runs_end_where_a_switch_is_zero_early_and_late() {
    for t in [0.0, 1e2, 1e3, 1e4, 1e5, 1e6] {
        for (method, tolerance) in [
            (Method::Dop853, 1e-6),
            (Method::Dop853, 1e-10),
            (Method::Dop853, 1e-12),
            (Method::Dopri5, 1e-10),
            (Method::Dopri5, 1e-12),
            (Method::Radau5, 1e-8),
        ] {
            for way in [-3.0, -1.0, -0.1, 0.1, 1.0, 2.0, 3.0] {
                // At rest at `t`, after less than a half or after more turns.
                let (sin, cos) = (2.0_f64 * way).sin_cos();
                let start = State {
                    t: t + way,
                    q: vec![cos],
                    v: vec![-2.0 * sin],
                };
                let run = Simulation::new(Rubbed::default()).method(method);
                let run = run.tolerance(tolerance).start(start).until(t);
                let run = run.unwrap_or_else(|e| panic!("{t:e} {method} {tolerance:e} {way}: {e}"));
                let end = run.last().expect("an end");
                let off = (end.q[0] - 1.0).abs().max(end.v[0].abs());
                let bound = 30.0 * tolerance + 4.0 * f64::EPSILON * t;
                assert!(
                    end.t == t && off <= bound,
                    "{t:e} {method} {tolerance:e} {way}: {off:e}"
                );
            }
        }
    }
}
