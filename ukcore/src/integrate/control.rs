//! Choice of the step size, and of the first one.
//!
//! After Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, §II.4, with the constants of the authors' codes. The same
//! for a run of its own and for each lane of an ensemble.

use super::stepper::Rates;
use super::sums::Tolerance;
use crate::lanes::Lanes;

/// Part of the step size that should just meet the tolerance which is taken.
pub(super) const SAFETY: f64 = 0.9;

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

/// What the choice of the step size remembers of the steps before. Sizes may have either sign.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct StepSize {
    /// Size and error of the last accepted step.
    pub(super) last: Option<(f64, f64)>,
    /// The last attempt was rejected.
    pub(super) rejected: bool,
}

impl StepSize {
    /// Size of the step after one of size `h` that was accepted with the error `error`. Does not grow after a rejection.
    ///
    /// Where errors grew faster from the step before to this one than their sizes account for, they are taken to go on so (Gustafsson's
    /// prediction; Hairer & Wanner, *Solving Ordinary Differential Equations II*, §IV.8, eq. (8.25)). On the falling chain that saves
    /// half of the rejected steps.
    pub(crate) fn accepted(&mut self, control: &Control, h: f64, error: f64) -> f64 {
        // Powers by logarithms: error^−exponent previous^beta.
        let (now, floor) = (error.ln(), SMALLEST_PREVIOUS);
        let previous = self.last.map_or(floor, |(_, error)| error.ln().max(floor));
        let mut factor = SAFETY * (control.beta * previous - control.exponent * now).exp();
        let largest = if self.rejected { 1.0 } else { control.grow };
        if let Some((size, _)) = self.last {
            let growth = control.exponent * (previous - 2.0 * now.max(floor));
            factor = factor.min(SAFETY * h / size * growth.exp());
        }
        self.accept(h, error);
        h * factor.clamp(control.shrink, control.grow).min(largest)
    }

    /// A step of size `h` was accepted with the error `error`.
    pub(super) fn accept(&mut self, h: f64, error: f64) {
        self.last = Some((h, error));
        self.rejected = false;
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

/// The first step where nothing tells how fast things change, as a share of the run.
const BLIND: f64 = 1e-6;

/// Sizes of the first steps of a method of order `order`, in each lane, from y and `rate`, which is f there, at `s`. They are at most
/// `largest`, and have its sign.
///
/// A first guess is the h for which an explicit Euler step changes y by a hundredth. With f after such a step, h^order max(|f|, |f'|) =
/// 0.01; where f has no value there, it stays with the guess.
pub(super) fn first_size<L: Lanes>(
    rates: &mut impl Rates<L>,
    s: L,
    [y, rate]: [&[L]; 2],
    largest: L,
    order: f64,
    tolerance: &Tolerance<L>,
) -> L {
    let zero = L::from_f64(0.0);
    let (mut value, mut slope, mut change) = (zero, zero, zero);
    for (i, (y, rate)) in y.iter().zip(rate).enumerate() {
        let weight = tolerance.at(i, y.abs()).recip();
        value = value + (*y * weight) * (*y * weight);
        slope = slope + (*rate * weight) * (*rate * weight);
    }
    let blind = |k: usize| BLIND * largest.lane(k).abs();
    let signed = |k: usize, h: f64| {
        let largest = largest.lane(k);
        h.min(largest.abs()).copysign(largest)
    };
    let guess = L::from_lanes(|k| {
        let (value, slope) = (value.lane(k), slope.lane(k));
        let still = slope <= 1e-10 || value <= 1e-10;
        match still {
            true => signed(k, blind(k)),
            false => signed(k, 0.01 * (value / slope).sqrt()),
        }
    });
    let pairs = y.iter().zip(rate);
    let probe: Vec<L> = pairs.map(|(y, rate)| *y + guess * *rate).collect();
    let mut after = probe.clone();
    if rates.rate(s + guess, &probe, &mut after).is_err() {
        return guess;
    }
    for (i, ((y, rate), after)) in y.iter().zip(rate).zip(after).enumerate() {
        let weighted = (after - *rate) / tolerance.at(i, y.abs());
        change = change + weighted * weighted;
    }
    L::from_lanes(|k| {
        let h = guess.lane(k).abs();
        let curvature = change.lane(k).sqrt() / h;
        if curvature.is_nan() {
            return guess.lane(k);
        }
        let steepest = curvature.max(slope.lane(k).sqrt());
        let refined = if steepest <= 1e-15 {
            blind(k).max(1e-3 * h)
        } else {
            (0.01 / steepest).powf(order.recip())
        };
        signed(k, refined.min(100.0 * h))
    })
}
