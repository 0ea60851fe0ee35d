/// Fish robot of three links: body, peduncle and tail fin. x is longitudinal with the tail at +x, so it swims towards −x; y is
/// lateral. The angles of peduncle and fin are prescribed and carry no inertia, which makes M singular (eqs. 36, 37).
/// Parameters are those of Table 2, with its moments of inertia of peduncle and fin left out as the model does not use them.
/// (Zhao, Zhen & Chen 2013, §6-10.)
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
/// M[x3, x3] = m3
/// M[y3, y3] = m3
/// ```
///
/// Generalised force Q, eq. 1:
///
/// ```text
/// Q[x1] = -0.5*rho*s*dot(x1)*cd*abs(dot(x1))
/// Q[y1] = -0.5*rho*cd*s1*dot(y1)*abs(dot(y1))
/// Q[y2] = -0.5*rho*cd*s2*dot(y2)*abs(dot(y2))
/// Q[x3] = 6.283185307179586*rho*span*half_chord*(dot(x3)*dot(y3)*sin(th3) - sq(dot(y3))*cos(th3))
/// Q[y3] = 6.283185307179586*rho*span*half_chord*(dot(x3)*dot(y3)*cos(th3) - sq(dot(x3))*sin(th3)) - 0.5*rho*dot(y3)*cd*s3*abs(dot(y3))
/// ```
///
/// Constraints φ, eqs. 3 and 4:
///
/// ```text
/// joint1[0]: x1 + a*cos(th1) + 0.5*l2*cos(th2) - x2 = 0
/// joint1[1]: y1 + a*sin(th1) + 0.5*l2*sin(th2) - y2 = 0
/// joint2[0]: x2 + 0.5*l2*cos(th2) + cos(th3)*b - x3 = 0
/// joint2[1]: y2 + 0.5*l2*sin(th2) + sin(th3)*b - y3 = 0
/// peduncle: th2 - a2*sin(w*t) = 0
/// fin: th3 - a3*sin(w*t - phi) = 0
/// ```
///
/// Constraint Jacobian A, eq. 5:
///
/// ```text
/// A[joint1[0], x1] = 1
/// A[joint1[0], th1] = -a*sin(th1)
/// A[joint1[0], x2] = -1
/// A[joint1[0], th2] = -0.5*l2*sin(th2)
/// A[joint1[1], y1] = 1
/// A[joint1[1], th1] = a*cos(th1)
/// A[joint1[1], y2] = -1
/// A[joint1[1], th2] = 0.5*l2*cos(th2)
/// A[joint2[0], x2] = 1
/// A[joint2[0], th2] = -0.5*l2*sin(th2)
/// … 7 rows like these …
/// A[fin, th3] = 1
/// ```
///
/// Right-hand side b, eq. 5:
///
/// ```text
/// b[joint1[0]] = a*cos(th1)*sq(dot(th1)) + 0.5*l2*cos(th2)*sq(dot(th2))
/// b[joint1[1]] = a*sin(th1)*sq(dot(th1)) + 0.5*l2*sin(th2)*sq(dot(th2))
/// b[joint2[0]] = 0.5*l2*cos(th2)*sq(dot(th2)) + cos(th3)*b*sq(dot(th3))
/// b[joint2[1]] = 0.5*l2*sin(th2)*sq(dot(th2)) + sin(th3)*b*sq(dot(th3))
/// b[peduncle] = -a2*sq(w)*sin(w*t)
/// b[fin] = -sq(w)*a3*sin(w*t - phi)
/// ```
///
/// Switches, functions at whose zeros abs, sign, min or max change their branch, with the terms that contain them:
///
/// ```text
/// dot(x1): force on `x1`
/// dot(y1): force on `y1`
/// dot(y2): force on `y2`
/// dot(y3): force on `y3`
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 6 of its entries.
/// Coordinate `th2` is not solved for, since `peduncle` replaces the inertia it lacks.
/// Coordinate `th3` is not solved for, since `fin` replaces the inertia it lacks.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 19 | 52 | 0 | 0 | 5 | 8 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 770 | 890 | 15 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 53 | 165 | 7 | 0 | 5 | 20 |
/// | straight line, as emitted | 51 | 105 | 2 | 0 | 5 | 10 |
/// | correction of a projection | 25 | 53 | 2 | 0 | 3 | 2 |
/// | once for a set of parameters | 2 | 60 | 5 | 0 | 0 | 10 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct FishRobot {
    /// Mass of the body, kg
    pub m1: f64,
    /// Moment of inertia of the body about its centre, kg m^2
    pub i1: f64,
    /// Half length of the body, m
    pub a: f64,
    /// Frontal area of the body, m^2
    pub s: f64,
    /// Lateral area of the body (as printed; far more than a body of this size has), m^2
    pub s1: f64,
    /// Mass of the peduncle, kg
    pub m2: f64,
    /// Length of the peduncle, m
    pub l2: f64,
    /// Lateral area of the peduncle, m^2
    pub s2: f64,
    /// Mass of the fin, kg
    pub m3: f64,
    /// Half length of the fin, m
    pub b: f64,
    /// Lateral area of the fin, m^2
    pub s3: f64,
    /// Density of water, kg/m^3
    pub rho: f64,
    /// Drag coefficient
    pub cd: f64,
    /// Span of the fin, m
    pub span: f64,
    /// Half chord of the fin, m
    pub half_chord: f64,
    /// Amplitude of the peduncle's angle, rad
    pub a2: f64,
    /// Amplitude of the fin's angle, rad
    pub a3: f64,
    /// Angular frequency of the gait, rad/s
    pub w: f64,
    /// Phase by which the fin lags the peduncle, rad
    pub phi: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for FishRobot {
    fn default() -> Self {
        FishRobot {
            m1: 0.409,
            i1: 0.00123,
            a: 0.09375,
            s: 0.007069,
            s1: 0.19,
            m2: 0.104,
            l2: 0.0625,
            s2: 0.04,
            m3: 0.009,
            b: 0.015,
            s3: 0.008,
            rho: 998.0,
            cd: 0.5,
            span: 0.075,
            half_chord: 0.015,
            a2: 0.3,
            a3: 0.6,
            w: ::core::f64::consts::TAU,
            phi: 0.2617993877991494,
        }
    }
}
#[allow(dead_code)]
impl FishRobot {
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
    /// Row in A of constraints `joint1`.
    pub const JOINT1: [usize; 2] = [0, 1];
    /// Row in A of constraints `joint2`.
    pub const JOINT2: [usize; 2] = [2, 3];
    /// Row in A of constraint `peduncle`.
    pub const PEDUNCLE: usize = 4;
    /// Row in A of constraint `fin`.
    pub const FIN: usize = 5;
    /// Position of output `forward_speed`.
    pub const OUT_FORWARD_SPEED: usize = 0;
    /// Position of output `swing`.
    pub const OUT_SWING: usize = 1;
    /// Position of output `fin_x`.
    pub const OUT_FIN_X: usize = 2;
    /// Position of output `fin_y`.
    pub const OUT_FIN_Y: usize = 3;
    /// Position of output `edge_x`.
    pub const OUT_EDGE_X: usize = 4;
    /// Position of output `edge_y`.
    pub const OUT_EDGE_Y: usize = 5;
}
const _: () = {
    use ::ukcore as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<FishRobot> for ukcore::Prepared {
        fn from(mechanism: FishRobot) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for FishRobot {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "FishRobot",
            doc: "Fish robot of three links: body, peduncle and tail fin. x is longitudinal with the tail at +x, so it swims towards −x; y is\nlateral. The angles of peduncle and fin are prescribed and carry no inertia, which makes M singular (eqs. 36, 37).\nParameters are those of Table 2, with its moments of inertia of peduncle and fin left out as the model does not use them.\n(Zhao, Zhen & Chen 2013, §6-10.)",
            params: &[
                ukcore::ParamSpec {
                    name: "m1",
                    doc: "Mass of the body, kg",
                    default: 0.409,
                },
                ukcore::ParamSpec {
                    name: "i1",
                    doc: "Moment of inertia of the body about its centre, kg m^2",
                    default: 0.00123,
                },
                ukcore::ParamSpec {
                    name: "a",
                    doc: "Half length of the body, m",
                    default: 0.09375,
                },
                ukcore::ParamSpec {
                    name: "s",
                    doc: "Frontal area of the body, m^2",
                    default: 0.007069,
                },
                ukcore::ParamSpec {
                    name: "s1",
                    doc: "Lateral area of the body (as printed; far more than a body of this size has), m^2",
                    default: 0.19,
                },
                ukcore::ParamSpec {
                    name: "m2",
                    doc: "Mass of the peduncle, kg",
                    default: 0.104,
                },
                ukcore::ParamSpec {
                    name: "l2",
                    doc: "Length of the peduncle, m",
                    default: 0.0625,
                },
                ukcore::ParamSpec {
                    name: "s2",
                    doc: "Lateral area of the peduncle, m^2",
                    default: 0.04,
                },
                ukcore::ParamSpec {
                    name: "m3",
                    doc: "Mass of the fin, kg",
                    default: 0.009,
                },
                ukcore::ParamSpec {
                    name: "b",
                    doc: "Half length of the fin, m",
                    default: 0.015,
                },
                ukcore::ParamSpec {
                    name: "s3",
                    doc: "Lateral area of the fin, m^2",
                    default: 0.008,
                },
                ukcore::ParamSpec {
                    name: "rho",
                    doc: "Density of water, kg/m^3",
                    default: 998.0,
                },
                ukcore::ParamSpec {
                    name: "cd",
                    doc: "Drag coefficient",
                    default: 0.5,
                },
                ukcore::ParamSpec {
                    name: "span",
                    doc: "Span of the fin, m",
                    default: 0.075,
                },
                ukcore::ParamSpec {
                    name: "half_chord",
                    doc: "Half chord of the fin, m",
                    default: 0.015,
                },
                ukcore::ParamSpec {
                    name: "a2",
                    doc: "Amplitude of the peduncle's angle, rad",
                    default: 0.3,
                },
                ukcore::ParamSpec {
                    name: "a3",
                    doc: "Amplitude of the fin's angle, rad",
                    default: 0.6,
                },
                ukcore::ParamSpec {
                    name: "w",
                    doc: "Angular frequency of the gait, rad/s",
                    default: ::core::f64::consts::TAU,
                },
                ukcore::ParamSpec {
                    name: "phi",
                    doc: "Phase by which the fin lags the peduncle, rad",
                    default: 0.2617993877991494,
                },
            ],
            prepared: &[
                ("rho_span_half_chord", "rho*span*half_chord"),
                ("times_rho_span_half_chord", "6.283185307179586*rho*span*half_chord"),
                ("a", "a"),
                ("l2", "l2"),
                ("b", "b"),
                ("w", "w"),
                ("a2", "a2"),
                ("phi_2", "phi"),
                ("a3", "a3"),
                ("m1", "m1"),
                ("i1", "i1"),
                ("m2", "m2"),
                ("m3", "m3"),
                ("a2_w", "a2*w"),
                ("a2_sq_w", "a2*sq(w)"),
                ("w_a3", "w*a3"),
                ("sq_w_a3", "sq(w)*a3"),
                ("rho_s_cd", "rho*s*cd"),
                ("half_rho_s_cd", "0.5*rho*s*cd"),
                ("rho_cd_s1", "rho*cd*s1"),
                ("half_rho_cd_s1", "0.5*rho*cd*s1"),
                ("rho_cd_s2", "rho*cd*s2"),
                ("half_rho_cd_s2", "0.5*rho*cd*s2"),
                ("rho_cd_s3", "rho*cd*s3"),
                ("half_rho_cd_s3", "0.5*rho*cd*s3"),
                ("l2_a2_sq_w", "l2*a2*sq(w)"),
                ("b_sq_w_a3", "b*sq(w)*a3"),
                ("rho_per_m1_s_cd", "rho*s*cd/m1"),
                ("rho_per_m1_cd_s1", "rho*cd*s1/m1"),
                ("rho_span_half_chord_per_m3", "rho*span*half_chord/m3"),
                ("span_half_chord", "span*half_chord"),
                ("cd_s3", "cd*s3"),
                ("times_span_half_chord", "6.283185307179586*span*half_chord"),
                ("half_cd_s3", "0.5*cd*s3"),
                ("rho", "rho"),
                ("rho_per_m3", "rho/m3"),
                ("per_i1_sq_a", "sq(a)/i1"),
                ("rho_per_m2_cd_s2", "rho*cd*s2/m2"),
                ("joint1_0_with_joint2_0", "1/m2"),
                ("joint1_1_by_joint2_1", "1/(m2*(1/m3 + 1/m2))"),
                ("per_m1_and_per_m2", "1/m1 + 1/m2"),
                ("pivot_joint2_0", "1/m3 + 1/m2"),
                ("prepared_part", "1/sq(m2)"),
                ("prepared_part_2", "a^4*(1/m3 + 1/m2)/sq(i1)"),
                ("prepared_part_3", "1/(sq(m2)*(1/m3 + 1/m2))"),
                ("per_i1_sq_a_per_m3_and_per_m2", "sq(a)*(1/m3 + 1/m2)/i1"),
                ("per_per_m3_and_per_m2", "1/(1/m3 + 1/m2)"),
                ("per_i1_a", "a/i1"),
                ("per_m3", "1/m3"),
                ("per_m1", "1/m1"),
                ("per_m3_per_per_m3_and_per_m2", "1/(m3*(1/m3 + 1/m2))"),
                (
                    "safe_joint2_0",
                    "1 if the pivots that depend on m1, i1, m2, m3 alone are positive and finite, else 0",
                ),
            ],
            coords: &["x1", "y1", "th1", "x2", "y2", "th2", "x3", "y3", "th3"],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "joint1[0]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "x1 + a*cos(th1) + 0.5*l2*cos(th2) - x2 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "joint1[1]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "y1 + a*sin(th1) + 0.5*l2*sin(th2) - y2 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "joint2[0]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "x2 + 0.5*l2*cos(th2) + cos(th3)*b - x3 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "joint2[1]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "y2 + 0.5*l2*sin(th2) + sin(th3)*b - y3 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "peduncle",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "th2 - a2*sin(w*t) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "fin",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "th3 - a3*sin(w*t - phi) = 0",
                },
            ],
            holonomic: 6,
            outputs: &[
                ukcore::OutputSpec {
                    name: "forward_speed",
                    doc: "Speed of the body towards its nose's side, −x, m/s",
                },
                ukcore::OutputSpec {
                    name: "swing",
                    doc: "Swing angle of the body, rad",
                },
                ukcore::OutputSpec {
                    name: "fin_x",
                    doc: "Force of the water on the fin along x by lift (negative drives the fish), N",
                },
                ukcore::OutputSpec {
                    name: "fin_y",
                    doc: "Force of the water on the fin along y by lift, N",
                },
                ukcore::OutputSpec {
                    name: "edge_x",
                    doc: "Longitudinal position of the fin's trailing edge, m",
                },
                ukcore::OutputSpec {
                    name: "edge_y",
                    doc: "Lateral position of the fin's trailing edge, m",
                },
            ],
            switches: &[
                ukcore::SwitchSpec {
                    function: "dot(x1)",
                    terms: &["force on `x1`"],
                },
                ukcore::SwitchSpec {
                    function: "dot(y1)",
                    terms: &["force on `y1`"],
                },
                ukcore::SwitchSpec {
                    function: "dot(y2)",
                    terms: &["force on `y2`"],
                },
                ukcore::SwitchSpec {
                    function: "dot(y3)",
                    terms: &["force on `y3`"],
                },
            ],
            structure: ukcore::Structure {
                straight_line: true,
                solve: ukcore::Solve {
                    refusal: "",
                    pivots: &[
                        ukcore::Pivot::Massless(5, 4, "1"),
                        ukcore::Pivot::Massless(8, 5, "1"),
                        ukcore::Pivot::Coordinate(0),
                        ukcore::Pivot::Coordinate(1),
                        ukcore::Pivot::Coordinate(6),
                        ukcore::Pivot::Coordinate(7),
                        ukcore::Pivot::Coordinate(2),
                        ukcore::Pivot::Coordinate(3),
                        ukcore::Pivot::Coordinate(4),
                        ukcore::Pivot::Constraint(2),
                        ukcore::Pivot::Constraint(3),
                        ukcore::Pivot::Constraint(0),
                        ukcore::Pivot::Constraint(1),
                    ],
                    fill: &[(10, 9), (11, 9), (12, 10)],
                    checks: &[
                        ukcore::Check::Positive(0),
                        ukcore::Check::Positive(6),
                        ukcore::Check::Positive(2),
                        ukcore::Check::Positive(3),
                        ukcore::Check::Positive(11),
                        ukcore::Check::Share(9),
                        ukcore::Check::Share(10),
                    ],
                    least_share: 0.0009765625,
                },
                mass_pattern: &[(0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (6, 6), (7, 7)],
                jacobian_pattern: &[
                    (0, 0),
                    (0, 2),
                    (0, 3),
                    (0, 5),
                    (1, 1),
                    (1, 2),
                    (1, 4),
                    (1, 5),
                    (2, 3),
                    (2, 5),
                    (2, 6),
                    (2, 8),
                    (3, 4),
                    (3, 5),
                    (3, 7),
                    (3, 8),
                    (4, 5),
                    (5, 8),
                ],
                mass_diagonal: true,
                mass_constant: true,
                jacobian_constant: false,
                massless: &[5, 8],
                angles: &[2, 5, 8],
                scleronomic: false,
                nonideal: false,
                potential: false,
                conservative: false,
                left_out: &[
                    "36 of the 54 entries of A: structurally zero, never written",
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "4 of 9 entries of Q: identically zero",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 19,
                        multiplications: 52,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 5,
                        selections: 8,
                    },
                    dense: ukcore::Operations {
                        additions: 770,
                        multiplications: 890,
                        divisions: 15,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    unprepared: ukcore::Operations {
                        additions: 53,
                        multiplications: 165,
                        divisions: 7,
                        square_roots: 0,
                        transcendentals: 5,
                        selections: 20,
                    },
                    acceleration: ukcore::Operations {
                        additions: 51,
                        multiplications: 105,
                        divisions: 2,
                        square_roots: 0,
                        transcendentals: 5,
                        selections: 10,
                    },
                    correction: ukcore::Operations {
                        additions: 25,
                        multiplications: 53,
                        divisions: 2,
                        square_roots: 0,
                        transcendentals: 3,
                        selections: 2,
                    },
                    prepare: ukcore::Operations {
                        additions: 2,
                        multiplications: 60,
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
                    (6, 6, "m3"),
                    (7, 7, "m3"),
                ],
                force: &[
                    (0, "-0.5*rho*s*dot(x1)*cd*abs(dot(x1))"),
                    (1, "-0.5*rho*cd*s1*dot(y1)*abs(dot(y1))"),
                    (4, "-0.5*rho*cd*s2*dot(y2)*abs(dot(y2))"),
                    (
                        6,
                        "6.283185307179586*rho*span*half_chord*(dot(x3)*dot(y3)*sin(th3) - sq(dot(y3))*cos(th3))",
                    ),
                    (
                        7,
                        "6.283185307179586*rho*span*half_chord*(dot(x3)*dot(y3)*cos(th3) - sq(dot(x3))*sin(th3)) - 0.5*rho*dot(y3)*cd*s3*abs(dot(y3))",
                    ),
                ],
                nonideal: &[],
                jacobian: &[
                    (0, 0, "1"),
                    (0, 2, "-a*sin(th1)"),
                    (0, 3, "-1"),
                    (0, 5, "-0.5*l2*sin(th2)"),
                    (1, 1, "1"),
                    (1, 2, "a*cos(th1)"),
                    (1, 4, "-1"),
                    (1, 5, "0.5*l2*cos(th2)"),
                    (2, 3, "1"),
                    (2, 5, "-0.5*l2*sin(th2)"),
                    (2, 6, "-1"),
                    (2, 8, "-sin(th3)*b"),
                    (3, 4, "1"),
                    (3, 5, "0.5*l2*cos(th2)"),
                    (3, 7, "-1"),
                    (3, 8, "cos(th3)*b"),
                    (4, 5, "1"),
                    (5, 8, "1"),
                ],
                rhs: &[
                    (0, "a*cos(th1)*sq(dot(th1)) + 0.5*l2*cos(th2)*sq(dot(th2))"),
                    (1, "a*sin(th1)*sq(dot(th1)) + 0.5*l2*sin(th2)*sq(dot(th2))"),
                    (2, "0.5*l2*cos(th2)*sq(dot(th2)) + cos(th3)*b*sq(dot(th3))"),
                    (3, "0.5*l2*sin(th2)*sq(dot(th2)) + sin(th3)*b*sq(dot(th3))"),
                    (4, "-a2*sq(w)*sin(w*t)"),
                    (5, "-sq(w)*a3*sin(w*t - phi)"),
                ],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.m1,
                1 => self.i1,
                2 => self.a,
                3 => self.s,
                4 => self.s1,
                5 => self.m2,
                6 => self.l2,
                7 => self.s2,
                8 => self.m3,
                9 => self.b,
                10 => self.s3,
                11 => self.rho,
                12 => self.cd,
                13 => self.span,
                14 => self.half_chord,
                15 => self.a2,
                16 => self.a3,
                17 => self.w,
                18 => self.phi,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.m1 = value,
                1 => self.i1 = value,
                2 => self.a = value,
                3 => self.s = value,
                4 => self.s1 = value,
                5 => self.m2 = value,
                6 => self.l2 = value,
                7 => self.s2 = value,
                8 => self.m3 = value,
                9 => self.b = value,
                10 => self.s3 = value,
                11 => self.rho = value,
                12 => self.cd = value,
                13 => self.span = value,
                14 => self.half_chord = value,
                15 => self.a2 = value,
                16 => self.a3 = value,
                17 => self.w = value,
                18 => self.phi = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 52>(prepared, "prepared");
            let [m1, i1, a, s, s1, m2, l2, s2, m3, b, s3, rho, cd, span, half_chord, a2,
            a3, w, phi_2] = *ukcore::emitted::exact::<S, 19>(given, "given");
            let lit = S::from_f64;
            let rho_span_half_chord = rho * span * half_chord;
            prepared[0] = rho_span_half_chord;
            prepared[1] = lit(::core::f64::consts::TAU) * rho_span_half_chord;
            prepared[2] = a;
            prepared[3] = l2;
            prepared[4] = b;
            prepared[5] = w;
            prepared[6] = a2;
            prepared[7] = phi_2;
            prepared[8] = a3;
            let per_m1 = m1.recip();
            prepared[9] = m1;
            let per_i1 = i1.recip();
            prepared[10] = i1;
            let per_m2 = m2.recip();
            prepared[11] = m2;
            let per_m3 = m3.recip();
            prepared[12] = m3;
            prepared[13] = a2 * w;
            prepared[14] = a2 * w * w;
            prepared[15] = w * a3;
            prepared[16] = w * w * a3;
            let rho_s_cd = rho * s * cd;
            prepared[17] = rho_s_cd;
            prepared[18] = lit(0.5) * rho_s_cd;
            let rho_cd_s1 = rho * cd * s1;
            prepared[19] = rho_cd_s1;
            prepared[20] = lit(0.5) * rho_cd_s1;
            let rho_cd_s2 = rho * cd * s2;
            prepared[21] = rho_cd_s2;
            prepared[22] = lit(0.5) * rho_cd_s2;
            let rho_cd_s3 = rho * cd * s3;
            prepared[23] = rho_cd_s3;
            prepared[24] = lit(0.5) * rho_cd_s3;
            prepared[25] = l2 * a2 * w * w;
            prepared[26] = b * w * w * a3;
            prepared[27] = rho * s * cd * per_m1;
            prepared[28] = rho * cd * s1 * per_m1;
            prepared[29] = rho * span * half_chord * per_m3;
            let span_half_chord = span * half_chord;
            prepared[30] = span_half_chord;
            let cd_s3 = cd * s3;
            prepared[31] = cd_s3;
            prepared[32] = lit(::core::f64::consts::TAU) * span_half_chord;
            prepared[33] = lit(0.5) * cd_s3;
            prepared[34] = rho;
            prepared[35] = rho * per_m3;
            prepared[36] = a * a * per_i1;
            prepared[37] = rho * cd * s2 * per_m2;
            prepared[38] = per_m2;
            let pivot_joint2_0 = per_m3 + per_m2;
            let per_pivot_joint2_0 = pivot_joint2_0.recip();
            let joint1_1_by_joint2_1 = per_m2 * per_pivot_joint2_0;
            prepared[39] = joint1_1_by_joint2_1;
            prepared[40] = per_m1 + per_m2;
            prepared[41] = pivot_joint2_0;
            prepared[42] = (m2 * m2).recip();
            prepared[43] = a.powi(4) * pivot_joint2_0 / (i1 * i1);
            prepared[44] = per_pivot_joint2_0 / (m2 * m2);
            prepared[45] = a * a * per_i1 * pivot_joint2_0;
            prepared[46] = per_pivot_joint2_0;
            prepared[47] = a * per_i1;
            prepared[48] = per_m3;
            prepared[49] = per_m1;
            prepared[50] = per_m3 * per_pivot_joint2_0;
            let safe_x1 = S::select_le(
                m1,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m1, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            let safe_x3 = S::select_le(
                m3,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m3, safe_x1, lit(0.0)),
                lit(0.0),
            );
            let safe_th1 = S::select_le(
                i1,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), i1, safe_x3, lit(0.0)),
                lit(0.0),
            );
            let safe_x2 = S::select_le(
                m2,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m2, safe_th1, lit(0.0)),
                lit(0.0),
            );
            let safe_joint2_0 = S::select_le(
                pivot_joint2_0,
                lit(1.7976931348623157e308),
                S::select_le(
                    lit(2.2250738585072014e-308),
                    pivot_joint2_0,
                    safe_x2,
                    lit(0.0),
                ),
                lit(0.0),
            );
            prepared[51] = safe_joint2_0;
        }
        /// 19 additions, 52 multiplications, 0 divisions, 0 square roots, 5 transcendentals, 8 selections.
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
            let jacobian = ukcore::emitted::exact_mut::<S, 54>(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 6>(out.rhs, "rhs");
            let [rho_span_half_chord, times_rho_span_half_chord, a, l2, b, w, _, phi_2,
            _, m1, i1, m2, m3, _, a2_sq_w, _, sq_w_a3, _, half_rho_s_cd, _,
            half_rho_cd_s1, _, half_rho_cd_s2, _, half_rho_cd_s3, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, held_dot_x1,
            held_dot_y1, held_dot_y2, held_dot_y3] = *ukcore::emitted::exact::<
                S,
                56,
            >(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [dot_x1, dot_y1, dot_th1, _, dot_y2, dot_th2, dot_x3, dot_y3, dot_th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(v, "v");
            let lit = S::from_f64;
            mass[0] = m1;
            mass[10] = m1;
            mass[20] = i1;
            mass[30] = m2;
            mass[40] = m2;
            mass[60] = m3;
            mass[70] = m3;
            force[0] = -(dot_x1 * half_rho_s_cd
                * S::select_le(lit(0.0), dot_x1.branch(held_dot_x1), dot_x1, -dot_x1));
            force[1] = -(dot_y1 * half_rho_cd_s1
                * S::select_le(lit(0.0), dot_y1.branch(held_dot_y1), dot_y1, -dot_y1));
            force[2] = lit(0.0);
            force[3] = lit(0.0);
            force[4] = -(dot_y2 * half_rho_cd_s2
                * S::select_le(lit(0.0), dot_y2.branch(held_dot_y2), dot_y2, -dot_y2));
            force[5] = lit(0.0);
            let (sin_th3, cos_th3) = th3.sin_cos();
            force[6] = times_rho_span_half_chord
                * (dot_y3 * dot_y3).neg_mul_add(cos_th3, dot_x3 * dot_y3 * sin_th3);
            force[7] = (dot_y3 * half_rho_cd_s3)
                .neg_mul_add(
                    S::select_le(lit(0.0), dot_y3.branch(held_dot_y3), dot_y3, -dot_y3),
                    lit(::core::f64::consts::TAU) * rho_span_half_chord
                        * (dot_x3 * dot_x3)
                            .neg_mul_add(sin_th3, dot_x3 * dot_y3 * cos_th3),
                );
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
            jacobian[12] = -(a * sin_th1);
            jacobian[18] = lit(-1.0);
            let (sin_th2, cos_th2) = th2.sin_cos();
            let a_joint1_0 = lit(-0.5) * (l2 * sin_th2);
            jacobian[30] = a_joint1_0;
            jacobian[7] = lit(1.0);
            jacobian[13] = a * cos_th1;
            jacobian[25] = lit(-1.0);
            let a_joint1_1 = lit(0.5) * (l2 * cos_th2);
            jacobian[31] = a_joint1_1;
            jacobian[20] = lit(1.0);
            jacobian[32] = a_joint1_0;
            jacobian[38] = lit(-1.0);
            jacobian[50] = -(b * sin_th3);
            jacobian[27] = lit(1.0);
            jacobian[33] = a_joint1_1;
            jacobian[45] = lit(-1.0);
            jacobian[51] = b * cos_th3;
            jacobian[34] = lit(1.0);
            jacobian[53] = lit(1.0);
            let cos_th2_sq_dot_th2_l2 = dot_th2 * dot_th2 * l2 * cos_th2;
            rhs[0] = lit(0.5)
                .mul_add(cos_th2_sq_dot_th2_l2, dot_th1 * dot_th1 * a * cos_th1);
            let sin_th2_sq_dot_th2_l2 = dot_th2 * dot_th2 * l2 * sin_th2;
            rhs[1] = lit(0.5)
                .mul_add(sin_th2_sq_dot_th2_l2, dot_th1 * dot_th1 * a * sin_th1);
            rhs[2] = (dot_th3 * dot_th3 * b)
                .mul_add(cos_th3, lit(0.5) * cos_th2_sq_dot_th2_l2);
            rhs[3] = (dot_th3 * dot_th3 * b)
                .mul_add(sin_th3, lit(0.5) * sin_th2_sq_dot_th2_l2);
            let t_w = t * w;
            rhs[4] = -(a2_sq_w * t_w.sin());
            rhs[5] = -(sq_w_a3 * (t_w - phi_2).sin());
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 81>(mass, "mass");
            let [_, _, _, _, _, _, _, _, _, m1, i1, m2, m3, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                56,
            >(prepared, "prepared");
            mass[0] = m1;
            mass[10] = m1;
            mass[20] = i1;
            mass[30] = m2;
            mass[40] = m2;
            mass[60] = m3;
            mass[70] = m3;
        }
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {
            let jacobian = ukcore::emitted::exact_mut::<S, 54>(jacobian, "jacobian");
            let [_, _, a, l2, b, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _] = *ukcore::emitted::exact::<S, 56>(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let lit = S::from_f64;
            jacobian[0] = lit(1.0);
            let (sin_th1, cos_th1) = th1.sin_cos();
            jacobian[12] = -(a * sin_th1);
            jacobian[18] = lit(-1.0);
            let (sin_th2, cos_th2) = th2.sin_cos();
            let a_joint1_0 = lit(-0.5) * (l2 * sin_th2);
            jacobian[30] = a_joint1_0;
            jacobian[7] = lit(1.0);
            jacobian[13] = a * cos_th1;
            jacobian[25] = lit(-1.0);
            let a_joint1_1 = lit(0.5) * (l2 * cos_th2);
            jacobian[31] = a_joint1_1;
            jacobian[20] = lit(1.0);
            jacobian[32] = a_joint1_0;
            jacobian[38] = lit(-1.0);
            let (sin_th3, cos_th3) = th3.sin_cos();
            jacobian[50] = -(b * sin_th3);
            jacobian[27] = lit(1.0);
            jacobian[33] = a_joint1_1;
            jacobian[45] = lit(-1.0);
            jacobian[51] = b * cos_th3;
            jacobian[34] = lit(1.0);
            jacobian[53] = lit(1.0);
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 6>(phi, "phi");
            let [_, _, a, l2, b, w, a2, phi_2, a3, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                56,
            >(prepared, "prepared");
            let [x1, y1, th1, x2, y2, th2, x3, y3, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let lit = S::from_f64;
            let (sin_th1, cos_th1) = th1.sin_cos();
            let (sin_th2, cos_th2) = th2.sin_cos();
            let cos_th2_l2 = l2 * cos_th2;
            phi[0] = lit(0.5).mul_add(cos_th2_l2, a.mul_add(cos_th1, x1 - x2));
            let sin_th2_l2 = l2 * sin_th2;
            phi[1] = lit(0.5).mul_add(sin_th2_l2, a.mul_add(sin_th1, y1 - y2));
            let (sin_th3, cos_th3) = th3.sin_cos();
            phi[2] = b.mul_add(cos_th3, lit(0.5).mul_add(cos_th2_l2, x2 - x3));
            phi[3] = b.mul_add(sin_th3, lit(0.5).mul_add(sin_th2_l2, y2 - y3));
            let t_w = t * w;
            phi[4] = a2.neg_mul_add(t_w.sin(), th2);
            phi[5] = a3.neg_mul_add((t_w - phi_2).sin(), th3);
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 6>(rate, "rate");
            let [_, _, a, l2, b, w, _, phi_2, _, _, _, _, _, a2_w, _, w_a3, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                56,
            >(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [dot_x1, dot_y1, dot_th1, dot_x2, dot_y2, dot_th2, dot_x3, dot_y3,
            dot_th3] = *ukcore::emitted::exact::<S, 9>(v, "v");
            let lit = S::from_f64;
            let (sin_th1, cos_th1) = th1.sin_cos();
            let (sin_th2, cos_th2) = th2.sin_cos();
            let sin_th2_dot_th2_l2 = dot_th2 * l2 * sin_th2;
            rate[0] = lit(0.5)
                .neg_mul_add(
                    sin_th2_dot_th2_l2,
                    (dot_th1 * a).neg_mul_add(sin_th1, dot_x1 - dot_x2),
                );
            let cos_th2_dot_th2_l2 = dot_th2 * l2 * cos_th2;
            rate[1] = lit(0.5)
                .mul_add(
                    cos_th2_dot_th2_l2,
                    (dot_th1 * a).mul_add(cos_th1, dot_y1 - dot_y2),
                );
            let (sin_th3, cos_th3) = th3.sin_cos();
            rate[2] = (dot_th3 * b)
                .neg_mul_add(
                    sin_th3,
                    lit(0.5).neg_mul_add(sin_th2_dot_th2_l2, dot_x2 - dot_x3),
                );
            rate[3] = (dot_th3 * b)
                .mul_add(cos_th3, lit(0.5).mul_add(cos_th2_dot_th2_l2, dot_y2 - dot_y3));
            let t_w = t * w;
            rate[4] = a2_w.neg_mul_add(t_w.cos(), dot_th2);
            rate[5] = w_a3.neg_mul_add((t_w - phi_2).cos(), dot_th3);
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [_, _, _, _, _, _, _, _, _, m1, i1, m2, m3, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                56,
            >(prepared, "prepared");
            let [dot_x1, dot_y1, dot_th1, dot_x2, dot_y2, _, dot_x3, dot_y3, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(v, "v");
            let lit = S::from_f64;
            let kinetic = lit(0.5)
                * (dot_y3 * dot_y3)
                    .mul_add(
                        m3,
                        (dot_x3 * dot_x3)
                            .mul_add(
                                m3,
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
                    );
            let potential = lit(0.0);
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
            let outputs = ukcore::emitted::exact_mut::<S, 6>(outputs, "outputs");
            let [rho_span_half_chord, times_rho_span_half_chord, _, _, b, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                56,
            >(prepared, "prepared");
            let [_, _, th1, _, _, _, x3, y3, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [dot_x1, _, _, _, _, _, dot_x3, dot_y3, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(v, "v");
            let lit = S::from_f64;
            outputs[0] = -dot_x1;
            outputs[1] = th1;
            let (sin_th3, cos_th3) = th3.sin_cos();
            outputs[2] = times_rho_span_half_chord
                * (dot_y3 * dot_y3).neg_mul_add(cos_th3, dot_x3 * dot_y3 * sin_th3);
            outputs[3] = lit(::core::f64::consts::TAU)
                * (rho_span_half_chord
                    * (dot_x3 * dot_x3).neg_mul_add(sin_th3, dot_x3 * dot_y3 * cos_th3));
            outputs[4] = b.mul_add(cos_th3, x3);
            outputs[5] = b.mul_add(sin_th3, y3);
        }
        fn switching<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            switching: &mut [S],
        ) {
            let switching = ukcore::emitted::exact_mut::<S, 4>(switching, "switching");
            let [dot_x1, dot_y1, _, _, dot_y2, _, _, dot_y3, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(v, "v");
            switching[0] = dot_x1;
            switching[1] = dot_y1;
            switching[2] = dot_y2;
            switching[3] = dot_y3;
        }
        /// 51 additions, 105 multiplications, 2 divisions, 0 square roots, 5 transcendentals, 10 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 9>(out, "out");
            let [rho_span_half_chord, _, a, l2, b, w, _, phi_2, _, _, _, _, _, _,
            a2_sq_w, _, sq_w_a3, rho_s_cd, _, rho_cd_s1, _, rho_cd_s2, _, _, _,
            l2_a2_sq_w, b_sq_w_a3, rho_per_m1_s_cd, rho_per_m1_cd_s1,
            rho_span_half_chord_per_m3, _, _, times_span_half_chord, half_cd_s3, rho,
            rho_per_m3, per_i1_sq_a, rho_per_m2_cd_s2, joint1_0_with_joint2_0,
            joint1_1_by_joint2_1, per_m1_and_per_m2, pivot_joint2_0, prepared_part,
            prepared_part_2, prepared_part_3, per_i1_sq_a_per_m3_and_per_m2,
            per_per_m3_and_per_m2, per_i1_a, per_m3, per_m1, _, safe_joint2_0,
            held_dot_x1, held_dot_y1, held_dot_y2, held_dot_y3] = *ukcore::emitted::exact::<
                S,
                56,
            >(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [dot_x1, dot_y1, dot_th1, _, dot_y2, dot_th2, dot_x3, dot_y3, dot_th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(v, "v");
            let lit = S::from_f64;
            let right_x1 = lit(0.5)
                * (dot_x1
                    * S::select_le(
                        lit(0.0),
                        dot_x1.branch(held_dot_x1),
                        dot_x1,
                        -dot_x1,
                    ));
            let right_y1 = lit(0.5)
                * (dot_y1
                    * S::select_le(
                        lit(0.0),
                        dot_y1.branch(held_dot_y1),
                        dot_y1,
                        -dot_y1,
                    ));
            let (sin_th3, cos_th3) = th3.sin_cos();
            let right_x3 = lit(::core::f64::consts::TAU)
                * (dot_y3 * dot_y3).neg_mul_add(cos_th3, dot_x3 * dot_y3 * sin_th3);
            let right_y3 = (dot_y3 * half_cd_s3)
                .neg_mul_add(
                    S::select_le(lit(0.0), dot_y3.branch(held_dot_y3), dot_y3, -dot_y3),
                    times_span_half_chord
                        * (dot_x3 * dot_x3)
                            .neg_mul_add(sin_th3, dot_x3 * dot_y3 * cos_th3),
                );
            let right_y2 = lit(0.5)
                * (dot_y2
                    * S::select_le(
                        lit(0.0),
                        dot_y2.branch(held_dot_y2),
                        dot_y2,
                        -dot_y2,
                    ));
            let (sin_th2, cos_th2) = th2.sin_cos();
            let cos_th2_sq_dot_th2_l2 = dot_th2 * dot_th2 * l2 * cos_th2;
            let acceleration_0_part = lit(0.5) * sin_th2;
            let t_w = t * w;
            let sin_t_w = t_w.sin();
            let acceleration_0_part_2 = l2_a2_sq_w * acceleration_0_part * sin_t_w;
            let acceleration_0_part_3 = (t_w - phi_2).sin();
            let right_joint2_0 = rho_span_half_chord_per_m3
                .mul_add(
                    right_x3,
                    (b_sq_w_a3 * sin_th3)
                        .neg_mul_add(
                            acceleration_0_part_3,
                            (dot_th3 * dot_th3 * b)
                                .mul_add(cos_th3, lit(0.5) * cos_th2_sq_dot_th2_l2)
                                - acceleration_0_part_2,
                        ),
                );
            let sin_th2_sq_dot_th2_l2 = dot_th2 * dot_th2 * l2 * sin_th2;
            let acceleration_0_part_4 = lit(0.5) * cos_th2;
            let acceleration_0_part_5 = l2_a2_sq_w * acceleration_0_part_4 * sin_t_w;
            let right_y2_rho_per_m2_cd_s2 = rho_per_m2_cd_s2 * right_y2;
            let right_joint2_1 = rho_per_m3
                .mul_add(
                    right_y3,
                    (b_sq_w_a3 * cos_th3)
                        .mul_add(
                            acceleration_0_part_3,
                            right_y2_rho_per_m2_cd_s2
                                + (dot_th3 * dot_th3 * b)
                                    .mul_add(sin_th3, lit(0.5) * sin_th2_sq_dot_th2_l2)
                                + acceleration_0_part_5,
                        ),
                );
            let (sin_th1, cos_th1) = th1.sin_cos();
            let diagonal_joint1_0 = (per_i1_sq_a * sin_th1)
                .mul_add(sin_th1, per_m1_and_per_m2);
            let diagonal_joint1_0_pivot_joint2_0 = pivot_joint2_0 * diagonal_joint1_0;
            let pivot_joint1_0 = diagonal_joint1_0_pivot_joint2_0 - prepared_part;
            let per_pivot_joint1_0 = pivot_joint1_0.recip();
            let safe_joint1_0 = S::select_le(
                lit(0.0009765625) * diagonal_joint1_0_pivot_joint2_0,
                pivot_joint1_0,
                safe_joint2_0,
                lit(0.0),
            );
            let right_joint1_0 = joint1_0_with_joint2_0
                .mul_add(
                    right_joint2_0,
                    pivot_joint2_0
                        * (rho_per_m1_s_cd * right_x1
                            + lit(0.5)
                                .mul_add(
                                    cos_th2_sq_dot_th2_l2,
                                    dot_th1 * dot_th1 * a * cos_th1,
                                ) - acceleration_0_part_2),
                );
            let acceleration_0_part_6 = (per_i1_sq_a * cos_th1)
                .mul_add(cos_th1, per_m1_and_per_m2);
            let pivot_joint1_1 = (acceleration_0_part_6 - prepared_part_3)
                .neg_mul_add(
                    pivot_joint1_0,
                    prepared_part_2 * cos_th1 * cos_th1 * sin_th1 * sin_th1,
                );
            let per_pivot_joint1_1 = pivot_joint1_1.recip();
            let diagonal_joint1_1 = acceleration_0_part_6 * pivot_joint1_0;
            let safe_joint1_1 = S::select_le(
                lit(0.0009765625) * diagonal_joint1_1,
                -pivot_joint1_1,
                safe_joint1_0,
                lit(0.0),
            );
            let right_joint1_1 = pivot_joint1_0
                .mul_add(
                    joint1_1_by_joint2_1
                        .mul_add(
                            right_joint2_1,
                            (rho_per_m1_cd_s1 * right_y1 - right_y2_rho_per_m2_cd_s2
                                + lit(0.5)
                                    .mul_add(
                                        sin_th2_sq_dot_th2_l2,
                                        dot_th1 * dot_th1 * a * sin_th1,
                                    ) + acceleration_0_part_5),
                        ),
                    per_i1_sq_a * cos_th1 * sin_th1 * right_joint1_0,
                );
            out[5] = -(a2_sq_w * sin_t_w);
            out[8] = -(sq_w_a3 * acceleration_0_part_3);
            let safe = safe_joint1_1;
            let lambda_joint1_1 = per_pivot_joint1_1 * right_joint1_1;
            out[1] = -(per_m1 * (rho_cd_s1 * right_y1 + lambda_joint1_1));
            let lambda_joint1_0 = (per_i1_sq_a_per_m3_and_per_m2 * cos_th1 * sin_th1
                * per_pivot_joint1_0 * per_pivot_joint1_1)
                .neg_mul_add(right_joint1_1, right_joint1_0 * per_pivot_joint1_0);
            out[0] = -(per_m1 * (rho_s_cd * right_x1 - lambda_joint1_0));
            let lambda_joint2_1 = (joint1_0_with_joint2_0 * per_pivot_joint1_1)
                .neg_mul_add(right_joint1_1, right_joint2_1);
            let acceleration_1_part = per_per_m3_and_per_m2 * lambda_joint2_1;
            out[7] = per_m3 * (rho * right_y3 - acceleration_1_part);
            out[2] = -(per_i1_a
                * sin_th1
                    .mul_add(
                        lambda_joint1_0,
                        cos_th1 * per_pivot_joint1_1 * right_joint1_1,
                    ));
            out[4] = -(joint1_0_with_joint2_0
                * (rho_cd_s2 * right_y2 - lambda_joint1_1 - acceleration_1_part));
            let lambda_joint2_0 = joint1_0_with_joint2_0
                .mul_add(lambda_joint1_0, right_joint2_0);
            let acceleration_5_part = per_per_m3_and_per_m2 * lambda_joint2_0;
            out[6] = per_m3 * (rho_span_half_chord * right_x3 - acceleration_5_part);
            out[3] = -(joint1_0_with_joint2_0 * (lambda_joint1_0 - acceleration_5_part));
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
            let [_, _, _, l2, b, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, per_i1_sq_a, _, joint1_0_with_joint2_0,
            joint1_1_by_joint2_1, per_m1_and_per_m2, pivot_joint2_0, prepared_part,
            prepared_part_2, prepared_part_3, per_i1_sq_a_per_m3_and_per_m2,
            per_per_m3_and_per_m2, per_i1_a, _, per_m1, per_m3_per_per_m3_and_per_m2,
            safe_joint2_0, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                56,
            >(prepared, "prepared");
            let [_, _, th1, _, _, th2, _, _, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [residual_0, residual_1, residual_2, residual_3, residual_4, residual_5,
            ] = *ukcore::emitted::exact::<S, 6>(residual, "residual");
            let lit = S::from_f64;
            let (sin_th1, cos_th1) = th1.sin_cos();
            let diagonal_joint1_0 = (per_i1_sq_a * sin_th1)
                .mul_add(sin_th1, per_m1_and_per_m2);
            let diagonal_joint1_0_pivot_joint2_0 = pivot_joint2_0 * diagonal_joint1_0;
            let pivot_joint1_0 = diagonal_joint1_0_pivot_joint2_0 - prepared_part;
            let per_pivot_joint1_0 = pivot_joint1_0.recip();
            let safe_joint1_0 = S::select_le(
                lit(0.0009765625) * diagonal_joint1_0_pivot_joint2_0,
                pivot_joint1_0,
                safe_joint2_0,
                lit(0.0),
            );
            let correction_0_part = (per_i1_sq_a * cos_th1)
                .mul_add(cos_th1, per_m1_and_per_m2);
            let pivot_joint1_1 = (correction_0_part - prepared_part_3)
                .neg_mul_add(
                    pivot_joint1_0,
                    prepared_part_2 * cos_th1 * cos_th1 * sin_th1 * sin_th1,
                );
            let per_pivot_joint1_1 = pivot_joint1_1.recip();
            let diagonal_joint1_1 = correction_0_part * pivot_joint1_0;
            let safe_joint1_1 = S::select_le(
                lit(0.0009765625) * diagonal_joint1_1,
                -pivot_joint1_1,
                safe_joint1_0,
                lit(0.0),
            );
            let (sin_th2, cos_th2) = th2.sin_cos();
            let correction_0_part_2 = lit(0.5) * sin_th2;
            let correction_0_part_3 = residual_4 * l2 * correction_0_part_2;
            let (sin_th3, cos_th3) = th3.sin_cos();
            let right_joint2_0 = (residual_5 * b).mul_add(sin_th3, residual_2)
                + correction_0_part_3;
            let correction_0_part_4 = lit(0.5) * cos_th2;
            let correction_0_part_5 = residual_4 * l2 * correction_0_part_4;
            let right_joint2_1 = (residual_5 * b).neg_mul_add(cos_th3, residual_3)
                - correction_0_part_5;
            let right_joint1_0 = pivot_joint2_0
                .mul_add(
                    (residual_0 + correction_0_part_3),
                    joint1_0_with_joint2_0 * right_joint2_0,
                );
            let right_joint1_1 = pivot_joint1_0
                .mul_add(
                    joint1_1_by_joint2_1
                        .mul_add(right_joint2_1, (residual_1 - correction_0_part_5)),
                    per_i1_sq_a * cos_th1 * sin_th1 * right_joint1_0,
                );
            out[5] = -residual_4;
            out[8] = -residual_5;
            let safe = safe_joint1_1;
            out[1] = per_m1 * right_joint1_1 * per_pivot_joint1_1;
            let lambda_joint2_1 = (joint1_0_with_joint2_0 * right_joint1_1)
                .neg_mul_add(per_pivot_joint1_1, right_joint2_1);
            out[7] = per_m3_per_per_m3_and_per_m2 * lambda_joint2_1;
            let lambda_joint1_0 = (per_i1_sq_a_per_m3_and_per_m2 * cos_th1 * sin_th1
                * right_joint1_1 * per_pivot_joint1_0)
                .neg_mul_add(per_pivot_joint1_1, right_joint1_0 * per_pivot_joint1_0);
            out[0] = -(per_m1 * lambda_joint1_0);
            out[2] = per_i1_a
                * sin_th1
                    .mul_add(
                        lambda_joint1_0,
                        cos_th1 * right_joint1_1 * per_pivot_joint1_1,
                    );
            let lambda_joint2_0 = joint1_0_with_joint2_0
                .mul_add(lambda_joint1_0, right_joint2_0);
            out[6] = per_m3_per_per_m3_and_per_m2 * lambda_joint2_0;
            let lambda_joint1_1 = right_joint1_1 * per_pivot_joint1_1;
            out[4] = -(joint1_0_with_joint2_0
                * per_per_m3_and_per_m2.mul_add(lambda_joint2_1, lambda_joint1_1));
            out[3] = joint1_0_with_joint2_0
                * per_per_m3_and_per_m2.neg_mul_add(lambda_joint2_0, lambda_joint1_0);
            safe
        }
    }
};
