//! The page.

mod chain;
mod fish;

use crate::html::{Cell, escape, fixed, page, power_of_ten, table};

use super::Paper;
use super::claims::{Claim, Verdict};
use super::motion::RunRow;

/// index.html.
pub(super) fn html(paper: &Paper) -> String {
    let mut body = head(paper);
    body.push_str(&chain::section(paper));
    body.push_str(&fish::section(paper));
    body.push_str(&claims_section(&paper.claims));
    body.push_str(&accuracy(paper));
    page("Zhao, Zhen & Chen 2013, recomputed", &body)
}

fn number(value: f64, digits: usize) -> Cell {
    Cell::Number(fixed(value, digits))
}

fn count(value: usize) -> Cell {
    Cell::Number(value.to_string())
}

fn head(paper: &Paper) -> String {
    let worst = paper
        .uchain
        .iter()
        .map(|r| (r.h_max - r.paper.h_max).abs())
        .fold(0.0, f64::max);
    let hold = |v| paper.claims.iter().filter(|c| c.verdict == v).count();
    format!(
        "<h1>The falling U-chain and the fish robot, recomputed</h1>\n\
         <p class=\"lead\">After Zhao H., Zhen S., Chen Y.-H.: Dynamic Modeling and Simulation of Multi-body Systems Using the \
         Udwadia-Kalaba Theory. Chinese Journal of Mechanical Engineering 26 (2013) 839-850.</p>\n\
         <p>Both mechanisms are declared in a few lines of Rust; constraints are differentiated at compile time, and the equations of \
         Udwadia and Kalaba (regular mass matrix) or Udwadia and Phohomsiri (singular) are integrated with DOP853 at tolerance {}, with \
         projection onto the constraints after each step. Table 1 is met to {} m. Of {} claims of the paper \
         {} are borne out, {} nearly, {} not (<a href=\"#claims\">each with its number</a>).</p>\n\
         <nav><a href=\"#chain\">U-chain</a><a href=\"#fish\">Fish robot</a><a href=\"#claims\">Claims</a>\
         <a href=\"#accuracy\">Accuracy and cost</a><a href=\"paper.json\">All numbers (JSON)</a></nav>\n",
        power_of_ten(paper.tolerance),
        fixed(worst, 4),
        paper.claims.len(),
        hold(Verdict::Holds),
        hold(Verdict::Nearly),
        hold(Verdict::Fails),
    )
}

fn claims_section(claims: &[Claim]) -> String {
    let mut html = String::from(
        "<h2 id=\"claims\">3. The paper's claims</h2>\n<p>Verdicts are computed from the numbers. “Nearly” means that a stated bound is missed by less than a \
         tenth of it. Lists are in the order of x0 = 12 … 16, or of the sweep.</p>\n",
    );
    for (case, title) in [("uchain", "U-chain"), ("fish", "Fish robot")] {
        let rows: Vec<Vec<Cell>> = claims
            .iter()
            .filter(|c| c.case == case)
            .map(|c| {
                let class = match c.verdict {
                    Verdict::Holds => "verdict holds",
                    Verdict::Nearly => "verdict nearly",
                    Verdict::Fails => "verdict fails",
                };
                vec![
                    Cell::Text(format!(
                        "{} <small>(§{})</small>",
                        escape(c.claim),
                        escape(c.section)
                    )),
                    Cell::Text(unbroken(&escape(&c.found))),
                    Cell::Class(class, c.verdict.word().to_owned()),
                ]
            })
            .collect();
        let html_table = table(
            &format!("<b>{title}</b>"),
            &[&[("claim", 1), ("found here", 1), ("verdict", 1)]],
            &rows,
        );
        html.push_str(&html_table.replacen("<table>", "<table class=\"claims\">", 1));
    }
    html
}

/// Keeps units on the line of their number.
fn unbroken(text: &str) -> String {
    [" %", " m", " s"]
        .iter()
        .fold(text.to_owned(), |text, unit| {
            text.replace(unit, &unit.replace(' ', "&nbsp;"))
        })
}

fn accuracy(paper: &Paper) -> String {
    let rows: Vec<Vec<Cell>> = paper.runs.iter().map(run_row).collect();
    let mut html = String::from("<h2 id=\"accuracy\">4. Accuracy and cost</h2>\n");
    html.push_str(&table(
        &format!(
            "All runs at tolerance {}. Residuals are the largest at samples every 10 ms: |φ| of the constraints as declared, |φ̇| of their rates. The energy drift is \
             a part of the energy exchanged (the fish is driven and damped, so it has none). Fallbacks are evaluations that left the fast formula.",
            power_of_ten(paper.tolerance)
        ),
        &[&[
            ("run", 1),
            ("to (s)", 1),
            ("|φ|", 1),
            ("|φ̇|", 1),
            ("energy drift", 1),
            ("steps", 1),
            ("rejected", 1),
            ("evaluations", 1),
            ("projections", 1),
            ("fallbacks", 1),
            ("time (s)", 1),
        ]],
        &rows,
    ));
    html.push_str(&format!(
        "<p>Computing and drawing took {} s in all. Samples of every run are in <a href=\"csv/\">csv/</a>, named as here.</p>\n",
        fixed(paper.seconds, 1)
    ));
    html
}

fn run_row(r: &RunRow) -> Vec<Cell> {
    let power = |value: f64| Cell::Number(power_of_ten(value));
    vec![
        Cell::Text(escape(&r.name)),
        number(r.until, 0),
        power(r.drift.position_residual),
        power(r.drift.velocity_residual),
        r.drift
            .energy_drift
            .map_or_else(|| Cell::Number("–".to_owned()), power),
        count(r.steps),
        count(r.rejected),
        count(r.evaluations),
        count(r.projections),
        count(r.fallbacks),
        number(r.seconds, 2),
    ]
}
