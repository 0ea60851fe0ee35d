//! The command `diagnose`: what the constraints of a mechanism amount to.

use std::ops::ControlFlow;

use clap::Args;
use ukcore::model::Entry;
use ukcore::{State, diagnose as diagnosis_of, diagnose_along};

use crate::command::find;
use crate::failure::Failure;
use crate::motion::{INTERVALS, Motion, early};
use crate::numbers::full;
use crate::output;
use crate::scene::Scene;
use crate::ways::Look;

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
    let start = &args.scene.start;
    let ready = start.ready(find(models, &args.scene.model)?)?;
    let mech = &ready.mechanism;
    let here = diagnosis_of(mech, &ready.state)?;
    let ways = start.ways(ready.entry, Look::Everywhere)?;
    let mut states: Vec<State> = Vec::new();
    let every = args.motion.interval(&ready, None, INTERVALS)?;
    let (trajectory, error) = args.motion.follow(&ready, every, |sample| {
        states.push(sample.to_state());
        ControlFlow::Continue(())
    })?;
    let nearest = diagnose_along(mech, states)?;
    output::to_stdout(|out| {
        writeln!(out, "{} at `{}`: {here}", ready.entry.id, ready.start)?;
        if let Some(ways) = &ways {
            write!(out, "{ways}")?;
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
    early(&trajectory, error).map_or(Ok(()), Err)
}
