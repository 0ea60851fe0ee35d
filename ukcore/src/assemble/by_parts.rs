//! The search where equations fall apart, or have solutions that lie apart: all that may be nearer than the one that is found first.

use std::f64::consts::{PI, TAU};

use super::alone::Alone;
use super::search::Search;
use crate::manifold::{At, Manifold, Part};
use crate::mechanism::Prepared;
use crate::random::Random;

/// Guesses: the given one, then it with perturbations of [`SHAKES`] times the size of the coordinates. A guess with points that
/// coincide has vanishing gradients, from which only a perturbation leads away.
pub(super) const SHAKES: [f64; 4] = [0.0, 1e-3, 3e-2, 0.3];

/// Fractional part of the golden ratio: its multiples fill the unit interval evenly.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Beginnings where solutions lie apart and another one may be nearer: the guess, its perturbations, and rounds of others that are ever
/// farther off. After the first round they end when each solution has been met twice and none is known to be missing.
///
/// The chance that the next beginning leads to a solution not yet met is about the share of those met once (Good 1953, The population
/// frequencies of species, Biometrika 40, 237-264). That one is missing is seen from the signs of det ∂φ/∂x: their sum over all solutions,
/// the degree of φ, is that for any other lengths of the bars (Milnor 1965, Topology from the differentiable viewpoint, §5), so 0, as for
/// some there is no solution.
const BEGINNINGS: usize = SHAKES.len() + ROUNDS * ROUND;

/// Random beginnings of one round.
const ROUND: usize = 24;

/// Rounds at most.
const ROUNDS: usize = 5;

/// Random beginnings are the same in every search.
const SEED: u64 = 0x5eed;

/// Solutions nearer than this share of the coordinates are one.
const SAME: f64 = 1e-6;

/// What the guess does not tell of counts so little.
const UNTOLD: f64 = 1e-6;

/// The number of searches for one guess after which parts have one solution each.
const MOST: usize = 20_000;

/// The search for the solution next to the guess, one part after the other.
pub(super) struct ByParts<'a> {
    search: &'a mut Search,
    alone: Alone,
    at: &'a At<'a, f64>,
    guess: &'a [f64],
    parts: &'a [Part],
    /// How large coordinates are.
    extents: Vec<f64>,
    /// A part was met whose solutions do not lie apart, as some of its rows follow from others.
    pub(super) open: bool,
}

/// A solution of some parts.
pub(super) struct Found {
    pub(super) x: Vec<f64>,
    /// Σ (Δq √inertia)² of their unknowns, from the guess where it tells of them.
    pub(super) distance: f64,
}

/// What is found straight from the guess, part by part: where, and for each part that has a solution how far it is.
pub(super) struct Straight {
    x: Vec<f64>,
    distances: Vec<Option<f64>>,
}

impl Straight {
    /// Whether the unknowns of `part` are in `x` as they are here.
    fn goes_through(&self, part: &Part, x: &[f64]) -> bool {
        part.unknowns.iter().all(|j| x[*j] == self.x[*j])
    }

    /// How far the parts `group` are, if all have a solution.
    fn distance(&self, group: &[usize]) -> Option<f64> {
        group.iter().map(|part| self.distances[*part]).sum()
    }
}

/// The solutions of a part that beginnings led to.
#[derive(Default)]
struct Met {
    found: Vec<Found>,
    /// Whether each was met but once.
    once: Vec<bool>,
    /// Sum of the signs of det ∂φ/∂x.
    degree: i32,
}

impl Met {
    /// Whether one of them is the `same`, which is then met again.
    fn knows(&mut self, same: impl Fn(&Found) -> bool) -> bool {
        let known = self.found.iter().position(same);
        if let Some(known) = known {
            self.once[known] = false;
        }
        known.is_some()
    }

    /// Takes another solution, at which det ∂φ/∂x has the sign `orientation`.
    fn enter(&mut self, next: Found, orientation: i32) {
        self.degree += orientation;
        self.found.push(next);
        self.once.push(true);
    }

    /// Whether no other one is expected, or so many are that they do not lie apart.
    fn seem_all(&self) -> bool {
        self.degree == 0 && !self.once.contains(&true) || self.are_many()
    }

    /// Whether they may not lie apart.
    fn are_many(&self) -> bool {
        2 * self.found.len() > ROUND
    }
}

impl<'a> ByParts<'a> {
    pub(super) fn new(
        search: &'a mut Search,
        at: &'a At<'a, f64>,
        guess: &'a [f64],
        parts: &'a [Part],
    ) -> Self {
        ByParts {
            alone: Alone::new(at.mech),
            extents: search.manifold.extents(at, guess),
            search,
            at,
            guess,
            parts,
            open: false,
        }
    }

