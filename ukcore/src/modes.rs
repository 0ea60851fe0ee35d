//! How a mechanism vibrates about a rest position, or a steady motion: eigenvalues of its linearised motion, in the tangent space of the
//! constraints.
//!
//! A deviation (δq, δq̇) moves as d/dt (δq, δq̇) = F (δq, δq̇), F = [0 1; ∂q̈/∂q ∂q̈/∂q̇], and stays on the constraints if it is there:
//! A δq = 0 of the holonomic ones, and ∂φ̇/∂q δq + A δq̇ = 0 of all. With an orthonormal basis Z of such deviations F Z = Z R, and the
//! eigenvalues of R = Zᵀ F Z are those of the mechanism alone: n coordinates bound by constraints have no eigenvalues of their own.
//! Coordinates are measured by the root of their inertia, so that metres and radians are comparable.

use nalgebra::{Complex, DMatrix, DVector};

use crate::assemble::State;
use crate::displacements::{
    complement, constraint_matrix, null_space, pivoted, quaternions, units,
};
use crate::error::Error;
use crate::kinks::{Sides, Ways, sides};
use crate::linearise::Linearisation;
use crate::measure::Measure;
use crate::mechanism::Prepared;
use crate::noise::Noise;
use crate::scalar::{Scalar, Sloped, Slopes};
use crate::scan::or_one;
use crate::solver::{Solver, SolverOptions};
use crate::spectrum::{eigenvalues, isolated};

/// An acceleration below this share of the parts that the largest one is the sum of is rounding, or what is left of a rest position that
/// was found by iteration; and what is nearer to rest than this share of its size.
const REST: f64 = 1e-9;
/// Rest positions are found to this share of the largest coordinate: of a mechanism that is far from the origin angles to no more.
const ROUNDED: f64 = 1e-12;
/// Accelerations below so many times what rounding is likely to leave of their forces are rounding.
const ROUNDINGS: f64 = 4.0;
/// What rounding may have changed in the linearised motion, as a part of it.
const ROUNDING: f64 = 1e-14;

/// Eigenvalues that differ by less, as a part of the linearised motion, are one: rounding leaves little of shapes of their own.
const TOGETHER: f64 = 1e-12;

/// A mode: deviations that grow by exp((`growth` + i `frequency`) t) without changing their shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Real part of its eigenvalue, 1/s: negative for a mode that dies away.
    pub growth: f64,
    /// Imaginary part, rad/s, not negative: of two conjugate eigenvalues one mode tells.
    pub frequency: f64,
    /// Deviation of each coordinate, real and imaginary part, in its own unit: relative to that of [`leader`](Mode::leader), which is 1.
    pub shape: Vec<[f64; 2]>,
    /// The coordinate that moves most, measured by the root of its inertia.
    pub leader: &'static str,
}

impl Mode {
    /// The magnitude of the mode's eigenvalue, 1/s.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.growth.hypot(self.frequency)
    }

    /// The damping ratio −`growth`/|eigenvalue|: 0 for a vibration that lasts, 1 for one that only dies away; 0 for an eigenvalue of 0.
    #[must_use]
    pub fn damping(&self) -> f64 {
        let size = self.size();
        if size > 0.0 { -self.growth / size } else { 0.0 }
    }
}

/// The modes of `mechanism` about `state`, slowest first: by frequency, then by growth. There are as many eigenvalues as the mechanism has
/// freedoms of position and of velocity: vibrations give two each; none where nothing is left to move. What rounding cannot tell from 0
/// is 0: the growth of a vibration that lasts, the frequency of critical damping, and both parts of an eigenvalue of 0, as of a body that
/// nothing holds, which comes double. Of an eigenvalue that comes so often with one shape only the root of that order of rounding counts:
/// of critical damping about eight digits are known.
///
/// # Errors
/// - [`Error::InvalidSetting`] where `state` is neither a rest position nor a steady motion: a coordinate accelerates.
/// - [`Error::Kink`] where a switch of sign, abs, min or max is zero and each side of it has a linear motion of its own. Where both have
///   the same, as about a drag v |v| at rest, modes are those; dry friction, sign(v), is left out.
/// - What [`Linearisation::at`] reports.
pub fn modes(mechanism: impl Into<Prepared>, state: &State) -> Result<Vec<Mode>, Error> {
    let mech = mechanism.into();
    let mut linear = Linear::at(&mech, state)?;
    steady(&mech, state, &linear)?;
    if let Some(Sides { held, kink, .. }) = sides_at(&mech, state, &linear, None) {
        match (kink, &held[..]) {
            (Some(kink), _) => return Err(kink.error(&mech)),
            (None, [held, ..]) => linear = Linear::at(held, state)?,
            (None, []) => {}
        }
    }
    linear_motion(&mech, state, &linear).map(|(modes, _)| modes)
}

