//! Whole runs, measured against closed forms.

use std::cell::RefCell;
use std::f64::consts::{FRAC_PI_2, PI};
use std::rc::Rc;

use super::*;
use crate::events::Direction;
use crate::fixture;
use crate::mechanism::{
    ConstraintKind, ConstraintSpec, Energy, Equations, Operations, OutputSpec, ParamSpec, Spec,
    Structure, Terms,
};
use crate::scalar::Scalar;
use crate::solver::Baumgarte;
use crate::trajectory::Sample;

/// A particle on a circle, in Cartesian coordinates; y points up. With a force that exists until t = `limit` only.
#[derive(Debug, Clone, PartialEq)]
struct Pendulum {
    l: f64,
    g: f64,
    limit: f64,
}

impl Default for Pendulum {
    fn default() -> Self {
        Pendulum {
            l: 1.0,
            g: 9.8,
            limit: 1e6,
        }
    }
}

const fn param(name: &'static str, default: f64) -> ParamSpec {
    let doc = "";
    ParamSpec { name, doc, default }
}

static SPEC: Spec = Spec {
    name: "Pendulum",
    doc: "",
    params: &[param("l", 1.0), param("g", 9.8), param("limit", 1e6)],
    prepared: &[("l", "l"), ("g", "g"), ("limit", "limit")],
    coords: &["x", "y"],
    constraints: &[ConstraintSpec {
        name: "rod",
        kind: ConstraintKind::Holonomic,
        equation: "x^2 + y^2 - l^2",
    }],
    holonomic: 1,
    outputs: &[OutputSpec {
        name: "angle",
        doc: "",
    }],
    structure: Structure {
        straight_line: false,
        solve_operations: crate::mechanism::Operations {
            additions: 0,
            multiplications: 0,
            divisions: 0,
            square_roots: 0,
            transcendentals: 0,
            selections: 0,
        },
        solve: "",
        mass_pattern: &[(0, 0), (1, 1)],
        jacobian_pattern: &[(0, 0), (0, 1)],
        mass_diagonal: true,
        mass_constant: true,
        jacobian_constant: false,
        massless: &[],
        scleronomic: true,
        nonideal: false,
        potential: true,
        conservative: true,
        left_out: &[],
        operations: Operations {
            additions: 0,
            multiplications: 0,
            divisions: 0,
            square_roots: 0,
            transcendentals: 0,
            selections: 0,
        },
    },
    equations: Equations {
        definitions: &[],
        mass: &[],
        force: &[],
        nonideal: &[],
        jacobian: &[],
        rhs: &[],
    },
};

impl Mechanism for Pendulum {
    const SPEC: &'static Spec = &SPEC;

    fn parameter(&self, index: usize) -> f64 {
        [self.l, self.g, self.limit][index]
    }
    fn set_parameter(&mut self, index: usize, value: f64) {
        *[&mut self.l, &mut self.g, &mut self.limit][index] = value;
    }
    fn prepare<S: Scalar>(given: &[S], prepared: &mut [S]) {
        prepared.copy_from_slice(given);
    }
    fn dynamics<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], out: &mut Terms<'_, S>) {
        Self::mass_matrix(p, t, q, out.mass);
        Self::jacobian(p, t, q, v, out.jacobian);
        let none = S::from_f64(0.0);
        out.force[0] = none * (p[2] - t).sqrt();
        out.force[1] = -p[1];
        out.nonideal.fill(none);
        out.rhs[0] = -S::from_f64(2.0) * (v[0] * v[0] + v[1] * v[1]);
    }
    fn mass_matrix<S: Scalar>(_p: &[S], _: S, _: &[S], mass: &mut [S]) {
        mass[0] = S::from_f64(1.0);
        mass[3] = S::from_f64(1.0);
    }
    fn jacobian<S: Scalar>(_p: &[S], _: S, q: &[S], _: &[S], jacobian: &mut [S]) {
        jacobian[0] = q[0] + q[0];
        jacobian[1] = q[1] + q[1];
    }
    fn residual<S: Scalar>(p: &[S], _: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[0] * q[0] + q[1] * q[1] - p[0] * p[0];
    }
    fn residual_rate<S: Scalar>(_p: &[S], _: S, q: &[S], v: &[S], rate: &mut [S]) {
        rate[0] = S::from_f64(2.0) * (q[0] * v[0] + q[1] * v[1]);
    }
    fn energy<S: Scalar>(p: &[S], _: S, q: &[S], v: &[S]) -> Energy<S> {
        Energy {
            kinetic: S::from_f64(0.5) * (v[0] * v[0] + v[1] * v[1]),
            potential: p[1] * q[1],
        }
    }
    fn outputs<S: Scalar>(_p: &[S], _: S, q: &[S], _: &[S], outputs: &mut [S]) {
        outputs[0] = q[0].atan2(-q[1]);
    }
}

