//! How much rounding an evaluation carries: emitted code run on numbers that add up their errors as they go.

use crate::scalar::tape::player;
use crate::scalar::{Dual, Scalar, functions, operators};

/// States beside one at hand that show what rounding makes of an evaluation there, for whatever it is computed by: each number is off by ε,
/// in directions without a pattern, the same in every run (the low-discrepancy sequence of the golden section).
pub(crate) fn beside(y: &[f64]) -> impl Iterator<Item = Vec<f64>> {
    const STATES: u64 = 6;
    (1..=STATES).map(|k| {
        let step = k.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let signs = (1..).map(|i: u64| 1.0 - 2.0 * (i.wrapping_mul(step) >> 63) as f64);
        let moved = y.iter().zip(signs);
        moved.map(|(y, sign)| y + sign * f64::EPSILON * y).collect()
    })
}

/// A value and the size of its rounding error, in units of ε: that of the inputs, carried on to first order, and one unit of each
/// intermediate result. (A running error analysis: Higham, Accuracy and Stability of Numerical Algorithms, §3.3.)
///
/// It sees what derivatives do not: in φ = (x − a)² − a² at x = 0 the coordinate is exact, but 2a² is rounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rounded {
    value: f64,
    error: f64,
}

impl Rounded {
    /// A number that is given exactly.
    pub(crate) fn exact(value: f64) -> Self {
        Rounded { value, error: 0.0 }
    }

    /// A number that is known to rounding.
    pub(crate) fn unknown(value: f64) -> Self {
        Rounded::within(value, 0.0)
    }

    /// The error, for comparisons: 0 where a function is too steep to tell.
    pub(crate) fn bound(self) -> f64 {
        if self.error.is_finite() {
            self.error
        } else {
            0.0
        }
    }

    /// A number that is known to an error, in units of ε, but not better than to rounding.
    pub(crate) fn within(value: f64, error: f64) -> Self {
        let error = error.max(value.abs());
        Rounded { value, error }
    }

    /// A result: what its operands bring with them, and its own rounding.
    fn result(value: f64, inherited: f64) -> Self {
        Rounded {
            value,
            error: inherited + value.abs(),
        }
    }

    /// f(self) by the derivative of f.
    fn unary(self, f: fn(Dual) -> Dual) -> Self {
        let y = f(Dual::new(self.value, 1.0));
        Rounded::result(y.re, carried(y.eps, self.error))
    }

    /// f(self, o) by the derivatives of f.
    fn binary(self, o: Self, f: impl Fn(Dual, Dual) -> Dual) -> Self {
        let first = f(Dual::new(self.value, 1.0), Dual::new(o.value, 0.0));
        let second = f(Dual::new(self.value, 0.0), Dual::new(o.value, 1.0));
        let inherited = carried(first.eps, self.error) + carried(second.eps, o.error);
        Rounded::result(first.re, inherited)
    }
}

/// The error that a slope passes on; none from an exact number, however steep.
fn carried(slope: f64, error: f64) -> f64 {
    if error == 0.0 {
        0.0
    } else {
        slope.abs() * error
    }
}

operators! { [] Rounded:
    Add add |a, b| Rounded::result(a.value + b.value, a.error + b.error);
    Sub sub |a, b| Rounded::result(a.value - b.value, a.error + b.error);
    Mul mul |a, b| a.binary(b, |a, b| a * b);
    Div div |a, b| a.binary(b, |a, b| a / b);
    Neg neg |a| Rounded { value: -a.value, error: a.error };
}

macro_rules! by_slopes {
    (@unary: $($name:ident)*) => { $(fn $name(self) -> Self { self.unary(Scalar::$name) })* };
    (@binary: $($name:ident)*) => { $(fn $name(self, o: Self) -> Self { self.binary(o, Scalar::$name) })* };
}

impl Scalar for Rounded {
    const TAPED: bool = true;
    player!(play Rounded);
    fn from_f64(x: f64) -> Self {
        Rounded::exact(x)
    }
    fn select_le(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        if a.value <= b.value { then } else { otherwise }
    }
    fn sin_cos(self) -> (Self, Self) {
        (self.unary(Scalar::sin), self.unary(Scalar::cos))
    }
    functions!(by_slopes!());
    by_slopes!(@unary: sqrt exp abs sign);
    by_slopes!(@binary: min max);
    fn powi(self, n: i32) -> Self {
        self.binary(Rounded::exact(0.0), |x, _| x.powi(n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ULP: f64 = f64::EPSILON;

    #[test]
    fn cancellation_leaves_the_error_of_its_terms() {
        let x = Rounded::unknown(0.0);
        let a = Rounded::exact(1.3);
        let phi = (x - a) * (x - a) - a * a;
        // Three products and differences of size a, a² and a², twice the first through the square.
        assert_eq!(phi.value, 0.0);
        let square = 1.3 * 1.3;
        assert!(
            phi.error > 3.9 * square && phi.error < 4.1 * square,
            "{phi:?}"
        );
        let third = Rounded::exact(1.0) / Rounded::exact(3.0);
        let nothing = third + third + third - Rounded::exact(1.0);
        assert!(nothing.value.abs() <= ULP * nothing.error && nothing.error < 4.0);
    }

    #[test]
    fn errors_pass_through_functions_by_their_slopes() {
        let x = Rounded::unknown(2.0);
        for (y, slope) in [
            (x.exp(), 2.0_f64.exp()),
            (x.ln(), 0.5),
            (x.powi(3), 12.0),
            (x.powf(Rounded::exact(1.5)), 1.5 * 2.0_f64.sqrt()),
            (x.sin_cos().1, 2.0_f64.sin()),
            (x.hypot(Rounded::exact(0.0)), 1.0),
        ] {
            let expected = 2.0 * slope + y.value.abs();
            assert!((y.error - expected).abs() < 1e-14 * expected, "{y:?}");
        }
        // √ is steep at 0, but 0 may be exact.
        assert_eq!(Rounded::exact(0.0).sqrt(), Rounded::exact(0.0));
        let steep = (x - x).sqrt();
        assert_eq!((steep.value, steep.bound()), (0.0, 0.0));
    }
}
