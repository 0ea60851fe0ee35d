//! A door on three hinges far off the origin: rounding of places is all that the hinges contradict each other by, and moves the door by
//! more than a tight tolerance at each projection.

use ukcore::{Method, Simulation};

ukcore::multibody! {
    /// A door about an axis off the vertical, `far` off the origin.
    Door {
        params { m = 20.0, w = 0.8, tilt = 0.3, h = 2.0, g = 9.81, far = 0.0 }
        let axis = [sin(tilt), 0, cos(tilt)];
        let foot = [far, -far, far];
        bodies { spatial leaf { mass: m, inertia: [m * sq(h) / 12, m * (sq(h) + sq(w)) / 12, m * sq(w) / 12] } }
        gravity { [0, 0, -g] }
        holonomic {
            for i in 0..3 {
                pin[i]: hinge(ground.at(foot + (i - 1) * h / 3 * axis), leaf.at([-w / 2, 0, (i - 1) * h / 3]), axis, [0, 0, 1])
            }
        }
        start open(angle = 1.0) {
            leaf.e0 near cos(tilt / 2) * cos(angle / 2); leaf.e1 near -sin(tilt / 2) * sin(angle / 2);
            leaf.e2 near sin(tilt / 2) * cos(angle / 2); leaf.e3 = cos(tilt / 2) * sin(angle / 2);
            leaf.centre near foot + [w / 2 * cos(angle) * cos(tilt), w / 2 * sin(angle), -w / 2 * cos(angle) * sin(tilt)];
            leaf.omega = [0, 0, 0]
        }
    }
}

ukcore::multibody! {
    /// The same as a pendulum.
    Pendulum {
        params { w = 0.8, tilt = 0.3, g = 9.81 }
        coords { angle }
        kinetic { sq(w) / 6 * sq(dot(angle)) }
        potential { -g * w / 2 * sin(tilt) * cos(angle) }
        start open { angle = 1; dot(angle) = 0 }
    }
}

#[test]
fn hinges_far_off_do_not_hold_a_run_up() {
    let pendulum = Pendulum::default();
    let start = pendulum.start("open", &[].into()).expect("a start");
    let swing = Simulation::new(pendulum).start(start).tolerance(1e-13);
    let swing = swing.until(4.0).unwrap_or_else(|e| panic!("{e}"));
    let (sin, cos) = swing.last().expect("an end").q[0].sin_cos();
    for far in [0.0, 1e3, 1e5, 1e6] {
        let door = Door {
            far,
            ..Door::default()
        };
        for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
            for tolerance in [1e-9, 1e-11, 1e-12, 1e-13] {
                let start = door.start("open", &[].into()).expect("a start");
                let run = Simulation::new(door.clone())
                    .start(start)
                    .method(method)
                    .tolerance(tolerance)
                    .max_steps(2000)
                    .until(4.0)
                    .unwrap_or_else(|e| panic!("{far:e}, {method:?} at {tolerance:e}: {e}"));
                let end = &run.last().expect("an end").q[Door::LEAF_X..];
                let place = [
                    0.4 * cos * door.tilt.cos(),
                    0.4 * sin,
                    -0.4 * cos * door.tilt.sin(),
                ];
                let feet = [far, -far, far];
                let off = (0..3).map(|i| (end[i] - feet[i] - place[i]).abs());
                let off = off.fold(0.0, f64::max);
                let known = 100.0 * tolerance + 8.0 * f64::EPSILON * far;
                assert!(off < known, "{far:e}, {method:?} at {tolerance:e}: {off:e}");
            }
        }
    }
}
