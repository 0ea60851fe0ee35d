//! Motions that are little before a crossing of branches when something happens to them: they turn there, begin there, go on from there,
//! or come to the zero of a switch. Beside them the same ones in the one coordinate that is free.

use std::f64::consts::FRAC_PI_2;

use tests::{apart, at, largest};
use ukcore::{Event, Mechanism, Method, Prepared, Simulation, State, Trajectory};

use crate::met::Parallelogram;

ukcore::multibody! {
    /// A slider-crank with equal arms: where its slider is on the axle, the bar may turn about it with the slider at rest. Forces act on
    /// the slider: a weight, one towards a place, friction, a spring behind it and a stop before it; and one on the crank near the axle.
    SliderCrank {
        params { g = 0.0, f = 0.0, mu = 0.0, k = 0.0, c = 0.0, d = 0.0, e = 1e-4 }
        coords { a, b, x }
        mass { a: 1, b: 0.5, x: 1 }
        potential { -g * x }
        force {
            x: -f * sign(x - c) - mu * sign(dot(x)) - k * x * abs(x) - 3 * k * max(0, x)
            a: -d * sign(sin(a) - 1 + e)
        }
        holonomic { l: [cos(a) + cos(b), sin(a) + sin(b)] = [x, 0] }
        integral { way = x }
    }
}

ukcore::multibody! {
    /// The same as it passes the axle.
    Crank {
        params { g = 0.0, f = 0.0, mu = 0.0, k = 0.0, c = 0.0, d = 0.0, e = 1e-4 }
        coords { a }
        let x = 2 * cos(a);
        let slider = -g + f * sign(x - c) - mu * sign(sin(a) * dot(a)) + k * x * abs(x) + 3 * k * max(0, x);
        kinetic { 0.5 * (1.5 + 4 * sq(sin(a))) * sq(dot(a)) }
        force { a: 2 * sin(a) * slider - d * sign(sin(a) - 1 + e) }
        integral { way = x }
    }
}

ukcore::multibody! {
    /// The parallelogram as it passes the line of the axles.
    pub(crate) Pendulum {
        params { k = 1.0 }
        coords { a }
        mass { a: 1 }
        potential { k * sin(a) }
    }
}

const METHODS: [(Method, f64); 6] = [
    (Method::Dop853, 1e-6),
    (Method::Dop853, 1e-9),
    (Method::Dop853, 1e-12),
    (Method::Dopri5, 1e-6),
    (Method::Dopri5, 1e-9),
    (Method::Radau5, 1e-6),
];

/// That of the parallelogram's falling.
const FALLS: f64 = 2.0 * 9.81 * 0.3 / (1.7 * 0.09);

fn falling() -> Parallelogram {
    Parallelogram {
        g: 9.81,
        ..Parallelogram::default()
    }
}

fn swinging() -> Pendulum {
    Pendulum { k: FALLS }
}

/// States of the parallelogram, and of the slider-crank.
fn turning(a: f64, rate: f64) -> State {
    at(&[a, -a, a], &[rate, -rate, rate])
}

fn cranked(a: f64, rate: f64) -> State {
    at(
        &[a, -a, 2.0 * a.cos()],
        &[rate, -rate, -2.0 * a.sin() * rate],
    )
}

/// The angle and its rate at the end of the same motion in one coordinate.
pub(crate) fn alone<M: Mechanism + Clone>(
    mechanism: &M,
    [a, rate]: [f64; 2],
    until: f64,
) -> [f64; 2]
where
    Prepared: From<M>,
{
    let run = Simulation::new(mechanism.clone()).tolerance(1e-13);
    let run = run.start(at(&[a], &[rate])).until(until);
    let run = run.expect("a motion of one coordinate");
    let end = run.last().expect("an end");
    [end.q[0], end.v[0]]
}

/// Asserts that a run ends there, in its branch, and how many evaluations it took.
fn ends(run: &Trajectory, there: [f64; 2], bound: f64, most: usize, place: &str) {
    let end = run.last().expect("an end");
    let off = (end.q[0] - there[0]).abs().max((end.v[0] - there[1]).abs());
    assert!(off < bound, "{place}: {off:e} off");
    let work = run.work().evaluations;
    assert!(work < most, "{place}: {work} evaluations");
}

