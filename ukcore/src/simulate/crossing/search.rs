//! The search for a singular position q* near a state, by Newton's method on f, and what e is there.
//!
//! Constraints on velocities are derivatives of no f; for these see [`rates`].

mod rates;

use crate::assemble::State;
use crate::dense::Dense;
use crate::integrate::Singular;
use crate::mechanism::{Evaluated, Prepared};
use crate::noise::Noise;
use crate::pinv::Decomposition;
use crate::scan::{axpy, dot, largest};
use crate::simulate::vanishing::Vanishing;
use crate::solver::RANK_TOLERANCE;

/// Roundings of f up to which e counts as zero, and above which it does not.
const ZERO: f64 = 8.0;
const GAP: f64 = 1e3;

/// Newton steps at most.
const MOST: usize = 20;

/// A Newton step longer than the first one by this factor leads elsewhere.
const WIDEST: f64 = 2.0;

/// The share of the way from one position to another from where the other one is looked for.
const BEFORE: f64 = 0.9;

/// The share to which second derivatives of f are known where the search has come to.
const BENT: f64 = 1e-6;

/// A search for singular positions near a state, in buffers that are allocated where the first one is near.
pub(super) struct Search<'a> {
    pub(super) mech: &'a Prepared,
    noise: Noise,
    pub(super) dense: Dense,
    pub(super) terms: Evaluated,
    /// The number of rows that count.
    pub(super) rank: usize,
    /// Length of the first step, in time as the directions are.
    reach: f64,
    t: f64,
    q: Vec<f64>,
    /// The time in which the motion goes as far as coordinates are large: they are known to ε of that.
    pub(super) scale: f64,
    /// How many times as far as q* a row that vanishes there gets as large as it has been: coordinates are, or have been, as large as that.
    pub(super) ways: f64,
    /// u and W, in units of coordinates by time; time goes on along u alone.
    directions: Vec<Vec<f64>>,
    /// Multipliers of the rows that make up f, one column for each that is left out.
    shares: Vec<Vec<f64>>,
}

impl<'a> Search<'a> {
    pub(super) fn new(mech: &'a Prepared, near: &State) -> Self {
        let spec = mech.spec();
        let (n, m) = (spec.n(), spec.m());
        let mut dense = Dense::new(spec);
        dense.measure.look_ahead();
        Search {
            mech,
            noise: Noise::new(mech),
            dense,
            terms: Evaluated::new(n, m),
            rank: m,
            reach: 0.0,
            t: near.t,
            q: near.q.clone(),
            scale: 0.0,
            ways: 0.0,
            directions: Vec::new(),
            shares: Vec::new(),
        }
    }

    /// One that stands at `near`, the equations factored there; rows that are known to vanish are compared with what they have been.
    pub(super) fn at(
        mech: &'a Prepared,
        near: &State,
        vanishing: Option<&Vanishing>,
    ) -> Option<Self> {
        let mut search = Search::new(mech, near);
        if let Some(Vanishing { sizes, scale, .. }) = vanishing {
            search.dense.sizes.clone_from(sizes);
            search.dense.measure.keep(scale);
        }
        search.factor(&near.v)?;
        Some(search)
    }

    /// Goes to where a motion that is `near` is at a time, by its velocity.
    pub(super) fn set_out(&mut self, near: &State, t: f64) {
        (self.t, self.q, self.reach) = (t, near.q.clone(), 0.0);
        axpy(t - near.t, &near.v, &mut self.q);
    }

    /// Evaluates and factors the equations where the search stands, and takes the rank.
    pub(super) fn factor(&mut self, v: &[f64]) -> Option<()> {
        self.terms.dynamics(self.mech, self.t, &self.q, v);
        let massless = !self.mech.spec().structure.massless.is_empty();
        let Evaluated { mass, jacobian, .. } = &self.terms;
        let measure = &mut self.dense.measure;
        measure.take(self.mech, self.t, [&self.q, v], jacobian, mass);
        let factored =
            (self.dense).factor_as_needed(massless, mass, self.terms.rows(), RANK_TOLERANCE);
        factored.ok()?;
        let rank = self.rank.min(self.dense.cod.pivots().len());
        self.dense.set_rank(rank, &self.terms.mass).ok()
    }

    /// φ, zero for constraints that have none.
    fn position(&self) -> Vec<f64> {
        let mut phi = vec![0.0; self.mech.spec().m()];
        let holonomic = self.mech.spec().holonomic;
        self.mech.residual(self.t, &self.q, &mut phi[..holonomic]);
        phi
    }

