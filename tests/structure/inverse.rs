//! Efforts of motors against closed forms.

mod closed;

use tests::assert_close;
use ukcore::solver::SolverOptions;
use ukcore::studies::{Kinematics, Posture};
use ukcore::{
    Error, Mechanism, Prepared, Simulation, Solver, State, assemble, inverse, inverse_forces,
    kinematics,
};

ukcore::multibody! {
    /// A rod on a driven hinge; y points up.
    pub Driven {
        params { m = 1.7, l = 0.8, a = 0.6, w = 3.0, g = 9.81 }
        bodies { planar rod { mass: m, inertia: m * sq(l) / 12.0, centre: [l / 2.0, 0] } }
        gravity { [0, -g] }
        holonomic {
            hinge: pin(ground.at([0, 0]), rod.at([0, 0]))
            motor: turn(ground, rod) = a * sin(w * t)
        }
        start level() { rod.angle near 0.0 }
    }
}

ukcore::multibody! {
    /// An arm of two links with point masses at their ends, in joint angles that are driven.
    pub Arm {
        params { m[2] = [1.2, 0.7], l[2] = [0.5, 0.4], w = 2.0, g = 9.81 }
        coords { a, b }
        let elbow = l[0] * [cos(a), sin(a)];
        let hand = elbow + l[1] * [cos(a + b), sin(a + b)];
        kinetic { 0.5 * m[0] * sq(dot(elbow)), 0.5 * m[1] * sq(dot(hand)) }
        potential { m[0] * g * elbow[1], m[1] * g * hand[1] }
        holonomic { shoulder: a = 0.5 * sin(w * t), bend: b = 0.8 + 0.3 * sq(t) }
        start begun { a near 0.0; b near 0.8 }
    }
}

ukcore::multibody! {
    /// A parallelogram of massless cranks of length 1 under a beam of mass m, both cranks driven by the same angle, with a third crank that
    /// makes the joints redundant too; y points up.
    pub Lift {
        params { m = 3.0, w = 1.3, g = 9.81 }
        coords { x, y, a, b }
        mass { x: m, y: m }
        potential { m * g * y }
        holonomic {
            near: [x, y] = [cos(a), sin(a)]
            far: [x, y] = [cos(b), sin(b)]
            third: sq(x) + sq(y) = 1.0
            left: a = 0.4 + w * t
            right: 2.0 * b = 0.8 + 2.0 * w * t
        }
        start low { a near 0.4; b near 0.4; x near 0.9; y near 0.4 }
    }
}

#[test]
fn a_driven_rod_takes_inertia_and_weight() {
    let driven = Driven::default();
    let start = driven.start("level", &[].into()).unwrap();
    let run = Simulation::new(&driven)
        .start(start)
        .every(0.1)
        .until(1.0)
        .unwrap();
    let Driven { m, l, a, w, g } = driven;
    for (sample, efforts) in run.samples().zip(run.efforts(&["motor"]).unwrap()) {
        let (s, c) = (w * sample.t).sin_cos();
        let (angle, rate, turning) = (a * s, a * w * c, -a * w * w * s);
        let torque = m * l * l / 3.0 * turning + 0.5 * m * g * l * angle.cos();
        assert_eq!((efforts.len(), efforts[0].name), (1, "motor"));
        assert_close("torque", efforts[0].effort, torque, 1e-9);
        assert_close("power", efforts[0].power, torque * rate, 1e-9);
    }
    let motors = driven
        .prepared()
        .motors(&run.last().unwrap().to_state(), [0.1, 0.7]);
    assert_eq!(motors, ["motor"]);
    assert!(matches!(
        run.efforts(&["moter"]),
        Err(Error::UnknownName { .. })
    ));
}

