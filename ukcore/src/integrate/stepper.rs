//! One explicit Runge-Kutta step, for any scalar.
//!
//! A scalar may carry many lanes, each with a mechanism, a time and a step size of its own; so times and sizes are scalars too, and nothing
//! here branches on a value. What is accepted, and how large the next step is, is decided outside.

use super::control::{Control, first_size};
use super::dense::cubic;
use super::sums::{Tolerance, keeping, sized, sum_of_squares, weights};
use super::tableau::{self, Sums, Tableau};
use crate::lanes::Lanes;
use crate::scalar::Scalar;
use std::ops::Range;

/// The right-hand side y' = f of a first-order system, over s, the time since the start of a run.
pub(crate) trait Rates<S> {
    /// What ends a step at once.
    type Error;
    /// y' at (s, y) into `rate`.
    fn rate(&mut self, s: S, y: &[S], rate: &mut [S]) -> Result<(), Self::Error>;
}

/// The state at the start of a step, buffers, and what the last attempted step left in them.
pub(crate) struct Stepper<S> {
    pub(super) tableau: &'static Tableau,
    sums: Sums<S>,
    n: usize,
    /// The tolerance of a step.
    pub(crate) tolerance: Tolerance<S>,
    /// State at the start of the step.
    start: Vec<S>,
    /// State at its end.
    end: Vec<S>,
    /// Rates at the stages, row by row: those of the step, the closing one, those for the interpolant.
    rates: Vec<S>,
    /// The state at which a stage is evaluated.
    argument: Vec<S>,
    /// What rounding took from the state at the start of the step, to be added to the change that the step makes.
    lost: Vec<S>,
    /// What rounding took from the state at the end of the attempted step.
    losing: Vec<S>,
    /// Estimates of the error, row by row.
    errors: Vec<S>,
    /// Rows of coefficients of the interpolant.
    dense: Vec<S>,
}

impl Stepper<f64> {
    /// Gives the [estimate](Stepper::estimate) of a closed step the size `norm`.
    pub(super) fn scale_error(&mut self, norm: f64) {
        let states = [&self.start[..], &self.end];
        sized(&mut self.errors[..self.n], states, &self.tolerance, norm);
    }
}

impl<L: Lanes> Stepper<L> {
    /// Sizes of the first steps in all lanes, at most `largest` and of its sign. Comes after [`begin`](Stepper::begin).
    pub(crate) fn first_size(&mut self, rates: &mut impl Rates<L>, s: L, largest: L) -> L {
        let start = [&self.start, &self.rates[..self.n]];
        first_size(
            rates,
            s,
            start,
            largest,
            self.control().order,
            &self.tolerance,
        )
    }

    /// Another motion begins in lane `k` at `y`, with these [floors](Tolerance::floors).
    #[cfg(feature = "ensemble")]
    pub(crate) fn put(&mut self, k: usize, y: impl Iterator<Item = f64>, floors: &[f64]) {
        for ((start, lost), y) in self.start.iter_mut().zip(&mut self.lost).zip(y) {
            start.set_lane(k, y);
            lost.set_lane(k, 0.0);
        }
        for (floor, new) in self.tolerance.floors.iter_mut().zip(floors) {
            floor.set_lane(k, *new);
        }
    }
}

impl<S: Scalar> Stepper<S> {
    /// Steps by [DOP853](tableau::DOP853) from this state.
    pub(crate) fn dop853(start: Vec<S>, tolerance: Tolerance<S>) -> Self {
        Stepper::new(&tableau::DOP853, tableau::dop853(), start, tolerance)
    }

    /// Steps by [DOPRI5](tableau::DOPRI5) from this state.
    pub(crate) fn dopri5(start: Vec<S>, tolerance: Tolerance<S>) -> Self {
        Stepper::new(&tableau::DOPRI5, tableau::dopri5(), start, tolerance)
    }

    fn new(
        tableau: &'static Tableau,
        sums: Sums<S>,
        start: Vec<S>,
        tolerance: Tolerance<S>,
    ) -> Self {
        let n = start.len();
        let zeros = |rows: usize| vec![S::from_f64(0.0); rows * n];
        Stepper {
            tableau,
            sums,
            n,
            tolerance,
            start,
            end: zeros(1),
            rates: zeros(1 + tableau.stages.len()),
            argument: zeros(1),
            lost: zeros(1),
            losing: zeros(1),
            errors: zeros(tableau.errors.len()),
            dense: zeros(4 + tableau.dense.len()),
        }
    }

