//! report.json and report.csv.

use serde::{Deserialize, Serialize};

use super::study::Study;

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

/// A row of report.csv.
#[derive(Debug, Serialize)]
pub(super) struct Line<'a> {
    motion: &'a str,
    model: &'a str,
    end: f64,
    combination: &'a str,
    knob: f64,
    seconds: Option<f64>,
    lower_quartile: Option<f64>,
    upper_quartile: Option<f64>,
    repeats: Option<usize>,
    evaluations: Option<usize>,
    jacobians: Option<usize>,
    factorisations: Option<usize>,
    steps: Option<usize>,
    rejected: Option<usize>,
    projections: Option<usize>,
    fallbacks: Option<usize>,
    error: Option<f64>,
    error_in_units: Option<f64>,
    error_along: Option<f64>,
    reference_error: Option<f64>,
    off: Option<f64>,
    within: Option<f64>,
    position_residual: Option<f64>,
    velocity_residual: Option<f64>,
    energy_drift: Option<f64>,
    failure: &'a str,
}

/// The rows of a motion, one a run.
pub(super) fn lines(study: &Study) -> impl Iterator<Item = Line<'_>> {
    let points = study
        .curves
        .iter()
        .flat_map(|c| c.points.iter().map(move |p| (c, p)));
    points.map(|(curve, point)| {
        let f = point.figures.as_ref();
        Line {
            motion: &study.name,
            model: &study.model,
            end: study.end,
            combination: &curve.variant,
            knob: point.knob,
            seconds: f.map(|f| f.seconds),
            lower_quartile: f.map(|f| f.quartiles.0),
            upper_quartile: f.map(|f| f.quartiles.1),
            repeats: f.map(|f| f.repeats),
            evaluations: f.map(|f| f.evaluations),
            jacobians: f.map(|f| f.jacobians),
            factorisations: f.map(|f| f.factorisations),
            steps: f.map(|f| f.steps),
            rejected: f.map(|f| f.rejected),
            projections: f.map(|f| f.projections),
            fallbacks: f.map(|f| f.fallbacks),
            error: f.map(|f| f.error),
            error_in_units: f.map(|f| f.error_in_units),
            error_along: f.map(|f| f.error_along),
            reference_error: f.map(|_| study.reference.floor),
            off: f.and_then(|f| f.off),
            within: f.and_then(|f| f.within),
            position_residual: f.map(|f| f.drift.position_residual),
            velocity_residual: f.map(|f| f.drift.velocity_residual),
            energy_drift: f.and_then(|f| f.drift.energy_drift),
            failure: point.failure.as_deref().unwrap_or_default(),
        }
    })
}
