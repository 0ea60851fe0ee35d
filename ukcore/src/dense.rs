//! The dense constrained solve in preallocated buffers: the allocation-free equivalents of eqs. 13 and 19.
//!
//! Regular M = L Lᵀ: with B = A L⁻ᵀ and a = M⁻¹ f,  q̈ = a + L⁻ᵀ B⁺ (b − A a).  L and M^½ differ by an orthogonal factor,
//! which cancels in M^½ B⁺.
//!
//! Singular M, coordinates scaled to x = L q̈ by a diagonal L, Ĉ = A L⁻¹, M̂ = L⁻¹ M L⁻¹: eq. 19 asks for Ĉ x = b and for
//! (I − Ĉ⁺Ĉ)(M̂ x − L⁻¹ f) = 0. With an orthonormal basis N of the null space of Ĉ,
//! x = Ĉ⁺ b + N z,  (Nᵀ M̂ N) z = Nᵀ (L⁻¹ f − M̂ Ĉ⁺ b).
//!
//! Each row of B (or Ĉ) is divided by its norm first. For consistent constraints that changes neither the set of q̈ with A q̈ = b
//! nor, hence, the one of least norm in it, and rank decisions become independent of how a constraint is scaled.

use crate::measure::Measure;
use crate::mechanism::Evaluated;
pub(crate) use crate::metric::Rows;
use crate::metric::{MassFault, Metric, divide, divide_transposed, pivoted_cholesky};
use crate::pinv::Decomposition;
use crate::scan::{axpy, dot, largest, or_one, place_of_largest};
use crate::spec::Spec;

/// A pivot of Nᵀ M̂ N (M̂ has unit diagonal where there is mass) counts as zero below this multiple of n ε: errors of the basis
/// N and of the product are a few n ε.
const INERTIA_ROUNDING: f64 = 64.0;

/// What is left of q̈ where it is not refined any more: the ratio of masses of any use is far above.
const MOST_LEFT: f64 = 1e-60;

impl Evaluated {
    /// All rows of A.
    pub(crate) fn rows(&self) -> Rows<'_> {
        Rows::all(&self.jacobian, self.rhs.len())
    }
}

/// How to treat M.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Route {
    /// Factor it.
    Regular,
    /// Null-space form.
    Singular,
}

/// The constrained solve.
#[derive(Debug, Clone)]
pub(crate) struct Dense {
    n: usize,
    /// Rows that make M regular, those of quaternions apart: [`Solve::regular`](crate::spec::Solve::regular) and
    /// [`Solve::turned`](crate::spec::Solve::turned).
    regular: [&'static [usize]; 2],
    pub(crate) metric: Metric,
    pub(crate) measure: Measure,
    /// What the entries of columns of B are multiplied by for those of A, measured.
    weights: Vec<f64>,
    pub(crate) cod: Decomposition,
    /// sᵢ = 1/‖row i of B‖, 0 for a row of zeros.
    pub(crate) row_scale: Vec<f64>,
    /// What the largest entry of each row of A, measured, is divided by; by itself, or what the measure says, where this is 0.
    pub(crate) sizes: Vec<f64>,
    significance: Vec<f64>,
    /// N, n × (n − rank).
    basis: Vec<f64>,
    /// Pivoted Cholesky factor of Nᵀ M̂ N, and its order.
    inertia: Vec<f64>,
    inertia_order: Vec<usize>,
    inertia_rank: usize,
    scaled_rhs: Vec<f64>,
    /// The part of x = Lᵀ q̈ that the constraints contribute (regular M), after [`Dense::solve`].
    pub(crate) reaction: Vec<f64>,
    /// M⁻¹ f, what the constraints' part is added to (regular M; 0 on the singular route), after [`Dense::solve`]: where the two
    /// cancel, rounding of q̈ is that of these, not that of q̈.
    pub(crate) unconstrained: Vec<f64>,
    work: Vec<f64>,
    reduced: Vec<f64>,
    dependences: Vec<f64>,
    left: Vec<f64>,
}

impl Dense {
    /// Buffers for the mechanisms of a type.
    pub(crate) fn new(spec: &Spec) -> Self {
        let (n, m) = (spec.n(), spec.m());
        Dense {
            n,
            regular: [spec.structure.solve.regular, spec.structure.solve.turned],
            metric: Metric::new(n, spec.structure.mass_diagonal),
            measure: Measure::new(spec),
            weights: vec![1.0; n],
            cod: Decomposition::new(m, n),
            row_scale: vec![0.0; m],
            sizes: vec![0.0; m],
            significance: vec![0.0; m],
            basis: vec![0.0; n * n],
            inertia: vec![0.0; n * n],
            inertia_order: (0..n).collect(),
            inertia_rank: 0,
            scaled_rhs: vec![0.0; m],
            reaction: vec![0.0; n],
            unconstrained: vec![0.0; n],
            work: vec![0.0; n],
            reduced: vec![0.0; n],
            dependences: vec![0.0; m * m],
            left: vec![0.0; m],
        }
    }

