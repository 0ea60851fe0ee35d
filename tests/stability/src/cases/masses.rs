//! Masses and lengths out of proportion, masses that vanish.

use models::RigidBody;
use ukcore::manifold::Projector;
use ukcore::{Error, Mechanism, Simulation, State};

use super::{REGULAR, SINGULAR, accelerations_off, exact_accelerations, largest, worse};
use crate::mechanisms::{Chain, Wheel};
use uktool::stability::{Case, Effort, Sweep, decades};

pub(crate) fn cases() -> Vec<Case<'static>> {
    let ratio = || decades(-12, 12, 2, 0);
    vec![
        Case::new("mass-ratio", |ratio, effort| at_once(ratio, 1.0, effort))
            .swept("mass ratio of neighbours in a chain, accelerations")
            .over(ratio())
            .against("the same equations in 31 digits; all four formulas")
            .within(1e-12, 1e-8),
        Case::new("mass-ratio-run", |ratio, effort| {
            conserved(ratio, 1.0, effort)
        })
        .swept("mass ratio of neighbours in a chain, 0.5 s of motion")
        .over(ratio())
        .against("energy, as a part of that exchanged, and lengths")
        .within(1e-8, 1e-5),
        Case::new("length-ratio", |ratio, effort| at_once(1.0, ratio, effort))
            .swept("length ratio of neighbours in a chain, accelerations")
            .over(decades(-8, 8, 1, 0))
            .against("the same equations in 31 digits; all four formulas")
            .within(1e-12, 1e-8),
        Case::new("length-ratio-run", |ratio, effort| {
            conserved(1.0, ratio, effort)
        })
        .swept("length ratio of neighbours in a chain, 0.5 s of motion")
        .over(decades(-8, 8, 1, 0))
        .against("energy, as a part of that exchanged, and lengths")
        .within(1e-8, 1e-5),
        Case::new("mass-to-zero", |i, effort| wheel(1.0, i, effort))
            .swept("inertia of a massless angle (UP limit), accelerations and one second")
            .over(inertias())
            .against("closed form for every inertia, 0 included")
            .within(1e-9, 1e-6),
        Case::new("bob-to-zero", |m, effort| wheel(m, 1.0, effort))
            .swept("mass of the bob against the inertia of its angle")
            .over(inertias())
            .against("closed form for every mass, 0 included")
            .within(1e-9, 1e-6),
        Case::new("quaternion", near_identity)
            .swept("turn of a rigid body from the identity quaternion, rad (singular M)")
            .over(decades(0, -16, 1, 0).and(0.0))
            .against("the same equations in 31 digits; both formulas for singular M")
            .within(1e-12, 1e-8),
    ]
}

/// A body turned by `distance` from where its quaternion is the identity, spinning; M there is singular along the quaternion.
fn near_identity(distance: f64, effort: &mut Effort) -> Result<f64, Error> {
    let (sin, cos) = (0.5 * distance).sin_cos();
    let axis = [0.48, 0.6, 0.64];
    let e = [cos, sin * axis[0], sin * axis[1], sin * axis[2]];
    // ė = ½ G(e)ᵀ ω.
    let w = [1.0, -0.7, 0.4];
    let v = vec![
        0.5 * (-e[1] * w[0] - e[2] * w[1] - e[3] * w[2]),
        0.5 * (e[0] * w[0] - e[3] * w[1] + e[2] * w[2]),
        0.5 * (e[3] * w[0] + e[0] * w[1] - e[1] * w[2]),
        0.5 * (-e[2] * w[0] + e[1] * w[1] + e[0] * w[2]),
    ];
    let state = State {
        t: 0.0,
        q: e.to_vec(),
        v,
    };
    let body = RigidBody::default();
    let expected = exact_accelerations(&body, &state);
    accelerations_off(&body, &state, &SINGULAR, &expected, effort)
}

fn inertias() -> Sweep {
    Sweep::of(&[
        1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16, 1e-18, 1e-24, 1e-32, 1e-64,
        1e-128, 1e-300,
    ])
    .and(0.0)
}

