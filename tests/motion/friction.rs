//! Dry friction in the plane, v/|v| in each form in which it is written, straight through rest: closed forms of where a body stops, where
//! it is held and how it goes on.

use tests::{assert_all_close, assert_close, at, cause, worst};
use ukcore::simulate::{Direction, Ending, Sample, Switching};
use ukcore::{Ensemble, Error, Event, Mechanism, Method, Prepared, Simulation, Trajectory};

/// A puck on a spring from the origin, rubbed by a force of size `f`.
macro_rules! puck {
    ($(#[$doc:meta])* $name:ident, $speed:expr) => {
        ukcore::multibody! {
            $(#[$doc])*
            $name {
                params { f = 4.905, k = 0.0 }
                coords { x, y }
                mass { x: 1.0, y: 1.0 }
                potential { 0.5 * k * (sq(x) + sq(y)) }
                let along = f * ($speed);
                force { x: -along * dot(x), y: -along * dot(y) }
            }
        }
    };
}

puck!(
    /// By hypot.
    Hypot,
    1.0 / hypot(dot(x), dot(y))
);
puck!(
    /// By a root.
    Root,
    1.0 / sqrt(sq(dot(x)) + sq(dot(y)))
);
puck!(
    /// By a power.
    Power,
    (dot(x).powi(2) + dot(y).powi(2)).powf(-0.5)
);
puck!(
    /// By a norm.
    Norm,
    1.0 / norm(dot([x, y]))
);
puck!(
    /// With what keeps 0/0 away and softens nothing.
    Kept,
    1.0 / sqrt(sq(dot(x)) + sq(dot(y)) + 1e-30)
);
puck!(
    /// Softened, but stiff at rest.
    Softened,
    1.0 / sqrt(sq(dot(x)) + sq(dot(y)) + 1e-12)
);
puck!(
    /// Softened at velocities far below those of the motion.
    Hardly,
    1.0 / sqrt(sq(dot(x)) + sq(dot(y)) + 1e-16)
);

ukcore::multibody! {
    /// By `friction`.
    Friction {
        params { f = 4.905, k = 0.0 }
        coords { x, y }
        mass { x: 1.0, y: 1.0 }
        potential { 0.5 * k * (sq(x) + sq(y)) }
        let drag = friction(dot([x, y]), f);
        force { x: drag[0], y: drag[1] }
    }
}

const F: f64 = 4.905;

/// All forms on a spring of stiffness `k`.
fn forms(k: f64) -> [(&'static str, Prepared); 6] {
    macro_rules! form {
        ($name:ident) => {
            (
                stringify!($name),
                $name {
                    k,
                    ..$name::default()
                }
                .prepared(),
            )
        };
    }
    [
        form!(Hypot),
        form!(Root),
        form!(Power),
        form!(Norm),
        form!(Kept),
        form!(Friction),
    ]
}

const METHODS: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Radau5];

fn run(mechanism: &Prepared, along: [f64; 2], q: f64, v: f64) -> Simulation {
    let [q, v] = [q, v].map(|x| along.map(|part| x * part));
    Simulation::new(mechanism.clone()).start(at(&q, &v))
}

/// Coordinate along the line of the motion, from `q` with the velocity `v`, on a spring of stiffness `k`, until it is held.
fn slides(q: f64, v: f64, k: f64, t: f64) -> f64 {
    if k == 0.0 {
        let t = t.min(v / F);
        return q + v * t - 0.5 * F * t * t;
    }
    let w = k.sqrt();
    let (mut sign, mut t) = (v.signum(), t);
    // About the place where spring and friction balance.
    let (mut x, mut v) = (q + sign * F / k, v);
    loop {
        let (amplitude, phase) = (x.hypot(v / w), (-v / w).atan2(x));
        let turn = (if sign > 0.0 {
            0.0
        } else {
            std::f64::consts::PI
        } - phase)
            / w;
        let turn = turn.rem_euclid(2.0 * std::f64::consts::PI / w);
        if t <= turn {
            return amplitude * (w * t + phase).cos() - sign * F / k;
        }
        let there = sign * (amplitude - F / k);
        if (k * there).abs() <= F {
            return there;
        }
        (t, sign) = (t - turn, -sign);
        (x, v) = (there + sign * F / k, 0.0);
        // It begins where it turns.
        t = t.max(f64::MIN_POSITIVE);
    }
}

fn off(run: &Trajectory, along: [f64; 2], exact: impl Fn(f64) -> f64) -> f64 {
    let off = |s: Sample<'_>| {
        let x = exact(s.t);
        f64::hypot(s.q[0] - x * along[0], s.q[1] - x * along[1])
    };
    worst(run, off)
}

const LINES: [[f64; 2]; 3] = [[1.0, 0.0], [0.0, -1.0], [0.6, 0.8]];

#[test]
fn a_puck_that_comes_to_rest_stays_there_and_the_force_is_named() {
    for (k, q, v) in [(0.0, 0.0, 2.0), (3.0, 1.0, 2.0)] {
        for ((name, mechanism), along) in forms(k)
            .into_iter()
            .flat_map(|f| LINES.map(|l| (f.clone(), l)))
        {
            for (method, tolerance) in METHODS
                .into_iter()
                .flat_map(|m| [1e-4, 1e-7, 1e-10].map(|t| (m, t)))
            {
                let label = format!("{name}, k = {k}, {along:?}, {method}, {tolerance:e}");
                let run = run(&mechanism, along, q, v)
                    .method(method)
                    .tolerance(tolerance);
                let failure = run.until(9.0).expect_err(&label);
                let (_, told) = cause(&failure.error);
                let both = ["force on `x`", "force on `y`"];
                assert!(
                    matches!(told, Error::Chattering { terms, .. } if terms.iter().all(|t| both.contains(&&**t)) && terms.len() == 2),
                    "{label}: {told}"
                );
                let off = off(&failure.trajectory, along, |t| slides(q, v, k, t));
                let work = failure.trajectory.work();
                assert!(
                    off < 20.0 * tolerance && work.steps < 1000,
                    "{label}: {off:e}, {work:?}"
                );
            }
        }
    }
}

/// Where it stops late, at a tight tolerance, steps are lost in the rounding of the time before they have gone to and fro often.
#[test]
fn a_puck_that_stops_late_at_a_tight_tolerance_is_told_the_same() {
    for (name, mechanism) in forms(0.0) {
        for method in METHODS {
            for (tolerance, v) in [(1e-11, 90.0), (1e-12, 400.0), (1e-13, 30.0), (1e-13, 900.0)] {
                let label = format!("{name}, {method}, {tolerance:e}, {v}");
                let run = run(&mechanism, [0.6, 0.8], 0.0, v).method(method);
                let run = run.tolerance(tolerance).at(Vec::new());
                let failure = run.until(2.0 * v / F).expect_err(&label);
                let (_, told) = cause(&failure.error);
                let named = matches!(told, Error::Chattering { terms, .. } if terms.len() == 2);
                assert!(named, "{label}: {told}");
            }
        }
    }
}

#[test]
fn a_puck_that_a_spring_pulls_on_goes_on_through_rest() {
    let (k, q, v) = (60.0, 1.0, 2.0);
    for ((name, mechanism), along) in forms(k)
        .into_iter()
        .flat_map(|f| LINES.map(|l| (f.clone(), l)))
    {
        for (method, tolerance) in METHODS
            .into_iter()
            .flat_map(|m| [1e-5, 1e-9].map(|t| (m, t)))
        {
            let label = format!("{name}, {along:?}, {method}, {tolerance:e}");
            let run = run(&mechanism, along, q, v)
                .method(method)
                .tolerance(tolerance)
                .until(0.7);
            let run = run.unwrap_or_else(|failure| panic!("{label}: {failure}"));
            // Nothing steps onto a length: at each turn the error is that of a jump stepped across.
            let off = off(&run, along, |t| slides(q, v, k, t));
            assert!(off < 10.0 * tolerance.sqrt(), "{label}: {off:e}");
        }
    }
}

/// Steps that go across all switches, as those of ensembles, are told as soon that they come to nothing.
#[test]
fn a_puck_at_rest_ends_runs_across_switches_and_members_of_ensembles() {
    let told = |label: &str, error: &Error, k: f64| {
        let Error::At { t, q, source, .. } = error else {
            panic!("{label}: {error}")
        };
        let rest = LINES[2].map(|x| x * slides(0.0, 2.0, k, *t));
        assert!(
            matches!(&**source, Error::Chattering { terms, .. } if terms.len() == 2),
            "{label}: {source}"
        );
        assert_all_close(label, q, &rest, 1e-7);
    };
    for k in [0.0, 3.0] {
        for (name, mechanism) in forms(k) {
            for method in METHODS {
                let run = run(&mechanism, LINES[2], 0.0, 2.0).method(method);
                let failure = run.switching(Switching::Ignored).until(9.0);
                let failure = failure.expect_err(name);
                told(name, &failure.error, k);
                assert!(failure.trajectory.work().steps < 1000, "{name}, {method}");
            }
        }
        let puck = Hypot {
            k,
            ..Hypot::default()
        };
        let start = |v: f64| at(&[0.0; 2], &LINES[2].map(|x| x * v));
        // One of them does not come to rest before the end.
        let members = vec![(puck.clone(), start(2.0)), (puck, start(50.0))];
        let ends = Ensemble::new(members).max_steps(2000).until(1.0);
        let [rests, slides_on] = <[_; 2]>::try_from(ends).expect("two members");
        told("ensemble", &rests.expect_err("rest"), k);
        let there = slides(0.0, 50.0, k, 1.0);
        let end = slides_on.expect("it slides").end.q;
        assert_all_close("end", &end, &LINES[2].map(|x| x * there), 1e-6);
    }
}

/// What the messages of other methods advise: near rest velocities are known better than stiff positions would let them be.
#[test]
fn a_puck_that_is_hardly_softened_comes_to_rest_by_radau() {
    let hardly = Hardly::default().prepared();
    for (along, tolerance) in LINES
        .into_iter()
        .flat_map(|l| [1e-8, 1e-9, 1e-11].map(|t| (l, t)))
    {
        let run = run(&hardly, along, 0.0, 2.0)
            .method(Method::Radau5)
            .tolerance(tolerance);
        let run = run.max_steps(500).until(5.0);
        let run = run.unwrap_or_else(|failure| panic!("{along:?}, {tolerance:e}: {failure}"));
        let off = off(&run, along, |t| slides(0.0, 2.0, 0.0, t));
        assert!(off < 20.0 * tolerance, "{along:?}, {tolerance:e}: {off:e}");
    }
}

/// What the message advises.
#[test]
fn a_terminal_event_ends_the_run_at_rest() {
    let (v, least) = (2.0_f64, 1e-3_f64);
    for (name, mechanism) in forms(0.0) {
        for method in METHODS {
            let rest = Event::new("rest", move |_t, _q, v| v[0].hypot(v[1]) - least);
            let rest = rest.direction(Direction::Falling).terminal();
            let run = run(&mechanism, LINES[2], 0.0, v)
                .method(method)
                .tolerance(1e-10);
            let run = run.event(rest).until(9.0);
            let run = run.unwrap_or_else(|failure| panic!("{name}, {method}: {failure}"));
            assert_eq!(run.ending(), Ending::Event);
            let end = run.last().expect("an end");
            assert_close("time", end.t, (v - least) / F, 1e-8);
            let way = (v * v - least * least) / (2.0 * F);
            assert_all_close("place", end.q, &LINES[2].map(|x| x * way), 1e-8);
        }
    }
}

#[test]
fn at_rest_there_is_no_direction_and_it_is_said() {
    let undirected = forms(3.0).into_iter().filter(|(name, _)| *name != "Kept");
    for ((name, mechanism), q) in undirected.flat_map(|form| [0.0, 1.0].map(|q| (form.clone(), q)))
    {
        for method in METHODS {
            let failure = run(&mechanism, LINES[0], q, 0.0).method(method).until(1.0);
            let failure = failure.expect_err(name);
            let (_, told) = cause(&failure.error);
            assert!(
                matches!(told, Error::NoDirection { terms } if terms.len() == 2),
                "{name}, {method}: {told}"
            );
        }
    }
}

/// Near rest the Jacobian is stiff for velocities of 1e-6 only: stages that it says hardly change need not solve their equations.
#[test]
fn a_softened_puck_does_not_run_off() {
    let softened = Softened::default().prepared();
    let held = Friction {
        k: 3.0,
        ..Friction::default()
    }
    .prepared();
    for (mechanism, k, q) in [(softened, 0.0, 0.0), (held, 3.0, 1.0)] {
        for (along, tolerance) in LINES
            .into_iter()
            .flat_map(|l| [1e-3, 1e-4, 1e-5, 1e-7, 1e-9].map(|t| (l, t)))
        {
            let run = run(&mechanism, along, q, 2.0)
                .method(Method::Radau5)
                .tolerance(tolerance);
            let run = run.max_steps(3000).until(5.0);
            let run = run.unwrap_or_else(|failure| *failure.trajectory);
            let off = off(&run, along, |t| slides(q, 2.0, k, t));
            assert!(
                off < 20.0 * tolerance,
                "{k}, {along:?}, {tolerance:e}: {off:e}"
            );
            let end = run.last().expect("an end").t;
            assert!(end > 0.2, "{end}");
        }
    }
}

ukcore::multibody! {
    /// A bristle of a Dahl model on a spring's end: its deflection z follows the way, whatever the speed, and tends to ±1/k.
    Bristle {
        params { k = 100.0 }
        coords { x, z }
        mass { x: 1 }
        force { x: -9 * x }
        nonholonomic { bends: dot(z) = dot(x) - k * abs(dot(x)) * z }
    }
}

ukcore::multibody! {
    /// A constraint that jumps where the velocity turns, by little.
    Jerked {
        coords { x, z }
        mass { x: 1, z: 1 }
        force { x: -9 * x }
        nonholonomic { follows: dot(z) = 0.01 * sign(dot(x)) }
    }
}

ukcore::multibody! {
    /// A velocity that jumps at a place, beside another one that changes fast about it, and goes on.
    Geared {
        coords { x, z, w }
        mass { x: 1, w: 1 }
        potential { 4.5 * sq(x) }
        holonomic { follows: w = x + 0.1 * abs(x) }
        nonholonomic { gains: dot(z) = 1e4 * abs(x) }
    }
}

/// A step ends beside the zero of |ẋ| by what its tolerance allows; beside it constraints ask for other velocities in the other branch, and
/// at it for the same.
#[test]
fn constraints_with_the_size_of_a_velocity_go_on_where_it_turns() {
    // x = sin 3t; dz/dx is 1 − kz on the way up, 1 + kz on the way down.
    let (k, t_end) = (100.0, 10.0_f64);
    let (mut x, mut z, mut up) = (0.0, 0.0, true);
    let turns = (3.0 * t_end / std::f64::consts::PI + 0.5).floor() as usize;
    for end in (0..turns).map(|_| None).chain([Some((3.0 * t_end).sin())]) {
        let sign = if up { 1.0 } else { -1.0 };
        let to = end.unwrap_or(sign);
        z = sign / k + (z - sign / k) * (-k * sign * (to - x)).exp();
        (x, up) = (to, !up);
    }
    let methods = [Method::Dop853, Method::Dopri5, Method::Radau5];
    for (method, power) in methods
        .into_iter()
        .flat_map(|m| (4..13).map(move |p| (m, p)))
    {
        let tolerance = 10.0_f64.powi(-power);
        let start = at(&[0.0; 2], &[3.0; 2]);
        let run = Simulation::new(Bristle::default()).method(method);
        let run = run.tolerance(tolerance).start(start.clone()).until(t_end);
        let run = run.unwrap_or_else(|e| panic!("{method}, {tolerance:e}: {e}"));
        let end = run.last().expect("an end");
        let off = (end.q[0] - x).abs().max((end.q[1] - z).abs());
        assert!(
            off < 1e2 * tolerance + 1e-11,
            "{method}, {tolerance:e}: {off:e}"
        );
    }
    let start = at(&[0.0; 2], &[3.0, 0.01]);
    for method in methods {
        let run = Simulation::new(Jerked::default()).method(method);
        let run = run.tolerance(1e-6).start(start.clone()).until(t_end);
        assert!(run.is_err(), "{method}: a jump of a velocity");
        let start = at(&[0.5, 0.0, 0.55], &[3.0, 5e3, 3.3]);
        let run = Simulation::new(Geared::default()).method(method);
        let run = run.tolerance(1e-3).start(start).until(t_end);
        assert!(run.is_err(), "{method}: a jump beside what goes on");
    }
}
