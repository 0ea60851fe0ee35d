//! Bodies that hang on joints of the tree: their frames, velocities and energies, from those of the body before.
//!
//! The velocities are in axes of each body, where those of the body before go into them with coefficients of one joint's coordinates: T
//! written in them is what the elimination lifts.

use super::array::{Value, sum_of_products};
use super::bodies::{Frame, Hung, Moving, Orientation, Point, turned, turning};
use super::vectors::cross;
use super::{Env, Lowering, Place};
use crate::diag::Loc;
use crate::model::{Joint, Scope, Step};
use crate::parse::{Expr, ExprKind};
use std::rc::Rc;
use ukalgebra::expr::Derivative;
use ukalgebra::expr::Func;
use ukalgebra::expr::eval;
use ukalgebra::expr::{Graph, Id, Symbol};
use ukunits::Dimension;

/// A frame on its way from one body to the next.
struct Moved {
    axes: Value,
    place: Value,
    omega: Value,
    velocity: Value,
    angle: Id,
}

impl Moved {
    /// Turned by the matrix `turn`.
    fn turn(&mut self, turn: &Value, g: &mut Graph) {
        self.axes = self.axes.times(turn, g);
        let back = turn.transposed().unwrap_or(Value::Error);
        self.velocity = back.times(&self.velocity, g);
        if self.omega.shape() == [3] {
            self.omega = back.times(&self.omega, g);
        }
    }

    /// Displaced by `arm`, a vector of its axes.
    fn shift(&mut self, arm: &Value, g: &mut Graph) {
        let off = self.axes.times(arm, g);
        self.place = plus(&self.place, &off, g);
        let swept = swept(&self.omega, arm, g);
        self.velocity = plus(&self.velocity, &swept, g);
    }
}

/// u + v.
fn plus(u: &Value, v: &Value, g: &mut Graph) -> Value {
    let pairs = u.entries().iter().zip(v.entries());
    let sums = pairs.map(|(a, b)| g.sum(&[(1.0, *a), (1.0, *b)]));
    Value::new(u.shape(), sums.collect())
}

/// ω × r, where ω is a number in the plane.
fn swept(omega: &Value, r: &Value, g: &mut Graph) -> Value {
    match (omega, r.entries()) {
        (Value::Scalar(rate), [x, y]) => {
            let (across, up) = (g.mul(*rate, *y), g.mul(*rate, *x));
            Value::vector(vec![g.neg(across), up])
        }
        _ => cross(g, omega, r).unwrap_or(Value::Error),
    }
}

/// `k v`.
fn scaled(k: Id, v: &Value, g: &mut Graph) -> Value {
    v.map(|id| g.mul(k, id))
}

fn identity(n: usize, g: &mut Graph) -> Value {
    let (zero, one) = (g.zero(), g.one());
    let places = (0..n * n).map(|k| if k % (n + 1) == 0 { one } else { zero });
    Value::new(&[n, n], places.collect())
}

/// The matrix that turns by `angle` about the unit vector `u`.
fn about(u: &Value, angle: Id, g: &mut Graph) -> Value {
    let (c, s) = (g.call1(Func::Cos, angle), g.call1(Func::Sin, angle));
    let (zero, one) = (g.zero(), g.one());
    let u = u.entries();
    let mut entries = Vec::with_capacity(9);
    for i in 0..3 {
        for j in 0..3 {
            // uᵢ uⱼ (1 − c) + δᵢⱼ c ∓ uₖ s
            let uu = g.mul(u[i], u[j]);
            let delta = if i == j { one } else { zero };
            let rest = g.sub(delta, uu);
            let mut terms = vec![(1.0, uu), (1.0, g.mul(rest, c))];
            if i != j {
                let sign = if (i + 1) % 3 == j { -1.0 } else { 1.0 };
                terms.push((sign, g.mul(u[3 - i - j], s)));
            }
            entries.push(g.sum(&terms));
        }
    }
    Value::new(&[3, 3], entries)
}

impl Frame {
    /// The frame of its axes at its reference, as it moves; of the ground in so many dimensions.
    fn moved(&self, dimension: usize, g: &mut Graph) -> Moved {
        let zero = g.zero();
        let Some(moving) = &self.moving else {
            return Moved {
                axes: identity(dimension, g),
                place: Value::vector(vec![zero; dimension]),
                omega: match dimension {
                    2 => Value::Scalar(zero),
                    _ => Value::vector(vec![zero; 3]),
                },
                velocity: Value::vector(vec![zero; dimension]),
                angle: zero,
            };
        };
        let axes = Value::new(&[dimension, dimension], moving.rotation(g));
        let (velocity, angle) = match &moving.orientation {
            Orientation::Hung(hung) => (Value::vector(hung.velocity.clone()), hung.angle),
            Orientation::Own(own) => {
                let mut total = Derivative::total();
                let rates = moving.place.iter().map(|id| total.of(*id, g)).collect();
                let rates = Value::vector(rates);
                let angle = if own.len() == 1 { own[0] } else { zero };
                (
                    axes.transposed().unwrap_or(Value::Error).times(&rates, g),
                    angle,
                )
            }
        };
        Moved {
            axes,
            place: Value::vector(moving.place.clone()),
            omega: moving.omega(true, g),
            velocity,
            angle,
        }
    }
}

