//! Line charts as SVG text.
//!
//! The text of an SVG is set by whoever shows it, so no font is needed here; the drawing library's estimate of text widths is enough.
//!
//! ```
//! use uktool::plot::{Chart, Series, round_range};
//!
//! let fall: Vec<(f64, f64)> = (0..=20).map(|k| 0.1 * f64::from(k)).map(|t| (t, 4.9 * t * t)).collect();
//! let chart = Chart {
//!     y: round_range(fall.iter().map(|p| p.1)),
//!     ..Chart::new("time (s)", "fall (m)", (0.0, 2.0), vec![Series::new("free fall", 0, fall)])
//! };
//! assert!(chart.svg()?.starts_with("<svg "));
//! # Ok::<(), uktool::failure::Failure>(())
//! ```

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::combinators::{LogCoord, WithKeyPoints};
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub use plotters::chart::SeriesLabelPosition as Place;
pub use plotters::style::RGBColor;

use crate::failure::Failure;
use crate::numbers::extremes;

/// Okabe and Ito's palette, told apart with every common colour vision; the order puts strong contrasts first.
pub const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];
/// The colour of curves to compare with, as those of a free fall.
pub const GREY: RGBColor = RGBColor(120, 120, 120);

const FONT: &str = "Helvetica, Arial, sans-serif";
const LABEL_SIZE: u32 = 15;
const TICK_SIZE: u32 = 13;
/// The drawing library knows whole numbers alone: charts are drawn in so many parts of a pixel.
const PARTS: u32 = 10;
/// Room around the frame, on its right, and for the labels below and beside it, in pixels.
const MARGIN: u32 = 10;
const RIGHT: u32 = 18;
const BELOW: u32 = 46;
const BESIDE: u32 = 64;
/// Height of a row of a legend above the frame.
const ROW: u32 = 18;
const GRID: RGBColor = RGBColor(226, 226, 226);
const FRAME: RGBColor = RGBColor(90, 90, 90);

/// A curve of a chart: points joined by a line, with an entry in the legend.
#[derive(Debug, Clone)]
pub struct Series {
    /// The curve's text in the legend; no entry if empty.
    pub label: String,
    /// The points of the curve, in order.
    pub points: Vec<(f64, f64)>,
    /// The colour of the curve.
    pub colour: RGBColor,
    /// The width of the curve in pixels.
    pub width: u32,
    /// Whether the curve is dashed.
    pub dashed: bool,
    /// Radius of a dot at each point in pixels; 0 for none.
    pub dots: u32,
    /// Points with a ring instead of a dot.
    pub rings: Vec<(f64, f64)>,
}

impl Series {
    /// A plain curve in the colour number `index` of [`COLOURS`].
    pub fn new(label: impl Into<String>, index: usize, points: Vec<(f64, f64)>) -> Self {
        Series {
            label: label.into(),
            points,
            colour: COLOURS[index % COLOURS.len()],
            width: 2,
            dashed: false,
            dots: 0,
            rings: Vec::new(),
        }
    }

    /// A dashed grey curve to compare with.
    pub fn reference(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Series {
            colour: GREY,
            width: 1,
            dashed: true,
            ..Series::new(label, 0, points)
        }
    }
}

/// The place of the legend of a [`Chart`].
#[derive(Debug, Clone, PartialEq)]
pub enum Legend {
    /// There is no legend.
    None,
    /// The legend stands above the frame, in two columns.
    Above,
    /// The legend stands within the frame, at this place.
    Within(Place),
}

/// The division of both axes of a [`Chart`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal distances are equal differences.
    Linear,
    /// Equal distances are equal ratios, on both axes; ticks at whole powers of ten. All numbers are positive.
    Decades,
}

/// A chart of curves in one frame, with labelled axes and a legend.
#[derive(Debug, Clone)]
pub struct Chart {
    /// Label of the horizontal axis, with its unit.
    pub x_label: String,
    /// Label of the vertical axis, with its unit.
    pub y_label: String,
    /// Horizontal range, from left to right.
    pub x: (f64, f64),
    /// Vertical range, from bottom to top; a larger first value makes the axis point down.
    pub y: (f64, f64),
    /// The curves; later ones lie on top.
    pub series: Vec<Series>,
    /// Division of both axes.
    pub scale: Scale,
    /// Place of the legend.
    pub legend: Legend,
    /// Width and height in pixels.
    pub size: (u32, u32),
}

impl Chart {
    /// A chart with linear axes, the vertical one round about the curves, half a page wide, and a legend in the lower right corner.
    pub fn new(
        x_label: impl Into<String>,
        y_label: impl Into<String>,
        x: (f64, f64),
        series: Vec<Series>,
    ) -> Self {
        Chart {
            x_label: x_label.into(),
            y_label: y_label.into(),
            x,
            y: round_range(series.iter().flat_map(|s| s.points.iter().map(|p| p.1))),
            series,
            scale: Scale::Linear,
            legend: Legend::Within(Place::LowerRight),
            size: (560, 360),
        }
    }

