//! A mass on two springs in series, joined by a massless point: M is singular.

use crate::{Model, Reference};

ukcore::multibody! {
    /// Mass on two springs with a massless joint (singular M, closed form).
    ///
    /// Wall, spring k1, massless joint, spring k2, mass: all along one line. The joint has no mass, so the forces of the springs on it
    /// balance at all times; declared as a constraint this makes [M | Aᵀ] regular (the condition of eq. 19), and its constraint
    /// force is zero. Both positions are measured from where the springs are relaxed.
    pub MasslessSpring {
        params {
            /// Mass
            m = 1.0 [kg],
            /// Stiffness of the spring at the wall
            k1 = 30.0 [N/m],
            /// Stiffness of the spring at the mass
            k2 = 60.0 [N/m],
        }
        coords {
            /// Position of the massless joint
            joint [m],
            /// Position of the mass
            x [m],
        }
        mass { x: m }
        potential { 0.5 * k1 * sq(joint), 0.5 * k2 * sq(x - joint) }
        holonomic { balance: k1 * joint = k2 * (x - joint) }
        output {
            /// Force that the springs transmit
            spring_force [N] = k1 * joint,
        }
        /// mass pulled out and let go, joint in balance
        start pulled(
            /// Position of the mass
            pull = 0.1 [m],
            /// Velocity of the mass
            speed = 0.0 [m/s],
        ) {
            x = pull
            dot(x) = speed
        }
        draw { spring([0, 0], [1 + joint, 0]) spring([1 + joint, 0], [2 + x, 0]) circle([2 + x, 0], 0.1) }
    }
}

impl Model for MasslessSpring {
    const ID: &'static str = "massless-spring";

    fn references() -> Vec<Reference> {
        let spring = MasslessSpring::default();
        let ratio = spring.ratio();
        let amplitude = 0.1;
        // ω t = 45 is rounded to 45 ε, which moves what swings with 0.1 m at 4.5/s by so much.
        vec![Reference::closed::<Self>(1e-14, |t| {
            let (x, v) = spring.oscillation(amplitude, 0.0, t);
            (vec![ratio * x, x], vec![ratio * v, v])
        })]
    }
}

impl MasslessSpring {
    /// Position of the joint over that of the mass: k2/(k1 + k2).
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.k2 / (self.k1 + self.k2)
    }

    /// Angular frequency, rad/s: √(k/m) with 1/k = 1/k1 + 1/k2.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        (self.k1 * self.ratio() / self.m).sqrt()
    }

    /// Position, m, and velocity, m/s, of the mass at time `t` after the start with `pull`, m, and `speed`, m/s.
    #[must_use]
    pub fn oscillation(&self, pull: f64, speed: f64, t: f64) -> (f64, f64) {
        let frequency = self.frequency();
        let (sin, cos) = (frequency * t).sin_cos();
        (
            pull * cos + speed / frequency * sin,
            speed * cos - pull * frequency * sin,
        )
    }
}
