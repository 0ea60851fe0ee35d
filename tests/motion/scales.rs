//! A mechanism whose lengths are 1e-9 … 1e9 times as large, with gravity as much larger, moves as it did: runs at the default absolute
//! tolerance take the same steps but for rounding, whatever the coordinates are, and get to the same shapes.

use super::cells::{BodyCell, Cell};
use tests::{apart, at_rest};
use ukcore::model::StartOptions;
use ukcore::{Ensemble, Mechanism, Method, Prepared, Simulation, State, Trajectory};

ukcore::multibody! {
    /// A four-bar linkage of planar bodies.
    FourBar {
        params { s = 1.0 }
        let l = [0.5, 2.0, 1.5];
        gravity { [0, -9.81 * s] }
        bodies { for i in 0..3 { planar bar[i] { mass: 1, inertia: sq(l[i] * s) / 12, centre: [l[i] * s / 2, 0] } } }
        holonomic {
            o: pin(ground.at([0, 0]), bar[0].at([0, 0]))
            p: pin(bar[0].at([l[0] * s, 0]), bar[1].at([0, 0]))
            q: pin(bar[1].at([l[1] * s, 0]), bar[2].at([l[2] * s, 0]))
            r: pin(bar[2].at([0, 0]), ground.at([2 * s, 0]))
        }
        start go { bar[0].angle = 1.0; dot(bar[0].angle) = 6.0; bar[1].angle near 0.3; bar[2].angle near 1.4 }
        output { shape = bar[2].angle }
    }
}

ukcore::multibody! {
    /// A slider-crank by angles, with a slider without mass.
    SliderCrank {
        params { s = 1.0 }
        coords { x, a, b }
        mass { a: 0.01 * sq(s), b: 0.03 * sq(s) }
        force { x: -0.2 * s }
        holonomic {
            along: x = s * (0.1 * cos(a) + 0.3 * cos(b))
            across: 0.1 * s * sin(a) + 0.3 * s * sin(b) = 0
        }
        start go { a = 0.7; dot(a) = 10.0; b near -0.2; x near 0.4 * s }
        output { shape = x / s }
    }
}

ukcore::multibody! {
    /// A rigid body by a quaternion on a ball joint.
    Top {
        params { s = 1.0 }
        gravity { [0, 0, -9.81 * s] }
        bodies { spatial top { mass: 1, inertia: [0.09 * sq(s), 0.08 * sq(s), 0.05 * sq(s)] } }
        holonomic { o: ball(ground.at([0, 0, 0]), top.at([0, 0, s])) }
        start go { top.e0 = 0.9; top.e1 = 0.3; top.e2 near 0.1; top.e3 = 0.2; top.spin = [0.1, 0.7, 2.0] }
        output { shape = top.axes[0][0] }
    }
}

ukcore::multibody! {
    /// A pendulum of two points on rods: nothing turns that is a coordinate.
    Points {
        params { s = 1.0 }
        coords { p[2], r[2] }
        mass { p: 1.0, r: 0.5 }
        potential { 9.81 * s * (p[1] + 0.5 * r[1]) }
        holonomic { upper: sq(p) = sq(s), lower: sq(r - p) = sq(0.4 * s) }
        start go { p[0] near s; p[1] = 0.0; r[0] near s; r[1] near -0.3 * s }
        output { shape = atan2(r[1] - p[1], r[0] - p[0]) }
    }
}

ukcore::multibody! {
    /// A delta robot: arms of the tree, a platform by a quaternion, and rods between points of both.
    Delta {
        params { s = 1.0 }
        let dir = |i| [cos(2 * PI * i / 3), sin(2 * PI * i / 3), 0];
        let side = |i| [-sin(2 * PI * i / 3), cos(2 * PI * i / 3), 0];
        bodies {
            for i in 0..3 { spatial base[i] { mass: 0, inertia: [0, 0, 0] } }
            for i in 0..3 { spatial arm[i] { mass: 0.5, inertia: 0.01 * sq(s) * [1, 1, 1], centre: [0.15 * s, 0, 0] } }
            spatial top { mass: 1, inertia: 0.002 * sq(s) * [1, 1, 1.5] }
        }
        gravity { [0, 0, -9.81 * s] }
        tree { for i in 0..3 {
            foot[i]: weld(ground.at([0, 0, 0]), base[i].at([0, 0, 0]), rotz(2 * PI * i / 3))
            h[i]: hinge(base[i].at([0.2 * s, 0, 0]), arm[i].at([0, 0, 0]), [0, 1, 0])
        } }
        holonomic { for i in 0..3 {
            l[i]: rod(arm[i].at([0.3 * s, -0.04 * s, 0]), top.at(s * (0.05 * dir(i) - 0.04 * side(i))), 0.7 * s)
            r[i]: rod(arm[i].at([0.3 * s, 0.04 * s, 0]), top.at(s * (0.05 * dir(i) + 0.04 * side(i))), 0.7 * s)
        } }
        start go { top.centre = [0.03 * s, 0.05 * s, -0.6 * s]; for i in 0..3 { h[i].angle near 0.3 } }
        output { shape = h[0].angle }
    }
}

