//! The Whipple bicycle.

ukcore::multibody! {
    /// Whipple's bicycle with a rigid rider and the benchmark's numbers: wheels that roll without slip, frame, fork.
    ///
    /// Meijaard, Papadopoulos, Ruina & Schwab, Proc. R. Soc. A 463 (2007) 1955, Table 1; here z points up and y to the left, so that their
    /// products of inertia change sign. Frames of all bodies have their origin in the rear contact of the bicycle that stands upright.
    pub Bicycle {
        params {
            /// Wheel base
            w = 1.02 [m],
            /// Trail
            c = 0.08 [m],
            /// Tilt of the steering axis
            tilt = (PI / 10) [rad],
            /// Radius of the rear wheel
            rear_radius = 0.3 [m],
            /// Radius of the front wheel
            front_radius = 0.35 [m],
            g = 9.81 [m/s^2],
        }
        let hub = [[0, 0, rear_radius], [w, 0, front_radius]];
        let head = [w + c, 0, 0];
        bodies {
            spatial rear { mass: 2, inertia: [0.0603, 0.12, 0.0603], centre: hub[0] }
            spatial frame { mass: 85, inertia: [9.2, 11, 2.8, 0, -2.4, 0], centre: [0.3, 0, 0.9] }
            spatial fork { mass: 4, inertia: [0.05892, 0.06, 0.00708, 0, 0.00756, 0], centre: [0.9, 0, 0.7] }
            spatial front { mass: 3, inertia: [0.1405, 0.28, 0.1405], centre: hub[1] }
        }
        gravity { [0, 0, -g] }
        holonomic {
            rear_axle: hinge(frame.at(hub[0]), rear.at(hub[0]), [0, 1, 0])
            steering: hinge(frame.at(head), fork.at(head), [-sin(tilt), 0, cos(tilt)])
            front_axle: hinge(fork.at(hub[1]), front.at(hub[1]), [0, 1, 0])
            rear_touches: disc(rear.at(hub[0]), [0, 1, 0], rear_radius)
            front_touches: disc(front.at(hub[1]), [0, 1, 0], front_radius)
        }
        nonholonomic {
            rear_rolls: rolls(rear.at(hub[0]), [0, 1, 0], rear_radius)
            front_rolls: rolls(front.at(hub[1]), [0, 1, 0], front_radius)
        }
        output { lean_rate [rad/s] = frame.spin[0], speed [m/s] = inner(frame.along([1, 0, 0]), dot(rear.centre)) }
        /// rolling upright along x, and leaning over
        start upright(
            /// Speed
            speed = 4.6 [m/s],
            /// Rate of leaning
            lean_rate = 0.5 [rad/s],
        ) until 5.0 {
            rear.centre near hub[0]
            frame.centre = [0.3, 0, 0.9]
            fork.centre near [0.9, 0, 0.7]
            front.centre near hub[1]
            // The wheels follow.
            dot(frame.centre) = [speed, -0.9 [m] * lean_rate, 0]
            frame.omega = [lean_rate, 0, 0]
            fork.omega = [lean_rate, 0, 0]
        }
    }
}
