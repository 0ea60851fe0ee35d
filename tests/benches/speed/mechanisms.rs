//! Mechanisms larger than those of the crate `models`, for how the time grows with their size.

use ukcore::State;

pub(crate) use catalogued::Bricard;

tests::arm!(Arm6, 6);
tests::arm!(Arm12, 12);
#[cfg(feature = "large")]
tests::arm!(Arm24, 24);
tests::hinges!(Hinges6, 6);
#[cfg(feature = "large")]
tests::hinges!(Hinges12, 12);
#[cfg(feature = "large")]
tests::legs!(Legs12, 12);
tests::planar_chain!(Bodies12, Angles12, 12);
tests::crank_and_rod!(CrankAndRod);
tests::four_bars!(FourBars40, 40);

/// Bricard's linkage, built here: the crate `catalogue` is optimised less.
#[path = "../../../models/catalogue/src/bricard.rs"]
mod catalogued;

ukcore::multibody! {
    /// The U-chain with 65 links.
    pub(crate) LongChain {
        const N: usize = 65;
        params { m = 1.0, l = 1.0, g = 9.8 }
        coords { x[N], y[N] }
        mass { for i in 0..N { x[i]: m, y[i]: m } }
        potential { for i in 0..N { -m * g * y[i] } }
        holonomic {
            for i in 0..N - 1 { link[i]: sq(x[i + 1] - x[i]) + sq(y[i + 1] - y[i]) = sq(l) }
            support: sq(x[N - 1]) + sq(y[N - 1]) = sq(l)
        }
    }
}

impl LongChain {
    /// At rest as a trapezoid with legs at 60°, 20 links down, 25 level, 20 up.
    pub(crate) fn trapezoid(&self) -> State {
        let links = Self::X.len();
        let mut q = vec![0.0; 2 * links];
        let (mut x, mut y) = (0.0, 0.0);
        for (k, i) in (0..links).rev().enumerate() {
            let (cos, sin) = match k {
                0..20 => (0.5, 0.75_f64.sqrt()),
                20..45 => (1.0, 0.0),
                _ => (0.5, -0.75_f64.sqrt()),
            };
            x += self.l * cos;
            y += self.l * sin;
            (q[Self::X[i]], q[Self::Y[i]]) = (x, y);
        }
        State {
            t: 0.0,
            v: vec![0.0; q.len()],
            q,
        }
    }
}

impl FourBars40 {
    /// All cranks upright, all tops moving at 1 m/s.
    pub(crate) fn upright(&self) -> State {
        let tops = Self::X.len();
        let mut q = vec![self.l; 2 * tops];
        let mut v = vec![0.0; 2 * tops];
        for (i, &x) in Self::X.iter().enumerate() {
            (q[x], v[x]) = (i as f64 * self.l, 1.0);
        }
        State { t: 0.0, q, v }
    }
}

impl Bodies12 {
    /// The places of the rods at a state in angles.
    pub(crate) fn placed(&self, angles: &State) -> State {
        let n = angles.q.len();
        let mut state = State {
            t: angles.t,
            q: vec![0.0; 2 * n],
            v: vec![0.0; 2 * n],
        };
        let (mut place, mut velocity) = ([0.0; 2], [0.0; 2]);
        for i in 0..n {
            let ((s, c), w) = (angles.q[i].sin_cos(), angles.v[i]);
            for (k, (e, across)) in [(c, -s), (s, c)].into_iter().enumerate() {
                let (half, rate) = (0.5 * self.l * e, 0.5 * self.l * w * across);
                (state.q[2 * i + k], state.v[2 * i + k]) = (place[k] + half, velocity[k] + rate);
                (place[k], velocity[k]) = (place[k] + 2.0 * half, velocity[k] + 2.0 * rate);
            }
        }
        state.q.extend(&angles.q);
        state.v.extend(&angles.v);
        state
    }
}
