//! Dry friction in joints that constraints lock, and where it is about to hold: it makes nothing of the motion, and none is refused for the
//! rounding that a locked joint turns by.

use tests::{apart, at};
use ukcore::manifold::Stabilisation;
use ukcore::{Mechanism, Method, Prepared, Simulation, State, Trajectory};

const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];
const TOLERANCES: [f64; 4] = [1e-4, 1e-8, 1e-10, 1e-12];

fn end(run: Simulation, start: &State, method: Method, tolerance: f64, until: f64) -> Trajectory {
    let run = run.start(start.clone()).method(method).tolerance(tolerance);
    run.until(until)
        .unwrap_or_else(|e| panic!("{method}, {tolerance:e}: {e}"))
}

ukcore::multibody! {
    /// Two plates welded to each other on a rail, which rub and drag where they do not turn, and a rod that is turned in a groove.
    Locked {
        params { c = 0.2, d = 0.2, g = 9.81, far = 0.5 }
        bodies {
            planar sledge { mass: 1.5, inertia: 0.1 }
            planar plate { mass: 0.6, inertia: 0.2, centre: [0.4, 0.3] }
            planar rod { mass: 1.5, inertia: 0.3, centre: [-0.1, -0.4] }
        }
        gravity { [0, -g] }
        holonomic {
            rail: slider(ground.at([far, 0.2]), sledge.at([-0.5, 0.4]), [0.5, 0.2], -0.7)
            seam: weld(sledge.at([-0.1, 0.3]), plate.at([-0.2, 0.3]), -0.7)
            groove: slot(plate.at([-0.4, -0.1]), rod.at([0.1, -0.1]), [0.7, 0.8])
            motor: turn(rod, ground) = 0.5 * t + 0.3 * sin(2 * t)
        }
        let rate = plate.omega - sledge.omega;
        forces {
            torque(sledge, plate, 0.9 * cos(2 * t) - c * sign(rate) - d * rate * abs(rate))
            torque(ground, plate, -0.7 * cos(2 * t) - c * sign(plate.omega) - d * plate.omega * abs(plate.omega))
        }
        start put(place = 0.0) { sledge.x near place }
    }
}

/// No friction in a joint that is locked does anything, and none is refused for the rounding that it turns by.
#[test]
fn friction_in_a_joint_that_is_locked_does_nothing() {
    // Far off the rates at the start are rounding that neither is nor stays zero.
    for (place, far) in [(0.0, 0.5), (0.35, 0.5), (0.7, 0.5), (0.0, 1e4), (0.0, 1e6)] {
        let own = Locked {
            far,
            ..Locked::default()
        };
        let start = own
            .start("put", &[("place", place + far)].into())
            .expect("it is put on its rail");
        for method in METHODS {
            for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
                let found = |c: f64, d: f64| {
                    let locked = Locked {
                        c,
                        d,
                        ..own.clone()
                    };
                    let run = end(Simulation::new(locked), &start, method, tolerance, 3.0);
                    run.last().expect("an end").q.to_vec()
                };
                let free = found(0.0, 0.0);
                for (c, d) in [(0.2, 0.0), (0.0, 0.2), (0.2, 0.2)] {
                    let off = apart(&found(c, d), &free);
                    let allowed = 100.0 * tolerance * far.max(1.0);
                    assert!(off < allowed, "{method}, {tolerance:e}, {far:e}: {off:e}");
                }
            }
        }
    }
}

ukcore::multibody! {
    /// Two bodies that are thrown, which a pin and a slot lock together, though their rows are not those of a weld.
    Pinned {
        params { mu = 0.7, c = 0.4, m = 1.0, far = 0.0 }
        bodies { planar a { mass: m, inertia: 0.3 * m } planar b { mass: 2 * m, inertia: 0.5 * m } }
        holonomic {
            p: pin(a.at([0.5, 0]), b.at([-0.3, 0.1]))
            s: slot(a.at([0.5, 0.7]), b.at([-0.3, 0.8]), [0, 1])
        }
        let rate = b.omega - a.omega;
        forces {
            torque(a, 0.9 * m)
            torque(a, b, -mu * sign(rate) - c * rate * abs(rate))
        }
        nonideal { torque(a, b, friction(rate, mu)) }
        start thrown() { a.x = far; a.y = -far; a.angle = 0.3; dot(a.x) = 1.5; dot(a.y) = 0.0; a.omega = 0.8; b.angle near 0.3; }
    }
}

