//! Keeping the state on the constraints.
//!
//! The smallest change of q (in the metric M) with φ(q, t) = 0 solves, to first order, minimise ½ Δᵀ M Δ subject to A Δ = −φ: the
//! constrained solve of eqs. 13 and 19 with Q = 0 and b = −φ. Newton's method repeats it; near the manifold the factors of the
//! first step serve for the following ones too, since each step then still divides the residual by 1/δ for a state at distance δ.

use crate::diagnose;
use crate::error::Error;
use crate::mechanism::{Mechanism, Prepared};
use crate::metric::MassFault;
use crate::rounding::Rounded;
use crate::solver::{Baumgarte, RANK_CEILING, RANK_TOLERANCE, leading, mass_error};
use crate::workspace::{Dense, Owner, Route, Rows};

/// A residual is at rounding level if it does not exceed this many ε of the size Σ|A_ij q_j| of what q's own rounding contributes:
/// one for q, one or two for the evaluation of φ.
pub(crate) const ROUNDING: f64 = 4.0;

/// A projection that has stopped making progress is accepted if no residual exceeds this many ε of max|A_ij| max|q_j| over the
/// coordinates of its constraint, or of the rounding that evaluating it carries where that is more: terms that cancel, or constraints that nearly lose rank, can keep it above [`ROUNDING`].
/// Lengths of links among coordinates thirty times as large still hold to 1e-12.
pub(crate) const STALLED: f64 = 64.0;

/// The largest coordinate counts into the size of every constraint's terms with this share: a coordinate that the constraints put
/// to zero takes rounding errors from the others through the solve, and has no size of its own to measure them by. The share is
/// small because coordinates need not be of one unit.
pub(crate) const NEIGHBOUR: f64 = 1e-4;

/// Progress: a Newton step that does not divide the residual by this is not converging quadratically.
const PROGRESS: f64 = 0.1;

/// The factors of an earlier step are used again while they divide the residual by this.
const KEEP_FACTORS: f64 = 1e-2;

/// Newton steps at most. Quadratic convergence needs about six from any useful state; some more for states far off.
const MAX_STEPS: usize = 40;

/// Newton steps by the emitted elimination before the rank-revealing solve takes over.
const STRAIGHT_STEPS: usize = 8;

/// Steps without progress before giving up: far from the manifold the residual need not fall at once.
const MAX_STALLS: usize = 6;

/// How drift off the constraints is kept down during integration.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Stabilisation {
    /// Projection of q and q̇ after each accepted step.
    #[default]
    Projection,
    /// Feedback in b.
    Baumgarte(Baumgarte),
    /// Nothing: A q̈ = b alone.
    None,
}

/// What a projection did.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Correction {
    /// Size of the change: the largest |Δq_j| (or |Δq̇_j|) over all coordinates, in their own units.
    pub norm: f64,
    /// Newton steps; 0 if the state was consistent already.
    pub iterations: usize,
    /// Largest |φ| (or |φ̇|, |ψ|) left, in the constraints' own units.
    pub residual: f64,
}

/// Position (φ) or velocity (φ̇ and ψ).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    Position,
    Velocity,
}

/// Projects states onto the constraints, in buffers allocated once.
#[derive(Debug, Clone)]
pub struct Projector {
    owner: Owner,
    n: usize,
    m: usize,
    holonomic: usize,
    mass: Vec<f64>,
    jacobian: Vec<f64>,
    residual: Vec<f64>,
    rhs: Vec<f64>,
    start: Vec<f64>,
    /// max|x| at the start of the projection.
    size: f64,
    best: Vec<f64>,
    step: Vec<f64>,
    /// What rounding the evaluation of each constraint carries, in units of ε; 0 until it is needed.
    rounding: Vec<f64>,
    rounded: [Vec<Rounded>; 5],
    dense: Dense,
    /// Position up to which the factors in `dense` hold all rows of A, for the velocity projection that follows.
    factored_at: Option<f64>,
    factored_q: Vec<f64>,
    /// Whether rows below the ceiling are left out.
    cautious: bool,
}

