//! Decompositions that are found by iteration, each with an end: singular values, and eigenvalues of symmetric and of other matrices.
//!
//! A matrix that holds what is not a number has none of them. nalgebra's functions without a limit do not return then; its Schur
//! decomposition also not where eigenvalues coincide, as those of a mechanism and its copy do, since it knows one shift only and takes
//! entries below the diagonal for zero beside those on it alone, all of which vanish for a vibration without damping.

use nalgebra::linalg::SymmetricEigen;
use nalgebra::{Complex, DMatrix, DVector, Dyn, SVD};

/// Iterations at most for each row or column; two or three are usual.
const TURNS: usize = 60;
/// Turns at most for each eigenvalue; of motions of very different speeds that are mixed some take a hundred.
const SHIFTED: usize = 400;
/// The number of turns without an eigenvalue found after which other shifts are tried, and entries that rounding leaves unknown are zero.
const PATIENCE: usize = 10;
/// Rounds at most in which rows and columns are made as large as each other; and what a change has to leave of both to be worth it.
const ROUNDS: usize = 100;
const SETTLED: f64 = 0.95;

/// How many iterations `matrix` is given; `None` for one that is not finite.
fn limit(matrix: &DMatrix<f64>) -> Option<usize> {
    let finite = matrix.iter().all(|x| x.is_finite());
    finite.then_some(TURNS * (matrix.nrows() + matrix.ncols()))
}

/// The singular values of `matrix`, with singular vectors on its left and on its right if asked for, none of an empty one; `None` for one
/// that is not finite.
pub(crate) fn singular(
    matrix: DMatrix<f64>,
    left: bool,
    right: bool,
) -> Option<SVD<f64, Dyn, Dyn>> {
    let most = limit(&matrix)?;
    if matrix.is_empty() {
        let (rows, columns) = matrix.shape();
        return Some(SVD {
            u: left.then(|| DMatrix::zeros(rows, 0)),
            v_t: right.then(|| DMatrix::zeros(0, columns)),
            singular_values: DVector::zeros(0),
        });
    }
    matrix.try_svd(left, right, 5.0 * f64::EPSILON, most)
}

/// The eigenvalues and eigenvectors of a symmetric `matrix`, none of an empty one; `None` for one that is not finite.
pub(crate) fn symmetric(matrix: DMatrix<f64>) -> Option<SymmetricEigen<f64, Dyn>> {
    let most = limit(&matrix)?;
    if matrix.is_empty() {
        return Some(SymmetricEigen {
            eigenvectors: matrix,
            eigenvalues: DVector::zeros(0),
        });
    }
    SymmetricEigen::try_new(matrix, f64::EPSILON, most)
}

/// The eigenvalues of a square `matrix`, conjugate ones next to each other; `None` for one that is not finite.
///
/// By the QR algorithm with two implicit shifts (Golub & Van Loan, Matrix Computations, 4th ed., algorithm 7.5.2), and LAPACK's
/// exceptional ones (`dlahqr`).
pub(crate) fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let mut values = Vec::with_capacity(matrix.nrows());
    if matrix.is_empty() {
        return Some(values);
    }
    limit(matrix)?;
    let mut h = balanced(matrix.clone()).hessenberg().unpack_h();
    let unknown = f64::EPSILON * h.norm();
    let (mut end, mut turns) = (h.nrows(), 0);
    while end > 0 {
        let start = block(&h, end, if turns > PATIENCE { unknown } else { 0.0 });
        if start > 0 {
            h[(start, start - 1)] = 0.0;
        }
        match end - start {
            1 => values.push(Complex::new(h[(start, start)], 0.0)),
            2 => values.extend(pair(&h, start)),
            _ if turns == SHIFTED => return None,
            _ => {
                let (trace, determinant) = shifts(&h, start, end, turns);
                turn(&mut h, start, end, trace, determinant);
                turns += 1;
                continue;
            }
        }
        (end, turns) = (start, 0);
    }
    Some(values)
}

