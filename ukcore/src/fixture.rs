//! Hand-written mechanisms for tests, until and beside those that the macro emits.
//!
//! A [`Toy`] gives names, M, Q and the constraint functions; A, b and φ̇ follow by differentiation with nested [`Dual`]s, which
//! is independent of the macro's symbolic derivatives.

use crate::mechanism::{Energy, Mechanism, Prepared, Terms};
use crate::random::Random;
use crate::scalar::{Dual, Scalar};
use crate::spec::{ConstraintKind, ConstraintSpec, ParamSpec, Solve, Spec, Structure};

/// Numbers in [−1, 1), the same in every run.
pub(crate) fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut random = Random::new(seed);
    move || random.signed()
}

/// What a test mechanism states.
pub(crate) trait Toy: Clone + Default + Into<Prepared> + Send + Sync + 'static {
    const FACTS: &'static Spec;
    fn params(&self) -> &[f64];
    fn params_mut(&mut self) -> &mut [f64];
    /// Entries of M.
    fn mass<S: Scalar>(p: &[S], t: S, q: &[S], entry: &mut dyn FnMut(usize, usize, S));
    fn force<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], force: &mut [S]);
    fn nonideal<S: Scalar>(_p: &[S], _t: S, _q: &[S], _v: &[S], _nonideal: &mut [S]) {}
    /// φ of the holonomic constraints.
    fn phi<S: Scalar>(p: &[S], t: S, q: &[S], phi: &mut [S]);
    /// φ of the nonholonomic constraints.
    fn psi<S: Scalar>(_p: &[S], _t: S, _q: &[S], _v: &[S], _psi: &mut [S]) {}
    fn potential<S: Scalar>(_p: &[S], _q: &[S]) -> S {
        S::from_f64(0.0)
    }
}

fn zero<S: Scalar>() -> S {
    S::from_f64(0.0)
}

fn along<S: Scalar>(x: &[S], d: &[S]) -> Vec<Dual<S>> {
    x.iter().zip(d).map(|(x, d)| Dual::new(*x, *d)).collect()
}

fn lift<S: Scalar>(x: &[S]) -> Vec<Dual<S>> {
    x.iter().map(|x| Dual::new(*x, zero())).collect()
}

impl<T: Toy> Mechanism for T {
    const SPEC: &'static Spec = T::FACTS;

    fn parameter(&self, index: usize) -> f64 {
        self.params()[index]
    }
    fn set_parameter(&mut self, index: usize, value: f64) {
        self.params_mut()[index] = value;
    }
    fn prepare<S: Scalar>(given: &[S], prepared: &mut [S]) {
        prepared.copy_from_slice(given);
    }

