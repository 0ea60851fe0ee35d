//! How motions beside one part, or meet, where what a row says beside the others is lost.
//!
//! With τ the time from there it is τᵏ n, and what it says of a motion beside this one, off it by s along n, is τ ṡ = α s: a share
//! s = C τ^α. For α > 1 all of them meet there in one direction, and C is not the same behind it. Else one of them is smooth alone, or
//! a direction tells them apart; of holonomic rows alone α is −k. For k > 1 several branches meet, and their directions tell them
//! apart if they are as far from each other before it as they are from there, which its time need not be known well for. Else they touch.

use super::search::Search;
use crate::assemble::State;
use crate::dense::Rows;
use crate::scan::{axpy, dot, largest};

/// The share of the way to a place by which motions beside it are off; their exponents that differ by less are the same.
const OFF_PATH: f64 = 1e-3;
const APART: f64 = 0.02;

/// Other branches are far nearer than the way to a place where a row changes by so many times itself off the path by a share of that way.
const SIDES: [f64; 2] = [0.3, -0.3];
const TURNED: f64 = 4.0;

/// Motions beside one that is near a place where what a row says beside the others is lost.
pub(super) struct Meeting<'s, 'a> {
    search: &'s mut Search<'a>,
    near: &'s State,
    /// The time to the place.
    ahead: f64,
    /// The way that the row bars, on which it grows by 1 in a unit of time: as it is, and in scaled coordinates.
    way: Vec<f64>,
    scaled: Vec<f64>,
    /// So many times that way is as far as the place.
    far: f64,
}

impl<'a> Search<'a> {
    /// The meeting with what `row` says that is lost at `t`; the equations are factored at `near`, before it.
    pub(super) fn meeting<'s>(
        &'s mut self,
        near: &'s State,
        t: f64,
        row: usize,
    ) -> Meeting<'s, 'a> {
        let (n, m) = (near.q.len(), self.mech.spec().m());
        let (mut one, mut way, mut scaled) = (vec![0.0; m], vec![0.0; n], vec![0.0; n]);
        one[row] = 1.0;
        self.dense.least_scaled(&one, &mut scaled);
        self.dense.least_norm(&one, &mut way);
        let (ahead, measure) = (t - near.t, &self.dense.measure);
        Meeting {
            far: ahead.abs() * measure.size(&near.v) / measure.size(&way),
            search: self,
            near,
            ahead,
            way,
            scaled,
        }
    }
}

impl Meeting<'_, '_> {
    /// Whether all of them meet it there.
    pub(super) fn scatters(&mut self) -> bool {
        let (mech, near) = (self.search.mech, self.near);
        let [after, before] = [OFF_PATH, -OFF_PATH].map(|share| {
            let mut rates = vec![0.0; mech.spec().m()];
            mech.residual_rate(near.t, &self.beside(share), &near.v, &mut rates);
            rates
        });
        let alpha = self.ahead * self.own([&after, &before]) / (2.0 * OFF_PATH * self.far);
        alpha > 1.0 + APART
    }

    /// Whether another branch touches theirs there.
    pub(super) fn touches(&mut self) -> bool {
        let here = self.along(0.0);
        let turned = SIDES.map(|share| {
            let beside = self.along(share);
            self.own([&beside, &here])
        });
        largest(&turned) > TURNED
    }

    /// A place beside the motion, by a share of the way to where they meet.
    fn beside(&self, share: f64) -> Vec<f64> {
        let mut q = self.near.q.clone();
        axpy(share * self.far, &self.way, &mut q);
        q
    }

    /// The part that all rows bar of the way, there.
    fn along(&self, share: f64) -> Vec<f64> {
        let (mech, State { t, v, .. }) = (self.search.mech, self.near);
        let m = mech.spec().m();
        let mut jacobian = vec![0.0; v.len() * m];
        mech.jacobian(*t, &self.beside(share), v, &mut jacobian);
        let rows = Rows::all(&jacobian, m);
        (0..m).map(|c| rows.product(c, &self.way)).collect()
    }

    /// What the change of what the rows say is of this one, less what the others make of it.
    fn own(&mut self, [after, before]: [&[f64]; 2]) -> f64 {
        let change: Vec<f64> = after.iter().zip(before).map(|(a, b)| a - b).collect();
        let mut along = vec![0.0; self.scaled.len()];
        self.search.dense.least_scaled(&change, &mut along);
        dot(&along, &self.scaled) / dot(&self.scaled, &self.scaled)
    }
}
