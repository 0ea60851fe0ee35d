//! The order of rotations: of points on rods first, then leaf by leaf what these leave.

use super::Rotation;
use super::pattern::Pattern;
use std::collections::{BTreeMap, BTreeSet};

/// All rotations that there are, those of what was declared first, then those that change least, and of these what waits least; and how
/// many entries they change.
pub(super) fn freedoms(mut pattern: Pattern) -> (Vec<Rotation>, usize) {
    let mut ready: BTreeSet<([usize; 3], usize)> = BTreeSet::new();
    let mut known: Vec<Option<[usize; 3]>> = Vec::new();
    let mut open: BTreeSet<usize> = pattern.left().collect();
    let (mut found, mut changes) = (Vec::new(), 0);
    loop {
        for c in open {
            known.resize(known.len().max(c + 1), None);
            let rotation = pattern.rotation(c);
            let key = rotation.map(|r| {
                let (changed, waits) = (pattern.changed_by_rotation(r), pattern.waits(r));
                [waits.min(1), changed, waits]
            });
            if key != known[c] {
                if let Some(key) = known[c] {
                    ready.remove(&(key, c));
                }
                ready.extend(key.map(|key| (key, c)));
                known[c] = key;
            }
        }
        let Some((key, c)) = ready.pop_first() else {
            break;
        };
        known[c] = None;
        let Some(rotation) = pattern.rotation(c) else {
            break;
        };
        changes += key[1];
        found.push((rotation, key[2] > 0, pattern.around(rotation)));
        pattern.turn(rotation);
        let [place, _] = rotation.coordinates;
        let near = pattern.near(place).chain([place]);
        open = near.flat_map(|k| pattern.near(k)).collect();
    }
    (late(&found), changes)
}

/// Orders rotations, given with what they touch and whether they wait for others: those that do not wait come as late as the others allow,
/// so that what they leave is soon used.
fn late(found: &[(Rotation, bool, BTreeSet<usize>)]) -> Vec<Rotation> {
    let mut first: BTreeMap<usize, Rotation> = BTreeMap::new();
    for (rotation, waits, _) in found {
        if !waits {
            first.extend(rotation.coordinates.map(|i| (i, *rotation)));
        }
    }
    let mut rotations = Vec::new();
    let mut take = |i: &usize, rotations: &mut Vec<Rotation>| {
        let Some(rotation) = first.remove(i) else {
            return;
        };
        for i in rotation.coordinates {
            first.remove(&i);
        }
        rotations.push(rotation);
    };
    for (rotation, _, around) in found.iter().filter(|(_, waits, _)| *waits) {
        let touched = rotation.coordinates.iter().chain(around);
        touched.for_each(|i| take(i, &mut rotations));
        rotations.push(*rotation);
    }
    for (rotation, ..) in found {
        take(&rotation.coordinates[0], &mut rotations);
    }
    rotations
}
