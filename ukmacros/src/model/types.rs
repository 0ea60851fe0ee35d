//! A declaration whose names are known.

use crate::diag::Loc;
use crate::parse::{Const, Expr};
use proc_macro2::Ident;
use std::cell::Cell;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Names of a declaration, resolved.
pub(crate) struct Model {
    pub(crate) integers: BTreeMap<String, Integer>,
    /// `f64` constants, whose values are lowered later.
    pub(crate) floats: Vec<Const>,
    pub(crate) params: Vec<Family>,
    pub(crate) coords: Vec<Family>,
    /// Members of `params`, in order.
    pub(crate) param_elements: Vec<Element>,
    /// Members of `coords`: the order of q.
    pub(crate) coord_elements: Vec<Element>,
    /// What each name stands for.
    pub(crate) names: HashMap<String, Name>,
    /// How often loops were repeated in all.
    pub(crate) repetitions: Cell<i64>,
    /// Names with a fixed meaning.
    pub(crate) reserved: HashSet<&'static str>,
}

/// `const N: usize = …;`
pub(crate) struct Integer {
    pub(crate) docs: Vec<String>,
    pub(crate) name: Ident,
    /// Of its value.
    pub(crate) loc: Loc,
    /// Nothing where it is in error, which is reported.
    pub(crate) value: Option<i64>,
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
}

/// A scalar, or a family `x[0]`, `x[1]`, ….
pub(crate) struct Family {
    pub(crate) name: Ident,
    pub(crate) docs: Vec<String>,
    /// Whether it is indexed.
    pub(crate) indexed: bool,
    /// Positions of its members in the list of elements, by index.
    pub(crate) members: Vec<usize>,
}

/// A parameter or coordinate.
pub(crate) struct Element {
    /// As written: `x[3]`, `th1`.
    pub(crate) name: String,
    pub(crate) family: usize,
    /// Index within the family, if it is one.
    pub(crate) index: Option<usize>,
    /// A parameter's default with the loop variables it was declared under.
    pub(crate) default: Option<(Expr, Vec<(String, i64)>)>,
}
