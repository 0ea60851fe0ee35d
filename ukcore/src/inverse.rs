//! What it takes to drive a mechanism: the efforts of motors, which are constraints that prescribe a motion.

use nalgebra::DVector;

use crate::assemble::State;
use crate::error::Error;
use crate::mechanism::Prepared;
use crate::modes::{constraint_matrix, mass_matrix, measure, null_space, units};
use crate::solver::{Solver, SolverOptions};

/// What a motor does at a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// The row of the constraint.
    pub name: &'static str,
    /// Its multiplier: the torque of a row that prescribes an angle, the force of one that prescribes a place.
    pub effort: f64,
    /// The power that it puts into the mechanism: the effort times the rate at which it moves.
    pub power: f64,
}

/// A combination of motors that acts on free displacements by less than this part of their largest coefficient moves nothing.
const IDLE: f64 = 1e-9;

/// The efforts that drive `mechanism` through `state` as its constraints say, of the constraints `motors` by name, each with all its rows
/// (`"turn"`), or a row (`"drive.x"`): `motor: turn(ground, crank) = w * t` as a constraint is such a motor.
///
/// Where motors share what they do, as two that drive a mechanism of one degree of freedom, theirs are the efforts whose sum of squares is
/// least. All other constraints are taken as joints, and may be redundant.
///
/// # Errors
/// [`Error::UnknownName`] with the nearest name; what [`Solver::solve`] reports.
pub fn inverse(
    mechanism: impl Into<Prepared>,
    state: &State,
    motors: &[&str],
) -> Result<Vec<Effort>, Error> {
    Inverse::new(mechanism, motors)?.efforts(state)
}

/// The efforts of motors at one state after the other, in buffers made once: see [`inverse`].
#[derive(Debug, Clone)]
pub struct Inverse {
    solver: Solver,
    /// The rows of the motors, in their order.
    driven: Vec<usize>,
}

impl Inverse {
    /// Of the constraints `motors` of `mechanism`, each by its name or by that of a row of it.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn new(mechanism: impl Into<Prepared>, motors: &[&str]) -> Result<Self, Error> {
        let mech: Prepared = mechanism.into();
        let mut driven = Vec::new();
        for name in motors {
            driven.extend(mech.spec().constraint_indices(name)?);
        }
        driven.sort_unstable();
        driven.dedup();
        let solver = Solver::new(mech, SolverOptions::default());
        Ok(Inverse { solver, driven })
    }

    /// What the motors do at `state`, as [`inverse`] has it.
    ///
    /// # Errors
    /// What [`Solver::solve`] reports.
    pub fn efforts(&mut self, state: &State) -> Result<Vec<Effort>, Error> {
        let State { t, q, v } = state;
        let solution = self.solver.solve(*t, q, v)?;
        let (mech, driven) = (self.solver.mechanism(), &self.driven);
        let spec = mech.spec();
        let units = units(&mass_matrix(mech, state));
        let rows = constraint_matrix(mech, state);
        let joints: Vec<usize> = (0..spec.m()).filter(|row| !driven.contains(row)).collect();
        // In displacements that the joints allow no force of theirs does work: there the motors are alone.
        let free = null_space(rows.select_rows(&joints), &units);
        let mut acting = rows.select_rows(driven);
        let speeds = &acting * DVector::from_column_slice(v);
        measure(&mut acting, &units);
        let strongest = acting.amax();
        let force = DVector::from_vec(solution.ideal_force).component_mul(&units);
        let mut efforts = DVector::zeros(driven.len());
        if !free.is_empty() && !driven.is_empty() {
            let acting = (acting * &free).transpose();
            if let Ok(least) = acting
                .svd(true, true)
                .solve(&free.tr_mul(&force), IDLE * strongest)
            {
                efforts = least;
            }
        }
        let all = driven.iter().zip(efforts.iter()).zip(speeds.iter());
        let effort = |((row, effort), speed): ((&usize, &f64), &f64)| Effort {
            name: spec.constraints[*row].name,
            effort: *effort,
            power: effort * speed,
        };
        Ok(all.map(effort).collect())
    }
}

impl Prepared {
    /// The rows that prescribe a motion at some of `times`: those whose rate at rest, at `state`, is not zero. A motor that holds still is none
    /// of them.
    #[must_use]
    pub fn motors(&self, state: &State, times: impl IntoIterator<Item = f64>) -> Vec<&'static str> {
        let spec = self.spec();
        let mut rate = vec![0.0; spec.m()];
        let mut moves = vec![false; spec.m()];
        let rest = vec![0.0; spec.n()];
        for t in times {
            self.residual_rate(t, &state.q, &rest, &mut rate);
            let pairs = moves.iter_mut().zip(&rate);
            pairs.for_each(|(moves, rate)| *moves |= *rate != 0.0);
        }
        let rows = spec.constraints.iter().zip(moves);
        rows.filter(|(_, moves)| *moves)
            .map(|(c, _)| c.name)
            .collect()
    }
}
