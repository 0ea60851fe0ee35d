//! The cases, by what is extreme in them.

mod constraints;
mod loops;
mod masses;
mod numbers;
mod starts;
mod stiff;
mod times;

use ukcore::equations::precise;
use ukcore::solver::Formula;
use ukcore::{Error, Mechanism, Solver, SolverOptions, State};

use uktool::stability::{Case, Effort};

/// All cases, in the order of the table.
pub fn all() -> Vec<Case<'static>> {
    [
        masses::cases(),
        stiff::cases(),
        loops::cases(),
        constraints::cases(),
        starts::cases(),
        numbers::cases(),
        times::cases(),
    ]
    .concat()
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

/// Accelerations against the equations solved in 31 digits.
fn accelerations_imprecise<M: Mechanism>(
    mechanism: &M,
    state: &State,
    formulas: &[Formula],
    effort: &mut Effort,
) -> Result<f64, Error> {
    let expected = precise::accelerations(mechanism, state.t, &state.q, &state.v);
    // Without a reference nothing is claimed.
    let expected = expected.unwrap_or_else(|| vec![f64::NAN; state.q.len()]);
    accelerations_off(mechanism, state, formulas, &expected, effort)
}

/// Every formula that a regular M allows.
const REGULAR: [Formula; 3] = [
    Formula::UdwadiaKalaba,
    Formula::UdwadiaPhohomsiri,
    Formula::Kkt,
];
