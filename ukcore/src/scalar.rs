//! The numbers that emitted code computes with.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

mod double;
mod slopes;
pub(crate) mod tape;

pub use double::DoubleDouble;
pub use slopes::{Slope, Sloped, Slopes};
pub use tape::{Functions, Tape};

/// A number type for emitted code: `f64`, `f32`, [`Dual`] for exact derivatives, lanes of several numbers.
///
/// One straight-line program serves them all; constants enter through [`Scalar::from_f64`], branches through [`Scalar::select_le`].
pub trait Scalar:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// Whether emitted functions that have a [`Tape`] are read off it in these numbers, rather than compiled for them.
    const TAPED: bool = false;
    /// Reads an emitted function off its tape, in registers that hold anything before.
    #[doc(hidden)]
    fn play(
        tape: &Tape,
        registers: &mut [Self],
        inputs: &[&[Self]],
        functions: Functions<'_, Self>,
        slices: &mut [&mut [Self]],
    ) -> Self {
        tape::play(tape, registers, inputs, functions, slices)
    }
    /// The constant `x`.
    fn from_f64(x: f64) -> Self;
    /// `then` where `a ≤ b`, else `otherwise` (also where a or b is NaN).
    fn select_le(a: Self, b: Self, then: Self, otherwise: Self) -> Self;
    /// What decides a branch: `self` where `held` is 0, the sign of `held` where that is ±1, and 0 where it is 2.
    #[inline]
    fn branch(self, held: Self) -> Self {
        let [zero, two] = [0.0, 2.0].map(Self::from_f64);
        let size = held.abs();
        Self::select_le(size, zero, self, held * (two - size))
    }
    /// self · b + c; rounded once where the target has an instruction for it, never by a library call.
    #[inline]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    /// c − self · b, rounded like [`Scalar::mul_add`].
    #[inline]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }
    /// The larger one, by the fastest instruction there is. If one is NaN, it is open which of the two it gives; `f64` gives `other`.
    #[inline]
    fn larger(self, other: Self) -> Self {
        Self::select_le(self, other, other, self)
    }
    /// Whether the value is 0, in all lanes: emitted code then leaves early. Never doing so is right, too.
    #[inline]
    fn is_zero(self) -> bool {
        false
    }
    /// 1/x.
    #[inline]
    fn recip(self) -> Self {
        Self::from_f64(1.0) / self
    }
    /// Square root.
    fn sqrt(self) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Sine.
    #[inline]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine.
    #[inline]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Tangent.
    fn tan(self) -> Self;
    /// Arc sine.
    fn asin(self) -> Self;
    /// Arc cosine.
    fn acos(self) -> Self;
    /// Arc tangent.
    fn atan(self) -> Self;
    /// Angle of the point (x, y) with `self` = y.
    fn atan2(self, x: Self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Inverse of the hyperbolic sine.
    fn asinh(self) -> Self;
    /// Inverse of the hyperbolic cosine, at least 0; NaN below 1.
    fn acosh(self) -> Self;
    /// Inverse of the hyperbolic tangent.
    fn atanh(self) -> Self;
    /// eˣ.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// −1, 0 or 1; NaN for NaN (unlike `f64::signum`, sign(0) = 0).
    fn sign(self) -> Self;
    /// The smaller one.
    fn min(self, other: Self) -> Self {
        Self::select_le(self, other, self, other)
    }
    /// The larger one.
    fn max(self, other: Self) -> Self {
        Self::select_le(self, other, other, self)
    }
    /// √(x² + y²).
    fn hypot(self, other: Self) -> Self;
    /// xⁿ for an integer n.
    fn powi(self, n: i32) -> Self;
    /// xʸ.
    fn powf(self, y: Self) -> Self;
}

/// Hands the functions that every number type takes from `f64`, or from a rule for any function, to the macro `$to`; with `rising`, those
/// that grow with their argument alone.
macro_rules! functions {
    (rising $to:ident!($($arguments:tt)*)) => {
        $to!(@unary $($arguments)*: asin atan sinh tanh asinh acosh atanh ln);
    };
    ($to:ident!($($arguments:tt)*)) => {
        $crate::scalar::functions!(rising $to!($($arguments)*));
        $to!(@unary $($arguments)*: tan acos cosh);
        $to!(@binary $($arguments)*: atan2 hypot powf);
    };
}
pub(crate) use functions;

