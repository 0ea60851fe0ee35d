//! Rows that are reversed within a step, be they at its end as at its start.

use std::rc::Rc;

use super::matrix::Matrix;
use super::{BEFORE, CHANGE, HALVINGS, RowWatch, Vanishing, between_states, go_between};
use crate::integrate::sample::Sample;
use crate::mechanism::Prepared;

/// Parts of a step at which rows are looked at first, beside its ends and where the motion turns back, so unevenly that no turns come out
/// even at all of them.
pub(super) const LOOKS: [f64; 3] = [0.19, 0.45, 0.68];

impl RowWatch {
    /// The first row that is reversed between states within the step from `old` to `new`, even if it is as it was at its end.
    pub(super) fn within(
        &mut self,
        mech: &Prepared,
        old: Sample<'_>,
        new: Sample<'_>,
        rests: Option<f64>,
    ) -> Option<Vanishing> {
        if !self.may[..self.holonomic].contains(&true) {
            return None;
        }
        let mut parts = LOOKS.to_vec();
        parts.extend(rests);
        parts.sort_by(f64::total_cmp);
        let mut looks = std::mem::take(&mut self.looks);
        let [start, rest @ ..] = &mut looks;
        let known = self.seen.t == old.t;
        if !known {
            self.look_at(mech, old, start);
        }
        let mut state = old.to_state();
        for (part, matrix) in parts.iter().zip(rest) {
            go_between(old, new, *part, &mut state);
            self.look_at(mech, Sample::from(&state), matrix);
        }
        let mut all = vec![(0.0, if known { &self.seen } else { &looks[0] })];
        all.extend(parts.into_iter().zip(&looks[1..]));
        all.push((1.0, &self.here));
        let (mut still, mut turns) = (true, vec![0.0; self.holonomic]);
        for pair in all.windows(2).rev() {
            still &= (self.turned([pair[0].1, pair[1].1], |c, share| turns[c] += share)).0;
        }
        let found = (!still).then(|| self.first_reversed(mech, old, new, &all));
        self.turns = turns.into_iter().fold(0.0, f64::max);
        self.looks = looks;
        found.flatten()
    }

    /// Takes A at a state, and the lengths of its rows.
    fn look_at(&self, mech: &Prepared, at: Sample<'_>, matrix: &mut Matrix) {
        matrix.t = f64::NAN;
        matrix.take(mech, at, self.measure.as_ref());
        matrix.measure(&self.leaves);
    }

    /// Whether no holonomic row that may vanish changes by much between two states, and the first that is reversed there; calls `each` with
    /// such rows and the share of their greater length by which they change.
    fn turned(
        &self,
        [from, to]: [&Matrix; 2],
        mut each: impl FnMut(usize, f64),
    ) -> (bool, Option<usize>) {
        let (mut still, mut reversed) = (true, None::<usize>);
        (self.leaves).changes([&from.entries, &to.entries], |c, change, product| {
            if !self.may[c] || c >= self.holonomic {
                return;
            }
            let share = (change / from.squares[c].max(to.squares[c])).sqrt();
            still &= share <= CHANGE;
            if product < 0.0 {
                reversed = Some(reversed.map_or(c, |first| first.min(c)));
            }
            each(c, share);
        });
        (still, reversed)
    }

    /// The first row that is reversed on parts of the step from `old` to `new` so short that it does not only turn, with A at some places
    /// of it.
    fn first_reversed(
        &self,
        mech: &Prepared,
        old: Sample<'_>,
        new: Sample<'_>,
        looks: &[(f64, &Matrix)],
    ) -> Option<Vanishing> {
        let at = |part: f64| between_states(old, new, part);
        let places = looks.iter();
        let places: Vec<_> = places
            .map(|(part, matrix)| (*part, Rc::new((*matrix).clone())))
            .collect();
        // What is left to look at, the first part last.
        let pairs = places.windows(2).rev();
        let mut parts: Vec<_> = pairs
            .map(|pair| (pair[0].clone(), pair[1].clone()))
            .collect();
        while let Some((from, to)) = parts.pop() {
            let (still, reversed) = self.turned([&from.1, &to.1], |_, _| ());
            if still {
                continue;
            }
            if to.0 - from.0 > 0.5_f64.powi(HALVINGS) {
                let middle = 0.5 * (from.0 + to.0);
                let mut between = Matrix::default();
                self.look_at(mech, Sample::from(&at(middle)), &mut between);
                let between = (middle, Rc::new(between));
                parts.push((between.clone(), to));
                parts.push((from, between));
                continue;
            }
            let Some(row) = reversed else {
                continue;
            };
            let ends = self.here.length(row).min(looks[0].1.length(row));
            let near = at((from.0 - BEFORE).max(0.0));
            let least = match to.1.length(row) < from.1.length(row) {
                true => &to.1,
                false => &from.1,
            };
            let shares = [least.length(row) / ends, ends / self.sizes[row]];
            let t = at(0.5 * (from.0 + to.0)).t;
            return Some(self.found(row, near, (t, least), shares));
        }
        None
    }
}
