/// Two point masses on massless rigid rods, the first about a pivot at the origin; y points up.
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
/// M[x2, x2] = m2
/// M[y2, y2] = m2
/// ```
///
/// Generalised force Q, eq. 1:
///
/// ```text
/// Q[y1] = -m1*g
/// Q[y2] = -m2*g
/// ```
///
/// Constraints φ, eqs. 3 and 4:
///
/// ```text
/// inner: sq(x1) + sq(y1) - sq(l1) = 0
/// outer: sq(x1 - x2) + sq(y1 - y2) - sq(l2) = 0
/// ```
///
/// Constraint Jacobian A, eq. 5:
///
/// ```text
/// A[inner, x1] = 2*x1
/// A[inner, y1] = 2*y1
/// A[outer, x1] = 2*(x1 - x2)
/// A[outer, y1] = 2*(y1 - y2)
/// A[outer, x2] = 2*(x2 - x1)
/// A[outer, y2] = 2*(y2 - y1)
/// ```
///
/// Right-hand side b, eq. 5:
///
/// ```text
/// b[inner] = -2*(sq(dot(x1)) + sq(dot(y1)))
/// b[outer] = -2*(sq(dot(x1) - dot(x2)) + sq(dot(y1) - dot(y2)))
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 2 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 8 | 12 | 0 | 0 | 0 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 65 | 86 | 6 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 23 | 43 | 4 | 0 | 0 | 6 |
/// | straight line, as emitted | 24 | 43 | 2 | 0 | 0 | 2 |
/// | correction of a projection | 15 | 39 | 2 | 0 | 0 | 2 |
/// | once for a set of parameters | 0 | 4 | 2 | 0 | 0 | 4 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct DoublePendulum {
    /// Inner mass, kg
    pub m1: f64,
    /// Outer mass, kg
    pub m2: f64,
    /// Length of the inner rod, m
    pub l1: f64,
    /// Length of the outer rod, m
    pub l2: f64,
    /// Acceleration of gravity (exact in binary), m/s^2
    pub g: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for DoublePendulum {
    fn default() -> Self {
        DoublePendulum {
            m1: 1.0,
            m2: 1.0,
            l1: 1.0,
            l2: 1.0,
            g: 9.8125,
        }
    }
}
#[allow(dead_code)]
impl DoublePendulum {
    /// Position in q of coordinate `x1`.
    pub const X1: usize = 0;
    /// Position in q of coordinate `y1`.
    pub const Y1: usize = 1;
    /// Position in q of coordinate `x2`.
    pub const X2: usize = 2;
    /// Position in q of coordinate `y2`.
    pub const Y2: usize = 3;
    /// Row in A of constraint `inner`.
    pub const INNER: usize = 0;
    /// Row in A of constraint `outer`.
    pub const OUTER: usize = 1;
    /// Position of output `angle1`.
    pub const OUT_ANGLE1: usize = 0;
    /// Position of output `angle2`.
    pub const OUT_ANGLE2: usize = 1;
}
const _: () = {
    use ::ukcore as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<DoublePendulum> for ukcore::Prepared {
        fn from(mechanism: DoublePendulum) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for DoublePendulum {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "DoublePendulum",
            doc: "Two point masses on massless rigid rods, the first about a pivot at the origin; y points up.",
            params: &[
                ukcore::ParamSpec {
                    name: "m1",
                    doc: "Inner mass, kg",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "m2",
                    doc: "Outer mass, kg",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "l1",
                    doc: "Length of the inner rod, m",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "l2",
                    doc: "Length of the outer rod, m",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "g",
                    doc: "Acceleration of gravity (exact in binary), m/s^2",
                    default: 9.8125,
                },
            ],
            prepared: &[
                ("right_y1", "m1*g"),
                ("right_y2", "m2*g"),
                ("sq_l1", "sq(l1)"),
                ("sq_l2", "sq(l2)"),
                ("m1", "m1"),
                ("m2", "m2"),
                ("per_m2", "1/m2"),
                ("per_m1", "1/m1"),
                ("g", "g"),
                (
                    "safe_x1",
                    "1 if the pivots that depend on m1, m2 alone are positive and finite, else 0",
                ),
            ],
            coords: &["x1", "y1", "x2", "y2"],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "inner",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x1) + sq(y1) - sq(l1) = 0",
                },
                ukcore::ConstraintSpec {
                    name: "outer",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x1 - x2) + sq(y1 - y2) - sq(l2) = 0",
                },
            ],
            holonomic: 2,
            outputs: &[
                ukcore::OutputSpec {
                    name: "angle1",
                    doc: "Angle of the inner rod from the downward vertical, rad",
                },
                ukcore::OutputSpec {
                    name: "angle2",
                    doc: "Angle of the outer rod from the downward vertical, rad",
                },
            ],
            switches: &[],
            structure: ukcore::Structure {
                straight_line: true,
                solve: ukcore::Solve {
                    refusal: "",
                    pivots: &[
                        ukcore::Pivot::Coordinate(2),
                        ukcore::Pivot::Coordinate(3),
                        ukcore::Pivot::Coordinate(0),
                        ukcore::Pivot::Coordinate(1),
                        ukcore::Pivot::Constraint(0),
                        ukcore::Pivot::Constraint(1),
                    ],
                    fill: &[(5, 4)],
                    checks: &[
                        ukcore::Check::Positive(2),
                        ukcore::Check::Positive(0),
                        ukcore::Check::Positive(4),
                        ukcore::Check::Share(5),
                    ],
                    least_share: 0.0009765625,
                },
                mass_pattern: &[(0, 0), (1, 1), (2, 2), (3, 3)],
                jacobian_pattern: &[(0, 0), (0, 1), (1, 0), (1, 1), (1, 2), (1, 3)],
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
                    "2 of the 8 entries of A: structurally zero, never written",
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "2 of 4 entries of Q: identically zero",
                    "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 8,
                        multiplications: 12,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    dense: ukcore::Operations {
                        additions: 65,
                        multiplications: 86,
                        divisions: 6,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    unprepared: ukcore::Operations {
                        additions: 23,
                        multiplications: 43,
                        divisions: 4,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 6,
                    },
                    acceleration: ukcore::Operations {
                        additions: 24,
                        multiplications: 43,
                        divisions: 2,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 2,
                    },
                    correction: ukcore::Operations {
                        additions: 15,
                        multiplications: 39,
                        divisions: 2,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 2,
                    },
                    prepare: ukcore::Operations {
                        additions: 0,
                        multiplications: 4,
                        divisions: 2,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 4,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[],
                mass: &[(0, 0, "m1"), (1, 1, "m1"), (2, 2, "m2"), (3, 3, "m2")],
                force: &[(1, "-m1*g"), (3, "-m2*g")],
                nonideal: &[],
                jacobian: &[
                    (0, 0, "2*x1"),
                    (0, 1, "2*y1"),
                    (1, 0, "2*(x1 - x2)"),
                    (1, 1, "2*(y1 - y2)"),
                    (1, 2, "2*(x2 - x1)"),
                    (1, 3, "2*(y2 - y1)"),
                ],
                rhs: &[
                    (0, "-2*(sq(dot(x1)) + sq(dot(y1)))"),
                    (1, "-2*(sq(dot(x1) - dot(x2)) + sq(dot(y1) - dot(y2)))"),
                ],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.m1,
                1 => self.m2,
                2 => self.l1,
                3 => self.l2,
                4 => self.g,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.m1 = value,
                1 => self.m2 = value,
                2 => self.l1 = value,
                3 => self.l2 = value,
                4 => self.g = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 10>(prepared, "prepared");
            let [m1, m2, l1, l2, g] = *ukcore::emitted::exact::<S, 5>(given, "given");
            let lit = S::from_f64;
            let right_y1 = m1 * g;
            prepared[0] = right_y1;
            let right_y2 = m2 * g;
            prepared[1] = right_y2;
            prepared[2] = l1 * l1;
            prepared[3] = l2 * l2;
            prepared[4] = m1;
            prepared[5] = m2;
            prepared[6] = m2.recip();
            prepared[7] = m1.recip();
            prepared[8] = g;
            let safe_x2 = S::select_le(
                m2,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m2, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            let safe_x1 = S::select_le(
                m1,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m1, safe_x2, lit(0.0)),
                lit(0.0),
            );
            prepared[9] = safe_x1;
        }
        /// 8 additions, 12 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 0 selections.
        fn dynamics<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut ukcore::Terms<'_, S>,
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 16>(out.mass, "mass");
            let force = ukcore::emitted::exact_mut::<S, 4>(out.force, "force");
            let nonideal = ukcore::emitted::exact_mut::<S, 4>(out.nonideal, "nonideal");
            let jacobian = ukcore::emitted::exact_mut::<S, 8>(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 2>(out.rhs, "rhs");
            let [right_y1, right_y2, _, _, m1, m2, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                10,
            >(prepared, "prepared");
            let [x1, y1, x2, y2] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [dot_x1, dot_y1, dot_x2, dot_y2] = *ukcore::emitted::exact::<
                S,
                4,
            >(v, "v");
            let lit = S::from_f64;
            mass[0] = m1;
            mass[5] = m1;
            mass[10] = m2;
            mass[15] = m2;
            force[0] = lit(0.0);
            force[1] = -right_y1;
            force[2] = lit(0.0);
            force[3] = -right_y2;
            nonideal[0] = lit(0.0);
            nonideal[1] = lit(0.0);
            nonideal[2] = lit(0.0);
            nonideal[3] = lit(0.0);
            jacobian[0] = lit(2.0) * x1;
            jacobian[2] = lit(2.0) * y1;
            let x1_minus_x2 = x1 - x2;
            jacobian[1] = lit(2.0) * x1_minus_x2;
            let y1_minus_y2 = y1 - y2;
            jacobian[3] = lit(2.0) * y1_minus_y2;
            jacobian[5] = lit(-2.0) * x1_minus_x2;
            jacobian[7] = lit(-2.0) * y1_minus_y2;
            rhs[0] = lit(-2.0) * dot_y1.mul_add(dot_y1, dot_x1 * dot_x1);
            let dot_x1_minus_dot_x2 = dot_x1 - dot_x2;
            let dot_y1_minus_dot_y2 = dot_y1 - dot_y2;
            rhs[1] = lit(-2.0)
                * dot_y1_minus_dot_y2
                    .mul_add(
                        dot_y1_minus_dot_y2,
                        dot_x1_minus_dot_x2 * dot_x1_minus_dot_x2,
                    );
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 16>(mass, "mass");
            let [_, _, _, _, m1, m2, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                10,
            >(prepared, "prepared");
            mass[0] = m1;
            mass[5] = m1;
            mass[10] = m2;
            mass[15] = m2;
        }
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {
            let jacobian = ukcore::emitted::exact_mut::<S, 8>(jacobian, "jacobian");
            let [x1, y1, x2, y2] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let lit = S::from_f64;
            jacobian[0] = lit(2.0) * x1;
            jacobian[2] = lit(2.0) * y1;
            let x1_minus_x2 = x1 - x2;
            jacobian[1] = lit(2.0) * x1_minus_x2;
            let y1_minus_y2 = y1 - y2;
            jacobian[3] = lit(2.0) * y1_minus_y2;
            jacobian[5] = lit(-2.0) * x1_minus_x2;
            jacobian[7] = lit(-2.0) * y1_minus_y2;
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 2>(phi, "phi");
            let [_, _, sq_l1, sq_l2, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                10,
            >(prepared, "prepared");
            let [x1, y1, x2, y2] = *ukcore::emitted::exact::<S, 4>(q, "q");
            phi[0] = y1.mul_add(y1, x1 * x1 - sq_l1);
            let x1_minus_x2 = x1 - x2;
            let y1_minus_y2 = y1 - y2;
            phi[1] = y1_minus_y2.mul_add(y1_minus_y2, x1_minus_x2 * x1_minus_x2 - sq_l2);
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 2>(rate, "rate");
            let [x1, y1, x2, y2] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [dot_x1, dot_y1, dot_x2, dot_y2] = *ukcore::emitted::exact::<
                S,
                4,
            >(v, "v");
            let lit = S::from_f64;
            rate[0] = lit(2.0) * y1.mul_add(dot_y1, x1 * dot_x1);
            rate[1] = lit(2.0)
                * (y1 - y2).mul_add((dot_y1 - dot_y2), (x1 - x2) * (dot_x1 - dot_x2));
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [right_y1, right_y2, _, _, m1, m2, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                10,
            >(prepared, "prepared");
            let [_, y1, _, y2] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [dot_x1, dot_y1, dot_x2, dot_y2] = *ukcore::emitted::exact::<
                S,
                4,
            >(v, "v");
            let lit = S::from_f64;
            let kinetic = lit(0.5)
                * (dot_y2 * dot_y2)
                    .mul_add(
                        m2,
                        (dot_x2 * dot_x2)
                            .mul_add(
                                m2,
                                (dot_y1 * dot_y1).mul_add(m1, dot_x1 * dot_x1 * m1),
                            ),
                    );
            let potential = y2.mul_add(right_y2, y1 * right_y1);
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
            let outputs = ukcore::emitted::exact_mut::<S, 2>(outputs, "outputs");
            let [x1, y1, x2, y2] = *ukcore::emitted::exact::<S, 4>(q, "q");
            outputs[0] = x1.atan2(-y1);
            outputs[1] = (x2 - x1).atan2(y1 - y2);
        }
        /// 24 additions, 43 multiplications, 2 divisions, 0 square roots, 0 transcendentals, 2 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 4>(out, "out");
            let [_, _, _, _, m1, _, per_m2, per_m1, g, safe_x1] = *ukcore::emitted::exact::<
                S,
                10,
            >(prepared, "prepared");
            let [x1, y1, x2, y2] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [dot_x1, dot_y1, dot_x2, dot_y2] = *ukcore::emitted::exact::<
                S,
                4,
            >(v, "v");
            let lit = S::from_f64;
            let pivot_inner = y1.mul_add(y1, x1 * x1);
            let per_pivot_inner = pivot_inner.recip();
            let safe_inner = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_inner,
                safe_x1,
                lit(0.0),
            );
            let right_inner = y1.neg_mul_add(g, dot_y1.mul_add(dot_y1, dot_x1 * dot_x1));
            let x1_minus_x2 = x1 - x2;
            let y1_minus_y2 = y1 - y2;
            let outer_with_inner = y1.mul_add(y1_minus_y2, x1 * x1_minus_x2);
            let acceleration_0_part = pivot_inner
                * (per_m1 * y1_minus_y2)
                    .mul_add(
                        y1_minus_y2,
                        (per_m1 * x1_minus_x2)
                            .mul_add(
                                x1_minus_x2,
                                (per_m2 * y1_minus_y2)
                                    .mul_add(y1_minus_y2, per_m2 * x1_minus_x2 * x1_minus_x2),
                            ),
                    );
            let pivot_outer = per_m1 * outer_with_inner * outer_with_inner
                - acceleration_0_part;
            let per_pivot_outer = pivot_outer.recip();
            let safe_outer = S::select_le(
                lit(0.0009765625) * acceleration_0_part,
                -pivot_outer,
                safe_inner,
                lit(0.0),
            );
            let dot_x1_minus_dot_x2 = dot_x1 - dot_x2;
            let dot_y1_minus_dot_y2 = dot_y1 - dot_y2;
            let right_outer = outer_with_inner
                .neg_mul_add(
                    right_inner,
                    pivot_inner
                        * dot_y1_minus_dot_y2
                            .mul_add(
                                dot_y1_minus_dot_y2,
                                dot_x1_minus_dot_x2 * dot_x1_minus_dot_x2,
                            ),
                );
            let safe = safe_outer;
            out[2] = -(per_m2 * x1_minus_x2 * right_outer * per_pivot_outer);
            out[3] = (per_m2 * y1_minus_y2 * right_outer)
                .neg_mul_add(per_pivot_outer, -g);
            let lambda_inner = (outer_with_inner * right_outer * per_pivot_inner)
                .mul_add(per_pivot_outer, m1 * right_inner * per_pivot_inner);
            out[1] = (y1 * per_m1)
                .neg_mul_add(
                    lambda_inner,
                    per_m1 * y1_minus_y2 * right_outer * per_pivot_outer - g,
                );
            out[0] = -(per_m1
                * (x1_minus_x2 * right_outer)
                    .neg_mul_add(per_pivot_outer, x1 * lambda_inner));
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
            let out = ukcore::emitted::exact_mut::<S, 4>(out, "out");
            let [_, _, _, _, m1, _, per_m2, per_m1, _, safe_x1] = *ukcore::emitted::exact::<
                S,
                10,
            >(prepared, "prepared");
            let [x1, y1, x2, y2] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [residual_0, residual_1] = *ukcore::emitted::exact::<
                S,
                2,
            >(residual, "residual");
            let lit = S::from_f64;
            let pivot_inner = y1.mul_add(y1, x1 * x1);
            let per_pivot_inner = pivot_inner.recip();
            let safe_inner = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_inner,
                safe_x1,
                lit(0.0),
            );
            let x1_minus_x2 = x1 - x2;
            let y1_minus_y2 = y1 - y2;
            let outer_with_inner = y1.mul_add(y1_minus_y2, x1 * x1_minus_x2);
            let correction_0_part = pivot_inner
                * (per_m1 * y1_minus_y2)
                    .mul_add(
                        y1_minus_y2,
                        (per_m1 * x1_minus_x2)
                            .mul_add(
                                x1_minus_x2,
                                (per_m2 * y1_minus_y2)
                                    .mul_add(y1_minus_y2, per_m2 * x1_minus_x2 * x1_minus_x2),
                            ),
                    );
            let pivot_outer = per_m1 * outer_with_inner * outer_with_inner
                - correction_0_part;
            let per_pivot_outer = pivot_outer.recip();
            let safe_outer = S::select_le(
                lit(0.0009765625) * correction_0_part,
                -pivot_outer,
                safe_inner,
                lit(0.0),
            );
            let right_inner = lit(0.5) * residual_0;
            let correction_0_part_2 = lit(0.5) * residual_1;
            let right_outer = correction_0_part_2
                .neg_mul_add(pivot_inner, right_inner * outer_with_inner);
            let safe = safe_outer;
            out[2] = per_m2 * x1_minus_x2 * right_outer * per_pivot_outer;
            out[3] = per_m2 * y1_minus_y2 * right_outer * per_pivot_outer;
            let lambda_inner = (outer_with_inner * right_outer * per_pivot_inner)
                .neg_mul_add(per_pivot_outer, m1 * right_inner * per_pivot_inner);
            out[0] = -(per_m1
                * x1.mul_add(lambda_inner, x1_minus_x2 * right_outer * per_pivot_outer));
            out[1] = -(per_m1
                * y1.mul_add(lambda_inner, y1_minus_y2 * right_outer * per_pivot_outer));
            safe
        }
    }
};
