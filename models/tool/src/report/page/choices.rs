//! What to take, how often, and whether the defaults are right.

use std::fmt::Write;

use super::{claimed, duration, name, or_missing, percent, standing_words};
use crate::html::{Cell, escape, fixed, power_of_ten, table};
use crate::report::argument;
use crate::report::export::Report;
use crate::report::study::Study;
use crate::report::variants::{Engine, OMITTED, Variant};
use crate::report::verdict::{self, Among, DEFAULT_TOLERANCE, GOALS, TIE};

/// What to take for which accuracy, over all motions.
pub(super) fn choices(report: &Report) -> String {
    let goals: Vec<String> = GOALS
        .iter()
        .map(|g| format!("error {}", power_of_ten(*g)))
        .collect();
    let mut heads = vec![("motion", 1)];
    heads.extend(goals.iter().map(|g| (g.as_str(), 1)));
    let rows: Vec<Vec<Cell>> = report
        .studies
        .iter()
        .map(|study| {
            let mut row = vec![name(study)];
            row.extend(GOALS.iter().map(|&goal| recommended(study, goal)));
            row
        })
        .collect();
    let caption = format!(
        "The combination to take for an error at the end, and the time of its run: of those that keep the constraints the first of the list whose time is within \
         {} % of the least; below it in grey one that does not keep them, where that is faster still. The error is scaled: a part of the largest value that \
         coordinates, or velocities, of the same kind take.",
        fixed(100.0 * (TIE - 1.0), 0)
    );
    format!(
        "<h2 id=\"choices\">1. What to take for which accuracy</h2>\n{}",
        table(&caption, &[&heads], &rows)
    )
}

fn recommended(study: &Study, goal: f64) -> Cell {
    let Some(kept) = verdict::choice(study, goal, Among::Kept) else {
        return Cell::Number(unreached(study, goal).to_owned());
    };
    let mut text = format!(
        "<b>{}</b><br><small>{}<br>{} {}</small>",
        duration(kept.cost.seconds),
        escape(kept.variant.label),
        kept.variant.knob_name(),
        power_of_ten(kept.cost.knob),
    );
    if let Some(all) = verdict::choice(study, goal, Among::All)
        && all.variant != kept.variant
        && all.cost.seconds < kept.cost.seconds
    {
        let _ = write!(
            text,
            "<br><small class=\"soft\">{} {}</small>",
            duration(all.cost.seconds),
            escape(all.variant.label)
        );
    }
    Cell::Number(text)
}

/// Why nothing is recommended.
fn unreached(study: &Study, goal: f64) -> &'static str {
    if study.reference.floor > goal {
        "reference not so good"
    } else {
        "not reached"
    }
}

/// How often each combination is the one to take.
pub(super) fn tallied(report: &Report) -> String {
    let goals: Vec<String> = GOALS.iter().map(|g| power_of_ten(*g)).collect();
    let mut heads = vec![("combination", 1)];
    for _ in [Among::Kept, Among::All] {
        heads.extend(goals.iter().map(|g| (g.as_str(), 1)));
    }
    heads.push(("cases", 1));
    let worth = super::long::worth(report);
    let rows: Vec<Vec<Cell>> = verdict::tally(&report.studies)
        .into_iter()
        .map(|row| {
            let label = escape(row.variant.label);
            let all: usize = row.kept.iter().chain(&row.all).sum();
            let mut cells = vec![Cell::Text(if all == 0 && row.cases > 0 {
                let lasting = row.variant.engine == Engine::Rattle && worth.is_some();
                if lasting {
                    format!("{label}, for the energy of <a href=\"#long\">long runs</a>")
                } else {
                    format!("{label} <span class=\"fails\">never recommended</span>")
                }
            } else {
                label
            })];
            let counts = row.kept.iter().chain(&row.all);
            cells.extend(counts.map(|n| match n {
                0 => Cell::Number("·".to_owned()),
                n => Cell::Number(format!("<b>{n}</b>")),
            }));
            cells.push(Cell::Number(row.cases.to_string()));
            cells
        })
        .collect();
    format!(
        "<h2 id=\"tally\">2. How often each combination is the one to take</h2>\n{}<p>{OMITTED}</p>\n",
        table(
            "Motions for which the combination is the one to take, by accuracy; and the cases (a motion and an accuracy that is reached) in which it was in the running.",
            &[
                &[
                    ("", 1),
                    ("of those that keep the constraints", GOALS.len()),
                    ("of all", GOALS.len()),
                    ("", 1)
                ],
                &heads,
            ],
            &rows
        )
    )
}

/// Whether the figures support the defaults.
pub(super) fn defaults(report: &Report) -> String {
    let kept = verdict::standing(&report.studies, Among::Kept);
    let mut html = format!(
        "<h2 id=\"defaults\">3. Do the figures support the defaults?</h2>\n<p>{}: {}",
        escape(Variant::default().label),
        standing_words(&kept)
    );
    if let Some((ratio, name, goal)) = &kept.worst {
        let _ = write!(
            html,
            " At worst it takes {} times the least time ({}, {}).",
            fixed(*ratio, 1),
            escape(name),
            power_of_ten(*goal)
        );
    }
    html.push_str("</p>\n<ul>\n");
    for line in argument::arguments(&report.studies) {
        let _ = writeln!(
            html,
            "<li><b>{}</b>: {} <span class=\"{}\">{}</span></li>",
            escape(line.default),
            line.figures,
            if line.supported { "holds" } else { "fails" },
            if line.supported {
                "supported"
            } else {
                "not supported"
            },
        );
    }
    html.push_str("</ul>\n");
    let rows: Vec<Vec<Cell>> = report.studies.iter().filter_map(default_row).collect();
    if !rows.is_empty() {
        html.push_str(&table(
            "The default combination at the default tolerance, and a thousand times looser and tighter: scaled error, and change of the time.",
            &[
                &[("", 1), ("10<sup>−9</sup>", 3), ("10<sup>−6</sup>", 2), ("10<sup>−12</sup>", 2)],
                &[
                    ("motion", 1),
                    ("error at the end", 1),
                    ("along the run", 1),
                    ("time", 1),
                    ("error", 1),
                    ("time", 1),
                    ("error", 1),
                    ("time", 1),
                ],
            ],
            &rows,
        ));
    }
    html
}

fn default_row(study: &Study) -> Option<Vec<Cell>> {
    let own = study.curve(Variant::default().name)?;
    let here = own.at(DEFAULT_TOLERANCE)?;
    let mut row = vec![
        name(study),
        claimed(study, here.error),
        claimed(study, here.error_along),
        Cell::Number(duration(here.seconds)),
    ];
    for factor in [1e3, 1e-3] {
        let beside = own.at(factor * DEFAULT_TOLERANCE);
        row.push(or_missing(beside, |f| claimed(study, f.error)));
        row.push(or_missing(beside, |f| {
            Cell::Number(percent(f.seconds / here.seconds))
        }));
    }
    Some(row)
}
