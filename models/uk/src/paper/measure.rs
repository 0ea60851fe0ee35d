//! Numbers taken from curves: minima, and the oscillation in a drifting signal.

use nalgebra::{Matrix6, Vector6};
use uktool::numbers::extremes;

/// (√5 − 1)/2.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Place and value of the least of `f` between `a` and `b`, by golden-section search; `f` has one minimum there.
///
/// The bracket shrinks to √ε of its place: closer than that a smooth f differs by rounding only.
pub(super) fn minimise<E>(
    mut f: impl FnMut(f64) -> Result<f64, E>,
    mut a: f64,
    mut b: f64,
) -> Result<(f64, f64), E> {
    let mut left = b - GOLDEN * (b - a);
    let mut right = a + GOLDEN * (b - a);
    let (mut at_left, mut at_right) = (f(left)?, f(right)?);
    while (b - a).abs() > f64::EPSILON.sqrt() * (1.0 + a.abs()) {
        if at_left < at_right {
            (b, right, at_right) = (right, left, at_left);
            left = b - GOLDEN * (b - a);
            at_left = f(left)?;
        } else {
            (a, left, at_left) = (left, right, at_right);
            right = a + GOLDEN * (b - a);
            at_right = f(right)?;
        }
    }
    Ok(if at_left < at_right {
        (left, at_left)
    } else {
        (right, at_right)
    })
}

/// A sinusoid found in a signal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Oscillation {
    /// Angular frequency in rad/s.
    pub(super) omega: f64,
    /// Amplitude, in the unit of the signal.
    pub(super) amplitude: f64,
}

/// Terms of the fit: 1, τ, τ², τ³ for the drift, cos and sin.
const TERMS: usize = 6;
/// Frequencies tried between the bounds: neighbours differ by less than what a window of a few periods can tell apart.
const FREQUENCIES: usize = 600;

/// The sinusoid with a frequency between `low` and `high` that, with a cubic drift, fits the samples (t, value) best in least squares.
pub(super) fn oscillation(samples: &[(f64, f64)], low: f64, high: f64) -> Option<Oscillation> {
    let step = (high / low).powf(1.0 / (FREQUENCIES - 1) as f64);
    (0..FREQUENCIES)
        .filter_map(|k| {
            let omega = low * step.powi(i32::try_from(k).ok()?);
            fit(samples, omega)
                .map(|(residual, amplitude)| (residual, Oscillation { omega, amplitude }))
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, found)| found)
}

/// Sum of squares left over, and amplitude, of the fit at one frequency; none if the samples do not determine it.
fn fit(samples: &[(f64, f64)], omega: f64) -> Option<(f64, f64)> {
    let (first, last) = (samples.first()?.0, samples.last()?.0);
    let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
    // (Plain arrays, as this crate is not optimised: matrices take most of the time of the whole evaluation.)
    let mut normal = [[0.0; TERMS]; TERMS];
    let mut projection = [0.0; TERMS];
    let mut squares = 0.0;
    for &(t, value) in samples {
        let tau = (t - middle) / half;
        let (sin, cos) = (omega * t).sin_cos();
        let basis = [1.0, tau, tau * tau, tau * tau * tau, cos, sin];
        for (i, &factor) in basis.iter().enumerate() {
            for (sum, &other) in normal[i].iter_mut().zip(&basis) {
                *sum += factor * other;
            }
            projection[i] += value * factor;
        }
        squares += value * value;
    }
    let projection = Vector6::from(projection);
    let solution = Matrix6::from(normal).lu().solve(&projection)?;
    let (cos, sin) = (solution[TERMS - 2], solution[TERMS - 1]);
    Some((squares - solution.dot(&projection), cos.hypot(sin)))
}

/// Largest minus smallest value.
pub(super) fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = extremes(values);
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    #[test]
    fn a_minimum_is_found_to_the_root_of_rounding() {
        let (x, y) = minimise(|x| Ok::<_, Infallible>((x - 0.3).powi(2) - 2.0), -1.0, 1.0)
            .expect("infallible");
        assert!((x - 0.3).abs() < 1e-7);
        assert!((y + 2.0).abs() < 1e-15);
    }

    #[test]
    fn an_oscillation_is_found_under_a_drift() {
        let samples: Vec<(f64, f64)> = (0..=300)
            .map(|k| 1.0 + 0.01 * f64::from(k))
            .map(|t| (t, 0.4 * (7.0 * t - 0.6).sin() + 3.0 - t + 0.2 * t * t))
            .collect();
        let found = oscillation(&samples, 2.0, 20.0).expect("determined");
        assert!((found.omega - 7.0).abs() < 0.02, "{found:?}");
        assert!((found.amplitude - 0.4).abs() < 0.004, "{found:?}");
    }

    #[test]
    fn too_few_samples_determine_nothing() {
        assert_eq!(oscillation(&[], 1.0, 2.0), None);
    }

    #[test]
    fn the_spread_of_values() {
        assert_eq!(spread([1.0, -2.0, 0.5].into_iter()), 3.0);
    }
}
