//! Pictures: shapes as declared, or else what bodies and joints give by themselves.

use super::array::{Value, describe};
use super::bodies::{Frame, Point};
use super::system::{Drawing, ShapeKind, ShapeValue};
use super::{Env, Lowering, Place};
use crate::diag::suggest;
use crate::expr::graph::Id;
use crate::model::Scope;
use crate::parse::{Declaration, Shape};
use std::rc::Rc;

/// Shapes by name: what they are, and how many points they take at least and at most.
const SHAPES: [(&str, ShapeKind, usize, usize); 6] = [
    ("line", ShapeKind::Line, 2, 2),
    ("polyline", ShapeKind::Line, 2, usize::MAX),
    ("circle", ShapeKind::Circle, 1, 1),
    ("spring", ShapeKind::Spring, 2, 2),
    ("trace", ShapeKind::Trace, 1, 1),
    ("text", ShapeKind::Text, 1, 1),
];

/// How shapes are written.
const USAGE: &str = "`line(p, q)`, `polyline(p, q, …)`, `circle(centre, radius)`, `spring(p, q)`, `trace(p)`, `text(p, \"…\")`";

/// The points that a joint, or what acts with a force, is between.
pub(super) struct Between {
    name: &'static str,
    points: Vec<Rc<Point>>,
}

impl<'m> Lowering<'m> {
    /// Remembers the points that `name` joins.
    pub(super) fn note(&mut self, name: &'static str, values: &[Value]) {
        let points = values.iter().filter_map(|value| match value {
            Value::Point(point) => Some(point.clone()),
            _ => None,
        });
        let points = points.collect();
        self.between.push(Between { name, points });
    }

    /// What is drawn.
    pub(super) fn drawing(&mut self, decl: &Declaration, top: &Scope<'m>) -> Drawing {
        let Some(section) = &decl.drawing else {
            return self.skeleton();
        };
        let mut out = Drawing::default();
        top.unroll(&section.blocks, self.diag, &mut |shape, scope| {
            self.shape(shape, &Env::new(scope, Place::Output), &mut out);
        });
        out
    }

    fn shape(&mut self, shape: &Shape, env: &Env<'m>, out: &mut Drawing) {
        let name = shape.name.to_string();
        let Some((_, kind, least, most)) = SHAPES.into_iter().find(|row| row.0 == name) else {
            let end = suggest(
                &name,
                SHAPES.map(|row| row.0),
                &format!("shapes are {USAGE}"),
            );
            self.diag
                .error(shape.name.span(), format!("unknown shape `{name}`{end}"));
            return;
        };
        let radii = usize::from(kind == ShapeKind::Circle);
        let points = shape.args.len().saturating_sub(radii);
        let fits = (least..=most).contains(&points) && shape.args.len() >= radii;
        if !fits || shape.label.is_some() != (kind == ShapeKind::Text) {
            self.diag
                .error(shape.name.span(), format!("shapes are written {USAGE}"));
            return;
        }
        let mut numbers: Vec<Id> = Vec::new();
        for (k, e) in shape.args.iter().enumerate() {
            let value = self.argument(e, env);
            if value.is_error() {
                return;
            }
            let found = match &value {
                Value::Body(body) => {
                    format!("the body `{body}`; a point of it is written `{body}.at([x, y])`")
                }
                _ => describe(value.shape()),
            };
            let is_body = matches!(value, Value::Body(_));
            let refusal = match value.shape() {
                [] if k >= points && !is_body => None,
                _ if k >= points => Some(format!("expected a number, found {found}")),
                [dimension @ 2..=3] if [0, *dimension].contains(&out.dimension) => {
                    out.dimension = *dimension;
                    None
                }
                [2..=3] => Some(format!(
                    "found {found} in a picture whose first point has {} coordinates",
                    out.dimension
                )),
                _ => Some(format!(
                    "expected a point of 2 or 3 coordinates, found {found}"
                )),
            };
            if let Some(message) = refusal {
                self.diag.error(e.loc, message);
                return;
            }
            numbers.extend_from_slice(value.entries());
        }
        out.shapes.push(ShapeValue {
            kind,
            numbers,
            label: shape.label.clone().unwrap_or_default(),
        });
    }

    /// Bodies as lines through the points where they are joined, springs, rods, and the places on the ground that something hangs on.
    fn skeleton(&mut self) -> Drawing {
        let between = std::mem::take(&mut self.between);
        let mut out = Drawing::default();
        let mut add = |kind, points: &[Vec<Id>]| {
            out.dimension = points[0].len();
            out.shapes.push(ShapeValue {
                kind,
                numbers: points.concat(),
                label: String::new(),
            });
        };
        let at = |point: &Rc<Point>| point.place.entries().to_vec();
        let mut grounded: Vec<Vec<Id>> = Vec::new();
        for joint in &between {
            let of_ground = joint.points.iter().filter(|p| p.body.dimension().is_none());
            for place in of_ground.map(at) {
                if !grounded.contains(&place) {
                    add(ShapeKind::Support, std::slice::from_ref(&place));
                    grounded.push(place);
                }
            }
            if let [p, q] = &joint.points[..] {
                match joint.name {
                    "spring" | "damper" => add(ShapeKind::Spring, &[at(p), at(q)]),
                    "rod" => add(ShapeKind::Line, &[at(p), at(q)]),
                    _ => {}
                }
            }
        }
        let frames = self
            .bodies
            .iter()
            .flatten()
            .filter_map(|body| body.frame.clone());
        let frames: Vec<Rc<Frame>> = frames.collect();
        for frame in frames {
            let Some(centre) = frame.middle(&mut self.graph) else {
                continue;
            };
            let mut points: Vec<Vec<Id>> = Vec::new();
            for point in between.iter().flat_map(|joint| &joint.points) {
                let place = at(point);
                if Rc::ptr_eq(&point.body, &frame) && !points.contains(&place) {
                    points.push(place);
                }
            }
            match &points[..] {
                [] => add(ShapeKind::Mark, &[centre]),
                [only] if *only == centre => add(ShapeKind::Mark, &[centre]),
                [only] => add(ShapeKind::Line, &[centre, only.clone()]),
                [_, _] => add(ShapeKind::Line, &points),
                [first, ..] => {
                    let closed = [&points[..], std::slice::from_ref(first)].concat();
                    add(ShapeKind::Line, &closed);
                }
            }
        }
        out
    }
}
