//! The methods on plain right-hand sides, without mechanics.

use super::control::StepSize;
use super::*;
use approx::assert_abs_diff_eq;

mod oracle;
mod order;
mod radau;

type Derivative = fn(f64, &[f64], &mut [f64]) -> Result<(), Error>;
type Projection = fn(f64, &mut [f64]) -> Result<(), Error>;

/// A problem made of functions, which writes down what happens.
struct Plain {
    f: Derivative,
    project: Projection,
    sample: Option<f64>,
    fail_after: f64,
    evaluations: Vec<(f64, Vec<f64>)>,
    steps: Vec<(f64, f64, Vec<f64>)>,
    jacobians: usize,
    interpolants: usize,
    segments: Vec<Segment>,
}

impl Plain {
    fn new(f: Derivative) -> Self {
        Plain {
            f,
            project: |_, _| Ok(()),
            sample: None,
            fail_after: f64::INFINITY,
            evaluations: Vec::new(),
            steps: Vec::new(),
            jacobians: 0,
            interpolants: 0,
            segments: Vec::new(),
        }
    }
}

/// Time, state and error of a run that failed.
#[track_caller]
fn failed(report: &Report) -> (f64, Vec<f64>, Error) {
    let Outcome::Failed(Trouble { state, error }) = &report.outcome else {
        panic!("{:?}", report.outcome);
    };
    let y = [&state.q[..], &state.v].concat();
    (state.t, y, error.clone())
}

fn failure() -> Error {
    let what = vec!["test".to_owned()];
    Error::NonFinite { what }
}

impl Plain {
    /// y at a state.
    fn note(&mut self, at: Sample<'_>) -> Vec<f64> {
        let y = [at.q, at.v].concat();
        self.evaluations.push((at.t, y.clone()));
        y
    }
}

impl Problem for Plain {
    fn acceleration(&mut self, at: Sample<'_>, out: &mut [f64]) -> Result<(), Error> {
        let y = self.note(at);
        let mut rate = vec![0.0; y.len()];
        (self.f)(at.t, &y, &mut rate)?;
        let (q_rate, v_rate) = rate.split_at(out.len());
        assert_eq!(q_rate, at.v);
        out.copy_from_slice(v_rate);
        Ok(())
    }
    /// The Jacobian by differences.
    fn jacobian(
        &mut self,
        at: Sample<'_>,
        acceleration: &mut [f64],
        out: &mut [f64],
    ) -> Result<(), Error> {
        let y = [at.q, at.v].concat();
        let n = acceleration.len();
        let mut rate = vec![0.0; 2 * n];
        (self.f)(at.t, &y, &mut rate)?;
        acceleration.copy_from_slice(&rate[n..]);
        for (j, column) in out.chunks_exact_mut(n).enumerate() {
            let h = 1e-6 * y[j].abs().max(1.0);
            let [after, before] = [h, -h].map(|h| {
                let (mut moved, mut rate) = (y.clone(), vec![0.0; 2 * n]);
                moved[j] += h;
                // The functions here have a value where they fail, too.
                let _ = (self.f)(at.t, &moved, &mut rate);
                rate
            });
            for i in 0..n {
                column[i] = (after[n + i] - before[n + i]) / (2.0 * h);
            }
        }
        self.jacobians += 1;
        Ok(())
    }
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<(), Error> {
        let mut y = [&*q, &*v].concat();
        (self.project)(t, &mut y)?;
        q.copy_from_slice(&y[..q.len()]);
        v.copy_from_slice(&y[q.len()..]);
        Ok(())
    }
    fn project_along(&mut self, _: f64, _: &[f64], _: [&mut [f64]; 2]) -> Result<(), Error> {
        Ok(())
    }
    fn project_velocity(&mut self, _: f64, _: &[f64], _: &mut [f64]) -> Result<(), Error> {
        Ok(())
    }
    fn next_sample(&self) -> Option<f64> {
        self.sample
    }
    fn step(&mut self, step: &Step<'_>) -> Result<(Next, f64), Error> {
        let (t_old, Sample { t, q, v, .. }) = (step.old.t, step.new);
        if t > self.fail_after {
            return Err(failure());
        }
        if let Some(interpolant) = step.interpolant {
            self.interpolants += 1;
            self.segments.push(interpolant.segment());
        }
        if self.sample.is_some_and(|sample| sample <= t) {
            self.sample = self.sample.map(|t| t + 1.0);
        }
        self.steps.push((t_old, t, [q, v].concat()));
        Ok((Next::Continue, 0.0))
    }
}

