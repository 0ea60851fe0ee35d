//! Several mechanisms of one type at once, each in a lane of a wide number.
//!
//! Emitted code is one straight line for any [`Scalar`]; with a scalar of eight lanes it evaluates eight mechanisms, each with
//! parameters, time and state of its own. No lane sees another one: what comes out of a lane does not depend on what is in the others.
//!
//! - [`Lanes`]: numbers with lanes; `f64` has one, `wide::f64x4` and `wide::f64x8` (feature `ensemble`) have four and eight.
//! - [`LaneSolver`]: q̈ in lanes; where the emitted elimination is not safe in a lane, that lane is solved again, alone.
//!
//! Without a target that has wide registers (`-C target-cpu=native`, or `x86-64-v3`) lanes are pairs of SSE2.

#[cfg(feature = "ensemble")]
mod numbers;
mod solver;

use crate::scalar::Scalar;

pub use solver::LaneSolver;

/// A number made of lanes, on which arithmetic works lane by lane.
pub trait Lanes: Scalar {
    /// Number of lanes.
    const WIDTH: usize;
    /// The number with `f(k)` in lane k.
    fn from_lanes(f: impl FnMut(usize) -> f64) -> Self;
    /// What is in lane `lane`, below [`Lanes::WIDTH`].
    fn lane(self, lane: usize) -> f64;
    /// Puts `x` into lane `lane`, below [`Lanes::WIDTH`].
    fn set_lane(&mut self, lane: usize, x: f64);
}

impl Lanes for f64 {
    const WIDTH: usize = 1;
    #[inline]
    fn from_lanes(mut f: impl FnMut(usize) -> f64) -> Self {
        f(0)
    }
    #[inline]
    fn lane(self, _lane: usize) -> f64 {
        self
    }
    #[inline]
    fn set_lane(&mut self, _lane: usize, x: f64) {
        *self = x;
    }
}
