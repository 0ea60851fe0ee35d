//! Multipliers along a trajectory, where they are unique.

use nalgebra::DMatrix;

use super::{Sample, Trajectory};
use crate::error::Error;
use crate::modes::normalise;
use crate::solver::{Solution, Solver};

/// A row takes part in what constraints imply of each other with more than this share of it.
const SHARE: f64 = 1e-6;

impl Trajectory {
    /// Multipliers λ of the constraint called `name` at the samples, a vector for each: of a constraint with several rows (`"knee"`) all of
    /// them, of a row (`"knee.x"`) or a constraint of one row that alone. They are those of
    /// [`Solution::multipliers`](crate::Solution::multipliers); of a joint between points in the plane or in space that has rows `x`, `y`
    /// (and `z`) these are the force on the second body, in axes of the ground.
    ///
    /// Where constraints imply each other, what they share is not determined: multipliers that are not unique are not a number.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name; what the solver reports, with the sample ([`Error::At`]).
    pub fn multipliers(&self, name: &str) -> Result<Vec<Vec<f64>>, Error> {
        let spec = self.spec();
        let belongs = |full: &str| {
            let rest = full.strip_prefix(name);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        let rows = spec.constraints.iter().enumerate();
        let rows = rows.filter(|(_, c)| belongs(c.name)).map(|(row, _)| row);
        let mut rows: Vec<usize> = rows.collect();
        if rows.is_empty() {
            rows.push(spec.constraint_index(name)?);
        }
        let mut solver = Solver::new(self.mechanism(), self.options);
        let mut values = |s: Sample<'_>| {
            let solution = solver.solve(s.t, s.q, s.v);
            let solution = solution.map_err(|error| s.locate(error))?;
            let unique = self.unique(s, &solution);
            let value = |row: &usize| match unique[*row] {
                true => solution.multipliers[*row],
                false => f64::NAN,
            };
            Ok(rows.iter().map(value).collect())
        };
        self.samples().map(&mut values).collect()
    }

    /// Of each constraint, whether its multiplier is unique: no combination of rows of A that vanishes has it.
    fn unique(&self, s: Sample<'_>, solution: &Solution) -> Vec<bool> {
        let (n, m) = (self.spec().n(), self.spec().m());
        let mut unique = vec![true; m];
        if solution.rank == m {
            return unique;
        }
        let mut jacobian = vec![0.0; n * m];
        self.mechanism().jacobian(s.t, s.q, s.v, &mut jacobian);
        let mut rows = DMatrix::from_vec(m, n, jacobian);
        normalise(&mut rows);
        let gram = (&rows * rows.transpose()).symmetric_eigen();
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|a, b| gram.eigenvalues[*a].total_cmp(&gram.eigenvalues[*b]));
        for k in &order[..m - solution.rank] {
            let shares = gram.eigenvectors.column(*k);
            let pairs = unique.iter_mut().zip(shares.iter());
            pairs.for_each(|(unique, share)| *unique &= share.abs() <= SHARE);
        }
        unique
    }
}
