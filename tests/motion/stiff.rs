//! Stiff mechanisms with the implicit method.

use models::{FishRobot, Model, Pendulum, SpringPendulum, StartOptions};
use std::f64::consts::FRAC_PI_2;
use tests::{apart, assert_all_close, assert_close, at, at_rest};
use ukcore::simulate::Direction;
use ukcore::{Event, Mechanism, Method, Simulation, State, Trajectory};

fn simulation<M: Model>(model: &M, method: Method, tolerance: f64) -> Simulation {
    let start = model.default_start().expect("the default start exists");
    Simulation::new(model.clone())
        .start(start)
        .method(method)
        .tolerance(tolerance)
}

fn run<M: Model>(model: &M, method: Method, tolerance: f64, until: f64) -> Trajectory {
    let run = simulation(model, method, tolerance).at(Vec::new());
    run.until(until)
        .unwrap_or_else(|e| panic!("{}: {}", M::ID, e.error))
}

fn end(run: &Trajectory) -> State {
    run.last().expect("it has run").to_state()
}

/// Largest difference of coordinates and velocities.
fn distance(a: &State, b: &State) -> f64 {
    apart(&a.q, &b.q).max(apart(&a.v, &b.v))
}

fn spring(k: f64) -> SpringPendulum {
    SpringPendulum {
        k,
        ..SpringPendulum::default()
    }
}

ukcore::multibody! {
    /// A body that falls through a thick fluid; its drag has no derivative at rest.
    pub Sinking {
        params { g = 9.81, drag = 1e6 }
        coords { x, y }
        let speed = sqrt(sq(dot(x)) + sq(dot(y)));
        mass { x: 1.0, y: 1.0 }
        force { x: -drag * speed * dot(x), y: g - drag * speed * dot(y) }
    }
}

#[test]
fn a_start_without_derivative_is_got_over() {
    let start = at_rest(&[0.0; 2]);
    let run = Simulation::new(Sinking::default())
        .start(start)
        .method(Method::Radau5)
        .tolerance(1e-8)
        .until(10.0);
    let run = run.expect("it runs");
    // v = u tanh(g t / u) with u = √(g / drag), whose way is u² / g ln cosh(g t / u).
    let u = f64::sqrt(9.81 / 1e6);
    let way = u * (10.0 - u / 9.81 * 2.0_f64.ln());
    let last = run.last().expect("it has run");
    assert_all_close("q", last.q, &[0.0, way], 1e-7);
    assert_all_close("v", last.v, &[0.0, u], 1e-7);
    assert!(run.work().steps < 200, "{:?}", run.work());
}

#[test]
fn a_hard_spring_costs_a_fiftieth_of_the_evaluations_of_an_explicit_method() {
    let model = spring(1e8);
    let reference = end(&run(&model, Method::Dop853, 1e-12, 2.0));
    // Of each method the cheapest run with an error below 1e-6.
    let cheapest = |method| {
        let runs = (4..12).map(|k| run(&model, method, 10_f64.powi(-k), 2.0));
        let good = runs.filter(|run| distance(&end(run), &reference) < 1e-6);
        good.map(|run| run.work())
            .min_by_key(|work| work.evaluations)
    };
    let explicit = cheapest(Method::Dop853).expect("one is good");
    let implicit = cheapest(Method::Radau5).expect("one is good");
    // Jacobians counted as evaluations, too.
    assert!(50 * (implicit.evaluations + implicit.jacobians) <= explicit.evaluations);
    assert_eq!((explicit.jacobians, explicit.factorisations), (0, 0));
    assert!(implicit.jacobians > 0);
    assert!(implicit.factorisations > 0);
}

#[test]
fn the_harder_the_spring_the_nearer_to_the_rigid_pendulum() {
    let rigid = Pendulum::default();
    let (angle, rate) = rigid.swing(-FRAC_PI_2, 1.0);
    let (q, v) = rigid.at_angle(angle, rate);
    let rigid = State {
        t: 1.0,
        q: q.to_vec(),
        v: v.to_vec(),
    };
    // Distance times k.
    let scaled = |k: f64| {
        let run = run(&spring(k), Method::Radau5, 1e-11, 1.0);
        assert!(run.work().evaluations < 20_000, "{k}: {:?}", run.work());
        k * distance(&end(&run), &rigid)
    };
    let limit = scaled(1e7);
    for k in [1e5, 1e6, 1e8] {
        assert!(
            (scaled(k) / limit - 1.0).abs() < 0.1,
            "{k}: {} {limit}",
            scaled(k)
        );
    }
    for k in [1e10, 1e12, 1e14] {
        assert!(scaled(k) / k < limit / k + 1e-8, "{k}: {}", scaled(k) / k);
    }
}

