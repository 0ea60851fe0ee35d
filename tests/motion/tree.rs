//! Bodies that hang on joints of the tree, beside the same bodies with coordinates of their own: the declarations differ in where the
//! joints stand.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use tests::{Random, assert_all_close, assert_close, at, at_rest, outputs};
use ukcore::simulate::Sample;
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Prepared, Simulation, Solver, State, Trajectory, assemble};

/// A chain of bodies, the first of which is free: the joints, those that hold velocities only, and all else.
macro_rules! chain {
    ($tree:ident, $own:ident, $n:literal, { $($bodies:tt)* }, { $($joints:tt)* }, { $($own_joints:tt)* }, { $($more:tt)* }, { $($turned:tt)* }) => {
        ukcore::multibody! {
            pub $tree {
                const N: usize = $n;
                bodies { $($bodies)* }
                tree { $($joints)* }
                $($more)*
                output { for i in 0..N { centre[i] = link[i].centre, $($turned)*, velocity[i] = dot(link[i].centre), omega[i] = link[i].omega } }
            }
        }
        ukcore::multibody! {
            pub $own {
                const N: usize = $n;
                bodies { $($bodies)* }
                $($own_joints)*
                $($more)*
                output { for i in 0..N { centre[i] = link[i].centre, $($turned)*, velocity[i] = dot(link[i].centre), omega[i] = link[i].omega } }
            }
        }
    };
}

chain! {
    Turning, TurningOwn, 4,
    { for i in 0..N { spatial link[i] { mass: 1 + i, inertia: [0.5, 0.6 + 0.1 * i, 0.7, 0.02, -0.03, 0.04], centre: [0.1, -0.2 * i, 0.05] } } },
    {
        hinge: hinge(link[0].at([0.3, 0.1, -0.2]), link[1].at([r, 0.3, 0.1]), u, w)
        cross: universal(link[1].at([0.4, 0, 0.1]), link[2].at([0, 0.2, 0.1]), [1, 0.4, 0], [0.3, 1, 0.2])
        ball: ball(link[2].at([0, 0.5, 0.1]), link[3].at([0.1, 0.1, -0.4]))
    },
    {
        holonomic {
            hinge: hinge(link[0].at([0.3, 0.1, -0.2]), link[1].at([r, 0.3, 0.1]), u, w)
            cross: universal(link[1].at([0.4, 0, 0.1]), link[2].at([0, 0.2, 0.1]), [1, 0.4, 0], [0.3, 1, 0.2])
            ball: ball(link[2].at([0, 0.5, 0.1]), link[3].at([0.1, 0.1, -0.4]))
        }
    },
    {
        params { u[3] = [1.0, 2.0, -2.0], w[3] = [-0.5, 0.3, 1.0], r = -0.2 }
        gravity { [0.3, 0, -9.81] }
        forces {
            spring(link[3].at([0, 0, 0.5]), ground.at([0, 1, 0]), 3, 0.4)
            damper(link[1].at([0, 0.3, 0]), link[3].at([0, 0, 0.2]), 0.7)
            turning_damper(link[1], link[2], 0.4)
            force(link[2].at([0.4, 0.1, 0]), [t, -0.6, 0.2])
            torque(link[3], [0.8, 0, 0.1])
        }
    },
    { axes[i] = link[i].axes }
}

