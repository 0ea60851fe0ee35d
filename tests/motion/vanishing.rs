//! Rows of A that vanish by themselves, where a constraint has no gradient: in the node of a curve the motion goes straight on, beside it
//! it turns with its own branch, and where it could go on in many ways the run ends with the constraint's name.

pub(crate) mod apexes;

use tests::{apart, at, cause, largest, worst};
use ukcore::{Ensemble, Error, Method, Prepared, Simulation};

ukcore::multibody! {
    /// A bead on Cassini's oval: a lemniscate for e = 0, two loops for e < 0, one for e > 0.
    Oval {
        params { e = 0.0 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        holonomic { oval: sq(sq(x) + sq(y)) = sq(x) - sq(y) + e }
    }
}

ukcore::multibody! {
    /// The lines a + b = 2 π k and a − b = π (2 k + 1) in one row.
    Sines {
        params { g = 1.0 }
        coords { a, b }
        mass { a: 1.0, b: 1.0 }
        potential { g * sin(a) }
        holonomic { lines: sin(a) + sin(b) = 0.0 }
    }
}

ukcore::multibody! {
    /// The first branch of these by itself.
    Sine { coords { a } mass { a: 2.0 } potential { sin(a) } }
}

ukcore::multibody! {
    /// Appell's constraint, nonlinear in velocities, with a force to the side.
    Appell {
        params { g = 10.0, f = 0.0 }
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        potential { g * z }
        force { y: f }
        nonholonomic { appell: sq(dot(x)) + sq(dot(y)) = sq(dot(z)) }
    }
}

ukcore::multibody! {
    /// A row that says nothing for the moment in which x is zero.
    Moment { coords { x, y } mass { x: 1.0, y: 1.0 } force { y: 1.0 } nonholonomic { moment: x * dot(y) = 0.0 } }
}

ukcore::multibody! {
    /// Crank and rod of length 1 whose slider stays on a line, in their angles; a force pulls it along. With b = −a the slider is at
    /// 2 cos a; at the bearing the row vanishes, and rod and crank may turn as one. Their joint has a weight.
    Rods {
        params { mass = 1.0, force = 1.0, weight = 0.0 }
        coords { a, b }
        mass { a: 1.0, b: mass }
        potential { -force * (cos(a) + cos(b)), weight * sin(a) }
        holonomic { slider: sin(a) + sin(b) = 0.0 }
    }
}

const METHODS: [Method; 4] = [
    Method::Dop853,
    Method::Dopri5,
    Method::Radau5,
    Method::Rattle { step: 5e-3 },
];

fn simulation(
    mechanism: impl Into<Prepared>,
    q: &[f64],
    v: &[f64],
    method: Method,
    tolerance: f64,
) -> Simulation {
    Simulation::new(mechanism)
        .start(at(q, v))
        .method(method)
        .tolerance(tolerance)
        .max_steps(100_000)
        .every(0.013)
}

fn tolerances(method: Method) -> &'static [f64] {
    match method {
        Method::Rattle { .. } => &[1e-9],
        _ => &[1e-4, 1e-7, 1e-9, 1e-11],
    }
}

/// A bead without forces has gone once round the lemniscate, of length 2 ϖ = Γ(1/4)²/√(2π), when it is back. It goes up at both ends.
#[test]
fn a_bead_goes_straight_on_through_a_node() {
    let length = 5.244_115_108_584_24;
    for method in METHODS {
        for &tolerance in tolerances(method) {
            for speed in [2.1, 3.3, 4.7, 7.97] {
                let place = format!("{method}, {tolerance:e}, {speed}");
                let rattle = matches!(method, Method::Rattle { .. });
                let bound = if rattle { 1e-4 } else { 3e3 * tolerance + 1e-7 };
                for (rounds, side) in [(0.5, -1.0), (1.0, 1.0), (2.5, -1.0)] {
                    let run = simulation(
                        Oval::default(),
                        &[1.0, 0.0],
                        &[0.0, speed],
                        method,
                        tolerance,
                    );
                    let run = run.until(rounds * length / speed);
                    let run = run.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                    let end = run.last().expect("an end");
                    let off = [
                        end.q[0] - side,
                        end.q[1],
                        end.v[0] / speed,
                        end.v[1] / speed - 1.0,
                    ];
                    let off = largest(&off);
                    assert!(off < bound, "{place}, {rounds} rounds: {off:e}");
                }
            }
        }
    }
}

