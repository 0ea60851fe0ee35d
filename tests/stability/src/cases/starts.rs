//! Starts off the constraints, prescribed motion that jumps, and numbers that are none.

use models::{Model, Pendulum, UChain};
use ukcore::{Error, Mechanism, Simulation, State, assemble};

use super::worse;
use crate::mechanisms::{Carriage, Elastic};
use uktool::stability::{Case, Effort, Sweep, decades};

pub(crate) fn cases() -> Vec<Case<'static>> {
    let jump = |id, what: &'static str, swept: &'static str| {
        Case::new(id, move |by, effort| jumping(what, by, effort))
            .swept(swept)
            .over(decades(-16, 0, 1, -16))
            .against("closed form of the mass on its spring")
            .within(1e-7, 1e-5)
    };
    vec![
        Case::new("start-off", start_off)
            .swept("distance of a U-chain's start from its constraints, m, as a start")
            .over(decades(-16, 0, 1, -16))
            .against("consistent to rounding, and moved by at most 20 times the distance")
            .within(1e-13, 1e-12),
        Case::new("assembly-off", assembly_off)
            .swept("distance of a U-chain's start from its constraints, m, as a guess to assemble")
            .over(decades(-16, 1, 1, -16))
            .against("consistent to rounding, and moved by at most 20 times the distance")
            .within(1e-13, 1e-12),
        jump("jump-place", "place", "jump of a prescribed position, m"),
        jump(
            "jump-velocity",
            "velocity",
            "jump of a prescribed velocity, m/s",
        ),
        jump(
            "jump-acceleration",
            "acceleration",
            "jump of a prescribed acceleration, m/s²",
        ),
        Case::new("not-finite", not_finite)
            .swept("NaN and ∞ in parameters, state, time and forces")
            .over(Sweep::named(&PLACES))
            .against("refused, and the culprit named")
            .within(0.0, 0.0),
    ]
}

/// The U-chain's start with its coordinates moved to and fro by up to `distance`.
fn moved(distance: f64) -> Result<State, Error> {
    let mut state = UChain::default().default_start()?;
    // A sequence without pattern: the golden section's multiples, fractional part.
    for (i, q) in state.q.iter_mut().enumerate() {
        *q += distance * (2.0 * (0.618_033_988_749_895 * (i + 1) as f64).fract() - 1.0);
    }
    Ok(state)
}

/// Residual of `found` in terms of its size, if it is as near as it should be.
fn settled(guess: &State, found: &State, distance: f64) -> Result<f64, Error> {
    let chain = UChain::default();
    let residual = ukcore::assemble::residuals(&chain, found)?.largest_position();
    let way = guess.q.iter().zip(&found.q);
    let way = way.fold(0.0, |s: f64, (a, b)| s.max((a - b).abs()));
    Ok(if way <= 20.0 * distance + 1e-13 {
        residual / 17.0
    } else {
        f64::INFINITY
    })
}

fn start_off(distance: f64, effort: &mut Effort) -> Result<f64, Error> {
    let guess = moved(distance)?;
    let simulation = Simulation::new(UChain::default()).start(guess.clone());
    let run = effort.run(simulation, 0.0)?;
    let found = run.sample(0).map_or(guess.clone(), |s| s.to_state());
    settled(&guess, &found, distance)
}

fn assembly_off(distance: f64, _: &mut Effort) -> Result<f64, Error> {
    let guess = moved(distance)?;
    let found = assemble(UChain::default(), &guess, &[])?;
    settled(&guess, &found, distance)
}

/// The mass on the spring follows a carriage that changes its motion at t = 1/2.
fn jumping(what: &str, jump: f64, effort: &mut Effort) -> Result<f64, Error> {
    let mut carriage = Carriage::default();
    carriage.set(what, jump)?;
    let Carriage {
        place,
        velocity,
        acceleration,
        ..
    } = carriage;
    let until = 1.5;
    let simulation = Simulation::new(carriage).start(State::zeros::<Carriage>());
    let run = effort.run(simulation.tolerance(1e-9).at(vec![until]), until)?;
    let w = 30.0_f64.sqrt();
    let s = until - 0.5;
    let (sin, cos) = (w * s).sin_cos();
    let drive = place + velocity * s + 0.5 * acceleration * s * s;
    let follow = place * (1.0 - cos)
        + velocity * (s - sin / w)
        + acceleration * (0.5 * s * s - (1.0 - cos) / (w * w));
    let found = run.last().map_or([f64::NAN; 2], |l| [l.q[0], l.q[1]]);
    Ok(worse(found[0] - drive, found[1] - follow))
}

const PLACES: [&str; 14] = [
    "m = NaN",
    "m = ∞",
    "m = −∞",
    "l = NaN",
    "l = ∞",
    "g = NaN",
    "g = −∞",
    "x = NaN",
    "x = ∞",
    "ẏ = NaN",
    "ẏ = −∞",
    "t = NaN",
    "end = ∞",
    "0/0 in a force",
];

/// Whether what is not finite is refused with a message that names it: 0, or infinity where it is not.
fn not_finite(index: f64, effort: &mut Effort) -> Result<f64, Error> {
    let place = PLACES[index as usize];
    if place.ends_with("force") {
        // At the centre of the spring its direction is 0/0.
        let simulation = Simulation::new(Elastic::default()).start(State::zeros::<Elastic>());
        return named(effort.run(simulation, 1.0).err(), "force on x");
    }
    let (name, value) = place.split_once(" = ").unwrap_or(("", ""));
    let value = match value {
        "NaN" => f64::NAN,
        "∞" => f64::INFINITY,
        _ => f64::NEG_INFINITY,
    };
    let mut pendulum = Pendulum::default();
    let mut state = pendulum.default_start()?;
    let mut until = 1.0;
    let expected = match name {
        "x" => {
            state.q[0] = value;
            "coordinate x"
        }
        "ẏ" => {
            state.v[1] = value;
            "velocity"
        }
        "t" => {
            state.t = value;
            "time"
        }
        "end" => {
            until = value;
            "t_end"
        }
        parameter => {
            pendulum.set(parameter, value)?;
            "parameter"
        }
    };
    let simulation = Simulation::new(pendulum).start(state);
    named(effort.run(simulation, until).err(), expected)
}

/// The error if it names `expected`, else an infinite one: nobody would know.
fn named(error: Option<Error>, expected: &str) -> Result<f64, Error> {
    match error {
        Some(error) if error.to_string().contains(expected) => Err(error),
        _ => Ok(f64::INFINITY),
    }
}
