//! Case 2: the fish robot (§6-10), one run for each gait.

use std::f64::consts::{FRAC_PI_2, PI};

use models::{FishRobot, Model};
use serde::Serialize;
use uktool::failure::Failure;
use uktool::scene::Start;

use super::measure::{self, Oscillation};
use super::motion::{self, Motion, RunRow, times};
use super::published::{A2, AMPLITUDES, FREQUENCIES_PI, PHASES_DEG};

const X1: usize = FishRobot::X1;
const TH1: usize = FishRobot::TH1;

/// End of the runs, s: far enough to see the fish turn over.
const UNTIL: f64 = 10.0;
/// Points of a curve: one in 10 ms, more than fifty in the shortest period.
const POINTS: u32 = 1000;
/// The window of the mean speed, s.
pub(super) const WINDOW: (f64, f64) = (3.0, 4.0);
/// Oscillations are taken from the whole periods that end with the window, three seconds at most: settled, and not yet turning.
const SETTLED: f64 = 3.0;
/// Bounds of the frequencies searched, in those of the fin.
const SEARCHED: (f64, f64) = (0.3, 3.0);
/// The fish is up to speed at this part of its mean speed.
const UP_TO_SPEED: f64 = 0.9;

/// How the fin is driven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gait {
    /// Amplitude A3 of the fin, rad.
    pub(super) a3: f64,
    /// Frequency in units of π rad/s.
    pub(super) omega_pi: f64,
    /// Phase behind the peduncle, degrees.
    pub(super) phi_deg: f64,
}

/// The paper's base gait (§10).
const BASE: Gait = Gait {
    a3: 0.6,
    omega_pi: 2.0,
    phi_deg: 15.0,
};

/// The amplitude sweep, then the frequency sweep, then the phase sweep; the base gait, which all share, once.
pub(super) fn gaits() -> Vec<Gait> {
    let amplitudes = AMPLITUDES.map(|a3| Gait { a3, ..BASE });
    let frequencies = FREQUENCIES_PI.map(|omega_pi| Gait { omega_pi, ..BASE });
    let phases = PHASES_DEG.map(|phi_deg| Gait { phi_deg, ..BASE });
    let others = frequencies.into_iter().chain(phases);
    let others = others.filter(|gait| *gait != BASE);
    amplitudes.into_iter().chain(others).collect()
}

impl Gait {
    /// The fish at its start, with the parameters that drive peduncle and fin.
    fn start(self) -> Start {
        let (omega, phi) = (self.omega_pi * PI, self.phi_deg.to_radians());
        let driven = [("a2", A2), ("a3", self.a3), ("w", omega), ("phi", phi)];
        Start::with(Some("table3"), &driven)
    }

    /// Which of the sweeps it belongs to: amplitude, frequency, phase.
    pub(super) fn sweeps(self) -> [bool; 3] {
        let same = [
            self.a3 == BASE.a3,
            self.omega_pi == BASE.omega_pi,
            self.phi_deg == BASE.phi_deg,
        ];
        [same[1] && same[2], same[0] && same[2], same[0] && same[1]]
    }
}

/// The items of a sweep (0 amplitude, 1 frequency, 2 phase), in order of what is varied.
pub(super) fn sweep<T>(items: &[T], k: usize, row: impl Fn(&T) -> &FishRow) -> Vec<&T> {
    let varied = |item: &T| [row(item).a3, row(item).omega, row(item).phi_deg][k];
    let mut chosen: Vec<&T> = items.iter().filter(|i| row(i).gait.sweeps()[k]).collect();
    chosen.sort_by(|a, b| varied(a).total_cmp(&varied(b)));
    chosen
}

/// The numbers of one gait.
#[derive(Debug, Clone, Serialize)]
pub(super) struct FishRow {
    /// Amplitude of the fin, rad.
    pub(super) a3: f64,
    /// Frequency, rad/s.
    pub(super) omega: f64,
    /// Phase, degrees.
    pub(super) phi_deg: f64,
    /// ẍ1 at t = 0, m/s².
    pub(super) start_acceleration: f64,
    /// Mean of ẋ1 over 3 s ≤ t ≤ 4 s, m/s.
    pub(super) mean_speed: f64,
    /// Mean of ẋ1 over each second, m/s.
    pub(super) mean_speed_by_second: Vec<f64>,
    /// When −ẋ1 first reaches 0.9 of the mean, s.
    pub(super) t_up_to_speed: f64,
    /// Half the spread of ẋ1 over the window, in parts of the mean.
    pub(super) ripple: f64,
    /// Mean of ẍ1 over the window, m/s².
    pub(super) mean_acceleration: f64,
    /// Frequency of ẍ1 in the settled part, rad/s.
    pub(super) acceleration_omega: f64,
    /// Frequency of θ1 in the settled part, rad/s.
    pub(super) swing_omega: f64,
    /// Amplitude of θ1 there, degrees.
    pub(super) swing_deg: f64,
    /// Mean of θ1 over the last period before 4 s, degrees.
    pub(super) heading_deg: f64,
    /// When |θ1| first passes 90°, s; none if it does not.
    pub(super) t_turned: Option<f64>,
    /// θ1 at the end of the run, degrees.
    pub(super) end_deg: f64,
    #[serde(skip)]
    pub(super) gait: Gait,
}

