//! Whether a coordinate is light beside the others.
//!
//! q̈ = M⁻¹ (Q + Aᵀλ) of a light coordinate that constraints tie to heavy ones is what is left of terms that all but cancel: ε |Q|/m of it
//! is rounding. In row c of A coordinate j has the part a_cj²/m_j of G_cc, in the same unit as all others of the row. Where those of some
//! inertia make up all but [`SHARE`] of it, and others the rest, what these do is lost in the rounding of those.
//!
//! A part may vanish at single states, as that of a crank in line with its rod: so a row is even once it was so at one state, with
//! parameters as they are. What rounding is then at such states, it is at all.

use super::Solver;
use crate::mechanism::Evaluated;

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

    /// Takes the rows as they are in `here`; whether all have been even at some state.
    fn look(&mut self, here: &Evaluated) -> bool {
        let n = here.force.len();
        let rows = here.rows();
        let mut all = true;
        for (c, even) in self.even.iter_mut().enumerate() {
            if *even {
                continue;
            }
            let parts = &mut self.parts;
            parts.clear();
            let diagonal = here.mass.iter().step_by(n + 1);
            let entries = diagonal.zip(rows.row(c)).filter(|(_, a)| *a != 0.0);
            parts.extend(entries.map(|(m, a)| (*m, a / m * a)));
            *even = is_even(parts);
            all &= *even;
        }
        all
    }
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
    /// With the equations in `here`: whether the elimination last tried can be used as it is, inertias far apart or not.
    pub(super) fn is_even(&mut self) -> bool {
        if !self.dropping.is_uneven() || !self.light.look(&self.here) {
            return false;
        }
        self.dropping.even_out();
        self.dropping.accepted.has(self.dropping.certificate)
    }
}
