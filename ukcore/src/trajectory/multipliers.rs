//! Multipliers along a trajectory, where they are unique.

use super::{Sample, Trajectory};
use crate::diagnosis::{Relation, measured_rows, relations};
use crate::error::Error;
use crate::inverse::{Effort, Inverse};
use crate::solver::{Solution, Solver};

impl Trajectory {
    /// Multipliers λ of the constraint called `name` at the samples, a vector for each: of a constraint with several rows (`"knee"`) all of
    /// them, of a row (`"knee.x"`) or a constraint of one row that alone. They are those of
    /// [`Solution::multipliers`](crate::Solution::multipliers); of a joint between points in the plane or in space that has rows `x`, `y`
    /// (and `z`) these are the force on the second body, in axes of the ground, or that turn with the body that both hang on in a `tree`.
    ///
    /// Where constraints imply each other, what they share is not determined: multipliers that are not unique are not a number.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name; what the solver reports, with the sample ([`Error::At`]).
    #[doc(alias = "reaction")]
    pub fn multipliers(&self, name: &str) -> Result<Vec<Vec<f64>>, Error> {
        let rows = self.spec().constraint_indices(name)?;
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

    /// The efforts of the constraints `motors` at the samples, as [`inverse`](crate::inverse()) has them, a vector for each.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name; what the solver reports, with the sample ([`Error::At`]).
    pub fn efforts(&self, motors: &[&str]) -> Result<Vec<Vec<Effort>>, Error> {
        let mut inverse = Inverse::new(self.mechanism(), motors)?;
        let efforts = |s: Sample<'_>| {
            let found = inverse.efforts(&s.to_state());
            found.map_err(|error| s.locate(error))
        };
        self.samples().map(efforts).collect()
    }

    /// Whether the multiplier of each constraint is unique: no combination of rows of A that vanishes has it.
    fn unique(&self, s: Sample<'_>, solution: &Solution) -> Vec<bool> {
        let mut unique = vec![true; self.spec().m()];
        if solution.rank < unique.len() {
            let rows = measured_rows(self.mechanism(), &s.to_state());
            let related = relations(&rows, solution.rank);
            for row in related.iter().flat_map(Relation::rows) {
                unique[row] = false;
            }
        }
        unique
    }
}
