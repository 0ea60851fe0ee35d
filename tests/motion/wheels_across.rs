//! Constraints on velocities that come to imply each other, as the wheels of a board do that stand across: they are passed.

use std::f64::consts::FRAC_PI_2;

use tests::{assert_close, at};
use ukcore::{Mechanism, Method, Simulation, State, assemble};

ukcore::multibody! {
    /// A board on two wheels, which steer by p = w t + a sin t to opposite sides.
    Board {
        params { m = 2.0, j = 0.3, l = 0.4, w = 1.0, a = 0.0 }
        coords { x, y, th }
        mass { x: m, y: m, th: j }
        let p = w * t + a * sin(t);
        nonholonomic {
            back: -sin(th - p) * dot(x) + cos(th - p) * dot(y) - l * cos(p) * dot(th) = 0
            front: -sin(th + p) * dot(x) + cos(th + p) * dot(y) + l * cos(p) * dot(th) = 0
        }
        output { turn = dot(th), along = cos(th) * dot(x) + sin(th) * dot(y) }
    }
}

ukcore::multibody! {
    /// One whose wheels never stand across at once: the front one is `early`. The other turns at another pace.
    Apart {
        params { m = 2.0, j = 0.3, l = 0.4, early = 0.0, pace = 1.0 }
        coords { x, y, th }
        mass { x: m, y: m, th: j }
        let back = -PI / 2 - pace * (t - PI / 2);
        let front = t + early;
        nonholonomic {
            rear: -sin(th + back) * dot(x) + cos(th + back) * dot(y) - l * cos(back) * dot(th) = 0
            fore: -sin(th + front) * dot(x) + cos(th + front) * dot(y) + l * cos(front) * dot(th) = 0
        }
        output { turn = dot(th), along = cos(th) * dot(x) + sin(th) * dot(y), across = cos(th) * dot(y) - sin(th) * dot(x) }
    }
}

ukcore::multibody! {
    /// The same of bodies: rows of joints take part, and one that is redundant.
    Bodies {
        params { m = 1.5, j = 0.2, l = 0.4, w = 1.0, a = 0.0, wheel = 0.25, turning = 0.01 }
        bodies {
            planar board { mass: m, inertia: j }
            planar back { mass: wheel, inertia: turning }
            planar front { mass: wheel, inertia: turning }
        }
        let p = w * t + a * sin(t);
        holonomic {
            one: pin(board.at([-l, 0]), back.at([0, 0]))
            other: pin(board.at([l, 0]), front.at([0, 0]))
            apart: rod(back.at([0, 0]), front.at([0, 0]), 2 * l)
            steer_back: turn(board, back) = -p
            steer_front: turn(board, front) = p
        }
        let rolls = |wheel| inner(dot(wheel.centre), wheel.along([0, 1]));
        nonholonomic { rolls_back: rolls(back) = 0, rolls_front: rolls(front) = 0 }
        output { turn = board.omega, along = inner(dot(board.centre), board.along([1, 0])) }
    }
}

/// ω and v along the board at p, of those at p0: T is kept, and v = 2 l cos p k and ω = 2 sin p k with a k that does not change its sign.
fn turns(mass: f64, inertia: f64, l: f64, energy: f64, p: f64) -> [f64; 2] {
    let (s, c) = p.sin_cos();
    let k = (energy / (2.0 * mass * (l * c).powi(2) + 2.0 * inertia * s * s)).sqrt();
    [2.0 * s * k, 2.0 * l * c * k]
}

struct Case {
    w: f64,
    a: f64,
    /// Time of the start, and of the end.
    span: [f64; 2],
    speed: f64,
}

/// The mechanism goes as the closed form says; `velocities` makes those of its coordinates of v and ω.
#[track_caller]
fn check<M: Mechanism>(
    name: &str,
    board: &M,
    [mass, inertia, l]: [f64; 3],
    case: &Case,
    runs: &[(Method, f64)],
    state: impl Fn(f64, [f64; 2]) -> State,
) {
    let Case { w, a, span, speed } = *case;
    let steered = |t: f64| w * t + a * t.sin();
    let energy = 0.5 * speed * speed;
    let start = state(
        steered(span[0]),
        turns(mass, inertia, l, energy, steered(span[0])),
    );
    let start = State {
        t: span[0],
        ..start
    };
    let start = assemble(board.clone(), &start, &[]).expect("a start");
    for (method, tolerance) in runs {
        let name = format!("{name}, {method}, {tolerance:e}, w {w}, a {a}, speed {speed}");
        let run = Simulation::new(board.clone())
            .start(start.clone())
            .method(*method)
            .tolerance(*tolerance)
            .until(span[1]);
        let run = run.unwrap_or_else(|failure| panic!("{name}: {failure}"));
        let [turn, along] = turns(mass, inertia, l, energy, steered(span[1]));
        let off = 2e-9 + 100.0 * tolerance * speed;
        for (output, expected) in [("turn", turn), ("along", along)] {
            let found = *run.output(output).expect("it").last().expect("an end");
            assert_close(&format!("{name}: {output}"), found, expected, off);
        }
    }
}

