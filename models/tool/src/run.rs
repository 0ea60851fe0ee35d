//! The command `run`: integrate a model, write samples and a summary.

use std::io;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use ukcore::model::Entry;
use ukcore::simulate::{CsvWriter, Drift, Sample};
use ukcore::{Prepared, State};

use crate::animate::{self, Film};
use crate::command;
use crate::curves::Curves;
use crate::failure::Failure;
use crate::motion::{self, INTERVALS, Motion, early};
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
    let plot = args.plot.as_ref().and_then(|asked| asked.first());
    output::apart(&[
        ("--csv", args.csv.as_deref()),
        ("--plot", plot.map(Path::new)),
        ("--animate", args.animate.as_deref()),
    ])?;
    for (option, path, written) in [
        ("--csv", &args.csv, "csv"),
        ("--animate", &args.animate, "html"),
    ] {
        path.as_ref()
            .map_or(Ok(()), |path| output::promised(option, path, written))?;
    }
    let ready = args.scene.ready(models)?;
    let mut samples = Samples::new(&ready, args)?;
    let every = match args.every.is_some() || args.plot.is_some() || args.animate.is_some() {
        true => args.motion.interval(&ready, args.every, INTERVALS)?,
        false => None,
    };
    let started = Instant::now();
    let each = |sample: Sample<'_>| samples.add(&ready.mechanism, sample);
    let (trajectory, error) = args.motion.follow(&ready, every, each)?;
    let seconds = started.elapsed().as_secs_f64();
    if let (Some(error), Some(path)) = (&samples.failed, &args.csv) {
        return Err(Failure::file(path, error));
    }
    let failure = early(&trajectory, error);
    if let Some((film, _)) = &mut samples.film {
        film.end(failure.as_ref());
    }
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
    outputs: Vec<f64>,
    /// The first at which an output is not finite.
    broken: Option<State>,
    /// Why a row could not be written.
    failed: Option<io::Error>,
}

impl Samples {
    /// Begins all files that are asked for.
    fn new(ready: &Ready<'_>, args: &RunArgs) -> Result<Self, Failure> {
        let mechanism = &ready.mechanism;
        let rows = args.csv.as_ref().map(|path| {
            let rows = CsvWriter::new(mechanism, WholeFile::create(path)?);
            rows.map_err(|e| Failure::file(path, &e))
        });
        let curves = args.plot.as_ref();
        let curves = curves.map(|asked| Curves::new(mechanism, "t", asked));
        let film = args.animate.as_ref().map(|path| {
            let film = Film::new(ready, String::new())?;
            Ok::<_, Failure>((film, WholeFile::create(path)?))
        });
        Ok(Samples {
            rows: rows.transpose()?,
            curves: curves.transpose()?,
            film: film.transpose()?,
            drift: Drift::new(mechanism),
            outputs: vec![0.0; mechanism.spec().outputs.len()],
            broken: None,
            failed: None,
        })
    }

    /// Takes a sample of `mechanism`, unless its row cannot be written.
    fn add(&mut self, mechanism: &Prepared, sample: Sample<'_>) -> ControlFlow<()> {
        self.drift.add(sample);
        let Sample { t, q, v, .. } = sample;
        mechanism.outputs(t, q, v, &mut self.outputs);
        if self.broken.is_none() && self.outputs.iter().any(|x| !x.is_finite()) {
            self.broken = Some(sample.to_state());
        }
        if let Some(curves) = &mut self.curves {
            curves.add(mechanism, sample);
        }
        if let Some((film, _)) = &mut self.film {
            film.add(sample);
        }
        self.failed = self.rows.as_mut().and_then(|rows| rows.write(sample).err());
        match self.failed {
            None => ControlFlow::Continue(()),
            Some(_) => ControlFlow::Break(()),
        }
    }
}
