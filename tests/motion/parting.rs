//! Places where motions meet that part again: a state tells no more in which way one goes on. Nonholonomic rows that vanish where all
//! motions lead, and branches that touch. Where a direction tells them apart, or one of them is smooth alone, a motion goes on.

use tests::{assert_close, at, cause};
use ukcore::{Error, Mechanism, Method, Simulation, State, Trajectory};

ukcore::multibody! {
    /// Motions along y = c xⁿ, all of which lead through the origin.
    Pencil {
        params { n = 2.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        nonholonomic { c: x * dot(y) = n * y * dot(x) }
    }
}

ukcore::multibody! {
    /// A dog that runs towards a hare.
    Pursuit {
        params { c = 2.0, v = 1.0, a = 1.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        nonholonomic { aim: dot(y) * (a - x) = dot(x) * (v * t - y), speed: sq(dot(x)) + sq(dot(y)) = sq(c) }
    }
}

ukcore::multibody! {
    /// The same on a blade, by a heading that looks at the hare: what both rows have beside each other is lost.
    Blade {
        params { v = 1.0, a = 1.0 }
        bodies { planar dog { mass: 1, inertia: 0.01 } }
        holonomic { look: cross(dog.along([1, 0]), [a, v * t] - dog.centre) = 0 }
        nonholonomic { blade: inner(dog.along([0, 1]), dot(dog.centre)) = 0 }
    }
}

ukcore::multibody! {
    /// Two parabolas that touch in the origin.
    Parabolas {
        params { k = 2.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        holonomic { c: (y - sq(x)) * (y - k * sq(x)) = 0 }
    }
}

ukcore::multibody! {
    /// Two cubics that do.
    Cubics {
        coords { x, y }
        mass { x: 1, y: 1 }
        holonomic { c: (y - x.powi(3)) * (y + x.powi(3)) = 0 }
    }
}

ukcore::multibody! {
    /// Three lines through the origin.
    Lines {
        coords { x, y }
        mass { x: 1, y: 1 }
        holonomic { c: y * (y - x) * (y + x) = 0 }
    }
}

ukcore::multibody! {
    /// A point that turns about the origin at a given rate, and moves freely along its radius.
    Turning {
        params { w = 1.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        nonholonomic { turn: x * dot(y) - y * dot(x) = w * (sq(x) + sq(y)) }
    }
}

ukcore::multibody! {
    /// Rows with factors that vanish at a time and at a place, and directions of their own.
    Factors {
        coords { x, y, s }
        mass { x: 1, y: 1, s: 1 }
        nonholonomic {
            a: (t - 0.7) * (dot(y) - 0.5 * dot(x)) = 0.0
            b: (s - 0.3) * (dot(s) - dot(x) * (1 + 0.3 * x)) = 0.0
        }
    }
}

const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];
const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-9, 1e-12];

ukcore::multibody! {
    /// Motions along y = c (x² + e²)^{n/2}: the row comes near to zero only.
    Missed {
        params { e = 0.03, n = 3.0 }
        coords { x, y }
        mass { x: 1, y: 1 }
        nonholonomic { c: (sq(x) + sq(e)) * dot(y) = n * x * y * dot(x) }
    }
}

ukcore::multibody! {
    /// Rows that fade, and never are zero.
    Fading {
        coords { r, y, z }
        mass { r: 1, y: 1, z: 1 }
        nonholonomic { a: dot(r) = -r, b: r * dot(y) = 2 * y * dot(r) }
        holonomic { c: z * (z + exp(-3 * t)) = 0 }
    }
}

ukcore::multibody! {
    /// Two parabolas that come near each other.
    Near {
        params { e = 1e-6 }
        coords { x, y }
        mass { x: 1, y: 1 }
        holonomic { c: (y - sq(x)) * (y - 2 * sq(x)) = e }
    }
}

ukcore::multibody! {
    /// Two rows that vanish at once: by the first one motions keep a direction, by the second they all meet.
    Both {
        params { n = 1.0, k = 3.0 }
        coords { x, y, z }
        mass { x: 1, y: 1, z: 1 }
        nonholonomic { c: x * dot(y) = n * y * dot(x), d: x * dot(z) = k * z * dot(x) }
    }
}

/// A run, or when it ends before a position, and the constraints that it names.
type Run = Result<Trajectory, (f64, Vec<String>)>;

/// Runs by all methods at all tolerances.
fn runs(
    mechanism: impl Mechanism,
    start: &State,
    until: f64,
) -> impl Iterator<Item = (String, f64, Run)> {
    let settings = METHODS.into_iter().flat_map(|m| TOLERANCES.map(|t| (m, t)));
    settings.map(move |(method, tolerance)| {
        let what = format!("{method}, {tolerance:e}");
        let run = Simulation::new(mechanism.clone()).start(start.clone());
        let run = run.method(method).tolerance(tolerance).until(until);
        let run = run.map_err(|failure| match cause(&failure.error) {
            (t, Error::Singular { constraints }) => (t, constraints.clone()),
            (t, other) => panic!("{what}: at {t}: {other}"),
        });
        (what, tolerance, run)
    })
}

/// All of them end before they are at the place, at the time `t`, and name it.
fn all_end(mechanism: impl Mechanism, start: &State, t: f64, name: &str) {
    let label = format!("{name} at {t}");
    for (what, tolerance, run) in runs(mechanism, start, 2.0 * t) {
        let (end, constraints) = run.expect_err(&format!("{label}, {what}"));
        let told = constraints.iter().any(|c| c == name);
        assert!(told, "{label}, {what}: {constraints:?}");
        let near = (0.95 * t..t + (1e-6_f64).max(10.0 * tolerance)).contains(&end);
        assert!(near, "{label}, {what}: {end} for {t}");
    }
}

#[test]
fn rows_that_vanish_where_all_motions_lead_end_them() {
    for n in [1.3, 1.5, 2.0, 3.0, 4.0] {
        let pencil = Pencil { n };
        let start = at(&[-1.0, 0.3], &[1.0, -0.3 * n]);
        // By its speed along the curve.
        let length: f64 = (0..1000)
            .map(|k| (f64::from(k) + 0.5) / 1000.0)
            .map(|x| (1.0 + (0.3 * n * x.powf(n - 1.0)).powi(2)).sqrt() / 1000.0)
            .sum();
        let t = length / (1.0 + 0.09 * n * n).sqrt();
        for (what, _, run) in runs(pencil, &start, 2.0 * t) {
            let (end, constraints) = run.expect_err(&format!("{n}, {what}"));
            assert_eq!(constraints, ["c"], "{n}, {what}");
            assert!(
                (0.9 * t..1.001 * t).contains(&end),
                "{n}, {what}: {end} for {t}"
            );
        }
    }
    for c in [1.1, 1.5, 2.0, 3.0, 10.0] {
        let dog = Pursuit {
            c,
            ..Pursuit::default()
        };
        all_end(dog, &at(&[0.0, 0.0], &[c, 0.0]), c / (c * c - 1.0), "aim");
    }
}

#[test]
fn so_does_a_second_row() {
    let start = at(&[-1.0, 0.3, 0.4], &[1.0, -0.3, -1.2]);
    for (what, tolerance, run) in runs(Both::default(), &start, 2.0) {
        if tolerance <= 1e-6 {
            let (_, constraints) = run.expect_err(&what);
            assert_eq!(constraints, ["d"], "{what}");
        }
    }
}

/// Rows that only come near to zero, soon or late, part nothing.
#[test]
fn near_misses_go_on() {
    for e in [0.1, 0.03] {
        let (n, c) = (3.0, 0.3);
        let curve = |x: f64| c * (x * x + e * e).powf(0.5 * n);
        let start = at(&[-1.0, curve(1.0)], &[1.0, -n * curve(1.0) / (1.0 + e * e)]);
        for (what, tolerance, run) in runs(Missed { e, n }, &start, 2.0) {
            let run = run.unwrap_or_else(|told| panic!("{e}, {what}: {told:?}"));
            let end = run.last().expect("an end");
            if tolerance < 1e-8 {
                assert_close(&what, end.q[1], curve(end.q[0]), 1e4 * tolerance);
            }
        }
    }
    let start = at(&[1.0, 0.5, 0.0], &[-1.0, -1.0, 0.0]);
    for (what, tolerance, run) in runs(Fading::default(), &start, 6.0) {
        let run = run.unwrap_or_else(|told| panic!("{what}: {told:?}"));
        let end = run.last().expect("an end");
        assert_close(&what, end.q[0], (-6.0_f64).exp(), 1e2 * tolerance);
    }
    for e in [1e-4, 1e-6, 1e-8] {
        let upper = |x: f64| 1.5 * x * x - (0.25 * x.powi(4) + e).sqrt();
        let slope = (upper(-1.0 + 1e-6) - upper(-1.0 - 1e-6)) / 2e-6;
        let start = at(&[-1.0, upper(-1.0)], &[1.0, slope]);
        let start = ukcore::assemble(Near { e }, &start, &["x"]).expect("a start");
        for (what, _, run) in runs(Near { e }, &start, 1.5) {
            let run = run.unwrap_or_else(|told| panic!("{e}, {what}: {told:?}"));
            let end = run.last().expect("an end");
            assert_close(&what, end.q[1], upper(end.q[0]), 1e-3);
        }
    }
}

#[test]
fn so_do_rows_beside_each_other() {
    for c in [1.3, 1.7, 2.2] {
        let start = at(&[0.0; 3], &[c, 0.0, 1.0]);
        all_end(Blade::default(), &start, c / (c * c - 1.0), "blade");
    }
}

/// At loose tolerances a motion may pass in its own branch.
#[test]
fn branches_that_touch_end_motions_or_keep_them() {
    let check = |what: &str, run: Run, branch: &dyn Fn(f64) -> f64| match run {
        Ok(run) => {
            let end = run.last().expect("an end");
            assert_close(what, end.q[1], branch(end.q[0]), 1e-3);
        }
        Err((_, constraints)) => assert_eq!(constraints, ["c"], "{what}"),
    };
    let mut named = 0;
    for (k, own) in [(2.0, 1.0), (2.0, 2.0), (-1.0, 1.0)] {
        let start = at(&[-1.0, own], &[1.0, -2.0 * own]);
        for (what, _, run) in runs(Parabolas { k }, &start, 2.0) {
            named += usize::from(run.is_err());
            check(&what, run, &|x| own * x * x);
        }
    }
    let start = at(&[-1.0, -1.0], &[1.0, 3.0]);
    for (what, _, run) in runs(Cubics::default(), &start, 2.0) {
        named += usize::from(run.is_err());
        check(&what, run, &|x| x.powi(3));
    }
    assert!(named > 35, "{named}");
}

#[test]
fn motions_with_directions_of_their_own_go_on() {
    for (slope, start) in [
        (0.0, at(&[-1.0, 0.0], &[1.0, 0.0])),
        (1.0, at(&[-1.0, -1.0], &[1.0, 1.0])),
    ] {
        for (what, _, run) in runs(Lines::default(), &start, 2.0) {
            let run = run.unwrap_or_else(|e| panic!("{what}: {e:?}"));
            let end = run.last().expect("an end");
            assert_close(&what, end.q[0], 1.0, 1e-9);
            assert_close(&what, end.q[1], slope, 1e-9);
        }
    }
    for (what, _, run) in runs(Pencil { n: 1.0 }, &at(&[-1.0, 0.3], &[1.0, -0.3]), 2.0) {
        let run = run.unwrap_or_else(|e| panic!("{what}: {e:?}"));
        let end = run.last().expect("an end");
        assert_close(&what, end.q[1], -0.3 * end.q[0], 1e-9);
    }
    for speed in [1.3, 1.9, 2.7] {
        // The radius is cosh t − u sinh t.
        for (what, tolerance, run) in
            runs(Turning::default(), &at(&[1.0, 0.0], &[-speed, 1.0]), 2.0)
        {
            let run = run.unwrap_or_else(|e| panic!("{speed}, {what}: {e:?}"));
            let end = run.last().expect("an end");
            let radius = 2.0_f64.cosh() - speed * 2.0_f64.sinh();
            let most = 1e4 * tolerance.max(1e-12);
            assert_close(&what, end.q[0], radius * 2.0_f64.cos(), most);
            assert_close(&what, end.q[1], radius * 2.0_f64.sin(), most);
        }
    }
    for (what, tolerance, run) in runs(Factors::default(), &at(&[0.0; 3], &[1.0, 0.5, 1.0]), 2.0) {
        let run = run.unwrap_or_else(|e| panic!("{what}: {e:?}"));
        let end = run.last().expect("an end");
        let [x, y, s] = [end.q[0], end.q[1], end.q[2]];
        assert_close(&what, y, 0.5 * x, 1e3 * tolerance);
        assert_close(&what, s, x + 0.15 * x * x, 1e3 * tolerance);
    }
}
