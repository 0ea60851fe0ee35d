/// The slider-crank of `SliderCrank` with two redundant constraints: the slider runs on two shoes although its level is kept already,
/// and a second, massless rod joins the same two pins. The second is redundant only where the joints are closed: off them, the
/// rows of A are independent.
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
/// level: th3 = 0
/// front_shoe: y3 + c*sin(th3) = 0
/// back_shoe: y3 - c*sin(th3) = 0
/// second_rod: sq(x1 + 0.5*r*cos(th1) - x3) + sq(y1 + 0.5*r*sin(th1) - y3) - sq(l) = 0
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
/// … 17 rows like these …
/// A[second_rod, y3] = 2*y3 - 2*y1 - r*sin(th1)
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
/// b[front_shoe] = c*sin(th3)*sq(dot(th3))
/// b[back_shoe] = -c*sin(th3)*sq(dot(th3))
/// b[second_rod] = 2*(0.5*r*cos(th1)*(x1 + 0.5*r*cos(th1) - x3)*sq(dot(th1)) + 0.5*r*sin(th1)*(y1 + 0.5*r*sin(th1) - y3)*sq(dot(th1)) - sq(dot(x3) + 0.5*r*sin(th1)*dot(th1) - dot(x1)) - sq(dot(y1) + 0.5*r*cos(th1)*dot(th1) - dot(y3)))
/// ```
///
/// # How it is computed
///
/// By the dense, rank-revealing solve: there is no straight line, since `back_shoe` is implied by the constraints eliminated before it, whatever the state.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 26 | 59 | 0 | 0 | 3 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 1482 | 1672 | 19 | 0 | 0 | 0 |
/// | once for a set of parameters | 0 | 5 | 0 | 0 | 0 | 0 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct SliderCrankRedundant {
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
    /// Half distance of the slider's shoes, m
    pub c: f64,
    /// Acceleration of gravity, m/s^2
    pub g: f64,
    /// Constant torque on the crank (with the potential -torque * th1), Nm
    pub torque: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for SliderCrankRedundant {
    fn default() -> Self {
        SliderCrankRedundant {
            r: 0.1,
            l: 0.3,
            m1: 0.5,
            m2: 0.8,
            m3: 0.6,
            i1: 0.0004,
            i2: 0.006,
            i3: 0.0005,
            c: 0.03,
            g: 9.81,
            torque: 0.0,
        }
    }
}
#[allow(dead_code)]
impl SliderCrankRedundant {
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
    /// Row in A of constraint `level`.
    pub const LEVEL: usize = 6;
    /// Row in A of constraint `front_shoe`.
    pub const FRONT_SHOE: usize = 7;
    /// Row in A of constraint `back_shoe`.
    pub const BACK_SHOE: usize = 8;
    /// Row in A of constraint `second_rod`.
    pub const SECOND_ROD: usize = 9;
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
    impl ::core::convert::From<SliderCrankRedundant> for ukcore::Prepared {
        fn from(mechanism: SliderCrankRedundant) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for SliderCrankRedundant {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "SliderCrankRedundant",
            doc: "The slider-crank of `SliderCrank` with two redundant constraints: the slider runs on two shoes although its level is kept already,\nand a second, massless rod joins the same two pins. The second is redundant only where the joints are closed: off them, the\nrows of A are independent.",
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
                    name: "c",
                    doc: "Half distance of the slider's shoes, m",
                    default: 0.03,
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
                ("m1_g", "m1*g"),
                ("m2_g", "m2*g"),
                ("m3_g", "m3*g"),
                ("torque", "torque"),
                ("r", "r"),
                ("l", "l"),
                ("c", "c"),
                ("sq_l", "sq(l)"),
                ("m1", "m1"),
                ("i1", "i1"),
                ("m2", "m2"),
                ("i2", "i2"),
                ("m3", "m3"),
                ("i3", "i3"),
                ("half_r", "0.5*r"),
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
                    name: "level",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "th3 = 0",
                },
                ukcore::ConstraintSpec {
                    name: "front_shoe",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "y3 + c*sin(th3) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "back_shoe",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "y3 - c*sin(th3) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "second_rod",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x1 + 0.5*r*cos(th1) - x3) + sq(y1 + 0.5*r*sin(th1) - y3) - sq(l) = 0",
                },
            ],
            holonomic: 10,
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
                straight_line: false,
                solve: ukcore::Solve::none(
                    "`back_shoe` is implied by the constraints eliminated before it, whatever the state",
                ),
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
                    (6, 8),
                    (7, 7),
                    (7, 8),
                    (8, 7),
                    (8, 8),
                    (9, 0),
                    (9, 1),
                    (9, 2),
                    (9, 6),
                    (9, 7),
                ],
                mass_diagonal: true,
                mass_constant: true,
                jacobian_constant: false,
                massless: &[],
                angles: &[2, 5, 8],
                scleronomic: true,
                nonideal: false,
                potential: true,
                conservative: true,
                left_out: &[
                    "62 of the 90 entries of A: structurally zero, never written",
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "1 of 10 entries of b: identically zero",
                    "5 of 9 entries of Q: identically zero",
                    "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 26,
                        multiplications: 59,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 3,
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
                        additions: 0,
                        multiplications: 0,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    acceleration: ukcore::Operations {
                        additions: 0,
                        multiplications: 0,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    correction: ukcore::Operations {
                        additions: 0,
                        multiplications: 0,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    prepare: ukcore::Operations {
                        additions: 0,
                        multiplications: 5,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
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
                    (6, 8, "1"),
                    (7, 7, "1"),
                    (7, 8, "c*cos(th3)"),
                    (8, 7, "1"),
                    (8, 8, "-c*cos(th3)"),
                    (9, 0, "2*x1 + r*cos(th1) - 2*x3"),
                    (9, 1, "2*y1 + r*sin(th1) - 2*y3"),
                    (
                        9,
                        2,
                        "r*cos(th1)*(y1 + 0.5*r*sin(th1) - y3) - r*sin(th1)*(x1 + 0.5*r*cos(th1) - x3)",
                    ),
                    (9, 6, "2*x3 - 2*x1 - r*cos(th1)"),
                    (9, 7, "2*y3 - 2*y1 - r*sin(th1)"),
                ],
                rhs: &[
                    (0, "-0.5*r*cos(th1)*sq(dot(th1))"),
                    (1, "-0.5*r*sin(th1)*sq(dot(th1))"),
                    (2, "0.5*(r*cos(th1)*sq(dot(th1)) + l*cos(th2)*sq(dot(th2)))"),
                    (3, "0.5*(r*sin(th1)*sq(dot(th1)) + l*sin(th2)*sq(dot(th2)))"),
                    (4, "0.5*l*cos(th2)*sq(dot(th2))"),
                    (5, "0.5*l*sin(th2)*sq(dot(th2))"),
                    (7, "c*sin(th3)*sq(dot(th3))"),
                    (8, "-c*sin(th3)*sq(dot(th3))"),
                    (
                        9,
                        "2*(0.5*r*cos(th1)*(x1 + 0.5*r*cos(th1) - x3)*sq(dot(th1)) + 0.5*r*sin(th1)*(y1 + 0.5*r*sin(th1) - y3)*sq(dot(th1)) - sq(dot(x3) + 0.5*r*sin(th1)*dot(th1) - dot(x1)) - sq(dot(y1) + 0.5*r*cos(th1)*dot(th1) - dot(y3)))",
                    ),
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
                8 => self.c,
                9 => self.g,
                10 => self.torque,
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
                8 => self.c = value,
                9 => self.g = value,
                10 => self.torque = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 15>(prepared, "prepared");
            let [r, l, m1, m2, m3, i1, i2, i3, c, g, torque] = *ukcore::emitted::exact::<
                S,
                11,
            >(given, "given");
            let lit = S::from_f64;
            prepared[0] = m1 * g;
            prepared[1] = m2 * g;
            prepared[2] = m3 * g;
            prepared[3] = torque;
            prepared[4] = r;
            prepared[5] = l;
            prepared[6] = c;
            prepared[7] = l * l;
            prepared[8] = m1;
            prepared[9] = i1;
            prepared[10] = m2;
            prepared[11] = i2;
            prepared[12] = m3;
            prepared[13] = i3;
            prepared[14] = lit(0.5) * r;
        }
        /// 26 additions, 59 multiplications, 0 divisions, 0 square roots, 3 transcendentals, 0 selections.
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
            let jacobian = ukcore::emitted::exact_mut::<S, 90>(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 10>(out.rhs, "rhs");
            let [m1_g, m2_g, m3_g, torque, r, l, c, _, m1, i1, m2, i2, m3, i3, half_r] = *ukcore::emitted::exact::<
                S,
                15,
            >(prepared, "prepared");
            let [x1, y1, th1, _, _, th2, x3, y3, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let [dot_x1, dot_y1, dot_th1, _, _, dot_th2, dot_x3, dot_y3, dot_th3] = *ukcore::emitted::exact::<
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
            force[1] = -m1_g;
            force[2] = torque;
            force[3] = lit(0.0);
            force[4] = -m2_g;
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
            jacobian[20] = lit(0.5) * sin_th1_r;
            jacobian[11] = lit(1.0);
            let cos_th1_r = r * cos_th1;
            jacobian[21] = lit(-0.5) * cos_th1_r;
            jacobian[2] = lit(1.0);
            jacobian[22] = lit(-0.5) * sin_th1_r;
            jacobian[32] = lit(-1.0);
            let (sin_th2, cos_th2) = th2.sin_cos();
            let a_crank_pin_0 = lit(-0.5) * (l * sin_th2);
            jacobian[52] = a_crank_pin_0;
            jacobian[13] = lit(1.0);
            jacobian[23] = lit(0.5) * cos_th1_r;
            jacobian[43] = lit(-1.0);
            let a_crank_pin_1 = lit(0.5) * (l * cos_th2);
            jacobian[53] = a_crank_pin_1;
            jacobian[34] = lit(1.0);
            jacobian[54] = a_crank_pin_0;
            jacobian[64] = lit(-1.0);
            jacobian[45] = lit(1.0);
            jacobian[55] = a_crank_pin_1;
            jacobian[75] = lit(-1.0);
            jacobian[86] = lit(1.0);
            jacobian[77] = lit(1.0);
            let (sin_th3, cos_th3) = th3.sin_cos();
            let cos_th3_c = c * cos_th3;
            jacobian[87] = cos_th3_c;
            jacobian[78] = lit(1.0);
            jacobian[88] = -cos_th3_c;
            let a_second_rod = lit(2.0).neg_mul_add(x3, lit(2.0) * x1) + cos_th1_r;
            jacobian[9] = a_second_rod;
            let a_second_rod_2 = lit(2.0).neg_mul_add(y3, lit(2.0) * y1) + sin_th1_r;
            jacobian[19] = a_second_rod_2;
            let a_second_rod_part = lit(0.5).mul_add(cos_th1_r, x1 - x3);
            let a_second_rod_part_2 = lit(0.5).mul_add(sin_th1_r, y1 - y3);
            jacobian[29] = (r * sin_th1)
                .neg_mul_add(a_second_rod_part, r * cos_th1 * a_second_rod_part_2);
            jacobian[69] = -a_second_rod;
            jacobian[79] = -a_second_rod_2;
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
            let sin_th3_sq_dot_th3_c = dot_th3 * dot_th3 * c * sin_th3;
            rhs[7] = sin_th3_sq_dot_th3_c;
            rhs[8] = -sin_th3_sq_dot_th3_c;
            let b_9_part = (lit(0.5) * dot_th1 * r).mul_add(sin_th1, dot_x3 - dot_x1);
            let b_9_part_2 = (lit(0.5) * dot_th1 * r).mul_add(cos_th1, dot_y1 - dot_y3);
            rhs[9] = lit(-2.0)
                * (dot_th1 * dot_th1 * half_r * sin_th1)
                    .neg_mul_add(
                        a_second_rod_part_2,
                        (dot_th1 * dot_th1 * half_r * cos_th1)
                            .neg_mul_add(
                                a_second_rod_part,
                                b_9_part_2.mul_add(b_9_part_2, b_9_part * b_9_part),
                            ),
                    );
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 81>(mass, "mass");
            let [_, _, _, _, _, _, _, _, m1, i1, m2, i2, m3, i3, _] = *ukcore::emitted::exact::<
                S,
                15,
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
            let jacobian = ukcore::emitted::exact_mut::<S, 90>(jacobian, "jacobian");
            let [_, _, _, _, r, l, c, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                15,
            >(prepared, "prepared");
            let [x1, y1, th1, _, _, th2, x3, y3, th3] = *ukcore::emitted::exact::<
                S,
                9,
            >(q, "q");
            let lit = S::from_f64;
            jacobian[0] = lit(1.0);
            let (sin_th1, cos_th1) = th1.sin_cos();
            let sin_th1_r = r * sin_th1;
            jacobian[20] = lit(0.5) * sin_th1_r;
            jacobian[11] = lit(1.0);
            let cos_th1_r = r * cos_th1;
            jacobian[21] = lit(-0.5) * cos_th1_r;
            jacobian[2] = lit(1.0);
            jacobian[22] = lit(-0.5) * sin_th1_r;
            jacobian[32] = lit(-1.0);
            let (sin_th2, cos_th2) = th2.sin_cos();
            let a_crank_pin_0 = lit(-0.5) * (l * sin_th2);
            jacobian[52] = a_crank_pin_0;
            jacobian[13] = lit(1.0);
            jacobian[23] = lit(0.5) * cos_th1_r;
            jacobian[43] = lit(-1.0);
            let a_crank_pin_1 = lit(0.5) * (l * cos_th2);
            jacobian[53] = a_crank_pin_1;
            jacobian[34] = lit(1.0);
            jacobian[54] = a_crank_pin_0;
            jacobian[64] = lit(-1.0);
            jacobian[45] = lit(1.0);
            jacobian[55] = a_crank_pin_1;
            jacobian[75] = lit(-1.0);
            jacobian[86] = lit(1.0);
            jacobian[77] = lit(1.0);
            let a_front_shoe = c * th3.cos();
            jacobian[87] = a_front_shoe;
            jacobian[78] = lit(1.0);
            jacobian[88] = -a_front_shoe;
            let a_second_rod = lit(2.0).neg_mul_add(x3, lit(2.0) * x1) + cos_th1_r;
            jacobian[9] = a_second_rod;
            let a_second_rod_2 = lit(2.0).neg_mul_add(y3, lit(2.0) * y1) + sin_th1_r;
            jacobian[19] = a_second_rod_2;
            jacobian[29] = (r * sin_th1)
                .neg_mul_add(
                    lit(0.5).mul_add(cos_th1_r, x1 - x3),
                    r * cos_th1 * lit(0.5).mul_add(sin_th1_r, y1 - y3),
                );
            jacobian[69] = -a_second_rod;
            jacobian[79] = -a_second_rod_2;
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 10>(phi, "phi");
            let [_, _, _, _, r, l, c, sq_l, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                15,
            >(prepared, "prepared");
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
            phi[6] = th3;
            let phi_7_part = c * th3.sin();
            phi[7] = y3 + phi_7_part;
            phi[8] = y3 - phi_7_part;
            let phi_9_part = lit(0.5).mul_add(cos_th1_r, x1 - x3);
            let phi_9_part_2 = lit(0.5).mul_add(sin_th1_r, y1 - y3);
            phi[9] = phi_9_part_2.mul_add(phi_9_part_2, phi_9_part * phi_9_part - sq_l);
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 10>(rate, "rate");
            let [_, _, _, _, r, l, c, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                15,
            >(prepared, "prepared");
            let [x1, y1, th1, _, _, th2, x3, y3, th3] = *ukcore::emitted::exact::<
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
            rate[6] = dot_th3;
            let rate_7_part = dot_th3 * c * th3.cos();
            rate[7] = dot_y3 + rate_7_part;
            rate[8] = dot_y3 - rate_7_part;
            rate[9] = lit(-2.0)
                * (lit(0.5) * r)
                    .mul_add(sin_th1, y1 - y3)
                    .neg_mul_add(
                        lit(0.5).mul_add(cos_th1_dot_th1_r, dot_y1 - dot_y3),
                        (lit(0.5) * r).mul_add(cos_th1, x1 - x3)
                            * lit(0.5).mul_add(sin_th1_dot_th1_r, dot_x3 - dot_x1),
                    );
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [m1_g, m2_g, m3_g, torque, _, _, _, _, m1, i1, m2, i2, m3, i3, _] = *ukcore::emitted::exact::<
                S,
                15,
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
                .neg_mul_add(torque, y3.mul_add(m3_g, y2.mul_add(m2_g, y1 * m1_g)));
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
    }
};
