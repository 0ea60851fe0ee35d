//! The search for q, then for q̇.

use std::f64::consts::{PI, TAU};

use super::alone::Alone;
use super::{Held, State};
use crate::error::Error;
use crate::manifold::{At, Level, Manifold, Part, parts};
use crate::mechanism::Prepared;
use crate::random::Random;
use crate::scan::{largest, largest_difference};

/// Guesses: the given one, then it with perturbations of [`SHAKES`] times the size of the coordinates. A guess with points that
/// coincide has vanishing gradients, from which only a perturbation leads away.
const SHAKES: [f64; 4] = [0.0, 1e-3, 3e-2, 0.3];

/// Fractional part of the golden ratio: its multiples fill the unit interval evenly.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Beginnings where solutions lie apart and another one may be nearer: the guess, its perturbations, and more that are ever farther off.
const BEGINNINGS: usize = 28;

/// Random beginnings are the same in every search.
const SEED: u64 = 0x5eed;

/// Solutions nearer than this share of the coordinates are one.
const SAME: f64 = 1e-6;

/// What the guess does not tell of counts so little.
const UNTOLD: f64 = 1e-6;

/// After so many searches for one guess parts have one solution each.
const MOST: usize = 20_000;

/// The search for q, then for q̇.
pub(crate) struct Search {
    pub(crate) manifold: Manifold,
    /// Coordinates that may change.
    pub(crate) free: Vec<usize>,
    /// Coordinates that do not choose between solutions.
    pub(super) untold: Vec<usize>,
    /// Searches for solutions of parts so far.
    pub(super) begun: usize,
}

impl Search {
    pub(crate) fn new(mech: &Prepared, guess: &State, held: &[usize]) -> Self {
        let n = mech.spec().n();
        let mut mass = vec![0.0; n * n];
        mech.mass_matrix(guess.t, &guess.q, &mut mass);
        let inertia = |j: usize| Some(mass[j * n + j]).filter(|m| *m > 0.0 && m.is_finite());
        let massive: Vec<f64> = (0..n).filter_map(inertia).map(f64::ln).collect();
        // Massless coordinates move as readily as the middling massive ones.
        let typical = (massive.iter().sum::<f64>() / massive.len().max(1) as f64).exp();
        // How readily each moves: 1/√M_jj.
        let ease = |j: usize| inertia(j).unwrap_or(typical).sqrt().recip();
        Search {
            manifold: Manifold::with_ease(mech, (0..n).map(ease).collect(), held.to_vec()),
            untold: Vec::new(),
            begun: 0,
            free: (0..n).filter(|j| !held.contains(j)).collect(),
        }
    }

    /// The state at `q` whose velocities are next to those of `guess`.
    pub(crate) fn velocities(
        mech: &Prepared,
        guess: &State,
        held: &Held,
        q: Vec<f64>,
    ) -> Result<State, Error> {
        let mut search = Search::new(mech, guess, &held.velocities);
        let v = held.rates(&q, &guess.v);
        let v = search.find(&At::new(mech, Level::Velocity, guess.t, &q), &v)?;
        Ok(State { t: guess.t, q, v })
    }

    /// The solution where the equations fall apart, or have solutions that lie apart, next to the guess; `None` where they do neither, or
    /// where none is found that way.
    fn find_by_parts(&mut self, at: &At<'_, f64>, guess: &[f64]) -> Option<Vec<f64>> {
        let pattern = at.mech.spec().structure.jacobian_pattern;
        let parts = parts(pattern, at.rows(), &self.free);
        let determined = parts.first().is_some_and(Part::is_determined);
        if at.level != Level::Position || parts.len() < 2 && !determined {
            return None;
        }
        let mut by_parts = ByParts {
            alone: Alone::new(at.mech),
            search: self,
            at,
            guess,
            parts: &parts,
        };
        let straight = by_parts.straight();
        let all: Vec<usize> = (0..parts.len()).collect();
        let found = by_parts.nearest(&all, guess.to_vec(), f64::INFINITY, Some(&straight));
        let mut x = found?.x;
        self.manifold.project(at, &mut x).is_ok().then_some(x)
    }

    /// The solution for one level; tries the guess, then perturbations of it, and all of them again with coordinates that move alike.
    pub(crate) fn find(&mut self, at: &At<'_, f64>, guess: &[f64]) -> Result<Vec<f64>, Error> {
        let mut x = guess.to_vec();
        if at.linear() && self.manifold.project(at, &mut x).is_ok() {
            return Ok(x);
        }
        if let Some(x) = self.find_by_parts(at, guess) {
            return Ok(x);
        }
        let size = match largest(guess) {
            size if size > 0.0 => size,
            _ => 1.0,
        };
        let mut least = f64::INFINITY;
        // Of what is linear there is nothing else to find.
        let shakes = if at.linear() { &SHAKES[..1] } else { &SHAKES };
        for even in [false, true] {
            // Where inertias are orders apart, rows with a light coordinate all but vanish beside the others, and the way along those is long.
            if even {
                self.manifold.even();
            }
            for shake in shakes {
                let mut place = guess.to_vec();
                self::shake(&mut place, &self.free, shake * size);
                let cost = self.manifold.search(at, guess, &mut place);
                if cost == 0.0 {
                    return Ok(place);
                }
                if cost < least && !even {
                    (least, x) = (cost, place);
                }
            }
        }
        Err(match self.manifold.refusal(at, &x) {
            Error::OffConstraint { level, constraints } => Error::NotAssembled {
                level,
                constraints,
                held: Vec::new(),
            },
            error => error,
        })
    }
}

