//! Gaussian elimination of the saddle-point system, in buffers allocated once.

use crate::dense::Rows;
use crate::lu::Lu;
use crate::scan::axpy;

/// A pivot of the scaled system (entries of order 1) below this is none: with n + m unknowns elimination loses a few digits, and
/// half of the digits must remain (√ε).
const PIVOT: f64 = 1.5e-8;

/// L⁻¹ \[M Aᵀ; A 0\] L⁻¹ by LU with partial pivoting, coordinates and rows scaled.
#[derive(Debug, Clone)]
pub(crate) struct Saddle {
    n: usize,
    m: usize,
    /// The scaled matrix, and its factors.
    matrix: Vec<f64>,
    lu: Lu<f64>,
    x: Vec<f64>,
    /// Right-hand side, then what the solution leaves of it.
    rest: Vec<f64>,
}

impl Saddle {
    pub(crate) fn new(n: usize, m: usize) -> Self {
        let size = n + m;
        Saddle {
            n,
            m,
            matrix: vec![0.0; size * size],
            lu: Lu::new(size),
            x: vec![0.0; size],
            rest: vec![0.0; size],
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
        let entries = self.lu.entries_mut();
        entries.fill(0.0);
        for j in 0..n {
            for i in 0..n {
                entries[j * size + i] = mass[j * n + i] / (root[i] * root[j]);
            }
            for (c, scale) in row_scale[..m].iter().enumerate() {
                let entry = scale * a.jacobian[j * a.stride + c] / root[j];
                entries[j * size + n + c] = entry;
                entries[(n + c) * size + j] = entry;
            }
        }
        self.matrix.copy_from_slice(entries);
        self.lu.factor(PIVOT)
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
        for i in 0..n {
            self.rest[i] = force[i] / root[i];
        }
        for (c, b) in rhs.iter().enumerate() {
            self.rest[n + c] = row_scale[c] * b;
        }
        self.x.copy_from_slice(&self.rest);
        self.lu.solve(&mut self.x);
        for i in 0..n {
            out[i] = self.x[i] / root[i];
        }
        // Once more for what rounding has left: rows that nearly imply each other have multipliers far larger than the accelerations, and
        // theirs is the rounding.
        for (x, column) in self.x.iter().zip(self.matrix.chunks_exact(size)) {
            axpy(-x, column, &mut self.rest);
        }
        self.lu.solve(&mut self.rest);
        for i in 0..n {
            out[i] += self.rest[i] / root[i];
        }
    }
}
