//! Rows of A that vanish together with copies of theirs, as over the apex of a cone that is told twice, and motions that turn just before.

use crate::vanishing::apexes::Cone;
use tests::{at, cause, worst};
use ukcore::{Error, Method, Prepared, Simulation};

ukcore::multibody! {
    /// A point on a cone that is told in other units beside it.
    Scaled {
        params { g = 0.0, k = 2.0 }
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        potential { g * z }
        holonomic { cone: sq(x) + sq(y) = sq(z), copy: k * (sq(x) + sq(y)) = k * sq(z) }
    }
}

ukcore::multibody! {
    /// The same, told by a function of it beside it, and a coordinate that is tied twice.
    Other {
        params { g = 0.0 }
        coords { x, y, z, w }
        mass { x: 1.0, y: 1.0, z: 1.0, w: 1.0 }
        potential { g * z }
        holonomic {
            copy: exp(sq(x) + sq(y) - sq(z)) = 1.0,
            tie: w = 3.0 * y,
            cone: sq(x) + sq(y) = sq(z),
            knot: exp(w) = exp(3.0 * y),
        }
    }
}

ukcore::multibody! {
    /// A bead on a lemniscate that is told twice.
    Oval {
        params { k = 3.0 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        holonomic { oval: sq(sq(x) + sq(y)) = sq(x) - sq(y), copy: k * sq(sq(x) + sq(y)) = k * (sq(x) - sq(y)) }
    }
}

ukcore::multibody! {
    /// A point on a cone, and one by itself on two lines that cross.
    Beside {
        params { g = 2.0 }
        coords { x, y, z, a, b }
        mass { x: 1.0, y: 1.0, z: 1.0, a: 1.0, b: 1.0 }
        potential { g * z }
        holonomic { cone: sq(x) + sq(y) = sq(z), cross: a * b = 0.0 }
    }
}

ukcore::multibody! {
    /// A row that fades, and one that vanishes where the lines of it cross, on one of which a point is held.
    Fading {
        coords { s, x, y }
        mass { s: 1.0, x: 1.0, y: 1.0 }
        holonomic { decay: sq(s) = exp(-t), product: x * y = 0.0, line: y = 0.0 }
    }
}

ukcore::multibody! {
    /// The cone, and a point that moves by itself.
    Accompanied {
        params { g = 2.0 }
        coords { x, y, z, p }
        mass { x: 1.0, y: 1.0, z: 1.0, p: 1.0 }
        potential { g * z }
        holonomic { cone: sq(x) + sq(y) = sq(z) }
    }
}

const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];

/// Thrown up along a line of a cone from (−from, 0, −from) with x = z = −from + u t − ½ (g/2) t², a point gets to the apex and further
/// for `top` > 0, and turns before it by that share of `from` for `top` < 0.
fn thrown(
    mechanism: impl Into<Prepared>,
    [from, g, top]: [f64; 3],
    (method, tolerance): (Method, f64),
) -> Result<(), String> {
    let mechanism = mechanism.into();
    let u = f64::sqrt(g * (from + from * top));
    let mut start = at(&[-from, 0.0, -from], &[u, 0.0, u]);
    start.q.resize(mechanism.spec().n(), 0.0);
    start.v.resize(mechanism.spec().n(), 0.0);
    let simulation = Simulation::new(mechanism).start(start).method(method);
    let run = (simulation
        .tolerance(tolerance)
        .max_steps(10_000)
        .every(0.013))
    .until(4.0 * u / g);
    let way = |t: f64| -from + u * t - 0.25 * g * t * t;
    match run {
        Ok(run) if top < 0.0 => {
            let off = worst(&run, |s| (s.q[0] - way(s.t)).abs());
            let bound = 1e2 * tolerance + 1e-8;
            (off < bound)
                .then_some(())
                .ok_or_else(|| format!("{off:e} off"))
        }
        Ok(_) => Err("goes on".to_owned()),
        Err(failure) if top < 0.0 => Err(failure.to_string()),
        Err(failure) => {
            let apex = (u - (u * u - g * from).sqrt()) * 2.0 / g;
            let end = failure.trajectory.last().expect("it has begun").t;
            let Error::Singular { constraints } = cause(&failure.error).1 else {
                return Err(failure.to_string());
            };
            let named = constraints.iter().any(|c| c == "cone" || c == "copy");
            (named && end <= apex)
                .then_some(())
                .ok_or_else(|| failure.to_string())
        }
    }
}

fn each(tops: &[f64], tolerances: &[f64]) {
    for method in METHODS {
        for &tolerance in tolerances {
            for [from, g] in [[0.5, 9.81], [1.0, 9.81], [0.55, 5.0], [1.0, 0.7]] {
                for &top in tops {
                    let how = (method, tolerance);
                    let one = thrown(Cone { g }, [from, g, top], how);
                    let scaled = Scaled {
                        g,
                        ..Scaled::default()
                    };
                    let scaled = thrown(scaled, [from, g, top], how);
                    let other = thrown(Other { g }, [from, g, top], how);
                    for (what, told) in [("one", one), ("scaled", scaled), ("other", other)] {
                        let place = format!("{what}, {method}, {tolerance:e}: {g} from {from}");
                        told.unwrap_or_else(|told| panic!("{place} to {top:e}: {told}"));
                    }
                }
            }
        }
    }
}

