//! What is integrated along with the motion.
//!
//! Integrals are quadratures: no equation depends on them, so they need no unknown of the solve nor of the method. Over each step the
//! integrand is taken along the interpolant, whose integral has the order of the method: between its states it is off by one order less
//! than the step, and the step size makes up for that. (The error of the collocation polynomial of Radau IIA vanishes in the mean, which
//! gives order 5.) An integral has two errors, and both are controlled.
//!
//! That of the quadrature costs no step. The rule is Kronrod's extension of Lobatto's of 4 points to 7 (Gander & Gautschi 2000, Adaptive
//! quadrature revisited, BIT 40, 84-101); intervals are halved until both agree to the tolerance of the run, beside the integral of the
//! magnitude so far: pulses, kinks and jumps of the integrand, which steps do not land on, are closed in so. Where the integrand is what
//! cancellation leaves, as the power of a motor in steady motion, no halving makes them agree: states a rounding apart show that.
//!
//! That of the motion takes part in the choice of the step size. The integrand is taken a second time along states that are off by what the
//! method estimates to be its error, growing from 0 at the start of the step; what that changes is held against the tolerance of the run as
//! the error of a coordinate is. A method without an estimate has steps of one size, and nothing to choose.

use crate::diagnosis::lost_reactions;
use crate::error::Error;
use crate::events::States;
use crate::integrate::sample::Sample;
use crate::mechanism::Prepared;
use crate::rounding::beside;

/// Points in [−1, 1] that are not negative, and their weights by the rule of 7 points and by that of 4, which is Lobatto's (Gander &
/// Gautschi 2000). With the ends among them a jump is seen wherever it is.
const RULE: [(f64, f64, f64); 4] = [
    (0.0, 16.0 / 35.0, 0.0),
    (0.447_213_595_499_957_9, 125.0 / 294.0, 5.0 / 6.0),
    (0.816_496_580_927_726, 72.0 / 245.0, 0.0),
    (1.0, 11.0 / 210.0, 1.0 / 6.0),
];

/// A step is integrated in at least so many intervals, and a run in so many, so that pulses in which the motion has no part are seen: those
/// wider than a ninth of a step, or a thousandth of the run if that is less.
const PARTS: f64 = 2.0;
const RUN_PARTS: f64 = 256.0;
/// A step that goes on behind the end of the run has no more than so many of them.
const MOST_PARTS: f64 = 1024.0;

/// Halvings of what is integrated at once, after which it is as short as the rounding of its times.
const HALVINGS: u32 = 50;
/// Halvings after which it is asked whether there is anything but rounding to be integrated, and how much more of it there may be than was
/// found at a few states.
const PLAIN: u32 = 3;
const NOISE: f64 = 8.0;
/// An interval whose error is less than this share of it is exact.
const ROUNDING: f64 = 50.0 * f64::EPSILON;

/// The integrals of a run, and how far they are.
pub(super) struct Integrals {
    mechanism: Prepared,
    /// Relative tolerance, and what integrals that are less than it are held to it by.
    relative: f64,
    floor: f64,
    /// Longest interval.
    longest: f64,
    /// Time up to which the step in hand is taken.
    at: f64,
    /// The integrals up to the last accepted step, and up to that time.
    accepted: Vec<Sum>,
    reached: Vec<Sum>,
    values: Vec<f64>,
    state: Vec<f64>,
    integrands: Vec<f64>,
    /// What they are at a state that is off.
    off: Vec<f64>,
    /// The most that rounding was found to make of them in the step in hand.
    noise: Vec<f64>,
}

/// What is known of one integral so far.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    value: f64,
    /// The integral of the magnitude.
    size: f64,
    /// The magnitude of what the error of the motion in the step in hand makes of it.
    moved: f64,
}

