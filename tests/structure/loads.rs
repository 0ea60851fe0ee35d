//! Reactions that are hard to tell: beside redundant constraints, in singular positions, where nothing is accelerated.

use std::f64::consts::PI;

use tests::{assert_close, outputs};
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Simulation, Solver, State, lost_reactions};

ukcore::multibody! {
    /// Two shafts at an angle `bend` with Hooke's joint between them, driven against a brake: rows of the bearings and the cross imply each
    /// other, the motor takes no part in that.
    Shafts {
        params { bend = 0.6, speed = 5.0, brake = 0.3 }
        let second = [cos(bend), sin(bend), 0];
        bodies {
            spatial input { mass: 1.0, inertia: [0.02, 0.05, 0.05] }
            spatial output { mass: 1.0, inertia: [0.03, 0.05, 0.05] }
        }
        holonomic {
            first_bearing: hinge(ground.at([-1, 0, 0]), input.at([-1, 0, 0]), [1, 0, 0])
            second_bearing: hinge(ground.at(second), output.at([1, 0, 0]), second, [1, 0, 0])
            cross: universal(input.at([0, 0, 0]), output.at([0, 0, 0]), [0, 1, 0], [0, 0, 1])
            motor: drive(ground, input, [1, 0, 0], speed * t)
        }
        forces { torque(output, -brake * output.omega) }
        output { rate = inner(output.omega, second), torque = reaction(motor), shared = norm(reaction(second_bearing)) }
        integral { work = reaction(motor) * speed }
        start turning { input.e0 near 1.0; output.e0 near cos(bend / 2.0); output.e3 near sin(bend / 2.0) }
    }
}

ukcore::multibody! {
    /// A beam on three equal cranks, one driven, with a bob below it: one row too many, and two where all cranks lie in a line.
    Lift {
        params { l = 1.0, m = 3.0, w = 1.3, g = 9.81 }
        bodies {
            planar beam { mass: m, inertia: m * sq(l) }
            for i in 0..3 { planar crank[i] { mass: 0.1 * m, inertia: 0.01 * m * sq(l), centre: [l / 2.0, 0] } }
            planar bob { mass: m, inertia: 0.1 * m * sq(l) }
        }
        gravity { [0, -g] }
        holonomic {
            for i in 0..3 {
                foot[i]: pin(ground.at([i * l, 0]), crank[i].at([0, 0]))
                head[i]: pin(crank[i].at([l, 0]), beam.at([(i - 1) * l, 0]))
            }
            hang: pin(beam.at([0, -0.1 * l]), bob.at([0, l]))
            motor: crank[0].angle = 0.4 + w * t
        }
        output { hang = norm(reaction(hang)), motor = reaction(motor), foot = norm(reaction(foot[1])) }
        start low {
            crank[0].angle near 0.4; crank[1].angle near 0.4; crank[2].angle near 0.4
            beam.x near 1.9 * l; beam.y near 0.4 * l; bob.x near 1.9 * l; bob.y near -0.6 * l
        }
    }
}

ukcore::multibody! {
    /// A small body far off the ball joint that it swings about, askew of its axes, and another that hangs on it.
    Stick {
        params { l = 1000.0, m = 2.0, j = 0.01, g = 9.81 }
        bodies {
            spatial upper { mass: m, inertia: [j, 2 * j, 1.5 * j] }
            spatial lower { mass: m, inertia: [j, 2 * j, 1.5 * j] }
        }
        gravity { [0, 0, -g] }
        holonomic {
            foot: ball(ground.at([0, 0, 0]), upper.at([0, l, l]))
            elbow: ball(upper.at([0, 0, 0]), lower.at([0, -l, l]))
        }
        output { foot = reaction(foot), elbow = reaction(elbow) }
        start tumbling(rate = 1.0) {
            upper.e0 near 0.95; upper.e1 = 0.1; upper.e2 = -0.2; upper.e3 = 0.3;
            upper.x near 0.9 * l; upper.y near -0.6 * l; upper.z near -0.8 * l;
            lower.e0 near 0.95; lower.e1 = 0.1; lower.e2 = -0.3; lower.e3 = 0.3;
            lower.x near l; lower.y near 0.6 * l; lower.z near -1.8 * l;
            upper.omega = [0.5 * rate, 0.2 * rate, 0.3 * rate]; lower.omega = [0.1 * rate, 0, 0.2 * rate]
        }
    }
}

