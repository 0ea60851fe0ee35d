//! The page.

mod choices;
mod costs;
mod long;
mod motion;

use maud::{Markup, html};

use crate::html::{Cell, Page, fixed, message, power_of_ten, signed};
use crate::numbers;

use super::charts;
use super::export::Report;
use super::study::Study;
use super::variants::Variant;
use super::verdict::{self, Among, DEFAULT_TOLERANCE, TIE};

pub(super) fn html(report: &Report) -> String {
    let motions = html! { @for study in &report.studies { (motion::motion(study)) } };
    let page = Page {
        title: "Error against run time",
        head: head(report),
        files: &[("report.json", "JSON"), ("report.csv", "CSV")],
        sections: vec![
            (
                ["choices", "What to take", "What to take for which accuracy"],
                choices::choices(report),
            ),
            (
                [
                    "tally",
                    "How often",
                    "How often each combination is the one to take",
                ],
                choices::tallied(report),
            ),
            (
                [
                    "defaults",
                    "The defaults",
                    "Do the figures support the defaults?",
                ],
                choices::defaults(report),
            ),
            (
                ["prices", "Stabilisation", "What stabilisation costs"],
                costs::prices(report),
            ),
            (
                ["causes", "Causes of error", "Where the errors come from"],
                costs::causes(report),
            ),
            (["long", "Long runs", "Long runs"], long::long_runs(report)),
            (["motions", "Motions", "Motion by motion"], motions),
            (
                ["method", "How it is measured", "How it is measured"],
                method(report),
            ),
        ],
        foot: html! { footer { p { "Measured in " (fixed(report.seconds, 0)) " s." } } },
    };
    page.render()
}

/// An error; where it lies below that of the reference, the latter as a bound.
fn claimed(study: &Study, error: f64) -> Cell {
    let bound = error <= study.reference.floor;
    Cell::Number(html! { @if bound { "≤ " } (power_of_ten(study.claimed(error))) })
}

/// A ratio as a change in per cent.
fn percent(ratio: f64) -> Cell {
    let change = 100.0 * (ratio - 1.0);
    Cell::number(if change.abs() >= 900.0 {
        format!("× {}", fixed(ratio, 0))
    } else {
        let digits = if change.abs() < 10.0 { 1 } else { 0 };
        format!("{} %", signed(change, digits))
    })
}

fn name(study: &Study) -> Cell {
    Cell::Text(html! { a href=(format!("#{}", charts::file(study))) { (study.name) } })
}

/// How the default stands, in words.
fn standing_words(found: &verdict::Standing) -> String {
    let mut text = format!(
        "within {} % of the fastest combination that keeps the constraints in {} of {} (a motion and an accuracy).",
        fixed(100.0 * (TIE - 1.0), 0),
        found.best,
        numbers::count(found.cases, "case"),
    );
    if found.missed > 0 {
        let missed = numbers::count(found.missed, "case");
        text += &format!(" In {missed} it does not reach the accuracy though another one does.");
    }
    text
}

fn head(report: &Report) -> Markup {
    let kept = verdict::standing(&report.studies, Among::Kept);
    html! {
        p.lead { "Each model under every sensible combination of method, formula for the accelerations and stabilisation." }
        @if !report.complete {
            p.note { b { "This report is incomplete" } ": it was interrupted. The same command goes on from here." }
        }
        @if report.quick {
            p.note { "A quick look (" code { "--quick" } "): few tolerances, each timed once. Times and verdicts are rough." }
        }
        @if cfg!(debug_assertions) {
            p.note { "Measured with a program that was built without optimisation: times and verdicts are not those of a release build." }
        }
        @for (name, text) in &report.failures { p.note { (name) " could not be measured: " (message(text)) } }
        @if kept.cases > 0 {
            p {
                "The default of " code { "Simulation" } ", " (Variant::default().label) " at tolerance " (power_of_ten(DEFAULT_TOLERANCE))
                " with the automatic formula, is " (standing_words(&kept))
            }
        }
    }
}

fn method(report: &Report) -> Markup {
    html! {
        p {
            "Times are " (report.clock) " of a whole run from the start to the end, with the making of the solver and without samples"
            @if report.quick { ", each taken once." } @else {
                "; the median of the repeats, which go round by round through all combinations of a motion, so that what disturbs the \
                 machine for a while meets all alike. “±” is half the distance of the quartiles."
            }
        }
        p {
            "The " b { "error" } " is the largest of all coordinates and velocities at the end, each divided by the largest value of its \
             kind along the motion; the kind of a coordinate is its name up to the first digit or bracket, so that x1, x2 and x[3] share \
             their size. “Along” is the largest error over all times of the reference, where states are interpolated by the method. \
             report.json has the errors in units, too."
        }
        p {
            "A verdict for an accuracy takes of each combination the loosest run from which on the error stays below it, as the next \
             tighter run has to as well: luck does not count. Between two runs it goes along a straight line of the logarithms."
        }
        p {
            "References that are shipped with the models come from closed forms or from integrations with more digits. Where there is \
             none, or a much better one can be had, DOP853 with a tenth of the steps that it takes at 10" sup { "−13" } " serves; its \
             difference from a run with steps 1.5 times as long is taken as its error, and its difference from DOPRI5 is told. No error \
             below that of the reference is claimed."
        }
    }
}
