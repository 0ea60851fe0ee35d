//! Numbers as text for reading.

use serde_json::Number;
use ukunits::Unit;

pub use ukcore::numbers::{fixed, full, short, significant};

/// A number of things in words: `1 step`, `2 steps`.
pub(crate) fn count(number: usize, thing: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {thing}{plural}")
}

/// The number of fifteen digits next to `value`: 0.3 for 0.1 + 2·0.1, as is meant by who writes fewer.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// A number with the fewest digits that read back as the same one, as in JSON but for the sign of large powers: `0.0001`, `1e30`.
pub(crate) fn exact(value: f64) -> String {
    let number = Number::from_f64(value);
    number.map_or(value.to_string(), |number| {
        number.to_string().replace("e+", "e")
    })
}

/// `name = value unit`, of a value in SI, or [in another unit](elsewhere).
pub(crate) fn setting(name: &str, value: f64, units: [&str; 2]) -> String {
    let (number, unit) = elsewhere(value, units).unwrap_or((short(value, 8), units[0]));
    let text = format!("{name} = {number} {unit}");
    text.trim_end().to_owned()
}

/// A value in an SI unit as it is in the other one, in which it is declared, if it has no more digits there; in degrees, if it has fewer
/// and is an angle declared in radians.
pub(crate) fn elsewhere(value: f64, units: [&str; 2]) -> Option<(String, &str)> {
    let (other, declared) = match units {
        ["rad", ""] => ("deg", false),
        [_, written] => (written, true),
    };
    let unit = Unit::parse(other).ok()?;
    let [si, number] = [value, rounded(unit.from_si(value))].map(|x| short(x, 8));
    let suits = number.len() < si.len() + usize::from(declared);
    suits.then_some((number, other))
}

/// A time, given in seconds, with three digits and the unit that suits them: `34.0 µs`, `1.20 s`.
pub(crate) fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1e-3 => (1e6 * s, "µs"),
        s if s < 1.0 => (1e3 * s, "ms"),
        s => (s, "s"),
    };
    let digits = match value {
        v if v < 10.0 => 2,
        v if v < 100.0 => 1,
        _ => 0,
    };
    format!("{} {unit}", fixed(value, digits))
}

/// The number of characters of the longest of some names; 0 if there is none.
pub(crate) fn width<'a>(names: impl IntoIterator<Item = &'a str>) -> usize {
    let lengths = names.into_iter().map(|n| n.chars().count());
    lengths.max().unwrap_or(0)
}

/// Width of a line of entries; with what stands before them, lines are within 100 characters.
const LINE: usize = 84;

/// Entries with commas between them, in lines as long as reads well where the entries allow it.
pub(crate) fn lines(entries: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for entry in entries {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 2 + entry.chars().count() <= LINE => {
                *line += ", ";
                *line += &entry;
            }
            Some(line) => {
                line.push(',');
                lines.push(entry);
            }
            None => lines.push(entry),
        }
    }
    lines
}

/// The least and the greatest of some numbers, of which what is none is passed over; ∞ and −∞ if there is none.
#[must_use]
pub fn extremes(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let (least, greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    let values = values.into_iter();
    values.fold((least, greatest), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}

/// The median of some numbers: of two in the middle the larger; nothing if there is none.
pub(crate) fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_not_many() {
        assert_eq!(
            [0, 1, 2].map(|n| count(n, "step")),
            ["0 steps", "1 step", "2 steps"]
        );
    }

    #[test]
    fn settings_are_short() {
        for (value, units, text) in [
            (50_f64.to_radians(), ["rad", "deg"], "a = 50 deg"),
            (50_f64.to_radians(), ["rad", ""], "a = 50 deg"),
            (0.9, ["rad", ""], "a = 0.9 rad"),
            (0.0, ["rad", ""], "a = 0 rad"),
            (0.5, ["", ""], "a = 0.5"),
            (1.23e-3, ["m", ""], "a = 0.00123 m"),
            (0.5, ["m", "mm"], "a = 500 mm"),
            (250.0, ["m", "mm"], "a = 250 m"),
        ] {
            assert_eq!(setting("a", value, units), text);
        }
    }

    #[test]
    fn widths() {
        assert_eq!(width(["θ1", "abc"]), 3);
        assert_eq!(width([]), 0);
    }
}
