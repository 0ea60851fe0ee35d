//! Apexes of cones, where the one row of A vanishes: a motion goes round beside them, and one that meets them ends there with the
//! constraint's name.

use super::{METHODS, named, simulation, tolerances};
use tests::{at, cause, worst};
use ukcore::{Ensemble, Error, Method, Simulation, State};

ukcore::multibody! {
    /// A point on a cone, free of forces unless it is heavy.
    pub(crate) Cone {
        params { g = 0.0 }
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        potential { g * z }
        holonomic { cone: sq(x) + sq(y) = sq(z) }
    }
}

/// On the unrolled cone the motion is a straight line.
#[test]
fn beside_an_apex_the_motion_swings_round_and_in_it_the_cone_is_named() {
    for method in METHODS {
        for miss in [1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11] {
            let place = format!("{method}, {miss:e}");
            let v = [-1.3, miss, 1.3];
            let run = simulation(Cone::default(), &[1.0, 0.0, -1.0], &v, method, 1e-9);
            let run = run.until(2.0);
            let run = run.unwrap_or_else(|failure| panic!("{place}: {failure}"));
            let square: f64 = v.iter().map(|v| v * v).sum();
            let off = worst(&run, |s| {
                let (far, t): (f64, f64) = (2.0_f64.sqrt() * -s.q[2], s.t);
                let exact = (2.0 - 2.0 * 2.6 * t + square * t * t).max(0.0).sqrt();
                (far - exact).abs()
            });
            assert!(off < 1e-6, "{place}: {off:e}");
        }
        for v in [[-0.78, -1.04, 1.3], [-1.2, -1.6, 2.0]] {
            let run = simulation(Cone::default(), &[0.6, 0.8, -1.0], &v, method, 1e-9);
            named(&run.until(2.0).expect_err("an apex"), "cone", 1.0 / v[2]);
        }
    }
}

/// A heavy point goes up its cone along a line, over the apex and back, or turns well before it. Both passages may lie in one step, at
/// whose ends the row is as if there had been none.
#[test]
fn a_motion_over_an_apex_and_back_is_named() {
    for method in METHODS {
        for &tolerance in tolerances(method) {
            for (from, g) in [
                (0.5, 9.81),
                (1.0, 9.81),
                (0.55, 5.0),
                (2.0, 9.81),
                (1.0, 0.7),
            ] {
                let tops = [-0.5, -0.1, 0.03, 0.1, 0.25, 0.6, 2.0];
                let all = tops.into_iter().flat_map(|top| [(top, true), (top, false)]);
                for (top, samples) in all {
                    let speed = f64::sqrt(g * (from + from * top));
                    let mut run = simulation(
                        Cone { g },
                        &[-from, 0.0, -from],
                        &[speed, 0.0, speed],
                        method,
                        tolerance,
                    );
                    if !samples {
                        run = run.at(vec![]);
                    }
                    let place = format!("{method}, {tolerance:e}: {g} from {from} to {top}");
                    let way = |t: f64| -from + speed * t - 0.25 * g * t * t;
                    match run.until(4.0 * speed / g) {
                        Ok(run) => {
                            assert!(top < 0.0, "{place}: goes on");
                            let end = run.last().expect("an end");
                            assert!((end.q[0] - way(end.t)).abs() < 1e-6, "{place}");
                        }
                        Err(failure) => {
                            let apex = (speed - f64::sqrt(speed * speed - g * from)) * 2.0 / g;
                            named(&failure, "cone", apex);
                            assert!(top > 0.0, "{place}: {failure}");
                        }
                    }
                }
            }
        }
    }
}

/// Thrown up along a line of the cone with z̈ = −2: z = −1 + 2 c t − t² comes to rest in the apex for c = 1, and falls back before it for
/// less.
#[test]
fn rest_in_an_apex_is_named_and_rest_before_it_is_not() {
    let methods = [Method::Dop853, Method::Dopri5, Method::Radau5];
    for method in methods {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let run = |c: f64| {
                let v = [-1.2 * c, -1.6 * c, 2.0 * c];
                let cone = Cone { g: 4.0 };
                simulation(cone, &[0.6, 0.8, -1.0], &v, method, tolerance).until(2.0)
            };
            named(&run(1.0).expect_err("rest in an apex"), "cone", 1.0);
            for before in [0.5, 0.3, 0.1] {
                let c = f64::sqrt(1.0 - before);
                let run = run(c);
                let place = format!("{method}, {tolerance:e}, {before:e}");
                let run = run.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                let off = worst(&run, |s| (s.q[2] + 1.0 - 2.0 * c * s.t + s.t * s.t).abs());
                assert!(off < 1e2 * tolerance + 1e-8, "{place}: {off:e}");
            }
        }
    }
}

ukcore::multibody! {
    /// A point on a cone with the potential k u² (u − b) of u = z + 1: along a line from u = 0 it moves as u̇² = k u² (b − u), so
    /// u = b sech²(√(k b) t / 2) comes to rest at u = b, in the apex for b = 1.
    pub Hill {
        params { k = 4.0, b = 1.0 }
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        potential { k * sq(z + 1.0) * (z + 1.0 - b) }
        holonomic { cone: sq(x) + sq(y) = sq(z) }
    }
}

/// As a run of its own, a member is looked at wherever it comes to rest, though its rows have not changed for long.
#[test]
fn members_of_an_ensemble_end_at_rest_in_an_apex() {
    for tolerance in [1e-6, 1e-9] {
        let members = [1.0, 0.9].map(|b: f64| {
            let hill = Hill {
                b,
                ..Hill::default()
            };
            let u = b / (1.5 * (hill.k * b).sqrt()).cosh().powi(2);
            let (z, v) = (u - 1.0, u * (hill.k * (b - u)).sqrt());
            let start = State {
                t: -3.0,
                q: vec![-0.6 * z, -0.8 * z, z],
                v: vec![-0.6 * v, -0.8 * v, v],
            };
            (hill, start)
        });
        let alone = Simulation::new(Hill::default()).tolerance(tolerance);
        let alone = alone.start(members[0].1.clone()).until(0.5);
        named(&alone.expect_err("rest in an apex"), "cone", 1e-2);
        let ends = Ensemble::new(members.to_vec()).tolerance(tolerance);
        let [rests, turns] = <[_; 2]>::try_from(ends.until(0.5)).expect("two members");
        let rests = rests.expect_err("rest in an apex");
        let (t, source) = cause(&rests);
        assert!(t <= 1e-2 && matches!(source, Error::Singular { .. }));
        let end = turns.expect("it turns before the apex").end;
        let u = 0.9 / (0.25 * f64::sqrt(3.6)).cosh().powi(2);
        let off = (end.q[2] + 1.0 - u).abs();
        assert!(off < 1e3 * tolerance, "{tolerance:e}: {off:e}");
    }
}

/// Lanes look for rows that vanish as a run of its own does.
#[test]
fn members_of_an_ensemble_end_before_apexes() {
    let cones = [[-1.3, 0.1, 1.3], [-1.3, 0.0, 1.3]];
    let cones = cones.map(|v| (Cone::default(), at(&[1.0, 0.0, -1.0], &v)));
    let [beside, through] = <[_; 2]>::try_from(Ensemble::new(cones.to_vec()).until(2.0))
        .unwrap_or_else(|_| panic!("two members"));
    assert!(beside.is_ok(), "{beside:?}");
    let error = through.expect_err("an apex");
    assert!(matches!(cause(&error).1, Error::Singular { .. }), "{error}");
}
