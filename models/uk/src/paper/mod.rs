//! `uk paper`: the two cases of Zhao, Zhen & Chen 2013, computed, drawn and compared.

mod chain;
mod claims;
mod figures;
mod fish;
mod measure;
mod motion;
mod page;
mod published;

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use models::uchain::{TABLE_1, TableRow};
use rayon::prelude::*;
use serde::Serialize;
use uktool::failure::Failure;
use uktool::output::{self, Directory};
use uktool::progress::Progress;

use chain::{Chain, ChainRow};
use claims::{Claim, Verdict};
use fish::{Fish, FishRow, Gait};
use motion::RunRow;

/// Tolerance of all integrations, relative and absolute. Tighter by four orders than the digits shown, since the chain amplifies an error
/// a hundredfold until its tip turns.
const TOLERANCE: f64 = 1e-10;

/// The directory that the report goes to if nothing is said.
pub(crate) const OUT: &str = "out/paper";

/// Every number on the page.
#[derive(Debug, Serialize)]
struct Paper<'a> {
    about: &'static str,
    signs: &'static str,
    method: &'static str,
    tolerance: f64,
    uchain: Vec<ChainRow>,
    /// The chain hanging in equilibrium before its tip is let go, which is not the paper's start.
    uchain_catenary: ChainRow,
    fish: Vec<FishRow>,
    claims: Vec<Claim>,
    runs: Vec<&'a RunRow>,
    /// Wall time of computing and drawing, s.
    seconds: f64,
}

const ABOUT: &str = "Zhao, Zhen & Chen, Chin. J. Mech. Eng. 26 (2013) 839-850, recomputed. SI units; angles in the unit that the name ends \
    with, else radians.";
const SIGNS: &str = "Chain: y points down, peak is the least acceleration of the tip. Fish: start_acceleration is x1'' at t = 0 and \
    mean_speed is x1(4 s) - x1(3 s) over 1 s; both are negative where the fish swims forward, towards -x.";

/// Computes both cases and writes the report to the directory `out`.
///
/// # Errors
/// [`Failure::Failed`] if an integration fails or a file cannot be written; a report that stood there before is then still whole or partly
/// replaced by files that are each whole, and index.html is written last.
pub(crate) fn paper(out: &Path) -> Result<(), Failure> {
    let started = Instant::now();
    let directory = Directory::create(out)?;
    let (catenary, chains, fishes) = compute()?;
    let uchain: Vec<ChainRow> = chains.iter().map(|c| c.row.clone()).collect();
    let fish: Vec<FishRow> = fishes.iter().map(|f| f.row.clone()).collect();
    for (name, svg) in figures::all(&chains, &fishes)? {
        directory.write(&format!("figures/{name}.svg"), svg)?;
    }
    let runs = chains.iter().chain([&catenary]).map(|c| &c.run);
    let runs: Vec<&RunRow> = runs.chain(fishes.iter().map(|f| &f.run)).collect();
    for run in &runs {
        directory.write(&format!("csv/{}.csv", run.name), &run.csv)?;
    }
    let paper = Paper {
        about: ABOUT,
        signs: SIGNS,
        method: "DOP853 with projection onto the constraints after each step",
        tolerance: TOLERANCE,
        claims: claims::judge(&uchain, &fish),
        uchain,
        uchain_catenary: catenary.row.clone(),
        fish,
        runs,
        seconds: started.elapsed().as_secs_f64(),
    };
    directory.write(chain::FILM, chain::film()?)?;
    directory.write(fish::FILM, fish::film()?)?;
    directory.json("paper.json", &paper)?;
    directory.write("index.html", page::html(&paper))?;
    report(&directory, &paper)
}

/// The chain from another start, those of Table 1 in order of x0, and the fish with all gaits.
fn compute() -> Result<(Chain, Vec<Chain>, Vec<Fish>), Failure> {
    let mut starts = vec![(chain::OTHER_START, &TABLE_1[0])];
    starts.extend(TABLE_1.iter().map(|row| (chain::PAPER_START, row)));
    let gaits = fish::gaits();
    let progress = Progress::new("paper");
    let (done, all) = (AtomicUsize::new(0), starts.len() + gaits.len());
    let note = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.set(done as f64 / all as f64, || format!("{done} of {all} runs"));
    };
    let chain = |(start, row): &(&str, &TableRow)| chain::compute(start, row).inspect(|_| note());
    let fish = |gait: &Gait| fish::compute(*gait).inspect(|_| note());
    let (chains, fishes) = rayon::join(|| each(&starts, chain), || each(&gaits, fish));
    progress.finish();
    let (mut chains, fishes) = (chains?, fishes?);
    Ok((chains.remove(0), chains, fishes))
}

/// What `compute` makes of each item, one after the other by whoever is free.
fn each<T: Sync, R: Send>(
    items: &[T],
    compute: impl Fn(&T) -> Result<R, Failure> + Sync + Send,
) -> Result<Vec<R>, Failure> {
    let items = items.par_iter().with_max_len(1);
    items.map(compute).collect()
}

/// What a person at the terminal wants to know at once.
fn report(directory: &Directory, paper: &Paper<'_>) -> Result<(), Failure> {
    let count = |verdict| paper.claims.iter().filter(|c| c.verdict == verdict).count();
    output::to_stdout(|w| {
        writeln!(
            w,
            "Falling U-chain, Table 1: greatest fall of the tip, its time, deepest acceleration"
        )?;
        writeln!(w, "   x0      h_max (m)          t_max (s)     tip (m/s²)")?;
        writeln!(w, "        paper     here     paper    here        here")?;
        for r in &paper.uchain {
            let (h, t) = (r.paper.h_max, r.paper.t_max);
            writeln!(
                w,
                "   {:2} {h:8.3} {:8.3}   {t:7.3} {:7.3}    {:8.1}",
                r.x0, r.h_max, r.t_max, r.peak
            )?;
        }
        writeln!(
            w,
            "Fish robot: start acceleration and mean speed over 3-4 s; negative is forward"
        )?;
        writeln!(w, "   A3   ω (rad/s)   φ (°)   (m/s²)    (m/s)")?;
        for r in &paper.fish {
            writeln!(
                w,
                "  {:3.1} {:11.4} {:7} {:8.4} {:8.4}",
                r.a3, r.omega, r.phi_deg, r.start_acceleration, r.mean_speed
            )?;
        }
        writeln!(
            w,
            "Of {} claims of the paper {} are borne out, {} nearly, {} not",
            paper.claims.len(),
            count(Verdict::Holds),
            count(Verdict::Nearly),
            count(Verdict::Fails)
        )?;
        let runs = format!("{} runs", paper.runs.len());
        writeln!(w, "{}", directory.told(&runs, paper.seconds))
    })
}
