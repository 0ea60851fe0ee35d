//! Hoisting: what depends on parameters only is computed once for a set of them, not at each evaluation.
//!
//! Subexpressions of parameters become [`Symbol::Prepared`]. Products are split for that, and sums: of ½ ρ c S v |v| the part
//! ½ ρ c S is one prepared number, and a division by a parameter becomes a multiplication. Signs stay outside, so that a and −a are one
//! prepared number; so do numbers by which some of those that read a product multiply it, and others do not.

use super::dynamics::Dynamics;
use super::elimination::Straight;
use super::functions::{Function, Role};
use super::switches::Switch;
use crate::expr::{
    Graph, Id, Map, Node, Num, Probe, Random, Shake, Symbol, System, eval, eval_shaken,
};
use std::collections::BTreeMap;

/// States at which both forms of the equations are compared.
const STATES: usize = 2;

/// The equations as they are emitted.
pub(super) struct Hoisted {
    pub dynamics: Dynamics,
    pub outputs: Vec<Id>,
    /// What is integrated along with the motion.
    pub integrands: Vec<Id>,
    /// Numbers of the shapes that are drawn.
    pub drawing: Vec<Id>,
    /// Switching functions.
    pub switches: Vec<Id>,
    /// The solve, or why there is none.
    pub straight: Result<Straight, String>,
    /// Expressions of the prepared values, in parameters.
    pub values: Vec<Id>,
}

/// Hoists what depends on parameters only out of all equations.
pub(super) fn hoist(
    system: &mut System,
    dynamics: &Dynamics,
    straight: &Result<Straight, String>,
    switches: &[Switch],
) -> Hoisted {
    let mut dynamics = dynamics.clone();
    dynamics.lift = None;
    let mut straight = straight.clone();
    let mut outputs: Vec<Id> = system.outputs.iter().map(|o| o.value).collect();
    let mut integrands: Vec<Id> = system.integrals.iter().map(|o| o.value).collect();
    let shapes = system.drawing.shapes.iter();
    let mut drawing: Vec<Id> = shapes.flat_map(|shape| &shape.numbers).copied().collect();
    let mut switches: Vec<Id> = switches.iter().map(|s| s.function).collect();
    let mut places: Vec<&mut Id> = dynamics.values_mut().collect();
    let reported = outputs.iter_mut().chain(&mut integrands);
    places.extend(reported.chain(&mut switches));
    places.extend(&mut drawing);
    if let Ok(straight) = &mut straight {
        places.extend(straight.values_mut());
    }
    let roots: Vec<Id> = places.iter().map(|id| **id).collect();
    let mut pass = Pass::new(&mut system.graph, &roots);
    for (place, root) in places.into_iter().zip(&roots) {
        *place = pass.value(*root);
    }
    let (known, values) = (pass.known, pass.values);
    if let Ok(straight) = &mut straight {
        let g = &system.graph;
        let reached = |id: Id| known.contains_key(&id);
        let stages = straight
            .stages
            .iter()
            .flat_map(|id| g.open_products(*id, reached));
        straight.stages = stages.filter_map(|id| known.get(&id)).copied().collect();
        let exits = straight.exits.iter().filter_map(|id| known.get(id));
        straight.exits = exits.copied().collect();
    }
    system.carry_names(&known);
    Hoisted {
        dynamics,
        outputs,
        integrands,
        drawing,
        switches,
        straight,
        values,
    }
}

/// Factors with their exponents.
type Factors = Vec<(Id, i32)>;
/// Terms with their coefficients.
type Terms = Vec<(f64, Id)>;

/// What `id` reads, with the sizes of its coefficients.
fn read_by(g: &Graph, id: Id) -> Vec<(f64, Id)> {
    let of = |(k, id): &(Num, Id)| (k.get().abs(), *id);
    match g.node(id) {
        Node::Sum(_, terms) => terms.iter().map(of).collect(),
        Node::Scale(k, inner) => vec![of(&(*k, *inner))],
        _ => g.operands(id).into_iter().map(|id| (1.0, id)).collect(),
    }
}

/// How a node is read.
struct Read {
    times: usize,
    /// The size of the coefficient that all do with, where there is one.
    by: Option<f64>,
}

struct Pass<'g> {
    g: &'g mut Graph,
    /// New node of each old one that varies.
    known: Map<Id, Id>,
    /// How each old one is read.
    read: Map<Id, Read>,
    values: Vec<Id>,
    places: Map<Id, usize>,
}

