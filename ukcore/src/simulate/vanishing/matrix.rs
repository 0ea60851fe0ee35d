//! A at a time, as its rows are followed along a run.

use crate::integrate::sample::Sample;
use crate::measure::Measure;
use crate::mechanism::Prepared;
use crate::simulate::leaves::Leaves;

/// A at a time; there is none at NaN.
#[derive(Clone)]
pub(super) struct Matrix {
    pub(super) t: f64,
    pub(super) entries: Vec<f64>,
    /// Squares of the lengths of its rows.
    pub(super) squares: Vec<f64>,
}

impl Default for Matrix {
    fn default() -> Self {
        Matrix {
            t: f64::NAN,
            entries: Vec::new(),
            squares: Vec::new(),
        }
    }
}

impl Matrix {
    /// Takes A at a state, measured. Returns whether it was not known there.
    pub(super) fn take(
        &mut self,
        mech: &Prepared,
        at: Sample<'_>,
        measure: Option<&Measure>,
    ) -> bool {
        let unknown = self.t != at.t;
        if unknown {
            self.t = at.t;
            self.entries.resize(at.q.len() * mech.spec().m(), 0.0);
            mech.jacobian(at.t, at.q, at.v, &mut self.entries);
            if let Some(measure) = measure {
                measure.weigh(&mut self.entries);
            }
        }
        unknown
    }

    /// Takes the lengths of its rows.
    pub(super) fn measure(&mut self, leaves: &Leaves) {
        leaves.squares(&self.entries, &mut self.squares);
    }

    /// A at a state, measured, with the lengths of its rows.
    pub(super) fn at(
        mech: &Prepared,
        at: Sample<'_>,
        measure: Option<&Measure>,
        leaves: &Leaves,
    ) -> Self {
        let mut matrix = Matrix::default();
        matrix.take(mech, at, measure);
        matrix.measure(leaves);
        matrix
    }

    pub(super) fn length(&self, c: usize) -> f64 {
        self.squares[c].sqrt()
    }

    pub(super) fn row(&self, c: usize) -> impl Iterator<Item = f64> {
        let entries = self.entries.iter().skip(c);
        entries.step_by(self.squares.len()).copied()
    }
}
