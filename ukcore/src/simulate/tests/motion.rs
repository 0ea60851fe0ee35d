//! The motion itself: accuracy, invariants, direction, other mechanisms.

use super::*;
use crate::mechanism::Mechanism;
use approx::assert_abs_diff_eq;

#[test]
fn a_pendulum_returns_after_its_period() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        for angle in [0.1, FRAC_PI_2, 3.0] {
            let time = period(angle);
            let run = swing(angle, 1e-12).method(method).until(time).unwrap();
            let (start, end) = (run.sample(0).unwrap(), run.last().unwrap());
            assert_eq!(end.t, time);
            assert_eq!(run.ending(), Ending::Completed);
            // A swing from almost upright magnifies errors.
            let bound = if angle > 2.0 { 1e-8 } else { 2e-10 };
            let off = distance(start, end);
            assert!(off < bound, "{method:?}, {angle}: {off}");
        }
    }
}

#[test]
fn error_falls_with_the_order_of_the_method_under_projection() {
    // After five periods and a quarter it passes the bottom with the speed of the fall.
    let time = 5.25 * period(1.0);
    let speed = f64::sqrt(2.0 * 9.8 * (1.0 - f64::cos(1.0)));
    let (q, v) = (&[0.0, -1.0], &[-speed, 0.0]);
    for (method, order) in [
        (Method::Dop853, 8.0),
        (Method::Dopri5, 5.0),
        (Method::Radau5, 5.0),
    ] {
        let run = |tolerance| {
            let run = swing(1.0, tolerance).method(method).until(time).unwrap();
            let off = distance(
                Sample {
                    t: time,
                    q,
                    v,
                    integrals: &[],
                },
                run.last().unwrap(),
            );
            (off, run.work().steps as f64)
        };
        let ((coarse, few), (fine, many)) = (run(1e-8), run(1e-12));
        let observed = (coarse / fine).ln() / (many / few).ln();
        // More, if error control and projection leave less than the leading term.
        assert!(observed > order - 0.5, "{method:?}: {observed}");
        assert!(observed < order + 2.0, "{method:?}: {observed}");
        assert!(fine < 1e-9, "{fine}");
    }
}

/// What all but rests exchanges energy at the level of rounding, of which rounding is no drift.
#[test]
fn rounding_of_energies_is_no_drift_of_a_motion_that_is_as_small() {
    for k in 2..12 {
        let angle = 10_f64.powi(-k);
        let run = swing(angle, 1e-12).until(2.0).unwrap();
        // Of a motion whose energy is well above rounding the drift is that of the motion.
        let bound = if k < 5 { 1e-7 } else { 1e-13 };
        let drift = run.energy_drift();
        assert!(drift < bound, "{angle:e}: {drift:e}");
    }
    let loose = swing(1.0, 1e-4).until(20.0).unwrap();
    assert!(loose.energy_drift() > 1e-7, "{:e}", loose.energy_drift());
}

#[test]
fn energy_and_constraints_hold_at_all_samples() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        let run = swing(2.0, 1e-12).method(method).every(0.013).until(20.0);
        let run = run.unwrap();
        assert!(run.energy_drift() < 1e-9, "{}", run.energy_drift());
        for residual in run.residuals() {
            assert!(residual.largest() <= 1e-12, "{residual:?}");
        }
        assert_eq!(run.len(), 1 + (20.0_f64 / 0.013) as usize + 1);
        for (k, sample) in run.samples().enumerate().take(run.len() - 1) {
            // The nearest number to the decimal.
            assert_eq!(sample.t, (13 * k) as f64 / 1000.0);
        }
        assert_eq!(run.samples().next_back().unwrap().t, 20.0);
    }
}

#[test]
fn drift_is_visible_without_stabilisation_and_damped_with_baumgarte() {
    let drift = |stabilisation| {
        let run = swing(2.0, 1e-6).stabilise(stabilisation).until(50.0);
        let run = run.unwrap();
        let last = *run.residuals().last().unwrap();
        (last.position, run.work())
    };
    let (projected, work) = drift(Stabilisation::Projection);
    assert!(projected < 1e-14);
    assert!(work.projections > work.steps);
    let (none, work) = drift(Stabilisation::None);
    assert!(none > 1e-6, "{none}");
    // The start, and nothing else.
    assert_eq!(work.projections, 1);
    let (alpha, beta) = (10.0, 10.0);
    let (damped, work) = drift(Stabilisation::Baumgarte(Baumgarte { alpha, beta }));
    assert!(damped < 0.1 * none, "{damped} of {none}");
    assert_eq!(work.projections, 1);
}

/// As it grows in one direction of time where it decays in the other.
#[test]
fn drift_is_damped_with_baumgarte_in_both_directions_of_time() {
    for (alpha, beta) in [(10.0, 10.0), (100.0, 100.0), (5.0, 0.0)] {
        for (method, tolerance) in [(Method::Dop853, 1e-4), (Method::Radau5, 1e-8)] {
            let [forward, backward] = [10.0, -10.0].map(|end| {
                let run = swing(2.0, tolerance).method(method);
                let run = run.stabilise(Stabilisation::Baumgarte(Baumgarte { alpha, beta }));
                let run = run.until(end).unwrap();
                let drifts = run.residuals().into_iter().map(|r| r.position);
                drifts.fold(0.0, f64::max)
            });
            assert!(
                backward < 10.0 * forward && forward < 1e4 * tolerance,
                "{method}, {alpha}, {beta}: {backward:e} beside {forward:e}"
            );
        }
    }
}

