//! Numbers of 31 digits, for references: emitted code run on them tells how far the same code in `f64` is off.

use crate::scalar::{Scalar, operators};

/// An unevaluated sum of two `f64`, 106 bits in all (Dekker 1971; Hida, Li & Bailey 2001).
///
/// Arithmetic and square roots are exact to a few units of 1e-32, other functions to about 1e-30 of their argument. Magnitudes between
/// 1e-250 and 1e290 keep all digits; sums and products are some 20 times as dear as in `f64`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleDouble {
    /// The nearest `f64`.
    hi: f64,
    /// What is left.
    lo: f64,
}

const ZERO: DoubleDouble = DoubleDouble { hi: 0.0, lo: 0.0 };
const ONE: DoubleDouble = DoubleDouble { hi: 1.0, lo: 0.0 };
/// π/2.
const QUARTER: DoubleDouble = DoubleDouble {
    hi: std::f64::consts::FRAC_PI_2,
    lo: 6.123_233_995_736_766e-17,
};
/// What π/2 has beyond `QUARTER`.
const QUARTER_REST: f64 = -1.497_384_904_859_169_7e-33;
/// ln 2.
const LN_2: DoubleDouble = DoubleDouble {
    hi: std::f64::consts::LN_2,
    lo: 2.319_046_813_846_299_6e-17,
};

/// a + b and its rounding error.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The sum of two numbers with |a| ≥ |b| and what rounding takes from it (Dekker 1971).
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble {
        hi,
        // A sum that is not finite has no remainder.
        lo: if hi.is_finite() { b - (hi - a) } else { 0.0 },
    }
}

/// a · b and its rounding error, by halves of the factors: the target need not have fused operations.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let split = |x: f64| {
        let c = 134_217_729.0 * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    let error = ((ah * bh - product) + ah * bl + al * bh) + al * bl;
    (product, if error.is_finite() { error } else { 0.0 })
}

impl DoubleDouble {
    /// The nearest `f64`.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.hi
    }

    fn scale(self, power: i32) -> Self {
        // In two steps, as a power of two itself may leave the range.
        let half = 2.0_f64.powi(power / 2);
        let rest = 2.0_f64.powi(power - power / 2);
        DoubleDouble {
            hi: self.hi * half * rest,
            lo: self.lo * half * rest,
        }
    }

    fn less(self, o: Self) -> bool {
        self.hi < o.hi || (self.hi == o.hi && self.lo < o.lo)
    }

    /// The y near `guess` at which a function has this value, by Newton's method; `f` gives the function and its slope.
    fn solved(self, guess: f64, f: fn(Self) -> (Self, Self)) -> Self {
        let mut y = DoubleDouble::from_f64(guess);
        for _ in 0..2 {
            let (value, slope) = f(y);
            let step = (self - value) / slope;
            if !step.hi.is_finite() {
                break;
            }
            y = y + step;
        }
        y
    }

    /// Taylor's series Σ xᵏ/k! over k = first, first + step, …, with the signs of `sign`ᵏ.
    fn series(self, first: i32, step: i32, sign: f64) -> Self {
        let mut term = if first == 0 { ONE } else { self };
        let square = if step == 2 { self * self } else { self };
        let (mut sum, mut k) = (term, first);
        while term.hi.abs() > 1e-34 * sum.hi.abs() && k < 80 {
            for j in 1..=step {
                term = term / DoubleDouble::from_f64(f64::from(k + j));
            }
            term = term * square * DoubleDouble::from_f64(sign);
            k += step;
            sum = sum + term;
        }
        sum
    }
}

operators! { [] DoubleDouble:
    Add add |a, b| {
        let (s, e) = two_sum(a.hi, b.hi);
        let (t, f) = two_sum(a.lo, b.lo);
        let first = quick_two_sum(s, e + t);
        quick_two_sum(first.hi, first.lo + f)
    };
    Sub sub |a, b| a + -b;
    Mul mul |a, b| {
        let (p, e) = two_product(a.hi, b.hi);
        quick_two_sum(p, e + (a.hi * b.lo + a.lo * b.hi))
    };
    Div div |a, b| {
        let mut quotient = DoubleDouble::from_f64(a.hi / b.hi);
        if !quotient.hi.is_finite() || quotient.hi == 0.0 {
            return quotient;
        }
        for _ in 0..2 {
            let rest = a - quotient * b;
            quotient = quotient + DoubleDouble::from_f64(rest.hi / b.hi);
        }
        quotient
    };
    Neg neg |a| DoubleDouble { hi: -a.hi, lo: -a.lo };
}

