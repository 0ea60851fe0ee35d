//! What the compiler knows about a mechanism, as constants of its type.

mod structure;

pub use structure::{Body, Check, Costs, Operations, Pivot, Solve, Structure};

use crate::error::Error;

/// Everything known about a mechanism at compile time.
#[derive(Debug)]
pub struct Spec {
    /// The name of the type.
    pub name: &'static str,
    /// The doc comment of the declaration.
    pub doc: &'static str,
    /// Parameters, families flattened (`m[0]`, `m[1]`, …).
    pub params: &'static [ParamSpec],
    /// What depends on parameters only and is computed once for a set of them: name and expression.
    pub prepared: &'static [(&'static str, &'static str)],
    /// Coordinate names (`x[0]`, `th1`), the order of q.
    pub coords: &'static [&'static str],
    /// Units of the coordinates, such as `"m"`, in their order; none at all where the declaration has no units, see
    /// [`Spec::coordinate_unit`].
    pub coordinate_units: &'static [&'static str],
    /// Constraints, holonomic ones first, the order of the rows of A.
    pub constraints: &'static [ConstraintSpec],
    /// Units of the constraints' multipliers, such as `"N"` where φ is a length and `"N m"` where it is an angle; none at all where the
    /// declaration has no units, see [`Spec::multiplier_unit`].
    pub multiplier_units: &'static [&'static str],
    /// Number h of holonomic constraints.
    pub holonomic: usize,
    /// Outputs, in declared order.
    pub outputs: &'static [OutputSpec],
    /// The declared starts, in their order.
    pub starts: &'static [StartSpec],
    /// The picture of the mechanism.
    pub drawing: Drawing,
    /// The switches of the equations of motion, at which these have kinks or jumps, in the order of `Mechanism::switching`.
    pub switches: &'static [SwitchSpec],
    /// What the compiler found out about the mechanism.
    pub structure: Structure,
    /// The derived equations, readable.
    pub equations: Equations,
}

/// A parameter.
#[derive(Debug)]
pub struct ParamSpec {
    /// The parameter's name as declared.
    pub name: &'static str,
    /// The parameter's doc comment; empty if there is none.
    pub doc: &'static str,
    /// The parameter's default value, in SI where units are declared.
    pub default: f64,
    /// The parameter's unit in SI, such as `"kg m^2"`; empty for a plain number, and where none is declared.
    pub unit: &'static str,
    /// The unit that the default is written in, where numbers of it are not in SI, such as `"mm"` or `"deg"`; else empty.
    pub written: &'static str,
}

/// An output.
#[derive(Debug)]
pub struct OutputSpec {
    /// The output's name as declared.
    pub name: &'static str,
    /// The output's doc comment; empty if there is none.
    pub doc: &'static str,
    /// The unit of its values, as declared: `"deg"` where they are in degrees; empty for a plain number, and where none is declared.
    pub unit: &'static str,
    /// Whether it depends on reactions, which are those of the motion that declared forces and constraints make from a state.
    pub loaded: bool,
}

/// A start state on offer: declared, or made by a `Model`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartSpec {
    /// The start's name on the command line.
    pub name: &'static str,
    /// What the start is, in one line.
    pub doc: &'static str,
    /// The options that the start has.
    pub options: &'static [StartOption],
    /// How long a typical run from the start lasts, s.
    pub duration: f64,
}

/// Duration of a run, s, where no start says otherwise.
pub const DURATION: f64 = 10.0;

impl StartSpec {
    /// How long a typical run from `start` lasts, s: [`DURATION`] from none.
    #[must_use]
    pub fn typical(start: Option<&StartSpec>) -> f64 {
        start.map_or(DURATION, |start| start.duration)
    }
}

