//! The slider-crank with more constraints than it needs.

use crate::slider_crank::{SliderCrank, TURNING};
use crate::{Model, StartOptions, StartSpec};
use ukcore::model::Chosen;
use ukcore::{Error, State};

ukcore::multibody! {
    /// The slider-crank of `SliderCrank` with two redundant constraints: the slider runs on two shoes although its level is kept already,
    /// and a second, massless rod joins the same two pins. The second is redundant only where the joints are closed: off them, the
    /// rows of A are independent.
    pub SliderCrankRedundant {
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
            /// Half distance of the slider's shoes, m
            c = 0.03,
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
            level: th3 = 0.0,
            front_shoe: y3 + c * sin(th3) = 0.0,
            back_shoe: y3 - c * sin(th3) = 0.0,
            second_rod: sq(x3 - x1 - r / 2.0 * cos(th1)) + sq(y3 - y1 - r / 2.0 * sin(th1)) = sq(l),
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

impl Model for SliderCrankRedundant {
    const ID: &'static str = "slider_crank_redundant";

    fn summary() -> &'static str {
        "the slider-crank with two redundant constraints"
    }

    fn starts() -> &'static [StartSpec] {
        &[TURNING]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        Chosen::among(Self::starts(), name, options)?;
        self.without_redundancy().start(name, options)
    }

    fn duration() -> f64 {
        2.0
    }
}

impl SliderCrankRedundant {
    /// The slider-crank with these parameters and without the redundant constraints, which moves in the same way.
    #[must_use]
    pub fn without_redundancy(&self) -> SliderCrank {
        SliderCrank {
            r: self.r,
            l: self.l,
            m1: self.m1,
            m2: self.m2,
            m3: self.m3,
            i1: self.i1,
            i2: self.i2,
            i3: self.i3,
            g: self.g,
            torque: self.torque,
        }
    }
}
