//! How many constraints count: the tolerance of the rank, as far as drift lends significance.

use super::agreement::Drift;
use super::{DRIFT_FACTOR, Given, RANK_CEILING, Solver, mass_error};
use crate::error::Error;

/// A row that counts with less significance than this, the root of some tens of ε, may be implied by the others: rounding of a state is a
/// way of ε over the significance along the row, on which that changes by as much.
const DOUBTFUL: f64 = 1e-7;

/// Those of some rows of A that the others of them do not imply at a state.
pub(crate) struct Independent {
    /// Their numbers, by significance.
    pub(crate) rows: Vec<usize>,
    /// How many of them are independent beyond doubt.
    pub(crate) clear: usize,
}

impl Solver {
    /// Decides which of the rows `among` are independent, as the rank of all is decided.
    pub(crate) fn independent(
        &mut self,
        at: Given<'_>,
        among: &[usize],
    ) -> Result<Independent, Error> {
        self.evaluate(at)?;
        self.leave_rows(|row| !among.contains(&row));
        self.factor()?;
        let (rank, _) = self.significant(at, among.iter().copied());
        let cod = &self.dense.cod;
        Ok(Independent {
            rows: cod.order()[..rank].to_vec(),
            clear: leading(cod.pivots(), DOUBTFUL).min(rank),
        })
    }

    /// Leaves out rows of A that have been evaluated.
    pub(super) fn leave_rows(&mut self, left: impl Fn(usize) -> bool) {
        for row in (0..self.m).filter(|row| left(*row)) {
            let entries = self.here.jacobian.iter_mut().skip(row).step_by(self.m);
            entries.for_each(|a| *a = 0.0);
        }
    }

    /// Decides the rank (see the [module](super)) and returns the tolerance that did.
    pub(super) fn decide_rank(&mut self, at: Given<'_>) -> Result<f64, Error> {
        let (rank, tolerance) = self.significant(at, 0..self.m);
        // Off the constraints rows may seem to count that do not.
        let known = self.dropping.rank(self.m);
        self.full = known.unwrap_or(self.full.max(rank));
        let weakest = match rank.min(self.full).checked_sub(1) {
            Some(last) if last + 1 == self.full => self.dense.cod.pivots()[last],
            Some(_) => 0.0,
            None => 1.0,
        };
        self.weakest = self.weakest.min(weakest);
        let reduced = self.dense.set_rank(rank, &self.here.mass);
        reduced.map_err(|fault| mass_error(self.mechanism.spec(), fault))?;
        Ok(tolerance)
    }

    /// How many rows count, of those `among` all to which A is [factored](Solver::factor), and the tolerance that decided.
    pub(super) fn significant(
        &mut self,
        at: Given<'_>,
        among: impl Iterator<Item = usize>,
    ) -> (usize, f64) {
        let mut tolerance = self.options.rank_tolerance;
        let clear = leading(self.dense.cod.pivots(), RANK_CEILING);
        let mut rank = self.dense.cod.pivots().len();
        if clear < rank {
            self.dense.cod.set_rank(clear);
            self.measure_drift(at);
            tolerance = tolerance.max(DRIFT_FACTOR * self.drifted(among));
            tolerance = tolerance.min(RANK_CEILING);
            rank = leading(self.dense.cod.pivots(), tolerance);
        }
        (rank, tolerance)
    }

    /// By which share of itself one of these rows of A changes at most, one Newton step nearer to the manifold.
    pub(super) fn drifted(&self, among: impl Iterator<Item = usize>) -> f64 {
        let there = self.drift.there.rows();
        let (here, measure) = (self.here.rows(), &self.dense.measure);
        let scale = &measure.scale;
        let shares = among.map(|c| {
            let change = here.row(c).zip(there.row(c)).zip(scale);
            let change = change.map(|((a, b), s)| ((a - b) * s).abs());
            // Not finite: no state worth the name is near.
            let change = change.fold(0.0, |s: f64, x| match x.is_finite() {
                true => s.max(x),
                false => f64::INFINITY,
            });
            let own = here.largest(c, scale);
            let size = measure.size_of_vanishing(c, own).unwrap_or(own);
            if change > 0.0 { change / size } else { 0.0 }
        });
        shares.fold(0.0, f64::max)
    }

    /// The equations one Newton step nearer to the manifold, with the rank in force.
    pub(super) fn measure_drift(&mut self, at: Given<'_>) {
        self.mechanism.residual(at.0, at.1, &mut self.position);
        self.correct(at);
    }

    /// The same from a place that may be off the manifold by rounding, too, which need not show.
    pub(super) fn bound_drift(&mut self, at: Given<'_>) {
        let (t, q, v) = at;
        let mut lost = vec![0.0; self.position.len()];
        self.noise.go(&self.mechanism, t, [q, v], |_| [0.0; 2]);
        self.noise.residual(&mut lost);
        self.mechanism.residual(t, q, &mut self.position);
        for (phi, lost) in self.position.iter_mut().zip(lost) {
            *phi += (f64::EPSILON * lost).copysign(*phi);
        }
        self.correct(at);
    }

    /// The equations one Newton step nearer to the manifold by the residuals in hand.
    fn correct(&mut self, (t, q, v): Given<'_>) {
        let Drift {
            known,
            there,
            q: near_q,
            v: near_v,
            correction,
        } = &mut self.drift;
        *known = true;
        self.rate.fill(0.0);
        self.rate[..self.position.len()].copy_from_slice(&self.position);
        self.dense.least_norm(&self.rate, correction);
        let pairs = near_q.iter_mut().zip(q).zip(&*correction);
        pairs.for_each(|((x, q), d)| *x = q - d);
        // Off the manifold rates contradict each other, and no correction of velocities meets them all.
        self.mechanism.residual_rate(t, near_q, v, &mut self.rate);
        self.dense.least_norm(&self.rate, correction);
        let pairs = near_v.iter_mut().zip(v).zip(&*correction);
        pairs.for_each(|((x, v), d)| *x = v - d);
        there.dynamics(&self.mechanism, t, near_q, near_v);
        self.work.evaluations += 1;
    }
}

/// Number of pivots before the first that does not exceed `tolerance`.
pub(crate) fn leading(pivots: &[f64], tolerance: f64) -> usize {
    pivots.iter().take_while(|p| **p > tolerance).count()
}
