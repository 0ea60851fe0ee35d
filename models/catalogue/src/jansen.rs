//! Theo Jansen's leg, and a walker of such legs.

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
                // The point at the distances r from p and s from p + v, on the left of v or, where `side` is −1, on the right.
                let share = |v, r, s| (sq(v) + sq(r) - sq(s)) / (2 * sq(v));
                let meet = |p, v, r, s, side| p + share(v, r, s) * v + side * sqrt(sq(r) / sq(v) - sq(share(v, r, s))) * [-v[1], v[0]];
                let bent = |s, v, r1, r2, side| meet(hip(s), v - hip(s), r1, r2, (1 - 2 * s) * side);
                let at_pin = |n, angle| m * [cos(angle + 2 * PI / 3 * n), sin(angle + 2 * PI / 3 * n)];
                let at_low = |n, s, angle| bent(s, at_pin(n, angle), c, k, -1);
                let at_knee = |n, s, angle| bent(s, at_pin(n, angle), b, j, 1);
                let at_back = |n, s, angle| bent(s, at_knee(n, s, angle), d, e, 1);
                let at_heel = |n, s, angle| meet(at_back(n, s, angle), at_low(n, s, angle) - at_back(n, s, angle), f, g, 2 * s - 1);
                let direction = |u, v| atan2(v[1] - u[1], v[0] - u[0]);
                /// crank at an angle, turning
                start turning(
                    /// Angle of the crank
                    angle = 0.0 [rad],
                    /// Angular velocity of the crank
                    speed = 4.0 [rad/s],
                ) {
                    crank.angle = angle
                    crank.omega = speed
                    for n in 0..PAIRS { for s in 0..SIDES {
                        bar_j[n][s].angle near direction(at_pin(n, angle), at_knee(n, s, angle)),
                        bar_k[n][s].angle near direction(at_pin(n, angle), at_low(n, s, angle)),
                        bar_c[n][s].angle near direction(hip(s), at_low(n, s, angle)),
                        bar_f[n][s].angle near direction(at_back(n, s, angle), at_heel(n, s, angle)),
                        thigh[n][s].angle near direction(hip(s), at_knee(n, s, angle)),
                        foot[n][s].angle near direction(at_low(n, s, angle), at_heel(n, s, angle)),
                    } }
                }
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
