//! Prescribed motions: rows that imply each other and contain the time, and times so late, or so fast a motion, that rounding of the time
//! is more than the error that is asked for.

use tests::{apart, at};
use ukcore::{Error, Mechanism, Method, Prepared, Simulation, State, Trajectory, assemble};

macro_rules! driven {
    ($($(#[$doc:meta])* $name:ident($($coordinate:ident),+) { $($sections:tt)+ })+) => {
        $(ukcore::multibody! {
            $(#[$doc])*
            #[allow(dead_code)]
            $name {
                params { a = 1.0, w = 1.0, k = 1.0 }
                coords { $($coordinate),+ }
                mass { $($coordinate: 1.0),+ }
                let now = a * sin(w * t);
                $($sections)+
            }
        })+
    };
}

driven! {
    /// Nothing redundant.
    Alone(x) { holonomic { on: x = now } }
    Squared(x) { holonomic { on: x = now, again: k * sq(x + 2 * a) = k * sq(now + 2 * a) } }
    SquaredFirst(x) { holonomic { again: k * sq(x + 2 * a) = k * sq(now + 2 * a), on: x = now } }
    /// The square's gradient vanishes where x does.
    Vanishing(x) { holonomic { on: x = now, again: k * sq(x) = k * sq(now) } }
    Exponential(x) { holonomic { on: x = now, again: k * exp(x / a) = k * exp(sin(w * t)) } }
    Thrice(x) {
        holonomic { on: x = now, again: k * sq(x + 2 * a) = k * sq(now + 2 * a), third: (x + 3 * a).powi(3) = (now + 3 * a).powi(3) }
    }
    Circle(x, y) { holonomic { on: x = now, up: y = a * cos(w * t), again: k * (sq(x) + sq(y)) = k * sq(a) } }
    Product(x, y) { holonomic { on: x = now, up: y = a * (1 + sq(sin(w * t))), again: k * x * y = k * now * a * (1 + sq(sin(w * t))) } }
    Rates(x) { holonomic { on: x = now } nonholonomic { again: k * sq(dot(x) + 2 * a * w) = k * sq(a * w * cos(w * t) + 2 * a * w) } }
    /// Comes apart with the third power of the time.
    Apart(x) { holonomic { on: x = now, again: k * sq(x + 2 * a) = k * sq(now + 2 * a + 1e-3 * a * (w * t).powi(3)) } }
}

/// What happened, without its time.
fn cause(error: Error) -> Error {
    match error {
        Error::At { source, .. } => *source,
        error => error,
    }
}

fn run(mechanism: &Prepared, method: Method, span: f64) -> Result<Trajectory, Error> {
    let n = mechanism.spec().n();
    let (a, w) = (mechanism.get("a")?, mechanism.get("w")?);
    let state = |first: f64, second: f64| [first, second][..n].to_vec();
    let guess = at(&state(0.0, a), &state(a * w, 0.0));
    let start = assemble(mechanism, &guess, &[])?;
    let run = Simulation::new(mechanism)
        .start(start)
        .method(method)
        .until(span / w);
    run.map_err(|failure| cause(failure.error))
}

/// All amplitudes, frequencies and scales of the redundant row.
fn each<M: Mechanism + Default>(check: impl Fn(&str, &Prepared, Method)) {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for (a, w) in [
            (1.0, 1.0),
            (1.0, 1e3),
            (1e-6, 50.0),
            (1e6, 1e-3),
            (1e-9, 1.0),
        ] {
            for k in [1.0, 1e-6, 1e6] {
                let mut mechanism: Prepared = M::default().prepared();
                for (name, value) in [("a", a), ("w", w), ("k", k)] {
                    mechanism.set(name, value).expect("declared");
                }
                let place = format!(
                    "{} a = {a:e}, w = {w:e}, k = {k:e} by {method}",
                    M::SPEC.name
                );
                check(&place, &mechanism, method);
            }
        }
    }
}

fn as_alone<M: Mechanism + Default>() {
    each::<M>(|place, mechanism, method| {
        let mut alone: Prepared = Alone::default().prepared();
        let (a, w) = (
            mechanism.get("a").expect("declared"),
            mechanism.get("w").expect("declared"),
        );
        alone.set("a", a).expect("declared");
        alone.set("w", w).expect("declared");
        let alone = run(&alone, method, 4.0).unwrap_or_else(|e| panic!("{place}, alone: {e}"));
        let found = run(mechanism, method, 4.0).unwrap_or_else(|e| panic!("{place}: {e}"));
        let last = found.last().expect("it has an end");
        let (x, v) = (a * (w * last.t).sin(), a * w * (w * last.t).cos());
        assert!((last.q[0] - x).abs() <= 1e-13 * a, "{place}: {last:?}");
        assert!((last.v[0] - v).abs() <= 1e-12 * a * w, "{place}: {last:?}");
        // Off the constraints redundant rows disagree, so stages are not exact as those of x = f(t) are; but no more than that.
        let (steps, expected) = (found.work().steps, alone.work().steps);
        assert!(
            steps <= 4 * expected + 40,
            "{place}: {steps} steps for {expected}"
        );
    });
}

#[test]
fn redundant_rows_in_time_cost_little() {
    as_alone::<Squared>();
    as_alone::<SquaredFirst>();
    as_alone::<Vanishing>();
    as_alone::<Exponential>();
    as_alone::<Thrice>();
    as_alone::<Circle>();
    as_alone::<Product>();
    as_alone::<Rates>();
}

#[test]
fn rows_that_come_apart_are_named() {
    each::<Apart>(|place, mechanism, method| {
        let error = run(mechanism, method, 4.0).expect_err(place);
        let (Error::Inconsistent { constraints } | Error::OffConstraint { constraints, .. }) =
            &error
        else {
            panic!("{place}: {error}");
        };
        let names: Vec<&str> = constraints.iter().map(|(name, _)| name.as_str()).collect();
        assert!(
            names.contains(&"on") && names.contains(&"again"),
            "{place}: {error}"
        );
    });
}

ukcore::multibody! {
    /// A pendulum on a shaking pivot, upright.
    Shaken {
        params { a = 0.1, w = 100.0, l = 1.0, g = 9.81 }
        coords { s, x, y }
        mass { s: 1, x: 1, y: 1 }
        potential { g * y }
        holonomic { pivot: s = a * cos(w * t), rod: sq(x) + sq(y - s) = sq(l) }
    }
}

ukcore::multibody! {
    /// A slide that jumps, in place or velocity.
    Jumps {
        params { h = 0.0, r = 0.0, at = 0.5 }
        coords { x }
        mass { x: 1 }
        holonomic { slide: x = h * sign(t - at) + r * abs(t - at) }
    }
}

/// From t0, or with the frequency `w` for as many turns, at the tolerance.
fn shaken(t0: f64, w: f64, tolerance: f64, method: Method) -> Trajectory {
    // A whole number of turns from t = 0, as nearly as there is one.
    let turn = 2.0 * std::f64::consts::PI / w;
    let t = (t0 / turn).round() * turn;
    let mechanism = Shaken {
        w,
        a: 10.0 / w,
        ..Shaken::default()
    };
    let guess = State {
        t,
        q: vec![10.0 / w, 0.1, 1.1],
        v: vec![0.0; 3],
    };
    let start = assemble(&mechanism, &guess, &["x"]).expect("on a circle");
    let run = Simulation::new(&mechanism)
        .start(start)
        .tolerance(tolerance)
        .method(method);
    run.until(t + 100.0 / w)
        .unwrap_or_else(|e| panic!("from {t0:e} at {w:e} to {tolerance:e}: {e}"))
}

#[test]
fn rounding_of_the_time_is_no_jump() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for (t0, w) in [
            (0.0, 100.0),
            (1e3, 100.0),
            (1e6, 100.0),
            (3e7, 100.0),
            (1.0, 1e9),
            (1e-3, 1e12),
            (-1e6, 100.0),
        ] {
            let (expected, found) = (shaken(0.0, w, 1e-9, method), shaken(t0, w, 1e-9, method));
            let pair = [&expected, &found].map(|run| run.last().expect("it has an end"));
            // Rounding of the phase, and what the motion makes of it.
            let bound = 1e-7 + 1e3 * f64::EPSILON * t0.abs() * w;
            let (q, v) = (
                apart(pair[0].q, pair[1].q),
                apart(pair[0].v, pair[1].v) / 10.0,
            );
            assert!(
                q <= bound && v <= bound,
                "{method} from {t0:e}, w = {w:e}: {q:e}, {v:e}"
            );
        }
        assert!(
            shaken(0.0, 100.0, 3e-14, method)
                .residuals()
                .iter()
                .all(|r| r.largest() < 1e-11)
        );
    }
}

