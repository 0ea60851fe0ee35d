//! The paper's claims, each with the numbers that bear it out or not. Every verdict is computed.

use serde::Serialize;

use crate::html::{fixed, joined, signed};

use super::chain::ChainRow;
use super::fish::{FishRow, WINDOW};
use super::measure::{increases, spread};
use super::published::{ABOVE_G, PEAKS, PULL, TABLE_1_DIGIT};

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
/// An oscillation fitted to three periods has its frequency to about a hundredth; twice that is called equal.
const SAME_FREQUENCY: f64 = 0.02;
/// A ripple is called small up to this part of the mean.
const SMALL_RIPPLE: f64 = 0.15;
/// A speed is called settling if its gain from the third second to the fourth is at most this part of that from the first to the second:
/// the time constant of such an approach is below 2 s/ln 3 = 1.8 s, less than half of the four seconds.
const SETTLING: f64 = 1.0 / 3.0;
/// An acceleration is called zero below this part of the starting one.
const NO_ACCELERATION: f64 = 0.05;
/// A quantity is called little influenced if it varies by less than this part over a sweep.
const LITTLE: f64 = 0.25;

/// All claims. The rows of the chain are in order of x0.
pub(super) fn judge(chain: &[ChainRow], fish: &[FishRow]) -> Vec<Claim> {
    let mut claims = table_1(chain);
    claims.extend(falling(chain));
    claims.extend(peaks(chain));
    let sweeps = [0, 1, 2].map(|k| sweep(fish, k));
    claims.extend(speed(&sweeps));
    claims.extend(starting(&sweeps));
    claims.extend(swinging(&sweeps));
    claims
}

