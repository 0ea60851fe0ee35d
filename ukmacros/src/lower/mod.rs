//! Model to graph: loops unrolled, functions applied, vectors taken apart. This file walks the sections.

mod always;
mod array;
mod bodies;
mod calls;
mod constraints;
mod drawing;
mod expect;
mod inertia;
mod keys;
mod lets;
mod names;
mod outputs;
mod parts;
mod reactions;
mod starts;
mod tree;
mod units;
mod value;
mod vectors;

pub(crate) use units::units;
#[cfg(test)]
pub(crate) use vectors::vocabulary;

use crate::diag::{Diagnostics, Loc};
use crate::model::{LOADS, Model, Scope, uses};
use crate::parse::{Applied, Block, Declaration, Entry, Expr, Function, MassEntry};
use array::Value;
use bodies::Declared;
use constraints::Names;
use drawing::Between;
use inertia::OfBodies;
use parts::Acting;
use reactions::Known;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;
use ukalgebra::expr::{Constraint, Drawing, Graph, Id, Kind, Map, ShapeValue, Symbol, System};
use ukunits::Dimension;
use units::{Dimensions, Measured};

/// The place where an expression stands, which decides what it may use.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Const,
    /// How long a start lasts.
    Until,
    /// The default of an option of a start.
    Choice,
    Default,
    Let,
    Body,
    Joint,
    Given,
    Gravity,
    Mass,
    Kinetic,
    Force,
    Potential,
    Holonomic,
    Nonholonomic,
    Nonideal,
    Output,
    Integral,
    Start,
}

/// What has a name that is no value.
#[derive(Clone, Copy, PartialEq)]
enum NoValue {
    Constraint,
    Output,
    Integral,
}

enum Binding {
    Value(Value),
    /// The members by their indices, as many for each.
    Family(BTreeMap<Vec<i64>, Value>),
    Function(Rc<Function>),
}

/// Lowers everything.
pub(crate) fn lower(decl: &Declaration, model: &Model, diag: &Diagnostics) -> System {
    lower_with(decl, model, diag, None).0
}

/// Lowers everything, with a look at `dimensions` where they are given.
fn lower_with<'m>(
    decl: &Declaration,
    model: &'m Model,
    diag: &'m Diagnostics,
    dimensions: Option<Dimensions<'m>>,
) -> (System, Option<Dimensions<'m>>) {
    let mut lowering = Lowering {
        model,
        diag,
        graph: Graph::default(),
        floats: Vec::new(),
        lets: HashMap::new(),
        unfinished: HashSet::new(),
        bodies: Vec::new(),
        pending: Vec::new(),
        written: false,
        active: Vec::new(),
        depth: 0,
        outermost: None,
        oversized: false,
        defaults: Vec::new(),
        hints: Map::default(),
        unknown: model.lost.clone(),
        results: HashMap::new(),
        constraints: Vec::new(),
        left_out: Vec::new(),
        constrained: false,
        known: HashMap::new(),
        reaction_used: None,
        between: Vec::new(),
        rims: Vec::new(),
        dimensions,
    };
    let results = &mut lowering.results;
    for block in decl.holonomic.iter().chain(&decl.nonholonomic) {
        block.each(&mut |c| results.extend([(c.key.name.to_string(), NoValue::Constraint)]));
    }
    for (blocks, result) in [
        (&decl.outputs, NoValue::Output),
        (&decl.integrals, NoValue::Integral),
    ] {
        let blocks = blocks.iter();
        blocks.for_each(|b| b.each(&mut |o| results.extend([(o.key.name.to_string(), result)])));
    }
    (lowering.run(decl), lowering.dimensions)
}

