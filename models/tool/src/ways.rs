//! How else what is asked for could be put together.

use std::fmt;
use std::io::{self, Write};

use ukcore::model::Entry;
use ukcore::studies::Assembled;
use ukcore::{assemble_with_alternatives, branches};

use crate::failure::Failure;
use crate::scene::{Ready, Start};

/// The places where other ways are looked for.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Look {
    /// The parts where assembly compares such ways.
    AtParts,
    /// All around the guess, too, where coordinates stay free: dozens of searches.
    Everywhere,
}

/// Ways that are noted, at most.
const NOTES: usize = 3;

/// A start as it was put together, and the ways that are as near.
pub(crate) struct Ways {
    found: Assembled,
    names: &'static [&'static str],
    /// Whether it is assembled from guesses on the command line, not from what a start says.
    guessed: bool,
}

impl Start {
    /// How the start was put together by what it says, or from guesses, and how else it could have been; `None` where it is given by
    /// other means, as closed forms.
    pub(crate) fn ways(&self, entry: &Entry, look: Look) -> Result<Option<Ways>, Failure> {
        let (mechanism, spec, options) = self.settings(entry)?;
        let declared = spec.filter(|spec| mechanism.spec().starts.contains(spec));
        let guessed = self.guesses() || spec.is_none();
        let found = if guessed {
            let (guess, hold) = (self.guess(entry)?, self.place.held());
            match look {
                Look::AtParts => assemble_with_alternatives(&mechanism, &guess, &hold)?,
                Look::Everywhere => branches(&mechanism, &guess, &hold)?,
            }
        } else if let Some(spec) = declared {
            match look {
                Look::AtParts => mechanism.start_with_alternatives(spec.name, &options)?,
                Look::Everywhere => mechanism.branches(spec.name, &options)?,
            }
        } else {
            return Ok(None);
        };
        let names = mechanism.spec().coords;
        Ok(Some(Ways {
            found,
            names,
            guessed,
        }))
    }

    /// A sentence for each way that assembly sees to put together what stands there as near to what was asked for.
    pub(crate) fn other_ways(&self, ready: &Ready<'_>) -> Vec<String> {
        // A start that is given by other means need not be declared so that it can be assembled.
        let ways = self.ways(ready.entry, Look::AtParts).ok().flatten();
        let ways = ways.filter(|ways| ways.found.state == ready.state);
        let mut others: Vec<String> = ways.iter().flat_map(Ways::others).collect();
        if others.len() > NOTES {
            let more = others.len() - NOTES;
            others.truncate(NOTES);
            others.push(format!("{more} more such ways; `diagnose` lists them"));
        }
        others
    }
}

/// Writes notes to standard error, each once.
pub(crate) fn tell(notes: impl IntoIterator<Item = String>) {
    let mut told = Vec::new();
    for note in notes {
        if !told.contains(&note) {
            // It may be closed.
            let _ = writeln!(io::stderr(), "note: {note}");
            told.push(note);
        }
    }
}

/// Coordinates that differ, at most.
const SHOWN: usize = 6;

/// What differs by less than this share of what differs most is the same.
const SAME: f64 = 1e-6;

/// Coordinates, and by how much they differ.
fn listed(changes: &[(&str, f64)]) -> String {
    let shown = changes.iter().take(SHOWN);
    let shown: Vec<String> = shown
        .map(|(name, by)| format!("`{name}` by {by:.3}"))
        .collect();
    shown.join(", ")
}

impl Ways {
    /// A sentence for each other way that is as near.
    pub(crate) fn others(&self) -> impl Iterator<Item = String> {
        let (said, decides) = match self.guessed {
            true => ("is guessed", "`--guess` or `--hold`"),
            false => ("the start says", "`near` or `=` in it"),
        };
        self.found.alternatives.iter().map(move |other| {
            let changes = self.names.iter().zip(&self.found.state.q).zip(&other.q);
            let changes = changes.map(|((name, q), p)| (*name, p - q));
            let mut changes: Vec<(&str, f64)> = changes.collect();
            changes.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
            let most = changes.first().map_or(0.0, |(_, by)| by.abs());
            changes.retain(|(_, by)| by.abs() > SAME * most);
            let changes = listed(&changes);
            format!("another way to put it together is as near to what {said}: it differs in {changes}; {decides} decides")
        })
    }
}

impl fmt::Display for Ways {
    /// What moved most, and the other ways, a line each.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.found.moved.is_empty() {
            writeln!(f, "put together, {} moved most", listed(&self.found.moved))?;
        }
        self.others().try_for_each(|other| writeln!(f, "{other}"))
    }
}
