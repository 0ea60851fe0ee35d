//! The command line.

use std::fmt;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use ukcore::Method;
use ukcore::simulate::SMALLEST_TOLERANCE;

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
Exit codes: 0 done; 1 the computation or the writing of a file failed; 2 the command line is wrong; 130 interrupted.
Values may have units: 15deg, 12mm, 9.81 m/s^2, 2.5*PI. A bare number is in the parameter's own unit.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Reproduce the paper (Zhao, Zhen & Chen 2013): tables, figures and a verdict on each claim
    Paper(PaperArgs),
    /// Measure error against run time, for each method, formula and stabilisation, and say which to take for which accuracy
    Report(ReportArgs),
    /// Stiff and extreme cases: how far each one goes with full accuracy, how far within a bound, and what is refused beyond
    Stability(StabilityArgs),
    /// List the models, their starts and start options
    List,
    /// Integrate a model
    Run(RunArgs),
    /// Show what is known about a model: M, Q, A, b, rank, degrees of freedom, how its motion is computed; or the emitted code
    Explain(ExplainArgs),
}

#[derive(Debug, Args)]
pub(crate) struct PaperArgs {
    /// Directory to write index.html, paper.json, figures and CSV files to
    #[arg(long, value_name = "DIR", default_value = "out/paper", value_parser = file)]
    pub(crate) out: PathBuf,
}

impl Default for PaperArgs {
    fn default() -> Self {
        PaperArgs {
            out: PathBuf::from("out/paper"),
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct ReportArgs {
    /// Models to measure (see `uk list`); all of them if none is named
    #[arg(value_name = "MODEL")]
    pub(crate) models: Vec<String>,
    /// Directory to write index.html, report.json, report.csv and figures to. What an interrupted report has left there is taken over
    #[arg(long, value_name = "DIR", default_value = "out/report", value_parser = file)]
    pub(crate) out: PathBuf,
    /// A quick look: few tolerances, each timed once
    #[arg(long)]
    pub(crate) quick: bool,
}

#[derive(Debug, Args)]
pub(crate) struct StabilityArgs {
    /// Cases to run; all of them if absent (a wrong name lists them)
    pub(crate) cases: Vec<String>,
    /// Directory to write index.html, stability.svg, stability.json and stability.csv to
    #[arg(long, value_name = "DIR", default_value = "out/stability", value_parser = file)]
    pub(crate) out: PathBuf,
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
    /// Time to stop at, before 0 to run backward; the model's own duration if absent
    #[arg(long, value_name = "TIME", value_parser = units::seconds, allow_hyphen_values = true)]
    pub(crate) until: Option<f64>,
    /// Relative and absolute tolerance of the integration
    #[arg(
        long,
        value_name = "TOL",
        default_value = "1e-10",
        value_parser = tolerance,
        allow_hyphen_values = true
    )]
    pub(crate) tol: f64,
    /// Sample at this interval; each accepted step if absent
    #[arg(long, value_name = "TIME", value_parser = interval, allow_hyphen_values = true)]
    pub(crate) every: Option<f64>,
    /// Integration method: `dop853` or `dopri5`, Dormand and Prince's of order 8 and 5; `radau5`, implicit of order 5, for stiff mechanisms; `rattle=STEP`, symplectic of order 4 with steps of that time, which looks at no
    /// tolerance: the energy of a conservative motion has no trend, however long the run
    #[arg(long, value_name = "METHOD", default_value = "dop853", value_parser = method)]
    pub(crate) method: Method,
    /// How the constraints are kept from drifting: `projection` of positions and velocities after each step; `baumgarte` or
    /// `baumgarte=ALPHA,BETA`, feedback terms 2 ALPHA φ̇ + BETA² φ with ALPHA and BETA in 1/s, 20 each if absent; `none`
    #[arg(
        long,
        visible_alias = "stabilize",
        value_name = "WAY",
        default_value = "projection",
        value_parser = StabiliseArg::parse
    )]
    pub(crate) stabilise: StabiliseArg,
    /// Write the samples as CSV; `-` is standard output, which then holds nothing else and gets each row as soon as it is computed.
    /// Of a run that fails or is interrupted (Ctrl-C), what was computed so far is written
    #[arg(long, value_name = "FILE", value_parser = file)]
    pub(crate) csv: Option<PathBuf>,
    /// Print the summary as JSON: final state, residuals, energy drift, work
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ExplainArgs {
    #[command(flatten)]
    pub(crate) scene: Scene,
    /// Print the code that runs instead: of FUNCTION (`dynamics`, `acceleration`, …), or of all of them
    #[arg(long, value_name = "FUNCTION", num_args = 0..=1, default_missing_value = "")]
    pub(crate) code: Option<String>,
}

