//! Runs that cannot go on say why, in time, by the names of the declaration.

use tests::{at, at_rest, cause, corner};
use ukcore::simulate::Switching;
use ukcore::{Error, Method, Simulation, State, lost_reactions};

ukcore::multibody! {
    /// Two constraints on x + y that agree at t = 0 only.
    pub Diverging {
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        force { z: -z }
        holonomic {
            line: x + y = t,
            sine: x + y = sin(t),
            other: x - y = 0.0,
        }
    }
}

ukcore::multibody! {
    /// Two constraints on x + y that agree until t = 0.5.
    pub Parting {
        params { linear = 0.0, square = 0.0, cube = 0.0 }
        coords { x, y }
        mass { x: 1.0, y: 2.0 }
        let after = max(0.0, t - 0.5);
        holonomic {
            early: x + y = sin(t),
            late: x + y = sin(t) + linear * after + square * sq(after) + cube * after.powi(3),
        }
    }
}

ukcore::multibody! {
    /// A block on a slope of inclination `slope`, with dry friction.
    pub Block {
        params { m = 2.0, mu = 0.5, g = 9.81, slope = 0.0 }
        coords { s, h }
        mass { s: m, h: m }
        force { s: m * g * sin(slope) - mu * m * g * cos(slope) * sign(dot(s)), h: -m * g }
        holonomic { ground: h = 0.0 }
    }
}

/// The two constraints of a contradiction, with residuals that are opposite, as far as they are in the same units.
#[track_caller]
fn contradiction(error: &Error) -> ([&str; 2], f64) {
    let (Error::Inconsistent { constraints } | Error::OffConstraint { constraints, .. }) = error
    else {
        panic!("{error}");
    };
    let [(a, ra), (b, rb)] = &constraints[..] else {
        panic!("{error}");
    };
    assert!((ra + rb).abs() <= 1e-6 * ra.abs(), "{error}");
    ([a, b], ra.abs())
}

#[test]
fn constraints_that_come_apart_in_time_are_both_named_there() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        let start = at(&[0.0; 3], &[0.5, 0.5, 0.0]);
        let run = Simulation::new(Diverging::default())
            .method(method)
            .start(start);
        let failure = run.until(1.0).unwrap_err();
        let (t, error) = cause(&failure.error);
        let (names, residual) = contradiction(error);
        assert_eq!(names, ["line", "sine"]);
        // Of the accelerations 0 and −sin t, least squares leave half to each.
        assert!(t > 0.0 && t < 0.1, "{t}");
        assert!((residual - 0.5 * t.sin()).abs() < 1e-9 * t, "{residual}");
    }
}

#[test]
fn a_contradiction_that_begins_within_a_run_is_found_where_it_begins() {
    for (linear, square, cube) in [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)] {
        let start = at(&[0.0; 2], &[2.0 / 3.0, 1.0 / 3.0]);
        let parting = Parting {
            linear,
            square,
            cube,
        };
        let failure = Simulation::new(parting)
            .start(start)
            .until(2.0)
            .unwrap_err();
        let (t, error) = cause(&failure.error);
        let (names, residual) = contradiction(error);
        assert_eq!(names, ["early", "late"]);
        assert!((0.5..0.6).contains(&t), "{t}: {error}");
        // Half of what they differ by: in velocity, or in acceleration.
        let expected = 0.5 * linear + square + 3.0 * cube * (t - 0.5);
        assert!((residual - expected).abs() < 1e-6 * expected, "{error}");
        assert!(
            failure
                .trajectory
                .last()
                .is_some_and(|last| (last.t - 0.5).abs() < 0.01)
        );
    }
}

