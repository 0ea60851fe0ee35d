//! Bricard's linkage.

ukcore::multibody! {
    /// Bricard's linkage: five rods, six hinges; by count it cannot move.
    ///
    /// Library of Computational Benchmark Problems of IFToMM, A04. Rods of 1 m and 1 kg with a square section of 0.1 m stand in the edges
    /// of a cube; of the 30 rows of the hinges 29 are independent where all are met, 30 elsewhere. Gravity points along −y.
    pub Bricard {
        params { m = 1.0 [kg], across = (1.01 / 12.0) [kg m^2], along = (0.02 / 12.0) [kg m^2], g = 9.81 [m/s^2] }
        bodies {
            spatial r0 { mass: m, inertia: [along, across, across], centre: [0.5, 0, 0] }
            spatial r1 { mass: m, inertia: [across, along, across], centre: [0, -0.5, 0] }
            spatial r2 { mass: m, inertia: [across, across, along], centre: [0, 0, 0.5] }
            spatial r3 { mass: m, inertia: [along, across, across], centre: [-0.5, 0, 0] }
            spatial r4 { mass: m, inertia: [across, along, across], centre: [0, 0.5, 0] }
        }
        gravity { [0, -g, 0] }
        holonomic {
            p0: hinge(ground.at([0, 0, 0]), r0.at([0, 0, 0]), [0, 1, 0])
            p1: hinge(r0.at([1, 0, 0]), r1.at([0, 0, 0]), [0, 0, 1])
            p2: hinge(r1.at([0, -1, 0]), r2.at([0, 0, 0]), [1, 0, 0])
            p3: hinge(r2.at([0, 0, 1]), r3.at([0, 0, 0]), [0, 1, 0])
            p4: hinge(r3.at([-1, 0, 0]), r4.at([0, 0, 0]), [0, 0, 1])
            p5: hinge(r4.at([0, 1, 0]), ground.at([0, 0, 1]), [1, 0, 0])
        }
        output { p3_at [m] = r3.at([0, 0, 0]) }
        /// at rest in the edges of a cube
        start cube {
            r0.centre near [0.5, 0, 0]
            r1.centre near [1, -0.5, 0]
            r2.centre near [1, -1, 0.5]
            r3.centre near [0.5, -1, 1]
            r4.centre near [0, -0.5, 1]
        }
    }
}
