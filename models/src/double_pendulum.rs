//! A double pendulum in Cartesian coordinates.

use crate::{Model, Reference, reference};

ukcore::multibody! {
    /// Double pendulum in Cartesian coordinates (chaotic).
    ///
    /// Two point masses on massless rigid rods, the first about a pivot at the origin; y points up.
    pub DoublePendulum {
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
            /// Position of the inner mass
            x1 [m], y1 [m],
            /// Position of the outer mass
            x2 [m], y2 [m],
        }
        mass { x1: m1, y1: m1, x2: m2, y2: m2 }
        potential { m1 * g * y1, m2 * g * y2 }
        holonomic {
            inner: sq(x1) + sq(y1) = sq(l1),
            outer: sq(x2 - x1) + sq(y2 - y1) = sq(l2),
        }
        output {
            /// Angle of the inner rod from the downward vertical
            angle1 [rad] = atan2(x1, -y1),
            /// Angle of the outer rod from the downward vertical
            angle2 [rad] = atan2(x2 - x1, y1 - y2),
        }
        let rod = |length, angle| length * [sin(angle), -cos(angle)];
        let swing = |length, angle, rate| length * rate * [cos(angle), sin(angle)];
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
            [x1, y1] near rod(l1, from1),
            [x2, y2] near rod(l1, from1) + rod(l2, from2)
            dot([x1, y1]) near swing(l1, from1, rate1)
            dot([x2, y2]) near swing(l1, from1, rate1) + swing(l2, from2, rate2)
        }
        draw { polyline([0, 0], [x1, y1], [x2, y2]) trace([x2, y2]) }
    }
}

impl Model for DoublePendulum {
    const ID: &'static str = "double-pendulum";

    fn references() -> Vec<Reference> {
        known("states")
    }
}

/// The motion up to 10 s, from the list `list` of the data; later on, errors grow too large to compare.
pub(crate) fn known(list: &str) -> Vec<Reference> {
    let whole = Reference {
        source: "integration with 40 digits in two formulations",
        // What an `f64` holds of speeds of some 10 m/s.
        error: 2e-15,
        states: reference::states(include_str!("../data/double_pendulum.json"), list),
    };
    vec![whole.up_to(DoublePendulum::duration())]
}

impl DoublePendulum {
    /// Angular frequencies of the two small oscillations about the rest position, slow one first, rad/s.
    ///
    /// Roots of m1 l1 l2 ω⁴ − (m1 + m2) g (l1 + l2) ω² + (m1 + m2) g² = 0 (Landau & Lifshitz, Mechanics, §23, problem 2).
    #[must_use]
    pub fn small_oscillations(&self) -> [f64; 2] {
        let both = self.m1 + self.m2;
        let product = self.m1 * self.l1 * self.l2;
        let half = 0.5 * both * self.g * (self.l1 + self.l2);
        let root = (half * half - product * both * self.g * self.g).sqrt();
        // The smaller root from the product of both: no cancellation.
        let fast = (half + root) / product;
        let slow = both * self.g * self.g / (half + root);
        [slow.sqrt(), fast.sqrt()]
    }
}
