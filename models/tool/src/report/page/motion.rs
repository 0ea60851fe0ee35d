//! One motion: its pictures and all of its runs.

use maud::{Markup, html};

use super::claimed;
use crate::html::{Cell, figure, fixed, message, power_of_ten, table};
use crate::numbers::{duration, short};
use crate::report::charts;
use crate::report::study::{Figures, Study};
use crate::report::variants::label;

pub(super) fn motion(study: &Study) -> Markup {
    let file = charts::file(study);
    let picture = |kind: &str, caption: &str| {
        let text = format!("Error against {kind}, {}", study.name);
        figure(&format!("figures/{file}-{kind}.svg"), &text, caption)
    };
    html! {
        h3 id=(file) { (study.name) }
        p {
            (capital(&study.summary)) ", to " (short(study.end, 3)) " s. Reference: " (study.reference.source) "; its error is "
            (power_of_ten(study.reference.floor)) "."
            @if !study.whole { " " b { "Interrupted: not all of it was measured." } }
        }
        div.figures {
            (picture("time", "Left and low is good. Rings lie at the error of the reference: it is at most that."))
            (picture(
                "evaluations",
                "The same by evaluations, which do not depend on the formula: methods and stabilisations alone. The Jacobians of an \
                 implicit method are not among them."
            ))
        }
        @if !study.left_out.is_empty() {
            p {
                "Left out: "
                @for (k, left) in study.left_out.iter().enumerate() {
                    @if k > 0 { "; " }
                    (label(&left.variant)) " (" (message(&left.reason)) ")"
                }
                "."
            }
        }
        details { summary { "All runs" } (all_runs(study)) }
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.trim_end_matches('.').chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

fn all_runs(study: &Study) -> Markup {
    let rows = study.curves.iter().flat_map(|curve| {
        curve.points.iter().enumerate().map(move |(k, point)| {
            let combination = if k == 0 { label(&curve.variant) } else { "" };
            let mut row = vec![Cell::text(combination), Cell::power(point.knob)];
            match &point.figures {
                Some(f) => row.extend(cells(study, f)),
                None => row.push(Cell::Rest(
                    html! { i { (point.failure.as_deref().unwrap_or_default()) } },
                )),
            }
            row
        })
    });
    table(
        "Every run. Errors are scaled; “off” is the distance from the constraints at the end; residuals and the drift of the energy are \
         the largest over all steps.",
        "combination | setting | time | ± | evaluations | Jacobians | steps | rejected | error | along | off | residual | energy | \
         fallbacks",
        rows,
    )
}

fn cells(study: &Study, f: &Figures) -> [Cell; 12] {
    let (low, high) = f.quartiles;
    let spread = (f.repeats > 1).then(|| 50.0 * (high - low) / f.seconds);
    let jacobians = (f.jacobians > 0).then_some(f.jacobians);
    [
        Cell::number(duration(f.seconds)),
        Cell::or_missing(spread, |s| Cell::number(format!("{} %", fixed(s, 0)))),
        Cell::number(f.evaluations),
        Cell::or_missing(jacobians, Cell::number),
        Cell::number(f.steps),
        Cell::number(f.rejected),
        claimed(study, f.error),
        claimed(study, f.error_along),
        Cell::or_missing(f.off, Cell::power),
        Cell::power(f.drift.position_residual.max(f.drift.velocity_residual)),
        Cell::or_missing(f.drift.energy_drift, Cell::power),
        Cell::number(f.fallbacks),
    ]
}
