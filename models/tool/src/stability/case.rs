//! A case: something swept over a range, and how far the results are off at each value.

use std::time::Instant;

use serde::Serialize;
use ukcore::{Error, Mechanism, Simulation, Trajectory};

use crate::interrupt::Interrupt;

/// What was computed for one value.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub(super) struct Effort {
    pub(super) steps: usize,
    pub(super) evaluations: usize,
    pub(super) fallbacks: usize,
}

impl Effort {
    /// Runs `simulation`; its work counts whether it succeeds or not.
    ///
    /// # Errors
    /// Those of [`Simulation::until`].
    pub(super) fn run<M: Mechanism>(
        &mut self,
        simulation: Simulation<M>,
        until: f64,
    ) -> Result<Trajectory<M>, Error> {
        let (trajectory, error) = match simulation.until(until) {
            Ok(trajectory) => (trajectory, None),
            Err(failure) => (*failure.trajectory, Some(failure.error)),
        };
        let work = trajectory.work();
        self.steps += work.steps + work.rejected;
        self.evaluations += work.evaluations;
        self.fallbacks += work.fallbacks;
        error.map_or(Ok(trajectory), Err)
    }
}

/// The error at one value of what is swept, as a part of the size of the result.
pub(super) type Measure = fn(f64, &mut Effort) -> Result<f64, Error>;

/// A case.
#[derive(Debug, Clone)]
pub(super) struct Case {
    /// Name on the command line.
    pub(super) id: &'static str,
    /// What is swept, in what mechanism.
    pub(super) swept: &'static str,
    /// What the results are compared with.
    pub(super) oracle: &'static str,
    /// Errors up to this are full accuracy.
    pub(super) accurate: f64,
    /// Errors up to this are degraded within bounds; beyond, only an error with a name will do.
    pub(super) bound: f64,
    /// The values, each with the text that stands for it if that is not the number.
    pub(super) sweep: Sweep,
    /// The error at a value.
    pub(super) measure: Measure,
    /// What was found before the program was improved for it, and by which change; empty if nothing was.
    pub(super) before: &'static str,
}

/// Values in order, and which of them is the ordinary one from which the others move away.
#[derive(Debug, Clone)]
pub(super) struct Sweep {
    pub(super) values: Vec<f64>,
    /// Text of each value; the number where there is none.
    pub(super) labels: &'static [&'static str],
    pub(super) ordinary: usize,
}

/// Powers of ten from `first` to `last` in steps of `step` decades; the ordinary one is 10^`ordinary`.
pub(super) fn decades(first: i32, last: i32, step: usize, ordinary: i32) -> Sweep {
    let exponents: Vec<i32> = if first <= last {
        (first..=last).step_by(step).collect()
    } else {
        (last..=first).rev().step_by(step).collect()
    };
    let nearest = |i: &usize| (exponents[*i] - ordinary).abs();
    Sweep {
        ordinary: (0..exponents.len()).min_by_key(nearest).unwrap_or(0),
        // Read as text, since powers by multiplication are rounded.
        values: exponents
            .iter()
            .map(|e| format!("1e{e}").parse().unwrap_or(0.0))
            .collect(),
        labels: &[],
    }
}

impl Sweep {
    /// The values given, the first one ordinary.
    pub(super) fn of(values: &[f64]) -> Self {
        Sweep {
            values: values.to_vec(),
            labels: &[],
            ordinary: 0,
        }
    }

    /// A sweep over things that are no numbers: their indices.
    pub(super) fn named(labels: &'static [&'static str]) -> Self {
        Sweep {
            values: (0..labels.len()).map(|i| i as f64).collect(),
            labels,
            ordinary: 0,
        }
    }

    /// The same and `value` at its end.
    pub(super) fn and(mut self, value: f64) -> Self {
        self.values.push(value);
        self
    }

    fn label(&self, index: usize) -> String {
        let number = || super::short(self.values[index]);
        self.labels
            .get(index)
            .map_or_else(number, |l| (*l).to_owned())
    }
}

/// How a value came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Class {
    /// As exact as at ordinary values.
    Accurate,
    /// Less exact, but within the bound of the case.
    Degraded,
    /// Refused with an error that has a name.
    Refused,
    /// A result whose error exceeds the bound, and nothing said so: what must not be.
    Wrong,
}

impl Class {
    pub(super) const ALL: [Class; 4] = [
        Class::Accurate,
        Class::Degraded,
        Class::Refused,
        Class::Wrong,
    ];

    pub(super) fn word(self) -> &'static str {
        match self {
            Class::Accurate => "accurate",
            Class::Degraded => "degraded",
            Class::Refused => "refused",
            Class::Wrong => "wrong",
        }
    }
}