/// Blocks of a square `matrix` that have its eigenvalues together: what is left without the rows and columns from which an eigenvalue can
/// be read off, and each of these entries. Where nothing but the diagonal is left of a row or column, no rounding of others changes it
/// (LAPACK's `dgebal`). A coordinate that no equation contains, as where a vehicle is, has an eigenvalue of 0 so, which what it follows
/// from does not mix with.
pub(crate) fn isolated(matrix: &DMatrix<f64>) -> Vec<DMatrix<f64>> {
    let of = |all: &[usize]| matrix.select_rows(all).select_columns(all);
    let is_alone = |k: usize, left: &[usize]| {
        let none = |entry: &dyn Fn(usize) -> f64| left.iter().all(|i| *i == k || entry(*i) == 0.0);
        none(&|i| matrix[(i, k)]) || none(&|i| matrix[(k, i)])
    };
    let mut left: Vec<usize> = (0..matrix.nrows()).collect();
    let mut alone = Vec::new();
    while let Some(place) = left.iter().position(|k| is_alone(*k, &left)) {
        alone.push(of(&[left.remove(place)]));
    }
    std::iter::once(of(&left)).chain(alone).collect()
}

/// `matrix` measured by powers of two such that each row and its column are about as large as each other, which changes no eigenvalue
/// (Parlett & Reinsch, Numerische Mathematik 13 (1969), pp. 293–304): of what is slow beside the rest the frequency stands in both, not
/// its square in one and 1 in the other, where rounding of the other parts would be more than it.
fn balanced(mut matrix: DMatrix<f64>) -> DMatrix<f64> {
    for _ in 0..ROUNDS {
        let mut settled = true;
        for i in 0..matrix.nrows() {
            let own = matrix[(i, i)].abs();
            let row = matrix.row(i).lp_norm(1) - own;
            let column = matrix.column(i).lp_norm(1) - own;
            let factor = (0.5 * (row / column).log2()).round().exp2();
            let smaller = column * factor + row / factor < SETTLED * (row + column);
            if factor.is_normal() && smaller {
                matrix.column_mut(i).scale_mut(factor);
                matrix.row_mut(i).unscale_mut(factor);
                settled = false;
            }
        }
        if settled {
            break;
        }
    }
    matrix
}

/// The beginning of the last block without a zero below the diagonal that ends before `end`. Zero is what is below `unknown`, or rounding
/// of the diagonal.
fn block(h: &DMatrix<f64>, end: usize, unknown: f64) -> usize {
    let zero = |k: &usize| {
        let beside = h[(*k, *k)].abs() + h[(k - 1, k - 1)].abs();
        h[(*k, k - 1)].abs() <= (f64::EPSILON * beside).max(unknown)
    };
    (1..end).rev().find(zero).unwrap_or(0)
}

/// The eigenvalues of the two by two block at `k`.
fn pair(h: &DMatrix<f64>, k: usize) -> [Complex<f64>; 2] {
    let (a, d) = (h[(k, k)], h[(k + 1, k + 1)]);
    let product = h[(k, k + 1)] * h[(k + 1, k)];
    let half = 0.5 * (a - d);
    let square = half * half + product;
    if square < 0.0 {
        let (mean, aside) = (d + half, (-square).sqrt());
        return [Complex::new(mean, aside), Complex::new(mean, -aside)];
    }
    // The greater one first: the other one has its digits from the product.
    let far = half + square.sqrt().copysign(half);
    let near = if far == 0.0 { 0.0 } else { product / far };
    [Complex::new(d + far, 0.0), Complex::new(d - near, 0.0)]
}

