//! The command `sweep`: many runs of a model, one for each combination of values, as a table.
//!
//! Each row is appended as soon as its run has ended, in one write; a table that is not finished is taken up where it ends. When all runs
//! are there the rows are put in order, so that the file does not depend on the number of cores.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use clap::Args;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use ukcore::model::{Entry, StartSpec};
use ukcore::simulate::{Drift, Ending, Sample};

use crate::columns::{self, Column};
use crate::command::{self, find};
use crate::failure::Failure;
use crate::html::joined;
use crate::interrupt::Interrupt;
use crate::motion::{self, INTERVALS};
use crate::numbers::count;
use crate::output::{self, write_whole};
use crate::progress::Progress;
use crate::runs::{Runs, Variant};
use crate::ways;

/// The command-line arguments of the command `sweep`, to be flattened into a parser of `clap`.
#[derive(Debug, Args)]
pub struct SweepArgs {
    /// Model (see `list`)
    pub model: String,
    /// The runs
    #[command(flatten)]
    pub runs: Runs,
    /// Quantities to tell of, called as in tables of `run`; all outputs and integrals if absent, or all coordinates where there are none
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub of: Vec<String>,
    /// Interval at which extremes are looked for; a thousandth of the run if absent
    #[arg(long, value_name = "TIME", value_parser = motion::positive, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Only a share of the runs, such as `3/10`: every tenth, from the third on. Tables of all shares, one behind the other in one file,
    /// are a table of the sweep, which the same command without a share puts in order and completes
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub shard: Option<(usize, usize)>,
    /// The table, as CSV, or as Parquet where its name ends in `.parquet` and this program is built with that feature: from rows that are
    /// collected in FILE.csv. One that an interrupted sweep has left is completed
    #[arg(long, value_name = "FILE", value_parser = command::path)]
    pub out: PathBuf,
}

/// Reads `K/N`.
fn shard(text: &str) -> Result<(usize, usize), String> {
    let (number, of) = text.split_once('/').unwrap_or((text, ""));
    let read = |text: &str| text.trim().parse::<usize>().ok();
    match (read(number), read(of)) {
        (Some(number), Some(of)) if (1..=of).contains(&number) => Ok((number, of)),
        _ => Err("a share is needed as K/N, with K from 1 to N: `1/10` to `10/10`".to_owned()),
    }
}

/// More members are a slip.
const MOST: usize = 1_000_000;

/// Runs all members that the table has not yet, on all cores.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line, and where the table is of another sweep; [`Failure::Interrupted`] if the
/// user ends it: what is done is kept, and the same command goes on from there; [`Failure::Failed`] if no member could be computed, or the
/// table not be written; [`Failure::Partly`] if some could not: each is a row with its error.
pub fn sweep(models: &[Entry], args: &SweepArgs) -> Result<(), Failure> {
    let entry = find(models, &args.model)?;
    let columns = match args.of.is_empty() {
        true => columns::of_interest(&entry.mechanism),
        false => columns::named(&entry.mechanism, &args.of)?,
    };
    let work = Work {
        entry,
        members: args.runs.each(entry, MOST)?,
        columns,
        every: args.every,
    };
    // Of the ways to begin those of the first run are told.
    let first = &work.members[0].start;
    let ways = first.ready(entry).ok();
    let ways = ways.map_or(Vec::new(), |ready| first.other_ways(&ready));
    ways::tell(args.runs.bare(entry).into_iter().chain(ways));
    let head = work.head()?;
    let rows = rows(&args.out)?;
    let mut table = Table::open(&rows, &head)?;
    let (number, of) = args.shard.unwrap_or((1, 1));
    let own = |member: &usize| member % of == number - 1;
    let mut todo = table.missing(&work)?;
    todo.retain(own);
    let (interrupt, progress) = (Interrupt::catch()?, Progress::new(&entry.id));
    let all = (0..work.members.len()).filter(own).count();
    let done = AtomicUsize::new(0);
    let had = all - todo.len();
    let file = Mutex::new(&mut table.file);
    let run = |&member: &usize| -> Result<(), Failure> {
        if interrupt.is_set() {
            return Ok(());
        }
        let row = work.row(member, interrupt)?;
        if let Some(row) = row.filter(|_| !interrupt.is_set()) {
            let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
            file.write_all(&row).map_err(|e| Failure::file(&rows, &e))?;
            let done = had + 1 + done.fetch_add(1, Ordering::Relaxed);
            progress.set(done as f64 / all as f64, || format!("{done} of {all} runs"));
        }
        Ok(())
    };
    let result = todo.par_iter().with_max_len(1).try_for_each(run);
    progress.finish();
    result?;
    let done = had + done.into_inner();
    if done < all {
        let message = format!(
            "interrupted: {done} of {} are done and kept; the same command goes on from there",
            count(all, "run")
        );
        return Err(Failure::Interrupted(message));
    }
    drop(table);
    let failed = in_order(&rows)?;
    #[cfg(feature = "parquet")]
    if rows != args.out {
        crate::parquet::write(&rows, &args.out)?;
    }
    tell(&failed, all, &args.out)
}

