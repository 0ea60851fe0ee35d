//! Claims on the fish robot.

use uktool::html::{fixed, joined, signed};

use super::super::fish::{FishRow, WINDOW, sweep};
use super::super::measure::spread;
use super::{Told, Verdict, at_most, column, growing, larger, list, percent, reversed};

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

pub(super) fn claims(rows: &[FishRow]) -> Vec<Told> {
    let sweeps = [0, 1, 2].map(|k| sweep(rows, k, |r| r).into_iter().cloned().collect());
    let mut claims = speed(&sweeps);
    claims.extend(starting(&sweeps));
    claims.extend(swinging(&sweeps));
    claims
}

fn fish_claim(claim: &'static str, found: String, numbers: Vec<f64>, verdict: Verdict) -> Told {
    ("10.2", claim, found, numbers, verdict)
}

fn trend(
    rows: &[Vec<FishRow>; 3],
    value: impl Fn(&FishRow) -> f64,
    digits: usize,
) -> (String, Vec<f64>, Verdict) {
    let values = rows.each_ref().map(|r| column(r, &value));
    let falling = growing(&reversed(&values[2]));
    let verdict = growing(&values[0]).and(growing(&values[1])).and(falling);
    let text = format!(
        "with A3 {}; with ω {}; with φ {}",
        list(&values[0], digits),
        list(&values[1], digits),
        list(&values[2], digits)
    );
    (text, values.concat(), verdict)
}

fn speed(sweeps: &[Vec<FishRow>; 3]) -> Vec<Told> {
    let (text, numbers, verdict) = trend(sweeps, |r| -r.mean_speed, 4);
    let rows = &sweeps[0];
    let rise = column(rows, |r| r.t_up_to_speed);
    let ripple = column(rows, |r| r.ripple);
    let gains: Vec<Vec<f64>> = rows.iter().map(gains).collect();
    let settling = column(&gains, |g| g[2] / g[0]);
    let [a3, omega, phi] = sweeps
        .each_ref()
        .map(|s| spread(s.iter().map(|r| r.mean_speed)));
    vec![
        fish_claim(
            "The forward speed rises quickly, then tends to a fixed value",
            format!(
                "nine tenths of the mean over {}-{} s reached after {} s; the gain from the third second to the fourth is {} % of that \
                 from the first to the second",
                WINDOW.0,
                WINDOW.1,
                list(&rise, 2),
                percent(&settling, 0)
            ),
            [rise.clone(), settling.clone()].concat(),
            at_most(&rise, WINDOW.0).and(at_most(&settling, SETTLING)),
        ),
        fish_claim(
            "It then fluctuates slightly about its mean",
            format!("by ± {} %", percent(&ripple, 1)),
            ripple.clone(),
            at_most(&ripple, SMALL_RIPPLE),
        ),
        fish_claim(
            "It grows with the fin's amplitude and frequency and falls with its phase",
            format!("{text} m/s"),
            numbers,
            verdict,
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
            larger([(a3, phi), (omega, phi)]),
        ),
    ]
}

/// The amounts by which the mean speed of each of the seconds 2, 3 and 4 exceeds that of the second before.
fn gains(row: &FishRow) -> Vec<f64> {
    let speeds = &row.mean_speed_by_second;
    speeds.windows(2).take(3).map(|w| w[0] - w[1]).collect()
}

fn starting(sweeps: &[Vec<FishRow>; 3]) -> Vec<Told> {
    let (text, numbers, verdict) = trend(sweeps, |r| -r.start_acceleration, 3);
    let part = column(&sweeps[0], |r| r.mean_acceleration / r.start_acceleration);
    let frequency = column(&sweeps[1], |r| r.acceleration_omega);
    vec![
        fish_claim(
            "The starting acceleration grows with amplitude and frequency and falls with phase",
            format!("{text} m/s²"),
            numbers,
            verdict,
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
            at_most(&column(&part, |p| p.abs()), NO_ACCELERATION),
        ),
        fish_claim(
            "The frequency of that fluctuation grows with ω",
            format!(
                "{} Hz for a fin of {} Hz",
                list(&column(&sweeps[1], |r| hertz(r.acceleration_omega)), 2),
                list(&column(&sweeps[1], |r| hertz(r.omega)), 2)
            ),
            frequency.clone(),
            growing(&frequency),
        ),
    ]
}

fn hertz(omega: f64) -> f64 {
    omega / std::f64::consts::TAU
}

fn swinging(sweeps: &[Vec<FishRow>; 3]) -> Vec<Told> {
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
            at_most(&[largest], SAME_FREQUENCY),
        ),
        fish_claim(
            "The amplitude of the swing grows slightly with that of the fin",
            format!("{}°", list(&by_amplitude, 2)),
            by_amplitude.clone(),
            growing(&by_amplitude),
        ),
        fish_claim(
            "ω has little influence on the amplitude of the swing",
            format!(
                "{}°: varies by {} %",
                list(&by_frequency, 2),
                fixed(100.0 * varies, 1)
            ),
            by_frequency.clone(),
            at_most(&[varies], LITTLE),
        ),
        fish_claim(
            "The amplitude of the swing falls as the phase grows",
            format!("{}°", list(&by_phase, 2)),
            by_phase.clone(),
            growing(&reversed(&by_phase)),
        ),
    ]
}
