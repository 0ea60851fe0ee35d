//! Declarations of mechanisms that come in several sizes, as macros: tests and benchmarks expand the sizes they need.

/// `arm!(Name, n)`: a serial arm of n hinges, a multiple of 6, in joint angles. Hinge axes are z, y, y, x, y, z of the link before and
/// again; links have length l along their x axes, mass m in their middle and principal moments of inertia `inertia`. Gravity points along
/// −z. (w: angular velocity of each link, v: velocity of its near end, up: the vertical, all in axes of the link; h: height of its near
/// end.)
#[macro_export]
macro_rules! arm {
    ($name:ident, $n:literal) => {
        ukcore::multibody! {
            pub $name {
                const N: usize = $n;
                params { m = 1.0, l = 0.5, inertia[3] = [0.01, 0.03, 0.03], g = 9.81 }
                coords { q[N] }
                let axes = |a| [transpose(rotz(a)), transpose(roty(a)), transpose(roty(a)), transpose(rotx(a)), transpose(roty(a)), transpose(rotz(a))];
                let along = |i, rate| rate * [[0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]][i - 6 * (i / 6)];
                let into = |i, u| axes(q[i])[i - 6 * (i / 6)] * u;
                let {
                    w[0] = [0, 0, dot(q[0])]
                    v[0] = [0, 0, 0]
                    up[0] = [0, 0, 1]
                    h[0] = 0
                    for i in 1..N {
                        w[i] = into(i, w[i - 1]) + along(i, dot(q[i]))
                        v[i] = into(i, v[i - 1] + cross(w[i - 1], [l, 0, 0]))
                        up[i] = into(i, up[i - 1])
                        h[i] = h[i - 1] + l * up[i - 1][0]
                    }
                }
                let energy = |v, w| 0.5 * m * sq(v) + 0.5 * (inertia[0] * sq(w[0]) + inertia[1] * sq(w[1]) + inertia[2] * sq(w[2]));
                kinetic { for i in 0..N { energy(v[i] + cross(w[i], [l / 2, 0, 0]), w[i]) } }
                potential { for i in 0..N { m * g * (h[i] + l / 2 * up[i][0]) } }
            }
        }
    };
}

/// `hinges!(Name, n)`: the same arm as bodies with places and quaternions, whose hinges are constraints.
#[macro_export]
macro_rules! hinges {
    ($name:ident, $n:literal) => {
        ukcore::multibody! {
            pub $name {
                const N: usize = $n;
                params { m = 1.0, l = 0.5, inertia[3] = [0.01, 0.03, 0.03], g = 9.81 }
                gravity { [0, 0, -g] }
                bodies { for i in 0..N { spatial link[i] { mass: m, inertia: inertia, centre: [l / 2, 0, 0] } } }
                let axis = |i| [[0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]][i - 6 * (i / 6)];
                holonomic {
                    first: hinge(ground.at([0, 0, 0]), link[0].at([0, 0, 0]), axis(0))
                    for i in 1..N { joint[i]: hinge(link[i - 1].at([l, 0, 0]), link[i].at([0, 0, 0]), axis(i)) }
                }
            }
        }
    };
}

/// `planar_chain!(Bodies, Angles, n)`: n rods of length l in a plane, hinged to each other and to the ground, as bodies with a place and an
/// angle whose hinges are constraints, and in their absolute angles alone. y points up.
#[macro_export]
macro_rules! planar_chain {
    ($bodies:ident, $angles:ident, $n:literal) => {
        ukcore::multibody! {
            pub $bodies {
                const N: usize = $n;
                params { m = 1.0, l = 0.5, j = 0.02, g = 9.81 }
                coords { p[N][2], th[N] }
                mass { p: m, th: j }
                potential { for i in 0..N { m * g * p[i][1] } }
                let half = |i| l / 2 * [cos(th[i]), sin(th[i])];
                holonomic {
                    ground: p[0] = half(0)
                    for i in 1..N { hinge[i]: p[i - 1] + half(i - 1) = p[i] - half(i) }
                }
            }
        }
        ukcore::multibody! {
            pub $angles {
                const N: usize = $n;
                params { m = 1.0, l = 0.5, j = 0.02, g = 9.81 }
                coords { th[N] }
                let across = |i| [-sin(th[i]), cos(th[i])] * dot(th[i]);
                let {
                    v[0] = [0, 0]
                    h[0] = 0
                    for i in 1..N {
                        v[i] = v[i - 1] + l * across(i - 1)
                        h[i] = h[i - 1] + l * sin(th[i - 1])
                    }
                }
                kinetic { for i in 0..N { 0.5 * m * sq(v[i] + l / 2 * across(i)), 0.5 * j * sq(dot(th[i])) } }
                potential { for i in 0..N { m * g * (h[i] + l / 2 * sin(th[i])) } }
            }
        }
    };
}

