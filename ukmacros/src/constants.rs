//! Associated constants of the emitted type: what users read instead of numbers, `T::X[3]`, `T::ROD`, `T::OUT_FALL`, `T::N`.

use crate::diag::Diagnostics;
use crate::model::Model;
use proc_macro2::Ident;
use std::collections::HashMap;
use ukalgebra::expr::{ConstraintRef, OutputValue, System};
use ukunits::Unit;

/// Constants of `ukcore::Mechanism`.
pub(crate) const ASSOCIATED: [&str; 3] = ["SPEC", "CODE", "INTEGRALS"];

/// The text in upper case, but for a θ: both cases of it in one crate are reported as look-alikes.
fn upper(text: &str) -> String {
    let upper = |c: char| match c {
        'θ' => c.to_string(),
        _ => c.to_uppercase().to_string(),
    };
    text.chars().map(upper).collect()
}

/// One constant.
pub(crate) struct Constant {
    pub(crate) name: String,
    pub(crate) docs: Vec<String>,
    pub(crate) value: ConstantValue,
}

pub(crate) enum ConstantValue {
    Integer(i64),
    Float(f64),
    Position(Positions),
}

/// A position, or those of a family in the order of its indices: arrays of arrays where it has several, or its members are vectors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Positions {
    One(usize),
    Many(Vec<Positions>),
}

/// All constants; reports names that would become one constant, of which it leaves out the second.
pub(crate) fn constants(model: &Model, system: &System, diag: &Diagnostics) -> Vec<Constant> {
    let mut register = Register {
        diag,
        owners: HashMap::new(),
        out: Vec::new(),
    };
    for integer in model.integers.values() {
        let value = ConstantValue::Integer(integer.value.unwrap_or(0));
        register.declared(&integer.name, &integer.docs, value);
    }
    for (constant, value) in model.floats.iter().zip(&system.constants) {
        register.declared(&constant.name, &constant.docs, ConstantValue::Float(*value));
    }
    for family in &model.coords {
        let positions = nested(&family.shape, &family.members);
        let first = family.members.first();
        let unit = first.and_then(|at| model.coord_elements[*at].unit.as_ref());
        let unit = unit.map(Unit::si);
        register.positions(
            "",
            "coordinate",
            "Position in q of",
            (&family.name, unit),
            positions,
        );
    }
    let constraints = system.constraints.iter().map(|c| &c.item);
    for (base, positions) in grouped(constraints) {
        register.positions("", "constraint", "Row in A of", (base, None), positions);
    }
    for (base, positions) in grouped(system.outputs.iter().map(|o| &o.item)) {
        let unit = unit_of(&system.outputs, base);
        register.positions("OUT_", "output", "Position of", (base, unit), positions);
    }
    for (base, positions) in grouped(system.integrals.iter().map(|o| &o.item)) {
        let unit = unit_of(&system.integrals, base);
        register.positions("INT_", "integral", "Position of", (base, unit), positions);
    }
    register.out
}

/// The unit of the outputs called `base`, if one is declared.
fn unit_of(outputs: &[OutputValue], base: &Ident) -> Option<String> {
    let output = outputs.iter().find(|o| o.item.base == *base)?;
    output.unit.clone()
}

struct Register<'d> {
    diag: &'d Diagnostics,
    /// What each constant stands for.
    owners: HashMap<String, String>,
    out: Vec<Constant>,
}

