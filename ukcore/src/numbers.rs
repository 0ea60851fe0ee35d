//! Numbers as text for reading.

/// A number with `digits` decimals; what rounds to zero has no sign.
#[must_use]
pub fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
        _ => text,
    }
}

/// A number with at most `digits` decimals, without trailing zeros; in full if that would lose more than rounding does to a part of 10⁻⁶.
#[must_use]
pub fn short(value: f64, digits: usize) -> String {
    let text = fixed(value, digits);
    let lost = text
        .parse::<f64>()
        .map_or(f64::INFINITY, |v| (v - value).abs());
    if lost > 1e-6 * value.abs() || value.abs() >= HUGE {
        return full(value);
    }
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A number from here on is written as a power of ten.
const HUGE: f64 = 1e15;
/// Below it a number is, as its digits stand behind zeros that have to be counted.
const TINY: f64 = 1e-5;

/// All digits of a number, but none that only fill it up: `0.25`, `2e200`.
#[must_use]
pub fn full(value: f64) -> String {
    if value == 0.0 || (TINY..HUGE).contains(&value.abs()) {
        return value.to_string();
    }
    format!("{value:e}")
}

/// A number with so many significant digits, and none that only fill it up.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    full(format!("{value:.*e}", digits - 1).parse().unwrap_or(value))
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
    fn significant_digits_are_counted() {
        assert_eq!(
            [1.52489, 270.0, 0.0, 2.8e-21].map(|x| significant(x, 4)),
            ["1.525", "270", "0", "2.8e-21"]
        );
    }

    #[test]
    fn short_numbers_keep_their_value() {
        assert_eq!(short(std::f64::consts::FRAC_PI_2, 6), "1.570796");
        assert_eq!(short(12.0, 6), "12");
        assert_eq!(short(-5.0, 6), "-5");
        assert_eq!(short(0.0, 6), "0");
        assert_eq!(short(1.23e-9, 6), "1.23e-9");
        assert_eq!(short(100.0, 0), "100");
        assert_eq!(short(2e200, 6), "2e200");
        assert_eq!(short(-1.5e-200, 6), "-1.5e-200");
    }
}
