//! What is visible where an expression stands: integer constants, loop variables, arguments; integers known at compile time, and loops.

use super::types::{IndexFunction, Integer, Model, Variable};
use crate::diag::{Diagnostics, suggest};
use crate::parse::{BinaryOp, Block, Declaration, Expr, ExprKind, Function, LetValue, Range};
use proc_macro2::Ident;
use std::collections::{HashMap, HashSet};

/// Largest family, and longest loop. A link of a chain takes the macro 3 ms and the compiler 12 ms in all, a chain of so many a minute.
/// (With optimisation, which takes more than linear time, one of 400 takes as long.)
pub(super) const MAX_MEMBERS: i64 = 5_000;
/// Repetitions of all loops, those in loops included.
const MAX_REPETITIONS: i64 = 20 * MAX_MEMBERS;
/// Applications of all functions, those in functions included.
const MAX_APPLICATIONS: u32 = 200_000;
/// Deeper evaluation of functions of integers is refused, since it recurses.
const MAX_DEPTH: usize = 300;

/// The functions declared by `let` that give integers for integers. Each uses those declared before it only, so none calls itself.
pub(super) fn index_functions(decl: &Declaration) -> HashMap<String, IndexFunction> {
    let integers = decl.consts.iter().filter(|c| c.integer);
    let integers: HashSet<String> = integers.map(|c| c.name.to_string()).collect();
    let mut known: HashMap<String, IndexFunction> = HashMap::new();
    for block in &decl.lets {
        block.each(&mut |binding| {
            let LetValue::Function(Function { args, body }) = &binding.value else {
                return;
            };
            let args: Vec<String> = args.iter().map(Ident::to_string).collect();
            let own = |name: &str| integers.contains(name) || args.iter().any(|a| a == name);
            if let Some(depth) = depth(body, &own, &known).filter(|d| *d < MAX_DEPTH) {
                let body = body.clone();
                let function = IndexFunction { args, body, depth };
                known
                    .entry(binding.key.name.to_string())
                    .or_insert(function);
            }
        });
    }
    known
}

/// How deeply the evaluation of `e` nests, if it consists of integers, of names that are `own`, and of `known` functions.
fn depth(
    e: &Expr,
    own: &dyn Fn(&str) -> bool,
    known: &HashMap<String, IndexFunction>,
) -> Option<usize> {
    let least = match &e.kind {
        ExprKind::Name(name) if !own(&name.to_string()) => return None,
        ExprKind::Call(name, _) => known.get(&name.to_string())?.depth,
        ExprKind::Int(_) | ExprKind::Name(_) => 0,
        ExprKind::Neg(_) | ExprKind::Group(_) | ExprKind::Chain(..) => 0,
        _ => return None,
    };
    let parts = e.parts().into_iter();
    let mut depths = parts.map(|part| depth(part, own, known));
    let inside = depths.try_fold(least, |most, depth| Some(most.max(depth?)))?;
    Some(inside + 1)
}

/// What is visible where an expression stands: constants and loop variables.
#[derive(Clone)]
pub(crate) struct Scope<'m> {
    pub(super) model: &'m Model,
    pub(crate) variables: Vec<Variable>,
}

impl<'m> Scope<'m> {
    pub(crate) fn new(model: &'m Model) -> Self {
        Scope::with(model, Vec::new())
    }

    pub(crate) fn with(model: &'m Model, variables: Vec<Variable>) -> Self {
        Scope { model, variables }
    }

    /// Value of a loop variable or integer constant.
    pub(crate) fn lookup(&self, name: &str) -> Option<i64> {
        let variable = self.variables.iter().rev().find(|(n, _)| n == name);
        match variable {
            Some((_, value)) => *value,
            None => self.model.integers.get(name)?.value,
        }
    }

    /// This scope with the variable `var` = `value`.
    pub(crate) fn bind(&self, var: &Ident, value: i64) -> Self {
        let mut inner = self.clone();
        inner.variables.push((var.to_string(), Some(value)));
        inner
    }