/// Tells how many of `all` runs are in the table, or those that `failed`.
fn tell(failed: &[(String, String)], all: usize, out: &Path) -> Result<(), Failure> {
    let Some((member, error)) = failed.first() else {
        let told = format!("{} in {}", count(all, "run"), out.display());
        return output::to_stdout(|out| writeln!(out, "{told}"));
    };
    if failed.len() == all {
        return Err(Failure::Failed(format!(
            "no run succeeded; the first: {error}"
        )));
    }
    let which = match failed {
        [_] => format!("number {member}"),
        _ => {
            let members = failed.iter().take(SHOWN).map(|(member, _)| member.clone());
            let more = if failed.len() > SHOWN { ", …" } else { "" };
            format!("numbers {}{more}; the first", joined(members))
        }
    };
    Err(Failure::Partly(format!(
        "{} of {} failed (column `error` of {}): {which}: {error}",
        failed.len(),
        count(all, "run"),
        out.display(),
    )))
}

/// The file that rows are appended to: the table itself or, as nothing is appended to a Parquet file, one beside it.
fn rows(out: &Path) -> Result<PathBuf, Failure> {
    let parquet = out
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("parquet"));
    output::promised("--out", out, if parquet { "parquet" } else { "csv" })?;
    if parquet && !cfg!(feature = "parquet") {
        return Err(Failure::Usage(format!(
            "{} would be Parquet, which this program is built without: name a `.csv`, or build it with the feature `parquet` of `uktool`",
            out.display()
        )));
    }
    let mut rows = out.to_owned().into_os_string();
    rows.push(if parquet { ".csv" } else { "" });
    Ok(rows.into())
}

/// Runs that failed are called by their numbers, so many of them.
const SHOWN: usize = 10;

/// The columns that every table has: before options and parameters, behind them, and behind quantities.
const FIRST: [&str; 2] = ["member", "start"];
const SETTINGS: [&str; 5] = ["until", "tolerance", "method", "stabilisation", "t"];
const LAST: [&str; 7] = [
    "residual",
    "energy_drift",
    "steps",
    "rejected",
    "evaluations",
    "fallbacks",
    "error",
];

/// All that is to be computed.
struct Work<'a> {
    entry: &'a Entry,
    members: Vec<Variant>,
    columns: Vec<Column>,
    every: Option<f64>,
}

