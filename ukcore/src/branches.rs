//! All the ways to put a mechanism together near a guess.
//!
//! Where no coordinate stays free they are those that assembly compares. Else searches begin at the guess and at places all around it; from
//! where each ends, the nearest place to the guess is sought within its branch, by Gauss and Newton's method along the constraints.
//! Distances are measured by the root of inertia, over the coordinates that the guess tells of.

use nalgebra::{DMatrix, DVector};

use crate::assemble::{Held, Search, State, assembled, held, scatter, weight};
use crate::displacements::{constraint_matrix, null_space_holding, quaternions, units};
use crate::error::Error;
use crate::manifold::{At, Level};
use crate::mechanism::Prepared;
use crate::naming;
use crate::random::Random;
use crate::spectrum::singular;
use crate::start::{Said, StartOptions};

mod walk;

/// A state put together from a guess, and how else it could have been.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembled {
    /// The nearest state to the guess.
    pub state: State,
    /// The coordinates that differ from what the guess tells of them and by how much, the largest difference in terms of inertia first.
    pub moved: Vec<(&'static str, f64)>,
    /// The nearest states of other branches that were found as near, within one and a half times the distance, nearest first: what the
    /// guess tells does not decide between them.
    pub alternatives: Vec<State>,
}

/// Beginnings besides the guess.
const BEGINNINGS: usize = 24;
/// Another branch is as near if its distance is not more than this many times that of the nearest.
const AS_NEAR: f64 = 1.5;
/// Distances below this part of what coordinates extend over are none.
const NONE: f64 = 1e-7;
/// Steps towards the guess within a branch.
const STEPS: usize = 60;

/// What [`assemble`](crate::assemble()) finds, with what moved and, where no coordinate stays free, the other ways to put the mechanism
/// together that are as near. These are those that assembly compares, so that it costs next to nothing where interval arithmetic shows that
/// there are none, as near a good sketch. Where coordinates stay free no others are looked for: [`branches`](branches()) does that.
///
/// # Errors
/// What [`assemble`](crate::assemble()) reports.
pub fn assemble_with_alternatives(
    mechanism: impl Into<Prepared>,
    guess: &State,
    hold: &[&str],
) -> Result<Assembled, Error> {
    looked(mechanism.into(), guess, hold, Look::AtParts)
}

/// What [`assemble`](crate::assemble()) finds, but of all ways to put the mechanism together near `guess` the nearest one, with what moved
/// and the other ways that are as near. Where coordinates stay free it searches two dozen times, so it is for looking rather than for
/// loops, and branches far from the guess may be missed. Where none does, ways are compared by what hangs together: of the legs of a walker
/// each other way is that of one leg, as near as this one is. Places that the straightest walk along the constraints leads from one to the
/// other are one way, as those of a rod between balls that spins idly.
///
/// # Errors
/// What [`assemble`](crate::assemble()) reports.
pub fn branches(
    mechanism: impl Into<Prepared>,
    guess: &State,
    hold: &[&str],
) -> Result<Assembled, Error> {
    looked(mechanism.into(), guess, hold, Look::Everywhere)
}

impl Prepared {
    /// [`Prepared::start`] as by [`assemble_with_alternatives`]: coordinates of which the start says nothing do not count.
    ///
    /// # Errors
    /// What [`Prepared::start`] reports.
    pub fn start_with_alternatives(
        &self,
        name: &str,
        options: &StartOptions,
    ) -> Result<Assembled, Error> {
        let Said { guess, held } = self.said(name, options)?;
        near(self, &guess, &held, Look::AtParts)
    }

    /// [`branches`](branches()) of the declared start called `name` with `options`, near what it says: coordinates of which it says nothing
    /// do not count.
    ///
    /// # Errors
    /// What [`Prepared::start`] reports.
    pub fn branches(&self, name: &str, options: &StartOptions) -> Result<Assembled, Error> {
        let Said { guess, held } = self.said(name, options)?;
        near(self, &guess, &held, Look::Everywhere)
    }
}

/// The places where other ways to put a mechanism together are looked for.
#[derive(Clone, Copy, PartialEq)]
enum Look {
    /// The parts where assembly compares such ways.
    AtParts,
    /// The whole surroundings of the guess, too, where coordinates stay free.
    Everywhere,
}

/// The ways near a guess, with the coordinates `hold` held.
fn looked(mech: Prepared, guess: &State, hold: &[&str], look: Look) -> Result<Assembled, Error> {
    let held = Held::both(held(mech.spec(), hold)?);
    near(&mech, guess, &held, look)
}

