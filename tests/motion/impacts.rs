//! Impacts on springs so hard that the implicit method could step over them: a body bounces back with the energy that it came with.

use tests::{assert_close, at_rest};
use ukcore::{Mechanism, Method, Simulation, Trajectory};

ukcore::multibody! {
    /// A ball above a floor that is a spring; with `d` not 0 it takes energy out.
    Ball {
        params { m = 1.0, k = 1e8, g = 9.81, d = 0.0 }
        coords { y }
        mass { y: m }
        potential { m * g * y + 0.5 * k * sq(min(y, 0)) }
        force { y: k * min(y, 0) * d * dot(y) }
    }
}

ukcore::multibody! {
    /// A ball between a floor and a wall askew of it, with a lighter one on the same floor.
    Two {
        params { m = 1.0, small = 0.01, k = 1e10, g = 9.81, tilt = 0.7 }
        coords { x, y, z }
        mass { x: m, y: m, z: small }
        let height = y * cos(tilt) - x * sin(tilt);
        potential { m * g * y + 0.5 * k * sq(min(height, 0)), small * g * z + 0.5 * k * sq(min(z, 0)) }
    }
}

ukcore::multibody! {
    /// Two points on a rod that falls onto its one end; it stands upright and y is the height of the lower one.
    Staff {
        params { m = 1.0, l = 0.5, k = 1e10, g = 9.81 }
        coords { x, y, u, w }
        mass { x: m, y: m, u: m, w: m }
        holonomic { rod: sq(u - x) + sq(w - y) = sq(l) }
        potential { m * g * (y + w) + 0.5 * k * sq(min(y, 0)) + 0.5 * k * sq(min(w, 0)) }
    }
}

ukcore::multibody! {
    /// A pendulum on a spring so hard that it is nearly a rod, pushed to and fro.
    Pushed {
        params { m = 1.0, l = 1.0, k = 1e10, g = 9.81, push = 3.0, rate = 5.0 }
        coords { x, y }
        mass { x: m, y: m }
        potential { m * g * y + 0.5 * k * sq(hypot(x, y) - l) }
        force { x: push * sign(sin(rate * t + 0.3)) }
    }
}

ukcore::multibody! {
    /// Balls on threads beside each other, with Hertz's contacts between them.
    Cradle {
        const N: usize = 5;
        params { m = 0.1, k = 1e6, l = 0.3, g = 9.81 }
        coords { x[N] }
        mass { x: m }
        potential {
            for i in 0..N { 0.5 * m * g / l * sq(x[i]) }
            for i in 0..N - 1 { 0.4 * k * max(0, x[i] - x[i + 1]).powf(2.5) }
        }
    }
}

fn run<M: Mechanism>(
    model: M,
    method: Method,
    tolerance: f64,
    q: &[f64],
    until: f64,
) -> Trajectory {
    let run = Simulation::new(model).start(at_rest(q)).method(method);
    let run = run.tolerance(tolerance).until(until);
    run.unwrap_or_else(|e| panic!("{tolerance}: {}", e.error))
}

#[test]
fn a_ball_bounces_back_however_hard_the_floor_is() {
    for exponent in 6..=14 {
        let k = 10_f64.powi(exponent);
        for tolerance in [1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-10, 1e-12] {
            for height in [0.5, 1.0, 2.0] {
                let ball = Ball {
                    k,
                    ..Ball::default()
                };
                let run = run(ball, Method::Radau5, tolerance, &[height], 1.0);
                let drift = run.energy_drift();
                let what = format!(
                    "k = {k:e}, {tolerance:e}, from {height}: {drift:e}, {:?}",
                    run.work()
                );
                assert!(drift < 1e-2 && drift < 1e3 * tolerance, "{what}");
                assert!(run.work().steps < 600, "{what}");
            }
        }
    }
}

#[test]
fn a_light_ball_and_an_oblique_impact_are_not_lost_beside_a_heavy_one() {
    for tolerance in [1e-5, 1e-7, 1e-9] {
        for (k, light) in [(1e8, 0.1), (1e10, 0.01), (1e12, 0.01)] {
            let two = Two {
                k,
                small: light,
                ..Two::default()
            };
            let run = run(two, Method::Radau5, tolerance, &[0.0, 1.0, 0.3], 0.8);
            let drift = run.energy_drift();
            let kept = run.samples().filter(|s| s.q[2] > 0.01 && s.t > 0.3);
            for s in kept {
                let height = s.q[2] + s.v[2] * s.v[2] / (2.0 * 9.81);
                assert_close("height of the light ball", height, 0.3, 1e-2);
            }
            assert!(drift < 1e4 * tolerance, "{tolerance} {k} {light}: {drift}");
        }
    }
}

#[test]
fn a_rod_that_falls_on_its_end_bounces() {
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let run = run(
            Staff::default(),
            Method::Radau5,
            tolerance,
            &[0.0, 1.0, 0.0, 1.5],
            0.8,
        );
        assert!(
            run.energy_drift() < 1e3 * tolerance,
            "{}",
            run.energy_drift()
        );
    }
}

#[test]
fn a_floor_that_takes_energy_out_is_followed_as_explicit_methods_do() {
    for (k, d) in [(1e6, 0.3), (1e8, 0.1), (1e8, 1.0), (1e10, 0.3)] {
        let ball = Ball {
            k,
            d,
            ..Ball::default()
        };
        let exact = run(ball.clone(), Method::Dop853, 1e-11, &[1.0], 1.2);
        let exact = exact.last().expect("it has run").to_state();
        for tolerance in [1e-5, 1e-8] {
            let run = run(ball.clone(), Method::Radau5, tolerance, &[1.0], 1.2);
            let last = run.last().expect("it has run");
            assert_close("height", last.q[0], exact.q[0], 1e3 * tolerance);
        }
    }
}

/// What a jump of a force leaves in a hard spring holds next to no energy: it is damped as before, and steps stay as long.
#[test]
fn what_a_jump_excites_is_still_stepped_over() {
    for tolerance in [1e-5, 1e-7] {
        let run = run(
            Pushed::default(),
            Method::Radau5,
            tolerance,
            &[0.6, -0.8],
            4.0,
        );
        let work = run.work();
        assert!(work.steps + work.rejected < 500, "{tolerance}: {work:?}");
    }
}

/// In the first contact the displacements grow with powers of time, from 4.5 on, each with a higher one than that of the ball before.
#[test]
fn balls_that_touch_each_other_hand_an_impact_on() {
    let lifted = [-0.05, 0.0, 0.0, 0.0, 0.0];
    let met = |method, tolerance| run(Cradle::default(), method, tolerance, &lifted, 0.4);
    let fine = met(Method::Dop853, 1e-12);
    let reference = fine.last().expect("an end").q;
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for tolerance in [1e-5, 1e-6, 1e-7, 1e-9, 1e-11] {
            let run = met(method, tolerance);
            let off = run.last().expect("an end").q.iter().zip(reference);
            let off = off.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            assert!(
                off < 10.0 * tolerance,
                "{method}, {tolerance:e}: off by {off:e}"
            );
            assert!(
                run.work().steps < 1500,
                "{method}, {tolerance:e}: {:?}",
                run.work()
            );
        }
    }
}
