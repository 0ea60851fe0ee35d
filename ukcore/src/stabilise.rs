//! Keeping the state on the constraints.
//!
//! The smallest change of q (in the metric M) with φ(q, t) = 0 solves, to first order, minimise ½ Δᵀ M Δ subject to A Δ = −φ: the
//! constrained solve of eqs. 13 and 19 with Q = 0 and b = −φ. Newton's method repeats it, by the emitted elimination where there is one and its
//! certificate holds, else by the rank-revealing solve; near the manifold the factors of the
//! first step serve for the following ones too, since each step then still divides the residual by 1/δ for a state at distance δ.

use std::fmt;
use std::str::FromStr;

use crate::diagnose;
use crate::error::Error;
use crate::mechanism::{Branch, Constraints, Prepared};
use crate::numbers::full;
use crate::rounding::Rounded;
use crate::scan::largest;
use crate::solver::Baumgarte;
use crate::workspace::{Dense, Rows};

#[cfg(feature = "simulate")]
mod along;
mod rank_revealing;
mod straight_line;

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

/// As it is read by [`FromStr`]: `projection`, `baumgarte=20,20`, `none`.
impl fmt::Display for Stabilisation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stabilisation::Projection => f.write_str("projection"),
            Stabilisation::Baumgarte(Baumgarte { alpha, beta }) => {
                write!(f, "baumgarte={},{}", full(*alpha), full(*beta))
            }
            Stabilisation::None => f.write_str("none"),
        }
    }
}

/// Reads `projection`, `none`, `baumgarte` with the rates of [`Baumgarte::default`], or `baumgarte=ALPHA,BETA` with rates in 1/s.
impl FromStr for Stabilisation {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let rate = |text: &str| {
            let number = text.trim().parse().ok();
            number.filter(|x| (0.0..f64::INFINITY).contains(x))
        };
        let reason = match text.split_once('=') {
            None if text == "projection" => return Ok(Stabilisation::Projection),
            None if text == "none" => return Ok(Stabilisation::None),
            None if text == "baumgarte" => {
                return Ok(Stabilisation::Baumgarte(Baumgarte::default()));
            }
            Some(("baumgarte", rates)) => {
                let rates = rates.split_once(',');
                if let Some((Some(alpha), Some(beta))) = rates.map(|(a, b)| (rate(a), rate(b))) {
                    return Ok(Stabilisation::Baumgarte(Baumgarte { alpha, beta }));
                }
                "two rates in 1/s are needed, not negative: baumgarte=20,20"
            }
            _ => "it is `projection`, `baumgarte`, `baumgarte=ALPHA,BETA` or `none`",
        };
        Err(Error::InvalidSetting {
            what: "stabilise",
            reason: format!("is `{text}`; {reason}"),
        })
    }
}

/// What a projection did.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Correction {
    /// Size of the change: the largest |Δq_j| (or |Δq̇_j|) over all coordinates, in their own units.
    pub norm: f64,
    /// Newton steps; 0 if the state was consistent already, or one that changes it by rounding alone.
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
    mechanism: Prepared,
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
    /// Σ|A_cj| (|x_j| + `NEIGHBOUR` max|x|), and max|A_cj|.
    terms: Vec<f64>,
    largest: Vec<f64>,
    /// What rounding the evaluation of each constraint carries, in units of ε; 0 until it is needed.
    rounding: Vec<f64>,
    rounded: Prepared<Rounded, dyn Constraints<Rounded>>,
    given: Vec<Rounded>,
    fixed: Vec<Rounded>,
    rounded_residual: Vec<Rounded>,
    dense: Dense,
    /// Position up to which the factors in `dense` hold all rows of A, for the velocity projection that follows.
    factored_at: Option<f64>,
    factored_q: Vec<f64>,
    /// Whether rows below the ceiling are left out.
    cautious: bool,
}

impl Projector {
    /// A projector for `mechanism`: a reference to one that is declared, or a [`Prepared`] one.
    #[must_use]
    pub fn new(mechanism: impl Into<Prepared>) -> Self {
        Projector::of(mechanism.into())
    }

    fn of(mechanism: Prepared) -> Self {
        let spec = mechanism.spec();
        let (n, m) = (spec.n(), spec.m());
        Projector {
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
            terms: vec![0.0; m],
            largest: vec![0.0; m],
            rounding: vec![0.0; m],
            rounded: mechanism.rounded(),
            given: vec![Rounded::exact(0.0); n],
            fixed: vec![Rounded::exact(0.0); n],
            rounded_residual: vec![Rounded::exact(0.0); m],
            dense: Dense::new(n, m, spec.structure.mass_diagonal),
            factored_at: None,
            factored_q: vec![0.0; n],
            cautious: true,
            mechanism,
        }
    }

    /// Minimal change of q in the mass metric with φ(q, t) = 0 to rounding level. Massless coordinates follow the constraints.
    /// Allocates nothing unless it fails; then `q` is left as it was.
    ///
    /// # Errors
    /// [`Error::OffConstraint`] with the constraints that cannot be met near q; [`Error::NonFinite`], [`Error::IndefiniteMass`],
    /// [`Error::WrongLength`].
    pub fn position(&mut self, t: f64, q: &mut [f64], v: &[f64]) -> Result<Correction, Error> {
        self.check_lengths(q, v)?;
        self.factored_at = None;
        self.project(t, q, v, Level::Position)
    }

    /// Minimal change of q̇ in the mass metric with φ̇ = 0 and ψ = 0 (all constraints) to rounding level; nonholonomic ones may be
    /// nonlinear in q̇. Allocates nothing unless it fails; then `v` is left as it was.
    ///
    /// # Errors
    /// As [`Projector::position`].
    pub fn velocity(&mut self, t: f64, q: &[f64], v: &mut [f64]) -> Result<Correction, Error> {
        self.check_lengths(q, v)?;
        let result = self.project(t, v, q, Level::Velocity);
        self.factored_at = None;
        result
    }