#[test]
fn friction_that_brings_to_rest_is_named_with_the_remedy() {
    // Comes to rest; stands from the start; stands on a slope.
    for (slope, v, rest) in [
        (0.0, 1.0, 1.0 / 4.905),
        (0.1, 0.0, 0.0),
        (-0.1, 2.0, f64::NAN),
    ] {
        for tolerance in [1e-5, 1e-9] {
            let block = Block {
                slope,
                ..Block::default()
            };
            let start = at(&[0.0; 2], &[v, 0.0]);
            let failure = Simulation::new(block)
                .tolerance(tolerance)
                .start(start)
                .until(1e3)
                .unwrap_err();
            let (t, error) = cause(&failure.error);
            let Error::Chattering { terms, .. } = error else {
                panic!("{error}");
            };
            assert_eq!(terms, &["force on `s`"]);
            if rest.is_finite() {
                assert!(t >= rest && t < 10.0, "{t}");
            }
            let message = failure.to_string();
            assert!(
                message.contains("terminal event") && message.contains("tanh"),
                "{message}"
            );
        }
    }
}

ukcore::multibody! {
    /// A point that climbs to either side, as fast as it goes there.
    pub Climbing {
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { y }
        nonholonomic { climb: dot(y) = 0.5 * abs(dot(x)) }
    }
}

#[test]
fn a_constraint_that_switches_is_not_told_as_friction() {
    // ẍ = −0.4 while it climbs; then nothing lets it fall.
    let start = at(&[0.0; 2], &[1.0, 0.5]);
    let failure = Simulation::new(Climbing::default()).start(start);
    let failure = failure.until(10.0).expect_err("rest");
    let (t, error) = cause(&failure.error);
    assert!((t - 2.5).abs() < 1e-9, "{t}");
    let told = error.to_string();
    let whole = told.contains("in the constraint `climb`")
        && told.contains("how the motion goes on where a constraint switches");
    assert!(whole && !told.contains("friction"), "{told}");
}

ukcore::multibody! {
    /// A point that is drawn to the origin or driven away from it, beside a swing that goes on whatever the point does.
    pub Singular {
        params { pull = 0.0, push = 0.0 }
        coords { swing, x }
        mass { swing: 1.0, x: 1.0 }
        force { swing: -swing, x: push * x.powi(3) - pull / x.powi(3) }
    }
}

#[test]
fn a_motion_that_ends_in_finite_time_ends_there_and_names_its_acceleration() {
    // From rest at a: x² = a² − t²/a² under the pull; under the push x = a / cn(a t) with modulus 1/√2, which ends at K(1/√2) / a.
    let quarter = 1.854_074_677_301_372;
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for short in [1.0_f64, 1e-3, 1e-6, 1e-8] {
            let by_pull = (1.0, 0.0, short, short * short);
            let by_push = (0.0, 1.0, short.recip(), quarter * short);
            for (pull, push, size, end) in [by_pull, by_push] {
                for sign in [1.0, -1.0] {
                    let start = at_rest(&[1.0, size]);
                    let run = Simulation::new(Singular { pull, push }).start(start);
                    let run = run.method(method).max_steps(20_000);
                    let failure = run.until(sign * 10.0).unwrap_err();
                    let (t, error) = cause(&failure.error);
                    assert!((sign * t - end).abs() < 1e-6 * end, "{method}: {t}, {end}");
                    let Error::StepTooSmall { step, fastest } = error else {
                        panic!("{method}, {size}: {error}");
                    };
                    assert!(*step > 0.0 && *step < 1e-14 * end, "{step}");
                    let (name, acceleration) = fastest.as_ref().expect("it has one");
                    let expected = (push - pull) * f64::INFINITY;
                    assert_eq!(
                        (name.as_str(), acceleration * f64::INFINITY),
                        ("x", expected)
                    );
                    assert!(
                        acceleration.abs() > 1e6 * size / (end * end),
                        "{acceleration}"
                    );
                    assert!(
                        failure.to_string().contains("`x` accelerates by"),
                        "{failure}"
                    );
                }
            }
        }
    }
}

