//! The constrained solve as part of the graph: [M Aᵀ; A 0] [q̈; −λ] = [Q; b] eliminated symbolically, in an order chosen here.
//!
//! Pivots:
//! 1. A coordinate together with a constraint in which its coefficient is a number or, if it has no inertia, depends on parameters alone,
//!    also after steps before: the 2 × 2 pivot [μ a; a 0] with a ≠ 0 is safe whatever the state. What is left is the system in the other
//!    coordinates, M' = Zᵀ M Z. Bodies pinned to each other are eliminated so, each with its pins, and velocities that T is written in with
//!    their definitions (the module `lift`). So are bodies in space and the rates of turning that their joints were solved for
//!    ([`super::joint`]).
//! 2. Coordinates with inertia, and constraints all of whose coordinates are eliminated: 1 × 1 pivots that are definite where A has full
//!    rank, since what is eliminated is then a saddle-point matrix of its own.
//! 3. Two coordinates with a constraint that contains them alone, turned into what it prescribes and what it leaves free: see [`rotation`].
//!
//! Which pairs and rotations are taken, and when, is a matter of [`order::Taste`]; several orders are eliminated, and the cheapest is taken
//! ([`super::choice`]).
//!
//! Every 1 × 1 pivot is checked at run time: see [`certificate`]; rows that imply each other, and may be left out, in a way of their own:
//! see [`dropping`].
//!
//! In steps: [`order`] chooses the pivots on the [`pattern`] of K, which also tells what is filled in; [`matrix`] eliminates K, [`scaled`],
//! in that order; [`solution`] solves for a right-hand side.

mod certificate;
mod dropping;
mod entry;
mod freedoms;
mod matrix;
mod order;
mod pair;
mod pattern;
mod rotation;
mod scaled;
mod solution;

use certificate::SAFE_SHARE;
pub use certificate::{Solve, Straight};

use super::dynamics::Dynamics;
use super::frame::Turned;
use crate::expr::{Graph, Id, Symbol};
use dropping::{Dropping, droppings, kernel, shares, squares};
use matrix::{Factor, Matrix};
pub(super) use order::Order;
use order::{Taste, order};
use pattern::Pattern;
pub use rotation::Rotation;
use scaled::Scaled;
use solution::{Forward, Solution};
use std::collections::BTreeSet;

/// A 1 × 1 pivot d and the diagonal G it started from, both times a positive number: rank is lost where d/G falls to rounding.
#[derive(Clone)]
pub(super) struct Divisor {
    /// The name of the coordinate or constraint.
    name: String,
    /// The position of the pivot: coordinates first, then constraints.
    position: usize,
    value: Id,
    reference: Id,
    /// Whether its row may be left out.
    droppable: bool,
    /// Inertia that nothing is divided by: it may be zero.
    may_vanish: bool,
}

impl Divisor {
    /// What has to be positive.
    fn positive(position: usize, value: Id, names: &[String]) -> Self {
        Divisor {
            name: names[position].clone(),
            position,
            value,
            reference: value,
            droppable: false,
            may_vanish: false,
        }
    }
}

/// The straight-line solve.
#[derive(Clone)]
pub struct Elimination {
    /// q̈.
    pub acceleration: Vec<Id>,
    /// λ of all constraints, with M q̈ = Q + c + Aᵀλ, if they are wanted.
    pub multipliers: Vec<Id>,
    /// Δ of least M-norm with A Δ = −residual (residuals are [`Symbol::Residual`]).
    pub correction: Vec<Id>,
    /// The factor that all of M shares, if there is one, and the 1 × 1 pivots, each with its right-hand side for the acceleration.
    divisors: Vec<(Divisor, Option<Id>)>,
    /// Right-hand sides of the pivots in the solution for the correction.
    correction_rights: Vec<Id>,
    /// What is checked of the rows that may be left out.
    droppings: Vec<Dropping>,
    /// The share of each constraint in what the rows left out follow from, squared, where rows may be left out and multipliers are wanted.
    shares: Vec<Option<Id>>,
    order: Order,
    /// Whether there are no constraints, but for definitions that are substituted.
    free: bool,
    /// Whether a constraint is a pivot by itself, solved for its multiplier.
    solved: bool,
    /// Inertias that do not vary, where multipliers are solved for.
    inertias: Vec<Id>,
    /// The constraints of frames: what is turned back from rates meets them, whatever the rates are.
    turned: Vec<usize>,
    /// The place in the mechanism of each coordinate and constraint of the system; `None` for velocities and their definitions.
    place: Vec<Option<usize>>,
    /// Names of pivots, factors and multipliers.
    hints: Vec<(Id, String)>,
}