    /// Buffers for accelerations off the constraints: what drift lends to rows that imply each other on them is taken in, so that
    /// accelerations go on smoothly whichever rows are chosen.
    pub(crate) fn taking_in(spec: &Spec) -> Self {
        let mut dense = Dense::new(spec);
        dense.cod.takes_in = true;
        dense
    }

    /// Factors M and A, keeping every pivot above `floor`. The rank is then [`Decomposition::rank`] of `cod`; to change it, call
    /// [`Dense::set_rank`], which must be called in any case on the singular route.
    ///
    /// The significance of a row of A is its largest entry, [measured](Measure), as a share of what that was before the parts implied by
    /// other rows were taken off: it depends neither on units nor on the scaling of constraints, nor on that of masses. The measure is that
    /// of the state where it was taken last.
    pub(crate) fn factor(
        &mut self,
        route: Route,
        mass: &[f64],
        a: Rows<'_>,
        floor: f64,
    ) -> Result<(), MassFault> {
        match route {
            Route::Regular => self.metric.factor(mass)?,
            Route::Singular => {
                let regular = self.regular.iter().copied().flatten().copied();
                self.metric.scale(mass, a, regular, &self.measure.scale)?;
            }
        }
        let columns = self.cod.load(a.rows);
        for (c, column) in columns.chunks_exact_mut(self.n).enumerate() {
            column.iter_mut().zip(a.row(c)).for_each(|(x, a)| *x = a);
            self.metric.divide(column);
            let known = Some(self.sizes[c]).filter(|size| *size > 0.0);
            let own = a.largest(c, &self.measure.scale);
            let size = known.or_else(|| self.measure.size_of_vanishing(c, own));
            if let Some(size) = size {
                column.iter_mut().for_each(|x| *x /= size);
                (self.row_scale[c], self.significance[c]) = (size.recip(), 1.0);
                continue;
            }
            (self.row_scale[c], self.significance[c]) = match normalise(column) {
                0.0 => (0.0, 0.0),
                norm => (norm.recip(), norm / own),
            };
        }
        let pairs = self.metric.root.iter().zip(&self.measure.scale);
        let weights = self.weights.iter_mut().zip(pairs);
        weights.for_each(|(weight, (root, scale))| *weight = root * scale);
        self.cod
            .factor(&self.weights, &self.significance[..a.rows], floor);
        Ok(())
    }

    /// Factors M and A by the route that M needs, which has no inertia in some coordinates if it is `massless`.
    pub(crate) fn factor_as_needed(
        &mut self,
        massless: bool,
        mass: &[f64],
        a: Rows<'_>,
        floor: f64,
    ) -> Result<(), MassFault> {
        if !massless {
            match self.factor(Route::Regular, mass, a, floor) {
                Err(MassFault::Singular(_)) => {}
                factored => return factored,
            }
        }
        self.factor(Route::Singular, mass, a, floor)
    }

