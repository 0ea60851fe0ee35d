//! A rank-revealing pseudo-inverse with an explicit tolerance.
//!
//! A matrix C (rows: constraints) is taken apart as Cᵀ P = Q \[R₁₁ R₁₂; 0 R₂₂\] by Householder reflections with column pivoting,
//! so that the rows of C that the others imply come last and can be named. With the rank r decided, \[R₁₁ R₁₂\] = \[T 0\] Zᵀ by
//! reflections from the right. Where R₂₂ = 0 that is the complete orthogonal decomposition, from which
//!
//! C⁺ = Q₁ T⁻ᵀ Z₁ᵀ Pᵀ,  (Cᵀ)⁺ = P Z₁ T⁻¹ Q₁ᵀ.
//!
//! Where it is what drift off the constraints lends to rows that imply each other on them, \[0 R₂₂\] Z = \[E F\] is of its size: Z₂ are the
//! dependences up to its square, F, what C has in them, counts as zero, and reflections from the left take E into T, if that is asked for.
//! Without it R₂₂ counts as zero: C⁺ is that of the rows that were chosen, which are met whatever the others say, as singular positions are
//! passed; and it jumps by the drift where others are chosen.
//!
//! Rows are interchanged too, the largest entry first: with that the reflections are stable row by row, and coordinates of
//! very different mass (rows of M^−½Aᵀ of very different size) keep their digits (Cox & Higham 1998).

use nalgebra::DMatrix;

use crate::scan::{axpy, dot, largest, largest_product, place_of_largest};

/// An earlier column is taken as pivot if its significance is at least this share of the largest: the declared order is kept
/// where it costs nothing, and of two equal constraints the later one is called redundant. One half at most doubles the growth
/// of the columns not yet taken.
const PREFER_EARLIER: f64 = 0.5;

/// Complete orthogonal decomposition of Cᵀ (n × m) in buffers that are allocated once.
#[derive(Debug, Clone)]
pub(crate) struct Decomposition {
    n: usize,
    m: usize,
    /// Cᵀ, then R on and above the diagonal and the reflectors below; n × m, column-major.
    a: Vec<f64>,
    tau: Vec<f64>,
    /// Position → row (coordinate) and column (constraint).
    row: Vec<usize>,
    col: Vec<usize>,
    pivots: Vec<f64>,
    significance: Vec<f64>,
    /// \[T Z\] of the second step; leading dimension `n`.
    t: Vec<f64>,
    zeta: Vec<f64>,
    /// The reflectors that take E into T, in the rows of E, and their factors; leading dimension `n`.
    e: Vec<f64>,
    epsilon: Vec<f64>,
    steps: usize,
    rank: usize,
    /// Whether E is taken in: else the rows of C that were chosen are met, and what the others say beside them is dropped.
    pub(crate) takes_in: bool,
    work_n: Vec<f64>,
    work_m: Vec<f64>,
}

impl Decomposition {
    /// Buffers for matrices C of up to `m` rows and exactly `n` columns.
    #[must_use]
    pub(crate) fn new(m: usize, n: usize) -> Self {
        Decomposition {
            n,
            m,
            a: vec![0.0; n * m],
            tau: vec![0.0; n.min(m)],
            row: (0..n).collect(),
            col: (0..m).collect(),
            pivots: vec![0.0; n.min(m)],
            significance: vec![0.0; m],
            t: vec![0.0; n * m],
            zeta: vec![0.0; n.min(m)],
            e: vec![0.0; n * n.min(m)],
            epsilon: vec![0.0; n.min(m)],
            steps: 0,
            rank: 0,
            takes_in: false,
            work_n: vec![0.0; n],
            work_m: vec![0.0; m],
        }
    }

    /// The buffer for the next matrix, as Cᵀ with `m` columns of length n (row i of C is column i).
    ///
    /// # Panics
    /// If `m` exceeds what [`Decomposition::new`] was given.
    pub(crate) fn load(&mut self, m: usize) -> &mut [f64] {
        assert!(
            self.n * m <= self.a.len(),
            "more rows than there is room for"
        );
        self.m = m;
        &mut self.a[..self.n * m]
    }