ukcore::multibody! {
    /// A slider that a rod along its slide keeps from moving.
    Propped {
        params { mu = 0.7, c = 0.0, m = 1.0, far = 0.0 }
        bodies { planar a { mass: m, inertia: 0.3 * m } planar b { mass: 2 * m, inertia: 0.5 * m } }
        holonomic {
            slide: slider(a.at([0.5, 0]), b.at([-0.3, 0.1]), [1, 0])
            rod: rod(a.at([-0.5, 0]), b.at([-0.3, 0.1]), 1.5)
        }
        let rate = dot(inner(a.along([1, 0]), b.at([-0.3, 0.1]) - a.at([0.5, 0])));
        let along = a.along([1, 0]) * (mu * sign(rate) + c * rate * abs(rate));
        forces {
            torque(a, 0.9 * m)
            force(a.at([0.5, 0]), along)
            force(b.at([-0.3, 0.1]), -along)
        }
        start thrown() { a.x = far; a.y = -far; a.angle = 0.3; dot(a.x) = 1.5; dot(a.y) = 0.0; a.omega = 0.8; b.x near far + 1.2; b.y near 0.3 - far; }
    }
}

ukcore::multibody! {
    /// A door on a thrown frame, on two hinges whose axes lock it.
    Door {
        params { mu = 0.7, c = 0.4, m = 1.0, far = 0.0 }
        bodies {
            spatial a { mass: m, inertia: [0.2 * m, 0.3 * m, 0.4 * m] }
            spatial b { mass: 2 * m, inertia: [0.3 * m, 0.5 * m, 0.4 * m] }
        }
        holonomic {
            one: hinge(a.at([0.5, 0, 0]), b.at([-0.3, 0, 0]), [0, 0, 1])
            other: hinge(a.at([0.8, 0, 0.4]), b.at([0, 0, 0.4]), [1, 0, 0])
        }
        let axis = a.along([0, 0, 1]);
        let rate = inner(b.omega - a.omega, axis);
        forces { torque(a, b, axis * (-mu * sign(rate) - c * rate * abs(rate))) }
        start thrown() {
            a.x = far; a.y = far; a.z = 0.0; dot(a.x) = 1.0; dot(a.y) = 0.0; dot(a.z) = 0.0;
            a.omega = [0.4, -0.3, 0.9];
            b.x near far + 0.8; b.y near far;
        }
    }
}

type Made = fn(f64, f64, f64) -> Prepared;

/// Each with this friction and drag, mass, and place.
const LOCKED: [(&str, Made); 3] = [
    ("pinned", |mu, m, far| {
        Pinned { mu, c: mu, m, far }.prepared()
    }),
    ("propped", |mu, m, far| {
        Propped { mu, c: mu, m, far }.prepared()
    }),
    ("door", |mu, m, far| Door { mu, c: mu, m, far }.prepared()),
];

/// What joints do that several joints lock together is what they do without friction, to the last step.
#[test]
fn friction_where_two_joints_lock_a_third_does_nothing() {
    for (name, made) in LOCKED {
        for far in [0.0, 1e4] {
            for (mass, mu) in [(1.0, 0.7), (1.0, 1e4), (1e3, 1e-3)] {
                let thrown = made(mu, mass, far).start("thrown", &[].into());
                let start = thrown.expect("they fit");
                let at = |mu, method, tolerance| {
                    let run = Simulation::new(made(mu, mass, far));
                    end(run, &start, method, tolerance, 1.0)
                };
                let free = at(0.0, Method::Dop853, 1e-13);
                for method in METHODS {
                    for tolerance in TOLERANCES {
                        let of = format!("{name}, {method}, {tolerance:e}, {mu:e}, {far:e}");
                        let rubbed = at(mu, method, tolerance);
                        let [one, other] = [&rubbed, &free].map(|run| run.last().expect("an end"));
                        let off = apart(one.q, other.q).max(apart(one.v, other.v));
                        assert!(off < 30.0 * tolerance, "{of}: {off:e}");
                        assert_eq!(rubbed.work().switches, 0, "{of}");
                    }
                }
            }
        }
    }
}

/// Off the constraints they lock, too.
#[test]
fn friction_does_nothing_in_locked_joints_that_drift() {
    for (name, made) in LOCKED {
        let start = made(0.7, 1.0, 0.0)
            .start("thrown", &[].into())
            .expect("they fit");
        for until in [1.0, -1.0] {
            let at = |mu, method, tolerance| {
                let run = Simulation::new(made(mu, 1.0, 0.0)).stabilise(Stabilisation::None);
                end(run, &start, method, tolerance, until)
            };
            let free = at(0.0, Method::Dop853, 1e-13);
            for method in METHODS {
                for tolerance in [1e-8, 1e-10, 1e-12] {
                    let of = format!("{name}, {method}, {tolerance:e}, {until}");
                    let rubbed = at(0.7, method, tolerance);
                    let [one, other] = [&rubbed, &free].map(|run| run.last().expect("an end"));
                    let off = apart(one.q, other.q);
                    assert!(off < 30.0 * tolerance + 1e-11, "{of}: {off:e}");
                    assert_eq!(rubbed.work().switches, 0, "{of}");
                }
            }
        }
    }
}

