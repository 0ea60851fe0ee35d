//! Spatial bodies as nalgebra sees them.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use ukcore::State;

/// Place, orientation and motion of a spatial body, vectors in axes of the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    /// The centre of mass, m.
    pub(crate) centre: Vector3<f64>,
    /// The rotation from axes of the body to those of the ground.
    pub(crate) turn: UnitQuaternion<f64>,
    /// The velocity of the centre of mass, m/s.
    pub(crate) velocity: Vector3<f64>,
    /// The angular velocity, rad/s.
    pub(crate) omega: Vector3<f64>,
}

impl Pose {
    /// Enters the pose as the seven coordinates and velocities from the index `x` of the body's first coordinate on.
    pub(crate) fn enter(&self, state: &mut State, x: usize) {
        let rate = Quaternion::from_imag(self.omega) * self.turn.into_inner() * 0.5;
        let (e, i) = (self.turn.w, self.turn.imag());
        state.q[x..x + 3].copy_from_slice(self.centre.as_slice());
        state.q[x + 3..x + 7].copy_from_slice(&[e, i.x, i.y, i.z]);
        state.v[x..x + 3].copy_from_slice(self.velocity.as_slice());
        state.v[x + 3..x + 7].copy_from_slice(&[rate.w, rate.i, rate.j, rate.k]);
    }

    /// The pose of the body whose first coordinate has the index `x`.
    pub(crate) fn of(q: &[f64], v: &[f64], x: usize) -> Self {
        let turn = Quaternion::new(q[x + 3], q[x + 4], q[x + 5], q[x + 6]);
        let rate = Quaternion::new(v[x + 3], v[x + 4], v[x + 5], v[x + 6]);
        Pose {
            centre: Vector3::new(q[x], q[x + 1], q[x + 2]),
            turn: UnitQuaternion::new_normalize(turn),
            velocity: Vector3::new(v[x], v[x + 1], v[x + 2]),
            omega: (rate * turn.conjugate()).vector() * 2.0,
        }
    }
}
