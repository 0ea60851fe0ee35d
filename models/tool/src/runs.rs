//! Several runs at once: lists of values, each combination of which is a run.

use clap::Args;
use ukcore::manifold::Stabilisation;
use ukcore::model::Entry;
use ukcore::{Error, Method};

use crate::failure::Failure;
use crate::motion::{self, Motion, Steps};
use crate::numbers::{full, rounded};
use crate::scene::{Place, Start};
use crate::units::{self, Quantity};

/// The command-line arguments for several runs of one model: one for each combination of the values listed.
#[derive(Debug, Clone, Args)]
pub struct Runs {
    /// Set a parameter or an option of the start, to each of several values: `k=1,2,5`, `x0=12..16:0.5`, `angle=10deg..80deg:10deg`; may be
    /// repeated
    #[arg(long = "set", value_name = "NAME=VALUES", value_parser = assignment)]
    pub settings: Vec<(String, Values)>,
    /// Where they begin
    #[command(flatten)]
    pub place: Place,
    /// Time to stop at, before 0 to run backward; that of the start if absent
    #[arg(long, value_name = "TIME", value_parser = units::seconds, allow_hyphen_values = true)]
    pub until: Option<f64>,
    /// Relative and absolute tolerance of the integration, or several: `1e-4,1e-10`
    #[arg(long, value_name = "TOLS", default_value = "1e-10", value_parser = list(motion::tolerance), allow_hyphen_values = true)]
    pub tol: List<f64>,
    /// Integration method, or several, as for `run`: `dop853`, `dopri5`, `radau5`, `rattle=STEP`
    #[arg(long, value_name = "METHODS", default_value = "dop853", value_parser = list(motion::method))]
    pub method: List<Method>,
    /// How they step
    #[command(flatten)]
    pub steps: Steps,
    /// How the constraints are kept from drifting, or several ways: `projection,none`
    #[arg(long, visible_alias = "stabilize", value_name = "WAYS", default_value = "projection", value_parser = ways)]
    pub stabilise: List<Stabilisation>,
}

/// One of the runs that [`Runs`] asks for.
pub(crate) struct Variant {
    pub(crate) start: Start,
    pub(crate) motion: Motion,
    /// What distinguishes it from the others: names and values.
    pub(crate) differs: Vec<(String, String)>,
}

impl Runs {
    /// Lists the runs of `entry`, with the values of the last list next to each other.
    ///
    /// # Errors
    /// [`Failure::Usage`] for unknown names, values in the wrong unit, and more runs than `most`.
    pub(crate) fn each(&self, entry: &Entry, most: usize) -> Result<Vec<Variant>, Failure> {
        let plain = Start {
            place: self.place.clone(),
            ..Start::default()
        };
        let mut axes = Vec::new();
        for (k, (name, values)) in self.settings.iter().enumerate() {
            if self.settings[..k].iter().any(|(other, _)| other == name) {
                let message =
                    format!("`{name}` is set twice; list its values once: `--set {name}=1,2`");
                return Err(Failure::Usage(message));
            }
            let values = values.si(plain.unit(entry, name)?);
            let values = values.map_err(Failure::value(name))?;
            axes.push((name, values));
        }
        let lengths = axes.iter().map(|(_, values)| values.len());
        let others = [
            self.tol.0.len(),
            self.method.0.len(),
            self.stabilise.0.len(),
        ];
        let lengths: Vec<usize> = lengths.chain(others).filter(|n| *n > 1).collect();
        let mut factors = lengths.iter();
        let count = factors.try_fold(1_usize, |all, n| all.checked_mul(*n));
        let count = count.filter(|count| *count <= most).ok_or_else(|| {
            let each: Vec<String> = lengths.iter().map(ToString::to_string).collect();
            let product = each.join(" × ");
            Failure::Usage(format!(
                "{product} runs are asked for; at most {most} are made"
            ))
        })?;
        Ok((0..count)
            .map(|index| self.chosen(&plain, &axes, index))
            .collect())
    }

