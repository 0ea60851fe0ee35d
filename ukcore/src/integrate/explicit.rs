//! The explicit Runge-Kutta methods as schemes.

use super::Tolerance;
use super::control::{self, StepSize};
use super::scheme::{Attempt, Equations, Scheme};
use super::stepper::Stepper;
use super::tableau::Tableau;
use super::trouble::Cause;

/// A [`Stepper`] of one lane.
pub(super) struct Explicit {
    stepper: Stepper<f64>,
    tableau: &'static Tableau,
}

impl Explicit {
    /// With the tableau and the sums of `stepper`.
    pub(super) fn new(stepper: Stepper<f64>) -> Self {
        Explicit {
            tableau: stepper.tableau(),
            stepper,
        }
    }

    fn error(&mut self, step: Attempt, y: &[f64]) -> f64 {
        self.stepper.error(step.h, y, step.tolerance)
    }
}

impl Scheme for Explicit {
    fn begin(&mut self, equations: &mut Equations<'_>, s: f64, y: &[f64]) -> Result<(), Cause> {
        let f = |s, y: &[f64], rate: &mut [f64]| equations.rate(s, y, rate);
        self.stepper.begin(f, s, y)
    }

    fn gap(&self) -> Option<[f64; 2]> {
        Some(self.tableau.gap())
    }

    fn first_size(
        &mut self,
        equations: &mut Equations<'_>,
        y: &[f64],
        sign: f64,
        tolerance: Tolerance,
        largest: f64,
    ) -> f64 {
        let start = (y, self.stepper.rate());
        let order = self.tableau.control.order;
        control::first_size(equations, start, (sign, largest), order, tolerance)
    }

    fn attempt(
        &mut self,
        equations: &mut Equations<'_>,
        step: Attempt,
        y: &[f64],
    ) -> Result<f64, Cause> {
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
    ) -> Result<f64, Cause> {
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
    ) -> Result<(), Cause> {
        let f = |s, y: &[f64], rate: &mut [f64]| equations.rate(s, y, rate);
        self.stepper.interpolate(f, step.s, step.h, y)
    }

    fn dense(&self) -> &[f64] {
        self.stepper.dense()
    }

    fn advance(&mut self, y: &mut [f64]) {
        self.stepper.advance(y, |new, _| new);
    }

    fn accepted(&mut self, size: &mut StepSize, h: f64, error: f64) -> f64 {
        size.accepted(&self.tableau.control, h, error)
    }

    fn inaccurate(&mut self, size: &mut StepSize, h: f64, error: f64) -> f64 {
        size.inaccurate(&self.tableau.control, h, error)
    }
}
