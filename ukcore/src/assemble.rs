//! From a rough guess to a consistent state.
//!
//! Closed loops cannot be drawn by hand to rounding. [`assemble`] takes a guess and coordinates to hold and finds a state near it
//! that satisfies every constraint: damped Gauss-Newton (Levenberg-Marquardt) on φ, then one linear solve for the velocities
//! (Newton, if nonholonomic constraints are nonlinear). Each constraint is scaled to a row of A of unit norm, and each
//! coordinate by the root of its inertia, so that the state found is near in the mass metric.

use nalgebra::DMatrix;

use crate::diagnose;
use crate::error::Error;
use crate::mechanism::{Constraints, Mechanism, Prepared};
use crate::pinv::Decomposition;
use crate::rounding::Rounded;
use crate::scalar::Scalar;
use crate::solver::RANK_TOLERANCE;

/// A residual counts as zero below this many ε of the rounding that its evaluation carries to first order; see `stabilise`, whose
/// projection does the last digits where nothing is held.
const ROUNDING: f64 = 64.0;

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

/// A time, coordinates and velocities.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time t.
    pub t: f64,
    /// Coordinates q, in the order of [`Spec::coords`](crate::Spec::coords).
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
        self.position.iter().fold(0.0, |s, r| s.max(r.abs()))
    }

    /// Largest |φ̇| or |ψ|; 0 without constraints.
    #[must_use]
    pub fn largest_velocity(&self) -> f64 {
        self.velocity.iter().fold(0.0, |s, r| s.max(r.abs()))
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
    let mut free = vec![true; spec.n()];
    for name in hold {
        let member = |c: &str| c.split_once('[').is_some_and(|(family, _)| family == *name);
        let members: Vec<usize> = (0..spec.n()).filter(|&j| member(spec.coords[j])).collect();
        if members.is_empty() {
            free[spec.coordinate_index(name)?] = false;
        }
        members.into_iter().for_each(|j| free[j] = false);
    }
    search(&mech, &guess, &free).map_err(|error| blame(&mech, &guess, &free, error))
}

fn search(mech: &Prepared, guess: &State, free: &[bool]) -> Result<State, Error> {
    let mut problem = Problem::new(mech, guess, free);
    let q = problem.find(Level::Position, &guess.q, &guess.v)?;
    let v = problem.find(Level::Velocity, &guess.v, &q)?;
    Ok(State { t: guess.t, q, v })
}

/// `error` with the held coordinates that cause it: those that help if let go alone; if none does, all, provided that letting all go helps.
fn blame(mech: &Prepared, guess: &State, free: &[bool], error: Error) -> Error {
    let Error::NotAssembled {
        level, constraints, ..
    } = error
    else {
        return error;
    };
    let held: Vec<usize> = (0..free.len()).filter(|&j| !free[j]).collect();
    let helps = |let_go: &[usize]| {
        let mut free = free.to_vec();
        let_go.iter().for_each(|&j| free[j] = true);
        search(mech, guess, &free).is_ok()
    };
    let mut cause = Vec::new();
    if !held.is_empty() && helps(&held) {
        cause = held.clone();
        cause.retain(|&j| helps(&[j]));
        if cause.is_empty() {
            cause = held;
        }
    }
    Error::NotAssembled {
        level,
        constraints,
        held: cause
            .into_iter()
            .map(|j| mech.spec().coords[j].to_owned())
            .collect(),
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    Position,
    Velocity,
}

/// The least-squares problem of one level at a time.
struct Problem<'a> {
    mech: &'a Prepared,
    rounded: Prepared<Rounded, dyn Constraints<Rounded>>,
    t: f64,
    /// Indices of the coordinates that may change, and 1/√M_jj for each.
    free: Vec<usize>,
    scale: Vec<f64>,
    jacobian: Vec<f64>,
}

/// One point of the search: scaled residual and Jacobian.
struct Point {
    x: Vec<f64>,
    residual: Vec<f64>,
    /// What rounding each residual carries, in units of ε.
    rounding: Vec<f64>,
    /// 1/‖row‖ over the free coordinates; over all where that is zero.
    row_scale: Vec<f64>,
    /// Rows scaled, columns scaled, free columns only.
    matrix: DMatrix<f64>,
}

