//! Model to graph: loops unrolled, functions applied, vectors taken apart. This file walks the sections.

mod array;
mod bodies;
mod calls;
mod drawing;
mod inertia;
mod lets;
mod names;
mod parts;
mod starts;
mod system;
mod value;
mod vectors;

pub(crate) use system::{
    Constraint, ConstraintRef, Drawing, Kind, OutputValue, StartValue, System,
};
#[cfg(test)]
pub(crate) use vectors::vocabulary;

use super::graph::{Graph, Id, Symbol};
use crate::diag::{Diagnostics, Loc};
use crate::model::{Model, Scope, every};
use crate::parse::{Block, Declaration, Entry, Equation, Expr, ExprKind, Function, MassEntry};
use array::{Value, describe};
use bodies::Declared;
use drawing::Between;
use inertia::OfBodies;
use parts::{Acting, PARTS};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

/// Where an expression stands, which decides what it may use.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Const,
    Default,
    Let,
    Body,
    Gravity,
    Mass,
    Kinetic,
    Force,
    Potential,
    Holonomic,
    Nonholonomic,
    Nonideal,
    Output,
    Start,
}

enum Binding {
    Value(Value),
    /// By indices, as many for each member.
    Family(BTreeMap<Vec<i64>, Value>),
    Function(Rc<Function>),
}

/// Names of constraints or outputs declared so far.
#[derive(Default)]
struct Names {
    items: HashSet<String>,
    /// By base, whether it is indexed: `rod` and `rod[0]` are not both declared, so that `T::ROD` has one meaning.
    indexed: HashMap<String, bool>,
}

impl Names {
    /// Enters a name; the reason if it is taken. `what` it names and whether it is `looped` go into the reason.
    fn enter(&mut self, what: &str, item: &ConstraintRef, looped: bool) -> Result<(), String> {
        let (base, text) = (item.base.to_string(), item.text());
        let indexed = !item.indices.is_empty();
        if *self.indexed.entry(base.clone()).or_insert(indexed) != indexed {
            return Err(format!(
                "{what} `{base}` is declared both with and without an index; rename one"
            ));
        }
        if self.items.insert(text.clone()) {
            return Ok(());
        }
        Err(if looped && !indexed {
            format!("{what} `{base}` is declared twice; in a loop, index it: `{base}[i]`")
        } else {
            format!("{what} `{text}` is declared twice; names must be unique")
        })
    }
}

/// Lowers everything.
pub(crate) fn lower(decl: &Declaration, model: &Model, diag: &Diagnostics) -> System {
    let mut lowering = Lowering {
        model,
        diag,
        graph: Graph::default(),
        floats: Vec::new(),
        lets: HashMap::new(),
        unfinished: HashSet::new(),
        bodies: Vec::new(),
        written: false,
        active: Vec::new(),
        depth: 0,
        outermost: None,
        oversized: false,
        known_params: 0,
        hints: HashMap::new(),
        unknown: HashSet::new(),
        results: HashMap::new(),
        between: Vec::new(),
    };
    let results = &mut lowering.results;
    for block in decl.holonomic.iter().chain(&decl.nonholonomic) {
        block.each(&mut |c| results.extend([(c.key.name.to_string(), true)]));
    }
    for block in &decl.outputs {
        block.each(&mut |o| results.extend([(o.key.name.to_string(), false)]));
    }
    lowering.run(decl)
}

struct Lowering<'m> {
    model: &'m Model,
    diag: &'m Diagnostics,
    graph: Graph,
    floats: Vec<Id>,
    lets: HashMap<String, Binding>,
    /// Families of values to which the current block of `let` may still add.
    unfinished: HashSet<String>,
    /// By their place in [`Model::body_elements`]; nothing for those in error.
    bodies: Vec<Option<Declared>>,
    /// A text of this compiler's own is being lowered, in which functions have the meaning that they have here.
    written: bool,
    /// Functions being applied, against recursion.
    active: Vec<String>,
    /// Nesting of the expression being lowered.
    depth: usize,
    /// The application that all active ones are within.
    outermost: Option<Loc>,
    /// An array that is too long was reported.
    oversized: bool,
    /// Parameters whose default is known: those a default may use.
    known_params: usize,
    hints: HashMap<Id, String>,
    /// Names and functions that were reported to be unknown.
    unknown: HashSet<String>,
    /// Names of constraints (true) and outputs (false).
    results: HashMap<String, bool>,
    /// What joints and springs are between.
    between: Vec<Between>,
}

