//! The constrained solve as part of the graph: [M Aᵀ; A 0] [q̈; −λ] = [Q; b] eliminated symbolically, in an order chosen here.
//!
//! Pivots, in this order of preference:
//! 1. A massless coordinate, or one that a constraint prescribes alone, together with a constraint in which its coefficient is a
//!    number: the 2 × 2 pivot [μ a; a 0] with a ≠ 0 is safe whatever the state.
//! 2. Coordinates with inertia, and constraints all of whose coordinates are eliminated: 1 × 1 pivots that are definite where A has full
//!    rank, since what is eliminated is then a saddle-point matrix of its own. Coordinates that share no inertia with others come first;
//!    then what has the fewest neighbours (least fill); among equals what waits for the
//!    shortest chain of divisions, so that a chain of links is taken from both ends at once.
//!
//! Every 1 × 1 pivot is checked at run time: see [`certificate`]; rows that imply each other, and may be left out, in a way of their own: see
//! [`dropping`].
//!
//! In steps: [`order`] chooses the pivots on the [`pattern`] of K, which also tells what is filled in; [`matrix`] eliminates K in that
//! order; [`solution`] solves for a right-hand side.

mod certificate;
mod dropping;
mod matrix;
mod order;
mod pattern;
mod solution;

pub(crate) use certificate::{SAFE_SHARE, Solve, Straight};

use super::dynamics::Dynamics;
use super::redundant::redundant;
use crate::expr::{Graph, Id, Symbol, is_power_of_two};
use dropping::{Dropping, droppings};
use matrix::Matrix;
use order::{Order, order};
use solution::Forward;
use std::collections::BTreeSet;

/// A 1 × 1 pivot d and the diagonal G it started from, both times a positive number: rank is lost where d/G falls to rounding.
#[derive(Clone)]
pub(crate) struct Divisor {
    /// Of the coordinate or constraint.
    name: String,
    /// Its position: coordinates first, then constraints.
    position: usize,
    value: Id,
    reference: Id,
    /// Whether its row may be left out.
    droppable: bool,
}

/// The straight-line solve.
#[derive(Clone)]
pub(crate) struct Elimination {
    /// q̈.
    pub(crate) acceleration: Vec<Id>,
    /// Δ of least M-norm with A Δ = −residual (residuals are [`Symbol::Residual`]).
    pub(crate) correction: Vec<Id>,
    /// The factor that all of M shares, if there is one, and the 1 × 1 pivots, each with its right-hand side for the acceleration.
    divisors: Vec<(Divisor, Option<Id>)>,
    /// Right-hand sides of the pivots in the solution for the correction.
    correction_rights: Vec<Id>,
    /// What is checked of the rows that may be left out.
    droppings: Vec<Dropping>,
    order: Order,
    /// Names of pivots, factors and multipliers.
    hints: Vec<(Id, String)>,
}

/// One pivot of the order. Positions: coordinate i is i, constraint i is n + i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pivoting {
    Single(usize),
    Pair(Pair),
}

/// A coordinate that is eliminated with a constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair {
    pub(crate) coordinate: usize,
    pub(crate) constraint: usize,
    /// The coordinate's coefficient in the constraint.
    pub(crate) coefficient: f64,
    /// Whether the coordinate has inertia; then the constraint prescribes it alone.
    pub(crate) massive: bool,
}

