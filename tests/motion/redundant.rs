//! Rows that follow from others are left out of the straight line: motions of redundant mechanisms without one dense solve, accelerations
//! against eq. 19 on and off the constraints, and what must not be left out.

mod axle;
mod bennett;
mod door;
mod hinged;
mod kaleidocycle;
mod mechanisms;
mod mill;
mod sarrus;
mod sleigh;
mod small;
mod wheels;

use mechanisms::SpatialFourBar;
use models::{DoubleScottRussell, Model};
use tests::{Dense, Random, assert_all_close, at, largest, solver_by};
use ukcore::equations::up;
use ukcore::manifold::{Projector, Stabilisation};
use ukcore::simulate::Sample;
use ukcore::solver::{Formula, SolverOptions};
use ukcore::{Ensemble, Error, Mechanism, Prepared, Simulation, Solver, State};

/// The rank tolerance of eq. 19 as printed: below what independent rows keep in these mechanisms, above what drift of 1e-6 lends.
const RANK: f64 = 1e-4;

/// The mechanisms, each with a start and the time to run from there.
fn cases() -> Vec<(Prepared, State, f64)> {
    let (scott, bar) = (DoubleScottRussell::default(), SpatialFourBar::default());
    let turning = scott.default_start().expect("a start");
    vec![
        (scott.prepared(), turning, 2.0),
        (bar.prepared(), bar.at(1.0), 3.0),
    ]
}

/// Consistent states along each motion.
fn along(mechanism: &Prepared, start: &State, until: f64) -> Vec<State> {
    let run = Simulation::new(mechanism)
        .start(start.clone())
        .tolerance(1e-9)
        .every(until / 7.0)
        .until(until);
    let run = run.unwrap_or_else(|e| panic!("{e}"));
    run.samples().map(Sample::to_state).collect()
}

/// Eq. 19 as it is printed.
fn printed(mechanism: &Prepared, state: &State) -> Vec<f64> {
    let dense = Dense::of(mechanism, state);
    let force = &dense.force + &dense.nonideal;
    let found = up::acceleration(&dense.mass, &force, &dense.jacobian, &dense.rhs, RANK);
    found
        .expect("M and A determine the motion")
        .as_slice()
        .to_vec()
}

#[test]
fn whole_runs_without_a_dense_solve() {
    for (mechanism, start, until) in cases() {
        let name = mechanism.spec().name;
        let ukcore::mechanism::Energy {
            kinetic, potential, ..
        } = mechanism.energy(start.t, &start.q, &start.v);
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let run = Simulation::new(&mechanism)
                .start(start.clone())
                .tolerance(tolerance)
                .until(until);
            let run = run.unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(run.work().fallbacks, 0, "{name} at {tolerance:e}");
            let end = run.last().expect("an end");
            let ukcore::mechanism::Energy {
                kinetic: t,
                potential: v,
                ..
            } = mechanism.energy(end.t, end.q, end.v);
            let scale = kinetic.abs() + potential.abs() + t.abs() + v.abs();
            let off = (t + v - kinetic - potential).abs() / scale;
            assert!(
                off < 2e3 * tolerance,
                "{name} at {tolerance:e}: energy {off:e} off"
            );
            assert!(
                run.residuals().iter().all(|r| r.largest() < 1e-12),
                "{name}"
            );
        }
    }
}

