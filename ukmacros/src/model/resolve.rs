//! Integer constants, families, loops; duplicates and reserved names.

use super::types::{Element, Family, Integer, Model, Name};
use crate::diag::{Diagnostics, Loc, suggest};
use crate::parse::{BinaryOp, Block, Declaration, Expr, ExprKind, Key, Range};
use proc_macro2::Ident;
use std::cell::Cell;
use std::collections::{BTreeMap, HashMap};

/// Largest family, and longest loop. A link of a chain takes the macro 3 ms and the compiler 12 ms in all, a chain of so many a minute.
/// (With optimisation, which takes more than linear time, one of 400 takes as long.)
const MAX_MEMBERS: i64 = 5_000;
/// Repetitions of all loops, those in loops included.
const MAX_REPETITIONS: i64 = 20 * MAX_MEMBERS;

/// Names with a fixed meaning, beside those of functions.
const RESERVED: [&str; 15] = [
    "t", "PI", "dot", "ddot", "sum", "sq", "signum", "powi", "recip", "self", "Self", "super",
    "crate", "gen", "_",
];

/// Columns of every run beside coordinates, velocities and outputs.
const COLUMNS: [&str; 3] = ["t", "energy", "residual"];

/// Resolves constants, parameters and coordinates. `functions` are the names of functions.
pub(crate) fn resolve(
    decl: &mut Declaration,
    functions: impl Iterator<Item = &'static str>,
    diag: &Diagnostics,
) -> Model {
    let mut model = Model {
        integers: BTreeMap::new(),
        floats: Vec::new(),
        params: Vec::new(),
        coords: Vec::new(),
        param_elements: Vec::new(),
        coord_elements: Vec::new(),
        names: HashMap::new(),
        repetitions: Cell::new(0),
        reserved: functions.chain(RESERVED).collect(),
    };
    for constant in std::mem::take(&mut decl.consts) {
        let name = constant.name.to_string();
        let meaning = if constant.integer {
            let scope = Scope::new(&model);
            let value = scope.integer(&constant.value, diag);
            let value = value.filter(|v| {
                let fits = *v >= 0;
                if !fits {
                    diag.error(
                        constant.value.loc,
                        format!("`{name}` is a `usize`, which cannot be negative"),
                    );
                }
                fits
            });
            let integer = Integer {
                docs: constant.docs.clone(),
                name: constant.name.clone(),
                loc: constant.value.loc,
                value,
            };
            model.integers.entry(name).or_insert(integer);
            Name::Integer
        } else {
            Name::Float(model.floats.len())
        };
        declare(&constant.name, meaning, &mut model, diag);
        if !constant.integer {
            model.floats.push(constant);
        }
    }
    members(&decl.params, Kind::Param, &mut model, diag, |param| {
        (&param.key, &param.docs, Some(&param.default))
    });
    members(&decl.coords, Kind::Coord, &mut model, diag, |coord| {
        (&coord.key, &coord.docs, None)
    });
    if model.coord_elements.is_empty() && diag.is_empty() {
        diag.error(
            decl.name.span(),
            format!(
                "`{}` has no coordinates; add `coords {{ x, y }}`",
                decl.name
            ),
        );
    }
    model
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Param,
    Coord,
}

/// A member found while unrolling.
struct Found {
    name: Ident,
    docs: Vec<String>,
    index: Option<usize>,
    loc: Loc,
    default: Option<(Expr, Vec<(String, i64)>)>,
}

/// Enters parameters or coordinates: `x[N]` outside of a loop is a family of N; `x[i]` inside of one is its member i.
fn members<T>(
    blocks: &[Block<T>],
    kind: Kind,
    model: &mut Model,
    diag: &Diagnostics,
    parts: impl Fn(&T) -> (&Key, &Vec<String>, Option<&Expr>),
) {
    for block in blocks {
        let mut found = Vec::new();
        let looped = matches!(block, Block::For { .. });
        Scope::new(model).unroll(std::slice::from_ref(block), diag, &mut |item, scope| {
            let (key, docs, default) = parts(item);
            let mut push = |index| {
                found.push(Found {
                    name: key.name.clone(),
                    docs: docs.clone(),
                    index,
                    loc: key.loc,
                    default: default.map(|default| (default.clone(), scope.variables.clone())),
                });
            };
            let Some(index) = &key.index else {
                return push(None);
            };
            let Some(n) = scope.integer(index, diag) else {
                return;
            };
            match usize::try_from(n) {
                Ok(i) if looped => push(Some(i)),
                Ok(_) if n > MAX_MEMBERS => scope.too_large(&[index], diag),
                Ok(size) if size > 0 => (0..size).for_each(|i| push(Some(i))),
                _ => diag.error(
                    index.loc,
                    format!("a family needs at least 1 member, not {n}"),
                ),
            }
        });
        found.into_iter().for_each(|f| add(f, kind, model, diag));
    }
}

