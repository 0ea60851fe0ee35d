//! The command `inverse`: what it takes to drive a mechanism as its constraints prescribe.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::Args;
use ukcore::Error;
use ukcore::model::Entry;
use ukcore::studies::{Effort, Inverse};

use crate::command;
use crate::failure::Failure;
use crate::motion::{self, INTERVALS, Motion, early};
use crate::numbers::{extremes, full, significant, width};
use crate::output::{self, write_whole};
use crate::scene::{Ready, Scene};

/// The command-line arguments of the command `inverse`, to be flattened into a parser of `clap`.
#[derive(Debug, Args)]
pub struct InverseArgs {
    /// The mechanism and its start
    #[command(flatten)]
    pub scene: Scene,
    /// How its motion is computed
    #[command(flatten)]
    pub motion: Motion,
    /// A constraint that is a motor; may be repeated. All rows that prescribe a motion in time if absent
    #[arg(long = "motor", value_name = "NAME", value_delimiter = ',')]
    pub motors: Vec<String>,
    /// Sample at this interval; a thousandth of the run if absent
    #[arg(long, value_name = "TIME", value_parser = motion::positive, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Write the efforts and powers at all samples as CSV; `-` is standard output
    #[arg(long, value_name = "FILE", value_parser = command::path_or_stdout)]
    pub csv: Option<PathBuf>,
}

/// Times of a run at which rows are looked at for a motion that they prescribe.
const TIMES: u32 = 16;
/// Fractional part of the golden ratio: no multiple of a period.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Runs a model, and prints for each motor the range of its effort, its largest power, and its work.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line, and where there is no motor; [`Failure::Failed`] where the run ends early:
/// what was found up to there is printed all the same.
pub fn inverse(models: &[Entry], args: &InverseArgs) -> Result<(), Failure> {
    let ready = args.scene.ready(models)?;
    let mech = &ready.mechanism;
    let length = args.motion.length(&ready);
    let named: Vec<&str> = args.motors.iter().map(String::as_str).collect();
    let times = (0..TIMES).map(|k| ready.state.t + length * (f64::from(k) * GOLDEN).fract());
    let motors = match named.is_empty() {
        true => mech.motors(&ready.state, times),
        false => named,
    };
    if motors.is_empty() {
        return Err(Failure::Usage(format!(
            "no constraint of `{}` prescribes a motion in time; `--motor NAME` takes one that holds still",
            ready.entry.id
        )));
    }
    let mut inverse = Inverse::new(mech, &motors)?;
    let mut samples: Vec<(f64, Vec<Effort>)> = Vec::new();
    let mut broken: Option<Error> = None;
    let every = args.motion.interval(&ready, args.every, INTERVALS)?;
    let (trajectory, error) = args.motion.follow(&ready, every, |sample| {
        match inverse.efforts(&sample.to_state()) {
            Ok(efforts) => samples.push((sample.t, efforts)),
            Err(error) => broken = Some(error),
        }
        match broken {
            None => ControlFlow::Continue(()),
            Some(_) => ControlFlow::Break(()),
        }
    })?;
    if let Some(path) = &args.csv {
        write_whole(path, |out| rows(out, &samples))?;
    }
    if !args.csv.as_deref().is_some_and(output::is_stdout) {
        output::to_stdout(|out| summary(out, &ready, &samples))?;
    }
    early(&trajectory, error.or(broken)).map_or(Ok(()), Err)
}

fn rows(out: &mut dyn Write, samples: &[(f64, Vec<Effort>)]) -> io::Result<()> {
    let names = samples.first().map_or(&[][..], |(_, efforts)| efforts);
    let names = (names.iter()).flat_map(|e| [e.name.to_owned(), format!("power({})", e.name)]);
    let rows = samples.iter().map(|(t, efforts)| {
        let values = efforts.iter().flat_map(|e| [e.effort, e.power]);
        [*t].into_iter().chain(values).map(full)
    });
    output::csv(out, ["t".to_owned()].into_iter().chain(names), rows)
}

fn summary(
    out: &mut dyn Write,
    ready: &Ready<'_>,
    samples: &[(f64, Vec<Effort>)],
) -> io::Result<()> {
    let Some((_, first)) = samples.first() else {
        return Ok(());
    };
    writeln!(
        out,
        "{} from `{}`, motors by their constraints",
        ready.entry.id, ready.start
    )?;
    let spec = ready.mechanism.spec();
    let wide = width(first.iter().map(|e| e.name));
    for (k, motor) in first.iter().enumerate() {
        let (least, most) = extremes(samples.iter().map(|(_, efforts)| efforts[k].effort));
        let powers = samples.iter().map(|(t, efforts)| (*t, efforts[k].power));
        let larger = |best: (f64, f64), now: (f64, f64)| {
            if now.1.abs() > best.1.abs() {
                now
            } else {
                best
            }
        };
        let (at, power) = powers.clone().reduce(larger).unwrap_or_default();
        let pairs = powers.clone().zip(powers.skip(1));
        let work: f64 = pairs
            .map(|((t, p), (later, next))| 0.5 * (later - t) * (p + next))
            .sum();
        let name = motor.name;
        // (No zero has a sign.)
        let [least, most, power, at, work] =
            [least, most, power, at, work].map(|x| significant(x + 0.0, 7));
        let row = spec.constraints.iter().position(|c| c.name == name);
        let [effort, watt, joule] = match row.map_or("", |row| spec.multiplier_unit(row)) {
            "" => ["", "", ""].map(str::to_owned),
            unit => [unit, "W", "J"].map(|unit| format!(" {unit}")),
        };
        writeln!(
            out,
            "  {name:<wide$}  effort {least} to {most}{effort}, peak power {power}{watt} at t = {at} s, work {work}{joule}"
        )?;
    }
    Ok(())
}
