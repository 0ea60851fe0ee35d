//! Model to graph: loops unrolled, functions applied, vectors taken apart. This file walks the sections.

mod names;
mod system;
mod value;

pub(crate) use system::{Constraint, ConstraintRef, Kind, OutputValue, System};

use super::eval::{Point, eval};
use super::graph::{Graph, Id};
use crate::diag::{Diagnostics, Loc, suggest};
use crate::model::{Model, Name, Scope};
use crate::parse::{Block, Declaration, Equation, Expr, Function, Key, LetValue};
use proc_macro2::Ident;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Where an expression stands, which decides what it may use.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Const,
    Default,
    Let,
    Mass,
    Kinetic,
    Force,
    Potential,
    Holonomic,
    Nonholonomic,
    Nonideal,
    Output,
}

#[derive(Clone)]
enum Value {
    Scalar(Id),
    Vector(Vec<Id>),
    /// Something already reported: fits everywhere.
    Error,
}

enum Binding {
    Value(Value),
    Family(BTreeMap<i64, Value>),
    Function(Function),
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
        let indexed = item.index.is_some();
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
        active: Vec::new(),
        depth: 0,
        outermost: None,
        known_params: 0,
        hints: HashMap::new(),
        unknown: HashSet::new(),
        results: HashMap::new(),
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
    /// Functions being applied, against recursion.
    active: Vec<String>,
    /// Nesting of the expression being lowered.
    depth: usize,
    /// The application that all active ones are within.
    outermost: Option<Loc>,
    /// Parameters whose default is known: those a default may use.
    known_params: usize,
    hints: HashMap<Id, String>,
    /// Names and functions that were reported to be unknown.
    unknown: HashSet<String>,
    /// Names of constraints (true) and outputs (false).
    results: HashMap<String, bool>,
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
        self.lower_lets(decl, &top);

