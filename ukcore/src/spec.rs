//! What the compiler knows about a mechanism, as constants of its type.

use crate::error::Error;

/// Everything known about a mechanism at compile time.
#[derive(Debug)]
pub struct Spec {
    /// Type name.
    pub name: &'static str,
    /// Doc comment of the declaration.
    pub doc: &'static str,
    /// Parameters, families flattened (`m[0]`, `m[1]`, …).
    pub params: &'static [ParamSpec],
    /// What depends on parameters only and is computed once for a set of them: name and expression.
    pub prepared: &'static [(&'static str, &'static str)],
    /// Coordinate names (`x[0]`, `th1`), the order of q.
    pub coords: &'static [&'static str],
    /// Constraints, holonomic ones first, the order of the rows of A.
    pub constraints: &'static [ConstraintSpec],
    /// Number h of holonomic constraints.
    pub holonomic: usize,
    /// Outputs, in declared order.
    pub outputs: &'static [OutputSpec],
    /// The declared starts, in their order.
    pub starts: &'static [StartSpec],
    /// How it is drawn.
    pub drawing: Drawing,
    /// Where the equations of motion have kinks or jumps, in the order of `Mechanism::switching`.
    pub switches: &'static [SwitchSpec],
    /// What the compiler found out.
    pub structure: Structure,
    /// The derived equations, readable.
    pub equations: Equations,
}

/// A parameter.
#[derive(Debug)]
pub struct ParamSpec {
    /// Name as declared.
    pub name: &'static str,
    /// Doc comment; empty if none.
    pub doc: &'static str,
    /// Default value.
    pub default: f64,
}

/// An output.
#[derive(Debug)]
pub struct OutputSpec {
    /// Name as declared.
    pub name: &'static str,
    /// Doc comment; empty if none.
    pub doc: &'static str,
}

/// A start state on offer: declared, or made by a `Model`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartSpec {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is, in one line.
    pub doc: &'static str,
    /// Its options.
    pub options: &'static [StartOption],
}

/// An option of a start state. No option is called like a parameter of its model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartOption {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is, in one line.
    pub doc: &'static str,
    /// Its value where none is given.
    pub default: f64,
    /// Its unit, such as `"m"`; empty for a plain number, and where the doc comment names it (`/// Angle of the crank, rad`).
    pub unit: &'static str,
}

/// A picture of a mechanism: shapes whose points [`Prepared::drawing`](crate::Prepared::drawing) gives at a state. Where no `draw` is declared
/// it is made of what bodies and joints tell.
#[derive(Debug, Clone, Copy)]
pub struct Drawing {
    /// Coordinates of a point: 2 or 3; 0 where nothing is drawn.
    pub dimension: usize,
    /// The shapes, the first at the back.
    pub shapes: &'static [ShapeSpec],
}

impl Drawing {
    /// No picture.
    pub const NONE: Drawing = Drawing {
        dimension: 0,
        shapes: &[],
    };

    /// How many numbers its shapes have in all.
    #[must_use]
    pub fn numbers(&self) -> usize {
        self.shapes.iter().map(|shape| shape.numbers).sum()
    }
}

/// A shape of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeSpec {
    /// What it is.
    pub kind: ShapeKind,
    /// How many numbers it has: its points one after the other, of a circle the radius behind.
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

/// What a declared start says of a coordinate or of its velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guess {
    /// The coordinate, in the order of [`Spec::coords`].
    pub coordinate: usize,
    /// Whether it is the coordinate's velocity.
    pub rate: bool,
    /// Whether it keeps its value where the start is assembled.
    pub held: bool,
    /// Its value.
    pub value: f64,
}