impl Projector {
    /// A projector for mechanisms of type `M`.
    #[must_use]
    pub fn new<M: Mechanism>() -> Self {
        let spec = M::SPEC;
        let (n, m) = (spec.n(), spec.m());
        Projector {
            owner: Owner::of::<M>(),
            n,
            m,
            holonomic: spec.holonomic,
            mass: vec![0.0; n * n],
            jacobian: vec![0.0; m * n],
            residual: vec![0.0; m],
            rhs: vec![0.0; m],
            start: vec![0.0; n],
            size: 0.0,
            best: vec![0.0; n],
            step: vec![0.0; n],
            rounding: vec![0.0; m],
            rounded: [n, n, m, spec.params.len(), spec.prepared.len()]
                .map(|len| vec![Rounded::exact(0.0); len]),
            dense: Dense::new(n, m, spec.structure.mass_diagonal),
            factored_at: None,
            factored_q: vec![0.0; n],
            cautious: true,
        }
    }

    /// Minimal change of q in the mass metric with φ(q, t) = 0 to rounding level. Massless coordinates follow the constraints.
    /// Allocates nothing unless it fails; then `q` is left as it was.
    ///
    /// # Errors
    /// [`Error::OffConstraint`] with the constraints that cannot be met near q; [`Error::NonFinite`], [`Error::IndefiniteMass`],
    /// [`Error::WrongLength`].
    pub fn position<M: Mechanism>(
        &mut self,
        mech: &Prepared<M>,
        t: f64,
        q: &mut [f64],
        v: &[f64],
    ) -> Result<Correction, Error> {
        self.check_lengths::<M>(q, v)?;
        self.factored_at = None;
        self.start.copy_from_slice(q);
        let result = self.newton(mech, t, q, v, Level::Position);
        match &result {
            // The factors belong to a q that differs by the correction: good enough for what is then a chord step.
            Ok(c) if c.iterations > 0 && self.holonomic == self.m => {
                self.factored_at = Some(t);
                self.factored_q.copy_from_slice(q);
            }
            Ok(_) => {}
            Err(_) => q.copy_from_slice(&self.start),
        }
        result
    }

    /// Minimal change of q̇ in the mass metric with φ̇ = 0 and ψ = 0 (all constraints) to rounding level; nonholonomic ones may be
    /// nonlinear in q̇. Allocates nothing unless it fails; then `v` is left as it was.
    ///
    /// # Errors
    /// As [`Projector::position`].
    pub fn velocity<M: Mechanism>(
        &mut self,
        mech: &Prepared<M>,
        t: f64,
        q: &[f64],
        v: &mut [f64],
    ) -> Result<Correction, Error> {
        self.check_lengths::<M>(q, v)?;
        self.start.copy_from_slice(v);
        let result = self.newton(mech, t, v, q, Level::Velocity);
        if result.is_err() {
            v.copy_from_slice(&self.start);
        }
        self.factored_at = None;
        result
    }

    fn check_lengths<M: Mechanism>(&self, q: &[f64], v: &[f64]) -> Result<(), Error> {
        diagnose::check_length("q", q.len(), self.n)?;
        diagnose::check_length("v", v.len(), self.n)?;
        self.owner.check::<M>("projector")
    }

