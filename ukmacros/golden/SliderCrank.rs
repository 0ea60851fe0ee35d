/// Planar slider-crank: crank about a fixed bearing at the origin, connecting rod, slider on the x axis; each body has a position
/// and an angle. Bearing, crank pin, wrist pin and guide close the loop and leave one degree of freedom. y points up.
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Mass matrix M (lower triangle), eq. 1:
///
/// ```text
/// M[x1, x1] = m1
/// M[y1, y1] = m1
/// M[th1, th1] = i1
/// M[x2, x2] = m2
/// M[y2, y2] = m2
/// M[th2, th2] = i2
/// M[x3, x3] = m3
/// M[y3, y3] = m3
/// M[th3, th3] = i3
/// ```
///
/// Generalised force Q, eq. 1:
///
/// ```text
/// Q[y1] = -m1*g
/// Q[th1] = torque
/// Q[y2] = -m2*g
/// Q[y3] = -m3*g
/// ```
///
/// Constraints φ, eqs. 3 and 4:
///
/// ```text
/// bearing[0]: x1 - 0.5*r*cos(th1) = 0
/// bearing[1]: y1 - 0.5*r*sin(th1) = 0
/// crank_pin[0]: x1 + 0.5*r*cos(th1) + 0.5*l*cos(th2) - x2 = 0
/// crank_pin[1]: y1 + 0.5*r*sin(th1) + 0.5*l*sin(th2) - y2 = 0
/// wrist_pin[0]: x2 + 0.5*l*cos(th2) - x3 = 0
/// wrist_pin[1]: y2 + 0.5*l*sin(th2) - y3 = 0
/// guide[0]: y3 = 0
/// guide[1]: th3 = 0
/// ```
///
/// Constraint Jacobian A, eq. 5:
///
/// ```text
/// A[bearing[0], x1] = 1
/// A[bearing[0], th1] = 0.5*r*sin(th1)
/// A[bearing[1], y1] = 1
/// A[bearing[1], th1] = -0.5*r*cos(th1)
/// A[crank_pin[0], x1] = 1
/// A[crank_pin[0], th1] = -0.5*r*sin(th1)
/// A[crank_pin[0], x2] = -1
/// A[crank_pin[0], th2] = -0.5*l*sin(th2)
/// A[crank_pin[1], y1] = 1
/// A[crank_pin[1], th1] = 0.5*r*cos(th1)
/// … 9 rows like these …
/// A[guide[1], th3] = 1
/// ```
///
/// Right-hand side b, eq. 5:
///
/// ```text
/// b[bearing[0]] = -0.5*r*cos(th1)*sq(dot(th1))
/// b[bearing[1]] = -0.5*r*sin(th1)*sq(dot(th1))
/// b[crank_pin[0]] = 0.5*(r*cos(th1)*sq(dot(th1)) + l*cos(th2)*sq(dot(th2)))
/// b[crank_pin[1]] = 0.5*(r*sin(th1)*sq(dot(th1)) + l*sin(th2)*sq(dot(th2)))
/// b[wrist_pin[0]] = 0.5*l*cos(th2)*sq(dot(th2))
/// b[wrist_pin[1]] = 0.5*l*sin(th2)*sq(dot(th2))
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 22 of its entries.
/// Coordinate `y3` is not solved for, since `guide[0]` prescribes it alone.
/// Coordinate `th3` is not solved for, since `guide[1]` prescribes it alone.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 5 | 28 | 0 | 0 | 2 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 1088 | 1241 | 17 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 86 | 215 | 11 | 0 | 2 | 16 |
/// | straight line, as emitted | 85 | 151 | 6 | 0 | 2 | 6 |
/// | correction of a projection | 75 | 115 | 6 | 0 | 2 | 6 |
/// | once for a set of parameters | 2 | 26 | 5 | 0 | 0 | 10 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct SliderCrank {
    /// Length of the crank, m
    pub r: f64,
    /// Length of the connecting rod, m
    pub l: f64,
    /// Mass of the crank, kg
    pub m1: f64,
    /// Mass of the connecting rod, kg
    pub m2: f64,
    /// Mass of the slider, kg
    pub m3: f64,
    /// Moment of inertia of the crank about its centre, kg m^2
    pub i1: f64,
    /// Moment of inertia of the connecting rod about its centre, kg m^2
    pub i2: f64,
    /// Moment of inertia of the slider about its centre, kg m^2
    pub i3: f64,
    /// Acceleration of gravity, m/s^2
    pub g: f64,
    /// Constant torque on the crank (with the potential -torque * th1), Nm
    pub torque: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for SliderCrank {
    fn default() -> Self {
        SliderCrank {
            r: 0.1,
            l: 0.3,
            m1: 0.5,
            m2: 0.8,
            m3: 0.6,
            i1: 0.0004,
            i2: 0.006,
            i3: 0.0005,
            g: 9.81,
            torque: 0.0,
        }
    }
}
#[allow(dead_code)]
impl SliderCrank {
    /// Position in q of coordinate `x1`.
    pub const X1: usize = 0;
    /// Position in q of coordinate `y1`.
    pub const Y1: usize = 1;
    /// Position in q of coordinate `th1`.
    pub const TH1: usize = 2;
    /// Position in q of coordinate `x2`.
    pub const X2: usize = 3;
    /// Position in q of coordinate `y2`.
    pub const Y2: usize = 4;
    /// Position in q of coordinate `th2`.
    pub const TH2: usize = 5;
    /// Position in q of coordinate `x3`.
    pub const X3: usize = 6;
    /// Position in q of coordinate `y3`.
    pub const Y3: usize = 7;
    /// Position in q of coordinate `th3`.
    pub const TH3: usize = 8;
    /// Row in A of constraints `bearing`.
    pub const BEARING: [usize; 2] = [0, 1];
    /// Row in A of constraints `crank_pin`.
    pub const CRANK_PIN: [usize; 2] = [2, 3];
    /// Row in A of constraints `wrist_pin`.
    pub const WRIST_PIN: [usize; 2] = [4, 5];
    /// Row in A of constraints `guide`.
    pub const GUIDE: [usize; 2] = [6, 7];
    /// Position of output `crank`.
    pub const OUT_CRANK: usize = 0;
    /// Position of output `stroke`.
    pub const OUT_STROKE: usize = 1;
    /// Position of output `stroke_speed`.
    pub const OUT_STROKE_SPEED: usize = 2;
}
const _: () = {
    use ::ukcore as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<SliderCrank> for ukcore::Prepared {
        fn from(mechanism: SliderCrank) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for SliderCrank {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "SliderCrank",
            doc: "Planar slider-crank: crank about a fixed bearing at the origin, connecting rod, slider on the x axis; each body has a position\nand an angle. Bearing, crank pin, wrist pin and guide close the loop and leave one degree of freedom. y points up.",
            params: &[
                ukcore::ParamSpec {
                    name: "r",
                    doc: "Length of the crank, m",
                    default: 0.1,
                },
                ukcore::ParamSpec {
                    name: "l",
                    doc: "Length of the connecting rod, m",
                    default: 0.3,
                },
                ukcore::ParamSpec {
                    name: "m1",
                    doc: "Mass of the crank, kg",
                    default: 0.5,
                },
                ukcore::ParamSpec {
                    name: "m2",
                    doc: "Mass of the connecting rod, kg",
                    default: 0.8,
                },
                ukcore::ParamSpec {
                    name: "m3",
                    doc: "Mass of the slider, kg",
                    default: 0.6,
                },
                ukcore::ParamSpec {
                    name: "i1",
                    doc: "Moment of inertia of the crank about its centre, kg m^2",
                    default: 0.0004,
                },
                ukcore::ParamSpec {
                    name: "i2",
                    doc: "Moment of inertia of the connecting rod about its centre, kg m^2",
                    default: 0.006,
                },
                ukcore::ParamSpec {
                    name: "i3",
                    doc: "Moment of inertia of the slider about its centre, kg m^2",
                    default: 0.0005,
                },
                ukcore::ParamSpec {
                    name: "g",
                    doc: "Acceleration of gravity, m/s^2",
                    default: 9.81,
                },
                ukcore::ParamSpec {
                    name: "torque",
                    doc: "Constant torque on the crank (with the potential -torque * th1), Nm",
                    default: 0.0,
                },
            ],
            prepared: &[
                ("right_y1", "m1*g"),
                ("right_y2", "m2*g"),
                ("m3_g", "m3*g"),
                ("torque", "torque"),
                ("r", "r"),
                ("l", "l"),
                ("m1", "m1"),
                ("i1", "i1"),
                ("m2", "m2"),
                ("i2", "i2"),
                ("m3", "m3"),
                ("i3", "i3"),
                ("per_i1_sq_r", "sq(r)/i1"),
                ("per_i1_torque_r", "torque*r/i1"),
                ("per_i2_sq_l", "sq(l)/i2"),
                ("per_m1", "1/m1"),
                ("per_i1_torque", "torque/i1"),
                ("prepared_part", "r^4/sq(i1)"),
                ("prepared_part_2", "r^3/i1"),
                ("g", "g"),
                ("per_m3_and_per_m2", "1/m3 + 1/m2"),
                ("per_m2", "1/m2"),
                ("prepared_part_3", "l^4/sq(i2)"),
                ("prepared_part_4", "l^3/i2"),
                ("per_m1_and_per_m2", "1/m1 + 1/m2"),
                ("per_i2_l", "l/i2"),
                ("per_i1", "1/i1"),
                ("per_m3", "1/m3"),
                ("per_i1_r", "r/i1"),
                (
                    "safe_th2",
                    "1 if the pivots that depend on m1, m2, m3, i1, i2 alone are positive and finite, else 0",
                ),
            ],
            coords: &["x1", "y1", "th1", "x2", "y2", "th2", "x3", "y3", "th3"],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "bearing[0]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "x1 - 0.5*r*cos(th1) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "bearing[1]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "y1 - 0.5*r*sin(th1) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "crank_pin[0]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "x1 + 0.5*r*cos(th1) + 0.5*l*cos(th2) - x2 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "crank_pin[1]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "y1 + 0.5*r*sin(th1) + 0.5*l*sin(th2) - y2 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "wrist_pin[0]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "x2 + 0.5*l*cos(th2) - x3 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "wrist_pin[1]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "y2 + 0.5*l*sin(th2) - y3 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "guide[0]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "y3 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "guide[1]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "th3 = 0",
                },
            ],
            holonomic: 8,
            outputs: &[
                ukcore::OutputSpec {
                    name: "crank",
                    doc: "Angle of the crank, rad",
                },
                ukcore::OutputSpec {
                    name: "stroke",
                    doc: "Position of the slider, m",
                },
                ukcore::OutputSpec {
                    name: "stroke_speed",
                    doc: "Velocity of the slider, m/s",
                },
            ],
            switches: &[],
            structure: ukcore::Structure {
                straight_line: true,
                solve: ukcore::Solve {
                    refusal: "",
                    pivots: &[
                        ukcore::Pivot::Prescribed(7, 6, "1"),
                        ukcore::Pivot::Prescribed(8, 7, "1"),
                        ukcore::Pivot::Coordinate(6),
                        ukcore::Pivot::Coordinate(0),
                        ukcore::Pivot::Coordinate(1),
                        ukcore::Pivot::Coordinate(3),
                        ukcore::Pivot::Coordinate(4),
                        ukcore::Pivot::Coordinate(2),
                        ukcore::Pivot::Coordinate(5),
                        ukcore::Pivot::Constraint(0),
                        ukcore::Pivot::Constraint(1),
                        ukcore::Pivot::Constraint(4),
                        ukcore::Pivot::Constraint(5),
                        ukcore::Pivot::Constraint(2),
                        ukcore::Pivot::Constraint(3),
                    ],
                    fill: &[
                        (10, 9),
                        (11, 9),
                        (11, 10),
                        (12, 9),
                        (12, 10),
                        (12, 11),
                        (13, 11),
                        (13, 12),
                        (14, 11),
                        (14, 12),
                        (14, 13),
                    ],
                    checks: &[
                        ukcore::Check::Positive(6),
                        ukcore::Check::Positive(0),
                        ukcore::Check::Positive(3),
                        ukcore::Check::Positive(2),
                        ukcore::Check::Positive(5),
                        ukcore::Check::Positive(9),
                        ukcore::Check::Share(10),
                        ukcore::Check::Positive(13),
                        ukcore::Check::Share(14),
                        ukcore::Check::Share(11),
                        ukcore::Check::Share(12),
                    ],
                    least_share: 0.0009765625,
                },
                mass_pattern: &[
                    (0, 0),
                    (1, 1),
                    (2, 2),
                    (3, 3),
                    (4, 4),
                    (5, 5),
                    (6, 6),
                    (7, 7),
                    (8, 8),
                ],
                jacobian_pattern: &[
                    (0, 0),
                    (0, 2),
                    (1, 1),
                    (1, 2),
                    (2, 0),
                    (2, 2),
                    (2, 3),
                    (2, 5),
                    (3, 1),
                    (3, 2),
                    (3, 4),
                    (3, 5),
                    (4, 3),
                    (4, 5),
                    (4, 6),
                    (5, 4),
                    (5, 5),
                    (5, 7),
                    (6, 7),
                    (7, 8),
                ],
                mass_diagonal: true,
                mass_constant: true,
                jacobian_constant: false,
                massless: &[],
                angles: &[2, 5],
                scleronomic: true,
                nonideal: false,
                potential: true,
                conservative: true,
                left_out: &[
                    "52 of the 72 entries of A: structurally zero, never written",
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "2 of 8 entries of b: identically zero",
                    "5 of 9 entries of Q: identically zero",
                    "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 5,
                        multiplications: 28,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 2,
                        selections: 0,
                    },
                    dense: ukcore::Operations {
                        additions: 1088,
                        multiplications: 1241,
                        divisions: 17,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    unprepared: ukcore::Operations {
                        additions: 86,
                        multiplications: 215,
                        divisions: 11,
                        square_roots: 0,
                        transcendentals: 2,
                        selections: 16,
                    },
                    acceleration: ukcore::Operations {
                        additions: 85,
                        multiplications: 151,
                        divisions: 6,
                        square_roots: 0,
                        transcendentals: 2,
                        selections: 6,
                    },
                    correction: ukcore::Operations {
                        additions: 75,
                        multiplications: 115,
                        divisions: 6,
                        square_roots: 0,
                        transcendentals: 2,
                        selections: 6,
                    },
                    prepare: ukcore::Operations {
                        additions: 2,
                        multiplications: 26,
                        divisions: 5,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 10,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[],
                mass: &[
                    (0, 0, "m1"),
                    (1, 1, "m1"),
                    (2, 2, "i1"),
                    (3, 3, "m2"),
                    (4, 4, "m2"),
                    (5, 5, "i2"),
                    (6, 6, "m3"),
                    (7, 7, "m3"),
                    (8, 8, "i3"),
                ],
                force: &[(1, "-m1*g"), (2, "torque"), (4, "-m2*g"), (7, "-m3*g")],
                nonideal: &[],
                jacobian: &[
                    (0, 0, "1"),
                    (0, 2, "0.5*r*sin(th1)"),
                    (1, 1, "1"),
                    (1, 2, "-0.5*r*cos(th1)"),
                    (2, 0, "1"),
                    (2, 2, "-0.5*r*sin(th1)"),
                    (2, 3, "-1"),
                    (2, 5, "-0.5*l*sin(th2)"),
                    (3, 1, "1"),
                    (3, 2, "0.5*r*cos(th1)"),
                    (3, 4, "-1"),
                    (3, 5, "0.5*l*cos(th2)"),
                    (4, 3, "1"),
                    (4, 5, "-0.5*l*sin(th2)"),
                    (4, 6, "-1"),
                    (5, 4, "1"),
                    (5, 5, "0.5*l*cos(th2)"),
                    (5, 7, "-1"),
                    (6, 7, "1"),
                    (7, 8, "1"),
                ],
                rhs: &[
                    (0, "-0.5*r*cos(th1)*sq(dot(th1))"),
                    (1, "-0.5*r*sin(th1)*sq(dot(th1))"),
                    (2, "0.5*(r*cos(th1)*sq(dot(th1)) + l*cos(th2)*sq(dot(th2)))"),
                    (3, "0.5*(r*sin(th1)*sq(dot(th1)) + l*sin(th2)*sq(dot(th2)))"),
                    (4, "0.5*l*cos(th2)*sq(dot(th2))"),
                    (5, "0.5*l*sin(th2)*sq(dot(th2))"),
                ],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.r,
                1 => self.l,
                2 => self.m1,
                3 => self.m2,
                4 => self.m3,
                5 => self.i1,
                6 => self.i2,
                7 => self.i3,
                8 => self.g,
                9 => self.torque,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.r = value,
                1 => self.l = value,
                2 => self.m1 = value,
                3 => self.m2 = value,
                4 => self.m3 = value,
                5 => self.i1 = value,
                6 => self.i2 = value,
                7 => self.i3 = value,
                8 => self.g = value,
                9 => self.torque = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 30>(prepared, "prepared");
            let [r, l, m1, m2, m3, i1, i2, i3, g, torque] = *ukcore::emitted::exact::<
                S,
                10,
            >(given, "given");
            let lit = S::from_f64;
            let right_y1 = m1 * g;
            prepared[0] = right_y1;
            let right_y2 = m2 * g;
            prepared[1] = right_y2;
            prepared[2] = m3 * g;
            prepared[3] = torque;
            prepared[4] = r;
            prepared[5] = l;
            prepared[6] = m1;
            let per_i1 = i1.recip();
            prepared[7] = i1;
            prepared[8] = m2;
            let per_i2 = i2.recip();
            prepared[9] = i2;
            prepared[10] = m3;
            prepared[11] = i3;
            prepared[12] = r * r * per_i1;
            prepared[13] = torque * r * per_i1;
            prepared[14] = l * l * per_i2;
            let per_m1 = m1.recip();
            prepared[15] = per_m1;
            prepared[16] = torque * per_i1;
            prepared[17] = r.powi(4) / (i1 * i1);
            prepared[18] = r * r * r * per_i1;
            prepared[19] = g;
            let per_m3 = m3.recip();
            let per_m2 = m2.recip();
            prepared[20] = per_m3 + per_m2;
            prepared[21] = per_m2;
            prepared[22] = l.powi(4) / (i2 * i2);
            prepared[23] = l * l * l * per_i2;
            prepared[24] = per_m1 + per_m2;
            prepared[25] = l * per_i2;
            prepared[26] = per_i1;
            prepared[27] = per_m3;
            prepared[28] = r * per_i1;
            let safe_x3 = S::select_le(
                m3,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m3, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            let safe_x1 = S::select_le(
                m1,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m1, safe_x3, lit(0.0)),
                lit(0.0),
            );
            let safe_x2 = S::select_le(
                m2,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m2, safe_x1, lit(0.0)),
                lit(0.0),
            );
            let safe_th1 = S::select_le(
                i1,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), i1, safe_x2, lit(0.0)),
                lit(0.0),
            );
            let safe_th2 = S::select_le(
                i2,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), i2, safe_th1, lit(0.0)),
                lit(0.0),
            );
            prepared[29] = safe_th2;
        }
        /// 5 additions, 28 multiplications, 0 divisions, 0 square roots, 2 transcendentals, 0 selections.
        fn dynamics<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut ukcore::Terms<'_, S>,
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 81>(out.mass, "mass");
            let force = ukcore::emitted::exact_mut::<S, 9>(out.force, "force");
            let nonideal = ukcore::emitted::exact_mut::<S, 9>(out.nonideal, "nonideal");
            let jacobian = ukcore::emitted::exact_mut::<S, 72>(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 8>(out.rhs, "rhs");
            let [right_y1, right_y2, m3_g, torque, r, l, m1, i1, m2, i2, m3, i3, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                30,
            >(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [_, _, dot_th1, _, _, dot_th2, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(v, "v");
            let lit = S::from_f64;
            mass[0] = m1;
            mass[10] = m1;
            mass[20] = i1;
            mass[30] = m2;
            mass[40] = m2;
            mass[50] = i2;
            mass[60] = m3;
            mass[70] = m3;
            mass[80] = i3;
            force[0] = lit(0.0);
            force[1] = -right_y1;
            force[2] = torque;
            force[3] = lit(0.0);
            force[4] = -right_y2;
            force[5] = lit(0.0);
            force[6] = lit(0.0);
            force[7] = -m3_g;
            force[8] = lit(0.0);
            nonideal[0] = lit(0.0);
            nonideal[1] = lit(0.0);
            nonideal[2] = lit(0.0);
            nonideal[3] = lit(0.0);
            nonideal[4] = lit(0.0);
            nonideal[5] = lit(0.0);
            nonideal[6] = lit(0.0);
            nonideal[7] = lit(0.0);
            nonideal[8] = lit(0.0);
            jacobian[0] = lit(1.0);
            let (sin_th1, cos_th1) = th1.sin_cos();
            let sin_th1_r = r * sin_th1;
            jacobian[16] = lit(0.5) * sin_th1_r;
            jacobian[9] = lit(1.0);
            let cos_th1_r = r * cos_th1;
            jacobian[17] = lit(-0.5) * cos_th1_r;
            jacobian[2] = lit(1.0);
            jacobian[18] = lit(-0.5) * sin_th1_r;
            jacobian[26] = lit(-1.0);
            let (sin_th2, cos_th2) = th2.sin_cos();
            let a_crank_pin_0 = lit(-0.5) * (l * sin_th2);
            jacobian[42] = a_crank_pin_0;
            jacobian[11] = lit(1.0);
            jacobian[19] = lit(0.5) * cos_th1_r;
            jacobian[35] = lit(-1.0);
            let a_crank_pin_1 = lit(0.5) * (l * cos_th2);
            jacobian[43] = a_crank_pin_1;
            jacobian[28] = lit(1.0);
            jacobian[44] = a_crank_pin_0;
            jacobian[52] = lit(-1.0);
            jacobian[37] = lit(1.0);
            jacobian[45] = a_crank_pin_1;
            jacobian[61] = lit(-1.0);
            jacobian[62] = lit(1.0);
            jacobian[71] = lit(1.0);
            let cos_th1_sq_dot_th1_r = dot_th1 * dot_th1 * r * cos_th1;
            rhs[0] = lit(-0.5) * cos_th1_sq_dot_th1_r;
            let sin_th1_sq_dot_th1_r = dot_th1 * dot_th1 * r * sin_th1;
            rhs[1] = lit(-0.5) * sin_th1_sq_dot_th1_r;
            let cos_th2_sq_dot_th2_l = dot_th2 * dot_th2 * l * cos_th2;
            rhs[2] = lit(0.5) * (cos_th1_sq_dot_th1_r + cos_th2_sq_dot_th2_l);
            let sin_th2_sq_dot_th2_l = dot_th2 * dot_th2 * l * sin_th2;
            rhs[3] = lit(0.5) * (sin_th1_sq_dot_th1_r + sin_th2_sq_dot_th2_l);
            rhs[4] = lit(0.5) * cos_th2_sq_dot_th2_l;
            rhs[5] = lit(0.5) * sin_th2_sq_dot_th2_l;
            rhs[6] = lit(0.0);
            rhs[7] = lit(0.0);
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 81>(mass, "mass");
            let [_, _, _, _, _, _, m1, i1, m2, i2, m3, i3, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                30,
            >(prepared, "prepared");
            mass[0] = m1;
            mass[10] = m1;
            mass[20] = i1;
            mass[30] = m2;
            mass[40] = m2;
            mass[50] = i2;
            mass[60] = m3;
            mass[70] = m3;
            mass[80] = i3;
        }
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {
            let jacobian = ukcore::emitted::exact_mut::<S, 72>(jacobian, "jacobian");
            let [_, _, _, _, r, l, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _] = *ukcore::emitted::exact::<S, 30>(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let lit = S::from_f64;
            jacobian[0] = lit(1.0);
            let (sin_th1, cos_th1) = th1.sin_cos();
            let sin_th1_r = r * sin_th1;
            jacobian[16] = lit(0.5) * sin_th1_r;
            jacobian[9] = lit(1.0);
            let cos_th1_r = r * cos_th1;
            jacobian[17] = lit(-0.5) * cos_th1_r;
            jacobian[2] = lit(1.0);
            jacobian[18] = lit(-0.5) * sin_th1_r;
            jacobian[26] = lit(-1.0);
            let (sin_th2, cos_th2) = th2.sin_cos();
            let a_crank_pin_0 = lit(-0.5) * (l * sin_th2);
            jacobian[42] = a_crank_pin_0;
            jacobian[11] = lit(1.0);
            jacobian[19] = lit(0.5) * cos_th1_r;
            jacobian[35] = lit(-1.0);
            let a_crank_pin_1 = lit(0.5) * (l * cos_th2);
            jacobian[43] = a_crank_pin_1;
            jacobian[28] = lit(1.0);
            jacobian[44] = a_crank_pin_0;
            jacobian[52] = lit(-1.0);
            jacobian[37] = lit(1.0);
            jacobian[45] = a_crank_pin_1;
            jacobian[61] = lit(-1.0);
            jacobian[62] = lit(1.0);
            jacobian[71] = lit(1.0);
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 8>(phi, "phi");
            let [_, _, _, _, r, l, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _] = *ukcore::emitted::exact::<S, 30>(prepared, "prepared");
            let [x1, y1, th1, x2, y2, th2, x3, y3, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let lit = S::from_f64;
            let (sin_th1, cos_th1) = th1.sin_cos();
            let cos_th1_r = r * cos_th1;
            phi[0] = lit(0.5).neg_mul_add(cos_th1_r, x1);
            let sin_th1_r = r * sin_th1;
            phi[1] = lit(0.5).neg_mul_add(sin_th1_r, y1);
            let (sin_th2, cos_th2) = th2.sin_cos();
            let cos_th2_l = l * cos_th2;
            phi[2] = lit(0.5).mul_add(cos_th2_l, lit(0.5).mul_add(cos_th1_r, x1 - x2));
            let sin_th2_l = l * sin_th2;
            phi[3] = lit(0.5).mul_add(sin_th2_l, lit(0.5).mul_add(sin_th1_r, y1 - y2));
            phi[4] = lit(0.5).mul_add(cos_th2_l, x2 - x3);
            phi[5] = lit(0.5).mul_add(sin_th2_l, y2 - y3);
            phi[6] = y3;
            phi[7] = th3;
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 8>(rate, "rate");
            let [_, _, _, _, r, l, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _] = *ukcore::emitted::exact::<S, 30>(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [dot_x1, dot_y1, dot_th1, dot_x2, dot_y2, dot_th2, dot_x3, dot_y3,
            dot_th3] = *ukcore::emitted::exact::<S, 9>(v, "v");
            let lit = S::from_f64;
            let (sin_th1, cos_th1) = th1.sin_cos();
            let sin_th1_dot_th1_r = dot_th1 * r * sin_th1;
            rate[0] = lit(0.5).mul_add(sin_th1_dot_th1_r, dot_x1);
            let cos_th1_dot_th1_r = dot_th1 * r * cos_th1;
            rate[1] = lit(0.5).neg_mul_add(cos_th1_dot_th1_r, dot_y1);
            let (sin_th2, cos_th2) = th2.sin_cos();
            let sin_th2_dot_th2_l = dot_th2 * l * sin_th2;
            rate[2] = lit(0.5)
                .neg_mul_add(
                    sin_th2_dot_th2_l,
                    lit(0.5).neg_mul_add(sin_th1_dot_th1_r, dot_x1 - dot_x2),
                );
            let cos_th2_dot_th2_l = dot_th2 * l * cos_th2;
            rate[3] = lit(0.5)
                .mul_add(
                    cos_th2_dot_th2_l,
                    lit(0.5).mul_add(cos_th1_dot_th1_r, dot_y1 - dot_y2),
                );
            rate[4] = lit(0.5).neg_mul_add(sin_th2_dot_th2_l, dot_x2 - dot_x3);
            rate[5] = lit(0.5).mul_add(cos_th2_dot_th2_l, dot_y2 - dot_y3);
            rate[6] = dot_y3;
            rate[7] = dot_th3;
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [right_y1, right_y2, m3_g, torque, _, _, m1, i1, m2, i2, m3, i3, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                30,
            >(prepared, "prepared");
            let [_, y1, th1, _, y2, _, _, y3, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [dot_x1, dot_y1, dot_th1, dot_x2, dot_y2, dot_th2, dot_x3, dot_y3,
            dot_th3] = *ukcore::emitted::exact::<S, 9>(v, "v");
            let lit = S::from_f64;
            let kinetic = lit(0.5)
                * (dot_th3 * dot_th3)
                    .mul_add(
                        i3,
                        (dot_y3 * dot_y3)
                            .mul_add(
                                m3,
                                (dot_x3 * dot_x3)
                                    .mul_add(
                                        m3,
                                        (dot_th2 * dot_th2)
                                            .mul_add(
                                                i2,
                                                (dot_y2 * dot_y2)
                                                    .mul_add(
                                                        m2,
                                                        (dot_x2 * dot_x2)
                                                            .mul_add(
                                                                m2,
                                                                (dot_th1 * dot_th1)
                                                                    .mul_add(
                                                                        i1,
                                                                        (dot_y1 * dot_y1).mul_add(m1, dot_x1 * dot_x1 * m1),
                                                                    ),
                                                            ),
                                                    ),
                                            ),
                                    ),
                            ),
                    );
            let potential = th1
                .neg_mul_add(
                    torque,
                    y3.mul_add(m3_g, y2.mul_add(right_y2, y1 * right_y1)),
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
            let outputs = ukcore::emitted::exact_mut::<S, 3>(outputs, "outputs");
            let [_, _, th1, _, _, _, x3, _, _] = *ukcore::emitted::exact::<S, 9>(q, "q");
            let [_, _, _, _, _, _, dot_x3, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(v, "v");
            outputs[0] = th1;
            outputs[1] = x3;
            outputs[2] = dot_x3;
        }
        /// 85 additions, 151 multiplications, 6 divisions, 0 square roots, 2 transcendentals, 6 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 9>(out, "out");
            let [_, _, _, torque, r, l, _, _, _, _, _, _, per_i1_sq_r, per_i1_torque_r,
            per_i2_sq_l, per_m1, per_i1_torque, prepared_part, prepared_part_2, g,
            per_m3_and_per_m2, per_m2, prepared_part_3, prepared_part_4,
            per_m1_and_per_m2, per_i2_l, per_i1, per_m3, _, safe_th2] = *ukcore::emitted::exact::<
                S,
                30,
            >(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [_, _, dot_th1, _, _, dot_th2, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(v, "v");
            let lit = S::from_f64;
            let (sin_th1, cos_th1) = th1.sin_cos();
            let acceleration_0_part = lit(0.5) * sin_th1;
            let acceleration_0_part_2 = per_i1_sq_r * acceleration_0_part
                * acceleration_0_part;
            let pivot_bearing_0 = per_m1 + acceleration_0_part_2;
            let per_pivot_bearing_0 = pivot_bearing_0.recip();
            let safe_bearing_0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_bearing_0,
                safe_th2,
                lit(0.0),
            );
            let right_bearing_0 = per_i1_torque
                .mul_add(acceleration_0_part, lit(0.5) * dot_th1 * dot_th1 * cos_th1);
            let acceleration_0_part_3 = lit(0.5) * cos_th1;
            let acceleration_0_part_4 = acceleration_0_part * acceleration_0_part_3;
            let acceleration_0_part_5 = acceleration_0_part_4;
            let bearing_1_by_bearing_0 = acceleration_0_part_5 * per_pivot_bearing_0;
            let acceleration_0_part_6 = prepared_part * acceleration_0_part_5
                * bearing_1_by_bearing_0;
            let acceleration_0_part_7 = per_i1_sq_r * acceleration_0_part_3
                * acceleration_0_part_3;
            let diagonal_bearing_1 = per_m1 + acceleration_0_part_7;
            let pivot_bearing_1 = acceleration_0_part_6 - diagonal_bearing_1;
            let per_pivot_bearing_1 = pivot_bearing_1.recip();
            let safe_bearing_1 = S::select_le(
                lit(0.0009765625) * diagonal_bearing_1,
                -pivot_bearing_1,
                safe_bearing_0,
                lit(0.0),
            );
            let acceleration_0_part_8 = prepared_part_2 * right_bearing_0
                * bearing_1_by_bearing_0;
            let sin_th1_sq_dot_th1_r = dot_th1 * dot_th1 * r * sin_th1;
            let acceleration_0_part_9 = per_i1_torque_r * acceleration_0_part_3;
            let right_bearing_1 = (lit(0.5) * sin_th1_sq_dot_th1_r - g
                - acceleration_0_part_9) + acceleration_0_part_8;
            let (sin_th2, cos_th2) = th2.sin_cos();
            let acceleration_0_part_10 = lit(0.5) * sin_th2;
            let acceleration_0_part_11 = per_i2_sq_l * acceleration_0_part_10
                * acceleration_0_part_10;
            let pivot_wrist_pin_0 = per_m3_and_per_m2 + acceleration_0_part_11;
            let per_pivot_wrist_pin_0 = pivot_wrist_pin_0.recip();
            let safe_wrist_pin_0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_wrist_pin_0,
                safe_bearing_1,
                lit(0.0),
            );
            let right_wrist_pin_0 = lit(0.5) * (dot_th2 * dot_th2 * cos_th2);
            let acceleration_0_part_12 = lit(0.5) * cos_th2;
            let acceleration_0_part_13 = acceleration_0_part_10 * acceleration_0_part_12;
            let acceleration_0_part_14 = acceleration_0_part_13;
            let crank_pin_1_by_wrist_pin_0 = acceleration_0_part_14
                * per_pivot_wrist_pin_0;
            let acceleration_0_part_15 = prepared_part_3 * acceleration_0_part_14
                * crank_pin_1_by_wrist_pin_0;
            let acceleration_0_part_16 = per_i2_sq_l * acceleration_0_part_12
                * acceleration_0_part_12;
            let diagonal_wrist_pin_1 = per_m2 + acceleration_0_part_16;
            let pivot_wrist_pin_1 = acceleration_0_part_15 - diagonal_wrist_pin_1;
            let per_pivot_wrist_pin_1 = pivot_wrist_pin_1.recip();
            let safe_wrist_pin_1 = S::select_le(
                lit(0.0009765625) * diagonal_wrist_pin_1,
                -pivot_wrist_pin_1,
                safe_wrist_pin_0,
                lit(0.0),
            );
            let acceleration_0_part_17 = prepared_part_4 * right_wrist_pin_0
                * crank_pin_1_by_wrist_pin_0;
            let sin_th2_sq_dot_th2_l = dot_th2 * dot_th2 * l * sin_th2;
            let right_wrist_pin_1 = lit(0.5).mul_add(sin_th2_sq_dot_th2_l, g)
                + acceleration_0_part_17;
            let crank_pin_0_with_bearing_0 = acceleration_0_part_2 - per_m1;
            let crank_pin_0_by_bearing_0 = -(crank_pin_0_with_bearing_0
                * per_pivot_bearing_0);
            let crank_pin_0_with_bearing_1 = acceleration_0_part_5
                .mul_add(crank_pin_0_by_bearing_0, acceleration_0_part_4);
            let crank_pin_0_by_bearing_1 = crank_pin_0_with_bearing_1
                * per_pivot_bearing_1;
            let crank_pin_0_with_wrist_pin_0 = acceleration_0_part_11 - per_m2;
            let crank_pin_0_by_wrist_pin_0 = -(crank_pin_0_with_wrist_pin_0
                * per_pivot_wrist_pin_0);
            let crank_pin_0_with_wrist_pin_1 = crank_pin_0_with_wrist_pin_0
                .neg_mul_add(crank_pin_1_by_wrist_pin_0, acceleration_0_part_13);
            let crank_pin_0_by_wrist_pin_1 = crank_pin_0_with_wrist_pin_1
                * per_pivot_wrist_pin_1;
            let diagonal_crank_pin_0 = per_m1_and_per_m2 + acceleration_0_part_2
                + acceleration_0_part_11;
            let pivot_crank_pin_0 = (prepared_part * crank_pin_0_with_bearing_1)
                .mul_add(
                    crank_pin_0_by_bearing_1,
                    (prepared_part_3 * crank_pin_0_with_wrist_pin_1)
                        .mul_add(
                            crank_pin_0_by_wrist_pin_1,
                            crank_pin_0_with_wrist_pin_0
                                .mul_add(
                                    crank_pin_0_by_wrist_pin_0,
                                    crank_pin_0_with_bearing_0
                                        .mul_add(crank_pin_0_by_bearing_0, diagonal_crank_pin_0),
                                ),
                        ),
                );
            let per_pivot_crank_pin_0 = pivot_crank_pin_0.recip();
            let safe_crank_pin_0 = S::select_le(
                lit(0.0009765625) * diagonal_crank_pin_0,
                pivot_crank_pin_0,
                safe_wrist_pin_1,
                lit(0.0),
            );
            let right_crank_pin_0 = (per_i1_sq_r * right_bearing_1)
                .neg_mul_add(
                    crank_pin_0_by_bearing_1,
                    (per_i2_sq_l * right_wrist_pin_1)
                        .neg_mul_add(
                            crank_pin_0_by_wrist_pin_1,
                            (l * right_wrist_pin_0)
                                .mul_add(
                                    crank_pin_0_by_wrist_pin_0,
                                    (r * right_bearing_0)
                                        .mul_add(
                                            crank_pin_0_by_bearing_0,
                                            per_i1_torque_r
                                                .mul_add(
                                                    acceleration_0_part,
                                                    lit(0.5)
                                                        * (dot_th2 * dot_th2 * l)
                                                            .mul_add(cos_th2, dot_th1 * dot_th1 * r * cos_th1),
                                                ),
                                        ),
                                ),
                        ),
                );
            let crank_pin_1_with_bearing_1 = acceleration_0_part_6
                - (acceleration_0_part_7 - per_m1);
            let crank_pin_1_by_bearing_1 = crank_pin_1_with_bearing_1
                * per_pivot_bearing_1;
            let crank_pin_1_with_wrist_pin_1 = acceleration_0_part_15
                - (acceleration_0_part_16 - per_m2);
            let crank_pin_1_by_wrist_pin_1 = crank_pin_1_with_wrist_pin_1
                * per_pivot_wrist_pin_1;
            let bearing_1_with_bearing_0 = per_i1_sq_r * acceleration_0_part
                * acceleration_0_part_3;
            let crank_pin_1_with_wrist_pin_0 = per_i2_sq_l * acceleration_0_part_10
                * acceleration_0_part_12;
            let crank_pin_1_with_crank_pin_0 = (per_i2_sq_l
                * crank_pin_0_with_wrist_pin_1)
                .mul_add(
                    crank_pin_1_by_wrist_pin_1,
                    (per_i1_sq_r * crank_pin_0_with_bearing_1)
                        .mul_add(
                            crank_pin_1_by_bearing_1,
                            (per_i2_sq_l * crank_pin_0_with_wrist_pin_0)
                                .mul_add(
                                    crank_pin_1_by_wrist_pin_0,
                                    per_i1_sq_r * crank_pin_0_with_bearing_0
                                        * bearing_1_by_bearing_0
                                        - (bearing_1_with_bearing_0 + crank_pin_1_with_wrist_pin_0),
                                ),
                        ),
                );
            let acceleration_0_part_18 = per_m1_and_per_m2 + acceleration_0_part_7
                + acceleration_0_part_16;
            let pivot_crank_pin_1 = crank_pin_1_with_wrist_pin_1
                .neg_mul_add(
                    crank_pin_1_by_wrist_pin_1,
                    crank_pin_1_with_bearing_1
                        .neg_mul_add(
                            crank_pin_1_by_bearing_1,
                            acceleration_0_part_6 - acceleration_0_part_18
                                + acceleration_0_part_15,
                        ),
                )
                .mul_add(
                    pivot_crank_pin_0,
                    crank_pin_1_with_crank_pin_0 * crank_pin_1_with_crank_pin_0,
                );
            let per_pivot_crank_pin_1 = pivot_crank_pin_1.recip();
            let diagonal_crank_pin_1 = acceleration_0_part_18 * pivot_crank_pin_0;
            let safe_crank_pin_1 = S::select_le(
                lit(0.0009765625) * diagonal_crank_pin_1,
                -pivot_crank_pin_1,
                safe_crank_pin_0,
                lit(0.0),
            );
            let right_crank_pin_1 = right_wrist_pin_1
                .neg_mul_add(
                    crank_pin_1_by_wrist_pin_1,
                    right_bearing_1
                        .neg_mul_add(
                            crank_pin_1_by_bearing_1,
                            (lit(0.5) * (sin_th1_sq_dot_th1_r + sin_th2_sq_dot_th2_l)
                                - acceleration_0_part_9) + acceleration_0_part_8
                                + acceleration_0_part_17,
                        ),
                )
                .neg_mul_add(
                    pivot_crank_pin_0,
                    crank_pin_1_with_crank_pin_0 * right_crank_pin_0,
                );
            out[7] = lit(0.0);
            out[8] = lit(0.0);
            let safe = safe_crank_pin_1;
            let lambda_crank_pin_0 = (crank_pin_1_with_crank_pin_0 * right_crank_pin_1
                * per_pivot_crank_pin_0)
                .neg_mul_add(
                    per_pivot_crank_pin_1,
                    right_crank_pin_0 * per_pivot_crank_pin_0,
                );
            let lambda_bearing_1 = (per_i1_sq_r * crank_pin_0_by_bearing_1)
                .mul_add(
                    lambda_crank_pin_0,
                    (crank_pin_1_by_bearing_1 * right_crank_pin_1)
                        .mul_add(
                            per_pivot_crank_pin_1,
                            right_bearing_1 * per_pivot_bearing_1,
                        ),
                );
            out[1] = per_m1
                .mul_add(
                    lambda_bearing_1,
                    per_m1 * right_crank_pin_1 * per_pivot_crank_pin_1 - g,
                );
            let lambda_wrist_pin_1 = (per_i2_sq_l * crank_pin_0_by_wrist_pin_1)
                .mul_add(
                    lambda_crank_pin_0,
                    (crank_pin_1_by_wrist_pin_1 * right_crank_pin_1)
                        .mul_add(
                            per_pivot_crank_pin_1,
                            right_wrist_pin_1 * per_pivot_wrist_pin_1,
                        ),
                );
            out[4] = per_m2
                .neg_mul_add(
                    lambda_wrist_pin_1,
                    (per_m2 * right_crank_pin_1).neg_mul_add(per_pivot_crank_pin_1, -g),
                );
            let lambda_bearing_0 = (per_i1_sq_r * bearing_1_by_bearing_0)
                .neg_mul_add(
                    lambda_bearing_1,
                    crank_pin_0_by_bearing_0
                        .mul_add(
                            lambda_crank_pin_0,
                            (per_i1_sq_r * bearing_1_by_bearing_0 * right_crank_pin_1)
                                .mul_add(
                                    per_pivot_crank_pin_1,
                                    r * right_bearing_0 * per_pivot_bearing_0,
                                ),
                        ),
                );
            out[0] = per_m1 * (lambda_crank_pin_0 - lambda_bearing_0);
            let lambda_wrist_pin_0 = (per_i2_sq_l * crank_pin_1_by_wrist_pin_0)
                .neg_mul_add(
                    lambda_wrist_pin_1,
                    crank_pin_0_by_wrist_pin_0
                        .mul_add(
                            lambda_crank_pin_0,
                            (per_i2_sq_l * crank_pin_1_by_wrist_pin_0
                                * right_crank_pin_1)
                                .mul_add(
                                    per_pivot_crank_pin_1,
                                    l * right_wrist_pin_0 * per_pivot_wrist_pin_0,
                                ),
                        ),
                );
            out[6] = -(per_m3 * lambda_wrist_pin_0);
            out[2] = per_i1
                * (r * acceleration_0_part)
                    .neg_mul_add(
                        lambda_bearing_0,
                        (r * acceleration_0_part_3)
                            .neg_mul_add(
                                lambda_bearing_1,
                                (r * acceleration_0_part)
                                    .neg_mul_add(
                                        lambda_crank_pin_0,
                                        (r * acceleration_0_part_3 * right_crank_pin_1)
                                            .mul_add(per_pivot_crank_pin_1, torque),
                                    ),
                            ),
                    );
            out[3] = -(per_m2 * (lambda_crank_pin_0 - lambda_wrist_pin_0));
            out[5] = -(per_i2_l
                * acceleration_0_part_10
                    .mul_add(
                        lambda_wrist_pin_0,
                        acceleration_0_part_12
                            .mul_add(
                                lambda_wrist_pin_1,
                                (acceleration_0_part_12 * right_crank_pin_1)
                                    .neg_mul_add(
                                        per_pivot_crank_pin_1,
                                        acceleration_0_part_10 * lambda_crank_pin_0,
                                    ),
                            ),
                    ));
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
            let out = ukcore::emitted::exact_mut::<S, 9>(out, "out");
            let [_, _, _, _, _, _, _, _, _, _, _, _, per_i1_sq_r, _, per_i2_sq_l, per_m1,
            _, prepared_part, _, _, per_m3_and_per_m2, per_m2, prepared_part_3, _,
            per_m1_and_per_m2, per_i2_l, _, per_m3, per_i1_r, safe_th2] = *ukcore::emitted::exact::<
                S,
                30,
            >(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [residual_0, residual_1, residual_2, residual_3, residual_4, residual_5,
            residual_6, residual_7] = *ukcore::emitted::exact::<
                S,
                8,
            >(residual, "residual");
            let lit = S::from_f64;
            let (sin_th1, cos_th1) = th1.sin_cos();
            let correction_0_part = lit(0.5) * sin_th1;
            let sq_correction_0_part_per_i1_sq_r = per_i1_sq_r * correction_0_part
                * correction_0_part;
            let pivot_bearing_0 = per_m1 + sq_correction_0_part_per_i1_sq_r;
            let per_pivot_bearing_0 = pivot_bearing_0.recip();
            let safe_bearing_0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_bearing_0,
                safe_th2,
                lit(0.0),
            );
            let correction_0_part_2 = lit(0.5) * cos_th1;
            let correction_0_part_3 = correction_0_part * correction_0_part_2;
            let correction_0_part_4 = correction_0_part_3;
            let bearing_1_by_bearing_0 = correction_0_part_4 * per_pivot_bearing_0;
            let correction_0_part_5 = prepared_part * correction_0_part_4
                * bearing_1_by_bearing_0;
            let correction_0_part_6 = per_i1_sq_r * correction_0_part_2
                * correction_0_part_2;
            let diagonal_bearing_1 = per_m1 + correction_0_part_6;
            let pivot_bearing_1 = correction_0_part_5 - diagonal_bearing_1;
            let per_pivot_bearing_1 = pivot_bearing_1.recip();
            let safe_bearing_1 = S::select_le(
                lit(0.0009765625) * diagonal_bearing_1,
                -pivot_bearing_1,
                safe_bearing_0,
                lit(0.0),
            );
            let (sin_th2, cos_th2) = th2.sin_cos();
            let correction_0_part_7 = lit(0.5) * sin_th2;
            let correction_0_part_8 = per_i2_sq_l * correction_0_part_7
                * correction_0_part_7;
            let pivot_wrist_pin_0 = per_m3_and_per_m2 + correction_0_part_8;
            let per_pivot_wrist_pin_0 = pivot_wrist_pin_0.recip();
            let safe_wrist_pin_0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_wrist_pin_0,
                safe_bearing_1,
                lit(0.0),
            );
            let correction_0_part_9 = lit(0.5) * cos_th2;
            let correction_0_part_10 = correction_0_part_7 * correction_0_part_9;
            let correction_0_part_11 = correction_0_part_10;
            let crank_pin_1_by_wrist_pin_0 = correction_0_part_11
                * per_pivot_wrist_pin_0;
            let correction_0_part_12 = prepared_part_3 * correction_0_part_11
                * crank_pin_1_by_wrist_pin_0;
            let correction_0_part_13 = per_i2_sq_l * correction_0_part_9
                * correction_0_part_9;
            let diagonal_wrist_pin_1 = per_m2 + correction_0_part_13;
            let pivot_wrist_pin_1 = correction_0_part_12 - diagonal_wrist_pin_1;
            let per_pivot_wrist_pin_1 = pivot_wrist_pin_1.recip();
            let safe_wrist_pin_1 = S::select_le(
                lit(0.0009765625) * diagonal_wrist_pin_1,
                -pivot_wrist_pin_1,
                safe_wrist_pin_0,
                lit(0.0),
            );
            let crank_pin_0_with_bearing_0 = sq_correction_0_part_per_i1_sq_r - per_m1;
            let crank_pin_0_by_bearing_0 = -(crank_pin_0_with_bearing_0
                * per_pivot_bearing_0);
            let crank_pin_0_with_bearing_1 = correction_0_part_4
                .mul_add(crank_pin_0_by_bearing_0, correction_0_part_3);
            let crank_pin_0_by_bearing_1 = crank_pin_0_with_bearing_1
                * per_pivot_bearing_1;
            let crank_pin_0_with_wrist_pin_0 = correction_0_part_8 - per_m2;
            let crank_pin_0_by_wrist_pin_0 = -(crank_pin_0_with_wrist_pin_0
                * per_pivot_wrist_pin_0);
            let crank_pin_0_with_wrist_pin_1 = crank_pin_0_with_wrist_pin_0
                .neg_mul_add(crank_pin_1_by_wrist_pin_0, correction_0_part_10);
            let crank_pin_0_by_wrist_pin_1 = crank_pin_0_with_wrist_pin_1
                * per_pivot_wrist_pin_1;
            let diagonal_crank_pin_0 = per_m1_and_per_m2
                + sq_correction_0_part_per_i1_sq_r + correction_0_part_8;
            let pivot_crank_pin_0 = (prepared_part * crank_pin_0_with_bearing_1)
                .mul_add(
                    crank_pin_0_by_bearing_1,
                    (prepared_part_3 * crank_pin_0_with_wrist_pin_1)
                        .mul_add(
                            crank_pin_0_by_wrist_pin_1,
                            crank_pin_0_with_wrist_pin_0
                                .mul_add(
                                    crank_pin_0_by_wrist_pin_0,
                                    crank_pin_0_with_bearing_0
                                        .mul_add(crank_pin_0_by_bearing_0, diagonal_crank_pin_0),
                                ),
                        ),
                );
            let per_pivot_crank_pin_0 = pivot_crank_pin_0.recip();
            let safe_crank_pin_0 = S::select_le(
                lit(0.0009765625) * diagonal_crank_pin_0,
                pivot_crank_pin_0,
                safe_wrist_pin_1,
                lit(0.0),
            );
            let crank_pin_1_with_bearing_1 = correction_0_part_5
                - (correction_0_part_6 - per_m1);
            let crank_pin_1_by_bearing_1 = crank_pin_1_with_bearing_1
                * per_pivot_bearing_1;
            let crank_pin_1_with_wrist_pin_1 = correction_0_part_12
                - (correction_0_part_13 - per_m2);
            let crank_pin_1_by_wrist_pin_1 = crank_pin_1_with_wrist_pin_1
                * per_pivot_wrist_pin_1;
            let bearing_1_with_bearing_0 = per_i1_sq_r * correction_0_part
                * correction_0_part_2;
            let crank_pin_1_with_wrist_pin_0 = per_i2_sq_l * correction_0_part_7
                * correction_0_part_9;
            let crank_pin_1_with_crank_pin_0 = (per_i2_sq_l
                * crank_pin_0_with_wrist_pin_1)
                .mul_add(
                    crank_pin_1_by_wrist_pin_1,
                    (per_i1_sq_r * crank_pin_0_with_bearing_1)
                        .mul_add(
                            crank_pin_1_by_bearing_1,
                            (per_i2_sq_l * crank_pin_0_with_wrist_pin_0)
                                .mul_add(
                                    crank_pin_1_by_wrist_pin_0,
                                    per_i1_sq_r * crank_pin_0_with_bearing_0
                                        * bearing_1_by_bearing_0
                                        - (bearing_1_with_bearing_0 + crank_pin_1_with_wrist_pin_0),
                                ),
                        ),
                );
            let correction_0_part_14 = per_m1_and_per_m2 + correction_0_part_6
                + correction_0_part_13;
            let pivot_crank_pin_1 = crank_pin_1_with_wrist_pin_1
                .neg_mul_add(
                    crank_pin_1_by_wrist_pin_1,
                    crank_pin_1_with_bearing_1
                        .neg_mul_add(
                            crank_pin_1_by_bearing_1,
                            correction_0_part_5 - correction_0_part_14
                                + correction_0_part_12,
                        ),
                )
                .mul_add(
                    pivot_crank_pin_0,
                    crank_pin_1_with_crank_pin_0 * crank_pin_1_with_crank_pin_0,
                );
            let per_pivot_crank_pin_1 = pivot_crank_pin_1.recip();
            let diagonal_crank_pin_1 = correction_0_part_14 * pivot_crank_pin_0;
            let safe_crank_pin_1 = S::select_le(
                lit(0.0009765625) * diagonal_crank_pin_1,
                -pivot_crank_pin_1,
                safe_crank_pin_0,
                lit(0.0),
            );
            let correction_0_part_15 = residual_0 * per_i1_sq_r * bearing_1_by_bearing_0;
            let right_bearing_1 = residual_1 + correction_0_part_15;
            let correction_0_part_16 = residual_4 * per_i2_sq_l
                * crank_pin_1_by_wrist_pin_0;
            let right_wrist_pin_1 = (residual_5 + residual_6) + correction_0_part_16;
            let right_crank_pin_0 = (per_i1_sq_r * right_bearing_1)
                .mul_add(
                    crank_pin_0_by_bearing_1,
                    (per_i2_sq_l * right_wrist_pin_1)
                        .neg_mul_add(
                            crank_pin_0_by_wrist_pin_1,
                            residual_4
                                .mul_add(
                                    crank_pin_0_by_wrist_pin_0,
                                    residual_0.neg_mul_add(crank_pin_0_by_bearing_0, residual_2),
                                ),
                        ),
                );
            let right_crank_pin_1 = right_wrist_pin_1
                .neg_mul_add(
                    crank_pin_1_by_wrist_pin_1,
                    right_bearing_1
                        .mul_add(
                            crank_pin_1_by_bearing_1,
                            residual_3 - correction_0_part_15 + correction_0_part_16,
                        ),
                )
                .neg_mul_add(
                    pivot_crank_pin_0,
                    crank_pin_1_with_crank_pin_0 * right_crank_pin_0,
                );
            out[7] = -residual_6;
            out[8] = -residual_7;
            let safe = safe_crank_pin_1;
            let lambda_crank_pin_1 = right_crank_pin_1 * per_pivot_crank_pin_1;
            let lambda_crank_pin_0 = (crank_pin_1_with_crank_pin_0 * right_crank_pin_1
                * per_pivot_crank_pin_0)
                .neg_mul_add(
                    per_pivot_crank_pin_1,
                    right_crank_pin_0 * per_pivot_crank_pin_0,
                );
            let lambda_wrist_pin_1 = (per_i2_sq_l * crank_pin_0_by_wrist_pin_1)
                .mul_add(
                    lambda_crank_pin_0,
                    (crank_pin_1_by_wrist_pin_1 * right_crank_pin_1)
                        .mul_add(
                            per_pivot_crank_pin_1,
                            right_wrist_pin_1 * per_pivot_wrist_pin_1,
                        ),
                );
            out[4] = per_m2 * (lambda_crank_pin_1 + lambda_wrist_pin_1);
            let lambda_bearing_1 = (per_i1_sq_r * crank_pin_0_by_bearing_1)
                .neg_mul_add(
                    lambda_crank_pin_0,
                    (crank_pin_1_by_bearing_1 * right_crank_pin_1)
                        .neg_mul_add(
                            per_pivot_crank_pin_1,
                            right_bearing_1 * per_pivot_bearing_1,
                        ),
                );
            out[1] = -(per_m1 * (lambda_crank_pin_1 - lambda_bearing_1));
            let lambda_wrist_pin_0 = (per_i2_sq_l * crank_pin_1_by_wrist_pin_0)
                .neg_mul_add(
                    lambda_wrist_pin_1,
                    crank_pin_0_by_wrist_pin_0
                        .mul_add(
                            lambda_crank_pin_0,
                            (per_i2_sq_l * crank_pin_1_by_wrist_pin_0
                                * right_crank_pin_1)
                                .mul_add(
                                    per_pivot_crank_pin_1,
                                    residual_4 * per_pivot_wrist_pin_0,
                                ),
                        ),
                );
            out[6] = per_m3 * lambda_wrist_pin_0;
            out[3] = per_m2 * (lambda_crank_pin_0 - lambda_wrist_pin_0);
            let lambda_bearing_0 = (per_i1_sq_r * bearing_1_by_bearing_0)
                .neg_mul_add(
                    lambda_bearing_1,
                    crank_pin_0_by_bearing_0
                        .neg_mul_add(
                            lambda_crank_pin_0,
                            (per_i1_sq_r * bearing_1_by_bearing_0 * right_crank_pin_1)
                                .neg_mul_add(
                                    per_pivot_crank_pin_1,
                                    residual_0 * per_pivot_bearing_0,
                                ),
                        ),
                );
            out[0] = -(per_m1 * (lambda_crank_pin_0 + lambda_bearing_0));
            out[5] = per_i2_l
                * correction_0_part_7
                    .mul_add(
                        lambda_wrist_pin_0,
                        correction_0_part_9
                            .mul_add(
                                lambda_wrist_pin_1,
                                (correction_0_part_9 * right_crank_pin_1)
                                    .neg_mul_add(
                                        per_pivot_crank_pin_1,
                                        correction_0_part_7 * lambda_crank_pin_0,
                                    ),
                            ),
                    );
            out[2] = -(per_i1_r
                * correction_0_part
                    .mul_add(
                        lambda_bearing_0,
                        correction_0_part_2
                            .mul_add(
                                lambda_bearing_1,
                                correction_0_part
                                    .neg_mul_add(
                                        lambda_crank_pin_0,
                                        correction_0_part_2 * right_crank_pin_1
                                            * per_pivot_crank_pin_1,
                                    ),
                            ),
                    ));
            safe
        }
    }
};
