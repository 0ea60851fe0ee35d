//! What was decided about the solve, for the reader.

use super::dynamics::Dynamics;
use super::elimination::{Pivoting, Straight};
use crate::expr::Graph;
use std::collections::{BTreeMap, BTreeSet};

/// How q̈ is solved for. Positions: coordinate i is i, constraint i is n + i.
pub(crate) struct Solve {
    /// The pivots in their order.
    pub(crate) pivots: Vec<Chosen>,
    /// Positions (row > column) that are zero in [M Aᵀ; A 0] and filled by its elimination.
    pub(crate) fill: Vec<(usize, usize)>,
    /// What the certificate compares: positions, and whether against the diagonal that the pivot started from (else against zero).
    pub(crate) checks: Vec<(usize, bool)>,
}

/// A pivot and why it is one.
pub(crate) enum Chosen {
    /// Coordinate and constraint (row) with its coefficient; the coordinate has inertia.
    Prescribed(usize, usize, f64),
    /// Coordinate and constraint (row) with its coefficient; the coordinate has no inertia.
    Massless(usize, usize, f64),
    Coordinate(usize),
    /// Row.
    Constraint(usize),
}

/// What is to be told of `straight`.
pub(crate) fn solve(d: &Dynamics, straight: &Straight, g: &Graph) -> Solve {
    let n = d.force.len();
    let elimination = &straight.elimination;
    let chosen = elimination.order.iter().map(|step| match *step {
        Pivoting::One(k) if k < n => Chosen::Coordinate(k),
        Pivoting::One(k) => Chosen::Constraint(k - n),
        Pivoting::Two(j, c) => {
            let row = c - n;
            let a = d.jacobian.get(&(row, j)).and_then(|a| g.as_const(*a));
            let a = a.unwrap_or(f64::NAN);
            match d.mass.contains_key(&(j, j)) {
                true => Chosen::Prescribed(j, row, a),
                false => Chosen::Massless(j, row, a),
            }
        }
    });
    Solve {
        pivots: chosen.collect(),
        fill: fill(d, &elimination.order),
        checks: straight.checks.clone(),
    }
}

/// What eliminating in this `order` fills in.
fn fill(d: &Dynamics, order: &[Pivoting]) -> Vec<(usize, usize)> {
    let n = d.force.len();
    let mut near: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    let declared = d.mass.keys().copied();
    let declared = declared.chain(d.jacobian.keys().map(|(row, column)| (n + row, *column)));
    for (a, b) in declared.filter(|(a, b)| a != b) {
        near.entry(a).or_default().insert(b);
        near.entry(b).or_default().insert(a);
    }
    let mut filled = BTreeSet::new();
    for step in order {
        let mut take = |k: usize| {
            let mut neighbours = near.remove(&k).unwrap_or_default();
            neighbours.retain(|a| near.get_mut(a).is_some_and(|of| of.remove(&k)));
            neighbours
        };
        // Each of one side is coupled to each of the other.
        let sides = match *step {
            Pivoting::One(k) => {
                let all = take(k);
                vec![(all.clone(), all)]
            }
            Pivoting::Two(j, c) => {
                let of_j: BTreeSet<usize> = take(j).into_iter().filter(|a| *a != c).collect();
                let of_c = take(c);
                let massive = d.mass.contains_key(&(j, j));
                let itself = massive.then(|| (of_c.clone(), of_c.clone()));
                itself.into_iter().chain([(of_j, of_c)]).collect()
            }
        };
        for (ours, theirs) in sides {
            for a in &ours {
                for b in theirs.iter().filter(|b| *b != a) {
                    near.entry(*b).or_default().insert(*a);
                    if near.entry(*a).or_default().insert(*b) {
                        filled.insert((*a.max(b), *a.min(b)));
                    }
                }
            }
        }
    }
    filled.into_iter().collect()
}
