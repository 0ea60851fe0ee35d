//! Two coordinates that are alone in a constraint, turned into the direction that it prescribes and the one that it leaves free.
//!
//! With a = (a₁, a₂) what the constraint a q̈ = b has of them, and M₂ = [m₁ m₁₂; m₁₂ m₂] their inertia, the directions
//!
//! ```text
//! t = (a₂, −a₁)      n = M₂⁻¹aᵀ/(a M₂⁻¹ aᵀ) = (a₁ m₂ − a₂ m₁₂, a₂ m₁ − a₁ m₁₂)/D      D = tᵀ M₂ t = a₁² m₂ − 2 a₁ a₂ m₁₂ + a₂² m₁
//! ```
//!
//! are orthogonal in M₂, and a n = 1. So q̈ = b n + w t: the constraint is met whatever w is, and w, of inertia D, stands for the two from
//! then on. Neither coefficient is divided by: a rod about a fixed point has this pivot at any angle. What a coupler then has of two such
//! rods are two coefficients again, and it is turned in its turn: leaf by leaf that is the null space of all of them. For K it is a
//! congruence, whatever M₂ is, if it is definite.
//!
//! The length of t is free. Between coordinates as declared, where nothing waits for it, t is divided by |a|², so that rods leave
//! coefficients of the order of 1, whatever units they are in; in a chain, where each would wait for the division before it, one in
//! [`CHAIN`] is.
//!
//! What is checked at run time is a share d/G, as of other constraints (see [`super::certificate`]): d = a M₂⁻¹ aᵀ = D/(m₁ m₂ − m₁₂²), and
//! G = Σ a²/m over the coordinates as they were declared, since of the row as it was only what is across the constraints turned before it
//! is left. For diagonal M what is left of M is diagonal, so that d/G is the squared distance of the row from the rows before. By Cauchy
//! and Schwarz (a₁ t₁ + a₂ t₂)² ≤ (a₁²/m₁ + a₂²/m₂) D, term by term too: rounding of what a row has of w, relative to its terms, is
//! rounding relative to √(G D), and D, which a small coefficient on a heavy coordinate may make up, is known where d/G is not small. Where
//! the two share inertia, m₁ m₂ − m₁₂² has to keep a share of m₁ m₂, and d is taken with m₁ m₂ in its place, which is less. That it does
//! need not be checked where M is of numbers, and each row of |M_ij|/√(M_ii M_jj) beside its diagonal adds up to δ ≤ [`APART`]: what stands
//! for different coordinates has no coordinate in common, so that |m₁₂| ≤ δ/(1 − δ) √(m₁ m₂).

use super::entry::Entry;
use super::matrix::Matrix;
use super::{Divisor, SAFE_SHARE};
use crate::expr::{Graph, Id};
use std::collections::{BTreeMap, BTreeSet};

/// Longest chain of rotations whose t are not scaled: coefficients are products of as many, and inertia of their squares.
const CHAIN: usize = 8;

/// See the module.
const APART: f64 = 0.4;

/// Whether no two of any combinations of different coordinates share much of their inertia: see [`APART`].
pub(super) fn apart(mass: &BTreeMap<(usize, usize), Id>, g: &Graph) -> bool {
    let number = |i: usize, j: usize| mass.get(&(i, j)).and_then(|m| g.as_const(*m));
    let mut shares: BTreeMap<usize, f64> = BTreeMap::new();
    for (i, j) in mass.keys().filter(|(i, j)| i != j) {
        let (Some(m), Some(a), Some(b)) = (number(*i, *j), number(*i, *i), number(*j, *j)) else {
            return false;
        };
        let share = m.abs() / (a * b).sqrt();
        for k in [i, j] {
            *shares.entry(*k).or_default() += share;
        }
    }
    shares.values().all(|share| *share <= APART)
}

/// Two coordinates that are alone in a constraint. The freedom that it leaves takes the place of the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    pub coordinates: [usize; 2],
    pub constraint: usize,
}

