//! Sets of numbers that are joined.

/// The group of each number from 0 on, by its least member.
pub(super) struct Groups(Vec<usize>);

impl Groups {
    /// The groups in which each number is by itself.
    pub(super) fn new(size: usize) -> Self {
        Groups((0..size).collect())
    }

    /// The least number in the group of `i`.
    pub(super) fn of(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    /// Makes one group of those of `a` and `b`.
    pub(super) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.of(a), self.of(b));
        self.0[a.max(b)] = a.min(b);
    }
}
