//! Joints between bodies: rows against rotations of another making, degrees of freedom by hand, reactions by Newton and Euler.

use nalgebra::{Matrix3, Quaternion, Rotation2, UnitQuaternion, Vector2, Vector3};
use tests::{Random, assert_all_close, assert_close, at, at_rest, outputs, rates, residuals};
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Solution, Solver, State, assemble};

const P: [f64; 3] = [0.3, -0.2, 0.5];
const R: [f64; 3] = [0.1, 0.4, -0.3];
const U: [f64; 3] = [1.0, 2.0, -2.0];
const W: [f64; 3] = [-0.5, 0.3, 1.0];
const CENTRE: [f64; 3] = [0.2, 0.1, -0.1];

ukcore::multibody! {
    /// Two bodies in space with every joint between them, which no motion satisfies: rows are what is looked at.
    #[allow(dead_code)]
    pub Joints {
        params {
            p[3] = [0.3, -0.2, 0.5], r[3] = [0.1, 0.4, -0.3], u[3] = [1.0, 2.0, -2.0], w[3] = [-0.5, 0.3, 1.0], l = 0.7, turned = 0.4,
        }
        bodies {
            spatial a { mass: 1, inertia: [1, 1.2, 1.4], centre: [0.2, 0.1, -0.1] }
            spatial b { mass: 2, inertia: [2, 2.2, 2.4, 0.1, -0.2, 0.3] }
        }
        holonomic {
            ball: ball(a.at(p), b.at(r))
            rod: rod(a.at(r), b.at(p), l)
            hinge: hinge(a.at(2 * p), b.at(r), u, w)
            universal: universal(a.at(3 * p), b.at(r), u, w)
            cylinder: cylinder(a.at(p), b.at(2 * r), w, u)
            slider: slider(a.at(p), b.at(r), w, rotx(turned))
            weld: weld(a.at(4 * p), b.at(r), rotz(turned) * roty(0.3))
            drive: drive(a, b, u, 2 * t)
            disc: disc(b.at(r), u, l)
        }
        nonholonomic {
            screw: screw(a.at(p), b.at(r), u, l)
            rolls: rolls(b.at(r), u, l)
        }
        output { axes = b.axes, omega = b.omega, spin = b.spin, front = a.along(u) }
    }
}

/// A body in space: its centre of mass and its orientation, with their rates.
struct Pose {
    place: Vector3<f64>,
    turn: UnitQuaternion<f64>,
    velocity: Vector3<f64>,
    /// In axes of the ground.
    omega: Vector3<f64>,
    centre: Vector3<f64>,
}

impl Pose {
    fn of(q: &[f64], v: &[f64], centre: [f64; 3]) -> Self {
        let turn = UnitQuaternion::new_unchecked(Quaternion::new(q[3], q[4], q[5], q[6]));
        let rate = Quaternion::new(v[3], v[4], v[5], v[6]);
        Pose {
            place: Vector3::new(q[0], q[1], q[2]),
            turn,
            velocity: Vector3::new(v[0], v[1], v[2]),
            omega: (rate * turn.conjugate().into_inner()).vector() * 2.0,
            centre: Vector3::from(centre),
        }
    }
    fn at(&self, p: Vector3<f64>) -> Vector3<f64> {
        self.place + self.turn * (p - self.centre)
    }
    fn moves(&self, p: Vector3<f64>) -> Vector3<f64> {
        self.velocity + self.omega.cross(&(self.turn * (p - self.centre)))
    }
}

pub(crate) fn random_state<M: Mechanism>(random: &mut Random) -> State {
    let state = random.turned(M::SPEC);
    State {
        t: random.signed(),
        ..state
    }
}

