//! Units change nothing: a mechanism in units of length, mass and time that are 1e-9 … 1e9 of others has the same accelerations, the same
//! rank, the same redundant constraints, and takes the same steps over its singular positions. Where the factors are powers of two all
//! this is the same bit for bit.

use tests::{assert_close, at, cause, solver_by};
use ukcore::solver::{Formula, SolverOptions};
use ukcore::{Error, Mechanism, Method, Prepared, Simulation, Solver, State};

/// Powers of length, mass and time.
type Dimension = [i32; 3];

const NUMBER: Dimension = [0, 0, 0];
const LENGTH: Dimension = [1, 0, 0];
const MASS: Dimension = [0, 1, 0];
const INERTIA: Dimension = [2, 1, 0];
const GRAVITY: Dimension = [1, 0, -2];
const FORCE: Dimension = [1, 1, -2];
const TORQUE: Dimension = [2, 1, -2];
const RATE: Dimension = [0, 0, -1];

ukcore::multibody! {
    /// A scissor lift of three stages under a platform that two guides keep level: one row follows from the others anywhere, more where
    /// it lies flat. Bar 2i rises to the right, bar 2i + 1 to the left.
    Scissors {
        const N: usize = 3;
        params { h = 0.5, m = 1.0, j = 0.09, g = 0.0 }
        coords { x[2 * N], y[2 * N], a[2 * N], px, py, pa }
        mass { for i in 0..2 * N { x[i]: m, y[i]: m, a[i]: j } px: m, py: m, pa: j }
        potential { for i in 0..2 * N { m * g * y[i] } m * g * py }
        let half = |a| h * [cos(a), sin(a)];
        holonomic {
            foot: [x[0], y[0]] - half(a[0]) = [0.0, 0.0],
            roller: y[1] - h * sin(a[1]) = 0.0,
            for i in 0..N { middle[i]: [x[2 * i], y[2 * i]] = [x[2 * i + 1], y[2 * i + 1]] }
            for i in 0..N - 1 {
                right[i]: [x[2 * i], y[2 * i]] + half(a[2 * i]) = [x[2 * i + 3], y[2 * i + 3]] - half(a[2 * i + 3])
                left[i]: [x[2 * i + 1], y[2 * i + 1]] + half(a[2 * i + 1]) = [x[2 * i + 2], y[2 * i + 2]] - half(a[2 * i + 2])
            }
            hinge: [x[2 * N - 1], y[2 * N - 1]] + half(a[2 * N - 1]) = [px, py],
            slot: (y[2 * N - 2] + h * sin(a[2 * N - 2]) - py) * cos(pa) = (x[2 * N - 2] + h * cos(a[2 * N - 2]) - px) * sin(pa),
            guides: [pa, pa + sin(pa)] = [0.0, 0.0],
        }
    }
}

ukcore::multibody! {
    /// A crank drives a slider by a rod without mass.
    Crank {
        params { r = 0.3, l = 1.1, m = 2.0, j = 0.2, ms = 0.7, g = 9.81, f = 3.0, w = 2.0 }
        coords { x, y, a, b, s }
        mass { x: m, y: m, a: j, s: ms }
        potential { m * g * y }
        force { s: -f }
        holonomic {
            pin: [x, y] = r / 2.0 * [cos(a), sin(a)],
            rod: [r * cos(a) + l * cos(b), r * sin(a) + l * sin(b)] = [s, 0.0],
            drive: a = 0.7 + w * t,
        }
    }
}

