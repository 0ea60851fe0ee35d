//! The order of elimination: found on the pattern of K alone.

use super::Pivoting;
use crate::analysis::dynamics::Dynamics;
use crate::expr::Graph;
use std::collections::BTreeSet;

/// Programs larger than this are not worth their compile time: the solve is then left to the runtime.
const MAX_ENTRIES: usize = 20_000;

/// Adjacency of K = [M Aᵀ; A 0]: coordinates 0..n, constraints n..n + m.
fn adjacency(d: &Dynamics) -> Vec<BTreeSet<usize>> {
    let n = d.force.len();
    let mut near = vec![BTreeSet::new(); n + d.rhs.len()];
    let mut join = |a: usize, b: usize| {
        if a != b {
            near[a].insert(b);
            near[b].insert(a);
        }
    };
    for (i, j) in d.mass.keys() {
        join(*i, *j);
    }
    for (row, column) in d.jacobian.keys() {
        join(n + row, *column);
    }
    near
}

/// The pivots in their order; or why there is none.
pub(super) fn order(d: &Dynamics, names: &[String], g: &Graph) -> Result<Vec<Pivoting>, String> {
    let n = d.force.len();
    let mut near = adjacency(d);
    // The coordinates in each constraint.
    let mut contained: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); near.len()];
    for (row, column) in d.jacobian.keys() {
        contained[n + row].insert(*column);
    }
    let mut inertia: Vec<bool> = (0..n).map(|i| d.mass.contains_key(&(i, i))).collect();
    let mut alive: BTreeSet<usize> = (0..near.len()).collect();
    let mut depth = vec![0_usize; near.len()];
    let mut order = Vec::new();
    let number = |row: usize, j: usize| d.jacobian.get(&(row, j)).and_then(|a| g.as_const(*a));
    // Prescribed and massless coordinates. A substitution that is not trivial gives its neighbours new entries, so that later
    // coefficients are no longer those of A: only untouched rows and columns are taken.
    let mut touched: BTreeSet<usize> = BTreeSet::new();
    loop {
        let candidate = (0..n)
            .filter(|j| alive.contains(j) && !touched.contains(j))
            .find_map(|j| {
                let rows = near[j]
                    .iter()
                    .copied()
                    .filter(|c| *c >= n && !touched.contains(c));
                let fit = rows.filter(|c| number(c - n, j).is_some_and(|a| a != 0.0));
                // Prescribed: the constraint contains nothing else that is alive.
                let alone = |c: usize| near[c].len() == 1;
                let massless = !inertia[j];
                fit.filter(|c| massless || alone(*c))
                    .min_by_key(|c| near[*c].len())
                    .map(|c| (j, c))
            });
        let Some((j, c)) = candidate else { break };
        order.push(Pivoting::Two(j, c));
        let (of_j, of_c) = (near[j].clone(), near[c].clone());
        for r in of_j
            .iter()
            .chain(&of_c)
            .copied()
            .filter(|r| *r != j && *r != c)
        {
            near[r].remove(&j);
            near[r].remove(&c);
        }
        alive.remove(&j);
        alive.remove(&c);
        let massive = inertia[j];
        // The update couples the neighbours of one with those of the other, and, if j has inertia, those of c among themselves.
        let mut couple = |a: usize, b: usize| {
            if a == b {
                if a < n {
                    inertia[a] = true;
                }
            } else {
                near[a].insert(b);
                near[b].insert(a);
                for (c, q) in [(a, b), (b, a)] {
                    if c >= n && q < n {
                        contained[c].insert(q);
                    }
                }
            }
            touched.insert(a);
            touched.insert(b);
        };
        for a in of_j.iter().copied().filter(|r| *r != c) {
            for b in of_c.iter().copied().filter(|r| *r != j) {
                couple(a, b);
            }
        }
        if massive {
            for a in of_c.iter().copied().filter(|r| *r != j) {
                for b in of_c.iter().copied().filter(|r| *r != j) {
                    couple(a, b);
                }
            }
        }
    }
    let mut coordinates = alive.range(..n);
    if let Some(j) = coordinates.find(|j| !inertia[**j]) {
        return Err(format!(
            "`{}` has no mass, and no constraint in which its coefficient is a number",
            names[*j]
        ));
    }
    // Definite pivots.
    let mut entries = 0;
    let mut coupled = vec![false; near.len()];
    while !alive.is_empty() {
        // With all its coordinates gone, what is left of a constraint is definite, though it may be coupled to others that share inertia.
        let ready = |k: &usize| *k < n || contained[*k].iter().all(|q| !alive.contains(q));
        // A coordinate that shares no inertia comes first: the constraints on it must wait for it in any case.
        let single = |k: usize| k < n && near[k].iter().all(|r| *r >= n);
        let candidates = alive.iter().copied().filter(ready);
        // Among equals what was coupled by an elimination comes first, so that a chain is taken link by link; then what waits least.
        let next =
            candidates.min_by_key(|k| (!single(*k), near[*k].len(), !coupled[*k], depth[*k], *k));
        let Some(k) = next else {
            let left: Vec<&str> = alive.iter().map(|k| names[*k].as_str()).collect();
            return Err(format!(
                "no definite pivot is left among {}",
                left.join(", ")
            ));
        };
        order.push(Pivoting::One(k));
        alive.remove(&k);
        let neighbours: Vec<usize> = near[k].iter().copied().collect();
        // Only constraints divide on the critical path; coordinates with constant inertia do not.
        let later = depth[k] + usize::from(k >= n);
        for (p, a) in neighbours.iter().enumerate() {
            near[*a].remove(&k);
            coupled[*a] = true;
            depth[*a] = depth[*a].max(later);
            for b in &neighbours[p + 1..] {
                near[*a].insert(*b);
                near[*b].insert(*a);
            }
            entries += neighbours.len();
        }
        if entries > MAX_ENTRIES {
            return Err(format!(
                "its elimination would compute more than {MAX_ENTRIES} entries (at `{}`)",
                names[k]
            ));
        }
    }
    Ok(order)
}