#[test]
fn rows_of_spatial_joints_are_those_of_rotations() {
    let mut random = Random::new(5);
    for _ in 0..50 {
        let state = random_state::<Joints>(&mut random);
        let mechanism: ukcore::Prepared = Joints::default().prepared();
        let phi = residuals(&mechanism, state.t, &state.q);
        let rate = rates(&mechanism, state.t, &state.q, &state.v);
        let a = Pose::of(&state.q[..7], &state.v[..7], CENTRE);
        let b = Pose::of(&state.q[7..], &state.v[7..], [0.0; 3]);
        let [p, r, u, w] = [P, R, U, W].map(Vector3::from);
        let row = |row: usize| phi[row];
        let rows = |rows: &[usize]| -> Vec<f64> { rows.iter().map(|i| phi[*i]).collect() };
        let close = |what: &str, found: &[f64], expected: &[f64]| {
            assert_all_close(what, found, expected, 1e-13)
        };

        close(
            "units",
            &rows(&[Joints::A_UNIT, Joints::B_UNIT]),
            &[0.0, 0.0],
        );
        close("ball", &rows(&Joints::BALL), (b.at(r) - a.at(p)).as_slice());
        let length = (b.at(p) - a.at(r)).norm_squared();
        assert_close("rod", row(Joints::ROD), length - 0.49, 1e-13);

        // Two rows at right angles to u measure how far w is from it: their squares add up to sin².
        let squares = |two: &[usize]| two.iter().map(|i| phi[*i].powi(2)).sum::<f64>();
        let sine =
            |x: Vector3<f64>, y: Vector3<f64>| x.normalize().cross(&y.normalize()).norm_squared();
        let (axis, other) = (a.turn * u, b.turn * w);
        close(
            "hinge",
            &rows(&Joints::HINGE[..3]),
            (b.at(r) - a.at(2.0 * p)).as_slice(),
        );
        assert_close(
            "axes of the hinge",
            squares(&Joints::HINGE[3..]),
            sine(axis, other),
            1e-13,
        );
        let across = axis.normalize().dot(&other.normalize());
        assert_close("universal", row(Joints::UNIVERSAL[3]), across, 1e-13);
        let off = b.at(2.0 * r) - a.at(p);
        let (axis, other) = (a.turn * w, b.turn * u);
        let beside = off.norm_squared() - off.dot(&axis.normalize()).powi(2);
        assert_close(
            "place of the cylinder",
            squares(&Joints::CYLINDER[..2]),
            beside,
            1e-12,
        );
        assert_close(
            "axes of the cylinder",
            squares(&Joints::CYLINDER[2..]),
            sine(axis, other),
            1e-13,
        );
        let (off, axis) = (b.at(r) - a.at(p), (a.turn * w).normalize());
        let beside = off.norm_squared() - off.dot(&axis).powi(2);
        assert_close(
            "place of the slider",
            squares(&Joints::SLIDER[..2]),
            beside,
            1e-12,
        );

        // Of the matrix that turns the first body's axes to where the second's should be in them: entries above the diagonal.
        let fixed = |turn: UnitQuaternion<f64>| {
            let m: Matrix3<f64> = *(a.turn.inverse() * b.turn * turn.inverse())
                .to_rotation_matrix()
                .matrix();
            [m[(0, 1)], m[(1, 2)], m[(2, 0)]]
        };
        let about = |axis: Vector3<f64>, angle: f64| UnitQuaternion::from_scaled_axis(axis * angle);
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        close("slider", &rows(&Joints::SLIDER[2..]), &fixed(about(x, 0.4)));
        close(
            "weld",
            &rows(&Joints::WELD[3..]),
            &fixed(about(z, 0.4) * about(y, 0.3)),
        );

        let (axis, own) = (a.turn * u.normalize(), b.turn * u.normalize());
        let apart = b.moves(r) - a.moves(p) - a.omega.cross(&(b.at(r) - a.at(p)));
        let screwed =
            axis.dot(&apart) - 0.7 / std::f64::consts::TAU * axis.dot(&(b.omega - a.omega));
        assert_close("screw", rate[Joints::SCREW], screwed, 1e-12);

        // The lowest point of the rim, by trial.
        let side = own.cross(&z).normalize();
        let down = own.cross(&side).normalize();
        let down = if down.z > 0.0 { -down } else { down };
        let touch = b.at(r) + 0.7 * down;
        assert_close("disc", row(Joints::DISC), touch.z, 1e-13);
        let slip = b.moves(r) + b.omega.cross(&(touch - b.at(r)));
        close("rolls", &Joints::ROLLS.map(|i| rate[i]), &[slip.x, slip.y]);

        let outputs = outputs(&mechanism, &state);
        let outputs =
            |places: &[usize]| -> Vec<f64> { places.iter().map(|i| outputs[*i]).collect() };
        let matrix = b.turn.to_rotation_matrix().matrix().transpose();
        close(
            "axes",
            &outputs(Joints::OUT_AXES.as_flattened()),
            matrix.as_slice(),
        );
        close("omega", &outputs(&Joints::OUT_OMEGA), b.omega.as_slice());
        close(
            "spin",
            &outputs(&Joints::OUT_SPIN),
            (b.turn.inverse() * b.omega).as_slice(),
        );
        close(
            "along",
            &outputs(&Joints::OUT_FRONT),
            (a.turn * u).as_slice(),
        );
    }
}

