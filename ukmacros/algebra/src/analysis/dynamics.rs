//! M, Q, A, b from what was declared.

use super::cost::cost;
use super::lift::{Lift, lift};
use crate::expr::{Adjoint, Constraint, Derivative, Gradient, Graph, Id, Kind, Symbol, System};
use std::collections::BTreeMap;

/// The equations of motion as nodes. Notation as in Zhao, Zhen & Chen 2013.
#[derive(Clone)]
pub struct Dynamics {
    /// Lower triangle of M (row ≥ column), structural non-zeros.
    pub mass: BTreeMap<(usize, usize), Id>,
    /// Q, per coordinate.
    pub force: Vec<Id>,
    /// c, per coordinate.
    pub nonideal: Vec<Id>,
    /// A (constraint, coordinate), structural non-zeros.
    pub jacobian: BTreeMap<(usize, usize), Id>,
    /// b, per constraint.
    pub rhs: Vec<Id>,
    /// φ, per holonomic constraint.
    pub phi: Vec<Id>,
    /// φ̇ of holonomic constraints, φ of nonholonomic ones.
    pub rate: Vec<Id>,
    /// T.
    pub kinetic: Id,
    /// V, 0 where none is declared.
    pub potential: Id,
    /// T in the velocities it is written in, if it is.
    pub lift: Option<Lift>,
}

impl Dynamics {
    /// The entries of a row of A, by coordinate.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, Id)> {
        let entries = self.jacobian.range((row, 0)..(row + 1, 0));
        entries.map(|((_, i), a)| (*i, *a))
    }

    /// Adds `more` coordinates and as many constraints, with `zero` in all of their equations.
    pub(super) fn widen(&mut self, more: usize, zero: Id) {
        for vector in [&mut self.force, &mut self.nonideal, &mut self.rhs] {
            vector.resize(vector.len() + more, zero);
        }
    }

    /// All values, in a fixed order.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut Id> {
        let (equations, energies) = self.parts_mut();
        equations.chain(energies)
    }

    /// All values but the energies, in a fixed order.
    pub fn equations_mut(&mut self) -> impl Iterator<Item = &mut Id> {
        self.parts_mut().0
    }

    fn parts_mut(&mut self) -> (impl Iterator<Item = &mut Id>, [&mut Id; 2]) {
        let matrices = self.mass.values_mut().chain(self.jacobian.values_mut());
        let vectors = self.force.iter_mut().chain(&mut self.nonideal);
        let constraints = self
            .rhs
            .iter_mut()
            .chain(&mut self.phi)
            .chain(&mut self.rate);
        let energies = [&mut self.kinetic, &mut self.potential];
        let lift = self.lift.iter_mut().flat_map(Lift::values_mut);
        (
            matrices.chain(vectors).chain(constraints).chain(lift),
            energies,
        )
    }
}

/// Derives the equations of motion of a system with `n` coordinates.
pub fn derive(system: &mut System, n: usize) -> Dynamics {
    let g = &mut system.graph;
    let zero = g.zero();
    let mut force = vec![zero; n];
    for (i, f) in &system.force {
        force[*i] = *f;
    }
    let potential = system.potential.unwrap_or(zero);
    let declared = system.mass.iter().map(|(at, (m, _))| (*at, *m));
    let mut mass: BTreeMap<(usize, usize), Id> = declared.collect();
    mass.retain(|_, m| !g.is_zero(*m));
    let mut lifted = None;
    let kinetic = match system.kinetic {
        Some((t, _)) => {
            // What is not taken leaves no trace: the order of nodes is that of terms.
            let mut with = g.clone();
            lifted = lift(t, &mut with);
            if lifted.is_some() {
                *g = with;
            }
            // Of large systems the direct form is not even looked at: it grows as the third power.
            let direct = (lifted.is_none() || n <= MANY).then(|| lagrange(t, &force, g));
            let slopes = slopes(potential, n, g);
            let direct = direct.map(|(mass, force)| (mass, less(&force, &slopes, g)));
            let own = lifted.as_mut().map(|lift| {
                lift.applied = less(&force, &slopes, g);
                (lift.mass(g), lift.generalised(n, g))
            });
            (mass, force) = cheaper(own, direct, g);
            t
        }
        None => {
            let kinetic = half_square(&mass, g);
            let slopes = slopes(potential, n, g);
            force = less(&force, &slopes, g);
            kinetic
        }
    };
    let mut nonideal = vec![zero; n];
    for (i, c) in system.nonideal.iter().flatten() {
        nonideal[*i] = *c;
    }
    let mut dynamics = Dynamics {
        mass,
        force,
        nonideal,
        jacobian: BTreeMap::new(),
        rhs: Vec::new(),
        phi: Vec::new(),
        rate: Vec::new(),
        kinetic,
        potential,
        lift: lifted,
    };
    dynamics.constrain(&system.constraints, g);
    dynamics
}