#[test]
fn jumps_are_named_early_and_late() {
    for (t0, tolerance) in [(0.0, 1e-9), (0.0, 1e-13), (1e3, 1e-9), (1e6, 1e-6)] {
        for (h, r) in [(0.1, 0.0), (0.0, 0.1), (1e-3, 0.0)] {
            let mechanism = Jumps { h, r, at: t0 + 0.5 };
            let start = assemble(
                &mechanism,
                &State {
                    t: t0,
                    q: vec![0.0],
                    v: vec![0.0],
                },
                &[],
            )
            .expect("one row");
            let run = Simulation::new(&mechanism)
                .start(start)
                .tolerance(tolerance)
                .until(t0 + 1.0);
            let error = cause(run.expect_err("it jumps").error);
            assert!(
                matches!(&error, Error::Jump { constraints, .. } if constraints[0].0 == "slide"),
                "{t0:e} {h} {r}: {error}"
            );
        }
    }
}

ukcore::multibody! {
    /// A bead on a hoop that is turned about its upright diameter.
    Hoop {
        params { w = 3.0 }
        coords { x, y, z }
        mass { x: 1, y: 1, z: 1 }
        potential { 9.81 * z }
        holonomic { sphere: sq(x) + sq(y) + sq(z) = 1, plane: x * sin(w * t) = y * cos(w * t) }
        output { angle = atan2(x * cos(w * t) + y * sin(w * t), -z) }
    }
}