impl Work<'_> {
    /// The line of names.
    fn head(&self) -> Result<Vec<u8>, Failure> {
        let (_, start, _) = self.members[0].start.settings(self.entry)?;
        // No two columns have one name.
        let own = |what: &str, name: &str| {
            let taken = [&FIRST[..], &SETTINGS, &LAST].concat().contains(&name);
            if taken {
                format!("{what}({name})")
            } else {
                name.to_owned()
            }
        };
        let mut head = FIRST.map(str::to_owned).to_vec();
        let options = start.map_or(&[][..], |s| s.options);
        head.extend(options.iter().map(|o| own("set", o.name)));
        let params = self.entry.mechanism.spec().params;
        head.extend(params.iter().map(|p| own("set", p.name)));
        head.extend(SETTINGS.map(str::to_owned));
        for Column { name, .. } in &self.columns {
            head.push(own("end", name));
            for what in ["min", "t_min", "max", "t_max"] {
                head.push(format!("{what}({name})"));
            }
        }
        head.extend(LAST.map(str::to_owned));
        line(&head)
    }

    /// What says which run member number `k` is.
    fn key(&self, k: usize) -> Result<Vec<String>, Failure> {
        let Variant { start, motion, .. } = &self.members[k];
        let (mechanism, spec, options) = start.settings(self.entry)?;
        let own = spec.filter(|_| !start.guesses());
        let mut key = vec![
            k.to_string(),
            own.map_or("assembled", |s| s.name).to_owned(),
        ];
        for option in spec.map_or(&[][..], |s| s.options) {
            key.push(number(options.get(option.name).unwrap_or(option.default)));
        }
        key.extend(mechanism.parameters().iter().map(|x| number(*x)));
        let until = motion.until.unwrap_or(StartSpec::typical(spec));
        key.extend([
            number(until),
            number(motion.tol),
            motion.method.to_string(),
            motion.stabilise.to_string(),
        ]);
        Ok(key)
    }

    /// The row of member number `k`; nothing where it was interrupted.
    fn row(&self, k: usize, interrupt: Interrupt) -> Result<Option<Vec<u8>>, Failure> {
        let mut row = self.key(k)?;
        let chosen = &self.members[k];
        let ready = match chosen.start.ready(self.entry) {
            Ok(ready) => ready,
            Err(failure) => {
                let missing = 1 + 5 * self.columns.len() + 6;
                row.extend(std::iter::repeat_n(String::new(), missing));
                row.push(failure.message());
                return line(&row).map(Some);
            }
        };
        let values = |sample: Sample<'_>| columns::values(&self.columns, &ready.mechanism, sample);
        let mut extremes = vec![Extremes::default(); self.columns.len()];
        let mut drift = Drift::new(&ready.mechanism);
        let mut last = Vec::new();
        let (motion, ignore) = (&chosen.motion, |_| {});
        let every = motion.interval(&ready, self.every, INTERVALS)?;
        let (trajectory, error) = motion.stream(&ready, every, interrupt, ignore, |sample| {
            last = values(sample);
            for (extremes, value) in extremes.iter_mut().zip(&last) {
                extremes.add(sample.t, *value);
            }
            drift.add(sample);
            ControlFlow::Continue(())
        });
        let error = error.map_or(String::new(), |error| Failure::from(error).message());
        if trajectory.ending() == Ending::Interrupted {
            return Ok(None);
        }
        // That of a run which fails is behind the last sample.
        if let Some(end) = trajectory.last().filter(|_| !last.is_empty()) {
            last = values(end);
        }
        row.push(trajectory.last().map_or(String::new(), |end| number(end.t)));
        last.resize(extremes.len(), f64::NAN);
        for (value, extremes) in last.into_iter().zip(extremes) {
            row.push(number(value));
            row.extend(extremes.told().map(number));
        }
        let work = trajectory.work();
        let told = |known: bool, x: f64| if known { number(x) } else { String::new() };
        // A run that did not begin has none.
        let any = drift.samples() > 0;
        row.push(told(any, drift.residual().largest()));
        let conservative = trajectory.spec().structure.conservative;
        row.push(told(any && conservative, drift.energy()));
        let counts = [work.steps, work.rejected, work.evaluations, work.fallbacks];
        row.extend(counts.map(|n| n.to_string()));
        row.push(error);
        line(&row).map(Some)
    }
}