/// One pivot of the order. Positions: coordinate i is i, constraint i is n + i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pivoting {
    Single(usize),
    Pair(Pair),
    Rotation(Rotation),
}

/// A coordinate that is eliminated with a constraint in which its coefficient is fixed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    pub coordinate: usize,
    pub constraint: usize,
    /// The coordinate's coefficient in the constraint.
    pub coefficient: Coefficient,
    /// Whether the coordinate has inertia.
    pub massive: bool,
    /// Whether the constraint contains nothing else.
    pub alone: bool,
}

impl Pair {
    /// Whether both are among as many coordinates and constraints as come first in a system with `n` coordinates.
    fn is_of(&self, (coordinates, constraints): (usize, usize), n: usize) -> bool {
        self.coordinate < coordinates && self.constraint - n < constraints
    }
}

/// An entry of A, or of what is left of it, that is the same at all states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficient {
    /// The value of the coefficient; with the default parameters, if it is no number.
    pub value: f64,
    /// Whether it is a number: else it depends on parameters.
    pub number: bool,
}

/// A difference below this share of what it is of has lost digits: it is no pivot. It is the root of [`SAFE_SHARE`].
const CLEAR: f64 = 1.0 / 32.0;
const _: () = assert!(CLEAR * CLEAR == SAFE_SHARE);

impl Coefficient {
    const ZERO: Coefficient = Coefficient {
        value: 0.0,
        number: true,
    };

    /// self − f · o/pivot; nothing where that cancels to rounding for the default parameters alone.
    fn less(self, f: Coefficient, o: Coefficient, pivot: Coefficient) -> Option<Coefficient> {
        let taken = f.value * o.value / pivot.value;
        let value = self.value - taken;
        let number = self.number && f.number && o.number && pivot.number;
        let clear = value.abs() > CLEAR * taken.abs() || (number && value == 0.0);
        clear.then_some(Coefficient { value, number })
    }
}

/// A system that is eliminated.
pub struct Task<'a> {
    /// The equations.
    pub dynamics: &'a Dynamics,
    /// The (row, coordinate, μ a_i) of rows a of A, where Σ μ aᵀa was added to M and Σ μ aᵀb to Q: by these a correction has the like of
    /// its residuals.
    pub weights: &'a [(usize, usize, Id)],
    /// The names of coordinates and constraints.
    pub names: &'a [String],
    /// How many of the coordinates and of the constraints are the mechanism's.
    pub own: (usize, usize),
    /// What the others are.
    pub further: Further,
    /// The constraints that may follow from others.
    pub redundant: &'a BTreeSet<usize>,
    /// The coordinates that others stand for, and the constraints that are solved for these.
    pub turned: &'a Turned,
    /// The equations in the mechanism's coordinates, if all their multipliers are wanted.
    pub multipliers: Option<&'a Dynamics>,
}

/// What a system has beyond the coordinates and constraints of the mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Further {
    Nothing,
    /// Velocities that the kinetic energy is written in, with their definitions: see the module `lift`.
    Velocities,
    /// Copies of coordinates, tied to each other: see the module `hub`.
    Copies,
}

