//! Motions through singular positions, where constraints come to imply each other and branches of the motion cross: each goes on in the
//! branch it came on, by every method, or is refused before a sample is wrong. Where branches only come near, it turns with its own.

mod mechanisms;

use std::f64::consts::FRAC_PI_2;

use crate::launched::{Pendulum, alone};
use mechanisms::{ANGLE, CASES, Case, Crank, CrankAngle, SpringCrank, crank, crank_pendulum};
use tests::{at, cause, hunted, worst};
use ukcore::simulate::Sample;
use ukcore::{Ensemble, Error, Event, Mechanism, Method, Simulation};

/// Runs and how they came out.
#[derive(Debug, Default)]
struct Outcomes {
    passed: usize,
    refused: usize,
    wrong: Vec<String>,
}

impl Outcomes {
    fn case(&mut self, number: usize, rate: f64, method: Method, tolerance: f64, until: f64) {
        let Case {
            mechanism,
            start,
            off,
        } = CASES[number](rate);
        let run = Simulation::new(mechanism)
            .start(start)
            .method(method)
            .tolerance(tolerance);
        // RATTLE has the accuracy of its step.
        let bound = match method {
            Method::Rattle { .. } => 1e-4,
            _ => (10.0 * tolerance).max(1e-8),
        };
        let label = format!("case {number}, {rate}/s, {method}, {tolerance:e}");
        // Samples lie within steps, those over singular positions among them.
        match run.max_steps(100_000).every(0.013).until(until) {
            Ok(run) => {
                let (off, drift) = (worst(&run, off), run.energy_drift());
                let accurate = match method {
                    Method::Rattle { .. } => drift <= 1e-3,
                    _ => drift <= 3e3 * tolerance + 1e-7,
                };
                if off <= bound && accurate {
                    self.passed += 1;
                } else {
                    self.wrong
                        .push(format!("{label}: off by {off:e}, energy by {drift:e}"));
                }
            }
            Err(failure) => {
                let off = worst(&failure.trajectory, off);
                if off <= bound {
                    println!("{label}: {failure}");
                    self.refused += 1;
                } else {
                    self.wrong.push(format!(
                        "{label}: off by {off:e} before it fails: {failure}"
                    ));
                }
            }
        }
    }
}

#[test]
fn singular_positions_are_passed_by_every_method() {
    let mut outcomes = Outcomes::default();
    for number in 0..CASES.len() {
        let rate = 3.1 + 0.57 * number as f64;
        for tolerance in [1e-4, 1e-9, 1e-12] {
            outcomes.case(number, rate, Method::Dop853, tolerance, 3.0);
        }
        for method in [
            Method::Dopri5,
            Method::Radau5,
            Method::Rattle { step: 5e-3 },
        ] {
            outcomes.case(number, rate, method, 1e-7, 2.0);
        }
    }
    assert!(
        outcomes.wrong.is_empty() && outcomes.refused == 0,
        "{outcomes:#?}"
    );
}

/// The same over many rates: `HUNT=400 cargo test --release -p tests hunt_for_branches -- --ignored --nocapture`.
#[test]
#[ignore = "a hunt over many rates"]
fn hunt_for_branches() {
    let count = hunted(400);
    let mut all = Outcomes::default();
    let every = [
        Method::Dop853,
        Method::Dopri5,
        Method::Radau5,
        Method::Rattle { step: 1e-2 },
    ];
    for method in every {
        let tolerances: &[f64] = match method {
            Method::Dop853 => &[1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12],
            Method::Rattle { .. } => &[1e-9],
            _ => &[1e-4, 1e-7],
        };
        for (number, &tolerance) in
            (0..CASES.len()).flat_map(|n| tolerances.iter().map(move |t| (n, t)))
        {
            let mut outcomes = Outcomes::default();
            for k in 0..count {
                let rate = 2.0 + 6.0 * (k as f64 + 0.618) / count as f64;
                outcomes.case(number, rate, method, tolerance, 10.0);
            }
            let Outcomes {
                passed,
                refused,
                wrong,
            } = outcomes;
            println!(
                "{method}, {tolerance:e}, case {number}: {passed} passed, {refused} refused, {} wrong",
                wrong.len()
            );
            all.refused += refused;
            all.wrong.extend(wrong);
        }
    }
    assert!(all.wrong.is_empty() && all.refused == 0, "{all:#?}");
}

