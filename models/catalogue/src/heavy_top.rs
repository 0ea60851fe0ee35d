//! A fast heavy top.

use nalgebra::Vector3;
use ukcore::model::{Chosen, Model, StartOption, StartOptions, StartSpec};
use ukcore::{Error, State};

use crate::Pose;

ukcore::multibody! {
    /// The heavy top of Brüls, Cardona & Arnold, spinning about its axis y, about a fixed point.
    ///
    /// Brüls, Cardona & Arnold, Lie group generalized-α time integration of constrained flexible multibody systems, Mechanism and Machine
    /// Theory 48 (2012) 121. The centre of mass is at (0, 1, 0) from the fixed point; gravity points along −z.
    pub HeavyTop {
        params { m = 15.0, across = 0.234375, along = 0.46875, l = 1.0, g = 9.81 }
        bodies { spatial top { mass: m, inertia: [across, along, across], centre: [0, l, 0] } }
        gravity { [0, 0, -g] }
        holonomic { foot: ball(ground.at([0, 0, 0]), top.at([0, 0, 0])) }
        output { height = top.along([0, 1, 0])[2], spin = top.spin }
    }
}

impl Model for HeavyTop {
    fn starts() -> &'static [StartSpec] {
        &[StartSpec {
            name: "level",
            doc: "the axis level, along y",
            options: &[
                StartOption {
                    name: "spin",
                    doc: "angular velocity about the axis",
                    default: 150.0,
                    unit: "rad/s",
                },
                StartOption {
                    name: "precession",
                    doc: "angular velocity about the vertical",
                    default: -4.61538,
                    unit: "rad/s",
                },
            ],
        }]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let [spin, precession] = Chosen::of::<Self>(name, options)?.values();
        let mut state = State::zeros::<Self>();
        Pose::at_rest([0.0, self.l, 0.0])
            .turning(Vector3::new(0.0, spin, precession))
            .enter(&mut state, HeavyTop::TOP_X);
        Ok(state)
    }

    fn duration() -> f64 {
        2.0
    }
}
