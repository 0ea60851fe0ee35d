//! Newton's method, lane by lane: one iteration for all ways onto the constraints, which differ in where their steps come from.

use super::acceptance::{Acceptance, ROUNDING, STALLED, Size};
use super::level::{At, Level};
use crate::dense::Dense;
use crate::lanes::Lanes;
use crate::noise::Noise;
use crate::scan::{largest, sum};
use crate::spec::Spec;

/// Buffers of the method: what is known at a place, and the step from there.
#[derive(Debug, Clone)]
pub(crate) struct Newton<L> {
    pub(crate) residual: Vec<L>,
    /// The largest of them.
    pub(super) off: L,
    /// A, all rows.
    pub(crate) jacobian: Vec<L>,
    pub(super) step: Vec<L>,
    pub(crate) acceptance: Acceptance<L>,
}

/// The place that steps are computed from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Steps {
    /// Newton's method: from the place itself.
    Here,
    /// Another place, from which steps converge linearly: for one at a distance h as h^k. What is left each time would add up in such a
    /// method, so steps go on for as long as they fall.
    Elsewhere,
}

impl Steps {
    /// How many there are at most (what has not converged after eight is too far off for a method without a safeguard); what does not
    /// divide a step by how much does not converge; and the share of itself by which the last step changes every coordinate at most.
    ///
    /// A step of a share of 1e-9 leaves residuals of second order, a share of 1e-18 of the coordinates, below ε even where the lengths in
    /// a constraint are a hundredth of the coordinates. Where the constraints are linear in what is changed only rounding remains, of
    /// which the elimination may have made a thousand ε of the change.
    fn rule<L: Lanes>(self, at: &At<'_, L>) -> (usize, f64, f64) {
        match self {
            Steps::Here if at.linear() => (8, 0.1, 1e-3),
            Steps::Here => (8, 0.1, 1e-9),
            Steps::Elsewhere => (50, 0.5, 0.0),
        }
    }
}

fn zero<L: Lanes>() -> L {
    L::from_f64(0.0)
}

/// 1 in the lanes where a ≤ b and `mask` is 1, 0 in the others.
fn le<L: Lanes>(a: L, b: L, mask: L) -> L {
    L::select_le(a, b, mask, zero())
}

/// Whether `mask` is not 0 in every lane.
fn any<L: Lanes>(mask: L) -> bool {
    (0..L::WIDTH).any(|k| mask.lane(k) != 0.0)
}

impl<L: Lanes> Newton<L> {
    pub(crate) fn new(spec: &Spec) -> Self {
        let (n, m) = (spec.n(), spec.m());
        let zeros = |len: usize| vec![zero(); len];
        Newton {
            residual: zeros(m),
            off: zero(),
            jacobian: zeros(m * n),
            step: zeros(n),
            acceptance: Acceptance::new(m),
        }
    }

    /// Moves `x` onto the constraints in the lanes where `left` is 1 (and not 0), by at most `most` steps. At each place `look` gives two
    /// such masks: of the lanes that have arrived, and of those with a step to take, which is then in `step`. Returns the lanes that have
    /// arrived, and the number of steps in each.
    pub(super) fn iterate(
        &mut self,
        at: &At<'_, L>,
        x: &mut [L],
        mut left: L,
        mut most: usize,
        mut look: impl FnMut(&mut Self, &[L], L) -> (L, L),
    ) -> (L, L) {
        let (mut good, mut count, half) = (zero(), zero(), L::from_f64(0.5));
        self.acceptance.size = self.acceptance.measured(x);
        loop {
            self.evaluate(at, x);
            let (met, go) = look(self, x, left);
            (good, left) = (good + met, go);
            if most == 0 || !any(left) {
                return (good, count);
            }
            let pairs = x.iter_mut().zip(&self.step);
            if any(L::from_f64(1.0) - left) {
                pairs.for_each(|(x, d)| *x = L::select_le(half, left, *x + *d, *x));
            } else {
                pairs.for_each(|(x, d)| *x = *x + *d);
            }
            (count, most) = (count + left, most - 1);
        }
    }

    /// Moves `x` by steps that need no matrix, for all lanes at once, and that tell by their size where they end. `make` makes them, and
    /// their certificate. Returns the lanes that have arrived, those where steps no longer became smaller, and the number of steps in each.
    pub(super) fn direct(
        &mut self,
        at: &At<'_, L>,
        x: &mut [L],
        wanted: L,
        steps: Steps,
        mut make: impl FnMut(&mut Self, &[L]) -> L,
    ) -> (L, L, L) {
        let (most, progress, trusted) = steps.rule(at);
        let exact = trusted == 0.0;
        let (half, rounding) = (L::from_f64(0.5), L::from_f64(ROUNDING));
        // Sizes of the last step, and of the residual before it; the lanes where it was to be the last.
        let (mut previous, mut before) = (L::from_f64(f64::INFINITY), zero());
        let (mut last, mut stalled) = (zero(), zero());
        let (good, count) = self.iterate(at, x, wanted, most, |newton, x, left| {
            let mut met = le(newton.off, before, left * last);
            if !any(left - met) {
                return (met, zero());
            }
            // What is not finite makes the certificate NaN.
            let safe = make(newton, x) + zero::<L>() * sum(&newton.step);
            let go = le(half, safe, left - met);
            let acceptance = &newton.acceptance;
            let change = acceptance.largest(&newton.step);
            let falls = le(change, L::from_f64(progress) * previous, go);
            let small = le(change, rounding * acceptance.size.largest, go);
            if any(small) {
                // Where rounding alone is left: as |φ_c| ≤ Σ|A_cj Δ_j|, Δ at the rounding of x has φ at rounding level.
                let beyond = acceptance.excess(&newton.step, x, rounding, exact);
                let within = le(beyond, zero(), small);
                let rest = small - within;
                met = met + within;
                if any(rest) && exact {
                    met = met + (rest - le(half, falls, rest));
                } else if any(rest) {
                    // The rows say it more exactly, but cost more than a step.
                    newton.weigh(at, x);
                    let strict = newton.acceptance.strict(&newton.residual[..at.rows()]);
                    met = met + le(half, strict, rest);
                }
            }
            let go = le(met, zero(), go);
            stalled = go - le(half, falls, go);
            if !exact {
                let trusted = L::from_f64(trusted);
                let beyond = newton.acceptance.excess(&newton.step, x, trusted, exact);
                last = le(beyond, zero(), go);
            }
            (previous, before) = (change, newton.off);
            (met, go - stalled)
        });
        let met = self.meets_redundant(at, x, good);
        (met, stalled + (good - met), count)
    }

