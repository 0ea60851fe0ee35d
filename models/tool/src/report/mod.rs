//! `uk report`: error against run time, of each method, formula and stabilisation, on any model.

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
use std::io;
use std::path::Path;
use std::time::{Instant, UNIX_EPOCH};

use models::{Model, Reference, Visitor};

use crate::args::ReportArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::numbers;
use crate::output;
use crate::progress::Progress;

use export::Report;
use measure::Extent;
use study::Study;

/// Measures the models that are asked for and writes the report to `args.out`.
///
/// # Errors
/// [`Failure::Usage`] for an unknown model; [`Failure::Failed`] if a file cannot be written or a model not be measured, and
/// [`Failure::Interrupted`]: what was measured up to there is written all the same.
pub(crate) fn report(args: &ReportArgs) -> Result<(), Failure> {
    let jobs = jobs(&args.models)?;
    output::create_directory(&args.out)?;
    output::check_writable(&args.out.join("index.html"))?;
    let interrupt = Interrupt::catch()?;
    let mut report = left_over(&args.out, args.quick).unwrap_or_else(|| Report {
        about: export::ABOUT.to_owned(),
        program: program(),
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
        match job.study(args.quick, &interrupt, &done) {
            Ok(study) => report.studies.push(study),
            Err(failure) => report
                .failures
                .push((job.name.clone(), failure.to_string())),
        }
    }
    progress.finish();
    report.seconds += started.elapsed().as_secs_f64();
    report.complete = !interrupt.is_set();
    write_all(&args.out, &report)?;
    if !report.complete {
        let (done, all) = (
            report.studies.iter().filter(|s| s.whole).count(),
            jobs.len(),
        );
        return Err(Failure::Interrupted(format!(
            "interrupted; {done} of {} are in {}, and the same command takes them over",
            numbers::count(all, "motion"),
            args.out.join("index.html").display()
        )));
    }
    tell(&args.out, &report)?;
    match report.failures.first() {
        None => Ok(()),
        Some((name, message)) => Err(Failure::Failed(format!("`{name}`: {message}"))),
    }
}

/// Parameters with which a model is measured, too, beside those it has by default: where they make another problem of it.
const VARIATIONS: &[(&str, &[(&str, f64)])] = &[("spring_pendulum", &[("k", 1e8)])];

/// A motion to measure.
struct Job {
    name: String,
    /// Parameters other than by default.
    settings: &'static [(&'static str, f64)],
    model: &'static str,
    reference: Option<Reference>,
}

/// The motions of the models called `names`, or of all.
///
/// # Errors
/// [`Failure::Usage`] for an unknown name.
fn jobs(names: &[String]) -> Result<Vec<Job>, Failure> {
    let mut jobs = Vec::new();
    if names.is_empty() {
        for id in models::ids() {
            jobs.extend(models::visit(id, Motions)?);
        }
    }
    for name in names {
        let motions = models::visit(name, Motions)?;
        let new = |job: &Job| jobs.iter().all(|j: &Job| j.name != job.name);
        let motions: Vec<Job> = motions.into_iter().filter(new).collect();
        jobs.extend(motions);
    }
    Ok(jobs)
}

/// Lists the motions of a model: one for each end that a reference has, and its variations.
struct Motions;

impl Visitor for Motions {
    type Output = Vec<Job>;

    fn visit<M: Model>(self) -> Vec<Job> {
        let references = M::references();
        let several = references.len() > 1;
        let job = |name, reference| Job {
            name,
            settings: &[],
            model: M::ID,
            reference,
        };
        let mut jobs: Vec<Job> = references
            .into_iter()
            .map(|reference| {
                let end = reference.states.last().map_or(0.0, |s| s.t);
                let name = if several {
                    format!("{} to {end} s", M::ID)
                } else {
                    M::ID.to_owned()
                };
                job(name, Some(reference))
            })
            .collect();
        if jobs.is_empty() {
            jobs.push(job(M::ID.to_owned(), None));
        }
        for (_, settings) in VARIATIONS.iter().filter(|(id, _)| *id == M::ID) {
            let words = settings
                .iter()
                .map(|(name, value)| format!("{name} {value:e}"));
            let name = format!("{} with {}", M::ID, words.collect::<Vec<_>>().join(", "));
            jobs.push(Job {
                settings,
                ..job(name, None)
            });
        }
        jobs
    }
}