    /// The mechanism, with the parameters whose constraints count.
    #[must_use]
    pub fn mechanism(&self) -> &Prepared {
        &self.mechanism
    }

    /// Holds switch `switch` in `branch`, or follows it again.
    #[cfg(feature = "simulate")]
    pub(crate) fn hold(&mut self, switch: usize, branch: Branch) {
        self.mechanism.hold(switch, branch);
        self.rounded.hold(switch, branch);
    }

    fn check_lengths(&self, q: &[f64], v: &[f64]) -> Result<(), Error> {
        diagnose::check_length("q", q.len(), self.n)?;
        diagnose::check_length("v", v.len(), self.n)
    }

    /// Projects `x`: q with `other` = q̇, or q̇ with `other` = q. Where that fails, `x` is left as it was.
    fn project(
        &mut self,
        t: f64,
        x: &mut [f64],
        other: &[f64],
        level: Level,
    ) -> Result<Correction, Error> {
        let rows = self.rows(level);
        if rows == 0 {
            return Ok(Correction::default());
        }
        self.start.copy_from_slice(x);
        self.size = largest(x);
        // The elimination is that of all rows.
        if self.mechanism.spec().structure.straight_line && rows == self.m {
            if let Some(correction) = self.straight_line(t, x, other, level) {
                return Ok(correction);
            }
            x.copy_from_slice(&self.start);
        }
        let result = self.rank_revealing(t, x, other, level);
        if result.is_err() {
            x.copy_from_slice(&self.start);
        }
        result
    }

    /// How many constraints there are at this level.
    fn rows(&self, level: Level) -> usize {
        match level {
            Level::Position => self.holonomic,
            Level::Velocity => self.m,
        }
    }

    /// φ, or φ̇ and ψ, into `residual`.
    fn evaluate(&mut self, t: f64, x: &[f64], other: &[f64], level: Level) {
        match level {
            Level::Position => self
                .mechanism
                .residual(t, x, &mut self.residual[..self.holonomic]),
            Level::Velocity => self
                .mechanism
                .residual_rate(t, other, x, &mut self.residual),
        }
    }

    /// What rounding the residuals at `x` carry. Where coordinates are small beside the lengths in a constraint (measured from the
    /// state at rest, say), this is far more than their own rounding makes of it.
    fn measure_rounding(&mut self, t: f64, x: &[f64], other: &[f64], level: Level) {
        let (given, fixed, residual) =
            (&mut self.given, &mut self.fixed, &mut self.rounded_residual);
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
                self.rounded
                    .residual(t, given, &mut residual[..self.holonomic]);
                self.holonomic
            }
            Level::Velocity => {
                self.rounded.residual_rate(t, fixed, given, residual);
                self.m
            }
        };
        for (size, r) in self.rounding.iter_mut().zip(&residual[..rows]) {
            *size = r.bound();
        }
    }

    /// The largest length in a holonomic constraint at q, in the unit of the coordinates: what rounding makes of φ, over ε max|A_cj|. 0 without such constraints.
    #[cfg(feature = "simulate")]
    pub(crate) fn length(&mut self, t: f64, q: &[f64], v: &[f64]) -> f64 {
        self.size = 0.0;
        self.jacobian(t, q, v, Level::Position);
        self.weigh(q);
        self.measure_rounding(t, q, v, Level::Position);
        let sizes = self.rounding[..self.holonomic].iter().zip(&self.largest);
        let lengths = sizes.filter(|(_, entry)| **entry > 0.0);
        lengths.fold(0.0, |s: f64, (r, entry)| s.max(r / entry))
    }

    fn jacobian(&mut self, t: f64, x: &[f64], other: &[f64], level: Level) {
        match level {
            Level::Position => self.mechanism.jacobian(t, x, other, &mut self.jacobian),
            Level::Velocity => self.mechanism.jacobian(t, other, x, &mut self.jacobian),
        }
    }

    /// Sizes of the rows of A at `x`, for [`Projector::at_rounding`].
    fn weigh(&mut self, x: &[f64]) {
        self.terms.fill(0.0);
        self.largest.fill(0.0);
        let least = NEIGHBOUR * self.size;
        for &(c, j) in self.mechanism.spec().structure.jacobian_pattern {
            let entry = self.jacobian[j * self.m + c].abs();
            self.terms[c] += entry * (x[j].abs() + least);
            self.largest[c] = self.largest[c].max(entry);
        }
    }

    fn row_at_rounding(&self, c: usize) -> bool {
        self.residual[c].abs() <= ROUNDING * f64::EPSILON * self.terms[c]
    }

    fn at_rounding(&self, rows: usize) -> bool {
        (0..rows).all(|c| self.row_at_rounding(c))
    }

    /// The size that [`STALLED`] refers to. All coordinates count: a redundant row is left out of the solve and inherits what rounding
    /// leaves of the others, however small its own coordinates are.
    fn size_of_row(&self, c: usize, x: &[f64]) -> f64 {
        let row = rows_of(&self.jacobian, self.m, self.m).row(c);
        let sizes = row.zip(x).filter(|(a, _)| *a != 0.0);
        let size = self.largest[c] * sizes.fold(self.size, |s: f64, (_, x)| s.max(x.abs()));
        size.max(self.rounding[c])
    }

    fn row_acceptable(&self, c: usize, x: &[f64]) -> bool {
        self.residual[c].abs() <= STALLED * f64::EPSILON * self.size_of_row(c, x)
    }

    fn acceptable(&self, x: &[f64], rows: usize) -> bool {
        (0..rows).all(|c| self.row_acceptable(c, x))
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
