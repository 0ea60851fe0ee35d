//! What carries all bodies of a part: a loop in a tree does not notice how the body moves on which all of it hangs, nor does a spring
//! between two of its bodies. Such a part is written as if that body were at rest, where its coordinates are zero: in fewer coordinates,
//! and without the singular positions that axes of the ground bring as that body turns.

use crate::lower::array::Value;
use crate::lower::bodies::Frame;
use crate::lower::{Env, Lowering};
use std::collections::BTreeSet;
use std::rc::Rc;
use ukalgebra::expr::{Id, Node, Symbol};

/// What moves all bodies of a part alike.
pub(super) struct Carrier {
    /// The last body that all others hang on, or that is one of them.
    frame: Rc<Frame>,
    /// Positions in q of what moves it.
    coordinates: BTreeSet<usize>,
    /// Those of them that are 1 where a quaternion turns nothing.
    ones: BTreeSet<usize>,
}

/// The rows of a joint as if what carries its bodies were at rest.
pub(in crate::lower) struct Carried {
    pub(in crate::lower) rows: Vec<Id>,
    /// The axes of the ground as they turn with the carrier, along which rows that are along axes push then.
    pub(in crate::lower) axes: Vec<Vec<Id>>,
}

impl<'m> Lowering<'m> {
    /// These rows of a joint as if what carries its bodies were at rest, if anything does. Rows that parameters alone decide are none: what
    /// they say is told by the axes of the ground.
    pub(super) fn carried_rows(&mut self, rows: &Value, part: &Env<'m>) -> Option<Carried> {
        let carrier = self.carrier(part)?;
        let still = Value::new(rows.shape(), self.at_rest(rows.entries(), &carrier));
        let rows = self.without_rounding(still, part, Some(&carrier));
        let decided = |id: &Id| self.graph.uses(*id).constant() && !self.graph.is_zero(*id);
        (!rows.entries().iter().any(decided)).then(|| Carried {
            rows: rows.entries().to_vec(),
            axes: self.axes_of(&carrier),
        })
    }

    /// What carries the bodies of a part with these arguments; nothing where it is the ground, where there is but one body, or where what
    /// else the part is given depends on how the carrier moves.
    pub(super) fn carrier(&self, part: &Env<'_>) -> Option<Carrier> {
        // With units, all rows are written as they are declared: what they are measured in is the same.
        if self.dimensions.is_some() {
            return None;
        }
        let (mut paths, mut given): (Vec<Vec<usize>>, Vec<Id>) = Default::default();
        for (_, value) in &part.args {
            let frame = match value {
                Value::Body(frame) => frame,
                Value::Point(point) => {
                    given.extend_from_slice(point.within.entries());
                    &point.body
                }
                other => {
                    given.extend_from_slice(other.entries());
                    continue;
                }
            };
            let mut path: Vec<usize> = self
                .model
                .carriers(frame.moving.as_ref()?.position)
                .collect();
            path.reverse();
            paths.push(path);
        }
        let [first, others @ ..] = &paths[..] else {
            return None;
        };
        if others.is_empty() {
            return None;
        }
        let common = first.iter().enumerate();
        let common =
            common.take_while(|(k, body)| others.iter().all(|path| path.get(*k) == Some(body)));
        let common: Vec<usize> = common.map(|(_, body)| *body).collect();
        let coordinates = common
            .iter()
            .flat_map(|body| self.model.moving(*body))
            .collect();
        let firsts = self
            .model
            .quaternions()
            .filter(|first| BTreeSet::contains(&coordinates, first));
        let carrier = Carrier {
            frame: self.bodies[*common.last()?].as_ref()?.frame.clone()?,
            ones: firsts.collect(),
            coordinates,
        };
        let moves = |symbol: Symbol| match symbol {
            Symbol::Coord(i) | Symbol::Velocity(i) => carrier.coordinates.contains(&i),
            _ => false,
        };
        let free = given
            .iter()
            .all(|id| !self.graph.support(*id).into_iter().any(moves));
        (free && !carrier.coordinates.is_empty()).then_some(carrier)
    }

    /// A value that is the same wherever the carrier of the bodies is, if they have one.
    pub(super) fn carried(&mut self, value: Value, part: &Env<'_>) -> Value {
        match self.carrier(part) {
            Some(carrier) if !value.is_error() => {
                Value::new(value.shape(), self.at_rest(value.entries(), &carrier))
            }
            _ => value,
        }
    }

    /// These values where the carrier is at rest, its coordinates zero and its quaternions one.
    pub(super) fn at_rest(&mut self, ids: &[Id], carrier: &Carrier) -> Vec<Id> {
        let order = self.graph.reachable(ids);
        let new = self.graph.rewritten(&order, |g, id, _| match *g.node(id) {
            Node::Symbol(Symbol::Coord(i)) if carrier.coordinates.contains(&i) => {
                Some(if carrier.ones.contains(&i) {
                    g.one()
                } else {
                    g.zero()
                })
            }
            Node::Symbol(Symbol::Velocity(i)) if carrier.coordinates.contains(&i) => Some(g.zero()),
            _ => None,
        });
        ids.iter().map(|id| new[id]).collect()
    }

    /// The axes of the carrier in axes of the ground, those that are the ground's where it is at rest.
    pub(super) fn axes_of(&mut self, carrier: &Carrier) -> Vec<Vec<Id>> {
        let n = carrier.frame.dimension().unwrap_or(0);
        let Some(moving) = &carrier.frame.moving else {
            return Vec::new();
        };
        let axes = moving.rotation(&mut self.graph);
        let rest = Value::new(&[n, n], self.at_rest(&axes, carrier));
        let axes = Value::new(&[n, n], axes);
        let back = rest.transposed().unwrap_or(Value::Error);
        let turned = axes.times(&back, &mut self.graph);
        let columns = turned.transposed().unwrap_or(Value::Error);
        columns
            .entries()
            .chunks(n.max(1))
            .map(<[Id]>::to_vec)
            .collect()
    }
}
