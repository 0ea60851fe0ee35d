//! Choice of the step size.
//!
//! After Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, §II.4, with the constants of the authors' codes. Pure
//! functions of numbers: a driver of many lanes uses them for each lane.

use super::dense::Clock;
use super::sums::Tolerance;

/// Part of the step size that should just meet the tolerance which is taken.
const SAFETY: f64 = 0.9;

/// Logarithm of 1e-4: errors below count as this much where the next step looks back on them.
const SMALLEST_PREVIOUS: f64 = -4.0 * std::f64::consts::LN_10;

/// Constants of a method.
pub(crate) struct Control {
    /// Order of the method.
    pub(crate) order: f64,
    /// A step size is thought to change the error by its power 1/`exponent`.
    pub(crate) exponent: f64,
    /// Weight of the error of the previous step (Lund's stabilisation).
    pub(crate) beta: f64,
    /// Least factor between two steps.
    pub(crate) shrink: f64,
    /// Largest factor between two steps.
    pub(crate) grow: f64,
}

/// What is remembered from step to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepSize {
    /// Logarithm of the error of the previous accepted step.
    previous: f64,
    /// Its size, 0 before the first one.
    size: f64,
    /// The last attempt was rejected.
    rejected: bool,
}

impl StepSize {
    /// At the start of a run.
    pub(crate) fn new() -> Self {
        StepSize {
            previous: SMALLEST_PREVIOUS,
            size: 0.0,
            rejected: false,
        }
    }

    /// Size of the step after one of size `h` that was accepted with the error `error`. Does not grow after a rejection.
    ///
    /// Where errors grew faster from the step before to this one than their sizes account for, they are taken to go on so (Gustafsson's
    /// prediction; Hairer & Wanner, *Solving Ordinary Differential Equations II*, §IV.8, eq. (8.25)). On the falling chain that saves half of the rejected steps.
    pub(crate) fn accepted(&mut self, control: &Control, h: f64, error: f64) -> f64 {
        // Powers by logarithms: error^−exponent previous^beta.
        let error = error.ln();
        let mut factor = SAFETY * (control.beta * self.previous - control.exponent * error).exp();
        let largest = if self.rejected { 1.0 } else { control.grow };
        let counted = error.max(SMALLEST_PREVIOUS);
        if self.size > 0.0 {
            let growth = control.exponent * (self.previous - 2.0 * counted);
            factor = factor.min(SAFETY * h / self.size * growth.exp());
        }
        self.previous = counted;
        self.size = h;
        self.rejected = false;
        h * factor.clamp(control.shrink, control.grow).min(largest)
    }

    /// Size of the next attempt after one of size `h` with an error above 1; NaN where a stage could not be evaluated.
    pub(crate) fn inaccurate(&mut self, control: &Control, h: f64, error: f64) -> f64 {
        self.rejected = true;
        let factor = SAFETY * error.powf(-control.exponent);
        // `max` takes the other one for NaN.
        h * factor.max(control.shrink)
    }

    /// Size of the next attempt after one of size `h` whose end did not do.
    pub(crate) fn unfit(&mut self, h: f64) -> f64 {
        self.rejected = true;
        0.5 * h
    }
}

/// A step is the last one if what would remain behind it is less than this part of it.
const LAST: f64 = 0.01;

/// Steps shorter than this share (ε²) of the run are not tried: near s = 0, where no rounding of s stops it, halving could go on
/// through three hundred decades.
const SHORTEST: f64 = f64::EPSILON * f64::EPSILON;

/// The step to be tried next.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Plan {
    /// Its positive size.
    pub(crate) size: f64,
    /// Its end.
    pub(crate) s: f64,
    /// The same as a time.
    pub(crate) t: f64,
    /// It ends at the end of the run.
    pub(crate) last: bool,
}

impl Plan {
    /// A step of proposed size `h` from (s, t), in a run to (s_end, t_end). `None` where it would be lost in rounding.
    pub(crate) fn new(
        h: f64,
        (s, t): (f64, f64),
        (s_end, t_end): (f64, f64),
        clock: Clock,
    ) -> Option<Self> {
        let last = s + (1.0 + LAST) * h > s_end;
        let plan = if last {
            Plan {
                size: s_end - s,
                s: s_end,
                t: t_end,
                last,
            }
        } else {
            Plan {
                size: h,
                s: s + h,
                t: clock.t(s + h),
                last,
            }
        };
        // The proposed size counts, not what is left to the end.
        let lost = 0.1 * h <= s * f64::EPSILON || plan.size < SHORTEST * s_end;
        (!lost && plan.t != t).then_some(plan)
    }
}

/// The first step where nothing tells how fast things change, as a share of the run.
const BLIND: f64 = 1e-6;

/// First guess of the first step size: h for which an explicit Euler step changes y by a hundredth.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Guess {
    /// Positive step size.
    pub(crate) h: f64,
    /// Norm of f at the start.
    slope: f64,
}

impl Guess {
    /// From pairs (y, f) at the start.
    pub(crate) fn new(
        start: impl Iterator<Item = (f64, f64)>,
        tolerance: Tolerance,
        largest: f64,
    ) -> Self {
        let (mut value, mut slope) = (0.0, 0.0);
        for (y, rate) in start {
            let weight = 1.0 / tolerance.at(y.abs());
            value += (y * weight) * (y * weight);
            slope += (rate * weight) * (rate * weight);
        }
        let h = if slope <= 1e-10 || value <= 1e-10 {
            BLIND * largest
        } else {
            0.01 * f64::sqrt(value / slope)
        };
        Guess {
            h: h.min(largest),
            slope: slope.sqrt(),
        }
    }

    /// The first step size, from triples (y, f, f after the Euler step of size `h`): h^order max(|f|, |f'|) = 0.01.
    ///
    /// NaN for the last one says that f could not be evaluated there; the first guess is then the best one.
    pub(crate) fn refine(
        self,
        start: impl Iterator<Item = (f64, f64, f64)>,
        order: f64,
        tolerance: Tolerance,
        largest: f64,
    ) -> f64 {
        let mut change = 0.0;
        for (y, rate, after) in start {
            let weighted = (after - rate) / tolerance.at(y.abs());
            change += weighted * weighted;
        }
        let curvature = f64::sqrt(change) / self.h;
        if curvature.is_nan() {
            return self.h;
        }
        let steepest = curvature.max(self.slope);
        let h = if steepest <= 1e-15 {
            f64::max(BLIND * largest, 1e-3 * self.h)
        } else {
            f64::powf(0.01 / steepest, 1.0 / order)
        };
        h.min(100.0 * self.h).min(largest)
    }
}