    /// Takes the first `rank` pivots as the rank. On the singular route Nᵀ M̂ N is factored; `Indefinite` names a coordinate if
    /// it has a negative eigenvalue.
    pub(crate) fn set_rank(&mut self, rank: usize, mass: &[f64]) -> Result<(), MassFault> {
        if rank != self.cod.rank() {
            self.cod.set_rank(rank);
        }
        if self.metric.regular() {
            return Ok(());
        }
        self.reduce(mass)
    }

    /// Pivoted Cholesky factorisation of Nᵀ M̂ N.
    fn reduce(&mut self, mass: &[f64]) -> Result<(), MassFault> {
        let n = self.n;
        let d = n - self.cod.rank();
        self.cod.null_space(&mut self.basis[..n * d]);
        for j in 0..d {
            let column = &self.basis[j * n..(j + 1) * n];
            weigh(mass, &self.metric, column, &mut self.work);
            for i in 0..=j {
                let entry = dot(&self.basis[i * n..(i + 1) * n], &self.work);
                self.inertia[j * d + i] = entry;
                self.inertia[i * d + j] = entry;
            }
        }
        let floor = INERTIA_ROUNDING * n as f64 * f64::EPSILON;
        let order = &mut self.inertia_order[..d];
        let rank = pivoted_cholesky(&mut self.inertia, order, floor);
        self.inertia_rank = rank.map_err(|lowest| {
            let column = &self.basis[order[lowest] * n..(order[lowest] + 1) * n];
            MassFault::Indefinite(place_of_largest(column))
        })?;
        Ok(())
    }

    /// rank [M | Aᵀ].
    pub(crate) fn determined(&self) -> usize {
        if self.metric.regular() {
            self.n
        } else {
            self.cod.rank() + self.inertia_rank
        }
    }

    /// Shares of the coordinates in the directions that neither mass nor constraint determines (0 … 1, scaled coordinates).
    /// Allocates.
    pub(crate) fn undetermined(&self) -> Vec<f64> {
        let (n, k) = (self.n, self.inertia_rank);
        let d = n - self.cod.rank();
        let mut share = vec![0.0_f64; n];
        for j in k..d {
            // Null vector: 1 at j, and L₁₁ᵀ y = −(row j of L) above.
            let mut y: Vec<f64> = (0..k).map(|i| -self.inertia[i * d + j]).collect();
            divide_transposed(&self.inertia, d, &mut y);
            y.push(1.0);
            let mut direction = vec![0.0; n];
            let order = self.inertia_order[..k].iter();
            for (y, o) in y.iter().zip(order.chain([&self.inertia_order[j]])) {
                axpy(*y, &self.basis[o * n..(o + 1) * n], &mut direction);
            }
            let largest = largest(&direction);
            for (s, x) in share.iter_mut().zip(&direction) {
                *s = s.max(x.abs() / largest);
            }
        }
        share
    }

    /// The shortest Δ (in the metric, or in scaled coordinates if M is singular) with A Δ = `rhs`, into `out`.
    pub(crate) fn least_norm(&mut self, rhs: &[f64], out: &mut [f64]) {
        self.least_scaled(rhs, out);
        self.metric.divide_transposed(out);
    }

    /// The Δ with A Δ = `rhs` that is shortest in scaled coordinates, in these coordinates, into `out`.
    pub(crate) fn least_scaled(&mut self, rhs: &[f64], out: &mut [f64]) {
        let scaled = self.scaled_rhs.iter_mut().zip(&self.row_scale).zip(rhs);
        scaled.for_each(|((x, s), b)| *x = s * b);
        self.cod.solve(&self.scaled_rhs, out);
    }

    /// q̈ with M q̈ = f + Aᵀλ and A q̈ = b into `out`. Directions without inertia stay at rest: see [`Dense::determined`].
    pub(crate) fn solve(
        &mut self,
        mass: &[f64],
        a: Rows<'_>,
        force: Option<&[f64]>,
        rhs: &[f64],
        out: &mut [f64],
    ) {
        if self.metric.regular() {
            self.solve_regular(a, force, rhs, out);
        } else {
            self.solve_singular(mass, force, rhs, out);
            self.refine(a, rhs, out);
        }
    }