    /// All parts solved as near to the guess as is found, and what is found straight from it.
    pub(super) fn found_nearest(&mut self) -> Option<(Found, Straight)> {
        let straight = self.straight();
        let all: Vec<usize> = (0..self.parts.len()).collect();
        let guess = self.guess.to_vec();
        let nearest = self.nearest(&all, guess, f64::INFINITY, Some(&straight))?;
        Some((nearest, straight))
    }

    /// All parts solved as near to the guess as is found, and other solutions, the nearest first: each has another solution in one group of
    /// parts that hang together, at most `times` as far from the guess, or `none` away.
    pub(super) fn found_near(&mut self, (times, none): (f64, f64)) -> Option<(Found, Vec<Found>)> {
        let (nearest, straight) = self.found_nearest()?;
        let all: Vec<usize> = (0..self.parts.len()).collect();
        let mut others = Vec::new();
        for group in self.groups(&all) {
            let bound = times.powi(2) * self.distance(&group, &nearest.x).max(none * none);
            let before = (self.guess, Some(&straight));
            self.others(&group, &nearest.x, before, bound, &mut others);
        }
        others.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        Some((nearest, others))
    }

    /// The first solution of each part that is found.
    fn straight(&mut self) -> Straight {
        let (mut x, mut distances) = (self.guess.to_vec(), Vec::new());
        for part in self.parts {
            let known = |needed: &usize| Option::is_some(&distances[*needed]);
            let mut random = Random::new(SEED);
            let found = match part.needs.iter().all(known) {
                true => (0..BEGINNINGS).find_map(|k| self.begin(part, &x, k, &mut random)),
                false => None,
            };
            distances.push(found.map(|found| {
                x = found.x;
                found.distance
            }));
        }
        Straight { x, distances }
    }

    /// `x` with the parts `open`, in their order, solved, less than `bound` from the guess, as near to it as is found. What hangs together
    /// through parts that are solved alone is independent; else each solution of the first part is followed, the nearest first. Where all
    /// before is as it is `straight` from the guess, nothing farther than that is looked for.
    fn nearest(
        &mut self,
        open: &[usize],
        mut x: Vec<f64>,
        bound: f64,
        straight: Option<&Straight>,
    ) -> Option<Found> {
        let mut distance = 0.0;
        for group in self.groups(open) {
            // From everywhere it was in vain.
            if straight.is_some_and(|straight| straight.distances[group[0]].is_none()) {
                return None;
            }
            let mut best = straight.and_then(|straight| {
                let (distance, mut x) = (straight.distance(&group)?, x.clone());
                let unknowns = group.iter().flat_map(|part| &self.parts[*part].unknowns);
                unknowns.for_each(|j| x[*j] = straight.x[*j]);
                Some(Found { x, distance })
            });
            let known = straight.filter(|_| best.is_some());
            let within = |best: &Option<Found>| {
                let best = best.as_ref().map_or(f64::INFINITY, |best| best.distance);
                best.min(bound - distance)
            };
            let firsts = match within(&best) > 0.0 {
                true => self.solutions(group[0], &x, within(&best), known),
                false => Vec::new(),
            };
            for first in firsts {
                let within = within(&best);
                if first.distance >= within {
                    break;
                }
                let part = &self.parts[group[0]];
                let known = known.filter(|known| known.goes_through(part, &first.x));
                let rest = self.nearest(&group[1..], first.x, within - first.distance, known);
                best = rest.map_or(best, |rest| {
                    Some(Found {
                        distance: first.distance + rest.distance,
                        ..rest
                    })
                });
            }
            let best = best.filter(|best| best.distance < bound - distance)?;
            (x, distance) = (best.x, distance + best.distance);
        }
        Some(Found { x, distance })
    }

    /// Other solutions of the parts `group`, which need each other, than `nearest`, less than `bound` from the guess, where all before is
    /// as in `x`, and maybe as it is `straight` from the guess: they branch off it in one part, and from there on are the nearest there.
    fn others(
        &mut self,
        group: &[usize],
        nearest: &[f64],
        (x, straight): (&[f64], Option<&Straight>),
        bound: f64,
        out: &mut Vec<Found>,
    ) {
        let (first, rest) = (group[0], &group[1..]);
        let straight = straight.filter(|straight| straight.distances[first].is_some());
        for found in self.solutions(first, x, bound, straight) {
            let left = bound - found.distance;
            if left <= 0.0 {
                break;
            }
            let unknowns = &self.parts[first].unknowns;
            if !are_one(&self.search.manifold, unknowns, &found.x, nearest) {
                out.extend(self.nearest(rest, found.x, left, None).map(|rest| {
                    let mut x = nearest.to_vec();
                    let unknowns = group.iter().flat_map(|part| &self.parts[*part].unknowns);
                    unknowns.for_each(|j| x[*j] = rest.x[*j]);
                    let distance = found.distance + rest.distance;
                    Found { x, distance }
                }));
                continue;
            }
            let all = self.distance(rest, nearest);
            let known = straight.filter(|known| known.goes_through(&self.parts[first], &found.x));
            for group in self.groups(rest) {
                let others = all - self.distance(&group, nearest);
                self.others(&group, nearest, (&found.x, known), left - others, out);
            }
        }
    }

