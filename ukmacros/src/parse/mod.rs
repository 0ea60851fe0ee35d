//! Tokens to syntax tree. The only place that knows `syn`.

mod bars;
mod entries;
mod expr;
mod grammar;
mod item;
mod nesting;
mod table;
mod units;
mod words;

pub(crate) use expr::{BinaryOp, Expr, ExprKind, Range, own};
pub(crate) use grammar::parse;
pub(crate) use item::{
    Applied, Block, Body, Const, Declaration, Entry, Equation, Function, Given, Guess, Key, Let,
    LetValue, MassEntry, Measure, PartUse, Shape, Start,
};
pub(crate) use table::{Table, split};
pub(crate) use words::is_freed;