/// One value of a case.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Point {
    pub(super) value: f64,
    pub(super) label: String,
    pub(super) class: Class,
    /// The error; none where it was refused.
    pub(super) error: Option<f64>,
    /// Name and message of the refusal.
    pub(super) refusal: Option<(&'static str, String)>,
    #[serde(flatten)]
    pub(super) effort: Effort,
    /// Wall time, s.
    pub(super) seconds: f64,
}

/// A case with all its values.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    pub(super) id: &'static str,
    pub(super) swept: &'static str,
    pub(super) oracle: &'static str,
    pub(super) accurate_to: f64,
    pub(super) bound: f64,
    pub(super) before: &'static str,
    pub(super) ordinary: usize,
    pub(super) points: Vec<Point>,
}

impl Case {
    /// All values; `None` if interrupted before the last. `done` hears of each value.
    pub(super) fn row(&self, interrupt: &Interrupt, done: impl Fn()) -> Option<Row> {
        let mut points = Vec::with_capacity(self.sweep.values.len());
        for (index, &value) in self.sweep.values.iter().enumerate() {
            if interrupt.is_set() {
                return None;
            }
            points.push(self.point(index, value));
            done();
        }
        Some(Row {
            id: self.id,
            swept: self.swept,
            oracle: self.oracle,
            accurate_to: self.accurate,
            bound: self.bound,
            before: self.before,
            ordinary: self.sweep.ordinary,
            points,
        })
    }

    fn point(&self, index: usize, value: f64) -> Point {
        let mut effort = Effort::default();
        let started = Instant::now();
        let result = (self.measure)(value, &mut effort);
        let class = match &result {
            Err(_) => Class::Refused,
            Ok(error) if *error <= self.accurate => Class::Accurate,
            Ok(error) if *error <= self.bound => Class::Degraded,
            Ok(_) => Class::Wrong,
        };
        Point {
            value,
            label: self.sweep.label(index),
            class,
            error: result.as_ref().ok().copied(),
            refusal: result.err().map(|e| (kind(&e), e.to_string())),
            effort,
            seconds: started.elapsed().as_secs_f64(),
        }
    }
}

impl Row {
    /// The values around the ordinary one, without a gap, that `good` admits; as indices, the last one included.
    pub(super) fn range(&self, good: impl Fn(Class) -> bool) -> Option<(usize, usize)> {
        let ok = |i: usize| good(self.points[i].class);
        if !ok(self.ordinary) {
            return None;
        }
        let first = (0..=self.ordinary).rev().take_while(|i| ok(*i)).last();
        let last = (self.ordinary..self.points.len())
            .take_while(|i| ok(*i))
            .last();
        first.zip(last)
    }

    /// That range in words: "1e-12 … 1e8", or "to 1e8" where the sweep begins at its ordinary value.
    pub(super) fn range_text(&self, good: impl Fn(Class) -> bool) -> String {
        let Some((first, last)) = self.range(good) else {
            return "–".to_owned();
        };
        let label = |i: usize| self.points[i].label.as_str();
        if self.ordinary == 0 {
            return format!("to {}", label(last));
        }
        format!("{} … {}", label(first), label(last))
    }

    /// The names of the refusals, each once.
    pub(super) fn refusals(&self) -> Vec<&'static str> {
        let mut names: Vec<&'static str> = Vec::new();
        for (name, _) in self.points.iter().filter_map(|p| p.refusal.as_ref()) {
            if !names.contains(name) {
                names.push(name);
            }
        }
        names
    }

    /// Values of a class.
    pub(super) fn count(&self, class: Class) -> usize {
        self.points.iter().filter(|p| p.class == class).count()
    }

    /// Work and time of all values.
    pub(super) fn total(&self) -> (Effort, f64) {
        let mut sum = Effort::default();
        for p in &self.points {
            sum.steps += p.effort.steps;
            sum.evaluations += p.effort.evaluations;
            sum.fallbacks += p.effort.fallbacks;
        }
        (sum, self.points.iter().map(|p| p.seconds).sum())
    }
}

/// The name of an error, whatever place it carries.
fn kind(error: &Error) -> &'static str {
    match error {
        Error::At { source, .. } => kind(source),
        Error::Underdetermined { .. } => "Underdetermined",
        Error::Inconsistent { .. } => "Inconsistent",
        Error::OffConstraint { .. } => "OffConstraint",
        Error::NotAssembled { .. } => "NotAssembled",
        Error::NonFinite { .. } => "NonFinite",
        Error::IndefiniteMass { .. } => "IndefiniteMass",
        Error::InvalidSetting { .. } => "InvalidSetting",
        Error::StepTooSmall { .. } => "StepTooSmall",
        Error::TooManySteps { .. } => "TooManySteps",
        Error::Chattering { .. } => "Chattering",
        Error::Jump { .. } => "Jump",
        Error::Singular { .. } => "Singular",
        _ => "Error",
    }
}
