//! The command `modes`: where a mechanism rests, and how it vibrates there.

use std::f64::consts::TAU;
use std::io::{self, Write};

use clap::Args;
use ukcore::model::Entry;
use ukcore::studies::{Mode, Stability};
use ukcore::{Error, State, equilibrium, modes as modes_of};

use crate::failure::{Failure, told};
use crate::numbers::{fixed, full, lines, significant, width};
use crate::output;
use crate::scene::{Ready, Scene};

/// The command-line arguments of the command `modes`, to be flattened into a parser of `clap`.
#[derive(Debug, Args)]
pub struct ModesArgs {
    /// The mechanism, and where the search begins
    #[command(flatten)]
    pub scene: Scene,
    /// Take the start itself, a rest position or a steady motion, instead of the rest position next to it
    #[arg(long)]
    pub steady: bool,
}

/// Coordinates of a shape that move less than this part of the one that moves most are not shown.
const STILL: f64 = 1e-6;

/// Prints the rest position next to the start, and its modes, slowest first.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line; [`Failure::Failed`] where there is no rest position, or no linear motion
/// about it.
pub fn modes(models: &[Entry], args: &ModesArgs) -> Result<(), Failure> {
    let ready = args.scene.ready(models)?;
    let failed = |error: Error| Failure::Failed(told(&error));
    let held = args.scene.start.place.held();
    let rest = |held: &[&str]| equilibrium(&ready.mechanism, &ready.state, held);
    let (state, rests) = if args.steady {
        (ready.state.clone(), None)
    } else {
        match rest(&[]) {
            // What was held to assemble the start is held for it alone, but where nothing rests without.
            Err(_) if !held.is_empty() => {
                let held_there = format!("with `{}` held", held.join("`, `"));
                (rest(&held).map_err(failed)?.state, Some(held_there))
            }
            found => {
                let found = found.map_err(failed)?;
                let stability = match found.stability {
                    Stability::Stable => "stable",
                    Stability::Neutral => "neutral (some displacements cost nothing)",
                    Stability::Unstable => "not stable",
                    Stability::Undecided => "stable or not: no linear motion tells",
                };
                (found.state, Some(stability.to_owned()))
            }
        }
    };
    // Where it rests is worth telling without a linear motion, too.
    let (found, untold) = match modes_of(&ready.mechanism, &state) {
        Ok(found) => (found, Ok(())),
        Err(error @ Error::Kink { .. }) => (Vec::new(), Err(failed(error))),
        Err(error) => return Err(failed(error)),
    };
    output::to_stdout(|out| {
        place(out, &ready, &state, rests)?;
        limits(out, &ready, &state)?;
        // A displacement that costs nothing has an eigenvalue of 0 twice, with one shape.
        let again = |k: usize| {
            let same = |other: &Mode| other.size() == 0.0 && alike(other, &found[k]);
            found[k].size() == 0.0 && found[..k].iter().any(same)
        };
        let told = (0..found.len()).filter(|k| !again(*k));
        told.map(|k| &found[k])
            .try_for_each(|mode| show(out, &ready, mode))
    })?;
    untold
}

/// Whether two modes have one shape, but for what is not shown of it.
fn alike(a: &Mode, b: &Mode) -> bool {
    let mut pairs = a.shape.iter().zip(&b.shape);
    pairs.all(|([re, im], [too, im_too])| (re - too).hypot(im - im_too) <= STILL)
}

fn place(
    out: &mut dyn Write,
    ready: &Ready<'_>,
    state: &State,
    rests: Option<String>,
) -> io::Result<()> {
    let id = &ready.entry.id;
    match rests {
        Some(word) => writeln!(out, "{id} from `{}` rests, {word}, at", ready.start)?,
        None => {
            let rests = state.v.iter().all(|v| *v == 0.0);
            let what = if rests {
                "rest position"
            } else {
                "steady motion"
            };
            writeln!(out, "{id} at its start `{}`, a {what}:", ready.start)?;
        }
    }
    let names = ready.mechanism.spec().coords;
    let wide = width(names.iter().copied());
    let largest = |values: &[f64]| values.iter().fold(0.0, |s: f64, x| s.max(x.abs()));
    // A rest position at 0 is small beside the start.
    let (size, speed) = (
        largest(&[&state.q[..], &ready.state.q].concat()),
        largest(&state.v),
    );
    for (i, ((name, q), v)) in names.iter().zip(&state.q).zip(&state.v).enumerate() {
        let rate = match *v {
            0.0 => String::new(),
            v => format!("   dot {}", number(v, speed)),
        };
        let unit = ready.mechanism.spec().coordinate_unit(i);
        let line = format!("  {name:<wide$}  {} {unit}", number(*q, size));
        writeln!(out, "{}{rate}", line.trim_end())?;
    }
    writeln!(out)
}

