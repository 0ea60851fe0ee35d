//! States where everything cancels, and the rounding that is left is neither a contradiction nor a violation: redundant constraints
//! at rest, and coordinates that are zero.

use tests::{FORMULAS, Random, assert_all_close, at_rest, largest, solver_by};
use ukcore::{Simulation, assemble};

ukcore::multibody! {
    /// A particle on three rods in a plane, one more than hold it.
    pub Truss {
        params { m = 1.3, g = 9.81, wind = 0.4, px = 1.0, py = -1.2 }
        coords { x, y }
        mass { x: m, y: m }
        force { x: wind, y: -m * g }
        holonomic {
            left: sq(x) + sq(y) = sq(px) + sq(py)
            right: sq(x - 2.1) + sq(y - 0.13) = sq(px - 2.1) + sq(py - 0.13)
            above: sq(x - 1.0) + sq(y - 3.0) = sq(px - 1.0) + sq(py - 3.0)
        }
    }
}

ukcore::multibody! {
    /// A bar that hangs level on three parallel rods, one more than hold it level.
    pub Swing {
        params { m = 1.0, i = 0.1, g = 9.81, l = 0.7 }
        coords { x, y, th }
        mass { x: m, y: m, th: i }
        potential { m * g * y }
        let rod = |a| sq(x + a * cos(th) - a) + sq(y + a * sin(th)) - sq(l);
        holonomic { left: rod(-0.5) = 0.0, right: rod(0.5) = 0.0, between: rod(-0.2) = 0.0 }
    }
}

#[test]
fn a_truss_stands() {
    let mut random = Random::new(51);
    for _ in 0..200 {
        let truss = Truss {
            m: 1.0 + 0.9 * random.signed(),
            g: 10.0 * random.signed(),
            wind: random.signed(),
            px: 1.0 + random.signed(),
            py: -1.5 + random.signed(),
        };
        let q = [truss.px, truss.py];
        for formula in FORMULAS {
            let mut solver = solver_by(formula, &truss);
            let solution = solver
                .solve(0.0, &q, &[0.0; 2])
                .unwrap_or_else(|e| panic!("{formula:?}, {truss:?}: {e}"));
            assert_all_close("q̈", &solution.acceleration, &[0.0; 2], 1e-13);
            assert_eq!((solution.rank, solution.redundant.len()), (2, 1));
            // The rods carry the load.
            let load = [-truss.wind, truss.m * truss.g];
            assert_all_close("reaction", &solution.ideal_force, &load, 1e-12);
        }
    }
}

#[test]
fn a_swing_rests_and_swings() {
    let swing = Swing::default();
    let hang = |angle: f64| at_rest(&[swing.l * angle.sin(), -swing.l * angle.cos(), 0.0]);
    for (angle, still) in [(0.0, true), (0.3, false)] {
        let run = Simulation::new(swing.clone())
            .start(hang(angle))
            .tolerance(1e-10)
            .until(3.0)
            .unwrap_or_else(|e| panic!("from {angle}: {}", e.error));
        let drift = run.energy_drift();
        assert!(still || drift < 1e-8, "energy drifts by {drift:e}");
        let last = run.last().expect("an end");
        if still {
            assert_all_close("at rest", last.q, &hang(0.0).q, 1e-12);
        }
        // The bar stays level.
        assert!(last.q[Swing::TH].abs() < 1e-9, "{last:?}");
        let off = largest(run.residuals().iter().map(|r| &r.position));
        assert!(off < 1e-12, "{off:e} off the constraints");
    }
}

ukcore::multibody! {
    /// A pendulum whose coordinates are measured from where it starts, so that they are zero there.
    pub Displaced {
        params { m = 1.0, g = 9.81, ax = 1.3, ay = 0.7 }
        coords { x, y }
        mass { x: m, y: m }
        force { y: -m * g }
        holonomic { rod: sq(x - ax) + sq(y - ay) = sq(ax) + sq(ay) }
    }
}

#[test]
fn coordinates_may_be_zero() {
    let mut random = Random::new(52);
    for _ in 0..200 {
        let pendulum = Displaced {
            ax: 3.0 * random.signed(),
            ay: 3.0 * random.signed(),
            ..Displaced::default()
        };
        for displacement in [0.0, 1e-300, 1e-17, 1e-9] {
            // Along the circle, to first order.
            let size = pendulum.ax.hypot(pendulum.ay);
            let q = [-pendulum.ay, pendulum.ax].map(|d| displacement * d / size);
            let state = assemble(&pendulum, &at_rest(&q), &[])
                .unwrap_or_else(|e| panic!("{pendulum:?} at {q:?}: {e}"));
            assert_all_close("q", &state.q, &q, 1e-14 + displacement * displacement);
            let run = Simulation::new(pendulum.clone())
                .start(state)
                .until(0.5)
                .unwrap_or_else(|e| panic!("{pendulum:?} at {q:?}: {}", e.error));
            let off = largest(run.residuals().iter().map(|r| &r.position));
            assert!(off < 1e-13, "{off:e} off the rod");
        }
    }
}
