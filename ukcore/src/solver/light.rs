//! Whether a coordinate is light beside the others.
//!
//! q̈ = M⁻¹ (Q + Aᵀλ) of a light coordinate that constraints tie to heavy ones is what is left of terms that all but cancel: ε |Q|/m of it
//! is rounding. In row c of A coordinate j has the part a_cj²/m_j of G_cc, in the same unit as all others of the row. Where those of some
//! inertia make up all but [`SHARE`] of it, and others the rest, what these do is lost in the rounding of those. Of a quaternion, which has
//! no inertia along itself, the turns about the axes of its body may stand for the coordinates.
//!
//! A part may vanish at single states, as that of a crank in line with its rod: so a row is even once it was so at one state, with
//! parameters as they are. What rounding is then at such states, it is at all.
//!
//! What constraints give by other coordinates is as exact as these: where not all rows are even, those that multipliers are solved for are
//! looked at in the coordinates that are left, by what each of these keeps of its own forces ([`super::reduced`]).

use std::ops::Range;

use super::Solver;
use super::reduced::Reduced;
use crate::mechanism::Evaluated;
use crate::spec::Spec;

/// The least part of a row that is not lost: ε over it is what accelerations are met to.
const SHARE: f64 = 1e-4;
/// Inertias within this factor of each other are taken together.
const ALIKE: f64 = 16.0;

/// What coordinates keep is looked at once in so many evaluations at the least.
const OFTEN: usize = 64;

/// What is known of the rows.
#[derive(Debug, Clone)]
pub(super) struct Light {
    /// The rows that were even at a state.
    even: Vec<bool>,
    /// Inertias of coordinates in a row, with their parts.
    parts: Vec<(f64, f64)>,
    /// The coordinates of the quaternions whose turns the elimination has in their place.
    quaternions: Vec<Range<usize>>,
    /// The rows that multipliers are solved for, where others give coordinates.
    reduced: Option<Reduced>,
    /// How often these might have been looked at.
    asked: usize,
}

impl Light {
    pub(super) fn new(spec: &Spec) -> Self {
        let structure = &spec.structure;
        let turned = structure.solve.turned.iter();
        let quaternions = turned.filter_map(|row| four(structure.in_row(*row)));
        Light {
            reduced: Reduced::new(spec),
            asked: 0,
            even: vec![false; spec.m()],
            parts: Vec::with_capacity(spec.n()),
            quaternions: quaternions.collect(),
        }
    }

    /// Parameters have changed.
    pub(super) fn forget(&mut self) {
        self.even.fill(false);
        self.asked = 0;
    }

    /// Takes the rows as they are in `here`, at the coordinates `q`; whether all have been even at some state.
    fn look(&mut self, turned: &[usize], here: &Evaluated, q: &[f64]) -> bool {
        for c in 0..self.even.len() {
            // A quaternion's own length ties it to nothing.
            if self.even[c] || turned.contains(&c) {
                continue;
            }
            self.take(here, q, c, false);
            self.even[c] = is_even(&mut self.parts);
            // Which axes a quaternion turns about decides nothing where its coordinates do not.
            if !self.even[c] && !self.quaternions.is_empty() {
                self.take(here, q, c, true);
                self.even[c] = is_even(&mut self.parts);
            }
        }
        let mut rows = self.even.iter().enumerate();
        rows.all(|(c, even)| *even || turned.contains(&c)) || self.keeps_forces(here, q)
    }

    /// Whether each of the coordinates that are left keeps its share of its own forces at this state. It is work for some evaluations, so
    /// states are looked at less and less often.
    fn keeps_forces(&mut self, here: &Evaluated, q: &[f64]) -> bool {
        let Some(reduced) = &mut self.reduced else {
            return false;
        };
        self.asked += 1;
        let now = self.asked.is_power_of_two() || self.asked.is_multiple_of(OFTEN);
        now && reduced.kept(here, q) >= SHARE
    }

    /// Takes the parts of row `c`, those of quaternions by their coordinates or `by_turns`.
    fn take(&mut self, here: &Evaluated, q: &[f64], c: usize, by_turns: bool) {
        let (n, m) = (q.len(), here.rhs.len());
        let a = |j: usize| here.jacobian[j * m + c];
        let mass = |i: usize, j: usize| here.mass[i * n + j];
        let quaternions = self.quaternions.iter().filter(|_| by_turns);
        let turned = |j: &usize| quaternions.clone().any(|all| all.contains(j));
        let plain = (0..n).filter(|j| a(*j) != 0.0 && !turned(j));
        self.parts.clear();
        self.parts
            .extend(plain.map(|j| (mass(j, j), a(j) / mass(j, j) * a(j))));
        for all in quaternions.clone() {
            for turn in turns(&q[all.clone()]) {
                let along = |of: &dyn Fn(usize) -> f64| -> f64 {
                    turn.iter().zip(all.clone()).map(|(x, i)| x * of(i)).sum()
                };
                let a = along(&a);
                if a != 0.0 {
                    let inertia = along(&|i| along(&|j| mass(i, j)));
                    self.parts.push((inertia, a / inertia * a));
                }
            }
        }
    }
}

/// The range of these coordinates, if they are four that stand beside each other, as a quaternion's.
pub(super) fn four(coordinates: impl Iterator<Item = usize> + Clone) -> Option<Range<usize>> {
    let first = coordinates.clone().next()?;
    let all = first..first + 4;
    coordinates.eq(all.clone()).then_some(all)
}

/// The changes of the quaternion e by turns about the axes of its body.
pub(super) fn turns(e: &[f64]) -> [[f64; 4]; 3] {
    [
        [-e[1], e[0], e[3], -e[2]],
        [-e[2], -e[3], e[0], e[1]],
        [-e[3], e[2], -e[1], e[0]],
    ]
}

/// Whether no part is lost in those of other inertias; `parts` have inertias in front, and are used up.
fn is_even(parts: &mut Vec<(f64, f64)>) -> bool {
    parts.sort_unstable_by(|(a, _), (b, _)| a.total_cmp(b));
    parts.dedup_by(|next, group| {
        let alike = next.0 <= ALIKE * group.0;
        if alike {
            group.1 += next.1;
        }
        alike
    });
    parts.sort_unstable_by(|(_, a), (_, b)| b.total_cmp(a));
    let lost = |k: usize| {
        let (above, below) = parts.split_at(k);
        let sum = |parts: &[(f64, f64)]| parts.iter().map(|(_, part)| part).sum::<f64>();
        // What is not a number is not known to be even.
        let (above, below) = (sum(above), sum(below));
        below.is_nan() || above.is_nan() || below < SHARE * above
    };
    !(1..parts.len()).any(lost)
}

impl Solver {
    /// Whether the elimination last tried can be used as it is, with the equations in `here`, at the coordinates `q`.
    pub(super) fn is_even(&mut self, q: &[f64]) -> bool {
        let turned = self.mechanism.spec().structure.solve.turned;
        if !self.dropping.is_uneven() || !self.light.look(turned, &self.here, q) {
            return false;
        }
        self.dropping.even_out();
        self.dropping.accepted.has(self.dropping.certificate)
    }
}