#[test]
fn one_row_with_two_branches_is_passed_in_the_first() {
    for method in METHODS {
        for &tolerance in tolerances(method) {
            for k in 0..8 {
                let speed = 2.3 + 0.71 * f64::from(k);
                let place = format!("{method}, {tolerance:e}, {speed}");
                let run = simulation(
                    Sines::default(),
                    &[0.3, -0.3],
                    &[speed, -speed],
                    method,
                    tolerance,
                );
                let run = run.until(8.0);
                let run = run.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                let off = worst(&run, |s| (s.q[0] + s.q[1]).abs());
                let drift = run.energy_drift();
                assert!(
                    off < 1e-8 && drift < 3e3 * tolerance + 1e-6,
                    "{place}: {off:e}, {drift:e}"
                );
            }
        }
    }
}

/// Nothing or little acts, so that a step may go over many nodes, and the row is at its end as it was at its start.
#[test]
fn samples_of_steps_over_many_nodes_are_those_of_the_motion() {
    let run = |mechanism: Prepared, [q, v]: [&[f64]; 2], (method, tolerance, end)| {
        let simulation = simulation(mechanism, q, v, method, tolerance);
        simulation.every(0.1).until(end)
    };
    for method in [Method::Dop853, Method::Dopri5] {
        for tolerance in [1e-3, 1e-4, 1e-6] {
            for k in 0..12 {
                let speed = 0.8 + 0.77 * f64::from(k);
                for end in [8.0, -8.0] {
                    let place = format!("{method}, {tolerance:e}, {speed}, {end}");
                    let start = [&[0.5, -0.5][..], &[speed, -speed]];
                    let free = Prepared::from(&Sines { g: 0.0 });
                    let samples = run(free, start, (method, tolerance, end));
                    let samples = samples.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                    let off = worst(&samples, |s| {
                        let a = 0.5 + speed * s.t;
                        largest(&[s.q[0] - a, s.q[1] + a, s.v[0] - speed, s.v[1] + speed])
                    });
                    assert!(off < 1e-7, "{place}: {off:e}");
                }
                if k == 0 {
                    continue;
                }
                let place = format!("{method}, {tolerance:e}, {speed}, pulled");
                let pulled = Prepared::from(&Sines { g: 1.0 });
                let start = [&[0.5, -0.5][..], &[speed, -speed]];
                let samples = run(pulled, start, (method, tolerance, 8.0));
                let samples = samples.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                let alone = Prepared::from(&Sine::default());
                let alone = run(alone, [&[0.5], &[speed]], (Method::Dop853, 1e-11, 8.0));
                let alone = alone.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                for (sample, alone) in samples.samples().zip(alone.samples()) {
                    let off = (sample.q[0] - alone.q[0]).abs();
                    assert!(off < 1e3 * tolerance, "{place}, {}: {off:e}", sample.t);
                    let off = (sample.q[0] + sample.q[1]).abs();
                    assert!(off < 1e-8, "{place}, {}: {off:e}", sample.t);
                }
            }
        }
    }
}

