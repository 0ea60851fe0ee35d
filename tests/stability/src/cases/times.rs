//! Long runs, and runs that start late.

use std::f64::consts::{FRAC_PI_2, TAU};

use models::{DoublePendulum, KapitzaPendulum, Model, Pendulum, StartOptions};
use ukcore::manifold::Projector;
use ukcore::{Error, Method, Simulation};

use super::{end, off, swung, worse};
use uktool::stability::{Case, Effort, decades};

pub(crate) fn cases() -> Vec<Case<'static>> {
    vec![
        Case::new("long-pendulum", long_pendulum)
            .swept("duration of a pendulum's swing, s")
            .over(decades(0, 4, 1, 0))
            .against("energy, and the closed form at the end")
            .within(1e-6, 1e-3),
        Case::new("long-double", |duration, effort| {
            long_double(duration, Method::Dop853, effort)
        })
        .swept("duration of a double pendulum's swing, s")
        .over(decades(0, 4, 1, 0))
        .against("energy, as a part of that exchanged")
        .within(1e-7, 1e-4),
        Case::new("long-rattle", |duration, effort| {
            long_double(duration, RATTLE, effort)
        })
        .swept("duration of a double pendulum's swing, s, by RATTLE of order 4 with steps of 5 ms")
        .over(decades(0, 4, 1, 0))
        .against("energy, as a part of that exchanged")
        .within(1e-5, 1e-3),
        Case::new("late-pendulum", late_pendulum)
            .swept("time at which a pendulum starts, s; one second of motion")
            .over(decades(0, 15, 1, 0))
            .against("closed form")
            .within(1e-8, 1e-5),
        Case::new("late-start", late_start)
            .swept("time at which Kapitza's pendulum starts, in periods of its drive (1 s)")
            .over(decades(0, 16, 1, 0))
            .against("the same start at t = 0")
            .within(1e-6, 1e-3),
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
