//! Efforts of loops that are closed over a tree, where rows of A vanish at a position or terms of b cancel, by the balance of power.

use std::f64::consts::PI;

use tests::{assert_close, at};
use ukcore::{Mechanism, State, assemble, inverse, inverse_forces, kinematics};

/// Bennett's linkage, four links with hinges askew, closed by a hinge of five rows that count as two; they all vanish or depend on each
/// other where it lies flat. `$motor` is one more constraint, if any.
macro_rules! bennett {
    ($name:ident: $($motor:tt)*) => {
        ukcore::multibody! {
            pub $name {
                params { a = 0.5, b = 0.8, twist = 0.5, g = 9.81 }
                let other = asin(b / a * sin(twist));
                bodies {
                    spatial l1 { mass: 1.0, inertia: [0.01, 0.03, 0.03], centre: [b / 2.0, 0, 0] }
                    spatial l2 { mass: 0.7, inertia: [0.01, 0.02, 0.02], centre: [a / 2.0, 0, 0] }
                    spatial l3 { mass: 1.1, inertia: [0.01, 0.03, 0.03], centre: [b / 2.0, 0.05, 0] }
                }
                gravity { [0, -g, 0] }
                tree {
                    h1: hinge(ground.at([a, 0, 0]), l1.at([0, 0, 0]), [0, -sin(twist), cos(twist)], [0, 0, 1])
                    h2: hinge(l1.at([b, 0, 0]), l2.at([0, 0, 0]), [0, -sin(other), cos(other)], [0, 0, 1])
                    h3: hinge(l2.at([a, 0, 0]), l3.at([0, 0, 0]), [0, -sin(twist), cos(twist)], [0, 0, 1])
                }
                holonomic {
                    $($motor)*
                    h4: hinge(l3.at([b, 0, 0]), ground.at([0, 0, 0]), [0, -sin(other), cos(other)], [0, 0, 1])
                }
                start turned(angle = 1.0) { h1.angle = angle; h2.angle near 1.0; h3.angle near -1.0 }
            }
        }
    };
}

bennett!(Bennett:);
bennett!(DrivenBennett: motor: h1.angle = 3.0 * t);

ukcore::multibody! {
    /// A parallelogram, whose coupler only shifts: at an even speed of the crank no coordinate accelerates.
    pub Parallel {
        params { a = 0.3, b = 0.7, g = 9.81 }
        bodies {
            planar l1 { mass: 1, inertia: 0.03, centre: [a / 2, 0] }
            planar l2 { mass: 1, inertia: 0.02, centre: [b / 2, 0] }
            planar l3 { mass: 1, inertia: 0.03, centre: [a / 2, 0] }
        }
        gravity { [0, -g] }
        tree {
            h1: pin(ground.at([0, 0]), l1.at([0, 0]))
            h2: pin(l1.at([a, 0]), l2.at([0, 0]))
            h3: pin(ground.at([b, 0]), l3.at([0, 0]))
        }
        holonomic { h4: pin(l2.at([b, 0]), l3.at([a, 0])) }
        start turned(angle = 1.0) { h1.angle = angle; h2.angle near -angle; h3.angle near angle }
    }
}

ukcore::multibody! {
    /// A slider-crank whose rod is as long as its crank.
    pub Isosceles {
        params { r = 0.3, g = 9.81 }
        bodies {
            planar crank { mass: 1, inertia: 0.03, centre: [r / 2, 0] }
            planar rod { mass: 1, inertia: 0.02, centre: [r / 2, 0] }
            planar ram { mass: 2, inertia: 0.03 }
        }
        gravity { [0, -g] }
        tree {
            h1: pin(ground.at([0, 0]), crank.at([0, 0]))
            h2: pin(crank.at([r, 0]), rod.at([0, 0]))
            h3: slider(ground.at([0, 0]), ram.at([0, 0]), [1, 0])
        }
        holonomic { h4: pin(rod.at([r, 0]), ram.at([0, 0])) }
        start turned(angle = 1.0) { h1.angle = angle; h2.angle near -2 * angle }
    }
}

ukcore::multibody! {
    /// Sarrus' linkage: two chains of three hinges across each other keep a plate level, which goes up and down.
    pub Sarrus {
        params { l = 0.4, w = 0.3, g = 9.81 }
        bodies {
            spatial a1 { mass: 1, inertia: [0.01, 0.02, 0.02], centre: [0, l / 2, 0] }
            spatial a2 { mass: 1, inertia: [0.01, 0.02, 0.02], centre: [0, -l / 2, 0] }
            spatial plate { mass: 2, inertia: [0.05, 0.05, 0.1] }
            spatial b1 { mass: 1, inertia: [0.02, 0.01, 0.02], centre: [l / 2, 0, 0] }
            spatial b2 { mass: 1, inertia: [0.02, 0.01, 0.02], centre: [-l / 2, 0, 0] }
        }
        gravity { [0, 0, -g] }
        tree {
            h1: hinge(ground.at([0, w, 0]), a1.at([0, 0, 0]), [1, 0, 0])
            h2: hinge(a1.at([0, l, 0]), a2.at([0, 0, 0]), [1, 0, 0])
            h3: hinge(a2.at([0, -l, 0]), plate.at([0, w, 0]), [1, 0, 0])
            k1: hinge(ground.at([w, 0, 0]), b1.at([0, 0, 0]), [0, 1, 0])
            k2: hinge(b1.at([l, 0, 0]), b2.at([0, 0, 0]), [0, 1, 0])
        }
        holonomic { k3: hinge(b2.at([-l, 0, 0]), plate.at([w, 0, 0]), [0, 1, 0]) }
        start turned(angle = 0.6) {
            h1.angle = angle; h2.angle near -2 * angle; h3.angle near angle; k1.angle near -angle; k2.angle near 2 * angle
        }
    }
}