/// An expression's surroundings: loop variables, function arguments, section.
#[derive(Clone)]
struct Env<'m> {
    scope: Scope<'m>,
    args: Vec<(String, Value)>,
    place: Place,
}

impl<'m> Env<'m> {
    fn new(scope: &Scope<'m>, place: Place) -> Self {
        Env {
            scope: scope.clone(),
            args: Vec::new(),
            place,
        }
    }
}

impl<'m> Lowering<'m> {
    fn run(&mut self, decl: &Declaration) -> System {
        let top = Scope::new(self.model);
        let constants = self.constants(&top);
        let defaults = self.defaults();
        self.declare_bodies(decl, &top);
        self.lower_lets(decl, &top);

        let of_bodies = self.of_bodies(decl, &top, &defaults);
        let mut mass = self.mass(decl, &top);
        if let (Some(_), Some(kinetic)) = (&decl.mass, &decl.kinetic) {
            self.diag.error(
                kinetic.keyword.span(),
                "`mass` and `kinetic` exclude each other: M follows from T; move the masses into `kinetic`",
            );
        }
        let kinetic = self.kinetic(decl, &top, &of_bodies, &mut mass);
        let acting = self.acting(decl, &top);
        let mut terms = of_bodies.potential;
        terms.extend(&acting.potential);
        if let Some(section) = &decl.potential {
            terms.extend(self.terms_of(&section.blocks, &top, Place::Potential));
        }
        let potential =
            (decl.potential.is_some() || !terms.is_empty()).then(|| self.graph.sum(&terms));
        let mut force = self.entries(&decl.force, &top, Place::Force);
        for (i, values) in acting.force {
            let before = force.get(&i).copied().into_iter();
            let values: Vec<Id> = before.chain(values).collect();
            force.insert(i, self.total_of(&values));
        }
        let nonideal = decl
            .nonideal
            .as_ref()
            .map(|s| self.entries(&s.blocks, &top, Place::Nonideal));
        let mut constraints = of_bodies.units;
        let mut names = Names::default();
        for (blocks, kind) in [
            (&decl.holonomic, Kind::Holonomic),
            (&decl.nonholonomic, Kind::Nonholonomic),
        ] {
            top.unroll(blocks, self.diag, &mut |equation, scope| {
                self.equation(equation, kind, scope, &mut names, &mut constraints);
            });
        }
        let outputs = self.outputs(decl, &top);
        let starts = self.starts(decl, &top);
        let drawing = self.drawing(decl, &top);
        System {
            graph: std::mem::take(&mut self.graph),
            constants,
            defaults,
            mass,
            kinetic,
            force,
            potential,
            nonideal,
            inertias: of_bodies.inertias,
            constraints,
            outputs,
            starts,
            drawing,
            hints: std::mem::take(&mut self.hints),
            inner_hints: HashMap::new(),
        }
    }

    /// What several entries for one place add up to.
    fn total_of(&mut self, values: &[Id]) -> Id {
        let [first, rest @ ..] = values else {
            return self.graph.zero();
        };
        if rest.is_empty() {
            return *first;
        }
        let mut terms = self.graph.open(1.0, *first);
        terms.extend(rest.iter().map(|id| (1.0, *id)));
        self.graph.sum(&terms)
    }

    /// Terms of `kinetic`, `potential` or `dissipation`.
    fn terms_of(
        &mut self,
        blocks: &[Block<Expr>],
        top: &Scope<'m>,
        place: Place,
    ) -> Vec<(f64, Id)> {
        let mut terms = Vec::new();
        top.unroll(blocks, self.diag, &mut |e, scope| {
            terms.push((1.0, self.scalar(e, &Env::new(scope, place))));
        });
        terms
    }

