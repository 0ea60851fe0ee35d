//! Values of parameters as written on the command line: `15deg`, `12mm`, `2*PI`, `9.81 m/s^2`.
//!
//! ```text
//! value   = term { ("+" | "-") term } ;
//! term    = factor { ("*" | "/") factor | factor } ;      (a juxtaposed factor multiplies: 2 PI, N m)
//! factor  = [ "+" | "-" ] power ;
//! power   = atom [ "^" integer ] ;
//! atom    = number [ unit [ "^" integer ] ] | name | "(" value ")" ;       (1/2m is 1/(2 m))
//! name    = "PI" | unit ;
//! ```

use std::f64::consts::PI;

use ukcore::Error;

/// Exponents of kilogram, metre, second and radian. The radian counts, so that an angle is not taken for a number.
type Dimension = [i32; 4];

const NONE: Dimension = [0; 4];

/// Name, value in kg, m, s and rad, dimension. A hertz is a turn a second: what is declared in this project are angular frequencies.
const UNITS: &[(&str, f64, Dimension)] = &[
    ("kg", 1.0, [1, 0, 0, 0]),
    ("g", 1e-3, [1, 0, 0, 0]),
    ("mg", 1e-6, [1, 0, 0, 0]),
    ("m", 1.0, [0, 1, 0, 0]),
    ("km", 1e3, [0, 1, 0, 0]),
    ("cm", 1e-2, [0, 1, 0, 0]),
    ("mm", 1e-3, [0, 1, 0, 0]),
    ("um", 1e-6, [0, 1, 0, 0]),
    ("s", 1.0, [0, 0, 1, 0]),
    ("ms", 1e-3, [0, 0, 1, 0]),
    ("us", 1e-6, [0, 0, 1, 0]),
    ("min", 60.0, [0, 0, 1, 0]),
    ("h", 3600.0, [0, 0, 1, 0]),
    ("rad", 1.0, [0, 0, 0, 1]),
    ("mrad", 1e-3, [0, 0, 0, 1]),
    ("deg", PI / 180.0, [0, 0, 0, 1]),
    ("°", PI / 180.0, [0, 0, 0, 1]),
    ("turn", 2.0 * PI, [0, 0, 0, 1]),
    ("Hz", 2.0 * PI, [0, 0, -1, 1]),
    ("rpm", PI / 30.0, [0, 0, -1, 1]),
    ("N", 1.0, [1, 1, -2, 0]),
    ("kN", 1e3, [1, 1, -2, 0]),
    ("mN", 1e-3, [1, 1, -2, 0]),
    ("Nm", 1.0, [1, 2, -2, 0]),
    ("J", 1.0, [1, 2, -2, 0]),
    ("kJ", 1e3, [1, 2, -2, 0]),
    ("mJ", 1e-3, [1, 2, -2, 0]),
    ("W", 1.0, [1, 2, -3, 0]),
    ("Pa", 1.0, [1, -1, -2, 0]),
    ("kPa", 1e3, [1, -1, -2, 0]),
    ("MPa", 1e6, [1, -1, -2, 0]),
];

/// A value with its dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quantity {
    /// In kg, m, s and rad, or as it stands if no unit was named.
    value: f64,
    dimension: Dimension,
    /// A unit was named.
    has_unit: bool,
}

impl Quantity {
    /// Reads a value.
    ///
    /// # Errors
    /// What is wrong with `text`, with the nearest unit if one is unknown.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let word = text.trim().trim_start_matches(['-', '+']).to_lowercase();
        if ["nan", "inf", "infinity"].contains(&word.as_str()) {
            return Err(format!("`{text}` is not a finite number"));
        }
        let mut parser = Parser {
            rest: text,
            depth: 0,
        };
        let quantity = parser.sum().map_err(|e| format!("`{text}`: {e}"))?;
        if !parser.rest.is_empty() {
            return Err(format!("`{text}`: `{}` is not understood", parser.rest));
        }
        if !quantity.value.is_finite() {
            return Err(format!("`{text}` is not a finite number"));
        }
        Ok(quantity)
    }

    /// The number in the unit `declared`. A bare number is in that unit already; with no unit declared, kg, m, s and rad are meant.
    ///
    /// # Errors
    /// If the dimensions differ.
    pub(crate) fn in_unit(self, declared: Option<&str>) -> Result<f64, String> {
        if !self.has_unit {
            return Ok(self.value);
        }
        let Some(unit) = declared.filter(|u| is_unit(u)) else {
            return Ok(self.value);
        };
        let one = Quantity::parse(unit)?;
        if one.dimension == self.dimension {
            Ok(self.value / one.value)
        } else {
            Err(format!(
                "a value in {unit} is needed, not one in {}",
                describe(self.dimension)
            ))
        }
    }
}

