//! The command line `uk`: reproduce the paper, list, run and explain models.

#![forbid(unsafe_code)]

mod args;
mod drift;
mod explain;
mod failure;
mod html;
mod interrupt;
mod list;
mod numbers;
mod output;
mod paper;
mod parallel;
mod plot;
mod progress;
mod report;
mod run;
mod scene;
mod stability;
mod summary;
mod units;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command, PaperArgs};
use failure::Failure;

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        None => paper::paper(&PaperArgs::default()),
        Some(Command::Paper(args)) => paper::paper(&args),
        Some(Command::Report(args)) => report::report(&args),
        Some(Command::Stability(args)) => stability::stability(&args),
        Some(Command::List) => list::list(),
        Some(Command::Run(args)) => run::run(&args),
        Some(Command::Explain(args)) => explain::explain(&args),
    };
    let Err(failure) = result else {
        return ExitCode::SUCCESS;
    };
    if !matches!(failure, Failure::ReaderGone) {
        // Standard error may be closed too; the exit code still tells.
        let _ = writeln!(io::stderr(), "{failure}");
    }
    ExitCode::from(failure.code())
}