/// The fewest digits that read back as the same number; nothing for what is none.
fn number(x: f64) -> String {
    if x.is_finite() {
        format!("{x:?}")
    } else {
        String::new()
    }
}

/// The least and the greatest value of a quantity, and when.
#[derive(Debug, Clone, Default)]
struct Extremes {
    /// The samples before this one.
    before: Vec<(f64, f64)>,
    /// (t, value).
    least: Option<(f64, f64)>,
    greatest: Option<(f64, f64)>,
}

impl Extremes {
    fn add(&mut self, t: f64, value: f64) {
        if !value.is_finite() {
            self.before.clear();
            return;
        }
        self.before.push((t, value));
        self.take((t, value));
        if let [a, b, c] = self.before[..] {
            self.take(vertex(a, b, c).unwrap_or(b));
            self.before.remove(0);
        }
    }

    fn take(&mut self, (t, value): (f64, f64)) {
        if self.least.is_none_or(|(_, least)| value < least) {
            self.least = Some((t, value));
        }
        if self.greatest.is_none_or(|(_, greatest)| value > greatest) {
            self.greatest = Some((t, value));
        }
    }

    /// Least, when, greatest, when.
    fn told(&self) -> [f64; 4] {
        let (least, greatest) = (self.least, self.greatest);
        let none = (f64::NAN, f64::NAN);
        let ((t0, low), (t1, high)) = (least.unwrap_or(none), greatest.unwrap_or(none));
        [low, t0, high, t1]
    }
}

/// The vertex of the parabola through three points, if the middle one is the highest or lowest.
fn vertex(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> Option<(f64, f64)> {
    let (left, right) = ((b.1 - a.1) / (b.0 - a.0), (c.1 - b.1) / (c.0 - b.0));
    // Slopes of one sign have no turn between them.
    if left * right >= 0.0 {
        return None;
    }
    let curvature = (right - left) / (c.0 - a.0);
    // y = b + slope (t − t_b) + curvature (t − t_b)².
    let slope = left + curvature * (b.0 - a.0);
    let t = -slope / (2.0 * curvature);
    let value = b.1 + t * (slope + curvature * t);
    (value.is_finite()).then_some((b.0 + t, value))
}

/// A row of a table. Texts of errors have one line.
fn line(fields: &[String]) -> Result<Vec<u8>, Failure> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let plain = fields.iter().map(|field| field.replace(['\n', '\r'], " "));
    let done = writer.write_record(plain).map_err(|e| e.to_string());
    done.and_then(|()| writer.into_inner().map_err(|e| e.to_string()))
        .map_err(Failure::Failed)
}

/// A table that rows are appended to, held as long as it is written.
struct Table {
    path: PathBuf,
    file: File,
    /// The rows of the table, each by the number of its member.
    rows: HashMap<usize, Vec<String>>,
}

impl Table {
    /// The table `path` with this line of names: a new one, or one that is there with all its whole rows.
    fn open(path: &Path, head: &[u8]) -> Result<Self, Failure> {
        let broken = |e: &io::Error| Failure::file(path, e);
        output::directory(path).map_err(|e| broken(&e))?;
        // What is taken up where it ends has an end, and keeps what is written.
        if fs::metadata(path).is_ok_and(|known| !known.is_file()) {
            return Err(Failure::Failed(format!(
                "cannot write {}: it is no file that keeps a table; name another with `--out`",
                path.display()
            )));
        }
        let mut options = File::options();
        let file = options.read(true).append(true).create(true).open(path);
        let mut file = file.map_err(|e| broken(&e))?;
        if let Err(fs::TryLockError::WouldBlock) = file.try_lock() {
            let place = path.display();
            let message = format!(
                "another program is writing {place}; wait for it, or take another file with `--out`"
            );
            return Err(Failure::Failed(message));
        }
        let text = fs::read(path).map_err(|e| broken(&e))?;
        // A line that was being written when the program ended is none.
        let end = text.iter().rposition(|byte| *byte == b'\n');
        let whole = end.map_or(0, |end| end + 1);
        let (path, mut rows) = (path.to_owned(), HashMap::new());
        let new = whole == 0 && head.starts_with(&text);
        if !new && !text.starts_with(head) {
            return Err(other(&path));
        }
        file.set_len(whole as u64).map_err(|e| broken(&e))?;
        if new {
            file.write_all(head).map_err(|e| broken(&e))?;
            return Ok(Table { path, file, rows });
        }
        let mut reader = csv::Reader::from_reader(&text[..whole]);
        let names = reader.headers().cloned().map_err(|_| other(&path))?;
        for record in reader.records() {
            let record = record.map_err(|_| other(&path))?;
            let fields: Vec<String> = record.iter().map(str::to_owned).collect();
            // Tables of shares come one behind the other, each with its head.
            if names.iter().eq(&fields) {
                continue;
            }
            let member = fields[0].parse().map_err(|_| other(&path))?;
            rows.insert(member, fields);
        }
        Ok(Table { path, file, rows })
    }

