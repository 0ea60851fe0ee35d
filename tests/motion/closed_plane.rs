//! Loops of a plane in space: rows of the joint that closes them hold wherever the bodies can be, and are no constraints.

use tests::{assert_all_close, assert_close, at_rest};
use ukcore::{Mechanism, Prepared, Simulation, State, assemble};

/// A four-bar linkage of bodies in space whose axes have the direction `$axis`, closed by a joint some rows of which always hold; with bars
/// in one plane, or beside each other.
macro_rules! four_bar_in_space {
    ($name:ident, $axis:tt, $closed:tt) => { four_bar_in_space! { $name, $axis, [0, 0, 0], $closed } };
    ($name:ident, $axis:tt, [$crank:expr, $rod:expr, $rocker:expr], { $($closed:tt)* }) => {
        ukcore::multibody! {
            $name {
                params { g = 9.81 }
                bodies {
                    spatial crank { mass: 1.0, inertia: [0.01, 0.03, 0.03], centre: [0.15, 0, 0] }
                    spatial rod { mass: 0.7, inertia: [0.01, 0.02, 0.02], centre: [0.35, 0, 0] }
                    spatial rocker { mass: 1.1, inertia: [0.01, 0.03, 0.03], centre: [0.25, 0, 0] }
                }
                gravity { [0, -g, 0] }
                tree {
                    o: hinge(ground.at([0, 0, $crank]), crank.at([0, 0, 0]), $axis)
                    p: hinge(crank.at([0.3, 0, $rod]), rod.at([0, 0, 0]), $axis)
                    r: hinge(ground.at([0.6, 0, $rocker]), rocker.at([0, 0, 0]), $axis)
                }
                holonomic { $($closed)* }
                start open { o.angle = 1.0; p.angle near -0.7; r.angle near 1.1 }
            }
        }
    };
}
four_bar_in_space! { Upright, [0, 0, 1], { q: hinge(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, 0, 1]) } }
four_bar_in_space! { Inclined, [0, 1, 2], { q: hinge(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, 1, 2]) } }
four_bar_in_space! { Slipping, [0, 1, 2], { q: cylinder(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, 1, 2]) } }
four_bar_in_space! { Joined, [0, 1, 2], { q: rod.at([0.7, 0, 0]) = rocker.at([0.5, 0, 0]) } }

// Offsets that add up to the same in all digits but the last.
four_bar_in_space! { Offset, [0, 0, 1], [0.1, 0.2, 0.3], { q: hinge(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, 0, 1]) } }

/// The same linkage on a trunk that floats, or hangs on a ball, with a crank that is driven on.
macro_rules! linkage_on_a_trunk {
    ($name:ident, $axis:tt, { $($hung:tt)* }, { $($closed:tt)* }) => {
        ukcore::multibody! {
            $name {
                bodies {
                    spatial trunk { mass: 5.0, inertia: [0.4, 0.5, 0.6], centre: [0.1, 0.2, -0.1] }
                    spatial crank { mass: 1.0, inertia: [0.01, 0.03, 0.03], centre: [0.15, 0, 0] }
                    spatial rod { mass: 0.7, inertia: [0.01, 0.02, 0.02], centre: [0.35, 0, 0] }
                    spatial rocker { mass: 1.1, inertia: [0.01, 0.03, 0.03], centre: [0.25, 0, 0] }
                }
                tree {
                    $($hung)*
                    o: hinge(trunk.at([0, 0, 0]), crank.at([0, 0, 0]), $axis)
                    p: hinge(crank.at([0.3, 0, 0]), rod.at([0, 0, 0]), $axis)
                    r: hinge(trunk.at([0.6, 0, 0]), rocker.at([0, 0, 0]), $axis)
                }
                force { o.angle: 2.0 }
                holonomic { $($closed)* }
                start open { o.angle = 1.0; p.angle near -0.7; r.angle near 1.1 }
            }
        }
    };
}
linkage_on_a_trunk! { FloatingHinge, [0, 1, 2], {}, { q: hinge(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, 1, 2]) } }
linkage_on_a_trunk! { FloatingBall, [0, 1, 2], {}, { q: ball(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0])) } }
linkage_on_a_trunk! { FloatingCylinder, [0, 1, 2], {}, { q: cylinder(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, 1, 2]) } }
linkage_on_a_trunk! { FloatingPoints, [0, 1, 2], {}, { q: rod.at([0.7, 0, 0]) = rocker.at([0.5, 0, 0]) } }
linkage_on_a_trunk! { HungHinge, [0, 1, 2], { s: ball(ground.at([0, 0, 0]), trunk.at([0, 0, 0])) }, { q: hinge(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, 1, 2]) } }
linkage_on_a_trunk! { HungBall, [0, 1, 2], { s: ball(ground.at([0, 0, 0]), trunk.at([0, 0, 0])) }, { q: ball(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0])) } }
// Of whose rows one would have no gradient in the plane of the ground.
linkage_on_a_trunk! { UprightFloatingHinge, [0, 0, 1], {}, { q: hinge(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, 0, 1]) } }
linkage_on_a_trunk! { UprightFloatingBall, [0, 0, 1], {}, { q: ball(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0])) } }
linkage_on_a_trunk! { UprightHungHinge, [0, 0, 1], { s: ball(ground.at([0, 0, 0]), trunk.at([0, 0, 0])) }, { q: hinge(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, 0, 1]) } }
linkage_on_a_trunk! { UprightHungBall, [0, 0, 1], { s: ball(ground.at([0, 0, 0]), trunk.at([0, 0, 0])) }, { q: ball(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0])) } }