/// A switch: a function g(t, q, q̇) at whose zeros abs, sign, min or max change their branch. abs(u) and sign(u) turn at the zeros of u,
/// min(a, b) and max(a, b) at those of a − b; the direction v/|v| of a vector at those of its length |v|.
#[derive(Debug)]
pub struct SwitchSpec {
    /// g, readable.
    pub function: &'static str,
    /// The terms of the equations of motion that contain it: "force on `x`", "non-ideal force on `x`", "mass on `x`", "constraint `rod`".
    pub terms: &'static [&'static str],
    /// Whether g is the length of a vector that the equations divide by: it reaches zero without changing its sign.
    pub length: bool,
}

/// A constraint.
#[derive(Debug)]
pub struct ConstraintSpec {
    /// Name as declared, with indices (`link[3]`; components of vector equations `joint[0]`, `joint[1]`).
    pub name: &'static str,
    /// Holonomic or nonholonomic.
    pub kind: ConstraintKind,
    /// φ = 0, readable.
    pub equation: &'static str,
}

/// Kind of a constraint (eqs. 3 and 4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstraintKind {
    /// φ(q, t) = 0, differentiated twice.
    Holonomic,
    /// φ(q, q̇, t) = 0, differentiated once.
    Nonholonomic,
}

/// What the compiler found out about a mechanism.
#[derive(Debug)]
pub struct Structure {
    /// `Mechanism::acceleration` and `Mechanism::correction` exist.
    pub straight_line: bool,
    /// How q̈ is solved for.
    pub solve: Solve,
    /// Structural non-zeros (row, column) of M, both triangles.
    pub mass_pattern: &'static [(usize, usize)],
    /// Structural non-zeros (row, column) of A.
    pub jacobian_pattern: &'static [(usize, usize)],
    /// M has no off-diagonal entry.
    pub mass_diagonal: bool,
    /// M depends on neither q nor t.
    pub mass_constant: bool,
    /// A depends on neither q, q̇ nor t.
    pub jacobian_constant: bool,
    /// Coordinates whose row of M is zero: they need the Udwadia-Phohomsiri equation (eq. 19).
    pub massless: &'static [usize],
    /// Coordinates that are angles: those in the argument of a sine, cosine or tangent of M, Q, c, A or b.
    pub angles: &'static [usize],
    /// No explicit time anywhere.
    pub scleronomic: bool,
    /// A `nonideal` section exists (c of eq. 8).
    pub nonideal: bool,
    /// c depends on reactions, which are not unique where constraints imply each other.
    pub loaded: bool,
    /// A `potential` section exists.
    pub potential: bool,
    /// T + V is conserved: scleronomic, no `force` and no `nonideal`, nonholonomic constraints homogeneous in q̇, and M either constant or
    /// from `kinetic`.
    pub conservative: bool,
    /// Sentences: what was left out of the code for this mechanism, and why.
    pub left_out: &'static [&'static str],
    /// What the emitted code costs, and what it would cost otherwise.
    pub costs: Costs,
}

/// How q̈ is solved for: the elimination of K = [M Aᵀ; A 0] that the compiler chose. Positions in K: coordinate i is i, constraint i is n +
/// i.
#[derive(Debug)]
pub struct Solve {
    /// Why there is no straight line, naming what stands against it; empty where there is one.
    pub refusal: &'static str,
    /// The pivots in their order; none without a straight line.
    pub pivots: &'static [Pivot],
    /// Positions (row > column) that are zero in K and filled by the elimination.
    pub fill: &'static [(usize, usize)],
    /// What the certificate compares, in its order.
    pub checks: &'static [Check],
    /// The least share d/G of a checked pivot d in the diagonal G that it started from.
    pub least_share: f64,
    /// Constraints whose rows a of A are added as μ aᵀa to M, and as μ aᵀb to Q, since M is singular without them, at any state or at some.
    /// It leaves q̈ and λ as they are.
    pub regular: &'static [usize],
    /// Constraints whose rows of A q̈ = b are checked after the solution, since they act on a coordinate whose inertia may vanish at some
    /// states.
    pub met: &'static [usize],
    /// Names of the velocities, linear in q̇, that the kinetic energy is written in, where M is not expanded: the solve has them as unknowns, and
    /// eliminates each with its definition.
    pub velocities: &'static [&'static str],
    /// Constraints, |e|² = 1 of a quaternion among them, whose coordinates are given by the constraint and by these velocities, all at right
    /// angles to each other: the solve has their rates in the place of the coordinates'.
    pub turned: &'static [usize],
    /// Coordinates that many otherwise separate parts share, each once for every part but one: the solve has a copy of the coordinate for each
    /// of these, tied to the one before, with its share of the inertia.
    pub copies: &'static [usize],
    /// Constraints that imply each other where all are met, with parameters at their defaults. Of their rows as many as follow from the others
    /// at a state are left out there, with the multiplier 0; which of them, the state decides.
    pub redundant: &'static [usize],
}

