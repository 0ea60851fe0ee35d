//! Curves as they are drawn by `run --plot` and `kinematics --plot`.

use std::mem;

use ukcore::Prepared;
use ukcore::simulate::Sample;

use crate::columns::{self, Column};
use crate::command::path;
use crate::failure::Failure;
use crate::html::joined;
use crate::numbers::extremes;
use crate::output::{WholeFile, promised};
use crate::plot::{Chart, Legend, Series, legend_height, round_range, stacked};
use crate::units::is_length;

/// More points than a picture shows.
const MOST: usize = 20_000;

/// Items that come one by one, of which every second is left out again and again, so that there are never more than some.
pub(crate) struct Thinned<T> {
    pub(crate) items: Vec<T>,
    most: usize,
    stride: usize,
    seen: usize,
    /// The last one, if it is not among `items`.
    last: Option<T>,
}

impl<T> Thinned<T> {
    pub(crate) fn new(most: usize) -> Self {
        Thinned {
            items: Vec::new(),
            most,
            stride: 1,
            seen: 0,
            last: None,
        }
    }

    pub(crate) fn push(&mut self, item: T) {
        let kept = self.seen.is_multiple_of(self.stride);
        self.seen += 1;
        if !kept {
            self.last = Some(item);
            return;
        }
        self.last = None;
        self.items.push(item);
        if self.items.len() > self.most {
            self.items = mem::take(&mut self.items).into_iter().step_by(2).collect();
            self.stride *= 2;
        }
    }

    /// The items that were kept, and the last one.
    pub(crate) fn finish(mut self) -> Vec<T> {
        self.items.extend(self.last);
        self.items
    }
}

/// A picture of curves that is filled while a motion is computed.
pub(crate) struct Curves {
    file: WholeFile,
    /// Horizontal and vertical quantities, of each curve one.
    over: Vec<Column>,
    of: Vec<Column>,
    /// The quantity over which a curve is drawn that does not say so.
    usual: String,
    rows: Thinned<(Vec<f64>, Vec<f64>)>,
}

/// Height of a panel that stands alone, and of one of several, below its legend, in pixels.
const HEIGHTS: (u32, u32) = (460, 300);
/// Curves whose names are written at an axis; those of more stand in the legend alone.
const NAMED: usize = 4;

impl Curves {
    /// What is asked for by a file's name and curves: `NAME` over the quantity `usual`, or `X,Y`, which is Y over X.
    ///
    /// # Errors
    /// [`Failure::Usage`] for unknown names; [`Failure::Failed`] where the file cannot be written.
    pub(crate) fn new(
        mechanism: &Prepared,
        usual: &str,
        asked: &[String],
    ) -> Result<Self, Failure> {
        let [file, curves @ ..] = asked else {
            return Err(Failure::Usage("`--plot` needs a file".to_owned()));
        };
        let file = path(file).map_err(|e| Failure::Usage(format!("`--plot`: {e}")))?;
        promised("--plot", &file, "svg")?;
        let (mut over, mut of) = (Vec::new(), Vec::new());
        for curve in curves {
            let (x, y) = curve.split_once(',').unwrap_or((usual, curve));
            let [x, y] = [x, y].map(|name| columns::named(mechanism, &[name]));
            let (x, y) = (x?, y?);
            if curve.contains(',') && (x.len(), y.len()) != (1, 1) {
                let message = format!(
                    "a curve `X,Y` is of two numbers; choose members of the families in `{curve}`, such as `x[0],y[0]`"
                );
                return Err(Failure::Usage(message));
            }
            over.extend(y.iter().flat_map(|_| x.clone()));
            of.extend(y);
        }
        Ok(Curves {
            file: WholeFile::create(&file)?,
            over,
            of,
            usual: usual.to_owned(),
            rows: Thinned::new(MOST),
        })
    }

    /// What is drawn, and over what.
    pub(crate) fn columns(&self) -> impl Iterator<Item = &Column> {
        self.over.iter().chain(&self.of)
    }

    /// Takes a sample of `mechanism`.
    pub(crate) fn add(&mut self, mechanism: &Prepared, sample: Sample<'_>) {
        let values = |of: &[Column]| columns::values(of, mechanism, sample);
        self.rows.push((values(&self.over), values(&self.of)));
    }

