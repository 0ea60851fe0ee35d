//! Arithmetic: expressions to values.

use super::{Env, Lowering, Value};
use crate::diag::{Diagnostics, Loc};
use crate::expr::graph::Id;
use crate::model::Scope;
use crate::parse::{BinaryOp, Expr, ExprKind};

impl<'m> Lowering<'m> {
    pub(super) fn scalar(&mut self, e: &Expr, env: &Env<'m>) -> Id {
        match self.value(e, env) {
            Value::Scalar(id) => id,
            Value::Vector(v) => {
                self.diag.error(
                    e.loc,
                    format!("expected a number, found a vector of {}", v.len()),
                );
                self.graph.zero()
            }
            Value::Error => self.graph.zero(),
        }
    }

    pub(super) fn error(&mut self, loc: impl Into<Loc>, message: impl Into<String>) -> Value {
        self.diag.error(loc, message);
        Value::Error
    }

    pub(super) fn value(&mut self, e: &Expr, env: &Env<'m>) -> Value {
        match &e.kind {
            ExprKind::Error => Value::Error,
            #[allow(
                clippy::cast_precision_loss,
                reason = "an integer in a formula is a number"
            )]
            ExprKind::Int(n) => Value::Scalar(self.graph.constant(*n as f64)),
            ExprKind::Float(x) => Value::Scalar(self.graph.constant(*x)),
            ExprKind::Group(inner) => self.value(inner, env),
            ExprKind::Name(name) => self.name(name, env),
            ExprKind::Index(name, index) => self.indexed(name, index, env),
            ExprKind::Neg(_) | ExprKind::Binary(BinaryOp::Add | BinaryOp::Sub, ..) => {
                let mut terms = Vec::new();
                self.chain(e, 1.0, env, &mut terms);
                self.total(&terms, false)
            }
            ExprKind::Binary(BinaryOp::Mul, a, b) => {
                let (va, vb) = (self.value(a, env), self.value(b, env));
                match (va, vb) {
                    (Value::Error, _) | (_, Value::Error) => Value::Error,
                    (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(self.graph.mul(a, b)),
                    (Value::Scalar(s), Value::Vector(v)) | (Value::Vector(v), Value::Scalar(s)) => {
                        Value::Vector(v.into_iter().map(|c| self.graph.mul(s, c)).collect())
                    }
                    (Value::Vector(_), Value::Vector(_)) => self.error(
                        e.loc,
                        "the product of two vectors is not defined; write out the components",
                    ),
                }
            }
            ExprKind::Binary(BinaryOp::Div, a, b) => self.quotient(e, a, b, env),
            ExprKind::Vector(components) => {
                let components = components
                    .iter()
                    .map(|c| self.scalar(c, env))
                    .collect::<Vec<_>>();
                if components.is_empty() {
                    return self.error(e.loc, "a vector needs at least one component");
                }
                Value::Vector(components)
            }
            ExprKind::Sum { var, range, body } => {
                if !env.scope.loop_variable(var, self.diag) {
                    return Value::Error;
                }
                let Some(range) = env.scope.range(range, self.diag) else {
                    return Value::Error;
                };
                let mut terms = Vec::new();
                let before = self.diag.len();
                for i in range {
                    let mut inner = env.clone();
                    inner.scope = env.scope.bind(var, i);
                    self.chain(body, 1.0, &inner, &mut terms);
                    if self.diag.len() > before {
                        break;
                    }
                }
                self.total(&terms, false)
            }
            ExprKind::Call(name, args) => self.call(e, name, args, env),
        }
    }

    pub(super) fn quotient(&mut self, e: &Expr, a: &Expr, b: &Expr, env: &Env<'m>) -> Value {
        if is_integer(a, &env.scope) && is_integer(b, &env.scope) {
            let quiet = Diagnostics::default();
            let (x, y) = (env.scope.integer(a, &quiet), env.scope.integer(b, &quiet));
            if let (Some(x), Some(y)) = (x, y)
                && y != 0
                && x % y != 0
            {
                return self.error(
                    e.loc,
                    format!("`{x} / {y}` is an integer division, which Rust rounds to {}; write `{x}.0 / {y}.0`", x / y),
                );
            }
        }
        let top = self.value(a, env);
        let bottom = match self.value(b, env) {
            Value::Scalar(id) => id,
            Value::Vector(_) => return self.error(b.loc, "cannot divide by a vector"),
            Value::Error => return Value::Error,
        };
        if self.graph.is_zero(bottom) {
            return self.error(b.loc, "division by zero");
        }
        match top {
            Value::Scalar(a) => Value::Scalar(self.graph.div(a, bottom)),
            Value::Vector(v) => {
                Value::Vector(v.into_iter().map(|c| self.graph.div(c, bottom)).collect())
            }
            Value::Error => Value::Error,
        }
    }

    /// Terms of a sum written without parentheses, with their sign.
    pub(super) fn chain(
        &mut self,
        e: &Expr,
        sign: f64,
        env: &Env<'m>,
        out: &mut Vec<(f64, Value, Loc)>,
    ) {
        match &e.kind {
            ExprKind::Binary(BinaryOp::Add, a, b) => {
                self.chain(a, sign, env, out);
                self.chain(b, sign, env, out);
            }
            ExprKind::Binary(BinaryOp::Sub, a, b) => {
                self.chain(a, sign, env, out);
                self.chain(b, -sign, env, out);
            }
            ExprKind::Neg(inner) => self.chain(inner, -sign, env, out),
            _ => {
                let value = self.value(e, env);
                out.push((sign, value, e.loc));
            }
        }
    }

    /// Sum of scalars, or of vectors of one length. `open` joins the sums inside vectors to one (the sides of an equation).
    pub(super) fn total(&mut self, terms: &[(f64, Value, Loc)], open: bool) -> Value {
        let expected = match terms.first() {
            None => return Value::Scalar(self.graph.zero()),
            Some((_, Value::Vector(v), _)) => Some(v.len()),
            Some(_) => None,
        };
        let describe =
            |l: Option<usize>| l.map_or("a number".to_owned(), |n| format!("a vector of {n}"));
        // Terms of each component.
        let mut sums: Vec<Vec<(f64, Id)>> = vec![Vec::new(); expected.unwrap_or(1)];
        for (sign, value, loc) in terms {
            let found = match value {
                Value::Error => return Value::Error,
                Value::Scalar(id) if expected.is_none() => {
                    sums[0].push((*sign, *id));
                    continue;
                }
                Value::Vector(ids) if expected == Some(ids.len()) => {
                    for (sum, id) in sums.iter_mut().zip(ids) {
                        if open {
                            sum.extend(self.graph.open(*sign, *id));
                        } else {
                            sum.push((*sign, *id));
                        }
                    }
                    continue;
                }
                // `v = 0` compares each component with 0.
                Value::Scalar(id) if open && self.graph.is_zero(*id) => continue,
                Value::Scalar(_) => None,
                Value::Vector(ids) => Some(ids.len()),
            };
            return self.error(
                *loc,
                format!("expected {}, found {}", describe(expected), describe(found)),
            );
        }
        let sums: Vec<Id> = sums.iter().map(|terms| self.graph.sum(terms)).collect();
        match expected {
            None => Value::Scalar(sums[0]),
            Some(_) => Value::Vector(sums),
        }
    }
}

/// Whether `e` is an integer by its form (so that `/` would be integer division in Rust).
pub(super) fn is_integer(e: &Expr, scope: &Scope<'_>) -> bool {
    match &e.kind {
        ExprKind::Int(_) => true,
        ExprKind::Name(n) => scope.lookup(&n.to_string()).is_some(),
        ExprKind::Neg(a) | ExprKind::Group(a) => is_integer(a, scope),
        ExprKind::Binary(_, a, b) => is_integer(a, scope) && is_integer(b, scope),
        _ => false,
    }
}