/// One pivot of the elimination.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pivot {
    /// A coordinate with inertia that one constraint prescribes alone, taken together with it: safe at any state, since its
    /// coefficient in the constraint is a number, or depends on parameters alone.
    Prescribed(usize, usize),
    /// A coordinate without inertia, taken together with a constraint in which its coefficient is such a one.
    Massless(usize, usize),
    /// A coordinate with inertia, taken together with a constraint that gives it by other coordinates: its coefficient there is a number, as
    /// are all that are the same at any state.
    Substituted(usize, usize),
    /// Two coordinates with inertia, and a constraint that contains these alone: they are turned into the direction that it prescribes, which
    /// is done with, and the one that it leaves free, which takes the place of the first. There is no coefficient that must not vanish.
    Turned(usize, usize, usize),
    /// A coordinate with inertia.
    Coordinate(usize),
    /// A constraint all of whose coordinates are eliminated.
    Constraint(usize),
}

/// One comparison of the certificate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Check {
    /// The pivot at this position is positive; nothing was taken off it.
    Positive(usize),
    /// The pivot at this position keeps [`Solve::least_share`] of its diagonal.
    Share(usize),
}

/// Operations of one call, each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Costs {
    /// `Mechanism::dynamics`: M, Q, c, A and b.
    pub dynamics: Operations,
    /// A dense LDLᵀ of K after that, with one right-hand side: no zero is used, symmetry is, and there is no pivoting.
    pub dense: Operations,
    /// The straight line if what depends on parameters only were computed each time. Zero, like the ones that follow, where there is none.
    pub unprepared: Operations,
    /// `Mechanism::acceleration`.
    pub acceleration: Operations,
    /// `Mechanism::correction`.
    pub correction: Operations,
    /// `Mechanism::prepare`, once for a set of parameters.
    pub prepare: Operations,
}

/// Operation counts of emitted code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Operations {
    /// Additions, subtractions and negations.
    pub additions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Divisions and reciprocals.
    pub divisions: usize,
    /// Square roots.
    pub square_roots: usize,
    /// Sines, exponentials, powers and the like; sine and cosine of one argument count as one.
    pub transcendentals: usize,
    /// Comparisons and selections (abs, sign, min, max).
    pub selections: usize,
}

impl Operations {
    /// No operation.
    pub const NONE: Operations = Operations {
        additions: 0,
        multiplications: 0,
        divisions: 0,
        square_roots: 0,
        transcendentals: 0,
        selections: 0,
    };

    /// The counts, in the order of the fields.
    #[must_use]
    pub const fn counts(&self) -> [usize; 6] {
        [
            self.additions,
            self.multiplications,
            self.divisions,
            self.square_roots,
            self.transcendentals,
            self.selections,
        ]
    }

    /// Both one after the other.
    #[must_use]
    pub const fn then(self, other: Operations) -> Operations {
        Operations {
            additions: self.additions + other.additions,
            multiplications: self.multiplications + other.multiplications,
            divisions: self.divisions + other.divisions,
            square_roots: self.square_roots + other.square_roots,
            transcendentals: self.transcendentals + other.transcendentals,
            selections: self.selections + other.selections,
        }
    }
}