fn state(t: f64, angle: f64, rate: f64) -> State {
    State {
        t,
        q: vec![angle.sin(), -angle.cos()],
        v: vec![rate * angle.cos(), rate * angle.sin()],
    }
}

/// From rest at `angle`.
fn swing(angle: f64, tolerance: f64) -> Simulation<Pendulum> {
    let start = state(0.0, angle, 0.0);
    Simulation::new(Pendulum::default())
        .start(start)
        .tolerance(tolerance)
}

/// Period at amplitude `angle`: 2π √(l/g) / agm(1, cos(angle/2)).
fn period(angle: f64) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * angle).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    2.0 * PI / f64::sqrt(9.8) / a
}

fn distance(a: Sample<'_>, b: Sample<'_>) -> f64 {
    let pairs = a.q.iter().zip(b.q).chain(a.v.iter().zip(b.v));
    pairs.fold(0.0, |m, (a, b)| f64::max(m, (a - b).abs()))
}

#[track_caller]
fn source(failure: &Failure<Pendulum>) -> (f64, Error) {
    match &failure.error {
        Error::At { t, source, .. } => (*t, (**source).clone()),
        other => panic!("{other:?} has no place"),
    }
}

#[test]
fn a_pendulum_returns_after_its_period() {
    for method in [Method::Dop853, Method::Dopri5] {
        for angle in [0.1, FRAC_PI_2, 3.0] {
            let time = period(angle);
            let run = swing(angle, 1e-12).method(method).until(time).unwrap();
            let (start, end) = (run.sample(0).unwrap(), run.last().unwrap());
            assert_eq!(end.t, time);
            assert_eq!(run.ending(), Ending::Completed);
            // A swing from almost upright magnifies errors.
            let bound = if angle > 2.0 { 1e-8 } else { 2e-10 };
            let off = distance(start, end);
            assert!(off < bound, "{method:?}, {angle}: {off}");
        }
    }
}

#[test]
fn error_falls_with_the_order_of_the_method_under_projection() {
    // After five periods and a quarter it passes the bottom with the speed of the fall.
    let time = 5.25 * period(1.0);
    let speed = f64::sqrt(2.0 * 9.8 * (1.0 - f64::cos(1.0)));
    let (q, v) = (&[0.0, -1.0], &[-speed, 0.0]);
    for (method, order) in [(Method::Dop853, 8.0), (Method::Dopri5, 5.0)] {
        let run = |tolerance| {
            let run = swing(1.0, tolerance).method(method).until(time).unwrap();
            let off = distance(Sample { t: time, q, v }, run.last().unwrap());
            (off, run.work().steps as f64)
        };
        let ((coarse, few), (fine, many)) = (run(1e-8), run(1e-12));
        let observed = (coarse / fine).ln() / (many / few).ln();
        // More, if error control and projection leave less than the leading term.
        assert!(observed > order - 0.5, "{method:?}: {observed}");
        assert!(observed < order + 2.0, "{method:?}: {observed}");
        assert!(fine < 1e-9, "{fine}");
    }
}

