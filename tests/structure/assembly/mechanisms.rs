//! Mechanisms to be assembled from guesses.

ukcore::multibody! {
    /// Rows through a known place p: sums of functions, one of them nearly linear, with a product; and a square that the first one implies.
    pub(super) Rows {
        params { k[12] = 1.0, h[3] = 0.0, p[4] = 0.0, s[4] = 1.0, m[4] = 1.0, l[4] = 1.0, w = 0.0 }
        coords { x[4] }
        mass { for i in 0..4 { x[i]: m[i] } }
        let f = |i, a, b, c, d| k[4 * i] * sin(a) + k[4 * i + 1] * sin(b) + k[4 * i + 2] * c + k[4 * i + 3] * d + h[i] * a * c;
        let now = sin(w * t);
        holonomic {
            for i in 0..3 {
                row[i]: s[i] * f(i, x[0] / l[0], x[1] / l[1], x[2] / l[2], x[3] / l[3]) = s[i] * (f(i, p[0], p[1], p[2], p[3]) + now)
            }
            again: s[3] * sq(f(0, x[0] / l[0], x[1] / l[1], x[2] / l[2], x[3] / l[3]) + 3)
                = s[3] * sq(f(0, p[0], p[1], p[2], p[3]) + now + 3)
        }
    }
}

ukcore::multibody! {
    /// A body on a hinge along the space axis y, by a quaternion that is zero in two places.
    pub(super) Hinge {
        params { l = 0.5, m = 1.0, turn = 0.0, w = 0.0 }
        coords { x, y, z, e0, e1, e2, e3 }
        mass { x: m, y: m, z: m, e0: 0.1 * m * sq(l), e1: 0.1 * m * sq(l), e2: 0.1 * m * sq(l), e3: 0.1 * m * sq(l) }
        holonomic {
            unit: sq([e0, e1, e2, e3]) = 1
            axis: [2 * (e1 * e2 - e0 * e3), 2 * (e2 * e3 + e0 * e1)] = [0, 0]
            arm: [x, y, z] = l * [1 - 2 * (sq(e2) + sq(e3)), 2 * (e1 * e2 + e0 * e3), 2 * (e1 * e3 - e0 * e2)]
            drive: 2 * (e1 * e3 - e0 * e2) = sin(turn + w * t)
        }
    }
}

ukcore::multibody! {
    /// A walking leg: a crank, and points that hang on two others each.
    pub(super) Leg {
        params { r = 1.0, a[8] = 1.0, ox = -2.0, oy = -0.3, w = 1.0 }
        coords { th, x[4], y[4] }
        mass { th: sq(r), for i in 0..4 { x[i]: 1, y[i]: 1 } }
        let cx = r * cos(th);
        let cy = r * sin(th);
        let d = |u, v, p, q| sq(u - p) + sq(v - q);
        holonomic {
            drive: th = w * t
            rod[0]: d(x[0], y[0], cx, cy) = sq(a[0]), rod[1]: d(x[0], y[0], ox, oy) = sq(a[1])
            rod[2]: d(x[1], y[1], cx, cy) = sq(a[2]), rod[3]: d(x[1], y[1], ox, oy) = sq(a[3])
            rod[4]: d(x[2], y[2], x[0], y[0]) = sq(a[4]), rod[5]: d(x[2], y[2], ox, oy) = sq(a[5])
            rod[6]: d(x[3], y[3], x[2], y[2]) = sq(a[6]), rod[7]: d(x[3], y[3], x[1], y[1]) = sq(a[7])
        }
    }
}

ukcore::multibody! {
    /// Three cranks on a coupler, one of them redundant.
    pub(super) Cranks {
        params { l = 1.0, d = 2.0, s = 1.0 }
        coords { x[3], y[3] }
        mass { for i in 0..3 { x[i]: 1, y[i]: 1 } }
        holonomic {
            for i in 0..3 { crank[i]: sq(x[i] - i * d) + sq(y[i]) = sq(l) }
            coupler: [x[1] - x[0], y[1] - y[0]] = [d, 0]
            last: [s * (x[2] - x[1]), s * (y[2] - y[1])] = [s * d, 0]
        }
    }
}

ukcore::multibody! {
    /// A loop in joint angles, and two rows that it implies: their lengths are 1, whatever the angles are.
    pub(super) Angles {
        params { a = 0.7, b = 0.9, c[3] = 1.0, s = 1.0 }
        coords { u, v, w }
        mass { u: c[0], v: c[1], w: c[2] }
        holonomic {
            far: [sin(v + 0.3) + sin(w + 0.2), sin(w + 0.4) - 3 * sin(v + 0.1)]
                = [sin(a * u + 0.3) + sin(b * u + 0.2), sin(b * u + 0.4) - 3 * sin(a * u + 0.1)]
            near: s * sin(w) = s * sin(b * u)
            nearer: sin(v) + sin(w) = sin(a * u) + sin(b * u)
        }
    }
}

ukcore::multibody! {
    /// A sledge that its blade leads, at a speed that is prescribed by its square.
    pub(super) Sledge {
        params { l = 1.0, speed = 1.0, m = 1.0, turn = 0.0 }
        coords { x, y, th, s }
        mass { x: m, y: m, th: m * sq(l), s: m }
        holonomic { path: s = l * sin(th) }
        nonholonomic {
            blade: dot(x) * sin(th) = dot(y) * cos(th)
            pace: sq(dot(x)) + sq(dot(y)) = sq(speed)
            swing: dot(s) * cos(th) = l * turn * sq(cos(th))
        }
    }
}

ukcore::multibody! {
    /// Points at the ends of short rods, or of none.
    pub(super) Short {
        params { l = 1.0, a = 0.0, b = 0.0, far = 1.0 }
        coords { x, y, u, v }
        mass { x: 1, y: 1, u: 1, v: 1 }
        holonomic {
            rod: sq(x - a) + sq(y - b) = sq(l)
            next: sq(u - x) + sq(v - y) = sq(far)
            level: v = y
        }
    }
}

ukcore::multibody! {
    /// A bead on a wave along x, and on a ramp.
    pub(super) Wave {
        params { l = 1.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        holonomic { wave: y = l * sin(x / l), ramp: y = 0.2 * x + 0.5 * l }
    }
}