impl Register<'_> {
    /// Enters the constant `name` for `what` named `source`, unless its name is taken.
    fn enter(
        &mut self,
        name: String,
        what: &str,
        source: &Ident,
        docs: Vec<String>,
        value: ConstantValue,
    ) {
        let what = format!("{what} `{source}`");
        if ASSOCIATED.contains(&name.as_str()) {
            let message = format!(
                "{what} would become the constant `{name}`, which every mechanism has; rename it"
            );
            self.diag.error(source.span(), message);
            return;
        }
        if let Some(owner) = self.owners.get(&name) {
            let message =
                format!("{what} and {owner} would both become the constant `{name}`; rename one");
            self.diag.error(source.span(), message);
            return;
        }
        self.owners.insert(name.clone(), what);
        self.out.push(Constant { name, docs, value });
    }

    /// A `const` of the declaration.
    fn declared(&mut self, source: &Ident, docs: &[String], value: ConstantValue) {
        let docs = match docs {
            [] => vec![format!("Constant `{source}` of the declaration.")],
            docs => docs.to_vec(),
        };
        let name = upper(&source.to_string());
        self.enter(name, "constant", source, docs, value);
    }

    fn positions(
        &mut self,
        prefix: &str,
        what: &str,
        of: &str,
        (source, unit): (&Ident, Option<String>),
        positions: Positions,
    ) {
        let plural = match positions {
            Positions::One(_) => "",
            Positions::Many(_) => "s",
        };
        let unit = unit.filter(|unit| !unit.is_empty());
        let unit = unit.map_or(String::new(), |unit| format!(", in {unit}"));
        let docs = vec![format!("{of} {what}{plural} `{source}`{unit}.")];
        let name = upper(&format!("{prefix}{source}"));
        self.enter(name, what, source, docs, ConstantValue::Position(positions));
    }
}

/// The positions of a family of this shape.
fn nested(shape: &[usize], members: &[usize]) -> Positions {
    match shape {
        [] => Positions::One(members[0]),
        [size, rest @ ..] => {
            let rows = members.chunks(members.len() / size);
            Positions::Many(rows.map(|row| nested(rest, row)).collect())
        }
    }
}

/// Positions of constraints or outputs by base, in order of appearance. Left out are families that no array can stand for: those
/// whose indices are not 0, 1, 2, … or whose vectors differ in length.
fn grouped<'a>(items: impl Iterator<Item = &'a ConstraintRef>) -> Vec<(&'a Ident, Positions)> {
    /// The members of a family: indices of each, those of components included, and its position.
    type Members = Vec<(Vec<i64>, usize)>;
    let mut families: Vec<(&Ident, Members)> = Vec::new();
    let mut places: HashMap<&Ident, usize> = HashMap::new();
    for (position, item) in items.enumerate() {
        let at = *places.entry(&item.base).or_insert(families.len());
        if at == families.len() {
            families.push((&item.base, Vec::new()));
        }
        let components = item
            .components
            .iter()
            .filter_map(|c| i64::try_from(*c).ok());
        let indices = item.indices.iter().copied().chain(components);
        families[at].1.push((indices.collect(), position));
    }
    let arranged = families.into_iter().filter_map(|(base, mut members)| {
        members.sort_unstable();
        Some((base, arranged(&members, 0)?))
    });
    arranged.collect()
}

/// Members in order of their indices as arrays of arrays, from index number `depth` on, if there is one for each place.
fn arranged(members: &[(Vec<i64>, usize)], depth: usize) -> Option<Positions> {
    if let [(indices, position)] = members
        && indices.len() == depth
    {
        return Some(Positions::One(*position));
    }
    let rows = members.chunk_by(|(a, _), (b, _)| a.get(depth) == b.get(depth));
    let rows = (0..).zip(rows).map(|(k, row)| {
        let counted = row[0].0.get(depth) == Some(&k);
        counted.then(|| arranged(row, depth + 1)).flatten()
    });
    let rows = rows.collect::<Option<Vec<Positions>>>()?;
    let alike = rows.windows(2).all(|w| w[0].shape() == w[1].shape());
    alike.then_some(Positions::Many(rows))
}

impl Positions {
    /// How many members each level of arrays has.
    fn shape(&self) -> Vec<usize> {
        match self {
            Positions::One(_) => Vec::new(),
            Positions::Many(rows) => {
                let inner = rows.first().map_or(Vec::new(), Positions::shape);
                std::iter::once(rows.len()).chain(inner).collect()
            }
        }
    }
}
