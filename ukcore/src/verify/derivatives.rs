//! M, Q, A and b against derivatives of what is declared.

use super::{Declared, Findings, along, constants};
use crate::assemble::State;
use crate::displacements::{constraint_matrix, mass_matrix};
use crate::mechanism::{Dynamics, Evaluated, Prepared};
use crate::rounding::Rounded;
use crate::scalar::{Dual, Scalar, Sloped, Slopes};
use crate::scan::{largest, or_one};

/// Two ways to compute the same carry about the same rounding; so many times that is allowed.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Terms that cancel in one of the two ways may do so in the other alone: this part of the terms is allowed besides.
const PART: f64 = 1e-11;

/// A state of a mechanism, and what the equations say there.
struct Checked<'a> {
    mech: &'a Prepared,
    sloped: Prepared<Sloped, dyn Dynamics<Sloped>>,
    declared: Declared,
    state: &'a State,
    terms: Evaluated,
    rounding: Evaluated<Rounded>,
}

/// Compares all of them at `state`, which need not be on the constraints.
pub(super) fn check(mech: &Prepared, declared: Declared, state: &State, found: &mut Findings) {
    let (n, m) = (mech.spec().n(), mech.spec().m());
    let State { t, q, v } = state;
    let mut terms = Evaluated::new(n, m);
    terms.dynamics(mech, *t, q, v);
    let mut rounding = Evaluated::new(n, m);
    let unknown = |x: &[f64]| x.iter().map(|x| Rounded::unknown(*x)).collect();
    let (rounded_q, rounded_v): (Vec<_>, Vec<_>) = (unknown(q), unknown(v));
    rounding.dynamics(
        &mech.rounded(),
        Rounded::unknown(*t),
        &rounded_q,
        &rounded_v,
    );
    let checked = Checked {
        mech,
        sloped: mech.sloped(),
        declared,
        state,
        terms,
        rounding,
    };
    checked.constraints(found);
    checked.mass(found);
    checked.force(found);
    if found.faults.is_empty() {
        checked.again(found);
    }
}

