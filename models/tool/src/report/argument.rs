//! Whether the figures support each default of [`ukcore::Simulation`].

use maud::{Markup, html};

use super::study::Study;
use super::variants::Variant;
use super::verdict::{DEFAULT_TOLERANCE, GOALS, Price, TIE, price, price_at};
use crate::html::{fixed, power_of_ten};
use crate::numbers::median;

/// A default and what the figures say of it.
pub(super) struct Argument {
    pub(super) default: &'static str,
    pub(super) figures: Markup,
    pub(super) supported: bool,
}

/// Errors that the default tolerance should stay below for it to be called safe.
const SAFE: f64 = 1e-5;

/// What speaks for and against each default.
pub(super) fn arguments(studies: &[Study]) -> Vec<Argument> {
    let all = [
        method_argument(studies),
        formula_argument(studies),
        stabilisation_argument(studies),
        tolerance_argument(studies),
    ];
    all.into_iter().flatten().collect()
}

/// All prices that are known at the goals.
fn prices(studies: &[Study], variant: &str, other: &str) -> Vec<Price> {
    let every = studies.iter().flat_map(|s| GOALS.map(|goal| (s, goal)));
    every
        .filter_map(|(s, goal)| price(s, variant, other, goal))
        .collect()
}

fn median_time(prices: &[Price]) -> Option<f64> {
    median(prices.iter().map(|p| p.time).collect())
}

fn method_argument(studies: &[Study]) -> Option<Argument> {
    let known = prices(studies, "dopri5", "dop853");
    let middle = median_time(&known)?;
    let faster = known.iter().filter(|p| p.time > 1.0).count();
    Some(Argument {
        default: "DOP853",
        figures: html! {
            "DOPRI5 takes " (fixed(middle, 2)) " times the time for the same error (median of " (known.len()) " cases), and more in "
             (faster)
            " of them."
        },
        supported: middle > 1.0,
    })
}

fn formula_argument(studies: &[Study]) -> Option<Argument> {
    let middle = median_time(&prices(studies, "dop853-general", "dop853"))?;
    let kkt = median_time(&prices(studies, "dop853-kkt", "dop853"))?;
    Some(Argument {
        default: "The automatic formula",
        figures: html! {
            "a run with eq. 13 or 19 throughout takes " (fixed(middle, 1)) " times its time, one with the dense KKT " (fixed(kkt, 1))
            " times (medians, where there is a straight line)."
        },
        supported: middle > 1.0 && kkt > 1.0,
    })
}

fn stabilisation_argument(studies: &[Study]) -> Option<Argument> {
    let equal = median_time(&prices(studies, "dop853", "dop853-none"))?;
    let same = studies.iter();
    let same = same.filter_map(|s| price_at(s, "dop853", "dop853-none", DEFAULT_TOLERANCE));
    let (same, errors): (Vec<Price>, Vec<f64>) = same.unzip();
    let (time, error) = (median_time(&same)?, median(errors)?);
    let feedback = prices(studies, "dop853-baumgarte20", "dop853");
    let feedback = median(feedback.iter().map(|p| p.evaluations).collect());
    Some(Argument {
        default: "Projection",
        figures: html! {
            "at tolerance " (power_of_ten(DEFAULT_TOLERANCE)) " it adds " (fixed(100.0 * (time - 1.0), 0))
            " % to the time of a run without and multiplies its error by " (fixed(error, 2)) "; for the same error it takes "
             (fixed(equal, 2))
            " times the time (medians), and the constraints hold."
            @if let Some(feedback) = feedback {
                " Baumgarte's feedback of 20/s takes " (fixed(feedback, 2)) " times its evaluations for the same error."
            }
        },
        supported: equal <= TIE,
    })
}

fn tolerance_argument(studies: &[Study]) -> Option<Argument> {
    let default = Variant::default().name;
    let at = |s: &Study, knob| s.curve(default).and_then(|c| c.at(knob)).copied();
    let errors = studies.iter();
    let errors = errors.filter_map(|s| Some(s.claimed(at(s, DEFAULT_TOLERANCE)?.error)));
    let errors: Vec<f64> = errors.collect();
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
        figures: html! {
            "errors at the end are " (power_of_ten(median(errors)?)) " in the median, " (power_of_ten(worst))
            " at most (it is called safe while none exceeds " (power_of_ten(SAFE)) "); a tolerance of " (power_of_ten(1e3 *
             DEFAULT_TOLERANCE))
            " takes " (fixed(looser, 2)) " times the time, one of " (power_of_ten(1e-3 * DEFAULT_TOLERANCE)) " " (fixed(tighter, 2))
            " times (medians)."
        },
        supported: worst <= SAFE,
    })
}
