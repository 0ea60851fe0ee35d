//! Four and eight lanes of `f64`, by the crate `wide`.
//!
//! Arithmetic, roots and selections are those of `f64` in each lane. Sines, cosines and exponentials are computed for all lanes at once,
//! within two units in the last place of those of `f64`, where that holds; arguments beyond that and the other functions go lane by lane
//! through `f64`.

use super::Lanes;
use crate::scalar::{Scalar, functions};
use wide::{f64x4, f64x8};

/// Largest angle for which sine and cosine are those of `wide`: the reduction by three parts of π/2 keeps all digits of the rest up to
/// here.
const LARGEST_ANGLE: f64 = 1e5;

/// Sines and cosines below this share of the angle are those of `f64`: near multiples of π/2 the rest has an error of some 1e-32 angles.
const SMALLEST_SHARE: f64 = 1e-14;

/// Largest exponent, likewise: results neither overflow nor lose digits to underflow.
const LARGEST_EXPONENT: f64 = 700.0;

macro_rules! lanes {
    ($L:ident, $width:literal) => {
        impl Lanes for $L {
            const WIDTH: usize = $width;
            #[inline]
            fn from_lanes(f: impl FnMut(usize) -> f64) -> Self {
                $L::new(std::array::from_fn(f))
            }
            #[inline]
            fn lane(self, lane: usize) -> f64 {
                self.as_array()[lane]
            }
            #[inline]
            fn set_lane(&mut self, lane: usize, x: f64) {
                self.as_mut_array()[lane] = x;
            }
        }

        impl Scalar for $L {
            #[inline]
            fn from_f64(x: f64) -> Self {
                $L::splat(x)
            }
            #[inline]
            fn select_le(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
                a.simd_le(b).select(then, otherwise)
            }
            #[inline]
            fn mul_add(self, b: Self, c: Self) -> Self {
                if cfg!(target_feature = "fma") {
                    $L::mul_add(self, b, c)
                } else {
                    self * b + c
                }
            }
            #[inline]
            fn neg_mul_add(self, b: Self, c: Self) -> Self {
                if cfg!(target_feature = "fma") {
                    $L::mul_neg_add(self, b, c)
                } else {
                    c - self * b
                }
            }
            lanes!(@own $L: sqrt() abs() min(other) max(other));
            #[inline]
            fn larger(self, other: Self) -> Self {
                $L::fast_max(self, other)
            }
            #[inline]
            fn sign(self) -> Self {
                let zero = $L::splat(0.0);
                let one = $L::splat(1.0);
                // NaN is neither above 0 nor below, and comes through.
                let rest = zero.simd_gt(self).select(-one, self * zero);
                self.simd_gt(zero).select(one, rest)
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                let (mut sin, mut cos) = $L::sin_cos(self);
                let size = self.abs();
                let smaller = $L::min(sin.abs(), cos.abs());
                let near = (size * $L::splat(SMALLEST_SHARE)).simd_gt(smaller);
                let far = !size.simd_le($L::splat(LARGEST_ANGLE)) | near;
                if far.any() {
                    each(far.to_bitmask(), |k| {
                        let (s, c) = self.lane(k).sin_cos();
                        sin.set_lane(k, s);
                        cos.set_lane(k, c);
                    });
                }
                (sin, cos)
            }
            #[inline]
            fn exp(self) -> Self {
                let mut exp = $L::exp(self);
                let far = !self.abs().simd_le($L::splat(LARGEST_EXPONENT));
                if far.any() {
                    each(far.to_bitmask(), |k| exp.set_lane(k, self.lane(k).exp()));
                }
                exp
            }
            #[inline]
            fn powi(self, n: i32) -> Self {
                // As `f64::powi` does.
                let (mut result, mut power) = ($L::splat(1.0), self);
                let mut left = n.unsigned_abs();
                loop {
                    if left & 1 == 1 {
                        result *= power;
                    }
                    left >>= 1;
                    if left == 0 {
                        break;
                    }
                    power *= power;
                }
                if n < 0 { result.recip() } else { result }
            }
            functions!(lanes!($L));
        }
    };
    (@own $L:ident: $($name:ident($($other:ident)?))*) => {
        $(#[inline] fn $name(self $(, $other: Self)?) -> Self { $L::$name(self $(, $other)?) })*
    };
    (@unary $L:ident: $($name:ident)*) => {
        $(#[inline] fn $name(self) -> Self { Self::from_lanes(|k| self.lane(k).$name()) })*
    };
    (@binary $L:ident: $($name:ident)*) => {
        $(#[inline] fn $name(self, other: Self) -> Self {
            Self::from_lanes(|k| self.lane(k).$name(other.lane(k)))
        })*
    };
}
lanes!(f64x4, 4);
lanes!(f64x8, 8);

/// Calls `f` with the number of each lane whose bit is set.
#[cold]
fn each(mut bits: u32, mut f: impl FnMut(usize)) {
    while bits != 0 {
        f(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units in the last place between two numbers; 0 for two NaN.
    fn apart(a: f64, b: f64) -> u64 {
        let order = |x: f64| {
            let bits = x.to_bits() as i64;
            if bits < 0 { i64::MIN - bits } else { bits }
        };
        match (a.is_nan(), b.is_nan()) {
            (true, true) => 0,
            (false, false) => order(a).abs_diff(order(b)),
            _ => u64::MAX,
        }
    }

    /// Numbers of all sizes, special ones, and neighbours of multiples of π/4.
    fn arguments() -> Vec<f64> {
        let mut all = vec![
            0.0,
            -0.0,
            1.0,
            -1.0,
            0.5,
            -0.5,
            2.0,
            1e-320,
            -1e-320,
            f64::MIN_POSITIVE,
            f64::MAX,
            f64::MIN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
        ];
        let mut bits = 1_u64;
        for k in 0..20_000 {
            bits = bits
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let part = (bits >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            all.push(part * 10_f64.powi(k % 40 - 15));
            all.push(part * 20.0);
            all.push(1.0 + 0.1 * part);
        }
        for k in 0..1000 {
            let angle = std::f64::consts::FRAC_PI_4 * f64::from(k * k);
            all.extend([angle, -angle, angle.next_up(), angle.next_down()]);
        }
        while !all.len().is_multiple_of(8) {
            all.push(0.25);
        }
        all
    }

    fn check<L: Lanes>() {
        let all = arguments();
        let compare =
            |name: &str, bound: u64, x: &[f64], found: L, expected: &dyn Fn(f64) -> f64| {
                for (k, x) in x.iter().enumerate() {
                    let (found, expected) = (found.lane(k), expected(*x));
                    let off = apart(found, expected);
                    assert!(
                        off <= bound,
                        "{name}({x:e}): {found:e} is not {expected:e}, {off} off"
                    );
                }
            };
        for x in all.chunks_exact(L::WIDTH) {
            let lanes = L::from_lanes(|k| x[k]);
            macro_rules! unary {
                ($bound:literal: $($name:ident)*) => {
                    $(compare(stringify!($name), $bound, x, lanes.$name(), &|x| Scalar::$name(x));)*
                };
            }
            unary!(0: sqrt abs sign recip tan asin acos atan sinh cosh tanh asinh acosh atanh ln);
            unary!(2: sin cos exp);
            for n in [0, 1, 2, 3, 7, -1, -2, -5] {
                compare("powi", 0, x, lanes.powi(n), &|x| Scalar::powi(x, n));
            }
            for y in [0.0, 0.75, -3.0, f64::NAN] {
                let other = L::from_f64(y);
                macro_rules! binary {
                    ($($name:ident)*) => {
                        $(compare(stringify!($name), 0, x, lanes.$name(other), &|x| Scalar::$name(x, y));)*
                    };
                }
                binary!(atan2 hypot powf);
                if y != 0.0 {
                    binary!(min max);
                }
                compare("mul_add", 0, x, lanes.mul_add(other, lanes), &|x| {
                    Scalar::mul_add(x, y, x)
                });
                compare("neg_mul_add", 0, x, lanes.neg_mul_add(other, lanes), &|x| {
                    Scalar::neg_mul_add(x, y, x)
                });
                let selected = L::select_le(lanes, other, lanes, L::from_f64(2.0));
                compare("select_le", 0, x, selected, &|x| {
                    f64::select_le(x, y, x, 2.0)
                });
                compare("+", 0, x, lanes + other, &|x| x + y);
                compare("-", 0, x, lanes - other, &|x| x - y);
                compare("*", 0, x, lanes * other, &|x| x * y);
                compare("/", 0, x, lanes / other, &|x| x / y);
                compare("-x", 0, x, -lanes, &|x| -x);
            }
        }
        let mut x = L::from_f64(1.5);
        x.set_lane(L::WIDTH - 1, 2.5);
        assert_eq!((x.lane(0), x.lane(L::WIDTH - 1)), (1.5, 2.5));
    }

    #[test]
    fn four_lanes_are_those_of_f64() {
        check::<f64x4>();
    }

    #[test]
    fn eight_lanes_are_those_of_f64() {
        check::<f64x8>();
    }
}
