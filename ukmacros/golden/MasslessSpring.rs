/// Mass on two springs with a massless joint (singular M, closed form).
/// Wall, spring k1, massless joint, spring k2, mass: all along one line. The joint has no mass, so the forces of the springs on it
/// balance at all times; declared as a constraint this makes [M | Aᵀ] regular (the condition of eq. 19), and its constraint
/// force is zero. Both positions are measured from where the springs are relaxed.
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Mass matrix M (lower triangle), eq. 1:
///
/// <p><math><msub><mi>M</mi><mrow><mi>x</mi><mo>,</mo><mi>x</mi></mrow></msub><mo>=</mo><mi>m</mi></math></p>
///
/// Generalised force Q, eq. 1:
///
/// <p><math><msub><mi>Q</mi><mi>joint</mi></msub><mo>=</mo><mo>−</mo><mo>(</mo><msub><mi>k</mi><mn>1</mn></msub><mspace width="0.17em"/><mi>joint</mi><mo>+</mo><msub><mi>k</mi><mn>2</mn></msub><mspace width="0.17em"/><mo>(</mo><mi>joint</mi><mo>−</mo><mi>x</mi><mo>)</mo><mo>)</mo></math><br>
/// <math><msub><mi>Q</mi><mi>x</mi></msub><mo>=</mo><msub><mi>k</mi><mn>2</mn></msub><mspace width="0.17em"/><mo>(</mo><mi>joint</mi><mo>−</mo><mi>x</mi><mo>)</mo></math></p>
///
/// Constraints, eqs. 3 and 4, each with its row of the constraint Jacobian A and of b, eq. 5:
///
/// <p><math><mtext>balance:</mtext><mspace width="1em"/><msub><mi>k</mi><mn>1</mn></msub><mspace width="0.17em"/><mi>joint</mi><mo>+</mo><msub><mi>k</mi><mn>2</mn></msub><mspace width="0.17em"/><mo>(</mo><mi>joint</mi><mo>−</mo><mi>x</mi><mo>)</mo><mo>=</mo><mn>0</mn></math><br>
/// <math><msub><mi>A</mi><mrow><mi>balance</mi><mo>,</mo><mi>joint</mi></mrow></msub><mo>=</mo><msub><mi>k</mi><mn>1</mn></msub><mo>+</mo><msub><mi>k</mi><mn>2</mn></msub></math><br>
/// <math><msub><mi>A</mi><mrow><mi>balance</mi><mo>,</mo><mi>x</mi></mrow></msub><mo>=</mo><mo>−</mo><msub><mi>k</mi><mn>2</mn></msub></math><br>
/// <math><msub><mi>b</mi><mi>balance</mi></msub><mo>=</mo><mn>0</mn></math></p>
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 0 of its entries.
/// Coordinate `joint` is not solved for, since `balance` replaces the inertia it lacks.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 4 | 2 | 0 | 0 | 0 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 10 | 16 | 3 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 4 | 10 | 2 | 0 | 0 | 4 |
/// | straight line, as emitted | 3 | 5 | 0 | 0 | 0 | 0 |
/// | correction of a projection | 1 | 1 | 0 | 0 | 0 | 0 |
/// | once for a set of parameters | 1 | 6 | 2 | 0 | 0 | 4 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct MasslessSpring {
    /// Mass
    ///
    /// Unit: kg.
    pub m: f64,
    /// Stiffness of the spring at the wall
    ///
    /// Unit: N/m.
    pub k1: f64,
    /// Stiffness of the spring at the mass
    ///
    /// Unit: N/m.
    pub k2: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for MasslessSpring {
    fn default() -> Self {
        MasslessSpring {
            m: 1.0,
            k1: 30.0,
            k2: 60.0,
        }
    }
}
#[allow(dead_code)]
impl MasslessSpring {
    /// Position in q of coordinate `joint`, in m.
    pub const JOINT: usize = 0;
    /// Position in q of coordinate `x`, in m.
    pub const X: usize = 1;
    /// Row in A of constraint `balance`.
    pub const BALANCE: usize = 0;
    /// Position of output `spring_force`, in N.
    pub const OUT_SPRING_FORCE: usize = 0;
}
const _: () = {
    use ::ukcore::emitted as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<MasslessSpring> for ukcore::Prepared {
        fn from(mechanism: MasslessSpring) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for MasslessSpring {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "MasslessSpring",
            doc: "Mass on two springs with a massless joint (singular M, closed form).\nWall, spring k1, massless joint, spring k2, mass: all along one line. The joint has no mass, so the forces of the springs on it\nbalance at all times; declared as a constraint this makes [M | Aᵀ] regular (the condition of eq. 19), and its constraint\nforce is zero. Both positions are measured from where the springs are relaxed.",
            params: &[
                ukcore::ParamSpec {
                    name: "m",
                    doc: "Mass",
                    default: 1.0,
                    unit: "kg",
                    written: "",
                },
                ukcore::ParamSpec {
                    name: "k1",
                    doc: "Stiffness of the spring at the wall",
                    default: 30.0,
                    unit: "N/m",
                    written: "",
                },
                ukcore::ParamSpec {
                    name: "k2",
                    doc: "Stiffness of the spring at the mass",
                    default: 60.0,
                    unit: "N/m",
                    written: "",
                },
            ],
            prepared: &[
                ("k1", "k1"),
                ("k2", "k2"),
                ("half_m", "0.5*m"),
                ("per_k1_and_k2", "1/(k1 + k2)"),
                ("per_m_k2", "k2/m"),
                ("per_m_sq_k2_per_k1_and_k2", "sq(k2)/(m*(k1 + k2))"),
                ("m", "m"),
                ("k1_and_k2", "k1 + k2"),
                (
                    "safe_balance",
                    "1 if the pivots that depend on m, k1, k2 alone are positive and finite, else 0",
                ),
            ],
            coords: &["joint", "x"],
            coordinate_units: &["m", "m"],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "balance",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "k1*joint + k2*(joint - x) = 0",
                },
            ],
            holonomic: 1,
            multiplier_units: &["m"],
            outputs: &[
                ukcore::OutputSpec {
                    name: "spring_force",
                    doc: "Force that the springs transmit",
                    unit: "N",
                    loaded: false,
                },
            ],
            starts: &[
                ukcore::StartSpec {
                    name: "pulled",
                    doc: "mass pulled out and let go, joint in balance",
                    options: &[
                        ukcore::StartOption {
                            name: "pull",
                            doc: "Position of the mass",
                            default: 0.1,
                            unit: "m",
                            written: "",
                        },
                        ukcore::StartOption {
                            name: "speed",
                            doc: "Velocity of the mass",
                            default: 0.0,
                            unit: "m/s",
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
                        kind: ukcore::ShapeKind::Spring,
                        numbers: 4,
                        label: "",
                    },
                    ukcore::ShapeSpec {
                        kind: ukcore::ShapeKind::Spring,
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
                        ukcore::Pivot::Massless(0, 0),
                        ukcore::Pivot::Coordinate(1),
                    ],
                    fill: &[],
                    checks: &[ukcore::Check::Positive(1), ukcore::Check::Positive(2)],
                    least_share: 0.0009765625,
                    regular: &[],
                    met: &[],
                    velocities: &[],
                    turned: &[],
                    solved: &[],
                    copies: &[],
                    redundant: &[],
                },
                mass_pattern: &[(1, 1)],
                jacobian_pattern: &[(0, 0), (0, 1)],
                mass_diagonal: true,
                mass_constant: true,
                jacobian_constant: true,
                jacobian_driven: false,
                driven: &[],
                jacobian_fixed: &[(0, 0), (0, 1)],
                massless: &[0],
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
                    "1 of 1 entries of b: identically zero",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 4,
                        multiplications: 2,
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
                        additions: 4,
                        multiplications: 10,
                        divisions: 2,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 4,
                    },
                    acceleration: ukcore::Operations {
                        additions: 3,
                        multiplications: 5,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    correction: ukcore::Operations {
                        additions: 1,
                        multiplications: 1,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    prepare: ukcore::Operations {
                        additions: 1,
                        multiplications: 6,
                        divisions: 2,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 4,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[],
                mass: &["M[x, x] = m"],
                force: &[
                    "Q[joint] = -(k1*joint + k2*(joint - x))",
                    "Q[x] = k2*(joint - x)",
                ],
                nonideal: &[],
                constraints: &[
                    "balance: k1*joint + k2*(joint - x) = 0",
                    "    A[balance, joint] = k1 + k2",
                    "    A[balance, x] = -k2",
                    "    b[balance] = 0",
                ],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.m,
                1 => self.k1,
                2 => self.k2,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.m = value,
                1 => self.k1 = value,
                2 => self.k2 = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 9>(prepared, "prepared");
            if const { S::TAPED } {
                const TAPE: ukcore::Tape = ukcore::Tape {
                    constants: &[
                        0.5,
                        1.7976931348623157e308,
                        2.2250738585072014e-308,
                        1.0,
                        0.0,
                    ],
                    code: b"206 bytes",
                };
                let mut registers = [S::from_f64(0.0); 12];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[ukcore::emitted::exact::<S, 3>(given, "given")],
                    (&[], &[]),
                    &mut [&mut prepared[..]],
                );
                return;
            }
            let [m, k1, k2] = *ukcore::emitted::exact::<S, 3>(given, "given");
            let lit = S::from_f64;
            prepared[0] = k1;
            prepared[1] = k2;
            let per_m = m.recip();
            prepared[2] = lit(0.5) * m;
            let k1_plus_k2 = k1 + k2;
            let per_k1_plus_k2 = k1_plus_k2.recip();
            prepared[3] = per_k1_plus_k2;
            prepared[4] = k2 * per_m;
            prepared[5] = k2 * k2 * per_m * per_k1_plus_k2;
            prepared[6] = m;
            prepared[7] = k1_plus_k2;
            let sq_k1_plus_k2 = k1_plus_k2 * k1_plus_k2;
            let safe_x = S::select_le(
                m,
                lit(1.7976931348623157e308),
                S::select_le(lit(2.2250738585072014e-308), m, lit(1.0), lit(0.0)),
                lit(0.0),
            );
            let safe_balance = S::select_le(
                sq_k1_plus_k2,
                lit(1.7976931348623157e308),
                S::select_le(
                    lit(2.2250738585072014e-308),
                    sq_k1_plus_k2,
                    safe_x,
                    lit(0.0),
                ),
                lit(0.0),
            );
            prepared[8] = safe_balance;
        }
        /// 4 additions, 2 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 0 selections.
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
                    code: b"124 bytes",
                };
                let mut registers = [S::from_f64(0.0); 17];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 9>(prepared, "prepared"),
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
            let [k1, k2, _, _, _, _, m, k1_and_k2, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [joint, x] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let lit = S::from_f64;
            mass[3] = m;
            let force_0_part = k2 * (joint - x);
            force[0] = -(joint * k1) - force_0_part;
            force[1] = force_0_part;
            nonideal[0] = lit(0.0);
            nonideal[1] = lit(0.0);
            jacobian[0] = k1_and_k2;
            jacobian[1] = -k2;
            rhs[0] = lit(0.0);
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 4>(mass, "mass");
            let [_, _, _, _, _, _, m, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
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
            let [_, k2, _, _, _, _, _, k1_and_k2, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            jacobian[0] = k1_and_k2;
            jacobian[1] = -k2;
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 1>(phi, "phi");
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
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 9>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut phi[..]],
                );
                return;
            }
            let [k1, k2, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [joint, x] = *ukcore::emitted::exact::<S, 2>(q, "q");
            phi[0] = k2.mul_add((joint - x), joint * k1);
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
                let mut registers = [S::from_f64(0.0); 16];
                S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 9>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut rate[..]],
                );
                return;
            }
            let [k1, k2, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [dot_joint, dot_x] = *ukcore::emitted::exact::<S, 2>(v, "v");
            rate[0] = k2.neg_mul_add((dot_x - dot_joint), dot_joint * k1);
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [k1, k2, half_m, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [joint, x] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let [_, dot_x] = *ukcore::emitted::exact::<S, 2>(v, "v");
            let lit = S::from_f64;
            let kinetic = dot_x * dot_x * half_m;
            let joint_minus_x = joint - x;
            let potential = lit(0.5)
                * (k2 * joint_minus_x).mul_add(joint_minus_x, joint * joint * k1);
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
            let outputs = ukcore::emitted::exact_mut::<S, 1>(outputs, "outputs");
            let [k1, _, _, _, _, _, _, _, _] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [joint, _] = *ukcore::emitted::exact::<S, 2>(q, "q");
            outputs[0] = joint * k1;
        }
        fn drawing<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            drawing: &mut [S],
        ) {
            let drawing = ukcore::emitted::exact_mut::<S, 11>(drawing, "drawing");
            let [joint, x] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let lit = S::from_f64;
            drawing[0] = lit(0.0);
            drawing[1] = lit(0.0);
            let drawing_2 = lit(1.0) + joint;
            drawing[2] = drawing_2;
            drawing[3] = lit(0.0);
            drawing[4] = drawing_2;
            drawing[5] = lit(0.0);
            let drawing_6 = lit(2.0) + x;
            drawing[6] = drawing_6;
            drawing[7] = lit(0.0);
            drawing[8] = drawing_6;
            drawing[9] = lit(0.0);
            drawing[10] = lit(0.1);
        }
        /// 3 additions, 5 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 0 selections.
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
                    constants: &[],
                    code: b"76 bytes",
                };
                let mut registers = [S::from_f64(0.0); 16];
                return S::play(
                    &TAPE,
                    &mut registers,
                    &[
                        &[t],
                        ukcore::emitted::exact::<S, 2>(q, "q"),
                        ukcore::emitted::exact::<S, 2>(v, "v"),
                        ukcore::emitted::exact::<S, 9>(prepared, "prepared"),
                    ],
                    (&[], &[]),
                    &mut [&mut out[..]],
                );
            }
            let [k1, k2, _, per_k1_and_k2, per_m_k2, per_m_sq_k2_per_k1_and_k2, _, _,
            safe_balance] = *ukcore::emitted::exact::<S, 9>(prepared, "prepared");
            let [joint, x] = *ukcore::emitted::exact::<S, 2>(q, "q");
            let joint_minus_x = joint - x;
            let right_x = per_k1_and_k2
                .neg_mul_add(k2.mul_add(joint_minus_x, joint * k1), joint_minus_x);
            let safe = safe_balance;
            out[0] = per_m_sq_k2_per_k1_and_k2 * right_x;
            out[1] = per_m_k2 * right_x;
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
            let [_, _, _, per_k1_and_k2, _, _, _, _, safe_balance] = *ukcore::emitted::exact::<
                S,
                9,
            >(prepared, "prepared");
            let [residual_0] = *ukcore::emitted::exact::<S, 1>(residual, "residual");
            let lit = S::from_f64;
            out[1] = lit(0.0);
            let safe = safe_balance;
            out[0] = -(residual_0 * per_k1_and_k2);
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
                        let [_, _, _, pull, speed] = *ukcore::emitted::exact::<
                            S,
                            5,
                        >(given, "given");
                        prepared[0] = pull;
                        prepared[1] = speed;
                    }
                    let mut numbers = [0.0; 2];
                    prepare(given, &mut numbers);
                    let places: &[(usize, ukcore::GuessKind, bool)] = &[
                        (1, ukcore::GuessKind::Position, true),
                        (1, ukcore::GuessKind::Velocity, true),
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
    impl MasslessSpring {
        /// The declared start called `name`, with these options, as `Prepared::start` assembles it:
        /// - `"pulled"` (`pull` in m, `speed` in m/s): mass pulled out and let go, joint in balance
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
macro_rules! __part_MasslessSpring {
    (($($callback:tt)*) ($($path:tt)*) [$($known:tt)*] $($rest:tt)*) => {
        $($callback)* ! { @ parts[$($known)* { $($path)* } { ? } {}] $($rest)* }
    };
}
#[doc(hidden)]
#[allow(unused_imports)]
pub(crate) use __part_MasslessSpring as MasslessSpring;