impl Integrals {
    /// The integrals of `mechanism`, zero where a run over the time `span` starts; `None` where it has none.
    pub(super) fn new(
        mechanism: &Prepared,
        [relative, floor]: [f64; 2],
        span: f64,
    ) -> Option<Self> {
        let count = mechanism.integrals().len();
        (count > 0).then(|| Integrals {
            relative,
            floor,
            longest: span.abs() / RUN_PARTS,
            at: 0.0,
            accepted: vec![Sum::default(); count],
            reached: vec![Sum::default(); count],
            values: vec![0.0; count],
            state: vec![0.0; 2 * mechanism.spec().n()],
            integrands: vec![0.0; count],
            off: vec![0.0; count],
            noise: vec![0.0; count],
            mechanism: mechanism.clone(),
        })
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.values.len()
    }

    /// A step begins at time `t`, where the last accepted one ended.
    pub(super) fn begin(&mut self, t: f64) {
        self.at = t;
        self.reached.copy_from_slice(&self.accepted);
        self.reached.iter_mut().for_each(|sum| sum.moved = 0.0);
        self.noise.fill(0.0);
    }

    /// The step in hand is accepted.
    pub(super) fn accept(&mut self) {
        self.accepted.copy_from_slice(&self.reached);
    }

    /// The values where the step in hand is taken, and what the error of the motion in it makes of them, as a part of what is allowed.
    pub(super) fn reached(&self) -> (&[f64], f64) {
        let part = |sum: &Sum| sum.moved / (self.relative * (self.floor + sum.size));
        let error = self.reached.iter().map(part).fold(0.0, f64::max);
        (&self.values, error)
    }

    /// Goes on to time `b` along the step in hand, and returns the values there.
    pub(super) fn go(&mut self, states: &mut Along<'_>, b: f64) -> Result<&[f64], Error> {
        let a = std::mem::replace(&mut self.at, b);
        let longest = self.longest.min(states.span().abs() / PARTS);
        let parts = ((b - a).abs() / longest).ceil().clamp(1.0, MOST_PARTS) as u32;
        let place = |k: u32| match k == parts {
            true => b,
            false => a + (b - a) * (f64::from(k) / f64::from(parts)),
        };
        // From the start on, so that what is added up before tells what is small.
        let each = (0..parts).rev();
        let mut open: Vec<_> = each.map(|k| (place(k), place(k + 1), HALVINGS)).collect();
        while let Some((a, b, left)) = open.pop() {
            if a == b {
                continue;
            }
            let middle = 0.5 * (a + b);
            let parts = self.rule(states, a, b)?;
            let close = |part: &Part, before: &Sum| {
                part.error <= ROUNDING * part.sum.size
                    || part.error <= self.relative * (before.size + part.sum.size)
            };
            let pairs = parts.iter().zip(&self.reached);
            let bad = pairs.map(|(part, before)| !close(part, before));
            let bad: Vec<bool> = bad.collect();
            let good = !bad.contains(&true)
                || left <= HALVINGS - PLAIN && {
                    self.measure(states, middle)?;
                    let noise = |k: usize| NOISE * self.noise[k] * (b - a).abs();
                    (0..bad.len()).all(|k| !bad[k] || parts[k].error <= noise(k))
                };
            if good || left == 0 || middle == a || middle == b {
                for (reached, part) in self.reached.iter_mut().zip(parts) {
                    reached.value += part.sum.value;
                    reached.size += part.sum.size;
                    reached.moved += part.sum.moved;
                }
            } else {
                open.extend([(middle, b, left - 1), (a, middle, left - 1)]);
            }
        }
        let reached = self.reached.iter();
        self.values
            .iter_mut()
            .zip(reached)
            .for_each(|(value, r)| *value = r.value);
        Ok(&self.values)
    }

