//! The command `stability`: how far stiff and extreme cases go, of any model or of those that a program has ([`Case`]).
//!
//! Each case sweeps one thing until it breaks. Every value comes out accurate, degraded within a stated bound, or refused with an
//! error that has a name. A result that is off by more, without a word, is the one thing that must not be: it makes the command fail.

mod case;
mod model;
mod page;
mod picture;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use clap::Parser;
use rayon::prelude::*;
use serde::Serialize;
use ukcore::Error;

use crate::command::{self, HELP};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::numbers::{self, exact};
use crate::output::{self, Directory};
use crate::progress::Progress;

pub use case::{Case, Effort, Measure, Sweep, decades};
use case::{Class, Row};
pub use model::{ModelArgs, of_model};

/// Stiff and extreme cases: how far each one goes with full accuracy, how far within a bound, and what is refused beyond.
#[derive(Debug, Parser)]
#[command(about, after_help = HELP)]
pub struct StabilityArgs {
    /// Cases to run; all of them if absent (a wrong name lists them)
    #[arg(value_name = "CASE")]
    pub cases: Vec<String>,
    /// Directory to write index.html, stability.svg, stability.json and stability.csv to
    #[arg(long, value_name = "DIR", default_value = "out/stability", value_parser = command::path)]
    pub out: PathBuf,
}

/// Every number on the page.
#[derive(Serialize)]
struct Stability<'a> {
    about: &'static str,
    /// The motion that all cases change, where it is one.
    subject: &'a str,
    /// All that was asked for is there.
    complete: bool,
    cases: Vec<Row<'a>>,
    /// Wall time, s.
    seconds: f64,
}

impl Stability<'_> {
    /// The number of values that came out as `class`, in all cases.
    fn count(&self, class: Class) -> usize {
        self.cases.iter().map(|row| row.count(class)).sum()
    }
}

const ABOUT: &str = "Errors are parts of the size of the result; `ordinary` is the index of the value at which nothing is extreme.";

