//! Stiff springs, heavy drag.

use models::Pendulum;
use ukcore::{Error, Mechanism, Method, Simulation, State};

use super::{off, worse};
use crate::mechanisms::{Elastic, Incline};
use uktool::stability::{Case, Effort, decades};

pub(crate) fn cases() -> Vec<Case<'static>> {
    let rigid = "the rigid pendulum, from which a spring may differ by 20 m g/(k l), and energy";
    vec![
        Case::new("spring", |k, effort| spring(k, Method::Dop853, effort))
            .swept("stiffness of a spring in place of a pendulum's rod, N/m, explicit method")
            .over(decades(2, 12, 1, 2))
            .against(rigid)
            .within(1e-7, 1e-4),
        Case::new("spring-implicit", |k, effort| {
            spring(k, Method::Radau5, effort)
        })
        .swept("the same by the implicit method, Radau IIA of order 5")
        .over(decades(2, 12, 1, 2))
        .against(rigid)
        .within(1e-7, 1e-4),
        Case::new("drag", drag)
            .swept("drag coefficient of a slide on a track, 1/s")
            .over(decades(0, 8, 1, 0))
            .against("closed form of linear drag")
            .within(1e-9, 1e-6),
    ]
}

/// A pendulum on a spring, let go at 60° with the spring as long as its load makes it. What is beyond the reach of the stiffness.
fn spring(k: f64, method: Method, effort: &mut Effort) -> Result<f64, Error> {
    let mut elastic = Elastic::default();
    elastic.set("k", k)?;
    let (angle, g) = (std::f64::consts::FRAC_PI_3, 9.81);
    let (sin, cos) = angle.sin_cos();
    let length = 1.0 + g * cos / k;
    let start = State {
        t: 0.0,
        q: vec![length * sin, -length * cos],
        v: vec![0.0; 2],
    };
    let simulation = Simulation::new(elastic).start(start).method(method);
    let simulation = simulation.tolerance(1e-9);
    let run = effort.run(simulation.max_steps(400_000).every(0.1), 2.0)?;
    let mut worst: f64 = run.energy_drift();
    for sample in run.samples() {
        let found = sample.q[0].atan2(-sample.q[1]);
        let rigid = Pendulum::default().swing(angle, sample.t).0;
        let beyond = ((found - rigid).abs() - 20.0 * g / k).max(0.0);
        worst = worse(worst, beyond);
    }
    Ok(worst)
}

/// From rest: along the track v = (g sin a/c)(1 − e^(−ct)).
fn drag(c: f64, effort: &mut Effort) -> Result<f64, Error> {
    let mut incline = Incline::default();
    incline.set("drag", c)?;
    let until = 1.0;
    let simulation = Simulation::new(incline).start(State::zeros::<Incline>());
    // The start is at zero and has no size; the speed that is reached has.
    let simulation = simulation.absolute_tolerance(1e-10 / c);
    let run = effort.run(
        simulation
            .tolerance(1e-10)
            .max_steps(1_000_000)
            .at(vec![until]),
        until,
    )?;
    let a: f64 = 0.5;
    let pull = 9.81 * a.sin();
    let speed = -pull / c * (-c * until).exp_m1();
    let way = (pull * until - speed) / c;
    let along = |x: f64| [x * a.cos(), -x * a.sin()];
    let Some(last) = run.last() else {
        return Ok(f64::NAN);
    };
    Ok(worse(off(last.q, &along(way)), off(last.v, &along(speed))))
}
