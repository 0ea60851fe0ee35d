//! Model to graph: loops unrolled, functions applied, vectors taken apart.

use super::diff::Derivative;
use super::eval::{Point, eval};
use super::graph::{Func, Graph, Id, Symbol};
use crate::diag::{Diagnostics, Loc, suggest};
use crate::model::{Model, Name, Scope};
use crate::parse::{
    BinaryOp, Block, Declaration, Equation, Expr, ExprKind, Function, Key, LetValue,
};
use proc_macro2::Ident;
use std::collections::{BTreeMap, HashMap, HashSet};

/// The equations of a declaration as a graph.
pub(crate) struct System {
    pub(crate) graph: Graph,
    /// Default of each parameter.
    pub(crate) defaults: Vec<f64>,
    /// Lower triangle (row ≥ column) of the declared M, with where it was declared first.
    pub(crate) mass: BTreeMap<(usize, usize), (Id, Loc)>,
    pub(crate) kinetic: Option<(Id, Loc)>,
    /// Declared generalised forces, by coordinate.
    pub(crate) force: BTreeMap<usize, Id>,
    pub(crate) potential: Option<Id>,
    /// The paper's c, by coordinate.
    pub(crate) nonideal: Option<BTreeMap<usize, Id>>,
    /// Holonomic ones first.
    pub(crate) constraints: Vec<Constraint>,
    pub(crate) outputs: Vec<OutputValue>,
    /// Names that the modeller gave to values.
    pub(crate) hints: HashMap<Id, String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    Holonomic,
    Nonholonomic,
}

/// φ = 0.
pub(crate) struct Constraint {
    pub(crate) item: ConstraintRef,
    pub(crate) kind: Kind,
    pub(crate) phi: Id,
    pub(crate) loc: Loc,
}

/// Name of a constraint or output: family, index, component of a vector equation.
#[derive(Clone)]
pub(crate) struct ConstraintRef {
    pub(crate) base: Ident,
    pub(crate) index: Option<i64>,
    pub(crate) component: Option<usize>,
}

impl ConstraintRef {
    /// As shown: `link[3]`, `joint[0]`, `joint[2][1]`.
    pub(crate) fn text(&self) -> String {
        let mut text = self.base.to_string();
        if let Some(i) = self.index {
            text += &format!("[{i}]");
        }
        if let Some(c) = self.component {
            text += &format!("[{c}]");
        }
        text
    }
}

pub(crate) struct OutputValue {
    pub(crate) item: ConstraintRef,
    pub(crate) docs: Vec<String>,
    pub(crate) value: Id,
}

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
}