    fn solve_regular(&mut self, a: Rows<'_>, force: Option<&[f64]>, rhs: &[f64], out: &mut [f64]) {
        match force {
            Some(force) => {
                out.copy_from_slice(force);
                self.metric.divide(out);
                self.metric.divide_transposed(out);
            }
            None => out.fill(0.0),
        }
        self.unconstrained.copy_from_slice(out);
        self.refine(a, rhs, out);
        self.reaction.copy_from_slice(&self.reduced);
        self.refine(a, rhs, out);
        axpy(1.0, &self.reduced, &mut self.reaction);
        // Each gains as many digits as numbers have; light coordinates may need more, tied to heavy ones.
        let mut left = f64::EPSILON;
        while left > MOST_LEFT && self.is_lost(a, rhs, left, out) {
            self.refine(a, rhs, out);
            axpy(1.0, &self.reduced, &mut self.reaction);
            left *= f64::EPSILON;
        }
    }

    /// Whether `left` of the forces' part of a row of A q̈ is more than all that q̈ has there.
    fn is_lost(&self, a: Rows<'_>, rhs: &[f64], left: f64, out: &[f64]) -> bool {
        let rows = rhs[..a.rows].iter().enumerate();
        let mut sizes = rows.map(|(c, b)| {
            let size = b.abs() + a.magnitude(c, out);
            (a.magnitude(c, &self.unconstrained), size)
        });
        sizes.any(|(free, size)| left * free > size)
    }

    /// Takes the residual b − A q̈ off q̈, once for the constraints and once for rounding: where rows nearly imply each other, and the
    /// constraints cancel most of what the forces do, the error is that of the forces' part divided by the significance; what a second
    /// solve leaves is that of q̈ itself. The change of the scaled accelerations is then in `reduced`.
    fn refine(&mut self, a: Rows<'_>, rhs: &[f64], out: &mut [f64]) {
        for (c, b) in rhs[..a.rows].iter().enumerate() {
            self.scaled_rhs[c] = self.row_scale[c] * (b - a.product(c, out));
        }
        self.cod.solve(&self.scaled_rhs, &mut self.reduced);
        self.work.copy_from_slice(&self.reduced);
        self.metric.divide_transposed(&mut self.work);
        axpy(1.0, &self.work, out);
    }

    fn solve_singular(
        &mut self,
        mass: &[f64],
        force: Option<&[f64]>,
        rhs: &[f64],
        out: &mut [f64],
    ) {
        let (n, k) = (self.n, self.inertia_rank);
        let d = n - self.cod.rank();
        self.unconstrained.fill(0.0);
        self.least_scaled(rhs, out);
        // L⁻¹ f − M̂ Ĉ⁺ b.
        weigh(mass, &self.metric, out, &mut self.work);
        match force {
            Some(f) => {
                let scaled = f.iter().zip(&self.metric.root).map(|(f, root)| f / root);
                let pairs = self.work.iter_mut().zip(scaled);
                pairs.for_each(|(x, f)| *x = f - *x);
            }
            None => self.work.iter_mut().for_each(|x| *x = -*x),
        }
        let z = &mut self.reduced[..k];
        for (z, &o) in z.iter_mut().zip(&self.inertia_order) {
            *z = dot(&self.basis[o * n..(o + 1) * n], &self.work);
        }
        divide(&self.inertia, d, z);
        divide_transposed(&self.inertia, d, z);
        for (z, &o) in z.iter().zip(&self.inertia_order) {
            axpy(*z, &self.basis[o * n..(o + 1) * n], out);
        }
        self.metric.divide(out);
    }