#[test]
fn accelerations_are_those_of_eq_19() {
    let mut random = Random::new(5);
    for (mechanism, start, until) in cases() {
        let name = mechanism.spec().name;
        let states = along(&mechanism, &start, until);
        let mut solver = Solver::new(&mechanism, SolverOptions::default());
        for state in &states {
            let expected = printed(&mechanism, state);
            let scale = 1.0 + largest(&expected);
            let mut found = vec![0.0; expected.len()];
            let certificate = mechanism.acceleration(state.t, &state.q, &state.v, &mut found);
            assert!(
                certificate > 0.0 && certificate < 1.0,
                "{name}: {certificate}"
            );
            assert_all_close(name, &found, &expected, 1e-9 * scale);
            for off in [0.0, 1e-12, 1e-10, 1e-8, 1e-6] {
                let mut near = state.clone();
                for x in near.q.iter_mut().chain(&mut near.v) {
                    *x += off * random.signed();
                }
                (solver.acceleration(near.t, &near.q, &near.v, &mut found))
                    .unwrap_or_else(|e| panic!("{name}, {off:e} off: {e}"));
                assert_all_close(name, &found, &expected, (1e-9 + 1e5 * off) * scale);
                mechanism.acceleration(near.t, &near.q, &near.v, &mut found);
                assert_all_close(name, &found, &expected, (1e-9 + 1e5 * off) * scale);
            }
        }
    }
}

#[test]
fn states_off_the_constraints_are_projected_by_the_straight_line() {
    let mut random = Random::new(6);
    for (mechanism, start, until) in cases() {
        let name = mechanism.spec().name;
        let mut projector = Projector::new(&mechanism);
        for state in along(&mechanism, &start, until) {
            for off in [1e-10, 1e-6, 1e-3] {
                let (mut q, mut v) = (state.q.clone(), state.v.clone());
                for x in q.iter_mut().chain(&mut v) {
                    *x += off * random.signed();
                }
                let before = q.clone();
                let position = projector.position(state.t, &mut q, &v);
                let position = position.unwrap_or_else(|e| panic!("{name}: {e}"));
                let velocity = projector.velocity(state.t, &q, &mut v);
                let velocity = velocity.unwrap_or_else(|e| panic!("{name}: {e}"));
                assert!(
                    position.residual < 1e-13 && velocity.residual < 1e-12,
                    "{name}"
                );
                let change: Vec<f64> = q.iter().zip(&before).map(|(a, b)| a - b).collect();
                assert!(
                    largest(&change) < 4.0 * off,
                    "{name}: {:e}",
                    largest(&change)
                );
            }
        }
    }
}

#[test]
fn lanes_leave_the_same_rows_out() {
    let members: Vec<_> = (0..11)
        .map(|k| {
            let member = DoubleScottRussell {
                k: 500.0 + 20.0 * f64::from(k),
                ..DoubleScottRussell::default()
            };
            let start = member.default_start().expect("a start");
            (member, start)
        })
        .collect();
    let results = Ensemble::new(members.clone()).tolerance(1e-9).until(0.5);
    for ((mechanism, start), result) in members.into_iter().zip(results) {
        let member = result.unwrap_or_else(|e| panic!("{e}"));
        let alone = Simulation::new(mechanism)
            .start(start)
            .tolerance(1e-9)
            .until(0.5);
        let alone = alone.unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(member.work.fallbacks, 0);
        let end = alone.last().expect("an end");
        assert_all_close("end", &member.end.q, end.q, 1e-6);
    }
}

ukcore::multibody! {
    /// A slide that is driven twice, in two ways that agree for `twice` = 1.
    DrivenTwice {
        params { m = 1.0, twice = 1.0 }
        coords { x, y }
        mass { x: m, y: m }
        holonomic { level: y = 0.5 * x, first: x = sin(t), second: x + 0.1 * (y - 0.5 * x) = twice * sin(t) }
    }
}

