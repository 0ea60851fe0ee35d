//! Mechanisms with more constraints than they need, which shows on the constraints alone.

use tests::{at_rest, corner};
use ukcore::State;

ukcore::multibody! {
    /// A plane four-bar linkage of spatial bodies and hinges, as it comes out of a drawing: three of the 20 hinge rows follow from the
    /// rest.
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
        let coupler = dy.atan2(dx) + corner(l2, dx.hypot(dy), l3);
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
        at_rest(&q)
    }
}