    /// Draws the chart as the text of an SVG file.
    ///
    /// # Errors
    /// [`Failure::Failed`] if the drawing library fails.
    pub fn svg(&self) -> Result<String, Failure> {
        svg(self.size, PARTS, |area| self.draw(area))
    }

    /// The chart with the shorter range widened about its middle, so that a distance is as long along either axis; as it is where one goes
    /// farther than twenty times the other, of which nothing would be seen.
    #[must_use]
    pub(crate) fn drawn_to_scale(self) -> Self {
        let legend = match self.legend {
            Legend::Above => legend_height(self.named().count()),
            _ => 0,
        };
        let width = self.size.0 - MARGIN - RIGHT - BESIDE;
        let height = self.size.1 - legend - 2 * MARGIN - BELOW;
        let [(left, right), (bottom, top)] = [self.x, self.y];
        let [across, up] = [right - left, top - bottom];
        if across.abs().max(up.abs()) > 20.0 * across.abs().min(up.abs()) {
            return self;
        }
        let pixel = (across.abs() / f64::from(width)).max(up.abs() / f64::from(height));
        let wider = |from: f64, way: f64, pixels: u32| {
            let (middle, half) = (from + 0.5 * way, 0.5 * pixel * f64::from(pixels));
            (middle - half * way.signum(), middle + half * way.signum())
        };
        Chart {
            x: wider(left, across, width),
            y: wider(bottom, up, height),
            ..self
        }
    }

    /// The curves that the legend names; what lies on top comes first.
    fn named(&self) -> impl Iterator<Item = &Series> {
        self.series.iter().rev().filter(|s| !s.label.is_empty())
    }

    fn draw<'a>(&self, area: &Area<'a>) -> Result<(), DrawError<'a>> {
        let (x, y) = (self.x.0..self.x.1, self.y.0..self.y.1);
        match self.scale {
            Scale::Linear => self.draw_on(area, x, y, tick),
            Scale::Decades => self.draw_on(area, powers(&x), powers(&y), power),
        }
    }

    fn draw_on<'a, X, Y>(
        &self,
        area: &Area<'a>,
        x: X,
        y: Y,
        tick: fn(f64) -> String,
    ) -> Result<(), DrawError<'a>>
    where
        X: AsRangedCoord<Value = f64>,
        Y: AsRangedCoord<Value = f64>,
        X::CoordDescType: ValueFormatter<f64>,
        Y::CoordDescType: ValueFormatter<f64>,
    {
        area.fill(&WHITE)?;
        let frame = self.draw_legend_above(area)?;
        let area = frame.as_ref().unwrap_or(area);
        let mut chart = ChartBuilder::on(area)
            .margin(MARGIN * PARTS)
            .margin_right(RIGHT * PARTS)
            .x_label_area_size(BELOW * PARTS)
            .y_label_area_size(BESIDE * PARTS)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID.stroke_width(PARTS))
            .axis_style(FRAME.stroke_width(PARTS))
            .set_all_tick_mark_size(5 * PARTS)
            .label_style((FONT, TICK_SIZE * PARTS))
            .axis_desc_style((FONT, LABEL_SIZE * PARTS))
            .x_desc(self.x_label.as_str())
            .y_desc(self.y_label.as_str())
            .x_label_formatter(&|v| tick(*v))
            .y_label_formatter(&|v| tick(*v))
            .x_labels(8)
            .y_labels(8)
            .draw()?;
        for series in &self.series {
            draw_series(&mut chart, series)?;
        }
        let Legend::Within(place) = &self.legend else {
            return Ok(());
        };
        chart
            .configure_series_labels()
            .position(place.clone())
            .margin(8 * PARTS)
            .legend_area_size(30 * PARTS)
            .background_style(WHITE.mix(0.85))
            .label_font((FONT, TICK_SIZE * PARTS))
            .draw()
    }
}

/// The height of a legend above the frame with so many entries, in pixels.
pub(crate) fn legend_height(entries: usize) -> u32 {
    8 + ROW * entries.div_ceil(2) as u32
}

/// Draws charts of one width, one below the other, as the text of an SVG file.
///
/// # Errors
/// [`Failure::Failed`] if the drawing library fails.
pub fn stacked(charts: &[Chart]) -> Result<String, Failure> {
    let width = charts.iter().map(|chart| chart.size.0).max();
    let height = charts.iter().map(|chart| chart.size.1).sum();
    svg((width.unwrap_or(0), height), PARTS, |area| {
        let mut rest = area.clone();
        for chart in charts {
            let (panel, below) = rest.split_vertically(chart.size.1 * PARTS);
            chart.draw(&panel)?;
            rest = below;
        }
        Ok(())
    })
}

