//! Accelerations at states of a real run, one after the other.

use std::hint::black_box;

use models::{FishRobot, Model, UChain};
use ukcore::{Mechanism, Simulation, Solver, SolverOptions, State};

use crate::chain::{self, Chain};
use crate::dense::Dense;
use crate::harness::{Contender, Group};
use crate::mechanisms::{FourBars40, LongChain};
use crate::{fish, four_bars};

/// States a pass goes through.
const STATES: usize = 16;
/// Agreement of all contenders, relative to the largest acceleration of the state.
const ACCURACY: f64 = 1e-9;

/// Factors measured elsewhere on one acceleration of the U-chain with 17 links.
const ELSEWHERE: &str = "measured elsewhere, as multiples of the elimination by hand from both ends: CasADi 1.9, heyoka 2.9, MuJoCo 25, \
    Pinocchio 45, textbook pseudo-inverse 820";

/// Contenders over the states of one run.
struct Accelerations<'a> {
    states: &'a [State],
    reference: Vec<Vec<f64>>,
    contenders: Vec<Contender<'a>>,
}

impl<'a> Accelerations<'a> {
    fn new(states: &'a [State]) -> Self {
        Accelerations {
            states,
            reference: Vec::new(),
            contenders: Vec::new(),
        }
    }

    /// A contender, once it agrees with the first.
    fn add(
        &mut self,
        name: &str,
        by_hand: bool,
        mut acceleration: impl FnMut(&State, &mut [f64]) + 'a,
    ) {
        let mut out = vec![0.0; self.states[0].q.len()];
        for (k, state) in self.states.iter().enumerate() {
            out.fill(f64::NAN);
            acceleration(state, &mut out);
            if self.reference.len() == k {
                self.reference.push(out.clone());
            }
            let expected = &self.reference[k];
            let scale = tests::largest(expected).max(1.0);
            tests::assert_all_close(name, &out, expected, ACCURACY * scale);
        }
        self.measure(name, by_hand, move |state| {
            acceleration(state, &mut out);
            black_box(&mut out);
        });
    }

    /// A contender that gives no acceleration.
    fn measure(&mut self, name: &str, by_hand: bool, mut work: impl FnMut(&State) + 'a) {
        let states = self.states;
        self.contenders.push(Contender {
            name: name.to_owned(),
            by_hand,
            evaluations: states.len(),
            work: Box::new(move || states.iter().for_each(&mut work)),
            remark: String::new(),
        });
    }

    /// What every mechanism has: ours, with and without the solver, its terms alone, and dense elimination.
    fn add_ours<M: Mechanism>(&mut self, mechanism: &M) {
        let mech = mechanism.prepared();
        if M::SPEC.structure.straight_line {
            self.add("Prepared::acceleration", false, move |s, out| {
                let safe = mech.acceleration(s.t, &s.q, &s.v, out);
                assert!(safe > 0.5, "the certificate holds");
            });
        }
        let mut solver = Solver::new(mechanism, SolverOptions::default());
        self.add("Solver::acceleration", false, move |s, out| {
            solver
                .acceleration(s.t, &s.q, &s.v, out)
                .expect("the constraints are independent");
        });
        let (mech, mut dense) = (mechanism.prepared(), Dense::new::<M>());
        self.measure("Prepared::dynamics: M, Q, A, b alone", false, move |s| {
            dense.evaluate(&mech, s);
            black_box(&mut dense);
        });
        let (mech, mut dense) = (mechanism.prepared(), Dense::new::<M>());
        self.add("dense LU of [M Aᵀ; A 0]", false, move |s, out| {
            dense.saddle(&mech, s, out);
        });
    }

    fn group(self, name: &'static str, remarks: &[&str]) -> Group<'a> {
        Group {
            name,
            remarks: remarks.iter().map(|r| (*r).to_owned()).collect(),
            contenders: self.contenders,
        }
    }
}

/// States of a run to `t_end`.
pub(crate) fn states<M: Mechanism>(mechanism: M, start: State, t_end: f64) -> Vec<State> {
    let run = Simulation::new(mechanism)
        .start(start)
        .every(t_end / (STATES - 1) as f64)
        .until(t_end)
        .expect("the run succeeds");
    let states: Vec<State> = run.samples().map(|s| s.to_state()).take(STATES).collect();
    assert_eq!(states.len(), STATES);
    states
}

type ByHand = fn(&Chain, &[f64], &[f64], &mut [f64]);

/// The eliminations by hand of a chain with N links.
fn by_hand<const N: usize>() -> [(&'static str, ByHand); 5] {
    [
        ("by hand, one-sided", chain::one_sided::<N>),
        (
            "by hand, one-sided, by minors",
            chain::one_sided_minors::<N>,
        ),
        ("by hand, both ends", chain::both_ends::<N>),
        (
            "by hand, both ends, by minors",
            chain::both_ends_minors::<N>,
        ),
        (
            "by hand, both ends, by minors, in pairs",
            chain::both_ends_paired::<N>,
        ),
    ]
}

pub(crate) fn uchain17() -> serde_json::Value {
    let mech = black_box(UChain::default());
    let start = mech.default_start().expect("the default start exists");
    let states = states(mech.clone(), start, 1.5);
    let mut all = Accelerations::new(&states);
    let chain = black_box(Chain {
        m: mech.m,
        l: mech.l,
        g: mech.g,
    });
    for (name, f) in by_hand::<17>() {
        all.add(name, true, move |s, out| f(&chain, &s.q, &s.v, out));
    }
    all.add_ours(&mech.clone());
    let mut dense = Dense::new::<UChain>();
    all.add("eq. 13 as printed", false, move |s, out| {
        dense.printed(&mech.prepared(), s, out);
    });
    all.group("acceleration/uchain17", &[ELSEWHERE]).run()
}

pub(crate) fn uchain65() -> serde_json::Value {
    let mech = black_box(LongChain::default());
    let states = states(mech.clone(), mech.trapezoid(), 1.5);
    let mut all = Accelerations::new(&states);
    let chain = black_box(Chain {
        m: mech.m,
        l: mech.l,
        g: mech.g,
    });
    for (name, f) in by_hand::<65>() {
        all.add(name, true, move |s, out| f(&chain, &s.q, &s.v, out));
    }
    all.add_ours(&mech);
    all.group("acceleration/uchain65", &[]).run()
}

pub(crate) fn fish() -> serde_json::Value {
    let mech = black_box(FishRobot::default());
    let start = mech.default_start().expect("the default start exists");
    let states = states(mech.clone(), start, FishRobot::duration());
    let mut all = Accelerations::new(&states);
    let by_hand = black_box(fish::Fish::new(mech.clone()));
    all.add("by hand, three unknowns", true, move |s, out| {
        let all = |values: &[f64]| -> [f64; 9] { values.try_into().expect("nine coordinates") };
        by_hand.acceleration(s.t, &all(&s.q), &all(&s.v), out);
    });
    all.add_ours(&mech);
    all.group("acceleration/fish", &[]).run()
}

pub(crate) fn fourbars40() -> serde_json::Value {
    let mech = black_box(FourBars40::default());
    // The cranks come down at 0.7 s, where all rods lie in one line.
    let states = states(mech.clone(), mech.upright(), 0.6);
    let mut all = Accelerations::new(&states);
    let by_hand = black_box(four_bars::FourBars {
        m: mech.m,
        l: mech.l,
        g: mech.g,
    });
    all.add("by hand, in the null space", true, move |s, out| {
        by_hand.acceleration(&s.q, &s.v, out);
    });
    all.add_ours(&mech);
    all.group("acceleration/fourbars40", &[]).run()
}
