//! An independent dense solution of the equations of motion, by singular values: no code shared with `ukcore`.

use nalgebra::{DMatrix, DVector};
use ukcore::mechanism::Terms;
use ukcore::scalar::{DoubleDouble, Scalar};
use ukcore::{Mechanism, Prepared, State};

/// Numbers of 31 digits.
#[must_use]
pub fn digits(x: &[f64]) -> Vec<DoubleDouble> {
    x.iter().map(|x| DoubleDouble::from_f64(*x)).collect()
}

/// q̈ by the straight line in 31 digits.
#[must_use]
pub fn straight<M: Mechanism>(mechanism: &M, state: &State) -> Vec<DoubleDouble> {
    let mut exact = digits(&vec![0.0; state.q.len()]);
    let t = DoubleDouble::from_f64(state.t);
    let (q, v) = (digits(&state.q), digits(&state.v));
    mechanism.prepared().acceleration(t, &q, &v, &mut exact);
    exact
}

/// M, Q, c, A and b in any numbers.
pub struct Buffers<S>(pub [Vec<S>; 5]);

impl<S: Scalar> Buffers<S> {
    /// Zeros for n coordinates and m constraints.
    #[must_use]
    pub fn new(n: usize, m: usize) -> Self {
        Buffers([n * n, n, n, n * m, m].map(|len| vec![S::from_f64(0.0); len]))
    }

    /// What emitted functions write to.
    pub fn terms(&mut self) -> Terms<'_, S> {
        let [mass, force, nonideal, jacobian, rhs] = &mut self.0;
        Terms {
            mass,
            force,
            nonideal,
            jacobian,
            rhs,
        }
    }
}

/// Moore-Penrose inverse by singular values; those below `tolerance` times the largest count as zero.
#[must_use]
pub fn pseudo_inverse(matrix: &DMatrix<f64>, tolerance: f64) -> DMatrix<f64> {
    if matrix.nrows() < matrix.ncols() {
        return pseudo_inverse(&matrix.transpose(), tolerance).transpose();
    }
    let (mut left, right) = rotated(matrix);
    // Now left = U Σ, so A⁺ = V Σ⁻² (U Σ)ᵀ on the singular values that count.
    let sizes: Vec<f64> = left.column_iter().map(|c| c.norm()).collect();
    let cut = tolerance * sizes.iter().fold(0.0_f64, |s, x| s.max(*x));
    for (k, size) in sizes.iter().enumerate() {
        let weight = if *size > cut {
            1.0 / (size * size)
        } else {
            0.0
        };
        left.column_mut(k).scale_mut(weight);
    }
    right * left.transpose()
}

/// Singular values of a matrix, in no order.
#[must_use]
pub fn singular_values(matrix: &DMatrix<f64>) -> Vec<f64> {
    let tall = match matrix.nrows() < matrix.ncols() {
        true => matrix.transpose(),
        false => matrix.clone(),
    };
    rotated(&tall).0.column_iter().map(|c| c.norm()).collect()
}

/// U Σ and V of a matrix U Σ Vᵀ that is not wider than high.
///
/// One-sided Jacobi rotations (Hestenes 1958): slow, short, and accurate to rounding also for small singular values.
fn rotated(matrix: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let n = matrix.ncols();
    let mut left = matrix.clone();
    let mut right = DMatrix::identity(n, n);
    loop {
        let mut rotated = false;
        for i in 0..n {
            for j in i + 1..n {
                let (a, b) = (left.column(i).norm_squared(), left.column(j).norm_squared());
                let c = left.column(i).dot(&left.column(j));
                // Orthogonal to rounding, or a column that is nothing but rounding.
                if c.abs() <= f64::EPSILON * (a * b).sqrt() || a.min(b) <= f64::MIN_POSITIVE {
                    continue;
                }
                rotated = true;
                let zeta = (b - a) / (2.0 * c);
                let tan = zeta.signum() / (zeta.abs() + 1.0_f64.hypot(zeta));
                let cos = 1.0 / 1.0_f64.hypot(tan);
                for matrix in [&mut left, &mut right] {
                    for k in 0..matrix.nrows() {
                        let (x, y) = (matrix[(k, i)], matrix[(k, j)]);
                        matrix[(k, i)] = cos * (x - tan * y);
                        matrix[(k, j)] = cos * (y + tan * x);
                    }
                }
            }
        }
        if !rotated {
            break;
        }
    }
    (left, right)
}

/// M, Q, c, A and b of a state, as matrices.
#[derive(Debug, Clone)]
pub struct Dense {
    /// M (eq. 1).
    pub mass: DMatrix<f64>,
    /// Q (eq. 1).
    pub force: DVector<f64>,
    /// c (eq. 8).
    pub nonideal: DVector<f64>,
    /// A (eq. 5).
    pub jacobian: DMatrix<f64>,
    /// b (eq. 5).
    pub rhs: DVector<f64>,
}

/// Relative rank tolerance: far above the rounding of a state projected to about 1e-15, far below any dependence that the
/// geometry of the models has.
const RANK: f64 = 1e-10;

impl Dense {
    /// Evaluates `mechanism` at `state`.
    #[must_use]
    pub fn of(mechanism: impl Into<Prepared>, state: &State) -> Self {
        let mechanism: Prepared = mechanism.into();
        let (n, m) = (mechanism.spec().n(), mechanism.spec().m());
        let mut dense = Dense {
            mass: DMatrix::zeros(n, n),
            force: DVector::zeros(n),
            nonideal: DVector::zeros(n),
            jacobian: DMatrix::zeros(m, n),
            rhs: DVector::zeros(m),
        };
        let mut terms = Terms {
            mass: dense.mass.as_mut_slice(),
            force: dense.force.as_mut_slice(),
            nonideal: dense.nonideal.as_mut_slice(),
            jacobian: dense.jacobian.as_mut_slice(),
            rhs: dense.rhs.as_mut_slice(),
        };
        mechanism.dynamics(state.t, &state.q, &state.v, &mut terms);
        dense
    }

    /// q̈ by eq. 19, with Q + c for Q.
    #[must_use]
    pub fn udwadia_phohomsiri(&self) -> DVector<f64> {
        let (n, m) = (self.force.len(), self.rhs.len());
        let project = self.tangent();
        let mut stacked = DMatrix::zeros(n + m, n);
        stacked.rows_mut(0, n).copy_from(&(project * &self.mass));
        stacked.rows_mut(n, m).copy_from(&self.jacobian);
        let mut right = DVector::zeros(n + m);
        right
            .rows_mut(0, n)
            .copy_from(&(&self.force + &self.nonideal));
        right.rows_mut(n, m).copy_from(&self.rhs);
        pseudo_inverse(&stacked, RANK) * right
    }

    /// I − A⁺A: projects onto the virtual displacements, which satisfy A δq = 0.
    #[must_use]
    pub fn tangent(&self) -> DMatrix<f64> {
        let n = self.force.len();
        DMatrix::identity(n, n) - pseudo_inverse(&self.jacobian, RANK) * &self.jacobian
    }

    /// Gauss's function ½ aᵀ M a − aᵀ (Q + c), least for the actual acceleration among those with A a = b.
    #[must_use]
    pub fn gauss(&self, acceleration: &DVector<f64>) -> f64 {
        let inertia = &self.mass * acceleration;
        0.5 * acceleration.dot(&inertia) - acceleration.dot(&(&self.force + &self.nonideal))
    }
}