    /// The parts `open`, in those that need each other, be it through others of them.
    fn groups(&self, open: &[usize]) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for part in open {
            let needed =
                |group: &Vec<usize>| group.iter().any(|p| self.parts[*part].needs.contains(p));
            let (joined, mut apart): (Vec<_>, Vec<_>) = groups.into_iter().partition(needed);
            let mut group: Vec<usize> = joined.into_iter().flatten().collect();
            group.push(*part);
            group.sort_unstable();
            apart.push(group);
            groups = apart;
        }
        groups
    }

    /// The solutions of a part less than `bound` from the guess that are found, where those that it needs are solved, and maybe others, the
    /// nearest first; one where they do not lie apart, or where there is no other one. The one `straight` from the guess may be known.
    fn solutions(
        &mut self,
        part: usize,
        x: &[f64],
        bound: f64,
        straight: Option<&Straight>,
    ) -> Vec<Found> {
        let distance = straight.and_then(|straight| straight.distances[part]);
        let part = &self.parts[part];
        let (mut met, mut random) = (Met::default(), Random::new(SEED));
        for beginning in 0..BEGINNINGS {
            if beginning >= SHAKES.len() + ROUND && met.seem_all() {
                break;
            }
            let known = straight.zip(distance).filter(|_| beginning == 0);
            let next = match known {
                Some((straight, distance)) => {
                    let mut x = x.to_vec();
                    part.unknowns.iter().for_each(|j| x[*j] = straight.x[*j]);
                    Some(Found { x, distance })
                }
                None => self.begin(part, x, beginning, &mut random),
            };
            let Some(next) = next else {
                continue;
            };
            let manifold = &mut self.search.manifold;
            let same = |known: &Found| are_one(manifold, &part.unknowns, &next.x, &known.x);
            if !met.knows(same) {
                let orientation = manifold.orientation(self.at, part, &next.x);
                met.enter(next, orientation);
            }
            let first = met.found[0].distance;
            if !part.is_determined()
                || self.search.begun >= MOST
                || beginning == 0 && self.is_alone(part, x, bound.max(first))
            {
                break;
            }
        }
        met.found.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let apart = match part.is_determined() {
            true => !met.are_many() || self.lie_apart(part, &met.found),
            false => met.found.is_empty(),
        };
        if apart {
            return met.found;
        }
        self.open |= part.is_determined();
        let near = met.found.swap_remove(0);
        vec![self.settled(part, near)]
    }

    /// `x` with the unknowns of `part` moved to a solution that keeps what the guess tells of them, where what it does not follows.
    fn follow(&mut self, part: &Part, x: &[f64]) -> Option<Vec<f64>> {
        let search = &mut *self.search;
        let places = (x, self.guess);
        let found = search
            .manifold
            .settled(self.at, part, places, &search.untold)?;
        search.begun += 1;
        Some(found)
    }

    /// The solution that is next to what the guess tells, of those that do not lie apart from this one.
    fn settled(&mut self, part: &Part, near: Found) -> Found {
        let settled = self.follow(part, &near.x);
        let settled = settled.map(|x| self.found(part, x));
        let nearer = settled.filter(|settled| settled.distance < near.distance);
        nearer.unwrap_or(near)
    }

    /// Whether rows tell one of these solutions of `part` from all beside it.
    fn lie_apart(&mut self, part: &Part, found: &[Found]) -> bool {
        let manifold = &mut self.search.manifold;
        let mut solutions = found.iter();
        solutions.any(|found| manifold.determines(self.at, part, &found.x))
    }

    /// Whether a solution of `part` less than `distance` from the guess, or as far, is the only one there.
    fn is_alone(&mut self, part: &Part, x: &[f64], distance: f64) -> bool {
        let (untold, eases) = (&self.search.untold, self.search.manifold.ease());
        let ease = |j: usize| eases[j] / weight(untold, j);
        let reach = distance.sqrt();
        self.alone
            .holds(self.at, part, (x, self.guess), (reach, &ease))
    }

    /// The solution of `part` that a search from the guess leads to, or, for other beginnings than the first, from somewhere ever farther
    /// off.
    fn begin(
        &mut self,
        part: &Part,
        x: &[f64],
        beginning: usize,
        random: &mut Random,
    ) -> Option<Found> {
        let kept = match beginning {
            0 => self.follow(part, x).map(|x| self.found(part, x)),
            _ => None,
        };
        // Where other solutions lie apart they are looked for.
        if part.is_determined() && kept.is_some() {
            return kept;
        }
        let mut place = x.to_vec();
        if let Some(share) = SHAKES.get(beginning) {
            shake(&mut place, &part.unknowns, |j| share * self.extents[j]);
        } else {
            let share = ((beginning - SHAKES.len()) % ROUND + 1) as f64 / ROUND as f64;
            let mech = self.at.mech;
            scatter(
                mech,
                &mut place,
                &part.unknowns,
                share,
                &self.extents,
                random,
            );
        }
        let found = self.search(part, place).map(|x| self.found(part, x));
        let both = found.into_iter().chain(kept);
        both.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// `x` with the unknowns of `part` moved to a solution.
    fn search(&mut self, part: &Part, mut x: Vec<f64>) -> Option<Vec<f64>> {
        self.search.begun += 1;
        let manifold = &mut self.search.manifold;
        let (near, ..) = manifold.search_part(self.at, part, self.guess, &mut x);
        near.then_some(x)
    }

    /// A solution, with angles turned to those next to the guess.
    fn found(&mut self, part: &Part, x: Vec<f64>) -> Found {
        let mut turned = x.clone();
        let angles = self.at.mech.spec().structure.angles;
        for j in part.unknowns.iter().filter(|j| angles.contains(j)) {
            turned[*j] += TAU * ((self.guess[*j] - x[*j]) / TAU).round();
        }
        // An angle may be more than a direction.
        let turned = (turned != x).then_some(turned);
        let x = turned
            .and_then(|turned| self.search(part, turned))
            .unwrap_or(x);
        let distance = self.distance_of(part, &x);
        Found { x, distance }
    }

    /// Σ (Δq √inertia)² of the unknowns of `part`.
    fn distance_of(&self, part: &Part, x: &[f64]) -> f64 {
        self.search.distance(&part.unknowns, self.guess, x)
    }

    /// Σ (Δq √inertia)² of the unknowns of several parts.
    fn distance(&self, group: &[usize], x: &[f64]) -> f64 {
        let distances = group
            .iter()
            .map(|part| self.distance_of(&self.parts[*part], x));
        distances.sum()
    }
}

