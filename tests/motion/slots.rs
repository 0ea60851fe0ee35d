//! A crank's pin in the slot of a lever, past the lever's pivot at a small distance: there the lever turns by half a turn where it would go
//! straight on beside it. Long steps lead past several such places; late, the time is known no better than they are wide.

use tests::{at, cause, less_turns, worst};
use ukcore::{Error, Method, Simulation, State};

ukcore::multibody! {
    Slot {
        params { r = 1.0, d = 1.0 }
        coords { th, ph }
        mass { th: 1, ph: 1 }
        holonomic { slot: (d + r * cos(th)) * sin(ph) - r * sin(th) * cos(ph) = 0 }
    }
}

ukcore::multibody! {
    /// The crank turns as the time says.
    Driven {
        params { r = 0.99, d = 1.0, w = 1.0, a = 0.0 }
        coords { th, ph }
        mass { th: 1, ph: 1 }
        holonomic {
            motor: th = w * t + a * sin(t)
            slot: (d + r * cos(th)) * sin(ph) - r * sin(th) * cos(ph) = 0
        }
    }
}

ukcore::multibody! {
    /// A point on two loops that nearly touch, or one that is nearly an eight.
    Loops {
        params { e = 0.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        holonomic { loops: sq(sq(x) + sq(y)) - 2 * (sq(x) - sq(y)) = e }
    }
}

ukcore::multibody! { Free { coords { x } mass { x: 1 } } }

/// The pin from the lever's pivot.
fn pin(r: f64, th: f64) -> [f64; 2] {
    [1.0 + r * th.cos(), r * th.sin()]
}

/// A state of crank and lever in which the crank turns at the rate `w`.
fn turning(t: f64, r: f64, th: f64, w: f64) -> State {
    let [x, y] = pin(r, th);
    let rate = w * (x * r * th.cos() + y * r * th.sin()) / (x * x + y * y);
    State {
        t,
        q: vec![th, y.atan2(x)],
        v: vec![w, rate],
    }
}

/// How far the lever is off the direction of the pin, where that is `far` enough from its pivot to have one.
fn off(r: f64, q: &[f64], far: f64) -> f64 {
    let [x, y] = pin(r, q[0]);
    let off = less_turns(q[1] - y.atan2(x)).abs();
    if x.hypot(y) < far { 0.0 } else { off }
}

#[test]
fn long_steps_past_several_near_misses_take_none_for_straight() {
    for (miss, method, tolerance) in [
        (1e-4, Method::Radau5, 1e-3),
        (1e-6, Method::Dopri5, 1e-3),
        (1e-6, Method::Radau5, 1e-4),
        (-1e-6, Method::Radau5, 1e-5),
        (1e-8, Method::Dopri5, 1e-4),
        (1e-8, Method::Radau5, 1e-8),
        (-1e-8, Method::Dop853, 1e-5),
    ] {
        let r = 1.0 + miss;
        for k in (1..40).step_by(3) {
            let w = 0.9 + 0.21 * f64::from(k);
            let run = Simulation::new(Slot {
                r,
                ..Slot::default()
            })
            .start(turning(0.0, r, 0.4, w))
            .method(method)
            .tolerance(tolerance)
            .every(0.05)
            .until(10.0);
            let run = run.unwrap_or_else(|e| panic!("{miss:e}, {method}, {tolerance:e}, {w}: {e}"));
            let off = worst(&run, |s| off(r, s.q, 1e-3));
            assert!(
                off < 1e-2,
                "{miss:e}, {method}, {tolerance:e}, {w}: {off:e}"
            );
        }
    }
}

#[test]
fn loops_that_nearly_touch_are_not_left() {
    for miss in [-1e-4_f64, -1e-6, -1e-8] {
        for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
            for tolerance in [1e-3, 1e-5, 1e-7] {
                let x = (1.0 + (1.0 + miss).sqrt()).sqrt();
                let start = at(&[x, 0.0], &[0.0, 1.3]);
                let run = Simulation::new(Loops { e: miss })
                    .start(start)
                    .method(method)
                    .tolerance(tolerance)
                    .every(0.05)
                    .until(20.0);
                let run = run.unwrap_or_else(|e| panic!("{miss:e}, {method}, {tolerance:e}: {e}"));
                let least = run.samples().map(|s| s.q[0]).fold(x, f64::min);
                assert!(least > 0.0, "{miss:e}, {method}, {tolerance:e}: {least:e}");
            }
        }
    }
}

