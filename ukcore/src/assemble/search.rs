//! The search for q, then for q̇.

use nalgebra::DMatrix;

use super::by_parts::{ByParts, SHAKES, shake, weight};
use super::{Held, State};
use crate::error::Error;
use crate::manifold::{At, Level, Manifold, Part, parts};
use crate::mechanism::Prepared;
use crate::noise::Noise;
use crate::spectrum::singular;

/// Projections of velocities of which a guess speaks: what the others' inertia, which counts for next to nothing, takes from them falls
/// each time by the share for which it counts, in the end to rounding.
const TIMES: usize = 3;

/// Velocities that are this much larger than those wished for may be what rounding makes of a row that all but vanishes. They are lost
/// where rounding changes them by more than the second share.
const SWEPT: f64 = 1e3;
const LOST: f64 = 0.1;

/// Singular values below this share of the largest one are those of rows that others imply.
const IMPLIED: f64 = 1e-12;

/// The search for q, then for q̇.
pub(crate) struct Search {
    pub(crate) manifold: Manifold,
    /// Coordinates that may change.
    pub(crate) free: Vec<usize>,
    /// Coordinates that do not choose between solutions.
    pub(crate) untold: Vec<usize>,
    /// Searches for solutions of parts so far.
    pub(super) begun: usize,
}

