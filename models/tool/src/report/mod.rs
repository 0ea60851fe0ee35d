//! The command `report`: error against run time, of each method, formula and stabilisation, on any model.

mod argument;
mod charts;
mod clock;
mod export;
mod measure;
mod page;
mod study;
mod truth;
mod variants;
mod verdict;

use std::fs;
use std::path::PathBuf;
use std::time::{Instant, UNIX_EPOCH};

use clap::Args;
use ukcore::model::{Entry, Reference};

use crate::command::{self, find};
use crate::failure::Failure;
use crate::html::joined;
use crate::interrupt::Interrupt;
use crate::motion;
use crate::numbers;
use crate::output::{self, Directory};
use crate::progress::Progress;
use crate::scene::Start;

use export::Report;
pub(crate) use truth::{largest, scale, states};

/// The command-line arguments of the command `report`, to be flattened into a parser of `clap`.
#[derive(Debug, Args)]
pub struct ReportArgs {
    /// Models to measure (see `list`); all of them if none is named
    #[arg(value_name = "MODEL")]
    pub models: Vec<String>,
    /// Directory to write index.html, report.json, report.csv and figures to. What an interrupted report has left there is taken over
    #[arg(long, value_name = "DIR", default_value = "out/report", value_parser = command::path)]
    pub out: PathBuf,
    /// A quick look: few tolerances, each timed once
    #[arg(long)]
    pub quick: bool,
    /// Time to stop at, of one model; its own duration if absent
    #[arg(long, value_name = "TIME", value_parser = motion::positive, allow_hyphen_values = true)]
    pub until: Option<f64>,
    /// The parameters and the start of one model
    #[command(flatten)]
    pub start: Start,
}

/// Measures the models that are asked for and writes the report to `args.out`.
///
/// # Errors
/// [`Failure::Usage`] for an unknown model; [`Failure::Failed`] if a file cannot be written or a model not be measured, and
/// [`Failure::Interrupted`]: what was measured up to there is written all the same.
pub fn report(models: &[Entry], args: &ReportArgs) -> Result<(), Failure> {
    let jobs = jobs(models, args)?;
    let directory = Directory::create(&args.out)?;
    let interrupt = Interrupt::catch()?;
    let mut report = left_over(&directory, args).unwrap_or_else(|| Report {
        about: export::ABOUT.to_owned(),
        program: program(args),
        quick: args.quick,
        complete: false,
        clock: clock::KIND.to_owned(),
        seconds: 0.0,
        failures: Vec::new(),
        studies: Vec::new(),
    });
    let known = std::mem::take(&mut report.studies);
    report.failures.clear();
    let started = Instant::now();
    let progress = Progress::new("report");
    for (k, job) in jobs.iter().enumerate() {
        if let Some(study) = known.iter().find(|s| s.name == job.name && s.whole) {
            report.studies.push(study.clone());
            continue;
        }
        if interrupt.is_set() {
            break;
        }
        let done = |part: f64| {
            progress.set((k as f64 + part) / jobs.len() as f64, || job.name.clone());
        };
        match measure::study(job, args.quick, interrupt, &done) {
            Ok(study) => report.studies.push(study),
            Err(failure) => report.failures.push((job.name.clone(), failure.message())),
        }
    }
    progress.finish();
    report.seconds += started.elapsed().as_secs_f64();
    report.complete = !interrupt.is_set();
    write_all(&directory, &report)?;
    if !report.complete {
        let done = report.studies.iter().filter(|s| s.whole).count();
        return Err(Failure::Interrupted(format!(
            "interrupted; {done} of {} are in {}, and the same command takes them over",
            numbers::count(jobs.len(), "motion"),
            directory.file("index.html").display()
        )));
    }
    tell(&directory, &report)?;
    match report.failures.first() {
        None => Ok(()),
        Some((name, message)) => Err(Failure::Failed(format!("`{name}`: {message}"))),
    }
}

struct Job<'a> {
    name: String,
    entry: &'a Entry,
    start: Start,
    end: f64,
    reference: Option<Reference>,
}