    /// The members that have no row.
    ///
    /// # Errors
    /// [`Failure::Usage`] where a row is of another sweep.
    fn missing(&mut self, work: &Work<'_>) -> Result<Vec<usize>, Failure> {
        let mut missing = Vec::new();
        for member in 0..work.members.len() {
            match self.rows.remove(&member) {
                None => missing.push(member),
                Some(row) if row.starts_with(&work.key(member)?) => {}
                Some(_) => return Err(other(&self.path)),
            }
        }
        match self.rows.is_empty() {
            true => Ok(missing),
            false => Err(other(&self.path)),
        }
    }
}

fn other(path: &Path) -> Failure {
    Failure::Usage(format!(
        "{} is there and holds something else than the beginning of this sweep; take another file with `--out`, or remove it",
        path.display()
    ))
}

/// Puts the rows in the order of their members; the members that failed, with their errors.
fn in_order(path: &Path) -> Result<Vec<(String, String)>, Failure> {
    let text = fs::read_to_string(path).map_err(|e| Failure::file(path, &e))?;
    let (head, rows) = text.split_once('\n').unwrap_or((&text, ""));
    let member = |row: &&str| {
        let number = row.split(',').next().and_then(|k| k.parse().ok());
        number.unwrap_or(usize::MAX)
    };
    let mut rows: Vec<&str> = rows.lines().filter(|row| *row != head).collect();
    rows.sort_by_key(member);
    rows.dedup_by_key(|row| member(row));
    let sorted = format!("{head}\n{}\n", rows.join("\n"));
    write_whole(path, |out| out.write_all(sorted.as_bytes()))?;
    let mut reader = csv::Reader::from_reader(sorted.as_bytes());
    let ends = |record: csv::StringRecord| {
        let (member, error) = (record.get(0)?, record.get(record.len() - 1)?);
        (!error.is_empty()).then(|| (member.to_owned(), error.to_owned()))
    };
    let records = reader.records();
    Ok(records.filter_map(|record| ends(record.ok()?)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_lie_between_samples() {
        let mut extremes = Extremes::default();
        for k in 0..=100 {
            let t = 0.07 * f64::from(k);
            extremes.add(t, (t - 0.3).sin());
        }
        let [low, t_low, high, t_high] = extremes.told();
        let half = std::f64::consts::FRAC_PI_2;
        for (found, expected) in [
            (high, 1.0),
            (low, -1.0),
            (t_high, half + 0.3),
            (t_low, 3.0 * half + 0.3),
        ] {
            // Of fourth order in the value, of third in the time.
            assert!((found - expected).abs() < 1e-4, "{found} {expected}");
        }
        // At the ends it is the samples themselves.
        let mut rising = Extremes::default();
        (0..5).for_each(|k| rising.add(f64::from(k), f64::from(k * k)));
        assert_eq!(rising.told(), [0.0, 0.0, 16.0, 4.0]);
    }
}
