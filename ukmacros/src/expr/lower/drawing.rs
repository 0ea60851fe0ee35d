//! Pictures: shapes as declared, or else what bodies and joints give by themselves.

use super::array::{Value, describe};
use super::bodies::{Frame, Point};
use super::system::{Drawing, ShapeKind, ShapeValue};
use super::{Env, Lowering, Place};
use crate::diag::suggest;
use crate::expr::eval;
use crate::expr::graph::Id;
use crate::model::Scope;
use crate::parse::{Declaration, Shape};
use std::cmp::Ordering;
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

/// The points that a joint, or what acts with a force, is between; or one that is reported.
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

    /// Bodies as outlines of their centre and of the points where they are joined, pushed or reported; springs, rods and forces between
    /// points; and the places on the ground that something hangs on.
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
        for joint in between.iter().filter(|joint| joint.name != "output") {
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
                    "rod" | "force" => add(ShapeKind::Line, &[at(p), at(q)]),
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
            let centre = frame.centre(&mut self.graph).entries().to_vec();
            let mut points: Vec<Vec<Id>> = Vec::new();
            for point in between.iter().flat_map(|joint| &joint.points) {
                let place = at(point);
                if Rc::ptr_eq(&point.body, &frame) && !points.contains(&place) {
                    points.push(place);
                }
            }
            if !points.contains(&centre) {
                points.push(centre);
            }
            match &self.outline(points)[..] {
                [only] => add(ShapeKind::Mark, std::slice::from_ref(only)),
                [p, q] => add(ShapeKind::Line, &[p.clone(), q.clone()]),
                all => add(ShapeKind::Line, &[all, &all[..1]].concat()),
            }
        }
        out
    }

    /// The corners of the convex hull of points of one body, in their order around it; in space all points, if they are on no line.
    fn outline(&self, points: Vec<Vec<Id>>) -> Vec<Vec<Id>> {
        // The same wherever the body is.
        let mut q = vec![0.0; self.model.coord_elements.len()];
        self.model.quaternions().for_each(|first| q[first] = 1.0);
        let here = eval::Point {
            t: 0.0,
            q: &q,
            v: &vec![0.0; q.len()],
            ..eval::Point::of_parameters(&self.defaults)
        };
        let places = points.iter().map(|p| eval::eval(&self.graph, p, &here));
        let places: Vec<Vec<f64>> = places.collect();
        let corners = match places[0].len() {
            2 => hull(&places),
            _ => ends(&places).unwrap_or_else(|| (0..points.len()).collect()),
        };
        corners.into_iter().map(|k| points[k].clone()).collect()
    }
}

/// Points nearer to a line than this part of its length are on it.
const STRAIGHT: f64 = 1e-9;

/// From `p` to `q`.
fn way(p: &[f64], q: &[f64]) -> Vec<f64> {
    q.iter().zip(p).map(|(q, p)| q - p).collect()
}

/// The corners of the convex hull of points of the plane, by Andrew's monotone chain.
fn hull(points: &[Vec<f64>]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| {
        let pairs = points[*a].iter().zip(&points[*b]);
        pairs.fold(Ordering::Equal, |so_far, (x, y)| {
            so_far.then(x.total_cmp(y))
        })
    });
    let half = |order: &mut dyn Iterator<Item = usize>| {
        let mut chain: Vec<usize> = Vec::new();
        for k in order {
            if chain.last().is_some_and(|b| points[*b] == points[k]) {
                continue;
            }
            while let [.., a, b] = chain[..] {
                let (u, v) = (way(&points[a], &points[b]), way(&points[a], &points[k]));
                let (turn, size) = (u[0] * v[1] - u[1] * v[0], v[0] * v[0] + v[1] * v[1]);
                if turn > STRAIGHT * size {
                    break;
                }
                chain.pop();
            }
            chain.push(k);
        }
        chain
    };
    let (mut below, above) = (
        half(&mut order.iter().copied()),
        half(&mut order.iter().rev().copied()),
    );
    // Either begins where the other ends.
    below.pop();
    let inner = above.len().saturating_sub(1);
    below.extend(&above[..inner.max(usize::from(below.is_empty()))]);
    below
}

/// The ends of points that are on one line, if they are.
fn ends(points: &[Vec<f64>]) -> Option<Vec<usize>> {
    let square = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
    let farthest = |from: usize| {
        let size = |k: &usize| square(&way(&points[from], &points[*k]));
        (0..points.len()).max_by(|a, b| size(a).total_cmp(&size(b)))
    };
    let first = farthest(0)?;
    let last = farthest(first)?;
    let line = way(&points[first], &points[last]);
    let beside = |p: &Vec<f64>| {
        let v = way(&points[first], p);
        let along: f64 = v.iter().zip(&line).map(|(a, b)| a * b).sum();
        square(&v) * square(&line) - along * along
    };
    let size = square(&line);
    let straight = points.iter().all(|p| beside(p) <= STRAIGHT * size * size);
    let mut ends = vec![first.min(last), first.max(last)];
    ends.dedup();
    straight.then_some(ends)
}