/// Eliminates; or says why the structure does not allow it. To M of `d` were added Σ μ aᵀa of rows a of A, to Q the Σ μ aᵀb; `weights` are
/// the (row, coordinate, μ a_i), by which a correction has the like of its residuals.
pub(crate) fn eliminate(
    d: &Dynamics,
    weights: &[(usize, usize, Id)],
    names: &[String],
    defaults: &[f64],
    g: &mut Graph,
) -> Result<Elimination, String> {
    let order = order(d, names, g)?;
    let droppable = droppable(d, &order, defaults, g);
    // A factor that all of M shares, as the one mass of all parts, only scales the multipliers: it is taken out of M and Q.
    let (common_factor, d) = &without_common_factor(d, g);
    let common = (*common_factor != g.one()).then(|| {
        let position = d.mass.keys().next().map_or(0, |(i, _)| *i);
        let divisor = Divisor {
            name: names[position].clone(),
            position,
            value: *common_factor,
            reference: *common_factor,
            droppable: false,
        };
        (divisor, None)
    });
    let forces = d.force.iter().zip(&d.nonideal);
    let force: Vec<Id> = forces.map(|(q, c)| g.add(*q, *c)).collect();
    // A constraint may be divided by a number: one that all its coefficients share would be multiplied through everything.
    let scales: Vec<f64> = (0..d.rhs.len()).map(|row| share(d, row, g)).collect();
    let mut jacobian = d.jacobian.clone();
    for ((row, _), a) in &mut jacobian {
        *a = g.scale(1.0 / scales[*row], *a);
    }
    let scaled = |sign: f64, ids: &[Id], g: &mut Graph| -> Vec<Id> {
        let rows = ids.iter().zip(&scales);
        rows.map(|(id, s)| g.scale(sign / s, *id)).collect()
    };
    let rhs = scaled(1.0, &d.rhs, g);
    let mut hints = Vec::new();
    let mut matrix = Matrix::new(d, &jacobian, &order.pivots, droppable, g);
    let mut motion = Forward::new(&force, &rhs);
    let (mut factors, mut divisors) = (Vec::new(), Vec::new());
    for step in &order.pivots {
        let (factor, divisor) = matrix.step(*step, names, g, &mut hints)?;
        motion.step(&factor, g);
        factors.push(factor);
        divisors.extend(divisor);
    }
    let motion = motion.solution(&factors, names, g, &mut hints)?;
    let droppings = droppings(&factors, &motion, d, [&force, &rhs], g);
    let residuals = (0..d.rhs.len()).map(|i| g.symbol(Symbol::Residual(i)));
    let residuals: Vec<Id> = residuals.collect();
    let mut pull = vec![g.zero(); force.len()];
    for (row, i, weight) in weights {
        let weight = g.div(*weight, *common_factor);
        let term = g.mul(weight, residuals[*row]);
        pull[*i] = g.sub(pull[*i], term);
    }
    let residuals = scaled(-1.0, &residuals, g);
    let mut projection = Forward::new(&pull, &residuals);
    factors.iter().for_each(|factor| projection.step(factor, g));
    let projection = projection.solution(&factors, names, g, &mut hints)?;
    let rights = motion.rights.into_iter().map(Some);
    let divisors = divisors.into_iter().zip(rights);
    Ok(Elimination {
        acceleration: motion.coordinates,
        correction: projection.coordinates,
        divisors: common.into_iter().chain(divisors).collect(),
        correction_rights: projection.rights,
        droppings,
        order,
        hints,
    })
}

/// The positions of constraints that are eliminated alone and may be left out.
fn droppable(d: &Dynamics, order: &Order, defaults: &[f64], g: &Graph) -> BTreeSet<usize> {
    let n = d.force.len();
    let rows = order.pivots.iter().filter_map(|pivot| match *pivot {
        Pivoting::Single(k) => k.checked_sub(n),
        Pivoting::Pair(pair) => Some(pair.constraint - n),
    });
    let found = redundant(d, &rows.collect::<Vec<_>>(), defaults, g);
    let alone = |pivot: &Pivoting| match *pivot {
        Pivoting::Single(k) if k >= n && found.contains(&(k - n)) => Some(k),
        _ => None,
    };
    order.pivots.iter().filter_map(alone).collect()
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
            let divided = terms.into_iter().map(|(k, term)| (k, g.div(term, factor)));
            let divided: Vec<(f64, Id)> = divided.collect();
            *value = g.sum(&divided);
        }
    }
    (factor, scaled)
}

/// The magnitude that the coefficients of all entries of a row of A share, if it is a power of two (so that dividing is exact); else 1.
fn share(d: &Dynamics, row: usize, g: &Graph) -> f64 {
    let row = d.jacobian.range((row, 0)..(row + 1, 0));
    let mut sizes = row.map(|(_, a)| match g.as_const(*a) {
        Some(x) => x.abs(),
        None => g.unscaled(*a).0.abs(),
    });
    match sizes.next() {
        Some(first) if is_power_of_two(first) && sizes.all(|s| s == first) => first,
        _ => 1.0,
    }
}