fn runs() -> Vec<(Method, f64)> {
    let methods = [Method::Dop853, Method::Dopri5, Method::Radau5];
    let tolerances = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
    let all = methods
        .iter()
        .flat_map(|method| tolerances.map(|tolerance| (*method, tolerance)));
    all.collect()
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for speed in [0.3, 1.7] {
        // Across once and twice, from before and from far off.
        for span in [[0.2, 2.5], [1.5, 1.6], [-1.0, 5.5]] {
            cases.push(Case {
                w: 1.0,
                a: 0.0,
                span,
                speed,
            });
        }
        // Not quite as far as across, and a little farther.
        for a in [1.4, 1.55, 1.56, 1.5703, 1.6, 2.0] {
            cases.push(Case {
                w: 0.0,
                a,
                span: [0.0, 3.0],
                speed,
            });
        }
    }
    cases
}

#[test]
fn wheels_that_stand_across_are_passed() {
    for case in cases() {
        let Board { m, j, l, .. } = Board::default();
        let board = Board {
            w: case.w,
            a: case.a,
            ..Board::default()
        };
        check(
            "board",
            &board,
            [m, j, l],
            &case,
            &runs(),
            |_, [turn, along]| at(&[0.0; 3], &[along, 0.0, turn]),
        );
    }
}

#[test]
fn wheels_that_stand_across_are_passed_beside_joints() {
    for case in cases() {
        let Bodies {
            m,
            j,
            l,
            wheel,
            turning,
            ..
        } = Bodies::default();
        let bodies = Bodies {
            w: case.w,
            a: case.a,
            ..Bodies::default()
        };
        let sizes = [m + 2.0 * wheel, j + 2.0 * wheel * l * l + 2.0 * turning, l];
        let (w, a, t) = (case.w, case.a, case.span[0]);
        check(
            "bodies",
            &bodies,
            sizes,
            &case,
            &runs(),
            |p, [turn, along]| {
                let rate = w + a * t.cos();
                at(
                    &[0.0, 0.0, 0.0, -l, 0.0, -p, l, 0.0, p],
                    &[
                        along,
                        0.0,
                        turn,
                        along,
                        -l * turn,
                        turn - rate,
                        along,
                        l * turn,
                        turn + rate,
                    ],
                )
            },
        );
    }
}

/// Where wheels all but stand across at once, the body turns about in next to no time, and goes back. A run does so, or is refused.
#[test]
fn wheels_that_stand_across_one_after_the_other_are_not_taken_for_both() {
    let Apart { m, j, l, .. } = Apart::default();
    // Velocities that both wheels allow: along the board, across it, and of its turning.
    let way = |t: f64, early: f64, pace: f64| {
        let (p, q) = (-FRAC_PI_2 - pace * (t - FRAC_PI_2), t + early);
        [
            2.0 * l * p.cos() * q.cos(),
            l * (p + q).sin(),
            (q - p).sin(),
        ]
    };
    let speed = |[x, y, w]: [f64; 3]| (m * (x * x + y * y) + j * w * w).sqrt();
    let mut through = [0; 2];
    let early = [
        1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12, 1e-13, -1e-3, -1e-7,
        -1e-11,
    ];
    let paces = [(1.0, 0.2), (0.5, 0.2), (0.5, 0.32), (-0.4, 0.27)];
    let all = early
        .into_iter()
        .flat_map(|early| paces.map(|(pace, t)| (early, pace, t)));
    for (early, pace, t) in all {
        for (method, tolerance) in runs() {
            let name = format!("{method}, {tolerance:e}, early {early:e}, pace {pace}, from {t}");
            let from = way(t, early, pace);
            let [along, across, turn] = from.map(|v| v / speed(from));
            let start = State {
                t,
                q: vec![0.0; 3],
                v: vec![along, across, turn],
            };
            let run = Simulation::new(Apart {
                early,
                pace,
                ..Apart::default()
            })
            .start(start)
            .method(method)
            .tolerance(tolerance)
            .until(2.5);
            let Ok(run) = run else {
                continue;
            };
            through[usize::from(early.abs() < 1e-2)] += 1;
            let to = way(2.5, early, pace);
            let off = 1e-7 + 100.0 * tolerance;
            for (output, expected) in ["along", "across", "turn"].iter().zip(to) {
                let found = *run.output(output).expect("it").last().expect("an end");
                assert_close(
                    &format!("{name}: {output}"),
                    found,
                    expected / speed(to),
                    off,
                );
            }
        }
    }
    // Those that miss by so much are all right.
    assert_eq!(through[0], 2 * paces.len() * runs().len());
}
