//! What a mechanism says at a state, each in a vector of its own, and slopes of that.

use ukcore::solver::{Formula, SolverOptions};
use ukcore::{Prepared, Solver, State};

/// All formulas.
pub const FORMULAS: [Formula; 4] = [
    Formula::Auto,
    Formula::UdwadiaKalaba,
    Formula::UdwadiaPhohomsiri,
    Formula::Kkt,
];

/// A solver by one of them.
#[must_use]
pub fn solver_by(formula: Formula, mechanism: impl Into<Prepared>) -> Solver {
    let options = SolverOptions {
        formula,
        ..SolverOptions::default()
    };
    Solver::new(mechanism, options)
}

/// What a mechanism puts out.
#[must_use]
pub fn outputs(mechanism: impl Into<Prepared>, State { t, q, v }: &State) -> Vec<f64> {
    let mechanism: Prepared = mechanism.into();
    let mut out = vec![f64::NAN; mechanism.spec().outputs.len()];
    mechanism.outputs(*t, q, v, &mut out);
    out
}

/// φ.
#[must_use]
pub fn residuals(mechanism: impl Into<Prepared>, t: f64, q: &[f64]) -> Vec<f64> {
    let mechanism: Prepared = mechanism.into();
    let mut phi = vec![f64::NAN; mechanism.spec().holonomic];
    mechanism.residual(t, q, &mut phi);
    phi
}

/// φ̇, then ψ.
#[must_use]
pub fn rates(mechanism: impl Into<Prepared>, t: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
    let mechanism: Prepared = mechanism.into();
    let mut rate = vec![f64::NAN; mechanism.spec().m()];
    mechanism.residual_rate(t, q, v, &mut rate);
    rate
}

/// q̈.
///
/// # Panics
/// Where there is none.
#[must_use]
#[track_caller]
pub fn accelerations(mechanism: impl Into<Prepared>, State { t, q, v }: &State) -> Vec<f64> {
    let mut solver = Solver::new(mechanism, SolverOptions::default());
    let mut out = vec![f64::NAN; q.len()];
    let solved = solver.acceleration(*t, q, v, &mut out);
    solved.unwrap_or_else(|e| panic!("{}: {e}", solver.mechanism().spec().name));
    out
}

/// The derivative at 0 by central differences of order 4: the error is h⁴ f⁗′/30 and rounding/h, so h = 1e-4 leaves nine digits of
/// functions that vary over 1, and eight of those that oscillate with 100 rad/s.
pub fn difference(h: f64, f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| f(k * h));
    let slope = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * h);
    (0..a.len()).map(slope).collect()
}