/// In coordinates that are turned as a whole there is always one that a joint far off all but leaves alone.
#[test]
fn bodies_far_off_their_joints_have_reactions() {
    for l in [1e-3, 1.0, 250.0, 1e4] {
        let stick = Stick {
            l,
            ..Stick::default()
        };
        let rate = (stick.g / l).sqrt();
        let start = stick.start("tumbling", &[("rate", rate)].into());
        let run = Simulation::new(&stick).start(start.expect("a start"));
        let run = run.tolerance(1e-8).every(0.02 / rate).until(8.0 / rate);
        let run = run.expect("a motion");
        let foot = run.multipliers("foot").expect("multipliers");
        let elbow = run.multipliers("elbow").expect("multipliers");
        let weight = stick.m * stick.g;
        for (k, (foot, elbow)) in foot.iter().zip(&elbow).enumerate() {
            for axis in 0..3 {
                let of = |name: &str| run.output(&format!("{name}[{axis}]")).expect("an output")[k];
                assert_close("foot", of("foot"), foot[axis], 1e-9 * weight);
                assert_close("elbow", of("elbow"), elbow[axis], 1e-9 * weight);
            }
        }
    }
}

/// Where one more row is left out than follows from the others at any state, what is left of them says nothing of any load.
#[test]
fn near_a_singular_position_no_reaction_is_wrong() {
    let lift = Lift::default();
    let start = lift.start("low", &[].into()).expect("a start");
    let run = Simulation::new(&lift).start(start).tolerance(1e-10);
    let run = run.every(0.01).until(8.0).expect("a motion");
    for name in ["hang", "motor"] {
        let loads = run.output(name).expect("an output");
        let known = run.multipliers(name).expect("multipliers");
        let mut missing = 0;
        for (load, known) in loads.iter().zip(&known) {
            let known = known.iter().map(|x| x * x).sum::<f64>().sqrt();
            match load.is_nan() {
                true => missing += 1,
                false if known.is_nan() => {}
                false => assert_close(name, load.abs(), known, 1e-10 * (1.0 + known)),
            }
        }
        assert!((1..=12).contains(&missing), "{name}: {missing}");
    }
    assert!(
        run.output("foot")
            .expect("an output")
            .iter()
            .all(|x| x.is_nan())
    );
}

/// By power: what the motor gives is what the brake takes and the shafts store.
#[test]
fn a_motor_beside_redundant_bearings_has_a_torque() {
    for bend in [0.1, 0.6, std::f64::consts::FRAC_PI_4, 1.2] {
        let shafts = Shafts {
            bend,
            ..Shafts::default()
        };
        let start = shafts.start("turning", &[].into()).expect("a start");
        let run = Simulation::new(&shafts).start(start).tolerance(1e-11);
        let run = run.every(0.02).until(1.5).expect("a motion");
        let of = |name: &str| run.output(name).expect("an output");
        let (rates, torques) = (of("rate"), of("torque"));
        let known = run.multipliers("motor").expect("a multiplier");
        let (sin, w) = (bend.sin(), shafts.speed);
        for (k, t) in run.times().iter().enumerate() {
            // The derivative of the second shaft's rate c w/(1 − (cos w t · s)²).
            let (sin_t, cos_t) = (w * t).sin_cos();
            let square = 1.0 - (cos_t * sin).powi(2);
            let rate = bend.cos() * w / square;
            let change = -rate / square * 2.0 * cos_t * sin_t * w * sin * sin;
            let power = rate * (0.03 * change + shafts.brake * rate);
            assert_close("rate", rates[k], rate, 1e-7);
            assert_close("torque", torques[k], power / w, 1e-6);
            assert_close("multiplier", torques[k], known[k][0], 1e-9);
        }
        assert!(of("shared").iter().all(|x| x.is_nan()));
        let told = lost_reactions(&shafts, &run.last().expect("an end").to_state());
        let told = told.expect("bearings share loads");
        assert!(
            told.contains("second_bearing")
                && !told.contains("motor")
                && told.contains("declare as few"),
            "{told}"
        );
    }
}

