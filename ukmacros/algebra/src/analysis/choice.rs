//! The solve that costs least, among those that the equations allow.

use super::cost::{Costs, cost, costs};
use super::dynamics::Dynamics;
use super::elimination::{Further, Order, Solve, Straight, Task, eliminate, orders};
use super::frame::{Turned, opened, turned};
use super::functions::{Function, acceleration, functions};
use super::hoist::{Hoisted, hoist};
use super::hub::{Divided, divided};
use super::regular::Regular;
use super::switches::Switch;
use crate::expr::{Graph, Id, Map, System};
use std::collections::BTreeSet;
use std::mem::take;

/// The equations as they are emitted.
pub(super) struct Chosen {
    /// The solve, or why there is none.
    pub(super) solve: Result<Solve, String>,
    pub(super) straight: Result<Straight, String>,
    pub(super) hoisted: Hoisted,
    pub(super) functions: Vec<Function>,
    pub(super) costs: Costs,
}

/// Operations for each entry that an elimination changes, as it was found for all kinds of mechanisms. By such a guess ways that come
/// within a quarter of the least are tried; the true counts decide among them.
const PER_ENTRY: usize = 4;

/// A system whose solution has the accelerations in it.
pub(super) struct Variant {
    dynamics: Dynamics,
    names: Vec<String>,
    further: Further,
    /// The hubs whose copies it has.
    copies: Vec<usize>,
    turned: Turned,
}

impl Variant {
    /// The equations themselves.
    fn own(regular: &Regular, names: &[String]) -> Self {
        Variant {
            dynamics: regular.dynamics.clone(),
            names: names.to_vec(),
            further: Further::Nothing,
            copies: Vec::new(),
            turned: Turned::default(),
        }
    }

    /// The elimination of the variant, for a mechanism with `own` coordinates and constraints; with the multipliers of the equations given,
    /// if there are.
    pub(super) fn task<'a>(
        &'a self,
        regular: &'a Regular,
        own: (usize, usize),
        multipliers: Option<&'a Dynamics>,
    ) -> Task<'a> {
        Task {
            dynamics: &self.dynamics,
            // Nothing was added to M where coordinates are turned.
            weights: match self.turned.is_empty() {
                true => &regular.weights,
                false => &[],
            },
            names: &self.names,
            own,
            further: self.further,
            redundant: &regular.redundant.rows,
            turned: &self.turned,
            multipliers,
        }
    }
}

/// The nodes that a way to solve begins with, or ends with, and their names.
type Nodes = (Graph, Map<Id, String>);

/// A way that was gone to its end.
struct Tried {
    /// What its accelerations cost; nothing where there is no other way.
    work: usize,
    straight: Result<Straight, String>,
    hoisted: Hoisted,
    /// The place of the system among the variants.
    at: usize,
    nodes: Nodes,
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
    let own = (held.force.len(), held.rhs.len());
    let refused = |refusal: String, system: &mut System| {
        let straight = Err(refusal);
        let hoisted = hoist(system, held, &straight, switches);
        emitted(system, straight, hoisted, names)
    };
    if let Some(refusal) = regular.refusal(names) {
        return refused(refusal, system);
    }
    let variants = variants(system, held, regular, names);
    // Why the first way that does not go does not.
    let mut refusal = None;
    let tasks = variants.iter();
    let tasks = tasks.map(|variant| variant.task(regular, own, None));
    let tasks: Vec<Task<'_>> = tasks.collect();
    let ways = ways(&tasks, system, &mut refusal);
    let base =
        (ways.len() > 1).then(|| -> Nodes { (system.graph.clone(), system.inner_hints.clone()) });
    let mut best: Option<Tried> = None;
    for (at, order) in ways {
        if let Some(base) = &base {
            (system.graph, system.inner_hints) = base.clone();
        }
        let straight = match eliminate(&tasks[at], order, &mut system.graph) {
            Ok(elimination) => Straight::new(elimination, held, regular, system),
            Err(text) => {
                refusal.get_or_insert(text);
                continue;
            }
        };
        let straight = Ok(straight);
        let hoisted = hoist(system, held, &straight, switches);
        let work = base.as_ref().and_then(|_| acceleration(system, &hoisted));
        let work = work.map_or(0, |function| function.operations.work());
        if best.as_ref().is_none_or(|best| work < best.work) {
            best = Some(Tried {
                work,
                straight,
                hoisted,
                at,
                nodes: (take(&mut system.graph), take(&mut system.inner_hints)),
            });
        }
    }
    if let Some(best) = best {
        (system.graph, system.inner_hints) = best.nodes;
        let mut chosen = emitted(system, best.straight, best.hoisted, names);
        if let Ok(solve) = &mut chosen.solve {
            let variant = &variants[best.at];
            solve.solved = variant.turned.rows().copied().collect();
            if solve.turned.is_empty() {
                solve.regular.clone_from(&regular.rows);
            }
            solve.copies.clone_from(&variant.copies);
            if variant.further == Further::Velocities {
                let further = own.0..variant.dynamics.force.len();
                solve.velocities = variant.names[further].to_vec();
            }
        }
        return chosen;
    }
    if let Some(base) = base {
        (system.graph, system.inner_hints) = base;
    }
    refused(refusal.unwrap_or_default(), system)
}