        let mut mass: BTreeMap<(usize, usize), (Vec<Id>, Loc)> = BTreeMap::new();
        if let Some(section) = &decl.mass {
            top.unroll(&section.blocks, self.diag, &mut |entry, scope| {
                let row = self.coordinate(&entry.key, scope);
                let column = entry.other.as_ref().map(|k| (self.coordinate(k, scope), k));
                let value = self.scalar(&entry.value, &Env::new(scope, Place::Mass));
                let (Some(row), column) = (row, column) else {
                    return;
                };
                let column = match column {
                    None => row,
                    Some((None, _)) => return,
                    Some((Some(c), k)) if c == row => {
                        self.diag.error(
                            k.loc,
                            format!("a diagonal entry of M is written `{}: …`", k.name),
                        );
                        return;
                    }
                    Some((Some(c), _)) => c,
                };
                let place = (row.max(column), row.min(column));
                let entries = mass.entry(place).or_insert((Vec::new(), entry.key.loc));
                entries.0.push(value);
            });
        }
        let mass = mass.into_iter();
        let mass = mass
            .map(|(at, (values, loc))| (at, (self.total_of(&values), loc)))
            .collect();
        if let (Some(_), Some(kinetic)) = (&decl.mass, &decl.kinetic) {
            self.diag.error(
                kinetic.keyword.span(),
                "`mass` and `kinetic` exclude each other: M follows from T; move the masses into `kinetic`",
            );
        }
        let kinetic = decl.kinetic.as_ref().map(|section| {
            let sum = self.terms_of(&section.blocks, &top, Place::Kinetic);
            (sum, section.keyword.span().into())
        });
        let potential = decl
            .potential
            .as_ref()
            .map(|section| self.terms_of(&section.blocks, &top, Place::Potential));
        let force = self.entries(&decl.force, &top, Place::Force);
        let nonideal = decl
            .nonideal
            .as_ref()
            .map(|s| self.entries(&s.blocks, &top, Place::Nonideal));
        let mut constraints = Vec::new();
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
        System {
            graph: std::mem::take(&mut self.graph),
            constants,
            defaults,
            mass,
            kinetic,
            force,
            potential,
            nonideal,
            constraints,
            outputs,
            hints: std::mem::take(&mut self.hints),
            inner_hints: HashMap::new(),
        }
    }

    /// Values of the `f64` constants.
    fn constants(&mut self, top: &Scope<'m>) -> Vec<f64> {
        let mut values = Vec::new();
        for constant in &self.model.floats {
            let env = Env::new(top, Place::Const);
            let (id, value) = self.evaluated(&constant.value, &env, &[], || {
                format!("constant `{}`", constant.name)
            });
            self.floats.push(id);
            values.push(value);
        }
        values
    }

    /// An expression of constants and of parameters with these values, and its own value; an error about `what` it is if that is not
    /// finite.
    fn evaluated(
        &mut self,
        expr: &Expr,
        env: &Env<'m>,
        params: &[f64],
        what: impl Fn() -> String,
    ) -> (Id, f64) {
        let before = self.diag.len();
        let id = self.scalar(expr, env);
        let point = Point {
            params,
            ..Point::NOWHERE
        };
        let value = eval(&self.graph, &[id], &point)[0];
        if !value.is_finite() && self.diag.len() == before {
            let message = format!("{} is not a finite number", what());
            self.diag.error(expr.loc, message);
        }
        (id, value)
    }

    fn defaults(&mut self) -> Vec<f64> {
        let mut defaults = Vec::new();
        for element in &self.model.param_elements {
            let mut value = f64::NAN;
            if let Some((expr, variables)) = &element.default {
                let scope = Scope::with(self.model, variables.clone());
                let env = Env::new(&scope, Place::Default);
                let what = || format!("default of `{}`", element.name);
                (_, value) = self.evaluated(expr, &env, &defaults, what);
            }
            defaults.push(value);
            self.known_params = defaults.len();
        }
        defaults
    }

    fn lower_lets(&mut self, decl: &Declaration, top: &Scope<'m>) {
        top.unroll(&decl.lets, self.diag, &mut |binding, scope| {
            let key = &binding.key;
            let name = key.name.to_string();
            let Ok(index) = self.index(key, scope) else {
                return;
            };
            let again = match (self.lets.get(&name), index) {
                (None, _) => false,
                (Some(Binding::Family(members)), Some(i)) => members.contains_key(&i),
                (Some(_), _) => true,
            };
            if let LetValue::Function(f) = &binding.value {
                let again = |k: &usize| f.args[..*k].contains(&f.args[*k]);
                if let Some(k) = (0..f.args.len()).find(again) {
                    let arg = &f.args[k];
                    self.diag.error(
                        arg.span(),
                        format!("argument `{arg}` is declared twice; names must be unique"),
                    );
                }
            }
            let taken = match self.model.free(&key.name) {
                Err(reason) => Some(reason),
                Ok(()) if again => {
                    Some(format!("`{name}` is declared twice; names must be unique"))
                }
                Ok(()) => None,
            };
            if let Some(reason) = taken {
                self.diag.error(key.loc, reason);
                return;
            }
            let bound = match (&binding.value, index) {
                (LetValue::Function(f), None) => Binding::Function(Function {
                    args: f.args.clone(),
                    body: f.body.clone(),
                }),
                (LetValue::Function(f), Some(_)) => {
                    self.diag.error(
                        f.body.loc,
                        "a function cannot be indexed; pass the index as an argument",
                    );
                    return;
                }
                (LetValue::Value(e), index) => {
                    let value = self.value(e, &Env::new(scope, Place::Let));
                    self.hint(&name, index, &value);
                    match index {
                        None => Binding::Value(value),
                        Some(i) => {
                            if let Some(Binding::Family(members)) = self.lets.get_mut(&name) {
                                members.insert(i, value);
                                return;
                            }
                            Binding::Family(BTreeMap::from([(i, value)]))
                        }
                    }
                }
            };
            self.lets.insert(name, bound);
        });
    }

    /// Remembers the modeller's name of a value, for emitted code and printed equations.
    fn hint(&mut self, name: &str, index: Option<i64>, value: &Value) {
        let name = index.map_or(name.to_owned(), |i| format!("{name}[{i}]"));
        let mut enter = |id: Id, name: String| {
            let (c, inner) = self.graph.unscaled(id);
            // The graph keeps coefficients apart: a name must not pass to a value without its coefficient.
            let (id, name) = match c {
                1.0 => (id, name),
                -1.0 => (inner, format!("neg_{name}")),
                _ => return,
            };
            if !self.graph.operands(id).is_empty() {
                self.hints.entry(id).or_insert(name);
            }
        };
        match value {
            Value::Scalar(id) => enter(*id, name),
            Value::Vector(ids) => {
                for (c, id) in ids.iter().enumerate() {
                    enter(*id, format!("{name}[{c}]"));
                }
            }
            Value::Error => {}
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

    /// Sum of the terms of `kinetic` or `potential`.
    fn terms_of(&mut self, blocks: &[Block<Expr>], top: &Scope<'m>, place: Place) -> Id {
        let mut terms = Vec::new();
        top.unroll(blocks, self.diag, &mut |e, scope| {
            terms.push((1.0, self.scalar(e, &Env::new(scope, place))));
        });
        self.graph.sum(&terms)
    }

    fn entries(
        &mut self,
        blocks: &[Block<crate::parse::Entry>],
        top: &Scope<'m>,
        place: Place,
    ) -> BTreeMap<usize, Id> {
        let mut out: BTreeMap<usize, Vec<Id>> = BTreeMap::new();
        top.unroll(blocks, self.diag, &mut |entry, scope| {
            let coordinate = self.coordinate(&entry.key, scope);
            let value = self.scalar(&entry.value, &Env::new(scope, place));
            if let Some(i) = coordinate {
                out.entry(i).or_default().push(value);
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
        let Ok(index) = self.index(key, scope) else {
            return;
        };
        let mut item = ConstraintRef {
            base: key.name.clone(),
            index,
            component: None,
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
        self.chain(&equation.rhs, -1.0, &env, &mut terms);
        let total = self.total(&terms, true);
        for (component, phi) in self.components(total) {
            item.component = component;
            out.push(Constraint {
                item: item.clone(),
                kind,
                phi,
                loc: key.loc,
            });
        }
    }

    /// The numbers that a value consists of, with their positions in a vector. The name of a faulty one stays declared, as zero: what uses
    /// it gives no second message.
    fn components(&mut self, value: Value) -> Vec<(Option<usize>, Id)> {
        match value {
            Value::Scalar(id) => vec![(None, id)],
            Value::Vector(ids) => (0..).map(Some).zip(ids).collect(),
            Value::Error => vec![(None, self.graph.zero())],
        }
    }

    fn outputs(&mut self, decl: &Declaration, top: &Scope<'m>) -> Vec<OutputValue> {
        let mut out: Vec<OutputValue> = Vec::new();
        let mut names = Names::default();
        top.unroll(&decl.outputs, self.diag, &mut |output, scope| {
            let key = &output.key;
            let Ok(index) = self.index(key, scope) else {
                return;
            };
            let mut item = ConstraintRef {
                base: key.name.clone(),
                index,
                component: None,
            };
            let looped = !scope.variables.is_empty();
            let free = self.model.column(&key.name);
            if let Err(reason) = free.and_then(|()| names.enter("output", &item, looped)) {
                self.diag.error(key.loc, reason);
                return;
            }
            let value = self.value(&output.value, &Env::new(scope, Place::Output));
            for (component, value) in self.components(value) {
                item.component = component;
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

    /// The index of `key`, if it has one.
    fn index(&self, key: &Key, scope: &Scope<'m>) -> Result<Option<i64>, ()> {
        let index = key.index.as_ref().map(|i| self.integer(i, scope).ok_or(()));
        index.transpose()
    }

    /// Position in q of the coordinate that `key` names.
    fn coordinate(&mut self, key: &Key, scope: &Scope<'m>) -> Option<usize> {
        let name = key.name.to_string();
        let Some(Name::Coord(family)) = self.model.names.get(&name) else {
            let coords = self
                .model
                .coords
                .iter()
                .map(|f| f.name.to_string())
                .collect::<Vec<_>>();
            let remedy = match coords.len() {
                0..=8 => format!("coordinates are `{}`", coords.join("`, `")),
                _ => "declare it under `coords`".to_owned(),
            };
            let end = suggest(&name, coords.iter().map(String::as_str), &remedy);
            self.diag.error(
                key.name.span(),
                format!("`{name}` is not a coordinate{end}"),
            );
            return None;
        };
        self.member(
            &key.name,
            key.index.as_ref(),
            &self.model.coords[*family],
            scope,
        )
    }

    /// Element of a family (or the scalar itself).
    fn member(
        &self,
        name: &Ident,
        index: Option<&Expr>,
        family: &crate::model::Family,
        scope: &Scope<'m>,
    ) -> Option<usize> {
        match (family.indexed, index) {
            (false, None) => family.members.first().copied(),
            (false, Some(i)) => {
                self.diag.error(
                    i.loc,
                    format!("`{name}` is not a family; write it without an index"),
                );
                None
            }
            (true, None) => {
                let last = family.members.len() - 1;
                self.diag.error(
                    name.span(),
                    format!(
                        "`{name}` is a family; choose a member, `{name}[0]` to `{name}[{last}]`"
                    ),
                );
                None
            }
            (true, Some(e)) => {
                let i = self.integer(e, scope)?;
                let found = usize::try_from(i).ok().and_then(|i| family.members.get(i));
                if found.is_none() {
                    let len = family.members.len();
                    self.diag.error(e.loc, format!("index {i} is out of range: `{name}` has {len} members, `{name}[0]` to `{name}[{}]`", len - 1));
                }
                found.copied()
            }
        }
    }

    fn integer(&self, e: &Expr, scope: &Scope<'m>) -> Option<i64> {
        scope.integer(e, self.diag)
    }
}
