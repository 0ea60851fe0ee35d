//! Pictures: shapes as declared, or else what bodies and joints give by themselves.

use super::array::{Value, describe};
use super::bodies::{Frame, Point};
use super::{Env, Lowering, Place};
use crate::diag::{Loc, suggest};
use crate::model::Scope;
use crate::parse::{Declaration, Shape};
use std::cmp::Ordering;
use std::f64::consts::TAU;
use std::rc::Rc;
use ukalgebra::expr::Id;
use ukalgebra::expr::{self, eval};
use ukalgebra::expr::{Drawing, ShapeKind, ShapeValue};

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

/// Sides of the polygon that stands for a round rim.
const SIDES: u32 = 36;

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

    /// Remembers the rim of what rolls about the point `q` of the joint `name` with the radius `r`, and a spoke that shows how it turns.
    pub(super) fn rim(&mut self, name: &str, loc: Loc, inner: &Env<'m>) {
        let axes = match name {
            "wheel" | "rack" => ["r * q.along([1, 0])", "r * q.along([0, 1])"],
            "disc" => ["r * q.along(normals(u)[0])", "r * q.along(normals(u)[1])"],
            _ => return,
        };
        let Some((_, Value::Point(q))) = inner.args.iter().find(|(name, _)| name == "q") else {
            return;
        };
        let axes = axes.map(|text| self.written(text, loc, inner));
        let [first, second] = [&axes[0], &axes[1]].map(Value::entries);
        let mut numbers = q.place.entries().to_vec();
        for k in 0..=SIDES {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
            let at = q.place.entries().iter().zip(first).zip(second);
            let at = at.map(|((q, a), b)| self.graph.sum(&[(1.0, *q), (cos, *a), (sin, *b)]));
            numbers.extend(at);
        }
        self.rims.push(ShapeValue {
            kind: ShapeKind::Line,
            numbers,
            label: String::new(),
        });
    }

    /// What is drawn.
    pub(super) fn drawing(&mut self, decl: &Declaration, top: &Scope<'m>) -> Drawing {
        if !decl.sections.contains_key("draw") {
            return self.skeleton();
        }
        let mut out = Drawing::default();
        top.unroll(&decl.drawing, self.diag, &mut |shape, scope| {
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

    /// Rims of what rolls; bodies as outlines of their centre and of the points where they are joined, pushed or reported; springs, rods
    /// and forces between points; and the places on the ground that something hangs on.
    fn skeleton(&mut self) -> Drawing {
        let between = std::mem::take(&mut self.between);
        let mut out = Drawing {
            shapes: std::mem::take(&mut self.rims),
            ..Drawing::default()
        };
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
            let hub = points.iter().position(|place| *place == centre);
            let hub = hub.unwrap_or_else(|| {
                points.push(centre);
                points.len() - 1
            });
            match &self.outline(points, hub)[..] {
                [only] => add(ShapeKind::Mark, std::slice::from_ref(only)),
                line => add(ShapeKind::Line, line),
            }
        }
        out
    }

    /// A line through points of one body: around their convex hull where they lie in a plane, from end to end where they lie on a line, and
    /// otherwise from one to the other by way of the point `hub`.
    fn outline(&self, points: Vec<Vec<Id>>, hub: usize) -> Vec<Vec<Id>> {
        // The same wherever the body is.
        let mut q = vec![0.0; self.model.coord_elements.len()];
        self.model.quaternions().for_each(|first| q[first] = 1.0);
        let here = expr::Point {
            t: 0.0,
            q: &q,
            v: &vec![0.0; q.len()],
            ..expr::Point::of_parameters(&self.defaults)
        };
        let places = points.iter().map(|p| eval(&self.graph, p, &here));
        let places: Vec<Vec<f64>> = places.collect();
        let line: Vec<usize> = match in_plane(&places) {
            Some(flat) => {
                let mut corners = hull(&flat);
                if corners.len() > 2 {
                    corners.push(corners[0]);
                }
                corners
            }
            None => {
                let others = (0..points.len()).filter(|k| *k != hub);
                let there_and_back = others.flat_map(|k| [k, hub]);
                std::iter::once(hub).chain(there_and_back).collect()
            }
        };
        line.into_iter().map(|k| points[k].clone()).collect()
    }
}

/// Points nearer to a line or a plane than this part of its length are on it.
const STRAIGHT: f64 = 1e-9;

/// The way from `p` to `q`.
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

/// Two coordinates of points that lie in one plane, if they do: of points of space along their greatest distance from the first one, and
/// across it.
fn in_plane(points: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    if points[0].len() == 2 {
        return Some(points.to_vec());
    }
    let inner = |u: &[f64], v: &[f64]| u.iter().zip(v).map(|(a, b)| a * b).sum::<f64>();
    let mut left: Vec<Vec<f64>> = points.iter().map(|p| way(&points[0], p)).collect();
    let longest = |left: &[Vec<f64>]| {
        let square = |v: &&Vec<f64>| inner(v, v);
        let found = left.iter().max_by(|u, v| square(u).total_cmp(&square(v)));
        found.map_or(Vec::new(), Clone::clone)
    };
    let size = inner(&longest(&left), &longest(&left));
    let mut flat = vec![Vec::new(); points.len()];
    for _ in 0..2 {
        let axis = longest(&left);
        let square = inner(&axis, &axis);
        for (rest, flat) in left.iter_mut().zip(&mut flat) {
            let share = if square > STRAIGHT * STRAIGHT * size {
                inner(rest, &axis) / square
            } else {
                0.0
            };
            flat.push(share * square.sqrt());
            rest.iter_mut()
                .zip(&axis)
                .for_each(|(x, a)| *x -= share * a);
        }
    }
    let beside = longest(&left);
    (inner(&beside, &beside) <= STRAIGHT * STRAIGHT * size).then_some(flat)
}