/// Both sides of the switches that are zero at `state`, or within `reach` of its coordinates, as [`sides`] finds them.
pub(crate) fn sides_at(
    mech: &Prepared,
    state: &State,
    linear: &Linear,
    reach: Option<&DVector<f64>>,
) -> Option<Sides> {
    let Linear { units, pace, .. } = linear;
    if mech.spec().switches.is_empty() {
        return None;
    }
    let ways = Ways {
        units,
        pace: *pace,
        along: &tangent(mech, state, units, *pace),
    };
    sides(mech, state, &ways, reach)
}

/// The [`modes`](modes()) about `state`, which is at rest or in a steady motion, or taken for that, and whether what none of them tells
/// grows: deviations at an eigenvalue of 0 faster than in proportion to time, a vibration that lasts in proportion to it.
pub(crate) fn linear_motion(
    mech: &Prepared,
    state: &State,
    linear: &Linear,
) -> Result<(Vec<Mode>, bool), Error> {
    let Linear {
        units, flow, pace, ..
    } = linear;
    let pace = *pace;
    let tangent = tangent(mech, state, units, pace);
    if tangent.ncols() == 0 {
        return Ok((Vec::new(), false));
    }
    let rounding = ROUNDING * flow.norm();
    // Of what conserves its energy and rests squares of eigenvalues are real: the smaller part is rounding.
    let rests = state.v.iter().all(|v| *v == 0.0);
    let swings = rests && is_symmetric(mech);
    let reduced = tangent.tr_mul(&(flow * &tangent));
    let together = TOGETHER * reduced.norm();
    let mut shapes: Vec<Found> = Vec::new();
    let reason = "has a linearised motion whose eigenvalues were not found";
    let blocks = isolated(&reduced);
    let mut values = Vec::with_capacity(reduced.nrows());
    for own in &blocks {
        let found = eigenvalues(own).ok_or_else(|| Error::invalid("state", reason))?;
        values.extend(found.into_iter().map(|value| (value, own)));
    }
    // One of two conjugate ones tells of both.
    for (value, own) in values.into_iter().filter(|(value, _)| value.im >= 0.0) {
        let part = eigenvector(&reduced, value, 0);
        let left = reduced.map(|x| Complex::new(x, 0.0)) * &part - &part * value;
        let rounding = rounding.max(left.norm());
        let could_be = |re, im| is_one(own, value, Complex::new(re, im), rounding);
        let (growth, frequency) = match value {
            _ if could_be(0.0, 0.0) => (0.0, 0.0),
            Complex { re, im } if swings && im >= re.abs() => (0.0, pace * im),
            Complex { re, .. } if swings => (pace * re, 0.0),
            Complex { re, im } => (
                if could_be(0.0, im) { 0.0 } else { pace * re },
                if could_be(re, 0.0) { 0.0 } else { pace * im },
            ),
        };
        let lasts = growth != 0.0 || frequency != 0.0;
        let coincide = value.im > 0.0 && frequency == 0.0;
        for _ in 0..1 + usize::from(coincide) {
            let same = |one: &Found| lasts && (one.value - value).norm() <= together;
            let among: Vec<usize> = (0..shapes.len()).filter(|k| same(&shapes[*k])).collect();
            let again = |number| positions(&tangent, &eigenvector(&reduced, value, number));
            let other = match among.len() {
                0 => None,
                number => share_out(&mut shapes, &among, again(number)),
            };
            let shape = other.unwrap_or_else(|| positions(&tangent, &part));
            shapes.push(Found {
                value,
                growth,
                frequency,
                own: shape.icamax(),
                shape,
            });
        }
    }
    let still: Vec<usize> = (0..shapes.len()).filter(|k| shapes[*k].stays()).collect();
    let costless = costless(&tangent, &reduced, still.len());
    for (k, shape) in still.into_iter().zip(costless.iter().cycle()) {
        shapes[k].shape.clone_from(shape);
    }
    let grows = !swings && grows(&reduced, &shapes);
    let mut modes: Vec<Mode> = shapes.iter().map(|x| x.mode(mech, units)).collect();
    modes.sort_by(|a, b| {
        let by_frequency = a.frequency.total_cmp(&b.frequency);
        by_frequency.then(a.growth.total_cmp(&b.growth))
    });
    Ok((modes, grows))
}

