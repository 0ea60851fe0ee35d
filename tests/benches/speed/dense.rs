//! Contenders that know nothing of the mechanism but its M, Q, A and b.

use nalgebra::{DMatrix, DVector};
use ukcore::equations::uk;
use ukcore::mechanism::Terms;
use ukcore::{Mechanism, Prepared, State};

/// Relative rank tolerance of the pseudo-inverses.
const RANK: f64 = 1e-12;

/// Buffers of [`Mechanism::dynamics`].
pub(crate) struct Dense {
    mass: DMatrix<f64>,
    force: DVector<f64>,
    nonideal: DVector<f64>,
    jacobian: DMatrix<f64>,
    rhs: DVector<f64>,
    /// [M Aᵀ; A 0], handed to the decomposition and taken back from it.
    system: DMatrix<f64>,
    right: DVector<f64>,
}

impl Dense {
    pub(crate) fn new<M: Mechanism>() -> Self {
        let (n, m) = (M::SPEC.n(), M::SPEC.m());
        Dense {
            mass: DMatrix::zeros(n, n),
            force: DVector::zeros(n),
            nonideal: DVector::zeros(n),
            jacobian: DMatrix::zeros(m, n),
            rhs: DVector::zeros(m),
            system: DMatrix::zeros(n + m, n + m),
            right: DVector::zeros(n + m),
        }
    }

    /// M, Q, A and b alone.
    pub(crate) fn evaluate(&mut self, mechanism: &Prepared, state: &State) {
        let mut terms = Terms {
            mass: self.mass.as_mut_slice(),
            force: self.force.as_mut_slice(),
            nonideal: self.nonideal.as_mut_slice(),
            jacobian: self.jacobian.as_mut_slice(),
            rhs: self.rhs.as_mut_slice(),
        };
        mechanism.dynamics(state.t, &state.q, &state.v, &mut terms);
    }

    /// q̈ by LU decomposition of [M Aᵀ; A 0] with partial pivoting.
    pub(crate) fn saddle(&mut self, mechanism: &Prepared, state: &State, out: &mut [f64]) {
        self.evaluate(mechanism, state);
        let (m, n) = self.jacobian.shape();
        let mut system = std::mem::replace(&mut self.system, DMatrix::zeros(0, 0));
        system.fill(0.0);
        system.view_mut((0, 0), (n, n)).copy_from(&self.mass);
        system.view_mut((n, 0), (m, n)).copy_from(&self.jacobian);
        self.jacobian
            .transpose_to(&mut system.view_mut((0, n), (n, m)));
        self.right.rows_mut(0, n).copy_from(&self.force);
        self.right.rows_mut(n, m).copy_from(&self.rhs);
        let lu = system.lu();
        assert!(lu.solve_mut(&mut self.right), "the system is regular");
        self.system = lu.l_unpack();
        out.copy_from_slice(&self.right.as_slice()[..n]);
    }

    /// q̈ by eq. 13 as printed, with its pseudo-inverse and square roots.
    pub(crate) fn printed(&mut self, mechanism: &Prepared, state: &State, out: &mut [f64]) {
        self.evaluate(mechanism, state);
        let acceleration = uk::acceleration_nonideal(
            &self.mass,
            &self.force,
            &self.nonideal,
            &self.jacobian,
            &self.rhs,
            RANK,
        )
        .expect("M is regular");
        out.copy_from_slice(acceleration.as_slice());
    }
}
