//! Bodies: what acts on them does the power that the energy gains, and inertias that none has are refused.

use super::joints::{random_state, solved};
use tests::{Random, assert_close, at_rest, outputs};
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Simulation, Solver, State, assemble};

ukcore::multibody! {
    /// Two planar bodies and all that acts on them.
    Pushed {
        params { c = 0.7, k = 5.0 }
        bodies { planar a { mass: 1, inertia: 0.5, centre: [0.1, 0] } planar b { mass: 2, inertia: 0.7, centre: [0, 0.3] } }
        gravity { [0.3, -9.81] }
        forces {
            spring(a.at([1, 0]), b.at([0, 1]), k, 0.4)
            turning_spring(a, b, k, 0.2)
            damper(a.at([1, 0.2]), b.at([0.5, 1]), c)
            turning_damper(a, b, 2 * c)
            force(a.at([0.4, 0.1]), [t, -0.6])
            force(a.at([0, 0]), b.at([0, 0]), 1.5)
            torque(a, b, 0.8)
            torque(b, -0.3)
        }
        dissipation { 0.5 * c * sq(dot(a.at([0, 1]))) }
        output {
            damped = -c * sq(dot(norm(b.at([0.5, 1]) - a.at([1, 0.2])))) - 2 * c * sq(b.omega - a.omega) - c * sq(dot(a.at([0, 1])))
            driven = inner([t, -0.6], dot(a.at([0.4, 0.1]))) + 1.5 * dot(norm(b.at([0, 0]) - a.at([0, 0]))) + 0.8 * (b.omega - a.omega) - 0.3 * b.omega
        }
    }
}

ukcore::multibody! {
    /// Two spatial bodies and all that acts on them.
    Shoved {
        params { c = 0.7, k = 5.0 }
        bodies {
            spatial a { mass: 1, inertia: [1, 1.2, 1.4], centre: [0.1, 0, 0] }
            spatial b { mass: 2, inertia: [2, 2.2, 2.4, 0.1, -0.2, 0.3] }
        }
        gravity { [0.3, 0, -9.81] }
        forces {
            spring(a.at([1, 0, 0]), b.at([0, 1, 0]), k, 0.4)
            damper(a.at([1, 0.2, 0]), b.at([0.5, 1, 0]), c)
            turning_damper(a, b, 2 * c)
            force(a.at([0.4, 0.1, 0]), [t, -0.6, 0.2])
            torque(a, b, [0.8, 0, 0.1])
            torque(b, b.along([0, 0.3, 0]))
        }
        output {
            damped = -c * sq(dot(norm(b.at([0.5, 1, 0]) - a.at([1, 0.2, 0])))) - 2 * c * sq(b.omega - a.omega)
            driven = inner([t, -0.6, 0.2], dot(a.at([0.4, 0.1, 0]))) + inner([0.8, 0, 0.1], b.omega - a.omega) + 0.3 * b.spin[1]
        }
    }
}

/// The power of what acts, by forces times velocities, is the rate of the energy.
#[test]
fn power_of_forces_is_the_rate_of_the_energy() {
    fn check<M: Mechanism>(state: &State) {
        let solution = solved::<M>(state);
        let mechanism = M::default().prepared::<f64>();
        let energy = |h: f64| {
            let path = state.q.iter().zip(&state.v).zip(&solution.acceleration);
            let (q, v): (Vec<f64>, Vec<f64>) = path
                .map(|((q, v), a)| (q + h * (v + 0.5 * h * a), v + h * a))
                .unzip();
            mechanism.energy(state.t + h, &q, &v).total()
        };
        let h = 1e-4;
        // Of fourth order.
        let rate =
            (8.0 * (energy(h) - energy(-h)) - energy(2.0 * h) + energy(-2.0 * h)) / (12.0 * h);
        let power = outputs(&mechanism, state);
        assert_close(M::SPEC.name, rate, power[0] + power[1], 1e-7);
        assert!(power.iter().all(|p| p.abs() > 1e-3), "something acts");
    }
    let mut random = Random::new(12);
    for _ in 0..20 {
        check::<Pushed>(&random.state(6));
        check::<Shoved>(&random_state::<Shoved>(&mut random));
    }
}

ukcore::multibody! {
    /// Planar bodies pushed at places that move in them: where one touches something, and where a rope leaves a drum.
    Touched {
        bodies { planar a { mass: 1, inertia: 0.5, centre: [0.1, 0] } planar drum { mass: 2, inertia: 0.7, centre: [0, 0.3] } }
        forces {
            force(a.at(transpose(a.axes) * [0.2, -0.3 + 0.1 * drum.x]), [1.5, t])
            force(ground.at([0, 4]), drum.at(transpose(drum.axes) * [0.25, 0]), -2.0)
            damper(ground.at([0, -4]), drum.at(transpose(drum.axes) * [-0.2, 0]), 0.3)
        }
    }
}

ukcore::multibody! {
    /// The same by moments.
    TouchedByMoments {
        bodies { planar a { mass: 1, inertia: 0.5, centre: [0.1, 0] } planar drum { mass: 2, inertia: 0.7, centre: [0, 0.3] } }
        let rope = -2 * normalise(drum.at([0, 0]) + [0.25, -4]);
        let way = drum.at([0, 0]) + [-0.2, 4];
        let drag = -0.3 * dot(norm(way)) * normalise(way);
        forces {
            force(a.at([0, 0]), [1.5, t]) torque(a, cross([0.2, -0.3 + 0.1 * drum.x], [1.5, t]))
            force(drum.at([0, 0]), rope) torque(drum, cross([0.25, 0], rope))
            force(drum.at([0, 0]), drag) torque(drum, cross([-0.2, 0], drag))
        }
    }
}

