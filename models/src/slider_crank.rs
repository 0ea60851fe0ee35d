//! A slider-crank of three rigid bodies in absolute coordinates.

use crate::{Model, StartOption, StartOptions, StartSpec};
use std::f64::consts::FRAC_PI_4;
use ukcore::model::{Chosen, positive};
use ukcore::{Error, State};

ukcore::multibody! {
    /// Planar slider-crank: crank about a fixed bearing at the origin, connecting rod, slider on the x axis; each body has a position
    /// and an angle. Bearing, crank pin, wrist pin and guide close the loop and leave one degree of freedom. y points up.
    pub SliderCrank {
        params {
            /// Length of the crank, m
            r = 0.1,
            /// Length of the connecting rod, m
            l = 0.3,
            /// Mass of the crank, kg
            m1 = 0.5,
            /// Mass of the connecting rod, kg
            m2 = 0.8,
            /// Mass of the slider, kg
            m3 = 0.6,
            /// Moment of inertia of the crank about its centre, kg m^2
            i1 = 4.0e-4,
            /// Moment of inertia of the connecting rod about its centre, kg m^2
            i2 = 6.0e-3,
            /// Moment of inertia of the slider about its centre, kg m^2
            i3 = 5.0e-4,
            /// Acceleration of gravity, m/s^2
            g = 9.81,
            /// Constant torque on the crank (with the potential -torque * th1), Nm
            torque = 0.0,
        }
        coords {
            /// Centre, m, and angle, rad, of the crank
            x1, y1, th1,
            /// Centre, m, and angle, rad, of the connecting rod
            x2, y2, th2,
            /// Centre, m, and angle, rad, of the slider
            x3, y3, th3,
        }
        mass { x1: m1, y1: m1, th1: i1, x2: m2, y2: m2, th2: i2, x3: m3, y3: m3, th3: i3 }
        potential { m1 * g * y1, m2 * g * y2, m3 * g * y3, -torque * th1 }
        holonomic {
            bearing: [x1, y1] = r / 2.0 * [cos(th1), sin(th1)],
            crank_pin: [x1, y1] + r / 2.0 * [cos(th1), sin(th1)] = [x2, y2] - l / 2.0 * [cos(th2), sin(th2)],
            wrist_pin: [x2, y2] + l / 2.0 * [cos(th2), sin(th2)] = [x3, y3],
            guide: [y3, th3] = [0.0, 0.0],
        }
        output {
            /// Angle of the crank, rad
            crank = th1,
            /// Position of the slider, m
            stroke = x3,
            /// Velocity of the slider, m/s
            stroke_speed = dot(x3),
        }
    }
}

/// Starts of the slider-crank, with and without redundant constraints.
pub(crate) const TURNING: StartSpec = StartSpec {
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
