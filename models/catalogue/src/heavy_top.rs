//! A fast heavy top.

ukcore::multibody! {
    /// The heavy top of Brüls, Cardona & Arnold, spinning about its axis y, about a fixed point.
    ///
    /// Brüls, Cardona & Arnold, Lie group generalized-α time integration of constrained flexible multibody systems, Mechanism and Machine
    /// Theory 48 (2012) 121. The centre of mass is at (0, 1, 0) from the fixed point; gravity points along −z.
    pub HeavyTop {
        params { m = 15.0 [kg], across = 0.234375 [kg m^2], along = 0.46875 [kg m^2], l = 1.0 [m], g = 9.81 [m/s^2] }
        bodies { spatial top { mass: m, inertia: [across, along, across], centre: [0, l, 0] } }
        gravity { [0, 0, -g] }
        holonomic { foot: ball(ground.at([0, 0, 0]), top.at([0, 0, 0])) }
        output { height [-] = top.along([0, 1, 0])[2], spin [rad/s] = top.spin }
        /// the axis level, along y
        start level(
            /// Angular velocity about the axis
            turning = 150.0 [rad/s],
            /// Angular velocity about the vertical
            precession = -4.61538 [rad/s],
        ) until 2.0 {
            top.centre near [0, l, 0]
            top.omega = [0, turning, precession]
        }
    }
}
