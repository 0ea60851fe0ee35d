//! The falling U-chain against the paper's Table 1 and Figs. 2-6, and against a reference in 113-bit arithmetic.

use models::uchain::TABLE_1;
use models::{Model, StartOptions, UChain};
use serde_json::Value;
use tests::{apart, assert_all_close, assert_close, largest, residuals};
use ukcore::simulate::Direction;
use ukcore::solver::SolverOptions;
use ukcore::{Error, Event, Mechanism, Simulation, Solver, State, Trajectory};

/// For x0 = 12 … 16: lowest point, m, and its time, s, by an independent integration in angles at 1e-12, which agrees with the
/// 113-bit reference in `models/data/uchain.json` to its digits; deepest acceleration of the tip, m/s².
const REFERENCE: [(f64, f64, f64); 5] = [
    (15.942_962_3, 1.635_099_2, -199.18),
    (15.989_480_2, 1.685_285_2, -203.80),
    (16.070_310_0, 1.748_267_8, -219.72),
    (16.322_729_1, 1.801_885_3, -267.52),
    (16.670_601_8, 1.841_484_0, -336.62),
];

fn start(name: &str, x0: f64) -> State {
    let options = StartOptions::new().with("x0", x0);
    UChain::default()
        .start(name, &options)
        .expect("the chain reaches from the support to the tip")
}

fn lowest_point() -> Event {
    Event::new("lowest", |_t, _q, v| v[UChain::Y[0]]).direction(Direction::Falling)
}

fn fall(x0: f64) -> Trajectory {
    Simulation::new(UChain::default())
        .start(start("trapezoid", x0))
        .tolerance(1e-10)
        .event(lowest_point())
        .dense()
        .until(1.95)
        .unwrap_or_else(|e| panic!("x0 = {x0}: {}", e.error))
}

/// Vertical acceleration of the tip.
fn tip_acceleration(solver: &mut Solver, state: &State) -> f64 {
    let mut acceleration = vec![0.0; UChain::SPEC.n()];
    solver
        .acceleration(state.t, &state.q, &state.v, &mut acceleration)
        .expect("the chain's constraints are independent");
    acceleration[UChain::Y[0]]
}

/// Deepest vertical acceleration of the tip: the least of the accepted steps, then ever finer around it.
fn peak(run: &Trajectory) -> f64 {
    let mut solver = Solver::new(run.mechanism(), SolverOptions::default());
    let mut value = |t: f64| {
        let state = run.at(t).expect("the run is dense");
        tip_acceleration(&mut solver, &state)
    };
    let times = run.times();
    let values: Vec<f64> = times.iter().map(|t| value(*t)).collect();
    let least = (0..values.len())
        .min_by(|a, b| values[*a].total_cmp(&values[*b]))
        .expect("there are steps");
    let mut centre = times[least];
    let mut reach = times[least + 1] - times[least - 1];
    let mut deepest = values[least];
    // Each round narrows the search fivefold; the peak is quadratic, so the error falls with the square.
    for _ in 0..4 {
        for k in -10..=10 {
            let t = centre + reach * f64::from(k) / 10.0;
            let found = value(t);
            if found < deepest {
                (deepest, centre) = (found, t);
            }
        }
        reach /= 5.0;
    }
    deepest
}

#[test]
fn table_1_and_peaks() {
    let data: Value = serde_json::from_str(include_str!("../data/uchain.json")).expect("JSON");
    for (row, (h_max, t_max, deepest)) in TABLE_1.iter().zip(REFERENCE) {
        let case = format!("x0 = {}", row.x0);
        let run = fall(row.x0);
        let hit = run
            .events("lowest")
            .expect("watched")
            .next()
            .expect("the tip turns");
        let depth = hit.q[UChain::Y[0]];
        // The paper prints output points of its solver: within 0.001.
        assert_close(&format!("{case}, printed h_max"), depth, row.h_max, 1e-3);
        assert_close(&format!("{case}, printed t_max"), hit.t, row.t_max, 1e-3);
        assert_close(&format!("{case}, h_max"), depth, h_max, 1e-6);
        assert_close(&format!("{case}, t_max"), hit.t, t_max, 1e-6);
        let reference = data["tip_lowest_point"][format!("{}", row.x0)]["fall"]
            .as_f64()
            .expect("a number");
        assert_close(&format!("{case}, 113-bit h_max"), depth, reference, 1e-6);
        let free = UChain::default().free_fall(row.t_max);
        // Half a unit of the last printed digit of t_max is 5e-4 s · g t.
        assert_close(
            &format!("{case}, free fall"),
            free,
            row.free_fall,
            5e-4 * 9.8 * 1.9,
        );
        assert_close(&format!("{case}, peak"), peak(&run), deepest, 0.1);
    }
}

#[test]
fn tip_is_ahead_of_a_free_fall_until_it_turns() {
    for row in TABLE_1 {
        let run = fall(row.x0);
        for sample in run.samples().filter(|s| s.t > 0.0 && s.t < row.t_max) {
            let ahead = sample.q[UChain::Y[0]] - UChain::default().free_fall(sample.t);
            // At the very start both fall alike, and the difference is rounding.
            assert!(ahead > -1e-12, "x0 = {}, t = {}: {ahead}", row.x0, sample.t);
        }
        let last = run.at(row.t_max).expect("the run is dense");
        assert!(last.q[UChain::Y[0]] > UChain::default().free_fall(row.t_max));
    }
}

