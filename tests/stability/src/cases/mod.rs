//! The cases, by what is extreme in them.

mod constraints;
mod loops;
mod masses;
mod numbers;
mod starts;
mod stiff;
mod times;

use models::Pendulum;
use ukcore::equations::precise;
use ukcore::solver::{Formula, SolverOptions};
use ukcore::{Error, Mechanism, Solver, State, Trajectory};

use uktool::stability::{Case, Effort};

/// All cases, in the order of the table.
pub fn all() -> Vec<Case<'static>> {
    let all = [
        masses::cases(),
        stiff::cases(),
        loops::cases(),
        constraints::cases(),
        starts::cases(),
        numbers::cases(),
        times::cases(),
    ];
    all.into_iter().flatten().collect()
}

/// Largest absolute value; NaN if there is one.
fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |s: f64, x| {
        if x.is_nan() || s.is_nan() {
            f64::NAN
        } else {
            s.max(x.abs())
        }
    })
}

/// The larger one; NaN if there is one, where `f64::max` would hide it.
fn worse(a: f64, b: f64) -> f64 {
    largest(&[a, b])
}

/// max|found − expected| as a part of max|expected|.
fn off(found: &[f64], expected: &[f64]) -> f64 {
    let difference: Vec<f64> = found.iter().zip(expected).map(|(f, e)| f - e).collect();
    largest(&difference) / largest(expected)
}

/// How far q̈ by the default way and by each formula in `formulas` is off `expected`.
fn accelerations_off<M: Mechanism>(
    mechanism: &M,
    state: &State,
    formulas: &[Formula],
    expected: &[f64],
    effort: &mut Effort,
) -> Result<f64, Error> {
    let mechanism = mechanism.prepared();
    let mut worst = 0.0;
    for formula in [Formula::Auto].iter().chain(formulas) {
        let options = SolverOptions {
            formula: *formula,
            ..SolverOptions::default()
        };
        let mut solver = Solver::new(&mechanism, options);
        let mut found = vec![0.0; M::SPEC.n()];
        let result = solver.acceleration(state.t, &state.q, &state.v, &mut found);
        effort.evaluations += solver.work().evaluations;
        effort.fallbacks += solver.work().fallbacks;
        result?;
        worst = worse(worst, off(&found, expected));
    }
    Ok(worst)
}

/// Accelerations by the equations solved in 31 digits; NaN where these have no solution: without a reference nothing is claimed.
fn exact_accelerations<M: Mechanism>(mechanism: &M, state: &State) -> Vec<f64> {
    let exact = precise::accelerations(mechanism, state.t, &state.q, &state.v);
    exact.unwrap_or_else(|| vec![f64::NAN; state.q.len()])
}

/// The coordinates at the end of a run.
fn end(run: &Trajectory) -> Vec<f64> {
    run.last().map_or(vec![f64::NAN], |last| last.q.to_vec())
}

/// Where a pendulum is at the time `t` after it was let go at rest from the angle `from`.
fn swung(from: f64, t: f64) -> [f64; 2] {
    let pendulum = Pendulum::default();
    let (angle, _) = pendulum.swing(from, t);
    pendulum.at_angle(angle, 0.0).0
}

/// Every formula that a regular M allows.
const REGULAR: [Formula; 3] = [
    Formula::UdwadiaKalaba,
    Formula::UdwadiaPhohomsiri,
    Formula::Kkt,
];
/// Every formula that a singular M allows.
const SINGULAR: [Formula; 2] = [Formula::UdwadiaPhohomsiri, Formula::Kkt];
