//! Friction in joints and contacts of bodies, as moments and forces on them that their own reactions load: closed forms, and the same
//! mechanisms written in coordinates.

use tests::{assert_all_close, assert_close, at};
use ukcore::solver::SolverOptions;
use ukcore::{Method, Simulation, Solver};

ukcore::multibody! {
    /// A rotor in a bearing that rubs, its axis `tilt` off the vertical.
    Rotor {
        params { m = 2.0 [kg], j = 0.3 [kg m^2], across = 0.2 [kg m^2], r = 0.02 [m], mu = 0.1, tilt = 0.7, g = 9.81 [m/s^2] }
        bodies { spatial rotor { mass: m, inertia: [across, across, j] } }
        gravity { [0, 0, -g] }
        let axis = [sin(tilt), 0, cos(tilt)];
        let load = |lever| lever * norm(reaction(journal));
        holonomic { journal: hinge(ground.at([0, 0, 0]), rotor.at([0, 0, 0]), axis, [0, 0, 1]) }
        nonideal { torque(rotor, friction(inner(rotor.omega, axis), load(mu * r)) * axis) }
        output { load = load(1) }
        integral { lost = load(mu * r) * abs(inner(rotor.omega, axis)) }
        start spun(speed = 3.0) {
            rotor.e0 = cos(tilt / 2); rotor.e1 = 0; rotor.e2 = sin(tilt / 2); rotor.e3 = 0;
            rotor.omega = speed * axis
        }
    }
}

#[test]
fn a_rotor_is_slowed_by_what_its_weight_loads() {
    for tilt in [0.0, 1e-9, 0.7, std::f64::consts::FRAC_PI_2, 3.0] {
        let rotor = Rotor {
            tilt,
            ..Rotor::default()
        };
        let moment = rotor.mu * rotor.r * rotor.m * rotor.g;
        let rest = 3.0 * rotor.j / moment;
        for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
            let run = Simulation::new(rotor.clone())
                .start(rotor.start("spun", &[].into()).expect("a start"))
                .method(method)
                .tolerance(1e-11)
                .every(rest / 16.0)
                .until(15.5 / 16.0 * rest)
                .unwrap_or_else(|e| panic!("{method:?}, {tilt}: {e}"));
            let lost = run.integral("lost").expect("it is declared");
            for ((sample, output), lost) in run.samples().zip(run.outputs()).zip(lost) {
                let speed = 3.0 - moment / rotor.j * sample.t;
                let v = &sample.v[Rotor::ROTOR_E0..];
                let rate = 2.0 * v.iter().map(|v| v * v).sum::<f64>().sqrt();
                assert_close("speed", rate, speed, 1e-8);
                assert_close("load", output[0], rotor.m * rotor.g, 1e-8);
                let spent = 0.5 * rotor.j * (9.0 - speed * speed);
                assert_close("lost", lost, spent, 1e-8);
            }
        }
    }
}

/// Two rods, one hanging from the other by a pin that rubs with the moment `f`.
macro_rules! rods {
    ($name:ident { $($nonideal:tt)* }) => {
        ukcore::multibody! {
            $name {
                params { l = 1.2, m[2] = [3.0, 0.5], f = 0.3, n = 0.02, g = 9.81 }
                bodies { for i in 0..2 { planar rod[i] { mass: m[i], inertia: m[i] * sq(l) / 12, centre: [l / 2, 0] } } }
                gravity { [0, -g] }
                holonomic {
                    top: pin(ground.at([0, 0]), rod[0].at([0, 0]))
                    knee: pin(rod[0].at([l, 0]), rod[1].at([0, 0]))
                }
                let rubbed = |v| friction(v, f + n * norm(reaction(knee)));
                let pushed = |share| [share * norm(reaction(top)), -0.2];
                nonideal { $($nonideal)* }
            }
        }
    };
}
rods! { Bodies {
    torque(rod[0], rod[1], rubbed(rod[1].omega - rod[0].omega))
    force(rod[1].at([l, 0]), pushed(0.1))
} }
rods! { Coordinates {
    rod[1].angle: rubbed(rod[1].omega - rod[0].omega)
    rod[0].angle: rubbed(rod[0].omega - rod[1].omega)
    rod[1].x: pushed(0.1)[0]
    rod[1].y: pushed(0.1)[1]
    rod[1].angle: l / 2 * (cos(rod[1].angle) * pushed(0.1)[1] - sin(rod[1].angle) * pushed(0.1)[0])
} }

#[test]
fn what_acts_on_bodies_is_what_it_does_in_their_coordinates() {
    let mut states = tests::Random::new(11);
    let mut bodies = Solver::new(Bodies::default(), SolverOptions::default());
    let mut coordinates = Solver::new(Coordinates::default(), SolverOptions::default());
    for _ in 0..50 {
        let state = at(&states.vector(6), &states.vector(6));
        let [first, second] = [&mut bodies, &mut coordinates].map(|solver| {
            let solution = solver.solve(state.t, &state.q, &state.v);
            let solution = solution.expect("a solution");
            [solution.acceleration, solution.nonideal_force]
        });
        for (first, second) in first.iter().zip(&second) {
            assert_all_close("accelerations and forces", first, second, 1e-10);
        }
        assert!(first[1].iter().any(|c| c.abs() > 0.1));
    }
}
