//! Multipliers of ideal constraint forces in expressions: what they are solved to, in place of their symbols.
//!
//! Zhao, Zhen & Chen 2013, eq. 8: the force of the constraints is Aᵀλ + (what of c they leave), with λ of the equations without c. So λ is
//! known before c, and c may depend on it: M q̈ = Q + Aᵀλ, A q̈ = b is eliminated first, and its λ are values of the state like any others.
//! Where the pivots are those of the equations with c, they are the same nodes, computed once.
//!
//! λ of a row is unique where no dependence of rows of A has it. Where it takes part in what rows that are left out follow from, or the
//! certificate of the elimination does not hold, it is not a number, and so is what depends on it.

use super::choice::for_multipliers;
use super::dynamics::Dynamics;
use super::elimination::{Straight, eliminate, orders};
use super::regular::Regular;
use super::switches::Switch;
use crate::expr::{Graph, Id, Node, Symbol, System};

/// Puts λ of the equations `held`, of which `regular` was made, in place of [`Symbol::Multiplier`] in c, in switching functions, outputs,
/// integrals and pictures; `names` are those of coordinates and constraints. Nothing happens where none is used. Says so if λ cannot be
/// solved for.
pub(super) fn solve(
    system: &mut System,
    held: &mut Dynamics,
    regular: &mut Regular,
    switches: &mut [Switch],
    names: &[String],
) -> Result<(), String> {
    let used = |g: &Graph, mut ids: Vec<&mut Id>| ids.iter_mut().any(|id| g.uses(**id).multiplier);
    let (g, places) = places(system, held, regular, switches);
    if !used(g, places) {
        return Ok(());
    }
    let solved = multipliers(system, held, regular, names)?;
    let (g, places) = self::places(system, held, regular, switches);
    let roots: Vec<Id> = places.iter().map(|id| **id).collect();
    let order = g.reachable(&roots);
    let mut known = g.rewritten(&order, |g, id, _| match *g.node(id) {
        Node::Symbol(Symbol::Multiplier(row)) => Some(solved[row]),
        _ => None,
    });
    for (place, root) in places.into_iter().zip(roots) {
        *place = known[&root];
    }
    known.retain(|old, new| old != new);
    system.carry_names(&known);
    Ok(())
}

/// All values that may depend on multipliers.
fn places<'a>(
    system: &'a mut System,
    held: &'a mut Dynamics,
    regular: &'a mut Regular,
    switches: &'a mut [Switch],
) -> (&'a mut Graph, Vec<&'a mut Id>) {
    let reported = system.outputs.iter_mut().chain(&mut system.integrals);
    let forces = held
        .nonideal
        .iter_mut()
        .chain(&mut regular.dynamics.nonideal);
    let drawn = system.drawing.shapes.iter_mut();
    let drawn = drawn.flat_map(|shape| &mut shape.numbers);
    let places = reported.map(|o| &mut o.value).chain(drawn).chain(forces);
    let places = places.chain(switches.iter_mut().map(|s| &mut s.function));
    (&mut system.graph, places.collect())
}

/// λ of each constraint without c, not a number where it is not unique.
fn multipliers(
    system: &mut System,
    held: &Dynamics,
    regular: &Regular,
    names: &[String],
) -> Result<Vec<Id>, String> {
    if let Some(refusal) = regular.refusal(names) {
        return Err(refusal);
    }
    let none = system.graph.zero();
    let (mut held, mut regular) = (held.clone(), regular.clone());
    held.nonideal.fill(none);
    regular.dynamics.nonideal.fill(none);
    let variant = for_multipliers(system, &held, &regular, names);
    let own = (held.force.len(), held.rhs.len());
    let task = variant.task(&regular, own, Some(&regular.dynamics));
    let mut orders = orders(&task, &system.defaults, &system.graph)?;
    // Where inertia may be zero a multiplier is still unique; by a division through it it would not be known.
    orders.sort_by_key(|order| {
        let inertias = order.inertias(task.dynamics, &system.graph);
        (inertias, order.changes)
    });
    let mut elimination = Err("there is no order of elimination".to_owned());
    for order in orders {
        elimination = elimination.or_else(|_| eliminate(&task, order, &mut system.graph));
    }
    let elimination = elimination?;
    let straight = Straight::new(elimination, &held, &regular, system);
    let g = &mut system.graph;
    let unique = straight
        .elimination
        .unique(&straight.met, &held, &regular, g);
    let multipliers = straight
        .elimination
        .multipliers
        .iter()
        .zip(&unique)
        .zip(&system.constraints);
    let multipliers = multipliers.map(|((id, unique), constraint)| {
        let value = g.mul(*id, *unique);
        let name = format!("reaction_{}", constraint.item.text());
        if !g.operands(value).is_empty() {
            system.inner_hints.entry(value).or_insert(name);
        }
        value
    });
    let multipliers = multipliers.collect();
    system.unique = unique;
    Ok(multipliers)
}
