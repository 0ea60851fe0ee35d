//! Gaussian elimination of real and complex matrices, in buffers allocated once.

use nalgebra::ComplexField;

/// P E = L U with partial pivoting.
#[derive(Debug, Clone)]
pub(crate) struct Lu<T> {
    size: usize,
    /// E, column-major, then its factors.
    entries: Vec<T>,
    /// Row that became row k.
    order: Vec<usize>,
}

impl<T: ComplexField<RealField = f64> + Copy> Lu<T> {
    /// Buffers for matrices size × size.
    pub(crate) fn new(size: usize) -> Self {
        Lu {
            size,
            entries: vec![T::zero(); size * size],
            order: vec![0; size],
        }
    }

    /// The matrix to be factored, column-major; it holds what was left there.
    pub(crate) fn entries_mut(&mut self) -> &mut [T] {
        &mut self.entries
    }

    /// Factors; `false` if a pivot does not exceed `least`.
    pub(crate) fn factor(&mut self, least: f64) -> bool {
        let size = self.size;
        for k in 0..size {
            let column = &self.entries[k * size..(k + 1) * size];
            let (mut pivot, mut largest) = (None, least);
            for (i, x) in column.iter().enumerate().skip(k) {
                let x = x.norm1();
                if x > largest {
                    (pivot, largest) = (Some(i), x);
                }
            }
            let Some(pivot) = pivot else {
                return false;
            };
            self.order[k] = pivot;
            if pivot != k {
                for j in 0..size {
                    self.entries.swap(j * size + k, j * size + pivot);
                }
            }
            let (done, rest) = self.entries.split_at_mut((k + 1) * size);
            let column = &mut done[k * size..];
            let inverse = column[k].recip();
            column[k + 1..].iter_mut().for_each(|x| *x *= inverse);
            for target in rest.chunks_exact_mut(size) {
                subtract(target[k], &column[k + 1..], &mut target[k + 1..]);
            }
        }
        true
    }

    /// Replaces x by E⁻¹ x.
    pub(crate) fn solve(&self, x: &mut [T]) {
        let size = self.size;
        for (k, pivot) in self.order.iter().enumerate() {
            x.swap(k, *pivot);
        }
        for k in 0..size {
            let column = &self.entries[k * size..(k + 1) * size];
            subtract(x[k], &column[k + 1..], &mut x[k + 1..]);
        }
        for k in (0..size).rev() {
            let column = &self.entries[k * size..(k + 1) * size];
            x[k] /= column[k];
            subtract(x[k], &column[..k], &mut x[..k]);
        }
    }
}

/// y − s x into y.
fn subtract<T: ComplexField + Copy>(s: T, x: &[T], y: &mut [T]) {
    // Structural zeros are many.
    if s != T::zero() {
        y.iter_mut().zip(x).for_each(|(y, x)| *y -= s * *x);
    }
}