#[test]
fn an_apex_that_is_told_twice_ends_motions_over_it() {
    each(&[1e-6, 1e-3, 0.03, 0.25, 2.0], &[1e-4, 1e-7, 1e-10]);
}

#[test]
fn motions_that_turn_just_before_an_apex_go_on() {
    each(&[-0.5, -0.1, -0.03], &[1e-4, 1e-7, 1e-10]);
    each(&[-1e-3], &[1e-6, 1e-7, 1e-10]);
    each(&[-1e-4, -1e-5], &[1e-9, 1e-11]);
}

/// What a motion comes to rest in at the apex, nothing tells.
#[test]
fn motions_that_rest_in_an_apex_that_is_told_twice_end() {
    each(&[0.0], &[1e-4, 1e-7, 1e-10]);
}

#[test]
fn a_node_that_is_told_twice_is_passed() {
    let length = 5.244_115_108_584_24;
    for method in METHODS {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            for speed in [2.1, 4.7] {
                let start = at(&[1.0, 0.0], &[0.0, speed]);
                let simulation = Simulation::new(Oval::default()).start(start).method(method);
                let run = simulation.tolerance(tolerance).until(1.5 * length / speed);
                let place = format!("{method}, {tolerance:e}, {speed}");
                let run = run.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                let end = run.last().expect("an end");
                let off = (end.q[0] + 1.0).abs().max(end.q[1].abs());
                assert!(off < 1e3 * tolerance + 1e-7, "{place}: {off:e}");
            }
        }
    }
}

#[test]
fn a_crossing_is_passed_while_another_motion_turns_before_an_apex() {
    for method in METHODS {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            for (top, from) in [(1e-2, 1.3), (1e-2, 1.39), (3e-2, 1.37), (0.1, 1.2)] {
                let u = f64::sqrt(2.0 * (1.0 - top));
                let start = at(&[-1.0, 0.0, -1.0, -from, 0.0], &[u, 0.0, u, 1.0, 0.0]);
                let simulation = Simulation::new(Beside::default()).start(start);
                let run = simulation.method(method).tolerance(tolerance).until(2.5);
                let place = format!("{method}, {tolerance:e}, {top}, {from}");
                let run = run.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                let [off, aside] = [0, 1].map(|k| {
                    worst(&run, |s| match k {
                        0 => (s.q[0] + 1.0 - u * s.t + 0.5 * s.t * s.t).abs(),
                        _ => (s.q[3] + from - s.t).abs().max(s.q[4].abs()),
                    })
                });
                assert!(
                    off.max(aside) < 1e2 * tolerance + 1e-8,
                    "{place}: {off:e}, {aside:e}"
                );
            }
        }
    }
}

/// Another row has become small long since.
#[test]
fn a_crossing_is_passed_beside_a_row_that_has_faded() {
    for method in METHODS {
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            for from in [2.0, 4.0, 5.5] {
                let start = at(&[1.0, -from, 0.0], &[-0.5, 1.0, 0.0]);
                let simulation = Simulation::new(Fading::default()).start(start);
                let run = simulation.method(method).tolerance(tolerance).until(7.2);
                let place = format!("{method}, {tolerance:e}, {from}");
                let run = run.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                let off = worst(&run, |s| (s.q[1] + from - s.t).abs().max(s.q[2].abs()));
                assert!(off < 1e-8, "{place}: {off:e}");
            }
        }
    }
}

/// Steps are as long as they may be, for little else goes on.
#[test]
fn an_apex_ends_motions_over_it_and_back_whatever_else_moves() {
    for method in METHODS {
        for tolerance in [1e-3, 1e-4, 1e-6, 1e-9] {
            for top in [1e-3, 1e-2, 0.1, 0.5] {
                for speed in [0.0, 1.0, 20.0] {
                    let u = f64::sqrt(2.0 * (1.0 + top));
                    let start = at(&[-1.0, 0.0, -1.0, 0.0], &[u, 0.0, u, speed]);
                    let simulation = Simulation::new(Accompanied::default()).start(start);
                    let run = simulation.method(method).tolerance(tolerance).until(4.0);
                    let place = format!("{method}, {tolerance:e}, {top}, {speed}");
                    let failure = run.expect_err(&place);
                    let Error::Singular { constraints } = cause(&failure.error).1 else {
                        panic!("{place}: {failure}");
                    };
                    assert_eq!(constraints, &["cone"], "{place}");
                    let apex = u - f64::sqrt(u * u - 2.0);
                    let end = failure.trajectory.last().expect("it has begun").t;
                    assert!(end <= apex, "{place}: {end}");
                }
            }
        }
    }
}