    fn dynamics<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], out: &mut Terms<'_, S>) {
        let (h, m) = (Self::SPEC.holonomic, Self::SPEC.m());
        Self::mass_matrix(p, t, q, out.mass);
        Self::force(p, t, q, v, out.force);
        Self::nonideal(p, t, q, v, out.nonideal);
        Self::jacobian(p, t, q, v, out.jacobian);
        // φ(q + v τ, t + τ), second derivative in τ at constant v.
        let one = S::from_f64(1.0);
        let still: Vec<Dual<S>> = v.iter().map(|v| Dual::new(*v, zero())).collect();
        let (inner, time) = (along(q, v), Dual::new(t, one));
        let twice: Vec<Dual<Dual<S>>> = inner
            .iter()
            .zip(&still)
            .map(|(q, v)| Dual::new(*q, *v))
            .collect();
        let mut phi = vec![Dual::new(Dual::new(zero::<S>(), zero()), Dual::new(zero(), zero())); h];
        Self::phi(
            &lift(&lift(p)),
            Dual::new(time, Dual::new(one, zero())),
            &twice,
            &mut phi,
        );
        for (b, phi) in out.rhs.iter_mut().zip(&phi) {
            *b = -phi.eps.eps;
        }
        let mut psi = vec![Dual::new(zero::<S>(), zero()); m - h];
        Self::psi(&lift(p), time, &inner, &still, &mut psi);
        for (b, psi) in out.rhs[h..].iter_mut().zip(&psi) {
            *b = -psi.eps;
        }
    }

    fn mass_matrix<S: Scalar>(p: &[S], t: S, q: &[S], mass: &mut [S]) {
        let n = Self::SPEC.n();
        Self::mass(p, t, q, &mut |i, j, x| {
            mass[j * n + i] = x;
            mass[i * n + j] = x;
        });
    }

    fn jacobian<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], jacobian: &mut [S]) {
        let (n, h, m) = (Self::SPEC.n(), Self::SPEC.holonomic, Self::SPEC.m());
        let time = Dual::new(t, zero());
        for j in 0..n {
            let mut seeded = lift(q);
            seeded[j].eps = S::from_f64(1.0);
            let mut phi = vec![Dual::new(zero::<S>(), zero()); h];
            Self::phi(&lift(p), time, &seeded, &mut phi);
            let mut seeded = lift(v);
            seeded[j].eps = S::from_f64(1.0);
            let mut psi = vec![Dual::new(zero::<S>(), zero()); m - h];
            Self::psi(&lift(p), time, &lift(q), &seeded, &mut psi);
            for (c, x) in phi.iter().chain(&psi).enumerate() {
                jacobian[j * m + c] = x.eps;
            }
        }
    }

    fn residual<S: Scalar>(p: &[S], t: S, q: &[S], phi: &mut [S]) {
        Self::phi(p, t, q, phi);
    }

    fn residual_rate<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S], rate: &mut [S]) {
        let h = Self::SPEC.holonomic;
        let mut phi = vec![Dual::new(zero::<S>(), zero()); h];
        Self::phi(
            &lift(p),
            Dual::new(t, S::from_f64(1.0)),
            &along(q, v),
            &mut phi,
        );
        for (r, phi) in rate.iter_mut().zip(&phi) {
            *r = phi.eps;
        }
        Self::psi(p, t, q, v, &mut rate[h..]);
    }

    fn energy<S: Scalar>(p: &[S], t: S, q: &[S], v: &[S]) -> Energy<S> {
        let n = Self::SPEC.n();
        let mut mass = vec![zero::<S>(); n * n];
        Self::mass_matrix(p, t, q, &mut mass);
        let mut twice = zero::<S>();
        for j in 0..n {
            for i in 0..n {
                twice = twice + v[i] * mass[j * n + i] * v[j];
            }
        }
        Energy {
            kinetic: S::from_f64(0.5) * twice,
            potential: Self::potential(p, q),
        }
    }

    fn outputs<S: Scalar>(_p: &[S], _t: S, _q: &[S], _v: &[S], _outputs: &mut [S]) {}
}

const EMPTY: Spec = Spec {
    structure: Structure {
        solve: Solve::none("it is written by hand"),
        mass_diagonal: true,
        mass_constant: true,
        scleronomic: true,
        ..Structure::EMPTY
    },
    ..Spec::EMPTY
};

const fn holonomic(name: &'static str) -> ConstraintSpec {
    ConstraintSpec {
        name,
        kind: ConstraintKind::Holonomic,
        equation: "",
    }
}

const fn param(name: &'static str, default: f64) -> ParamSpec {
    ParamSpec {
        unit: "",
        written: "",
        name,
        doc: "",
        default,
    }
}

/// All (row, column) of a matrix of `m` rows.
const fn every_entry<const ENTRIES: usize>(m: usize) -> [(usize, usize); ENTRIES] {
    let mut entries = [(0, 0); ENTRIES];
    let mut k = 0;
    while k < ENTRIES {
        entries[k] = (k % m, k / m);
        k += 1;
    }
    entries
}

