//! Postures on the curve.

use nalgebra::DVector;

use super::curve::{Curve, End, Path, Place, Rows};
use super::sweep::{STILL, stuck};
use crate::assemble::State;
use crate::error::Error;
use crate::inverse::Posture;
use crate::manifold::{At, Level, Manifold};
use crate::scalar::{Scalar, Sloped, Slopes};

/// The part of what is usual below which rows tell that branches cross nearby, and rounding grows by the third power of the inverse.
const NEAR: f64 = 1e-2;
/// A value near such a place is the mean of those at places on both sides, so far away, as a part of a radius of curvature,
const ASIDE: f64 = 3e-2;
/// each pair with its share, which makes the error one of eighth order; its own distance is so many times that.
const SHARES: [f64; 4] = [1.6, -0.8, 8.0 / 35.0, -1.0 / 35.0];

/// So often at most half as far, until all of them lie on one branch, where their tangents turn by less than an angle with this cosine, and
/// two means agree up to this part.
const HALVINGS: usize = 7;
const ALONG: f64 = 0.95;
const SAME: f64 = 1e-5;

impl Curve<'_> {
    /// The posture at the part `s` of the sweep, on the piece of `path` behind its place number `index`; `None` where the drive stands
    /// still.
    ///
    /// # Errors
    /// [`Error::At`] with [`Error::OffConstraint`] where not all constraints are met, and with [`Error::NonFinite`].
    pub(super) fn posture(
        &self,
        path: &Path,
        index: usize,
        s: f64,
    ) -> Result<Option<Posture>, Error> {
        let [a, b] = [&path.places[index], &path.places[index + 1]];
        let guess = self.guess(a, b, s);
        if self.rows(&guess, guess.len() - 1).margin >= NEAR * self.margin {
            let (q, rows) = self.position(guess, s)?;
            return Ok(self.moved(q, s, &a.way, &rows));
        }
        let (mut aside, mut before) = (ASIDE * path.radius, None);
        let step = |aside: f64| aside * a.speed() * self.units[guess.len() - 1];
        let reach = |aside: f64| SHARES.len() as f64 * step(aside);
        let crosses = |k: &usize| (path.places[*k].s() - s).abs() <= reach(aside).abs();
        let crosses = path.crossings.iter().any(crosses);
        for _ in 0..HALVINGS {
            let mean = match self.around([a, b], s, reach(aside)) {
                Some(places) => self.mean(&places, s, step(aside))?,
                None => None,
            };
            if let (Some(now), Some(then)) = (&mean, &before)
                && self.agree(now, then)
            {
                return Ok(mean);
            }
            before = mean;
            aside *= 0.5;
        }
        if crosses {
            let q = guess.as_slice()[..guess.len() - 1].to_vec();
            return Err(stuck(self, State::at_rest(self.time_at(s), q)));
        }
        // The curve turns sharply, where branches all but cross.
        let (q, rows) = self.position(guess, s)?;
        Ok(self.moved(q, s, &a.way, &rows))
    }

    /// Places along the curve as far as `reach` on both sides of `s`, which is between `a` and `b`; `None` if it does not go on so far.
    fn around(&self, [a, b]: [&Place; 2], s: f64, reach: f64) -> Option<Vec<Place>> {
        let follow = |from: &Place, until: f64| {
            let path = self.follow(from.clone(), until);
            (path.end == End::Arrived).then_some(path.places)
        };
        let back = |mut place: Place| {
            place.way.neg_mut();
            place
        };
        let behind = follow(&back(a.clone()), s - reach)?;
        let ahead = follow(b, s + reach)?;
        Some(behind.into_iter().rev().map(back).chain(ahead).collect())
    }

    /// Whether two means are the same but for small errors, of which that of the nearer one is far smaller.
    fn agree(&self, a: &Posture, b: &Posture) -> bool {
        let most = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b).zip(self.units.iter());
            pairs.fold(0.0, |s: f64, ((a, b), unit)| s.max(((a - b) / unit).abs()))
        };
        let zero = vec![0.0; a.acceleration.len()];
        let speed = most(&a.state.v, &zero);
        let turn = speed * speed / self.scale();
        most(&a.state.v, &b.state.v) <= SAME * speed
            && most(&a.acceleration, &b.acceleration)
                <= SAME * (turn + most(&a.acceleration, &zero))
    }

    /// The mean of postures on both sides of `s`, in steps of `step`, if they lie on one branch, with these `places` along it.
    fn mean(&self, places: &[Place], s: f64, step: f64) -> Result<Option<Posture>, Error> {
        let n = self.mech.spec().n();
        let [first, .., last] = places else {
            return Ok(None);
        };
        let mut mean = Posture {
            state: State::at_rest(self.time_at(s), vec![0.0; n]),
            acceleration: vec![0.0; n],
        };
        for (k, share) in SHARES.iter().enumerate() {
            for side in [1.0, -1.0] {
                let there = s + side * (k + 1) as f64 * step;
                let mut pieces = places.windows(2);
                let piece = pieces.find(|piece| (piece[1].s() - there) * step >= 0.0);
                let [a, b] = piece.unwrap_or(&places[places.len() - 2..]) else {
                    return Ok(None);
                };
                let guess = self.guess(a, b, there);
                let (q, rows) = self.position(guess, there)?;
                let (Some(posture), Some(way)) =
                    (self.moved(q, there, &a.way, &rows), rows.along(&a.way))
                else {
                    return Ok(None);
                };
                if way.dot(&first.way) < ALONG || way.dot(&last.way) < ALONG {
                    return Ok(None);
                }
                let add = |sum: &mut Vec<f64>, part: &[f64]| {
                    let pairs = sum.iter_mut().zip(part);
                    pairs.for_each(|(sum, x)| *sum += 0.5 * share * x);
                };
                add(&mut mean.state.q, &posture.state.q);
                add(&mut mean.state.v, &posture.state.v);
                add(&mut mean.acceleration, &posture.acceleration);
            }
        }
        self.prescribe(&mut mean.state.q, s);
        Ok(Some(mean))
    }

    /// Gives prescribed coordinates their values.
    fn prescribe(&self, q: &mut [f64], s: f64) {
        for (j, begin, gain) in &self.fixed {
            q[*j] = begin + gain * s;
        }
    }

    /// A guess of the place where the piece from `a` to `b` has the part `s` of the sweep.
    fn guess(&self, a: &Place, b: &Place, s: f64) -> DVector<f64> {
        let (n, chord) = (self.mech.spec().n(), b.s() - a.s());
        let length = (&b.x - &a.x).component_div(&self.units).norm();
        let [first, last] = [a, b].map(|place| length * place.speed() * self.units[n]);
        // Of the cubic only s, while it is searched for.
        let s_at = |p: f64| {
            let rest = 1.0 - p;
            a.s() + p * p * (3.0 - 2.0 * p) * chord + p * rest * (rest * first - p * last)
        };
        let (mut low, mut high) = (0.0, 1.0);
        while high - low > 1e-9 {
            let middle = 0.5 * (low + high);
            match (s_at(middle) - s) * chord.signum() < 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        self.between(a, b, low).0
    }

    /// Coordinates at the part `s` of the sweep next to `guess`, and the rows there.
    fn position(&self, guess: DVector<f64>, s: f64) -> Result<(Vec<f64>, Rows), Error> {
        let n = guess.len() - 1;
        let mut q = guess.as_slice()[..n].to_vec();
        let (t, rest) = (self.time_at(s), vec![0.0; n]);
        // By the rows that were independent at the start, then by all.
        self.prescribe(&mut q, s);
        if let Some(x) = self.solved(DVector::from_vec(q.clone()).insert_row(n, s), true) {
            q.copy_from_slice(&x.as_slice()[..n]);
            self.prescribe(&mut q, s);
        }
        let ease = self.units.as_slice()[..n].to_vec();
        let held = self.fixed.iter().map(|(j, ..)| *j).collect();
        let mut manifold = Manifold::with_ease(self.mech, (t, &q, &rest), |_| ease, held);
        let at = At::new(self.mech, Level::Position, t, &rest);
        if let Err(error) = manifold.project(&at, &mut q) {
            return Err(State { t, q, v: rest }.locate(error));
        }
        let x = DVector::from_column_slice(&q).insert_row(n, s);
        let rows = self.rows(&x, n);
        Ok((q, rows))
    }

    /// Velocities and accelerations at `q`, in the direction `way`.
    fn moved(&self, q: Vec<f64>, s: f64, way: &DVector<f64>, rows: &Rows) -> Option<Posture> {
        let n = q.len();
        let way = rows.along(way).filter(|way| way[n].abs() > STILL)?;
        let way = way.component_mul(&self.units);
        let v: Vec<f64> = (0..n).map(|j| way[j] / way[n] * self.speed).collect();
        let t = self.time_at(s);
        let acceleration = rows.shortest(&-self.turned(t, &q, &v, self.time.1 * self.speed));
        let acceleration = acceleration.component_mul(&self.units);
        let rest = acceleration[n] / way[n];
        let acceleration = (0..n).map(|j| acceleration[j] - rest * way[j]);
        Some(Posture {
            acceleration: acceleration.collect(),
            state: State { t, q, v },
        })
    }

    /// φ̈ − A q̈ of each row, where the time goes on by `pace` in a second.
    fn turned(&self, t: f64, q: &[f64], v: &[f64], pace: f64) -> DVector<f64> {
        let (spec, sloped) = (self.mech.spec(), self.mech.sloped());
        let along = |slope: f64| Slopes::new(|k| if k == 0 { slope } else { 0.0 });
        let plain = |x: &f64| Sloped::from_f64(*x);
        let pairs = q.iter().zip(v);
        let q: Vec<Sloped> = pairs.map(|(q, v)| Sloped::new(*q, along(*v))).collect();
        let (t, v): (_, Vec<Sloped>) = (Sloped::new(t, along(pace)), v.iter().map(plain).collect());
        let rest = vec![Sloped::from_f64(0.0); q.len()];
        let mut rates = [(); 2].map(|()| vec![Sloped::from_f64(0.0); spec.m()]);
        sloped.residual_rate(t, &q, &v, &mut rates[0]);
        sloped.residual_rate(t, &q, &rest, &mut rates[1]);
        let mut turned = DVector::zeros(spec.holonomic + self.fixed.len());
        for c in 0..spec.holonomic {
            // φ̇ = A q̇ + ∂φ/∂t, with the time at its own pace.
            turned[c] = rates[0][c].eps.along(0) + (pace - 1.0) * rates[1][c].eps.along(0);
        }
        turned
    }
}
