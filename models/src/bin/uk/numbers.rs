//! Numbers as text for reading.

/// A number with `digits` decimals; what rounds to zero has no sign.
pub(crate) fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
        _ => text,
    }
}

/// A number with at most `digits` decimals, without trailing zeros; in full if that would lose more than rounding does to a part of 10⁻⁶.
pub(crate) fn short(value: f64, digits: usize) -> String {
    let text = fixed(value, digits);
    let lost = text
        .parse::<f64>()
        .map_or(f64::INFINITY, |v| (v - value).abs());
    if lost > 1e-6 * value.abs() {
        return value.to_string();
    }
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A number of things: `1 step`, `2 steps`.
pub(crate) fn count(number: usize, thing: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {thing}{plural}")
}

/// The widest of some names, in characters.
pub(crate) fn width<'a>(names: impl IntoIterator<Item = &'a str>) -> usize {
    names
        .into_iter()
        .map(|n| n.chars().count())
        .max()
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_has_no_sign() {
        assert_eq!(fixed(-1e-18, 8), "0.00000000");
        assert_eq!(fixed(-0.25, 1), "-0.2");
    }

    #[test]
    fn short_numbers_keep_their_value() {
        assert_eq!(short(std::f64::consts::FRAC_PI_2, 6), "1.570796");
        assert_eq!(short(12.0, 6), "12");
        assert_eq!(short(-5.0, 6), "-5");
        assert_eq!(short(0.0, 6), "0");
        assert_eq!(short(1.23e-9, 6), "0.00000000123");
        assert_eq!(short(100.0, 0), "100");
        assert_eq!(short(1e20, 6), "100000000000000000000");
    }

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