ukcore::multibody! {
    /// A bevel differential; its wheels turn about x, and its pinion about y of the carrier.
    Differential {
        params { a = 0.1, m = 0.3, j = 0.003, torque = 5.0, drag = 0.4 }
        let contact = |s| carrier.at([s * a, a, 0]);
        let speed = |b, s| inner(dot(b.centre) + cross(b.omega, contact(s) - b.centre), carrier.along([0, 0, 1]));
        bodies {
            spatial carrier { mass: 1, inertia: [0.05, 0.05, 0.05] }
            spatial wheel[2] { mass: 1, inertia: [0.02, 0.02, 0.02] }
            spatial pinion { mass: m, inertia: [j, j, j] }
        }
        holonomic {
            axle: hinge(ground.at([0, 0, 0]), carrier.at([0, 0, 0]), [1, 0, 0])
            for i in 0..2 { bearing[i]: hinge(ground.at([(2 * i - 1) * a, 0, 0]), wheel[i].at([0, 0, 0]), [1, 0, 0]) }
            pin: hinge(carrier.at([0, a, 0]), pinion.at([0, 0, 0]), [0, 1, 0])
        }
        nonholonomic { for i in 0..2 { mesh[i]: speed(wheel[i], 2 * i - 1) = speed(pinion, 2 * i - 1) } }
        forces { torque(carrier, [torque, 0, 0]) torque(wheel[0], -drag * wheel[0].omega) }
        output {
            force[0] = reaction(mesh[0]), force[1] = reaction(mesh[1])
            change[0] = (a * reaction(mesh[0]) - drag * wheel[0].omega[0]) / 0.02, change[1] = a * reaction(mesh[1]) / 0.02
        }
        start rest {
            carrier.e0 near 1.0; pinion.e0 near 1.0; pinion.y near a;
            for i in 0..2 { wheel[i].e0 near 1.0; wheel[i].x near (2 * i - 1) * a }
        }
    }
}

/// Between meshes a body without inertia leaves their forces what they are; one with so little that rounding is as much leaves none, and
/// that is said of the body, not of the meshes.
#[test]
fn a_body_too_light_for_reactions_is_named() {
    for share in [1.0, 1e-3, 1e-5, 1e-9] {
        let gear = Differential {
            m: 0.3 * share,
            j: 0.003 * share,
            ..Differential::default()
        };
        let start = gear.start("rest", &[].into()).expect("a start");
        let run = Simulation::new(&gear).start(start).tolerance(1e-10);
        let run = run.every(0.1).until(1.0).expect("a motion");
        let told = lost_reactions(&gear, &run.last().expect("an end").to_state());
        let of = |name: &str| run.output(name).expect("an output");
        if share < 1e-6 {
            assert!(of("force[0]").iter().all(|x| x.is_nan()));
            let told = told.expect("a cause");
            for part in ["`pinion` is so light", "`mesh[0]`", "more inertia"] {
                assert!(told.contains(part), "{told}");
            }
            continue;
        }
        // By Lagrange's equations in the rates of the wheels: the carrier has their mean, the pinion half their difference.
        let (both, apart) = ((0.05 + gear.m * 0.01 + gear.j) / 4.0, gear.j / 4.0);
        let (own, other) = (0.02 + both + apart, both - apart);
        let (force, change) = (
            ["force[0]", "force[1]"].map(of),
            ["change[0]", "change[1]"].map(of),
        );
        for k in 0..11 {
            let drag = 0.02 * change[0][k] - gear.a * force[0][k];
            let [p, q] = [gear.torque / 2.0 + drag, gear.torque / 2.0];
            let size = own * own - other * other;
            assert_close("left", change[0][k], (own * p - other * q) / size, 1e-7);
            assert_close("right", change[1][k], (own * q - other * p) / size, 1e-7);
        }
    }
}

/// The bicycle of docs/spatial.md with a heading, and rolling friction that its load makes at the rear wheel.
macro_rules! bicycle {
    ($($name:ident { $($sections:tt)* } start { $($start:tt)* })*) => {$(
        ukcore::multibody! {
            pub $name {
                params { w = 1.02, c = 0.08, tilt = PI / 10, r[2] = [0.3, 0.35], g = 9.81, turn = 0.0, mu = 0.004 }
                let hub = [[0, 0, r[0]], [w, 0, r[1]]];
                let q = rotz(turn);
                let head = [cos(turn / 2), sin(turn / 2)];
                bodies {
                    spatial rear { mass: 2, inertia: [0.0603, 0.12, 0.0603], centre: hub[0] }
                    spatial front { mass: 3, inertia: [0.1405, 0.28, 0.1405], centre: hub[1] }
                    spatial frame { mass: 85, inertia: [9.2, 11, 2.8, 0, -2.4, 0], centre: [0.3, 0, 0.9] }
                    spatial fork { mass: 4, inertia: [0.05892, 0.06, 0.00708, 0, 0.00756, 0], centre: [0.9, 0, 0.7] }
                }
                gravity { [0, 0, -g] }
                $($sections)*
                nonholonomic {
                    grip[0]: rolls(rear.at(hub[0]), [0, 1, 0], r[0]), grip[1]: rolls(front.at(hub[1]), [0, 1, 0], r[1])
                }
                nonideal {
                    torque(frame, rear, friction(rear.spin[1] - frame.spin[1], mu * r[0] * abs(reaction(touch[0])[2]))
                        * frame.along([0, 1, 0]))
                }
                output { load = (reaction(touch[0]) + reaction(grip[0]))[2], x = inner(q * [1, 0, 0], frame.centre) }
                start upright(speed = 4.0, lean_rate = 0.5) {
                    $($start)*
                    frame.centre = q * [0.3, 0, 0.9]; dot(frame.centre) = q * [speed, -0.9 * lean_rate, 0];
                    frame.omega = q * [lean_rate, 0, 0]; frame.e0 near head[0]; frame.e3 near head[1]
                }
            }
        }
    )*};
}

