//! One motion: its pictures and all of its runs.

use std::fmt::Write;

use super::{claimed, duration, missing, or_missing, power};
use crate::html::{Cell, escape, figure, fixed, power_of_ten, table};
use crate::numbers;
use crate::report::charts;
use crate::report::study::{Figures, Study};
use crate::report::variants::named;

/// Its section.
pub(super) fn motion(study: &Study) -> String {
    let file = charts::file(study);
    let picture = |kind: &str, caption: &str| {
        figure(
            &format!("figures/{file}-{kind}.svg"),
            &format!("Error against {kind}, {}", study.name),
            caption,
        )
    };
    let mut html = format!(
        "<h3 id=\"{file}\">{}</h3>\n<p>{}, to {} s. Reference: {}; its error is {}.{}</p>\n<div class=\"figures\">\n{}{}</div>\n",
        escape(&study.name),
        escape(&capital(&study.summary)),
        numbers::short(study.end, 3),
        escape(&study.reference.source),
        power_of_ten(study.reference.floor),
        if study.whole {
            ""
        } else {
            " <b>Interrupted: not all of it was measured.</b>"
        },
        picture(
            "time",
            "Left and low is good. Rings lie at the error of the reference: it is at most that."
        ),
        picture(
            "evaluations",
            "The same by evaluations, which do not depend on the formula: methods and stabilisations alone. The Jacobians of an implicit method are not among them."
        ),
    );
    if !study.left_out.is_empty() {
        let list: Vec<String> = study
            .left_out
            .iter()
            .map(|l| {
                let label = named(&l.variant).map_or(l.variant.as_str(), |v| v.label);
                format!("{} ({})", escape(label), escape(&l.reason))
            })
            .collect();
        let _ = writeln!(html, "<p>Left out: {}.</p>", list.join("; "));
    }
    let _ = write!(
        html,
        "<details><summary>All runs</summary>\n{}</details>\n",
        all_runs(study)
    );
    html
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

fn all_runs(study: &Study) -> String {
    let mut rows = Vec::new();
    for curve in &study.curves {
        let label = named(&curve.variant).map_or(curve.variant.as_str(), |v| v.label);
        for (k, point) in curve.points.iter().enumerate() {
            let mut row = vec![
                Cell::Text(if k == 0 { escape(label) } else { String::new() }),
                power(point.knob),
            ];
            match &point.figures {
                Some(f) => row.extend(cells(study, f)),
                None => {
                    let failure = point.failure.as_deref().unwrap_or_default();
                    row.push(Cell::Wide(12, format!("<i>{}</i>", escape(failure))));
                }
            }
            rows.push(row);
        }
    }
    table(
        "Every run. Errors are scaled; “off” is the distance from the constraints at the end; residuals and the drift of the energy are the largest over all steps.",
        &[&[
            ("combination", 1),
            ("setting", 1),
            ("time", 1),
            ("±", 1),
            ("evaluations", 1),
            ("Jacobians", 1),
            ("steps", 1),
            ("rejected", 1),
            ("error", 1),
            ("along", 1),
            ("off", 1),
            ("residual", 1),
            ("energy", 1),
            ("fallbacks", 1),
        ]],
        &rows,
    )
}

fn cells(study: &Study, f: &Figures) -> Vec<Cell> {
    let count = |n: usize| Cell::Number(n.to_string());
    let (low, high) = f.quartiles;
    let spread = 50.0 * (high - low) / f.seconds;
    vec![
        Cell::Number(duration(f.seconds)),
        if f.repeats > 1 {
            Cell::Number(format!("{} %", fixed(spread, 0)))
        } else {
            missing()
        },
        count(f.evaluations),
        if f.jacobians > 0 {
            count(f.jacobians)
        } else {
            missing()
        },
        count(f.steps),
        count(f.rejected),
        claimed(study, f.error),
        claimed(study, f.error_along),
        or_missing(f.off, power),
        power(f.drift.position_residual.max(f.drift.velocity_residual)),
        or_missing(f.drift.energy_drift, power),
        count(f.fallbacks),
    ]
}
