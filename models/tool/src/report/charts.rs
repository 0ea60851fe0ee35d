//! The pictures of a motion: error against time, and against evaluations.

use crate::failure::Failure;
use crate::plot::{Chart, GREY, Legend, RGBColor, Scale, Series, decade_range};

use super::study::{Curve, Figures, Study};
use super::variants::{Variant, named};

const SIZE: (u32, u32) = (530, 470);

/// Combinations that are told apart in both pictures, and in one of them; the rest is thin and grey.
const IN_BOTH: [&str; 4] = ["dop853", "dopri5", "radau5", "rattle"];
const BY_TIME: [&str; 2] = ["dop853-general", "dop853-kkt"];
const BY_EVALUATIONS: [&str; 2] = ["dop853-none", "dop853-baumgarte20"];

/// The two pictures of a motion: file names without ending, and SVG.
pub(super) fn of(study: &Study) -> Result<[(String, String); 2], Failure> {
    let time = chart(study, &BY_TIME, TIME, |f| f.seconds);
    let evaluations = chart(study, &BY_EVALUATIONS, EVALUATIONS, |f| {
        f.evaluations as f64
    });
    Ok([
        (format!("{}-time", file(study)), time.svg()?),
        (format!("{}-evaluations", file(study)), evaluations.svg()?),
    ])
}

/// The name of a motion in file names.
pub(super) fn file(study: &Study) -> String {
    study.name.replace([' ', '.'], "-")
}

const TIME: &str = "time of the run (s)";
const EVALUATIONS: &str = "evaluations of the accelerations";

fn chart(study: &Study, own: &[&str], x_label: &str, across: fn(&Figures) -> f64) -> Chart {
    let shown = [&IN_BOTH, own].concat();
    let place = |f: &Figures| (across(f), study.claimed(f.error));
    let mut series: Vec<Series> = study
        .curves
        .iter()
        .filter(|c| !shown.contains(&c.variant.as_str()))
        .map(|c| Series {
            colour: LIGHT,
            width: 1,
            ..line(study, c, "", 0, &place)
        })
        .collect();
    if let Some(rest) = series.first_mut() {
        rest.label = "the others".to_owned();
    }
    // The default on top of all, and first in the legend.
    for (index, name) in shown.iter().enumerate().rev() {
        let (Some(curve), Some(variant)) = (study.curve(name), named(name)) else {
            continue;
        };
        let is_default = *name == Variant::default().name;
        let label = if is_default {
            format!("{} (the default)", variant.label)
        } else {
            variant.label.to_owned()
        };
        series.push(Series {
            width: if is_default { 3 } else { 2 },
            dots: if is_default { 4 } else { 3 },
            ..line(study, curve, &label, index, &place)
        });
    }
    let points = || series.iter().flat_map(|s| s.points.iter().copied());
    let x = decade_range(points().map(|p| p.0));
    let floor = study.reference.floor;
    let y = decade_range(points().map(|p| p.1).chain([floor]));
    series.insert(
        0,
        Series {
            colour: GREY,
            ..Series::reference("error of the reference", vec![(x.0, floor), (x.1, floor)])
        },
    );
    Chart {
        y,
        scale: Scale::Decades,
        legend: Legend::Above,
        size: SIZE,
        ..Chart::new(x_label, "error at the end, scaled", x, series)
    }
}

/// Errors above are not drawn: ten times the size of the motion is far off, and a hundred times says nothing more.
const USELESS: f64 = 10.0;

/// Curves in the background.
const LIGHT: RGBColor = RGBColor(190, 190, 190);

fn line(
    study: &Study,
    curve: &Curve,
    label: &str,
    index: usize,
    place: &dyn Fn(&Figures) -> (f64, f64),
) -> Series {
    let useful = |f: &&Figures| f.error <= USELESS;
    let figures = || curve.figures().map(|(_, f)| f).filter(useful);
    let at_the_floor = |f: &&Figures| f.error <= study.reference.floor;
    let points = figures().map(place).collect();
    let rings = figures().filter(at_the_floor).map(place).collect();
    Series {
        rings,
        ..Series::new(label, index, points)
    }
}
