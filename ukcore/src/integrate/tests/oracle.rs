//! The crate `ivp`, another translation of the authors' codes, as oracle.

use std::cell::RefCell;

use ivp::dense::StepInterpolant;
use ivp::ivp::FirstOrderSystem;
use ivp::methods::{DOP853, DOPRI5, Tolerance};
use ivp::solout::{ControlFlag, SolOut};

use super::*;

/// Planar Kepler motion of eccentricity 0.6 from the pericentre; period 2π.
fn kepler(_: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Error> {
    let cube = f64::hypot(y[0], y[1]).powi(3);
    rate.copy_from_slice(&[y[2], y[3], -y[0] / cube, -y[1] / cube]);
    Ok(())
}

const PERICENTRE: [f64; 4] = [0.4, 0.0, 0.0, 2.0];

/// Van der Pol's oscillator, mildly stiff, driven: steps are rejected at its jumps.
fn van_der_pol(t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Error> {
    rate[0] = y[1];
    rate[1] = 5.0 * (1.0 - y[0] * y[0]) * y[1] - y[0] + t.sin();
    Ok(())
}

struct Counted {
    f: Derivative,
    calls: RefCell<usize>,
}

impl FirstOrderSystem for Counted {
    fn derivative(&self, t: f64, y: &[f64], rate: &mut [f64]) {
        *self.calls.borrow_mut() += 1;
        assert!((self.f)(t, y, rate).is_ok());
    }
}

/// Steps of `ivp`: (t, y at the end, y in the middle).
#[derive(Default)]
struct Steps(Vec<(f64, Vec<f64>, Vec<f64>)>);

impl SolOut for Steps {
    fn solout(
        &mut self,
        t_old: f64,
        t: &mut f64,
        y: &mut [f64],
        interpolant: Option<&StepInterpolant<'_>>,
    ) -> ControlFlag {
        if let Some(interpolant) = interpolant {
            let mut middle = y.to_vec();
            interpolant.interpolate(0.5 * (t_old + *t), &mut middle);
            self.0.push((*t, y.to_vec(), middle));
        }
        ControlFlag::Continue
    }
}

/// Evaluations and steps.
fn run_ivp(
    method: Method,
    f: Derivative,
    (t0, y0): (f64, &[f64]),
    t_end: f64,
    settings: &Settings,
) -> (usize, Steps) {
    let calls = RefCell::new(0);
    let (f, mut steps) = (Counted { f, calls }, Steps::default());
    let tolerance = || Tolerance::Scalar(settings.tolerance.relative);
    let first_step = settings.first_step;
    let (stiff_test, dense_output) = (usize::MAX, true);
    let result = match method {
        Method::Dop853 => DOP853 {
            first_step,
            stiff_test,
            dense_output,
            ..DOP853::default()
        }
        .solve(
            &f,
            t0,
            y0,
            t_end,
            tolerance(),
            tolerance(),
            Some(&mut steps),
        ),
        Method::Dopri5 => DOPRI5 {
            first_step,
            stiff_test,
            dense_output,
            ..DOPRI5::default()
        }
        .solve(
            &f,
            t0,
            y0,
            t_end,
            tolerance(),
            tolerance(),
            Some(&mut steps),
        ),
        _ => panic!("an explicit method"),
    };
    assert!(result.is_ok());
    (f.calls.into_inner(), steps)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |d, (a, b)| d.max((a - b).abs()))
}

#[test]
fn each_step_is_the_same() {
    let cases: [(Derivative, &[f64], f64); 4] = [
        (circle, &[1.0, 0.0], 10.0),
        (kepler, &PERICENTRE, 7.0),
        (kepler, &PERICENTRE, -7.0),
        (van_der_pol, &[2.0, 0.0], 12.0),
    ];
    for method in EXPLICIT {
        for (f, y0, t_end) in cases {
            for tolerance in [1e-5, 1e-9] {
                let settings = Settings {
                    dense: true,
                    ..settings(tolerance)
                };
                let mut plain = Plain::new(f);
                let report = method.run(&mut plain, 0.0, y0, t_end, &settings);
                assert_eq!(report.outcome, Outcome::Reached);
                let mut start = y0.to_vec();
                for ((t_old, t, y), segment) in plain.steps.iter().zip(&plain.segments) {
                    let settings = Settings {
                        first_step: Some((t - t_old).abs()),
                        ..settings
                    };
                    let (_, steps) = run_ivp(method, f, (*t_old, &start), *t, &settings);
                    // It accepts the step, too.
                    let [(time, state, middle)] = &steps.0[..] else {
                        panic!("{method:?} at {t}: {} steps", steps.0.len())
                    };
                    assert!((t - time).abs() < 1e-14);
                    let near = 1e-3 * tolerance;
                    assert!(distance(y, state) < near, "{method:?} at {t}");
                    let mut between = middle.clone();
                    segment.state(0.5 * (t_old + t), &mut between);
                    assert!(distance(&between, middle) < near, "{method:?} before {t}");
                    start.clone_from(y);
                }
            }
        }
    }
}

#[test]
fn with_a_first_step_of_its_own_a_run_costs_and_errs_no_more() {
    let t_end = 6.0 * std::f64::consts::PI;
    for method in EXPLICIT {
        let (mut ours, mut theirs, mut ratios) = (0, 0, 1.0);
        let tolerances = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
        for tolerance in tolerances {
            let settings = Settings {
                dense: true,
                ..settings(tolerance)
            };
            let mut plain = Plain::new(kepler);
            let report = method.run(&mut plain, 0.0, &PERICENTRE, t_end, &settings);
            assert_eq!(report.outcome, Outcome::Reached);
            let (calls, steps) = run_ivp(method, kepler, (0.0, &PERICENTRE), t_end, &settings);
            ours += plain.evaluations.len();
            theirs += calls;
            let error = |y: &[f64]| distance(y, &PERICENTRE);
            ratios *= error(&plain.steps.last().unwrap().2) / error(&steps.0.last().unwrap().1);
        }
        assert!(100 * ours < 101 * theirs, "{ours}, {theirs}");
        // Errors at the end scatter with the sizes of the steps; their geometric mean hardly does.
        let mean = f64::powf(ratios, 1.0 / tolerances.len() as f64);
        assert!(mean < 2.0, "{method:?}: {mean}");
    }
}
