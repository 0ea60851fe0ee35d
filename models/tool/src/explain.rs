//! The command `explain`: what the compiler derived and decided, what the solver says at the start, and the emitted code.

use clap::Args;
use ukcore::explain::Explanation;
use ukcore::model::Entry;
use ukcore::plan::laid_out;

use crate::command::find;
use crate::failure::Failure;
use crate::output;
use crate::scene::Scene;

/// The command-line arguments of the command `explain`, to be flattened into a parser of `clap`.
#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// The mechanism and its start
    #[command(flatten)]
    pub scene: Scene,
    /// Print the code that runs instead, which is the same for any parameters and start: of FUNCTION (`dynamics`, `acceleration`, …), or
    /// of all of them
    #[arg(
        long,
        value_name = "FUNCTION",
        num_args = 0..=1,
        default_missing_value = "",
        conflicts_with_all = ["settings", "start", "guesses", "hold"]
    )]
    pub code: Option<String>,
}

/// Prints all that is known about a model.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line, [`Failure::Failed`] if the equations cannot be solved at the start.
pub fn explain(models: &[Entry], args: &ExplainArgs) -> Result<(), Failure> {
    let entry = find(models, &args.scene.model)?;
    if let Some(function) = &args.code {
        return code(entry, function);
    }
    let (explanation, result) = match args.scene.start.noted(entry) {
        Ok(ready) => {
            let there = Explanation::new(&ready.mechanism).at(ready.start, &ready.state);
            (there.0, there.1.map_err(Failure::from))
        }
        // Without a start of its own and a guess, most is known all the same.
        Err(Failure::Failed(_)) if args.scene.start.is_unguessed(entry) => {
            let (mechanism, ..) = args.scene.start.settings(entry)?;
            (Explanation::new(mechanism), Ok(()))
        }
        Err(failure) => return Err(failure),
    };
    // The explanation begins with what the declaration says of itself.
    let end = match entry.summary {
        "" => "\n\n",
        _ => ": ",
    };
    output::to_stdout(|out| write!(out, "{}{end}{explanation}", entry.id))?;
    result
}

/// Prints the emitted function called `function`, or all if that is empty.
fn code(entry: &Entry, function: &str) -> Result<(), Failure> {
    let wanted = |(name, _): &&(&str, &str)| function.is_empty() || *name == function;
    let texts = entry.code.iter().filter(wanted);
    let texts: Vec<String> = texts.map(|(_, text)| laid_out(text)).collect();
    if texts.is_empty() {
        let names: Vec<&str> = entry.code.iter().map(|(name, _)| *name).collect();
        return Err(Failure::Usage(format!(
            "`{}` has no function `{function}`; it has {}",
            entry.id,
            names.join(", ")
        )));
    }
    output::to_stdout(|out| write!(out, "{}", texts.join("\n")))
}
