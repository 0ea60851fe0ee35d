//! The non-zeros of K = [M Aᵀ; A 0] while it is eliminated: the one simulation that order, fill and sizes are read off.

use super::{Coefficient, Pair, Rotation};
use crate::analysis::dynamics::Dynamics;
use crate::expr::{Graph, Id, Point, eval};
use std::collections::{BTreeMap, BTreeSet};

/// A coefficient that is smaller than this share of another in its row is no pivot: it would magnify the rest.
const SMALL: f64 = 1.0 / 64.0;

/// What is left of K. Positions: coordinate i is i, constraint i is n + i.
#[derive(Clone, Default)]
pub(super) struct Pattern {
    n: usize,
    left: BTreeSet<usize>,
    /// Neighbours that are left.
    near: Vec<BTreeSet<usize>>,
    /// Whether a coordinate has a diagonal entry.
    pub(super) inertia: Vec<bool>,
    /// The coordinates of each constraint that are left, without those that share inertia with eliminated ones.
    own: Vec<BTreeSet<usize>>,
    /// Entries (constraint, coordinate) that are the same at all states.
    fixed: BTreeMap<(usize, usize), Coefficient>,
    /// Whether a neighbour was eliminated alone.
    pub(super) coupled: Vec<bool>,
    /// Longest chain of divisions that a row waits for.
    pub(super) depth: Vec<usize>,
    /// Coordinates whose inertia is declared to be the same at all states.
    steady: BTreeSet<usize>,
    /// Coordinates what is left of whose inertia is the same at all states, as far as the pattern tells: nothing is divided by it at run
    /// time.
    pub(super) lasting: BTreeSet<usize>,
    /// The coordinates that took the place of two, with the longest chain of rotations before them.
    turned: BTreeMap<usize, usize>,
    /// Constraints that may be left out, and are to be eliminated by themselves.
    kept: BTreeSet<usize>,
    fill: BTreeSet<(usize, usize)>,
    /// How many of the coordinates and of the constraints are the mechanism's.
    declared: (usize, usize),
}

impl Pattern {
    /// The pattern of `d`, with the values that its fixed coefficients have for the parameters `defaults`.
    pub(super) fn new(d: &Dynamics, declared: (usize, usize), defaults: &[f64], g: &Graph) -> Self {
        let n = d.force.len();
        let size = n + d.rhs.len();
        let mut pattern = Pattern {
            n,
            left: (0..size).collect(),
            near: vec![BTreeSet::new(); size],
            inertia: (0..n).map(|i| d.mass.contains_key(&(i, i))).collect(),
            own: vec![BTreeSet::new(); size],
            coupled: vec![false; size],
            depth: vec![0; size],
            declared,
            ..Pattern::default()
        };
        for ((i, j), m) in &d.mass {
            pattern.join(*i, *j);
            if i == j && g.uses(*m).constant() {
                pattern.steady.insert(*i);
            }
        }
        for (row, column) in d.jacobian.keys() {
            pattern.join(n + row, *column);
            pattern.own[n + row].insert(*column);
        }
        let fixed = d.jacobian.iter().filter(|(_, a)| g.uses(**a).constant());
        let (places, ids): (Vec<_>, Vec<Id>) = fixed.map(|(at, a)| (*at, *a)).unzip();
        let values = eval(g, &ids, &Point::of_parameters(defaults));
        for (((row, i), id), value) in places.into_iter().zip(&ids).zip(values) {
            let number = g.as_const(*id).is_some();
            let coefficient = Coefficient { value, number };
            pattern.fixed.insert((n + row, i), coefficient);
        }
        pattern.fill.clear();
        pattern.lasting.clone_from(&pattern.steady);
        pattern
    }

    /// The pattern in which the constraints `rows` are not turned.
    pub(super) fn keep(mut self, rows: &BTreeSet<usize>) -> Self {
        self.kept = rows.iter().map(|row| self.n + row).collect();
        self
    }

    /// What is left, in ascending order.
    pub(super) fn left(&self) -> impl Iterator<Item = usize> {
        self.left.iter().copied()
    }

    pub(super) fn is_left(&self, k: usize) -> bool {
        self.left.contains(&k)
    }

    /// Whether a coordinate can be taken together with `constraint`.
    pub(super) fn has_pair(&self, constraint: usize) -> bool {
        self.coordinates_in(constraint)
            .any(|i| self.pair(i, constraint).is_some())
    }

    /// The neighbours of `k` that are left.
    pub(super) fn near(&self, k: usize) -> impl Iterator<Item = usize> {
        self.near[k].iter().copied()
    }

    /// Number of neighbours that are left.
    pub(super) fn neighbours(&self, k: usize) -> usize {
        self.near[k].len()
    }

