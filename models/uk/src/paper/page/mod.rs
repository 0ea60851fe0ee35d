//! The page.

mod chain;
mod fish;

use maud::{Markup, html};
use uktool::html::{Cell, Page, fixed, power_of_ten, table};

use super::Paper;
use super::claims::{STANDARD, Verdict};
use super::motion::RunRow;

pub(super) fn html(paper: &Paper<'_>) -> String {
    let page = Page {
        title: "The falling U-chain and the fish robot, recomputed",
        head: head(paper),
        files: &[("paper.json", "All numbers (JSON)")],
        sections: vec![
            (
                ["chain", "U-chain", "The falling U-chain"],
                chain::section(paper),
            ),
            (
                ["fish", "Fish robot", "The fish robot"],
                fish::section(paper),
            ),
            (["claims", "Claims", "The paper's claims"], claims(paper)),
            (
                ["accuracy", "Accuracy and cost", "Accuracy and cost"],
                accuracy(paper),
            ),
        ],
        foot: html! {},
    };
    page.render()
}

fn head(paper: &Paper<'_>) -> Markup {
    let off = paper.uchain.iter().map(|r| (r.h_max - r.paper.h_max).abs());
    let hold = |v| paper.claims.iter().filter(|c| c.verdict == v).count();
    html! {
        p.lead {
            "After Zhao H., Zhen S., Chen Y.-H.: Dynamic Modeling and Simulation of Multi-body Systems Using the Udwadia-Kalaba Theory. \
             Chinese Journal of Mechanical Engineering 26 (2013) 839-850."
        }
        p {
            "Both mechanisms are declared in a few lines of Rust; constraints are differentiated at compile time, and the equations of \
             Udwadia and Kalaba (regular mass matrix) or Udwadia and Phohomsiri (singular) are integrated with DOP853 at tolerance "
             (power_of_ten(paper.tolerance))
            ", with projection onto the constraints after each step. Table 1 is met to " (fixed(off.fold(0.0, f64::max), 4)) " m. Of "
            (paper.claims.len()) " claims of the paper " (hold(Verdict::Holds)) " are borne out, " (hold(Verdict::Nearly)) " nearly, "
            (hold(Verdict::Fails)) " not (" a href="#claims" { "each with its number" } ")."
        }
    }
}

fn claims(paper: &Paper<'_>) -> Markup {
    let of = |case: &'static str| {
        let claims = paper.claims.iter().filter(move |c| c.case == case);
        claims.map(|c| {
            let class = match c.verdict {
                Verdict::Holds => "verdict holds",
                Verdict::Nearly => "verdict nearly",
                Verdict::Fails => "verdict fails",
            };
            vec![
                Cell::Text(html! { (c.claim) " " small { "(§" (c.section) ")" } }),
                Cell::text(unbroken(&c.found)),
                Cell::Class(class, html! { (c.verdict.word()) }),
            ]
        })
    };
    html! {
        p { "Verdicts are computed from the numbers. " (STANDARD) " Lists are in the order of x0 = 12 … 16, or of the sweep." }
        @for (case, title) in [("uchain", "U-chain"), ("fish", "Fish robot")] {
            div.claims { (table(html! { b { (title) } }, "claim | found here | verdict", of(case))) }
        }
    }
}

/// Keeps units on the line of their number.
fn unbroken(text: &str) -> String {
    let units = [" %", " m", " s"];
    units.iter().fold(text.to_owned(), |text, unit| {
        text.replace(unit, &unit.replace(' ', "\u{a0}"))
    })
}

fn accuracy(paper: &Paper<'_>) -> Markup {
    let caption = html! {
        "All runs at tolerance " (power_of_ten(paper.tolerance)) ". Residuals are the largest at samples every 10 ms: |φ| of the \
         constraints as declared, |φ̇| of their rates. The energy drift is a part of the energy exchanged (the fish is driven and damped, \
         so it has none). Fallbacks are evaluations that left the fast formula."
    };
    let heads = "run | to (s) | ∣φ∣ | ∣φ̇∣ | energy drift | steps | rejected | evaluations | projections | fallbacks | time (s)";
    html! {
        (table(caption, heads, paper.runs.iter().map(|run| run_row(run))))
        p {
            "Computing and drawing took " (fixed(paper.seconds, 1)) " s in all. Samples of every run are in " a href="csv/" { "csv/" } ", \
             named as here."
        }
    }
}

fn run_row(r: &RunRow) -> Vec<Cell> {
    vec![
        Cell::text(&r.name),
        Cell::fixed(r.until, 0),
        Cell::power(r.drift.position_residual),
        Cell::power(r.drift.velocity_residual),
        Cell::or_missing(r.drift.energy_drift, Cell::power),
        Cell::number(r.steps),
        Cell::number(r.rejected),
        Cell::number(r.evaluations),
        Cell::number(r.projections),
        Cell::number(r.fallbacks),
        Cell::fixed(r.seconds, 2),
    ]
}