const SCALES: [f64; 8] = [1e-9, 1e-6, 1e-3, 0.1, 10.0, 1e3, 1e6, 1e9];

const RUNS: [(Method, f64); 6] = [
    (Method::Dop853, 1e-4),
    (Method::Dop853, 1e-9),
    (Method::Dopri5, 1e-6),
    (Method::Dopri5, 1e-8),
    (Method::Radau5, 1e-5),
    (Method::Radau5, 1e-7),
];

/// The mechanism that many times as large, and its start.
fn sized(mechanism: &Prepared, s: f64) -> (Prepared, State) {
    let name = mechanism.spec().name;
    let mechanism = mechanism.with_parameters(vec![s]);
    let start = mechanism.start("go", &StartOptions::new());
    let start = start.unwrap_or_else(|e| panic!("{name}, {s:e}: {e}"));
    (mechanism, start)
}

fn run(mechanism: &Prepared, s: f64, (method, tolerance): (Method, f64), until: f64) -> Trajectory {
    let name = mechanism.spec().name;
    let (mechanism, start) = sized(mechanism, s);
    let run = Simulation::new(mechanism).start(start).method(method);
    let run = run.tolerance(tolerance).every(0.05).until(until);
    run.unwrap_or_else(|e| panic!("{name}, {s:e}, {method}, {tolerance:e}: {e}"))
}

fn shape(run: &Trajectory) -> Vec<f64> {
    run.output("shape").expect("declared")
}

#[test]
fn runs_take_the_same_steps() {
    let cases = [
        (FourBar::default().prepared(), 2.0),
        (SliderCrank::default().prepared(), 2.0),
        (Top::default().prepared(), 2.0),
        (Points::default().prepared(), 2.0),
        (Cell::default().prepared(), 0.3),
        (BodyCell::default().prepared(), 0.3),
        (Delta::default().prepared(), 0.3),
    ];
    for (mechanism, until) in cases {
        for how in RUNS {
            let one = run(&mechanism, 1.0, how, until);
            for s in SCALES {
                let other = run(&mechanism, s, how, until);
                let name = format!("{}, {s:e}, {how:?}", mechanism.spec().name);
                let [a, b] = [one.work(), other.work()].map(|work| work.steps + work.rejected);
                assert!(a.abs_diff(b) <= 2, "{name}: {a} and {b} attempts");
                let [a_fallbacks, b_fallbacks] = [&one, &other].map(|run| run.work().fallbacks);
                assert_eq!(a_fallbacks, b_fallbacks, "{name}");
                let off = apart(&shape(&one), &shape(&other));
                // A step that rounding decides on changes the error, not its size.
                let bound = if a == b { 1e-9 } else { 10.0 * how.1 };
                assert!(off < bound, "{name}: {off:e}");
            }
        }
    }
}

/// Through the flat rhombus, in the branch in which the output goes on along its straight line.
#[test]
fn the_cell_passes_its_flat_position_at_any_size() {
    let reference = run(
        &BodyCell::default().prepared(),
        1.0,
        (Method::Dop853, 1e-12),
        2.0,
    );
    let methods = [
        (Method::Dop853, 1e-7),
        (Method::Dop853, 1e-9),
        (Method::Dopri5, 1e-7),
        (Method::Dopri5, 1e-11),
        (Method::Radau5, 1e-7),
    ];
    for mechanism in [Cell::default().prepared(), BodyCell::default().prepared()] {
        for how in methods {
            for s in [1e-9, 1e-6, 1e-2, 1.0, 1e3, 1e9] {
                let run = run(&mechanism, s, how, 2.0);
                let name = format!("{}, {s:e}, {how:?}", mechanism.spec().name);
                // Between the ends of steps states are as exact as these.
                for x in run.output("straight").expect("declared") {
                    let off = (x - 8.0 / 15.0).abs();
                    assert!(off < how.1.max(1e-9), "{name}: {off:e}");
                }
                let turns = shape(&run).into_iter().zip(shape(&reference));
                let off = turns.fold(0.0_f64, |most, (a, b)| most.max((a - b).sin().abs()));
                assert!(off < 1e3 * how.1 + 1e-8, "{name}: {off:e}");
            }
        }
    }
}

