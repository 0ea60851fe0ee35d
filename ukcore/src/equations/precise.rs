//! The equations of motion in 31 digits: what the accelerations of a state are when nothing is lost.

use crate::mechanism::{Evaluated, Mechanism};
use crate::scalar::DoubleDouble;
use crate::scalar::Scalar;

/// A pivot of the equilibrated system below this is none: 22 of the 31 digits, and twice those of the state.
const PIVOT: f64 = 1e-22;

/// Sweeps of equilibration: each halves the logarithms of the sizes, of which the largest is 2000.
const SWEEPS: usize = 12;

/// q̈ with M q̈ = Q + c + Aᵀλ and A q̈ = b at (t, q, q̇), which are taken as exact; by the emitted M, Q, c, A, b in [`DoubleDouble`] and
/// elimination with complete pivoting.
///
/// `None` where the motion is not determined. Where constraints are redundant (pivots below 1e-22 of their row), the rest decides; a set
/// that is redundant only on the constraints counts as independent at a state that satisfies them to 16 digits, so this is no reference
/// for it.
#[must_use]
pub fn accelerations<M: Mechanism>(
    mechanism: &M,
    t: f64,
    q: &[f64],
    v: &[f64],
) -> Option<Vec<f64>> {
    let (n, m) = (M::SPEC.n(), M::SPEC.m());
    let wide = |x: &[f64]| x.iter().map(|x| DoubleDouble::from_f64(*x)).collect();
    let (q, v): (Vec<_>, Vec<_>) = (wide(q), wide(v));
    let mut terms = Evaluated::new(n, m);
    let prepared = mechanism.prepared::<DoubleDouble>();
    terms.dynamics(&prepared, DoubleDouble::from_f64(t), &q, &v);
    let (mass, jacobian) = (&terms.mass, &terms.jacobian);
    let size = n + m;
    let mut rows = vec![vec![DoubleDouble::from_f64(0.0); size + 1]; size];
    for i in 0..n {
        for j in 0..n {
            rows[i][j] = mass[j * n + i];
        }
        for c in 0..m {
            rows[i][n + c] = jacobian[i * m + c];
            rows[n + c][i] = jacobian[i * m + c];
        }
        rows[i][size] = terms.force[i] + terms.nonideal[i];
    }
    for c in 0..m {
        rows[n + c][size] = terms.rhs[c];
    }
    solve(rows)?.into_iter().take(n).collect()
}

/// The unknowns of a linear system, given as rows with their right-hand sides; `None` for those that are not determined.
fn solve(mut rows: Vec<Vec<DoubleDouble>>) -> Option<Vec<Option<f64>>> {
    let size = rows.len();
    let mut columns = equilibrate(&mut rows);
    let mut order: Vec<usize> = (0..size).collect();
    let mut rank = size;
    for k in 0..size {
        let places = (k..size).flat_map(|i| (k..size).map(move |j| (i, j)));
        let (i, j) = places.fold((k, k), |best, at| {
            let entry = |(i, j): (usize, usize)| rows[i][j].to_f64().abs();
            if entry(at) > entry(best) { at } else { best }
        });
        let pivot = rows[i][j];
        if pivot.to_f64().is_nan() {
            return None;
        }
        if pivot.to_f64().abs() <= PIVOT {
            rank = k;
            break;
        }
        rows.swap(k, i);
        order.swap(k, j);
        columns.swap(k, j);
        rows.iter_mut().for_each(|row| row.swap(k, j));
        let (done, rest) = rows.split_at_mut(k + 1);
        for row in rest {
            let factor = row[k] / pivot;
            if !factor.is_zero() {
                for (x, p) in row[k..].iter_mut().zip(&done[k][k..]) {
                    *x = *x - factor * *p;
                }
            }
        }
    }
    let mut x = vec![None; size];
    let mut known = vec![DoubleDouble::from_f64(0.0); size];
    for k in (0..rank).rev() {
        // An unknown that depends on one left open is open, too.
        let open = (rank..size).any(|j| rows[k][j].to_f64().abs() > PIVOT)
            || (k + 1..rank).any(|j| x[order[j]].is_none() && rows[k][j].to_f64().abs() > PIVOT);
        if open {
            continue;
        }
        let sum = (k + 1..rank).fold(rows[k][size], |s, j| s - rows[k][j] * known[j]);
        known[k] = sum / rows[k][k];
        x[order[k]] = Some((known[k] * columns[k]).to_f64());
    }
    Some(x)
}

/// Scales rows and columns by powers of two until their largest entries are about 1 (Ruiz 2001). Returns the factors of the columns.
fn equilibrate(rows: &mut [Vec<DoubleDouble>]) -> Vec<DoubleDouble> {
    let size = rows.len();
    let mut columns = vec![DoubleDouble::from_f64(1.0); size];
    // Half of the way each time, as rows and columns share it.
    let factor = |largest: f64| {
        let known = largest > 0.0 && largest.is_finite();
        let exponent = if known { -0.5 * largest.log2() } else { 0.0 };
        DoubleDouble::from_f64(exponent.round().exp2())
    };
    let larger = |s: f64, x: &DoubleDouble| s.max(x.to_f64().abs());
    for _ in 0..SWEEPS {
        let column = |j: usize| factor(rows.iter().map(|row| &row[j]).fold(0.0, larger));
        let of_columns: Vec<_> = (0..size).map(column).collect();
        let scale = |row: &mut [DoubleDouble]| {
            let pairs = row.iter_mut().zip(&of_columns);
            pairs.for_each(|(x, c)| *x = *x * *c);
        };
        for row in rows.iter_mut() {
            let r = factor(row[..size].iter().fold(0.0, larger));
            row.iter_mut().for_each(|x| *x = *x * r);
            scale(row);
        }
        scale(&mut columns);
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::Pendulum;

    #[test]
    fn a_pendulum_falls_as_its_closed_form_says() {
        let mechanism = Pendulum::default();
        let (l, g) = (mechanism.get("l").unwrap(), mechanism.get("g").unwrap());
        // At rest, level: free fall along the tangent.
        let found = accelerations(&mechanism, 0.0, &[l, 0.0], &[0.0, 0.0]);
        assert_eq!(found, Some(vec![0.0, -g]));
    }

    #[test]
    fn what_is_not_determined_is_left_open() {
        let d = DoubleDouble::from_f64;
        let rows = vec![
            vec![d(1.0), d(0.0), d(0.0), d(2.0)],
            vec![d(0.0), d(1.0), d(1.0), d(3.0)],
            vec![d(0.0), d(2.0), d(2.0), d(6.0)],
        ];
        assert_eq!(solve(rows), Some(vec![Some(2.0), None, None]));
    }
}