#[test]
fn turning_little_before_a_crossing_costs_no_more_than_passing_it() {
    for before in [0.05_f64, 0.02, 0.01, 5e-3, 2e-3, 1e-3, 3e-4] {
        for from in [-1.2, -1.13, -1.06] {
            let rate = (2.0 * FALLS * ((-before).sin() - f64::sin(from))).sqrt();
            let there = alone(&swinging(), [from, rate], 3.0);
            for (method, tolerance) in METHODS {
                let place = format!("{method}, {tolerance:e}, turns {before} before, from {from}");
                let run = Simulation::new(falling()).method(method);
                let run = run.tolerance(tolerance).start(turning(from, rate));
                let run = run.until(3.0).unwrap_or_else(|e| panic!("{place}: {e}"));
                let bound = (1e3 * tolerance).max(1e-7);
                ends(&run, there, bound, 6_000, &place);
            }
        }
    }
}

#[test]
fn runs_begin_on_crossings_and_little_before_them() {
    let crank = SliderCrank {
        g: 9.81,
        ..SliderCrank::default()
    };
    let beside = Crank {
        g: 9.81,
        ..Crank::default()
    };
    let ways = [
        0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.05, -1e-9, -1e-6, -1e-3,
    ];
    for way in ways {
        for rate in [4.0, -6.3_f64] {
            let from = -way * rate.signum();
            let [fallen, cranked_to] = [
                alone(&swinging(), [from, rate], 1.0),
                alone(&beside, [FRAC_PI_2 + from, rate], 1.0),
            ];
            for (method, tolerance) in METHODS {
                let place = format!("{method}, {tolerance:e}, {way:e} before at {rate}");
                let bound = (1e3 * tolerance).max(1e-7);
                let start = turning(from, rate);
                let run = Simulation::new(falling()).start(start.clone());
                let run = run.method(method).tolerance(tolerance).until(1.0);
                let run = run.unwrap_or_else(|e| panic!("{place}: {e}"));
                ends(&run, fallen, bound, 6_000, &place);
                let first = run.samples().next().expect("a start");
                let changed = apart(first.v, &start.v);
                assert!(first.t == 0.0 && changed < bound, "{place}: {changed:e}");
                let later = run.samples().nth(1).expect("a step");
                assert!(later.t > 0.0, "{place}: a step before the start");
                let start = cranked(FRAC_PI_2 + from, rate);
                let run = Simulation::new(crank.clone()).start(start);
                let run = run.method(method).tolerance(tolerance).until(1.0);
                let run = run.unwrap_or_else(|e| panic!("{place}, crank: {e}"));
                ends(&run, cranked_to, bound, 6_000, &place);
            }
        }
    }
}

#[test]
fn slow_starts_on_a_crossing_take_no_more_than_others() {
    for rate in [1e-8, 1e-6, 1e-4, 1e-2] {
        for (method, tolerance) in METHODS {
            let start = turning(0.0, rate);
            let run = Simulation::new(falling()).start(start).method(method);
            let run = run.tolerance(tolerance).max_steps(5_000).until(0.5);
            let work = match run {
                Ok(run) => run.work().evaluations,
                Err(failure) => failure.trajectory.work().evaluations,
            };
            let place = format!("{method}, {tolerance:e}, {rate:e}");
            assert!(work < 20_000, "{place}: {work} evaluations");
        }
    }
}

#[test]
fn runs_go_on_from_where_others_end_at_a_crossing() {
    for way in [0.0, 1e-8, 1e-6, 1e-4, 1e-2] {
        for (method, tolerance) in METHODS {
            let place = format!("{method}, {tolerance:e}, {way:e} before");
            let run = || {
                let run = Simulation::new(falling()).method(method);
                run.tolerance(tolerance)
            };
            let there = Event::new("there", move |_t, q, _v| q[0] - (-way)).terminal();
            let start = turning(-0.9, 11.0);
            let first = run().start(start.clone()).event(there).until(1.0);
            let first = first.unwrap_or_else(|e| panic!("{place}: {e}"));
            let state = first.last().expect("an end").to_state();
            let left = 1.0 - state.t;
            let there = alone(&swinging(), [-0.9, 11.0], 1.0);
            let second = run().start(State { t: 0.0, ..state }).until(left);
            let second = second.unwrap_or_else(|e| panic!("{place}, going on: {e}"));
            let bound = (1e3 * tolerance).max(1e-6);
            ends(&second, there, bound, 6_000, &place);
        }
    }
}

