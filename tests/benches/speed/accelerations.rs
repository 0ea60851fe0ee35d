//! Accelerations at states of a real run, one after the other.

use std::hint::black_box;

use models::{FishRobot, Model, RigidBody, SliderCrank, StartOptions, UChain};
use ukcore::solver::SolverOptions;
use ukcore::{Mechanism, Simulation, Solver, State};

use crate::chain::{self, Chain};
use crate::dense::Dense;
use crate::harness::{Contender, Group};
#[cfg(feature = "large")]
use crate::mechanisms;
use crate::mechanisms::{
    Angles12, Arm6, Arm12, Bodies12, Bricard, CrankAndRod, FourBars40, Hinges6, LongChain,
};
use crate::recursive::{self, Arm, Planar};
use crate::{bricard, fish, four_bars};

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

    /// The same in other coordinates, at `states` of its own that are those of the others.
    fn add_other<M: Mechanism>(&mut self, name: &str, mechanism: &M, states: Vec<State>) {
        let mech = mechanism.prepared();
        let mut out = vec![0.0; states[0].q.len()];
        let mut turn = 0;
        self.measure(name, false, move |_| {
            let s = &states[turn];
            turn = (turn + 1) % states.len();
            let safe = mech.acceleration(s.t, &s.q, &s.v, &mut out);
            assert!(safe > 0.5, "the certificate holds");
            black_box(&mut out);
        });
        self.count::<M>();
    }

    /// Says behind the figures of the last contender what the straight line of `M` costs.
    fn count<M: Mechanism>(&mut self) {
        let counts = M::SPEC.structure.costs.acceleration.counts();
        let counted: usize = counts.iter().sum();
        let last = self.contenders.last_mut().expect("a contender");
        last.remark = format!("{counted} operations");
    }

    /// What every mechanism has: ours, with and without the solver, its terms alone, and dense elimination.
    fn add_ours<M: Mechanism>(&mut self, mechanism: &M) {
        let mech = mechanism.prepared();
        if M::SPEC.structure.straight_line {
            self.add("Prepared::acceleration", false, move |s, out| {
                let safe = mech.acceleration(s.t, &s.q, &s.v, out);
                assert!(safe > 0.5, "the certificate holds");
            });
            self.count::<M>();
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

/// The arm of the benchmarks.
const ARM: Arm = Arm {
    m: 1.0,
    l: 0.5,
    inertia: [0.01, 0.03, 0.03],
    g: 9.81,
};

/// Angles and rates of its N hinges.
fn postures<const N: usize>() -> Vec<State> {
    let q: Vec<f64> = (0..N).map(|i| -0.5 + 0.2 * (i % 6) as f64).collect();
    let states = (0..STATES).map(|k| State {
        t: 0.0,
        q: q.iter().map(|x| x + 0.05 * k as f64).collect(),
        v: q.clone(),
    });
    states.collect()
}

/// An arm of N hinges from one posture, beside the articulated-body recursion.
fn arm<M: Mechanism, const N: usize>(name: &'static str, mechanism: M) -> serde_json::Value {
    let states = postures::<N>();
    let mut all = Accelerations::new(&states);
    let by_hand = black_box(ARM);
    all.add("by hand, articulated bodies", true, move |s, out| {
        by_hand.acceleration::<N>(&s.q, &s.v, out);
    });
    all.add_ours(&mechanism);
    all.group(name, &[]).run()
}

pub(crate) fn arms() -> Vec<serde_json::Value> {
    vec![
        arm::<_, 6>("acceleration/arm6", Arm6::default()),
        arm::<_, 12>("acceleration/arm12", Arm12::default()),
        #[cfg(feature = "large")]
        arm::<_, 24>("acceleration/arm24", mechanisms::Arm24::default()),
    ]
}

/// The same arm as bodies in space.
fn hinged<M: Mechanism, const N: usize>(name: &'static str, mechanism: M) -> serde_json::Value {
    let by_hand = black_box(ARM);
    let states = postures::<N>();
    let states = states.iter().map(|s| {
        let (q, v) = by_hand.placed::<N>(&s.q, &s.v);
        State { t: 0.0, q, v }
    });
    let states: Vec<State> = states.collect();
    let mut all = Accelerations::new(&states);
    all.add("by hand, articulated bodies", true, move |s, out| {
        by_hand.in_places::<N>(&s.q, &s.v, out);
    });
    all.add_ours(&mechanism);
    all.group(name, &[]).run()
}

pub(crate) fn hinges() -> Vec<serde_json::Value> {
    vec![
        hinged::<_, 6>("acceleration/hinges6", Hinges6::default()),
        #[cfg(feature = "large")]
        hinged::<_, 12>("acceleration/hinges12", mechanisms::Hinges12::default()),
    ]
}

pub(crate) fn legs() -> Vec<serde_json::Value> {
    vec![
        #[cfg(feature = "large")]
        legs12(),
    ]
}

/// Twelve legs, their joints about where they can be.
#[cfg(feature = "large")]
fn legs12() -> serde_json::Value {
    const N: usize = 12;
    const JOINTS: [[f64; 2]; 5] = [
        [-2.0, 3.0],
        [-7.0, 1.0],
        [-3.0, -4.0],
        [-6.5, -3.5],
        [-4.0, -9.0],
    ];
    let mech = black_box(mechanisms::Legs12 {
        phase: std::array::from_fn(|n| (n / 2) as f64),
        side: std::array::from_fn(|n| if n % 2 == 0 { 1.0 } else { -1.0 }),
        ..mechanisms::Legs12::default()
    });
    let states = (0..STATES).map(|k| {
        let places = mech
            .side
            .iter()
            .flat_map(|side| JOINTS.map(|[x, y]| [side * x, y]));
        let wave = |n: usize| 0.3 * ((n + k) as f64).sin();
        let q: Vec<f64> = [0.2].into_iter().chain(places.flatten()).collect();
        State {
            t: 0.0,
            v: (0..q.len()).map(wave).collect(),
            q: q.iter().enumerate().map(|(n, x)| x + wave(n)).collect(),
        }
    });
    let states: Vec<State> = states.collect();
    let mut all = Accelerations::new(&states);
    let by_hand = black_box(crate::legs::Legs::<N> {
        hip: [mech.a, mech.l],
        throw: mech.m,
        torque: mech.torque,
        drag: mech.drag,
        g: mech.grav,
        mass: mech.mass,
        inertia: mech.jc,
        phase: mech.phase,
        side: mech.side,
    });
    all.add("by hand, in the null space", true, move |s, out| {
        by_hand.acceleration(&s.q, &s.v, out);
    });
    all.add_ours(&mech);
    all.group("acceleration/legs12", &[]).run()
}

pub(crate) fn bricard() -> serde_json::Value {
    let mech = black_box(Bricard::default());
    let start = mech.start("cube", &StartOptions::new());
    let states = states(mech.clone(), start.expect("a cube"), 2.0);
    let mut all = Accelerations::new(&states);
    let own = mech.clone();
    all.add("by hand, one degree of freedom", true, move |s, out| {
        bricard::acceleration(&own, &s.q, &s.v, out);
    });
    all.add_ours(&mech);
    all.group("acceleration/bricard", &[]).run()
}

pub(crate) fn bodies12() -> serde_json::Value {
    const N: usize = 12;
    let (mech, angles) = (black_box(Bodies12::default()), Angles12::default());
    let in_angles: Vec<State> = (0..STATES)
        .map(|k| State {
            t: 0.0,
            q: (0..N).map(|i| 0.1 * i as f64 - 0.05 * k as f64).collect(),
            v: (0..N).map(|i| 0.3 - 0.1 * i as f64).collect(),
        })
        .collect();
    let states: Vec<State> = in_angles.iter().map(|s| mech.placed(s)).collect();
    let mut all = Accelerations::new(&states);
    let by_hand = black_box(Planar {
        m: mech.m,
        l: mech.l,
        j: mech.j,
        g: mech.g,
    });
    all.add("by hand, rod after rod", true, move |s, out| {
        by_hand.acceleration::<N>(&s.q[2 * N..], &s.v[2 * N..], out);
    });
    all.add_other(
        "Prepared::acceleration in angles alone",
        &angles,
        in_angles.clone(),
    );
    all.add_ours(&mech);
    all.group("acceleration/bodies12", &[]).run()
}

pub(crate) fn slider_crank() -> serde_json::Value {
    let mech = black_box(SliderCrank::default());
    let start = mech.default_start().expect("the default start exists");
    let states = states(mech.clone(), start, 1.0);
    let in_angles = states.iter().map(|s| {
        let chosen = |x: &[f64]| [2, 5, 0, 1, 3, 4, 6].map(|i| x[i]).to_vec();
        State {
            t: s.t,
            q: chosen(&s.q),
            v: chosen(&s.v),
        }
    });
    let in_angles = in_angles.collect();
    let mut all = Accelerations::new(&states);
    let own = mech.clone();
    all.add("by hand, one degree of freedom", true, move |s, out| {
        recursive::slider_crank(&own, &s.q, &s.v, out);
    });
    let name = "Prepared::acceleration in two angles";
    all.add_other(name, &CrankAndRod::default(), in_angles);
    all.add_ours(&mech);
    all.group("acceleration/slider_crank", &[]).run()
}

pub(crate) fn rigid_body() -> serde_json::Value {
    let mech = black_box(RigidBody::default());
    let start = mech.default_start().expect("the default start exists");
    let states = states(mech.clone(), start, RigidBody::duration());
    let mut all = Accelerations::new(&states);
    let own = mech.clone();
    all.add("by hand, Euler's equations", true, move |s, out| {
        recursive::rigid_body(&own, &s.q, &s.v, out);
    });
    all.add_ours(&mech);
    all.group("acceleration/rigid_body", &[]).run()
}
