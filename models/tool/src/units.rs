//! Values as written on the command line: a number with a unit, such as `15deg`, `12mm`, `9.81 m/s^2`, `2.5*PI`.
//!
//! ```text
//! value  = [ "+" | "-" ] number { [ "*" | "/" ] number } [ [ "*" | "/" ] unit ] ;    (from left to right; units as in declarations)
//! number = digits | "PI" ;                                         (without a sign between numbers the second is PI)
//! ```

use std::f64::consts::{PI, TAU};

use ukcore::Error;
use ukunits::{Dimension, Refusal, Unit};

/// A value as it is written on the command line: a number, and its unit if one is named.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    value: f64,
    unit: Option<Unit>,
}

impl Quantity {
    /// Reads a value: a number, or a product, with a unit behind or without.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let body = text.trim();
        let unsigned = body.strip_prefix(['+', '-', '−']).unwrap_or(body);
        let word = unsigned.to_lowercase();
        if ["nan", "inf", "infinity"].contains(&word.as_str()) {
            return Err(format!("`{text}` is not a finite number"));
        }
        let mut quantity = product(unsigned.trim_start()).map_err(|e| format!("`{text}`: {e}"))?;
        if body.starts_with(['-', '−']) {
            quantity.value = -quantity.value;
        }
        if quantity.in_si().is_finite() {
            Ok(quantity)
        } else {
            Err(format!("`{text}` is not a finite number"))
        }
    }

    /// The quantity, a bare number, in the unit of `others` if they have one and the same; 0 has any.
    pub(crate) fn in_unit_of(self, others: &[Quantity]) -> Self {
        let mut units = others.iter().filter(|q| !q.is_zero()).map(|q| &q.unit);
        let unit = units.next().filter(|unit| units.all(|u| u == *unit));
        match (&self.unit, unit) {
            (None, Some(unit)) => Quantity {
                unit: unit.clone(),
                ..self
            },
            _ => self,
        }
    }

    /// Refuses numbers of which some have a unit and some have none: those would be in SI, which nobody means. 0 is 0 in any unit.
    pub(crate) fn alike(values: &[Quantity], text: &str) -> Result<(), String> {
        let told: Vec<_> = values.iter().filter(|q| !q.is_zero()).collect();
        let bare = told.iter().filter(|q| q.unit.is_none()).count();
        if bare == 0 || bare == told.len() {
            return Ok(());
        }
        Err(format!(
            "in `{text}` some numbers have a unit and some have none; write it behind each"
        ))
    }

    fn is_zero(&self) -> bool {
        self.value == 0.0 && self.unit.is_none()
    }

    /// The number, where it has no unit and needs one.
    pub(crate) fn bare(&self) -> Option<f64> {
        (self.unit.is_none() && !self.is_zero()).then_some(self.value)
    }

    /// The number in kg, m, s and rad, in which a bare number is already.
    fn in_si(&self) -> f64 {
        let unit = self.unit.as_ref();
        unit.map_or(self.value, |unit| unit.to_si(self.value))
    }

    /// The number in the SI unit `declared`; where that is empty, in whatever SI unit it has. It is refused if it is of another dimension.
    pub(crate) fn si(&self, declared: &str) -> Result<f64, String> {
        self.of(declared, Dimension::NUMBER)
    }

    /// The number in the SI unit of a velocity: `declared` per second.
    pub(crate) fn si_rate(&self, declared: &str) -> Result<f64, String> {
        self.of(declared, Dimension::TIME)
    }

    fn of(&self, declared: &str, per: Dimension) -> Result<f64, String> {
        if let (Some(own), Ok(unit)) = (&self.unit, Unit::parse(declared)) {
            let (own, needed) = (own.dimension(), unit.dimension().per(per));
            // The radian counts, so that an angle is not taken for a number, but not in moments and stiffnesses: N m are N m/rad.
            let fits =
                own.without_angle() == needed.without_angle() && (own.has_mass() || own == needed);
            if !fits {
                return Err(format!("a value in {needed} is needed, not one in {own}"));
            }
        }
        Ok(self.in_si())
    }
}

/// The unit of a force or torque on a coordinate that is measured in `unit`; none where that is not known.
pub(crate) fn effort(unit: &str) -> Option<String> {
    Unit::parse(unit).ok().map(|unit| unit.dimension().effort())
}

/// Whether `unit` is one of length.
pub(crate) fn is_length(unit: &str) -> bool {
    Unit::parse(unit).is_ok_and(|unit| unit.dimension() == Dimension::LENGTH)
}

/// What a turn is in `unit`; none where that is no unit of an angle.
pub(crate) fn turn(unit: &str) -> Option<f64> {
    let unit = Unit::parse(unit).ok()?;
    let angle = unit.dimension() != Dimension::NUMBER
        && unit.dimension().without_angle() == Dimension::NUMBER;
    angle.then(|| unit.from_si(TAU))
}

/// A bare number.
impl From<f64> for Quantity {
    fn from(value: f64) -> Self {
        Quantity { value, unit: None }
    }
}

/// Reads `NAME=VALUE` as a name and a quantity.
pub(crate) fn assignment(text: &str) -> Result<(String, Quantity), String> {
    let (name, value) = split(text, "VALUE")?;
    Ok((name.to_owned(), Quantity::parse(value)?))
}