/// The forces of [`SliderCrank`]: f, μ, k, c, d, e.
const FORCES: [[f64; 6]; 8] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    [1.0, 0.3, 0.5, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    // A zero beside the crossing, and another one on it.
    [1.0, 0.0, 0.5, 1e-9, 0.0, 0.0],
    [1.0, 0.0, 0.5, -1e-3, 0.0, 0.0],
    // Two zeros of one switch about it.
    [0.0, 0.0, 0.0, 0.0, 1.0, 1e-4],
    [1.0, 0.0, 0.0, 1e-2, 1.0, 1e-6],
];

#[test]
fn switches_have_their_zeros_on_crossings() {
    for [f, mu, k, c, d, e] in FORCES {
        for rate in [3.0, 4.9, -7.3] {
            let g = 0.0;
            let until = if rate > 4.0 { -2.0 } else { 2.0 };
            let one = Simulation::new(Crank {
                g,
                f,
                mu,
                k,
                c,
                d,
                e,
            })
            .tolerance(1e-13);
            let one = one.start(at(&[0.3], &[rate])).every(0.01).until(until);
            let one = one.expect("a motion of one coordinate");
            for (method, tolerance) in METHODS {
                let place =
                    format!("{method}, {tolerance:e}, {f} {mu} {k} {c:e} {d} {e:e} at {rate}");
                let run = Simulation::new(SliderCrank {
                    g,
                    f,
                    mu,
                    k,
                    c,
                    d,
                    e,
                })
                .method(method);
                let run = run.tolerance(tolerance).start(cranked(0.3, rate));
                let run = run.every(0.01).dense().until(until);
                let run = run.unwrap_or_else(|e| panic!("{place}: {e}"));
                let bound = (1e3 * tolerance).max(1e-7);
                assert_eq!(run.times(), one.times(), "{place}");
                for (sample, there) in run.samples().zip(one.samples()) {
                    let between = run.at(sample.t).expect("a state");
                    let off = [
                        sample.q[0] - there.q[0],
                        sample.v[0] - there.v[0],
                        between.q[0] - there.q[0],
                        between.v[0] - there.v[0],
                        sample.integrals[0] - there.integrals[0],
                    ];
                    let off = largest(&off);
                    assert!(off < bound, "{place}: {off:e} off at {}", sample.t);
                }
                let work = run.work().evaluations;
                assert!(work < 10_000, "{place}: {work} evaluations");
            }
        }
    }
}

#[test]
fn friction_where_a_motion_turns_little_before_a_crossing_ends() {
    for before in [1e-2_f64, 3e-3, 1e-3, 1e-4] {
        for mu in [0.0, 0.5] {
            let (from, k) = (0.4_f64, 2.0);
            let to = FRAC_PI_2 - before;
            // It swings about where the slider is farthest out, against its stop.
            let potential = |x: f64| k * (x * x * x / 3.0 + 1.5 * x * x);
            let way = mu * (2.0 * from.cos() - 2.0 * to.cos());
            let work = potential(2.0 * from.cos()) - potential(2.0 * to.cos()) - way;
            let start = cranked(
                from,
                (2.0 * work.abs() / (1.5 + 4.0 * from.sin().powi(2))).sqrt(),
            );
            for (method, tolerance) in METHODS {
                let crank = SliderCrank {
                    mu,
                    k,
                    ..SliderCrank::default()
                };
                let run = Simulation::new(crank).method(method).tolerance(tolerance);
                let run = run.start(start.clone()).max_steps(5_000).until(2.0);
                let work = match run {
                    Ok(run) => run.work().evaluations,
                    Err(failure) => failure.trajectory.work().evaluations,
                };
                let place = format!("{method}, {tolerance:e}, {before:e} before, friction {mu}");
                assert!(work < 20_000, "{place}: {work} evaluations");
            }
        }
    }
}
