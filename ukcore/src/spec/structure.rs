//! What the compiler found out about a mechanism, how it solves for q̈, and what that costs.

/// What the compiler found out about a mechanism.
#[derive(Debug)]
pub struct Structure {
    /// `Mechanism::acceleration` and `Mechanism::correction` exist.
    pub straight_line: bool,
    /// How the accelerations q̈ are solved for.
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
    /// A depends on t.
    pub jacobian_driven: bool,
    /// Constraints that ask for velocities even of a mechanism at rest: they contain the time, or a velocity that is given.
    pub driven: &'static [usize],
    /// Entries (row, column) of A that depend on parameters alone: a row that has one which is not 0 does not vanish at any state.
    pub jacobian_fixed: &'static [(usize, usize)],
    /// Coordinates whose row of M is zero: they need the Udwadia-Phohomsiri equation (eq. 19).
    pub massless: &'static [usize],
    /// Coordinates that are angles: those in the argument of a sine, cosine or tangent of M, Q, c, A or b, with no unit but rad where units
    /// are declared, else with no factor there but numbers.
    pub angles: &'static [usize],
    /// Parameters that are added to what varies in the argument of a sine, cosine or tangent of M, Q, c, A or b, and times which number.
    pub phases: &'static [(usize, f64)],
    /// The part of the mechanism that each coordinate belongs to, by the first coordinate of it, where there are several whose motions do
    /// not depend on each other; empty where all are one, and where M is not expanded, so that nothing tells.
    pub parts: &'static [usize],
    /// Bodies that have a place of their own, and joints of the tree, in the order of their coordinates.
    pub bodies: &'static [Body],
    /// The equations contain no explicit time.
    pub scleronomic: bool,
    /// A `nonideal` section exists (c of eq. 8).
    pub nonideal: bool,
    /// c depends on reactions, which are not unique where constraints imply each other.
    pub loaded: bool,
    /// A `potential` section exists.
    pub potential: bool,
    /// Coordinates whose Q is more than Lagrange's equations make of T and V: a `force` is declared on them, or M varies and is not from
    /// `kinetic`.
    pub forced: &'static [usize],
    /// T + V is conserved: scleronomic, no `force` and no `nonideal`, nonholonomic constraints homogeneous in q̇, and M either constant or
    /// from `kinetic`.
    pub conservative: bool,
    /// Sentences: what was left out of the code for this mechanism, and why.
    pub left_out: &'static [&'static str],
    /// What the emitted code costs, and what it would cost otherwise.
    pub costs: Costs,
}

/// A body that has a place of its own, or a joint of the tree with the body that hangs on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Body {
    /// The name before the dot of its coordinates.
    pub name: &'static str,
    /// It is a joint of the tree.
    pub joint: bool,
    /// Position in q of its first coordinate.
    pub first: usize,
    /// How many of its coordinates, the first ones, are lengths.
    pub lengths: usize,
    /// How many of its coordinates, those that follow, are an orientation.
    pub turns: usize,
}

impl Body {
    /// Positions in q of its coordinates that are lengths, and of those of its orientation.
    pub(crate) fn coordinates(&self) -> [std::ops::Range<usize>; 2] {
        let turned = self.first + self.lengths;
        [self.first..turned, turned..turned + self.turns]
    }

    /// Whether this coordinate is one of it.
    pub(crate) fn has(&self, coordinate: usize) -> bool {
        self.coordinates()
            .iter()
            .any(|own| own.contains(&coordinate))
    }
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
    /// Names of the velocities, linear in q̇, that the kinetic energy is written in, where M is not expanded: the solve has them as
    /// unknowns, and eliminates each with its definition.
    pub velocities: &'static [&'static str],
    /// Constraints, |e|² = 1 of a quaternion among them, whose coordinates are given by the constraint and by these velocities, all at
    /// right angles to each other: the solve has their rates in the place of the coordinates'.
    pub turned: &'static [usize],
    /// Constraints between two bodies so turned, or one and the ground, that are solved for rates of one of them beforehand: these then
    /// stand alone in them. The square of the determinant that is divided by keeps [`Solve::least_share`] of what it could be, or q̈ is
    /// computed in another way.
    pub solved: &'static [usize],
    /// Coordinates that many otherwise separate parts share, each once for every part but one: the solve has a copy of the coordinate for
    /// each of these, tied to the one before, with its share of the inertia.
    pub copies: &'static [usize],
    /// Constraints that imply each other where all are met, with parameters at their defaults. Of their rows as many as follow from the
    /// others at a state are left out there, with the multiplier 0; which of them, the state decides.
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
    /// A coordinate with inertia, taken together with a constraint that gives it by other coordinates: its coefficient there is a number,
    /// as are all that are the same at any state.
    Substituted(usize, usize),
    /// Two coordinates with inertia, and a constraint that contains these alone: they are turned into the direction that it prescribes,
    /// which is done with, and the one that it leaves free, which takes the place of the first. There is no coefficient that must not
    /// vanish.
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

/// Operations of one call of each function, and of what it replaces.
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
    /// The counts of no operation at all.
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

    /// The operations of both, one after the other.
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
    /// A solve without a straight line, for the reason `refusal`.
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
            solved: &[],
            copies: &[],
            redundant: &[],
        }
    }
}

impl Costs {
    /// The costs where none is known.
    pub const NONE: Costs = Costs {
        dynamics: Operations::NONE,
        dense: Operations::NONE,
        unprepared: Operations::NONE,
        acceleration: Operations::NONE,
        correction: Operations::NONE,
        prepare: Operations::NONE,
    };
}

impl Structure {
    /// Whether M is regular at any state, as far as can be known.
    pub(crate) fn is_regular(&self) -> bool {
        self.massless.is_empty() && self.solve.regular.is_empty() && self.solve.met.is_empty()
    }

    /// The coordinates that may have an entry in a row of A.
    pub(crate) fn in_row(&self, row: usize) -> impl Iterator<Item = usize> + Clone {
        let entries = self.jacobian_pattern.iter();
        entries.filter(move |(c, _)| *c == row).map(|(_, j)| *j)
    }

    /// The structure of a mechanism about which nothing is known.
    pub const EMPTY: Structure = Structure {
        straight_line: false,
        solve: Solve::none(""),
        mass_pattern: &[],
        jacobian_pattern: &[],
        mass_diagonal: false,
        mass_constant: false,
        jacobian_constant: false,
        jacobian_driven: false,
        driven: &[],
        jacobian_fixed: &[],
        massless: &[],
        angles: &[],
        phases: &[],
        parts: &[],
        bodies: &[],
        scleronomic: false,
        nonideal: false,
        loaded: false,
        potential: false,
        forced: &[],
        conservative: false,
        left_out: &[],
        costs: Costs::NONE,
    };
}