/// Rounding moves no eigenvalue by more, as a part of the linearised motion: so far one that comes seven times with one shape.
const FAR: f64 = 1e-2;

/// Where on the way from an eigenvalue to what it could be the matrix is looked at: no places where others are likely.
const ON_THE_WAY: [f64; 3] = [0.37, 0.53, 0.71];

/// Whether the eigenvalue `value` of `matrix` could be `other`, as far as `rounding` of the matrix tells: all on the way are eigenvalues of
/// matrices as near (pseudospectra: Trefethen & Embree, Spectra and Pseudospectra, §2), in proportion to the way, as for an eigenvalue
/// that is one of its own. That holds for defective ones, too, which rounding moves by its root.
fn is_one(matrix: &DMatrix<f64>, value: Complex<f64>, other: Complex<f64>, rounding: f64) -> bool {
    let apart = |share: f64| {
        let shifted = shifted(matrix, value + (other - value) * share);
        shifted
            .lu()
            .try_inverse()
            .map_or(0.0, |inverse| inverse.norm().recip())
    };
    // An eigenvalue is an exact one of a matrix that is off by as much as it is.
    let off = (other - value).norm();
    off <= rounding
        || off <= FAR * matrix.norm()
            && ON_THE_WAY
                .iter()
                .all(|share| apart(*share) <= share * rounding)
}

/// Eigenvalues that differ by less, as a part of the linearised motion, may be what rounding makes of a defective one.
const SPLIT: f64 = 1e-4;

/// Whether deviations grow by powers of time: an eigenvalue of 0 has a Jordan block of three rows or more, that of a vibration that lasts
/// one of two or more.
fn grows(reduced: &DMatrix<f64>, shapes: &[Found]) -> bool {
    let zeros = shapes.iter().filter(|shape| shape.stays()).count();
    if zeros > 2 && largest_block(reduced) > 2 {
        return true;
    }
    let lasting = shapes
        .iter()
        .filter(|x| x.growth == 0.0 && x.frequency > 0.0);
    let frequencies: Vec<f64> = lasting.map(|x| x.value.im).collect();
    frequencies.iter().any(|one| {
        let mut near = frequencies.clone();
        near.sort_by(|a, b| (a - one).abs().total_cmp(&(b - one).abs()));
        let split = SPLIT * reduced.norm();
        let near: Vec<f64> = near
            .into_iter()
            .take_while(|x| (x - one).abs() <= split)
            .collect();
        // Of what a defective eigenvalue is split into the mean is known as well as others are.
        (2..=near.len()).any(|count| {
            let mean = near[..count].iter().sum::<f64>() / count as f64;
            let n = reduced.nrows();
            let mut aside = DMatrix::zeros(2 * n, 2 * n);
            aside.view_mut((0, 0), (n, n)).copy_from(reduced);
            aside.view_mut((n, n), (n, n)).copy_from(reduced);
            aside.view_mut((0, n), (n, n)).fill_diagonal(mean);
            aside.view_mut((n, 0), (n, n)).fill_diagonal(-mean);
            largest_block(&aside) > 1
        })
    })
}

