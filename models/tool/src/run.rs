//! The command `run`: integrate a model, write samples and a summary.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use ukcore::model::Entry;
use ukcore::simulate::{CsvWriter, Drift, Ending, Sample};
use ukcore::{Error, State, Trajectory};

use crate::animate::{self, Film};
use crate::command;
use crate::curves::Curves;
use crate::failure::Failure;
use crate::motion::{self, INTERVALS, Motion};
use crate::numbers::full;
use crate::output::{self, WholeFile};
use crate::scene::{Ready, Scene};
use crate::summary::Summary;

/// The command-line arguments of the command `run`, to be flattened into a parser of `clap`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The mechanism and its start
    #[command(flatten)]
    pub scene: Scene,
    /// How its motion is computed
    #[command(flatten)]
    pub motion: Motion,
    /// Sample at this interval; each accepted step if absent, unless something is drawn
    #[arg(long, value_name = "TIME", value_parser = motion::positive, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Write the samples as CSV; `-` is standard output, which then holds nothing else and gets each row as soon as it is computed.
    /// Of a run that fails or is interrupted (Ctrl-C), what was computed so far is written
    #[arg(long, value_name = "FILE", value_parser = command::path_or_stdout)]
    pub csv: Option<PathBuf>,
    /// Draw curves as SVG: each is a NAME of `--csv` over time, or `X,Y`, which is Y over X. What differs in units, or is over something
    /// else, has a panel of its own, one below the other. Where `--every` says nothing, the run then has 1000 equal intervals
    #[arg(long, num_args = 2.., value_names = ["FILE", "CURVE"])]
    pub plot: Option<Vec<String>>,
    /// Write a page that plays the motion, as `animate` does
    #[arg(long, value_name = "FILE", value_parser = command::path)]
    pub animate: Option<PathBuf>,
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
    let to_stdout = args.csv.as_deref().is_some_and(output::is_stdout);
    if args.json && to_stdout {
        return Err(Failure::Usage(
            "`--json` and `--csv -` both want standard output; give a file to one of them"
                .to_owned(),
        ));
    }
    let path = args.csv.as_deref().filter(|_| !to_stdout);
    let plot = args.plot.as_ref().and_then(|asked| asked.first());
    output::apart(&[
        ("--csv", path),
        ("--plot", plot.map(Path::new)),
        ("--animate", args.animate.as_deref()),
    ])?;
    let ready = args.scene.ready(models)?;
    let file = match args.csv.as_deref() {
        None => None,
        Some(_) if to_stdout => Some(WholeFile::stdout()),
        Some(path) => Some(WholeFile::create(path)?),
    };
    let begin = |file| CsvWriter::new(&ready.mechanism, file);
    let rows = file.map(begin).transpose();
    let curves = args.plot.as_ref();
    let curves = curves.map(|asked| Curves::new(&ready.mechanism, asked));
    let film = match args.animate.as_deref() {
        Some(path) => Some((Film::new(&ready, String::new())?, WholeFile::create(path)?)),
        None => None,
    };
    let samples = Samples {
        rows: rows.map_err(|e| output::failure(path, &e))?,
        curves: curves.transpose()?,
        film,
        drift: Drift::new(&ready.mechanism),
        broken: None,
    };
    let started = Instant::now();
    let (trajectory, error, mut samples) = integrate(&ready, args, samples)?;
    let seconds = started.elapsed().as_secs_f64();
    if let Some((film, _)) = &mut samples.film {
        film.end(error.as_ref());
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
    samples.curves.map_or(Ok(()), Curves::finish)?;
    if let Some((film, file)) = samples.film {
        let about = animate::foot(&ready, &args.motion);
        file.finish_with(animate::page(ready.entry, vec![film], &about)?)?;
    }
    if !to_stdout {
        let message = match &failure {
            Some(Failure::Failed(message)) => Some(message.clone()),
            _ => None,
        };
        let summary = Summary {
            trajectory: &trajectory,
            measured: &samples.drift,
            broken: samples.broken.as_ref(),
            ready: &ready,
            motion: &args.motion,
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

/// What becomes of the samples.
struct Samples {
    rows: Option<CsvWriter<WholeFile>>,
    curves: Option<Curves>,
    film: Option<(Film, WholeFile)>,
    drift: Drift,
    /// The first at which an output is not finite.
    broken: Option<State>,
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
    let every = match args.every.is_some() || args.plot.is_some() || args.animate.is_some() {
        true => args.motion.interval(ready, args.every, INTERVALS)?,
        false => None,
    };
    let mut broken = None;
    let mut outputs = vec![0.0; ready.mechanism.spec().outputs.len()];
    let (trajectory, error) = args.motion.follow(ready, every, |sample| {
        samples.drift.add(sample);
        let Sample { t, q, v, .. } = sample;
        ready.mechanism.outputs(t, q, v, &mut outputs);
        if samples.broken.is_none() && outputs.iter().any(|x| !x.is_finite()) {
            samples.broken = Some(sample.to_state());
        }
        if let Some(curves) = &mut samples.curves {
            curves.add(sample);
        }
        if let Some((film, _)) = &mut samples.film {
            film.add(sample);
        }
        let row = samples.rows.as_mut().map(|rows| rows.write(sample));
        if let Some(Err(error)) = row {
            broken = Some(error);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    })?;
    if let Some(error) = broken {
        let path = args.csv.as_deref().filter(|path| !output::is_stdout(path));
        return Err(output::failure(path, &error));
    }
    Ok((trajectory, error, samples))
}
