//! A disc that rolls on a plane.

use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::FRAC_PI_2;
use ukcore::model::{Chosen, Model, StartOption, StartOptions, StartSpec, positive};
use ukcore::{Error, State};

use crate::Pose;

ukcore::multibody! {
    /// A thin disc that rolls without slip on a level plane.
    ///
    /// Routh, Advanced Dynamics of a System of Rigid Bodies, 1905, §244; its steady circles are known in closed form. The axis of the disc is
    /// its y.
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
    }
}

impl RollingDisc {
    /// The spin about the disc's axis, rad/s, with which it rolls in a circle at `tilt`, rad, of its axis from the vertical while that axis
    /// turns about the vertical at `precession`, rad/s: from the balance of moments, with A = m r²/4 and C = m r²/2,
    /// (C + m r²) ω₃ φ̇ sin θ = A φ̇² sin θ cos θ − m g r cos θ.
    #[must_use]
    pub fn spin(&self, tilt: f64, precession: f64) -> f64 {
        let ((sin, cos), square) = (tilt.sin_cos(), self.r * self.r);
        let moments = square / 4.0 * precession * precession * sin * cos - self.g * self.r * cos;
        moments / (1.5 * square * precession * sin)
    }
}

impl Model for RollingDisc {
    fn starts() -> &'static [StartSpec] {
        &[StartSpec {
            name: "circle",
            doc: "rolling in a steady circle",
            options: &[
                StartOption {
                    name: "tilt",
                    doc: "angle of the axis from the vertical",
                    default: 1.1,
                    unit: "rad",
                },
                StartOption {
                    name: "precession",
                    doc: "angular velocity of the axis about the vertical",
                    default: 2.0,
                    unit: "rad/s",
                },
            ],
        }]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let [tilt, precession] = Chosen::among(Self::starts(), name, options)?.values();
        positive("r", self.r)?;
        positive("precession", precession.abs())?;
        positive("sin(tilt)", tilt.sin())?;
        let turn = UnitQuaternion::from_scaled_axis(Vector3::x() * (FRAC_PI_2 - tilt));
        let (axis, up) = (turn * Vector3::y(), Vector3::z());
        // About the axis, and what turns the axis about the vertical.
        let omega = axis * self.spin(tilt, precession) + (up - axis * axis.z) * precession;
        let down = (axis * axis.z - up).normalize() * self.r;
        let mut state = State::zeros::<Self>();
        let pose = Pose {
            centre: up * (self.r * tilt.sin()),
            turn,
            velocity: -omega.cross(&down),
            omega,
        };
        pose.enter(&mut state, RollingDisc::DISC_X);
        Ok(state)
    }
}