impl Search {
    pub(crate) fn new(mech: &Prepared, guess: &State, held: &[usize]) -> Self {
        let n = mech.spec().n();
        let mut mass = vec![0.0; n * n];
        mech.mass_matrix(guess.t, &guess.q, &mut mass);
        let inertia = |j: usize| Some(mass[j * n + j]).filter(|m| *m > 0.0 && m.is_finite());
        let state = (guess.t, &guess.q[..], &guess.v[..]);
        // How readily each moves: 1/√M_jj.
        let ease = |manifold: &Manifold| -> Vec<f64> {
            let measured = |j: usize| Some(inertia(j)?.sqrt() * manifold.unit(j));
            let massive: Vec<f64> = (0..n).filter_map(measured).map(f64::ln).collect();
            // Massless coordinates move as readily as the middling massive ones.
            let typical = (massive.iter().sum::<f64>() / massive.len().max(1) as f64).exp();
            let ease = |j: usize| manifold.unit(j) / measured(j).unwrap_or(typical);
            (0..n).map(ease).collect()
        };
        Search {
            manifold: Manifold::with_ease(mech, state, ease, held.to_vec()),
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
        let v = held.rates(&q, &guess.v);
        let mut residual = vec![0.0; mech.spec().m()];
        mech.residual_rate(guess.t, &q, &v, &mut residual);
        if residual.iter().all(|r| *r == 0.0) {
            // As at rest there is nothing to search for.
            return Ok(State { t: guess.t, q, v });
        }
        let mut search = Search::new(mech, guess, &held.velocities);
        let at = At::new(mech, Level::Velocity, guess.t, &q);
        let told = |j: &usize| !held.untold_rates.contains(j);
        let told: Vec<usize> = search.free.iter().copied().filter(told).collect();
        let mut times = 1;
        if !told.is_empty() {
            search.manifold.lighten(&held.untold_rates);
            times = TIMES;
        }
        let (wish, mut v) = (v.clone(), v);
        for _ in 0..times {
            told.iter().for_each(|&j| v[j] = wish[j]);
            v = search.find(&at, &v)?;
        }
        // A place that was given and not searched for is told to the last digit.
        let searched = q != guess.q;
        if searched && search.is_swept(&wish, &v) && search.is_lost(mech, (guess.t, &q, &v), held) {
            return Err(search.refused(&at, &wish));
        }
        Ok(State { t: guess.t, q, v })
    }

    /// The largest velocity, measured by how readily its coordinate moves.
    fn fastest(&self, v: &[f64]) -> f64 {
        let pairs = v.iter().zip(self.manifold.ease());
        pairs.fold(0.0, |most: f64, (v, ease)| most.max((v / ease).abs()))
    }

    /// Whether velocities are far larger than those wished for, if there are some.
    fn is_swept(&self, wish: &[f64], v: &[f64]) -> bool {
        let wish = self.fastest(wish);
        wish > 0.0 && self.fastest(v) > SWEPT * wish
    }

    /// Whether other velocities belong to positions that the constraints do not tell from q: at a dead centre the square of a coordinate
    /// that is not held is all that they see of it.
    fn is_lost(&mut self, mech: &Prepared, (t, q, v): (f64, &[f64], &[f64]), held: &Held) -> bool {
        let Some(off) = self.untold(mech, (t, q, v), &held.positions) else {
            return false;
        };
        let beside: Vec<f64> = q.iter().zip(off).map(|(q, off)| q + off).collect();
        let Ok(there) = self.find(&At::new(mech, Level::Velocity, t, &beside), v) else {
            return true;
        };
        let change: Vec<f64> = there.iter().zip(v).map(|(a, b)| a - b).collect();
        self.fastest(&change) > LOST * self.fastest(v)
    }

    /// The largest change of q, but of the coordinates `held`, that what is left of the constraints, or rounding makes of them, does not
    /// tell from none. `None` where there are no constraints.
    fn untold(
        &self,
        mech: &Prepared,
        (t, q, v): (f64, &[f64], &[f64]),
        held: &[usize],
    ) -> Option<Vec<f64>> {
        let (m, h) = (mech.spec().m(), mech.spec().holonomic);
        let ease = self.manifold.ease();
        let free: Vec<usize> = (0..q.len()).filter(|j| !held.contains(j)).collect();
        let mut jacobian = vec![0.0; q.len() * m];
        mech.jacobian(t, q, v, &mut jacobian);
        let entry = |c: usize, k: usize| jacobian[free[k] * m + c] * ease[free[k]];
        let svd = singular(DMatrix::from_fn(h, free.len(), entry), true, true)?;
        let (left, right, values) = (svd.u?, svd.v_t?, svd.singular_values);
        let least = (0..values.len()).filter(|k| values[*k] > IMPLIED * values.max());
        let least = least.min_by(|a, b| values[*a].total_cmp(&values[*b]))?;
        let (mut residual, mut rounding) = (vec![0.0; h], vec![0.0; h]);
        mech.residual(t, q, &mut residual);
        let mut noise = Noise::new(mech);
        noise.go(mech, t, [q, v], |_| [0.0; 2]);
        noise.residual(&mut rounding);
        let unknown = residual.iter().zip(&rounding);
        let unknown = unknown.map(|(r, rounding)| r.abs().max(f64::EPSILON * rounding));
        let left = left.column(least);
        let off: f64 = left.iter().zip(unknown).map(|(u, r)| u.abs() * r).sum();
        let mut change = vec![0.0; q.len()];
        for (k, j) in free.iter().enumerate() {
            change[*j] = off / values[least] * right[(least, k)] * ease[*j];
        }
        Some(change)
    }

    /// The solution where the equations fall apart, or have solutions that lie apart, next to the guess; `None` where they do neither, or
    /// where none is found that way.
    fn find_by_parts(&mut self, at: &At<'_, f64>, guess: &[f64]) -> Option<Vec<f64>> {
        let parts = self.parts(at);
        let determined = parts.first().is_some_and(Part::is_determined);
        if at.level != Level::Position || parts.len() < 2 && !determined {
            return None;
        }
        let (nearest, _) = ByParts::new(self, at, guess, &parts).found_nearest()?;
        self.projected(at, nearest.x)
    }

    /// The nearest solution to the guess where all solutions lie apart, and besides it those that are at most `times` as far, or `none`, in
    /// what hangs together: in each of them it is another one. `None` where coordinates stay free, or where none is found.
    pub(crate) fn ways(
        &mut self,
        at: &At<'_, f64>,
        guess: &[f64],
        (times, none): (f64, f64),
    ) -> Option<Vec<Vec<f64>>> {
        let parts = self.parts(at);
        if !parts.iter().all(Part::is_determined) {
            return None;
        }
        let mut by_parts = ByParts::new(self, at, guess, &parts);
        let (nearest, others) = by_parts.found_near((times, none))?;
        if by_parts.open {
            return None;
        }
        let mut ways = vec![self.projected(at, nearest.x)?];
        let others = others.into_iter();
        ways.extend(others.filter_map(|other| self.projected(at, other.x)));
        Some(ways)
    }

    fn parts(&self, at: &At<'_, f64>) -> Vec<Part> {
        let pattern = at.mech.spec().structure.jacobian_pattern;
        parts(pattern, at.rows(), &self.free)
    }

    /// A solution next to `x` that keeps what the guess tells, as far as rows let it, where all else follows; if there is something that
    /// follows, and such a solution is found.
    fn settled(&mut self, at: &At<'_, f64>, guess: &[f64], x: &[f64]) -> Option<Vec<f64>> {
        if at.level != Level::Position {
            return None;
        }
        let whole = Part::whole(at.rows(), self.free.clone());
        let settled = self.manifold.settled(at, &whole, (x, guess), &self.untold);
        settled.and_then(|settled| self.projected(at, settled))
    }

    /// Σ (Δq √inertia)² of these coordinates from the guess, where it tells of them.
    pub(super) fn distance(&self, coordinates: &[usize], guess: &[f64], x: &[f64]) -> f64 {
        let ease = self.manifold.ease();
        let off = |j: &usize| {
            let off = (x[*j] - guess[*j]) / ease[*j];
            (weight(&self.untold, *j) * off).powi(2)
        };
        coordinates.iter().map(off).sum()
    }

    fn projected(&mut self, at: &At<'_, f64>, mut x: Vec<f64>) -> Option<Vec<f64>> {
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
        let kept = self.settled(at, guess, guess);
        let mut extents = None;
        let mut least = f64::INFINITY;
        // Of what is linear there is nothing else to find.
        let shakes = if at.linear() { &SHAKES[..1] } else { &SHAKES };
        for even in [false, true] {
            // Where inertias are orders apart, rows with a light coordinate all but vanish beside the others, and the way along those is
            // long.
            if even {
                self.manifold.even();
            }
            for share in shakes {
                let mut place = guess.to_vec();
                if *share > 0.0 {
                    let extents = extents.get_or_insert_with(|| self.manifold.extents(at, guess));
                    shake(&mut place, &self.free, |j| share * extents[j]);
                }
                let Err(cost) = self.manifold.search(at, guess, &mut place) else {
                    let settled = self.settled(at, guess, &place);
                    let all = [Some(place), settled, kept].into_iter().flatten();
                    let off = |x: &Vec<f64>| self.distance(&self.free, guess, x);
                    let nearest = all.min_by(|x, y| off(x).total_cmp(&off(y)));
                    return Ok(nearest.unwrap_or_default());
                };
                if cost < least && !even {
                    (least, x) = (cost, place);
                }
            }
        }
        if let Some(kept) = kept {
            return Ok(kept);
        }
        Err(self.refused(at, &x))
    }

    /// Why nothing next to `x` is a solution.
    fn refused(&mut self, at: &At<'_, f64>, x: &[f64]) -> Error {
        match self.manifold.refusal(at, x) {
            Error::OffConstraint { level, constraints } => Error::NotAssembled {
                level,
                constraints,
                held: Vec::new(),
            },
            error => error,
        }
    }
}