/// A whole program: reads the command line and runs these cases.
#[must_use]
pub fn main(cases: &[Case<'_>]) -> ExitCode {
    command::exit(stability(cases, &command::parse(&[])))
}

/// Runs the cases that are asked for and writes the report to `args.out`.
///
/// # Errors
/// [`Failure::Usage`] for a case that is not there; [`Failure::Failed`] if a result is wrong, or a file cannot be written;
/// [`Failure::Interrupted`] after Ctrl-C, with the cases that were finished written.
pub fn stability(cases: &[Case<'_>], args: &StabilityArgs) -> Result<(), Failure> {
    sweep(&chosen(cases, &args.cases)?, "", &args.out)
}

/// Runs these cases, all of `subject` if that is not empty, and writes the report to the directory `out`.
fn sweep(chosen: &[&Case<'_>], subject: &str, out: &Path) -> Result<(), Failure> {
    let started = Instant::now();
    let directory = Directory::create(out)?;
    let rows = compute(chosen, Interrupt::catch()?);
    let report = Stability {
        about: ABOUT,
        subject,
        complete: rows.len() == chosen.len(),
        cases: rows,
        seconds: started.elapsed().as_secs_f64(),
    };
    directory.write("stability.svg", picture::picture(&report.cases)?)?;
    directory.json("stability.json", &report)?;
    directory.csv("stability.csv", report.cases.iter().flat_map(table))?;
    directory.write("index.html", page::html(&report))?;
    print(&directory, &report)?;
    if !report.complete {
        return Err(Failure::Interrupted(format!(
            "interrupted; {} of {} are written",
            report.cases.len(),
            numbers::count(chosen.len(), "case")
        )));
    }
    match report.count(Class::Wrong) {
        0 => Ok(()),
        wrong => Err(Failure::Failed(format!(
            "{} {} off by more than the bound of the case, and no error said so",
            numbers::count(wrong, "result"),
            if wrong == 1 { "is" } else { "are" },
        ))),
    }
}

/// The cases with these names, in their own order; all if there is no name.
fn chosen<'c, 'a>(cases: &'c [Case<'a>], names: &[String]) -> Result<Vec<&'c Case<'a>>, Failure> {
    let ids: Vec<&str> = cases.iter().map(|c| c.id).collect();
    if let Some(name) = names.iter().find(|name| !ids.contains(&name.as_str())) {
        let unknown = Error::unknown_name("case", name, &mut ids.iter().copied());
        let known = ids.join(", ");
        return Err(Failure::Usage(format!("{unknown}; there are {known}")));
    }
    let asked = |c: &&Case<'_>| names.is_empty() || names.iter().any(|n| n == c.id);
    Ok(cases.iter().filter(asked).collect())
}

/// The rows of the cases that were finished.
fn compute<'a>(cases: &[&'a Case<'a>], interrupt: Interrupt) -> Vec<Row<'a>> {
    let progress = Progress::new("stability");
    let all: usize = cases.iter().map(|c| c.sweep.values.len()).sum();
    let done = AtomicUsize::new(0);
    let row = |case: &&'a Case<'a>| {
        case.row(interrupt, || {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.set(done as f64 / all as f64, || case.id.to_owned());
        })
    };
    // One case after the other to whoever is free: they differ in length.
    let rows: Vec<Option<Row<'a>>> = cases.par_iter().with_max_len(1).map(row).collect();
    progress.finish();
    rows.into_iter().flatten().collect()
}

/// The rows of stability.csv of a case, one a value.
fn table(row: &Row<'_>) -> impl Iterator<Item = Vec<(&'static str, String)>> {
    row.points.iter().map(|p| {
        let (refusal, message) = p.refusal.clone().unwrap_or_default();
        vec![
            ("case", row.case.id.to_owned()),
            ("value", exact(p.value)),
            ("label", p.label.clone()),
            ("class", p.class.word().to_owned()),
            ("error", p.error.map_or(String::new(), exact)),
            ("refusal", refusal.to_owned()),
            ("message", message),
            ("steps", p.effort.steps.to_string()),
            ("evaluations", p.effort.evaluations.to_string()),
            ("fallbacks", p.effort.fallbacks.to_string()),
            ("seconds", exact(p.seconds)),
        ]
    })
}

/// The table at the terminal.
fn print(directory: &Directory, report: &Stability<'_>) -> Result<(), Failure> {
    output::to_stdout(|w| {
        let width = numbers::width(report.cases.iter().map(|r| r.case.id));
        let accurate = |c| c == Class::Accurate;
        let bounded = |c| c == Class::Accurate || c == Class::Degraded;
        writeln!(
            w,
            "{:width$}  {:17} {:17} {:>6}  {:>11} {:>9} {:>6}  beyond",
            "case", "accurate", "within bound", "bound", "evaluations", "fallbacks", "s"
        )?;
        for row in &report.cases {
            let (effort, seconds) = row.total();
            writeln!(
                w,
                "{:width$}  {:17} {:17} {:>6.0e}  {:>11} {:>9} {:>6.1}  {}",
                row.case.id,
                row.range_text(accurate),
                row.range_text(bounded),
                row.case.bound,
                effort.evaluations,
                effort.fallbacks,
                seconds,
                beyond(row)
            )?;
        }
        let counts = Class::ALL.map(|c| format!("{} {}", report.count(c), c.word()));
        writeln!(w, "{}", directory.told(&counts.join(", "), report.seconds))
    })
}

/// What happens beyond the bound, in a few words.
fn beyond(row: &Row<'_>) -> String {
    let refusals = row.refusals().join(", ");
    match (row.count(Class::Wrong), refusals.as_str()) {
        (0, _) => refusals,
        (wrong, "") => format!("WRONG at {}", numbers::count(wrong, "value")),
        (wrong, _) => format!("{refusals}; WRONG at {}", numbers::count(wrong, "value")),
    }
}