/// The sum and the product of the two shifts: the eigenvalues of the last two rows, or, where these have led nowhere, others.
fn shifts(h: &DMatrix<f64>, start: usize, end: usize, turns: usize) -> (f64, f64) {
    let below = |k: usize| h[(k, k - 1)].abs();
    let (at, size) = match turns % (2 * PATIENCE) {
        _ if turns == 0 => (end - 1, None),
        0 => (start, Some(below(start + 1) + below(start + 2))),
        PATIENCE => (end - 1, Some(below(end - 1) + below(end - 2))),
        _ => (end - 1, None),
    };
    match size {
        // Those of [x, -0.4375 s; s, x].
        Some(size) => {
            let x = 0.75 * size + h[(at, at)];
            (2.0 * x, x * x + 0.4375 * size * size)
        }
        None => {
            let [a, b, c, d] = [(1, 1), (1, 0), (0, 1), (0, 0)].map(|(i, j)| h[(at - i, at - j)]);
            (a + d, a * d - b * c)
        }
    }
}

/// One turn of the rows and columns from `start` to `end`, by mirrors of three rows each that follow each other down the diagonal.
fn turn(h: &mut DMatrix<f64>, start: usize, end: usize, trace: f64, determinant: f64) {
    let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| h[(start + i, start + j)]);
    let mut column = [
        a * a + b * c - trace * a + determinant,
        c * (a + d - trace),
        c * h[(start + 2, start + 1)],
    ];
    for k in start..end - 1 {
        let rows = 3.min(end - k);
        let size = column.iter().fold(0.0, |s: f64, x| s.max(x.abs()));
        if size > 0.0 {
            let square = |axis: [f64; 3]| axis.iter().map(|x| x * x).sum::<f64>();
            let mut axis = column.map(|x| x / size);
            axis[0] += square(axis).sqrt().copysign(axis[0]);
            let twice = 2.0 / square(axis);
            for j in k.saturating_sub(1).max(start)..end {
                let along: f64 = (0..rows).map(|i| axis[i] * h[(k + i, j)]).sum();
                (0..rows).for_each(|i| h[(k + i, j)] -= twice * along * axis[i]);
            }
            for i in start..end.min(k + 4) {
                let along: f64 = (0..rows).map(|j| axis[j] * h[(i, k + j)]).sum();
                (0..rows).for_each(|j| h[(i, k + j)] -= twice * along * axis[j]);
            }
        }
        if k > start {
            (1..rows).for_each(|i| h[(k + i, k - 1)] = 0.0);
        }
        column = [1, 2, 3].map(|i| if k + i < end { h[(k + i, k)] } else { 0.0 });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x'' = −k x − c x' for each of `oscillators`, mixed by a rotation of all of them.
    fn oscillators(oscillators: &[(f64, f64)]) -> DMatrix<f64> {
        let n = oscillators.len();
        let mut flow = DMatrix::zeros(2 * n, 2 * n);
        for (i, (k, c)) in oscillators.iter().enumerate() {
            flow[(i, n + i)] = 1.0;
            flow[(n + i, i)] = -k;
            flow[(n + i, n + i)] = -c;
        }
        let mixed = DMatrix::from_fn(2 * n, 2 * n, |i, j| ((3 * i + 5 * j * j) as f64).sin());
        let turned = mixed.qr().q();
        turned.tr_mul(&(flow * &turned))
    }

    fn check(each: &[(f64, f64)]) {
        let mut wanted: Vec<Complex<f64>> = Vec::new();
        for (k, c) in each {
            let root = Complex::new(0.25 * c * c - k, 0.0).sqrt();
            wanted.extend([-0.5 * c + root, -0.5 * c - root]);
        }
        let found = eigenvalues(&oscillators(each)).expect("an end");
        assert_eq!(found.len(), wanted.len());
        for value in found {
            let near = |other: &Complex<f64>| (other - value).norm();
            let best =
                (0..wanted.len()).min_by(|i, j| near(&wanted[*i]).total_cmp(&near(&wanted[*j])));
            let best = wanted.swap_remove(best.expect("as many as wanted"));
            assert!(
                (best - value).norm() < 1e-12,
                "{each:?}: {value} for {best}"
            );
        }
    }

    #[test]
    fn copies_of_one_oscillator_have_its_eigenvalues() {
        for copies in [1, 2, 3, 4, 8, 20] {
            for damping in [0.0, 0.01, 0.3, 2.5] {
                check(&vec![(1.0, damping); copies]);
                check(&[vec![(1.0, damping); copies], vec![(0.7, damping); copies]].concat());
            }
        }
    }

    #[test]
    fn oscillators_that_differ_have_theirs() {
        let each: Vec<_> = (1..12)
            .map(|k| (0.1 * f64::from(k), 0.03 * f64::from(k * k % 7)))
            .collect();
        check(&each);
    }

    /// Squares of frequencies down to 1e-14 beside 1, each coordinate mixed with all others: the sum of the squares of all eigenvalues is
    /// known.
    #[test]
    fn slow_motions_beside_fast_ones_have_theirs() {
        for round in 0..400_i32 {
            let n = 3 + round as usize % 10;
            let size =
                |i: usize| 10_f64.powf(-3.5 * (1.0 + ((i * i) as f64 + f64::from(round)).sin()));
            let mixed = |i: usize, j: usize| 0.5 * ((i + j) as f64 + 0.3 * f64::from(round)).cos();
            let stiffness = DMatrix::from_fn(n, n, |i, j| {
                let own = if i == j { 1.0 + n as f64 } else { 0.0 };
                size(i) * size(j) * (own + mixed(i, j))
            });
            let mut flow = DMatrix::zeros(2 * n, 2 * n);
            flow.view_mut((0, n), (n, n)).fill_diagonal(1.0);
            flow.view_mut((n, 0), (n, n)).copy_from(&-&stiffness);
            let turned = DMatrix::from_fn(2 * n, 2 * n, |i, j| ((3 * i + 5 * j * j) as f64).sin());
            let turned = turned.qr().q();
            for matrix in [flow.clone(), turned.tr_mul(&(flow * &turned))] {
                let found = eigenvalues(&matrix).expect("an end");
                let sum: Complex<f64> = found.iter().map(|x| x * x).sum();
                assert!((sum + 2.0 * stiffness.trace()).norm() < 1e-11, "{round}");
            }
        }
    }

    /// Cyclic permutations stand still under the shifts of the last two rows.
    #[test]
    fn roots_of_one_take_other_shifts() {
        for n in [3, 4, 5, 8, 17] {
            let cycle = DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i == (j + 1) % n)));
            let found = eigenvalues(&cycle).expect("an end");
            for k in 0..n {
                let root = Complex::from_polar(1.0, std::f64::consts::TAU * k as f64 / n as f64);
                let near = found.iter().filter(|x| (*x - root).norm() < 1e-12);
                assert_eq!(near.count(), 1, "{n}: {found:?}");
            }
        }
    }

    #[test]
    fn what_is_empty_has_an_empty_one() {
        let empty = || DMatrix::zeros(0, 0);
        assert_eq!(eigenvalues(&empty()), Some(Vec::new()));
        let symmetric = symmetric(empty()).expect("an end");
        assert!(symmetric.eigenvalues.is_empty() && symmetric.eigenvectors.is_empty());
        let singular = singular(empty(), true, true).expect("an end");
        assert!(singular.singular_values.is_empty());
    }

    #[test]
    fn what_is_not_finite_has_none() {
        for wrong in [f64::NAN, f64::INFINITY] {
            let mut matrix = DMatrix::identity(4, 4);
            matrix[(2, 1)] = wrong;
            matrix[(1, 2)] = wrong;
            assert!(eigenvalues(&matrix).is_none());
            assert!(symmetric(matrix.clone()).is_none());
            assert!(singular(matrix, true, true).is_none());
        }
    }
}
