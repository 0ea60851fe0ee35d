//! Coordinates that are alone in a constraint in pairs, and so turned into what it prescribes and what it leaves free: the straight line
//! against the saddle-point system in 31 digits, with masses over 24 decades, and its certificate against singular values.

use nalgebra::DMatrix;
use tests::{Dense, Random, singular_values};
use ukcore::equations::precise;
use ukcore::solver::SolverOptions;
use ukcore::spec::Pivot;
use ukcore::{Mechanism, Solver, State};

ukcore::multibody! {
    /// Cranks side by side, coupled by rods, with point masses at their tops.
    Points {
        const N: usize = 5;
        params { m[N] = 1.0, g = 9.81 }
        coords { x[N], y[N] }
        mass { for i in 0..N { x[i]: m[i], y[i]: m[i] } }
        potential { for i in 0..N { m[i] * g * y[i] } }
        holonomic {
            for i in 0..N { crank[i]: sq(x[i] - i) + sq(y[i]) = 1.0 }
            for i in 1..N { coupler[i]: sq(x[i] - x[i - 1]) + sq(y[i] - y[i - 1]) = 1.0 }
        }
    }
}

ukcore::multibody! {
    /// The same with uniform rods, whose inertia couples their ends.
    Rods {
        const N: usize = 5;
        params { m[N] = 1.0, k[N] = 1.0, g = 9.81 }
        coords { x[N], y[N] }
        kinetic {
            for i in 0..N { m[i] / 6.0 * (sq(dot(x[i])) + sq(dot(y[i]))) }
            for i in 1..N {
                k[i] / 6.0 * (sq(dot(x[i - 1])) + dot(x[i - 1]) * dot(x[i]) + sq(dot(x[i]))),
                k[i] / 6.0 * (sq(dot(y[i - 1])) + dot(y[i - 1]) * dot(y[i]) + sq(dot(y[i]))),
            }
        }
        potential { for i in 0..N { m[i] * g * y[i] } }
        holonomic {
            for i in 0..N { crank[i]: sq(x[i] - i) + sq(y[i]) = 1.0 }
            for i in 1..N { coupler[i]: sq(x[i] - x[i - 1]) + sq(y[i] - y[i - 1]) = 1.0 }
        }
    }
}

const N: usize = 5;

/// Tops on or near the constraints, some cranks level or upright, some couplers in line with their cranks.
fn state(random: &mut Random, away: f64) -> State {
    let (mut q, mut v) = (vec![0.0; 2 * N], random.vector(2 * N));
    let common = 3.0 * random.signed();
    for i in 0..N {
        let angle: f64 = match (4.0 * random.signed().abs()).floor() {
            0.0 => 3.0 * random.signed(),
            1.0 => std::f64::consts::FRAC_PI_2 * (2.0 * random.signed()).round(),
            _ => common + away * random.signed(),
        };
        let (sin, cos) = angle.sin_cos();
        let clean = |x: f64| if x.abs() < 1e-15 { 0.0 } else { x };
        (q[i], q[N + i]) = (i as f64 + clean(sin), clean(cos));
    }
    if random.signed() > 0.5 {
        q.iter_mut().for_each(|q| *q += away * random.signed());
    }
    if random.signed() > 0.8 {
        v.fill(0.0);
    }
    State { t: 0.0, q, v }
}

/// Masses over `decades`, at random among those of the parameters that begin with m and k.
fn masses<M: Mechanism>(mechanism: &mut M, decades: f64, random: &mut Random) {
    for (index, p) in M::SPEC.params.iter().enumerate() {
        if p.name.starts_with(['m', 'k']) {
            let mass = 10.0_f64.powf(0.5 * decades * random.signed());
            mechanism.set_parameter(index, mass);
        }
    }
}

/// √(xᵀ M x).
fn norm(mass: &DMatrix<f64>, x: &[f64]) -> f64 {
    let x = nalgebra::DVector::from_column_slice(x);
    x.dot(&(mass * &x)).sqrt()
}

