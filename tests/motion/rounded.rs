//! Rounding that changes with no state: of phases, of large forces that cancel, and of a late time.

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
    /// A spring of 1 N/m as the difference of two forces.
    Difference { params { c = 1e8 } coords { x } mass { x: 1 } force { x: (c + x) - (c + 2 * x) } }
}

ukcore::multibody! {
    /// The same by a cosine that is nearly 1, beside a coordinate without such forces.
    Balance { params { f = 1e6 } coords { x, y } mass { x: 1, y: 1 } force { x: -x, y: f * cos(1e-3 * y) - f } }
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

/// As many evaluations as forces of 1 N take, times a few; not as many as a tolerance below the rounding of 1e8 N asks for.
#[test]
fn steps_are_not_refined_past_forces_that_cancel() {
    for method in METHODS {
        for tolerance in [1e-9, 1e-12, 1e-13, 1e-14] {
            let run = run(
                Difference::default(),
                at_rest(&[1.0]),
                (method, tolerance),
                2.0,
            );
            let work = run.work();
            assert!(
                work.evaluations < 15_000,
                "{method}, {tolerance:e}: {work:?}"
            );
            assert_close("x", run.last().expect("an end").q[0], 2.0_f64.cos(), 3e-7);
            let run = self::run(
                Balance::default(),
                at_rest(&[1.0, 1.0]),
                (method, tolerance),
                2.0,
            );
            let work = run.work();
            assert!(
                work.evaluations < 15_000,
                "{method}, {tolerance:e}: {work:?}"
            );
            assert_close("x", run.last().expect("an end").q[0], 2.0_f64.cos(), 2e-9);
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