    /// Moves onto the constraints that count, and factors the equations there.
    fn settle(&mut self, v: &[f64]) -> Option<()> {
        self.factor(v)?;
        let mut change = vec![0.0; self.q.len()];
        let phi = self.position();
        self.dense.least_norm(&phi, &mut change);
        axpy(-1.0, &change, &mut self.q);
        self.factor(v)
    }

    /// The part of `v` that the constraints that count allow.
    fn allowed(&mut self, v: &[f64]) -> Vec<f64> {
        let (mut rate, mut change) = (vec![0.0; self.mech.spec().m()], vec![0.0; v.len()]);
        let mut v = v.to_vec();
        (self.mech).residual_rate(self.t, &self.q, &v, &mut rate);
        self.dense.least_norm(&rate, &mut change);
        axpy(-1.0, &change, &mut v);
        v
    }

    /// The multipliers of f.
    fn share(&mut self) {
        let m = self.mech.spec().m();
        let rank = self.dense.cod.rank();
        let mut basis = vec![0.0; m * (m - rank)];
        self.dense.cod.dependences(&mut basis);
        let scaled = |shares: &[f64]| {
            let pairs = shares.iter().zip(&self.dense.row_scale);
            pairs.map(|(share, scale)| share * scale).collect()
        };
        self.shares = basis.chunks_exact(m).map(scaled).collect();
    }

    /// `count` directions that the rows left out bar, as fast as `speed`.
    fn bar(&mut self, count: usize, speed: f64) -> Option<()> {
        let mut barred: Vec<Vec<f64>> = Vec::new();
        for shares in &self.shares {
            let columns = self.terms.jacobian.chunks_exact(shares.len());
            let mut x: Vec<f64> = columns.map(|column| dot(column, shares)).collect();
            self.dense.metric.divide(&mut x);
            barred.push(x);
        }
        for _ in 0..count {
            let norm = |x: &Vec<f64>| dot(x, x).sqrt();
            let longest =
                (0..barred.len()).max_by(|i, j| norm(&barred[*i]).total_cmp(&norm(&barred[*j])))?;
            let mut x = barred.swap_remove(longest);
            let length = norm(&x);
            if length == 0.0 || !length.is_finite() {
                return None;
            }
            x.iter_mut().for_each(|x| *x /= length);
            for other in &mut barred {
                axpy(-dot(&x, other), &x, other);
            }
            self.dense.metric.divide_transposed(&mut x);
            x.iter_mut().for_each(|x| *x *= speed);
            self.directions.push(x);
        }
        Some(())
    }

    /// Whether branches cross, too, where the row goes singular that has least left beside those of the position just found, at a time `t`
    /// with so many rows, as what it has left tells there and near by: a step over the one may go over the other.
    pub(super) fn other_is_met(
        &mut self,
        near: &State,
        (t, rank): (f64, usize),
        pivots: &[f64],
    ) -> bool {
        let Some(there) = self.dense.cod.pivots().get(rank - 1).copied() else {
            return false;
        };
        let left = there * (t - near.t) / (pivots[rank - 1] - there);
        if !left.is_finite() {
            return false;
        }
        // There the first one has more left.
        self.set_out(near, t + BEFORE * left);
        let found = self.critical(&near.v, 1);
        found.is_some_and(|found| {
            found.gap == 0.0 && (found.t - t - left).abs() < (left * 0.5).abs()
        })
    }

    /// Searches q* with as many barred directions as `count`, for a motion with velocity `v`.
    pub(super) fn critical(&mut self, v: &[f64], count: usize) -> Option<Singular> {
        self.settle(v)?;
        let u = self.allowed(v);
        let columns = u.iter().zip(self.terms.mass.chunks_exact(u.len()));
        let energy = columns.map(|(v, column)| v * dot(column, &u)).sum::<f64>();
        let speed = energy.sqrt();
        if !(speed > 0.0 && speed < f64::INFINITY) {
            return None;
        }
        let measure = &self.dense.measure;
        self.scale = measure.size(&self.q) / measure.size(&u);
        self.share();
        if let Some(found) = self.rates(&u, count) {
            return found;
        }
        self.directions = vec![u];
        self.bar(count, speed)?;
        for _ in 0..MOST {
            if let Some(found) = self.newton()? {
                return Some(found);
            }
        }
        None
    }

