//! The manifold of states that satisfy the constraints, and the ways onto it.
//!
//! The smallest change of q (in the metric M) with φ(q, t) = 0 solves, to first order, minimise ½ Δᵀ M Δ subject to A Δ = −φ: the
//! constrained solve of eqs. 13 and 19 with Q = 0 and b = −φ. Newton's method repeats it, by the emitted elimination where there is one
//! and its certificate holds, else by the rank-revealing solve; near the manifold the factors of the first step serve for the following
//! ones too, since each step then still divides the residual by 1/δ for a state at distance δ.
//!
//! What counts as zero is decided in one place, for whoever asks: projection, in lanes or alone, RATTLE, assembly.

use std::fmt;
use std::str::FromStr;

use crate::error::Error;
use crate::mechanism::Prepared;
use crate::naming;
use crate::noise::Noise;
use crate::numbers::full;
use crate::scan::{all_finite, largest_difference};
use crate::solver::{Baumgarte, doubtful};

mod acceptance;
mod level;
mod newton;
mod parts;
mod rank_revealing;
mod search;

pub(crate) use acceptance::STALLED;
pub(crate) use level::{At, Level};
pub(crate) use newton::Newton;
pub(crate) use parts::{Part, parts};

use newton::Steps;
use rank_revealing::Factors;

/// How drift off the constraints is kept down during integration.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Stabilisation {
    /// Projection of q and q̇ after each accepted step.
    #[default]
    Projection,
    /// The residuals of the constraints are fed back in b; in a run backward in time with −α in place of α, so that they decay along it.
    Baumgarte(Baumgarte),
    /// Nothing is done against drift: the motion follows A q̈ = b alone.
    None,
}

/// Writes the stabilisation as [`FromStr`] reads it: `projection`, `baumgarte=20,20`, `none`.
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
        Err(Error::invalid(
            "stabilise",
            format!("is `{text}`; {reason}"),
        ))
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

/// Projects states onto the constraints, in buffers allocated once.
#[derive(Debug, Clone)]
pub struct Projector {
    /// The mechanism, with the branches of switches that are held.
    pub(crate) mechanism: Prepared,
    manifold: Manifold,
    /// Whether units are compared: those of the first state are kept.
    measured: bool,
}

