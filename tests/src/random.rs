//! Random numbers and states, the same in every run.

use ukcore::manifold::Projector;
use ukcore::model::Model;
use ukcore::spec::Spec;
use ukcore::{Prepared, State};

/// SplitMix64 (Steele, Lea & Flood 2014).
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// A generator with its seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// Uniform in [−1, 1).
    pub fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        // 53 bits fill the mantissa.
        (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// `n` values, each uniform in [−1, 1).
    pub fn vector(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.signed()).collect()
    }

    /// A state with t, coordinates and velocities uniform in [−1, 1).
    pub fn state(&mut self, n: usize) -> State {
        let t = self.signed();
        State {
            t,
            q: self.vector(n),
            v: self.vector(n),
        }
    }

    /// A random state at t = 0 of a mechanism with spatial bodies: quaternions have the length 1, and rates that keep it.
    pub fn turned(&mut self, spec: &Spec) -> State {
        let (mut q, mut v) = (self.vector(spec.n()), self.vector(spec.n()));
        let quaternions = (0..spec.n()).filter(|i| spec.coords[*i].ends_with(".e0"));
        for at in quaternions {
            let norm = q[at..at + 4].iter().map(|x| x * x).sum::<f64>().sqrt();
            q[at..at + 4].iter_mut().for_each(|x| *x /= norm);
            let along: f64 = (at..at + 4).map(|i| q[i] * v[i]).sum();
            (at..at + 4).for_each(|i| v[i] -= along * q[i]);
        }
        State { t: 0.0, q, v }
    }

    /// A model with other parameters and a consistent state, each near what it is by default: not all parameters admit the default start.
    pub fn member<M: Model>(&mut self) -> (M, State) {
        loop {
            let mechanism: M = self.parameters(0.02);
            if mechanism.default_start().is_ok() {
                let state = self.consistent_state(&mechanism, 0.02);
                return (mechanism, state);
            }
        }
    }

    /// The model with each parameter changed by up to `part` of its default value.
    pub fn parameters<M: Model>(&mut self, part: f64) -> M {
        let mut mechanism = M::default();
        for i in 0..M::SPEC.params.len() {
            let value = mechanism.parameter(i);
            // What is 0 by default, such as a torque, is not left out.
            let change = part * self.signed();
            let value = if value == 0.0 {
                change
            } else {
                value * (1.0 + change)
            };
            mechanism.set_parameter(i, value);
        }
        mechanism
    }

    /// `start`, each coordinate moved by up to `spread` and each velocity by up to 1, at a time in [0, 1). On no constraint.
    #[must_use]
    pub fn moved(&mut self, mut start: State, spread: f64) -> State {
        start.t = 0.5 * (self.signed() + 1.0);
        for q in &mut start.q {
            *q += spread * self.signed();
        }
        for v in &mut start.v {
            *v += self.signed();
        }
        start
    }

    /// A random state near `start`, projected onto the constraints.
    ///
    /// # Panics
    /// If the projection fails.
    #[must_use]
    pub fn near(&mut self, mechanism: &Prepared, start: State, spread: f64) -> State {
        let mut state = self.moved(start, spread);
        let mut projector = Projector::new(mechanism);
        let name = mechanism.spec().name;
        projector
            .position(state.t, &mut state.q, &state.v)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        projector
            .velocity(state.t, &state.q, &mut state.v)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        state
    }

    /// A random state near the default start, projected onto the constraints.
    ///
    /// # Panics
    /// If the model has no default start, or the projection fails.
    pub fn consistent_state<M: Model>(&mut self, mechanism: &M, spread: f64) -> State {
        let start = mechanism.default_start().expect("the default start exists");
        self.near(&mechanism.prepared(), start, spread)
    }
}
