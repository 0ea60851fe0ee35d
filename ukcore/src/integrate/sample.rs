//! A state at a time.

use crate::assemble::State;
use crate::error::Error;

/// A state of a motion: one row of a [`Trajectory`](crate::Trajectory), or what a run has reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<'a> {
    /// The time t.
    pub t: f64,
    /// The coordinates q, in the order of [`Spec::coords`](crate::spec::Spec::coords).
    pub q: &'a [f64],
    /// The velocities q̇, in the same order.
    pub v: &'a [f64],
    /// Integrals since the start of the run, in the order of [`Prepared::integrals`](crate::Prepared::integrals); none of a state that
    /// belongs to no run.
    pub integrals: &'a [f64],
}

impl<'a> Sample<'a> {
    /// The state y = [q; q̇] at time `t`.
    #[inline]
    pub(crate) fn of(t: f64, y: &'a [f64]) -> Self {
        let (q, v) = y.split_at(y.len() / 2);
        let integrals = &[];
        Sample { t, q, v, integrals }
    }

    /// An owned copy, for example to start another run from.
    #[must_use]
    pub fn to_state(self) -> State {
        State {
            t: self.t,
            q: self.q.to_vec(),
            v: self.v.to_vec(),
        }
    }

    /// `error` with this state as the place where it arose.
    pub(crate) fn locate(self, error: Error) -> Error {
        self.to_state().locate(error)
    }
}

impl<'a> From<&'a State> for Sample<'a> {
    fn from(state: &'a State) -> Self {
        let State { t, q, v } = state;
        let integrals = &[];
        Sample {
            t: *t,
            q,
            v,
            integrals,
        }
    }
}