    /// Whether `e` is an integer by its form (so that `/` would be integer division in Rust).
    pub(crate) fn is_integer(&self, e: &Expr) -> bool {
        let own = |name: &str| self.lookup(name).is_some();
        depth(e, &own, &self.model.index_functions).is_some()
    }

    /// Counts the application of a function; reports the one that is too many wherever one more follows, and returns false.
    pub(crate) fn applies(&self, e: &Expr, diag: &Diagnostics) -> bool {
        let count = self.model.applications.get().saturating_add(1);
        self.model.applications.set(count);
        if count < MAX_APPLICATIONS {
            return true;
        }
        let place = self.model.too_many.get().unwrap_or(e.loc);
        self.model.too_many.set(Some(place));
        let message = format!(
            "with this, functions are applied {MAX_APPLICATIONS} times in all, which would keep the compiler busy; name parts of the result with `let`"
        );
        diag.error(place, message);
        false
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
                    let mut end = suggest(
                        &text,
                        names,
                        "indices and ranges are known at compile time; `for i in 0..3 { … }` around entries makes `i` one",
                    );
                    if ukunits::is_known(&text) {
                        end = "; a unit is written so where no constant, loop variable or argument has its name".to_owned();
                    }
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
            ExprKind::Call(name, args) => self.applied(e, name, args, diag),
            ExprKind::Error => None,
            _ => {
                if let Some(constant) = self.constant_of_a_part(e, diag) {
                    return self.integer(&constant.ok()?, diag);
                }
                diag.error(
                    e.loc,
                    "not an integer known at compile time; indices and ranges take integers, `const`s, loop variables and functions of them",
                );
                None
            }
        }
    }

    /// An integer that a function gives.
    fn applied(&self, e: &Expr, name: &Ident, args: &[Expr], diag: &Diagnostics) -> Option<i64> {
        let Some(function) = self.model.index_functions.get(&name.to_string()) else {
            diag.error(
                e.loc,
                format!("`{name}` gives no integer known at compile time; a function in an index is declared by `let`, of integers, its arguments and functions declared before it"),
            );
            return None;
        };
        let (expected, found) = (function.args.len(), args.len());
        if expected != found {
            diag.error(name.span(), arity(name, expected, found));
            return None;
        }
        if !self.applies(e, diag) {
            return None;
        }
        let values = args.iter().map(|a| self.integer(a, diag).map(Some));
        let values: Vec<Option<i64>> = values.collect::<Option<_>>()?;
        let variables = function.args.iter().cloned().zip(values).collect();
        Scope::with(self.model, variables).integer(&function.body, diag)
    }

    /// The integers of a range.
    pub(crate) fn range(&self, range: &Range, diag: &Diagnostics) -> Option<std::ops::Range<i64>> {
        let from = self.integer(&range.from, diag)?;
        let to = self
            .integer(&range.to, diag)?
            .saturating_add(i64::from(range.inclusive));
        let length = to.saturating_sub(from);
        // Behind a constant it may well be empty.
        let literal = |e: &Expr| matches!(e.kind, ExprKind::Int(_));
        if length < 0 && literal(&range.from) && literal(&range.to) {
            let loc = range.from.loc.to(range.to.loc);
            diag.error(
                loc,
                "nothing is in this range; it goes upwards, from the smaller number",
            );
            return None;
        }
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
    pub(super) fn too_large(&self, bounds: &[&Expr], diag: &Diagnostics) {
        let mut stack = bounds.to_vec();
        let mut largest: Option<(i64, &Integer)> = None;
        while let Some(e) = stack.pop() {
            match &e.kind {
                ExprKind::Name(name) => {
                    let constant = self.model.integers.get(&name.to_string());
                    let value = constant.and_then(|c| Some((c.value?, c)));
                    largest = largest.into_iter().chain(value).max_by_key(|(n, _)| *n);
                }
                _ => stack.extend(e.parts()),
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

/// The message about a function that is given too many arguments, or too few.
pub(crate) fn arity(name: &Ident, expected: usize, found: usize) -> String {
    format!("`{name}` takes {}, found {found}", arguments(expected))
}

/// The number of arguments in words.
pub(crate) fn arguments(count: usize) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} argument{s}")
}