    /// Whether `k` is a coordinate.
    pub(super) fn is_coordinate(&self, k: usize) -> bool {
        k < self.n
    }

    /// The coordinates that are left.
    pub(super) fn coordinates(&self) -> impl Iterator<Item = usize> {
        self.left.range(..self.n).copied()
    }

    /// The constraints on `coordinate` that are left.
    pub(super) fn constraints_on(&self, coordinate: usize) -> impl Iterator<Item = usize> {
        self.near[coordinate].range(self.n..).copied()
    }

    /// The coordinates in `constraint` that are left.
    pub(super) fn coordinates_in(&self, constraint: usize) -> impl Iterator<Item = usize> {
        self.near[constraint].range(..self.n).copied()
    }

    /// The pivot of `coordinate` with `constraint`, if it is one at any state: its coefficient there is fixed, not zero and not much
    /// smaller than another fixed one, and the constraint has no entry on the diagonal, as it gets where one of its coordinates is
    /// eliminated alone. With inertia the fixed coefficients have to be numbers, too: one that is much larger than the pivot at run time
    /// would magnify the rounding of accelerations, with all rows of A q̈ = b still met.
    pub(super) fn pair(&self, coordinate: usize, constraint: usize) -> Option<Pair> {
        let coefficient = *self.fixed.get(&(constraint, coordinate))?;
        let row = self.fixed.range((constraint, 0)..(constraint + 1, 0));
        let largest = row.fold(0.0, |s: f64, (_, c)| s.max(c.value.abs()));
        // A velocity is defined by its definition.
        let (n, m) = self.declared;
        let defined = (constraint - self.n).checked_sub(m).map(|k| n + k);
        let free = !self.coupled[constraint] && defined.is_none_or(|own| own == coordinate);
        // Inertia that a coordinate gets by a factor alone may vanish with it, and there is nothing to compare it with.
        let inert = |i: &usize| self.inertia[*i] || self.fixed.contains_key(&(constraint, *i));
        // A parameter may be set to anything, 0 or 1e9: what a coordinate with inertia needs not depend on, it does not.
        let alone = self.near[constraint].len() == 1;
        let mut others = self.fixed.range((constraint, 0)..(constraint + 1, 0));
        let numbers = alone || others.all(|(_, c)| c.number);
        let certain = !self.inertia[coordinate]
            || defined.is_some()
            || numbers && self.near[constraint].range(..self.n).all(inert);
        let size = coefficient.value.abs();
        // What was turned is no longer as large as it was declared.
        let near = self.near[constraint].iter().chain([&coordinate]);
        let straight = near.into_iter().all(|i| !self.turned.contains_key(i));
        let fits = free
            && straight
            && certain
            && size > 0.0
            && size.is_finite()
            && size >= SMALL * largest;
        fits.then(|| Pair {
            coordinate,
            constraint,
            coefficient,
            massive: self.inertia[coordinate],
            alone,
        })
    }

    /// The rotation of `k`, if it is a constraint on two coordinates alone; before anything is eliminated in another way.
    pub(super) fn rotation(&self, k: usize) -> Option<Rotation> {
        let near = &self.near[k];
        let mut coordinates = near.range(..self.n).copied();
        let both = [coordinates.next()?, coordinates.next()?];
        let free = k >= self.n && near.len() == 2 && !self.kept.contains(&k);
        let fits = free && both.iter().all(|i| self.steady.contains(i));
        fits.then_some(Rotation {
            coordinates: both,
            constraint: k,
        })
    }

    /// How many rotations the rotation waits for.
    pub(super) fn waits(&self, rotation: Rotation) -> usize {
        let before = |i: &usize| self.turned.get(i).map_or(0, |depth| depth + 1);
        rotation.coordinates.iter().map(before).max().unwrap_or(0)
    }

    /// Neighbours of the coordinates that are turned.
    pub(super) fn around(&self, rotation: Rotation) -> BTreeSet<usize> {
        let of = rotation.coordinates;
        let near = of.iter().flat_map(|i| &self.near[*i]).copied();
        let taken = |k: &usize| of.contains(k) || *k == rotation.constraint;
        near.filter(|k| !taken(k)).collect()
    }

    /// How many entries the rotation changes: each neighbour's two become one, beside those of the two themselves.
    pub(super) fn changed_by_rotation(&self, rotation: Rotation) -> usize {
        2 * self.around(rotation).len() + 4
    }

    /// Puts what the rotation leaves in the place of its first coordinate.
    pub(super) fn turn(&mut self, rotation: Rotation) {
        let (waits, around) = (self.waits(rotation), self.around(rotation));
        let [place, other] = rotation.coordinates;
        self.take(rotation.constraint);
        self.take(other);
        for a in around {
            self.join(place, a);
            self.fixed.remove(&(a, place));
            if !self.is_coordinate(a) {
                self.own[a].insert(place);
            }
        }
        self.lasting.remove(&place);
        self.turned.insert(place, waits);
    }

