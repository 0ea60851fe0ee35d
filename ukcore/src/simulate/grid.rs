//! Sample times at equal intervals.

/// The times t₀ + k dt. Where t₀ and dt are decimals, each is the number nearest to the decimal: 0.9 and not 3 · 0.3, which is
/// 0.8999999999999999.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    t0: f64,
    dt: f64,
    /// A power of ten by which both are whole, if there is one.
    scale: Option<f64>,
}

/// Whole numbers below are exact.
const WHOLE: f64 = 9_007_199_254_740_992.0;

impl Grid {
    pub(super) fn new(t0: f64, dt: f64) -> Self {
        let whole = |x: f64, scale: f64| {
            let digits = (x * scale).round();
            digits.abs() < WHOLE && digits / scale == x
        };
        let powers = (0..=15).map(|p| 10_f64.powi(p));
        let scale = powers.into_iter().find(|&s| whole(t0, s) && whole(dt, s));
        Grid { t0, dt, scale }
    }

    /// Time number `k`.
    pub(super) fn time(&self, k: f64) -> f64 {
        if let Some(scale) = self.scale {
            let steps = k * (self.dt * scale).round();
            let digits = (self.t0 * scale).round() + steps;
            if steps.abs() < WHOLE && digits.abs() < WHOLE {
                return digits / scale;
            }
        }
        self.t0 + k * self.dt
    }
}