/// Whether the coordinates `all` in `x` and `y` are those of one solution.
fn are_one(manifold: &Manifold, all: &[usize], x: &[f64], y: &[f64]) -> bool {
    let most = SAME * manifold.size(x);
    all.iter()
        .all(|j| (x[*j] - y[*j]).abs() <= most * manifold.unit(*j))
}

/// Moves the coordinates `free` at random, by up to a `share` of half a turn, or of how large they are.
pub(crate) fn scatter(
    mech: &Prepared,
    q: &mut [f64],
    free: &[usize],
    share: f64,
    extents: &[f64],
    random: &mut Random,
) {
    let angles = mech.spec().structure.angles;
    for j in free {
        let reach = if angles.contains(j) { PI } else { extents[*j] };
        q[*j] += share * reach * random.signed();
    }
}

/// How much coordinate `j` counts in choosing between solutions.
pub(crate) fn weight(untold: &[usize], j: usize) -> f64 {
    if untold.contains(&j) { UNTOLD } else { 1.0 }
}

/// Moves the coordinates j of `free` by up to `by(j)`: always in the same way, and no two of them alike.
pub(super) fn shake(x: &mut [f64], free: &[usize], by: impl Fn(usize) -> f64) {
    for (k, &j) in free.iter().enumerate() {
        let along = ((k as f64 + 1.0) * GOLDEN).fract();
        x[j] += by(j) * (2.0 * along - 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each solution twice, in turn: of two rows with opposite signs all are met, of one or three another is missing.
    #[test]
    fn an_odd_solution_is_not_the_last() {
        for (signs, all) in [(&[1][..], false), (&[1, -1], true), (&[1, -1, 1], false)] {
            let mut met = Met::default();
            for k in (0..signs.len()).chain(0..signs.len()) {
                let (x, distance) = (vec![1.0 + k as f64], 0.0);
                let next = Found { x, distance };
                if !met.knows(|known| known.x == next.x) {
                    met.enter(next, signs[k]);
                }
            }
            assert_eq!(met.found.len(), signs.len());
            assert_eq!(met.seem_all(), all, "{signs:?}");
        }
    }
}