impl Scalar for DoubleDouble {
    fn from_f64(x: f64) -> Self {
        DoubleDouble { hi: x, lo: 0.0 }
    }
    fn select_le(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        if a.less(b) || a == b { then } else { otherwise }
    }
    fn is_zero(self) -> bool {
        self.hi == 0.0
    }
    fn sqrt(self) -> Self {
        let root = self.hi.sqrt();
        if root == 0.0 || !root.is_finite() {
            return DoubleDouble::from_f64(root);
        }
        // Newton's step for x² = self, twice the digits each.
        let mut x = DoubleDouble::from_f64(root);
        for _ in 0..2 {
            x = x + (self - x * x) / DoubleDouble::from_f64(2.0 * root);
        }
        x
    }
    fn sin_cos(self) -> (Self, Self) {
        if !self.hi.is_finite() {
            let nan = DoubleDouble::from_f64(f64::NAN);
            return (nan, nan);
        }
        let turns = (self.hi / QUARTER.hi).round();
        let k = DoubleDouble::from_f64(turns);
        let rest = self - k * QUARTER - DoubleDouble::from_f64(turns * QUARTER_REST);
        let (sin, cos) = (rest.series(1, 2, -1.0), rest.series(0, 2, -1.0));
        match turns.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }
    fn tan(self) -> Self {
        let (sin, cos) = self.sin_cos();
        sin / cos
    }
    fn asin(self) -> Self {
        self.atan2(((ONE - self) * (ONE + self)).sqrt())
    }
    fn acos(self) -> Self {
        ((ONE - self) * (ONE + self)).sqrt().atan2(self)
    }
    fn atan(self) -> Self {
        self.atan2(ONE)
    }
    fn atan2(self, x: Self) -> Self {
        let guess = self.hi.atan2(x.hi);
        let radius = (self * self + x * x).sqrt();
        if radius.hi == 0.0 || !radius.hi.is_finite() {
            return DoubleDouble::from_f64(guess);
        }
        let mut angle = DoubleDouble::from_f64(guess);
        for _ in 0..2 {
            // The angle left is its own sine to the third order.
            let (sin, cos) = angle.sin_cos();
            angle = angle + (self * cos - x * sin) / radius;
        }
        angle
    }
    fn sinh(self) -> Self {
        if self.hi.abs() < 0.5 {
            return self.series(1, 2, 1.0);
        }
        let e = self.exp();
        (e - e.recip()).scale(-1)
    }
    fn cosh(self) -> Self {
        let e = self.exp();
        (e + e.recip()).scale(-1)
    }
    fn tanh(self) -> Self {
        if self.hi.abs() > 40.0 {
            return DoubleDouble::from_f64(self.hi.signum());
        }
        self.sinh() / self.cosh()
    }
    fn asinh(self) -> Self {
        self.solved(self.hi.asinh(), |y| (y.sinh(), y.cosh()))
    }
    fn acosh(self) -> Self {
        (self + (self - ONE).sqrt() * (self + ONE).sqrt()).ln()
    }
    fn atanh(self) -> Self {
        (self / ((ONE - self) * (ONE + self)).sqrt()).asinh()
    }
    fn exp(self) -> Self {
        if self.hi.is_nan() || self.hi.abs() > 709.0 {
            return DoubleDouble::from_f64(self.hi.exp());
        }
        // e^x = 2^k (e^(r/256))^256.
        let k = (self.hi / LN_2.hi).round();
        let r = (self - LN_2 * DoubleDouble::from_f64(k)).scale(-8);
        let mut y = r.series(0, 1, 1.0);
        for _ in 0..8 {
            y = y * y;
        }
        #[allow(clippy::cast_possible_truncation, reason = "below 1100")]
        y.scale(k as i32)
    }
    fn ln(self) -> Self {
        self.solved(self.hi.ln(), |y| [y.exp(); 2].into())
    }
    fn abs(self) -> Self {
        if self.less(ZERO) { -self } else { self }
    }
    fn sign(self) -> Self {
        DoubleDouble::from_f64(self.hi.sign())
    }
    fn hypot(self, o: Self) -> Self {
        (self * self + o * o).sqrt()
    }
    fn powi(self, n: i32) -> Self {
        let (mut base, mut power, mut left) = (self, ONE, n.unsigned_abs());
        while left > 0 {
            if left % 2 == 1 {
                power = power * base;
            }
            base = base * base;
            left /= 2;
        }
        if n < 0 { power.recip() } else { power }
    }
    fn powf(self, y: Self) -> Self {
        if self.hi > 0.0 {
            (y * self.ln()).exp()
        } else {
            // Powers of zero, and of negative numbers: integer exponents and NaN.
            DoubleDouble::from_f64(self.hi.powf(y.hi))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type D = DoubleDouble;

    fn d(x: f64) -> D {
        D::from_f64(x)
    }

    #[track_caller]
    fn same(what: &str, a: D, b: D, bound: f64) {
        let off = (a - b).hi.abs();
        assert!(off <= bound * b.hi.abs().max(1.0), "{what}: {off:e}");
    }

    #[test]
    fn arithmetic_has_thirty_digits() {
        let third = d(1.0) / d(3.0);
        same("1/3", third + third + third, d(1.0), 1e-31);
        same("square of a root", d(2.0).sqrt().powi(2), d(2.0), 1e-31);
        // (10¹⁵ + 1)² − 10³⁰ = 2·10¹⁵ + 1.
        let big = d(1e15) + d(1.0);
        assert_eq!(big * big - d(1e15) * d(1e15), d(2e15) + d(1.0));
        assert_eq!((d(1.0) + d(1e-25) - d(1.0)).to_f64(), 1e-25);
        assert_eq!(d(1.0) / d(0.0), d(f64::INFINITY));
    }

    #[test]
    fn functions_satisfy_their_equations() {
        for x in [-2.7, -0.3, 1e-9, 0.4, 1.9, 7.0] {
            let (x, square) = (d(x) / d(1.7), |y: D| y * y);
            let (sin, cos) = x.sin_cos();
            same("sin² + cos²", square(sin) + square(cos), d(1.0), 1e-30);
            let (twice, _) = (x + x).sin_cos();
            same("sin 2x", twice, d(2.0) * sin * cos, 1e-30);
            let full = d(4.0) * QUARTER;
            same("period", (x + full).sin(), sin, 1e-30);
            same("exp ln", x.exp().ln(), x, 1e-29);
            same("cosh, sinh", x.cosh() - x.sinh(), (-x).exp(), 1e-29);
            same("asinh sinh", x.sinh().asinh(), x, 1e-29);
            same("cosh acosh", x.cosh().acosh().cosh(), x.cosh(), 1e-29);
            same("tanh atanh", x.tanh().atanh().tanh(), x.tanh(), 1e-29);
            same("tan atan", x.atan().tan(), x, 1e-29);
            same("sin asin", sin.asin().sin(), sin, 1e-30);
            same("cos acos", cos.acos().cos(), cos, 1e-30);
            same("powf", x.abs().powf(d(3.0)), x.abs().powi(3), 1e-28);
            assert!((x.tanh().to_f64() - x.to_f64().tanh()).abs() < 1e-15);
        }
    }

    #[test]
    fn constants_are_known_values() {
        let root = D {
            hi: std::f64::consts::SQRT_2,
            lo: -9.667_293_313_452_913e-17,
        };
        same("root of 2", d(2.0).sqrt(), root, 1e-31);
        same("ln 2", d(2.0).ln(), LN_2, 1e-31);
        same("quarter turn", d(1.0).atan2(d(0.0)), QUARTER, 1e-31);
        assert_eq!(d(0.0).atan2(d(1.0)), ZERO);
    }
}