/// Torques of the two-link arm as textbooks have them (Spong, Hutchinson & Vidyasagar, section 7.3), of point masses.
#[test]
fn an_arm_of_two_links_has_the_torques_of_textbooks() {
    let arm = Arm::default();
    let start = arm.start("begun", &[].into()).unwrap();
    let run = Simulation::new(&arm)
        .start(start)
        .every(0.2)
        .until(2.0)
        .unwrap();
    let Arm { m, l, w, g } = arm;
    for (sample, efforts) in run
        .samples()
        .zip(run.efforts(&["shoulder", "bend"]).unwrap())
    {
        let t = sample.t;
        let [a, b] = [0.5 * (w * t).sin(), 0.8 + 0.3 * t * t];
        let [va, vb] = [0.5 * w * (w * t).cos(), 0.6 * t];
        let [aa, ab] = [-0.5 * w * w * (w * t).sin(), 0.6];
        let [cross, own] = [m[1] * l[0] * l[1], m[1] * l[1] * l[1]];
        let [m11, m12] = [
            (m[0] + m[1]) * l[0] * l[0] + own + 2.0 * cross * b.cos(),
            own + cross * b.cos(),
        ];
        let turn = cross * b.sin();
        let weight = m[1] * g * l[1] * (a + b).cos();
        let shoulder = m11 * aa + m12 * ab - turn * (2.0 * va * vb + vb * vb)
            + (m[0] + m[1]) * g * l[0] * a.cos()
            + weight;
        let bend = m12 * aa + own * ab + turn * va * va + weight;
        assert_close("shoulder", efforts[0].effort, shoulder, 1e-8);
        assert_close("bend", efforts[1].effort, bend, 1e-8);
        assert_close("power", efforts[1].power, bend * vb, 1e-8);
    }
}

/// The row of the right crank is twice as long, so its effort counts double: of all λ with λ + 2μ = T the least are T/5 and 2T/5.
#[test]
fn motors_that_share_their_work_take_the_least() {
    let lift = Lift::default();
    let Lift { m, w, g } = lift;
    for k in 0..10 {
        let t = 0.1 * f64::from(k);
        let (s, c) = (0.4 + w * t).sin_cos();
        let state = State {
            t,
            q: vec![c, s, 0.4 + w * t, 0.4 + w * t],
            v: vec![-w * s, w * c, w, w],
        };
        let torque = m * g * c;
        let both = inverse(&lift, &state, &["left", "right"]).unwrap();
        assert_close("left", both[0].effort, torque / 5.0, 1e-9);
        assert_close("right", both[1].effort, 0.4 * torque, 1e-9);
        assert_close("power", both[0].power + both[1].power, torque * w, 1e-9);
        // The other taken as a joint, neither is needed.
        let alone = inverse(&lift, &state, &["left"]).unwrap();
        assert_close("alone", alone[0].effort, 0.0, 1e-9);
    }
}

ukcore::multibody! {
    /// A beam on two equal cranks, which keep it level.
    pub Spare {
        params { l = 1.0, g = 9.81 }
        bodies { planar crank[2] { mass: 1.0, inertia: 0.1, centre: [l / 2.0, 0] } planar beam { mass: 3.0, inertia: 1.0 } }
        gravity { [0, -g] }
        holonomic {
            for i in 0..2 {
                axle[i]: pin(ground.at([i, 0]), crank[i].at([0, 0]))
                pin[i]: pin(crank[i].at([l, 0]), beam.at([i, 0]))
            }
            level: beam.angle = 0
        }
        start turning(angle = 0.6, speed = 1.5) {
            crank[0].angle = angle;
            dot(crank[0].angle) = speed;
            crank[1].angle near angle
        }
    }
}

/// What the joints prescribe already needs no effort, though λ of the solver is some share of a load that is not unique.
#[test]
fn a_motor_that_joints_imply_does_nothing() {
    let spare = Spare::default();
    for angle in [0.3, 0.6, 1.1, 2.2] {
        let start = spare.start("turning", &[("angle", angle)].into()).unwrap();
        let efforts = inverse(&spare, &start, &["level"]).unwrap();
        assert_close("level", efforts[0].effort, 0.0, 1e-9);
    }
}

ukcore::multibody! {
    /// A crank that drives a slider against a load.
    pub Pump {
        params { m = 2.0, r = 0.1, l = 0.3, load = 50.0 }
        coords { th, x }
        mass { th: 0.2, x: m }
        force { x: -load }
        holonomic { rod: sq(x - r * cos(th)) + sq(r * sin(th)) = sq(l) }
    }
}