ukcore::multibody! {
    /// Two bodies in the plane with every joint between them.
    #[allow(dead_code)]
    pub Flat {
        params { p[2] = [0.3, -0.2], r[2] = [0.1, 0.4], d[2] = [3.0, -4.0], l = 0.7, turned = 0.4 }
        bodies { planar a { mass: 1, inertia: 1, centre: [0.2, 0.1] } planar b { mass: 2, inertia: 2 } }
        holonomic {
            pin: pin(a.at(p), b.at(r))
            weld: weld(a.at(2 * p), b.at(r), turned)
            slider: slider(a.at(p), b.at(r), d, 2 * turned)
            slot: slot(a.at(2 * p), b.at(r), d)
            wheel: wheel(a.at(3 * p), b.at(r), d, l)
            rack: rack(a.at(p), b.at(2 * r), d, l)
            gear: gear(a, b, l, turned)
            motor: turn(a, b) = sin(2 * t)
            rod: rod(a.at(p), b.at(r), l)
        }
    }
}

#[test]
fn rows_of_planar_joints_are_those_of_rotations() {
    let mut random = Random::new(8);
    let mechanism: ukcore::Prepared = Flat::default().prepared();
    for _ in 0..50 {
        let (t, q) = (random.signed(), random.vector(6));
        let phi = residuals(&mechanism, t, &q);
        let (p, r, d) = (
            Vector2::new(0.3, -0.2),
            Vector2::new(0.1, 0.4),
            Vector2::new(0.6, -0.8),
        );
        let (turn_a, turn_b) = (Rotation2::new(q[2]), Rotation2::new(q[5]));
        let a = |p: Vector2<f64>| Vector2::new(q[0], q[1]) + turn_a * (p - Vector2::new(0.2, 0.1));
        let b = |r: Vector2<f64>| Vector2::new(q[3], q[4]) + turn_b * r;
        let close = |what: &str, rows: &[usize], expected: &[f64]| {
            let found: Vec<f64> = rows.iter().map(|i| phi[*i]).collect();
            assert_all_close(what, &found, expected, 1e-14);
        };
        // In axes of the line: along it, and to its left.
        let seen = |v: Vector2<f64>| {
            let along = turn_a * d;
            (along.dot(&v), along.perp(&v))
        };
        let relative = q[5] - q[2];
        close("pin", &Flat::PIN, (b(r) - a(p)).as_slice());
        let off = b(r) - a(2.0 * p);
        close("weld", &Flat::WELD, &[off.x, off.y, relative - 0.4]);
        close(
            "slider",
            &Flat::SLIDER,
            &[seen(b(r) - a(p)).1, relative - 0.8],
        );
        close("slot", &[Flat::SLOT], &[seen(off).1]);
        let (along, left) = seen(b(r) - a(3.0 * p));
        close("wheel", &Flat::WHEEL, &[left - 0.7, along + 0.7 * relative]);
        close(
            "rack",
            &[Flat::RACK],
            &[seen(b(2.0 * r) - a(p)).0 + 0.7 * relative],
        );
        close("gear", &[Flat::GEAR], &[0.7 * q[2] + 0.4 * q[5]]);
        close("motor", &[Flat::MOTOR], &[relative - (2.0 * t).sin()]);
        close("rod", &[Flat::ROD], &[(b(r) - a(p)).norm_squared() - 0.49]);
    }
}

#[test]
fn a_driven_body_turns_by_the_angle_about_the_axis() {
    let mechanism: ukcore::Prepared = Joints::default().prepared();
    let mut phi = vec![0.0; Joints::SPEC.holonomic];
    for t in [0.0, 0.4, 3.0, 40.0] {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::from(U).normalize() * (2.0 * t));
        let i = turn.imag();
        let mut q = vec![0.0; 14];
        q[3] = 1.0;
        (q[10], q[11], q[12], q[13]) = (turn.w, i.x, i.y, i.z);
        mechanism.residual(t, &q, &mut phi);
        assert_close("driven", phi[Joints::DRIVE], 0.0, 1e-13);
        mechanism.residual(t + 0.1, &q, &mut phi);
        assert_close("behind", phi[Joints::DRIVE].abs(), 0.2_f64.sin(), 1e-13);
    }
}

