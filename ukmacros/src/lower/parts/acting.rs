//! What acts: springs, dampers, forces and torques as terms of V, and of the generalised forces.

use super::{Meaning, PARTS, Part};
use crate::diag::{Loc, suggest};
use crate::lower::array::Value;
use crate::lower::bodies::{Frame, Point};
use crate::lower::{Env, Lowering, Place};
use crate::model::elsewhere;
use crate::parse::{Expr, ExprKind};
use proc_macro2::Ident;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use ukalgebra::expr::Gradient;
use ukalgebra::expr::{Id, Symbol};

/// What the entries of `forces` add up to.
#[derive(Default)]
pub(in crate::lower) struct Acting {
    pub(in crate::lower) potential: Vec<(f64, Id)>,
    /// The forces by coordinate.
    pub(in crate::lower) force: BTreeMap<usize, Vec<Id>>,
}

/// How all that acts is written.
fn acting() -> String {
    let parts = PARTS.iter().filter(|part| !part.joins());
    parts.map(Part::usage).collect::<Vec<_>>().join(", ")
}

impl<'m> Lowering<'m> {
    /// Enters what an entry of `forces` means.
    pub(in crate::lower) fn acts(&mut self, e: &Expr, env: &Env<'m>, out: &mut Acting) {
        let ExprKind::Call(name, args) = &e.kind else {
            if !matches!(e.kind, ExprKind::Error) {
                self.error(
                    e.loc,
                    format!(
                        "what acts is written as one of {}; generalised forces are written `coordinate: value`, under `force` or `nonideal`",
                        acting()
                    ),
                );
            }
            return;
        };
        if !PARTS.iter().any(|part| name == part.name) {
            let names = PARTS
                .iter()
                .filter(|part| !part.joins())
                .map(|part| part.name);
            let text = name.to_string();
            let remedy = format!("what acts is one of {}", acting());
            let end = match elsewhere(&text) {
                Some(here) => format!("; {here}"),
                None => suggest(&text, names, &remedy),
            };
            self.error(
                name.span(),
                format!("nothing that acts is called `{name}`{end}"),
            );
            return;
        }
        let Some((part, inner)) = self.part_of(name, args, env) else {
            return;
        };
        if !part.joins()
            && let Some(message) = self.idle(name, &inner)
        {
            self.error(e.loc, message);
            return;
        }
        match part.meaning {
            Meaning::Rows(..) => {
                let message =
                    format!("`{name}` is a joint; it stands under `holonomic`: `name: {name}(…)`");
                self.error(name.span(), message);
            }
            Meaning::Energy(_) if env.place == Place::Nonideal => {
                let message = format!(
                    "a `{name}` has a potential, which no constraint force has; it stands under `forces`"
                );
                self.error(name.span(), message);
            }
            Meaning::Energy(text) => {
                let value = self.written(text, e.loc, &inner);
                let value = self.carried(value, &inner);
                let velocity = value
                    .entries()
                    .iter()
                    .any(|id| self.graph.uses(*id).velocity);
                if velocity {
                    self.error(e.loc, format!("a `{name}` depends on coordinates and time only; write what depends on velocities as a `force` or `torque`"));
                    return;
                }
                out.potential
                    .extend(value.entries().iter().map(|id| (1.0, *id)));
            }
            Meaning::Push(velocity, force, slips) => {
                let (velocity, force) = (
                    self.written(velocity, e.loc, &inner),
                    self.written(force, e.loc, &inner),
                );
                if velocity.is_error() {
                    return;
                }
                // A force between two points is, along their distance; vectors are in axes of the ground.
                let (velocity, force) = match velocity.shape() {
                    [] => (self.carried(velocity, &inner), self.carried(force, &inner)),
                    _ => (velocity, force),
                };
                let last = args.last().map_or(e.loc, |a| a.loc);
                let force = self.of_shape(&force, velocity.shape(), last);
                let force = force.unwrap_or_default();
                for (v, f) in velocity.entries().iter().zip(&force) {
                    self.push(*v, *f, out);
                }
                for (name, slip) in slips {
                    let found = inner
                        .args
                        .iter()
                        .zip(args)
                        .find(|((arg, _), _)| arg == name);
                    if let Some(((_, Value::Point(point)), arg)) = found
                        && self.moves_within(point)
                    {
                        let slip = self.written(slip, e.loc, &inner);
                        let single = inner.args.iter().all(|(arg, _)| arg != "q");
                        self.act_on_body(&point.body, slip.entries(), &force, single, arg.loc, out);
                    }
                }
            }
        }
    }

