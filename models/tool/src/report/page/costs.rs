//! What stabilisation costs, and where the errors come from.

use super::{claimed, name, or_missing, percent, power};
use crate::html::{Cell, fixed, power_of_ten, table};
use crate::report::export::Report;
use crate::report::study::Curve;
use crate::report::variants::Variant;
use crate::report::verdict;

/// Goals at which the price of a stabilisation is told.
const MIDDLE: f64 = 1e-6;

/// What each stabilisation costs.
pub(super) fn prices(report: &Report) -> String {
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
pub(super) fn causes(report: &Report) -> String {
    let rows: Vec<Vec<Cell>> = report
        .studies
        .iter()
        .map(|study| {
            let own = study.curve(Variant::default().name);
            let free = study.curve("dop853-none");
            let at = |curve: Option<&Curve>, knob: f64| curve.and_then(|c| c.at(knob)).copied();
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
