//! A declaration whose names are known.

use super::tree::{Joint, Step};
use crate::diag::Loc;
use crate::parse::{Const, Expr};
use proc_macro2::Ident;
use std::cell::Cell;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;
use std::rc::Rc;
use ukalgebra::expr::Coordinates;
use ukunits::Unit;

/// Names of a declaration, resolved.
#[derive(Default)]
pub(crate) struct Model {
    pub(crate) integers: BTreeMap<String, Integer>,
    /// `f64` constants, whose values are lowered later.
    pub(crate) floats: Vec<Const>,
    pub(crate) params: Vec<Family>,
    pub(crate) coords: Vec<Family>,
    pub(crate) bodies: Vec<Family>,
    /// What each of `bodies` is.
    pub(crate) body_kinds: Vec<BodyKind>,
    /// Joints of the tree.
    pub(crate) joints: Vec<Joint>,
    /// The joint that each of `body_elements` hangs on.
    pub(crate) hung: Vec<Option<usize>>,
    /// The position in q of the first own coordinate of each of `body_elements`, which one that hangs on a joint has not.
    pub(crate) own: Vec<Option<usize>>,
    /// What follows a dot: of bodies and joints of the tree their coordinates, by the name before the dot, and their own.
    pub(crate) fields: HashMap<String, BTreeMap<&'static str, Field>>,
    /// How many of `coords` are declared as such.
    pub(crate) plain: usize,
    /// Members of `params`, in order.
    pub(crate) param_elements: Vec<Element>,
    /// Members of `bodies`.
    pub(crate) body_elements: Vec<Element>,
    /// Members of `coords`: the order of q.
    pub(crate) coord_elements: Vec<Element>,
    /// What each name stands for.
    pub(crate) names: HashMap<String, Name>,
    /// What is not entered because of an error in its declaration, which is reported.
    pub(crate) lost: HashSet<String>,
    /// Functions of integers, which indices may use.
    pub(crate) index_functions: HashMap<String, IndexFunction>,
    /// Parts by their names, with the indices of their members.
    pub(crate) part_families: BTreeMap<String, Vec<Vec<i64>>>,
    /// How names of parts are shown.
    pub(crate) shown: BTreeMap<String, String>,
    /// How often loops were repeated in all.
    pub(crate) repetitions: Cell<i64>,
    /// How often functions were applied in all.
    pub(crate) applications: Cell<u32>,
    /// The first application that was one too many.
    pub(crate) too_many: Cell<Option<Loc>>,
    /// Whether there are units in the declaration.
    pub(crate) units: bool,
    /// Names with a fixed meaning.
    pub(crate) reserved: HashSet<&'static str>,
}

/// `const N: usize = …;`
pub(crate) struct Integer {
    pub(crate) docs: Vec<String>,
    pub(crate) name: Ident,
    /// The place of the value.
    pub(crate) loc: Loc,
    /// Nothing where it is in error, which is reported.
    pub(crate) value: Option<i64>,
}

/// `let next = |i| i + 1;`: made of its arguments, integers, and functions like it that are declared before.
pub(crate) struct IndexFunction {
    pub(crate) args: Vec<String>,
    pub(crate) body: Expr,
    /// How deeply its evaluation nests.
    pub(crate) depth: usize,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Name {
    Integer,
    /// Index into [`Model::floats`].
    Float(usize),
    /// Index into [`Model::params`].
    Param(usize),
    /// Index into [`Model::coords`].
    Coord(usize),
    /// Index into [`Model::bodies`].
    Body(usize),
    /// A joint of the tree, or a family of them.
    Joint,
    /// A declaration within this one, or a family of them.
    Part,
}

/// A coordinate of bodies or joints of one name.
pub(crate) enum Field {
    /// Index into [`Model::coords`].
    Family(usize),
    /// Index into [`Model::coords`] for each member, by its indices, where the coordinates of all are no array.
    Scattered(BTreeMap<Vec<usize>, usize>),
}

/// A kind of joint of the tree.
pub(crate) struct TreeJoint {
    pub(crate) name: &'static str,
    pub(crate) spatial: bool,
    pub(crate) coordinates: &'static [&'static str],
    /// The steps from the first body to the second.
    pub(crate) steps: &'static [Step],
}

/// A scalar `m`, or a family `x[0]`, `x[1]`, …, `p[0][0]`, `p[0][1]`, ….
pub(crate) struct Family {
    pub(crate) name: Ident,
    pub(crate) docs: Vec<String>,
    /// How many values each index takes; empty for a scalar.
    pub(crate) shape: Vec<usize>,
    /// Positions of its members in the list of elements, the last index running fastest.
    pub(crate) members: Vec<usize>,
}

/// What bodies of one name are.
#[derive(Clone, Copy)]
pub(crate) struct BodyKind {
    pub(crate) spatial: bool,
}

impl BodyKind {
    /// The names of a body's coordinates: place of the centre of mass, then orientation.
    pub(crate) fn coordinates(self) -> &'static [&'static str] {
        match self.spatial {
            true => &["x", "y", "z", "e0", "e1", "e2", "e3"],
            false => &["x", "y", "angle"],
        }
    }
}

/// A body that has a place of its own, or a joint of the tree with the body that hangs on it, by its coordinates.
pub(crate) struct Body<'a> {
    pub(crate) name: &'a str,
    pub(crate) joint: bool,
    /// Position in q of its first coordinate.
    pub(crate) first: usize,
    pub(crate) coordinates: &'static [&'static str],
}

