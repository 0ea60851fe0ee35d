//! Scissor lifts over the top, where bars lie in one line: compiled with rows that may be left out, as they follow from others where bars
//! of a stage coincide, but at no position of the motion.

use std::f64::consts::{FRAC_PI_2, PI};
use tests::assert_close;
use ukcore::manifold::Projector;
use ukcore::{Mechanism, Method, Simulation, State};

/// A lift of some stages on a pin and a foot that is pushed, with its table.
macro_rules! lift {
    ($name:ident, $stages:literal) => {
        ukcore::multibody! {
            /// A scissor lift; a and b are the bars of a stage.
            $name {
                const N: usize = $stages;
                params { l = 1.0, m = 2.0, load = 50.0, g = 9.81, f = 9000.0 }
                bodies {
                    for i in 0..N {
                        planar a[i] { mass: m, inertia: m * sq(l) / 12, centre: [l / 2, 0] }
                        planar b[i] { mass: m, inertia: m * sq(l) / 12, centre: [l / 2, 0] }
                    }
                    planar top { mass: load, inertia: 1 }
                }
                gravity { [0, -g] }
                holonomic {
                    base: pin(ground.at([0, 0]), a[0].at([0, 0]))
                    foot: slot(ground.at([0, 0]), b[0].at([0, 0]), [1, 0])
                    for i in 0..N { mid[i]: pin(a[i].at([l / 2, 0]), b[i].at([l / 2, 0])) }
                    for i in 0..N - 1 {
                        u[i]: pin(a[i].at([l, 0]), b[i + 1].at([0, 0]))
                        v[i]: pin(b[i].at([l, 0]), a[i + 1].at([0, 0]))
                    }
                    table: pin(b[N - 1].at([l, 0]), top.at([0, 0]))
                    tab: slot(top.at([0, 0]), a[N - 1].at([l, 0]), [1, 0])
                }
                forces { force(b[0].at([0, 0]), [-f, 0]) }
            }
        }
    };
}

lift!(Two, 2);
lift!(Three, 3);

/// The positions of a lift of so many stages, and their slopes, at an angle: bars a, bars b, table.
fn posture(stages: usize, angle: f64, rate: f64, names: &[&str]) -> State {
    let (sin, cos) = angle.sin_cos();
    let place = |name: &&str| {
        let stage = name.find('[').map_or(0.0, |at| {
            let number = name[at + 1..].split(']').next();
            number.and_then(|n| n.parse().ok()).unwrap_or(0.0)
        });
        match (name.split(['[', '.']).next(), name.rsplit('.').next()) {
            (Some("top"), Some("y")) => (stages as f64 * sin, stages as f64 * cos),
            (Some("top"), _) => (0.0, 0.0),
            (_, Some("x")) => (0.5 * cos, -0.5 * sin),
            (_, Some("y")) => ((stage + 0.5) * sin, (stage + 0.5) * cos),
            (Some("a"), _) => (angle, 1.0),
            _ => (PI - angle, -1.0),
        }
    };
    let places: Vec<(f64, f64)> = names.iter().map(place).collect();
    State {
        t: 0.0,
        q: places.iter().map(|(q, _)| *q).collect(),
        v: places.iter().map(|(_, slope)| rate * slope).collect(),
    }
}

/// The square of the rate at which a lift turns at an angle, from rest at another one, by energy: T = ½ J(θ) θ̇², V = W sin θ + f l cos θ.
fn square_rate(stages: usize, f: f64, [start, angle]: [f64; 2]) -> f64 {
    let [m, load, g, n] = [2.0, 50.0, 9.81, stages as f64];
    let heights: f64 = (0..stages).map(|i| i as f64 + 0.5).sum();
    let squares: f64 = (0..stages).map(|i| (i as f64 + 0.5).powi(2)).sum();
    let (sin, cos) = angle.sin_cos();
    let bars = 2.0 * m * (n * (sin * sin / 4.0 + 1.0 / 12.0) + squares * cos * cos);
    let inertia = bars + load * (n * cos).powi(2);
    let potential = |angle: f64| g * (2.0 * m * heights + load * n) * angle.sin() + f * angle.cos();
    2.0 * (potential(start) - potential(angle)) / inertia
}

