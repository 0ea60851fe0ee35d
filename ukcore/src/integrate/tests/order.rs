//! One step after the other, of given sizes.

use super::*;
use crate::integrate::stepper::{Rates, Stepper};
use crate::scalar::{Dual, Scalar};

/// y₀' = y₀ cos t, y₁' = −2 t y₁², from (1, 1).
struct Smooth;

impl<S: Scalar> Rates<S> for Smooth {
    type Error = ();

    fn rate(&mut self, t: S, y: &[S], rate: &mut [S]) -> Result<(), ()> {
        rate[0] = y[0] * t.cos();
        rate[1] = -(t + t) * y[1] * y[1];
        Ok(())
    }
}

fn exact(t: f64) -> [f64; 2] {
    [t.sin().exp(), 1.0 / (1.0 + t * t)]
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |d, (a, b)| d.max((a - b).abs()))
}

fn stepper<S: Scalar>(method: Method, y: &[S]) -> Stepper<S> {
    let tolerance = Tolerance {
        relative: 1e-9,
        floors: vec![S::from_f64(1.0); y.len()],
    };
    if method == Method::Dop853 {
        Stepper::dop853(y.to_vec(), tolerance)
    } else {
        Stepper::dopri5(y.to_vec(), tolerance)
    }
}

/// `steps` steps of size h from (t, y).
fn march<S: Scalar>(method: Method, t: S, h: S, y: &mut [S], steps: usize) {
    let mut stepper = stepper(method, y);
    stepper.begin(&mut Smooth, t, |new, _| new).unwrap();
    let mut t = t;
    for _ in 0..steps {
        stepper.attempt(&mut Smooth, t, h).unwrap();
        t = t + h;
        stepper.close(&mut Smooth, t, h).unwrap();
        stepper.advance(|new, _| new);
    }
    y.copy_from_slice(stepper.states()[0]);
}

#[test]
fn steps_converge_with_their_order() {
    for (method, order, steps) in [(Method::Dop853, 8.0, 12), (Method::Dopri5, 5.0, 40)] {
        for end in [3.0, -3.0] {
            let error = |steps: usize| {
                let mut y = exact(0.0);
                march(method, 0.0, end / steps as f64, &mut y, steps);
                distance(&y, &exact(end))
            };
            let observed = (error(steps) / error(2 * steps)).log2();
            assert!((observed - order).abs() < 0.75, "{method:?}: {observed}");
        }
    }
}

#[test]
fn interpolants_and_estimates_converge_with_their_order() {
    // Local errors, so one power more than the interpolant has; DOP853 makes an estimate of order 7 of those of order 5 and 3.
    for (method, order, estimated) in [(Method::Dop853, 8.0, 8.0), (Method::Dopri5, 5.0, 5.0)] {
        for direction in [1.0, -1.0] {
            let run = |h: f64| {
                let (t, y) = (0.4, exact(0.4));
                let mut stepper = stepper(method, &y);
                stepper.begin(&mut Smooth, t, |new, _| new).unwrap();
                let early = stepper.attempt(&mut Smooth, t, h).unwrap();
                let estimate = early + stepper.close(&mut Smooth, t + h, h).unwrap();
                stepper.interpolate(&mut Smooth, t, h).unwrap();
                let mut largest = 0.0_f64;
                for theta in [0.15, 0.3, 0.45, 0.6, 0.75, 0.9] {
                    let mut between = [0.0; 2];
                    crate::integrate::dense::interpolate(theta, stepper.dense(), &mut between);
                    largest = largest.max(distance(&between, &exact(t + theta * h)));
                }
                (largest, estimate)
            };
            let h = direction * if method == Method::Dop853 { 0.08 } else { 0.04 };
            let ((coarse, coarse_estimate), (fine, fine_estimate)) = (run(h), run(0.5 * h));
            let observed = (coarse / fine).log2();
            assert!((observed - order).abs() < 0.5, "{method:?}: {observed}");
            let observed = (coarse_estimate / fine_estimate).log2();
            assert!(
                (observed - estimated).abs() < 0.5,
                "{method:?}: estimate {observed}"
            );
        }
    }
}

#[test]
fn a_step_of_other_scalars_is_the_same_step_in_each_of_their_parts() {
    for method in EXPLICIT {
        let (t, h) = (0.1, 0.07);
        let mut y = exact(t);
        march(method, t, h, &mut y, 20);
        let mut dual = exact(t).map(|y| Dual::new(y, 0.0));
        dual[0].eps = 1.0;
        march(method, Dual::from_f64(t), Dual::from_f64(h), &mut dual, 20);
        assert_eq!(dual.map(|y| y.re), y);
        // y₀ is proportional to its start.
        let slope = exact(t + 20.0 * h)[0] / exact(t)[0];
        assert!((dual[0].eps - slope).abs() < 1e-8 && dual[1].eps == 0.0);
    }
}
