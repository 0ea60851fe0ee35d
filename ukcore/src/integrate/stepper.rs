//! One explicit Runge-Kutta step, for any scalar.
//!
//! A scalar may carry many lanes, each with a mechanism, a time and a step size of its own; so times and sizes are scalars too, and nothing
//! here branches on a value. What is accepted, and how large the next step is, is decided outside.

use super::dense::cubic;
use super::sums::{Tolerance, keeping, sum_of_squares, weights};
use super::tableau::{self, Sums, Tableau};
use crate::scalar::Scalar;
use std::ops::Range;

/// Buffers for steps with n components, and what the last attempted one left in them.
///
/// A right-hand side f(t, y, rate) writes y' into `rate`. Its error ends the call at once.
pub(crate) struct Stepper<S> {
    tableau: &'static Tableau,
    sums: Sums<S>,
    n: usize,
    /// Rates at the stages, row by row: those of the step, the closing one, those for the interpolant.
    rates: Vec<S>,
    /// Where a stage is evaluated.
    argument: Vec<S>,
    /// State at the end of the step.
    new: Vec<S>,
    /// What rounding took from the state at the start of the step, to be added to the change that the step makes.
    lost: Vec<S>,
    /// What rounding took from the state at the end of the attempted step.
    losing: Vec<S>,
    /// Estimates of the error, row by row.
    errors: Vec<S>,
    /// Rows of coefficients of the interpolant.
    dense: Vec<S>,
}

impl<S: Scalar> Stepper<S> {
    /// Steps by [DOP853](tableau::DOP853) for states of length n.
    pub(crate) fn dop853(n: usize) -> Self {
        Stepper::new(&tableau::DOP853, tableau::dop853(), n)
    }

    /// Steps by [DOPRI5](tableau::DOPRI5) for states of length n.
    pub(crate) fn dopri5(n: usize) -> Self {
        Stepper::new(&tableau::DOPRI5, tableau::dopri5(), n)
    }

    fn new(tableau: &'static Tableau, sums: Sums<S>, n: usize) -> Self {
        let zeros = |rows: usize| vec![S::from_f64(0.0); rows * n];
        Stepper {
            tableau,
            sums,
            n,
            rates: zeros(1 + tableau.stages.len()),
            argument: zeros(1),
            new: zeros(1),
            lost: zeros(1),
            losing: zeros(1),
            errors: zeros(tableau.errors.len()),
            dense: zeros(4 + tableau.dense.len()),
        }
    }

    /// Evaluates f at the start of the first step. Later steps begin with what [`close`](Stepper::close) has evaluated.
    pub(crate) fn begin<E>(
        &mut self,
        mut f: impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
        y: &[S],
    ) -> Result<(), E> {
        f(t, y, &mut self.rates[..self.n])
    }

    /// Forgets what rounding took from earlier states, where `choose(new, old)` is the new value: another motion begins there.
    #[cfg(feature = "ensemble")]
    pub(crate) fn forget(&mut self, choose: impl Fn(S, S) -> S) {
        for lost in &mut self.lost {
            *lost = choose(S::from_f64(0.0), *lost);
        }
    }