/// The ways near a guess, with coordinates held by their positions.
fn near(mech: &Prepared, guess: &State, held: &Held, look: Look) -> Result<Assembled, Error> {
    guess.check(mech)?;
    naming::inertias(mech)?;
    let units = units(mech, guess);
    let mut ways = Ways {
        mech,
        guess,
        held,
        weights: DVector::from_fn(units.len(), |j, _| weight(&held.untold, j) / units[j]),
        units,
        places: Places::new(mech, guess, Vec::new()),
        found: Vec::new(),
    };
    let states = ways.near(look).into_iter();
    let states = states.filter_map(|q| Search::velocities(mech, guess, held, q).ok());
    let mut states: Vec<State> = states.collect();
    if states.is_empty() {
        // It finds one where coordinates stay free, or says why there is none.
        states.push(assembled(mech, guess, held.clone())?);
    }
    let state = states.remove(0);
    // A guess may have quaternions of no length.
    ways.places = Places::new(mech, &state, ways.places.extents);
    Ok(ways.assembled(state, states))
}

/// A place on the constraints, and how far it is from the guess.
struct Way {
    q: Vec<f64>,
    distance: f64,
}

/// The search for all of them.
struct Ways<'a> {
    mech: &'a Prepared,
    guess: &'a State,
    held: &'a Held,
    /// What distances are measured by.
    units: DVector<f64>,
    weights: DVector<f64>,
    places: Places,
    found: Vec<Way>,
}

impl Ways<'_> {
    /// The nearest, then those that are as near; none where coordinates stay free and they are not to be looked for.
    fn near(&mut self, look: Look) -> Vec<Vec<f64>> {
        let (mech, guess) = (self.mech, self.guess);
        let mut search = Search::new(mech, guess, &self.held.positions);
        search.untold.clone_from(&self.held.untold);
        let at = At::new(mech, Level::Position, guess.t, &guess.v);
        self.places.extents = search.manifold.extents(&at, &guess.q);
        let sizes = self.places.extents.iter().zip(self.weights.iter());
        let none = NONE * sizes.fold(0.0, |most: f64, (extent, weight)| most.max(extent * weight));
        if let Some(ways) = search.ways(&at, &guess.q, (AS_NEAR, none)) {
            return ways;
        }
        if look == Look::AtParts {
            return Vec::new();
        }
        self.seek();
        self.found.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let nearest = self.found.first().map_or(0.0, |way| way.distance);
        let bound = AS_NEAR * nearest.max(none);
        let near = self.found.iter().take_while(|way| way.distance <= bound);
        // What coordinates that stay free lead to is the same way, as a rod between balls that spins idly.
        let mut apart: Vec<Vec<f64>> = Vec::new();
        for Way { q, .. } in near {
            let mut known = apart.iter();
            if !known.any(|known| self.reaches(&mut search, &at, q, known)) {
                apart.push(q.clone());
            }
        }
        apart
    }

    fn seek(&mut self) {
        let (mech, guess) = (self.mech, self.guess);
        let mut search = Search::new(mech, guess, &self.held.positions);
        let at = At::new(mech, Level::Position, guess.t, &guess.v);
        let mut random = Random::new(0x5eed);
        for k in 0..=BEGINNINGS {
            let mut q = guess.q.clone();
            // Ever farther off.
            let share = k as f64 / BEGINNINGS as f64;
            let extents = &self.places.extents;
            scatter(mech, &mut q, &search.free, share, extents, &mut random);
            if search.manifold.search(&at, &guess.q, &mut q).is_ok() {
                self.approach(&mut search, &at, &mut q);
                self.enter(q);
            }
        }
    }

    fn distance(&self, q: &[f64]) -> f64 {
        let pairs = q.iter().zip(&self.guess.q).zip(self.weights.iter());
        pairs
            .map(|((q, g), w)| (w * (q - g)).powi(2))
            .sum::<f64>()
            .sqrt()
    }

    /// Moves `q` along the constraints to where it is nearest to the guess.
    fn approach(&self, search: &mut Search, at: &At<'_, f64>, q: &mut [f64]) {
        let n = q.len();
        let mut distance = self.distance(q);
        for _ in 0..STEPS {
            let here = State {
                q: q.to_vec(),
                ..self.guess.clone()
            };
            let rows = constraint_matrix(self.mech, &here);
            let rows = rows.rows(0, self.mech.spec().holonomic).into_owned();
            let ways = null_space_holding(&self.held.positions, rows, &self.units);
            if ways.is_empty() {
                return;
            }
            let ways = DMatrix::from_diagonal(&self.units) * ways;
            let weighed = DMatrix::from_diagonal(&self.weights) * &ways;
            let wanted = DVector::from_fn(n, |j, _| self.weights[j] * (self.guess.q[j] - q[j]));
            let shares = singular(weighed, true, true).map(|svd| svd.solve(&wanted, 1e-12));
            let Some(Ok(shares)) = shares else {
                return;
            };
            let step = ways * shares;
            let nearer = (0..8).find_map(|halved| {
                let part = 0.5_f64.powi(halved);
                let moved = q.iter().zip(step.iter()).map(|(q, d)| q + part * d);
                let mut there: Vec<f64> = moved.collect();
                search.manifold.project(at, &mut there).ok()?;
                let far = self.distance(&there);
                (far < distance).then_some((there, far))
            });
            let Some((there, far)) = nearer else {
                return;
            };
            q.copy_from_slice(&there);
            let stands = distance - far <= 1e-9 * distance;
            distance = far;
            if stands {
                return;
            }
        }
    }

    /// Keeps `q`, unless it is known, but for whole turns; of places that differ by these the nearest.
    fn enter(&mut self, q: Vec<f64>) {
        let distance = self.distance(&q);
        let places = &self.places;
        match self.found.iter_mut().find(|way| places.are_one(&way.q, &q)) {
            Some(way) if distance < way.distance => *way = Way { q, distance },
            Some(_) => {}
            None => self.found.push(Way { q, distance }),
        }
    }

    fn assembled(&self, state: State, others: Vec<State>) -> Assembled {
        // Near a position in which branches meet, searches that end in different steps tell of one place several times.
        let mut alternatives: Vec<State> = Vec::new();
        for other in others {
            let same = |known: &State| self.places.are_one(&known.q, &other.q);
            if !same(&state) && !alternatives.iter().any(same) {
                alternatives.push(other);
            }
        }
        let change = |j: &usize| state.q[*j] - self.guess.q[*j];
        let mut moved: Vec<usize> = (0..state.q.len()).collect();
        moved.retain(|j| {
            !self.held.untold.contains(j) && change(j).abs() > NONE * self.places.extents[*j]
        });
        let far = |j: &usize| (change(j) / self.units[*j]).abs();
        moved.sort_by(|a, b| far(b).total_cmp(&far(a)));
        let coords = self.mech.spec().coords;
        let moved = moved.iter().map(|j| (coords[*j], change(j)));
        Assembled {
            moved: moved.collect(),
            alternatives,
            state,
        }
    }
}