impl Solve {
    /// Without a straight line.
    #[must_use]
    pub const fn none(refusal: &'static str) -> Self {
        Solve {
            refusal,
            pivots: &[],
            fill: &[],
            checks: &[],
            least_share: 0.0,
            regular: &[],
            met: &[],
            velocities: &[],
            turned: &[],
            copies: &[],
            redundant: &[],
        }
    }
}

impl Costs {
    /// No cost is known.
    pub const NONE: Costs = Costs {
        dynamics: Operations::NONE,
        dense: Operations::NONE,
        unprepared: Operations::NONE,
        acceleration: Operations::NONE,
        correction: Operations::NONE,
        prepare: Operations::NONE,
    };
}

/// The derived equations as text, a line for each row. Entries that are zero are absent; rows that differ in their indices alone are one
/// line, which ends with the values of the letters in it.
#[derive(Debug)]
pub struct Equations {
    /// Abbreviations that the others use.
    pub definitions: &'static [&'static str],
    /// The lower triangle of M.
    pub mass: &'static [&'static str],
    /// Q.
    pub force: &'static [&'static str],
    /// c.
    pub nonideal: &'static [&'static str],
    /// Each constraint, followed by its entries of A and of b.
    pub constraints: &'static [&'static str],
}

impl Structure {
    /// Of a mechanism about which nothing is known.
    pub const EMPTY: Structure = Structure {
        straight_line: false,
        solve: Solve::none(""),
        mass_pattern: &[],
        jacobian_pattern: &[],
        mass_diagonal: false,
        mass_constant: false,
        jacobian_constant: false,
        massless: &[],
        angles: &[],
        scleronomic: false,
        nonideal: false,
        loaded: false,
        potential: false,
        conservative: false,
        left_out: &[],
        costs: Costs::NONE,
    };
}

impl Equations {
    /// No equations.
    pub const NONE: Equations = Equations {
        definitions: &[],
        mass: &[],
        force: &[],
        nonideal: &[],
        constraints: &[],
    };
}

impl Spec {
    /// Of a mechanism without coordinates; to be filled in by struct update.
    pub const EMPTY: Spec = Spec {
        name: "",
        doc: "",
        params: &[],
        prepared: &[],
        coords: &[],
        constraints: &[],
        holonomic: 0,
        outputs: &[],
        starts: &[],
        drawing: Drawing::NONE,
        switches: &[],
        structure: Structure::EMPTY,
        equations: Equations::NONE,
    };

    /// Number n of coordinates.
    #[must_use]
    pub const fn n(&self) -> usize {
        self.coords.len()
    }

    /// Number m of constraints.
    #[must_use]
    pub const fn m(&self) -> usize {
        self.constraints.len()
    }

    /// Length of what emitted code takes as `prepared`: what depends on parameters only, then the branches held.
    pub(crate) const fn slots(&self) -> usize {
        self.prepared.len() + self.switches.len()
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

    /// Indices of the coordinates that `name` means: that coordinate, or all members of a family with this bare name, `p`, or of its row,
    /// `p[1]`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn coordinate_indices(&self, name: &str) -> Result<Vec<usize>, Error> {
        members(name, self.coords.iter().copied())
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

    /// Index of the constraint called `name`.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn constraint_index(&self, name: &str) -> Result<usize, Error> {
        find("constraint", name, self.constraints.iter().map(|c| c.name))
    }
}

/// Positions of those of `names` that are `name` with indices behind it, if there are any.
fn members<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<Vec<usize>> {
    let member = |n: &str| {
        n.strip_prefix(name)
            .is_some_and(|rest| rest.starts_with('['))
    };
    let members = names.enumerate().filter(|(_, n)| member(n));
    let members: Vec<usize> = members.map(|(i, _)| i).collect();
    (!members.is_empty()).then_some(members)
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
