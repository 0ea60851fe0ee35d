//! The page.

use maud::{Markup, html};

use super::Stability;
use super::case::{Class, Point, Row};
use crate::html::{Cell, Page, figure_of, fixed, message, power_of_ten, table};

pub(super) fn html(report: &Stability<'_>) -> String {
    let cases = html! { (picture()) (summary(&report.cases)) };
    let every = html! { @for row in &report.cases { (values(row)) } };
    let page = Page {
        title: "Stiff and extreme cases",
        head: head(report),
        files: &[
            ("stability.json", "All numbers (JSON)"),
            ("stability.csv", "CSV"),
        ],
        sections: vec![
            (["cases", "Cases", "Cases"], cases),
            (["values", "Every value", "Every value"], every),
        ],
        foot: html! {},
    };
    page.render()
}

fn head(report: &Stability<'_>) -> Markup {
    let [accurate, degraded, refused, wrong] = Class::ALL.map(|class| report.count(class));
    html! {
        p.lead {
            @if !report.subject.is_empty() { (message(report.subject)) ". " }
            "Each case sweeps one thing until it breaks."
        }
        @if !report.complete {
            p.note { b { "This page is incomplete" } ": the run was interrupted. It has the cases that were finished by then." }
        }
        p {
            "Every result is compared with an oracle that does not share its way of computing. It is " b { "accurate" }
            " if its error is within what the case calls full accuracy, " b { "degraded" } " if it is within the bound of the case, " b {
             "refused" }
            " if the program says by a named error that it cannot do it. A result that is off by more and looks like any other is " b {
             "wrong" }
            "; there must be none. Here " (accurate) " values are accurate, " (degraded) " degraded, " (refused) " refused, " (wrong)
            " wrong. Errors are parts of the size of the result. Computing took " (fixed(report.seconds, 1)) " s."
        }
    }
}

fn picture() -> Markup {
    figure_of(
        "wide",
        "stability.svg",
        "A bar for each case, coloured by outcome",
        "A bar is what a case sweeps, a cell a value of it; the dot marks the ordinary value. At the right the errors with which values \
         are refused.",
    )
}

fn summary(rows: &[Row<'_>]) -> Markup {
    let cells = rows.iter().map(|row| {
        let (effort, seconds) = row.total();
        let wrong = row.count(Class::Wrong);
        vec![
            Cell::Text(
                html! { a href=(format!("#{}", row.case.id)) { (row.case.id) } br; small { (row.case.swept) } },
            ),
            Cell::text(row.range_text(|c| c == Class::Accurate)),
            Cell::text(row.range_text(|c| c == Class::Accurate || c == Class::Degraded)),
            Cell::power(row.case.bound),
            Cell::Text(html! {
                (row.refusals().join(", "))
                @if wrong > 0 { " " b.fails { (wrong) " wrong" } }
            }),
            Cell::number(effort.evaluations),
            Cell::number(effort.fallbacks),
            Cell::fixed(seconds, 1),
        ]
    });
    table(
        "One row a case. Ranges reach from the ordinary value to the last one of the kind without a gap.",
        "case | full accuracy | bounded error | bound | beyond | evaluations | fallbacks | s",
        cells,
    )
}

fn values(row: &Row<'_>) -> Markup {
    let caption = html! {
        (row.case.swept) ". Compared with: " (row.case.oracle) ". Full accuracy: " (power_of_ten(row.case.accurate)) "; bound: "
         (power_of_ten(row.case.bound)) "."
    };
    let heads = "value | outcome | error | steps | evaluations | fallbacks | what was said";
    html! {
        h3 id=(row.case.id) { (row.case.id) }
        (table(caption, heads, row.points.iter().map(value)))
    }
}

fn value(p: &Point) -> Vec<Cell> {
    let class = match p.class {
        Class::Accurate => "verdict holds",
        Class::Degraded => "verdict nearly",
        Class::Refused => "verdict",
        Class::Wrong => "verdict fails",
    };
    vec![
        Cell::text(&p.label),
        Cell::Class(class, html! { (p.class.word()) }),
        Cell::or_missing(p.error, Cell::power),
        Cell::number(p.effort.steps),
        Cell::number(p.effort.evaluations),
        Cell::number(p.effort.fallbacks),
        Cell::or_missing(p.refusal.as_ref(), |(name, text)| {
            Cell::Class("said", html! { (name) ": " (message(text)) })
        }),
    ]
}