/// Where the lever turns, rounding makes more of velocities than the accuracy asked for.
#[test]
fn a_near_miss_too_near_for_the_tolerance_is_named() {
    let r = 1.0 + 1e-8;
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        let run = Simulation::new(Slot {
            r,
            ..Slot::default()
        })
        .start(turning(0.0, r, 0.4, 1.95))
        .method(method)
        .tolerance(1e-12)
        .every(0.05)
        .until(10.0);
        let failure = run.expect_err("a tolerance below rounding");
        assert!(worst(&failure.trajectory, |s| off(r, s.q, 1e-3)) < 1e-8);
        let (t, source) = cause(&failure.error);
        assert!(
            matches!(source, Error::Singular { constraints } if constraints == &["slot"]),
            "{method}: {source}"
        );
        // The lever meets it every turn, there first.
        assert!((1.4..3.5).contains(&t), "{method}: {t}");
    }
}

/// No position is singular: what the rounding of the time makes of the lever is no error of its steps.
#[test]
fn driven_late_the_lever_follows() {
    for (t0, tolerance, bound) in [
        (0.4, 1e-12, 1e-10),
        (1e3, 1e-13, 1e-10),
        (1e6, 1e-8, 1e-6),
        (1e6, 1e-10, 1e-7),
        (1e6, 1e-12, 1e-7),
    ] {
        for (w, a) in [(1.0, 0.0), (1.9, 0.3)] {
            let crank = |t: f64| w * t + a * t.sin();
            let driven = Driven {
                w,
                a,
                ..Driven::default()
            };
            let start = turning(t0, driven.r, crank(t0), w + a * t0.cos());
            for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
                if method != Method::Dop853 && tolerance < 1e-10 {
                    continue;
                }
                let run = Simulation::new(driven.clone())
                    .start(start.clone())
                    .method(method)
                    .tolerance(tolerance)
                    .every(0.1)
                    .until(t0 + 10.0);
                let run =
                    run.unwrap_or_else(|e| panic!("{t0:e}, {method}, {tolerance:e}, {w}: {e}"));
                let worst = worst(&run, |s| off(driven.r, &[crank(s.t), s.q[1]], 0.0));
                assert!(
                    worst < bound,
                    "{t0:e}, {method}, {tolerance:e}, {w}: {worst:e}"
                );
            }
        }
    }
}

/// Residuals of an ulp of what is driven are no jump of it.
#[test]
fn the_rounding_of_a_drive_is_no_jump() {
    for r in [0.999, 1.001] {
        for k in 0..10 {
            let w = 1.0 + 0.3 * f64::from(k);
            let run = Simulation::new(Driven {
                r,
                w,
                ..Driven::default()
            })
            .start(turning(0.4, r, 0.4 * w, w))
            .tolerance(1e-13)
            .until(10.4);
            if let Err(failure) = run {
                assert!(
                    !matches!(cause(&failure.error).1, Error::Jump { .. }),
                    "{r}, {w}: {failure}"
                );
            }
        }
    }
}

#[test]
fn steps_below_the_rounding_of_a_late_time_are_told() {
    for (t, w) in [(1e9, 1e9), (1e12, 1e6), (-1e12, 1e9)] {
        let start = State {
            t,
            q: vec![0.0],
            v: vec![w],
        };
        let run = Simulation::new(Free::default())
            .start(start)
            .until(t + 1024.0);
        let failure = run.expect_err("a first step below rounding");
        let (_, &Error::TooLate { step, rounding }) = cause(&failure.error) else {
            panic!("{t:e}, {w:e}: {failure}");
        };
        assert!(
            step < rounding && rounding < 1e-15 * t.abs(),
            "{step:e}, {rounding:e}"
        );
    }
}