    /// T, where it is declared or M depends on q. Else bodies add their masses to `mass`.
    fn kinetic(
        &mut self,
        decl: &Declaration,
        top: &Scope<'m>,
        of_bodies: &OfBodies,
        mass: &mut BTreeMap<(usize, usize), (Id, Loc)>,
    ) -> Option<(Id, Loc)> {
        for (i, own, loc) in &of_bodies.diagonal {
            let entry = mass.get(&(*i, *i)).map(|(m, _)| *m);
            let values: Vec<Id> = entry.into_iter().chain([*own]).collect();
            let total = self.total_of(&values);
            mass.entry((*i, *i)).or_insert((total, *loc)).0 = total;
        }
        let section = decl.kinetic.as_ref();
        let loc = section.map(|s| s.keyword.span().into());
        let loc = loc.or(of_bodies.spatial)?;
        let mut terms = of_bodies.turning.clone();
        for ((i, j), (m, declared)) in std::mem::take(mass) {
            let uses = self.graph.uses(m);
            if uses.coord || uses.time {
                let message = "beside spatial bodies a mass that changes goes under `kinetic`, as its part of the kinetic energy";
                self.diag.error(declared, message);
            }
            let v = [i, j].map(|k| self.graph.symbol(Symbol::Velocity(k)));
            let term = self.graph.product(&[(m, 1), (v[0], 1), (v[1], 1)]);
            terms.push((if i == j { 0.5 } else { 1.0 }, term));
        }
        if let Some(section) = section {
            terms.extend(self.terms_of(&section.blocks, top, Place::Kinetic));
        }
        Some((self.graph.sum(&terms), loc))
    }

    /// What `forces` and `dissipation` act with.
    fn acting(&mut self, decl: &Declaration, top: &Scope<'m>) -> Acting {
        let mut out = Acting::default();
        top.unroll(&decl.forces, self.diag, &mut |e, scope| {
            self.acts(e, &Env::new(scope, Place::Force), &mut out);
        });
        if let Some(section) = &decl.dissipation {
            for (_, id) in self.terms_of(&section.blocks, top, Place::Force) {
                let minus = self.graph.constant(-1.0);
                self.push(id, minus, &mut out);
            }
        }
        out
    }

    /// The lower triangle of M.
    fn mass(&mut self, decl: &Declaration, top: &Scope<'m>) -> BTreeMap<(usize, usize), (Id, Loc)> {
        let mut mass: BTreeMap<(usize, usize), (Vec<Id>, Loc)> = BTreeMap::new();
        if let Some(section) = &decl.mass {
            top.unroll(&section.blocks, self.diag, &mut |entry, scope| {
                for (place, value) in self.mass_entry(entry, scope) {
                    let entries = mass.entry(place).or_insert((Vec::new(), entry.key.loc));
                    entries.0.push(value);
                }
            });
        }
        let mass = mass.into_iter();
        mass.map(|(at, (values, loc))| (at, (self.total_of(&values), loc)))
            .collect()
    }

    /// Places in M with what is added there.
    fn mass_entry(&mut self, entry: &MassEntry, scope: &Scope<'m>) -> Vec<((usize, usize), Id)> {
        let env = Env::new(scope, Place::Mass);
        let Some(other) = &entry.other else {
            let coordinates = self.coordinates(&entry.key, scope);
            let value = self.value(&entry.value, &env);
            let Some((positions, shape)) = coordinates else {
                return Vec::new();
            };
            // One number is the mass of all members.
            let values = match value {
                Value::Scalar(id) => vec![id; positions.len()],
                _ => self.fitting(&value, shape, &entry.value),
            };
            let places = positions.iter().map(|i| (*i, *i));
            return places.zip(values).collect();
        };
        let (row, column) = (
            self.coordinate(&entry.key, scope),
            self.coordinate(other, scope),
        );
        let value = self.scalar(&entry.value, &env);
        let (Some(row), Some(column)) = (row, column) else {
            return Vec::new();
        };
        if row == column {
            let message = format!("a diagonal entry of M is written `{}: …`", other.name);
            self.diag.error(other.loc, message);
            return Vec::new();
        }
        vec![((row.max(column), row.min(column)), value)]
    }

    /// The numbers of `value`, if it has this `shape`, or is 0; reports it, if not.
    fn fitting(&mut self, value: &Value, shape: &[usize], e: &Expr) -> Vec<Id> {
        if let Value::Scalar(id) = value
            && self.graph.is_zero(*id)
        {
            return vec![*id; shape.iter().product()];
        }
        if !value.is_error() && value.shape() != shape {
            let (expected, found) = (describe(shape), describe(value.shape()));
            self.diag
                .error(e.loc, format!("expected {expected}, found {found}"));
            return Vec::new();
        }
        value.entries().to_vec()
    }

