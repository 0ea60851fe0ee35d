//! The page.

use crate::html::{Cell, escape, figure, fixed, page, power_of_ten, table};

use super::Stability;
use super::case::{Class, Point, Row};

/// index.html.
pub(super) fn html(report: &Stability) -> String {
    let mut body = head(report);
    body.push_str(&figure(
        "stability.svg",
        "A bar for each case, coloured by outcome",
        "A bar is what a case sweeps, a cell a value of it; the dot marks the ordinary value. At the right the errors with which values are refused.",
    ));
    body.push_str(&summary(&report.cases));
    body.push_str(&improved(&report.cases));
    body.push_str("<h2 id=\"values\">3. Every value</h2>\n");
    for row in &report.cases {
        body.push_str(&values(row));
    }
    page("Stiff and extreme cases", &body)
}

fn head(report: &Stability) -> String {
    let count = |class| -> usize { report.cases.iter().map(|r| r.count(class)).sum() };
    format!(
        "<h1>Stiff and extreme cases</h1>\n\
         <p class=\"lead\">Each case sweeps one thing until it breaks.</p>\n\
         <p>Every result is compared with an oracle that does not share its way of computing. It is <b>accurate</b> if its error is within what the case \
         calls full accuracy, <b>degraded</b> if it is within the bound of the case, <b>refused</b> if the program says by a named error that it cannot do it. \
         A result that is off by more and looks like any other is <b>wrong</b>; there must be none. Here {} values are accurate, {} degraded, {} refused, \
         {} wrong. Errors are parts of the size of the result. Computing took {} s.</p>\n\
         <nav><a href=\"#cases\">Cases</a><a href=\"#improved\">Before and after</a><a href=\"#values\">Every value</a>\
         <a href=\"stability.json\">All numbers (JSON)</a><a href=\"stability.csv\">CSV</a></nav>\n",
        count(Class::Accurate),
        count(Class::Degraded),
        count(Class::Refused),
        count(Class::Wrong),
        fixed(report.seconds, 1)
    )
}

fn number(text: impl Into<String>) -> Cell {
    Cell::Number(text.into())
}

fn summary(rows: &[Row]) -> String {
    let cells: Vec<Vec<Cell>> = rows
        .iter()
        .map(|row| {
            let (effort, seconds) = row.total();
            vec![
                Cell::Text(format!(
                    "<a href=\"#{0}\">{0}</a><br><small>{1}</small>",
                    row.id,
                    escape(row.swept)
                )),
                Cell::Text(escape(&row.range_text(|c| c == Class::Accurate))),
                Cell::Text(escape(
                    &row.range_text(|c| c == Class::Accurate || c == Class::Degraded),
                )),
                number(power_of_ten(row.bound)),
                Cell::Text(beyond(row)),
                number(effort.evaluations.to_string()),
                number(effort.fallbacks.to_string()),
                number(fixed(seconds, 1)),
            ]
        })
        .collect();
    let html = table(
        "One row a case. Ranges reach from the ordinary value to the last one of the kind without a gap.",
        &[&[
            ("case", 1),
            ("full accuracy", 1),
            ("bounded error", 1),
            ("bound", 1),
            ("beyond", 1),
            ("evaluations", 1),
            ("fallbacks", 1),
            ("s", 1),
        ]],
        &cells,
    );
    format!("<h2 id=\"cases\">1. Cases</h2>\n{html}")
}

fn beyond(row: &Row) -> String {
    let mut words = row.refusals().join(", ");
    let wrong = row.count(Class::Wrong);
    if wrong > 0 {
        words.push_str(&format!(" <b class=\"fails\">{wrong} wrong</b>"));
    }
    words
}

/// What the program could not do before it was improved for a case.
fn improved(rows: &[Row]) -> String {
    let cells: Vec<Vec<Cell>> = rows
        .iter()
        .filter(|row| !row.before.is_empty())
        .map(|row| {
            vec![
                Cell::Text(row.id.to_owned()),
                Cell::Text(escape(row.before)),
                Cell::Text(format!(
                    "accurate: {}; within {}: {}",
                    escape(&row.range_text(|c| c == Class::Accurate)),
                    power_of_ten(row.bound),
                    escape(&row.range_text(|c| c == Class::Accurate || c == Class::Degraded))
                )),
            ]
        })
        .collect();
    let html = table(
        "What was found before is recorded here as it was measured; what is found now is computed.",
        &[&[("case", 1), ("before, and what was changed", 1), ("now", 1)]],
        &cells,
    );
    format!("<h2 id=\"improved\">2. Before and after</h2>\n{html}")
}

fn values(row: &Row) -> String {
    let cells: Vec<Vec<Cell>> = row.points.iter().map(value).collect();
    let html = table(
        &format!(
            "{}. Compared with: {}. Full accuracy: {}; bound: {}.",
            escape(row.swept),
            escape(row.oracle),
            power_of_ten(row.accurate_to),
            power_of_ten(row.bound)
        ),
        &[&[
            ("value", 1),
            ("outcome", 1),
            ("error", 1),
            ("steps", 1),
            ("evaluations", 1),
            ("fallbacks", 1),
            ("what was said", 1),
        ]],
        &cells,
    );
    format!("<h3 id=\"{0}\">{0}</h3>\n{html}", row.id)
}

fn value(p: &Point) -> Vec<Cell> {
    let class = match p.class {
        Class::Accurate => "verdict holds",
        Class::Degraded => "verdict nearly",
        Class::Refused => "verdict",
        Class::Wrong => "verdict fails",
    };
    let said = p.refusal.as_ref().map_or(String::new(), |(name, message)| {
        format!("{name}: {}", escape(message))
    });
    vec![
        Cell::Text(escape(&p.label)),
        Cell::Class(class, p.class.word().to_owned()),
        number(p.error.map_or("–".to_owned(), |e| {
            if e.is_finite() {
                power_of_ten(e)
            } else {
                "∞".to_owned()
            }
        })),
        number(p.effort.steps.to_string()),
        number(p.effort.evaluations.to_string()),
        number(p.effort.fallbacks.to_string()),
        Cell::Text(format!("<small>{said}</small>")),
    ]
}
