//! Whole runs, and many chains at once.

use std::array;
use std::hint::black_box;

use models::{Model, UChain};
use serde_json::Value;
use ukcore::lanes::{LaneSolver, Lanes};
use ukcore::manifold::Stabilisation;
use ukcore::{Ensemble, Mechanism, Simulation, State};
use wide::{f64x4, f64x8};

use crate::accelerations::states;
use crate::chain::{self, Chain};
use crate::harness::{Contender, Group};
use crate::many;

/// Links.
pub(crate) const N: usize = 17;
pub(crate) const END: f64 = 1.5;

pub(crate) fn parameters(mech: &UChain) -> Chain {
    black_box(Chain {
        m: mech.m,
        l: mech.l,
        g: mech.g,
    })
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
    let reference = UChain::references().remove(0);
    let end = reference.states.last().expect("to 1.5 s");
    [&end.q[..], &end.v].concat()
}

/// Largest error of a coordinate or velocity.
pub(crate) fn error(y: &[f64]) -> f64 {
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
pub(crate) fn tolerance_for(wanted: f64, run: impl Fn(f64) -> Vec<f64>) -> f64 {
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
pub(crate) fn remark(tolerance: f64, y: &[f64], evaluations: usize) -> String {
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
        let (mech, start) = (&mech, &start);
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
            contenders: vec![projected, drifting],
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
        chain::lanes::<f64x8, N>(&chain, q, v, &mut out);
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
                chain::lanes::<f64x8, N>(&chain, q, v, &mut out);
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
    let (mut rejected, mut ends) = (0, Vec::new());
    for (k, result) in results.iter().enumerate() {
        let member = result.as_ref().expect("the run succeeds");
        rejected += member.work.rejected;
        ends.push([&member.end.q[..], &member.end.v].concat());
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
        remark: format!(
            "error {:.0e}, {rejected} steps rejected in all",
            error(&ends[0])
        ),
    };
    let chain = parameters(&mech);
    let pack = |first: usize| -> many::States {
        array::from_fn(|i| {
            let at = |k: usize| {
                let s = &starts[(first + k) % CHAINS];
                if i < 2 * N { s.q[i] } else { s.v[i - 2 * N] }
            };
            Lanes::from_lanes(at)
        })
    };
    let first = |(y, _): (many::States, usize)| y.map(|x| x.lane(0)).to_vec();
    let by_hand = |name: &str, wanted: f64| {
        let run = |tolerance| first(many::run(&chain, pack(0), END, tolerance));
        let tolerance = tolerance_for(wanted, run);
        let (y, evaluations) = many::run(&chain, pack(0), END, tolerance);
        let mut own = 0;
        let (chain, pack) = (&chain, &pack);
        Contender {
            name: name.to_owned(),
            by_hand: true,
            evaluations: many::WIDTH,
            work: Box::new(move || {
                own = (own + many::WIDTH) % CHAINS;
                black_box(many::run(chain, pack(own), END, tolerance));
            }),
            remark: remark(tolerance, &first((y, 0)), evaluations),
        }
    };
    let at_equal_error = by_hand(
        "by hand, in lanes, not projected, as exact",
        error(&ends[0]),
    );
    let group = Group {
        name: "ensemble/uchain17",
        remarks: vec!["time per chain".to_owned()],
        contenders: vec![at_equal_error, ours, in_lanes],
    };
    group.run()
}