#[test]
fn energy_and_constraints_hold_at_all_samples() {
    for method in [Method::Dop853, Method::Dopri5] {
        let run = swing(2.0, 1e-12).method(method).every(0.013).until(20.0);
        let run = run.unwrap();
        assert!(run.energy_drift() < 1e-9, "{}", run.energy_drift());
        for residual in run.residuals() {
            assert!(residual.largest() <= 1e-12, "{residual:?}");
        }
        assert_eq!(run.len(), 1 + (20.0_f64 / 0.013) as usize + 1);
        for (k, sample) in run.samples().enumerate().take(run.len() - 1) {
            assert_eq!(sample.t, k as f64 * 0.013);
        }
        assert_eq!(run.samples().next_back().unwrap().t, 20.0);
    }
}

#[test]
fn drift_is_visible_without_stabilisation_and_damped_with_baumgarte() {
    let drift = |stabilisation| {
        let run = swing(2.0, 1e-6).stabilise(stabilisation).until(50.0);
        let run = run.unwrap();
        let last = *run.residuals().last().unwrap();
        (last.position, run.work())
    };
    let (projected, work) = drift(Stabilisation::Projection);
    assert!(projected < 1e-14);
    assert!(work.projections > work.steps);
    let (none, work) = drift(Stabilisation::None);
    assert!(none > 1e-6, "{none}");
    // The start, and nothing else.
    assert_eq!(work.projections, 1);
    let (alpha, beta) = (10.0, 10.0);
    let (damped, work) = drift(Stabilisation::Baumgarte(Baumgarte { alpha, beta }));
    assert!(damped < 0.1 * none, "{damped} of {none}");
    assert_eq!(work.projections, 1);
}

#[test]
fn samples_do_not_change_the_steps_and_lie_near_the_end_of_runs_to_them() {
    for method in [Method::Dop853, Method::Dopri5] {
        for tolerance in [1e-6, 1e-9, 1e-11] {
            let plain = swing(1.0, tolerance).method(method).until(3.0).unwrap();
            let times: Vec<f64> = (1..30).map(|k| 0.1 * f64::from(k)).collect();
            let run = swing(1.0, tolerance).method(method).at(times.clone());
            let run = run.until(3.0).unwrap();
            assert_eq!(run.work().steps, plain.work().steps);
            assert_eq!(
                run.last().unwrap().to_state(),
                plain.last().unwrap().to_state()
            );
            assert_eq!(run.times(), times);
            // Largest error over the times: sampled, and where a run of its own ends there.
            let exact = swing(1.0, 1e-13).at(times).until(3.0).unwrap();
            let (mut sampled, mut ended) = (0.0_f64, 0.0_f64);
            for (sample, exact) in run.samples().zip(exact.samples()) {
                let end = swing(1.0, tolerance).method(method).until(exact.t);
                sampled = sampled.max(distance(sample, exact));
                ended = ended.max(distance(end.unwrap().last().unwrap(), exact));
            }
            assert!(sampled < 10.0 * ended, "{method:?}: {sampled}, {ended}");
        }
    }
}

#[test]
fn samples_at_given_times_include_start_and_end_only_if_asked_for() {
    let times = |times: &[f64]| {
        let run = swing(1.0, 1e-9).at(times.to_vec()).until(1.0).unwrap();
        assert_eq!(run.last().unwrap().t, 1.0);
        run.times().to_vec()
    };
    for asked in [&[][..], &[0.0], &[1.0], &[0.0, 0.5, 1.0], &[1.0 - 1e-16]] {
        assert_eq!(times(asked), asked);
    }
}

