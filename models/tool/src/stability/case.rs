//! A case: something swept over a range, and how far the results are off at each value.

use std::borrow::Cow;
use std::time::Instant;

use serde::Serialize;
use ukcore::{Error, Simulation, Trajectory};

use crate::interrupt::Interrupt;
use crate::numbers;

/// The work of all runs that were made for one value of a sweep.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct Effort {
    /// Steps, accepted or not.
    pub steps: usize,
    /// Evaluations of the accelerations.
    pub evaluations: usize,
    /// Evaluations that left the formula first tried.
    pub fallbacks: usize,
}

impl Effort {
    /// Runs `simulation`; its work counts whether it succeeds or not.
    ///
    /// # Errors
    /// What [`Simulation::until`] reports.
    pub fn run(&mut self, simulation: Simulation, until: f64) -> Result<Trajectory, Error> {
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

/// The error at one value of what is swept, as a part of the size of the result; the work done for it is added to the effort.
pub type Measure<'a> = Box<dyn Fn(f64, &mut Effort) -> Result<f64, Error> + Sync + 'a>;

/// A case: one thing that is swept, what results are compared with, and what counts as right.
#[derive(Serialize)]
pub struct Case<'a> {
    /// Name on the command line.
    pub id: &'a str,
    /// What is swept, in what mechanism.
    pub swept: Cow<'a, str>,
    /// What the results are compared with.
    pub oracle: &'a str,
    /// Errors up to this are full accuracy.
    #[serde(rename = "accurate_to")]
    pub accurate: f64,
    /// Errors up to this are degraded within bounds; beyond, only an error with a name will do.
    pub bound: f64,
    /// The values, each with the text that stands for it if that is not the number.
    #[serde(flatten)]
    pub sweep: Sweep,
    /// Measures the error at a value.
    #[serde(skip)]
    pub measure: Measure<'a>,
}

impl<'a> Case<'a> {
    /// A case called `id`, with the error at a value. What it sweeps, and what counts as right, the methods below say.
    pub fn new(
        id: &'a str,
        measure: impl Fn(f64, &mut Effort) -> Result<f64, Error> + Sync + 'a,
    ) -> Self {
        Case {
            id,
            swept: Cow::default(),
            oracle: "",
            accurate: 0.0,
            bound: 0.0,
            sweep: Sweep::of(&[]),
            measure: Box::new(measure),
        }
    }

    /// Says what is swept, in what mechanism.
    pub fn swept(mut self, swept: impl Into<Cow<'a, str>>) -> Self {
        self.swept = swept.into();
        self
    }

    /// Gives the values that are swept.
    pub fn over(mut self, sweep: Sweep) -> Self {
        self.sweep = sweep;
        self
    }

    /// Says what the results are compared with.
    pub fn against(mut self, oracle: &'a str) -> Self {
        self.oracle = oracle;
        self
    }

    /// Sets the bounds of the errors up to which results are accurate, and degraded.
    pub fn within(mut self, accurate: f64, bound: f64) -> Self {
        (self.accurate, self.bound) = (accurate, bound);
        self
    }
}

/// Values in order, and which of them is the ordinary one from which the others move away.
#[derive(Debug, Clone, Serialize)]
pub struct Sweep {
    /// The values.
    #[serde(skip)]
    pub values: Vec<f64>,
    /// Text of each value; the number where there is none.
    #[serde(skip)]
    pub labels: &'static [&'static str],
    /// The index of the ordinary value.
    pub ordinary: usize,
}

/// Powers of ten from `first` to `last` in steps of `step` decades; the ordinary one is 10^`ordinary`.
#[must_use]
pub fn decades(first: i32, last: i32, step: usize, ordinary: i32) -> Sweep {
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
    /// A sweep over the values given, of which the first is the ordinary one.
    #[must_use]
    pub fn of(values: &[f64]) -> Self {
        Sweep {
            values: values.to_vec(),
            labels: &[],
            ordinary: 0,
        }
    }

    /// A sweep over things that are no numbers: their indices.
    #[must_use]
    pub fn named(labels: &'static [&'static str]) -> Self {
        Sweep {
            values: (0..labels.len()).map(|i| i as f64).collect(),
            labels,
            ordinary: 0,
        }
    }

    /// Adds `value` at the end of the sweep.
    #[must_use]
    pub fn and(mut self, value: f64) -> Self {
        self.values.push(value);
        self
    }

    fn label(&self, index: usize) -> String {
        let number = || short(self.values[index]);
        self.labels
            .get(index)
            .map_or_else(number, |l| (*l).to_owned())
    }
}

/// A number in the sweeps: a power of ten as such.
fn short(value: f64) -> String {
    if (0.01..1000.0).contains(&value.abs()) || value == 0.0 {
        return numbers::short(value, 6);
    }
    format!("{value:e}")
}

/// How the result at a value of a sweep compares with its oracle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Class {
    /// The result is as exact as at ordinary values.
    Accurate,
    /// Less exact, but within the bound of the case.
    Degraded,
    /// Refused with an error that has a name.
    Refused,
    /// A result whose error exceeds the bound, and nothing said so: what must not be.
    Wrong,
}