// A function with pieces, of a parameter.
four_bar_in_space! { Absolute, [0, abs(g) / g, 2], { q: hinge(rod.at([0.7, 0, 0]), rocker.at([0.5, 0, 0]), [0, abs(g) / g, 2]) } }

ukcore::multibody! {
    /// What engages late is a constraint all the same.
    Clutch {
        params { tau = 0.1, h = 0.5 }
        coords { a, b, c, d }
        mass { a: 1.0, b: 2.0, c: 1.0, d: 1.0 }
        force { a: 1.0 }
        holonomic { level: c = d + asin(h / 0.5) }
        nonholonomic { clutch: (1.0 + tanh((t - 5.0) / tau)) * (dot(a) - dot(b)) = 0.0 }
    }
}

#[test]
fn what_engages_late_is_no_row_that_always_holds() {
    let start = at_rest(&[0.0, 0.0, std::f64::consts::FRAC_PI_2, 0.0]);
    let start = assemble(Clutch::default(), &start, &[]).expect("a start");
    let run = Simulation::new(Clutch::default())
        .start(start)
        .until(8.0)
        .expect("a run");
    let last = run.last().expect("a sample").to_state();
    // The momentum that one has got is that of both.
    assert_close("a", last.v[0], 8.0 / 3.0, 1e-6);
    assert_close("b", last.v[1], 8.0 / 3.0, 1e-6);
}

ukcore::multibody! {
    /// The same in the plane, where gravity has the share `part` of its strength.
    Level {
        params { part = 1.0 }
        bodies {
            planar crank { mass: 1.0, inertia: 0.03, centre: [0.15, 0] }
            planar rod { mass: 0.7, inertia: 0.02, centre: [0.35, 0] }
            planar rocker { mass: 1.1, inertia: 0.03, centre: [0.25, 0] }
        }
        gravity { [0, -9.81 * part] }
        tree {
            o: pin(ground.at([0, 0]), crank.at([0, 0]))
            p: pin(crank.at([0.3, 0]), rod.at([0, 0]))
            r: pin(ground.at([0.6, 0]), rocker.at([0, 0]))
        }
        holonomic { q: pin(rod.at([0.7, 0]), rocker.at([0.5, 0])) }
        start open { o.angle = 1.0; p.angle near -0.7; r.angle near 1.1 }
    }
}

/// Rows of the last joint that hold wherever the bodies can be are no constraints, whether the compiler sees it in their symbols or not.
#[test]
fn a_loop_of_a_plane_in_space_moves_as_in_the_plane() {
    fn angles(mechanism: &impl Mechanism) -> Vec<f64> {
        let prepared: Prepared = mechanism.into();
        let start = prepared.start("open", &[].into()).expect("a start");
        let run = Simulation::new(prepared).tolerance(1e-11).start(start);
        let run = run.every(0.1).until(2.0).expect("a run");
        assert!(run.energy_drift() < 1e-8, "{}", run.energy_drift());
        run.samples().flat_map(|sample| sample.q.to_vec()).collect()
    }
    let flat = |part: f64| angles(&Level { part });
    assert_all_close("upright", &angles(&Upright::default()), &flat(1.0), 1e-7);
    assert_all_close("offset", &angles(&Offset::default()), &flat(1.0), 1e-7);
    let inclined = flat(2.0 / 5.0_f64.sqrt());
    assert_all_close("inclined", &angles(&Inclined::default()), &inclined, 1e-7);
    assert_all_close("sliding", &angles(&Slipping::default()), &inclined, 1e-7);
    assert_all_close("joined", &angles(&Joined::default()), &inclined, 1e-7);
    assert_all_close("absolute", &angles(&Absolute::default()), &inclined, 1e-7);
    let names = Upright::SPEC.constraints.iter().map(|row| row.name);
    assert_eq!(names.collect::<Vec<_>>(), ["q.x", "q.y"]);
    assert_eq!(Upright::Q, [0, 1]);
}

/// Such rows hold where quaternions have the length 1, and nowhere else.
#[test]
fn a_loop_of_a_plane_on_a_trunk_moves_however_it_is_closed() {
    fn start(mechanism: &impl Mechanism) -> State {
        let prepared: Prepared = mechanism.into();
        prepared.start("open", &[].into()).expect("a start")
    }
    fn places(mechanism: &impl Mechanism, start: &State) -> Vec<f64> {
        let run = Simulation::new(mechanism)
            .tolerance(1e-11)
            .start(start.clone());
        let run = run.every(0.02).until(0.5).expect("a run");
        run.samples().flat_map(|sample| sample.q.to_vec()).collect()
    }
    // One start for all: where it is near a guess rounding decides.
    let open = start(&FloatingCylinder::default());
    let floating = places(&FloatingCylinder::default(), &open);
    assert_all_close(
        "hinge",
        &places(&FloatingHinge::default(), &open),
        &floating,
        1e-7,
    );
    assert_all_close(
        "ball",
        &places(&FloatingBall::default(), &open),
        &floating,
        1e-7,
    );
    assert_all_close(
        "points",
        &places(&FloatingPoints::default(), &open),
        &floating,
        1e-7,
    );
    let open = start(&HungHinge::default());
    let hung = places(&HungHinge::default(), &open);
    assert_all_close("hung", &places(&HungBall::default(), &open), &hung, 1e-7);
    let open = start(&UprightFloatingHinge::default());
    let floating = places(&UprightFloatingHinge::default(), &open);
    let found = places(&UprightFloatingBall::default(), &open);
    assert_all_close("upright", &found, &floating, 1e-7);
    let open = start(&UprightHungHinge::default());
    let hung = places(&UprightHungHinge::default(), &open);
    let found = places(&UprightHungBall::default(), &open);
    assert_all_close("upright and hung", &found, &hung, 1e-7);
}