/// How many rows the largest Jordan block of the eigenvalue 0 of `matrix` has: so often something vanishes of what is left when that which
/// has vanished is divided out (Kublanovskaya's staircase). No powers are taken, in which what is slow would be rounding.
fn largest_block(matrix: &DMatrix<f64>) -> usize {
    let rounding = TOGETHER * matrix.norm();
    let (mut left, mut size) = (matrix.clone(), 0);
    while !left.is_empty() {
        let (decomposed, pivots) = pivoted(&left);
        let rank = pivots.iter().filter(|x| **x > rounding).count();
        if rank == pivots.len() {
            break;
        }
        let q = decomposed.q();
        let kept = q.columns(0, rank);
        left = kept.tr_mul(&(left * kept));
        size += 1;
    }
    size
}

/// Whether mass and stiffness at rest are symmetric, and nothing else acts: forces have a potential, and constraints are holonomic.
pub(crate) fn is_symmetric(mech: &Prepared) -> bool {
    let spec = mech.spec();
    spec.structure.conservative && spec.holonomic == spec.m()
}

/// `matrix` less `value` on its diagonal.
fn shifted(matrix: &DMatrix<f64>, value: Complex<f64>) -> DMatrix<Complex<f64>> {
    let mut shifted = matrix.map(|x| Complex::new(x, 0.0));
    (0..matrix.nrows()).for_each(|k| shifted[(k, k)] -= value);
    shifted
}

/// A mode on the way.
struct Found {
    value: Complex<f64>,
    growth: f64,
    frequency: f64,
    /// Deviations of coordinates, measured by the root of their inertia.
    shape: DVector<Complex<f64>>,
    /// The coordinate that other shapes of its eigenvalue leave where it is.
    own: usize,
}

impl Found {
    /// Whether its eigenvalue is 0.
    fn stays(&self) -> bool {
        self.growth == 0.0 && self.frequency == 0.0
    }

    fn mode(&self, mech: &Prepared, units: &DVector<f64>) -> Mode {
        let leader = self.shape.icamax();
        let moved = self.shape.zip_map(units, |x, unit| x * unit);
        let relative = |x: &Complex<f64>| {
            let share = x / moved[leader];
            [share.re, share.im]
        };
        Mode {
            growth: self.growth,
            frequency: self.frequency,
            shape: moved.iter().map(relative).collect(),
            leader: mech.spec().coords[leader],
        }
    }
}

/// The deviations of coordinates in a deviation by `tangent`.
fn positions(tangent: &DMatrix<f64>, part: &DVector<Complex<f64>>) -> DVector<Complex<f64>> {
    let n = tangent.nrows() / 2;
    tangent.rows(0, n).map(|x| Complex::new(x, 0.0)) * part
}

/// A deviation is none beside the others below this part of it.
const NEW: f64 = 1e-6;

/// Modes of one eigenvalue have no shapes of their own: any sums of them are some. Those are taken in which a coordinate of each stays
/// where it is in the others, so that of several copies of a mechanism each moves alone. Returns `other` so, and makes the shapes `among`
/// so; `None` where `other` is none beside these, as where an eigenvalue has fewer shapes than it counts.
fn share_out(
    shapes: &mut [Found],
    among: &[usize],
    mut other: DVector<Complex<f64>>,
) -> Option<DVector<Complex<f64>>> {
    let size = other.norm();
    for k in among {
        let Found { shape, own, .. } = &shapes[*k];
        other -= shape * (other[*own] / shape[*own]);
        other[*own] = Complex::new(0.0, 0.0);
    }
    if other.norm() <= NEW * size {
        return None;
    }
    let leader = other.icamax();
    for k in among {
        let shape = &mut shapes[*k].shape;
        let share = shape[leader] / other[leader];
        *shape -= &other * share;
        shape[leader] = Complex::new(0.0, 0.0);
    }
    Some(other)
}