/// A chain with every other mass multiplied by `mass` and every other rod by `length`, bent and moving.
fn chain(mass: f64, length: f64) -> Result<(Chain, State), Error> {
    let mut chain = Chain::default();
    for name in ["m[1]", "m[3]"] {
        chain.set(name, mass)?;
    }
    for name in ["l[1]", "l[3]"] {
        chain.set(name, length)?;
    }
    let lengths = [1.0, length, 1.0, length];
    let (angles, rates) = ([0.4_f64, -0.3, 0.8, 0.2], [1.0, -2.0, 0.5, 1.5]);
    let mut state = State::zeros::<Chain>();
    let (mut at, mut speed) = ([0.0; 2], [0.0; 2]);
    for i in 0..4 {
        let (sin, cos) = angles[i].sin_cos();
        at = [at[0] + lengths[i] * sin, at[1] - lengths[i] * cos];
        // The tip of each rod at about one speed, and none faster than its length allows.
        let tip = rates[i] * lengths[i].min(1.0);
        speed = [speed[0] + tip * cos, speed[1] + tip * sin];
        (state.q[Chain::X[i]], state.q[Chain::Y[i]]) = (at[0], at[1]);
        (state.v[Chain::X[i]], state.v[Chain::Y[i]]) = (speed[0], speed[1]);
    }
    let mut projector = Projector::new(&chain);
    projector.position(0.0, &mut state.q, &state.v)?;
    projector.velocity(0.0, &state.q, &mut state.v)?;
    Ok((chain, state))
}

/// Accelerations of that chain.
fn at_once(mass: f64, length: f64, effort: &mut Effort) -> Result<f64, Error> {
    let (chain, state) = chain(mass, length)?;
    let expected = exact_accelerations(&chain, &state);
    accelerations_off(&chain, &state, &REGULAR, &expected, effort)
}

/// Drift of its energy, and of the rods' lengths as parts of the longest one.
fn conserved(mass: f64, length: f64, effort: &mut Effort) -> Result<f64, Error> {
    let (chain, start) = chain(mass, length)?;
    let simulation = Simulation::new(chain).start(start).tolerance(1e-11);
    let simulation = simulation.max_steps(2_000_000).every(0.01);
    let trajectory = effort.run(simulation, 0.5)?;
    let size = trajectory.last().map_or(1.0, |s| largest(s.q)).max(1.0);
    let residuals = trajectory.residuals();
    // φ = length² − l²: divided by size² it is twice the relative error.
    let drift = residuals.iter().map(|r| r.position / (size * size));
    Ok(drift.fold(trajectory.energy_drift(), worse))
}

/// The bob on its angle with the inertia `i` and the mass `m`: (m l² + i) s̈ = −m g l sin s.
fn wheel(m: f64, i: f64, effort: &mut Effort) -> Result<f64, Error> {
    let mut wheel = Wheel::default();
    wheel.set("m", m)?;
    wheel.set("i", i)?;
    let (angle, rate) = (1.2_f64, 0.7_f64);
    let (sin, cos) = angle.sin_cos();
    let state = State {
        t: 0.0,
        q: vec![sin, -cos, angle],
        v: vec![rate * cos, rate * sin, rate],
    };
    let gravity = m * 9.81 / (m + i);
    let turn = -gravity * sin;
    let expected = [
        cos * turn - sin * rate * rate,
        sin * turn + cos * rate * rate,
        turn,
    ];
    let now = accelerations_off(&wheel, &state, &SINGULAR, &expected, effort)?;
    // Released at rest, one second.
    let rest = State {
        v: vec![0.0; 3],
        ..state
    };
    let simulation = Simulation::new(wheel).start(rest).tolerance(1e-11);
    let end = effort.run(simulation.at(vec![1.0]), 1.0)?;
    let found = end.coordinate("s")?.last().copied().unwrap_or(f64::NAN);
    let pendulum = models::Pendulum {
        g: gravity,
        ..models::Pendulum::default()
    };
    Ok(worse(now, found - pendulum.swing(angle, 1.0).0))
}