/// The orders that a system may be eliminated in; or why there is none. `defaults` are those of the parameters.
pub fn orders(task: &Task<'_>, defaults: &[f64], g: &Graph) -> Result<Vec<Order>, String> {
    let pattern = Pattern::new(task.dynamics, task.own, defaults, g);
    let pattern = pattern.keep(task.redundant);
    let mut orders: Vec<(Taste, Order)> = Vec::new();
    let mut refusal = None;
    for taste in Taste::ALL {
        // Definitions are substituted, ties are not: that would make one coordinate of them again.
        let suits = match task.further {
            // Rotations leave no multiplier.
            Further::Nothing => taste != Taste::Freedoms || task.multipliers.is_none(),
            Further::Velocities => !matches!(taste, Taste::Multipliers | Taste::Freedoms),
            Further::Copies => taste == Taste::Multipliers,
        };
        if !suits {
            continue;
        }
        match order(taste, pattern.clone(), task.names) {
            Ok(found) => {
                // Without a further pair multipliers are better solved for.
                let same = |(taste, known): &(Taste, Order)| match taste {
                    Taste::Multipliers => known.pairs() == found.pairs(),
                    _ => known.pivots == found.pivots,
                };
                if !orders.iter().any(same) {
                    orders.push((taste, found));
                }
            }
            Err(text) => drop(refusal.get_or_insert(text)),
        }
    }
    match refusal {
        Some(refusal) if orders.is_empty() => Err(refusal),
        _ => Ok(orders.into_iter().map(|(_, order)| order).collect()),
    }
}

/// A system after all steps.
struct Eliminated {
    factors: Vec<Factor>,
    /// What is divided by, with its step if it depends on the state.
    divisors: Vec<(Divisor, Option<usize>)>,
    /// Q and b.
    motion: Forward,
    /// Names of what is computed.
    hints: Vec<(Id, String)>,
}

/// Takes the steps of an order.
fn forward(
    task: &Task<'_>,
    scaled: &Scaled,
    order: &Order,
    g: &mut Graph,
) -> Result<Eliminated, String> {
    let (d, names) = (&scaled.dynamics, task.names);
    let droppable = order.alone(d.force.len(), task.redundant);
    let mut matrix = Matrix::new(d, task, &order.pivots, droppable, g);
    let mut motion = Forward::new(&d.force, &d.rhs);
    let (mut factors, mut divisors) = (Vec::new(), Vec::new());
    // What depends on parameters alone.
    let common = (scaled.common_factor != g.one()).then(|| {
        let position = d.mass.keys().next().map_or(0, |(i, _)| *i);
        Divisor::positive(position, scaled.common_factor, names)
    });
    let mut fixed: Vec<Divisor> = common.into_iter().collect();
    fixed.extend(task.turned.joints.iter().map(|joint| {
        let [value, reference] = joint.share;
        Divisor {
            reference,
            ..Divisor::positive(d.force.len() + joint.rows[0], value, names)
        }
    }));
    for step in &order.pivots {
        let (factor, checked) = matrix.step(*step, g)?;
        motion.step(&factor, g);
        match factor {
            Factor::Double(_) => fixed.extend(checked),
            _ => divisors.extend(checked.into_iter().map(|d| (d, Some(factors.len())))),
        }
        factors.push(factor);
    }
    fixed.extend(inertia(d, divisors.iter().map(|(d, _)| d), names, g));
    let fixed = fixed.into_iter().map(|divisor| (divisor, None));
    Ok(Eliminated {
        factors,
        divisors: fixed.chain(divisors).collect(),
        motion,
        hints: matrix.hints,
    })
}

/// Δ of least M-norm with A Δ = −residual, and what of it is solved for.
fn correction(
    task: &Task<'_>,
    scaled: &Scaled,
    factors: &[Factor],
    hints: &mut Vec<(Id, String)>,
    g: &mut Graph,
) -> Result<Solution, String> {
    let d = &scaled.dynamics;
    let residuals = (0..task.own.1).map(|i| g.symbol(Symbol::Residual(i)));
    let mut residuals: Vec<Id> = residuals.collect();
    residuals.resize(d.rhs.len(), g.zero());
    let mut pull = vec![g.zero(); d.force.len()];
    for (row, i, weight) in task.weights {
        let weight = g.div(*weight, scaled.common_factor);
        let term = g.mul(weight, residuals[*row]);
        pull[*i] = g.sub(pull[*i], term);
    }
    task.turned.turn(&mut residuals, g);
    let mut projection = Forward::new(&pull, &scaled.rows(-1.0, &residuals, g));
    factors.iter().for_each(|factor| projection.step(factor, g));
    let mut projection = projection.solution(factors, false, task.names, g, hints)?;
    projection.coordinates.truncate(task.own.0);
    task.turned.turn_back(&mut projection.coordinates, g);
    Ok(projection)
}