#[test]
fn beside_a_node_the_bead_turns_with_its_branch() {
    for method in METHODS {
        for &tolerance in tolerances(method) {
            for e in [1e-3, 1e-6, 1e-9, 1e-12, -1e-3, -1e-6, -1e-9, -1e-12] {
                let place = format!("{method}, {tolerance:e}, e = {e:e}");
                let far = f64::sqrt(0.5 + f64::sqrt(0.25 + e));
                let run = simulation(Oval { e }, &[far, 0.0], &[0.0, 3.0], method, tolerance);
                let run = run.until(4.0);
                let run = run.unwrap_or_else(|failure| panic!("{place}: {failure}"));
                let samples: Vec<_> = run.samples().collect();
                // One loop has x or y change its sign, not both at once; each of two its own side.
                let jumps = samples.windows(2).filter(|pair| {
                    let [old, new] = [pair[0].q, pair[1].q];
                    match e > 0.0 {
                        true => old[0] * new[0] < 0.0 && old[1] * new[1] < 0.0,
                        false => new[0] < 0.0,
                    }
                });
                assert_eq!(jumps.count(), 0, "{place}");
            }
        }
    }
}

/// `failure` is for the constraint called `name`, not after `t`.
fn named(failure: &ukcore::simulate::Failure, name: &str, t: f64) {
    let (found, Error::Singular { constraints }) = cause(&failure.error) else {
        panic!("{failure}")
    };
    assert_eq!(constraints, &[name], "{failure}");
    let last = failure.trajectory.last().expect("it has begun").t;
    assert!(found <= t && last <= t, "{failure}");
}

/// Thrown up, a point under Appell's constraint is at rest for a moment, and may leave in any direction.
#[test]
fn a_constraint_that_rest_leaves_without_gradient_is_named() {
    let methods = [Method::Dop853, Method::Dopri5, Method::Radau5];
    for method in methods {
        let run = |f: f64| {
            let appell = Appell {
                f,
                ..Appell::default()
            };
            simulation(appell, &[0.0; 3], &[3.0, 4.0, 5.0], method, 1e-9).until(2.0)
        };
        // v = (5 − g t / 2) (0.6, 0.8, 1).
        let failure = run(0.0).expect_err("rest");
        named(&failure, "appell", 1.0);
        let off = worst(&failure.trajectory, |s| (s.v[2] - 5.0 + 5.0 * s.t).abs());
        assert!(off < 1e-7, "{method}: {off:e}");
        // Up to it all is told, however long steps are and wherever they end.
        for k in 0..40 {
            let (share, tolerance) = (
                0.6 + 0.03 * f64::from(k),
                [1e-4, 1e-7, 1e-10][k as usize % 3],
            );
            let v = [3.0, 4.0, 5.0].map(|v| share * v);
            let thrown = simulation(Appell::default(), &[0.0; 3], &v, method, tolerance);
            let failure = thrown.until(2.0).expect_err("rest");
            named(&failure, "appell", share);
            let last = failure.trajectory.last().expect("it has begun").t;
            assert!(last > (1.0 - 2e-4) * share, "{method}, {share}: {last}");
        }
        // Pushed aside it is never at rest.
        let swung = run(0.1).unwrap_or_else(|failure| panic!("{method}: {failure}"));
        let rows = worst(&swung, |s| (s.v[0].hypot(s.v[1]) - s.v[2].abs()).abs());
        assert!(
            rows < 1e-9 && swung.samples().all(|s| s.v[2] != 0.0),
            "{method}: {rows:e}"
        );
    }
}

#[test]
fn a_row_that_vanishes_with_its_factor_is_passed() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        let run = simulation(Moment::default(), &[-1.0, 0.0], &[1.0, 0.0], method, 1e-9).until(2.5);
        let run = run.unwrap_or_else(|failure| panic!("{method}: {failure}"));
        let off = worst(&run, |s| (s.q[0] - s.t + 1.0).abs().max(s.q[1].abs()));
        assert!(off < 1e-8, "{method}: {off:e}");
    }
}

