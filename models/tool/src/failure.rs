//! How a command fails, and with which exit code.

use std::fmt;
use std::io;
use std::path::Path;

use ukcore::Error;

use crate::numbers::full;
use crate::output::is_stdout;

/// Exit code of a run that was interrupted: as shells say of a program ended by the interrupt signal.
pub(crate) const INTERRUPTED: u8 = 130;

/// Why a command does not end with exit code 0, in words for standard error.
#[derive(Debug)]
pub enum Failure {
    /// The command line is wrong (exit code 2, which the argument parser uses too).
    Usage(String),
    /// The command is right and failed (exit code 1).
    Failed(String),
    /// All was done, and some runs of many failed (exit code 3).
    Partly(String),
    /// The user has interrupted the run (exit code 130).
    Interrupted(String),
    /// Whoever read our output has stopped reading (`uk list | head`): nobody is left to tell, and nothing went wrong.
    ReaderGone,
}

impl Failure {
    /// The exit code to end the program with, as documented by `--help`.
    pub fn code(&self) -> u8 {
        match self {
            Failure::Failed(_) => 1,
            Failure::Usage(_) => 2,
            Failure::Partly(_) => 3,
            Failure::Interrupted(_) => INTERRUPTED,
            Failure::ReaderGone => 0,
        }
    }

    /// What went wrong, without the word `error:` that [`Display`](fmt::Display) puts before it.
    #[must_use]
    pub fn message(&self) -> String {
        let line = self.to_string();
        line.strip_prefix(ERROR).unwrap_or(&line).to_owned()
    }

    /// Puts the run that this failure is of before its message; leaves the message as it is where `run` is empty.
    pub(crate) fn of(self, run: &str) -> Self {
        let told = |message| match run {
            "" => message,
            _ => format!("{run}: {message}"),
        };
        match self {
            Failure::Usage(message) => Failure::Usage(told(message)),
            Failure::Failed(message) => Failure::Failed(told(message)),
            other => other,
        }
    }

    /// What is wrong with the value of the setting or option called `name`.
    pub(crate) fn value(name: &str) -> impl Fn(String) -> Self {
        move |error| Failure::Usage(format!("`{name}`: {error}"))
    }

    /// The failure that an error in writing standard output is; none, if its reader is gone.
    pub fn stdout(error: &io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            Failure::ReaderGone
        } else {
            Failure::Failed(format!("cannot write standard output: {error}"))
        }
    }

    /// The failure that an error in writing the file `path` is, or standard output where that is `-`.
    pub fn file(path: &Path, error: &io::Error) -> Self {
        if is_stdout(path) {
            return Failure::stdout(error);
        }
        Failure::Failed(format!("cannot write {}: {error}", path.display()))
    }
}

/// What stands before a message on standard error.
const ERROR: &str = "error: ";

/// The line for standard error.
impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Usage(message) | Failure::Failed(message) | Failure::Partly(message) => {
                write!(f, "{ERROR}{message}")
            }
            Failure::Interrupted(message) => f.write_str(message),
            Failure::ReaderGone => f.write_str("the reader of standard output is gone"),
        }
    }
}

/// Names and settings come from the command line, so they are usage errors; all else failed in the computation.
impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let message = told(&error);
        match error {
            Error::UnknownName { .. } | Error::InvalidSetting { .. } => Failure::Usage(message),
            _ => Failure::Failed(message),
        }
    }
}

/// The message of an error, with settings and arguments by the names that they have on the command line.
pub(crate) fn told(error: &Error) -> String {
    let message = match error {
        Error::At { t, source, .. } => format!("at t = {}: {}", full(*t), told(source)),
        Error::InvalidSetting { what, reason } => match *what {
            "t_end" => format!("`--until` {reason}"),
            "every" => format!("`--every` {reason}"),
            "method" => format!("`--method` {reason}"),
            "max_step" => format!("`--max-step` {reason}"),
            "step" => format!("the step of `--method rattle=STEP` {reason}"),
            "hold" => format!("`--hold` {reason}"),
            "speed" => format!("`--speed` {reason}"),
            "drives" => format!("the drives {reason}"),
            "coordinates" => format!("the coordinates of `--effort` {reason}"),
            "acceleration" => format!("the motion {reason}"),
            "mechanism" => format!("the mechanism {reason}"),
            "start" | "guess" | "state" => format!("the start {reason}"),
            // Which one stands in the reason.
            "parameter" => reason.clone(),
            _ => error.to_string(),
        },
        other => other.to_string(),
    };
    [
        ("`max_steps`", "`--max-steps`"),
        ("`Method::Dop853`", "`--method dop853`"),
        ("`Method::Radau5`", "`--method radau5`"),
    ]
    .iter()
    .fold(message, |text, (name, option)| text.replace(name, option))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_usage_errors_and_the_rest_is_not() {
        let unknown = Error::unknown_name("model", "uchian", &mut ["uchain", "fish"].into_iter());
        let failure = Failure::from(unknown);
        assert_eq!(failure.code(), 2);
        assert!(failure.to_string().contains("did you mean `uchain`"));
        let steps = Failure::from(Error::TooManySteps { steps: 3 });
        assert_eq!(steps.code(), 1);
        // As the command line has them.
        for name in ["`--max-steps`", "`--method radau5`"] {
            assert!(steps.message().contains(name), "{steps}");
        }
        let late = Error::At {
            t: 0.5,
            q: Vec::new(),
            v: Vec::new(),
            source: Box::new(Error::InvalidSetting {
                what: "t_end",
                reason: "is 1, so far that …".to_owned(),
            }),
        };
        let late = Failure::from(late);
        assert_eq!(late.message(), "at t = 0.5: `--until` is 1, so far that …");
        assert_eq!(late.code(), 1);
    }

    #[test]
    fn a_closed_pipe_is_no_failure() {
        let gone = io::Error::from(io::ErrorKind::BrokenPipe);
        assert_eq!(Failure::stdout(&gone).code(), 0);
        let full = io::Error::from(io::ErrorKind::StorageFull);
        assert_eq!(Failure::stdout(&full).code(), 1);
    }
}
