//! Light parts between heavy ones, and heavy loads: how accurate the straight line is where masses cost the pivots digits, by 31 digits.

use super::certificate::at;
use models::SliderCrank;
use tests::{Dense, Random, digits, solver_by, straight};
use ukcore::equations::precise;
use ukcore::scalar::{DoubleDouble, Scalar};
use ukcore::solver::Formula;
use ukcore::spec::Pivot;
use ukcore::{Ensemble, Mechanism, Simulation, Solver, State};

ukcore::multibody! {
    /// Twelve links hanging from a support, each end with its own mass.
    Weighted {
        const N: usize = 12;
        params { m[N] = 1.0, g = 9.81 }
        coords { x[N], y[N] }
        mass { for i in 0..N { x[i]: m[i], y[i]: m[i] } }
        potential { for i in 0..N { m[i] * g * y[i] } }
        holonomic {
            top: sq(x[0]) + sq(y[0]) = 1.0
            for i in 1..N { link[i]: sq(x[i] - x[i - 1]) + sq(y[i] - y[i - 1]) = 1.0 }
        }
    }
}

/// |a − b| in the mass metric, over the larger of b and M⁻¹ Q.
fn off<M: Mechanism>(mechanism: &M, state: &State, a: &[f64], b: &[DoubleDouble]) -> f64 {
    let dense = Dense::of(mechanism, state);
    let mass = dense.mass.diagonal();
    let norm = |x: &mut dyn Iterator<Item = f64>| {
        let squares = mass.iter().zip(x).map(|(m, x)| m * x * x);
        squares.sum::<f64>().sqrt()
    };
    let free = dense.force.component_div(&mass);
    let size = norm(&mut b.iter().map(|b| b.to_f64())).max(norm(&mut free.iter().copied()));
    let difference = |(a, b): (&f64, &DoubleDouble)| (DoubleDouble::from_f64(*a) - *b).to_f64();
    norm(&mut a.iter().zip(b).map(difference)) / size
}

/// The solver and the dense solve beside each other, with the largest error of each.
struct Both {
    solver: Solver,
    dense: Solver,
    worst: f64,
    allowed: f64,
}

impl Both {
    fn of<M: Mechanism>(mechanism: &M) -> Self {
        Both {
            solver: solver_by(Formula::Auto, mechanism),
            dense: solver_by(Formula::UdwadiaKalaba, mechanism),
            worst: 0.0,
            allowed: 0.0,
        }
    }

    fn compare<M: Mechanism>(&mut self, mechanism: &M, state: &State, exact: &[DoubleDouble]) {
        let pairs = [
            (&mut self.solver, &mut self.worst),
            (&mut self.dense, &mut self.allowed),
        ];
        for (solver, most) in pairs {
            let mut found = vec![0.0; state.q.len()];
            let solved = solver.acceleration(0.0, &state.q, &state.v, &mut found);
            solved.expect("regular");
            *most = most.max(off(mechanism, state, &found, exact));
        }
    }
}

/// The states of a chain whose links are bent by `bend` from one to the next, and turn.
fn bent(bend: f64) -> impl Iterator<Item = State> {
    (0..100).map(move |k| {
        let (mut q, mut v) = (vec![0.0; 24], vec![0.0; 24]);
        let mut ends = [0.0; 4];
        for i in 0..12 {
            let angle = 0.3 + bend * i as f64 + 1e-3 * f64::from(k);
            let ((sin, cos), rate) = (angle.sin_cos(), 0.5 + 0.1 * i as f64);
            let links = [sin, -cos, rate * cos, rate * sin];
            ends.iter_mut()
                .zip(links)
                .for_each(|(end, link)| *end += link);
            [q[i], q[12 + i], v[i], v[12 + i]] = ends;
        }
        State { t: 0.0, q, v }
    })
}

ukcore::multibody! {
    /// Light rods hinged to each other, in their angles, with a load at the end.
    Loaded {
        const N: usize = 4;
        params { m[N] = 1.0, l = 0.5, g = 9.81 }
        coords { th[N] }
        let across = |i| l * dot(th[i]) * [-sin(th[i]), cos(th[i])];
        let {
            v[0] = across(0)
            h[0] = l * sin(th[0])
            for i in 1..N { v[i] = v[i - 1] + across(i), h[i] = h[i - 1] + l * sin(th[i]) }
        }
        kinetic { for i in 0..N { 0.5 * m[i] * sq(v[i]), 0.005 * sq(dot(th[i])) } }
        potential { for i in 0..N { m[i] * g * h[i] } }
    }
}

