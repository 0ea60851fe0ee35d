//! Closed loops at and near their singular positions, and a chain at the crack of the whip.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use models::{FourBars, SliderCrank, StartOptions, UChain};
use ukcore::solver::Formula;
use ukcore::solver::RANK_TOLERANCE;
use ukcore::solver::SolverOptions;
use ukcore::{Error, Mechanism, Simulation, Solver, State};

use super::{REGULAR, accelerations_off, exact_accelerations, off, worse};
use crate::mechanisms::{UChain9, UChain33, UChain65};
use uktool::stability::{Case, Effort, Sweep, decades};

pub(crate) fn cases() -> Vec<Case<'static>> {
    let distances = || decades(-1, -16, 1, -1).and(0.0);
    vec![
        Case::new("whip", whip)
            .swept("links of a falling U-chain at its deepest acceleration")
            .over(Sweep::of(&[9.0, 17.0, 33.0, 65.0]))
            .against("the same equations in 31 digits at the crack; energy and lengths of the run")
            .within(1e-8, 1e-5),
        Case::new("crank-distance", crank_distance)
            .swept("angle from the singular position of a slider-crank with equal rods, accelerations")
            .over(distances())
            .against("closed form in the crank's angle")
            .within(1e-9, 1e-4),
        Case::new("crank-through", crank_through)
            .swept("1 − r/l of a slider-crank that turns through its nearly singular position")
            .over(decades(-1, -12, 1, -1))
            .against("energy, and the slider where the crank's angle puts it")
            .within(1e-8, 1e-5),
        Case::new("bars-distance", bars_distance)
            .swept("angle of four-bar linkages from the line of all rods, accelerations")
            .over(distances())
            .against("closed form in the lean; where the couplers are named as redundant, the equations on the line in 31 digits")
            .within(1e-10, 1e-4),
        Case::new("bars-through", |rate, effort| through(rate, 1e-9, effort))
            .swept("rate, 1/s, at which four-bar linkages pass the line of all rods")
            .over(decades(-2, 5, 1, 0))
            .against("energy, and all cranks parallel")
            .within(1e-8, 1e-5),
        Case::new("bars-tolerance", |tolerance, effort| through(2.0, tolerance, effort))
            .swept("tolerance with which four-bar linkages pass the line of all rods at 2/s")
            .over(decades(-4, -14, 1, -9))
            .against("energy, and all cranks parallel")
            .within(1e-6, 1e-2),
    ]
}

fn whip(links: f64, effort: &mut Effort) -> Result<f64, Error> {
    match links {
        9.0 => crack::<UChain9>(effort),
        17.0 => crack::<UChain>(effort),
        33.0 => crack::<UChain33>(effort),
        _ => crack::<UChain65>(effort),
    }
}

/// The chain falls folded in two until well after its tip has turned; then accelerations where the tip's were largest.
fn crack<M: Mechanism>(effort: &mut Effort) -> Result<f64, Error> {
    let n = M::SPEC.n() / 2;
    let mut state = State::zeros::<M>();
    let (mut x, mut y) = (0.0, 0.0);
    // From the support down and up again, in an open fold; particle 0 is the tip.
    for link in 0..n {
        let (cos, sin) = (0.28, 0.96);
        x += cos;
        y += if 2 * link < n { sin } else { -sin };
        state.q[n - 1 - link] = x;
        state.q[2 * n - 1 - link] = y;
    }
    let mechanism = M::default();
    let until = 1.25 * (2.0 * n as f64 / 9.8).sqrt();
    let simulation = Simulation::new(mechanism.clone()).start(state);
    let run = effort.run(simulation.tolerance(1e-11).max_steps(200_000), until)?;
    let (mut worst, mut peak, mut at) = (run.energy_drift(), 0.0, None);
    for (sample, a) in run.samples().zip(run.accelerations()?) {
        if a[n].abs() > peak {
            (peak, at) = (a[n].abs(), Some(sample.to_state()));
        }
    }
    for residual in run.residuals() {
        worst = worse(worst, residual.position);
    }
    if let Some(state) = at {
        let expected = exact_accelerations(&mechanism, &state);
        let then = accelerations_off(&mechanism, &state, &REGULAR, &expected, effort)?;
        worst = worse(worst, then);
    }
    Ok(worst)
}

