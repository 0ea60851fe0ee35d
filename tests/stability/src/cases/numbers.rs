//! Units, many turns, and steps at the edge of what numbers can hold.

use std::f64::consts::{FRAC_PI_2, TAU};

use models::{DoublePendulumAngles, Model, Pendulum, UChain};
use ukcore::{Error, Simulation, State};

use super::{end, off, swung, worse};
use uktool::stability::{Case, Effort, Sweep, decades};

pub(crate) fn cases() -> Vec<Case<'static>> {
    let si = "the motion in SI units, scaled";
    vec![
        Case::new("unit-length", |s, effort| in_units(s, 1.0, 1.0, effort))
            .swept("unit of length of a U-chain's fall")
            .over(decades(-30, 30, 3, 0))
            .against(si)
            .within(1e-7, 1e-4),
        Case::new("unit-mass", |s, effort| in_units(1.0, s, 1.0, effort))
            .swept("unit of mass of a U-chain's fall")
            .over(decades(-300, 300, 50, 0))
            .against(si)
            .within(1e-7, 1e-4),
        Case::new("unit-time", |s, effort| in_units(1.0, 1.0, s, effort))
            .swept("unit of time of a U-chain's fall")
            .over(decades(-30, 30, 3, 0))
            .against(si)
            .within(1e-7, 1e-4),
        Case::new("turns", turns)
            .swept("whole turns by which a double pendulum starts advanced, 2 s")
            .over(decades(0, 16, 1, 0))
            .against("the same start without them")
            .within(1e-8, 1e-4),
        Case::new("first-step", first_step)
            .swept("first step of a pendulum's run, s")
            .over(Sweep::of(&[
                1e-2, 1e-4, 1e-8, 1e-12, 1e-16, 1e-20, 1e-24, 1e-28, 1e-32, 1e-40, 1e-80, 1e-160,
                1e-320,
            ]))
            .against("closed form")
            .within(1e-8, 1e-6),
        Case::new("short-run", short_run)
            .swept("length of a pendulum's run, s")
            .over(Sweep::of(&[
                1e-4, 1e-8, 1e-16, 1e-32, 1e-64, 1e-128, 1e-256, 1e-300, 1e-310, 1e-320,
            ]))
            .against("its Taylor series to the third order")
            .within(1e-15, 1e-12),
    ]
}

/// The U-chain's fall to t = 1.5 s in other units, and back; the largest coordinate is 1.
fn in_units(length: f64, mass: f64, time: f64, effort: &mut Effort) -> Result<f64, Error> {
    let chain = UChain::default();
    let start = chain.default_start()?;
    let other = UChain {
        m: chain.m * mass,
        l: chain.l * length,
        g: chain.g * length / time / time,
    };
    let mut end_of = |chain: UChain, length: f64, time: f64| -> Result<Vec<f64>, Error> {
        let mut start = start.clone();
        start.q.iter_mut().for_each(|q| *q *= length);
        let simulation = Simulation::new(chain).start(start).tolerance(1e-10);
        let run = effort.run(simulation.max_steps(100_000), 1.5 * time)?;
        Ok(end(&run).into_iter().map(|q| q / length).collect())
    };
    let expected = end_of(chain, 1.0, 1.0)?;
    Ok(off(&end_of(other, length, time)?, &expected))
}

fn turns(turns: f64, effort: &mut Effort) -> Result<f64, Error> {
    let double = DoublePendulumAngles::default();
    let start = double.default_start()?;
    let mut ends = Vec::new();
    for turns in [0.0, turns] {
        let mut start = start.clone();
        start.q.iter_mut().for_each(|q| *q += TAU * turns);
        let simulation = Simulation::new(double.clone())
            .start(start)
            .tolerance(1e-11);
        let run = effort.run(simulation.max_steps(100_000), 2.0)?;
        ends.push(end(&run));
    }
    let difference = ends[1].iter().zip(&ends[0]);
    let difference = difference.map(|(turned, plain)| turned - TAU * turns - plain);
    Ok(difference.fold(0.0, worse))
}

fn first_step(step: f64, effort: &mut Effort) -> Result<f64, Error> {
    let pendulum = Pendulum::default();
    let start = pendulum.default_start()?;
    let simulation = Simulation::new(pendulum).start(start);
    let run = effort.run(simulation.first_step(step).tolerance(1e-10), 1.0)?;
    Ok(off(&end(&run), &swung(-FRAC_PI_2, 1.0)))
}

fn short_run(length: f64, effort: &mut Effort) -> Result<f64, Error> {
    let pendulum = Pendulum::default();
    let (q, v) = pendulum.at_angle(0.8, 3.0);
    let start = State {
        t: 0.0,
        q: q.to_vec(),
        v: v.to_vec(),
    };
    let run = effort.run(Simulation::new(pendulum.clone()).start(start), length)?;
    // θ̈ = −(g/l) sin θ.
    let bend = -9.81 * 0.8_f64.sin();
    let bend_rate = -9.81 * 0.8_f64.cos() * 3.0;
    let angle = 0.8 + length * (3.0 + length * (bend / 2.0 + length * bend_rate / 6.0));
    let (expected, _) = pendulum.at_angle(angle, 0.0);
    let last = run.last().filter(|last| last.t == length);
    Ok(last.map_or(f64::INFINITY, |last| off(last.q, &expected)))
}
