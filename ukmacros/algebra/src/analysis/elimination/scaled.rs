//! What is taken out of a system beforehand: a factor that all of M shares, as the one mass of all parts, only scales the multipliers, and
//! a number that all coefficients of a constraint share would be multiplied through everything.

use crate::analysis::dynamics::Dynamics;
use crate::analysis::frame::Turned;
use crate::expr::{Graph, Id, is_power_of_two};

/// A system as it is eliminated.
pub(super) struct Scaled {
    /// With M and Q + c, which stands for Q, over the factor, and rows of A and b over their scales.
    pub(super) dynamics: Dynamics,
    pub(super) common_factor: Id,
    pub(super) scales: Vec<f64>,
}

impl Scaled {
    /// Scales the equations `d`.
    pub(super) fn of(d: &Dynamics, g: &mut Graph) -> Self {
        let (common_factor, mut dynamics) = without_common_factor(d, g);
        for (q, c) in dynamics.force.iter_mut().zip(dynamics.nonideal.drain(..)) {
            *q = g.add(*q, c);
        }
        let scales: Vec<f64> = (0..d.rhs.len()).map(|row| share(d, row, g)).collect();
        for ((row, _), a) in &mut dynamics.jacobian {
            *a = g.scale(1.0 / scales[*row], *a);
        }
        let mut scaled = Scaled {
            dynamics,
            common_factor,
            scales,
        };
        scaled.dynamics.rhs = scaled.rows(1.0, &d.rhs, g);
        scaled
    }

    /// Numbers of constraints, with this sign, as their rows are scaled.
    pub(super) fn rows(&self, sign: f64, ids: &[Id], g: &mut Graph) -> Vec<Id> {
        let rows = ids.iter().zip(&self.scales);
        rows.map(|(id, s)| g.scale(sign / s, *id)).collect()
    }

    /// λ from the constraints' part x of a solution with M over `factor`, where rows are as they are `turned`.
    pub(super) fn multipliers(
        &self,
        x: &[Id],
        factor: Id,
        turned: &Turned,
        g: &mut Graph,
    ) -> Vec<Id> {
        let scaled = x.iter().zip(&self.scales).map(|(x, s)| {
            let x = g.mul(*x, factor);
            g.scale(-1.0 / s, x)
        });
        let mut multipliers: Vec<Id> = scaled.collect();
        turned.turn_multipliers(&mut multipliers, g);
        multipliers
    }
}

/// The product of parameters that all entries of M have in front, and the equations with M, Q and c divided by it.
fn without_common_factor(d: &Dynamics, g: &mut Graph) -> (Id, Dynamics) {
    let mut entries = d.mass.values();
    let mut common = entries.next().map_or(Vec::new(), |m| g.factors(*m));
    common.retain(|(base, _)| g.uses(*base).constant() && g.as_const(*base).is_none());
    for entry in entries {
        let factors = g.factors(*entry);
        common.retain(|factor| factors.contains(factor));
    }
    let mut factor = g.product(&common);
    // A number that all entries off the diagonal are goes with it: they are multiplied by more often than those on it.
    let off = d.mass.iter().filter(|((i, j), _)| i != j);
    let mut off = off.map(|(_, m)| {
        let rest = g.div(*m, factor);
        g.as_const(rest).map(f64::abs).filter(|m| m.is_normal())
    });
    let first = off.next().flatten();
    let number = first.filter(|first| off.all(|m| m == Some(*first)));
    factor = g.scale(number.unwrap_or(1.0), factor);
    let mut scaled = d.clone();
    if factor != g.one() {
        let vectors = scaled.force.iter_mut().chain(&mut scaled.nonideal);
        for value in scaled.mass.values_mut().chain(vectors) {
            // Term by term, so that the factor cancels where it can.
            let terms = g.open(1.0, *value);
            let divided = terms.into_iter().map(|(k, term)| (k, g.div(term, factor)));
            let divided: Vec<(f64, Id)> = divided.collect();
            *value = g.sum(&divided);
        }
    }
    (factor, scaled)
}

/// The magnitude that the coefficients of all entries of a row of A share, if it is a power of two (so that dividing is exact); else 1.
fn share(d: &Dynamics, row: usize, g: &Graph) -> f64 {
    let mut sizes = d.row(row).map(|(_, a)| match g.as_const(a) {
        Some(x) => x.abs(),
        None => g.unscaled(a).0.abs(),
    });
    match sizes.next() {
        Some(first) if is_power_of_two(first) && sizes.all(|s| s == first) => first,
        _ => 1.0,
    }
}
