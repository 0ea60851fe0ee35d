//! A slider-crank of three rigid bodies.

use crate::{Model, StartOption, StartOptions, StartSpec};
use std::f64::consts::FRAC_PI_4;
use ukcore::model::{Chosen, positive};
use ukcore::{Error, State};

ukcore::multibody! {
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
    }
}

const TURNING: StartSpec = StartSpec {
    name: "turning",
    doc: "crank at an angle, turning; rod and slider where the joints put them",
    options: &[
        StartOption {
            name: "angle",
            doc: "angle of the crank",
            default: FRAC_PI_4,
            unit: "rad",
        },
        StartOption {
            name: "speed",
            doc: "angular velocity of the crank",
            default: 10.0,
            unit: "rad/s",
        },
    ],
};

impl Model for SliderCrank {
    const ID: &'static str = "slider_crank";

    fn summary() -> &'static str {
        "planar slider-crank of three rigid bodies (closed loop)"
    }

    fn starts() -> &'static [StartSpec] {
        &[TURNING]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let [angle, speed] = Chosen::among(Self::starts(), name, options)?.values();
        positive("r", self.r)?;
        positive("l", self.l)?;
        self.at_crank(angle, speed).ok_or_else(|| Error::InvalidSetting {
            what: "angle",
            reason: format!(
                "is {angle} rad; there the rod of length l = {} does not reach the guide from the crank pin, r = {} away from the bearing",
                self.l, self.r
            ),
        })
    }

    fn duration() -> f64 {
        2.0
    }
}

impl SliderCrank {
    /// The consistent state at t = 0 for the crank's angle, rad, and angular velocity, rad/s, with the slider on the right of the pin:
    /// sin θ2 = −(r/l) sin θ1, cos θ2 > 0. `None` if the rod is too short.
    #[must_use]
    pub fn at_crank(&self, angle: f64, speed: f64) -> Option<State> {
        let (s1, c1) = angle.sin_cos();
        let s2 = -self.r / self.l * s1;
        let c2 = (1.0 - s2 * s2).sqrt();
        // At c2 = 0 the rod's angular velocity is not determined.
        if c2 == 0.0 || c2.is_nan() {
            return None;
        }
        // l θ̇2 cos θ2 = −r θ̇1 cos θ1.
        let rod_speed = -self.r * speed * c1 / (self.l * c2);
        let (r, l) = (self.r, self.l);
        Some(State {
            t: 0.0,
            q: vec![
                r / 2.0 * c1,
                r / 2.0 * s1,
                angle,
                r * c1 + l / 2.0 * c2,
                r * s1 + l / 2.0 * s2,
                s2.asin(),
                r * c1 + l * c2,
                0.0,
                0.0,
            ],
            v: vec![
                -r / 2.0 * speed * s1,
                r / 2.0 * speed * c1,
                speed,
                -r * speed * s1 - l / 2.0 * rod_speed * s2,
                r * speed * c1 + l / 2.0 * rod_speed * c2,
                rod_speed,
                -r * speed * s1 - l * rod_speed * s2,
                0.0,
                0.0,
            ],
        })
    }

    /// Position of the slider, m: r cos θ + √(l² − r² sin² θ).
    #[must_use]
    pub fn stroke(&self, angle: f64) -> f64 {
        let (sin, cos) = angle.sin_cos();
        self.r * cos + (self.l * self.l - (self.r * sin).powi(2)).sqrt()
    }

    /// Moment of inertia of the whole mechanism reduced to the crank, kg m²: T = ½ J(θ1) θ̇1², J from the velocities per unit of θ̇1.
    /// `None` if the rod is too short.
    #[must_use]
    pub fn reduced_inertia(&self, angle: f64) -> Option<f64> {
        let v = self.at_crank(angle, 1.0)?.v;
        let square = |i: usize| v[i] * v[i];
        Some(
            self.m1 * (square(0) + square(1))
                + self.i1 * square(2)
                + self.m2 * (square(3) + square(4))
                + self.i2 * square(5)
                + self.m3 * (square(6) + square(7))
                + self.i3 * square(8),
        )
    }

    /// Potential energy in terms of the crank's angle, J: the crank's and the rod's centre lie at (r/2) sin θ1.
    #[must_use]
    pub fn reduced_potential(&self, angle: f64) -> f64 {
        (self.m1 + self.m2) * self.g * self.r / 2.0 * angle.sin() - self.torque * angle
    }
}
