//! A slider-crank of three rigid bodies.

ukcore::multibody! {
    /// Planar slider-crank of three rigid bodies (closed loop).
    ///
    /// Planar slider-crank: crank about a fixed bearing at the origin, connecting rod, slider on the x axis. Bearing, crank pin, wrist pin
    /// and guide close the loop and leave one degree of freedom. y points up.
    pub SliderCrank {
        params {
            /// Length of the crank
            r = 0.1 [m],
            /// Length of the connecting rod
            l = 0.3 [m],
            /// Mass of the crank
            m1 = 0.5 [kg],
            /// Mass of the connecting rod
            m2 = 0.8 [kg],
            /// Mass of the slider
            m3 = 0.6 [kg],
            /// Moment of inertia of the crank about its centre
            i1 = 4.0e-4 [kg m^2],
            /// Moment of inertia of the connecting rod about its centre
            i2 = 6.0e-3 [kg m^2],
            /// Moment of inertia of the slider about its centre
            i3 = 5.0e-4 [kg m^2],
            /// Acceleration of gravity
            g = 9.81 [m/s^2],
            /// Constant torque on the crank (with the potential -torque * crank.angle)
            torque = 0.0 [N m],
        }
        bodies {
            planar crank { mass: m1, inertia: i1, centre: [r / 2, 0] }
            planar rod { mass: m2, inertia: i2, centre: [l / 2, 0] }
            planar slide { mass: m3, inertia: i3 }
        }
        gravity { [0, -g] }
        potential { -torque * crank.angle }
        holonomic {
            bearing: pin(ground.at([0, 0]), crank.at([0, 0]))
            crank_pin: pin(crank.at([r, 0]), rod.at([0, 0]))
            wrist_pin: pin(rod.at([l, 0]), slide.at([0, 0]))
            guide: slider(ground.at([0, 0]), slide.at([0, 0]), [1, 0])
        }
        output {
            /// Angle of the crank
            crank_angle [rad] = crank.angle,
            /// Position of the slider
            stroke [m] = slide.x,
            /// Velocity of the slider
            stroke_speed [m/s] = dot(slide.x),
        }
        /// crank at an angle, turning; the slider on the right of the crank pin
        start turning(
            /// Angle of the crank
            angle = (PI / 4.0) [rad],
            /// Angular velocity of the crank
            speed = 10.0 [rad/s],
        ) until 2.0 {
            crank.angle = angle
            crank.omega = speed,
            crank.centre near r / 2 * [cos(angle), sin(angle)]
            rod.centre near r * [cos(angle), sin(angle)] + [l / 2, 0]
            slide.x near r * cos(angle) + l
        }
    }
}

impl SliderCrank {
    /// Position of the slider, m: r cos θ + √(l² − r² sin² θ).
    #[must_use]
    pub fn stroke(&self, angle: f64) -> f64 {
        let (sin, cos) = angle.sin_cos();
        self.r * cos + (self.l * self.l - (self.r * sin).powi(2)).sqrt()
    }

    /// Moment of inertia of the whole mechanism reduced to the crank, kg m²: T = ½ J(θ) θ̇², with the rod at the angle α, sin α = −(r/l)
    /// sin θ, which turns with α̇ = −(r cos θ / l cos α) θ̇.
    #[must_use]
    pub fn reduced_inertia(&self, angle: f64) -> f64 {
        let (r, l, (sin, cos)) = (self.r, self.l, angle.sin_cos());
        let rod_sin = -r / l * sin;
        let rod_cos = (1.0 - rod_sin * rod_sin).sqrt();
        let turn = -r * cos / (l * rod_cos);
        // Velocities for θ̇ = 1 of the rod's centre and of its far end.
        let centre = [-r * sin - l / 2.0 * turn * rod_sin, r * cos / 2.0];
        let end = -r * sin - l * turn * rod_sin;
        self.m1 * r * r / 4.0
            + self.i1
            + self.m2 * (centre[0] * centre[0] + centre[1] * centre[1])
            + self.i2 * turn * turn
            + self.m3 * end * end
    }

    /// Potential energy in terms of the crank's angle, J: the crank's and the rod's centre lie at (r/2) sin θ1.
    #[must_use]
    pub fn reduced_potential(&self, angle: f64) -> f64 {
        (self.m1 + self.m2) * self.g * self.r / 2.0 * angle.sin() - self.torque * angle
    }
}