impl Point {
    /// ½ Σ (s_c φ_c)².
    fn cost(&self, residual: &[f64]) -> f64 {
        residual
            .iter()
            .zip(&self.row_scale)
            .map(|(r, s)| (r * s).powi(2))
            .sum()
    }

    fn met(&self, c: usize) -> bool {
        self.residual[c].abs() <= ROUNDING * f64::EPSILON * self.rounding[c]
    }

    fn all_met(&self) -> bool {
        (0..self.residual.len()).all(|c| self.met(c))
    }
}

impl<'a> Problem<'a> {
    fn new(mech: &'a Prepared, guess: &State, free: &[bool]) -> Self {
        let n = mech.spec().n();
        let mut mass = vec![0.0; n * n];
        mech.mass_matrix(guess.t, &guess.q, &mut mass);
        let inertia: Vec<f64> = (0..n).map(|j| mass[j * n + j]).collect();
        let massive: Vec<f64> = inertia
            .iter()
            .copied()
            .filter(|m| *m > 0.0 && m.is_finite())
            .collect();
        // Massless coordinates move as readily as the middling massive ones.
        let typical = match massive.len() {
            0 => 1.0,
            k => (massive.iter().map(|m| m.ln()).sum::<f64>() / k as f64).exp(),
        };
        let free: Vec<usize> = (0..n).filter(|&j| free[j]).collect();
        let scale = free.iter().map(|&j| match inertia[j] {
            m if m > 0.0 && m.is_finite() => m.sqrt().recip(),
            _ => typical.sqrt().recip(),
        });
        Problem {
            mech,
            rounded: mech.rounded(),
            t: guess.t,
            scale: scale.collect(),
            free,
            jacobian: vec![0.0; n * mech.spec().m()],
        }
    }

    fn residual<S: Scalar, C: ?Sized + Constraints<S>>(
        &self,
        mech: &Prepared<S, C>,
        level: Level,
        x: &[S],
        other: &[S],
    ) -> Vec<S> {
        let (spec, t, zero) = (mech.spec(), S::from_f64(self.t), S::from_f64(0.0));
        match level {
            Level::Position => {
                let mut phi = vec![zero; spec.holonomic];
                mech.residual(t, x, &mut phi);
                phi
            }
            Level::Velocity => {
                let mut rate = vec![zero; spec.m()];
                mech.residual_rate(t, other, x, &mut rate);
                rate
            }
        }
    }

    fn point(&mut self, level: Level, x: Vec<f64>, other: &[f64]) -> Point {
        let (n, m) = (self.mech.spec().n(), self.mech.spec().m());
        let residual = self.residual(self.mech, level, &x, other);
        match level {
            Level::Position => self.mech.jacobian(self.t, &x, other, &mut self.jacobian),
            Level::Velocity => self.mech.jacobian(self.t, other, &x, &mut self.jacobian),
        }
        let rows = residual.len();
        let a = &self.jacobian;
        let mut matrix = DMatrix::zeros(rows, self.free.len());
        for (k, (&j, scale)) in self.free.iter().zip(&self.scale).enumerate() {
            for c in 0..rows {
                matrix[(c, k)] = a[j * m + c] * scale;
            }
        }
        let mut row_scale = vec![1.0; rows];
        for c in 0..rows {
            let norm = matrix.row(c).norm();
            let whole = (0..n).map(|j| a[j * m + c].powi(2)).sum::<f64>().sqrt();
            if norm > 0.0 || whole > 0.0 {
                row_scale[c] = if norm > 0.0 { norm } else { whole }.recip();
            }
            matrix.row_mut(c).scale_mut(row_scale[c]);
        }
        let fixed: Vec<Rounded> = other.iter().map(|x| Rounded::exact(*x)).collect();
        let given: Vec<Rounded> = x.iter().map(|x| Rounded::unknown(*x)).collect();
        let rounded = self.residual(&self.rounded, level, &given, &fixed);
        Point {
            x,
            residual,
            rounding: rounded.iter().map(|r| r.bound()).collect(),
            row_scale,
            matrix,
        }
    }

