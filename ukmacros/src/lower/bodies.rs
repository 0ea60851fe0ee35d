//! Bodies: their frames, their points and what belongs to them.
//!
//! The coordinates of a body are the place of its centre of mass and its orientation: so its mass matrix, where it is planar, is diagonal
//! and constant, and points of it depend on the place with coefficients 1. Points and directions are given in the body's frame, whose
//! origin is where its `centre` says that the centre of mass is not. A body that hangs on a joint of the tree has none (see `tree`).

use super::array::{Value, describe, sum_of_products};
use super::{Env, Lowering, Place};
use crate::diag::{Loc, suggest};
use crate::model::{BodyKind, Name, Scope, Variable};
use crate::parse::{Body, Declaration, Expr, ExprKind};
use proc_macro2::Ident;
use std::fmt;
use std::rc::Rc;
use ukalgebra::expr::Derivative;
use ukalgebra::expr::Func;
use ukalgebra::expr::{Graph, Id, Symbol};
use ukunits::Dimension;

/// A body, or the ground.
pub(super) struct Frame {
    /// The name as written: `link[3]`, `ground`.
    pub(super) name: String,
    /// Nothing for the ground, whose frame is that of the coordinates.
    pub(super) moving: Option<Moving>,
}

pub(super) struct Moving {
    /// Its place among the bodies of the model.
    pub(super) position: usize,
    pub(super) kind: BodyKind,
    /// The centre of mass in the body's frame.
    pub(super) centre: Vec<Id>,
    /// A point in the body's frame: the centre of mass, or where it hangs on a joint.
    pub(super) reference: Vec<Id>,
    /// The place of that point, in axes of the ground.
    pub(super) place: Vec<Id>,
    pub(super) orientation: Orientation,
}

/// How a body is turned.
pub(super) enum Orientation {
    /// The body's own coordinates turn it: the angle or the quaternion.
    Own(Vec<Id>),
    /// A joint of the tree turns it.
    Hung(Hung),
}

/// What follows from the body before and the coordinates of the joint between.
pub(super) struct Hung {
    /// The matrix that turns vectors from the body's axes to those of the ground, by rows.
    pub(super) axes: Vec<Id>,
    /// The angle from the ground, in the plane.
    pub(super) angle: Id,
    /// The angular velocity in axes of the body, one number in the plane.
    pub(super) omega: Vec<Id>,
    /// The velocity of the reference, in axes of the body.
    pub(super) velocity: Vec<Id>,
}

/// A point of a body.
pub(super) struct Point {
    pub(super) body: Rc<Frame>,
    /// The place of the point, in axes of the ground.
    pub(super) place: Value,
    /// Its place in the body's frame.
    pub(super) within: Value,
}

/// A body as declared, with the loop variables around it.
pub(super) struct Declared {
    pub(super) body: Body,
    pub(super) variables: Vec<Variable>,
    /// The body's frame, once it is used.
    pub(super) frame: Option<Rc<Frame>>,
}

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

impl Point {
    /// A point that is there whatever moves: its place in the body does not matter.
    pub(super) fn of(body: Rc<Frame>, place: Value) -> Value {
        let within = Value::vector(Vec::new());
        Value::Point(Rc::new(Point {
            body,
            place,
            within,
        }))
    }
}

impl Frame {
    pub(super) fn ground() -> Rc<Self> {
        Rc::new(Frame {
            name: "ground".to_owned(),
            moving: None,
        })
    }

    /// The length of vectors where it lives; nothing for the ground, which lives anywhere.
    pub(super) fn dimension(&self) -> Option<usize> {
        let moving = self.moving.as_ref()?;
        Some(if moving.kind.spatial { 3 } else { 2 })
    }

    /// The place of the point `p` of the frame, in axes of the ground.
    pub(super) fn at(&self, p: &Value, g: &mut Graph) -> Value {
        let Some(moving) = &self.moving else {
            return p.clone();
        };
        let arms = p.entries().iter().zip(&moving.reference);
        let arms: Vec<Id> = arms.map(|(p, c)| g.sub(*p, *c)).collect();
        let rows = moving.rotation(g);
        let rows = rows.chunks(arms.len()).zip(&moving.place);
        let sums = rows.map(|(row, place)| {
            let mut terms = vec![(1.0, *place)];
            let products = row.iter().zip(&arms);
            terms.extend(products.map(|(a, b)| (1.0, g.mul(*a, *b))));
            g.sum(&terms)
        });
        Value::vector(sums.collect())
    }

