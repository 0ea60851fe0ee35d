//! Jansen's legs on one shaft by hand, in the one degree of freedom of the shaft.
//!
//! A joint at the ends of two rods has the acceleration t θ̈ + s, which the rods give from those of their other ends, one after the other.
//! Then θ̈ follows from (j + m Σ t²) θ̈ = moment − m Σ t·(s + g).

use nalgebra::Vector2;

/// Parameters, as the declared model has them.
#[derive(Clone, Copy)]
pub(crate) struct Legs<const N: usize> {
    /// From the pin to the hip, sideways and down, and the throw of the crank.
    pub(crate) hip: [f64; 2],
    pub(crate) throw: f64,
    pub(crate) torque: f64,
    pub(crate) drag: f64,
    pub(crate) g: f64,
    pub(crate) mass: f64,
    pub(crate) inertia: f64,
    pub(crate) phase: [f64; N],
    pub(crate) side: [f64; N],
}

/// Joints of a leg.
const JOINTS: usize = 5;

/// A point that moves with the shaft.
#[derive(Clone, Copy)]
struct Point {
    place: Vector2<f64>,
    velocity: Vector2<f64>,
    /// t.
    slope: Vector2<f64>,
    /// s.
    known: Vector2<f64>,
}

impl Point {
    /// A point at (`place`, `velocity`) with rods to `a` and to `b`.
    fn joined(place: Vector2<f64>, velocity: Vector2<f64>, a: &Point, b: &Point) -> Self {
        let rods = [place - a.place, place - b.place];
        let [one, other] = rods;
        let inverse = 1.0 / one.perp(&other);
        let solved = |x: f64, y: f64| {
            Vector2::new(x * other.y - y * one.y, y * one.x - x * other.x) * inverse
        };
        let square = |of: &Point| (velocity - of.velocity).norm_squared();
        Point {
            place,
            velocity,
            slope: solved(one.dot(&a.slope), other.dot(&b.slope)),
            known: solved(
                one.dot(&a.known) - square(a),
                other.dot(&b.known) - square(b),
            ),
        }
    }
}

impl<const N: usize> Legs<N> {
    /// q̈ at (q, q̇): of the shaft, then of all joints.
    #[inline(never)]
    pub(crate) fn acceleration(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        let (angle, speed) = (q[0], v[0]);
        let mut points = [[(Vector2::zeros(), Vector2::zeros()); JOINTS]; N];
        let (mut inertia, mut drive) = (0.0, 0.0);
        for (n, of) in points.iter_mut().enumerate() {
            let at = |of: &[f64], k: usize| {
                Vector2::new(of[1 + 2 * (JOINTS * n + k)], of[2 + 2 * (JOINTS * n + k)])
            };
            let joined = |k: usize, a: &Point, b: &Point| Point::joined(at(q, k), at(v, k), a, b);
            let (s, c) = (angle + self.phase[n]).sin_cos();
            let (along, across) = (
                Vector2::new(c, s) * self.throw,
                Vector2::new(-s, c) * self.throw,
            );
            let tip = Point {
                place: along,
                velocity: across * speed,
                slope: across,
                known: along * (-speed * speed),
            };
            let still = Vector2::zeros();
            let base = Point {
                place: Vector2::new(-self.hip[0] * self.side[n], -self.hip[1]),
                velocity: still,
                slope: still,
                known: still,
            };
            let knee = joined(0, &tip, &base);
            let back = joined(1, &knee, &base);
            let low = joined(2, &tip, &base);
            let heel = joined(3, &back, &low);
            let toe = joined(4, &heel, &low);
            for (of, point) in of.iter_mut().zip([knee, back, low, heel, toe]) {
                let Point { slope, known, .. } = point;
                inertia += slope.norm_squared();
                drive += slope.dot(&known) + slope.y * self.g;
                *of = (slope, known);
            }
        }
        let moment = self.torque - self.drag * speed;
        let angular = (moment - self.mass * drive) / (self.inertia + self.mass * inertia);
        out[0] = angular;
        for (out, (slope, known)) in out[1..].chunks_exact_mut(2).zip(points.iter().flatten()) {
            out.copy_from_slice((slope * angular + known).as_slice());
        }
    }
}
