//! `reaction(knee)` and `moment(knee)`: the force and the moment of a constraint, by what the constraint is and what it acts on.

use super::array::Value;
use super::bodies::{Frame, Orientation};
use super::vectors::cross;
use super::{Env, Lowering, NoValue, Place};
use crate::diag::suggest;
use crate::model::Name;
use crate::parse::{Expr, ExprKind};
use proc_macro2::Ident;
use ukalgebra::expr::Gradient;
use ukalgebra::expr::indexed;
use ukalgebra::expr::{Constraint, Kind};
use ukalgebra::expr::{Graph, Id, Node, Symbol};

/// A constraint that is declared: its rows.
pub(super) struct Known {
    /// Nothing for those that always hold.
    pub(super) rows: Vec<Option<usize>>,
    /// The shape of the constraint's equation.
    pub(super) shape: Vec<usize>,
    /// What a joint of several rows calls them.
    pub(super) names: Vec<&'static str>,
    /// The load of a joint between bodies.
    pub(super) load: Option<Load>,
    /// The rows in axes of the ground, where they are written as if what carries the joint were at rest.
    pub(super) ground: Vec<Id>,
}

/// What the load of a joint on its second body is read from.
#[derive(Clone)]
pub(super) struct Load {
    /// Coordinates of a centre of mass, by position; none of a body whose place follows from other coordinates.
    centre: Vec<usize>,
    /// The angle of the body, or its quaternion, by position; none of a body whose orientation follows from other coordinates.
    pub(super) orientation: Vec<usize>,
    /// −1 where these are the first body's, as the second is the ground.
    sign: f64,
    /// The point that the force acts at, and about which the moment is taken, in axes of the ground; none where there is no force.
    at: Option<Vec<Id>>,
    /// What the first rows push the second body with for a multiplier of 1; none where they do along the axes.
    pub(super) pushes: Vec<Vec<Id>>,
    /// Whether these are axes that turn with what carries the joint.
    turned: bool,
}

impl Load {
    /// Has rows that push along axes push along these.
    pub(super) fn turn(&mut self, axes: Vec<Vec<Id>>) {
        if self.at.is_some() && self.pushes.is_empty() {
            (self.pushes, self.turned) = (axes, true);
        }
    }

    /// Has rows that push along axes push along those of the ground.
    pub(super) fn turn_back(&mut self) {
        if std::mem::take(&mut self.turned) {
            self.pushes.clear();
        }
    }

    /// Whether `place` depends on the coordinates of the body.
    pub(super) fn moves(&self, place: &[Id], g: &Graph) -> bool {
        let own = |id: &Id| match g.node(*id) {
            Node::Symbol(Symbol::Coord(i)) => {
                self.centre.contains(i) || self.orientation.contains(i)
            }
            _ => false,
        };
        g.reachable(place).iter().any(own)
    }

    /// The load of a joint of `first` and `second`, unless both are of the ground.
    pub(super) fn between(
        first: Option<&Frame>,
        second: &Frame,
        at: Option<Vec<Id>>,
        g: &Graph,
    ) -> Option<Self> {
        let (of, sign) = match &second.moving {
            Some(moving) => (moving, 1.0),
            None => (first?.moving.as_ref()?, -1.0),
        };
        Some(Load {
            centre: coordinates(&of.place, g),
            orientation: match &of.orientation {
                Orientation::Own(own) => coordinates(own, g),
                Orientation::Hung(_) => Vec::new(),
            },
            sign,
            at,
            pushes: Vec::new(),
            turned: false,
        })
    }
}

/// The coordinates that these are, by position; none if one is something else.
fn coordinates(ids: &[Id], g: &Graph) -> Vec<usize> {
    let positions = ids.iter().map(|id| match g.node(*id) {
        Node::Symbol(Symbol::Coord(i)) => Some(*i),
        _ => None,
    });
    positions
        .collect::<Option<Vec<usize>>>()
        .unwrap_or_default()
}

impl<'m> Lowering<'m> {
    /// Enters the constraint `name` with its last rows, which are those from `first` on.
    pub(super) fn know(
        &mut self,
        name: String,
        first: usize,
        shape: &[usize],
        names: Vec<&'static str>,
        load: Option<Load>,
        ground: Vec<Id>,
    ) {
        let known = Known {
            rows: (first..self.constraints.len()).map(Some).collect(),
            shape: shape.to_vec(),
            names,
            load,
            ground,
        };
        self.known.insert(name, known);
    }

