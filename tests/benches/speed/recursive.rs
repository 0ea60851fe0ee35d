//! Recursions written by hand: what the emitted code of the mechanisms in `machines.rs` is measured beside.

use models::{RigidBody, SliderCrank};
use nalgebra::{Matrix2, Matrix3, RowVector3, Vector2, Vector3};

/// Inertia of a link and what hangs on it, [A B; Bᵀ M], from (ω, v) of its near end to moment and force.
#[derive(Clone, Copy)]
struct Inertia {
    a: Matrix3<f64>,
    b: Matrix3<f64>,
    m: Matrix3<f64>,
}

type Pair = (Vector3<f64>, Vector3<f64>);

impl Inertia {
    fn times(&self, (w, v): &Pair) -> Pair {
        (self.a * w + self.b * v, self.b.tr_mul(w) + self.m * v)
    }
}

/// A link on the way out.
#[derive(Clone, Copy)]
struct Link {
    /// From the axes of the link before.
    turn: Matrix3<f64>,
    /// The hinge's axis.
    axis: Vector3<f64>,
    /// (ω, v) of the near end, and the part of its rate that is known.
    velocity: Pair,
    rate: Pair,
    /// Articulated inertia and force.
    inertia: Inertia,
    force: Pair,
    /// Column of the inertia at the axis, its share on the axis, and what drives the hinge.
    column: Pair,
    pivot: f64,
    drive: f64,
}

/// Parameters of an arm.
#[derive(Clone, Copy)]
pub(crate) struct Arm {
    pub(crate) m: f64,
    pub(crate) l: f64,
    pub(crate) inertia: [f64; 3],
    pub(crate) g: f64,
}

impl Arm {
    fn hinge(k: usize, angle: f64) -> (Matrix3<f64>, Vector3<f64>) {
        let (s, c) = angle.sin_cos();
        match k % 6 {
            3 => (
                Matrix3::new(1.0, 0.0, 0.0, 0.0, c, s, 0.0, -s, c),
                Vector3::x(),
            ),
            1 | 2 | 4 => (
                Matrix3::new(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c),
                Vector3::y(),
            ),
            _ => (
                Matrix3::new(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0),
                Vector3::z(),
            ),
        }
    }

    /// A link alone, which moves at `velocity` without its own hinge, whose rate is `speed`.
    fn link(&self, turn: Matrix3<f64>, axis: Vector3<f64>, (w, v): Pair, speed: f64) -> Link {
        let spin = axis * speed;
        let rate = (w.cross(&spin), v.cross(&spin));
        let w = w + spin;
        let middle = Vector3::new(0.5 * self.l, 0.0, 0.0);
        let offset = middle.cross_matrix();
        let inertia = Inertia {
            a: Matrix3::from_diagonal(&Vector3::from(self.inertia)) - self.m * offset * offset,
            b: self.m * offset,
            m: Matrix3::from_diagonal_element(self.m),
        };
        let (moment, push) = inertia.times(&(w, v));
        let none = (Vector3::zeros(), Vector3::zeros());
        Link {
            turn,
            axis,
            velocity: (w, v),
            rate,
            inertia,
            force: (w.cross(&moment) + v.cross(&push), w.cross(&push)),
            column: none,
            pivot: 0.0,
            drive: 0.0,
        }
    }

    /// q̈ at (q, q̇) by the articulated-body recursion (Featherstone, Rigid Body Dynamics Algorithms, table 7.1), in blocks of 3 × 3.
    #[inline(never)]
    pub(crate) fn acceleration<const N: usize>(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        let still = (Vector3::zeros(), Vector3::zeros());
        let arm = Vector3::new(self.l, 0.0, 0.0);
        let place = |k: usize| if k == 0 { Vector3::zeros() } else { arm };
        let (turn, axis) = Self::hinge(0, q[0]);
        let mut links = [self.link(turn, axis, still, v[0]); N];
        for k in 1..N {
            let (turn, axis) = Self::hinge(k, q[k]);
            let (w, u) = links[k - 1].velocity;
            links[k] = self.link(turn, axis, (turn * w, turn * (u + w.cross(&arm))), v[k]);
        }
        for k in (0..N).rev() {
            let link = &mut links[k];
            let column = (
                link.inertia.a * link.axis,
                link.inertia.b.tr_mul(&link.axis),
            );
            link.column = column;
            link.pivot = 1.0 / link.axis.dot(&column.0);
            link.drive = -link.axis.dot(&link.force.0);
            if k == 0 {
                break;
            }
            let left = (column.0 * link.pivot, column.1 * link.pivot);
            let rest = Inertia {
                a: link.inertia.a - column.0 * left.0.transpose(),
                b: link.inertia.b - column.0 * left.1.transpose(),
                m: link.inertia.m - column.1 * left.1.transpose(),
            };
            let known = rest.times(&link.rate);
            let moment = link.force.0 + known.0 + left.0 * link.drive;
            let push = link.force.1 + known.1 + left.1 * link.drive;
            let turn = link.turn;
            let turned = |x: Matrix3<f64>| turn.tr_mul(&(x * turn));
            let (a, b, m) = (turned(rest.a), turned(rest.b), turned(rest.m));
            let (moment, push) = (turn.tr_mul(&moment), turn.tr_mul(&push));
            let offset = arm.cross_matrix();
            let moved = b + offset * m;
            let before = &mut links[k - 1];
            before.inertia.a += a - b * offset + offset * moved.transpose();
            before.inertia.b += moved;
            before.inertia.m += m;
            before.force.0 += moment + arm.cross(&push);
            before.force.1 += push;
        }
        let mut rate = (Vector3::zeros(), Vector3::new(0.0, 0.0, self.g));
        for (k, link) in links.iter().enumerate() {
            let (w, u) = rate;
            let spin = link.turn * w + link.rate.0;
            let push = link.turn * (u + w.cross(&place(k))) + link.rate.1;
            let known = link.column.0.dot(&spin) + link.column.1.dot(&push);
            out[k] = (link.drive - known) * link.pivot;
            rate = (spin + link.axis * out[k], push);
        }
    }
}