/// What tells places apart.
struct Places {
    /// Coordinates whose whole turns change nothing.
    angles: &'static [usize],
    /// The coordinates of quaternions, which are the same orientation with the other sign.
    quaternions: Vec<Vec<usize>>,
    /// How large coordinates are.
    extents: Vec<f64>,
}

impl Places {
    /// What tells places apart beside the one `at`.
    fn new(mech: &Prepared, at: &State, extents: Vec<f64>) -> Self {
        let found = quaternions(mech, at).into_iter().map(|(_, all)| all);
        Places {
            angles: mech.spec().structure.angles,
            quaternions: found.filter(|all| all.len() == 4).collect(),
            extents,
        }
    }

    /// The place `known` by the numbers that are next to `q`.
    fn turned(&self, known: &[f64], q: &[f64]) -> Vec<f64> {
        let mut turned = known.to_vec();
        for j in self.angles {
            let turns = ((q[*j] - turned[*j]) / std::f64::consts::TAU).round();
            turned[*j] += turns * std::f64::consts::TAU;
        }
        for all in &self.quaternions {
            if all.iter().map(|j| turned[*j] * q[*j]).sum::<f64>() < 0.0 {
                all.iter().for_each(|j| turned[*j] = -turned[*j]);
            }
        }
        turned
    }

    /// Whether `q` is where `known` is.
    fn are_one(&self, known: &[f64], q: &[f64]) -> bool {
        let turned = self.turned(known, q);
        let mut all = turned.iter().zip(q).zip(&self.extents);
        all.all(|((a, b), extent)| (a - b).abs() <= 1e-3 * extent)
    }
}
