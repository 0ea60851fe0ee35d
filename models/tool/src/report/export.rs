//! report.json and report.csv.

use serde::{Deserialize, Serialize};

use super::study::{Curve, Figures, Point, Study};
use crate::numbers::exact;

/// All that is measured.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Report {
    pub(super) about: String,
    /// The program that measured, and what it was asked for: only its own numbers are taken over into a later report.
    pub(super) program: String,
    /// Few settings, one timing of each.
    pub(super) quick: bool,
    /// All that was asked for is there.
    pub(super) complete: bool,
    /// What `seconds` of a run are.
    pub(super) clock: String,
    /// Wall time of all measurements, s.
    pub(super) seconds: f64,
    /// What could not be measured, and why.
    pub(super) failures: Vec<(String, String)>,
    pub(super) studies: Vec<Study>,
}

/// What the numbers are, in report.json.
pub(super) const ABOUT: &str = "Error against run time. SI units. error: largest difference from the reference at the end, each coordinate \
     and velocity divided by the largest value of its kind along the motion; error_along: the same over all times of the reference; \
     error_in_units: not divided; off: distance of the end from the nearest state on the constraints, within: distance of that state from \
     the reference, both scaled; residuals and energy drift: largest over all steps; knob: tolerance of the integration; seconds: median \
     of the repeats, quartiles beside it.";

/// The rows of report.csv of a motion, one a run.
pub(super) fn rows(study: &Study) -> impl Iterator<Item = Vec<(&'static str, String)>> {
    let runs = study.curves.iter();
    let runs = runs.flat_map(|curve| curve.points.iter().map(move |point| (curve, point)));
    runs.map(|(curve, point)| row(study, curve, point))
}

fn row(study: &Study, curve: &Curve, point: &Point) -> Vec<(&'static str, String)> {
    let figures = point.figures.as_ref();
    let known = |of: fn(&Figures) -> Option<f64>| figures.and_then(of).map_or(String::new(), exact);
    let number = |of: fn(&Figures) -> f64| figures.map_or(String::new(), |f| exact(of(f)));
    let count = |of: fn(&Figures) -> usize| figures.map_or(String::new(), |f| of(f).to_string());
    let floor = figures.map_or(String::new(), |_| exact(study.reference.floor));
    vec![
        ("motion", study.name.clone()),
        ("model", study.model.clone()),
        ("end", exact(study.end)),
        ("combination", curve.variant.clone()),
        ("knob", exact(point.knob)),
        ("seconds", number(|f| f.seconds)),
        ("lower_quartile", number(|f| f.quartiles.0)),
        ("upper_quartile", number(|f| f.quartiles.1)),
        ("repeats", count(|f| f.repeats)),
        ("evaluations", count(|f| f.evaluations)),
        ("jacobians", count(|f| f.jacobians)),
        ("factorisations", count(|f| f.factorisations)),
        ("steps", count(|f| f.steps)),
        ("rejected", count(|f| f.rejected)),
        ("projections", count(|f| f.projections)),
        ("fallbacks", count(|f| f.fallbacks)),
        ("error", number(|f| f.error)),
        ("error_in_units", number(|f| f.error_in_units)),
        ("error_along", number(|f| f.error_along)),
        ("reference_error", floor),
        ("off", known(|f| f.off)),
        ("within", known(|f| f.within)),
        ("position_residual", number(|f| f.drift.position_residual)),
        ("velocity_residual", number(|f| f.drift.velocity_residual)),
        ("energy_drift", known(|f| f.drift.energy_drift)),
        ("failure", point.failure.clone().unwrap_or_default()),
    ]
}