/// Late, the time is known to seven digits, and with it all that a drive does: shorter steps make that no better, and are not taken.
#[test]
fn tolerances_below_the_rounding_of_a_late_time_cost_no_flood() {
    let hoop = Hoop::default();
    let angle = |t0: f64, method: Method| {
        let phase = hoop.w * t0;
        let (sin, cos) = phase.sin_cos();
        let (r, z) = (0.4_f64.sin(), -0.4_f64.cos());
        let v = hoop.w * r;
        let (q, v) = (vec![r * cos, r * sin, z], vec![-v * sin, v * cos, 0.0]);
        let run = Simulation::new(&hoop)
            .start(State { t: t0, q, v })
            .method(method)
            .tolerance(1e-12)
            .every(0.125)
            .until(t0 + 2.0);
        let run = run.unwrap_or_else(|e| panic!("{method} from {t0:e}: {e}"));
        (run.output("angle").expect("declared"), run.work())
    };
    for method in [Method::Dop853, Method::Dopri5] {
        let (expected, _) = angle(0.0, method);
        let (found, work) = angle(1e9, method);
        let off = apart(&expected, &found);
        assert!(off < 1e-6, "{method}: {off:e}");
        assert!(
            work.evaluations < 100_000 && work.rounded > 0,
            "{method}: {work:?}"
        );
    }
}

ukcore::multibody! {
    /// A gait: drives that differ by phases that are numbers, parameters, both, and turned about.
    pub Gait {
        const N: usize = 5;
        params { a = 0.3, w = 2.5, lag = 0.7, late = 1e6 }
        coords { fin[N], other, back, ahead, apart, from, plain }
        mass { fin: 1, other: 1, back: 1, ahead: 1, apart: 1, from: 1, plain: 1 }
        holonomic {
            for i in 0..N { swing[i]: fin[i] = a * sin(w * t + 2 * PI * i / N) }
            drive: other = a * cos(w * t - lag)
            turned: back = a * sin(lag - w * t - 1)
            odd: ahead = a * cos(2 * lag - w * t)
            // Another frequency, and a time that is counted from late on.
            slow: apart = a * sin(0.5 * w * t + lag)
            counted: from = a * sin(2.5 * (t - late))
            by_number: plain = a * sin(2.5 * t)
        }
    }
}

