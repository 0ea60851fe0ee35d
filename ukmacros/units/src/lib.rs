//! Units of measurement: the one table of them, for declarations and for the command line.
//!
//! ```text
//! unit   = "-" | factor { [ "*" | "·" | "/" ] factor } ;          (from left to right)
//! factor = "1" | name [ "^" [ "-" ] number | "²" | "³" ] ;
//! ```

mod dimension;
mod table;

pub use dimension::Dimension;

use dimension::TWELFTHS;
use std::fmt::{self, Write as _};
use table::{Base, HERTZ, OTHERS, PREFIXES, Prefix, UNITS};

/// A product of powers of known units, as it is written: `kg m^2`, `mm`, `rad/s`.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    factors: Vec<Factor>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Factor {
    prefix: Prefix,
    base: &'static Base,
    /// The power of the factor, in twelfths.
    power: i32,
}

/// Why a text is no unit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Refusal {
    /// There is no unit of this name.
    Unknown(String),
    /// A hertz, by which some mean a turn a second and some 1/s.
    Hertz,
    /// What stands behind `^` is no small number.
    Exponent,
    /// A product without a sign behind `/`, which some read as a part of the divisor: its last two factors.
    Ambiguous(String, String),
    /// What begins here is not understood.
    Unexpected(String),
    /// There is nothing where a unit should be.
    Missing,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::Unknown(name) => write!(f, "unknown unit `{name}`"),
            Refusal::Hertz => f.write_str(
                "a hertz may be meant as a turn a second or as 1/s; write `rpm`, `rad/s` or `1/s`",
            ),
            Refusal::Exponent => {
                f.write_str("an exponent of a unit is a small number, such as `m^2`")
            }
            Refusal::Ambiguous(a, b) => write!(
                f,
                "`/{a} {b}` has two readings; write `/{a}/{b}`, or `{b}` before the `/`"
            ),
            Refusal::Unexpected(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => {
                write!(f, "`*`, `/` or `^` is missing before `{rest}`")
            }
            Refusal::Unexpected(rest) => write!(f, "`{rest}` is not understood in a unit"),
            Refusal::Missing => f.write_str("a unit is missing"),
        }
    }
}

impl std::error::Error for Refusal {}

/// The names of all units that are taken, without prefixes.
pub fn names() -> impl Iterator<Item = &'static str> {
    let names = UNITS.iter().map(|unit| unit.name);
    names.filter(|name| *name != HERTZ)
}

/// A quantity that is 1 of a unit which is none here: of an inch, `in`, it is `25.4 [mm]`.
#[must_use]
pub fn elsewhere(name: &str) -> Option<&'static str> {
    let found = OTHERS.iter().find(|(other, _)| *other == name);
    found.map(|(_, here)| *here)
}

/// Whether there is a unit of this `name`, with or without a prefix.
#[must_use]
pub fn is_known(name: &str) -> bool {
    named(name).is_some()
}

fn named(name: &str) -> Option<(Prefix, &'static Base)> {
    let whole = UNITS.iter().find(|unit| unit.name == name);
    let prefixed = || {
        PREFIXES.iter().find_map(|prefix| {
            let rest = name.strip_prefix(prefix.letter)?;
            let unit = UNITS
                .iter()
                .find(|unit| unit.prefixed && unit.name == rest)?;
            Some((*prefix, unit))
        })
    };
    whole.map(|unit| (Prefix::NONE, unit)).or_else(prefixed)
}

impl Unit {
    /// Reads a unit from its text, such as `kN/mm`, `kg m^2` or `-` for a plain number.
    ///
    /// # Errors
    /// What is wrong with `text`.
    pub fn parse(text: &str) -> Result<Self, Refusal> {
        let mut factors: Vec<Factor> = Vec::new();
        let mut rest = text.trim();
        if rest == "-" {
            return Ok(Unit { factors });
        }
        // The sign before the next factor, if one is written.
        let (mut divides, mut written) = (false, true);
        loop {
            let (factor, after) = factor(rest)?;
            if let Some(mut factor) = factor {
                if let (Some(last), true, false) = (factors.last(), divides, written) {
                    let divisor = Factor {
                        power: -last.power,
                        ..*last
                    };
                    return Err(Refusal::Ambiguous(divisor.text(), factor.text()));
                }
                if divides {
                    factor.power = -factor.power;
                }
                factors.push(factor);
            }
            rest = after.trim_start();
            let Some(next) = rest.chars().next() else {
                return Ok(Unit { factors });
            };
            written = ['*', '·', '/'].contains(&next);
            if written {
                divides = next == '/';
                rest = rest[next.len_utf8()..].trim_start();
            }
        }
    }

    /// The dimension of what the unit measures.
    #[must_use]
    pub fn dimension(&self) -> Dimension {
        let powers = self
            .factors
            .iter()
            .map(|f| f.base.dimension.scaled(f.power));
        powers.fold(Dimension::NUMBER, Dimension::times)
    }

    /// `x` of this unit in kg, m, s and rad. Decimal units give what the number with its point shifted is read as: 300 mm are 0.3 m.
    #[must_use]
    pub fn to_si(&self, x: f64) -> f64 {
        let (up, down, decimals) = self.scale();
        shifted(x * up / down, decimals)
    }

    /// `x` in kg, m, s and rad as a number of this unit.
    #[must_use]
    pub fn from_si(&self, x: f64) -> f64 {
        let (up, down, decimals) = self.scale();
        shifted(x * down / up, -decimals)
    }