    /// One step towards q*; what is found there if it is the last one. `None` if there is none.
    fn newton(&mut self) -> Option<Option<Singular>> {
        let u = self.directions[0].clone();
        self.settle(&u)?;
        self.share();
        let phi = self.position();
        let mut rounding = vec![0.0; phi.len()];
        (self.noise).go(self.mech, self.t, [&self.q, &u], |_| [0.0; 2]);
        self.noise.residual(&mut rounding);
        let system = self.system(&u)?;
        let step = system.step()?;
        let size = dot(&step, &step).sqrt();
        if self.reach == 0.0 {
            self.reach = size;
            self.scale = self.scale.max(self.ways * size);
        }
        if size.is_nan() || size > WIDEST * self.reach {
            return None;
        }
        self.t += step[0];
        for (direction, part) in self.directions.iter().zip(&step) {
            axpy(*part, direction, &mut self.q);
        }
        self.verdict(&system, &step, [&phi, &rounding])
    }

    /// The equations of a Newton step: slopes and second derivatives of f, for each of its components.
    fn system(&mut self, u: &[f64]) -> Option<System> {
        let (k, m) = (self.directions.len(), self.mech.spec().m());
        let mut rate = vec![0.0; m];
        self.mech.residual_rate(self.t, &self.q, u, &mut rate);
        let a = self.terms.rows();
        let mut slopes = vec![rate];
        for w in &self.directions[1..] {
            slopes.push((0..m).map(|c| a.product(c, w)).collect());
        }
        let curvatures = self.curvatures();
        let equations = self.shares.len() * k;
        let mut right = Vec::with_capacity(equations);
        let mut matrix = Vec::with_capacity(equations * k);
        for shares in &self.shares {
            for (row, slope) in slopes.iter().enumerate() {
                right.push(-dot(shares, slope));
                let seconds = &curvatures[row * k..(row + 1) * k];
                matrix.extend(seconds.iter().map(|second| dot(shares, second)));
            }
        }
        // One component alone is not compared with others.
        let blur = match self.shares.len() {
            1 => vec![0.0; k],
            _ => {
                let roundings = self.rate_roundings();
                let each = self
                    .shares
                    .iter()
                    .flat_map(|shares| roundings.iter().map(move |r| (shares, r)));
                each.map(|(shares, rounding)| rounded(shares, rounding))
                    .collect()
            }
        };
        let largest = largest(&matrix);
        (largest > 0.0 && largest < f64::INFINITY).then_some(System {
            right,
            matrix,
            blur,
            largest,
        })
    }

    /// The rounding of what all rows say of each direction, in units of ε.
    fn rate_roundings(&mut self) -> Vec<Vec<f64>> {
        let (m, directions) = (self.mech.spec().m(), self.directions.iter());
        let roundings = directions.map(|direction| {
            let mut rounding = vec![0.0; m];
            (self.noise).go(self.mech, self.t, [&self.q, direction], |_| [0.0; 2]);
            self.noise.residual_rate(&mut rounding);
            rounding
        });
        roundings.collect()
    }

    /// What is found where a step of a system with these residuals has led to, if it is the last one; `None` if there is nothing.
    fn verdict(
        &mut self,
        system: &System,
        step: &[f64],
        [phi, rounding]: [&[f64]; 2],
    ) -> Option<Option<Singular>> {
        let (k, largest, size) = (step.len(), system.largest, dot(step, step).sqrt());
        let left = system.left(step);
        let parts = system.right.chunks_exact(k);
        let parts = parts.zip(system.matrix.chunks_exact(k * k));
        let parts = parts.zip(system.blur.chunks_exact(k));
        let (mut last, mut agree, mut doubt, mut open) = (true, true, false, 0.0_f64);
        for (shares, ((right, matrix), blur)) in self.shares.iter().zip(parts) {
            // One alone is critical where the search has come to.
            let [differs, blurred] = match self.shares.len() {
                1 => [0.0; 2],
                _ => least(matrix, [right, blur], largest),
            };
            let e = dot(shares, phi) + differs;
            let noise = rounded(shares, rounding) + largest * (f64::EPSILON * self.scale).powi(2);
            last &= largest * size * size <= noise;
            agree &= left <= 1e-5 * largest * self.reach + (largest * noise).sqrt();
            let noise = noise + blurred;
            if e.abs() > ZERO * noise {
                open = open.max(e.abs());
                doubt |= e.abs() <= GAP * noise;
            }
        }
        if !last {
            return Some(None);
        }
        if !agree {
            return None;
        }
        let isolated = !doubt && open == 0.0 && self.is_isolated();
        let gap = match doubt || isolated {
            true => f64::NAN,
            false => (2.0 * open / largest).sqrt(),
        };
        Some(Some(Singular {
            isolated,
            ..self.met(gap)
        }))
    }

    /// The position where the search has come to, with this gap.
    fn met(&self, gap: f64) -> Singular {
        let cod = &self.dense.cod;
        Singular {
            t: self.t,
            gap,
            isolated: false,
            significance: 0.0,
            rate: 0.0,
            rounding: 1.0,
            constraints: (self.mech.spec()).constraint_names(&cod.order()[cod.rank()..]),
        }
    }