/// Without constraints the straight line loses no more digits by small pivots than the dense solve: by 31 digits, whatever the load, and
/// without a fallback as long as M is definite beyond doubt.
#[test]
fn heavy_loads_at_the_end_of_an_arm() {
    for exponent in (0..=8).step_by(2) {
        let mut mechanism = Loaded::default();
        mechanism.m[3] = 10.0_f64.powi(exponent);
        let mut both = Both::of(&mechanism);
        for k in 0..200 {
            let angle = |i: i32| (f64::from(k) * 0.37 + f64::from(i) * 1.9).sin() * 3.0;
            let q: Vec<f64> = (0..4).map(angle).collect();
            let state = tests::at(&q, &q.iter().map(|x| 0.3 * x).collect::<Vec<_>>());
            let exact = precise::accelerations(&mechanism, 0.0, &state.q, &state.v);
            let exact = digits(&exact.expect("definite"));
            both.compare(&mechanism, &state, &exact);
        }
        let (worst, allowed, work) = (both.worst, both.allowed, both.solver.work());
        assert!(worst <= 4.0 * allowed, "{exponent}: {worst:e}, {allowed:e}");
        assert_eq!(work.fallbacks, 0, "{exponent}");
    }
}

/// A light mass between heavy ones costs the pivots digits, but no constraint comes near the others: the straight line serves, refined, as
/// accurate as the dense solve, by 31 digits.
#[test]
fn light_masses_between_heavy_ones() {
    for (bend, lightest) in [(0.1, 16), (0.01, 16), (1e-3, 16), (0.0, 10)] {
        for exponent in 0..=lightest {
            for light in [&[5][..], &[11], &[0, 3, 8]] {
                let mut mechanism = Weighted::default();
                light
                    .iter()
                    .for_each(|i| mechanism.m[*i] = 10.0_f64.powi(-exponent));
                let mut both = Both::of(&mechanism);
                for state in bent(bend) {
                    both.compare(&mechanism, &state, &straight(&mechanism, &state));
                }
                let (worst, allowed, work) = (both.worst, both.allowed, both.solver.work());
                let what = format!("{light:?} of 1e-{exponent}, bent by {bend}");
                // What the certificate promises where it holds, twice: where three shares are just accepted, they reach it.
                let promised =
                    2.0 * 36.0 * f64::EPSILON / Weighted::SPEC.structure.solve.least_share;
                assert!(
                    worst <= promised.max(4.0 * allowed),
                    "{what}: {worst:e}, {allowed:e}"
                );
                assert!(work.fallbacks <= 4, "{what}: {work:?}");
            }
        }
    }
}

/// Of a run and of a member of an ensemble it is counted.
#[test]
fn what_is_refined_is_counted() {
    let mut mechanism = Weighted::default();
    mechanism.m[5] = 1e-8;
    let start = bent(0.1).next().expect("a state");
    let run = Simulation::new(mechanism.clone()).start(start.clone());
    let work = run.until(1e-3).expect("a run").work();
    assert!(
        work.refined > 0 && work.refined <= work.evaluations,
        "{work:?}"
    );
    let all = Ensemble::new(vec![(mechanism, start)]).until(1e-3);
    let member = all[0].as_ref().expect("a member");
    assert!(member.work.refined > 0, "{:?}", member.work);
}

/// Bodies that are light beside those pinned to them: coordinates are substituted, and what the straight line lacks refinement gives back,
/// as accurate as the dense solve, by 31 digits.
#[test]
fn light_bodies_between_heavy_ones() {
    let mut pivots = SliderCrank::SPEC.structure.solve.pivots.iter();
    assert!(pivots.any(|p| matches!(p, Pivot::Substituted(..))));
    let (mut random, mut refined) = (Random::new(17), 0);
    for exponent in 0..=12 {
        for light in [["m1", "i1"], ["m2", "i2"], ["m3", "m3"], ["i1", "i2"]] {
            let mut mechanism = SliderCrank::default();
            for name in light {
                let value = mechanism.get(name).expect("a parameter");
                let value = value * 10.0_f64.powi(-exponent);
                mechanism.set(name, value).expect("a parameter");
            }
            let mut both = Both::of(&mechanism);
            for k in 0..50 {
                let (sin, cos) = (0.4 + 0.01 * f64::from(k)).sin_cos();
                let (r, l) = (mechanism.r, mechanism.l);
                let rod = (-r * sin / l).asin();
                let mut q = vec![0.0; 9];
                for (place, value) in [
                    (SliderCrank::CRANK_X, 0.5 * r * cos),
                    (SliderCrank::CRANK_Y, 0.5 * r * sin),
                    (SliderCrank::CRANK_ANGLE, 0.4 + 0.01 * f64::from(k)),
                    (SliderCrank::ROD_X, r * cos + 0.5 * l * rod.cos()),
                    (SliderCrank::ROD_Y, 0.5 * r * sin),
                    (SliderCrank::ROD_ANGLE, rod),
                    (SliderCrank::SLIDE_X, r * cos + l * rod.cos()),
                ] {
                    q[place] = value;
                }
                let state = at::<SliderCrank>(q, &mut random);
                both.compare(&mechanism, &state, &straight(&mechanism, &state));
            }
            let (worst, allowed, work) = (both.worst, both.allowed, both.solver.work());
            let what = format!("{light:?} of 1e-{exponent}");
            assert!(worst <= 4.0 * allowed, "{what}: {worst:e}, {allowed:e}");
            refined += work.refined;
        }
    }
    assert!(refined > 100, "{refined} refined");
}