chain! {
    Sliding, SlidingOwn, 5,
    { for i in 0..N { spatial link[i] { mass: 1 + i, inertia: [0.5, 0.6 + 0.1 * i, 0.7, 0.02, -0.03, 0.04], centre: [0.1, -0.2 * i, 0.05] } } },
    {
        tube: cylinder(link[0].at([0.3, 0.1, -0.2]), link[1].at([-0.2, 0.3, 0.1]), [0, 2, 1], [1, 0, 0])
        rail: slider(link[1].at([0.4, 0, 0.1]), link[2].at([0, 0.2, 0.1]), [1, 0.4, 0], rotz(0.4) * rotx(-1.1))
        fixed: weld(link[2].at([0, 0.5, 0.1]), link[3].at([0.1, 0.1, -0.4]), roty(0.8))
        screw: screw(link[3].at([0, 0.5, 0.1]), link[4].at([0.1, 0, -0.4]), [1, -1, 0.5], 0.3)
    },
    {
        holonomic {
            tube: cylinder(link[0].at([0.3, 0.1, -0.2]), link[1].at([-0.2, 0.3, 0.1]), [0, 2, 1], [1, 0, 0])
            rail: slider(link[1].at([0.4, 0, 0.1]), link[2].at([0, 0.2, 0.1]), [1, 0.4, 0], rotz(0.4) * rotx(-1.1))
            fixed: weld(link[2].at([0, 0.5, 0.1]), link[3].at([0.1, 0.1, -0.4]), roty(0.8))
            bolt: cylinder(link[3].at([0, 0.5, 0.1]), link[4].at([0.1, 0, -0.4]), [1, -1, 0.5])
        }
        nonholonomic { screw: screw(link[3].at([0, 0.5, 0.1]), link[4].at([0.1, 0, -0.4]), [1, -1, 0.5], 0.3) }
    },
    {
        gravity { [0.3, 0, -9.81] }
        forces {
            spring(link[4].at([0, 0, 0.5]), ground.at([0, 1, 0]), 3, 0.4)
            torque(link[1], link[4], [0.8, 0, 0.1])
        }
    },
    { axes[i] = link[i].axes }
}

chain! {
    Flat, FlatOwn, 5,
    { for i in 0..N { planar link[i] { mass: 1 + i, inertia: 0.3 + 0.1 * i, centre: [0.1, -0.2 * i] } } },
    {
        pin: pin(link[0].at([0.3, 0.1]), link[1].at([-0.2, 0.3]))
        rail: slider(link[1].at([0.4, 0]), link[2].at([0, 0.2]), [1, 0.4], 0.7)
        groove: slot(link[1].at([0.4, 0.3]), link[3].at([0.1, 0.2]), [-1, 2])
        fixed: weld(link[3].at([0, 0.5]), link[4].at([0.1, 0.1]), -0.3)
    },
    {
        holonomic {
            pin: pin(link[0].at([0.3, 0.1]), link[1].at([-0.2, 0.3]))
            rail: slider(link[1].at([0.4, 0]), link[2].at([0, 0.2]), [1, 0.4], 0.7)
            groove: slot(link[1].at([0.4, 0.3]), link[3].at([0.1, 0.2]), [-1, 2])
            fixed: weld(link[3].at([0, 0.5]), link[4].at([0.1, 0.1]), -0.3)
        }
    },
    {
        gravity { [0.3, -9.81] }
        forces {
            spring(link[4].at([0, 0.5]), ground.at([0, 1]), 3, 0.4)
            turning_spring(link[0], link[3], 2, 0.1)
            turning_damper(link[2], link[4], 0.4)
            torque(link[1], t)
        }
    },
    { angle[i] = link[i].angle }
}

fn random_state<M: Mechanism>(random: &mut Random) -> State {
    State {
        t: 0.7,
        ..random.turned(M::SPEC)
    }
}

/// The outputs at all samples.
fn put_out<M: Mechanism>(run: &Trajectory) -> Vec<Vec<f64>> {
    let mechanism = M::default().prepared();
    let states = run.samples().map(Sample::to_state);
    states.map(|state| outputs(&mechanism, &state)).collect()
}

