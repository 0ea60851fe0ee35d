//! Numbers as text for reading.

pub use ukcore::numbers::{fixed, full, short};

/// A number of things: `1 step`, `2 steps`.
#[must_use]
pub fn count(number: usize, thing: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {thing}{plural}")
}

/// The number of fifteen digits next to `value`: 0.3 for 0.1 + 2·0.1, as is meant by who writes fewer.
#[must_use]
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// A time with its unit: `34.0 µs`, `1.20 s`.
#[must_use]
pub fn duration(seconds: f64) -> String {
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

/// The widest of some names, in characters.
#[must_use]
pub fn width<'a>(names: impl IntoIterator<Item = &'a str>) -> usize {
    let lengths = names.into_iter().map(|n| n.chars().count());
    lengths.max().unwrap_or(0)
}

/// The middle one of some numbers; of two the larger.
#[must_use]
pub fn median(mut values: Vec<f64>) -> Option<f64> {
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
    fn widths() {
        assert_eq!(width(["θ1", "abc"]), 3);
        assert_eq!(width([]), 0);
    }
}
