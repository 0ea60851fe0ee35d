//! report.json and report.csv.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};

use super::study::Study;

/// All that is measured.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Report {
    /// What the numbers are.
    pub(super) about: String,
    /// The program that measured: only its own numbers are taken over into a later report.
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
    /// One for each motion.
    pub(super) studies: Vec<Study>,
}

/// What the numbers are, in report.json.
pub(super) const ABOUT: &str = "Error against run time. SI units. error: largest difference from the reference at the end, each coordinate and velocity divided by the \
     largest value of its kind along the motion; error_along: the same over all times of the reference; error_in_units: not divided; off: distance \
     of the end from the nearest state on the constraints, within: distance of that state from the reference, both scaled; residuals and energy \
     drift: largest over all steps; knob: tolerance of the integration; seconds: median of the repeats, quartiles beside it.";

/// The table, one row a run.
///
/// # Errors
/// Those of `out`.
pub(super) fn csv(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "motion,model,end,combination,knob,seconds,lower_quartile,upper_quartile,repeats,evaluations,jacobians,factorisations,steps,rejected,projections,fallbacks,\
         error,error_in_units,error_along,reference_error,off,within,position_residual,velocity_residual,energy_drift,failure"
    )?;
    for study in &report.studies {
        for curve in &study.curves {
            for point in &curve.points {
                write!(
                    out,
                    "{},{},{},{},{:e}",
                    study.name, study.model, study.end, curve.variant, point.knob
                )?;
                let Some(f) = &point.figures else {
                    let failure = point.failure.as_deref().unwrap_or_default();
                    writeln!(out, "{}{}", ",".repeat(21), quoted(failure))?;
                    continue;
                };
                let (low, high) = f.quartiles;
                write!(
                    out,
                    ",{:e},{low:e},{high:e},{},{},{},{},{},{},{},{}",
                    f.seconds,
                    f.repeats,
                    f.evaluations,
                    f.jacobians,
                    f.factorisations,
                    f.steps,
                    f.rejected,
                    f.projections,
                    f.fallbacks
                )?;
                write!(
                    out,
                    ",{:e},{:e},{:e},{:e},{},{}",
                    f.error,
                    f.error_in_units,
                    f.error_along,
                    study.reference.floor,
                    number(f.off),
                    number(f.within)
                )?;
                let (position, velocity) = (f.drift.position_residual, f.drift.velocity_residual);
                let energy = number(f.drift.energy_drift);
                writeln!(out, ",{position:e},{velocity:e},{energy},")?;
            }
        }
    }
    Ok(())
}

/// A number, or an empty field.
fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |v| format!("{v:e}"))
}

/// A field that may contain commas and quotes.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\"").replace('\n', " "))
}
