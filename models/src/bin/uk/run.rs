//! `uk run`: integrate a model, write samples and a summary.

use std::io;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use models::{Model, Visitor};
use ukcore::{Baumgarte, Method, Simulation, Stabilisation, Trajectory};

use crate::args::{MethodArg, RunArgs, StabiliseArg};
use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;
use crate::scene::{self, Ready};
use crate::summary::Summary;

/// α and β of `--stabilise baumgarte`, 1/s. α = β damps the error critically; at 20/s it decays in a twentieth of a second, fast against the
/// seconds that the models take, and slow against the steps of an explicit method.
const BAUMGARTE_RATE: f64 = 20.0;

/// Runs a model.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line; [`Failure::Failed`] if the integration ends early (samples and summary up
/// to there are written all the same) or a file cannot be written.
pub(crate) fn run(args: &RunArgs) -> Result<(), Failure> {
    if args.json && to_stdout(args.csv.as_deref()) {
        return Err(Failure::Usage(
            "`--json` and `--csv -` both want standard output; give a file to one of them"
                .to_owned(),
        ));
    }
    models::visit(&args.scene.model, Run { args })?
}

fn to_stdout(path: Option<&Path>) -> bool {
    path.is_some_and(|p| p.as_os_str() == "-")
}

struct Run<'a> {
    args: &'a RunArgs,
}

impl Visitor for Run<'_> {
    type Output = Result<(), Failure>;

    fn visit<M: Model>(self) -> Self::Output {
        let args = self.args;
        let ready = scene::ready::<M>(&args.scene)?;
        let started = Instant::now();
        let (trajectory, error) = integrate(&ready, args);
        let error = error.map(Failure::from);
        if let Some(usage @ Failure::Usage(_)) = error {
            return Err(usage);
        }
        let message = error.as_ref().map(ToString::to_string);
        let summary = Summary::new(
            &trajectory,
            &ready,
            args,
            started.elapsed().as_secs_f64(),
            message,
        );
        write_csv(&trajectory, args.csv.as_deref())?;
        if args.json {
            output::to_stdout(|out| {
                serde_json::to_writer_pretty(&mut *out, &summary).map_err(io::Error::from)?;
                writeln!(out)
            })?;
        } else if !to_stdout(args.csv.as_deref()) {
            output::to_stdout(|out| summary.write(out))?;
        }
        error.map_or(Ok(()), Err)
    }
}

/// The trajectory, and why it ends early if it does.
fn integrate<M: Model>(ready: &Ready<M>, args: &RunArgs) -> (Trajectory<M>, Option<ukcore::Error>) {
    let from = ready.state.t;
    let until = args.until.unwrap_or_else(M::duration);
    let progress = Progress::new(M::ID);
    let bar = progress.clone();
    let mut simulation = Simulation::new(ready.mechanism.clone())
        .start(ready.state.clone())
        .method(method(args.method))
        .tolerance(args.tol)
        .stabilise(stabilisation(args.stabilise))
        .progress(move |t| {
            bar.set((t - from) / (until - from), || format!("t = {t:.3} s"));
            ControlFlow::Continue(())
        });
    if let Some(interval) = args.every {
        simulation = simulation.every(interval);
    }
    let result = simulation.until(until);
    progress.finish();
    match result {
        Ok(trajectory) => (trajectory, None),
        Err(failure) => (*failure.trajectory, Some(failure.error)),
    }
}

fn method(arg: MethodArg) -> Method {
    match arg {
        MethodArg::Dop853 => Method::Dop853,
        MethodArg::Dopri5 => Method::Dopri5,
    }
}

fn stabilisation(arg: StabiliseArg) -> Stabilisation {
    match arg {
        StabiliseArg::Projection => Stabilisation::Projection,
        StabiliseArg::Baumgarte => Stabilisation::Baumgarte(Baumgarte {
            alpha: BAUMGARTE_RATE,
            beta: BAUMGARTE_RATE,
        }),
        StabiliseArg::None => Stabilisation::None,
    }
}

fn write_csv<M: Model>(trajectory: &Trajectory<M>, path: Option<&Path>) -> Result<(), Failure> {
    match path {
        None => Ok(()),
        Some(_) if to_stdout(path) => output::to_stdout(|mut out| trajectory.write_csv(&mut out)),
        Some(path) => output::write_whole(path, |mut out| trajectory.write_csv(&mut out)),
    }
}
