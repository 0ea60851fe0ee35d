//! What rounding makes of steps: how much of it they are granted, and where the motion is lost in it.

use super::{Driver, Refusal};
use crate::error::Error;
use crate::integrate::sample::Sample;
use crate::integrate::scheme::Equations;
use crate::integrate::sums::error_norm;
use crate::integrate::trouble::{Cause, Trouble};
use crate::rounding::beside;
use crate::scan::place_of_largest;

/// Attempts from one measurement of rounding to the next, and where steps are nearly lost in the rounding of the time: it takes as many
/// evaluations as one of them.
pub(super) const SELDOM: usize = 1000;
pub(super) const OFTEN: usize = 5;

/// Steps have got shorter by this share since it was measured where there may be more of it.
const SHRUNK: f64 = 1.0 / 32.0;

/// Roundings of the time over which a difference is nothing but that of accelerations.
pub(super) const CLEARLY: f64 = 1024.0;

/// Most that the stages of a step make of the rounding of one of them in the estimate of its error.
const STAGES: f64 = 1.5;
/// The most that stages make of rounding that was found at some states only, with room for steps to grow: they do below 0.6 of what is
/// granted.
const SAMPLED: f64 = 2.5;

/// Times that are so many times as far from zero as from the start of the run are late.
const AFTER: f64 = 100.0;

/// Rounding may make so many times the tolerance of a step, or this share of the motion, before the run is no longer that motion.
const MOST: f64 = 10.0;
pub(super) const LOST: f64 = 1e-6;

/// What rounding of a state makes of velocities in a unit of time.
#[derive(Default)]
pub(super) struct Noise {
    /// The size of it in the error norm.
    pub(super) own: f64,
    /// The largest of it in any component, over what that is allowed at rest; and which one.
    most: f64,
    /// Both of these numbers for the part of the mechanism that each coordinate belongs to.
    grants: Vec<[f64; 2]>,
    worst: usize,
    /// Rounding of the time, where most of that is of it.
    time: Option<f64>,
    /// The part of it, in the error norm, that the estimate of an error need not show.
    hidden: f64,
}

/// What rounding makes of velocities in a unit of time, component by component.
struct Rounding {
    all: Vec<f64>,
    /// The part of it that does not show in the estimate of an error, being the same beside a state.
    hidden: Vec<f64>,
    /// The part of it that is of the time.
    of_time: Vec<f64>,
}

