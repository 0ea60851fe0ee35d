//! The order of elimination, found on the pattern of K alone.

use super::freedoms::freedoms;
use super::pattern::Pattern;
use super::{Pair, Pivoting};
use crate::analysis::dynamics::Dynamics;
use crate::expr::Graph;
use std::collections::{BTreeMap, BTreeSet};

/// Programs larger than this are not worth their compile time: the solve is then left to the runtime.
const MAX_ENTRIES: usize = 20_000;

/// An order of elimination, and what it does to the pattern of K.
#[derive(Clone)]
pub struct Order {
    pub pivots: Vec<Pivoting>,
    /// Positions (row > column) that are zero in K and filled.
    pub(super) fill: Vec<(usize, usize)>,
    /// How many entries its steps change.
    pub changes: usize,
}

impl Order {
    /// The positions of those constraints in `rows` that are eliminated alone; coordinates are `n`.
    pub(super) fn alone(&self, n: usize, rows: &BTreeSet<usize>) -> BTreeSet<usize> {
        let alone = self.pivots.iter().filter_map(|pivot| match *pivot {
            Pivoting::Single(k) if k >= n && rows.contains(&(k - n)) => Some(k),
            _ => None,
        });
        alone.collect()
    }

    /// How many coordinates it divides by the inertia of, where that depends on parameters: they may make it small, or zero.
    pub fn inertias(&self, d: &Dynamics, g: &Graph) -> usize {
        let singles = self.pivots.iter().filter_map(|pivot| match *pivot {
            Pivoting::Single(k) => d.mass.get(&(k, k)),
            _ => None,
        });
        let open = singles.filter(|m| g.uses(**m).constant() && g.as_const(**m).is_none());
        open.count()
    }

    /// Coordinates that are taken together with constraints, and these.
    pub(super) fn pairs(&self) -> BTreeSet<(usize, usize)> {
        let pairs = self.pivots.iter().filter_map(|pivot| match pivot {
            Pivoting::Pair(pair) => Some((pair.coordinate, pair.constraint)),
            Pivoting::Rotation(rotation) => Some((rotation.coordinates[1], rotation.constraint)),
            Pivoting::Single(_) => None,
        });
        pairs.collect()
    }
}

/// Which coordinates are taken together with constraints, and when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Taste {
    /// The coordinates without inertia, and those that a constraint prescribes alone; for the other constraints A M⁻¹ Aᵀ is eliminated.
    Multipliers,
    /// All whose coefficient in a constraint is fixed, those that no other constraint contains first: bodies pinned to each other are taken
    /// leaf by leaf, each with its pins, which is the recursion over articulated bodies.
    Leaves,
    /// The coordinates of [`Leaves`](Taste::Leaves), with what changes the fewest entries first, as from the ground on; among equals what
    /// leaves no division to run time.
    Roots,
    /// The coordinates of [`Leaves`](Taste::Leaves), with what was declared last first: of velocities that are given by each other the
    /// last, and each joint once it can be.
    Last,
    /// The coordinates of [`Multipliers`](Taste::Multipliers), after what is alone with a constraint in pairs is turned: see
    /// [`super::rotation`].
    Freedoms,
}

impl Taste {
    pub(super) const ALL: [Taste; 5] = [
        Taste::Multipliers,
        Taste::Leaves,
        Taste::Roots,
        Taste::Last,
        Taste::Freedoms,
    ];

    /// Whether coordinates with inertia are taken together with constraints that contain others.
    fn substitutes(self) -> bool {
        !matches!(self, Taste::Multipliers | Taste::Freedoms)
    }

    fn takes(self, pair: &Pair) -> bool {
        self.substitutes() || !pair.massive || pair.alone
    }
}

/// The pivots in their order; or why there is none.
pub(super) fn order(taste: Taste, mut pattern: Pattern, names: &[String]) -> Result<Order, String> {
    let (mut pivots, mut entries, mut changes) = (Vec::new(), 0, 0);
    if taste == Taste::Freedoms {
        let rotations;
        (rotations, changes) = freedoms(pattern.clone());
        if rotations.is_empty() {
            return Err("no constraint contains two coordinates alone".to_owned());
        }
        for rotation in rotations {
            pattern.turn(rotation);
            pivots.push(Pivoting::Rotation(rotation));
        }
    }
    let mut keys = Keys::new(taste, &pattern);
    while let Some((_, at, partner)) = keys.ready.first().copied() {
        let pair = partner.and_then(|constraint| pattern.pair(at, constraint));
        debug_assert_eq!(pair.is_some(), partner.is_some());
        let around = around(at, partner, &pattern);
        changes += match &pair {
            Some(pair) => changed_by_pair(pair, &pattern),
            None => changed_by(at, &pattern),
        };
        let (pivot, neighbours) = match pair {
            Some(pair) => (Pivoting::Pair(pair), pattern.eliminate_pair(pair)),
            None => (Pivoting::Single(at), pattern.eliminate(at)),
        };
        keys.renew(&around, &pattern);
        pivots.push(pivot);
        entries += neighbours.len().pow(2);
        if entries > MAX_ENTRIES {
            return Err(format!(
                "its elimination would compute more than {MAX_ENTRIES} entries (at `{}`)",
                names[at]
            ));
        }
    }
    if let Some(j) = pattern.coordinates().find(|j| !pattern.inertia[*j]) {
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
            changes,
        }),
        false => Err(format!(
            "no definite pivot is left among {}",
            left.join(", ")
        )),
    }
}

