//! Emitted functions as tapes, for numbers that are computed with too rarely to compile everything for them.
//!
//! To compile a function takes as long as to run it a million times. It is compiled for the numbers of hot loops; numbers that carry several
//! derivatives, or their rounding, read it off a tape, which the compiler of mechanisms writes beside it. The reader is compiled once for each
//! type of number, in this crate.

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
    /// The constants.
    pub constants: &'static [f64],
    /// The instructions.
    pub code: &'static [u8],
}

/// The functions of one and of two arguments that a tape names.
pub type Functions<'a, S> = (&'a [fn(S) -> S], &'a [fn(S, S) -> S]);

/// Reads `tape`: the function of `inputs`, into `slices`. Registers hold anything before.
pub(crate) fn play<S: Scalar>(
    tape: &Tape,
    registers: &mut [S],
    inputs: &[&[S]],
    (unary, binary): Functions<'_, S>,
    slices: &mut [&mut [S]],
) -> S {
    let given = inputs.iter().flat_map(|input| input.iter().copied());
    let given = given.chain(tape.constants.iter().map(|c| S::from_f64(*c)));
    registers.iter_mut().zip(given).for_each(|(r, x)| *r = x);
    let mut result = S::from_f64(0.0);
    let mut words = tape
        .code
        .chunks_exact(2)
        .map(|w| u16::from_le_bytes([w[0], w[1]]));
    while let Some(sign) = words.next() {
        let mut word = || usize::from(words.next().unwrap_or_default());
        let first = word();
        let x = match u8::try_from(sign).unwrap_or_default() {
            b'+' => registers[word()] + registers[word()],
            b'-' => registers[word()] - registers[word()],
            b'*' => registers[word()] * registers[word()],
            b'/' => registers[word()] / registers[word()],
            b'm' => registers[word()].mul_add(registers[word()], registers[word()]),
            b'w' => registers[word()].neg_mul_add(registers[word()], registers[word()]),
            b'n' => -registers[word()],
            b'i' => registers[word()].recip(),
            b's' => {
                let second = word();
                let (sin, cos) = registers[word()].sin_cos();
                registers[second] = cos;
                sin
            }
            b'p' => {
                let (base, low, high) = (registers[word()], word(), word());
                // Both are words of two bytes.
                #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap)]
                base.powi((low | high << 16) as u32 as i32)
            }
            b'f' => unary[word()](registers[word()]),
            b'g' => binary[word()](registers[word()], registers[word()]),
            b'?' => S::select_le(
                registers[word()],
                registers[word()],
                registers[word()],
                registers[word()],
            ),
            b'=' => {
                let (low, high) = (word(), word());
                slices[first][low | high << 16] = registers[word()];
                continue;
            }
            b'.' => {
                result = registers[first];
                continue;
            }
            _ => unreachable!("the compiler of mechanisms wrote the tape"),
        };
        registers[first] = x;
    }
    result
}