    /// Why what is called `name` moves nothing, if that is so whatever the motion is.
    fn idle(&self, name: &Ident, inner: &Env<'m>) -> Option<String> {
        let mut ends: Vec<&Rc<Frame>> = Vec::new();
        for (_, value) in &inner.args {
            match value {
                Value::Point(point) if self.moves_within(point) => return None,
                Value::Point(point) => ends.push(&point.body),
                Value::Body(body) => ends.push(body),
                _ => {}
            }
        }
        if ends.iter().all(|body| body.dimension().is_none()) {
            return Some(format!(
                "the ground does not move, so that this `{name}` does nothing; name a body"
            ));
        }
        match ends[..] {
            [first, second] if Rc::ptr_eq(first, second) => Some(format!(
                "both ends of this `{name}` are on `{first}`, so that it does nothing; name two bodies"
            )),
            _ => None,
        }
    }

    /// Whether the place of a point in its body depends on coordinates.
    fn moves_within(&self, point: &Point) -> bool {
        let mut entries = point.within.entries().iter();
        entries.any(|id| self.graph.uses(*id).coord)
    }

    /// Takes from what a force does the part that it would do on a point moving in its `body`, by which that has the velocity `slip`, as a
    /// point of contact does where the body turns: it acts on the body. Coordinates that move no body may be of something that moves there,
    /// on which a `single` force acts, or not; between two points it is their distance that a force works on.
    fn act_on_body(
        &mut self,
        body: &Frame,
        slip: &[Id],
        force: &[Id],
        single: bool,
        loc: Loc,
        out: &mut Acting,
    ) {
        let mut apart = Acting::default();
        for (v, f) in slip.iter().zip(force) {
            let f = self.graph.neg(*f);
            self.push(*v, f, &mut apart);
        }
        let moving = body.moving.as_ref();
        let mut places = moving.map_or(Vec::new(), |moving| moving.rotation(&mut self.graph));
        places.extend(moving.iter().flat_map(|moving| &moving.place));
        let moved = places.iter().flat_map(|id| self.graph.support(*id));
        let moved: BTreeSet<Symbol> = moved.collect();
        for (i, terms) in apart.force {
            let name = &self.model.coord_elements[i].name;
            let own = !moved.contains(&Symbol::Coord(i)) && !self.is_of_a_body(i);
            let message = match single {
                _ if moving.is_none() => format!(
                    "a force on the ground moves nothing; one on what `{name}` moves is written `force {{ {name}: … }}`, and one on a body \
                     at a point of it, `body.at(p)`"
                ),
                true if own => format!(
                    "where this point is in `{body}` depends on `{name}`, and whether the force acts on `{body}` there or on what moves \
                     along with `{name}` is not told; on `{body}` it is `force({body}.at(p), F)` with a fixed p and the moment of the way \
                     from there, `torque({body}, cross(r, F))`; on the other that and `force {{ {name}: … }}`"
                ),
                false if own => continue,
                _ => {
                    out.force.entry(i).or_default().extend(terms);
                    continue;
                }
            };
            self.error(loc, message);
            return;
        }
    }

    /// Whether coordinate `i` is one of the place or orientation of a body.
    fn is_of_a_body(&self, i: usize) -> bool {
        let own = self.model.own.iter().zip(&self.model.body_elements);
        own.filter_map(|(first, body)| Some(((*first)?, body)))
            .any(|(first, body)| {
                let kind = self.model.body_kinds[body.family];
                (first..first + kind.coordinates().len()).contains(&i)
            })
    }

    /// Adds the generalised force of a force `f` at what has the velocity `v`: f ∂v/∂q̇.
    pub(in crate::lower) fn push(&mut self, v: Id, f: Id, out: &mut Acting) {
        let gradient = Gradient::of(v, &self.graph);
        for symbol in gradient.symbols() {
            if let Symbol::Velocity(i) = symbol {
                let slope = gradient.along(symbol, &mut self.graph);
                let term = self.graph.mul(f, slope);
                out.force.entry(i).or_default().push(term);
            }
        }
    }
}