/// By the power, τ = (m ẍ + F) dx/dθ.
#[test]
fn a_crank_takes_the_torque_of_its_slider() {
    let pump = Pump::default();
    let guess = State::guess::<Pump>(&[("th", 0.4), ("x", 0.3)]).unwrap();
    let start = ukcore::assemble(&pump, &guess, &["th"]).unwrap();
    let turn = kinematics(&pump, &start, &[("th", 0.0..6.0)], &[], 60).unwrap();
    let speed = 7.0;
    let turn = turn.at_speed(speed).unwrap();
    let efforts = turn.efforts(&["th"]).unwrap();
    for (posture, efforts) in turn.postures.iter().zip(efforts) {
        let (s, c) = posture.state.q[0].sin_cos();
        let (r, l) = (pump.r, pump.l);
        let w = (l * l - r * r * s * s).sqrt();
        let dw = -r * r * s * c / w;
        let ddw = (-r * r * (c * c - s * s) - dw * dw) / w;
        let (dx, ddx) = (dw - r * s, ddw - r * c);
        let torque = (pump.m * ddx * speed * speed + pump.load) * dx;
        assert_eq!(efforts[0].name, "th");
        assert_close("torque", efforts[0].effort, torque, 1e-9);
        assert_close("power", efforts[0].power, torque * speed, 1e-8);
    }
    // The slider driven instead does the same work; both share it such that their squares are least.
    let posture = &turn.postures[7];
    let torque = efforts_of(&pump, posture, &["th"])[0].effort;
    let speeds = [speed, posture.state.v[1]];
    let force = efforts_of(&pump, posture, &["x"])[0].effort;
    assert_close("force", force * speeds[1], torque * speeds[0], 1e-9);
    let both = efforts_of(&pump, posture, &["th", "x"]);
    let share = torque * speeds[0] / (speeds[0].powi(2) + speeds[1].powi(2));
    assert_close("shared torque", both[0].effort, share * speeds[0], 1e-9);
    assert_close("shared force", both[1].effort, share * speeds[1], 1e-9);
}

fn efforts_of(
    mechanism: &impl Mechanism,
    posture: &Posture,
    on: &[&str],
) -> Vec<ukcore::studies::Effort> {
    inverse_forces(mechanism.prepared(), posture, on).unwrap()
}

#[test]
fn a_motion_that_the_forces_cannot_make_is_refused() {
    ukcore::multibody! {
        /// Two carts with a spring between them.
        pub Carts {
            coords { x, y }
            mass { x: 2.0, y: 3.0 }
            potential { 50.0 * sq(y - x) }
        }
    }
    let state = State::guess::<Carts>(&[("x", 0.1), ("dot(y)", 2.0), ("t", 0.5)]).unwrap();
    assert_eq!(
        (state.t, &state.q[..], &state.v[..]),
        (0.5, &[0.1, 0.0][..], &[0.0, 2.0][..])
    );
    let posture = Posture {
        state,
        acceleration: vec![4.0, 5.0],
    };
    let both = efforts_of(&Carts::default(), &posture, &["x", "y"]);
    assert_close("x", both[0].effort, 8.0 + 10.0, 1e-12);
    assert_close("y", both[1].effort, 15.0 - 10.0, 1e-12);
    assert_close("power", both[1].power, 10.0, 1e-12);
    let refused = |mechanism: &Prepared, posture: &Posture, on: &[&str], message: &str| {
        let told = inverse_forces(mechanism, posture, on)
            .unwrap_err()
            .to_string();
        assert!(told.contains(message), "{told}");
    };
    let carts = Carts::default().prepared();
    refused(
        &carts,
        &posture,
        &["x"],
        "do not suffice for this motion: most of all it takes a force on `y`",
    );
    refused(&carts, &posture, &["z"], "no coordinate is called `z`");
    let short = Posture {
        acceleration: vec![4.0],
        ..posture
    };
    refused(&carts, &short, &["x"], "`acceleration` has length 1");
    let pump = Pump::default();
    let state = State::guess::<Pump>(&[("x", 0.4)]).unwrap();
    let off = Posture {
        state,
        acceleration: vec![0.0, 1.0],
    };
    refused(
        &pump.prepared(),
        &off,
        &["th"],
        "`acceleration` does not satisfy the constraint `rod`",
    );
    let unknown = State::guess::<Pump>(&[("dot(xx)", 0.4)])
        .unwrap_err()
        .to_string();
    assert!(unknown.contains("did you mean `x`"), "{unknown}");
}

ukcore::multibody! {
    /// A rotor out of balance on a driven hinge in space.
    pub Rotor {
        params { w = 7.0, c = 1.5 }
        bodies { spatial b { mass: 3, inertia: [0.05, 0.08, 0.11, 0.01, 0.02, -0.015], centre: [0.05, 0.02, 0.3] } }
        holonomic {
            h: hinge(ground.at([0, 0, 0]), b.at([0, 0, 0]), [0, 0, 1])
            motor: drive(ground, b, [0, 0, 1], w * t + c * sq(t))
        }
        start s { b.e0 near 1.0 }
    }
}

