//! From a rough guess to a consistent state.
//!
//! Closed loops cannot be drawn by hand to rounding. [`assemble`] takes a guess and coordinates to hold and finds a state near it that
//! satisfies every constraint: damped Gauss-Newton (Levenberg-Marquardt) finds the place, and projection in the mass metric gives the
//! last digits; velocities that enter linearly it gives at once. For the search each constraint is scaled to a row of A of unit norm, and
//! each coordinate by the root of its inertia, so that the state found is near in the mass metric.

use nalgebra::DMatrix;

use crate::diagnose;
use crate::error::Error;
use crate::manifold::{At, Level, Manifold};
use crate::mechanism::{Mechanism, Prepared};
use crate::pinv::Decomposition;
use crate::scan::largest;
use crate::solver::RANK_TOLERANCE;

/// Steps at most from one guess. Levenberg-Marquardt converges quadratically at the end; a long chain laid out wrongly takes some
/// tens of steps to unfold.
const MAX_STEPS: usize = 200;

/// Guesses: the given one, then it with perturbations of [`SHAKES`] times the size of the coordinates. A guess with points that
/// coincide has vanishing gradients, from which only a perturbation leads away.
const SHAKES: [f64; 4] = [0.0, 1e-3, 3e-2, 0.3];

/// Fractional part of the golden ratio: its multiples fill the unit interval evenly.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Damping to start with, relative to rows of unit norm: near Gauss-Newton, yet proof against a vanishing singular value.
const DAMPING: f64 = 1e-3;

/// The damping grows by this after a step that made things worse, and falls by it after one that helped.
const DAMPING_FACTOR: f64 = 10.0;

/// Beyond this damping steps are below rounding: a minimum that is not zero.
const DAMPING_LIMIT: f64 = 1e16;

/// Where the search ends as near to the constraints as this share of lengths, √ε, it has found the place, and Newton's method does the
/// rest.
const NEAR: f64 = 1.5e-8;

/// A time, coordinates and velocities.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time t.
    pub t: f64,
    /// Coordinates q, in the order of [`Spec::coords`](crate::spec::Spec::coords).
    pub q: Vec<f64>,
    /// Velocities q̇, in the same order.
    pub v: Vec<f64>,
}

impl State {
    /// The state of a mechanism at rest at q = 0, t = 0.
    #[must_use]
    pub fn zeros<M: Mechanism>() -> Self {
        let n = M::SPEC.n();
        State {
            t: 0.0,
            q: vec![0.0; n],
            v: vec![0.0; n],
        }
    }

    /// Checks lengths, and that every number is finite.
    ///
    /// # Errors
    /// [`Error::WrongLength`], [`Error::NonFinite`] (also for parameters of `mech`).
    pub fn check(&self, mech: &Prepared) -> Result<(), Error> {
        let n = mech.spec().n();
        diagnose::check_length("q", self.q.len(), n)?;
        diagnose::check_length("v", self.v.len(), n)?;
        diagnose::bad_input(mech, self.t, &self.q, &self.v).map_or(Ok(()), Err)
    }
}

/// How far a state is off the constraints, in the constraints' own units.
#[derive(Debug, Clone, PartialEq)]
pub struct Residuals {
    /// φ(q, t) of the h holonomic constraints.
    pub position: Vec<f64>,
    /// φ̇ of the holonomic and φ(q, q̇, t) of the nonholonomic constraints, m values.
    pub velocity: Vec<f64>,
}

impl Residuals {
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
    let spec = mech.spec();
    diagnose::check_length("q", state.q.len(), spec.n())?;
    diagnose::check_length("v", state.v.len(), spec.n())?;
    let mut position = vec![0.0; spec.holonomic];
    let mut velocity = vec![0.0; spec.m()];
    mech.residual(state.t, &state.q, &mut position);
    mech.residual_rate(state.t, &state.q, &state.v, &mut velocity);
    Ok(Residuals { position, velocity })
}