/// Motions that hurt: rates of near misses from stages of far too long steps, stages that come near by chance, passages that miss the
/// accuracy asked for by a hair, a crank that hovers beside its dead centre, samples on it that no step was planned for, an end soon
/// behind.
#[test]
fn what_the_hunt_has_found() {
    let mut outcomes = Outcomes::default();
    for (number, rate, tolerance) in [
        (7, 4.4809, 1e-4),
        (7, 5.930899999999999, 1e-6),
        (2, 3.838832, 1e-4),
        (5, 7.294832, 1e-6),
        (3, 7.750832, 1e-11),
        (4, 2.854832, 1e-12),
        (5, 5.710832, 1e-9),
        (7, 7.361800000000001, 1e-11),
        // A stage of the interpolant just on the position; stages that are not near it, but suffer from it.
        (9, 3.31236, 1e-9),
        (8, 4.11236, 1e-12),
        (9, 5.69236, 1e-12),
        // A crank that hovers beside its dead centre while the pendulum turns over: stages behind it see it far from where it is.
        (2, 5.685236, 1e-5),
        // A sample in a step over the position, taken out of its branch by what constraints beyond doubt make of an interpolant.
        (2, 7.33427, 1e-4),
    ] {
        outcomes.case(number, rate, Method::Dop853, tolerance, 10.0);
    }
    for (number, rate) in [(0, 2.881236), (2, 2.347236), (2, 6.985236)] {
        outcomes.case(number, rate, Method::Dopri5, 1e-4, 10.0);
    }
    assert!(
        outcomes.wrong.is_empty() && outcomes.refused == 0,
        "{outcomes:#?}"
    );
    for (rate, method, bound) in [
        (6.3809, Method::Radau5, 1e-3),
        (5.685236, Method::Radau5, 1e-3),
        (7.0809, Method::Rattle { step: 1e-2 }, 2e-4),
    ] {
        let Case {
            mechanism,
            start,
            off,
        } = crank_pendulum(rate);
        let run = Simulation::new(mechanism).start(start).method(method);
        let run = run.tolerance(1e-4).every(0.013).until(10.0);
        let run = run.unwrap_or_else(|failure| panic!("{failure}"));
        // Where the slider stands at the bearing, only its velocity tells the branches apart.
        let (off, drift) = (worst(&run, off), run.energy_drift());
        assert!(off < 1e-4 && drift < bound, "{method}: {off:e}, {drift:e}");
    }
}

/// An interpolant is in its branch, if not on the constraints; a sample is both, so that how exact a run is asked to be shows in its times
/// alone.
#[test]
fn samples_in_steps_over_singular_positions_are_in_their_branch() {
    for number in [0, 1, 2, 3, 4, 5, 8, 9] {
        let Case {
            mechanism,
            start,
            off,
        } = CASES[number](5.46);
        for (tolerance, method) in [
            (1e-4, Method::Dop853),
            (1e-12, Method::Dop853),
            (1e-6, Method::Radau5),
        ] {
            let run = Simulation::new(mechanism.clone()).start(start.clone());
            let run = run.method(method).tolerance(tolerance).every(0.0031);
            let run = run.until(1.5).unwrap_or_else(|failure| panic!("{failure}"));
            let (off, nearly) = (worst(&run, off), 1e-3 * tolerance);
            assert!(
                off <= nearly.max(1e-12),
                "case {number}, {method}, {tolerance:e}: off by {off:e}"
            );
        }
    }
}

