//! Mechanisms with more constraints than they need, which shows on the constraints alone.

use ukcore::State;

ukcore::multibody! {
    /// Bricard's linkage: five rods of 1 m and 1 kg with a square section of 0.1 m, six hinges, of which the first and the last stand on
    /// the ground. Of its 30 hinge rows 29 are independent where all are met, 30 elsewhere. Bodies are turned by quaternions from how
    /// they stand in the edges of a cube; gravity points along −y.
    pub Bricard {
        params { m = 1.0, across = 1.01 / 12.0, along = 0.02 / 12.0, g = 9.81 }
        coords { x[5], y[5], z[5], a[5], b[5], c[5], d[5] }
        let inner = |u, v| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let cross = |u, v| [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let turned = |s, im, v| v + 2.0 * s * cross(im, v) + 2.0 * cross(im, cross(im, v));
        let spin = |s, im, ds, dim| 2.0 * (s * dim - ds * im - cross(im, dim));
        let energy = |i, w| 0.5 * (i[0] * sq(w[0]) + i[1] * sq(w[1]) + i[2] * sq(w[2]));
        kinetic {
            for i in 0..5 { 0.5 * m * (sq(dot(x[i])) + sq(dot(y[i])) + sq(dot(z[i]))) }
            energy([along, across, across], spin(a[0], [b[0], c[0], d[0]], dot(a[0]), dot([b[0], c[0], d[0]])))
            energy([across, along, across], spin(a[1], [b[1], c[1], d[1]], dot(a[1]), dot([b[1], c[1], d[1]])))
            energy([across, across, along], spin(a[2], [b[2], c[2], d[2]], dot(a[2]), dot([b[2], c[2], d[2]])))
            energy([along, across, across], spin(a[3], [b[3], c[3], d[3]], dot(a[3]), dot([b[3], c[3], d[3]])))
            energy([across, along, across], spin(a[4], [b[4], c[4], d[4]], dot(a[4]), dot([b[4], c[4], d[4]])))
        }
        potential { for i in 0..5 { m * g * y[i] } }
        let first = |v| turned(a[0], [b[0], c[0], d[0]], v);
        let second = |v| turned(a[1], [b[1], c[1], d[1]], v);
        let third = |v| turned(a[2], [b[2], c[2], d[2]], v);
        let fourth = |v| turned(a[3], [b[3], c[3], d[3]], v);
        let fifth = |v| turned(a[4], [b[4], c[4], d[4]], v);
        holonomic {
            for i in 0..5 { unit[i]: sq(a[i]) + sq(b[i]) + sq(c[i]) + sq(d[i]) = 1.0 }
            p0: [x[0], y[0], z[0]] + first([-0.5, 0.0, 0.0]) = [0.0, 0.0, 0.0]
            axis0: [inner(first([0.0, 1.0, 0.0]), [1.0, 0.0, 0.0]), inner(first([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0])] = [0.0, 0.0]
            p1: [x[0], y[0], z[0]] + first([0.5, 0.0, 0.0]) = [x[1], y[1], z[1]] + second([0.0, 0.5, 0.0])
            axis1: [inner(first([0.0, 0.0, 1.0]), second([1.0, 0.0, 0.0])), inner(first([0.0, 0.0, 1.0]), second([0.0, 1.0, 0.0]))] = [0.0, 0.0]
            p2: [x[1], y[1], z[1]] + second([0.0, -0.5, 0.0]) = [x[2], y[2], z[2]] + third([0.0, 0.0, -0.5])
            axis2: [inner(second([1.0, 0.0, 0.0]), third([0.0, 1.0, 0.0])), inner(second([1.0, 0.0, 0.0]), third([0.0, 0.0, 1.0]))] = [0.0, 0.0]
            p3: [x[2], y[2], z[2]] + third([0.0, 0.0, 0.5]) = [x[3], y[3], z[3]] + fourth([0.5, 0.0, 0.0])
            axis3: [inner(third([0.0, 1.0, 0.0]), fourth([1.0, 0.0, 0.0])), inner(third([0.0, 1.0, 0.0]), fourth([0.0, 0.0, 1.0]))] = [0.0, 0.0]
            p4: [x[3], y[3], z[3]] + fourth([-0.5, 0.0, 0.0]) = [x[4], y[4], z[4]] + fifth([0.0, -0.5, 0.0])
            axis4: [inner(fourth([0.0, 0.0, 1.0]), fifth([1.0, 0.0, 0.0])), inner(fourth([0.0, 0.0, 1.0]), fifth([0.0, 1.0, 0.0]))] = [0.0, 0.0]
            p5: [x[4], y[4], z[4]] + fifth([0.0, 0.5, 0.0]) = [0.0, 0.0, 1.0]
            axis5: [inner(fifth([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]), inner(fifth([1.0, 0.0, 0.0]), [0.0, 0.0, 1.0])] = [0.0, 0.0]
        }
    }
}

impl Bricard {
    /// At rest in the edges of a cube.
    pub fn cube() -> State {
        let mut q = vec![0.5, 1.0, 1.0, 0.5, 0.0];
        q.extend([0.0, -0.5, -1.0, -1.0, -0.5]);
        q.extend([0.0, 0.0, 0.5, 1.0, 1.0]);
        q.extend([1.0; 5]);
        q.extend([0.0; 15]);
        State {
            t: 0.0,
            v: vec![0.0; q.len()],
            q,
        }
    }
}

ukcore::multibody! {
    /// Two Scott-Russell linkages side by side, whose straight-line points carry a table: a crank OA of length l, and a rod BC of length
    /// 2l with its middle in A and its foot B on the x axis, so that C keeps to the y axis, which is said once more.
    pub DoubleScottRussell {
        params { l = 0.4, m = 1.3, mt = 5.0, k = 300.0, g = 9.81 }
        coords { ax[2], ay[2], bx[2], by[2], cx[2], cy[2] }
        mass { for i in 0..2 { ax[i]: m, ay[i]: m, bx[i]: m, by[i]: m, cx[i]: m, cy[i]: m + mt / 2.0 } }
        potential { for i in 0..2 { m * g * (ay[i] + by[i] + cy[i]) + mt * g * cy[i] / 2.0 + k * sq(cy[i] - l) / 2.0 } }
        holonomic {
            for i in 0..2 {
                crank[i]: sq(ax[i]) + sq(ay[i]) = sq(l)
                rod[i]: sq(cx[i] - ax[i]) + sq(cy[i] - ay[i]) = sq(l)
                middle[i]: 2.0 * [ax[i], ay[i]] = [bx[i] + cx[i], by[i] + cy[i]]
                foot[i]: by[i] = 0.0
                straight[i]: cx[i] = 0.0
            }
            table: cy[0] = cy[1]
        }
    }
}

impl DoubleScottRussell {
    /// Cranks at `angle` that turn at `rate`, the first to the right and the second to the left.
    pub fn turning(&self, angle: f64, rate: f64) -> State {
        let (s, c) = angle.sin_cos();
        let (x, y) = (self.l * c, self.l * s);
        let (u, w) = (-y * rate, x * rate);
        let mut q = vec![x, -x, y, y, 2.0 * x, -2.0 * x];
        q.extend([0.0, 0.0, 0.0, 0.0, 2.0 * y, 2.0 * y]);
        let mut v = vec![u, -u, w, w, 2.0 * u, -2.0 * u];
        v.extend([0.0, 0.0, 0.0, 0.0, 2.0 * w, 2.0 * w]);
        State { t: 0.0, q, v }
    }
}

ukcore::multibody! {
    /// A plane four-bar linkage of spatial bodies and hinges, as it comes out of a drawing: three of the 20 hinge rows follow from the rest.
    pub SpatialFourBar {
        params { l1 = 0.4, l2 = 1.1, l3 = 0.8, base = 1.0, m = 1.0, i1 = 0.002, i2 = 0.08, g = 9.81 }
        coords { x[3], y[3], z[3], a[3], b[3], c[3], d[3] }
        let cross = |u, v| [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let turned = |s, im, v| v + 2.0 * s * cross(im, v) + 2.0 * cross(im, cross(im, v));
        let inner = |u, v| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let spin = |s, im, ds, dim| 2.0 * (s * dim - ds * im - cross(im, dim));
        let energy = |w| 0.5 * (i1 * sq(w[0]) + i2 * sq(w[1]) + i2 * sq(w[2]));
        kinetic {
            for i in 0..3 {
                0.5 * m * (sq(dot(x[i])) + sq(dot(y[i])) + sq(dot(z[i])))
                energy(spin(a[i], [b[i], c[i], d[i]], dot(a[i]), dot([b[i], c[i], d[i]])))
            }
        }
        potential { for i in 0..3 { m * g * y[i] } }
        let first = |v| turned(a[0], [b[0], c[0], d[0]], v);
        let second = |v| turned(a[1], [b[1], c[1], d[1]], v);
        let third = |v| turned(a[2], [b[2], c[2], d[2]], v);
        holonomic {
            for i in 0..3 { unit[i]: sq(a[i]) + sq(b[i]) + sq(c[i]) + sq(d[i]) = 1.0 }
            o: [x[0], y[0], z[0]] = first([l1 / 2.0, 0.0, 0.0])
            axis_o: [inner(first([0.0, 0.0, 1.0]), [1.0, 0.0, 0.0]), inner(first([0.0, 0.0, 1.0]), [0.0, 1.0, 0.0])] = [0.0, 0.0]
            p: [x[0], y[0], z[0]] + first([l1 / 2.0, 0.0, 0.0]) = [x[1], y[1], z[1]] - second([l2 / 2.0, 0.0, 0.0])
            axis_p: [inner(first([0.0, 0.0, 1.0]), second([1.0, 0.0, 0.0])), inner(first([0.0, 0.0, 1.0]), second([0.0, 1.0, 0.0]))] = [0.0, 0.0]
            q: [x[1], y[1], z[1]] + second([l2 / 2.0, 0.0, 0.0]) = [x[2], y[2], z[2]] + third([l3 / 2.0, 0.0, 0.0])
            axis_q: [inner(second([0.0, 0.0, 1.0]), third([1.0, 0.0, 0.0])), inner(second([0.0, 0.0, 1.0]), third([0.0, 1.0, 0.0]))] = [0.0, 0.0]
            r: [x[2], y[2], z[2]] - third([l3 / 2.0, 0.0, 0.0]) = [base, 0.0, 0.0]
            axis_r: [inner(third([0.0, 0.0, 1.0]), [1.0, 0.0, 0.0]), inner(third([0.0, 0.0, 1.0]), [0.0, 1.0, 0.0])] = [0.0, 0.0]
        }
    }
}

impl SpatialFourBar {
    /// At rest with the crank at an angle.
    pub fn at(&self, crank: f64) -> State {
        let Self {
            l1, l2, l3, base, ..
        } = *self;
        let p = [l1 * crank.cos(), l1 * crank.sin()];
        let (dx, dy) = (base - p[0], -p[1]);
        let far = dx.hypot(dy);
        let coupler = dy.atan2(dx) + ((l2 * l2 + far * far - l3 * l3) / (2.0 * l2 * far)).acos();
        let end = [p[0] + l2 * coupler.cos(), p[1] + l2 * coupler.sin()];
        let rocker = end[1].atan2(end[0] - base);
        let bodies = [
            (0.5 * p[0], 0.5 * p[1], crank),
            (0.5 * (p[0] + end[0]), 0.5 * (p[1] + end[1]), coupler),
            (0.5 * (base + end[0]), 0.5 * end[1], rocker),
        ];
        let mut q = vec![0.0; 21];
        for (i, (x, y, angle)) in bodies.into_iter().enumerate() {
            let (s, c) = (0.5 * angle).sin_cos();
            (q[i], q[3 + i], q[9 + i], q[18 + i]) = (x, y, c, s);
        }
        State {
            t: 0.0,
            q,
            v: vec![0.0; 21],
        }
    }
}
