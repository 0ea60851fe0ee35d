//! The solve that costs least, among those that the equations allow.

use super::cost::{Costs, costs};
use super::dynamics::Dynamics;
use super::elimination::{Order, Solve, Straight, Task, eliminate, orders};
use super::functions::{Function, Role, functions};
use super::hoist::{Hoisted, hoist};
use super::regular::Regular;
use super::switches::Switch;
use crate::expr::{Graph, Id, System};
use std::collections::HashMap;

/// The equations as they are emitted.
pub(super) struct Chosen {
    /// The solve, or why there is none.
    pub(super) solve: Result<Solve, String>,
    pub(super) straight: Result<Straight, String>,
    pub(super) hoisted: Hoisted,
    pub(super) functions: Vec<Function>,
    pub(super) costs: Costs,
}

/// Orders that change so many times the entries of another are not tried.
const WORSE: usize = 2;

/// One way to solve: a system, and the order of its elimination.
struct Way {
    /// With the velocities that the kinetic energy is written in as further coordinates.
    lifted: bool,
    order: Order,
}

/// What each way begins with.
struct Base {
    graph: Graph,
    hints: HashMap<Id, String>,
}

/// Takes the way whose accelerations cost least; `held` are the equations, with `regular` made of them, `names` those of coordinates and
/// constraints.
pub(super) fn choose(
    system: &mut System,
    held: &Dynamics,
    regular: &Regular,
    switches: &[Switch],
    names: &[String],
) -> Chosen {
    let lifted = lifted(system, held, regular, names);
    let own = (held.force.len(), held.rhs.len());
    let plain = Task {
        dynamics: &regular.dynamics,
        weights: &regular.weights,
        names,
        own,
    };
    let further = lifted.as_ref().map(|(dynamics, names)| Task {
        dynamics,
        weights: &regular.weights,
        names,
        own,
    });
    let mut ways = Vec::new();
    let mut refusal = regular.refusal(names);
    for (lifted, task) in [(false, Some(&plain)), (true, further.as_ref())] {
        let Some(task) = task.filter(|_| regular.refusal(names).is_none()) else {
            continue;
        };
        match orders(task, &system.defaults, &system.graph) {
            Ok(mut orders) => {
                let least = orders.iter().map(|order| order.changes).min();
                let bound = WORSE * least.unwrap_or(0);
                orders.retain(|order| order.changes <= bound);
                ways.extend(orders.into_iter().map(|order| Way { lifted, order }));
            }
            Err(text) => drop(refusal.get_or_insert(text)),
        }
    }
    let base = (ways.len() > 1).then(|| Base {
        graph: system.graph.clone(),
        hints: system.inner_hints.clone(),
    });
    let mut best: Option<(Chosen, Base)> = None;
    for way in ways {
        if let Some(base) = &base {
            system.graph = base.graph.clone();
            system.inner_hints = base.hints.clone();
        }
        let task = match (way.lifted, &further) {
            (true, Some(task)) => task,
            _ => &plain,
        };
        if std::env::var("WORK").is_ok() {
            let c = |ids: &[Id]| super::cost::cost(&system.graph, ids).work();
            let all: Vec<Id> = held.mass.values().copied().collect();
            eprintln!("way force {} mass {}", c(&held.force), c(&all));
            eprintln!("way {}", way.order.changes);
            eprintln!("{}", way.order.text(task.names));
        }
        let straight = match eliminate(task, way.order, &mut system.graph) {
            Ok(elimination) => Straight::new(elimination, held, &regular.met, system),
            Err(text) => {
                refusal.get_or_insert(text);
                continue;
            }
        };
        let chosen = emitted(system, held, Ok(straight), regular, switches, names);
        if std::env::var("WORK").is_ok() {
            eprintln!(
                "way {:?} {}",
                chosen.solve.as_ref().map(|s| s.velocities.len()),
                work(&chosen)
            );
        }
        let better = |(known, _): &(Chosen, Base)| work(&chosen) < work(known);
        if best.as_ref().is_none_or(better) {
            let graph = std::mem::take(&mut system.graph);
            let hints = std::mem::take(&mut system.inner_hints);
            best = Some((chosen, Base { graph, hints }));
        }
    }
    match best {
        Some((chosen, taken)) => {
            (system.graph, system.inner_hints) = (taken.graph, taken.hints);
            chosen
        }
        None => {
            if let Some(base) = base {
                (system.graph, system.inner_hints) = (base.graph, base.hints);
            }
            let refusal = refusal.unwrap_or_default();
            emitted(system, held, Err(refusal), regular, switches, names)
        }
    }
}

/// Operations of one evaluation.
fn work(chosen: &Chosen) -> usize {
    let functions = chosen.functions.iter();
    let mut acceleration = functions.filter(|f| f.role == Role::Acceleration);
    acceleration
        .next()
        .map_or(usize::MAX, |f| f.operations.work())
}

/// The equations with the velocities that the kinetic energy is written in, and all names, if it is written so.
fn lifted(
    system: &mut System,
    held: &Dynamics,
    regular: &Regular,
    names: &[String],
) -> Option<(Dynamics, Vec<String>)> {
    let lift = held.lift.as_ref()?;
    let (mass, force) = (&regular.added, &regular.pulled);
    let dynamics = lift.extended(&regular.dynamics, mass, force, &mut system.graph);
    let (coordinates, constraints) = names.split_at(held.force.len());
    let velocities = lift.velocities().enumerate();
    let velocities = velocities.map(|(k, id)| match system.hints.get(&id) {
        Some(name) => name.clone(),
        None => format!("velocity_{k}"),
    });
    let velocities: Vec<String> = velocities.collect();
    Some((
        dynamics,
        [coordinates, &velocities, constraints, &velocities].concat(),
    ))
}

/// What is emitted with the given solve.
fn emitted(
    system: &mut System,
    held: &Dynamics,
    straight: Result<Straight, String>,
    regular: &Regular,
    switches: &[Switch],
    names: &[String],
) -> Chosen {
    let solve = straight.as_ref().map(|straight| Solve {
        regular: regular.rows.clone(),
        ..straight.told()
    });
    let solve = solve.map_err(String::clone);
    let hoisted = hoist(system, held, &straight, switches);
    let functions = functions(system, &hoisted);
    let costs = costs(
        &functions,
        names.len(),
        straight.as_ref().ok(),
        &system.graph,
    );
    Chosen {
        solve,
        straight,
        hoisted,
        functions,
        costs,
    }
}
