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
/// A[crank[2], x[2]] = 2*x[2] - 4*l
/// A[crank[2], y[2]] = 2*y[2]
/// A[crank[3], x[3]] = 2*x[3] - 6*l
/// A[crank[3], y[3]] = 2*y[3]
/// A[crank[4], x[4]] = 2*x[4] - 8*l
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
#[automatically_derived]
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
#[automatically_derived]
#[allow(unused_variables, clippy::all, clippy::pedantic)]
impl ::ukcore::Mechanism for FourBars {
    const SPEC: &'static ::ukcore::Spec = &::ukcore::Spec {
        name: "FourBars",
        doc: "N four-bar linkages in a row that share their cranks: N + 1 uniform rods from the ground points (i l, 0) to the tops (x\\[i\\], y\\[i\\]), and\nN uniform rods from each top to the next. The y axis points up. A uniform rod with the end velocities a and b has the kinetic\nenergy m/6 (a² + a·b + b²), so that M couples neighbours. Where all rods lie in one line the N couplers are redundant. (The\nN-four-bar of González, Dopico, Pastorino & Cuadrado 2006, DOI 10.1007/s11044-006-9020-5.)",
        params: &[
            ::ukcore::ParamSpec {
                name: "m",
                doc: "Mass of each rod, kg",
                default: 1.0,
            },
            ::ukcore::ParamSpec {
                name: "l",
                doc: "Length of each rod, m",
                default: 1.0,
            },
            ::ukcore::ParamSpec {
                name: "g",
                doc: "Acceleration of gravity, m/s^2",
                default: 9.81,
            },
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
            ::ukcore::ConstraintSpec {
                name: "crank[0]",
                kind: ::ukcore::ConstraintKind::Holonomic,
                equation: "sq(x[0]) + sq(y[0]) - sq(l) = 0",
            },
            ::ukcore::ConstraintSpec {
                name: "crank[1]",
                kind: ::ukcore::ConstraintKind::Holonomic,
                equation: "sq(x[1] - l) + sq(y[1]) - sq(l) = 0",
            },
            ::ukcore::ConstraintSpec {
                name: "crank[2]",
                kind: ::ukcore::ConstraintKind::Holonomic,
                equation: "sq(x[2] - 2*l) + sq(y[2]) - sq(l) = 0",
            },
            ::ukcore::ConstraintSpec {
                name: "crank[3]",
                kind: ::ukcore::ConstraintKind::Holonomic,
                equation: "sq(x[3] - 3*l) + sq(y[3]) - sq(l) = 0",
            },
            ::ukcore::ConstraintSpec {
                name: "crank[4]",
                kind: ::ukcore::ConstraintKind::Holonomic,
                equation: "sq(x[4] - 4*l) + sq(y[4]) - sq(l) = 0",
            },
            ::ukcore::ConstraintSpec {
                name: "coupler[0]",
                kind: ::ukcore::ConstraintKind::Holonomic,
                equation: "sq(x[0] - x[1]) + sq(y[0] - y[1]) - sq(l) = 0",
            },
            ::ukcore::ConstraintSpec {
                name: "coupler[1]",
                kind: ::ukcore::ConstraintKind::Holonomic,
                equation: "sq(x[1] - x[2]) + sq(y[1] - y[2]) - sq(l) = 0",
            },
            ::ukcore::ConstraintSpec {
                name: "coupler[2]",
                kind: ::ukcore::ConstraintKind::Holonomic,
                equation: "sq(x[2] - x[3]) + sq(y[2] - y[3]) - sq(l) = 0",
            },
            ::ukcore::ConstraintSpec {
                name: "coupler[3]",
                kind: ::ukcore::ConstraintKind::Holonomic,
                equation: "sq(x[3] - x[4]) + sq(y[3] - y[4]) - sq(l) = 0",
            },
        ],
        holonomic: 9,
        outputs: &[
            ::ukcore::OutputSpec {
                name: "lean",
                doc: "Angle of the first crank from the upright, towards +x, rad",
            },
        ],
        structure: ::ukcore::Structure {
            straight_line: true,
            solve: "by straight-line elimination in the order x[0] x[4] y[0] y[4] x[1] x[3] x[2] y[1] y[3] y[2] crank[0] crank[1] crank[2] crank[3] crank[4] coupler[0] coupler[1] coupler[2] coupler[3]",
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
            operations: ::ukcore::Operations {
                additions: 30,
                multiplications: 60,
                divisions: 0,
                square_roots: 0,
                transcendentals: 0,
                selections: 0,
            },
            solve_operations: ::ukcore::Operations {
                additions: 390,
                multiplications: 855,
                divisions: 10,
                square_roots: 0,
                transcendentals: 0,
                selections: 12,
            },
        },
        equations: ::ukcore::Equations {
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
                (2, 2, "2*x[2] - 4*l"),
                (2, 7, "2*y[2]"),
                (3, 3, "2*x[3] - 6*l"),
                (3, 8, "2*y[3]"),
                (4, 4, "2*x[4] - 8*l"),
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
            _ => ::ukcore::emitted::no_parameter(index),
        }
    }
    fn set_parameter(&mut self, index: usize, value: f64) {
        match index {
            0 => self.m = value,
            1 => self.l = value,
            2 => self.g = value,
            _ => ::ukcore::emitted::no_parameter(index),
        }
    }
    /// 30 additions, 60 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 0 selections.
    fn dynamics<S: ::ukcore::Scalar>(
        &self,
        t: S,
        q: &[S],
        v: &[S],
        out: &mut ::ukcore::Terms<'_, S>,
    ) {
        let mass = ::ukcore::emitted::exact_mut::<S, 100>(out.mass, "mass");
        let force = ::ukcore::emitted::exact_mut::<S, 10>(out.force, "force");
        let nonideal = ::ukcore::emitted::exact_mut::<S, 10>(out.nonideal, "nonideal");
        let jacobian = ::ukcore::emitted::exact_mut::<S, 90>(out.jacobian, "jacobian");
        let rhs = ::ukcore::emitted::exact_mut::<S, 9>(out.rhs, "rhs");
        let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *::ukcore::emitted::exact::<
            S,
            10,
        >(q, "q");
        let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_y_0, dot_y_1, dot_y_2,
        dot_y_3, dot_y_4] = *::ukcore::emitted::exact::<S, 10>(v, "v");
        let lit = S::from_f64;
        let m = lit(self.m);
        let l = lit(self.l);
        let g = lit(self.g);
        let mass_x_0_x_0 = lit(0.6666666666666666) * m;
        mass[0] = mass_x_0_x_0;
        let mass_x_1_x_0 = lit(0.16666666666666666) * m;
        mass[1] = mass_x_1_x_0;
        mass[10] = mass_x_1_x_0;
        mass[11] = m;
        mass[12] = mass_x_1_x_0;
        mass[21] = mass_x_1_x_0;
        mass[22] = m;
        mass[23] = mass_x_1_x_0;
        mass[32] = mass_x_1_x_0;
        mass[33] = m;
        mass[34] = mass_x_1_x_0;
        mass[43] = mass_x_1_x_0;
        mass[44] = mass_x_0_x_0;
        mass[55] = mass_x_0_x_0;
        mass[56] = mass_x_1_x_0;
        mass[65] = mass_x_1_x_0;
        mass[66] = m;
        mass[67] = mass_x_1_x_0;
        mass[76] = mass_x_1_x_0;
        mass[77] = m;
        mass[78] = mass_x_1_x_0;
        mass[87] = mass_x_1_x_0;
        mass[88] = m;
        mass[89] = mass_x_1_x_0;
        mass[98] = mass_x_1_x_0;
        mass[99] = mass_x_0_x_0;
        force[0] = lit(0.0);
        force[1] = lit(0.0);
        force[2] = lit(0.0);
        force[3] = lit(0.0);
        force[4] = lit(0.0);
        let m_g = m * g;
        force[5] = -m_g;
        let force_6 = lit(-1.5) * m_g;
        force[6] = force_6;
        force[7] = force_6;
        force[8] = force_6;
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
        jacobian[20] = lit(2.0) * x_2 - lit(4.0) * l;
        jacobian[65] = lit(2.0) * y_2;
        jacobian[30] = lit(2.0) * x_3 - lit(6.0) * l;
        jacobian[75] = lit(2.0) * y_3;
        jacobian[40] = lit(2.0) * x_4 - lit(8.0) * l;
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
        rhs[0] = lit(-2.0) * (dot_x_0 * dot_x_0 + dot_y_0 * dot_y_0);
        rhs[1] = lit(-2.0) * (dot_x_1 * dot_x_1 + dot_y_1 * dot_y_1);
        rhs[2] = lit(-2.0) * (dot_x_2 * dot_x_2 + dot_y_2 * dot_y_2);
        rhs[3] = lit(-2.0) * (dot_x_3 * dot_x_3 + dot_y_3 * dot_y_3);
        rhs[4] = lit(-2.0) * (dot_x_4 * dot_x_4 + dot_y_4 * dot_y_4);
        let dot_x_0_minus_dot_x_1 = dot_x_0 - dot_x_1;
        let dot_y_0_minus_dot_y_1 = dot_y_0 - dot_y_1;
        rhs[5] = lit(-2.0)
            * (dot_x_0_minus_dot_x_1 * dot_x_0_minus_dot_x_1
                + dot_y_0_minus_dot_y_1 * dot_y_0_minus_dot_y_1);
        let dot_x_1_minus_dot_x_2 = dot_x_1 - dot_x_2;
        let dot_y_1_minus_dot_y_2 = dot_y_1 - dot_y_2;
        rhs[6] = lit(-2.0)
            * (dot_x_1_minus_dot_x_2 * dot_x_1_minus_dot_x_2
                + dot_y_1_minus_dot_y_2 * dot_y_1_minus_dot_y_2);
        let dot_x_2_minus_dot_x_3 = dot_x_2 - dot_x_3;
        let dot_y_2_minus_dot_y_3 = dot_y_2 - dot_y_3;
        rhs[7] = lit(-2.0)
            * (dot_x_2_minus_dot_x_3 * dot_x_2_minus_dot_x_3
                + dot_y_2_minus_dot_y_3 * dot_y_2_minus_dot_y_3);
        let dot_x_3_minus_dot_x_4 = dot_x_3 - dot_x_4;
        let dot_y_3_minus_dot_y_4 = dot_y_3 - dot_y_4;
        rhs[8] = lit(-2.0)
            * (dot_x_3_minus_dot_x_4 * dot_x_3_minus_dot_x_4
                + dot_y_3_minus_dot_y_4 * dot_y_3_minus_dot_y_4);
    }
    fn mass_matrix<S: ::ukcore::Scalar>(&self, t: S, q: &[S], mass: &mut [S]) {
        let mass = ::ukcore::emitted::exact_mut::<S, 100>(mass, "mass");
        let lit = S::from_f64;
        let m = lit(self.m);
        let mass_x_0_x_0 = lit(0.6666666666666666) * m;
        mass[0] = mass_x_0_x_0;
        let mass_x_1_x_0 = lit(0.16666666666666666) * m;
        mass[1] = mass_x_1_x_0;
        mass[10] = mass_x_1_x_0;
        mass[11] = m;
        mass[12] = mass_x_1_x_0;
        mass[21] = mass_x_1_x_0;
        mass[22] = m;
        mass[23] = mass_x_1_x_0;
        mass[32] = mass_x_1_x_0;
        mass[33] = m;
        mass[34] = mass_x_1_x_0;
        mass[43] = mass_x_1_x_0;
        mass[44] = mass_x_0_x_0;
        mass[55] = mass_x_0_x_0;
        mass[56] = mass_x_1_x_0;
        mass[65] = mass_x_1_x_0;
        mass[66] = m;
        mass[67] = mass_x_1_x_0;
        mass[76] = mass_x_1_x_0;
        mass[77] = m;
        mass[78] = mass_x_1_x_0;
        mass[87] = mass_x_1_x_0;
        mass[88] = m;
        mass[89] = mass_x_1_x_0;
        mass[98] = mass_x_1_x_0;
        mass[99] = mass_x_0_x_0;
    }
    fn jacobian<S: ::ukcore::Scalar>(&self, t: S, q: &[S], v: &[S], jacobian: &mut [S]) {
        let jacobian = ::ukcore::emitted::exact_mut::<S, 90>(jacobian, "jacobian");
        let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *::ukcore::emitted::exact::<
            S,
            10,
        >(q, "q");
        let lit = S::from_f64;
        let l = lit(self.l);
        jacobian[0] = lit(2.0) * x_0;
        jacobian[45] = lit(2.0) * y_0;
        jacobian[10] = lit(2.0) * (x_1 - l);
        jacobian[55] = lit(2.0) * y_1;
        jacobian[20] = lit(2.0) * x_2 - lit(4.0) * l;
        jacobian[65] = lit(2.0) * y_2;
        jacobian[30] = lit(2.0) * x_3 - lit(6.0) * l;
        jacobian[75] = lit(2.0) * y_3;
        jacobian[40] = lit(2.0) * x_4 - lit(8.0) * l;
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
    fn residual<S: ::ukcore::Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        let phi = ::ukcore::emitted::exact_mut::<S, 9>(phi, "phi");
        let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *::ukcore::emitted::exact::<
            S,
            10,
        >(q, "q");
        let lit = S::from_f64;
        let l = lit(self.l);
        let sq_l = l * l;
        phi[0] = x_0 * x_0 + y_0 * y_0 - sq_l;
        let x_1_minus_l = x_1 - l;
        phi[1] = y_1 * y_1 - sq_l + x_1_minus_l * x_1_minus_l;
        let phi_2_part = x_2 - lit(2.0) * l;
        phi[2] = y_2 * y_2 - sq_l + phi_2_part * phi_2_part;
        let phi_3_part = x_3 - lit(3.0) * l;
        phi[3] = y_3 * y_3 - sq_l + phi_3_part * phi_3_part;
        let phi_4_part = x_4 - lit(4.0) * l;
        phi[4] = y_4 * y_4 - sq_l + phi_4_part * phi_4_part;
        let x_0_minus_x_1 = x_0 - x_1;
        let y_0_minus_y_1 = y_0 - y_1;
        phi[5] = x_0_minus_x_1 * x_0_minus_x_1 - sq_l + y_0_minus_y_1 * y_0_minus_y_1;
        let x_1_minus_x_2 = x_1 - x_2;
        let y_1_minus_y_2 = y_1 - y_2;
        phi[6] = x_1_minus_x_2 * x_1_minus_x_2 - sq_l + y_1_minus_y_2 * y_1_minus_y_2;
        let x_2_minus_x_3 = x_2 - x_3;
        let y_2_minus_y_3 = y_2 - y_3;
        phi[7] = x_2_minus_x_3 * x_2_minus_x_3 - sq_l + y_2_minus_y_3 * y_2_minus_y_3;
        let x_3_minus_x_4 = x_3 - x_4;
        let y_3_minus_y_4 = y_3 - y_4;
        phi[8] = x_3_minus_x_4 * x_3_minus_x_4 - sq_l + y_3_minus_y_4 * y_3_minus_y_4;
    }
    fn residual_rate<S: ::ukcore::Scalar>(
        &self,
        t: S,
        q: &[S],
        v: &[S],
        rate: &mut [S],
    ) {
        let rate = ::ukcore::emitted::exact_mut::<S, 9>(rate, "rate");
        let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *::ukcore::emitted::exact::<
            S,
            10,
        >(q, "q");
        let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_y_0, dot_y_1, dot_y_2,
        dot_y_3, dot_y_4] = *::ukcore::emitted::exact::<S, 10>(v, "v");
        let lit = S::from_f64;
        let l = lit(self.l);
        rate[0] = lit(2.0) * (x_0 * dot_x_0 + y_0 * dot_y_0);
        rate[1] = lit(2.0) * (y_1 * dot_y_1 + dot_x_1 * (x_1 - l));
        rate[2] = lit(2.0) * (y_2 * dot_y_2 + dot_x_2 * (x_2 - lit(2.0) * l));
        rate[3] = lit(2.0) * (y_3 * dot_y_3 + dot_x_3 * (x_3 - lit(3.0) * l));
        rate[4] = lit(2.0) * (y_4 * dot_y_4 + dot_x_4 * (x_4 - lit(4.0) * l));
        rate[5] = lit(2.0)
            * ((x_0 - x_1) * (dot_x_0 - dot_x_1) + (y_0 - y_1) * (dot_y_0 - dot_y_1));
        rate[6] = lit(2.0)
            * ((x_1 - x_2) * (dot_x_1 - dot_x_2) + (y_1 - y_2) * (dot_y_1 - dot_y_2));
        rate[7] = lit(2.0)
            * ((x_2 - x_3) * (dot_x_2 - dot_x_3) + (y_2 - y_3) * (dot_y_2 - dot_y_3));
        rate[8] = lit(2.0)
            * ((x_3 - x_4) * (dot_x_3 - dot_x_4) + (y_3 - y_4) * (dot_y_3 - dot_y_4));
    }
    fn energy<S: ::ukcore::Scalar>(
        &self,
        t: S,
        q: &[S],
        v: &[S],
    ) -> ::ukcore::Energy<S> {
        let [_, _, _, _, _, y_0, y_1, y_2, y_3, y_4] = *::ukcore::emitted::exact::<
            S,
            10,
        >(q, "q");
        let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_y_0, dot_y_1, dot_y_2,
        dot_y_3, dot_y_4] = *::ukcore::emitted::exact::<S, 10>(v, "v");
        let lit = S::from_f64;
        let m = lit(self.m);
        let g = lit(self.g);
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
            * (m * (sq_dot_x_0 + sq_dot_y_0) + m * (sq_dot_x_1 + sq_dot_y_1)
                + m * (sq_dot_x_2 + sq_dot_y_2) + m * (sq_dot_x_3 + sq_dot_y_3)
                + m * (sq_dot_x_4 + sq_dot_y_4)
                + m * (sq_dot_x_0 + sq_dot_x_1 + dot_x_0 * dot_x_1)
                + m * (sq_dot_y_0 + sq_dot_y_1 + dot_y_0 * dot_y_1)
                + m * (sq_dot_x_1 + sq_dot_x_2 + dot_x_1 * dot_x_2)
                + m * (sq_dot_y_1 + sq_dot_y_2 + dot_y_1 * dot_y_2)
                + m * (sq_dot_x_2 + sq_dot_x_3 + dot_x_2 * dot_x_3)
                + m * (sq_dot_y_2 + sq_dot_y_3 + dot_y_2 * dot_y_3)
                + m * (sq_dot_x_3 + sq_dot_x_4 + dot_x_3 * dot_x_4)
                + m * (sq_dot_y_3 + sq_dot_y_4 + dot_y_3 * dot_y_4));
        let potential = lit(0.5)
            * (m * y_0 * g + m * y_1 * g + m * y_2 * g + m * y_3 * g + m * y_4 * g
                + m * g * (y_0 + y_1) + m * g * (y_1 + y_2) + m * g * (y_2 + y_3)
                + m * g * (y_3 + y_4));
        ::ukcore::Energy {
            kinetic,
            potential,
        }
    }
    fn outputs<S: ::ukcore::Scalar>(&self, t: S, q: &[S], v: &[S], outputs: &mut [S]) {
        let outputs = ::ukcore::emitted::exact_mut::<S, 1>(outputs, "outputs");
        let [x_0, _, _, _, _, y_0, _, _, _, _] = *::ukcore::emitted::exact::<
            S,
            10,
        >(q, "q");
        outputs[0] = x_0.atan2(y_0);
    }
    /// 390 additions, 855 multiplications, 10 divisions, 0 square roots, 0 transcendentals, 12 selections.
    fn acceleration<S: ::ukcore::Scalar>(
        &self,
        t: S,
        q: &[S],
        v: &[S],
        out: &mut [S],
    ) -> S {
        let out = ::ukcore::emitted::exact_mut::<S, 10>(out, "out");
        let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *::ukcore::emitted::exact::<
            S,
            10,
        >(q, "q");
        let [dot_x_0, dot_x_1, dot_x_2, dot_x_3, dot_x_4, dot_y_0, dot_y_1, dot_y_2,
        dot_y_3, dot_y_4] = *::ukcore::emitted::exact::<S, 10>(v, "v");
        let lit = S::from_f64;
        let m = lit(self.m);
        let l = lit(self.l);
        let g = lit(self.g);
        let per_m = m.recip();
        let x_1_minus_l = x_1 - l;
        let x_0_minus_x_1 = x_0 - x_1;
        let y_0_minus_y_1 = y_0 - y_1;
        let x_1_minus_x_2 = x_1 - x_2;
        let y_1_minus_y_2 = y_1 - y_2;
        let x_2_minus_x_3 = x_2 - x_3;
        let y_2_minus_y_3 = y_2 - y_3;
        let x_3_minus_x_4 = x_3 - x_4;
        let y_3_minus_y_4 = y_3 - y_4;
        let acceleration_0_part = lit(2.0) * x_2 - lit(4.0) * l;
        let acceleration_0_part_2 = lit(2.0) * x_3 - lit(6.0) * l;
        let acceleration_0_part_3 = lit(2.0) * x_4 - lit(8.0) * l;
        let dot_x_0_minus_dot_x_1 = dot_x_0 - dot_x_1;
        let dot_y_0_minus_dot_y_1 = dot_y_0 - dot_y_1;
        let dot_x_1_minus_dot_x_2 = dot_x_1 - dot_x_2;
        let dot_y_1_minus_dot_y_2 = dot_y_1 - dot_y_2;
        let dot_x_2_minus_dot_x_3 = dot_x_2 - dot_x_3;
        let dot_y_2_minus_dot_y_3 = dot_y_2 - dot_y_3;
        let dot_x_3_minus_dot_x_4 = dot_x_3 - dot_x_4;
        let dot_y_3_minus_dot_y_4 = dot_y_3 - dot_y_4;
        let acceleration_0_part_4 = lit(0.0009765625) * m;
        let crank_0_by_x_0 = x_0 * per_m;
        let crank_0_by_y_0 = y_0 * per_m;
        let crank_4_by_y_4 = y_4 * per_m;
        let crank_1_by_y_1 = y_1 * per_m;
        let crank_3_by_y_3 = y_3 * per_m;
        let coupler_0_by_x_0 = x_0_minus_x_1 * per_m;
        let crank_4_by_x_4 = acceleration_0_part_3 * per_m;
        let coupler_3_by_x_4 = x_3_minus_x_4 * per_m;
        let coupler_0_by_y_0 = y_0_minus_y_1 * per_m;
        let coupler_3_by_y_4 = y_3_minus_y_4 * per_m;
        let crank_1_by_x_1 = x_1_minus_l * per_m;
        let coupler_1_by_x_1 = x_1_minus_x_2 * per_m;
        let crank_3_by_x_3 = acceleration_0_part_2 * per_m;
        let coupler_2_by_x_3 = x_2_minus_x_3 * per_m;
        let coupler_1_by_y_1 = y_1_minus_y_2 * per_m;
        let coupler_2_by_y_3 = y_2_minus_y_3 * per_m;
        let pivot_crank_0 = lit(1.5) * (x_0 * x_0 * per_m)
            + lit(1.5) * (y_0 * y_0 * per_m)
            + lit(0.06722408026755852) * (m * crank_0_by_x_0 * crank_0_by_x_0)
            + lit(0.06722408026755852) * (m * crank_0_by_y_0 * crank_0_by_y_0);
        let acceleration_0_part_5 = (dot_x_0 * dot_x_0 + dot_y_0 * dot_y_0)
            - lit(1.223076923076923) * (m * g * crank_0_by_y_0);
        let acceleration_0_part_6 = lit(0.04615384615384615)
            * (acceleration_0_part * crank_0_by_x_0)
            + lit(0.0923076923076923) * (y_2 * crank_0_by_y_0);
        let per_pivot_crank_0 = pivot_crank_0.recip();
        let acceleration_0_part_7 = x_0_minus_x_1 + lit(0.25) * (m * coupler_0_by_x_0);
        let acceleration_0_part_8 = x_3_minus_x_4 + lit(0.25) * (m * coupler_3_by_x_4);
        let acceleration_0_part_9 = x_1_minus_x_2
            + lit(0.17391304347826086) * (m * coupler_1_by_x_1);
        let acceleration_0_part_10 = x_2_minus_x_3
            + lit(0.17391304347826086) * (m * coupler_2_by_x_3);
        let acceleration_0_part_11 = y_0_minus_y_1 + lit(0.25) * (m * coupler_0_by_y_0);
        let acceleration_0_part_12 = y_3_minus_y_4 + lit(0.25) * (m * coupler_3_by_y_4);
        let acceleration_0_part_13 = y_1_minus_y_2
            + lit(0.17391304347826086) * (m * coupler_1_by_y_1);
        let acceleration_0_part_14 = y_2_minus_y_3
            + lit(0.17391304347826086) * (m * coupler_2_by_y_3);
        let acceleration_0_part_15 = crank_0_by_y_0 * crank_1_by_y_1
            + crank_0_by_x_0 * crank_1_by_x_1;
        let acceleration_0_part_16 = lit(0.01605351170568562)
            * (crank_0_by_y_0 * crank_3_by_y_3)
            + lit(0.00802675585284281) * (crank_0_by_x_0 * crank_3_by_x_3);
        let acceleration_0_part_17 = lit(0.004013377926421405)
            * (crank_0_by_y_0 * crank_4_by_y_4)
            + lit(0.0020066889632107026) * (crank_0_by_x_0 * crank_4_by_x_4);
        let acceleration_0_part_18 = lit(1.0434782608695652) * (y_1 * y_1 * per_m)
            + lit(1.0434782608695652) * (x_1_minus_l * x_1_minus_l * per_m)
            + lit(0.032107023411371234) * (m * crank_1_by_y_1 * crank_1_by_y_1)
            + lit(0.032107023411371234) * (m * crank_1_by_x_1 * crank_1_by_x_1);
        let acceleration_0_part_19 = (lit(4.246153846153846) * (y_2 * y_2)
            + lit(1.0615384615384615) * (acceleration_0_part * acceleration_0_part))
            * per_m;
        let acceleration_0_part_20 = lit(4.173913043478261) * (y_3 * y_3 * per_m)
            + lit(1.0434782608695652)
                * (acceleration_0_part_2 * acceleration_0_part_2 * per_m)
            + lit(0.12842809364548494) * (m * crank_3_by_y_3 * crank_3_by_y_3)
            + lit(0.032107023411371234) * (m * crank_3_by_x_3 * crank_3_by_x_3);
        let acceleration_0_part_21 = lit(6.0) * (y_4 * y_4 * per_m)
            + lit(1.5) * (acceleration_0_part_3 * acceleration_0_part_3 * per_m)
            + lit(0.2688963210702341) * (m * crank_4_by_y_4 * crank_4_by_y_4)
            + lit(0.06722408026755852) * (m * crank_4_by_x_4 * crank_4_by_x_4);
        let acceleration_0_part_22 = lit(0.2608695652173913)
            * (m * crank_0_by_x_0 * coupler_1_by_x_1)
            + lit(0.2608695652173913) * (m * crank_0_by_y_0 * coupler_1_by_y_1)
            + lit(0.04615384615384615) * (crank_0_by_x_0 * acceleration_0_part_9)
            + lit(0.04615384615384615) * (crank_0_by_y_0 * acceleration_0_part_13);
        let acceleration_0_part_23 = crank_0_by_x_0 * acceleration_0_part_10
            + crank_0_by_y_0 * acceleration_0_part_14;
        let crank_2_by_crank_0 = acceleration_0_part_6 * per_pivot_crank_0;
        let coupler_0_by_x_1 = per_m * acceleration_0_part_7;
        let coupler_3_by_x_3 = per_m * acceleration_0_part_8;
        let coupler_0_by_y_1 = per_m * acceleration_0_part_11;
        let coupler_3_by_y_3 = per_m * acceleration_0_part_12;
        let crank_1_by_crank_0 = m * acceleration_0_part_15 * per_pivot_crank_0;
        let crank_3_by_crank_0 = m * acceleration_0_part_16 * per_pivot_crank_0;
        let crank_4_by_crank_0 = m * acceleration_0_part_17 * per_pivot_crank_0;
        let pivot_crank_1 = lit(0.07230523148510641)
            * (m * m * acceleration_0_part_15 * acceleration_0_part_15
                * per_pivot_crank_0) - acceleration_0_part_18;
        let acceleration_0_part_24 = lit(0.2688963210702341)
            * (m * acceleration_0_part_15 * crank_2_by_crank_0)
            - (lit(0.3692307692307692) * (y_2 * crank_1_by_y_1)
                + lit(0.1846153846153846) * (acceleration_0_part * crank_1_by_x_1));
        let per_pivot_crank_1 = pivot_crank_1.recip();
        let acceleration_0_part_25 = lit(1.5) * (x_0 * coupler_0_by_x_0)
            + lit(1.5) * (y_0 * coupler_0_by_y_0)
            + lit(0.2688963210702341) * (m * crank_0_by_x_0 * coupler_0_by_x_1)
            + lit(0.2688963210702341) * (m * crank_0_by_y_0 * coupler_0_by_y_1);
        let acceleration_0_part_26 = crank_0_by_x_0 * coupler_3_by_x_3
            + crank_0_by_y_0 * coupler_3_by_y_3;
        let coupler_1_by_crank_0 = acceleration_0_part_22 * per_pivot_crank_0;
        let coupler_2_by_crank_0 = acceleration_0_part_23 * per_pivot_crank_0;
        let acceleration_0_part_27 = ((dot_x_1 * dot_x_1 + dot_y_1 * dot_y_1)
            - lit(1.1076923076923078) * (m * g * crank_1_by_y_1))
            + lit(0.2688963210702341) * (acceleration_0_part_5 * crank_1_by_crank_0);
        let acceleration_0_part_28 = (lit(0.06421404682274248)
            * (crank_1_by_y_1 * crank_3_by_y_3)
            + lit(0.03210702341137124) * (crank_1_by_x_1 * crank_3_by_x_3))
            - lit(0.2688963210702341) * (acceleration_0_part_15 * crank_3_by_crank_0);
        let acceleration_0_part_29 = (lit(0.01605351170568562)
            * (crank_4_by_y_4 * crank_1_by_y_1)
            + lit(0.00802675585284281) * (crank_4_by_x_4 * crank_1_by_x_1))
            - lit(0.2688963210702341) * (acceleration_0_part_15 * crank_4_by_crank_0);
        let acceleration_0_part_30 = lit(1.5) * (x_0_minus_x_1 * x_0_minus_x_1 * per_m)
            + lit(1.5) * (y_0_minus_y_1 * y_0_minus_y_1 * per_m)
            + lit(1.0434782608695652)
                * (per_m * acceleration_0_part_7 * acceleration_0_part_7)
            + lit(1.0434782608695652)
                * (per_m * acceleration_0_part_11 * acceleration_0_part_11)
            + lit(0.032107023411371234) * (m * coupler_0_by_x_1 * coupler_0_by_x_1)
            + lit(0.032107023411371234) * (m * coupler_0_by_y_1 * coupler_0_by_y_1);
        let acceleration_0_part_31 = per_m
            * (lit(1.0434782608695652) * (x_1_minus_x_2 * x_1_minus_x_2)
                + lit(1.0434782608695652) * (y_1_minus_y_2 * y_1_minus_y_2)
                + lit(1.0615384615384615)
                    * (acceleration_0_part_9 * acceleration_0_part_9)
                + lit(1.0615384615384615)
                    * (acceleration_0_part_13 * acceleration_0_part_13));
        let acceleration_0_part_32 = per_m
            * (lit(1.0434782608695652) * (x_2_minus_x_3 * x_2_minus_x_3)
                + lit(1.0434782608695652) * (y_2_minus_y_3 * y_2_minus_y_3)
                + lit(1.0615384615384615)
                    * (acceleration_0_part_10 * acceleration_0_part_10)
                + lit(1.0615384615384615)
                    * (acceleration_0_part_14 * acceleration_0_part_14));
        let acceleration_0_part_33 = lit(1.5) * (x_3_minus_x_4 * x_3_minus_x_4 * per_m)
            + lit(1.5) * (y_3_minus_y_4 * y_3_minus_y_4 * per_m)
            + lit(1.0434782608695652)
                * (per_m * acceleration_0_part_8 * acceleration_0_part_8)
            + lit(1.0434782608695652)
                * (per_m * acceleration_0_part_12 * acceleration_0_part_12)
            + lit(0.032107023411371234) * (m * coupler_3_by_x_3 * coupler_3_by_x_3)
            + lit(0.032107023411371234) * (m * coupler_3_by_y_3 * coupler_3_by_y_3);
        let acceleration_0_part_34 = lit(0.2688963210702341)
            * (m * acceleration_0_part_15 * coupler_1_by_crank_0)
            - (lit(1.0434782608695652) * (x_1_minus_l * coupler_1_by_x_1)
                + lit(1.0434782608695652) * (y_1 * coupler_1_by_y_1)
                + lit(0.1846153846153846) * (crank_1_by_x_1 * acceleration_0_part_9)
                + lit(0.1846153846153846) * (crank_1_by_y_1 * acceleration_0_part_13));
        let acceleration_0_part_35 = lit(0.012410599434010803)
            * (m * acceleration_0_part_15 * coupler_2_by_crank_0)
            - lit(0.1846153846153846)
                * (crank_1_by_x_1 * acceleration_0_part_10
                    + crank_1_by_y_1 * acceleration_0_part_14);
        let crank_2_by_crank_1 = acceleration_0_part_24 * per_pivot_crank_1;
        let coupler_0_by_crank_0 = per_pivot_crank_0 * acceleration_0_part_25;
        let coupler_3_by_crank_0 = m * per_pivot_crank_0 * acceleration_0_part_26;
        let crank_3_by_crank_1 = m * acceleration_0_part_28 * per_pivot_crank_1;
        let crank_4_by_crank_1 = m * acceleration_0_part_29 * per_pivot_crank_1;
        let pivot_crank_2 = acceleration_0_part_6 * acceleration_0_part_6
            * per_pivot_crank_0 - acceleration_0_part_19
            - acceleration_0_part_24 * acceleration_0_part_24 * per_pivot_crank_1;
        let per_pivot_crank_2 = pivot_crank_2.recip();
        let acceleration_0_part_36 = acceleration_0_part_5 * crank_2_by_crank_0
            - (lit(2.0) * (dot_x_2 * dot_x_2 + dot_y_2 * dot_y_2)
                - lit(2.261538461538461) * (y_2 * g))
            - acceleration_0_part_27 * crank_2_by_crank_1;
        let acceleration_0_part_37 = lit(0.2688963210702341)
            * (m * acceleration_0_part_15 * coupler_0_by_crank_0)
            - (lit(1.0434782608695652) * (x_1_minus_l * coupler_0_by_x_1)
                + lit(0.03210702341137124) * (m * crank_1_by_x_1 * coupler_0_by_x_1)
                + lit(1.0434782608695652) * (y_1 * coupler_0_by_y_1)
                + lit(0.03210702341137124) * (m * crank_1_by_y_1 * coupler_0_by_y_1));
        let acceleration_0_part_38 = lit(0.03210702341137124)
            * (crank_1_by_x_1 * coupler_3_by_x_3 + crank_1_by_y_1 * coupler_3_by_y_3)
            - lit(0.002158365118958401)
                * (acceleration_0_part_15 * coupler_3_by_crank_0);
        let coupler_1_by_crank_1 = acceleration_0_part_34 * per_pivot_crank_1;
        let coupler_2_by_crank_1 = acceleration_0_part_35 * per_pivot_crank_1;
        let acceleration_0_part_39 = acceleration_0_part_6 * crank_3_by_crank_0
            - (lit(0.7384615384615385) * (y_2 * crank_3_by_y_3)
                + lit(0.18461538461538463) * (acceleration_0_part * crank_3_by_x_3))
            + acceleration_0_part_24 * crank_3_by_crank_1;
        let acceleration_0_part_40 = acceleration_0_part_6 * crank_4_by_crank_0
            - (lit(0.18461538461538463) * (y_2 * crank_4_by_y_4)
                + lit(0.046153846153846156) * (acceleration_0_part * crank_4_by_x_4))
            + acceleration_0_part_24 * crank_4_by_crank_1;
        let acceleration_0_part_41 = acceleration_0_part_6 * coupler_1_by_crank_0
            - per_m
                * (lit(1.0615384615384615)
                    * (acceleration_0_part * acceleration_0_part_9)
                    + lit(2.123076923076923) * (y_2 * acceleration_0_part_13))
            - acceleration_0_part_24 * coupler_1_by_crank_1;
        let acceleration_0_part_42 = lit(0.04615384615384615)
            * (acceleration_0_part_6 * coupler_2_by_crank_0)
            - per_m
                * (lit(1.0615384615384615)
                    * (acceleration_0_part * acceleration_0_part_10)
                    + lit(2.123076923076923) * (y_2 * acceleration_0_part_14))
            - acceleration_0_part_24 * coupler_2_by_crank_1;
        let coupler_0_by_crank_1 = per_pivot_crank_1 * acceleration_0_part_37;
        let coupler_3_by_crank_1 = m * per_pivot_crank_1 * acceleration_0_part_38;
        let crank_3_by_crank_2 = acceleration_0_part_39 * per_pivot_crank_2;
        let crank_4_by_crank_2 = acceleration_0_part_40 * per_pivot_crank_2;
        let pivot_crank_3 = m * m * acceleration_0_part_16 * acceleration_0_part_16
            * per_pivot_crank_0 - acceleration_0_part_20
            - m * m * acceleration_0_part_28 * acceleration_0_part_28 * per_pivot_crank_1
            - acceleration_0_part_39 * acceleration_0_part_39 * per_pivot_crank_2;
        let per_pivot_crank_3 = pivot_crank_3.recip();
        let acceleration_0_part_43 = acceleration_0_part_6 * coupler_0_by_crank_0
            - (lit(0.18461538461538463) * (acceleration_0_part * coupler_0_by_x_1)
                + lit(0.36923076923076925) * (y_2 * coupler_0_by_y_1))
            - acceleration_0_part_24 * coupler_0_by_crank_1;
        let acceleration_0_part_44 = lit(0.00802675585284281)
            * (acceleration_0_part_6 * coupler_3_by_crank_0)
            - (lit(0.18461538461538463) * (acceleration_0_part * coupler_3_by_x_3)
                + lit(0.36923076923076925) * (y_2 * coupler_3_by_y_3))
            + acceleration_0_part_24 * coupler_3_by_crank_1;
        let coupler_1_by_crank_2 = per_pivot_crank_2 * acceleration_0_part_41;
        let coupler_2_by_crank_2 = per_pivot_crank_2 * acceleration_0_part_42;
        let acceleration_0_part_45 = (lit(2.0) * (dot_x_3 * dot_x_3 + dot_y_3 * dot_y_3)
            - lit(2.2153846153846155) * (m * g * crank_3_by_y_3))
            + acceleration_0_part_5 * crank_3_by_crank_0
            + acceleration_0_part_27 * crank_3_by_crank_1
            - acceleration_0_part_36 * crank_3_by_crank_2;
        let acceleration_0_part_46 = m * acceleration_0_part_16 * crank_4_by_crank_0
            - (lit(1.0434782608695652) * (y_3 * crank_4_by_y_4)
                + lit(0.03210702341137124) * (m * crank_4_by_y_4 * crank_3_by_y_3)
                + lit(0.2608695652173913) * (acceleration_0_part_2 * crank_4_by_x_4)
                + lit(0.00802675585284281) * (m * crank_4_by_x_4 * crank_3_by_x_3))
            - m * acceleration_0_part_28 * crank_4_by_crank_1
            - acceleration_0_part_39 * crank_4_by_crank_2;
        let acceleration_0_part_47 = m * acceleration_0_part_16 * coupler_1_by_crank_0
            - (lit(0.1846153846153846) * (crank_3_by_x_3 * acceleration_0_part_9)
                + lit(0.3692307692307692) * (crank_3_by_y_3 * acceleration_0_part_13))
            + m * acceleration_0_part_28 * coupler_1_by_crank_1
            - acceleration_0_part_39 * coupler_1_by_crank_2;
        let acceleration_0_part_48 = lit(0.04615384615384615)
            * (m * acceleration_0_part_16 * coupler_2_by_crank_0)
            - (lit(1.0434782608695652) * (acceleration_0_part_2 * coupler_2_by_x_3)
                + lit(2.0869565217391304) * (y_3 * coupler_2_by_y_3)
                + lit(0.1846153846153846) * (crank_3_by_x_3 * acceleration_0_part_10)
                + lit(0.3692307692307692) * (crank_3_by_y_3 * acceleration_0_part_14))
            + m * acceleration_0_part_28 * coupler_2_by_crank_1
            - acceleration_0_part_39 * coupler_2_by_crank_2;
        let coupler_0_by_crank_2 = per_pivot_crank_2 * acceleration_0_part_43;
        let coupler_3_by_crank_2 = per_pivot_crank_2 * acceleration_0_part_44;
        let crank_4_by_crank_3 = acceleration_0_part_46 * per_pivot_crank_3;
        let pivot_crank_4 = m * m * acceleration_0_part_17 * acceleration_0_part_17
            * per_pivot_crank_0 - acceleration_0_part_21
            - m * m * acceleration_0_part_29 * acceleration_0_part_29 * per_pivot_crank_1
            - acceleration_0_part_40 * acceleration_0_part_40 * per_pivot_crank_2
            - acceleration_0_part_46 * acceleration_0_part_46 * per_pivot_crank_3;
        let per_pivot_crank_4 = pivot_crank_4.recip();
        let acceleration_0_part_49 = m * acceleration_0_part_16 * coupler_0_by_crank_0
            - m
                * (lit(0.03210702341137124) * (crank_3_by_x_3 * coupler_0_by_x_1)
                    + lit(0.06421404682274248) * (crank_3_by_y_3 * coupler_0_by_y_1))
            + m * acceleration_0_part_28 * coupler_0_by_crank_1
            - acceleration_0_part_39 * coupler_0_by_crank_2;
        let acceleration_0_part_50 = lit(0.00802675585284281)
            * (m * acceleration_0_part_16 * coupler_3_by_crank_0)
            - (lit(1.0434782608695652) * (acceleration_0_part_2 * coupler_3_by_x_3)
                + lit(0.03210702341137124) * (m * crank_3_by_x_3 * coupler_3_by_x_3)
                + lit(2.0869565217391304) * (y_3 * coupler_3_by_y_3)
                + lit(0.06421404682274248) * (m * crank_3_by_y_3 * coupler_3_by_y_3))
            - m * acceleration_0_part_28 * coupler_3_by_crank_1
            - acceleration_0_part_39 * coupler_3_by_crank_2;
        let coupler_1_by_crank_3 = acceleration_0_part_47 * per_pivot_crank_3;
        let coupler_2_by_crank_3 = acceleration_0_part_48 * per_pivot_crank_3;
        let acceleration_0_part_51 = acceleration_0_part_5 * crank_4_by_crank_0
            - (lit(2.0) * (dot_x_4 * dot_x_4 + dot_y_4 * dot_y_4)
                - lit(2.446153846153846) * (m * g * crank_4_by_y_4))
            + acceleration_0_part_27 * crank_4_by_crank_1
            - acceleration_0_part_36 * crank_4_by_crank_2
            - acceleration_0_part_45 * crank_4_by_crank_3;
        let acceleration_0_part_52 = m * acceleration_0_part_17 * coupler_1_by_crank_0
            - (lit(0.04615384615384615) * (crank_4_by_x_4 * acceleration_0_part_9)
                + lit(0.0923076923076923) * (crank_4_by_y_4 * acceleration_0_part_13))
            + m * acceleration_0_part_29 * coupler_1_by_crank_1
            - acceleration_0_part_40 * coupler_1_by_crank_2
            - acceleration_0_part_46 * coupler_1_by_crank_3;
        let acceleration_0_part_53 = lit(0.04615384615384615)
            * (m * acceleration_0_part_17 * coupler_2_by_crank_0)
            - (lit(0.2608695652173913) * (m * crank_4_by_x_4 * coupler_2_by_x_3)
                + lit(0.5217391304347826) * (m * crank_4_by_y_4 * coupler_2_by_y_3)
                + lit(0.04615384615384615) * (crank_4_by_x_4 * acceleration_0_part_10)
                + lit(0.0923076923076923) * (crank_4_by_y_4 * acceleration_0_part_14))
            + m * acceleration_0_part_29 * coupler_2_by_crank_1
            - acceleration_0_part_40 * coupler_2_by_crank_2
            - acceleration_0_part_46 * coupler_2_by_crank_3;
        let coupler_0_by_crank_3 = per_pivot_crank_3 * acceleration_0_part_49;
        let coupler_3_by_crank_3 = per_pivot_crank_3 * acceleration_0_part_50;
        let acceleration_0_part_54 = m * acceleration_0_part_17 * coupler_0_by_crank_0
            - m
                * (lit(0.00802675585284281) * (crank_4_by_x_4 * coupler_0_by_x_1)
                    + lit(0.01605351170568562) * (crank_4_by_y_4 * coupler_0_by_y_1))
            + m * acceleration_0_part_29 * coupler_0_by_crank_1
            - acceleration_0_part_40 * coupler_0_by_crank_2
            - acceleration_0_part_46 * coupler_0_by_crank_3;
        let acceleration_0_part_55 = lit(0.00802675585284281)
            * (m * acceleration_0_part_17 * coupler_3_by_crank_0)
            - (lit(1.5) * (acceleration_0_part_3 * coupler_3_by_x_4)
                + lit(3.0) * (y_4 * coupler_3_by_y_4)
                + lit(0.2688963210702341) * (m * crank_4_by_x_4 * coupler_3_by_x_3)
                + lit(0.5377926421404682) * (m * crank_4_by_y_4 * coupler_3_by_y_3))
            - m * acceleration_0_part_29 * coupler_3_by_crank_1
            - acceleration_0_part_40 * coupler_3_by_crank_2
            - acceleration_0_part_46 * coupler_3_by_crank_3;
        let coupler_1_by_crank_4 = acceleration_0_part_52 * per_pivot_crank_4;
        let coupler_2_by_crank_4 = acceleration_0_part_53 * per_pivot_crank_4;
        let acceleration_0_part_56 = acceleration_0_part_25 * coupler_1_by_crank_0
            - (lit(1.0434782608695652) * (coupler_1_by_x_1 * acceleration_0_part_7)
                + lit(1.0434782608695652) * (coupler_1_by_y_1 * acceleration_0_part_11)
                + lit(0.1846153846153846) * (acceleration_0_part_9 * coupler_0_by_x_1)
                + lit(0.1846153846153846) * (acceleration_0_part_13 * coupler_0_by_y_1))
            - acceleration_0_part_37 * coupler_1_by_crank_1
            - acceleration_0_part_43 * coupler_1_by_crank_2
            - acceleration_0_part_49 * coupler_1_by_crank_3
            - acceleration_0_part_54 * coupler_1_by_crank_4;
        let acceleration_0_part_57 = lit(0.04615384615384615)
            * (acceleration_0_part_25 * coupler_2_by_crank_0)
            - lit(0.1846153846153846)
                * (acceleration_0_part_10 * coupler_0_by_x_1
                    + acceleration_0_part_14 * coupler_0_by_y_1)
            - acceleration_0_part_37 * coupler_2_by_crank_1
            - acceleration_0_part_43 * coupler_2_by_crank_2
            - acceleration_0_part_49 * coupler_2_by_crank_3
            - acceleration_0_part_54 * coupler_2_by_crank_4;
        let coupler_0_by_crank_4 = per_pivot_crank_4 * acceleration_0_part_54;
        let coupler_3_by_crank_4 = per_pivot_crank_4 * acceleration_0_part_55;
        let pivot_coupler_0 = per_pivot_crank_0 * acceleration_0_part_25
            * acceleration_0_part_25 - acceleration_0_part_30
            - per_pivot_crank_1 * acceleration_0_part_37 * acceleration_0_part_37
            - per_pivot_crank_2 * acceleration_0_part_43 * acceleration_0_part_43
            - per_pivot_crank_3 * acceleration_0_part_49 * acceleration_0_part_49
            - per_pivot_crank_4 * acceleration_0_part_54 * acceleration_0_part_54;
        let per_pivot_coupler_0 = pivot_coupler_0.recip();
        let acceleration_0_part_58 = acceleration_0_part_5 * coupler_0_by_crank_0
            - ((dot_x_0_minus_dot_x_1 * dot_x_0_minus_dot_x_1
                + dot_y_0_minus_dot_y_1 * dot_y_0_minus_dot_y_1)
                - lit(1.5) * (m * g * coupler_0_by_y_0)
                + lit(1.1076923076923078) * (m * g * coupler_0_by_y_1))
            - acceleration_0_part_27 * coupler_0_by_crank_1
            - acceleration_0_part_36 * coupler_0_by_crank_2
            - acceleration_0_part_45 * coupler_0_by_crank_3
            - acceleration_0_part_51 * coupler_0_by_crank_4;
        let acceleration_0_part_59 = lit(0.00802675585284281)
            * (acceleration_0_part_25 * coupler_3_by_crank_0)
            - lit(0.03210702341137124)
                * (m
                    * (coupler_0_by_x_1 * coupler_3_by_x_3
                        + coupler_0_by_y_1 * coupler_3_by_y_3))
            + acceleration_0_part_37 * coupler_3_by_crank_1
            - acceleration_0_part_43 * coupler_3_by_crank_2
            - acceleration_0_part_49 * coupler_3_by_crank_3
            - acceleration_0_part_54 * coupler_3_by_crank_4;
        let coupler_1_by_coupler_0 = acceleration_0_part_56 * per_pivot_coupler_0;
        let coupler_2_by_coupler_0 = acceleration_0_part_57 * per_pivot_coupler_0;
        let coupler_3_by_coupler_0 = acceleration_0_part_59 * per_pivot_coupler_0;
        let pivot_coupler_1 = acceleration_0_part_22 * acceleration_0_part_22
            * per_pivot_crank_0 - acceleration_0_part_31
            - acceleration_0_part_34 * acceleration_0_part_34 * per_pivot_crank_1
            - per_pivot_crank_2 * acceleration_0_part_41 * acceleration_0_part_41
            - acceleration_0_part_47 * acceleration_0_part_47 * per_pivot_crank_3
            - acceleration_0_part_52 * acceleration_0_part_52 * per_pivot_crank_4
            - acceleration_0_part_56 * acceleration_0_part_56 * per_pivot_coupler_0;
        let per_pivot_coupler_1 = pivot_coupler_1.recip();
        let acceleration_0_part_60 = ((dot_x_1_minus_dot_x_2 * dot_x_1_minus_dot_x_2
            + dot_y_1_minus_dot_y_2 * dot_y_1_minus_dot_y_2)
            - lit(1.3043478260869565) * (m * g * coupler_1_by_y_1)
            + lit(1.1307692307692305) * (g * acceleration_0_part_13))
            + acceleration_0_part_5 * coupler_1_by_crank_0
            - acceleration_0_part_27 * coupler_1_by_crank_1
            - acceleration_0_part_36 * coupler_1_by_crank_2
            - acceleration_0_part_45 * coupler_1_by_crank_3
            - acceleration_0_part_51 * coupler_1_by_crank_4
            - acceleration_0_part_58 * coupler_1_by_coupler_0;
        let acceleration_0_part_61 = lit(0.04615384615384615)
            * (acceleration_0_part_22 * coupler_2_by_crank_0)
            - lit(1.0615384615384615)
                * (per_m
                    * (acceleration_0_part_9 * acceleration_0_part_10
                        + acceleration_0_part_13 * acceleration_0_part_14))
            - acceleration_0_part_34 * coupler_2_by_crank_1
            - acceleration_0_part_41 * coupler_2_by_crank_2
            - acceleration_0_part_47 * coupler_2_by_crank_3
            - acceleration_0_part_52 * coupler_2_by_crank_4
            - acceleration_0_part_56 * coupler_2_by_coupler_0;
        let acceleration_0_part_62 = lit(0.00802675585284281)
            * (acceleration_0_part_22 * coupler_3_by_crank_0)
            - lit(0.18461538461538463)
                * (acceleration_0_part_9 * coupler_3_by_x_3
                    + acceleration_0_part_13 * coupler_3_by_y_3)
            + acceleration_0_part_34 * coupler_3_by_crank_1
            - acceleration_0_part_41 * coupler_3_by_crank_2
            - acceleration_0_part_47 * coupler_3_by_crank_3
            - acceleration_0_part_52 * coupler_3_by_crank_4
            - acceleration_0_part_56 * coupler_3_by_coupler_0;
        let coupler_2_by_coupler_1 = acceleration_0_part_61 * per_pivot_coupler_1;
        let coupler_3_by_coupler_1 = acceleration_0_part_62 * per_pivot_coupler_1;
        let pivot_coupler_2 = lit(0.002130177514792899)
            * (acceleration_0_part_23 * acceleration_0_part_23 * per_pivot_crank_0)
            - acceleration_0_part_32
            - acceleration_0_part_35 * acceleration_0_part_35 * per_pivot_crank_1
            - per_pivot_crank_2 * acceleration_0_part_42 * acceleration_0_part_42
            - acceleration_0_part_48 * acceleration_0_part_48 * per_pivot_crank_3
            - acceleration_0_part_53 * acceleration_0_part_53 * per_pivot_crank_4
            - acceleration_0_part_57 * acceleration_0_part_57 * per_pivot_coupler_0
            - acceleration_0_part_61 * acceleration_0_part_61 * per_pivot_coupler_1;
        let per_pivot_coupler_2 = pivot_coupler_2.recip();
        let acceleration_0_part_63 = lit(0.04615384615384615)
            * (acceleration_0_part_5 * coupler_2_by_crank_0)
            - ((dot_x_2_minus_dot_x_3 * dot_x_2_minus_dot_x_3
                + dot_y_2_minus_dot_y_3 * dot_y_2_minus_dot_y_3)
                + lit(1.3043478260869565) * (m * g * coupler_2_by_y_3)
                - lit(1.1307692307692305) * (g * acceleration_0_part_14))
            - acceleration_0_part_27 * coupler_2_by_crank_1
            - acceleration_0_part_36 * coupler_2_by_crank_2
            - acceleration_0_part_45 * coupler_2_by_crank_3
            - acceleration_0_part_51 * coupler_2_by_crank_4
            - acceleration_0_part_58 * coupler_2_by_coupler_0
            - acceleration_0_part_60 * coupler_2_by_coupler_1;
        let acceleration_0_part_64 = lit(0.0003704656547465912)
            * (acceleration_0_part_23 * coupler_3_by_crank_0)
            - (lit(1.0434782608695652) * (x_2_minus_x_3 * coupler_3_by_x_3)
                + lit(0.18461538461538463) * (acceleration_0_part_10 * coupler_3_by_x_3)
                + lit(1.0434782608695652) * (y_2_minus_y_3 * coupler_3_by_y_3)
                + lit(0.18461538461538463) * (acceleration_0_part_14 * coupler_3_by_y_3))
            + acceleration_0_part_35 * coupler_3_by_crank_1
            - acceleration_0_part_42 * coupler_3_by_crank_2
            - acceleration_0_part_48 * coupler_3_by_crank_3
            - acceleration_0_part_53 * coupler_3_by_crank_4
            - acceleration_0_part_57 * coupler_3_by_coupler_0
            - acceleration_0_part_61 * coupler_3_by_coupler_1;
        let coupler_3_by_coupler_2 = acceleration_0_part_64 * per_pivot_coupler_2;
        let pivot_coupler_3 = lit(0.00006442880952114631)
            * (m * m * per_pivot_crank_0 * acceleration_0_part_26
                * acceleration_0_part_26) - acceleration_0_part_33
            - m * m * per_pivot_crank_1 * acceleration_0_part_38 * acceleration_0_part_38
            - per_pivot_crank_2 * acceleration_0_part_44 * acceleration_0_part_44
            - per_pivot_crank_3 * acceleration_0_part_50 * acceleration_0_part_50
            - per_pivot_crank_4 * acceleration_0_part_55 * acceleration_0_part_55
            - acceleration_0_part_59 * acceleration_0_part_59 * per_pivot_coupler_0
            - acceleration_0_part_62 * acceleration_0_part_62 * per_pivot_coupler_1
            - acceleration_0_part_64 * acceleration_0_part_64 * per_pivot_coupler_2;
        let per_pivot_coupler_3 = pivot_coupler_3.recip();
        let acceleration_0_part_65 = ((dot_x_3_minus_dot_x_4 * dot_x_3_minus_dot_x_4
            + dot_y_3_minus_dot_y_4 * dot_y_3_minus_dot_y_4)
            + lit(1.5) * (m * g * coupler_3_by_y_4)
            - lit(1.1076923076923078) * (m * g * coupler_3_by_y_3))
            + lit(0.00802675585284281) * (acceleration_0_part_5 * coupler_3_by_crank_0)
            + acceleration_0_part_27 * coupler_3_by_crank_1
            - acceleration_0_part_36 * coupler_3_by_crank_2
            - acceleration_0_part_45 * coupler_3_by_crank_3
            - acceleration_0_part_51 * coupler_3_by_crank_4
            - acceleration_0_part_58 * coupler_3_by_coupler_0
            - acceleration_0_part_60 * coupler_3_by_coupler_1
            - acceleration_0_part_63 * coupler_3_by_coupler_2;
        let safe = S::select_le(
            -pivot_coupler_3,
            lit(0.0009765625) * acceleration_0_part_33,
            lit(0.0),
            S::select_le(
                -pivot_coupler_2,
                lit(0.0009765625) * acceleration_0_part_32,
                lit(0.0),
                S::select_le(
                    -pivot_coupler_1,
                    lit(0.0009765625) * acceleration_0_part_31,
                    lit(0.0),
                    S::select_le(
                        -pivot_coupler_0,
                        lit(0.0009765625) * acceleration_0_part_30,
                        lit(0.0),
                        S::select_le(
                            -pivot_crank_4,
                            lit(0.0009765625) * acceleration_0_part_21,
                            lit(0.0),
                            S::select_le(
                                -pivot_crank_3,
                                lit(0.0009765625) * acceleration_0_part_20,
                                lit(0.0),
                                S::select_le(
                                    -pivot_crank_2,
                                    lit(0.0009765625) * acceleration_0_part_19,
                                    lit(0.0),
                                    S::select_le(
                                        -pivot_crank_1,
                                        lit(0.0009765625) * acceleration_0_part_18,
                                        lit(0.0),
                                        S::select_le(
                                            pivot_crank_0,
                                            lit(0.0),
                                            lit(0.0),
                                            S::select_le(
                                                lit(0.9420289855072463) * m,
                                                acceleration_0_part_4,
                                                lit(0.0),
                                                S::select_le(
                                                    lit(0.9583333333333334) * m,
                                                    acceleration_0_part_4,
                                                    lit(0.0),
                                                    S::select_le(
                                                        lit(0.6666666666666666) * m,
                                                        lit(0.0),
                                                        lit(0.0),
                                                        lit(1.0),
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
        let safe_part = coupler_3_by_y_3 * acceleration_0_part_65 * per_pivot_coupler_3;
        let safe_part_2 = coupler_3_by_x_3 * acceleration_0_part_65
            * per_pivot_coupler_3;
        let lambda_coupler_2 = acceleration_0_part_63 * per_pivot_coupler_2
            - coupler_3_by_coupler_2 * acceleration_0_part_65 * per_pivot_coupler_3;
        let lambda_coupler_1 = acceleration_0_part_60 * per_pivot_coupler_1
            - coupler_3_by_coupler_1 * acceleration_0_part_65 * per_pivot_coupler_3
            - coupler_2_by_coupler_1 * lambda_coupler_2;
        let lambda_coupler_0 = acceleration_0_part_58 * per_pivot_coupler_0
            - coupler_3_by_coupler_0 * acceleration_0_part_65 * per_pivot_coupler_3
            - coupler_2_by_coupler_0 * lambda_coupler_2
            - coupler_1_by_coupler_0 * lambda_coupler_1;
        let safe_part_3 = coupler_0_by_y_1 * lambda_coupler_0;
        let safe_part_4 = coupler_0_by_x_1 * lambda_coupler_0;
        let lambda_crank_4 = acceleration_0_part_51 * per_pivot_crank_4
            - coupler_3_by_crank_4 * acceleration_0_part_65 * per_pivot_coupler_3
            - coupler_2_by_crank_4 * lambda_coupler_2
            - coupler_1_by_crank_4 * lambda_coupler_1
            - coupler_0_by_crank_4 * lambda_coupler_0;
        let crank_4_by_y_4_lambda_crank_4 = crank_4_by_y_4 * lambda_crank_4;
        let crank_4_by_x_4_lambda_crank_4 = crank_4_by_x_4 * lambda_crank_4;
        let lambda_crank_3 = acceleration_0_part_45 * per_pivot_crank_3
            - coupler_3_by_crank_3 * acceleration_0_part_65 * per_pivot_coupler_3
            - coupler_2_by_crank_3 * lambda_coupler_2
            - coupler_1_by_crank_3 * lambda_coupler_1
            - coupler_0_by_crank_3 * lambda_coupler_0
            - crank_4_by_crank_3 * lambda_crank_4;
        let crank_3_by_y_3_lambda_crank_3 = crank_3_by_y_3 * lambda_crank_3;
        let crank_3_by_x_3_lambda_crank_3 = crank_3_by_x_3 * lambda_crank_3;
        let lambda_crank_2 = acceleration_0_part_36 * per_pivot_crank_2
            - coupler_3_by_crank_2 * acceleration_0_part_65 * per_pivot_coupler_3
            - coupler_2_by_crank_2 * lambda_coupler_2
            - coupler_1_by_crank_2 * lambda_coupler_1
            - coupler_0_by_crank_2 * lambda_coupler_0
            - crank_4_by_crank_2 * lambda_crank_4 - crank_3_by_crank_2 * lambda_crank_3;
        let lambda_crank_1 = acceleration_0_part_27 * per_pivot_crank_1
            + coupler_3_by_crank_1 * acceleration_0_part_65 * per_pivot_coupler_3
            - coupler_2_by_crank_1 * lambda_coupler_2
            - coupler_1_by_crank_1 * lambda_coupler_1
            - coupler_0_by_crank_1 * lambda_coupler_0
            + crank_4_by_crank_1 * lambda_crank_4 + crank_3_by_crank_1 * lambda_crank_3
            - crank_2_by_crank_1 * lambda_crank_2;
        let crank_1_by_y_1_lambda_crank_1 = crank_1_by_y_1 * lambda_crank_1;
        let crank_1_by_x_1_lambda_crank_1 = crank_1_by_x_1 * lambda_crank_1;
        let lambda_crank_0 = acceleration_0_part_5 * per_pivot_crank_0
            - lit(0.00802675585284281)
                * (coupler_3_by_crank_0 * acceleration_0_part_65 * per_pivot_coupler_3)
            - lit(0.04615384615384615) * (coupler_2_by_crank_0 * lambda_coupler_2)
            - coupler_1_by_crank_0 * lambda_coupler_1
            - coupler_0_by_crank_0 * lambda_coupler_0
            - crank_4_by_crank_0 * lambda_crank_4 - crank_3_by_crank_0 * lambda_crank_3
            - crank_2_by_crank_0 * lambda_crank_2
            - lit(0.2688963210702341) * (crank_1_by_crank_0 * lambda_crank_1);
        let crank_0_by_y_0_lambda_crank_0 = crank_0_by_y_0 * lambda_crank_0;
        let crank_0_by_x_0_lambda_crank_0 = crank_0_by_x_0 * lambda_crank_0;
        let safe_part_5 = lit(1.1307692307692307) * g
            + lit(0.18461538461538463) * safe_part
            + lit(1.0615384615384615)
                * (per_m * acceleration_0_part_14 * lambda_coupler_2)
            + lit(0.18461538461538463) * safe_part_3
            + lit(1.0615384615384615)
                * (per_m * acceleration_0_part_13 * lambda_coupler_1)
            + lit(0.09230769230769231) * crank_4_by_y_4_lambda_crank_4
            + lit(0.36923076923076925) * crank_3_by_y_3_lambda_crank_3
            + lit(0.18461538461538463) * crank_1_by_y_1_lambda_crank_1
            + lit(2.123076923076923) * (y_2 * per_m * lambda_crank_2)
            + lit(0.046153846153846156) * crank_0_by_y_0_lambda_crank_0;
        let safe_part_6 = lit(0.18461538461538463) * safe_part_2
            + lit(1.0615384615384615)
                * (per_m * acceleration_0_part_10 * lambda_coupler_2)
            + lit(0.18461538461538463) * safe_part_4
            + lit(1.0615384615384615)
                * (per_m * acceleration_0_part_9 * lambda_coupler_1)
            + lit(0.046153846153846156) * crank_4_by_x_4_lambda_crank_4
            + lit(0.18461538461538463) * crank_3_by_x_3_lambda_crank_3
            + lit(0.18461538461538463) * crank_1_by_x_1_lambda_crank_1
            + lit(1.0615384615384615) * (acceleration_0_part * per_m * lambda_crank_2)
            + lit(0.046153846153846156) * crank_0_by_x_0_lambda_crank_0;
        let safe_part_7 = lit(1.3043478260869565) * g
            - lit(1.0434782608695652) * safe_part
            - lit(1.0434782608695652) * (coupler_2_by_y_3 * lambda_coupler_2)
            - lit(0.5217391304347826) * crank_4_by_y_4_lambda_crank_4
            - lit(2.0869565217391304) * crank_3_by_y_3_lambda_crank_3
            - lit(0.17391304347826086) * safe_part_5;
        let safe_part_8 = lit(1.3043478260869565) * g
            - lit(1.0434782608695652) * (coupler_1_by_y_1 * lambda_coupler_1)
            - lit(1.0434782608695652) * safe_part_3
            - lit(1.0434782608695652) * crank_1_by_y_1_lambda_crank_1
            - lit(0.2608695652173913) * crank_0_by_y_0_lambda_crank_0
            - lit(0.17391304347826086) * safe_part_5;
        let safe_part_9 = lit(1.0434782608695652) * safe_part_2
            + lit(1.0434782608695652) * (coupler_2_by_x_3 * lambda_coupler_2)
            + lit(0.2608695652173913) * crank_4_by_x_4_lambda_crank_4
            + lit(1.0434782608695652) * crank_3_by_x_3_lambda_crank_3
            + lit(0.17391304347826086) * safe_part_6;
        let safe_part_10 = lit(1.0434782608695652)
            * (coupler_1_by_x_1 * lambda_coupler_1)
            + lit(1.0434782608695652) * safe_part_4
            + lit(1.0434782608695652) * crank_1_by_x_1_lambda_crank_1
            + lit(0.2608695652173913) * crank_0_by_x_0_lambda_crank_0
            + lit(0.17391304347826086) * safe_part_6;
        out[1] = safe_part_10;
        out[2] = -safe_part_6;
        out[3] = safe_part_9;
        out[7] = -safe_part_5;
        out[6] = -safe_part_8;
        out[8] = -safe_part_7;
        out[0] = lit(-1.5) * (coupler_0_by_x_0 * lambda_coupler_0)
            - lit(1.5) * crank_0_by_x_0_lambda_crank_0 - lit(0.25) * safe_part_10;
        out[4] = lit(-1.5)
            * (coupler_3_by_x_4 * acceleration_0_part_65 * per_pivot_coupler_3)
            - lit(1.5) * crank_4_by_x_4_lambda_crank_4 - lit(0.25) * safe_part_9;
        out[5] = lit(0.25) * safe_part_8 - lit(1.5) * g
            - lit(1.5) * (coupler_0_by_y_0 * lambda_coupler_0)
            - lit(1.5) * crank_0_by_y_0_lambda_crank_0;
        out[9] = lit(0.25) * safe_part_7 - lit(1.5) * g
            - lit(1.5)
                * (coupler_3_by_y_4 * acceleration_0_part_65 * per_pivot_coupler_3)
            - lit(3.0) * crank_4_by_y_4_lambda_crank_4;
        safe
    }
    fn correction<S: ::ukcore::Scalar>(
        &self,
        t: S,
        q: &[S],
        v: &[S],
        residual: &[S],
        out: &mut [S],
    ) -> S {
        let out = ::ukcore::emitted::exact_mut::<S, 10>(out, "out");
        let [x_0, x_1, x_2, x_3, x_4, y_0, y_1, y_2, y_3, y_4] = *::ukcore::emitted::exact::<
            S,
            10,
        >(q, "q");
        let [residual_0, residual_1, residual_2, residual_3, residual_4, residual_5,
        residual_6, residual_7, residual_8] = *::ukcore::emitted::exact::<
            S,
            9,
        >(residual, "residual");
        let lit = S::from_f64;
        let m = lit(self.m);
        let l = lit(self.l);
        let per_m = m.recip();
        let x_1_minus_l = x_1 - l;
        let x_0_minus_x_1 = x_0 - x_1;
        let y_0_minus_y_1 = y_0 - y_1;
        let x_1_minus_x_2 = x_1 - x_2;
        let y_1_minus_y_2 = y_1 - y_2;
        let x_2_minus_x_3 = x_2 - x_3;
        let y_2_minus_y_3 = y_2 - y_3;
        let x_3_minus_x_4 = x_3 - x_4;
        let y_3_minus_y_4 = y_3 - y_4;
        let correction_0_part = lit(2.0) * x_2 - lit(4.0) * l;
        let correction_0_part_2 = lit(2.0) * x_3 - lit(6.0) * l;
        let correction_0_part_3 = lit(2.0) * x_4 - lit(8.0) * l;
        let correction_0_part_4 = lit(0.0009765625) * m;
        let crank_0_by_x_0 = x_0 * per_m;
        let crank_0_by_y_0 = y_0 * per_m;
        let crank_4_by_y_4 = y_4 * per_m;
        let crank_1_by_y_1 = y_1 * per_m;
        let crank_3_by_y_3 = y_3 * per_m;
        let coupler_0_by_x_0 = x_0_minus_x_1 * per_m;
        let crank_4_by_x_4 = correction_0_part_3 * per_m;
        let coupler_3_by_x_4 = x_3_minus_x_4 * per_m;
        let coupler_0_by_y_0 = y_0_minus_y_1 * per_m;
        let coupler_3_by_y_4 = y_3_minus_y_4 * per_m;
        let crank_1_by_x_1 = x_1_minus_l * per_m;
        let coupler_1_by_x_1 = x_1_minus_x_2 * per_m;
        let crank_3_by_x_3 = correction_0_part_2 * per_m;
        let coupler_2_by_x_3 = x_2_minus_x_3 * per_m;
        let coupler_1_by_y_1 = y_1_minus_y_2 * per_m;
        let coupler_2_by_y_3 = y_2_minus_y_3 * per_m;
        let pivot_crank_0 = lit(1.5) * (x_0 * x_0 * per_m)
            + lit(1.5) * (y_0 * y_0 * per_m)
            + lit(0.06722408026755852) * (m * crank_0_by_x_0 * crank_0_by_x_0)
            + lit(0.06722408026755852) * (m * crank_0_by_y_0 * crank_0_by_y_0);
        let correction_0_part_5 = lit(0.04615384615384615)
            * (correction_0_part * crank_0_by_x_0)
            + lit(0.0923076923076923) * (y_2 * crank_0_by_y_0);
        let per_pivot_crank_0 = pivot_crank_0.recip();
        let correction_0_part_6 = x_0_minus_x_1 + lit(0.25) * (m * coupler_0_by_x_0);
        let correction_0_part_7 = x_3_minus_x_4 + lit(0.25) * (m * coupler_3_by_x_4);
        let correction_0_part_8 = x_1_minus_x_2
            + lit(0.17391304347826086) * (m * coupler_1_by_x_1);
        let correction_0_part_9 = x_2_minus_x_3
            + lit(0.17391304347826086) * (m * coupler_2_by_x_3);
        let correction_0_part_10 = y_0_minus_y_1 + lit(0.25) * (m * coupler_0_by_y_0);
        let correction_0_part_11 = y_3_minus_y_4 + lit(0.25) * (m * coupler_3_by_y_4);
        let correction_0_part_12 = y_1_minus_y_2
            + lit(0.17391304347826086) * (m * coupler_1_by_y_1);
        let correction_0_part_13 = y_2_minus_y_3
            + lit(0.17391304347826086) * (m * coupler_2_by_y_3);
        let correction_0_part_14 = crank_0_by_y_0 * crank_1_by_y_1
            + crank_0_by_x_0 * crank_1_by_x_1;
        let correction_0_part_15 = lit(0.01605351170568562)
            * (crank_0_by_y_0 * crank_3_by_y_3)
            + lit(0.00802675585284281) * (crank_0_by_x_0 * crank_3_by_x_3);
        let correction_0_part_16 = lit(0.004013377926421405)
            * (crank_0_by_y_0 * crank_4_by_y_4)
            + lit(0.0020066889632107026) * (crank_0_by_x_0 * crank_4_by_x_4);
        let correction_0_part_17 = lit(1.0434782608695652) * (y_1 * y_1 * per_m)
            + lit(1.0434782608695652) * (x_1_minus_l * x_1_minus_l * per_m)
            + lit(0.032107023411371234) * (m * crank_1_by_y_1 * crank_1_by_y_1)
            + lit(0.032107023411371234) * (m * crank_1_by_x_1 * crank_1_by_x_1);
        let correction_0_part_18 = (lit(4.246153846153846) * (y_2 * y_2)
            + lit(1.0615384615384615) * (correction_0_part * correction_0_part)) * per_m;
        let correction_0_part_19 = lit(4.173913043478261) * (y_3 * y_3 * per_m)
            + lit(1.0434782608695652)
                * (correction_0_part_2 * correction_0_part_2 * per_m)
            + lit(0.12842809364548494) * (m * crank_3_by_y_3 * crank_3_by_y_3)
            + lit(0.032107023411371234) * (m * crank_3_by_x_3 * crank_3_by_x_3);
        let correction_0_part_20 = lit(6.0) * (y_4 * y_4 * per_m)
            + lit(1.5) * (correction_0_part_3 * correction_0_part_3 * per_m)
            + lit(0.2688963210702341) * (m * crank_4_by_y_4 * crank_4_by_y_4)
            + lit(0.06722408026755852) * (m * crank_4_by_x_4 * crank_4_by_x_4);
        let correction_0_part_21 = lit(0.2608695652173913)
            * (m * crank_0_by_x_0 * coupler_1_by_x_1)
            + lit(0.2608695652173913) * (m * crank_0_by_y_0 * coupler_1_by_y_1)
            + lit(0.04615384615384615) * (crank_0_by_x_0 * correction_0_part_8)
            + lit(0.04615384615384615) * (crank_0_by_y_0 * correction_0_part_12);
        let correction_0_part_22 = crank_0_by_x_0 * correction_0_part_9
            + crank_0_by_y_0 * correction_0_part_13;
        let crank_2_by_crank_0 = correction_0_part_5 * per_pivot_crank_0;
        let coupler_0_by_x_1 = per_m * correction_0_part_6;
        let coupler_3_by_x_3 = per_m * correction_0_part_7;
        let coupler_0_by_y_1 = per_m * correction_0_part_10;
        let coupler_3_by_y_3 = per_m * correction_0_part_11;
        let crank_1_by_crank_0 = m * correction_0_part_14 * per_pivot_crank_0;
        let crank_3_by_crank_0 = m * correction_0_part_15 * per_pivot_crank_0;
        let crank_4_by_crank_0 = m * correction_0_part_16 * per_pivot_crank_0;
        let pivot_crank_1 = lit(0.07230523148510641)
            * (m * m * correction_0_part_14 * correction_0_part_14 * per_pivot_crank_0)
            - correction_0_part_17;
        let correction_0_part_23 = lit(0.2688963210702341)
            * (m * correction_0_part_14 * crank_2_by_crank_0)
            - (lit(0.3692307692307692) * (y_2 * crank_1_by_y_1)
                + lit(0.1846153846153846) * (correction_0_part * crank_1_by_x_1));
        let per_pivot_crank_1 = pivot_crank_1.recip();
        let correction_0_part_24 = lit(1.5) * (x_0 * coupler_0_by_x_0)
            + lit(1.5) * (y_0 * coupler_0_by_y_0)
            + lit(0.2688963210702341) * (m * crank_0_by_x_0 * coupler_0_by_x_1)
            + lit(0.2688963210702341) * (m * crank_0_by_y_0 * coupler_0_by_y_1);
        let correction_0_part_25 = crank_0_by_x_0 * coupler_3_by_x_3
            + crank_0_by_y_0 * coupler_3_by_y_3;
        let coupler_1_by_crank_0 = correction_0_part_21 * per_pivot_crank_0;
        let coupler_2_by_crank_0 = correction_0_part_22 * per_pivot_crank_0;
        let correction_0_part_26 = (lit(0.06421404682274248)
            * (crank_1_by_y_1 * crank_3_by_y_3)
            + lit(0.03210702341137124) * (crank_1_by_x_1 * crank_3_by_x_3))
            - lit(0.2688963210702341) * (correction_0_part_14 * crank_3_by_crank_0);
        let correction_0_part_27 = (lit(0.01605351170568562)
            * (crank_4_by_y_4 * crank_1_by_y_1)
            + lit(0.00802675585284281) * (crank_4_by_x_4 * crank_1_by_x_1))
            - lit(0.2688963210702341) * (correction_0_part_14 * crank_4_by_crank_0);
        let correction_0_part_28 = lit(1.5) * (x_0_minus_x_1 * x_0_minus_x_1 * per_m)
            + lit(1.5) * (y_0_minus_y_1 * y_0_minus_y_1 * per_m)
            + lit(1.0434782608695652)
                * (per_m * correction_0_part_6 * correction_0_part_6)
            + lit(1.0434782608695652)
                * (per_m * correction_0_part_10 * correction_0_part_10)
            + lit(0.032107023411371234) * (m * coupler_0_by_x_1 * coupler_0_by_x_1)
            + lit(0.032107023411371234) * (m * coupler_0_by_y_1 * coupler_0_by_y_1);
        let correction_0_part_29 = per_m
            * (lit(1.0434782608695652) * (x_1_minus_x_2 * x_1_minus_x_2)
                + lit(1.0434782608695652) * (y_1_minus_y_2 * y_1_minus_y_2)
                + lit(1.0615384615384615) * (correction_0_part_8 * correction_0_part_8)
                + lit(1.0615384615384615)
                    * (correction_0_part_12 * correction_0_part_12));
        let correction_0_part_30 = per_m
            * (lit(1.0434782608695652) * (x_2_minus_x_3 * x_2_minus_x_3)
                + lit(1.0434782608695652) * (y_2_minus_y_3 * y_2_minus_y_3)
                + lit(1.0615384615384615) * (correction_0_part_9 * correction_0_part_9)
                + lit(1.0615384615384615)
                    * (correction_0_part_13 * correction_0_part_13));
        let correction_0_part_31 = lit(1.5) * (x_3_minus_x_4 * x_3_minus_x_4 * per_m)
            + lit(1.5) * (y_3_minus_y_4 * y_3_minus_y_4 * per_m)
            + lit(1.0434782608695652)
                * (per_m * correction_0_part_7 * correction_0_part_7)
            + lit(1.0434782608695652)
                * (per_m * correction_0_part_11 * correction_0_part_11)
            + lit(0.032107023411371234) * (m * coupler_3_by_x_3 * coupler_3_by_x_3)
            + lit(0.032107023411371234) * (m * coupler_3_by_y_3 * coupler_3_by_y_3);
        let correction_0_part_32 = lit(0.5) * residual_1
            + lit(0.13444816053511705) * (residual_0 * crank_1_by_crank_0);
        let correction_0_part_33 = lit(0.2688963210702341)
            * (m * correction_0_part_14 * coupler_1_by_crank_0)
            - (lit(1.0434782608695652) * (x_1_minus_l * coupler_1_by_x_1)
                + lit(1.0434782608695652) * (y_1 * coupler_1_by_y_1)
                + lit(0.1846153846153846) * (crank_1_by_x_1 * correction_0_part_8)
                + lit(0.1846153846153846) * (crank_1_by_y_1 * correction_0_part_12));
        let correction_0_part_34 = lit(0.012410599434010803)
            * (m * correction_0_part_14 * coupler_2_by_crank_0)
            - lit(0.1846153846153846)
                * (crank_1_by_x_1 * correction_0_part_9
                    + crank_1_by_y_1 * correction_0_part_13);
        let crank_2_by_crank_1 = correction_0_part_23 * per_pivot_crank_1;
        let coupler_0_by_crank_0 = per_pivot_crank_0 * correction_0_part_24;
        let coupler_3_by_crank_0 = m * per_pivot_crank_0 * correction_0_part_25;
        let crank_3_by_crank_1 = m * correction_0_part_26 * per_pivot_crank_1;
        let crank_4_by_crank_1 = m * correction_0_part_27 * per_pivot_crank_1;
        let pivot_crank_2 = correction_0_part_5 * correction_0_part_5 * per_pivot_crank_0
            - correction_0_part_18
            - correction_0_part_23 * correction_0_part_23 * per_pivot_crank_1;
        let per_pivot_crank_2 = pivot_crank_2.recip();
        let correction_0_part_35 = residual_2
            - lit(0.5) * (residual_0 * crank_2_by_crank_0)
            + correction_0_part_32 * crank_2_by_crank_1;
        let correction_0_part_36 = lit(0.2688963210702341)
            * (m * correction_0_part_14 * coupler_0_by_crank_0)
            - (lit(1.0434782608695652) * (x_1_minus_l * coupler_0_by_x_1)
                + lit(0.03210702341137124) * (m * crank_1_by_x_1 * coupler_0_by_x_1)
                + lit(1.0434782608695652) * (y_1 * coupler_0_by_y_1)
                + lit(0.03210702341137124) * (m * crank_1_by_y_1 * coupler_0_by_y_1));
        let correction_0_part_37 = lit(0.03210702341137124)
            * (crank_1_by_x_1 * coupler_3_by_x_3 + crank_1_by_y_1 * coupler_3_by_y_3)
            - lit(0.002158365118958401) * (correction_0_part_14 * coupler_3_by_crank_0);
        let coupler_1_by_crank_1 = correction_0_part_33 * per_pivot_crank_1;
        let coupler_2_by_crank_1 = correction_0_part_34 * per_pivot_crank_1;
        let correction_0_part_38 = correction_0_part_5 * crank_3_by_crank_0
            - (lit(0.7384615384615385) * (y_2 * crank_3_by_y_3)
                + lit(0.18461538461538463) * (correction_0_part * crank_3_by_x_3))
            + correction_0_part_23 * crank_3_by_crank_1;
        let correction_0_part_39 = correction_0_part_5 * crank_4_by_crank_0
            - (lit(0.18461538461538463) * (y_2 * crank_4_by_y_4)
                + lit(0.046153846153846156) * (correction_0_part * crank_4_by_x_4))
            + correction_0_part_23 * crank_4_by_crank_1;
        let correction_0_part_40 = correction_0_part_5 * coupler_1_by_crank_0
            - per_m
                * (lit(1.0615384615384615) * (correction_0_part * correction_0_part_8)
                    + lit(2.123076923076923) * (y_2 * correction_0_part_12))
            - correction_0_part_23 * coupler_1_by_crank_1;
        let correction_0_part_41 = lit(0.04615384615384615)
            * (correction_0_part_5 * coupler_2_by_crank_0)
            - per_m
                * (lit(1.0615384615384615) * (correction_0_part * correction_0_part_9)
                    + lit(2.123076923076923) * (y_2 * correction_0_part_13))
            - correction_0_part_23 * coupler_2_by_crank_1;
        let coupler_0_by_crank_1 = per_pivot_crank_1 * correction_0_part_36;
        let coupler_3_by_crank_1 = m * per_pivot_crank_1 * correction_0_part_37;
        let crank_3_by_crank_2 = correction_0_part_38 * per_pivot_crank_2;
        let crank_4_by_crank_2 = correction_0_part_39 * per_pivot_crank_2;
        let pivot_crank_3 = m * m * correction_0_part_15 * correction_0_part_15
            * per_pivot_crank_0 - correction_0_part_19
            - m * m * correction_0_part_26 * correction_0_part_26 * per_pivot_crank_1
            - correction_0_part_38 * correction_0_part_38 * per_pivot_crank_2;
        let per_pivot_crank_3 = pivot_crank_3.recip();
        let correction_0_part_42 = correction_0_part_5 * coupler_0_by_crank_0
            - (lit(0.18461538461538463) * (correction_0_part * coupler_0_by_x_1)
                + lit(0.36923076923076925) * (y_2 * coupler_0_by_y_1))
            - correction_0_part_23 * coupler_0_by_crank_1;
        let correction_0_part_43 = lit(0.00802675585284281)
            * (correction_0_part_5 * coupler_3_by_crank_0)
            - (lit(0.18461538461538463) * (correction_0_part * coupler_3_by_x_3)
                + lit(0.36923076923076925) * (y_2 * coupler_3_by_y_3))
            + correction_0_part_23 * coupler_3_by_crank_1;
        let coupler_1_by_crank_2 = per_pivot_crank_2 * correction_0_part_40;
        let coupler_2_by_crank_2 = per_pivot_crank_2 * correction_0_part_41;
        let correction_0_part_44 = m * correction_0_part_15 * crank_4_by_crank_0
            - (lit(1.0434782608695652) * (y_3 * crank_4_by_y_4)
                + lit(0.03210702341137124) * (m * crank_4_by_y_4 * crank_3_by_y_3)
                + lit(0.2608695652173913) * (correction_0_part_2 * crank_4_by_x_4)
                + lit(0.00802675585284281) * (m * crank_4_by_x_4 * crank_3_by_x_3))
            - m * correction_0_part_26 * crank_4_by_crank_1
            - correction_0_part_38 * crank_4_by_crank_2;
        let correction_0_part_45 = residual_3
            + lit(0.5) * (residual_0 * crank_3_by_crank_0)
            + correction_0_part_32 * crank_3_by_crank_1
            + correction_0_part_35 * crank_3_by_crank_2;
        let correction_0_part_46 = m * correction_0_part_15 * coupler_1_by_crank_0
            - (lit(0.1846153846153846) * (crank_3_by_x_3 * correction_0_part_8)
                + lit(0.3692307692307692) * (crank_3_by_y_3 * correction_0_part_12))
            + m * correction_0_part_26 * coupler_1_by_crank_1
            - correction_0_part_38 * coupler_1_by_crank_2;
        let correction_0_part_47 = lit(0.04615384615384615)
            * (m * correction_0_part_15 * coupler_2_by_crank_0)
            - (lit(1.0434782608695652) * (correction_0_part_2 * coupler_2_by_x_3)
                + lit(2.0869565217391304) * (y_3 * coupler_2_by_y_3)
                + lit(0.1846153846153846) * (crank_3_by_x_3 * correction_0_part_9)
                + lit(0.3692307692307692) * (crank_3_by_y_3 * correction_0_part_13))
            + m * correction_0_part_26 * coupler_2_by_crank_1
            - correction_0_part_38 * coupler_2_by_crank_2;
        let coupler_0_by_crank_2 = per_pivot_crank_2 * correction_0_part_42;
        let coupler_3_by_crank_2 = per_pivot_crank_2 * correction_0_part_43;
        let crank_4_by_crank_3 = correction_0_part_44 * per_pivot_crank_3;
        let pivot_crank_4 = m * m * correction_0_part_16 * correction_0_part_16
            * per_pivot_crank_0 - correction_0_part_20
            - m * m * correction_0_part_27 * correction_0_part_27 * per_pivot_crank_1
            - correction_0_part_39 * correction_0_part_39 * per_pivot_crank_2
            - correction_0_part_44 * correction_0_part_44 * per_pivot_crank_3;
        let per_pivot_crank_4 = pivot_crank_4.recip();
        let correction_0_part_48 = m * correction_0_part_15 * coupler_0_by_crank_0
            - m
                * (lit(0.03210702341137124) * (crank_3_by_x_3 * coupler_0_by_x_1)
                    + lit(0.06421404682274248) * (crank_3_by_y_3 * coupler_0_by_y_1))
            + m * correction_0_part_26 * coupler_0_by_crank_1
            - correction_0_part_38 * coupler_0_by_crank_2;
        let correction_0_part_49 = lit(0.00802675585284281)
            * (m * correction_0_part_15 * coupler_3_by_crank_0)
            - (lit(1.0434782608695652) * (correction_0_part_2 * coupler_3_by_x_3)
                + lit(0.03210702341137124) * (m * crank_3_by_x_3 * coupler_3_by_x_3)
                + lit(2.0869565217391304) * (y_3 * coupler_3_by_y_3)
                + lit(0.06421404682274248) * (m * crank_3_by_y_3 * coupler_3_by_y_3))
            - m * correction_0_part_26 * coupler_3_by_crank_1
            - correction_0_part_38 * coupler_3_by_crank_2;
        let coupler_1_by_crank_3 = correction_0_part_46 * per_pivot_crank_3;
        let coupler_2_by_crank_3 = correction_0_part_47 * per_pivot_crank_3;
        let correction_0_part_50 = residual_4
            - lit(0.5) * (residual_0 * crank_4_by_crank_0)
            - correction_0_part_32 * crank_4_by_crank_1
            - correction_0_part_35 * crank_4_by_crank_2
            + correction_0_part_45 * crank_4_by_crank_3;
        let correction_0_part_51 = m * correction_0_part_16 * coupler_1_by_crank_0
            - (lit(0.04615384615384615) * (crank_4_by_x_4 * correction_0_part_8)
                + lit(0.0923076923076923) * (crank_4_by_y_4 * correction_0_part_12))
            + m * correction_0_part_27 * coupler_1_by_crank_1
            - correction_0_part_39 * coupler_1_by_crank_2
            - correction_0_part_44 * coupler_1_by_crank_3;
        let correction_0_part_52 = lit(0.04615384615384615)
            * (m * correction_0_part_16 * coupler_2_by_crank_0)
            - (lit(0.2608695652173913) * (m * crank_4_by_x_4 * coupler_2_by_x_3)
                + lit(0.5217391304347826) * (m * crank_4_by_y_4 * coupler_2_by_y_3)
                + lit(0.04615384615384615) * (crank_4_by_x_4 * correction_0_part_9)
                + lit(0.0923076923076923) * (crank_4_by_y_4 * correction_0_part_13))
            + m * correction_0_part_27 * coupler_2_by_crank_1
            - correction_0_part_39 * coupler_2_by_crank_2
            - correction_0_part_44 * coupler_2_by_crank_3;
        let coupler_0_by_crank_3 = per_pivot_crank_3 * correction_0_part_48;
        let coupler_3_by_crank_3 = per_pivot_crank_3 * correction_0_part_49;
        let correction_0_part_53 = m * correction_0_part_16 * coupler_0_by_crank_0
            - m
                * (lit(0.00802675585284281) * (crank_4_by_x_4 * coupler_0_by_x_1)
                    + lit(0.01605351170568562) * (crank_4_by_y_4 * coupler_0_by_y_1))
            + m * correction_0_part_27 * coupler_0_by_crank_1
            - correction_0_part_39 * coupler_0_by_crank_2
            - correction_0_part_44 * coupler_0_by_crank_3;
        let correction_0_part_54 = lit(0.00802675585284281)
            * (m * correction_0_part_16 * coupler_3_by_crank_0)
            - (lit(1.5) * (correction_0_part_3 * coupler_3_by_x_4)
                + lit(3.0) * (y_4 * coupler_3_by_y_4)
                + lit(0.2688963210702341) * (m * crank_4_by_x_4 * coupler_3_by_x_3)
                + lit(0.5377926421404682) * (m * crank_4_by_y_4 * coupler_3_by_y_3))
            - m * correction_0_part_27 * coupler_3_by_crank_1
            - correction_0_part_39 * coupler_3_by_crank_2
            - correction_0_part_44 * coupler_3_by_crank_3;
        let coupler_1_by_crank_4 = correction_0_part_51 * per_pivot_crank_4;
        let coupler_2_by_crank_4 = correction_0_part_52 * per_pivot_crank_4;
        let correction_0_part_55 = correction_0_part_24 * coupler_1_by_crank_0
            - (lit(1.0434782608695652) * (coupler_1_by_x_1 * correction_0_part_6)
                + lit(1.0434782608695652) * (coupler_1_by_y_1 * correction_0_part_10)
                + lit(0.1846153846153846) * (correction_0_part_8 * coupler_0_by_x_1)
                + lit(0.1846153846153846) * (correction_0_part_12 * coupler_0_by_y_1))
            - correction_0_part_36 * coupler_1_by_crank_1
            - correction_0_part_42 * coupler_1_by_crank_2
            - correction_0_part_48 * coupler_1_by_crank_3
            - correction_0_part_53 * coupler_1_by_crank_4;
        let correction_0_part_56 = lit(0.04615384615384615)
            * (correction_0_part_24 * coupler_2_by_crank_0)
            - lit(0.1846153846153846)
                * (correction_0_part_9 * coupler_0_by_x_1
                    + correction_0_part_13 * coupler_0_by_y_1)
            - correction_0_part_36 * coupler_2_by_crank_1
            - correction_0_part_42 * coupler_2_by_crank_2
            - correction_0_part_48 * coupler_2_by_crank_3
            - correction_0_part_53 * coupler_2_by_crank_4;
        let coupler_0_by_crank_4 = per_pivot_crank_4 * correction_0_part_53;
        let coupler_3_by_crank_4 = per_pivot_crank_4 * correction_0_part_54;
        let pivot_coupler_0 = per_pivot_crank_0 * correction_0_part_24
            * correction_0_part_24 - correction_0_part_28
            - per_pivot_crank_1 * correction_0_part_36 * correction_0_part_36
            - per_pivot_crank_2 * correction_0_part_42 * correction_0_part_42
            - per_pivot_crank_3 * correction_0_part_48 * correction_0_part_48
            - per_pivot_crank_4 * correction_0_part_53 * correction_0_part_53;
        let per_pivot_coupler_0 = pivot_coupler_0.recip();
        let correction_0_part_57 = lit(0.00802675585284281)
            * (correction_0_part_24 * coupler_3_by_crank_0)
            - lit(0.03210702341137124)
                * (m
                    * (coupler_0_by_x_1 * coupler_3_by_x_3
                        + coupler_0_by_y_1 * coupler_3_by_y_3))
            + correction_0_part_36 * coupler_3_by_crank_1
            - correction_0_part_42 * coupler_3_by_crank_2
            - correction_0_part_48 * coupler_3_by_crank_3
            - correction_0_part_53 * coupler_3_by_crank_4;
        let correction_0_part_58 = lit(0.5) * residual_5
            - lit(0.5) * (residual_0 * coupler_0_by_crank_0)
            + correction_0_part_32 * coupler_0_by_crank_1
            - correction_0_part_35 * coupler_0_by_crank_2
            + correction_0_part_45 * coupler_0_by_crank_3
            - correction_0_part_50 * coupler_0_by_crank_4;
        let coupler_1_by_coupler_0 = correction_0_part_55 * per_pivot_coupler_0;
        let coupler_2_by_coupler_0 = correction_0_part_56 * per_pivot_coupler_0;
        let coupler_3_by_coupler_0 = correction_0_part_57 * per_pivot_coupler_0;
        let pivot_coupler_1 = correction_0_part_21 * correction_0_part_21
            * per_pivot_crank_0 - correction_0_part_29
            - correction_0_part_33 * correction_0_part_33 * per_pivot_crank_1
            - per_pivot_crank_2 * correction_0_part_40 * correction_0_part_40
            - correction_0_part_46 * correction_0_part_46 * per_pivot_crank_3
            - correction_0_part_51 * correction_0_part_51 * per_pivot_crank_4
            - correction_0_part_55 * correction_0_part_55 * per_pivot_coupler_0;
        let per_pivot_coupler_1 = pivot_coupler_1.recip();
        let correction_0_part_59 = lit(0.04615384615384615)
            * (correction_0_part_21 * coupler_2_by_crank_0)
            - lit(1.0615384615384615)
                * (per_m
                    * (correction_0_part_8 * correction_0_part_9
                        + correction_0_part_12 * correction_0_part_13))
            - correction_0_part_33 * coupler_2_by_crank_1
            - correction_0_part_40 * coupler_2_by_crank_2
            - correction_0_part_46 * coupler_2_by_crank_3
            - correction_0_part_51 * coupler_2_by_crank_4
            - correction_0_part_55 * coupler_2_by_coupler_0;
        let correction_0_part_60 = lit(0.5) * residual_6
            + lit(0.5) * (residual_0 * coupler_1_by_crank_0)
            - correction_0_part_32 * coupler_1_by_crank_1
            + correction_0_part_35 * coupler_1_by_crank_2
            - correction_0_part_45 * coupler_1_by_crank_3
            + correction_0_part_50 * coupler_1_by_crank_4
            + correction_0_part_58 * coupler_1_by_coupler_0;
        let correction_0_part_61 = lit(0.00802675585284281)
            * (correction_0_part_21 * coupler_3_by_crank_0)
            - lit(0.18461538461538463)
                * (correction_0_part_8 * coupler_3_by_x_3
                    + correction_0_part_12 * coupler_3_by_y_3)
            + correction_0_part_33 * coupler_3_by_crank_1
            - correction_0_part_40 * coupler_3_by_crank_2
            - correction_0_part_46 * coupler_3_by_crank_3
            - correction_0_part_51 * coupler_3_by_crank_4
            - correction_0_part_55 * coupler_3_by_coupler_0;
        let coupler_2_by_coupler_1 = correction_0_part_59 * per_pivot_coupler_1;
        let coupler_3_by_coupler_1 = correction_0_part_61 * per_pivot_coupler_1;
        let pivot_coupler_2 = lit(0.002130177514792899)
            * (correction_0_part_22 * correction_0_part_22 * per_pivot_crank_0)
            - correction_0_part_30
            - correction_0_part_34 * correction_0_part_34 * per_pivot_crank_1
            - per_pivot_crank_2 * correction_0_part_41 * correction_0_part_41
            - correction_0_part_47 * correction_0_part_47 * per_pivot_crank_3
            - correction_0_part_52 * correction_0_part_52 * per_pivot_crank_4
            - correction_0_part_56 * correction_0_part_56 * per_pivot_coupler_0
            - correction_0_part_59 * correction_0_part_59 * per_pivot_coupler_1;
        let per_pivot_coupler_2 = pivot_coupler_2.recip();
        let correction_0_part_62 = lit(0.5) * residual_7
            - lit(0.023076923076923075) * (residual_0 * coupler_2_by_crank_0)
            + correction_0_part_32 * coupler_2_by_crank_1
            - correction_0_part_35 * coupler_2_by_crank_2
            + correction_0_part_45 * coupler_2_by_crank_3
            - correction_0_part_50 * coupler_2_by_crank_4
            - correction_0_part_58 * coupler_2_by_coupler_0
            + correction_0_part_60 * coupler_2_by_coupler_1;
        let correction_0_part_63 = lit(0.0003704656547465912)
            * (correction_0_part_22 * coupler_3_by_crank_0)
            - (lit(1.0434782608695652) * (x_2_minus_x_3 * coupler_3_by_x_3)
                + lit(0.18461538461538463) * (correction_0_part_9 * coupler_3_by_x_3)
                + lit(1.0434782608695652) * (y_2_minus_y_3 * coupler_3_by_y_3)
                + lit(0.18461538461538463) * (correction_0_part_13 * coupler_3_by_y_3))
            + correction_0_part_34 * coupler_3_by_crank_1
            - correction_0_part_41 * coupler_3_by_crank_2
            - correction_0_part_47 * coupler_3_by_crank_3
            - correction_0_part_52 * coupler_3_by_crank_4
            - correction_0_part_56 * coupler_3_by_coupler_0
            - correction_0_part_59 * coupler_3_by_coupler_1;
        let coupler_3_by_coupler_2 = correction_0_part_63 * per_pivot_coupler_2;
        let pivot_coupler_3 = lit(0.00006442880952114631)
            * (m * m * per_pivot_crank_0 * correction_0_part_25 * correction_0_part_25)
            - correction_0_part_31
            - m * m * per_pivot_crank_1 * correction_0_part_37 * correction_0_part_37
            - per_pivot_crank_2 * correction_0_part_43 * correction_0_part_43
            - per_pivot_crank_3 * correction_0_part_49 * correction_0_part_49
            - per_pivot_crank_4 * correction_0_part_54 * correction_0_part_54
            - correction_0_part_57 * correction_0_part_57 * per_pivot_coupler_0
            - correction_0_part_61 * correction_0_part_61 * per_pivot_coupler_1
            - correction_0_part_63 * correction_0_part_63 * per_pivot_coupler_2;
        let per_pivot_coupler_3 = pivot_coupler_3.recip();
        let correction_0_part_64 = lit(0.5) * residual_8
            + lit(0.004013377926421405) * (residual_0 * coupler_3_by_crank_0)
            + correction_0_part_32 * coupler_3_by_crank_1
            + correction_0_part_35 * coupler_3_by_crank_2
            - correction_0_part_45 * coupler_3_by_crank_3
            + correction_0_part_50 * coupler_3_by_crank_4
            + correction_0_part_58 * coupler_3_by_coupler_0
            - correction_0_part_60 * coupler_3_by_coupler_1
            + correction_0_part_62 * coupler_3_by_coupler_2;
        let safe = S::select_le(
            -pivot_coupler_3,
            lit(0.0009765625) * correction_0_part_31,
            lit(0.0),
            S::select_le(
                -pivot_coupler_2,
                lit(0.0009765625) * correction_0_part_30,
                lit(0.0),
                S::select_le(
                    -pivot_coupler_1,
                    lit(0.0009765625) * correction_0_part_29,
                    lit(0.0),
                    S::select_le(
                        -pivot_coupler_0,
                        lit(0.0009765625) * correction_0_part_28,
                        lit(0.0),
                        S::select_le(
                            -pivot_crank_4,
                            lit(0.0009765625) * correction_0_part_20,
                            lit(0.0),
                            S::select_le(
                                -pivot_crank_3,
                                lit(0.0009765625) * correction_0_part_19,
                                lit(0.0),
                                S::select_le(
                                    -pivot_crank_2,
                                    lit(0.0009765625) * correction_0_part_18,
                                    lit(0.0),
                                    S::select_le(
                                        -pivot_crank_1,
                                        lit(0.0009765625) * correction_0_part_17,
                                        lit(0.0),
                                        S::select_le(
                                            pivot_crank_0,
                                            lit(0.0),
                                            lit(0.0),
                                            S::select_le(
                                                lit(0.9420289855072463) * m,
                                                correction_0_part_4,
                                                lit(0.0),
                                                S::select_le(
                                                    lit(0.9583333333333334) * m,
                                                    correction_0_part_4,
                                                    lit(0.0),
                                                    S::select_le(
                                                        lit(0.6666666666666666) * m,
                                                        lit(0.0),
                                                        lit(0.0),
                                                        lit(1.0),
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
        let safe_part = coupler_3_by_y_3 * correction_0_part_64 * per_pivot_coupler_3;
        let safe_part_2 = coupler_3_by_x_3 * correction_0_part_64 * per_pivot_coupler_3;
        let lambda_coupler_2 = correction_0_part_62 * per_pivot_coupler_2
            + coupler_3_by_coupler_2 * correction_0_part_64 * per_pivot_coupler_3;
        let lambda_coupler_1 = correction_0_part_60 * per_pivot_coupler_1
            - coupler_3_by_coupler_1 * correction_0_part_64 * per_pivot_coupler_3
            + coupler_2_by_coupler_1 * lambda_coupler_2;
        let lambda_coupler_0 = correction_0_part_58 * per_pivot_coupler_0
            + coupler_3_by_coupler_0 * correction_0_part_64 * per_pivot_coupler_3
            - coupler_2_by_coupler_0 * lambda_coupler_2
            + coupler_1_by_coupler_0 * lambda_coupler_1;
        let safe_part_3 = coupler_0_by_y_1 * lambda_coupler_0;
        let safe_part_4 = coupler_0_by_x_1 * lambda_coupler_0;
        let lambda_crank_4 = correction_0_part_50 * per_pivot_crank_4
            + coupler_3_by_crank_4 * correction_0_part_64 * per_pivot_coupler_3
            - coupler_2_by_crank_4 * lambda_coupler_2
            + coupler_1_by_crank_4 * lambda_coupler_1
            - coupler_0_by_crank_4 * lambda_coupler_0;
        let crank_4_by_y_4_lambda_crank_4 = crank_4_by_y_4 * lambda_crank_4;
        let crank_4_by_x_4_lambda_crank_4 = crank_4_by_x_4 * lambda_crank_4;
        let lambda_crank_3 = correction_0_part_45 * per_pivot_crank_3
            - coupler_3_by_crank_3 * correction_0_part_64 * per_pivot_coupler_3
            + coupler_2_by_crank_3 * lambda_coupler_2
            - coupler_1_by_crank_3 * lambda_coupler_1
            + coupler_0_by_crank_3 * lambda_coupler_0
            + crank_4_by_crank_3 * lambda_crank_4;
        let crank_3_by_y_3_lambda_crank_3 = crank_3_by_y_3 * lambda_crank_3;
        let crank_3_by_x_3_lambda_crank_3 = crank_3_by_x_3 * lambda_crank_3;
        let lambda_crank_2 = correction_0_part_35 * per_pivot_crank_2
            + coupler_3_by_crank_2 * correction_0_part_64 * per_pivot_coupler_3
            - coupler_2_by_crank_2 * lambda_coupler_2
            + coupler_1_by_crank_2 * lambda_coupler_1
            - coupler_0_by_crank_2 * lambda_coupler_0
            - crank_4_by_crank_2 * lambda_crank_4 + crank_3_by_crank_2 * lambda_crank_3;
        let lambda_crank_1 = correction_0_part_32 * per_pivot_crank_1
            + coupler_3_by_crank_1 * correction_0_part_64 * per_pivot_coupler_3
            + coupler_2_by_crank_1 * lambda_coupler_2
            - coupler_1_by_crank_1 * lambda_coupler_1
            + coupler_0_by_crank_1 * lambda_coupler_0
            - crank_4_by_crank_1 * lambda_crank_4 + crank_3_by_crank_1 * lambda_crank_3
            + crank_2_by_crank_1 * lambda_crank_2;
        let crank_1_by_y_1_lambda_crank_1 = crank_1_by_y_1 * lambda_crank_1;
        let crank_1_by_x_1_lambda_crank_1 = crank_1_by_x_1 * lambda_crank_1;
        let lambda_crank_0 = lit(0.5) * (residual_0 * per_pivot_crank_0)
            - lit(0.00802675585284281)
                * (coupler_3_by_crank_0 * correction_0_part_64 * per_pivot_coupler_3)
            + lit(0.04615384615384615) * (coupler_2_by_crank_0 * lambda_coupler_2)
            - coupler_1_by_crank_0 * lambda_coupler_1
            + coupler_0_by_crank_0 * lambda_coupler_0
            + crank_4_by_crank_0 * lambda_crank_4 - crank_3_by_crank_0 * lambda_crank_3
            + crank_2_by_crank_0 * lambda_crank_2
            - lit(0.2688963210702341) * (crank_1_by_crank_0 * lambda_crank_1);
        let crank_0_by_y_0_lambda_crank_0 = crank_0_by_y_0 * lambda_crank_0;
        let crank_0_by_x_0_lambda_crank_0 = crank_0_by_x_0 * lambda_crank_0;
        let safe_part_5 = lit(0.18461538461538463) * safe_part
            - lit(1.0615384615384615) * (per_m * correction_0_part_13 * lambda_coupler_2)
            - lit(0.18461538461538463) * safe_part_3
            + lit(1.0615384615384615) * (per_m * correction_0_part_12 * lambda_coupler_1)
            - lit(0.09230769230769231) * crank_4_by_y_4_lambda_crank_4
            + lit(0.36923076923076925) * crank_3_by_y_3_lambda_crank_3
            + lit(0.18461538461538463) * crank_1_by_y_1_lambda_crank_1
            - lit(2.123076923076923) * (y_2 * per_m * lambda_crank_2)
            + lit(0.046153846153846156) * crank_0_by_y_0_lambda_crank_0;
        let safe_part_6 = lit(0.18461538461538463) * safe_part_2
            - lit(1.0615384615384615) * (per_m * correction_0_part_9 * lambda_coupler_2)
            - lit(0.18461538461538463) * safe_part_4
            + lit(1.0615384615384615) * (per_m * correction_0_part_8 * lambda_coupler_1)
            - lit(0.046153846153846156) * crank_4_by_x_4_lambda_crank_4
            + lit(0.18461538461538463) * crank_3_by_x_3_lambda_crank_3
            + lit(0.18461538461538463) * crank_1_by_x_1_lambda_crank_1
            - lit(1.0615384615384615) * (correction_0_part * per_m * lambda_crank_2)
            + lit(0.046153846153846156) * crank_0_by_x_0_lambda_crank_0;
        let safe_part_7 = lit(1.0434782608695652) * safe_part
            - lit(1.0434782608695652) * (coupler_2_by_y_3 * lambda_coupler_2)
            - lit(0.5217391304347826) * crank_4_by_y_4_lambda_crank_4
            + lit(2.0869565217391304) * crank_3_by_y_3_lambda_crank_3
            + lit(0.17391304347826086) * safe_part_5;
        let safe_part_8 = lit(1.0434782608695652) * (coupler_1_by_y_1 * lambda_coupler_1)
            - lit(1.0434782608695652) * safe_part_3
            + lit(1.0434782608695652) * crank_1_by_y_1_lambda_crank_1
            + lit(0.2608695652173913) * crank_0_by_y_0_lambda_crank_0
            + lit(0.17391304347826086) * safe_part_5;
        let safe_part_9 = lit(1.0434782608695652) * safe_part_2
            - lit(1.0434782608695652) * (coupler_2_by_x_3 * lambda_coupler_2)
            - lit(0.2608695652173913) * crank_4_by_x_4_lambda_crank_4
            + lit(1.0434782608695652) * crank_3_by_x_3_lambda_crank_3
            + lit(0.17391304347826086) * safe_part_6;
        let safe_part_10 = lit(1.0434782608695652)
            * (coupler_1_by_x_1 * lambda_coupler_1)
            - lit(1.0434782608695652) * safe_part_4
            + lit(1.0434782608695652) * crank_1_by_x_1_lambda_crank_1
            + lit(0.2608695652173913) * crank_0_by_x_0_lambda_crank_0
            + lit(0.17391304347826086) * safe_part_6;
        out[1] = safe_part_10;
        out[2] = -safe_part_6;
        out[3] = safe_part_9;
        out[6] = safe_part_8;
        out[7] = -safe_part_5;
        out[8] = safe_part_7;
        out[4] = lit(1.5) * crank_4_by_x_4_lambda_crank_4
            - lit(1.5) * (coupler_3_by_x_4 * correction_0_part_64 * per_pivot_coupler_3)
            - lit(0.25) * safe_part_9;
        out[9] = lit(3.0) * crank_4_by_y_4_lambda_crank_4
            - lit(1.5) * (coupler_3_by_y_4 * correction_0_part_64 * per_pivot_coupler_3)
            - lit(0.25) * safe_part_7;
        out[0] = lit(1.5) * (coupler_0_by_x_0 * lambda_coupler_0)
            - lit(1.5) * crank_0_by_x_0_lambda_crank_0 - lit(0.25) * safe_part_10;
        out[5] = lit(1.5) * (coupler_0_by_y_0 * lambda_coupler_0)
            - lit(1.5) * crank_0_by_y_0_lambda_crank_0 - lit(0.25) * safe_part_8;
        safe
    }
}
