//! Theo Jansen's leg, and a walker of such legs.

use ukcore::model::{StartOption, StartSpec};

/// A point of the plane.
type Point = [f64; 2];

/// The joints of a leg besides its hip: crank pin, knee above, lower joint, outer end of the upper triangle, heel, toe.
pub type Joints = [Point; 6];

/// `legs!(docs Name, pairs, sides)`: pairs of legs on one crank shaft, of `sides` legs each; n counts pairs, s sides.
#[macro_export]
macro_rules! legs {
    ($(#[$doc:meta])* $name:ident, $pairs:literal, $sides:literal) => {
        ukcore::multibody! {
            $(#[$doc])*
            pub $name {
                const PAIRS: usize = $pairs;
                const SIDES: usize = $sides;
                params {
                    a = 0.38 [m], b = 0.415 [m], c = 0.393 [m], d = 0.401 [m], e = 0.558 [m], f = 0.394 [m], g = 0.367 [m], h = 0.657 [m],
                    i = 0.49 [m], j = 0.5 [m], k = 0.619 [m], l = 0.078 [m], m = 0.15 [m],
                    /// Mass of the bars for each metre
                    rho = 0.5 [kg/m],
                    /// Moment of inertia of the crank shaft
                    shaft = 0.5 [kg m^2],
                    /// Torque on the crank shaft
                    torque = 20.0 [N m],
                    /// Drag of the crank shaft
                    drag = 5.0 [N m s],
                    gravity = 9.81 [m/s^2],
                }
                let apex = |p, q, r| [(sq(p) + sq(q) - sq(r)) / (2 * p), sqrt(sq(q) - sq((sq(p) + sq(q) - sq(r)) / (2 * p)))];
                let hand = |s, v| [v[0], (1 - 2 * s) * v[1]];
                let outer = |s| hand(s, apex(b, d, e));
                let toe = |s| hand(s, apex(g, i, h));
                let hip = |s| [-a * (1 - 2 * s), -l];
                let throw = |n| m * [cos(2 * PI / 3 * n), sin(2 * PI / 3 * n)];
                // A triangle of bars with corners in 0, u and v.
                let round = |u, v| norm(u) + norm(v) + norm(v - u);
                let middle = |u, v| (norm(u) * u + norm(v) * v + norm(v - u) * (u + v)) / (2 * round(u, v));
                let bar = |u, v, at| norm(v - u) * (sq(v - u) / 12 + sq((u + v) / 2 - at));
                let turning = |u, v, at| bar([0, 0], u, at) + bar([0, 0], v, at) + bar(u, v, at);
                bodies {
                    planar crank { mass: 1, inertia: shaft }
                    for n in 0..PAIRS { for s in 0..SIDES {
                        planar bar_j[n][s] { mass: rho * j, inertia: rho * j.powi(3) / 12, centre: [j / 2, 0] }
                        planar bar_k[n][s] { mass: rho * k, inertia: rho * k.powi(3) / 12, centre: [k / 2, 0] }
                        planar bar_c[n][s] { mass: rho * c, inertia: rho * c.powi(3) / 12, centre: [c / 2, 0] }
                        planar bar_f[n][s] { mass: rho * f, inertia: rho * f.powi(3) / 12, centre: [f / 2, 0] }
                        planar thigh[n][s] {
                            mass: rho * round([b, 0], outer(s)), centre: middle([b, 0], outer(s)),
                            inertia: rho * turning([b, 0], outer(s), middle([b, 0], outer(s))),
                        }
                        planar foot[n][s] {
                            mass: rho * round([g, 0], toe(s)), centre: middle([g, 0], toe(s)),
                            inertia: rho * turning([g, 0], toe(s), middle([g, 0], toe(s))),
                        }
                    } }
                }
                gravity { [0, -gravity] }
                holonomic {
                    bearing: pin(ground.at([0, 0]), crank.at([0, 0]))
                    for n in 0..PAIRS { for s in 0..SIDES {
                        throw_j[n][s]: pin(crank.at(throw(n)), bar_j[n][s].at([0, 0]))
                        throw_k[n][s]: pin(crank.at(throw(n)), bar_k[n][s].at([0, 0]))
                        hip_b[n][s]: pin(ground.at(hip(s)), thigh[n][s].at([0, 0]))
                        hip_c[n][s]: pin(ground.at(hip(s)), bar_c[n][s].at([0, 0]))
                        knee[n][s]: pin(bar_j[n][s].at([j, 0]), thigh[n][s].at([b, 0]))
                        back[n][s]: pin(thigh[n][s].at(outer(s)), bar_f[n][s].at([0, 0]))
                        low_k[n][s]: pin(bar_k[n][s].at([k, 0]), foot[n][s].at([0, 0]))
                        low_c[n][s]: pin(bar_c[n][s].at([c, 0]), foot[n][s].at([0, 0]))
                        heel[n][s]: pin(bar_f[n][s].at([f, 0]), foot[n][s].at([g, 0]))
                    } }
                }
                forces { torque(crank, torque - drag * crank.omega) }
                output { for n in 0..PAIRS { for s in 0..SIDES { step[n][s] [m] = foot[n][s].at(toe(s)) } } }
            }
        }

        impl $name {
            /// The joints of leg (n, s) with the crank at `angle`, rad: the knee on the left of the line from hip to crank pin where
            /// `left[0]`, the lower joint where `left[1]`, the heel on the left of that from the outer end to the lower joint where
            /// `left[2]`; of legs with s = 1 seen in the mirror. `None` where bars do not reach. Jansen's is `[true, false, false]`.
            #[must_use]
            pub fn joints(&self, angle: f64, (n, s): (usize, usize), left: [bool; 3]) -> Option<$crate::jansen::Joints> {
                use $crate::jansen::meet;
                let side = 1.0 - 2.0 * s as f64;
                let (sin, cos) = (angle + std::f64::consts::TAU / 3.0 * n as f64).sin_cos();
                let (hip, pin) = ([-self.a, -self.l], [side * self.m * cos, self.m * sin]);
                let knee = meet(hip, self.b, pin, self.j, left[0])?;
                let low = meet(hip, self.c, pin, self.k, left[1])?;
                let outer = meet(hip, self.d, knee, self.e, true)?;
                let heel = meet(outer, self.f, low, self.g, left[2])?;
                let toe = meet(low, self.i, heel, self.h, true)?;
                Some([pin, knee, low, outer, heel, toe].map(|[x, y]| [side * x, y]))
            }

            /// The crank at `angle`, rad, and the bodies of the legs where `joints`, drawn as well as may be, have them: (n, s) to joints.
            #[must_use]
            pub fn drawn(&self, angle: f64, mut joints: impl FnMut(usize, usize) -> $crate::jansen::Joints) -> ukcore::State {
                let mut state = ukcore::State::zeros::<Self>();
                state.q[Self::CRANK_ANGLE] = angle;
                for n in 0..Self::PAIRS {
                    for s in 0..Self::SIDES {
                        let [pin, knee, low, outer, heel, toe] = joints(n, s);
                        let hip = [self.a * (2.0 * s as f64 - 1.0), -self.l];
                        let mut enter = |x: usize, from: [f64; 2], to: [f64; 2], corners: &[[f64; 2]]| {
                            let mean = |k: usize| corners.iter().map(|p| p[k]).sum::<f64>() / corners.len() as f64;
                            (state.q[x], state.q[x + 1]) = (mean(0), mean(1));
                            state.q[x + 2] = (to[1] - from[1]).atan2(to[0] - from[0]);
                        };
                        enter(Self::BAR_J_X[n][s], pin, knee, &[pin, knee]);
                        enter(Self::BAR_K_X[n][s], pin, low, &[pin, low]);
                        enter(Self::BAR_C_X[n][s], hip, low, &[hip, low]);
                        enter(Self::BAR_F_X[n][s], outer, heel, &[outer, heel]);
                        enter(Self::THIGH_X[n][s], hip, knee, &[hip, knee, outer]);
                        enter(Self::FOOT_X[n][s], low, heel, &[low, heel, toe]);
                    }
                }
                state
            }
        }

        impl ukcore::model::Model for $name {
            fn starts() -> &'static [ukcore::model::StartSpec] {
                &[$crate::jansen::TURNING]
            }

            fn start(&self, name: &str, options: &ukcore::model::StartOptions) -> Result<ukcore::State, ukcore::Error> {
                let [angle, speed] = ukcore::model::Chosen::among(Self::starts(), name, options)?.values();
                let mut missing = None;
                let mut sketch = self.drawn(angle, |n, s| {
                    self.joints(angle, (n, s), [true, false, false]).unwrap_or_else(|| {
                        missing = Some((n, s));
                        Default::default()
                    })
                });
                if let Some((n, s)) = missing {
                    let reason = format!("is {angle} rad; there the bars of leg ({n}, {s}) do not reach each other");
                    return Err(ukcore::Error::InvalidSetting { what: "angle", reason });
                }
                sketch.v[Self::CRANK_ANGLE] = speed;
                ukcore::assemble(self, sketch, &["crank.angle"])
            }
        }
    };
}

legs! {
    /// Theo Jansen's leg with his proportions: eleven bars, one crank, one degree of freedom.
    ///
    /// Jansen, The Great Pretender, 2007: a = 38 cm and so on, bars `b` to `k` by his letters, `l` and `m` the height of the crank and its
    /// throw. Bars are uniform; the triangles b, d, e (`thigh`) and g, h, i (`foot`) are rigid. y points up.
    JansenLeg, 1, 1
}

legs! {
    /// Six of Theo Jansen's legs on one crank shaft, in mirrored pairs whose throws are 120° apart; the frame stands still.
    ///
    /// Proportions and names as in `JansenLeg`.
    Walker, 3, 2
}

/// The point at the distance r from p and s from q, to the left of the way from p to q or to its right.
#[doc(hidden)]
#[must_use]
pub fn meet(p: Point, r: f64, q: Point, s: f64, left: bool) -> Option<Point> {
    let [dx, dy] = [q[0] - p[0], q[1] - p[1]];
    let square = dx * dx + dy * dy;
    let along = (square + r * r - s * s) / (2.0 * square);
    let across = (r * r / square - along * along).sqrt();
    let across = if left { across } else { -across };
    let place = [
        p[0] + along * dx - across * dy,
        p[1] + along * dy + across * dx,
    ];
    (!across.is_nan()).then_some(place)
}

/// The start of all legs.
#[doc(hidden)]
pub const TURNING: StartSpec = StartSpec {
    name: "turning",
    doc: "crank at an angle, turning",
    options: &[
        StartOption {
            name: "angle",
            doc: "angle of the crank",
            default: 0.0,
            unit: "rad",
        },
        StartOption {
            name: "speed",
            doc: "angular velocity of the crank",
            default: 4.0,
            unit: "rad/s",
        },
    ],
};
