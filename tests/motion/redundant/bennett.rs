//! Bennett's linkage: four hinges that move though three of five rows that close the loop are redundant. Where it is folded flat two of
//! these have no entry left, and next to it an error turns them into any direction.

use tests::worst;
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Method, Simulation, Solver};

ukcore::multibody! {
    /// Links of the lengths a, b, a, b with the twists α, β, α, β, where a/sin α = b/sin β; the fourth is the ground.
    Bennett {
        params { a = 1.0, alpha = 0.6, beta = 1.1, g = 9.81 }
        let b = a * sin(beta) / sin(alpha);
        let twisted = |angle| [0, -sin(angle), cos(angle)];
        bodies {
            spatial first { mass: 1.0, inertia: [0.02, 0.1, 0.1], centre: [a / 2.0, 0, 0] }
            spatial second { mass: 1.5, inertia: [0.02, 0.2, 0.2], centre: [b / 2.0, 0, 0] }
            spatial third { mass: 1.0, inertia: [0.02, 0.1, 0.1], centre: [a / 2.0, 0, 0] }
        }
        gravity { [0, 0, -g] }
        tree {
            p: hinge(ground.at([b, 0, 0]), first.at([0, 0, 0]), twisted(beta), [0, 0, 1])
            q: hinge(first.at([a, 0, 0]), second.at([0, 0, 0]), twisted(alpha), [0, 0, 1])
            r: hinge(second.at([b, 0, 0]), third.at([0, 0, 0]), twisted(beta), [0, 0, 1])
        }
        holonomic { close: hinge(third.at([a, 0, 0]), ground.at([0, 0, 0]), twisted(alpha), [0, 0, 1]) }
        start turning(angle = 1.0, next = 2.8, rate = 0.0) {
            p.angle = angle; q.angle near next; r.angle near -angle; dot(p.angle) = rate;
        }
    }
}

/// tan ½p tan ½q is this in all positions, and r = −p.
fn product() -> f64 {
    let Bennett { alpha, beta, .. } = Bennett::default();
    (0.5 * (beta + alpha)).sin() / (0.5 * (beta - alpha)).sin()
}

/// The position with the angle p, and velocities with the rate ṗ.
fn state(p: f64, rate: f64) -> [[f64; 3]; 2] {
    let (sin, cos) = (0.5 * p).sin_cos();
    let k = product();
    let ratio = -k / (sin * sin + k * k * cos * cos);
    let q = 2.0 * (k * cos).atan2(sin);
    [[p, q, -p], [rate, ratio * rate, -rate]]
}

#[test]
fn accelerations_where_it_is_folded() {
    let prepared = Bennett::default().prepared();
    let mut solver = Solver::new(&prepared, SolverOptions::default());
    let mut acceleration = |p: f64, off: f64| {
        let [mut q, v] = state(p, -4.77);
        let parts = [1.0, -0.3, 0.7];
        (q.iter_mut().zip(parts)).for_each(|(q, part)| *q += off * part);
        let mut out = [0.0; 3];
        let solved = solver.acceleration(0.0, &q, &v, &mut out);
        solved.unwrap_or_else(|error| panic!("{p:e}, {off:e}: {error}"));
        out
    };
    // q̈ is smooth: where it is folded it is the mean of those beside.
    let (before, behind) = (acceleration(-1e-3, 0.0), acceleration(1e-3, 0.0));
    for p in [0.0, 1e-300, 1e-16, 1e-12, 1e-9, 1e-7, 1e-5] {
        for off in [0.0, 1e-12, 1e-8, 1e-6, 1e-4] {
            let found = acceleration(p, off);
            for i in 0..3 {
                let expected = 0.5 * (before[i] + behind[i]);
                let error = (found[i] - expected).abs();
                assert!(
                    error < 1e-4 + 10.0 * off,
                    "{p:e}, {off:e}: {found:?}, {expected}"
                );
            }
        }
    }
}

#[test]
fn turns_through_where_it_is_folded() {
    let k = product();
    for (angle, rate) in [(1.0, 0.7), (0.2, 0.0), (2.5, -3.0), (1e-3, 0.1)] {
        let start = Bennett::default().start(
            "turning",
            &[
                ("angle", angle),
                ("next", state(angle, 0.0)[0][1]),
                ("rate", rate),
            ]
            .into(),
        );
        let start = start.unwrap_or_else(|error| panic!("{angle}: {error}"));
        for (method, tolerance) in [
            (Method::Dop853, 1e-10),
            (Method::Dop853, 1e-5),
            (Method::Dopri5, 1e-7),
            (Method::Radau5, 1e-7),
        ] {
            let run = Simulation::new(Bennett::default()).start(start.clone());
            let run = run.method(method).tolerance(tolerance).every(0.05);
            let run = run.until(5.0);
            let run = run.unwrap_or_else(|failure| panic!("{angle}, {method}: {failure}"));
            let off = worst(&run, |s| {
                let [p, q] = [0.5 * s.q[0], 0.5 * s.q[1]];
                (p.sin() * q.sin() - k * p.cos() * q.cos()).abs() + (s.q[0] + s.q[2]).abs()
            });
            let drift = run.energy_drift();
            assert!(
                off < 1e-8 && drift < 100.0 * tolerance,
                "{angle}, {method}, {tolerance:e}: {off:e}, {drift:e}"
            );
            let folded = run.samples().zip(run.samples().skip(1));
            let folded = folded.filter(|(a, b)| a.q[0] * b.q[0] < 0.0).count();
            assert!(folded > 0, "{angle}, {method}");
        }
    }
}
