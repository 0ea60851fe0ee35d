//! Long runs, and runs that start late.

use std::f64::consts::{FRAC_PI_2, TAU};

use models::{DoublePendulum, KapitzaPendulum, Model, Pendulum, StartOptions};
use ukcore::manifold::Projector;
use ukcore::{Error, Method, Simulation};

use super::{end, off, swung, worse};
use uktool::stability::{Case, Effort, decades};

pub(crate) fn cases() -> Vec<Case<'static>> {
    vec![
        Case {
            id: "long-pendulum",
            swept: "duration of a pendulum's swing, s".into(),
            oracle: "energy, and the closed form at the end",
            accurate: 1e-6,
            bound: 1e-3,
            sweep: decades(0, 4, 1, 0),
            measure: Box::new(long_pendulum),
        },
        Case {
            id: "long-double",
            swept: "duration of a double pendulum's swing, s".into(),
            oracle: "energy, as a part of that exchanged",
            accurate: 1e-7,
            bound: 1e-4,
            sweep: decades(0, 4, 1, 0),
            measure: Box::new(|duration, effort| long_double(duration, Method::Dop853, effort)),
        },
        Case {
            id: "long-rattle",
            swept:
                "duration of a double pendulum's swing, s, by RATTLE of order 4 with steps of 5 ms"
                    .into(),
            oracle: "energy, as a part of that exchanged",
            accurate: 1e-5,
            bound: 1e-3,
            sweep: decades(0, 4, 1, 0),
            measure: Box::new(|duration, effort| long_double(duration, RATTLE, effort)),
        },
        Case {
            id: "late-pendulum",
            swept: "time at which a pendulum starts, s; one second of motion".into(),
            oracle: "closed form",
            accurate: 1e-8,
            bound: 1e-5,
            sweep: decades(0, 15, 1, 0),
            measure: Box::new(late_pendulum),
        },
        Case {
            id: "late-start",
            swept: "time at which Kapitza's pendulum starts, in periods of its drive (1 s)".into(),
            oracle: "the same start at t = 0",
            accurate: 1e-6,
            bound: 1e-3,
            sweep: decades(0, 16, 1, 0),
            measure: Box::new(late_start),
        },
    ]
}

fn long_pendulum(duration: f64, effort: &mut Effort) -> Result<f64, Error> {
    let pendulum = Pendulum::default();
    let from = -1.0;
    let start = pendulum.start("released", &StartOptions::new().with("from", from))?;
    let simulation = Simulation::new(pendulum).start(start);
    let simulation = simulation.tolerance(1e-12).every(duration / 100.0);
    let run = effort.run(simulation, duration)?;
    let apart = off(&end(&run), &swung(from, duration));
    Ok(worse(run.energy_drift(), apart))
}

const RATTLE: Method = Method::Rattle { step: 5e-3 };

fn long_double(duration: f64, method: Method, effort: &mut Effort) -> Result<f64, Error> {
    let double = DoublePendulum::default();
    let start = double.default_start()?;
    let simulation = Simulation::new(double).start(start).method(method);
    let simulation = simulation.tolerance(1e-12).every(duration / 1000.0);
    Ok(effort.run(simulation, duration)?.energy_drift())
}

/// Nothing in a pendulum depends on the time, but its steps do.
fn late_pendulum(start: f64, effort: &mut Effort) -> Result<f64, Error> {
    let pendulum = Pendulum::default();
    let mut state = pendulum.default_start()?;
    state.t = start;
    let until = start + 1.0;
    let simulation = Simulation::new(pendulum).start(state);
    let run = effort.run(simulation.tolerance(1e-10), until)?;
    // What is left of one second.
    Ok(off(&end(&run), &swung(-FRAC_PI_2, until - start)))
}

/// A slow drive with a period of one second: a whole number of periods later nothing is different, but for the rounding of w t.
fn late_start(periods: f64, effort: &mut Effort) -> Result<f64, Error> {
    let kapitza = KapitzaPendulum {
        w: TAU,
        ..KapitzaPendulum::default()
    };
    let start = kapitza.start("hanging", &StartOptions::new())?;
    let mut ends = Vec::new();
    for t in [0.0, periods] {
        let mut start = start.clone();
        start.t = t;
        // The pivot's velocity at the late time, which is rounded, is not quite that at t = 0.
        let mut projector = Projector::new(&kapitza);
        projector.position(t, &mut start.q, &start.v)?;
        projector.velocity(t, &start.q, &mut start.v)?;
        let simulation = Simulation::new(kapitza.clone())
            .start(start)
            .tolerance(1e-8);
        let run = effort.run(simulation, t + 2.0)?;
        ends.push(end(&run));
    }
    Ok(off(&ends[1], &ends[0]))
}
