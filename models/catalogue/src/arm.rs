//! A serial arm in space.

ukcore::multibody! {
    /// A serial arm of N hinges about z, y, y, x, y, z (and so on), links of 0.5 m along x.
    ///
    /// Its accelerations by an articulated-body library (Pinocchio 4.1) are known. N is a constant of the declaration.
    pub Arm {
        const N: usize = 6;
        params { m = 1.0 [kg], l = 0.5 [m], inertia[3] = [0.01, 0.03, 0.03] [kg m^2], g = 9.81 [m/s^2] }
        let axis = [[0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
        bodies { spatial link[N] { mass: m, inertia: inertia, centre: [l / 2, 0, 0] } }
        gravity { [0, 0, -g] }
        tree {
            base: hinge(ground.at([0, 0, 0]), link[0].at([0, 0, 0]), axis[0])
            for i in 1..N { joint[i - 1]: hinge(link[i - 1].at([l, 0, 0]), link[i].at([0, 0, 0]), axis[i - 6 * (i / 6)]) }
        }
        output { tip [m] = link[N - 1].at([l, 0, 0]) }
        /// hinge i at first + i step, at such a rate, too
        start bent(
            /// Angle of the first hinge
            first = -0.5 [rad],
            /// How much further each hinge is turned than the one before
            step = 0.2 [rad],
        ) until 2.0 {
            base.angle = first
            dot(base.angle) = first / (1 [s])
            for i in 1..N {
                joint[i - 1].angle = first + i * step
                dot(joint[i - 1].angle) = (first + i * step) / (1 [s])
            }
        }
    }
}
