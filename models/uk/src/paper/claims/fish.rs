//! Claims on the fish robot.

use crate::html::{fixed, joined, signed};

use super::super::fish::{FishRow, WINDOW, sweep};
use super::super::measure::{increases, spread};
use super::{Claim, Verdict, at_least, column, list, percent, reversed};

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

/// All of them.
pub(super) fn claims(rows: &[FishRow]) -> Vec<Claim> {
    let sweeps = [0, 1, 2].map(|k| sweep(rows, k, |r| r).into_iter().cloned().collect());
    let mut claims = speed(&sweeps);
    claims.extend(starting(&sweeps));
    claims.extend(swinging(&sweeps));
    claims
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
