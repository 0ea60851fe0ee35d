//! What lowering makes.

use crate::expr::graph::{Graph, Id, Map};
use crate::place::Loc;
use proc_macro2::Ident;
use std::collections::BTreeMap;

/// The equations of a declaration as a graph.
pub struct System {
    pub graph: Graph,
    /// Value of each `f64` constant.
    pub constants: Vec<f64>,
    /// Default of each parameter.
    pub defaults: Vec<f64>,
    /// Unit of each parameter; empty where none is known, none at all where none is declared.
    pub units: Vec<NamedUnit>,
    /// Unit of each constraint's multiplier in SI; empty where none is known, none at all where none is declared.
    pub efforts: Vec<String>,
    /// Lower triangle (row ≥ column) of the declared M, with where it was declared first.
    pub mass: BTreeMap<(usize, usize), (Id, Loc)>,
    pub kinetic: Option<(Id, Loc)>,
    /// Declared generalised forces, by coordinate.
    pub force: BTreeMap<usize, Id>,
    pub potential: Option<Id>,
    /// The paper's c, by coordinate.
    pub nonideal: Option<BTreeMap<usize, Id>>,
    /// The name, the mass, and the inertia by rows, of each spatial body.
    pub inertias: Vec<(String, Vec<Id>)>,
    /// Holonomic ones first.
    pub constraints: Vec<Constraint>,
    /// Rows that always hold, by their names: they are none of the constraints.
    pub left_out: Vec<String>,
    pub outputs: Vec<OutputValue>,
    /// What is integrated along with the motion.
    pub integrals: Vec<OutputValue>,
    /// The place where the first reaction is used, if one is.
    pub reaction: Option<Loc>,
    pub starts: Vec<StartValue>,
    /// What the reaction of each constraint is multiplied by, where one is used: 1, or not a number where it is not unique.
    pub unique: Vec<Id>,
    pub drawing: Drawing,
    /// Names that the modeller gave to values.
    pub hints: Map<Id, String>,
    /// Names for what the compiler adds: pivots, multipliers. They serve the emitted code alone, not the printed equations.
    pub inner_hints: Map<Id, String>,
}

impl System {
    /// All names, the modeller's before the compiler's.
    pub fn all_hints(&self) -> Map<Id, String> {
        let mut all = self.inner_hints.clone();
        all.extend(self.hints.clone());
        all
    }

    /// Values that were rewritten, old to new, keep their names.
    pub fn carry_names(&mut self, rewritten: &Map<Id, Id>) {
        let inner = self.inner_hints.iter();
        let inner = inner.filter(|(old, _)| !self.hints.contains_key(old));
        let all = self.hints.iter().chain(inner);
        let all = all.filter_map(|(old, name)| Some((*old, *rewritten.get(old)?, name.clone())));
        let mut names: Vec<(Id, Id, String)> = all.collect();
        names.sort_unstable_by_key(|(old, ..)| *old);
        for (_, new, name) in names {
            let (_, inner) = self.graph.unscaled(new);
            if !self.graph.operands(inner).is_empty() {
                self.inner_hints.entry(inner).or_insert(name);
            }
        }
    }
}

/// What the analysis asks about coordinates.
pub struct Coordinates {
    pub names: Vec<String>,
    /// Whether each may be an angle by its unit; none where none has one.
    pub turning: Option<Vec<bool>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    Holonomic,
    Nonholonomic,
}

/// φ = 0.
pub struct Constraint {
    pub item: ConstraintRef,
    pub kind: Kind,
    pub phi: Id,
    pub loc: Loc,
}

/// Name of a constraint or output: family, its indices, indices of the component of a vector equation.
#[derive(Clone)]
pub struct ConstraintRef {
    pub base: Ident,
    /// How that is shown.
    pub shown: String,
    pub indices: Vec<i64>,
    pub components: Vec<usize>,
    /// What a joint calls its row, or what the row is that keeps the quaternion of a body or a joint of the tree a unit.
    pub row: Option<&'static str>,
}

impl ConstraintRef {
    /// The name as shown: `link[3]`, `joint[0]`, `joint[2][1]`, `knee.x`, `platform.unit`.
    pub fn text(&self) -> String {
        let whole = self.whole();
        match self.row {
            Some(row) => format!("{whole}.{row}"),
            None => indexed(whole, &self.components),
        }
    }

    /// The constraint, output or integral that it is a row or component of: `knee`, `joint[2]`.
    pub fn whole(&self) -> String {
        indexed(&self.shown, &self.indices)
    }
}

pub struct OutputValue {
    pub item: ConstraintRef,
    pub docs: Vec<String>,
    /// The unit of `value`, if one is declared.
    pub unit: Option<String>,
    pub value: Id,
    /// `value` depends on reactions.
    pub loaded: bool,
}

/// A start: its options, and where coordinates and velocities are there.
pub struct StartValue {
    pub name: String,
    pub docs: Vec<String>,
    pub options: Vec<OptionValue>,
    /// How long a motion from it is of interest, if it says so.
    pub until: Option<f64>,
    pub guesses: Vec<GuessValue>,
}

/// An option of a start. In expressions the k-th is the k-th parameter behind those of the mechanism.
pub struct OptionValue {
    pub name: String,
    pub docs: Vec<String>,
    pub default: f64,
    /// Empty where none is known.
    pub unit: NamedUnit,
}

/// The unit of a default.
#[derive(Clone, Default)]
pub struct NamedUnit {
    /// The unit in SI.
    pub si: String,
    /// The unit as it is written, where numbers of it are not in SI; else empty.
    pub written: String,
}

/// What is said of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GuessKind {
    Position,
    Velocity,
    /// An angular velocity in axes of the ground: for the four coordinates of a quaternion nothing, then its components.
    Omega,
    /// An angular velocity in axes of the body: for the four coordinates of a quaternion nothing, then its components.
    Spin,
}

/// A guess of a coordinate, or of its velocity, at a start.
pub struct GuessValue {
    pub coordinate: usize,
    pub kind: GuessKind,
    pub held: bool,
    /// The value, by parameters and options.
    pub value: Id,
}

/// A picture of the mechanism.
#[derive(Default)]
pub struct Drawing {
    /// 2 for a picture in the plane, 3 for one in space.
    pub dimension: usize,
    pub shapes: Vec<ShapeValue>,
}

pub struct ShapeValue {
    pub kind: ShapeKind,
    /// The shape's points, one after the other; of a circle its radius behind.
    pub numbers: Vec<Id>,
    pub label: String,
}

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeKind {
    Line,
    Circle,
    Spring,
    Trace,
    Text,
    /// A place on the ground that something hangs on.
    Support,
    /// A body of which no other point is known than its centre of mass.
    Mark,
}

/// `name[1][2]`.
pub fn indexed<T: std::fmt::Display>(name: impl std::fmt::Display, indices: &[T]) -> String {
    let indices = indices.iter().map(|i| format!("[{i}]"));
    name.to_string() + &indices.collect::<String>()
}