    /// Whether motions beside this one do not come to such a position, as beside the apex of a cone: whether f bends in directions other
    /// than those of u and W, and their second derivatives do not depend on these. Then the nearest motions on both sides of this one go
    /// different ways.
    fn is_isolated(&mut self) -> bool {
        let (n, rank, k) = (self.q.len(), self.dense.cod.rank(), self.directions.len());
        if n - rank <= k {
            return false;
        }
        // They are those of where the search began, and what they have of others than the constraints allow here would count as bent.
        let moving = self.directions.clone();
        let u = self.allowed(&moving[0]);
        let mut directions = vec![u.clone()];
        for other in &moving[1..] {
            let mut both = moving[0].clone();
            axpy(1.0, other, &mut both);
            let mut other = self.allowed(&both);
            axpy(-1.0, &u, &mut other);
            directions.push(other);
        }
        let mut basis = vec![0.0; n * (n - rank)];
        self.dense.cod.null_space(&mut basis);
        // A direction like no other, as fast as the motion.
        let mut other = vec![0.0; n];
        let mut part = 1.0;
        for column in basis.chunks_exact(n) {
            axpy(part, column, &mut other);
            part = if part > 1.0 { part - 0.7 } else { part + 0.6 };
        }
        self.dense.metric.divide_transposed(&mut other);
        let measure = &self.dense.measure;
        let speed = measure.size(&self.directions[0]) / measure.size(&other);
        other.iter_mut().for_each(|x| *x *= speed);
        directions.push(other);
        let vectors = basis.chunks_exact(n).map(|column| {
            let mut x: Vec<f64> = column.iter().map(|x| speed * x).collect();
            self.dense.metric.divide_transposed(&mut x);
            x
        });
        let vectors: Vec<Vec<f64>> = vectors.collect();
        let bends = self.bends(&directions, &vectors);
        let mut rounding = vec![0.0; self.mech.spec().m()];
        let mut v = directions[0].clone();
        directions[1..]
            .iter()
            .chain(&vectors)
            .for_each(|x| axpy(1.0, x, &mut v));
        (self.noise).go(self.mech, self.t, [&self.q, &v], |_| [0.0; 2]);
        self.noise.motion(&vec![0.0; n], &mut rounding);
        self.shares.iter().any(|shares| {
            let mut known: Vec<Vec<f64>> = Vec::new();
            let (mut size, mut left) = (rounded(shares, &rounding) / BENT, 0.0);
            for bend in &bends {
                let mut bend: Vec<f64> = bend.iter().map(|b| dot(b, shares)).collect();
                size = size.max(dot(&bend, &bend).sqrt());
                reject(&mut bend, &known);
                left = dot(&bend, &bend).sqrt();
                if left > BENT * size {
                    bend.iter_mut().for_each(|x| *x /= left);
                    known.push(bend);
                }
            }
            left > BENT * size
        })
    }

    /// Four times the second derivatives of all residuals by each of these directions, the first of which is that of the motion and the
    /// time, and each of these vectors.
    fn bends(&mut self, directions: &[Vec<f64>], vectors: &[Vec<f64>]) -> Vec<Vec<Vec<f64>>> {
        let mut bends: Vec<Vec<Vec<f64>>> = Vec::new();
        for (i, direction) in directions.iter().enumerate() {
            let mut about = directions[0].clone();
            if i > 0 {
                axpy(1.0, direction, &mut about);
            }
            let mut bend: Vec<Vec<f64>> = vectors.iter().map(|x| self.mixed(&about, x)).collect();
            if i > 0 {
                let pairs = bend.iter_mut().zip(&bends[0]);
                pairs.for_each(|(bend, moving)| axpy(-1.0, moving, bend));
            }
            bends.push(bend);
        }
        bends
    }

    /// Four times the second derivatives of all residuals by `v` and `x`, from b = −q̇ᵀ ∂²φ q̇.
    fn mixed(&mut self, v: &[f64], x: &[f64]) -> Vec<f64> {
        let [plus, minus] = [1.0, -1.0].map(|sign| {
            let mut v = v.to_vec();
            axpy(sign, x, &mut v);
            self.b(&v)
        });
        minus.iter().zip(&plus).map(|(m, p)| m - p).collect()
    }

    /// b for velocities `v`.
    fn b(&mut self, v: &[f64]) -> Vec<f64> {
        self.terms.dynamics(self.mech, self.t, &self.q, v);
        self.terms.rhs.clone()
    }