    /// Whether numbers of this unit are numbers in kg, m, s and rad.
    #[must_use]
    pub fn is_coherent(&self) -> bool {
        self.scale() == (1.0, 1.0, 0)
    }

    /// The value of the unit in kg, m, s and rad: a quotient, and a power of ten in twelfths.
    fn scale(&self) -> (f64, f64, i32) {
        let (mut up, mut down, mut decimals) = (1.0, 1.0, 0);
        for Factor {
            prefix,
            base,
            power,
        } in &self.factors
        {
            let exponent = f64::from(*power) / f64::from(TWELFTHS);
            up *= base.up.powf(exponent);
            down *= base.down.powf(exponent);
            decimals += (prefix.decimals + base.decimals) * power;
        }
        (up, down, decimals)
    }

    /// The unit that stands for this one in SI, of kilogram, metre, second, radian and units made of these: `N/m` for `kN/mm`, `rad/s` for
    /// `rpm`; empty for a plain number.
    #[must_use]
    pub fn si(&self) -> String {
        let mut powers: Vec<(&str, i32)> = Vec::new();
        for factor in &self.factors {
            for (symbol, power) in factor.base.si {
                let power = power * factor.power;
                match powers.iter_mut().find(|(known, _)| known == symbol) {
                    Some((_, sum)) => *sum += power,
                    None => powers.push((symbol, power)),
                }
            }
        }
        product(&powers)
    }
}

/// Writes the unit as it is written, without regard to spaces and signs; nothing for a number.
impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factors = self.factors.iter();
        let powers: Vec<(String, i32)> = factors.map(|f| (f.name(), f.power)).collect();
        f.write_str(&product(&powers))
    }
}

impl Factor {
    fn name(&self) -> String {
        format!("{}{}", self.prefix.letter, self.base.name)
    }

    fn text(&self) -> String {
        product(&[(self.name(), self.power)])
    }
}

/// `x` 10^d, d in twelfths.
fn shifted(x: f64, decimals: i32) -> f64 {
    // Powers of ten up to 22 are exact: dividing by one rounds once.
    let ten = |d: i32| match d % TWELFTHS {
        0 => 10_f64.powi(d / TWELFTHS),
        _ => 10_f64.powf(f64::from(d) / f64::from(TWELFTHS)),
    };
    match decimals {
        0 => x,
        1.. => x * ten(decimals),
        _ => x / ten(-decimals),
    }
}

/// Powers as a product: `kg m^2/s^2`, `1/s`.
fn product<N: fmt::Display>(powers: &[(N, i32)]) -> String {
    let mut out = String::new();
    let mut write = |before: &str, name: &N, power: i32| {
        let _ = write!(out, "{before}{name}");
        if power != TWELFTHS {
            let _ = write!(out, "^{}", f64::from(power) / f64::from(TWELFTHS));
        }
    };
    let mut first = true;
    for (name, power) in powers.iter().filter(|(_, power)| *power > 0) {
        write(if first { "" } else { " " }, name, *power);
        first = false;
    }
    for (name, power) in powers.iter().filter(|(_, power)| *power < 0) {
        write(if first { "1/" } else { "/" }, name, -power);
        first = false;
    }
    out
}

/// The factor that `text` begins with, none for 1, and what follows it.
fn factor(text: &str) -> Result<(Option<Factor>, &str), Refusal> {
    let letter = |c: char| c.is_alphabetic() || c == '_' || c == '°';
    let end = text.find(|c| !letter(c)).unwrap_or(text.len());
    if end > 0 {
        let (name, rest) = text.split_at(end);
        let (prefix, base) = named(name).ok_or_else(|| Refusal::Unknown(name.to_owned()))?;
        if base.name == HERTZ {
            return Err(Refusal::Hertz);
        }
        let (power, rest) = exponent(rest)?;
        let factor = Factor {
            prefix,
            base,
            power,
        };
        return Ok((Some(factor), rest));
    }
    match text.strip_prefix('1') {
        Some(rest) if !rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
            Ok((None, rest))
        }
        _ if text.is_empty() => Err(Refusal::Missing),
        _ => Err(Refusal::Unexpected(text.to_owned())),
    }
}

/// The power at the start of `text` in twelfths, one if there is none, and what follows it.
fn exponent(text: &str) -> Result<(i32, &str), Refusal> {
    for (sign, power) in [('²', 2), ('³', 3)] {
        if let Some(rest) = text.strip_prefix(sign) {
            return Ok((power * TWELFTHS, rest));
        }
    }
    let Some(power) = text.trim_start().strip_prefix('^') else {
        return Ok((TWELFTHS, text));
    };
    let power = power.trim_start();
    let (negative, power) = match power.strip_prefix('-') {
        Some(rest) => (true, rest.trim_start()),
        None => (false, power),
    };
    let digits = |c: char| !(c.is_ascii_digit() || c == '.');
    let (digits, rest) = power.split_at(power.find(digits).unwrap_or(power.len()));
    let value: f64 = digits.parse().map_err(|_| Refusal::Exponent)?;
    let twelfths = dimension::twelfths(value).filter(|power| (1..100 * TWELFTHS).contains(power));
    let power = twelfths.ok_or(Refusal::Exponent)?;
    Ok((if negative { -power } else { power }, rest))
}

#[cfg(test)]
mod tests;
