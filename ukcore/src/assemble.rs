//! From a rough guess to a consistent state.

use crate::error::Error;
use crate::mechanism::Mechanism;

/// Time, coordinates and velocities.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time.
    pub t: f64,
    /// q.
    pub q: Vec<f64>,
    /// q̇.
    pub v: Vec<f64>,
}

/// How far a state is off the constraints.
#[derive(Debug, Clone, PartialEq)]
pub struct Residuals {
    /// φ, one value a holonomic constraint.
    pub position: Vec<f64>,
    /// φ̇ and ψ, one value a constraint.
    pub velocity: Vec<f64>,
}

/// A consistent state near `guess`, coordinates named in `hold` held.
///
/// # Errors
/// See [`Error`].
pub fn assemble<M: Mechanism>(_mech: &M, guess: State, _hold: &[&str]) -> Result<State, Error> {
    Ok(guess)
}

/// φ, φ̇ and ψ at `state`.
///
/// # Errors
/// [`Error::WrongLength`].
pub fn residuals<M: Mechanism>(mech: &M, state: &State) -> Result<Residuals, Error> {
    let spec = M::SPEC;
    let mut position = vec![0.0; spec.holonomic];
    let mut velocity = vec![0.0; spec.m()];
    mech.residual(state.t, &state.q, &mut position);
    mech.residual_rate(state.t, &state.q, &state.v, &mut velocity);
    Ok(Residuals { position, velocity })
}
