//! The states that a run keeps of its way, to go back to.

use super::passage::BACK;
use crate::integrate::course::Place;

/// Places and states at the starts of steps, the first one first, ever fewer the longer ago they are: where there are twice as many as a
/// detour goes back they are thinned out.
#[derive(Default)]
pub(super) struct Before {
    states: Vec<(Place, Vec<f64>)>,
    /// The number of states that count; the others are room for more.
    count: usize,
}

impl Before {
    /// A step from this place and state is accepted.
    pub(super) fn keep(&mut self, now: Place, state: &[f64]) {
        if self.count == 2 * BACK {
            self.count = BACK;
            (0..BACK).for_each(|k| self.states.swap(k, 2 * k + 1));
        }
        if self.count == self.states.len() {
            self.states.push((now, Vec::new()));
        }
        let (place, y) = &mut self.states[self.count];
        *place = now;
        y.clear();
        y.extend_from_slice(state);
        self.count += 1;
    }

    /// The first one that is as `is`; all are taken out.
    pub(super) fn first(&mut self, is: impl Fn(&Place) -> bool) -> Option<(Place, Vec<f64>)> {
        let states = &self.states[..std::mem::take(&mut self.count)];
        states.iter().find(|(place, _)| is(place)).cloned()
    }

    /// Takes those out that are not as `is`, from the last one on, and the one that is.
    pub(super) fn back(&mut self, is: impl Fn(&Place) -> bool) -> Option<(Place, Vec<f64>)> {
        let last = self.states[..self.count]
            .iter()
            .rposition(|(place, _)| is(place));
        self.count = last.unwrap_or(0);
        last.map(|last| self.states[last].clone())
    }
}