    /// The place of the centre of mass; nothing of the ground.
    pub(super) fn centre(&self, g: &mut Graph) -> Value {
        match &self.moving {
            Some(moving) if matches!(moving.orientation, Orientation::Own(_)) => {
                Value::vector(moving.place.clone())
            }
            Some(moving) => self.at(&Value::vector(moving.centre.clone()), g),
            None => Value::vector(Vec::new()),
        }
    }

    /// The coordinate called `name`, or what it would be if it had its own.
    fn coordinate(&self, name: &str, g: &mut Graph) -> Option<Id> {
        let moving = self.moving.as_ref()?;
        let k = moving.kind.coordinates().iter().position(|c| *c == name)?;
        match (&moving.orientation, self.dimension()?) {
            (Orientation::Own(own), _) => moving.place.iter().chain(own).nth(k).copied(),
            (Orientation::Hung(_), n) if k < n => self.centre(g).entries().get(k).copied(),
            (Orientation::Hung(hung), 2) => Some(hung.angle),
            _ => None,
        }
    }

    /// The direction `d` of its frame in axes of the ground.
    pub(super) fn along(&self, d: &Value, g: &mut Graph) -> Value {
        let Some(moving) = &self.moving else {
            return d.clone();
        };
        let rows = moving.rotation(g);
        let rows = rows.chunks(d.entries().len());
        let sums = rows.map(|row| sum_of_products(row.iter().zip(d.entries()), g));
        Value::vector(sums.collect())
    }
}

impl Moving {
    /// The matrix that turns vectors from its axes to those of the ground, by rows.
    pub(super) fn rotation(&self, g: &mut Graph) -> Vec<Id> {
        match &self.orientation {
            Orientation::Hung(hung) => hung.axes.clone(),
            Orientation::Own(own) => turned(own, g),
        }
    }

    /// The angular velocity: about the axis out of the plane, or a vector in axes of the ground or the body's own.
    pub(super) fn omega(&self, own: bool, g: &mut Graph) -> Value {
        match &self.orientation {
            Orientation::Own(coordinates) => turning(coordinates, own, g),
            Orientation::Hung(hung) if own || !self.kind.spatial => match hung.omega[..] {
                [rate] => Value::Scalar(rate),
                _ => Value::vector(hung.omega.clone()),
            },
            Orientation::Hung(hung) => {
                let axes = Value::new(&[3, 3], hung.axes.clone());
                axes.times(&Value::vector(hung.omega.clone()), g)
            }
        }
    }
}

/// The matrix by rows that turns vectors as an angle does, or a unit quaternion.
pub(super) fn turned(own: &[Id], g: &mut Graph) -> Vec<Id> {
    if let [angle] = *own {
        let (c, s) = (g.call1(Func::Cos, angle), g.call1(Func::Sin, angle));
        return vec![c, g.neg(s), s, c];
    }
    let (e, one) = (own, g.one());
    let mut entries = Vec::with_capacity(9);
    for i in 1..4 {
        for j in 1..4 {
            // 1 − 2 (eₖ² + eₗ²) on the diagonal, 2 (eᵢ eⱼ ∓ e₀ eₖ) beside it.
            let k = if i == j { i % 3 + 1 } else { 6 - i - j };
            let entry = if i == j {
                let (a, b) = (g.square(e[k]), g.square(e[6 - i - k]));
                g.sum(&[(1.0, one), (-2.0, a), (-2.0, b)])
            } else {
                let sign = if j % 3 + 1 == i { 1.0 } else { -1.0 };
                let (a, b) = (g.mul(e[i], e[j]), g.mul(e[0], e[k]));
                g.sum(&[(2.0, a), (2.0 * sign, b)])
            };
            entries.push(entry);
        }
    }
    entries
}

