//! What rounding the equations of a mechanism carry at a state.

use crate::mechanism::{Equations, Evaluated, Prepared};
use crate::rounding::Rounded;

/// The equations in numbers that add up their rounding, at a state whose time, coordinates and velocities are known to rounding. What
/// they carry comes for each constraint, in units of ε: where coordinates are small beside the lengths in it, or terms cancel, it is far
/// more than derivatives tell.
#[derive(Debug, Clone)]
pub(crate) struct Noise {
    mechanism: Prepared<Rounded, dyn Equations<Rounded>>,
    t: Rounded,
    q: Vec<Rounded>,
    v: Vec<Rounded>,
    rows: Vec<Rounded>,
    terms: Evaluated<Rounded>,
}

impl Noise {
    pub(crate) fn new(mechanism: &Prepared) -> Self {
        let (n, m) = (mechanism.spec().n(), mechanism.spec().m());
        let zeros = |len: usize| vec![Rounded::exact(0.0); len];
        Noise {
            mechanism: mechanism.rounded(),
            t: Rounded::exact(0.0),
            q: zeros(n),
            v: zeros(n),
            rows: zeros(m),
            terms: Evaluated::new(n, m),
        }
    }

    /// Goes to a state of `mechanism`, which has its parameters, taken to be exact, and held branches. Its coordinates and velocities j
    /// are known to rounding of the sizes `least(j)`, where they are less themselves.
    pub(crate) fn go(
        &mut self,
        mechanism: &Prepared,
        t: f64,
        state: [&[f64]; 2],
        least: impl Fn(usize) -> [f64; 2],
    ) {
        let given = mechanism.parameters().iter();
        self.mechanism
            .set_parameters(given.map(|p| Rounded::exact(*p)));
        self.mechanism.hold_as(mechanism);
        self.t = Rounded::unknown(t);
        for (k, (rounded, x)) in [&mut self.q, &mut self.v]
            .into_iter()
            .zip(state)
            .enumerate()
        {
            for (j, (rounded, x)) in rounded.iter_mut().zip(x).enumerate() {
                *rounded = Rounded::within(*x, least(j)[k]);
            }
        }
    }

    /// The rounding of φ.
    pub(crate) fn residual(&mut self, out: &mut [f64]) {
        let h = self.mechanism.spec().holonomic;
        self.mechanism
            .residual(self.t, &self.q, &mut self.rows[..h]);
        bounds(&self.rows, out);
    }

    /// The rounding of φ̇ and ψ.
    pub(crate) fn residual_rate(&mut self, out: &mut [f64]) {
        self.mechanism
            .residual_rate(self.t, &self.q, &self.v, &mut self.rows);
        bounds(&self.rows, out);
    }

    /// Tells of each entry (c, j) of A that may differ from 0.
    pub(crate) fn jacobian(&mut self, mut tell: impl FnMut(usize, usize, f64)) {
        self.terms
            .dynamics(&self.mechanism, self.t, &self.q, &self.v);
        let m = self.rows.len();
        for &(c, j) in self.mechanism.spec().structure.jacobian_pattern {
            tell(c, j, self.terms.jacobian[j * m + c].bound());
        }
    }

    /// Puts zeros in place of the rows of A that are less than `share` of their rounding, in units of ε, in all coordinates but those
    /// `held`.
    pub(crate) fn clear(&mut self, jacobian: &mut [f64], share: f64, held: &[usize]) {
        let m = self.rows.len();
        let mut counts = vec![false; m];
        self.jacobian(|c, j, rounding| {
            counts[c] |= jacobian[j * m + c].abs() > share * rounding && !held.contains(&j);
        });
        let pattern = self.mechanism.spec().structure.jacobian_pattern;
        for &(c, j) in pattern.iter().filter(|(c, _)| !counts[*c]) {
            jacobian[j * m + c] = 0.0;
        }
    }

    /// The rounding of Q + c.
    pub(crate) fn force(&mut self, out: &mut [f64]) {
        self.terms
            .dynamics(&self.mechanism, self.t, &self.q, &self.v);
        bounds(&self.terms.force, out);
        let pairs = out.iter_mut().zip(&self.terms.nonideal);
        pairs.for_each(|(out, c)| *out += c.bound());
    }

    /// The rounding of the switching functions.
    pub(crate) fn switching(&mut self, out: &mut [f64]) {
        let mut values = vec![Rounded::exact(0.0); out.len()];
        self.mechanism
            .switching(self.t, &self.q, &self.v, &mut values);
        bounds(&values, out);
    }

    /// The rounding of A q̈ − b.
    pub(crate) fn motion(&mut self, acceleration: &[f64], out: &mut [f64]) {
        self.terms
            .dynamics(&self.mechanism, self.t, &self.q, &self.v);
        bounds(&self.terms.rhs, out);
        let columns = self.terms.jacobian.chunks_exact(out.len().max(1));
        for (column, x) in columns.zip(acceleration) {
            let pairs = out.iter_mut().zip(column);
            pairs.for_each(|(out, a)| *out += a.bound() * x.abs());
        }
    }
}

fn bounds(rows: &[Rounded], out: &mut [f64]) {
    let pairs = out.iter_mut().zip(rows);
    pairs.for_each(|(out, r)| *out = r.bound());
}