    /// Choice of the step size.
    pub(crate) fn control(&self) -> &'static Control {
        &self.tableau.control
    }

    /// State at the start of the step, and at the end of the attempted one.
    pub(crate) fn states(&self) -> [&[S]; 2] {
        [&self.start, &self.end]
    }

    /// State at the end of the attempted step, to be projected before [`close`](Stepper::close).
    pub(crate) fn end_mut(&mut self) -> &mut [S] {
        &mut self.end
    }

    /// Evaluates f at the start, which is at `s`, where `choose(new, old)` is the new value. Later steps begin with what
    /// [`close`](Stepper::close) has evaluated.
    pub(crate) fn begin<R: Rates<S>>(
        &mut self,
        rates: &mut R,
        s: S,
        choose: impl Fn(S, S) -> S,
    ) -> Result<(), R::Error> {
        rates.rate(s, &self.start, &mut self.argument)?;
        for (rate, new) in self.rates.iter_mut().zip(&self.argument) {
            *rate = choose(*new, *rate);
        }
        Ok(())
    }

    /// The stages of a step of size `h` from `s`, and the [state](Stepper::end) at its end. Returns the estimated
    /// [error](Stepper::error); 0 if that takes the closing stage.
    pub(crate) fn attempt<R: Rates<S>>(
        &mut self,
        rates: &mut R,
        s: S,
        h: S,
    ) -> Result<S, R::Error> {
        let closing = self.tableau.closing;
        self.evaluate(rates, s, h, 1..closing)?;
        // The stage's sum on top of what was lost so far, then both onto y: the larger of two terms first, so that what is lost is exact.
        (self.sums.argument)(closing, &mut self.end, &self.lost, h, &self.rates);
        for ((end, start), lost) in self.end.iter_mut().zip(&self.start).zip(&mut self.losing) {
            (*end, *lost) = keeping(*start, *end);
        }
        Ok(self.error(h, false))
    }

    /// Evaluates `stages`.
    fn evaluate<R: Rates<S>>(
        &mut self,
        rates: &mut R,
        s: S,
        h: S,
        stages: Range<usize>,
    ) -> Result<(), R::Error> {
        for stage in stages {
            (self.sums.argument)(stage, &mut self.argument, &self.start, h, &self.rates);
            let s = s + S::from_f64(self.tableau.stages[stage - 1].c) * h;
            let rate = &mut self.rates[stage * self.n..][..self.n];
            rates.rate(s, &self.argument, rate)?;
        }
        Ok(())
    }

    /// Evaluates f at the end of the attempted step of size `h`, which is at `s`. Returns the estimated [error](Stepper::error) if that
    /// takes this stage; else 0.
    pub(crate) fn close<R: Rates<S>>(&mut self, rates: &mut R, s: S, h: S) -> Result<S, R::Error> {
        let closing = self.tableau.closing * self.n;
        rates.rate(s, &self.end, &mut self.rates[closing..][..self.n])?;
        Ok(self.error(h, true))
    }

    /// Estimated error of the step in the [error norm](super): at most 1 if it has the accuracy asked for. 0 if it is not known now, when
    /// the step is closed or not.
    ///
    /// With two estimates e₁, e₂: |e₁|² / √(|e₁|² + 0.01 |e₂|²), eq. (10.17) of the book, which falls as h⁸.
    fn error(&mut self, h: S, closed: bool) -> S {
        let zero = S::from_f64(0.0);
        if closed != self.tableau.closing_in_error {
            return zero;
        }
        (self.sums.errors)(&mut self.errors, h, &self.rates);
        // No stage is evaluated any more.
        weights(&mut self.argument, &self.start, &self.end, &self.tolerance);
        let n = self.n;
        let best = sum_of_squares(&self.errors[..n], &self.argument);
        let other = sum_of_squares(&self.errors[n..], &self.argument);
        let both = best + S::from_f64(0.01) * other;
        let divisor = S::select_le(both, zero, S::from_f64(1.0), both);
        best / (S::from_f64(n.max(1) as f64) * divisor).sqrt()
    }

    /// The first estimate of what the state at the end of the attempted step is off: its direction, not its size.
    pub(crate) fn estimate(&self) -> &[S] {
        &self.errors[..self.n]
    }

    /// Makes the [coefficients](Stepper::dense) of the interpolant of the closed step; evaluates stages for it if the method needs them.
    pub(crate) fn interpolate<R: Rates<S>>(
        &mut self,
        rates: &mut R,
        s: S,
        h: S,
    ) -> Result<(), R::Error> {
        let n = self.n;
        let closing = self.tableau.closing;
        self.evaluate(rates, s, h, closing + 1..self.tableau.stages.len() + 1)?;
        let (rows, more) = self.dense.split_at_mut(4 * n);
        (self.sums.dense)(more, h, &self.rates);
        let (start, end) = (&self.rates[..n], &self.rates[closing * n..][..n]);
        cubic(rows, h, &self.start, &self.end, start, end);
        Ok(())
    }

    /// Coefficients of the interpolant, rows as [`Interpolant`](super::dense::Interpolant) wants them.
    pub(crate) fn dense(&self) -> &[S] {
        &self.dense
    }

    /// Moves on to the end of the closed step. `choose(new, old)` is the new value in the lanes whose step was accepted, the old one in the
    /// others.
    pub(crate) fn advance(&mut self, choose: impl Fn(S, S) -> S) {
        let (start, rest) = self.rates.split_at_mut(self.n);
        let closing = &rest[(self.tableau.closing - 1) * self.n..];
        let pairs = [
            (start, closing),
            (&mut self.start[..], &self.end[..]),
            (&mut self.lost[..], &self.losing[..]),
        ];
        for (old, new) in pairs {
            for (old, new) in old.iter_mut().zip(new) {
                *old = choose(*new, *old);
            }
        }
    }
}