    /// Integrates from `a` to `b` by both rules.
    fn rule(&mut self, states: &mut Along<'_>, a: f64, b: f64) -> Result<Vec<Part>, Error> {
        let (centre, half) = (0.5 * (a + b), 0.5 * (b - a));
        // By the rule of 7 and that of 4; of the magnitude, and of the change by an error of the motion, by that of 7.
        let mut sums = vec![[0.0; 4]; self.integrands.len()];
        for (k, (point, seven, four)) in RULE.into_iter().enumerate() {
            for sign in if k == 0 { &[1.0][..] } else { &[1.0, -1.0] } {
                self.at(states, centre + sign * half * point)?;
                let integrands = self.integrands.iter().zip(&self.off);
                for (sum, (f, off)) in sums.iter_mut().zip(integrands) {
                    sum[0] += seven * f;
                    sum[1] += four * f;
                    sum[2] += seven * f.abs();
                    // Where the integrand has no value, it has no change.
                    let change = Some((off - f).abs()).filter(|change| change.is_finite());
                    sum[3] += seven * change.unwrap_or(0.0);
                }
            }
        }
        let part = |[seven, four, size, moved]: [f64; 4]| {
            let (difference, size) = ((half * (seven - four)).abs(), half.abs() * size);
            // As QUADPACK has it (Piessens et al. 1983): the rule of more points is better than their difference.
            let error = match size > 0.0 {
                true => size * (200.0 * difference / size).powf(1.5).min(1.0),
                false => 0.0,
            };
            let (value, moved) = (half * seven, half.abs() * moved);
            Part {
                sum: Sum { value, size, moved },
                error,
            }
        };
        Ok(sums.into_iter().map(part).collect())
    }

    /// Measures what rounding makes of the integrands at `t`: where all that is integrated cancels, halves are no better.
    fn measure(&mut self, states: &mut Along<'_>, t: f64) -> Result<(), Error> {
        self.at(states, t)?;
        states.states.state(t, &mut self.state);
        let n = self.state.len() / 2;
        for moved in beside(&[&[t][..], &self.state].concat()) {
            let (q, v) = moved[1..].split_at(n);
            (self.mechanism).integrands(moved[0], q, v, &mut self.off);
            let pairs = self.noise.iter_mut().zip(&self.off).zip(&self.integrands);
            pairs.for_each(|((noise, off), f)| *noise = noise.max((off - f).abs()));
        }
        Ok(())
    }

    /// The integrands at `t`, as the motion is and as it is off.
    fn at(&mut self, states: &mut Along<'_>, t: f64) -> Result<(), Error> {
        states.states.state(t, &mut self.state);
        let n = self.state.len() / 2;
        let (q, v) = self.state.split_at(n);
        self.mechanism.integrands(t, q, v, &mut self.integrands);
        self.off.copy_from_slice(&self.integrands);
        if let Some(error) = states.error {
            let share = (t - states.from) / states.span();
            let pairs = self.state.iter_mut().zip(error);
            pairs.for_each(|(y, error)| *y += share * error);
            let (q, v) = self.state.split_at(n);
            self.mechanism.integrands(t, q, v, &mut self.off);
        }
        let names = self.mechanism.integrals().iter();
        let broken = names.zip(&self.integrands).filter(|(_, f)| !f.is_finite());
        let mut what: Vec<String> = broken
            .map(|(s, _)| format!("integrand of {}", s.name))
            .collect();
        let Some(last) = what.last_mut() else {
            return Ok(());
        };
        let there = Sample::of(t, &self.state).to_state();
        if let Some(cause) = lost_reactions(&self.mechanism, &there) {
            *last += &format!("; {cause}");
        }
        Err(Error::NonFinite { what })
    }
}

/// What an interval adds to an integral, and how far off the quadrature is.
struct Part {
    sum: Sum,
    error: f64,
}

/// The step in hand.
pub(super) struct Along<'a> {
    pub(super) states: &'a mut dyn States,
    /// Times of its start and its end.
    pub(super) from: f64,
    pub(super) to: f64,
    /// What the state at its end is thought to be off, if the method knows.
    pub(super) error: Option<&'a [f64]>,
}

impl Along<'_> {
    fn span(&self) -> f64 {
        self.to - self.from
    }
}
