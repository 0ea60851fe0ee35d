//! The double pendulum in angles: no constraints, M from the kinetic energy.

use crate::double_pendulum;
use crate::{Model, Reference};

ukcore::multibody! {
    /// Double pendulum in angles, by its kinetic energy (equals double_pendulum).
    ///
    /// The double pendulum in the angles of its rods from the downward vertical, declared by its energies alone.
    pub DoublePendulumAngles {
        params {
            /// Inner mass
            m1 = 1.0 [kg],
            /// Outer mass
            m2 = 1.0 [kg],
            /// Length of the inner rod
            l1 = 1.0 [m],
            /// Length of the outer rod
            l2 = 1.0 [m],
            /// Acceleration of gravity (exact in binary)
            g = 9.8125 [m/s^2],
        }
        coords {
            /// Angle of the inner rod
            th1 [rad],
            /// Angle of the outer rod
            th2 [rad],
        }
        kinetic {
            0.5 * (m1 + m2) * sq(l1 * dot(th1)),
            0.5 * m2 * sq(l2 * dot(th2)),
            m2 * l1 * l2 * dot(th1) * dot(th2) * cos(th1 - th2),
        }
        potential {
            -(m1 + m2) * g * l1 * cos(th1),
            -m2 * g * l2 * cos(th2),
        }
        output {
            /// Horizontal position of the inner mass
            x1 [m] = l1 * sin(th1),
            /// Vertical position of the inner mass, upwards
            y1 [m] = -l1 * cos(th1),
            /// Horizontal position of the outer mass
            x2 [m] = l1 * sin(th1) + l2 * sin(th2),
            /// Vertical position of the outer mass, upwards
            y2 [m] = -l1 * cos(th1) - l2 * cos(th2),
        }
        /// let go with given angles and angular velocities of the rods
        start released(
            /// Angle of the inner rod from the downward vertical
            from1 = (PI / 2.0) [rad],
            /// Angle of the outer rod from the downward vertical
            from2 = (PI / 2.0) [rad],
            /// Angular velocity of the inner rod
            rate1 = 0.0 [rad/s],
            /// Angular velocity of the outer rod
            rate2 = 0.0 [rad/s],
        ) {
            [th1, th2] = [from1, from2]
            dot([th1, th2]) = [rate1, rate2]
        }
        let inner = l1 * [sin(th1), -cos(th1)];
        let outer = inner + l2 * [sin(th2), -cos(th2)];
        draw { polyline([0, 0], inner, outer) trace(outer) }
    }
}

impl Model for DoublePendulumAngles {
    const ID: &'static str = "double-pendulum-angles";

    fn references() -> Vec<Reference> {
        double_pendulum::known("angles")
    }
}
