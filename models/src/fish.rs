//! The two-joint carangiform fish robot of Zhao, Zhen & Chen 2013, §6-10.

use crate::{Model, Reference, reference};
use std::f64::consts::PI;

ukcore::multibody! {
    /// Two-joint carangiform fish robot (Zhao, Zhen & Chen 2013, case 2).
    ///
    /// Fish robot of three links: body, peduncle and tail fin. x is longitudinal with the tail at +x, so it swims towards −x; y is
    /// lateral. The angles of peduncle and fin are prescribed and carry no inertia, which makes M singular (eqs. 36, 37).
    /// Parameters are those of Table 2, with its moments of inertia of peduncle and fin left out as the model does not use them.
    /// (Zhao, Zhen & Chen 2013, §6-10.)
    pub FishRobot {
        params {
            /// Mass of the body
            m1 = 0.409 [kg],
            /// Moment of inertia of the body about its centre
            i1 = 1.23e-3 [kg m^2],
            /// Half length of the body
            a = 0.09375 [m],
            /// Frontal area of the body
            s = 7.069e-3 [m^2],
            /// Lateral area of the body (as printed; far more than a body of this size has)
            s1 = 0.19 [m^2],
            /// Mass of the peduncle
            m2 = 0.104 [kg],
            /// Length of the peduncle
            l2 = 0.0625 [m],
            /// Lateral area of the peduncle
            s2 = 0.04 [m^2],
            /// Mass of the fin
            m3 = 9.0e-3 [kg],
            /// Half length of the fin
            b = 0.015 [m],
            /// Lateral area of the fin
            s3 = 0.008 [m^2],
            /// Density of water
            rho = 998.0 [kg/m^3],
            /// Drag coefficient
            cd = 0.5 [-],
            /// Span of the fin
            span = 0.075 [m],
            /// Half chord of the fin
            half_chord = 0.015 [m],
            /// Amplitude of the peduncle's angle
            a2 = 0.3 [rad],
            /// Amplitude of the fin's angle
            a3 = 0.6 [rad],
            /// Angular frequency of the gait
            w = 2.0 * PI [rad/s],
            /// Phase by which the fin lags the peduncle
            phi = (PI / 12.0) [rad],
        }
        coords {
            /// Position and angle of the body
            x1 [m], y1 [m], th1 [rad],
            /// Position and angle of the peduncle
            x2 [m], y2 [m], th2 [rad],
            /// Position and angle of the fin
            x3 [m], y3 [m], th3 [rad],
        }
        let drag = |area, v| -0.5 * rho * cd * area * v.abs() * v;
        let lift = 2.0 * PI * rho * span * half_chord;
        let lift_x = lift * (dot(x3) * dot(y3) * sin(th3) - sq(dot(y3)) * cos(th3));
        let lift_y = lift * (dot(x3) * dot(y3) * cos(th3) - sq(dot(x3)) * sin(th3));
        mass { x1: m1, y1: m1, th1: i1, x2: m2, y2: m2, x3: m3, y3: m3 }
        force {
            x1: drag(s, dot(x1)),
            y1: drag(s1, dot(y1)),
            y2: drag(s2, dot(y2)),
            x3: lift_x,
            y3: drag(s3, dot(y3)) + lift_y,
        }
        holonomic {
            joint1: [x1 + a * cos(th1), y1 + a * sin(th1)] = [x2 - l2 / 2.0 * cos(th2), y2 - l2 / 2.0 * sin(th2)],
            joint2: [x2 + l2 / 2.0 * cos(th2), y2 + l2 / 2.0 * sin(th2)] = [x3 - b * cos(th3), y3 - b * sin(th3)],
            peduncle: th2 = a2 * sin(w * t),
            fin: th3 = a3 * sin(w * t - phi),
        }
        output {
            /// Speed of the body towards its nose's side, −x
            forward_speed [m/s] = -dot(x1),
            /// Swing angle of the body
            swing [rad] = th1,
            /// Force of the water on the fin along x by lift (negative drives the fish)
            fin_x [N] = lift_x,
            /// Force of the water on the fin along y by lift
            fin_y [N] = lift_y,
            /// Longitudinal position of the fin's trailing edge
            edge_x [m] = x3 + b * cos(th3),
            /// Lateral position of the fin's trailing edge
            edge_y [m] = y3 + b * sin(th3),
        }
        /// the body at rest, peduncle and fin as the gait has them at t = 0 (Table 3, made consistent)
        start table3(
            /// Longitudinal position of the body
            x = 0.0 [m],
            /// Lateral position of the body
            y = 0.0 [m],
            /// Angle of the body
            angle = 0.0 [rad],
        ) until 4.0 {
            [x1, y1, th1] = [x, y, angle]
            dot([x1, y1, th1]) = 0.0,
            [x2, y2] near [x, y] + a * [cos(angle), sin(angle)],
            [x3, y3] near [x, y] + a * [cos(angle), sin(angle)]
        }
        draw {
            line([x1 - a * cos(th1), y1 - a * sin(th1)], [x1 + a * cos(th1), y1 + a * sin(th1)])
            line([x2 - l2 / 2 * cos(th2), y2 - l2 / 2 * sin(th2)], [x2 + l2 / 2 * cos(th2), y2 + l2 / 2 * sin(th2)])
            line([x3 - b * cos(th3), y3 - b * sin(th3)], [x3 + b * cos(th3), y3 + b * sin(th3)])
            trace([x3 + b * cos(th3), y3 + b * sin(th3)])
        }
    }
}

impl Model for FishRobot {
    const ID: &'static str = "fish";

    fn references() -> Vec<Reference> {
        vec![Reference {
            source: "integration in three coordinates, order 8, started anew at each change of sign of a velocity with drag",
            error: 3e-12,
            states: reference::states(include_str!("../data/fish.json"), "states"),
        }]
    }
}

impl FishRobot {
    /// Drag of the water on a link that moves with `speed`, m/s, across `area`, m² (eq. 29), in N.
    #[must_use]
    pub fn drag(&self, area: f64, speed: f64) -> f64 {
        -0.5 * self.rho * self.cd * area * speed.abs() * speed
    }

    /// Lift on the fin that has the angle `angle`, rad, and moves with `velocity`, m/s (eqs. 30-34), in N:
    /// L = 2πρlC (v3 × l_e) × v3 with the fin's direction l_e = −(cos θ3, sin θ3) and the inflow v3 = −(ẋ3, ẏ3).
    #[must_use]
    pub fn lift(&self, angle: f64, velocity: [f64; 2]) -> [f64; 2] {
        let edge = [-angle.cos(), -angle.sin()];
        let inflow = [-velocity[0], -velocity[1]];
        // The first cross product points out of the plane; the second turns it back into it.
        let normal = inflow[0] * edge[1] - inflow[1] * edge[0];
        let factor = 2.0 * PI * self.rho * self.span * self.half_chord * normal;
        [-factor * inflow[1], factor * inflow[0]]
    }
}
