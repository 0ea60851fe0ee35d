//! Why a run cannot go on, in words that help: what is known over several steps, and not in the one that failed last.

use super::Settings;
use super::sample::Sample;
use super::sums::{Tolerance, error_norm};
use crate::assemble::State;
use crate::error::Error;
use crate::scan::all_finite;
use crate::spec::SwitchSpec;

/// An error and the state where it arose.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trouble {
    pub(crate) state: State,
    pub(crate) error: Error,
}

/// Why a step cannot be made: an error, or none where the state is not finite, as happens after far too long a step.
pub(crate) type Cause = Option<Box<Trouble>>;

impl Trouble {
    pub(crate) fn new(at: Sample<'_>, error: Error) -> Self {
        let state = at.to_state();
        Trouble { state, error }
    }

    /// `error` at a state of a step, which says nothing where the state is not finite.
    pub(crate) fn cause(at: Sample<'_>, error: Error) -> Cause {
        (all_finite(at.q) && all_finite(at.v)).then(|| Box::new(Trouble::new(at, error)))
    }

    /// Whether constraints contradict each other.
    pub(crate) fn is_contradiction(&self) -> bool {
        contradiction(&self.error).is_some()
    }
}

/// A contradiction seen nearer to where it begins replaces the one seen first while its residual is at least this part of it:
/// nearer still it fades into rounding, and so do the names.
const FADED: f64 = 1e-3;

/// The contradiction between constraints that is ahead of a run.
///
/// A run retries ever smaller steps, so the failure seen last is at the very place where the constraints come apart: there the residual
/// is rounding and one of the constraints may be missing. What a longer step met says more. It stays of interest while the run has not
/// passed it.
#[derive(Debug, Default)]
pub(crate) struct Conflict {
    ahead: Option<Trouble>,
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
    /// Takes note of a failure.
    pub(crate) fn note(&mut self, at: Sample<'_>, error: &Error) {
        let Some((level, constraints)) = contradiction(error) else {
            return;
        };
        let sizes = constraints.iter().map(|(_, residual)| residual.abs());
        let largest = sizes.fold(0.0, f64::max);
        let known = self.ahead.as_ref().map(|ahead| &ahead.error);
        match known.and_then(contradiction) {
            Some((known_level, known))
                if known_level == level
                    && names(constraints).all(|name| names(known).any(|k| k == name)) =>
            {
                if constraints.len() < known.len() || largest < FADED * self.first {
                    return;
                }
            }
            _ => self.first = largest,
        }
        self.ahead = Some(Trouble::new(at, error.clone()));
    }

    /// The run has got from `t_old` to `t`: what was seen there is no obstacle.
    pub(crate) fn pass(&mut self, t_old: f64, t: f64) {
        let passed = |ahead: &mut Trouble| (ahead.state.t - t_old).abs() <= (t - t_old).abs();
        self.ahead.take_if(passed);
    }

    /// What to report of a run that ended with `last`.
    pub(crate) fn explain(&mut self, last: Trouble) -> Trouble {
        match self.ahead.take() {
            Some(ahead) if contradiction(&last.error).is_some() => ahead,
            _ => last,
        }
    }
}

/// So many steps decide whether a run gets on: well below a second of computing.
const WINDOW: usize = 100_000;

/// Steps fewer than this say nothing of the pace.
const FEW: usize = 100;

/// Mean change of the state over a step, in units of the tolerance, below which a motion chatters. A step across a switch is accepted
/// once the jump times the step is of the order of the tolerance; a step limited by its error in a smooth motion changes the state by
/// many thousands of tolerances.
const CHATTER: f64 = 100.0;

/// A run with whose pace all steps allowed would cover less than this part of its way does not get on: no motion is known whose steps grow
/// so much after so many.
const STANDSTILL: f64 = 1e-6;

/// Watches the pace of a run.
///
/// Where equations contain sign, abs, min or max, and the motion is driven back onto a switch from both sides, as at rest under dry
/// friction, no step that crosses the switch is good until it is tiny, and the next one crosses it again; the run would use up its steps
/// there without getting on.
#[derive(Debug)]
pub(crate) struct Pace {
    /// All switches of the equations.
    pub(super) switches: &'static [SwitchSpec],
    tolerance: Tolerance,
    /// Steps allowed, and still allowed as far as accepted ones count.
    most: usize,
    left: usize,
    /// Steps of the window in hand, the way they made, and the changes of the state in units of the tolerance.
    steps: usize,
    way: f64,
    change: f64,
    /// Steps in a row that changed the state as little as chattering does, and the size of the last.
    slow: usize,
    size: f64,
    /// How many of those lead across the zero of each switching function.
    crossed: Vec<usize>,
}