/// Runs from rest until so late, some turns; each passes the top and goes on as energy says.
fn goes_over<M: Mechanism>(stages: usize, [f, start, end]: [f64; 3], names: &[&str]) {
    let mut lift = M::default();
    lift.set("f", f).expect("a parameter");
    let at = names.iter().position(|name| *name == "a[0].angle");
    let at = at.expect("an angle");
    for (method, tolerances) in [
        (Method::Dop853, &[1e-8, 1e-10, 1e-11, 1e-12][..]),
        (Method::Dopri5, &[1e-8]),
        (Method::Radau5, &[1e-8, 1e-10]),
    ] {
        for &tolerance in tolerances {
            let run = Simulation::new(lift.prepared())
                .method(method)
                .tolerance(tolerance)
                .start(posture(stages, start, 0.0, names))
                .until(end);
            let what = format!("{method}, {stages} stages, {f} N from {start}, {tolerance:e}");
            let run = run.unwrap_or_else(|e| panic!("{what}: {}", e.error));
            let last = run.last().expect("a state");
            let (angle, turns) = (last.q[at], last.v[at]);
            let angles = run.coordinate("a[0].angle").expect("an angle");
            let most = angles.iter().fold(0.0, |most: f64, a| most.max(*a));
            assert!(most > FRAC_PI_2 + 0.5, "{what}: {most}");
            let expected = square_rate(stages, f, [start, angle]);
            let allowed = f64::max(1e4 * tolerance, 1e-7);
            // Of what it is at the fastest.
            let whole = square_rate(stages, f, [start, PI]);
            let off = (turns * turns - expected) / whole;
            assert_close(&what, off, 0.0, allowed);
            // In its branch: both bars of a stage turn against each other.
            let there = posture(stages, angle, turns, names);
            for (q, expected) in last.q.iter().zip(&there.q) {
                assert_close(&what, *q, *expected, 1e-9);
            }
        }
    }
}

#[test]
fn lifts_go_over_the_top_at_all_tolerances() {
    for f in [9000.0, 3000.0] {
        for start in [0.4, 0.7] {
            goes_over::<Two>(2, [f, start, 1.0], Two::SPEC.coords);
        }
    }
    goes_over::<Three>(3, [12000.0, 0.5, 0.6], Three::SPEC.coords);
}

/// What a projection leaves of the constraints is rounding on both sides of where rows that may be left out begin to count: what it left
/// on the one would be taken off at once on the other, with velocities that jump.
#[test]
fn projections_leave_rounding_where_rows_begin_to_count() {
    let lift = Two::default();
    let mut projector = Projector::new(&lift);
    let (mut left_out, mut whole) = (0, 0);
    for k in 0..60 {
        let state = posture(2, 1.6 + 0.01 * f64::from(k), 34.0, Two::SPEC.coords);
        let mut found = [0.0; 15];
        let safe = lift
            .prepared::<f64>()
            .acceleration(0.0, &state.q, &state.v, &mut found);
        left_out += usize::from(safe < 0.5);
        whole += usize::from(safe == 1.0);
        // Off the constraints by as little as rows that no step changes may be.
        let (mut q, mut v) = (state.q.clone(), state.v.clone());
        for (i, (q, v)) in q.iter_mut().zip(&mut v).enumerate() {
            let off = ((7 * i + 3 * k as usize) % 11) as f64 / 11.0 - 0.5;
            *q += 4e-14 * off;
            *v += 2e-12 * off;
        }
        let position = projector.position(0.0, &mut q, &v).expect("near");
        let velocity = projector.velocity(0.0, &q, &mut v).expect("near");
        assert!(position.residual < 1e-14, "{k}: {position:?}");
        assert!(velocity.residual < 4e-13, "{k}: {velocity:?}");
    }
    assert!(left_out > 5 && whole > 5, "{left_out}, {whole}");
}