/// Makes the operators of a number type, with its generic parameters, from functions of their operands.
macro_rules! operators {
    (
        @one [$($generic:tt)*] $S:ty, $Operator:ident $name:ident
        |$a:ident $(, $b:ident)?| $result:expr
    ) => {
        impl<$($generic)*> std::ops::$Operator for $S {
            type Output = Self;
            #[inline]
            fn $name(self $(, $b: Self)?) -> Self {
                let $a = self;
                $result
            }
        }
    };
    (
        $generics:tt $S:ty:
        $($Operator:ident $name:ident |$a:ident $(, $b:ident)?| $result:expr;)*
    ) => {
        $(operators!(@one $generics $S, $Operator $name |$a $(, $b)?| $result);)*
    };
}
pub(crate) use operators;

macro_rules! float {
    ($f:ident) => {
        impl Scalar for $f {
            #[inline]
            #[allow(clippy::cast_possible_truncation, reason = "f32 takes the nearest value")]
            fn from_f64(x: f64) -> Self {
                x as $f
            }
            #[inline]
            fn select_le(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
                if a <= b { then } else { otherwise }
            }
            #[inline]
            fn larger(self, other: Self) -> Self {
                if self > other { self } else { other }
            }
            #[inline]
            fn is_zero(self) -> bool {
                self == 0.0
            }
            #[inline]
            fn mul_add(self, b: Self, c: Self) -> Self {
                if cfg!(target_feature = "fma") {
                    $f::mul_add(self, b, c)
                } else {
                    self * b + c
                }
            }
            #[inline]
            fn neg_mul_add(self, b: Self, c: Self) -> Self {
                if cfg!(target_feature = "fma") {
                    $f::mul_add(-self, b, c)
                } else {
                    c - self * b
                }
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                $f::sin_cos(self)
            }
            #[inline]
            fn sign(self) -> Self {
                if self == 0.0 { 0.0 } else { $f::signum(self) }
            }
            functions!(float!($f));
            float!(@unary $f: sqrt sin cos exp abs recip);
            float!(@binary $f: min max);
            #[inline]
            fn powi(self, n: i32) -> Self {
                $f::powi(self, n)
            }
        }
    };
    (@unary $f:ident: $($name:ident)*) => {
        $(#[inline] fn $name(self) -> Self { $f::$name(self) })*
    };
    (@binary $f:ident: $($name:ident)*) => {
        $(#[inline] fn $name(self, other: Self) -> Self { $f::$name(self, other) })*
    };
}
float!(f64);
float!(f32);

/// A value with a derivative, or with [several](Slopes): forward-mode differentiation through emitted code.
///
/// Where a function has no derivative (abs at 0, min at a tie) one of its one-sided ones, or 0, is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<S = f64, E = S> {
    /// The value itself.
    pub re: S,
    /// The derivative of the value.
    pub eps: E,
}

impl<S, E> Dual<S, E> {
    /// The number with this value and this derivative.
    pub const fn new(re: S, eps: E) -> Self {
        Dual { re, eps }
    }
}

impl<S: Scalar, E: Slope<S>> Dual<S, E> {
    /// The value `self.re` → `re`, by the chain rule with the outer derivative `slope`.
    #[inline]
    fn chain(self, re: S, slope: S) -> Self {
        Dual::new(re, self.eps * slope)
    }
}

operators! { [S: Scalar, E: Slope<S>] Dual<S, E>:
    Add add |a, b| Dual::new(a.re + b.re, a.eps + b.eps);
    Sub sub |a, b| Dual::new(a.re - b.re, a.eps - b.eps);
    Mul mul |a, b| Dual::new(a.re * b.re, a.eps * b.re + b.eps * a.re);
    Div div |a, b| {
        let re = a.re / b.re;
        Dual::new(re, (a.eps - b.eps * re) / b.re)
    };
    Neg neg |a| Dual::new(-a.re, -a.eps);
}

impl<S: Scalar, E: Slope<S>> Scalar for Dual<S, E> {
    const TAPED: bool = E::READ;
    fn play(
        tape: &Tape,
        registers: &mut [Self],
        inputs: &[&[Self]],
        functions: Functions<'_, Self>,
        slices: &mut [&mut [Self]],
    ) -> Self {
        E::read(tape, registers, inputs, functions, slices)
    }
    fn from_f64(x: f64) -> Self {
        Dual::new(S::from_f64(x), E::zero())
    }
    fn select_le(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        Dual::new(
            S::select_le(a.re, b.re, then.re, otherwise.re),
            E::chosen_le(a.re, b.re, then.eps, otherwise.eps),
        )
    }
    fn sqrt(self) -> Self {
        let r = self.re.sqrt();
        self.chain(r, (r + r).recip())
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.re.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
    fn tan(self) -> Self {
        let r = self.re.tan();
        self.chain(r, S::from_f64(1.0) + r * r)
    }
    fn asin(self) -> Self {
        let root = (S::from_f64(1.0) - self.re * self.re).sqrt();
        self.chain(self.re.asin(), root.recip())
    }
    fn acos(self) -> Self {
        let root = (S::from_f64(1.0) - self.re * self.re).sqrt();
        self.chain(self.re.acos(), -root.recip())
    }
    fn atan(self) -> Self {
        let slope = (S::from_f64(1.0) + self.re * self.re).recip();
        self.chain(self.re.atan(), slope)
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.re * self.re + x.re * x.re;
        Dual::new(
            self.re.atan2(x.re),
            (self.eps * x.re - x.eps * self.re) / square,
        )
    }
    fn sinh(self) -> Self {
        self.chain(self.re.sinh(), self.re.cosh())
    }
    fn cosh(self) -> Self {
        self.chain(self.re.cosh(), self.re.sinh())
    }
    fn tanh(self) -> Self {
        let r = self.re.tanh();
        self.chain(r, S::from_f64(1.0) - r * r)
    }
    fn asinh(self) -> Self {
        let root = (self.re * self.re + S::from_f64(1.0)).sqrt();
        self.chain(self.re.asinh(), root.recip())
    }
    fn acosh(self) -> Self {
        let root = (self.re * self.re - S::from_f64(1.0)).sqrt();
        self.chain(self.re.acosh(), root.recip())
    }
    fn atanh(self) -> Self {
        let slope = (S::from_f64(1.0) - self.re * self.re).recip();
        self.chain(self.re.atanh(), slope)
    }
    fn exp(self) -> Self {
        let r = self.re.exp();
        self.chain(r, r)
    }
    fn ln(self) -> Self {
        self.chain(self.re.ln(), self.re.recip())
    }
    fn abs(self) -> Self {
        self.chain(self.re.abs(), self.re.sign())
    }
    fn sign(self) -> Self {
        self.chain(self.re.sign(), S::from_f64(0.0))
    }
    fn hypot(self, o: Self) -> Self {
        let r = self.re.hypot(o.re);
        Dual::new(r, (self.eps * self.re + o.eps * o.re) / r)
    }
    fn powi(self, n: i32) -> Self {
        let slope = match n {
            0 => S::from_f64(0.0),
            i32::MIN => S::from_f64(f64::from(n)) * (self.re.powi(n) / self.re),
            _ => S::from_f64(f64::from(n)) * self.re.powi(n - 1),
        };
        self.chain(self.re.powi(n), slope)
    }
    fn powf(self, y: Self) -> Self {
        let r = self.re.powf(y.re);
        let base = self.eps * (y.re * self.re.powf(y.re - S::from_f64(1.0)));
        // ln x only counts where the exponent varies, so a negative base with a fixed exponent stays finite.
        Dual::new(r, base + y.eps.where_any(r * self.re.ln()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type D = Dual<f64>;

    /// Derivative of `f` at x against a fourth-order central difference.
    fn check(name: &str, x: f64, dual: fn(D) -> D, plain: fn(f64) -> f64) {
        let result = dual(Dual::new(x, 1.0));
        assert!(
            (result.re - plain(x)).abs() <= 1e-14 * plain(x).abs().max(1.0),
            "{name}({x})"
        );
        let h = 1e-3 * x.abs().max(0.1);
        let difference = (8.0 * (plain(x + h) - plain(x - h))
            - (plain(x + 2.0 * h) - plain(x - 2.0 * h)))
            / (12.0 * h);
        let size = difference.abs().max(1.0);
        assert!(
            (result.eps - difference).abs() < 1e-8 * size,
            "{name}'({x}): {} is not {difference}",
            result.eps
        );
    }

    #[test]
    fn derivatives_agree_with_differences() {
        macro_rules! unary {
            ($points:expr; $($name:ident)*) => {
                $(for x in $points { check(stringify!($name), x, |x| Scalar::$name(x), |x| Scalar::$name(x)); })*
            };
        }
        unary!([-0.7, 0.3, 0.85]; sin cos tan asin acos atan sinh cosh tanh asinh atanh exp abs sign recip);
        unary!([0.2, 1.0, 30.0]; sqrt ln);
        unary!([1.7, 3.0, 30.0]; acosh);
        for x in [-2.0, -0.4, 0.9, 3.0] {
            check("powi 3", x, |x| x.powi(3), |x| Scalar::powi(x, 3));
            check("powi -2", x, |x| x.powi(-2), |x| Scalar::powi(x, -2));
            check("powi 0", x, |x| x.powi(0), |x| Scalar::powi(x, 0));
            check(
                "atan2 y",
                x,
                |x| x.atan2(D::from_f64(-0.8)),
                |x| x.atan2(-0.8),
            );
            check(
                "atan2 x",
                x,
                |x| D::from_f64(0.6).atan2(x),
                |x| 0.6_f64.atan2(x),
            );
            check("hypot", x, |x| x.hypot(D::from_f64(2.0)), |x| x.hypot(2.0));
            check("min", x, |x| x.min(D::from_f64(0.5)), |x| x.min(0.5));
            check("max", x, |x| D::from_f64(0.5).max(x), |x| x.max(0.5));
            check("sin_cos", x, |x| x.sin_cos().0 / x.sin_cos().1, f64::tan);
            check(
                "arithmetic",
                x,
                |x| (x * x - x) / (x * x + D::from_f64(1.0)),
                |x| (x * x - x) / (x * x + 1.0),
            );
        }
        for x in [0.3, 2.0] {
            check(
                "powf base",
                x,
                |x| x.powf(D::from_f64(2.5)),
                |x| x.powf(2.5),
            );
            check(
                "powf exponent",
                x,
                |x| D::from_f64(1.7).powf(x),
                |x| 1.7_f64.powf(x),
            );
        }
    }

    #[test]
    fn nested_duals_give_second_derivatives() {
        let x = 0.7;
        let twice = Dual::new(Dual::new(x, 1.0), Dual::new(1.0, 0.0));
        let y = (twice.sin() * twice).exp();
        let u = x.sin() * x;
        let (du, ddu) = (x.cos() * x + x.sin(), 2.0 * x.cos() - x.sin() * x);
        assert!((y.eps.eps - u.exp() * (du * du + ddu)).abs() < 1e-14);
    }

    #[test]
    fn where_there_is_no_derivative_values_stay_finite() {
        let zero = Dual::new(0.0, 1.0);
        assert_eq!((zero.abs().eps, zero.sign()), (0.0, Dual::new(0.0, 0.0)));
        let negative = Dual::new(-2.0, 1.0).powf(D::from_f64(2.0));
        assert_eq!(negative, Dual::new(4.0, -4.0));
        assert!(Scalar::sign(f64::NAN).is_nan());
        assert_eq!(Scalar::sign(-3.0_f32), -1.0);
        assert_eq!(f64::select_le(f64::NAN, 0.0, 1.0, 2.0), 2.0);
    }
}