/// How many steps of `step` lead from `from` to `to`.
///
/// # Errors
/// If they lead the other way.
pub(crate) fn steps(from: f64, to: f64, step: f64) -> Result<f64, String> {
    let steps = (to - from) / step;
    if steps.is_finite() && steps < 0.0 {
        return Err(format!(
            "steps of {step} lead from {from} away from {to}; give the step the other sign, or swap the ends"
        ));
    }
    Ok(steps)
}

/// Splits `NAME=…`; what is behind is called `values` where it is missing.
pub(crate) fn split<'a>(text: &'a str, values: &str) -> Result<(&'a str, &'a str), String> {
    let Some((name, value)) = text.split_once('=') else {
        return Err(format!("`{text}` is not of the form NAME={values}"));
    };
    match (name.trim(), value.trim()) {
        ("", _) => Err(format!("`{text}` has no name before `=`")),
        (_, "") => Err(format!("`{text}` has no value after `=`")),
        both => Ok(both),
    }
}

/// Ends of a range of values, and its step.
type Range = ([Quantity; 2], Option<Quantity>);

/// Reads the range `FROM..TO` or `FROM..TO:STEP` of values of `name`; a step without a unit is in that of the ends.
///
/// # Errors
/// If it is no range, a value is not understood, or some have a unit and some have none.
pub(crate) fn range(name: &str, values: &str) -> Result<Range, String> {
    let (ends, step) = match values.split_once(':') {
        Some((ends, step)) => (ends, Some(Quantity::parse(step)?)),
        None => (values, None),
    };
    let (from, to) = ends
        .split_once("..")
        .ok_or_else(|| format!("a range is needed: `{name}=FROM..TO`"))?;
    let ends = [Quantity::parse(from)?, Quantity::parse(to)?];
    let step = step.map(|step| step.in_unit_of(&ends));
    let all: Vec<Quantity> = ends.iter().chain(&step).cloned().collect();
    Quantity::alike(&all, &format!("{name}={values}"))?;
    Ok((ends, step))
}

/// Reads a time, such as `1.5`, `20ms` or `2min`, as seconds.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    Quantity::parse(text)?.si("s")
}

/// Numbers, then a unit.
fn product(text: &str) -> Result<Quantity, String> {
    let (mut value, mut rest) = number(text)?;
    loop {
        rest = rest.trim_start();
        let (divides, next) = match rest.chars().next() {
            None => return Ok(Quantity::from(value)),
            Some(sign @ ('*' | '·' | '/')) => (sign == '/', rest[sign.len_utf8()..].trim_start()),
            Some(c) if is_letter(c) => (false, rest),
            Some(c) if c.is_ascii_digit() || c == '.' => {
                return Err(format!("`*`, `/` or `^` is missing before `{rest}`"));
            }
            Some(',') => {
                let reason = "is not understood; here stands one value, `sweep` takes several";
                return Err(format!("`{rest}` {reason}"));
            }
            Some(_) => return Err(format!("`{rest}` is not understood")),
        };
        if next.starts_with(is_letter) && pi(next).is_none() {
            let text = match divides {
                true => format!("1/{next}"),
                false => next.to_owned(),
            };
            let unit = Some(unit(&text)?);
            return Ok(Quantity { value, unit });
        }
        let (factor, after) = number(next)?;
        value = if divides {
            value / factor
        } else {
            value * factor
        };
        rest = after;
    }
}

fn unit(text: &str) -> Result<Unit, String> {
    Unit::parse(text).map_err(|refusal| match refusal {
        Refusal::Unknown(name) => {
            Error::unknown_name("unit", &name, &mut ukunits::names()).to_string()
        }
        other => other.to_string(),
    })
}

/// What follows π, if `text` begins with it.
fn pi(text: &str) -> Option<&str> {
    let mut names = ["PI", "pi", "π"].into_iter();
    let rest = names.find_map(|name| text.strip_prefix(name))?;
    (!rest.starts_with(is_letter)).then_some(rest)
}

/// The number that `text` begins with, and what follows it.
fn number(text: &str) -> Result<(f64, &str), String> {
    if let Some(rest) = pi(text) {
        return Ok((PI, rest));
    }
    match text.chars().next() {
        Some(c) if c.is_ascii_digit() || c == '.' => {
            let (number, rest) = text.split_at(number_length(text));
            let value: Result<f64, _> = number.parse();
            let value = value.map_err(|_| match number.contains("..") {
                true => format!(
                    "`{number}` is a range, which `sweep` takes; here one number is expected"
                ),
                false => format!("`{number}` is not a number"),
            })?;
            Ok((value, rest))
        }
        Some(c) => Err(format!("a value is expected at `{c}`")),
        None => Err("a value is missing".to_owned()),
    }
}

fn is_letter(c: char) -> bool {
    c.is_alphabetic() || c == '_' || c == '°'
}

/// All digits and points, so that `1.5.2` is one wrong number; an `e` is an exponent only if digits follow: `2e3`, but not `2 e`.
fn number_length(text: &str) -> usize {
    let digits = |from: usize, point| {
        let end = text[from..].find(|c: char| !(c.is_ascii_digit() || point && c == '.'));
        end.map_or(text.len(), |n| from + n)
    };
    let end = digits(0, true);
    if text[end..].starts_with(['e', 'E']) {
        let start = end + 1 + usize::from(text[end + 1..].starts_with(['+', '-']));
        let stop = digits(start, false);
        if stop > start {
            return stop;
        }
    }
    end
}

#[cfg(test)]
#[path = "units_tests.rs"]
mod tests;
