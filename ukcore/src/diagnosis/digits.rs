//! Why the straight line is left at a state, in names.

use super::light::light;
use super::{diagnose, quoted};
use crate::assemble::State;
use crate::mechanism::Prepared;
use crate::solver::{RANK_CEILING, Solver, SolverOptions, doubtful};

/// So many constraints are named where there are many.
const NAMED: usize = 6;

/// Says in a clause why accelerations at `state` are left to the dense solve, by the constraints or the body that have it so; `None` where
/// the emitted elimination serves, or where that is unknown.
pub fn lost_digits(mechanism: impl Into<Prepared>, state: &State) -> Option<String> {
    let mech: Prepared = mechanism.into();
    let spec = mech.spec();
    let State { t, q, v } = state;
    let mut acceleration = vec![0.0; q.len()];
    let mut solver = Solver::new(&mech, SolverOptions::default());
    let solved = solver.acceleration(*t, q, v, &mut acceleration);
    if !spec.structure.straight_line || solved.is_err() || solver.work().fallbacks == 0 {
        return None;
    }
    let certificate = mech.acceleration(*t, q, v, &mut acceleration);
    let found = diagnose(&mech, state).ok()?;
    let names: Vec<String> = match doubtful(certificate) {
        true => found.nearest.clone(),
        // All pivots are safe: inertias alone are in doubt.
        false => spec.constraints.iter().map(|c| c.name.to_owned()).collect(),
    };
    if let Some(body) = light(&mech, state, &names) {
        return Some(match doubtful(certificate) {
            true => format!(
                "`{body}` is so light beside what {} join it to that they all but imply each other",
                few(&names)
            ),
            false => format!("`{body}` is many times lighter than what constraints tie it to"),
        });
    }
    let rows = few(&found.nearest);
    match found.margin < RANK_CEILING {
        true if !found.nearest.is_empty() => Some(format!(
            "{rows} come near to implying each other, by a margin of {:.1e}",
            found.margin
        )),
        _ => None,
    }
}

/// The first of these names, where there are many, and how many others there are.
fn few(names: &[String]) -> String {
    match names.get(..NAMED) {
        Some(first) if names.len() > NAMED + 1 => {
            format!("{} and {} others", quoted(first), names.len() - NAMED)
        }
        _ => quoted(names),
    }
}
