//! The summary as a picture: a bar a case, a cell a value, coloured by how it came out.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::case::{Class, Row};
use crate::failure::Failure;
use crate::plot::{Area, DrawError, svg, write};

const WIDTH: i32 = 800;
const HEAD: i32 = 44;
const PITCH: i32 = 24;
const BAR: i32 = 15;
/// Left and right end of the bars; names stand before the labels of the first value, remarks after those of the last.
const LEFT: i32 = 200;
const RIGHT: i32 = 556;

/// Colours that differ in lightness, too (after Okabe and Ito), and what they mean.
fn look(class: Class) -> (RGBColor, &'static str) {
    match class {
        Class::Accurate => (RGBColor(0, 122, 90), "accurate"),
        Class::Degraded => (RGBColor(230, 184, 61), "degraded within its bound"),
        Class::Refused => (RGBColor(196, 204, 212), "refused by name"),
        Class::Wrong => (RGBColor(208, 2, 27), "wrong"),
    }
}

/// The picture as the text of an SVG file.
pub(super) fn picture(rows: &[Row<'_>]) -> Result<String, Failure> {
    let height = HEAD + PITCH * rows.len() as i32 + 10;
    svg((WIDTH as u32, height as u32), 1, |area| {
        area.fill(&WHITE)?;
        let mut x = 14;
        for class in Class::ALL {
            let (colour, meaning) = look(class);
            area.draw(&Rectangle::new([(x, 12), (x + 22, 26)], colour.filled()))?;
            write(area, (x + 28, 19), HPos::Left, 13, meaning)?;
            x += 58 + 7 * meaning.len() as i32;
        }
        let tops = (HEAD..).step_by(PITCH as usize);
        rows.iter()
            .zip(tops)
            .try_for_each(|(row, top)| bar(area, row, top))
    })
}

fn bar<'a>(area: &Area<'a>, row: &Row<'_>, top: i32) -> Result<(), DrawError<'a>> {
    let middle = top + BAR / 2;
    write(area, (14, middle), HPos::Left, 13, row.case.id)?;
    let named = row.points.iter().any(|p| p.label.contains(' '));
    if let (Some(first), Some(last), false) = (row.points.first(), row.points.last(), named) {
        write(area, (LEFT - 8, middle), HPos::Right, 12, &first.label)?;
        write(area, (RIGHT + 8, middle), HPos::Left, 12, &last.label)?;
    }
    let refusals = row.refusals();
    let shown = refusals.len().min(2);
    let more = if refusals.len() > shown { ", …" } else { "" };
    let names = format!("{}{more}", refusals[..shown].join(", "));
    write(area, (RIGHT + 58, middle), HPos::Left, 12, &names)?;
    let width = f64::from(RIGHT - LEFT) / row.points.len().max(1) as f64;
    let left = |i: f64| LEFT + (i * width).round() as i32;
    for (i, point) in row.points.iter().enumerate() {
        let (from, to) = (left(i as f64), left(i as f64 + 1.0) - 1);
        let (colour, _) = look(point.class);
        area.draw(&Rectangle::new(
            [(from, top), (to, top + BAR)],
            colour.filled(),
        ))?;
    }
    // The ordinary value, where it is not at an end.
    if row.case.sweep.ordinary > 0 && row.case.sweep.ordinary + 1 < row.points.len() {
        let place = (left(row.case.sweep.ordinary as f64 + 0.5), middle);
        area.draw(&Circle::new(place, 2, WHITE.filled()))?;
    }
    Ok(())
}
