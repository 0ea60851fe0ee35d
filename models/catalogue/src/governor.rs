//! The flyball governor.

ukcore::multibody! {
    /// The flyball governor: an axle free to turn, a slider on it, two rods with balls, hard struts between slider and rods.
    ///
    /// Library of Computational Benchmark Problems of IFToMM, A05. A ball is a point mass at the end of its rod; rods and axle have square
    /// sections of side `side`. z points up, the hinges of the rods are parallel to the y axis of the axle.
    pub Governor {
        params {
            /// Length of axle and rods
            l = 1.0 [m],
            /// Mass of the axle and of each rod
            rod = 0.3 [kg],
            /// Side of their section
            side = 0.01 [m],
            /// Mass of each ball
            ball = 5.0 [kg],
            /// Mass of the slider, a cube
            cube = 3.0 [kg],
            /// Its edge
            edge = 0.1 [m],
            /// Distance of the joints from the axle
            r = 0.05 [m],
            /// Stiffness of a strut
            k = 8e5 [N/m],
            /// Its damping
            c = 4e4 [N s/m],
            /// Its length
            strut = 0.5 [m],
            g = 9.81 [m/s^2],
        }
        let across = rod * (sq(l) + sq(side)) / 12;
        let along = rod * sq(side) / 6;
        let centre = (rod * l / 2 + ball * l) / (rod + ball);
        let loaded = across + rod * sq(centre - l / 2) + ball * sq(l - centre);
        bodies {
            spatial axle { mass: rod, inertia: [across, across, along], centre: [0, 0, l / 2] }
            spatial slide { mass: cube, inertia: cube * sq(edge) / 6 * [1, 1, 1] }
            for i in 0..2 { spatial arm[i] { mass: rod + ball, inertia: [loaded, loaded, along], centre: [0, 0, -centre] } }
        }
        gravity { [0, 0, -g] }
        let out = [r, -r];
        holonomic {
            stand: hinge(ground.at([0, 0, 0]), axle.at([0, 0, 0]), [0, 0, 1])
            runs: slider(axle.at([0, 0, 0]), slide.at([0, 0, 0]), [0, 0, 1])
            for i in 0..2 { top[i]: hinge(axle.at([out[i], 0, l]), arm[i].at([0, 0, 0]), [0, 1, 0]) }
        }
        forces {
            for i in 0..2 {
                spring(slide.at([out[i], 0, 0]), arm[i].at([0, 0, -l / 2]), k, strut)
                damper(slide.at([out[i], 0, 0]), arm[i].at([0, 0, -l / 2]), c)
            }
        }
        output { height [m] = slide.z, speed [rad/s] = axle.omega[2] }
        let below = |angle| l / 2 * cos(angle) + sqrt(sq(strut) - sq(l / 2 * sin(angle)));
        /// turning with the rods at an angle, struts unstrained
        start turning(
            /// Angle of the rods from the downward vertical
            angle = (PI / 3) [rad],
            /// Angular velocity about the axle
            spin = (2 * PI) [rad/s],
        ) {
            axle.z near l / 2
            slide.z near l - below(angle)
            axle.omega near [0, 0, spin]
            slide.omega near [0, 0, spin]
            for i in 0..2 {
                [arm[i].e0, arm[i].e2] near [cos(angle / 2), (2 * i - 1) * sin(angle / 2)],
                arm[i].centre near [(1 - 2 * i) * (r + centre * sin(angle)), 0, l - centre * cos(angle)]
                dot(arm[i].y) near spin * (1 - 2 * i) * (r + centre * sin(angle))
                arm[i].omega near [0, 0, spin]
            }
        }
    }
}
