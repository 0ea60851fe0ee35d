use nalgebra::{DMatrix, DVector};

use super::*;
use crate::equations::{kkt, uk, up};
use crate::fixture::*;
use crate::manifold::Projector;
use crate::mechanism::Mechanism;

mod failures;
mod rank;

const TOLERANCE: f64 = 1e-11;

/// M, Q, c, A, b as dense matrices.
struct Printed {
    mass: DMatrix<f64>,
    force: DVector<f64>,
    nonideal: DVector<f64>,
    jacobian: DMatrix<f64>,
    rhs: DVector<f64>,
}

fn printed<M: Mechanism>(mech: &M, t: f64, q: &[f64], v: &[f64]) -> Printed {
    let (n, m) = (M::SPEC.n(), M::SPEC.m());
    let mut terms = Evaluated::new(n, m);
    terms.dynamics(&mech.prepared(), t, q, v);
    Printed {
        mass: DMatrix::from_column_slice(n, n, &terms.mass),
        force: DVector::from_vec(terms.force),
        nonideal: DVector::from_vec(terms.nonideal),
        jacobian: DMatrix::from_column_slice(m, n, &terms.jacobian),
        rhs: DVector::from_vec(terms.rhs),
    }
}

fn solver(mech: &impl Mechanism, formula: Formula) -> Solver {
    Solver::new(
        mech,
        SolverOptions {
            formula,
            ..SolverOptions::default()
        },
    )
}

/// A consistent state near (q, v).
fn consistent<M: Mechanism>(mech: &M, t: f64, q: &[f64], v: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut q, mut v) = (q.to_vec(), v.to_vec());
    let mut projector = Projector::new(mech);
    projector.position(t, &mut q, &v).unwrap();
    projector.velocity(t, &q, &mut v).unwrap();
    (q, v)
}

fn close(a: &[f64], b: &[f64], relative: f64, what: &str) {
    let size = b.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() <= relative * size, "{what}: {a} is not {b}");
    }
}

/// Every path gives the same acceleration and forces, and these obey the principles of mechanics.
fn agree<M: Mechanism>(mech: &M, t: f64, q: &[f64], v: &[f64]) -> Solution {
    let (q, v) = consistent(mech, t, q, v);
    let p = printed(mech, t, &q, &v);
    let solution = solver(mech, Formula::Auto).solve(t, &q, &v).unwrap();
    let total = &p.force + &p.nonideal;
    let oracle = up::acceleration(&p.mass, &total, &p.jacobian, &p.rhs, TOLERANCE).unwrap();
    close(&solution.acceleration, oracle.as_slice(), 1e-9, "eq. 19");
    if p.mass.clone().symmetric_eigenvalues().min() > 1e-9 {
        let (c, tol) = (&p.nonideal, TOLERANCE);
        let x = uk::acceleration_nonideal(&p.mass, &p.force, c, &p.jacobian, &p.rhs, tol).unwrap();
        close(&solution.acceleration, x.as_slice(), 1e-9, "eq. 13");
        let ideal = uk::ideal_force(&p.mass, &p.force, &p.jacobian, &p.rhs, tol).unwrap();
        close(&solution.ideal_force, ideal.as_slice(), 1e-9, "eq. 11");
        let nonideal = uk::nonideal_force(&p.mass, c, &p.jacobian, tol).unwrap();
        close(
            &solution.nonideal_force,
            nonideal.as_slice(),
            1e-9,
            "eq. 12",
        );
        if c.amax() == 0.0 {
            let x = uk::acceleration(&p.mass, &p.force, &p.jacobian, &p.rhs, tol).unwrap();
            close(&solution.acceleration, x.as_slice(), 1e-9, "eq. 15");
        }
        let m = p.mass[(0, 0)];
        if p.mass == DMatrix::identity(p.mass.nrows(), p.mass.nrows()) * m {
            let force = uk::equal_masses(m, &p.force, &p.jacobian, &p.rhs, tol);
            close(&solution.ideal_force, force.as_slice(), 1e-9, "eq. 17");
        }
    }
    let formulas: &[Formula] = match M::SPEC.structure.massless {
        [] => &[Formula::UdwadiaPhohomsiri, Formula::Kkt, Formula::Auto],
        _ => &[Formula::UdwadiaPhohomsiri, Formula::Kkt],
    };
    for formula in formulas {
        let mut other = solver(mech, *formula);
        let mut out = vec![f64::NAN; q.len()];
        other.acceleration(t, &q, &v, &mut out).unwrap();
        close(&out, &solution.acceleration, 1e-9, "acceleration()");
        let other = other.solve(t, &q, &v).unwrap();
        close(
            &other.acceleration,
            &solution.acceleration,
            1e-9,
            "another formula",
        );
        close(
            &other.ideal_force,
            &solution.ideal_force,
            1e-9,
            "another formula's force",
        );
        close(
            &other.multipliers,
            &solution.multipliers,
            1e-9,
            "another formula's multipliers",
        );
        assert_eq!(
            (other.rank, &other.redundant),
            (solution.rank, &solution.redundant)
        );
    }
    if solution.redundant.is_empty() {
        let (x, lambda) = kkt::solve(&p.mass, &total, &p.jacobian, &p.rhs).unwrap();
        close(
            x.as_slice(),
            &solution.acceleration,
            1e-9,
            "dense saddle point",
        );
        if p.nonideal.amax() == 0.0 {
            close(
                lambda.as_slice(),
                &solution.multipliers,
                1e-9,
                "multipliers",
            );
        }
    }
    mechanics(&p, &solution);
    solution
}