/// The orders that are worth a try, each with the place of its system among the `tasks`; the first reason against one goes into `refusal`.
fn ways(tasks: &[Task<'_>], system: &System, refusal: &mut Option<String>) -> Vec<(usize, Order)> {
    let mut ways = Vec::new();
    for (at, task) in tasks.iter().enumerate() {
        let given = given(task.dynamics, &system.graph);
        match orders(task, &system.defaults, &system.graph) {
            Ok(orders) => ways.extend(orders.into_iter().map(|order| {
                let guess = given + PER_ENTRY * order.changes;
                (guess, at, order)
            })),
            Err(text) => drop(refusal.get_or_insert(text)),
        }
    }
    let least = ways.iter().map(|(guess, ..)| *guess).min().unwrap_or(0);
    ways.retain(|(guess, ..)| 4 * guess <= 5 * least);
    ways.into_iter().map(|(_, at, order)| (at, order)).collect()
}

/// Operations of the entries of a system before its elimination.
fn given(d: &Dynamics, g: &Graph) -> usize {
    let matrices = d.mass.values().chain(d.jacobian.values());
    let all: Vec<Id> = matrices.chain(&d.force).chain(&d.rhs).copied().collect();
    cost(g, &all).work()
}

/// The systems that are worth a try: the equations themselves, with the velocities that the kinetic energy is written in, with copies of
/// hubs.
fn variants(
    system: &mut System,
    held: &Dynamics,
    regular: &Regular,
    names: &[String],
) -> Vec<Variant> {
    let mut variants = vec![Variant::own(regular, names)];
    variants.extend(with_velocities(system, held, regular, names));
    if let Some(Divided { dynamics, copies }) = divided(&regular.dynamics, &mut system.graph) {
        let more = copies.iter().enumerate();
        let more = more.map(|(k, hub)| format!("{}_{k}", names[*hub]));
        let more: Vec<String> = more.collect();
        variants.push(Variant {
            dynamics,
            names: with_more(names, &more, held.force.len()),
            further: Further::Copies,
            copies,
            turned: Turned::default(),
        });
    }
    variants
}

/// The names of coordinates, `n` of them, and of constraints with those of `more` unknowns and the constraints that define them.
fn with_more(names: &[String], more: &[String], n: usize) -> Vec<String> {
    let (coordinates, constraints) = names.split_at(n);
    [coordinates, more, constraints, more].concat()
}

/// The equations with the velocities that the kinetic energy is written in: in rates of turning, where there are frames.
fn with_velocities(
    system: &mut System,
    held: &Dynamics,
    regular: &Regular,
    names: &[String],
) -> Vec<Variant> {
    let Some(lift) = &held.lift else {
        return Vec::new();
    };
    let g = &mut system.graph;
    let opened = opened(held, lift, &system.defaults, g);
    let lift = opened.as_ref().unwrap_or(lift);
    let velocities = lift.velocities().enumerate();
    let velocities = velocities.map(|(k, id)| match system.hints.get(&id) {
        Some(name) => name.clone(),
        None => format!("velocity_{k}"),
    });
    let velocities: Vec<String> = velocities.collect();
    let (rows, redundant, defaults) = (&regular.rows, &regular.redundant.rows, &system.defaults);
    let of = |before: &_, g: &mut _| turned(held, lift, rows, redundant, before, defaults, g);
    let mut found = Vec::new();
    match of(&BTreeSet::new(), g) {
        Some(turned) => {
            let before = turned.1.cheaper_before();
            found.push(turned);
            if !before.is_empty() {
                found.extend(of(&before, g));
            }
        }
        None => {
            let (mass, force) = (&regular.added, &regular.pulled);
            let extended = lift.extended(&regular.dynamics, mass, force, g);
            found.push((extended, Turned::default()));
        }
    }
    let found = found.into_iter().map(|(dynamics, turned)| Variant {
        dynamics,
        names: with_more(names, &velocities, held.force.len()),
        further: Further::Velocities,
        copies: Vec::new(),
        turned,
    });
    found.collect()
}

/// The system whose multipliers reactions are: in rates of turning where there are frames, for in coordinates that are turned as a whole,
/// as a quaternion, there are always some that a constraint all but leaves alone.
pub(super) fn for_multipliers(
    system: &mut System,
    held: &Dynamics,
    regular: &Regular,
    names: &[String],
) -> Variant {
    let turned = with_velocities(system, held, regular, names).into_iter();
    let mut turned = turned.filter(|variant| !variant.turned.is_empty());
    turned
        .next()
        .unwrap_or_else(|| Variant::own(regular, names))
}

/// What is emitted with the given solve.
fn emitted(
    system: &mut System,
    straight: Result<Straight, String>,
    hoisted: Hoisted,
    names: &[String],
) -> Chosen {
    let solve = straight.as_ref().map(Straight::told);
    let solve = solve.map_err(String::clone);
    let functions = functions(system, &hoisted);
    let costs = costs(
        &functions,
        names.len(),
        straight.as_ref().ok(),
        &mut system.graph,
    );
    Chosen {
        solve,
        straight,
        hoisted,
        functions,
        costs,
    }
}