/// Declares a toy type: parameters with defaults, facts about it.
macro_rules! toy {
    ($(#[$doc:meta])* $name:ident [$($param:ident = $value:expr),*] { $($field:ident: $facts:expr),* $(,)? }
     structure { $($sfield:ident: $sfacts:expr),* $(,)? } $($methods:item)*) => {
        $(#[$doc])*
        #[derive(Debug, Clone)]
        pub(crate) struct $name {
            pub(crate) params: Vec<f64>,
        }
        impl Default for $name {
            fn default() -> Self {
                $name { params: vec![$($value),*] }
            }
        }
        impl From<$name> for Prepared {
            fn from(mechanism: $name) -> Self {
                mechanism.prepared()
            }
        }
        impl Toy for $name {
            const FACTS: &'static Spec = &Spec {
                name: stringify!($name),
                params: &[$(param(stringify!($param), $value)),*],
                prepared: &[$((stringify!($param), "")),*],
                structure: Structure {
                    jacobian_pattern: {
                        const SIZES: Spec = Spec { $($field: $facts,)* ..EMPTY };
                        &every_entry::<{ SIZES.n() * SIZES.m() }>(SIZES.m())
                    },
                    $($sfield: $sfacts,)*
                    ..EMPTY.structure
                },
                $($field: $facts,)*
                ..EMPTY
            };
            fn params(&self) -> &[f64] {
                &self.params
            }
            fn params_mut(&mut self) -> &mut [f64] {
                &mut self.params
            }
            $($methods)*
        }
    };
}

fn sq<S: Scalar>(x: S) -> S {
    x * x
}

fn c<S: Scalar>(x: f64) -> S {
    S::from_f64(x)
}

toy! {
    /// A particle on a circle, y up. Parameters: mass, length, gravity.
    Pendulum [m = 1.0, l = 1.0, g = 9.8] {
        coords: &["x", "y"], constraints: &[holonomic("rod")], holonomic: 1,
    }
    structure { potential: true, conservative: true }
    fn mass<S: Scalar>(p: &[S], _t: S, _q: &[S], entry: &mut dyn FnMut(usize, usize, S)) {
        entry(0, 0, p[0]);
        entry(1, 1, p[0]);
    }
    fn force<S: Scalar>(p: &[S], _t: S, _q: &[S], _v: &[S], force: &mut [S]) {
        force[1] = -(p[0] * p[2]);
    }
    fn phi<S: Scalar>(p: &[S], _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = sq(q[0]) + sq(q[1]) - p[1] * p[1];
    }
    fn potential<S: Scalar>(p: &[S], q: &[S]) -> S {
        (p[0] * p[2]) * q[1]
    }
}

toy! {
    /// A double pendulum, the second rod stated twice; the copy may be scaled and shifted. Parameters: masses, scale, shift.
    Twice [m1 = 1.0, m2 = 2.0, scale = 1.0, shift = 0.0] {
        coords: &["x1", "y1", "x2", "y2"],
        constraints: &[holonomic("rod[0]"), holonomic("rod[1]"), holonomic("copy")],
        holonomic: 3,
    }
    structure { potential: true, conservative: true }
    fn mass<S: Scalar>(p: &[S], _t: S, _q: &[S], entry: &mut dyn FnMut(usize, usize, S)) {
        for i in 0..4 {
            entry(i, i, p[i / 2]);
        }
    }
    fn force<S: Scalar>(p: &[S], _t: S, _q: &[S], _v: &[S], force: &mut [S]) {
        force[1] = c::<S>(-9.8) * p[0];
        force[3] = c::<S>(-9.8) * p[1];
    }
    fn phi<S: Scalar>(p: &[S], t: S, q: &[S], phi: &mut [S]) {
        phi[0] = sq(q[0]) + sq(q[1]) - c(1.0);
        phi[1] = sq(q[2] - q[0]) + sq(q[3] - q[1]) - c(1.0);
        phi[2] = p[2] * (phi[1] + p[3] * (c::<S>(1.0) - t.cos()));
    }
}

toy! {
    /// A parallelogram: two unit cranks on ground pivots at (0, 0) and (2, 0), a coupler of length 2, and a third unit crank from
    /// (1, 0) to the coupler's middle. The third crank is implied on the branch where the cranks are parallel, and only at
    /// states that satisfy the rest. Parameters: scale of the third crank's equation, its length.
    Parallelogram [scale = 1.0, length = 1.0] {
        coords: &["x1", "y1", "x2", "y2"],
        constraints: &[holonomic("crank[0]"), holonomic("crank[1]"), holonomic("coupler"), holonomic("third")],
        holonomic: 4,
    }
    structure { }
    fn mass<S: Scalar>(_p: &[S], _t: S, _q: &[S], entry: &mut dyn FnMut(usize, usize, S)) {
        for (i, m) in [1.0, 1.0, 2.0, 2.0].into_iter().enumerate() {
            entry(i, i, c(m));
        }
    }
    fn force<S: Scalar>(_p: &[S], _t: S, _q: &[S], _v: &[S], force: &mut [S]) {
        force[1] = c(-9.8);
        force[3] = c(-2.0 * 9.8);
    }
    fn phi<S: Scalar>(p: &[S], _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = sq(q[0]) + sq(q[1]) - c(1.0);
        phi[1] = sq(q[2] - c(2.0)) + sq(q[3]) - c(1.0);
        phi[2] = sq(q[2] - q[0]) + sq(q[3] - q[1]) - c(4.0);
        let (x, y) = (c::<S>(0.5) * (q[0] + q[2]) - c(1.0), c::<S>(0.5) * (q[1] + q[3]));
        phi[3] = p[0] * (sq(x) + sq(y) - sq(p[1]));
    }
}

toy! {
    /// Two springs in series, the joint between them massless and its place given by the mass alone: k₁ s = k₂ (x − s).
    /// Parameters: mass at x, mass at s, k1, k2.
    Springs [m = 2.0, light = 0.0, k1 = 3.0, k2 = 5.0] {
        coords: &["x", "s"], constraints: &[holonomic("balance")], holonomic: 1,
    }
    structure { massless: &[1], jacobian_constant: true }
    fn mass<S: Scalar>(p: &[S], _t: S, _q: &[S], entry: &mut dyn FnMut(usize, usize, S)) {
        entry(0, 0, p[0]);
        entry(1, 1, p[1]);
    }
    fn force<S: Scalar>(p: &[S], _t: S, q: &[S], _v: &[S], force: &mut [S]) {
        force[0] = -p[3] * (q[0] - q[1]);
        force[1] = p[3] * (q[0] - q[1]) - p[2] * q[1];
    }
    fn phi<S: Scalar>(p: &[S], _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = p[2] * q[1] - p[3] * (q[0] - q[1]);
    }
}

toy! {
    /// x = sin t, and y free under a constant force. Parameter: mass of x.
    Prescribed [m = 1.0] {
        coords: &["x", "y"], constraints: &[holonomic("drive")], holonomic: 1,
    }
    structure { scleronomic: false, jacobian_constant: true }
    fn mass<S: Scalar>(p: &[S], _t: S, _q: &[S], entry: &mut dyn FnMut(usize, usize, S)) {
        entry(0, 0, p[0]);
        entry(1, 1, c(1.0));
    }
    fn force<S: Scalar>(_p: &[S], _t: S, _q: &[S], _v: &[S], force: &mut [S]) {
        force[1] = c(3.0);
    }
    fn phi<S: Scalar>(_p: &[S], t: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[0] - t.sin();
    }
}

toy! {
    /// x = sin t and x = cos t.
    Contradiction [m = 1.0] {
        coords: &["x", "y"],
        constraints: &[holonomic("sine"), holonomic("line"), holonomic("cosine")],
        holonomic: 3,
    }
    structure { scleronomic: false, jacobian_constant: true }
    fn mass<S: Scalar>(p: &[S], _t: S, _q: &[S], entry: &mut dyn FnMut(usize, usize, S)) {
        entry(0, 0, p[0]);
        entry(1, 1, c(1.0));
    }
    fn force<S: Scalar>(_p: &[S], _t: S, _q: &[S], _v: &[S], _force: &mut [S]) {}
    fn phi<S: Scalar>(_p: &[S], t: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[0] - t.sin();
        phi[1] = q[1];
        phi[2] = q[0] - t.cos();
    }
}

toy! {
    /// Three coordinates of which `z` and `w` may lose their mass and only z + w = 0 is demanded. Parameters: masses of z and w.
    Loose [mz = 0.0, mw = 0.0] {
        coords: &["x", "z", "w"], constraints: &[holonomic("sum")], holonomic: 1,
    }
    structure { massless: &[1, 2] }
    fn mass<S: Scalar>(p: &[S], _t: S, _q: &[S], entry: &mut dyn FnMut(usize, usize, S)) {
        entry(0, 0, c(1.0));
        entry(1, 1, p[0]);
        entry(2, 2, p[1]);
    }
    fn force<S: Scalar>(_p: &[S], _t: S, _q: &[S], _v: &[S], force: &mut [S]) {
        force[0] = c(1.0);
        force[1] = c(1.0);
    }
    fn phi<S: Scalar>(_p: &[S], _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[1] + q[2];
    }
}

toy! {
    /// A block on a slope with a friction force as c, and a knife edge: nonholonomic dot(x) sin(th) = dot(y) cos(th), and
    /// a nonlinear one, dot(x)² + dot(y)² = speed². M couples x and th. Parameters: speed, friction.
    Skate [speed = 2.0, friction = 0.3] {
        coords: &["x", "y", "th"],
        constraints: &[
            ConstraintSpec { name: "edge", kind: ConstraintKind::Nonholonomic, equation: "" },
            ConstraintSpec { name: "pace", kind: ConstraintKind::Nonholonomic, equation: "" },
        ],
    }
    structure { mass_diagonal: false, nonideal: true }
    fn mass<S: Scalar>(_p: &[S], _t: S, q: &[S], entry: &mut dyn FnMut(usize, usize, S)) {
        entry(0, 0, c(2.0));
        entry(1, 1, c(2.0));
        entry(2, 2, c(1.0));
        entry(2, 0, -q[2].sin() * c(0.4));
        entry(2, 1, q[2].cos() * c(0.4));
    }
    fn force<S: Scalar>(_p: &[S], _t: S, _q: &[S], v: &[S], force: &mut [S]) {
        force[0] = c(2.0 * 9.8 * 0.5);
        force[2] = c::<S>(0.7) - c::<S>(0.1) * v[2];
    }
    fn nonideal<S: Scalar>(p: &[S], _t: S, _q: &[S], v: &[S], nonideal: &mut [S]) {
        for i in 0..3 {
            nonideal[i] = -p[1] * v[i] + c(0.2);
        }
    }
    fn phi<S: Scalar>(_p: &[S], _t: S, _q: &[S], _phi: &mut [S]) {}
    fn psi<S: Scalar>(p: &[S], _t: S, q: &[S], v: &[S], psi: &mut [S]) {
        psi[0] = v[0] * q[2].sin() - v[1] * q[2].cos();
        psi[1] = sq(v[0]) + sq(v[1]) - sq(p[0]);
    }
}

toy! {
    /// Orientation of a rigid body by a unit quaternion: M = 4 Gᵀ J G is 4 × 4 of rank 3 with no zero entry; Q are the velocity
    /// terms of Lagrange's equations. Parameters: principal moments of inertia.
    Quaternion [j1 = 1.0, j2 = 2.0, j3 = 4.0] {
        coords: &["e0", "e1", "e2", "e3"], constraints: &[holonomic("unit")], holonomic: 1,
    }
    structure { mass_diagonal: false, mass_constant: false }
    fn mass<S: Scalar>(p: &[S], _t: S, q: &[S], entry: &mut dyn FnMut(usize, usize, S)) {
        let g = body_rates(q);
        for j in 0..4 {
            for i in j..4 {
                let mut x = c::<S>(0.0);
                for (k, row) in g.iter().enumerate() {
                    x = x + c::<S>(4.0) * p[k] * row[i] * row[j];
                }
                entry(i, j, x);
            }
        }
    }
    fn force<S: Scalar>(p: &[S], _t: S, q: &[S], v: &[S], force: &mut [S]) {
        // T = 2 |√J G(q) q̇|². Q = ∂T/∂q − Ṁ q̇ with G(q) q̇ = −G(q̇) q, hence Q = −8 G(q̇)ᵀ J G(q) q̇.
        let (g, gdot) = (body_rates(q), body_rates(v));
        for (i, f) in force.iter_mut().enumerate() {
            *f = c(0.0);
            for k in 0..3 {
                let mut omega = c::<S>(0.0);
                for j in 0..4 {
                    omega = omega + g[k][j] * v[j];
                }
                *f = *f - c::<S>(8.0) * p[k] * gdot[k][i] * omega;
            }
        }
    }
    fn phi<S: Scalar>(_p: &[S], _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = sq(q[0]) + sq(q[1]) + sq(q[2]) + sq(q[3]) - c(1.0);
    }
}

/// G with ω_body = 2 G(e) ė.
fn body_rates<S: Scalar>(e: &[S]) -> [[S; 4]; 3] {
    [
        [-e[1], e[0], e[3], -e[2]],
        [-e[2], -e[3], e[0], e[1]],
        [-e[3], e[2], -e[1], e[0]],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::Evaluated;

    #[test]
    fn b_and_a_of_the_pendulum() {
        let (q, v) = ([0.6, -0.8], [0.4, 0.3]);
        let mut terms = Evaluated::new(2, 1);
        terms.dynamics(&Pendulum::default().prepared(), 0.0, &q, &v);
        assert_eq!(terms.jacobian, [1.2, -1.6]);
        assert!((terms.rhs[0] + 2.0 * 0.25).abs() < 1e-15);
        assert_eq!(terms.force, [0.0, -9.8]);
    }
}