    /// Pivoted triangularisation of the loaded matrix.
    ///
    /// The significance of a row c of C is `scale[c]` · maxᵢ `weight[i]` |cᵢ|, taken over what the rows chosen before do not
    /// imply. It decides pivots and rank; the caller chooses `scale` and `weight` so that it is relative to the whole row.
    /// Stops where no significance exceeds `floor`.
    pub(crate) fn factor(&mut self, weight: &[f64], scale: &[f64], floor: f64) {
        let (n, m) = (self.n, self.m);
        self.row.iter_mut().enumerate().for_each(|(i, r)| *r = i);
        self.col.iter_mut().enumerate().for_each(|(c, p)| *p = c);
        self.work_n.copy_from_slice(weight);
        self.work_m[..m].copy_from_slice(&scale[..m]);
        for (c, column) in self.a[..n * m].chunks_exact(n).enumerate() {
            self.significance[c] = scale[c] * largest_product(column, weight);
        }
        self.steps = 0;
        for k in 0..n.min(m) {
            let left = self.significance[k..m].iter();
            let best = left.fold(0.0_f64, |s, x| s.max(*x));
            if best <= floor {
                break;
            }
            let chosen = (k..m)
                .find(|&c| self.significance[c] >= PREFER_EARLIER * best)
                .unwrap_or(k);
            self.pivots[k] = best;
            self.swap_columns(k, chosen);
            self.swap_rows(k);
            self.reflect(k);
            self.steps = k + 1;
        }
        self.set_rank(self.steps);
    }

    /// Moves column `chosen` to place `k`, those between one place on, so that the declared order is kept among them.
    fn swap_columns(&mut self, k: usize, chosen: usize) {
        let n = self.n;
        for c in (k..chosen).rev() {
            self.col.swap(c, c + 1);
            self.significance.swap(c, c + 1);
            self.work_m.swap(c, c + 1);
            let (left, right) = self.a.split_at_mut((c + 1) * n);
            left[c * n..].swap_with_slice(&mut right[..n]);
        }
    }

    /// Brings the largest entry of column k below its diagonal onto the diagonal.
    fn swap_rows(&mut self, k: usize) {
        let (n, m) = (self.n, self.m);
        let top = k + place_of_largest(&self.a[k * n + k..(k + 1) * n]);
        if top != k {
            self.row.swap(k, top);
            self.work_n.swap(k, top);
            for c in 0..m {
                self.a.swap(c * n + k, c * n + top);
            }
        }
    }

    /// Householder reflection of column k, applied to the columns after it; brings their significances up to date, for which
    /// `work_n` and `work_m` hold weights and scales in the present order. Columns that share no row with column k stay as they are.
    fn reflect(&mut self, k: usize) {
        let n = self.n;
        let (left, right) = self.a.split_at_mut((k + 1) * n);
        let x = &mut left[k * n + k..];
        let (beta, tau) = householder(x);
        self.tau[k] = tau;
        let v = &x[1..];
        let right = &mut right[..(self.m - k - 1) * n];
        for (i, column) in right.chunks_exact_mut(n).enumerate() {
            let (head, tail) = column[k..].split_at_mut(1);
            let s = tau * (head[0] + dot(v, tail));
            if s != 0.0 {
                axpy(-s, v, tail);
            }
            if s != 0.0 || head[0] != 0.0 {
                let c = k + 1 + i;
                self.significance[c] =
                    self.work_m[c] * largest_product(tail, &self.work_n[k + 1..]);
            }
            head[0] -= s;
        }
        x[0] = beta;
    }

    /// Significances of the pivots in the order they were taken; all exceed the floor given to [`Decomposition::factor`].
    #[must_use]
    pub(crate) fn pivots(&self) -> &[f64] {
        &self.pivots[..self.steps]
    }

    /// The rank in force.
    #[must_use]
    pub(crate) fn rank(&self) -> usize {
        self.rank
    }

    /// Rows of C in pivot order: the first [`rank`](Self::rank) imply the others.
    #[must_use]
    pub(crate) fn order(&self) -> &[usize] {
        &self.col[..self.m]
    }