ukcore::multibody! {
    /// A rigid body, turned by a quaternion, whose point hangs on a thread, and a knife on a plane below it.
    Hung {
        params { m = 1.3, i1 = 0.2, i2 = 0.3, i3 = 0.4, r = 0.6, l = 1.5, g = 9.81, k = 0.8, jk = 0.05 }
        coords { p[3], e0, e[3], u, v, w }
        let cross = |u, v| [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let turned = |v| v + 2.0 * e0 * cross(e, v) + 2.0 * cross(e, cross(e, v));
        let spin = 2.0 * (e0 * dot(e) - dot(e0) * e - cross(e, dot(e)));
        let hook = p + turned([r, 0.0, 0.0]);
        kinetic {
            for i in 0..3 { 0.5 * m * sq(dot(p[i])) }
            0.5 * (i1 * sq(spin[0]) + i2 * sq(spin[1]) + i3 * sq(spin[2])),
            0.5 * k * (sq(dot(u)) + sq(dot(v))) + 0.5 * jk * sq(dot(w)),
        }
        potential { m * g * p[2] }
        holonomic {
            unit: sq(e0) + sq(e[0]) + sq(e[1]) + sq(e[2]) = 1.0,
            thread: sq(hook[0]) + sq(hook[1]) + sq(hook[2]) = sq(l),
        }
        nonholonomic { knife: dot(u) * sin(w) = dot(v) * cos(w) }
    }
}

/// A mechanism in units that can be changed.
struct Case {
    mechanism: Prepared,
    parameters: &'static [Dimension],
    coordinates: Vec<Dimension>,
    start: State,
}

/// In units that are so many of the new ones.
struct Units([f64; 3]);

impl Units {
    fn of(&self, dimension: Dimension) -> f64 {
        let parts = self.0.iter().zip(dimension);
        parts.map(|(unit, power)| unit.powi(power)).product()
    }

    fn rate(&self, [l, m, t]: Dimension, order: i32) -> f64 {
        self.of([l, m, t - order])
    }
}

impl Case {
    /// The same mechanism and state in other units.
    fn changed(&self, units: &Units) -> (Prepared, State) {
        let given = self.mechanism.parameters().iter().zip(self.parameters);
        let given = given.map(|(x, dimension)| x * units.of(*dimension));
        let mechanism = self.mechanism.with_parameters(given.collect());
        let scaled = |x: &[f64], order: i32| -> Vec<f64> {
            let pairs = x.iter().zip(&self.coordinates);
            pairs
                .map(|(x, dimension)| x * units.rate(*dimension, order))
                .collect()
        };
        let State { t, q, v } = &self.start;
        let t = t * units.of([0, 0, 1]);
        let (q, v) = (scaled(q, 0), scaled(v, 1));
        (mechanism, State { t, q, v })
    }
}

/// The lift at an angle of its bars, which is their length through the foot and both middles, with this rate.
fn scissors(angle: f64, rate: f64) -> Case {
    const N: usize = 3;
    let h = Scissors::default().h;
    let (sin, cos) = angle.sin_cos();
    let mut q = vec![0.0; 6 * N + 3];
    let mut v = q.clone();
    for i in 0..2 * N {
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        let level = (i / 2) as f64;
        (q[i], q[2 * N + i]) = (h * cos, h * sin * (2.0 * level + 1.0));
        q[4 * N + i] = if sign > 0.0 {
            angle
        } else {
            std::f64::consts::PI - angle
        };
        (v[i], v[2 * N + i]) = (-h * sin * rate, h * cos * rate * (2.0 * level + 1.0));
        v[4 * N + i] = sign * rate;
    }
    q[6 * N + 1] = 2.0 * N as f64 * h * sin;
    v[6 * N + 1] = 2.0 * N as f64 * h * cos * rate;
    let of = [(4 * N, LENGTH), (2 * N, NUMBER), (2, LENGTH), (1, NUMBER)];
    Case {
        mechanism: Scissors::default().prepared(),
        parameters: &[LENGTH, MASS, INERTIA, GRAVITY],
        coordinates: of.iter().flat_map(|(count, x)| vec![*x; *count]).collect(),
        start: State { t: 0.0, q, v },
    }
}

fn crank() -> Case {
    let Crank { r, l, w, .. } = Crank::default();
    let a = 0.7_f64;
    let b = -(r * a.sin() / l).asin();
    let db = -r * a.cos() * w / (l * b.cos());
    let (x, y) = (0.5 * r * a.cos(), 0.5 * r * a.sin());
    let s = r * a.cos() + l * b.cos();
    let ds = -r * a.sin() * w - l * b.sin() * db;
    Case {
        mechanism: Crank::default().prepared(),
        parameters: &[LENGTH, LENGTH, MASS, INERTIA, MASS, GRAVITY, FORCE, RATE],
        coordinates: vec![LENGTH, LENGTH, NUMBER, NUMBER, LENGTH],
        start: at(&[x, y, a, b, s], &[-y * w, x * w, w, db, ds]),
    }
}

fn hung() -> Case {
    let Hung { r, l, .. } = Hung::default();
    let half = 0.2_f64;
    // Turned about the vertical; the thread hangs down from the origin.
    let turn = [half.cos(), 0.0, 0.0, half.sin()];
    let (c, s) = ((2.0 * half).cos(), (2.0 * half).sin());
    let thread = [0.6 * l, 0.0, -0.8 * l];
    let p = [thread[0] - r * c, thread[1] - r * s, thread[2]];
    // A point that stands still, in a body that turns about the vertical; the knife goes straight ahead.
    let (spin, w) = (0.9, 0.3_f64);
    let [e0, _, _, e3] = turn;
    let q = [&p[..], &turn, &[0.2, 0.4, w]].concat();
    let v = vec![
        r * s * spin,
        -r * c * spin,
        0.0,
        -0.5 * spin * e3,
        0.0,
        0.0,
        0.5 * spin * e0,
        1.1 * w.cos(),
        1.1 * w.sin(),
        0.5,
    ];
    Case {
        mechanism: Hung::default().prepared(),
        parameters: &[
            MASS, INERTIA, INERTIA, INERTIA, LENGTH, LENGTH, GRAVITY, MASS, INERTIA,
        ],
        coordinates: vec![
            LENGTH, LENGTH, LENGTH, NUMBER, NUMBER, NUMBER, NUMBER, LENGTH, LENGTH, NUMBER,
        ],
        start: State { t: 0.0, q, v },
    }
}

fn cases() -> Vec<Case> {
    vec![
        scissors(0.6, 1.0),
        scissors(1e-5, 1.0),
        scissors(0.0, 1.0),
        crank(),
        hung(),
    ]
}

/// Powers of two near 1e-9 … 1e9; those of masses are even, so that roots of them are such powers, too.
fn exact() -> impl Iterator<Item = Units> {
    [-30, -16, 0, 16, 30].into_iter().flat_map(|l| {
        [[l, 0, 0], [0, l, 0], [0, 0, l], [l, 30, -30], [-30, 30, l]]
            .map(|powers| Units(powers.map(|k| 2.0_f64.powi(k))))
    })
}

#[test]
fn solutions_are_the_same_bit_for_bit() {
    for case in cases() {
        let name = case.mechanism.spec().name;
        for formula in [Formula::Auto, Formula::UdwadiaPhohomsiri] {
            let solve = |mechanism: Prepared, state: &State| {
                let mut solver = solver_by(formula, mechanism);
                let mut straight = vec![0.0; state.q.len()];
                let found = solver.acceleration(state.t, &state.q, &state.v, &mut straight);
                found.unwrap_or_else(|e| panic!("{name}: {e}"));
                let work = solver.work();
                let solved = solver.solve(state.t, &state.q, &state.v);
                (
                    straight,
                    work,
                    solved.unwrap_or_else(|e| panic!("{name}: {e}")),
                )
            };
            let (first, work, solved) = solve(case.mechanism.clone(), &case.start);
            for units in exact() {
                let (mechanism, state) = case.changed(&units);
                let (other, other_work, other_solved) = solve(mechanism, &state);
                let same = |a: &[f64], b: &[f64]| {
                    for (i, (a, b)) in a.iter().zip(b).enumerate() {
                        let coordinate = case.mechanism.spec().coords[i];
                        let b = b / units.rate(case.coordinates[i], 2);
                        assert_eq!(*a, b, "{name} {coordinate}, {formula:?}, {:?}", units.0);
                    }
                };
                same(&first, &other);
                same(&solved.acceleration, &other_solved.acceleration);
                assert_eq!(work, other_work, "{name}, {:?}", units.0);
                assert_eq!(solved.rank, other_solved.rank, "{name}, {:?}", units.0);
                assert_eq!(
                    solved.redundant, other_solved.redundant,
                    "{name}, {:?}",
                    units.0
                );
                assert_eq!(
                    solved.formula, other_solved.formula,
                    "{name}, {:?}",
                    units.0
                );
            }
        }
    }
}

#[test]
fn solutions_in_decimal_units_differ_by_rounding() {
    for case in cases() {
        let name = case.mechanism.spec().name;
        let solve = |mechanism: Prepared, state: &State| {
            let mut solver = Solver::new(mechanism, SolverOptions::default());
            let solved = solver.solve(state.t, &state.q, &state.v);
            solved.unwrap_or_else(|e| panic!("{name}: {e}"))
        };
        let expected = solve(case.mechanism.clone(), &case.start);
        for power in [-9, -6, -3, 3, 6, 9] {
            for which in 0..3 {
                let mut factors = [1.0; 3];
                factors[which] = 10_f64.powi(power);
                let units = Units(factors);
                let (mechanism, state) = case.changed(&units);
                let found = solve(mechanism, &state);
                assert_eq!(found.rank, expected.rank, "{name}, {factors:?}");
                assert_eq!(found.redundant, expected.redundant, "{name}, {factors:?}");
                let size = |x: &[f64]| x.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
                let scale = size(&expected.acceleration);
                for (i, (a, b)) in expected
                    .acceleration
                    .iter()
                    .zip(&found.acceleration)
                    .enumerate()
                {
                    let b = b / units.rate(case.coordinates[i], 2);
                    assert_close(&format!("{name} {i}, {factors:?}"), b, *a, 1e-11 * scale);
                }
            }
        }
    }
}

/// How far the bars of the lift are from being in the branch in which all of a side are parallel, in rad, where the motion goes on.
fn folded(q: &[f64]) -> f64 {
    let bars = q[12..18].iter().enumerate();
    let angle = q[12];
    let off = bars.map(|(i, a)| match i % 2 {
        0 => a - angle,
        _ => a - (std::f64::consts::PI - angle),
    });
    off.fold(0.0, |most: f64, x| most.max(x.abs()))
}

#[test]
fn a_lift_passes_its_flat_position_in_any_units() {
    let case = scissors(0.4, -1.0);
    let methods = [
        Method::Dop853,
        Method::Dopri5,
        Method::Radau5,
        Method::Rattle { step: 2e-3 },
    ];
    for (method, power) in methods
        .into_iter()
        .flat_map(|m| [-9, -6, -3, 0, 3, 6, 9].map(|p| (m, p)))
    {
        let length = 10_f64.powi(power);
        let (mechanism, start) = case.changed(&Units([length, 1.0, 1.0]));
        let run = Simulation::new(mechanism).start(start).method(method);
        let run = run.tolerance(1e-8).every(0.01).until(1.0);
        let run = run.unwrap_or_else(|e| panic!("{method}, 1e{power}: {e}"));
        for sample in run.samples() {
            let off = folded(sample.q);
            assert!(off < 1e-7, "{method}, 1e{power}: {off:e} at {}", sample.t);
        }
        let last = run.last().expect("an end");
        assert_close(&format!("{method}, 1e{power}"), last.q[12], FLAT_END, 1e-7);
        let drift = run.energy_drift();
        assert!(drift < 1e-6, "{method}, 1e{power}: energy {drift:e} off");
    }
}

/// Angle of the bars a second after 0.4 rad with −1 rad/s, by RATTLE in steps of 0.5 ms.
const FLAT_END: f64 = -0.564_137_168_8;

/// A run with its work in numbers that do not depend on units, and its states in the old ones.
fn states(case: &Case, units: &Units, run: Simulation, until: f64) -> (String, Vec<f64>) {
    let (mechanism, start) = case.changed(units);
    let name = mechanism.spec().name;
    let run = run.start(start).until(until * units.of([0, 0, 1]));
    let run = run.unwrap_or_else(|e| panic!("{name}, {:?}: {e}", units.0));
    let old = |x: &[f64], order: i32| -> Vec<f64> {
        let pairs = x.iter().zip(&case.coordinates);
        pairs
            .map(|(x, dimension)| x / units.rate(*dimension, order))
            .collect()
    };
    let samples = run
        .samples()
        .flat_map(|s| [old(s.q, 0), old(s.v, 1)].concat());
    (format!("{:?}", run.work()), samples.collect())
}

#[test]
fn steps_of_one_size_are_the_same_bit_for_bit() {
    let case = scissors(0.6, -1.0);
    let run = |units: &Units| {
        let (mechanism, _) = case.changed(units);
        let step = 0.01 * units.of([0, 0, 1]);
        states(
            &case,
            units,
            Simulation::new(mechanism).method(Method::Rattle { step }),
            0.3,
        )
    };
    let expected = run(&Units([1.0; 3]));
    for units in exact() {
        assert!(run(&units) == expected, "{:?}", units.0);
    }
}

#[test]
fn steps_over_singular_positions_do_not_depend_on_the_units_of_length_and_mass() {
    for (case, until) in [(scissors(0.4, -1.0), 1.0), (crank(), 2.0), (hung(), 0.5)] {
        for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
            let run = |units: &Units| {
                let (mechanism, _) = case.changed(units);
                let run = Simulation::new(mechanism).method(method).tolerance(1e-7);
                states(&case, units, run, until)
            };
            let expected = run(&Units([1.0; 3]));
            for factor in [2.0_f64.powi(-30), 2.0_f64.powi(30)] {
                // Radau's Jacobians are as they are but for rounding.
                let length = match method {
                    Method::Radau5 => 1.0,
                    _ => factor,
                };
                for units in [[length, 1.0], [1.0, factor], [length, factor]] {
                    let units = Units([units[0], units[1], 1.0]);
                    let name = case.mechanism.spec().name;
                    assert!(run(&units) == expected, "{name}, {method}, {:?}", units.0);
                }
            }
        }
    }
}