/// From rest at or beside the bearing, `off` from there, the slider swings out and comes back to rest as near to it. Where a run does not
/// tell in which branch it goes on it says so, before a sample is wrong.
#[test]
fn returns_to_rest_at_a_singular_position_keep_their_branch_or_are_refused() {
    let methods = [
        (Method::Rattle { step: 1e-3 }, 1e-9),
        (Method::Rattle { step: 2e-3 }, 1e-9),
        (Method::Dop853, 1e-3),
        (Method::Dop853, 1e-7),
        (Method::Dopri5, 1e-5),
    ];
    let offs = [0.0, 1e-10, 3e-9, 3e-8, 4e-8, 6e-8, 7e-8, 1e-7, 1e-3, 1e-2];
    let offs = offs.iter().flat_map(|off| [*off, -off]);
    let (mut passed, mut wrong) = (0, Vec::new());
    for (method, tolerance) in methods {
        for (mass, force) in [(1.0 / 3.0, 1.0), (1.0 / 3.0, -1.0), (2.0, 1.0), (2.0, -1.0)] {
            for off in offs.clone() {
                let a = std::f64::consts::FRAC_PI_2 + off;
                let rods = Rods {
                    mass,
                    force,
                    ..Rods::default()
                };
                let run = simulation(rods, &[a, -a], &[0.0; 2], method, tolerance).until(5.2);
                passed += usize::from(run.is_ok());
                let run = run.unwrap_or_else(|failure| *failure.trajectory);
                let apart = worst(&run, |s| (s.q[0] + s.q[1]).abs());
                if apart > f64::max(1e-4, 10.0 * tolerance) {
                    let place = format!("{method}, {tolerance:e}, {mass}, {force}, {off:e}");
                    wrong.push(format!("{place}: {apart:e}"));
                }
            }
        }
    }
    assert!(wrong.is_empty() && passed >= 70, "{passed}, {wrong:#?}");
}

/// A motion from rest beside the bearing goes over it soon, and has come over it before: what tells one passage from the other is not how
/// it came there. It goes on with b = −a.
#[test]
fn starts_at_rest_beside_a_singular_position_keep_their_branch_or_are_refused() {
    let starts = [
        (Method::Dopri5, 1e-12, 0.154, 0.0792, 1.25e-10),
        (Method::Dop853, 1e-10, 0.122, -0.1026, -4.639e-6),
        (Method::Dop853, 1e-8, 0.213, -0.0266, -4.855e-6),
    ];
    let starts = [0.9, 1.0, 1.1].map(|part| starts.map(|start| (part, start)));
    for (part, (method, tolerance, mass, force, off)) in starts.into_iter().flatten() {
        let a = std::f64::consts::FRAC_PI_2 + part * off;
        let weight = 9.81;
        let rods = Rods {
            mass,
            force,
            weight,
        };
        let run = simulation(rods, &[a, -a], &[0.0; 2], method, tolerance).until(5.2);
        let place = format!("{method}, {tolerance:e}, {mass}, {force}, {part} x {off:e}");
        let run = run.unwrap_or_else(|failure| *failure.trajectory);
        let apart = worst(&run, |s| (s.q[0] + s.q[1]).abs());
        assert!(apart < 1e-6, "{place}: {apart:e}");
        // ½ (1 + mass) ȧ² + V is what it was.
        let potential = |a: f64| -2.0 * force * a.cos() + weight * a.sin();
        let off = worst(&run, |s| {
            let kinetic = 0.5 * (1.0 + mass) * s.v[0] * s.v[0];
            (kinetic + potential(s.q[0]) - potential(a)).abs()
        });
        assert!(off < 1e-6, "{place}: {off:e}");
    }
}

/// Lanes look for rows that vanish as a run of its own does, in nodes as in apexes.
#[test]
fn members_of_an_ensemble_pass_nodes() {
    let ovals = [2.1, 3.3, 4.7, 5.9, 7.97].map(|speed| {
        let start = at(&[1.0, 0.0], &[0.0, speed]);
        (Oval::default(), start)
    });
    let ends = Ensemble::new(ovals.to_vec()).until(2.0);
    for ((oval, start), member) in ovals.into_iter().zip(ends) {
        let alone = Simulation::new(oval).start(start).until(2.0);
        let alone = alone.unwrap_or_else(|failure| panic!("{failure}"));
        let end = alone.last().expect("an end");
        let member = member.unwrap_or_else(|error| panic!("{error}")).end;
        let pairs = member.q.iter().chain(&member.v);
        for (x, y) in pairs.zip(end.q.iter().chain(end.v)) {
            assert!((x - y).abs() < 1e-6, "{member:?}");
        }
    }
}

