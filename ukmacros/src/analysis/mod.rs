//! From equations of a mechanism to what is emitted: derivatives, structure, checks, the solve, programs and their costs.

mod check;
mod choice;
mod constants;
mod cost;
mod dynamics;
mod elimination;
mod frame;
mod functions;
mod groups;
mod hoist;
mod hub;
mod joint;
mod lift;
mod phases;
mod reactions;
mod redundant;
mod regular;
mod schedule;
mod share;
mod sparsity;
mod structure;
mod switches;
mod verify;

pub(crate) use check::check;
#[cfg(test)]
pub(crate) use constants::ASSOCIATED;
pub(crate) use constants::{Constant, ConstantValue, Positions, constants};
#[cfg(test)]
pub(crate) use cost::cost;
pub(crate) use cost::{Costs, Operations};
pub(crate) use dynamics::{Dynamics, derive};
#[cfg(test)]
pub(crate) use elimination::{Further, Straight, Task, eliminate, orders};
pub(crate) use elimination::{Pair, Pivoting, Rotation, Solve};
#[cfg(test)]
pub(crate) use frame::{Turned, opened, turned};
pub(crate) use functions::{Function, Place, Role, Slice, of_parameters};
#[cfg(test)]
pub(crate) use regular::Regular;
pub(crate) use schedule::{Program, Step};
#[cfg(test)]
pub(crate) use share::shared;
pub(crate) use structure::Structure;
pub(crate) use switches::Switch;
pub(crate) use verify::verify;

use crate::expr::{Id, System};
use crate::model::Model;
use choice::{Chosen, choose};

/// What is known about a mechanism, and the programs that compute it.
pub(crate) struct Analysis {
    /// The equations, to be read.
    pub(crate) dynamics: Dynamics,
    pub(crate) structure: Structure,
    pub(crate) switches: Vec<Switch>,
    /// How q̈ is solved for, or why there is no straight line.
    pub(crate) solve: Result<Solve, String>,
    /// Values that depend on parameters only.
    pub(crate) prepared: Vec<Id>,
    /// Switching functions, as they are computed.
    pub(crate) switching: Vec<Id>,
    pub(crate) functions: Vec<Function>,
    pub(crate) costs: Costs,
    /// Why reactions that are used cannot be solved for.
    pub(crate) unsolved: Option<String>,
    /// A value that hoisting changed, looked for in debug builds: a defect of this compiler.
    pub(crate) defect: Option<usize>,
}

/// Analyses equations without errors.
pub(crate) fn analyse(system: &mut System, model: &Model, dynamics: Dynamics) -> Analysis {
    let coordinates = model.coord_elements.iter().map(|c| c.name.clone());
    let constraints = system.constraints.iter().map(|c| c.item.text());
    let names: Vec<String> = coordinates.chain(constraints).collect();
    let structure = structure::structure(system, &dynamics, model);
    let (mut held, [switches, mut located]) = switches::hold(system, &dynamics, &names);
    phases::shared(system, &mut held);
    let mut regular = regular::regular(system, &held);
    // The listing shows switches as they are declared, and reactions by their names.
    let solved = reactions::solve(system, &mut held, &mut regular, &mut located, &names);
    let Chosen {
        solve,
        straight,
        hoisted,
        functions,
        costs,
    } = choose(system, &held, &regular, &located, &names);
    let defect = cfg!(debug_assertions)
        .then(|| hoist::verify(system, &held, &straight, &hoisted, &functions))
        .flatten();
    Analysis {
        dynamics,
        structure,
        switches,
        solve,
        prepared: hoisted.values,
        switching: hoisted.switches,
        unsolved: solved.err(),
        functions,
        costs,
        defect,
    }
}