    fn entries(
        &mut self,
        blocks: &[Block<Entry>],
        top: &Scope<'m>,
        place: Place,
    ) -> BTreeMap<usize, Id> {
        let mut out: BTreeMap<usize, Vec<Id>> = BTreeMap::new();
        top.unroll(blocks, self.diag, &mut |entry, scope| {
            let coordinates = self.coordinates(&entry.key, scope);
            let value = self.value(&entry.value, &Env::new(scope, place));
            let Some((positions, shape)) = coordinates else {
                return;
            };
            if let (Value::Scalar(id), [_, ..]) = (&value, shape)
                && !self.graph.is_zero(*id)
            {
                let message = self.choose_a_member(&entry.key, shape);
                self.diag.error(entry.key.loc, message);
                return;
            }
            for (i, id) in positions
                .iter()
                .zip(self.fitting(&value, shape, &entry.value))
            {
                out.entry(*i).or_default().push(id);
            }
        });
        let out = out.into_iter();
        out.map(|(i, values)| (i, self.total_of(&values))).collect()
    }

    fn equation(
        &mut self,
        equation: &Equation,
        kind: Kind,
        scope: &Scope<'m>,
        names: &mut Names,
        out: &mut Vec<Constraint>,
    ) {
        let key = &equation.key;
        let Some(indices) = self.indices(&key.indices, scope) else {
            return;
        };
        let mut item = ConstraintRef {
            base: key.name.clone(),
            indices,
            components: Vec::new(),
            unit_of: None,
        };
        let reason = match self.model.free(&key.name) {
            Err(reason) => Some(reason),
            Ok(()) if self.lets.contains_key(&key.name.to_string()) => Some(format!(
                "`{}` is declared twice; names must be unique",
                key.name
            )),
            Ok(()) => names
                .enter("constraint", &item, !scope.variables.is_empty())
                .err(),
        };
        if let Some(reason) = reason {
            self.diag.error(key.loc, reason);
            return;
        }
        let place = match kind {
            Kind::Holonomic => Place::Holonomic,
            Kind::Nonholonomic => Place::Nonholonomic,
        };
        let env = Env::new(scope, place);
        let mut terms = Vec::new();
        self.chain(&equation.lhs, 1.0, &env, &mut terms);
        match &equation.rhs {
            Some(rhs) => self.chain(rhs, -1.0, &env, &mut terms),
            None if self.is_joint(&equation.lhs) => {}
            None => self
                .diag
                .error(equation.lhs.loc, "a constraint is an equation: `lhs = rhs`"),
        }
        let total = self.total(&terms, true);
        for (components, phi) in self.components(&total) {
            item.components = components;
            out.push(Constraint {
                item: item.clone(),
                kind,
                phi,
                loc: key.loc,
            });
        }
    }

    /// Whether `e` applies a joint, or a function of the declaration, which may be one.
    fn is_joint(&self, e: &Expr) -> bool {
        let ExprKind::Call(name, _) = &e.kind else {
            return matches!(e.kind, ExprKind::Error);
        };
        let joint = PARTS.iter().any(|part| name == part.name);
        joint || self.is_function(&name.to_string())
    }

    /// The numbers that a value consists of, with their indices in it. The name of a faulty one stays declared, as zero: what uses it gives
    /// no second message.
    fn components(&mut self, value: &Value) -> Vec<(Vec<usize>, Id)> {
        let numbers = match value {
            Value::Error => vec![self.graph.zero()],
            _ => value.entries().to_vec(),
        };
        every(value.shape()).zip(numbers).collect()
    }

    fn outputs(&mut self, decl: &Declaration, top: &Scope<'m>) -> Vec<OutputValue> {
        let mut out: Vec<OutputValue> = Vec::new();
        let mut names = Names::default();
        top.unroll(&decl.outputs, self.diag, &mut |output, scope| {
            let key = &output.key;
            let Some(indices) = self.indices(&key.indices, scope) else {
                return;
            };
            let mut item = ConstraintRef {
                base: key.name.clone(),
                indices,
                components: Vec::new(),
                unit_of: None,
            };
            let looped = !scope.variables.is_empty();
            let free = self.model.column(&key.name);
            if let Err(reason) = free.and_then(|()| names.enter("output", &item, looped)) {
                self.diag.error(key.loc, reason);
                return;
            }
            let value = self.value(&output.value, &Env::new(scope, Place::Output));
            for (components, value) in self.components(&value) {
                item.components = components;
                let text = item.text();
                let coordinates = &self.model.coord_elements;
                if coordinates.iter().any(|c| c.name == text) {
                    self.diag.error(
                        key.loc,
                        format!(
                            "`{text}` is a coordinate and in the output anyway; choose another name"
                        ),
                    );
                    return;
                }
                out.push(OutputValue {
                    item: item.clone(),
                    docs: output.docs.clone(),
                    value,
                });
            }
        });
        out
    }
}