/// Eliminates in the given order; or says why the structure does not allow it.
pub fn eliminate(task: &Task<'_>, order: Order, g: &mut Graph) -> Result<Elimination, String> {
    let (turned, names, own) = (task.turned, task.names, task.own);
    let scaled = &Scaled::of(task.dynamics, g);
    let d = &scaled.dynamics;
    let Eliminated {
        factors,
        divisors,
        motion,
        mut hints,
    } = forward(task, scaled, &order, g)?;
    let all = task.multipliers.is_some();
    let mut motion = motion.solution(&factors, all, names, g, &mut hints)?;
    let droppings = droppings(&factors, &motion, d, g);
    let shares = match task.multipliers {
        Some(equations) if !droppings.is_empty() => {
            let squares = squares(equations, g);
            let kernel = kernel(&factors, d.force.len(), &scaled.scales, &squares, names, g)?;
            let kernel = scaled.multipliers(&kernel, g.one(), turned, g);
            shares(&kernel, &squares, g)
        }
        _ => vec![Some(g.zero()); own.1],
    };
    motion.coordinates.truncate(own.0);
    turned.turn_back(&mut motion.coordinates, g);
    let multipliers = match all {
        true => scaled.multipliers(&motion.constraints, scaled.common_factor, turned, g),
        false => Vec::new(),
    };
    let projection = correction(task, scaled, &factors, &mut hints, g)?;
    let right = |step: Option<usize>| step.and_then(|step| motion.rights[step]);
    let divisors = divisors.into_iter();
    let divisors = divisors.map(|(divisor, step)| (divisor, right(step)));
    let n = d.force.len();
    let alone = |pivot: &Pivoting| matches!(pivot, Pivoting::Single(k) if *k >= n);
    let solved = order.pivots.iter().any(alone);
    Ok(Elimination {
        divisors: divisors.collect(),
        acceleration: motion.coordinates,
        multipliers,
        correction: projection.coordinates,
        correction_rights: projection.rights.into_iter().flatten().collect(),
        droppings,
        shares,
        order,
        free: own.1 == 0 && !solved,
        solved,
        inertias: match solved {
            true => lasting_inertias(d, g),
            false => Vec::new(),
        },
        turned: turned.frames.iter().map(|frame| frame.row).collect(),
        place: place(d, own),
        hints,
    })
}

/// Inertia that depends on parameters and is no pivot by itself: it must not be negative, nor zero where M has more in its row.
fn inertia<'a>(
    d: &Dynamics,
    pivots: impl Iterator<Item = &'a Divisor>,
    names: &[String],
    g: &Graph,
) -> Vec<Divisor> {
    let pivots: BTreeSet<(usize, Id)> = pivots.map(|d| (d.position, d.value)).collect();
    let diagonal = d.mass.iter().filter(|((i, j), _)| i == j);
    let others = diagonal.filter(|((i, _), m)| !pivots.contains(&(*i, **m)));
    let others = others.filter(|(_, m)| g.uses(**m).constant() && g.as_const(**m).is_none());
    let shared = |i: usize| d.mass.keys().any(|(a, b)| a != b && (*a == i || *b == i));
    let others = others.map(|((i, _), m)| Divisor {
        may_vanish: !shared(*i),
        ..Divisor::positive(*i, *m, names)
    });
    others.collect()
}

/// The different entries on the diagonal of M that are numbers or depend on parameters alone.
fn lasting_inertias(d: &Dynamics, g: &Graph) -> Vec<Id> {
    let diagonal = d.mass.iter().filter(|((i, j), _)| i == j);
    let lasting = diagonal.filter(|(_, m)| g.uses(**m).constant() && !g.is_zero(**m));
    let lasting: BTreeSet<Id> = lasting.map(|(_, m)| *m).collect();
    lasting.into_iter().collect()
}

/// The place of each coordinate and constraint of `d` among those of the mechanism.
fn place(d: &Dynamics, (n, m): (usize, usize)) -> Vec<Option<usize>> {
    let coordinates = (0..d.force.len()).map(|i| (i < n).then_some(i));
    let constraints = (0..d.rhs.len()).map(|row| (row < m).then_some(n + row));
    coordinates.chain(constraints).collect()
}
