//! What a run records: samples, counters, quantities along the motion, CSV.

use super::*;
use approx::assert_abs_diff_eq;

#[test]
fn samples_do_not_change_the_steps_and_lie_near_the_end_of_runs_to_them() {
    for method in [Method::Dop853, Method::Dopri5] {
        for tolerance in [1e-6, 1e-9, 1e-11] {
            let plain = swing(1.0, tolerance).method(method).until(3.0).unwrap();
            let times: Vec<f64> = (1..30).map(|k| 0.1 * f64::from(k)).collect();
            let run = swing(1.0, tolerance).method(method).at(times.clone());
            let run = run.until(3.0).unwrap();
            assert_eq!(run.work().steps, plain.work().steps);
            assert_eq!(
                run.last().unwrap().to_state(),
                plain.last().unwrap().to_state()
            );
            assert_eq!(run.times(), times);
            // Largest error over the times: sampled, and where a run of its own ends there.
            let exact = swing(1.0, 1e-13).at(times).until(3.0).unwrap();
            let (mut sampled, mut ended) = (0.0_f64, 0.0_f64);
            for (sample, exact) in run.samples().zip(exact.samples()) {
                let end = swing(1.0, tolerance).method(method).until(exact.t);
                sampled = sampled.max(distance(sample, exact));
                ended = ended.max(distance(end.unwrap().last().unwrap(), exact));
            }
            assert!(sampled < 10.0 * ended, "{method:?}: {sampled}, {ended}");
        }
    }
}

#[test]
fn samples_at_given_times_include_start_and_end_only_if_asked_for() {
    let times = |times: &[f64]| {
        let run = swing(1.0, 1e-9).at(times.to_vec()).until(1.0).unwrap();
        assert_eq!(run.last().unwrap().t, 1.0);
        run.times().to_vec()
    };
    for asked in [&[][..], &[0.0], &[1.0], &[0.0, 0.5, 1.0], &[1.0 - 1e-16]] {
        assert_eq!(times(asked), asked);
    }
}

#[test]
fn equidistant_samples_lie_at_the_decimals_that_were_asked_for() {
    let times = |dt: f64, t0: f64, t_end: f64| {
        let start = state(t0, 1.0, 0.0);
        let run = Simulation::new(Pendulum::default()).start(start).every(dt);
        run.until(t_end).unwrap().times().to_vec()
    };
    assert_eq!(times(0.3, 0.0, 1.3), [0.0, 0.3, 0.6, 0.9, 1.2, 1.3]);
    assert_eq!(times(0.1, 0.2, 0.7), [0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
    assert_eq!(times(0.3, 0.0, -1.0), [0.0, -0.3, -0.6, -0.9, -1.0]);
    assert_eq!(times(0.05, 0.1, -0.1), [0.1, 0.05, 0.0, -0.05, -0.1]);
    let third = 1.0 / 3.0;
    assert_eq!(times(third, 0.0, 1.1), [0.0, third, 2.0 * third, 1.0, 1.1]);
    assert_eq!(times(1e-3, 0.0, 1.0)[999], 0.999);
}

#[test]
fn counters_are_consistent() {
    let seen = Rc::new(RefCell::new(Vec::new()));
    let times = Rc::clone(&seen);
    let run = swing(3.0, 1e-9)
        .progress(move |now| {
            times.borrow_mut().push(now.t);
            ControlFlow::Continue(())
        })
        .until(10.0)
        .unwrap();
    let work = run.work();
    assert_eq!(*seen.borrow(), run.times()[1..]);
    assert_eq!(work.steps + 1, run.len());
    assert!(work.rejected > 0);
    let attempts = work.steps + work.rejected;
    assert_eq!(work.evaluations, 2 + 11 * attempts + work.steps);
    assert_eq!(work.projections, 1 + work.steps);
    assert!(work.projection_iterations <= 3 * 2 * work.projections);
    assert_eq!(work.fallbacks, 0);
}

#[test]
fn progress_can_end_a_run() {
    let run = swing(1.0, 1e-9).progress(|now| {
        if now.t > 1.0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    let run = run.every(0.25).until(10.0).unwrap();
    assert_eq!(run.ending(), Ending::Interrupted);
    let last = run.last().unwrap();
    assert!(last.t > 1.0 && last.t < 2.0);
    assert_eq!(run.samples().next_back(), Some(last));
}

#[test]
fn a_run_of_no_length_has_its_start() {
    let run = swing(1.0, 1e-9).every(0.1).dense().until(0.0).unwrap();
    assert_eq!((run.len(), run.ending()), (1, Ending::Completed));
    assert_eq!(run.last(), run.sample(0));
    assert_eq!(run.at(0.0).unwrap(), run.last().unwrap().to_state());
    assert_eq!(run.work().steps, 0);
}

#[test]
fn quantities_along_the_motion_agree_with_closed_forms() {
    let angle = 1.0_f64;
    let run = swing(angle, 1e-11).every(0.05).until(2.0).unwrap();
    let angles = run.output("angle").unwrap();
    let solutions = run.solutions().unwrap();
    let accelerations = run.accelerations().unwrap();
    assert_abs_diff_eq!(angles[0], angle, epsilon = 1e-15);
    for (i, sample) in run.samples().enumerate() {
        // Tension: m (v²/l + g cos θ), along the rod; λ = −tension / 2l since A = 2 (x, y).
        let speed = sample.v[0] * sample.v[0] + sample.v[1] * sample.v[1];
        let tension = speed + 9.8 * angles[i].cos();
        assert!((solutions[i].multipliers[0] + 0.5 * tension).abs() < 1e-12);
        let expect = [-tension * sample.q[0], -tension * sample.q[1] - 9.8];
        for (a, expect) in accelerations[i].iter().zip(expect) {
            assert_abs_diff_eq!(*a, expect, epsilon = 1e-12);
        }
    }
    assert_eq!(run.coordinate("x").unwrap()[0], angle.sin());
    assert_eq!(run.velocity("x").unwrap()[0], 0.0);
    assert!(run.coordinate("z").is_err());
}

#[test]
fn csv_reads_back_as_the_same_numbers() {
    let run = swing(1.0, 1e-9).every(0.3).until(1.0).unwrap();
    let mut csv = Vec::new();
    run.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    let mut lines = csv.lines();
    assert_eq!(
        lines.next().unwrap(),
        "t,x,y,dot(x),dot(y),angle,energy,residual"
    );
    for (line, sample) in lines.by_ref().zip(run.samples()) {
        let row: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        assert_eq!(row.len(), 8);
        assert_eq!(row[0], sample.t);
        assert_eq!(row[1..3], *sample.q);
        assert_eq!(row[3..5], *sample.v);
    }
    assert_eq!(csv.lines().count(), 1 + run.len());
}