#[test]
fn runs_end_and_are_sampled_at_singular_positions() {
    let rate = 5.5;
    let angle = at(&[ANGLE], &[rate]);
    let own = CrankAngle::default();
    let up = Event::new("up", |_t, q, _v| q[0] - 0.5 * std::f64::consts::PI);
    let own = Simulation::new(own).start(angle).tolerance(1e-13).event(up);
    let own = own.dense().until(2.0).expect("a regular motion");
    let there = own.all_events()[0].t;
    for method in [
        Method::Dop853,
        Method::Dopri5,
        Method::Radau5,
        Method::Rattle { step: 2e-3 },
    ] {
        let crank = || crank(1.0, 0.0, rate);
        let simulation = || {
            let Case {
                mechanism, start, ..
            } = crank();
            Simulation::new(mechanism).start(start).method(method)
        };
        let whole = simulation().dense().until(1.0);
        let whole = whole.unwrap_or_else(|failure| panic!("{method}: {failure}"));
        for past in [-1e-3, -1e-5, -1e-8, 0.0, 1e-8, 1e-5, 1e-3] {
            let t = there + past;
            let exact = own.at(t).expect("within the run");
            let run = simulation().until(t);
            let run = run.unwrap_or_else(|failure| panic!("{method}, {past:e}: {failure}"));
            let end = run.last().expect("an end").to_state();
            assert_eq!(end.t, t);
            let within = whole.at(t).expect("within the run");
            for (what, state) in [("end", end), ("sample", within)] {
                let slider = -2.0 * exact.q[0].sin() * exact.v[0];
                let off = [
                    state.q[2] - exact.q[0],
                    state.q[6] - 2.0 * exact.q[0].cos(),
                    state.v[2] - exact.v[0],
                    state.v[6] - slider,
                ];
                let bound = match method {
                    Method::Rattle { .. } => 2e-3,
                    _ => 1e-5,
                };
                assert!(
                    off.iter().all(|x| x.abs() < bound),
                    "{method}, {what}, {past:e}: {off:?}"
                );
            }
        }
    }
}

/// Too soon for a step over the position that ends with the run, and not so near that it is one with the end.
#[test]
fn runs_end_soon_behind_singular_positions() {
    for (tolerance, past) in [1e-9, 1e-11]
        .into_iter()
        .flat_map(|tolerance| (1..=24).map(move |k| (tolerance, 3e-5 * f64::from(k))))
    {
        // The crank lies on the ground, its top on the joint of the rocker.
        let Case {
            mechanism,
            start,
            off,
        } = CASES[7](7.361800000000001);
        let folds = |_t: f64, q: &[f64], _v: &[f64]| q[1];
        let whole = Simulation::new(mechanism.clone()).start(start.clone());
        let found = whole.event(Event::new("folds", folds)).until(3.0);
        let found = found.unwrap_or_else(|failure| panic!("{failure}"));
        let there = found
            .all_events()
            .iter()
            .find(|hit| hit.q[0] > 0.0)
            .expect("it folds");
        let run = Simulation::new(mechanism).start(start).tolerance(tolerance);
        let run = run.until(there.t + past);
        let run = run.unwrap_or_else(|failure| panic!("{tolerance:e}, {past:e}: {failure}"));
        let off = worst(&run, off);
        assert!(off < 1e-8, "{tolerance:e}, {past:e}: {off:e}");
    }
}

/// A start may lie as near to the position as it likes, before it or behind: it is a state of a motion that has come from somewhere.
#[test]
fn starts_beside_singular_positions_are_as_good_as_others() {
    for off in [
        0.0, 1e-14, -1e-12, 1e-10, -1e-9, 3e-9, -1e-8, 1e-7, 1e-6, -1e-5, 1e-4,
    ] {
        let angle = FRAC_PI_2 + off;
        // At a right angle the cosine is known by what is off.
        let (s, c) = (angle.sin(), angle.cos());
        for (g, w, tolerance) in [
            (0.0, 2.0, 1e-4),
            (9.81, -7.0, 1e-6),
            (9.81, 5.5, 1e-8),
            (0.0, -1.0, 1e-10),
        ] {
            let crank = Crank {
                l: 1.0,
                g,
                ..Crank::default()
            }
            .prepared();
            let start = at(
                &[c / 2.0, s / 2.0, angle, 1.5 * c, s / 2.0, -angle, 2.0 * c],
                &[-s / 2.0, c / 2.0, 1.0, -1.5 * s, c / 2.0, -1.0, -2.0 * s].map(|x| x * w),
            );
            for method in [
                Method::Dop853,
                Method::Dopri5,
                Method::Radau5,
                Method::Rattle { step: 1e-3 },
            ] {
                let run = Simulation::new(&crank)
                    .start(start.clone())
                    .method(method)
                    .tolerance(tolerance);
                let run = run.every(0.1).until(1.5);
                let run = run.unwrap_or_else(|e| panic!("{method}, {off:e}, {w}: {e}"));
                let worst = worst(&run, |s| (s.q[6] - 2.0 * s.q[2].cos()).abs());
                assert!(
                    worst < 100.0 * tolerance.max(1e-10),
                    "{method}, {off:e}, {w}: {worst:e}"
                );
                assert!(
                    run.energy_drift() < 1e-2,
                    "{method}, {off:e}, {w}: {:e}",
                    run.energy_drift()
                );
            }
        }
    }
}