#[test]
fn a_run_backward_returns_to_the_start() {
    for method in [Method::Dop853, Method::Dopri5] {
        let there = swing(2.5, 1e-12).method(method).dense().until(3.0).unwrap();
        let end = there.last().unwrap().to_state();
        let back = Simulation::new(Pendulum::default())
            .start(end)
            .method(method)
            .tolerance(1e-12)
            .every(0.25)
            .dense()
            .until(0.0)
            .unwrap();
        let start = there.sample(0).unwrap();
        let off = distance(start, back.last().unwrap());
        assert!(off < 1e-9, "{off}");
        let times: Vec<f64> = (0..=12).map(|k| 3.0 - 0.25 * f64::from(k)).collect();
        assert_eq!(back.times(), times);
        for t in [0.0, 0.3, 1.7, 2.999, 3.0] {
            let (a, b) = (there.at(t).unwrap(), back.at(t).unwrap());
            assert!((a.q[0] - b.q[0]).abs() < 1e-9, "{a:?} {b:?}");
            let r = f64::hypot(b.q[0], b.q[1]);
            assert!((r - 1.0).abs() < 1e-15);
        }
        assert!(there.at(3.1).is_err());
        assert!(there.at(f64::NAN).is_err());
    }
}

#[test]
fn events_are_located_at_the_quarters_of_the_period() {
    let angle = 1.2;
    let quarter = 0.25 * period(angle);
    for direction in [Direction::Rising, Direction::Falling, Direction::Both] {
        let event = Event::new("bottom", |_, q, _| q[0]).direction(direction);
        let run = swing(angle, 1e-14).event(event).until(10.0 * quarter);
        let run = run.unwrap();
        let expect: Vec<f64> = match direction {
            Direction::Falling => vec![1.0, 5.0, 9.0],
            Direction::Rising => vec![3.0, 7.0],
            Direction::Both => vec![1.0, 3.0, 5.0, 7.0, 9.0],
        };
        let bottom = run.events("bottom").unwrap();
        let found: Vec<f64> = bottom.map(|hit| hit.t).collect();
        assert_eq!(found.len(), expect.len());
        for (t, expect) in found.iter().zip(expect) {
            assert!(
                (t - expect * quarter).abs() < 1e-12,
                "{}",
                t - expect * quarter
            );
        }
        for hit in run.all_events() {
            // A unit of rounding in t, times the velocity.
            let rounding = 2.0 * f64::EPSILON * hit.t * hit.v[0].abs();
            assert!(hit.q[0].abs() < rounding, "{}", hit.q[0]);
            assert!((hit.q[1] + 1.0).abs() < 1e-15);
            let passed = if hit.direction == Direction::Rising {
                1.0
            } else {
                -1.0
            };
            assert!(passed * hit.q[0] >= 0.0);
        }
        let unknown = run.events("buttom").map(Iterator::count).unwrap_err();
        assert_eq!(
            unknown.to_string(),
            "no event is called `buttom`; did you mean `bottom`?"
        );
    }
}

#[test]
fn a_terminal_event_ends_the_run_at_its_state() {
    let bottom = || Event::new("bottom", |_, q, _| q[0]).terminal();
    let half = Event::new("half", |_, q, _| q[0] - 0.5);
    let run = swing(FRAC_PI_2, 1e-12)
        .event(half)
        .event(bottom())
        .every(0.01);
    let run = run.until(10.0).unwrap();
    assert_eq!(run.ending(), Ending::Event);
    let names: Vec<&str> = run.all_events().iter().map(|h| h.name.as_str()).collect();
    assert_eq!(names, ["half", "bottom"]);
    let hit = &run.all_events()[1];
    let end = run.last().unwrap();
    assert_eq!((end.t, end.q, end.v), (hit.t, &hit.q[..], &hit.v[..]));
    assert!((end.t - 0.25 * period(FRAC_PI_2)).abs() < 1e-10);
    assert_eq!(run.samples().next_back(), run.last());
    assert_eq!(run.len(), 2 + (end.t / 0.01) as usize);

    // The run can go on from there without meeting the same zero again.
    let on = Simulation::new(Pendulum::default()).start(end.to_state());
    let on = on.tolerance(1e-12).event(bottom()).until(10.0).unwrap();
    assert!((on.last().unwrap().t - 0.75 * period(FRAC_PI_2)).abs() < 1e-10);
}