/// Newton's law, the constraints, no virtual work, Aᵀλ, and Gauss's principle.
fn mechanics(p: &Printed, s: &Solution) {
    let n = p.force.len();
    let x = DVector::from_column_slice(&s.acceleration);
    let ideal = DVector::from_column_slice(&s.ideal_force);
    let nonideal = DVector::from_column_slice(&s.nonideal_force);
    let balance = &p.mass * &x - (&p.force + &ideal + &nonideal);
    close(balance.as_slice(), &vec![0.0; n], 1e-9, "M q̈ = Q + Qc");
    close(
        (&p.jacobian * &x).as_slice(),
        p.rhs.as_slice(),
        1e-9,
        "A q̈ = b",
    );
    let lambda = DVector::from_column_slice(&s.multipliers);
    close(
        (p.jacobian.transpose() * lambda).as_slice(),
        &s.ideal_force,
        1e-9,
        "Qc = Aᵀλ",
    );
    let (a_plus, rank) = crate::pinv::pseudo_inverse(&p.jacobian, TOLERANCE);
    assert_eq!((rank, n - rank), (s.rank, s.degrees_of_freedom));
    let virtuals = DMatrix::identity(n, n) - a_plus * &p.jacobian;
    close(
        (&virtuals * &ideal).as_slice(),
        &vec![0.0; n],
        1e-9,
        "virtual work",
    );
    // Gauss: with Q + c as the given force, (q̈ − a)ᵀ M (q̈ − a) is least among all accelerations the constraints allow.
    let given = &p.force + &p.nonideal;
    let zwang = |x: &DVector<f64>| (x.transpose() * &p.mass * x)[0] - 2.0 * given.dot(x);
    let least = zwang(&x);
    let mut next = numbers(7);
    for _ in 0..10 {
        let other = &x + &virtuals * DVector::from_fn(n, |_, _| next());
        assert!(
            zwang(&other) >= least - 1e-9 * least.abs().max(1.0),
            "Gauss's principle"
        );
    }
}

