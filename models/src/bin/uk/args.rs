//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::units::{self, Quantity};

/// Dynamics of constrained multibody systems after Udwadia and Kalaba.
///
/// Without a command, `uk paper`.
#[derive(Debug, Parser)]
#[command(name = "uk", version, after_help = EXIT_CODES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

const EXIT_CODES: &str = "\
Exit codes: 0 done; 1 the computation or the writing of a file failed; 2 the command line is wrong.
Values may have units and be expressions: 15deg, 12mm, 9.81 m/s^2, 2.5*PI. A bare number is in the parameter's own unit.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Reproduce the paper (Zhao, Zhen & Chen 2013): tables, figures and a verdict on each claim
    Paper(PaperArgs),
    /// List the models, their starts and start options
    List,
    /// Integrate a model
    Run(RunArgs),
    /// Show what is known about a model: M, Q, A, b, rank, degrees of freedom, what was left out
    Explain(ExplainArgs),
}

#[derive(Debug, Args)]
pub(crate) struct PaperArgs {
    /// Directory to write index.html, paper.json, figures and CSV files to
    #[arg(long, value_name = "DIR", default_value = "out/paper")]
    pub(crate) out: PathBuf,
}

impl Default for PaperArgs {
    fn default() -> Self {
        PaperArgs {
            out: PathBuf::from("out/paper"),
        }
    }
}

/// Which mechanism, with which parameters, from where.
#[derive(Debug, Args)]
pub(crate) struct Scene {
    /// Model (see `uk list`)
    pub(crate) model: String,
    /// Set a parameter or an option of the start; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = units::assignment)]
    pub(crate) settings: Vec<(String, Quantity)>,
    /// Start configuration (see `uk list`); the first one if absent
    #[arg(long, value_name = "NAME")]
    pub(crate) start: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) scene: Scene,
    /// Time to stop at; the model's own duration if absent
    #[arg(long, value_name = "TIME", value_parser = units::seconds, allow_hyphen_values = true)]
    pub(crate) until: Option<f64>,
    /// Relative and absolute tolerance of the integration
    #[arg(
        long,
        value_name = "TOL",
        default_value = "1e-10",
        allow_hyphen_values = true
    )]
    pub(crate) tol: f64,
    /// Sample at this interval; each accepted step if absent
    #[arg(long, value_name = "TIME", value_parser = units::seconds, allow_hyphen_values = true)]
    pub(crate) every: Option<f64>,
    /// Integration method
    #[arg(long, value_enum, default_value_t = MethodArg::Dop853)]
    pub(crate) method: MethodArg,
    /// How the constraints are kept from drifting
    #[arg(long, visible_alias = "stabilize", value_enum, default_value_t = StabiliseArg::Projection)]
    pub(crate) stabilise: StabiliseArg,
    /// Write the samples as CSV; `-` is standard output, which then holds nothing else.
    /// Of a run that fails, what was computed so far is written, and the exit code is 1
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Print the summary as JSON: final state, residuals, energy drift, work
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ExplainArgs {
    #[command(flatten)]
    pub(crate) scene: Scene,
}

/// Integration methods.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum MethodArg {
    /// Dormand & Prince, order 8
    Dop853,
    /// Dormand & Prince, order 5
    Dopri5,
}

/// Ways to stabilise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum StabiliseArg {
    /// Project positions and velocities after each step
    Projection,
    /// Baumgarte's feedback terms
    Baumgarte,
    /// Leave the constraints to drift
    None,
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
    fn a_run_is_read() {
        let cli = Cli::try_parse_from([
            "uk",
            "run",
            "fish",
            "--set",
            "phi=15deg",
            "--set",
            "a3=0.4",
            "--until",
            "2min",
            "--every",
            "10ms",
            "--stabilise",
            "none",
        ])
        .expect("arguments");
        let Some(Command::Run(run)) = cli.command else {
            panic!("not a run")
        };
        assert_eq!(run.scene.settings.len(), 2);
        assert_eq!(run.until, Some(120.0));
        assert_eq!(run.every, Some(0.01));
        assert_eq!(run.stabilise, StabiliseArg::None);
    }

    #[test]
    fn the_paper_is_the_default() {
        let cli = Cli::try_parse_from(["uk"]).expect("arguments");
        assert!(cli.command.is_none());
        let Some(Command::Paper(paper)) = Cli::try_parse_from(["uk", "paper"])
            .expect("arguments")
            .command
        else {
            panic!("not the paper")
        };
        assert_eq!(paper.out, PaperArgs::default().out);
    }
}