ukcore::multibody! {
    /// The same on a hinge that is free.
    pub Hinged {
        bodies { spatial b { mass: 3, inertia: [0.05, 0.08, 0.11, 0.01, 0.02, -0.015], centre: [0.05, 0.02, 0.3] } }
        holonomic { h: hinge(ground.at([0, 0, 0]), b.at([0, 0, 0]), [0, 0, 1]) }
        start s { b.e0 near 1.0 }
    }
}

/// Near the orientation of the ground e0 has next to no inertia along itself. The torque on the motor is J dw/dt all the same, with J about
/// the axis; and on e3 it is the generalised force 2 J dw/dt.
#[test]
fn efforts_of_turned_bodies_are_right_beside_the_identity() {
    let inertia = 0.11 + 3.0 * (0.05_f64.powi(2) + 0.02_f64.powi(2));
    let rotor = Rotor::default();
    let start = rotor.start("s", &[].into()).unwrap();
    let mut solver = Solver::new(Rotor::default(), SolverOptions::default());
    let free = Hinged::default();
    let resting = free.start("s", &[].into()).unwrap();
    for small in [0.0, 1e-60, -1e-40, 1e-30, 1e-20, -1e-17, 1e-12, -1e-9] {
        let mut state = start.clone();
        state.q[Rotor::B_E3] = small;
        let found = inverse(&rotor, &state, &["motor"]).unwrap()[0];
        assert_close("J dw/dt", found.effort, 3.0 * inertia, 1e-8);
        assert_close("power", found.power, 7.0 * 3.0 * inertia, 1e-7);
        let rows = Rotor::SPEC.constraint_indices("motor").unwrap();
        let solution = solver.solve(state.t, &state.q, &state.v).unwrap();
        assert_close("λ", found.effort, solution.multipliers[rows[0]], 1e-8);

        let mut state = resting.clone();
        state.q[Hinged::B_E3] = small;
        let mut acceleration = vec![0.0; state.q.len()];
        // ω = 2 de3/dt, of all points of the body.
        acceleration[Hinged::B_E3] = 1.5;
        acceleration[Hinged::B_X] = -0.02 * 3.0;
        acceleration[Hinged::B_Y] = 0.05 * 3.0;
        let posture = Posture {
            state,
            acceleration,
        };
        let found = inverse_forces(&free, &posture, &["b.e3"]).unwrap();
        assert_close("force on e3", found[0].effort, 2.0 * 3.0 * inertia, 1e-8);
    }
    let swept = kinematics(&free, &resting, &[("b.e3", -0.5..0.5)], &[], 10).unwrap();
    assert!(swept.efforts(&["b.e3"]).is_ok());
}

ukcore::multibody! {
    /// A ball that rolls on a turntable.
    pub Table {
        params { m = 3.0, r = 0.05, w = 3.5, g = 9.81 }
        bodies { spatial ball { mass: m, inertia: [0.4 * m * sq(r), 0.4 * m * sq(r), 0.4 * m * sq(r)] } }
        gravity { [0, 0, -g] }
        holonomic { touch: ball.z = r }
        let contact = dot(ball.centre) + cross(ball.omega, [0, 0, -r]) - cross([0, 0, w], ball.centre);
        nonholonomic { roll[0]: contact[0] = 0, roll[1]: contact[1] = 0 }
        integral { work = -w * ball.y * reaction(roll[0]) + w * ball.x * reaction(roll[1]) }
        start thrown() { ball.e0 = 1.0; ball.x = 0.5; ball.y = 0.0; dot(ball.x) = 0.0; dot(ball.y) = 1.0; }
    }
}

/// Where it starts the table's surface moves across the radius alone, and one row prescribes nothing.
#[test]
fn what_drives_anywhere_is_a_motor() {
    let table = Table::default();
    let start = table.start("thrown", &[].into()).unwrap();
    let motors = table.prepared().motors(&start, [0.0, 1.0]);
    assert_eq!(motors, ["roll[0]", "roll[1]"]);
    let run = Simulation::new(&table).start(start).tolerance(1e-11);
    let run = run.every(0.1).until(2.0).unwrap();
    let energy = run.energy();
    let kinetic = energy.iter().map(|e| e.kinetic);
    let first = energy[0].kinetic;
    for (work, kinetic) in run.integral("work").unwrap().iter().zip(kinetic) {
        assert_close("work", *work, kinetic - first, 1e-8);
    }
}