fn add(found: Found, kind: Kind, model: &mut Model, diag: &Diagnostics) {
    let text = found.name.to_string();
    let families = match kind {
        Kind::Param => &model.params,
        Kind::Coord => &model.coords,
    };
    let known = match (model.names.get(&text), kind) {
        (Some(Name::Param(f)), Kind::Param) | (Some(Name::Coord(f)), Kind::Coord) => Some(*f),
        _ => None,
    };
    let existing =
        known.filter(|f| families[*f].indexed && found.index == Some(families[*f].members.len()));
    let family = existing.unwrap_or(families.len());
    if existing.is_none() {
        if found.index.is_some_and(|i| i != 0) {
            diag.error(
                found.loc,
                format!(
                    "members of `{text}` must be declared in order from `{text}[0]`, each once"
                ),
            );
            return;
        }
        let meaning = match kind {
            Kind::Param => Name::Param(family),
            Kind::Coord => Name::Coord(family),
        };
        if kind == Kind::Coord
            && let Err(reason) = model.column(&found.name)
        {
            diag.error(found.name.span(), reason);
            return;
        }
        if !declare(&found.name, meaning, model, diag) {
            return;
        }
    }
    let (families, elements) = match kind {
        Kind::Param => (&mut model.params, &mut model.param_elements),
        Kind::Coord => (&mut model.coords, &mut model.coord_elements),
    };
    if existing.is_none() {
        families.push(Family {
            name: found.name,
            docs: found.docs,
            indexed: found.index.is_some(),
            members: Vec::new(),
        });
    }
    families[family].members.push(elements.len());
    elements.push(Element {
        name: found.index.map_or(text.clone(), |i| format!("{text}[{i}]")),
        family,
        index: found.index,
        default: found.default,
    });
}

/// Enters a name; reports and returns false if it is taken.
fn declare(name: &Ident, meaning: Name, model: &mut Model, diag: &Diagnostics) -> bool {
    if let Err(message) = model.free(name) {
        diag.error(name.span(), message);
        return false;
    }
    model.names.insert(name.to_string(), meaning);
    true
}

impl Model {
    /// Whether `name` may still be declared; the reason if not.
    pub(crate) fn free(&self, name: &Ident) -> Result<(), String> {
        let text = self.unreserved(name)?;
        if self.names.contains_key(&text) {
            return Err(format!("`{text}` is declared twice; names must be unique"));
        }
        Ok(())
    }

    /// The text of a name that has no fixed meaning.
    fn unreserved(&self, name: &Ident) -> Result<String, String> {
        let text = name.to_string();
        match self.reserved.contains(&text.as_str()) || text.starts_with("r#") {
            true => Err(format!("`{text}` is reserved; choose another name")),
            false => Ok(text),
        }
    }

    /// Whether `name` may head a column of a run's table; the reason if not.
    pub(crate) fn column(&self, name: &Ident) -> Result<(), String> {
        let text = self.unreserved(name)?;
        if COLUMNS.contains(&text.as_str()) {
            return Err(format!(
                "`{text}` is a column of every run; choose another name"
            ));
        }
        Ok(())
    }
}

/// What is visible where an expression stands: constants and loop variables.
#[derive(Clone)]
pub(crate) struct Scope<'m> {
    model: &'m Model,
    pub(crate) variables: Vec<(String, i64)>,
}

impl<'m> Scope<'m> {
    pub(crate) fn new(model: &'m Model) -> Self {
        Scope::with(model, Vec::new())
    }

    pub(crate) fn with(model: &'m Model, variables: Vec<(String, i64)>) -> Self {
        Scope { model, variables }
    }

    /// Value of a loop variable or integer constant.
    pub(crate) fn lookup(&self, name: &str) -> Option<i64> {
        let variable = self.variables.iter().rev().find(|(n, _)| n == name);
        variable
            .map(|(_, v)| *v)
            .or_else(|| self.model.integers.get(name)?.value)
    }

    /// This scope with the variable `var` = `value`.
    pub(crate) fn bind(&self, var: &Ident, value: i64) -> Self {
        let mut inner = self.clone();
        inner.variables.push((var.to_string(), value));
        inner
    }

