//! What lowering makes.

use crate::diag::Loc;
use crate::expr::graph::{Graph, Id, Map};
use crate::model::indexed;
use proc_macro2::Ident;
use std::collections::BTreeMap;

/// The equations of a declaration as a graph.
pub(crate) struct System {
    pub(crate) graph: Graph,
    /// Value of each `f64` constant.
    pub(crate) constants: Vec<f64>,
    /// Default of each parameter.
    pub(crate) defaults: Vec<f64>,
    /// Unit of each parameter; empty where none is known, none at all where none is declared.
    pub(crate) units: Vec<NamedUnit>,
    /// Unit of each constraint's multiplier in SI; empty where none is known, none at all where none is declared.
    pub(crate) efforts: Vec<String>,
    /// Lower triangle (row ≥ column) of the declared M, with where it was declared first.
    pub(crate) mass: BTreeMap<(usize, usize), (Id, Loc)>,
    pub(crate) kinetic: Option<(Id, Loc)>,
    /// Declared generalised forces, by coordinate.
    pub(crate) force: BTreeMap<usize, Id>,
    pub(crate) potential: Option<Id>,
    /// The paper's c, by coordinate.
    pub(crate) nonideal: Option<BTreeMap<usize, Id>>,
    /// The name, the mass, and the inertia by rows, of each spatial body.
    pub(crate) inertias: Vec<(String, Vec<Id>)>,
    /// Holonomic ones first.
    pub(crate) constraints: Vec<Constraint>,
    /// Rows that always hold, by their names: they are none of the constraints.
    pub(crate) left_out: Vec<String>,
    pub(crate) outputs: Vec<OutputValue>,
    /// What is integrated along with the motion.
    pub(crate) integrals: Vec<OutputValue>,
    /// The place where the first reaction is used, if one is.
    pub(crate) reaction: Option<Loc>,
    pub(crate) starts: Vec<StartValue>,
    /// What the reaction of each constraint is multiplied by, where one is used: 1, or not a number where it is not unique.
    pub(crate) unique: Vec<Id>,
    pub(crate) drawing: Drawing,
    /// Names that the modeller gave to values.
    pub(crate) hints: Map<Id, String>,
    /// Names for what the compiler adds: pivots, multipliers. They serve the emitted code alone, not the printed equations.
    pub(crate) inner_hints: Map<Id, String>,
}

impl System {
    /// All names, the modeller's before the compiler's.
    pub(crate) fn all_hints(&self) -> Map<Id, String> {
        let mut all = self.inner_hints.clone();
        all.extend(self.hints.clone());
        all
    }

    /// Values that were rewritten, old to new, keep their names.
    pub(crate) fn carry_names(&mut self, rewritten: &Map<Id, Id>) {
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

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    Holonomic,
    Nonholonomic,
}

/// φ = 0.
pub(crate) struct Constraint {
    pub(crate) item: ConstraintRef,
    pub(crate) kind: Kind,
    pub(crate) phi: Id,
    pub(crate) loc: Loc,
}

/// Name of a constraint or output: family, its indices, indices of the component of a vector equation.
#[derive(Clone)]
pub(crate) struct ConstraintRef {
    pub(crate) base: Ident,
    /// How that is shown.
    pub(crate) shown: String,
    pub(crate) indices: Vec<i64>,
    pub(crate) components: Vec<usize>,
    /// What a joint calls its row, or what the row is that keeps the quaternion of a body or a joint of the tree a unit.
    pub(crate) row: Option<&'static str>,
}

impl ConstraintRef {
    /// The name as shown: `link[3]`, `joint[0]`, `joint[2][1]`, `knee.x`, `platform.unit`.
    pub(crate) fn text(&self) -> String {
        let whole = self.whole();
        match self.row {
            Some(row) => format!("{whole}.{row}"),
            None => indexed(whole, &self.components),
        }
    }

    /// The constraint, output or integral that it is a row or component of: `knee`, `joint[2]`.
    pub(crate) fn whole(&self) -> String {
        indexed(&self.shown, &self.indices)
    }
}

pub(crate) struct OutputValue {
    pub(crate) item: ConstraintRef,
    pub(crate) docs: Vec<String>,
    /// The unit of `value`, if one is declared.
    pub(crate) unit: Option<String>,
    pub(crate) value: Id,
    /// `value` depends on reactions.
    pub(crate) loaded: bool,
}

/// A start: its options, and where coordinates and velocities are there.
pub(crate) struct StartValue {
    pub(crate) name: String,
    pub(crate) docs: Vec<String>,
    pub(crate) options: Vec<OptionValue>,
    /// How long a motion from it is of interest, if it says so.
    pub(crate) until: Option<f64>,
    pub(crate) guesses: Vec<GuessValue>,
}

/// An option of a start. In expressions the k-th is the k-th parameter behind those of the mechanism.
pub(crate) struct OptionValue {
    pub(crate) name: String,
    pub(crate) docs: Vec<String>,
    pub(crate) default: f64,
    /// Empty where none is known.
    pub(crate) unit: NamedUnit,
}

/// The unit of a default.
#[derive(Clone, Default)]
pub(crate) struct NamedUnit {
    /// The unit in SI.
    pub(crate) si: String,
    /// The unit as it is written, where numbers of it are not in SI; else empty.
    pub(crate) written: String,
}

/// What is said of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GuessKind {
    Position,
    Velocity,
    /// An angular velocity in axes of the ground: for the four coordinates of a quaternion nothing, then its components.
    Omega,
    /// An angular velocity in axes of the body: for the four coordinates of a quaternion nothing, then its components.
    Spin,
}

/// A guess of a coordinate, or of its velocity, at a start.
pub(crate) struct GuessValue {
    pub(crate) coordinate: usize,
    pub(crate) kind: GuessKind,
    pub(crate) held: bool,
    /// The value, by parameters and options.
    pub(crate) value: Id,
}

/// A picture of the mechanism.
#[derive(Default)]
pub(crate) struct Drawing {
    /// 2 for a picture in the plane, 3 for one in space.
    pub(crate) dimension: usize,
    pub(crate) shapes: Vec<ShapeValue>,
}

pub(crate) struct ShapeValue {
    pub(crate) kind: ShapeKind,
    /// The shape's points, one after the other; of a circle its radius behind.
    pub(crate) numbers: Vec<Id>,
    pub(crate) label: String,
}

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ShapeKind {
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