/// Parameters of a planar chain.
#[derive(Clone, Copy)]
pub(crate) struct Planar {
    pub(crate) m: f64,
    pub(crate) l: f64,
    pub(crate) j: f64,
    pub(crate) g: f64,
}

impl Planar {
    /// q̈ of places and angles at (θ, θ̇). The rods from a hinge outwards answer an acceleration a of the hinge by the force P a + p.
    #[inline(never)]
    pub(crate) fn acceleration<const N: usize>(&self, th: &[f64], w: &[f64], out: &mut [f64]) {
        let Self { m, l, j, g } = *self;
        let mut along = [Vector2::zeros(); N];
        let mut answers = [(Vector2::zeros(), 0.0); N];
        let (mut inertia, mut force) = (Matrix2::zeros(), Vector2::zeros());
        for k in (0..N).rev() {
            let (s, c) = th[k].sin_cos();
            let e = Vector2::new(c, s);
            let across = Vector2::new(-s, c);
            let pulled = inertia * e * l;
            let h = across * (0.5 * m * l) + inertia * across * l;
            let pivot = 1.0 / (j + l * (0.25 * m * l + l * across.dot(&(inertia * across))));
            let square = w[k] * w[k];
            let drive = 0.5 * m * l * g * c + l * across.dot(&(force - pulled * square));
            answers[k] = (h * pivot, drive * pivot);
            along[k] = e;
            force += Vector2::new(0.0, m * g)
                - (e * (0.5 * m * l) + pulled) * square
                - h * (drive * pivot);
            inertia += Matrix2::from_diagonal_element(m) - h * (h * pivot).transpose();
        }
        let mut near = Vector2::zeros();
        for k in 0..N {
            let (slope, known) = answers[k];
            let angular = -slope.dot(&near) - known;
            let e = along[k];
            let half = (Vector2::new(-e.y, e.x) * angular - e * (w[k] * w[k])) * (0.5 * l);
            let middle = near + half;
            (out[2 * k], out[2 * k + 1], out[2 * N + k]) = (middle.x, middle.y, angular);
            near = middle + half;
        }
    }
}

/// q̈ of the slider-crank in its one degree of freedom: θ̈2 = κ θ̈1 + β by the guide, and all places by tangents and what is known.
#[inline(never)]
pub(crate) fn slider_crank(p: &SliderCrank, q: &[f64], v: &[f64], out: &mut [f64]) {
    let ((s1, c1), (s2, c2)) = (q[2].sin_cos(), q[5].sin_cos());
    let (x1, y1, half) = (p.r * c1, p.r * s1, 0.5 * p.l);
    let (x2, y2) = (half * c2, half * s2);
    let (w1, w2) = (v[2] * v[2], v[5] * v[5]);
    let inverse = 0.5 / x2;
    let (slope, known) = (-x1 * inverse, (y1 * w1 + 2.0 * y2 * w2) * inverse);
    let turn = (-y2 * slope, x2 * slope);
    let rod = (-x2 * w2 - y2 * known, x2 * known - y2 * w2);
    let (tx, ty) = (turn.0 - y1, turn.1 + x1);
    let (bx, by) = (rod.0 - x1 * w1, rod.1 - y1 * w1);
    let (t3, b3) = (tx + turn.0, bx + rod.0);
    let inertia = 0.25 * p.m1 * p.r * p.r
        + p.i1
        + p.m2 * (tx * tx + ty * ty)
        + p.i2 * slope * slope
        + p.m3 * t3 * t3;
    let drive = p.torque
        - 0.5 * p.m1 * p.g * x1
        - p.m2 * (ty * (p.g + by) + tx * bx)
        - p.i2 * slope * known
        - p.m3 * t3 * b3;
    let angular = drive / inertia;
    out.copy_from_slice(&[
        -0.5 * (y1 * angular + x1 * w1),
        0.5 * (x1 * angular - y1 * w1),
        angular,
        tx * angular + bx,
        ty * angular + by,
        slope * angular + known,
        t3 * angular + b3,
        0.0,
        0.0,
    ]);
}

/// ë of a free body: Euler's equations, ë = ½ Gᵀ ω̇ − |ė|² e with |e| = 1.
#[inline(never)]
pub(crate) fn rigid_body(p: &RigidBody, e: &[f64], v: &[f64], out: &mut [f64]) {
    let (im, rate) = (
        Vector3::new(e[1], e[2], e[3]),
        Vector3::new(v[1], v[2], v[3]),
    );
    let w = 2.0 * (e[0] * rate - v[0] * im - im.cross(&rate));
    let a = Vector3::new(
        (p.i2 - p.i3) / p.i1 * w.y * w.z,
        (p.i3 - p.i1) / p.i2 * w.z * w.x,
        (p.i1 - p.i2) / p.i3 * w.x * w.y,
    );
    let square = v[0] * v[0] + rate.norm_squared();
    out[0] = -0.5 * im.dot(&a) - square * e[0];
    let vector: RowVector3<f64> = (0.5 * (e[0] * a + im.cross(&a)) - square * im).transpose();
    out[1..].copy_from_slice(vector.as_slice());
}
