//! The mechanisms of the catalogue against what is published of them, or known in closed form.

mod andrews;
mod arm;
mod bicycle;
mod bricard;
mod freedoms;
mod governor;
mod heavy_top;
mod jansen;
mod rolling_disc;
mod stewart;

use ukcore::model::Model;
use ukcore::{Simulation, Trajectory};

/// A run from the default start to `end`, with samples each `every`, s.
fn run<M: Model>(tolerance: f64, every: f64, end: f64) -> Trajectory {
    let mechanism = M::default();
    let start = mechanism.default_start().expect("a start");
    Simulation::new(mechanism)
        .tolerance(tolerance)
        .start(start)
        .every(every)
        .until(end)
        .unwrap_or_else(|e| panic!("{}: {e}", M::SPEC.name))
}