    /// The parts along the vectors of `basis` of `x`, which is by coordinates.
    fn along(&self, mut x: Vec<f64>, basis: &[f64]) -> Vec<f64> {
        self.dense.metric.divide(&mut x);
        let directions = basis.chunks_exact(x.len());
        directions.map(|direction| dot(direction, &x)).collect()
    }

    /// The second derivatives of all residuals by each pair of directions, from b = −q̇ᵀ ∂²φ q̇, which is quadratic in q̇.
    fn curvatures(&mut self) -> Vec<Vec<f64>> {
        let k = self.directions.len();
        let mut b = |parts: &[(usize, f64)]| -> Vec<f64> {
            let mut v = self.directions[0].clone();
            for (i, sign) in parts {
                axpy(*sign, &self.directions[*i], &mut v);
            }
            self.b(&v)
        };
        let along = b(&[]);
        let mut all = vec![Vec::new(); k * k];
        let sides: Vec<[Vec<f64>; 2]> = (1..k).map(|i| [b(&[(i, 1.0)]), b(&[(i, -1.0)])]).collect();
        all[0] = along.iter().map(|b| -b).collect();
        for i in 1..k {
            let [plus, minus] = &sides[i - 1];
            let pairs = plus.iter().zip(minus);
            let mixed: Vec<f64> = pairs.clone().map(|(p, m)| 0.25 * (m - p)).collect();
            all[i].clone_from(&mixed);
            all[i * k] = mixed;
            let pure = pairs.zip(&along).map(|((p, m), b)| b - 0.5 * (p + m));
            all[i * k + i] = pure.collect();
            for j in 1..i {
                let both = b(&[(i, 1.0), (j, 1.0)]);
                let (one, other) = (&sides[i - 1][0], &sides[j - 1][0]);
                let term = |c: usize| -0.5 * (both[c] - one[c] - other[c] + along[c]);
                let mixed: Vec<f64> = (0..along.len()).map(term).collect();
                all[i * k + j].clone_from(&mixed);
                all[j * k + i] = mixed;
            }
        }
        all
    }
}

/// Equations of a step along k directions, k for each component of f.
struct System {
    right: Vec<f64>,
    /// Row by row.
    matrix: Vec<f64>,
    /// The rounding of each right-hand side: of rows that all but vanish it is as much as they say.
    blur: Vec<f64>,
    /// The largest of its numbers.
    largest: f64,
}

impl System {
    /// The solution, if there is one.
    fn step(&self) -> Option<Vec<f64>> {
        let (step, rank) = solution(&self.matrix, &self.right, self.largest);
        (rank == step.len()).then_some(step)
    }

    /// The largest of what `step` leaves.
    fn left(&self, step: &[f64]) -> f64 {
        let rows = self.matrix.chunks_exact(step.len());
        let pairs = self.right.iter().zip(rows);
        let left = pairs.map(|(b, row)| (b - dot(row, step)).abs());
        left.fold(0.0, f64::max)
    }
}

/// The solution of equations whose numbers are of a size, and the rank of their `matrix`, which is row by row.
fn solution(matrix: &[f64], right: &[f64], size: f64) -> (Vec<f64>, usize) {
    let (equations, k) = (right.len(), matrix.len() / right.len());
    let mut system = Decomposition::new(equations, k);
    system.load(equations).copy_from_slice(matrix);
    system.factor(&vec![1.0; k], &vec![size.recip(); equations], 1e-6);
    let mut x = vec![0.0; k];
    system.solve(right, &mut x);
    (x, system.rank())
}

/// The amount by which a function with these second derivatives by directions, and these slopes, negative, differs where it is critical
/// from what it is: not quite where others are that vanish with it. And how much of that may be what blurs the slopes.
fn least(second: &[f64], [down, blur]: [&[f64]; 2], largest: f64) -> [f64; 2] {
    let (step, _) = solution(second, down, largest);
    let pairs = blur.iter().zip(&step);
    let blurred = pairs.map(|(blur, step)| (blur * step).abs()).sum();
    [-0.5 * dot(down, &step), blurred]
}

/// The rounding of the combination of rows that `shares` make up, from theirs in units of ε.
fn rounded(shares: &[f64], rounding: &[f64]) -> f64 {
    let pairs = shares.iter().zip(rounding);
    f64::EPSILON * pairs.map(|(share, r)| (share * r).abs()).sum::<f64>()
}

/// Takes off `x` its parts along orthonormal vectors.
fn reject(x: &mut [f64], basis: &[Vec<f64>]) {
    for direction in basis {
        axpy(-dot(x, direction), direction, x);
    }
}