impl<'m> Lowering<'m> {
    /// A coordinate that the body at `position` moves with, if it moves.
    pub(super) fn moves_by(&self, position: usize) -> Option<usize> {
        let mut carriers = self.model.carriers(position);
        carriers.find_map(|body| self.model.moving(body).next())
    }

    /// The frame of the body at `position`, whose centre of mass is at `centre`, which hangs on the joint number `joint`.
    pub(super) fn hung(
        &mut self,
        position: usize,
        joint: usize,
        centre: Vec<Id>,
    ) -> Option<Moving> {
        let joint = &self.model.joints[joint];
        let body = &self.model.body_elements[position];
        let kind = self.model.body_kinds[body.family];
        let dimension = centre.len();
        let carrier = match joint.parent {
            Some(parent) => self.bodies[parent].as_ref()?.frame.clone()?,
            None => Frame::ground(),
        };
        let itself = Rc::new(Frame {
            name: body.name.clone(),
            moving: Some(Moving {
                position,
                kind,
                centre: centre.clone(),
                reference: Vec::new(),
                place: Vec::new(),
                orientation: Orientation::Own(Vec::new()),
            }),
        });
        let scope = Scope::with(self.model, joint.variables.clone());
        let env = Env::new(&scope, Place::Joint);
        // The two points in their bodies.
        let mut values = Vec::new();
        for (arg, body) in joint.args.iter().zip([&carrier, &itself]) {
            let ExprKind::Call(_, parts) = &arg.kind else {
                return None;
            };
            let v = self.value(&parts[1], &env);
            self.expect_all(&v, Dimension::LENGTH, "a place", parts[1].loc);
            let v = self.of_shape(&v, &[dimension], parts[1].loc)?;
            values.push(Point::of(body.clone(), Value::vector(v)));
        }
        let (from, reference) = (values[0].entries().to_vec(), values[1].entries().to_vec());
        values.extend(joint.args[2..].iter().map(|arg| self.argument(arg, &env)));
        let (_, inner) = self.part_with(&joint.call, &joint.args, &values)?;
        let from_place = carrier.at(&Value::vector(from.clone()), &mut self.graph);
        let mut moved = carrier.moved(dimension, &mut self.graph);
        let start = match &carrier.moving {
            Some(moving) => moving.reference.clone(),
            None => vec![self.graph.zero(); dimension],
        };
        let arm = from.iter().zip(&start).map(|(p, s)| self.graph.sub(*p, *s));
        let arm = Value::vector(arm.collect());
        moved.shift(&arm, &mut self.graph);
        let mut next = joint.first;
        for step in joint.kind.steps {
            self.step(step, &mut next, &mut moved, &inner, joint)?;
        }
        self.note(joint.kind.name, &[Point::of(carrier, from_place)]);
        let name = &body.name;
        self.hint(&format!("{name}.axes"), &moved.axes);
        self.hint(&format!("{name}.spin"), &moved.omega);
        self.hint(&format!("{name}.velocity"), &moved.velocity);
        Some(Moving {
            position,
            kind,
            centre,
            reference,
            place: moved.place.entries().to_vec(),
            orientation: Orientation::Hung(Hung {
                axes: moved.axes.entries().to_vec(),
                angle: moved.angle,
                omega: moved.omega.entries().to_vec(),
                velocity: moved.velocity.entries().to_vec(),
            }),
        })
    }

