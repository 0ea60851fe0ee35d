//! Why a run cannot go on, in words that help: what is known over several steps, and not in the one that failed last.

use crate::error::Error;
use crate::integrate::{Tolerance, error_norm};
use crate::mechanism::{Spec, SwitchSpec};

/// A contradiction seen nearer to where it begins replaces the one seen first while its residual is at least this part of it:
/// nearer still it fades into rounding, and so do the names.
const FADED: f64 = 1e-3;

/// The contradiction between constraints that is ahead of a run.
///
/// A run retries ever smaller steps, so the failure seen last is at the very place where the constraints come apart: there the residual is rounding
/// and one of the constraints may be missing. What a longer step met says more. It stays of interest while the run has not passed it.
#[derive(Debug, Default)]
pub(super) struct Conflict {
    ahead: Option<Ahead>,
}

#[derive(Debug)]
struct Ahead {
    t: f64,
    y: Vec<f64>,
    error: Error,
    /// Largest residual of the first failure.
    first: f64,
}

/// Level and constraints of an error that is a contradiction.
fn contradiction(error: &Error) -> Option<(&'static str, &[(String, f64)])> {
    match error {
        Error::Inconsistent { constraints } => Some(("acceleration", constraints)),
        Error::OffConstraint { level, constraints } => Some((level, constraints)),
        _ => None,
    }
}

fn names(constraints: &[(String, f64)]) -> impl Iterator<Item = &str> {
    constraints.iter().map(|(name, _)| name.as_str())
}

impl Conflict {
    /// A failure at (t, y).
    pub(super) fn note(&mut self, t: f64, y: &[f64], error: &Error) {
        let Some((level, constraints)) = contradiction(error) else {
            return;
        };
        let largest = constraints
            .iter()
            .fold(0.0, |s: f64, (_, r)| s.max(r.abs()));
        let mut first = largest;
        if let Some(ahead) = &self.ahead
            && let Some((known_level, known)) = contradiction(&ahead.error)
            && known_level == level
            && names(constraints).all(|name| names(known).any(|k| k == name))
        {
            if constraints.len() < known.len() || largest < FADED * ahead.first {
                return;
            }
            first = ahead.first;
        }
        self.ahead = Some(Ahead {
            t,
            y: y.to_vec(),
            error: error.clone(),
            first,
        });
    }

    /// The run has got from `t_old` to `t`: what was seen there is no obstacle.
    pub(super) fn pass(&mut self, t_old: f64, t: f64) {
        let passed = |ahead: &mut Ahead| (ahead.t - t_old).abs() <= (t - t_old).abs();
        self.ahead.take_if(passed);
    }

    /// What to report of a run that ended with `error` at (t, y).
    pub(super) fn explain(&mut self, t: f64, y: Vec<f64>, error: Error) -> (f64, Vec<f64>, Error) {
        match self.ahead.take() {
            Some(ahead) if contradiction(&error).is_some() => (ahead.t, ahead.y, ahead.error),
            _ => (t, y, error),
        }
    }
}

/// So many steps decide whether a run is chattering: well below a second of computing.
const WINDOW: usize = 100_000;

/// Steps fewer than this say nothing of the pace.
const FEW: usize = 100;

/// Mean change of the state over a step, in units of the tolerance, below which a motion chatters. A step across a switch is accepted
/// once the jump times the step is of the order of the tolerance; a step limited by its error in a smooth motion changes the state by many thousands of tolerances.
const CHATTER: f64 = 100.0;

/// Watches the steps where the equations contain sign, abs, min or max.
///
/// Where the motion is driven back onto a switch from both sides, as at rest under dry friction, no step that crosses the switch is
/// good until it is tiny, and the next one crosses it again; the run would use up its steps there without getting on.
#[derive(Debug)]
pub(super) struct Pace {
    /// The terms with a switch; nothing is watched if there are none.
    terms: Vec<String>,
    tolerance: Tolerance,
    /// Steps still allowed, as far as accepted ones count.
    left: usize,
    /// Steps of the window in hand, the time they took, and the changes of the state in units of the tolerance.
    steps: usize,
    time: f64,
    change: f64,
}

