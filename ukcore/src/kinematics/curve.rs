//! The curve of positions that constraints and drives leave, in the coordinates and the part s of the sweep that is done.
//!
//! It is followed by its arc length, so that it may turn back in s, as at a dead centre of the drive: a step along the tangent, then Gauss
//! and Newton's method, whose steps of least length are at right angles to the curve. Of rows that imply each other as many are taken as
//! were independent at the start, those that keep most beside the others.
//!
//! Where branches cross a combination of rows vanishes, and is reversed behind that place. Where they all but cross, each turns off
//! sharply, and a step that went straight on would end on another one, with the same tangent; but there the combination is reversed, too.
//! So a step over which one is reversed is halved, until the curve has been followed round the bend. If no bend shows before steps are so
//! short that rounding hides it, that is a crossing, and the curve goes straight on.

use nalgebra::{DMatrix, DVector};

use crate::displacements::{INDEPENDENT, measure, none_vanishes, pivoted};
use crate::mechanism::{Evaluated, Prepared};
use crate::scalar::{Scalar, Sloped, Slopes};
use crate::spectrum::eigenvalues;
use crate::zero::locate;

/// Steps of Newton's method at most.
const NEWTON: usize = 12;
/// A step of Newton's method below this part of the coordinates is rounding; below the larger one, where it does not become smaller.
const ROUNDING: f64 = 1e-14;
const STALLED: f64 = 1e-10;
/// A step along the curve turns its tangent by less than the first of these angles, rad; the second is aimed at.
const TURN: f64 = 0.3;
const WANTED: f64 = 0.15;
/// A step after which rows have turned by more than this angle is not followed by a longer one, lest they turn all the way within it.
const ROWS: f64 = 0.5;
/// So many times as far as rounding hides where branches cross goes a step over that place.
const OVER: f64 = 8.0;
/// Rows that keep more than this beside the others are far from a place where branches cross.
const APART: f64 = 0.1;
/// A place where branches may cross is gone to by this part of the way that is left.
const NEARLY: f64 = 0.98;
/// The first step, as a part of the sweep; and the least one, of what the curve is measured by, and of the coordinates, which are known to
/// rounding.
const FIRST: f64 = 1e-3;
const LEAST: f64 = 1e-9;
const ROUGH: f64 = 1e-13;
/// What is nearer to a limit than this part of the sweep is there.
pub(super) const AT: f64 = 1e-12;
/// Steps along a curve at most.
const STEPS: usize = 100_000;

/// The curve: constraints at their times, and coordinates that are prescribed.
#[derive(Debug, Clone)]
pub(super) struct Curve<'a> {
    pub(super) mech: &'a Prepared,
    /// What coordinates, and s behind them, are measured by.
    pub(super) units: DVector<f64>,
    /// Prescribed coordinates, each with its value at s = 0 and what it gains up to s = 1.
    pub(super) fixed: Vec<(usize, f64, f64)>,
    /// The time at s = 0, and what it gains.
    pub(super) time: (f64, f64),
    /// How much of the sweep is done in a second.
    pub(super) speed: f64,
    /// What the coordinates come to in units, wherever the ground is.
    pub(super) extent: f64,
    /// The largest length of each row that is known, beside which a row may come to vanish; none yet where it is empty.
    pub(super) lengths: Vec<f64>,
    /// What the rows usually keep beside each other.
    pub(super) margin: f64,
}

/// A place on the curve.
#[derive(Debug, Clone)]
pub(super) struct Place {
    /// Coordinates, and s.
    pub(super) x: DVector<f64>,
    /// The tangent there, of length 1 in the units.
    pub(super) way: DVector<f64>,
}

impl Place {
    pub(super) fn s(&self) -> f64 {
        self.x[self.x.len() - 1]
    }

    /// How fast s changes along the curve, 1 where nothing else does.
    pub(super) fn speed(&self) -> f64 {
        self.way[self.way.len() - 1]
    }
}

/// A part of the curve.
#[derive(Debug)]
pub(super) struct Path {
    /// Places along it, so near to each other that a cubic is the curve between them.
    pub(super) places: Vec<Place>,
    /// The numbers of places behind which the curve goes over a crossing.
    pub(super) crossings: Vec<usize>,
    /// A radius of its curvature that is neither the least nor the largest.
    pub(super) radius: f64,
    pub(super) end: End,
}

/// A step along the curve.
#[derive(Debug)]
pub(super) struct Step {
    pub(super) place: Place,
    /// The rows there.
    rows: Rows,
    /// By which angle the tangent has turned.
    turn: f64,
}

