//! Peaucellier's cell goes through the position in which its rhombus is flat by every method, also where steps of the size that accuracy
//! asks for are much shorter than one that would go over it from afar.

use tests::apart;
use ukcore::{Mechanism, Method, Prepared, Simulation, State};

ukcore::multibody! {
    /// Peaucellier's cell of uniform bars, by their ends. Where the rhombus is flat its side points meet, two constraints follow from the
    /// others, and branches cross in which they stay together.
    pub Cell {
        params { s = 1.0 }
        coords { b[2], c[2], d[2], p[2] }
        let bar = |u, v| (sq(dot(u)) + inner(dot(u), dot(v)) + sq(dot(v))) / 3;
        let q = [0.15 * s, 0];
        kinetic { (sq(dot(c)) + sq(dot(d)) + 0.5 * sq(dot(b))) / 3, bar(b, c), bar(b, d), bar(p, c), bar(p, d) }
        potential { 9.81 * s * (3 * c[1] + 3 * d[1] + 2.5 * b[1] + 2 * p[1]) }
        holonomic {
            oc: sq(c) = sq(0.5 * s) od: sq(d) = sq(0.5 * s) qb: sq(b - q) = sq(0.15 * s)
            bc: sq(b - c) = sq(0.3 * s) bd: sq(b - d) = sq(0.3 * s) pc: sq(p - c) = sq(0.3 * s) pd: sq(p - d) = sq(0.3 * s)
        }
        start go(angle = 0.6) {
            b = [0.15 * s * (1 + cos(angle)), 0.15 * s * sin(angle)];
            c near [0.35 * s, 0.35 * s]; d near [0.45 * s, -0.2 * s]; p near [0.533 * s, 0.17 * s]
        }
        output { shape = atan2(b[1], b[0] - 0.15 * s), straight = p[0] / s }
    }
}

ukcore::multibody! {
    /// The same of planar bodies.
    pub BodyCell {
        params { s = 1.0 }
        gravity { [0, -9.81 * s] }
        let long = 0.5 * s;
        let short = 0.3 * s;
        bodies {
            planar crank { mass: 1, inertia: sq(0.15 * s) / 12, centre: [0.075 * s, 0] }
            for i in 0..2 {
                planar arm[i] { mass: 2, inertia: sq(long) / 6, centre: [long / 2, 0] }
                planar near_bar[i] { mass: 2, inertia: sq(short) / 6, centre: [short / 2, 0] }
                planar far_bar[i] { mass: 2, inertia: sq(short) / 6, centre: [short / 2, 0] }
            }
        }
        holonomic {
            q: pin(ground.at([0.15 * s, 0]), crank.at([0, 0]))
            for i in 0..2 {
                o[i]: pin(ground.at([0, 0]), arm[i].at([0, 0]))
                k[i]: pin(arm[i].at([long, 0]), near_bar[i].at([short, 0]))
                l[i]: pin(arm[i].at([long, 0]), far_bar[i].at([0, 0]))
                b[i]: pin(crank.at([0.15 * s, 0]), near_bar[i].at([0, 0]))
            }
            p: pin(far_bar[0].at([short, 0]), far_bar[1].at([short, 0]))
        }
        start go(angle = 0.6) {
            crank.angle = angle;
            arm[0].angle near 0.71; arm[1].angle near -0.46; near_bar[0].angle near 2.2; near_bar[1].angle near -1.5;
            far_bar[0].angle near -0.4; far_bar[1].angle near 1.1
        }
        output { shape = crank.angle, straight = far_bar[0].at([short, 0])[0] / s }
    }
}

ukcore::multibody! {
    /// One of points, of which none is heavier than another.
    Points {
        coords { c[2], b[2], d[2], p[2] }
        mass { c: 1, b: 1, d: 1, p: 1 }
        potential { 9.81 * (c[1] + b[1] + d[1] + p[1]) }
        holonomic {
            qc: sq(c - [2, 0]) = 4, ob: sq(b) = 4, od: sq(d) = 4
            cb: sq(c - b) = 1, cd: sq(c - d) = 1, pb: sq(p - b) = 1, pd: sq(p - d) = 1
        }
    }
}

