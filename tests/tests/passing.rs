//! Motions through singular positions, where constraints come to imply each other and branches of the motion cross: each goes on in the
//! branch it came on, by every method, or is refused before a sample is wrong. Where branches only come near, it turns with its own.

use models::FourBars;
use tests::hunted;
use ukcore::simulate::Sample;
use ukcore::{Ensemble, Error, Event, Mechanism, Method, Prepared, Simulation, State, Trajectory};

ukcore::multibody! {
    /// A slider-crank of three bodies. With l = r the slider can be at rest in the bearing, while crank and rod turn as one.
    Crank {
        params { l = 1.0, r = 1.0, m1 = 1.0, m2 = 1.0, m3 = 0.5, g = 0.0 }
        coords { x1, y1, th1, x2, y2, th2, x3 }
        mass { x1: m1, y1: m1, th1: m1 * sq(r) / 12.0, x2: m2, y2: m2, th2: m2 * sq(l) / 12.0, x3: m3 }
        potential { m1 * g * y1, m2 * g * y2 }
        let h1 = r / 2.0 * [cos(th1), sin(th1)];
        let h2 = l / 2.0 * [cos(th2), sin(th2)];
        holonomic {
            bearing: [x1, y1] = h1,
            crank_pin: [x1, y1] + h1 = [x2, y2] - h2,
            wrist_pin: [x2, y2] + h2 = [x3, 0.0],
        }
    }
}

ukcore::multibody! {
    /// The same with l = r and a spring of constant force that pulls the crank to the height of its bearing, from either side.
    SpringCrank {
        params { m = 1.0, m3 = 0.5, k = 3.0 }
        coords { x1, y1, th1, x2, y2, th2, x3 }
        mass { x1: m, y1: m, th1: m / 12.0, x2: m, y2: m, th2: m / 12.0, x3: m3 }
        potential { k * abs(y1) }
        let h1 = 0.5 * [cos(th1), sin(th1)];
        let h2 = 0.5 * [cos(th2), sin(th2)];
        holonomic {
            bearing: [x1, y1] = h1,
            crank_pin: [x1, y1] + h1 = [x2, y2] - h2,
            wrist_pin: [x2, y2] + h2 = [x3, 0.0],
        }
    }
}

ukcore::multibody! {
    /// The same with l = r, in the crank's angle th1 = −th2.
    CrankAngle {
        params { m1 = 1.0, m2 = 1.0, m3 = 0.5, g = 0.0 }
        coords { th }
        kinetic { 0.5 * sq(dot(th)) * (m1 / 3.0 + m2 / 12.0 + m2 * (2.25 * sq(sin(th)) + 0.25 * sq(cos(th))) + 4.0 * m3 * sq(sin(th))) }
        potential { (m1 + m2) * g * sin(th) / 2.0 }
    }
}

ukcore::multibody! {
    /// A slider-crank in its points, whose slider carries a pendulum: two degrees of freedom.
    CrankPendulum {
        params { l = 1.0, m = 1.0, mp = 0.3, lp = 0.7, g = 9.81 }
        coords { x, y, s, px, py }
        kinetic {
            m / 6.0 * (sq(dot(x)) + sq(dot(y))),
            m / 6.0 * (sq(dot(x)) + sq(dot(y)) + dot(x) * dot(s) + sq(dot(s))),
            0.25 * m * sq(dot(s)),
            0.5 * mp * (sq(dot(px)) + sq(dot(py))),
        }
        potential { m * g * y, mp * g * py }
        holonomic { crank: sq(x) + sq(y) = sq(l), rod: sq(s - x) + sq(y) = sq(l), string: sq(px - s) + sq(py) = sq(lp) }
    }
}

ukcore::multibody! {
    /// A parallelogram of three bodies, all of length 1.
    Parallelogram {
        params { m = 1.0, g = 0.0 }
        coords { x[3], y[3], a[3] }
        mass { for i in 0..3 { x[i]: m, y[i]: m, a[i]: m / 12.0 } }
        potential { for i in 0..3 { m * g * y[i] } }
        let half = |a| 0.5 * [cos(a), sin(a)];
        holonomic {
            ground: [x[0], y[0]] = half(a[0]),
            first: [x[0], y[0]] + half(a[0]) = [x[1], y[1]] - half(a[1]),
            second: [x[1], y[1]] + half(a[1]) = [x[2], y[2]] + half(a[2]),
            other_ground: [x[2], y[2]] - half(a[2]) = [1.0, 0.0],
        }
    }
}