/// Ways to stabilise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum StabiliseArg {
    /// Projection of positions and velocities after each step.
    Projection,
    /// Baumgarte's feedback terms.
    Baumgarte {
        /// Half the factor of φ̇, 1/s.
        alpha: f64,
        /// Root of the factor of φ, 1/s.
        beta: f64,
    },
    /// The constraints are left to drift.
    None,
}

/// α and β of `--stabilise baumgarte`, 1/s. α = β damps the error critically; at 20/s it decays in a twentieth of a second, fast against the
/// seconds that the models take, and slow against the steps of an explicit method.
const BAUMGARTE_RATE: f64 = 20.0;

impl StabiliseArg {
    fn parse(text: &str) -> Result<Self, String> {
        let (word, rates) = match text.split_once('=') {
            Some((word, rates)) => (word, Some(rates)),
            None => (text, None),
        };
        let plain = |way| match rates {
            None => Ok(way),
            Some(_) => Err(format!("`{word}` has no rates")),
        };
        match word {
            "projection" => plain(StabiliseArg::Projection),
            "none" => plain(StabiliseArg::None),
            "baumgarte" => {
                let Some(rates) = rates else {
                    return Ok(StabiliseArg::Baumgarte {
                        alpha: BAUMGARTE_RATE,
                        beta: BAUMGARTE_RATE,
                    });
                };
                let rate = |text: &str| {
                    text.trim()
                        .parse()
                        .ok()
                        .filter(|x| (0.0..f64::INFINITY).contains(x))
                };
                let two = rates
                    .split_once(',')
                    .and_then(|(a, b)| Some((rate(a)?, rate(b)?)));
                let (alpha, beta) =
                    two.ok_or("two rates in 1/s are needed, not negative: baumgarte=20,20")?;
                Ok(StabiliseArg::Baumgarte { alpha, beta })
            }
            _ => {
                Err("it is `projection`, `baumgarte`, `baumgarte=ALPHA,BETA` or `none`".to_owned())
            }
        }
    }
}

/// As on the command line.
impl fmt::Display for StabiliseArg {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StabiliseArg::Projection => f.write_str("projection"),
            StabiliseArg::Baumgarte { alpha, beta } => write!(f, "baumgarte={alpha},{beta}"),
            StabiliseArg::None => f.write_str("none"),
        }
    }
}

fn method(text: &str) -> Result<Method, String> {
    match text.split_once('=') {
        None if text == "dop853" => Ok(Method::Dop853),
        None if text == "dopri5" => Ok(Method::Dopri5),
        None if text == "radau5" => Ok(Method::Radau5),
        None if text == "rattle" => Err("it needs its step: rattle=1ms".to_owned()),
        Some(("rattle", step)) => interval(step).map(|step| Method::Rattle { step }),
        _ => Err("it is `dop853`, `dopri5`, `radau5` or `rattle=STEP`".to_owned()),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let range = SMALLEST_TOLERANCE..1.0;
    let number = text.trim().parse().ok().filter(|x| range.contains(x));
    number.ok_or_else(|| format!("a number from {SMALLEST_TOLERANCE:.1e} to below 1 is needed"))
}

fn interval(text: &str) -> Result<f64, String> {
    let seconds = units::seconds(text)?;
    if seconds > 0.0 {
        return Ok(seconds);
    }
    Err("the interval must be positive".to_owned())
}

fn file(text: &str) -> Result<PathBuf, String> {
    if text.is_empty() {
        return Err("a path is needed".to_owned());
    }
    Ok(PathBuf::from(text))
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
    fn methods_are_read_as_they_are_written() {
        for text in ["dop853", "dopri5", "radau5", "rattle=0.001"] {
            assert_eq!(method(text).map(|m| m.to_string()), Ok(text.to_owned()));
        }
        assert_eq!(method("rattle=2ms"), Ok(Method::Rattle { step: 0.002 }));
        for text in [
            "euler",
            "rattle",
            "rattle=",
            "rattle=0",
            "rattle=1kg",
            "dop853=1",
        ] {
            assert!(method(text).is_err(), "{text}");
        }
    }

    #[test]
    fn ways_to_stabilise_are_read_as_they_are_written() {
        for text in ["projection", "none", "baumgarte=5,2.5"] {
            assert_eq!(
                StabiliseArg::parse(text).map(|s| s.to_string()),
                Ok(text.to_owned())
            );
        }
        assert_eq!(
            StabiliseArg::parse("baumgarte"),
            StabiliseArg::parse("baumgarte=20,20")
        );
        for text in [
            "glue",
            "none=1",
            "baumgarte=",
            "baumgarte=1",
            "baumgarte=1,-1",
            "baumgarte=1,inf",
            "baumgarte=1,2,3",
        ] {
            assert!(StabiliseArg::parse(text).is_err(), "{text}");
        }
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