/// Runs from several starts, through the position four times or so each; the output keeps to its line.
fn passes(mechanism: &Prepared, method: Method, tolerance: f64) {
    let name = mechanism.spec().name;
    for angle in [0.41, 0.42, 0.46, 0.48, 0.59, 0.6, 0.71] {
        let start = mechanism.start("go", &[("angle", angle)].into());
        let start = start.unwrap_or_else(|e| panic!("{name}, {angle}: {e}"));
        let run = Simulation::new(mechanism).start(start).method(method);
        let run = run.tolerance(tolerance).until(2.0);
        let run = run.unwrap_or_else(|e| panic!("{name}, {angle}, {method}, {tolerance:e}: {e}"));
        for x in run.output("straight").expect("declared") {
            let off = (x - 8.0 / 15.0).abs();
            assert!(
                off < 1e-9,
                "{name}, {angle}, {method}, {tolerance:e}: {off:e}"
            );
        }
        let drift = run.energy_drift();
        assert!(
            drift < 1e-7,
            "{name}, {angle}, {method}, {tolerance:e}: {drift:e}"
        );
    }
}

#[test]
fn a_cell_by_its_points_passes_its_flat_position() {
    let cell = Cell::default().prepared();
    for tolerance in [1e-9, 1e-10, 1e-12] {
        passes(&cell, Method::Dopri5, tolerance);
    }
    passes(&cell, Method::Dop853, 1e-9);
    passes(&cell, Method::Rattle { step: 1e-3 }, 1e-9);
}

/// Starts in the flat position, from which the rhombus opens: two rows of A follow from the others there, and nowhere else. The motion is
/// one that comes back through it, whichever way the rhombus opens, and by every method.
#[test]
fn a_cell_of_points_starts_in_its_flat_position() {
    let starts_well = |cell: Prepared, cos: f64, [at, turning]: [[f64; 4]; 2], rate: f64| {
        let (name, sin) = (cell.spec().name, (1.0 - cos * cos).sqrt());
        let along = |length: f64| [length * cos, length * sin];
        let across = |length: f64| [-length * rate * sin, length * rate * cos];
        let start = tests::at(&at.map(along).concat(), &turning.map(across).concat());
        for (method, tolerance) in [
            (Method::Dop853, 1e-6),
            (Method::Dop853, 1e-9),
            (Method::Dopri5, 1e-9),
            (Method::Radau5, 1e-9),
            (Method::Dop853, 1e-11),
        ] {
            let place = format!("{name}, {rate}, {method}, {tolerance:e}");
            let run = |start: State, until: f64| {
                let run = Simulation::new(&cell).start(start).method(method);
                let run = run.tolerance(tolerance).at(vec![0.0]).until(until);
                run.unwrap_or_else(|e| panic!("{place}: {e}"))
            };
            let there = run(start.clone(), 0.1).last().expect("an end").to_state();
            let back = run(there, -0.1);
            let flat = back.samples().next().expect("a sample");
            let off = apart(flat.q, &start.q);
            assert!(off < 1e2 * tolerance, "{place}: {off:e}");
            let end = back.last().expect("an end");
            let off = end.q[6] - start.q[6];
            assert!(off.abs() < 1e-9, "{place}: {off:e} off the line");
        }
    };
    for rate in [3.0, -1.0, 8.0] {
        let lengths = [[3.0, 2.0, 2.0, 1.0], [0.0, 1.0, -1.0, 0.0]];
        starts_well(Points::default().prepared(), 0.75, lengths, rate);
        let lengths = [[0.2, 0.5, 0.5, 0.8], [0.0, 0.5, -0.5, 0.0]];
        starts_well(Cell::default().prepared(), 2.0 / 3.0, lengths, rate);
    }
}

#[test]
fn a_cell_of_bodies_passes_its_flat_position() {
    let cell = BodyCell::default().prepared();
    for tolerance in [1e-10, 1e-11, 1e-12] {
        passes(&cell, Method::Dopri5, tolerance);
    }
    passes(&cell, Method::Dop853, 1e-9);
}