impl Chart {
    /// The legend, if it stands above the frame; what is left of the area for the frame then.
    fn draw_legend_above<'a>(&self, area: &Area<'a>) -> Result<Option<Area<'a>>, DrawError<'a>> {
        if self.legend != Legend::Above {
            return Ok(None);
        }
        let named = || self.named();
        let rows = named().count().div_ceil(2);
        let (legend, frame) = area.split_vertically(legend_height(named().count()) * PARTS);
        let column = self.size.0 as i32 / 2 - 10;
        let at = |x: i32, y: i32| (x * PARTS as i32, y * PARTS as i32);
        for (k, series) in named().enumerate() {
            let (x, y) = (
                16 + column * (k / rows) as i32,
                8 + (ROW / 2 + ROW * (k % rows) as u32) as i32,
            );
            let style = series.colour.stroke_width(series.width * PARTS);
            let dashes: &[(i32, i32)] = if series.dashed {
                &[(0, 9), (17, 26)]
            } else {
                &[(0, 26)]
            };
            for (from, to) in dashes {
                legend.draw(&PathElement::new([at(x + from, y), at(x + to, y)], style))?;
            }
            if series.dots > 0 {
                let size = series.dots * PARTS;
                legend.draw(&Circle::new(at(x + 13, y), size, series.colour.filled()))?;
            }
            let size = TICK_SIZE * PARTS;
            write(&legend, at(x + 34, y), HPos::Left, size, &series.label)?;
        }
        Ok(Some(frame))
    }
}

pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(crate) type DrawError<'a> = DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>;

/// Writes `text` that begins, ends or has its middle at `place`, as `side` says.
pub(crate) fn write<'a>(
    area: &Area<'a>,
    place: (i32, i32),
    side: HPos,
    size: u32,
    text: &str,
) -> Result<(), DrawError<'a>> {
    let style = (FONT, size).into_text_style(area);
    let style = style.pos(Pos::new(side, VPos::Center));
    area.draw(&Text::new(text, place, style))
}

/// What `draw` draws on an area of this size in pixels, in so many `parts` of them, as the text of an SVG file with a view box, so that a
/// page can scale it.
pub(crate) fn svg(
    size: (u32, u32),
    parts: u32,
    draw: impl for<'a> FnOnce(&Area<'a>) -> Result<(), DrawError<'a>>,
) -> Result<String, Failure> {
    let mut text = String::new();
    {
        let fine = (size.0 * parts, size.1 * parts);
        let area = SVGBackend::with_string(&mut text, fine).into_drawing_area();
        draw(&area)
            .and_then(|()| area.present())
            .map_err(|e| Failure::Failed(format!("cannot draw a figure: {e}")))?;
    }
    let (_, body) = text.split_once('>').unwrap_or_default();
    Ok(format!(
        "<svg width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\">{body}",
        size.0,
        size.1,
        size.0 * parts,
        size.1 * parts,
    ))
}

fn draw_series<'a, X: Ranged<ValueType = f64>, Y: Ranged<ValueType = f64>>(
    chart: &mut ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>,
    series: &Series,
) -> Result<(), DrawError<'a>> {
    let style = series.colour.stroke_width(series.width * PARTS);
    let points = series.points.iter().copied();
    let annotation = if series.dashed {
        chart.draw_series(DashedLineSeries::new(points, 6 * PARTS, 4 * PARTS, style))?
    } else {
        chart.draw_series(LineSeries::new(points, style))?
    };
    if !series.label.is_empty() {
        let dashed = series.dashed;
        annotation
            .label(series.label.as_str())
            .legend(move |(x, y)| {
                let gap = if dashed { 3 } else { 0 };
                let line = |from: i32, to: i32| {
                    let along = |x: i32| (x * PARTS as i32, 0);
                    PathElement::new(vec![along(from), along(to)], style)
                };
                EmptyElement::at((x, y)) + line(0, 11 - gap) + line(11 + gap, 22)
            });
    }
    if series.dots > 0 {
        chart.draw_series(
            series
                .points
                .iter()
                .filter(|p| !series.rings.contains(p))
                .map(|p| Circle::new(*p, series.dots * PARTS, series.colour.filled())),
        )?;
    }
    let ring = |p: &(f64, f64)| Circle::new(*p, (series.dots.max(2) + 1) * PARTS, style);
    chart.draw_series(series.rings.iter().map(ring))?;
    Ok(())
}

/// A tick's number: shortest form, with a minus sign, and no "-0".
fn tick(value: f64) -> String {
    // Ticks are multiples of a power of ten; what is below a millionth of it is rounding.
    let rounded = (value * 1e6).round() / 1e6;
    if rounded == 0.0 {
        return "0".to_owned();
    }
    rounded.to_string().replace('-', "−")
}