#[test]
fn all_paths_agree_and_obey_mechanics() {
    agree(&Pendulum::default(), 0.0, &[0.6, -0.8], &[0.4, 0.3]);
    agree(
        &Twice::default(),
        0.0,
        &[0.6, -0.8, 1.2, -1.6],
        &[1.0, 0.0, 0.5, 0.5],
    );
    agree(
        &Parallelogram::default(),
        0.0,
        &[0.6, 0.8, 2.6, 0.8],
        &[0.8, -0.6, 0.8, -0.6],
    );
    agree(&Springs::default(), 0.0, &[1.0, 0.5], &[0.1, 0.0]);
    agree(&Prescribed::default(), 0.7, &[0.6, 0.0], &[0.0, 1.0]);
    agree(&Skate::default(), 0.0, &[0.0, 0.0, 0.4], &[1.5, 0.5, 0.3]);
    agree(
        &Quaternion::default(),
        0.0,
        &[0.5, 0.6, -0.3, 0.5],
        &[1.0, -2.0, 0.5, 0.2],
    );
}

#[test]
fn pendulum_tension_and_acceleration() {
    let (s, c) = (0.6_f64, 0.8_f64);
    let omega = 1.7;
    let mech = Pendulum::default();
    let (q, v) = ([s, -c], [omega * c, omega * s]);
    let solution = solver(&mech, Formula::Auto).solve(0.0, &q, &v).unwrap();
    // θ̈ = −g sin θ; tension m (g cos θ + ω²) along the rod.
    let alpha = -9.8 * s;
    let expected = [alpha * c - omega * omega * s, alpha * s + omega * omega * c];
    close(&solution.acceleration, &expected, 1e-14, "acceleration");
    let tension = 9.8 * c + omega * omega;
    close(
        &solution.ideal_force,
        &[-tension * s, tension * c],
        1e-14,
        "tension",
    );
    assert_eq!(solution.formula, Formula::UdwadiaKalaba);
    assert_eq!((solution.rank, solution.degrees_of_freedom), (1, 1));
    assert!(solution.redundant.is_empty());
}

#[test]
fn without_force_and_with_equal_masses() {
    // Eq. 18: no gravity, so only the centripetal force remains.
    let mech = Pendulum {
        params: vec![3.0, 1.0, 0.0],
    };
    let (q, v) = ([0.6, -0.8], [1.6, 1.2]);
    let p = printed(&mech, 0.0, &q, &v);
    let force = uk::equal_masses_free(3.0, &p.jacobian, &p.rhs, TOLERANCE);
    let solution = solver(&mech, Formula::Auto).solve(0.0, &q, &v).unwrap();
    close(&solution.ideal_force, force.as_slice(), 1e-14, "eq. 18");
    close(
        force.as_slice(),
        &[-3.0 * 4.0 * 0.6, 3.0 * 4.0 * 0.8],
        1e-14,
        "m v²/l",
    );
}

#[test]
fn singular_matrices_give_no_answer_in_the_printed_formulas() {
    let p = printed(&Springs::default(), 0.0, &[1.0, 0.5], &[0.0; 2]);
    assert_eq!(
        uk::acceleration(&p.mass, &p.force, &p.jacobian, &p.rhs, TOLERANCE),
        None
    );
    let p = printed(&Loose::default(), 0.0, &[0.0; 3], &[0.0; 3]);
    assert_eq!(
        up::acceleration(&p.mass, &p.force, &p.jacobian, &p.rhs, TOLERANCE),
        None
    );
    assert_eq!(kkt::solve(&p.mass, &p.force, &p.jacobian, &p.rhs), None);
}

#[test]
fn springs_in_series_act_as_one() {
    let mech = Springs::default();
    let k = 3.0 * 5.0 / 8.0;
    let solution = agree(&mech, 0.0, &[1.0, 5.0 / 8.0], &[0.0, 0.0]);
    assert!((solution.acceleration[0] + k / 2.0).abs() < 1e-14);
    assert_eq!(solution.formula, Formula::UdwadiaPhohomsiri);
    // Mass → 0⁺ tends to that.
    for light in [1e-3, 1e-6, 1e-12, 1e-18, 1e-30, 1e-200] {
        let mech = Springs {
            params: vec![2.0, light, 3.0, 5.0],
        };
        let solution = agree(&mech, 0.0, &[1.0, 5.0 / 8.0], &[0.0, 0.0]);
        assert!((solution.acceleration[0] + k / 2.0).abs() < light + 1e-14);
    }
}

