//! `reaction(knee)`: the force of a constraint, by what the constraint is and what it acts on.

use super::array::Value;
use super::bodies::Frame;
use super::system::{Constraint, Kind};
use super::{Env, Lowering, NoValue, Place};
use crate::diag::suggest;
use crate::expr::diff::Gradient;
use crate::expr::graph::{Graph, Id, Node, Symbol};
use crate::model::{Name, indexed};
use crate::parse::{Expr, ExprKind};
use proc_macro2::Ident;
use std::ops::Range;

/// A constraint that is declared: its rows.
pub(super) struct Known {
    rows: Range<usize>,
    /// Of its equation.
    shape: Vec<usize>,
    /// What a joint of several rows calls them.
    names: Vec<&'static str>,
    force: Option<Pushed>,
}

/// Where the force of a joint on its second body is read.
#[derive(Clone)]
pub(super) struct Pushed {
    /// Coordinates of a centre of mass, by position; none of a body whose place follows from other coordinates.
    centre: Vec<usize>,
    /// −1 where that is the first body's, as the second is the ground.
    sign: f64,
}

impl Pushed {
    /// Of a joint between points of `first` and `second`, unless both are of the ground.
    pub(super) fn between(first: Option<&Frame>, second: &Frame, g: &Graph) -> Option<Self> {
        let of = |frame: &Frame, sign: f64| {
            let place = frame
                .moving
                .as_ref()?
                .place
                .iter()
                .map(|id| match g.node(*id) {
                    Node::Symbol(Symbol::Coord(i)) => Some(*i),
                    _ => None,
                });
            let centre = place.collect::<Option<Vec<usize>>>();
            let centre = centre.unwrap_or_default();
            Some(Pushed { centre, sign })
        };
        of(second, 1.0).or_else(|| of(first?, -1.0))
    }
}

impl<'m> Lowering<'m> {
    /// Enters the constraint `name` with its last rows, which are those from `first` on.
    pub(super) fn know(
        &mut self,
        name: String,
        first: usize,
        shape: &[usize],
        names: Vec<&'static str>,
        force: Option<Pushed>,
    ) {
        let known = Known {
            rows: first..self.constraints.len(),
            shape: shape.to_vec(),
            names,
            force,
        };
        self.known.insert(name, known);
    }

    /// `reaction(knee)`, `reaction(link[2])`, `reaction(knee.x)`.
    pub(super) fn reaction(
        &mut self,
        e: &Expr,
        name: &Ident,
        args: &[Expr],
        env: &Env<'m>,
    ) -> Value {
        let [arg] = args else {
            return self.arity(name, 1, args.len());
        };
        let open = [Place::Output, Place::Integral, Place::Nonideal].contains(&env.place);
        if !self.constrained || !(open || self.applying()) {
            let message = "reactions follow from all other equations: `reaction` stands under `output`, `integral` and `nonideal`, and in functions used there";
            return self.error_once(name, message);
        }
        if matches!(arg.kind, ExprKind::Error) {
            return Value::Error;
        }
        let before = self.diag.len();
        // A field is a row of a joint, or what belongs to a part.
        let whole = self.shown_path(arg, env);
        let (text, row) = match (&whole, &arg.kind) {
            (Some(text), ExprKind::Field(inner, row)) if !self.known.contains_key(text) => {
                (self.shown_path(inner, env), Some(row))
            }
            _ => (whole, None),
        };
        let (Some(text), Some(constraint)) = (text, root(arg)) else {
            return match self.diag.len() == before {
                true => self.no_constraint(arg),
                false => Value::Error,
            };
        };
        if !self.known.contains_key(&text) {
            return self.unknown_constraint(arg, constraint, &text);
        }
        self.reaction_used.get_or_insert(e.loc);
        match row {
            None => self.whole(&text, arg),
            Some(row) => self.of_row(&text, row),
        }
    }

    /// A name with indices and fields as it is shown: `leg[2].knee`; nothing for what is none.
    fn shown_path(&self, e: &Expr, env: &Env<'m>) -> Option<String> {
        match &e.kind {
            ExprKind::Name(name) => Some(self.model.shown(&name.to_string()).to_owned()),
            ExprKind::Index(base, indices) => {
                let base = self.shown_path(base, env)?;
                Some(indexed(base, &self.indices(indices, &env.scope)?))
            }
            ExprKind::Field(inner, field) => {
                Some(format!("{}.{field}", self.shown_path(inner, env)?))
            }
            _ => None,
        }
    }

    fn no_constraint(&mut self, arg: &Expr) -> Value {
        let message = "`reaction` takes the name of a constraint, such as `reaction(knee)`, or of a row of a joint, such as `reaction(knee.x)`";
        self.error(arg.loc, message)
    }

