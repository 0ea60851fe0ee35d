//! Declarations within declarations: a mechanism of parts, of this crate and of another, is the one that is written out.

use tests::leg::Leg;
use tests::{Random, assert_all_close, at_rest, largest};
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Simulation, Solver, assemble};

mod tails {
    ukcore::multibody! {
        /// A weight on a spring.
        #[ukcore(part)]
        pub(super) Tail {
            params { m = 0.2, k = 5.0, c = 0.1 }
            coords { s }
            mass { s: m }
            potential { 0.5 * k * sq(s) }
            nonideal { s: -c * dot(s) }
        }
    }
}
use tails::Tail;

ukcore::multibody! {
    /// A trunk on two legs whose feet are pinned to the ground, with a weight that wags.
    Walker {
        params { l = 0.6, rest = 0.3, g = 9.81 }
        bodies { planar trunk { mass: 2, inertia: 0.3 } }
        gravity { [0, -g] }
        parts {
            for i in 0..2 { leg[i]: Leg { l, rest: rest * (1 - 2 * i), m: [0.8, 0.4 + i / 10.0] } }
            tail: Tail { m: l / 2 }
        }
        holonomic {
            for i in 0..2 {
                hip[i]: pin(trunk.at([i - 0.5, 0]), leg[i].bar[0].at([0, 0]))
                foot[i]: pin(ground.at([i - 0.5, 0]), leg[i].bar[1].at([leg[i].l, 0]))
            }
        }
        force { tail.s: 0.3 * trunk.angle, trunk.angle: 0.3 * tail.s, leg[1].bar[0].angle: t }
        output { height = trunk.y + leg[0].toe[1] }
        start standing(height = 1.0) {
            trunk.y = height;
            for i in 0..2 { leg[i].bar[0].angle near 3.7; leg[i].bar[1].angle near 5.7 }
            dot(tail.s) = 0.2
        }
    }
}

ukcore::multibody! {
    /// The same, written out.
    Whole {
        params { l = 0.6, rest = 0.3, g = 9.81, k = 3.0, tail_k = 5.0, tail_c = 0.1 }
        coords { s }
        bodies {
            planar trunk { mass: 2, inertia: 0.3 }
            for i in 0..2 { for b in 0..2 { planar bar[i][b] {
                mass: 0.8 * (1 - b) + (0.4 + i / 10.0) * b, inertia: 0.8 * sq(l) / 12.0, centre: [l / 2.0, 0]
            } } }
        }
        gravity { [0, -g] }
        mass { s: l / 2 }
        potential { 0.5 * tail_k * sq(s) }
        holonomic {
            for i in 0..2 {
                hip[i]: pin(trunk.at([i - 0.5, 0]), bar[i][0].at([0, 0]))
                foot[i]: pin(ground.at([i - 0.5, 0]), bar[i][1].at([l, 0]))
                knee[i]: pin(bar[i][0].at([l, 0]), bar[i][1].at([0, 0]))
            }
        }
        forces { for i in 0..2 { turning_spring(bar[i][0], bar[i][1], k, rest * (1 - 2 * i)) } }
        force { s: 0.3 * trunk.angle, trunk.angle: 0.3 * s, bar[1][0].angle: t }
        nonideal { s: -tail_c * dot(s) }
        output { height = trunk.y + bar[0][1].at([l, 0])[1] }
    }
}

#[test]
fn a_mechanism_of_parts_is_the_one_written_out() {
    assert_eq!(
        Walker::SPEC.coords[..4],
        ["tail.s", "trunk.x", "trunk.y", "trunk.angle"]
    );
    assert_eq!(
        Walker::SPEC.coords[4..6],
        ["leg[0].bar[0].x", "leg[0].bar[0].y"]
    );
    assert_eq!((Walker::TAIL_S, Walker::LEG_1_BAR_ANGLE), (0, [12, 15]));
    let names: Vec<&str> = Walker::SPEC.constraints.iter().map(|c| c.name).collect();
    assert_eq!(names[8..10], ["leg[0].knee.x", "leg[0].knee.y"]);
    // What is not given is a parameter, one for all members; what is given follows those of the whole.
    let parts = Walker {
        l: 0.7,
        leg_k: 4.0,
        tail_k: 6.0,
        ..Walker::default()
    };
    let whole = Whole {
        l: 0.7,
        k: 4.0,
        tail_k: 6.0,
        ..Whole::default()
    };
    let mut random = Random::new(9);
    for (parts, whole) in [(Walker::default(), Whole::default()), (parts, whole)] {
        let (q, v) = (random.vector(16), random.vector(16));
        let mut first = Solver::new(parts, SolverOptions::default());
        let mut second = Solver::new(whole, SolverOptions::default());
        let first = first.solve(0.4, &q, &v).expect("accelerations");
        let second = second.solve(0.4, &q, &v).expect("accelerations");
        assert_eq!(
            (first.degrees_of_freedom, second.degrees_of_freedom),
            (4, 4)
        );
        let scale = largest(&second.acceleration);
        assert_all_close(
            "accelerations",
            &first.acceleration,
            &second.acceleration,
            1e-11 * scale,
        );
    }
}

#[test]
fn starts_name_what_stands_in_parts() {
    let start = Walker::default()
        .start("standing", &[("height", 0.9)].into())
        .expect("a start");
    let at = |i: usize| start.q[i];
    assert_eq!((at(Walker::TRUNK_Y), start.v[Walker::TAIL_S]), (0.9, 0.2));
    assert!(
        (at(Walker::LEG_0_BAR_ANGLE[0]) - 3.7).abs() < 0.6,
        "{start:?}"
    );
    let run = Simulation::new(Walker::default())
        .tolerance(1e-9)
        .start(start)
        .until(0.5);
    assert!(run.is_ok(), "{run:?}");
}

/// A part is a mechanism by itself, too.
#[test]
fn a_part_runs_by_itself() {
    let mut guess = at_rest(&[0.0; 6]);
    guess.q[Leg::BAR_ANGLE[1]] = 0.7;
    let start = assemble(Leg::default(), &guess, &[]).expect("a start");
    let run = Simulation::new(Leg::default())
        .tolerance(1e-10)
        .start(start)
        .until(1.0)
        .expect("a run");
    assert!(run.energy_drift() < 1e-8);
}
