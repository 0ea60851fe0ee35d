//! Values as written on the command line: a number times units, such as `15deg`, `12mm`, `9.81 m/s^2`, `2.5*PI`.
//!
//! ```text
//! value  = [ "+" | "-" ] factor { [ "*" | "/" ] factor } ;      (from left to right; without a sign between them the second is a name)
//! factor = number | "PI" | unit [ "^" [ "-" ] digits | "²" | "³" ] ;
//! ```

use std::f64::consts::PI;

use ukcore::Error;
use ukcore::model::StartOption;

/// Exponents of kilogram, metre, second and radian. The radian counts, so that an angle is not taken for a number.
type Dimension = [i32; 4];

/// Name, value in kg, m, s and rad, dimension, and whether a prefix may stand before it. A hertz is a turn a second: what is declared
/// in mechanics are angular frequencies.
const UNITS: &[(&str, f64, Dimension, bool)] = &[
    ("g", 1e-3, [1, 0, 0, 0], true),
    ("m", 1.0, [0, 1, 0, 0], true),
    ("s", 1.0, [0, 0, 1, 0], true),
    ("min", 60.0, [0, 0, 1, 0], false),
    ("h", 3600.0, [0, 0, 1, 0], false),
    ("rad", 1.0, [0, 0, 0, 1], true),
    ("deg", PI / 180.0, [0, 0, 0, 1], false),
    ("°", PI / 180.0, [0, 0, 0, 1], false),
    ("turn", 2.0 * PI, [0, 0, 0, 1], false),
    ("Hz", 2.0 * PI, [0, 0, -1, 1], true),
    ("rpm", PI / 30.0, [0, 0, -1, 1], false),
    ("N", 1.0, [1, 1, -2, 0], true),
    ("Nm", 1.0, [1, 2, -2, 0], true),
    ("J", 1.0, [1, 2, -2, 0], true),
    ("W", 1.0, [1, 2, -3, 0], true),
    ("Pa", 1.0, [1, -1, -2, 0], true),
];

const PREFIXES: &[(char, f64)] = &[
    ('G', 1e9),
    ('M', 1e6),
    ('k', 1e3),
    ('c', 1e-2),
    ('m', 1e-3),
    ('u', 1e-6),
    ('µ', 1e-6),
    ('n', 1e-9),
];

/// A value with its dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// In kg, m, s and rad, or as it stands if no unit was named.
    value: f64,
    /// None if no unit was named.
    dimension: Option<Dimension>,
}

impl Quantity {
    /// Reads a value.
    ///
    /// # Errors
    /// What is wrong with `text`, with the nearest unit if one is unknown.
    pub fn parse(text: &str) -> Result<Self, String> {
        let body = text.trim();
        let unsigned = body.strip_prefix(['+', '-', '−']).unwrap_or(body);
        let word = unsigned.to_lowercase();
        if ["nan", "inf", "infinity"].contains(&word.as_str()) {
            return Err(format!("`{text}` is not a finite number"));
        }
        let mut value = product(unsigned.trim_start()).map_err(|e| format!("`{text}`: {e}"))?;
        if body.starts_with(['-', '−']) {
            value.value = -value.value;
        }
        if value.value.is_finite() {
            Ok(value)
        } else {
            Err(format!("`{text}` is not a finite number"))
        }
    }

    /// The number in the unit `declared`. A bare number is in that unit already; with no unit declared, kg, m, s and rad are meant.
    ///
    /// # Errors
    /// If the dimensions differ.
    pub fn in_unit(self, declared: Option<&str>) -> Result<f64, String> {
        let unit = declared.and_then(|name| Some((name, unit(name)?)));
        let (Some(own), Some((name, one))) = (self.dimension, unit) else {
            return Ok(self.value);
        };
        if one.dimension == self.dimension {
            return Ok(self.value / one.value);
        }
        let own = describe(own);
        Err(format!("a value in {name} is needed, not one in {own}"))
    }

    #[must_use]
    fn times(self, factor: Quantity, power: i32) -> Self {
        let sum = |a: Dimension, b: Dimension| std::array::from_fn(|i| a[i] + power * b[i]);
        let dimension = match (self.dimension, factor.dimension) {
            (a, None) => a,
            (a, Some(b)) => Some(sum(a.unwrap_or_default(), b)),
        };
        let value = self.value * factor.value.powi(power);
        Quantity { value, dimension }
    }
}

/// A bare number, in whatever unit is declared.
impl From<f64> for Quantity {
    fn from(value: f64) -> Self {
        Quantity {
            value,
            dimension: None,
        }
    }
}

/// The unit that `text` stands for, such as `m`, `kg m^2`, `rad/s`, `1/s`; none where it names none.
fn unit(text: &str) -> Option<Quantity> {
    Quantity::parse(text).ok().filter(|q| q.dimension.is_some())
}

/// The unit a doc comment ends with: after a comma or "in", or in brackets: "mass of link 1, kg", "span (m)", "phase in rad".
pub fn unit_in(doc: &str) -> Option<&str> {
    let doc = doc.trim().trim_end_matches('.');
    let inside = |open, close| Some(doc.rsplit_once(open)?.1.split_once(close)?.0);
    let after = |mark| Some(doc.rsplit_once(mark)?.1);
    let places = [
        inside('[', ']'),
        inside('(', ')'),
        after(", "),
        after(" in "),
    ];
    let mut words = places.into_iter().flatten().map(str::trim);
    words.find(|word| unit(word).is_some())
}

