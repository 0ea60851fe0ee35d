//! Parallelograms with a rod too many, sampled where that rod's own velocities vanish, and beside the line of the axles.

use tests::{at, at_rest};
use ukcore::{Event, Simulation};

ukcore::multibody! {
    /// Two cranks and a coupler; the coupler stays level, which is said once more.
    pub Parallelogram {
        params { m = 1.0, r = 0.5, d = 0.8, g = 9.81 }
        coords { a[2], b[2] }
        mass { for i in 0..2 { a[i]: m, b[i]: m } }
        potential { m * g * a[1], m * g * b[1] }
        holonomic {
            crank: sq(a[0]) + sq(a[1]) = sq(r),
            coupler: sq(b[0] - a[0]) + sq(b[1] - a[1]) = sq(d),
            rocker: sq(b[0] - d) + sq(b[1]) = sq(r),
            level: a[1] = b[1],
        }
    }
}

#[test]
fn samples_and_events_where_a_redundant_row_is_at_rest() {
    let (s, c) = 1.0_f64.sin_cos();
    let (x, y) = (0.5 * s, -0.5 * c);
    for tolerance in [1e-6, 1e-9, 1e-11] {
        let start = at_rest(&[x, y, x + 0.8, y]);
        let run = Simulation::new(Parallelogram::default())
            .start(start)
            .tolerance(tolerance)
            .event(Event::new("bottom", |_, q, _| q[0]))
            .until(10.0)
            .unwrap_or_else(|e| panic!("{e}"));
        assert!(run.events("bottom").expect("watched").count() > 5);
        assert!(run.residuals().iter().all(|r| r.largest() < 1e-13));
    }
}

ukcore::multibody! {
    /// A bar on three cranks of equal length, of which the third follows from the others.
    Cranks {
        params { g = 9.81, l = 2.0 }
        const N: usize = 3;
        gravity { [0, -g] }
        bodies { planar bar { mass: 2, inertia: 0.5 } for i in 0..N { planar crank[i] { mass: 1, inertia: 0.08, centre: [0.5, 0] } } }
        tree {
            for i in 0..N { axle[i]: pin(ground.at([i * l / 3, 0]), crank[i].at([0, 0])) }
            end: pin(crank[0].at([1, 0]), bar.at([0, 0]))
        }
        holonomic { for i in 1..N { end_of[i]: pin(crank[i].at([1, 0]), bar.at([i * l / 3, 0])) } }
    }
}

/// Beside the line of the axles a sample is moved by the constraints that tell something there, not along the motion by one that follows.
#[test]
fn samples_beside_the_line_of_the_axles_are_of_the_motion() {
    for rate in [2.775, 2.3, 3.1, 4.2] {
        let angle = 1e-3;
        let start = at(&[angle, angle, angle, -angle], &[rate, rate, rate, -rate]);
        for tolerance in [1e-8, 1e-9] {
            let run = Simulation::new(Cranks::default()).start(start.clone());
            let run = run.tolerance(tolerance).every(0.03).until(2.0);
            let run = run.unwrap_or_else(|e| panic!("{rate}, {tolerance:e}: {e}"));
            let drift = run.energy_drift();
            assert!(drift < 1e2 * tolerance, "{rate}, {tolerance:e}: {drift:e}");
        }
    }
}