const EXPLICIT: [Method; 2] = [Method::Dop853, Method::Dopri5];
const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];

/// Relative and absolute, of as many components as any test has.
fn both(tolerance: f64) -> Tolerance {
    Tolerance {
        relative: tolerance,
        floors: vec![1.0; 16],
    }
}

fn settings(tolerance: f64) -> Settings {
    Settings {
        tolerance: both(tolerance),
        first_step: None,
        max_step: None,
        max_steps: 100_000,
        dense: false,
        switches: &[],
    }
}

/// q̈ = −q: angle 0 at t = 0, angular velocity −1 in the plane of (q, q̇).
fn circle(_: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Error> {
    rate[0] = y[1];
    rate[1] = -y[0];
    Ok(())
}

fn circle_error(t: f64, y: &[f64]) -> f64 {
    f64::hypot(y[0] - t.cos(), y[1] + t.sin())
}

/// Onto the unit circle.
fn normalise(_: f64, y: &mut [f64]) -> Result<(), Error> {
    let r = f64::hypot(y[0], y[1]);
    y[0] /= r;
    y[1] /= r;
    Ok(())
}

/// Runs a circle and returns its error at the end, evaluations and report.
fn run_circle(method: Method, projected: bool, t_end: f64, tolerance: f64) -> (f64, Plain, Report) {
    let mut plain = Plain::new(circle);
    if projected {
        plain.project = normalise;
    }
    let report = method.run(&mut plain, 0.0, &[1.0, 0.0], t_end, &settings(tolerance));
    assert_eq!(report.outcome, Outcome::Reached);
    let (_, t, y) = plain.steps.last().unwrap().clone();
    assert_eq!(t, t_end);
    (circle_error(t, &y), plain, report)
}

#[test]
fn error_falls_with_the_order_of_the_method() {
    for (method, order, bound) in [
        (Method::Dop853, 8.0, 1e-8),
        (Method::Dopri5, 5.0, 1e-8),
        (Method::Radau5, 5.0, 5e-8),
    ] {
        for projected in [false, true] {
            for t_end in [30.0, -30.0] {
                let (coarse, few, _) = run_circle(method, projected, t_end, 1e-5);
                let (fine, many, _) = run_circle(method, projected, t_end, 1e-10);
                let work = many.steps.len() as f64 / few.steps.len() as f64;
                let observed = (coarse / fine).ln() / work.ln();
                assert!(fine < bound, "{method:?}: {fine}");
                assert!(
                    (observed - order).abs() < 1.3,
                    "{method:?}: order {observed}"
                );
            }
        }
    }
}

#[test]
fn projection_costs_no_evaluation_and_evaluations_are_made_at_projected_states() {
    for method in METHODS {
        let (_, plain, report) = run_circle(method, true, 20.0, 1e-6);
        let attempts = report.steps + report.rejected;
        let count = match method {
            // f at the start, the probe for the first step, eleven stages, one at the end of each accepted step.
            Method::Dop853 => 2 + 11 * attempts + report.steps,
            Method::Dopri5 => 2 + 6 * attempts,
            // Three stages of each iteration are the rest.
            _ => {
                let rest = plain.evaluations.len() - 2 - report.steps;
                2 + report.steps + rest / 3 * 3
            }
        };
        assert_eq!(plain.evaluations.len(), count);
        assert_eq!(report.steps, plain.steps.len());
        for step in &plain.steps {
            let (_, t, y) = step;
            assert_abs_diff_eq!(f64::hypot(y[0], y[1]), 1.0, epsilon = 4e-16);
            assert!(
                plain
                    .evaluations
                    .iter()
                    .any(|(s, z)| z == y && (s - t).abs() < 1e-14)
            );
        }
    }
}

#[test]
fn interpolants_come_where_asked_for_only() {
    for method in METHODS {
        let extra = if method == Method::Dop853 { 3 } else { 0 };
        let run = |sample, dense| {
            let mut plain = Plain::new(circle);
            plain.project = normalise;
            plain.sample = sample;
            let settings = Settings {
                dense,
                ..settings(1e-9)
            };
            let report = method.run(&mut plain, 0.0, &[1.0, 0.0], 10.0, &settings);
            assert_eq!(report.outcome, Outcome::Reached);
            (plain, report)
        };
        let (none, report) = run(None, false);
        assert_eq!(none.interpolants, 0);
        let (some, _) = run(Some(0.5), false);
        let crossed = |(a, b, _): &&(f64, f64, Vec<f64>)| (a - 0.5).floor() < (b - 0.5).floor();
        assert_eq!(some.interpolants, some.steps.iter().filter(crossed).count());
        let cost = some.evaluations.len() - none.evaluations.len();
        assert_eq!(cost, extra * some.interpolants);
        let (all, _) = run(None, true);
        assert_eq!(all.interpolants, report.steps);
        let cost = all.evaluations.len() - none.evaluations.len();
        assert_eq!(cost, extra * report.steps);
    }
}

#[test]
fn interpolants_agree_with_the_motion_in_both_directions() {
    for (method, bound) in [
        (Method::Dop853, 1e-9),
        (Method::Dopri5, 1e-8),
        (Method::Radau5, 1e-7),
    ] {
        for t_end in [10.0, -10.0] {
            let mut plain = Plain::new(circle);
            let settings = Settings {
                dense: true,
                ..settings(1e-10)
            };
            let report = method.run(&mut plain, 0.0, &[1.0, 0.0], t_end, &settings);
            assert_eq!(report.outcome, Outcome::Reached);
            for (segment, (t_old, t, _)) in plain.segments.iter().zip(&plain.steps) {
                assert_eq!(segment.from, *t_old);
                for part in [0.0, 0.1, 0.5, 0.9, 1.0] {
                    let t = t_old + part * (t - t_old);
                    let mut y = [0.0; 2];
                    segment.state(t, &mut y);
                    assert!(circle_error(t, &y) < bound, "{method:?} at {t}");
                }
            }
        }
    }
}

#[test]
fn a_failing_right_hand_side_is_reported_where_no_step_avoids_it() {
    for method in METHODS {
        for sign in [1.0, -1.0] {
            // q = 1 − |t|: the root ends at |t| = 1.
            let f: Derivative = |_, y, rate| {
                rate.copy_from_slice(&[y[1], 0.0]);
                if y[0] < 0.0 { Err(failure()) } else { Ok(()) }
            };
            let mut plain = Plain::new(f);
            let report = method.run(
                &mut plain,
                sign * 1e-3,
                &[0.999, -sign],
                sign * 9.0,
                &settings(1e-8),
            );
            let (t, y, error) = failed(&report);
            assert_eq!(error, failure());
            assert!((t.abs() - 1.0).abs() < 1e-13, "{method:?} at {t}");
            assert!(y[0] < 0.0 && y[0] > -1e-13);
            let last = plain.steps.last().unwrap();
            assert_abs_diff_eq!(last.1.abs(), 1.0, epsilon = 1e-13);
            assert!(report.rejected > 10);
            assert_eq!(report.steps, plain.steps.len());
        }
    }
}

#[test]
fn failing_at_the_start_is_reported_at_once() {
    for method in METHODS {
        let mut plain = Plain::new(|_, _, _| Err(failure()));
        let report = method.run(&mut plain, 2.0, &[3.0, 1.0], 5.0, &settings(1e-8));
        assert_eq!(failed(&report), (2.0, vec![3.0, 1.0], failure()));
        assert!(plain.evaluations.len() <= 2);
        assert_eq!((report.steps, report.rejected), (0, 0));
    }
}

#[test]
fn a_projection_that_is_too_large_rejects_the_step() {
    for method in METHODS {
        // Beyond t = 1 consistent states are elsewhere.
        let mut plain = Plain::new(circle);
        plain.project = |t, y| {
            if t > 1.0 {
                y[0] += 1e-3;
            }
            Ok(())
        };
        let report = method.run(&mut plain, 0.0, &[1.0, 0.0], 5.0, &settings(1e-6));
        let (t, _, error) = failed(&report);
        assert!(matches!(error, Error::StepTooSmall { .. }), "{error:?}");
        assert!((t - 1.0).abs() < 1e-12, "{t}");
        assert!(report.rejected > 10);

        // Within the limit it is a good step.
        let mut plain = Plain::new(circle);
        plain.project = |_, y| {
            y[0] += 1e-6;
            Ok(())
        };
        let report = method.run(&mut plain, 0.0, &[1.0, 0.0], 5.0, &settings(1e-6));
        assert_eq!(report.outcome, Outcome::Reached);
    }
}

#[test]
fn a_failing_projection_or_step_rejects_the_step() {
    for method in METHODS {
        let mut plain = Plain::new(circle);
        plain.project = |t, _| if t > 1.0 { Err(failure()) } else { Ok(()) };
        let report = method.run(&mut plain, 0.0, &[1.0, 0.0], 5.0, &settings(1e-6));
        let (t, _, error) = failed(&report);
        assert_eq!(error, failure());
        assert!((1.0..1.0 + 1e-13).contains(&t), "{t}");

        let mut plain = Plain::new(circle);
        plain.fail_after = 1.0;
        let report = method.run(&mut plain, 0.0, &[1.0, 0.0], 5.0, &settings(1e-6));
        let (t, _, error) = failed(&report);
        assert_eq!(error, failure());
        assert!((1.0..1.0 + 1e-13).contains(&t), "{t}");
        assert!(plain.steps.iter().all(|step| step.1 <= 1.0));
    }
}

#[test]
fn step_limits_are_kept() {
    for method in METHODS {
        let run = |settings: Settings| {
            let mut plain = Plain::new(circle);
            let report = method.run(&mut plain, 0.0, &[1.0, 0.0], 50.0, &settings);
            (plain, report)
        };
        let (plain, _) = run(Settings {
            max_step: Some(0.01),
            first_step: Some(0.001),
            ..settings(1e-6)
        });
        assert_eq!(plain.steps[0].1, 0.001);
        assert!(plain.steps.iter().all(|(a, b, _)| b - a <= 0.01 * 1.0101));
        for steps in [1, 2, 3, 7] {
            let (_, report) = run(Settings {
                max_steps: steps,
                ..settings(1e-9)
            });
            assert_eq!(report.steps + report.rejected, steps);
            let (_, _, error) = failed(&report);
            assert_eq!(error, Error::TooManySteps { steps });
        }
    }
}

#[test]
fn many_small_steps_do_not_add_up_rounding() {
    // 1/3 of a step of 1/1024 is not a binary number; 1000 + it loses ten of its digits.
    let third: Derivative = |_, y, rate| {
        rate.copy_from_slice(&[y[1], 0.0]);
        Ok(())
    };
    for method in EXPLICIT {
        let settings = Settings {
            max_step: Some(1.0 / 1024.0),
            max_steps: 1_000_000,
            ..settings(1e-9)
        };
        let mut problem = Plain::new(third);
        let report = method.run(&mut problem, 0.0, &[1000.0, 1.0 / 3.0], 300.0, &settings);
        assert!(report.steps > 300_000, "{method:?}");
        let (_, t, y) = problem.steps.last().unwrap();
        assert_eq!((*t, y[0]), (300.0, 1100.0), "{method:?}");
    }
}

#[test]
fn a_growing_time_does_not_hide_the_end() {
    for method in METHODS {
        for (t0, span) in [(1e9, 3.0), (-1e9, -3.0), (0.1, 0.2), (1.0 / 3.0, -0.7)] {
            let mut plain = Plain::new(circle);
            let report = method.run(&mut plain, t0, &[1.0, 0.0], t0 + span, &settings(1e-9));
            assert_eq!(report.outcome, Outcome::Reached);
            let (_, t, y) = plain.steps.last().unwrap();
            assert_eq!(*t, t0 + span);
            assert!(circle_error(span, y) < 1e-7);
        }
    }
}

#[test]
fn steps_that_run_into_a_wall_are_made_shorter() {
    for method in METHODS {
        // e^(−40 t) stays above 0; long steps do not, and there f ends.
        let mut plain = Plain::new(|_, y, rate| {
            rate.copy_from_slice(&[y[1], -40.0 * y[1]]);
            if y[0] < 0.0 { Err(failure()) } else { Ok(()) }
        });
        let settings = Settings {
            first_step: Some(1.0),
            ..settings(1e-8)
        };
        let report = method.run(&mut plain, 0.0, &[1.0, -40.0], 0.5, &settings);
        assert_eq!(report.outcome, Outcome::Reached);
        assert!(report.rejected > 1, "{method:?}");
        let (_, t, y) = plain.steps.last().unwrap();
        assert_eq!(*t, 0.5);
        assert!((y[0] - f64::exp(-20.0)).abs() < 1e-8);
    }
}

#[test]
fn interpolants_run_on_smoothly_through_projected_states() {
    for method in EXPLICIT {
        for t_end in [10.0, -10.0] {
            let mut plain = Plain::new(circle);
            plain.project = normalise;
            let settings = Settings {
                dense: true,
                ..settings(1e-5)
            };
            let report = method.run(&mut plain, 0.0, &[1.0, 0.0], t_end, &settings);
            assert_eq!(report.outcome, Outcome::Reached);
            for (segment, (t_old, t, end)) in plain.segments.iter().zip(&plain.steps) {
                let mut y = [0.0; 2];
                segment.state(*t, &mut y);
                // The speed is 1: rounding of the time moves the point by as much.
                let rounding = f64::EPSILON * (2.0 + t.abs());
                assert!(f64::hypot(y[0] - end[0], y[1] - end[1]) < rounding);
                // The rate at the end is f of the projected state.
                let h = 1e-4 * (t - t_old);
                let mut before = [0.0; 2];
                segment.state(t - h, &mut before);
                let mut after = [0.0; 2];
                segment.state(t + h, &mut after);
                let rate = [
                    (after[0] - before[0]) / (2.0 * h),
                    (after[1] - before[1]) / (2.0 * h),
                ];
                assert!(f64::hypot(rate[0] - end[1], rate[1] + end[0]) < 1e-7);
            }
        }
    }
}

#[test]
fn the_next_step_aims_at_nine_tenths_of_the_size_that_meets_the_tolerance() {
    let control = &tableau::DOP853.control;
    for error in [0.01_f64, 0.3, 1.0] {
        // An error of order 8 would then be 1 after 0.9 is taken back.
        let h = StepSize::default().accepted(control, 0.2, error);
        assert!((error * (h / 0.9 / 0.2).powi(8) - 1.0).abs() < 1e-13);
    }
    let mut size = StepSize::default();
    assert_eq!(size.accepted(control, 0.2, 0.0), 0.2 * 6.0);
    assert!((size.inaccurate(control, 0.2, 10.0) / 0.2 - 0.9 * 10_f64.powf(-0.125)).abs() < 1e-15);
    assert_eq!(size.inaccurate(control, 0.2, f64::NAN), 0.2 * 0.333);
    // Not longer directly after a rejection, then again.
    assert_eq!(size.accepted(control, 0.2, 1e-6), 0.2);
    assert!(size.accepted(control, 0.2, 1e-6) > 0.2);
    assert_eq!(size.unfit(0.2), 0.1);
    assert_eq!(size.accepted(control, 0.1, 0.0), 0.1);
}

#[test]
fn errors_that_grow_are_expected_to_go_on_growing() {
    let control = &tableau::DOP853.control;
    // error = C h⁸ with C ten times larger in each step: a step of the size chosen then has nine tenths of the size allowed.
    let mut size = StepSize::default();
    let (mut h, mut constant) = (0.1, 1e6);
    for k in 0..5 {
        let error: f64 = constant * f64::powi(h, 8);
        if k > 1 {
            assert!((error * 0.9_f64.powi(-8) - 1.0).abs() < 1e-12, "{error}");
        }
        h = size.accepted(control, h, error);
        constant *= 10.0;
    }
    // Where they fall, steps do not become longer by more than the last error allows.
    let mut size = StepSize::default();
    size.accepted(control, 0.1, 1.0);
    let h = size.accepted(control, 0.1, 0.5);
    assert!((h - 0.09 * 0.5_f64.powf(-0.125)).abs() < 1e-15);
}

#[test]
fn methods_are_read_as_they_are_written() {
    for text in [
        "dop853",
        "dopri5",
        "radau5",
        "rattle=0.001",
        "rattle=1e-200",
    ] {
        let read: Method = text.parse().expect(text);
        assert_eq!(read.to_string(), text);
    }
    for text in [
        "euler",
        "rattle",
        "rattle=",
        "rattle=0",
        "rattle=inf",
        "rattle=1kg",
        "dop853=1",
    ] {
        let read: Result<Method, Error> = text.parse();
        assert!(
            matches!(read, Err(Error::InvalidSetting { what: "method", .. })),
            "{text}"
        );
    }
}