/// Why a path ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// The path has got as far as is wanted.
    Arrived,
    /// The path ends where s turns back.
    Turned,
    /// There is no smooth way on.
    Stuck,
    /// The path has taken all steps that it may.
    Long,
}

impl Path {
    pub(super) fn last(&self) -> &Place {
        &self.places[self.places.len() - 1]
    }
}

/// The rows of the curve's equations at a place, in units, taken apart: Kᵀ P = Q R.
#[derive(Debug)]
pub(super) struct Rows {
    pub(super) matrix: DMatrix<f64>,
    pub(super) lengths: DVector<f64>,
    /// Row of each column of R.
    order: Vec<usize>,
    turned: DMatrix<f64>,
    r: DMatrix<f64>,
    pub(super) rank: usize,
    /// What the last of these rows keeps beside the others; 0 where there are fewer.
    pub(super) margin: f64,
}

impl Rows {
    /// The rows of at most `rank` independent ones, each of length 1, or less as it is shorter than the one of `known` lengths.
    fn new(mut matrix: DMatrix<f64>, rank: usize, known: &[f64]) -> Self {
        let known = |i: usize| known.get(i).copied().unwrap_or(0.0);
        let lengths = DVector::from_fn(matrix.nrows(), |i, _| matrix.row(i).norm().max(known(i)));
        for (mut row, length) in matrix.row_iter_mut().zip(lengths.iter()) {
            if *length > 0.0 {
                row /= *length;
            }
        }
        let (decomposed, pivots) = pivoted(&matrix);
        let r = decomposed.r();
        let pivots = pivots.into_iter().take(rank);
        let pivots: Vec<f64> = pivots.take_while(|x| *x > INDEPENDENT).collect();
        let mut order = DVector::from_fn(matrix.nrows(), |i, _| i);
        decomposed.p().permute_rows(&mut order);
        let mut turned = DMatrix::identity(matrix.ncols(), matrix.ncols());
        decomposed.q_tr_mul(&mut turned);
        let margin = match pivots.last() {
            Some(pivot) if pivots.len() == rank => *pivot,
            _ => 0.0,
        };
        let rank = pivots.len();
        Rows {
            matrix,
            lengths,
            order: order.iter().copied().collect(),
            turned,
            r: r.view((0, 0), (rank, rank)).into_owned(),
            rank,
            margin,
        }
    }

    /// The shortest z, in units, with K z = `rhs`.
    pub(super) fn shortest(&self, rhs: &DVector<f64>) -> DVector<f64> {
        let share = |k: usize| match self.lengths[self.order[k]] {
            length if length > 0.0 => rhs[self.order[k]] / length,
            _ => 0.0,
        };
        let mut parts = DVector::from_fn(self.rank, |k, _| share(k));
        // R has no zero on its diagonal.
        self.r.tr_solve_upper_triangular_mut(&mut parts);
        self.turned.rows(0, self.rank).tr_mul(&parts)
    }

    /// The combination of rows, each of length 1, that is `what`.
    pub(super) fn combination(&self, what: &DVector<f64>) -> Vec<f64> {
        let mut parts = self.turned.rows(0, self.rank) * what;
        self.r.solve_upper_triangular_mut(&mut parts);
        let mut shares = vec![0.0; self.matrix.nrows()];
        for (row, share) in self.order.iter().zip(parts.iter()) {
            shares[*row] = *share;
        }
        shares
    }

    /// Whether a combination of the independent rows vanishes on the straight way from these to what they are `there`, or turns by more
    /// than a right angle. With these as they are there, in combinations that are orthonormal here, as B, one with (1 − τ) I + τ B
    /// singular is an eigenvector of B with a negative eigenvalue. That there is none is found sooner by the symmetric part of B.
    fn reversed(&self, there: &Rows) -> bool {
        let rows = there.matrix.select_rows(&self.order[..self.rank]);
        let mut rows = rows * self.turned.rows(0, self.rank).transpose();
        self.r.tr_solve_upper_triangular_mut(&mut rows);
        !none_vanishes(&rows)
            && eigenvalues(&rows).is_none_or(|all| all.iter().any(|x| x.re <= 0.0))
    }

    /// By which angle at most one of the rows has turned `there`.
    fn turned(&self, there: &Rows) -> f64 {
        let pairs = self.matrix.row_iter().zip(there.matrix.row_iter());
        let angles =
            pairs.map(|(a, b)| (a.dot(&b) / (a.norm() * b.norm())).clamp(-1.0, 1.0).acos());
        // Not a number where a row vanishes.
        angles.fold(0.0, f64::max)
    }

