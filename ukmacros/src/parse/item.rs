//! The syntax tree of a declaration.

use super::expr::{Expr, Range};
use crate::diag::Loc;
use proc_macro2::{Ident, TokenStream};

/// A whole declaration.
pub(crate) struct Declaration {
    pub(crate) docs: Vec<String>,
    /// Path of the crate `ukcore`, where `#[ukcore(crate = path)]` says it.
    pub(crate) runtime: Option<TokenStream>,
    /// `#[allow(…)]` of what the declaration becomes, as written.
    pub(crate) lints: TokenStream,
    /// Visibility, as written.
    pub(crate) vis: TokenStream,
    pub(crate) name: Ident,
    pub(crate) consts: Vec<Const>,
    pub(crate) params: Vec<Block<Param>>,
    pub(crate) coords: Vec<Block<Coord>>,
    pub(crate) bodies: Vec<Block<Body>>,
    pub(crate) gravity: Option<Section<Expr>>,
    pub(crate) lets: Vec<Block<Let>>,
    pub(crate) mass: Option<Section<MassEntry>>,
    pub(crate) kinetic: Option<Section<Expr>>,
    pub(crate) force: Vec<Block<Entry>>,
    pub(crate) forces: Vec<Block<Expr>>,
    pub(crate) dissipation: Option<Section<Expr>>,
    pub(crate) potential: Option<Section<Expr>>,
    pub(crate) holonomic: Vec<Block<Equation>>,
    pub(crate) nonholonomic: Vec<Block<Equation>>,
    pub(crate) nonideal: Option<Section<Entry>>,
    pub(crate) outputs: Vec<Block<Output>>,
    pub(crate) starts: Vec<Start>,
    pub(crate) drawing: Option<Section<Shape>>,
}

/// A section whose presence matters, not only its entries.
pub(crate) struct Section<T> {
    pub(crate) keyword: Ident,
    pub(crate) blocks: Vec<Block<T>>,
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
    /// What follows a dot.
    pub(crate) field: Option<Ident>,
    /// From the name to the last token.
    pub(crate) loc: Loc,
}

/// `m = 1.0`, `k[N] = 2.0`.
pub(crate) struct Param {
    pub(crate) docs: Vec<String>,
    pub(crate) key: Key,
    pub(crate) default: Expr,
}

/// `x[N]`, `th`.
pub(crate) struct Coord {
    pub(crate) docs: Vec<String>,
    pub(crate) key: Key,
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

/// `let thrust = …;`
pub(crate) struct Let {
    pub(crate) key: Key,
    pub(crate) value: LetValue,
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

/// `x: value`.
pub(crate) struct Entry {
    pub(crate) key: Key,
    pub(crate) value: Expr,
}

/// `name: lhs = rhs`, or `name: joint(…)`.
pub(crate) struct Equation {
    pub(crate) key: Key,
    pub(crate) lhs: Expr,
    /// Of a joint, 0 if it is left out.
    pub(crate) rhs: Option<Expr>,
}

/// `fall = y[0]`.
pub(crate) struct Output {
    pub(crate) docs: Vec<String>,
    pub(crate) key: Key,
    pub(crate) value: Expr,
}

/// `start released(angle = 0.5) { x = l * sin(angle); y near -l }`.
pub(crate) struct Start {
    pub(crate) docs: Vec<String>,
    pub(crate) name: Ident,
    pub(crate) options: Vec<StartOption>,
    pub(crate) guesses: Vec<Block<Guess>>,
}

/// `angle = 0.5`.
pub(crate) struct StartOption {
    pub(crate) docs: Vec<String>,
    pub(crate) name: Ident,
    pub(crate) default: Expr,
}

/// `x = value`, `x near value`, `dot(x) = value`.
pub(crate) struct Guess {
    pub(crate) key: Key,
    /// Of a velocity, not of a coordinate.
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
