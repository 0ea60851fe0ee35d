//! What was decided about the solve and what it costs, for the reader of `Mechanism::plan`.

use super::cost::{Operations, cost, dense};
use super::dynamics::Dynamics;
use super::elimination::{Pivoting, SAFE_SHARE, Straight};
use super::structure::Structure;
use crate::expr::Graph;
use std::collections::{BTreeMap, BTreeSet};

/// Decisions and costs. Positions: coordinate i is i, constraint i is n + i.
pub(crate) struct Plan {
    /// The facts it rests on.
    pub(crate) structure: Structure,
    /// The order, or why there is none.
    pub(crate) pivots: Result<Vec<Chosen>, String>,
    /// Positions (row > column) that are zero in [M Aᵀ; A 0] and filled by its elimination.
    pub(crate) fill: Vec<(usize, usize)>,
    /// What the certificate compares: positions, and whether against the diagonal that the pivot started from (else against zero).
    pub(crate) checks: Vec<(usize, bool)>,
    /// The least share of that diagonal.
    pub(crate) least_share: f64,
    /// Of a dense LDLᵀ.
    pub(crate) dense: Operations,
    /// Of the straight line with nothing hoisted.
    pub(crate) unprepared: Operations,
}

/// A pivot and why it is one.
pub(crate) enum Chosen {
    /// Coordinate and constraint (row) with its coefficient; the coordinate has inertia.
    Prescribed(usize, usize, f64),
    /// The same; the coordinate has none.
    Massless(usize, usize, f64),
    Coordinate(usize),
    /// Row.
    Constraint(usize),
}

/// Collects what is to be told of `straight`, before anything is hoisted.
pub(crate) fn plan(
    structure: Structure,
    d: &Dynamics,
    straight: &Result<Straight, String>,
    g: &Graph,
) -> Plan {
    let n = d.force.len();
    let mut plan = Plan {
        structure,
        pivots: Ok(Vec::new()),
        fill: Vec::new(),
        checks: Vec::new(),
        least_share: SAFE_SHARE,
        dense: dense(n + d.rhs.len()),
        unprepared: Operations::default(),
    };
    match straight {
        Err(reason) => plan.pivots = Err(reason.clone()),
        Ok(straight) => {
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
            plan.pivots = Ok(chosen.collect());
            plan.fill = fill(d, &elimination.order);
            plan.checks.clone_from(&straight.checks);
            let mut values = elimination.acceleration.clone();
            values.push(straight.certificate);
            plan.unprepared = cost(g, &values);
        }
    }
    plan
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