/// How many states were accepted and refused. Whatever is accepted is as accurate as promised; and for a diagonal M whatever keeps the
/// promised distance from rank loss is accepted.
fn check<M: Mechanism + Default>(seed: u64, decades: &[f64]) -> (usize, usize) {
    let name = M::SPEC.name;
    let solve = &M::SPEC.structure.solve;
    let turned = solve
        .pivots
        .iter()
        .filter(|p| matches!(p, Pivot::Turned(..)));
    assert_eq!(turned.count(), 2 * N - 1, "{name}");
    let mut random = Random::new(seed);
    let (mut accepted, mut refused) = (0, 0);
    for case in 0..600 {
        let mut mechanism = M::default();
        masses(&mut mechanism, decades[case % decades.len()], &mut random);
        let away = 10.0_f64.powf(-6.0 * random.signed().abs());
        let state = state(&mut random, away);
        let dense = Dense::of(&mechanism, &state);
        let mut found = vec![f64::NAN; 2 * N];
        let prepared = mechanism.prepared::<f64>();
        let safe = prepared.acceleration(state.t, &state.q, &state.v, &mut found) > 0.5;
        if !safe {
            refused += 1;
            let mut rows = dense.jacobian.clone();
            for (i, mut column) in rows.column_iter_mut().enumerate() {
                column /= dense.mass[(i, i)].sqrt();
            }
            for mut row in rows.row_iter_mut() {
                let length = row.norm();
                row /= length;
            }
            let least = singular_values(&rows).into_iter().fold(1.0, f64::min);
            let diagonal = M::SPEC.structure.mass_diagonal;
            assert!(
                !diagonal || least < 1.0 / 32.0,
                "{name}, {case}: refused {least:e} from rank loss"
            );
            continue;
        }
        accepted += 1;
        let expected = precise::accelerations(&mechanism, state.t, &state.q, &state.v)
            .expect("cranks and couplers that are clear of each other");
        let off: Vec<f64> = found.iter().zip(&expected).map(|(a, b)| a - b).collect();
        // M⁻¹ Q is not larger in the norm of M than with the diagonal of M, but for what rods share.
        let free = (0..2 * N).map(|i| dense.force[i].powi(2) / dense.mass[(i, i)]);
        let size = norm(&dense.mass, &expected).max(free.sum::<f64>().sqrt());
        let bound = (4 * N - 1) as f64 * f64::EPSILON / solve.least_share * size;
        let error = norm(&dense.mass, &off);
        assert!(
            error <= bound,
            "{name}, {case}: off by {error:e} > {bound:e}"
        );
    }
    (accepted, refused)
}

#[test]
fn points_of_all_masses() {
    let (accepted, refused) = check::<Points>(31, &[0.0, 6.0, 24.0]);
    assert!(accepted > 150 && refused > 100, "{accepted} and {refused}");
}

#[test]
fn rods_of_all_masses() {
    let (accepted, refused) = check::<Rods>(33, &[0.0, 2.0, 24.0]);
    assert!(accepted > 100 && refused > 100, "{accepted} and {refused}");
}

/// On the way to where all rods lie in one line, and couplers follow from cranks.
#[test]
fn where_couplers_and_cranks_are_in_line() {
    let mut random = Random::new(34);
    let rods = Rods::default();
    let mut solver = Solver::new(&rods, SolverOptions::default());
    let mut out = [0.0; 2 * N];
    for k in 0..28 {
        let lean = std::f64::consts::FRAC_PI_2 + 0.5 * 0.5_f64.powi(k);
        let mut state = State::zeros::<Rods>();
        let speed = random.signed();
        for i in 0..N {
            let (sin, cos) = lean.sin_cos();
            (state.q[i], state.q[N + i]) = (i as f64 + sin, cos);
            (state.v[i], state.v[N + i]) = (speed * cos, -speed * sin);
        }
        solver
            .acceleration(0.0, &state.q, &state.v, &mut out)
            .expect("cranks that lean alike");
        // θ̈ of N uniform cranks with N − 1 uniform couplers, that lean alike: their angles stay so.
        let g = 9.81;
        let pull = N as f64 * g * lean.sin();
        let inertia = N as f64 / 3.0 + (N - 1) as f64;
        let turn = pull / inertia;
        for i in 0..N {
            let (sin, cos) = lean.sin_cos();
            let expected = [
                turn * cos - speed * speed * sin,
                -turn * sin - speed * speed * cos,
            ];
            let found = [out[i], out[N + i]];
            tests::assert_all_close("in line", &found, &expected, 1e-6 * (1.0 + turn.abs()));
        }
    }
}