/// An axis of powers of ten, with ticks at whole ones.
fn powers(range: &Range<f64>) -> WithKeyPoints<LogCoord<f64>> {
    let ticks = decades(range.start.log10(), range.end.log10()).into_iter();
    let ticks: Vec<f64> = ticks.map(|exponent| 10_f64.powf(exponent)).collect();
    let axis = range.clone().log_scale().with_key_points(ticks.clone());
    axis.with_light_points(ticks)
}

/// The whole powers of ten between two exponents, at most twelve of them.
fn decades(low: f64, high: f64) -> Vec<f64> {
    let (first, last) = (low.ceil() as i32, high.floor() as i32);
    let stride = ((last - first) / 12 + 1).max(1) as usize;
    (first..=last).step_by(stride).map(f64::from).collect()
}

/// A whole power of ten.
fn power(value: f64) -> String {
    let raised = |c: char| {
        "-0123456789"
            .find(c)
            .and_then(|k| "⁻⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(k))
    };
    let exponent = format!("{:.0}", value.log10().round());
    format!(
        "10{}",
        exponent.chars().filter_map(raised).collect::<String>()
    )
}

/// The smallest range of whole decades that holds all of `values` that are positive.
pub fn decade_range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let values = values.filter(|v| *v > 0.0 && v.is_finite());
    let (low, high) = extremes(values.map(f64::log10));
    if low > high {
        return (0.1, 1.0);
    }
    let (low, high) = (low.floor(), high.ceil());
    let high = if high > low { high } else { low + 1.0 };
    (10_f64.powf(low), 10_f64.powf(high))
}

/// The smallest range of round numbers (1, 2 or 5 times a power of ten) that holds all of `values`.
pub fn round_range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = extremes(values.filter(|v| v.is_finite()));
    if low > high {
        return (0.0, 1.0);
    }
    let span = if high > low {
        high - low
    } else {
        high.abs().max(1.0)
    };
    let step = round_step(span / 10.0);
    let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
    (low, if high > low { high } else { low + step })
}

fn round_step(at_least: f64) -> f64 {
    let power = 10.0_f64.powf(at_least.log10().floor());
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|f| f * power >= at_least)
        .unwrap_or(10.0);
    factor * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_round_and_hold_the_values() {
        assert_eq!(round_range([-336.6, 24.1].into_iter()), (-350.0, 50.0));
        assert_eq!(round_range([3.0, 3.0].into_iter()), (3.0, 3.5));
        assert_eq!(round_range(std::iter::empty()), (0.0, 1.0));
        assert_eq!(round_range([0.0, f64::NAN, 0.0].into_iter()), (0.0, 0.1));
        let (low, high) = round_range([0.013, 0.0994].into_iter());
        assert!(low <= 0.013 && (0.0994..0.12).contains(&high));
    }

    #[test]
    fn ticks_read_well() {
        assert_eq!(tick(-0.30000000000000004), "−0.3");
        assert_eq!(tick(-0.0), "0");
        assert_eq!(tick(250.0), "250");
    }

    #[test]
    fn decades_are_whole() {
        assert_eq!(power(1e-13), "10⁻¹³");
        assert_eq!(power(1.0), "10⁰");
        assert_eq!(power(1e4), "10⁴");
        assert_eq!(decades(-3.2, 1.0), [-3.0, -2.0, -1.0, 0.0, 1.0]);
        assert!(decades(-300.0, 300.0).len() <= 13);
        let (low, high) = decade_range([3e-7, 0.0, 2.0, f64::NAN].into_iter());
        assert!((low / 1e-7 - 1.0).abs() < 1e-12 && (high / 10.0 - 1.0).abs() < 1e-12);
        assert_eq!(decade_range(std::iter::empty()), (0.1, 1.0));
    }

    #[test]
    fn a_chart_is_drawn_without_fonts() {
        let chart = Chart {
            x_label: "t (s)".into(),
            y_label: "ÿ < 1 (m/s²)".into(),
            x: (0.0, 2.0),
            y: (17.0, 0.0),
            series: vec![
                Series::new("chain", 0, vec![(0.0, 1.0), (1.0, 16.0)]),
                Series::reference("free fall", vec![(0.0, 0.0), (2.0, 5.0)]),
            ],
            scale: Scale::Linear,
            legend: Legend::Within(Place::LowerRight),
            size: (480, 300),
        };
        let svg = chart.svg().expect("figure");
        assert!(svg.starts_with("<svg "));
        assert!(svg.trim_end().ends_with("</svg>"));
        assert!(svg.contains("width=\"480\" height=\"300\" viewBox=\"0 0 4800 3000\""));
        for text in ["t (s)", "ÿ &lt; 1 (m/s²)", "free fall"] {
            assert!(svg.contains(text), "{text} in {svg}");
        }
    }
}
