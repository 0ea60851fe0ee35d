//! What the energy does over long runs.

use super::{duration, name, or_missing, power};
use crate::html::{Cell, escape, fixed, power_of_ten, table};
use crate::report::export::Report;
use crate::report::study::{LongRun, Study};
use crate::report::variants::Variant;
use crate::report::verdict;

/// The section; empty where no motion was run for long.
pub(super) fn long_runs(report: &Report) -> String {
    let studies: Vec<&Study> = report
        .studies
        .iter()
        .filter(|s| !s.long.is_empty())
        .collect();
    let Some(times) = studies.first().map(|s| s.long[0].span / s.end) else {
        return String::new();
    };
    let rows: Vec<Vec<Cell>> = studies.iter().flat_map(|s| rows(s)).collect();
    format!(
        "<h2 id=\"long\">6. Long runs</h2>\n<p>{}</p>\n{}",
        verdict_words(report),
        table(
            &format!(
                "Runs {} times as long, of models that conserve energy and to which RATTLE applies. Each row is a step of RATTLE beside the tightest tolerance of the default \
                 combination that takes no more time. Energy: its largest change as a part of the energy exchanged; growth: that over the whole run by that \
                 over its first tenth, 10 for a steady trend and 1 for none. Break-even: the duration from which on RATTLE keeps the energy better for \
                 the same time, if both go on so.",
                fixed(times, 0)
            ),
            &[
                &[("", 1), ("RATTLE", 4), ("the default", 4), ("", 1)],
                &[
                    ("motion", 1),
                    ("step (s)", 1),
                    ("time", 1),
                    ("energy", 1),
                    ("growth", 1),
                    ("tolerance", 1),
                    ("time", 1),
                    ("energy", 1),
                    ("growth", 1),
                    ("break-even (s)", 1),
                ],
            ],
            &rows
        )
    )
}

/// The least duration, s, from which on RATTLE is worth its price, and the motion of which that holds.
pub(super) fn worth(report: &Report) -> Option<(f64, String)> {
    let even = |study: &Study| {
        let pairs = rattle(study).filter_map(|run| {
            let beside = verdict::as_cheap(study, run)?;
            Some((verdict::break_even(run, beside)?, study.name.clone()))
        });
        pairs.min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let least = report.studies.iter().filter_map(even);
    least.min_by(|a, b| a.0.total_cmp(&b.0))
}

fn verdict_words(report: &Report) -> String {
    worth(report).map_or_else(
        || "RATTLE is the one to take in none of these runs.".to_owned(),
        |(time, name)| {
            format!(
                "RATTLE keeps the energy without a trend, and the default combination does not; but for the same time the default keeps it better up to a \
                 duration of {} s at least ({}). RATTLE is the one to take for the energy of runs longer than that.",
                power_of_ten(time),
                escape(&name)
            )
        },
    )
}

/// The runs of RATTLE that succeeded.
fn rattle(study: &Study) -> impl Iterator<Item = &LongRun> {
    let default = Variant::default().name;
    let runs = study.long.iter();
    runs.filter(move |r| r.variant != default && r.late.is_some())
}

fn rows(study: &Study) -> Vec<Vec<Cell>> {
    rattle(study)
        .enumerate()
        .map(|(k, run)| {
            let beside = verdict::as_cheap(study, run);
            let mut row = vec![if k == 0 {
                name(study)
            } else {
                Cell::Text(String::new())
            }];
            row.extend(cells(Some(run)));
            row.extend(cells(beside));
            let even = beside.and_then(|beside| verdict::break_even(run, beside));
            row.push(or_missing(even, |t| Cell::Number(power_of_ten(t))));
            row
        })
        .collect()
}

fn cells(run: Option<&LongRun>) -> [Cell; 4] {
    let growth = |r: &LongRun| Some(r.late? / r.early?).filter(|g| g.is_finite());
    [
        or_missing(run.map(|r| r.knob), power),
        or_missing(run.and_then(|r| r.seconds), |s| Cell::Number(duration(s))),
        or_missing(run.and_then(|r| r.late), power),
        or_missing(run.and_then(growth), |g| Cell::Number(fixed(g, 1))),
    ]
}