/// An option of a start state. No option is called like a parameter of its model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartOption {
    /// The option's name on the command line.
    pub name: &'static str,
    /// What the option is, in one line.
    pub doc: &'static str,
    /// The value of the option where none is given.
    pub default: f64,
    /// The option's unit in SI, such as `"rad"`; empty for a plain number, and where none is declared.
    pub unit: &'static str,
    /// The unit that the default is written in, where numbers of it are not in SI, such as `"mm"` or `"deg"`; else empty.
    pub written: &'static str,
}

/// A picture of a mechanism: shapes whose points [`Prepared::drawing`](crate::Prepared::drawing) gives at a state. Where no `draw` is
/// declared it is made of what bodies and joints tell.
#[derive(Debug, Clone, Copy)]
pub struct Drawing {
    /// Coordinates of a point: 2 or 3; 0 where nothing is drawn.
    pub dimension: usize,
    /// The shapes, the first at the back.
    pub shapes: &'static [ShapeSpec],
}

impl Drawing {
    /// The picture in which nothing is drawn.
    pub const NONE: Drawing = Drawing {
        dimension: 0,
        shapes: &[],
    };

    /// How many numbers the shapes have in all.
    #[must_use]
    pub fn numbers(&self) -> usize {
        self.shapes.iter().map(|shape| shape.numbers).sum()
    }
}

/// A shape of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeSpec {
    /// What the shape is.
    pub kind: ShapeKind,
    /// How many numbers the shape has: those of its points one after the other, of a circle the radius behind.
    pub numbers: usize,
    /// What a text says; empty for all else.
    pub label: &'static str,
}

/// What a shape is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapeKind {
    /// A line through its points.
    Line,
    /// A circle about a point; in space a sphere.
    Circle,
    /// A spring between two points.
    Spring,
    /// The path of a point.
    Trace,
    /// A text at a point.
    Text,
    /// A point of the ground on which something hangs.
    Support,
    /// The centre of mass of a body of which no other point is known.
    Mark,
}

/// What is said of a coordinate at a start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GuessKind {
    /// The value of the coordinate.
    Position,
    /// The velocity of the coordinate.
    Velocity,
    /// An angular velocity in axes of the ground: of the four coordinates of a quaternion the first has a 0, the others the components.
    Omega,
    /// An angular velocity in axes of the body: of the four coordinates of a quaternion the first has a 0, the others the components.
    Spin,
}

/// What a declared start says of a coordinate or of its velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guess {
    /// The coordinate, in the order of [`Spec::coords`].
    pub coordinate: usize,
    /// Which quantity of the coordinate is meant: its value, its velocity, or its part of an angular velocity.
    pub kind: GuessKind,
    /// Whether the coordinate keeps this value where the start is assembled.
    pub held: bool,
    /// The value that the start gives or guesses.
    pub value: f64,
}

/// A switch: a function g(t, q, q̇) at whose zeros abs, sign, min or max change their branch. abs(u) and sign(u) turn at the zeros of u,
/// min(a, b) and max(a, b) at those of a − b; the direction v/|v| of a vector at those of its length |v|.
#[derive(Debug)]
pub struct SwitchSpec {
    /// The switching function g, readable.
    pub function: &'static str,
    /// The terms of the equations of motion that contain it: "force on `x`", "non-ideal force on `x`", "mass on `x`", "constraint `rod`".
    pub terms: &'static [&'static str],
    /// Whether g is the length of a vector that the equations divide by: it reaches zero without changing its sign.
    pub length: bool,
    /// Whether g is 0 wherever nothing moves, as a velocity is.
    pub at_rest: bool,
}

impl SwitchSpec {
    /// The terms that contain some of `switches`, each once.
    pub(crate) fn terms<'a>(switches: impl Iterator<Item = &'a SwitchSpec>) -> Vec<String> {
        let mut terms: Vec<String> = Vec::new();
        for term in switches.flat_map(|switch| switch.terms) {
            if !terms.iter().any(|known| known == term) {
                terms.push((*term).to_owned());
            }
        }
        terms
    }
}