struct Lowering<'m> {
    model: &'m Model,
    diag: &'m Diagnostics,
    graph: Graph,
    floats: Vec<Id>,
    lets: HashMap<String, Binding>,
    /// Families of values to which the current block of `let` may still add.
    unfinished: HashSet<String>,
    /// The bodies by their place in [`Model::body_elements`]; nothing for those in error.
    bodies: Vec<Option<Declared>>,
    /// The positions of those whose frames are being made.
    pending: Vec<usize>,
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
    /// Defaults of the parameters that have theirs: those a default may use.
    defaults: Vec<f64>,
    hints: Map<Id, String>,
    /// Names and functions that were reported to be unknown.
    unknown: HashSet<String>,
    /// Names of constraints, outputs and integrals.
    results: HashMap<String, NoValue>,
    constraints: Vec<Constraint>,
    /// Rows that always hold, and so are none of the constraints.
    left_out: Vec<String>,
    /// Whether all constraints are there.
    constrained: bool,
    /// Constraints by their names, without those of rows.
    known: HashMap<String, Known>,
    /// The place where the first reaction is used.
    reaction_used: Option<Loc>,
    /// What joints and springs are between.
    between: Vec<Between>,
    /// Rims of what rolls.
    rims: Vec<ShapeValue>,
    /// Dimensions, where it is these that are looked at.
    dimensions: Option<Dimensions<'m>>,
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
        let declared = |section: &str| decl.sections.contains_key(section);
        let constants = self.constants(&top);
        self.enter_defaults();
        self.declare_bodies(decl, &top);
        self.lower_lets(decl, &top);

        let of_bodies = self.of_bodies(decl, &top);
        let mut mass = self.mass(decl, &top);
        let kinetic = self.kinetic(decl, &top, &of_bodies, &mut mass);
        let (potential, force) = self.forces(decl, &top, of_bodies.potential);
        // Behind the constraints if it may use their reactions.
        let late = LOADS.iter().any(|name| uses(decl, name));
        let nonideal = |lowering: &mut Self| {
            declared("nonideal").then(|| lowering.applied(&decl.nonideal, &top))
        };
        let early = (!late).then(|| nonideal(self));
        self.constraints = of_bodies.units;
        let mut names = Names::default();
        for (blocks, kind) in [
            (&decl.holonomic, Kind::Holonomic),
            (&decl.nonholonomic, Kind::Nonholonomic),
        ] {
            top.unroll(blocks, self.diag, &mut |equation, scope| {
                self.equation(equation, kind, scope, &mut names);
            });
        }
        // Where dimensions are looked at numbers have no values, and all rows stay.
        if self.diag.is_empty() && self.dimensions.is_none() {
            self.leave_out_what_always_holds();
        }
        self.constrained = true;
        let nonideal = early.unwrap_or_else(|| nonideal(self));
        let mut names = Names::default();
        let outputs = self.reported(&decl.outputs, NoValue::Output, &top, &mut names);
        let integrals = self.reported(&decl.integrals, NoValue::Integral, &top, &mut names);
        let starts = self.starts(decl, &top);
        // A picture may have sizes of its own.
        let drawing = match &self.dimensions {
            None => self.drawing(decl, &top),
            Some(_) => Drawing::default(),
        };
        System {
            graph: std::mem::take(&mut self.graph),
            constants,
            defaults: std::mem::take(&mut self.defaults),
            units: Vec::new(),
            efforts: Vec::new(),
            mass,
            kinetic,
            force,
            potential,
            nonideal,
            inertias: of_bodies.inertias,
            constraints: std::mem::take(&mut self.constraints),
            left_out: std::mem::take(&mut self.left_out),
            outputs,
            integrals,
            reaction: self.reaction_used,
            unique: Vec::new(),
            starts,
            drawing,
            hints: std::mem::take(&mut self.hints),
            inner_hints: Map::default(),
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
            let id = self.scalar(e, &Env::new(scope, place));
            let (dimension, what) = match place {
                Place::Force => (Dimension::POWER, "a dissipated power"),
                _ => (Dimension::ENERGY, "an energy"),
            };
            self.expect(id, Measured::of(dimension), what, e.loc);
            // A forgotten sign would change what is meant without a word.
            if self.graph.uses(id).constant()
                && let Some(next) = self.diag.next_to(e.loc)
            {
                let message = "`*` is missing before this, or `,` if it is a term of its own";
                self.diag.error(next, message);
            }
            terms.push((1.0, id));
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
        let keyword = decl.sections.get("kinetic");
        // Parts may have either.
        if let (true, Some(keyword)) = (decl.sections.contains_key("mass"), keyword)
            && self.model.part_families.is_empty()
        {
            let message = "`mass` and `kinetic` exclude each other: M follows from T; move the masses into `kinetic`";
            self.diag.error(keyword.span(), message);
        }
        for (i, own, loc) in &of_bodies.diagonal {
            let entry = mass.get(&(*i, *i)).map(|(m, _)| *m);
            let values: Vec<Id> = entry.into_iter().chain([*own]).collect();
            let total = self.total_of(&values);
            mass.entry((*i, *i)).or_insert((total, *loc)).0 = total;
        }
        let loc = keyword.map(|keyword| keyword.span().into());
        let loc = loc.or(of_bodies.changing)?;
        let mut terms = of_bodies.turning.clone();
        for ((i, j), (m, declared)) in std::mem::take(mass) {
            let uses = self.graph.uses(m);
            if uses.coord || uses.time {
                let message = "beside spatial bodies and those of a tree a mass that changes goes under `kinetic`, as its part of the kinetic energy";
                self.diag.error(declared, message);
            }
            let v = [i, j].map(|k| self.graph.symbol(Symbol::Velocity(k)));
            let term = self.graph.product(&[(m, 1), (v[0], 1), (v[1], 1)]);
            terms.push((if i == j { 0.5 } else { 1.0 }, term));
        }
        terms.extend(self.terms_of(&decl.kinetic, top, Place::Kinetic));
        Some((self.graph.sum(&terms), loc))
    }

    /// V, of which bodies have some `terms`, if there is any, and Q by coordinate.
    fn forces(
        &mut self,
        decl: &Declaration,
        top: &Scope<'m>,
        mut terms: Vec<(f64, Id)>,
    ) -> (Option<Id>, BTreeMap<usize, Id>) {
        let acting = self.acting(decl, top);
        terms.extend(&acting.potential);
        terms.extend(self.terms_of(&decl.potential, top, Place::Potential));
        let declared = decl.sections.contains_key("potential");
        let potential = (declared || !terms.is_empty()).then(|| self.graph.sum(&terms));
        let mut force = BTreeMap::new();
        top.unroll(&decl.force, self.diag, &mut |entry, scope| {
            self.entry(entry, &Env::new(scope, Place::Force), &mut force);
        });
        for (i, values) in acting.force {
            force.entry(i).or_default().extend(values);
        }
        (potential, self.totals(force))
    }

    /// What `forces` and `dissipation` act with.
    fn acting(&mut self, decl: &Declaration, top: &Scope<'m>) -> Acting {
        let mut out = Acting::default();
        top.unroll(&decl.forces, self.diag, &mut |e, scope| {
            self.acts(e, &Env::new(scope, Place::Force), &mut out);
        });
        for (_, id) in self.terms_of(&decl.dissipation, top, Place::Force) {
            let minus = self.graph.constant(-1.0);
            self.push(id, minus, &mut out);
        }
        out
    }

    /// The lower triangle of M.
    fn mass(&mut self, decl: &Declaration, top: &Scope<'m>) -> BTreeMap<(usize, usize), (Id, Loc)> {
        /// What is said of a place in M: its values, where it stands first, and row and column as written there.
        type Said = (Vec<Id>, Loc, (usize, usize));
        let mut mass: BTreeMap<(usize, usize), Said> = BTreeMap::new();
        top.unroll(&decl.mass, self.diag, &mut |entry, scope| {
            for ((row, column), value) in self.mass_entry(entry, scope) {
                let place = (row.max(column), row.min(column));
                let first = || (Vec::new(), entry.key.loc, (row, column));
                let said = mass.entry(place).or_insert_with(first);
                if said.2 == (row, column) {
                    said.0.push(value);
                } else {
                    // A symmetric M written in full: its sum would be twice what is meant.
                    let [x, y] = [row, column].map(|i| &self.model.coord_elements[i].name);
                    let message = format!(
                        "`({x}, {y})` is the entry that stands as `({y}, {x})` already, which sets both M[{x}, {y}] and M[{y}, {x}]; write it once, twice as large where two couplings are meant, as those of a ring of two"
                    );
                    let end = entry.other.as_ref().map_or(entry.key.loc, |other| other.loc);
                    self.diag.error(entry.key.loc.to(end), message);
                }
            }
        });
        let mass = mass.into_iter();
        mass.map(|(at, (values, loc, _))| (at, (self.total_of(&values), loc)))
            .collect()
    }

    /// Rows and columns of M, as they are written, with what is added there.
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
            let entries: Vec<((usize, usize), Id)> = places.zip(values).collect();
            for (place, id) in &entries {
                self.expect_mass(*place, *id, entry.value.loc);
            }
            return entries;
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
        self.expect_mass((row, column), value, entry.value.loc);
        vec![((row, column), value)]
    }

    /// The numbers of `value`, if it has this `shape`, or is 0; reports it, if not.
    fn fitting(&mut self, value: &Value, shape: &[usize], e: &Expr) -> Vec<Id> {
        if let Value::Scalar(id) = value
            && self.graph.is_zero(*id)
        {
            return vec![*id; shape.iter().product()];
        }
        self.of_shape(value, shape, e.loc).unwrap_or_default()
    }

    /// c, by coordinate.
    fn applied(&mut self, blocks: &[Block<Applied>], top: &Scope<'m>) -> BTreeMap<usize, Id> {
        let mut out = Acting::default();
        top.unroll(blocks, self.diag, &mut |applied, scope| {
            let env = Env::new(scope, Place::Nonideal);
            match applied {
                Applied::To(entry) => self.entry(entry, &env, &mut out.force),
                Applied::By(e) => self.acts(e, &env, &mut out),
            }
        });
        self.totals(out.force)
    }

    /// What the forces on each coordinate add up to.
    fn totals(&mut self, forces: BTreeMap<usize, Vec<Id>>) -> BTreeMap<usize, Id> {
        let forces = forces.into_iter();
        forces
            .map(|(i, values)| (i, self.total_of(&values)))
            .collect()
    }

    /// Enters what is said of one coordinate, or of a vector of them.
    fn entry(&mut self, entry: &Entry, env: &Env<'m>, force: &mut BTreeMap<usize, Vec<Id>>) {
        let coordinates = self.coordinates(&entry.key, &env.scope);
        let value = self.value(&entry.value, env);
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
        let values = self.fitting(&value, shape, &entry.value);
        for (i, id) in positions.iter().zip(values) {
            let measured = Measured::of(Dimension::ENERGY).per(self.of_coordinate(*i));
            let loc = entry.value.loc;
            self.expect(id, measured, "the force on this coordinate", loc);
            force.entry(*i).or_default().push(id);
        }
    }
}
