//! Dead centres far off the origin, where places are rounded by more than the branches are apart: a crank and a rod of equal lengths are
//! passed in the branch they came on, or the run is refused.

use tests::{largest, worst};
use ukcore::{Method, Simulation, Trajectory};

ukcore::multibody! {
    /// A slider-crank with equal crank and rod, `far` off the origin.
    Crank {
        params { far = 0.0, g = 0.0 }
        bodies {
            planar a { mass: 1, inertia: 1.0 / 12, centre: [0.5, 0] }
            planar b { mass: 1, inertia: 1.0 / 12, centre: [0.5, 0] }
            planar c { mass: 0.5, inertia: 1 }
        }
        gravity { [0, -g] }
        holonomic {
            bearing: pin(ground.at([far, -far]), a.at([0, 0]))
            crank_pin: pin(a.at([1, 0]), b.at([0, 0]))
            wrist_pin: pin(b.at([1, 0]), c.at([0, 0]))
            guide: slider(ground.at([far, -far]), c.at([0, 0]), [1, 0])
        }
        start go(w = 5.5) {
            a.angle = 0.7; dot(a.angle) = w; b.angle near -0.7; dot(b.angle) near -w;
            a.centre near [far + 0.4, -far + 0.3]; b.centre near [far + 1.1, -far + 0.3]; c.centre near [far + 1.5, -far]
        }
    }
}

/// How far the slider is from where the crank has it at any sample.
fn off(run: &Trajectory, far: f64) -> f64 {
    worst(run, |s| {
        (s.q[Crank::C_X] - far - 2.0 * s.q[Crank::A_ANGLE].cos()).abs()
    })
}

#[test]
fn dead_centres_far_off_are_passed_or_refused() {
    for far in [0.0, 1e3, 1e6, 1e7] {
        for k in [1, 2, 3, 7, 8] {
            let w = 2.3 + 0.61 * f64::from(k);
            for (g, method, tolerance) in [
                (0.0, Method::Dop853, 1e-9),
                (9.81, Method::Dop853, 1e-9),
                (0.0, Method::Dopri5, 1e-11),
                (0.0, Method::Radau5, 1e-9),
                (9.81, Method::Radau5, 1e-9),
            ] {
                let label = format!("{far:e}, {w}, {g}, {method:?} at {tolerance:e}");
                let crank = Crank { far, g };
                let start = crank.start("go", &[("w", w)].into());
                let run = Simulation::new(crank)
                    .start(start.unwrap_or_else(|e| panic!("{label}: {e}")))
                    .method(method)
                    .tolerance(tolerance)
                    .max_steps(20000)
                    .every(0.05)
                    .until(3.0);
                let Ok(run) = run else {
                    assert!(far > 0.0, "{label} is refused");
                    continue;
                };
                let off = off(&run, far);
                // On the position the branches are as far apart as the root of what places are rounded by.
                let known = 1e-6 + 8.0 * (f64::EPSILON * far).sqrt();
                assert!(off < known, "{label}: {off:e}");
            }
        }
    }
}

ukcore::multibody! {
    /// An antiparallelogram of bars a and d, after some turns of its crank.
    Crossed {
        params { a = 0.5, d = 1.0, m = 1.0, j = 0.02, turns = 0.0 }
        bodies {
            planar crank { mass: m, inertia: j }
            planar coupler { mass: m, inertia: j, centre: [d / 2, 0] }
            planar rocker { mass: m, inertia: j }
        }
        holonomic {
            o: pin(ground.at([0, 0]), crank.at([0, 0]))
            p: pin(crank.at([a, 0]), coupler.at([0, 0]))
            q: pin(coupler.at([d, 0]), rocker.at([a, 0]))
            r: pin(ground.at([d, 0]), rocker.at([0, 0]))
        }
        output {
            /// 0 in the branch where the bars cross, dead centres included
            parted = sin(rocker.angle / 2) * cos(crank.angle / 2) * (d - a) + sin(crank.angle / 2) * cos(rocker.angle / 2) * (d + a)
        }
        start crossed(speed = 10.0) {
            crank.angle = 1 + 2 * PI * turns
            dot(crank.angle) = speed
            rocker.angle near -2 - 2 * PI * turns
            coupler.angle near -0.9
            coupler.x near d / 2
            rocker.x near d
        }
    }
}

/// Angles are known the less the more turns they have made; dead centres are passed all the same.
#[test]
fn dead_centres_after_many_turns_are_passed() {
    for (turns, drifts) in [(0.0, 1e-6), (30.0, 1e-6), (1000.0, 2e-6)] {
        for (method, tolerance) in [
            (Method::Dop853, 1e-9),
            (Method::Dop853, 1e-10),
            (Method::Dop853, 1e-12),
            (Method::Dopri5, 1e-12),
            (Method::Radau5, 1e-11),
        ] {
            for k in 0..5 {
                let speed = 12.533_333 + 4.1 * f64::from(k);
                let label = format!("{turns} turns, {speed}, {method}, {tolerance:e}");
                let crossed = Crossed {
                    turns,
                    ..Crossed::default()
                };
                let start = crossed.start("crossed", &[("speed", speed)].into());
                let run = Simulation::new(crossed)
                    .start(start.unwrap_or_else(|e| panic!("{label}: {e}")))
                    .method(method)
                    .tolerance(tolerance)
                    .every(0.02)
                    .until(0.6);
                let run = run.unwrap_or_else(|failure| panic!("{label}: {failure}"));
                let parted = run.output("parted").expect("it");
                let parted = largest(&parted);
                let drift = run.energy_drift();
                assert!(
                    parted < 1e-7 && drift < drifts,
                    "{label}: {parted:e}, {drift:e}"
                );
            }
        }
    }
}
