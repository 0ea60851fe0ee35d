//! The page.

use std::fmt::Write;

use crate::html::{Cell, escape, figure, fixed, page, power_of_ten, table};
use crate::numbers;

use super::charts;
use super::export::Report;
use super::study::{Figures, Study};
use super::variants::{OMITTED, Variant, named};
use super::verdict::{self, Among, DEFAULT_TOLERANCE, GOALS, TIE};

/// index.html.
pub(super) fn html(report: &Report) -> String {
    let mut body = head(report);
    body.push_str(&choices(report));
    body.push_str(&tallied(report));
    body.push_str(&defaults(report));
    body.push_str(&prices(report));
    body.push_str(&causes(report));
    body.push_str("<h2 id=\"motions\">6. Motion by motion</h2>\n");
    for study in &report.studies {
        body.push_str(&motion(study));
    }
    body.push_str(&method(report));
    page("Error against run time", &body)
}

/// A time with its unit.
pub(super) fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1e-3 => (1e6 * s, "µs"),
        s if s < 1.0 => (1e3 * s, "ms"),
        s => (s, "s"),
    };
    let digits = if value < 10.0 {
        2
    } else if value < 100.0 {
        1
    } else {
        0
    };
    format!("{} {unit}", fixed(value, digits))
}

fn power(value: f64) -> Cell {
    Cell::Number(power_of_ten(value))
}

/// An error; where it lies below that of the reference, the latter as a bound.
fn claimed(study: &Study, error: f64) -> Cell {
    let text = power_of_ten(study.claimed(error));
    Cell::Number(if error <= study.reference.floor {
        format!("≤ {text}")
    } else {
        text
    })
}

fn missing() -> Cell {
    Cell::Number("–".to_owned())
}

fn or_missing<T>(value: Option<T>, cell: impl Fn(T) -> Cell) -> Cell {
    value.map_or_else(missing, cell)
}

/// A ratio as a change in per cent.
fn percent(ratio: f64) -> String {
    let change = 100.0 * (ratio - 1.0);
    if change.abs() >= 900.0 {
        return format!("× {}", fixed(ratio, 0));
    }
    format!(
        "{} %",
        crate::html::signed(change, if change.abs() < 10.0 { 1 } else { 0 })
    )
}

fn name(study: &Study) -> Cell {
    Cell::Text(format!(
        "<a href=\"#{}\">{}</a>",
        charts::file(study),
        escape(&study.name)
    ))
}

fn head(report: &Report) -> String {
    let kept = verdict::standing(&report.studies, Among::Kept);
    let mut html = String::from(
        "<h1>Error against run time</h1>\n\
         <p class=\"lead\">Each model under every sensible combination of method, formula for the accelerations and stabilisation.</p>\n",
    );
    if !report.complete {
        html.push_str(
            "<p class=\"note\"><b>This report is incomplete</b>: it was interrupted. The same command goes on from here.</p>\n",
        );
    }
    if report.quick {
        html.push_str(
            "<p class=\"note\">A quick look (<code>--quick</code>): few tolerances, each timed once. Times and verdicts are rough.</p>\n",
        );
    }
    if cfg!(debug_assertions) {
        html.push_str(
            "<p class=\"note\">Measured with a program that was built without optimisation: times and verdicts are not those of a release build.</p>\n",
        );
    }
    for (name, message) in &report.failures {
        let _ = writeln!(
            html,
            "<p class=\"note\">{} could not be measured: {}</p>",
            escape(name),
            escape(message)
        );
    }
    let _ = writeln!(
        html,
        "<p>The default of <code>Simulation</code>, {} at tolerance {} with the automatic formula, is {}</p>\n\
         <nav><a href=\"#choices\">What to take</a><a href=\"#tally\">How often</a><a href=\"#defaults\">The defaults</a><a href=\"#prices\">Stabilisation</a>\
         <a href=\"#causes\">Causes of error</a><a href=\"#motions\">Motions</a><a href=\"#method\">How it is measured</a><a href=\"report.json\">JSON</a>\
         <a href=\"report.csv\">CSV</a></nav>",
        escape(Variant::default().label),
        power_of_ten(DEFAULT_TOLERANCE),
        standing_words(&kept),
    );
    html
}