#[test]
fn contradictions_are_refused_by_name() {
    let mut found = vec![0.0; 2];
    for twice in [2.0, 1.01, 1.0 + 1e-6] {
        let mechanism = DrivenTwice {
            twice,
            ..DrivenTwice::default()
        };
        let mut solver = Solver::new(&mechanism, SolverOptions::default());
        let (s, c) = 1.0_f64.sin_cos();
        let error = solver.acceleration(1.0, &[s, 0.5 * s], &[c, 0.5 * c], &mut found);
        let Err(Error::Inconsistent { constraints }) = error else {
            panic!("{twice}: {error:?}");
        };
        let named = |name: &str| constraints.iter().any(|(c, _)| c == name);
        assert!(named("first") || named("second"), "{constraints:?}");
        for stabilisation in [Stabilisation::Projection, Stabilisation::None] {
            let run = Simulation::new(mechanism.clone())
                .start(at(&[0.0; 2], &[1.0, 0.5]))
                .stabilise(stabilisation)
                .until(1.0);
            let text = run.expect_err("they contradict each other").to_string();
            assert!(text.contains("first") || text.contains("second"), "{text}");
        }
    }
}

ukcore::multibody! {
    /// Two links hanging from a support, and the second one declared again, but for a part `delta` in a direction of its own: none with
    /// parameters at their defaults.
    Copied {
        params { m = 0.7, big = 2.0, g = 9.81, delta = 0.0 }
        coords { x1, y1, x2, y2, x3, y3 }
        mass { x1: m, y1: m, x2: big, y2: big, x3: m, y3: big }
        potential { m * g * y1, big * g * y2, big * g * y3 }
        holonomic {
            upper: sq(x1) + sq(y1) = 1.0
            lower: sq(x2 - x1) + sq(y2 - y1) = 1.0
            again: sq(x2 - x1) + sq(y2 - y1) + delta * (0.3 * x1 - 0.5 * y1 + 0.2 * x3 + 0.4 * y3) = 1.0
        }
    }
}

#[test]
fn a_row_that_counts_after_all_is_not_left_out() {
    assert!(!Copied::SPEC.structure.solve.redundant.is_empty());
    let mut random = Random::new(8);
    for k in 0..=30 {
        let delta = 10.0_f64.powf(-0.5 * f64::from(k));
        let mechanism = Copied {
            delta,
            ..Copied::default()
        };
        for _ in 0..20 {
            let (a, b) = (3.0 * random.signed(), 3.0 * random.signed());
            let [x, y] = [a.sin(), -a.cos()];
            // On the constraints: the third particle is where its part is zero.
            let x3 = random.signed();
            let y3 = -(0.3 * x - 0.5 * y + 0.2 * x3) / 0.4;
            let q = [x, y, x + b.sin(), y - b.cos(), x3, y3];
            let (w, u, vx) = (random.signed(), random.signed(), random.signed());
            let [vx1, vy1] = [w * a.cos(), w * a.sin()];
            let vy = -(0.3 * vx1 - 0.5 * vy1 + 0.2 * vx) / 0.4;
            let v = [vx1, vy1, vx1 + u * b.cos(), vy1 + u * b.sin(), vx, vy];
            let (mut found, mut expected) = (vec![0.0; 6], vec![0.0; 6]);
            let mut solver = Solver::new(&mechanism, SolverOptions::default());
            let dense = solver_by(Formula::UdwadiaPhohomsiri, &mechanism).acceleration(
                0.0,
                &q,
                &v,
                &mut expected,
            );
            for _ in 0..2 {
                let result = solver.acceleration(0.0, &q, &v, &mut found);
                assert_eq!(
                    result.is_ok(),
                    dense.is_ok(),
                    "{delta:e}: {result:?}, {dense:?}"
                );
                if result.is_ok() {
                    // What is left of rounding where a row keeps delta.
                    let least = 1e-12 + 1e-14 / delta.max(2e-11);
                    assert_all_close("q̈", &found, &expected, least * (1.0 + largest(&expected)));
                }
            }
        }
    }
}

#[test]
fn it_is_told_what_is_left_out() {
    let plan = DoubleScottRussell::plan().to_string();
    for name in ["guide[0]", "guide[1]"] {
        assert!(plan.contains(name), "{plan}");
    }
    assert!(
        plan.contains("as many as do at a state are dropped there"),
        "{plan}"
    );
    assert!(models::UChain::SPEC.structure.solve.redundant.is_empty());
}
