//! Hubs: coordinates that many otherwise separate parts share, as the angle of a shaft that drives a dozen legs.
//!
//! Eliminated as one coordinate a hub couples all constraints on it with each other. So it may be written once for each part, q_0 = q_1 = …
//! = q_k, tied one to the next: a coordinate more and a constraint more for each further part, with the inertia divided among them. The
//! motion is the same, and each part is coupled to its neighbours alone.

use super::dynamics::Dynamics;
use super::groups::Groups;
use crate::expr::Graph;
use std::collections::{BTreeMap, BTreeSet};

/// What fewer constraints act on is no hub.
const CONSTRAINTS: usize = 6;
/// A hub of fewer parts is left as it is.
const PARTS: usize = 3;

/// Equations with the copies of hubs as further coordinates, and the ties as further constraints.
pub(super) struct Divided {
    pub(super) dynamics: Dynamics,
    /// The hub that each further coordinate is a copy of.
    pub(super) copies: Vec<usize>,
}

/// Divides the hubs, if there are any.
pub(super) fn divided(d: &Dynamics, g: &mut Graph) -> Option<Divided> {
    let hubs = hubs(d, g);
    let parts = parts(d, &hubs);
    let (n, m) = (d.force.len(), d.rhs.len());
    let (zero, one, minus) = (g.zero(), g.one(), g.constant(-1.0));
    let mut found = Divided {
        dynamics: d.clone(),
        copies: Vec::new(),
    };
    let of = &mut found.dynamics;
    for hub in hubs {
        let rows = d
            .jacobian
            .keys()
            .filter(|(_, i)| *i == hub)
            .map(|(row, _)| *row);
        let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for row in rows {
            groups.entry(parts[row]).or_default().push(row);
        }
        if groups.len() < PARTS {
            continue;
        }
        #[allow(clippy::cast_precision_loss, reason = "far fewer than 2⁵³ parts")]
        let inertia = g.scale(1.0 / groups.len() as f64, d.mass[&(hub, hub)]);
        of.mass.insert((hub, hub), inertia);
        let mut before = hub;
        for rows in groups.into_values().skip(1) {
            let (copy, tie) = (n + found.copies.len(), m + found.copies.len());
            found.copies.push(hub);
            of.mass.insert((copy, copy), inertia);
            of.widen(1, zero);
            of.jacobian.insert((tie, before), one);
            of.jacobian.insert((tie, copy), minus);
            for row in rows {
                if let Some(a) = of.jacobian.remove(&(row, hub)) {
                    of.jacobian.insert((row, copy), a);
                }
            }
            before = copy;
        }
    }
    (!found.copies.is_empty()).then_some(found)
}

/// Coordinates in many constraints, with inertia of their own that is the same at all states.
fn hubs(d: &Dynamics, g: &Graph) -> Vec<usize> {
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    for (_, i) in d.jacobian.keys() {
        *counts.entry(*i).or_default() += 1;
    }
    let shared: BTreeSet<usize> = (d.mass.keys().filter(|(i, j)| i != j))
        .flat_map(|(i, j)| [*i, *j])
        .collect();
    let fixed = |i: &usize| d.mass.get(&(*i, *i)).is_some_and(|m| g.uses(*m).constant());
    let many = counts
        .into_iter()
        .filter(|(_, count)| *count >= CONSTRAINTS);
    let many = many.map(|(i, _)| i);
    many.filter(|i| !shared.contains(i) && fixed(i)).collect()
}

/// The part that each constraint belongs to: constraints on one coordinate that is no hub, or on coordinates that share inertia, are of
/// one.
fn parts(d: &Dynamics, hubs: &[usize]) -> Vec<usize> {
    let (n, m) = (d.force.len(), d.rhs.len());
    let mut groups = Groups::new(n + m);
    let rows = d.jacobian.keys().map(|(row, i)| (n + row, *i));
    let links = rows.chain(d.mass.keys().copied());
    for (a, b) in links.filter(|(_, i)| !hubs.contains(i)) {
        groups.join(a, b);
    }
    (0..m).map(|row| groups.of(n + row)).collect()
}