    /// An orthonormal basis of the directions that all rows leave, in rows.
    pub(super) fn free(&self) -> DMatrix<f64> {
        let n = self.matrix.ncols();
        self.turned.rows(self.rank, n - self.rank).into_owned()
    }

    /// The one of the free directions that is nearest to `way`.
    pub(super) fn along(&self, way: &DVector<f64>) -> Option<DVector<f64>> {
        let free = self.free();
        let way = free.tr_mul(&(&free * way));
        let length = way.norm();
        (length > 0.0).then(|| way / length)
    }
}

impl Curve<'_> {
    pub(super) fn time_at(&self, s: f64) -> f64 {
        self.time.0 + self.time.1 * s
    }

    /// All rows at `x`, of which `rank` count.
    pub(super) fn rows(&self, x: &DVector<f64>, rank: usize) -> Rows {
        Rows::new(self.matrix(x), rank, &self.lengths)
    }

    /// All rows at `x`, in units.
    fn matrix(&self, x: &DVector<f64>) -> DMatrix<f64> {
        let spec = self.mech.spec();
        let (n, m, h) = (spec.n(), spec.m(), spec.holonomic);
        let (t, q, rest) = (self.time_at(x[n]), &x.as_slice()[..n], vec![0.0; n]);
        let (mut jacobian, mut rate) = (vec![0.0; m * n], vec![0.0; m]);
        self.mech.jacobian(t, q, &rest, &mut jacobian);
        self.mech.residual_rate(t, q, &rest, &mut rate);
        let mut rows = DMatrix::zeros(h + self.fixed.len(), n + 1);
        for c in 0..h {
            (0..n).for_each(|j| rows[(c, j)] = jacobian[j * m + c]);
            rows[(c, n)] = self.time.1 * rate[c];
        }
        for (k, (j, _, gain)) in self.fixed.iter().enumerate() {
            rows[(h + k, *j)] = 1.0;
            rows[(h + k, n)] = -gain;
        }
        measure(&mut rows, &self.units);
        rows
    }

    /// Takes the lengths of rows along `path`, and what they usually keep beside each other.
    pub(super) fn gauge(&mut self, path: &Path) {
        let n = self.mech.spec().n();
        for place in &path.places {
            let rows = self.rows(&place.x, n);
            self.lengths = rows.lengths.iter().copied().collect();
        }
        let margins = path.places.windows(2).map(|pair| {
            let length = (&pair[1].x - &pair[0].x).component_div(&self.units).norm();
            (self.rows(&pair[1].x, n).margin, length)
        });
        self.margin = usual(margins.collect()).unwrap_or(self.margin);
    }

    /// How far `x` is off, row by row.
    fn residual(&self, x: &DVector<f64>) -> DVector<f64> {
        let (n, h) = (self.mech.spec().n(), self.mech.spec().holonomic);
        let mut residual = DVector::zeros(h + self.fixed.len());
        let (q, s) = (&x.as_slice()[..n], x[n]);
        let phi = &mut residual.as_mut_slice()[..h];
        self.mech.residual(self.time_at(s), q, phi);
        for (k, (j, begin, gain)) in self.fixed.iter().enumerate() {
            residual[h + k] = q[*j] - (begin + gain * s);
        }
        residual
    }

    /// How long the sweep and the coordinates are, in units: numbers as they stand, which rounding goes by.
    fn size(&self, x: &DVector<f64>) -> f64 {
        x.component_div(&self.units).norm() + self.length()
    }

    /// How long the sweep is, in units.
    fn length(&self) -> f64 {
        1.0 / self.units[self.units.len() - 1]
    }

    /// How far coordinates are to go for rows to turn by about a radian, in units.
    fn radian(&self) -> f64 {
        if self.extent > 0.0 {
            self.extent
        } else {
            self.length()
        }
    }

    /// How long the sweep and the mechanism are, in units.
    pub(super) fn scale(&self) -> f64 {
        self.extent + self.length()
    }

    /// What the coordinates come to at `x`, in units: each by its value, but by no more than turns a row of A by about a radian. What turns
    /// none, as places of bodies do not, tells where the ground is.
    pub(super) fn extent_at(&self, x: &DVector<f64>) -> f64 {
        let spec = self.mech.spec();
        let (n, m, h) = (spec.n(), spec.m(), spec.holonomic);
        let (t, rest) = (self.time_at(x[n]), vec![Sloped::from_f64(0.0); n]);
        let (t, sloped) = (Sloped::from_f64(t), self.mech.sloped());
        let entries = spec.structure.jacobian_pattern.iter();
        let entries = entries.filter(|(c, _)| *c < h);
        let mut terms = Evaluated::<Sloped>::new(n, m);
        let mut sum = 0.0_f64;
        for first in (0..n).step_by(Slopes::COUNT) {
            let q = x.iter().take(n).enumerate();
            let q = q.map(|(i, x)| Sloped::new(*x, Slopes::unit(i, first)));
            terms.dynamics(&sloped, t, &q.collect::<Vec<_>>(), &rest);
            for j in first..n.min(first + Slopes::COUNT) {
                let unit = self.units[j];
                let mut rows = vec![[0.0_f64; 2]; h];
                for (c, i) in entries.clone() {
                    let a = &terms.jacobian[i * m + c];
                    let [length, rate] = &mut rows[*c];
                    *length = length.hypot(a.re * self.units[*i]);
                    *rate = rate.hypot(a.eps.along(j - first) * self.units[*i] * unit);
                }
                let turned = rows.iter().filter(|[_, rate]| *rate > 0.0);
                let radian = turned.map(|[length, rate]| length / rate);
                if let Some(radian) = radian.reduce(f64::min) {
                    sum = sum.hypot((x[j] / unit).abs().min(radian));
                }
            }
        }
        sum
    }

    /// The place on the curve that is reached from `x`, where the tangent is nearest to `way`, and the rows there.
    fn onto(&self, x: DVector<f64>, way: &DVector<f64>) -> Option<(Place, Rows)> {
        let x = self.solved(x, false)?;
        let rows = self.rows(&x, self.mech.spec().n());
        let way = rows.along(way)?;
        Some((Place { x, way }, rows))
    }

    /// What Newton's method comes to from `x`, with steps that leave s as it is where it is `kept`.
    pub(super) fn solved(&self, mut x: DVector<f64>, kept: bool) -> Option<DVector<f64>> {
        let (n, size) = (self.mech.spec().n(), self.size(&x));
        let mut before = f64::INFINITY;
        for _ in 0..NEWTON {
            let mut rows = self.matrix(&x);
            if kept {
                rows.column_mut(n).fill(0.0);
            }
            let step = Rows::new(rows, n, &self.lengths).shortest(&-self.residual(&x));
            let length = step.norm();
            x += step.component_mul(&self.units);
            if length <= ROUNDING * size || length <= STALLED * size && length > 0.1 * before {
                return Some(x);
            }
            if length.is_nan() || length > 0.5 * before {
                return None;
            }
            before = length;
        }
        None
    }

    /// The step of this length from `from`, if the curve is smooth in between.
    fn beyond(&self, from: &Place, length: f64) -> Option<Step> {
        let guess = &from.x + (length * &from.way).component_mul(&self.units);
        let (place, rows) = self.onto(guess.clone(), &from.way)?;
        let turn = from.way.dot(&place.way).clamp(-1.0, 1.0).acos();
        let off = (&place.x - guess).component_div(&self.units).norm();
        // Of an arc it is half the turn times its length.
        let smooth = turn < TURN && off <= TURN * length;
        smooth.then_some(Step { place, rows, turn })
    }

    /// The place of a cubic from `a` to `b` at the part `part` of the way, and how fast s changes there.
    pub(super) fn between(&self, a: &Place, b: &Place, part: f64) -> (DVector<f64>, f64) {
        let chord = &b.x - &a.x;
        let length = chord.component_div(&self.units).norm();
        let ways = [&a.way, &b.way].map(|way| (length * way).component_mul(&self.units));
        let (p, rest) = (part, 1.0 - part);
        let x = &a.x + p * p * (3.0 - 2.0 * p) * &chord + p * rest * rest * &ways[0]
            - p * p * rest * &ways[1];
        let end = chord.len() - 1;
        let slope = 6.0 * p * rest * chord[end]
            + rest * (1.0 - 3.0 * p) * ways[0][end]
            + p * (3.0 * p - 2.0) * ways[1][end];
        (x, slope)
    }

    /// Follows the curve from `from` until s has come to `until`, to where s turns back before, or to where there is no smooth way on.
    pub(super) fn follow(&self, from: Place, until: f64) -> Path {
        let path = self.followed(from.clone(), until, true);
        let last = path.places.last().filter(|_| path.end == End::Stuck);
        let lost = last.is_some_and(|last| self.rows(&last.x, last.x.len() - 1).margin > APART);
        // Rows that are far from implying each other stop nobody: one of them has all but vanished, and what is left of it is rounding.
        let plain = lost.then(|| self.followed(from, until, false));
        plain
            .filter(|plain| plain.end != End::Stuck)
            .unwrap_or(path)
    }

    /// The path from `from`; where it is `careful`, round all bends.
    fn followed(&self, from: Place, until: f64, careful: bool) -> Path {
        let (per, sense) = (self.units[from.x.len() - 1], from.speed().signum());
        let (size, rounding) = (self.scale(), ROUGH * self.size(&from.x));
        let least = (LEAST * size).max(rounding);
        // Next to a crossing rounding moves coordinates by its root, and of a short sweep these are a part.
        let moved = from.way.rows(0, from.x.len() - 1).norm();
        let hidden = ((rounding * self.radian()).sqrt() / moved).max(2.0 * least);
        // The length along the curve in which s changes by `part`.
        let lasts = |place: &Place, part: f64| part / (per * place.speed().abs());
        let mut length = lasts(&from, FIRST).min(size);
        let mut rows = self.rows(&from.x, from.x.len() - 1);
        let mut places = vec![from];
        let (mut radii, mut crossings) = (Vec::new(), Vec::new());
        // How far ahead at most a combination of rows is reversed, and whether the next step goes over that.
        let (mut within, mut over) = (0.0, false);
        let end = loop {
            let here = &places[places.len() - 1];
            let rest = (until - here.s()) * sense;
            if rest <= 0.0 {
                break End::Arrived;
            }
            if places.len() > STEPS {
                break End::Long;
            }
            let most = lasts(here, (1.1 * rest).max(FIRST));
            if within > 0.0 && !over && length < hidden {
                (over, length) = (true, most.min(OVER * hidden));
            }
            if length < least || over && length > most {
                break End::Stuck;
            }
            length = length.min(most);
            let step = self.beyond(here, length).filter(|step| {
                let forward = step.place.speed() * sense > 0.0;
                // No turn there and back again in between.
                !forward || self.between(here, &step.place, 0.5).1 * sense > 0.0
            });
            let reversed =
                careful && !over && step.as_ref().is_some_and(|step| rows.reversed(&step.rows));
            let Some(step) = step.filter(|_| !reversed) else {
                within = if reversed { length } else { within };
                length *= if over { 2.0 } else { 0.5 };
                continue;
            };
            let Step {
                place: mut next,
                rows: there,
                turn,
            } = step;
            radii.push((length / turn.max(length / size), length));
            let growth = (WANTED / turn)
                .min(ROWS / rows.turned(&there))
                .clamp(0.5, 2.0);
            if over {
                crossings.push(places.len() - 1);
                (within, over) = (0.0, false);
            }
            let last = length;
            within -= length;
            length *= growth;
            if within > 0.0 {
                // The margin of the rows tells where it may vanish.
                let slope = (rows.margin - there.margin) / last;
                let ahead = if slope > 0.0 {
                    there.margin / slope
                } else {
                    f64::INFINITY
                };
                length = length.min(NEARLY * ahead).max(hidden);
            }
            let back = next.speed() * sense <= 0.0;
            if back {
                next = self.turning(here, &next, sense);
            }
            let left = (until - next.s()) * sense;
            places.push(next);
            rows = there;
            if back {
                break match left > -AT {
                    true => End::Turned,
                    false => End::Arrived,
                };
            }
        };
        Path {
            places,
            crossings,
            radius: usual(radii).unwrap_or(size),
            end,
        }
    }

    /// The place between `a` and `b` where s turns back.
    fn turning(&self, a: &Place, b: &Place, sense: f64) -> Place {
        let at = |part: f64| {
            let found = self.onto(self.between(a, b, part).0, &a.way);
            found.map(|(place, _)| place)
        };
        let back = |part: f64| Ok::<f64, ()>(at(part).map_or(f64::NAN, |p| -p.speed() * sense));
        let part = locate(back, 0.0, 1.0).unwrap_or(1.0);
        at(part).unwrap_or_else(|| b.clone())
    }
}

/// The value that is exceeded on half of the length of a path, by the values on parts of it, with their lengths.
fn usual(mut parts: Vec<(f64, f64)>) -> Option<f64> {
    parts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut left = 0.5 * parts.iter().map(|(_, length)| length).sum::<f64>();
    let middle = parts.iter().find(|(_, length)| {
        left -= length;
        left <= 0.0
    });
    middle.map(|(value, _)| *value)
}