    /// Takes the first `rank` pivots as the rank and prepares the pseudo-inverse; `rank` is cut to the number of pivots.
    /// May be called again with another rank.
    pub(crate) fn set_rank(&mut self, rank: usize) {
        let (n, m) = (self.n, self.m);
        let r = rank.min(self.steps);
        self.rank = r;
        for c in 0..m {
            let top = r.min(c + 1);
            self.t[c * n..c * n + top].copy_from_slice(&self.a[c * n..c * n + top]);
        }
        if r == m {
            return;
        }
        for i in (0..r).rev() {
            // Row i of [T Z]: zero its part right of column r against the diagonal.
            self.work_m[0] = self.t[i * n + i];
            for c in r..m {
                self.work_m[c - r + 1] = self.t[c * n + i];
            }
            let (beta, tau) = householder(&mut self.work_m[..m - r + 1]);
            self.zeta[i] = tau;
            self.t[i * n + i] = beta;
            for c in r..m {
                self.t[c * n + i] = self.work_m[c - r + 1];
            }
            for l in 0..i {
                let mut s = self.t[i * n + l];
                for c in r..m {
                    s += self.t[c * n + i] * self.t[c * n + l];
                }
                s *= tau;
                self.t[i * n + l] -= s;
                for c in r..m {
                    self.t[c * n + l] -= s * self.t[c * n + i];
                }
            }
        }
        self.take_in();
    }

    /// Takes E into T, where there is any.
    fn take_in(&mut self) {
        if !self.drifts() {
            return;
        }
        let (n, m, r, steps) = (self.n, self.m, self.rank, self.steps);
        let mut work = std::mem::take(&mut self.work_m);
        for l in r..steps {
            let row = &mut work[..m];
            row.fill(0.0);
            for (c, x) in row.iter_mut().enumerate().skip(l) {
                *x = self.a[c * n + l];
            }
            (0..r).rev().for_each(|i| self.reflect_z(i, row));
            for (i, x) in row[..r].iter().enumerate() {
                self.e[i * n + l] = *x;
            }
        }
        let column = &mut work[..=steps - r];
        for i in 0..r {
            column[0] = self.t[i * n + i];
            column[1..].copy_from_slice(&self.e[i * n + r..i * n + steps]);
            (self.t[i * n + i], self.epsilon[i]) = householder(column);
            let v = &column[1..];
            self.e[i * n + r..i * n + steps].copy_from_slice(v);
            for c in i + 1..r {
                let tail = &mut self.e[c * n + r..c * n + steps];
                let s = self.epsilon[i] * (self.t[c * n + i] + dot(v, tail));
                self.t[c * n + i] -= s;
                axpy(-s, v, tail);
            }
        }
        self.work_m = work;
    }

    /// How many reflections make up Q: those of R₁₁, and where E counts those of its rows, too.
    fn reflections(&self) -> usize {
        if self.drifts() { self.steps } else { self.rank }
    }

    /// Whether there is an E that counts.
    fn drifts(&self) -> bool {
        self.takes_in && (1..self.steps).contains(&self.rank)
    }

    /// Reflection i of those that take E into T on `x` (length n, permuted).
    fn reflect_e(&self, i: usize, x: &mut [f64]) {
        let v = &self.e[i * self.n + self.rank..i * self.n + self.steps];
        let (head, tail) = x[..self.steps].split_at_mut(self.rank);
        let s = self.epsilon[i] * (head[i] + dot(v, tail));
        head[i] -= s;
        axpy(-s, v, tail);
    }

    /// Reflection i of Z on `y` (length m).
    fn reflect_z(&self, i: usize, y: &mut [f64]) {
        let (n, r) = (self.n, self.rank);
        let row = || self.t.iter().skip(r * n + i).step_by(n);
        let (head, tail) = y[..self.m].split_at_mut(r);
        let sum: f64 = row().zip(&*tail).map(|(v, y)| v * y).sum();
        let s = self.zeta[i] * (head[i] + sum);
        head[i] -= s;
        tail.iter_mut().zip(row()).for_each(|(y, v)| *y -= s * v);
    }