    /// `reaction(knee)`, `reaction(link[2])`, `reaction(knee.x)`, and `moment` of the same.
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
            let remedy = match env.place {
                Place::Let if !self.applying() => format!(
                    "; make this a function of no argument, `let n = || {name}(…);`, and write `n()` there"
                ),
                _ => format!(
                    ", and in functions used there, of no argument as `let n = || {name}(…);` is"
                ),
            };
            let message = format!(
                "reactions follow from all other equations: `{name}` stands under `output`, `integral`, `draw` and `nonideal`{remedy}"
            );
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
                true => self.no_constraint(name, arg),
                false => Value::Error,
            };
        };
        if !self.known.contains_key(&text) {
            return self.unknown_constraint(name, arg, constraint, &text);
        }
        self.reaction_used.get_or_insert(e.loc);
        let row = match row.map(|row| self.of_row(name, &text, row)) {
            Some(None) => return Value::Error,
            Some(row) => row,
            None => None,
        };
        match row {
            row if name == "moment" => self.moment(&text, row, arg),
            None => self.whole(&text, arg),
            Some(row) => Value::Scalar(self.graph.symbol(Symbol::Multiplier(row))),
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

    fn no_constraint(&mut self, name: &Ident, arg: &Expr) -> Value {
        let message = format!(
            "`{name}` takes the name of a constraint, such as `{name}(knee)`, or of a row of a joint, such as `{name}(knee.x)`"
        );
        self.error(arg.loc, message)
    }

    fn unknown_constraint(
        &mut self,
        name: &Ident,
        arg: &Expr,
        constraint: &Ident,
        text: &str,
    ) -> Value {
        let base = constraint.to_string();
        if self.results.get(&base) == Some(&NoValue::Constraint) {
            // Else it is left out because of an error.
            if self.diag.is_empty() {
                let members = self.known.keys();
                let members = members.filter(|k| k.starts_with(&format!("{base}[")));
                let remedy = match members.min() {
                    Some(member) => format!("it is a family; choose a member, such as `{member}`"),
                    None => format!("write `{name}({base})`"),
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
            load,
            ..
        }) = self.known.get(text)
        else {
            return Value::Error;
        };
        let shape = shape.clone();
        let load = load.clone().filter(|load| load.at.is_some());
        let pushes = load.as_ref().map_or(&[][..], |load| &load.pushes);
        // Rows that keep a point at a point, along all axes: their multipliers are the force's components.
        let axes = names.iter().zip(["x", "y", "z"]);
        let axes = axes.take_while(|(name, axis)| *name == axis).count();
        let count = match (&load, pushes.len()) {
            (None, _) => rows.len(),
            (Some(_), 0) => axes,
            (Some(_), pushes) => pushes,
        };
        let Some(rows) = self.first_rows(text, count, arg) else {
            return Value::Error;
        };
        if !pushes.is_empty() {
            return Value::vector(self.pushed(pushes, &rows));
        }
        let multipliers = rows.into_iter().map(Symbol::Multiplier);
        let multipliers: Vec<Id> = multipliers
            .map(|symbol| self.graph.symbol(symbol))
            .collect();
        match load {
            None => Value::new(&shape, multipliers),
            Some(_) => Value::vector(multipliers),
        }
    }

    /// The first rows of a constraint, none of which may be left out where its reaction is asked for: it would be any.
    fn first_rows(&mut self, text: &str, count: usize, arg: &Expr) -> Option<Vec<usize>> {
        let Known { rows, names, .. } = self.known.get(text)?;
        let rows: Vec<Option<usize>> = rows.iter().copied().take(count).collect();
        if let Some(k) = rows.iter().position(Option::is_none) {
            let left = names
                .get(k)
                .map_or_else(String::new, |name| format!(", `{name}` among them,"));
            let message = format!(
                "`{text}` has no unique reaction: rows of it{left} always hold, as its bodies cannot move in their directions; take those of other rows, each by its name"
            );
            self.error(arg.loc, message);
            return None;
        }
        rows.into_iter().collect()
    }

    /// The force of these rows, the first of which push so.
    fn pushed(&mut self, pushes: &[Vec<Id>], rows: &[usize]) -> Vec<Id> {
        let dimensions = pushes.first().map_or(0, Vec::len);
        let along = (0..dimensions).map(|k| {
            let terms = rows.iter().zip(pushes).map(|(row, push)| {
                let multiplier = self.graph.symbol(Symbol::Multiplier(*row));
                (1.0, self.graph.mul(push[k], multiplier))
            });
            let terms: Vec<(f64, Id)> = terms.collect();
            self.graph.sum(&terms)
        });
        along.collect()
    }

    /// The generalised forces of these rows along `coordinates`, times `sign`.
    fn generalised(&mut self, coordinates: &[usize], sign: f64, rows: &[usize]) -> Vec<Id> {
        let along = coordinates.iter().map(|i| {
            let terms = rows.iter().map(|row| {
                let slope = slope(&self.constraints[*row], *i, &mut self.graph);
                let multiplier = self.graph.symbol(Symbol::Multiplier(*row));
                (sign, self.graph.mul(slope, multiplier))
            });
            let terms: Vec<(f64, Id)> = terms.collect();
            self.graph.sum(&terms)
        });
        along.collect()
    }

    /// The moment of a joint, or of a row of it, on its second body, about its point of that body: in the plane a number.
    fn moment(&mut self, text: &str, row: Option<usize>, arg: &Expr) -> Value {
        let rows = match row {
            None => self.first_rows(text, usize::MAX, arg),
            Some(row) => Some(vec![row]),
        };
        let (Some(rows), Some(Known { load, .. })) = (rows, self.known.get(text)) else {
            return Value::Error;
        };
        let Some(load) = load.clone() else {
            let message = format!(
                "`{text}` is no joint between bodies; its multipliers are `reaction({text})`"
            );
            return self.error(arg.loc, message);
        };
        if load.orientation.is_empty() {
            let message = format!(
                "the second body of `{text}` has no coordinates of its own orientation, or the first one hangs on it; take the multipliers of its rows by `reaction`"
            );
            return self.error(arg.loc, message);
        }
        let generalised = self.generalised(&load.orientation, load.sign, &rows);
        let force = self.generalised(&load.centre, -load.sign, &rows);
        let g = &mut self.graph;
        let mut components = match generalised[..] {
            [moment] => vec![moment],
            _ => of_quaternion(&load.orientation, &generalised, g),
        };
        // About the point in place of the centre of mass.
        if let Some(at) = load.at {
            let centre = load.centre.iter().map(|i| g.symbol(Symbol::Coord(*i)));
            let centre: Vec<Id> = centre.collect();
            let arm = at.iter().zip(centre);
            let arm = Value::vector(arm.map(|(at, centre)| g.sub(*at, centre)).collect());
            let moved = cross(g, &arm, &Value::vector(force)).unwrap_or(Value::Error);
            let pairs = components.iter_mut().zip(moved.entries());
            pairs.for_each(|(moment, moved)| *moment = g.sum(&[(1.0, *moment), (1.0, *moved)]));
        }
        match components[..] {
            [moment] => Value::Scalar(moment),
            _ => Value::vector(components),
        }
    }

    /// A row of a joint; reports it if there is none of this name.
    fn of_row(&mut self, name: &Ident, text: &str, row: &Ident) -> Option<usize> {
        let Known { rows, names, .. } = self.known.get(text)?;
        if let Some(k) = names.iter().position(|name| row == name) {
            let known = rows.get(k).copied().flatten();
            if known.is_none() {
                let message = format!(
                    "row `{row}` of `{text}` always holds, as its bodies cannot move in its direction, and has no unique reaction"
                );
                self.error(row.span(), message);
            }
            return known;
        }
        let message = match names.len() {
            0 => {
                format!("the rows of `{text}` have no names of their own; write `{name}({text})`")
            }
            _ => {
                let list = format!("they are `{}`", names.join("`, `"));
                let end = suggest(&row.to_string(), names.iter().copied(), &list);
                format!("no row of `{text}` is called `{row}`{end}")
            }
        };
        self.error(row.span(), message);
        None
    }
}

/// The moment in axes of the ground of generalised forces Q along a quaternion e: as ė = ½ ω e, it is ½ (e₀ Q − Q₀ e + e × Q).
fn of_quaternion(e: &[usize], force: &[Id], g: &mut Graph) -> Vec<Id> {
    let e: Vec<Id> = e.iter().map(|i| g.symbol(Symbol::Coord(*i))).collect();
    let component = |k: usize| {
        let (i, j) = (k % 3 + 1, (k + 1) % 3 + 1);
        let terms = [(0.5, 0, k), (-0.5, k, 0), (0.5, i, j), (-0.5, j, i)];
        let terms = terms.map(|(c, a, b)| (c, g.mul(e[a], force[b])));
        g.sum(&terms)
    };
    (1..4).map(component).collect()
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
