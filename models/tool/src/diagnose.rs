//! The command `diagnose`: what the constraints of a mechanism amount to.

use std::io::{self, Write};
use std::ops::ControlFlow;

use clap::Args;
use ukcore::model::Entry;
use ukcore::{Assembled, State, diagnose as diagnosis_of, diagnose_along};

use crate::failure::Failure;
use crate::motion::{INTERVALS, Motion};
use crate::numbers::full;
use crate::output;
use crate::scene::{Scene, Start};

/// The command-line arguments of the command `diagnose`, to be flattened into a parser of `clap`.
#[derive(Debug, Args)]
pub struct DiagnoseArgs {
    /// The mechanism and its start
    #[command(flatten)]
    pub scene: Scene,
    /// How its motion is computed
    #[command(flatten)]
    pub motion: Motion,
}

/// Prints the diagnosis of the start, then that of the state of a run that is nearest to a singular position.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line; [`Failure::Failed`] where the equations cannot be solved or the run ends
/// early: what was found up to there is printed all the same.
pub fn diagnose(models: &[Entry], args: &DiagnoseArgs) -> Result<(), Failure> {
    let ready = args.scene.ready(models)?;
    let mech = &ready.mechanism;
    let here = diagnosis_of(mech, &ready.state)?;
    let branches = otherwise(ready.entry, &args.scene.start)?;
    let mut states: Vec<State> = Vec::new();
    let every = args.motion.interval(&ready, None, INTERVALS)?;
    let (_, error) = args.motion.follow(&ready, every, |sample| {
        states.push(sample.to_state());
        ControlFlow::Continue(())
    })?;
    let nearest = diagnose_along(mech, states)?;
    output::to_stdout(|out| {
        writeln!(out, "{} at `{}`: {here}", ready.entry.id, ready.start)?;
        if let Some(found) = &branches {
            tell(out, mech.spec().coords, found)?;
        }
        let Some(nearest) = nearest.filter(|nearest| nearest.t != here.t) else {
            return Ok(());
        };
        let t = full(nearest.t);
        match nearest.nearness().filter(|_| nearest.rank == here.rank) {
            Some(nearness) => writeln!(out, "of its run at t = {t} s {nearness}"),
            None => writeln!(out, "\nof its run at t = {t} s: {nearest}"),
        }
    })?;
    error.map_or(Ok(()), |error| Err(error.into()))
}

/// How else the start could be put together by what it says.
fn otherwise(entry: &Entry, start: &Start) -> Result<Option<Assembled>, Failure> {
    if start.guesses() {
        return Ok(None);
    }
    let (mechanism, spec, options) = start.settings(entry)?;
    let declared = mechanism.spec().starts;
    match spec.filter(|spec| declared.contains(spec)) {
        Some(spec) => Ok(Some(mechanism.branches(spec.name, &options)?)),
        None => Ok(None),
    }
}

/// Coordinates that differ, at most.
const SHOWN: usize = 6;

fn tell(out: &mut dyn Write, names: &[&str], found: &Assembled) -> io::Result<()> {
    let listed = |moved: &[(&str, f64)]| {
        let parts = moved.iter().take(SHOWN);
        let parts = parts.map(|(name, by)| format!("`{name}` by {by:.3}"));
        parts.collect::<Vec<_>>().join(", ")
    };
    if !found.moved.is_empty() {
        writeln!(out, "put together, {} moved most", listed(&found.moved))?;
    }
    for other in &found.alternatives {
        let changes = names.iter().zip(&found.state.q).zip(&other.q);
        let mut changes: Vec<(&str, f64)> = changes.map(|((name, q), p)| (*name, p - q)).collect();
        changes.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        let changes = listed(&changes);
        writeln!(
            out,
            "another way to put it together is as near to what the start says: there {changes} differ; `near` or `=` decides"
        )?;
    }
    Ok(())
}