#[test]
fn a_run_backward_returns_to_the_start() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        let there = swing(2.5, 1e-12).method(method).dense().until(3.0).unwrap();
        let end = there.last().unwrap().to_state();
        let back = Simulation::new(Pendulum::default())
            .start(end)
            .method(method)
            .tolerance(1e-12)
            .every(0.25)
            .dense()
            .until(0.0)
            .unwrap();
        let start = there.sample(0).unwrap();
        let off = distance(start, back.last().unwrap());
        assert!(off < 1e-9, "{off}");
        let times: Vec<f64> = (0..=12).map(|k| 3.0 - 0.25 * f64::from(k)).collect();
        assert_eq!(back.times(), times);
        for t in [0.0, 0.3, 1.7, 2.999, 3.0] {
            let (a, b) = (there.at(t).unwrap(), back.at(t).unwrap());
            assert!((a.q[0] - b.q[0]).abs() < 1e-9, "{a:?} {b:?}");
            let r = f64::hypot(b.q[0], b.q[1]);
            assert_abs_diff_eq!(r, 1.0, epsilon = 1e-15);
        }
        assert!(there.at(3.1).is_err());
        assert!(there.at(f64::NAN).is_err());
    }
}

#[test]
fn redundant_constraints_change_nothing() {
    let run = toy(fixture::Twice::default(), &[1.0, 0.0, 1.0, -1.0], &[0.0; 4]);
    let run = run.every(0.1).until(10.0).unwrap();
    for (sample, energy) in run.samples().zip(run.energy()) {
        // Masses 1 and 2; the fixture leaves V out.
        let potential = 9.8 * (sample.q[1] + 2.0 * (sample.q[3] + 1.0));
        assert!((energy.kinetic + potential).abs() < 1e-8);
    }
    assert!(run.residuals().iter().all(|r| r.largest() < 1e-12));
    assert!(run.solutions().unwrap().iter().all(|s| s.rank == 2));

    // The copy is implied on the manifold only; stages of a step lie off it.
    let (s, c) = f64::sin_cos(0.3);
    let cranks = toy(
        fixture::Parallelogram::default(),
        &[c, s, 2.0 + c, s],
        &[0.0; 4],
    );
    let run = cranks.every(0.1).until(1.0).unwrap();
    assert!(run.residuals().iter().all(|r| r.largest() < 1e-12));
    for sample in run.samples() {
        assert!((sample.q[2] - sample.q[0] - 2.0).abs() < 1e-12);
    }
}

#[test]
fn massless_and_prescribed_coordinates_follow_closed_forms() {
    // Two springs in series: stiffness k₁ k₂ / (k₁ + k₂) = 15/8, mass 2.
    let rate = f64::sqrt(15.0 / 16.0);
    let run = toy(fixture::Springs::default(), &[0.8, 0.5], &[0.0, 0.0]);
    let run = run.every(0.1).until(20.0).unwrap();
    for sample in run.samples() {
        let x = 0.8 * (rate * sample.t).cos();
        assert_abs_diff_eq!(sample.q[0], x, epsilon = 1e-9);
        assert_abs_diff_eq!(sample.q[1], 0.625 * sample.q[0], epsilon = 1e-14);
    }
    let run = toy(fixture::Prescribed::default(), &[0.0, 0.0], &[1.0, 0.0]);
    let run = run.every(0.1).until(-7.0).unwrap();
    for sample in run.samples() {
        assert_abs_diff_eq!(sample.q[0], sample.t.sin(), epsilon = 1e-14);
        assert_abs_diff_eq!(sample.v[0], sample.t.cos(), epsilon = 1e-14);
        assert_abs_diff_eq!(sample.q[1], 1.5 * sample.t * sample.t, epsilon = 1e-9);
    }
}

/// A run of `mechanism` from (q, v) at t = 0, projected.
fn toy<M: Mechanism>(mechanism: M, q: &[f64], v: &[f64]) -> Simulation {
    let (t, q, v) = (0.0, q.to_vec(), v.to_vec());
    Simulation::new(&mechanism)
        .start(State { t, q, v })
        .tolerance(1e-11)
}

/// A run may go back, to a singular position that it came too near to: what rows did before says nothing of the way from there.
#[test]
fn a_watch_of_rows_that_goes_back_looks_as_one_that_begins() {
    use crate::simulate::vanishing::RowWatch;
    let mechanism = Prepared::from(&Pendulum::default());
    let state = |t: f64| State {
        t,
        q: vec![t.sin(), -t.cos()],
        v: vec![t.cos(), t.sin()],
    };
    let step = |watch: &mut RowWatch, from: f64, to: f64, turns: bool| {
        let (old, mut new) = (state(from), state(to));
        if turns {
            new.v.iter_mut().for_each(|v| *v = -*v);
        }
        let found = watch.vanishing(&mechanism, Sample::from(&old), Sample::from(&new));
        assert!(found.is_none());
        watch.accept(to);
    };
    let mut watch = RowWatch::new(Method::Dop853, 1e-6);
    for (from, to) in [(0.0, 0.3), (0.3, 0.6), (0.6, 1.2)] {
        step(&mut watch, from, to, false);
    }
    // Back, where it turns, so that rows are looked at.
    step(&mut watch, 0.1, 0.2, true);
    step(&mut watch, 0.2, 0.25, false);
    let mut fresh = RowWatch::new(Method::Dop853, 1e-6);
    step(&mut fresh, 0.2, 0.25, false);
    assert_eq!(watch.due, fresh.due);
    assert!(fresh.due > 0.25);
}
