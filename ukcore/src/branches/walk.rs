//! Walks along the constraints from one place to another: what can be reached so is the same way to put a mechanism together.

use nalgebra::{DMatrix, DVector};

use crate::assemble::{Search, State};
use crate::displacements::{constraint_matrix, null_space_holding};
use crate::manifold::At;
use crate::spectrum::singular;

use super::Ways;

/// Steps, at most, and how long one is, at most, beside what coordinates extend over.
const STEPS: usize = 200;
const LONGEST: f64 = 0.1;
/// A step is halved so often, at most.
const HALVINGS: i32 = 10;
/// Constraints bend a step by no more than this share of it.
const BENT: f64 = 0.25;
/// The least cosine between the directions in which the constraints let a mechanism go at the two ends of a step: where branches cross it
/// is as far from 1 for the shortest step from one to the other.
const ALONG: f64 = 0.95;
/// A walk ends where less than this share of the way that is left is along the constraints.
const NOWHERE: f64 = 1e-3;

impl Ways<'_> {
    /// Whether the straightest way from `from` along the constraints `at` a time gets to `to`, but for whole turns. One that does not may
    /// have met a dead end on a way that is longer.
    pub(super) fn reaches(
        &self,
        search: &mut Search,
        at: &At<'_, f64>,
        from: &[f64],
        to: &[f64],
    ) -> bool {
        let mut q = from.to_vec();
        let mut free = self.free(at, &q);
        for _ in 0..STEPS {
            if self.places.are_one(to, &q) {
                return true;
            }
            let aim = self.places.turned(to, &q);
            let left = self.between(&q, &aim);
            let along = &free * free.tr_mul(&left);
            if along.norm() <= NOWHERE * left.norm() {
                return false;
            }
            let longest = (LONGEST / along.norm()).min(1.0);
            let next = (0..HALVINGS).find_map(|halved| {
                let step = &along * (longest * 0.5_f64.powi(halved));
                let moved = q.iter().zip(step.iter()).zip(&self.places.extents);
                let wanted: Vec<f64> = moved.map(|((q, d), unit)| q + d * unit).collect();
                let mut there = wanted.clone();
                search.manifold.project(at, &mut there).ok()?;
                let bent = self.between(&wanted, &there).norm() <= BENT * step.norm();
                let nearer = self.between(&there, &aim).norm() < left.norm();
                let beyond = (bent && nearer).then(|| self.free(at, &there))?;
                go_together(&free, &beyond).then_some((there, beyond))
            });
            let Some(next) = next else {
                return false;
            };
            (q, free) = next;
        }
        false
    }

    /// The way from `from` to `to`, measured by what coordinates extend over: a light crank tells places apart as a heavy coupler does.
    fn between(&self, from: &[f64], to: &[f64]) -> DVector<f64> {
        DVector::from_fn(from.len(), |j, _| {
            (to[j] - from[j]) / self.places.extents[j]
        })
    }

    /// The directions in which the constraints let the mechanism go at `q`, measured.
    fn free(&self, at: &At<'_, f64>, q: &[f64]) -> DMatrix<f64> {
        let rows = constraint_matrix(self.mech, &State::at_rest(at.t, q.to_vec()));
        let rows = rows.rows(0, self.mech.spec().holonomic).into_owned();
        let units = DVector::from_column_slice(&self.places.extents);
        null_space_holding(&self.held.positions, rows, &units)
    }
}

/// Whether orthonormal directions of as many columns are nearly the same space.
fn go_together(some: &DMatrix<f64>, others: &DMatrix<f64>) -> bool {
    some.ncols() == others.ncols()
        && singular(some.tr_mul(others), false, false)
            .is_some_and(|svd| svd.singular_values.min() >= ALONG)
}
