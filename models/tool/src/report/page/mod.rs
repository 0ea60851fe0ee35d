//! The page.

mod choices;
mod costs;
mod long;
mod motion;

use std::fmt::Write;

use crate::html::{Cell, escape, fixed, page, power_of_ten};
use crate::numbers;

use super::charts;
use super::export::Report;
use super::study::Study;
use super::variants::Variant;
use super::verdict::{self, Among, DEFAULT_TOLERANCE, TIE};

/// index.html.
pub(super) fn html(report: &Report) -> String {
    let mut body = head(report);
    body.push_str(&choices::choices(report));
    body.push_str(&choices::tallied(report));
    body.push_str(&choices::defaults(report));
    body.push_str(&costs::prices(report));
    body.push_str(&costs::causes(report));
    body.push_str(&long::long_runs(report));
    body.push_str("<h2 id=\"motions\">7. Motion by motion</h2>\n");
    for study in &report.studies {
        body.push_str(&motion::motion(study));
    }
    body.push_str(&method(report));
    page("Error against run time", &body)
}

/// A time with its unit.
pub(super) fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1e-3 => (1e6 * s, "µs"),
        s if s < 1.0 => (1e3 * s, "ms"),
        s => (s, "s"),
    };
    let digits = if value < 10.0 {
        2
    } else if value < 100.0 {
        1
    } else {
        0
    };
    format!("{} {unit}", fixed(value, digits))
}

fn power(value: f64) -> Cell {
    Cell::Number(power_of_ten(value))
}

/// An error; where it lies below that of the reference, the latter as a bound.
fn claimed(study: &Study, error: f64) -> Cell {
    let text = power_of_ten(study.claimed(error));
    Cell::Number(if error <= study.reference.floor {
        format!("≤ {text}")
    } else {
        text
    })
}

fn missing() -> Cell {
    Cell::Number("–".to_owned())
}

fn or_missing<T>(value: Option<T>, cell: impl Fn(T) -> Cell) -> Cell {
    value.map_or_else(missing, cell)
}

/// A ratio as a change in per cent.
fn percent(ratio: f64) -> String {
    let change = 100.0 * (ratio - 1.0);
    if change.abs() >= 900.0 {
        return format!("× {}", fixed(ratio, 0));
    }
    format!(
        "{} %",
        crate::html::signed(change, if change.abs() < 10.0 { 1 } else { 0 })
    )
}

fn name(study: &Study) -> Cell {
    Cell::Text(format!(
        "<a href=\"#{}\">{}</a>",
        charts::file(study),
        escape(&study.name)
    ))
}

/// How the default stands, in words, HTML.
fn standing_words(found: &verdict::Standing) -> String {
    let mut text = format!(
        "within {} % of the fastest combination that keeps the constraints in {} of {} (a motion and an accuracy).",
        fixed(100.0 * (TIE - 1.0), 0),
        found.best,
        numbers::count(found.cases, "case"),
    );
    if found.missed > 0 {
        let _ = write!(
            text,
            " In {} it does not reach the accuracy though another one does.",
            numbers::count(found.missed, "case")
        );
    }
    text
}

fn head(report: &Report) -> String {
    let kept = verdict::standing(&report.studies, Among::Kept);
    let mut html = String::from(
        "<h1>Error against run time</h1>\n\
         <p class=\"lead\">Each model under every sensible combination of method, formula for the accelerations and stabilisation.</p>\n",
    );
    if !report.complete {
        html.push_str(
            "<p class=\"note\"><b>This report is incomplete</b>: it was interrupted. The same command goes on from here.</p>\n",
        );
    }
    if report.quick {
        html.push_str(
            "<p class=\"note\">A quick look (<code>--quick</code>): few tolerances, each timed once. Times and verdicts are rough.</p>\n",
        );
    }
    if cfg!(debug_assertions) {
        html.push_str(
            "<p class=\"note\">Measured with a program that was built without optimisation: times and verdicts are not those of a release build.</p>\n",
        );
    }
    for (name, message) in &report.failures {
        let _ = writeln!(
            html,
            "<p class=\"note\">{} could not be measured: {}</p>",
            escape(name),
            escape(message)
        );
    }
    let _ = writeln!(
        html,
        "<p>The default of <code>Simulation</code>, {} at tolerance {} with the automatic formula, is {}</p>\n\
         <nav><a href=\"#choices\">What to take</a><a href=\"#tally\">How often</a><a href=\"#defaults\">The defaults</a><a href=\"#prices\">Stabilisation</a>\
         <a href=\"#causes\">Causes of error</a><a href=\"#long\">Long runs</a><a href=\"#motions\">Motions</a><a href=\"#method\">How it is measured</a><a href=\"report.json\">JSON</a>\
         <a href=\"report.csv\">CSV</a></nav>",
        escape(Variant::default().label),
        power_of_ten(DEFAULT_TOLERANCE),
        standing_words(&kept),
    );
    html
}

fn method(report: &Report) -> String {
    format!(
        "<h2 id=\"method\">8. How it is measured</h2>\n\
         <p>Times are {} of a whole run from the start to the end, with the making of the solver and without samples; the median of the repeats, which go round by round through all \
         combinations of a motion, so that what disturbs the machine for a while meets all alike. “±” is half the distance of the quartiles.</p>\n\
         <p>The <b>error</b> is the largest of all coordinates and velocities at the end, each divided by the largest value of its kind along the motion; the kind of a \
         coordinate is its name up to the first digit or bracket, so that x1, x2 and x[3] share their size. “Along” is the largest error over all times of the \
         reference, where states are interpolated by the method. report.json has the errors in units, too.</p>\n\
         <p>A verdict for an accuracy takes of each combination the loosest run from which on the error stays below it, as the next tighter run has to as well: luck does not count. \
         Between two runs it goes along a straight line of the logarithms.</p>\n\
         <p>References that are shipped with the models come from closed forms or from integrations with more digits. Where there is none, or a much better one can be had, DOP853 with a tenth \
         of the steps that it takes at 10<sup>−13</sup> serves; its difference from a run with steps 1.5 times as long is taken as its error, and its difference from DOPRI5 is told. No error below that of the reference is claimed.</p>\n\
         <footer><p>Measured in {} s.</p></footer>\n",
        escape(&report.clock),
        fixed(report.seconds, 0)
    )
}
