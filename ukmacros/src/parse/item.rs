//! The syntax tree of a declaration.

use super::expr::{Expr, Range};
use crate::diag::Loc;
use proc_macro2::{Ident, TokenStream};
use std::collections::BTreeMap;
use ukunits::Unit;

/// A whole declaration.
pub(crate) struct Declaration {
    pub(crate) docs: Vec<String>,
    /// Path of the crate `ukcore`, where `#[ukcore(crate = path)]` says it.
    pub(crate) runtime: Option<TokenStream>,
    /// `#[allow(…)]` of what the declaration becomes, as written.
    pub(crate) lints: TokenStream,
    /// Whether the declaration may be a part of others: `#[ukcore(part)]`.
    pub(crate) part: bool,
    /// Whether there are units in the declaration, or in a part of it.
    pub(crate) units: bool,
    /// Visibility, as written.
    pub(crate) vis: TokenStream,
    pub(crate) name: Ident,
    /// The keywords of its sections, by their text: that a section is there may matter where nothing stands in it.
    pub(crate) sections: BTreeMap<String, Ident>,
    pub(crate) consts: Vec<Const>,
    pub(crate) params: Vec<Block<Entry>>,
    pub(crate) coords: Vec<Block<Coord>>,
    pub(crate) bodies: Vec<Block<Body>>,
    pub(crate) tree: Vec<Block<Entry>>,
    pub(crate) parts: Vec<Block<PartUse>>,
    /// How many of `lets` stand before its parts.
    pub(crate) before_parts: usize,
    /// What parts became of it.
    pub(crate) merged: Merged,
    pub(crate) gravity: Vec<Block<Expr>>,
    pub(crate) lets: Vec<Block<Let>>,
    pub(crate) mass: Vec<Block<MassEntry>>,
    pub(crate) kinetic: Vec<Block<Expr>>,
    pub(crate) force: Vec<Block<Entry>>,
    pub(crate) forces: Vec<Block<Expr>>,
    pub(crate) dissipation: Vec<Block<Expr>>,
    pub(crate) potential: Vec<Block<Expr>>,
    pub(crate) holonomic: Vec<Block<Equation>>,
    pub(crate) nonholonomic: Vec<Block<Equation>>,
    pub(crate) nonideal: Vec<Block<Applied>>,
    pub(crate) outputs: Vec<Block<Entry>>,
    pub(crate) integrals: Vec<Block<Entry>>,
    pub(crate) starts: Vec<Start>,
    pub(crate) drawing: Vec<Block<Shape>>,
}

/// An entry, or a `for` over entries.
pub(crate) enum Block<T> {
    One(T),
    For {
        var: Ident,
        range: Range,
        body: Vec<Block<T>>,
    },
}

impl<T> Block<T> {
    /// Visits every entry once, those in loops included.
    pub(crate) fn each<'a>(&'a self, visit: &mut dyn FnMut(&'a T)) {
        match self {
            Block::One(entry) => visit(entry),
            Block::For { body, .. } => body.iter().for_each(|block| block.each(visit)),
        }
    }
}

/// `const N: usize = 17;`
#[derive(Clone)]
pub(crate) struct Const {
    pub(crate) docs: Vec<String>,
    pub(crate) name: Ident,
    /// `usize` (true) or `f64`.
    pub(crate) integer: bool,
    pub(crate) value: Expr,
}

/// A name with its indices: `x`, `x[i + 1]`, `p[i][2]`; of a coordinate of a body its name, too: `link[i].angle`.
#[derive(Clone)]
pub(crate) struct Key {
    pub(crate) name: Ident,
    pub(crate) indices: Vec<Expr>,
    /// What follows dots, with indices.
    pub(crate) fields: Vec<(Ident, Vec<Expr>)>,
    /// The unit, where what the key declares has one: `s [m]`.
    pub(crate) measure: Option<Measure>,
    /// The range from the name to the last token.
    pub(crate) loc: Loc,
}

/// What is said of a name. Of a parameter its default: `k[N] = 2.0`. Of a joint of the tree what it is, its coordinates being those of its
/// second body: `elbow: hinge(upper.at([l, 0, 0]), fore.at([0, 0, 0]), u)`. Of a coordinate the force on it: `x: -k * x`. Of an output or
/// an integral its value: `fall = y[0]`, `swing [deg] = atan2(x, -y)`.
pub(crate) struct Entry {
    pub(crate) docs: Vec<String>,
    pub(crate) key: Key,
    pub(crate) value: Expr,
}

