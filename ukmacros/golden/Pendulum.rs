/// Simple pendulum in Cartesian coordinates (closed form).
/// Point mass on a massless rigid rod about a pivot at the origin; y points up.
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Mass matrix M (lower triangle), eq. 1:
///
/// <p><math><msub><mi>M</mi><mrow><mi>x</mi><mo>,</mo><mi>x</mi></mrow></msub><mo>=</mo><mi>m</mi></math><br>
/// <math><msub><mi>M</mi><mrow><mi>y</mi><mo>,</mo><mi>y</mi></mrow></msub><mo>=</mo><mi>m</mi></math></p>
///
/// Generalised force Q, eq. 1:
///
/// <p><math><msub><mi>Q</mi><mi>y</mi></msub><mo>=</mo><mo>−</mo><mi>m</mi><mspace width="0.17em"/><mi>g</mi></math></p>
///
/// Constraints, eqs. 3 and 4, each with its row of the constraint Jacobian A and of b, eq. 5:
///
/// <p><math><mtext>rod:</mtext><mspace width="1em"/><msup><mi>x</mi><mn>2</mn></msup><mo>+</mo><msup><mi>y</mi><mn>2</mn></msup><mo>−</mo><msup><mi>l</mi><mn>2</mn></msup><mo>=</mo><mn>0</mn></math><br>
/// <math><msub><mi>A</mi><mrow><mi>rod</mi><mo>,</mo><mi>x</mi></mrow></msub><mo>=</mo><mn>2</mn><mspace width="0.17em"/><mi>x</mi></math><br>
/// <math><msub><mi>A</mi><mrow><mi>rod</mi><mo>,</mo><mi>y</mi></mrow></msub><mo>=</mo><mn>2</mn><mspace width="0.17em"/><mi>y</mi></math><br>
/// <math><msub><mi>b</mi><mi>rod</mi></msub><mo>=</mo><mo>−</mo><mn>2</mn><mspace width="0.17em"/><mo>(</mo><msup><mrow><mover><mi>x</mi><mo>˙</mo></mover></mrow><mn>2</mn></msup><mo>+</mo><msup><mrow><mover><mi>y</mi><mo>˙</mo></mover></mrow><mn>2</mn></msup><mo>)</mo></math></p>
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 0 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 2 | 5 | 0 | 0 | 0 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 10 | 16 | 3 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 5 | 9 | 1 | 0 | 0 | 3 |
/// | straight line, as emitted | 6 | 9 | 1 | 0 | 0 | 1 |
/// | correction of a projection | 3 | 7 | 1 | 0 | 0 | 1 |
/// | once for a set of parameters | 0 | 3 | 1 | 0 | 0 | 2 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct Pendulum {
    /// Mass
    ///
    /// Unit: kg.
    pub m: f64,
    /// Length of the rod
    ///
    /// Unit: m.
    pub l: f64,
    /// Acceleration of gravity
    ///
    /// Unit: m/s^2.
    pub g: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for Pendulum {
    fn default() -> Self {
        Pendulum {
            m: 1.0,
            l: 1.0,
            g: 9.81,
        }
    }
}
#[allow(dead_code)]
impl Pendulum {
    /// Position in q of coordinate `x`, in m.
    pub const X: usize = 0;
    /// Position in q of coordinate `y`, in m.
    pub const Y: usize = 1;
    /// Row in A of constraint `rod`.
    pub const ROD: usize = 0;
    /// Position of output `angle`, in rad.
    pub const OUT_ANGLE: usize = 0;
    /// Position of output `tension`, in N.
    pub const OUT_TENSION: usize = 1;
}
const _: () = {
    use ::ukcore::emitted as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<Pendulum> for ukcore::Prepared {
        fn from(mechanism: Pendulum) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for Pendulum {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "Pendulum",
            doc: "Simple pendulum in Cartesian coordinates (closed form).\nPoint mass on a massless rigid rod about a pivot at the origin; y points up.",
            params: &[
                ukcore::ParamSpec {
                    name: "m",
                    doc: "Mass",
                    default: 1.0,
                    unit: "kg",
                    written: "",
                },
                ukcore::ParamSpec {
                    name: "l",
                    doc: "Length of the rod",
                    default: 1.0,
                    unit: "m",
                    written: "",
                },
                ukcore::ParamSpec {
                    name: "g",
                    doc: "Acceleration of gravity",
                    default: 9.81,
                    unit: "m/s^2",
                    written: "",
                },
            ],
            prepared: &[
                ("m_g", "m*g"),
                ("sq_l", "sq(l)"),
                ("g", "g"),
                ("m_per_l", "m/l"),
                ("m", "m"),
                (
                    "safe_x",
                    "1 if the pivots that depend on m alone are positive and finite, else 0",
                ),
                ("times_l", "0.05*l"),
            ],
            coords: &["x", "y"],
            coordinate_units: &["m", "m"],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "rod",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(x) + sq(y) - sq(l) = 0",
                },
            ],
            holonomic: 1,
            multiplier_units: &["N/m"],
            outputs: &[
                ukcore::OutputSpec {
                    name: "angle",
                    doc: "Angle from the downward vertical, counter-clockwise",
                    unit: "rad",
                    loaded: false,
                },
                ukcore::OutputSpec {
                    name: "tension",
                    doc: "Tension of the rod",
                    unit: "N",
                    loaded: false,
                },
            ],
            starts: &[
                ukcore::StartSpec {
                    name: "released",
                    doc: "let go at an angle",
                    options: &[
                        ukcore::StartOption {
                            name: "from",
                            doc: "Angle from the downward vertical, counter-clockwise",
                            default: -::core::f64::consts::FRAC_PI_2,
                            unit: "rad",
                            written: "",
                        },
                        ukcore::StartOption {
                            name: "rate",
                            doc: "Angular velocity",
                            default: 0.0,
                            unit: "rad/s",
                            written: "",
                        },
                    ],
                    duration: ukcore::DURATION,
                },
            ],
            drawing: ukcore::Drawing {
                dimension: 2,
                shapes: &[
                    ukcore::ShapeSpec {
                        kind: ukcore::ShapeKind::Line,
                        numbers: 4,
                        label: "",
                    },
                    ukcore::ShapeSpec {
                        kind: ukcore::ShapeKind::Circle,
                        numbers: 3,
                        label: "",
                    },
                ],
            },
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
                    regular: &[],
                    met: &[],
                    velocities: &[],
                    turned: &[],
                    solved: &[],
                    copies: &[],
                    redundant: &[],
                },
                mass_pattern: &[(0, 0), (1, 1)],
                jacobian_pattern: &[(0, 0), (0, 1)],
                mass_diagonal: true,
                mass_constant: true,
                jacobian_constant: false,
                jacobian_driven: false,
                driven: &[],
                jacobian_fixed: &[],
                massless: &[],
                angles: &[],
                phases: &[],
                parts: &[],
                bodies: &[],
                scleronomic: true,
                nonideal: false,
                loaded: false,
                potential: true,
                forced: &[],
                conservative: true,
                left_out: &[
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "1 of 2 entries of Q: identically zero",
                    "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 2,
                        multiplications: 5,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
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
                        additions: 5,
                        multiplications: 9,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 3,
                    },
                    acceleration: ukcore::Operations {
                        additions: 6,
                        multiplications: 9,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 1,
                    },
                    correction: ukcore::Operations {
                        additions: 3,
                        multiplications: 7,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 1,
                    },
                    prepare: ukcore::Operations {
                        additions: 0,
                        multiplications: 3,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 2,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[],
                mass: &["M[x, x] = m", "M[y, y] = m"],
                force: &["Q[y] = -m*g"],
                nonideal: &[],
                constraints: &[
                    "rod: sq(x) + sq(y) - sq(l) = 0",
                    "    A[rod, x] = 2*x",
                    "    A[rod, y] = 2*y",
                    "    b[rod] = -2*(sq(dot(x)) + sq(dot(y)))",
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
            let prepared = ukcore::emitted::exact_mut::<S, 7>(prepared, "prepared");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[
                        1.7976931348623157e308,
                        2.2250738585072014e-308,
                        1.0,
                        0.0,
                        0.05,
                    ],
                    code: b"126 bytes",
                };
                let mut registers = [S::from_f64(0.0); 9];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[ukcore::emitted::exact::<S, 3>(given, "given")],
                    (&[], &[]),
                    &mut [&mut prepared[..]],
                );
                return;
            }
            let [m, l, g] = *ukcore::emitted::exact::<S, 3>(given, "given");
            let lit = S::from_f64;
            prepared[0] = m * g;
            prepared[1] = l * l;
            prepared[2] = g;
            prepared[3] = m / l;
            prepared[4] = m;
            let safe_x = S::select_le(
                m,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            prepared[5] = safe_x;
            prepared[6] = lit(0.05) * l;
        }
        /// 2 additions, 5 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 0 selections.
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
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[0.0, 2.0, -2.0],
                    code: b"138 bytes",
                };
                let mut registers = [S::from_f64(0.0); 16];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 7>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [
                        &mut mass[..],
                        &mut force[..],
                        &mut nonideal[..],
                        &mut jacobian[..],
                        &mut rhs[..],
                    ],
                );
                return;
            }
            let [m_g, _, _, _, m, _, _] = *ukcore::emitted::exact::<
                S,
                7,
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
            jacobian[1] = lit(2.0) * y;
            rhs[0] = lit(-2.0) * dot_y.mul_add(dot_y, dot_x * dot_x);
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 4>(mass, "mass");
            let [_, _, _, _, m, _, _] = *ukcore::emitted::exact::<
                S,
                7,
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
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let lit = S::from_f64;
            jacobian[0] = lit(2.0) * x;
            jacobian[1] = lit(2.0) * y;
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 1>(phi, "phi");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[],
                    code: b"36 bytes",
                };
                let mut registers = [S::from_f64(0.0); 11];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 7>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut phi[..]],
                );
                return;
            }
            let [_, sq_l, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                7,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            phi[0] = y.mul_add(y, x * x - sq_l);
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 1>(rate, "rate");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[2.0],
                    code: b"36 bytes",
                };
                let mut registers = [S::from_f64(0.0); 14];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 7>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut rate[..]],
                );
                return;
            }
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            rate[0] = lit(2.0) * y.mul_add(dot_y, x * dot_x);
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [m_g, _, _, _, m, _, _] = *ukcore::emitted::exact::<
                S,
                7,
            >(prepared, "prepared");
            let [_, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            let kinetic = lit(0.5) * (m * dot_y.mul_add(dot_y, dot_x * dot_x));
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
            let [_, _, g, m_per_l, _, _, _] = *ukcore::emitted::exact::<
                S,
                7,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            outputs[0] = x.atan2(-y);
            outputs[1] = m_per_l * y.neg_mul_add(g, dot_y.mul_add(dot_y, dot_x * dot_x));
        }
        fn drawing<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            drawing: &mut [S],
        ) {
            let drawing = ukcore::emitted::exact_mut::<S, 7>(drawing, "drawing");
            let [_, _, _, _, _, _, times_l] = *ukcore::emitted::exact::<
                S,
                7,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let lit = S::from_f64;
            drawing[0] = lit(0.0);
            drawing[1] = lit(0.0);
            drawing[2] = x;
            drawing[3] = y;
            drawing[4] = x;
            drawing[5] = y;
            drawing[6] = times_l;
        }
        /// 6 additions, 9 multiplications, 1 divisions, 0 square roots, 0 transcendentals, 1 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 2>(out, "out");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[2.2250738585072014e-308, 0.0],
                    code: b"134 bytes",
                };
                let mut registers = [S::from_f64(0.0); 17];
                return S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 7>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut out[..]],
                );
            }
            let [_, _, g, _, _, safe_x, _] = *ukcore::emitted::exact::<
                S,
                7,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            let pivot_rod = y.mul_add(y, x * x);
            let per_pivot_rod = pivot_rod.recip();
            let safe_rod = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_rod,
                safe_x,
                lit(0.0),
            );
            let right_rod = y.neg_mul_add(g, dot_y.mul_add(dot_y, dot_x * dot_x));
            let safe = safe_rod;
            out[0] = -(x * right_rod * per_pivot_rod);
            out[1] = (y * right_rod).neg_mul_add(per_pivot_rod, -g);
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
            let [_, _, _, _, _, safe_x, _] = *ukcore::emitted::exact::<
                S,
                7,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [residual_0] = *ukcore::emitted::exact::<S, 1>(residual, "residual");
            let lit = S::from_f64;
            let pivot_rod = y.mul_add(y, x * x);
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
            out[1] = -(y * right_rod * per_pivot_rod);
            safe
        }
        fn guess(
            start: usize,
            given: &[f64],
            each: &mut dyn ::core::ops::FnMut(ukcore::Guess),
        ) {
            match start {
                0 => {
                    fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
                        let prepared = ukcore::emitted::exact_mut::<
                            S,
                            4,
                        >(prepared, "prepared");
                        let [_, l, _, from, rate_2] = *ukcore::emitted::exact::<
                            S,
                            5,
                        >(given, "given");
                        let (sin_from, cos_from) = from.sin_cos();
                        prepared[0] = l * sin_from;
                        prepared[1] = -(l * cos_from);
                        prepared[2] = l * rate_2 * cos_from;
                        prepared[3] = l * rate_2 * sin_from;
                    }
                    let mut numbers = [0.0; 4];
                    prepare(given, &mut numbers);
                    let places: &[(usize, ukcore::GuessKind, bool)] = &[
                        (0, ukcore::GuessKind::Position, false),
                        (1, ukcore::GuessKind::Position, false),
                        (0, ukcore::GuessKind::Velocity, false),
                        (1, ukcore::GuessKind::Velocity, false),
                    ];
                    for ((coordinate, kind, held), value) in places.iter().zip(numbers) {
                        each(ukcore::Guess {
                            coordinate: *coordinate,
                            kind: *kind,
                            held: *held,
                            value,
                        });
                    }
                }
                _ => {}
            }
        }
    }
    #[automatically_derived]
    impl Pendulum {
        /// The declared start called `name`, with these options, as `Prepared::start` assembles it:
        /// - `"released"` (`from` in rad, `rate` in rad/s): let go at an angle
        ///
        /// # Errors
        /// Unknown names; values that are not finite; options for which nothing satisfies the constraints.
        #[allow(dead_code)]
        pub fn start(
            &self,
            name: &str,
            options: &ukcore::StartOptions,
        ) -> ::core::result::Result<ukcore::State, ukcore::Error> {
            ukcore::Prepared::from(self).start(name, options)
        }
    }
};
#[doc(hidden)]
#[allow(unused_macros, non_local_definitions)]
macro_rules! __part_Pendulum {
    (($($callback:tt)*) ($($path:tt)*) [$($known:tt)*] $($rest:tt)*) => {
        $($callback)* ! { @ parts[$($known)* { $($path)* } { ? } {}] $($rest)* }
    };
}
#[doc(hidden)]
#[allow(unused_imports)]
pub(crate) use __part_Pendulum as Pendulum;
