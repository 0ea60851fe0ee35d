//! The paper's claims, each with the numbers that bear it out or not. Every verdict is computed.

mod chain;
mod fish;

use serde::Serialize;

use crate::html::{fixed, joined};

use super::chain::ChainRow;
use super::fish::FishRow;

/// How a claim fares, from good to bad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Verdict {
    Holds,
    /// A stated bound is missed by less than a tenth of it.
    Nearly,
    Fails,
}

impl Verdict {
    /// One word.
    pub(super) fn word(self) -> &'static str {
        match self {
            Verdict::Holds => "holds",
            Verdict::Nearly => "nearly",
            Verdict::Fails => "does not hold",
        }
    }

    fn of(holds: bool) -> Self {
        if holds {
            Verdict::Holds
        } else {
            Verdict::Fails
        }
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
    /// Verdict.
    pub(super) verdict: Verdict,
}

/// What is called near: a tenth.
const NEAR: f64 = 0.1;
/// All claims. The rows of the chain are in order of x0.
pub(super) fn judge(chain_rows: &[ChainRow], fish_rows: &[FishRow]) -> Vec<Claim> {
    let mut claims = chain::claims(chain_rows);
    claims.extend(fish::claims(fish_rows));
    claims
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

/// Holds if all values are within the bounds; nearly, if none misses a bound by more than a tenth of it.
fn range(values: &[f64], (low, high): (f64, f64)) -> Verdict {
    let negated: Vec<f64> = values.iter().map(|v| -v).collect();
    at_least(values, low).max(at_least(&negated, -high))
}

/// Holds if no value is below `bound`; nearly, if none is by more than a tenth of it.
fn at_least(values: &[f64], bound: f64) -> Verdict {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    if least >= bound {
        Verdict::Holds
    } else if least >= bound - NEAR * bound.abs() {
        Verdict::Nearly
    } else {
        Verdict::Fails
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::published::PEAKS;

    #[test]
    fn a_bound_missed_by_little_is_nearly_kept() {
        assert_eq!(range(&[-201.0, -349.0], PEAKS), Verdict::Holds);
        assert_eq!(range(&[-199.2], PEAKS), Verdict::Nearly);
        assert_eq!(range(&[-370.0], PEAKS), Verdict::Nearly);
        assert_eq!(range(&[-100.0], PEAKS), Verdict::Fails);
        assert_eq!(at_least(&[1.0, 1.0], 1.0), Verdict::Holds);
        assert_eq!(at_least(&[0.95, 1.0], 1.0), Verdict::Nearly);
        assert_eq!(at_least(&[0.5], 1.0), Verdict::Fails);
    }
}