#[test]
fn a_mass_that_vanishes_at_run_time() {
    let mech = Prescribed { params: vec![0.0] };
    let mut solver = solver(&mech, Formula::Auto);
    let mut out = [0.0; 2];
    solver
        .acceleration(0.5, &[0.5_f64.sin(), 0.0], &[0.5_f64.cos(), 0.0], &mut out)
        .unwrap();
    close(&out, &[-(0.5_f64.sin()), 3.0], 1e-15, "prescribed");
    assert_eq!(solver.work().fallbacks, 1);
    let pendulum = Pendulum {
        params: vec![0.0, 1.0, 9.8],
    };
    let result =
        Solver::new(&pendulum, SolverOptions::default()).solve(0.0, &[1.0, 0.0], &[0.0; 2]);
    assert!(
        matches!(&result, Err(Error::Underdetermined { coordinates, .. }) if coordinates == &["y"]),
        "{result:?}"
    );
    let negative = Pendulum {
        params: vec![-1.0, 1.0, 9.8],
    };
    let result =
        Solver::new(&negative, SolverOptions::default()).solve(0.0, &[1.0, 0.0], &[0.0; 2]);
    assert_eq!(
        result,
        Err(Error::IndefiniteMass {
            coordinates: vec!["x".into()]
        })
    );
}

#[test]
fn a_quaternion_body_obeys_eulers_equations() {
    let mech = Quaternion::default();
    let (q, v) = consistent(&mech, 0.0, &[0.5, 0.6, -0.3, 0.5], &[1.0, -2.0, 0.5, 0.2]);
    let mut solver = solver(&mech, Formula::Auto);
    let solution = solver.solve(0.0, &q, &v).unwrap();
    assert_eq!(solution.formula, Formula::UdwadiaPhohomsiri);
    assert_eq!(solver.work().fallbacks, 1);
    // ω = 2 G(e) ė, ω̇ = 2 G(e) ë (G(ė) ė = 0); J ω̇ = J ω × ω.
    let g = |e: &[f64], x: &[f64]| {
        [
            2.0 * (-e[1] * x[0] + e[0] * x[1] + e[3] * x[2] - e[2] * x[3]),
            2.0 * (-e[2] * x[0] - e[3] * x[1] + e[0] * x[2] + e[1] * x[3]),
            2.0 * (-e[3] * x[0] + e[2] * x[1] - e[1] * x[2] + e[0] * x[3]),
        ]
    };
    let (w, dw) = (g(&q, &v), g(&q, &solution.acceleration));
    let j = [1.0, 2.0, 4.0];
    for i in 0..3 {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        assert!((j[i] * dw[i] - (j[a] - j[b]) * w[a] * w[b]).abs() < 1e-12);
    }
}

#[test]
fn baumgarte_feeds_the_residuals_back() {
    let mech = Pendulum::default();
    let baumgarte = Some(Baumgarte {
        alpha: 5.0,
        beta: 7.0,
    });
    let mut solver = Solver::new(
        &mech,
        SolverOptions {
            baumgarte,
            ..SolverOptions::default()
        },
    );
    let (q, v) = ([0.61, -0.83], [0.4, 0.5]);
    let mut out = [0.0; 2];
    for _ in 0..2 {
        solver.acceleration(0.0, &q, &v, &mut out).unwrap();
        let second = 2.0 * (q[0] * out[0] + q[1] * out[1] + v[0] * v[0] + v[1] * v[1]);
        let first = 2.0 * (q[0] * v[0] + q[1] * v[1]);
        let phi = q[0] * q[0] + q[1] * q[1] - 1.0;
        assert!((second + 10.0 * first + 49.0 * phi).abs() < 1e-13);
    }
}
