/// Free rigid body about its centre of mass, turned by the unit quaternion (e0, e1, e2, e3) from body to space. The angular
/// velocity in body axes is ω = 2 G(e) ė, so M = 4 Gᵀ I G is singular along e; the constraint |e|² = 1 mends that (eq. 19).
///
/// # Equations of motion
///
/// Derived from the declaration at compile time, in the notation of Zhao, Zhen & Chen 2013: M q̈ = Q is the unconstrained motion, A q̈ = b what the constraints demand.
///
/// Abbreviations:
///
/// ```text
/// s1 = e1*dot(e0) + e2*dot(e3) - e0*dot(e1) - e3*dot(e2)
/// s2 = dot(e0)*e2 + dot(e1)*e3 - e0*dot(e2) - e1*dot(e3)
/// s3 = dot(e0)*e3 + e1*dot(e2) - dot(e1)*e2 - e0*dot(e3)
/// ```
///
/// Mass matrix M (lower triangle), eq. 1:
///
/// ```text
/// M[e0, e0] = 4*(sq(e1)*i1 + sq(e2)*i2 + sq(e3)*i3)
/// M[e1, e0] = 4*(e3*e2*i2 - e1*e0*i1 - e3*e2*i3)
/// M[e1, e1] = 4*(sq(e0)*i1 + sq(e3)*i2 + sq(e2)*i3)
/// M[e2, e0] = 4*(e1*e3*i3 - e1*e3*i1 - e0*e2*i2)
/// M[e2, e1] = 4*(e0*e3*i1 - e0*e3*i2 - e1*e2*i3)
/// M[e2, e2] = 4*(sq(e3)*i1 + sq(e0)*i2 + sq(e1)*i3)
/// M[e3, e0] = 4*(e1*e2*i1 - e1*e2*i2 - e0*e3*i3)
/// M[e3, e1] = 4*(e0*e2*i3 - e0*e2*i1 - e1*e3*i2)
/// M[e3, e2] = 4*(e1*e0*i2 - e3*e2*i1 - e1*e0*i3)
/// M[e3, e3] = 4*(sq(e2)*i1 + sq(e1)*i2 + sq(e0)*i3)
/// ```
///
/// Generalised force Q, eq. 1:
///
/// ```text
/// Q[e0] = -8*(dot(e1)*s1*i1 + dot(e2)*s2*i2 + dot(e3)*s3*i3)
/// Q[e1] = 8*(dot(e0)*s1*i1 + dot(e2)*s3*i3 - dot(e3)*s2*i2)
/// Q[e2] = 8*(dot(e3)*s1*i1 + dot(e0)*s2*i2 - dot(e1)*s3*i3)
/// Q[e3] = 8*(dot(e1)*s2*i2 + dot(e0)*s3*i3 - dot(e2)*s1*i1)
/// ```
///
/// Constraints φ, eqs. 3 and 4:
///
/// ```text
/// unit: sq(e0) + sq(e1) + sq(e2) + sq(e3) - 1 = 0
/// ```
///
/// Constraint Jacobian A, eq. 5:
///
/// ```text
/// A[unit, e0] = 2*e0
/// A[unit, e1] = 2*e1
/// A[unit, e2] = 2*e2
/// A[unit, e3] = 2*e3
/// ```
///
/// Right-hand side b, eq. 5:
///
/// ```text
/// b[unit] = -2*(sq(dot(e0)) + sq(dot(e1)) + sq(dot(e2)) + sq(dot(e3)))
/// ```
///
/// # How it is computed
///
/// By straight-line code: [M Aᵀ; A 0] is eliminated at compile time, which fills in 0 of its entries.
///
/// | operations | add | multiply | divide | root | function | select |
/// | --- | ---: | ---: | ---: | ---: | ---: | ---: |
/// | M, Q, c, A and b | 40 | 119 | 0 | 0 | 0 | 0 |
/// | dense LDLᵀ of [M Aᵀ; A 0] after that | 40 | 55 | 5 | 0 | 0 | 0 |
/// | straight line, nothing hoisted | 85 | 177 | 5 | 0 | 0 | 5 |
/// | straight line, as emitted | 85 | 177 | 5 | 0 | 0 | 5 |
/// | correction of a projection | 50 | 128 | 5 | 0 | 0 | 5 |
/// | once for a set of parameters | 0 | 3 | 0 | 0 | 0 | 0 |
///
/// `Mechanism::plan` tells the order, what is hoisted and left out, and draws the sparsity; `Mechanism::CODE` is the code.
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, clippy::approx_constant)]
pub struct RigidBody {
    /// Smallest principal moment of inertia, kg m^2
    pub i1: f64,
    /// Middle principal moment of inertia, kg m^2
    pub i2: f64,
    /// Largest principal moment of inertia, kg m^2
    pub i3: f64,
}
#[automatically_derived]
#[allow(clippy::approx_constant, clippy::derivable_impls, clippy::unreadable_literal)]
impl ::core::default::Default for RigidBody {
    fn default() -> Self {
        RigidBody {
            i1: 1.0,
            i2: 2.0,
            i3: 3.0,
        }
    }
}
#[allow(dead_code)]
impl RigidBody {
    /// Position in q of coordinate `e0`.
    pub const E0: usize = 0;
    /// Position in q of coordinate `e1`.
    pub const E1: usize = 1;
    /// Position in q of coordinate `e2`.
    pub const E2: usize = 2;
    /// Position in q of coordinate `e3`.
    pub const E3: usize = 3;
    /// Row in A of constraint `unit`.
    pub const UNIT: usize = 0;
    /// Position of output `spin1`.
    pub const OUT_SPIN1: usize = 0;
    /// Position of output `spin2`.
    pub const OUT_SPIN2: usize = 1;
    /// Position of output `spin3`.
    pub const OUT_SPIN3: usize = 2;
    /// Position of output `momentum_x`.
    pub const OUT_MOMENTUM_X: usize = 3;
    /// Position of output `momentum_y`.
    pub const OUT_MOMENTUM_Y: usize = 4;
    /// Position of output `momentum_z`.
    pub const OUT_MOMENTUM_Z: usize = 5;
}
const _: () = {
    use ::ukcore as ukcore;
    #[automatically_derived]
    impl ::core::convert::From<RigidBody> for ukcore::Prepared {
        fn from(mechanism: RigidBody) -> Self {
            ukcore::Mechanism::prepared(&mechanism)
        }
    }
    #[automatically_derived]
    #[allow(unused_variables, clippy::all, clippy::pedantic)]
    impl ukcore::Mechanism for RigidBody {
        const SPEC: &'static ukcore::Spec = &ukcore::Spec {
            name: "RigidBody",
            doc: "Free rigid body about its centre of mass, turned by the unit quaternion (e0, e1, e2, e3) from body to space. The angular\nvelocity in body axes is ω = 2 G(e) ė, so M = 4 Gᵀ I G is singular along e; the constraint |e|² = 1 mends that (eq. 19).",
            params: &[
                ukcore::ParamSpec {
                    name: "i1",
                    doc: "Smallest principal moment of inertia, kg m^2",
                    default: 1.0,
                },
                ukcore::ParamSpec {
                    name: "i2",
                    doc: "Middle principal moment of inertia, kg m^2",
                    default: 2.0,
                },
                ukcore::ParamSpec {
                    name: "i3",
                    doc: "Largest principal moment of inertia, kg m^2",
                    default: 3.0,
                },
            ],
            prepared: &[
                ("i1", "i1"),
                ("i2", "i2"),
                ("i3", "i3"),
                ("twice_i2", "2*i2"),
                ("twice_i3", "2*i3"),
                ("twice_i1", "2*i1"),
            ],
            coords: &["e0", "e1", "e2", "e3"],
            constraints: &[
                ukcore::ConstraintSpec {
                    name: "unit",
                    kind: ukcore::ConstraintKind::Holonomic,
                    equation: "sq(e0) + sq(e1) + sq(e2) + sq(e3) - 1 = 0",
                },
            ],
            holonomic: 1,
            outputs: &[
                ukcore::OutputSpec {
                    name: "spin1",
                    doc: "Angular velocity about the body's axis 1, rad/s",
                },
                ukcore::OutputSpec {
                    name: "spin2",
                    doc: "Angular velocity about the body's axis 2, rad/s",
                },
                ukcore::OutputSpec {
                    name: "spin3",
                    doc: "Angular velocity about the body's axis 3, rad/s",
                },
                ukcore::OutputSpec {
                    name: "momentum_x",
                    doc: "Angular momentum along the space axis x, kg m^2/s",
                },
                ukcore::OutputSpec {
                    name: "momentum_y",
                    doc: "Angular momentum along the space axis y, kg m^2/s",
                },
                ukcore::OutputSpec {
                    name: "momentum_z",
                    doc: "Angular momentum along the space axis z, kg m^2/s",
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
                        ukcore::Pivot::Coordinate(2),
                        ukcore::Pivot::Coordinate(3),
                        ukcore::Pivot::Constraint(0),
                    ],
                    fill: &[],
                    checks: &[
                        ukcore::Check::Positive(0),
                        ukcore::Check::Share(1),
                        ukcore::Check::Share(2),
                        ukcore::Check::Share(3),
                        ukcore::Check::Positive(4),
                    ],
                    least_share: 0.0009765625,
                },
                mass_pattern: &[
                    (0, 0),
                    (0, 1),
                    (0, 2),
                    (0, 3),
                    (1, 0),
                    (1, 1),
                    (1, 2),
                    (1, 3),
                    (2, 0),
                    (2, 1),
                    (2, 2),
                    (2, 3),
                    (3, 0),
                    (3, 1),
                    (3, 2),
                    (3, 3),
                ],
                jacobian_pattern: &[(0, 0), (0, 1), (0, 2), (0, 3)],
                mass_diagonal: false,
                mass_constant: false,
                jacobian_constant: false,
                massless: &[],
                angles: &[],
                scleronomic: true,
                nonideal: false,
                potential: false,
                conservative: true,
                left_out: &[
                    "∂/∂t terms: no equation contains the time",
                    "non-ideal force c (eq. 12): all constraints are ideal",
                ],
                costs: ukcore::Costs {
                    dynamics: ukcore::Operations {
                        additions: 40,
                        multiplications: 119,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    dense: ukcore::Operations {
                        additions: 40,
                        multiplications: 55,
                        divisions: 5,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                    unprepared: ukcore::Operations {
                        additions: 85,
                        multiplications: 177,
                        divisions: 5,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 5,
                    },
                    acceleration: ukcore::Operations {
                        additions: 85,
                        multiplications: 177,
                        divisions: 5,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 5,
                    },
                    correction: ukcore::Operations {
                        additions: 50,
                        multiplications: 128,
                        divisions: 5,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 5,
                    },
                    prepare: ukcore::Operations {
                        additions: 0,
                        multiplications: 3,
                        divisions: 0,
                        square_roots: 0,
                        transcendentals: 0,
                        selections: 0,
                    },
                },
            },
            equations: ukcore::Equations {
                definitions: &[
                    ("s1", "e1*dot(e0) + e2*dot(e3) - e0*dot(e1) - e3*dot(e2)"),
                    ("s2", "dot(e0)*e2 + dot(e1)*e3 - e0*dot(e2) - e1*dot(e3)"),
                    ("s3", "dot(e0)*e3 + e1*dot(e2) - dot(e1)*e2 - e0*dot(e3)"),
                ],
                mass: &[
                    (0, 0, "4*(sq(e1)*i1 + sq(e2)*i2 + sq(e3)*i3)"),
                    (1, 0, "4*(e3*e2*i2 - e1*e0*i1 - e3*e2*i3)"),
                    (1, 1, "4*(sq(e0)*i1 + sq(e3)*i2 + sq(e2)*i3)"),
                    (2, 0, "4*(e1*e3*i3 - e1*e3*i1 - e0*e2*i2)"),
                    (2, 1, "4*(e0*e3*i1 - e0*e3*i2 - e1*e2*i3)"),
                    (2, 2, "4*(sq(e3)*i1 + sq(e0)*i2 + sq(e1)*i3)"),
                    (3, 0, "4*(e1*e2*i1 - e1*e2*i2 - e0*e3*i3)"),
                    (3, 1, "4*(e0*e2*i3 - e0*e2*i1 - e1*e3*i2)"),
                    (3, 2, "4*(e1*e0*i2 - e3*e2*i1 - e1*e0*i3)"),
                    (3, 3, "4*(sq(e2)*i1 + sq(e1)*i2 + sq(e0)*i3)"),
                ],
                force: &[
                    (0, "-8*(dot(e1)*s1*i1 + dot(e2)*s2*i2 + dot(e3)*s3*i3)"),
                    (1, "8*(dot(e0)*s1*i1 + dot(e2)*s3*i3 - dot(e3)*s2*i2)"),
                    (2, "8*(dot(e3)*s1*i1 + dot(e0)*s2*i2 - dot(e1)*s3*i3)"),
                    (3, "8*(dot(e1)*s2*i2 + dot(e0)*s3*i3 - dot(e2)*s1*i1)"),
                ],
                nonideal: &[],
                jacobian: &[
                    (0, 0, "2*e0"),
                    (0, 1, "2*e1"),
                    (0, 2, "2*e2"),
                    (0, 3, "2*e3"),
                ],
                rhs: &[(0, "-2*(sq(dot(e0)) + sq(dot(e1)) + sq(dot(e2)) + sq(dot(e3)))")],
            },
        };
        fn parameter(&self, index: usize) -> f64 {
            match index {
                0 => self.i1,
                1 => self.i2,
                2 => self.i3,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn set_parameter(&mut self, index: usize, value: f64) {
            match index {
                0 => self.i1 = value,
                1 => self.i2 = value,
                2 => self.i3 = value,
                _ => ukcore::emitted::no_parameter(index),
            }
        }
        fn prepare<S: ukcore::Scalar>(given: &[S], prepared: &mut [S]) {
            let prepared = ukcore::emitted::exact_mut::<S, 6>(prepared, "prepared");
            let [i1, i2, i3] = *ukcore::emitted::exact::<S, 3>(given, "given");
            let lit = S::from_f64;
            prepared[0] = i1;
            prepared[1] = i2;
            prepared[2] = i3;
            prepared[3] = lit(2.0) * i2;
            prepared[4] = lit(2.0) * i3;
            prepared[5] = lit(2.0) * i1;
        }
        /// 40 additions, 119 multiplications, 0 divisions, 0 square roots, 0 transcendentals, 0 selections.
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
            let jacobian = ukcore::emitted::exact_mut::<S, 4>(out.jacobian, "jacobian");
            let rhs = ukcore::emitted::exact_mut::<S, 1>(out.rhs, "rhs");
            let [i1, i2, i3, _, _, _] = *ukcore::emitted::exact::<
                S,
                6,
            >(prepared, "prepared");
            let [e0, e1, e2, e3] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [dot_e0, dot_e1, dot_e2, dot_e3] = *ukcore::emitted::exact::<
                S,
                4,
            >(v, "v");
            let lit = S::from_f64;
            mass[0] = lit(4.0)
                * (e3 * e3).mul_add(i3, (e2 * e2).mul_add(i2, e1 * e1 * i1));
            let mass_e1_e0 = lit(-4.0)
                * (e3 * e2).mul_add(i3, (e3 * e2).neg_mul_add(i2, e1 * e0 * i1));
            mass[1] = mass_e1_e0;
            let mass_e2_e0 = lit(-4.0)
                * (e1 * e3).neg_mul_add(i3, (e0 * e2).mul_add(i2, e1 * e3 * i1));
            mass[2] = mass_e2_e0;
            let mass_e3_e0 = lit(4.0)
                * (e0 * e3).neg_mul_add(i3, (e1 * e2).neg_mul_add(i2, e1 * e2 * i1));
            mass[3] = mass_e3_e0;
            mass[4] = mass_e1_e0;
            mass[5] = lit(4.0)
                * (e2 * e2).mul_add(i3, (e3 * e3).mul_add(i2, e0 * e0 * i1));
            let mass_e2_e1 = lit(4.0)
                * (e1 * e2).neg_mul_add(i3, (e0 * e3).neg_mul_add(i2, e0 * e3 * i1));
            mass[6] = mass_e2_e1;
            let mass_e3_e1 = lit(-4.0)
                * (e0 * e2).neg_mul_add(i3, (e1 * e3).mul_add(i2, e0 * e2 * i1));
            mass[7] = mass_e3_e1;
            mass[8] = mass_e2_e0;
            mass[9] = mass_e2_e1;
            mass[10] = lit(4.0)
                * (e1 * e1).mul_add(i3, (e0 * e0).mul_add(i2, e3 * e3 * i1));
            let mass_e3_e2 = lit(-4.0)
                * (e1 * e0).mul_add(i3, (e1 * e0).neg_mul_add(i2, e3 * e2 * i1));
            mass[11] = mass_e3_e2;
            mass[12] = mass_e3_e0;
            mass[13] = mass_e3_e1;
            mass[14] = mass_e3_e2;
            mass[15] = lit(4.0)
                * (e0 * e0).mul_add(i3, (e1 * e1).mul_add(i2, e2 * e2 * i1));
            let force_0_part = e2
                .mul_add(
                    dot_e3,
                    e3.neg_mul_add(dot_e2, e0.neg_mul_add(dot_e1, e1 * dot_e0)),
                );
            let force_0_part_2 = e1
                .neg_mul_add(
                    dot_e3,
                    e0.neg_mul_add(dot_e2, dot_e1.mul_add(e3, dot_e0 * e2)),
                );
            let force_0_part_3 = e0
                .neg_mul_add(
                    dot_e3,
                    e1.mul_add(dot_e2, dot_e1.neg_mul_add(e2, dot_e0 * e3)),
                );
            force[0] = lit(-8.0)
                * (dot_e3 * i3)
                    .mul_add(
                        force_0_part_3,
                        (dot_e2 * i2).mul_add(force_0_part_2, dot_e1 * i1 * force_0_part),
                    );
            force[1] = lit(8.0)
                * (dot_e2 * i3)
                    .mul_add(
                        force_0_part_3,
                        (dot_e3 * i2)
                            .neg_mul_add(force_0_part_2, dot_e0 * i1 * force_0_part),
                    );
            force[2] = lit(8.0)
                * (dot_e1 * i3)
                    .neg_mul_add(
                        force_0_part_3,
                        (dot_e0 * i2).mul_add(force_0_part_2, dot_e3 * i1 * force_0_part),
                    );
            force[3] = lit(-8.0)
                * (dot_e0 * i3)
                    .neg_mul_add(
                        force_0_part_3,
                        (dot_e1 * i2)
                            .neg_mul_add(force_0_part_2, dot_e2 * i1 * force_0_part),
                    );
            nonideal[0] = lit(0.0);
            nonideal[1] = lit(0.0);
            nonideal[2] = lit(0.0);
            nonideal[3] = lit(0.0);
            jacobian[0] = lit(2.0) * e0;
            jacobian[1] = lit(2.0) * e1;
            jacobian[2] = lit(2.0) * e2;
            jacobian[3] = lit(2.0) * e3;
            rhs[0] = lit(-2.0)
                * dot_e3
                    .mul_add(
                        dot_e3,
                        dot_e2.mul_add(dot_e2, dot_e1.mul_add(dot_e1, dot_e0 * dot_e0)),
                    );
        }
        fn mass_matrix<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            mass: &mut [S],
        ) {
            let mass = ukcore::emitted::exact_mut::<S, 16>(mass, "mass");
            let [i1, i2, i3, _, _, _] = *ukcore::emitted::exact::<
                S,
                6,
            >(prepared, "prepared");
            let [e0, e1, e2, e3] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let lit = S::from_f64;
            mass[0] = lit(4.0)
                * (e3 * e3).mul_add(i3, (e2 * e2).mul_add(i2, e1 * e1 * i1));
            let mass_e1_e0 = lit(-4.0)
                * (e3 * e2).mul_add(i3, (e3 * e2).neg_mul_add(i2, e1 * e0 * i1));
            mass[1] = mass_e1_e0;
            let mass_e2_e0 = lit(-4.0)
                * (e1 * e3).neg_mul_add(i3, (e0 * e2).mul_add(i2, e1 * e3 * i1));
            mass[2] = mass_e2_e0;
            let mass_e3_e0 = lit(4.0)
                * (e0 * e3).neg_mul_add(i3, (e1 * e2).neg_mul_add(i2, e1 * e2 * i1));
            mass[3] = mass_e3_e0;
            mass[4] = mass_e1_e0;
            mass[5] = lit(4.0)
                * (e2 * e2).mul_add(i3, (e3 * e3).mul_add(i2, e0 * e0 * i1));
            let mass_e2_e1 = lit(4.0)
                * (e1 * e2).neg_mul_add(i3, (e0 * e3).neg_mul_add(i2, e0 * e3 * i1));
            mass[6] = mass_e2_e1;
            let mass_e3_e1 = lit(-4.0)
                * (e0 * e2).neg_mul_add(i3, (e1 * e3).mul_add(i2, e0 * e2 * i1));
            mass[7] = mass_e3_e1;
            mass[8] = mass_e2_e0;
            mass[9] = mass_e2_e1;
            mass[10] = lit(4.0)
                * (e1 * e1).mul_add(i3, (e0 * e0).mul_add(i2, e3 * e3 * i1));
            let mass_e3_e2 = lit(-4.0)
                * (e1 * e0).mul_add(i3, (e1 * e0).neg_mul_add(i2, e3 * e2 * i1));
            mass[11] = mass_e3_e2;
            mass[12] = mass_e3_e0;
            mass[13] = mass_e3_e1;
            mass[14] = mass_e3_e2;
            mass[15] = lit(4.0)
                * (e0 * e0).mul_add(i3, (e1 * e1).mul_add(i2, e2 * e2 * i1));
        }
        fn jacobian<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            jacobian: &mut [S],
        ) {
            let jacobian = ukcore::emitted::exact_mut::<S, 4>(jacobian, "jacobian");
            let [e0, e1, e2, e3] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let lit = S::from_f64;
            jacobian[0] = lit(2.0) * e0;
            jacobian[1] = lit(2.0) * e1;
            jacobian[2] = lit(2.0) * e2;
            jacobian[3] = lit(2.0) * e3;
        }
        fn residual<S: ukcore::Scalar>(prepared: &[S], t: S, q: &[S], phi: &mut [S]) {
            let phi = ukcore::emitted::exact_mut::<S, 1>(phi, "phi");
            let [e0, e1, e2, e3] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let lit = S::from_f64;
            phi[0] = e3.mul_add(e3, e2.mul_add(e2, e1.mul_add(e1, e0 * e0))) - lit(1.0);
        }
        fn residual_rate<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            rate: &mut [S],
        ) {
            let rate = ukcore::emitted::exact_mut::<S, 1>(rate, "rate");
            let [e0, e1, e2, e3] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [dot_e0, dot_e1, dot_e2, dot_e3] = *ukcore::emitted::exact::<
                S,
                4,
            >(v, "v");
            let lit = S::from_f64;
            rate[0] = lit(2.0)
                * e3
                    .mul_add(
                        dot_e3,
                        e2.mul_add(dot_e2, e1.mul_add(dot_e1, e0 * dot_e0)),
                    );
        }
        fn energy<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
        ) -> ukcore::Energy<S> {
            let [i1, i2, i3, _, _, _] = *ukcore::emitted::exact::<
                S,
                6,
            >(prepared, "prepared");
            let [e0, e1, e2, e3] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [dot_e0, dot_e1, dot_e2, dot_e3] = *ukcore::emitted::exact::<
                S,
                4,
            >(v, "v");
            let lit = S::from_f64;
            let kinetic_part = e2
                .mul_add(
                    dot_e3,
                    e3.neg_mul_add(dot_e2, e0.neg_mul_add(dot_e1, e1 * dot_e0)),
                );
            let kinetic_part_2 = e1
                .neg_mul_add(
                    dot_e3,
                    e0.neg_mul_add(dot_e2, dot_e1.mul_add(e3, dot_e0 * e2)),
                );
            let kinetic_part_3 = e0
                .neg_mul_add(
                    dot_e3,
                    e1.mul_add(dot_e2, dot_e1.neg_mul_add(e2, dot_e0 * e3)),
                );
            let kinetic = lit(2.0)
                * (i3 * kinetic_part_3)
                    .mul_add(
                        kinetic_part_3,
                        (i2 * kinetic_part_2)
                            .mul_add(kinetic_part_2, i1 * kinetic_part * kinetic_part),
                    );
            let potential = lit(0.0);
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
            let outputs = ukcore::emitted::exact_mut::<S, 6>(outputs, "outputs");
            let [i1, i2, i3, twice_i2, twice_i3, twice_i1] = *ukcore::emitted::exact::<
                S,
                6,
            >(prepared, "prepared");
            let [e0, e1, e2, e3] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [dot_e0, dot_e1, dot_e2, dot_e3] = *ukcore::emitted::exact::<
                S,
                4,
            >(v, "v");
            let lit = S::from_f64;
            let output_0_part = e2
                .mul_add(
                    dot_e3,
                    e3.neg_mul_add(dot_e2, e0.neg_mul_add(dot_e1, e1 * dot_e0)),
                );
            outputs[0] = lit(-2.0) * output_0_part;
            let output_1_part = e1
                .neg_mul_add(
                    dot_e3,
                    e0.neg_mul_add(dot_e2, dot_e1.mul_add(e3, dot_e0 * e2)),
                );
            outputs[1] = lit(-2.0) * output_1_part;
            let output_2_part = e0
                .neg_mul_add(
                    dot_e3,
                    e1.mul_add(dot_e2, dot_e1.neg_mul_add(e2, dot_e0 * e3)),
                );
            outputs[2] = lit(-2.0) * output_2_part;
            let sq_e2 = e2 * e2;
            let sq_e3 = e3 * e3;
            let e1_e2 = e1 * e2;
            let e0_e3 = e0 * e3;
            let e1_e3 = e1 * e3;
            let e0_e2 = e0 * e2;
            outputs[3] = lit(-2.0)
                * (i1 * output_0_part)
                    .mul_add(
                        lit(2.0).neg_mul_add((sq_e2 + sq_e3), lit(1.0)),
                        (twice_i3 * output_2_part)
                            .mul_add(
                                (e1_e3 + e0_e2),
                                twice_i2 * output_1_part * (e1_e2 - e0_e3),
                            ),
                    );
            let sq_e1 = e1 * e1;
            let e3_e2 = e3 * e2;
            let e1_e0 = e1 * e0;
            outputs[4] = lit(-2.0)
                * (i2 * output_1_part)
                    .mul_add(
                        lit(2.0).neg_mul_add((sq_e1 + sq_e3), lit(1.0)),
                        (twice_i3 * output_2_part)
                            .mul_add(
                                (e3_e2 - e1_e0),
                                twice_i1 * output_0_part * (e1_e2 + e0_e3),
                            ),
                    );
            outputs[5] = lit(-2.0)
                * (i3 * output_2_part)
                    .mul_add(
                        lit(2.0).neg_mul_add((sq_e1 + sq_e2), lit(1.0)),
                        (twice_i2 * output_1_part)
                            .mul_add(
                                (e3_e2 + e1_e0),
                                twice_i1 * output_0_part * (e1_e3 - e0_e2),
                            ),
                    );
        }
        /// 85 additions, 177 multiplications, 5 divisions, 0 square roots, 0 transcendentals, 5 selections.
        fn acceleration<S: ukcore::Scalar>(
            prepared: &[S],
            t: S,
            q: &[S],
            v: &[S],
            out: &mut [S],
        ) -> S {
            let out = ukcore::emitted::exact_mut::<S, 4>(out, "out");
            let [i1, i2, i3, _, _, _] = *ukcore::emitted::exact::<
                S,
                6,
            >(prepared, "prepared");
            let [e0, e1, e2, e3] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [dot_e0, dot_e1, dot_e2, dot_e3] = *ukcore::emitted::exact::<
                S,
                4,
            >(v, "v");
            let lit = S::from_f64;
            let pivot_e0 = lit(4.0)
                * (e3 * e3).mul_add(i3, (e2 * e2).mul_add(i2, e1 * e1 * i1));
            let per_pivot_e0 = pivot_e0.recip();
            let safe_e0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_e0,
                lit(1.0),
                lit(0.0),
            );
            let acceleration_0_part = e2
                .mul_add(
                    dot_e3,
                    e3.neg_mul_add(dot_e2, e0.neg_mul_add(dot_e1, e1 * dot_e0)),
                );
            let acceleration_0_part_2 = e1
                .neg_mul_add(
                    dot_e3,
                    e0.neg_mul_add(dot_e2, dot_e1.mul_add(e3, dot_e0 * e2)),
                );
            let acceleration_0_part_3 = e0
                .neg_mul_add(
                    dot_e3,
                    e1.mul_add(dot_e2, dot_e1.neg_mul_add(e2, dot_e0 * e3)),
                );
            let right_e0 = lit(8.0)
                * (dot_e3 * i3)
                    .mul_add(
                        acceleration_0_part_3,
                        (dot_e2 * i2)
                            .mul_add(
                                acceleration_0_part_2,
                                dot_e1 * i1 * acceleration_0_part,
                            ),
                    );
            let acceleration_0_part_4 = lit(4.0)
                * (e3 * e2).mul_add(i3, (e3 * e2).neg_mul_add(i2, e1 * e0 * i1));
            let e1_by_e0 = acceleration_0_part_4 * per_pivot_e0;
            let diagonal_e1 = lit(4.0)
                * (e2 * e2).mul_add(i3, (e3 * e3).mul_add(i2, e0 * e0 * i1));
            let pivot_e1 = acceleration_0_part_4 * e1_by_e0 - diagonal_e1;
            let per_pivot_e1 = pivot_e1.recip();
            let safe_e1 = S::select_le(
                lit(0.0009765625) * diagonal_e1,
                -pivot_e1,
                safe_e0,
                lit(0.0),
            );
            let right_e1 = right_e0
                .neg_mul_add(
                    e1_by_e0,
                    lit(8.0)
                        * (dot_e2 * i3)
                            .mul_add(
                                acceleration_0_part_3,
                                (dot_e3 * i2)
                                    .neg_mul_add(
                                        acceleration_0_part_2,
                                        dot_e0 * i1 * acceleration_0_part,
                                    ),
                            ),
                );
            let acceleration_0_part_5 = lit(4.0)
                * (e1 * e3).neg_mul_add(i3, (e0 * e2).mul_add(i2, e1 * e3 * i1));
            let e2_by_e0 = acceleration_0_part_5 * per_pivot_e0;
            let acceleration_0_part_6 = lit(4.0)
                * (e1 * e2).neg_mul_add(i3, (e0 * e3).neg_mul_add(i2, e0 * e3 * i1));
            let acceleration_0_part_7 = acceleration_0_part_4 * e2_by_e0
                - acceleration_0_part_6;
            let e2_by_e1 = acceleration_0_part_7 * per_pivot_e1;
            let diagonal_e2 = lit(4.0)
                * (e1 * e1).mul_add(i3, (e0 * e0).mul_add(i2, e3 * e3 * i1));
            let pivot_e2 = acceleration_0_part_7
                .neg_mul_add(e2_by_e1, acceleration_0_part_5 * e2_by_e0 - diagonal_e2);
            let per_pivot_e2 = pivot_e2.recip();
            let safe_e2 = S::select_le(
                lit(0.0009765625) * diagonal_e2,
                -pivot_e2,
                safe_e1,
                lit(0.0),
            );
            let right_e2 = right_e1
                .neg_mul_add(
                    e2_by_e1,
                    right_e0
                        .neg_mul_add(
                            e2_by_e0,
                            lit(8.0)
                                * (dot_e1 * i3)
                                    .neg_mul_add(
                                        acceleration_0_part_3,
                                        (dot_e0 * i2)
                                            .mul_add(
                                                acceleration_0_part_2,
                                                dot_e3 * i1 * acceleration_0_part,
                                            ),
                                    ),
                        ),
                );
            let acceleration_0_part_8 = lit(4.0)
                * (e0 * e3).neg_mul_add(i3, (e1 * e2).neg_mul_add(i2, e1 * e2 * i1));
            let e3_by_e0 = acceleration_0_part_8 * per_pivot_e0;
            let acceleration_0_part_9 = lit(4.0)
                * (e0 * e2).neg_mul_add(i3, (e1 * e3).mul_add(i2, e0 * e2 * i1));
            let acceleration_0_part_10 = acceleration_0_part_4 * e3_by_e0
                - acceleration_0_part_9;
            let e3_by_e1 = acceleration_0_part_10 * per_pivot_e1;
            let acceleration_0_part_11 = lit(4.0)
                * (e1 * e0).mul_add(i3, (e1 * e0).neg_mul_add(i2, e3 * e2 * i1));
            let acceleration_0_part_12 = acceleration_0_part_7
                .neg_mul_add(
                    e3_by_e1,
                    acceleration_0_part_5 * e3_by_e0 - acceleration_0_part_11,
                );
            let e3_by_e2 = acceleration_0_part_12 * per_pivot_e2;
            let diagonal_e3 = lit(4.0)
                * (e0 * e0).mul_add(i3, (e1 * e1).mul_add(i2, e2 * e2 * i1));
            let pivot_e3 = acceleration_0_part_12
                .neg_mul_add(
                    e3_by_e2,
                    acceleration_0_part_10
                        .neg_mul_add(
                            e3_by_e1,
                            acceleration_0_part_8 * e3_by_e0 - diagonal_e3,
                        ),
                );
            let per_pivot_e3 = pivot_e3.recip();
            let safe_e3 = S::select_le(
                lit(0.0009765625) * diagonal_e3,
                -pivot_e3,
                safe_e2,
                lit(0.0),
            );
            let right_e3 = right_e2
                .neg_mul_add(
                    e3_by_e2,
                    right_e1
                        .neg_mul_add(
                            e3_by_e1,
                            right_e0
                                .neg_mul_add(
                                    e3_by_e0,
                                    lit(8.0)
                                        * (dot_e0 * i3)
                                            .neg_mul_add(
                                                acceleration_0_part_3,
                                                (dot_e1 * i2)
                                                    .neg_mul_add(
                                                        acceleration_0_part_2,
                                                        dot_e2 * i1 * acceleration_0_part,
                                                    ),
                                            ),
                                ),
                        ),
                );
            let unit_by_e0 = e0 * per_pivot_e0;
            let acceleration_0_part_13 = acceleration_0_part_4.mul_add(unit_by_e0, e1);
            let unit_by_e1 = acceleration_0_part_13 * per_pivot_e1;
            let acceleration_0_part_14 = acceleration_0_part_7
                .neg_mul_add(unit_by_e1, acceleration_0_part_5.mul_add(unit_by_e0, e2));
            let unit_by_e2 = acceleration_0_part_14 * per_pivot_e2;
            let acceleration_0_part_15 = acceleration_0_part_12
                .mul_add(
                    unit_by_e2,
                    acceleration_0_part_10
                        .mul_add(
                            unit_by_e1,
                            acceleration_0_part_8.neg_mul_add(unit_by_e0, e3),
                        ),
                );
            let pivot_unit = (acceleration_0_part_15 * acceleration_0_part_15)
                .neg_mul_add(
                    per_pivot_e3,
                    acceleration_0_part_14
                        .neg_mul_add(
                            unit_by_e2,
                            acceleration_0_part_13
                                .neg_mul_add(unit_by_e1, e0 * unit_by_e0),
                        ),
                );
            let per_pivot_unit = pivot_unit.recip();
            let safe_unit = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_unit,
                safe_e3,
                lit(0.0),
            );
            let right_unit = (right_e3 * acceleration_0_part_15)
                .mul_add(
                    per_pivot_e3,
                    right_e2
                        .neg_mul_add(
                            unit_by_e2,
                            right_e1
                                .neg_mul_add(
                                    unit_by_e1,
                                    right_e0
                                        .neg_mul_add(
                                            unit_by_e0,
                                            dot_e3
                                                .mul_add(
                                                    dot_e3,
                                                    dot_e2
                                                        .mul_add(dot_e2, dot_e1.mul_add(dot_e1, dot_e0 * dot_e0)),
                                                ),
                                        ),
                                ),
                        ),
                );
            let safe = safe_unit;
            let safe_part = (acceleration_0_part_15 * per_pivot_e3 * right_unit)
                .mul_add(per_pivot_unit, right_e3 * per_pivot_e3);
            out[3] = safe_part;
            let safe_part_2 = e3_by_e2
                .neg_mul_add(
                    safe_part,
                    (unit_by_e2 * right_unit)
                        .neg_mul_add(per_pivot_unit, right_e2 * per_pivot_e2),
                );
            out[2] = -safe_part_2;
            let acceleration_3_part = e2_by_e1
                .neg_mul_add(
                    safe_part_2,
                    e3_by_e1
                        .neg_mul_add(
                            safe_part,
                            (unit_by_e1 * right_unit)
                                .neg_mul_add(per_pivot_unit, right_e1 * per_pivot_e1),
                        ),
                );
            out[1] = -acceleration_3_part;
            out[0] = e1_by_e0
                .neg_mul_add(
                    acceleration_3_part,
                    e2_by_e0
                        .neg_mul_add(
                            safe_part_2,
                            e3_by_e0
                                .neg_mul_add(
                                    safe_part,
                                    (unit_by_e0 * right_unit)
                                        .neg_mul_add(per_pivot_unit, -(right_e0 * per_pivot_e0)),
                                ),
                        ),
                );
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
            let [i1, i2, i3, _, _, _] = *ukcore::emitted::exact::<
                S,
                6,
            >(prepared, "prepared");
            let [e0, e1, e2, e3] = *ukcore::emitted::exact::<S, 4>(q, "q");
            let [residual_0] = *ukcore::emitted::exact::<S, 1>(residual, "residual");
            let lit = S::from_f64;
            let pivot_e0 = lit(4.0)
                * (e3 * e3).mul_add(i3, (e2 * e2).mul_add(i2, e1 * e1 * i1));
            let per_pivot_e0 = pivot_e0.recip();
            let safe_e0 = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_e0,
                lit(1.0),
                lit(0.0),
            );
            let correction_0_part = lit(4.0)
                * (e3 * e2).mul_add(i3, (e3 * e2).neg_mul_add(i2, e1 * e0 * i1));
            let e1_by_e0 = correction_0_part * per_pivot_e0;
            let diagonal_e1 = lit(4.0)
                * (e2 * e2).mul_add(i3, (e3 * e3).mul_add(i2, e0 * e0 * i1));
            let pivot_e1 = correction_0_part * e1_by_e0 - diagonal_e1;
            let per_pivot_e1 = pivot_e1.recip();
            let safe_e1 = S::select_le(
                lit(0.0009765625) * diagonal_e1,
                -pivot_e1,
                safe_e0,
                lit(0.0),
            );
            let correction_0_part_2 = lit(4.0)
                * (e1 * e3).neg_mul_add(i3, (e0 * e2).mul_add(i2, e1 * e3 * i1));
            let e2_by_e0 = correction_0_part_2 * per_pivot_e0;
            let correction_0_part_3 = lit(4.0)
                * (e1 * e2).neg_mul_add(i3, (e0 * e3).neg_mul_add(i2, e0 * e3 * i1));
            let correction_0_part_4 = correction_0_part * e2_by_e0 - correction_0_part_3;
            let e2_by_e1 = correction_0_part_4 * per_pivot_e1;
            let diagonal_e2 = lit(4.0)
                * (e1 * e1).mul_add(i3, (e0 * e0).mul_add(i2, e3 * e3 * i1));
            let pivot_e2 = correction_0_part_4
                .neg_mul_add(e2_by_e1, correction_0_part_2 * e2_by_e0 - diagonal_e2);
            let per_pivot_e2 = pivot_e2.recip();
            let safe_e2 = S::select_le(
                lit(0.0009765625) * diagonal_e2,
                -pivot_e2,
                safe_e1,
                lit(0.0),
            );
            let correction_0_part_5 = lit(4.0)
                * (e0 * e3).neg_mul_add(i3, (e1 * e2).neg_mul_add(i2, e1 * e2 * i1));
            let e3_by_e0 = correction_0_part_5 * per_pivot_e0;
            let correction_0_part_6 = lit(4.0)
                * (e0 * e2).neg_mul_add(i3, (e1 * e3).mul_add(i2, e0 * e2 * i1));
            let correction_0_part_7 = correction_0_part * e3_by_e0 - correction_0_part_6;
            let e3_by_e1 = correction_0_part_7 * per_pivot_e1;
            let correction_0_part_8 = lit(4.0)
                * (e1 * e0).mul_add(i3, (e1 * e0).neg_mul_add(i2, e3 * e2 * i1));
            let correction_0_part_9 = correction_0_part_4
                .neg_mul_add(
                    e3_by_e1,
                    correction_0_part_2 * e3_by_e0 - correction_0_part_8,
                );
            let e3_by_e2 = correction_0_part_9 * per_pivot_e2;
            let diagonal_e3 = lit(4.0)
                * (e0 * e0).mul_add(i3, (e1 * e1).mul_add(i2, e2 * e2 * i1));
            let pivot_e3 = correction_0_part_9
                .neg_mul_add(
                    e3_by_e2,
                    correction_0_part_7
                        .neg_mul_add(
                            e3_by_e1,
                            correction_0_part_5 * e3_by_e0 - diagonal_e3,
                        ),
                );
            let per_pivot_e3 = pivot_e3.recip();
            let safe_e3 = S::select_le(
                lit(0.0009765625) * diagonal_e3,
                -pivot_e3,
                safe_e2,
                lit(0.0),
            );
            let unit_by_e0 = e0 * per_pivot_e0;
            let correction_0_part_10 = correction_0_part.mul_add(unit_by_e0, e1);
            let unit_by_e1 = correction_0_part_10 * per_pivot_e1;
            let correction_0_part_11 = correction_0_part_4
                .neg_mul_add(unit_by_e1, correction_0_part_2.mul_add(unit_by_e0, e2));
            let unit_by_e2 = correction_0_part_11 * per_pivot_e2;
            let correction_0_part_12 = correction_0_part_9
                .mul_add(
                    unit_by_e2,
                    correction_0_part_7
                        .mul_add(
                            unit_by_e1,
                            correction_0_part_5.neg_mul_add(unit_by_e0, e3),
                        ),
                );
            let pivot_unit = (correction_0_part_12 * correction_0_part_12)
                .neg_mul_add(
                    per_pivot_e3,
                    correction_0_part_11
                        .neg_mul_add(
                            unit_by_e2,
                            correction_0_part_10.neg_mul_add(unit_by_e1, e0 * unit_by_e0),
                        ),
                );
            let per_pivot_unit = pivot_unit.recip();
            let safe_unit = S::select_le(
                lit(2.2250738585072014e-308),
                pivot_unit,
                safe_e3,
                lit(0.0),
            );
            let right_unit = lit(0.5) * residual_0;
            let safe = safe_unit;
            out[3] = right_unit * correction_0_part_12 * per_pivot_e3 * per_pivot_unit;
            let safe_part = (right_unit * unit_by_e2)
                .mul_add(
                    per_pivot_unit,
                    right_unit * e3_by_e2 * correction_0_part_12 * per_pivot_e3
                        * per_pivot_unit,
                );
            out[2] = safe_part;
            let correction_3_part = (right_unit * unit_by_e1)
                .neg_mul_add(
                    per_pivot_unit,
                    (right_unit * e3_by_e1 * correction_0_part_12 * per_pivot_e3)
                        .neg_mul_add(per_pivot_unit, e2_by_e1 * safe_part),
                );
            out[1] = -correction_3_part;
            out[0] = e1_by_e0
                .neg_mul_add(
                    correction_3_part,
                    (right_unit * unit_by_e0)
                        .neg_mul_add(
                            per_pivot_unit,
                            (right_unit * e3_by_e0 * correction_0_part_12 * per_pivot_e3)
                                .neg_mul_add(per_pivot_unit, e2_by_e0 * safe_part),
                        ),
                );
            safe
        }
    }
};
