//! The flyball governor.

use nalgebra::{UnitQuaternion, Vector3};
use ukcore::model::{Chosen, Model, StartOption, StartOptions, StartSpec};
use ukcore::{Error, State};

use crate::Pose;

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
    }
}

impl Governor {
    /// Rods at `angle` from the downward vertical, the slider where the struts are not strained, all turning at `speed` about the axle.
    /// `None` where the struts do not reach.
    #[must_use]
    pub fn turning(&self, angle: f64, speed: f64) -> Option<State> {
        let (sin, cos) = angle.sin_cos();
        let half = self.l / 2.0;
        // The strut from the middle of the rod down to the slider.
        let below = (self.strut.powi(2) - (half * sin).powi(2)).sqrt();
        if below.is_nan() {
            return None;
        }
        let height = self.l - half * cos - below;
        let centre = (self.rod * half + self.ball * self.l) / (self.rod + self.ball);
        let mut state = State::zeros::<Self>();
        let mut enter = |x: usize, turn: f64, at: [f64; 3]| {
            let mut pose = Pose::at_rest(at).turning(Vector3::z() * speed);
            pose.turn = UnitQuaternion::from_scaled_axis(Vector3::y() * turn);
            pose.enter(&mut state, x);
        };
        enter(Governor::AXLE_X, 0.0, [0.0, 0.0, half]);
        enter(Governor::SLIDE_X, 0.0, [0.0, 0.0, height]);
        for (x, side) in Governor::ARM_X.into_iter().zip([1.0, -1.0]) {
            let at = [side * (self.r + centre * sin), 0.0, self.l - centre * cos];
            enter(x, -side * angle, at);
        }
        Some(state)
    }
}

impl Model for Governor {
    fn starts() -> &'static [StartSpec] {
        &[StartSpec {
            name: "turning",
            doc: "turning with the rods at an angle, struts unstrained",
            options: &[
                StartOption {
                    name: "angle",
                    doc: "angle of the rods from the downward vertical",
                    default: std::f64::consts::FRAC_PI_3,
                    unit: "rad",
                },
                StartOption {
                    name: "spin",
                    doc: "angular velocity about the axle",
                    default: std::f64::consts::TAU,
                    unit: "rad/s",
                },
            ],
        }]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let [angle, spin] = Chosen::among(Self::starts(), name, options)?.values();
        self.turning(angle, spin).ok_or_else(|| {
            let reason = format!("is {angle} rad; there the struts do not reach the axle");
            Error::InvalidSetting {
                what: "angle",
                reason,
            }
        })
    }
}
