//! Where the values of a function lie while its arguments vary: emitted code run on intervals.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::scalar::tape::player;
use crate::scalar::{Dual, Scalar, functions, operators};

/// All numbers between two: a result holds every value that the function takes where its arguments are in theirs (Moore 1966, Interval
/// Analysis). Bounds are rounded to nearest rather than outward, so they hold to rounding. [`ALL`] where a function has no value, or jumps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    low: f64,
    high: f64,
}

/// A value and its derivative along a way, while the place on it varies.
pub(crate) type Along = Dual<Interval>;

/// Every number.
const ALL: Interval = Interval {
    low: f64::NEG_INFINITY,
    high: f64::INFINITY,
};

impl Interval {
    /// The number `x` alone.
    pub(crate) const fn exact(x: f64) -> Self {
        Interval { low: x, high: x }
    }

    /// All numbers that differ from `x` by at most `radius`.
    pub(crate) fn around(x: f64, radius: f64) -> Self {
        Interval::between(x - radius, x + radius)
    }

    /// The numbers between two, which may be infinite; all, where one is no number.
    pub(crate) fn between(low: f64, high: f64) -> Self {
        if low <= high {
            Interval { low, high }
        } else {
            ALL
        }
    }

    /// The numbers from the least to the largest of some; all, where one is no number.
    pub(crate) fn over<const N: usize>(numbers: [f64; N]) -> Self {
        let exact = numbers.map(Interval::exact);
        exact.into_iter().reduce(Interval::hull).unwrap_or(ALL)
    }

