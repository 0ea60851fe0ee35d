/// Block on a rough slope (non-ideal constraint, closed form).
/// Block on a slope that falls towards +x; y points up. The slope's constraint is not ideal: it rubs with Coulomb's friction
/// mu N against the motion, where N = m g cos(slope) is the ideal constraint force, known beforehand. Friction is of sliding only:
/// the slope has to be steeper than the angle of repose, mu < tan(slope), or the block would have to stick.
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Abbreviations:
///
/// <p><math><mi>speed_down</mi><mo>=</mo><mover><mi>x</mi><mo>˙</mo></mover><mspace width="0.17em"/><mi>cos</mi><mo>(</mo><mi>slope</mi><mo>)</mo><mo>−</mo><mover><mi>y</mi><mo>˙</mo></mover><mspace width="0.17em"/><mi>sin</mi><mo>(</mo><mi>slope</mi><mo>)</mo></math></p>
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
/// <p><math><mtext>plane:</mtext><mspace width="1em"/><mi>x</mi><mspace width="0.17em"/><mi>sin</mi><mo>(</mo><mi>slope</mi><mo>)</mo><mo>+</mo><mi>cos</mi><mo>(</mo><mi>slope</mi><mo>)</mo><mspace width="0.17em"/><mi>y</mi><mo>=</mo><mn>0</mn></math><br>
/// <math><msub><mi>A</mi><mrow><mi>plane</mi><mo>,</mo><mi>x</mi></mrow></msub><mo>=</mo><mi>sin</mi><mo>(</mo><mi>slope</mi><mo>)</mo></math><br>
/// <math><msub><mi>A</mi><mrow><mi>plane</mi><mo>,</mo><mi>y</mi></mrow></msub><mo>=</mo><mi>cos</mi><mo>(</mo><mi>slope</mi><mo>)</mo></math><br>
/// <math><msub><mi>b</mi><mi>plane</mi></msub><mo>=</mo><mn>0</mn></math></p>
///
/// Non-ideal force c, eq. 8:
///
/// <p><math><msub><mi>c</mi><mi>x</mi></msub><mo>=</mo><mo>−</mo><msup><mrow><mi>cos</mi><mo>(</mo><mi>slope</mi><mo>)</mo></mrow><mn>2</mn></msup><mspace width="0.17em"/><mi>μ</mi><mspace width="0.17em"/><mi>m</mi><mspace width="0.17em"/><mi>g</mi><mspace width="0.17em"/><mi>sign</mi><mo>(</mo><mi>speed_down</mi><mo>)</mo></math><br>
/// <math><msub><mi>c</mi><mi>y</mi></msub><mo>=</mo><mi>cos</mi><mo>(</mo><mi>slope</mi><mo>)</mo><mspace width="0.17em"/><mi>sin</mi><mo>(</mo><mi>slope</mi><mo>)</mo><mspace width="0.17em"/><mi>μ</mi><mspace width="0.17em"/><mi>m</mi><mspace width="0.17em"/><mi>g</mi><mspace width="0.17em"/><mi>sign</mi><mo>(</mo><mi>speed_down</mi><mo>)</mo></math></p>
///
/// Switches, functions at whose zeros abs, sign, min or max change their branch or the direction of a vector turns, with the terms that contain them:
///
/// ```text
/// speed_down: non-ideal force on `x`, non-ideal force on `y`
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 0 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 3 | 4 | 0 | 0 | 0 | 2 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 10 | 16 | 3 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 7 | 13 | 0 | 0 | 1 | 4 |
/// | straight line, as emitted | 7 | 8 | 0 | 0 | 0 | 2 |
/// | correction of a projection | 2 | 2 | 0 | 0 | 0 | 0 |
/// | once for a set of parameters | 0 | 17 | 0 | 0 | 1 | 2 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct RoughBlock {
    /// Mass
    ///
    /// Unit: kg.
    pub m: f64,
    /// Acceleration of gravity
    ///
    /// Unit: m/s^2.
    pub g: f64,
    /// Inclination of the slope
    ///
    /// Unit: rad.
    pub slope: f64,
    /// Coefficient of friction
    pub mu: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for RoughBlock {
    fn default() -> Self {
        RoughBlock {
            m: 1.0,
            g: 9.81,
            slope: 0.5235987755982988,
            mu: 0.2,
        }
    }
}
#[allow(dead_code)]
impl RoughBlock {
    /// Position in q of coordinate `x`, in m.
    pub const X: usize = 0;
    /// Position in q of coordinate `y`, in m.
    pub const Y: usize = 1;
    /// Row in A of constraint `plane`.
    pub const PLANE: usize = 0;
    /// Position of output `way`, in m.
    pub const OUT_WAY: usize = 0;
    /// Position of output `speed`, in m/s.
    pub const OUT_SPEED: usize = 1;
    /// Position of output `friction_force`, in N.
    pub const OUT_FRICTION_FORCE: usize = 2;
}
const _: () = {
    use ::ukcore::emitted as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<RoughBlock> for ukcore::Prepared {
        fn from(mechanism: RoughBlock) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for RoughBlock {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "RoughBlock",
            doc: "Block on a rough slope (non-ideal constraint, closed form).\nBlock on a slope that falls towards +x; y points up. The slope's constraint is not ideal: it rubs with Coulomb's friction\nmu N against the motion, where N = m g cos(slope) is the ideal constraint force, known beforehand. Friction is of sliding only:\nthe slope has to be steeper than the angle of repose, mu < tan(slope), or the block would have to stick.",
            params: &[
                ukcore::ParamSpec {
                    name: "m",
                    doc: "Mass",
                    default: 1.0,
                    unit: "kg",
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
                    doc: "Inclination of the slope",
                    default: 0.5235987755982988,
                    unit: "rad",
                    written: "",
                },
                ukcore::ParamSpec {
                    name: "mu",
                    doc: "Coefficient of friction",
                    default: 0.2,
                    unit: "",
                    written: "",
                },
            ],
            prepared: &[
                ("cos_slope", "cos(slope)"),
                ("sin_slope", "sin(slope)"),
                ("cos_slope_mu_m_g", "cos(slope)*mu*m*g"),
                ("m_g", "m*g"),
                ("m", "m"),
                ("sq_cos_slope_mu_m_g", "sq(cos(slope))*mu*m*g"),
                ("cos_slope_sin_slope_mu_m_g", "cos(slope)*sin(slope)*mu*m*g"),
                ("cos_slope_sin_slope_mu", "cos(slope)*sin(slope)*mu"),
                ("sq_cos_slope", "sq(cos(slope))"),
                ("g", "g"),
                ("cos_slope_mu", "cos(slope)*mu"),
                ("cos_slope_g", "cos(slope)*g"),
                (
                    "safe_x",
                    "1 if the pivots that depend on m alone are positive and finite, else 0",
                ),
            ],
            coords: &["x", "y"],
            coordinate_units: &["m", "m"],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "plane",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "x*sin(slope) + cos(slope)*y = 0",
                },
            ],
            holonomic: 1,
            multiplier_units: &["N"],
            outputs: &[
                ukcore::OutputSpec {
                    name: "way",
                    doc: "Way down the slope",
                    unit: "m",
                    loaded: false,
                },
                ukcore::OutputSpec {
                    name: "speed",
                    doc: "Speed down the slope",
                    unit: "m/s",
                    loaded: false,
                },
                ukcore::OutputSpec {
                    name: "friction_force",
                    doc: "Friction, positive down the slope",
                    unit: "N",
                    loaded: false,
                },
            ],
            starts: &[
                ukcore::StartSpec {
                    name: "kicked",
                    doc: "at the origin, kicked along the slope",
                    options: &[
                        ukcore::StartOption {
                            name: "kick",
                            doc: "Speed down the slope; negative is up",
                            default: -5.0,
                            unit: "m/s",
                            written: "",
                        },
                    ],
                    duration: 3.0,
                },
            ],
            drawing: ukcore::Drawing {
                dimension: 2,
                shapes: &[
                    ukcore::ShapeSpec {
                        kind: ukcore::ShapeKind::Circle,
                        numbers: 3,
                        label: "",
                    },
                    ukcore::ShapeSpec {
                        kind: ukcore::ShapeKind::Trace,
                        numbers: 2,
                        label: "",
                    },
                ],
            },
            switches: &[
                ukcore::SwitchSpec {
                    function: "speed_down",
                    terms: &["non-ideal force on `x`", "non-ideal force on `y`"],
                    length: false,
                    at_rest: true,
                },
            ],
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
                    checks: &[ukcore::Check::Positive(0)],
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
                jacobian_constant: true,
                jacobian_driven: false,
                driven: &[],
                jacobian_fixed: &[(0, 0), (0, 1)],
                massless: &[],
                angles: &[],
                phases: &[],
                parts: &[],
                bodies: &[],
                scleronomic: true,
                nonideal: true,
                loaded: false,
                potential: true,
                forced: &[],
                conservative: false,
                left_out: &[
                    "off-diagonal entries of M: M is diagonal, its square root is taken entry by entry",
                    "∂/∂t terms: no equation contains the time",
                    "1 of 1 entries of b: identically zero",
                    "1 of 2 entries of Q: identically zero",
                    "Udwadia-Phohomsiri formula (eq. 19): no coordinate is massless while the parameters are positive",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 3,
                        multiplications: 4,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 2,
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
                        additions: 7,
                        multiplications: 13,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 4,
                    },
                    acceleration: ukcore::Operations {
                        additions: 7,
                        multiplications: 8,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 2,
                    },
                    correction: ukcore::Operations {
                        additions: 2,
                        multiplications: 2,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    prepare: ukcore::Operations {
                        additions: 0,
                        multiplications: 17,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 1,
                        selections: 2,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &["speed_down = dot(x)*cos(slope) - dot(y)*sin(slope)"],
                mass: &["M[x, x] = m", "M[y, y] = m"],
                force: &["Q[y] = -m*g"],
                nonideal: &[
                    "c[x] = -sq(cos(slope))*mu*m*g*sign(speed_down)",
                    "c[y] = cos(slope)*sin(slope)*mu*m*g*sign(speed_down)",
                ],
                constraints: &[
                    "plane: x*sin(slope) + cos(slope)*y = 0",
                    "    A[plane, x] = sin(slope)",
                    "    A[plane, y] = cos(slope)",
                    "    b[plane] = 0",
                ],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.m,
                1 => self.g,
                2 => self.slope,
                3 => self.mu,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.m = value,
                1 => self.g = value,
                2 => self.slope = value,
                3 => self.mu = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 13>(prepared, "prepared");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[
                        1.7976931348623157e308,
                        2.2250738585072014e-308,
                        1.0,
                        0.0,
                    ],
                    code: b"298 bytes",
                };
                let mut registers = [S::from_f64(0.0); 11];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[ukcore::emitted::exact::<S, 4>(given, "given")],
                    (&[], &[]),
                    &mut [&mut prepared[..]],
                );
                return;
            }
            let [m, g, slope, mu] = *ukcore::emitted::exact::<S, 4>(given, "given");
            let lit = S::from_f64;
            let (sin_slope, cos_slope) = slope.sin_cos();
            prepared[0] = cos_slope;
            prepared[1] = sin_slope;
            prepared[2] = mu * m * g * cos_slope;
            prepared[3] = m * g;
            prepared[4] = m;
            prepared[5] = mu * m * g * cos_slope * cos_slope;
            prepared[6] = mu * m * g * cos_slope * sin_slope;
            prepared[7] = mu * cos_slope * sin_slope;
            prepared[8] = cos_slope * cos_slope;
            prepared[9] = g;
            prepared[10] = mu * cos_slope;
            prepared[11] = g * cos_slope;
            let safe_x = S::select_le(
                m,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            prepared[12] = safe_x;
        }
        /// 3 additions, 4 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 2 selections.
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
                    constants: &[0.0],
                    code: b"154 bytes",
                };
                let mut registers = [S::from_f64(0.0); 22];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 14>(prepared, "prepared"),
                    ],
                    (&[S::sign], &[S::branch]),
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
            let [cos_slope, sin_slope, _, m_g, m, sq_cos_slope_mu_m_g,
            cos_slope_sin_slope_mu_m_g, _, _, _, _, _, _, held_speed_down] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            mass[0] = m;
            mass[3] = m;
            force[0] = lit(0.0);
            force[1] = -m_g;
            let speed_down = dot_y.neg_mul_add(sin_slope, dot_x * cos_slope);
            let right_x = speed_down.branch(held_speed_down).sign();
            nonideal[0] = -(sq_cos_slope_mu_m_g * right_x);
            nonideal[1] = cos_slope_sin_slope_mu_m_g * right_x;
            jacobian[0] = sin_slope;
            jacobian[1] = cos_slope;
            rhs[0] = lit(0.0);
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 4>(mass, "mass");
            let [_, _, _, _, m, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
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
            let [cos_slope, sin_slope, _, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            jacobian[0] = sin_slope;
            jacobian[1] = cos_slope;
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 1>(phi, "phi");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[],
                    code: b"28 bytes",
                };
                let mut registers = [S::from_f64(0.0); 18];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 14>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut phi[..]],
                );
                return;
            }
            let [cos_slope, sin_slope, _, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            phi[0] = y.mul_add(cos_slope, x * sin_slope);
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
                    code: b"28 bytes",
                };
                let mut registers = [S::from_f64(0.0); 20];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 14>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut rate[..]],
                );
                return;
            }
            let [cos_slope, sin_slope, _, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            rate[0] = dot_y.mul_add(cos_slope, dot_x * sin_slope);
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [_, _, _, m_g, m, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
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
            let outputs = ukcore::emitted::exact_mut::<S, 3>(outputs, "outputs");
            let [cos_slope, sin_slope, cos_slope_mu_m_g, _, _, _, _, _, _, _, _, _, _, _,
            ] = *ukcore::emitted::exact::<S, 14>(prepared, "prepared");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            outputs[0] = y.neg_mul_add(sin_slope, x * cos_slope);
            let speed_down = dot_y.neg_mul_add(sin_slope, dot_x * cos_slope);
            outputs[1] = speed_down;
            let neg_friction = cos_slope_mu_m_g * speed_down.sign();
            outputs[2] = -neg_friction;
        }
        fn drawing<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            drawing: &mut [S],
        ) {
            let drawing = ukcore::emitted::exact_mut::<S, 5>(drawing, "drawing");
            let [x, y] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let lit = S::from_f64;
            drawing[0] = x;
            drawing[1] = y;
            drawing[2] = lit(0.1);
            drawing[3] = x;
            drawing[4] = y;
        }
        fn switching<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            switching: &mut [S],
        ) {
            let switching = ukcore::emitted::exact_mut::<S, 1>(switching, "switching");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[],
                    code: b"28 bytes",
                };
                let mut registers = [S::from_f64(0.0); 20];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 14>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut switching[..]],
                );
                return;
            }
            let [cos_slope, sin_slope, _, _, _, _, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let speed_down = dot_y.neg_mul_add(sin_slope, dot_x * cos_slope);
            switching[0] = speed_down;
        }
        /// 7 additions, 8 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 2 selections.
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
                    constants: &[1.0],
                    code: b"140 bytes",
                };
                let mut registers = [S::from_f64(0.0); 23];
                return S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 14>(prepared, "prepared"),
                    ],
                    (&[S::sign], &[S::branch]),
                    &mut [&mut out[..]],
                );
            }
            let [cos_slope, sin_slope, _, _, _, _, _, cos_slope_sin_slope_mu,
            sq_cos_slope, g, cos_slope_mu, cos_slope_g, safe_x, held_speed_down] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [dot_x, dot_y] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            let speed_down = dot_y.neg_mul_add(sin_slope, dot_x * cos_slope);
            let right_x = speed_down.branch(held_speed_down).sign();
            let right_x_cos_slope_sin_slope_mu = cos_slope_sin_slope_mu * right_x;
            let right_y = lit(1.0) - right_x_cos_slope_sin_slope_mu;
            let right_plane = right_x_cos_slope_sin_slope_mu + right_y;
            let safe = safe_x;
            out[0] = -(cos_slope_g
                * sin_slope.neg_mul_add(right_plane, cos_slope_mu * right_x));
            out[1] = -(g * sq_cos_slope.neg_mul_add(right_plane, right_y));
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
            let [cos_slope, sin_slope, _, _, _, _, _, _, _, _, _, _, safe_x, _] = *ukcore::emitted::exact::<
                S,
                14,
            >(prepared, "prepared");
            let [residual_0] = *ukcore::emitted::exact::<S, 1>(residual, "residual");
            let safe = safe_x;
            out[0] = -(residual_0 * sin_slope);
            out[1] = -(residual_0 * cos_slope);
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
                            2,
                        >(prepared, "prepared");
                        let [_, _, slope, _, kick] = *ukcore::emitted::exact::<
                            S,
                            5,
                        >(given, "given");
                        let (sin_slope, cos_slope) = slope.sin_cos();
                        prepared[0] = kick * cos_slope;
                        prepared[1] = -(kick * sin_slope);
                    }
                    let mut numbers = [0.0; 2];
                    prepare(given, &mut numbers);
                    let places: &[(usize, ukcore::GuessKind, bool)] = &[
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
    impl RoughBlock {
        /// The declared start called `name`, with these options, as `Prepared::start` assembles it:
        /// - `"kicked"` (`kick` in m/s): at the origin, kicked along the slope
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
macro_rules! __part_RoughBlock {
    (($($callback:tt)*) ($($path:tt)*) [$($known:tt)*] $($rest:tt)*) => {
        $($callback)* ! { @ parts[$($known)* { $($path)* } { ? } {}] $($rest)* }
    };
}
#[doc(hidden)]
#[allow(unused_imports)]
pub(crate) use __part_RoughBlock as RoughBlock;