    /// One step of a `joint`, the next coordinate of which is at the position `next` in q.
    fn step(
        &mut self,
        step: &Step,
        next: &mut usize,
        moved: &mut Moved,
        inner: &Env<'m>,
        joint: &Joint,
    ) -> Option<()> {
        let loc = joint.call.span().into();
        let mut coordinate = |g: &mut Graph| {
            *next += 1;
            g.symbol(Symbol::Coord(*next - 1))
        };
        let mut total = Derivative::total();
        match step {
            Step::Turn("") => {
                let angle = coordinate(&mut self.graph);
                let g = &mut self.graph;
                let turn = Value::new(&[2, 2], turned(&[angle], g));
                moved.turn(&turn, g);
                moved.angle = g.sum(&[(1.0, moved.angle), (1.0, angle)]);
                let rate = Value::Scalar(total.of(angle, g));
                moved.omega = plus(&moved.omega, &rate, g);
            }
            Step::Turn(axis) => {
                let axis = self.sound(axis, loc, inner)?;
                let angle = coordinate(&mut self.graph);
                let g = &mut self.graph;
                moved.turn(&about(&axis, angle, g), g);
                let rate = total.of(angle, g);
                moved.omega = plus(&moved.omega, &scaled(rate, &axis, g), g);
            }
            Step::Slide(axis) => {
                let axis = self.sound(axis, loc, inner)?;
                let way = coordinate(&mut self.graph);
                self.slide(way, &axis, moved);
            }
            Step::Follow(axis, factor) => {
                let axis = self.sound(axis, loc, inner)?;
                let factor = self.sound(factor, loc, inner)?.entries()[0];
                let angle = self.graph.symbol(Symbol::Coord(*next - 1));
                let way = self.graph.mul(factor, angle);
                self.slide(way, &axis, moved);
            }
            Step::Fix(matrix) => {
                let turn = self.sound(matrix, loc, inner)?;
                self.rotates(&turn, &joint.args)?;
                if turn.shape() == [2, 2] {
                    let angle = self.sound("angle", loc, inner)?.entries()[0];
                    moved.angle = self.graph.sum(&[(1.0, moved.angle), (1.0, angle)]);
                }
                moved.turn(&turn, &mut self.graph);
            }
            Step::Hinge => {
                let [u, w] = ["u", "w"].map(|name| self.sound(name, loc, inner));
                if u?.entries() == w?.entries() {
                    let about = Step::Turn("normalise(u)");
                    return self.step(&about, next, moved, inner, joint);
                }
                // A turn about a third axis has zeros; one about `u` has none.
                let [before, after] = [AXES_U, AXES_W].map(|axes| self.sound(axes, loc, inner));
                moved.turn(&before?, &mut self.graph);
                self.step(&Step::Turn("[0, 0, 1]"), next, moved, inner, joint)?;
                moved.turn(&after?, &mut self.graph);
            }
            Step::Ball => {
                let e = [(); 4].map(|()| coordinate(&mut self.graph));
                let g = &mut self.graph;
                moved.turn(&Value::new(&[3, 3], turned(&e, g)), g);
                moved.omega = plus(&moved.omega, &turning(&e, true, g), g);
            }
        }
        Some(())
    }

    /// Displaces the frame by `way` along `axis`, at which rate it moves.
    fn slide(&mut self, way: Id, axis: &Value, moved: &mut Moved) {
        let g = &mut self.graph;
        moved.shift(&scaled(way, axis, g), g);
        let rate = Derivative::total().of(way, g);
        moved.velocity = plus(&moved.velocity, &scaled(rate, axis, g), g);
    }

    /// The value of a text of the table, unless it is in error.
    fn sound(&mut self, text: &str, loc: Loc, env: &Env<'m>) -> Option<Value> {
        Some(self.written(text, loc, env)).filter(|value| !value.is_error())
    }

    /// Reports a matrix that is no rotation by the defaults of the parameters.
    fn rotates(&mut self, turn: &Value, args: &[Expr]) -> Option<()> {
        let n = turn.shape()[0];
        let point = ukalgebra::expr::Point::of_parameters(&self.defaults);
        let m = eval(&self.graph, turn.entries(), &point);
        let inner = |i: usize, j: usize| (0..n).map(|k| m[n * i + k] * m[n * j + k]).sum::<f64>();
        let unit = |i, j| if i == j { 1.0 } else { 0.0 };
        let mut off = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let orthonormal = off.all(|(i, j)| (inner(i, j) - unit(i, j)).abs() <= 1e-9);
        let minor = |k: usize| {
            m[3 + (k + 1) % 3] * m[6 + (k + 2) % 3] - m[3 + (k + 2) % 3] * m[6 + (k + 1) % 3]
        };
        let right = n == 2 || (0..3).map(|k| m[k] * minor(k)).sum::<f64>() > 0.0;
        if orthonormal && right || m.iter().any(|x| !x.is_finite()) {
            return Some(());
        }
        let loc = args.last().map_or(args[0].loc, |arg| arg.loc);
        let message = "`turn` of a joint of the tree is a rotation: its columns are unit vectors at right angles, right-handed";
        self.error(loc, message);
        None
    }

    /// The terms of the kinetic energy of the place of a body that hangs on a joint.
    pub(super) fn hung_energy(&mut self, frame: &Frame, mass: Id) -> Option<Vec<(f64, Id)>> {
        let moving = frame.moving.as_ref()?;
        let Orientation::Hung(hung) = &moving.orientation else {
            return None;
        };
        let g = &mut self.graph;
        let arms = moving.centre.iter().zip(&moving.reference);
        let arm = Value::vector(arms.map(|(c, r)| g.sub(*c, *r)).collect());
        let omega = moving.omega(true, g);
        let swept = swept(&omega, &arm, g);
        let velocity = plus(&Value::vector(hung.velocity.clone()), &swept, g);
        let pairs = velocity.entries().iter().zip(velocity.entries());
        let square = sum_of_products(pairs, g);
        Some(vec![(0.5, g.mul(mass, square))])
    }

    /// The angular velocity of a planar body.
    pub(super) fn rate(&mut self, frame: &Frame) -> Id {
        let zero = self.graph.zero();
        let moving = frame.moving.as_ref();
        let omega = moving.map(|moving| moving.omega(true, &mut self.graph));
        omega.map_or(zero, |omega| omega.entries()[0])
    }
}

/// Axes of the first body of which the last is `u`, and axes of the second by rows of which the last is `w`.
const AXES_U: &str = "transpose([normals(u)[0], normals(u)[1], normalise(u)])";
const AXES_W: &str = "[normals(w)[0], normals(w)[1], normalise(w)]";