    /// What to say of a number that may be meant in the unit of the declaration.
    pub(crate) fn bare(&self, entry: &Entry) -> Vec<String> {
        let start = Start {
            place: self.place.clone(),
            ..Start::default()
        };
        let given = self.settings.iter().flat_map(|(name, values)| {
            let values = match values {
                Values::List(values) => &values[..],
                Values::Range(range) => &range[..2],
            };
            values.iter().map(move |value| (name, value))
        });
        let notes = given.filter_map(|(name, value)| start.bare(entry, name, value));
        notes.take(1).collect()
    }

    fn chosen(&self, plain: &Start, axes: &[(&String, Vec<f64>)], index: usize) -> Variant {
        let (mut start, mut differs, mut rest) = (plain.clone(), Vec::new(), index);
        let mut pick = |count: usize| {
            let place = rest % count;
            rest /= count;
            place
        };
        let way = self.stabilise.0[pick(self.stabilise.0.len())];
        let method = self.method.0[pick(self.method.0.len())];
        let tol = self.tol.0[pick(self.tol.0.len())];
        for (name, values) in axes.iter().rev() {
            let value = values[pick(values.len())];
            start.settings.insert(0, ((*name).clone(), value.into()));
            if values.len() > 1 {
                differs.insert(0, ((*name).clone(), full(value)));
            }
        }
        let mut told = |several: bool, name: &str, text: String| {
            differs.extend(several.then(|| (name.to_owned(), text)));
        };
        told(self.tol.0.len() > 1, "tolerance", format!("{tol:e}"));
        told(self.method.0.len() > 1, "method", method.to_string());
        told(self.stabilise.0.len() > 1, "stabilisation", way.to_string());
        let motion = Motion {
            until: self.until,
            tol,
            method,
            steps: self.steps.clone(),
            stabilise: way,
        };
        Variant {
            start,
            motion,
            differs,
        }
    }
}

/// Values as they are written: `1,2,5`, or from the first to the last in steps.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// The values listed.
    List(Vec<Quantity>),
    /// The values from the first to the last in steps, as `first..last:step`.
    Range([Quantity; 3]),
}

/// A range has at most so many values.
const MOST: f64 = 1e7;

impl Values {
    /// The numbers in the SI unit `declared`.
    fn si(&self, declared: &str) -> Result<Vec<f64>, String> {
        let [first, last, step] = match self {
            Values::List(values) => return values.iter().map(|v| v.si(declared)).collect(),
            Values::Range(range) => range,
        };
        let [first, last, step] = [first.si(declared)?, last.si(declared)?, step.si(declared)?];
        let steps = units::steps(first, last, step)?;
        if !(0.0..MOST).contains(&steps) {
            return Err(format!(
                "steps of {step} do not lead from {first} to {last} in fewer than {MOST:.0e}"
            ));
        }
        // A last value that rounding puts beyond the end is meant.
        let count = (steps + 1e-9 * steps.max(1.0)).floor() as usize;
        Ok((0..=count)
            .map(|k| rounded(first + k as f64 * step))
            .collect())
    }
}

/// Reads `NAME=VALUES`.
fn assignment(text: &str) -> Result<(String, Values), String> {
    let (name, values) = units::split(text, "VALUES")?;
    if !values.contains("..") {
        let list: Result<Vec<_>, _> = values.split(',').map(Quantity::parse).collect();
        let list = list?;
        Quantity::alike(&list, text)?;
        return Ok((name.to_owned(), Values::List(list)));
    }
    let (ends, step) = units::range(name, values)?;
    let step = step.ok_or_else(|| format!("a range needs its step: `{text}:STEP`"))?;
    let [first, last] = ends;
    let range = [first, last, step];
    Ok((name.to_owned(), Values::Range(range)))
}