ukcore::multibody! {
    /// A crank and a rod of its length, folded onto each other: the slider may stand in the bearing, or move.
    Folded {
        params { r = 1.0, m = 1.0, j = 0.1, push = 1.0, turn = 0.0 }
        coords { x, y, a, u, v, b }
        mass { x: m, y: m, a: j, u: m, v: m, b: j }
        force { a: turn, b: turn, u: push }
        holonomic {
            bearing: [x, y] = r / 2.0 * [cos(a), sin(a)],
            pin: [x, y] + r / 2.0 * [cos(a), sin(a)] = [u, v] - r / 2.0 * [cos(b), sin(b)],
            guide: v + r / 2.0 * sin(b) = 0.0,
        }
    }
}

/// Pushed along no branch from rest, or from what is rest to rounding: named in any units, where the run begins.
#[test]
fn rest_in_a_crossing_is_named_in_any_units() {
    let up = std::f64::consts::FRAC_PI_2;
    for (push, turn, rate) in [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (-2.0, 0.3, 1e-15)] {
        let folded = Folded {
            push,
            turn,
            ..Folded::default()
        };
        let case = Case {
            mechanism: folded.prepared(),
            parameters: &[LENGTH, MASS, INERTIA, FORCE, TORQUE],
            coordinates: vec![LENGTH, LENGTH, NUMBER, LENGTH, LENGTH, NUMBER],
            start: State {
                t: 0.0,
                q: vec![0.0, 0.5, up, 0.0, 0.5, -up],
                // Both turn as one.
                v: [-0.5, 0.0, 1.0, -0.5, 0.0, 1.0].map(|v| v * rate).to_vec(),
            },
        };
        for power in [-9, -6, -3, 0, 3, 6, 9] {
            for which in 0..3 {
                let mut factors = [1.0; 3];
                factors[which] = 10_f64.powi(power);
                let (mechanism, start) = case.changed(&Units(factors));
                let end = 0.5 * factors[2];
                let failure = Simulation::new(mechanism).start(start).until(end);
                let Err(failure) = failure else {
                    panic!("{push}, {turn}, {factors:?}: branches cross");
                };
                let (t, source) = cause(&failure.error);
                assert!(
                    t == 0.0 && matches!(source, Error::Singular { .. }),
                    "{push}, {turn}, {factors:?}: {failure}"
                );
            }
        }
    }
}

/// A start that is off by a share of its angles is off in any units of length.
#[test]
fn a_start_off_the_constraints_is_refused_in_any_units() {
    let mut case = crank();
    case.start.q[3] += 1e-4;
    for power in [-9, -6, -3, 0, 3, 6, 9] {
        let (mechanism, start) = case.changed(&Units([10_f64.powi(power), 1.0, 1.0]));
        let failure = Simulation::new(mechanism).start(start).until(0.1);
        let Err(failure) = failure else {
            panic!("1e{power}: it is off by 1e-4 rad");
        };
        assert!(
            matches!(failure.error, Error::OffConstraint { .. }),
            "1e{power}: {failure}"
        );
    }
}
