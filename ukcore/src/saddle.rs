//! Gaussian elimination of the saddle-point system, in buffers allocated once.

use crate::pinv::axpy;
use crate::workspace::Rows;

/// A pivot of the scaled system (entries of order 1) below this is none: with n + m unknowns elimination loses a few digits, and
/// half of the digits must remain (√ε).
const PIVOT: f64 = 1.5e-8;

/// L⁻¹ \[M Aᵀ; A 0\] L⁻¹ by LU with partial pivoting, coordinates and rows scaled.
#[derive(Debug, Clone)]
pub(crate) struct Saddle {
    n: usize,
    m: usize,
    lu: Vec<f64>,
    order: Vec<usize>,
    x: Vec<f64>,
}

impl Saddle {
    pub(crate) fn new(n: usize, m: usize) -> Self {
        let size = n + m;
        Saddle {
            n,
            m,
            lu: vec![0.0; size * size],
            order: vec![0; size],
            x: vec![0.0; size],
        }
    }

    /// Factors; `false` if a pivot is too small.
    pub(crate) fn factor(
        &mut self,
        mass: &[f64],
        a: Rows<'_>,
        root: &[f64],
        row_scale: &[f64],
    ) -> bool {
        let (n, m) = (self.n, self.m);
        let size = n + m;
        self.lu.fill(0.0);
        for j in 0..n {
            for i in 0..n {
                self.lu[j * size + i] = mass[j * n + i] / (root[i] * root[j]);
            }
            for (c, scale) in row_scale[..m].iter().enumerate() {
                let entry = scale * a.jacobian[j * a.stride + c] / root[j];
                self.lu[j * size + n + c] = entry;
                self.lu[(n + c) * size + j] = entry;
            }
        }
        for k in 0..size {
            let column = &self.lu[k * size..(k + 1) * size];
            let pivot = (k..size).fold(k, |b, i| {
                if column[i].abs() > column[b].abs() {
                    i
                } else {
                    b
                }
            });
            if column[pivot].abs() <= PIVOT {
                return false;
            }
            self.order[k] = pivot;
            if pivot != k {
                for j in 0..size {
                    self.lu.swap(j * size + k, j * size + pivot);
                }
            }
            let (done, rest) = self.lu.split_at_mut((k + 1) * size);
            let column = &mut done[k * size..];
            let inverse = column[k].recip();
            column[k + 1..].iter_mut().for_each(|x| *x *= inverse);
            for target in rest.chunks_exact_mut(size) {
                let s = target[k];
                if s != 0.0 {
                    axpy(-s, &column[k + 1..], &mut target[k + 1..]);
                }
            }
        }
        true
    }

    /// q̈ into `out`.
    pub(crate) fn solve(
        &mut self,
        force: &[f64],
        rhs: &[f64],
        root: &[f64],
        row_scale: &[f64],
        out: &mut [f64],
    ) {
        let (n, size) = (self.n, self.n + self.m);
        let x = &mut self.x;
        for i in 0..n {
            x[i] = force[i] / root[i];
        }
        for (c, b) in rhs.iter().enumerate() {
            x[n + c] = row_scale[c] * b;
        }
        self.order
            .iter()
            .enumerate()
            .for_each(|(k, &pivot)| x.swap(k, pivot));
        for k in 0..size {
            let s = x[k];
            axpy(
                -s,
                &self.lu[k * size + k + 1..(k + 1) * size],
                &mut x[k + 1..],
            );
        }
        for k in (0..size).rev() {
            x[k] /= self.lu[k * size + k];
            let s = x[k];
            axpy(-s, &self.lu[k * size..k * size + k], &mut x[..k]);
        }
        for i in 0..n {
            out[i] = x[i] / root[i];
        }
    }
}