bicycle! {
    Bicycle {
        holonomic {
            rear_axle: hinge(frame.at(hub[0]), rear.at(hub[0]), [0, 1, 0])
            front_axle: hinge(fork.at(hub[1]), front.at(hub[1]), [0, 1, 0])
            steering: hinge(frame.at([w + c, 0, 0]), fork.at([w + c, 0, 0]), [-sin(tilt), 0, cos(tilt)])
            touch[0]: disc(rear.at(hub[0]), [0, 1, 0], r[0]), touch[1]: disc(front.at(hub[1]), [0, 1, 0], r[1])
        }
    } start {
        rear.centre near q * hub[0]; front.centre near q * hub[1]; fork.centre near q * [0.9, 0, 0.7];
        rear.e0 near head[0]; rear.e3 near head[1]; front.e0 near head[0]; front.e3 near head[1];
        fork.e0 near head[0]; fork.e3 near head[1]; fork.omega = q * [lean_rate, 0, 0];
    }
    BicycleOfTree {
        tree {
            rear_axle: hinge(frame.at(hub[0]), rear.at(hub[0]), [0, 1, 0])
            steering: hinge(frame.at([w + c, 0, 0]), fork.at([w + c, 0, 0]), [-sin(tilt), 0, cos(tilt)])
            front_axle: hinge(fork.at(hub[1]), front.at(hub[1]), [0, 1, 0])
        }
        holonomic { touch[0]: disc(rear.at(hub[0]), [0, 1, 0], r[0]), touch[1]: disc(front.at(hub[1]), [0, 1, 0], r[1]) }
    } start { dot(steering.angle) = 0; }
}

/// Straight ahead nothing is accelerated to the side, and in steady motion nothing at all: what rows are met by is rounding, and tells
/// nothing of their multipliers.
#[test]
fn loads_of_what_is_not_accelerated_are_known() {
    fn ridden<M: Mechanism>(of: &M, start: State, lean_rate: f64) -> (usize, f64) {
        let out = outputs(of, &start);
        let mut solver = Solver::new(of, SolverOptions::default());
        let found = solver.solve(0.0, &start.q, &start.v).unwrap();
        // Under touch[0], touch[1] and two times two of grip.
        let last = found.multipliers.len();
        assert_close("load", out[0], found.multipliers[last - 6], 1e-10);
        if lean_rate == 0.0 {
            // The moment about the front contact.
            let moment = 2.0 * 1.02 + 85.0 * 0.72 + 4.0 * 0.12;
            assert_close("share of the weight", out[0], 9.81 * moment / 1.02, 1e-10);
        }
        assert_eq!(lost_reactions(of.prepared(), &start), None);
        let run = Simulation::new(of.prepared()).start(start).until(0.3);
        let run = run.unwrap_or_else(|end| panic!("{}", end.error));
        (
            run.work().fallbacks,
            *run.output("x").unwrap().last().unwrap(),
        )
    }
    for lean_rate in [0.0, 0.5] {
        let options = [("lean_rate", lean_rate)].into();
        let mut ways = Vec::new();
        for turn in [0.0, 1e-9, 0.1, 0.5 * PI, 3.0] {
            let (mut rows, mut tree) = (Bicycle::default(), BicycleOfTree::default());
            (rows.turn, tree.turn) = (turn, turn);
            let start = rows.start("upright", &options).expect("a start");
            let (fallbacks, way) = ridden(&rows, start, lean_rate);
            assert_eq!(fallbacks, 0);
            ways.push(way);
            let start = tree.start("upright", &options).expect("a start");
            ways.push(ridden(&tree, start, lean_rate).1);
        }
        for way in &ways {
            assert_close("way", *way, ways[0], 1e-7);
        }
    }
}