ukcore::multibody! {
    /// A four-bar linkage of bodies, of any size: rows of its pins have a length and a plain number for entries.
    Sized {
        params { l = 1.0 }
        let len = l * [0.5, 1.2, 1.0];
        bodies { for i in 0..3 { planar bar[i] { mass: 1, inertia: sq(len[i]) / 12, centre: [len[i] / 2, 0] } } }
        gravity { [0, -1] }
        holonomic {
            o: pin(ground.at([0, 0]), bar[0].at([0, 0]))
            p: pin(bar[0].at([len[0], 0]), bar[1].at([0, 0]))
            q: pin(bar[1].at([len[1], 0]), bar[2].at([len[2], 0]))
            r: pin(ground.at([1.1 * l, 0]), bar[2].at([0, 0]))
        }
        start down { bar[0].angle = 1.0; bar[0].omega = 0.0; bar[1].angle near 0.4; bar[2].angle near 1.5 }
    }
}

/// In millimetres, or for a bridge, a mechanism moves as in metres, at the same cost: the lever of a pin that goes through zero leaves a
/// row that is small beside what it was, and says what it did.
#[test]
fn lengths_in_any_unit_are_as_good() {
    let run = |l: f64| {
        let sized = Sized { l };
        let start = sized.start("down", &[].into()).expect("a start");
        let scale = l.sqrt();
        let run = Simulation::new(sized)
            .start(start)
            .tolerance(1e-10)
            .every(0.25 * scale)
            .until(5.0 * scale);
        let run = run.unwrap_or_else(|e| panic!("{l:e}: {e}"));
        let angle = run.coordinate("bar[2].angle").expect("declared");
        (angle, run.work().evaluations)
    };
    let (angle, evaluations) = run(1.0);
    for l in [1e-12, 1e-3, 1e2, 1e3, 1e4, 1e5, 1e12, 1e20] {
        let (other, work) = run(l);
        let off = apart(&angle, &other);
        assert!(off < 1e-9, "{l:e}: {off:e}");
        assert!(2 * work < 3 * evaluations, "{l:e}: {work} {evaluations}");
    }
}

ukcore::multibody! {
    /// A weight hangs from a string that goes through a hole in a table, to a puck.
    Hole {
        coords { x, y, z }
        mass { x: 1, y: 1, z: 2 }
        potential { 2 * 9.81 * z }
        holonomic { string: sqrt(sq(x) + sq(y)) - z = 2 }
        output { spin = x * dot(y) - y * dot(x) }
    }
}

/// A length that has come to zero does not get shorter: a motion that would have it so ends there, and does not creep on for ever.
#[test]
fn where_a_length_ends_so_does_the_motion() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for tolerance in [1e-2, 1e-5, 1e-8] {
            for spin in [0.0, 1e-3] {
                let run = Simulation::new(Hole::default())
                    .start(at(&[1.0, 0.0, -1.0], &[0.0, spin, 0.0]))
                    .method(method)
                    .tolerance(tolerance)
                    .until(1.5);
                match run {
                    Ok(run) => {
                        let found = run.output("spin").expect("declared");
                        let off = found.last().expect("an end") - spin;
                        assert!(spin > 0.0 && off.abs() < 10.0 * tolerance, "{off:e}");
                    }
                    Err(failure) => {
                        let steps = failure.trajectory.work().steps;
                        let told = failure.to_string();
                        assert!(spin == 0.0 && steps < 2000, "{spin}: {steps}, {told}");
                        assert!(told.contains("where `string` is implied"), "{told}");
                    }
                }
            }
        }
    }
}