impl Body<'_> {
    /// How many of its coordinates, the first ones, are lengths.
    pub(crate) fn lengths(&self) -> usize {
        let length = |name: &&&str| unit_of(name) == Unit::parse("m").ok();
        self.coordinates.iter().take_while(length).count()
    }

    /// How many of its coordinates, those that follow, are an orientation.
    pub(crate) fn turns(&self) -> usize {
        self.coordinates.len() - self.lengths()
    }
}

impl Model {
    /// What the analysis asks about coordinates: an angle is one by its unit, if it has one.
    pub(crate) fn coordinates(&self) -> Coordinates {
        let elements = self.coord_elements.iter();
        let turns = |unit: &Unit| matches!(unit.si().as_str(), "" | "rad");
        let turning = elements.clone().map(|e| e.unit.as_ref().is_none_or(turns));
        Coordinates {
            turning: self.units.then(|| turning.collect()),
            names: elements.map(|e| e.name.clone()).collect(),
        }
    }

    /// The body at this place of [`Model::body_elements`] and those that it hangs on, up to one that hangs on the ground or on nothing.
    pub(crate) fn carriers(&self, position: usize) -> impl Iterator<Item = usize> + use<'_> {
        let parent = |body: &usize| self.joints[self.hung[*body]?].parent;
        std::iter::successors(Some(position), parent)
    }

    /// The positions in q of what moves the body at this place of [`Model::body_elements`] on what it hangs on.
    pub(crate) fn moving(&self, position: usize) -> Range<usize> {
        let joint = self.hung[position].map(|joint| &self.joints[joint]);
        let (first, count) = match (self.own[position], joint) {
            (Some(first), _) => {
                let kind = self.body_kinds[self.body_elements[position].family];
                (first, kind.coordinates().len())
            }
            (None, Some(joint)) => (joint.first, joint.kind.coordinates.len()),
            (None, None) => (0, 0),
        };
        first..first + count
    }

    /// Bodies with coordinates of their own and joints of the tree that have some, in the order of their coordinates.
    pub(crate) fn owners(&self) -> Vec<Body<'_>> {
        let bodies = self.body_elements.iter().zip(&self.own);
        let bodies = bodies.filter_map(|(body, own)| {
            Some(Body {
                name: &body.name,
                joint: false,
                first: (*own)?,
                coordinates: self.body_kinds[body.family].coordinates(),
            })
        });
        let joints = self.joints.iter().map(|joint| Body {
            name: &joint.name,
            joint: true,
            first: joint.first,
            coordinates: joint.kind.coordinates,
        });
        let all = bodies.chain(joints);
        let mut all: Vec<Body> = all.filter(|body| !body.coordinates.is_empty()).collect();
        all.sort_by_key(|body| body.first);
        all
    }
}

/// What the coordinate of this `name` of a body or joint is measured in.
pub(super) fn unit_of(name: &str) -> Option<Unit> {
    let unit = match name {
        "x" | "y" | "z" | "slide" => "m",
        "angle" | "first" | "second" => "rad",
        _ => "-",
    };
    Unit::parse(unit).ok()
}

/// The places of those members, in an array of this `shape` whose last index runs fastest, that begin with `indices`; the position of the
/// index that is out of range, if one is.
pub(crate) fn block(shape: &[usize], indices: &[i64]) -> Result<Range<usize>, usize> {
    let mut start = 0;
    for (d, (index, size)) in indices.iter().zip(shape).enumerate() {
        let index = usize::try_from(*index).ok().filter(|i| i < size).ok_or(d)?;
        start = start * size + index;
    }
    let size: usize = shape[indices.len()..].iter().product();
    Ok(start * size..(start + 1) * size)
}

/// All indices of an array of this `shape`, the last running fastest; of a number one, of no length.
pub(crate) fn every(shape: &[usize]) -> impl Iterator<Item = Vec<usize>> + use<> {
    let shape = shape.to_vec();
    let count: usize = shape.iter().product();
    (0..count).map(move |mut place| {
        let mut indices = vec![0; shape.len()];
        for (index, size) in indices.iter_mut().zip(&shape).rev() {
            (*index, place) = (place % size, place / size);
        }
        indices
    })
}

/// A parameter or coordinate.
pub(crate) struct Element {
    /// The name as written: `x[3]`, `th1`.
    pub(crate) name: String,
    pub(crate) family: usize,
    /// Indices within the family, none for a scalar.
    pub(crate) indices: Vec<usize>,
    /// A parameter's default, one for all that are declared together.
    pub(crate) default: Option<Rc<Preset>>,
    /// A coordinate's unit; bodies and joints have theirs where the declaration has units.
    pub(crate) unit: Option<Unit>,
}

impl Element {
    /// The place of the element in a family of this `shape`.
    pub(crate) fn place(&self, shape: &[usize]) -> usize {
        let indices = self.indices.iter().zip(shape);
        indices.fold(0, |place, (index, size)| place * size + index)
    }
}

/// A default as declared.
pub(crate) struct Preset {
    pub(crate) value: Expr,
    /// The loop variables that it was declared under.
    pub(crate) variables: Vec<Variable>,
    /// The shape of what the default is declared for.
    pub(crate) shape: Vec<usize>,
}

/// A loop variable, or an argument of a function: its name and its value, if that is an integer. One that is not hides what is declared
/// under its name.
pub(crate) type Variable = (String, Option<i64>);