/// The unit of an option of a start: its own, or the one that its doc comment names.
#[must_use]
pub fn of_option(option: &StartOption) -> Option<&'static str> {
    let own = Some(option.unit).filter(|unit| !unit.is_empty());
    own.or_else(|| unit_in(option.doc))
}

/// Splits `NAME=VALUE`.
///
/// # Errors
/// If there is no `=`, no name, or the value is not understood.
pub fn assignment(text: &str) -> Result<(String, Quantity), String> {
    let Some((name, value)) = text.split_once('=') else {
        return Err(format!("`{text}` is not of the form NAME=VALUE"));
    };
    match (name.trim(), value.trim()) {
        ("", _) => Err(format!("`{text}` has no name before `=`")),
        (_, "") => Err(format!("`{text}` has no value after `=`")),
        (name, _) => Ok((name.to_owned(), Quantity::parse(value)?)),
    }
}

/// A time in seconds: `1.5`, `20ms`, `2min`.
///
/// # Errors
/// If the value is not understood or not a time.
pub fn seconds(text: &str) -> Result<f64, String> {
    Quantity::parse(text)?.in_unit(Some("s"))
}

fn describe(dimension: Dimension) -> String {
    let units = ["kg", "m", "s", "rad"].into_iter().zip(dimension);
    let parts = units.filter(|(_, power)| *power != 0);
    let words: Vec<String> = parts
        .map(|(unit, power)| match power {
            1 => unit.to_owned(),
            _ => format!("{unit}^{power}"),
        })
        .collect();
    if words.is_empty() {
        return "plain numbers".to_owned();
    }
    words.join(" ")
}

fn product(text: &str) -> Result<Quantity, String> {
    let (mut total, mut rest) = factor(text)?;
    loop {
        rest = rest.trim_start();
        let (power, next) = match rest.chars().next() {
            None => return Ok(total),
            Some(sign @ ('*' | '·' | '/')) => {
                (if sign == '/' { -1 } else { 1 }, &rest[sign.len_utf8()..])
            }
            Some(c) if is_letter(c) => (1, rest),
            Some(c) if c.is_ascii_digit() || c == '.' => {
                return Err(format!("`*`, `/` or `^` is missing before `{rest}`"));
            }
            Some(_) => return Err(format!("`{rest}` is not understood")),
        };
        let (next, after) = factor(next.trim_start())?;
        total = total.times(next, power);
        rest = after;
    }
}

/// The factor that `text` begins with, and what follows it.
fn factor(text: &str) -> Result<(Quantity, &str), String> {
    match text.chars().next() {
        Some(c) if c.is_ascii_digit() || c == '.' => {
            let (number, rest) = text.split_at(number_length(text));
            let value: Result<f64, _> = number.parse();
            let value = value.map_err(|_| format!("`{number}` is not a number"))?;
            Ok((Quantity::from(value), rest))
        }
        Some(c) if is_letter(c) => {
            let end = text.find(|c| !is_letter(c)).unwrap_or(text.len());
            let (name, rest) = text.split_at(end);
            if ["PI", "pi", "π"].contains(&name) {
                return Ok((PI.into(), rest));
            }
            let (power, rest) = exponent(rest)?;
            Ok((Quantity::from(1.0).times(named(name)?, power), rest))
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

/// The power at the start of `text`, 1 if there is none, and what follows it.
fn exponent(text: &str) -> Result<(i32, &str), String> {
    for (sign, power) in [('²', 2), ('³', 3)] {
        if let Some(rest) = text.strip_prefix(sign) {
            return Ok((power, rest));
        }
    }
    let Some(power) = text.strip_prefix('^') else {
        return Ok((1, text));
    };
    let start = usize::from(power.starts_with('-'));
    let end = power[start..].find(|c: char| !c.is_ascii_digit());
    let (power, rest) = power.split_at(end.map_or(power.len(), |end| start + end));
    let small = power.parse().ok().filter(|power: &i32| power.abs() < 100);
    Ok((small.ok_or("an exponent must be a small integer")?, rest))
}

/// The unit called `name`, with or without a prefix.
fn named(name: &str) -> Result<Quantity, String> {
    let find = |name: &str, factor: f64| {
        let entry = UNITS.iter().find(|(unit, ..)| *unit == name)?;
        (factor == 1.0 || entry.3).then_some(Quantity {
            value: factor * entry.1,
            dimension: Some(entry.2),
        })
    };
    let mut prefixed = PREFIXES
        .iter()
        .filter_map(|&(prefix, factor)| find(name.strip_prefix(prefix)?, factor));
    find(name, 1.0).or_else(|| prefixed.next()).ok_or_else(|| {
        let mut units = UNITS.iter().map(|(unit, ..)| *unit);
        Error::unknown_name("unit", name, &mut units).to_string()
    })
}

#[cfg(test)]
#[path = "units_tests.rs"]
mod tests;