/// T by its own making: ½ m v² + ½ ωᵀJω, of the second body.
#[test]
fn kinetic_energy_is_that_of_a_rigid_body() {
    let mut random = Random::new(6);
    for _ in 0..20 {
        let state = random_state::<Joints>(&mut random);
        let mechanism: ukcore::Prepared = Joints::default().prepared();
        let energy = mechanism.energy(state.t, &state.q, &state.v);
        let (a, b) = (
            Pose::of(&state.q[..7], &state.v[..7], CENTRE),
            Pose::of(&state.q[7..], &state.v[7..], [0.0; 3]),
        );
        let inertias = [
            Matrix3::from_diagonal(&Vector3::new(1.0, 1.2, 1.4)),
            Matrix3::new(2.0, 0.1, -0.2, 0.1, 2.2, 0.3, -0.2, 0.3, 2.4),
        ];
        let energies =
            [(a, 1.0), (b, 2.0)]
                .into_iter()
                .zip(inertias)
                .map(|((body, mass), inertia)| {
                    let spin = body.turn.inverse() * body.omega;
                    0.5 * mass * body.velocity.norm_squared() + 0.5 * spin.dot(&(inertia * spin))
                });
        assert_close("T", energy.kinetic, energies.sum(), 1e-12);
    }
}

/// Bodies that one joint, or what belongs to it, holds to the ground.
macro_rules! held {
    ($($name:ident [$($body:tt)*] [$($sections:tt)*];)*) => {
        $(ukcore::multibody! {
            $name {
                bodies { $($body)* }
                $($sections)*
            }
        })*
    };
}

held! {
    Pin [planar a { mass: 2, inertia: 1, centre: [0.1, 0.2] }] [gravity { [0, -9.81] } holonomic { j: pin(ground.at([0, 0]), a.at([0, 0])) }];
    Weld [planar a { mass: 2, inertia: 1, centre: [0.1, 0.2] }] [holonomic { j: weld(ground.at([0, 0]), a.at([0, 0])) }];
    Slider [planar a { mass: 2, inertia: 1, centre: [0.1, 0.2] }] [holonomic { j: slider(ground.at([0, 0]), a.at([0, 0]), [1, 2]) }];
    Slot [planar a { mass: 2, inertia: 1, centre: [0.1, 0.2] }] [holonomic { j: slot(ground.at([0, 0]), a.at([0, 0]), [1, 2]) }];
    Wheel [planar a { mass: 2, inertia: 1 }] [gravity { [9.81, 0] } holonomic { j: wheel(ground.at([0, 0]), a.at([0, 0]), [1, 0], 0.5) }];
    Rod [planar a { mass: 2, inertia: 1, centre: [0.1, 0.2] }] [holonomic { j: rod(ground.at([0, 1]), a.at([0, 0]), 1) }];
    Rack [planar a { mass: 2, inertia: 1 }] [holonomic { j: rack(ground.at([0, 0]), a.at([0, 0]), [1, 0], 0.5) }];
    Gear [planar a { mass: 2, inertia: 1 } planar b { mass: 2, inertia: 1 }]
        [holonomic { i: pin(ground.at([0, 0]), a.at([0, 0])), j: pin(ground.at([3, 0]), b.at([0, 0])), teeth: gear(a, b, 1, 2) }];
    Motor [planar a { mass: 2, inertia: 1 }] [holonomic { j: pin(ground.at([0, 0]), a.at([0, 0])), motor: turn(ground, a) = sin(t) }];
    Ball [spatial a { mass: 2, inertia: [1, 1.5, 2], centre: [0.1, 0.2, 0] }] [holonomic { j: ball(ground.at([0, 0, 0]), a.at([0, 0, 0])) }];
    Hinge [spatial a { mass: 2, inertia: [1, 1.5, 2, 0.1, 0, 0.2], centre: [0.1, 0.2, 0] }]
        [gravity { [0, 0, -9.81] } holonomic { j: hinge(ground.at([0, 0, 0]), a.at([0, 0, 0]), [1, 1, 0.5]) }];
    Driven [spatial a { mass: 2, inertia: [1, 1.5, 2], centre: [0.1, 0.2, 0] }]
        [holonomic { j: hinge(ground.at([0, 0, 0]), a.at([0, 0, 0]), [0, 0, 1]), motor: drive(ground, a, [0, 0, 1], 10 * t) }];
    Universal [spatial a { mass: 2, inertia: [1, 1.5, 2], centre: [0.1, 0.2, 0] }]
        [holonomic { j: universal(ground.at([0, 0, 0]), a.at([0, 0, 0]), [1, 0, 0], [0, 1, 0]) }];
    Cylinder [spatial a { mass: 2, inertia: [1, 1.5, 2], centre: [0.1, 0.2, 0] }]
        [holonomic { j: cylinder(ground.at([0, 0, 0]), a.at([0, 0, 0]), [1, 1, 0]) }];
    Prismatic [spatial a { mass: 2, inertia: [1, 1.5, 2], centre: [0.1, 0.2, 0] }]
        [holonomic { j: slider(ground.at([0, 0, 0]), a.at([0, 0, 0]), [1, 1, 0]) }];
    Fixed [spatial a { mass: 2, inertia: [1, 1.5, 2], centre: [0.1, 0.2, 0] }] [holonomic { j: weld(ground.at([0, 0, 0]), a.at([0, 0, 0])) }];
    Strut [spatial a { mass: 2, inertia: [1, 1.5, 2], centre: [0.1, 0.2, 0] }] [holonomic { j: rod(ground.at([0, 0, 1]), a.at([0, 0, 0]), 1) }];
    Screw [spatial a { mass: 2, inertia: [1, 1.5, 2] }] [
        gravity { [0, 0, -9.81] }
        holonomic { j: cylinder(ground.at([0, 0, 0]), a.at([0, 0, 0]), [0, 0, 1]) }
        nonholonomic { thread: screw(ground.at([0, 0, 0]), a.at([0, 0, 0]), [0, 0, 1], 3.0) }
    ];
    Disc [spatial a { mass: 1, inertia: [0.0625, 0.125, 0.0625] }] [
        gravity { [0, 0, -9.81] }
        holonomic { touches: disc(a.at([0, 0, 0]), [0, 1, 0], 0.5) }
        nonholonomic { rolls: rolls(a.at([0, 0, 0]), [0, 1, 0], 0.5) }
    ];
}

