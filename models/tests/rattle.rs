//! RATTLE: order, energy over many steps, reversibility, and what it refuses.

use models::{
    DoublePendulum, DoubleScottRussell, FishRobot, KnifeEdge, MasslessSpring, Model, Pendulum,
    RigidBody, SpringPendulum, StartOptions, UChain,
};
use tests::{apart, at_rest, largest};
use ukcore::manifold::Stabilisation;
use ukcore::solver::Baumgarte;
use ukcore::{Error, Method, Simulation, State, Trajectory};

fn run<M: Model>(mechanism: M, start: State, step: f64, end: f64, every: f64) -> Trajectory {
    Simulation::new(mechanism)
        .start(start)
        .method(Method::Rattle { step })
        .every(every)
        .until(end)
        .unwrap_or_else(|e| panic!("{}", e.error))
}

fn released(angle: f64) -> (Pendulum, State) {
    let mech = Pendulum::default();
    let options = StartOptions::new().with("from", angle);
    let start = mech.start("released", &options).expect("a start");
    (mech, start)
}

/// Distance of the pendulum from where elliptic functions have it.
fn error(run: &Trajectory, from: f64) -> f64 {
    let end = run.last().expect("the run has an end");
    let mech = Pendulum::default();
    let (angle, rate) = mech.swing(from, end.t);
    let (q, v) = mech.at_angle(angle, rate);
    apart(end.q, &q).max(apart(end.v, &v))
}

#[test]
fn the_error_falls_with_the_fourth_power_of_the_step() {
    for end in [7.3, -7.3] {
        let (mech, start) = released(1.5);
        let at = |step| error(&run(mech.clone(), start.clone(), step, end, end.abs()), 1.5);
        let (coarse, fine) = (at(0.04), at(0.02));
        let observed = (coarse / fine).log2();
        assert!(
            (observed - 4.0).abs() < 0.3,
            "{observed}: {coarse:e}, {fine:e}"
        );
        assert!(fine < 1e-4, "{fine:e}");
    }
}

#[test]
fn between_steps_the_interpolant_is_as_good() {
    let (mech, start) = released(1.5);
    let run = run(mech.clone(), start, 0.02, 5.0, 0.013);
    for sample in run.samples() {
        let (angle, _) = mech.swing(1.5, sample.t);
        assert!((sample.q[0] - angle.sin()).abs() < 1e-5, "t = {}", sample.t);
    }
}

/// The chaotic double pendulum: other motions would look alike, but none of them would keep the energy.
#[test]
fn energy_stays_within_a_bound_without_a_trend() {
    let mech = DoublePendulum::default();
    let start = mech.default_start().expect("a start");
    let run = run(mech, start, 0.005, 500.0, 0.05);
    assert_eq!(run.work().steps, 100_000);
    let energy: Vec<f64> = run
        .energy()
        .iter()
        .map(ukcore::mechanism::Energy::total)
        .collect();
    let off = |part: &[f64]| {
        largest(
            part.iter()
                .map(|e| (e - energy[0]).abs())
                .collect::<Vec<_>>()
                .iter(),
        )
    };
    let quarter = energy.len() / 4;
    let (first, last) = (off(&energy[..quarter]), off(&energy[3 * quarter..]));
    // Energies are of the order of 20 J.
    assert!(
        first < 2e-5 && last < 1.5 * first,
        "{first:e}, then {last:e}"
    );
    let mean = |part: &[f64]| part.iter().map(|e| e - energy[0]).sum::<f64>() / part.len() as f64;
    let trend = mean(&energy[3 * quarter..]) - mean(&energy[..quarter]);
    assert!(trend.abs() < 0.1 * first, "{trend:e} of {first:e}");
    let residuals = run.residuals();
    assert!(largest(residuals.iter().map(|r| &r.position)) < 1e-14);
}

#[test]
fn a_run_back_ends_where_it_began() {
    let mech = UChain::default();
    let start = mech.default_start().expect("a start");
    let there = run(mech.clone(), start.clone(), 1e-3, 1.0, 1.0);
    let middle = there.last().expect("an end").to_state();
    let back = run(mech, middle, 1e-3, 0.0, 1.0);
    let end = back.last().expect("an end");
    for (a, b) in end.q.iter().zip(&start.q) {
        assert!((a - b).abs() < 1e-11, "{a} {b}");
    }
}