impl Checked<'_> {
    /// φ, or φ̇ and ψ, with their derivatives along several directions: `slope` has entry i of (t, q, q̇) in direction k.
    fn rows(&self, position: bool, slope: impl Fn(usize, usize) -> f64) -> Vec<Sloped> {
        let spec = self.mech.spec();
        let State { t, q, v } = self.state;
        let sloped = |x: &f64, i: usize| Sloped::new(*x, Slopes::new(|k| slope(i, k)));
        let all = |x: &[f64], first: usize| -> Vec<Sloped> {
            let entries = x.iter().zip(first..);
            entries.map(|(x, i)| sloped(x, i)).collect()
        };
        let (t, q, v) = (sloped(t, 0), all(q, 1), all(v, 1 + q.len()));
        let count = if position { spec.holonomic } else { spec.m() };
        let mut rows = vec![Sloped::from_f64(0.0); count];
        match position {
            true => self.sloped.residual(t, &q, &mut rows),
            false => self.sloped.residual_rate(t, &q, &v, &mut rows),
        }
        rows
    }

    /// A, φ̇ and b.
    fn constraints(&self, found: &mut Findings) {
        let spec = self.mech.spec();
        let (n, m) = (spec.n(), spec.m());
        if m == 0 {
            return;
        }
        let row_name = |i: usize| format!("row `{}`", spec.constraints[i].name);
        let mut scales = vec![0.0_f64; m];
        let entry = |i: usize, j: usize| self.terms.jacobian[j * m + i];
        let bound = |i: usize, j: usize| ROUNDING * self.rounding.jacobian[j * m + i].bound();
        for (i, scale) in scales.iter_mut().enumerate() {
            let entries = (0..n).map(|j| entry(i, j).abs());
            *scale = PART * entries.fold(0.0, f64::max);
            *scale += (0..n).map(|j| bound(i, j)).fold(0.0, f64::max);
        }
        // Σ|terms| of d/dt of each row at constant velocities.
        let mut sizes = vec![0.0_f64; m];
        for first in (0..n).step_by(Slopes::COUNT) {
            let unit = |own: usize| move |i, k| f64::from(u8::from(i == own + first + k));
            let (by_position, by_velocity) = (unit(1), unit(1 + n));
            let slopes = self.rows(true, by_position);
            let rates = self.rows(false, by_velocity);
            let turns = self.rows(false, by_position);
            for j in first..n.min(first + Slopes::COUNT) {
                let along = |row: &Sloped| row.eps.along(j - first);
                for i in 0..m {
                    let (symbol, slope) = match slopes.get(i) {
                        Some(phi) => ("∂φ/∂q", along(phi)),
                        None => ("∂ψ/∂q̇", along(&rates[i])),
                    };
                    let place = || format!("{}, coordinate `{}`: A", row_name(i), spec.coords[j]);
                    found.compare(place, entry(i, j), (symbol, slope), scales[i]);
                    sizes[i] += (along(&turns[i]) * self.state.v[j]).abs();
                }
            }
        }
        let forward = self.twice();
        let turning = self.rows(false, |i, _| match i {
            0 => 1.0,
            i => self.state.v.get(i - 1).copied().unwrap_or(0.0),
        });
        for i in 0..m {
            let speed = largest(&self.state.v);
            let steep = (0..n).map(|j| (entry(i, j) * self.state.v[j]).abs());
            let steep = PART * steep.sum::<f64>() + scales[i] * speed;
            let (symbol, expected) = match forward.get(i) {
                Some(phi) => {
                    let slope = phi.re.eps;
                    let allowed = steep + PART * slope.abs();
                    let place = || format!("{}: its rate", row_name(i));
                    found.compare(place, turning[i].re, ("dφ/dt", slope), allowed);
                    ("−φ̈ at q̈ = 0", -phi.eps.eps)
                }
                None => ("−ψ̇ at q̈ = 0", -turning[i].eps.along(0)),
            };
            let own = ROUNDING * self.rounding.rhs[i].bound();
            let allowed = PART * (sizes[i] + expected.abs()) + own;
            let place = || format!("{}: b", row_name(i));
            found.compare(place, self.terms.rhs[i], (symbol, expected), allowed);
        }
    }

    /// φ with its first and second derivatives along (1, q̇) at constant velocities: φ̇ as `re.eps`, φ̈ as `eps.eps`.
    fn twice(&self) -> Vec<Dual<Dual>> {
        let State { t, q, v } = self.state;
        let twice = |x: f64, d: f64| Dual::new(Dual::new(x, d), Dual::from_f64(d));
        let q: Vec<_> = q.iter().zip(v).map(|(x, d)| twice(*x, *d)).collect();
        (self.declared.residual)(self.mech, twice(*t, 1.0), &q)
    }

    /// M against T, which is quadratic in q̇: T(a + b) − T(a) − T(b) + T(0) is then aᵀM b.
    fn mass(&self, found: &mut Findings) {
        let spec = self.mech.spec();
        let n = spec.n();
        let State { t, q, .. } = self.state;
        let entry = |i: usize, j: usize| self.terms.mass[j * n + i];
        let units: Vec<f64> = (0..n)
            .map(|i| match entry(i, i) {
                m if m > 0.0 && m.is_finite() => m.sqrt().recip(),
                _ => 1.0,
            })
            .collect();
        let kinetic = |pairs: [usize; 2], count: usize| {
            let mut v = vec![0.0; n];
            for i in &pairs[..count] {
                v[*i] += units[*i];
            }
            self.mech.energy(*t, q, &v).kinetic
        };
        let rest = kinetic([0; 2], 0);
        let single: Vec<f64> = (0..n).map(|i| kinetic([i; 2], 1)).collect();
        for j in 0..n {
            for i in j..n {
                let both = kinetic([i, j], 2);
                let expected = both - single[i] - single[j] + rest;
                let terms = [both, single[i], single[j], rest];
                let size: f64 = terms.map(f64::abs).iter().sum();
                let scale = units[i] * units[j];
                let own = ROUNDING * scale * self.rounding.mass[j * n + i].bound();
                let allowed = PART * size + own;
                let names = [spec.coords[i], spec.coords[j]];
                let place = || format!("coordinates `{}` and `{}`: M", names[0], names[1]);
                let hessian = ("∂²T/∂q̇²", expected / scale);
                found.compare(place, entry(i, j), hessian, allowed / scale);
            }
        }
    }

    /// Q against ∂(T − V)/∂q − d/dt ∂T/∂q̇ at q̈ = 0, where no force is declared.
    fn force(&self, found: &mut Findings) {
        for (i, name) in self.mech.spec().coords.iter().enumerate() {
            if self.mech.spec().structure.forced.contains(&i) {
                continue;
            }
            let (expected, size) = lagrangian(self.mech, self.declared, self.state, i);
            let own = ROUNDING * self.rounding.force[i].bound();
            let place = || format!("coordinate `{name}`: Q");
            let told = ("∂(T − V)/∂q − d/dt ∂T/∂q̇", expected);
            found.compare(place, self.terms.force[i], told, PART * size + own);
        }
    }

    /// M and A alone, against M and A among the other terms.
    fn again(&self, found: &mut Findings) {
        let names = self.mech.spec().coords;
        let mass = mass_matrix(self.mech, self.state);
        let jacobian = constraint_matrix(self.mech, self.state);
        let pairs = [
            ("M", mass.as_slice(), &self.terms.mass, &self.rounding.mass),
            (
                "A",
                jacobian.as_slice(),
                &self.terms.jacobian,
                &self.rounding.jacobian,
            ),
        ];
        for (matrix, alone, among, rounding) in pairs {
            let rows = alone.len() / names.len().max(1);
            for (k, (alone, among)) in alone.iter().zip(among).enumerate() {
                let allowed = ROUNDING * rounding[k].bound();
                let column = || format!("coordinate `{}`: {matrix} alone", names[k / rows]);
                let told = (format!("among the other terms {matrix}"), *among);
                found.compare(column, *alone, (&told.0, told.1), allowed);
            }
        }
    }
}

/// Q of coordinate `i` as Lagrange's equations make it of T and V, and the sum of the magnitudes of its parts.
pub(super) fn lagrangian(
    mech: &Prepared,
    declared: Declared,
    state: &State,
    i: usize,
) -> (f64, f64) {
    let State { t, q, v } = state;
    let mut at = constants(q);
    at[i].eps = 1.0;
    let here = (declared.energy)(mech, Dual::from_f64(*t), &at, &constants(v));
    // ∂T/∂q̇_i of a quadratic T is a difference over any length.
    let h = or_one(largest(v));
    let moving = |h: f64| {
        let mut v = constants(v);
        v[i].re += h;
        (declared.energy)(mech, Dual::new(*t, 1.0), &along(q, &state.v), &v)
            .kinetic
            .eps
            / (2.0 * h)
    };
    let [after, before] = [moving(h), -moving(-h)];
    let [kinetic, potential] = [here.kinetic.eps, here.potential.eps];
    let slopes = [kinetic, potential, after, before];
    let slopes: f64 = slopes.iter().map(|x| x.abs()).sum();
    // A slope that is zero but for rounding is no part: it is as large as energy over length.
    let length = or_one(largest(q));
    let energy = here.kinetic.re.abs() + here.potential.re.abs();
    let size = slopes.max(ROUNDING / PART * energy / length);
    (kinetic - potential - (after - before), size)
}
