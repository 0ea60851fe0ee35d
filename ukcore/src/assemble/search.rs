//! The search for q, then for q̇.

use std::f64::consts::{PI, TAU};

use super::{Held, State};
use crate::error::Error;
use crate::manifold::{At, Level, Manifold, Part, Reached, parts};
use crate::mechanism::Prepared;
use crate::random::Random;
use crate::scan::{largest, largest_difference};

/// Guesses: the given one, then it with perturbations of [`SHAKES`] times the size of the coordinates. A guess with points that
/// coincide has vanishing gradients, from which only a perturbation leads away.
const SHAKES: [f64; 4] = [0.0, 1e-3, 3e-2, 0.3];

/// Fractional part of the golden ratio: its multiples fill the unit interval evenly.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Beginnings, ever farther off, besides the guess and its perturbations, where solutions lie apart and another one may be nearer.
const BEGINNINGS: usize = 24;

/// The solution that is found from the guess is taken for the nearest one if the second step is at most this share of the first. Where
/// second derivatives make it ½ h of it, and h < ½, no other solution is nearer (theorem of Newton and Kantorovich). A sign of it, no
/// proof: seen along the steps alone they may look smaller than they are elsewhere.
const STRAIGHT: f64 = 0.1;

/// Solutions nearer than this share of the coordinates are one.
const SAME: f64 = 1e-6;

/// What the guess does not tell of counts so little.
const UNTOLD: f64 = 1e-6;

/// So many beginnings are tried for one guess; parts that come later have one solution each.
const MOST: usize = 20_000;

/// The search for q, then for q̇.
pub(crate) struct Search {
    pub(crate) manifold: Manifold,
    /// Coordinates that may change.
    pub(crate) free: Vec<usize>,
    /// Coordinates that do not choose between solutions.
    pub(super) untold: Vec<usize>,
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
            search: self,
            at,
            guess,
            parts: &parts,
            left: MOST,
        };
        let all: Vec<usize> = (0..parts.len()).collect();
        let mut x = by_parts.nearest(&all, guess.to_vec(), f64::INFINITY)?.x;
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
    at: &'a At<'a, f64>,
    guess: &'a [f64],
    parts: &'a [Part],
    /// Beginnings that may still be tried.
    left: usize,
}

/// A solution of some parts.
struct Found {
    x: Vec<f64>,
    /// Σ (Δq √inertia)² of their unknowns, from the guess where it tells of them.
    distance: f64,
}

impl ByParts<'_> {
    /// `x` with the parts `open`, in their order, solved, less than `bound` from the guess, as near to it as is found. What hangs together
    /// through parts that are solved alone is independent; else each solution of the first part is followed, the nearest first.
    fn nearest(&mut self, open: &[usize], mut x: Vec<f64>, bound: f64) -> Option<Found> {
        let mut distance = 0.0;
        for group in self.groups(open) {
            let mut best: Option<Found> = None;
            for first in self.solutions(group[0], &x) {
                let within = best.as_ref().map_or(bound - distance, |best| best.distance);
                if first.distance >= within {
                    break;
                }
                let rest = self.nearest(&group[1..], first.x, within - first.distance);
                best = rest.map_or(best, |rest| {
                    Some(Found {
                        distance: first.distance + rest.distance,
                        ..rest
                    })
                });
            }
            let best = best?;
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

    /// The solutions of a part that are found, where those that it needs are solved, the nearest first; one where they do not lie apart.
    fn solutions(&mut self, part: usize, x: &[f64]) -> Vec<Found> {
        let part = &self.parts[part];
        let size = match largest(self.guess) {
            size if size > 0.0 => size,
            _ => 1.0,
        };
        let angles = self.at.mech.spec().structure.angles;
        let (mut found, mut random) = (Vec::<Found>::new(), Random::new(0x5eed));
        for beginning in 0..SHAKES.len() + BEGINNINGS {
            let mut place = x.to_vec();
            if let Some(share) = SHAKES.get(beginning) {
                shake(&mut place, &part.unknowns, share * size);
            } else {
                let share = (beginning + 1 - SHAKES.len()) as f64 / BEGINNINGS as f64;
                for j in &part.unknowns {
                    let reach = if angles.contains(j) { PI } else { size };
                    place[*j] += share * reach * random.signed();
                }
            }
            let Some(bend) = self.search(part, &mut place) else {
                continue;
            };
            self.enter(part, place, &mut found);
            let alone = beginning == 0 && bend <= STRAIGHT;
            if alone || !part.is_determined() || self.left == 0 {
                break;
            }
        }
        found.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        found
    }

    /// Moves the unknowns of `part` in `x` to a solution; returns how the way bends.
    fn search(&mut self, part: &Part, x: &mut [f64]) -> Option<f64> {
        self.left = self.left.saturating_sub(1);
        let manifold = &mut self.search.manifold;
        let Reached { cost, bend } = manifold.search_part(self.at, part, self.guess, x);
        (cost == 0.0).then_some(bend)
    }

    /// Keeps a solution, unless it is known, with angles turned to those next to the guess.
    fn enter(&mut self, part: &Part, x: Vec<f64>, found: &mut Vec<Found>) {
        let mut turned = x.clone();
        let angles = self.at.mech.spec().structure.angles;
        for j in part.unknowns.iter().filter(|j| angles.contains(j)) {
            turned[*j] += TAU * ((self.guess[*j] - x[*j]) / TAU).round();
        }
        // An angle may be more than a direction.
        let x = match turned != x && self.search(part, &mut turned).is_some() {
            true => turned,
            false => x,
        };
        let same = |known: &Found| largest_difference(&known.x, &x) <= SAME * largest(&x);
        if found.iter().any(same) {
            return;
        }
        let ease = self.search.manifold.ease();
        let weight = |j: &usize| match self.search.untold.contains(j) {
            true => UNTOLD,
            false => 1.0,
        };
        let off = |j: &usize| (weight(j) * (x[*j] - self.guess[*j]) / ease[*j]).powi(2);
        let distance = part.unknowns.iter().map(off).sum();
        found.push(Found { x, distance });
    }
}

/// Moves the coordinates `free` by up to `by`: always in the same way, and no two of them alike.
fn shake(x: &mut [f64], free: &[usize], by: f64) {
    for (k, &j) in free.iter().enumerate() {
        let along = ((k as f64 + 1.0) * GOLDEN).fract();
        x[j] += by * (2.0 * along - 1.0);
    }
}