/// What a linear motion about `state` leaves out.
fn limits(out: &mut dyn Write, ready: &Ready<'_>, state: &State) -> io::Result<()> {
    let spec = ready.mechanism.spec();
    let mut told = Vec::new();
    if !spec.structure.scleronomic {
        let t = full(state.t);
        told.push(format!(
            "what depends on time is taken as it is at t = {t} s"
        ));
    }
    let mut values = vec![0.0; spec.switches.len()];
    let State { t, q, v } = state;
    ready.mechanism.switching(*t, q, v, &mut values);
    for (switch, value) in spec.switches.iter().zip(values) {
        if value.abs() <= ROUNDING {
            let (function, terms) = (switch.function, switch.terms.join(", "));
            told.push(format!(
                "`{function}` is 0, where the {terms} has a kink or a jump, which is no part of a linear motion"
            ));
        }
    }
    for remark in &told {
        writeln!(out, "note: {remark}")?;
    }
    match told.is_empty() {
        true => Ok(()),
        false => writeln!(out),
    }
}

fn show(out: &mut dyn Write, ready: &Ready<'_>, mode: &Mode) -> io::Result<()> {
    let Mode {
        growth, frequency, ..
    } = *mode;
    let size = mode.size();
    let growing = format!("growth {} 1/s", number(growth, size));
    if size == 0.0 {
        writeln!(out, "0 rad/s: a displacement that costs nothing")?;
    } else if frequency > 0.0 {
        let (hertz, damping) = (number(frequency / TAU, 0.0), number(mode.damping(), 1.0));
        let frequency = number(frequency, 0.0);
        writeln!(
            out,
            "{frequency} rad/s ({hertz} Hz), {growing}, damping ratio {damping}"
        )?;
    } else {
        writeln!(out, "{growing}")?;
    }
    let names = ready.mechanism.spec().coords;
    let parts = names.iter().zip(&mode.shape);
    let lines = lines(parts.filter_map(|(name, deviation)| moves(name, *deviation)));
    lines.iter().try_for_each(|line| writeln!(out, "  {line}"))
}

/// The amplitude of a coordinate that moves, with a sign where it is in step with the others or against them, else with its phase.
fn moves(name: &str, [re, im]: [f64; 2]) -> Option<String> {
    let (size, phase) = (re.hypot(im), im.atan2(re).to_degrees());
    let amplitude = significant(size, 4);
    (size > STILL).then(|| match fixed(phase.abs(), 1).as_str() {
        "0.0" => format!("{name} {amplitude}"),
        "180.0" => format!("{name} -{amplitude}"),
        _ => format!("{name} {amplitude} at {} deg", fixed(phase, 1)),
    })
}

/// Seven digits; 0 for what is rounding beside `size`.
fn number(x: f64, size: f64) -> String {
    if x.abs() <= ROUNDING * size {
        return "0".to_owned();
    }
    significant(x, 7)
}

/// A number below this part of others of its kind is rounding.
const ROUNDING: f64 = 1e-12;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_have_a_sign_or_a_phase() {
        let told = |re, im| moves("x", [re, im]);
        for (re, im, text) in [
            (1.0, 0.0, Some("x 1")),
            (-0.25, 1e-8, Some("x -0.25")),
            (0.0, -0.5, Some("x 0.5 at -90.0 deg")),
            (-1.0, 1.0, Some("x 1.414 at 135.0 deg")),
            (1e-9, 0.0, None),
        ] {
            assert_eq!(told(re, im).as_deref(), text);
        }
    }
}
