//! The explicit Runge-Kutta methods as schemes.

use super::Tolerance;
use super::control::{Guess, StepSize};
use super::scheme::{Attempt, Equations, NoRate, Scheme};
use super::stepper::Stepper;
use super::tableau::Tableau;

/// A [`Stepper`] of one lane, and its step size.
pub(super) struct Explicit {
    stepper: Stepper<f64>,
    tableau: &'static Tableau,
    step_size: StepSize,
}

impl Explicit {
    /// With the tableau and the sums of `stepper`.
    pub(super) fn new(stepper: Stepper<f64>) -> Self {
        Explicit {
            tableau: stepper.tableau(),
            stepper,
            step_size: StepSize::new(),
        }
    }

    fn error(&mut self, step: Attempt, y: &[f64]) -> f64 {
        self.stepper.error(step.h, y, step.tolerance)
    }
}

impl Scheme for Explicit {
    fn begin(&mut self, equations: &mut Equations<'_>, s: f64, y: &[f64]) -> Result<(), NoRate> {
        let f = |s, y: &[f64], rate: &mut [f64]| equations.rate(s, y, rate);
        self.stepper.begin(f, s, y)
    }

    fn first_size(
        &mut self,
        equations: &mut Equations<'_>,
        y: &[f64],
        sign: f64,
        tolerance: Tolerance,
        largest: f64,
    ) -> f64 {
        let rate = self.stepper.rate().to_vec();
        let start = y.iter().copied().zip(rate.iter().copied());
        let guess = Guess::new(start.clone(), tolerance, largest);
        let f = |s, y: &[f64], rate: &mut [f64]| equations.rate(s, y, rate);
        let Ok(after) = self.stepper.probe(f, 0.0, sign * guess.h, y) else {
            return guess.h;
        };
        let start = start.zip(after).map(|((y, rate), after)| (y, rate, *after));
        guess.refine(start, self.tableau.control.order, tolerance, largest)
    }

    fn attempt(
        &mut self,
        equations: &mut Equations<'_>,
        step: Attempt,
        y: &[f64],
    ) -> Result<f64, NoRate> {
        let f = |s, y: &[f64], rate: &mut [f64]| equations.rate(s, y, rate);
        self.stepper.attempt(f, step.s, step.h, y)?;
        Ok(if self.tableau.closing_in_error {
            0.0
        } else {
            self.error(step, y)
        })
    }

    fn state(&self) -> &[f64] {
        self.stepper.state()
    }

    fn state_mut(&mut self) -> &mut [f64] {
        self.stepper.state_mut()
    }

    fn close(
        &mut self,
        equations: &mut Equations<'_>,
        step: Attempt,
        y: &[f64],
    ) -> Result<f64, NoRate> {
        let f = |s, y: &[f64], rate: &mut [f64]| equations.rate(s, y, rate);
        self.stepper.close(f, step.s_end)?;
        Ok(if self.tableau.closing_in_error {
            self.error(step, y)
        } else {
            0.0
        })
    }

    fn interpolate(
        &mut self,
        equations: &mut Equations<'_>,
        step: Attempt,
        y: &[f64],
    ) -> Result<(), NoRate> {
        let f = |s, y: &[f64], rate: &mut [f64]| equations.rate(s, y, rate);
        self.stepper.interpolate(f, step.s, step.h, y)
    }

    fn dense(&self) -> &[f64] {
        self.stepper.dense()
    }

    fn advance(&mut self, y: &mut [f64]) {
        self.stepper.advance(y, |new, _| new);
    }

    fn accepted(&mut self, h: f64, error: f64) -> f64 {
        self.step_size.accepted(&self.tableau.control, h, error)
    }

    fn inaccurate(&mut self, h: f64, error: f64) -> f64 {
        self.step_size.inaccurate(&self.tableau.control, h, error)
    }

    fn unfit(&mut self, h: f64) -> f64 {
        self.step_size.unfit(h)
    }
}
