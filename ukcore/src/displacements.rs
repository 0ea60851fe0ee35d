//! Small displacements at a state: what coordinates are measured by, which of them constraints leave free, and which rows follow from
//! others.

use nalgebra::{ColPivQR, DMatrix, DVector, Dyn};

use crate::assemble::State;
use crate::measure::Measure;
use crate::mechanism::Prepared;
use crate::spec::Solve;

/// Rows of constraints, each of length 1, that keep less beside the others follow from them.
pub(crate) const INDEPENDENT: f64 = 1e-9;

/// M at `state`.
pub(crate) fn mass_matrix(mech: &Prepared, state: &State) -> DMatrix<f64> {
    let n = mech.spec().n();
    let mut mass = vec![0.0; n * n];
    mech.mass_matrix(state.t, &state.q, &mut mass);
    DMatrix::from_vec(n, n, mass)
}

/// A at `state`.
pub(crate) fn constraint_matrix(mech: &Prepared, state: &State) -> DMatrix<f64> {
    let (n, m) = (mech.spec().n(), mech.spec().m());
    let mut jacobian = vec![0.0; m * n];
    mech.jacobian(state.t, &state.q, &state.v, &mut jacobian);
    DMatrix::from_vec(m, n, jacobian)
}

/// No coordinate counts as lighter than this share of the heaviest, by the roots of inertias, as one may be whose inertia vanishes at some
/// states.
const LIGHTEST: f64 = 1e-6;

/// What coordinates are measured by at `state`: 1/√M_jj. Those of a [quaternion](quaternions) have one unit, by the mean inertia of the
/// directions in which it turns, so that it does not depend on the orientation by which numbers the body is where it is. By the
/// [`Measure`], which makes coordinates of different units comparable, none is lighter than [`LIGHTEST`] says, and one without inertia is
/// as heavy as the heaviest that shares a row of A with it, or as any: by a number that did not change with the units it would be next to
/// nothing beside others in some of them, and these beside it in others.
pub(crate) fn units(mech: &Prepared, state: &State) -> DVector<f64> {
    let mass = mass_matrix(mech, state);
    let mut inertia = mass.diagonal();
    for (_, all) in quaternions(mech, state) {
        let whole: f64 = all.iter().map(|j| mass[(*j, *j)]).sum();
        let mean = whole / (all.len() - 1) as f64;
        all.iter().for_each(|j| inertia[*j] = mean);
    }
    let measure = Measure::at(mech, state.t, [&state.q, &state.v]).scale;
    let roots = inertia.map(|m| m.max(0.0).sqrt());
    let heaviest = |all: &mut dyn Iterator<Item = usize>| {
        let own = all.map(|i| roots[i] * measure[i]);
        Some(own.fold(0.0, f64::max)).filter(|root| *root > 0.0)
    };
    let of_all = heaviest(&mut (0..roots.len())).unwrap_or(1.0);
    let structure = &mech.spec().structure;
    let beside = |j: usize| {
        let rows = structure.jacobian_pattern.iter().filter(|(_, i)| *i == j);
        heaviest(&mut rows.flat_map(|(c, _)| structure.in_row(*c))).unwrap_or(of_all)
    };
    roots.map_with_location(|j, _, root| {
        let least = if root > 0.0 {
            LIGHTEST * of_all
        } else {
            beside(j)
        };
        root.max(least / measure[j]).recip()
    })
}

/// A product with M is none below this share of what its factors could make.
const WEIGHTLESS: f64 = 1e-12;

/// The constraints that keep the length of a quaternion, with its coordinates, at `state`: along their gradient nothing has inertia, as the
/// kinetic energy of a body knows nothing of the quaternion's length.
pub(crate) fn quaternions(mech: &Prepared, state: &State) -> Vec<(usize, Vec<usize>)> {
    let (mass, rows) = (mass_matrix(mech, state), constraint_matrix(mech, state));
    let structure = &mech.spec().structure;
    let Solve {
        regular, turned, ..
    } = structure.solve;
    let candidates = [regular, turned].concat().into_iter();
    let candidates = candidates.map(|c| (c, structure.in_row(c).collect::<Vec<_>>()));
    let weightless = |(c, all): &(usize, Vec<usize>)| {
        let inertia: f64 = all.iter().map(|j| mass[(*j, *j)]).sum();
        let size = all.iter().fold(0.0_f64, |sum, j| sum.hypot(rows[(*c, *j)]));
        let force = &mass * rows.row(*c).transpose();
        let mut forces = force.iter().enumerate();
        let none = forces.all(|(i, f)| {
            f.abs() <= WEIGHTLESS * size * (inertia * mass[(i, i)].max(inertia)).sqrt()
        });
        all.len() > 1 && inertia > 0.0 && none
    };
    candidates.filter(weightless).collect()
}

/// Divides each of `rows` that is not zero by its length.
pub(crate) fn normalise(rows: &mut DMatrix<f64>) {
    for mut row in rows.row_iter_mut() {
        let length = row.norm();
        if length > 0.0 {
            row /= length;
        }
    }
}

/// Measures the columns of `rows` by `units`; those of velocities, which follow those of coordinates, by the same ones.
pub(crate) fn measure(rows: &mut DMatrix<f64>, units: &DVector<f64>) {
    for (k, mut column) in rows.column_iter_mut().enumerate() {
        column *= units[k % units.len()];
    }
}