/// So it does late, where steps are lost in the rounding of the time before they are in their own.
#[test]
fn a_motion_that_ends_in_finite_time_does_so_late_too() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for t0 in [30.0, 1e3, -1e5, 1e7] {
            let start = State {
                t: t0,
                q: vec![1.0, 1.0],
                v: vec![0.0; 2],
            };
            let run = Simulation::new(Singular {
                pull: 1.0,
                push: 0.0,
            })
            .start(start);
            let failure = run
                .method(method)
                .max_steps(20_000)
                .until(t0 + 10.0)
                .unwrap_err();
            let (t, error) = cause(&failure.error);
            assert!((t - t0 - 1.0).abs() < 1e-6, "{method}: {t}");
            let Error::StepTooSmall {
                fastest: Some((name, acceleration)),
                ..
            } = error
            else {
                panic!("{method}, {t0}: {error}");
            };
            assert!(
                name == "x" && *acceleration < -1e6,
                "{method}, {t0}: {error}"
            );
        }
    }
}

ukcore::multibody! {
    /// A mass on a spring, or before a buffer.
    pub Stopped {
        params { k = 0.0, buffer = 0.0, f = 0.0 }
        coords { x }
        mass { x: 1.0 }
        potential { 0.5 * k * sq(x) }
        force { x: f - buffer * max(x - 1.0, 0.0) }
    }
}

/// What is only too fast for a late time is told to be late, from wherever it begins.
#[test]
fn fast_motions_are_too_late_and_end_nowhere() {
    let spring = |k: f64| Stopped {
        k,
        ..Stopped::default()
    };
    let buffer = |buffer: f64, f: f64| Stopped {
        buffer,
        f,
        ..Stopped::default()
    };
    for (mechanism, x, v, t0) in [
        (spring(1.78e13), 0.0, 1.0, 1.7e9),
        (spring(1.78e13), 1.0, 0.0, 1.7e9),
        (spring(1e12), 0.0, -3.0, 1e11),
        (buffer(1e12, 0.0), 0.0, 1.0, 1e10),
        (buffer(1e12, 0.5), 0.0, 1.0, 1e10),
    ] {
        let start = State {
            t: t0,
            q: vec![x],
            v: vec![v],
        };
        let run = Simulation::new(mechanism).start(start).max_steps(20_000);
        let Err(failure) = run.until(t0 + 3.0) else {
            continue;
        };
        let (_, error) = cause(&failure.error);
        let late = matches!(error, Error::TooLate { .. } | Error::Rounding { .. });
        assert!(late, "{x}, {v}, {t0:e}: {failure}");
    }
}