/// What to take for which accuracy, over all motions.
fn choices(report: &Report) -> String {
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
fn tallied(report: &Report) -> String {
    let goals: Vec<String> = GOALS.iter().map(|g| power_of_ten(*g)).collect();
    let mut heads = vec![("combination", 1)];
    for _ in [Among::Kept, Among::All] {
        heads.extend(goals.iter().map(|g| (g.as_str(), 1)));
    }
    heads.push(("cases", 1));
    let rows: Vec<Vec<Cell>> = verdict::tally(&report.studies)
        .into_iter()
        .map(|row| {
            let label = escape(row.variant.label);
            let all: usize = row.kept.iter().chain(&row.all).sum();
            let mut cells = vec![Cell::Text(if all == 0 && row.cases > 0 {
                format!("{label} <span class=\"fails\">never recommended</span>")
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
fn defaults(report: &Report) -> String {
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
    for line in verdict::arguments(&report.studies) {
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

/// How the default stands, in words, HTML.
fn standing_words(found: &verdict::Standing) -> String {
    let mut text = format!(
        "within {} % of the fastest combination that keeps the constraints in {} of {} (a motion and an accuracy).",
        fixed(100.0 * (TIE - 1.0), 0),
        found.best,
        numbers::count(found.cases, "case"),
    );
    if found.missed > 0 {
        let _ = write!(
            text,
            " In {} it does not reach the accuracy though another one does.",
            numbers::count(found.missed, "case")
        );
    }
    text
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

/// Goals at which the price of a stabilisation is told.
const MIDDLE: f64 = 1e-6;

/// What each stabilisation costs.
fn prices(report: &Report) -> String {
    let rows: Vec<Vec<Cell>> = report
        .studies
        .iter()
        .filter(|s| s.curve("dop853-none").is_some())
        .map(|study| {
            let at = |own: &str, other: &str| verdict::price_at(study, own, other, 1e-9);
            let time = |p: Option<(verdict::Price, f64)>| {
                or_missing(p, |(p, _)| Cell::Number(percent(p.time)))
            };
            let to_reach = |own: &str| {
                let price = verdict::price(study, own, "dop853", MIDDLE);
                or_missing(price, |p| Cell::Number(percent(p.evaluations)))
            };
            let free = study.curve("dop853-none").and_then(|c| c.at(1e-9));
            let projection = at("dop853", "dop853-none");
            vec![
                name(study),
                time(projection),
                or_missing(projection, |(_, ratio)| {
                    Cell::Number(format!("× {}", fixed(ratio, 2)))
                }),
                or_missing(free.and_then(|f| f.off), power),
                or_missing(free, |f| {
                    power(f.drift.position_residual.max(f.drift.velocity_residual))
                }),
                to_reach("dop853-baumgarte20"),
                to_reach("dop853-baumgarte200"),
                or_missing(
                    verdict::price(study, "dop853-baumgarte20", "dop853", MIDDLE),
                    |p| Cell::Number(percent(p.time)),
                ),
            ]
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    format!(
        "<h2 id=\"prices\">4. What stabilisation costs</h2>\n{}",
        table(
            &format!(
                "Projection beside none, both DOP853 at tolerance 10<sup>−9</sup>: change of the time, and factor on the error; how far the run without ends off \
                 the constraints (scaled) and its largest residual. Baumgarte's feedback beside projection: change of the evaluations to reach an error of {}; \
                 and of the time, which also pays for the lack of a straight line.",
                power_of_ten(MIDDLE)
            ),
            &[
                &[("", 1), ("projection", 2), ("none", 2), ("Baumgarte", 3)],
                &[
                    ("motion", 1),
                    ("time", 1),
                    ("error", 1),
                    ("off", 1),
                    ("residual", 1),
                    ("20/s, evaluations", 1),
                    ("200/s", 1),
                    ("20/s, time", 1),
                ],
            ],
            &rows
        )
    )
}

/// Where the errors come from.
fn causes(report: &Report) -> String {
    let rows: Vec<Vec<Cell>> = report
        .studies
        .iter()
        .map(|study| {
            let own = study.curve(Variant::default().name);
            let free = study.curve("dop853-none");
            let at = |curve: Option<&super::study::Curve>, knob: f64| {
                curve.and_then(|c| c.at(knob)).copied()
            };
            let least = own.and_then(|c| {
                let errors = c.figures().map(|(_, f)| f.error);
                errors.min_by(f64::total_cmp)
            });
            vec![
                name(study),
                or_missing(at(own, 1e-6).and_then(|f| f.within), |e| claimed(study, e)),
                or_missing(at(own, 1e-9).and_then(|f| f.within), |e| claimed(study, e)),
                or_missing(at(free, 1e-6).and_then(|f| f.off), power),
                or_missing(at(free, 1e-9).and_then(|f| f.off), power),
                or_missing(study.limits.rank, power),
                or_missing(study.limits.solve, power),
                or_missing(study.limits.rounding, power),
                or_missing(least, |e| claimed(study, e)),
                power(study.reference.floor),
            ]
        })
        .collect();
    format!(
        "<h2 id=\"causes\">5. Where the errors come from</h2>\n{}\
         <p><b>Integration</b> is what is left of the error at the end once the state is put back onto the constraints: the default combination at two tolerances. \
         <b>Drift</b> is the way back, for the run without stabilisation; with projection it is rounding. <b>Rank</b> is the relative change of the accelerations at the states of the \
         reference when the rank tolerance is a thousand times smaller or larger; <b>formula</b> their relative difference between the automatic choice and eq. 13 or 19, both the work of \
         rounding and of rank decisions. <b>Rounding</b> is the change of the end when every number of the start moves by ε = 2.2·10<sup>−16</sup> of its size: no integration in \
         double precision can be relied on to do better, and each step adds its own. <b>Least</b> is the smallest error of the default combination at any tolerance.</p>\n",
        table(
            "All scaled at the end of the motion, but for rank and formula, which are relative changes of the accelerations.",
            &[
                &[
                    ("", 1),
                    ("integration", 2),
                    ("drift", 2),
                    ("solver", 2),
                    ("", 3)
                ],
                &[
                    ("motion", 1),
                    ("10<sup>−6</sup>", 1),
                    ("10<sup>−9</sup>", 1),
                    ("10<sup>−6</sup>", 1),
                    ("10<sup>−9</sup>", 1),
                    ("rank", 1),
                    ("formula", 1),
                    ("rounding", 1),
                    ("least", 1),
                    ("reference", 1),
                ],
            ],
            &rows
        )
    )
}

fn motion(study: &Study) -> String {
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
            "The same by evaluations, which do not depend on the formula: methods and stabilisations alone."
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
                    row.push(Cell::Text(format!("<i>{}</i>", escape(failure))));
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

fn method(report: &Report) -> String {
    format!(
        "<h2 id=\"method\">7. How it is measured</h2>\n\
         <p>Times are {} of a whole run from the start to the end, with the making of the solver and without samples; the median of the repeats, which go round by round through all \
         combinations of a motion, so that what disturbs the machine for a while meets all alike. “±” is half the distance of the quartiles.</p>\n\
         <p>The <b>error</b> is the largest of all coordinates and velocities at the end, each divided by the largest value of its kind along the motion; the kind of a \
         coordinate is its name up to the first digit or bracket, so that x1, x2 and x[3] share their size. “Along” is the largest error over all times of the \
         reference, where states are interpolated by the method. report.json has the errors in units, too.</p>\n\
         <p>A verdict for an accuracy takes of each combination the loosest run from which on the error stays below it, as the next tighter run has to as well: luck does not count. \
         Between two runs it goes along a straight line of the logarithms.</p>\n\
         <p>References that are shipped with the models come from closed forms or from integrations with more digits. Where there is none, DOP853 at 10<sup>−14</sup> serves, started anew at each time; \
         its difference from DOPRI5 at 10<sup>−13</sup> is taken as its error. No error below that of the reference is claimed.</p>\n\
         <footer><p>Measured in {} s.</p></footer>\n",
        escape(&report.clock),
        fixed(report.seconds, 0)
    )
}