/// Sweeps `h1.angle` from one value to another at 3 rad/s, in steps of a thousandth or so, and compares the power of the effort on it with
/// the change of the energy.
fn balance<M: Mechanism + Default>(begin: f64, end: f64, intervals: usize) {
    let mech = M::default().prepared();
    let start = mech.start("turned", &[].into()).unwrap();
    let drives = [("h1.angle", begin..end)];
    let swept = kinematics(&mech, &start, &drives, &[], intervals).unwrap();
    let swept = swept.at_speed(3.0).unwrap();
    let efforts = swept.efforts(&["h1.angle"]).unwrap();
    let energies = swept.postures.iter().map(|posture| {
        let State { t, q, v } = &posture.state;
        mech.energy(*t, q, v).total()
    });
    let energies: Vec<f64> = energies.collect();
    let step = (end - begin).abs() / intervals as f64 / 3.0;
    for (energies, efforts) in energies.windows(5).zip(&efforts[2..]) {
        let [a, b, _, c, d] = energies else { return };
        let change = (8.0 * (c - b) - (d - a)) / (12.0 * step);
        let close = 1e-7 * (1.0 + change.abs());
        assert_close(M::SPEC.name, efforts[0].power, change, close);
    }
}

#[test]
fn power_is_balanced_where_terms_of_constraints_cancel() {
    balance::<Parallel>(0.3, 2.8, 500);
    balance::<Isosceles>(0.5, 1.4, 300);
    balance::<Sarrus>(0.3, 1.2, 300);
    // The weights of the two cranks count half, that of the coupler as a whole.
    let Parallel { a, g, .. } = Parallel::default();
    for angle in [0.4, 1.0, 2.0] {
        let start = Parallel::default().start("turned", &[("angle", angle)].into());
        let swept = kinematics(
            Parallel::default(),
            &start.unwrap(),
            &[("h1.angle", angle..angle + 0.1)],
            &[],
            1,
        );
        let effort = swept.unwrap().efforts(&["h1.angle"]).unwrap()[0][0].effort;
        assert_close("torque", effort, 2.0 * a * g * angle.cos(), 1e-12);
    }
}

#[test]
fn power_is_balanced_where_rows_vanish() {
    balance::<Bennett>(1.0, 7.5, 4800);
    // One of these postures is flat to 7e-5 rad.
    balance::<Bennett>(1.0, -6.0, 4800);
}

/// Near where it lies flat some rows of its joint are nothing but rounding.
#[test]
fn a_flat_linkage_of_bennett_is_as_beside_it() {
    let (free, driven) = (Bennett::default(), DrivenBennett::default());
    for aside in [
        1e-3, 1e-4, 3e-5, 1e-6, 1e-8, 1e-9, 1e-11, 1e-14, 2e-15, 0.0, -5e-15, -1e-12, -1e-8, -7e-6,
    ] {
        let angle = PI - aside;
        let guess = State {
            t: angle / 3.0,
            q: vec![angle, 0.003 * aside, -angle],
            v: vec![3.0, 10.0, -3.0],
        };
        let state = assemble(&free, &guess, &["h1.angle"]).unwrap();
        assert_close("speed of h3", state.v[2], -3.0, 1e-12);
        let effort = inverse(&driven, &state, &["motor"]).unwrap()[0].effort;
        let drive = [("h1.angle", angle..angle + 0.1)];
        let swept = kinematics(&free, &state, &drive, &[], 1).unwrap();
        let swept = swept.at_speed(3.0).unwrap();
        let found = swept.efforts(&["h1.angle"]).unwrap()[0][0].effort;
        // It changes by 226 N m a radian.
        assert_close("effort", found, -29.935_952_5 + 226.0 * aside, 3e-3);
        assert_close("motor", effort, found, 1e-5);
    }
}

/// So near to where its branches cross that rounding decides, a parallelogram has no effort; it is not 0.
#[test]
fn what_rounding_leaves_open_has_no_effort() {
    let parallel = Parallel::default();
    for (angle, told) in [(1e-3, true), (1e-8, false), (1e-9, false)] {
        let posture = ukcore::studies::Posture {
            state: at(&[angle, -angle, angle], &[3.0, -3.0, 3.0]),
            acceleration: vec![0.0; 3],
        };
        match inverse_forces(&parallel, &posture, &["h1.angle"]) {
            Ok(efforts) if told => assert_close("torque", efforts[0].effort, 5.886, 1e-5),
            Err(error) if !told => {
                let error = error.to_string();
                let says = error.contains("`state` is so near to a singular position")
                    && error.contains("`h4.");
                assert!(says, "{error}");
            }
            found => panic!("at {angle}: {found:?}"),
        }
    }
}