ukcore::multibody! {
    /// Two parallelograms that share a crank: both lose rank at once.
    Parallelograms {
        params { m = 1.0, g = 0.0 }
        coords { x[5], y[5], a[5] }
        mass { for i in 0..5 { x[i]: m, y[i]: m, a[i]: m / 12.0 } }
        potential { for i in 0..5 { m * g * y[i] } }
        let half = |a| 0.5 * [cos(a), sin(a)];
        holonomic {
            ground: [x[0], y[0]] = half(a[0]),
            first: [x[0], y[0]] + half(a[0]) = [x[1], y[1]] - half(a[1]),
            second: [x[1], y[1]] + half(a[1]) = [x[2], y[2]] + half(a[2]),
            middle: [x[2], y[2]] - half(a[2]) = [1.0, 0.0],
            third: [x[2], y[2]] + half(a[2]) = [x[3], y[3]] - half(a[3]),
            fourth: [x[3], y[3]] + half(a[3]) = [x[4], y[4]] + half(a[4]),
            other_ground: [x[4], y[4]] - half(a[4]) = [2.0, 0.0],
        }
    }
}

ukcore::multibody! {
    /// A kite: ground and crank of length a, coupler and rocker of length b, which coincide where the crank lies on the ground.
    Kite {
        params { a = 1.0, b = 1.5, m = 1.0, g = 9.81 }
        coords { x, y, u, v }
        mass { x: m, y: m, u: m, v: m }
        potential { m * g * (y + v) }
        holonomic { crank: sq(x) + sq(y) = sq(a), coupler: sq(u - x) + sq(v - y) = sq(b), rocker: sq(u - a) + sq(v) = sq(b) }
    }
}

/// A mechanism and its start with a crank at 0.3 that turns at some rate, and how far a state is off the branch it started on.
struct Case {
    mechanism: Prepared,
    start: State,
    off: fn(Sample<'_>) -> f64,
}

const ANGLE: f64 = 0.3;
const CASES: [fn(f64) -> Case; 8] = [
    |w| crank(1.0, 0.0, w),
    |w| crank(1.0, 9.81, w),
    crank_pendulum,
    |w| parallelogram(0.0, w),
    |w| parallelogram(9.81, w),
    parallelograms,
    four_bars,
    kite,
];

/// A rod of length `l` beside a crank of length 1.
fn crank(l: f64, g: f64, w: f64) -> Case {
    let (s, c) = ANGLE.sin_cos();
    let rod = -(s / l).asin();
    let (sr, cr) = rod.sin_cos();
    let wr = -c * w / (l * cr);
    Case {
        mechanism: Crank {
            l,
            g,
            ..Crank::default()
        }
        .prepared(),
        start: State {
            t: 0.0,
            q: vec![
                c / 2.0,
                s / 2.0,
                ANGLE,
                c + l * cr / 2.0,
                s / 2.0,
                rod,
                c + l * cr,
            ],
            v: vec![
                -s / 2.0 * w,
                c / 2.0 * w,
                w,
                -s * w - l * sr * wr / 2.0,
                c / 2.0 * w,
                wr,
                -s * w - l * sr * wr,
            ],
        },
        off: |s| {
            (s.q[6] - 2.0 * s.q[2].cos())
                .abs()
                .max((s.q[2] + s.q[5]).sin().abs())
        },
    }
}

fn crank_pendulum(w: f64) -> Case {
    let ((s, c), (sb, cb)) = (ANGLE.sin_cos(), 0.4_f64.sin_cos());
    Case {
        mechanism: CrankPendulum::default().prepared(),
        start: State {
            t: 0.0,
            q: vec![c, s, 2.0 * c, 2.0 * c + 0.7 * sb, -0.7 * cb],
            v: vec![-s * w, c * w, -2.0 * s * w, -2.0 * s * w, 0.0],
        },
        off: |s| (s.q[2] - 2.0 * s.q[0]).abs(),
    }
}

/// Cranks at one angle, couplers level: centres and velocities of `count` rods in turn crank, coupler, crank, ….
fn parallel(count: usize, w: f64) -> State {
    let (s, c) = ANGLE.sin_cos();
    let mut state = State {
        t: 0.0,
        q: vec![0.0; 3 * count],
        v: vec![0.0; 3 * count],
    };
    for i in 0..count {
        let (share, along) = if i % 2 == 0 { (0.5, 0.0) } else { (1.0, 0.5) };
        state.q[i] = (i / 2) as f64 + along + share * c;
        state.q[count + i] = share * s;
        (state.v[i], state.v[count + i]) = (-share * s * w, share * c * w);
        if i % 2 == 0 {
            (state.q[2 * count + i], state.v[2 * count + i]) = (ANGLE, w);
        }
    }
    state
}

fn parallelogram(g: f64, w: f64) -> Case {
    Case {
        mechanism: Parallelogram {
            g,
            ..Parallelogram::default()
        }
        .prepared(),
        start: parallel(3, w),
        off: |s| s.q[7].sin().abs().max((s.q[6] - s.q[8]).sin().abs()),
    }
}

fn parallelograms(w: f64) -> Case {
    let off = |s: Sample<'_>| {
        let level = s.q[11].sin().abs().max(s.q[13].sin().abs());
        level
            .max((s.q[10] - s.q[12]).sin().abs())
            .max((s.q[10] - s.q[14]).sin().abs())
    };
    Case {
        mechanism: Parallelograms::default().prepared(),
        start: parallel(5, w),
        off,
    }
}