impl Job {
    /// Measures it.
    fn study(
        &self,
        quick: bool,
        interrupt: &Interrupt,
        done: &dyn Fn(f64),
    ) -> Result<Study, Failure> {
        struct Measure<'a> {
            job: &'a Job,
            quick: bool,
            interrupt: &'a Interrupt,
            done: &'a dyn Fn(f64),
        }
        impl Visitor for Measure<'_> {
            type Output = Result<Study, Failure>;
            fn visit<M: Model>(self) -> Self::Output {
                let Measure {
                    job,
                    quick,
                    interrupt,
                    done,
                } = self;
                let mut mechanism = M::default();
                for (name, value) in job.settings {
                    mechanism.set(name, *value)?;
                }
                let reference = job.reference.as_ref();
                let extent = Extent { quick };
                measure::study(&job.name, mechanism, reference, extent, interrupt, done)
            }
        }
        models::visit(
            self.model,
            Measure {
                job: self,
                quick,
                interrupt,
                done,
            },
        )?
    }
}

/// What tells this program from another build of it: size and age of its file.
fn program() -> String {
    let file = std::env::current_exe().and_then(fs::metadata);
    let identity = file.and_then(|file| {
        let age = file.modified()?.duration_since(UNIX_EPOCH);
        Ok((file.len(), age.map_or(0, |age| age.as_nanos())))
    });
    let (size, age) = identity.unwrap_or((0, 0));
    format!("{} {size} {age}", env!("CARGO_PKG_VERSION"))
}

/// The report in `out`, if it was interrupted and this very program has measured it in the same way.
fn left_over(out: &Path, quick: bool) -> Option<Report> {
    let text = fs::read_to_string(out.join("report.json")).ok()?;
    let report: Report = serde_json::from_str(&text).ok()?;
    (!report.complete && report.quick == quick && report.program == program()).then_some(report)
}

fn write_all(out: &Path, report: &Report) -> Result<(), Failure> {
    let figures = out.join("figures");
    output::create_directory(&figures)?;
    for study in &report.studies {
        for (name, svg) in charts::of(study)? {
            let path = figures.join(format!("{name}.svg"));
            output::write_whole(&path, |w| w.write_all(svg.as_bytes()))?;
        }
    }
    output::write_whole(&out.join("report.json"), |w| {
        serde_json::to_writer_pretty(&mut *w, report).map_err(io::Error::from)?;
        writeln!(w)
    })?;
    output::write_whole(&out.join("report.csv"), |w| export::csv(report, w))?;
    let html = page::html(report);
    output::write_whole(&out.join("index.html"), |w| w.write_all(html.as_bytes()))
}

/// What a person at the terminal wants to know at once.
fn tell(out: &Path, report: &Report) -> Result<(), Failure> {
    let wide = numbers::width(report.studies.iter().map(|s| s.name.as_str()));
    output::to_stdout(|w| {
        writeln!(
            w,
            "What to take for which scaled error at the end, with the constraints kept"
        )?;
        for study in &report.studies {
            for (k, goal) in verdict::GOALS.into_iter().enumerate() {
                let name = if k == 0 { study.name.as_str() } else { "" };
                match verdict::choice(study, goal, verdict::Among::Kept) {
                    Some(choice) => writeln!(
                        w,
                        "  {name:<wide$}  {goal:.0e}  {:>9}  {} at {:.0e}",
                        page::duration(choice.cost.seconds),
                        choice.variant.label,
                        choice.cost.knob
                    )?,
                    None => writeln!(w, "  {name:<wide$}  {goal:.0e}          –")?,
                }
            }
        }
        writeln!(
            w,
            "{} in {:.1} s; the report is {}",
            numbers::count(report.studies.len(), "motion"),
            report.seconds,
            out.join("index.html").display()
        )
    })
}
