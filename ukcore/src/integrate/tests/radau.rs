//! The implicit method: its coefficients, its order, stiff problems.

use super::*;
use crate::integrate::course::Course;
use crate::integrate::radau::newton::{A, PAIR, REAL, T, T_INVERSE};
use crate::integrate::radau::{C, Radau};
use crate::integrate::scheme::{Equations, Scheme};
use crate::integrate::switches::Switches;
use approx::assert_abs_diff_eq;

type Matrix = [[f64; 3]; 3];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let entry = |i: usize, j: usize| (0..3).map(|k| a[i][k] * b[k][j]).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

fn assert_close(a: &Matrix, b: &Matrix) {
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        assert!((a - b).abs() < 2e-15, "{a} is not {b}");
    }
}

#[test]
fn coefficients_are_those_of_collocation_at_the_radau_points() {
    for (row, c) in A.iter().zip(C) {
        for power in 1..=3 {
            let sum: f64 = row.iter().zip(C).map(|(a, c)| a * c.powi(power - 1)).sum();
            assert_abs_diff_eq!(sum, c.powi(power) / f64::from(power), epsilon = 4e-16);
        }
    }
    // The last stage is the end, whose quadrature is exact to order 5.
    for power in 1..=5 {
        let sum: f64 = A[2].iter().zip(C).map(|(b, c)| b * c.powi(power - 1)).sum();
        assert!((sum - 1.0 / f64::from(power)).abs() < 1e-15, "{power}");
    }
    let unit = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    assert_close(&product(&T, &T_INVERSE), &unit);
    let diagonal = [
        [REAL, 0.0, 0.0],
        [0.0, PAIR.re, -PAIR.im],
        [0.0, PAIR.im, PAIR.re],
    ];
    assert_close(&product(&A, &T), &product(&T, &diagonal));
}

/// q̈ = −2 q³ + sin t q̇, smooth and not linear.
fn smooth(t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Error> {
    rate.copy_from_slice(&[y[1], -2.0 * y[0].powi(3) + t.sin() * y[1]]);
    Ok(())
}

#[test]
fn steps_estimates_and_interpolants_have_their_order() {
    let start = [0.8, 0.5];
    let exact = |t: f64| {
        let mut plain = Plain::new(smooth);
        Method::Dop853.run(&mut plain, 0.3, &start, 0.3 + t, &settings(1e-14));
        plain.steps.pop().unwrap().2
    };
    let distance = |a: &[f64], b: &[f64]| f64::hypot(a[0] - b[0], a[1] - b[1]);
    for direction in [1.0, -1.0] {
        // Errors of a single step: end, interpolant, estimate.
        let step = |h: f64| {
            let mut problem = Plain::new(smooth);
            let mut equations = Equations {
                problem: &mut problem,
                switches: Switches::new(0, 2),
                course: Course::new(0.3, 0.3 + h, &settings(1e-12)),
                nearby: false,
                consistent: Vec::new(),
            };
            let mut scheme = Radau::new(&start, both(1e-12));
            let step = equations.course.step(h).unwrap();
            assert!(scheme.begin(&mut equations).is_ok());
            let estimate = scheme.attempt(&mut equations, step);
            assert!(scheme.close(&mut equations, step).is_ok());
            let mut largest = 0.0_f64;
            for theta in [0.1, 0.3, 0.5, 0.8, 0.9] {
                let mut between = [0.0; 2];
                crate::integrate::dense::interpolate(theta, scheme.dense(), &mut between);
                largest = largest.max(distance(&between, &exact(theta * h)));
            }
            [
                distance(scheme.end(), &exact(h)),
                largest,
                estimate.unwrap_or(f64::NAN),
            ]
        };
        let (coarse, fine) = (step(0.2 * direction), step(0.1 * direction));
        for (k, order) in [6.0, 4.0, 4.0].into_iter().enumerate() {
            let observed = (coarse[k] / fine[k]).log2();
            assert!((observed - order).abs() < 0.5, "{k}: {observed}");
        }
    }
}

/// Prothero and Robinson's problem as an oscillator: q follows cos t however hard it is bound to it.
fn bound(stiffness: f64, damping: f64, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Error> {
    let (q, v) = (y[0] - t.cos(), y[1] + t.sin());
    rate.copy_from_slice(&[y[1], -t.cos() - stiffness * q - damping * v]);
    Ok(())
}

#[test]
fn hard_bonds_cost_no_steps() {
    let cases: [Derivative; 4] = [
        |t, y, rate| bound(1e2, 1.0, t, y, rate),
        |t, y, rate| bound(1e8, 0.0, t, y, rate),
        |t, y, rate| bound(1e14, 0.0, t, y, rate),
        |t, y, rate| bound(1e6, 1e8, t, y, rate),
    ];
    for (k, f) in cases.into_iter().enumerate() {
        for t_end in [5.0, -0.1] {
            if t_end < 0.0 && k != 1 && k != 2 {
                // Going backward, damping drives apart.
                continue;
            }
            let mut plain = Plain::new(f);
            let report = Method::Radau5.run(&mut plain, 0.0, &[1.0, 0.0], t_end, &settings(1e-7));
            assert_eq!(report.outcome, Outcome::Reached);
            let (_, t, y) = plain.steps.last().unwrap();
            // Velocities of what is bound hard are slopes of the collocation polynomial, of order 3, and errors of them pass on to no later
            // step.
            assert!(circle_error(*t, y) < 3e-5, "{k}: {y:?}");
            assert!(report.steps < 100, "{k}: {}", report.steps);
            assert!(plain.evaluations.len() < 1000, "{k}");
        }
    }
}

#[test]
fn van_der_pols_oscillator_ends_where_published() {
    // ε q̈ = (1 − q²) q̇ − q with ε = 1e-6: Mazzia & Magherini, Test Set for Initial Value Problem Solvers, problem VDPOL, t = 2.
    let f: Derivative = |_, y, rate| {
        rate.copy_from_slice(&[y[1], ((1.0 - y[0] * y[0]) * y[1] - y[0]) / 1e-6]);
        Ok(())
    };
    let published = [1.706_167_732_170_483, -0.892_809_701_024_797_5];
    for (tolerance, bound, most) in [(1e-6, 1e-5, 5000), (1e-10, 1e-8, 30000)] {
        let mut plain = Plain::new(f);
        let report = Method::Radau5.run(&mut plain, 0.0, &[2.0, 0.0], 2.0, &settings(tolerance));
        assert_eq!(report.outcome, Outcome::Reached);
        let (_, _, y) = plain.steps.last().unwrap();
        let off = f64::hypot(y[0] - published[0], y[1] - published[1]);
        assert!(off < bound, "{tolerance}: {off}");
        assert!(
            plain.evaluations.len() < most,
            "{}",
            plain.evaluations.len()
        );
        assert!(plain.jacobians < report.steps);
        assert!(report.factorisations <= 2 * (report.steps + report.rejected));
    }
}

#[test]
fn rounding_in_stiff_forces_does_not_hold_up_the_iterations() {
    // A force that keeps but its first ten digits: what changes of q below 1e-10 bring about is noise.
    let f: Derivative = |t, y, rate| {
        let mut y = [y[0], y[1]];
        y[0] = (y[0] + 1e6) - 1e6;
        bound(1e10, 0.0, t, &y, rate)
    };
    let mut plain = Plain::new(f);
    let report = Method::Radau5.run(&mut plain, 0.0, &[1.0, 0.0], 5.0, &settings(1e-5));
    assert_eq!(report.outcome, Outcome::Reached);
    assert!(report.steps < 200, "{report:?}");
}