impl Class {
    /// All classes, from good to bad.
    pub(super) const ALL: [Class; 4] = [
        Class::Accurate,
        Class::Degraded,
        Class::Refused,
        Class::Wrong,
    ];

    /// The word for the class in tables and on pages.
    pub(super) fn word(self) -> &'static str {
        match self {
            Class::Accurate => "accurate",
            Class::Degraded => "degraded",
            Class::Refused => "refused",
            Class::Wrong => "wrong",
        }
    }
}

/// What came out at one value of a case.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Point {
    pub(super) value: f64,
    /// The text that stands for it.
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

/// What came out of a case, at all its values.
#[derive(Clone, Serialize)]
pub(super) struct Row<'a> {
    #[serde(flatten)]
    pub(super) case: &'a Case<'a>,
    pub(super) points: Vec<Point>,
}

impl Case<'_> {
    /// All values; `None` if interrupted before the last. `done` hears of each value.
    pub(super) fn row(&self, interrupt: Interrupt, done: impl Fn()) -> Option<Row<'_>> {
        let mut points = Vec::with_capacity(self.sweep.values.len());
        for (index, &value) in self.sweep.values.iter().enumerate() {
            if interrupt.is_set() {
                return None;
            }
            points.push(self.point(index, value));
            done();
        }
        Some(Row { case: self, points })
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

impl Row<'_> {
    /// The values around the ordinary one, without a gap, that `good` admits; as indices, the last one included.
    fn range(&self, good: impl Fn(Class) -> bool) -> Option<(usize, usize)> {
        let ok = |i: usize| good(self.points[i].class);
        let ordinary = self.case.sweep.ordinary;
        let first = (0..=ordinary).rev().take_while(|i| ok(*i)).last();
        let last = (ordinary..self.points.len()).take_while(|i| ok(*i)).last();
        first.zip(last)
    }

    /// The range in words: "1e-12 … 1e8", or "to 1e8" where the sweep begins at its ordinary value.
    pub(super) fn range_text(&self, good: impl Fn(Class) -> bool) -> String {
        let Some((first, last)) = self.range(good) else {
            return "–".to_owned();
        };
        let label = |i: usize| self.points[i].label.as_str();
        if self.case.sweep.ordinary == 0 {
            return format!("to {}", label(last));
        }
        format!("{} … {}", label(first), label(last))
    }

    /// The names of the errors with which values were refused, each once.
    pub(super) fn refusals(&self) -> Vec<&'static str> {
        let mut names: Vec<&'static str> = Vec::new();
        for (name, _) in self.points.iter().filter_map(|p| p.refusal.as_ref()) {
            if !names.contains(name) {
                names.push(name);
            }
        }
        names
    }

    /// The number of values that came out as `class`.
    pub(super) fn count(&self, class: Class) -> usize {
        self.points.iter().filter(|p| p.class == class).count()
    }

    /// The work of all values together, and their time in seconds.
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
        Error::UnknownName { .. } => "UnknownName",
        Error::WrongLength { .. } => "WrongLength",
        Error::StepTooSmall { .. } => "StepTooSmall",
        Error::Rounding { .. } => "Rounding",
        Error::TooLate { .. } => "TooLate",
        Error::TooManySteps { .. } => "TooManySteps",
        Error::Chattering { .. } => "Chattering",
        Error::NoDirection { .. } => "NoDirection",
        Error::Kink { .. } => "Kink",
        Error::Jump { .. } => "Jump",
        Error::Singular { .. } => "Singular",
        Error::DeadCentre { .. } => "DeadCentre",
        _ => "Error",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// A root by Newton's method from 1, which has no time to converge where the number is large.
    fn newton(square: f64, effort: &mut Effort) -> Result<f64, Error> {
        if square > 1e9 {
            let reason = format!("is {square:e}");
            return Err(Error::InvalidSetting {
                what: "square",
                reason,
            });
        }
        let root = (0..8).fold(1.0, |x: f64, _| 0.5 * (x + square / x));
        effort.evaluations += 8;
        Ok((root / square.sqrt() - 1.0).abs())
    }

    #[test]
    fn values_are_accurate_degraded_wrong_or_refused() {
        let case = Case::new("newton", newton)
            .swept("a number whose root is sought")
            .over(decades(0, 12, 1, 0))
            .against("the root")
            .within(1e-12, 1e-3);
        let row = case
            .row(Interrupt::catch().expect("a handler"), || ())
            .expect("not interrupted");
        let classes: Vec<Class> = row.points.iter().map(|p| p.class).collect();
        assert_eq!((classes[0], classes[3]), (Class::Accurate, Class::Degraded));
        assert_eq!((classes[6], classes[12]), (Class::Wrong, Class::Refused));
        assert_eq!(row.range_text(|c| c == Class::Accurate), "to 100");
        assert_eq!(row.refusals(), ["InvalidSetting"]);
    }
}
