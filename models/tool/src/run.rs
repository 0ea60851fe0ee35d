//! The command `run`: integrate a model, write samples and a summary.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use ukcore::model::Entry;
use ukcore::simulate::SMALLEST_TOLERANCE;
use ukcore::simulate::{CsvWriter, Drift, Ending, Record};
use ukcore::{Error, Method, Simulation, Stabilisation, Trajectory};

use crate::command;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::numbers::full;
use crate::output::{self, WholeFile};
use crate::progress::Progress;
use crate::scene::{Ready, Scene};
use crate::summary::Summary;
use crate::units;

/// The arguments of `run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The mechanism and its start
    #[command(flatten)]
    pub scene: Scene,
    /// Time to stop at, before 0 to run backward; the model's own duration if absent
    #[arg(long, value_name = "TIME", value_parser = units::seconds, allow_hyphen_values = true)]
    pub until: Option<f64>,
    /// Relative and absolute tolerance of the integration
    #[arg(
        long,
        value_name = "TOL",
        default_value = "1e-10",
        value_parser = tolerance,
        allow_hyphen_values = true
    )]
    pub tol: f64,
    /// Sample at this interval; each accepted step if absent
    #[arg(long, value_name = "TIME", value_parser = interval, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Integration method: `dop853` or `dopri5`, Dormand and Prince's of order 8 and 5; `radau5`, implicit of order 5, for stiff
    /// mechanisms; `rattle=STEP`, symplectic of order 4 with steps of that time, which looks at no tolerance: the energy of a
    /// conservative motion has no trend, however long the run
    #[arg(long, value_name = "METHOD", default_value = "dop853", value_parser = method)]
    pub method: Method,
    /// Steps to give up after, such as 1e9
    #[arg(long, value_name = "STEPS", default_value = "1e7", value_parser = steps)]
    pub max_steps: usize,
    /// How the constraints are kept from drifting: `projection` of positions and velocities after each step; `baumgarte` or
    /// `baumgarte=ALPHA,BETA`, feedback terms 2 ALPHA φ̇ + BETA² φ with ALPHA and BETA in 1/s, 20 each if absent; `none`
    #[arg(
        long,
        visible_alias = "stabilize",
        value_name = "WAY",
        default_value = "projection"
    )]
    pub stabilise: Stabilisation,
    /// Write the samples as CSV; `-` is standard output, which then holds nothing else and gets each row as soon as it is computed.
    /// Of a run that fails or is interrupted (Ctrl-C), what was computed so far is written
    #[arg(long, value_name = "FILE", value_parser = command::path)]
    pub csv: Option<PathBuf>,
    /// Print the summary as JSON: final state, residuals, energy drift, work
    #[arg(long)]
    pub json: bool,
}

/// Runs a model. Samples are written as they come and not kept, so memory does not grow with the run.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line; [`Failure::Failed`] if the integration ends early or a file cannot be
/// written, [`Failure::Interrupted`] if the user ends it. Samples and summary up to there are written all the same.
pub fn run(models: &[Entry], args: &RunArgs) -> Result<(), Failure> {
    let to_stdout = args.csv.as_deref().is_some_and(is_stdout);
    if args.json && to_stdout {
        return Err(Failure::Usage(
            "`--json` and `--csv -` both want standard output; give a file to one of them"
                .to_owned(),
        ));
    }
    let ready = args.scene.ready(models)?;
    let file = match args.csv.as_deref() {
        None => None,
        Some(_) if to_stdout => Some(WholeFile::stdout()),
        Some(path) => Some(WholeFile::create(path)?),
    };
    let begin = |file| CsvWriter::new(&ready.mechanism, file);
    let rows = file.map(begin).transpose();
    let path = args.csv.as_deref().filter(|_| !to_stdout);
    let samples = Samples {
        rows: rows.map_err(|e| output::failure(path, &e))?,
        drift: Drift::new(&ready.mechanism),
    };
    let started = Instant::now();
    let (trajectory, error, samples) = integrate(&ready, args, samples)?;
    let seconds = started.elapsed().as_secs_f64();
    if let Some(error @ Error::InvalidSetting { .. }) = error {
        return Err(usage(error));
    }
    let failure = match (error, trajectory.last()) {
        (Some(error), _) => Some(Failure::from(error)),
        (None, Some(last)) if trajectory.ending() == Ending::Interrupted => {
            let t = full(last.t);
            let done = format!("interrupted at t = {t} s; what was computed up to there is kept");
            Some(Failure::Interrupted(done))
        }
        _ => None,
    };
    if let Some(rows) = samples.rows {
        rows.into_inner().finish()?;
    }
    if !to_stdout {
        let message = match &failure {
            Some(Failure::Failed(message)) => Some(message.clone()),
            _ => None,
        };
        let summary = Summary {
            trajectory: &trajectory,
            measured: &samples.drift,
            ready: &ready,
            args,
            seconds,
            error: message,
        };
        output::to_stdout(|out| match args.json {
            true => output::json(out, &summary.json()),
            false => summary.write(out),
        })?;
    }
    failure.map_or(Ok(()), Err)
}