/// What a rotation does to right-hand sides, and to solutions.
pub(super) struct Turned {
    pub(super) rotation: Rotation,
    /// n D, and 1/D; n and 1 where n is computed in any case.
    normal: [Id; 2],
    inverse: Id,
    /// t.
    pub(super) tangent: [Id; 2],
    /// The neighbours of the two, with their entries for them.
    pub(super) touched: Vec<(usize, [Id; 2])>,
}

impl Turned {
    /// b n.
    pub(super) fn along(&self, b: Id, g: &mut Graph) -> [Id; 2] {
        let share = g.mul(self.inverse, b);
        let share = g.hold_inner(share);
        self.normal.map(|n| {
            let along = g.mul(n, share);
            g.hold_inner(along)
        })
    }

    /// b n + w t.
    pub(super) fn solved(&self, b: Id, w: Id, g: &mut Graph) -> [Id; 2] {
        let along = self.along(b, g);
        [0, 1].map(|i| {
            let across = g.mul(self.tangent[i], w);
            g.add(along[i], across)
        })
    }
}

/// The inertia of two coordinates.
struct Block {
    own: [Id; 2],
    shared: Id,
}

impl Block {
    /// (m₂ x₁ − m₁₂ x₂, m₁ x₂ − m₁₂ x₁).
    fn adjugate(&self, [x1, x2]: [Id; 2], g: &mut Graph) -> [Id; 2] {
        let [m1, m2] = self.own;
        [(m2, x1, x2), (m1, x2, x1)].map(|(m, x, y)| {
            let terms = [(1.0, g.mul(m, x)), (-1.0, g.mul(self.shared, y))];
            g.factored_sum(&terms)
        })
    }

    /// Whether all directions are the same to it.
    fn is_round(&self, g: &Graph) -> bool {
        self.own[0] == self.own[1] && g.is_zero(self.shared)
    }
}

