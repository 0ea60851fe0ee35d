//! What can be put together, and what cannot: the line between the two is the same in all units of length, in bodies, points and angles.

use tests::at_rest;
use ukcore::assemble::residuals;
use ukcore::manifold::Projector;
use ukcore::{Error, Mechanism, Prepared, Simulation, assemble, equilibrium};

/// Lengths.
const SCALES: [f64; 10] = [1e-9, 1e-7, 1e-5, 1e-3, 0.1, 1.0, 1e2, 1e4, 1e6, 1e9];

ukcore::multibody! {
    /// Two bars between two pivots that are s lengths apart, as bodies.
    Bars {
        params { l = 1, s = 1, m = 1 }
        bodies {
            planar one { mass: m, inertia: m * sq(l) / 12 }
            planar two { mass: m, inertia: m * sq(l) / 12 }
        }
        holonomic {
            left: pin(ground.at([0, 0]), one.at([-l / 2, 0]))
            top: pin(one.at([l / 2, 0]), two.at([l / 2, 0]))
            right: pin(ground.at([s * l, 0]), two.at([-l / 2, 0]))
        }
        start up(lift = 0.5) {
            one.angle near lift
            two.angle near PI - lift
        }
    }
}

ukcore::multibody! {
    /// The same by the point where they meet.
    Points {
        params { l = 1, s = 1, m = 1 }
        coords { x, y }
        mass { x: m, y: m }
        holonomic {
            left: sq(x) + sq(y) = sq(l)
            right: sq(x - s * l) + sq(y) = sq(l)
        }
    }
}

ukcore::multibody! {
    /// The same by angles.
    Angles {
        params { l = 1, s = 1, m = 1 }
        coords { a, b }
        mass { a: m * sq(l), b: m * sq(l) }
        holonomic { along: l * cos(a) - l * cos(b) = s * l, across: l * sin(a) - l * sin(b) = 0.0 }
    }
}

ukcore::multibody! {
    /// Peaucellier's cell of bodies: `pen` draws a straight line.
    Peaucellier {
        params { l = 1, m = 1 }
        let long = 2 * l;
        let short = 0.8 * l;
        let radius = 0.8 * l;
        bodies {
            planar crank { mass: m, inertia: m * sq(radius) / 12 }
            for k in 0..2 {
                planar arm[k] { mass: m, inertia: m * sq(long) / 12 }
                planar near[k] { mass: m, inertia: m * sq(short) / 12 }
                planar far[k] { mass: m, inertia: m * sq(short) / 12 }
            }
        }
        holonomic {
            centre: pin(ground.at([radius, 0]), crank.at([-radius / 2, 0]))
            for k in 0..2 {
                pivot[k]: pin(ground.at([0, 0]), arm[k].at([-long / 2, 0]))
                inner[k]: pin(arm[k].at([long / 2, 0]), near[k].at([short / 2, 0]))
                outer[k]: pin(arm[k].at([long / 2, 0]), far[k].at([-short / 2, 0]))
                tip[k]: pin(crank.at([radius / 2, 0]), near[k].at([-short / 2, 0]))
            }
            pen: pin(far[0].at([short / 2, 0]), far[1].at([short / 2, 0]))
        }
    }
}