#[test]
fn what_is_passed_is_the_motion_in_the_branch_s_own_coordinate() {
    for (g, rate, until) in [
        (0.0, 5.5, 10.0),
        (9.81, 6.3, 4.0),
        (0.0, -4.2, 7.0),
        (0.0, 5.1, -6.0),
    ] {
        let angle = at(&[ANGLE], &[rate]);
        let own = CrankAngle {
            g,
            ..CrankAngle::default()
        };
        let exact = Simulation::new(own)
            .start(angle)
            .tolerance(1e-13)
            .until(until)
            .expect("a regular motion");
        let Case {
            mechanism, start, ..
        } = crank(1.0, g, rate);
        let run = Simulation::new(mechanism)
            .start(start)
            .tolerance(1e-11)
            .until(until);
        let run = run.unwrap_or_else(|failure| panic!("{failure}"));
        let (exact, found) = (exact.last().expect("an end"), run.last().expect("an end"));
        let errors = [found.q[2] - exact.q[0], found.v[2] - exact.v[0]];
        assert!(
            errors.iter().all(|e| e.abs() < 1e-8),
            "g = {g}, {rate}/s: {errors:?}"
        );
    }
}

#[test]
fn near_misses_turn_with_their_own_branch() {
    for gap in [1e-3, 1e-5, 1e-7, 1e-9] {
        for l in [1.0 + gap, 1.0 - gap] {
            let Case {
                mechanism, start, ..
            } = crank(l, 0.0, 4.3);
            let run = Simulation::new(mechanism).start(start).until(2.0);
            let run = run.unwrap_or_else(|failure| panic!("l = {l}: {failure}"));
            // A longer rod leaves the slider on its side of the bearing, a shorter one the crank.
            let side = |s: Sample<'_>| if l > 1.0 { s.q[6] } else { s.q[0] };
            let least = run.samples().map(side).fold(f64::INFINITY, f64::min);
            assert!(
                least > 0.0 && run.energy_drift() < 1e-7,
                "l = {l}: {least:e}, {:e}",
                run.energy_drift()
            );
        }
    }
    // Nobody can tell a gap of some roundings from none.
    let Case {
        mechanism, start, ..
    } = crank(1.0 + 1e-13, 0.0, 4.3);
    let failure = Simulation::new(mechanism)
        .start(start)
        .until(2.0)
        .expect_err("undecided");
    assert!(
        matches!(cause(&failure.error).1, Error::Singular { constraints } if constraints.iter().any(|c| c.starts_with("wrist_pin"))),
        "{failure}"
    );
    let first = 0.5 * std::f64::consts::PI;
    assert!(
        failure.trajectory.samples().all(|s| s.q[2] < first),
        "{failure}"
    );
}

#[test]
fn rattle_keeps_its_order_over_singular_positions() {
    let drift = |step: f64| {
        let Case {
            mechanism,
            start,
            off,
        } = crank(1.0, 9.81, 4.0);
        let run = Simulation::new(mechanism)
            .start(start)
            .method(Method::Rattle { step })
            .until(10.0);
        let run = run.unwrap_or_else(|failure| panic!("{failure}"));
        assert!(worst(&run, off) < 1e-11);
        run.energy_drift()
    };
    let (coarse, fine) = (drift(1e-2), drift(5e-3));
    assert!(coarse < 1e-5 && fine < coarse / 8.0, "{coarse:e}, {fine:e}");
}