    /// Reflection k of Q on `x` (length n, permuted).
    fn reflect_q(&self, k: usize, x: &mut [f64]) {
        let v = &self.a[k * self.n + k + 1..(k + 1) * self.n];
        let s = self.tau[k] * (x[k] + dot(v, &x[k + 1..]));
        x[k] -= s;
        axpy(-s, v, &mut x[k + 1..]);
    }

    /// x = C⁺ β: of all x that minimise |C x − β| the shortest.
    pub(crate) fn solve(&mut self, beta: &[f64], x: &mut [f64]) {
        let (n, m, r) = (self.n, self.m, self.rank);
        let mut y = std::mem::take(&mut self.work_m);
        for c in 0..m {
            y[c] = beta[self.col[c]];
        }
        if r < m {
            (0..r).rev().for_each(|i| self.reflect_z(i, &mut y));
        }
        // Tᵀ y = β₁, forwards.
        for i in 0..r {
            let column = &self.t[i * n..i * n + i + 1];
            y[i] = (y[i] - dot(&column[..i], &y[..i])) / column[i];
        }
        self.rotate(|z| z[..r].copy_from_slice(&y[..r]), x);
        self.work_m = y;
    }

    /// x = Q z, from what `set` makes of a z of zeros.
    fn rotate(&mut self, set: impl FnOnce(&mut [f64]), x: &mut [f64]) {
        let mut z = std::mem::take(&mut self.work_n);
        z.fill(0.0);
        set(&mut z);
        if self.drifts() {
            (0..self.rank).rev().for_each(|i| self.reflect_e(i, &mut z));
        }
        (0..self.reflections())
            .rev()
            .for_each(|k| self.reflect_q(k, &mut z));
        for (z, &i) in z.iter().zip(&self.row) {
            x[i] = *z;
        }
        self.work_n = z;
    }

    /// x = Zᵀ y, from what `set` makes of a y of zeros.
    fn rotate_back(&mut self, set: impl FnOnce(&mut [f64]), x: &mut [f64]) {
        let mut y = std::mem::take(&mut self.work_m);
        y.fill(0.0);
        set(&mut y);
        if self.rank < self.m {
            (0..self.rank).for_each(|i| self.reflect_z(i, &mut y));
        }
        for (y, &c) in y.iter().zip(&self.col[..self.m]) {
            x[c] = *y;
        }
        self.work_m = y;
    }

    /// λ = (Cᵀ)⁺ x: of all λ that minimise |Cᵀ λ − x| the shortest.
    pub(crate) fn solve_transposed(&mut self, x: &[f64], lambda: &mut [f64]) {
        let (n, r) = (self.n, self.rank);
        let mut z = std::mem::take(&mut self.work_n);
        for (z, &i) in z.iter_mut().zip(&self.row) {
            *z = x[i];
        }
        (0..self.reflections()).for_each(|k| self.reflect_q(k, &mut z));
        if self.drifts() {
            (0..r).for_each(|i| self.reflect_e(i, &mut z));
        }
        // T y = Q₁ᵀ x, backwards.
        for i in (0..r).rev() {
            z[i] /= self.t[i * n + i];
            let s = z[i];
            axpy(-s, &self.t[i * n..i * n + i], &mut z[..i]);
        }
        self.rotate_back(|y| y[..r].copy_from_slice(&z[..r]), lambda);
        self.work_n = z;
    }

    /// Writes an orthonormal basis of the null space of C, n − rank columns of length n, into `basis` (column-major).
    pub(crate) fn null_space(&mut self, basis: &mut [f64]) {
        let (n, r) = (self.n, self.rank);
        for (j, column) in basis.chunks_exact_mut(n).take(n - r).enumerate() {
            self.rotate(|z| z[r + j] = 1.0, column);
        }
    }

    /// Writes an orthonormal basis of the null space of Cᵀ (the dependences among the rows of C), m − rank columns of length m.
    pub(crate) fn dependences(&mut self, basis: &mut [f64]) {
        let (m, r) = (self.m, self.rank);
        for (j, column) in basis.chunks_exact_mut(m).take(m - r).enumerate() {
            self.rotate_back(|y| y[r + j] = 1.0, column);
        }
    }
}

