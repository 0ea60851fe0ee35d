//! Switching functions of abs, sign, min and max: what the compiler finds, and the equations with a branch held.

use tests::{Random, assert_all_close, assert_close, solver_by};
use ukcore::mechanism::Branch;
use ukcore::scalar::Dual;
use ukcore::{Mechanism, Prepared};

ukcore::multibody! {
    /// A kink or jump of each kind, in each part of the equations; one function may have several.
    Kinks {
        params { m = 1.5, c = 0.3, k = 20.0, gap = 0.2 }
        coords { x, y, z, w }
        mass { x: m * (3.0 + max(x, y)), y: m, z: m, w: m }
        potential { k * max(gap - x, 0.0).powi(2) }
        force {
            x: -c * dot(x).abs() * dot(x) - abs(-2.0 * dot(x)),
            y: sign(sin(3.0 * t)) - min(x, y),
            z: min(1.0 - z, z) + 0.1 * max(z - 0.5, 0.0),
            w: abs(m - c)
        }
        nonideal { z: -c * sign(dot(y) + dot(z)) }
        holonomic { track: w = x + y * abs(y - t) }
        output { kept = abs(dot(x)) }
    }
}

ukcore::multibody! {
    /// The same with the signs that decide as parameters: smooth.
    Smooth {
        params { m = 1.5, c = 0.3, k = 20.0, gap = 0.2, s[7] = 1.0 }
        coords { x, y, z, w }
        let larger = |a, b, s| 0.5 * (a + b + s * (a - b));
        let smaller = |a, b, s| 0.5 * (a + b - s * (a - b));
        mass { x: m * (3.0 + larger(x, y, s[3])), y: m, z: m, w: m }
        potential { k * larger(gap - x, 0.0, s[1]).powi(2) }
        force {
            x: -c * (s[0] * dot(x)) * dot(x) - 2.0 * s[0] * dot(x),
            y: s[2] - smaller(x, y, s[3]),
            z: smaller(1.0 - z, z, -s[4]) + 0.1 * larger(z - 0.5, 0.0, s[4]),
            w: abs(m - c)
        }
        nonideal { z: -c * s[5] }
        holonomic { track: w = x + y * (s[6] * (y - t)) }
    }
}

/// What decides the branches of [`Kinks`], as `Smooth` counts them.
fn deciding(gap: f64, t: f64, q: &[f64], v: &[f64]) -> [f64; 7] {
    [
        v[0],
        gap - q[0],
        (3.0 * t).sin(),
        q[0] - q[1],
        q[2] - 0.5,
        v[1] + v[2],
        q[1] - t,
    ]
}

/// Number of each switch of [`Kinks`] among the [`deciding`] functions, its factor, and its terms.
const EXPECTED: [(usize, f64, &[&str]); 7] = [
    (1, -1.0, &["force on `x`"]),
    (0, 1.0, &["force on `x`"]),
    (2, 1.0, &["force on `y`"]),
    (3, 1.0, &["force on `y`", "mass on `x`"]),
    (4, 1.0, &["force on `z`"]),
    (5, 1.0, &["non-ideal force on `z`"]),
    (6, 1.0, &["constraint `track`"]),
];

struct State {
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
}

fn state(random: &mut Random) -> State {
    State {
        t: random.signed(),
        q: random.vector(4),
        v: random.vector(4),
    }
}

fn switching<S: ukcore::scalar::Scalar>(mech: &Prepared<S>, t: S, q: &[S], v: &[S]) -> Vec<S> {
    let mut out = vec![S::from_f64(f64::NAN); Kinks::SPEC.switches.len()];
    mech.switching(t, q, v, &mut out);
    out
}

/// q̈, M, Q, c, A, b, φ and φ̇, one after the other.
fn everything(mech: &Prepared, State { t, q, v }: &State) -> Vec<f64> {
    let mut out = vec![0.0; 4 + 16 + 4 + 4 + 4 + 1 + 1 + 1];
    let (q_dotdot, rest) = out.split_at_mut(4);
    assert!(mech.acceleration(*t, q, v, q_dotdot) > 0.5);
    let (mass, rest) = rest.split_at_mut(16);
    let (force, rest) = rest.split_at_mut(4);
    let (nonideal, rest) = rest.split_at_mut(4);
    let (jacobian, rest) = rest.split_at_mut(4);
    let (rhs, rest) = rest.split_at_mut(1);
    let mut terms = ukcore::mechanism::Terms {
        mass,
        force,
        nonideal,
        jacobian,
        rhs,
    };
    mech.dynamics(*t, q, v, &mut terms);
    mech.residual(*t, q, &mut rest[..1]);
    mech.residual_rate(*t, q, v, &mut rest[1..]);
    out
}

fn dual(x: &[f64], d: &[f64]) -> Vec<Dual> {
    x.iter().zip(d).map(|(x, d)| Dual::new(*x, *d)).collect()
}

fn branch(g: f64) -> Branch {
    if g < 0.0 {
        Branch::Negative
    } else {
        Branch::Positive
    }
}

