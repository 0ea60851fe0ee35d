//! What to take, how often, and whether the defaults are right.

use maud::{Markup, html};

use super::{claimed, name, percent, standing_words};
use crate::html::{Cell, fixed, power_of_ten, table};
use crate::numbers::duration;
use crate::report::argument;
use crate::report::export::Report;
use crate::report::study::Study;
use crate::report::variants::{Engine, OMITTED, Variant};
use crate::report::verdict::{self, Among, DEFAULT_TOLERANCE, GOALS, TIE};

/// The heads of columns for these accuracies.
fn heads(goals: &[f64], between: &str, before: &str) -> String {
    let heads = goals
        .iter()
        .map(|g| format!("{before}{}", power_of_ten(*g).0));
    heads.collect::<Vec<_>>().join(between)
}

/// What to take for which accuracy, over all motions.
pub(super) fn choices(report: &Report) -> Markup {
    let goals = verdict::looked_at(report.quick, &report.studies);
    let caption = format!(
        "The combination to take for an error at the end, and the time of its run: of those that keep the constraints the first of the \
         list whose time is within {} % of the least; below it in grey one that does not keep them, where that is faster still. The error \
         is scaled: a part of the largest value that coordinates, or velocities, of the same kind take.",
        fixed(100.0 * (TIE - 1.0), 0)
    );
    let rows = report.studies.iter().map(|study| {
        let recommended = goals.iter().map(|&goal| recommended(study, goal));
        [name(study)].into_iter().chain(recommended).collect()
    });
    table(
        caption,
        &format!("motion|{}", heads(&goals, "|", "error ")),
        rows,
    )
}

fn recommended(study: &Study, goal: f64) -> Cell {
    let Some(kept) = verdict::choice(study, goal, Among::Kept) else {
        return Cell::number(match study.reference.floor > goal {
            true => "reference not so good",
            false => "not reached",
        });
    };
    let all = verdict::choice(study, goal, Among::All);
    let faster =
        all.filter(|all| all.variant != kept.variant && all.cost.seconds < kept.cost.seconds);
    Cell::Number(html! {
        b { (duration(kept.cost.seconds)) } br;
        small { (kept.variant.label) br; (kept.variant.knob_name()) " " (power_of_ten(kept.cost.knob)) }
        @if let Some(all) = faster { br; small.soft { (duration(all.cost.seconds)) " " (all.variant.label) } }
    })
}

/// How often each combination is the one to take.
pub(super) fn tallied(report: &Report) -> Markup {
    let goals = verdict::looked_at(report.quick, &report.studies);
    let each = heads(&goals, ";", "");
    let worth = super::long::worth(report);
    let rows = verdict::tally(&report.studies).into_iter().map(|row| {
        let chosen = row.kept.iter().chain(&row.all).any(|n| *n > 0);
        let lasting = row.variant.engine == Engine::Rattle && worth.is_some();
        let label = html! {
            (row.variant.label)
            // A quick look does not run what long runs would be taken for.
            @if !chosen && row.cases > 0 && !report.quick {
                @if lasting { ", for the energy of " a href="#long" { "long runs" } }
                @else { " " span.fails { "never recommended" } }
            }
        };
        let count = |(n, _): (&usize, _)| match n {
            0 => Cell::number("·"),
            n => Cell::Number(html! { b { (n) } }),
        };
        let asked = |(_, goal): &(&usize, f64)| goals.contains(goal);
        let [kept, all] =
            [&row.kept, &row.all].map(|n| n.iter().zip(GOALS).filter(asked).map(count));
        let cells = [Cell::Text(label)].into_iter().chain(kept).chain(all);
        cells.chain([Cell::number(row.cases)]).collect()
    });
    html! {
        (table(
            "Motions for which the combination is the one to take, by accuracy; and the cases (a motion and an accuracy that is reached) \
             in which it was in the running.",
            &format!("combination|of those that keep the constraints: {each}|of all: {each}|cases"),
            rows,
        ))
        p { (OMITTED) }
    }
}

/// Whether the figures support the defaults.
pub(super) fn defaults(report: &Report) -> Markup {
    let kept = verdict::standing(&report.studies, Among::Kept);
    let rows: Vec<Vec<Cell>> = report.studies.iter().filter_map(default_row).collect();
    if kept.cases == 0 || rows.is_empty() {
        return html! {};
    }
    html! {
        p {
            (Variant::default().label) ": " (standing_words(&kept))
            @if let Some((ratio, name, goal)) = &kept.worst {
                " At worst it takes " (fixed(*ratio, 1)) " times the least time (" (name) ", " (power_of_ten(*goal)) ")."
            }
        }
        ul {
            @for line in argument::arguments(&report.studies) {
                li {
                    b { (line.default) } ": " (line.figures) " "
                    @if line.supported { span.holds { "supported" } } @else { span.fails { "not supported" } }
                }
            }
        }
        (table(
            "The default combination at the default tolerance, and a thousand times looser and tighter: scaled error, and change of the \
             time.",
            "motion | 10<sup>−9</sup>: error at the end; along the run; time | 10<sup>−6</sup>: error; time | 10<sup>−12</sup>: error; \
             time",
            rows,
        ))
    }
}

fn default_row(study: &Study) -> Option<Vec<Cell>> {
    let own = study.curve(Variant::default().name)?;
    let here = own.at(DEFAULT_TOLERANCE)?;
    let mut row = vec![
        name(study),
        claimed(study, here.error),
        claimed(study, here.error_along),
        Cell::number(duration(here.seconds)),
    ];
    for factor in [1e3, 1e-3] {
        let beside = own.at(factor * DEFAULT_TOLERANCE);
        row.push(Cell::or_missing(beside, |f| claimed(study, f.error)));
        row.push(Cell::or_missing(beside, |f| {
            percent(f.seconds / here.seconds)
        }));
    }
    Some(row)
}