/// Whether `text` is a unit: `m`, `kg m^2`, `rad/s`, `1/s`.
pub(crate) fn is_unit(text: &str) -> bool {
    Quantity::parse(text).is_ok_and(|q| q.has_unit)
}

/// The unit a doc comment ends with: after a comma or "in", or in brackets: "mass of link 1, kg", "span (m)", "phase in rad".
pub(crate) fn unit_in(doc: &str) -> Option<&str> {
    let doc = doc.trim().trim_end_matches('.');
    let inside = |open, close| {
        let (_, tail) = doc.rsplit_once(open)?;
        tail.split_once(close).map(|(unit, _)| unit)
    };
    let after = |mark| doc.rsplit_once(mark).map(|(_, unit)| unit);
    [
        inside('[', ']'),
        inside('(', ')'),
        after(", "),
        after(" in "),
    ]
    .into_iter()
    .flatten()
    .map(str::trim)
    .find(|unit| is_unit(unit))
}

/// Splits `NAME=VALUE`.
///
/// # Errors
/// If there is no `=`, no name, or the value is not understood.
pub(crate) fn assignment(text: &str) -> Result<(String, Quantity), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| format!("`{text}` is not of the form NAME=VALUE"))?;
    let name = name.trim();
    if name.is_empty() {
        return Err(format!("`{text}` has no name before `=`"));
    }
    if value.trim().is_empty() {
        return Err(format!("`{text}` has no value after `=`"));
    }
    Ok((name.to_owned(), Quantity::parse(value)?))
}

/// A time in seconds: `1.5`, `20ms`, `2min`.
///
/// # Errors
/// If the value is not understood or not a time.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    Quantity::parse(text)?.in_unit(Some("s"))
}

fn describe(dimension: Dimension) -> String {
    let parts: Vec<String> = ["kg", "m", "s", "rad"]
        .iter()
        .zip(dimension)
        .filter(|(_, power)| *power != 0)
        .map(|(unit, power)| match power {
            1 => (*unit).to_owned(),
            _ => format!("{unit}^{power}"),
        })
        .collect();
    if parts.is_empty() {
        "plain numbers".to_owned()
    } else {
        parts.join(" ")
    }
}

/// Parentheses deeper than this are a mistake, not a value; the bound keeps the parser's recursion finite.
const DEEPEST: usize = 32;

struct Parser<'a> {
    rest: &'a str,
    depth: usize,
}