impl Driver<'_> {
    /// Takes the tolerance of a step of size `h`: that of the run, or what a position nearby or rounding allow.
    pub(super) fn grant(&mut self, h: f64) {
        let start = Sample::of(self.equations.course.now.t, self.scheme.start());
        let (tolerance, run) = (&mut self.tolerance, &self.settings.tolerance);
        let changed = self.passage.ease(tolerance, run, start.v);
        let before = std::mem::replace(&mut self.granted, self.noise.own * h.abs() > 1.0);
        if !self.granted {
            if changed || before {
                self.scheme.tolerate(tolerance);
            }
            return;
        }
        // So many times its tolerance for each component, but no more beside it than the largest rounding in any: of its part of the
        // mechanism, as of the others' rounding it knows nothing.
        let grants = self.noise.grants.iter().cycle();
        self.raised.clone_from(tolerance);
        let floors = self.raised.floors.iter_mut().zip(self.scheme.start());
        for ((floor, y), grant) in floors.zip(grants) {
            let [own, most] = grant.map(|noise| noise * h.abs());
            let more = (own * (*floor + y.abs()) - y.abs()).min(most * *floor);
            *floor = floor.max(more);
        }
        self.scheme.tolerate(&self.raised);
    }

    /// Refuses a step whose `error`, in units of the tolerance, is rounding and too large a share of the motion.
    pub(super) fn weigh(&mut self, error: f64, h: f64) -> Result<(), Refusal> {
        if self.lost(error, h).is_none() {
            return Ok(());
        }
        // What it is here, and not some steps ago.
        self.measure(0);
        let Some(share) = self.lost(error, h) else {
            return Ok(());
        };
        if error > self.noise.own * h.abs() {
            return Err(Refusal::Inaccurate(error));
        }
        let coordinate = self.equations.problem.coordinate(self.noise.worst);
        let time = self.noise.time;
        let error = Error::Rounding {
            coordinate,
            share,
            time,
        };
        let here = Sample::of(self.equations.course.now.t, self.scheme.start());
        Err(Refusal::Undecided(Box::new(Trouble::new(here, error))))
    }

    /// Which share of the motion is lost in a step of size `h` with this error, in units of the tolerance, if it is too large.
    fn lost(&self, error: f64, h: f64) -> Option<f64> {
        let all = error.max(self.noise.hidden * h.abs());
        let share = || self.share(all, h);
        (all > MOST).then(share).filter(|share| *share > LOST)
    }

    /// Which share of the motion an error is, in units of the tolerance, of which a step of size `h` is granted the rounding: of the motion
    /// of each coordinate, but for those of one kind, which have no size of their own; of these of the fastest.
    fn share(&self, error: f64, h: f64) -> f64 {
        let run = &self.settings.tolerance;
        if !self.equations.problem.is_even() {
            return run.relative * error;
        }
        let y = self.scheme.start();
        let velocities = y.iter().zip(&run.floors).skip(y.len() / 2);
        let fastest = velocities.fold(1.0_f64, |most, (v, floor)| most.max(v.abs() / floor));
        run.relative * error.min(self.noise.most * h.abs() / fastest)
    }

    /// Measures the rounding of accelerations, once in `seldom` attempts: what an error of ε in the time makes of them, and one of ε in all
    /// coordinates and velocities. That shows the rounding of whatever they are computed by, too.
    pub(super) fn measure(&mut self, seldom: usize) {
        let Equations { course, .. } = &self.equations;
        let (s, attempts) = (course.now.s, course.attempts);
        let t = course.now.t.abs();
        if self.measured.is_none_or(|last| attempts < last + seldom) {
            return;
        }
        self.measured = Some(attempts);
        self.longest = course.h.abs();
        let Ok(Rounding {
            all,
            hidden,
            of_time,
        }) = self.rounding(s)
        else {
            return;
        };
        let tolerance = &self.settings.tolerance;
        let pairs = all.iter().zip(&tolerance.floors[all.len()..]);
        let shares: Vec<f64> = pairs.map(|(x, floor)| x / floor).collect();
        let worst = place_of_largest(&shares);
        let most = shares[worst] / tolerance.relative;
        let late = t > AFTER * s.abs() && of_time[worst] > 0.5 * all[worst];
        let noise = Noise {
            own: self.norm(&all),
            most,
            grants: self.grants(&all, &shares),
            hidden: self.norm(&hidden),
            worst,
            time: late.then_some(f64::EPSILON * t),
        };
        if noise.own.is_finite() && most.is_finite() {
            self.noise = noise;
        }
    }

    /// The rounding of each coordinate's part of the mechanism, from that of `all` coordinates, and from these over what they are allowed
    /// at rest: in the error norm of the part alone, and the largest.
    fn grants(&self, all: &[f64], shares: &[f64]) -> Vec<[f64; 2]> {
        let (tolerance, n) = (&self.settings.tolerance, all.len());
        let v = &self.scheme.start()[n..];
        let parts = self.equations.problem.parts();
        let part = |i: usize| parts.get(i).copied().unwrap_or(0);
        // Of each part, by its first coordinate: squares, how many there are, the largest.
        let mut sums = vec![[0.0_f64; 3]; n];
        for (i, x) in all.iter().enumerate() {
            let [squares, count, most] = &mut sums[part(i)];
            let weighted = x / tolerance.at(n + i, v[i].abs());
            *squares += weighted * weighted;
            // Its position counts, too.
            *count += 2.0;
            *most = most.max(shares[i]);
        }
        let grant = |i: usize| {
            let [squares, count, most] = sums[part(i)];
            [(squares / count).sqrt(), most / tolerance.relative]
        };
        (0..n).map(grant).collect()
    }

    /// Measures it after a step of size `h` where steps have got shorter, and accelerations have part of it now that does not show in
    /// errors.
    pub(super) fn uncover(&mut self, h: f64) {
        self.longest = self.longest.max(h.abs());
        if h.abs() >= SHRUNK * self.longest {
            return;
        }
        self.longest = h.abs();
        if self.equations.problem.blur() > 0.0 {
            self.measure(0);
        }
    }

    /// Errors of velocities in the error norm, in units of the tolerance.
    fn norm(&self, errors: &[f64]) -> f64 {
        let (q, v) = self.scheme.start().split_at(errors.len());
        let still = q.iter().map(|q| (0.0, *q, *q));
        let moved = errors.iter().zip(v).map(|(x, v)| (*x, *v, *v));
        error_norm(still.chain(moved), &self.settings.tolerance)
    }

    /// What rounding makes of the estimate of a step's error, in a unit of time.
    fn rounding(&mut self, s: f64) -> Result<Rounding, Cause> {
        let y = self.scheme.start();
        let n = y.len() / 2;
        let (mut now, mut there) = (vec![0.0; n], vec![0.0; n]);
        self.equations.acceleration(s, y, &mut now)?;
        let blur = self.equations.problem.blur();
        let hidden: Vec<f64> = now.iter().map(|x| blur * x.abs()).collect();
        let (mut all, mut of_time) = (hidden.clone(), vec![0.0; n]);
        if !self.explicit {
            return Ok(Rounding {
                all,
                hidden,
                of_time,
            });
        }
        // Late in a run from a late start all that depends on time is known no better.
        let ulp = f64::EPSILON * self.equations.at(s, y).t.abs();
        (self.equations).acceleration(s + CLEARLY * ulp, y, &mut there)?;
        let pairs = of_time.iter_mut().zip(now.iter().zip(&there));
        pairs.for_each(|(x, (now, later))| *x = STAGES * (later - now).abs() / CLEARLY);
        let mut most = vec![0.0_f64; n];
        for moved in beside(y) {
            self.equations.acceleration(s, &moved, &mut there)?;
            let pairs = most.iter_mut().zip(there.iter().zip(&now));
            pairs.for_each(|(most, (there, now))| *most = most.max((there - now).abs()));
        }
        let parts = all.iter_mut().zip(of_time.iter().zip(most));
        parts.for_each(|(all, (of_time, most))| *all += of_time + SAMPLED * most);
        Ok(Rounding {
            all,
            hidden,
            of_time,
        })
    }
}