/// A consistent state near `guess`: φ(q, t) = 0, φ̇ = 0 and φ(q, q̇, t) = 0 to rounding. The coordinates named in `hold` keep both
/// their value and their velocity; a family's bare name (`"x"` for `x[0]`, `x[1]`, …) holds all its members.
///
/// # Errors
/// - [`Error::NotAssembled`]: no state near the guess satisfies all constraints with these coordinates held; names those in
///   conflict with the residuals that remain where their squares (scaled) are least, and the held coordinates where these are the cause.
/// - [`Error::UnknownName`] for a name in `hold`; [`Error::WrongLength`]; [`Error::NonFinite`].
pub fn assemble(
    mechanism: impl Into<Prepared>,
    guess: State,
    hold: &[&str],
) -> Result<State, Error> {
    let mech: Prepared = mechanism.into();
    guess.check(&mech)?;
    let spec = mech.spec();
    let mut held = Vec::new();
    for name in hold {
        let member = |c: &str| c.split_once('[').is_some_and(|(family, _)| family == *name);
        let before = held.len();
        held.extend((0..spec.n()).filter(|&j| member(spec.coords[j])));
        if held.len() == before {
            held.push(spec.coordinate_index(name)?);
        }
    }
    held.sort_unstable();
    held.dedup();
    search(&mech, &guess, &held).map_err(|error| blame(&mech, &guess, &held, error))
}

fn search(mech: &Prepared, guess: &State, held: &[usize]) -> Result<State, Error> {
    let mut search = Search::new(mech, guess, held);
    let q = search.find(&At::new(mech, Level::Position, guess.t, &guess.v), &guess.q)?;
    let v = search.find(&At::new(mech, Level::Velocity, guess.t, &q), &guess.v)?;
    Ok(State { t: guess.t, q, v })
}

/// `error` with the held coordinates that cause it: those that help if let go alone; if none does, all, provided that letting all go helps.
fn blame(mech: &Prepared, guess: &State, held: &[usize], mut error: Error) -> Error {
    if let Error::NotAssembled { held: cause, .. } = &mut error
        && !held.is_empty()
        && search(mech, guess, &[]).is_ok()
    {
        let mut blamed = held.to_vec();
        blamed.retain(|j| {
            let others: Vec<usize> = held.iter().copied().filter(|other| other != j).collect();
            search(mech, guess, &others).is_ok()
        });
        let blamed = if blamed.is_empty() { held } else { &blamed };
        let names = blamed.iter().map(|&j| mech.spec().coords[j].to_owned());
        cause.extend(names);
    }
    error
}

/// The search for q, then for q̇.
struct Search {
    manifold: Manifold,
    /// Indices of the coordinates that may change, and 1/√M_jj for each.
    free: Vec<usize>,
    scale: Vec<f64>,
}

/// One point of the search.
struct Point {
    x: Vec<f64>,
    residual: Vec<f64>,
    /// 1/‖row‖ over the free coordinates; over all where that is zero.
    row_scale: Vec<f64>,
    /// Rows scaled, columns scaled, free columns only.
    matrix: DMatrix<f64>,
    /// Whether the residuals will do, and whether Newton's method will make them do.
    met: bool,
    near: bool,
}

impl Point {
    /// Σ (s_c φ_c)².
    fn cost(&self, residual: &[f64]) -> f64 {
        let scaled = residual.iter().zip(&self.row_scale);
        scaled.map(|(r, s)| (r * s).powi(2)).sum()
    }

    /// d that minimises |J d + φ|² + μ|d|², by the decomposition of \[J; √μ I\].
    fn step(&self, mu: f64) -> Vec<f64> {
        let (rows, k) = self.matrix.shape();
        let mut decomposition = Decomposition::new(rows + k, k);
        let columns = decomposition.load(rows + k).chunks_exact_mut(k);
        for (c, column) in columns.enumerate() {
            column.fill(0.0);
            if c < rows {
                let row = self.matrix.row(c);
                column.iter_mut().zip(&row).for_each(|(x, a)| *x = *a);
            } else {
                column[c - rows] = mu.sqrt();
            }
        }
        decomposition.factor(&vec![1.0; k], &vec![1.0; rows + k], RANK_TOLERANCE);
        let scaled = self.residual.iter().zip(&self.row_scale);
        let mut right: Vec<f64> = scaled.map(|(r, s)| -r * s).collect();
        right.resize(rows + k, 0.0);
        let mut d = vec![0.0; k];
        decomposition.solve(&right, &mut d);
        d
    }
}

impl Search {
    fn new(mech: &Prepared, guess: &State, held: &[usize]) -> Self {
        let n = mech.spec().n();
        let mut mass = vec![0.0; n * n];
        mech.mass_matrix(guess.t, &guess.q, &mut mass);
        let inertia = |j: usize| Some(mass[j * n + j]).filter(|m| *m > 0.0 && m.is_finite());
        let massive: Vec<f64> = (0..n).filter_map(inertia).map(f64::ln).collect();
        // Massless coordinates move as readily as the middling massive ones.
        let typical = (massive.iter().sum::<f64>() / massive.len().max(1) as f64).exp();
        let free: Vec<usize> = (0..n).filter(|j| !held.contains(j)).collect();
        let scale = free.iter().map(|&j| inertia(j).unwrap_or(typical).sqrt());
        Search {
            manifold: Manifold::new(mech, held.to_vec()),
            scale: scale.map(f64::recip).collect(),
            free,
        }
    }