#[test]
fn members_of_an_ensemble_have_their_own_size() {
    let scales = [1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9];
    let members = scales.map(|s| {
        let member = FourBar { s };
        let (_, start) = sized(&member.prepared(), s);
        (member, start)
    });
    let members = Ensemble::new(members.to_vec()).tolerance(1e-8).until(2.0);
    let alone = run(
        &FourBar::default().prepared(),
        1.0,
        (Method::Dop853, 1e-8),
        2.0,
    );
    let alone = alone.last().expect("an end").q[FourBar::BAR_ANGLE[0]];
    for (s, member) in scales.into_iter().zip(members) {
        let member = member.unwrap_or_else(|e| panic!("{s:e}: {e}"));
        let angle = member.end.q[FourBar::BAR_ANGLE[0]];
        assert!((angle - alone).abs() < 1e-10, "{s:e}: {angle} and {alone}");
    }
}

ukcore::multibody! {
    /// Two oscillators that know nothing of each other, of which one swings `far` away.
    Apart {
        params { far = 0.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        potential { 0.5 * sq(x - far), 0.5 * sq(y) }
    }
}

ukcore::multibody! {
    /// Coordinates that know of each other by a potential, a force, a constraint, and what a constraint bears; and one that is by itself.
    Joined {
        coords { a, b, c, d, e, f, g, lone }
        mass { a: 1, b: 1, c: 1, d: 1, e: 1, f: 1, g: 1, lone: 1 }
        potential { 0.5 * sq(a - b), 0.5 * sq(lone) }
        force { c: -dot(d), g: -g }
        holonomic { wall: e = 0.0 }
        nonideal { f: -0.1 * abs(reaction(wall)) * dot(f) }
    }
}

#[test]
fn parts_are_what_no_equation_joins() {
    // a with b, c with d, e with f by what the wall bears, g and lone by themselves.
    assert_eq!(Joined::SPEC.structure.parts, [0, 0, 2, 2, 4, 4, 6, 7]);
}

#[test]
fn rounding_of_one_part_is_granted_to_no_other() {
    assert_eq!(Apart::SPEC.structure.parts, [0, 1]);
    for (far, method, tolerance) in [
        (1e9, Method::Dop853, 1e-12),
        (1e9, Method::Dopri5, 1e-11),
        (1e7, Method::Dop853, 1e-13),
    ] {
        let start = at_rest(&[far + 1.0, 1.0]);
        let run = Simulation::new(Apart { far }).start(start);
        let run = run.method(method).tolerance(tolerance).until(10.0);
        let run = run.expect("a motion");
        let end = run.last().expect("an end");
        let off = (end.q[1] - 10.0_f64.cos()).abs();
        assert!(
            off < 5.0 * tolerance,
            "{far:e}, {method}, {tolerance:e}: {off:e}"
        );
        assert!(run.work().rounded > 0, "{far:e}, {method}, {tolerance:e}");
    }
}

ukcore::multibody! {
    /// A parallelogram, so that some velocities are zero all the way, with a unit of time that is so many times as long.
    Paced {
        params { pace = 1.0 }
        gravity { [0, -9.81 * sq(pace)] }
        bodies {
            for i in 0..2 { planar crank[i] { mass: 1, inertia: 1 / 12.0, centre: [0.5, 0] } }
            planar coupler { mass: 2, inertia: 0.3 }
        }
        holonomic {
            for i in 0..2 {
                o[i]: pin(ground.at([i, 0]), crank[i].at([0, 0]))
                p[i]: pin(crank[i].at([1, 0]), coupler.at([i - 0.5, 0]))
            }
        }
        start go(speed = 0.0) { crank[0].angle = -0.4; dot(crank[0].angle) = speed; crank[1].angle near -0.4; coupler.angle near 0.0 }
    }
}

/// Nothing is said of velocities that are zero: they are known as the others are, in seconds as in microseconds.
#[test]
fn steps_do_not_depend_on_the_unit_of_time() {
    for speed in [0.0, 2.0] {
        let run = |pace: f64| {
            let mechanism = Paced { pace }.prepared();
            let start = mechanism
                .start("go", &[("speed", speed * pace)].into())
                .expect("a start");
            let run = Simulation::new(mechanism).tolerance(1e-11).start(start);
            run.at(vec![2.0 / pace]).until(2.0 / pace).expect("a run")
        };
        let usual = run(1.0);
        let angle = |run: &Trajectory| run.last().expect("a sample").q[2];
        for pace in [1e-3, 1e3, 1e6, 1e9] {
            let paced = run(pace);
            let (evaluations, most) = (paced.work().evaluations, usual.work().evaluations);
            assert!(
                2 * evaluations <= 3 * most,
                "{pace}: {evaluations} instead of {most}"
            );
            assert!((angle(&paced) - angle(&usual)).abs() < 1e-8, "{pace}");
        }
    }
}
