//! Bricard's linkage by hand, in its one degree of freedom.
//!
//! With s_i the axes of the hinges, in axes of the ground, and P_i their places, rates of the angles move what follows the last hinge by
//! Σ s_i θ̇_i and Σ s_i × (P_5 − P_i) θ̇_i, which is not at all: six equations of rank five. What they leave free is one rate, and the
//! accelerations are t α + s with an α that follows from the balance of power.

use nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};

use crate::mechanisms::Bricard;
use crate::recursive::{quaternion, spin, turning};

/// Bodies.
const N: usize = 5;
/// Of the bodies their centres, from the hinge before, in their own axes; the hinge after is as far beyond.
const CENTRES: [[f64; 3]; N] = [
    [0.5, 0.0, 0.0],
    [0.0, -0.5, 0.0],
    [0.0, 0.0, 0.5],
    [-0.5, 0.0, 0.0],
    [0.0, 0.5, 0.0],
];
/// Of the hinges the axes, in axes of the bodies they join.
const AXES: [[f64; 3]; N + 1] = [
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 0.0],
];

/// A body with the hinge before it.
#[derive(Clone, Copy)]
struct Body {
    to_ground: Matrix3<f64>,
    /// ω in its own axes, and in those of the ground.
    own: Vector3<f64>,
    w: Vector3<f64>,
    /// From hinge to centre.
    half: Vector3<f64>,
    /// Rates of ω and of its velocity, for α alone and without it.
    angular: [Vector3<f64>; 2],
    linear: [Vector3<f64>; 2],
}

/// The solution of K x = −r with x_k = 0 for one k, and that of K x = 0 with x_k = 1, for K of rank 5, by elimination with complete
/// pivoting.
fn solved(mut k: Matrix6<f64>, mut r: Vector6<f64>) -> [Vector6<f64>; 2] {
    let mut order: [usize; 6] = [0, 1, 2, 3, 4, 5];
    for at in 0..N {
        let (row, column) = k.view((at, at), (6 - at, 6 - at)).iamax_full();
        k.swap_rows(at, at + row);
        r.swap_rows(at, at + row);
        k.swap_columns(at, at + column);
        order.swap(at, at + column);
        let inverse = 1.0 / k[(at, at)];
        for below in at + 1..6 {
            let factor = k[(below, at)] * inverse;
            for j in at + 1..6 {
                k[(below, j)] -= factor * k[(at, j)];
            }
            r[below] -= factor * r[at];
        }
    }
    let (mut free, mut known) = (Vector6::zeros(), Vector6::zeros());
    free[order[N]] = 1.0;
    for at in (0..N).rev() {
        let rest =
            |x: &Vector6<f64>| -> f64 { (at + 1..6).map(|j| k[(at, j)] * x[order[j]]).sum() };
        let values = [-rest(&free), -r[at] - rest(&known)];
        (free[order[at]], known[order[at]]) = (values[0] / k[(at, at)], values[1] / k[(at, at)]);
    }
    [free, known]
}

/// ẍ and ë at (q, q̇), with |e| = 1.
#[inline(never)]
pub(crate) fn acceleration(p: &Bricard, q: &[f64], v: &[f64], out: &mut [f64]) {
    let zero = Vector3::zeros();
    let mut bodies: [Body; N] = std::array::from_fn(|k| {
        let (e, rate) = (quaternion(&q[7 * k + 3..]), quaternion(&v[7 * k + 3..]));
        let to_ground = UnitQuaternion::new_unchecked(e)
            .to_rotation_matrix()
            .into_inner();
        let own = spin(e, rate);
        Body {
            to_ground,
            own,
            w: to_ground * own,
            half: to_ground * Vector3::from(CENTRES[k]),
            angular: [zero; 2],
            linear: [zero; 2],
        }
    });
    let axes: [Vector3<f64>; N + 1] =
        std::array::from_fn(|i| bodies[i.min(N - 1)].to_ground * Vector3::from(AXES[i]));
    // The rates of ω, and of the velocity of the last hinge, that are known.
    let (mut before, mut angular, mut linear) = (zero, zero, zero);
    let mut known = [zero; N + 1];
    for (i, axis) in axes.iter().enumerate() {
        let after = bodies.get(i).map_or(zero, |body| body.w);
        angular += before.cross(&(axis * axis.dot(&(after - before))));
        known[i] = angular;
        if let Some(body) = bodies.get(i) {
            let whole = body.half * 2.0;
            linear += angular.cross(&whole) + after.cross(&after.cross(&whole));
        }
        before = after;
    }
    let mut closure = Matrix6::zeros();
    let mut to_last = zero;
    for i in (0..=N).rev() {
        if let Some(body) = bodies.get(i) {
            to_last += body.half * 2.0;
        }
        closure.fixed_view_mut::<3, 1>(0, i).copy_from(&axes[i]);
        closure
            .fixed_view_mut::<3, 1>(3, i)
            .copy_from(&axes[i].cross(&to_last));
    }
    let mut given = Vector6::zeros();
    given.fixed_rows_mut::<3>(0).copy_from(&angular);
    given.fixed_rows_mut::<3>(3).copy_from(&linear);
    let rates = solved(closure, given);
    let (mut inertia, mut drive) = (0.0, 0.0);
    let (mut turned, mut moved) = ([zero; 2], [zero; 2]);
    for (k, body) in bodies.iter_mut().enumerate() {
        for (of, rates) in turned.iter_mut().zip(&rates) {
            *of += axes[k] * rates[k];
        }
        body.angular = [turned[0], turned[1] + known[k]];
        let bent = body.w.cross(&body.w.cross(&body.half));
        let [free, given] = body.angular.map(|a| a.cross(&body.half));
        body.linear = [moved[0] + free, moved[1] + given + bent];
        moved = [body.linear[0] + free, body.linear[1] + given + bent];
        let mut own = Vector3::from_element(p.across);
        own[CENTRES[k]
            .map(f64::abs)
            .iter()
            .position(|x| *x > 0.0)
            .unwrap_or(0)] = p.along;
        let [free, given] = body.angular.map(|a| body.to_ground.tr_mul(&a));
        let moment = own.component_mul(&given) + body.own.cross(&own.component_mul(&body.own));
        let push = body.linear[1] + Vector3::new(0.0, p.g, 0.0);
        inertia += p.m * body.linear[0].norm_squared() + free.dot(&own.component_mul(&free));
        drive -= p.m * body.linear[0].dot(&push) + free.dot(&moment);
    }
    let rate = drive / inertia;
    for (k, body) in bodies.iter().enumerate() {
        let whole = |[free, given]: [Vector3<f64>; 2]| free * rate + given;
        let a = body.to_ground.tr_mul(&whole(body.angular));
        let (out, e) = (&mut out[7 * k..7 * k + 7], 7 * k + 3);
        out[..3].copy_from_slice(whole(body.linear).as_slice());
        out[3..].copy_from_slice(&turning(quaternion(&q[e..]), quaternion(&v[e..]), &a));
    }
}
