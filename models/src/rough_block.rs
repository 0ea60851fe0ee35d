//! A block on a rough slope: dry friction as a non-ideal constraint force, in closed form.

use crate::{Model, Reference};

ukcore::multibody! {
    /// Block on a rough slope (non-ideal constraint, closed form).
    ///
    /// Block on a slope that falls towards +x; y points up. The slope's constraint is not ideal: it rubs with Coulomb's friction
    /// mu N against the motion, where N = m g cos(slope) is the ideal constraint force, known beforehand. Friction is of sliding only:
    /// the slope has to be steeper than the angle of repose, mu < tan(slope), or the block would have to stick.
    pub RoughBlock {
        params {
            /// Mass
            m = 1.0 [kg],
            /// Acceleration of gravity
            g = 9.81 [m/s^2],
            /// Inclination of the slope
            slope = (PI / 6.0) [rad],
            /// Coefficient of friction
            mu = 0.2 [-],
        }
        coords {
            /// Horizontal position
            x [m],
            /// Vertical position, upwards
            y [m],
        }
        let speed_down = dot(x) * cos(slope) - dot(y) * sin(slope);
        let friction = -mu * m * g * cos(slope) * sign(speed_down);
        mass { x: m, y: m }
        potential { m * g * y }
        holonomic { plane: x * sin(slope) + y * cos(slope) = 0.0 }
        nonideal { x: friction * cos(slope), y: -friction * sin(slope) }
        output {
            /// Way down the slope
            way [m] = x * cos(slope) - y * sin(slope),
            /// Speed down the slope
            speed [m/s] = speed_down,
            /// Friction, positive down the slope
            friction_force [N] = friction,
        }
        /// at the origin, kicked along the slope
        start kicked(
            /// Speed down the slope; negative is up
            kick = -5.0 [m/s],
        ) until 3.0 {
            dot([x, y]) near kick * [cos(slope), -sin(slope)]
        }
        draw { circle([x, y], 0.1) trace([x, y]) }
    }
}

impl Model for RoughBlock {
    const ID: &'static str = "rough-block";

    fn references() -> Vec<Reference> {
        let block = RoughBlock::default();
        let (sin, cos) = block.slope.sin_cos();
        // Rounding of a way of some 10 m.
        vec![Reference::closed::<Self>(1e-14, |t| {
            let (way, speed) = block.slide(-5.0, t);
            (vec![way * cos, -way * sin], vec![speed * cos, -speed * sin])
        })]
    }
}

impl RoughBlock {
    /// Acceleration down the slope, m/s², when sliding down and when sliding up: g (sin ∓ mu cos).
    #[must_use]
    pub fn accelerations(&self) -> [f64; 2] {
        let (sin, cos) = self.slope.sin_cos();
        [
            self.g * (sin - self.mu * cos),
            self.g * (sin + self.mu * cos),
        ]
    }

    /// When a block that was kicked with `kick`, m/s down the slope, turns, s; 0 if it slides down from the start.
    #[must_use]
    pub fn turning_time(&self, kick: f64) -> f64 {
        (-kick / self.accelerations()[1]).max(0.0)
    }

    /// Way down the slope, m, and speed, m/s, at time `t` after the kick from the origin.
    #[must_use]
    pub fn slide(&self, kick: f64, t: f64) -> (f64, f64) {
        let [down, up] = self.accelerations();
        let turn = self.turning_time(kick);
        let rising = t.min(turn);
        let way = kick * rising + 0.5 * up * rising * rising;
        if t <= turn && kick < 0.0 {
            return (way, kick + up * t);
        }
        let start = kick.max(0.0);
        let sliding = t - turn;
        (
            way + start * sliding + 0.5 * down * sliding * sliding,
            start + down * sliding,
        )
    }
}