/// `x[N]`, `s [m]`.
pub(crate) struct Coord {
    pub(crate) docs: Vec<String>,
    pub(crate) key: Key,
}

/// A unit, and where its brackets are.
#[derive(Clone)]
pub(crate) struct Measure {
    pub(crate) unit: Unit,
    pub(crate) loc: Loc,
    /// What stands in the brackets, if that is one name and no space is before them: it may be meant as the size of a family.
    pub(crate) size: Option<String>,
}

/// `planar link[i] { mass: m, inertia: j, centre: [a, b] }`.
#[derive(Clone)]
pub(crate) struct Body {
    pub(crate) docs: Vec<String>,
    /// `spatial`, or else `planar`.
    pub(crate) spatial: bool,
    pub(crate) key: Key,
    pub(crate) mass: Option<Expr>,
    pub(crate) inertia: Option<Expr>,
    pub(crate) centre: Option<Expr>,
}

/// `leg[6]: Leg { phase: 0.1 }`, a declaration within this one.
#[derive(Clone)]
pub(crate) struct PartUse {
    pub(crate) key: Key,
    /// The place of the part's type, and what it is called there.
    pub(crate) path: TokenStream,
    pub(crate) name: Ident,
    /// Parameters with their values.
    pub(crate) given: Vec<(Ident, Expr)>,
}

/// The declarations that became part of one.
#[derive(Default)]
pub(crate) struct Merged {
    /// Names in them by those that they have now, as they are shown: `leg[2].knee` for `leg_2_knee`.
    pub(crate) shown: BTreeMap<String, String>,
    /// Parts by their names, with the indices of their members.
    pub(crate) families: BTreeMap<String, Vec<Vec<i64>>>,
    /// The place where each part is declared, and its name.
    pub(crate) places: Vec<(Loc, String)>,
    /// Whether there is an error in a part, which is told where that is declared.
    pub(crate) faulty: bool,
}

/// `let thrust = …;`
pub(crate) struct Let {
    pub(crate) key: Key,
    pub(crate) given: Option<Given>,
    pub(crate) value: LetValue,
}

/// What stands for a parameter of a part.
pub(crate) struct Given {
    /// The size of the parameter, which is declared where the part is.
    pub(crate) sizes: Vec<Expr>,
    /// The default that it has there.
    pub(crate) default: Expr,
}

pub(crate) enum LetValue {
    Value(Expr),
    Function(Function),
}

/// `|area, v| …`
pub(crate) struct Function {
    pub(crate) args: Vec<Ident>,
    pub(crate) body: Expr,
}

/// `x: m` or `(x, y): m12`.
pub(crate) struct MassEntry {
    pub(crate) key: Key,
    pub(crate) other: Option<Key>,
    pub(crate) value: Expr,
}

/// An entry of `nonideal`: of a coordinate, or what acts on bodies.
pub(crate) enum Applied {
    To(Entry),
    By(Expr),
}

/// `name: lhs = rhs`, or `name: joint(…)`.
pub(crate) struct Equation {
    pub(crate) key: Key,
    pub(crate) lhs: Expr,
    /// The right-hand side; of a joint, 0 if it is left out.
    pub(crate) rhs: Option<Expr>,
}

/// `start released(angle = 0.5) { x = l * sin(angle); y near -l }`.
pub(crate) struct Start {
    pub(crate) docs: Vec<String>,
    pub(crate) name: Ident,
    pub(crate) options: Vec<StartOption>,
    /// How long a motion from it is of interest.
    pub(crate) until: Option<Expr>,
    pub(crate) guesses: Vec<Block<Guess>>,
}

/// `angle = 0.5`.
pub(crate) struct StartOption {
    pub(crate) docs: Vec<String>,
    pub(crate) name: Ident,
    pub(crate) default: Expr,
}

/// `x = value`, `[x, y] near value`, `dot(x) = value`.
pub(crate) struct Guess {
    /// The key of the guess, or those in brackets.
    pub(crate) keys: Vec<Key>,
    /// Whether brackets are written, so that the value is a vector of as many.
    pub(crate) vector: bool,
    /// Whether the guess is of a velocity, not of a coordinate.
    pub(crate) rate: bool,
    /// Held, not only near.
    pub(crate) held: bool,
    pub(crate) value: Expr,
}

/// `line(p, q)`, `text(p, "driver")`.
pub(crate) struct Shape {
    pub(crate) name: Ident,
    pub(crate) args: Vec<Expr>,
    /// What a text says.
    pub(crate) label: Option<String>,
}
