//! The summary as a picture: a bar a case, a cell a value, coloured by how it came out.

use crate::html::escape;

use super::case::{Class, Row};

const WIDTH: usize = 800;
const HEAD: usize = 44;
const PITCH: usize = 24;
const BAR: usize = 15;
/// Left and right end of the bars; names stand before the labels of the first value, remarks after those of the last.
const LEFT: usize = 200;
const RIGHT: usize = 556;

/// Colours that differ in lightness, too (after Okabe and Ito).
fn colour(class: Class) -> &'static str {
    match class {
        Class::Accurate => "#007a5a",
        Class::Degraded => "#e6b83d",
        Class::Refused => "#c4ccd4",
        Class::Wrong => "#d0021b",
    }
}

fn meaning(class: Class) -> &'static str {
    match class {
        Class::Accurate => "accurate",
        Class::Degraded => "degraded within its bound",
        Class::Refused => "refused by name",
        Class::Wrong => "wrong",
    }
}

/// The picture as the text of an SVG file.
pub(super) fn svg(rows: &[Row]) -> String {
    let height = HEAD + PITCH * rows.len() + 10;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {WIDTH} {height}\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#1c1c1c\">\n\
         <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    let mut x = 14;
    for class in Class::ALL {
        let text = meaning(class);
        svg.push_str(&format!(
            "<rect x=\"{x}\" y=\"12\" width=\"22\" height=\"14\" fill=\"{}\"/><text x=\"{}\" y=\"24\">{text}</text>\n",
            colour(class),
            x + 28
        ));
        x += 58 + 7 * text.len();
    }
    for (i, row) in rows.iter().enumerate() {
        svg.push_str(&bar(row, HEAD + i * PITCH));
    }
    svg.push_str("</svg>\n");
    svg
}

fn bar(row: &Row, top: usize) -> String {
    let base = top + 12;
    let text = |x: usize, anchor: &str, size: usize, text: &str| {
        format!(
            "<text x=\"{x}\" y=\"{base}\" text-anchor=\"{anchor}\" font-size=\"{size}\">{}</text>",
            escape(text)
        )
    };
    let label = |index: Option<usize>| {
        index
            .and_then(|i| row.points.get(i))
            .map_or("", |p| p.label.as_str())
    };
    let named = row.points.iter().any(|p| p.label.contains(' '));
    let (first, last) = if named {
        ("", "")
    } else {
        (label(Some(0)), label(row.points.len().checked_sub(1)))
    };
    let mut svg = format!("<g><title>{}</title>", escape(row.swept));
    svg.push_str(&text(14, "start", 13, row.id));
    svg.push_str(&text(LEFT - 8, "end", 12, first));
    svg.push_str(&text(RIGHT + 8, "start", 12, last));
    let refusals = row.refusals();
    let shown = refusals.len().min(2);
    let more = if refusals.len() > shown { ", …" } else { "" };
    let names = format!("{}{more}", refusals[..shown].join(", "));
    svg.push_str(&text(RIGHT + 58, "start", 12, &names));
    let width = (RIGHT - LEFT) as f64 / row.points.len().max(1) as f64;
    for (i, point) in row.points.iter().enumerate() {
        let x = LEFT as f64 + i as f64 * width;
        svg.push_str(&format!(
            "<rect x=\"{x:.1}\" y=\"{top}\" width=\"{:.1}\" height=\"{BAR}\" fill=\"{}\"><title>{}</title></rect>",
            width - 1.0,
            colour(point.class),
            escape(&point.label)
        ));
    }
    // The ordinary value, where it is not at an end.
    if row.ordinary > 0 && row.ordinary + 1 < row.points.len() {
        let x = LEFT as f64 + (row.ordinary as f64 + 0.5) * width - 0.5;
        svg.push_str(&format!(
            "<circle cx=\"{x:.1}\" cy=\"{}\" r=\"2.5\" fill=\"#fff\"/>",
            top as f64 + BAR as f64 / 2.0
        ));
    }
    svg.push_str("</g>\n");
    svg
}
