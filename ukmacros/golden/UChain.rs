/// Falling U-chain: N particles joined by N massless rigid links, of which the last hangs from a fixed support at the origin.
/// Particle 0 is the free tip. The y axis points down. (Zhao, Zhen & Chen 2013, §3-5.)
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Mass matrix M (lower triangle), eq. 1:
///
/// ```text
/// M[x[0], x[0]] = m
/// M[x[1], x[1]] = m
/// M[x[2], x[2]] = m
/// M[x[3], x[3]] = m
/// M[x[4], x[4]] = m
/// M[x[5], x[5]] = m
/// M[x[6], x[6]] = m
/// M[x[7], x[7]] = m
/// M[x[8], x[8]] = m
/// M[x[9], x[9]] = m
/// … 23 rows like these …
/// M[y[16], y[16]] = m
/// ```
///
/// Generalised force Q, eq. 1:
///
/// ```text
/// Q[y[0]] = m*g
/// Q[y[1]] = m*g
/// Q[y[2]] = m*g
/// Q[y[3]] = m*g
/// Q[y[4]] = m*g
/// Q[y[5]] = m*g
/// Q[y[6]] = m*g
/// Q[y[7]] = m*g
/// Q[y[8]] = m*g
/// Q[y[9]] = m*g
/// … 6 rows like these …
/// Q[y[16]] = m*g
/// ```
///
/// Constraints φ, eqs. 3 and 4:
///
/// ```text
/// link[0]: sq(x[1] - x[0]) + sq(y[0] - y[1]) - sq(l) = 0
/// link[1]: sq(x[1] - x[2]) + sq(y[1] - y[2]) - sq(l) = 0
/// link[2]: sq(x[2] - x[3]) + sq(y[2] - y[3]) - sq(l) = 0
/// link[3]: sq(x[3] - x[4]) + sq(y[3] - y[4]) - sq(l) = 0
/// link[4]: sq(x[4] - x[5]) + sq(y[4] - y[5]) - sq(l) = 0
/// link[5]: sq(x[5] - x[6]) + sq(y[5] - y[6]) - sq(l) = 0
/// link[6]: sq(x[6] - x[7]) + sq(y[6] - y[7]) - sq(l) = 0
/// link[7]: sq(x[7] - x[8]) + sq(y[7] - y[8]) - sq(l) = 0
/// link[8]: sq(x[8] - x[9]) + sq(y[8] - y[9]) - sq(l) = 0
/// link[9]: sq(x[9] - x[10]) + sq(y[9] - y[10]) - sq(l) = 0
/// … 6 rows like these …
/// support: sq(x[16]) + sq(y[16]) - sq(l) = 0
/// ```
///
/// Constraint Jacobian A, eq. 5:
///
/// ```text
/// A[link[0], x[0]] = 2*(x[0] - x[1])
/// A[link[0], x[1]] = 2*(x[1] - x[0])
/// A[link[0], y[0]] = 2*(y[0] - y[1])
/// A[link[0], y[1]] = 2*(y[1] - y[0])
/// A[link[1], x[1]] = 2*(x[1] - x[2])
/// A[link[1], x[2]] = 2*(x[2] - x[1])
/// A[link[1], y[1]] = 2*(y[1] - y[2])
/// A[link[1], y[2]] = 2*(y[2] - y[1])
/// A[link[2], x[2]] = 2*(x[2] - x[3])
/// A[link[2], x[3]] = 2*(x[3] - x[2])
/// … 55 rows like these …
/// A[support, y[16]] = 2*y[16]
/// ```
///
/// Right-hand side b, eq. 5:
///
/// ```text
/// b[link[0]] = -2*(sq(dot(x[0]) - dot(x[1])) + sq(dot(y[0]) - dot(y[1])))
/// b[link[1]] = -2*(sq(dot(x[1]) - dot(x[2])) + sq(dot(y[1]) - dot(y[2])))
/// b[link[2]] = -2*(sq(dot(x[2]) - dot(x[3])) + sq(dot(y[2]) - dot(y[3])))
/// b[link[3]] = -2*(sq(dot(x[3]) - dot(x[4])) + sq(dot(y[3]) - dot(y[4])))
/// b[link[4]] = -2*(sq(dot(x[4]) - dot(x[5])) + sq(dot(y[4]) - dot(y[5])))
/// b[link[5]] = -2*(sq(dot(x[5]) - dot(x[6])) + sq(dot(y[5]) - dot(y[6])))
/// b[link[6]] = -2*(sq(dot(x[6]) - dot(x[7])) + sq(dot(y[6]) - dot(y[7])))
/// b[link[7]] = -2*(sq(dot(x[7]) - dot(x[8])) + sq(dot(y[7]) - dot(y[8])))
/// b[link[8]] = -2*(sq(dot(x[8]) - dot(x[9])) + sq(dot(y[8]) - dot(y[9])))
/// b[link[9]] = -2*(sq(dot(x[9]) - dot(x[10])) + sq(dot(y[9]) - dot(y[10])))
/// … 6 rows like these …
/// b[support] = -2*(sq(dot(x[16])) + sq(dot(y[16])))
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 32 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 81 | 117 | 0 | 0 | 0 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 24650 | 25976 | 51 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 229 | 309 | 17 | 0 | 0 | 19 |
/// | straight line, as emitted | 229 | 309 | 17 | 0 | 0 | 17 |
/// | correction of a projection | 172 | 291 | 17 | 0 | 0 | 17 |
/// | once for a set of parameters | 0 | 2 | 0 | 0 | 0 | 2 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct UChain {
    /// Mass of each particle, kg
    pub m: f64,
    /// Length of each link, m
    pub l: f64,
    /// Acceleration of gravity, m/s^2
    pub g: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for UChain {
    fn default() -> Self {
        UChain { m: 1.0, l: 1.0, g: 9.8 }
    }
}
#[allow(dead_code)]
impl UChain {
    /// Constant `N` of the declaration.
    pub const N: usize = 17;
    /// Position in q of coordinates `x`.
    pub const X: [usize; 17] = [
        0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,
    ];
    /// Position in q of coordinates `y`.
    pub const Y: [usize; 17] = [
        17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33,
    ];
    /// Row in A of constraints `link`.
    pub const LINK: [usize; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
    /// Row in A of constraint `support`.
    pub const SUPPORT: usize = 16;
    /// Position of output `fall`.
    pub const OUT_FALL: usize = 0;
    /// Position of output `fall_speed`.
    pub const OUT_FALL_SPEED: usize = 1;
    /// Position of output `centre`.
    pub const OUT_CENTRE: usize = 2;
}
const _: () = {
    use ::ukcore as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<UChain> for ukcore::Prepared {
        fn from(mechanism: UChain) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for UChain {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "UChain",
            doc: "Falling U-chain: N particles joined by N massless rigid links, of which the last hangs from a fixed support at the origin.\nParticle 0 is the free tip. The y axis points down. (Zhao, Zhen & Chen 2013, §3-5.)",
            params: &[
                ukcore::ParamSpec {
                    name: "m",
                    doc: "Mass of each particle, kg",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "l",
                    doc: "Length of each link, m",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "g",
                    doc: "Acceleration of gravity, m/s^2",
                    default: 9.8,
                },
            ],
            prepared: &[
                ("m_g", "m*g"),
                ("sq_l", "sq(l)"),
                ("m", "m"),
                ("g", "g"),
                (
                    "safe_x_0",
                    "1 if the pivots that depend on m alone are positive and finite, else 0",
                ),
            ],
            coords: &[
                "x[0]",
                "x[1]",
                "x[2]",
                "x[3]",
                "x[4]",
                "x[5]",
                "x[6]",
                "x[7]",
                "x[8]",
                "x[9]",
                "x[10]",
                "x[11]",
                "x[12]",
                "x[13]",
                "x[14]",
                "x[15]",
                "x[16]",
                "y[0]",
                "y[1]",
                "y[2]",
                "y[3]",
                "y[4]",
                "y[5]",
                "y[6]",
                "y[7]",
                "y[8]",
                "y[9]",
                "y[10]",
                "y[11]",
                "y[12]",
                "y[13]",
                "y[14]",
                "y[15]",
                "y[16]",
            ],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "link[0]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[1] - x[0]) + sq(y[0] - y[1]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[1]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[1] - x[2]) + sq(y[1] - y[2]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[2]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[2] - x[3]) + sq(y[2] - y[3]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[3]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[3] - x[4]) + sq(y[3] - y[4]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[4]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[4] - x[5]) + sq(y[4] - y[5]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[5]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[5] - x[6]) + sq(y[5] - y[6]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[6]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[6] - x[7]) + sq(y[6] - y[7]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[7]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[7] - x[8]) + sq(y[7] - y[8]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[8]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[8] - x[9]) + sq(y[8] - y[9]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[9]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[9] - x[10]) + sq(y[9] - y[10]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[10]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[10] - x[11]) + sq(y[10] - y[11]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[11]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[11] - x[12]) + sq(y[11] - y[12]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[12]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[12] - x[13]) + sq(y[12] - y[13]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[13]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[13] - x[14]) + sq(y[13] - y[14]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[14]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[14] - x[15]) + sq(y[14] - y[15]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "link[15]",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[15] - x[16]) + sq(y[15] - y[16]) - sq(l) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "support",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x[16]) + sq(y[16]) - sq(l) = 0",
                },
            ],
            holonomic: 17,
            outputs: &[
                ukcore::OutputSpec {
                    name: "fall",
                    doc: "Depth of the tip below the support, m",
                },
                ukcore::OutputSpec {
                    name: "fall_speed",
                    doc: "Downward speed of the tip, m/s",
                },
                ukcore::OutputSpec {
                    name: "centre",
                    doc: "Depth of the centre of mass below the support, m",
                },
            ],
            switches: &[],
            structure: ukcore::Structure {
                straight_line: true,
                solve: ukcore::Solve {
                    refusal: "",
                    pivots: &[
                        ukcore::Pivot::Coordinate(0),
                        ukcore::Pivot::Coordinate(17),
                        ukcore::Pivot::Coordinate(1),
                        ukcore::Pivot::Coordinate(2),
                        ukcore::Pivot::Coordinate(3),
                        ukcore::Pivot::Coordinate(4),
                        ukcore::Pivot::Coordinate(5),
                        ukcore::Pivot::Coordinate(6),
                        ukcore::Pivot::Coordinate(7),
                        ukcore::Pivot::Coordinate(8),
                        ukcore::Pivot::Coordinate(9),
                        ukcore::Pivot::Coordinate(10),
                        ukcore::Pivot::Coordinate(11),
                        ukcore::Pivot::Coordinate(12),
                        ukcore::Pivot::Coordinate(13),
                        ukcore::Pivot::Coordinate(14),
                        ukcore::Pivot::Coordinate(15),
                        ukcore::Pivot::Coordinate(16),
                        ukcore::Pivot::Coordinate(18),
                        ukcore::Pivot::Coordinate(19),
                        ukcore::Pivot::Coordinate(20),
                        ukcore::Pivot::Coordinate(21),
                        ukcore::Pivot::Coordinate(22),
                        ukcore::Pivot::Coordinate(23),
                        ukcore::Pivot::Coordinate(24),
                        ukcore::Pivot::Coordinate(25),
                        ukcore::Pivot::Coordinate(26),
                        ukcore::Pivot::Coordinate(27),
                        ukcore::Pivot::Coordinate(28),
                        ukcore::Pivot::Coordinate(29),
                        ukcore::Pivot::Coordinate(30),
                        ukcore::Pivot::Coordinate(31),
                        ukcore::Pivot::Coordinate(32),
                        ukcore::Pivot::Coordinate(33),
                        ukcore::Pivot::Constraint(0),
                        ukcore::Pivot::Constraint(16),
                        ukcore::Pivot::Constraint(1),
                        ukcore::Pivot::Constraint(15),
                        ukcore::Pivot::Constraint(2),
                        ukcore::Pivot::Constraint(14),
                        ukcore::Pivot::Constraint(3),
                        ukcore::Pivot::Constraint(13),
                        ukcore::Pivot::Constraint(4),
                        ukcore::Pivot::Constraint(12),
                        ukcore::Pivot::Constraint(5),
                        ukcore::Pivot::Constraint(11),
                        ukcore::Pivot::Constraint(6),
                        ukcore::Pivot::Constraint(10),
                        ukcore::Pivot::Constraint(7),
                        ukcore::Pivot::Constraint(9),
                        ukcore::Pivot::Constraint(8),
                    ],
                    fill: &[
                        (35, 34),
                        (36, 35),
                        (37, 36),
                        (38, 37),
                        (39, 38),
                        (40, 39),
                        (41, 40),
                        (42, 41),
                        (43, 42),
                        (44, 43),
                        (45, 44),
                        (46, 45),
                        (47, 46),
                        (48, 47),
                        (49, 48),
                        (50, 49),
                    ],
                    checks: &[
                        ukcore::Check::Positive(0),
                        ukcore::Check::Positive(34),
                        ukcore::Check::Positive(50),
                        ukcore::Check::Share(35),
                        ukcore::Check::Share(49),
                        ukcore::Check::Share(36),
                        ukcore::Check::Share(48),
                        ukcore::Check::Share(37),
                        ukcore::Check::Share(47),
                        ukcore::Check::Share(38),
                        ukcore::Check::Share(46),
                        ukcore::Check::Share(39),
                        ukcore::Check::Share(45),
                        ukcore::Check::Share(40),
                        ukcore::Check::Share(44),
                        ukcore::Check::Share(41),
                        ukcore::Check::Share(43),
                        ukcore::Check::Share(42),
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
                    (9, 9),
                    (10, 10),
                    (11, 11),
                    (12, 12),
                    (13, 13),
                    (14, 14),
                    (15, 15),
                    (16, 16),
                    (17, 17),
                    (18, 18),
                    (19, 19),
                    (20, 20),
                    (21, 21),
                    (22, 22),
                    (23, 23),
                    (24, 24),
                    (25, 25),
                    (26, 26),
                    (27, 27),
                    (28, 28),
                    (29, 29),
                    (30, 30),
                    (31, 31),
                    (32, 32),
                    (33, 33),
                ],
                jacobian_pattern: &[
                    (0, 0),
                    (0, 1),
                    (0, 17),
                    (0, 18),
                    (1, 1),
                    (1, 2),
                    (1, 18),
                    (1, 19),
                    (2, 2),
                    (2, 3),
                    (2, 19),
                    (2, 20),
                    (3, 3),
                    (3, 4),
                    (3, 20),
                    (3, 21),
                    (4, 4),
                    (4, 5),
                    (4, 21),
                    (4, 22),
                    (5, 5),
                    (5, 6),
                    (5, 22),
                    (5, 23),
                    (6, 6),
                    (6, 7),
                    (6, 23),
                    (6, 24),
                    (7, 7),
                    (7, 8),
                    (7, 24),
                    (7, 25),
                    (8, 8),
                    (8, 9),
                    (8, 25),
                    (8, 26),
                    (9, 9),
                    (9, 10),
                    (9, 26),
                    (9, 27),
                    (10, 10),
                    (10, 11),
                    (10, 27),
                    (10, 28),
                    (11, 11),
                    (11, 12),
                    (11, 28),
                    (11, 29),
                    (12, 12),
                    (12, 13),
                    (12, 29),
                    (12, 30),
                    (13, 13),
                    (13, 14),
                    (13, 30),
                    (13, 31),
                    (14, 14),
                    (14, 15),
                    (14, 31),
                    (14, 32),
                    (15, 15),
                    (15, 16),
                    (15, 32),
                    (15, 33),
                    (16, 16),
                    (16, 33),
                ],
                mass_diagonal: true,
                mass_constant: true,
                jacobian_constant: false,
                massless: &[],
                angles: &[],
                scleronomic: true,
                nonideal: false,
                potential: true,
                conservative: true,
                left_out: &[
                    "512 of the 578 entries of A: structurally zero, never written",
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "17 of 34 entries of Q: identically zero",
                    "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 81,
                        multiplications: 117,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    dense: ukcore::Operations {
                        additions: 24650,
                        multiplications: 25976,
                        divisions: 51,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    unprepared: ukcore::Operations {
                        additions: 229,
                        multiplications: 309,
                        divisions: 17,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 19,
                    },
                    acceleration: ukcore::Operations {
                        additions: 229,
                        multiplications: 309,
                        divisions: 17,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 17,
                    },
                    correction: ukcore::Operations {
                        additions: 172,
                        multiplications: 291,
                        divisions: 17,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 17,
                    },
                    prepare: ukcore::Operations {
                        additions: 0,
                        multiplications: 2,
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
                    (0, 0, "m"),
                    (1, 1, "m"),
                    (2, 2, "m"),
                    (3, 3, "m"),
                    (4, 4, "m"),
                    (5, 5, "m"),
                    (6, 6, "m"),
                    (7, 7, "m"),
                    (8, 8, "m"),
                    (9, 9, "m"),
                    (10, 10, "m"),
                    (11, 11, "m"),
                    (12, 12, "m"),
                    (13, 13, "m"),
                    (14, 14, "m"),
                    (15, 15, "m"),
                    (16, 16, "m"),
                    (17, 17, "m"),
                    (18, 18, "m"),
                    (19, 19, "m"),
                    (20, 20, "m"),
                    (21, 21, "m"),
                    (22, 22, "m"),
                    (23, 23, "m"),
                    (24, 24, "m"),
                    (25, 25, "m"),
                    (26, 26, "m"),
                    (27, 27, "m"),
                    (28, 28, "m"),
                    (29, 29, "m"),
                    (30, 30, "m"),
                    (31, 31, "m"),
                    (32, 32, "m"),
                    (33, 33, "m"),
                ],
                force: &[
                    (17, "m*g"),
                    (18, "m*g"),
                    (19, "m*g"),
                    (20, "m*g"),
                    (21, "m*g"),
                    (22, "m*g"),
                    (23, "m*g"),
                    (24, "m*g"),
                    (25, "m*g"),
                    (26, "m*g"),
                    (27, "m*g"),
                    (28, "m*g"),
                    (29, "m*g"),
                    (30, "m*g"),
                    (31, "m*g"),
                    (32, "m*g"),
                    (33, "m*g"),
                ],
                nonideal: &[],
                jacobian: &[
                    (0, 0, "2*(x[0] - x[1])"),
                    (0, 1, "2*(x[1] - x[0])"),
                    (0, 17, "2*(y[0] - y[1])"),
                    (0, 18, "2*(y[1] - y[0])"),
                    (1, 1, "2*(x[1] - x[2])"),
                    (1, 2, "2*(x[2] - x[1])"),
                    (1, 18, "2*(y[1] - y[2])"),
                    (1, 19, "2*(y[2] - y[1])"),
                    (2, 2, "2*(x[2] - x[3])"),
                    (2, 3, "2*(x[3] - x[2])"),
                    (2, 19, "2*(y[2] - y[3])"),
                    (2, 20, "2*(y[3] - y[2])"),
                    (3, 3, "2*(x[3] - x[4])"),
                    (3, 4, "2*(x[4] - x[3])"),
                    (3, 20, "2*(y[3] - y[4])"),
                    (3, 21, "2*(y[4] - y[3])"),
                    (4, 4, "2*(x[4] - x[5])"),
                    (4, 5, "2*(x[5] - x[4])"),
                    (4, 21, "2*(y[4] - y[5])"),
                    (4, 22, "2*(y[5] - y[4])"),
                    (5, 5, "2*(x[5] - x[6])"),
                    (5, 6, "2*(x[6] - x[5])"),
                    (5, 22, "2*(y[5] - y[6])"),
                    (5, 23, "2*(y[6] - y[5])"),
                    (6, 6, "2*(x[6] - x[7])"),
                    (6, 7, "2*(x[7] - x[6])"),
                    (6, 23, "2*(y[6] - y[7])"),
                    (6, 24, "2*(y[7] - y[6])"),
                    (7, 7, "2*(x[7] - x[8])"),
                    (7, 8, "2*(x[8] - x[7])"),
                    (7, 24, "2*(y[7] - y[8])"),
                    (7, 25, "2*(y[8] - y[7])"),
                    (8, 8, "2*(x[8] - x[9])"),
                    (8, 9, "2*(x[9] - x[8])"),
                    (8, 25, "2*(y[8] - y[9])"),
                    (8, 26, "2*(y[9] - y[8])"),
                    (9, 9, "2*(x[9] - x[10])"),
                    (9, 10, "2*(x[10] - x[9])"),
                    (9, 26, "2*(y[9] - y[10])"),
                    (9, 27, "2*(y[10] - y[9])"),
                    (10, 10, "2*(x[10] - x[11])"),
                    (10, 11, "2*(x[11] - x[10])"),
                    (10, 27, "2*(y[10] - y[11])"),
                    (10, 28, "2*(y[11] - y[10])"),
                    (11, 11, "2*(x[11] - x[12])"),
                    (11, 12, "2*(x[12] - x[11])"),
                    (11, 28, "2*(y[11] - y[12])"),
                    (11, 29, "2*(y[12] - y[11])"),
                    (12, 12, "2*(x[12] - x[13])"),
                    (12, 13, "2*(x[13] - x[12])"),
                    (12, 29, "2*(y[12] - y[13])"),
                    (12, 30, "2*(y[13] - y[12])"),
                    (13, 13, "2*(x[13] - x[14])"),
                    (13, 14, "2*(x[14] - x[13])"),
                    (13, 30, "2*(y[13] - y[14])"),
                    (13, 31, "2*(y[14] - y[13])"),
                    (14, 14, "2*(x[14] - x[15])"),
                    (14, 15, "2*(x[15] - x[14])"),
                    (14, 31, "2*(y[14] - y[15])"),
                    (14, 32, "2*(y[15] - y[14])"),
                    (15, 15, "2*(x[15] - x[16])"),
                    (15, 16, "2*(x[16] - x[15])"),
                    (15, 32, "2*(y[15] - y[16])"),
                    (15, 33, "2*(y[16] - y[15])"),
                    (16, 16, "2*x[16]"),
                    (16, 33, "2*y[16]"),
                ],
                rhs: &[
                    (0, "-2*(sq(dot(x[0]) - dot(x[1])) + sq(dot(y[0]) - dot(y[1])))"),
                    (1, "-2*(sq(dot(x[1]) - dot(x[2])) + sq(dot(y[1]) - dot(y[2])))"),
                    (2, "-2*(sq(dot(x[2]) - dot(x[3])) + sq(dot(y[2]) - dot(y[3])))"),
                    (3, "-2*(sq(dot(x[3]) - dot(x[4])) + sq(dot(y[3]) - dot(y[4])))"),
                    (4, "-2*(sq(dot(x[4]) - dot(x[5])) + sq(dot(y[4]) - dot(y[5])))"),
                    (5, "-2*(sq(dot(x[5]) - dot(x[6])) + sq(dot(y[5]) - dot(y[6])))"),
                    (6, "-2*(sq(dot(x[6]) - dot(x[7])) + sq(dot(y[6]) - dot(y[7])))"),
                    (7, "-2*(sq(dot(x[7]) - dot(x[8])) + sq(dot(y[7]) - dot(y[8])))"),
                    (8, "-2*(sq(dot(x[8]) - dot(x[9])) + sq(dot(y[8]) - dot(y[9])))"),
                    (9, "-2*(sq(dot(x[9]) - dot(x[10])) + sq(dot(y[9]) - dot(y[10])))"),
                    (
                        10,
                        "-2*(sq(dot(x[10]) - dot(x[11])) + sq(dot(y[10]) - dot(y[11])))",
                    ),
                    (
                        11,
                        "-2*(sq(dot(x[11]) - dot(x[12])) + sq(dot(y[11]) - dot(y[12])))",
                    ),
                    (
                        12,
                        "-2*(sq(dot(x[12]) - dot(x[13])) + sq(dot(y[12]) - dot(y[13])))",
                    ),
                    (
                        13,
                        "-2*(sq(dot(x[13]) - dot(x[14])) + sq(dot(y[13]) - dot(y[14])))",
                    ),
                    (
                        14,
                        "-2*(sq(dot(x[14]) - dot(x[15])) + sq(dot(y[14]) - dot(y[15])))",
                    ),
                    (
                        15,
                        "-2*(sq(dot(x[15]) - dot(x[16])) + sq(dot(y[15]) - dot(y[16])))",
                    ),
                    (16, "-2*(sq(dot(x[16])) + sq(dot(y[16])))"),
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
            let prepared = ukcore::emitted::exact_mut::<S, 5>(prepared, "prepared");
            let [m, l, g] = *ukcore::emitted::exact::<S, 3>(given, "given");
            let lit = S::from_f64;
            prepared[0] = m * g;
            prepared[1] = l * l;
            prepared[2] = m;
            prepared[3] = g;
            let safe_x_0 = S::select_le(
                m,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            prepared[4] = safe_x_0;
        }
        /// 81 additions, 117 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 0 selections.
        fn dynamics<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut ukcore::Terms<'_, S>,
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 1156>(out.mass, "mass");
            let force = ukcore::emitted::exact_mut::<S, 34>(out.force, "force");
            let nonideal = ukcore::emitted::exact_mut::<S, 34>(out.nonideal, "nonideal");
            let jacobian = ukcore::emitted::exact_mut::<
                S,
                578,
            >(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 17>(out.rhs, "rhs");
            let [m_g, _, m, _, _] = *ukcore::emitted::exact::<
                S,
                5,
            >(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, x_5, x_6, x_7, x_8, x_9, x_10, x_11, x_12,
            x_13, x_14, x_15, x_16, y_0, y_1, y_2, y_3, y_4, y_5, y_6, y_7, y_8, y_9,
            y_10, y_11, y_12, y_13, y_14, y_15, y_16] = *ukcore::emitted::exact::<
                S,
                34,
            >(q, "q");
            let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_x_5, dot_x_6, dot_x_7,
            dot_x_8, dot_x_9, dot_x_10, dot_x_11, dot_x_12, dot_x_13, dot_x_14, dot_x_15,
            dot_x_16, dot_y_0, dot_y_1, dot_y_2, dot_y_3, dot_y_4, dot_y_5, dot_y_6,
            dot_y_7, dot_y_8, dot_y_9, dot_y_10, dot_y_11, dot_y_12, dot_y_13, dot_y_14,
            dot_y_15, dot_y_16] = *ukcore::emitted::exact::<S, 34>(v, "v");
            let lit = S::from_f64;
            mass[0] = m;
            mass[35] = m;
            mass[70] = m;
            mass[105] = m;
            mass[140] = m;
            mass[175] = m;
            mass[210] = m;
            mass[245] = m;
            mass[280] = m;
            mass[315] = m;
            mass[350] = m;
            mass[385] = m;
            mass[420] = m;
            mass[455] = m;
            mass[490] = m;
            mass[525] = m;
            mass[560] = m;
            mass[595] = m;
            mass[630] = m;
            mass[665] = m;
            mass[700] = m;
            mass[735] = m;
            mass[770] = m;
            mass[805] = m;
            mass[840] = m;
            mass[875] = m;
            mass[910] = m;
            mass[945] = m;
            mass[980] = m;
            mass[1015] = m;
            mass[1050] = m;
            mass[1085] = m;
            mass[1120] = m;
            mass[1155] = m;
            force[0] = lit(0.0);
            force[1] = lit(0.0);
            force[2] = lit(0.0);
            force[3] = lit(0.0);
            force[4] = lit(0.0);
            force[5] = lit(0.0);
            force[6] = lit(0.0);
            force[7] = lit(0.0);
            force[8] = lit(0.0);
            force[9] = lit(0.0);
            force[10] = lit(0.0);
            force[11] = lit(0.0);
            force[12] = lit(0.0);
            force[13] = lit(0.0);
            force[14] = lit(0.0);
            force[15] = lit(0.0);
            force[16] = lit(0.0);
            force[17] = m_g;
            force[18] = m_g;
            force[19] = m_g;
            force[20] = m_g;
            force[21] = m_g;
            force[22] = m_g;
            force[23] = m_g;
            force[24] = m_g;
            force[25] = m_g;
            force[26] = m_g;
            force[27] = m_g;
            force[28] = m_g;
            force[29] = m_g;
            force[30] = m_g;
            force[31] = m_g;
            force[32] = m_g;
            force[33] = m_g;
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
            nonideal[10] = lit(0.0);
            nonideal[11] = lit(0.0);
            nonideal[12] = lit(0.0);
            nonideal[13] = lit(0.0);
            nonideal[14] = lit(0.0);
            nonideal[15] = lit(0.0);
            nonideal[16] = lit(0.0);
            nonideal[17] = lit(0.0);
            nonideal[18] = lit(0.0);
            nonideal[19] = lit(0.0);
            nonideal[20] = lit(0.0);
            nonideal[21] = lit(0.0);
            nonideal[22] = lit(0.0);
            nonideal[23] = lit(0.0);
            nonideal[24] = lit(0.0);
            nonideal[25] = lit(0.0);
            nonideal[26] = lit(0.0);
            nonideal[27] = lit(0.0);
            nonideal[28] = lit(0.0);
            nonideal[29] = lit(0.0);
            nonideal[30] = lit(0.0);
            nonideal[31] = lit(0.0);
            nonideal[32] = lit(0.0);
            nonideal[33] = lit(0.0);
            let x_1_minus_x_0 = x_1 - x_0;
            jacobian[0] = lit(-2.0) * x_1_minus_x_0;
            jacobian[17] = lit(2.0) * x_1_minus_x_0;
            let y_0_minus_y_1 = y_0 - y_1;
            jacobian[289] = lit(2.0) * y_0_minus_y_1;
            jacobian[306] = lit(-2.0) * y_0_minus_y_1;
            let x_1_minus_x_2 = x_1 - x_2;
            jacobian[18] = lit(2.0) * x_1_minus_x_2;
            jacobian[35] = lit(-2.0) * x_1_minus_x_2;
            let y_1_minus_y_2 = y_1 - y_2;
            jacobian[307] = lit(2.0) * y_1_minus_y_2;
            jacobian[324] = lit(-2.0) * y_1_minus_y_2;
            let x_2_minus_x_3 = x_2 - x_3;
            jacobian[36] = lit(2.0) * x_2_minus_x_3;
            jacobian[53] = lit(-2.0) * x_2_minus_x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            jacobian[325] = lit(2.0) * y_2_minus_y_3;
            jacobian[342] = lit(-2.0) * y_2_minus_y_3;
            let x_3_minus_x_4 = x_3 - x_4;
            jacobian[54] = lit(2.0) * x_3_minus_x_4;
            jacobian[71] = lit(-2.0) * x_3_minus_x_4;
            let y_3_minus_y_4 = y_3 - y_4;
            jacobian[343] = lit(2.0) * y_3_minus_y_4;
            jacobian[360] = lit(-2.0) * y_3_minus_y_4;
            let x_4_minus_x_5 = x_4 - x_5;
            jacobian[72] = lit(2.0) * x_4_minus_x_5;
            jacobian[89] = lit(-2.0) * x_4_minus_x_5;
            let y_4_minus_y_5 = y_4 - y_5;
            jacobian[361] = lit(2.0) * y_4_minus_y_5;
            jacobian[378] = lit(-2.0) * y_4_minus_y_5;
            let x_5_minus_x_6 = x_5 - x_6;
            jacobian[90] = lit(2.0) * x_5_minus_x_6;
            jacobian[107] = lit(-2.0) * x_5_minus_x_6;
            let y_5_minus_y_6 = y_5 - y_6;
            jacobian[379] = lit(2.0) * y_5_minus_y_6;
            jacobian[396] = lit(-2.0) * y_5_minus_y_6;
            let x_6_minus_x_7 = x_6 - x_7;
            jacobian[108] = lit(2.0) * x_6_minus_x_7;
            jacobian[125] = lit(-2.0) * x_6_minus_x_7;
            let y_6_minus_y_7 = y_6 - y_7;
            jacobian[397] = lit(2.0) * y_6_minus_y_7;
            jacobian[414] = lit(-2.0) * y_6_minus_y_7;
            let x_7_minus_x_8 = x_7 - x_8;
            jacobian[126] = lit(2.0) * x_7_minus_x_8;
            jacobian[143] = lit(-2.0) * x_7_minus_x_8;
            let y_7_minus_y_8 = y_7 - y_8;
            jacobian[415] = lit(2.0) * y_7_minus_y_8;
            jacobian[432] = lit(-2.0) * y_7_minus_y_8;
            let x_8_minus_x_9 = x_8 - x_9;
            jacobian[144] = lit(2.0) * x_8_minus_x_9;
            jacobian[161] = lit(-2.0) * x_8_minus_x_9;
            let y_8_minus_y_9 = y_8 - y_9;
            jacobian[433] = lit(2.0) * y_8_minus_y_9;
            jacobian[450] = lit(-2.0) * y_8_minus_y_9;
            let x_9_minus_x_10 = x_9 - x_10;
            jacobian[162] = lit(2.0) * x_9_minus_x_10;
            jacobian[179] = lit(-2.0) * x_9_minus_x_10;
            let y_9_minus_y_10 = y_9 - y_10;
            jacobian[451] = lit(2.0) * y_9_minus_y_10;
            jacobian[468] = lit(-2.0) * y_9_minus_y_10;
            let x_10_minus_x_11 = x_10 - x_11;
            jacobian[180] = lit(2.0) * x_10_minus_x_11;
            jacobian[197] = lit(-2.0) * x_10_minus_x_11;
            let y_10_minus_y_11 = y_10 - y_11;
            jacobian[469] = lit(2.0) * y_10_minus_y_11;
            jacobian[486] = lit(-2.0) * y_10_minus_y_11;
            let x_11_minus_x_12 = x_11 - x_12;
            jacobian[198] = lit(2.0) * x_11_minus_x_12;
            jacobian[215] = lit(-2.0) * x_11_minus_x_12;
            let y_11_minus_y_12 = y_11 - y_12;
            jacobian[487] = lit(2.0) * y_11_minus_y_12;
            jacobian[504] = lit(-2.0) * y_11_minus_y_12;
            let x_12_minus_x_13 = x_12 - x_13;
            jacobian[216] = lit(2.0) * x_12_minus_x_13;
            jacobian[233] = lit(-2.0) * x_12_minus_x_13;
            let y_12_minus_y_13 = y_12 - y_13;
            jacobian[505] = lit(2.0) * y_12_minus_y_13;
            jacobian[522] = lit(-2.0) * y_12_minus_y_13;
            let x_13_minus_x_14 = x_13 - x_14;
            jacobian[234] = lit(2.0) * x_13_minus_x_14;
            jacobian[251] = lit(-2.0) * x_13_minus_x_14;
            let y_13_minus_y_14 = y_13 - y_14;
            jacobian[523] = lit(2.0) * y_13_minus_y_14;
            jacobian[540] = lit(-2.0) * y_13_minus_y_14;
            let x_14_minus_x_15 = x_14 - x_15;
            jacobian[252] = lit(2.0) * x_14_minus_x_15;
            jacobian[269] = lit(-2.0) * x_14_minus_x_15;
            let y_14_minus_y_15 = y_14 - y_15;
            jacobian[541] = lit(2.0) * y_14_minus_y_15;
            jacobian[558] = lit(-2.0) * y_14_minus_y_15;
            let x_15_minus_x_16 = x_15 - x_16;
            jacobian[270] = lit(2.0) * x_15_minus_x_16;
            jacobian[287] = lit(-2.0) * x_15_minus_x_16;
            let y_15_minus_y_16 = y_15 - y_16;
            jacobian[559] = lit(2.0) * y_15_minus_y_16;
            jacobian[576] = lit(-2.0) * y_15_minus_y_16;
            jacobian[288] = lit(2.0) * x_16;
            jacobian[577] = lit(2.0) * y_16;
            let dot_x_0_minus_dot_x_1 = dot_x_0 - dot_x_1;
            let dot_y_0_minus_dot_y_1 = dot_y_0 - dot_y_1;
            let right_link_0 = dot_y_0_minus_dot_y_1
                .mul_add(
                    dot_y_0_minus_dot_y_1,
                    dot_x_0_minus_dot_x_1 * dot_x_0_minus_dot_x_1,
                );
            rhs[0] = lit(-2.0) * right_link_0;
            let dot_x_1_minus_dot_x_2 = dot_x_1 - dot_x_2;
            let dot_y_1_minus_dot_y_2 = dot_y_1 - dot_y_2;
            rhs[1] = lit(-2.0)
                * dot_y_1_minus_dot_y_2
                    .mul_add(
                        dot_y_1_minus_dot_y_2,
                        dot_x_1_minus_dot_x_2 * dot_x_1_minus_dot_x_2,
                    );
            let dot_x_2_minus_dot_x_3 = dot_x_2 - dot_x_3;
            let dot_y_2_minus_dot_y_3 = dot_y_2 - dot_y_3;
            rhs[2] = lit(-2.0)
                * dot_y_2_minus_dot_y_3
                    .mul_add(
                        dot_y_2_minus_dot_y_3,
                        dot_x_2_minus_dot_x_3 * dot_x_2_minus_dot_x_3,
                    );
            let dot_x_3_minus_dot_x_4 = dot_x_3 - dot_x_4;
            let dot_y_3_minus_dot_y_4 = dot_y_3 - dot_y_4;
            rhs[3] = lit(-2.0)
                * dot_y_3_minus_dot_y_4
                    .mul_add(
                        dot_y_3_minus_dot_y_4,
                        dot_x_3_minus_dot_x_4 * dot_x_3_minus_dot_x_4,
                    );
            let dot_x_4_minus_dot_x_5 = dot_x_4 - dot_x_5;
            let dot_y_4_minus_dot_y_5 = dot_y_4 - dot_y_5;
            rhs[4] = lit(-2.0)
                * dot_y_4_minus_dot_y_5
                    .mul_add(
                        dot_y_4_minus_dot_y_5,
                        dot_x_4_minus_dot_x_5 * dot_x_4_minus_dot_x_5,
                    );
            let dot_x_5_minus_dot_x_6 = dot_x_5 - dot_x_6;
            let dot_y_5_minus_dot_y_6 = dot_y_5 - dot_y_6;
            rhs[5] = lit(-2.0)
                * dot_y_5_minus_dot_y_6
                    .mul_add(
                        dot_y_5_minus_dot_y_6,
                        dot_x_5_minus_dot_x_6 * dot_x_5_minus_dot_x_6,
                    );
            let dot_x_6_minus_dot_x_7 = dot_x_6 - dot_x_7;
            let dot_y_6_minus_dot_y_7 = dot_y_6 - dot_y_7;
            rhs[6] = lit(-2.0)
                * dot_y_6_minus_dot_y_7
                    .mul_add(
                        dot_y_6_minus_dot_y_7,
                        dot_x_6_minus_dot_x_7 * dot_x_6_minus_dot_x_7,
                    );
            let dot_x_7_minus_dot_x_8 = dot_x_7 - dot_x_8;
            let dot_y_7_minus_dot_y_8 = dot_y_7 - dot_y_8;
            rhs[7] = lit(-2.0)
                * dot_y_7_minus_dot_y_8
                    .mul_add(
                        dot_y_7_minus_dot_y_8,
                        dot_x_7_minus_dot_x_8 * dot_x_7_minus_dot_x_8,
                    );
            let dot_x_8_minus_dot_x_9 = dot_x_8 - dot_x_9;
            let dot_y_8_minus_dot_y_9 = dot_y_8 - dot_y_9;
            rhs[8] = lit(-2.0)
                * dot_y_8_minus_dot_y_9
                    .mul_add(
                        dot_y_8_minus_dot_y_9,
                        dot_x_8_minus_dot_x_9 * dot_x_8_minus_dot_x_9,
                    );
            let dot_x_9_minus_dot_x_10 = dot_x_9 - dot_x_10;
            let dot_y_9_minus_dot_y_10 = dot_y_9 - dot_y_10;
            rhs[9] = lit(-2.0)
                * dot_y_9_minus_dot_y_10
                    .mul_add(
                        dot_y_9_minus_dot_y_10,
                        dot_x_9_minus_dot_x_10 * dot_x_9_minus_dot_x_10,
                    );
            let dot_x_10_minus_dot_x_11 = dot_x_10 - dot_x_11;
            let dot_y_10_minus_dot_y_11 = dot_y_10 - dot_y_11;
            rhs[10] = lit(-2.0)
                * dot_y_10_minus_dot_y_11
                    .mul_add(
                        dot_y_10_minus_dot_y_11,
                        dot_x_10_minus_dot_x_11 * dot_x_10_minus_dot_x_11,
                    );
            let dot_x_11_minus_dot_x_12 = dot_x_11 - dot_x_12;
            let dot_y_11_minus_dot_y_12 = dot_y_11 - dot_y_12;
            rhs[11] = lit(-2.0)
                * dot_y_11_minus_dot_y_12
                    .mul_add(
                        dot_y_11_minus_dot_y_12,
                        dot_x_11_minus_dot_x_12 * dot_x_11_minus_dot_x_12,
                    );
            let dot_x_12_minus_dot_x_13 = dot_x_12 - dot_x_13;
            let dot_y_12_minus_dot_y_13 = dot_y_12 - dot_y_13;
            rhs[12] = lit(-2.0)
                * dot_y_12_minus_dot_y_13
                    .mul_add(
                        dot_y_12_minus_dot_y_13,
                        dot_x_12_minus_dot_x_13 * dot_x_12_minus_dot_x_13,
                    );
            let dot_x_13_minus_dot_x_14 = dot_x_13 - dot_x_14;
            let dot_y_13_minus_dot_y_14 = dot_y_13 - dot_y_14;
            rhs[13] = lit(-2.0)
                * dot_y_13_minus_dot_y_14
                    .mul_add(
                        dot_y_13_minus_dot_y_14,
                        dot_x_13_minus_dot_x_14 * dot_x_13_minus_dot_x_14,
                    );
            let dot_x_14_minus_dot_x_15 = dot_x_14 - dot_x_15;
            let dot_y_14_minus_dot_y_15 = dot_y_14 - dot_y_15;
            rhs[14] = lit(-2.0)
                * dot_y_14_minus_dot_y_15
                    .mul_add(
                        dot_y_14_minus_dot_y_15,
                        dot_x_14_minus_dot_x_15 * dot_x_14_minus_dot_x_15,
                    );
            let dot_x_15_minus_dot_x_16 = dot_x_15 - dot_x_16;
            let dot_y_15_minus_dot_y_16 = dot_y_15 - dot_y_16;
            rhs[15] = lit(-2.0)
                * dot_y_15_minus_dot_y_16
                    .mul_add(
                        dot_y_15_minus_dot_y_16,
                        dot_x_15_minus_dot_x_16 * dot_x_15_minus_dot_x_16,
                    );
            rhs[16] = lit(-2.0) * dot_y_16.mul_add(dot_y_16, dot_x_16 * dot_x_16);
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 1156>(mass, "mass");
            let [_, _, m, _, _] = *ukcore::emitted::exact::<S, 5>(prepared, "prepared");
            mass[0] = m;
            mass[35] = m;
            mass[70] = m;
            mass[105] = m;
            mass[140] = m;
            mass[175] = m;
            mass[210] = m;
            mass[245] = m;
            mass[280] = m;
            mass[315] = m;
            mass[350] = m;
            mass[385] = m;
            mass[420] = m;
            mass[455] = m;
            mass[490] = m;
            mass[525] = m;
            mass[560] = m;
            mass[595] = m;
            mass[630] = m;
            mass[665] = m;
            mass[700] = m;
            mass[735] = m;
            mass[770] = m;
            mass[805] = m;
            mass[840] = m;
            mass[875] = m;
            mass[910] = m;
            mass[945] = m;
            mass[980] = m;
            mass[1015] = m;
            mass[1050] = m;
            mass[1085] = m;
            mass[1120] = m;
            mass[1155] = m;
        }
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {
            let jacobian = ukcore::emitted::exact_mut::<S, 578>(jacobian, "jacobian");
            let [x_0, x_1, x_2, x_3, x_4, x_5, x_6, x_7, x_8, x_9, x_10, x_11, x_12,
            x_13, x_14, x_15, x_16, y_0, y_1, y_2, y_3, y_4, y_5, y_6, y_7, y_8, y_9,
            y_10, y_11, y_12, y_13, y_14, y_15, y_16] = *ukcore::emitted::exact::<
                S,
                34,
            >(q, "q");
            let lit = S::from_f64;
            let x_1_minus_x_0 = x_1 - x_0;
            jacobian[0] = lit(-2.0) * x_1_minus_x_0;
            jacobian[17] = lit(2.0) * x_1_minus_x_0;
            let y_0_minus_y_1 = y_0 - y_1;
            jacobian[289] = lit(2.0) * y_0_minus_y_1;
            jacobian[306] = lit(-2.0) * y_0_minus_y_1;
            let x_1_minus_x_2 = x_1 - x_2;
            jacobian[18] = lit(2.0) * x_1_minus_x_2;
            jacobian[35] = lit(-2.0) * x_1_minus_x_2;
            let y_1_minus_y_2 = y_1 - y_2;
            jacobian[307] = lit(2.0) * y_1_minus_y_2;
            jacobian[324] = lit(-2.0) * y_1_minus_y_2;
            let x_2_minus_x_3 = x_2 - x_3;
            jacobian[36] = lit(2.0) * x_2_minus_x_3;
            jacobian[53] = lit(-2.0) * x_2_minus_x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            jacobian[325] = lit(2.0) * y_2_minus_y_3;
            jacobian[342] = lit(-2.0) * y_2_minus_y_3;
            let x_3_minus_x_4 = x_3 - x_4;
            jacobian[54] = lit(2.0) * x_3_minus_x_4;
            jacobian[71] = lit(-2.0) * x_3_minus_x_4;
            let y_3_minus_y_4 = y_3 - y_4;
            jacobian[343] = lit(2.0) * y_3_minus_y_4;
            jacobian[360] = lit(-2.0) * y_3_minus_y_4;
            let x_4_minus_x_5 = x_4 - x_5;
            jacobian[72] = lit(2.0) * x_4_minus_x_5;
            jacobian[89] = lit(-2.0) * x_4_minus_x_5;
            let y_4_minus_y_5 = y_4 - y_5;
            jacobian[361] = lit(2.0) * y_4_minus_y_5;
            jacobian[378] = lit(-2.0) * y_4_minus_y_5;
            let x_5_minus_x_6 = x_5 - x_6;
            jacobian[90] = lit(2.0) * x_5_minus_x_6;
            jacobian[107] = lit(-2.0) * x_5_minus_x_6;
            let y_5_minus_y_6 = y_5 - y_6;
            jacobian[379] = lit(2.0) * y_5_minus_y_6;
            jacobian[396] = lit(-2.0) * y_5_minus_y_6;
            let x_6_minus_x_7 = x_6 - x_7;
            jacobian[108] = lit(2.0) * x_6_minus_x_7;
            jacobian[125] = lit(-2.0) * x_6_minus_x_7;
            let y_6_minus_y_7 = y_6 - y_7;
            jacobian[397] = lit(2.0) * y_6_minus_y_7;
            jacobian[414] = lit(-2.0) * y_6_minus_y_7;
            let x_7_minus_x_8 = x_7 - x_8;
            jacobian[126] = lit(2.0) * x_7_minus_x_8;
            jacobian[143] = lit(-2.0) * x_7_minus_x_8;
            let y_7_minus_y_8 = y_7 - y_8;
            jacobian[415] = lit(2.0) * y_7_minus_y_8;
            jacobian[432] = lit(-2.0) * y_7_minus_y_8;
            let x_8_minus_x_9 = x_8 - x_9;
            jacobian[144] = lit(2.0) * x_8_minus_x_9;
            jacobian[161] = lit(-2.0) * x_8_minus_x_9;
            let y_8_minus_y_9 = y_8 - y_9;
            jacobian[433] = lit(2.0) * y_8_minus_y_9;
            jacobian[450] = lit(-2.0) * y_8_minus_y_9;
            let x_9_minus_x_10 = x_9 - x_10;
            jacobian[162] = lit(2.0) * x_9_minus_x_10;
            jacobian[179] = lit(-2.0) * x_9_minus_x_10;
            let y_9_minus_y_10 = y_9 - y_10;
            jacobian[451] = lit(2.0) * y_9_minus_y_10;
            jacobian[468] = lit(-2.0) * y_9_minus_y_10;
            let x_10_minus_x_11 = x_10 - x_11;
            jacobian[180] = lit(2.0) * x_10_minus_x_11;
            jacobian[197] = lit(-2.0) * x_10_minus_x_11;
            let y_10_minus_y_11 = y_10 - y_11;
            jacobian[469] = lit(2.0) * y_10_minus_y_11;
            jacobian[486] = lit(-2.0) * y_10_minus_y_11;
            let x_11_minus_x_12 = x_11 - x_12;
            jacobian[198] = lit(2.0) * x_11_minus_x_12;
            jacobian[215] = lit(-2.0) * x_11_minus_x_12;
            let y_11_minus_y_12 = y_11 - y_12;
            jacobian[487] = lit(2.0) * y_11_minus_y_12;
            jacobian[504] = lit(-2.0) * y_11_minus_y_12;
            let x_12_minus_x_13 = x_12 - x_13;
            jacobian[216] = lit(2.0) * x_12_minus_x_13;
            jacobian[233] = lit(-2.0) * x_12_minus_x_13;
            let y_12_minus_y_13 = y_12 - y_13;
            jacobian[505] = lit(2.0) * y_12_minus_y_13;
            jacobian[522] = lit(-2.0) * y_12_minus_y_13;
            let x_13_minus_x_14 = x_13 - x_14;
            jacobian[234] = lit(2.0) * x_13_minus_x_14;
            jacobian[251] = lit(-2.0) * x_13_minus_x_14;
            let y_13_minus_y_14 = y_13 - y_14;
            jacobian[523] = lit(2.0) * y_13_minus_y_14;
            jacobian[540] = lit(-2.0) * y_13_minus_y_14;
            let x_14_minus_x_15 = x_14 - x_15;
            jacobian[252] = lit(2.0) * x_14_minus_x_15;
            jacobian[269] = lit(-2.0) * x_14_minus_x_15;
            let y_14_minus_y_15 = y_14 - y_15;
            jacobian[541] = lit(2.0) * y_14_minus_y_15;
            jacobian[558] = lit(-2.0) * y_14_minus_y_15;
            let x_15_minus_x_16 = x_15 - x_16;
            jacobian[270] = lit(2.0) * x_15_minus_x_16;
            jacobian[287] = lit(-2.0) * x_15_minus_x_16;
            let y_15_minus_y_16 = y_15 - y_16;
            jacobian[559] = lit(2.0) * y_15_minus_y_16;
            jacobian[576] = lit(-2.0) * y_15_minus_y_16;
            jacobian[288] = lit(2.0) * x_16;
            jacobian[577] = lit(2.0) * y_16;
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 17>(phi, "phi");
            let [_, sq_l, _, _, _] = *ukcore::emitted::exact::<
                S,
                5,
            >(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, x_5, x_6, x_7, x_8, x_9, x_10, x_11, x_12,
            x_13, x_14, x_15, x_16, y_0, y_1, y_2, y_3, y_4, y_5, y_6, y_7, y_8, y_9,
            y_10, y_11, y_12, y_13, y_14, y_15, y_16] = *ukcore::emitted::exact::<
                S,
                34,
            >(q, "q");
            let x_1_minus_x_0 = x_1 - x_0;
            let y_0_minus_y_1 = y_0 - y_1;
            phi[0] = y_0_minus_y_1
                .mul_add(y_0_minus_y_1, x_1_minus_x_0 * x_1_minus_x_0 - sq_l);
            let x_1_minus_x_2 = x_1 - x_2;
            let y_1_minus_y_2 = y_1 - y_2;
            phi[1] = y_1_minus_y_2
                .mul_add(y_1_minus_y_2, x_1_minus_x_2 * x_1_minus_x_2 - sq_l);
            let x_2_minus_x_3 = x_2 - x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            phi[2] = y_2_minus_y_3
                .mul_add(y_2_minus_y_3, x_2_minus_x_3 * x_2_minus_x_3 - sq_l);
            let x_3_minus_x_4 = x_3 - x_4;
            let y_3_minus_y_4 = y_3 - y_4;
            phi[3] = y_3_minus_y_4
                .mul_add(y_3_minus_y_4, x_3_minus_x_4 * x_3_minus_x_4 - sq_l);
            let x_4_minus_x_5 = x_4 - x_5;
            let y_4_minus_y_5 = y_4 - y_5;
            phi[4] = y_4_minus_y_5
                .mul_add(y_4_minus_y_5, x_4_minus_x_5 * x_4_minus_x_5 - sq_l);
            let x_5_minus_x_6 = x_5 - x_6;
            let y_5_minus_y_6 = y_5 - y_6;
            phi[5] = y_5_minus_y_6
                .mul_add(y_5_minus_y_6, x_5_minus_x_6 * x_5_minus_x_6 - sq_l);
            let x_6_minus_x_7 = x_6 - x_7;
            let y_6_minus_y_7 = y_6 - y_7;
            phi[6] = y_6_minus_y_7
                .mul_add(y_6_minus_y_7, x_6_minus_x_7 * x_6_minus_x_7 - sq_l);
            let x_7_minus_x_8 = x_7 - x_8;
            let y_7_minus_y_8 = y_7 - y_8;
            phi[7] = y_7_minus_y_8
                .mul_add(y_7_minus_y_8, x_7_minus_x_8 * x_7_minus_x_8 - sq_l);
            let x_8_minus_x_9 = x_8 - x_9;
            let y_8_minus_y_9 = y_8 - y_9;
            phi[8] = y_8_minus_y_9
                .mul_add(y_8_minus_y_9, x_8_minus_x_9 * x_8_minus_x_9 - sq_l);
            let x_9_minus_x_10 = x_9 - x_10;
            let y_9_minus_y_10 = y_9 - y_10;
            phi[9] = y_9_minus_y_10
                .mul_add(y_9_minus_y_10, x_9_minus_x_10 * x_9_minus_x_10 - sq_l);
            let x_10_minus_x_11 = x_10 - x_11;
            let y_10_minus_y_11 = y_10 - y_11;
            phi[10] = y_10_minus_y_11
                .mul_add(y_10_minus_y_11, x_10_minus_x_11 * x_10_minus_x_11 - sq_l);
            let x_11_minus_x_12 = x_11 - x_12;
            let y_11_minus_y_12 = y_11 - y_12;
            phi[11] = y_11_minus_y_12
                .mul_add(y_11_minus_y_12, x_11_minus_x_12 * x_11_minus_x_12 - sq_l);
            let x_12_minus_x_13 = x_12 - x_13;
            let y_12_minus_y_13 = y_12 - y_13;
            phi[12] = y_12_minus_y_13
                .mul_add(y_12_minus_y_13, x_12_minus_x_13 * x_12_minus_x_13 - sq_l);
            let x_13_minus_x_14 = x_13 - x_14;
            let y_13_minus_y_14 = y_13 - y_14;
            phi[13] = y_13_minus_y_14
                .mul_add(y_13_minus_y_14, x_13_minus_x_14 * x_13_minus_x_14 - sq_l);
            let x_14_minus_x_15 = x_14 - x_15;
            let y_14_minus_y_15 = y_14 - y_15;
            phi[14] = y_14_minus_y_15
                .mul_add(y_14_minus_y_15, x_14_minus_x_15 * x_14_minus_x_15 - sq_l);
            let x_15_minus_x_16 = x_15 - x_16;
            let y_15_minus_y_16 = y_15 - y_16;
            phi[15] = y_15_minus_y_16
                .mul_add(y_15_minus_y_16, x_15_minus_x_16 * x_15_minus_x_16 - sq_l);
            phi[16] = y_16.mul_add(y_16, x_16 * x_16 - sq_l);
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 17>(rate, "rate");
            let [x_0, x_1, x_2, x_3, x_4, x_5, x_6, x_7, x_8, x_9, x_10, x_11, x_12,
            x_13, x_14, x_15, x_16, y_0, y_1, y_2, y_3, y_4, y_5, y_6, y_7, y_8, y_9,
            y_10, y_11, y_12, y_13, y_14, y_15, y_16] = *ukcore::emitted::exact::<
                S,
                34,
            >(q, "q");
            let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_x_5, dot_x_6, dot_x_7,
            dot_x_8, dot_x_9, dot_x_10, dot_x_11, dot_x_12, dot_x_13, dot_x_14, dot_x_15,
            dot_x_16, dot_y_0, dot_y_1, dot_y_2, dot_y_3, dot_y_4, dot_y_5, dot_y_6,
            dot_y_7, dot_y_8, dot_y_9, dot_y_10, dot_y_11, dot_y_12, dot_y_13, dot_y_14,
            dot_y_15, dot_y_16] = *ukcore::emitted::exact::<S, 34>(v, "v");
            let lit = S::from_f64;
            rate[0] = lit(-2.0)
                * (y_0 - y_1)
                    .neg_mul_add((dot_y_0 - dot_y_1), (x_1 - x_0) * (dot_x_0 - dot_x_1));
            rate[1] = lit(2.0)
                * (y_1 - y_2)
                    .mul_add((dot_y_1 - dot_y_2), (x_1 - x_2) * (dot_x_1 - dot_x_2));
            rate[2] = lit(2.0)
                * (y_2 - y_3)
                    .mul_add((dot_y_2 - dot_y_3), (x_2 - x_3) * (dot_x_2 - dot_x_3));
            rate[3] = lit(2.0)
                * (y_3 - y_4)
                    .mul_add((dot_y_3 - dot_y_4), (x_3 - x_4) * (dot_x_3 - dot_x_4));
            rate[4] = lit(2.0)
                * (y_4 - y_5)
                    .mul_add((dot_y_4 - dot_y_5), (x_4 - x_5) * (dot_x_4 - dot_x_5));
            rate[5] = lit(2.0)
                * (y_5 - y_6)
                    .mul_add((dot_y_5 - dot_y_6), (x_5 - x_6) * (dot_x_5 - dot_x_6));
            rate[6] = lit(2.0)
                * (y_6 - y_7)
                    .mul_add((dot_y_6 - dot_y_7), (x_6 - x_7) * (dot_x_6 - dot_x_7));
            rate[7] = lit(2.0)
                * (y_7 - y_8)
                    .mul_add((dot_y_7 - dot_y_8), (x_7 - x_8) * (dot_x_7 - dot_x_8));
            rate[8] = lit(2.0)
                * (y_8 - y_9)
                    .mul_add((dot_y_8 - dot_y_9), (x_8 - x_9) * (dot_x_8 - dot_x_9));
            rate[9] = lit(2.0)
                * (y_9 - y_10)
                    .mul_add((dot_y_9 - dot_y_10), (x_9 - x_10) * (dot_x_9 - dot_x_10));
            rate[10] = lit(2.0)
                * (y_10 - y_11)
                    .mul_add(
                        (dot_y_10 - dot_y_11),
                        (x_10 - x_11) * (dot_x_10 - dot_x_11),
                    );
            rate[11] = lit(2.0)
                * (y_11 - y_12)
                    .mul_add(
                        (dot_y_11 - dot_y_12),
                        (x_11 - x_12) * (dot_x_11 - dot_x_12),
                    );
            rate[12] = lit(2.0)
                * (y_12 - y_13)
                    .mul_add(
                        (dot_y_12 - dot_y_13),
                        (x_12 - x_13) * (dot_x_12 - dot_x_13),
                    );
            rate[13] = lit(2.0)
                * (y_13 - y_14)
                    .mul_add(
                        (dot_y_13 - dot_y_14),
                        (x_13 - x_14) * (dot_x_13 - dot_x_14),
                    );
            rate[14] = lit(2.0)
                * (y_14 - y_15)
                    .mul_add(
                        (dot_y_14 - dot_y_15),
                        (x_14 - x_15) * (dot_x_14 - dot_x_15),
                    );
            rate[15] = lit(2.0)
                * (y_15 - y_16)
                    .mul_add(
                        (dot_y_15 - dot_y_16),
                        (x_15 - x_16) * (dot_x_15 - dot_x_16),
                    );
            rate[16] = lit(2.0) * y_16.mul_add(dot_y_16, x_16 * dot_x_16);
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [m_g, _, m, _, _] = *ukcore::emitted::exact::<
                S,
                5,
            >(prepared, "prepared");
            let [_, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, y_0, y_1, y_2, y_3,
            y_4, y_5, y_6, y_7, y_8, y_9, y_10, y_11, y_12, y_13, y_14, y_15, y_16] = *ukcore::emitted::exact::<
                S,
                34,
            >(q, "q");
            let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_x_5, dot_x_6, dot_x_7,
            dot_x_8, dot_x_9, dot_x_10, dot_x_11, dot_x_12, dot_x_13, dot_x_14, dot_x_15,
            dot_x_16, dot_y_0, dot_y_1, dot_y_2, dot_y_3, dot_y_4, dot_y_5, dot_y_6,
            dot_y_7, dot_y_8, dot_y_9, dot_y_10, dot_y_11, dot_y_12, dot_y_13, dot_y_14,
            dot_y_15, dot_y_16] = *ukcore::emitted::exact::<S, 34>(v, "v");
            let lit = S::from_f64;
            let kinetic = lit(0.5)
                * (dot_y_16 * dot_y_16)
                    .mul_add(
                        m,
                        (dot_y_15 * dot_y_15)
                            .mul_add(
                                m,
                                (dot_y_14 * dot_y_14)
                                    .mul_add(
                                        m,
                                        (dot_y_13 * dot_y_13)
                                            .mul_add(
                                                m,
                                                (dot_y_12 * dot_y_12)
                                                    .mul_add(
                                                        m,
                                                        (dot_y_11 * dot_y_11)
                                                            .mul_add(
                                                                m,
                                                                (dot_y_10 * dot_y_10)
                                                                    .mul_add(
                                                                        m,
                                                                        (dot_y_9 * dot_y_9)
                                                                            .mul_add(
                                                                                m,
                                                                                (dot_y_8 * dot_y_8)
                                                                                    .mul_add(
                                                                                        m,
                                                                                        (dot_y_7 * dot_y_7)
                                                                                            .mul_add(
                                                                                                m,
                                                                                                (dot_y_6 * dot_y_6)
                                                                                                    .mul_add(
                                                                                                        m,
                                                                                                        (dot_y_5 * dot_y_5)
                                                                                                            .mul_add(
                                                                                                                m,
                                                                                                                (dot_y_4 * dot_y_4)
                                                                                                                    .mul_add(
                                                                                                                        m,
                                                                                                                        (dot_y_3 * dot_y_3)
                                                                                                                            .mul_add(
                                                                                                                                m,
                                                                                                                                (dot_y_2 * dot_y_2)
                                                                                                                                    .mul_add(
                                                                                                                                        m,
                                                                                                                                        (dot_y_1 * dot_y_1)
                                                                                                                                            .mul_add(
                                                                                                                                                m,
                                                                                                                                                (dot_y_0 * dot_y_0)
                                                                                                                                                    .mul_add(
                                                                                                                                                        m,
                                                                                                                                                        (dot_x_16 * dot_x_16)
                                                                                                                                                            .mul_add(
                                                                                                                                                                m,
                                                                                                                                                                (dot_x_15 * dot_x_15)
                                                                                                                                                                    .mul_add(
                                                                                                                                                                        m,
                                                                                                                                                                        (dot_x_14 * dot_x_14)
                                                                                                                                                                            .mul_add(
                                                                                                                                                                                m,
                                                                                                                                                                                (dot_x_13 * dot_x_13)
                                                                                                                                                                                    .mul_add(
                                                                                                                                                                                        m,
                                                                                                                                                                                        (dot_x_12 * dot_x_12)
                                                                                                                                                                                            .mul_add(
                                                                                                                                                                                                m,
                                                                                                                                                                                                (dot_x_11 * dot_x_11)
                                                                                                                                                                                                    .mul_add(
                                                                                                                                                                                                        m,
                                                                                                                                                                                                        (dot_x_10 * dot_x_10)
                                                                                                                                                                                                            .mul_add(
                                                                                                                                                                                                                m,
                                                                                                                                                                                                                (dot_x_9 * dot_x_9)
                                                                                                                                                                                                                    .mul_add(
                                                                                                                                                                                                                        m,
                                                                                                                                                                                                                        (dot_x_8 * dot_x_8)
                                                                                                                                                                                                                            .mul_add(
                                                                                                                                                                                                                                m,
                                                                                                                                                                                                                                (dot_x_7 * dot_x_7)
                                                                                                                                                                                                                                    .mul_add(
                                                                                                                                                                                                                                        m,
                                                                                                                                                                                                                                        (dot_x_6 * dot_x_6)
                                                                                                                                                                                                                                            .mul_add(
                                                                                                                                                                                                                                                m,
                                                                                                                                                                                                                                                (dot_x_5 * dot_x_5)
                                                                                                                                                                                                                                                    .mul_add(
                                                                                                                                                                                                                                                        m,
                                                                                                                                                                                                                                                        (dot_x_4 * dot_x_4)
                                                                                                                                                                                                                                                            .mul_add(
                                                                                                                                                                                                                                                                m,
                                                                                                                                                                                                                                                                (dot_x_3 * dot_x_3)
                                                                                                                                                                                                                                                                    .mul_add(
                                                                                                                                                                                                                                                                        m,
                                                                                                                                                                                                                                                                        (dot_x_2 * dot_x_2)
                                                                                                                                                                                                                                                                            .mul_add(
                                                                                                                                                                                                                                                                                m,
                                                                                                                                                                                                                                                                                (dot_x_1 * dot_x_1).mul_add(m, dot_x_0 * dot_x_0 * m),
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
            let potential = y_16
                .neg_mul_add(
                    m_g,
                    y_15
                        .neg_mul_add(
                            m_g,
                            y_14
                                .neg_mul_add(
                                    m_g,
                                    y_13
                                        .neg_mul_add(
                                            m_g,
                                            y_12
                                                .neg_mul_add(
                                                    m_g,
                                                    y_11
                                                        .neg_mul_add(
                                                            m_g,
                                                            y_10
                                                                .neg_mul_add(
                                                                    m_g,
                                                                    y_9
                                                                        .neg_mul_add(
                                                                            m_g,
                                                                            y_8
                                                                                .neg_mul_add(
                                                                                    m_g,
                                                                                    y_7
                                                                                        .neg_mul_add(
                                                                                            m_g,
                                                                                            y_6
                                                                                                .neg_mul_add(
                                                                                                    m_g,
                                                                                                    y_5
                                                                                                        .neg_mul_add(
                                                                                                            m_g,
                                                                                                            y_4
                                                                                                                .neg_mul_add(
                                                                                                                    m_g,
                                                                                                                    y_3
                                                                                                                        .neg_mul_add(
                                                                                                                            m_g,
                                                                                                                            y_2.neg_mul_add(m_g, y_1.neg_mul_add(m_g, -(y_0 * m_g))),
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
            let outputs = ukcore::emitted::exact_mut::<S, 3>(outputs, "outputs");
            let [_, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, y_0, y_1, y_2, y_3,
            y_4, y_5, y_6, y_7, y_8, y_9, y_10, y_11, y_12, y_13, y_14, y_15, y_16] = *ukcore::emitted::exact::<
                S,
                34,
            >(q, "q");
            let [_, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, dot_y_0, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                34,
            >(v, "v");
            let lit = S::from_f64;
            outputs[0] = y_0;
            outputs[1] = dot_y_0;
            outputs[2] = lit(0.058823529411764705)
                * (y_0 + y_1 + y_2 + y_3 + y_4 + y_5 + y_6 + y_7 + y_8 + y_9 + y_10
                    + y_11 + y_12 + y_13 + y_14 + y_15 + y_16);
        }
        /// 229 additions, 309 multiplications, 17 divisions, 0 square roots, 0 transcendentals, 17 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 34>(out, "out");
            let [_, _, _, g, safe_x_0] = *ukcore::emitted::exact::<
                S,
                5,
            >(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, x_5, x_6, x_7, x_8, x_9, x_10, x_11, x_12,
            x_13, x_14, x_15, x_16, y_0, y_1, y_2, y_3, y_4, y_5, y_6, y_7, y_8, y_9,
            y_10, y_11, y_12, y_13, y_14, y_15, y_16] = *ukcore::emitted::exact::<
                S,
                34,
            >(q, "q");
            let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_x_5, dot_x_6, dot_x_7,
            dot_x_8, dot_x_9, dot_x_10, dot_x_11, dot_x_12, dot_x_13, dot_x_14, dot_x_15,
            dot_x_16, dot_y_0, dot_y_1, dot_y_2, dot_y_3, dot_y_4, dot_y_5, dot_y_6,
            dot_y_7, dot_y_8, dot_y_9, dot_y_10, dot_y_11, dot_y_12, dot_y_13, dot_y_14,
            dot_y_15, dot_y_16] = *ukcore::emitted::exact::<S, 34>(v, "v");
            let lit = S::from_f64;
            let x_1_minus_x_0 = x_1 - x_0;
            let y_0_minus_y_1 = y_0 - y_1;
            let pivot_link_0 = lit(2.0)
                * y_0_minus_y_1.mul_add(y_0_minus_y_1, x_1_minus_x_0 * x_1_minus_x_0);
            let per_pivot_link_0 = pivot_link_0.recip();
            let safe_link_0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_link_0,
                safe_x_0,
                lit(0.0),
            );
            let dot_x_0_minus_dot_x_1 = dot_x_0 - dot_x_1;
            let dot_y_0_minus_dot_y_1 = dot_y_0 - dot_y_1;
            let right_link_0 = dot_y_0_minus_dot_y_1
                .mul_add(
                    dot_y_0_minus_dot_y_1,
                    dot_x_0_minus_dot_x_1 * dot_x_0_minus_dot_x_1,
                );
            let pivot_support = y_16.mul_add(y_16, x_16 * x_16);
            let per_pivot_support = pivot_support.recip();
            let safe_support = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_support,
                safe_link_0,
                lit(0.0),
            );
            let right_support = y_16 * g
                + dot_y_16.mul_add(dot_y_16, dot_x_16 * dot_x_16);
            let x_1_minus_x_2 = x_1 - x_2;
            let y_1_minus_y_2 = y_1 - y_2;
            let link_1_with_link_0 = y_0_minus_y_1
                .neg_mul_add(y_1_minus_y_2, x_1_minus_x_0 * x_1_minus_x_2);
            let acceleration_0_part = lit(2.0)
                * y_1_minus_y_2.mul_add(y_1_minus_y_2, x_1_minus_x_2 * x_1_minus_x_2);
            let diagonal_link_1 = pivot_link_0 * acceleration_0_part;
            let pivot_link_1 = link_1_with_link_0 * link_1_with_link_0 - diagonal_link_1;
            let per_pivot_link_1 = pivot_link_1.recip();
            let safe_link_1 = S::select_le(
                lit(0.0009765625) * diagonal_link_1,
                -pivot_link_1,
                safe_support,
                lit(0.0),
            );
            let dot_x_1_minus_dot_x_2 = dot_x_1 - dot_x_2;
            let dot_y_1_minus_dot_y_2 = dot_y_1 - dot_y_2;
            let right_link_1 = dot_y_1_minus_dot_y_2
                .mul_add(
                    dot_y_1_minus_dot_y_2,
                    dot_x_1_minus_dot_x_2 * dot_x_1_minus_dot_x_2,
                )
                .neg_mul_add(pivot_link_0, right_link_0 * link_1_with_link_0);
            let x_15_minus_x_16 = x_15 - x_16;
            let y_15_minus_y_16 = y_15 - y_16;
            let link_15_with_support = y_16
                .mul_add(y_15_minus_y_16, x_16 * x_15_minus_x_16);
            let acceleration_0_part_2 = lit(2.0)
                * y_15_minus_y_16
                    .mul_add(y_15_minus_y_16, x_15_minus_x_16 * x_15_minus_x_16);
            let diagonal_link_15 = pivot_support * acceleration_0_part_2;
            let pivot_link_15 = link_15_with_support * link_15_with_support
                - diagonal_link_15;
            let per_pivot_link_15 = pivot_link_15.recip();
            let safe_link_15 = S::select_le(
                lit(0.0009765625) * diagonal_link_15,
                -pivot_link_15,
                safe_link_1,
                lit(0.0),
            );
            let dot_x_15_minus_dot_x_16 = dot_x_15 - dot_x_16;
            let dot_y_15_minus_dot_y_16 = dot_y_15 - dot_y_16;
            let right_link_15 = link_15_with_support
                .mul_add(
                    right_support,
                    pivot_support
                        * dot_y_15_minus_dot_y_16
                            .mul_add(
                                dot_y_15_minus_dot_y_16,
                                dot_x_15_minus_dot_x_16 * dot_x_15_minus_dot_x_16,
                            ),
                );
            let x_2_minus_x_3 = x_2 - x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            let link_2_with_link_1 = y_1_minus_y_2
                .mul_add(y_2_minus_y_3, x_1_minus_x_2 * x_2_minus_x_3);
            let acceleration_0_part_3 = lit(2.0)
                * y_2_minus_y_3.mul_add(y_2_minus_y_3, x_2_minus_x_3 * x_2_minus_x_3);
            let diagonal_link_2 = acceleration_0_part_3 * pivot_link_1;
            let pivot_link_2 = link_2_with_link_1 * link_2_with_link_1 * pivot_link_0
                + diagonal_link_2;
            let per_pivot_link_2 = pivot_link_2.recip();
            let safe_link_2 = S::select_le(
                lit(-0.0009765625) * diagonal_link_2,
                -pivot_link_2,
                safe_link_15,
                lit(0.0),
            );
            let dot_x_2_minus_dot_x_3 = dot_x_2 - dot_x_3;
            let dot_y_2_minus_dot_y_3 = dot_y_2 - dot_y_3;
            let right_link_2 = dot_y_2_minus_dot_y_3
                .mul_add(
                    dot_y_2_minus_dot_y_3,
                    dot_x_2_minus_dot_x_3 * dot_x_2_minus_dot_x_3,
                )
                .mul_add(pivot_link_1, link_2_with_link_1 * right_link_1);
            let x_14_minus_x_15 = x_14 - x_15;
            let y_14_minus_y_15 = y_14 - y_15;
            let link_14_with_link_15 = y_14_minus_y_15
                .mul_add(y_15_minus_y_16, x_14_minus_x_15 * x_15_minus_x_16);
            let acceleration_0_part_4 = lit(2.0)
                * y_14_minus_y_15
                    .mul_add(y_14_minus_y_15, x_14_minus_x_15 * x_14_minus_x_15);
            let diagonal_link_14 = acceleration_0_part_4 * pivot_link_15;
            let pivot_link_14 = pivot_support * link_14_with_link_15
                * link_14_with_link_15 + diagonal_link_14;
            let per_pivot_link_14 = pivot_link_14.recip();
            let safe_link_14 = S::select_le(
                lit(-0.0009765625) * diagonal_link_14,
                -pivot_link_14,
                safe_link_2,
                lit(0.0),
            );
            let dot_x_14_minus_dot_x_15 = dot_x_14 - dot_x_15;
            let dot_y_14_minus_dot_y_15 = dot_y_14 - dot_y_15;
            let right_link_14 = link_14_with_link_15
                .neg_mul_add(
                    right_link_15,
                    dot_y_14_minus_dot_y_15
                        .mul_add(
                            dot_y_14_minus_dot_y_15,
                            dot_x_14_minus_dot_x_15 * dot_x_14_minus_dot_x_15,
                        ) * pivot_link_15,
                );
            let x_3_minus_x_4 = x_3 - x_4;
            let y_3_minus_y_4 = y_3 - y_4;
            let link_3_with_link_2 = y_2_minus_y_3
                .mul_add(y_3_minus_y_4, x_2_minus_x_3 * x_3_minus_x_4);
            let acceleration_0_part_5 = lit(2.0)
                * y_3_minus_y_4.mul_add(y_3_minus_y_4, x_3_minus_x_4 * x_3_minus_x_4);
            let diagonal_link_3 = acceleration_0_part_5 * pivot_link_2;
            let pivot_link_3 = link_3_with_link_2 * link_3_with_link_2 * pivot_link_1
                - diagonal_link_3;
            let per_pivot_link_3 = pivot_link_3.recip();
            let safe_link_3 = S::select_le(
                lit(-0.0009765625) * diagonal_link_3,
                pivot_link_3,
                safe_link_14,
                lit(0.0),
            );
            let dot_x_3_minus_dot_x_4 = dot_x_3 - dot_x_4;
            let dot_y_3_minus_dot_y_4 = dot_y_3 - dot_y_4;
            let right_link_3 = dot_y_3_minus_dot_y_4
                .mul_add(
                    dot_y_3_minus_dot_y_4,
                    dot_x_3_minus_dot_x_4 * dot_x_3_minus_dot_x_4,
                )
                .mul_add(pivot_link_2, link_3_with_link_2 * right_link_2);
            let x_13_minus_x_14 = x_13 - x_14;
            let y_13_minus_y_14 = y_13 - y_14;
            let link_13_with_link_14 = y_13_minus_y_14
                .mul_add(y_14_minus_y_15, x_13_minus_x_14 * x_14_minus_x_15);
            let acceleration_0_part_6 = lit(2.0)
                * y_13_minus_y_14
                    .mul_add(y_13_minus_y_14, x_13_minus_x_14 * x_13_minus_x_14);
            let diagonal_link_13 = acceleration_0_part_6 * pivot_link_14;
            let pivot_link_13 = link_13_with_link_14 * link_13_with_link_14
                * pivot_link_15 - diagonal_link_13;
            let per_pivot_link_13 = pivot_link_13.recip();
            let safe_link_13 = S::select_le(
                lit(-0.0009765625) * diagonal_link_13,
                pivot_link_13,
                safe_link_3,
                lit(0.0),
            );
            let dot_x_13_minus_dot_x_14 = dot_x_13 - dot_x_14;
            let dot_y_13_minus_dot_y_14 = dot_y_13 - dot_y_14;
            let right_link_13 = link_13_with_link_14
                .mul_add(
                    right_link_14,
                    dot_y_13_minus_dot_y_14
                        .mul_add(
                            dot_y_13_minus_dot_y_14,
                            dot_x_13_minus_dot_x_14 * dot_x_13_minus_dot_x_14,
                        ) * pivot_link_14,
                );
            let x_4_minus_x_5 = x_4 - x_5;
            let y_4_minus_y_5 = y_4 - y_5;
            let link_4_with_link_3 = y_3_minus_y_4
                .mul_add(y_4_minus_y_5, x_3_minus_x_4 * x_4_minus_x_5);
            let acceleration_0_part_7 = lit(2.0)
                * y_4_minus_y_5.mul_add(y_4_minus_y_5, x_4_minus_x_5 * x_4_minus_x_5);
            let diagonal_link_4 = acceleration_0_part_7 * pivot_link_3;
            let pivot_link_4 = link_4_with_link_3 * link_4_with_link_3 * pivot_link_2
                + diagonal_link_4;
            let per_pivot_link_4 = pivot_link_4.recip();
            let safe_link_4 = S::select_le(
                lit(0.0009765625) * diagonal_link_4,
                pivot_link_4,
                safe_link_13,
                lit(0.0),
            );
            let dot_x_4_minus_dot_x_5 = dot_x_4 - dot_x_5;
            let dot_y_4_minus_dot_y_5 = dot_y_4 - dot_y_5;
            let right_link_4 = dot_y_4_minus_dot_y_5
                .mul_add(
                    dot_y_4_minus_dot_y_5,
                    dot_x_4_minus_dot_x_5 * dot_x_4_minus_dot_x_5,
                )
                .neg_mul_add(pivot_link_3, link_4_with_link_3 * right_link_3);
            let x_12_minus_x_13 = x_12 - x_13;
            let y_12_minus_y_13 = y_12 - y_13;
            let link_12_with_link_13 = y_12_minus_y_13
                .mul_add(y_13_minus_y_14, x_12_minus_x_13 * x_13_minus_x_14);
            let acceleration_0_part_8 = lit(2.0)
                * y_12_minus_y_13
                    .mul_add(y_12_minus_y_13, x_12_minus_x_13 * x_12_minus_x_13);
            let diagonal_link_12 = acceleration_0_part_8 * pivot_link_13;
            let pivot_link_12 = link_12_with_link_13 * link_12_with_link_13
                * pivot_link_14 + diagonal_link_12;
            let per_pivot_link_12 = pivot_link_12.recip();
            let safe_link_12 = S::select_le(
                lit(0.0009765625) * diagonal_link_12,
                pivot_link_12,
                safe_link_4,
                lit(0.0),
            );
            let dot_x_12_minus_dot_x_13 = dot_x_12 - dot_x_13;
            let dot_y_12_minus_dot_y_13 = dot_y_12 - dot_y_13;
            let right_link_12 = link_12_with_link_13
                .neg_mul_add(
                    right_link_13,
                    dot_y_12_minus_dot_y_13
                        .mul_add(
                            dot_y_12_minus_dot_y_13,
                            dot_x_12_minus_dot_x_13 * dot_x_12_minus_dot_x_13,
                        ) * pivot_link_13,
                );
            let x_5_minus_x_6 = x_5 - x_6;
            let y_5_minus_y_6 = y_5 - y_6;
            let link_5_with_link_4 = y_4_minus_y_5
                .mul_add(y_5_minus_y_6, x_4_minus_x_5 * x_5_minus_x_6);
            let acceleration_0_part_9 = lit(2.0)
                * y_5_minus_y_6.mul_add(y_5_minus_y_6, x_5_minus_x_6 * x_5_minus_x_6);
            let diagonal_link_5 = acceleration_0_part_9 * pivot_link_4;
            let pivot_link_5 = link_5_with_link_4 * link_5_with_link_4 * pivot_link_3
                - diagonal_link_5;
            let per_pivot_link_5 = pivot_link_5.recip();
            let safe_link_5 = S::select_le(
                lit(0.0009765625) * diagonal_link_5,
                -pivot_link_5,
                safe_link_12,
                lit(0.0),
            );
            let dot_x_5_minus_dot_x_6 = dot_x_5 - dot_x_6;
            let dot_y_5_minus_dot_y_6 = dot_y_5 - dot_y_6;
            let right_link_5 = dot_y_5_minus_dot_y_6
                .mul_add(
                    dot_y_5_minus_dot_y_6,
                    dot_x_5_minus_dot_x_6 * dot_x_5_minus_dot_x_6,
                )
                .neg_mul_add(pivot_link_4, link_5_with_link_4 * right_link_4);
            let x_11_minus_x_12 = x_11 - x_12;
            let y_11_minus_y_12 = y_11 - y_12;
            let link_11_with_link_12 = y_11_minus_y_12
                .mul_add(y_12_minus_y_13, x_11_minus_x_12 * x_12_minus_x_13);
            let acceleration_0_part_10 = lit(2.0)
                * y_11_minus_y_12
                    .mul_add(y_11_minus_y_12, x_11_minus_x_12 * x_11_minus_x_12);
            let diagonal_link_11 = acceleration_0_part_10 * pivot_link_12;
            let pivot_link_11 = link_11_with_link_12 * link_11_with_link_12
                * pivot_link_13 - diagonal_link_11;
            let per_pivot_link_11 = pivot_link_11.recip();
            let safe_link_11 = S::select_le(
                lit(0.0009765625) * diagonal_link_11,
                -pivot_link_11,
                safe_link_5,
                lit(0.0),
            );
            let dot_x_11_minus_dot_x_12 = dot_x_11 - dot_x_12;
            let dot_y_11_minus_dot_y_12 = dot_y_11 - dot_y_12;
            let right_link_11 = link_11_with_link_12
                .mul_add(
                    right_link_12,
                    dot_y_11_minus_dot_y_12
                        .mul_add(
                            dot_y_11_minus_dot_y_12,
                            dot_x_11_minus_dot_x_12 * dot_x_11_minus_dot_x_12,
                        ) * pivot_link_12,
                );
            let x_6_minus_x_7 = x_6 - x_7;
            let y_6_minus_y_7 = y_6 - y_7;
            let link_6_with_link_5 = y_5_minus_y_6
                .mul_add(y_6_minus_y_7, x_5_minus_x_6 * x_6_minus_x_7);
            let acceleration_0_part_11 = lit(2.0)
                * y_6_minus_y_7.mul_add(y_6_minus_y_7, x_6_minus_x_7 * x_6_minus_x_7);
            let diagonal_link_6 = acceleration_0_part_11 * pivot_link_5;
            let pivot_link_6 = link_6_with_link_5 * link_6_with_link_5 * pivot_link_4
                + diagonal_link_6;
            let per_pivot_link_6 = pivot_link_6.recip();
            let safe_link_6 = S::select_le(
                lit(-0.0009765625) * diagonal_link_6,
                -pivot_link_6,
                safe_link_11,
                lit(0.0),
            );
            let dot_x_6_minus_dot_x_7 = dot_x_6 - dot_x_7;
            let dot_y_6_minus_dot_y_7 = dot_y_6 - dot_y_7;
            let right_link_6 = dot_y_6_minus_dot_y_7
                .mul_add(
                    dot_y_6_minus_dot_y_7,
                    dot_x_6_minus_dot_x_7 * dot_x_6_minus_dot_x_7,
                )
                .mul_add(pivot_link_5, link_6_with_link_5 * right_link_5);
            let x_10_minus_x_11 = x_10 - x_11;
            let y_10_minus_y_11 = y_10 - y_11;
            let link_10_with_link_11 = y_10_minus_y_11
                .mul_add(y_11_minus_y_12, x_10_minus_x_11 * x_11_minus_x_12);
            let acceleration_0_part_12 = lit(2.0)
                * y_10_minus_y_11
                    .mul_add(y_10_minus_y_11, x_10_minus_x_11 * x_10_minus_x_11);
            let diagonal_link_10 = acceleration_0_part_12 * pivot_link_11;
            let pivot_link_10 = link_10_with_link_11 * link_10_with_link_11
                * pivot_link_12 + diagonal_link_10;
            let per_pivot_link_10 = pivot_link_10.recip();
            let safe_link_10 = S::select_le(
                lit(-0.0009765625) * diagonal_link_10,
                -pivot_link_10,
                safe_link_6,
                lit(0.0),
            );
            let dot_x_10_minus_dot_x_11 = dot_x_10 - dot_x_11;
            let dot_y_10_minus_dot_y_11 = dot_y_10 - dot_y_11;
            let right_link_10 = link_10_with_link_11
                .neg_mul_add(
                    right_link_11,
                    dot_y_10_minus_dot_y_11
                        .mul_add(
                            dot_y_10_minus_dot_y_11,
                            dot_x_10_minus_dot_x_11 * dot_x_10_minus_dot_x_11,
                        ) * pivot_link_11,
                );
            let x_7_minus_x_8 = x_7 - x_8;
            let y_7_minus_y_8 = y_7 - y_8;
            let link_7_with_link_6 = y_6_minus_y_7
                .mul_add(y_7_minus_y_8, x_6_minus_x_7 * x_7_minus_x_8);
            let acceleration_0_part_13 = lit(2.0)
                * y_7_minus_y_8.mul_add(y_7_minus_y_8, x_7_minus_x_8 * x_7_minus_x_8);
            let diagonal_link_7 = acceleration_0_part_13 * pivot_link_6;
            let pivot_link_7 = link_7_with_link_6 * link_7_with_link_6 * pivot_link_5
                - diagonal_link_7;
            let per_pivot_link_7 = pivot_link_7.recip();
            let safe_link_7 = S::select_le(
                lit(-0.0009765625) * diagonal_link_7,
                pivot_link_7,
                safe_link_10,
                lit(0.0),
            );
            let dot_x_7_minus_dot_x_8 = dot_x_7 - dot_x_8;
            let dot_y_7_minus_dot_y_8 = dot_y_7 - dot_y_8;
            let right_link_7 = dot_y_7_minus_dot_y_8
                .mul_add(
                    dot_y_7_minus_dot_y_8,
                    dot_x_7_minus_dot_x_8 * dot_x_7_minus_dot_x_8,
                )
                .mul_add(pivot_link_6, link_7_with_link_6 * right_link_6);
            let x_9_minus_x_10 = x_9 - x_10;
            let y_9_minus_y_10 = y_9 - y_10;
            let link_9_with_link_10 = y_9_minus_y_10
                .mul_add(y_10_minus_y_11, x_9_minus_x_10 * x_10_minus_x_11);
            let acceleration_0_part_14 = lit(2.0)
                * y_9_minus_y_10
                    .mul_add(y_9_minus_y_10, x_9_minus_x_10 * x_9_minus_x_10);
            let diagonal_link_9 = acceleration_0_part_14 * pivot_link_10;
            let pivot_link_9 = link_9_with_link_10 * link_9_with_link_10 * pivot_link_11
                - diagonal_link_9;
            let per_pivot_link_9 = pivot_link_9.recip();
            let safe_link_9 = S::select_le(
                lit(-0.0009765625) * diagonal_link_9,
                pivot_link_9,
                safe_link_7,
                lit(0.0),
            );
            let dot_x_9_minus_dot_x_10 = dot_x_9 - dot_x_10;
            let dot_y_9_minus_dot_y_10 = dot_y_9 - dot_y_10;
            let right_link_9 = link_9_with_link_10
                .mul_add(
                    right_link_10,
                    dot_y_9_minus_dot_y_10
                        .mul_add(
                            dot_y_9_minus_dot_y_10,
                            dot_x_9_minus_dot_x_10 * dot_x_9_minus_dot_x_10,
                        ) * pivot_link_10,
                );
            let x_8_minus_x_9 = x_8 - x_9;
            let y_8_minus_y_9 = y_8 - y_9;
            let link_8_with_link_9 = y_8_minus_y_9
                .mul_add(y_9_minus_y_10, x_8_minus_x_9 * x_9_minus_x_10);
            let link_8_with_link_7 = y_7_minus_y_8
                .mul_add(y_8_minus_y_9, x_7_minus_x_8 * x_8_minus_x_9);
            let link_8_by_link_7 = link_8_with_link_7 * pivot_link_6 * per_pivot_link_7;
            let acceleration_0_part_15 = lit(2.0)
                * y_8_minus_y_9.mul_add(y_8_minus_y_9, x_8_minus_x_9 * x_8_minus_x_9);
            let pivot_link_8 = pivot_link_9
                .mul_add(
                    link_8_with_link_7.mul_add(link_8_by_link_7, acceleration_0_part_15),
                    link_8_with_link_9 * link_8_with_link_9 * pivot_link_10,
                );
            let per_pivot_link_8 = pivot_link_8.recip();
            let diagonal_link_8 = acceleration_0_part_15 * pivot_link_9;
            let safe_link_8 = S::select_le(
                lit(0.0009765625) * diagonal_link_8,
                pivot_link_8,
                safe_link_9,
                lit(0.0),
            );
            let dot_x_8_minus_dot_x_9 = dot_x_8 - dot_x_9;
            let dot_y_8_minus_dot_y_9 = dot_y_8 - dot_y_9;
            let right_link_8 = link_8_with_link_9
                .neg_mul_add(
                    right_link_9,
                    pivot_link_9
                        * (link_8_with_link_7 * right_link_7)
                            .neg_mul_add(
                                per_pivot_link_7,
                                dot_y_8_minus_dot_y_9
                                    .mul_add(
                                        dot_y_8_minus_dot_y_9,
                                        dot_x_8_minus_dot_x_9 * dot_x_8_minus_dot_x_9,
                                    ),
                            ),
                );
            let safe = safe_link_8;
            let lambda_link_9 = (link_8_with_link_9 * pivot_link_10 * per_pivot_link_9
                * right_link_8)
                .mul_add(per_pivot_link_8, right_link_9 * per_pivot_link_9);
            let x_9_minus_x_10_lambda_link_9 = x_9_minus_x_10 * lambda_link_9;
            let safe_part = x_8_minus_x_9 * right_link_8 * per_pivot_link_8;
            out[9] = safe_part + x_9_minus_x_10_lambda_link_9;
            let acceleration_10_part = y_8_minus_y_9 * right_link_8 * per_pivot_link_8;
            let lambda_link_7 = (link_8_by_link_7 * right_link_8)
                .mul_add(per_pivot_link_8, right_link_7 * per_pivot_link_7);
            let y_7_minus_y_8_lambda_link_7 = y_7_minus_y_8 * lambda_link_7;
            out[25] = g - acceleration_10_part - y_7_minus_y_8_lambda_link_7;
            let y_9_minus_y_10_lambda_link_9 = y_9_minus_y_10 * lambda_link_9;
            out[26] = g + acceleration_10_part + y_9_minus_y_10_lambda_link_9;
            let x_7_minus_x_8_lambda_link_7 = x_7_minus_x_8 * lambda_link_7;
            out[8] = -safe_part - x_7_minus_x_8_lambda_link_7;
            let lambda_link_6 = (link_7_with_link_6 * pivot_link_5 * per_pivot_link_6)
                .neg_mul_add(lambda_link_7, right_link_6 * per_pivot_link_6);
            let x_6_minus_x_7_lambda_link_6 = x_6_minus_x_7 * lambda_link_6;
            out[7] = x_7_minus_x_8_lambda_link_7 + x_6_minus_x_7_lambda_link_6;
            let y_6_minus_y_7_lambda_link_6 = y_6_minus_y_7 * lambda_link_6;
            out[24] = g + y_7_minus_y_8_lambda_link_7 + y_6_minus_y_7_lambda_link_6;
            let lambda_link_10 = (link_9_with_link_10 * pivot_link_11
                * per_pivot_link_10)
                .neg_mul_add(lambda_link_9, right_link_10 * per_pivot_link_10);
            let y_10_minus_y_11_lambda_link_10 = y_10_minus_y_11 * lambda_link_10;
            out[27] = g - y_9_minus_y_10_lambda_link_9 - y_10_minus_y_11_lambda_link_10;
            let x_10_minus_x_11_lambda_link_10 = x_10_minus_x_11 * lambda_link_10;
            out[10] = -x_9_minus_x_10_lambda_link_9 - x_10_minus_x_11_lambda_link_10;
            let lambda_link_11 = (link_10_with_link_11 * pivot_link_12
                * per_pivot_link_11)
                .mul_add(lambda_link_10, right_link_11 * per_pivot_link_11);
            let x_11_minus_x_12_lambda_link_11 = x_11_minus_x_12 * lambda_link_11;
            out[11] = x_10_minus_x_11_lambda_link_10 + x_11_minus_x_12_lambda_link_11;
            let lambda_link_5 = (link_6_with_link_5 * pivot_link_4 * per_pivot_link_5)
                .neg_mul_add(lambda_link_6, right_link_5 * per_pivot_link_5);
            let y_5_minus_y_6_lambda_link_5 = y_5_minus_y_6 * lambda_link_5;
            out[23] = g - y_6_minus_y_7_lambda_link_6 + y_5_minus_y_6_lambda_link_5;
            let y_11_minus_y_12_lambda_link_11 = y_11_minus_y_12 * lambda_link_11;
            out[28] = g + y_10_minus_y_11_lambda_link_10
                + y_11_minus_y_12_lambda_link_11;
            let x_5_minus_x_6_lambda_link_5 = x_5_minus_x_6 * lambda_link_5;
            out[6] = x_5_minus_x_6_lambda_link_5 - x_6_minus_x_7_lambda_link_6;
            let lambda_link_4 = (link_5_with_link_4 * pivot_link_3 * per_pivot_link_4)
                .neg_mul_add(lambda_link_5, right_link_4 * per_pivot_link_4);
            let y_4_minus_y_5_lambda_link_4 = y_4_minus_y_5 * lambda_link_4;
            out[22] = g - y_5_minus_y_6_lambda_link_5 - y_4_minus_y_5_lambda_link_4;
            let lambda_link_12 = (link_11_with_link_12 * pivot_link_13
                * per_pivot_link_12)
                .neg_mul_add(lambda_link_11, right_link_12 * per_pivot_link_12);
            let y_12_minus_y_13_lambda_link_12 = y_12_minus_y_13 * lambda_link_12;
            out[29] = g - y_11_minus_y_12_lambda_link_11
                - y_12_minus_y_13_lambda_link_12;
            let x_4_minus_x_5_lambda_link_4 = x_4_minus_x_5 * lambda_link_4;
            out[5] = -x_5_minus_x_6_lambda_link_5 - x_4_minus_x_5_lambda_link_4;
            let x_12_minus_x_13_lambda_link_12 = x_12_minus_x_13 * lambda_link_12;
            out[12] = -x_11_minus_x_12_lambda_link_11 - x_12_minus_x_13_lambda_link_12;
            let lambda_link_3 = (link_4_with_link_3 * pivot_link_2 * per_pivot_link_3)
                .neg_mul_add(lambda_link_4, right_link_3 * per_pivot_link_3);
            let x_3_minus_x_4_lambda_link_3 = x_3_minus_x_4 * lambda_link_3;
            out[4] = x_4_minus_x_5_lambda_link_4 - x_3_minus_x_4_lambda_link_3;
            let lambda_link_13 = (link_12_with_link_13 * pivot_link_14
                * per_pivot_link_13)
                .mul_add(lambda_link_12, right_link_13 * per_pivot_link_13);
            let x_13_minus_x_14_lambda_link_13 = x_13_minus_x_14 * lambda_link_13;
            out[13] = x_12_minus_x_13_lambda_link_12 + x_13_minus_x_14_lambda_link_13;
            let y_3_minus_y_4_lambda_link_3 = y_3_minus_y_4 * lambda_link_3;
            out[21] = g + y_4_minus_y_5_lambda_link_4 - y_3_minus_y_4_lambda_link_3;
            let y_13_minus_y_14_lambda_link_13 = y_13_minus_y_14 * lambda_link_13;
            out[30] = g + y_12_minus_y_13_lambda_link_12
                + y_13_minus_y_14_lambda_link_13;
            let lambda_link_2 = (link_3_with_link_2 * pivot_link_1 * per_pivot_link_2)
                .neg_mul_add(lambda_link_3, right_link_2 * per_pivot_link_2);
            let x_2_minus_x_3_lambda_link_2 = x_2_minus_x_3 * lambda_link_2;
            out[3] = x_3_minus_x_4_lambda_link_3 + x_2_minus_x_3_lambda_link_2;
            let y_2_minus_y_3_lambda_link_2 = y_2_minus_y_3 * lambda_link_2;
            out[20] = g + y_3_minus_y_4_lambda_link_3 + y_2_minus_y_3_lambda_link_2;
            let lambda_link_14 = (link_13_with_link_14 * pivot_link_15
                * per_pivot_link_14)
                .neg_mul_add(lambda_link_13, right_link_14 * per_pivot_link_14);
            let y_14_minus_y_15_lambda_link_14 = y_14_minus_y_15 * lambda_link_14;
            out[31] = g - y_13_minus_y_14_lambda_link_13
                - y_14_minus_y_15_lambda_link_14;
            let x_14_minus_x_15_lambda_link_14 = x_14_minus_x_15 * lambda_link_14;
            out[14] = -x_13_minus_x_14_lambda_link_13 - x_14_minus_x_15_lambda_link_14;
            let lambda_link_15 = (pivot_support * link_14_with_link_15
                * per_pivot_link_15)
                .mul_add(lambda_link_14, right_link_15 * per_pivot_link_15);
            let x_15_minus_x_16_lambda_link_15 = x_15_minus_x_16 * lambda_link_15;
            out[15] = x_14_minus_x_15_lambda_link_14 + x_15_minus_x_16_lambda_link_15;
            let lambda_link_1 = (link_2_with_link_1 * pivot_link_0 * per_pivot_link_1)
                .neg_mul_add(lambda_link_2, right_link_1 * per_pivot_link_1);
            let y_1_minus_y_2_lambda_link_1 = y_1_minus_y_2 * lambda_link_1;
            out[19] = g - y_2_minus_y_3_lambda_link_2 + y_1_minus_y_2_lambda_link_1;
            let y_15_minus_y_16_lambda_link_15 = y_15_minus_y_16 * lambda_link_15;
            out[32] = g + y_14_minus_y_15_lambda_link_14
                + y_15_minus_y_16_lambda_link_15;
            let x_1_minus_x_2_lambda_link_1 = x_1_minus_x_2 * lambda_link_1;
            out[2] = x_1_minus_x_2_lambda_link_1 - x_2_minus_x_3_lambda_link_2;
            let lambda_link_0 = (link_1_with_link_0 * per_pivot_link_0)
                .neg_mul_add(lambda_link_1, right_link_0 * per_pivot_link_0);
            let x_1_minus_x_0_lambda_link_0 = x_1_minus_x_0 * lambda_link_0;
            out[0] = x_1_minus_x_0_lambda_link_0;
            let y_0_minus_y_1_lambda_link_0 = y_0_minus_y_1 * lambda_link_0;
            out[17] = g - y_0_minus_y_1_lambda_link_0;
            out[18] = g - y_1_minus_y_2_lambda_link_1 + y_0_minus_y_1_lambda_link_0;
            let lambda_support = (link_15_with_support * per_pivot_support)
                .neg_mul_add(lambda_link_15, right_support * per_pivot_support);
            out[33] = y_16
                .neg_mul_add(lambda_support, g - y_15_minus_y_16_lambda_link_15);
            out[1] = -x_1_minus_x_2_lambda_link_1 - x_1_minus_x_0_lambda_link_0;
            out[16] = x_16.neg_mul_add(lambda_support, -x_15_minus_x_16_lambda_link_15);
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
            let out = ukcore::emitted::exact_mut::<S, 34>(out, "out");
            let [_, _, _, _, safe_x_0] = *ukcore::emitted::exact::<
                S,
                5,
            >(prepared, "prepared");
            let [x_0, x_1, x_2, x_3, x_4, x_5, x_6, x_7, x_8, x_9, x_10, x_11, x_12,
            x_13, x_14, x_15, x_16, y_0, y_1, y_2, y_3, y_4, y_5, y_6, y_7, y_8, y_9,
            y_10, y_11, y_12, y_13, y_14, y_15, y_16] = *ukcore::emitted::exact::<
                S,
                34,
            >(q, "q");
            let [residual_0, residual_1, residual_2, residual_3, residual_4, residual_5,
            residual_6, residual_7, residual_8, residual_9, residual_10, residual_11,
            residual_12, residual_13, residual_14, residual_15, residual_16] = *ukcore::emitted::exact::<
                S,
                17,
            >(residual, "residual");
            let lit = S::from_f64;
            let x_1_minus_x_0 = x_1 - x_0;
            let y_0_minus_y_1 = y_0 - y_1;
            let pivot_link_0 = lit(2.0)
                * y_0_minus_y_1.mul_add(y_0_minus_y_1, x_1_minus_x_0 * x_1_minus_x_0);
            let per_pivot_link_0 = pivot_link_0.recip();
            let safe_link_0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_link_0,
                safe_x_0,
                lit(0.0),
            );
            let pivot_support = y_16.mul_add(y_16, x_16 * x_16);
            let per_pivot_support = pivot_support.recip();
            let safe_support = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_support,
                safe_link_0,
                lit(0.0),
            );
            let x_1_minus_x_2 = x_1 - x_2;
            let y_1_minus_y_2 = y_1 - y_2;
            let link_1_with_link_0 = y_0_minus_y_1
                .neg_mul_add(y_1_minus_y_2, x_1_minus_x_0 * x_1_minus_x_2);
            let correction_0_part = lit(2.0)
                * y_1_minus_y_2.mul_add(y_1_minus_y_2, x_1_minus_x_2 * x_1_minus_x_2);
            let diagonal_link_1 = pivot_link_0 * correction_0_part;
            let pivot_link_1 = link_1_with_link_0 * link_1_with_link_0 - diagonal_link_1;
            let per_pivot_link_1 = pivot_link_1.recip();
            let safe_link_1 = S::select_le(
                lit(0.0009765625) * diagonal_link_1,
                -pivot_link_1,
                safe_support,
                lit(0.0),
            );
            let x_15_minus_x_16 = x_15 - x_16;
            let y_15_minus_y_16 = y_15 - y_16;
            let link_15_with_support = y_16
                .mul_add(y_15_minus_y_16, x_16 * x_15_minus_x_16);
            let correction_0_part_2 = lit(2.0)
                * y_15_minus_y_16
                    .mul_add(y_15_minus_y_16, x_15_minus_x_16 * x_15_minus_x_16);
            let diagonal_link_15 = pivot_support * correction_0_part_2;
            let pivot_link_15 = link_15_with_support * link_15_with_support
                - diagonal_link_15;
            let per_pivot_link_15 = pivot_link_15.recip();
            let safe_link_15 = S::select_le(
                lit(0.0009765625) * diagonal_link_15,
                -pivot_link_15,
                safe_link_1,
                lit(0.0),
            );
            let x_2_minus_x_3 = x_2 - x_3;
            let y_2_minus_y_3 = y_2 - y_3;
            let link_2_with_link_1 = y_1_minus_y_2
                .mul_add(y_2_minus_y_3, x_1_minus_x_2 * x_2_minus_x_3);
            let correction_0_part_3 = lit(2.0)
                * y_2_minus_y_3.mul_add(y_2_minus_y_3, x_2_minus_x_3 * x_2_minus_x_3);
            let diagonal_link_2 = correction_0_part_3 * pivot_link_1;
            let pivot_link_2 = link_2_with_link_1 * link_2_with_link_1 * pivot_link_0
                + diagonal_link_2;
            let per_pivot_link_2 = pivot_link_2.recip();
            let safe_link_2 = S::select_le(
                lit(-0.0009765625) * diagonal_link_2,
                -pivot_link_2,
                safe_link_15,
                lit(0.0),
            );
            let x_14_minus_x_15 = x_14 - x_15;
            let y_14_minus_y_15 = y_14 - y_15;
            let link_14_with_link_15 = y_14_minus_y_15
                .mul_add(y_15_minus_y_16, x_14_minus_x_15 * x_15_minus_x_16);
            let correction_0_part_4 = lit(2.0)
                * y_14_minus_y_15
                    .mul_add(y_14_minus_y_15, x_14_minus_x_15 * x_14_minus_x_15);
            let diagonal_link_14 = correction_0_part_4 * pivot_link_15;
            let pivot_link_14 = pivot_support * link_14_with_link_15
                * link_14_with_link_15 + diagonal_link_14;
            let per_pivot_link_14 = pivot_link_14.recip();
            let safe_link_14 = S::select_le(
                lit(-0.0009765625) * diagonal_link_14,
                -pivot_link_14,
                safe_link_2,
                lit(0.0),
            );
            let x_3_minus_x_4 = x_3 - x_4;
            let y_3_minus_y_4 = y_3 - y_4;
            let link_3_with_link_2 = y_2_minus_y_3
                .mul_add(y_3_minus_y_4, x_2_minus_x_3 * x_3_minus_x_4);
            let correction_0_part_5 = lit(2.0)
                * y_3_minus_y_4.mul_add(y_3_minus_y_4, x_3_minus_x_4 * x_3_minus_x_4);
            let diagonal_link_3 = correction_0_part_5 * pivot_link_2;
            let pivot_link_3 = link_3_with_link_2 * link_3_with_link_2 * pivot_link_1
                - diagonal_link_3;
            let per_pivot_link_3 = pivot_link_3.recip();
            let safe_link_3 = S::select_le(
                lit(-0.0009765625) * diagonal_link_3,
                pivot_link_3,
                safe_link_14,
                lit(0.0),
            );
            let x_13_minus_x_14 = x_13 - x_14;
            let y_13_minus_y_14 = y_13 - y_14;
            let link_13_with_link_14 = y_13_minus_y_14
                .mul_add(y_14_minus_y_15, x_13_minus_x_14 * x_14_minus_x_15);
            let correction_0_part_6 = lit(2.0)
                * y_13_minus_y_14
                    .mul_add(y_13_minus_y_14, x_13_minus_x_14 * x_13_minus_x_14);
            let diagonal_link_13 = correction_0_part_6 * pivot_link_14;
            let pivot_link_13 = link_13_with_link_14 * link_13_with_link_14
                * pivot_link_15 - diagonal_link_13;
            let per_pivot_link_13 = pivot_link_13.recip();
            let safe_link_13 = S::select_le(
                lit(-0.0009765625) * diagonal_link_13,
                pivot_link_13,
                safe_link_3,
                lit(0.0),
            );
            let x_4_minus_x_5 = x_4 - x_5;
            let y_4_minus_y_5 = y_4 - y_5;
            let link_4_with_link_3 = y_3_minus_y_4
                .mul_add(y_4_minus_y_5, x_3_minus_x_4 * x_4_minus_x_5);
            let correction_0_part_7 = lit(2.0)
                * y_4_minus_y_5.mul_add(y_4_minus_y_5, x_4_minus_x_5 * x_4_minus_x_5);
            let diagonal_link_4 = correction_0_part_7 * pivot_link_3;
            let pivot_link_4 = link_4_with_link_3 * link_4_with_link_3 * pivot_link_2
                + diagonal_link_4;
            let per_pivot_link_4 = pivot_link_4.recip();
            let safe_link_4 = S::select_le(
                lit(0.0009765625) * diagonal_link_4,
                pivot_link_4,
                safe_link_13,
                lit(0.0),
            );
            let x_12_minus_x_13 = x_12 - x_13;
            let y_12_minus_y_13 = y_12 - y_13;
            let link_12_with_link_13 = y_12_minus_y_13
                .mul_add(y_13_minus_y_14, x_12_minus_x_13 * x_13_minus_x_14);
            let correction_0_part_8 = lit(2.0)
                * y_12_minus_y_13
                    .mul_add(y_12_minus_y_13, x_12_minus_x_13 * x_12_minus_x_13);
            let diagonal_link_12 = correction_0_part_8 * pivot_link_13;
            let pivot_link_12 = link_12_with_link_13 * link_12_with_link_13
                * pivot_link_14 + diagonal_link_12;
            let per_pivot_link_12 = pivot_link_12.recip();
            let safe_link_12 = S::select_le(
                lit(0.0009765625) * diagonal_link_12,
                pivot_link_12,
                safe_link_4,
                lit(0.0),
            );
            let x_5_minus_x_6 = x_5 - x_6;
            let y_5_minus_y_6 = y_5 - y_6;
            let link_5_with_link_4 = y_4_minus_y_5
                .mul_add(y_5_minus_y_6, x_4_minus_x_5 * x_5_minus_x_6);
            let correction_0_part_9 = lit(2.0)
                * y_5_minus_y_6.mul_add(y_5_minus_y_6, x_5_minus_x_6 * x_5_minus_x_6);
            let diagonal_link_5 = correction_0_part_9 * pivot_link_4;
            let pivot_link_5 = link_5_with_link_4 * link_5_with_link_4 * pivot_link_3
                - diagonal_link_5;
            let per_pivot_link_5 = pivot_link_5.recip();
            let safe_link_5 = S::select_le(
                lit(0.0009765625) * diagonal_link_5,
                -pivot_link_5,
                safe_link_12,
                lit(0.0),
            );
            let x_11_minus_x_12 = x_11 - x_12;
            let y_11_minus_y_12 = y_11 - y_12;
            let link_11_with_link_12 = y_11_minus_y_12
                .mul_add(y_12_minus_y_13, x_11_minus_x_12 * x_12_minus_x_13);
            let correction_0_part_10 = lit(2.0)
                * y_11_minus_y_12
                    .mul_add(y_11_minus_y_12, x_11_minus_x_12 * x_11_minus_x_12);
            let diagonal_link_11 = correction_0_part_10 * pivot_link_12;
            let pivot_link_11 = link_11_with_link_12 * link_11_with_link_12
                * pivot_link_13 - diagonal_link_11;
            let per_pivot_link_11 = pivot_link_11.recip();
            let safe_link_11 = S::select_le(
                lit(0.0009765625) * diagonal_link_11,
                -pivot_link_11,
                safe_link_5,
                lit(0.0),
            );
            let x_6_minus_x_7 = x_6 - x_7;
            let y_6_minus_y_7 = y_6 - y_7;
            let link_6_with_link_5 = y_5_minus_y_6
                .mul_add(y_6_minus_y_7, x_5_minus_x_6 * x_6_minus_x_7);
            let correction_0_part_11 = lit(2.0)
                * y_6_minus_y_7.mul_add(y_6_minus_y_7, x_6_minus_x_7 * x_6_minus_x_7);
            let diagonal_link_6 = correction_0_part_11 * pivot_link_5;
            let pivot_link_6 = link_6_with_link_5 * link_6_with_link_5 * pivot_link_4
                + diagonal_link_6;
            let per_pivot_link_6 = pivot_link_6.recip();
            let safe_link_6 = S::select_le(
                lit(-0.0009765625) * diagonal_link_6,
                -pivot_link_6,
                safe_link_11,
                lit(0.0),
            );
            let x_10_minus_x_11 = x_10 - x_11;
            let y_10_minus_y_11 = y_10 - y_11;
            let link_10_with_link_11 = y_10_minus_y_11
                .mul_add(y_11_minus_y_12, x_10_minus_x_11 * x_11_minus_x_12);
            let correction_0_part_12 = lit(2.0)
                * y_10_minus_y_11
                    .mul_add(y_10_minus_y_11, x_10_minus_x_11 * x_10_minus_x_11);
            let diagonal_link_10 = correction_0_part_12 * pivot_link_11;
            let pivot_link_10 = link_10_with_link_11 * link_10_with_link_11
                * pivot_link_12 + diagonal_link_10;
            let per_pivot_link_10 = pivot_link_10.recip();
            let safe_link_10 = S::select_le(
                lit(-0.0009765625) * diagonal_link_10,
                -pivot_link_10,
                safe_link_6,
                lit(0.0),
            );
            let x_7_minus_x_8 = x_7 - x_8;
            let y_7_minus_y_8 = y_7 - y_8;
            let link_7_with_link_6 = y_6_minus_y_7
                .mul_add(y_7_minus_y_8, x_6_minus_x_7 * x_7_minus_x_8);
            let correction_0_part_13 = lit(2.0)
                * y_7_minus_y_8.mul_add(y_7_minus_y_8, x_7_minus_x_8 * x_7_minus_x_8);
            let diagonal_link_7 = correction_0_part_13 * pivot_link_6;
            let pivot_link_7 = link_7_with_link_6 * link_7_with_link_6 * pivot_link_5
                - diagonal_link_7;
            let per_pivot_link_7 = pivot_link_7.recip();
            let safe_link_7 = S::select_le(
                lit(-0.0009765625) * diagonal_link_7,
                pivot_link_7,
                safe_link_10,
                lit(0.0),
            );
            let x_9_minus_x_10 = x_9 - x_10;
            let y_9_minus_y_10 = y_9 - y_10;
            let link_9_with_link_10 = y_9_minus_y_10
                .mul_add(y_10_minus_y_11, x_9_minus_x_10 * x_10_minus_x_11);
            let correction_0_part_14 = lit(2.0)
                * y_9_minus_y_10
                    .mul_add(y_9_minus_y_10, x_9_minus_x_10 * x_9_minus_x_10);
            let diagonal_link_9 = correction_0_part_14 * pivot_link_10;
            let pivot_link_9 = link_9_with_link_10 * link_9_with_link_10 * pivot_link_11
                - diagonal_link_9;
            let per_pivot_link_9 = pivot_link_9.recip();
            let safe_link_9 = S::select_le(
                lit(-0.0009765625) * diagonal_link_9,
                pivot_link_9,
                safe_link_7,
                lit(0.0),
            );
            let x_8_minus_x_9 = x_8 - x_9;
            let y_8_minus_y_9 = y_8 - y_9;
            let link_8_with_link_9 = y_8_minus_y_9
                .mul_add(y_9_minus_y_10, x_8_minus_x_9 * x_9_minus_x_10);
            let link_8_with_link_7 = y_7_minus_y_8
                .mul_add(y_8_minus_y_9, x_7_minus_x_8 * x_8_minus_x_9);
            let link_8_by_link_7 = link_8_with_link_7 * pivot_link_6 * per_pivot_link_7;
            let correction_0_part_15 = lit(2.0)
                * y_8_minus_y_9.mul_add(y_8_minus_y_9, x_8_minus_x_9 * x_8_minus_x_9);
            let pivot_link_8 = pivot_link_9
                .mul_add(
                    link_8_with_link_7.mul_add(link_8_by_link_7, correction_0_part_15),
                    link_8_with_link_9 * link_8_with_link_9 * pivot_link_10,
                );
            let per_pivot_link_8 = pivot_link_8.recip();
            let diagonal_link_8 = correction_0_part_15 * pivot_link_9;
            let safe_link_8 = S::select_le(
                lit(0.0009765625) * diagonal_link_8,
                pivot_link_8,
                safe_link_9,
                lit(0.0),
            );
            let right_link_0 = lit(0.5) * residual_0;
            let right_support = lit(0.5) * residual_16;
            let correction_0_part_16 = lit(0.5) * residual_1;
            let right_link_1 = correction_0_part_16
                .neg_mul_add(pivot_link_0, right_link_0 * link_1_with_link_0);
            let correction_0_part_17 = lit(0.5) * residual_15;
            let right_link_15 = right_support
                .mul_add(link_15_with_support, correction_0_part_17 * pivot_support);
            let correction_0_part_18 = lit(0.5) * residual_2;
            let right_link_2 = correction_0_part_18
                .mul_add(pivot_link_1, link_2_with_link_1 * right_link_1);
            let correction_0_part_19 = lit(0.5) * residual_14;
            let right_link_14 = correction_0_part_19
                .neg_mul_add(pivot_link_15, link_14_with_link_15 * right_link_15);
            let correction_0_part_20 = lit(0.5) * residual_3;
            let right_link_3 = correction_0_part_20
                .mul_add(pivot_link_2, link_3_with_link_2 * right_link_2);
            let correction_0_part_21 = lit(0.5) * residual_13;
            let right_link_13 = correction_0_part_21
                .neg_mul_add(pivot_link_14, link_13_with_link_14 * right_link_14);
            let correction_0_part_22 = lit(0.5) * residual_4;
            let right_link_4 = correction_0_part_22
                .neg_mul_add(pivot_link_3, link_4_with_link_3 * right_link_3);
            let correction_0_part_23 = lit(0.5) * residual_12;
            let right_link_12 = correction_0_part_23
                .mul_add(pivot_link_13, link_12_with_link_13 * right_link_13);
            let correction_0_part_24 = lit(0.5) * residual_5;
            let right_link_5 = correction_0_part_24
                .neg_mul_add(pivot_link_4, link_5_with_link_4 * right_link_4);
            let correction_0_part_25 = lit(0.5) * residual_11;
            let right_link_11 = correction_0_part_25
                .mul_add(pivot_link_12, link_11_with_link_12 * right_link_12);
            let correction_0_part_26 = lit(0.5) * residual_6;
            let right_link_6 = correction_0_part_26
                .mul_add(pivot_link_5, link_6_with_link_5 * right_link_5);
            let correction_0_part_27 = lit(0.5) * residual_10;
            let right_link_10 = correction_0_part_27
                .neg_mul_add(pivot_link_11, link_10_with_link_11 * right_link_11);
            let correction_0_part_28 = lit(0.5) * residual_7;
            let right_link_7 = correction_0_part_28
                .mul_add(pivot_link_6, link_7_with_link_6 * right_link_6);
            let correction_0_part_29 = lit(0.5) * residual_9;
            let right_link_9 = correction_0_part_29
                .neg_mul_add(pivot_link_10, link_9_with_link_10 * right_link_10);
            let correction_0_part_30 = lit(0.5) * residual_8;
            let right_link_8 = pivot_link_9
                .neg_mul_add(
                    (link_8_with_link_7 * right_link_7 * per_pivot_link_7
                        - correction_0_part_30),
                    link_8_with_link_9 * right_link_9,
                );
            let safe = safe_link_8;
            let safe_part = x_8_minus_x_9 * right_link_8 * per_pivot_link_8;
            let lambda_link_7 = (link_8_by_link_7 * right_link_8)
                .mul_add(per_pivot_link_8, right_link_7 * per_pivot_link_7);
            let x_7_minus_x_8_lambda_link_7 = x_7_minus_x_8 * lambda_link_7;
            out[8] = -safe_part - x_7_minus_x_8_lambda_link_7;
            let lambda_link_9 = (link_8_with_link_9 * pivot_link_10 * per_pivot_link_9
                * right_link_8)
                .neg_mul_add(per_pivot_link_8, right_link_9 * per_pivot_link_9);
            let x_9_minus_x_10_lambda_link_9 = x_9_minus_x_10 * lambda_link_9;
            out[9] = safe_part - x_9_minus_x_10_lambda_link_9;
            let correction_10_part = y_8_minus_y_9 * right_link_8 * per_pivot_link_8;
            let y_7_minus_y_8_lambda_link_7 = y_7_minus_y_8 * lambda_link_7;
            out[25] = -correction_10_part - y_7_minus_y_8_lambda_link_7;
            let y_9_minus_y_10_lambda_link_9 = y_9_minus_y_10 * lambda_link_9;
            out[26] = correction_10_part - y_9_minus_y_10_lambda_link_9;
            let lambda_link_6 = (link_7_with_link_6 * pivot_link_5 * per_pivot_link_6)
                .neg_mul_add(lambda_link_7, right_link_6 * per_pivot_link_6);
            let x_6_minus_x_7_lambda_link_6 = x_6_minus_x_7 * lambda_link_6;
            out[7] = x_7_minus_x_8_lambda_link_7 + x_6_minus_x_7_lambda_link_6;
            let lambda_link_10 = (link_9_with_link_10 * pivot_link_11
                * per_pivot_link_10)
                .neg_mul_add(lambda_link_9, right_link_10 * per_pivot_link_10);
            let x_10_minus_x_11_lambda_link_10 = x_10_minus_x_11 * lambda_link_10;
            out[10] = x_9_minus_x_10_lambda_link_9 + x_10_minus_x_11_lambda_link_10;
            let y_6_minus_y_7_lambda_link_6 = y_6_minus_y_7 * lambda_link_6;
            out[24] = y_7_minus_y_8_lambda_link_7 + y_6_minus_y_7_lambda_link_6;
            let y_10_minus_y_11_lambda_link_10 = y_10_minus_y_11 * lambda_link_10;
            out[27] = y_9_minus_y_10_lambda_link_9 + y_10_minus_y_11_lambda_link_10;
            let lambda_link_11 = (link_10_with_link_11 * pivot_link_12
                * per_pivot_link_11)
                .neg_mul_add(lambda_link_10, right_link_11 * per_pivot_link_11);
            let x_11_minus_x_12_lambda_link_11 = x_11_minus_x_12 * lambda_link_11;
            out[11] = x_11_minus_x_12_lambda_link_11 - x_10_minus_x_11_lambda_link_10;
            let y_11_minus_y_12_lambda_link_11 = y_11_minus_y_12 * lambda_link_11;
            out[28] = y_11_minus_y_12_lambda_link_11 - y_10_minus_y_11_lambda_link_10;
            let lambda_link_5 = (link_6_with_link_5 * pivot_link_4 * per_pivot_link_5)
                .neg_mul_add(lambda_link_6, right_link_5 * per_pivot_link_5);
            let x_5_minus_x_6_lambda_link_5 = x_5_minus_x_6 * lambda_link_5;
            out[6] = x_5_minus_x_6_lambda_link_5 - x_6_minus_x_7_lambda_link_6;
            let y_5_minus_y_6_lambda_link_5 = y_5_minus_y_6 * lambda_link_5;
            out[23] = y_5_minus_y_6_lambda_link_5 - y_6_minus_y_7_lambda_link_6;
            let lambda_link_4 = (link_5_with_link_4 * pivot_link_3 * per_pivot_link_4)
                .neg_mul_add(lambda_link_5, right_link_4 * per_pivot_link_4);
            let x_4_minus_x_5_lambda_link_4 = x_4_minus_x_5 * lambda_link_4;
            out[5] = -x_5_minus_x_6_lambda_link_5 - x_4_minus_x_5_lambda_link_4;
            let lambda_link_12 = (link_11_with_link_12 * pivot_link_13
                * per_pivot_link_12)
                .neg_mul_add(lambda_link_11, right_link_12 * per_pivot_link_12);
            let x_12_minus_x_13_lambda_link_12 = x_12_minus_x_13 * lambda_link_12;
            out[12] = -x_11_minus_x_12_lambda_link_11 - x_12_minus_x_13_lambda_link_12;
            let y_4_minus_y_5_lambda_link_4 = y_4_minus_y_5 * lambda_link_4;
            out[22] = -y_5_minus_y_6_lambda_link_5 - y_4_minus_y_5_lambda_link_4;
            let y_12_minus_y_13_lambda_link_12 = y_12_minus_y_13 * lambda_link_12;
            out[29] = -y_11_minus_y_12_lambda_link_11 - y_12_minus_y_13_lambda_link_12;
            let lambda_link_3 = (link_4_with_link_3 * pivot_link_2 * per_pivot_link_3)
                .neg_mul_add(lambda_link_4, right_link_3 * per_pivot_link_3);
            let x_3_minus_x_4_lambda_link_3 = x_3_minus_x_4 * lambda_link_3;
            out[4] = x_4_minus_x_5_lambda_link_4 - x_3_minus_x_4_lambda_link_3;
            let y_3_minus_y_4_lambda_link_3 = y_3_minus_y_4 * lambda_link_3;
            out[21] = y_4_minus_y_5_lambda_link_4 - y_3_minus_y_4_lambda_link_3;
            let lambda_link_13 = (link_12_with_link_13 * pivot_link_14
                * per_pivot_link_13)
                .neg_mul_add(lambda_link_12, right_link_13 * per_pivot_link_13);
            let x_13_minus_x_14_lambda_link_13 = x_13_minus_x_14 * lambda_link_13;
            out[13] = x_12_minus_x_13_lambda_link_12 - x_13_minus_x_14_lambda_link_13;
            let y_13_minus_y_14_lambda_link_13 = y_13_minus_y_14 * lambda_link_13;
            out[30] = y_12_minus_y_13_lambda_link_12 - y_13_minus_y_14_lambda_link_13;
            let lambda_link_2 = (link_3_with_link_2 * pivot_link_1 * per_pivot_link_2)
                .neg_mul_add(lambda_link_3, right_link_2 * per_pivot_link_2);
            let x_2_minus_x_3_lambda_link_2 = x_2_minus_x_3 * lambda_link_2;
            out[3] = x_3_minus_x_4_lambda_link_3 + x_2_minus_x_3_lambda_link_2;
            let lambda_link_14 = (link_13_with_link_14 * pivot_link_15
                * per_pivot_link_14)
                .neg_mul_add(lambda_link_13, right_link_14 * per_pivot_link_14);
            let x_14_minus_x_15_lambda_link_14 = x_14_minus_x_15 * lambda_link_14;
            out[14] = x_13_minus_x_14_lambda_link_13 + x_14_minus_x_15_lambda_link_14;
            let y_2_minus_y_3_lambda_link_2 = y_2_minus_y_3 * lambda_link_2;
            out[20] = y_3_minus_y_4_lambda_link_3 + y_2_minus_y_3_lambda_link_2;
            let y_14_minus_y_15_lambda_link_14 = y_14_minus_y_15 * lambda_link_14;
            out[31] = y_13_minus_y_14_lambda_link_13 + y_14_minus_y_15_lambda_link_14;
            let lambda_link_15 = (pivot_support * link_14_with_link_15
                * per_pivot_link_15)
                .neg_mul_add(lambda_link_14, right_link_15 * per_pivot_link_15);
            let x_15_minus_x_16_lambda_link_15 = x_15_minus_x_16 * lambda_link_15;
            out[15] = x_15_minus_x_16_lambda_link_15 - x_14_minus_x_15_lambda_link_14;
            let y_15_minus_y_16_lambda_link_15 = y_15_minus_y_16 * lambda_link_15;
            out[32] = y_15_minus_y_16_lambda_link_15 - y_14_minus_y_15_lambda_link_14;
            let lambda_link_1 = (link_2_with_link_1 * pivot_link_0 * per_pivot_link_1)
                .neg_mul_add(lambda_link_2, right_link_1 * per_pivot_link_1);
            let x_1_minus_x_2_lambda_link_1 = x_1_minus_x_2 * lambda_link_1;
            out[2] = x_1_minus_x_2_lambda_link_1 - x_2_minus_x_3_lambda_link_2;
            let y_1_minus_y_2_lambda_link_1 = y_1_minus_y_2 * lambda_link_1;
            out[19] = y_1_minus_y_2_lambda_link_1 - y_2_minus_y_3_lambda_link_2;
            let lambda_link_0 = (link_1_with_link_0 * per_pivot_link_0)
                .neg_mul_add(lambda_link_1, right_link_0 * per_pivot_link_0);
            let x_1_minus_x_0_lambda_link_0 = x_1_minus_x_0 * lambda_link_0;
            out[0] = x_1_minus_x_0_lambda_link_0;
            let y_0_minus_y_1_lambda_link_0 = y_0_minus_y_1 * lambda_link_0;
            out[17] = -y_0_minus_y_1_lambda_link_0;
            out[1] = -x_1_minus_x_2_lambda_link_1 - x_1_minus_x_0_lambda_link_0;
            let lambda_support = (link_15_with_support * per_pivot_support)
                .neg_mul_add(lambda_link_15, right_support * per_pivot_support);
            out[16] = x_16.neg_mul_add(lambda_support, -x_15_minus_x_16_lambda_link_15);
            out[18] = y_0_minus_y_1_lambda_link_0 - y_1_minus_y_2_lambda_link_1;
            out[33] = y_16.neg_mul_add(lambda_support, -y_15_minus_y_16_lambda_link_15);
            safe
        }
    }
};
