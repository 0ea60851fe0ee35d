//! M as a metric: M = L Lᵀ where it is regular, scales for the coordinates where it is not.

use crate::scan::{axpy, dot, or_one};

/// A pivot d_k of the Cholesky factorisation counts as zero below this multiple of n ε M_kk.
///
/// d_k/M_kk is the share of coordinate k's inertia that the coordinates before it do not carry already. Rounding of M and of the
/// factorisation puts an error of a few n ε on it; the factor leaves room for masses that are themselves sums of cancelling terms.
const PIVOT_ROUNDING: f64 = 256.0;

/// While every pivot d_k of the factorisation in the order of the coordinates is above this share of M_kk, rounding errors have
/// grown by less than its inverse, and d_k tells regular from singular by [`PIVOT_ROUNDING`] beyond doubt. Below, a factorisation
/// with interchanges decides: without them a nearly massless coordinate that stands first spoils the pivots after it.
const DOUBT: f64 = 1e-3;

/// Some rows of A (m × n, column-major): the first `rows`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rows<'a> {
    pub(crate) jacobian: &'a [f64],
    /// m, the distance of columns.
    pub(crate) stride: usize,
    pub(crate) rows: usize,
}

impl<'a> Rows<'a> {
    /// All rows of an A that has so many.
    pub(crate) fn all(jacobian: &'a [f64], rows: usize) -> Self {
        let stride = rows;
        Rows {
            jacobian,
            stride,
            rows,
        }
    }

    /// Entries of row `c`.
    pub(crate) fn row(self, c: usize) -> impl Iterator<Item = f64> + 'a {
        let entries = self.jacobian.iter().skip(c);
        entries.step_by(self.stride.max(1)).copied()
    }

    /// (A x)_c.
    pub(crate) fn product(self, c: usize, x: &[f64]) -> f64 {
        self.row(c).zip(x).map(|(a, x)| a * x).sum()
    }

    /// Σ |A_ci x_i|, the size of the terms of (A x)_c.
    pub(crate) fn magnitude(self, c: usize, x: &[f64]) -> f64 {
        self.row(c).zip(x).map(|(a, x)| (a * x).abs()).sum()
    }

    /// max |A_ci| sᵢ, of coordinates with the [scale](crate::measure::Measure::scale) s.
    pub(crate) fn largest(self, c: usize, scale: &[f64]) -> f64 {
        let entries = self.row(c).zip(scale).map(|(a, s)| (a * s).abs());
        entries.fold(0.0, f64::max)
    }
}

/// Why M cannot serve as asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MassFault {
    /// Singular: found at this coordinate.
    Singular(usize),
    /// Indefinite: found at this coordinate.
    Indefinite(usize),
}

/// What M is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// M = L Lᵀ with L diagonal (in `root`).
    Diagonal,
    /// M = L Lᵀ with L lower triangular.
    Full,
    /// L = diag(root) is a scaling only.
    Scales,
}

/// A metric on the coordinates, in buffers allocated once. Throughout, x = Lᵀ q̈ are the scaled accelerations.
#[derive(Debug, Clone)]
pub(crate) struct Metric {
    n: usize,
    kind: Kind,
    /// L_ii.
    pub(crate) root: Vec<f64>,
    /// L, column-major, allocated where M is not diagonal.
    l: Vec<f64>,
    /// M with unit diagonal, and the order of its coordinates, for [`Metric::classify`].
    unit: Vec<f64>,
    order: Vec<usize>,
}

impl Metric {
    pub(crate) fn new(n: usize, diagonal: bool) -> Self {
        Metric {
            n,
            kind: Kind::Diagonal,
            root: vec![1.0; n],
            l: vec![0.0; if diagonal { 0 } else { n * n }],
            unit: vec![0.0; if diagonal { 0 } else { n * n }],
            order: vec![0; n],
        }
    }

    /// Whether M itself is the metric (M = L Lᵀ).
    pub(crate) fn regular(&self) -> bool {
        self.kind != Kind::Scales
    }