impl<'g> Pass<'g> {
    fn new(g: &'g mut Graph, roots: &[Id]) -> Self {
        let order = g.reachable(roots);
        let mut read: Map<Id, Read> = Map::default();
        let readings = order.iter().flat_map(|id| read_by(g, *id));
        for (size, id) in readings.chain(roots.iter().map(|id| (1.0, *id))) {
            let by = Some(size);
            let known = read.entry(id).or_insert(Read { times: 0, by });
            known.times += 1;
            known.by = known.by.filter(|by| *by == size);
        }
        let mut pass = Pass {
            g,
            known: Map::default(),
            read,
            values: Vec::new(),
            places: Map::default(),
        };
        for id in order {
            if !pass.g.uses(id).constant() && !pass.is_scaled(id) {
                let new = pass.rewrite(id);
                pass.known.insert(id, new);
            }
        }
        pass
    }

    /// The new node of `id`: the prepared value if it depends on parameters only.
    fn value(&mut self, id: Id) -> Id {
        if self.g.as_const(id).is_some() {
            return id;
        }
        if !self.g.uses(id).constant() {
            return self.known[&id];
        }
        let (c, inner) = self.g.unscaled(id);
        let (sign, of) = if c == -1.0 { (c, inner) } else { (1.0, id) };
        let next = self.values.len();
        let place = *self.places.entry(of).or_insert(next);
        if place == next {
            self.values.push(of);
        }
        let symbol = self.g.symbol(Symbol::Prepared(place));
        self.g.scale(sign, symbol)
    }

    fn rewrite(&mut self, id: Id) -> Id {
        match self.g.node(id).clone() {
            Node::Const(_) | Node::Symbol(_) => id,
            Node::Sum(c, terms) => {
                let fixed = |(_, t): &(_, Id)| self.g.uses(*t).constant();
                let (fixed, varying): (Vec<_>, Vec<_>) = terms.iter().copied().partition(fixed);
                let mut out = Vec::with_capacity(terms.len());
                if fixed.is_empty() {
                    let one = self.g.one();
                    out.push((c.get(), one));
                } else {
                    let mut parts: Vec<(f64, Id)> =
                        fixed.iter().map(|(k, t)| (k.get(), *t)).collect();
                    parts.push((c.get(), self.g.one()));
                    let part = self.g.sum(&parts);
                    out.push((1.0, self.value(part)));
                }
                out.extend(self.terms(&varying));
                let sum = self.g.sum(&out);
                // One value for all that read it, whatever it has become.
                match self.read[&id].times {
                    1 => sum,
                    _ => self.g.hold_all(sum),
                }
            }
            Node::Scale(c, inner) => {
                let scaled = self.scaled(c.get().abs(), inner);
                self.g.scale(c.get().signum(), scaled)
            }
            Node::Product(factors) => self.product(1.0, &factors),
            Node::Call(..) | Node::Held(_) | Node::Select(_) => {
                let operands = self.g.operands(id);
                let values: Map<Id, Id> =
                    operands.into_iter().map(|o| (o, self.value(o))).collect();
                self.g.with_operands(id, |_, operand| values[&operand])
            }
        }
    }

    /// Terms of a sum that vary. Those with one number and one prepared factor are added up before these are multiplied by: p a + p b is
    /// p (a + b).
    fn terms(&mut self, varying: &[(Num, Id)]) -> Terms {
        let mut alike: BTreeMap<(u64, Factors), Terms> = BTreeMap::new();
        let mut out = Vec::with_capacity(varying.len());
        for (k, term) in varying {
            let (sign, size) = (k.get().signum(), k.get().abs());
            let once = self.read[term].times == 1;
            if !once && self.is_scaled(*term) {
                out.push((sign, self.scaled(size, *term)));
                continue;
            }
            let mut fixed = match self.g.node(*term) {
                Node::Product(factors) if once => factors.clone(),
                _ => Vec::new(),
            };
            fixed.retain(|(f, _)| self.g.uses(*f).constant());
            alike
                .entry((size.to_bits(), fixed))
                .or_default()
                .push((sign, *term));
        }
        for ((size, fixed), terms) in alike {
            let size = f64::from_bits(size);
            if terms.len() == 1 || (size == 1.0 && fixed.is_empty()) {
                out.extend(
                    terms
                        .into_iter()
                        .map(|(sign, term)| (sign, self.scaled(size, term))),
                );
                continue;
            }
            let rest = terms.into_iter().map(|(sign, term)| {
                let rest = match fixed[..] {
                    [] => self.value(term),
                    _ => {
                        let mut rest = self.g.factors(term);
                        rest.retain(|(f, _)| !self.g.uses(*f).constant());
                        self.product(1.0, &rest)
                    }
                };
                (sign, rest)
            });
            let rest: Vec<(f64, Id)> = rest.collect();
            let rest = self.g.sum(&rest);
            if fixed.is_empty() {
                out.push((size, rest));
                continue;
            }
            let part = self.g.product(&fixed);
            let part = self.g.scale(size, part);
            let part = self.value(part);
            out.push((1.0, self.g.mul(part, rest)));
        }
        out
    }

