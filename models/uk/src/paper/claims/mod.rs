//! The paper's claims, each with the numbers that bear it out or not. Every verdict is computed.

mod chain;
mod fish;

use serde::Serialize;
use uktool::html::{fixed, joined};

use super::chain::ChainRow;
use super::fish::FishRow;
use super::measure::spread;

/// How a claim fares, from good to bad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Verdict {
    Holds,
    Nearly,
    Fails,
}

/// The standard of all verdicts, for the page.
pub(super) const STANDARD: &str = "One standard serves for all. A number that the paper states is met within a twentieth of it, since its \
     text gives round numbers; those of Table 1, printed to three decimals, to one unit of the last. What is said to be larger, later, \
     ahead or growing has to be so, by however little. “Nearly” means missed by no more than three twentieths: of the number that is \
     stated, of the larger one of two that are compared, or, where something is said to grow, of the range that it covers.";

/// A stated number is met within this part of it.
const MET: f64 = 0.05;
/// What is missed by no more than this part is nearly met.
const NEAR: f64 = 0.15;

impl Verdict {
    pub(super) fn word(self) -> &'static str {
        match self {
            Verdict::Holds => "holds",
            Verdict::Nearly => "nearly",
            Verdict::Fails => "does not hold",
        }
    }

    /// The verdict on what is missed by this part, where so much of it is admitted.
    fn missed(part: f64, admitted: f64) -> Self {
        if part <= admitted {
            Verdict::Holds
        } else if part <= NEAR {
            Verdict::Nearly
        } else {
            Verdict::Fails
        }
    }

    /// The worst of what these parts miss; one that is no number fails.
    fn all(parts: impl Iterator<Item = f64>, admitted: f64) -> Self {
        let verdicts = parts.map(|part| Verdict::missed(part, admitted));
        verdicts.max().unwrap_or(Verdict::Holds)
    }

    /// The worse one.
    fn and(self, other: Verdict) -> Self {
        self.max(other)
    }
}

/// A claim and what becomes of it.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Claim {
    /// `"uchain"` or `"fish"`.
    pub(super) case: &'static str,
    /// Section of the paper.
    pub(super) section: &'static str,
    /// The claim, in our words.
    pub(super) claim: &'static str,
    /// The numbers, for reading.
    pub(super) found: String,
    /// The numbers judged.
    pub(super) numbers: Vec<f64>,
    pub(super) verdict: Verdict,
}

/// A claim but for its case, in the same order.
type Told = (&'static str, &'static str, String, Vec<f64>, Verdict);

/// All claims. The rows of the chain are in order of x0.
pub(super) fn judge(chain_rows: &[ChainRow], fish_rows: &[FishRow]) -> Vec<Claim> {
    let of = |case| {
        move |(section, claim, found, numbers, verdict): Told| Claim {
            case,
            section,
            claim,
            found,
            numbers,
            verdict,
        }
    };
    let chain = chain::claims(chain_rows).into_iter().map(of("uchain"));
    let fish = fish::claims(fish_rows).into_iter().map(of("fish"));
    chain.chain(fish).collect()
}

fn column<T>(rows: &[T], value: impl Fn(&T) -> f64) -> Vec<f64> {
    rows.iter().map(value).collect()
}

fn list(values: &[f64], digits: usize) -> String {
    joined(values.iter().map(|v| fixed(*v, digits)))
}

fn percent(values: &[f64], digits: usize) -> String {
    joined(values.iter().map(|v| fixed(100.0 * v, digits)))
}

fn reversed(values: &[f64]) -> Vec<f64> {
    values.iter().rev().copied().collect()
}

/// Whether all values lie between two stated numbers.
fn between(values: &[f64], (low, high): (f64, f64)) -> Verdict {
    at_least(values, low).and(at_most(values, high))
}

/// Whether no value is below a stated number.
fn at_least(values: &[f64], stated: f64) -> Verdict {
    let missed = values.iter().map(|v| (stated - v) / stated.abs());
    Verdict::all(missed, MET)
}

/// Whether what is said to be so all the time is so in each of these parts of it.
fn throughout(parts: &[f64]) -> Verdict {
    Verdict::all(parts.iter().map(|part| 1.0 - part), 0.0)
}

/// Whether no value is above a stated number.
fn at_most(values: &[f64], stated: f64) -> Verdict {
    let negated: Vec<f64> = values.iter().map(|v| -v).collect();
    at_least(&negated, -stated)
}

/// Whether the largest of the values comes up to a stated number and does not exceed it.
fn up_to(values: &[f64], stated: f64) -> Verdict {
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Verdict::missed((largest / stated - 1.0).abs(), MET)
}

/// Whether each of the larger ones is larger than what stands beside it.
fn larger(pairs: impl IntoIterator<Item = (f64, f64)>) -> Verdict {
    let pairs = pairs.into_iter();
    let missed = pairs.map(|(larger, smaller)| above(larger, smaller, smaller.abs()));
    Verdict::all(missed, 0.0)
}

/// Whether each value is larger than the one before.
fn growing(values: &[f64]) -> Verdict {
    let range = spread(values.iter().copied());
    let missed = values.windows(2).map(|w| above(w[1], w[0], range));
    Verdict::all(missed, 0.0)
}

/// What is missed where one number has to be larger than another, as a share of `size`: equal is missed, though by nothing.
fn above(larger: f64, smaller: f64, size: f64) -> f64 {
    match larger > smaller {
        true => 0.0,
        false => (smaller - larger) / size + f64::MIN_POSITIVE,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::published::{PEAKS, PULL};

    #[test]
    fn one_standard_for_all() {
        assert_eq!(between(&[-201.0, -349.0], PEAKS), Verdict::Holds);
        // Round numbers are met within a twentieth, be they bounds or what is reached.
        assert_eq!(between(&[-199.2], PEAKS), Verdict::Holds);
        assert_eq!(between(&[-385.0], PEAKS), Verdict::Nearly);
        assert_eq!(between(&[-100.0], PEAKS), Verdict::Fails);
        assert_eq!(up_to(&[21.0, 39.0], PULL), Verdict::Holds);
        assert_eq!(up_to(&[21.0, 35.3], PULL), Verdict::Nearly);
        assert_eq!(up_to(&[21.0], PULL), Verdict::Fails);
        // What is no number is met by nothing.
        let nan = f64::NAN;
        assert_eq!(at_least(&[1.0, nan], 0.5), Verdict::Fails);
        assert_eq!(throughout(&[1.0, nan]), Verdict::Fails);
        assert_eq!(larger([(nan, 1.0), (2.0, 1.0)]), Verdict::Fails);
        assert_eq!(growing(&[1.0, nan, 3.0]), Verdict::Fails);
        // An order is no number: it holds or is missed.
        assert_eq!(larger([(1.001, 1.0)]), Verdict::Holds);
        assert_eq!(larger([(0.95, 1.0)]), Verdict::Nearly);
        assert_eq!(larger([(0.5, 1.0)]), Verdict::Fails);
        assert_eq!(growing(&[1.0, 2.0, 3.0]), Verdict::Holds);
        assert_eq!(growing(&[1.0, 3.0, 2.9]), Verdict::Nearly);
        assert_eq!(growing(&[1.0, 3.0, 2.0]), Verdict::Fails);
    }
}
