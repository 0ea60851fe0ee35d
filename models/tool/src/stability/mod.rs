//! `uk stability`: how far stiff and extreme cases go.
//!
//! Each case sweeps one thing until it breaks. Every value comes out accurate, degraded within a stated bound, or refused with an error that has
//! a name. A result that is off by more, without a word, is the one thing that must not be: it makes the command fail.

mod case;
mod cases;
mod mechanisms;
mod page;
mod picture;

use std::io::{self, Write};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use serde::Serialize;
use ukcore::Error;

use crate::args::StabilityArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::numbers;
use crate::output;
use crate::parallel;
use crate::progress::Progress;

use case::{Case, Class, Row};

/// Every number on the page.
#[derive(Debug, Serialize)]
struct Stability {
    about: &'static str,
    cases: Vec<Row>,
    /// Wall time, s.
    seconds: f64,
}

const ABOUT: &str = "Errors are parts of the size of the result; `ordinary` is the index of the value at which nothing is extreme.";

/// A number in the sweeps: a power of ten as such.
fn short(value: f64) -> String {
    let text = format!("{value:e}");
    if (0.01..1000.0).contains(&value.abs()) || value == 0.0 {
        return numbers::short(value, 6);
    }
    text
}

/// Runs the cases and writes the report to `args.out`.
///
/// # Errors
/// [`Failure::Usage`] for a case that is not there; [`Failure::Failed`] if a result is wrong, or a file cannot be written; [`Failure::Interrupted`]
/// after Ctrl-C, with the cases that were finished written.
pub(crate) fn stability(args: &StabilityArgs) -> Result<(), Failure> {
    let started = Instant::now();
    let cases = chosen(&args.cases)?;
    output::create_directory(&args.out)?;
    output::check_writable(&args.out.join("index.html"))?;
    let interrupt = Interrupt::catch()?;
    let rows = compute(&cases, &interrupt);
    let report = Stability {
        about: ABOUT,
        cases: rows,
        seconds: started.elapsed().as_secs_f64(),
    };
    write_all(&args.out, &report)?;
    print(&args.out, &report)?;
    if report.cases.len() < cases.len() {
        let done = report.cases.len();
        return Err(Failure::Interrupted(format!(
            "interrupted; {done} of {} are written",
            numbers::count(cases.len(), "case")
        )));
    }
    let wrong = report.cases.iter().map(|r| r.count(Class::Wrong)).sum();
    if wrong > 0 {
        return Err(Failure::Failed(format!(
            "{} off by more than the bound of the case, and no error said so",
            match wrong {
                1 => "1 result is".to_owned(),
                _ => format!("{wrong} results are"),
            }
        )));
    }
    Ok(())
}

/// The cases with these names, in their own order; all if there is no name.
fn chosen(names: &[String]) -> Result<Vec<Case>, Failure> {
    let mut cases = cases::all();
    for name in names {
        if !cases.iter().any(|c| c.id == name) {
            let ids: Vec<&str> = cases.iter().map(|c| c.id).collect();
            let unknown = Error::unknown_name("case", name, &mut ids.iter().copied());
            return Err(Failure::Usage(format!(
                "{unknown}; there are {}",
                ids.join(", ")
            )));
        }
    }
    if !names.is_empty() {
        cases.retain(|c| names.iter().any(|n| n == c.id));
    }
    Ok(cases)
}

/// The rows of the cases that were finished.
fn compute(cases: &[Case], interrupt: &Interrupt) -> Vec<Row> {
    let progress = Progress::new("stability");
    let all: usize = cases.iter().map(|c| c.sweep.values.len()).sum();
    let done = AtomicUsize::new(0);
    let rows = parallel::map(
        cases,
        |case| {
            case.row(interrupt, || {
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                progress.set(done as f64 / all as f64, || case.id.to_owned());
            })
        },
        |_| {},
    );
    progress.finish();
    rows.into_iter().flatten().collect()
}

fn write_all(out: &Path, report: &Stability) -> Result<(), Failure> {
    let svg = picture::svg(&report.cases);
    output::write_whole(&out.join("stability.svg"), |w| w.write_all(svg.as_bytes()))?;
    output::write_whole(&out.join("stability.json"), |w| {
        serde_json::to_writer_pretty(&mut *w, report).map_err(io::Error::from)?;
        writeln!(w)
    })?;
    output::write_whole(&out.join("stability.csv"), |w| csv(w, &report.cases))?;
    let html = page::html(report);
    output::write_whole(&out.join("index.html"), |w| w.write_all(html.as_bytes()))
}

fn csv(w: &mut dyn Write, rows: &[Row]) -> io::Result<()> {
    writeln!(
        w,
        "case,value,label,class,error,refusal,message,steps,evaluations,fallbacks,seconds"
    )?;
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    for row in rows {
        for p in &row.points {
            let error = p.error.map_or(String::new(), |e| format!("{e:e}"));
            let (name, message) = match &p.refusal {
                Some((name, message)) => (*name, quoted(message)),
                None => ("", String::new()),
            };
            writeln!(
                w,
                "{},{:e},{},{},{error},{name},{message},{},{},{},{:.6}",
                row.id,
                p.value,
                quoted(&p.label),
                p.class.word(),
                p.effort.steps,
                p.effort.evaluations,
                p.effort.fallbacks,
                p.seconds
            )?;
        }
    }
    Ok(())
}

/// The table at the terminal.
fn print(out: &Path, report: &Stability) -> Result<(), Failure> {
    output::to_stdout(|w| {
        let width = numbers::width(report.cases.iter().map(|r| r.id));
        let accurate = |c| c == Class::Accurate;
        let bounded = |c| c != Class::Refused && c != Class::Wrong;
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
                row.id,
                row.range_text(accurate),
                row.range_text(bounded),
                row.bound,
                effort.evaluations,
                effort.fallbacks,
                seconds,
                beyond(row)
            )?;
        }
        let count = |class| -> usize { report.cases.iter().map(|r| r.count(class)).sum() };
        let counts = Class::ALL.map(|c| format!("{} {}", count(c), c.word()));
        writeln!(
            w,
            "{} in {:.1} s; the report is {}",
            counts.join(", "),
            report.seconds,
            out.join("index.html").display()
        )
    })
}

/// What happens beyond the bound, in a few words.
fn beyond(row: &Row) -> String {
    let wrong = row.count(Class::Wrong);
    let mut words = row.refusals().join(", ");
    if wrong > 0 {
        if !words.is_empty() {
            words.push_str("; ");
        }
        words.push_str(&format!("WRONG at {}", numbers::count(wrong, "value")));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_cases_are_unique_and_found() {
        let cases = cases::all();
        for (i, case) in cases.iter().enumerate() {
            assert!(cases[..i].iter().all(|c| c.id != case.id), "{}", case.id);
            assert!(case.accurate <= case.bound, "{}", case.id);
            assert!(case.sweep.ordinary < case.sweep.values.len());
        }
        let two = chosen(&["turns".to_owned(), "whip".to_owned()]).expect("cases");
        assert_eq!(
            two.iter().map(|c| c.id).collect::<Vec<_>>(),
            ["whip", "turns"]
        );
        let unknown = chosen(&["whop".to_owned()]);
        assert!(matches!(unknown, Err(Failure::Usage(m)) if m.contains("did you mean `whip`")));
    }

    #[test]
    fn powers_of_ten_are_short() {
        for (value, text) in [
            (1e-12, "1e-12"),
            (0.1, "0.1"),
            (17.0, "17"),
            (1e4, "1e4"),
            (0.0, "0"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
