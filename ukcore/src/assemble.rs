//! From a rough guess to a consistent state.
//!
//! Closed loops cannot be drawn by hand to rounding. [`assemble`] takes a guess and coordinates to hold and finds a state near it that
//! satisfies every constraint: a search finds the place, and projection in the mass metric gives the last digits; velocities that enter
//! linearly it gives at once. For the search each coordinate is scaled by the root of its inertia, so that the state found is near in the
//! mass metric.
//!
//! Constraints that hang together only through coordinates that are held, or determined by their own rows, are searched apart: the legs of
//! a walker on a held crank each by itself. Where rows determine their unknowns there are solutions that lie apart, ways to put the
//! mechanism together; the nearest in that metric is taken, over all that depends on the choice. Where interval arithmetic shows that none
//! is nearer than the first one found, as near a good sketch, the search ends there; else dozens more begin all around the guess, and more
//! where the signs of det ∂φ/∂q at the solutions tell that one is missing.

use crate::error::Error;
use crate::manifold::{At, Level};
use crate::mechanism::{Mechanism, Prepared};
use crate::naming;
use crate::scan::largest;
use crate::spec::{GuessKind, Spec, rate_of};

mod alone;
mod by_parts;
mod search;

pub(crate) use by_parts::{scatter, weight};
pub(crate) use search::Search;

/// A time, coordinates and velocities.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// The time t.
    pub t: f64,
    /// The coordinates q, in the order of [`Spec::coords`](crate::spec::Spec::coords).
    pub q: Vec<f64>,
    /// The velocities q̇, in the same order.
    pub v: Vec<f64>,
}

impl State {
    /// The state of a mechanism at rest at q = 0, t = 0.
    #[must_use]
    pub fn zeros<M: Mechanism>() -> Self {
        State::at_rest(0.0, vec![0.0; M::SPEC.n()])
    }

    /// The state of a mechanism at rest at `q`.
    pub(crate) fn at_rest(t: f64, q: Vec<f64>) -> Self {
        let v = vec![0.0; q.len()];
        State { t, q, v }
    }

    /// A guess by names, for [`assemble`](crate::assemble()): `x` or `bar[0].angle` is a coordinate, `dot(x)` its velocity, a family's bare
    /// name all its members, `t` the time; 0 what is not named.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn guess<M: Mechanism>(values: &[(&str, f64)]) -> Result<Self, Error> {
        let mut state = State::zeros::<M>();
        for (name, value) in values {
            let velocity = rate_of(name);
            let indices = M::SPEC.coordinate_indices(velocity.unwrap_or(name));
            match (indices, velocity) {
                (Err(_), None) if *name == "t" => state.t = *value,
                (indices, Some(_)) => indices?.into_iter().for_each(|j| state.v[j] = *value),
                (indices, None) => indices?.into_iter().for_each(|j| state.q[j] = *value),
            }
        }
        Ok(state)
    }

    /// `error` with this state as the place where it arose.
    pub(crate) fn locate(&self, error: Error) -> Error {
        let State { t, q, v } = self.clone();
        let source = Box::new(error);
        Error::At { t, q, v, source }
    }

    /// Checks lengths, and that every number is finite.
    ///
    /// # Errors
    /// [`Error::WrongLength`], [`Error::NonFinite`] (also for parameters of `mech`).
    pub fn check(&self, mech: &Prepared) -> Result<(), Error> {
        naming::check_lengths(mech, &self.q, &self.v)?;
        naming::bad_input(mech, self.t, &self.q, &self.v).map_or(Ok(()), Err)
    }
}

/// How far a state is off the constraints, in the constraints' own units.
#[derive(Debug, Clone, PartialEq)]
pub struct Residuals {
    /// The residuals φ(q, t) of the h holonomic constraints.
    pub position: Vec<f64>,
    /// The residuals φ̇ of the holonomic and φ(q, q̇, t) of the nonholonomic constraints, m values.
    pub velocity: Vec<f64>,
}

impl Residuals {
    /// The residuals of `mech` at (t, q, q̇).
    pub(crate) fn at(mech: &Prepared, t: f64, q: &[f64], v: &[f64]) -> Self {
        let spec = mech.spec();
        let (mut position, mut velocity) = (vec![0.0; spec.holonomic], vec![0.0; spec.m()]);
        mech.residual(t, q, &mut position);
        mech.residual_rate(t, q, v, &mut velocity);
        Residuals { position, velocity }
    }

    /// Largest |φ|; 0 without holonomic constraints.
    #[must_use]
    pub fn largest_position(&self) -> f64 {
        largest(&self.position)
    }

    /// Largest |φ̇| or |ψ|; 0 without constraints.
    #[must_use]
    pub fn largest_velocity(&self) -> f64 {
        largest(&self.velocity)
    }
}

/// φ, φ̇ and ψ at `state`.
///
/// # Errors
/// [`Error::WrongLength`].
pub fn residuals(mechanism: impl Into<Prepared>, state: &State) -> Result<Residuals, Error> {
    let mech: Prepared = mechanism.into();
    naming::check_lengths(&mech, &state.q, &state.v)?;
    Ok(Residuals::at(&mech, state.t, &state.q, &state.v))
}