enum Binding {
    Value(Value),
    Family(BTreeMap<i64, Value>),
    Function(Function),
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
        known_params: 0,
        hints: HashMap::new(),
    };
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
    /// Parameters whose default is known: those a default may use.
    known_params: usize,
    hints: HashMap<Id, String>,
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
        for constant in &self.model.floats {
            let value = self.scalar(&constant.value, &Env::new(&top, Place::Const));
            self.floats.push(value);
        }
        let defaults = self.defaults();
        self.lower_lets(decl, &top);

        let mut mass: BTreeMap<(usize, usize), (Id, Loc)> = BTreeMap::new();
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
                            k.loc(),
                            format!("a diagonal entry of M is written `{}: …`", k.name),
                        );
                        return;
                    }
                    Some((Some(c), _)) => c,
                };
                let place = (row.max(column), row.min(column));
                let old = mass.get(&place).map(|(id, _)| *id);
                let sum = self.accumulate(old, value);
                let loc = mass.get(&place).map_or(entry.key.loc(), |(_, loc)| *loc);
                mass.insert(place, (sum, loc));
            });
        }
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
        let mut names = HashSet::new();
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
            defaults,
            mass,
            kinetic,
            force,
            potential,
            nonideal,
            constraints,
            outputs,
            hints: std::mem::take(&mut self.hints),
        }
    }

    fn defaults(&mut self) -> Vec<f64> {
        let mut defaults = Vec::new();
        for element in &self.model.param_elements {
            let mut value = f64::NAN;
            if let Some((expr, variables)) = &element.default {
                let scope = Scope::with(self.model, variables.clone());
                let id = self.scalar(expr, &Env::new(&scope, Place::Default));
                let point = Point {
                    params: &defaults,
                    q: &[],
                    v: &[],
                    t: 0.0,
                };
                value = eval(&self.graph, &[id], &point)[0];
                if !value.is_finite() && self.diag.is_empty() {
                    self.diag.error(
                        expr.loc,
                        format!("default of `{}` is not a finite number", element.name),
                    );
                }
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
            let index = match &key.index {
                None => None,
                Some(i) => match self.integer(i, scope) {
                    Some(i) => Some(i),
                    None => return,
                },
            };
            let again = match (self.lets.get(&name), index) {
                (None, _) => false,
                (Some(Binding::Family(members)), Some(i)) => members.contains_key(&i),
                (Some(_), _) => true,
            };
            let taken = match self.model.free(&key.name) {
                Err(reason) => Some(reason),
                Ok(()) if again => {
                    Some(format!("`{name}` is declared twice; names must be unique"))
                }
                Ok(()) => None,
            };
            if let Some(reason) = taken {
                self.diag.error(key.loc(), reason);
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
            let (_, id) = self.graph.unscaled(id);
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
        }
    }

    fn accumulate(&mut self, old: Option<Id>, value: Id) -> Id {
        old.map_or(value, |old| {
            let mut terms = self.graph.open(1.0, old);
            terms.push((1.0, value));
            self.graph.sum(&terms)
        })
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
        let mut out = BTreeMap::new();
        top.unroll(blocks, self.diag, &mut |entry, scope| {
            let coordinate = self.coordinate(&entry.key, scope);
            let value = self.scalar(&entry.value, &Env::new(scope, place));
            if let Some(i) = coordinate {
                let sum = self.accumulate(out.get(&i).copied(), value);
                out.insert(i, sum);
            }
        });
        out
    }

    fn equation(
        &mut self,
        equation: &Equation,
        kind: Kind,
        scope: &Scope<'m>,
        names: &mut HashSet<String>,
        out: &mut Vec<Constraint>,
    ) {
        let key = &equation.key;
        let index = match &key.index {
            None => None,
            Some(i) => match self.integer(i, scope) {
                Some(i) => Some(i),
                None => return,
            },
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
            Ok(()) if !names.insert(item.text()) => {
                Some(match (index, scope.variables.is_empty()) {
                    (None, false) => format!(
                        "constraint `{0}` is declared twice; in a loop, index it: `{0}[i]: …`",
                        key.name
                    ),
                    _ => format!(
                        "constraint `{}` is declared twice; names must be unique",
                        item.text()
                    ),
                })
            }
            Ok(()) => None,
        };
        if let Some(reason) = reason {
            self.diag.error(key.loc(), reason);
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
        let loc = key.loc();
        match self.total(&terms, true) {
            Value::Scalar(phi) => out.push(Constraint {
                item,
                kind,
                phi,
                loc,
            }),
            Value::Vector(components) => {
                for (c, phi) in components.into_iter().enumerate() {
                    item.component = Some(c);
                    out.push(Constraint {
                        item: item.clone(),
                        kind,
                        phi,
                        loc,
                    });
                }
            }
        }
    }

    fn outputs(&mut self, decl: &Declaration, top: &Scope<'m>) -> Vec<OutputValue> {
        let mut out: Vec<OutputValue> = Vec::new();
        top.unroll(&decl.outputs, self.diag, &mut |output, scope| {
            let key = &output.key;
            let index = match &key.index {
                None => None,
                Some(i) => match self.integer(i, scope) {
                    Some(i) => Some(i),
                    None => return,
                },
            };
            let value = self.value(&output.value, &Env::new(scope, Place::Output));
            let ids = match value {
                Value::Scalar(id) => vec![(None, id)],
                Value::Vector(ids) => ids
                    .into_iter()
                    .enumerate()
                    .map(|(c, id)| (Some(c), id))
                    .collect(),
            };
            for (component, value) in ids {
                let item = ConstraintRef {
                    base: key.name.clone(),
                    index,
                    component,
                };
                let text = item.text();
                let coordinates = &self.model.coord_elements;
                if out.iter().any(|o| o.item.text() == text) {
                    self.diag.error(
                        key.loc(),
                        format!("output `{text}` is declared twice; names must be unique"),
                    );
                    return;
                }
                if coordinates.iter().any(|c| c.name == text) {
                    self.diag.error(
                        key.loc(),
                        format!(
                            "`{text}` is a coordinate and in the output anyway; choose another name"
                        ),
                    );
                    return;
                }
                out.push(OutputValue {
                    item,
                    docs: output.docs.clone(),
                    value,
                });
            }
        });
        out
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
            let near = suggest(&name, coords.iter().map(String::as_str));
            self.diag.error(
                key.name.span(),
                format!("`{name}` is not a coordinate{near}"),
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

    fn scalar(&mut self, e: &Expr, env: &Env<'m>) -> Id {
        match self.value(e, env) {
            Value::Scalar(id) => id,
            Value::Vector(v) => {
                self.diag.error(
                    e.loc,
                    format!("expected a number, found a vector of {}", v.len()),
                );
                self.graph.zero()
            }
        }
    }

    fn error(&mut self, loc: impl Into<Loc>, message: impl Into<String>) -> Value {
        self.diag.error(loc, message);
        Value::Scalar(self.graph.zero())
    }

    fn value(&mut self, e: &Expr, env: &Env<'m>) -> Value {
        match &e.kind {
            ExprKind::Error => Value::Scalar(self.graph.zero()),
            #[allow(
                clippy::cast_precision_loss,
                reason = "an integer in a formula is a number"
            )]
            ExprKind::Int(n) => Value::Scalar(self.graph.constant(*n as f64)),
            ExprKind::Float(x) => Value::Scalar(self.graph.constant(*x)),
            ExprKind::Group(inner) => self.value(inner, env),
            ExprKind::Name(name) => self.name(name, env),
            ExprKind::Index(name, index) => self.indexed(name, index, env),
            ExprKind::Neg(_) | ExprKind::Binary(BinaryOp::Add | BinaryOp::Sub, ..) => {
                let mut terms = Vec::new();
                self.chain(e, 1.0, env, &mut terms);
                self.total(&terms, false)
            }
            ExprKind::Binary(BinaryOp::Mul, a, b) => {
                let (va, vb) = (self.value(a, env), self.value(b, env));
                match (va, vb) {
                    (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(self.graph.mul(a, b)),
                    (Value::Scalar(s), Value::Vector(v)) | (Value::Vector(v), Value::Scalar(s)) => {
                        Value::Vector(v.into_iter().map(|c| self.graph.mul(s, c)).collect())
                    }
                    (Value::Vector(_), Value::Vector(_)) => self.error(
                        e.loc,
                        "the product of two vectors is not defined; write out the components",
                    ),
                }
            }
            ExprKind::Binary(BinaryOp::Div, a, b) => self.quotient(e, a, b, env),
            ExprKind::Vector(components) => {
                let components = components
                    .iter()
                    .map(|c| self.scalar(c, env))
                    .collect::<Vec<_>>();
                if components.is_empty() {
                    return self.error(e.loc, "a vector needs at least one component");
                }
                Value::Vector(components)
            }
            ExprKind::Sum { var, range, body } => {
                if !env.scope.loop_variable(var, self.diag) {
                    return Value::Scalar(self.graph.zero());
                }
                let Some(range) = env.scope.range(range, self.diag) else {
                    return Value::Scalar(self.graph.zero());
                };
                let mut terms = Vec::new();
                let before = self.diag.len();
                for i in range {
                    let mut inner = env.clone();
                    inner.scope = env.scope.bind(var, i);
                    self.chain(body, 1.0, &inner, &mut terms);
                    if self.diag.len() > before {
                        break;
                    }
                }
                self.total(&terms, false)
            }
            ExprKind::Call(name, args) => self.call(e, name, args, env),
        }
    }

    fn quotient(&mut self, e: &Expr, a: &Expr, b: &Expr, env: &Env<'m>) -> Value {
        if is_integer(a, &env.scope) && is_integer(b, &env.scope) {
            let quiet = Diagnostics::default();
            let (x, y) = (env.scope.integer(a, &quiet), env.scope.integer(b, &quiet));
            if let (Some(x), Some(y)) = (x, y)
                && y != 0
                && x % y != 0
            {
                return self.error(
                    e.loc,
                    format!("`{x} / {y}` is an integer division, which Rust rounds to {}; write `{x}.0 / {y}.0`", x / y),
                );
            }
        }
        let top = self.value(a, env);
        let bottom = match self.value(b, env) {
            Value::Scalar(id) => id,
            Value::Vector(_) => return self.error(b.loc, "cannot divide by a vector"),
        };
        if self.graph.is_zero(bottom) && self.diag.is_empty() {
            return self.error(b.loc, "division by zero");
        }
        match top {
            Value::Scalar(a) => Value::Scalar(self.graph.div(a, bottom)),
            Value::Vector(v) => {
                Value::Vector(v.into_iter().map(|c| self.graph.div(c, bottom)).collect())
            }
        }
    }

    /// Terms of a sum written without parentheses, with their sign.
    fn chain(&mut self, e: &Expr, sign: f64, env: &Env<'m>, out: &mut Vec<(f64, Value, Loc)>) {
        match &e.kind {
            ExprKind::Binary(BinaryOp::Add, a, b) => {
                self.chain(a, sign, env, out);
                self.chain(b, sign, env, out);
            }
            ExprKind::Binary(BinaryOp::Sub, a, b) => {
                self.chain(a, sign, env, out);
                self.chain(b, -sign, env, out);
            }
            ExprKind::Neg(inner) => self.chain(inner, -sign, env, out),
            _ => {
                let value = self.value(e, env);
                out.push((sign, value, e.loc));
            }
        }
    }

    /// Sum of scalars, or of vectors of one length. `open` joins the sums inside vectors to one (the sides of an equation).
    fn total(&mut self, terms: &[(f64, Value, Loc)], open: bool) -> Value {
        let length = |v: &Value| match v {
            Value::Scalar(_) => None,
            Value::Vector(v) => Some(v.len()),
        };
        let Some((_, first, _)) = terms.first() else {
            return Value::Scalar(self.graph.zero());
        };
        let expected = length(first);
        let describe =
            |l: Option<usize>| l.map_or("a number".to_owned(), |n| format!("a vector of {n}"));
        for (_, value, loc) in &terms[1..] {
            let found = length(value);
            // `v = 0` compares each component with 0.
            let zero = matches!(value, Value::Scalar(id) if self.graph.is_zero(*id)) && open;
            if found != expected && !zero {
                return self.error(
                    *loc,
                    format!("expected {}, found {}", describe(expected), describe(found)),
                );
            }
        }
        let component = |value: &Value, c: usize| match value {
            Value::Scalar(id) => *id,
            Value::Vector(v) => v[c],
        };
        let mut sums = Vec::new();
        for c in 0..expected.unwrap_or(1) {
            let mut flat = Vec::new();
            for (sign, value, _) in terms {
                let id = component(value, c);
                if open && expected.is_some() {
                    flat.extend(self.graph.open(*sign, id));
                } else {
                    flat.push((*sign, id));
                }
            }
            sums.push(self.graph.sum(&flat));
        }
        match expected {
            None => Value::Scalar(sums[0]),
            Some(_) => Value::Vector(sums),
        }
    }

    fn name(&mut self, name: &Ident, env: &Env<'m>) -> Value {
        let text = name.to_string();
        if let Some((_, value)) = env.args.iter().rev().find(|(n, _)| *n == text) {
            return value.clone();
        }
        if let Some(i) = env.scope.lookup(&text) {
            #[allow(
                clippy::cast_precision_loss,
                reason = "an integer in a formula is a number"
            )]
            return Value::Scalar(self.graph.constant(i as f64));
        }
        match text.as_str() {
            "t" => return self.allowed(Symbol::Time, name.span(), env),
            "PI" => return Value::Scalar(self.graph.constant(std::f64::consts::PI)),
            _ => {}
        }
        match self.model.names.get(&text) {
            Some(Name::Param(family)) => {
                let Some(i) = self.member(name, None, &self.model.params[*family], &env.scope)
                else {
                    return Value::Scalar(self.graph.zero());
                };
                self.allowed(Symbol::Param(i), name.span(), env)
            }
            Some(Name::Coord(family)) => {
                let Some(i) = self.member(name, None, &self.model.coords[*family], &env.scope)
                else {
                    return Value::Scalar(self.graph.zero());
                };
                self.allowed(Symbol::Coord(i), name.span(), env)
            }
            Some(Name::Float(i)) => match self.floats.get(*i) {
                Some(id) => Value::Scalar(*id),
                None => self.error(
                    name.span(),
                    format!("`{text}` is declared further down; move its declaration up"),
                ),
            },
            Some(Name::Integer) | None => match self.lets.get(&text) {
                Some(Binding::Value(value)) => {
                    let value = value.clone();
                    self.allowed_value(value, name.span().into(), env)
                }
                Some(Binding::Family(_)) => self.error(
                    name.span(),
                    format!("`{text}` is a family; index it: `{text}[i]`"),
                ),
                Some(Binding::Function(_)) => self.error(
                    name.span(),
                    format!("`{text}` is a function; call it: `{text}(…)`"),
                ),
                None => self.unknown(name, env),
            },
        }
    }

    fn unknown(&mut self, name: &Ident, env: &Env<'m>) -> Value {
        let text = name.to_string();
        let names = self
            .model
            .names
            .keys()
            .chain(self.lets.keys())
            .map(String::as_str);
        let names = names.chain(env.args.iter().map(|(n, _)| n.as_str()));
        let near = suggest(&text, names.chain(["t", "PI"]));
        let hint = if near.is_empty() {
            "; declare it under `params`, `coords` or by `let` before its use"
        } else {
            ""
        };
        self.error(name.span(), format!("unknown name `{text}`{near}{hint}"))
    }

    fn indexed(&mut self, name: &Ident, index: &Expr, env: &Env<'m>) -> Value {
        let text = name.to_string();
        let zero = Value::Scalar(self.graph.zero());
        let argument = env
            .args
            .iter()
            .rev()
            .find(|(n, _)| *n == text)
            .map(|(_, v)| v.clone());
        let vector = argument.or_else(|| match self.lets.get(&text) {
            Some(Binding::Value(value)) => Some(value.clone()),
            _ => None,
        });
        if let Some(value) = vector {
            let Value::Vector(components) = &value else {
                return self.error(
                    index.loc,
                    format!("`{text}` is a number; write it without an index"),
                );
            };
            let Some(i) = self.integer(index, &env.scope) else {
                return zero;
            };
            return match usize::try_from(i).ok().and_then(|i| components.get(i)) {
                Some(id) => self.allowed_value(Value::Scalar(*id), name.span().into(), env),
                None => self.error(
                    index.loc,
                    format!(
                        "index {i} is out of range: `{text}` has {} components",
                        components.len()
                    ),
                ),
            };
        }
        match self.model.names.get(&text) {
            Some(Name::Param(family)) => {
                match self.member(name, Some(index), &self.model.params[*family], &env.scope) {
                    Some(i) => self.allowed(Symbol::Param(i), name.span(), env),
                    None => zero,
                }
            }
            Some(Name::Coord(family)) => {
                match self.member(name, Some(index), &self.model.coords[*family], &env.scope) {
                    Some(i) => self.allowed(Symbol::Coord(i), name.span(), env),
                    None => zero,
                }
            }
            Some(_) => self.error(name.span(), format!("`{text}` is not a family")),
            None => match self.lets.get(&text) {
                Some(Binding::Family(members)) => {
                    let Some(i) = scope_integer(index, env, self.diag) else {
                        return zero;
                    };
                    match members.get(&i).cloned() {
                        Some(value) => self.allowed_value(value, name.span().into(), env),
                        None => {
                            self.error(index.loc, format!("`{text}[{i}]` is not declared (yet)"))
                        }
                    }
                }
                Some(_) => self.error(
                    name.span(),
                    format!("`{text}` is a function; call it: `{text}(…)`"),
                ),
                None => self.unknown(name, env),
            },
        }
    }

    fn call(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        if matches!(self.lets.get(&text), Some(Binding::Function(_))) {
            return self.apply(e, name, args, env);
        }
        match text.as_str() {
            "dot" => return self.dot(e, name, args, env),
            "ddot" => {
                return self.error(
                    name.span(),
                    "accelerations are what is solved for; no section may use them",
                );
            }
            "powi" => {
                let [base, exponent] = args else {
                    return self.arity(name, 2, args.len());
                };
                let base = self.scalar(base, env);
                let Some(n) = scope_integer(exponent, env, self.diag) else {
                    return Value::Scalar(self.graph.zero());
                };
                return match i32::try_from(n) {
                    Ok(n) => Value::Scalar(self.graph.pow(base, n)),
                    Err(_) => {
                        self.error(exponent.loc, "exponent is too large for `powi`; use `powf`")
                    }
                };
            }
            "sq" | "recip" => {
                let [u] = args else {
                    return self.arity(name, 1, args.len());
                };
                let u = self.scalar(u, env);
                let exponent = if text == "sq" { 2 } else { -1 };
                return Value::Scalar(self.graph.pow(u, exponent));
            }
            "signum" => {
                return self.error(
                    name.span(),
                    "`signum(0.0)` is 1 in Rust; write `sign`, which is 0 at 0",
                );
            }
            _ => {}
        }
        let Some(func) = Func::ALL.into_iter().find(|f| f.name() == text) else {
            return self.unknown_function(name, env);
        };
        if args.len() != func.arity() {
            return self.arity(name, func.arity(), args.len());
        }
        let ids: Vec<Id> = args.iter().map(|a| self.scalar(a, env)).collect();
        Value::Scalar(match ids.as_slice() {
            [u, w] => self.graph.call2(func, *u, *w),
            _ => self.graph.call1(func, ids[0]),
        })
    }

    fn arity(&mut self, name: &Ident, expected: usize, found: usize) -> Value {
        let s = if expected == 1 { "" } else { "s" };
        self.error(
            name.span(),
            format!("`{name}` takes {expected} argument{s}, found {found}"),
        )
    }

    fn unknown_function(&mut self, name: &Ident, env: &Env<'m>) -> Value {
        let text = name.to_string();
        let known = self.model.names.contains_key(&text) || self.lets.contains_key(&text);
        if known || env.args.iter().any(|(n, _)| *n == text) {
            return self.error(
                name.span(),
                format!("`{text}` is not a function; write `*` for a product, `,` between entries"),
            );
        }
        let mut names: Vec<&str> = Func::ALL.iter().map(|f| f.name()).collect();
        names.extend(["sq", "powi", "recip", "dot", "sum"]);
        let list = names.join(", ");
        let functions = self
            .lets
            .iter()
            .filter(|(_, b)| matches!(b, Binding::Function(_)));
        names.extend(functions.map(|(n, _)| n.as_str()));
        let near = suggest(&text, names);
        self.error(name.span(), format!("unknown function `{text}`{near}; functions are {list}, and those declared by `let f = |u| …;`"))
    }

    /// Applies a function declared by `let`.
    fn apply(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        let Some(Binding::Function(function)) = self.lets.get(&text) else {
            return self.unknown_function(name, env);
        };
        let (parameters, body) = (function.args.clone(), function.body.clone());
        if args.len() != parameters.len() {
            return self.arity(name, parameters.len(), args.len());
        }
        if self.active.contains(&text) {
            return self.error(
                name.span(),
                format!("`{text}` calls itself; functions cannot be recursive"),
            );
        }
        let values: Vec<Value> = args.iter().map(|a| self.value(a, env)).collect();
        // An integer argument may serve as an index inside the function.
        let integers = parameters
            .iter()
            .zip(args)
            .filter(|(_, a)| is_integer(a, &env.scope));
        let integers = integers
            .filter_map(|(p, a)| Some((p.to_string(), self.integer(a, &env.scope)?)))
            .collect();
        let inner = Env {
            scope: Scope::with(self.model, integers),
            args: parameters
                .iter()
                .map(Ident::to_string)
                .zip(values)
                .collect(),
            place: Place::Let,
        };
        self.active.push(text);
        let value = self.value(&body, &inner);
        self.active.pop();
        self.allowed_value(value, e.loc, env)
    }

    /// `dot(u)`: q̇ of a coordinate, the total time derivative of an expression of q and t.
    fn dot(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let [u] = args else {
            return self.arity(name, 1, args.len());
        };
        // The argument may use coordinates even where a velocity may not stand; the velocity itself is checked below.
        let before = self.diag.len();
        let value = self.value(u, env);
        if self.diag.len() > before {
            return value;
        }
        let ids = match &value {
            Value::Scalar(id) => vec![*id],
            Value::Vector(ids) => ids.clone(),
        };
        if ids.iter().any(|id| self.graph.uses(*id).velocity) {
            return self.error(
                e.loc,
                "the time derivative of a velocity is an acceleration, which is what is solved for; no section may use it",
            );
        }
        if ids.iter().all(|id| self.graph.uses(*id).constant()) {
            return self.error(u.loc, "this does not change with time; `dot` takes a coordinate or an expression of coordinates and `t`");
        }
        let mut total = Derivative::total();
        let dots: Vec<Id> = ids
            .iter()
            .map(|id| total.of(*id, &mut self.graph))
            .collect();
        let value = match value {
            Value::Scalar(_) => Value::Scalar(dots[0]),
            Value::Vector(_) => Value::Vector(dots),
        };
        self.allowed_value(value, e.loc, env)
    }

    fn allowed(&mut self, symbol: Symbol, span: proc_macro2::Span, env: &Env<'m>) -> Value {
        let id = self.graph.symbol(symbol);
        if env.place == Place::Default
            && let Symbol::Param(i) = symbol
            && i >= self.known_params
        {
            return self.error(span, "a default may use parameters declared above it only");
        }
        self.allowed_value(Value::Scalar(id), span.into(), env)
    }

    /// Checks that what `value` depends on may stand in this section.
    fn allowed_value(&mut self, value: Value, loc: Loc, env: &Env<'m>) -> Value {
        let ids = match &value {
            Value::Scalar(id) => std::slice::from_ref(id),
            Value::Vector(ids) => ids.as_slice(),
        };
        for id in ids {
            let uses = self.graph.uses(*id);
            let refusal = match env.place {
                Place::Const if uses.param || !uses.constant() => Some(
                    "a constant is known at compile time; make it a parameter, or a value by `let`",
                ),
                Place::Default if !uses.constant() => Some(
                    "a parameter is a number; what changes with coordinates or time is declared by `let`",
                ),
                Place::Mass if uses.velocity => Some(
                    "M depends on coordinates and time only; forces that depend on velocities go under `force`",
                ),
                Place::Potential if uses.velocity => Some(
                    "a potential depends on coordinates and time only; forces that depend on velocities go under `force`",
                ),
                Place::Holonomic if uses.velocity => Some(
                    "a velocity in a holonomic constraint; move the constraint under `nonholonomic`",
                ),
                _ => None,
            };
            if let Some(message) = refusal {
                return self.error(loc, message);
            }
        }
        value
    }
}

fn scope_integer(e: &Expr, env: &Env<'_>, diag: &Diagnostics) -> Option<i64> {
    env.scope.integer(e, diag)
}

/// Whether `e` is an integer by its form (so that `/` would be integer division in Rust).
fn is_integer(e: &Expr, scope: &Scope<'_>) -> bool {
    match &e.kind {
        ExprKind::Int(_) => true,
        ExprKind::Name(n) => scope.lookup(&n.to_string()).is_some(),
        ExprKind::Neg(a) | ExprKind::Group(a) => is_integer(a, scope),
        ExprKind::Binary(_, a, b) => is_integer(a, scope) && is_integer(b, scope),
        _ => false,
    }
}
