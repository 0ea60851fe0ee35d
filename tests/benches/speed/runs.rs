//! Whole runs, and many chains at once.

use std::hint::black_box;

use ivp::ivp::FirstOrderSystem;
use ivp::methods::{DOP853, IntegrationResult, Tolerance};
use ivp::solout::{ControlFlag, SolOut};
use models::{Model, UChain};
use serde_json::Value;
use ukcore::{Ensemble, LaneSolver, Lanes, Mechanism, Simulation, Stabilisation, State};
use wide::{f64x4, f64x8};

use crate::accelerations::states;
use crate::chain::{self, Chain};
use crate::harness::{Contender, Group};

/// Links.
const N: usize = 17;
const END: f64 = 1.5;

fn parameters(mech: &UChain) -> Chain {
    black_box(Chain {
        m: mech.m,
        l: mech.l,
        g: mech.g,
    })
}

/// ẏ of y = (q, q̇), by hand.
struct RightHandSide(Chain);

impl FirstOrderSystem for RightHandSide {
    fn derivative(&self, _t: f64, y: &[f64], rate: &mut [f64]) {
        let (q, v) = y.split_at(2 * N);
        let (dq, dv) = rate.split_at_mut(2 * N);
        dq.copy_from_slice(v);
        chain::both_ends_minors::<N>(&self.0, q, v, dv);
    }
}

/// Keeps the last state.
struct Last(Vec<f64>);

impl SolOut for Last {
    fn solout(
        &mut self,
        _before: f64,
        _t: &mut f64,
        y: &mut [f64],
        _interpolant: Option<&ivp::dense::StepInterpolant<'_>>,
    ) -> ControlFlag {
        self.0.copy_from_slice(y);
        ControlFlag::Continue
    }
}

/// The run by DOP853 alone, with neither projection nor trajectory: last state, and the integrator's report.
fn bare(chain: Chain, start: &State, tolerance: f64) -> (Vec<f64>, IntegrationResult) {
    let mut y = start.q.clone();
    y.extend(&start.v);
    let mut last = Last(y.clone());
    let method = DOP853 {
        stiff_test: usize::MAX,
        dense_output: false,
        ..DOP853::default()
    };
    let tolerance = Tolerance::Scalar(tolerance);
    let report = method
        .solve(
            &RightHandSide(chain),
            0.0,
            &y,
            END,
            tolerance.clone(),
            tolerance,
            Some(&mut last),
        )
        .expect("the settings are valid");
    assert!(report.is_ok(), "the run succeeds");
    (last.0, report)
}

/// The run by ours: last state, and evaluations.
fn ours_alone(
    mech: &UChain,
    start: &State,
    tolerance: f64,
    stabilisation: Stabilisation,
) -> (Vec<f64>, usize) {
    let run = Simulation::new(mech.clone())
        .start(start.clone())
        .stabilise(stabilisation)
        .tolerance(tolerance)
        .at(vec![END])
        .until(END)
        .expect("the run succeeds");
    let end = run.samples().last().expect("there is one sample");
    let mut y = end.q.to_vec();
    y.extend(end.v);
    (y, run.work().evaluations)
}

/// (q, q̇) at the end, in 113-bit arithmetic.
fn reference() -> Vec<f64> {
    let data: Value =
        serde_json::from_str(include_str!("../../../models/data/uchain.json")).expect("JSON");
    let state = &data["states"]["1.5"];
    let decimals = |x: &Value| -> f64 { x.as_str().expect("decimals").parse().expect("a number") };
    ["x", "y", "vx", "vy"]
        .iter()
        .flat_map(|part| state[part].as_array().expect("a list").iter().map(decimals))
        .collect()
}

/// Largest error of a coordinate or velocity.
fn error(y: &[f64]) -> f64 {
    let reference = reference();
    assert_eq!(y.len(), reference.len());
    tests::largest(
        &y.iter()
            .zip(&reference)
            .map(|(a, b)| a - b)
            .collect::<Vec<_>>(),
    )
}

/// The loosest tolerance from which on a run's error at the end stays below `wanted`, of eight in a decade.
fn tolerance_for(wanted: f64, run: impl Fn(f64) -> Vec<f64>) -> f64 {
    let mut found = None;
    for k in 8 * 4..8 * 14 {
        let tolerance = 10_f64.powf(-f64::from(k) / 8.0);
        if error(&run(tolerance)) > wanted {
            found = None;
        } else {
            found = found.or(Some(tolerance));
        }
    }
    found.expect("the error can be had")
}