/// A consistent state near `guess`: φ(q, t) = 0, φ̇ = 0 and φ(q, q̇, t) = 0 to rounding. The coordinates named in `hold` keep both
/// their value and their velocity; a family's bare name (`"x"` for `x[0]`, `x[1]`, …) holds all its members, a body's all its coordinates.
///
/// Where what is held leaves as many constraints as coordinates, or more, the state with the least Σ M_jj Δq_j² is looked for: a far guess
/// has dozens of searches begin around it, which may miss one. Where coordinates stay free the state is the one that the search from
/// the guess leads to. [`assemble_with_alternatives`](crate::assemble_with_alternatives) tells of others that are as near, and how far
/// which coordinate was moved.
///
/// # Errors
/// - [`Error::NotAssembled`]: no state near the guess satisfies all constraints with these coordinates held; names those in
///   conflict with the residuals that remain where their squares (scaled) are least, and the held coordinates where these are the cause.
/// - [`Error::UnknownName`] for a name in `hold`; [`Error::WrongLength`]; [`Error::NonFinite`].
pub fn assemble(
    mechanism: impl Into<Prepared>,
    guess: &State,
    hold: &[&str],
) -> Result<State, Error> {
    let mech: Prepared = mechanism.into();
    let held = held(mech.spec(), hold)?;
    assembled(&mech, guess, Held::both(held))
}

/// The coordinates that `names` mean, in their order, each once.
///
/// # Errors
/// [`Error::UnknownName`] with the nearest name.
pub(crate) fn held(spec: &Spec, names: &[&str]) -> Result<Vec<usize>, Error> {
    let mut held = Vec::new();
    for name in names {
        held.extend(spec.coordinates_of(name)?);
    }
    held.sort_unstable();
    held.dedup();
    Ok(held)
}

/// Coordinates that keep their value, and those that keep their velocity.
#[derive(Default, Clone)]
pub(crate) struct Held {
    pub(crate) positions: Vec<usize>,
    pub(crate) velocities: Vec<usize>,
    /// Coordinates of whose position the guess says nothing: of several states they do not choose.
    pub(crate) untold: Vec<usize>,
    /// Coordinates of whose velocity the guess says nothing: these follow, at whatever size, before one of which it speaks is changed.
    pub(crate) untold_rates: Vec<usize>,
    /// The coordinates of quaternions, four by four, in whose velocities an angular velocity stands.
    pub(crate) turning: Vec<(usize, GuessKind)>,
}

impl Held {
    pub(crate) fn both(coordinates: Vec<usize>) -> Self {
        Held {
            positions: coordinates.clone(),
            velocities: coordinates,
            ..Held::default()
        }
    }

    /// All coordinates that keep anything, each once.
    fn all(&self) -> Vec<usize> {
        let mut all = [&self.positions[..], &self.velocities].concat();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// What is held without coordinate `j`.
    fn without(&self, j: usize) -> Self {
        let others = |held: &[usize]| held.iter().copied().filter(|k| *k != j).collect();
        Held {
            positions: others(&self.positions),
            velocities: others(&self.velocities),
            ..self.clone()
        }
    }

    /// `v` with the rates of quaternions at `q` in place of angular velocities: ė = ½ ω e of ω in axes of the ground, ½ e ω of it in those
    /// of the body.
    fn rates(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        let mut rates = v.to_vec();
        for group in self.turning.chunks_exact(4) {
            let (first, kind) = group[0];
            let (e, w) = (&q[first..first + 4], &v[first..first + 4]);
            let side = if kind == GuessKind::Spin { -1.0 } else { 1.0 };
            rates[first] = -0.5 * (w[1] * e[1] + w[2] * e[2] + w[3] * e[3]);
            for k in 1..4 {
                let (i, j) = (k % 3 + 1, (k + 1) % 3 + 1);
                rates[first + k] = 0.5 * (e[0] * w[k] + side * (w[i] * e[j] - w[j] * e[i]));
            }
        }
        rates
    }
}

/// [`assemble`] with coordinates held by their positions.
///
/// # Errors
/// What [`assemble`] reports, but for names.
pub(crate) fn assembled(mech: &Prepared, guess: &State, held: Held) -> Result<State, Error> {
    guess.check(mech)?;
    naming::inertias(mech)?;
    search(mech, guess, &held).map_err(|error| blame(mech, guess, &held, error))
}

fn search(mech: &Prepared, guess: &State, held: &Held) -> Result<State, Error> {
    let mut search = Search::new(mech, guess, &held.positions);
    search.untold.clone_from(&held.untold);
    let q = search.find(&At::new(mech, Level::Position, guess.t, &guess.v), &guess.q)?;
    Search::velocities(mech, guess, held, q)
}

/// `error` with the held coordinates that cause it: those that help if let go alone; if none does, all, provided that letting all go helps.
fn blame(mech: &Prepared, guess: &State, held: &Held, mut error: Error) -> Error {
    let all = held.all();
    if let Error::NotAssembled { held: cause, .. } = &mut error
        && !all.is_empty()
        && search(mech, guess, &Held::default()).is_ok()
    {
        let mut blamed = all.clone();
        blamed.retain(|j| search(mech, guess, &held.without(*j)).is_ok());
        let blamed = if blamed.is_empty() { all } else { blamed };
        cause.extend(blamed.iter().map(|j| {
            let name = mech.spec().coords[*j];
            match held.positions.contains(j) {
                true => name.to_owned(),
                false => format!("dot({name})"),
            }
        }));
    }
    error
}

#[cfg(test)]
mod tests;
