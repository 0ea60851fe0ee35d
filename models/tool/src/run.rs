//! `uk run`: integrate a model, write samples and a summary.

use std::cell::RefCell;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::Path;
use std::rc::Rc;
use std::time::Instant;

use models::{Model, Visitor};
use ukcore::{Baumgarte, Ending, Error, Simulation, Stabilisation, Trajectory};

use crate::args::{RunArgs, StabiliseArg};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output;
use crate::progress::Progress;
use crate::scene::{self, Ready};
use crate::summary::Summary;

/// Runs a model.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line; [`Failure::Failed`] if the integration ends early or a file cannot be
/// written, [`Failure::Interrupted`] if the user ends it. Samples and summary up to there are written all the same.
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
        let csv = args.csv.as_deref();
        let stream = to_stdout(csv).then(|| Rc::new(RefCell::new(Stream::default())));
        let file = csv.filter(|_| stream.is_none());
        if let Some(file) = file {
            output::check_writable(file)?;
        }
        let interrupt = Interrupt::catch()?;
        let started = Instant::now();
        let (trajectory, error) = integrate(&ready, args, interrupt, stream.clone());
        let seconds = started.elapsed().as_secs_f64();
        if let Some(error @ Error::InvalidSetting { .. }) = error {
            return Err(usage(error));
        }
        let failure = match (error, trajectory.last()) {
            (Some(error), _) => Some(Failure::from(error)),
            (None, Some(last)) if trajectory.ending() == Ending::Interrupted => {
                let done = format!(
                    "interrupted at t = {} s; what was computed up to there is kept",
                    last.t
                );
                Some(Failure::Interrupted(done))
            }
            _ => None,
        };
        let message = match &failure {
            Some(Failure::Failed(message)) => Some(message.clone()),
            _ => None,
        };
        if let Some(stream) = stream {
            let mut stream = stream.borrow_mut();
            stream.write(&trajectory);
            stream.result()?;
        } else {
            let summary = Summary::new(&trajectory, &ready, args, seconds, message);
            output::to_stdout(|out| {
                if !args.json {
                    return summary.write(out);
                }
                serde_json::to_writer_pretty(&mut *out, &summary).map_err(io::Error::from)?;
                writeln!(out)
            })?;
        }
        if let Some(file) = file {
            output::write_whole(file, |mut out| trajectory.write_csv(&mut out))?;
        }
        failure.map_or(Ok(()), Err)
    }
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

/// The samples on standard output, each as soon as it is computed.
#[derive(Debug, Default)]
struct Stream {
    begun: bool,
    /// Samples written so far.
    written: usize,
    error: Option<io::Error>,
}

impl Stream {
    /// Writes the samples that are new, until it fails for the first time.
    fn write<M: Model>(&mut self, trajectory: &Trajectory<M>) {
        if self.error.is_some() || (self.begun && self.written == trajectory.len()) {
            return;
        }
        let mut out = io::stdout().lock();
        let head = if self.begun {
            Ok(())
        } else {
            trajectory.write_csv_head(&mut out)
        };
        let done = head
            .and_then(|()| trajectory.write_csv_rows(self.written, &mut out))
            .and_then(|()| out.flush());
        self.begun = true;
        self.written = trajectory.len();
        self.error = done.err();
    }

    fn result(&self) -> Result<(), Failure> {
        self.error
            .as_ref()
            .map_or(Ok(()), |e| Err(Failure::stdout(e)))
    }
}

/// The trajectory, and why it ends early if it does by an error. Without a reader of `stream` it ends too.
fn integrate<M: Model>(
    ready: &Ready<M>,
    args: &RunArgs,
    interrupt: Interrupt,
    stream: Option<Rc<RefCell<Stream>>>,
) -> (Trajectory<M>, Option<Error>) {
    let from = ready.state.t;
    let until = args.until.unwrap_or_else(M::duration);
    let progress = Progress::new(M::ID);
    let bar = progress.clone();
    let mut simulation = Simulation::new(ready.mechanism.clone())
        .start(ready.state.clone())
        .method(args.method)
        .tolerance(args.tol)
        .stabilise(stabilisation(args.stabilise))
        .progress(move |run| {
            let t = run.last().map_or(from, |last| last.t);
            bar.set((t - from) / (until - from), || format!("t = {t:.3} s"));
            if let Some(stream) = &stream {
                let mut stream = stream.borrow_mut();
                stream.write(run);
                if stream.error.is_some() {
                    return ControlFlow::Break(());
                }
            }
            if interrupt.is_set() {
                return ControlFlow::Break(());
            }
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

fn stabilisation(arg: StabiliseArg) -> Stabilisation {
    match arg {
        StabiliseArg::Projection => Stabilisation::Projection,
        StabiliseArg::Baumgarte { alpha, beta } => {
            Stabilisation::Baumgarte(Baumgarte { alpha, beta })
        }
        StabiliseArg::None => Stabilisation::None,
    }
}