    /// The least of its numbers, and the largest.
    pub(crate) fn ends(self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// Half of its length.
    pub(crate) fn radius(self) -> f64 {
        0.5 * (self.high - self.low)
    }

    /// The middle; NaN of what is infinite on both sides.
    pub(crate) fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    fn has(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    fn hull(self, o: Self) -> Self {
        Interval::between(self.low.min(o.low), self.high.max(o.high))
    }

    fn times(self, o: Self) -> Self {
        let [a, b] = [self.low, self.high].map(|x| [product(x, o.low), product(x, o.high)]);
        let hull = |[x, y]: [f64; 2]| Interval::between(x.min(y), x.max(y));
        hull(a).hull(hull(b))
    }

    /// The values of a function that rises.
    fn rising(self, f: fn(f64) -> f64) -> Self {
        Interval::between(f(self.low), f(self.high))
    }

    /// The sine of angles.
    fn sine(self) -> Self {
        if self.high - self.low >= TAU || !self.middle().is_finite() {
            return Interval::between(-1.0, 1.0);
        }
        // Whether it holds `crest` and any number of whole turns.
        let passes = |crest: f64| crest + TAU * ((self.low - crest) / TAU).ceil() <= self.high;
        let (a, b) = (self.low.sin(), self.high.sin());
        let low = if passes(-FRAC_PI_2) { -1.0 } else { a.min(b) };
        let high = if passes(FRAC_PI_2) { 1.0 } else { a.max(b) };
        Interval { low, high }
    }
}

/// a b, where nothing of anything is nothing.
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

operators! { [] Interval:
    Add add |a, b| Interval::between(a.low + b.low, a.high + b.high);
    Sub sub |a, b| a + -b;
    Mul mul |a, b| a.times(b);
    Div div |a, b| match b.has(0.0) {
        true => ALL,
        false => a.times(Interval::between(b.high.recip(), b.low.recip())),
    };
    Neg neg |a| Interval { low: -a.high, high: -a.low };
}

macro_rules! rising {
    (@unary: $($name:ident)*) => { $(fn $name(self) -> Self { self.rising(f64::$name) })* };
}

impl Scalar for Interval {
    const TAPED: bool = true;
    player!(play Interval);
    fn from_f64(x: f64) -> Self {
        Interval::between(x, x)
    }
    fn select_le(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        match (a.high <= b.low, a.low > b.high) {
            (true, _) => then,
            (_, true) => otherwise,
            _ => then.hull(otherwise),
        }
    }
    functions!(rising rising!());
    rising!(@unary: sqrt exp);
    fn sin_cos(self) -> (Self, Self) {
        (self.sine(), (self + Interval::exact(FRAC_PI_2)).sine())
    }
    fn tan(self) -> Self {
        let pole = PI * ((self.low - FRAC_PI_2) / PI).ceil() + FRAC_PI_2;
        if pole <= self.high {
            return ALL;
        }
        self.rising(f64::tan)
    }
    fn acos(self) -> Self {
        Interval::exact(FRAC_PI_2) - self.asin()
    }
    fn cosh(self) -> Self {
        self.abs().rising(f64::cosh)
    }
    /// The angles of points; all of them where y changes its sign and x is negative, as the angle jumps there.
    fn atan2(self, x: Self) -> Self {
        if self.has(0.0) && x.low <= 0.0 {
            return ALL;
        }
        let corner = |y: f64, x: f64| Interval::exact(y.atan2(x));
        let [a, b] = [self.low, self.high].map(|y| corner(y, x.low).hull(corner(y, x.high)));
        a.hull(b)
    }
    fn abs(self) -> Self {
        let (a, b) = (self.low.abs(), self.high.abs());
        let least = if self.has(0.0) { 0.0 } else { a.min(b) };
        Interval::between(least, a.max(b))
    }
    fn sign(self) -> Self {
        let (a, b) = (Scalar::sign(self.low), Scalar::sign(self.high));
        if a == b { Interval::exact(a) } else { ALL }
    }
    fn min(self, o: Self) -> Self {
        Interval::between(self.low.min(o.low), self.high.min(o.high))
    }
    fn max(self, o: Self) -> Self {
        Interval::between(self.low.max(o.low), self.high.max(o.high))
    }
    fn hypot(self, o: Self) -> Self {
        let (a, b) = (self.abs(), o.abs());
        Interval::between(a.low.hypot(b.low), a.high.hypot(b.high))
    }
    fn powi(self, n: i32) -> Self {
        let x = if n % 2 == 0 { self.abs() } else { self };
        let power = |x: f64| x.powi(n.saturating_abs());
        let power = Interval::between(power(x.low), power(x.high));
        if n < 0 { power.recip() } else { power }
    }
    fn powf(self, y: Self) -> Self {
        (y * self.ln()).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    type Function = (fn(f64, f64) -> f64, fn(Interval, Interval) -> Interval);

    macro_rules! both {
        ($(|$x:ident, $y:ident| $value:expr;)*) => {
            [$((|$x: f64, $y: f64| $value, |$x: Interval, $y: Interval| $value)),*]
        };
    }

    /// Every function of the language, and sums and products of some.
    const FUNCTIONS: [Function; 33] = both! {
        |x, y| x + y;
        |x, y| x - y;
        |x, y| x * y;
        |x, y| x / y;
        |x, _y| -x;
        |x, _y| Scalar::recip(x);
        |x, y| Scalar::mul_add(x, y, x);
        |x, y| Scalar::neg_mul_add(x, y, x);
        |x, _y| Scalar::sqrt(x);
        |x, _y| Scalar::sin(x);
        |x, _y| Scalar::cos(x);
        |x, _y| Scalar::tan(x);
        |x, _y| Scalar::asin(x);
        |x, _y| Scalar::acos(x);
        |x, _y| Scalar::atan(x);
        |x, y| Scalar::atan2(x, y);
        |x, _y| Scalar::sinh(x);
        |x, _y| Scalar::cosh(x);
        |x, _y| Scalar::tanh(x);
        |x, _y| Scalar::asinh(x);
        |x, _y| Scalar::acosh(x);
        |x, _y| Scalar::atanh(x);
        |x, _y| Scalar::exp(x);
        |x, _y| Scalar::ln(x);
        |x, _y| Scalar::abs(x);
        |x, _y| Scalar::sign(x);
        |x, y| Scalar::min(x, y);
        |x, y| Scalar::max(x, y);
        |x, y| Scalar::hypot(x, y);
        |x, _y| Scalar::powi(x, 3);
        |x, _y| Scalar::powi(x, -2);
        |x, y| Scalar::powf(x, y);
        |x, y| Scalar::select_le(x, y, Scalar::sin(x), Scalar::sin(x) * y);
    };

    /// Whether values at points of intervals of every length are in the interval that they are said to be in.
    #[test]
    fn values_lie_within() {
        let mut random = Random::new(1);
        let mut narrow = [0; FUNCTIONS.len()];
        for _ in 0..3000 {
            let mut interval = || {
                let (middle, radius) = (
                    4.0 * random.signed(),
                    10_f64.powf(2.0 * random.signed() - 1.5),
                );
                (Interval::around(middle, radius), middle, radius)
            };
            let (x, y) = (interval(), interval());
            for (k, (value, bound)) in FUNCTIONS.iter().enumerate() {
                let within = bound(x.0, y.0);
                assert!(within.low <= within.high, "{k} {x:?} {y:?} {within:?}");
                narrow[k] += usize::from(within != ALL);
                for _ in 0..6 {
                    let at = [x, y].map(|(_, middle, radius)| middle + radius * random.signed());
                    let z = value(at[0], at[1]);
                    let slack = 1e-12 * z.abs().max(1.0);
                    assert!(
                        z.is_nan() || within.low - slack <= z && z <= within.high + slack,
                        "{k} of {x:?} {y:?}: {z} at {at:?} is not in {within:?}"
                    );
                }
            }
        }
        assert!(narrow.iter().all(|n| *n > 100), "{narrow:?}");
    }

    #[test]
    fn bounds_are_those_of_the_values() {
        let x = Interval::between(-1.0, 2.0);
        assert_eq!(x.powi(2), Interval::between(0.0, 4.0));
        assert_eq!(x.powi(3), Interval::between(-1.0, 8.0));
        assert_eq!(x.abs(), Interval::between(0.0, 2.0));
        assert_eq!(x.recip(), ALL);
        assert_eq!(x.sign(), ALL);
        assert_eq!(Interval::exact(0.0) * ALL, Interval::exact(0.0));
        let (sine, cosine) = Interval::between(1.0, 4.0).sin_cos();
        assert_eq!((sine.high, cosine.low), (1.0, -1.0));
        assert_eq!(sine.low, 4_f64.sin());
        assert!((cosine.high - 1_f64.cos()).abs() < 1e-15);
        assert_eq!(ALL.sin_cos().0, Interval::between(-1.0, 1.0));
        let jump = Interval::around(0.0, 0.1).atan2(Interval::around(-1.0, 0.1));
        assert_eq!(jump, ALL);
        assert_eq!(Interval::between(-1.0, 1.0).sqrt(), ALL);
    }
}