/// A rounding error of the start alone, 1e-16 to 1e-15, grows to 135 times as much by then; and which error a run has depends on the steps
/// it happens to take. So the median over some tolerances counts.
#[test]
fn with_the_tightest_tolerances_states_are_right_to_thirteen_decimals() {
    let reference = UChain::references().remove(0);
    let expected = reference.states.last().expect("to 1.5 s");
    let mut errors: Vec<f64> = (0..15)
        .map(|k| {
            let run = Simulation::new(UChain::default())
                .start(start("trapezoid", 12.0))
                .tolerance(4e-14 * 0.9_f64.powi(k))
                .until(1.5)
                .unwrap_or_else(|e| panic!("{}", e.error));
            let last = run.last().expect("the run has an end");
            apart(last.q, &expected.q).max(apart(last.v, &expected.v))
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    assert!(errors[7] < 1e-13, "{errors:?}");
}

#[test]
fn states_agree_with_the_reference() {
    let mut state = start("trapezoid", 12.0);
    for expected in UChain::references().remove(1).states {
        let time = expected.t;
        let run = Simulation::new(UChain::default())
            .start(state)
            .tolerance(1e-10)
            .until(time)
            .unwrap_or_else(|e| panic!("{}", e.error));
        assert_eq!(
            run.work().fallbacks,
            0,
            "the straight line serves all the way"
        );
        let last = run.last().expect("the run has an end");
        assert_all_close(&format!("q at {time}"), last.q, &expected.q, 1e-8);
        assert_all_close(&format!("v at {time}"), last.v, &expected.v, 1e-8);
        // φ = (length² − l²), so the length itself is off by half of it.
        let residuals = run.residuals();
        let lengths = largest(residuals.iter().map(|r| &r.position));
        assert!(
            lengths < 1e-12,
            "links are off by {lengths:e} at t = {time}"
        );
        state = last.to_state();
    }
}

#[test]
fn catenary_is_in_equilibrium() {
    // Holding the tip leaves no net force along any virtual displacement: with the tip's own motion taken out, gravity
    // is balanced by forces along the links. Checked here by the links' tensions: H and the vertical steps of m g.
    for x0 in [3.0, 12.0, 15.5, 16.9] {
        let state = start("catenary", x0);
        let chain = UChain::default();
        let at = |i: usize| (state.q[UChain::X[i]], state.q[UChain::Y[i]]);
        assert_all_close("tip", &[at(0).0, at(0).1], &[x0, 0.0], 1e-13 * x0);
        // Slopes of the links from the support on: tan θ = k m g/H, k = 8 … −8.
        let mut points = vec![(0.0, 0.0)];
        points.extend((0..17).rev().map(at));
        let slopes: Vec<f64> = points
            .windows(2)
            .map(|w| (w[1].1 - w[0].1) / (w[1].0 - w[0].0))
            .collect();
        let step = slopes[0] / 8.0;
        for (slope, k) in slopes.iter().zip((-8..=8).rev()) {
            assert_close("slope", *slope, f64::from(k) * step, 1e-11 * slopes[0]);
        }
        let phi = residuals(&chain, 0.0, &state.q);
        assert!(largest(&phi) < 1e-13, "{phi:?}");
    }
}

#[test]
fn starts_are_where_they_should_be() {
    for x0 in [1.0, 4.2, 9.0, 12.0, 12.5, 15.999, 16.0, 17.0] {
        let state = start("trapezoid", x0);
        assert_close("x of the tip", state.q[UChain::X[0]], x0, 1e-13);
        assert_close("y of the tip", state.q[UChain::Y[0]], 0.0, 1e-13);
    }
    // The paper's: 5 links down at 60°, 7 level, 5 up.
    let state = start("trapezoid", 12.0);
    assert_close("depth", state.q[UChain::Y[8]], 5.0 * 0.75_f64.sqrt(), 1e-14);
    assert_close("first joint", state.q[UChain::X[16]], 0.5, 1e-15);
    for (name, x0) in [
        ("trapezoid", 17.5),
        ("trapezoid", 0.5),
        ("catenary", 17.0),
        ("catenary", 1.0),
    ] {
        let options = StartOptions::new().with("x0", x0);
        let error = UChain::default()
            .start(name, &options)
            .expect_err("out of reach");
        assert!(
            matches!(error, Error::InvalidSetting { what: "x0", .. }),
            "{error}"
        );
    }
}

#[test]
fn link_forces_are_internal() {
    // Newton's third law: what the constraints do to all particles together is the pull of the support, along the last link.
    let run = fall(12.0);
    let mut solver = Solver::new(run.mechanism(), SolverOptions::default());
    for sample in run.samples().step_by(25) {
        let solution = solver
            .solve(sample.t, sample.q, sample.v)
            .expect("the chain's constraints are independent");
        let force =
            |which: [usize; 17]| -> f64 { which.iter().map(|i| solution.ideal_force[*i]).sum() };
        let (x, y) = (sample.q[UChain::X[16]], sample.q[UChain::Y[16]]);
        let across = force(UChain::X) * y - force(UChain::Y) * x;
        let size = largest(&solution.ideal_force);
        assert_close(
            "force across the last link",
            across,
            0.0,
            1e-11 * size.max(1.0),
        );
    }
}

#[test]
fn wrong_start_names_are_answered() {
    let chain = UChain::default();
    let error = chain
        .start("trapezium", &StartOptions::new())
        .expect_err("a slip");
    assert_eq!(
        error.to_string(),
        "no start is called `trapezium`; did you mean `trapezoid`? There are `trapezoid`, `catenary`"
    );
    let options = StartOptions::new().with("x", 12.0);
    let error = chain.start("catenary", &options).expect_err("a slip");
    assert_eq!(
        error.to_string(),
        "no start option is called `x`; did you mean `x0`?"
    );
}