/// The mechanism near the place where the frames of body and ground agree, its centre of mass moved by `off`.
fn placed<M: Mechanism>(off: [f64; 2]) -> State {
    let n = M::SPEC.coords.len();
    let mut guess = at_rest(&vec![0.0; n]);
    guess.q[..2].copy_from_slice(&off);
    if n == 7 {
        (guess.q[2], guess.q[3]) = (0.4, 1.0);
    }
    assemble(M::default(), &guess, &[]).expect("a start")
}

pub(crate) fn solved<M: Mechanism>(state: &State) -> Solution {
    let mut solver = Solver::new(M::default(), SolverOptions::default());
    solver
        .solve(state.t, &state.q, &state.v)
        .expect("accelerations")
}

#[test]
fn degrees_of_freedom_are_those_counted_by_hand() {
    fn check<M: Mechanism>(expected: usize) {
        let solution = solved::<M>(&placed::<M>([0.1, 0.4]));
        let name = M::SPEC.name;
        assert_eq!(solution.degrees_of_freedom, expected, "{name}");
        assert!(solution.redundant.is_empty(), "{name}");
    }
    check::<Pin>(1);
    check::<Weld>(0);
    check::<Slider>(1);
    check::<Slot>(2);
    check::<Wheel>(1);
    check::<Rod>(2);
    check::<Rack>(2);
    check::<Gear>(1);
    check::<Motor>(0);
    check::<Ball>(3);
    check::<Hinge>(1);
    check::<Driven>(0);
    check::<Universal>(2);
    check::<Cylinder>(2);
    check::<Prismatic>(1);
    check::<Fixed>(0);
    check::<Strut>(5);
    check::<Screw>(1);
    check::<Disc>(3);
}