/// A spatial body and one that hangs on it, with what acts on them.
macro_rules! rolled {
    ($name:ident, $($forces:tt)*) => {
        ukcore::multibody! {
            $name {
                bodies {
                    spatial a { mass: 1, inertia: [1, 1.2, 1.4], centre: [0.1, 0, 0] }
                    spatial b { mass: 2, inertia: [2, 2.2, 2.4, 0.1, -0.2, 0.3], centre: [0, 0.2, 0] }
                }
                tree { h: hinge(a.at([0.3, 0.1, -0.2]), b.at([-0.2, 0.3, 0.1]), [1, 2, -2]) }
                forces { $($forces)* }
            }
        }
    };
}

// Pushed at places that move in them, and the same by moments.
rolled! {
    Rolled,
    force(a.at(transpose(a.axes) * [0, 0, -0.3]), [1.5, t, 0.4])
    force(b.at(transpose(b.axes) * [0, 0.1, -0.2]), [-0.3, 0.2, 0.7])
}
rolled! {
    RolledByMoments,
    force(a.at([0, 0, 0]), [1.5, t, 0.4]) torque(a, cross([0, 0, -0.3], [1.5, t, 0.4]))
    force(b.at([0, 0, 0]), [-0.3, 0.2, 0.7]) torque(b, cross([0, 0.1, -0.2], [-0.3, 0.2, 0.7]))
}

#[test]
fn forces_act_on_the_point_of_the_body_that_is_there() {
    fn same<M: Mechanism, N: Mechanism>(state: &State) {
        let [found, expected] =
            [solved::<M>(state), solved::<N>(state)].map(|solution| solution.acceleration);
        let name = M::SPEC.name;
        let pairs = found.iter().zip(&expected);
        pairs.for_each(|(found, expected)| assert_close(name, *found, *expected, 1e-12));
    }
    let mut random = Random::new(13);
    for _ in 0..20 {
        same::<Touched, TouchedByMoments>(&random.state(6));
        same::<Rolled, RolledByMoments>(&random_state::<Rolled>(&mut random));
    }
}

ukcore::multibody! {
    /// A body whose inertia its parameters decide.
    pub Weighed {
        params { m = 1.0, principal[3] = [1.0, 1.2, 1.4], tensor[3][3] = [[2.0, 0.1, 0.2], [0.1, 3.0, 0.3], [0.2, 0.3, 4.0]] }
        bodies { spatial first { mass: m, inertia: principal } spatial second { mass: m, inertia: tensor } }
    }
}

#[test]
fn inertia_of_no_rigid_body_is_refused_by_name() {
    let check = |change: &dyn Fn(&mut Weighed), message: &str| {
        let mut mechanism = Weighed::default();
        change(&mut mechanism);
        let mut state = at_rest(&[0.0; 14]);
        (state.q[3], state.q[10]) = (1.0, 1.0);
        let solved =
            Solver::new(mechanism.clone(), SolverOptions::default()).solve(0.0, &state.q, &state.v);
        let run = Simulation::new(mechanism.clone())
            .start(state.clone())
            .until(0.1);
        let errors = [
            solved.map(drop).map_err(|e| e.to_string()),
            assemble(mechanism, &state, &[])
                .map(drop)
                .map_err(|e| e.to_string()),
            run.map(drop).map_err(|e| e.to_string()),
        ];
        for found in errors {
            match found {
                Ok(()) => assert_eq!(message, ""),
                Err(found) => assert!(!message.is_empty() && found.contains(message), "{found}"),
            }
        }
    };
    check(&|_| (), "");
    // A flat body.
    check(&|w| w.principal = [1.0, 2.0, 3.0], "");
    check(
        &|w| w.principal = [1.0, 2.0, 3.1],
        "`inertia` of `first` is that of no rigid body",
    );
    check(
        &|w| w.principal[1] = -1.0,
        "`inertia` of `first` is that of no rigid body",
    );
    check(
        &|w| w.tensor[0][1] = 0.2,
        "`inertia` of `second` must be a symmetric matrix",
    );
    check(
        &|w| (w.tensor[0][1], w.tensor[1][0]) = (2.6, 2.6),
        "`inertia` of `second` is that of no rigid body",
    );
    check(
        &|w| w.m = 0.0,
        "`mass` of `first` is 0; it must be positive",
    );
}

/// The name of a body holds all its coordinates; a value, which is of one kind, is for alike coordinates alone.
#[test]
fn the_name_of_a_body_means_its_coordinates() {
    let spec = Pushed::SPEC;
    assert_eq!(spec.coordinates_of("b"), Ok(vec![3, 4, 5]));
    assert_eq!(spec.coordinates_of("b.angle"), Ok(vec![5]));
    assert!(spec.coordinates_of("c").is_err());
    assert!(spec.coordinate_indices("b").is_err());
    assert!(State::guess::<Pushed>(&[("b", 1.0)]).is_err());
    let mut guess = State::zeros::<Pushed>();
    guess.q = vec![1.0, 2.0, 0.3, 4.0, 5.0, 0.6];
    let held = assemble(Pushed::default(), &guess, &["a", "b"]).expect("nothing is in the way");
    assert_eq!(held.q, guess.q);
}
