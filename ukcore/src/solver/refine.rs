//! The straight line where it loses digits though no constraint is near the others: light masses between heavy ones, or tied to them.
//!
//! Its certificate compares pivots in the mass metric, in which the rows of two links that share a light mass are nearly parallel. Whether
//! a row counts is a matter of A alone, though. So where all rows of A counted for certain in a rank-revealing solve, they do while A has
//! not changed much; and what the straight line lacks in digits, refinement gives back. Its q̈ satisfies M q̈ = Q + c + Aᵀλ for some λ to
//! rounding of |M||q̈| + |Q + c| + |A|ᵀ|λ|, row by row, as do the corrections Δ of M Δ = Aᵀμ, A Δ = b − A q̈: with A q̈ = b to rounding, q̈
//! + Δ solves equations that are as near (Higham 2002, §12.2).
//!
//! Where a coordinate j is substituted by a constraint c, λ_c is nowhere computed; it is what row j makes it, (M q̈ − Q − …)_j/a_cj, and
//! row j is met as it stands. Row i of another coordinate in c has been solved as that row less f = a_ci/a_cj times row j, to rounding of
//! its own terms and f times those of row j; the latter are |a_ci λ_c|, as if a_ci were off by its rounding. So with two coordinates that
//! are turned, with the component along n for row j and that along t for row i.

use super::{Formula, Given, RANK_CEILING, Solver};
use crate::mechanism::Evaluated;
use crate::scan::{all_finite, axpy};

/// Refinements tried; each has to gain a digit.
const STEPS: usize = 5;
/// What is left of A q̈ = b, in ε of its terms.
const LEFT: f64 = 64.0;

/// A at a state where every row counted.
#[derive(Debug, Clone)]
pub(super) struct Known {
    /// Whether there was one, with the parameters of now.
    pub(super) valid: bool,
    jacobian: Vec<f64>,
    /// How much the entries of each row may change, measured; and what columns are measured by.
    slack: Vec<f64>,
    scale: Vec<f64>,
}

impl Known {
    pub(super) fn new(n: usize, m: usize) -> Self {
        Known {
            valid: false,
            jacobian: vec![0.0; m * n],
            slack: vec![0.0; m],
            scale: vec![1.0; n],
        }
    }
}

impl Solver {
    /// Remembers A of the rank-revealing solution in hand, if M is a regular constant and all rows counted clearly.
    pub(super) fn remember(&mut self, formula: Formula) {
        let weakest = self.dense.cod.pivots().last().copied().unwrap_or(0.0);
        let clear = self.dense.cod.rank() == self.m && weakest > 2.0 * RANK_CEILING;
        let fixed = self.mechanism.spec().structure.mass_constant;
        self.known.valid = clear && fixed && self.m > 0 && formula == Formula::UdwadiaKalaba;
        if self.known.valid {
            // Singular values of A with rows of length 1 change by no more than √m times the largest change of a row.
            let share = (weakest - RANK_CEILING) / (2.0 * (self.m as f64).sqrt());
            let (a, scale) = (self.here.rows(), &self.dense.measure.scale);
            let slack = self.known.slack.iter_mut().enumerate();
            slack.for_each(|(c, slack)| *slack = share * a.largest(c, scale));
            self.known.scale.copy_from_slice(scale);
            self.known.jacobian.copy_from_slice(&self.here.jacobian);
        }
    }

    /// Refines q̈ of the straight line, in `out`; false where that does not lead to rounding.
    pub(super) fn refined(&mut self, (t, q, v): Given<'_>, out: &mut [f64]) -> bool {
        let known = &self.known;
        if !(known.valid && all_finite(out)) {
            return false;
        }
        self.here.dynamics(&self.mechanism, t, q, v);
        self.work.evaluations += 1;
        let a = &self.here.jacobian;
        let columns = a.chunks_exact(self.m);
        let columns = columns.zip(known.jacobian.chunks_exact(self.m));
        let near = columns.zip(&known.scale).all(|((here, there), scale)| {
            let entries = here.iter().zip(there).zip(&known.slack);
            // Without branches.
            entries.fold(true, |near, ((a, b), slack)| {
                near & (((a - b) * scale).abs() <= *slack)
            })
        });
        if !near {
            return false;
        }
        let masses = || self.here.mass.iter().step_by(self.n + 1);
        let norm = |x: &[f64]| masses().zip(x).map(|(m, x)| m * x * x).sum::<f64>().sqrt();
        let applied = self.here.force.iter().zip(&self.here.nonideal);
        let free = masses().zip(applied).map(|(m, (f, c))| (f + c).powi(2) / m);
        let scale = norm(out).max(free.sum::<f64>().sqrt());
        let (residual, step) = (&mut self.rhs, &mut self.force);
        let mut last = scale;
        for _ in 0..STEPS {
            residual.fill(0.0);
            axpy(-1.0, &self.here.rhs, residual);
            for (x, column) in out.iter().zip(a.chunks_exact(self.m)) {
                axpy(*x, column, residual);
            }
            step.fill(f64::NAN);
            self.mechanism.correction(t, q, v, residual, step);
            let size = norm(step);
            if size == 0.0 {
                return met(&self.here, out);
            }
            if size.is_nan() || size > 0.1 * last {
                return false;
            }
            out.iter_mut().zip(&*step).for_each(|(x, d)| *x += d);
            // What the next step would change, as each gains as much.
            if size * size <= f64::EPSILON * scale * last && met(&self.here, out) {
                return true;
            }
            last = size;
        }
        false
    }
}

/// Whether A q̈ = b to rounding.
fn met(here: &Evaluated, out: &[f64]) -> bool {
    let (a, b) = (here.rows(), &here.rhs);
    all_finite(out)
        && b.iter().enumerate().all(|(c, b)| {
            let size = b.abs() + a.magnitude(c, out);
            (a.product(c, out) - b).abs() <= LEFT * f64::EPSILON * size
        })
}