/// The rows of a sweep (0 amplitude, 1 frequency, 2 phase), in order of what is varied.
pub(super) fn sweep(rows: &[FishRow], k: usize) -> Vec<FishRow> {
    let varied = |r: &FishRow| [r.a3, r.omega, r.phi_deg][k];
    let mut rows: Vec<FishRow> = rows
        .iter()
        .filter(|r| r.gait.sweeps()[k])
        .cloned()
        .collect();
    rows.sort_by(|a, b| varied(a).total_cmp(&varied(b)));
    rows
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

fn chain_claim(
    section: &'static str,
    claim: &'static str,
    found: String,
    numbers: Vec<f64>,
    verdict: Verdict,
) -> Claim {
    Claim {
        case: "uchain",
        section,
        claim,
        found,
        numbers,
        verdict,
    }
}

fn fish_claim(claim: &'static str, found: String, numbers: Vec<f64>, verdict: Verdict) -> Claim {
    Claim {
        case: "fish",
        section: "10.2",
        claim,
        found,
        numbers,
        verdict,
    }
}

fn table_1(rows: &[ChainRow]) -> Vec<Claim> {
    let largest = |difference: &dyn Fn(&ChainRow) -> f64| {
        column(rows, difference)
            .into_iter()
            .map(f64::abs)
            .fold(0.0, f64::max)
    };
    let h = largest(&|r| r.h_max - r.paper.h_max);
    let t = largest(&|r| r.t_max - r.paper.t_max);
    let digits = Verdict::of(h <= TABLE_1_DIGIT && t <= TABLE_1_DIGIT);
    vec![chain_claim(
        "5, Table 1",
        "Greatest fall of the tip and its time, for five separations",
        format!(
            "largest differences {} m and {} s; printed to 0.001",
            fixed(h, 4),
            fixed(t, 4)
        ),
        vec![h, t],
        digits,
    )]
}

fn falling(rows: &[ChainRow]) -> Vec<Claim> {
    let least = column(rows, |r| r.least_lead);
    let lead = column(rows, |r| r.lead);
    let (t_max, h_max) = (column(rows, |r| r.t_max), column(rows, |r| r.h_max));
    let mean = column(rows, |r| r.mean_above_g);
    let part = column(rows, |r| r.part_above_g);
    let highest = column(rows, |r| r.highest);
    let until = column(rows, |r| r.t_above_g);
    let share = column(rows, |r| r.t_above_g / r.t_max);
    let within = highest
        .iter()
        .filter(|a| (ABOVE_G.0..=ABOVE_G.1).contains(*a))
        .count();
    vec![
        chain_claim(
            "5, 11",
            "The tip is ahead of a free fall until its turn",
            format!(
                "least lead on the way {} % of the free fall; lead at the turn {} m",
                percent(&least, 2),
                list(&lead, 3)
            ),
            least.clone(),
            Verdict::of(least.iter().all(|l| *l > 0.0)),
        ),
        chain_claim(
            "5, 11",
            "Greatest fall and its time shrink with x0",
            format!("h_max {} m; t_max {} s", list(&h_max, 3), list(&t_max, 3)),
            [h_max.clone(), t_max.clone()].concat(),
            Verdict::of(increases(&h_max) && increases(&t_max)),
        ),
        chain_claim(
            "5, 11",
            "ÿ1 is above g from the start until the chain pulls the tip back",
            format!(
                "in {} % of the time up to its last fall through g, which is {} % of that to the turn",
                percent(&part, 0),
                percent(&share, 0)
            ),
            part.clone(),
            at_least(&part, 1.0),
        ),
        chain_claim(
            "5",
            "It is above g for longer as x0 shrinks",
            format!("until {} s", list(&until, 3)),
            until.clone(),
            Verdict::of(increases(&reversed(&until))),
        ),
        chain_claim(
            "5",
            "ÿ1 exceeds g by more as x0 shrinks",
            format!("mean excess {} m/s²", list(&mean, 3)),
            mean.clone(),
            Verdict::of(increases(&reversed(&mean))),
        ),
        chain_claim(
            "5",
            "Above g, ÿ1 has values from about 10 to 25 m/s²",
            format!(
                "greatest values {} m/s²: {within} of {} in this range",
                list(&highest, 1),
                highest.len()
            ),
            highest.clone(),
            range(&highest, ABOVE_G),
        ),
    ]
}

fn peaks(rows: &[ChainRow]) -> Vec<Claim> {
    let peak = column(rows, |r| r.peak);
    let depth = column(rows, |r| -r.peak);
    let time = column(rows, |r| r.t_peak);
    let pull = column(rows, |r| r.pull);
    let greatest = pull.iter().copied().fold(0.0, f64::max);
    vec![
        chain_claim(
            "5, Figs. 2-6",
            "The negative peaks of ÿ1 lie between −200 and −350 m/s²",
            format!("{} m/s²", list(&peak, 1)),
            peak.clone(),
            range(&peak, PEAKS),
        ),
        chain_claim(
            "5",
            "The peaks, and their times, shrink with x0",
            format!("{} m/s² at {} s", list(&peak, 1), list(&time, 3)),
            [depth.clone(), time.clone()].concat(),
            Verdict::of(increases(&depth) && increases(&time)),
        ),
        chain_claim(
            "11",
            "The pull on the tip goes up to 40 weights of a link",
            format!("{} weights", list(&pull, 1)),
            pull.clone(),
            if greatest <= PULL && greatest >= 0.5 * PULL {
                Verdict::Holds
            } else {
                Verdict::Fails
            },
        ),
    ]
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

fn trend(
    rows: &[Vec<FishRow>; 3],
    value: impl Fn(&FishRow) -> f64,
    digits: usize,
) -> (String, Vec<f64>, bool) {
    let values = rows.each_ref().map(|r| column(r, &value));
    let holds = increases(&values[0]) && increases(&values[1]) && increases(&reversed(&values[2]));
    let text = format!(
        "with A3 {}; with ω {}; with φ {}",
        list(&values[0], digits),
        list(&values[1], digits),
        list(&values[2], digits)
    );
    (text, values.concat(), holds)
}

fn speed(sweeps: &[Vec<FishRow>; 3]) -> Vec<Claim> {
    let (text, numbers, holds) = trend(sweeps, |r| -r.mean_speed, 4);
    let rows = &sweeps[0];
    let rise = column(rows, |r| r.t_up_to_speed);
    let ripple = column(rows, |r| r.ripple);
    let gains: Vec<Vec<f64>> = rows.iter().map(gains).collect();
    let settling = column(&gains, |g| g[2] / g[0]);
    let largest = |values: &[f64]| values.iter().map(|v| v.abs()).fold(0.0, f64::max);
    let [a3, omega, phi] = sweeps
        .each_ref()
        .map(|s| spread(s.iter().map(|r| r.mean_speed)));
    vec![
        fish_claim(
            "The forward speed rises quickly, then tends to a fixed value",
            format!(
                "nine tenths of the mean over {}-{} s reached after {} s; the gain from the third second to the fourth is {} % of that from the first to the second",
                WINDOW.0,
                WINDOW.1,
                list(&rise, 2),
                percent(&settling, 0)
            ),
            [rise.clone(), settling.clone()].concat(),
            Verdict::of(largest(&rise) < WINDOW.0 && largest(&settling) <= SETTLING),
        ),
        fish_claim(
            "It then fluctuates slightly about its mean",
            format!("by ± {} %", percent(&ripple, 1)),
            ripple.clone(),
            Verdict::of(largest(&ripple) <= SMALL_RIPPLE),
        ),
        fish_claim(
            "It grows with the fin's amplitude and frequency and falls with its phase",
            format!("{text} m/s"),
            numbers,
            Verdict::of(holds),
        ),
        fish_claim(
            "The phase has less influence on it than amplitude and frequency",
            format!(
                "ranges over the sweeps: A3 {}, ω {}, φ (0-60°) {} m/s",
                fixed(a3, 4),
                fixed(omega, 4),
                fixed(phi, 4)
            ),
            vec![a3, omega, phi],
            at_least(&[a3.min(omega)], phi),
        ),
    ]
}

/// By how much the mean speed of each of the seconds 2, 3 and 4 exceeds that of the second before.
fn gains(row: &FishRow) -> Vec<f64> {
    let speeds = &row.mean_speed_by_second;
    speeds.windows(2).take(3).map(|w| w[0] - w[1]).collect()
}

fn starting(sweeps: &[Vec<FishRow>; 3]) -> Vec<Claim> {
    let (text, numbers, holds) = trend(sweeps, |r| -r.start_acceleration, 3);
    let part = column(&sweeps[0], |r| r.mean_acceleration / r.start_acceleration);
    let frequency = column(&sweeps[1], |r| r.acceleration_omega);
    vec![
        fish_claim(
            "The starting acceleration grows with amplitude and frequency and falls with phase",
            format!("{text} m/s²"),
            numbers,
            Verdict::of(holds),
        ),
        fish_claim(
            "The acceleration then fluctuates about zero",
            format!(
                "mean over {}-{} s {} % of the starting one",
                WINDOW.0,
                WINDOW.1,
                joined(part.iter().map(|p| signed(100.0 * p, 2)))
            ),
            part.clone(),
            Verdict::of(part.iter().all(|p| p.abs() <= NO_ACCELERATION)),
        ),
        fish_claim(
            "The frequency of that fluctuation grows with ω",
            format!(
                "{} Hz for a fin of {} Hz",
                list(&column(&sweeps[1], |r| hertz(r.acceleration_omega)), 2),
                list(&column(&sweeps[1], |r| hertz(r.omega)), 2)
            ),
            frequency.clone(),
            Verdict::of(increases(&frequency)),
        ),
    ]
}

fn hertz(omega: f64) -> f64 {
    omega / std::f64::consts::TAU
}

fn swinging(sweeps: &[Vec<FishRow>; 3]) -> Vec<Claim> {
    let ratio: Vec<f64> = sweeps
        .iter()
        .flatten()
        .map(|r| r.swing_omega / r.omega)
        .collect();
    let [by_amplitude, by_frequency, by_phase] =
        sweeps.each_ref().map(|s| column(s, |r| r.swing_deg));
    let largest = ratio.iter().map(|r| (r - 1.0).abs()).fold(0.0, f64::max);
    let mean = by_frequency.iter().sum::<f64>() / by_frequency.len().max(1) as f64;
    let varies = spread(by_frequency.iter().copied()) / mean;
    vec![
        fish_claim(
            "The body swings with the frequency of the fin",
            format!(
                "over all gaits the two differ by at most {} %",
                fixed(100.0 * largest, 1)
            ),
            ratio,
            Verdict::of(largest <= SAME_FREQUENCY),
        ),
        fish_claim(
            "The amplitude of the swing grows slightly with that of the fin",
            format!("{}°", list(&by_amplitude, 2)),
            by_amplitude.clone(),
            Verdict::of(increases(&by_amplitude)),
        ),
        fish_claim(
            "ω has little influence on the amplitude of the swing",
            format!(
                "{}°: varies by {} %",
                list(&by_frequency, 2),
                fixed(100.0 * varies, 1)
            ),
            by_frequency.clone(),
            Verdict::of(varies <= LITTLE),
        ),
        fish_claim(
            "The amplitude of the swing falls as the phase grows",
            format!("{}°", list(&by_phase, 2)),
            by_phase.clone(),
            Verdict::of(increases(&reversed(&by_phase))),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

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