    /// An integer known at compile time.
    pub(crate) fn integer(&self, e: &Expr, diag: &Diagnostics) -> Option<i64> {
        match &e.kind {
            ExprKind::Int(n) => Some(*n),
            ExprKind::Group(inner) => self.integer(inner, diag),
            ExprKind::Neg(inner) => {
                let negative = self.integer(inner, diag)?.checked_neg();
                if negative.is_none() {
                    diag.error(e.loc, "integer overflow");
                }
                negative
            }
            ExprKind::Name(name) => {
                let text = name.to_string();
                let constant = self.model.integers.get(&text);
                if constant.is_some_and(|c| c.value.is_none()) {
                    return None;
                }
                let found = self.lookup(&text);
                if found.is_none() {
                    let names = self.model.integers.keys().map(String::as_str);
                    let names = names.chain(self.variables.iter().map(|(n, _)| n.as_str()));
                    let remedy = "indices and ranges must be known at compile time";
                    let end = suggest(&text, names, remedy);
                    diag.error(
                        e.loc,
                        format!("`{name}` is not an integer constant or loop variable{end}"),
                    );
                }
                found
            }
            ExprKind::Chain(first, rest) => {
                let mut result = self.integer(first, diag)?;
                for (op, operand) in rest {
                    let loc = e.loc.to(operand.loc);
                    let b = self.integer(operand, diag)?;
                    if *op == BinaryOp::Div && b == 0 {
                        diag.error(loc, "division by zero");
                        return None;
                    }
                    let next = match op {
                        BinaryOp::Add => result.checked_add(b),
                        BinaryOp::Sub => result.checked_sub(b),
                        BinaryOp::Mul => result.checked_mul(b),
                        BinaryOp::Div => result.checked_div(b),
                    };
                    if next.is_none() {
                        diag.error(loc, "integer overflow");
                    }
                    result = next?;
                }
                Some(result)
            }
            ExprKind::Error => None,
            _ => {
                diag.error(
                    e.loc,
                    "not an integer known at compile time; indices and ranges take integers, `const`s and loop variables",
                );
                None
            }
        }
    }

    /// The integers of a range.
    pub(crate) fn range(&self, range: &Range, diag: &Diagnostics) -> Option<std::ops::Range<i64>> {
        let from = self.integer(&range.from, diag)?;
        let to = self
            .integer(&range.to, diag)?
            .saturating_add(i64::from(range.inclusive));
        let length = to.saturating_sub(from);
        if length > MAX_MEMBERS {
            self.too_large(&[&range.from, &range.to], diag);
            return None;
        }
        let so_far = &self.model.repetitions;
        so_far.set(so_far.get() + length.max(0));
        if so_far.get() > MAX_REPETITIONS {
            let loc = range.from.loc.to(range.to.loc);
            diag.error(
                loc,
                format!("with this loop, {MAX_REPETITIONS} repetitions in all are exceeded, which would keep the compiler busy for hours"),
            );
            return None;
        }
        Some(from..to)
    }

    /// Reports a family or loop that is too large at the constant that makes it so, once for all that it makes too large.
    fn too_large(&self, bounds: &[&Expr], diag: &Diagnostics) {
        let mut stack = bounds.to_vec();
        let mut largest: Option<(i64, &Integer)> = None;
        while let Some(e) = stack.pop() {
            match &e.kind {
                ExprKind::Name(name) => {
                    let constant = self.model.integers.get(&name.to_string());
                    let value = constant.and_then(|c| Some((c.value?, c)));
                    largest = largest.into_iter().chain(value).max_by_key(|(n, _)| *n);
                }
                ExprKind::Neg(inner) | ExprKind::Group(inner) => stack.push(inner),
                ExprKind::Chain(first, rest) => {
                    stack.push(first);
                    stack.extend(rest.iter().map(|(_, operand)| operand));
                }
                _ => {}
            }
        }
        let (what, loc) = match largest {
            Some((value, constant)) => (
                format!("families and loops by `{}` = {value} have", constant.name),
                constant.loc,
            ),
            None => ("this has".to_owned(), bounds[bounds.len() - 1].loc),
        };
        diag.error(
            loc,
            format!("{what} more than {MAX_MEMBERS} members, each of which takes the compiler some 12 ms; up to {MAX_MEMBERS} compile"),
        );
    }

    /// Checks that `var` can be a loop variable here.
    pub(crate) fn loop_variable(&self, var: &Ident, diag: &Diagnostics) -> bool {
        let taken = self.variables.iter().any(|(n, _)| var == n);
        let reason = match self.model.free(var) {
            Err(reason) => Some(reason),
            Ok(()) if taken => Some(format!(
                "`{var}` is already a loop variable; choose another name"
            )),
            Ok(()) => None,
        };
        if let Some(reason) = &reason {
            diag.error(var.span(), reason.clone());
        }
        reason.is_none()
    }

    /// Visits every entry with its loop variables bound. A repetition with an error is the last, so that one slip gives one message.
    pub(crate) fn unroll<T>(
        &self,
        blocks: &[Block<T>],
        diag: &Diagnostics,
        visit: &mut dyn FnMut(&T, &Scope<'m>),
    ) {
        for block in blocks {
            match block {
                Block::One(entry) => visit(entry, self),
                Block::For { var, range, body } => {
                    if !self.loop_variable(var, diag) {
                        continue;
                    }
                    let Some(range) = self.range(range, diag) else {
                        continue;
                    };
                    let before = diag.len();
                    for i in range {
                        self.bind(var, i).unroll(body, diag, visit);
                        if diag.len() > before {
                            break;
                        }
                    }
                }
            }
        }
    }
}
