/// Point mass on a massless spring about a pivot at the origin; y points up. The stiffer the spring, the more it is a
/// [`Pendulum`](crate::Pendulum), and the shorter the steps of an explicit method, which has to follow the oscillation along the spring, be it there or not.
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Abbreviations:
///
/// ```text
/// r = sqrt(sq(x) + sq(y))
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
/// Q[x] = -x*k*(r - l)/r
/// Q[y] = -(y*k*(r - l)/r + m*g)
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 0 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 5 | 8 | 1 | 1 | 0 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 3 | 6 | 2 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 5 | 10 | 2 | 1 | 0 | 2 |
/// | straight line, as emitted | 5 | 8 | 1 | 1 | 0 | 0 |
/// | correction of a projection | 0 | 0 | 0 | 0 | 0 | 0 |
/// | once for a set of parameters | 0 | 2 | 1 | 0 | 0 | 2 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct SpringPendulum {
    /// Mass, kg
    pub m: f64,
    /// Length of the relaxed spring, m
    pub l: f64,
    /// Stiffness of the spring, N/m
    pub k: f64,
    /// Acceleration of gravity, m/s^2
    pub g: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for SpringPendulum {
    fn default() -> Self {
        SpringPendulum {
            m: 1.0,
            l: 1.0,
            k: 10000.0,
            g: 9.81,
        }
    }
}
#[allow(dead_code)]
impl SpringPendulum {
    /// Position in q of coordinate `x`.
    pub const X: usize = 0;
    /// Position in q of coordinate `y`.
    pub const Y: usize = 1;
    /// Position of output `angle`.
    pub const OUT_ANGLE: usize = 0;
    /// Position of output `extension`.
    pub const OUT_EXTENSION: usize = 1;
    /// Position of output `tension`.
    pub const OUT_TENSION: usize = 2;
}
const _: () = {
    use ::ukcore as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<SpringPendulum> for ukcore::Prepared {
        fn from(mechanism: SpringPendulum) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for SpringPendulum {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "SpringPendulum",
            doc: "Point mass on a massless spring about a pivot at the origin; y points up. The stiffer the spring, the more it is a\n[`Pendulum`](crate::Pendulum), and the shorter the steps of an explicit method, which has to follow the oscillation along the spring, be it there or not.",
            params: &[
                ukcore::ParamSpec {
                    name: "m",
                    doc: "Mass, kg",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "l",
                    doc: "Length of the relaxed spring, m",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "k",
                    doc: "Stiffness of the spring, N/m",
                    default: 10000.0,
                },
                ukcore::ParamSpec {
                    name: "g",
                    doc: "Acceleration of gravity, m/s^2",
                    default: 9.81,
                },
            ],
            prepared: &[
                ("l", "l"),
                ("k", "k"),
                ("m_g", "m*g"),
                ("half_k", "0.5*k"),
                ("m", "m"),
                ("per_m_k", "k/m"),
                ("g", "g"),
                (
                    "safe_x",
                    "1 if the pivots that depend on m alone are positive and finite, else 0",
                ),
            ],
            coords: &["x", "y"],
            constraints: &[],
            holonomic: 0,
            outputs: &[
                ukcore::OutputSpec {
                    name: "angle",
                    doc: "Angle from the downward vertical, counter-clockwise, rad",
                },
                ukcore::OutputSpec {
                    name: "extension",
                    doc: "Extension of the spring, m",
                },
                ukcore::OutputSpec {
                    name: "tension",
                    doc: "Force of the spring, N",
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
                    checks: &[ukcore::Check::Positive(0)],
                    least_share: 0.0009765625,
                },
                mass_pattern: &[(0, 0), (1, 1)],
                jacobian_pattern: &[],
                mass_diagonal: true,
                mass_constant: true,
                jacobian_constant: true,
                massless: &[],
                angles: &[],
                scleronomic: true,
                nonideal: false,
                potential: true,
                conservative: true,
                left_out: &[
                    "constraint solve: there are no constraints, M q\u{308} = Q",
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 5,
                        multiplications: 8,
                        divisions: 1,
                        square_roots: 1,
                        transcendentals: 0,
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
                        additions: 5,
                        multiplications: 10,
                        divisions: 2,
                        square_roots: 1,
                        transcendentals: 0,
                        selections: 2,
                    },
                    acceleration: ukcore::Operations {
                        additions: 5,
                        multiplications: 8,
                        divisions: 1,
                        square_roots: 1,
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
                        multiplications: 2,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 2,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[("r", "sqrt(sq(x) + sq(y))")],
                mass: &[(0, 0, "m"), (1, 1, "m")],
                force: &[(0, "-x*k*(r - l)/r"), (1, "-(y*k*(r - l)/r + m*g)")],
                nonideal: &[],
                jacobian: &[],
                rhs: &[],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.m,
                1 => self.l,
                2 => self.k,
                3 => self.g,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.m = value,
                1 => self.l = value,
                2 => self.k = value,
                3 => self.g = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 8>(prepared, "prepared");
            let [m, l, k, g] = *ukcore::emitted::exact::<S, 4>(given, "given");
            let lit = S::from_f64;
            prepared[0] = l;
            prepared[1] = k;
            prepared[2] = m * g;
            prepared[3] = lit(0.5) * k;
            prepared[4] = m;
            prepared[5] = k / m;
            prepared[6] = g;
            let safe_x = S::select_le(
                m,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            prepared[7] = safe_x;
        }
        /// 5 additions, 8 multiplications, 1 divisions, 1 square roots, 0 transcendentals, 0 selections.
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
            let [l, k, m_g, _, m, _, _, _] = *ukcore::emitted::exact::<
                S,
                8,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let lit = S::from_f64;
            mass[0] = m;
            mass[3] = m;
            let r = y.mul_add(y, x * x).sqrt();
            let per_r = r.recip();
            let r_minus_l = r - l;
            force[0] = -(x * k * r_minus_l * per_r);
            force[1] = (y * k * r_minus_l).neg_mul_add(per_r, -m_g);
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
            let [_, _, _, _, m, _, _, _] = *ukcore::emitted::exact::<
                S,
                8,
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
            let [l, _, m_g, half_k, m, _, _, _] = *ukcore::emitted::exact::<
                S,
                8,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            let kinetic = lit(0.5) * (dot_y * dot_y).mul_add(m, dot_x * dot_x * m);
            let r = y.mul_add(y, x * x).sqrt();
            let r_minus_l = r - l;
            let potential = (half_k * r_minus_l).mul_add(r_minus_l, y * m_g);
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
            let [l, k, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                8,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            outputs[0] = x.atan2(-y);
            let r = y.mul_add(y, x * x).sqrt();
            let r_minus_l = r - l;
            outputs[1] = r_minus_l;
            outputs[2] = k * r_minus_l;
        }
        /// 5 additions, 8 multiplications, 1 divisions, 1 square roots, 0 transcendentals, 0 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 2>(out, "out");
            let [l, _, _, _, _, per_m_k, g, safe_x] = *ukcore::emitted::exact::<
                S,
                8,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let r = y.mul_add(y, x * x).sqrt();
            let per_r = r.recip();
            let r_minus_l = r - l;
            let right_x = x * per_m_k * r_minus_l * per_r;
            let right_y = (y * per_m_k * r_minus_l).mul_add(per_r, g);
            let safe = safe_x;
            out[0] = -right_x;
            out[1] = -right_y;
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
            let [_, _, _, _, _, _, _, safe_x] = *ukcore::emitted::exact::<
                S,
                8,
            >(prepared, "prepared");
            let lit = S::from_f64;
            out[0] = lit(0.0);
            out[1] = lit(0.0);
            let safe = safe_x;
            safe
        }
    }
};
