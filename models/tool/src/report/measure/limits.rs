//! Causes of error that belong to a motion: rounding of its start, and what the solver adds.

use ukcore::solver::Formula;
use ukcore::solver::RANK_TOLERANCE;
use ukcore::solver::SolverOptions;
use ukcore::{Simulation, Solver, State};

use super::Subject;
use crate::report::study::Limits;
use crate::report::truth::stacked;

/// Tolerance of the runs that show what a change of the start makes at the end.
const FINE: f64 = 1e-12;
/// The change of the start, as a part of the size of each number: far above the errors of these runs, and small enough for the end to
/// follow in proportion.
const NUDGE: f64 = 1e-8;
/// So many directions are tried: the worst one is then not missed by much.
const DIRECTIONS: usize = 8;

impl Subject<'_> {
    pub(super) fn limits(&self) -> Limits {
        let options = |formula, factor: f64| SolverOptions {
            formula,
            rank_tolerance: factor * RANK_TOLERANCE,
            ..SolverOptions::default()
        };
        let usual = options(self.general, 1.0);
        Limits {
            rounding: self.rounding(),
            rank: [1e-3, 1e3]
                .into_iter()
                .map(|factor| self.compare(usual, options(self.general, factor)))
                .try_fold(0.0, |m: f64, x| x.map(|x| m.max(x))),
            solve: self.compare(usual, options(Formula::Auto, 1.0)),
        }
    }

    /// Largest relative difference of q̈ under two settings, at the states of the reference.
    fn compare(&self, one: SolverOptions, other: SolverOptions) -> Option<f64> {
        let n = self.mechanism.spec().n();
        let mut solvers = [one, other].map(|options| Solver::new(self.mechanism, options));
        let mut largest: f64 = 0.0;
        for (&t, state) in self.truth.times.iter().zip(&self.truth.states) {
            let (q, v) = state.split_at(n);
            let mut both = [vec![0.0; n], vec![0.0; n]];
            for (solver, out) in solvers.iter_mut().zip(&mut both) {
                solver.acceleration(t, q, v, out).ok()?;
            }
            let [a, b] = &both;
            let size = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let difference = a
                .iter()
                .zip(b)
                .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
            if size > 0.0 {
                largest = largest.max(difference / size);
            }
        }
        Some(largest)
    }

    /// Change of the end by starts that are rounded differently, from one by starts that differ more.
    fn rounding(&self) -> Option<f64> {
        let end = |start: State| {
            let run = Simulation::new(self.mechanism)
                .start(start)
                .tolerance(FINE)
                .at(Vec::new())
                .until(self.truth.end())
                .ok()?;
            run.last().map(|last| stacked(&last.to_state()))
        };
        let usual = end(self.start.clone())?;
        let mut largest: f64 = 0.0;
        let mut bits: u64 = 0x9e37_79b9_7f4a_7c15;
        for _ in 0..DIRECTIONS {
            let mut start = self.start.clone();
            let values = start.q.iter_mut().chain(&mut start.v);
            for (value, scale) in values.zip(&self.truth.scale) {
                // Knuth's linear congruential generator: its highest bit is random enough for a sign.
                bits = bits
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                let sign = if bits >> 63 == 0 { 1.0 } else { -1.0 };
                *value += sign * NUDGE * scale;
            }
            let start = self.nearest(&start).ok()?;
            let moved = end(start)?;
            largest = largest.max(self.truth.distance(&moved, &usual).scaled);
        }
        Some(largest * f64::EPSILON / NUDGE)
    }
}
