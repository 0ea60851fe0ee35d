//! Which constraints count.

use super::*;

#[test]
fn duplicates_are_redundant_at_any_scale() {
    for scale in [1e-12, 1e-6, 1.0, -3.0, 1e6, 1e12] {
        let mech = Twice {
            params: vec![1.0, 2.0, scale, 0.0],
        };
        let (q, v) = consistent(&mech, 0.0, &[0.6, -0.8, 1.2, -1.6], &[1.0, 0.0, 0.5, 0.5]);
        for off in [0.0, 1e-9, 1e-3, 0.1] {
            let q: Vec<f64> = q
                .iter()
                .zip([1.0, -0.3, 0.2, 0.9])
                .map(|(q, d)| q + off * d)
                .collect();
            let solution = solver(&mech, Formula::Auto).solve(0.0, &q, &v).unwrap();
            assert_eq!(
                (
                    solution.rank,
                    solution.degrees_of_freedom,
                    &solution.redundant[..]
                ),
                (3 - 1, 2, &[2][..])
            );
            // Least norm: the force is shared as 1 : scale.
            let l = &solution.multipliers;
            let skew = (l[2] - scale * l[1]).abs() / scale.hypot(1.0);
            assert!(
                skew <= 1e-12 * l[0].abs() && l[1].hypot(l[2]) > 0.0,
                "{l:?}"
            );
        }
    }
}

#[test]
fn constraint_scaling_changes_nothing() {
    let state = consistent(
        &Parallelogram::default(),
        0.0,
        &[0.6, 0.8, 2.6, 0.8],
        &[0.8, -0.6, 0.8, -0.6],
    );
    let mut reference = vec![0.0; 4];
    for (i, scale) in [1.0, 1e-12, 1e12].into_iter().enumerate() {
        let mech = Parallelogram {
            params: vec![scale, 1.0],
        };
        let mut solver = solver(&mech, Formula::Auto);
        let solution = solver.solve(0.0, &state.0, &state.1).unwrap();
        assert_eq!((solution.rank, solution.degrees_of_freedom), (3, 1));
        if i == 0 {
            reference.clone_from(&solution.acceleration);
        }
        close(
            &solution.acceleration,
            &reference,
            1e-12,
            "scaled constraint",
        );
    }
}

#[test]
fn sets_redundant_only_on_the_manifold_survive_drift() {
    let mech = Parallelogram::default();
    let mut next = numbers(3);
    for angle in [0.3_f64, 0.9, 1.4, 2.2, -0.7] {
        let (s, c) = angle.sin_cos();
        let omega = 1.3;
        let q = [c, s, 2.0 + c, s];
        let v = [-omega * s, omega * c, -omega * s, omega * c];
        // Crank: weights at the ends of both arms, no inertia otherwise: θ̈ = −g cos θ.
        let alpha = -9.8 * c;
        let exact = [
            -alpha * s - omega * omega * c,
            alpha * c - omega * omega * s,
        ];
        for exponent in 3..=16 {
            let delta = 10_f64.powi(-exponent);
            for formula in [Formula::Auto, Formula::UdwadiaPhohomsiri, Formula::Kkt] {
                let mut solver = solver(&mech, formula);
                for _ in 0..20 {
                    let off =
                        |x: &[f64; 4], next: &mut dyn FnMut() -> f64| x.map(|x| x + delta * next());
                    let (q, v) = (off(&q, &mut next), off(&v, &mut next));
                    let mut out = [0.0; 4];
                    solver.acceleration(0.0, &q, &v, &mut out).unwrap();
                    let expected = [exact[0], exact[1], exact[0], exact[1]];
                    close(
                        &out,
                        &expected,
                        30.0 * delta + 1e-9,
                        &format!("at {angle}, off by {delta:e}"),
                    );
                }
            }
        }
    }
}

#[test]
fn mass_ratios_do_not_cost_constraints() {
    for exponent in [-12, -6, 6, 12] {
        let mech = Twice {
            params: vec![10_f64.powi(exponent), 1.0, 1.0, 0.0],
        };
        for formula in [Formula::Auto, Formula::UdwadiaPhohomsiri] {
            let (q, v) = consistent(&mech, 0.0, &[0.6, -0.8, 1.4, -1.4], &[1.0, 0.0, 0.5, 0.5]);
            let solution = solver(&mech, formula).solve(0.0, &q, &v).unwrap();
            assert_eq!(
                (solution.rank, &solution.redundant[..]),
                (2, &[2][..]),
                "1e{exponent} {formula:?}"
            );
            let p = printed(&mech, 0.0, &q, &v);
            let x = DVector::from_column_slice(&solution.acceleration);
            close(
                (&p.jacobian * x).as_slice(),
                p.rhs.as_slice(),
                1e-9,
                "A q̈ = b",
            );
        }
    }
}