/// What is compared, and what it is of: a coordinate or constraint alone, or a coordinate with a constraint.
type Key = ([usize; 5], usize, Option<usize>);

/// What the keys that an elimination changes belong to: its neighbours, what shares a constraint with them, and the coordinates in the
/// constraints among these, which wait for the pairs that such a constraint has.
fn around(at: usize, partner: Option<usize>, pattern: &Pattern) -> BTreeSet<usize> {
    let taken = [Some(at), partner].into_iter().flatten();
    let near: BTreeSet<usize> = taken.flat_map(|k| pattern.near(k).chain([k])).collect();
    let sharing = near.iter().flat_map(|k| pattern.near(*k));
    let sharing: BTreeSet<usize> = near.iter().copied().chain(sharing).collect();
    let constraints = sharing.iter().filter(|k| !pattern.is_coordinate(**k));
    let waiting = constraints.flat_map(|c| pattern.coordinates_in(*c));
    sharing.iter().copied().chain(waiting).collect()
}

/// The keys of all that can be eliminated.
struct Keys {
    taste: Taste,
    ready: BTreeSet<Key>,
    /// The keys by what they are of; those of pairs are of the coordinate.
    of: Vec<Vec<Key>>,
}

impl Keys {
    fn new(taste: Taste, pattern: &Pattern) -> Self {
        let left: BTreeSet<usize> = pattern.left().collect();
        let mut keys = Keys {
            taste,
            ready: BTreeSet::new(),
            of: vec![Vec::new(); left.last().map_or(0, |k| k + 1)],
        };
        keys.renew(&left, pattern);
        keys
    }

    /// Brings those of `changed` up to date.
    fn renew(&mut self, changed: &BTreeSet<usize>, pattern: &Pattern) {
        // Whether a constraint has a pair.
        let mut pairs: BTreeMap<usize, bool> = BTreeMap::new();
        for k in changed {
            let now = self.now(*k, pattern, &mut pairs);
            if now != self.of[*k] {
                for before in &self.of[*k] {
                    self.ready.remove(before);
                }
                self.ready.extend(&now);
                self.of[*k] = now;
            }
        }
    }

    fn now(&self, k: usize, pattern: &Pattern, known: &mut BTreeMap<usize, bool>) -> Vec<Key> {
        let (taste, mut keys) = (self.taste, Vec::new());
        if !pattern.is_left(k) {
            return keys;
        }
        // A coordinate that is eliminated alone takes the fixed pivots of its constraints with it.
        let mut kept = false;
        if pattern.is_coordinate(k) {
            for constraint in pattern.constraints_on(k) {
                let pair = pattern.pair(k, constraint);
                kept |= pair.is_some()
                    || *known
                        .entry(constraint)
                        .or_insert_with(|| pattern.has_pair(constraint));
                let pair = pair.filter(|pair| taste.takes(pair));
                keys.extend(pair.map(|pair| pair_key(&pair, taste, pattern)));
            }
        }
        if pattern.is_definite(k) && (!taste.substitutes() || !kept) {
            keys.push(single_key(k, taste, pattern));
        }
        keys
    }
}

/// How many entries eliminating `k` alone changes.
fn changed_by(k: usize, pattern: &Pattern) -> usize {
    let size = pattern.neighbours(k);
    size * (size + 1) / 2
}

/// How many entries eliminating the pair changes.
fn changed_by_pair(pair: &Pair, pattern: &Pattern) -> usize {
    let near = |k| pattern.neighbours(k) - 1;
    let (a, b) = (near(pair.coordinate), near(pair.constraint));
    a * b + usize::from(pair.massive) * b * (b + 1) / 2
}

/// The key of a pair: the number of constraints that wait for the coordinate, or of entries that the pair fills or changes.
fn pair_key(pair: &Pair, taste: Taste, pattern: &Pattern) -> Key {
    let (coordinate, constraint) = (pair.coordinate, pair.constraint);
    let changed = changed_by_pair(pair, pattern);
    let others = || pattern.constraints_on(coordinate).count() - 1;
    let rank = match taste {
        // All before what is eliminated alone.
        Taste::Multipliers | Taste::Freedoms => {
            [0, coordinate, pattern.neighbours(constraint), 0, 0]
        }
        Taste::Leaves => [others(), pattern.filled_by_pair(pair), changed, 0, 0],
        Taste::Roots => [changed, 0, 0, 0, 0],
        Taste::Last => [others(), usize::MAX - coordinate, 0, 0, 0],
    };
    (rank, coordinate, Some(constraint))
}

/// Multipliers: coordinates that share no inertia come first, since the constraints on them must wait for them in any case. Then what has
/// the fewest neighbours; among equals what was coupled by an elimination, so that a chain is taken link by link; then what waits least.
fn single_key(k: usize, taste: Taste, pattern: &Pattern) -> Key {
    let (size, changed) = (pattern.neighbours(k), changed_by(k, pattern));
    let [a, b, c] = match taste {
        Taste::Multipliers | Taste::Freedoms => {
            [1, usize::from(!pattern.shares_no_inertia(k)), size]
        }
        Taste::Leaves => [0, pattern.filled_by(k), changed],
        Taste::Roots => [changed, 1, usize::from(!pattern.lasting.contains(&k))],
        Taste::Last => [0, 0, changed],
    };
    let waits = pattern.depth[k];
    let rank = [a, b, c, usize::from(!pattern.coupled[k]), waits];
    (rank, k, None)
}
