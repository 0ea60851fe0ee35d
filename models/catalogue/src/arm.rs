//! A serial arm in space.

use nalgebra::{UnitQuaternion, Vector3};
use ukcore::model::{Chosen, Model, StartOption, StartOptions, StartSpec};
use ukcore::{Error, State};

use crate::Pose;

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
        holonomic {
            base: hinge(ground.at([0, 0, 0]), link[0].at([0, 0, 0]), axis[0])
            for i in 1..N { joint[i - 1]: hinge(link[i - 1].at([l, 0, 0]), link[i].at([0, 0, 0]), axis[i - 6 * (i / 6)]) }
        }
        output { tip [m] = link[N - 1].at([l, 0, 0]) }
    }
}

impl Arm {
    /// Axis of hinge i in the link before.
    #[must_use]
    pub fn axis(i: usize) -> Vector3<f64> {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        [z, y, y, x, y, z][i % 6]
    }

    /// The state with these angles of the hinges, rad, and their rates, rad/s.
    #[must_use]
    pub fn bent(&self, angles: [f64; Arm::N], rates: [f64; Arm::N]) -> State {
        let mut state = State::zeros::<Self>();
        let mut pose = Pose::at_rest([0.0; 3]);
        for (i, (angle, rate)) in angles.into_iter().zip(rates).enumerate() {
            let axis = Arm::axis(i);
            pose.turn *= UnitQuaternion::from_scaled_axis(axis * angle);
            pose.omega += pose.turn * axis * rate;
            // From the near end to the centre, and on to the far end.
            let half = pose.turn * (Vector3::x() * (self.l / 2.0));
            for end in [false, true] {
                pose.centre += half;
                pose.velocity += pose.omega.cross(&half);
                if !end {
                    pose.enter(&mut state, Arm::LINK_X[i]);
                }
            }
        }
        state
    }
}

impl Model for Arm {
    fn starts() -> &'static [StartSpec] {
        &[StartSpec {
            name: "bent",
            doc: "hinge i at first + i step, at such a rate, too",
            options: &[
                StartOption {
                    name: "first",
                    doc: "angle of the first hinge",
                    default: -0.5,
                    unit: "rad",
                },
                StartOption {
                    name: "step",
                    doc: "how much further each hinge is turned than the one before",
                    default: 0.2,
                    unit: "rad",
                },
            ],
        }]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let [first, step] = Chosen::among(Self::starts(), name, options)?.values();
        let angles = std::array::from_fn(|i| first + step * i as f64);
        Ok(self.bent(angles, angles))
    }

    fn duration() -> f64 {
        2.0
    }
}