    /// Draws them, in panels of curves that are alike in what they are over and in their units.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        let (over, of, rows) = (&self.over, &self.of, self.rows.finish());
        let kind = |k: usize| (&over[k].unit, &of[k].unit, over[k].name == self.usual);
        let mut panels: Vec<Vec<usize>> = Vec::new();
        for k in 0..of.len() {
            match panels.iter_mut().find(|panel| kind(panel[0]) == kind(k)) {
                Some(panel) => panel.push(k),
                None => panels.push(vec![k]),
            }
        }
        let height = if panels.len() > 1 {
            HEIGHTS.1
        } else {
            HEIGHTS.0
        };
        let chart = |panel: &Vec<usize>| {
            let single = panel.len() == 1;
            // The first lies on top, and comes first in the legend.
            let series = panel.iter().rev().flat_map(|&k| {
                // Where something is not finite there is a gap at least.
                let points = rows.iter().map(|(x, y)| (x[k], y[k]));
                let points = points.filter(|(x, y)| x.is_finite() && y.is_finite());
                let points: Vec<_> = points.collect();
                // A motion without length has no line.
                let dots = if points.len() == 1 { 3 } else { 0 };
                let turns = [over[k].turn(), of[k].turn()];
                let pieces = pieces(points, turns).into_iter().enumerate();
                pieces.map(move |(piece, points)| Series {
                    dots,
                    ..Series::new(
                        if single || piece > 0 {
                            String::new()
                        } else {
                            of[k].label()
                        },
                        k,
                        points,
                    )
                })
            });
            let series: Vec<Series> = series.collect();
            let x = series.iter().flat_map(|s| s.points.iter().map(|p| p.0));
            let mut across: Vec<String> = panel.iter().map(|&k| over[k].label()).collect();
            across.dedup();
            let (x_unit, y_unit, usual) = kind(panel[0]);
            let up = match panel.len() {
                ..=NAMED => joined(panel.iter().map(|&k| of[k].label())),
                _ => y_unit.clone(),
            };
            let (legend, above) = match single {
                true => (Legend::None, 0),
                false => (Legend::Above, legend_height(panel.len())),
            };
            let chart = Chart {
                legend,
                size: (760, height + above),
                ..Chart::new(joined(across), up, round_range(x), series.clone())
            };
            match !usual && x_unit == y_unit && is_length(x_unit) {
                true => chart.drawn_to_scale(),
                false => chart,
            }
        };
        let charts: Vec<Chart> = panels.iter().map(chart).collect();
        self.file.finish_with(stacked(&charts)?)
    }
}

/// The pieces of a line through `points` between which an output that tells an angle up to whole turns, as atan2 does, jumps by one: by
/// more than half a turn, while all its values lie within one. `turns` are those of both numbers, in their units, where they are such
/// outputs.
fn pieces(points: Vec<(f64, f64)>, turns: [Option<f64>; 2]) -> Vec<Vec<(f64, f64)>> {
    let least = |(low, high): (f64, f64), turn: Option<f64>| {
        let turn = turn.filter(|turn| high - low <= (1.0 + 1e-9) * turn);
        turn.map_or(f64::INFINITY, |turn| 0.5 * turn)
    };
    let across = least(extremes(points.iter().map(|p| p.0)), turns[0]);
    let up = least(extremes(points.iter().map(|p| p.1)), turns[1]);
    let joined =
        |p: &(f64, f64), q: &(f64, f64)| (q.0 - p.0).abs() <= across && (q.1 - p.1).abs() <= up;
    points.chunk_by(joined).map(<[_]>::to_vec).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn lines_are_broken_where_an_angle_is_told_anew() {
        let turning = |t: f64| (t, (6.0 * t).sin().atan2((6.0 * t).cos()));
        let points: Vec<(f64, f64)> = (0..300).map(|k| turning(0.01 * f64::from(k))).collect();
        let whole = vec![points.clone()];
        // 18 rad: through π thrice.
        let found = pieces(points.clone(), [None, Some(TAU)]);
        assert_eq!((found.len(), found.concat()), (4, points.clone()));
        assert_eq!(pieces(points.clone(), [None, None]), whole);
        let turned: Vec<(f64, f64)> = points.iter().map(|(t, a)| (*a, *t)).collect();
        assert_eq!(pieces(turned, [Some(TAU), None]).len(), 4);
        // What goes on growing is no such angle, however far its samples are apart.
        let fast: Vec<(f64, f64)> = (0..9).map(|k| (f64::from(k), 5.0 * f64::from(k))).collect();
        assert_eq!(pieces(fast.clone(), [None, Some(TAU)]), [fast]);
        assert_eq!(pieces(Vec::new(), [None, Some(TAU)]).len(), 0);
    }

    #[test]
    fn what_is_thinned_keeps_first_and_last_at_even_distances() {
        for count in [1, 7, 8, 9, 100, 1001] {
            let mut thinned = Thinned::new(8);
            (0..count).for_each(|k| thinned.push(k));
            let kept = thinned.finish();
            assert!(kept.len() <= 10, "{kept:?}");
            assert_eq!((kept[0], kept[kept.len() - 1]), (0, count - 1));
            let gaps: Vec<i32> = kept.windows(2).map(|w| w[1] - w[0]).collect();
            let even = gaps.split_last().map_or(&[][..], |(_, gaps)| gaps);
            assert!(even.windows(2).all(|w| w[0] == w[1]), "{kept:?}");
        }
    }
}