/// The state of bodies in space with coordinates of their own, from what is put out of each.
fn own_state(t: f64, out: &[f64]) -> State {
    let (mut q, mut v) = (Vec::new(), Vec::new());
    for body in out.chunks(18) {
        let axes = Matrix3::from_row_slice(&body[3..12]);
        let rotation = Rotation3::from_matrix_unchecked(axes);
        assert_close(
            "axes",
            (axes.transpose() * axes - Matrix3::identity()).norm(),
            0.0,
            1e-14,
        );
        let e = UnitQuaternion::from_rotation_matrix(&rotation).into_inner();
        let rate = Quaternion::from_imag(Vector3::from_column_slice(&body[15..])) * e * 0.5;
        q.extend([body[0], body[1], body[2], e.w, e.i, e.j, e.k]);
        v.extend([body[12], body[13], body[14], rate.w, rate.i, rate.j, rate.k]);
    }
    State { t, q, v }
}

/// The same in the plane.
fn own_flat_state(t: f64, out: &[f64]) -> State {
    let bodies = out.chunks(6);
    let (q, v): (Vec<&[f64]>, Vec<&[f64]>) = bodies.map(|body| body.split_at(3)).unzip();
    State {
        t,
        q: q.concat(),
        v: v.concat(),
    }
}

/// At random states of the tree: its bodies satisfy what the joints demand, and they are accelerated as those with coordinates of their
/// own.
fn check<T: Mechanism, O: Mechanism>(freedoms: usize, spatial: bool) {
    let (width, velocities, each) = if spatial { (18, 6, 7) } else { (6, 3, 3) };
    let own = if spatial { own_state } else { own_flat_state };
    let mut random = Random::new(7);
    let mut solver = Solver::new(T::default(), SolverOptions::default());
    let mut other = Solver::new(O::default(), SolverOptions::default());
    let (tree, bodies): (Prepared, Prepared) = (T::default().prepared(), O::default().prepared());
    for _ in 0..10 {
        let state = random_state::<T>(&mut random);
        let out = outputs(&tree, &state);
        let same = own(state.t, &out);
        let (h, m) = (O::SPEC.holonomic, O::SPEC.constraints.len());
        let (mut phi, mut rate) = (vec![0.0; h], vec![0.0; m]);
        bodies.residual(same.t, &same.q, &mut phi);
        bodies.residual_rate(same.t, &same.q, &same.v, &mut rate);
        assert_all_close("rows", &phi, &vec![0.0; h], 1e-13);
        assert_all_close("rates of rows", &rate, &vec![0.0; m], 1e-12);
        let energies = [
            tree.energy(state.t, &state.q, &state.v),
            bodies.energy(same.t, &same.q, &same.v),
        ];
        assert_close(
            "kinetic energy",
            energies[0].kinetic,
            energies[1].kinetic,
            1e-12,
        );
        assert_close(
            "potential",
            energies[0].potential,
            energies[1].potential,
            1e-12,
        );

        let a = solver
            .solve(state.t, &state.q, &state.v)
            .expect("accelerations");
        assert_eq!(a.degrees_of_freedom, freedoms);
        let a = a.acceleration.to_vec();
        let expected = other
            .solve(same.t, &same.q, &same.v)
            .expect("accelerations");
        assert_eq!(expected.degrees_of_freedom, freedoms);
        // What the velocities that are put out change by, along the motion, to fourth order.
        let at = |h: f64| {
            let path = state.q.iter().zip(&state.v).zip(&a);
            let (q, v) = path
                .map(|((q, v), a)| (q + h * (v + 0.5 * h * a), v + h * a))
                .unzip();
            outputs(&tree, &State { t: state.t, q, v })
        };
        let h = 1e-3;
        let [two, one, back, far] = [2.0 * h, h, -h, -2.0 * h].map(at);
        let change = |k: usize| (8.0 * (one[k] - back[k]) - two[k] + far[k]) / (12.0 * h);
        let mut found = Vec::new();
        for body in (0..out.len()).step_by(width) {
            found.extend((width - velocities..width).map(|k| change(body + k)));
        }
        let mut wanted = Vec::new();
        for (q, a) in same.q.chunks(each).zip(expected.acceleration.chunks(each)) {
            match a {
                [x, y, z, e @ ..] if each == 7 => {
                    let conjugate = Quaternion::new(q[3], -q[4], -q[5], -q[6]);
                    let alpha =
                        (Quaternion::new(e[0], e[1], e[2], e[3]) * conjugate).vector() * 2.0;
                    wanted.extend([*x, *y, *z, alpha.x, alpha.y, alpha.z]);
                }
                _ => wanted.extend(a),
            }
        }
        let size = wanted.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        assert_all_close("accelerations", &found, &wanted, 1e-8 * size);
    }
}

