/// N four-bar linkages in a row that share their cranks: N + 1 uniform rods from the ground points (i l, 0) to the tops (x\[i\], y\[i\]), and
/// N uniform rods from each top to the next. The y axis points up. A uniform rod with the end velocities a and b has the kinetic
/// energy m/6 (a² + a·b + b²), so that M couples neighbours. Where all rods lie in one line the N couplers are redundant. (The
/// N-four-bar of González, Dopico, Pastorino & Cuadrado 2006, DOI 10.1007/s11044-006-9020-5.)
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Mass matrix M (lower triangle), eq. 1:
///
/// ```text
/// M[x[0], x[0]] = 0.6666666666666666*m
/// M[x[1], x[0]] = 0.16666666666666666*m
/// M[x[1], x[1]] = m
/// M[x[2], x[1]] = 0.16666666666666666*m
/// M[x[2], x[2]] = m
/// M[x[3], x[2]] = 0.16666666666666666*m
/// M[x[3], x[3]] = m
/// M[x[4], x[3]] = 0.16666666666666666*m
/// M[x[4], x[4]] = 0.6666666666666666*m
/// M[y[0], y[0]] = 0.6666666666666666*m
/// … 7 rows like these …
/// M[y[4], y[4]] = 0.6666666666666666*m
/// ```
///
/// Generalised force Q, eq. 1:
///
/// ```text
/// Q[y[0]] = -m*g
/// Q[y[1]] = -1.5*m*g
/// Q[y[2]] = -1.5*m*g
/// Q[y[3]] = -1.5*m*g
/// Q[y[4]] = -m*g
/// ```
///
/// Constraints φ, eqs. 3 and 4:
///
/// ```text
/// crank[0]: sq(x[0]) + sq(y[0]) - sq(l) = 0
/// crank[1]: sq(x[1] - l) + sq(y[1]) - sq(l) = 0
/// crank[2]: sq(x[2] - 2*l) + sq(y[2]) - sq(l) = 0
/// crank[3]: sq(x[3] - 3*l) + sq(y[3]) - sq(l) = 0
/// crank[4]: sq(x[4] - 4*l) + sq(y[4]) - sq(l) = 0
/// coupler[0]: sq(x[0] - x[1]) + sq(y[0] - y[1]) - sq(l) = 0
/// coupler[1]: sq(x[1] - x[2]) + sq(y[1] - y[2]) - sq(l) = 0
/// coupler[2]: sq(x[2] - x[3]) + sq(y[2] - y[3]) - sq(l) = 0
/// coupler[3]: sq(x[3] - x[4]) + sq(y[3] - y[4]) - sq(l) = 0
/// ```
///
/// Constraint Jacobian A, eq. 5:
///
/// ```text
/// A[crank[0], x[0]] = 2*x[0]
/// A[crank[0], y[0]] = 2*y[0]
/// A[crank[1], x[1]] = 2*(x[1] - l)
/// A[crank[1], y[1]] = 2*y[1]
/// A[crank[2], x[2]] = 2*(x[2] - 2*l)
/// A[crank[2], y[2]] = 2*y[2]
/// A[crank[3], x[3]] = 2*(x[3] - 3*l)
/// A[crank[3], y[3]] = 2*y[3]
/// A[crank[4], x[4]] = 2*(x[4] - 4*l)
/// A[crank[4], y[4]] = 2*y[4]
/// … 15 rows like these …
/// A[coupler[3], y[4]] = 2*(y[4] - y[3])
/// ```
///
/// Right-hand side b, eq. 5:
///
/// ```text
/// b[crank[0]] = -2*(sq(dot(x[0])) + sq(dot(y[0])))
/// b[crank[1]] = -2*(sq(dot(x[1])) + sq(dot(y[1])))
/// b[crank[2]] = -2*(sq(dot(x[2])) + sq(dot(y[2])))
/// b[crank[3]] = -2*(sq(dot(x[3])) + sq(dot(y[3])))
/// b[crank[4]] = -2*(sq(dot(x[4])) + sq(dot(y[4])))
/// b[coupler[0]] = -2*(sq(dot(x[0]) - dot(x[1])) + sq(dot(y[0]) - dot(y[1])))
/// b[coupler[1]] = -2*(sq(dot(x[1]) - dot(x[2])) + sq(dot(y[1]) - dot(y[2])))
/// b[coupler[2]] = -2*(sq(dot(x[2]) - dot(x[3])) + sq(dot(y[2]) - dot(y[3])))
/// b[coupler[3]] = -2*(sq(dot(x[3]) - dot(x[4])) + sq(dot(y[3]) - dot(y[4])))
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 56 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 30 | 53 | 0 | 0 | 0 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 1482 | 1672 | 19 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 255 | 384 | 15 | 0 | 0 | 17 |
/// | straight line, as emitted | 260 | 376 | 15 | 0 | 0 | 15 |
/// | correction of a projection | 234 | 363 | 15 | 0 | 0 | 15 |
/// | once for a set of parameters | 0 | 10 | 0 | 0 | 0 | 2 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct FourBars {
    /// Mass of each rod, kg
    pub m: f64,
    /// Length of each rod, m
    pub l: f64,
    /// Acceleration of gravity, m/s^2
    pub g: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for FourBars {
    fn default() -> Self {
        FourBars {
            m: 1.0,
            l: 1.0,
            g: 9.81,
        }
    }
}
#[allow(dead_code)]
impl FourBars {
    /// Constant `N` of the declaration.
    pub const N: usize = 4;
    /// Position in q of coordinates `x`.
    pub const X: [usize; 5] = [0, 1, 2, 3, 4];
    /// Position in q of coordinates `y`.
    pub const Y: [usize; 5] = [5, 6, 7, 8, 9];
    /// Row in A of constraints `crank`.
    pub const CRANK: [usize; 5] = [0, 1, 2, 3, 4];
    /// Row in A of constraints `coupler`.
    pub const COUPLER: [usize; 4] = [5, 6, 7, 8];
    /// Position of output `lean`.
    pub const OUT_LEAN: usize = 0;
}
const _: () = {
    use ::ukcore as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<FourBars> for ukcore::Prepared {
        fn from(mechanism: FourBars) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for FourBars {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "FourBars",
            doc: "N four-bar linkages in a row that share their cranks: N + 1 uniform rods from the ground points (i l, 0) to the tops (x\\[i\\], y\\[i\\]), and\nN uniform rods from each top to the next. The y axis points up. A uniform rod with the end velocities a and b has the kinetic\nenergy m/6 (a² + a·b + b²), so that M couples neighbours. Where all rods lie in one line the N couplers are redundant. (The\nN-four-bar of González, Dopico, Pastorino & Cuadrado 2006, DOI 10.1007/s11044-006-9020-5.)",
            params: &[
                ukcore::ParamSpec {
                    name: "m",
                    doc: "Mass of each rod, kg",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "l",
                    doc: "Length of each rod, m",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "g",
                    doc: "Acceleration of gravity, m/s^2",
                    default: 9.81,
                },
            ],
            prepared: &[
                ("m", "m"),
                ("m_g", "m*g"),
                ("sq_l", "sq(l)"),
                ("l", "l"),
                ("times_l", "-2*l"),
                ("times_l_2", "-3*l"),
                ("times_l_3", "-4*l"),
                ("g", "g"),
                ("times_g", "1.25*g"),
                ("times_g_2", "1.5*g"),
                (
                    "safe_x_0",
                    "1 if the pivots that depend on m alone are positive and finite, else 0",
                ),
                ("times_m", "0.6666666666666666*m"),
                ("times_m_2", "0.16666666666666666*m"),
                ("times_m_g", "-1.5*m*g"),
            ],
            coords: &[
                "x[0]",
                "x[1]",
                "x[2]",
                "x[3]",
                "x[4]",
                "y[0]",
                "y[1]",
                "y[2]",
                "y[3]",
                "y[4]",
            ],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "crank[0]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[0]) + sq(y[0]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "crank[1]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[1] - l) + sq(y[1]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "crank[2]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[2] - 2*l) + sq(y[2]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "crank[3]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[3] - 3*l) + sq(y[3]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "crank[4]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[4] - 4*l) + sq(y[4]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "coupler[0]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[0] - x[1]) + sq(y[0] - y[1]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "coupler[1]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[1] - x[2]) + sq(y[1] - y[2]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "coupler[2]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[2] - x[3]) + sq(y[2] - y[3]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "coupler[3]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[3] - x[4]) + sq(y[3] - y[4]) - sq(l) = 0",
                },
            ],
            holonomic: 9,
            outputs: &[
                ukcore::OutputSpec {
                    name: "lean",
                    doc: "Angle of the first crank from the upright, towards +x, rad",
                },
            ],
            switches: &[],
            structure: ukcore::Structure {
                straight_line: true,
                solve: ukcore::Solve {
                    refusal: "",
                    pivots: &[
                        ukcore::Pivot::Coordinate(0),
                        ukcore::Pivot::Coordinate(4),
                        ukcore::Pivot::Coordinate(5),
                        ukcore::Pivot::Constraint(0),
                        ukcore::Pivot::Coordinate(9),
                        ukcore::Pivot::Constraint(4),
                        ukcore::Pivot::Coordinate(1),
                        ukcore::Pivot::Coordinate(3),
                        ukcore::Pivot::Coordinate(6),
                        ukcore::Pivot::Constraint(1),
                        ukcore::Pivot::Constraint(5),
                        ukcore::Pivot::Coordinate(8),
                        ukcore::Pivot::Constraint(3),
                        ukcore::Pivot::Constraint(8),
                        ukcore::Pivot::Coordinate(2),
                        ukcore::Pivot::Coordinate(7),
                        ukcore::Pivot::Constraint(2),
                        ukcore::Pivot::Constraint(6),
                        ukcore::Pivot::Constraint(7),
                    ],
                    fill: &[
                        (6, 1),
                        (6, 2),
                        (7, 2),
                        (8, 2),
                        (8, 3),
                        (10, 1),
                        (10, 6),
                        (11, 2),
                        (11, 7),
                        (13, 2),
                        (13, 7),
                        (14, 3),
                        (14, 8),
                        (15, 2),
                        (15, 7),
                        (15, 10),
                        (15, 11),
                        (16, 11),
                        (16, 12),
                        (16, 15),
                        (17, 12),
                        (17, 13),
                        (17, 16),
                        (18, 2),
                        (18, 7),
                        (18, 13),
                        (18, 14),
                        (18, 17),
                    ],
                    checks: &[
                        ukcore::Check::Positive(0),
                        ukcore::Check::Positive(10),
                        ukcore::Check::Positive(14),
                        ukcore::Check::Share(1),
                        ukcore::Check::Share(3),
                        ukcore::Check::Share(6),
                        ukcore::Check::Positive(11),
                        ukcore::Check::Share(15),
                        ukcore::Check::Share(8),
                        ukcore::Check::Positive(13),
                        ukcore::Check::Share(18),
                        ukcore::Check::Share(2),
                        ukcore::Check::Share(7),
                        ukcore::Check::Positive(12),
                        ukcore::Check::Share(16),
                        ukcore::Check::Share(17),
                    ],
                    least_share: 0.0009765625,
                },
                mass_pattern: &[
                    (0, 0),
                    (0, 1),
                    (1, 0),
                    (1, 1),
                    (1, 2),
                    (2, 1),
                    (2, 2),
                    (2, 3),
                    (3, 2),
                    (3, 3),
                    (3, 4),
                    (4, 3),
                    (4, 4),
                    (5, 5),
                    (5, 6),
                    (6, 5),
                    (6, 6),
                    (6, 7),
                    (7, 6),
                    (7, 7),
                    (7, 8),
                    (8, 7),
                    (8, 8),
                    (8, 9),
                    (9, 8),
                    (9, 9),
                ],
                jacobian_pattern: &[
                    (0, 0),
                    (0, 5),
                    (1, 1),
                    (1, 6),
                    (2, 2),
                    (2, 7),
                    (3, 3),
                    (3, 8),
                    (4, 4),
                    (4, 9),
                    (5, 0),
                    (5, 1),
                    (5, 5),
                    (5, 6),
                    (6, 1),
                    (6, 2),
                    (6, 6),
                    (6, 7),
                    (7, 2),
                    (7, 3),
                    (7, 7),
                    (7, 8),
                    (8, 3),
                    (8, 4),
                    (8, 8),
                    (8, 9),
                ],
                mass_diagonal: false,
                mass_constant: true,
                jacobian_constant: false,
                massless: &[],
                angles: &[],
                scleronomic: true,
                nonideal: false,
                potential: true,
                conservative: true,
                left_out: &[
                    "64 of the 90 entries of A: structurally zero, never written",
                    "velocity terms of Lagrange's equations: M is constant",
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "5 of 10 entries of Q: identically zero",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 30,
                        multiplications: 53,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    dense: ukcore::Operations {
                        additions: 1482,
                        multiplications: 1672,
                        divisions: 19,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    unprepared: ukcore::Operations {
                        additions: 255,
                        multiplications: 384,
                        divisions: 15,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 17,
                    },
                    acceleration: ukcore::Operations {
                        additions: 260,
                        multiplications: 376,
                        divisions: 15,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 15,
                    },
                    correction: ukcore::Operations {
                        additions: 234,
                        multiplications: 363,
                        divisions: 15,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 15,
                    },
                    prepare: ukcore::Operations {
                        additions: 0,
                        multiplications: 10,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 2,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[],
                mass: &[
                    (0, 0, "0.6666666666666666*m"),
                    (1, 0, "0.16666666666666666*m"),
                    (1, 1, "m"),
                    (2, 1, "0.16666666666666666*m"),
                    (2, 2, "m"),
                    (3, 2, "0.16666666666666666*m"),
                    (3, 3, "m"),
                    (4, 3, "0.16666666666666666*m"),
                    (4, 4, "0.6666666666666666*m"),
                    (5, 5, "0.6666666666666666*m"),
                    (6, 5, "0.16666666666666666*m"),
                    (6, 6, "m"),
                    (7, 6, "0.16666666666666666*m"),
                    (7, 7, "m"),
                    (8, 7, "0.16666666666666666*m"),
                    (8, 8, "m"),
                    (9, 8, "0.16666666666666666*m"),
                    (9, 9, "0.6666666666666666*m"),
                ],
                force: &[
                    (5, "-m*g"),
                    (6, "-1.5*m*g"),
                    (7, "-1.5*m*g"),
                    (8, "-1.5*m*g"),
                    (9, "-m*g"),
                ],
                nonideal: &[],
                jacobian: &[
                    (0, 0, "2*x[0]"),
                    (0, 5, "2*y[0]"),
                    (1, 1, "2*(x[1] - l)"),
                    (1, 6, "2*y[1]"),
                    (2, 2, "2*(x[2] - 2*l)"),
                    (2, 7, "2*y[2]"),
                    (3, 3, "2*(x[3] - 3*l)"),
                    (3, 8, "2*y[3]"),
                    (4, 4, "2*(x[4] - 4*l)"),
                    (4, 9, "2*y[4]"),
                    (5, 0, "2*(x[0] - x[1])"),
                    (5, 1, "2*(x[1] - x[0])"),
                    (5, 5, "2*(y[0] - y[1])"),
                    (5, 6, "2*(y[1] - y[0])"),
                    (6, 1, "2*(x[1] - x[2])"),
                    (6, 2, "2*(x[2] - x[1])"),
                    (6, 6, "2*(y[1] - y[2])"),
                    (6, 7, "2*(y[2] - y[1])"),
                    (7, 2, "2*(x[2] - x[3])"),
                    (7, 3, "2*(x[3] - x[2])"),
                    (7, 7, "2*(y[2] - y[3])"),
                    (7, 8, "2*(y[3] - y[2])"),
                    (8, 3, "2*(x[3] - x[4])"),
                    (8, 4, "2*(x[4] - x[3])"),
                    (8, 8, "2*(y[3] - y[4])"),
                    (8, 9, "2*(y[4] - y[3])"),
                ],
                rhs: &[
                    (0, "-2*(sq(dot(x[0])) + sq(dot(y[0])))"),
                    (1, "-2*(sq(dot(x[1])) + sq(dot(y[1])))"),
                    (2, "-2*(sq(dot(x[2])) + sq(dot(y[2])))"),
                    (3, "-2*(sq(dot(x[3])) + sq(dot(y[3])))"),
                    (4, "-2*(sq(dot(x[4])) + sq(dot(y[4])))"),
                    (5, "-2*(sq(dot(x[0]) - dot(x[1])) + sq(dot(y[0]) - dot(y[1])))"),
                    (6, "-2*(sq(dot(x[1]) - dot(x[2])) + sq(dot(y[1]) - dot(y[2])))"),
                    (7, "-2*(sq(dot(x[2]) - dot(x[3])) + sq(dot(y[2]) - dot(y[3])))"),
                    (8, "-2*(sq(dot(x[3]) - dot(x[4])) + sq(dot(y[3]) - dot(y[4])))"),
                ],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.m,
                1 => self.l,
                2 => self.g,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.m = value,
                1 => self.l = value,
                2 => self.g = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 14>(prepared, "prepared");
            let [m, l, g] = *ukcore::emitted::exact::<S, 3>(given, "given");
            let lit = S::from_f64;
            prepared[0] = m;
            let m_g = m * g;
            prepared[1] = m_g;
            prepared[2] = l * l;
            prepared[3] = l;
            prepared[4] = lit(-2.0) * l;
            prepared[5] = lit(-3.0) * l;
            prepared[6] = lit(-4.0) * l;
            prepared[7] = g;
            prepared[8] = lit(1.25) * g;
            prepared[9] = lit(1.5) * g;
            let safe_x_0 = S::select_le(
                m,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            prepared[10] = safe_x_0;
            prepared[11] = lit(0.6666666666666666) * m;
            prepared[12] = lit(0.16666666666666666) * m;
            prepared[13] = lit(-1.5) * m_g;
        }
        /// 30 additions, 53 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 0 selections.
        fn dynamics<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut ukcore::Terms<'_, S>,
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 100>(out.mass, "mass");
            let force = ukcore::emitted::exact_mut::<S, 10>(out.force, "force");
            let nonideal = ukcore::emitted::exact_mut::<S, 10>(out.nonideal, "nonideal");
            let jacobian = ukcore::emitted::exact_mut::<S, 90>(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 9>(out.rhs, "rhs");
            let [m, m_g, _, l, times_l, times_l_2, times_l_3, _, _, _, _, times_m,
            times_m_2, times_m_g] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *ukcore::emitted::exact::<
                S,
                10,
            >(q, "q");
            let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_y_0, dot_y_1, dot_y_2,
            dot_y_3, dot_y_4] = *ukcore::emitted::exact::<S, 10>(v, "v");
            let lit = S::from_f64;
            mass[0] = times_m;
            mass[1] = times_m_2;
            mass[10] = times_m_2;
            mass[11] = m;
            mass[12] = times_m_2;
            mass[21] = times_m_2;
            mass[22] = m;
            mass[23] = times_m_2;
            mass[32] = times_m_2;
            mass[33] = m;
            mass[34] = times_m_2;
            mass[43] = times_m_2;
            mass[44] = times_m;
            mass[55] = times_m;
            mass[56] = times_m_2;
            mass[65] = times_m_2;
            mass[66] = m;
            mass[67] = times_m_2;
            mass[76] = times_m_2;
            mass[77] = m;
            mass[78] = times_m_2;
            mass[87] = times_m_2;
            mass[88] = m;
            mass[89] = times_m_2;
            mass[98] = times_m_2;
            mass[99] = times_m;
            force[0] = lit(0.0);
            force[1] = lit(0.0);
            force[2] = lit(0.0);
            force[3] = lit(0.0);
            force[4] = lit(0.0);
            force[5] = -m_g;
            force[6] = times_m_g;
            force[7] = times_m_g;
            force[8] = times_m_g;
            force[9] = -m_g;
            nonideal[0] = lit(0.0);
            nonideal[1] = lit(0.0);
            nonideal[2] = lit(0.0);
            nonideal[3] = lit(0.0);
            nonideal[4] = lit(0.0);
            nonideal[5] = lit(0.0);
            nonideal[6] = lit(0.0);
            nonideal[7] = lit(0.0);
            nonideal[8] = lit(0.0);
            nonideal[9] = lit(0.0);
            jacobian[0] = lit(2.0) * x_0;
            jacobian[45] = lit(2.0) * y_0;
            jacobian[10] = lit(2.0) * (x_1 - l);
            jacobian[55] = lit(2.0) * y_1;
            jacobian[20] = lit(2.0) * (x_2 + times_l);
            jacobian[65] = lit(2.0) * y_2;
            jacobian[30] = lit(2.0) * (x_3 + times_l_2);
            jacobian[75] = lit(2.0) * y_3;
            jacobian[40] = lit(2.0) * (x_4 + times_l_3);
            jacobian[85] = lit(2.0) * y_4;
            let x_0_minus_x_1 = x_0 - x_1;
            jacobian[5] = lit(2.0) * x_0_minus_x_1;
            jacobian[14] = lit(-2.0) * x_0_minus_x_1;
            let y_0_minus_y_1 = y_0 - y_1;
            jacobian[50] = lit(2.0) * y_0_minus_y_1;
            jacobian[59] = lit(-2.0) * y_0_minus_y_1;
            let x_1_minus_x_2 = x_1 - x_2;
            jacobian[15] = lit(2.0) * x_1_minus_x_2;
            jacobian[24] = lit(-2.0) * x_1_minus_x_2;
            let y_1_minus_y_2 = y_1 - y_2;
            jacobian[60] = lit(2.0) * y_1_minus_y_2;
            jacobian[69] = lit(-2.0) * y_1_minus_y_2;
            let x_2_minus_x_3 = x_2 - x_3;
            jacobian[25] = lit(2.0) * x_2_minus_x_3;
            jacobian[34] = lit(-2.0) * x_2_minus_x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            jacobian[70] = lit(2.0) * y_2_minus_y_3;
            jacobian[79] = lit(-2.0) * y_2_minus_y_3;
            let x_3_minus_x_4 = x_3 - x_4;
            jacobian[35] = lit(2.0) * x_3_minus_x_4;
            jacobian[44] = lit(-2.0) * x_3_minus_x_4;
            let y_3_minus_y_4 = y_3 - y_4;
            jacobian[80] = lit(2.0) * y_3_minus_y_4;
            jacobian[89] = lit(-2.0) * y_3_minus_y_4;
            rhs[0] = lit(-2.0) * dot_y_0.mul_add(dot_y_0, dot_x_0 * dot_x_0);
            rhs[1] = lit(-2.0) * dot_y_1.mul_add(dot_y_1, dot_x_1 * dot_x_1);
            rhs[2] = lit(-2.0) * dot_y_2.mul_add(dot_y_2, dot_x_2 * dot_x_2);
            rhs[3] = lit(-2.0) * dot_y_3.mul_add(dot_y_3, dot_x_3 * dot_x_3);
            rhs[4] = lit(-2.0) * dot_y_4.mul_add(dot_y_4, dot_x_4 * dot_x_4);
            let dot_x_0_minus_dot_x_1 = dot_x_0 - dot_x_1;
            let dot_y_0_minus_dot_y_1 = dot_y_0 - dot_y_1;
            rhs[5] = lit(-2.0)
                * dot_y_0_minus_dot_y_1
                    .mul_add(
                        dot_y_0_minus_dot_y_1,
                        dot_x_0_minus_dot_x_1 * dot_x_0_minus_dot_x_1,
                    );
            let dot_x_1_minus_dot_x_2 = dot_x_1 - dot_x_2;
            let dot_y_1_minus_dot_y_2 = dot_y_1 - dot_y_2;
            rhs[6] = lit(-2.0)
                * dot_y_1_minus_dot_y_2
                    .mul_add(
                        dot_y_1_minus_dot_y_2,
                        dot_x_1_minus_dot_x_2 * dot_x_1_minus_dot_x_2,
                    );
            let dot_x_2_minus_dot_x_3 = dot_x_2 - dot_x_3;
            let dot_y_2_minus_dot_y_3 = dot_y_2 - dot_y_3;
            rhs[7] = lit(-2.0)
                * dot_y_2_minus_dot_y_3
                    .mul_add(
                        dot_y_2_minus_dot_y_3,
                        dot_x_2_minus_dot_x_3 * dot_x_2_minus_dot_x_3,
                    );
            let dot_x_3_minus_dot_x_4 = dot_x_3 - dot_x_4;
            let dot_y_3_minus_dot_y_4 = dot_y_3 - dot_y_4;
            rhs[8] = lit(-2.0)
                * dot_y_3_minus_dot_y_4
                    .mul_add(
                        dot_y_3_minus_dot_y_4,
                        dot_x_3_minus_dot_x_4 * dot_x_3_minus_dot_x_4,
                    );
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 100>(mass, "mass");
            let [m, _, _, _, _, _, _, _, _, _, _, times_m, times_m_2, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            mass[0] = times_m;
            mass[1] = times_m_2;
            mass[10] = times_m_2;
            mass[11] = m;
            mass[12] = times_m_2;
            mass[21] = times_m_2;
            mass[22] = m;
            mass[23] = times_m_2;
            mass[32] = times_m_2;
            mass[33] = m;
            mass[34] = times_m_2;
            mass[43] = times_m_2;
            mass[44] = times_m;
            mass[55] = times_m;
            mass[56] = times_m_2;
            mass[65] = times_m_2;
            mass[66] = m;
            mass[67] = times_m_2;
            mass[76] = times_m_2;
            mass[77] = m;
            mass[78] = times_m_2;
            mass[87] = times_m_2;
            mass[88] = m;
            mass[89] = times_m_2;
            mass[98] = times_m_2;
            mass[99] = times_m;
        }
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {
            let jacobian = ukcore::emitted::exact_mut::<S, 90>(jacobian, "jacobian");
            let [_, _, _, l, times_l, times_l_2, times_l_3, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *ukcore::emitted::exact::<
                S,
                10,
            >(q, "q");
            let lit = S::from_f64;
            jacobian[0] = lit(2.0) * x_0;
            jacobian[45] = lit(2.0) * y_0;
            jacobian[10] = lit(2.0) * (x_1 - l);
            jacobian[55] = lit(2.0) * y_1;
            jacobian[20] = lit(2.0) * (x_2 + times_l);
            jacobian[65] = lit(2.0) * y_2;
            jacobian[30] = lit(2.0) * (x_3 + times_l_2);
            jacobian[75] = lit(2.0) * y_3;
            jacobian[40] = lit(2.0) * (x_4 + times_l_3);
            jacobian[85] = lit(2.0) * y_4;
            let x_0_minus_x_1 = x_0 - x_1;
            jacobian[5] = lit(2.0) * x_0_minus_x_1;
            jacobian[14] = lit(-2.0) * x_0_minus_x_1;
            let y_0_minus_y_1 = y_0 - y_1;
            jacobian[50] = lit(2.0) * y_0_minus_y_1;
            jacobian[59] = lit(-2.0) * y_0_minus_y_1;
            let x_1_minus_x_2 = x_1 - x_2;
            jacobian[15] = lit(2.0) * x_1_minus_x_2;
            jacobian[24] = lit(-2.0) * x_1_minus_x_2;
            let y_1_minus_y_2 = y_1 - y_2;
            jacobian[60] = lit(2.0) * y_1_minus_y_2;
            jacobian[69] = lit(-2.0) * y_1_minus_y_2;
            let x_2_minus_x_3 = x_2 - x_3;
            jacobian[25] = lit(2.0) * x_2_minus_x_3;
            jacobian[34] = lit(-2.0) * x_2_minus_x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            jacobian[70] = lit(2.0) * y_2_minus_y_3;
            jacobian[79] = lit(-2.0) * y_2_minus_y_3;
            let x_3_minus_x_4 = x_3 - x_4;
            jacobian[35] = lit(2.0) * x_3_minus_x_4;
            jacobian[44] = lit(-2.0) * x_3_minus_x_4;
            let y_3_minus_y_4 = y_3 - y_4;
            jacobian[80] = lit(2.0) * y_3_minus_y_4;
            jacobian[89] = lit(-2.0) * y_3_minus_y_4;
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 9>(phi, "phi");
            let [_, _, sq_l, l, times_l, times_l_2, times_l_3, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *ukcore::emitted::exact::<
                S,
                10,
            >(q, "q");
            phi[0] = y_0.mul_add(y_0, x_0 * x_0 - sq_l);
            let x_1_minus_l = x_1 - l;
            phi[1] = x_1_minus_l.mul_add(x_1_minus_l, y_1 * y_1 - sq_l);
            let x_2_plus_times_l = x_2 + times_l;
            phi[2] = x_2_plus_times_l.mul_add(x_2_plus_times_l, y_2 * y_2 - sq_l);
            let x_3_plus_times_l_2 = x_3 + times_l_2;
            phi[3] = x_3_plus_times_l_2.mul_add(x_3_plus_times_l_2, y_3 * y_3 - sq_l);
            let x_4_plus_times_l_3 = x_4 + times_l_3;
            phi[4] = x_4_plus_times_l_3.mul_add(x_4_plus_times_l_3, y_4 * y_4 - sq_l);
            let x_0_minus_x_1 = x_0 - x_1;
            let y_0_minus_y_1 = y_0 - y_1;
            phi[5] = y_0_minus_y_1
                .mul_add(y_0_minus_y_1, x_0_minus_x_1 * x_0_minus_x_1 - sq_l);
            let x_1_minus_x_2 = x_1 - x_2;
            let y_1_minus_y_2 = y_1 - y_2;
            phi[6] = y_1_minus_y_2
                .mul_add(y_1_minus_y_2, x_1_minus_x_2 * x_1_minus_x_2 - sq_l);
            let x_2_minus_x_3 = x_2 - x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            phi[7] = y_2_minus_y_3
                .mul_add(y_2_minus_y_3, x_2_minus_x_3 * x_2_minus_x_3 - sq_l);
            let x_3_minus_x_4 = x_3 - x_4;
            let y_3_minus_y_4 = y_3 - y_4;
            phi[8] = y_3_minus_y_4
                .mul_add(y_3_minus_y_4, x_3_minus_x_4 * x_3_minus_x_4 - sq_l);
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 9>(rate, "rate");
            let [_, _, _, l, times_l, times_l_2, times_l_3, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *ukcore::emitted::exact::<
                S,
                10,
            >(q, "q");
            let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_y_0, dot_y_1, dot_y_2,
            dot_y_3, dot_y_4] = *ukcore::emitted::exact::<S, 10>(v, "v");
            let lit = S::from_f64;
            rate[0] = lit(2.0) * y_0.mul_add(dot_y_0, x_0 * dot_x_0);
            rate[1] = lit(2.0) * dot_x_1.mul_add((x_1 - l), y_1 * dot_y_1);
            rate[2] = lit(2.0) * dot_x_2.mul_add((x_2 + times_l), y_2 * dot_y_2);
            rate[3] = lit(2.0) * dot_x_3.mul_add((x_3 + times_l_2), y_3 * dot_y_3);
            rate[4] = lit(2.0) * dot_x_4.mul_add((x_4 + times_l_3), y_4 * dot_y_4);
            rate[5] = lit(2.0)
                * (y_0 - y_1)
                    .mul_add((dot_y_0 - dot_y_1), (x_0 - x_1) * (dot_x_0 - dot_x_1));
            rate[6] = lit(2.0)
                * (y_1 - y_2)
                    .mul_add((dot_y_1 - dot_y_2), (x_1 - x_2) * (dot_x_1 - dot_x_2));
            rate[7] = lit(2.0)
                * (y_2 - y_3)
                    .mul_add((dot_y_2 - dot_y_3), (x_2 - x_3) * (dot_x_2 - dot_x_3));
            rate[8] = lit(2.0)
                * (y_3 - y_4)
                    .mul_add((dot_y_3 - dot_y_4), (x_3 - x_4) * (dot_x_3 - dot_x_4));
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [m, m_g, _, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [_, _, _, _, _, y_0, y_1, y_2, y_3, y_4] = *ukcore::emitted::exact::<
                S,
                10,
            >(q, "q");
            let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_y_0, dot_y_1, dot_y_2,
            dot_y_3, dot_y_4] = *ukcore::emitted::exact::<S, 10>(v, "v");
            let lit = S::from_f64;
            let sq_dot_x_0 = dot_x_0 * dot_x_0;
            let sq_dot_y_0 = dot_y_0 * dot_y_0;
            let sq_dot_x_1 = dot_x_1 * dot_x_1;
            let sq_dot_y_1 = dot_y_1 * dot_y_1;
            let sq_dot_x_2 = dot_x_2 * dot_x_2;
            let sq_dot_y_2 = dot_y_2 * dot_y_2;
            let sq_dot_x_3 = dot_x_3 * dot_x_3;
            let sq_dot_y_3 = dot_y_3 * dot_y_3;
            let sq_dot_x_4 = dot_x_4 * dot_x_4;
            let sq_dot_y_4 = dot_y_4 * dot_y_4;
            let kinetic = lit(0.16666666666666666)
                * m
                    .mul_add(
                        dot_y_3.mul_add(dot_y_4, sq_dot_y_3 + sq_dot_y_4),
                        m
                            .mul_add(
                                dot_x_3.mul_add(dot_x_4, sq_dot_x_3 + sq_dot_x_4),
                                m
                                    .mul_add(
                                        dot_y_2.mul_add(dot_y_3, sq_dot_y_2 + sq_dot_y_3),
                                        m
                                            .mul_add(
                                                dot_x_2.mul_add(dot_x_3, sq_dot_x_2 + sq_dot_x_3),
                                                m
                                                    .mul_add(
                                                        dot_y_1.mul_add(dot_y_2, sq_dot_y_1 + sq_dot_y_2),
                                                        m
                                                            .mul_add(
                                                                dot_x_1.mul_add(dot_x_2, sq_dot_x_1 + sq_dot_x_2),
                                                                m
                                                                    .mul_add(
                                                                        dot_y_0.mul_add(dot_y_1, sq_dot_y_0 + sq_dot_y_1),
                                                                        m
                                                                            .mul_add(
                                                                                dot_x_0.mul_add(dot_x_1, sq_dot_x_0 + sq_dot_x_1),
                                                                                m
                                                                                    .mul_add(
                                                                                        (sq_dot_x_4 + sq_dot_y_4),
                                                                                        m
                                                                                            .mul_add(
                                                                                                (sq_dot_x_3 + sq_dot_y_3),
                                                                                                m
                                                                                                    .mul_add(
                                                                                                        (sq_dot_x_2 + sq_dot_y_2),
                                                                                                        m
                                                                                                            .mul_add(
                                                                                                                (sq_dot_x_1 + sq_dot_y_1),
                                                                                                                m * (sq_dot_x_0 + sq_dot_y_0),
                                                                                                            ),
                                                                                                    ),
                                                                                            ),
                                                                                    ),
                                                                            ),
                                                                    ),
                                                            ),
                                                    ),
                                            ),
                                    ),
                            ),
                    );
            let potential = lit(0.5)
                * m_g
                    .mul_add(
                        (y_3 + y_4),
                        m_g
                            .mul_add(
                                (y_2 + y_3),
                                m_g
                                    .mul_add(
                                        (y_1 + y_2),
                                        m_g
                                            .mul_add(
                                                (y_0 + y_1),
                                                y_4
                                                    .mul_add(
                                                        m_g,
                                                        y_3
                                                            .mul_add(m_g, y_2.mul_add(m_g, y_1.mul_add(m_g, y_0 * m_g))),
                                                    ),
                                            ),
                                    ),
                            ),
                    );
            ukcore::Energy {
                kinetic,
                potential,
            }
        }
        fn outputs<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            outputs: &mut [S],
        ) {
            let outputs = ukcore::emitted::exact_mut::<S, 1>(outputs, "outputs");
            let [x_0, _, _, _, _, y_0, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                10,
            >(q, "q");
            outputs[0] = x_0.atan2(y_0);
        }
        /// 260 additions, 376 multiplications, 15 divisions, 0 square roots, 0 transcendentals, 15 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 10>(out, "out");
            let [_, _, _, l, times_l, times_l_2, times_l_3, g, times_g, times_g_2,
            safe_x_0, _, _, _] = *ukcore::emitted::exact::<S, 14>(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *ukcore::emitted::exact::<
                S,
                10,
            >(q, "q");
            let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_y_0, dot_y_1, dot_y_2,
            dot_y_3, dot_y_4] = *ukcore::emitted::exact::<S, 10>(v, "v");
            let lit = S::from_f64;
            let crank_0_by_x_0 = lit(1.5) * x_0;
            let crank_0_by_y_0 = lit(1.5) * y_0;
            let pivot_crank_0 = y_0.mul_add(crank_0_by_y_0, x_0 * crank_0_by_x_0);
            let per_pivot_crank_0 = pivot_crank_0.recip();
            let safe_crank_0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_0,
                safe_x_0,
                lit(0.0),
            );
            let right_crank_0 = g
                .neg_mul_add(
                    crank_0_by_y_0,
                    dot_y_0.mul_add(dot_y_0, dot_x_0 * dot_x_0),
                );
            let crank_4_by_y_4 = lit(1.5) * y_4;
            let x_4_plus_times_l_3 = x_4 + times_l_3;
            let crank_4_by_x_4 = lit(1.5) * x_4_plus_times_l_3;
            let pivot_crank_4 = x_4_plus_times_l_3
                .mul_add(crank_4_by_x_4, y_4 * crank_4_by_y_4);
            let per_pivot_crank_4 = pivot_crank_4.recip();
            let safe_crank_4 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_4,
                safe_crank_0,
                lit(0.0),
            );
            let right_crank_4 = g
                .neg_mul_add(
                    crank_4_by_y_4,
                    dot_y_4.mul_add(dot_y_4, dot_x_4 * dot_x_4),
                );
            let acceleration_0_part = lit(0.16666666666666666) * crank_0_by_x_0;
            let x_1_by_crank_0 = acceleration_0_part * per_pivot_crank_0;
            let pivot_x_1 = acceleration_0_part
                .mul_add(x_1_by_crank_0, lit(0.9583333333333334));
            let per_pivot_x_1 = pivot_x_1.recip();
            let safe_x_1 = S::select_le(
                lit(0.0009765625),
                pivot_x_1,
                safe_crank_4,
                lit(0.0),
            );
            let right_x_1 = right_crank_0 * x_1_by_crank_0;
            let acceleration_0_part_2 = lit(0.16666666666666666) * crank_4_by_x_4;
            let x_3_by_crank_4 = acceleration_0_part_2 * per_pivot_crank_4;
            let pivot_x_3 = acceleration_0_part_2
                .mul_add(x_3_by_crank_4, lit(0.9583333333333334));
            let per_pivot_x_3 = pivot_x_3.recip();
            let safe_x_3 = S::select_le(
                lit(0.0009765625),
                pivot_x_3,
                safe_x_1,
                lit(0.0),
            );
            let right_x_3 = right_crank_4 * x_3_by_crank_4;
            let acceleration_0_part_3 = lit(0.16666666666666666) * crank_0_by_y_0;
            let y_1_by_crank_0 = acceleration_0_part_3 * per_pivot_crank_0;
            let acceleration_0_part_4 = acceleration_0_part * y_1_by_crank_0;
            let y_1_by_x_1 = acceleration_0_part_4 * per_pivot_x_1;
            let pivot_y_1 = acceleration_0_part_4
                .neg_mul_add(
                    y_1_by_x_1,
                    acceleration_0_part_3
                        .mul_add(y_1_by_crank_0, lit(0.9583333333333334)),
                );
            let per_pivot_y_1 = pivot_y_1.recip();
            let safe_y_1 = S::select_le(
                lit(0.0009765625),
                pivot_y_1,
                safe_x_3,
                lit(0.0),
            );
            let acceleration_0_part_5 = right_x_1;
            let right_y_1 = right_crank_0 * y_1_by_crank_0
                - acceleration_0_part_5.mul_add(y_1_by_x_1, times_g);
            let x_1_minus_l = x_1 - l;
            let crank_1_by_x_1 = x_1_minus_l * per_pivot_x_1;
            let acceleration_0_part_6 = acceleration_0_part_4
                .neg_mul_add(crank_1_by_x_1, y_1);
            let crank_1_by_y_1 = acceleration_0_part_6 * per_pivot_y_1;
            let pivot_crank_1 = acceleration_0_part_6
                .mul_add(crank_1_by_y_1, x_1_minus_l * crank_1_by_x_1);
            let per_pivot_crank_1 = pivot_crank_1.recip();
            let safe_crank_1 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_1,
                safe_y_1,
                lit(0.0),
            );
            let right_crank_1 = right_y_1
                .mul_add(
                    crank_1_by_y_1,
                    acceleration_0_part_5
                        .mul_add(
                            crank_1_by_x_1,
                            dot_y_1.mul_add(dot_y_1, dot_x_1 * dot_x_1),
                        ),
                );
            let x_0_minus_x_1 = x_0 - x_1;
            let coupler_0_by_x_0 = lit(1.5) * x_0_minus_x_1;
            let y_0_minus_y_1 = y_0 - y_1;
            let coupler_0_by_y_0 = lit(1.5) * y_0_minus_y_1;
            let coupler_0_with_crank_0 = y_0
                .mul_add(coupler_0_by_y_0, x_0 * coupler_0_by_x_0);
            let coupler_0_by_crank_0 = coupler_0_with_crank_0 * per_pivot_crank_0;
            let acceleration_0_part_7 = acceleration_0_part * coupler_0_by_crank_0
                - lit(0.16666666666666666).mul_add(coupler_0_by_x_0, x_0_minus_x_1);
            let coupler_0_by_x_1 = acceleration_0_part_7 * per_pivot_x_1;
            let acceleration_0_part_8 = acceleration_0_part_3 * coupler_0_by_crank_0
                - acceleration_0_part_4
                    .mul_add(
                        coupler_0_by_x_1,
                        lit(0.16666666666666666).mul_add(coupler_0_by_y_0, y_0_minus_y_1),
                    );
            let coupler_0_by_y_1 = acceleration_0_part_8 * per_pivot_y_1;
            let diagonal_coupler_0 = acceleration_0_part_8
                .mul_add(
                    coupler_0_by_y_1,
                    acceleration_0_part_7
                        .mul_add(
                            coupler_0_by_x_1,
                            y_0_minus_y_1
                                .mul_add(coupler_0_by_y_0, x_0_minus_x_1 * coupler_0_by_x_0),
                        ),
                );
            let coupler_0_with_crank_1 = acceleration_0_part_6
                .mul_add(coupler_0_by_y_1, x_1_minus_l * coupler_0_by_x_1);
            let coupler_0_by_crank_1 = coupler_0_with_crank_1 * per_pivot_crank_1;
            let pivot_coupler_0 = coupler_0_with_crank_1
                .mul_add(
                    coupler_0_by_crank_1,
                    coupler_0_with_crank_0 * coupler_0_by_crank_0 - diagonal_coupler_0,
                );
            let per_pivot_coupler_0 = pivot_coupler_0.recip();
            let safe_coupler_0 = S::select_le(
                lit(0.0009765625) * diagonal_coupler_0,
                -pivot_coupler_0,
                safe_crank_1,
                lit(0.0),
            );
            let dot_x_0_minus_dot_x_1 = dot_x_0 - dot_x_1;
            let dot_y_0_minus_dot_y_1 = dot_y_0 - dot_y_1;
            let right_coupler_0 = right_crank_1
                .mul_add(
                    coupler_0_by_crank_1,
                    right_crank_0 * coupler_0_by_crank_0
                        - right_y_1
                            .mul_add(
                                coupler_0_by_y_1,
                                acceleration_0_part_5
                                    .mul_add(
                                        coupler_0_by_x_1,
                                        g
                                            .neg_mul_add(
                                                coupler_0_by_y_0,
                                                dot_y_0_minus_dot_y_1
                                                    .mul_add(
                                                        dot_y_0_minus_dot_y_1,
                                                        dot_x_0_minus_dot_x_1 * dot_x_0_minus_dot_x_1,
                                                    ),
                                            ),
                                    ),
                            ),
                );
            let acceleration_0_part_9 = lit(0.16666666666666666) * crank_4_by_y_4;
            let y_3_by_crank_4 = acceleration_0_part_9 * per_pivot_crank_4;
            let acceleration_0_part_10 = acceleration_0_part_2 * y_3_by_crank_4;
            let y_3_by_x_3 = acceleration_0_part_10 * per_pivot_x_3;
            let pivot_y_3 = acceleration_0_part_10
                .neg_mul_add(
                    y_3_by_x_3,
                    acceleration_0_part_9
                        .mul_add(y_3_by_crank_4, lit(0.9583333333333334)),
                );
            let per_pivot_y_3 = pivot_y_3.recip();
            let safe_y_3 = S::select_le(
                lit(0.0009765625),
                pivot_y_3,
                safe_coupler_0,
                lit(0.0),
            );
            let acceleration_0_part_11 = right_x_3;
            let right_y_3 = right_crank_4 * y_3_by_crank_4
                - acceleration_0_part_11.mul_add(y_3_by_x_3, times_g);
            let x_3_plus_times_l_2 = x_3 + times_l_2;
            let crank_3_by_x_3 = x_3_plus_times_l_2 * per_pivot_x_3;
            let acceleration_0_part_12 = acceleration_0_part_10
                .neg_mul_add(crank_3_by_x_3, y_3);
            let crank_3_by_y_3 = acceleration_0_part_12 * per_pivot_y_3;
            let pivot_crank_3 = acceleration_0_part_12
                .mul_add(crank_3_by_y_3, x_3_plus_times_l_2 * crank_3_by_x_3);
            let per_pivot_crank_3 = pivot_crank_3.recip();
            let safe_crank_3 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_3,
                safe_y_3,
                lit(0.0),
            );
            let right_crank_3 = right_y_3
                .mul_add(
                    crank_3_by_y_3,
                    acceleration_0_part_11
                        .mul_add(
                            crank_3_by_x_3,
                            dot_y_3.mul_add(dot_y_3, dot_x_3 * dot_x_3),
                        ),
                );
            let y_3_minus_y_4 = y_3 - y_4;
            let coupler_3_by_y_4 = lit(1.5) * y_3_minus_y_4;
            let x_3_minus_x_4 = x_3 - x_4;
            let coupler_3_by_x_4 = lit(1.5) * x_3_minus_x_4;
            let coupler_3_with_crank_4 = x_4_plus_times_l_3
                .mul_add(coupler_3_by_x_4, y_4 * coupler_3_by_y_4);
            let coupler_3_by_crank_4 = coupler_3_with_crank_4 * per_pivot_crank_4;
            let acceleration_0_part_13 = acceleration_0_part_2
                .neg_mul_add(
                    coupler_3_by_crank_4,
                    lit(0.16666666666666666).mul_add(coupler_3_by_x_4, x_3_minus_x_4),
                );
            let coupler_3_by_x_3 = -(acceleration_0_part_13 * per_pivot_x_3);
            let acceleration_0_part_14 = acceleration_0_part_9 * coupler_3_by_crank_4
                - acceleration_0_part_10
                    .mul_add(
                        coupler_3_by_x_3,
                        lit(0.16666666666666666).mul_add(coupler_3_by_y_4, y_3_minus_y_4),
                    );
            let coupler_3_by_y_3 = acceleration_0_part_14 * per_pivot_y_3;
            let coupler_3_with_crank_3 = acceleration_0_part_12
                .mul_add(coupler_3_by_y_3, x_3_plus_times_l_2 * coupler_3_by_x_3);
            let coupler_3_by_crank_3 = coupler_3_with_crank_3 * per_pivot_crank_3;
            let diagonal_coupler_3 = acceleration_0_part_14
                .mul_add(
                    coupler_3_by_y_3,
                    acceleration_0_part_13
                        .neg_mul_add(
                            coupler_3_by_x_3,
                            y_3_minus_y_4
                                .mul_add(coupler_3_by_y_4, x_3_minus_x_4 * coupler_3_by_x_4),
                        ),
                );
            let pivot_coupler_3 = coupler_3_with_crank_3
                .mul_add(
                    coupler_3_by_crank_3,
                    coupler_3_with_crank_4 * coupler_3_by_crank_4 - diagonal_coupler_3,
                );
            let per_pivot_coupler_3 = pivot_coupler_3.recip();
            let safe_coupler_3 = S::select_le(
                lit(0.0009765625) * diagonal_coupler_3,
                -pivot_coupler_3,
                safe_crank_3,
                lit(0.0),
            );
            let dot_x_3_minus_dot_x_4 = dot_x_3 - dot_x_4;
            let dot_y_3_minus_dot_y_4 = dot_y_3 - dot_y_4;
            let right_coupler_3 = right_crank_3
                .mul_add(
                    coupler_3_by_crank_3,
                    right_crank_4 * coupler_3_by_crank_4
                        + right_y_3
                            .neg_mul_add(
                                coupler_3_by_y_3,
                                acceleration_0_part_11
                                    .neg_mul_add(
                                        coupler_3_by_x_3,
                                        g
                                            .mul_add(
                                                coupler_3_by_y_4,
                                                dot_y_3_minus_dot_y_4
                                                    .mul_add(
                                                        dot_y_3_minus_dot_y_4,
                                                        dot_x_3_minus_dot_x_4 * dot_x_3_minus_dot_x_4,
                                                    ),
                                            ),
                                    ),
                            ),
                );
            let x_2_by_x_1 = lit(0.16666666666666666) * (per_pivot_x_1);
            let acceleration_0_part_15 = lit(0.16666666666666666) * y_1_by_x_1;
            let x_2_by_y_1 = acceleration_0_part_15 * per_pivot_y_1;
            let x_2_by_x_3 = lit(0.16666666666666666) * (per_pivot_x_3);
            let acceleration_0_part_16 = acceleration_0_part_15
                .neg_mul_add(crank_1_by_y_1, lit(0.16666666666666666) * crank_1_by_x_1);
            let x_2_by_crank_1 = acceleration_0_part_16 * per_pivot_crank_1;
            let acceleration_0_part_17 = acceleration_0_part_16
                .neg_mul_add(
                    coupler_0_by_crank_1,
                    acceleration_0_part_15
                        .neg_mul_add(
                            coupler_0_by_y_1,
                            lit(0.16666666666666666) * coupler_0_by_x_1,
                        ),
                );
            let x_2_by_coupler_0 = -(acceleration_0_part_17 * per_pivot_coupler_0);
            let acceleration_0_part_18 = lit(0.16666666666666666) * y_3_by_x_3;
            let x_2_by_y_3 = acceleration_0_part_18 * per_pivot_y_3;
            let acceleration_0_part_19 = acceleration_0_part_18
                .neg_mul_add(crank_3_by_y_3, lit(0.16666666666666666) * crank_3_by_x_3);
            let x_2_by_crank_3 = acceleration_0_part_19 * per_pivot_crank_3;
            let acceleration_0_part_20 = acceleration_0_part_19 * coupler_3_by_crank_3
                - acceleration_0_part_18
                    .neg_mul_add(
                        coupler_3_by_y_3,
                        lit(0.16666666666666666) * coupler_3_by_x_3,
                    );
            let x_2_by_coupler_3 = acceleration_0_part_20 * per_pivot_coupler_3;
            let pivot_x_2 = acceleration_0_part_20
                .neg_mul_add(
                    x_2_by_coupler_3,
                    acceleration_0_part_17
                        .mul_add(
                            x_2_by_coupler_0,
                            acceleration_0_part_19
                                .mul_add(
                                    x_2_by_crank_3,
                                    acceleration_0_part_18
                                        .neg_mul_add(
                                            x_2_by_y_3,
                                            acceleration_0_part_15
                                                .neg_mul_add(
                                                    x_2_by_y_1,
                                                    lit(0.16666666666666666)
                                                        .neg_mul_add(
                                                            x_2_by_x_3,
                                                            lit(0.16666666666666666)
                                                                .neg_mul_add(
                                                                    x_2_by_x_1,
                                                                    acceleration_0_part_16.mul_add(x_2_by_crank_1, lit(1.0)),
                                                                ),
                                                        ),
                                                ),
                                        ),
                                ),
                        ),
                );
            let per_pivot_x_2 = pivot_x_2.recip();
            let safe_x_2 = S::select_le(
                lit(0.0009765625),
                pivot_x_2,
                safe_coupler_3,
                lit(0.0),
            );
            let right_x_2 = right_coupler_3
                .neg_mul_add(
                    x_2_by_coupler_3,
                    right_coupler_0
                        .neg_mul_add(
                            x_2_by_coupler_0,
                            right_crank_3
                                .mul_add(
                                    x_2_by_crank_3,
                                    right_crank_1 * x_2_by_crank_1
                                        - right_y_3
                                            .neg_mul_add(
                                                x_2_by_y_3,
                                                right_y_1
                                                    .neg_mul_add(
                                                        x_2_by_y_1,
                                                        acceleration_0_part_11
                                                            .mul_add(x_2_by_x_3, acceleration_0_part_5 * x_2_by_x_1),
                                                    ),
                                            ),
                                ),
                        ),
                );
            let y_2_by_y_1 = lit(0.16666666666666666) * (per_pivot_y_1);
            let acceleration_0_part_21 = lit(0.16666666666666666) * crank_1_by_y_1;
            let y_2_by_crank_1 = acceleration_0_part_21 * per_pivot_crank_1;
            let acceleration_0_part_22 = lit(0.16666666666666666) * coupler_0_by_y_1;
            let acceleration_0_part_23 = acceleration_0_part_21
                .neg_mul_add(coupler_0_by_crank_1, acceleration_0_part_22);
            let y_2_by_coupler_0 = -(acceleration_0_part_23 * per_pivot_coupler_0);
            let y_2_by_y_3 = lit(0.16666666666666666) * (per_pivot_y_3);
            let acceleration_0_part_24 = lit(0.16666666666666666) * crank_3_by_y_3;
            let y_2_by_crank_3 = acceleration_0_part_24 * per_pivot_crank_3;
            let acceleration_0_part_25 = lit(0.16666666666666666) * coupler_3_by_y_3;
            let acceleration_0_part_26 = acceleration_0_part_24 * coupler_3_by_crank_3
                - acceleration_0_part_25;
            let y_2_by_coupler_3 = acceleration_0_part_26 * per_pivot_coupler_3;
            let acceleration_0_part_27 = acceleration_0_part_20
                .neg_mul_add(
                    y_2_by_coupler_3,
                    acceleration_0_part_17
                        .mul_add(
                            y_2_by_coupler_0,
                            acceleration_0_part_19
                                .mul_add(
                                    y_2_by_crank_3,
                                    acceleration_0_part_16
                                        .mul_add(
                                            y_2_by_crank_1,
                                            acceleration_0_part_18
                                                .mul_add(y_2_by_y_3, acceleration_0_part_15 * y_2_by_y_1),
                                        ),
                                ),
                        ),
                );
            let y_2_by_x_2 = acceleration_0_part_27 * per_pivot_x_2;
            let pivot_y_2 = acceleration_0_part_27
                .neg_mul_add(
                    y_2_by_x_2,
                    acceleration_0_part_26
                        .neg_mul_add(
                            y_2_by_coupler_3,
                            acceleration_0_part_23
                                .mul_add(
                                    y_2_by_coupler_0,
                                    acceleration_0_part_24
                                        .mul_add(
                                            y_2_by_crank_3,
                                            lit(0.16666666666666666)
                                                .neg_mul_add(
                                                    y_2_by_y_3,
                                                    lit(0.16666666666666666)
                                                        .neg_mul_add(
                                                            y_2_by_y_1,
                                                            acceleration_0_part_21.mul_add(y_2_by_crank_1, lit(1.0)),
                                                        ),
                                                ),
                                        ),
                                ),
                        ),
                );
            let per_pivot_y_2 = pivot_y_2.recip();
            let safe_y_2 = S::select_le(
                lit(0.0009765625),
                pivot_y_2,
                safe_x_2,
                lit(0.0),
            );
            let right_y_2 = right_coupler_3
                .neg_mul_add(
                    y_2_by_coupler_3,
                    right_coupler_0
                        .neg_mul_add(
                            y_2_by_coupler_0,
                            right_crank_3
                                .mul_add(y_2_by_crank_3, right_crank_1 * y_2_by_crank_1),
                        ),
                )
                - right_x_2
                    .mul_add(
                        y_2_by_x_2,
                        right_y_3
                            .mul_add(
                                y_2_by_y_3,
                                right_y_1.mul_add(y_2_by_y_1, times_g_2),
                            ),
                    );
            let x_2_plus_times_l = x_2 + times_l;
            let crank_2_by_x_2 = x_2_plus_times_l * per_pivot_x_2;
            let acceleration_0_part_28 = acceleration_0_part_27
                .neg_mul_add(crank_2_by_x_2, y_2);
            let pivot_crank_2 = (acceleration_0_part_28 * acceleration_0_part_28)
                .mul_add(per_pivot_y_2, x_2_plus_times_l * crank_2_by_x_2);
            let per_pivot_crank_2 = pivot_crank_2.recip();
            let safe_crank_2 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_2,
                safe_y_2,
                lit(0.0),
            );
            let right_crank_2 = (acceleration_0_part_28 * right_y_2)
                .mul_add(
                    per_pivot_y_2,
                    right_x_2
                        .mul_add(
                            crank_2_by_x_2,
                            dot_y_2.mul_add(dot_y_2, dot_x_2 * dot_x_2),
                        ),
                );
            let x_1_minus_x_2 = x_1 - x_2;
            let coupler_1_by_x_1 = x_1_minus_x_2 * per_pivot_x_1;
            let y_1_minus_y_2 = y_1 - y_2;
            let acceleration_0_part_29 = acceleration_0_part_4
                .neg_mul_add(coupler_1_by_x_1, y_1_minus_y_2);
            let coupler_1_by_y_1 = acceleration_0_part_29 * per_pivot_y_1;
            let coupler_1_with_crank_1 = acceleration_0_part_6
                .mul_add(coupler_1_by_y_1, x_1_minus_l * coupler_1_by_x_1);
            let coupler_1_by_crank_1 = coupler_1_with_crank_1 * per_pivot_crank_1;
            let coupler_1_with_coupler_0 = coupler_0_with_crank_1
                .neg_mul_add(
                    coupler_1_by_crank_1,
                    acceleration_0_part_8
                        .mul_add(
                            coupler_1_by_y_1,
                            acceleration_0_part_7 * coupler_1_by_x_1,
                        ),
                );
            let coupler_1_by_coupler_0 = -(coupler_1_with_coupler_0
                * per_pivot_coupler_0);
            let acceleration_0_part_30 = acceleration_0_part_17
                .neg_mul_add(
                    coupler_1_by_coupler_0,
                    acceleration_0_part_16
                        .neg_mul_add(
                            coupler_1_by_crank_1,
                            acceleration_0_part_15
                                .neg_mul_add(
                                    coupler_1_by_y_1,
                                    lit(0.16666666666666666)
                                        .mul_add(coupler_1_by_x_1, x_1_minus_x_2),
                                ),
                        ),
                );
            let coupler_1_by_x_2 = -(acceleration_0_part_30 * per_pivot_x_2);
            let acceleration_0_part_31 = acceleration_0_part_23
                .mul_add(
                    coupler_1_by_coupler_0,
                    acceleration_0_part_21 * coupler_1_by_crank_1,
                )
                - acceleration_0_part_27
                    .mul_add(
                        coupler_1_by_x_2,
                        lit(0.16666666666666666).mul_add(coupler_1_by_y_1, y_1_minus_y_2),
                    );
            let coupler_1_with_crank_2 = (acceleration_0_part_28
                * acceleration_0_part_31)
                .mul_add(per_pivot_y_2, x_2_plus_times_l * coupler_1_by_x_2);
            let coupler_1_by_crank_2 = coupler_1_with_crank_2 * per_pivot_crank_2;
            let diagonal_coupler_1 = (acceleration_0_part_31 * acceleration_0_part_31)
                .mul_add(
                    per_pivot_y_2,
                    acceleration_0_part_30
                        .neg_mul_add(
                            coupler_1_by_x_2,
                            acceleration_0_part_29
                                .mul_add(coupler_1_by_y_1, x_1_minus_x_2 * coupler_1_by_x_1),
                        ),
                );
            let pivot_coupler_1 = coupler_1_with_crank_2
                .mul_add(
                    coupler_1_by_crank_2,
                    coupler_1_with_coupler_0
                        .mul_add(
                            coupler_1_by_coupler_0,
                            coupler_1_with_crank_1 * coupler_1_by_crank_1,
                        ) - diagonal_coupler_1,
                );
            let per_pivot_coupler_1 = pivot_coupler_1.recip();
            let safe_coupler_1 = S::select_le(
                lit(0.0009765625) * diagonal_coupler_1,
                -pivot_coupler_1,
                safe_crank_2,
                lit(0.0),
            );
            let dot_x_1_minus_dot_x_2 = dot_x_1 - dot_x_2;
            let dot_y_1_minus_dot_y_2 = dot_y_1 - dot_y_2;
            let right_coupler_1 = right_crank_2
                .mul_add(
                    coupler_1_by_crank_2,
                    right_coupler_0
                        .neg_mul_add(
                            coupler_1_by_coupler_0,
                            right_crank_1 * coupler_1_by_crank_1,
                        )
                        - (right_y_2 * acceleration_0_part_31)
                            .mul_add(
                                per_pivot_y_2,
                                right_x_2
                                    .mul_add(
                                        coupler_1_by_x_2,
                                        right_y_1
                                            .mul_add(
                                                coupler_1_by_y_1,
                                                acceleration_0_part_5
                                                    .mul_add(
                                                        coupler_1_by_x_1,
                                                        dot_y_1_minus_dot_y_2
                                                            .mul_add(
                                                                dot_y_1_minus_dot_y_2,
                                                                dot_x_1_minus_dot_x_2 * dot_x_1_minus_dot_x_2,
                                                            ),
                                                    ),
                                            ),
                                    ),
                            ),
                );
            let x_2_minus_x_3 = x_2 - x_3;
            let coupler_2_by_x_3 = x_2_minus_x_3 * per_pivot_x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            let acceleration_0_part_32 = acceleration_0_part_10
                .neg_mul_add(coupler_2_by_x_3, y_2_minus_y_3);
            let coupler_2_by_y_3 = acceleration_0_part_32 * per_pivot_y_3;
            let coupler_2_with_crank_3 = acceleration_0_part_12
                .mul_add(coupler_2_by_y_3, x_3_plus_times_l_2 * coupler_2_by_x_3);
            let coupler_2_by_crank_3 = coupler_2_with_crank_3 * per_pivot_crank_3;
            let coupler_2_with_coupler_3 = coupler_2_with_crank_3 * coupler_3_by_crank_3
                - acceleration_0_part_32
                    .mul_add(coupler_3_by_y_3, x_2_minus_x_3 * coupler_3_by_x_3);
            let coupler_2_by_coupler_3 = coupler_2_with_coupler_3 * per_pivot_coupler_3;
            let acceleration_0_part_33 = acceleration_0_part_20
                .neg_mul_add(
                    coupler_2_by_coupler_3,
                    acceleration_0_part_19 * coupler_2_by_crank_3
                        - acceleration_0_part_18
                            .neg_mul_add(
                                coupler_2_by_y_3,
                                lit(0.16666666666666666)
                                    .mul_add(coupler_2_by_x_3, x_2_minus_x_3),
                            ),
                );
            let coupler_2_by_x_2 = acceleration_0_part_33 * per_pivot_x_2;
            let acceleration_0_part_34 = acceleration_0_part_26
                .neg_mul_add(
                    coupler_2_by_coupler_3,
                    acceleration_0_part_24 * coupler_2_by_crank_3,
                )
                - acceleration_0_part_27
                    .mul_add(
                        coupler_2_by_x_2,
                        lit(0.16666666666666666).mul_add(coupler_2_by_y_3, y_2_minus_y_3),
                    );
            let coupler_2_with_crank_2 = (acceleration_0_part_28
                * acceleration_0_part_34)
                .mul_add(per_pivot_y_2, x_2_plus_times_l * coupler_2_by_x_2);
            let coupler_2_by_crank_2 = coupler_2_with_crank_2 * per_pivot_crank_2;
            let coupler_2_with_coupler_1 = coupler_1_with_crank_2
                .mul_add(
                    coupler_2_by_crank_2,
                    (acceleration_0_part_34 * acceleration_0_part_31)
                        .neg_mul_add(
                            per_pivot_y_2,
                            acceleration_0_part_30 * coupler_2_by_x_2,
                        ),
                );
            let acceleration_0_part_35 = (acceleration_0_part_34
                * acceleration_0_part_34)
                .mul_add(
                    per_pivot_y_2,
                    acceleration_0_part_33
                        .mul_add(
                            coupler_2_by_x_2,
                            acceleration_0_part_32
                                .mul_add(coupler_2_by_y_3, x_2_minus_x_3 * coupler_2_by_x_3),
                        ),
                );
            let pivot_coupler_2 = coupler_2_with_crank_2
                .mul_add(
                    coupler_2_by_crank_2,
                    coupler_2_with_coupler_3
                        .neg_mul_add(
                            coupler_2_by_coupler_3,
                            coupler_2_with_crank_3 * coupler_2_by_crank_3,
                        ) - acceleration_0_part_35,
                )
                .neg_mul_add(
                    pivot_coupler_1,
                    coupler_2_with_coupler_1 * coupler_2_with_coupler_1,
                );
            let per_pivot_coupler_2 = pivot_coupler_2.recip();
            let diagonal_coupler_2 = acceleration_0_part_35 * pivot_coupler_1;
            let safe_coupler_2 = S::select_le(
                lit(-0.0009765625) * diagonal_coupler_2,
                -pivot_coupler_2,
                safe_coupler_1,
                lit(0.0),
            );
            let dot_x_2_minus_dot_x_3 = dot_x_2 - dot_x_3;
            let dot_y_2_minus_dot_y_3 = dot_y_2 - dot_y_3;
            let right_coupler_2 = right_crank_2
                .mul_add(
                    coupler_2_by_crank_2,
                    right_coupler_3
                        .neg_mul_add(
                            coupler_2_by_coupler_3,
                            right_crank_3 * coupler_2_by_crank_3,
                        )
                        + (right_y_2 * acceleration_0_part_34)
                            .neg_mul_add(
                                per_pivot_y_2,
                                right_x_2
                                    .neg_mul_add(
                                        coupler_2_by_x_2,
                                        right_y_3
                                            .neg_mul_add(
                                                coupler_2_by_y_3,
                                                acceleration_0_part_11
                                                    .neg_mul_add(
                                                        coupler_2_by_x_3,
                                                        dot_y_2_minus_dot_y_3
                                                            .mul_add(
                                                                dot_y_2_minus_dot_y_3,
                                                                dot_x_2_minus_dot_x_3 * dot_x_2_minus_dot_x_3,
                                                            ),
                                                    ),
                                            ),
                                    ),
                            ),
                )
                .neg_mul_add(
                    pivot_coupler_1,
                    coupler_2_with_coupler_1 * right_coupler_1,
                );
            let safe = safe_coupler_2;
            let lambda_coupler_1 = (coupler_2_with_coupler_1 * right_coupler_2
                * per_pivot_coupler_1)
                .neg_mul_add(per_pivot_coupler_2, right_coupler_1 * per_pivot_coupler_1);
            let lambda_crank_2 = coupler_1_by_crank_2
                .neg_mul_add(
                    lambda_coupler_1,
                    (coupler_2_by_crank_2 * right_coupler_2)
                        .neg_mul_add(
                            per_pivot_coupler_2,
                            right_crank_2 * per_pivot_crank_2,
                        ),
                );
            let safe_part = (acceleration_0_part_28 * per_pivot_y_2)
                .neg_mul_add(
                    lambda_crank_2,
                    (acceleration_0_part_31 * per_pivot_y_2)
                        .neg_mul_add(
                            lambda_coupler_1,
                            (acceleration_0_part_34 * per_pivot_y_2 * right_coupler_2)
                                .neg_mul_add(per_pivot_coupler_2, right_y_2 * per_pivot_y_2),
                        ),
                );
            out[7] = safe_part;
            let acceleration_8_part = y_2_by_x_2
                .neg_mul_add(
                    safe_part,
                    crank_2_by_x_2
                        .neg_mul_add(
                            lambda_crank_2,
                            coupler_1_by_x_2
                                .neg_mul_add(
                                    lambda_coupler_1,
                                    (coupler_2_by_x_2 * right_coupler_2)
                                        .neg_mul_add(per_pivot_coupler_2, right_x_2 * per_pivot_x_2),
                                ),
                        ),
                );
            out[2] = acceleration_8_part;
            let lambda_coupler_0 = x_2_by_coupler_0
                .neg_mul_add(
                    acceleration_8_part,
                    y_2_by_coupler_0
                        .neg_mul_add(
                            safe_part,
                            coupler_1_by_coupler_0
                                .neg_mul_add(
                                    lambda_coupler_1,
                                    right_coupler_0 * per_pivot_coupler_0,
                                ),
                        ),
                );
            let lambda_crank_1 = coupler_0_by_crank_1
                .neg_mul_add(
                    lambda_coupler_0,
                    x_2_by_crank_1
                        .neg_mul_add(
                            acceleration_8_part,
                            y_2_by_crank_1
                                .neg_mul_add(
                                    safe_part,
                                    coupler_1_by_crank_1
                                        .neg_mul_add(
                                            lambda_coupler_1,
                                            right_crank_1 * per_pivot_crank_1,
                                        ),
                                ),
                        ),
                );
            let acceleration_3_part = crank_1_by_y_1
                .neg_mul_add(
                    lambda_crank_1,
                    coupler_0_by_y_1
                        .neg_mul_add(
                            lambda_coupler_0,
                            x_2_by_y_1
                                .mul_add(
                                    acceleration_8_part,
                                    y_2_by_y_1
                                        .neg_mul_add(
                                            safe_part,
                                            coupler_1_by_y_1
                                                .neg_mul_add(lambda_coupler_1, right_y_1 * per_pivot_y_1),
                                        ),
                                ),
                        ),
                );
            out[6] = acceleration_3_part;
            let lambda_coupler_3 = x_2_by_coupler_3
                .neg_mul_add(
                    acceleration_8_part,
                    y_2_by_coupler_3
                        .neg_mul_add(
                            safe_part,
                            (coupler_2_by_coupler_3 * right_coupler_2)
                                .neg_mul_add(
                                    per_pivot_coupler_2,
                                    right_coupler_3 * per_pivot_coupler_3,
                                ),
                        ),
                );
            let lambda_crank_3 = coupler_3_by_crank_3
                .neg_mul_add(
                    lambda_coupler_3,
                    x_2_by_crank_3
                        .neg_mul_add(
                            acceleration_8_part,
                            y_2_by_crank_3
                                .neg_mul_add(
                                    safe_part,
                                    (coupler_2_by_crank_3 * right_coupler_2)
                                        .neg_mul_add(
                                            per_pivot_coupler_2,
                                            right_crank_3 * per_pivot_crank_3,
                                        ),
                                ),
                        ),
                );
            let acceleration_7_part = crank_3_by_y_3
                .neg_mul_add(
                    lambda_crank_3,
                    coupler_3_by_y_3
                        .neg_mul_add(
                            lambda_coupler_3,
                            x_2_by_y_3
                                .mul_add(
                                    acceleration_8_part,
                                    y_2_by_y_3
                                        .neg_mul_add(
                                            safe_part,
                                            (coupler_2_by_y_3 * right_coupler_2)
                                                .neg_mul_add(per_pivot_coupler_2, right_y_3 * per_pivot_y_3),
                                        ),
                                ),
                        ),
                );
            out[8] = acceleration_7_part;
            let acceleration_9_part = y_1_by_x_1
                .neg_mul_add(
                    acceleration_3_part,
                    crank_1_by_x_1
                        .neg_mul_add(
                            lambda_crank_1,
                            coupler_0_by_x_1
                                .neg_mul_add(
                                    lambda_coupler_0,
                                    x_2_by_x_1
                                        .neg_mul_add(
                                            acceleration_8_part,
                                            coupler_1_by_x_1
                                                .neg_mul_add(
                                                    lambda_coupler_1,
                                                    right_crank_0 * x_1_by_crank_0 * per_pivot_x_1,
                                                ),
                                        ),
                                ),
                        ),
                );
            out[1] = acceleration_9_part;
            let acceleration_2_part = y_3_by_x_3
                .neg_mul_add(
                    acceleration_7_part,
                    crank_3_by_x_3
                        .neg_mul_add(
                            lambda_crank_3,
                            coupler_3_by_x_3
                                .neg_mul_add(
                                    lambda_coupler_3,
                                    x_2_by_x_3
                                        .neg_mul_add(
                                            acceleration_8_part,
                                            (coupler_2_by_x_3 * right_coupler_2)
                                                .neg_mul_add(
                                                    per_pivot_coupler_2,
                                                    right_crank_4 * x_3_by_crank_4 * per_pivot_x_3,
                                                ),
                                        ),
                                ),
                        ),
                );
            out[3] = acceleration_2_part;
            let lambda_crank_0 = x_1_by_crank_0
                .neg_mul_add(
                    acceleration_9_part,
                    y_1_by_crank_0
                        .neg_mul_add(
                            acceleration_3_part,
                            coupler_0_by_crank_0
                                .neg_mul_add(
                                    lambda_coupler_0,
                                    right_crank_0 * per_pivot_crank_0,
                                ),
                        ),
                );
            out[0] = crank_0_by_x_0
                .neg_mul_add(
                    lambda_crank_0,
                    lit(0.25)
                        .neg_mul_add(
                            acceleration_9_part,
                            -(coupler_0_by_x_0 * lambda_coupler_0),
                        ),
                );
            let lambda_crank_4 = x_3_by_crank_4
                .neg_mul_add(
                    acceleration_2_part,
                    y_3_by_crank_4
                        .neg_mul_add(
                            acceleration_7_part,
                            coupler_3_by_crank_4
                                .neg_mul_add(
                                    lambda_coupler_3,
                                    right_crank_4 * per_pivot_crank_4,
                                ),
                        ),
                );
            out[4] = crank_4_by_x_4
                .neg_mul_add(
                    lambda_crank_4,
                    lit(0.25)
                        .neg_mul_add(
                            acceleration_2_part,
                            -(coupler_3_by_x_4 * lambda_coupler_3),
                        ),
                );
            out[5] = crank_0_by_y_0
                .neg_mul_add(
                    lambda_crank_0,
                    lit(0.25)
                        .neg_mul_add(
                            acceleration_3_part,
                            coupler_0_by_y_0.neg_mul_add(lambda_coupler_0, -times_g_2),
                        ),
                );
            out[9] = crank_4_by_y_4
                .neg_mul_add(
                    lambda_crank_4,
                    lit(0.25)
                        .neg_mul_add(
                            acceleration_7_part,
                            coupler_3_by_y_4.neg_mul_add(lambda_coupler_3, -times_g_2),
                        ),
                );
            safe
        }
        fn correction<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            residual: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 10>(out, "out");
            let [_, _, _, l, times_l, times_l_2, times_l_3, _, _, _, safe_x_0, _, _, _,
            ] = *ukcore::emitted::exact::<S, 14>(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *ukcore::emitted::exact::<
                S,
                10,
            >(q, "q");
            let [residual_0, residual_1, residual_2, residual_3, residual_4, residual_5,
            residual_6, residual_7, residual_8] = *ukcore::emitted::exact::<
                S,
                9,
            >(residual, "residual");
            let lit = S::from_f64;
            let crank_0_by_x_0 = lit(1.5) * x_0;
            let crank_0_by_y_0 = lit(1.5) * y_0;
            let pivot_crank_0 = y_0.mul_add(crank_0_by_y_0, x_0 * crank_0_by_x_0);
            let per_pivot_crank_0 = pivot_crank_0.recip();
            let safe_crank_0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_0,
                safe_x_0,
                lit(0.0),
            );
            let crank_4_by_y_4 = lit(1.5) * y_4;
            let x_4_plus_times_l_3 = x_4 + times_l_3;
            let crank_4_by_x_4 = lit(1.5) * x_4_plus_times_l_3;
            let pivot_crank_4 = x_4_plus_times_l_3
                .mul_add(crank_4_by_x_4, y_4 * crank_4_by_y_4);
            let per_pivot_crank_4 = pivot_crank_4.recip();
            let safe_crank_4 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_4,
                safe_crank_0,
                lit(0.0),
            );
            let correction_0_part = lit(0.16666666666666666) * crank_0_by_x_0;
            let x_1_by_crank_0 = correction_0_part * per_pivot_crank_0;
            let pivot_x_1 = correction_0_part
                .mul_add(x_1_by_crank_0, lit(0.9583333333333334));
            let per_pivot_x_1 = pivot_x_1.recip();
            let safe_x_1 = S::select_le(
                lit(0.0009765625),
                pivot_x_1,
                safe_crank_4,
                lit(0.0),
            );
            let correction_0_part_2 = lit(0.16666666666666666) * crank_4_by_x_4;
            let x_3_by_crank_4 = correction_0_part_2 * per_pivot_crank_4;
            let pivot_x_3 = correction_0_part_2
                .mul_add(x_3_by_crank_4, lit(0.9583333333333334));
            let per_pivot_x_3 = pivot_x_3.recip();
            let safe_x_3 = S::select_le(
                lit(0.0009765625),
                pivot_x_3,
                safe_x_1,
                lit(0.0),
            );
            let correction_0_part_3 = lit(0.16666666666666666) * crank_0_by_y_0;
            let y_1_by_crank_0 = correction_0_part_3 * per_pivot_crank_0;
            let correction_0_part_4 = correction_0_part * y_1_by_crank_0;
            let y_1_by_x_1 = correction_0_part_4 * per_pivot_x_1;
            let pivot_y_1 = correction_0_part_4
                .neg_mul_add(
                    y_1_by_x_1,
                    correction_0_part_3.mul_add(y_1_by_crank_0, lit(0.9583333333333334)),
                );
            let per_pivot_y_1 = pivot_y_1.recip();
            let safe_y_1 = S::select_le(
                lit(0.0009765625),
                pivot_y_1,
                safe_x_3,
                lit(0.0),
            );
            let x_1_minus_l = x_1 - l;
            let crank_1_by_x_1 = x_1_minus_l * per_pivot_x_1;
            let correction_0_part_5 = correction_0_part_4
                .neg_mul_add(crank_1_by_x_1, y_1);
            let crank_1_by_y_1 = correction_0_part_5 * per_pivot_y_1;
            let pivot_crank_1 = correction_0_part_5
                .mul_add(crank_1_by_y_1, x_1_minus_l * crank_1_by_x_1);
            let per_pivot_crank_1 = pivot_crank_1.recip();
            let safe_crank_1 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_1,
                safe_y_1,
                lit(0.0),
            );
            let x_0_minus_x_1 = x_0 - x_1;
            let coupler_0_by_x_0 = lit(1.5) * x_0_minus_x_1;
            let y_0_minus_y_1 = y_0 - y_1;
            let coupler_0_by_y_0 = lit(1.5) * y_0_minus_y_1;
            let coupler_0_with_crank_0 = y_0
                .mul_add(coupler_0_by_y_0, x_0 * coupler_0_by_x_0);
            let coupler_0_by_crank_0 = coupler_0_with_crank_0 * per_pivot_crank_0;
            let correction_0_part_6 = correction_0_part * coupler_0_by_crank_0
                - lit(0.16666666666666666).mul_add(coupler_0_by_x_0, x_0_minus_x_1);
            let coupler_0_by_x_1 = correction_0_part_6 * per_pivot_x_1;
            let correction_0_part_7 = correction_0_part_3 * coupler_0_by_crank_0
                - correction_0_part_4
                    .mul_add(
                        coupler_0_by_x_1,
                        lit(0.16666666666666666).mul_add(coupler_0_by_y_0, y_0_minus_y_1),
                    );
            let coupler_0_by_y_1 = correction_0_part_7 * per_pivot_y_1;
            let diagonal_coupler_0 = correction_0_part_7
                .mul_add(
                    coupler_0_by_y_1,
                    correction_0_part_6
                        .mul_add(
                            coupler_0_by_x_1,
                            y_0_minus_y_1
                                .mul_add(coupler_0_by_y_0, x_0_minus_x_1 * coupler_0_by_x_0),
                        ),
                );
            let coupler_0_with_crank_1 = correction_0_part_5
                .mul_add(coupler_0_by_y_1, x_1_minus_l * coupler_0_by_x_1);
            let coupler_0_by_crank_1 = coupler_0_with_crank_1 * per_pivot_crank_1;
            let pivot_coupler_0 = coupler_0_with_crank_1
                .mul_add(
                    coupler_0_by_crank_1,
                    coupler_0_with_crank_0 * coupler_0_by_crank_0 - diagonal_coupler_0,
                );
            let per_pivot_coupler_0 = pivot_coupler_0.recip();
            let safe_coupler_0 = S::select_le(
                lit(0.0009765625) * diagonal_coupler_0,
                -pivot_coupler_0,
                safe_crank_1,
                lit(0.0),
            );
            let correction_0_part_8 = lit(0.16666666666666666) * crank_4_by_y_4;
            let y_3_by_crank_4 = correction_0_part_8 * per_pivot_crank_4;
            let correction_0_part_9 = correction_0_part_2 * y_3_by_crank_4;
            let y_3_by_x_3 = correction_0_part_9 * per_pivot_x_3;
            let pivot_y_3 = correction_0_part_9
                .neg_mul_add(
                    y_3_by_x_3,
                    correction_0_part_8.mul_add(y_3_by_crank_4, lit(0.9583333333333334)),
                );
            let per_pivot_y_3 = pivot_y_3.recip();
            let safe_y_3 = S::select_le(
                lit(0.0009765625),
                pivot_y_3,
                safe_coupler_0,
                lit(0.0),
            );
            let x_3_plus_times_l_2 = x_3 + times_l_2;
            let crank_3_by_x_3 = x_3_plus_times_l_2 * per_pivot_x_3;
            let correction_0_part_10 = correction_0_part_9
                .neg_mul_add(crank_3_by_x_3, y_3);
            let crank_3_by_y_3 = correction_0_part_10 * per_pivot_y_3;
            let pivot_crank_3 = correction_0_part_10
                .mul_add(crank_3_by_y_3, x_3_plus_times_l_2 * crank_3_by_x_3);
            let per_pivot_crank_3 = pivot_crank_3.recip();
            let safe_crank_3 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_3,
                safe_y_3,
                lit(0.0),
            );
            let y_3_minus_y_4 = y_3 - y_4;
            let coupler_3_by_y_4 = lit(1.5) * y_3_minus_y_4;
            let x_3_minus_x_4 = x_3 - x_4;
            let coupler_3_by_x_4 = lit(1.5) * x_3_minus_x_4;
            let coupler_3_with_crank_4 = x_4_plus_times_l_3
                .mul_add(coupler_3_by_x_4, y_4 * coupler_3_by_y_4);
            let coupler_3_by_crank_4 = coupler_3_with_crank_4 * per_pivot_crank_4;
            let correction_0_part_11 = correction_0_part_2
                .neg_mul_add(
                    coupler_3_by_crank_4,
                    lit(0.16666666666666666).mul_add(coupler_3_by_x_4, x_3_minus_x_4),
                );
            let coupler_3_by_x_3 = -(correction_0_part_11 * per_pivot_x_3);
            let correction_0_part_12 = correction_0_part_8 * coupler_3_by_crank_4
                - correction_0_part_9
                    .mul_add(
                        coupler_3_by_x_3,
                        lit(0.16666666666666666).mul_add(coupler_3_by_y_4, y_3_minus_y_4),
                    );
            let coupler_3_by_y_3 = correction_0_part_12 * per_pivot_y_3;
            let coupler_3_with_crank_3 = correction_0_part_10
                .mul_add(coupler_3_by_y_3, x_3_plus_times_l_2 * coupler_3_by_x_3);
            let coupler_3_by_crank_3 = coupler_3_with_crank_3 * per_pivot_crank_3;
            let diagonal_coupler_3 = correction_0_part_12
                .mul_add(
                    coupler_3_by_y_3,
                    correction_0_part_11
                        .neg_mul_add(
                            coupler_3_by_x_3,
                            y_3_minus_y_4
                                .mul_add(coupler_3_by_y_4, x_3_minus_x_4 * coupler_3_by_x_4),
                        ),
                );
            let pivot_coupler_3 = coupler_3_with_crank_3
                .mul_add(
                    coupler_3_by_crank_3,
                    coupler_3_with_crank_4 * coupler_3_by_crank_4 - diagonal_coupler_3,
                );
            let per_pivot_coupler_3 = pivot_coupler_3.recip();
            let safe_coupler_3 = S::select_le(
                lit(0.0009765625) * diagonal_coupler_3,
                -pivot_coupler_3,
                safe_crank_3,
                lit(0.0),
            );
            let x_2_by_x_1 = lit(0.16666666666666666) * (per_pivot_x_1);
            let correction_0_part_13 = lit(0.16666666666666666) * y_1_by_x_1;
            let x_2_by_y_1 = correction_0_part_13 * per_pivot_y_1;
            let x_2_by_x_3 = lit(0.16666666666666666) * (per_pivot_x_3);
            let correction_0_part_14 = correction_0_part_13
                .neg_mul_add(crank_1_by_y_1, lit(0.16666666666666666) * crank_1_by_x_1);
            let x_2_by_crank_1 = correction_0_part_14 * per_pivot_crank_1;
            let correction_0_part_15 = correction_0_part_14
                .neg_mul_add(
                    coupler_0_by_crank_1,
                    correction_0_part_13
                        .neg_mul_add(
                            coupler_0_by_y_1,
                            lit(0.16666666666666666) * coupler_0_by_x_1,
                        ),
                );
            let x_2_by_coupler_0 = -(correction_0_part_15 * per_pivot_coupler_0);
            let correction_0_part_16 = lit(0.16666666666666666) * y_3_by_x_3;
            let x_2_by_y_3 = correction_0_part_16 * per_pivot_y_3;
            let correction_0_part_17 = correction_0_part_16
                .neg_mul_add(crank_3_by_y_3, lit(0.16666666666666666) * crank_3_by_x_3);
            let x_2_by_crank_3 = correction_0_part_17 * per_pivot_crank_3;
            let correction_0_part_18 = correction_0_part_17 * coupler_3_by_crank_3
                - correction_0_part_16
                    .neg_mul_add(
                        coupler_3_by_y_3,
                        lit(0.16666666666666666) * coupler_3_by_x_3,
                    );
            let x_2_by_coupler_3 = correction_0_part_18 * per_pivot_coupler_3;
            let pivot_x_2 = correction_0_part_18
                .neg_mul_add(
                    x_2_by_coupler_3,
                    correction_0_part_15
                        .mul_add(
                            x_2_by_coupler_0,
                            correction_0_part_17
                                .mul_add(
                                    x_2_by_crank_3,
                                    correction_0_part_16
                                        .neg_mul_add(
                                            x_2_by_y_3,
                                            correction_0_part_13
                                                .neg_mul_add(
                                                    x_2_by_y_1,
                                                    lit(0.16666666666666666)
                                                        .neg_mul_add(
                                                            x_2_by_x_3,
                                                            lit(0.16666666666666666)
                                                                .neg_mul_add(
                                                                    x_2_by_x_1,
                                                                    correction_0_part_14.mul_add(x_2_by_crank_1, lit(1.0)),
                                                                ),
                                                        ),
                                                ),
                                        ),
                                ),
                        ),
                );
            let per_pivot_x_2 = pivot_x_2.recip();
            let safe_x_2 = S::select_le(
                lit(0.0009765625),
                pivot_x_2,
                safe_coupler_3,
                lit(0.0),
            );
            let y_2_by_y_1 = lit(0.16666666666666666) * (per_pivot_y_1);
            let correction_0_part_19 = lit(0.16666666666666666) * crank_1_by_y_1;
            let y_2_by_crank_1 = correction_0_part_19 * per_pivot_crank_1;
            let correction_0_part_20 = lit(0.16666666666666666) * coupler_0_by_y_1;
            let correction_0_part_21 = correction_0_part_19
                .neg_mul_add(coupler_0_by_crank_1, correction_0_part_20);
            let y_2_by_coupler_0 = -(correction_0_part_21 * per_pivot_coupler_0);
            let y_2_by_y_3 = lit(0.16666666666666666) * (per_pivot_y_3);
            let correction_0_part_22 = lit(0.16666666666666666) * crank_3_by_y_3;
            let y_2_by_crank_3 = correction_0_part_22 * per_pivot_crank_3;
            let correction_0_part_23 = lit(0.16666666666666666) * coupler_3_by_y_3;
            let correction_0_part_24 = correction_0_part_22 * coupler_3_by_crank_3
                - correction_0_part_23;
            let y_2_by_coupler_3 = correction_0_part_24 * per_pivot_coupler_3;
            let correction_0_part_25 = correction_0_part_18
                .neg_mul_add(
                    y_2_by_coupler_3,
                    correction_0_part_15
                        .mul_add(
                            y_2_by_coupler_0,
                            correction_0_part_17
                                .mul_add(
                                    y_2_by_crank_3,
                                    correction_0_part_14
                                        .mul_add(
                                            y_2_by_crank_1,
                                            correction_0_part_16
                                                .mul_add(y_2_by_y_3, correction_0_part_13 * y_2_by_y_1),
                                        ),
                                ),
                        ),
                );
            let y_2_by_x_2 = correction_0_part_25 * per_pivot_x_2;
            let pivot_y_2 = correction_0_part_25
                .neg_mul_add(
                    y_2_by_x_2,
                    correction_0_part_24
                        .neg_mul_add(
                            y_2_by_coupler_3,
                            correction_0_part_21
                                .mul_add(
                                    y_2_by_coupler_0,
                                    correction_0_part_22
                                        .mul_add(
                                            y_2_by_crank_3,
                                            lit(0.16666666666666666)
                                                .neg_mul_add(
                                                    y_2_by_y_3,
                                                    lit(0.16666666666666666)
                                                        .neg_mul_add(
                                                            y_2_by_y_1,
                                                            correction_0_part_19.mul_add(y_2_by_crank_1, lit(1.0)),
                                                        ),
                                                ),
                                        ),
                                ),
                        ),
                );
            let per_pivot_y_2 = pivot_y_2.recip();
            let safe_y_2 = S::select_le(
                lit(0.0009765625),
                pivot_y_2,
                safe_x_2,
                lit(0.0),
            );
            let x_2_plus_times_l = x_2 + times_l;
            let crank_2_by_x_2 = x_2_plus_times_l * per_pivot_x_2;
            let correction_0_part_26 = correction_0_part_25
                .neg_mul_add(crank_2_by_x_2, y_2);
            let pivot_crank_2 = (correction_0_part_26 * correction_0_part_26)
                .mul_add(per_pivot_y_2, x_2_plus_times_l * crank_2_by_x_2);
            let per_pivot_crank_2 = pivot_crank_2.recip();
            let safe_crank_2 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_crank_2,
                safe_y_2,
                lit(0.0),
            );
            let x_1_minus_x_2 = x_1 - x_2;
            let coupler_1_by_x_1 = x_1_minus_x_2 * per_pivot_x_1;
            let y_1_minus_y_2 = y_1 - y_2;
            let correction_0_part_27 = correction_0_part_4
                .neg_mul_add(coupler_1_by_x_1, y_1_minus_y_2);
            let coupler_1_by_y_1 = correction_0_part_27 * per_pivot_y_1;
            let coupler_1_with_crank_1 = correction_0_part_5
                .mul_add(coupler_1_by_y_1, x_1_minus_l * coupler_1_by_x_1);
            let coupler_1_by_crank_1 = coupler_1_with_crank_1 * per_pivot_crank_1;
            let coupler_1_with_coupler_0 = coupler_0_with_crank_1
                .neg_mul_add(
                    coupler_1_by_crank_1,
                    correction_0_part_7
                        .mul_add(
                            coupler_1_by_y_1,
                            correction_0_part_6 * coupler_1_by_x_1,
                        ),
                );
            let coupler_1_by_coupler_0 = -(coupler_1_with_coupler_0
                * per_pivot_coupler_0);
            let correction_0_part_28 = correction_0_part_15
                .neg_mul_add(
                    coupler_1_by_coupler_0,
                    correction_0_part_14
                        .neg_mul_add(
                            coupler_1_by_crank_1,
                            correction_0_part_13
                                .neg_mul_add(
                                    coupler_1_by_y_1,
                                    lit(0.16666666666666666)
                                        .mul_add(coupler_1_by_x_1, x_1_minus_x_2),
                                ),
                        ),
                );
            let coupler_1_by_x_2 = -(correction_0_part_28 * per_pivot_x_2);
            let correction_0_part_29 = correction_0_part_21
                .mul_add(
                    coupler_1_by_coupler_0,
                    correction_0_part_19 * coupler_1_by_crank_1,
                )
                - correction_0_part_25
                    .mul_add(
                        coupler_1_by_x_2,
                        lit(0.16666666666666666).mul_add(coupler_1_by_y_1, y_1_minus_y_2),
                    );
            let coupler_1_with_crank_2 = (correction_0_part_26 * correction_0_part_29)
                .mul_add(per_pivot_y_2, x_2_plus_times_l * coupler_1_by_x_2);
            let coupler_1_by_crank_2 = coupler_1_with_crank_2 * per_pivot_crank_2;
            let diagonal_coupler_1 = (correction_0_part_29 * correction_0_part_29)
                .mul_add(
                    per_pivot_y_2,
                    correction_0_part_28
                        .neg_mul_add(
                            coupler_1_by_x_2,
                            correction_0_part_27
                                .mul_add(coupler_1_by_y_1, x_1_minus_x_2 * coupler_1_by_x_1),
                        ),
                );
            let pivot_coupler_1 = coupler_1_with_crank_2
                .mul_add(
                    coupler_1_by_crank_2,
                    coupler_1_with_coupler_0
                        .mul_add(
                            coupler_1_by_coupler_0,
                            coupler_1_with_crank_1 * coupler_1_by_crank_1,
                        ) - diagonal_coupler_1,
                );
            let per_pivot_coupler_1 = pivot_coupler_1.recip();
            let safe_coupler_1 = S::select_le(
                lit(0.0009765625) * diagonal_coupler_1,
                -pivot_coupler_1,
                safe_crank_2,
                lit(0.0),
            );
            let x_2_minus_x_3 = x_2 - x_3;
            let coupler_2_by_x_3 = x_2_minus_x_3 * per_pivot_x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            let correction_0_part_30 = correction_0_part_9
                .neg_mul_add(coupler_2_by_x_3, y_2_minus_y_3);
            let coupler_2_by_y_3 = correction_0_part_30 * per_pivot_y_3;
            let coupler_2_with_crank_3 = correction_0_part_10
                .mul_add(coupler_2_by_y_3, x_3_plus_times_l_2 * coupler_2_by_x_3);
            let coupler_2_by_crank_3 = coupler_2_with_crank_3 * per_pivot_crank_3;
            let coupler_2_with_coupler_3 = coupler_2_with_crank_3 * coupler_3_by_crank_3
                - correction_0_part_30
                    .mul_add(coupler_3_by_y_3, x_2_minus_x_3 * coupler_3_by_x_3);
            let coupler_2_by_coupler_3 = coupler_2_with_coupler_3 * per_pivot_coupler_3;
            let correction_0_part_31 = correction_0_part_18
                .neg_mul_add(
                    coupler_2_by_coupler_3,
                    correction_0_part_17 * coupler_2_by_crank_3
                        - correction_0_part_16
                            .neg_mul_add(
                                coupler_2_by_y_3,
                                lit(0.16666666666666666)
                                    .mul_add(coupler_2_by_x_3, x_2_minus_x_3),
                            ),
                );
            let coupler_2_by_x_2 = correction_0_part_31 * per_pivot_x_2;
            let correction_0_part_32 = correction_0_part_24
                .neg_mul_add(
                    coupler_2_by_coupler_3,
                    correction_0_part_22 * coupler_2_by_crank_3,
                )
                - correction_0_part_25
                    .mul_add(
                        coupler_2_by_x_2,
                        lit(0.16666666666666666).mul_add(coupler_2_by_y_3, y_2_minus_y_3),
                    );
            let coupler_2_with_crank_2 = (correction_0_part_26 * correction_0_part_32)
                .mul_add(per_pivot_y_2, x_2_plus_times_l * coupler_2_by_x_2);
            let coupler_2_by_crank_2 = coupler_2_with_crank_2 * per_pivot_crank_2;
            let coupler_2_with_coupler_1 = coupler_1_with_crank_2
                .mul_add(
                    coupler_2_by_crank_2,
                    (correction_0_part_32 * correction_0_part_29)
                        .neg_mul_add(
                            per_pivot_y_2,
                            correction_0_part_28 * coupler_2_by_x_2,
                        ),
                );
            let correction_0_part_33 = (correction_0_part_32 * correction_0_part_32)
                .mul_add(
                    per_pivot_y_2,
                    correction_0_part_31
                        .mul_add(
                            coupler_2_by_x_2,
                            correction_0_part_30
                                .mul_add(coupler_2_by_y_3, x_2_minus_x_3 * coupler_2_by_x_3),
                        ),
                );
            let pivot_coupler_2 = coupler_2_with_crank_2
                .mul_add(
                    coupler_2_by_crank_2,
                    coupler_2_with_coupler_3
                        .neg_mul_add(
                            coupler_2_by_coupler_3,
                            coupler_2_with_crank_3 * coupler_2_by_crank_3,
                        ) - correction_0_part_33,
                )
                .neg_mul_add(
                    pivot_coupler_1,
                    coupler_2_with_coupler_1 * coupler_2_with_coupler_1,
                );
            let per_pivot_coupler_2 = pivot_coupler_2.recip();
            let diagonal_coupler_2 = correction_0_part_33 * pivot_coupler_1;
            let safe_coupler_2 = S::select_le(
                lit(-0.0009765625) * diagonal_coupler_2,
                -pivot_coupler_2,
                safe_coupler_1,
                lit(0.0),
            );
            let right_crank_0 = lit(0.5) * residual_0;
            let right_crank_4 = lit(0.5) * residual_4;
            let right_x_1 = right_crank_0 * x_1_by_crank_0;
            let right_x_3 = right_crank_4 * x_3_by_crank_4;
            let correction_0_part_34 = right_x_1;
            let right_y_1 = correction_0_part_34
                .neg_mul_add(y_1_by_x_1, right_crank_0 * y_1_by_crank_0);
            let right_crank_1 = right_y_1
                .mul_add(
                    crank_1_by_y_1,
                    correction_0_part_34.mul_add(crank_1_by_x_1, lit(0.5) * residual_1),
                );
            let right_coupler_0 = right_crank_1
                .mul_add(
                    coupler_0_by_crank_1,
                    right_crank_0 * coupler_0_by_crank_0
                        - right_y_1
                            .mul_add(
                                coupler_0_by_y_1,
                                correction_0_part_34
                                    .mul_add(coupler_0_by_x_1, lit(0.5) * residual_5),
                            ),
                );
            let correction_0_part_35 = right_x_3;
            let right_y_3 = correction_0_part_35
                .neg_mul_add(y_3_by_x_3, right_crank_4 * y_3_by_crank_4);
            let right_crank_3 = right_y_3
                .mul_add(
                    crank_3_by_y_3,
                    correction_0_part_35.mul_add(crank_3_by_x_3, lit(0.5) * residual_3),
                );
            let right_coupler_3 = right_crank_3
                .mul_add(
                    coupler_3_by_crank_3,
                    right_crank_4 * coupler_3_by_crank_4
                        + right_y_3
                            .neg_mul_add(
                                coupler_3_by_y_3,
                                correction_0_part_35
                                    .neg_mul_add(coupler_3_by_x_3, lit(0.5) * residual_8),
                            ),
                );
            let right_x_2 = right_coupler_3
                .neg_mul_add(
                    x_2_by_coupler_3,
                    right_coupler_0
                        .neg_mul_add(
                            x_2_by_coupler_0,
                            right_crank_3
                                .mul_add(
                                    x_2_by_crank_3,
                                    right_crank_1 * x_2_by_crank_1
                                        - right_y_3
                                            .neg_mul_add(
                                                x_2_by_y_3,
                                                right_y_1
                                                    .neg_mul_add(
                                                        x_2_by_y_1,
                                                        correction_0_part_35
                                                            .mul_add(x_2_by_x_3, correction_0_part_34 * x_2_by_x_1),
                                                    ),
                                            ),
                                ),
                        ),
                );
            let right_y_2 = right_coupler_3
                .neg_mul_add(
                    y_2_by_coupler_3,
                    right_coupler_0
                        .neg_mul_add(
                            y_2_by_coupler_0,
                            right_crank_3
                                .mul_add(y_2_by_crank_3, right_crank_1 * y_2_by_crank_1),
                        ),
                )
                - right_x_2
                    .mul_add(
                        y_2_by_x_2,
                        right_y_3.mul_add(y_2_by_y_3, right_y_1 * y_2_by_y_1),
                    );
            let right_crank_2 = (correction_0_part_26 * right_y_2)
                .mul_add(
                    per_pivot_y_2,
                    right_x_2.mul_add(crank_2_by_x_2, lit(0.5) * residual_2),
                );
            let right_coupler_1 = right_crank_2
                .mul_add(
                    coupler_1_by_crank_2,
                    right_coupler_0
                        .neg_mul_add(
                            coupler_1_by_coupler_0,
                            right_crank_1 * coupler_1_by_crank_1,
                        )
                        - (right_y_2 * correction_0_part_29)
                            .mul_add(
                                per_pivot_y_2,
                                right_x_2
                                    .mul_add(
                                        coupler_1_by_x_2,
                                        right_y_1
                                            .mul_add(
                                                coupler_1_by_y_1,
                                                correction_0_part_34
                                                    .mul_add(coupler_1_by_x_1, lit(0.5) * residual_6),
                                            ),
                                    ),
                            ),
                );
            let right_coupler_2 = right_crank_2
                .mul_add(
                    coupler_2_by_crank_2,
                    right_coupler_3
                        .neg_mul_add(
                            coupler_2_by_coupler_3,
                            right_crank_3 * coupler_2_by_crank_3,
                        )
                        + (correction_0_part_32 * right_y_2)
                            .neg_mul_add(
                                per_pivot_y_2,
                                right_x_2
                                    .neg_mul_add(
                                        coupler_2_by_x_2,
                                        right_y_3
                                            .neg_mul_add(
                                                coupler_2_by_y_3,
                                                correction_0_part_35
                                                    .neg_mul_add(coupler_2_by_x_3, lit(0.5) * residual_7),
                                            ),
                                    ),
                            ),
                )
                .neg_mul_add(
                    pivot_coupler_1,
                    coupler_2_with_coupler_1 * right_coupler_1,
                );
            let safe = safe_coupler_2;
            let lambda_coupler_1 = (coupler_2_with_coupler_1 * right_coupler_2
                * per_pivot_coupler_1)
                .neg_mul_add(per_pivot_coupler_2, right_coupler_1 * per_pivot_coupler_1);
            let lambda_crank_2 = coupler_1_by_crank_2
                .neg_mul_add(
                    lambda_coupler_1,
                    (coupler_2_by_crank_2 * right_coupler_2)
                        .neg_mul_add(
                            per_pivot_coupler_2,
                            right_crank_2 * per_pivot_crank_2,
                        ),
                );
            let safe_part = (correction_0_part_26 * per_pivot_y_2)
                .neg_mul_add(
                    lambda_crank_2,
                    (correction_0_part_29 * per_pivot_y_2)
                        .neg_mul_add(
                            lambda_coupler_1,
                            (correction_0_part_32 * per_pivot_y_2 * right_coupler_2)
                                .neg_mul_add(per_pivot_coupler_2, right_y_2 * per_pivot_y_2),
                        ),
                );
            out[7] = safe_part;
            let correction_8_part = y_2_by_x_2
                .neg_mul_add(
                    safe_part,
                    crank_2_by_x_2
                        .neg_mul_add(
                            lambda_crank_2,
                            coupler_1_by_x_2
                                .neg_mul_add(
                                    lambda_coupler_1,
                                    (coupler_2_by_x_2 * right_coupler_2)
                                        .neg_mul_add(per_pivot_coupler_2, right_x_2 * per_pivot_x_2),
                                ),
                        ),
                );
            out[2] = correction_8_part;
            let lambda_coupler_0 = x_2_by_coupler_0
                .neg_mul_add(
                    correction_8_part,
                    y_2_by_coupler_0
                        .neg_mul_add(
                            safe_part,
                            coupler_1_by_coupler_0
                                .neg_mul_add(
                                    lambda_coupler_1,
                                    right_coupler_0 * per_pivot_coupler_0,
                                ),
                        ),
                );
            let lambda_crank_1 = coupler_0_by_crank_1
                .neg_mul_add(
                    lambda_coupler_0,
                    x_2_by_crank_1
                        .neg_mul_add(
                            correction_8_part,
                            y_2_by_crank_1
                                .neg_mul_add(
                                    safe_part,
                                    coupler_1_by_crank_1
                                        .neg_mul_add(
                                            lambda_coupler_1,
                                            right_crank_1 * per_pivot_crank_1,
                                        ),
                                ),
                        ),
                );
            let correction_3_part = crank_1_by_y_1
                .neg_mul_add(
                    lambda_crank_1,
                    coupler_0_by_y_1
                        .neg_mul_add(
                            lambda_coupler_0,
                            x_2_by_y_1
                                .mul_add(
                                    correction_8_part,
                                    y_2_by_y_1
                                        .neg_mul_add(
                                            safe_part,
                                            coupler_1_by_y_1
                                                .neg_mul_add(lambda_coupler_1, right_y_1 * per_pivot_y_1),
                                        ),
                                ),
                        ),
                );
            out[6] = correction_3_part;
            let lambda_coupler_3 = x_2_by_coupler_3
                .neg_mul_add(
                    correction_8_part,
                    y_2_by_coupler_3
                        .neg_mul_add(
                            safe_part,
                            (coupler_2_by_coupler_3 * right_coupler_2)
                                .neg_mul_add(
                                    per_pivot_coupler_2,
                                    right_coupler_3 * per_pivot_coupler_3,
                                ),
                        ),
                );
            let lambda_crank_3 = coupler_3_by_crank_3
                .neg_mul_add(
                    lambda_coupler_3,
                    x_2_by_crank_3
                        .neg_mul_add(
                            correction_8_part,
                            y_2_by_crank_3
                                .neg_mul_add(
                                    safe_part,
                                    (coupler_2_by_crank_3 * right_coupler_2)
                                        .neg_mul_add(
                                            per_pivot_coupler_2,
                                            right_crank_3 * per_pivot_crank_3,
                                        ),
                                ),
                        ),
                );
            let correction_7_part = crank_3_by_y_3
                .neg_mul_add(
                    lambda_crank_3,
                    coupler_3_by_y_3
                        .neg_mul_add(
                            lambda_coupler_3,
                            x_2_by_y_3
                                .mul_add(
                                    correction_8_part,
                                    y_2_by_y_3
                                        .neg_mul_add(
                                            safe_part,
                                            (coupler_2_by_y_3 * right_coupler_2)
                                                .neg_mul_add(per_pivot_coupler_2, right_y_3 * per_pivot_y_3),
                                        ),
                                ),
                        ),
                );
            out[8] = correction_7_part;
            let correction_9_part = y_1_by_x_1
                .neg_mul_add(
                    correction_3_part,
                    crank_1_by_x_1
                        .neg_mul_add(
                            lambda_crank_1,
                            coupler_0_by_x_1
                                .neg_mul_add(
                                    lambda_coupler_0,
                                    x_2_by_x_1
                                        .neg_mul_add(
                                            correction_8_part,
                                            coupler_1_by_x_1
                                                .neg_mul_add(
                                                    lambda_coupler_1,
                                                    right_crank_0 * x_1_by_crank_0 * per_pivot_x_1,
                                                ),
                                        ),
                                ),
                        ),
                );
            out[1] = correction_9_part;
            let correction_2_part = y_3_by_x_3
                .neg_mul_add(
                    correction_7_part,
                    crank_3_by_x_3
                        .neg_mul_add(
                            lambda_crank_3,
                            coupler_3_by_x_3
                                .neg_mul_add(
                                    lambda_coupler_3,
                                    x_2_by_x_3
                                        .neg_mul_add(
                                            correction_8_part,
                                            (coupler_2_by_x_3 * right_coupler_2)
                                                .neg_mul_add(
                                                    per_pivot_coupler_2,
                                                    right_crank_4 * x_3_by_crank_4 * per_pivot_x_3,
                                                ),
                                        ),
                                ),
                        ),
                );
            out[3] = correction_2_part;
            let lambda_crank_0 = x_1_by_crank_0
                .neg_mul_add(
                    correction_9_part,
                    y_1_by_crank_0
                        .neg_mul_add(
                            correction_3_part,
                            coupler_0_by_crank_0
                                .neg_mul_add(
                                    lambda_coupler_0,
                                    right_crank_0 * per_pivot_crank_0,
                                ),
                        ),
                );
            out[0] = crank_0_by_x_0
                .neg_mul_add(
                    lambda_crank_0,
                    lit(0.25)
                        .neg_mul_add(
                            correction_9_part,
                            -(coupler_0_by_x_0 * lambda_coupler_0),
                        ),
                );
            let lambda_crank_4 = x_3_by_crank_4
                .neg_mul_add(
                    correction_2_part,
                    y_3_by_crank_4
                        .neg_mul_add(
                            correction_7_part,
                            coupler_3_by_crank_4
                                .neg_mul_add(
                                    lambda_coupler_3,
                                    right_crank_4 * per_pivot_crank_4,
                                ),
                        ),
                );
            out[4] = crank_4_by_x_4
                .neg_mul_add(
                    lambda_crank_4,
                    lit(0.25)
                        .neg_mul_add(
                            correction_2_part,
                            -(coupler_3_by_x_4 * lambda_coupler_3),
                        ),
                );
            out[5] = crank_0_by_y_0
                .neg_mul_add(
                    lambda_crank_0,
                    lit(0.25)
                        .neg_mul_add(
                            correction_3_part,
                            -(coupler_0_by_y_0 * lambda_coupler_0),
                        ),
                );
            out[9] = crank_4_by_y_4
                .neg_mul_add(
                    lambda_crank_4,
                    lit(0.25)
                        .neg_mul_add(
                            correction_7_part,
                            -(coupler_3_by_y_4 * lambda_coupler_3),
                        ),
                );
            safe
        }
    }
};
