//! A simple pendulum in Cartesian coordinates, with its motion in elliptic functions.

use crate::elliptic;
use crate::{Model, Reference};
use std::f64::consts::FRAC_PI_2;

ukcore::multibody! {
    /// Simple pendulum in Cartesian coordinates (closed form).
    ///
    /// Point mass on a massless rigid rod about a pivot at the origin; y points up.
    pub Pendulum {
        params {
            /// Mass
            m = 1.0 [kg],
            /// Length of the rod
            l = 1.0 [m],
            /// Acceleration of gravity
            g = 9.81 [m/s^2],
        }
        coords {
            /// Horizontal position
            x [m],
            /// Vertical position, upwards
            y [m],
        }
        mass { x: m, y: m }
        potential { m * g * y }
        holonomic { rod: sq(x) + sq(y) = sq(l) }
        output {
            /// Angle from the downward vertical, counter-clockwise
            angle [rad] = atan2(x, -y),
            /// Tension of the rod
            tension [N] = m * (sq(dot(x)) + sq(dot(y)) - g * y) / l,
        }
        /// let go at an angle
        start released(
            /// Angle from the downward vertical, counter-clockwise
            from = (-PI / 2.0) [rad],
            /// Angular velocity
            rate = 0.0 [rad/s],
        ) {
            [x, y] near l * [sin(from), -cos(from)]
            dot([x, y]) near l * rate * [cos(from), sin(from)]
        }
        draw { line([0, 0], [x, y]) circle([x, y], 0.05 * l) }
    }
}

impl Model for Pendulum {
    const ID: &'static str = "pendulum";

    fn references() -> Vec<Reference> {
        let pendulum = Pendulum::default();
        // Measured against 28 digits, at t up to 10 s.
        let error = 3e-14;
        vec![Reference::closed::<Self>(error, |t| {
            let (angle, rate) = pendulum.swing(-FRAC_PI_2, t);
            let (q, v) = pendulum.at_angle(angle, rate);
            (q.to_vec(), v.to_vec())
        })]
    }
}

impl Pendulum {
    /// Position, m, and velocity, m/s, at the angle `angle` from the downward vertical, rad, and its rate, rad/s.
    #[must_use]
    pub fn at_angle(&self, angle: f64, rate: f64) -> ([f64; 2], [f64; 2]) {
        let (sin, cos) = angle.sin_cos();
        let speed = self.l * rate;
        ([self.l * sin, -self.l * cos], [speed * cos, speed * sin])
    }

    /// Period of the swing with the given amplitude, rad, in s: 4 √(l/g) K(sin²(θ₀/2)) (Landau & Lifshitz, Mechanics, §11).
    #[must_use]
    pub fn period(&self, amplitude: f64) -> f64 {
        let m = (0.5 * amplitude).sin().powi(2);
        4.0 * (self.l / self.g).sqrt() * elliptic::complete(m)
    }

    /// Angle, rad, and angular velocity, rad/s, at time `t` after the release at rest from the angle `from`, |from| < π.
    ///
    /// sin(θ/2) = k cd(ω₀ t | k²) with k = sin(θ₀/2), ω₀ = √(g/l) and cd = cn/dn.
    #[must_use]
    pub fn swing(&self, from: f64, t: f64) -> (f64, f64) {
        let k = (0.5 * from).sin();
        let frequency = (self.g / self.l).sqrt();
        let (sn, cn, dn) = elliptic::jacobi(frequency * t, k * k);
        let angle = 2.0 * (k * cn / dn).asin();
        // d(cd)/du = −(1 − k²) sn/dn², and cos(θ/2) = √(1 − k²)/dn.
        let rate = -2.0 * k * frequency * (1.0 - k * k).sqrt() * sn / dn;
        (angle, rate)
    }
}
