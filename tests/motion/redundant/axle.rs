//! A sled whose blade may not slip at either end of an axle that goes through its centre of mass, or all but does: what further rows say
//! of the angle is rounding alone, of terms that cancel, and no length that a radian would be worth.

use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Method, Prepared, Simulation, Solver, State};

ukcore::multibody! {
    /// As a body, its centre before the axle by a.
    Sled {
        params { a = 0.0, reach = 0.4 }
        bodies { planar sled { mass: 1, inertia: 0.2, centre: [a, 0] } }
        nonholonomic {
            left: inner(dot(sled.at([0, reach])), sled.along([0, 1])) = 0
            right: inner(dot(sled.at([0, -reach])), sled.along([0, 1])) = 0
        }
    }
}

ukcore::multibody! {
    /// With the angle first, so that lengths are compared with it, and the row at three points.
    Turned {
        params { a = 0.0, reach = 0.4 }
        coords { th, x, y }
        mass { th: 0.2, x: 1, y: 1 }
        let slip = |across| (dot(y) - (a * cos(th) + across * sin(th)) * dot(th)) * cos(th)
            - (dot(x) + (a * sin(th) - across * cos(th)) * dot(th)) * sin(th);
        nonholonomic { left: slip(reach) = 0, right: slip(-reach) = 0, between: slip(0.3 * reach) = 0 }
    }
}

ukcore::multibody! {
    /// The second formulation: one row, of the middle of the axle.
    Blade {
        params { a = 0.0 }
        coords { x, y, th }
        mass { x: 1, y: 1, th: 0.2 }
        nonholonomic { blade: dot(y) * cos(th) - dot(x) * sin(th) = a * dot(th) }
    }
}

/// Turning on the spot with the angular velocity w; the angle is coordinate `at`.
fn turning(at: usize, a: f64, w: f64) -> State {
    let mut v = vec![0.0; 3];
    v[at] = w;
    v[(at + 2) % 3] = a * w;
    tests::at(&[0.0; 3], &v)
}

/// Both forms, with the place of the angle.
fn forms(a: f64, reach: f64) -> [(Prepared, usize); 2] {
    let (sled, turned) = (Sled { a, reach }, Turned { a, reach });
    [(sled.prepared(), 2), (turned.prepared(), 0)]
}

#[test]
fn accelerations_are_none() {
    for reach in [1e-4, 0.4, 400.0] {
        for (sled, at) in forms(0.0, reach) {
            let mut solver = Solver::new(&sled, SolverOptions::default());
            for k in 0..200 {
                let mut state = turning(at, 0.0, 3.0);
                state.q[at] = 0.02 * f64::from(k) + 1e-7 * f64::from(k % 3);
                let mut out = [0.0; 3];
                let solved = solver.acceleration(0.0, &state.q, &state.v, &mut out);
                solved.unwrap_or_else(|error| panic!("{reach}, {k}: {error}"));
                let largest = tests::largest(&out);
                assert!(largest <= 1e-13 * reach.max(1.0), "{reach}, {k}: {out:?}");
            }
        }
    }
}

#[test]
fn motion_is_that_of_one_row() {
    for a in [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3] {
        for w in [3.0, -5.0, 0.7] {
            let blade = Simulation::new(Blade { a }).tolerance(1e-13);
            let blade = blade.start(turning(2, a, w)).until(4.0);
            let blade = blade.expect("one row");
            let right = blade.last().expect("an end").q;
            for (sled, at) in forms(a, 0.4) {
                for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
                    for tolerance in [1e-4, 1e-7, 1e-9, 1e-12] {
                        let name = format!("a = {a:e}, w = {w}, {at}, {method}, {tolerance:e}");
                        let run = Simulation::new(&sled).method(method).tolerance(tolerance);
                        let run = run.start(turning(at, a, w)).until(4.0);
                        let run = run.unwrap_or_else(|error| panic!("{name}: {error}"));
                        // Steps are a large part of a turn where a centre off the axle creeps about.
                        let allowed = 1e-11 + 1e2 * tolerance;
                        let found = run.last().expect("an end").q;
                        for i in 0..3 {
                            let off = (found[(at + 1 + i) % 3] - right[i]).abs();
                            assert!(off <= allowed, "{name}: {off:e}");
                        }
                    }
                }
            }
        }
    }
}
