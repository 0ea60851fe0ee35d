//! Derivatives of a value: one, or several at once.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::tape::{Functions, Tape, play, player};
use super::{Dual, Scalar, operators};

/// The derivative of a value in numbers `S`, as a [`Dual`] carries it: a number, along one direction, or [`Slopes`] along several.
pub trait Slope<S>:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<S, Output = Self>
    + Div<S, Output = Self>
    + 'static
{
    /// [`Scalar::TAPED`] of the numbers that carry it.
    const READ: bool = false;
    /// [`Scalar::play`] of the numbers that carry it.
    #[doc(hidden)]
    fn read(
        tape: &Tape,
        registers: &mut [Dual<S, Self>],
        inputs: &[&[Dual<S, Self>]],
        functions: Functions<'_, Dual<S, Self>>,
        slices: &mut [&mut [Dual<S, Self>]],
    ) -> Dual<S, Self>
    where
        S: Scalar,
    {
        play(tape, registers, inputs, functions, slices)
    }
    /// The derivative of a constant.
    fn zero() -> Self;
    /// [`Scalar::select_le`] of derivatives.
    fn chosen_le(a: S, b: S, then: Self, otherwise: Self) -> Self;
    /// The derivative times `slope`; 0 along directions in which it is 0, whatever the slope is.
    #[must_use]
    fn where_any(self, slope: S) -> Self;
}

impl<S: Scalar> Slope<S> for S {
    const READ: bool = S::TAPED;
    fn zero() -> Self {
        S::from_f64(0.0)
    }
    fn chosen_le(a: S, b: S, then: Self, otherwise: Self) -> Self {
        S::select_le(a, b, then, otherwise)
    }
    fn where_any(self, slope: S) -> Self {
        let zero = S::from_f64(0.0);
        S::select_le(self.abs(), zero, zero, slope * self)
    }
}

/// A number with derivatives along several directions.
pub type Sloped = Dual<f64, Slopes>;

/// Derivatives along [`Slopes::COUNT`] directions. Emitted functions are read off their tapes in numbers that carry them, so reading an
/// instruction serves all directions, and none of it is compiled for each mechanism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slopes([f64; Slopes::COUNT]);

impl Slopes {
    /// The number of directions.
    pub const COUNT: usize = 8;

    /// The derivatives that `along` gives for each direction.
    #[must_use]
    pub fn new(along: impl Fn(usize) -> f64) -> Self {
        Slopes(std::array::from_fn(along))
    }

    /// The derivatives of variable `own` along the variables from `first` on: 1 along itself, else 0.
    pub(crate) fn unit(own: usize, first: usize) -> Self {
        Slopes::new(|k| f64::from(u8::from(own == first + k)))
    }

    /// The derivative along a direction, counted from 0.
    ///
    /// # Panics
    /// If there are not so many.
    #[must_use]
    pub fn along(&self, direction: usize) -> f64 {
        self.0[direction]
    }

    #[inline]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Slopes(self.0.map(f))
    }
}

operators! { [] Slopes:
    Add add |a, b| Slopes(std::array::from_fn(|k| a.0[k] + b.0[k]));
    Sub sub |a, b| Slopes(std::array::from_fn(|k| a.0[k] - b.0[k]));
    Neg neg |a| a.map(|slope| -slope);
}

macro_rules! by_number {
    ($($name:ident $function:ident: $operator:tt;)*) => {
        $(impl $name<f64> for Slopes {
            type Output = Self;
            #[inline]
            fn $function(self, x: f64) -> Self {
                self.map(|slope| slope $operator x)
            }
        })*
    };
}
by_number!(Mul mul: *; Div div: /;);

impl Slope<f64> for Slopes {
    const READ: bool = true;
    player!(read Sloped);
    fn zero() -> Self {
        Slopes([0.0; Slopes::COUNT])
    }
    #[inline]
    fn chosen_le(a: f64, b: f64, then: Self, otherwise: Self) -> Self {
        if a <= b { then } else { otherwise }
    }
    fn where_any(self, slope: f64) -> Self {
        self.map(|own| if own == 0.0 { 0.0 } else { slope * own })
    }
}