#[test]
fn what_is_not_resolved_is_damped() {
    // The spring swings along itself by less than the tolerance, which shows in its force.
    let model = spring(1e10);
    let ripple = |method, tolerance| {
        let options = StartOptions::new().with("stretch", 1e-8);
        let start = model.start("released", &options).expect("it fits");
        let run = Simulation::new(model.clone()).start(start).method(method);
        let run = run.tolerance(tolerance).until(0.02).expect("it runs");
        let last = run.last().expect("it has run");
        let balance = {
            let angle = f64::atan2(last.q[0], -last.q[1]);
            let rate = (last.q[0] * last.v[1] - last.q[1] * last.v[0])
                / (last.q[0].powi(2) + last.q[1].powi(2));
            model.balance(angle, rate)
        };
        let growth = (last.q[0] * last.v[0] + last.q[1] * last.v[1]) / balance;
        f64::hypot(
            last.q[0].hypot(last.q[1]) - balance,
            growth / model.frequency(),
        )
    };
    assert!(ripple(Method::Radau5, 1e-4) < 1e-10);
    assert!((ripple(Method::Dop853, 1e-8) / 1e-8 - 1.0).abs() < 0.1);
}

#[test]
fn events_samples_and_the_way_back() {
    let model = spring(1e10);
    let bottom = Event::new("bottom", |_, q, _| q[0]).direction(Direction::Rising);
    let there = simulation(&model, Method::Radau5, 1e-9)
        .event(bottom)
        .every(0.1)
        .until(1.0)
        .expect("it runs");
    let rigid = Pendulum::default();
    let quarter = 0.25 * rigid.period(FRAC_PI_2);
    let hits: Vec<_> = there.events("bottom").expect("watched").collect();
    assert_eq!(hits.len(), 1);
    assert!(
        (hits[0].t - quarter).abs() < 1e-6,
        "{}",
        hits[0].t - quarter
    );
    for sample in there.samples() {
        let (angle, rate) = rigid.swing(-FRAC_PI_2, sample.t);
        let (q, v) = rigid.at_angle(angle, rate);
        assert_all_close("q", sample.q, &q, 1e-6);
        assert_all_close("v", sample.v, &v, 1e-5);
    }
    let back = Simulation::new(model.clone())
        .start(end(&there))
        .method(Method::Radau5)
        .tolerance(1e-9)
        .until(0.0)
        .expect("it runs");
    assert!(distance(&end(&back), &model.default_start().expect("exists")) < 1e-6);
}

#[test]
fn strong_drag_is_followed_through_constraints_and_a_singular_mass_matrix() {
    let mut fish = FishRobot::default();
    let drag = 1e4 * fish.get("cd").expect("declared");
    fish.set("cd", drag).expect("declared");
    let explicit = run(&fish, Method::Dop853, 1e-7, 0.5);
    let implicit = run(&fish, Method::Radau5, 1e-7, 0.5);
    let off = distance(&end(&explicit), &end(&implicit));
    assert!(off < 1e-5, "{off}");
    assert!(10 * implicit.work().evaluations < explicit.work().evaluations);
    let residuals = implicit.residuals();
    assert!(residuals.iter().all(|r| r.largest() < 1e-12));
}

ukcore::multibody! {
    /// A body on a hard spring, one metre from the origin: its coordinate is rounded, and the spring makes forces of that.
    pub Hung {
        params { k = 1e8 }
        coords { x }
        mass { x: 1.0 }
        potential { 0.5 * k * sq(x - 1.0) }
    }
}

#[test]
fn a_tolerance_below_the_rounding_of_forces_is_told_and_not_refined_past() {
    for k in [1e8_f64, 1e10] {
        for sign in [1.0, -1.0] {
            let (frequency, phase, swing) = (k.sqrt(), 1000.0, 1e-3);
            let run = |tolerance: f64| {
                let start = at_rest(&[1.0 + swing]);
                let run = Simulation::new(Hung { k }).start(start).at(Vec::new());
                let run = run.tolerance(tolerance).until(sign * phase / frequency);
                let run = run.expect("it swings");
                let State { q, v, .. } = end(&run);
                let position = q[0] - 1.0 - swing * phase.cos();
                let velocity = v[0] / frequency + sign * swing * phase.sin();
                (position.abs().max(velocity.abs()), run.work())
            };
            let (_, plain) = run(1e-9);
            assert_eq!(plain.rounded, 0);
            let (_, fine) = run(1e-12);
            // ε of the coordinate at all times adds up to as much.
            let rounding = f64::EPSILON * phase;
            for tolerance in [1e-13, 1e-14, 4e-15, 3e-15, 2.3e-15] {
                let (error, work) = run(tolerance);
                assert!(error < rounding, "{k}, {tolerance}: {error}");
                assert!(2 * work.evaluations < 3 * fine.evaluations, "{work:?}");
                assert!(work.rounded > 100, "{work:?}");
            }
        }
    }
}