/// The reflection I − τ v vᵀ (v₀ = 1) that maps x to β e₀. Overwrites x₁.. with v₁.. and returns (β, τ).
fn householder(x: &mut [f64]) -> (f64, f64) {
    let alpha = x[0];
    let tail = dot(&x[1..], &x[1..]);
    if tail == 0.0 {
        return (alpha, 0.0);
    }
    let norm = (alpha * alpha + tail).sqrt();
    let beta = if alpha > 0.0 { -norm } else { norm };
    let inverse = (alpha - beta).recip();
    x[1..].iter_mut().for_each(|x| *x *= inverse);
    (beta, (beta - alpha) / beta)
}

/// C⁺ and the rank of C. Rows of which no entry exceeds `tolerance` times the largest entry of C, once what the other rows imply
/// is taken off, count as implied. A matrix of zeros, or one that is not finite, has rank 0.
#[must_use]
pub(crate) fn pseudo_inverse(matrix: &DMatrix<f64>, tolerance: f64) -> (DMatrix<f64>, usize) {
    let (m, n) = matrix.shape();
    let mut inverse = DMatrix::zeros(n, m);
    let largest = largest(matrix.as_slice());
    if largest == 0.0 || !matrix.iter().all(|x| x.is_finite()) {
        return (inverse, 0);
    }
    let mut decomposition = Decomposition::new(m, n);
    let columns = decomposition.load(m);
    for (i, column) in columns.chunks_exact_mut(n).enumerate() {
        for (j, x) in column.iter_mut().enumerate() {
            *x = matrix[(i, j)] / largest;
        }
    }
    decomposition.factor(&vec![1.0; n], &vec![1.0; m], tolerance);
    let mut unit = vec![0.0; m];
    for i in 0..m {
        unit[i] = 1.0 / largest;
        decomposition.solve(&unit, inverse.column_mut(i).as_mut_slice());
        unit[i] = 0.0;
    }
    (inverse, decomposition.rank())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::numbers;

    fn penrose(c: &DMatrix<f64>, rank: usize) {
        let (p, r) = pseudo_inverse(c, 1e-11);
        assert_eq!(r, rank, "rank of a {:?} matrix", c.shape());
        let scale = c.amax().max(1e-300);
        assert!((c * &p * c - c).amax() < 1e-11 * scale);
        assert!((&p * c * &p - &p).amax() < 1e-10 * p.amax());
        let (cp, pc) = (c * &p, &p * c);
        assert!((&cp - cp.transpose()).amax() < 1e-11);
        assert!((&pc - pc.transpose()).amax() < 1e-11);
    }

    #[test]
    fn penrose_conditions_for_every_shape_and_rank() {
        let mut next = numbers(1);
        for (m, n) in [(1, 1), (2, 5), (5, 2), (6, 6), (9, 4), (4, 9), (12, 12)] {
            for rank in 1..=m.min(n) {
                let left = DMatrix::from_fn(m, rank, |_, _| next());
                let right = DMatrix::from_fn(rank, n, |_, _| next());
                penrose(&(left * right), rank);
            }
        }
        for scale in [1e-12, 1e12, 1e150, 1e-150] {
            penrose(&(DMatrix::from_fn(4, 6, |_, _| next()) * scale), 4);
        }
    }

    #[test]
    fn zero_and_non_finite_matrices_have_rank_zero() {
        let (p, rank) = pseudo_inverse(&DMatrix::zeros(3, 2), 1e-11);
        assert_eq!((p, rank), (DMatrix::zeros(2, 3), 0));
        let bad = DMatrix::from_row_slice(1, 2, &[f64::NAN, 1.0]);
        assert_eq!(pseudo_inverse(&bad, 1e-11).1, 0);
        assert_eq!(pseudo_inverse(&DMatrix::zeros(0, 3), 1e-11).1, 0);
    }

    #[test]
    fn the_later_of_two_equal_rows_comes_last() {
        let mut d = Decomposition::new(3, 2);
        d.load(3).copy_from_slice(&[1.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
        d.factor(&[1.0; 2], &[1.0; 3], 1e-11);
        assert_eq!((d.rank(), d.order()), (2, &[0, 2, 1][..]));
    }

    #[test]
    fn null_spaces_of_c_and_of_its_transpose() {
        let mut next = numbers(1);
        let left = DMatrix::from_fn(5, 3, |_, _| next());
        let c = left * DMatrix::from_fn(3, 7, |_, _| next());
        let mut d = Decomposition::new(5, 7);
        d.load(5).copy_from_slice(c.transpose().as_slice());
        d.factor(&[1.0; 7], &[1.0; 5], 1e-11);
        let mut basis = DMatrix::zeros(7, 4);
        d.null_space(basis.as_mut_slice());
        assert!((&c * &basis).amax() < 1e-13);
        assert!((basis.transpose() * &basis - DMatrix::identity(4, 4)).amax() < 1e-13);
        let mut dependences = DMatrix::zeros(5, 2);
        d.dependences(dependences.as_mut_slice());
        assert!((c.transpose() * &dependences).amax() < 1e-13);
    }

    #[test]
    fn what_drift_lends_counts_to_its_square_alone() {
        let mut next = numbers(1);
        for (m, n, rank) in [(5, 7, 3), (6, 6, 4), (7, 5, 3), (4, 9, 3), (4, 6, 1)] {
            let left = DMatrix::from_fn(m, rank, |_, _| next());
            let implied = left * DMatrix::from_fn(rank, n, |_, _| next());
            let drift = 1e-5;
            let c = implied + DMatrix::from_fn(m, n, |_, _| drift * next());
            let mut d = Decomposition::new(m, n);
            d.load(m).copy_from_slice(c.transpose().as_slice());
            d.takes_in = true;
            d.factor(&vec![1.0; n], &vec![1.0; m], 1e-11);
            assert_eq!(d.rank(), m.min(n));
            d.set_rank(rank);
            // C⁺ without the singular values that drift lends.
            let mut svd = c.clone().svd(true, true);
            svd.singular_values
                .iter_mut()
                .skip(rank)
                .for_each(|s| *s = 0.0);
            let exact = svd.pseudo_inverse(0.0).expect("both factors");
            let (mut inverse, mut transposed) = (DMatrix::zeros(n, m), DMatrix::zeros(m, n));
            let unit =
                |k: usize, of: usize| -> Vec<f64> { (0..of).map(|i| f64::from(i == k)).collect() };
            for i in 0..m {
                d.solve(&unit(i, m), inverse.column_mut(i).as_mut_slice());
            }
            for j in 0..n {
                d.solve_transposed(&unit(j, n), transposed.column_mut(j).as_mut_slice());
            }
            let bound = 1e3 * drift * drift * exact.amax().powi(3);
            assert!((&inverse - &exact).amax() < bound, "{m} × {n}");
            assert!(
                (&transposed - exact.transpose()).amax() < bound,
                "{m} × {n}"
            );
            let mut basis = DMatrix::zeros(n, n - rank);
            d.null_space(basis.as_mut_slice());
            assert!((&exact * &c * &basis).amax() < bound, "{m} × {n}");
        }
    }

    #[test]
    fn a_lower_rank_can_be_taken_afterwards() {
        let c = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 1.0, 1e-6]);
        let mut d = Decomposition::new(2, 2);
        d.load(2).copy_from_slice(c.transpose().as_slice());
        d.factor(&[1.0; 2], &[1.0; 2], 1e-11);
        assert_eq!(d.rank(), 2);
        let mut x = [0.0; 2];
        d.set_rank(1);
        d.solve(&[1.0, 1.0], &mut x);
        assert!((x[0] - 1.0).abs() < 1e-6 && x[1].abs() < 1e-6);
        d.set_rank(0);
        d.solve(&[1.0, 1.0], &mut x);
        assert_eq!(x, [0.0; 2]);
        d.set_rank(2);
        d.solve(&[1.0, 2.0], &mut x);
        assert!((x[0] - 1.0).abs() < 1e-9 && (x[1] - 1e6).abs() < 1e-3);
    }
}
