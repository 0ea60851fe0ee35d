//! A point mass on a stiff spring: fast along the spring, slow across it.

use crate::Model;

ukcore::multibody! {
    /// Point mass on a stiff spring (rigid limit: pendulum).
    ///
    /// Point mass on a massless spring about a pivot at the origin; y points up. The stiffer the spring, the more it is a
    /// [`Pendulum`](crate::Pendulum), and the shorter the steps of an explicit method, which has to follow the oscillation along the
    /// spring, be it there or not.
    pub SpringPendulum {
        params {
            /// Mass
            m = 1.0 [kg],
            /// Length of the relaxed spring
            l = 1.0 [m],
            /// Stiffness of the spring
            k = 1e4 [N/m],
            /// Acceleration of gravity
            g = 9.81 [m/s^2],
        }
        coords {
            /// Horizontal position
            x [m],
            /// Vertical position, upwards
            y [m],
        }
        let r = sqrt(sq(x) + sq(y));
        mass { x: m, y: m }
        potential { 0.5 * k * sq(r - l), m * g * y }
        output {
            /// Angle from the downward vertical, counter-clockwise
            angle [rad] = atan2(x, -y),
            /// Extension of the spring
            extension [m] = r - l,
            /// Force of the spring
            tension [N] = k * (r - l),
        }
        let balance = |angle, rate| (k * l + m * g * cos(angle)) / (k - m * sq(rate));
        let growth = |angle, rate| -3.0 * m * g / k * rate * sin(angle);
        /// let go at an angle, the spring stretched so that it balances the mass
        start released(
            /// Angle from the downward vertical, counter-clockwise
            from = (-PI / 2.0) [rad],
            /// Angular velocity
            rate = 0.0 [rad/s],
            /// Stretch of the spring beyond balance, which excites the fast oscillation
            stretch = 0.0 [m],
        ) until 2.0 {
            [x, y] = (balance(from, rate) + stretch) * [sin(from), -cos(from)]
            dot([x, y]) = (balance(from, rate) + stretch) * rate * [cos(from), sin(from)] + growth(from, rate) * [sin(from), -cos(from)]
        }
        draw { spring([0, 0], [x, y]) circle([x, y], 0.05 * l) }
    }
}

impl Model for SpringPendulum {
    const ID: &'static str = "spring-pendulum";

    /// A hard spring makes it stiff.
    fn variations() -> &'static [&'static [(&'static str, f64)]] {
        &[&[("k", 1e8)]]
    }
}

impl SpringPendulum {
    /// Length of the spring, m, at which it carries the mass at `angle`, rad, and `rate`, rad/s, but for terms of order 1/k²:
    /// k (r − l) = m (g cos θ + r θ̇²).
    #[must_use]
    pub fn balance(&self, angle: f64, rate: f64) -> f64 {
        let SpringPendulum { m, l, k, g, .. } = *self;
        // The square of the rate stretches the spring, too: k r − m r θ̇² = k l + m g cos θ.
        (k * l + m * g * angle.cos()) / (k - m * rate * rate)
    }

    /// Angular frequency of the oscillation along the spring, rad/s: √(k/m).
    #[must_use]
    pub fn frequency(&self) -> f64 {
        (self.k / self.m).sqrt()
    }
}
