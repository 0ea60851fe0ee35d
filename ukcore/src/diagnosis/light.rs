//! Bodies so light beside others that what holds them in place all but follows from what holds these.

use crate::assemble::State;
use crate::displacements::{constraint_matrix, mass_matrix};
use crate::mechanism::Prepared;

/// A body is light that has less than this part of what another one has.
const LIGHT: f64 = 1e-4;

/// The body that the constraints called `names` move most for the inertia it has, if that is nothing beside what another one in them has.
pub(super) fn light(mech: &Prepared, state: &State, names: &[String]) -> Option<&'static str> {
    let spec = mech.spec();
    let (mass, rows) = (mass_matrix(mech, state), constraint_matrix(mech, state));
    let rows: Vec<_> = (0..spec.m())
        .filter(|row| names.iter().any(|name| name == spec.constraints[*row].name))
        .map(|row| rows.row(row).into_owned())
        .collect();
    // Body, lengths or orientation, mean inertia, and the squares of what the rows have of it by that.
    let mut parts: Vec<(&str, usize, f64, f64)> = Vec::new();
    for body in spec.structure.bodies {
        for (kind, own) in body.coordinates().into_iter().enumerate() {
            let sum: f64 = own.clone().map(|j| mass[(j, j)]).sum();
            let inertia = sum / own.len() as f64;
            let moved = rows.iter().flat_map(|row| own.clone().map(|j| row[j]));
            let moved: f64 = moved.map(|a| a * a).sum();
            if moved > 0.0 && inertia > 0.0 {
                parts.push((body.name, kind, inertia, moved / inertia));
            }
        }
    }
    let most = parts.iter().max_by(|a, b| a.3.total_cmp(&b.3))?;
    let heavier = |part: &&(&str, usize, f64, f64)| part.1 == most.1 && most.2 < LIGHT * part.2;
    parts.iter().find(heavier).map(|_| most.0)
}