/// `rows` [measured](measure) by `units`, each of length 1.
pub(crate) fn measured(mut rows: DMatrix<f64>, units: &DVector<f64>) -> DMatrix<f64> {
    measure(&mut rows, units);
    normalise(&mut rows);
    rows
}

/// An orthonormal basis of what all `rows` are at right angles to, measured by `units`, in columns. What no row knows of is in a column of
/// its own.
pub(crate) fn null_space(rows: DMatrix<f64>, units: &DVector<f64>) -> DMatrix<f64> {
    let n = rows.ncols();
    // Behind all others no reflection touches it.
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by_key(|j| rows.column(*j).amax() == 0.0);
    let (decomposed, pivots) = pivoted(&measured(rows, units).select_columns(&order));
    let basis = complement(n, &decomposed, independent(&pivots));
    let mut places = vec![0; n];
    order.iter().enumerate().for_each(|(k, j)| places[*j] = k);
    basis.select_rows(&places)
}

/// [`null_space`] of displacements that leave the coordinates `held` where they are.
pub(crate) fn null_space_holding(
    held: &[usize],
    rows: DMatrix<f64>,
    units: &DVector<f64>,
) -> DMatrix<f64> {
    let m = rows.nrows();
    let mut rows = rows.resize_vertically(m + held.len(), 0.0);
    for (k, j) in held.iter().enumerate() {
        rows[(m + k, *j)] = 1.0;
    }
    null_space(rows, units)
}

/// How many of [decomposed](decompose) rows do not follow from others, by their pivots.
pub(crate) fn independent(pivots: &[f64]) -> usize {
    pivots.iter().filter(|x| **x > INDEPENDENT).count()
}

/// [`null_space`] of rows of length `n` that are [decomposed](decompose), of which so many do not follow from others.
pub(crate) fn complement(
    n: usize,
    decomposed: &ColPivQR<f64, Dyn, Dyn>,
    rank: usize,
) -> DMatrix<f64> {
    let mut turned = DMatrix::identity(n, n);
    decomposed.q_tr_mul(&mut turned);
    turned.rows(rank, n - rank).transpose()
}

/// Rows of constraints, each of length 1, that keep less beside the others are near a singular position: whatever they do is beside it.
const SINGULAR: f64 = 1e-6;

/// Whether no combination of rows vanishes on the straight way from A₀ to A₁, as far as their products A₁ W A₀ᵀ tell, with any positive W.
///
/// If the symmetric part S of these is positive definite, then for each combination η of rows
/// (A₀ᵀη)·W((1 − τ) A₀ + τ A₁)ᵀη = (1 − τ)(A₀ᵀη)·W A₀ᵀη + τ ηᵀSη > 0: on that way none vanishes. And where one does vanish on a smooth way
/// it is reversed behind that place, and S is not definite. So this tells a way that has gone over a singular position from one that has
/// turned beside it, however far both ends are from the place.
pub(crate) fn none_vanishes(products: &DMatrix<f64>) -> bool {
    (products + products.transpose()).cholesky().is_some()
}

/// Whether a combination of rows is reversed on the way from the rows `before` to those `after`: then the way goes over a singular
/// position, or beside one in a step so long that it may have come to what is behind it.
///
/// Rows that follow from others before, or all but do, do not count. No column [hides](none_vanishes) others, whatever their units.
pub(crate) fn reversed(mut before: DMatrix<f64>, mut after: DMatrix<f64>) -> bool {
    for c in 0..before.nrows() {
        let length = before.row(c).amax();
        if length > 0.0 {
            before.row_mut(c).unscale_mut(length);
            after.row_mut(c).unscale_mut(length);
        }
    }
    for j in 0..before.ncols() {
        let size = before.column(j).amax().max(after.column(j).amax());
        if size > 0.0 {
            before.column_mut(j).unscale_mut(size);
            after.column_mut(j).unscale_mut(size);
        }
    }
    let mut lengths = before.clone();
    normalise(&mut lengths);
    let (decomposed, pivots) = pivoted(&lengths);
    let mut order = DVector::from_fn(before.nrows(), |c, _| c);
    decomposed.p().permute_rows(&mut order);
    let count = pivots.iter().filter(|x| **x > SINGULAR).count();
    let [before, after] = [before, after].map(|rows| rows.select_rows(order.iter().take(count)));
    !none_vanishes(&(before * after.transpose()))
}

/// The pivoted decomposition of the transpose of `rows`, measured by `units` and each of length 1, and its pivots: what each row keeps
/// beside those before it.
pub(crate) fn decompose(
    rows: DMatrix<f64>,
    units: &DVector<f64>,
) -> (ColPivQR<f64, Dyn, Dyn>, Vec<f64>) {
    pivoted(&measured(rows, units))
}

/// [`decompose`] of rows that are measured and of the lengths that they count with.
pub(crate) fn pivoted(rows: &DMatrix<f64>) -> (ColPivQR<f64, Dyn, Dyn>, Vec<f64>) {
    let decomposed = rows.transpose().col_piv_qr();
    let r = decomposed.r();
    let pivots = (0..r.nrows().min(r.ncols())).map(|k| r[(k, k)].abs());
    (decomposed, pivots.collect())
}