    /// M = L Lᵀ: square roots or Cholesky. An error where M is not positive definite to rounding.
    pub(crate) fn factor(&mut self, mass: &[f64]) -> Result<(), MassFault> {
        let n = self.n;
        let verdict = |k: usize, pivot: f64, floor: f64| match pivot {
            p if p > floor => Ok(p.sqrt()),
            p if p >= -floor => Err(MassFault::Singular(k)),
            _ => Err(MassFault::Indefinite(k)),
        };
        if self.l.is_empty() {
            self.kind = Kind::Diagonal;
            for k in 0..n {
                self.root[k] = verdict(k, mass[k * n + k], 0.0)?;
            }
            return Ok(());
        }
        self.kind = Kind::Full;
        self.l.copy_from_slice(mass);
        let mut doubt = false;
        for k in 0..n {
            for j in 0..k {
                let (done, column) = self.l.split_at_mut(k * n);
                let factor = done[j * n + k];
                axpy(-factor, &done[j * n + k..(j + 1) * n], &mut column[k..n]);
            }
            let column = &mut self.l[k * n + k..(k + 1) * n];
            doubt = doubt || column[0] <= DOUBT * mass[k * n + k].abs();
            if doubt && column[0] <= 0.0 {
                break;
            }
            let root = column[0].sqrt();
            column[0] = root;
            column[1..].iter_mut().for_each(|x| *x /= root);
            self.root[k] = root;
        }
        if doubt { self.classify(mass) } else { Ok(()) }
    }

    /// Whether M is regular, singular or indefinite, by Cholesky's factorisation with interchanges of M scaled to unit diagonal.
    fn classify(&mut self, mass: &[f64]) -> Result<(), MassFault> {
        let n = self.n;
        let floor = PIVOT_ROUNDING * n as f64 * f64::EPSILON;
        possible(mass, n)?;
        if let Some(i) = (0..n).rfind(|i| mass[i * n + i] == 0.0) {
            return Err(MassFault::Singular(i));
        }
        for j in 0..n {
            for i in 0..n {
                let scale = mass[i * n + i].sqrt() * mass[j * n + j].sqrt();
                self.unit[j * n + i] = mass[j * n + i] / scale;
            }
        }
        let (w, order) = (&mut self.unit, &mut self.order);
        let rank = pivoted_cholesky(w, order, floor);
        let rank = rank.map_err(|lowest| MassFault::Indefinite(order[lowest]))?;
        match rank < n {
            true => Err(MassFault::Singular(order[top(w, n, rank)])),
            false => Ok(()),
        }
    }

    /// Which share of M⁻¹ Q rounding of the entries of M may be: ε over the least that a coordinate's inertia keeps beside the others'. 1
    /// at most.
    pub(crate) fn rounding(&mut self, mass: &[f64]) -> f64 {
        let n = self.n;
        if self.l.is_empty() {
            return 0.0;
        }
        if self.classify(mass).is_err() {
            return 1.0;
        }
        let roots = (0..n).map(|k| self.unit[k * n + k]);
        let least = roots.fold(1.0, f64::min);
        (f64::EPSILON / (least * least)).min(1.0)
    }

    /// Scales for a singular M: √M_ii where there is mass. A massless coordinate gets, by `measure`, which makes coordinates of different
    /// units comparable, the largest scale of the massive ones in its rows, so that it neither hides them nor is hidden; or of all, if
    /// there are none. How large the entries of that row are does not matter: as one of them vanishes, the coordinate would become
    /// heavier or lighter than all others without bound, and what is left of rows beside each other, which tells how near they are to
    /// implying each other, would be its entries alone. Rows a that are `regular` give coordinates the mass of M + μ aᵀa, which does not
    /// vanish where their own does: what is next to nothing there, as beside the identity orientation, would have rounding of other rows
    /// for large entries. The accelerations do not depend on these scales, only their rounding does, and what counts as singular.
    pub(crate) fn scale(
        &mut self,
        mass: &[f64],
        a: Rows<'_>,
        regular: impl Iterator<Item = usize>,
        measure: &[f64],
    ) -> Result<(), MassFault> {
        let n = self.n;
        self.kind = Kind::Scales;
        possible(mass, n)?;
        let diagonal = self.root.iter_mut().zip(mass.iter().step_by(n + 1));
        diagonal.for_each(|(root, own)| *root = own.sqrt());
        for c in regular.filter(|c| *c < a.rows) {
            let (mut length, mut root) = (0.0_f64, 0.0_f64);
            for ((a, own), unit) in a.row(c).zip(&self.root).zip(measure) {
                if a != 0.0 {
                    length = length.hypot(a * unit);
                    root = root.hypot(own * unit);
                }
            }
            if length > 0.0 {
                let pairs = self.root.iter_mut().zip(a.row(c));
                pairs.for_each(|(own, a)| *own = own.hypot(root * (a / length)));
            }
        }
        let massive = |i: &usize| mass[i * n + i] > 0.0;
        for j in 0..n {
            if self.root[j] > 0.0 {
                continue;
            }
            let entry = |c: usize, i: usize| a.jacobian[i * a.stride + c];
            let rows = (0..a.rows).filter(|&c| entry(c, j) != 0.0);
            let beside = rows.flat_map(|c| (0..n).filter(move |&i| entry(c, i) != 0.0));
            let sizes = beside.filter(massive).map(|i| self.root[i] * measure[i]);
            self.root[j] = sizes.fold(0.0, f64::max) / measure[j];
        }
        let units = || self.root.iter().zip(measure);
        let largest = units().fold(0.0_f64, |most, (root, unit)| most.max(root * unit));
        for (root, unit) in self.root.iter_mut().zip(measure) {
            if *root == 0.0 {
                *root = or_one(largest) / unit;
            }
        }
        Ok(())
    }

