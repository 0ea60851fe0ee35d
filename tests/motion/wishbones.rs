//! Wheels on wishbones: loops of light bodies between heavy ones. What constraints give by other coordinates loses nothing, and a light
//! body that a wheel hangs on is not light; one that is tied to heavy ones is.

use ukcore::equations::precise;
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Simulation, Solver, State, lost_digits};

ukcore::multibody! {
    /// A body with one wheel on two wishbones and a tie rod. Wishbones are so many times as heavy.
    Corner {
        params { k = 30000.0 [N/m], c = 2000 [N s/m], rest = 0.45 [m], tyre = 200000.0 [N/m], times = 1.0 }
        bodies {
            spatial body { mass: 1000, inertia: [300, 1200, 1300] }
            spatial lower { mass: 5 * times, inertia: [0.2 * times, 0.1 * times, 0.25 * times], centre: [1.3, 0.5, -0.1] }
            spatial upper { mass: 3 * times, inertia: [0.1 * times, 0.05 * times, 0.12 * times], centre: [1.3, 0.5, 0.2] }
            spatial upright { mass: 15, inertia: [0.3, 0.3, 0.3], centre: [1.3, 0.75, 0] }
            spatial wheel { mass: 20, inertia: [0.8, 1.2, 0.8], centre: [1.3, 0.8, 0] }
        }
        gravity { [0, 0, -9.81] }
        let press = tyre * max(0, 0.3 - wheel.at([1.3, 0.8, 0])[2]);
        holonomic {
            top: ball(upper.at([1.3, 0.68, 0.18]), upright.at([1.3, 0.68, 0.18]))
            tie: rod(body.at([1.15, 0.33, -0.05]), upright.at([1.15, 0.7, -0.06]), norm([0, 0.37, 0.01]))
            l: hinge(body.at([1.3, 0.3, -0.1]), lower.at([1.3, 0.3, -0.1]), [1, 0, 0])
            u: hinge(body.at([1.3, 0.35, 0.2]), upper.at([1.3, 0.35, 0.2]), [1, 0, 0])
            b: ball(lower.at([1.3, 0.7, -0.12]), upright.at([1.3, 0.7, -0.12]))
            axle: hinge(upright.at([1.3, 0.8, 0]), wheel.at([1.3, 0.8, 0]), [0, 1, 0])
        }
        forces {
            spring(body.at([1.3, 0.4, 0.4]), lower.at([1.3, 0.6, -0.11]), k, rest)
            damper(body.at([1.3, 0.4, 0.4]), lower.at([1.3, 0.6, -0.11]), c)
            force(wheel.at([1.3, 0.8, 0]), [0, 0, press])
        }
        start drop {
            body.centre = [0, 0, 0.35]
            body.e0 = 1; body.e1 = 0; body.e2 = 0; body.e3 = 0
            body.omega = [0, 0, 0]
            dot(body.centre) = [10, 0, 0]
            lower.e0 near 1; upper.e0 near 1; upright.e0 near 1; wheel.e0 near 1
            lower.centre near [1.3, 0.5, 0.25]
            upper.centre near [1.3, 0.5, 0.55]
            upright.centre near [1.3, 0.75, 0.35]
            wheel.centre near [1.3, 0.8, 0.35]
            wheel.omega near [0, 33, 0]
        }
    }
}

ukcore::multibody! {
    /// The same in the plane, seen from the front.
    Front {
        params { k = 30000.0 [N/m], rest = 0.45 [m], times = 1.0 }
        bodies {
            planar body { mass: 1000, inertia: 3000 }
            planar lower { mass: 5 * times, inertia: 0.2 * times, centre: [0.5, -0.1] }
            planar upper { mass: 3 * times, inertia: 0.1 * times, centre: [0.5, 0.2] }
            planar wheel { mass: 35, inertia: 1.1, centre: [0.8, 0] }
        }
        gravity { [0, -9.81] }
        holonomic {
            l: pin(body.at([0.3, -0.1]), lower.at([0.3, -0.1]))
            u: pin(body.at([0.35, 0.2]), upper.at([0.35, 0.2]))
            top: pin(upper.at([0.68, 0.18]), wheel.at([0.68, 0.18]))
            b: pin(lower.at([0.7, -0.12]), wheel.at([0.7, -0.12]))
        }
        forces { spring(body.at([0.4, 0.4]), lower.at([0.6, -0.11]), k, rest) }
        start drop {
            body.x = 0; body.y = 0; body.angle = 0
            dot(body.angle) = 1; dot(body.x) = 0; dot(body.y) = 0; dot(lower.angle) = 2
            lower.centre near [0.5, -0.1]
            upper.centre near [0.5, 0.2]
            wheel.centre near [0.8, 0]
            lower.angle near 0; upper.angle near 0; wheel.angle near 0
        }
    }
}

/// Accelerations at states, with wishbones so many times as heavy: the largest error of a coordinate beside the largest of all, by 31
/// digits; and how many were found by the dense solve.
fn by<M: Mechanism>(times: f64, states: &[State]) -> (f64, usize) {
    let mut mechanism = M::default();
    mechanism.set("times", times).expect("a parameter");
    let mut solver = Solver::new(mechanism.prepared(), SolverOptions::default());
    let mut worst: f64 = 0.0;
    for State { t, q, v } in states {
        let mut found = vec![0.0; q.len()];
        solver.acceleration(*t, q, v, &mut found).expect("regular");
        let exact = precise::accelerations(&mechanism, *t, q, v).expect("determined");
        let size = exact.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let off = found.iter().zip(&exact).map(|(a, b)| (a - b).abs() / size);
        worst = off.fold(worst, f64::max);
    }
    (worst, solver.work().fallbacks)
}

/// Wishbones as they are, and ten times as light, need no dense solve; those that are tied to what is too heavy for them do. Whoever
/// solves, no more than a few roundings over the least share that is accepted are lost.
fn are_exact<M: Mechanism>(start: State) {
    let run = Simulation::new(M::default().prepared())
        .tolerance(1e-8)
        .start(start)
        .every(0.03)
        .until(0.6)
        .expect("a run");
    assert_eq!(run.work().fallbacks, 0);
    let states: Vec<State> = run.samples().map(|sample| sample.to_state()).collect();
    for exponent in 0..=12 {
        let (worst, dense) = by::<M>(10.0_f64.powi(-exponent), &states);
        assert!(worst < 2e-12, "1e-{exponent}: {worst:e}, {dense} dense");
        assert!(exponent > 1 || dense == 0, "1e-{exponent}: {dense} dense");
    }
}

#[test]
fn wheels_on_wishbones_need_no_dense_solve() {
    let start = Corner::default().start("drop", &[].into());
    are_exact::<Corner>(start.expect("a start"));
    let start = Front::default().start("drop", &[].into());
    are_exact::<Front>(start.expect("a start"));
}

/// Wishbones that are so light that half of their digits would be lost are left to the dense solve, and are named.
#[test]
fn wishbones_that_are_too_light_are_told() {
    let start = Corner::default().start("drop", &[].into());
    let start = start.expect("a start");
    assert_eq!(lost_digits(Corner::default(), &start), None);
    let light = Corner {
        times: 1e-8,
        ..Corner::default()
    };
    let told = lost_digits(&light, &start).expect("a cause");
    assert!(told.contains("`upper` is"), "{told}");
    let (worst, dense) = by::<Corner>(light.times, &[start]);
    assert!(worst < 1e-12 && dense == 1, "{worst:e}, {dense}");
}