/// Sines that follow from each other are as right as sines by themselves, also at late times.
#[test]
fn gaits_are_what_their_phases_say() {
    let gait = Gait::default();
    let Gait { a, w, lag, late } = gait;
    let gait = Prepared::from(gait);
    for t in [
        0.0,
        1e-9,
        0.3,
        2.0 * std::f64::consts::PI / w,
        -7.1,
        1e3,
        1e6,
        1e6 + 0.25,
    ] {
        let turns = (0..5).map(|i| w * t + 2.0 * std::f64::consts::PI * f64::from(i) / 5.0);
        let mut angles: Vec<f64> = turns.collect();
        let quarter = std::f64::consts::FRAC_PI_2;
        let others = [
            w * t - lag + quarter,
            lag - w * t - 1.0,
            2.0 * lag - w * t + quarter,
        ];
        angles.extend(
            others
                .into_iter()
                .chain([0.5 * w * t + lag, w * (t - late), w * t]),
        );
        let rates = [w, w, w, w, w, w, -w, -w, 0.5 * w, w, w];
        let q: Vec<f64> = angles.iter().map(|angle| a * angle.sin()).collect();
        let pairs = angles.iter().zip(rates);
        let v: Vec<f64> = pairs
            .clone()
            .map(|(angle, rate)| a * rate * angle.cos())
            .collect();
        let expected: Vec<f64> = pairs
            .map(|(angle, rate)| -a * rate * rate * angle.sin())
            .collect();
        let mut found = vec![0.0; 11];
        assert!(gait.acceleration(t, &q, &v, &mut found) > 0.0);
        let off = 8.0 * f64::EPSILON * (w * t).abs().max(1.0) * a * w * w;
        tests::assert_all_close(&format!("at {t}"), &found, &expected, off);
        let mut residual = vec![0.0; 11];
        gait.residual(t, &q, &mut residual);
        tests::assert_all_close(&format!("residuals at {t}"), &residual, &[0.0; 11], off);
        // Nothing is lost where time is counted from late on.
        if t >= late {
            tests::assert_close("counted from late on", found[9], expected[9], 1e-15);
        }
    }
}

ukcore::multibody! {
    /// A mass on a spring whose other end is driven.
    OnSpring {
        params { l = 1.0, w = 3.0 }
        coords { s, r }
        mass { s: 1, r: 1 }
        potential { 2 * sq(r - s) }
        holonomic { motor: s = l * sin(w * t) }
    }
}

/// The absolute tolerance is that of the coordinates, not that of the time.
#[test]
fn small_motions_are_as_exact_late_as_early() {
    let times = [0.0, 1e2, 1e4, 1e6].into_iter();
    for (t, l) in times.flat_map(|t| [1e-3, 1e-6, 1e-9].map(|l| (t, l))) {
        let state = |t: f64| {
            let (sin, cos) = (3.0 * t).sin_cos();
            let (q, v) = (
                vec![l * sin, -0.8 * l * sin],
                vec![3.0 * l * cos, -2.4 * l * cos],
            );
            State { t, q, v }
        };
        for (method, tolerance) in [
            (Method::Dop853, 1e-6),
            (Method::Dop853, 1e-8),
            (Method::Dopri5, 1e-6),
            (Method::Radau5, 1e-6),
        ] {
            let mechanism = OnSpring {
                l,
                ..OnSpring::default()
            };
            let run = Simulation::new(mechanism)
                .method(method)
                .tolerance(tolerance);
            let run = run.start(state(t)).until(t + 10.0).expect("a motion");
            let (end, there) = (run.last().expect("an end"), state(t + 10.0));
            let off = (end.q[1] - there.q[1])
                .abs()
                .max((end.v[1] - there.v[1]).abs());
            assert!(
                off <= 10.0 * tolerance * l,
                "{method}, {tolerance:e}, l = {l:e}, from {t:e}: {:e}",
                off / l
            );
        }
    }
}
