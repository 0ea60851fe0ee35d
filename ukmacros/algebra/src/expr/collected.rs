//! What sums and products are collected in, while they are made.

use super::graph::{Id, Map};

/// Larger exponents are not composed: far from overflow, whatever derivatives do to them.
const MAX_EXPONENT: i32 = 1 << 20;

/// The number of items that are looked through faster than a map finds one of them.
const FEW: usize = 16;

/// Terms with their coefficients, or factors with their exponents: each once, in the order of their coming.
#[derive(Default)]
pub(super) struct Collected<T> {
    pub(super) list: Vec<(Id, T)>,
    /// The places of the items; nothing as long as they are few.
    place: Map<Id, usize>,
}

impl<T> Collected<T> {
    pub(super) fn get_mut(&mut self, id: Id) -> Option<&mut T> {
        let at = self.find(id)?;
        Some(&mut self.list[at].1)
    }

    fn find(&self, id: Id) -> Option<usize> {
        match self.list.len() {
            0..=FEW => self.list.iter().position(|(known, _)| *known == id),
            _ => self.place.get(&id).copied(),
        }
    }

    /// Adds what is not there.
    pub(super) fn push(&mut self, id: Id, value: T) {
        self.list.push((id, value));
        let new = match self.list.len() {
            0..=FEW => return,
            len if len == FEW + 1 => 0,
            len => len - 1,
        };
        let new = self.list.iter().enumerate().skip(new);
        self.place.extend(new.map(|(at, (id, _))| (*id, at)));
    }
}

impl Collected<i32> {
    /// Whether base^e can be entered.
    pub(super) fn takes(&self, base: Id, e: i32) -> bool {
        let known = self.find(base).map_or(0, |at| self.list[at].1);
        let sum = known.checked_add(e);
        sum.is_some_and(|sum| (-MAX_EXPONENT..=MAX_EXPONENT).contains(&sum))
    }

    /// Enters base^e, or returns false if the exponent leaves its bounds.
    pub(super) fn enter(&mut self, base: Id, e: i32) -> bool {
        let fits = self.takes(base, e);
        if fits {
            match self.get_mut(base) {
                Some(known) => *known += e,
                None => self.push(base, e),
            }
        }
        fits
    }
}
