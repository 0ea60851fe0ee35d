//! The constrained solve as part of the graph: [M Aᵀ; A 0] [q̈; −λ] = [Q; b] eliminated symbolically, in an order chosen here.
//!
//! Pivots, in this order of preference:
//! 1. A massless coordinate, or one that a constraint prescribes alone, together with a constraint in which its coefficient is a
//!    number: the 2 × 2 pivot [μ a; a 0] with a ≠ 0 is safe whatever the state.
//! 2. Coordinates with inertia, and constraints all of whose coordinates are eliminated: 1 × 1 pivots that are definite where A has full
//!    rank, since what is eliminated is then a saddle-point matrix of its own. Coordinates that share no inertia with others come first; then what has the fewest neighbours (least fill); among equals what waits for the
//!    shortest chain of divisions, so that a chain of links is taken from both ends at once.
//!
//! Every 1 × 1 pivot is checked at run time: see [`certificate`].

mod certificate;
mod matrix;
mod order;

pub(crate) use certificate::{SAFE_SHARE, Straight};

use super::dynamics::Dynamics;
use crate::expr::{Graph, Id, Symbol, is_power_of_two};
use matrix::Matrix;
use order::order;

/// A 1 × 1 pivot d and the diagonal G it started from, both times a positive number: rank is lost where d/G falls to rounding.
#[derive(Clone)]
pub(crate) struct Pivot {
    /// Of the coordinate or constraint.
    pub(crate) name: String,
    /// Its position: coordinates first, then constraints.
    pub(crate) position: usize,
    pub(crate) value: Id,
    pub(crate) reference: Id,
    /// Its right-hand side, times the same number.
    right: Option<Id>,
}

/// The straight-line solve.
#[derive(Clone)]
pub(crate) struct Elimination {
    /// q̈.
    pub(crate) acceleration: Vec<Id>,
    /// Δ of least M-norm with A Δ = −residual (residuals are [`Symbol::Residual`]).
    pub(crate) correction: Vec<Id>,
    pub(crate) pivots: Vec<Pivot>,
    /// Right-hand sides of the pivots in the solution for the correction.
    correction_rights: Vec<Id>,
    /// The order: names of coordinates (positions below n) and constraints (n + row); pairs for 2 × 2 pivots.
    pub(crate) order: Vec<Pivoting>,
    /// Names of pivots, factors and multipliers.
    pub(crate) hints: Vec<(Id, String)>,
}

/// One pivot of the order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pivoting {
    One(usize),
    /// Coordinate and constraint.
    Two(usize, usize),
}

/// Eliminates; or says why the structure does not allow it.
pub(crate) fn eliminate(
    d: &Dynamics,
    names: &[String],
    g: &mut Graph,
) -> Result<Elimination, String> {
    let n = d.force.len();
    let order = order(d, names, g)?;
    let zero = g.zero();
    // A factor that all of M shares, as the one mass of all parts, only scales the multipliers: it is taken out of M and Q.
    let (factor, d) = &without_common_factor(d, g);
    let mut pivots = Vec::new();
    let first = d.mass.keys().next().map_or(0, |(i, _)| *i);
    let unit = g.one();
    if *factor != unit {
        pivots.push(Pivot {
            name: names[first].clone(),
            position: first,
            value: *factor,
            reference: *factor,
            right: None,
        });
    }
    let force: Vec<Id> = (0..n).map(|i| g.add(d.force[i], d.nonideal[i])).collect();
    // A constraint may be divided by a number: one that all its coefficients share would be multiplied through everything.
    let scales: Vec<f64> = (0..d.rhs.len()).map(|row| share(d, row, g)).collect();
    let scaled = |ids: &[Id], g: &mut Graph| -> Vec<Id> {
        let rows = ids.iter().zip(&scales);
        rows.map(|(id, s)| g.scale(1.0 / s, *id)).collect()
    };
    let mut jacobian = d.jacobian.clone();
    for ((row, _), a) in &mut jacobian {
        *a = g.scale(1.0 / scales[*row], *a);
    }
    let rhs = scaled(&d.rhs, g);
    let mut system = Matrix::new(d, &jacobian, g);
    system.load(&force, &rhs);
    let mut hints = Vec::new();
    let (acceleration, own) = system.solve(&order, names, g, &mut hints)?;
    pivots.extend(own);
    let residuals: Vec<Id> = (0..d.rhs.len())
        .map(|i| {
            let r = g.symbol(Symbol::Residual(i));
            g.neg(r)
        })
        .collect();
    let residuals = scaled(&residuals, g);
    let mut system = Matrix::new(d, &jacobian, g);
    system.load(&vec![zero; n], &residuals);
    // The same pivots, with other right-hand sides.
    let (correction, again) = system.solve(&order, names, g, &mut hints)?;
    Ok(Elimination {
        acceleration,
        correction,
        pivots,
        correction_rights: again.iter().filter_map(|p| p.right).collect(),
        order,
        hints,
    })
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
    let factor = g.product(&common);
    let mut scaled = d.clone();
    if !common.is_empty() {
        let vectors = scaled.force.iter_mut().chain(&mut scaled.nonideal);
        for value in scaled.mass.values_mut().chain(vectors) {
            // Term by term, so that the factor cancels where it can.
            let terms = g.open(1.0, *value);
            let divided: Vec<(f64, Id)> = terms
                .into_iter()
                .map(|(k, term)| (k, g.div(term, factor)))
                .collect();
            *value = g.sum(&divided);
        }
    }
    (factor, scaled)
}

/// The magnitude that the coefficients of all entries of a row of A share, if it is a power of two (so that dividing is exact); else 1.
fn share(d: &Dynamics, row: usize, g: &Graph) -> f64 {
    let mut sizes = d
        .jacobian
        .range((row, 0)..(row + 1, 0))
        .map(|(_, a)| match g.as_const(*a) {
            Some(x) => x.abs(),
            None => g.unscaled(*a).0.abs(),
        });
    let Some(first) = sizes.next() else {
        return 1.0;
    };
    if is_power_of_two(first) && sizes.all(|s| s == first) {
        first
    } else {
        1.0
    }
}