impl Projector {
    /// A projector for `mechanism`: a reference to one that is declared, or a [`Prepared`] one.
    #[must_use]
    pub fn new(mechanism: impl Into<Prepared>) -> Self {
        let mechanism = mechanism.into();
        Projector {
            manifold: Manifold::new(&mechanism),
            measured: false,
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
        naming::check_lengths(&self.mechanism, q, v)?;
        self.measure(t, q, v);
        let at = At::new(&self.mechanism, Level::Position, t, v);
        self.manifold.project(&at, q)
    }

    /// Whether coordinates meet all constraints but for what rounding leaves of their residuals.
    pub(crate) fn is_met(&mut self, t: f64, q: &[f64], v: &[f64]) -> bool {
        let at = At::new(&self.mechanism, Level::Position, t, v);
        self.manifold.is_met(&at, q)
    }

    /// Takes what makes coordinates of different units comparable, at the first state.
    fn measure(&mut self, t: f64, q: &[f64], v: &[f64]) {
        if !std::mem::replace(&mut self.measured, true) {
            self.manifold.measure(&self.mechanism, t, q, v);
        }
    }

    /// Minimal change of q̇ in the mass metric with φ̇ = 0 and ψ = 0 (all constraints) to rounding level; nonholonomic ones may be
    /// nonlinear in q̇. Allocates nothing unless it fails; then `v` is left as it was.
    ///
    /// # Errors
    /// What [`Projector::position`] reports.
    pub fn velocity(&mut self, t: f64, q: &[f64], v: &mut [f64]) -> Result<Correction, Error> {
        naming::check_lengths(&self.mechanism, q, v)?;
        self.measure(t, q, v);
        let at = At::new(&self.mechanism, Level::Velocity, t, q);
        self.manifold.project(&at, v)
    }

    /// Moves a state near a singular position onto the constraints but for those that all but vanish or depend on the others there, which
    /// do not tell in which branch it is, and make more of an error of velocities than these have; its positions onto all where that is
    /// near beside what lies between branches.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::IndefiniteMass`].
    pub(crate) fn settle(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<(), Error> {
        let mut near = q.to_vec();
        let at = At::new(&self.mechanism, Level::Position, t, v);
        // Where A of all rows cannot be solved with, they tell nothing.
        match self.manifold.settle_on_all(&at, &mut near) {
            Ok(true) => q.copy_from_slice(&near),
            _ => self.manifold.settle(&at, q)?,
        }
        let at = At::new(&self.mechanism, Level::Velocity, t, q);
        self.manifold.settle(&at, v)
    }

    /// Moves a state y = [q; q̇] between the ends of a step, which is as exact as an interpolant, onto the constraints. Where some all but
    /// depend on the others, so small an error may have it in another branch of the motion, with another velocity: where velocities before
    /// the projection and behind it differ by `too_much` there, or no projection is found, the state is interpolated `again`, and settles.
    ///
    /// # Errors
    /// What [`Projector::position`] reports.
    pub(crate) fn interpolated(
        &mut self,
        t: f64,
        y: &mut [f64],
        too_much: impl FnOnce(&[f64], &[f64]) -> bool,
        again: impl FnOnce(&mut [f64]),
    ) -> Result<[Correction; 2], Error> {
        let n = y.len() / 2;
        let (q, v) = y.split_at_mut(n);
        let moved = self.position(t, q, v);
        let moved = moved.and_then(|position| Ok([position, self.velocity(t, q, v)?]));
        let fits = match &moved {
            Ok([_, velocity]) => velocity.norm == 0.0 || !too_much(&self.manifold.start, v),
            Err(error) => !matches!(error, Error::OffConstraint { .. }),
        };
        let at = At::new(&self.mechanism, Level::Velocity, t, q);
        if fits || self.manifold.is_clear(&at, v)? {
            return moved;
        }
        again(y);
        let (q, v) = y.split_at_mut(n);
        self.settle(t, q, v)?;
        let at = At::new(&self.mechanism, Level::Position, t, v);
        moved.or_else(|error| match self.manifold.is_met(&at, q) {
            true => Ok(Default::default()),
            false => Err(error),
        })
    }

    /// Moves q, the first of `moved`, onto φ(q, t) = 0 along M⁻¹A(`base`)ᵀ, for mechanisms with holonomic constraints alone; the other is
    /// the sum of all moves, which is more exact than the difference of coordinates.
    ///
    /// # Errors
    /// [`Error::OffConstraint`] with the constraints that cannot be met that way; [`Error::NonFinite`], [`Error::IndefiniteMass`].
    pub(crate) fn position_along(
        &mut self,
        t: f64,
        base: &[f64],
        moved: [&mut [f64]; 2],
    ) -> Result<Correction, Error> {
        let at = At::new(&self.mechanism, Level::Position, t, base);
        self.manifold.reach(&at, moved)
    }

    /// What a projection would change a state by if the constraints were met as nearly as rounding of time, coordinates and velocities
    /// lets it: far from t = 0, far from the origin, or driven fast, that may be farther off than an error that is asked for. Leaves
    /// `change` alone where that is unknown, and where without time in the equations it is more than rounding that rows beyond doubt
    /// amplify.
    pub(crate) fn excess(&mut self, t: f64, q: &[f64], v: &[f64], change: &mut [f64]) {
        let levels = [(Level::Position, q, v), (Level::Velocity, v, q)];
        for ((level, x, other), change) in levels.into_iter().zip(change.chunks_mut(q.len())) {
            let at = At::new(&self.mechanism, level, t, other);
            self.manifold.excess(&at, x, change);
        }
    }

    /// The largest length in a holonomic constraint at q, in the unit of the coordinates: what rounding makes of φ, over ε max|A_cj|. 0
    /// without such constraints. It is that at t = 0, as what rounding of a late time makes of a drive is no length.
    pub(crate) fn length(&mut self, q: &[f64], v: &[f64]) -> f64 {
        let at = At::new(&self.mechanism, Level::Position, 0.0, v);
        let newton = &mut self.manifold.newton;
        newton.weigh(&at, q);
        newton.rounding(&at, q, &mut self.manifold.noise, None);
        newton.acceptance.length(0..at.rows())
    }

    /// The mechanism, with the parameters whose constraints count.
    #[must_use]
    pub fn mechanism(&self) -> &Prepared {
        &self.mechanism
    }
}

/// A change of more than this many ε of the length in the constraints is none by rounding of rows beyond doubt: those are met to 64 ε of
/// it.
const AMPLIFIED: f64 = 256.0 * f64::EPSILON;

/// What all ways onto the constraints share, for one mechanism.
#[derive(Debug, Clone)]
pub(crate) struct Manifold {
    newton: Newton<f64>,
    noise: Noise,
    factors: Factors,
    start: Vec<f64>,
    /// Velocities of zero.
    rest: Vec<f64>,
}

impl Manifold {
    pub(crate) fn new(mechanism: &Prepared) -> Self {
        let (mut newton, factors) = (Newton::new(mechanism.spec()), Factors::new(mechanism));
        if !factors.dense.measure.is_one() {
            newton.acceptance.units = vec![1.0; mechanism.spec().n()];
        }
        Manifold {
            newton,
            noise: Noise::new(mechanism),
            factors,
            start: vec![0.0; mechanism.spec().n()],
            rest: vec![0.0; mechanism.spec().n()],
        }
    }

    /// Takes what makes coordinates of different units comparable, from a state.
    fn measure(&mut self, mech: &Prepared, t: f64, q: &[f64], v: &[f64]) {
        let units = &mut self.newton.acceptance.units;
        if !units.is_empty() {
            let scale = self
                .factors
                .measure(mech, t, [q, v], &mut self.newton.jacobian);
            units.copy_from_slice(scale);
        }
    }

    /// The minimal change of `x`. Where there is none, `x` is left as it was.
    pub(crate) fn project(&mut self, at: &At<'_, f64>, x: &mut [f64]) -> Result<Correction, Error> {
        if at.rows() == 0 {
            return Ok(Correction::default());
        }
        self.start.copy_from_slice(x);
        if at.straight_line() && self.newton.acceptance.ease.is_empty() {
            let (good, stalled, steps) = self.newton.eliminate(at, x, 1.0);
            let accepted = good > 0.5 || stalled > 0.5 && self.accept(at, x, false);
            if good > 0.5 || accepted && !self.leaves_out(at, x) {
                return Ok(self.correction(x, steps));
            }
            x.copy_from_slice(&self.start);
        }
        let steps = self.reveal(at, x);
        let steps = steps.inspect_err(|_| x.copy_from_slice(&self.start))?;
        Ok(self.correction(x, steps))
    }

    /// Whether the elimination leaves out rows at `x` of which more than rounding is left there: they do not follow from the others, and
    /// what its steps leave of their residuals steps with all rows take off. It tells so of accelerations alone, and also where velocities
    /// do not meet the constraints yet, or forces have no value at rest: that one of both tells nothing of the kind is enough.
    fn leaves_out(&mut self, at: &At<'_, f64>, x: &[f64]) -> bool {
        if at.mech.spec().structure.solve.redundant.is_empty() {
            return false;
        }
        let out = &mut self.newton.step;
        let mut doubts = |q: &[f64], v: &[f64]| doubtful(at.mech.acceleration(at.t, q, v, out));
        let rest = &self.rest;
        match at.level {
            Level::Position => doubts(x, rest) && doubts(x, at.other),
            Level::Velocity => doubts(at.other, x),
        }
    }

    /// What `count` steps to `x` have done.
    fn correction(&self, x: &[f64], count: f64) -> Correction {
        let norm = if count > 0.0 {
            largest_difference(x, &self.start)
        } else {
            0.0
        };
        Correction {
            norm,
            iterations: count as usize,
            residual: self.newton.off,
        }
    }

    /// Moves `q` in directions that are those of `at.other`; see [`Projector::position_along`].
    fn reach(
        &mut self,
        at: &At<'_, f64>,
        [q, shift]: [&mut [f64]; 2],
    ) -> Result<Correction, Error> {
        shift.fill(0.0);
        if at.rows() == 0 {
            return Ok(Correction::default());
        }
        self.start.copy_from_slice(q);
        self.factors.cautious = true;
        loop {
            let (base, factors) = (at.other, &mut self.factors);
            let (mut begun, mut factored, mut failure) = (false, false, None);
            let newton = &mut self.newton;
            let (good, _, count) = newton.direct(at, q, 1.0, Steps::Elsewhere, |newton, _| {
                if begun {
                    let sums = shift.iter_mut().zip(&newton.step);
                    sums.for_each(|(sum, d)| *sum += d);
                }
                begun = true;
                failure = factors.step(at, base, newton, &mut factored).err();
                f64::from(u8::from(failure.is_none()))
            });
            if let Some(error) = failure {
                return Err(error);
            }
            // No step tells of rows that are left out.
            let left_out = factored && self.factors.cautious && self.factors.doubts();
            if good > 0.5 && !left_out || self.accept(at, q, factored) {
                return Ok(self.correction(q, count));
            }
            if !left_out {
                return Err(self.error(at, q));
            }
            // They are not implied by the others.
            self.factors.cautious = false;
            q.copy_from_slice(&self.start);
            shift.fill(0.0);
        }
    }

    /// See [`Projector::excess`], of one level.
    fn excess(&mut self, at: &At<'_, f64>, x: &[f64], change: &mut [f64]) {
        let still = at.mech.spec().structure.scleronomic;
        // Towards a singular position rounding may lead into another branch.
        if at.rows() == 0 || still && !self.each_is_clear(at, x).is_ok_and(|clear| clear) {
            return;
        }
        let newton = &mut self.newton;
        newton.evaluate(at, x);
        newton.weigh(at, x);
        if still {
            newton.measure(at, x, &mut self.noise, None);
        } else {
            newton.rounding(at, x, &mut self.noise, None);
        }
        let acceptance = &newton.acceptance;
        let amplified = acceptance.largest(change) > AMPLIFIED * acceptance.length(0..at.rows());
        if still && amplified {
            return;
        }
        let residual = &mut newton.residual[..at.rows()];
        newton.acceptance.clear(residual);
        // Whatever rows in doubt have made of it.
        if !amplified && residual.iter().all(|r| *r == 0.0) {
            change.fill(0.0);
            return;
        }
        let mut factored = false;
        self.factors.cautious = true;
        if (self.factors.step(at, x, newton, &mut factored)).is_err() {
            return;
        }
        // The projection may have taken in rows in doubt, which are left out here.
        if !(factored && self.factors.doubts()) {
            change.copy_from_slice(&newton.step);
        }
    }

    /// Whether residuals, known at `x`, will do where no step makes them less; for what is `factored`, constraints that imply each other
    /// included.
    fn accept(&mut self, at: &At<'_, f64>, x: &[f64], factored: bool) -> bool {
        self.newton.weigh(at, x);
        let dense = factored.then_some(&mut self.factors.dense);
        self.newton.measure(at, x, &mut self.noise, dense);
        self.newton.violated(at).next().is_none()
    }

    /// Why they will not.
    fn error(&self, at: &At<'_, f64>, x: &[f64]) -> Error {
        let residual = &self.newton.residual[..at.rows()];
        if !all_finite(residual) {
            return at.non_finite(x, residual);
        }
        let mut violations = vec![0.0; residual.len()];
        for c in self.newton.violated(at) {
            violations[c] = residual[c];
        }
        let scale = |c: usize| self.newton.acceptance.scale(c).recip();
        Error::OffConstraint {
            level: at.level.name(),
            constraints: naming::offending(at.mech.spec(), &violations, scale),
        }
    }

    /// Takes residuals, A and sizes at `x`, where coordinates that are zero are measured by `others`. Whether x is on the constraints.
    fn meets(&mut self, at: &At<'_, f64>, x: &[f64], others: &[f64]) -> bool {
        self.newton.acceptance.size = self.newton.acceptance.measured(others);
        self.newton.evaluate(at, x);
        self.accept(at, x, false)
    }

    /// Why `x` is not on the constraints.
    pub(crate) fn refusal(&mut self, at: &At<'_, f64>, x: &[f64]) -> Error {
        self.meets(at, x, x);
        self.error(at, x)
    }
}

#[cfg(test)]
mod tests;
