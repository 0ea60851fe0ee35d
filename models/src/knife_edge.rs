//! A knife edge on an inclined plane: nonholonomic, in closed form.

use crate::{Model, Reference};

ukcore::multibody! {
    /// Knife edge on an inclined plane (nonholonomic, closed form).
    ///
    /// Knife edge (a skate) on a plane inclined by `slope`; x points down the slope, y across it. The edge touches at its centre of mass
    /// and does not slip sideways: a nonholonomic constraint. Set turning, it drifts across the slope and never gets down.
    pub KnifeEdge {
        params {
            /// Mass
            m = 1.0 [kg],
            /// Moment of inertia about the normal of the plane
            i = 0.1 [kg m^2],
            /// Acceleration of gravity
            g = 9.81 [m/s^2],
            /// Inclination of the plane
            slope = (PI / 6.0) [rad],
        }
        coords {
            /// Position down the slope
            x [m],
            /// Position across the slope
            y [m],
            /// Direction of the edge, from the line of fall
            th [rad],
        }
        mass { x: m, y: m, th: i }
        potential { -m * g * sin(slope) * x }
        nonholonomic { edge: dot(x) * sin(th) = dot(y) * cos(th) }
        output {
            /// Speed along the edge
            speed [m/s] = dot(x) * cos(th) + dot(y) * sin(th),
            /// Angular velocity
            spin [rad/s] = dot(th),
        }
        /// at the origin, turning and gliding along its edge
        start spinning(
            /// Angular velocity
            turn = 1.0 [rad/s],
            /// Speed along the edge
            glide = 0.0 [m/s],
            /// Direction of the edge, from the line of fall
            heading = 0.0 [rad],
        ) {
            th = heading
            dot(th) = turn
            dot([x, y]) near glide * [cos(heading), sin(heading)]
        }
        draw { line([y - 0.2 * sin(th), 0.2 * cos(th) - x], [y + 0.2 * sin(th), -x - 0.2 * cos(th)]) trace([y, -x]) }
    }
}

impl Model for KnifeEdge {
    const ID: &'static str = "knife-edge";

    fn references() -> Vec<Reference> {
        let edge = KnifeEdge::default();
        let (turn, glide, heading) = (1.0, 0.0, 0.0);
        // Rounding of a way of some 25 m.
        vec![Reference::closed::<Self>(2e-14, |t| {
            let q = edge.path(turn, glide, heading, t);
            let (sin, cos) = q[2].sin_cos();
            let speed = edge.speed(turn, glide, heading, t);
            (q.to_vec(), vec![speed * cos, speed * sin, turn])
        })]
    }
}

impl KnifeEdge {
    /// Position (x, y, θ), m and rad, at time `t` after the start at the origin with the heading θ₀, rad, turning with ω, rad/s, and
    /// gliding with u₀, m/s.
    ///
    /// θ̇ is constant and the speed along the edge has u̇ = k cos θ with k = g sin(slope), so with c = u₀ − (k/ω) sin θ₀
    /// x = (c/ω)(sin θ − sin θ₀) + k/(2ω²) (sin² θ − sin² θ₀),
    /// y = (c/ω)(cos θ₀ − cos θ) + k/(2ω²) (θ − θ₀ − (sin 2θ − sin 2θ₀)/2);
    /// a straight line for ω = 0 (Neimark & Fufaev, Dynamics of Nonholonomic Systems).
    #[must_use]
    pub fn path(&self, turn: f64, glide: f64, heading: f64, t: f64) -> [f64; 3] {
        let k = self.g * self.slope.sin();
        let (s0, c0) = heading.sin_cos();
        if turn == 0.0 {
            let way = glide * t + 0.5 * k * c0 * t * t;
            return [way * c0, way * s0, heading];
        }
        let th = heading + turn * t;
        let (s, c) = th.sin_cos();
        let constant = glide - k / turn * s0;
        let drift = k / (2.0 * turn * turn);
        [
            constant / turn * (s - s0) + drift * (s * s - s0 * s0),
            constant / turn * (c0 - c) + drift * (th - heading - (s * c - s0 * c0)),
            th,
        ]
    }

    /// Speed along the edge, m/s, on the [`path`](KnifeEdge::path): c + (k/ω) sin θ.
    #[must_use]
    pub fn speed(&self, turn: f64, glide: f64, heading: f64, t: f64) -> f64 {
        let k = self.g * self.slope.sin();
        if turn == 0.0 {
            return glide + k * heading.cos() * t;
        }
        glide + k / turn * ((heading + turn * t).sin() - heading.sin())
    }

    /// Mean velocity across the slope when started at rest, m/s: g sin(slope)/(2ω).
    #[must_use]
    pub fn drift(&self, turn: f64) -> f64 {
        self.g * self.slope.sin() / (2.0 * turn)
    }
}
