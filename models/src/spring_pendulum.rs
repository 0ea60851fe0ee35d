//! A point mass on a stiff spring: fast along the spring, slow across it.

use crate::pendulum::{FROM, RATE};
use crate::{Model, StartOption, StartOptions, StartSpec};
use ukcore::model::{Chosen, positive};
use ukcore::{Error, State};

ukcore::multibody! {
    /// Point mass on a massless spring about a pivot at the origin; y points up. The stiffer the spring, the more it is a
    /// [`Pendulum`](crate::Pendulum), and the shorter the steps of an explicit method, which has to follow the oscillation along the
    /// spring, be it there or not.
    pub SpringPendulum {
        params {
            /// Mass
            m = 1.0 [kg],
            /// Length of the relaxed spring
            l = 1.0 [m],
            /// Stiffness of the spring
            k = 1e4 [N/m],
            /// Acceleration of gravity
            g = 9.81 [m/s^2],
        }
        coords {
            /// Horizontal position
            x [m],
            /// Vertical position, upwards
            y [m],
        }
        let r = sqrt(sq(x) + sq(y));
        mass { x: m, y: m }
        potential { 0.5 * k * sq(r - l), m * g * y }
        output {
            /// Angle from the downward vertical, counter-clockwise
            angle [rad] = atan2(x, -y),
            /// Extension of the spring
            extension [m] = r - l,
            /// Force of the spring
            tension [N] = k * (r - l),
        }
        draw { spring([0, 0], [x, y]) circle([x, y], 0.05 * l) }
    }
}

impl Model for SpringPendulum {
    const ID: &'static str = "spring_pendulum";

    fn summary() -> &'static str {
        "point mass on a stiff spring (rigid limit: pendulum)"
    }

    fn starts() -> &'static [StartSpec] {
        &[StartSpec {
            name: "released",
            doc: "let go at an angle, the spring stretched so that it balances the mass",
            options: &[
                FROM,
                RATE,
                StartOption {
                    name: "stretch",
                    doc: "stretch of the spring beyond balance, which excites the fast oscillation",
                    default: 0.0,
                    unit: "m",
                },
            ],
        }]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let [angle, rate, stretch] = Chosen::among(Self::starts(), name, options)?.values();
        positive("l", self.l)?;
        positive("k", self.k)?;
        let (sin, cos) = angle.sin_cos();
        let (r, growth) = self.balance(angle, rate);
        let r = r + stretch;
        Ok(State {
            t: 0.0,
            q: vec![r * sin, -r * cos],
            v: vec![r * rate * cos + growth * sin, r * rate * sin - growth * cos],
        })
    }

    /// A hard spring makes it stiff.
    fn variations() -> &'static [&'static [(&'static str, f64)]] {
        &[&[("k", 1e8)]]
    }

    fn duration() -> f64 {
        2.0
    }
}

impl SpringPendulum {
    /// Length of the spring, m, and its rate, m/s, at which the spring carries the mass at `angle`, rad, and `rate`, rad/s, but for terms
    /// of order 1/k².
    ///
    /// k (r − l) = m (g cos θ + r θ̇²), and its derivative with θ̈ = −g sin θ / r.
    #[must_use]
    pub fn balance(&self, angle: f64, rate: f64) -> (f64, f64) {
        let (sin, cos) = angle.sin_cos();
        let SpringPendulum { m, l, k, g, .. } = *self;
        // The square of the rate stretches the spring, too: k r − m r θ̇² = k l + m g cos θ.
        let r = (k * l + m * g * cos) / (k - m * rate * rate);
        let growth = -3.0 * m * g * rate * sin / k;
        (r, growth)
    }

    /// Angular frequency of the oscillation along the spring, rad/s: √(k/m).
    #[must_use]
    pub fn frequency(&self) -> f64 {
        (self.k / self.m).sqrt()
    }
}