/// The angular velocity of what is turned as an angle says, or a unit quaternion: in the axes before the turn, or its `own` after it.
pub(super) fn turning(e: &[Id], own: bool, g: &mut Graph) -> Value {
    let mut total = Derivative::total();
    let v: Vec<Id> = e.iter().map(|id| total.of(*id, g)).collect();
    if let [rate] = v[..] {
        return Value::Scalar(rate);
    }
    // 2 (e₀ ė − ė₀ e ± e × ė)
    let sign = if own { -2.0 } else { 2.0 };
    let component = |k: usize| {
        let (i, j) = (k % 3 + 1, (k + 1) % 3 + 1);
        let terms = [(2.0, 0, k), (-2.0, k, 0), (sign, i, j), (-sign, j, i)];
        let terms = terms.map(|(c, a, b)| (c, g.mul(e[a], v[b])));
        g.sum(&terms)
    };
    Value::vector((1..4).map(component).collect())
}

/// What of a body is no coordinate.
pub(super) const FIELDS: [&str; 4] = ["centre", "omega", "spin", "axes"];

impl<'m> Lowering<'m> {
    /// Enters the bodies of the declaration, in the order of their members.
    pub(super) fn declare_bodies(&mut self, decl: &Declaration, top: &Scope<'m>) {
        let model = self.model;
        let count = model.body_elements.len();
        let mut found: Vec<Option<Declared>> = (0..count).map(|_| None).collect();
        top.unroll(&decl.bodies, self.diag, &mut |body, scope| {
            let Some(Name::Body(family)) = model.names.get(&body.key.name.to_string()) else {
                return;
            };
            let members = &model.bodies[*family].members;
            let chosen = match scope.variables.is_empty() {
                true => members.clone(),
                false => {
                    let member = self.member(
                        &body.key.name,
                        &body.key.indices,
                        &model.bodies[*family],
                        scope,
                    );
                    member.map_or(Vec::new(), |(positions, _)| positions.to_vec())
                }
            };
            for position in chosen {
                found[position].get_or_insert_with(|| Declared {
                    body: body.clone(),
                    variables: scope.variables.clone(),
                    frame: None,
                });
            }
        });
        self.bodies = found;
    }

    /// The body that `name` and `indices` choose.
    pub(super) fn body(
        &mut self,
        name: &Ident,
        family: usize,
        indices: &[Expr],
        env: &Env<'m>,
    ) -> Value {
        let bodies = &self.model.bodies[family];
        if let Some(surplus) = indices.get(bodies.shape.len()) {
            let message = match bodies.shape.len() {
                0 => format!("`{name}` is one body; write it without an index"),
                n => format!(
                    "bodies of `{name}` take {n} ind{}",
                    if n == 1 { "ex" } else { "ices" }
                ),
            };
            return self.error(surplus.loc, message);
        }
        let Some((positions, shape)) = self.member(name, indices, bodies, &env.scope) else {
            return Value::Error;
        };
        let [position] = positions else {
            let members = super::keys::range_of(name, &bodies.shape);
            let message = format!("`{name}` is a family of bodies; choose a member, {members}");
            return self.error(name.span(), message);
        };
        debug_assert!(shape.is_empty(), "one body has no shape");
        // What depends on coordinates may not stand everywhere.
        if let Some(first) = self.moves_by(*position)
            && self
                .allowed(Symbol::Coord(first), name.span(), env)
                .is_error()
        {
            return Value::Error;
        }
        if self.pending.contains(position) {
            let message = format!("where `{name}` sits cannot depend on `{name}` itself");
            return self.error(name.span(), message);
        }
        self.frame(*position).map_or(Value::Error, Value::Body)
    }

    /// The frame of the body at `position`.
    pub(super) fn frame(&mut self, position: usize) -> Option<Rc<Frame>> {
        let declared = self.bodies.get_mut(position)?.as_mut()?;
        if let Some(frame) = &declared.frame {
            return Some(frame.clone());
        }
        // Those that it hangs on come first.
        let mut chain = vec![position];
        while let Some(joint) = self.model.hung[chain[chain.len() - 1]]
            && let Some(parent) = self.model.joints[joint].parent
            && self.bodies[parent].as_ref()?.frame.is_none()
        {
            chain.push(parent);
        }
        for body in chain.into_iter().rev() {
            self.pending.push(body);
            self.place(body);
            self.pending.pop();
        }
        self.bodies[position].as_ref()?.frame.clone()
    }

