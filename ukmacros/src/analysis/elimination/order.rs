//! The order of elimination, found on the pattern of K alone.

use super::pattern::Pattern;
use super::{Pair, Pivoting};
use crate::analysis::dynamics::Dynamics;
use crate::expr::Graph;
use std::collections::BTreeSet;

/// Programs larger than this are not worth their compile time: the solve is then left to the runtime.
const MAX_ENTRIES: usize = 20_000;

/// An order of elimination, and what it does to the pattern of K.
#[derive(Clone)]
pub(super) struct Order {
    pub(super) pivots: Vec<Pivoting>,
    /// Positions (row > column) that are zero in K and filled.
    pub(super) fill: Vec<(usize, usize)>,
}

/// The pivots in their order; or why there is none.
pub(super) fn order(d: &Dynamics, names: &[String], g: &Graph) -> Result<Order, String> {
    let mut pattern = Pattern::new(d);
    let mut pivots = pairs(&mut pattern, d, g);
    if let Some(j) = pattern.coordinates().find(|j| !pattern.has_inertia(*j)) {
        return Err(format!(
            "`{}` has no mass, and no constraint in which its coefficient is a number",
            names[j]
        ));
    }
    pivots.extend(singles(&mut pattern, names)?);
    Ok(Order {
        pivots,
        fill: pattern.into_fill(),
    })
}

/// Eliminates the coordinates that have no inertia or that a constraint prescribes alone, each time the first that there is.
fn pairs(pattern: &mut Pattern, d: &Dynamics, g: &Graph) -> Vec<Pivoting> {
    let mut pivots = Vec::new();
    let mut open: BTreeSet<usize> = pattern.coordinates().collect();
    while let Some(coordinate) = open.pop_first() {
        let Some(pair) = partner(coordinate, pattern, d, g) else {
            continue;
        };
        let neighbours = pattern.eliminate_pair(pair);
        // What shared a constraint with it may now be prescribed alone.
        for constraint in neighbours.range(d.force.len()..) {
            open.extend(pattern.coordinates_in(*constraint));
        }
        open.remove(&coordinate);
        pivots.push(Pivoting::Pair(pair));
    }
    pivots
}

/// The constraint of fewest neighbours that `coordinate` can be eliminated with: its coefficient there is a number and, if it has
/// inertia, it is alone in it. A substitution that is not trivial gives its neighbours new entries, so that later coefficients are no
/// longer those of A: only untouched rows and columns are taken.
fn partner(coordinate: usize, pattern: &Pattern, d: &Dynamics, g: &Graph) -> Option<Pair> {
    let massive = pattern.has_inertia(coordinate);
    let fits = |c: &usize| {
        let alone = pattern.neighbours(*c) == 1;
        pattern.is_untouched(*c) && pattern.is_untouched(coordinate) && (alone || !massive)
    };
    let pairs = pattern.constraints_on(coordinate).filter(fits);
    let pairs = pairs.filter_map(|constraint| {
        let entry = d.jacobian.get(&(constraint - d.force.len(), coordinate))?;
        let coefficient = g.as_const(*entry).filter(|a| *a != 0.0)?;
        Some(Pair {
            coordinate,
            constraint,
            coefficient,
            massive,
        })
    });
    pairs.min_by_key(|pair| pattern.neighbours(pair.constraint))
}

/// Eliminates all that is left, each time what comes first by [`key`].
fn singles(pattern: &mut Pattern, names: &[String]) -> Result<Vec<Pivoting>, String> {
    let keys = |pattern: &Pattern, of: &mut dyn Iterator<Item = usize>| -> Vec<_> {
        of.filter(|k| pattern.is_definite(*k))
            .map(|k| key(k, pattern))
            .collect()
    };
    let mut pivots = Vec::new();
    let mut entries = 0;
    let mut ready: BTreeSet<Key> = keys(pattern, &mut pattern.left()).into_iter().collect();
    while let Some((.., k)) = ready.pop_first() {
        for before in keys(pattern, &mut pattern.near(k)) {
            ready.remove(&before);
        }
        let neighbours = pattern.eliminate(k);
        ready.extend(keys(pattern, &mut neighbours.iter().copied()));
        pivots.push(Pivoting::Single(k));
        entries += neighbours.len().pow(2);
        if entries > MAX_ENTRIES {
            return Err(format!(
                "its elimination would compute more than {MAX_ENTRIES} entries (at `{}`)",
                names[k]
            ));
        }
    }
    let left: Vec<&str> = pattern.left().map(|k| names[k].as_str()).collect();
    match left.is_empty() {
        true => Ok(pivots),
        false => Err(format!(
            "no definite pivot is left among {}",
            left.join(", ")
        )),
    }
}

/// What is compared: whether it shares inertia, its number of neighbours, whether no elimination coupled it, what it waits for, its
/// position.
type Key = (bool, usize, bool, usize, usize);

/// Coordinates that share no inertia come first: the constraints on them must wait for them in any case. Then what has the fewest
/// neighbours; among equals what was coupled by an elimination, so that a chain is taken link by link; then what waits least.
fn key(k: usize, pattern: &Pattern) -> Key {
    let (shares, coupled) = (!pattern.shares_no_inertia(k), pattern.was_coupled(k));
    (shares, pattern.neighbours(k), !coupled, pattern.depth(k), k)
}