/// A setting that the simulation refuses, by the name that it has on the command line.
fn usage(error: Error) -> Failure {
    match error {
        Error::InvalidSetting {
            what: "every",
            reason,
        } => Failure::Usage(format!("`--every` {reason}")),
        Error::InvalidSetting {
            what: "t_end",
            reason,
        } => Failure::Usage(format!("`--until` {reason}")),
        other => Failure::from(other),
    }
}

/// What becomes of the samples.
struct Samples {
    rows: Option<CsvWriter<WholeFile>>,
    drift: Drift,
}

/// The trajectory, why it ends early if it does by an error, and what became of its samples. Where rows cannot be written it ends too.
///
/// # Errors
/// What writing reports.
fn integrate(
    ready: &Ready<'_>,
    args: &RunArgs,
    mut samples: Samples,
) -> Result<(Trajectory, Option<Error>, Samples), Failure> {
    let from = ready.state.t;
    let until = args.until.unwrap_or(ready.entry.duration);
    let (interrupt, progress) = (Interrupt::catch()?, Progress::new(&ready.entry.id));
    let bar = progress.clone();
    let mut simulation = Simulation::new(&ready.mechanism)
        .start(ready.state.clone())
        .method(args.method)
        .tolerance(args.tol)
        .max_steps(args.max_steps)
        .stabilise(args.stabilise)
        .progress(move |now| {
            bar.set((now.t - from) / (until - from), || {
                format!("t = {:.3} s", now.t)
            });
            if interrupt.is_set() {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
    if let Some(interval) = args.every {
        let number = (until - from).abs() / interval;
        if number > MOST_SAMPLES {
            return Err(Failure::Usage(format!(
                "`--every` is {interval:?}, which asks for {number:.1e} samples; at most {MOST_SAMPLES:.0e} are written"
            )));
        }
        simulation = simulation.every(interval);
    }
    let mut broken = None;
    let result = simulation.stream(until, |record| {
        if let Record::Sample(sample) = record {
            samples.drift.add(sample);
            let row = samples.rows.as_mut().map(|rows| rows.write(sample));
            if let Some(Err(error)) = row {
                broken = Some(error);
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    });
    progress.finish();
    if let Some(error) = broken {
        let path = args.csv.as_deref().filter(|path| !is_stdout(path));
        return Err(output::failure(path, &error));
    }
    Ok(match result {
        Ok(trajectory) => (trajectory, None, samples),
        Err(failure) => (*failure.trajectory, Some(failure.error), samples),
    })
}

/// A slip in the unit of an interval must not fill the disk.
const MOST_SAMPLES: f64 = 1e8;

fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads a method; the step of RATTLE may have a unit.
fn method(text: &str) -> Result<Method, String> {
    match text.split_once('=') {
        Some(("rattle", step)) => Ok(Method::Rattle {
            step: interval(step)?,
        }),
        _ => text.parse().map_err(|e: Error| e.to_string()),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let range = SMALLEST_TOLERANCE..1.0;
    let number = text.trim().parse().ok().filter(|x| range.contains(x));
    number.ok_or_else(|| format!("a number from {SMALLEST_TOLERANCE:.1e} to below 1 is needed"))
}

fn steps(text: &str) -> Result<usize, String> {
    let number = text
        .trim()
        .parse()
        .ok()
        .filter(|x: &f64| (1.0..1e18).contains(x));
    let number = number.ok_or("a number of steps is needed, at least 1")?;
    Ok(number as usize)
}

fn interval(text: &str) -> Result<f64, String> {
    let seconds = units::seconds(text)?;
    if seconds > 0.0 {
        return Ok(seconds);
    }
    Err("the interval must be positive".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_may_be_many() {
        assert_eq!(steps("1e9"), Ok(1_000_000_000));
        assert!(
            ["0", "-1", "nan", "many", "1e30"]
                .iter()
                .all(|text| steps(text).is_err())
        );
    }

    #[test]
    fn the_step_of_rattle_has_a_unit() {
        assert_eq!(method("dopri5"), Ok(Method::Dopri5));
        assert_eq!(method("rattle=2ms"), Ok(Method::Rattle { step: 0.002 }));
        for text in ["euler", "rattle", "rattle=", "rattle=0", "rattle=1kg"] {
            assert!(method(text).is_err(), "{text}");
        }
    }
}