/// A constraint.
#[derive(Debug)]
pub struct ConstraintSpec {
    /// Name as declared, with indices (`link[3]`; components of vector equations `joint[0]`, `joint[1]`).
    pub name: &'static str,
    /// Whether the constraint is holonomic or nonholonomic.
    pub kind: ConstraintKind,
    /// The constraint's equation φ = 0, readable.
    pub equation: &'static str,
}

/// Kind of a constraint (eqs. 3 and 4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstraintKind {
    /// The constraint is φ(q, t) = 0, and is differentiated twice.
    Holonomic,
    /// The constraint is φ(q, q̇, t) = 0, and is differentiated once.
    Nonholonomic,
}

/// The derived equations as text, a line for each row. Entries that are zero are absent; rows that differ in their indices alone are one
/// line, which ends with the values of the letters in it.
#[derive(Debug)]
pub struct Equations {
    /// Abbreviations that the other equations use.
    pub definitions: &'static [&'static str],
    /// The entries of the lower triangle of M.
    pub mass: &'static [&'static str],
    /// The entries of Q.
    pub force: &'static [&'static str],
    /// The entries of c.
    pub nonideal: &'static [&'static str],
    /// Each constraint, followed by its entries of A and of b, which are set in by four spaces.
    pub constraints: &'static [&'static str],
}

impl Equations {
    /// The equations of a mechanism of which none are known.
    pub const NONE: Equations = Equations {
        definitions: &[],
        mass: &[],
        force: &[],
        nonideal: &[],
        constraints: &[],
    };
}

impl Spec {
    /// The description of a mechanism without coordinates; to be filled in by struct update.
    pub const EMPTY: Spec = Spec {
        name: "",
        doc: "",
        params: &[],
        prepared: &[],
        coords: &[],
        coordinate_units: &[],
        multiplier_units: &[],
        constraints: &[],
        holonomic: 0,
        outputs: &[],
        starts: &[],
        drawing: Drawing::NONE,
        switches: &[],
        structure: Structure::EMPTY,
        equations: Equations::NONE,
    };

    /// The number n of coordinates.
    #[must_use]
    pub const fn n(&self) -> usize {
        self.coords.len()
    }

    /// The number m of constraints.
    #[must_use]
    pub const fn m(&self) -> usize {
        self.constraints.len()
    }

    /// Length of what emitted code takes as `prepared`: what depends on parameters only, then the branches held.
    pub(crate) const fn slots(&self) -> usize {
        self.prepared.len() + self.switches.len()
    }