    fn unknown_constraint(&mut self, arg: &Expr, constraint: &Ident, text: &str) -> Value {
        let base = constraint.to_string();
        if self.results.get(&base) == Some(&NoValue::Constraint) {
            // Else it is left out because of an error.
            if self.diag.is_empty() {
                let members = self.known.keys();
                let members = members.filter(|k| k.starts_with(&format!("{base}[")));
                let remedy = match members.min() {
                    Some(member) => format!("it is a family; choose a member, such as `{member}`"),
                    None => format!("write `reaction({base})`"),
                };
                return self.error(
                    arg.loc,
                    format!("no constraint is called `{text}`; {remedy}"),
                );
            }
            return Value::Error;
        }
        if !self.unknown.insert(base.clone()) {
            return Value::Error;
        }
        if self.model.names.get(&base) == Some(&Name::Joint) {
            let message = format!(
                "`{base}` stands under `tree`: it has a coordinate in place of rows, and so no multipliers; under `holonomic` it has a reaction"
            );
            return self.error(arg.loc, message);
        }
        let declared = self
            .results
            .iter()
            .filter(|(_, r)| **r == NoValue::Constraint);
        let names = declared.map(|(name, _)| name.as_str());
        let remedy = "it is declared under `holonomic` or `nonholonomic`";
        let end = suggest(&base, names, remedy);
        self.error(arg.loc, format!("no constraint is called `{base}`{end}"))
    }

    /// The force of a joint between points on its second body; of any other constraint its multipliers, in the shape of its equation.
    fn whole(&mut self, text: &str, arg: &Expr) -> Value {
        let Some(Known {
            rows,
            shape,
            names,
            force,
        }) = self.known.get(text)
        else {
            return Value::Error;
        };
        let (rows, shape) = (rows.clone(), shape.clone());
        // Rows that keep a point at a point, along all axes: their multipliers are the force's components.
        let axes = names.iter().zip(["x", "y", "z"]);
        let axes = axes.take_while(|(name, axis)| *name == axis).count();
        let Some(Pushed { centre, sign }) = force.clone() else {
            let multipliers = rows.map(|row| self.graph.symbol(Symbol::Multiplier(row)));
            let multipliers: Vec<Id> = multipliers.collect();
            return Value::new(&shape, multipliers);
        };
        if axes >= 2 && (centre.is_empty() || axes == centre.len()) {
            let components = rows.take(axes).map(Symbol::Multiplier);
            let components: Vec<Id> = components.map(|symbol| self.graph.symbol(symbol)).collect();
            return Value::vector(components);
        }
        if centre.is_empty() {
            let row = names.first().copied().unwrap_or("x");
            let message = format!(
                "the bodies of `{text}` have no coordinates of their own place; take the multipliers of its rows, such as `reaction({text}.{row})`"
            );
            return self.error(arg.loc, message);
        }
        let components = centre.into_iter().map(|i| {
            let terms = rows.clone().map(|row| {
                let slope = slope(&self.constraints[row], i, &mut self.graph);
                let multiplier = self.graph.symbol(Symbol::Multiplier(row));
                (sign, self.graph.mul(slope, multiplier))
            });
            let terms: Vec<(f64, Id)> = terms.collect();
            self.graph.sum(&terms)
        });
        let components: Vec<Id> = components.collect();
        Value::vector(components)
    }

    /// The multiplier of a row of a joint.
    fn of_row(&mut self, text: &str, row: &Ident) -> Value {
        let Some(Known { rows, names, .. }) = self.known.get(text) else {
            return Value::Error;
        };
        if let Some(k) = names.iter().position(|name| row == name) {
            let multiplier = Symbol::Multiplier(rows.start + k);
            return Value::Scalar(self.graph.symbol(multiplier));
        }
        let message = match names.len() {
            0 => {
                format!("the rows of `{text}` have no names of their own; write `reaction({text})`")
            }
            _ => {
                let list = format!("they are `{}`", names.join("`, `"));
                let end = suggest(&row.to_string(), names.iter().copied(), &list);
                format!("no row of `{text}` is called `{row}`{end}")
            }
        };
        self.error(row.span(), message)
    }
}

/// The name that a path begins with.
fn root(e: &Expr) -> Option<&Ident> {
    match &e.kind {
        ExprKind::Name(name) => Some(name),
        ExprKind::Index(inner, _) | ExprKind::Field(inner, _) => root(inner),
        _ => None,
    }
}

/// What one unit of the multiplier of `constraint` pushes coordinate `i` with.
fn slope(constraint: &Constraint, i: usize, g: &mut Graph) -> Id {
    let symbol = match constraint.kind {
        Kind::Holonomic => Symbol::Coord(i),
        Kind::Nonholonomic => Symbol::Velocity(i),
    };
    Gradient::of(constraint.phi, g).along(symbol, g)
}
