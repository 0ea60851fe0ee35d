//! The figures.

use std::iter::once;

use uktool::failure::Failure;
use uktool::html::fixed;
use uktool::plot::{COLOURS, Chart, Legend, Place, RGBColor, Series, round_range};

use super::chain::Chain;
use super::fish::{self, Fish};
use super::published::GRAVITY;

type Curve = Vec<(f64, f64)>;
/// The name of a fish in a legend.
type Label = fn(&Fish) -> String;

/// A whole page wide.
const WHOLE: (u32, u32) = (1000, 400);
/// The time of a whole run, s.
const WHOLE_RUN: (f64, f64) = (0.0, 10.0);
/// What the paper's figures of the fish show settles in this time, s; it turns over later.
const FISH_TIME: f64 = 5.0;
const TIME: &str = "time t (s)";
const TIP: &str = "tip acceleration ÿ1 (m/s²)";

/// A curve of each fish, with the label of its axis, and the place of the legend.
type Quantity = (&'static str, fn(&Fish) -> &Curve, Place);
const SPEED: Quantity = (
    "forward velocity −ẋ1 (m/s)",
    |f| &f.speed,
    Place::LowerRight,
);
const ACCELERATION: Quantity = (
    "acceleration ẍ1 (m/s²)",
    |f| &f.acceleration,
    Place::LowerMiddle,
);
const SWING: Quantity = ("swing angle θ1 (°)", |f| &f.swing, Place::UpperLeft);

/// All figures: file names without ending, and the text of the SVG.
pub(super) fn all(chains: &[Chain], fishes: &[Fish]) -> Result<Vec<(String, String)>, Failure> {
    let mut charts: Vec<(String, Chart)> = Vec::new();
    if let Some(first) = chains.first() {
        charts.push(("chain-falling".to_owned(), falling(first)));
    }
    charts.extend(tip_accelerations(chains));
    charts.push((
        "chain-accelerations".to_owned(),
        tip_accelerations_together(chains),
    ));
    charts.push(("chain-lead".to_owned(), lead(chains)));
    charts.push(("chain-fall".to_owned(), fall(chains)));
    charts.extend(by_amplitude(fishes));
    for (k, (name, _)) in SWEEPS.iter().enumerate() {
        let mut add = |kind: &str, quantity: Quantity| {
            let curves = sweep_curves(fishes, k, quantity.1);
            let chart = chart(quantity.0, (0.0, FISH_TIME), curves, quantity.2);
            charts.push((format!("fish-{name}-{kind}"), chart));
        };
        add("speed", SPEED);
        // Those of the amplitude are Figs. 13-16, in one range.
        if k > 0 {
            add("acceleration", ACCELERATION);
        }
        add("swing", SWING);
    }
    // The instability that the paper does not mention.
    let across = horizontal("across (90°)", 90.0, WHOLE_RUN);
    let zero = horizontal("", 0.0, WHOLE_RUN);
    for (name, level, (label, curve, place)) in [
        ("fish-turning", across, SWING),
        ("fish-turning-speed", zero, SPEED),
    ] {
        let series = once(level).chain(sweep_curves(fishes, 0, curve));
        let chart = chart(label, WHOLE_RUN, series, place);
        charts.push((
            name.to_owned(),
            Chart {
                size: WHOLE,
                ..chart
            },
        ));
    }
    charts
        .into_iter()
        .map(|(name, chart)| Ok((name, chart.svg()?)))
        .collect()
}

/// A chart over time whose vertical range holds all of its curves.
fn chart(
    y_label: &str,
    x: (f64, f64),
    series: impl IntoIterator<Item = Series>,
    place: Place,
) -> Chart {
    let mut series: Vec<Series> = series.into_iter().collect();
    // What lies outside of the horizontal range would still be written to the file.
    for curve in &mut series {
        curve.points.retain(|p| (x.0..=x.1).contains(&p.0));
    }
    Chart {
        legend: Legend::Within(place),
        ..Chart::new(TIME, y_label, x, series)
    }
}

/// The chain at several times, both axes of one scale.
fn falling(chain: &Chain) -> Chart {
    let last = chain.snapshots.len().saturating_sub(1);
    let mut series = vec![Series::reference("path of the tip", chain.path.clone())];
    for (k, (t, points)) in chain.snapshots.iter().enumerate() {
        let (colour, label) = if k == last {
            (COLOURS[1], format!("t = {} s: the turn", fixed(*t, 3)))
        } else {
            let part = k as f64 / last.max(1) as f64;
            (shade(part), format!("t = {} s", fixed(*t, 1)))
        };
        series.push(Series {
            colour,
            dots: 2,
            ..Series::new(label, 0, points.clone())
        });
    }
    // The legend stands inside of the first U, with some room above.
    let (x, depth, above) = ((-1.0, 13.5), 17.0, 1.4);
    // The axes' labels and margins take this much of the picture (see `plot`).
    let (frame_x, frame_y) = (92, 66);
    let width = 560;
    let height = frame_y + (f64::from(width - frame_x) * (depth + above) / (x.1 - x.0)) as u32;
    Chart {
        y: (depth, -above),
        legend: Legend::Within(Place::UpperMiddle),
        size: (width, height),
        ..Chart::new("x (m)", "y, downwards (m)", x, series)
    }
}

/// Light to dark blue.
fn shade(part: f64) -> RGBColor {
    let mix = |light: f64, dark: f64| (light + (dark - light) * part) as u8;
    RGBColor(mix(168.0, 3.0), mix(206.0, 40.0), mix(230.0, 90.0))
}

fn horizontal(label: &str, value: f64, (from, to): (f64, f64)) -> Series {
    Series::reference(label, vec![(from, value), (to, value)])
}

/// Figs. 2-6, all in the range of the deepest, so that they compare.
fn tip_accelerations(chains: &[Chain]) -> Vec<(String, Chart)> {
    let x = (0.0, 2.0);
    let points = chains.iter().flat_map(|c| &c.acceleration);
    let y = round_range(points.map(|p| p.1));
    chains
        .iter()
        .map(|c| {
            let label = format!("x0 = {} m", c.row.x0);
            let own = Series::new(label, 0, c.acceleration.clone());
            let chart = chart(TIP, x, [horizontal("g", GRAVITY, x), own], Place::LowerLeft);
            (format!("fig{}", c.row.paper.figure), Chart { y, ..chart })
        })
        .collect()
}

fn tip_accelerations_together(chains: &[Chain]) -> Chart {
    let x = (0.0, 1.9);
    let curves = of_each(chains, |c| c.acceleration.clone());
    let series = once(horizontal("g", GRAVITY, x)).chain(curves);
    // What the paper speaks of, accelerations above g, would be a thin line next to the peaks.
    let mut chart = chart(TIP, x, series, Place::LowerLeft);
    chart.y = (-30.0, 30.0);
    // Each up to where it first leaves the vertical range.
    for Series { points, .. } in &mut chart.series {
        let outside = points.iter().position(|(_, y)| y.abs() > 30.0);
        points.truncate(outside.unwrap_or(points.len()));
    }
    chart
}

/// Fall of the tip beyond that of a free body, up to the turn.
fn lead(chains: &[Chain]) -> Chart {
    let x = (0.0, 1.9);
    let lead = |(t, y)| (t, y - 0.5 * GRAVITY * t * t);
    let curves = of_each(chains, |c| before_turn(c).map(lead).collect());
    let series = once(horizontal("free fall", 0.0, x)).chain(curves);
    chart(
        "fall of the tip less ½ g t² (m)",
        x,
        series,
        Place::UpperLeft,
    )
}

fn fall(chains: &[Chain]) -> Chart {
    let times = (0..=190).map(|k| f64::from(k) * 0.01);
    let free = times.map(|t| (t, 0.5 * GRAVITY * t * t)).collect();
    let curves = of_each(chains, |c| before_turn(c).collect());
    let series = once(Series::reference("free fall, ½ g t²", free)).chain(curves);
    let label = "fall of the tip y1, downwards (m)";
    let chart = chart(label, (0.0, 1.9), series, Place::LowerLeft);
    Chart {
        y: (chart.y.1, chart.y.0),
        ..chart
    }
}

/// A curve of each chain, labelled with its initial separation.
fn of_each(chains: &[Chain], curve: impl Fn(&Chain) -> Curve) -> impl Iterator<Item = Series> {
    let chains = chains.iter().enumerate();
    chains.map(move |(k, c)| Series::new(format!("x0 = {} m", c.row.x0), k, curve(c)))
}

fn before_turn(chain: &Chain) -> impl Iterator<Item = (f64, f64)> {
    let t_max = chain.row.t_max;
    chain.fall.iter().copied().filter(move |(t, _)| *t <= t_max)
}

const SWEEPS: [(&str, Label); 3] = [
    ("amplitude", |f| format!("A3 = {}", f.row.a3)),
    ("frequency", |f| {
        format!("ω = {}π rad/s", f.row.gait.omega_pi)
    }),
    ("phase", |f| format!("φ = {}°", f.row.phi_deg)),
];

fn sweep_curves(fishes: &[Fish], k: usize, curve: fn(&Fish) -> &Curve) -> Vec<Series> {
    let fishes = fish::sweep(fishes, k, |f| &f.row).into_iter().enumerate();
    let series = fishes.map(|(i, f)| Series::new(SWEEPS[k].1(f), i, curve(f).clone()));
    series.collect()
}

/// Figs. 9-12 (forward velocity) and 13-16 (acceleration), each group in one range.
fn by_amplitude(fishes: &[Fish]) -> Vec<(String, Chart)> {
    let x = (0.0, FISH_TIME);
    let chosen = fish::sweep(fishes, 0, |f| &f.row);
    let mut charts = Vec::new();
    for (figure, (label, curve, place)) in [(9, SPEED), (13, ACCELERATION)] {
        let points = chosen.iter().flat_map(|f| curve(f));
        let y = round_range(points.filter(|p| p.0 <= x.1).map(|p| p.1));
        for (i, f) in chosen.iter().enumerate() {
            let series = [horizontal("", 0.0, x), Series::new("", 0, curve(f).clone())];
            let chart = Chart {
                y,
                legend: Legend::None,
                ..chart(label, x, series, place.clone())
            };
            charts.push((format!("fig{}", figure + i), chart));
        }
    }
    charts
}