/// Displacements that R, `reduced`, leaves where they are, `most` at most; and once more those along which it can move, too.
fn costless(
    tangent: &DMatrix<f64>,
    reduced: &DMatrix<f64>,
    most: usize,
) -> Vec<DVector<Complex<f64>>> {
    let scaled = reduced / or_one(reduced.norm());
    let still = |rows: &DMatrix<f64>| {
        let (decomposed, pivots) = pivoted(rows);
        let rank = pivots.iter().filter(|x| **x > TOGETHER).count();
        let rank = rank.max(pivots.len().saturating_sub(most));
        complement(pivots.len(), &decomposed, rank)
    };
    let (all, across) = (still(&scaled), still(&scaled.transpose()));
    // R moves along what it reaches: what is at right angles to all that its transpose leaves where it is.
    let met = across.tr_mul(&all);
    let (decomposed, pivots) = pivoted(&met);
    let rank = pivots.iter().filter(|x| **x > NEW).count();
    let moving = &all * complement(pivots.len(), &decomposed, rank);
    let positions = tangent.rows(0, tangent.nrows() / 2);
    let shapes = [all, moving].map(|part| apart(positions * part));
    let columns = shapes.iter().flat_map(|shapes| shapes.column_iter());
    columns
        .map(|column| column.map(|x| Complex::new(x, 0.0)))
        .collect()
}

/// Sums of displacements, of each of which a coordinate stays where it is in the others.
fn apart(mut all: DMatrix<f64>) -> DMatrix<f64> {
    for k in 0..all.ncols() {
        let own = all.column(k).icamax();
        let one = all.column(k) / all[(own, k)];
        for mut other in all.column_iter_mut() {
            other -= &one * other[own];
        }
        all.set_column(k, &one);
    }
    all
}

/// The linearised motion about a state.
pub(crate) struct Linear {
    acceleration: Vec<f64>,
    units: DVector<f64>,
    /// F in these units, by a time in which accelerations are as large as what they follow from.
    flow: DMatrix<f64>,
    /// So many of these times are a second.
    pace: f64,
}

impl Linear {
    /// That of `mech` about `state`.
    ///
    /// # Errors
    /// What [`Linearisation::at`] reports.
    pub(crate) fn at(mech: &Prepared, state: &State) -> Result<Self, Error> {
        let found = Linearisation::at(mech, state)?;
        let units = units(mech, state);
        let n = units.len();
        let scaled =
            |slopes: &[f64]| DMatrix::from_fn(n, n, |i, j| units[j] / units[i] * slopes[j * n + i]);
        let (by_position, by_velocity) = (scaled(&found.by_position), scaled(&found.by_velocity));
        let pace = or_one(by_position.norm().sqrt().max(by_velocity.norm()));
        let mut flow = DMatrix::zeros(2 * n, 2 * n);
        flow.view_mut((0, n), (n, n)).fill_diagonal(1.0);
        flow.view_mut((n, 0), (n, n))
            .copy_from(&(by_position / (pace * pace)));
        flow.view_mut((n, n), (n, n))
            .copy_from(&(by_velocity / pace));
        let acceleration = found.acceleration;
        Ok(Linear {
            acceleration,
            units,
            flow,
            pace,
        })
    }
}