/// Tolerance, evaluations and error, in words.
fn remark(tolerance: f64, y: &[f64], evaluations: usize) -> String {
    format!(
        "tolerance {tolerance:.0e}, {evaluations} evaluations, error {:.0e}",
        error(y)
    )
}

/// Whole runs with the same error at the end: each at the tolerance that it needs for it.
pub(crate) fn uchain17() -> Vec<Value> {
    let mech = black_box(UChain::default());
    let start = mech.default_start().expect("the default start exists");
    let groups = [
        ("run/uchain17/1e-6", 1e-6),
        ("run/uchain17/1e-9", 1e-9),
        ("run/uchain17/1e-12", 1e-12),
    ];
    let run = |(name, wanted)| {
        let (chain, mech, start) = (parameters(&mech), &mech, &start);
        let tolerance = tolerance_for(wanted, |tolerance| bare(chain, start, tolerance).0);
        let (y, report) = bare(chain, start, tolerance);
        let by_hand = Contender {
            name: "by hand, DOP853 without projection".to_owned(),
            by_hand: true,
            evaluations: 1,
            work: Box::new(move || drop(black_box(bare(chain, start, tolerance)))),
            remark: remark(tolerance, &y, report.evals.ode),
        };
        let contender = |name: &str, stabilisation| {
            let run = |tolerance| ours_alone(mech, start, tolerance, stabilisation).0;
            let tolerance = tolerance_for(wanted, run);
            let (y, evaluations) = ours_alone(mech, start, tolerance, stabilisation);
            Contender {
                name: name.to_owned(),
                by_hand: false,
                evaluations: 1,
                work: Box::new(move || {
                    drop(black_box(ours_alone(mech, start, tolerance, stabilisation)))
                }),
                remark: remark(tolerance, &y, evaluations),
            }
        };
        let projected = contender("Simulation, with projection", Stabilisation::Projection);
        let drifting = contender("Simulation, without projection", Stabilisation::None);
        let group = Group {
            name,
            remarks: Vec::new(),
            contenders: vec![by_hand, projected, drifting],
        };
        group.run()
    };
    groups.map(run).into()
}

/// Positions and velocities of as many states as there are lanes.
type Pack<L> = (Vec<L>, Vec<L>);

fn packs<L: Lanes>(states: &[State]) -> Vec<Pack<L>> {
    let pack = |states: &[State]| {
        let part = |part: fn(&State) -> &[f64]| {
            let lanes = |i: usize| L::from_lanes(|k| part(&states[k])[i]);
            (0..2 * N).map(lanes).collect::<Vec<L>>()
        };
        (part(|s| &s.q), part(|s| &s.v))
    };
    states.chunks_exact(L::WIDTH).map(pack).collect()
}

/// The generated code in lanes, with its certificates looked at; each lane agrees with the solver.
fn ours_in_lanes<L: Lanes>(mech: &UChain, states: &[State]) -> Contender<'static> {
    let packs: Vec<Pack<L>> = packs(states);
    let mut solver = LaneSolver::<L>::new(mech);
    let mut out = vec![L::from_f64(0.0); 2 * N];
    let t = L::from_f64(0.0);
    for ((q, v), states) in packs.iter().zip(states.chunks_exact(L::WIDTH)) {
        assert!(solver.acceleration(t, q, v, &mut out, |_| true));
        for (lane, state) in states.iter().enumerate() {
            let mut expected = vec![0.0; 2 * N];
            mech.prepared()
                .acceleration(state.t, &state.q, &state.v, &mut expected);
            let found: Vec<f64> = out.iter().map(|x| x.lane(lane)).collect();
            let scale = tests::largest(&expected).max(1.0);
            tests::assert_all_close("lanes", &found, &expected, 1e-9 * scale);
        }
    }
    Contender {
        name: format!("LaneSolver::acceleration in {} lanes", L::WIDTH),
        by_hand: false,
        evaluations: packs.len() * L::WIDTH,
        work: Box::new(move || {
            for (q, v) in &packs {
                black_box(solver.acceleration(t, q, v, &mut out, |_| true));
                black_box(&mut out);
            }
        }),
        remark: String::new(),
    }
}

