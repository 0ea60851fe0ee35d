//! What the energy does over long runs.

use maud::{Markup, html};

use super::name;
use crate::html::{Cell, fixed, power_of_ten, table};
use crate::numbers::duration;
use crate::report::export::Report;
use crate::report::study::{LongRun, Study};
use crate::report::variants::Variant;
use crate::report::verdict;

/// The section; empty where no motion was run for long.
pub(super) fn long_runs(report: &Report) -> Markup {
    let studies = || report.studies.iter().filter(|s| !s.long.is_empty());
    let Some(times) = studies().next().map(|s| s.long[0].span / s.end) else {
        return html! {};
    };
    let caption = format!(
        "Runs {} times as long, of models that conserve energy and to which RATTLE applies. Each row is a step of RATTLE beside the \
         tightest tolerance of the default combination that takes no more time. Energy: its largest change as a part of the energy \
         exchanged; growth: that over the whole run by that over its first tenth, 10 for a steady trend and 1 for none. Break-even: the \
         duration from which on RATTLE keeps the energy better for the same time, if both go on so.",
        fixed(times, 0)
    );
    let heads = "motion | RATTLE: step (s); time; energy; growth | the default: tolerance; time; energy; growth | break-even (s)";
    html! {
        p { (verdict_words(report)) }
        (table(caption, heads, studies().flat_map(rows)))
    }
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

fn verdict_words(report: &Report) -> Markup {
    let Some((time, name)) = worth(report) else {
        return html! { "RATTLE is the one to take in none of these runs." };
    };
    html! {
        "RATTLE keeps the energy without a trend, and the default combination does not; but for the same time the default keeps it better \
         up to a duration of "
        (power_of_ten(time)) " s at least (" (name) "). RATTLE is the one to take for the energy of runs longer than that."
    }
}

/// The runs of RATTLE that succeeded.
fn rattle(study: &Study) -> impl Iterator<Item = &LongRun> {
    let default = Variant::default().name;
    let runs = study.long.iter();
    runs.filter(move |r| r.variant != default && r.late.is_some())
}

fn rows(study: &Study) -> impl Iterator<Item = Vec<Cell>> {
    rattle(study).enumerate().map(move |(k, run)| {
        let beside = verdict::as_cheap(study, run);
        let even = beside.and_then(|beside| verdict::break_even(run, beside));
        let first = if k == 0 { name(study) } else { Cell::text("") };
        let pair = cells(Some(run)).into_iter().chain(cells(beside));
        let row = [first].into_iter().chain(pair);
        row.chain([Cell::or_missing(even, Cell::power)]).collect()
    })
}

fn cells(run: Option<&LongRun>) -> [Cell; 4] {
    let growth = |r: &LongRun| Some(r.late? / r.early?).filter(|g| g.is_finite());
    [
        Cell::or_missing(run.map(|r| r.knob), Cell::power),
        Cell::or_missing(run.and_then(|r| r.seconds), |s| Cell::number(duration(s))),
        Cell::or_missing(run.and_then(|r| r.late), Cell::power),
        Cell::or_missing(run.and_then(growth), |g| Cell::fixed(g, 1)),
    ]
}
