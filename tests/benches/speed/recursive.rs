//! Recursions written by hand: what the emitted code of the mechanisms in `machines.rs` is measured beside.

use models::{RigidBody, SliderCrank};
use nalgebra::{Matrix2, Matrix3, Quaternion, UnitQuaternion, Vector2, Vector3};

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
    fn axis(k: usize) -> Vector3<f64> {
        match k % 6 {
            3 => Vector3::x(),
            1 | 2 | 4 => Vector3::y(),
            _ => Vector3::z(),
        }
    }

    fn hinge(k: usize, angle: f64) -> (Matrix3<f64>, Vector3<f64>) {
        let (s, c) = angle.sin_cos();
        let turn = match k % 6 {
            3 => Matrix3::new(1.0, 0.0, 0.0, 0.0, c, s, 0.0, -s, c),
            1 | 2 | 4 => Matrix3::new(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c),
            _ => Matrix3::new(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0),
        };
        (turn, Self::axis(k))
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

    /// q̈ at (q, q̇).
    #[inline(never)]
    pub(crate) fn acceleration<const N: usize>(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        let hinge = |k: usize| {
            let (turn, axis) = Self::hinge(k, q[k]);
            (turn, axis, v[k])
        };
        self.recursion::<N>(hinge, |k, angular, _, _| out[k] = angular);
    }

    /// The same in places and quaternions of the links: ẍ and ë, with |e| = 1.
    #[inline(never)]
    pub(crate) fn in_places<const N: usize>(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        let four = |of: &[f64], k: usize| quaternion(&of[7 * k + 3..]);
        let mut turned = [(Matrix3::identity(), Vector3::zeros()); N];
        for (k, (to_ground, w)) in turned.iter_mut().enumerate() {
            let (e, rate) = (four(q, k), four(v, k));
            *to_ground = UnitQuaternion::new_unchecked(e)
                .to_rotation_matrix()
                .into_inner();
            *w = spin(e, rate);
        }
        let hinge = |k: usize| {
            let (to_ground, w) = turned[k];
            let axis = Self::axis(k);
            let (before, other) = match k {
                0 => (Matrix3::identity(), Vector3::zeros()),
                _ => turned[k - 1],
            };
            let turn = to_ground.tr_mul(&before);
            (turn, axis, axis.dot(&(w - turn * other)))
        };
        let centre = Vector3::new(0.5 * self.l, 0.0, 0.0);
        self.recursion::<N>(hinge, |k, _, (w, u), (a, push)| {
            let own = push + w.cross(&u) + a.cross(&centre) + w.cross(&w.cross(&centre));
            let place = turned[k].0 * own - Vector3::new(0.0, 0.0, self.g);
            let out = &mut out[7 * k..7 * k + 7];
            out[..3].copy_from_slice(place.as_slice());
            out[3..].copy_from_slice(&turning(four(q, k), four(v, k), &a));
        });
    }

    /// The places and quaternions of the links, with their rates, at (q, q̇) in angles.
    pub(crate) fn placed<const N: usize>(&self, q: &[f64], v: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (mut places, mut rates) = (Vec::new(), Vec::new());
        let (mut near, mut moving, mut spin) =
            (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        let mut e = UnitQuaternion::identity();
        let half = Vector3::new(0.5 * self.l, 0.0, 0.0);
        for k in 0..N {
            let (turn, axis) = Self::hinge(k, q[k]);
            e *= UnitQuaternion::new(axis * q[k]);
            spin = turn * spin + axis * v[k];
            let (to_middle, rate) = (e * half, e * spin.cross(&half));
            let turning = e.into_inner() * Quaternion::from_imag(0.5 * spin);
            places.extend((near + to_middle).iter().chain([&e.w, &e.i, &e.j, &e.k]));
            rates.extend(
                (moving + rate)
                    .iter()
                    .chain([&turning.w, &turning.i, &turning.j, &turning.k]),
            );
            near += 2.0 * to_middle;
            moving += 2.0 * rate;
        }
        (places, rates)
    }

    /// The articulated-body recursion (Featherstone, Rigid Body Dynamics Algorithms, table 7.1), in blocks of 3 × 3, over hinges, each the
    /// matrix from the axes of the link before, its axis and its rate. Gives of each its q̈, and of its link's near end (ω, v) and the
    /// rates of these in the link's axes; gravity counts as acceleration.
    fn recursion<const N: usize>(
        &self,
        hinge: impl Fn(usize) -> (Matrix3<f64>, Vector3<f64>, f64),
        mut found: impl FnMut(usize, f64, Pair, Pair),
    ) {
        let still = (Vector3::zeros(), Vector3::zeros());
        let arm = Vector3::new(self.l, 0.0, 0.0);
        let place = |k: usize| if k == 0 { Vector3::zeros() } else { arm };
        let (turn, axis, speed) = hinge(0);
        let mut links = [self.link(turn, axis, still, speed); N];
        for k in 1..N {
            let (turn, axis, speed) = hinge(k);
            let (w, u) = links[k - 1].velocity;
            links[k] = self.link(turn, axis, (turn * w, turn * (u + w.cross(&arm))), speed);
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
            let angular = (link.drive - known) * link.pivot;
            rate = (spin + link.axis * angular, push);
            found(k, angular, link.velocity, rate);
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

/// ω in axes of the body, at a unit quaternion and its rate.
pub(crate) fn spin(e: Quaternion<f64>, rate: Quaternion<f64>) -> Vector3<f64> {
    2.0 * (e.w * rate.imag() - rate.w * e.imag() - e.imag().cross(&rate.imag()))
}

/// ë = ½ Gᵀ ω̇ − |ė|² e, at |e| = 1.
pub(crate) fn turning(e: Quaternion<f64>, rate: Quaternion<f64>, a: &Vector3<f64>) -> [f64; 4] {
    let square = rate.w * rate.w + rate.imag().norm_squared();
    let imag = 0.5 * (e.w * a + e.imag().cross(a)) - square * e.imag();
    let real = -0.5 * e.imag().dot(a) - square * e.w;
    [real, imag.x, imag.y, imag.z]
}

/// The quaternion at the beginning of `of`.
pub(crate) fn quaternion(of: &[f64]) -> Quaternion<f64> {
    Quaternion::new(of[0], of[1], of[2], of[3])
}

/// ë of a free body, by Euler's equations.
#[inline(never)]
pub(crate) fn rigid_body(p: &RigidBody, e: &[f64], v: &[f64], out: &mut [f64]) {
    let (e, rate) = (quaternion(e), quaternion(v));
    let w = spin(e, rate);
    let a = Vector3::new(
        (p.i2 - p.i3) / p.i1 * w.y * w.z,
        (p.i3 - p.i1) / p.i2 * w.z * w.x,
        (p.i1 - p.i2) / p.i3 * w.x * w.y,
    );
    out.copy_from_slice(&turning(e, rate, &a));
}
