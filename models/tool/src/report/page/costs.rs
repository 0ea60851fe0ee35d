//! What stabilisation costs, and where the errors come from.

use maud::{Markup, html};

use super::{claimed, name, percent};
use crate::html::{Cell, fixed, power_of_ten, table};
use crate::report::export::Report;
use crate::report::study::{Curve, Study};
use crate::report::variants::Variant;
use crate::report::verdict::{self, Price};

/// Goals at which the price of a stabilisation is told.
const MIDDLE: f64 = 1e-6;

pub(super) fn prices(report: &Report) -> Markup {
    let free = report.studies.iter();
    let free: Vec<&Study> = free.filter(|s| s.curve("dop853-none").is_some()).collect();
    if free.is_empty() {
        return html! {};
    }
    let caption = html! {
        "Projection beside none, both DOP853 at tolerance 10" sup { "−9" } ": change of the time, and factor on the error; how far the run \
         without ends off the constraints (scaled) and its largest residual. Baumgarte's feedback beside projection: change of the \
         evaluations to reach an error of "
        (power_of_ten(MIDDLE)) "; and of the time, which also pays for the lack of a straight line."
    };
    let heads = "motion | projection: time; error | none: off; residual | Baumgarte: 20/s, evaluations; 200/s; 20/s, time";
    table(caption, heads, free.into_iter().map(price_row))
}

fn price_row(study: &Study) -> Vec<Cell> {
    let projection = verdict::price_at(study, "dop853", "dop853-none", 1e-9);
    let free = study.curve("dop853-none").and_then(|c| c.at(1e-9));
    let reach = |own: &str, price: fn(Price) -> f64| {
        let found = verdict::price(study, own, "dop853", MIDDLE);
        Cell::or_missing(found, |p| percent(price(p)))
    };
    vec![
        name(study),
        Cell::or_missing(projection, |(p, _)| percent(p.time)),
        Cell::or_missing(projection, |(_, ratio)| {
            Cell::number(format!("× {}", fixed(ratio, 2)))
        }),
        Cell::or_missing(free.and_then(|f| f.off), Cell::power),
        Cell::or_missing(free, |f| {
            Cell::power(f.drift.position_residual.max(f.drift.velocity_residual))
        }),
        reach("dop853-baumgarte20", |p| p.evaluations),
        reach("dop853-baumgarte200", |p| p.evaluations),
        reach("dop853-baumgarte20", |p| p.time),
    ]
}

pub(super) fn causes(report: &Report) -> Markup {
    html! {
        (table(
            "All scaled at the end of the motion, but for rank and formula, which are relative changes of the accelerations.",
            "motion | integration: 10<sup>−6</sup>; 10<sup>−9</sup> | drift: 10<sup>−6</sup>; 10<sup>−9</sup> | solver: rank; formula | \
             rounding | least | reference",
            report.studies.iter().map(cause_row),
        ))
        p {
            b { "Integration" } " is what is left of the error at the end once the state is put back onto the constraints: the default \
             combination at two tolerances. " b { "Drift" } " is the way back, for the run without stabilisation; with projection it is \
             rounding. " b { "Rank" } " is the relative change of the accelerations at the states of the reference when the rank tolerance \
             is a thousand times smaller or larger; " b { "formula" } " their relative difference between the automatic choice and eq. 13 \
             or 19, both the work of rounding and of rank decisions. " b { "Rounding" } " is the change of the end when every number of \
             the start moves by ε = 2.2·10" sup { "−16" } " of its size: no integration in double precision can be relied on to do better, \
             and each step adds its own. " b { "Least" } " is the smallest error of the default combination at any tolerance."
        }
    }
}

fn cause_row(study: &Study) -> Vec<Cell> {
    let own = study.curve(Variant::default().name);
    let free = study.curve("dop853-none");
    let at = |curve: Option<&Curve>, knob: f64| curve.and_then(|c| c.at(knob)).copied();
    let within = |knob| at(own, knob).and_then(|f| f.within);
    let off = |knob| at(free, knob).and_then(|f| f.off);
    let errors = own
        .into_iter()
        .flat_map(|c| c.figures().map(|(_, f)| f.error));
    vec![
        name(study),
        Cell::or_missing(within(1e-6), |e| claimed(study, e)),
        Cell::or_missing(within(1e-9), |e| claimed(study, e)),
        Cell::or_missing(off(1e-6), Cell::power),
        Cell::or_missing(off(1e-9), Cell::power),
        Cell::or_missing(study.limits.rank, Cell::power),
        Cell::or_missing(study.limits.solve, Cell::power),
        Cell::or_missing(study.limits.rounding, Cell::power),
        Cell::or_missing(errors.min_by(f64::total_cmp), |e| claimed(study, e)),
        Cell::power(study.reference.floor),
    ]
}
