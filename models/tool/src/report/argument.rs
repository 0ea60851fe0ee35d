//! Whether the figures support each default of [`ukcore::Simulation`].

use crate::html::{fixed, power_of_ten};

use super::study::Study;
use super::variants::Variant;
use super::verdict::{DEFAULT_TOLERANCE, GOALS, Price, TIE, median, price, price_at};

/// A default and what the figures say of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Argument {
    /// The default.
    pub(super) default: &'static str,
    /// The figures, HTML.
    pub(super) figures: String,
    /// They speak for it.
    pub(super) supported: bool,
}

/// Errors that the default tolerance should stay below for it to be called safe.
const SAFE: f64 = 1e-5;

/// What speaks for and against each default.
pub(super) fn arguments(studies: &[Study]) -> Vec<Argument> {
    [
        method_argument(studies),
        formula_argument(studies),
        stabilisation_argument(studies),
        tolerance_argument(studies),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// All prices that are known at the goals.
fn prices(studies: &[Study], variant: &str, other: &str) -> Vec<Price> {
    let every = studies.iter().flat_map(|s| GOALS.map(|goal| (s, goal)));
    every
        .filter_map(|(s, goal)| price(s, variant, other, goal))
        .collect()
}

fn method_argument(studies: &[Study]) -> Option<Argument> {
    let known = prices(studies, "dopri5", "dop853");
    let middle = median(known.iter().map(|p| p.time).collect())?;
    let faster = known.iter().filter(|p| p.time > 1.0).count();
    Some(Argument {
        default: "DOP853",
        figures: format!(
            "DOPRI5 takes {} times the time for the same error (median of {} cases), and more in {faster} of them.",
            fixed(middle, 2),
            known.len()
        ),
        supported: middle > 1.0,
    })
}

fn formula_argument(studies: &[Study]) -> Option<Argument> {
    let known = prices(studies, "dop853-general", "dop853");
    let middle = median(known.iter().map(|p| p.time).collect())?;
    let kkt = prices(studies, "dop853-kkt", "dop853");
    let kkt = median(kkt.iter().map(|p| p.time).collect())?;
    Some(Argument {
        default: "The automatic formula",
        figures: format!(
            "a run with eq. 13 or 19 throughout takes {} times its time, one with the dense KKT {} times (medians, where there is a straight line).",
            fixed(middle, 1),
            fixed(kkt, 1)
        ),
        supported: middle > 1.0 && kkt > 1.0,
    })
}

fn stabilisation_argument(studies: &[Study]) -> Option<Argument> {
    let known = prices(studies, "dop853", "dop853-none");
    let equal = median(known.iter().map(|p| p.time).collect())?;
    let same: Vec<(Price, f64)> = studies
        .iter()
        .filter_map(|s| price_at(s, "dop853", "dop853-none", DEFAULT_TOLERANCE))
        .collect();
    let time = median(same.iter().map(|(p, _)| p.time).collect())?;
    let error = median(same.iter().map(|(_, ratio)| *ratio).collect())?;
    let feedback = prices(studies, "dop853-baumgarte20", "dop853");
    let feedback = median(feedback.iter().map(|p| p.evaluations).collect());
    let feedback = feedback.map_or_else(String::new, |f| {
        format!(
            " Baumgarte's feedback of 20/s takes {} times its evaluations for the same error.",
            fixed(f, 2)
        )
    });
    Some(Argument {
        default: "Projection",
        figures: format!(
            "at tolerance {} it adds {} % to the time of a run without and multiplies its error by {}; for the same error it takes {} times the time \
             (medians), and the constraints hold.{feedback}",
            power_of_ten(DEFAULT_TOLERANCE),
            fixed(100.0 * (time - 1.0), 0),
            fixed(error, 2),
            fixed(equal, 2),
        ),
        supported: equal <= TIE,
    })
}

fn tolerance_argument(studies: &[Study]) -> Option<Argument> {
    let default = Variant::default().name;
    let at = |s: &Study, knob| s.curve(default).and_then(|c| c.at(knob)).copied();
    let errors: Vec<f64> = studies
        .iter()
        .filter_map(|s| Some(s.claimed(at(s, DEFAULT_TOLERANCE)?.error)))
        .collect();
    let ratio = |factor: f64| {
        let times = studies.iter().filter_map(|s| {
            Some(at(s, factor * DEFAULT_TOLERANCE)?.seconds / at(s, DEFAULT_TOLERANCE)?.seconds)
        });
        median(times.collect())
    };
    let (looser, tighter) = (ratio(1e3)?, ratio(1e-3)?);
    let worst = errors.iter().copied().fold(0.0, f64::max);
    Some(Argument {
        default: "Tolerance 1e-9",
        figures: format!(
            "errors at the end are {} in the median, {} at most (it is called safe while none exceeds {}); a tolerance of {} takes {} times the time, one of {} {} times (medians).",
            power_of_ten(median(errors)?),
            power_of_ten(worst),
            power_of_ten(SAFE),
            power_of_ten(1e3 * DEFAULT_TOLERANCE),
            fixed(looser, 2),
            power_of_ten(1e-3 * DEFAULT_TOLERANCE),
            fixed(tighter, 2),
        ),
        supported: worst <= SAFE,
    })
}