impl Dynamics {
    /// Derives φ̇, A and b.
    fn constrain(&mut self, constraints: &[Constraint], g: &mut Graph) {
        let mut total = Derivative::total();
        let mut partials: BTreeMap<Symbol, Derivative> = BTreeMap::new();
        for (row, constraint) in constraints.iter().enumerate() {
            let velocity_level = match constraint.kind {
                Kind::Holonomic => {
                    self.phi.push(constraint.phi);
                    total.of(constraint.phi, g)
                }
                Kind::Nonholonomic => constraint.phi,
            };
            self.rate.push(velocity_level);
            let gradient = Gradient::of(constraint.phi, g);
            for symbol in gradient.symbols() {
                let ((Kind::Holonomic, Symbol::Coord(i))
                | (Kind::Nonholonomic, Symbol::Velocity(i))) = (constraint.kind, symbol)
                else {
                    continue;
                };
                let partial = partials.entry(symbol);
                let partial = partial.or_insert_with(|| Derivative::partial(symbol));
                let entry = gradient.by(partial, g);
                if !g.is_zero(entry) {
                    self.jacobian.insert((row, i), entry);
                }
            }
            // d/dt of the velocity level is A q̈ + (its value at q̈ = 0), so b is minus the latter.
            let at_rest = total.of(velocity_level, g);
            self.rhs.push(g.neg(at_rest));
        }
    }
}

/// Above so many coordinates only ways whose cost grows in proportion to the declaration are tried.
const MANY: usize = 8;

/// Entry by entry a − b.
fn less(a: &[Id], b: &[Id], g: &mut Graph) -> Vec<Id> {
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| subtract(*a, *b, g)).collect()
}

/// ∂V/∂q: by one sweep from V down, or coordinate by coordinate, whichever costs less.
fn slopes(potential: Id, n: usize, g: &mut Graph) -> Vec<Id> {
    let zero = g.zero();
    let swept = |g: &mut Graph| -> Vec<Id> {
        let adjoint = Adjoint::of(potential, g);
        let slopes = (0..n).map(|i| adjoint.along(Symbol::Coord(i)));
        slopes.map(|slope| slope.unwrap_or(zero)).collect()
    };
    if n > MANY {
        return swept(g);
    }
    // What is not taken leaves no trace: the order of nodes is that of terms.
    let mut other = g.clone();
    let swept = swept(&mut other);
    let gradient = Gradient::of(potential, g);
    let direct = (0..n).map(|i| gradient.along(Symbol::Coord(i), g));
    let direct: Vec<Id> = direct.collect();
    if cost(&other, &swept).work() < cost(g, &direct).work() {
        *g = other;
        return swept;
    }
    direct
}

/// M and Q.
type Equations = (BTreeMap<(usize, usize), Id>, Vec<Id>);

/// The form of M and Q that costs less; the second where both cost the same.
fn cheaper(one: Option<Equations>, other: Option<Equations>, g: &Graph) -> Equations {
    let work = |(mass, force): &Equations| {
        let all: Vec<Id> = mass.values().chain(force).copied().collect();
        cost(g, &all).work()
    };
    match (one, other) {
        (Some(one), Some(other)) if work(&one) < work(&other) => one,
        (_, Some(other)) => other,
        (one, None) => one.unwrap_or_default(),
    }
}

/// Lagrange's equations d/dt(∂T/∂q̇) − ∂T/∂q = Q for the declared Q: M = ∂²T/∂q̇², and the rest of the left side goes into Q.
fn lagrange(t: Id, declared: &[Id], g: &mut Graph) -> Equations {
    let (mut mass, mut forces) = (BTreeMap::new(), Vec::with_capacity(declared.len()));
    let mut total = Derivative::total();
    let energy = Gradient::of(t, g);
    for (i, force) in declared.iter().enumerate() {
        let momentum = energy.along(Symbol::Velocity(i), g);
        let inertia = Gradient::of(momentum, g);
        for symbol in inertia.symbols() {
            if let Symbol::Velocity(j) = symbol
                && j <= i
            {
                let entry = inertia.along(symbol, g);
                if !g.is_zero(entry) {
                    mass.insert((i, j), entry);
                }
            }
        }
        let transport = total.of(momentum, g);
        let slope = energy.along(Symbol::Coord(i), g);
        let mut terms = g.open(1.0, *force);
        terms.extend(g.open(-1.0, transport));
        terms.extend(g.open(1.0, slope));
        forces.push(g.sum(&terms));
    }
    (mass, forces)
}

/// a − b as one sum.
fn subtract(a: Id, b: Id, g: &mut Graph) -> Id {
    if g.is_zero(b) {
        return a;
    }
    let mut terms = g.open(1.0, a);
    terms.extend(g.open(-1.0, b));
    g.sum(&terms)
}

/// ½ q̇ᵀ M q̇.
fn half_square(mass: &BTreeMap<(usize, usize), Id>, g: &mut Graph) -> Id {
    let mut terms = Vec::new();
    for ((i, j), m) in mass {
        let (vi, vj) = (
            g.symbol(Symbol::Velocity(*i)),
            g.symbol(Symbol::Velocity(*j)),
        );
        let term = g.product(&[(*m, 1), (vi, 1), (vj, 1)]);
        terms.push((if i == j { 0.5 } else { 1.0 }, term));
    }
    g.sum(&terms)
}