#[test]
fn spatial_bodies_of_the_tree_move_as_those_with_coordinates_of_their_own() {
    check::<Turning, TurningOwn>(6 + 1 + 2 + 3, true);
    check::<Sliding, SlidingOwn>(6 + 2 + 1 + 1, true);
}

#[test]
fn planar_bodies_of_the_tree_move_as_those_with_coordinates_of_their_own() {
    check::<Flat, FlatOwn>(3 + 1 + 1 + 2, false);
}

#[test]
fn coordinates_of_joints_have_names() {
    assert_eq!(Turning::SPEC.coords[..7], TurningOwn::SPEC.coords[..7]);
    let joints = [
        "hinge.angle",
        "cross.first",
        "cross.second",
        "ball.e0",
        "ball.e1",
        "ball.e2",
        "ball.e3",
    ];
    assert_eq!(Turning::SPEC.coords[7..], joints);
    assert_eq!(
        (
            Turning::LINK_X[0],
            Turning::HINGE_ANGLE,
            Turning::CROSS_SECOND,
            Turning::BALL_E3
        ),
        (0, 7, 9, 13)
    );
    let rows: Vec<&str> = Turning::SPEC.constraints.iter().map(|c| c.name).collect();
    assert_eq!(rows, ["link[0].unit", "ball.unit"]);
}