    /// Makes the frame of the body at `position`, which hangs on none, or on one whose frame is known.
    fn place(&mut self, position: usize) {
        let Some(declared) = &self.bodies[position] else {
            return;
        };
        let (centre, variables) = (declared.body.centre.clone(), declared.variables.clone());
        let element = &self.model.body_elements[position];
        let kind = self.model.body_kinds[element.family];
        let dimension = if kind.spatial { 3 } else { 2 };
        let mut own: Vec<Id> = Vec::new();
        if let Some(first) = self.model.own[position] {
            let symbols = (first..).take(kind.coordinates().len()).map(Symbol::Coord);
            own.extend(symbols.map(|s| self.graph.symbol(s)));
        }
        let mut c = vec![self.graph.zero(); dimension];
        if let Some(e) = centre {
            let value = self.part_of_body(&e, &variables);
            self.expect_all(&value, Dimension::LENGTH, "a place", e.loc);
            if let Some(entries) = self.of_shape(&value, &[dimension], e.loc) {
                c = entries;
            }
        }
        let moving = match self.model.hung[position] {
            Some(joint) => self.hung(position, joint, c),
            None => Some(Moving {
                position,
                kind,
                reference: c.clone(),
                centre: c,
                orientation: Orientation::Own(own.split_off(dimension)),
                place: own,
            }),
        };
        if let (Some(Some(declared)), Some(moving)) = (self.bodies.get_mut(position), moving) {
            let hangs = Value::vector(moving.place.clone());
            let frame = Rc::new(Frame {
                name: element.name.clone(),
                moving: Some(moving),
            });
            declared.frame = Some(frame.clone());
            if self.model.hung[position].is_some() {
                self.note("tree", &[Point::of(frame, hangs)]);
            }
        }
    }

    /// What a body consists of.
    pub(super) fn part_of_body(&mut self, e: &Expr, variables: &[Variable]) -> Value {
        let scope = Scope::with(self.model, variables.to_vec());
        self.value(e, &Env::new(&scope, Place::Body))
    }

    /// The numbers of `value`, if it has this shape; reports it, if not.
    pub(super) fn of_shape(&mut self, value: &Value, shape: &[usize], loc: Loc) -> Option<Vec<Id>> {
        if value.is_error() {
            return None;
        }
        if value.shape() != shape {
            let (expected, found) = (describe(shape), describe(value.shape()));
            self.error(loc, format!("expected {expected}, found {found}"));
            return None;
        }
        Some(value.entries().to_vec())
    }

    /// `body.at(p)`, `body.along(d)`: also of the body that a point belongs to.
    pub(super) fn of_body(
        &mut self,
        e: &Expr,
        name: &Ident,
        args: &[Expr],
        env: &Env<'m>,
    ) -> Value {
        let [body, v] = args else {
            let message = format!("`{name}` takes one vector: `body.{name}([1, 0])`");
            return self.error(name.span(), message);
        };
        let frame = match self.argument(body, env) {
            Value::Body(frame) => frame,
            Value::Point(point) => point.body.clone(),
            Value::Error => return Value::Error,
            value => {
                let found = describe(value.shape());
                return self.error(body.loc, format!("`{name}` is of a body, found {found}"));
            }
        };
        let value = self.value(v, env);
        if name == "at" {
            self.expect_all(&value, Dimension::LENGTH, "a place", v.loc);
        }
        let fits = match frame.dimension() {
            Some(n) => value.shape() == [n],
            None => matches!(value.shape(), [2 | 3]),
        };
        if value.is_error() {
            return Value::Error;
        }
        if !fits {
            let expected = frame
                .dimension()
                .map_or("a vector of 2 or 3".to_owned(), |n| describe(&[n]));
            let found = describe(value.shape());
            return self.error(
                v.loc,
                format!("`{frame}.{name}` takes {expected}, found {found}"),
            );
        }
        let value = match name == "at" {
            true => Value::Point(Rc::new(Point {
                place: frame.at(&value, &mut self.graph),
                body: frame,
                within: value,
            })),
            false => frame.along(&value, &mut self.graph),
        };
        self.allowed_value(value, e.loc, env)
    }

    fn is_known(&self, name: &Ident, env: &Env<'m>) -> bool {
        let text = name.to_string();
        let declared = self.model.names.contains_key(&text) || self.lets.contains_key(&text);
        declared || text == "ground" || env.args.iter().any(|(n, _)| *n == text)
    }