fn four_bars(w: f64) -> Case {
    let (s, c) = ANGLE.sin_cos();
    let mut start = State::zeros::<FourBars>();
    for (i, (&x, &y)) in FourBars::X.iter().zip(&FourBars::Y).enumerate() {
        (start.q[x], start.q[y]) = (i as f64 + c, s);
        (start.v[x], start.v[y]) = (-w * s, w * c);
    }
    let off = |s: Sample<'_>| {
        let lean = |i: usize| s.q[FourBars::X[i]] - i as f64 - s.q[FourBars::X[0]];
        (1..FourBars::X.len())
            .map(|i| lean(i).abs())
            .fold(0.0, f64::max)
    };
    Case {
        mechanism: FourBars::default().prepared(),
        start,
        off,
    }
}

/// The joint is on the bisector of ground and crank.
fn kite(w: f64) -> Case {
    let ((s, c), (sh, ch)) = (ANGLE.sin_cos(), (0.5 * ANGLE).sin_cos());
    let leg = (2.25 - sh * sh).sqrt();
    let (far, rate) = (ch + leg, -0.5 * sh - 0.5 * sh * ch / leg);
    Case {
        mechanism: Kite::default().prepared(),
        start: State {
            t: 0.0,
            q: vec![c, s, far * ch, far * sh],
            v: vec![
                -s * w,
                c * w,
                w * (rate * ch - 0.5 * far * sh),
                w * (rate * sh + 0.5 * far * ch),
            ],
        },
        off: |s| {
            let angle: f64 = s.q[1].atan2(s.q[0]);
            let (sin, cos) = (0.5 * angle).sin_cos();
            (s.q[3] * cos - s.q[2] * sin).abs()
        },
    }
}

fn worst(run: &Trajectory, off: fn(Sample<'_>) -> f64) -> f64 {
    run.samples()
        .map(off)
        .fold(0.0, |most: f64, x| if x <= most { most } else { x })
}

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
/// accuracy asked for by a hair, a crank that hovers beside its dead centre, samples on it that no step was planned for.
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
    ] {
        outcomes.case(number, rate, Method::Dop853, tolerance, 10.0);
    }
    assert!(
        outcomes.wrong.is_empty() && outcomes.refused == 0,
        "{outcomes:#?}"
    );
    for (rate, method, bound) in [
        (6.3809, Method::Radau5, 1e-3),
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

#[test]
fn runs_end_and_are_sampled_at_singular_positions() {
    let rate = 5.5;
    let angle = State {
        t: 0.0,
        q: vec![ANGLE],
        v: vec![rate],
    };
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

#[test]
fn what_is_passed_is_the_motion_in_the_branch_s_own_coordinate() {
    for (g, rate, until) in [
        (0.0, 5.5, 10.0),
        (9.81, 6.3, 4.0),
        (0.0, -4.2, 7.0),
        (0.0, 5.1, -6.0),
    ] {
        let angle = State {
            t: 0.0,
            q: vec![ANGLE],
            v: vec![rate],
        };
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
    let Error::At { source, .. } = &failure.error else {
        panic!("{failure}")
    };
    assert!(
        matches!(&**source, Error::Singular { constraints } if constraints.iter().any(|c| c.starts_with("wrist_pin"))),
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