ukcore::multibody! {
    /// A body of little inertia on a ball joint far off. Where that is askew of its axes, what turns it about the line between them is a
    /// difference of moments 1e11 times as large.
    pub Askew {
        params { l = 3e4, tilt = 0.0, j = 0.01, g = 9.81 }
        bodies { spatial body { mass: 1, inertia: [j, j, j] } }
        gravity { [0, 0, -g] }
        holonomic { foot: ball(ground.at([0, 0, 0]), body.at([0, l * sin(tilt), l * cos(tilt)])) }
        start swinging(rate = 1.0) {
            body.x = 0.3 * l; body.y = 0.4 * l; body.z near -0.9 * l; body.omega = [rate, 0.3 * rate, 0.2 * rate];
            body.e0 near 0.9; body.e3 = 0.1
        }
    }
}

/// A sphere of inertia moves the same whichever its axes are.
#[test]
fn rounding_within_the_equations_is_told_and_not_refined_past() {
    let run = |tilt: f64| {
        let body = Askew {
            tilt,
            ..Askew::default()
        };
        let rate = (body.g / body.l).sqrt();
        let start = body.start("swinging", &[("rate", rate)].into());
        let run = Simulation::new(&body).start(start.expect("a start"));
        let run = run.tolerance(1e-10).until(5.0 / rate).expect("a motion");
        let end = run.last().expect("an end").to_state();
        (end.q[2] / body.l, run.work())
    };
    let (plain, work) = run(0.0);
    assert_eq!(work.rounded, 0);
    let (askew, work) = run(0.7);
    assert!((plain - askew).abs() < 1e-8, "{plain} {askew}");
    assert!(work.rounded > 0 && work.evaluations < 150_000, "{work:?}");
}

ukcore::multibody! {
    /// Three masses between walls, on springs.
    Three {
        params { m = 0.5, k = 30.0 }
        coords { x, y, z }
        mass { x: m, y: m, z: m }
        potential { 0.5 * k * (sq(x) + sq(x - y) + sq(y - z) + sq(z)) }
    }
}

/// The mass in the middle rests between two that swing far: what rounding makes of it is its own, and does not make these less exact; nor
/// is the motion lost in it.
#[test]
fn rounding_of_one_coordinate_is_not_granted_to_others() {
    for far in [1.0, 1e5, 1e7, 1e9, 1e12] {
        for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
            for tolerance in [1e-8, 1e-10, 1e-12] {
                let start = at(&[far, far * 1e-16, -far], &[0.0; 3]);
                let run = Simulation::new(Three::default())
                    .method(method)
                    .tolerance(tolerance)
                    .start(start)
                    .until(10.0);
                let name = format!("{far:e}, {method}, {tolerance:e}");
                let run = run.unwrap_or_else(|failure| panic!("{name}: {failure}"));
                let end = run.last().expect("an end").q[0] / far;
                assert_close(
                    &name,
                    end,
                    (120_f64.sqrt() * 10.0).cos(),
                    50.0 * tolerance + 1e-10,
                );
            }
        }
    }
}

ukcore::multibody! {
    /// A body in Euler's angles.
    Euler {
        params { j[3] = [0.2, 0.3, 0.45] }
        coords { a, b, c }
        let w = [
            dot(c) - dot(a) * sin(b),
            dot(b) * cos(c) + dot(a) * cos(b) * sin(c),
            dot(a) * cos(b) * cos(c) - dot(b) * sin(c),
        ];
        kinetic { 0.5 * (j[0] * sq(w[0]) + j[1] * sq(w[1]) + j[2] * sq(w[2])) }
    }
}

