//! What is measured of one motion, as it is kept in report.json.

use serde::{Deserialize, Serialize};

use crate::drift::Drift;

/// One motion of one model under all combinations.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Study {
    /// The name of the study: the model, and the end where a model has several.
    pub(super) name: String,
    pub(super) model: String,
    /// The model in one line.
    pub(super) summary: String,
    /// The end, s.
    pub(super) end: f64,
    /// What errors are measured against.
    pub(super) reference: Source,
    /// Causes of error that belong to the motion, not to a combination.
    pub(super) limits: Limits,
    pub(super) curves: Vec<Curve>,
    pub(super) left_out: Vec<LeftOut>,
    /// Longer runs of what conserves energy.
    pub(super) long: Vec<LongRun>,
    /// The model has no constraints, so that all combinations keep them.
    pub(super) unconstrained: bool,
    /// The measurement was not interrupted.
    pub(super) whole: bool,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Source {
    pub(super) source: String,
    /// The source's own error, scaled: none below is claimed.
    pub(super) floor: f64,
    /// Times at which it is known, s.
    pub(super) times: Vec<f64>,
}

/// What no method can avoid, and what the solver adds.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Limits {
    /// Scaled change of the end when every coordinate and velocity of the start is moved by ε of its size and put back onto the
    /// constraints.
    pub(super) rounding: Option<f64>,
    /// Relative change of q̈ at the states of the reference when the rank tolerance is a thousand times smaller or larger.
    pub(super) rank: Option<f64>,
    /// Relative difference of q̈ by the automatic choice from q̈ by eq. 13 or 19 at these states.
    pub(super) solve: Option<f64>,
}

/// A combination with its runs, loose to tight.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Curve {
    /// Name of the combination.
    pub(super) variant: String,
    pub(super) points: Vec<Point>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Point {
    /// Tolerance, or step in s.
    pub(super) knob: f64,
    /// What came out, unless it failed.
    pub(super) figures: Option<Figures>,
    pub(super) failure: Option<String>,
}

/// What a run cost and how good it was.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Figures {
    /// Time, s: median of the repeats.
    pub(super) seconds: f64,
    pub(super) quartiles: (f64, f64),
    pub(super) repeats: usize,
    pub(super) evaluations: usize,
    pub(super) jacobians: usize,
    pub(super) factorisations: usize,
    /// Accepted steps.
    pub(super) steps: usize,
    pub(super) rejected: usize,
    pub(super) projections: usize,
    /// Evaluations that left the formula first tried.
    pub(super) fallbacks: usize,
    /// Scaled error at the end.
    pub(super) error: f64,
    /// Largest error at the end, in the coordinates' units.
    pub(super) error_in_units: f64,
    /// Largest scaled error at the times of the reference, samples being interpolated.
    pub(super) error_along: f64,
    /// Scaled distance of the end from the nearest state on the constraints, if that can be found.
    pub(super) off: Option<f64>,
    /// Scaled distance of that state from the reference.
    pub(super) within: Option<f64>,
    /// Largest residuals and drift of the energy over all steps.
    #[serde(flatten)]
    pub(super) drift: Drift,
}

/// A run many times as long, for its energy.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct LongRun {
    /// Name of the combination.
    pub(super) variant: String,
    /// Tolerance, or step in s.
    pub(super) knob: f64,
    /// The duration of the run, s.
    pub(super) span: f64,
    /// Time that it took, once, s.
    pub(super) seconds: Option<f64>,
    /// Drift of the energy after a tenth, as a part of the energy exchanged.
    pub(super) early: Option<f64>,
    /// Drift at the end.
    pub(super) late: Option<f64>,
    pub(super) failure: Option<String>,
}

/// A combination that was not run.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct LeftOut {
    /// Name of the combination.
    pub(super) variant: String,
    pub(super) reason: String,
}

impl Study {
    /// The runs of the combination called `variant`.
    pub(super) fn curve(&self, variant: &str) -> Option<&Curve> {
        self.curves.iter().find(|c| c.variant == variant)
    }

    /// The error as it may be claimed: not below that of the reference.
    pub(super) fn claimed(&self, error: f64) -> f64 {
        error.max(self.reference.floor)
    }
}

impl Curve {
    /// The runs that succeeded, with their setting.
    pub(super) fn figures(&self) -> impl Iterator<Item = (f64, &Figures)> {
        let points = self.points.iter();
        points.filter_map(|p| p.figures.as_ref().map(|f| (p.knob, f)))
    }

    /// The run with this setting, if it succeeded.
    pub(super) fn at(&self, knob: f64) -> Option<&Figures> {
        let same = |k: f64| (k / knob - 1.0).abs() < 1e-9;
        self.figures().find(|(k, _)| same(*k)).map(|(_, f)| f)
    }
}
