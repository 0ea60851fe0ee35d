//! Mechanisms of the literature by bodies and joints, against their published results.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use tests::{assert_all_close, assert_close};
use ukcore::{Mechanism, Simulation, Solver, SolverOptions, State, assemble};

ukcore::multibody! {
    /// Andrews' squeezing mechanism: seven bodies, one degree of freedom, driven by a constant torque (Schiehlen, Multibody Systems
    /// Handbook 1990; Hairer & Wanner, Solving Ordinary Differential Equations II, VII.7). Bodies 1 to 7 are `k[0]` to `k[6]`.
    pub Andrews {
        params {
            m[7] = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498],
            i[7] = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5],
            a[2] = [-0.06934, -0.00227], b[2] = [-0.03635, 0.03273], c[2] = [0.014, 0.072], c0 = 4530.0, l0 = 0.07785,
            d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092, ss = 0.035, sa = 0.01874, sb = 0.01043, sc = 0.018,
            sd = 0.02, ta = 0.02308, tb = 0.00916, u = 0.04, ua = 0.01228, ub = 0.00449, zf = 0.02, zt = 0.04, fa = 0.01421, mom = 0.033,
        }
        let centre = [[ra, 0], [-da, 0], [sb, -sa], [0, ea - e], [ta, -tb], [zf - fa, 0], [ua, -ub]];
        bodies { for n in 0..7 { planar k[n] { mass: m[n], inertia: i[n], centre: centre[n] } } }
        let end = [k[1].at([-d, 0]), k[2].at([0, -ss]), k[3].at([0, -e]), k[5].at([zf, 0])];
        holonomic {
            o: pin(ground.at([0, 0]), k[0].at([0, 0]))
            f: pin(k[0].at([rr, 0]), k[1].at([0, 0]))
            b3: pin(ground.at(b), k[2].at([0, 0]))
            a5: pin(ground.at(a), k[4].at([0, 0]))
            h: pin(k[4].at([zt, 0]), k[3].at([0, 0]))
            a7: pin(ground.at(a), k[6].at([0, 0]))
            g: pin(k[6].at([0, -u]), k[5].at([0, 0]))
            for n in 1..4 { e0[n - 1]: end[n] - end[0] = 0 }
        }
        forces { spring(k[2].at([sd, -sc]), ground.at(c), c0, l0), torque(k[0], mom) }
    }
}

/// The angles of the seven bodies from (β, Θ, γ, Φ, δ, Ω, ε).
fn angles([beta, theta, gamma, phi, delta, omega, epsilon]: [f64; 7]) -> [f64; 7] {
    [
        beta,
        beta + theta,
        gamma,
        phi + delta,
        delta,
        omega + epsilon,
        epsilon,
    ]
}

#[test]
fn andrews_mechanism_is_where_the_literature_has_it() {
    let start = angles([
        -0.061_713_890_014_276_45,
        0.0,
        0.455_279_819_163_070_4,
        0.222_668_390_165_885_88,
        0.487_364_979_543_842_55,
        -0.222_668_390_165_885_87,
        1.230_547_444_549_821_2,
    ]);
    let mut guess = State {
        t: 0.0,
        q: vec![0.0; 21],
        v: vec![0.0; 21],
    };
    let mut held = Vec::new();
    for (place, angle) in Andrews::K_ANGLE.into_iter().zip(start) {
        guess.q[place] = angle;
        held.push(Andrews::SPEC.coords[place]);
    }
    let state = assemble(Andrews::default(), guess, &held).expect("a start");
    let solution = Solver::new(Andrews::default(), SolverOptions::default())
        .solve(0.0, &state.q, &state.v)
        .expect("accelerations");
    assert_eq!(solution.degrees_of_freedom, 1);
    let [crank, rod] = [0, 1].map(|k| solution.acceleration[Andrews::K_ANGLE[k]]);
    assert_close("β̈", crank, 14_222.443_919_954_114, 1e-5);
    assert_close("Θ̈", rod - crank, -10_666.832_939_965_586, 1e-5);
    let run = Simulation::new(Andrews::default())
        .tolerance(1e-12)
        .start(state)
        .until(0.03)
        .expect("a run");
    let expected = angles([
        15.810_771_195_153_707,
        -15.756_371_058_411_839,
        0.040_822_240_119_645_8,
        -0.534_730_116_342_079_6,
        0.524_409_965_879_954_1,
        0.534_730_116_342_079_6,
        1.048_080_741_041_938,
    ]);
    let last = run.last().expect("the end");
    let found = Andrews::K_ANGLE.map(|place| last.q[place]);
    assert_all_close("angles at 0.03 s", &found, &expected, 1e-10);
}