/// The search for the solution next to the guess, one part after the other.
struct ByParts<'a> {
    search: &'a mut Search,
    alone: Alone,
    at: &'a At<'a, f64>,
    guess: &'a [f64],
    parts: &'a [Part],
}

/// A solution of some parts.
struct Found {
    x: Vec<f64>,
    /// Σ (Δq √inertia)² of their unknowns, from the guess where it tells of them.
    distance: f64,
}

/// What is found straight from the guess, part by part: where, and for each part that has a solution how far it is.
struct Straight {
    x: Vec<f64>,
    distances: Vec<Option<f64>>,
}

impl Straight {
    /// How far the parts `group` are, if all have a solution.
    fn distance(&self, group: &[usize]) -> Option<f64> {
        group.iter().map(|part| self.distances[*part]).sum()
    }
}

impl ByParts<'_> {
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
                let same = |known: &&Straight| {
                    let mut unknowns = self.parts[group[0]].unknowns.iter();
                    unknowns.all(|j| first.x[*j] == known.x[*j])
                };
                let known = known.filter(same);
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
        let (mut found, mut random) = (Vec::<Found>::new(), Random::new(SEED));
        for beginning in 0..BEGINNINGS {
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
            let same =
                |known: &Found| largest_difference(&known.x, &next.x) <= SAME * largest(&next.x);
            if !found.iter().any(same) {
                found.push(next);
            }
            let first = found[0].distance;
            if !part.is_determined()
                || self.search.begun >= MOST
                || beginning == 0 && self.is_alone(part, x, bound.max(first))
            {
                break;
            }
        }
        found.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        found
    }

    /// Whether a solution of `part` less than `distance` from the guess, or as far, is the only one there.
    fn is_alone(&mut self, part: &Part, x: &[f64], distance: f64) -> bool {
        let (untold, eases) = (&self.search.untold, self.search.manifold.ease());
        let ease = |j: usize| eases[j] / weight(untold, j);
        let reach = distance.sqrt();
        self.alone
            .holds(self.at, part, (x, self.guess), (reach, &ease))
    }

    /// The solution of `part` that a search from the guess leads to, or for other beginnings than the first from somewhere ever farther off.
    fn begin(
        &mut self,
        part: &Part,
        x: &[f64],
        beginning: usize,
        random: &mut Random,
    ) -> Option<Found> {
        let size = match largest(self.guess) {
            size if size > 0.0 => size,
            _ => 1.0,
        };
        let angles = self.at.mech.spec().structure.angles;
        let mut place = x.to_vec();
        if let Some(share) = SHAKES.get(beginning) {
            shake(&mut place, &part.unknowns, share * size);
        } else {
            let share = (beginning + 1 - SHAKES.len()) as f64 / (BEGINNINGS - SHAKES.len()) as f64;
            for j in &part.unknowns {
                let reach = if angles.contains(j) { PI } else { size };
                place[*j] += share * reach * random.signed();
            }
        }
        let place = self.search(part, place)?;
        Some(self.found(part, place))
    }

    /// `x` with the unknowns of `part` moved to a solution.
    fn search(&mut self, part: &Part, mut x: Vec<f64>) -> Option<Vec<f64>> {
        self.search.begun += 1;
        let manifold = &mut self.search.manifold;
        let cost = manifold.search_part(self.at, part, self.guess, &mut x);
        (cost == 0.0).then_some(x)
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
        let ease = self.search.manifold.ease();
        let off = |j: &usize| {
            let off = (x[*j] - self.guess[*j]) / ease[*j];
            (weight(&self.search.untold, *j) * off).powi(2)
        };
        let distance = part.unknowns.iter().map(off).sum();
        Found { x, distance }
    }
}

/// How much coordinate `j` counts in choosing between solutions.
fn weight(untold: &[usize], j: usize) -> f64 {
    if untold.contains(&j) { UNTOLD } else { 1.0 }
}

/// Moves the coordinates `free` by up to `by`: always in the same way, and no two of them alike.
fn shake(x: &mut [f64], free: &[usize], by: f64) {
    for (k, &j) in free.iter().enumerate() {
        let along = ((k as f64 + 1.0) * GOLDEN).fract();
        x[j] += by * (2.0 * along - 1.0);
    }
}