/// A run, its numbers and its curves.
pub(super) struct Fish {
    pub(super) row: FishRow,
    pub(super) run: RunRow,
    /// (t, −ẋ1).
    pub(super) speed: Vec<(f64, f64)>,
    /// (t, ẍ1).
    pub(super) acceleration: Vec<(f64, f64)>,
    /// (t, θ1 in degrees).
    pub(super) swing: Vec<(f64, f64)>,
}

/// The page that plays the swimming.
pub(super) const FILM: &str = "fish-swimming.html";

/// The fish with the least and the greatest amplitude of its fin side by side, up to the end of the window of the mean speed.
pub(super) fn film() -> Result<String, Failure> {
    let [first, .., last] = AMPLITUDES;
    let runs = [first, last].map(|a3| {
        let start = Gait { a3, ..BASE }.start();
        (format!("A3 = {a3}"), start)
    });
    motion::film(FishRobot::ID, runs, WINDOW.1)
}

/// Runs the fish with `gait`.
pub(super) fn compute(gait: Gait) -> Result<Fish, Failure> {
    let name = format!("fish-a{}-w{}pi-phi{}", gait.a3, gait.omega_pi, gait.phi_deg);
    let omega = gait.omega_pi * PI;
    let (mut motion, run) = Motion::new(&name, FishRobot::ID, &gait.start(), UNTIL, None)?;

    let (mut speed, mut acceleration, mut swing) = (Vec::new(), Vec::new(), Vec::new());
    for t in times(0.0, UNTIL, POINTS) {
        let state = motion.state(t)?;
        speed.push((t, -state.v[X1]));
        swing.push((t, state.q[TH1].to_degrees()));
        acceleration.push((t, motion.acceleration(t)?[X1]));
    }
    let place = |t: f64| motion.state(t).map(|s| s.q[X1]);
    let mean = |from: f64, to: f64| Ok::<_, Failure>((place(to)? - place(from)?) / (to - from));
    let (from, to) = WINDOW;
    let mean_speed = mean(from, to)?;
    let seconds = times(0.0, UNTIL - 1.0, (UNTIL - 1.0) as u32);
    let mean_speed_by_second = seconds
        .map(|t| mean(t, t + 1.0))
        .collect::<Result<_, _>>()?;
    let mean_acceleration = (motion.state(to)?.v[X1] - motion.state(from)?.v[X1]) / (to - from);

    let period = 2.0 * PI / omega;
    let settled = to - period * (SETTLED / period).floor();
    let oscillation = |curve: &[(f64, f64)]| -> Result<Oscillation, Failure> {
        measure::oscillation(
            &within(curve, settled, to),
            SEARCHED.0 * omega,
            SEARCHED.1 * omega,
        )
        .ok_or_else(|| Failure::Failed(format!("{name}: no oscillation can be fitted")))
    };
    let swinging = oscillation(&swing)?;
    let row = FishRow {
        a3: gait.a3,
        omega,
        phi_deg: gait.phi_deg,
        start_acceleration: acceleration[0].1,
        mean_speed,
        mean_speed_by_second,
        t_up_to_speed: first(&speed, |s| s >= -UP_TO_SPEED * mean_speed).unwrap_or(UNTIL),
        ripple: 0.5 * measure::spread(within(&speed, from, to).iter().map(|p| p.1))
            / mean_speed.abs(),
        mean_acceleration,
        acceleration_omega: oscillation(&acceleration)?.omega,
        swing_omega: swinging.omega,
        swing_deg: swinging.amplitude,
        heading_deg: average(&within(&swing, to - period, to)),
        t_turned: first(&swing, |angle| angle.abs() >= FRAC_PI_2.to_degrees()),
        end_deg: swing.last().map_or(0.0, |p| p.1),
        gait,
    };
    Ok(Fish {
        row,
        run,
        speed,
        acceleration,
        swing,
    })
}

fn within(curve: &[(f64, f64)], from: f64, to: f64) -> Vec<(f64, f64)> {
    // Half an interval of slack: the ends are samples themselves.
    let slack = 0.5 * UNTIL / f64::from(POINTS);
    curve
        .iter()
        .copied()
        .filter(|(t, _)| (from - slack..=to + slack).contains(t))
        .collect()
}

fn average(curve: &[(f64, f64)]) -> f64 {
    curve.iter().map(|p| p.1).sum::<f64>() / curve.len().max(1) as f64
}

fn first(curve: &[(f64, f64)], holds: impl Fn(f64) -> bool) -> Option<f64> {
    curve
        .iter()
        .find(|(_, value)| holds(*value))
        .map(|(t, _)| *t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_gait_once_and_four_in_each_sweep() {
        let all = gaits();
        assert_eq!(all.len(), 10);
        for sweep in 0..3 {
            assert_eq!(all.iter().filter(|g| g.sweeps()[sweep]).count(), 4);
        }
    }
}
