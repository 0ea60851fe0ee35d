//! Equidistant times as people write them: 0.9 is three times 0.3, and 1 is three times 1/3.

use crate::scalar::DoubleDouble;
use crate::scalar::Scalar;

/// A decimal of so many digits is the only one of them that rounds to its `f64`.
const DIGITS: usize = 15;

/// Largest product of numerator and denominator of a simple fraction. No two of them round to the same `f64`, and of the `f64` one in ten
/// thousand has one: where there is one, it is hardly an accident.
const SIMPLE: f64 = 1e12;

/// The number that `x` stands for, as numerator and denominator, if it is a simple fraction or a decimal of few digits.
fn meant_by(x: f64) -> Option<(i128, i128)> {
    let sign = x.signum() as i128;
    let (p, q) = fraction(x.abs()).or_else(|| decimal(x.abs()))?;
    Some((sign * p, q))
}

/// The simple fraction that rounds to `x`: a convergent of its continued fraction.
fn fraction(x: f64) -> Option<(i128, i128)> {
    let (mut before, mut last) = ((0.0, 1.0), (1.0, 0.0));
    let mut rest = x;
    loop {
        let whole = rest.floor();
        let next = (whole * last.0 + before.0, whole * last.1 + before.1);
        (before, last) = (last, next);
        let (p, q) = last;
        if !(p * q <= SIMPLE && p.max(q) <= SIMPLE) {
            return None;
        }
        if p / q == x {
            return Some((p as i128, q as i128));
        }
        rest = (rest - whole).recip();
    }
}

/// The decimal of few digits that rounds to `x`.
fn decimal(x: f64) -> Option<(i128, i128)> {
    let text = format!("{x:e}");
    let (digits, exponent) = text.split_once('e')?;
    let digits = digits.replace('.', "");
    if digits.len() > DIGITS {
        return None;
    }
    let number: i128 = digits.parse().ok()?;
    let shift = exponent.parse::<i32>().ok()? - (digits.len() as i32 - 1);
    let power = 10_i128.checked_pow(shift.unsigned_abs())?;
    if shift < 0 {
        Some((number, power))
    } else {
        Some((number.checked_mul(power)?, 1))
    }
}

/// The nearest `f64` to a fraction.
fn quotient(p: i128, q: i128) -> f64 {
    let long = |x: i128| {
        let high = x as f64;
        DoubleDouble::from_f64(high) + DoubleDouble::from_f64((x - high as i128) as f64)
    };
    (long(p) / long(q)).to_f64()
}

/// The times `start` + k `step`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    start: f64,
    step: f64,
    /// Numerators of what they stand for, and the denominator.
    exact: Option<(i128, i128, i128)>,
}

impl Grid {
    pub(super) fn new(start: f64, step: f64) -> Self {
        let exact = || {
            let ((p, q), (r, s)) = (meant_by(start)?, meant_by(step)?);
            let common = s / gcd(q, s);
            let (scale, denominator) = (common.checked_mul(q)? / s, common.checked_mul(q)?);
            Some((p.checked_mul(common)?, r.checked_mul(scale)?, denominator))
        };
        Grid {
            start,
            step,
            exact: exact(),
        }
    }

    /// Time `k`, rounded once; twice where start or step stands for nothing but itself, or is too large or too small for such numbers.
    pub(super) fn time(&self, k: usize) -> f64 {
        let exact = || {
            let (start, step, denominator) = self.exact?;
            let moved = step.checked_mul(k as i128)?.checked_add(start)?;
            Some(quotient(moved, denominator))
        };
        exact().unwrap_or(self.start + k as f64 * self.step)
    }
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_of_decimals_are_the_nearest_decimals() {
        for (step, power) in [
            (3, 1),
            (1, 1),
            (7, 1),
            (5, 2),
            (13, 3),
            (1, 3),
            (1, 6),
            (123_456_789, 9),
            (25, 0),
        ] {
            for (start, sign) in [(0_i64, 1_i64), (1, 1), (-3, 1), (12_345, -1)] {
                let number = |x: i64| format!("{x}e-{power}").parse::<f64>().unwrap();
                let grid = Grid::new(number(start), number(sign * step));
                for k in (0..3000).chain([54_321, 1_000_000, 123_456_789]) {
                    let expect = number(start + sign * step * k as i64);
                    assert_eq!(grid.time(k), expect, "{start} + {k} × {step} e-{power}");
                }
            }
        }
        assert_eq!(Grid::new(0.1, 0.25).time(3), 0.85);
        assert_eq!(Grid::new(1e9, 1e-3).time(7), 1_000_000_000.007);
    }

    #[test]
    fn multiples_of_fractions_meet_whole_numbers() {
        for parts in 1..400_u32 {
            for sign in [1.0, -1.0] {
                let grid = Grid::new(sign * 2.0, sign / f64::from(parts));
                for whole in 1..50 {
                    let k = (whole * parts) as usize;
                    assert_eq!(grid.time(k), sign * f64::from(2 + whole), "1/{parts}");
                }
            }
        }
    }

    #[test]
    fn other_steps_are_multiplied_as_they_are() {
        let steps = [
            std::f64::consts::PI / 100.0,
            1.0 + f64::EPSILON,
            0.1 + 0.2,
            1e-300,
            5e-324,
            1e290,
        ];
        for step in steps {
            for start in [0.0, std::f64::consts::E, -1e-7, 3e200] {
                let grid = Grid::new(start, step);
                assert_eq!(grid.time(0), start);
                for k in [1, 2, 3, 1000, 77_777] {
                    let expect = start + k as f64 * step;
                    let near = f64::EPSILON * (start.abs() + k as f64 * step);
                    assert!(
                        (grid.time(k) - expect).abs() <= near,
                        "{start} + {k} × {step}"
                    );
                }
            }
            assert_eq!(Grid::new(0.0, step).time(1), step);
        }
    }
}