    /// The message about a `name` before a dot that is none of a body, a joint of the tree or a part; nothing where there are none.
    pub(super) fn no_owner(&self, name: &str) -> Option<String> {
        let owners = self.model.names.iter().filter_map(|(owner, what)| {
            let fields = matches!(what, Name::Body(_) | Name::Joint | Name::Part);
            fields.then_some(owner.as_str())
        });
        let mut owners: Vec<&str> = owners.collect();
        owners.sort_unstable();
        let shown = owners.get(..owners.len().min(8))?.join("`, `");
        let remedy = format!("what has fields here is `{shown}`");
        let end = suggest(name, owners.iter().copied(), &remedy);
        (!owners.is_empty()).then(|| format!("unknown name `{name}`{end}"))
    }

    /// `body.angle`.
    pub(super) fn field(&mut self, base: &Expr, name: &Ident, env: &Env<'m>) -> Value {
        if let Some(value) = self.of_joint(base, name, env) {
            return value;
        }
        let value = match &base.kind {
            ExprKind::Name(owner) if !self.is_known(owner, env) => {
                let text = owner.to_string();
                match self.no_owner(&text) {
                    // Once for all its uses.
                    _ if self.unknown.contains(&text) => return Value::Error,
                    _ if self.results.contains_key(&text) => Some(self.argument(base, env)),
                    // Perhaps a struct of Rust: `self.m`.
                    Some(message) if !self.model.names.contains_key(&name.to_string()) => {
                        self.unknown.insert(text);
                        return self.error(owner.span(), message);
                    }
                    _ => None,
                }
            }
            _ => Some(self.argument(base, env)),
        };
        // The ground is a plane, or a space, where a point of it is given.
        let mut in_space = false;
        let frame = match value {
            Some(Value::Body(frame)) => frame,
            Some(Value::Point(point)) if self.written && name == "within" => {
                return point.within.clone();
            }
            Some(Value::Point(point)) => {
                in_space = point.place.shape() == [3];
                point.body.clone()
            }
            Some(Value::Error) => return Value::Error,
            _ => {
                let message = "no fields here; a parameter or coordinate is written by its name alone, such as `m`";
                return self.error(name.span(), message);
            }
        };
        let text = name.to_string();
        let Some(moving) = &frame.moving else {
            return match text.as_str() {
                "omega" if in_space => Value::vector(vec![self.graph.zero(); 3]),
                "angle" | "omega" => Value::Scalar(self.graph.zero()),
                _ => self.error(
                    name.span(),
                    format!(
                        "the ground has no `{text}`; it has `at`, `along`, `angle` and `omega`"
                    ),
                ),
            };
        };
        let dimension = frame.dimension().unwrap_or_default();
        let value = match text.as_str() {
            "omega" => moving.omega(false, &mut self.graph),
            "centre" => frame.centre(&mut self.graph),
            "axes" => Value::new(&[dimension, dimension], moving.rotation(&mut self.graph)),
            "spin" if moving.kind.spatial => self.spin(&frame),
            text => match frame.coordinate(text, &mut self.graph) {
                Some(id) => Value::Scalar(id),
                None => return self.no_field(&frame, moving, name),
            },
        };
        self.allowed_value(value, name.span().into(), env)
    }

    /// Reports that a body has nothing of this `name`.
    fn no_field(&mut self, frame: &Frame, moving: &Moving, name: &Ident) -> Value {
        let coordinates = moving.kind.coordinates();
        let quaternion = coordinates.iter().any(|c| name == c);
        let text = name.to_string();
        if quaternion {
            let message = format!(
                "`{frame}` hangs on a joint of the tree and has no quaternion; its orientation is `{frame}.axes`"
            );
            return self.error(name.span(), message);
        }
        let names = coordinates.iter().chain(&FIELDS).copied();
        let remedy = format!(
            "it has `{}`, `at` and `along`",
            names.clone().collect::<Vec<_>>().join("`, `")
        );
        let end = suggest(&text, names, &remedy);
        self.error(name.span(), format!("body `{frame}` has no `{text}`{end}"))
    }

    /// The angular velocity of a spatial body in its own axes, in which its inertia is constant.
    pub(super) fn spin(&mut self, frame: &Frame) -> Value {
        let Some(moving) = &frame.moving else {
            return Value::Scalar(self.graph.zero());
        };
        let spin = moving.omega(true, &mut self.graph);
        if let Orientation::Own(_) = moving.orientation {
            // The graph keeps the factor 2 apart.
            let halves = spin.map(|id| self.graph.unscaled(id).1);
            self.hint(&format!("{frame}.half_spin"), &halves);
        }
        spin
    }
}
