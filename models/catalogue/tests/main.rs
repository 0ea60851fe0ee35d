//! The mechanisms of the catalogue against what is published of them, or known in closed form.

mod andrews;
mod arm;
mod bicycle;
mod bricard;
mod freedoms;
mod governor;
mod heavy_top;
mod jansen;
mod pose;
mod rolling_disc;
mod stewart;

use ukcore::model::StartOptions;
use ukcore::{Mechanism, Simulation, State, Trajectory};

/// The first start that is declared.
fn start<M: Mechanism>(mechanism: &M) -> State {
    let start = mechanism
        .prepared()
        .start(M::SPEC.starts[0].name, &StartOptions::new());
    start.unwrap_or_else(|e| panic!("{}: {e}", M::SPEC.name))
}

/// A run from the default start to `end`, with samples each `every`, s.
fn run<M: Mechanism>(tolerance: f64, every: f64, end: f64) -> Trajectory {
    let mechanism = M::default();
    let start = start(&mechanism);
    Simulation::new(mechanism)
        .tolerance(tolerance)
        .start(start)
        .every(every)
        .until(end)
        .unwrap_or_else(|e| panic!("{}: {e}", M::SPEC.name))
}