/// Values that are written with commas between them.
#[derive(Debug, Clone, PartialEq)]
pub struct List<T>(pub Vec<T>);

/// Reads values with commas between them, each as `one` does.
fn list<T>(one: fn(&str) -> Result<T, String>) -> impl Fn(&str) -> Result<List<T>, String> + Clone {
    move |text| text.split(',').map(one).collect::<Result<_, _>>().map(List)
}

fn ways(text: &str) -> Result<List<Stabilisation>, String> {
    let mut parts: Vec<String> = Vec::new();
    for part in text.split(',') {
        let first = part.trim_start().chars().next();
        let number = first.is_some_and(|c| c.is_ascii_digit() || c == '.');
        match parts.last_mut() {
            // The second rate of `baumgarte=20,20`.
            Some(before) if number => *before += &format!(",{part}"),
            _ => parts.push(part.to_owned()),
        }
    }
    let way = |part: String| part.trim().parse().map_err(|e: Error| e.to_string());
    let values: Result<_, _> = parts.into_iter().map(way).collect();
    values.map(List)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn numbers(text: &str, unit: &str) -> Vec<f64> {
        let (_, values) = assignment(text).expect("values");
        values.si(unit).expect("numbers")
    }

    #[test]
    fn values_are_listed_or_in_steps() {
        assert_eq!(numbers("k=1,2,5", "N/m"), [1.0, 2.0, 5.0]);
        assert_eq!(
            numbers("x0=12..14:0.5", "m"),
            [12.0, 12.5, 13.0, 13.5, 14.0]
        );
        assert_eq!(numbers("x=0.1..0.3:0.1", "m"), [0.1, 0.2, 0.3]);
        assert_eq!(numbers("x=10mm..30mm:1cm", "m"), [0.01, 0.02, 0.03]);
        assert_eq!(numbers("x=3..1:-1", "m"), [3.0, 2.0, 1.0]);
        // A step without a unit is in that of the ends.
        assert_eq!(numbers("x=10mm..30mm:10", "m"), [0.01, 0.02, 0.03]);
        assert_eq!(numbers("x=0..30mm:10", "m"), [0.0, 0.01, 0.02, 0.03]);
        assert_eq!(numbers("x=0,30mm", "m"), [0.0, 0.03]);
        assert_eq!(numbers("x=1..2:5", "m"), [1.0]);
        for (text, unit) in [("x=1..2:0", "m"), ("x=2..1:1", "m"), ("x=0..1:1e-9", "m")] {
            let (_, values) = assignment(text).expect("values");
            assert!(values.si(unit).is_err(), "{text}");
        }
        let (_, values) = assignment("w=3..1:0.5").expect("values");
        let told = values.si("1/s").expect_err("steps the other way");
        let remedy = "give the step the other sign, or swap the ends";
        assert_eq!(
            told,
            format!("steps of 0.5 lead from 3 away from 1; {remedy}")
        );
        assert_eq!(numbers("w=3..1:-0.5", "1/s"), [3.0, 2.5, 2.0, 1.5, 1.0]);
        assert_eq!(numbers("w=1..3:0.5", "1/s"), [1.0, 1.5, 2.0, 2.5, 3.0]);
        for text in ["x", "=1", "x=", "x=1..2", "x=1,,2", "x=1..2:m3"] {
            assert!(assignment(text).is_err(), "{text}");
        }
        // Some would be in SI, and nobody means that.
        for text in ["x=10..30mm:10", "x=10mm..3cm:10", "x=1..2:1mm", "x=1,2mm"] {
            let told = assignment(text).expect_err(text);
            assert!(told.contains("write it behind each"), "{told}");
        }
    }

    #[test]
    fn ways_with_rates_are_one() {
        let List(ways) = ways("none,baumgarte=5,6,projection").expect("ways");
        let written: Vec<String> = ways.iter().map(Stabilisation::to_string).collect();
        assert_eq!(written, ["none", "baumgarte=5,6", "projection"]);
    }
}