/// The motions of the models that are asked for.
///
/// # Errors
/// [`Failure::Usage`] for an unknown name, or where a start is given and not the one model that it is for.
fn jobs<'a>(models: &'a [Entry], args: &ReportArgs) -> Result<Vec<Job<'a>>, Failure> {
    let mut entries: Vec<&Entry> = Vec::new();
    for name in &args.models {
        let entry = find(models, name)?;
        if entries.iter().all(|e| e.id != entry.id) {
            entries.push(entry);
        }
    }
    if args.models.is_empty() {
        entries.extend(models);
    }
    if args.start.is_default() && args.until.is_none() {
        return Ok(entries.into_iter().flat_map(motions).collect());
    }
    let [entry] = entries[..] else {
        let message =
            "`--set`, `--start`, `--guess`, `--hold` and `--until` are of one model; name it";
        return Err(Failure::Usage(message.to_owned()));
    };
    // What is wrong with them is told before anything is written.
    let ready = args.start.noted(entry)?;
    Ok(vec![Job {
        name: entry.id.clone(),
        entry,
        start: args.start.clone(),
        end: args.until.unwrap_or(ready.duration),
        reference: None,
    }])
}

/// The motions of a model: one for each end that a reference has, and its variations.
fn motions(entry: &Entry) -> Vec<Job<'_>> {
    let references = entry.references();
    let several = references.len() > 1;
    let job = |name, reference| Job {
        name,
        entry,
        start: Start::default(),
        end: entry.duration,
        reference,
    };
    let mut jobs: Vec<Job<'_>> = Vec::new();
    for reference in references {
        let end = reference.states.last().map_or(0.0, |s| s.t);
        let name = match several {
            true => format!("{} to {end} s", entry.id),
            false => entry.id.clone(),
        };
        jobs.push(job(name, Some(reference)));
    }
    if jobs.is_empty() {
        jobs.push(job(entry.id.clone(), None));
    }
    for variation in entry.variations {
        let words = joined(
            variation
                .iter()
                .map(|(name, value)| format!("{name} {value:e}")),
        );
        jobs.push(Job {
            start: Start::with(None, variation),
            ..job(format!("{} with {words}", entry.id), None)
        });
    }
    jobs
}

/// What tells this program and its order from another: size and age of its file, and what was asked for.
fn program(args: &ReportArgs) -> String {
    let file = std::env::current_exe().and_then(fs::metadata);
    let identity = file.and_then(|file| {
        let age = file.modified()?.duration_since(UNIX_EPOCH);
        Ok((file.len(), age.map_or(0, |age| age.as_nanos())))
    });
    let (size, age) = identity.unwrap_or((0, 0));
    let mut program = format!("{} {size} {age}", env!("CARGO_PKG_VERSION"));
    if !args.start.is_default() || args.until.is_some() {
        program += &format!(" {:?} {:?}", args.start, args.until);
    }
    program
}

/// The report in the directory, if it was interrupted and this very program has measured it in the same way.
fn left_over(directory: &Directory, args: &ReportArgs) -> Option<Report> {
    let text = fs::read_to_string(directory.file("report.json")).ok()?;
    let report: Report = serde_json::from_str(&text).ok()?;
    let same = report.quick == args.quick && report.program == program(args);
    (!report.complete && same).then_some(report)
}

fn write_all(directory: &Directory, report: &Report) -> Result<(), Failure> {
    for study in &report.studies {
        for (name, svg) in charts::of(study)? {
            directory.write(&format!("figures/{name}.svg"), svg)?;
        }
    }
    directory.json("report.json", report)?;
    directory.csv("report.csv", report.studies.iter().flat_map(export::rows))?;
    directory.write("index.html", page::html(report))
}

/// What a person at the terminal wants to know at once.
fn tell(directory: &Directory, report: &Report) -> Result<(), Failure> {
    let wide = numbers::width(report.studies.iter().map(|s| s.name.as_str()));
    let goals = verdict::looked_at(report.quick, &report.studies);
    output::to_stdout(|w| {
        writeln!(
            w,
            "What to take for which scaled error at the end, with the constraints kept"
        )?;
        for study in &report.studies {
            for (k, &goal) in goals.iter().enumerate() {
                let name = if k == 0 { study.name.as_str() } else { "" };
                let choice = verdict::choice(study, goal, verdict::Among::Kept);
                let words = choice.map_or("        –".to_owned(), |choice| {
                    let (time, knob) = (numbers::duration(choice.cost.seconds), choice.cost.knob);
                    format!("{time:>9}  {} at {knob:.0e}", choice.variant.label)
                });
                let goal = format!("{goal:.0e}");
                writeln!(w, "  {name:<wide$}  {goal:<5}  {words}")?;
            }
        }
        let motions = numbers::count(report.studies.len(), "motion");
        writeln!(w, "{}", directory.told(&motions, report.seconds))
    })
}
