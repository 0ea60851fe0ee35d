//! The Whipple bicycle.

use nalgebra::Vector3;
use ukcore::model::{Chosen, Model, StartOption, StartOptions, StartSpec, positive};
use ukcore::{Error, State};

use crate::Pose;

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
    }
}

impl Bicycle {
    /// Upright, rolling along x at `speed`, m/s, and leaning over at `lean_rate`, rad/s.
    #[must_use]
    pub fn upright(&self, speed: f64, lean_rate: f64) -> State {
        let mut state = State::zeros::<Self>();
        let wheel = |r: f64| Vector3::y() * (speed / r);
        for (x, centre, own) in [
            (
                Bicycle::REAR_X,
                [0.0, 0.0, self.rear_radius],
                wheel(self.rear_radius),
            ),
            (Bicycle::FRAME_X, [0.3, 0.0, 0.9], Vector3::zeros()),
            (Bicycle::FORK_X, [0.9, 0.0, 0.7], Vector3::zeros()),
            (
                Bicycle::FRONT_X,
                [self.w, 0.0, self.front_radius],
                wheel(self.front_radius),
            ),
        ] {
            let mut pose = Pose::at_rest(centre).turning(Vector3::x() * lean_rate);
            pose.velocity.x = speed;
            pose.omega += own;
            pose.enter(&mut state, x);
        }
        state
    }
}

impl Model for Bicycle {
    fn starts() -> &'static [StartSpec] {
        &[StartSpec {
            name: "upright",
            doc: "rolling upright along x, and leaning over",
            options: &[
                StartOption {
                    name: "speed",
                    doc: "speed",
                    default: 4.6,
                    unit: "m/s",
                },
                StartOption {
                    name: "lean_rate",
                    doc: "rate of leaning",
                    default: 0.5,
                    unit: "rad/s",
                },
            ],
        }]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let [speed, lean_rate] = Chosen::among(Self::starts(), name, options)?.values();
        positive("rear_radius", self.rear_radius)?;
        positive("front_radius", self.front_radius)?;
        Ok(self.upright(speed, lean_rate))
    }

    fn duration() -> f64 {
        5.0
    }
}
