//! The command line: which commands there are, and a program of them.

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use ukcore::Error;
use ukcore::model::Entry;

use crate::animate::{AnimateArgs, animate};
use crate::diagnose::{DiagnoseArgs, diagnose};
use crate::explain::{ExplainArgs, explain};
use crate::failure::Failure;
use crate::inverse::{InverseArgs, inverse};
use crate::kinematics::{KinematicsArgs, kinematics};
use crate::list::list;
use crate::modes::{ModesArgs, modes};
use crate::report::{ReportArgs, report};
use crate::run::{RunArgs, run};
use crate::stability::{ModelArgs, of_model};
use crate::sweep::{SweepArgs, sweep};

/// The end of `--help`: which exit codes there are, and how values are written.
pub const HELP: &str = "\
Exit codes: 0 done; 1 the computation or the writing of a file failed; 2 the command line is wrong;
3 some runs of a sweep failed; 130 interrupted.
Values may have units: 15deg, 12mm, 9.81 m/s^2, 2.5*PI. A bare number is in SI units: kg, m, s, rad.";

/// A command of the tool. A program with more commands flattens it into its own.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// List the models, their starts and start options
    List,
    /// Integrate a model
    Run(RunArgs),
    /// Run a model with many values of parameters, options and tolerances, and make a table of what comes out
    Sweep(SweepArgs),
    /// Show the motion of a model: a page that opens from disk, with its picture to play, energy and constraint residual
    Animate(AnimateArgs),
    /// Show where a model rests next to its start, and how it vibrates there: frequencies, growth, shapes
    Modes(ModesArgs),
    /// Show degrees of freedom, which constraints follow from which, which reactions are unique, how near a run comes to a singular
    /// position, and whether the start could be put together otherwise
    Diagnose(DiagnoseArgs),
    /// Show what it takes to drive a model as its constraints prescribe: torque or force of each motor, its power and work
    Inverse(InverseArgs),
    /// Sweep drives: positions, velocities and accelerations of a model where coordinates or the time go from one value to another, and
    /// the limits of its motion
    Kinematics(KinematicsArgs),
    /// Show what is known about a model: M, Q, A, b, rank, degrees of freedom, how its motion is computed; or the emitted code
    Explain(ExplainArgs),
    /// Measure error against run time, for each method, formula and stabilisation, and say which to take for which accuracy
    Report(ReportArgs),
    /// Sweep each parameter, the speed of the start and the tolerance until something breaks: how far results are right, and what is said
    /// beyond
    Stability(ModelArgs),
}

impl Command {
    /// Does what the command asks for, with `models` as those that it may name.
    ///
    /// # Errors
    /// [`Failure`], whose display is a line for standard error and whose [`code`](Failure::code) is the one to exit with.
    pub fn run(&self, models: &[Entry]) -> Result<(), Failure> {
        match self {
            Command::List => list(models),
            Command::Run(args) => run(models, args),
            Command::Sweep(args) => sweep(models, args),
            Command::Animate(args) => animate(models, args),
            Command::Modes(args) => modes(models, args),
            Command::Diagnose(args) => diagnose(models, args),
            Command::Inverse(args) => inverse(models, args),
            Command::Kinematics(args) => kinematics(models, args),
            Command::Explain(args) => explain(models, args),
            Command::Report(args) => report(models, args),
            Command::Stability(args) => of_model(models, args),
        }
    }
}

#[derive(Debug, Parser)]
#[command(version = concat!("by uktool ", env!("CARGO_PKG_VERSION")), about = "Dynamics of constrained multibody systems", after_help = HELP)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// A whole program: reads the command line and does what it asks with these models. [`main!`](crate::main) is what calls it.
#[must_use]
pub fn main(models: &[Entry]) -> ExitCode {
    exit(parse::<Cli>(models).command.run(models))
}

/// Reads the command line of this program, which is about these models; ends it where help is asked for or the command line is wrong.
#[must_use]
pub fn parse<C: CommandFactory + FromArgMatches>(models: &[Entry]) -> C {
    let matches = C::command().name(program()).try_get_matches();
    let mut matches = matches.unwrap_or_else(|error| answered(error, &C::command(), models).exit());
    C::from_arg_matches_mut(&mut matches).unwrap_or_else(|error| error.exit())
}

/// What is asked for by other names, and the command that answers it.
const ANSWERS: [(&str, &str); 7] = [
    (
        "equilibrium equilibria rest statics static",
        "`modes` finds where a model rests, and how it vibrates there",
    ),
    (
        "eigenvalues frequencies vibrations linearise linearize",
        "`modes` has eigenvalues, frequencies and shapes",
    ),
    (
        "branches assemble assembly dof rank redundant",
        "`diagnose` has degrees of freedom, redundant constraints and other ways to put a model together",
    ),
    (
        "simulate integrate csv",
        "`run` integrates a model, and writes its samples by `--csv FILE`",
    ),
    (
        "plot",
        "`run MODEL --plot FILE NAME…` draws outputs and coordinates",
    ),
    (
        "limits drive workspace",
        "`kinematics` sweeps drives, and finds the limits of the motion",
    ),
    (
        "code equations",
        "`explain` shows equations, and by `--code` what runs",
    ),
];