/// r = l: the rod's angle is minus the crank's, and all is known in the crank's.
fn crank_distance(distance: f64, effort: &mut Effort) -> Result<f64, Error> {
    let crank = SliderCrank {
        r: 0.3,
        ..SliderCrank::default()
    };
    let (r, rate, angle) = (crank.r, 10.0, FRAC_PI_2 - distance);
    // cos of the angle from its distance, which the angle itself has lost to rounding.
    let (sin, cos) = (distance.cos(), distance.sin());
    let place = |s: f64, c: f64, k: f64, a: f64| {
        // With (s, c) the sine and cosine, and their derivatives for velocities and accelerations.
        let (r, s, c) = (r * k, s, c);
        vec![
            r / 2.0 * c,
            r / 2.0 * s,
            a,
            1.5 * r * c,
            r / 2.0 * s,
            -a,
            2.0 * r * c,
            0.0,
            0.0,
        ]
    };
    let state = State {
        t: 0.0,
        q: place(sin, cos, 1.0, angle),
        v: place(cos, -sin, rate, rate),
    };
    let (m1, m2, m3) = (crank.m1, crank.m2, crank.m3);
    let inertia = m1 * r * r / 4.0
        + crank.i1
        + m2 * r * r * (0.25 + 2.0 * sin * sin)
        + crank.i2
        + 4.0 * m3 * r * r * sin * sin;
    let half_slope = (2.0 * m2 + 4.0 * m3) * r * r * sin * cos;
    let weight = (m1 + m2) * crank.g * r / 2.0 * cos;
    let turn = -(half_slope * rate * rate + weight) / inertia;
    let mut expected = place(cos, -sin, turn, turn);
    for (e, x) in expected.iter_mut().zip(place(-sin, -cos, rate * rate, 0.0)) {
        *e += x;
    }
    let formulas = [Formula::UdwadiaKalaba, Formula::Kkt];
    accelerations_off(&crank, &state, &formulas, &expected, effort)
}

/// From 45° to beyond 90°: there the slider all but reaches the bearing, and turns back at once.
fn crank_through(gap: f64, effort: &mut Effort) -> Result<f64, Error> {
    let crank = SliderCrank {
        r: 0.3 * (1.0 - gap),
        ..SliderCrank::default()
    };
    let start = crank.start("turning", &StartOptions::new().with("angle", FRAC_PI_4))?;
    let simulation = Simulation::new(crank.clone()).start(start).tolerance(1e-11);
    let run = effort.run(simulation.max_steps(1_000_000), 0.2)?;
    let mut worst: f64 = run.energy_drift();
    for sample in run.samples() {
        let (angle, slider) = (
            sample.q[SliderCrank::CRANK_ANGLE],
            sample.q[SliderCrank::SLIDE_X],
        );
        // As (l² − r²) + r² cos², without cancellation.
        let (r, l) = (crank.r, crank.l);
        let reach = ((l - r) * (l + r) + (r * angle.cos()).powi(2)).sqrt();
        let expected = r * angle.cos() + reach;
        worst = worse(worst, (slider - expected) / l);
    }
    Ok(worst)
}

/// All cranks lean by `lean` from the upright and turn at `rate`.
fn bars(sin: f64, cos: f64, rate: f64) -> State {
    let mut state = State::zeros::<FourBars>();
    for (i, (&x, &y)) in FourBars::X.iter().zip(&FourBars::Y).enumerate() {
        (state.q[x], state.q[y]) = (i as f64 + sin, cos);
        (state.v[x], state.v[y]) = (rate * cos, -rate * sin);
    }
    state
}

fn bars_distance(distance: f64, effort: &mut Effort) -> Result<f64, Error> {
    let (sin, cos, rate) = (distance.cos(), distance.sin(), 2.0);
    let four = FourBars::default();
    let turn = four.toppling() * sin;
    let mut expected = vec![0.0; 2 * FourBars::X.len()];
    for (&x, &y) in FourBars::X.iter().zip(&FourBars::Y) {
        expected[x] = turn * cos - rate * rate * sin;
        expected[y] = -turn * sin - rate * rate * cos;
    }
    let state = bars(sin, cos, rate);
    let mut solver = Solver::new(&four, SolverOptions::default());
    let solution = solver.solve(0.0, &state.q, &state.v)?;
    if solution.redundant.is_empty() {
        return accelerations_off(&four, &state, &REGULAR, &expected, effort);
    }
    // Taken as on the line, and said so: the couplers are named as redundant. There the equations have another solution, since the
    // linkage may leave the line in other ways.
    let expected = exact_accelerations(&four, &bars(1.0, 0.0, rate));
    let on_the_line = accelerations_off(&four, &state, &[], &expected, effort)?;
    Ok(worse(on_the_line, 10.0 * RANK_TOLERANCE))
}

/// From 0.4 before the line to as much after it.
fn through(rate: f64, tolerance: f64, effort: &mut Effort) -> Result<f64, Error> {
    let (sin, cos) = (FRAC_PI_2 - 0.4).sin_cos();
    let four = FourBars::default();
    let start = bars(sin, cos, rate);
    // The time at constant acceleration of about k = g.
    let k = four.toppling();
    let until = 0.8 / (0.5 * rate + (0.25 * rate * rate + 0.4 * k).sqrt());
    let run = effort.run(
        Simulation::new(four).start(start).tolerance(tolerance),
        until,
    )?;
    let mut worst: f64 = run.energy_drift();
    for sample in run.samples() {
        let top = |i: usize| {
            let (x, y) = (FourBars::X[i], FourBars::Y[i]);
            [sample.q[x] - i as f64, sample.q[y]]
        };
        for i in 1..FourBars::X.len() {
            worst = worse(worst, off(&top(i), &top(0)));
        }
    }
    let leant = run.last().map_or(f64::NAN, |s| s.q[FourBars::Y[0]]);
    // It has passed the line.
    Ok(if leant < 0.0 { worst } else { f64::INFINITY })
}
