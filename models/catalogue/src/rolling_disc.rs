//! A disc that rolls on a plane.

ukcore::multibody! {
    /// A thin disc that rolls without slip on a level plane.
    ///
    /// Routh, Advanced Dynamics of a System of Rigid Bodies, 1905, §244; its steady circles are known in closed form. The axis of the disc
    /// is its y.
    pub RollingDisc {
        params {
            m = 1.0 [kg],
            /// Radius
            r = 0.5 [m],
            g = 9.81 [m/s^2],
        }
        bodies { spatial disc { mass: m, inertia: m * sq(r) / 4 * [1, 2, 1] } }
        gravity { [0, 0, -g] }
        holonomic { touches: disc(disc.at([0, 0, 0]), [0, 1, 0], r) }
        nonholonomic { rolls: rolls(disc.at([0, 0, 0]), [0, 1, 0], r) }
        output { tilt [rad] = acos(disc.along([0, 1, 0])[2]), spin [rad/s] = disc.spin[1] }
        // The spin of a steady circle: from the balance of moments, with A = m r²/4 and C = m r²/2,
        // (C + m r²) ω₃ φ̇ sin θ = A φ̇² sin θ cos θ − m g r cos θ.
        let spin = |tilt, precession| cos(tilt) * (r / 4 * sq(precession) * sin(tilt) - g) / (1.5 * r * precession * sin(tilt));
        /// rolling in a steady circle
        start circle(
            /// Angle of the axis from the vertical
            tilt = 1.1 [rad],
            /// Angular velocity of the axis about the vertical
            precession = 2.0 [rad/s],
        ) {
            [disc.e0, disc.e1] near [cos(PI / 4 - tilt / 2), sin(PI / 4 - tilt / 2)],
            disc.z near r * sin(tilt)
            disc.omega = [0, 0, precession] + (spin(tilt, precession) - precession * cos(tilt)) * [0, sin(tilt), cos(tilt)]
        }
    }
}
