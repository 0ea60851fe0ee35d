/// The double pendulum in the angles of its rods from the downward vertical, declared by its energies alone.
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Mass matrix M (lower triangle), eq. 1:
///
/// ```text
/// M[th1, th1] = (m1 + m2)*sq(l1)
/// M[th2, th1] = m2*l1*l2*cos(th1 - th2)
/// M[th2, th2] = m2*sq(l2)
/// ```
///
/// Generalised force Q, eq. 1:
///
/// ```text
/// Q[th1] = m2*l1*l2*dot(th2)*(dot(th1) - dot(th2))*sin(th1 - th2) - m2*l1*dot(th1)*l2*dot(th2)*sin(th1 - th2) - (m1 + m2)*l1*g*sin(th1)
/// Q[th2] = m2*l1*dot(th1)*l2*dot(th2)*sin(th1 - th2) + m2*l1*dot(th1)*l2*(dot(th1) - dot(th2))*sin(th1 - th2) - m2*l2*g*sin(th2)
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 0 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 6 | 12 | 0 | 0 | 3 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 3 | 6 | 2 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 10 | 44 | 5 | 0 | 3 | 3 |
/// | straight line, as emitted | 9 | 25 | 1 | 0 | 3 | 1 |
/// | correction of a projection | 2 | 3 | 0 | 0 | 1 | 1 |
/// | once for a set of parameters | 1 | 20 | 4 | 0 | 0 | 2 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct DoublePendulumAngles {
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
impl ::core::default::Default for DoublePendulumAngles {
    fn default() -> Self {
        DoublePendulumAngles {
            m1: 1.0,
            m2: 1.0,
            l1: 1.0,
            l2: 1.0,
            g: 9.8125,
        }
    }
}
#[allow(dead_code)]
impl DoublePendulumAngles {
    /// Position in q of coordinate `th1`.
    pub const TH1: usize = 0;
    /// Position in q of coordinate `th2`.
    pub const TH2: usize = 1;
    /// Position of output `x1`.
    pub const OUT_X1: usize = 0;
    /// Position of output `y1`.
    pub const OUT_Y1: usize = 1;
    /// Position of output `x2`.
    pub const OUT_X2: usize = 2;
    /// Position of output `y2`.
    pub const OUT_Y2: usize = 3;
}
const _: () = {
    use ::ukcore as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<DoublePendulumAngles> for ukcore::Prepared {
        fn from(mechanism: DoublePendulumAngles) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for DoublePendulumAngles {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "DoublePendulumAngles",
            doc: "The double pendulum in the angles of its rods from the downward vertical, declared by its energies alone.",
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
                ("pivot_th1", "(m1 + m2)*sq(l1)"),
                ("diagonal_th2", "m2*sq(l2)"),
                ("m2_l1_l2", "m2*l1*l2"),
                ("half_m1_and_m2_sq_l1", "0.5*(m1 + m2)*sq(l1)"),
                ("half_m2_sq_l2", "0.5*m2*sq(l2)"),
                ("m1_and_m2_l1_g", "(m1 + m2)*l1*g"),
                ("m2_l2_g", "m2*l2*g"),
                ("l1", "l1"),
                ("l2", "l2"),
                ("m2_l2", "m2*l2"),
                ("m1_and_m2_g", "(m1 + m2)*g"),
                ("m2_per_m1_and_m2_l2", "m2*l2/(m1 + m2)"),
                ("m2_per_m1_and_m2", "m2/(m1 + m2)"),
                ("prepared_part", "1/(m2*sq(l2))"),
                ("per_l2", "1/l2"),
                ("per_m1_and_m2_per_l1", "1/((m1 + m2)*l1)"),
                ("times_m2_sq_l2", "0.0009765625*m2*sq(l2)"),
                (
                    "safe_th1",
                    "1 if the pivots that depend on m1, m2, l1 alone are positive and finite, else 0",
                ),
            ],
            coords: &["th1", "th2"],
            constraints: &[],
            holonomic: 0,
            outputs: &[
                ukcore::OutputSpec {
                    name: "x1",
                    doc: "Horizontal position of the inner mass, m",
                },
                ukcore::OutputSpec {
                    name: "y1",
                    doc: "Vertical position of the inner mass, upwards, m",
                },
                ukcore::OutputSpec {
                    name: "x2",
                    doc: "Horizontal position of the outer mass, m",
                },
                ukcore::OutputSpec {
                    name: "y2",
                    doc: "Vertical position of the outer mass, upwards, m",
                },
            ],
            switches: &[],
            structure: ukcore::Structure {
                straight_line: true,
                solve: ukcore::Solve {
                    refusal: "",
                    pivots: &[
                        ukcore::Pivot::Coordinate(0),
                        ukcore::Pivot::Coordinate(1),
                    ],
                    fill: &[],
                    checks: &[ukcore::Check::Positive(0), ukcore::Check::Share(1)],
                    least_share: 0.0009765625,
                },
                mass_pattern: &[(0, 0), (0, 1), (1, 0), (1, 1)],
                jacobian_pattern: &[],
                mass_diagonal: false,
                mass_constant: false,
                jacobian_constant: true,
                massless: &[],
                angles: &[0, 1],
                scleronomic: true,
                nonideal: false,
                potential: true,
                conservative: true,
                left_out: &[
                    "constraint solve: there are no constraints, M q\u{308} = Q",
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 6,
                        multiplications: 12,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 3,
                        selections: 0,
                    },
                    dense: ukcore::Operations {
                        additions: 3,
                        multiplications: 6,
                        divisions: 2,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    unprepared: ukcore::Operations {
                        additions: 10,
                        multiplications: 44,
                        divisions: 5,
                        square_roots: 0,
                        transcendentals: 3,
                        selections: 3,
                    },
                    acceleration: ukcore::Operations {
                        additions: 9,
                        multiplications: 25,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 3,
                        selections: 1,
                    },
                    correction: ukcore::Operations {
                        additions: 2,
                        multiplications: 3,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 1,
                    },
                    prepare: ukcore::Operations {
                        additions: 1,
                        multiplications: 20,
                        divisions: 4,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 2,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[],
                mass: &[
                    (0, 0, "(m1 + m2)*sq(l1)"),
                    (1, 0, "m2*l1*l2*cos(th1 - th2)"),
                    (1, 1, "m2*sq(l2)"),
                ],
                force: &[
                    (
                        0,
                        "m2*l1*l2*dot(th2)*(dot(th1) - dot(th2))*sin(th1 - th2) - m2*l1*dot(th1)*l2*dot(th2)*sin(th1 - th2) - (m1 + m2)*l1*g*sin(th1)",
                    ),
                    (
                        1,
                        "m2*l1*dot(th1)*l2*dot(th2)*sin(th1 - th2) + m2*l1*dot(th1)*l2*(dot(th1) - dot(th2))*sin(th1 - th2) - m2*l2*g*sin(th2)",
                    ),
                ],
                nonideal: &[],
                jacobian: &[],
                rhs: &[],
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
            let prepared = ukcore::emitted::exact_mut::<S, 18>(prepared, "prepared");
            let [m1, m2, l1, l2, g] = *ukcore::emitted::exact::<S, 5>(given, "given");
            let lit = S::from_f64;
            let m1_plus_m2 = m1 + m2;
            let per_m1_plus_m2 = m1_plus_m2.recip();
            let pivot_th1 = l1 * l1 * m1_plus_m2;
            prepared[0] = pivot_th1;
            let diagonal_th2 = m2 * l2 * l2;
            prepared[1] = diagonal_th2;
            prepared[2] = m2 * l1 * l2;
            prepared[3] = lit(0.5) * pivot_th1;
            prepared[4] = lit(0.5) * diagonal_th2;
            prepared[5] = l1 * g * m1_plus_m2;
            prepared[6] = m2 * l2 * g;
            prepared[7] = l1;
            prepared[8] = l2;
            prepared[9] = m2 * l2;
            prepared[10] = g * m1_plus_m2;
            prepared[11] = m2 * l2 * per_m1_plus_m2;
            prepared[12] = m2 * per_m1_plus_m2;
            prepared[13] = (m2 * l2 * l2).recip();
            prepared[14] = l2.recip();
            prepared[15] = per_m1_plus_m2 / l1;
            prepared[16] = lit(0.0009765625) * diagonal_th2;
            let safe_th1 = S::select_le(
                pivot_th1,
                lit(1.7976931348623157e308),
                S::select_le(
                    lit(2.2250738585072014e-308),
                    pivot_th1,
                    lit(1.0),
                    lit(0.0),
                ),
                lit(0.0),
            );
            prepared[17] = safe_th1;
        }
        /// 6 additions, 12 multiplications, 0 divisions, 0 square roots, 3 transcendentals, 0 selections.
        fn dynamics<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut ukcore::Terms<'_, S>,
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 4>(out.mass, "mass");
            let force = ukcore::emitted::exact_mut::<S, 2>(out.force, "force");
            let nonideal = ukcore::emitted::exact_mut::<S, 2>(out.nonideal, "nonideal");
            let jacobian = ukcore::emitted::exact_mut::<S, 0>(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 0>(out.rhs, "rhs");
            let [pivot_th1, diagonal_th2, m2_l1_l2, _, _, m1_and_m2_l1_g, m2_l2_g, _, _,
            _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                18,
            >(prepared, "prepared");
            let [th1, th2] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_th1, dot_th2] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            mass[0] = pivot_th1;
            let th1_minus_th2 = th1 - th2;
            let (sin_th1_minus_th2, th2_by_th1) = th1_minus_th2.sin_cos();
            let th2_by_th1_m2_l1_l2 = m2_l1_l2 * th2_by_th1;
            mass[1] = th2_by_th1_m2_l1_l2;
            mass[2] = th2_by_th1_m2_l1_l2;
            mass[3] = diagonal_th2;
            let dot_th1_minus_dot_th2 = dot_th1 - dot_th2;
            let force_0_part = dot_th1 * dot_th2 * m2_l1_l2 * sin_th1_minus_th2;
            force[0] = m1_and_m2_l1_g
                .neg_mul_add(
                    th1.sin(),
                    dot_th2 * m2_l1_l2 * dot_th1_minus_dot_th2 * sin_th1_minus_th2,
                ) - force_0_part;
            force[1] = (dot_th1 * m2_l1_l2 * dot_th1_minus_dot_th2)
                .mul_add(
                    sin_th1_minus_th2,
                    m2_l2_g.neg_mul_add(th2.sin(), force_0_part),
                );
            nonideal[0] = lit(0.0);
            nonideal[1] = lit(0.0);
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 4>(mass, "mass");
            let [pivot_th1, diagonal_th2, m2_l1_l2, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _] = *ukcore::emitted::exact::<S, 18>(prepared, "prepared");
            let [th1, th2] = *ukcore::emitted::exact::<S, 2>(q, "q");
            mass[0] = pivot_th1;
            let th2_by_th1 = (th1 - th2).cos();
            let th2_by_th1_m2_l1_l2 = m2_l1_l2 * th2_by_th1;
            mass[1] = th2_by_th1_m2_l1_l2;
            mass[2] = th2_by_th1_m2_l1_l2;
            mass[3] = diagonal_th2;
        }
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {
            let jacobian = ukcore::emitted::exact_mut::<S, 0>(jacobian, "jacobian");
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 0>(phi, "phi");
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 0>(rate, "rate");
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [_, _, m2_l1_l2, half_m1_and_m2_sq_l1, half_m2_sq_l2, m1_and_m2_l1_g,
            m2_l2_g, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                18,
            >(prepared, "prepared");
            let [th1, th2] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_th1, dot_th2] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let th2_by_th1 = (th1 - th2).cos();
            let kinetic = (dot_th1 * dot_th2 * m2_l1_l2)
                .mul_add(
                    th2_by_th1,
                    (dot_th2 * dot_th2)
                        .mul_add(half_m2_sq_l2, dot_th1 * dot_th1 * half_m1_and_m2_sq_l1),
                );
            let potential = m2_l2_g
                .neg_mul_add(th2.cos(), -(m1_and_m2_l1_g * th1.cos()));
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
            let outputs = ukcore::emitted::exact_mut::<S, 4>(outputs, "outputs");
            let [_, _, _, _, _, _, _, l1, l2, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                18,
            >(prepared, "prepared");
            let [th1, th2] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let (sin_th1, cos_th1) = th1.sin_cos();
            let sin_th1_l1 = l1 * sin_th1;
            outputs[0] = sin_th1_l1;
            let cos_th1_l1 = l1 * cos_th1;
            outputs[1] = -cos_th1_l1;
            let (sin_th2, cos_th2) = th2.sin_cos();
            outputs[2] = l2.mul_add(sin_th2, sin_th1_l1);
            outputs[3] = l2.neg_mul_add(cos_th2, -cos_th1_l1);
        }
        /// 9 additions, 25 multiplications, 1 divisions, 0 square roots, 3 transcendentals, 1 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 2>(out, "out");
            let [_, diagonal_th2, m2_l1_l2, _, _, _, m2_l2_g, _, _, m2_l2, m1_and_m2_g,
            m2_per_m1_and_m2_l2, m2_per_m1_and_m2, prepared_part, per_l2,
            per_m1_and_m2_per_l1, times_m2_sq_l2, safe_th1] = *ukcore::emitted::exact::<
                S,
                18,
            >(prepared, "prepared");
            let [th1, th2] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_th1, dot_th2] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            let dot_th1_minus_dot_th2 = dot_th1 - dot_th2;
            let th1_minus_th2 = th1 - th2;
            let (sin_th1_minus_th2, th2_by_th1) = th1_minus_th2.sin_cos();
            let right_th1 = (dot_th1 * dot_th2 * m2_l2)
                .neg_mul_add(
                    sin_th1_minus_th2,
                    m1_and_m2_g
                        .neg_mul_add(
                            th1.sin(),
                            dot_th2 * m2_l2 * dot_th1_minus_dot_th2 * sin_th1_minus_th2,
                        ),
                );
            let pivot_th2 = (m2_per_m1_and_m2 * th2_by_th1)
                .neg_mul_add(th2_by_th1, lit(1.0));
            let per_pivot_th2 = pivot_th2.recip();
            let safe_th2 = S::select_le(
                times_m2_sq_l2,
                diagonal_th2 * pivot_th2,
                safe_th1,
                lit(0.0),
            );
            let right_th2 = (m2_per_m1_and_m2_l2 * th2_by_th1)
                .neg_mul_add(
                    right_th1,
                    (dot_th1 * m2_l1_l2 * dot_th1_minus_dot_th2)
                        .mul_add(
                            sin_th1_minus_th2,
                            m2_l2_g
                                .neg_mul_add(
                                    th2.sin(),
                                    dot_th1 * dot_th2 * m2_l1_l2 * sin_th1_minus_th2,
                                ),
                        ),
                );
            let safe = safe_th2;
            out[1] = prepared_part * right_th2 * per_pivot_th2;
            out[0] = per_m1_and_m2_per_l1
                * (per_l2 * th2_by_th1 * right_th2)
                    .neg_mul_add(per_pivot_th2, right_th1);
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
            let out = ukcore::emitted::exact_mut::<S, 2>(out, "out");
            let [_, diagonal_th2, _, _, _, _, _, _, _, _, _, _, m2_per_m1_and_m2, _, _,
            _, times_m2_sq_l2, safe_th1] = *ukcore::emitted::exact::<
                S,
                18,
            >(prepared, "prepared");
            let [th1, th2] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let lit = S::from_f64;
            let th2_by_th1 = (th1 - th2).cos();
            let pivot_th2 = (m2_per_m1_and_m2 * th2_by_th1)
                .neg_mul_add(th2_by_th1, lit(1.0));
            let safe_th2 = S::select_le(
                times_m2_sq_l2,
                diagonal_th2 * pivot_th2,
                safe_th1,
                lit(0.0),
            );
            out[0] = lit(0.0);
            out[1] = lit(0.0);
            let safe = safe_th2;
            safe
        }
    }
};