    /// x ← L⁻¹ x.
    pub(crate) fn divide(&self, x: &mut [f64]) {
        if self.kind == Kind::Full {
            divide(&self.l, self.n, x);
        } else {
            x.iter_mut().zip(&self.root).for_each(|(x, l)| *x /= l);
        }
    }

    /// x ← L⁻ᵀ x.
    pub(crate) fn divide_transposed(&self, x: &mut [f64]) {
        if self.kind == Kind::Full {
            divide_transposed(&self.l, self.n, x);
        } else {
            self.divide(x);
        }
    }

    /// x ← L x.
    pub(crate) fn multiply(&self, x: &mut [f64]) {
        if self.kind == Kind::Full {
            let n = self.n;
            for i in (0..n).rev() {
                let s = x[i];
                x[i] = s * self.root[i];
                axpy(s, &self.l[i * n + i + 1..(i + 1) * n], &mut x[i + 1..]);
            }
        } else {
            x.iter_mut().zip(&self.root).for_each(|(x, l)| *x *= l);
        }
    }
}

/// Place of the largest entry on the diagonal of the d × d matrix `z`, from place k on.
fn top(z: &[f64], d: usize, k: usize) -> usize {
    (k..d).fold(k, |b, i| if z[i * d + i] > z[b * d + b] { i } else { b })
}

/// Cholesky's factorisation with interchanges of the symmetric d × d matrix in `z`, down to pivots that do not exceed `floor`; d is the
/// length of `order`, where it writes which coordinate stands at which place. Returns the rank, or as an error the place of a pivot below
/// −`floor`.
pub(crate) fn pivoted_cholesky(
    z: &mut [f64],
    order: &mut [usize],
    floor: f64,
) -> Result<usize, usize> {
    let d = order.len();
    order.iter_mut().enumerate().for_each(|(i, o)| *o = i);
    for k in 0..d {
        let top = top(z, d, k);
        if z[top * d + top] <= floor {
            let lowest = (k..d).fold(k, |b, i| if z[i * d + i] < z[b * d + b] { i } else { b });
            return match z[lowest * d + lowest] < -floor {
                true => Err(lowest),
                false => Ok(k),
            };
        }
        if top != k {
            order.swap(k, top);
            for i in 0..d {
                z.swap(i * d + k, i * d + top);
            }
            for i in 0..d {
                z.swap(k * d + i, top * d + i);
            }
        }
        // Right-looking, both triangles of the rest, since later interchanges need them.
        let root = z[k * d + k].sqrt();
        z[k * d + k] = root;
        for i in k + 1..d {
            z[k * d + i] /= root;
        }
        for j in k + 1..d {
            let (done, rest) = z.split_at_mut(j * d);
            let column = &done[k * d + k + 1..(k + 1) * d];
            axpy(-done[k * d + j], column, &mut rest[k + 1..d]);
        }
    }
    Ok(d)
}

