//! Whether a coordinate is light beside the others.
//!
//! q̈ = M⁻¹ (Q + Aᵀλ) of a light coordinate that constraints tie to heavy ones is what is left of terms that all but cancel: ε |Q|/m of it
//! is rounding. In row c of A coordinate j has the part a_cj²/m_j of G_cc, in the same unit as all others of the row. Where those of some
//! inertia make up all but [`SHARE`] of it, and others the rest, what these do is lost in the rounding of those. Of a quaternion, which has
//! no inertia along itself, the turns about the axes of its body may stand for the coordinates.
//!
//! A part may vanish at single states, as that of a crank in line with its rod: so a row is even once it was so at one state, with
//! parameters as they are. What rounding is then at such states, it is at all.

use super::Solver;
use crate::mechanism::Evaluated;
use crate::spec::Spec;

/// The least part of a row that is not lost: ε over it is what accelerations are met to.
const SHARE: f64 = 1e-4;
/// Inertias within this factor of each other are taken together.
const ALIKE: f64 = 16.0;

/// What is known of the rows.
#[derive(Debug, Clone)]
pub(super) struct Light {
    /// Those that were even at a state.
    even: Vec<bool>,
    /// Inertias of coordinates in a row, with their parts.
    parts: Vec<(f64, f64)>,
}

impl Light {
    pub(super) fn new(n: usize, m: usize) -> Self {
        Light {
            even: vec![false; m],
            parts: Vec::with_capacity(n),
        }
    }

    /// Parameters have changed.
    pub(super) fn forget(&mut self) {
        self.even.fill(false);
    }

    /// Takes the rows as they are in `here`, at the coordinates `q`; whether all have been even at some state.
    fn look(&mut self, spec: &Spec, here: &Evaluated, q: &[f64]) -> bool {
        let (n, m) = (q.len(), here.rhs.len());
        let mut all = true;
        for (c, even) in self.even.iter_mut().enumerate() {
            // A quaternion's own length ties it to nothing.
            if *even || spec.structure.solve.turned.contains(&c) {
                continue;
            }
            let (a, mass) = (
                |j: usize| here.jacobian[j * m + c],
                |i: usize, j: usize| here.mass[i * n + j],
            );
            // Which axes a quaternion turns about decides nothing where its coordinates do not.
            for by_turns in [false, true] {
                let parts = &mut self.parts;
                parts.clear();
                let turned = |j: &usize| {
                    by_turns && quaternions(spec).any(|first| (first..first + 4).contains(j))
                };
                let plain = (0..n).filter(|j| a(*j) != 0.0 && !turned(j));
                parts.extend(plain.map(|j| (mass(j, j), a(j) / mass(j, j) * a(j))));
                for first in quaternions(spec).filter(|_| by_turns) {
                    for turn in turns(&q[first..]) {
                        let along = |of: &dyn Fn(usize) -> f64| -> f64 {
                            (0..4).map(|i| turn[i] * of(first + i)).sum()
                        };
                        let a = along(&a);
                        if a != 0.0 {
                            let inertia = along(&|i| along(&|j| mass(i, j)));
                            parts.push((inertia, a / inertia * a));
                        }
                    }
                }
                *even |= is_even(parts);
            }
            all &= *even;
        }
        all
    }
}

/// The first coordinates of the quaternions whose turns the elimination has in their place.
fn quaternions(spec: &Spec) -> impl Iterator<Item = usize> {
    let entries = spec.structure.jacobian_pattern;
    spec.structure.solve.turned.iter().filter_map(move |row| {
        let mut columns = entries.iter().filter(|(c, _)| c == row).map(|(_, j)| *j);
        let first = columns.next()?;
        columns.eq(first + 1..first + 4).then_some(first)
    })
}

/// The changes of the quaternion e by turns about the axes of its body.
fn turns(e: &[f64]) -> [[f64; 4]; 3] {
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
    /// With the equations in `here`, at the coordinates `q`: whether the elimination last tried can be used as it is, inertias far apart or not.
    pub(super) fn is_even(&mut self, q: &[f64]) -> bool {
        let spec = self.mechanism.spec();
        if !self.dropping.is_uneven() || !self.light.look(spec, &self.here, q) {
            return false;
        }
        self.dropping.even_out();
        self.dropping.accepted.has(self.dropping.certificate)
    }
}