ukcore::multibody! {
    /// A four-bar linkage of hinges with parallel axes: in space 20 rows on 18 freedoms, and yet it moves.
    Loop {
        params { l[3] = [0.5, 2.0, 1.5], span = 2.0, axis[3] = [0.0, 0.0, 1.0] }
        bodies { for i in 0..3 { spatial bar[i] { mass: 1, inertia: [0.01, 0.2, 0.2], centre: [l[i] / 2, 0, 0] } } }
        holonomic {
            o: hinge(ground.at([0, 0, 0]), bar[0].at([0, 0, 0]), axis)
            p: hinge(bar[0].at([l[0], 0, 0]), bar[1].at([0, 0, 0]), axis)
            q: hinge(bar[1].at([l[1], 0, 0]), bar[2].at([l[2], 0, 0]), axis)
            r: hinge(ground.at([span, 0, 0]), bar[2].at([0, 0, 0]), axis)
        }
        start open {
            bar[0].e0 near cos(0.5); bar[0].e3 near sin(0.5); bar[1].e0 near cos(0.15); bar[1].e3 near sin(0.15);
            bar[2].e0 near cos(0.7); bar[2].e3 near sin(0.7)
        }
    }
}

/// Three rows say again that the loop closes along the axes and that these are parallel; those in the plane are none of them.
#[test]
fn a_loop_in_space_names_what_is_redundant() {
    let start = Loop::default().start("open", &[].into()).expect("a start");
    let solution = solved::<Loop>(&start);
    assert_eq!(solution.degrees_of_freedom, 1);
    let names = solution
        .redundant
        .iter()
        .map(|c| Loop::SPEC.constraints[*c].name);
    let names: Vec<&str> = names.collect();
    assert_eq!(names.len(), 3, "{names:?}");
    for name in names {
        let (joint, row) = name.split_once('.').expect("a row of a joint");
        assert!("opqr".contains(joint), "{name}");
        assert!(["z", "tilt0", "tilt1"].contains(&row), "{name}");
    }
}

/// m a = λ + m g and J α = arm × λ: the multipliers of a pin are the force on its second body, in axes of the ground.
#[test]
fn reaction_of_a_pin_is_that_of_newton_and_euler() {
    let mut random = Random::new(9);
    for _ in 0..10 {
        let (angle, rate) = (3.0 * random.signed(), 2.0 * random.signed());
        let arm = Rotation2::new(angle) * Vector2::new(0.1, 0.2);
        let velocity = rate * Vector2::new(-arm.y, arm.x);
        let state = at(&[arm.x, arm.y, angle], &[velocity.x, velocity.y, rate]);
        let solution = solved::<Pin>(&state);
        let force = Vector2::new(
            solution.multipliers[Pin::J[0]],
            solution.multipliers[Pin::J[1]],
        );
        // About the pin: (J + m d²) α = −m g x.
        let alpha = -2.0 * 9.81 * arm.x / (1.0 + 2.0 * arm.norm_squared());
        let acceleration = alpha * Vector2::new(-arm.y, arm.x) - rate * rate * arm;
        let expected = 2.0 * (acceleration + Vector2::new(0.0, 9.81));
        assert_close("α", solution.acceleration[2], alpha, 1e-12);
        assert_all_close("reaction", force.as_slice(), expected.as_slice(), 1e-11);
    }
}