/// One switch for g, −g and 2 g; none where parameters alone decide; the terms of each.
#[test]
fn the_compiler_finds_each_switch_once() {
    let found = Kinks::SPEC.switches;
    assert_eq!(found.len(), EXPECTED.len(), "{found:?}");
    let mut random = Random::new(5);
    for _ in 0..20 {
        let State { t, q, v } = state(&mut random);
        let mech = Kinks::default();
        let values = switching(&mech.prepared(), t, &q, &v);
        let deciding = deciding(mech.gap, t, &q, &v);
        for ((switch, value), (k, factor, terms)) in found.iter().zip(values).zip(EXPECTED) {
            assert_eq!(switch.terms, terms, "{}", switch.function);
            assert_close(switch.function, value, factor * deciding[k], 1e-14);
        }
    }
    let texts: Vec<&str> = found.iter().map(|switch| switch.function).collect();
    assert_eq!(texts[..3], ["x - gap", "dot(x)", "sin(3*t)"]);
    let plan = Kinks::plan().to_string();
    assert!(
        plan.contains("dot(x)") && plan.contains("force on `y`, mass on `x`"),
        "{plan}"
    );
    assert!(models::Pendulum::SPEC.switches.is_empty());
}

#[test]
fn switching_by_dual_numbers_is_its_derivative_along_the_motion() {
    let mut random = Random::new(6);
    for _ in 0..20 {
        let (State { t, q, v }, along) = (state(&mut random), state(&mut random));
        let mech = Kinks::default();
        let values = switching(
            &mech.prepared::<Dual>(),
            Dual::new(t, 1.0),
            &dual(&q, &along.q),
            &dual(&v, &along.v),
        );
        let h = 1e-5;
        let shifted = |h: f64| {
            let moved = |x: &[f64], d: &[f64]| -> Vec<f64> {
                x.iter().zip(d).map(|(x, d)| x + h * d).collect()
            };
            let (q, v) = (moved(&q, &along.q), moved(&v, &along.v));
            deciding(mech.gap, t + h, &q, &v)
        };
        let (before, after) = (shifted(-h), shifted(h));
        for (value, (k, factor, _)) in values.iter().zip(EXPECTED) {
            let slope = factor * (after[k] - before[k]) / (2.0 * h);
            assert_close("slope", value.eps, slope, 1e-8);
        }
    }
}

/// In the branches that the signs say, held code is free code, to the last bit.
#[test]
fn held_where_the_signs_agree_nothing_changes() {
    let mut random = Random::new(7);
    for _ in 0..50 {
        let state = state(&mut random);
        let free = Kinks::default().prepared();
        let mut held = free.clone();
        let values = switching(&free, state.t, &state.q, &state.v);
        for (k, g) in values.iter().enumerate() {
            held.hold(k, branch(*g));
        }
        assert_eq!(everything(&held, &state), everything(&free, &state));
        for k in 0..values.len() {
            held.hold(k, Branch::Followed);
        }
        assert_eq!(held, free);
    }
}

/// In any branches, whatever the signs say, all equations, and their derivatives, are those of the smooth mechanism with these signs;
/// also by the rank-revealing solve. Outputs follow their switches.
#[test]
fn held_in_any_branch_the_equations_are_smooth() {
    let mut random = Random::new(8);
    for _ in 0..200 {
        let state = state(&mut random);
        let mut held = Kinks::default().prepared();
        let mut twin = Smooth::default();
        for (switch, (k, factor, _)) in EXPECTED.iter().enumerate() {
            let sign = random.signed().signum();
            held.hold(switch, branch(sign));
            twin.s[*k] = sign * factor;
        }
        let smooth = twin.prepared();
        let (found, expected) = (everything(&held, &state), everything(&smooth, &state));
        assert_all_close("held", &found, &expected, 1e-12);
        let State { t, q, v } = &state;
        let along = self::state(&mut random);
        let derivative = |found: &mut [Dual]| -> Vec<f64> { found.iter().map(|x| x.eps).collect() };
        let (t_dual, q_dual, v_dual) =
            (Dual::new(*t, along.t), dual(q, &along.q), dual(v, &along.v));
        let mut slopes = [[Dual::new(0.0, 0.0); 4]; 2];
        let mut duals = Kinks::default().prepared::<Dual>();
        duals.hold_as(&held);
        duals.acceleration(t_dual, &q_dual, &v_dual, &mut slopes[0]);
        let smooth = twin.prepared::<Dual>();
        smooth.acceleration(t_dual, &q_dual, &v_dual, &mut slopes[1]);
        let [found, expected_slope] = &mut slopes;
        let size = expected_slope
            .iter()
            .fold(1.0, |s: f64, x| s.max(x.eps.abs()));
        assert_all_close(
            "slopes",
            &derivative(found),
            &derivative(expected_slope),
            1e-12 * size,
        );
        let mut dense = solver_by(ukcore::solver::Formula::UdwadiaKalaba, &held);
        let solution = dense.solve(*t, q, v).expect("a regular system");
        assert_all_close("dense", &solution.acceleration, &expected[..4], 1e-10);
        let mut output = [0.0];
        held.outputs(*t, q, v, &mut output);
        assert_eq!(output[0], v[0].abs());
    }
}
