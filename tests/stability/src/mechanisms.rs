//! Mechanisms that only these cases need.

ukcore::multibody! {
    /// Particles on a chain of rods from the origin, each with a mass and a length of its own; y points up.
    pub(crate) Chain {
        const N: usize = 4;
        params { m[N] = 1.0, l[N] = 1.0, g = 9.81 }
        coords { x[N], y[N] }
        mass { for i in 0..N { x[i]: m[i], y[i]: m[i] } }
        potential { for i in 0..N { m[i] * g * y[i] } }
        holonomic {
            support: sq(x[0]) + sq(y[0]) = sq(l[0])
            for i in 1..N { link[i]: sq(x[i] - x[i - 1]) + sq(y[i] - y[i - 1]) = sq(l[i]) }
        }
    }
}

ukcore::multibody! {
    /// A particle on a spring about the origin instead of a rod.
    pub(crate) Elastic {
        params { m = 1.0, l = 1.0, g = 9.81, k = 100.0 }
        coords { x, y }
        mass { x: m, y: m }
        potential { m * g * y, 0.5 * k * sq(hypot(x, y) - l) }
    }
}

ukcore::multibody! {
    /// A particle that slides down a straight track at the angle `a` below the level, with drag in proportion to its speed.
    pub(crate) Incline {
        params { m = 1.0, g = 9.81, a = 0.5, drag = 1.0 }
        coords { x, y }
        mass { x: m, y: m }
        potential { m * g * y }
        force { x: -drag * dot(x), y: -drag * dot(y) }
        holonomic { track: x * sin(a) + y * cos(a) = 0.0 }
    }
}

ukcore::multibody! {
    /// The double pendulum with its rows multiplied by `s` and 1/`s`.
    pub(crate) ScaledRows {
        params { s = 1.0, r = 1.0, g = 9.81 }
        coords { x1, y1, x2, y2 }
        mass { x1: 1.0, y1: 1.0, x2: 1.0, y2: 1.0 }
        potential { g * y1, g * y2 }
        holonomic {
            inner: s * (sq(x1) + sq(y1) - 1.0) = 0.0
            outer: r * (sq(x2 - x1) + sq(y2 - y1) - 1.0) = 0.0
        }
    }
}

ukcore::multibody! {
    /// A pendulum whose rod is declared three times, as it is, times `s` and times `r`.
    pub(crate) Copies {
        params { s = 1.0, r = 1.0, g = 9.81 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { g * y }
        holonomic {
            rod: sq(x) + sq(y) = 1.0
            copy: s * (sq(x) + sq(y) - 1.0) = 0.0
            again: r * (sq(x) + sq(y) - 1.0) = 0.0
        }
    }
}

ukcore::multibody! {
    /// A particle under a constant force, on the plane x + y = 0 and on one with a slope that differs by `d`.
    pub(crate) NearPlanes {
        params { d = 0.1 }
        coords { x, y, z }
        mass { x: 1.0, y: 1.0, z: 1.0 }
        force { x: 1.0, y: 2.0, z: 3.0 }
        holonomic { plane: x + y = 0.0, turned: x + (1.0 + d) * y = 0.0 }
    }
}

ukcore::multibody! {
    /// A bob at the angle `s`, which has an inertia of its own.
    pub(crate) Wheel {
        params { m = 1.0, l = 1.0, g = 9.81, i = 0.0 }
        coords { x, y, s }
        mass { x: m, y: m, s: i }
        potential { m * g * y }
        holonomic { bob: [x, y] = l * [sin(s), -cos(s)] }
    }
}

ukcore::multibody! {
    /// A carriage with a prescribed motion that changes at t = 1/2 by a jump in place, in velocity and in acceleration, and a mass that
    /// hangs on it by a spring.
    pub(crate) Carriage {
        params { place = 0.0, velocity = 0.0, acceleration = 0.0, k = 30.0 }
        coords { x, y }
        let after = max(0.0, t - 0.5);
        mass { x: 1.0, y: 1.0 }
        potential { 0.5 * k * sq(x - y) }
        holonomic {
            drive: x = place * 0.5 * (1.0 + sign(t - 0.5)) + velocity * after + 0.5 * acceleration * sq(after)
        }
    }
}

/// U-chains of other lengths than the model's.
macro_rules! u_chain {
    ($name:ident, $n:tt) => {
        ukcore::multibody! {
            /// U-chain; see `models::uchain`.
            pub(crate) $name {
                const N: usize = $n;
                params { m = 1.0, l = 1.0, g = 9.8 }
                coords { x[N], y[N] }
                mass { for i in 0..N { x[i]: m, y[i]: m } }
                potential { for i in 0..N { -m * g * y[i] } }
                holonomic {
                    for i in 0..N - 1 { link[i]: sq(x[i + 1] - x[i]) + sq(y[i + 1] - y[i]) = sq(l) }
                    support: sq(x[N - 1]) + sq(y[N - 1]) = sq(l)
                }
            }
        }
    };
}

u_chain!(UChain9, 9);
u_chain!(UChain33, 33);
u_chain!(UChain65, 65);

ukcore::verify!(
    Chain, Elastic, Incline, ScaledRows, Copies, NearPlanes, Wheel, Carriage, UChain9, UChain33,
    UChain65
);
