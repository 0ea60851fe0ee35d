//! The non-zeros of K = [M Aᵀ; A 0] while it is eliminated: the one simulation that order, fill and sizes are read off.

use super::Pair;
use crate::analysis::dynamics::Dynamics;
use std::collections::BTreeSet;

/// What is left of K. Positions: coordinate i is i, constraint i is n + i.
pub(super) struct Pattern {
    n: usize,
    left: BTreeSet<usize>,
    /// Neighbours that are left.
    near: Vec<BTreeSet<usize>>,
    /// Whether a coordinate has a diagonal entry.
    inertia: Vec<bool>,
    /// Of each constraint, its coordinates that are left: not those that share inertia with eliminated ones.
    own: Vec<BTreeSet<usize>>,
    /// Whether entries of the row are no longer those of K.
    touched: Vec<bool>,
    /// Whether a neighbour was eliminated alone.
    coupled: Vec<bool>,
    /// Longest chain of divisions that a row waits for.
    depth: Vec<usize>,
    fill: BTreeSet<(usize, usize)>,
}

impl Pattern {
    pub(super) fn new(d: &Dynamics) -> Self {
        let n = d.force.len();
        let size = n + d.rhs.len();
        let mut pattern = Pattern {
            n,
            left: (0..size).collect(),
            near: vec![BTreeSet::new(); size],
            inertia: (0..n).map(|i| d.mass.contains_key(&(i, i))).collect(),
            own: vec![BTreeSet::new(); size],
            touched: vec![false; size],
            coupled: vec![false; size],
            depth: vec![0; size],
            fill: BTreeSet::new(),
        };
        for (i, j) in d.mass.keys() {
            pattern.join(*i, *j);
        }
        for (row, column) in d.jacobian.keys() {
            pattern.join(n + row, *column);
            pattern.own[n + row].insert(*column);
        }
        pattern.fill.clear();
        pattern
    }

    /// What is left, in ascending order.
    pub(super) fn left(&self) -> impl Iterator<Item = usize> {
        self.left.iter().copied()
    }

    /// The neighbours of `k` that are left.
    pub(super) fn near(&self, k: usize) -> impl Iterator<Item = usize> {
        self.near[k].iter().copied()
    }

    /// Number of neighbours that are left.
    pub(super) fn neighbours(&self, k: usize) -> usize {
        self.near[k].len()
    }

    pub(super) fn has_inertia(&self, coordinate: usize) -> bool {
        self.inertia[coordinate]
    }

    /// The coordinates that are left.
    pub(super) fn coordinates(&self) -> impl Iterator<Item = usize> {
        self.left.range(..self.n).copied()
    }

    /// Whether the entries of `k` are still those of K.
    pub(super) fn is_untouched(&self, k: usize) -> bool {
        !self.touched[k]
    }

    /// The constraints on `coordinate` that are left.
    pub(super) fn constraints_on(&self, coordinate: usize) -> impl Iterator<Item = usize> {
        self.near[coordinate].range(self.n..).copied()
    }

    /// The coordinates in `constraint` that are left.
    pub(super) fn coordinates_in(&self, constraint: usize) -> impl Iterator<Item = usize> {
        self.near[constraint].range(..self.n).copied()
    }

    /// Whether the pivot of `k` is definite where A has full rank: with all its coordinates gone, what is left of a constraint is, though
    /// it may be coupled to others that share inertia.
    pub(super) fn is_definite(&self, k: usize) -> bool {
        k < self.n || self.own[k].is_empty()
    }

    /// Whether `k` is a coordinate that is coupled to constraints alone.
    pub(super) fn shares_no_inertia(&self, k: usize) -> bool {
        k < self.n && self.near[k].range(..self.n).next().is_none()
    }

    pub(super) fn was_coupled(&self, k: usize) -> bool {
        self.coupled[k]
    }

    pub(super) fn depth(&self, k: usize) -> usize {
        self.depth[k]
    }

    /// What was filled in, row > column.
    pub(super) fn into_fill(self) -> Vec<(usize, usize)> {
        self.fill.into_iter().collect()
    }

    /// Neighbours of `k`, which leaves.
    fn take(&mut self, k: usize) -> BTreeSet<usize> {
        self.left.remove(&k);
        let neighbours = std::mem::take(&mut self.near[k]);
        for a in &neighbours {
            self.near[*a].remove(&k);
            self.own[*a].remove(&k);
        }
        neighbours
    }

    /// Gives K an entry at (a, b), off its diagonal.
    fn join(&mut self, a: usize, b: usize) {
        if a != b && self.near[a].insert(b) {
            self.near[b].insert(a);
            self.fill.insert((a.max(b), a.min(b)));
        }
    }

    /// Eliminates a coordinate with a constraint. That couples the neighbours of one with those of the other and, if the coordinate has
    /// inertia, those of the constraint among themselves. Returns the neighbours of the coordinate.
    pub(super) fn eliminate_pair(&mut self, pair: Pair) -> BTreeSet<usize> {
        let mut of_coordinate = self.take(pair.coordinate);
        of_coordinate.remove(&pair.constraint);
        let of_constraint = self.take(pair.constraint);
        let inertia = pair.massive.then_some(&of_constraint);
        for of in [Some(&of_coordinate), inertia].into_iter().flatten() {
            for (a, b) in of
                .iter()
                .flat_map(|a| of_constraint.iter().map(|b| (*a, *b)))
            {
                self.join(a, b);
                (self.touched[a], self.touched[b]) = (true, true);
                match (a.min(b), a.max(b)) {
                    (i, j) if i == j && i < self.n => self.inertia[i] = true,
                    (i, c) if i < self.n && c >= self.n => drop(self.own[c].insert(i)),
                    _ => {}
                }
            }
        }
        of_coordinate
    }

    /// Eliminates `k` alone, which couples its neighbours. Returns them.
    pub(super) fn eliminate(&mut self, k: usize) -> BTreeSet<usize> {
        let neighbours = self.take(k);
        // Only constraints divide on the critical path; coordinates with constant inertia do not.
        let later = self.depth[k] + usize::from(k >= self.n);
        for a in &neighbours {
            self.coupled[*a] = true;
            self.depth[*a] = self.depth[*a].max(later);
            neighbours.range(..a).for_each(|b| self.join(*a, *b));
        }
        neighbours
    }
}