#[test]
fn a_failing_force_is_reported_with_its_time_and_the_motion_kept() {
    for method in [Method::Dop853, Method::Dopri5] {
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
        assert!((kept.last().unwrap().t - 1.5).abs() < 1e-12);
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
    assert!((t - 1.0).abs() < 1e-12);
    let what = vec!["event root".to_owned()];
    assert_eq!(error, Error::NonFinite { what });
    assert!((failure.trajectory.last().unwrap().t - 1.0).abs() < 1e-12);

    let failure = swing(1.0, 1e-9).max_steps(5).until(20.0).unwrap_err();
    let (_, error) = source(&failure);
    assert_eq!(error, Error::TooManySteps { steps: 5 });
    let work = failure.trajectory.work();
    assert_eq!(work.steps + work.rejected, 5);
    assert_eq!(failure.trajectory.len(), 1 + work.steps);
}

#[test]
fn counters_are_consistent() {
    let seen = Rc::new(RefCell::new(Vec::new()));
    let times = Rc::clone(&seen);
    let run = swing(3.0, 1e-9)
        .progress(move |run| {
            times.borrow_mut().extend(run.last().map(|last| last.t));
            ControlFlow::Continue(())
        })
        .until(10.0)
        .unwrap();
    let work = run.work();
    assert_eq!(*seen.borrow(), run.times()[1..]);
    assert_eq!(work.steps + 1, run.len());
    assert!(work.rejected > 0);
    let attempts = work.steps + work.rejected;
    assert_eq!(work.evaluations, 2 + 11 * attempts + work.steps);
    assert_eq!(work.projections, 1 + work.steps);
    assert!(work.projection_iterations <= 3 * 2 * work.projections);
    assert_eq!(work.fallbacks, 0);
}

#[test]
fn progress_can_end_a_run() {
    let run = swing(1.0, 1e-9).progress(|run| {
        if run.last().unwrap().t > 1.0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    let run = run.every(0.25).until(10.0).unwrap();
    assert_eq!(run.ending(), Ending::Interrupted);
    let last = run.last().unwrap();
    assert!(last.t > 1.0 && last.t < 2.0);
    assert_eq!(run.samples().next_back(), Some(last));
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
    type Change = fn(Simulation<Pendulum>) -> Simulation<Pendulum>;
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
fn a_run_of_no_length_has_its_start() {
    let run = swing(1.0, 1e-9).every(0.1).dense().until(0.0).unwrap();
    assert_eq!((run.len(), run.ending()), (1, Ending::Completed));
    assert_eq!(run.last(), run.sample(0));
    assert_eq!(run.at(0.0).unwrap(), run.last().unwrap().to_state());
    assert_eq!(run.work().steps, 0);
}

#[test]
fn quantities_along_the_motion_agree_with_closed_forms() {
    let angle = 1.0_f64;
    let run = swing(angle, 1e-11).every(0.05).until(2.0).unwrap();
    let angles = run.output("angle").unwrap();
    let solutions = run.solutions().unwrap();
    let accelerations = run.accelerations().unwrap();
    assert!((angles[0] - angle).abs() < 1e-15);
    for (i, sample) in run.samples().enumerate() {
        // Tension: m (v²/l + g cos θ), along the rod; λ = −tension / 2l since A = 2 (x, y).
        let speed = sample.v[0] * sample.v[0] + sample.v[1] * sample.v[1];
        let tension = speed + 9.8 * angles[i].cos();
        assert!((solutions[i].multipliers[0] + 0.5 * tension).abs() < 1e-12);
        let expect = [-tension * sample.q[0], -tension * sample.q[1] - 9.8];
        for (a, expect) in accelerations[i].iter().zip(expect) {
            assert!((a - expect).abs() < 1e-12);
        }
    }
    assert_eq!(run.coordinate("x").unwrap()[0], angle.sin());
    assert_eq!(run.velocity("x").unwrap()[0], 0.0);
    assert!(run.coordinate("z").is_err());
}

#[test]
fn csv_reads_back_as_the_same_numbers() {
    let run = swing(1.0, 1e-9).every(0.3).until(1.0).unwrap();
    let mut csv = Vec::new();
    run.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    let mut lines = csv.lines();
    assert_eq!(
        lines.next().unwrap(),
        "t,x,y,dot(x),dot(y),angle,energy,residual"
    );
    for (line, sample) in lines.by_ref().zip(run.samples()) {
        let row: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        assert_eq!(row.len(), 8);
        assert_eq!(row[0], sample.t);
        assert_eq!(row[1..3], *sample.q);
        assert_eq!(row[3..5], *sample.v);
    }
    assert_eq!(csv.lines().count(), 1 + run.len());
}

/// From (q, v) at t = 0, projected.
fn toy<M: Mechanism>(mechanism: M, q: &[f64], v: &[f64]) -> Simulation<M> {
    let (t, q, v) = (0.0, q.to_vec(), v.to_vec());
    Simulation::new(mechanism)
        .start(State { t, q, v })
        .tolerance(1e-11)
}

#[test]
fn redundant_constraints_change_nothing() {
    let run = toy(fixture::Twice::default(), &[1.0, 0.0, 1.0, -1.0], &[0.0; 4]);
    let run = run.every(0.1).until(10.0).unwrap();
    for (sample, energy) in run.samples().zip(run.energy()) {
        // Masses 1 and 2; the fixture leaves V out.
        let potential = 9.8 * (sample.q[1] + 2.0 * (sample.q[3] + 1.0));
        assert!((energy.kinetic + potential).abs() < 1e-8);
    }
    assert!(run.residuals().iter().all(|r| r.largest() < 1e-12));
    assert!(run.solutions().unwrap().iter().all(|s| s.rank == 2));

    // The copy is implied on the manifold only; stages of a step lie off it.
    let (s, c) = f64::sin_cos(0.3);
    let cranks = toy(
        fixture::Parallelogram::default(),
        &[c, s, 2.0 + c, s],
        &[0.0; 4],
    );
    let run = cranks.every(0.1).until(1.0).unwrap();
    assert!(run.residuals().iter().all(|r| r.largest() < 1e-12));
    for sample in run.samples() {
        assert!((sample.q[2] - sample.q[0] - 2.0).abs() < 1e-12);
    }
}

#[test]
fn massless_and_prescribed_coordinates_follow_closed_forms() {
    // Two springs in series: stiffness k₁ k₂ / (k₁ + k₂) = 15/8, mass 2.
    let rate = f64::sqrt(15.0 / 16.0);
    let run = toy(fixture::Springs::default(), &[0.8, 0.5], &[0.0, 0.0]);
    let run = run.every(0.1).until(20.0).unwrap();
    for sample in run.samples() {
        let x = 0.8 * (rate * sample.t).cos();
        assert!((sample.q[0] - x).abs() < 1e-9);
        assert!((sample.q[1] - 0.625 * sample.q[0]).abs() < 1e-14);
    }
    let run = toy(fixture::Prescribed::default(), &[0.0, 0.0], &[1.0, 0.0]);
    let run = run.every(0.1).until(-7.0).unwrap();
    for sample in run.samples() {
        assert!((sample.q[0] - sample.t.sin()).abs() < 1e-14);
        assert!((sample.v[0] - sample.t.cos()).abs() < 1e-14);
        assert!((sample.q[1] - 1.5 * sample.t * sample.t).abs() < 1e-9);
    }
}
