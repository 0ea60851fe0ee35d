//! `uk paper`: the two cases of Zhao, Zhen & Chen 2013, computed, drawn and compared.

mod chain;
mod claims;
mod figures;
mod fish;
mod measure;
mod motion;
mod page;
mod parallel;
mod published;

use std::io;
use std::path::Path;
use std::time::Instant;

use models::uchain::TABLE_1;
use serde::Serialize;

use crate::args::PaperArgs;
use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;

use chain::{Chain, ChainRow};
use claims::Claim;
use fish::{Fish, FishRow, Gait};
use motion::RunRow;

/// Tolerance of all integrations, relative and absolute. Tighter by four orders than the digits shown, since the chain amplifies an error
/// a hundredfold until its tip turns.
const TOLERANCE: f64 = 1e-10;

/// Every number on the page.
#[derive(Debug, Serialize)]
struct Paper {
    about: &'static str,
    signs: &'static str,
    method: &'static str,
    tolerance: f64,
    uchain: Vec<ChainRow>,
    fish: Vec<FishRow>,
    claims: Vec<Claim>,
    runs: Vec<RunRow>,
    /// Wall time of computing and drawing, s.
    seconds: f64,
}

const ABOUT: &str = "Zhao, Zhen & Chen, Chin. J. Mech. Eng. 26 (2013) 839-850, recomputed. SI units; angles in the unit that the name ends with, else radians.";
const SIGNS: &str = "Chain: y points down, peak is the least acceleration of the tip. Fish: start_acceleration is x1'' at t = 0 and mean_speed is x1(4 s) - x1(3 s) over 1 s; both are negative where the fish swims forward, towards -x.";

/// One integration to do.
#[derive(Debug, Clone, Copy)]
enum Job {
    Chain(f64),
    Fish(Gait),
}

enum Outcome {
    Chain(Chain),
    Fish(Fish),
}

/// Computes both cases and writes the report to `args.out`.
///
/// # Errors
/// [`Failure::Failed`] if an integration fails or a file cannot be written; a report that stood there before is then still whole or partly
/// replaced by files that are each whole, and index.html is written last.
pub(crate) fn paper(args: &PaperArgs) -> Result<(), Failure> {
    let started = Instant::now();
    let (chains, fishes) = compute()?;
    let claims = claims::judge(&rows(&chains, |c| &c.row), &rows(&fishes, |f| &f.row));
    let figures = figures::all(&chains, &fishes)?;
    let runs = chains
        .iter()
        .map(|c| c.run.clone())
        .chain(fishes.iter().map(|f| f.run.clone()))
        .collect();
    let paper = Paper {
        about: ABOUT,
        signs: SIGNS,
        method: "DOP853 with projection onto the constraints after each step",
        tolerance: TOLERANCE,
        uchain: rows(&chains, |c| &c.row),
        fish: rows(&fishes, |f| &f.row),
        claims,
        runs,
        seconds: started.elapsed().as_secs_f64(),
    };
    let out = &args.out;
    write_all(out, &paper, &figures, &chains, &fishes)?;
    report(out, &paper)
}

fn rows<T, R: Clone>(items: &[T], row: impl Fn(&T) -> &R) -> Vec<R> {
    items.iter().map(|i| row(i).clone()).collect()
}

fn compute() -> Result<(Vec<Chain>, Vec<Fish>), Failure> {
    let jobs: Vec<Job> = TABLE_1
        .iter()
        .map(|row| Job::Chain(row.x0))
        .chain(fish::gaits().into_iter().map(Job::Fish))
        .collect();
    let progress = Progress::new("paper");
    let outcomes = parallel::map(
        &jobs,
        |job| match job {
            Job::Chain(x0) => chain::compute(*x0).map(Outcome::Chain),
            Job::Fish(gait) => fish::compute(*gait).map(Outcome::Fish),
        },
        |done| {
            progress.set(done as f64 / jobs.len() as f64, || {
                format!("{done} of {} runs", jobs.len())
            })
        },
    );
    progress.finish();
    let (mut chains, mut fishes) = (Vec::new(), Vec::new());
    for outcome in outcomes {
        match outcome? {
            Outcome::Chain(chain) => chains.push(chain),
            Outcome::Fish(fish) => fishes.push(fish),
        }
    }
    Ok((chains, fishes))
}

fn write_all(
    out: &Path,
    paper: &Paper,
    figures: &figures::Figures,
    chains: &[Chain],
    fishes: &[Fish],
) -> Result<(), Failure> {
    for dir in ["figures", "csv"] {
        output::create_directory(&out.join(dir))?;
    }
    for (name, svg) in figures {
        output::write_whole(&out.join("figures").join(format!("{name}.svg")), |w| {
            w.write_all(svg.as_bytes())
        })?;
    }
    let samples = chains
        .iter()
        .map(|c| (&c.run.name, &c.csv))
        .chain(fishes.iter().map(|f| (&f.run.name, &f.csv)));
    for (name, csv) in samples {
        output::write_whole(&out.join("csv").join(format!("{name}.csv")), |w| {
            w.write_all(csv)
        })?;
    }
    output::write_whole(&out.join("paper.json"), |w| {
        serde_json::to_writer_pretty(&mut *w, paper).map_err(io::Error::from)?;
        writeln!(w)
    })?;
    let html = page::html(paper);
    output::write_whole(&out.join("index.html"), |w| w.write_all(html.as_bytes()))
}

/// What a person at the terminal wants to know at once.
fn report(out: &Path, paper: &Paper) -> Result<(), Failure> {
    output::to_stdout(|w| {
        writeln!(
            w,
            "U-chain, Table 1                 h_max             t_max       deepest"
        )?;
        writeln!(
            w,
            "      x0               paper       uk    paper       uk   tip accel."
        )?;
        for row in &paper.uchain {
            writeln!(
                w,
                "      {:<12} {:>11.3} {:>8.3} {:>8.3} {:>8.3} {:>12.1}",
                row.x0, row.paper.h_max, row.h_max, row.paper.t_max, row.t_max, row.peak
            )?;
        }
        let count = |verdict| paper.claims.iter().filter(|c| c.verdict == verdict).count();
        writeln!(
            w,
            "Claims of the paper: {} hold, {} nearly, {} do not.",
            count(claims::Verdict::Holds),
            count(claims::Verdict::Nearly),
            count(claims::Verdict::Fails)
        )?;
        writeln!(
            w,
            "{} runs in {:.1} s. The report is {}",
            paper.runs.len(),
            paper.seconds,
            out.join("index.html").display()
        )
    })
}