/// An arm of 12 hinges as that of `tests::arm!`, from bodies: the section says whose the coordinates are.
macro_rules! arm {
    ($name:ident, $section:ident) => {
        ukcore::multibody! {
            pub $name {
                const N: usize = 12;
                let axis = [[0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
                bodies { spatial link[N] { mass: 1, inertia: [0.01, 0.03, 0.03], centre: [0.25, 0, 0] } }
                gravity { [0, 0, -9.81] }
                $section {
                    joint[0]: hinge(ground.at([0, 0, 0]), link[0].at([0, 0, 0]), axis[0])
                    for i in 1..N { joint[i]: hinge(link[i - 1].at([0.5, 0, 0]), link[i].at([0, 0, 0]), axis[i - 6 * (i / 6)]) }
                }
                output { for i in 0..N { centre[i] = link[i].centre, axes[i] = link[i].axes, velocity[i] = dot(link[i].centre), omega[i] = link[i].omega } }
            }
        }
    };
}

arm!(Arm, tree);
arm!(OwnArm, holonomic);

#[test]
fn an_arm_of_12_hinges_accelerates_alike_in_both_sets_of_coordinates() {
    let axes = [2, 1, 1, 0, 1, 2].map(|k| Vector3::<f64>::ith(k, 1.0));
    let angle = |i: usize| 0.4 * (1.3 * i as f64).sin();
    let state = at(
        &(0..12).map(angle).collect::<Vec<_>>(),
        &(0..12).map(|i| angle(i + 12)).collect::<Vec<_>>(),
    );
    assert_eq!(Arm::SPEC.coords.len(), 12);
    let mut a = vec![0.0; 12];
    let safe = Arm::default()
        .prepared()
        .acceleration(0.0, &state.q, &state.v, &mut a);
    assert!(safe > 0.5, "{safe}");
    let own = own_state(0.0, &outputs(Arm::default(), &state));
    let mut solver = Solver::new(OwnArm::default(), SolverOptions::default());
    let solution = solver.solve(0.0, &own.q, &own.v).expect("accelerations");
    assert_eq!(solution.degrees_of_freedom, 12);
    let (mut before, mut carried) = (Vector3::zeros(), Vector3::zeros());
    let mut found = Vec::new();
    let bodies = own.q.chunks(7).zip(own.v.chunks(7));
    for ((q, v), (link, a)) in bodies.zip(solution.acceleration.chunks(7).enumerate()) {
        let turn = |x: &[f64]| Quaternion::new(x[3], x[4], x[5], x[6]);
        let back = turn(q).conjugate();
        let (omega, alpha) = (
            (turn(v) * back).vector() * 2.0,
            (turn(a) * back).vector() * 2.0,
        );
        let axis = UnitQuaternion::new_unchecked(turn(q)) * axes[link % 6];
        // α of a link is that of the link before, what its joint adds, and the turning of the joint's axis.
        let own = omega - carried;
        found.push(axis.dot(&(alpha - before - carried.cross(&own))));
        (before, carried) = (alpha, omega);
    }
    assert_all_close("q̈", &found, &a, 1e-11 * tests::largest(&a));
}

ukcore::multibody! {
    /// The four-bar linkage of docs/planar.md: two bars hang on each other, one on the other support, and a pin closes the loop.
    FourBar {
        params { l[3] = [0.5, 2.0, 1.5], m = 1.0, span = 2.0, k = 3.0, g = 9.81 }
        bodies { for i in 0..3 { planar bar[i] { mass: m, inertia: m * sq(l[i]) / 12.0, centre: [l[i] / 2.0, 0] } } }
        gravity { [0, -g] }
        tree {
            o: pin(ground.at([0, 0]), bar[0].at([0, 0]))
            p: pin(bar[0].at([l[0], 0]), bar[1].at([0, 0]))
            r: pin(ground.at([span, 0]), bar[2].at([0, 0]))
        }
        holonomic { q: pin(bar[1].at([l[1], 0]), bar[2].at([l[2], 0])) }
        forces { turning_spring(bar[1], bar[2], k, 1.0) }
        output { tip = bar[1].at([1.0, 0.3]), push = dot(bar[1].at([1.0, 0.3])) }
        start open(crank = 1.0) { o.angle = crank; p.angle near -0.7; r.angle near 1.4 }
    }
}

#[test]
fn a_four_bar_closed_by_a_pin_runs_as_one_of_three_bodies() {
    fn run<M: Mechanism>() -> Vec<f64> {
        let start = M::default()
            .prepared()
            .start("open", &[("crank", 1.2)].into())
            .expect("a start");
        let run = Simulation::new(M::default())
            .tolerance(1e-11)
            .start(start)
            .every(0.1)
            .until(2.0)
            .expect("a run");
        assert!(run.energy_drift() < 1e-8, "{}", run.energy_drift());
        let rows = put_out::<M>(&run);
        rows.iter().flat_map(|row| row[..4].to_vec()).collect()
    }
    let (tree, own) = (run::<FourBar>(), run::<tests::FourBar>());
    assert_all_close("tip", &tree, &own, 1e-7);
}

ukcore::multibody! {
    /// Bricard's linkage by five angles, closed by the sixth hinge.
    Bricard {
        params { across = 1.01 / 12.0, along = 0.02 / 12.0, g = 9.81 }
        bodies {
            spatial r0 { mass: 1, inertia: [along, across, across], centre: [0.5, 0, 0] }
            spatial r1 { mass: 1, inertia: [across, along, across], centre: [0, -0.5, 0] }
            spatial r2 { mass: 1, inertia: [across, across, along], centre: [0, 0, 0.5] }
            spatial r3 { mass: 1, inertia: [along, across, across], centre: [-0.5, 0, 0] }
            spatial r4 { mass: 1, inertia: [across, along, across], centre: [0, 0.5, 0] }
        }
        gravity { [0, -g, 0] }
        tree {
            p0: hinge(ground.at([0, 0, 0]), r0.at([0, 0, 0]), [0, 1, 0])
            p1: hinge(r0.at([1, 0, 0]), r1.at([0, 0, 0]), [0, 0, 1])
            p2: hinge(r1.at([0, -1, 0]), r2.at([0, 0, 0]), [1, 0, 0])
            p3: hinge(r2.at([0, 0, 1]), r3.at([0, 0, 0]), [0, 1, 0])
            p4: hinge(r3.at([-1, 0, 0]), r4.at([0, 0, 0]), [0, 0, 1])
        }
        holonomic { p5: hinge(r4.at([0, 1, 0]), ground.at([0, 0, 1]), [1, 0, 0]) }
        output { p3_at = r3.at([0, 0, 0]) }
    }
}

/// Its relative angles follow sin a + sin b + sin a sin b = 0.
#[test]
fn bricards_linkage_by_angles_moves_with_a_row_to_spare() {
    let start = at_rest(&[0.0; 5]);
    let mut solver = Solver::new(Bricard::default(), SolverOptions::default());
    let solution = solver
        .solve(0.0, &start.q, &start.v)
        .expect("accelerations");
    assert_eq!(
        (solution.degrees_of_freedom, solution.redundant.len()),
        (1, 1)
    );
    let run = Simulation::new(Bricard::default())
        .tolerance(1e-9)
        .start(start)
        .every(0.25)
        .until(1.0)
        .expect("a run");
    assert!(run.energy_drift() < 1e-6);
    let mut moved = 0.0_f64;
    for sample in run.samples() {
        let (a, b, c) = (
            sample.q[Bricard::P0_ANGLE],
            sample.q[Bricard::P1_ANGLE],
            sample.q[Bricard::P2_ANGLE],
        );
        assert_close(
            "a law of the linkage",
            a.sin() + b.sin() + a.sin() * b.sin(),
            0.0,
            1e-8,
        );
        assert_close("equal angles", a.sin(), c.sin(), 1e-8);
        moved = moved.max(a.abs());
    }
    assert!(moved > 0.1, "{moved}");
}

ukcore::multibody! {
    /// A free body with two arms, one on a hinge and one on a spherical joint with a further link, and nothing that acts from outside.
    Floating {
        bodies {
            spatial base { mass: 3, inertia: [0.5, 0.6, 0.7] }
            for i in 0..3 { spatial arm[i] { mass: 1, inertia: [0.1, 0.12, 0.15], centre: [0.3, 0, 0.1] } }
        }
        tree {
            left: hinge(base.at([0.4, 0, 0]), arm[0].at([-0.2, 0, 0]), [0, 1, 1])
            right: ball(base.at([-0.4, 0.1, 0]), arm[1].at([0, 0.2, 0]))
            wrist: universal(arm[1].at([0.6, 0, 0]), arm[2].at([0, 0, 0]), [0, 1, 0], [0, 0, 1])
        }
        forces { spring(arm[0].at([0.5, 0, 0]), arm[2].at([0.5, 0, 0]), 4, 0.5) torque(base, arm[1], arm[1].along([0, 0, 0.3])) }
        let momentum = |b, m| m * dot(b.centre);
        let moment = |b, m, i| m * cross(b.centre, dot(b.centre)) + b.along([i[0] * b.spin[0], i[1] * b.spin[1], i[2] * b.spin[2]]);
        let limb = [0.1, 0.12, 0.15];
        output {
            momentum = momentum(base, 3) + momentum(arm[0], 1) + momentum(arm[1], 1) + momentum(arm[2], 1)
            moment = moment(base, 3, [0.5, 0.6, 0.7]) + moment(arm[0], 1, limb) + moment(arm[1], 1, limb) + moment(arm[2], 1, limb)
        }
    }
}

#[test]
fn momentum_of_floating_bodies_stays() {
    let start = random_state::<Floating>(&mut Random::new(3));
    let run = Simulation::new(Floating::default())
        .tolerance(1e-11)
        .start(start)
        .every(0.25)
        .until(2.0)
        .expect("a run");
    let all = put_out::<Floating>(&run);
    for out in &all[1..] {
        assert_all_close("momentum and its moment", out, &all[0], 1e-8);
    }
}

/// A body that hangs on a free one and is held by a joint, in a tree and with coordinates of its own.
macro_rules! held {
    ($($test:ident $tree:ident $own:ident $n:literal $kind:ident $inertia:tt { $($hangs:tt)* } { $($rows:tt)* } { $($rates:tt)* } $turned:tt $spatial:literal)*) => {$(
        ukcore::multibody! {
            pub $tree {
                const N: usize = $n;
                params { u[3] = [1.0, 2.0, -2.0], w[3] = [-0.5, 0.3, 1.0], d[2] = [0.6, 0.8], r = 0.4, lead = 0.3 }
                bodies { for i in 0..N { $kind link[i] { mass: 1 + i, inertia: $inertia } } }
                tree { $($hangs)* }
                holonomic { $($rows)* }
                nonholonomic { $($rates)* }
                force { link[0].x: 0.3 * (u[0] + w[0]) + d[0] * r * lead - 2.0 }
                output {
                    for i in 0..N { centre[i] = link[i].centre, turned[i] = link[i].$turned, velocity[i] = dot(link[i].centre), omega[i] = link[i].omega }
                    force = reaction(j)
                }
            }
        }

        ukcore::multibody! {
            pub $own {
                const N: usize = $n;
                params { u[3] = [1.0, 2.0, -2.0], w[3] = [-0.5, 0.3, 1.0], d[2] = [0.6, 0.8], r = 0.4, lead = 0.3 }
                bodies { for i in 0..N { $kind link[i] { mass: 1 + i, inertia: $inertia } } }
                holonomic { $($hangs)* $($rows)* }
                nonholonomic { $($rates)* }
                force { link[0].x: 0.3 * (u[0] + w[0]) + d[0] * r * lead - 2.0 }
                output { force = reaction(j) }
            }
        }

        #[test]
        fn $test() {
            let mut random = Random::new(41);
            let (own, width) = if $spatial { (own_state as fn(f64, &[f64]) -> State, 18) } else { (own_flat_state as _, 6) };
            let mut found = 0;
            for _ in 0..20 {
                let Ok(state) = assemble($tree::default(), &random_state::<$tree>(&mut random), &[]) else {
                    continue;
                };
                let out = outputs($tree::default(), &state);
                let (bodies, force) = out.split_at($n * width);
                let same = own(state.t, bodies);
                let expected = outputs($own::default(), &same);
                assert!(expected.iter().any(|x| x.abs() > 1e-3), "{expected:?}");
                assert_all_close("force", force, &expected, 1e-9);
                found += 1;
            }
            assert!(found > 10, "{found}");
        }
    )*};
}

held! {
    the_force_of_a_rod_on_a_body_that_the_first_hangs_on RodToRoot RodToRootOwn 3 planar 0.7
        { for i in 1..N { hang[i]: pin(link[i - 1].at([0.3, -0.2]), link[i].at([0.1, 0.4])) } }
        { j: rod(link[2].at([0.4, 0.2]), link[0].at([0.3, 0.5]), 1.2) } {} angle false
    the_force_of_rolling_on_a_body_of_the_tree HeldByRolls HeldByRollsOwn 2 spatial [0.5, 0.6, 0.7] { hang: ball(link[0].at(u), link[1].at([0.1, 0.4, -0.3])) }
        { k: disc(link[1].at([0.4, 0.2, 0.1]), u, r) } { j: rolls(link[1].at([0.4, 0.2, 0.1]), u, r) } axes true
    the_force_of_a_rod_on_a_body_of_the_tree HeldByRod HeldByRodOwn 2 planar 0.7 { hang: pin(link[0].at([0.3, -0.2]), link[1].at([0.1, 0.4])) }
        { j: rod(ground.at([0.3, 0.5]), link[1].at([0.4, 0.2]), 1.2) } {} angle false
    the_force_on_the_ground_of_a_rod_from_a_body_of_the_tree RodToGround RodToGroundOwn 2 planar 0.7 { hang: pin(link[0].at([0.3, -0.2]), link[1].at([0.1, 0.4])) }
        { j: rod(link[1].at([0.4, 0.2]), ground.at([0.3, 0.5]), 1.2) } {} angle false
    the_force_of_a_slot_on_a_body_of_the_tree HeldBySlot HeldBySlotOwn 2 planar 0.7 { hang: pin(link[0].at([0.3, -0.2]), link[1].at([0.1, 0.4])) }
        { j: slot(ground.at([0.3, 0.5]), link[1].at([0.4, 0.2]), d) } {} angle false
    the_force_of_a_slider_on_a_body_of_the_tree HeldBySlider HeldBySliderOwn 2 planar 0.7 { hang: pin(link[0].at([0.3, -0.2]), link[1].at([0.1, 0.4])) }
        { j: slider(ground.at([0.3, 0.5]), link[1].at([0.4, 0.2]), d) } {} angle false
    the_force_of_a_wheel_on_a_body_of_the_tree HeldByWheel HeldByWheelOwn 2 planar 0.7 { hang: pin(link[0].at([0.3, -0.2]), link[1].at([0.1, 0.4])) }
        { j: wheel(ground.at([0.3, 0.5]), link[1].at([0.4, 0.2]), d, r) } {} angle false
    the_force_of_a_rack_on_a_body_of_the_tree HeldByRack HeldByRackOwn 2 planar 0.7 { hang: pin(link[0].at([0.3, -0.2]), link[1].at([0.1, 0.4])) }
        { j: rack(ground.at([0.3, 0.5]), link[1].at([0.4, 0.2]), d, r) } {} angle false
    the_force_of_a_strut_on_a_body_of_the_tree HeldByStrut HeldByStrutOwn 2 spatial [0.5, 0.6, 0.7] { hang: ball(link[0].at(u), link[1].at([0.1, 0.4, -0.3])) }
        { j: rod(ground.at([0.3, 0.5, 0]), link[1].at([0.4, 0.2, 0.1]), 1.2) } {} axes true
    the_force_of_a_cylinder_on_a_body_of_the_tree HeldByCylinder HeldByCylinderOwn 2 spatial [0.5, 0.6, 0.7] { hang: ball(link[0].at(u), link[1].at([0.1, 0.4, -0.3])) }
        { j: cylinder(ground.at([0.3, 0.5, 0]), link[1].at([0.4, 0.2, 0.1]), u, w) } {} axes true
    the_force_of_a_guide_on_a_body_of_the_tree HeldByGuide HeldByGuideOwn 2 spatial [0.5, 0.6, 0.7] { hang: ball(link[0].at(u), link[1].at([0.1, 0.4, -0.3])) }
        { j: slider(ground.at([0.3, 0.5, 0]), link[1].at([0.4, 0.2, 0.1]), u) } {} axes true
    the_force_of_a_screw_on_a_body_of_the_tree HeldByScrew HeldByScrewOwn 2 spatial [0.5, 0.6, 0.7] { hang: ball(link[0].at(u), link[1].at([0.1, 0.4, -0.3])) }
        { k: cylinder(ground.at([0.3, 0.5, 0]), link[1].at([0.4, 0.2, 0.1]), u) } { j: screw(ground.at([0.3, 0.5, 0]), link[1].at([0.4, 0.2, 0.1]), u, lead) } axes true
    the_force_of_a_disc_on_a_body_of_the_tree HeldByDisc HeldByDiscOwn 2 spatial [0.5, 0.6, 0.7] { hang: ball(link[0].at(u), link[1].at([0.1, 0.4, -0.3])) }
        { j: disc(link[1].at([0.4, 0.2, 0.1]), u, r) } {} axes true
}
