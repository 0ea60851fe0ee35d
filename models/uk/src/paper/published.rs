//! What the paper states, but for Table 1, which the model keeps (`models::uchain::TABLE_1`).

/// The printed numbers are output points of a solver, so the last of their three digits may be off by one.
pub(super) const TABLE_1_DIGIT: f64 = 1e-3;

/// Range of the negative peaks that §5 states, m/s².
pub(super) const PEAKS: (f64, f64) = (-350.0, -200.0);
/// Range of the accelerations above g that §5 states, m/s².
pub(super) const ABOVE_G: (f64, f64) = (10.0, 25.0);
/// The conclusions' bound on the pull on the tip, in weights of one particle.
pub(super) const PULL: f64 = 40.0;
/// Gravity of the paper, m/s².
pub(super) const GRAVITY: f64 = 9.8;

/// Amplitude A2 of the peduncle, rad.
pub(super) const A2: f64 = 0.3;
/// Amplitudes A3 of the fin, rad (Figs. 9-16).
pub(super) const AMPLITUDES: [f64; 4] = [0.1, 0.2, 0.4, 0.6];
/// Frequencies of the fin in units of π rad/s.
pub(super) const FREQUENCIES_PI: [f64; 4] = [2.0, 2.5, 3.0, 3.5];
/// Phases of the fin behind the peduncle, degrees: the paper's 15°, and others to see the trend (it does not print its own).
pub(super) const PHASES_DEG: [f64; 4] = [0.0, 15.0, 30.0, 60.0];