#[test]
fn reaction_of_a_hinge_is_that_of_newton_and_euler() {
    let mut random = Random::new(10);
    let inertia = Matrix3::new(1.0, 0.1, 0.0, 0.1, 1.5, 0.2, 0.0, 0.2, 2.0);
    let (axis, centre) = (Vector3::new(1.0, 1.0, 0.5), Vector3::new(0.1, 0.2, 0.0));
    for _ in 0..10 {
        let (angle, rate) = (3.0 * random.signed(), 2.0 * random.signed());
        let turn = UnitQuaternion::from_scaled_axis(axis.normalize() * angle);
        let omega = axis.normalize() * rate;
        let spin = Quaternion::from_imag(omega) * turn.into_inner() * 0.5;
        let (place, i) = (turn * centre, turn.imag());
        let velocity = omega.cross(&place);
        let q = vec![place.x, place.y, place.z, turn.w, i.x, i.y, i.z];
        let v = vec![
            velocity.x, velocity.y, velocity.z, spin.w, spin.i, spin.j, spin.k,
        ];
        let solution = solved::<Hinge>(&State { t: 0.0, q, v });
        let a = &solution.acceleration;
        let force =
            Vector3::from_iterator(Hinge::J[..3].iter().map(|row| solution.multipliers[*row]));
        let expected = 2.0 * (Vector3::new(a[0], a[1], a[2]) + Vector3::new(0.0, 0.0, 9.81));
        assert_all_close("reaction", force.as_slice(), expected.as_slice(), 1e-10);
        let alpha = (Quaternion::new(a[3], a[4], a[5], a[6]) * turn.conjugate().into_inner())
            .vector()
            * 2.0;
        // About the axis, by Steiner's theorem.
        let n = axis.normalize();
        let arm = place - n * n.dot(&place);
        let about = n.dot(&(inertia * n)) + 2.0 * arm.norm_squared();
        let weight = n.dot(&place.cross(&Vector3::new(0.0, 0.0, -2.0 * 9.81)));
        assert_all_close(
            "ω̇",
            alpha.as_slice(),
            (n * (weight / about)).as_slice(),
            1e-11,
        );
        // The rest of the moment stands at right angles to the axis: the hinge does no work.
        let matrix = turn.to_rotation_matrix();
        let j = matrix.matrix() * inertia * matrix.matrix().transpose();
        let moment = j * alpha + omega.cross(&(j * omega)) + place.cross(&force);
        assert_close("moment about the axis", n.dot(&moment), 0.0, 1e-11);
        assert!(moment.norm() > 1e-3, "a hinge that carries a moment");
    }
}

#[test]
fn a_wheel_rolls_and_a_screw_falls_as_closed_forms_say() {
    // (m + J/r²) a = m g along the line, and a = −r α.
    let wheel = solved::<Wheel>(&placed::<Wheel>([0.0, 0.4]));
    let a = 2.0 * 9.81 / (2.0 + 1.0 / 0.25);
    assert_all_close("wheel", &wheel.acceleration, &[a, 0.0, -a / 0.5], 1e-12);
    // (m + J (2π/lead)²) a = −m g.
    let screw = solved::<Screw>(&placed::<Screw>([0.0, 0.0]));
    let per_length = std::f64::consts::TAU / 3.0;
    let a = -2.0 * 9.81 / (2.0 + 2.0 * per_length * per_length);
    assert_close("screw", screw.acceleration[Screw::A_Z], a, 1e-12);
    assert_close(
        "turning",
        2.0 * screw.acceleration[Screw::A_E3],
        a * per_length,
        1e-12,
    );
}

ukcore::multibody! {
    /// A door on two hinges, which say the same of its orientation.
    Door {
        params { m = 20.0, b = 0.8, h = 1.5, j = 1.2, g = 9.81, tilt = 0.17 }
        bodies { spatial door { mass: m, inertia: [1.0, 2.0, j], centre: [b / 2.0, 0, 0] } }
        gravity { [0, -g * sin(tilt), -g * cos(tilt)] }
        holonomic {
            low: hinge(ground.at([0, 0, -h / 2.0]), door.at([0, 0, -h / 2.0]), [0, 0, 1])
            high: hinge(ground.at([0, 0, h / 2.0]), door.at([0, 0, h / 2.0]), [0, 0, 1])
        }
        output { angle = 2.0 * atan2(door.e3, door.e0) }
        start open() { door.e0 = 1.0 }
    }
}

#[test]
fn joints_may_share_rows() {
    let door = Door::default();
    let start = door.start("open", &[].into()).expect("a start");
    let run = ukcore::Simulation::new(&door).start(start).tolerance(1e-11);
    let run = run.every(0.1).until(3.0).expect("a motion");
    assert!(run.energy_drift() < 1e-9, "{:e}", run.energy_drift());
    // It falls as a pendulum about the hinges does: θ̇² is known by the height.
    let Door {
        m, b, j, g, tilt, ..
    } = door;
    let about = j + m * b * b / 4.0;
    let angles = run.output("angle").expect("the angle");
    for (sample, angle) in run.samples().zip(angles) {
        let square = -m * g * tilt.sin() * b * angle.sin() / about;
        let [w, z] = [Door::DOOR_E0, Door::DOOR_E3];
        let rate = 2.0 * (sample.q[w] * sample.v[z] - sample.q[z] * sample.v[w]);
        tests::assert_close("rate", rate * rate, square, 1e-8);
    }
    let redundant = ukcore::diagnose(&door, &run.samples().next().expect("one").to_state());
    assert_eq!(redundant.expect("a diagnosis").redundant.len(), 5);
}
