//! A free rigid body in a unit quaternion: M is 4 × 4 of rank 3.

use crate::elliptic;

ukcore::multibody! {
    /// Free rigid body in a unit quaternion (singular M from the kinetic energy).
    ///
    /// Free rigid body about its centre of mass, turned by the unit quaternion (e0, e1, e2, e3) from body to space. The angular
    /// velocity in body axes is ω = 2 G(e) ė, so M = 4 Gᵀ I G is singular along e; the constraint |e|² = 1 mends that (eq. 19).
    pub RigidBody {
        params {
            /// Smallest principal moment of inertia
            i1 = 1.0 [kg m^2],
            /// Middle principal moment of inertia
            i2 = 2.0 [kg m^2],
            /// Largest principal moment of inertia
            i3 = 3.0 [kg m^2],
        }
        coords {
            /// Scalar part of the quaternion
            e0 [-],
            /// Vector part of the quaternion
            e1 [-], e2 [-], e3 [-],
        }
        let im = [e1, e2, e3];
        let w = 2.0 * (e0 * dot(im) - dot(e0) * im - cross(im, dot(im)));
        let momentum = [i1 * w[0], i2 * w[1], i3 * w[2]];
        let in_space = momentum + 2.0 * e0 * cross(im, momentum) + 2.0 * cross(im, cross(im, momentum));
        kinetic { 0.5 * inner(w, momentum) }
        holonomic { unit: sq(e0) + sq(im) = 1.0 }
        output {
            /// Angular velocity about the body's axis 1
            spin1 [rad/s] = w[0],
            /// Angular velocity about the body's axis 2
            spin2 [rad/s] = w[1],
            /// Angular velocity about the body's axis 3
            spin3 [rad/s] = w[2],
            /// Angular momentum along the space axis x
            momentum_x [kg m^2/s] = in_space[0],
            /// Angular momentum along the space axis y
            momentum_y [kg m^2/s] = in_space[1],
            /// Angular momentum along the space axis z
            momentum_z [kg m^2/s] = in_space[2],
        }
        /// body axes along the space axes, turning nearly about the middle, unstable one
        start tumbling(
            /// Angular velocity about axis 1
            rate1 = 0.01 [rad/s],
            /// Angular velocity about axis 2
            rate2 = 2.0 [rad/s],
            /// Angular velocity about axis 3
            rate3 = 0.02 [rad/s],
        ) until 20.0 {
            e0 = 1.0
            dot([e1, e2, e3]) = 0.5 * [rate1, rate2, rate3]
        }
        let turned = |v| v + 2 * e0 * cross(im, v) + 2 * cross(im, cross(im, v));
        draw {
            line(turned([-1, 0, 0]), turned([1, 0, 0])) line(turned([0, -0.6, 0]), turned([0, 0.6, 0]))
            line([0, 0, 0], turned([0, 0, 0.4])) trace(turned([1, 0, 0]))
        }
    }
}

impl RigidBody {
    /// Angular velocity in body axes, rad/s, at time `t` after it was `spin`; `None` unless i1 < i2 < i3, and on the
    /// separatrix.
    ///
    /// Euler's equations in Jacobi's functions (Landau & Lifshitz, Mechanics, §37): with L² > 2 E i2, ω1 ∝ cn τ, ω2 ∝ sn τ, ω3 ∝ dn τ;
    /// with L² < 2 E i2 axes 1 and 3 change places. The phase of `spin` comes from the incomplete integral F.
    #[must_use]
    pub fn spin(&self, spin: [f64; 3], t: f64) -> Option<[f64; 3]> {
        let inertia = [self.i1, self.i2, self.i3];
        if !(0.0 < self.i1 && self.i1 < self.i2 && self.i2 < self.i3) {
            return None;
        }
        // 2E and L².
        let energy: f64 = (0..3).map(|k| inertia[k] * spin[k] * spin[k]).sum();
        let momentum: f64 = (0..3).map(|k| (inertia[k] * spin[k]).powi(2)).sum();
        // Euler's equations keep their form when axes 1 and 3 change places and all rates their signs.
        if momentum > energy * self.i2 {
            about_axis_3(inertia, energy, momentum, spin, t)
        } else {
            let mirrored = |[a, b, c]: [f64; 3]| [-c, -b, -a];
            let [i1, i2, i3] = inertia;
            about_axis_3([i3, i2, i1], energy, momentum, mirrored(spin), t).map(mirrored)
        }
    }
}

/// [`RigidBody::spin`] when ω3 keeps its sign. `energy` is 2E, `momentum` L².
fn about_axis_3(
    [i1, i2, i3]: [f64; 3],
    energy: f64,
    momentum: f64,
    spin: [f64; 3],
    t: f64,
) -> Option<[f64; 3]> {
    let low = energy * i3 - momentum;
    let high = momentum - energy * i1;
    let amplitude = [
        (low / (i1 * (i3 - i1))).sqrt(),
        (low / (i2 * (i3 - i2))).sqrt(),
        (high / (i3 * (i3 - i1))).sqrt(),
    ];
    let m = (i2 - i1) * low / ((i3 - i2) * high);
    if m >= 1.0 || m.is_nan() {
        return None;
    }
    let rate = ((i3 - i2) * high / (i1 * i2 * i3)).sqrt();
    // With i3 the largest the phase runs forwards, with i3 the smallest backwards. Turning two of the rates around changes nothing.
    let sense = if i3 > i1 { 1.0 } else { -1.0 };
    let sign = if spin[2] < 0.0 { -1.0 } else { 1.0 };
    let phase = if low == 0.0 {
        0.0
    } else {
        (sign * spin[1] / amplitude[1]).atan2(spin[0] / amplitude[0])
    };
    let (sn, cn, dn) = elliptic::jacobi(elliptic::incomplete(phase, m) + sense * rate * t, m);
    Some([
        amplitude[0] * cn,
        sign * amplitude[1] * sn,
        sign * amplitude[2] * dn,
    ])
}
