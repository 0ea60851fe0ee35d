//! Emitted functions as tapes, for numbers that are computed with too rarely to compile everything for them.
//!
//! To compile a function takes as long as to run it a million times. It is compiled for the numbers of hot loops; numbers that carry
//! several derivatives, or their rounding, read it off a tape, which the compiler of mechanisms writes beside it. The reader is compiled
//! once for each type of number, in this crate.

use super::Scalar;

/// A straight-line function as data: instructions on registers. The inputs are the first registers, the constants follow.
///
/// An instruction is its sign and the places of its result and operands, in words of two bytes, the lower first:
///
/// | sign | places | result |
/// | --- | --- | --- |
/// | `+` `-` `*` `/` | r a b | a + b and so on |
/// | `m` `w` | r a b c | a b + c; c − a b |
/// | `n` `i` | r a | −a; 1/a |
/// | `s` | r s a | sine and cosine of a |
/// | `p` | r a n low, n high | aⁿ |
/// | `f` `g` | r k a (b) | function k of a, or of a and b |
/// | `?` | r a b c d | c where a ≤ b, else d |
/// | `=` | k low, high a | a is element `low, high` of slice k |
/// | `.` | a | a is what the function returns |
#[derive(Debug, Clone, Copy)]
pub struct Tape {
    /// The constants that instructions name.
    pub constants: &'static [f64],
    /// The instructions, one after the other.
    pub code: &'static [u8],
}

/// The functions of one and of two arguments that a tape names.
pub type Functions<'a, S> = (&'a [fn(S) -> S], &'a [fn(S, S) -> S]);

/// A function that [`play`]s in numbers `$S`: not generic, so that the reader is compiled in this crate.
macro_rules! player {
    ($name:ident $S:ty) => {
        fn $name(
            tape: &$crate::scalar::Tape,
            registers: &mut [$S],
            inputs: &[&[$S]],
            functions: $crate::scalar::Functions<'_, $S>,
            slices: &mut [&mut [$S]],
        ) -> $S {
            $crate::scalar::tape::play(tape, registers, inputs, functions, slices)
        }
    };
}
pub(crate) use player;

/// Reads `tape`: the function of `inputs`, into `slices`. Registers hold anything before.
///
/// Plain indices, no iterators: this is fast where builds for tests hardly optimise, too.
pub(crate) fn play<S: Scalar>(
    tape: &Tape,
    registers: &mut [S],
    inputs: &[&[S]],
    (unary, binary): Functions<'_, S>,
    slices: &mut [&mut [S]],
) -> S {
    let mut filled = 0;
    for input in inputs {
        registers[filled..filled + input.len()].copy_from_slice(input);
        filled += input.len();
    }
    for (k, x) in tape.constants.iter().enumerate() {
        registers[filled + k] = S::from_f64(*x);
    }
    let (code, mut at) = (tape.code, 0);
    // The next word, and the register in that place.
    macro_rules! word {
        () => {{
            at += 2;
            code[at - 2] as usize | (code[at - 1] as usize) << 8
        }};
    }
    macro_rules! register {
        () => {
            registers[word!()]
        };
    }
    let mut result = S::from_f64(0.0);
    while at < code.len() {
        let sign = code[at];
        at += 2;
        let first = word!();
        registers[first] = match sign {
            b'+' => register!() + register!(),
            b'-' => register!() - register!(),
            b'*' => register!() * register!(),
            b'/' => register!() / register!(),
            b'm' => register!().mul_add(register!(), register!()),
            b'w' => register!().neg_mul_add(register!(), register!()),
            b'n' => -register!(),
            b'i' => register!().recip(),
            b's' => {
                let second = word!();
                let (sin, cos) = register!().sin_cos();
                registers[second] = cos;
                sin
            }
            b'p' => {
                let (base, low, high) = (register!(), word!(), word!());
                // Both are words of two bytes.
                #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap)]
                base.powi((low | high << 16) as u32 as i32)
            }
            b'f' => unary[word!()](register!()),
            b'g' => binary[word!()](register!(), register!()),
            b'?' => S::select_le(register!(), register!(), register!(), register!()),
            b'=' => {
                let place = word!() | word!() << 16;
                slices[first][place] = register!();
                continue;
            }
            b'.' => {
                result = registers[first];
                continue;
            }
            _ => unreachable!("the compiler of mechanisms wrote the tape"),
        };
    }
    result
}
