//! The command line `uk`: reproduce the paper; list, run, explain and measure the models of this repository.

#![forbid(unsafe_code)]

mod paper;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use uktool::command::{self, HELP};

/// Dynamics of constrained multibody systems after Udwadia and Kalaba.
///
/// Without a command, `uk paper`.
#[derive(Debug, Parser)]
#[command(name = "uk", version, after_help = HELP)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
#[expect(clippy::large_enum_variant, reason = "one is made, once")]
enum Command {
    /// Reproduce the paper (Zhao, Zhen & Chen 2013): tables, figures and a verdict on each claim
    Paper {
        /// Directory to write index.html, paper.json, figures and CSV files to
        #[arg(long, value_name = "DIR", default_value = paper::OUT, value_parser = command::path)]
        out: PathBuf,
    },
    #[command(flatten)]
    Tool(command::Command),
}

fn main() -> ExitCode {
    let models = models::entries();
    let cli: Cli = command::parse(&models);
    command::exit(match cli.command {
        None => paper::paper(Path::new(paper::OUT)),
        Some(Command::Paper { out }) => paper::paper(&out),
        Some(Command::Tool(command)) => command.run(&models),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_parser_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn the_paper_is_the_default() {
        let cli = Cli::try_parse_from(["uk"]).expect("arguments");
        assert!(cli.command.is_none());
        let cli = Cli::try_parse_from(["uk", "paper"]).expect("arguments");
        let Some(Command::Paper { out }) = cli.command else {
            panic!("not the paper")
        };
        assert_eq!(out, Path::new(paper::OUT));
    }
}