    /// The unit of the multiplier of constraint `row`; empty where none is known.
    #[must_use]
    pub fn multiplier_unit(&self, row: usize) -> &'static str {
        self.multiplier_units.get(row).copied().unwrap_or("")
    }

    /// The unit of coordinate `index`; empty for a plain number, and where none is declared.
    #[must_use]
    pub fn coordinate_unit(&self, index: usize) -> &'static str {
        self.coordinate_units.get(index).copied().unwrap_or("")
    }

    /// Name of what stands at `position` of K = [M Aᵀ; A 0]: a coordinate, or a constraint after all coordinates.
    #[must_use]
    pub fn name_at(&self, position: usize) -> &'static str {
        match position.checked_sub(self.n()) {
            None => self.coords[position],
            Some(row) => self.constraints[row].name,
        }
    }

    /// Index of the parameter called `name`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn parameter_index(&self, name: &str) -> Result<usize, Error> {
        find("parameter", name, self.params.iter().map(|p| p.name))
    }

    /// Indices of the parameters that `name` means: that parameter, or all members of a family with this bare name, `k`, or of its row,
    /// `r[1]`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn parameter_indices(&self, name: &str) -> Result<Vec<usize>, Error> {
        members(name, self.params.iter().map(|p| p.name))
            .map_or_else(|| Ok(vec![self.parameter_index(name)?]), Ok)
    }

    /// Indices of the coordinates that one value for `name` is for: that coordinate, or all members of a family with this bare name, `p`,
    /// or of its row, `p[1]`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn coordinate_indices(&self, name: &str) -> Result<Vec<usize>, Error> {
        members(name, self.coords.iter().copied())
            .map_or_else(|| Ok(vec![self.coordinate_index(name)?]), Ok)
    }

    /// Indices of all coordinates that [belong](belongs) to `name`: those of [`coordinate_indices`](Spec::coordinate_indices), or all of a
    /// body, `jib`, of a family of bodies, or of a part.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn coordinates_of(&self, name: &str) -> Result<Vec<usize>, Error> {
        let coords = self.coords.iter().copied();
        positions(coords, |c| belongs(c, name))
            .map_or_else(|| Ok(vec![self.coordinate_index(name)?]), Ok)
    }

    /// Index of the coordinate called `name`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn coordinate_index(&self, name: &str) -> Result<usize, Error> {
        find("coordinate", name, self.coords.iter().copied())
    }

    /// Index of the output called `name`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn output_index(&self, name: &str) -> Result<usize, Error> {
        find("output", name, self.outputs.iter().map(|o| o.name))
    }

    /// Indices of the rows that the constraint called `name` has, or of the row of this name (`p.x`, `link[3]`).
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn constraint_indices(&self, name: &str) -> Result<Vec<usize>, Error> {
        let rows = self.constraints.iter().map(|c| c.name);
        positions(rows, |row| belongs(row, name))
            .map_or_else(|| Ok(vec![self.constraint_index(name)?]), Ok)
    }

    /// Names of the constraints with these indices.
    pub(crate) fn constraint_names(&self, rows: &[usize]) -> Vec<String> {
        let names = rows.iter().map(|row| self.constraints[*row].name);
        names.map(str::to_owned).collect()
    }

    /// Index of the constraint called `name`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn constraint_index(&self, name: &str) -> Result<usize, Error> {
        find("constraint", name, self.constraints.iter().map(|c| c.name))
    }
}

/// The coordinate whose velocity `name` is: `x` of `dot(x)`, also where it is a family or a body; none where it is no velocity.
#[must_use]
pub fn rate_of(name: &str) -> Option<&str> {
    name.strip_prefix("dot(")?.strip_suffix(')')
}

/// Whether what is called `full` is, or belongs to, what is called `name`: `p[1][2]` to the row `p[1]` and the family `p`, `jib.angle` to
/// the body `jib`, `load[0].x` to `load[0]` and to all of `load`, `pin.x` to the joint `pin`.
#[must_use]
pub fn belongs(full: &str, name: &str) -> bool {
    let rest = full.strip_prefix(name);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// Positions of those of `names` that are `name` with indices alone behind it, if there are any.
fn members<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<Vec<usize>> {
    let member = |n: &str| {
        n.strip_prefix(name)
            .is_some_and(|rest| rest.starts_with('[') && !rest.contains('.'))
    };
    positions(names, member)
}

/// Positions of those of `names` that are wanted, if there are any.
fn positions<'a>(
    names: impl Iterator<Item = &'a str>,
    wanted: impl Fn(&str) -> bool,
) -> Option<Vec<usize>> {
    let found = names.enumerate().filter(|(_, name)| wanted(name));
    let found: Vec<usize> = found.map(|(i, _)| i).collect();
    (!found.is_empty()).then_some(found)
}

/// The position of `name` among `names`, which are of this `kind`.
///
/// # Errors
/// [`Error::UnknownName`] with the nearest name.
pub(crate) fn find<'a>(
    kind: &'static str,
    name: &str,
    mut names: impl Iterator<Item = &'a str> + Clone,
) -> Result<usize, Error> {
    names
        .clone()
        .position(|n| n == name)
        .ok_or_else(|| Error::unknown_name(kind, name, &mut names))
}