impl Pace {
    pub(super) fn new(spec: &Spec, tolerance: Tolerance, max_steps: usize) -> Self {
        Pace {
            terms: terms(&spec.switches.iter().collect::<Vec<_>>()),
            tolerance,
            left: max_steps,
            steps: 0,
            time: 0.0,
            change: 0.0,
        }
    }

    /// Whether there is a switch to be watched.
    #[cfg(feature = "ensemble")]
    pub(super) fn watches(&self) -> bool {
        !self.terms.is_empty()
    }

    /// An accepted step from `y_old` to `y` that took `time`.
    pub(super) fn step(&mut self, time: f64, y_old: &[f64], y: &[f64]) {
        if self.terms.is_empty() {
            return;
        }
        if self.steps == WINDOW {
            (self.steps, self.time, self.change) = (0, 0.0, 0.0);
        }
        self.steps += 1;
        self.left = self.left.saturating_sub(1);
        self.time += time.abs();
        let change = y_old
            .iter()
            .zip(y)
            .map(|(old, new)| (new - old, *old, *new));
        self.change += error_norm(change, self.tolerance);
    }

    /// Whether the steps of a window chatter, and too slowly to get over `remaining` time with the steps left.
    pub(super) fn hopeless(&self, remaining: f64) -> bool {
        let reach = self.time * (self.left as f64 / WINDOW as f64);
        self.steps == WINDOW && self.chatters() && reach < remaining.abs()
    }

    fn chatters(&self) -> bool {
        self.steps >= FEW && self.change < CHATTER * self.steps as f64
    }

    /// What to report of a run whose steps were used up, or that was given up.
    pub(super) fn explain(&self, error: Error) -> Error {
        match error {
            Error::TooManySteps { .. } if self.chatters() => Error::Chattering {
                step: self.time / self.steps as f64,
                terms: self.terms.clone(),
            },
            other => other,
        }
    }
}

/// The terms that turn at zeros of `switches`, each once.
fn terms(switches: &[&SwitchSpec]) -> Vec<String> {
    let mut terms: Vec<String> = Vec::new();
    for term in switches.iter().flat_map(|switch| switch.terms) {
        if !terms.iter().any(|known| known == term) {
            terms.push((*term).to_owned());
        }
    }
    terms
}

/// The error of a motion that is driven onto the zeros of `switches` from both sides.
pub(super) fn stuck(spec: &Spec, switches: &[usize]) -> Error {
    let switches: Vec<&SwitchSpec> = switches.iter().map(|k| &spec.switches[*k]).collect();
    Error::Chattering {
        step: 0.0,
        terms: terms(&switches),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(residual: f64) -> Error {
        Error::Inconsistent {
            constraints: vec![("line".into(), -residual), ("sine".into(), residual)],
        }
    }

    fn one(residual: f64) -> Error {
        Error::Inconsistent {
            constraints: vec![("sine".into(), residual)],
        }
    }

    #[test]
    fn the_conflict_nearest_to_its_beginning_that_is_not_faded_is_told() {
        let mut conflict = Conflict::default();
        for (t, error) in [
            (1.5, split(0.5)),
            (1.1, split(0.1)),
            (1.001, split(1e-3)),
            (1.0001, split(1e-4)),
            (1.0 + 1e-12, one(1e-12)),
        ] {
            conflict.note(t, &[t], &error);
        }
        conflict.pass(0.0, 1.0);
        let told = conflict.explain(1.0, vec![1.0], one(1e-300));
        assert_eq!(told, (1.001, vec![1.001], split(1e-3)));
    }

    #[test]
    fn what_was_passed_or_is_of_another_kind_is_not_told() {
        let mut conflict = Conflict::default();
        conflict.note(-1.5, &[0.0], &split(0.5));
        conflict.pass(-1.0, -2.0);
        let last = (-2.0, vec![1.0], one(1e-3));
        let (t, y, error) = last.clone();
        assert_eq!(conflict.explain(t, y, error), last);
        conflict.note(-2.5, &[0.0], &split(0.5));
        let other = (-2.0, vec![1.0], Error::StepTooSmall { step: 1e-20 });
        let (t, y, error) = other.clone();
        assert_eq!(conflict.explain(t, y, error), other);
    }
}
