//! What is integrated along with the motion.
//!
//! Integrals are quadratures: no equation depends on them, so they need no unknown of the solve nor of the method. Over each accepted step
//! the integrand is taken along the interpolant, whose integral has the order of the method: between its states it is off by one order
//! less than the step, and the step size makes up for that. (The error of the collocation polynomial of Radau IIA vanishes in the mean,
//! which gives order 5.) The rule is Kronrod's extension of Lobatto's of 4 points to 7 (Gander & Gautschi 2000, Adaptive quadrature
//! revisited, BIT 40, 84-101); intervals are halved until both agree to the tolerance of the run, beside the integral of the magnitude so
//! far: kinks and jumps of the integrand, which steps do not land on, are closed in so. Steps are what they are without integrals.

use crate::diagnosis::lost_reactions;
use crate::error::Error;
use crate::events::States;
use crate::integrate::sample::Sample;
use crate::mechanism::Prepared;

/// Points in [−1, 1] that are not negative, and their weights by the rule of 7 points and by that of 4, which is Lobatto's (Gander &
/// Gautschi 2000). With the ends among them a jump is seen wherever it is.
const RULE: [(f64, f64, f64); 4] = [
    (0.0, 16.0 / 35.0, 0.0),
    (0.447_213_595_499_957_9, 125.0 / 294.0, 5.0 / 6.0),
    (0.816_496_580_927_726, 72.0 / 245.0, 0.0),
    (1.0, 11.0 / 210.0, 1.0 / 6.0),
];

/// Halvings of what is integrated at once, after which it is as short as the rounding of its times.
const HALVINGS: u32 = 50;
/// An interval whose error is less than this share of it is exact.
const ROUNDING: f64 = 50.0 * f64::EPSILON;

/// The integrals of a run, and how far they are.
pub(super) struct Integrals {
    mechanism: Prepared,
    tolerance: f64,
    /// Each up to the last accepted step, and up to where the step in hand is taken, with the integral of its magnitude.
    accepted: Vec<[f64; 2]>,
    reached: Vec<[f64; 2]>,
    values: Vec<f64>,
    state: Vec<f64>,
    integrands: Vec<f64>,
}

impl Integrals {
    /// Those of `mechanism`, zero where the run starts; `None` where it has none.
    pub(super) fn new(mechanism: &Prepared, tolerance: f64) -> Option<Self> {
        let count = mechanism.integrals().len();
        (count > 0).then(|| Integrals {
            tolerance,
            accepted: vec![[0.0; 2]; count],
            reached: vec![[0.0; 2]; count],
            values: vec![0.0; count],
            state: vec![0.0; 2 * mechanism.spec().n()],
            integrands: vec![0.0; count],
            mechanism: mechanism.clone(),
        })
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.values.len()
    }

    /// A step begins where the last accepted one ended.
    pub(super) fn begin(&mut self) {
        self.reached.copy_from_slice(&self.accepted);
    }

    /// The step in hand is accepted.
    pub(super) fn accept(&mut self) {
        self.accepted.copy_from_slice(&self.reached);
    }

    /// Goes on from time `a` to `b` along these states, and returns the values there.
    pub(super) fn go(&mut self, states: &mut dyn States, a: f64, b: f64) -> Result<&[f64], Error> {
        // From the start on, so that what is added up before tells what is small.
        let mut open = vec![(a, b, HALVINGS)];
        while let Some((a, b, left)) = open.pop() {
            if a == b {
                continue;
            }
            let middle = 0.5 * (a + b);
            let parts = self.rule(states, a, b)?;
            let good = parts.iter().zip(&self.reached).all(|(part, before)| {
                part.error <= ROUNDING * part.size
                    || part.error <= self.tolerance * (before[1] + part.size)
            });
            if good || left == 0 || middle == a || middle == b {
                for (reached, part) in self.reached.iter_mut().zip(parts) {
                    *reached = [reached[0] + part.value, reached[1] + part.size];
                }
            } else {
                open.extend([(middle, b, left - 1), (a, middle, left - 1)]);
            }
        }
        let reached = self.reached.iter();
        self.values
            .iter_mut()
            .zip(reached)
            .for_each(|(value, r)| *value = r[0]);
        Ok(&self.values)
    }

    /// Both rules from `a` to `b`.
    fn rule(&mut self, states: &mut dyn States, a: f64, b: f64) -> Result<Vec<Part>, Error> {
        let (centre, half) = (0.5 * (a + b), 0.5 * (b - a));
        // By the rule of 7 and that of 4, and of the magnitude by that of 7.
        let mut sums = vec![[0.0; 3]; self.integrands.len()];
        for (k, (point, seven, four)) in RULE.into_iter().enumerate() {
            for sign in if k == 0 { &[1.0][..] } else { &[1.0, -1.0] } {
                self.at(states, centre + sign * half * point)?;
                for (sum, f) in sums.iter_mut().zip(&self.integrands) {
                    sum[0] += seven * f;
                    sum[1] += four * f;
                    sum[2] += seven * f.abs();
                }
            }
        }
        let part = |[seven, four, size]: [f64; 3]| {
            let (difference, size) = ((half * (seven - four)).abs(), half.abs() * size);
            // As QUADPACK has it (Piessens et al. 1983): the rule of more points is better than their difference.
            let error = match size > 0.0 {
                true => size * (200.0 * difference / size).powf(1.5).min(1.0),
                false => 0.0,
            };
            Part {
                value: half * seven,
                size,
                error,
            }
        };
        Ok(sums.into_iter().map(part).collect())
    }

    /// The integrands at `t`.
    fn at(&mut self, states: &mut dyn States, t: f64) -> Result<(), Error> {
        states.state(t, &mut self.state);
        let (q, v) = self.state.split_at(self.state.len() / 2);
        self.mechanism.integrands(t, q, v, &mut self.integrands);
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

/// What an interval adds to an integral.
struct Part {
    value: f64,
    /// The integral of the magnitude.
    size: f64,
    error: f64,
}
