//! Positions where constraints on velocities come to imply others, as those of two wheels that stand across.
//!
//! What such rows leave beside the others, c, is no function of positions: along a motion it goes through zero, or by it. Where it goes
//! through zero it says the same before and behind, that the motion does not go in the direction of c; so the motion goes on as it came,
//! in the one way in which its velocity is continuous. Where it goes by, c turns about in next to no time, and the motion with it. One
//! direction is left to c where there is one freedom without it: then it goes through zero. Else rounding decides, as for positions.

use super::{GAP, MOST, Search, WIDEST, ZERO};
use crate::integrate::Singular;
use crate::mechanism::Evaluated;
use crate::scalar::{Sloped, Slopes};
use crate::scan::{axpy, dot, largest};

/// Constraints on velocities with less than this share of a combination take no part in it; nor do velocities in what it is.
const PART: f64 = 1e-6;

/// A step that leaves more than this share of c has come to where it is least.
const LESS: f64 = 0.5;

/// Directions in which c is differentiated.
const DIRECTIONS: usize = 6;

/// What rows that all but depend on each other leave beside the others.
struct Left {
    /// The amount by directions that the other rows allow.
    now: Vec<f64>,
    /// The change of the amount along the motion, in a unit of time.
    slope: Vec<f64>,
    /// What rounding of coordinates and time makes of it.
    known: f64,
    /// Whether it has constraints on velocities in it, and is the same for all velocities.
    of_rates: bool,
}

impl Search<'_> {
    /// The place where a motion with velocity `u` comes nearest to where c vanishes, which is of as many rows as `count`. `None` where it
    /// is of constraints on positions alone, or may be of some beside others.
    pub(super) fn rates(&mut self, u: &[f64], count: usize) -> Option<Option<Singular>> {
        let spec = self.mech.spec();
        if spec.holonomic == spec.m() || count > 1 && spec.holonomic > 0 {
            return None;
        }
        let mut u = u.to_vec();
        let mut before = f64::INFINITY;
        for k in 0..MOST {
            let Left {
                now,
                slope,
                known,
                of_rates,
            } = self.left(&u);
            if k == 0 && !of_rates {
                return None;
            }
            let steep = dot(&slope, &slope).sqrt();
            if !(steep > 0.0 && steep < f64::INFINITY) {
                return Some(None);
            }
            let step = -dot(&now, &slope) / (steep * steep);
            let size = step.abs();
            if k == 0 {
                self.reach = size;
            }
            if size.is_nan() || size > WIDEST * self.reach {
                return Some(None);
            }
            let least = dot(&now, &now).sqrt();
            let met = least <= ZERO * known;
            if met || least > LESS * before {
                let freedoms = self.q.len() - self.dense.cod.rank();
                let gap = if met || freedoms == 1 {
                    0.0
                } else if least <= GAP * known {
                    f64::NAN
                } else {
                    least / steep
                };
                return Some(Some(self.met(gap)));
            }
            before = least;
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
        // Directions of differentiation: along the motion, by the size of its velocity, by that of the time, and by those of the
        // coordinates with several signs.
        let moving = |x: f64, rates: [f64; DIRECTIONS]| {
            let rate = |k: usize| rates.get(k).copied().unwrap_or(0.0);
            Sloped::new(x, Slopes::new(rate))
        };
        let pairs = self.q.iter().zip(u).enumerate();
        let q = pairs.map(|(i, (q, u))| {
            let signed = |period: usize| {
                if (i / period).is_multiple_of(2) {
                    *q
                } else {
                    -q
                }
            };
            moving(*q, [*u, 0.0, 0.0, *q, signed(1), signed(2)])
        });
        let q: Vec<Sloped> = q.collect();
        let v = u.iter().map(|u| moving(*u, [0.0, *u, 0.0, 0.0, 0.0, 0.0]));
        let v: Vec<Sloped> = v.collect();
        let t = moving(self.t, [1.0, 0.0, self.t, 0.0, 0.0, 0.0]);
        let mut terms = Evaluated::<Sloped>::new(n, m);
        terms.dynamics(&self.mech.sloped(), t, &q, &v);
        let left = |part: &dyn Fn(&Sloped) -> f64| -> Vec<Vec<f64>> {
            let of = |shares: &Vec<f64>| {
                let columns = terms.jacobian.chunks_exact(m);
                let product = |column: &[Sloped]| {
                    let pairs = column.iter().zip(shares);
                    pairs.map(|(a, share)| part(a) * share).sum()
                };
                self.along(columns.map(product).collect(), &basis)
            };
            self.shares.iter().map(of).collect()
        };
        let now = left(&|a| a.re);
        let [slope, by_velocity, by_time, sizes @ ..] =
            [0, 1, 2, 3, 4, 5].map(|k| left(&|a| a.eps.along(k)).concat());
        // Rows that are redundant everywhere leave nothing: what does is the combination that counts.
        let most = now.iter().max_by(|a, b| dot(a, a).total_cmp(&dot(b, b)));
        let mut combined = vec![0.0; m];
        for (shares, c) in self.shares.iter().zip(&now) {
            let weight = most.map_or(0.0, |most| dot(c, most));
            axpy(weight, shares, &mut combined);
        }
        let on_rates = largest(&combined[spec.holonomic..]) > PART * largest(&combined);
        let now = now.concat();
        let fixed = largest(&by_velocity) <= PART * largest(&now);
        // Rows count as one.
        let rounded = sizes.iter().map(|x| largest(x)).fold(0.0, f64::max);
        Left {
            of_rates: on_rates && fixed,
            known: f64::EPSILON * (1.0 + largest(&by_time) + rounded),
            now,
            slope,
        }
    }
}