/// Redundant constraints have no straight line: the rank-revealing solve serves.
#[test]
fn redundant_constraints_are_served_too() {
    let mech = DoubleScottRussell::default();
    let start = mech.default_start().expect("a start");
    let dop853 = Simulation::new(mech.clone())
        .start(start.clone())
        .tolerance(1e-11);
    let dop853 = dop853.until(1.0).unwrap_or_else(|e| panic!("{}", e.error));
    let rattle = run(mech, start, 1e-3, 1.0, 1.0);
    let (a, b) = (
        dop853.last().expect("an end"),
        rattle.last().expect("an end"),
    );
    for (a, b) in a.q.iter().zip(b.q) {
        assert!((a - b).abs() < 1e-7, "{a} {b}");
    }
}

fn refusal<M: Model>(set: impl Fn(Simulation) -> Simulation) -> String {
    let mech = M::default();
    let start = mech.default_start().expect("a start");
    let simulation = Simulation::new(mech)
        .start(start)
        .method(Method::Rattle { step: 0.01 });
    let failure = set(simulation).until(1.0).expect_err("a refusal");
    assert!(
        matches!(failure.error, Error::InvalidSetting { .. }),
        "{}",
        failure.error
    );
    failure.error.to_string()
}

#[test]
fn what_it_cannot_do_is_refused_by_name() {
    for (message, part) in [
        (refusal::<FishRobot>(|s| s), "`th2` has no mass"),
        (refusal::<MasslessSpring>(|s| s), "`joint` has no mass"),
        (refusal::<KnifeEdge>(|s| s), "is a nonholonomic constraint"),
        (
            refusal::<RigidBody>(|s| s),
            "the mass matrix is not constant",
        ),
    ] {
        assert!(message.contains(part), "{message}");
    }
    let step = refusal::<Pendulum>(|s| s.method(Method::Rattle { step: 0.0 }));
    assert!(step.starts_with("`step` is 0.0"), "{step}");
    let largest = refusal::<Pendulum>(|s| s.max_step(0.1));
    assert!(largest.contains("`max_step` is given"), "{largest}");
    let baumgarte = Baumgarte {
        alpha: 20.0,
        beta: 20.0,
    };
    let baumgarte = refusal::<Pendulum>(|s| s.stabilise(Stabilisation::Baumgarte(baumgarte)));
    assert!(
        baumgarte.contains("keeps the constraints by itself"),
        "{baumgarte}"
    );
}

/// Too long a step for a stiff spring makes the energy grow from step to step: no result is better than such a one.
#[test]
fn steps_with_which_the_energy_runs_away_are_an_error() {
    let mech = SpringPendulum::default();
    let start = mech.default_start().expect("a start");
    for step in [0.05, 0.1, 0.2] {
        let run = Simulation::new(mech.clone()).start(start.clone());
        let failure = run.method(Method::Rattle { step }).until(5.0);
        let message = failure.expect_err("not a motion").error.to_string();
        assert!(
            message.contains("`step` is") && message.contains("too long"),
            "{message}"
        );
    }
    // A chain at rest in equilibrium exchanges no energy at all.
    let chain = UChain::default();
    let hanging = at_rest(&hanging());
    let run = run(chain, hanging, 0.01, 1.0, 0.1);
    assert_eq!(run.work().steps, 100);
}

/// Straight down from the support.
fn hanging() -> Vec<f64> {
    let down = (0..17).rev().map(|i| f64::from(i) + 1.0);
    std::iter::repeat_n(0.0, 17).chain(down).collect()
}

#[test]
fn a_step_after_which_the_rod_cannot_be_reached_is_an_error_by_name() {
    let (mech, start) = released(1.5);
    let failure = Simulation::new(mech)
        .start(start)
        .method(Method::Rattle { step: 3.0 });
    let failure = failure.until(30.0).expect_err("no rod is that long");
    let message = failure.error.to_string();
    assert!(
        message.contains("`rod`") && message.contains("step"),
        "{message}"
    );
}