impl Parser<'_> {
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.rest = &self.rest[wanted.len_utf8()..];
        }
        found
    }

    fn sum(&mut self) -> Result<Quantity, String> {
        let mut left = self.product()?;
        loop {
            let sign = match self.peek() {
                Some('+') => 1.0,
                Some('-' | '−') => -1.0,
                _ => return Ok(left),
            };
            self.bump();
            let right = self.product()?;
            if left.dimension != right.dimension || left.has_unit != right.has_unit {
                return Err(format!(
                    "{} and {} cannot be added",
                    describe(left.dimension),
                    describe(right.dimension)
                ));
            }
            left.value += sign * right.value;
        }
    }

    fn product(&mut self) -> Result<Quantity, String> {
        let mut left = self.factor()?;
        loop {
            let power = match self.peek() {
                Some('*' | '·') => {
                    self.bump();
                    1
                }
                Some('/') => {
                    self.bump();
                    -1
                }
                Some(c) if c == '(' || c == '.' || c == '°' || c.is_alphanumeric() => 1,
                _ => return Ok(left),
            };
            let right = self.factor()?;
            left = times(left, raised(right, power));
        }
    }

    fn factor(&mut self) -> Result<Quantity, String> {
        match self.peek() {
            Some('+') => {
                self.bump();
                self.power()
            }
            Some('-' | '−') => {
                self.bump();
                let quantity = self.power()?;
                Ok(Quantity {
                    value: -quantity.value,
                    ..quantity
                })
            }
            _ => self.power(),
        }
    }

    fn power(&mut self) -> Result<Quantity, String> {
        match self.peek() {
            Some('(') => {
                self.bump();
                self.depth += 1;
                if self.depth > DEEPEST {
                    return Err("parentheses are nested too deep".to_owned());
                }
                let inner = self.sum()?;
                self.depth -= 1;
                if !self.take(')') {
                    return Err("a `)` is missing".to_owned());
                }
                self.exponent(inner)
            }
            Some(c) if c == '.' || c.is_ascii_digit() => {
                let number = self.number()?;
                // A unit or PI touching the number belongs to it.
                match self.rest.chars().next() {
                    Some(c) if c == '°' || c.is_alphabetic() => {
                        let name = self.name()?;
                        Ok(times(number, self.exponent(name)?))
                    }
                    _ => self.exponent(number),
                }
            }
            Some(c) if c == '°' || c.is_alphabetic() => {
                let name = self.name()?;
                self.exponent(name)
            }
            Some(c) => Err(format!("a value is expected at `{c}`")),
            None => Err("a value is missing".to_owned()),
        }
    }

    fn exponent(&mut self, base: Quantity) -> Result<Quantity, String> {
        let exponent = match self.peek() {
            Some('²') => 2,
            Some('³') => 3,
            Some('^') => {
                self.bump();
                let negative = self.take('-');
                self.peek();
                let digits = self.split(|c| c.is_ascii_digit());
                // More than two digits are no exponent of a unit, and powi needs an i32.
                let size: i32 = digits
                    .parse()
                    .ok()
                    .filter(|n| *n < 100)
                    .ok_or("an exponent must be a small integer")?;
                return Ok(raised(base, if negative { -size } else { size }));
            }
            _ => return Ok(base),
        };
        self.bump();
        Ok(raised(base, exponent))
    }

    fn number(&mut self) -> Result<Quantity, String> {
        let text = self.rest;
        let digits = |from: usize| {
            text[from..]
                .find(|c: char| !c.is_ascii_digit())
                .map_or(text.len(), |n| from + n)
        };
        let mut end = digits(0);
        if text[end..].starts_with('.') {
            end = digits(end + 1);
        }
        // An `e` is an exponent only if digits follow: `2e3`, but not `2 e`.
        if text[end..].starts_with(['e', 'E']) {
            let sign = usize::from(text[end + 1..].starts_with(['+', '-']));
            let start = end + 1 + sign;
            let stop = digits(start);
            if stop > start {
                end = stop;
            }
        }
        let (number, rest) = text.split_at(end);
        self.rest = rest;
        let value = number
            .parse()
            .map_err(|_| format!("`{number}` is not a number"))?;
        Ok(Quantity {
            value,
            dimension: NONE,
            has_unit: false,
        })
    }

    fn name(&mut self) -> Result<Quantity, String> {
        let name = match self.rest.strip_prefix('°') {
            Some(rest) => {
                self.rest = rest;
                "°"
            }
            None => self.split(|c| c.is_alphabetic() || c == '_'),
        };
        if name == "PI" || name == "pi" || name == "π" {
            return Ok(Quantity {
                value: PI,
                dimension: NONE,
                has_unit: false,
            });
        }
        UNITS
            .iter()
            .find(|(unit, ..)| *unit == name)
            .map(|&(_, value, dimension)| Quantity {
                value,
                dimension,
                has_unit: true,
            })
            .ok_or_else(|| {
                let mut units = UNITS.iter().map(|(unit, ..)| *unit);
                Error::unknown_name("unit", name, &mut units).to_string()
            })
    }

    /// Takes the longest start of the rest whose characters all satisfy `accept`.
    fn split(&mut self, accept: impl Fn(char) -> bool) -> &str {
        let end = self.rest.find(|c| !accept(c)).unwrap_or(self.rest.len());
        let (taken, rest) = self.rest.split_at(end);
        self.rest = rest;
        taken
    }

    fn bump(&mut self) {
        let mut chars = self.rest.chars();
        chars.next();
        self.rest = chars.as_str();
    }
}

fn times(a: Quantity, b: Quantity) -> Quantity {
    Quantity {
        value: a.value * b.value,
        dimension: std::array::from_fn(|i| a.dimension[i] + b.dimension[i]),
        has_unit: a.has_unit || b.has_unit,
    }
}

fn raised(a: Quantity, power: i32) -> Quantity {
    Quantity {
        value: a.value.powi(power),
        dimension: a.dimension.map(|d| d * power),
        has_unit: a.has_unit,
    }
}

#[cfg(test)]
#[path = "units_tests.rs"]
mod tests;