ukcore::multibody! {
    /// The heavy top of Brüls, Cardona & Arnold: fast spin about y, centre of mass at (0, 1, 0) from the fixed point.
    pub HeavyTop {
        params { m = 15.0, g = 9.81 }
        bodies { spatial top { mass: m, inertia: [0.234375, 0.46875, 0.234375], centre: [0, 1, 0] } }
        gravity { [0, 0, -g] }
        holonomic { foot: ball(ground.at([0, 0, 0]), top.at([0, 0, 0])) }
    }
}

#[test]
fn heavy_top_turns_as_the_literature_says() {
    // At the unit quaternion 1 ω = 2 ė, and the velocity of the centre is ω × (0, 1, 0).
    let omega = [0.0, 150.0, -4.61538];
    let mut start = State {
        t: 0.0,
        q: vec![0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        v: vec![0.0; 7],
    };
    (start.v[0], start.v[2]) = (-omega[2], omega[0]);
    for (rate, omega) in start.v[4..].iter_mut().zip(omega) {
        *rate = 0.5 * omega;
    }
    let run = Simulation::new(HeavyTop::default())
        .tolerance(1e-11)
        .start(start)
        .until(0.2)
        .expect("a run");
    let last = run.last().expect("the end");
    assert_all_close(
        "quaternion at 0.2 s",
        &last.q[3..],
        &[-0.70828, 0.43878, 0.54573, 0.0894],
        1e-5,
    );
    assert!(run.energy_drift() < 1e-8 * run.energy()[0].total());
}

ukcore::multibody! {
    /// Bricard's linkage (IFToMM benchmark A04): five rods of 1 m and 1 kg, six hinges; by count it cannot move.
    pub Bricard {
        params { across = 1.01 / 12.0, along = 0.02 / 12.0, g = 9.81 }
        bodies {
            spatial r0 { mass: 1, inertia: [along, across, across], centre: [0.5, 0, 0] }
            spatial r1 { mass: 1, inertia: [across, along, across], centre: [0, -0.5, 0] }
            spatial r2 { mass: 1, inertia: [across, across, along], centre: [0, 0, 0.5] }
            spatial r3 { mass: 1, inertia: [along, across, across], centre: [-0.5, 0, 0] }
            spatial r4 { mass: 1, inertia: [across, along, across], centre: [0, 0.5, 0] }
        }
        gravity { [0, -g, 0] }
        holonomic {
            p0: hinge(ground.at([0, 0, 0]), r0.at([0, 0, 0]), [0, 1, 0])
            p1: hinge(r0.at([1, 0, 0]), r1.at([0, 0, 0]), [0, 0, 1])
            p2: hinge(r1.at([0, -1, 0]), r2.at([0, 0, 0]), [1, 0, 0])
            p3: hinge(r2.at([0, 0, 1]), r3.at([0, 0, 0]), [0, 1, 0])
            p4: hinge(r3.at([-1, 0, 0]), r4.at([0, 0, 0]), [0, 0, 1])
            p5: hinge(r4.at([0, 1, 0]), ground.at([0, 0, 1]), [1, 0, 0])
        }
        output { p3_at = r3.at([0, 0, 0]) }
    }
}

#[test]
fn bricards_linkage_moves_with_a_row_to_spare() {
    let centres = [
        [0.5, 0.0, 0.0],
        [1.0, -0.5, 0.0],
        [1.0, -1.0, 0.5],
        [0.5, -1.0, 1.0],
        [0.0, -0.5, 1.0],
    ];
    let mut start = State {
        t: 0.0,
        q: vec![0.0; 35],
        v: vec![0.0; 35],
    };
    for (body, centre) in centres.into_iter().enumerate() {
        start.q[7 * body..7 * body + 3].copy_from_slice(&centre);
        start.q[7 * body + 3] = 1.0;
    }
    let mut solver = Solver::new(Bricard::default(), SolverOptions::default());
    let solution = solver
        .solve(0.0, &start.q, &start.v)
        .expect("accelerations");
    assert_eq!(
        (solution.degrees_of_freedom, solution.redundant.len()),
        (1, 1)
    );
    let run = Simulation::new(Bricard::default())
        .tolerance(1e-8)
        .start(start)
        .every(0.25)
        .until(1.0)
        .expect("a run");
    assert!(run.energy_drift() < 1e-6);
    for sample in run.samples() {
        // Relative angles (a, b, a, b, a) with sin a + sin b + sin a sin b = 0.
        let turn = |body: usize| {
            let e = &sample.q[7 * body + 3..7 * body + 7];
            UnitQuaternion::new_normalize(Quaternion::new(e[0], e[1], e[2], e[3]))
        };
        let about = |turn: UnitQuaternion<f64>, axis: Vector3<f64>| {
            2.0 * turn.imag().dot(&axis).atan2(turn.w)
        };
        let a = about(turn(0), Vector3::y());
        let b = about(turn(0).inverse() * turn(1), Vector3::z());
        let c = about(turn(1).inverse() * turn(2), Vector3::x());
        assert_close(
            "a law of the linkage",
            a.sin() + b.sin() + a.sin() * b.sin(),
            0.0,
            1e-9,
        );
        assert_close("equal angles", a.sin(), c.sin(), 1e-9);
    }
}

ukcore::multibody! {
    /// A serial arm of six hinges about z, y, y, x, y, z, links of 0.5 m along x.
    pub Arm {
        const N: usize = 6;
        let axis = [[0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
        bodies { spatial link[N] { mass: 1, inertia: [0.01, 0.03, 0.03], centre: [0.25, 0, 0] } }
        gravity { [0, 0, -9.81] }
        holonomic {
            base: hinge(ground.at([0, 0, 0]), link[0].at([0, 0, 0]), axis[0])
            for i in 1..N { joint[i - 1]: hinge(link[i - 1].at([0.5, 0, 0]), link[i].at([0, 0, 0]), axis[i]) }
        }
    }
}

/// q̈ of the joint angles as an articulated-body library (Pinocchio 4.1) gives it.
#[test]
fn accelerations_of_an_arm_are_those_of_its_joints() {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let axes = [z, y, y, x, y, z];
    let expected = [
        -0.226_082_528_672_934_5,
        22.873_151_785_849_11,
        -26.051_230_188_451_06,
        -0.182_111_134_019_642_4,
        5.580_395_585_970_376,
        2.076_642_635_644_206,
    ];
    let mut state = State {
        t: 0.0,
        q: Vec::new(),
        v: Vec::new(),
    };
    let (mut turn, mut omega) = (UnitQuaternion::identity(), Vector3::zeros());
    let (mut place, mut velocity) = (Vector3::zeros(), Vector3::zeros());
    let (mut directions, mut omegas) = (Vec::new(), Vec::new());
    for (axis, i) in axes.into_iter().zip(0_i32..) {
        let angle = -0.5 + 0.2 * f64::from(i);
        turn *= UnitQuaternion::from_scaled_axis(axis * angle);
        omega += turn * axis * angle;
        directions.push(turn * axis);
        omegas.push(omega);
        let half = turn * (x * 0.25);
        let (centre, moves) = (place + half, velocity + omega.cross(&half));
        let (rate, e) = (
            Quaternion::from_imag(omega) * turn.into_inner() * 0.5,
            turn.imag(),
        );
        state
            .q
            .extend([centre.x, centre.y, centre.z, turn.w, e.x, e.y, e.z]);
        state
            .v
            .extend([moves.x, moves.y, moves.z, rate.w, rate.i, rate.j, rate.k]);
        (place, velocity) = (place + 2.0 * half, velocity + 2.0 * omega.cross(&half));
    }
    let mut solver = Solver::new(Arm::default(), SolverOptions::default());
    let solution = solver
        .solve(0.0, &state.q, &state.v)
        .expect("accelerations");
    assert_eq!(solution.degrees_of_freedom, 6);
    let (mut before, mut carried) = (Vector3::zeros(), Vector3::zeros());
    for link in 0..6 {
        let (q, a) = (&state.q[7 * link..], &solution.acceleration[7 * link..]);
        let conjugate = Quaternion::new(q[3], -q[4], -q[5], -q[6]);
        let alpha = (Quaternion::new(a[3], a[4], a[5], a[6]) * conjugate).vector() * 2.0;
        // α of a link is that of the link before, what its joint adds, and the turning of the joint's axis.
        let own = omegas[link] - carried;
        let joint = alpha - before - carried.cross(&own);
        assert_close("q̈", directions[link].dot(&joint), expected[link], 1e-9);
        (before, carried) = (alpha, omegas[link]);
    }
}