    /// The solution for one level; tries the guess, then perturbations of it.
    fn find(&mut self, level: Level, guess: &[f64], other: &[f64]) -> Result<Vec<f64>, Error> {
        let size = guess.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
        let size = if size > 0.0 { size } else { 1.0 };
        let mut best: Option<(f64, Point)> = None;
        for shake in SHAKES {
            let mut x = guess.to_vec();
            for (k, &j) in self.free.iter().enumerate() {
                // Deterministic, and no two coordinates alike.
                let share = ((k as f64 + 1.0) * GOLDEN).fract();
                x[j] += shake * size * (2.0 * share - 1.0);
            }
            let point = self.descend(level, x, other);
            if point.all_met() {
                return Ok(point.x);
            }
            let cost = point.cost(&point.residual);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, point));
            }
            let spec = self.mech.spec();
            if level == Level::Velocity && spec.holonomic == spec.m() {
                // Linear: nothing else to find.
                break;
            }
        }
        match best {
            Some((_, point)) => Err(self.conflict(level, &point)),
            None => Ok(guess.to_vec()),
        }
    }

    /// Levenberg-Marquardt from `x`, to a solution or as near to one as it comes.
    fn descend(&mut self, level: Level, x: Vec<f64>, other: &[f64]) -> Point {
        let mut point = self.point(level, x, other);
        let (mut damping, mut stalls) = (DAMPING, 0);
        for _ in 0..MAX_STEPS {
            if point.all_met() || self.free.is_empty() || stalls > 3 {
                break;
            }
            let cost = point.cost(&point.residual);
            // √cost → 0 takes the damping with it: quadratic convergence at the end.
            let step = self.step(&point, damping * cost.sqrt().min(1.0));
            let mut x = point.x.clone();
            for ((&j, scale), d) in self.free.iter().zip(&self.scale).zip(&step) {
                x[j] += scale * d;
            }
            let trial = self.residual(self.mech, level, &x, other);
            let trial_cost = point.cost(&trial);
            if trial_cost < cost {
                // At the rounding level costs may fall for ever by tiny amounts.
                stalls = if trial_cost > 0.99 * cost {
                    stalls + 1
                } else {
                    0
                };
                damping = (damping / DAMPING_FACTOR).max(f64::EPSILON);
                point = self.point(level, x, other);
            } else {
                damping *= DAMPING_FACTOR;
                if damping > DAMPING_LIMIT {
                    break;
                }
            }
        }
        point
    }

    /// d that minimises |J d + φ|² + μ|d|², by the decomposition of \[J; √μ I\].
    fn step(&self, point: &Point, mu: f64) -> Vec<f64> {
        let (rows, k) = point.matrix.shape();
        let root = mu.sqrt();
        let mut decomposition = Decomposition::new(rows + k, k);
        let columns = decomposition.load(rows + k);
        columns.fill(0.0);
        for (c, column) in columns.chunks_exact_mut(k).enumerate() {
            if c < rows {
                column
                    .iter_mut()
                    .zip(point.matrix.row(c).iter())
                    .for_each(|(x, a)| *x = *a);
            } else {
                column[c - rows] = root;
            }
        }
        decomposition.factor(&vec![1.0; k], &vec![1.0; rows + k], RANK_TOLERANCE);
        let mut right = vec![0.0; rows + k];
        let scaled = point.residual.iter().zip(&point.row_scale);
        right
            .iter_mut()
            .zip(scaled)
            .for_each(|(b, (r, s))| *b = -r * s);
        let mut d = vec![0.0; k];
        decomposition.solve(&right, &mut d);
        d
    }

    fn conflict(&self, level: Level, point: &Point) -> Error {
        let mut residual = point.residual.clone();
        if residual.iter().any(|r| !r.is_finite()) {
            return diagnose::non_finite_residual(self.mech.spec(), &residual);
        }
        for (c, r) in residual.iter_mut().enumerate() {
            if point.met(c) {
                *r = 0.0;
            }
        }
        Error::NotAssembled {
            level: match level {
                Level::Position => "position",
                Level::Velocity => "velocity",
            },
            constraints: diagnose::offending(self.mech.spec(), &residual, &point.row_scale),
            held: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests;