    /// Newton's method on `x`: q with `other` = q̇, or q̇ with `other` = q.
    fn newton<M: Mechanism>(
        &mut self,
        mech: &Prepared<M>,
        t: f64,
        x: &mut [f64],
        other: &[f64],
        level: Level,
    ) -> Result<Correction, Error> {
        let rows = if level == Level::Position {
            self.holonomic
        } else {
            self.m
        };
        let mut correction = Correction::default();
        self.size = x.iter().fold(0.0, |s, x| s.max(x.abs()));
        self.rounding.fill(0.0);
        self.evaluate(mech, t, x, other, level);
        let mut factored =
            level == Level::Velocity && self.factored_at == Some(t) && self.factored_q == other;
        self.jacobian(mech, t, x, other, level);
        correction.residual = self.largest(rows);
        if !self.finite(rows) {
            return Err(self.non_finite(mech, t, x, other, level, rows));
        }
        if self.at_rounding(x, rows) {
            return Ok(correction);
        }
        if M::SPEC.structure.straight_line && rows == self.m {
            if self.straight_line(mech, t, x, other, level, &mut correction) {
                return Ok(correction);
            }
            x.copy_from_slice(&self.start);
            self.evaluate(mech, t, x, other, level);
            correction.iterations = 0;
        }
        if !factored {
            self.cautious = true;
            self.factor(
                mech,
                t,
                if level == Level::Position { x } else { other },
                rows,
            )?;
        }
        self.best.copy_from_slice(x);
        let mut merit = self.merit(x, rows);
        let (mut best_merit, mut stalls) = (merit, 0);
        while correction.iterations < MAX_STEPS {
            correction.iterations += 1;
            self.advance(x, rows);
            self.evaluate(mech, t, x, other, level);
            let previous = merit;
            merit = self.merit(x, rows);
            if merit.is_finite() && merit < best_merit {
                best_merit = merit;
                self.best.copy_from_slice(x);
            }
            if merit.is_finite() && self.at_rounding(x, rows) {
                break;
            }
            let progress = merit <= PROGRESS * previous;
            if progress && merit <= KEEP_FACTORS * previous {
                continue;
            }
            if !progress && !factored {
                // Fresh factors and no progress: rows left out are not implied after all, or this is rounding, or far away.
                if self.widen() {
                    continue;
                }
                stalls += 1;
                self.measure_rounding(mech, t, x, other, level);
                if self.acceptable(x, rows) || stalls > MAX_STALLS || !merit.is_finite() {
                    break;
                }
            }
            factored = false;
            self.jacobian(mech, t, x, other, level);
            self.factor(
                mech,
                t,
                if level == Level::Position { x } else { other },
                rows,
            )?;
            merit = self.merit(x, rows);
        }
        x.copy_from_slice(&self.best);
        self.evaluate(mech, t, x, other, level);
        correction.residual = self.largest(rows);
        let changes = x.iter().zip(&self.start);
        correction.norm = changes.fold(0.0, |s, (x, y)| s.max((x - y).abs()));
        self.measure_rounding(mech, t, x, other, level);
        if self.at_rounding(x, rows) || self.acceptable(x, rows) {
            return Ok(correction);
        }
        Err(self.off_constraint::<M>(x, rows, level))
    }

    /// Newton's method with the emitted elimination; `false` if its certificate does not hold or it does not converge at once, with
    /// `x` left somewhere.
    fn straight_line<M: Mechanism>(
        &mut self,
        mech: &Prepared<M>,
        t: f64,
        x: &mut [f64],
        other: &[f64],
        level: Level,
        correction: &mut Correction,
    ) -> bool {
        let rows = self.m;
        let mut merit = self.merit(x, rows);
        while correction.iterations < STRAIGHT_STEPS {
            correction.iterations += 1;
            let (q, v) = match level {
                Level::Position => (&*x, other),
                Level::Velocity => (other, &*x),
            };
            let safe = mech.correction(t, q, v, &self.residual, &mut self.step);
            if safe <= 0.5 || !self.step.iter().sum::<f64>().is_finite() {
                return false;
            }
            x.iter_mut().zip(&self.step).for_each(|(x, d)| *x += d);
            self.evaluate(mech, t, x, other, level);
            let previous = merit;
            merit = self.merit(x, rows);
            if merit.is_nan() {
                return false;
            }
            let progress = merit <= PROGRESS * previous;
            if !progress {
                self.measure_rounding(mech, t, x, other, level);
            }
            if merit == 0.0 || (!progress && self.acceptable(x, rows)) {
                correction.residual = self.largest(rows);
                let changes = x.iter().zip(&self.start);
                correction.norm = changes.fold(0.0, |s, (x, y)| s.max((x - y).abs()));
                return true;
            }
            if !progress {
                return false;
            }
        }
        false
    }

    /// φ, or φ̇ and ψ, into `residual`.
    fn evaluate<M: Mechanism>(
        &mut self,
        mech: &Prepared<M>,
        t: f64,
        x: &[f64],
        other: &[f64],
        level: Level,
    ) {
        match level {
            Level::Position => mech.residual(t, x, &mut self.residual[..self.holonomic]),
            Level::Velocity => mech.residual_rate(t, other, x, &mut self.residual),
        }
    }