impl Pace {
    pub(crate) fn new(settings: &Settings) -> Self {
        Pace {
            switches: settings.switches,
            tolerance: settings.tolerance.clone(),
            most: settings.max_steps,
            left: settings.max_steps,
            steps: 0,
            way: 0.0,
            change: 0.0,
            slow: 0,
            size: 0.0,
            crossed: vec![0; settings.switches.len()],
        }
    }

    /// An accepted step of size `h` between two states, as large as it may be or less.
    pub(crate) fn step<Y: AsRef<[f64]>>(
        &mut self,
        h: f64,
        largest: bool,
        states: impl FnOnce() -> [Y; 2],
    ) {
        if self.steps == WINDOW {
            (self.steps, self.way, self.change) = (0, 0.0, 0.0);
        }
        self.steps += 1;
        self.left = self.left.saturating_sub(1);
        self.way += h.abs();
        if self.switches.is_empty() || largest {
            self.change += CHATTER;
            self.slow = 0;
            return;
        }
        let [old, new] = states();
        let pairs = old.as_ref().iter().zip(new.as_ref());
        let change = pairs.map(|(old, new)| (new - old, *old, *new));
        let change = error_norm(change, &self.tolerance);
        self.change += change;
        // About a length, steps err in its direction and may be longer; smooth motion changes the state by ε^(-4/5) tolerances and more.
        let little = CHATTER.max(self.tolerance.relative.powf(-0.5));
        match change < little {
            true => self.slow += 1,
            false => {
                self.slow = 0;
                self.crossed.fill(0);
            }
        }
        self.size = h.abs();
    }

    /// Whether the last steps may have been about the zero of a length, as far as the state tells.
    pub(crate) fn is_slow(&self) -> bool {
        self.slow >= FEW / 10 && self.switches.iter().any(|switch| switch.length)
    }

    /// Takes account of a step that goes from where the last one has got to across zeros of these switching functions.
    ///
    /// # Errors
    /// [`Error::Chattering`] where steps go to and fro across the zero of a length.
    pub(crate) fn across(&mut self, switches: &[usize]) -> Result<(), Error> {
        for k in switches {
            self.crossed[*k] += 1;
            let often = FEW.max(self.slow) <= 4 * self.crossed[*k];
            if self.switches[*k].length && often {
                return Err(chattering(self.size, [&self.switches[*k]].into_iter()));
            }
        }
        Ok(())
    }

    /// Why the run ends with `remaining` way to go: its steps are used up, or those of a window get on too slowly.
    pub(crate) fn verdict(&self, used_up: bool, remaining: f64) -> Option<Error> {
        let window = self.steps == WINDOW;
        let reach = |steps: usize| self.way * (steps as f64 / WINDOW as f64) / remaining.abs();
        let step = self.way / self.steps as f64;
        if used_up || window && self.chatters() && reach(self.left) < 1.0 {
            let steps = self.most;
            return Some(match self.chatters() {
                true => chattering(step, self.switches.iter()),
                false => Error::TooManySteps { steps },
            });
        }
        let stands = window && reach(self.most) < STANDSTILL;
        stands.then_some(Error::too_small(step))
    }

    fn chatters(&self) -> bool {
        self.steps >= FEW && self.change < CHATTER * self.steps as f64
    }

    /// The error of a motion that is driven onto the zeros of `switches` from both sides.
    pub(crate) fn stuck(&self, switches: &[usize]) -> Error {
        chattering(0.0, switches.iter().map(|k| &self.switches[*k]))
    }
}

/// [`Error::Chattering`] about `switches`, with each of their terms once.
fn chattering<'a>(step: f64, switches: impl Iterator<Item = &'a SwitchSpec>) -> Error {
    let terms = SwitchSpec::terms(switches);
    Error::Chattering { step, terms }
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

    fn at(t: f64, error: Error) -> Trouble {
        Trouble::new(Sample::of(t, &[t, 0.0]), error)
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
            conflict.note(Sample::of(t, &[t, 0.0]), &error);
        }
        conflict.pass(0.0, 1.0);
        let told = conflict.explain(at(1.0, one(1e-300)));
        assert_eq!(told, at(1.001, split(1e-3)));
    }

    #[test]
    fn what_was_passed_or_is_of_another_kind_is_not_told() {
        let mut conflict = Conflict::default();
        conflict.note(Sample::of(-1.5, &[0.0; 2]), &split(0.5));
        conflict.pass(-1.0, -2.0);
        let last = at(-2.0, one(1e-3));
        assert_eq!(conflict.explain(last.clone()), last);
        conflict.note(Sample::of(-2.5, &[0.0; 2]), &split(0.5));
        let other = at(-2.0, Error::too_small(1e-20));
        assert_eq!(conflict.explain(other.clone()), other);
    }
}
