//! The Stewart platform.

ukcore::multibody! {
    /// A platform on six legs whose lengths are driven, so that it heaves, yaws and nods: the leg forces are the multipliers.
    ///
    /// Stewart, A platform with six degrees of freedom, Proc. Inst. Mech. Eng. 180 (1965) 371; legs without mass between joints in pairs on
    /// two circles. The paper gives no masses of legs, so they have none: a leg without mass pushes along its line alone and is one row,
    /// where one with mass would be two bodies, on a universal and a ball joint with a cylinder between. Place and attitude that the
    /// lengths are made for are `place` and `attitude`; other ways to put the platform on legs of the same lengths exist, up to 40.
    pub Stewart {
        params {
            m = 10.0 [kg],
            inertia[3] = [0.4, 0.5, 0.8] [kg m^2],
            /// Radius of the circle of joints on the ground
            base = 0.8 [m],
            /// Radius of that on the platform
            plate = 0.5 [m],
            /// Half angle between the joints of a pair
            spread = 0.2 [rad],
            /// Mean height
            height = 0.7 [m],
            /// Amplitude of the height
            rise = 0.1 [m],
            /// Amplitude of the angles
            turn = 0.2 [rad],
            /// Angular frequency of the motion
            w = 2.0 [rad/s],
            g = 9.81 [m/s^2],
        }
        bodies { spatial platform { mass: m, inertia: inertia } }
        gravity { [0, 0, -g] }
        let ring = |r, angle| r * [cos(angle), sin(angle), 0];
        let foot = |i, s| ring(base, 2 * PI / 3 * i + (2 * s - 1) * spread);
        let head = |i, s| ring(plate, 2 * PI / 3 * i + (2 * s - 1) * (PI / 3 - spread));
        let place = [0, 0, height + rise * sin(w * t)];
        let attitude = rotz(turn * sin(w * t)) * rotx(turn * (1 - cos(w * t)));
        holonomic {
            for i in 0..3 { for s in 0..2 {
                leg[i][s]: rod(ground.at(foot(i, s)), platform.at(head(i, s)), norm(place + attitude * head(i, s) - foot(i, s)))
            } }
        }
        output {
            for i in 0..3 { for s in 0..2 { length[i][s] [m] = norm(platform.at(head(i, s)) - foot(i, s)) } }
        }
        /// level at the mean height, moving as the legs drive it
        start level { platform.z near height }
    }
}
