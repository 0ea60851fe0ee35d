//! Two Scott-Russell linkages that carry a table: more constraints than needed.

use crate::{Model, StartOption, StartOptions, StartSpec};
use std::f64::consts::PI;
use ukcore::model::{Chosen, positive};
use ukcore::{Error, State};

ukcore::multibody! {
    /// Two Scott-Russell linkages side by side carry a level table on a spring: the crank of length l, with its end in the middle of a rod of
    /// length 2l whose foot runs on the x axis, leads the other end of the rod on a vertical line. That it keeps to that line is said
    /// once more by a guide, in both linkages: two of the rows are redundant, which shows where the joints are closed, not off them. y
    /// points up. (The double Scott-Russell linkage is a usual example of a redundantly constrained mechanism of one degree of freedom.)
    pub DoubleScottRussell {
        params {
            /// Length of the cranks, half that of the rods
            l = 0.4 [m],
            /// Mass of each crank, half that of each rod
            m = 1.3 [kg],
            /// Mass of the table
            table_mass = 5.0 [kg],
            /// Distance of the linkages
            span = 2.0 [m],
            /// Stiffness of the spring
            k = 600.0 [N/m],
            /// Acceleration of gravity
            g = 9.81 [m/s^2],
        }
        bodies {
            for i in 0..2 {
                planar crank[i] { mass: m, inertia: m * sq(l) / 12, centre: [l / 2, 0] }
                planar rod[i] { mass: 2 * m, inertia: 2 * m * sq(2 * l) / 12 }
            }
            planar table { mass: table_mass, inertia: table_mass * sq(span) / 12, centre: [span / 2, 0] }
        }
        gravity { [0, -g] }
        let base = [[0, 0], [span, 0]];
        holonomic {
            for i in 0..2 {
                bearing[i]: pin(ground.at(base[i]), crank[i].at([0, 0]))
                middle[i]: pin(crank[i].at([l, 0]), rod[i].at([0, 0]))
                foot[i]: slot(ground.at(base[i]), rod[i].at([-l, 0]), [1, 0])
                guide[i]: slot(ground.at(base[i]), rod[i].at([l, 0]), [0, 1])
            }
            pinned: pin(rod[0].at([l, 0]), table.at([0, 0]))
            carried: slot(table.at([0, 0]), rod[1].at([l, 0]), [1, 0])
            level: turn(ground, table) = 0
        }
        forces { spring(ground.at([0, 0]), table.at([0, 0]), k, l) }
        output {
            /// Height of the table
            height [m] = table.y,
        }
    }
}

impl Model for DoubleScottRussell {
    const ID: &'static str = "double_scott_russell";

    fn summary() -> &'static str {
        "two Scott-Russell linkages that carry a table (two redundant constraints)"
    }

    fn starts() -> &'static [StartSpec] {
        &[StartSpec {
            name: "turning",
            doc: "the first crank at an angle, turning, the second one its mirror image",
            options: &[
                StartOption {
                    name: "angle",
                    doc: "angle of the first crank",
                    default: 0.7,
                    unit: "rad",
                },
                StartOption {
                    name: "speed",
                    doc: "its angular velocity",
                    default: 0.5,
                    unit: "rad/s",
                },
            ],
        }]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let [angle, speed] = Chosen::among(Self::starts(), name, options)?.values();
        positive("l", self.l)?;
        Ok(self.at_crank(angle, speed))
    }

    fn duration() -> f64 {
        2.0
    }
}

impl DoubleScottRussell {
    /// The consistent state at t = 0 with the first crank at `angle`, rad, turning at `speed`, rad/s.
    #[must_use]
    pub fn at_crank(&self, angle: f64, speed: f64) -> State {
        let mut state = State::zeros::<Self>();
        let mut enter = |first: usize, q: [f64; 3], v: [f64; 3]| {
            state.q[first..first + 3].copy_from_slice(&q);
            state.v[first..first + 3].copy_from_slice(&v);
        };
        let l = self.l;
        let (own, mirrored) = ((angle, speed), (PI - angle, -speed));
        // The rod leans as the other crank.
        for (i, (crank, rod)) in [(own, mirrored), (mirrored, own)].into_iter().enumerate() {
            let ((sin, cos), rate) = (crank.0.sin_cos(), crank.1);
            let place = |k: f64| {
                (
                    [i as f64 * self.span + k * cos, k * sin],
                    [-k * sin, k * cos],
                )
            };
            for (first, k, (turn, turning)) in
                [(Self::CRANK_X[i], l / 2.0, crank), (Self::ROD_X[i], l, rod)]
            {
                let ([x, y], [u, v]) = place(k);
                enter(first, [x, y, turn], [u * rate, v * rate, turning]);
            }
        }
        let (sin, cos) = angle.sin_cos();
        let rise = 2.0 * l * cos * speed;
        let table = [self.span / 2.0, 2.0 * l * sin, 0.0];
        enter(Self::TABLE_X, table, [0.0, rise, 0.0]);
        state
    }

    /// Moment of inertia of the whole linkage reduced to a crank, kg m²: T = ½ J(θ) θ̇².
    #[must_use]
    pub fn reduced_inertia(&self, angle: f64) -> f64 {
        let square = self.l * self.l;
        let side = self.m * square * (1.0 / 3.0 + 2.0 + 2.0 / 3.0);
        2.0 * side + self.table_mass * 4.0 * square * angle.cos().powi(2)
    }

    /// Potential energy in terms of the first crank's angle, J, for a table above the bearings.
    #[must_use]
    pub fn reduced_potential(&self, angle: f64) -> f64 {
        let height = self.l * angle.sin();
        let weight = (5.0 * self.m + 2.0 * self.table_mass) * self.g * height;
        weight + 0.5 * self.k * (2.0 * height - self.l).powi(2)
    }
}