    /// The method.
    pub(crate) fn tableau(&self) -> &'static Tableau {
        self.tableau
    }

    /// f at the start of the step.
    pub(crate) fn rate(&self) -> &[S] {
        &self.rates[..self.n]
    }

    /// The stages of a step of size `h` from (t, y), and the [state](Stepper::state) at its end.
    pub(crate) fn attempt<E>(
        &mut self,
        mut f: impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
        h: S,
        y: &[S],
    ) -> Result<(), E> {
        let closing = self.tableau.closing;
        self.evaluate(&mut f, t, h, y, 1..closing)?;
        // The stage's sum on top of what was lost so far, then both onto y: the larger of two terms first, so that what is lost is exact.
        (self.sums.argument)(closing, &mut self.new, &self.lost, h, &self.rates);
        for ((new, y), lost) in self.new.iter_mut().zip(y).zip(&mut self.losing) {
            (*new, *lost) = keeping(*y, *new);
        }
        Ok(())
    }

    /// Evaluates `stages`.
    fn evaluate<E>(
        &mut self,
        f: &mut impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
        h: S,
        y: &[S],
        stages: Range<usize>,
    ) -> Result<(), E> {
        for stage in stages {
            (self.sums.argument)(stage, &mut self.argument, y, h, &self.rates);
            let time = t + S::from_f64(self.tableau.stages[stage - 1].c) * h;
            let rate = &mut self.rates[stage * self.n..][..self.n];
            f(time, &self.argument, rate)?;
        }
        Ok(())
    }

    /// State at the end of the attempted step.
    pub(crate) fn state(&self) -> &[S] {
        &self.new
    }

    /// State at the end of the attempted step, to be projected before [`close`](Stepper::close).
    pub(crate) fn state_mut(&mut self) -> &mut [S] {
        &mut self.new
    }

    /// Evaluates f at the end of the attempted step, which is at `t`.
    pub(crate) fn close<E>(
        &mut self,
        mut f: impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
    ) -> Result<(), E> {
        let closing = self.tableau.closing * self.n;
        f(t, &self.new, &mut self.rates[closing..][..self.n])
    }

    /// Estimated error of the attempted step from y in the [error norm](super): at most 1 if it has the accuracy asked for.
    ///
    /// With two estimates e₁, e₂: |e₁|² / √(|e₁|² + 0.01 |e₂|²), eq. (10.17) of the book, which falls as h⁸.
    pub(crate) fn error(&mut self, h: S, y: &[S], tolerance: Tolerance<S>) -> S {
        (self.sums.errors)(&mut self.errors, h, &self.rates);
        // No stage is evaluated any more.
        weights(&mut self.argument, y, &self.new, tolerance);
        let n = self.n;
        let zero = S::from_f64(0.0);
        let best = sum_of_squares(&self.errors[..n], &self.argument);
        let other = sum_of_squares(&self.errors[n..], &self.argument);
        let both = best + S::from_f64(0.01) * other;
        let divisor = S::select_le(both, zero, S::from_f64(1.0), both);
        best / (S::from_f64(n.max(1) as f64) * divisor).sqrt()
    }

    /// Makes the [coefficients](Stepper::dense) of the interpolant of the closed step; evaluates stages for it if the method needs them.
    pub(crate) fn interpolate<E>(
        &mut self,
        mut f: impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
        h: S,
        y: &[S],
    ) -> Result<(), E> {
        let n = self.n;
        let closing = self.tableau.closing;
        self.evaluate(&mut f, t, h, y, closing + 1..self.tableau.stages.len() + 1)?;
        let (rows, more) = self.dense.split_at_mut(4 * n);
        (self.sums.dense)(more, h, &self.rates);
        let (start, end) = (&self.rates[..n], &self.rates[closing * n..][..n]);
        cubic(rows, h, y, &self.new, start, end);
        Ok(())
    }

    /// Coefficients of the interpolant, rows as [`Interpolant`](super::dense::Interpolant) wants them.
    pub(crate) fn dense(&self) -> &[S] {
        &self.dense
    }

    /// Moves on to the end of the closed step. `choose(new, old)` is the new value in the lanes whose step was accepted, the old one in the
    /// others.
    pub(crate) fn advance(&mut self, y: &mut [S], choose: impl Fn(S, S) -> S) {
        let (start, rest) = self.rates.split_at_mut(self.n);
        let closing = (self.tableau.closing - 1) * self.n;
        for (start, end) in start.iter_mut().zip(&rest[closing..]) {
            *start = choose(*end, *start);
        }
        for (y, new) in y.iter_mut().zip(&self.new) {
            *y = choose(*new, *y);
        }
        for (lost, losing) in self.lost.iter_mut().zip(&self.losing) {
            *lost = choose(*losing, *lost);
        }
    }
}
