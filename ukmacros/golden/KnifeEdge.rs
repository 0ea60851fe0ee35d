/// Knife edge on an inclined plane (nonholonomic, closed form).
/// Knife edge (a skate) on a plane inclined by `slope`; x points down the slope, y across it. The edge touches at its centre of mass
/// and does not slip sideways: a nonholonomic constraint. Set turning, it drifts across the slope and never gets down.
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Mass matrix M (lower triangle), eq. 1:
///
/// <p><math><msub><mi>M</mi><mrow><mi>x</mi><mo>,</mo><mi>x</mi></mrow></msub><mo>=</mo><mi>m</mi></math><br>
/// <math><msub><mi>M</mi><mrow><mi>y</mi><mo>,</mo><mi>y</mi></mrow></msub><mo>=</mo><mi>m</mi></math><br>
/// <math><msub><mi>M</mi><mrow><mi>th</mi><mo>,</mo><mi>th</mi></mrow></msub><mo>=</mo><mi>i</mi></math></p>
///
/// Generalised force Q, eq. 1:
///
/// <p><math><msub><mi>Q</mi><mi>x</mi></msub><mo>=</mo><mi>m</mi><mspace width="0.17em"/><mi>g</mi><mspace width="0.17em"/><mi>sin</mi><mo>(</mo><mi>slope</mi><mo>)</mo></math></p>
///
/// Constraints, eqs. 3 and 4, each with its row of the constraint Jacobian A and of b, eq. 5:
///
/// <p><math><mtext>edge (nonholonomic):</mtext><mspace width="1em"/><mover><mi>x</mi><mo>˙</mo></mover><mspace width="0.17em"/><mi>sin</mi><mo>(</mo><mi>th</mi><mo>)</mo><mo>−</mo><mover><mi>y</mi><mo>˙</mo></mover><mspace width="0.17em"/><mi>cos</mi><mo>(</mo><mi>th</mi><mo>)</mo><mo>=</mo><mn>0</mn></math><br>
/// <math><msub><mi>A</mi><mrow><mi>edge</mi><mo>,</mo><mi>x</mi></mrow></msub><mo>=</mo><mi>sin</mi><mo>(</mo><mi>th</mi><mo>)</mo></math><br>
/// <math><msub><mi>A</mi><mrow><mi>edge</mi><mo>,</mo><mi>y</mi></mrow></msub><mo>=</mo><mo>−</mo><mi>cos</mi><mo>(</mo><mi>th</mi><mo>)</mo></math><br>
/// <math><msub><mi>b</mi><mi>edge</mi></msub><mo>=</mo><mo>−</mo><mo>(</mo><mover><mi>x</mi><mo>˙</mo></mover><mspace width="0.17em"/><mi>cos</mi><mo>(</mo><mi>th</mi><mo>)</mo><mspace width="0.17em"/><mover><mi>th</mi><mo>˙</mo></mover><mo>+</mo><mi>sin</mi><mo>(</mo><mi>th</mi><mo>)</mo><mspace width="0.17em"/><mover><mi>y</mi><mo>˙</mo></mover><mspace width="0.17em"/><mover><mi>th</mi><mo>˙</mo></mover><mo>)</mo></math></p>
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 0 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 3 | 4 | 0 | 0 | 1 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 22 | 32 | 4 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 3 | 10 | 1 | 0 | 2 | 9 |
/// | straight line, as emitted | 3 | 7 | 0 | 0 | 1 | 0 |
/// | correction of a projection | 1 | 2 | 0 | 0 | 1 | 0 |
/// | once for a set of parameters | 0 | 4 | 1 | 0 | 1 | 9 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct KnifeEdge {
    /// Mass
    ///
    /// Unit: kg.
    pub m: f64,
    /// Moment of inertia about the normal of the plane
    ///
    /// Unit: kg m^2.
    pub i: f64,
    /// Acceleration of gravity
    ///
    /// Unit: m/s^2.
    pub g: f64,
    /// Inclination of the plane
    ///
    /// Unit: rad.
    pub slope: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for KnifeEdge {
    fn default() -> Self {
        KnifeEdge {
            m: 1.0,
            i: 0.1,
            g: 9.81,
            slope: 0.5235987755982988,
        }
    }
}
#[allow(dead_code)]
impl KnifeEdge {
    /// Position in q of coordinate `x`, in m.
    pub const X: usize = 0;
    /// Position in q of coordinate `y`, in m.
    pub const Y: usize = 1;
    /// Position in q of coordinate `th`, in rad.
    pub const TH: usize = 2;
    /// Row in A of constraint `edge`.
    pub const EDGE: usize = 0;
    /// Position of output `speed`, in m/s.
    pub const OUT_SPEED: usize = 0;
    /// Position of output `spin`, in rad/s.
    pub const OUT_SPIN: usize = 1;
}
const _: () = {
    use ::ukcore::emitted as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<KnifeEdge> for ukcore::Prepared {
        fn from(mechanism: KnifeEdge) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for KnifeEdge {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "KnifeEdge",
            doc: "Knife edge on an inclined plane (nonholonomic, closed form).\nKnife edge (a skate) on a plane inclined by `slope`; x points down the slope, y across it. The edge touches at its centre of mass\nand does not slip sideways: a nonholonomic constraint. Set turning, it drifts across the slope and never gets down.",
            params: &[
                ukcore::ParamSpec {
                    name: "m",
                    doc: "Mass",
                    default: 1.0,
                    unit: "kg",
                    written: "",
                },
                ukcore::ParamSpec {
                    name: "i",
                    doc: "Moment of inertia about the normal of the plane",
                    default: 0.1,
                    unit: "kg m^2",
                    written: "",
                },
                ukcore::ParamSpec {
                    name: "g",
                    doc: "Acceleration of gravity",
                    default: 9.81,
                    unit: "m/s^2",
                    written: "",
                },
                ukcore::ParamSpec {
                    name: "slope",
                    doc: "Inclination of the plane",
                    default: 0.5235987755982988,
                    unit: "rad",
                    written: "",
                },
            ],
            prepared: &[
                ("right_x", "m*g*sin(slope)"),
                ("m", "m"),
                ("i", "i"),
                ("g_sin_slope", "g*sin(slope)"),
                (
                    "safe_edge",
                    "1 if the pivots that depend on m, i alone are positive and finite, else 0",
                ),
            ],
            coords: &["x", "y", "th"],
            coordinate_units: &["m", "m", "rad"],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "edge",
                    kind: ukcore::ConstraintKind::Nonholonomic,
                    equation: "dot(x)*sin(th) - dot(y)*cos(th) = 0",
                },
            ],
            holonomic: 0,
            multiplier_units: &["N"],
            outputs: &[
                ukcore::OutputSpec {
                    name: "speed",
                    doc: "Speed along the edge",
                    unit: "m/s",
                    loaded: false,
                },
                ukcore::OutputSpec {
                    name: "spin",
                    doc: "Angular velocity",
                    unit: "rad/s",
                    loaded: false,
                },
            ],
            starts: &[
                ukcore::StartSpec {
                    name: "spinning",
                    doc: "at the origin, turning and gliding along its edge",
                    options: &[
                        ukcore::StartOption {
                            name: "turn",
                            doc: "Angular velocity",
                            default: 1.0,
                            unit: "rad/s",
                            written: "",
                        },
                        ukcore::StartOption {
                            name: "glide",
                            doc: "Speed along the edge",
                            default: 0.0,
                            unit: "m/s",
                            written: "",
                        },
                        ukcore::StartOption {
                            name: "heading",
                            doc: "Direction of the edge, from the line of fall",
                            default: 0.0,
                            unit: "rad",
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
                        kind: ukcore::ShapeKind::Trace,
                        numbers: 2,
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
                        ukcore::Pivot::Coordinate(2),
                        ukcore::Pivot::Coordinate(0),
                        ukcore::Pivot::Coordinate(1),
                        ukcore::Pivot::Constraint(0),
                    ],
                    fill: &[],
                    checks: &[
                        ukcore::Check::Positive(2),
                        ukcore::Check::Positive(0),
                        ukcore::Check::Positive(3),
                    ],
                    least_share: 0.0009765625,
                    regular: &[],
                    met: &[],
                    velocities: &[],
                    turned: &[],
                    solved: &[],
                    copies: &[],
                    redundant: &[],
                },
                mass_pattern: &[(0, 0), (1, 1), (2, 2)],
                jacobian_pattern: &[(0, 0), (0, 1)],
                mass_diagonal: true,
                mass_constant: true,
                jacobian_constant: false,
                jacobian_driven: false,
                driven: &[],
                jacobian_fixed: &[],
                massless: &[],
                angles: &[2],
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
                    "1 of the 3 entries of A: structurally zero, never written",
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                    "2 of 3 entries of Q: identically zero",
                    "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 3,
                        multiplications: 4,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 0,
                    },
                    dense: ukcore::Operations {
                        additions: 22,
                        multiplications: 32,
                        divisions: 4,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    unprepared: ukcore::Operations {
                        additions: 3,
                        multiplications: 10,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 2,
                        selections: 9,
                    },
                    acceleration: ukcore::Operations {
                        additions: 3,
                        multiplications: 7,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 0,
                    },
                    correction: ukcore::Operations {
                        additions: 1,
                        multiplications: 2,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 0,
                    },
                    prepare: ukcore::Operations {
                        additions: 0,
                        multiplications: 4,
                        divisions: 1,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 9,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[],
                mass: &["M[x, x] = m", "M[y, y] = m", "M[th, th] = i"],
                force: &["Q[x] = m*g*sin(slope)"],
                nonideal: &[],
                constraints: &[
                    "edge (nonholonomic): dot(x)*sin(th) - dot(y)*cos(th) = 0",
                    "    A[edge, x] = sin(th)",
                    "    A[edge, y] = -cos(th)",
                    "    b[edge] = -(dot(x)*cos(th)*dot(th) + sin(th)*dot(y)*dot(th))",
                ],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.m,
                1 => self.i,
                2 => self.g,
                3 => self.slope,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.m = value,
                1 => self.i = value,
                2 => self.g = value,
                3 => self.slope = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 5>(prepared, "prepared");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[
                        1.7976931348623157e308,
                        2.2250738585072014e-308,
                        0.0001,
                        1.0,
                        0.75,
                        0.0,
                    ],
                    code: b"204 bytes",
                };
                let mut registers = [S::from_f64(0.0); 13];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[ukcore::emitted::exact::<S, 4>(given, "given")],
                    (&[S::sin], &[]),
                    &mut [&mut prepared[..]],
                );
                return;
            }
            let [m, i, g, slope] = *ukcore::emitted::exact::<S, 4>(given, "given");
            let lit = S::from_f64;
            let sin_slope = slope.sin();
            let right_x = m * g * sin_slope;
            prepared[0] = right_x;
            prepared[1] = m;
            prepared[2] = i;
            prepared[3] = g * sin_slope;
            let pivot_edge = m.recip();
            let safe_th = S::select_le(
                i,
                lit(1.7976931348623157e308),
                S::select_le(
                    lit(2.2250738585072014e-308),
                    i,
                    S::select_le(
                        lit(0.0001) * S::select_le(i, m, m, i),
                        S::select_le(m, i, m, i),
                        lit(1.0),
                        lit(0.75),
                    ),
                    lit(0.0),
                ),
                lit(0.0),
            );
            let safe_x = S::select_le(
                m,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m, safe_th, lit(0.0)),
                lit(0.0),
            );
            let safe_edge = S::select_le(
                pivot_edge,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), pivot_edge, safe_x, lit(0.0)),
                lit(0.0),
            );
            prepared[4] = safe_edge;
        }
        /// 3 additions, 4 multiplications, 0 divisions, 0 square roots, 1 transcendentals, 0 selections.
        fn dynamics<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut ukcore::Terms<'_, S>,
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 9>(out.mass, "mass");
            let force = ukcore::emitted::exact_mut::<S, 3>(out.force, "force");
            let nonideal = ukcore::emitted::exact_mut::<S, 3>(out.nonideal, "nonideal");
            let jacobian = ukcore::emitted::exact_mut::<S, 3>(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 1>(out.rhs, "rhs");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[0.0],
                    code: b"174 bytes",
                };
                let mut registers = [S::from_f64(0.0); 16];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 3>(q, "q"),
                        ukcore::emitted::exact::<S, 3>(v, "v"),
                        ukcore::emitted::exact::<S, 5>(prepared, "prepared"),
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
            let [right_x, m, i, _, _] = *ukcore::emitted::exact::<
                S,
                5,
            >(prepared, "prepared");
            let [_, _, th] = *ukcore::emitted::exact::<S, 3>(q, "q");
            let [dot_x, dot_y, dot_th] = *ukcore::emitted::exact::<S, 3>(v, "v");
            let lit = S::from_f64;
            mass[0] = m;
            mass[4] = m;
            mass[8] = i;
            force[0] = right_x;
            force[1] = lit(0.0);
            force[2] = lit(0.0);
            nonideal[0] = lit(0.0);
            nonideal[1] = lit(0.0);
            nonideal[2] = lit(0.0);
            let (sin_th, cos_th) = th.sin_cos();
            jacobian[0] = sin_th;
            jacobian[1] = -cos_th;
            rhs[0] = (dot_y * dot_th).neg_mul_add(sin_th, -(dot_x * dot_th * cos_th));
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 9>(mass, "mass");
            let [_, m, i, _, _] = *ukcore::emitted::exact::<S, 5>(prepared, "prepared");
            mass[0] = m;
            mass[4] = m;
            mass[8] = i;
        }
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {
            let jacobian = ukcore::emitted::exact_mut::<S, 3>(jacobian, "jacobian");
            let [_, _, th] = *ukcore::emitted::exact::<S, 3>(q, "q");
            let (sin_th, cos_th) = th.sin_cos();
            jacobian[0] = sin_th;
            jacobian[1] = -cos_th;
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
            let rate = ukcore::emitted::exact_mut::<S, 1>(rate, "rate");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[],
                    code: b"36 bytes",
                };
                let mut registers = [S::from_f64(0.0); 14];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 3>(q, "q"),
                        ukcore::emitted::exact::<S, 3>(v, "v"),
                        ukcore::emitted::exact::<S, 5>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut rate[..]],
                );
                return;
            }
            let [_, _, th] = *ukcore::emitted::exact::<S, 3>(q, "q");
            let [dot_x, dot_y, _] = *ukcore::emitted::exact::<S, 3>(v, "v");
            let (sin_th, cos_th) = th.sin_cos();
            rate[0] = dot_y.neg_mul_add(cos_th, dot_x * sin_th);
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [right_x, m, i, _, _] = *ukcore::emitted::exact::<
                S,
                5,
            >(prepared, "prepared");
            let [x, _, _] = *ukcore::emitted::exact::<S, 3>(q, "q");
            let [dot_x, dot_y, dot_th] = *ukcore::emitted::exact::<S, 3>(v, "v");
            let lit = S::from_f64;
            let kinetic = lit(0.5)
                * m.mul_add(dot_y.mul_add(dot_y, dot_x * dot_x), dot_th * dot_th * i);
            let potential = -(x * right_x);
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
            let [_, _, th] = *ukcore::emitted::exact::<S, 3>(q, "q");
            let [dot_x, dot_y, dot_th] = *ukcore::emitted::exact::<S, 3>(v, "v");
            let (sin_th, cos_th) = th.sin_cos();
            outputs[0] = dot_y.mul_add(sin_th, dot_x * cos_th);
            outputs[1] = dot_th;
        }
        fn drawing<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            drawing: &mut [S],
        ) {
            let drawing = ukcore::emitted::exact_mut::<S, 6>(drawing, "drawing");
            let [x, y, th] = *ukcore::emitted::exact::<S, 3>(q, "q");
            let lit = S::from_f64;
            let (sin_th, cos_th) = th.sin_cos();
            drawing[0] = lit(0.2).neg_mul_add(sin_th, y);
            drawing[1] = lit(0.2) * cos_th - x;
            drawing[2] = lit(0.2).mul_add(sin_th, y);
            drawing[3] = lit(0.2).neg_mul_add(cos_th, -x);
            drawing[4] = y;
            drawing[5] = -x;
        }
        /// 3 additions, 7 multiplications, 0 divisions, 0 square roots, 1 transcendentals, 0 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 3>(out, "out");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[0.0],
                    code: b"110 bytes",
                };
                let mut registers = [S::from_f64(0.0); 18];
                return S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 3>(q, "q"),
                        ukcore::emitted::exact::<S, 3>(v, "v"),
                        ukcore::emitted::exact::<S, 5>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut out[..]],
                );
            }
            let [_, _, _, g_sin_slope, safe_edge] = *ukcore::emitted::exact::<
                S,
                5,
            >(prepared, "prepared");
            let [_, _, th] = *ukcore::emitted::exact::<S, 3>(q, "q");
            let [dot_x, dot_y, dot_th] = *ukcore::emitted::exact::<S, 3>(v, "v");
            let lit = S::from_f64;
            let (sin_th, cos_th) = th.sin_cos();
            let right_edge = g_sin_slope * sin_th
                + (dot_y * dot_th).mul_add(sin_th, dot_x * dot_th * cos_th);
            out[2] = lit(0.0);
            let safe = safe_edge;
            out[1] = cos_th * right_edge;
            out[0] = sin_th.neg_mul_add(right_edge, g_sin_slope);
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
            let out = ukcore::emitted::exact_mut::<S, 3>(out, "out");
            let [_, _, _, _, safe_edge] = *ukcore::emitted::exact::<
                S,
                5,
            >(prepared, "prepared");
            let [_, _, th] = *ukcore::emitted::exact::<S, 3>(q, "q");
            let [residual_0] = *ukcore::emitted::exact::<S, 1>(residual, "residual");
            let lit = S::from_f64;
            out[2] = lit(0.0);
            let safe = safe_edge;
            let (sin_th, cos_th) = th.sin_cos();
            out[1] = residual_0 * cos_th;
            out[0] = -(residual_0 * sin_th);
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
                        let [_, _, _, _, turn, glide, heading] = *ukcore::emitted::exact::<
                            S,
                            7,
                        >(given, "given");
                        prepared[0] = heading;
                        prepared[1] = turn;
                        let (sin_heading, cos_heading) = heading.sin_cos();
                        prepared[2] = glide * cos_heading;
                        prepared[3] = glide * sin_heading;
                    }
                    let mut numbers = [0.0; 4];
                    prepare(given, &mut numbers);
                    let places: &[(usize, ukcore::GuessKind, bool)] = &[
                        (2, ukcore::GuessKind::Position, true),
                        (2, ukcore::GuessKind::Velocity, true),
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
    impl KnifeEdge {
        /// The declared start called `name`, with these options, as `Prepared::start` assembles it:
        /// - `"spinning"` (`turn` in rad/s, `glide` in m/s, `heading` in rad): at the origin, turning and gliding along its edge
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
macro_rules! __part_KnifeEdge {
    (($($callback:tt)*) ($($path:tt)*) [$($known:tt)*] $($rest:tt)*) => {
        $($callback)* ! { @ parts[$($known)* { $($path)* } { ? } {}] $($rest)* }
    };
}
#[doc(hidden)]
#[allow(unused_imports)]
pub(crate) use __part_KnifeEdge as KnifeEdge;