    /// The share of each of these rows that those of A do not combine to, in the metric of the solve; NaN of zeros. They are overwritten.
    pub(crate) fn left_of(&mut self, rows: &mut [Vec<f64>]) -> Vec<f64> {
        let n = self.n;
        let basis = &mut self.basis[..n * (n - self.cod.rank())];
        self.cod.null_space(basis);
        let left = rows.iter_mut().map(|row| {
            self.metric.divide(row);
            let parts = basis.chunks_exact(n).map(|along| dot(along, row));
            let left: f64 = parts.map(|part| part * part).sum();
            (left / dot(row, row)).sqrt()
        });
        left.collect()
    }

    /// What the solve may leave of `errors` of the right-hand sides: it meets rows that imply each other as well as it can together, so of
    /// errors that contradict each other it leaves to each row its share in the dependence, however small its own is.
    pub(crate) fn share(&mut self, errors: &mut [f64]) {
        let rows = errors.len();
        let dependences = &mut self.dependences[..rows * (rows - self.cod.rank())];
        self.cod.dependences(dependences);
        // In rows scaled as they are solved; one of zeros has no scale.
        let scaled = errors.iter_mut().zip(&self.row_scale);
        scaled.for_each(|(error, scale)| *error *= or_one(*scale));
        self.left.fill(0.0);
        for shares in dependences.chunks_exact(rows) {
            let terms = shares.iter().zip(&*errors);
            let error: f64 = terms.map(|(share, error)| share.abs() * error).sum();
            let left = self.left.iter_mut().zip(shares);
            left.for_each(|(left, share)| *left += share.abs() * error);
        }
        for ((error, left), scale) in errors.iter_mut().zip(&self.left).zip(&self.row_scale) {
            *error = error.max(*left) / or_one(*scale);
        }
    }

    /// λ of least norm (after undoing the row scaling) with Aᵀλ = f for an f in the range of Aᵀ; `f` is overwritten. Allocates
    /// if constraints are redundant.
    pub(crate) fn multipliers(&mut self, f: &mut [f64], lambda: &mut [f64]) {
        self.metric.divide(f);
        self.cod.solve_transposed(f, lambda);
        let pairs = lambda.iter_mut().zip(&self.row_scale);
        pairs.for_each(|(l, s)| *l *= s);
        let m = lambda.len();
        let excess = m - self.cod.rank();
        if excess == 0 {
            return;
        }
        // λ is determined up to the dependences of the rows; take their part off (Gram-Schmidt, twice for rounding).
        let mut basis = vec![0.0; m * excess];
        self.cod.dependences(&mut basis);
        for column in basis.chunks_exact_mut(m) {
            for (x, s) in column.iter_mut().zip(&self.row_scale) {
                // A row of zeros has no scale and takes part in no force.
                *x *= or_one(*s);
            }
        }
        for j in 0..excess {
            let (done, rest) = basis.split_at_mut(j * m);
            let column = &mut rest[..m];
            normalise(column);
            for _ in 0..2 {
                for other in done.chunks_exact(m) {
                    axpy(-dot(other, column), other, column);
                }
            }
            normalise(column);
        }
        for _ in 0..2 {
            for column in basis.chunks_exact(m) {
                axpy(-dot(column, lambda), column, lambda);
            }
        }
    }
}

/// Divides x by its norm, which it returns, unless that is 0; in two steps, so that numbers of any magnitude have one.
fn normalise(x: &mut [f64]) -> f64 {
    let largest = largest(x);
    if largest == 0.0 {
        return 0.0;
    }
    x.iter_mut().for_each(|x| *x /= largest);
    let norm = dot(x, x).sqrt();
    x.iter_mut().for_each(|x| *x /= norm);
    largest * norm
}

/// y = M̂ x = L⁻¹ M L⁻¹ x for a diagonal L.
fn weigh(mass: &[f64], metric: &Metric, x: &[f64], y: &mut [f64]) {
    y.fill(0.0);
    for (j, column) in mass.chunks_exact(x.len()).enumerate() {
        let s = x[j] / metric.root[j];
        if s != 0.0 {
            axpy(s, column, y);
        }
    }
    metric.divide(y);
}