/// Two bars as `Bars`, `Points` and `Angles`, the lengths of which are l and s l, and guesses of their states.
fn bars(l: f64, s: f64) -> [(&'static str, Prepared, Vec<f64>); 3] {
    let m = 1.0;
    let guess = vec![0.5 * l, 0.1 * l, 0.3, 1.5 * l, 0.1 * l, 2.9];
    [
        ("bodies", Bars { l, s, m }.prepared(), guess),
        (
            "points",
            Points { l, s, m }.prepared(),
            vec![0.9 * l, 0.1 * l],
        ),
        ("angles", Angles { l, s, m }.prepared(), vec![0.3, 2.9]),
    ]
}

#[test]
fn bars_that_are_long_enough_meet() {
    for l in SCALES {
        for s in [2.0, 2.0 - 1e-12, 2.0 - 1e-6, 1.3, 0.2] {
            for (name, mechanism, guess) in bars(l, s) {
                let context = format!("{name}, l = {l:e}, 2 - {:e}", 2.0 - s);
                let state = assemble(&mechanism, &at_rest(&guess), &[]);
                let state = state.unwrap_or_else(|e| panic!("{context}: {e}"));
                let off = residuals(&mechanism, &state).unwrap().largest_position();
                let unit = if name == "points" { l * l } else { l };
                assert!(off <= 2e-14 * unit, "{context}: {off:e}");
            }
            let mechanism = Bars { l, s, m: 1.0 };
            let start = mechanism.start("up", &Default::default());
            start.unwrap_or_else(|e| panic!("start, l = {l:e}, 2 - {:e}: {e}", 2.0 - s));
        }
    }
}

#[test]
fn bars_that_are_too_short_do_not() {
    for l in SCALES {
        for over in [1e-11, 1e-9, 1e-7, 1e-6, 1e-3, 0.1, 1.0, 30.0] {
            let s = 2.0 + over;
            for (name, mechanism, guess) in bars(l, s) {
                let context = format!("{name}, l = {l:e}, 2 + {over:e}");
                let error = assemble(&mechanism, &at_rest(&guess), &[]);
                let error = error.expect_err(&context);
                let Error::NotAssembled { constraints, .. } = error else {
                    panic!("{context}: {error}")
                };
                assert!(!constraints.is_empty(), "{context}");
            }
            let mechanism = Bars { l, s, m: 1.0 };
            let start = mechanism.start("up", &Default::default());
            assert!(start.is_err(), "start, l = {l:e}, 2 + {over:e}: {start:?}");
        }
    }
}

/// OP · OQ = long² − short², and P is on a circle through O, so Q is on the line x = (long² − short²)/(2 radius).
#[test]
fn the_cell_of_peaucellier_draws_a_line_in_all_units() {
    let (long, short, radius) = (2.0_f64, 0.8_f64, 0.8_f64);
    let line = (long * long - short * short) / (2.0 * radius);
    let mut shift = 0.0;
    for l in SCALES {
        for turn in [0.25_f64, -0.4, 0.5] {
            shift = (shift + 0.618_f64).fract();
            // Where everything is, in lengths.
            let p = [radius + radius * turn.cos(), radius * turn.sin()];
            let (d, phi) = (p[0].hypot(p[1]), p[1].atan2(p[0]));
            let half = (long * long - short * short + d * d) / (2.0 * d);
            let across = (long * long - half * half).sqrt();
            let turned = |x: f64, y: f64| {
                let (s, c) = phi.sin_cos();
                [c * x - s * y, s * x + c * y]
            };
            let pen = turned(2.0 * half - d, 0.0);
            let bar = |a: [f64; 2], b: [f64; 2]| {
                let middle = [0.5 * l * (a[0] + b[0]), 0.5 * l * (a[1] + b[1])];
                [middle[0], middle[1], (b[1] - a[1]).atan2(b[0] - a[0])]
            };
            let corners = [1.0, -1.0].map(|side| turned(half, side * across));
            let mut bodies = vec![("crank".to_owned(), bar([radius, 0.0], p))];
            for (k, corner) in corners.into_iter().enumerate() {
                bodies.push((format!("arm[{k}]"), bar([0.0, 0.0], corner)));
                bodies.push((format!("near[{k}]"), bar(p, corner)));
                bodies.push((format!("far[{k}]"), bar(corner, pen)));
            }
            let index = |name: &str| Peaucellier::SPEC.coordinate_index(name).unwrap();
            let mut guess = vec![0.0; Peaucellier::SPEC.n()];
            for (body, place) in bodies {
                // Sketched to some hundredths.
                shift = (shift + 0.618_f64).fract();
                let off = 0.04 * (shift - 0.5);
                guess[index(&format!("{body}.x"))] = place[0] + off * l;
                guess[index(&format!("{body}.y"))] = place[1] - off * l;
                guess[index(&format!("{body}.angle"))] = place[2] + off;
            }
            let mechanism = Peaucellier { l, m: 1.0 };
            let state = assemble(&mechanism, &at_rest(&guess), &[]);
            let state = state.unwrap_or_else(|e| panic!("l = {l:e}, {turn}: {e}"));
            let (x, angle) = (state.q[index("far[0].x")], state.q[index("far[0].angle")]);
            let x = x / l + 0.5 * short * angle.cos();
            assert!(
                (x - line).abs() < 1e-12,
                "l = {l:e}, {turn}: {x} for {line}"
            );
        }
    }
}

/// A state that is given to so many digits is taken, or refused, alike in all units.
#[test]
fn starts_are_known_to_the_same_share_in_all_units() {
    for off in [1e-12, 1e-9, 1e-7, 1e-4] {
        let taken = SCALES.map(|l| {
            bars(l, 1.3).map(|(name, mechanism, guess)| {
                let exact = assemble(&mechanism, &at_rest(&guess), &[]).unwrap();
                let mut start = exact.clone();
                for (k, q) in start.q.iter_mut().enumerate() {
                    let angle = name == "angles" || name == "bodies" && k % 3 == 2;
                    *q += off * if angle { 1.0 } else { l };
                }
                let mut q = start.q.clone();
                let moved = Projector::new(&mechanism).position(0.0, &mut q, &start.v);
                let run = Simulation::new(&mechanism).start(start).until(1e-3);
                (moved.is_ok(), run.is_ok())
            })
        });
        for (l, taken_here) in SCALES.iter().zip(&taken) {
            assert_eq!(taken_here, &taken[5], "l = {l:e}, off by {off:e}");
        }
        assert!(taken[5].iter().all(|taken| taken.0), "off by {off:e}");
    }
}

ukcore::multibody! {
    /// A bar on a pivot.
    Pendulum {
        params { l = 1, m = 1, g = 1 }
        bodies { planar bar { mass: m, inertia: m * sq(l) / 12 } }
        potential { m * g * bar.y }
        holonomic { pivot: pin(ground.at([0, 0]), bar.at([-l / 2, 0])) }
    }
}

#[test]
fn a_pendulum_comes_to_rest_in_all_units() {
    for l in SCALES {
        let mechanism = Pendulum { l, m: 1.0, g: l };
        let guess = at_rest(&[0.4 * l, 0.3 * l, 0.6]);
        let rest = equilibrium(&mechanism, &guess, &[]);
        let rest = rest.unwrap_or_else(|e| panic!("l = {l:e}: {e}"));
        let angle = rest.state.q[2];
        assert!((angle.sin() + 1.0).abs() < 1e-14, "l = {l:e}: {angle}");
    }
}

ukcore::multibody! {
    /// A row whose slope ends with it.
    Vanishing {
        coords { x, y }
        mass { x: 1, y: 1 }
        holonomic { flat: x.powi(3) = 0, level: y = 1.0 }
    }
}

ukcore::multibody! {
    /// Coordinates that end at zero.
    Zeros {
        params { l = 1 }
        coords { x, y }
        mass { x: 1, y: sq(l) }
        holonomic { a: x = l * sin(y), b: sin(y) = 0.0 }
    }
}

#[test]
fn coordinates_may_end_at_zero_in_all_units() {
    for l in SCALES {
        for from in [1.0, 1e-3, 1e-6, 1e-9, 1e-13] {
            let guess = at_rest(&[from * l, from]);
            let found = assemble(Zeros { l }, &guess, &[]);
            let found = found.unwrap_or_else(|e| panic!("l = {l:e} from {from:e}: {e}"));
            let [x, y] = [found.q[0] / l, found.q[1]];
            assert!(
                y.sin().abs() < 1e-15 && x.abs() < 1e-15,
                "l = {l:e}: {x:e}, {y:e}"
            );
        }
    }
}

#[test]
fn a_row_that_vanishes_is_assembled_where_a_run_takes_it() {
    for from in [0.5, 1e-3, 1e-8, 0.0] {
        let found = assemble(Vanishing::default(), &at_rest(&[from, 0.9]), &[]);
        let state = found.unwrap_or_else(|e| panic!("from {from:e}: {e}"));
        assert!(state.q[0].abs() < 1e-13 && state.q[1] == 1.0, "{state:?}");
        let run = Simulation::new(Vanishing::default()).start(state);
        assert!(run.until(0.1).is_ok(), "from {from:e}");
    }
}