/// A driven arm on a rough bearing, and the same one that is free; `$friction` acts on it.
macro_rules! rough_arms {
    ($motor:ident, $free:ident, $section:ident, $friction:expr) => {
        ukcore::multibody! {
            pub $motor {
                params { m = 1.0, l = 0.4, j = 0.02, w = 3.0, g = 9.81 }
                bodies { planar arm { mass: m, inertia: j, centre: [l, 0] } }
                gravity { [0, -g] }
                holonomic { axle: pin(ground.at([0, 0]), arm.at([0, 0])), motor: turn(ground, arm) = w * t }
                $section { torque(ground, arm, $friction) }
                output { load = norm(reaction(axle)) }
            }
        }
        ukcore::multibody! {
            pub $free {
                params { m = 1.0, l = 0.4, j = 0.02, g = 9.81 }
                bodies { planar arm { mass: m, inertia: j, centre: [l, 0] } }
                gravity { [0, -g] }
                holonomic { axle: pin(ground.at([0, 0]), arm.at([0, 0])) }
                $section { torque(ground, arm, $friction) }
                output { load = norm(reaction(axle)) }
            }
        }
    };
}

rough_arms!(Even, EvenFree, nonideal, friction(arm.omega, 0.5));
rough_arms!(Given, GivenFree, forces, friction(arm.omega, 0.5));
rough_arms!(
    Loaded,
    LoadedFree,
    nonideal,
    friction(arm.omega, 0.3 * 0.05 * norm(reaction(axle)))
);

/// The torque of a motor that turns such an arm at 3 rad/s, and the load of the axle there.
fn turned(angle: f64, friction: impl Fn(f64) -> f64) -> [f64; 2] {
    let (weight, inward) = (9.81, 0.4 * 9.0);
    let (sin, cos) = angle.sin_cos();
    let load = (inward * cos).hypot(weight - inward * sin);
    [weight * 0.4 * cos + friction(load), load]
}

/// Such an arm held out.
fn level<M: Mechanism + Default>() -> State {
    let guess = State::guess::<M>(&[("arm.x", 0.4)]).unwrap();
    assemble(M::default().prepared(), &guess, &[]).unwrap()
}

#[test]
fn motors_overcome_friction() {
    fn motor<M: Mechanism + Default>(friction: impl Fn(f64) -> f64) {
        let driven = M::default();
        let start = level::<M>();
        let swept = kinematics(driven.prepared(), &start, &[("t", 0.0..1.4)], &[], 4).unwrap();
        for posture in &swept.postures {
            let efforts = inverse(driven.prepared(), &posture.state, &["motor"]).unwrap();
            let [torque, _] = turned(3.0 * posture.state.t, &friction);
            assert_close(M::SPEC.name, efforts[0].effort, torque, 1e-9);
            assert_close(M::SPEC.name, efforts[0].power, 3.0 * torque, 1e-9);
        }
    }
    motor::<Even>(|_| 0.5);
    motor::<Given>(|_| 0.5);
    motor::<Loaded>(|load| 0.3 * 0.05 * load);
}

/// Of the motion that a sweep prescribes, reactions are not those that come out of the forces.
#[test]
fn reactions_of_swept_coordinates_are_not_told() {
    fn swept<M: Mechanism + Default>(drive: &str) -> Kinematics {
        let arm = M::default();
        let start = level::<M>();
        kinematics(arm.prepared(), &start, &[(drive, 0.0..1.0)], &[], 4).unwrap()
    }
    let free = [
        swept::<EvenFree>("arm.angle"),
        swept::<GivenFree>("arm.angle"),
    ];
    for found in free.map(|found| found.at_speed(3.0).unwrap()) {
        let angles = found.coordinate("arm.angle").unwrap();
        for (angle, efforts) in angles.iter().zip(found.efforts(&["arm.angle"]).unwrap()) {
            let [torque, _] = turned(*angle, |_| 0.5);
            assert_close("torque", efforts[0].effort, torque, 1e-9);
        }
        let refused = found.output("load").unwrap_err().to_string();
        let told = refused.contains("`load` depends on reactions") && refused.contains("sweep `t`");
        assert!(told, "{refused}");
    }
    let refused = swept::<LoadedFree>("arm.angle").efforts(&["arm.angle"]);
    let refused = refused.unwrap_err().to_string();
    let told = refused.contains("depend on reactions") && refused.contains("`inverse`");
    assert!(told, "{refused}");
    // Swept in time they are.
    let found = swept::<Even>("t");
    let angles = found.coordinate("arm.angle").unwrap();
    for (angle, load) in angles.iter().zip(found.output("load").unwrap()) {
        assert_close("load", load, turned(*angle, |_| 0.0)[1], 1e-9);
    }
}