/// Refuses a state at which a coordinate accelerates, beside what accelerations there are made up of.
pub(crate) fn steady(mech: &Prepared, state: &State, linear: &Linear) -> Result<(), Error> {
    let Linear {
        acceleration,
        units,
        flow,
        pace,
    } = linear;
    let (n, State { t, q, v }) = (mech.spec().n(), state);
    // A way that takes the mechanism into another shape: a radian, or as far as that takes what turns; the unit of length where no
    // constraint tells any.
    let measure = Measure::at(mech, *t, [q, v]);
    let size = measure.size(q);
    let way = measure.reach(mech, *t, [q, v], size, REST).unwrap_or(1.0);
    let least = (REST * way).max(ROUNDED * size);
    let off = DVector::from_fn(2 * n, |k, _| {
        let j = k % n;
        let own = if k < n { q[j] } else { v[j] / pace };
        (REST * own.abs()).max(least * measure.scale[j]) / units[j]
    });
    let parts = flow.rows(n, n).abs() * off * (pace * pace);
    // Where a stiffness vanishes as parts of it cancel, these still round the forces.
    let mut rounding = vec![0.0; n];
    let mut noise = Noise::new(mech);
    noise.go(mech, *t, [q, v], |_| [0.0; 2]);
    noise.force(&mut rounding);
    let rounding = DVector::from_vec(rounding).component_mul(units) * (ROUNDINGS * f64::EPSILON);
    // Forces of constraints balance others.
    let solved = Solver::new(mech, SolverOptions::default()).solve(*t, q, v)?;
    let ideal = DVector::from_vec(solved.ideal_force).component_mul(units);
    let left = parts.amax().max(REST * ideal.amax()).max(rounding.amax());
    let accelerations = acceleration.iter().zip(units.iter());
    for (i, (a, unit)) in accelerations.enumerate() {
        if (a / unit).abs() > left {
            let name = mech.spec().coords[i];
            let mut reason = format!(
                "is neither a rest position nor a steady motion: `{name}` accelerates by {a:.3e}; modes are those of states that stay"
            );
            if quaternions(mech, state)
                .iter()
                .any(|(_, all)| all.contains(&i))
            {
                reason += ", as a quaternion of a body that spins does not: turn that by angles, such as those of a `tree`";
            }
            return Err(Error::invalid("state", reason));
        }
    }
    Ok(())
}

/// An orthonormal basis of the deviations that meet the constraints, in `units` and times of which `pace` are a second.
fn tangent(mech: &Prepared, state: &State, units: &DVector<f64>, pace: f64) -> DMatrix<f64> {
    let (spec, jacobian) = (mech.spec(), constraint_matrix(mech, state));
    let (n, m, h) = (spec.n(), spec.m(), spec.holonomic);
    let mut rows = DMatrix::zeros(h + m, 2 * n);
    rows.view_mut((0, 0), (h, n))
        .copy_from(&jacobian.rows(0, h));
    rows.view_mut((h, n), (m, n)).copy_from(&jacobian);
    let sloped = mech.sloped();
    let mut rate = vec![Sloped::from_f64(0.0); m];
    let v: Vec<Sloped> = state.v.iter().copied().map(Sloped::from_f64).collect();
    for first in (0..n).step_by(Slopes::COUNT) {
        let q = state.q.iter().enumerate();
        let q: Vec<Sloped> = q
            .map(|(i, x)| Sloped::new(*x, Slopes::unit(i, first)))
            .collect();
        sloped.residual_rate(Sloped::from_f64(state.t), &q, &v, &mut rate);
        for (row, rate) in rate.iter().enumerate() {
            for k in 0..Slopes::COUNT.min(n - first) {
                rows[(h + row, first + k)] = rate.eps.along(k) / pace;
            }
        }
    }
    null_space(rows, units)
}

/// The eigenvector of the eigenvalue `value`, of length 1, by inverse iteration from the beginning of this number: of an eigenvalue that
/// counts several times each leads to another one.
fn eigenvector(matrix: &DMatrix<f64>, value: Complex<f64>, number: usize) -> DVector<Complex<f64>> {
    let n = matrix.nrows();
    // Beside the eigenvalue, by what rounding leaves unknown of it or a little more, so that nothing is divided by 0.
    // Farther off where eigenvalues coincide, or the one that rounding puts nearest is the only one that is found.
    let (share, turns) = match number {
        0 => (8.0 * f64::EPSILON, 3),
        _ => (0.1 * TOGETHER, 6),
    };
    let mut aside = share * matrix.norm().max(f64::MIN_POSITIVE);
    let solver = loop {
        let solver = shifted(matrix, value + aside).lu();
        if solver.is_invertible() || !aside.is_finite() {
            break solver;
        }
        aside *= 2.0;
    };
    // Not at a right angle to any eigenvector that has a name.
    let mut vector = DVector::from_fn(n, |k, _| {
        Complex::new(1.0 + ((1 + number) as f64 * k as f64).sin(), 0.0)
    });
    for _ in 0..turns {
        if let Some(next) = solver.solve(&vector) {
            vector = next.unscale(next.norm());
        }
    }
    vector
}
