//! What is refused, and what is kept of a run that fails.

use super::*;
use approx::assert_abs_diff_eq;

#[test]
fn a_failing_force_is_reported_with_its_time_and_the_motion_kept() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        let mechanism = Pendulum {
            limit: 1.5,
            ..Pendulum::default()
        };
        let failure = Simulation::new(mechanism)
            .start(state(0.0, 1.0, 0.0))
            .method(method)
            .every(0.1)
            .until(9.0)
            .unwrap_err();
        let (t, error) = source(&failure);
        assert!((t - 1.5).abs() < 1e-12, "{t}");
        assert!(matches!(error, Error::NonFinite { .. }), "{error:?}");
        let kept = &failure.trajectory;
        assert_eq!(kept.ending(), Ending::Failed);
        assert_eq!(kept.len(), 16);
        assert_abs_diff_eq!(kept.last().unwrap().t, 1.5, epsilon = 1e-12);
        let mut csv = Vec::new();
        kept.write_csv(&mut csv).unwrap();
        assert_eq!(String::from_utf8(csv).unwrap().lines().count(), 17);
        let text = failure.to_string();
        assert!(text.contains("Pendulum") && text.contains("1.5"), "{text}");
        assert!(std::error::Error::source(&failure).is_some());
    }
}

#[test]
fn an_event_that_is_not_a_number_and_too_few_steps_are_failures_that_keep_the_motion() {
    let event = Event::new("root", |t, _, _| (1.0 - t).sqrt());
    let failure = swing(1.0, 1e-9).event(event).until(2.0).unwrap_err();
    let (t, error) = source(&failure);
    assert_abs_diff_eq!(t, 1.0, epsilon = 1e-12);
    let what = vec!["event root".to_owned()];
    assert_eq!(error, Error::NonFinite { what });
    assert_abs_diff_eq!(failure.trajectory.last().unwrap().t, 1.0, epsilon = 1e-12);

    let failure = swing(1.0, 1e-9).max_steps(5).until(20.0).unwrap_err();
    let (_, error) = source(&failure);
    assert_eq!(error, Error::TooManySteps { steps: 5 });
    let work = failure.trajectory.work();
    assert_eq!(work.steps + work.rejected, 5);
    assert_eq!(failure.trajectory.len(), 1 + work.steps);
}

#[test]
fn starts_are_checked() {
    let start = |state| Simulation::new(Pendulum::default()).start(state).until(1.0);
    let error = |state| start(state).unwrap_err().error;
    let mut short = state(0.0, 1.0, 0.0);
    short.q.pop();
    assert!(matches!(error(short), Error::WrongLength { what: "q", .. }));
    let mut nan = state(0.0, 1.0, 0.0);
    nan.v[1] = f64::NAN;
    let Error::NonFinite { what } = error(nan) else {
        panic!("accepted");
    };
    assert!(what[0].contains('y'), "{what:?}");
    let mut off = state(0.0, 1.0, 0.5);
    off.q[0] += 1e-3;
    let failure = start(off).unwrap_err();
    assert!(failure.trajectory.is_empty() && failure.trajectory.last().is_none());
    let Error::OffConstraint { level, constraints } = failure.error else {
        panic!("accepted");
    };
    assert_eq!((level, &constraints[0].0[..]), ("position", "rod"));
    let mut off = state(0.0, 1.0, 0.5);
    off.v[0] += 1e-3;
    let Error::OffConstraint { level, .. } = error(off) else {
        panic!("accepted");
    };
    assert_eq!(level, "velocity");
    // Six printed digits are good enough, and made exact.
    let mut rounded = state(0.0, 1.0, 0.5);
    for x in rounded.q.iter_mut().chain(&mut rounded.v) {
        *x = (*x * 1e7).round() * 1e-7;
    }
    let run = start(rounded).unwrap();
    assert!(run.residuals()[0].largest() < 1e-15);
}

#[test]
fn settings_are_checked() {
    type Change = fn(Simulation) -> Simulation;
    let check = |what: &str, change: Change, t_end: f64| {
        let failure = change(swing(1.0, 1e-9)).until(t_end).unwrap_err();
        let Error::InvalidSetting { what: found, .. } = failure.error else {
            panic!("{:?}", failure.error);
        };
        assert_eq!(found, what);
    };
    let tolerances: [Change; 6] = [
        |s| s.tolerance(0.0),
        |s| s.tolerance(-1.0),
        |s| s.tolerance(f64::NAN),
        |s| s.tolerance(f64::INFINITY),
        |s| s.tolerance(1.0),
        |s| s.tolerance(1e-16),
    ];
    for change in tolerances {
        check("tolerance", change, 1.0);
    }
    check("t_end", |s| s, f64::NAN);
    check("t_end", |s| s, f64::INFINITY);
    check("every", |s| s.every(0.0), 1.0);
    check("every", |s| s.every(-0.1), 1.0);
    check("every", |s| s.every(1e-17), 1.0);
    check("every", |s| s.every(1e-12), 1.0);
    check("max_step", |s| s.max_step(f64::NAN), 1.0);
    check("first_step", |s| s.first_step(0.0), 1.0);
    check("max_steps", |s| s.max_steps(0), 1.0);
    check("times", |s| s.at(vec![0.5, 0.2]), 1.0);
    check("times", |s| s.at(vec![0.5, 1.2]), 1.0);
    check("times", |s| s.at(vec![f64::NAN]), 1.0);
    let baumgarte: Change = |s| {
        let (alpha, beta) = (-1.0, 1.0);
        s.stabilise(Stabilisation::Baumgarte(Baumgarte { alpha, beta }))
    };
    check("alpha", baumgarte, 1.0);
    let failure = Simulation::new(Pendulum::default()).until(1.0).unwrap_err();
    assert!(failure.to_string().contains("start"));
}

#[test]
fn an_end_out_of_reach_is_told_as_such() {
    let failure = swing(1.0, 1e-9).until(1e300).unwrap_err();
    let message = failure.error.to_string();
    assert!(message.contains("`t_end` is 1e300, so far"), "{message}");
}