    /// What rounding the residuals at `x` carry. Where coordinates are small beside the lengths in a constraint (measured from the
    /// state at rest, say), this is far more than their own rounding makes of it.
    fn measure_rounding<M: Mechanism>(
        &mut self,
        mech: &Prepared<M>,
        t: f64,
        x: &[f64],
        other: &[f64],
        level: Level,
    ) {
        let [given, fixed, residual, params, prepared] = &mut self.rounded;
        let exact = mech.parameters().iter().map(|p| Rounded::exact(*p));
        params.iter_mut().zip(exact).for_each(|(r, p)| *r = p);
        M::prepare(params, prepared);
        given
            .iter_mut()
            .zip(x)
            .for_each(|(r, x)| *r = Rounded::unknown(*x));
        fixed
            .iter_mut()
            .zip(other)
            .for_each(|(r, x)| *r = Rounded::exact(*x));
        let t = Rounded::exact(t);
        let rows = match level {
            Level::Position => {
                M::residual(prepared, t, given, &mut residual[..self.holonomic]);
                self.holonomic
            }
            Level::Velocity => {
                M::residual_rate(prepared, t, fixed, given, residual);
                self.m
            }
        };
        for (size, r) in self.rounding.iter_mut().zip(&residual[..rows]) {
            *size = r.bound();
        }
    }

    fn jacobian<M: Mechanism>(
        &mut self,
        mech: &Prepared<M>,
        t: f64,
        x: &[f64],
        other: &[f64],
        level: Level,
    ) {
        match level {
            Level::Position => mech.jacobian(t, x, other, &mut self.jacobian),
            Level::Velocity => mech.jacobian(t, other, x, &mut self.jacobian),
        }
    }

    /// Factors M and the first `rows` rows of A. While `cautious`, rows of a significance below the ceiling are left out: off the
    /// manifold nobody can tell whether they are implied; if they are not, the residual will not fall, and they are taken in.
    fn factor<M: Mechanism>(
        &mut self,
        mech: &Prepared<M>,
        t: f64,
        q: &[f64],
        rows: usize,
    ) -> Result<(), Error> {
        mech.mass_matrix(t, q, &mut self.mass);
        if !self.mass.iter().all(|x| x.is_finite()) || !self.jacobian.iter().all(|x| x.is_finite())
        {
            let (mass, jacobian) = (&self.mass, &self.jacobian);
            let what = diagnose::non_finite_matrices(M::SPEC, mass, jacobian);
            return Err(Error::NonFinite { what });
        }
        let a = rows_of(&self.jacobian, self.m, rows);
        let massless = !M::SPEC.structure.massless.is_empty();
        let route = if massless {
            Route::Singular
        } else {
            Route::Regular
        };
        let result = match self.dense.factor(route, &self.mass, a, RANK_TOLERANCE) {
            Err(MassFault::Singular(_)) => {
                self.dense
                    .factor(Route::Singular, &self.mass, a, RANK_TOLERANCE)
            }
            result => result,
        };
        result.map_err(|fault| mass_error::<M>(fault))?;
        let pivots = self.dense.cod.pivots();
        let rank = if self.cautious {
            leading(pivots, RANK_CEILING)
        } else {
            pivots.len()
        };
        self.dense
            .set_rank(rank, &self.mass)
            .map_err(|fault| mass_error::<M>(fault))
    }

    /// Takes in the rows left out so far; `false` if there are none.
    fn widen(&mut self) -> bool {
        let all = self.dense.cod.pivots().len();
        if !self.cautious || self.dense.cod.rank() == all {
            return false;
        }
        self.cautious = false;
        // An indefinite M would show at the next full factorisation; here the directions concerned stay at rest.
        self.dense.set_rank(all, &self.mass).is_ok()
    }

