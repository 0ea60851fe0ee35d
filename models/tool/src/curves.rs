//! Curves of a motion as they are drawn by `run --plot`.

use std::path::Path;

use ukcore::Prepared;
use ukcore::simulate::Sample;

use crate::columns::Columns;
use crate::failure::Failure;
use crate::html::joined;
use crate::output::WholeFile;
use crate::plot::{Chart, Legend, Series, round_range};

/// More points than a picture shows.
const MOST: usize = 20_000;

/// Items that come one by one, of which every second is left out again and again, so that there are never more than some.
#[derive(Debug)]
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
            let mut k = 0;
            self.items.retain(|_| {
                k += 1;
                k % 2 == 1
            });
            self.stride *= 2;
        }
    }

    /// Those kept, and the last one.
    pub(crate) fn finish(mut self) -> Vec<T> {
        self.items.extend(self.last);
        self.items
    }
}

/// A picture of curves that is filled while a motion is computed.
#[derive(Debug)]
pub(crate) struct Curves {
    file: WholeFile,
    /// Horizontal quantities, and vertical ones.
    over: Columns,
    of: Columns,
    rows: Thinned<(Vec<f64>, Vec<f64>)>,
}

impl Curves {
    /// What is asked for by a file's name and curves: `NAME` over time, or `X,Y`, which is Y over X.
    ///
    /// # Errors
    /// [`Failure::Usage`] for unknown names and curves of different kinds; [`Failure::Failed`] where the file cannot be written.
    pub(crate) fn new(mechanism: &Prepared, asked: &[String]) -> Result<Self, Failure> {
        let [path, curves @ ..] = asked else {
            return Err(Failure::Usage("`--plot` needs a file".to_owned()));
        };
        let pairs: Vec<(&str, &str)> = curves.iter().filter_map(|c| c.split_once(',')).collect();
        let (over, of) = if pairs.is_empty() {
            (
                Columns::named(mechanism, &["t"])?,
                Columns::named(mechanism, curves)?,
            )
        } else if pairs.len() == curves.len() {
            let (x, y): (Vec<&str>, Vec<&str>) = pairs.into_iter().unzip();
            let (over, of) = (
                Columns::named(mechanism, &x)?,
                Columns::named(mechanism, &y)?,
            );
            if (over.names().count(), of.names().count()) != (x.len(), y.len()) {
                let message = "a curve `X,Y` is of two numbers; choose members of families, such as `x[0],y[0]`";
                return Err(Failure::Usage(message.to_owned()));
            }
            (over, of)
        } else {
            let message = "curves over time, `NAME`, and curves of one quantity over another, `X,Y`, do not go into one picture";
            return Err(Failure::Usage(message.to_owned()));
        };
        Ok(Curves {
            file: WholeFile::create(Path::new(path))?,
            over,
            of,
            rows: Thinned::new(MOST),
        })
    }

    pub(crate) fn add(&mut self, sample: Sample<'_>) {
        self.rows
            .push((self.over.values(sample), self.of.values(sample)));
    }

    /// Draws them.
    ///
    /// # Errors
    /// [`Failure::Failed`] where the file cannot be written.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        let rows = self.rows.finish();
        let across = self.over.names().count();
        let curve = |k: usize| {
            let points = rows.iter().map(move |(x, y)| (x[k % across], y[k]));
            // Where something is not finite there is a gap at least.
            points.filter(|(x, y)| x.is_finite() && y.is_finite())
        };
        let labels = self.of.labels();
        let single = labels.len() == 1;
        let series = labels.iter().enumerate().map(|(k, label)| {
            let label = if single { "" } else { label };
            Series::new(label, k, curve(k).collect())
        });
        let series: Vec<Series> = series.collect();
        let x = series
            .iter()
            .flat_map(|s| s.points.iter().map(|p| p.0))
            .collect::<Vec<f64>>();
        let mut axes = self.over.labels();
        axes.dedup();
        let chart = Chart {
            legend: if single { Legend::None } else { Legend::Above },
            size: (760, 460),
            ..Chart::new(
                joined(axes),
                if labels.len() > 4 {
                    String::new()
                } else {
                    joined(labels)
                },
                round_range(x.into_iter()),
                series,
            )
        };
        self.file.finish_with(chart.svg()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