ukcore::multibody! {
    /// A planet.
    pub Orbit {
        params { k = 1.0 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { -k / sqrt(sq(x) + sq(y)) }
    }
}

#[test]
fn a_motion_too_fast_for_its_run_is_given_up_before_all_steps_are_used_up() {
    for sign in [1.0, -1.0] {
        let run = |turns: f64, max_steps: usize| {
            let radius = 1e-8_f64;
            let start = at(&[radius, 0.0], &[0.0, radius.sqrt().recip()]);
            let run = Simulation::new(Orbit::default()).start(start).at(vec![]);
            let period = std::f64::consts::TAU * radius.powf(1.5);
            run.max_steps(max_steps).until(sign * turns * period)
        };
        let failure = run(1e12, 10_000_000).unwrap_err();
        let (_, error) = cause(&failure.error);
        let Error::StepTooSmall { step, fastest } = error else {
            panic!("{error}");
        };
        assert!((1e-14..1e-12).contains(step), "{step}");
        assert!(fastest.as_ref().is_some_and(|(_, a)| a.abs() > 1e15));
        assert_eq!(failure.trajectory.work().steps, 100_000);
        // Few steps are used up; a run that gets on ends, however short its steps are.
        let failure = run(1e12, 1_000).unwrap_err();
        let (_, error) = cause(&failure.error);
        assert_eq!(*error, Error::TooManySteps { steps: 1_000 });
        assert!(failure.to_string().contains("Radau5"), "{failure}");
        assert!(run(100.0, 10_000_000).is_ok());
    }
}

#[test]
fn steps_kept_short_on_purpose_do_not_chatter() {
    for max_step in [1e-8, 1e-6] {
        let start = at(&[0.0; 2], &[1.0, 0.0]);
        let run = Simulation::new(Block::default()).start(start);
        let run = run.max_step(max_step).max_steps(1000);
        let failure = run.until(0.1).unwrap_err();
        let (_, error) = cause(&failure.error);
        assert_eq!(*error, Error::TooManySteps { steps: 1000 });
    }
}

ukcore::multibody! {
    /// A carriage whose prescribed place, or velocity, jumps at t = 1/2.
    pub Carriage {
        params { place = 0.0, velocity = 0.0 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { 15.0 * sq(x - y) }
        holonomic { drive: x = place * sign(t - 0.5) + velocity * max(0.0, t - 0.5) }
    }
}

#[test]
fn a_jump_is_told_by_its_constraint_level_and_time() {
    for (place, velocity, level) in [(0.1, 0.0, "position"), (0.0, 0.1, "velocity")] {
        for switching in [Switching::Located, Switching::Ignored] {
            let mech = Carriage { place, velocity };
            let start = at_rest(&[-place, 0.0]);
            let run = Simulation::new(mech).start(start).switching(switching);
            let failure = run.until(1.0).expect_err("it jumps");
            let (t, cause) = self::cause(&failure.error);
            assert!((t - 0.5).abs() < 1e-8, "{t}");
            match cause {
                Error::Jump {
                    level: found,
                    constraints,
                } => {
                    assert_eq!((*found, constraints[0].0.as_str()), (level, "drive"));
                }
                other => panic!("{switching:?}, {level}: {other}"),
            }
        }
    }
}

ukcore::multibody! {
    /// A four-bar linkage whose crank is turned by a motor until coupler and rocker are in one line, in space between hinges and balls. All
    /// turns about z; x and y are as in the plane. A stand has the axes of the ground.
    pub Stretched {
        params { crank = 0.3, coupler = 0.2, rocker = 0.24, span = 0.4, w = 1.0, j = 0.003 }
        bodies {
            spatial arm { mass: 0.4, inertia: [j, j, j], centre: [crank / 2, 0, 0] }
            spatial rod { mass: 0.3, inertia: [j, j, j], centre: [coupler / 2, 0, 0] }
            spatial wing { mass: 0.5, inertia: [j, j, j], centre: [rocker / 2, 0, 0] }
            spatial stand { mass: 1.0, inertia: [j, j, j] }
        }
        holonomic {
            axle: hinge(ground.at([0, 0, 0]), arm.at([0, 0, 0]), [0, 0, 1])
            elbow: universal(arm.at([crank, 0, 0]), rod.at([0, 0, 0]), [0, 0, 1], [0, 1, 0])
            wrist: ball(rod.at([coupler, 0, 0]), wing.at([rocker, 0, 0]))
            pivot: hinge(ground.at([span, 0, 0]), wing.at([0, 0, 0]), [0, 0, 1])
            bolts: weld(ground.at([0, 0, 0]), stand.at([0, 0, 0]))
            motor: drive(ground, arm, [0, 0, 1], 0.5 + w * t)
        }
        output { torque = reaction(motor) }
        start ajar {
            arm.e0 near cos(0.25); arm.e3 near sin(0.25); rod.e0 near cos(0.2); rod.e3 near sin(0.2); wing.e0 near cos(0.8); wing.e3 near sin(0.8);
            stand.e0 near 1
        }
    }
}

/// Neither as a jump nor as stiff forces, by any method: the drive asks for more than the linkage reaches. Reactions that have grown beyond
/// all bounds before are told so, too, and not laid on a body that would be without inertia in its quaternion.
#[test]
fn a_drive_that_comes_to_a_dead_centre_is_told() {
    let mut linkage = Stretched::default();
    let Stretched {
        crank: a,
        coupler: b,
        rocker: c,
        span: d,
        ..
    } = linkage;
    let limit = corner(a, d, b + c);
    for w in [1.0, -0.5, 300.0] {
        linkage.w = w;
        let end = (limit.copysign(w) - 0.5) / w;
        let start = linkage
            .start("ajar", &[].into())
            .expect("it can be put together");
        for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
            for tolerance in [1e-3, 1e-7, 1e-11] {
                let run = Simulation::new(&linkage).start(start.clone());
                let run = run.method(method).tolerance(tolerance).until(2.0 * end);
                let failure = run.expect_err("a dead centre");
                let (t, error) = cause(&failure.error);
                let place = format!("{method}, {tolerance:e}, {w}: {error}");
                assert!((t - end).abs() < 1e-8 * end, "{place}: {t}, not {end}");
                let Error::DeadCentre {
                    constraints,
                    leader,
                } = error
                else {
                    panic!("{place}");
                };
                assert_eq!(constraints, &["motor"], "{place}");
                assert!(
                    leader.starts_with("wing.") || leader.starts_with("rod."),
                    "{place}"
                );
                assert!(
                    error.to_string().contains("cannot follow `motor` beyond"),
                    "{place}"
                );
                let last = failure.trajectory.last().expect("samples").to_state();
                let told = lost_reactions(&linkage, &last).expect("they are lost");
                assert!(
                    told.starts_with("what `motor` prescribes comes to a dead centre"),
                    "{told}"
                );
            }
        }
    }
}

#[test]
fn a_singular_position_without_names_is_a_sentence() {
    let constraints = Vec::new();
    let text = ukcore::Error::Singular { constraints }.to_string();
    assert!(
        text.contains("where a constraint is implied by the others"),
        "{text}"
    );
}

ukcore::multibody! {
    /// A bead on a wire with a corner, which turns a wheel.
    Corner {
        coords { x, y, a }
        mass { x: 1, y: 1, a: 2 }
        potential { y }
        holonomic { wire: y = max(x, -0.2 * x), turn: a = 3 * x }
    }
}

/// At a corner the velocity of a bead would have to jump, whatever the steps.
#[test]
fn a_path_with_a_kink_is_told() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for tolerance in [1e-4, 1e-9, 1e-12] {
            let start = at(&[-1.0, 0.2, -3.0], &[0.5, -0.1, 1.5]);
            let run = Simulation::new(Corner::default()).start(start);
            let run = run.method(method).tolerance(tolerance).until(3.0);
            let failure = run.expect_err("a corner");
            let (_, error) = cause(&failure.error);
            assert!(
                matches!(error, Error::Jump { level: "velocity", constraints } if constraints.len() == 1 && constraints[0].0 == "wire"),
                "{method}, {tolerance:e}: {error}"
            );
        }
    }
}