    /// x ← x + Δ with A Δ = −residual, Δ minimal.
    fn advance(&mut self, x: &mut [f64], rows: usize) {
        let rhs = &mut self.rhs[..rows];
        rhs.iter_mut()
            .zip(&self.residual)
            .for_each(|(b, r)| *b = -r);
        let a = rows_of(&self.jacobian, self.m, rows);
        self.dense.solve(&self.mass, a, None, rhs, &mut self.step);
        x.iter_mut().zip(&self.step).for_each(|(x, d)| *x += d);
    }

    /// How far off: |φ_c| / max|A_cj|, the largest over the rows that are not at rounding level yet.
    fn merit(&self, x: &[f64], rows: usize) -> f64 {
        let a = rows_of(&self.jacobian, self.m, rows);
        (0..rows)
            .filter(|&c| !self.row_at_rounding(a, c, x))
            .fold(0.0, |s: f64, c| {
                let largest = a.largest(c);
                // A row of zeros has no scale.
                let off = self.residual[c].abs() / if largest > 0.0 { largest } else { 1.0 };
                if off.is_nan() || s.is_nan() {
                    f64::NAN
                } else {
                    s.max(off)
                }
            })
    }

    fn row_at_rounding(&self, a: Rows<'_>, c: usize, x: &[f64]) -> bool {
        let size = a.magnitude(c, x) + NEIGHBOUR * self.size * a.largest(c);
        self.residual[c].abs() <= ROUNDING * f64::EPSILON * size
    }

    fn at_rounding(&self, x: &[f64], rows: usize) -> bool {
        let a = rows_of(&self.jacobian, self.m, rows);
        (0..rows).all(|c| self.row_at_rounding(a, c, x))
    }

    /// The size that [`STALLED`] refers to. All coordinates count: a redundant row is left out of the solve and inherits what rounding
    /// leaves of the others, however small its own coordinates are.
    fn terms(&self, c: usize, rows: usize, x: &[f64]) -> f64 {
        let a = rows_of(&self.jacobian, self.m, rows);
        let sizes = a.row(c).zip(x).filter(|(a, _)| *a != 0.0);
        let size = a.largest(c) * sizes.fold(self.size, |s: f64, (_, x)| s.max(x.abs()));
        size.max(self.rounding[c])
    }

    fn acceptable(&self, x: &[f64], rows: usize) -> bool {
        (0..rows).all(|c| self.residual[c].abs() <= STALLED * f64::EPSILON * self.terms(c, rows, x))
    }

    fn largest(&self, rows: usize) -> f64 {
        self.residual[..rows]
            .iter()
            .fold(0.0, |s, r| s.max(r.abs()))
    }

    fn finite(&self, rows: usize) -> bool {
        self.residual[..rows].iter().all(|r| r.is_finite())
    }

    fn non_finite<M: Mechanism>(
        &self,
        mech: &Prepared<M>,
        t: f64,
        x: &[f64],
        other: &[f64],
        level: Level,
        rows: usize,
    ) -> Error {
        let (q, v) = if level == Level::Position {
            (x, other)
        } else {
            (other, x)
        };
        diagnose::non_finite_input(mech, t, q, v)
            .unwrap_or_else(|| diagnose::non_finite_residual(M::SPEC, &self.residual[..rows]))
    }

    fn off_constraint<M: Mechanism>(&self, x: &[f64], rows: usize, level: Level) -> Error {
        // Rows at rounding level are met.
        let mut residual = self.residual[..rows].to_vec();
        for (c, r) in residual.iter_mut().enumerate() {
            if r.abs() <= STALLED * f64::EPSILON * self.terms(c, rows, x) {
                *r = 0.0;
            }
        }
        let scale: Vec<f64> = self
            .dense
            .row_scale
            .iter()
            .map(|&s| if s > 0.0 { s } else { 1.0 })
            .collect();
        Error::OffConstraint {
            level: match level {
                Level::Position => "position",
                Level::Velocity => "velocity",
            },
            constraints: diagnose::offending(M::SPEC, &residual, &scale),
        }
    }
}

fn rows_of(jacobian: &[f64], m: usize, rows: usize) -> Rows<'_> {
    Rows {
        jacobian,
        stride: m,
        rows,
    }
}

#[cfg(test)]
mod tests;