/// x ← L⁻¹ x, with the first rows and columns of a lower triangular L, whose columns are `stride` apart.
pub(crate) fn divide(l: &[f64], stride: usize, x: &mut [f64]) {
    for i in 0..x.len() {
        let column = &l[i * stride..i * stride + x.len()];
        x[i] /= column[i];
        axpy(-x[i], &column[i + 1..], &mut x[i + 1..]);
    }
}

/// x ← L⁻ᵀ x.
pub(crate) fn divide_transposed(l: &[f64], stride: usize, x: &mut [f64]) {
    for i in (0..x.len()).rev() {
        let column = &l[i * stride..i * stride + x.len()];
        x[i] = (x[i] - dot(&column[i + 1..], &x[i + 1..])) / column[i];
    }
}

/// An error where a coordinate has a negative inertia, or, without one of its own, is coupled to that of another by more than rounding or
/// underflow explains (|M_ij| against M_jj), which no positive semidefinite M allows.
fn possible(mass: &[f64], n: usize) -> Result<(), MassFault> {
    let coupled = |i: usize| {
        (0..n).filter(|j| *j != i).any(|j| {
            let entry = mass[j * n + i].abs().max(mass[i * n + j].abs());
            entry > f64::EPSILON * mass[j * n + j].abs()
        })
    };
    let own = |i: usize| mass[i * n + i];
    let fault = (0..n).find(|i| own(*i) < 0.0 || own(*i) == 0.0 && coupled(*i));
    fault.map_or(Ok(()), |i| Err(MassFault::Indefinite(i)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const M: [f64; 9] = [4.0, 2.0, 1.0, 2.0, 5.0, 3.0, 1.0, 3.0, 6.0];

    #[test]
    fn l_times_its_transpose_is_m() {
        let mut metric = Metric::new(3, false);
        metric.factor(&M).unwrap();
        for j in 0..3 {
            let mut x = [0.0; 3];
            x[j] = 1.0;
            // M⁻¹ e_j, multiplied by M.
            metric.divide(&mut x);
            metric.divide_transposed(&mut x);
            for i in 0..3 {
                let product: f64 = (0..3).map(|k| M[k * 3 + i] * x[k]).sum();
                assert!((product - f64::from(u8::from(i == j))).abs() < 1e-15);
            }
        }
        let mut x = [1.0, -2.0, 3.0];
        metric.multiply(&mut x);
        metric.divide(&mut x);
        assert!((x[0] - 1.0).abs() + (x[1] + 2.0).abs() + (x[2] - 3.0).abs() < 1e-15);
    }

    #[test]
    fn singular_and_indefinite_masses_are_told_apart() {
        let mut full = Metric::new(2, false);
        assert_eq!(
            full.factor(&[1.0, 1.0, 1.0, 1.0]),
            Err(MassFault::Singular(1))
        );
        assert_eq!(
            full.factor(&[1.0, 2.0, 2.0, 1.0]),
            Err(MassFault::Indefinite(1))
        );
        // A first coordinate nearly without inertia, tied to the second: rank 2 of 3 whatever the order (the pivots without
        // interchanges lose eight digits here).
        let (a, b) = (1e-8, 1e-4);
        let rows = [[a, b, 1.0], [0.0, a, 0.3]];
        let mut tied = [0.0; 9];
        for i in 0..3 {
            for j in 0..3 {
                tied[3 * j + i] = rows.iter().map(|r| r[i] * r[j]).sum();
            }
        }
        let mut metric = Metric::new(3, false);
        assert!(matches!(metric.factor(&tied), Err(MassFault::Singular(_))));
        let mut diagonal = Metric::new(2, true);
        assert_eq!(
            diagonal.factor(&[1.0, 0.0, 0.0, 0.0]),
            Err(MassFault::Singular(1))
        );
        assert_eq!(
            diagonal.factor(&[-1.0, 0.0, 0.0, 1.0]),
            Err(MassFault::Indefinite(0))
        );
        assert_eq!(diagonal.factor(&[1e-30, 0.0, 0.0, 1e30]), Ok(()));
        let no_rows: [f64; 0] = [];
        assert_eq!(
            full.scale(
                &[0.0, 1.0, 1.0, 1.0],
                Rows::all(&no_rows, 0),
                std::iter::empty(),
                &[1.0; 2]
            ),
            Err(MassFault::Indefinite(0))
        );
    }
}