/// Beside gimbal lock 1 − sin² b is rounded, the same at all stages of a step: what that makes of the motion is told, not taken for it.
#[test]
fn rounding_that_no_estimate_shows_is_told() {
    let mut told = 0;
    for rate in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
        for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
            for tolerance in [1e-4, 1e-6, 1e-8, 1e-9] {
                let turn = rate / 0.3_f64.cos();
                let start = at(&[0.0, 0.3, 0.0], &[turn, 2.0, turn * 0.3_f64.sin()]);
                let run = Simulation::new(Euler::default())
                    .method(method)
                    .tolerance(tolerance)
                    .start(start)
                    .until(2.0);
                let name = format!("{rate:e}, {method}, {tolerance:e}");
                match run {
                    Ok(run) => {
                        let drift = run.energy_drift();
                        assert!(drift < 5e-5 + 1e3 * tolerance, "{name}: {drift:e}");
                    }
                    Err(failure) => {
                        let text = failure.to_string();
                        let why = text.contains("rounding makes") || text.contains("fall in line");
                        assert!(rate < 1e-4 && why, "{name}: {text}");
                        told += 1;
                    }
                }
            }
        }
    }
    assert!(told > 0);
}

ukcore::multibody! {
    /// A bar on a pivot that is shaken; z points up.
    Shaken {
        params { m = 1.0, l = 0.5, j = 0.02, a = 0.1, w = 7.0, g = 9.81, t0 = 0.0 }
        bodies { spatial bar { mass: m, inertia: [j, 0.5 * j, j] } }
        gravity { [0, 0, -g] }
        holonomic { pivot: hinge(ground.at([0, 0, 0]), bar.at([a * sin(w * (t - t0)), 0, l]), [0, 1, 0]) }
        start out(angle = 0.7) {
            bar.e0 = cos(angle / 2.0); bar.e1 = 0; bar.e2 = sin(angle / 2.0); bar.e3 = 0;
            bar.x near -l * sin(angle); bar.z near -l * cos(angle)
        }
    }
}

ukcore::multibody! {
    /// A body between six hard springs, `far` from the origin.
    Sprung {
        params { m = 1.0, j = 0.01, k = 1e6, far = 0.0, s = 0.1 }
        bodies { spatial body { mass: m, inertia: [j, 1.2 * j, 1.5 * j] } }
        let axis = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
        forces {
            for i in 0..3 {
                spring(ground.at([far, 0, 0] + (s + 1.0) * axis[i]), body.at(s * axis[i]), k, 0.9)
                spring(ground.at([far, 0, 0] - (s + 1.0) * axis[i]), body.at(-s * axis[i]), k, 0.9)
            }
        }
        start kicked { body.e0 = 1; body.x = far; dot(body.x) = 1; body.omega = [1, 2, 3] }
    }
}

/// Steps may be so short that none is refused for the rounding in it: then a run took a hundred thousand of them, as long as none was. Late
/// they are so short that the rounding of the time is as much: then a run was refused before rounding was looked at.
#[test]
fn rounding_is_found_where_no_step_is_refused_for_it_and_where_all_are() {
    let sprung = |far: f64| {
        let body = Sprung {
            far,
            ..Sprung::default()
        };
        let start = body.start("kicked", &[].into()).expect("a start");
        let run = Simulation::new(&body).start(start).tolerance(1e-13);
        let run = run.until(0.2).expect("a motion");
        let end = run.last().expect("an end").to_state();
        (end.q[0] - far, run.work())
    };
    let (known, work) = sprung(0.0);
    assert_eq!(work.rounded, 0);
    let (found, work) = sprung(1e6);
    // A coordinate is known to 1.2e-10, and is rounded in two thousand steps.
    assert!((found - known).abs() < 1e-8, "{found} {known}");
    assert!(work.rounded > 100 && work.evaluations < 40_000, "{work:?}");

    let shaken = |t: f64, tolerance: f64| {
        let early = Shaken::default();
        let start = early.start("out", &[].into()).expect("a start");
        let bar = Shaken { t0: t, ..early };
        let run = Simulation::new(bar).start(State { t, ..start });
        let run = run.tolerance(tolerance).until(t + 3.0).expect("a motion");
        let end = run.last().expect("an end").to_state();
        (2.0 * end.q[5].atan2(end.q[3]), run.work())
    };
    let (known, work) = shaken(0.0, 1e-13);
    assert_eq!(work.rounded, 0);
    for tolerance in [1e-10, 1e-12, 1e-14] {
        let (found, work) = shaken(1e9, tolerance);
        // The time is known to 1.2e-7.
        assert!((found - known).abs() < 1e-6, "{tolerance}: {found} {known}");
        assert!(work.rounded > 0 && work.evaluations < 20_000, "{work:?}");
    }
}
