//! The explicit Runge-Kutta methods as schemes.

use super::Tolerance;
use super::control::StepSize;
use super::course::Trial;
use super::scheme::{Equations, Scheme};
use super::stepper::Stepper;
use super::trouble::Cause;

/// A [`Stepper`] of one lane.
pub(super) struct Explicit {
    pub(super) stepper: Stepper<f64>,
    pub(super) size: StepSize,
}

impl Scheme for Explicit {
    fn states(&self) -> [&[f64]; 2] {
        self.stepper.states()
    }

    fn end_mut(&mut self) -> &mut [f64] {
        self.stepper.end_mut()
    }

    fn gap(&self) -> Option<[f64; 2]> {
        Some(self.stepper.tableau.gap())
    }

    fn tolerate(&mut self, tolerance: &Tolerance) {
        self.stepper.tolerance.clone_from(tolerance);
    }

    fn begin(&mut self, equations: &mut Equations<'_>) -> Result<(), Cause> {
        let s = equations.course.now.s;
        self.stepper.begin(equations, s, |new, _| new)
    }

    fn first_size(&mut self, equations: &mut Equations<'_>, largest: f64) -> f64 {
        let s = equations.course.now.s;
        self.stepper.first_size(equations, s, largest)
    }

    fn attempt(&mut self, equations: &mut Equations<'_>, step: Trial) -> Result<f64, Cause> {
        self.stepper.attempt(equations, step.start.s, step.h)
    }

    fn close(&mut self, equations: &mut Equations<'_>, step: Trial) -> Result<f64, Cause> {
        self.stepper.close(equations, step.end.s, step.h)
    }

    fn interpolate(&mut self, equations: &mut Equations<'_>, step: Trial) -> Result<(), Cause> {
        self.stepper.interpolate(equations, step.start.s, step.h)
    }

    fn dense(&self) -> &[f64] {
        self.stepper.dense()
    }

    fn scale_error(&mut self, norm: f64) {
        self.stepper.scale_error(norm);
    }

    fn error(&self) -> Option<&[f64]> {
        Some(self.stepper.estimate())
    }

    fn advance(&mut self) {
        self.stepper.advance(|new, _| new);
    }

    fn accepted(&mut self, h: f64, error: f64) -> f64 {
        self.size.accepted(self.stepper.control(), h, error)
    }

    fn inaccurate(&mut self, h: f64, error: f64) -> f64 {
        self.size.inaccurate(self.stepper.control(), h, error)
    }

    fn unfit(&mut self, h: f64) -> f64 {
        self.size.unfit(h)
    }
}