/// `crank_and_rod!(Name)`: the slider-crank of three bodies of the crate `models` in the angles of its crank and rod, which one equation
/// closes; the places of its bodies follow, as coordinates without mass.
#[macro_export]
macro_rules! crank_and_rod {
    ($name:ident) => {
        ukcore::multibody! {
            pub $name {
                params { r = 0.1, l = 0.3, m1 = 0.5, m2 = 0.8, m3 = 0.6, i1 = 4.0e-4, i2 = 6.0e-3, g = 9.81, torque = 0.0 }
                coords { th1, th2, p1[2], p2[2], x3 }
                let crank = [cos(th1), sin(th1)];
                let rod = [cos(th2), sin(th2)];
                let middle = r * crank + l / 2 * rod;
                let slider = r * crank[0] + l * rod[0];
                kinetic {
                    0.5 * (i1 + m1 * sq(r / 2)) * sq(dot(th1)), 0.5 * m2 * sq(dot(middle)), 0.5 * i2 * sq(dot(th2)), 0.5 * m3 * sq(dot(slider))
                }
                potential { m1 * g * r / 2 * crank[1], m2 * g * middle[1], -torque * th1 }
                holonomic {
                    guide: r * crank[1] + l * rod[1] = 0
                    follow: [p1[0], p1[1], p2[0], p2[1], x3] = [r / 2 * crank[0], r / 2 * crank[1], middle[0], middle[1], slider]
                }
            }
        }
    };
}

/// `legs!(Name, n)`: n legs after Theo Jansen on one shaft, in pairs that are mirror images, the cranks of the pairs a third of a turn
/// apart. `legs!(Name, n, own)`: the same with an angle for each leg, and the shaft as constraints between them.
#[macro_export]
macro_rules! legs {
    ($name:ident, $n:literal) => {
        $crate::legs!(@ $name, $n, [th], [th: jc], [th: torque - drag * dot(th)], [], [th]);
    };
    ($name:ident, $n:literal, own) => {
        $crate::legs!(@ $name, $n, [th[LEGS]], [th: jc], [th[0]: torque - drag * dot(th[0])],
            [for n in 1..LEGS { shaft[n]: th[n] = th[n - 1] }], [th[n]]);
    };
    (@ $name:ident, $n:literal, [$($coords:tt)*], [$($mass:tt)*], [$($force:tt)*], [$($shaft:tt)*], [$($angle:tt)*]) => {
        ukcore::multibody! {
            pub $name {
                const LEGS: usize = $n;
                params {
                    a = 3.80, b = 4.15, c = 3.93, d = 4.01, e = 5.58, f = 3.94, g = 3.67, h = 6.57, i = 4.90, j = 5.00, k = 6.19, l = 0.78,
                    m = 1.5, torque = 100.0, drag = 50.0, grav = 98.1, mass = 0.2, jc = 1.0, phase[LEGS] = 0.0, side[LEGS] = 1.0,
                }
                coords { $($coords)*, p[LEGS][5][2] }
                let tip = |n| m * [cos($($angle)* + phase[n]), sin($($angle)* + phase[n])];
                let base = |n| [-a * side[n], -l];
                mass { $($mass)*, p: mass }
                potential { for n in 0..LEGS { for joint in 0..5 { mass * grav * p[n][joint][1] } } }
                force { $($force)* }
                holonomic {
                    $($shaft)*
                    for n in 0..LEGS {
                        rj[n]: sq(p[n][0] - tip(n)) = sq(j)
                        rb[n]: sq(p[n][0] - base(n)) = sq(b)
                        re[n]: sq(p[n][0] - p[n][1]) = sq(e)
                        rd[n]: sq(p[n][1] - base(n)) = sq(d)
                        rk[n]: sq(p[n][2] - tip(n)) = sq(k)
                        rc[n]: sq(p[n][2] - base(n)) = sq(c)
                        rf[n]: sq(p[n][1] - p[n][3]) = sq(f)
                        rg[n]: sq(p[n][2] - p[n][3]) = sq(g)
                        rh[n]: sq(p[n][3] - p[n][4]) = sq(h)
                        ri[n]: sq(p[n][2] - p[n][4]) = sq(i)
                    }
                }
            }
        }
    };
}

/// `four_bars!(Name, n)`: n four-bar linkages in a row that share their cranks, as the model has four of.
#[macro_export]
macro_rules! four_bars {
    ($name:ident, $n:literal) => {
        ukcore::multibody! {
            pub $name {
                const N: usize = $n;
                params { m = 1.0, l = 1.0, g = 9.81 }
                coords { x[N + 1], y[N + 1] }
                kinetic {
                    for i in 0..N + 1 { m / 6.0 * (sq(dot(x[i])) + sq(dot(y[i]))) }
                    for i in 0..N {
                        m / 6.0 * (sq(dot(x[i])) + dot(x[i]) * dot(x[i + 1]) + sq(dot(x[i + 1]))),
                        m / 6.0 * (sq(dot(y[i])) + dot(y[i]) * dot(y[i + 1]) + sq(dot(y[i + 1]))),
                    }
                }
                potential {
                    for i in 0..N + 1 { m * g * y[i] / 2.0 }
                    for i in 0..N { m * g * (y[i] + y[i + 1]) / 2.0 }
                }
                holonomic {
                    for i in 0..N + 1 { crank[i]: sq(x[i] - i * l) + sq(y[i]) = sq(l) }
                    for i in 0..N { coupler[i]: sq(x[i + 1] - x[i]) + sq(y[i + 1] - y[i]) = sq(l) }
                }
            }
        }
    };
}
