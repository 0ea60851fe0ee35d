//! Constraints that are scaled, repeated, or nearly so.

use std::f64::consts::FRAC_PI_2;

use models::{DoublePendulum, Model, Pendulum};
use ukcore::solver::{RANK_TOLERANCE, SolverOptions};
use ukcore::{Error, Mechanism, Simulation, Solver, State};

use super::{REGULAR, SINGULAR, accelerations_off, end, exact_accelerations, off, swung, worse};
use crate::mechanisms::{Copies, NearPlanes, ScaledRows};
use uktool::stability::{Case, Effort, decades};

pub(crate) fn cases() -> Vec<Case<'static>> {
    vec![
        Case::new("rows-scaled", rows_scaled)
            .swept("one row of a double pendulum times s, the other by s")
            .over(decades(-150, 150, 15, 0))
            .against("the rows as they are: accelerations in 31 digits, and the run")
            .within(1e-9, 1e-6),
        Case::new("rows-copied", rows_copied)
            .swept("rod of a pendulum declared again times s, and by s")
            .over(decades(-150, 150, 15, 0))
            .against("closed form of the pendulum; the copies are named as redundant")
            .within(1e-9, 1e-6),
        Case::new("rows-near", rows_near)
            .swept("angle between two planes that a particle is held on")
            .over(decades(-1, -16, 1, -1))
            .against("closed form; or, where the second plane is named as redundant, that it is met to the rank tolerance")
            .within(1e-12, 1e-10),
    ]
}

fn rows_scaled(s: f64, effort: &mut Effort) -> Result<f64, Error> {
    let plain = ScaledRows::default();
    let mut scaled = plain.clone();
    scaled.set("s", s)?;
    scaled.set("r", 1.0 / s)?;
    let double = DoublePendulum::default();
    let options = [
        ("from1", 0.9),
        ("from2", -0.4),
        ("rate1", 1.0),
        ("rate2", 2.0),
    ];
    let state = double.start("released", &options.into())?;
    let expected = exact_accelerations(&plain, &state);
    let now = accelerations_off(&scaled, &state, &REGULAR, &expected, effort)?;
    let mut end_of = |mechanism: ScaledRows| -> Result<Vec<f64>, Error> {
        let simulation = Simulation::new(mechanism).start(state.clone());
        Ok(end(&effort.run(simulation.tolerance(1e-11), 1.0)?))
    };
    let expected = end_of(plain)?;
    Ok(worse(now, off(&end_of(scaled)?, &expected)))
}

fn rows_copied(s: f64, effort: &mut Effort) -> Result<f64, Error> {
    let mut copies = Copies::default();
    copies.set("s", s)?;
    copies.set("r", 1.0 / s)?;
    let start = Pendulum::default().default_start()?;
    let mut solver = Solver::new(&copies, SolverOptions::default());
    let solution = solver.solve(0.0, &start.q, &start.v)?;
    if solution.rank != 1 || solution.redundant.len() != 2 {
        return Ok(f64::INFINITY);
    }
    let expected = [0.0, -9.81];
    let now = accelerations_off(&copies, &start, &SINGULAR, &expected, effort)?;
    let run = effort.run(Simulation::new(copies).start(start).tolerance(1e-11), 1.0)?;
    Ok(worse(now, off(&end(&run), &swung(-FRAC_PI_2, 1.0))))
}

fn rows_near(d: f64, effort: &mut Effort) -> Result<f64, Error> {
    let mut planes = NearPlanes::default();
    planes.set("d", d)?;
    let state = State::zeros::<NearPlanes>();
    let mut solver = Solver::new(&planes, SolverOptions::default());
    let solution = solver.solve(0.0, &state.q, &state.v)?;
    if solution.redundant.is_empty() {
        let expected = [0.0, 0.0, 3.0];
        return accelerations_off(&planes, &state, &REGULAR, &expected, effort);
    }
    let free = accelerations_off(&planes, &state, &[], &[-0.5, 0.5, 3.0], effort)?;
    // Of the force that the plane would have to bear, this part is let through.
    let let_through = d * solution.acceleration[1] / 2.0;
    Ok(worse(worse(free, let_through), RANK_TOLERANCE))
}