    /// Whether `id` is a product with a prepared part that all multiply by one number: only the product with that number is of use.
    fn is_scaled(&self, id: Id) -> bool {
        let fixed = |(f, _): &(Id, i32)| self.g.uses(*f).constant();
        matches!(self.g.node(id), Node::Product(factors) if factors.iter().any(fixed))
            && self.read[&id].by.is_some_and(|k| k != 1.0)
    }

    /// k · id, with k > 0 in the prepared part of a product that all multiply by it, or that nothing else reads.
    fn scaled(&mut self, k: f64, id: Id) -> Id {
        match self.g.node(id).clone() {
            Node::Product(factors)
                if k != 1.0 && (self.read[&id].times == 1 || self.is_scaled(id)) =>
            {
                self.product(k, &factors)
            }
            _ => {
                let value = self.value(id);
                self.g.scale(k, value)
            }
        }
    }

    fn product(&mut self, k: f64, factors: &[(Id, i32)]) -> Id {
        let fixed = |(f, _): &(Id, i32)| self.g.uses(*f).constant();
        let (fixed, varying): (Vec<_>, Vec<_>) = factors.iter().copied().partition(fixed);
        let mut out = Vec::with_capacity(varying.len() + 1);
        let mut k = k;
        if !fixed.is_empty() {
            let part = self.g.product(&fixed);
            let part = self.g.scale(k, part);
            out.push((self.value(part), 1));
            k = 1.0;
        }
        for (factor, exponent) in varying {
            out.push((self.value(factor), exponent));
        }
        let product = self.g.product(&out);
        self.g.scale(k, product)
    }
}

/// Whether both forms of the equations agree, checked in debug builds of the macro: the number of the first value that does not at any
/// state where it is well conditioned.
pub(super) fn verify(
    system: &System,
    dynamics: &Dynamics,
    straight: &Result<Straight, String>,
    hoisted: &Hoisted,
    functions: &[Function],
) -> Option<usize> {
    let g = &system.graph;
    let roots = |dynamics: &Dynamics, straight: &Result<Straight, String>| -> Vec<Id> {
        let (mut dynamics, mut straight) = (dynamics.clone(), straight.clone());
        dynamics.lift = None;
        let mut ids: Vec<Id> = dynamics.values_mut().map(|id| *id).collect();
        if let Ok(straight) = &mut straight {
            ids.extend(straight.values_mut().map(|id| *id));
        }
        ids
    };
    let mut before = roots(dynamics, straight);
    let mut after = roots(&hoisted.dynamics, &hoisted.straight);
    // What is solved for once more, as it is computed in the end.
    if let Ok(straight) = straight {
        let solved = &straight.elimination;
        for function in functions {
            let (values, safe) = match function.role {
                Role::Acceleration => (&solved.acceleration, straight.met_too),
                Role::Correction => (&solved.correction, straight.certificate),
                _ => continue,
            };
            before.extend(values.iter().chain([&safe]));
            after.extend(function.roots.iter().map(|(_, id)| *id));
        }
    }
    let mut random = Random::new(12);
    let mut suspects: Option<Vec<bool>> = None;
    for _ in 0..STATES {
        let (n, m) = (dynamics.force.len(), dynamics.rhs.len());
        let probe = Probe::positive(&system.defaults, n, m, &mut random);
        let prepared = eval(g, &hoisted.values, &probe.point());
        let known = Shake::bounds(|shake| {
            eval_shaken(g, &before, &probe.point(), &mut |x| shake.change(x))
        });
        let found = eval(g, &after, &probe.with(&prepared));
        let size = known.iter().map(|(x, _)| x.abs());
        let size = size.filter(|x| x.is_finite()).fold(1.0, f64::max);
        // A wrong factor is off by far more; what rounding leaves no digits of is not compared.
        let differs = |((a, rounding), b): (&(f64, f64), &f64)| {
            let vague = *rounding > 1e-3 * a.abs();
            let bound = (1e-9 * size.min(1.0 + a.abs())).max(*rounding);
            a.is_finite() && !vague && (a - b).abs() > bound
        };
        let differs = known.iter().zip(&found).map(differs);
        suspects = Some(match suspects {
            None => differs.collect(),
            Some(known) => known.iter().zip(differs).map(|(a, b)| *a && b).collect(),
        });
    }
    suspects?.iter().position(|wrong| *wrong)
}