ukcore::multibody! {
    /// A drive that begins at rest, with friction that it takes up; a body that an overload of the drive pushes, one that its direction
    /// does, and one that this does for a moment. A light body that is held far off beside a heavy one that rubs on it.
    Driven {
        params { c = 0.7, far = 1e9 }
        coords { x, pushed, led, pulsed, held, heavy }
        mass { x: 1, pushed: 1, led: 1, pulsed: 1, held: 1e-6, heavy: 1e4 }
        let way = sign(dot(x));
        let rub = 1e4 * sign(dot(heavy) - dot(held));
        force {
            x: -c * way, led: max(way - 0.5, 0), pulsed: exp(-sq((t - 1) / 0.1)) * way,
            held: rub, heavy: 2e4 - rub
        }
        nonideal { pushed: max(reaction(drive) - 2.2, 0) }
        holonomic { drive: x = sq(t), hold: held = far }
    }
}

/// Constraints that take up friction of what they drive, or of what moves beside them, lock nothing.
#[test]
fn friction_that_a_drive_takes_up_is_that_of_its_direction() {
    let start = at(&[0.0, 0.0, 0.0, 0.0, 1e9, 0.0], &[0.0; 6]);
    // ∫∫ of the pulse: (t − 1) e from 1 on, where e is its whole.
    let pulse = 0.1 * std::f64::consts::PI.sqrt();
    for method in METHODS {
        for tolerance in TOLERANCES {
            // (A pulse is not looked for.)
            let run = Simulation::new(Driven::default()).max_step(0.1);
            let run = end(run, &start, method, tolerance, 2.0);
            let off = apart(
                run.last().expect("an end").q,
                &[4.0, 1.0, 1.0, pulse, 1e9, 2.0],
            );
            assert!(
                off < 30.0 * tolerance + 1e-9,
                "{method}, {tolerance:e}: {off:e}"
            );
        }
    }
}

ukcore::multibody! {
    /// A knife edge along y whose direction turns: at the start alone it takes up what rubs along x.
    Turning {
        params { w = 1.0, known = 0.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        force { x: (1 - known) * -0.7 * sign(dot(x)) + known * 0.7, y: 0.3 }
        nonholonomic { edge: cos(w * t) * dot(x) + sin(w * t) * dot(y) = 0 }
    }
}

/// What constraints lock at the start alone rubs from there on.
#[test]
fn friction_that_is_locked_for_a_moment_rubs_behind_it() {
    let start = at(&[0.0; 2], &[0.0, 1.0]);
    for w in [1.0, 1e-3, 1e-6, 1e-9] {
        let known = Turning { w, known: 1.0 };
        let known = end(Simulation::new(known), &start, Method::Dop853, 1e-13, 1.0);
        for method in METHODS {
            for tolerance in TOLERANCES {
                let run = Simulation::new(Turning { w, known: 0.0 });
                let found = end(run, &start, method, tolerance, 1.0);
                let [one, other] = [&found, &known].map(|run| run.last().expect("an end"));
                let off = apart(one.q, other.q);
                assert!(
                    off < 3.0 * tolerance + 1e-14,
                    "{method}, {tolerance:e}, {w:e}: {off:e}"
                );
            }
        }
    }
}

ukcore::multibody! {
    /// A block under a force that grows, or not, from the limit of friction at rest.
    Limit {
        params { f = 2.0, c0 = 2.0, c1 = 0.0 }
        coords { x }
        mass { x: 1 }
        force { x: c0 + c1 * t - f * sign(dot(x)) }
    }
}

/// A force of just the limit of friction leaves a body at rest, and one that grows from there moves it, in either direction.
#[test]
fn a_force_at_the_limit_of_friction_does_not_stop_a_run() {
    for direction in [1.0, -1.0] {
        for c1 in [0.0, 1.0] {
            for method in METHODS {
                for tolerance in TOLERANCES {
                    let block = Limit {
                        c0: 2.0 * direction,
                        c1: c1 * direction,
                        ..Limit::default()
                    };
                    let run = end(
                        Simulation::new(block),
                        &at(&[0.0], &[0.0]),
                        method,
                        tolerance,
                        1.0,
                    );
                    let off = (run.last().expect("an end").q[0] - direction * c1 / 6.0).abs();
                    assert!(
                        off < 1e-13,
                        "{method}, {tolerance:e}, {direction}, {c1}: {off:e}"
                    );
                }
            }
        }
    }
}
