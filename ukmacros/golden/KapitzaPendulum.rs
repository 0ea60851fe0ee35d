/// Pendulum whose pivot moves vertically as a cos(w t), in Cartesian coordinates of the bob; y points up. The rod's constraint
/// contains the time.
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Abbreviations:
///
/// ```text
/// pivot = a*cos(w*t)
/// ```
///
/// Mass matrix M (lower triangle), eq. 1:
///
/// ```text
/// M[x, x] = m
/// M[y, y] = m
/// ```
///
/// Generalised force Q, eq. 1:
///
/// ```text
/// Q[y] = -m*g
/// ```
///
/// Constraints φ, eqs. 3 and 4:
///
/// ```text
/// rod: sq(x) + sq(pivot - y) - sq(l) = 0
/// ```
///
/// Constraint Jacobian A, eq. 5:
///
/// ```text
/// A[rod, x] = 2*x
/// A[rod, y] = 2*(y - pivot)
/// ```
///
/// Right-hand side b, eq. 5:
///
/// ```text
/// b[rod] = 2*(a*sq(w)*cos(w*t)*(pivot - y) - sq(dot(x)) - sq(dot(y) + a*w*sin(w*t)))
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 0 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 5 | 10 | 0 | 0 | 1 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 10 | 16 | 3 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 9 | 17 | 1 | 0 | 1 | 3 |
/// | straight line, as emitted | 9 | 14 | 1 | 0 | 1 | 1 |
/// | correction of a projection | 4 | 9 | 1 | 0 | 1 | 1 |
/// | once for a set of parameters | 0 | 5 | 0 | 0 | 0 | 2 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct KapitzaPendulum {
    /// Mass of the bob, kg
    pub m: f64,
    /// Length of the rod, m
    pub l: f64,
    /// Acceleration of gravity, m/s^2
    pub g: f64,
    /// Amplitude of the pivot, m
    pub a: f64,
    /// Angular frequency of the pivot, rad/s
    pub w: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for KapitzaPendulum {
    fn default() -> Self {
        KapitzaPendulum {
            m: 1.0,
            l: 1.0,
            g: 9.81,
            a: 0.1,
            w: 100.0,
        }
    }
}
#[allow(dead_code)]
impl KapitzaPendulum {
    /// Position in q of coordinate `x`.
    pub const X: usize = 0;
    /// Position in q of coordinate `y`.
    pub const Y: usize = 1;
    /// Row in A of constraint `rod`.
    pub const ROD: usize = 0;
    /// Position of output `angle`.
    pub const OUT_ANGLE: usize = 0;
    /// Position of output `pivot_y`.
    pub const OUT_PIVOT_Y: usize = 1;
}
const _: () = {
    use ::ukcore as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<KapitzaPendulum> for ukcore::Prepared {
        fn from(mechanism: KapitzaPendulum) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for KapitzaPendulum {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "KapitzaPendulum",
            doc: "Pendulum whose pivot moves vertically as a cos(w t), in Cartesian coordinates of the bob; y points up. The rod's constraint\ncontains the time.",
            params: &[
                ukcore::ParamSpec {
                    name: "m",
                    doc: "Mass of the bob, kg",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "l",
                    doc: "Length of the rod, m",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "g",
                    doc: "Acceleration of gravity, m/s^2",
                    default: 9.81,
                },
                ukcore::ParamSpec {
                    name: "a",
                    doc: "Amplitude of the pivot, m",
                    default: 0.1,
                },
                ukcore::ParamSpec {
                    name: "w",
                    doc: "Angular frequency of the pivot, rad/s",
                    default: 100.0,
                },
            ],
            prepared: &[
                ("w", "w"),
                ("a", "a"),
                ("m_g", "m*g"),
                ("sq_l", "sq(l)"),
                ("m", "m"),
                ("a_w", "a*w"),
                ("a_sq_w", "a*sq(w)"),
                ("g", "g"),
                (
                    "safe_x",
                    "1 if the pivots that depend on m alone are positive and finite, else 0",
                ),
            ],
            coords: &["x", "y"],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "rod",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x) + sq(pivot - y) - sq(l) = 0",
                },
            ],
            holonomic: 1,
            outputs: &[
                ukcore::OutputSpec {
                    name: "angle",
                    doc: "Angle from the upward vertical, clockwise, rad",
                },
                ukcore::OutputSpec {
                    name: "pivot_y",
                    doc: "Height of the pivot, m",
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
                        ukcore::Pivot::Constraint(0),
                    ],
                    fill: &[],
                    checks: &[ukcore::Check::Positive(0), ukcore::Check::Positive(2)],
                    least_share: 0.0009765625,
                },
                mass_pattern: &[(0, 0), (1, 1)],
                jacobian_pattern: &[(0, 0), (0, 1)],
                mass_diagonal: true,
                mass_constant: true,
                jacobian_constant: false,
                massless: &[],
                angles: &[],
                scleronomic: false,
                nonideal: false,
                potential: true,
                conservative: false,
                left_out: &[
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "1 of 2 entries of Q: identically zero",
                    "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 5,
                        multiplications: 10,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 0,
                    },
                    dense: ukcore::Operations {
                        additions: 10,
                        multiplications: 16,
                        divisions: 3,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    unprepared: ukcore::Operations {
                        additions: 9,
                        multiplications: 17,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 3,
                    },
                    acceleration: ukcore::Operations {
                        additions: 9,
                        multiplications: 14,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 1,
                    },
                    correction: ukcore::Operations {
                        additions: 4,
                        multiplications: 9,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 1,
                    },
                    prepare: ukcore::Operations {
                        additions: 0,
                        multiplications: 5,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 2,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[("pivot", "a*cos(w*t)")],
                mass: &[(0, 0, "m"), (1, 1, "m")],
                force: &[(1, "-m*g")],
                nonideal: &[],
                jacobian: &[(0, 0, "2*x"), (0, 1, "2*(y - pivot)")],
                rhs: &[
                    (
                        0,
                        "2*(a*sq(w)*cos(w*t)*(pivot - y) - sq(dot(x)) - sq(dot(y) + a*w*sin(w*t)))",
                    ),
                ],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.m,
                1 => self.l,
                2 => self.g,
                3 => self.a,
                4 => self.w,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.m = value,
                1 => self.l = value,
                2 => self.g = value,
                3 => self.a = value,
                4 => self.w = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 9>(prepared, "prepared");
            let [m, l, g, a, w] = *ukcore::emitted::exact::<S, 5>(given, "given");
            let lit = S::from_f64;
            prepared[0] = w;
            prepared[1] = a;
            prepared[2] = m * g;
            prepared[3] = l * l;
            prepared[4] = m;
            prepared[5] = a * w;
            prepared[6] = a * w * w;
            prepared[7] = g;
            let safe_x = S::select_le(
                m,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            prepared[8] = safe_x;
        }
        /// 5 additions, 10 multiplications, 0 divisions, 0 square roots, 1 transcendentals, 0 selections.
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
            let jacobian = ukcore::emitted::exact_mut::<S, 2>(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 1>(out.rhs, "rhs");
            let [w, a, m_g, _, m, a_w, a_sq_w, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            mass[0] = m;
            mass[3] = m;
            force[0] = lit(0.0);
            force[1] = -m_g;
            nonideal[0] = lit(0.0);
            nonideal[1] = lit(0.0);
            jacobian[0] = lit(2.0) * x;
            let t_w = t * w;
            let (sin_t_w, cos_t_w) = t_w.sin_cos();
            let pivot = a * cos_t_w;
            let y_minus_pivot = y - pivot;
            jacobian[1] = lit(2.0) * y_minus_pivot;
            let b_0_part = a_w.mul_add(sin_t_w, dot_y);
            rhs[0] = lit(-2.0)
                * (a_sq_w * cos_t_w)
                    .mul_add(y_minus_pivot, b_0_part.mul_add(b_0_part, dot_x * dot_x));
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 4>(mass, "mass");
            let [_, _, _, _, m, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            mass[0] = m;
            mass[3] = m;
        }
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {
            let jacobian = ukcore::emitted::exact_mut::<S, 2>(jacobian, "jacobian");
            let [w, a, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let lit = S::from_f64;
            jacobian[0] = lit(2.0) * x;
            let pivot = a * (t * w).cos();
            jacobian[1] = lit(2.0) * (y - pivot);
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 1>(phi, "phi");
            let [w, a, _, sq_l, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let pivot = a * (t * w).cos();
            let y_minus_pivot = y - pivot;
            phi[0] = y_minus_pivot.mul_add(y_minus_pivot, x * x - sq_l);
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 1>(rate, "rate");
            let [w, a, _, _, _, a_w, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            let t_w = t * w;
            let (sin_t_w, cos_t_w) = t_w.sin_cos();
            let pivot = a * cos_t_w;
            rate[0] = lit(2.0)
                * (y - pivot).mul_add(a_w.mul_add(sin_t_w, dot_y), x * dot_x);
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [_, _, m_g, _, m, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [_, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            let kinetic = lit(0.5) * (dot_y * dot_y).mul_add(m, dot_x * dot_x * m);
            let potential = y * m_g;
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
            let [w, a, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let pivot = a * (t * w).cos();
            outputs[0] = x.atan2(y - pivot);
            outputs[1] = pivot;
        }
        /// 9 additions, 14 multiplications, 1 divisions, 0 square roots, 1 transcendentals, 1 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 2>(out, "out");
            let [w, a, _, _, _, a_w, a_sq_w, g, safe_x] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            let t_w = t * w;
            let (sin_t_w, cos_t_w) = t_w.sin_cos();
            let pivot = a * cos_t_w;
            let y_minus_pivot = y - pivot;
            let pivot_rod = y_minus_pivot.mul_add(y_minus_pivot, x * x);
            let per_pivot_rod = pivot_rod.recip();
            let safe_rod = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_rod,
                safe_x,
                lit(0.0),
            );
            let acceleration_0_part = a_w.mul_add(sin_t_w, dot_y);
            let right_rod = g
                .neg_mul_add(
                    y_minus_pivot,
                    (a_sq_w * cos_t_w)
                        .mul_add(
                            y_minus_pivot,
                            acceleration_0_part
                                .mul_add(acceleration_0_part, dot_x * dot_x),
                        ),
                );
            let safe = safe_rod;
            out[0] = -(x * right_rod * per_pivot_rod);
            out[1] = (y_minus_pivot * right_rod).neg_mul_add(per_pivot_rod, -g);
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
            let [w, a, _, _, _, _, _, _, safe_x] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [residual_0] = *ukcore::emitted::exact::<S, 1>(residual, "residual");
            let lit = S::from_f64;
            let pivot = a * (t * w).cos();
            let y_minus_pivot = y - pivot;
            let pivot_rod = y_minus_pivot.mul_add(y_minus_pivot, x * x);
            let per_pivot_rod = pivot_rod.recip();
            let safe_rod = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_rod,
                safe_x,
                lit(0.0),
            );
            let right_rod = lit(0.5) * residual_0;
            let safe = safe_rod;
            out[0] = -(x * right_rod * per_pivot_rod);
            out[1] = -(right_rod * y_minus_pivot * per_pivot_rod);
            safe
        }
    }
};
