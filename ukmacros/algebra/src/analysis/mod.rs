//! From equations of a mechanism to what is emitted: derivatives, structure, the solve, programs and their costs.

mod choice;
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
mod structure;
mod switches;
mod verify;

pub use cost::cost;
pub use cost::{Costs, Operations};
pub use dynamics::{Dynamics, derive};
pub use elimination::{Further, Straight, Task, eliminate, orders};
pub use elimination::{Pair, Pivoting, Rotation, Solve};
pub use frame::{Turned, opened, turned};
pub use functions::{Function, Place, Role, Slice, of_parameters};
pub use regular::Regular;
pub use schedule::{Program, Step};
pub use share::shared;
pub use structure::Structure;
pub use switches::Switch;
pub use verify::verify;

use crate::expr::{Coordinates, Id, System};
use choice::{Chosen, choose};

/// What is known about a mechanism, and the programs that compute it.
pub struct Analysis {
    /// The equations, to be read.
    pub dynamics: Dynamics,
    pub structure: Structure,
    pub switches: Vec<Switch>,
    /// How q̈ is solved for, or why there is no straight line.
    pub solve: Result<Solve, String>,
    /// Values that depend on parameters only.
    pub prepared: Vec<Id>,
    /// Switching functions, as they are computed.
    pub switching: Vec<Id>,
    pub functions: Vec<Function>,
    pub costs: Costs,
    /// Why reactions that are used cannot be solved for.
    pub unsolved: Option<String>,
    /// A value that hoisting changed, if that was looked for: a defect of this compiler.
    pub defect: Option<usize>,
}

/// Analyses equations without errors. Whether hoisting has changed a value is looked for where it is to be `checked`.
pub fn analyse(
    system: &mut System,
    coordinates: &Coordinates,
    dynamics: Dynamics,
    checked: bool,
) -> Analysis {
    let constraints = system.constraints.iter().map(|c| c.item.text());
    let names: Vec<String> = coordinates
        .names
        .iter()
        .cloned()
        .chain(constraints)
        .collect();
    let structure = structure::structure(system, &dynamics, coordinates);
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
    let defect = checked
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