    /// The point `x`. Coordinates that are zero are measured by `size`.
    fn point(&mut self, at: &At<'_, f64>, x: Vec<f64>, size: f64) -> Point {
        let (n, m, rows) = (x.len(), at.mech.spec().m(), at.rows());
        let met = self.manifold.meets(at, &x, size);
        let (newton, length) = (&self.manifold.newton, self.manifold.length(at));
        let (a, residual) = (&newton.jacobian, newton.residual[..rows].to_vec());
        let mut matrix = DMatrix::from_fn(rows, self.free.len(), |c, k| {
            a[self.free[k] * m + c] * self.scale[k]
        });
        let mut row_scale = vec![1.0; rows];
        for c in 0..rows {
            let norm = matrix.row(c).norm();
            let whole = (0..n).map(|j| a[j * m + c].powi(2)).sum::<f64>().sqrt();
            if norm > 0.0 || whole > 0.0 {
                row_scale[c] = if norm > 0.0 { norm } else { whole }.recip();
            }
            matrix.row_mut(c).scale_mut(row_scale[c]);
        }
        Point {
            near: met || newton.acceptance.distance(&residual) <= NEAR * length,
            met,
            residual,
            row_scale,
            matrix,
            x,
        }
    }

    /// The solution for one level; tries the guess, then perturbations of it.
    fn find(&mut self, at: &At<'_, f64>, guess: &[f64]) -> Result<Vec<f64>, Error> {
        let mut x = guess.to_vec();
        if at.linear() && self.arrive(at, &mut x) {
            return Ok(x);
        }
        let size = match largest(guess) {
            size if size > 0.0 => size,
            _ => 1.0,
        };
        let mut best: Option<(f64, Vec<f64>)> = None;
        for shake in SHAKES {
            let mut x = guess.to_vec();
            for (k, &j) in self.free.iter().enumerate() {
                // Deterministic, and no two coordinates alike.
                let share = ((k as f64 + 1.0) * GOLDEN).fract();
                x[j] += shake * size * (2.0 * share - 1.0);
            }
            let mut point = self.descend(at, x, size);
            if point.near && self.arrive(at, &mut point.x) {
                return Ok(point.x);
            }
            let cost = point.cost(&point.residual);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, point.x));
            }
            if at.linear() {
                // Nothing else to find.
                break;
            }
        }
        let x = best.map_or(x, |(_, x)| x);
        match self.manifold.refusal(at, &x) {
            None => Ok(x),
            Some(Error::OffConstraint { level, constraints }) => Err(Error::NotAssembled {
                level,
                constraints,
                held: Vec::new(),
            }),
            Some(error) => Err(error),
        }
    }

    /// The last digits: whether `x` is on the constraints then. What cannot be projected may be there already.
    fn arrive(&mut self, at: &At<'_, f64>, x: &mut [f64]) -> bool {
        self.manifold.project(at, x).is_ok() || self.manifold.refusal(at, x).is_none()
    }

    /// Levenberg-Marquardt from `x`, to a solution or as near to one as it comes.
    fn descend(&mut self, at: &At<'_, f64>, x: Vec<f64>, size: f64) -> Point {
        let mut point = self.point(at, x, size);
        let (mut damping, mut stalls) = (DAMPING, 0);
        for _ in 0..MAX_STEPS {
            let hopeless = stalls > 3 || damping > DAMPING_LIMIT;
            if point.met || hopeless || self.free.is_empty() {
                break;
            }
            let cost = point.cost(&point.residual);
            // √cost → 0 takes the damping with it: quadratic convergence at the end.
            let step = point.step(damping * cost.sqrt().min(1.0));
            let mut x = point.x.clone();
            for ((&j, scale), d) in self.free.iter().zip(&self.scale).zip(&step) {
                x[j] += scale * d;
            }
            self.manifold.newton.evaluate(at, &x);
            let trial = point.cost(&self.manifold.newton.residual[..at.rows()]);
            if trial < cost {
                // At the rounding level costs may fall for ever by tiny amounts.
                stalls = if trial > 0.99 * cost { stalls + 1 } else { 0 };
                damping = (damping / DAMPING_FACTOR).max(f64::EPSILON);
                point = self.point(at, x, size);
            } else {
                damping *= DAMPING_FACTOR;
            }
        }
        point
    }
}

#[cfg(test)]
mod tests;