impl Matrix<'_> {
    /// Turns two coordinates. Returns what that leaves, and what has to be positive, or to keep a share.
    pub(super) fn rotate(
        &mut self,
        rotation: Rotation,
        g: &mut Graph,
    ) -> Result<(Turned, Vec<Divisor>), String> {
        let (names, of, c) = (self.names, rotation.coordinates, rotation.constraint);
        let a = of.map(|i| {
            let entry = self.entry(i, c).open(g);
            g.hold_inner(entry)
        });
        let block = Block {
            own: of.map(|i| self.entry(i, i).open(g)),
            shared: {
                let shared = self.entry(of[0], of[1]).open(g);
                g.hold_whole(shared)
            },
        };
        let (length, adjugate) = (g.inner(&a, &a), block.adjugate(a, g));
        // Not a sum of products with m, where m is a factor of all of it.
        let pivot = match block.is_round(g) {
            true => g.mul(block.own[0], length),
            false => g.inner(&a, &adjugate),
        };
        if g.is_zero(pivot) {
            return Err(self.vanished(c));
        }
        self.hints.push((pivot, format!("pivot_{}", names[c])));
        let divisors = self.checks(rotation, a, &block, pivot, g)?;
        self.count_in(rotation, &block, g);
        let [one, other] = of.map(|i| self.turned[i]);
        let depth = 1 + one.unwrap_or(0) + other.unwrap_or(0);
        let scaled = (one, other) == (None, None) || depth > CHAIN;
        self.turned[of[0]] = Some(if scaled { 0 } else { depth });
        let scale = match scaled {
            true => g.pow(length, -1),
            false => g.one(),
        };
        let minus = g.neg(a[0]);
        let tangent = [a[1], minus].map(|t| {
            let t = g.mul(t, scale);
            g.hold_inner(t)
        });
        // Between coordinates as declared, of one inertia, n is t turned back.
        let (normal, inverse) = match scaled && block.is_round(g) {
            true => ([g.neg(tangent[1]), tangent[0]], g.one()),
            false => (adjugate, g.pow(pivot, -1)),
        };
        for (i, t) in of.into_iter().rev().zip(tangent) {
            let hint = format!("{}_by_{}", names[i], names[c]);
            self.hints.push((g.unscaled(t).1, hint));
        }
        let inertia = g.product(&[(pivot, 1), (scale, 2)]);
        let inertia = g.hold_inner(inertia);
        let touched = self.turn(rotation, tangent, inertia, g);
        let turned = Turned {
            rotation,
            normal,
            inverse,
            tangent,
            touched,
        };
        Ok((turned, divisors))
    }

    /// What has to keep a share, or to be positive.
    fn checks(
        &self,
        rotation: Rotation,
        a: [Id; 2],
        block: &Block,
        pivot: Id,
        g: &mut Graph,
    ) -> Result<Vec<Divisor>, String> {
        let (names, of, c) = (self.names, rotation.coordinates, rotation.constraint);
        let mut divisors = Vec::new();
        let apart = g.mul(block.own[0], block.own[1]);
        if !g.is_zero(block.shared) && !self.apart {
            let square = g.square(block.shared);
            let determinant = g.factored_sum(&[(1.0, apart), (-1.0, square)]);
            match (g.as_const(determinant), g.as_const(apart)) {
                (Some(left), Some(whole)) if left >= SAFE_SHARE * whole => {}
                (Some(_), Some(_)) => {
                    let [one, other] = of.map(|i| &names[i]);
                    return Err(format!("`{one}` and `{other}` hardly move apart"));
                }
                _ => divisors.push(Divisor {
                    reference: apart,
                    ..Divisor::positive(of[0], determinant, names)
                }),
            }
        }
        let positive = Divisor::positive(c, pivot, names);
        let declared = of.map(|i| self.turned[i].is_none());
        divisors.push(match declared {
            // Nothing was taken off the row.
            [true, true] => positive,
            _ => {
                let before = self.entry(c, c).reference(g);
                let mut terms = vec![(-1.0, before)];
                for i in [0, 1].into_iter().filter(|i| declared[*i]) {
                    terms.push((1.0, g.product(&[(a[i], 2), (block.own[i], -1)])));
                }
                let whole = g.factored_sum(&terms);
                Divisor {
                    reference: g.mul(apart, whole),
                    ..positive
                }
            }
        });
        Ok(divisors)
    }

    /// Counts in the diagonal of the other constraints on the two what these had of coordinates as they were declared, from here on and
    /// once for all.
    fn count_in(&mut self, rotation: Rotation, block: &Block, g: &mut Graph) {
        for (i, inertia) in rotation.coordinates.into_iter().zip(block.own) {
            if self.turned[i].is_none() {
                let mobility = g.product(&[(inertia, -1)]);
                self.weigh(i, rotation.constraint, mobility, g);
            }
        }
    }

    /// Puts the freedom along `tangent` in the place of the two. Returns their neighbours.
    fn turn(
        &mut self,
        rotation: Rotation,
        tangent: [Id; 2],
        inertia: Id,
        g: &mut Graph,
    ) -> Vec<(usize, [Id; 2])> {
        let of = rotation.coordinates;
        let [place, _] = of;
        self.take(rotation.constraint);
        let near: BTreeSet<usize> = of.into_iter().flat_map(|i| self.take(i)).collect();
        let mut touched = Vec::new();
        for r in near.into_iter().filter(|r| !of.contains(r)) {
            let with = of.map(|i| self.entry(r, i).open(g));
            touched.push((r, with));
            let left = g.inner(&with, &tangent);
            let left = match r < self.n && self.turned[r].is_some() {
                true => g.hold_whole(left),
                false => g.hold_inner(left),
            };
            if g.is_zero(left) {
                self.remove(r, place);
                continue;
            }
            self.link(r, place);
            *self.entry_mut(r, place) = match r < self.n {
                true => Entry::of(left),
                false => Entry::counted(left),
            };
        }
        *self.entry_mut(place, place) = Entry::of(inertia);
        touched
    }
}
