//! The order of elimination, found on the pattern of K alone.

use super::pattern::Pattern;
use super::{Pair, Pivoting};
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

impl Order {
    /// Number of coordinates that are taken together with constraints.
    pub(super) fn pairs(&self) -> usize {
        let pair = |pivot: &&Pivoting| matches!(pivot, Pivoting::Pair(_));
        self.pivots.iter().filter(pair).count()
    }
}

/// Which coordinates are taken together with constraints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Taste {
    /// Those without inertia, and those that a constraint prescribes alone; for the other constraints A M⁻¹ Aᵀ is eliminated.
    Multipliers,
    /// All whose coefficient in a constraint is fixed, so that what a constraint gives outright is not solved for. Bodies pinned to each
    /// other are taken leaf by leaf, each with its pins, which is the recursion over articulated bodies.
    Substitution,
}

impl Taste {
    pub(super) const ALL: [Taste; 2] = [Taste::Multipliers, Taste::Substitution];

    fn takes(self, pair: &Pair) -> bool {
        self == Taste::Substitution || !pair.massive || pair.alone
    }
}

/// The pivots in their order; or why there is none.
pub(super) fn order(taste: Taste, mut pattern: Pattern, names: &[String]) -> Result<Order, String> {
    let mut ready = BTreeSet::new();
    let all: BTreeSet<usize> = pattern.left().collect();
    ready.extend(keys(&all, taste, &pattern));
    let (mut pivots, mut entries) = (Vec::new(), 0);
    while let Some((_, at, partner)) = ready.first().copied() {
        let pair = partner.and_then(|constraint| pattern.pair(at, constraint));
        let around = around(at, partner, &pattern);
        for before in keys(&around, taste, &pattern) {
            ready.remove(&before);
        }
        let (pivot, neighbours) = match pair {
            Some(pair) => (Pivoting::Pair(pair), pattern.eliminate_pair(pair)),
            None => (Pivoting::Single(at), pattern.eliminate(at)),
        };
        ready.extend(keys(&around, taste, &pattern));
        pivots.push(pivot);
        entries += neighbours.len().pow(2);
        if entries > MAX_ENTRIES {
            return Err(format!(
                "its elimination would compute more than {MAX_ENTRIES} entries (at `{}`)",
                names[at]
            ));
        }
    }
    if let Some(j) = pattern.coordinates().find(|j| !pattern.has_inertia(*j)) {
        return Err(format!(
            "`{}` has no mass, and no constraint in which its coefficient is a number",
            names[j]
        ));
    }
    let left: Vec<&str> = pattern.left().map(|k| names[k].as_str()).collect();
    match left.is_empty() {
        true => Ok(Order {
            pivots,
            fill: pattern.into_fill(),
        }),
        false => Err(format!(
            "no definite pivot is left among {}",
            left.join(", ")
        )),
    }
}

/// What is compared, and what it is of: a coordinate or constraint alone, or a coordinate with a constraint.
type Key = ([usize; 5], usize, Option<usize>);

/// What the keys that an elimination changes belong to: its neighbours, and what shares a constraint with them.
fn around(at: usize, partner: Option<usize>, pattern: &Pattern) -> BTreeSet<usize> {
    let taken = [Some(at), partner].into_iter().flatten();
    let near: BTreeSet<usize> = taken
        .flat_map(|k| pattern.near(k).chain([k]))
        .collect();
    let constraints = near.iter().filter(|k| !pattern.is_coordinate(**k));
    let sharing = constraints.flat_map(|c| pattern.coordinates_in(*c));
    near.iter().copied().chain(sharing).collect()
}

/// The keys of what can be eliminated, alone or in pairs with others, among `of`.
fn keys(of: &BTreeSet<usize>, taste: Taste, pattern: &Pattern) -> Vec<Key> {
    let mut keys = Vec::new();
    for k in of.iter().copied().filter(|k| pattern.is_left(*k)) {
        let mut pairs: Vec<Pair> = match pattern.is_coordinate(k) {
            true => pattern.constraints_on(k).filter_map(|c| pattern.pair(k, c)).collect(),
            false => pattern.coordinates_in(k).filter_map(|i| pattern.pair(i, k)).collect(),
        };
        pairs.retain(|pair| taste.takes(pair));
        keys.extend(pairs.iter().map(|pair| pair_key(pair, taste, pattern)));
        // A coordinate that is eliminated alone takes the fixed pivots of its constraints with it.
        let kept = taste == Taste::Substitution
            && pattern.is_coordinate(k)
            && pattern.constraints_on(k).any(|c| pattern.has_pair(c));
        if pattern.is_definite(k) && !kept {
            keys.push(single_key(k, taste, pattern));
        }
    }
    keys
}

/// By the number of entries that the pair changes.
fn pair_key(pair: &Pair, taste: Taste, pattern: &Pattern) -> Key {
    let Pair { coordinate, constraint, massive, .. } = *pair;
    let (a, b) = (pattern.neighbours(coordinate) - 1, pattern.neighbours(constraint) - 1);
    let rank = match taste {
        // All before what is eliminated alone.
        Taste::Multipliers => [0, coordinate, b, 0, 0],
        Taste::Substitution => [a * b + usize::from(massive) * b * (b + 1) / 2, 0, 0, 0, 0],
    };
    (rank, coordinate, Some(constraint))
}

/// Multipliers: coordinates that share no inertia come first, since the constraints on them must wait for them in any case. Then what has
/// the fewest neighbours; among equals what was coupled by an elimination, so that a chain is taken link by link; then what waits least.
fn single_key(k: usize, taste: Taste, pattern: &Pattern) -> Key {
    let size = pattern.neighbours(k);
    let first = match taste {
        Taste::Multipliers => [1, usize::from(!pattern.shares_no_inertia(k)), size],
        Taste::Substitution => [size * (size + 1) / 2, 1, 0],
    };
    let [a, b, c] = first;
    let rank = [a, b, c, usize::from(!pattern.was_coupled(k)), pattern.depth(k)];
    (rank, k, None)
}
