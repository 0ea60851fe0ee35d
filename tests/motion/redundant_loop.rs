//! A parallelogram with a redundant level rod, sampled where that rod's own velocities vanish.

use ukcore::{Event, Simulation, State};

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
        let start = State {
            t: 0.0,
            q: vec![x, y, x + 0.8, y],
            v: vec![0.0; 4],
        };
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
