//! Tokens to syntax tree. The only place that knows `syn`.

mod expr;
mod grammar;
mod item;
mod nesting;

pub(crate) use expr::{BinaryOp, Expr, ExprKind, Range, own};
pub(crate) use grammar::parse;
pub(crate) use item::{
    Block, Body, Const, Declaration, Entry, Equation, Function, Guess, Key, Let, LetValue,
    MassEntry, Shape, Start,
};
