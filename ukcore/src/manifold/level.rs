//! The constraints as equations for q, or for q̇.

use crate::error::Error;
use crate::mechanism::Prepared;
use crate::naming;
use crate::scalar::Scalar;

/// Position (φ) or velocity (φ̇ and ψ).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    Position,
    Velocity,
}

impl Level {
    /// The name of the level in messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Level::Position => "position",
            Level::Velocity => "velocity",
        }
    }

    /// q and q̇ of `x` and `other`.
    pub(super) fn state<T>(self, x: T, other: T) -> (T, T) {
        match self {
            Level::Position => (x, other),
            Level::Velocity => (other, x),
        }
    }
}

/// The equations of one level at one time for x: q where `other` is q̇, or q̇ where `other` is q.
#[derive(Clone, Copy)]
pub(crate) struct At<'a, S: Scalar> {
    pub(crate) mech: &'a Prepared<S>,
    pub(crate) level: Level,
    pub(crate) t: S,
    pub(crate) other: &'a [S],
}

impl<'a, S: Scalar> At<'a, S> {
    pub(crate) fn new(mech: &'a Prepared<S>, level: Level, t: S, other: &'a [S]) -> Self {
        At {
            mech,
            level,
            t,
            other,
        }
    }

    /// How many constraints there are at this level.
    pub(crate) fn rows(&self) -> usize {
        match self.level {
            Level::Position => self.mech.spec().holonomic,
            Level::Velocity => self.mech.spec().m(),
        }
    }

    /// Whether the equations are linear in x.
    pub(crate) fn linear(&self) -> bool {
        let spec = self.mech.spec();
        self.level == Level::Velocity && spec.holonomic == spec.m()
    }

    /// Whether an elimination for these rows was emitted: there is one of all rows together.
    pub(super) fn straight_line(&self) -> bool {
        let spec = self.mech.spec();
        spec.structure.straight_line && self.rows() == spec.m()
    }

    /// φ, or φ̇ and ψ, into the first of `out`.
    pub(super) fn residual(&self, x: &[S], out: &mut [S]) {
        match self.level {
            Level::Position => self.mech.residual(self.t, x, &mut out[..self.rows()]),
            Level::Velocity => self.mech.residual_rate(self.t, self.other, x, out),
        }
    }

    /// A, all rows.
    pub(super) fn jacobian(&self, x: &[S], out: &mut [S]) {
        let (q, v) = self.level.state(x, self.other);
        self.mech.jacobian(self.t, q, v, out);
    }

    /// The smallest Δ with A Δ = −`residual`, and its certificate.
    pub(super) fn correction(&self, x: &[S], residual: &[S], out: &mut [S]) -> S {
        let (q, v) = self.level.state(x, self.other);
        self.mech.correction(self.t, q, v, residual, out)
    }
}

impl At<'_, f64> {
    /// M.
    pub(super) fn mass_matrix(&self, x: &[f64], out: &mut [f64]) {
        let (q, _) = self.level.state(x, self.other);
        self.mech.mass_matrix(self.t, q, out);
    }

    /// Why residuals at `x` are not finite.
    pub(super) fn non_finite(&self, x: &[f64], residual: &[f64]) -> Error {
        let (q, v) = self.level.state(x, self.other);
        let what = naming::non_finite_rows(self.mech.spec(), residual);
        naming::bad_input(self.mech, self.t, q, v).unwrap_or(Error::NonFinite { what })
    }
}