/// Eight chains at once, each in its lane and at its state; times are per chain.
pub(crate) fn lanes() -> Value {
    const LANES: usize = 8;
    let mech = black_box(UChain::default());
    let start = mech.default_start().expect("the default start exists");
    let states = states(mech.clone(), start, END);
    let chain = parameters(&mech);
    let packs: Vec<Pack<f64x8>> = packs(&states);
    let mut out = vec![f64x8::splat(0.0); 2 * N];
    for ((q, v), states) in packs.iter().zip(states.chunks_exact(LANES)) {
        chain::lanes::<N>(&chain, q, v, &mut out);
        for (lane, state) in states.iter().enumerate() {
            let mut expected = vec![0.0; 2 * N];
            mech.prepared()
                .acceleration(state.t, &state.q, &state.v, &mut expected);
            let found: Vec<f64> = out.iter().map(|x| x.to_array()[lane]).collect();
            let scale = tests::largest(&expected).max(1.0);
            tests::assert_all_close("lanes", &found, &expected, 1e-9 * scale);
        }
    }
    let evaluations = packs.len() * LANES;
    let mut single = vec![0.0; 2 * N];
    let one_by_one = Contender {
        name: "by hand, both ends, by minors, one by one".to_owned(),
        by_hand: true,
        evaluations,
        work: Box::new(|| {
            for s in &states {
                chain::both_ends_minors::<N>(&chain, &s.q, &s.v, &mut single);
                black_box(&mut single);
            }
        }),
        remark: String::new(),
    };
    let in_lanes = Contender {
        name: "by hand, both ends, by minors, in 8 lanes".to_owned(),
        by_hand: true,
        evaluations,
        work: Box::new(|| {
            for (q, v) in &packs {
                chain::lanes::<N>(&chain, q, v, &mut out);
                black_box(&mut out);
            }
        }),
        remark: String::new(),
    };
    let contenders = vec![
        one_by_one,
        in_lanes,
        ours_in_lanes::<f64x4>(&mech, &states),
        ours_in_lanes::<f64x8>(&mech, &states),
    ];
    let group = Group {
        name: "lanes/uchain17",
        remarks: vec!["time per chain".to_owned()],
        contenders,
    };
    group.run()
}

/// A thousand chains that start a little apart, to the end at 1e-9; times are per chain.
pub(crate) fn ensemble() -> Value {
    /// Chains in the ensemble, and those measured in one batch.
    const CHAINS: usize = 1000;
    const MEASURED: usize = 4;
    let mech = black_box(UChain::default());
    let start = |k: usize| {
        let x0 = 12.0 + 1e-3 * k as f64 / CHAINS as f64;
        let options = models::StartOptions::new().with("x0", x0);
        mech.start("trapezoid", &options)
            .expect("the chain reaches")
    };
    let starts: Vec<State> = (0..CHAINS).map(start).collect();
    let chain = parameters(&mech);
    let mut turn = 0;
    let by_hand = Contender {
        name: "by hand, one by one, without projection".to_owned(),
        by_hand: true,
        evaluations: MEASURED,
        work: Box::new(|| {
            for _ in 0..MEASURED {
                turn = (turn + 1) % CHAINS;
                black_box(bare(chain, &starts[turn], 1e-9));
            }
        }),
        remark: String::new(),
    };
    let mut own = 0;
    let ours = Contender {
        name: "Simulation, one by one".to_owned(),
        by_hand: false,
        evaluations: MEASURED,
        work: Box::new(|| {
            for _ in 0..MEASURED {
                own = (own + 1) % CHAINS;
                let stabilisation = Stabilisation::Projection;
                black_box(ours_alone(&mech, &starts[own], 1e-9, stabilisation));
            }
        }),
        remark: String::new(),
    };
    let members = starts.iter().map(|s| (mech.clone(), s.clone())).collect();
    let ensemble = Ensemble::new(members).tolerance(1e-9);
    let one_core = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let results = one_core.install(|| ensemble.until(END));
    let mut rejected = 0;
    for (k, result) in results.iter().enumerate() {
        let member = result.as_ref().expect("the run succeeds");
        rejected += member.work.rejected;
        if k % 100 == 0 {
            let (expected, _) = ours_alone(&mech, &starts[k], 1e-9, Stabilisation::Projection);
            tests::assert_all_close("ensemble", &member.end.q, &expected[..2 * N], 1e-6);
        }
    }
    let in_lanes = Contender {
        name: "Ensemble, in lanes, on one core".to_owned(),
        by_hand: false,
        evaluations: CHAINS,
        work: Box::new(|| {
            black_box(one_core.install(|| ensemble.until(END)));
        }),
        remark: format!("{rejected} steps rejected in all"),
    };
    let contenders = vec![by_hand, ours, in_lanes];
    let group = Group {
        name: "ensemble/uchain17",
        remarks: vec!["time per chain".to_owned()],
        contenders,
    };
    group.run()
}
