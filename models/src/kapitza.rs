//! Kapitza's pendulum: a pendulum that stands on its head because its pivot shakes.

ukcore::multibody! {
    /// Pendulum upside down on a shaking pivot (time in the constraint).
    ///
    /// Pendulum whose pivot moves vertically as a cos(w t), in Cartesian coordinates of the bob; y points up. The rod's constraint
    /// contains the time.
    pub KapitzaPendulum {
        params {
            /// Mass of the bob
            m = 1.0 [kg],
            /// Length of the rod
            l = 1.0 [m],
            /// Acceleration of gravity
            g = 9.81 [m/s^2],
            /// Amplitude of the pivot
            a = 0.1 [m],
            /// Angular frequency of the pivot
            w = 100.0 [rad/s],
        }
        coords {
            /// Horizontal position
            x [m],
            /// Vertical position, upwards
            y [m],
        }
        let pivot = a * cos(w * t);
        mass { x: m, y: m }
        potential { m * g * y }
        holonomic { rod: sq(x) + sq(y - pivot) = sq(l) }
        output {
            /// Angle from the upward vertical, clockwise
            angle [rad] = atan2(x, y - pivot),
            /// Height of the pivot
            pivot_y [m] = pivot,
        }
        /// near the upward vertical, pivot at its highest
        start inverted(
            /// Angle from the upward vertical, clockwise
            from = 0.2 [rad],
            /// Angular velocity
            rate = 0.0 [rad/s],
        ) until 5.0 {
            [x, y] near l * [sin(from), cos(from)] + [0, a]
            dot([x, y]) near l * rate * [cos(from), -sin(from)]
        }
        /// near the downward vertical, pivot at its highest
        start hanging(
            /// Angle from the downward vertical, counter-clockwise
            from = 0.2 [rad],
            /// Angular velocity
            rate = 0.0 [rad/s],
        ) until 5.0 {
            [x, y] near l * [sin(from), -cos(from)] + [0, a]
            dot([x, y]) near l * rate * [cos(from), sin(from)]
        }
        draw { line([0, pivot], [x, y]) circle([x, y], 0.05 * l) trace([x, y]) }
    }
}

impl KapitzaPendulum {
    /// Height of the pivot, m, its velocity, m/s, and acceleration, m/s².
    #[must_use]
    pub fn pivot(&self, t: f64) -> [f64; 3] {
        let (sin, cos) = (self.w * t).sin_cos();
        [
            self.a * cos,
            -self.a * self.w * sin,
            -self.a * self.w * self.w * cos,
        ]
    }

    /// Exact angular acceleration, rad/s², in the angle from the upward vertical: θ̈ = (g + s̈(t)) sin θ / l with the pivot at s(t).
    #[must_use]
    pub fn angular_acceleration(&self, t: f64, angle: f64) -> f64 {
        (self.g + self.pivot(t)[2]) * angle.sin() / self.l
    }

    /// Whether the inverted position is stable in the limit of fast, small shaking: (a w)² > 2 g l
    /// (Landau & Lifshitz, Mechanics, §30, problem 1).
    #[must_use]
    pub fn inverted_is_stable(&self) -> bool {
        (self.a * self.w).powi(2) > 2.0 * self.g * self.l
    }

    /// Angular frequency, rad/s, of the slow oscillation about the upward vertical, averaged over the shaking:
    /// Ω² = (a w/l)²/2 − g/l, with relative errors of order a/l and (Ω/w)²; NaN where it is not stable.
    #[must_use]
    pub fn slow_frequency(&self) -> f64 {
        (0.5 * (self.a * self.w / self.l).powi(2) - self.g / self.l).sqrt()
    }
}