/// An error of the command line, with the command or option that is meant where there is none of its name.
fn answered(mut error: clap::Error, whole: &clap::Command, models: &[Entry]) -> clap::Error {
    if let Some(tip) = meant(&error, whole, models) {
        error.remove(ContextKind::SuggestedSubcommand);
        let tip = ContextValue::StyledStrs(vec![tip.into()]);
        error.insert(ContextKind::Suggested, tip);
    }
    error
}

/// The command or option that is meant, unless the error tells.
fn meant(error: &clap::Error, whole: &clap::Command, models: &[Entry]) -> Option<String> {
    let string = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        _ => None,
    };
    if let Some(setting) = string(ContextKind::InvalidArg) {
        let bare = error.kind() == ErrorKind::UnknownArgument && !setting.starts_with('-');
        let sets =
            |command: &clap::Command| command.get_arguments().any(|a| a.get_long() == Some("set"));
        let asked = std::env::args().nth(1)?;
        if let Some(option) = setting.strip_prefix("--") {
            let similar = error.get(ContextKind::SuggestedArg).is_some();
            return (!similar).then(|| elsewhere(option, &asked, whole));
        }
        let sets = whole.find_subcommand(asked).is_some_and(sets);
        return (bare && sets && setting.contains('='))
            .then(|| format!("`--set {setting}` sets a parameter or an option of the start"));
    }
    let asked = string(ContextKind::InvalidSubcommand)?;
    if models.iter().any(|model| model.id == asked) {
        return Some(format!(
            "`run {asked}` integrates it, `explain {asked}` shows its equations; a command stands before the model"
        ));
    }
    let lower = asked.to_lowercase();
    let mut answers = ANSWERS.iter();
    if let Some((_, answer)) = answers.find(|(names, _)| names.split(' ').any(|n| n == lower)) {
        return Some((*answer).to_owned());
    }
    let mut commands = whole.get_subcommands().map(clap::Command::get_name);
    match Error::unknown_name("command", asked, &mut commands) {
        Error::UnknownName { nearest, .. } => {
            nearest.map(|name| format!("a similar subcommand exists: '{name}'"))
        }
        _ => None,
    }
}

/// Which commands have the `option` that the command `asked` has not.
fn elsewhere(option: &str, asked: &str, whole: &clap::Command) -> String {
    let has = |command: &&clap::Command| {
        let mut arguments = command.get_arguments();
        arguments.any(|a| a.get_long() == Some(option))
    };
    let others = whole.get_subcommands().filter(has);
    let others: Vec<String> = others.map(|c| format!("`{}`", c.get_name())).collect();
    match others.is_empty() {
        true => format!(
            "`{} {asked} --help` shows the options that there are",
            program()
        ),
        false => format!("`--{option}` is an option of {}", others.join(", ")),
    }
}

/// Writes a failure to standard error, if there is one, and returns the code to end the program with.
#[must_use]
pub fn exit(result: Result<(), Failure>) -> ExitCode {
    let Err(failure) = result else {
        return ExitCode::SUCCESS;
    };
    if !matches!(failure, Failure::ReaderGone) {
        // Standard error may be closed too; the exit code still tells.
        let _ = writeln!(io::stderr(), "{failure}");
    }
    ExitCode::from(failure.code())
}

/// The name of this program, as it was called.
fn program() -> String {
    let called = std::env::args_os()
        .next()
        .unwrap_or_else(|| OsString::from("uk"));
    let name = Path::new(&called).file_name().unwrap_or(&called);
    let name = name.to_string_lossy();
    let end = std::env::consts::EXE_SUFFIX;
    name.strip_suffix(end).unwrap_or(&name).to_owned()
}

/// Finds the model called `id` on the command line.
///
/// # Errors
/// [`Failure::Usage`] with the nearest name.
pub fn find<'a>(models: &'a [Entry], id: &str) -> Result<&'a Entry, Failure> {
    models.iter().find(|m| m.id == id).ok_or_else(|| {
        let error = Error::unknown_name("model", id, &mut models.iter().map(|m| m.id.as_str()));
        match error {
            Error::UnknownName { nearest: None, .. } => Failure::Usage(format!(
                "no model is called `{id}`; `{} list` shows those there are",
                program()
            )),
            _ => error.into(),
        }
    })
}

/// Reads the path of a file or directory: neither nothing, nor `-`.
///
/// # Errors
/// What is wrong.
pub fn path(text: &str) -> Result<PathBuf, String> {
    match text {
        "-" => Err("standard output is for `--csv` alone; name a file".to_owned()),
        _ => path_or_stdout(text),
    }
}

/// Reads the path of a file, or `-`, which is standard output.
pub(crate) fn path_or_stdout(text: &str) -> Result<PathBuf, String> {
    if text.is_empty() {
        return Err("a path is needed".to_owned());
    }
    Ok(PathBuf::from(text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ukcore::manifold::Stabilisation;

    #[test]
    fn the_parser_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_run_is_read() {
        let line = "uk run fish --set phi=15deg --set a3=0.4 --until 2min --every 10ms --stabilise none --guess dot(x)=-1 --hold s,th";
        let cli = Cli::try_parse_from(line.split(' ')).expect("arguments");
        let Command::Run(run) = cli.command else {
            panic!("not a run")
        };
        assert_eq!(run.scene.start.settings.len(), 2);
        assert_eq!(run.scene.start.place.hold, ["s", "th"]);
        assert_eq!(run.motion.until, Some(120.0));
        assert_eq!(run.every, Some(0.01));
        assert_eq!(run.motion.stabilise, Stabilisation::None);
    }
}