    /// The lanes of `good` where the constraints that an elimination may leave out are met too: no step tells of them.
    fn meets_redundant(&mut self, at: &At<'_, L>, x: &[L], good: L) -> L {
        let rows = at.mech.spec().structure.solve.redundant;
        let mut rows = rows.iter().filter(|row| **row < at.rows()).peekable();
        if rows.peek().is_none() || !any(good) {
            return good;
        }
        self.weigh(at, x);
        rows.fold(good, |met, row| {
            let (residual, bound) = (self.residual[*row], self.acceptance.bound(*row));
            le(residual.abs(), bound, met)
        })
    }

    /// Moves `x` by steps of the emitted elimination, and returns what [`direct`](Newton::direct) does.
    pub(super) fn eliminate(&mut self, at: &At<'_, L>, x: &mut [L], wanted: L) -> (L, L, L) {
        self.direct(at, x, wanted, Steps::Here, |newton, x| {
            at.correction(x, &newton.residual, &mut newton.step)
        })
    }

    /// Projects q, then q̇, by the emitted elimination, in the lanes where `wanted` is 1 (and not 0). Returns 1 for those that are
    /// consistent then, and the number of steps in each.
    #[cfg(feature = "ensemble")]
    pub(crate) fn project(
        &mut self,
        mech: &crate::mechanism::Prepared<L>,
        t: L,
        [q, v]: [&mut [L]; 2],
        wanted: L,
    ) -> (L, L) {
        let (mut good, mut count) = (wanted, zero());
        for level in [Level::Position, Level::Velocity] {
            let (x, other) = match level {
                Level::Position => (&mut *q, &*v),
                Level::Velocity => (&mut *v, &*q),
            };
            let at = At::new(mech, level, t, other);
            if at.rows() > 0 && !at.straight_line() {
                good = zero();
            } else if at.rows() > 0 {
                let (arrived, _, steps) = self.eliminate(&at, x, good);
                (good, count) = (arrived, count + steps);
            }
        }
        (good, count)
    }

    /// Takes the residuals at `x`.
    #[inline]
    pub(crate) fn evaluate(&mut self, at: &At<'_, L>, x: &[L]) {
        at.residual(x, &mut self.residual);
        self.off = largest(&self.residual[..at.rows()]);
    }

    /// Takes A and the sizes of the constraints' terms at `x`.
    pub(super) fn weigh(&mut self, at: &At<'_, L>, x: &[L]) {
        at.jacobian(x, &mut self.jacobian);
        let pattern = at.mech.spec().structure.jacobian_pattern;
        self.acceptance.weigh(pattern, &self.jacobian, x);
    }
}

impl Newton<f64> {
    /// Takes what rounding the residuals at `x` carry, of which A is known: coordinates are known to rounding of `size`, or of what is
    /// larger of the others. Constraints that imply each other, which factors know, share theirs; in assembly a row of A that is nothing
    /// but rounding, where a rod has no length, say, has no direction.
    pub(super) fn measure(
        &mut self,
        at: &At<'_, f64>,
        x: &[f64],
        noise: &mut Noise,
        factors: Option<&mut Dense>,
    ) {
        let size = self.acceptance.size.larger(self.acceptance.measured(x));
        let least = at.level.state(size, self.acceptance.measured(at.other));
        self.rounding(at, x, noise, Some(least.into()));
        let Acceptance {
            ease,
            held,
            rounding,
            ..
        } = &mut self.acceptance;
        if !ease.is_empty() {
            noise.clear(&mut self.jacobian, STALLED, held);
        }
        if let Some(factors) = factors {
            factors.share(&mut rounding[..at.rows()]);
        }
    }

    /// Takes what rounding the residuals at `x` carry, with coordinates and velocities that are known to rounding of the sizes
    /// `least`, if any.
    pub(super) fn rounding(
        &mut self,
        at: &At<'_, f64>,
        x: &[f64],
        noise: &mut Noise,
        least: Option<[Size<f64>; 2]>,
    ) {
        let (acceptance, state) = (&mut self.acceptance, at.level.state(x, at.other).into());
        noise.go(at.mech, at.t, state, |j| {
            least.map_or([0.0; 2], |sizes| {
                sizes.map(|size| acceptance.least(size, j))
            })
        });
        let rounding = &mut acceptance.rounding;
        match at.level {
            Level::Position => noise.residual(rounding),
            Level::Velocity => noise.residual_rate(rounding),
        }
    }

    /// The constraints, of which all is known, whose residuals would not do even where no step makes them less.
    pub(super) fn violated(&self, at: &At<'_, f64>) -> impl Iterator<Item = usize> {
        self.acceptance.violated(0..at.rows(), &self.residual)
    }
}
