//! Coupled four-bar linkages side by side, which pass through singular positions.

ukcore::multibody! {
    /// Four four-bar linkages in a row, coupled by their cranks.
    ///
    /// N four-bar linkages in a row that share their cranks: N + 1 uniform rods from the ground points (i l, 0) to the tops (x\[i\],
    /// y\[i\]), and N uniform rods from each top to the next. The y axis points up. A uniform rod with the end velocities a and b has the
    /// kinetic energy m/6 (a² + a·b + b²), so that M couples neighbours. Where all rods lie in one line the N couplers are redundant.
    /// (The N-four-bar of González, Dopico, Pastorino & Cuadrado 2006, DOI 10.1007/s11044-006-9020-5.)
    pub FourBars {
        const N: usize = 4;
        params {
            /// Mass of each rod
            m = 1.0 [kg],
            /// Length of each rod
            l = 1.0 [m],
            /// Acceleration of gravity
            g = 9.81 [m/s^2],
        }
        coords {
            /// Horizontal positions of the tops
            x[N + 1] [m],
            /// Vertical positions of the tops, upwards
            y[N + 1] [m],
        }
        kinetic {
            for i in 0..N + 1 { m / 6.0 * (sq(dot(x[i])) + sq(dot(y[i]))) }
            for i in 0..N {
                m / 6.0 * (sq(dot(x[i])) + dot(x[i]) * dot(x[i + 1]) + sq(dot(x[i + 1]))),
                m / 6.0 * (sq(dot(y[i])) + dot(y[i]) * dot(y[i + 1]) + sq(dot(y[i + 1]))),
            }
        }
        potential {
            for i in 0..N + 1 { m * g * y[i] / 2.0 }
            for i in 0..N { m * g * (y[i] + y[i + 1]) / 2.0 }
        }
        holonomic {
            for i in 0..N + 1 { crank[i]: sq(x[i] - i * l) + sq(y[i]) = sq(l) }
            for i in 0..N { coupler[i]: sq(x[i + 1] - x[i]) + sq(y[i + 1] - y[i]) = sq(l) }
        }
        output {
            /// Angle of the first crank from the upright, towards +x
            lean [rad] = atan2(x[0], y[0]),
        }
        /// all cranks upright, all tops moving at one speed
        start upright(
            /// Horizontal speed of all tops
            speed = 1.0 [m/s],
        ) until 0.6 {
            for i in 0..N + 1 {
                [x[i], y[i]] near [i * l, l]
                dot(x[i]) near speed
            }
        }
        draw {
            for i in 0..N + 1 { line([i * l, 0], [x[i], y[i]]) }
            for i in 0..N { line([x[i], y[i]], [x[i + 1], y[i + 1]]) }
        }
    }
}

/// Number of tops.
const TOPS: usize = FourBars::X.len();

impl FourBars {
    /// k in θ̈ = k sin θ, 1/s², for cranks that all lean by θ from the upright.
    ///
    /// The N + 1 cranks turn, with m l²/3 about their ground points and the weight at l/2; the N couplers move along with the tops. So
    /// ((N + 1)/3 + N) m l² θ̈ = ((N + 1)/2 + N) m g l sin θ.
    #[must_use]
    pub fn toppling(&self) -> f64 {
        let (cranks, couplers) = (TOPS as f64, (TOPS - 1) as f64);
        self.g / self.l * (cranks / 2.0 + couplers) / (cranks / 3.0 + couplers)
    }
}
