//! Positions where constraints on velocities come to imply others, as those of two wheels that stand across.
//!
//! What such rows leave beside the others, c, is no function of positions: along a motion it goes through zero, or by it. Where it goes
//! through zero it says the same before and behind, that the motion does not go in the direction of c; so the motion goes on as it came,
//! in the one way in which its velocity is continuous.

use super::{MOST, Search, WIDEST};
use crate::integrate::Singular;
use crate::mechanism::Evaluated;
use crate::scalar::{Sloped, Slopes};
use crate::scan::{axpy, dot, largest};

/// Constraints on velocities with less than this share of a combination take no part in it; nor do velocities in what it is.
const PART: f64 = 1e-6;

/// A search has come to its place where its step is this share of the first one.
const THERE: f64 = 1e-3;

/// What is left of c there, in time along the motion, is what a straight way there makes of a bent one, if it is less than this share of
/// that way.
const BENT: f64 = 0.03;

/// c is known to so many roundings.
const KNOWN: f64 = 64.0 * f64::EPSILON;

/// What rows that all but depend on each other leave beside the others.
struct Left {
    /// By directions that these allow.
    now: Vec<f64>,
    /// Its change along the motion, in a unit of time.
    slope: Vec<f64>,
    /// Whether it has constraints on velocities in it, and is the same for all velocities.
    of_rates: bool,
}

impl Search<'_> {
    /// Where a motion with velocity `u` comes nearest to the place where c vanishes. `None` where c is of constraints on positions alone.
    pub(super) fn rates(&mut self, u: &[f64]) -> Option<Option<Singular>> {
        let mut u = u.to_vec();
        for k in 0..MOST {
            let Left {
                now,
                slope,
                of_rates,
            } = self.left(&u);
            if k == 0 && !of_rates {
                return None;
            }
            let square = dot(&slope, &slope);
            if !(square > 0.0 && square < f64::INFINITY) {
                return Some(None);
            }
            let step = -dot(&now, &slope) / square;
            let size = step.abs();
            if k == 0 {
                self.reach = size;
            }
            if size.is_nan() || size > WIDEST * self.reach {
                return Some(None);
            }
            let least = dot(&now, &now).sqrt();
            if k > 0 && size <= THERE * self.reach || least <= KNOWN {
                let open = least / square.sqrt();
                let met = open <= BENT * self.reach || least <= KNOWN;
                let cod = &self.dense.cod;
                let lost = &cod.order()[cod.rank()..];
                return Some(Some(Singular {
                    t: self.t + step,
                    gap: if met { 0.0 } else { open },
                    significance: 0.0,
                    rate: 0.0,
                    rounding: 1.0,
                    constraints: self.mech.spec().constraint_names(lost),
                }));
            }
            self.t += step;
            axpy(step, &u, &mut self.q);
            if self.settle(&u).is_none() {
                return Some(None);
            }
            u = self.allowed(&u);
            self.share();
        }
        Some(None)
    }

    /// c where the search stands, for velocities `u`.
    fn left(&mut self, u: &[f64]) -> Left {
        let spec = self.mech.spec();
        let (n, m) = (spec.n(), spec.m());
        let mut basis = vec![0.0; n * (n - self.dense.cod.rank())];
        self.dense.cod.null_space(&mut basis);
        // Directions of differentiation: along the motion, and by the size of its velocity.
        let moving = |x: f64, rates: [f64; 2]| {
            let rate = |k: usize| rates.get(k).copied().unwrap_or(0.0);
            Sloped::new(x, Slopes::new(rate))
        };
        let q: Vec<Sloped> = self
            .q
            .iter()
            .zip(u)
            .map(|(q, u)| moving(*q, [*u, 0.0]))
            .collect();
        let v: Vec<Sloped> = u.iter().map(|u| moving(*u, [0.0, *u])).collect();
        let mut terms = Evaluated::<Sloped>::new(n, m);
        terms.dynamics(&self.mech.sloped(), moving(self.t, [1.0, 0.0]), &q, &v);
        let mut parts: [Vec<Vec<f64>>; 3] = Default::default();
        for shares in &self.shares {
            let of: [&dyn Fn(&Sloped) -> f64; 3] =
                [&|a| a.re, &|a| a.eps.along(0), &|a| a.eps.along(1)];
            for (part, of) in parts.iter_mut().zip(of) {
                let columns = terms.jacobian.chunks_exact(m);
                let product = |column: &[Sloped]| {
                    let pairs = column.iter().zip(shares);
                    pairs.map(|(a, share)| of(a) * share).sum()
                };
                let mut x: Vec<f64> = columns.map(product).collect();
                self.dense.metric.divide(&mut x);
                part.push(basis.chunks_exact(n).map(|b| dot(b, &x)).collect());
            }
        }
        // Rows that are redundant everywhere leave nothing: what does is the combination that counts.
        let [now, ..] = &parts;
        let most = now.iter().max_by(|a, b| dot(a, a).total_cmp(&dot(b, b)));
        let mut combined = vec![0.0; m];
        for (shares, c) in self.shares.iter().zip(now) {
            let weight = most.map_or(0.0, |most| dot(c, most));
            axpy(weight, shares, &mut combined);
        }
        let on_rates = largest(&combined[spec.holonomic..]) > PART * largest(&combined);
        let [now, slope, by_velocity] = parts.map(|part| part.concat());
        let fixed = largest(&by_velocity) <= PART * largest(&now);
        Left {
            of_rates: on_rates && fixed,
            now,
            slope,
        }
    }
}