    /// Whether the pivot of `k` is definite where A has full rank: with all its coordinates gone, what is left of a constraint is, though
    /// it may be coupled to others that share inertia.
    pub(super) fn is_definite(&self, k: usize) -> bool {
        match self.is_coordinate(k) {
            true => self.inertia[k],
            false => self.own[k].is_empty(),
        }
    }

    /// Whether `k` is a coordinate that is coupled to constraints alone.
    pub(super) fn shares_no_inertia(&self, k: usize) -> bool {
        k < self.n && self.near[k].range(..self.n).next().is_none()
    }

    /// Entries that eliminating `k` alone fills in.
    pub(super) fn filled_by(&self, k: usize) -> usize {
        let near = &self.near[k];
        let missing = |a: &usize| {
            near.range(..a)
                .filter(|b| !self.near[*a].contains(b))
                .count()
        };
        near.iter().map(missing).sum()
    }

    /// Entries that eliminating `pair` fills in.
    pub(super) fn filled_by_pair(&self, pair: &Pair) -> usize {
        let (j, c) = (pair.coordinate, pair.constraint);
        let near = &self.near[c];
        let apart = |a: usize, b: usize| a != b && !self.near[a].contains(&b);
        let others = self.near[j].iter().filter(|a| **a != c);
        let crossed = others.map(|a| near.iter().filter(|b| **b != j && apart(*a, **b)).count());
        let within = |a: &usize| {
            near.range(..a)
                .filter(|b| **b != j && apart(*a, **b))
                .count()
        };
        let inertia = near.iter().filter(|a| **a != j && pair.massive).map(within);
        crossed.sum::<usize>() + inertia.sum::<usize>()
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
    /// inertia, those of the constraint among themselves. Returns the neighbours of both.
    pub(super) fn eliminate_pair(&mut self, pair: Pair) -> BTreeSet<usize> {
        let mut of_coordinate = self.take(pair.coordinate);
        of_coordinate.remove(&pair.constraint);
        let of_constraint = self.take(pair.constraint);
        for a in &of_coordinate {
            for b in &of_constraint {
                match self.is_coordinate(*a) {
                    true if a == b => self.inertia[*a] = true,
                    true => self.join(*a, *b),
                    false => self.substitute(pair, *a, *b),
                }
            }
        }
        for a in &of_constraint {
            let fixed = self.fixed.contains_key(&(pair.constraint, *a));
            if of_coordinate.contains(a) || pair.massive && !fixed {
                self.lasting.remove(a);
            }
        }
        if pair.massive {
            for a in &of_constraint {
                self.inertia[*a] = true;
                of_constraint.range(..a).for_each(|b| self.join(*a, *b));
            }
        }
        of_coordinate.union(&of_constraint).copied().collect()
    }

    /// What the coordinate of `pair`, substituted, adds to the coefficient of `coordinate` in another `constraint`.
    fn substitute(&mut self, pair: Pair, constraint: usize, coordinate: usize) {
        let at = (constraint, coordinate);
        let before = match self.near[constraint].contains(&coordinate) {
            true => self.fixed.get(&at).copied(),
            false => Some(Coefficient::ZERO),
        };
        let factor = self.fixed.get(&(constraint, pair.coordinate));
        let other = self.fixed.get(&(pair.constraint, coordinate));
        let after = before.zip(factor.zip(other));
        let after = after.and_then(|(before, (f, o))| before.less(*f, *o, pair.coefficient));
        self.join(constraint, coordinate);
        self.own[constraint].insert(coordinate);
        match after {
            Some(c) if c.number && c.value == 0.0 => {
                self.near[constraint].remove(&coordinate);
                self.near[coordinate].remove(&constraint);
                self.own[constraint].remove(&coordinate);
                self.fixed.remove(&at);
            }
            Some(c) => drop(self.fixed.insert(at, c)),
            None => drop(self.fixed.remove(&at)),
        }
    }

    /// Eliminates `k` alone, which couples its neighbours. Returns them.
    pub(super) fn eliminate(&mut self, k: usize) -> BTreeSet<usize> {
        let neighbours = self.take(k);
        // Only constraints divide on the critical path; coordinates with constant inertia do not.
        let later = self.depth[k] + usize::from(k >= self.n);
        for a in &neighbours {
            self.coupled[*a] = true;
            self.lasting.remove(a);
            self.depth[*a] = self.depth[*a].max(later);
            neighbours.range(..a).for_each(|b| {
                self.join(*a, *b);
                self.fixed.remove(&(*a, *b));
            });
        }
        neighbours
    }
}
