//! Loops that fold one shortly after the other, and have nothing to do with each other: each goes on in its own branch.

use std::f64::consts::PI;

use tests::assert_close;
use ukcore::{Method, Simulation};

ukcore::multibody! {
    /// Two parallelograms, without gravity: all cranks turn evenly.
    Pair {
        params { l = 0.5, d = 0.8 }
        bodies {
            for i in 0..2 {
                planar crank[i] { mass: 1, inertia: 0.02, centre: [l / 2, 0] }
                planar other[i] { mass: 1, inertia: 0.02, centre: [l / 2, 0] }
                planar bar[i] { mass: 2, inertia: 0.1, centre: [d / 2, 0] }
            }
        }
        holonomic {
            for i in 0..2 {
                a[i]: pin(ground.at([0, 2 * i]), crank[i].at([0, 0]))
                b[i]: pin(ground.at([d, 2 * i]), other[i].at([0, 0]))
                c[i]: pin(crank[i].at([l, 0]), bar[i].at([0, 0]))
                e[i]: pin(other[i].at([l, 0]), bar[i].at([d, 0]))
            }
        }
        start from(one = 1.0, two = 1.0, w = 1.0, w2 = 1.0) {
            crank[0].angle = one
            crank[1].angle = two
            dot(crank[0].angle) = w
            dot(crank[1].angle) = w2
            other[0].angle near one
            other[1].angle near two
            bar[0].centre near [d / 2 + l * cos(one), l * sin(one)]
            bar[1].centre near [d / 2 + l * cos(two), 2 + l * sin(two)]
        }
    }
}

ukcore::multibody! {
    /// One shaft turns two parallelograms. The second one would fold when the shaft has turned by `after` more, but for its bar, which is
    /// longer by `more` than it is to be.
    Shaft {
        params { l = 0.5, d = 0.8, l2 = 0.4, d2 = 0.9, after = 0.1, more = 0 }
        bodies {
            planar shaft { mass: 1, inertia: 0.02, centre: [0, 0] }
            planar other { mass: 1, inertia: 0.02, centre: [l / 2, 0] }
            planar bar { mass: 2, inertia: 0.1, centre: [d / 2, 0] }
            planar second { mass: 1, inertia: 0.02, centre: [l2 / 2, 0] }
            planar rod { mass: 1, inertia: 0.1, centre: [d2 / 2, 0] }
        }
        holonomic {
            a: pin(ground.at([0, 0]), shaft.at([0, 0]))
            b: pin(ground.at([d, 0]), other.at([0, 0]))
            c: pin(shaft.at([l, 0]), bar.at([0, 0]))
            e: pin(other.at([l, 0]), bar.at([d, 0]))
            b2: pin(ground.at([d2, 0]), second.at([0, 0]))
            c2: pin(shaft.at([l2 * cos(after), -l2 * sin(after)]), rod.at([0, 0]))
            e2: pin(second.at([l2, 0]), rod.at([d2 + more, 0]))
        }
        start from(one = 1.0, w = 1.0) {
            shaft.angle = one
            dot(shaft.angle) = w
            other.angle near one
            bar.centre near [d / 2 + l * cos(one), l * sin(one)]
            second.angle near one - after
            rod.centre near [d2 / 2 + l2 * cos(one - after), l2 * sin(one - after)]
        }
    }
}

/// Where the bar is longer the second loop goes by its fold without changing sides; where it is shorter it is stopped there, and the shaft
/// turns back. A step that goes over the fold of the first loop does not go over this unseen.
#[test]
fn a_fold_that_is_missed_behind_another_is_not_gone_over() {
    for (after, more) in [5e-2, 0.1, 0.2]
        .into_iter()
        .flat_map(|after| [1e-6, 1e-8, 1e-10, -1e-8, -1e-9].map(|more| (after, more)))
    {
        let shaft = Shaft {
            after,
            more,
            ..Shaft::default()
        };
        let start = shaft.start("from", &[("one", 2.6)].into());
        let start = start.expect("a start");
        let side = |q: &[f64]| (q[Shaft::SECOND_ANGLE] - q[Shaft::ROD_ANGLE]).sin() > 0.0;
        for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
            for tolerance in [1e-4, 1e-5, 1e-6] {
                let name = format!("{after:e}, {more:e}, {method}, {tolerance:e}");
                let run = Simulation::new(&shaft)
                    .start(start.clone())
                    .method(method)
                    .tolerance(tolerance)
                    .until(PI + 0.3 - 2.6);
                let run = run.unwrap_or_else(|failure| panic!("{name}: {failure}"));
                let last = &run.last().expect("an end").q;
                let most = run
                    .samples()
                    .fold(0.0_f64, |most, at| most.max(at.q[Shaft::SHAFT_ANGLE]));
                match more > 0.0 {
                    true => assert_eq!(side(last), side(&start.q), "{name}"),
                    false => assert!(most < PI + after, "{name}: {most}"),
                }
            }
        }
    }
}

#[test]
fn loops_that_fold_shortly_after_each_other_are_passed() {
    let mut refused = 0;
    for (k, after) in [1e-2, 2e-3, 1e-3, 2e-4, 1e-5, 1e-6, 1e-8, 0.0, -1e-3, 1.0]
        .into_iter()
        .enumerate()
    {
        for (w, w2) in [(7.3, 18.1), (18.83, 10.81), (12.1, 12.3), (7.7, 15.4)] {
            // The first loop folds then, the other one after that.
            let folds = 0.4 + 0.013 * k as f64;
            let (one, two) = (PI - w * folds, PI - w2 * (folds + after));
            let start = [("one", one), ("two", two), ("w", w), ("w2", w2)].into();
            let start = Pair::default().start("from", &start).expect("a start");
            let end = folds + 0.06;
            for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
                for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
                    let name = format!("{after:e}, {w}, {w2}, {method}, {tolerance:e}");
                    let run = Simulation::new(Pair::default())
                        .start(start.clone())
                        .method(method)
                        .tolerance(tolerance)
                        .until(end);
                    let run = match run {
                        Ok(run) => run,
                        // So near that the second one is not always told from the first.
                        Err(_) if after.abs() < 1e-4 => {
                            refused += 1;
                            continue;
                        }
                        Err(failure) => panic!("{name}: {failure}"),
                    };
                    let last = run.last().expect("an end");
                    for (angles, at) in [
                        (Pair::CRANK_ANGLE, [one + w * end, two + w2 * end]),
                        (Pair::OTHER_ANGLE, [one + w * end, two + w2 * end]),
                    ] {
                        for (angle, at) in angles.into_iter().zip(at) {
                            assert_close(&name, last.q[angle], at, 1e-7 + 100.0 * tolerance);
                        }
                    }
                }
            }
        }
    }
    // Of 240.
    assert!(refused < 30, "{refused}");
}