ukcore::multibody! {
    /// A parallelogram in angles, weights on its cranks: along the line of the axles the row of its closing along that line vanishes.
    Linkage {
        params { g = 0.0 }
        coords { a, b, c }
        mass { a: 1, b: 1, c: 1.7 }
        potential { g * sin(a) }
        holonomic { l: [cos(a) + 2 * cos(b), sin(a) + 2 * sin(b)] = [2 + cos(c), sin(c)] }
    }
}

/// Such steps come to nothing before any row of A is small.
#[test]
fn rattle_goes_over_singular_positions_with_long_steps() {
    for (g, rate, size) in (1..=12).flat_map(|k| {
        let size = 0.025 * f64::from(k);
        [(0.0, 1.0), (0.0, 1.854), (0.7, 2.618)].map(|(g, rate)| (g, rate, size))
    }) {
        let (step, end) = (size / rate, 16.0 / rate);
        let start = at(&[0.3, 0.0, 0.3], &[rate, 0.0, rate]);
        let run = Simulation::new(Linkage { g }).method(Method::Rattle { step });
        let run = run.start(start).until(end);
        let run = run.unwrap_or_else(|failure| panic!("{g} {rate} {size}: {failure}"));
        // One of its cranks, with what both weigh.
        let [angle, _] = alone(&Pendulum { k: g / 2.7 }, [0.3, rate], end);
        let last = run.last().expect("an end");
        let off = (last.q[0] - angle).abs().max((last.q[2] - last.q[0]).abs());
        assert!(off < 1e-8 + 1e-4 * g * size, "{g} {rate} {size}: {off:e}");
    }
}

#[test]
fn rattle_goes_across_switches_after_a_singular_position() {
    let Case { start, off, .. } = crank(1.0, 0.0, 4.0);
    let run = Simulation::new(SpringCrank::default())
        .start(start)
        .method(Method::Rattle { step: 1e-3 })
        .until(4.0)
        .unwrap_or_else(|failure| panic!("{failure}"));
    assert!(
        worst(&run, off) < 1e-11 && run.energy_drift() < 1e-3,
        "{:e}",
        run.energy_drift()
    );
}

#[test]
fn members_of_an_ensemble_pass_as_they_do_alone() {
    let rates = [3.3, 5.5, 4.7];
    let members = rates.map(|rate| (Crank::default(), crank(1.0, 0.0, rate).start));
    let ends = Ensemble::new(members.to_vec()).until(2.0);
    for (rate, member) in rates.into_iter().zip(ends) {
        let Case {
            mechanism, start, ..
        } = crank(1.0, 0.0, rate);
        let alone = Simulation::new(mechanism)
            .start(start)
            .until(2.0)
            .unwrap_or_else(|failure| panic!("{failure}"));
        let member = member.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(
            Some(member.end.q.as_slice()),
            alone.last().map(|s| s.q),
            "{rate}/s"
        );
    }
}

ukcore::multibody! {
    /// Two wheels whose pins stay at one height: one branch turns them alike, the other against each other.
    Wheels {
        params { j = 1.0 }
        coords { th, ph }
        mass { th: 1.0, ph: j }
        holonomic { level: sin(th) = sin(ph) }
    }
}

/// A sample nearer to a node than the error allowed may be in the other branch as far as its place tells, not with the velocities of that.
#[test]
fn samples_of_the_implicit_method_beside_nodes_keep_their_velocities() {
    for (tolerance, dt) in [(1e-3, 0.1), (1e-4, 0.05)] {
        for k in 0..240 {
            let speed = 0.8 + 0.0417 * f64::from(k);
            let start = at(&[0.5, std::f64::consts::PI - 0.5], &[speed, -speed]);
            let run = Simulation::new(Wheels::default()).start(start);
            let run = run.method(Method::Radau5).tolerance(tolerance).every(dt);
            let run = run.until(8.0).expect("it goes straight on");
            for s in run.samples() {
                let off = (s.v[0] - speed).abs().max((s.v[1] + speed).abs());
                let what = format!("{tolerance:e}, {speed}, {}: {off:e}", s.t);
                assert!(off < 0.01 * speed, "{what}");
                assert!(
                    (s.q[0] - 0.5 - speed * s.t).abs() < 30.0 * tolerance,
                    "{what}"
                );
            }
        }
    }
}