ukcore::multibody! {
    /// Two rods to a slider, their joint without mass.
    pub Elbow {
        params { f = 5.0 }
        coords { ex, ey, x }
        mass { x: 1.0 }
        force { x: f }
        holonomic { upper: sq([ex, ey]) = 1, lower: sq([x - ex, ey]) = 1 }
    }
}

/// Pulled straight, the joint has nothing that says how it goes on; before that the slider moves as if it were free.
#[test]
fn a_joint_without_mass_that_is_pulled_straight_is_named() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for (angle, f) in [(0.8_f64, 5.0), (0.8, 1e-3), (0.01, 5.0), (-1.3, 70.0)] {
            let q = vec![angle.cos(), angle.sin(), 2.0 * angle.cos()];
            let run = Simulation::new(Elbow { f }).start(at_rest(&q));
            let straight = ((2.0 - 2.0 * angle.cos()) * 2.0 / f).sqrt();
            let failure = run
                .method(method)
                .max_steps(100_000)
                .until(2.0 * straight)
                .unwrap_err();
            let (t, error) = cause(&failure.error);
            assert!(
                t <= straight && t > 0.9 * straight,
                "{method}, {angle}: {failure}"
            );
            assert!(
                failure.to_string().contains("`ey`"),
                "{method}, {angle}: {failure}"
            );
            assert!(
                matches!(error, Error::Underdetermined { .. }),
                "{method}, {angle}: {failure}"
            );
            for sample in failure.trajectory.samples() {
                let free = 2.0 * angle.cos() + 0.5 * f * sample.t * sample.t;
                assert!(
                    (sample.q[2] - free).abs() < 1e-7,
                    "{method}, {angle}: {}",
                    sample.t
                );
            }
        }
    }
}
