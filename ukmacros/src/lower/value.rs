//! Arithmetic: expressions to values.

use super::array::{MAX_ENTRIES, Value, describe};
use super::{Env, Lowering, Place};
use crate::diag::{Diagnostics, Loc};
use crate::parse::{BinaryOp, Expr, ExprKind};
use ukalgebra::expr::{Graph, Id, Node, Uses};
use ukalgebra::expr::{Point, eval};

/// Deeper evaluation is refused, since it recurses: expressions within functions within functions.
const MAX_DEPTH: usize = 300;

impl<'m> Lowering<'m> {
    /// A number; 0 for what is in error.
    pub(super) fn scalar(&mut self, e: &Expr, env: &Env<'m>) -> Id {
        self.number(e, env).unwrap_or_else(|| self.graph.zero())
    }

    /// A number, unless it is in error.
    pub(super) fn number(&mut self, e: &Expr, env: &Env<'m>) -> Option<Id> {
        let value = self.value(e, env);
        self.of_shape(&value, &[], e.loc)?.first().copied()
    }

    pub(super) fn error(&mut self, loc: impl Into<Loc>, message: impl Into<String>) -> Value {
        self.diag.error(loc, message);
        Value::Error
    }

    /// Reports an array, or a product, of so many numbers or terms, once for all that is made of it.
    pub(super) fn too_long(&mut self, what: &str, count: usize, loc: Loc) -> Value {
        if !std::mem::replace(&mut self.oversized, true) {
            let message = format!("{what} of {count} terms; up to {MAX_ENTRIES} compile");
            self.error(loc, message);
        }
        Value::Error
    }

    /// A number or an array of numbers.
    pub(super) fn value(&mut self, e: &Expr, env: &Env<'m>) -> Value {
        let value = self.argument(e, env);
        if matches!(env.place, Place::Output) && matches!(value, Value::Point(_)) {
            self.note("output", std::slice::from_ref(&value));
        }
        self.numbers(value, e.loc)
    }

    /// A value as numbers: of a point its place, of a joint its rows; a body has none.
    pub(super) fn numbers(&mut self, value: Value, loc: Loc) -> Value {
        match value {
            Value::Point(point) => point.place.clone(),
            Value::Joint(joint) => joint.rows.clone(),
            Value::Body(body) => {
                let message = format!(
                    "`{body}` is a body; choose a point of it, `{body}.at([…])`, or what belongs to it, such as `{body}.omega`"
                );
                self.error(loc, message)
            }
            value => value,
        }
    }

    /// A value that may be a body, a point of one, or a joint.
    pub(super) fn argument(&mut self, e: &Expr, env: &Env<'m>) -> Value {
        if self.depth >= MAX_DEPTH {
            return self.error(
                self.outermost.unwrap_or(e.loc),
                "functions call each other too deeply; name parts of the result with `let`",
            );
        }
        self.depth += 1;
        let value = match self.dimensions.is_some() {
            true => self.measured(e, env),
            false => self.value_of(e, env),
        };
        self.depth -= 1;
        value
    }

    pub(super) fn value_of(&mut self, e: &Expr, env: &Env<'m>) -> Value {
        if let ExprKind::Field(..) | ExprKind::Index(..) = &e.kind
            && let Some(value) = self.in_part(e, env)
        {
            return value;
        }
        match &e.kind {
            ExprKind::Error => Value::Error,
            #[allow(
                clippy::cast_precision_loss,
                reason = "an integer in a formula is a number"
            )]
            ExprKind::Int(n) => Value::Scalar(self.graph.constant(*n as f64)),
            ExprKind::Float(x) => Value::Scalar(self.graph.constant(*x)),
            ExprKind::Quantity(numbers, unit) => self.quantity(e, numbers, unit, env),
            ExprKind::Group(inner) => self.argument(inner, env),
            ExprKind::Field(base, name) => self.field(base, name, env),
            ExprKind::Name(name) => self.name(name, &[], env),
            ExprKind::Index(base, indices) => match &base.kind {
                ExprKind::Name(name) => self.name(name, indices, env),
                _ => {
                    let value = self.value(base, env);
                    self.part(value, "this", indices, env)
                }
            },
            ExprKind::Chain(first, rest) if rest.iter().all(|(op, _)| !op.adds()) => {
                self.product(first, rest, env)
            }
            ExprKind::Neg(_) | ExprKind::Chain(..) => {
                let mut terms = Vec::new();
                self.chain(e, 1.0, env, &mut terms);
                let value = self.total(&terms, false);
                self.finite(value, e.loc, env)
            }
            ExprKind::Vector(components) => {
                if components.is_empty() {
                    return self.error(e.loc, "a vector needs at least one component");
                }
                let parts = components.iter().map(|c| self.value(c, env));
                let parts: Vec<Value> = parts.collect();
                let entries = Value::count(&parts);
                if entries > MAX_ENTRIES {
                    return self.too_long("array", entries, e.loc);
                }
                if self.oversized && parts.iter().any(Value::is_error) {
                    return Value::Error;
                }
                Value::stack(&parts, self.graph.zero()).unwrap_or_else(|odd| {
                    let sound = parts.iter().find(|part| !part.is_error());
                    let expected = describe(sound.map_or(&[], Value::shape));
                    let found = describe(parts[odd].shape());
                    let message = format!("expected {expected} as before it, found {found}");
                    self.error(components[odd].loc, message)
                })
            }
            ExprKind::Sum { var, range, body } => {
                let Some(range) = env.scope.range(range, self.diag) else {
                    return Value::Error;
                };
                let mut terms = Vec::new();
                let before = self.diag.len();
                for i in range {
                    let mut inner = env.clone();
                    inner.scope = env.scope.bind(var, i);
                    inner.args.retain(|(name, _)| var != name);
                    self.chain(body, 1.0, &inner, &mut terms);
                    if self.diag.len() > before {
                        break;
                    }
                }
                let value = self.total(&terms, false);
                self.finite(value, e.loc, env)
            }
            ExprKind::Call(name, args) => {
                let value = self.call(e, name, args, env);
                self.finite(value, e.loc, env)
            }
        }
    }

    /// Factors and divisors from left to right.
    fn product(&mut self, first: &Expr, rest: &[(BinaryOp, Expr)], env: &Env<'m>) -> Value {
        let quiet = Diagnostics::default();
        let integer = |e: &Expr| {
            let by_form = env.scope.is_integer(e);
            by_form.then(|| env.scope.integer(e, &quiet)).flatten()
        };
        // What stands so far: as an integer, if it is one; an array, if there is one; factors.
        let mut whole = integer(first);
        let mut array: Option<Value> = None;
        let mut factors: Vec<(Id, i32)> = Vec::with_capacity(rest.len() + 1);
        let mut failed = false;
        self.factor_next();
        match self.value(first, env) {
            Value::Scalar(id) => factors.push((id, 1)),
            Value::Error => failed = true,
            value => array = Some(value),
        }
        for (op, operand) in rest {
            let loc = first.loc.to(operand.loc);
            let divides = *op == BinaryOp::Div;
            let by = integer(operand);
            if let (true, Some(x), Some(y)) = (divides, whole, by)
                && x.checked_rem(y).is_some_and(|r| r != 0)
            {
                let plain = [first, operand].map(|e| matches!(e.kind, ExprKind::Int(_)));
                return self.integer_division([x, y], plain == [true; 2], loc);
            }
            whole = match (whole, by) {
                (Some(x), Some(y)) if divides => x.checked_div(y),
                (Some(x), Some(y)) => x.checked_mul(y),
                _ => None,
            };
            self.factor_next();
            match self.value(operand, env) {
                Value::Error => failed = true,
                Value::Scalar(id) if divides && self.graph.is_zero(id) => {
                    self.error(operand.loc, "division by zero");
                    failed = true;
                }
                Value::Scalar(id) => factors.push((id, if divides { -1 } else { 1 })),
                value if divides => {
                    let found = describe(value.shape());
                    self.error(operand.loc, format!("cannot divide by {found}"));
                    failed = true;
                }
                value => {
                    let product = match &array {
                        None => value,
                        Some(left) => self.times(left, &value, loc),
                    };
                    failed |= product.is_error();
                    array = Some(product);
                }
            }
            failed |= !self.fold_numbers(&mut factors, loc, env);
        }
        if failed {
            return Value::Error;
        }
        let Some(array) = array else {
            return Value::Scalar(self.graph.product(&factors));
        };
        array.map(|c| {
            factors.push((c, 1));
            let product = self.graph.product(&factors);
            factors.pop();
            product
        })
    }

    /// Reports that x/y, which may be `plain` as it stands, is rounded.
    fn integer_division(&mut self, [x, y]: [i64; 2], plain: bool, loc: Loc) -> Value {
        let division = "is an integer division, which Rust rounds to";
        let rounded = x / y;
        let message = match plain {
            true => format!("`{x} / {y}` {division} {rounded}; write `{x}.0 / {y}.0`"),
            false => format!(
                "this, of {x} by {y}, {division} {rounded}; it may stand in an index, and in a formula needs a number, as `2.0`"
            ),
        };
        self.error(loc, message)
    }

    /// Makes one number of two, as Rust would multiply them, one by one; whether it is one.
    fn fold_numbers(&mut self, factors: &mut Vec<(Id, i32)>, loc: Loc, env: &Env<'m>) -> bool {
        let [(a, 1), (b, _)] = factors[..] else {
            return true;
        };
        let (Some(x), Some(y)) = (self.graph.as_const(a), self.graph.as_const(b)) else {
            return true;
        };
        let folded = self.graph.product(factors);
        *factors = vec![(folded, 1)];
        let vanished = x != 0.0 && y != 0.0 && self.graph.is_zero(folded);
        if vanished {
            self.error(loc, "this constant is too small for an `f64`");
        }
        !self.finite(Value::Scalar(folded), loc, env).is_error() && !vanished
    }

    /// The product of two arrays, if there is one.
    fn times(&mut self, left: &Value, right: &Value, loc: Loc) -> Value {
        match left.terms(right) {
            // What is in error has no shape.
            _ if left.is_error() => Value::Error,
            Some(terms) if terms <= MAX_ENTRIES => left.times(right, &mut self.graph),
            Some(terms) => self.too_long("product", terms, loc),
            None => self.error(loc, no_product(left.shape(), right.shape())),
        }
    }

    /// `value`, unless it is a number that is infinite or not a number. (Constants and defaults are checked as a whole.)
    fn finite(&mut self, value: Value, loc: Loc, env: &Env<'m>) -> Value {
        if let Value::Scalar(id) = value
            && !matches!(
                env.place,
                Place::Const | Place::Until | Place::Choice | Place::Default
            )
            && !self.graph_finite(id)
        {
            return self.error(
                loc,
                "this constant is not a finite number; there is nothing it could mean in an equation",
            );
        }
        value
    }

    /// Whether the constant part of `id` is finite.
    fn graph_finite(&self, id: Id) -> bool {
        let g = &self.graph;
        match g.node(g.unscaled(id).1) {
            Node::Const(x) => x.get().is_finite(),
            Node::Sum(c, _) if !c.get().is_finite() => false,
            _ if g.uses(id) == Uses::default() => eval(g, &[id], &Point::NOWHERE)[0].is_finite(),
            _ => true,
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
            ExprKind::Chain(first, rest) if rest.iter().all(|(op, _)| op.adds()) => {
                self.chain(first, sign, env, out);
                for (op, operand) in rest {
                    let sign = if *op == BinaryOp::Sub { -sign } else { sign };
                    self.chain(operand, sign, env, out);
                }
            }
            ExprKind::Neg(inner) => self.chain(inner, -sign, env, out),
            _ => {
                let value = self.value(e, env);
                self.term(e, value, sign, out);
            }
        }
    }

    /// The `value` of `e` as a term of a sum.
    pub(super) fn term(
        &mut self,
        e: &Expr,
        value: Value,
        sign: f64,
        out: &mut Vec<(f64, Value, Loc)>,
    ) {
        match value {
            Value::Scalar(sum) if self.adds_up(e) => {
                let terms = self.graph.open(sign, sum).into_iter();
                out.extend(terms.map(|(c, id)| (c, Value::Scalar(id), e.loc)));
            }
            _ => out.push((sign, value, e.loc)),
        }
    }

    /// Sum of numbers, or of arrays of one shape; the number 0, as a sum over nothing is, fits all. `open` joins the sums inside arrays to
    /// one (the sides of an equation).
    pub(super) fn total(&mut self, terms: &[(f64, Value, Loc)], open: bool) -> Value {
        if terms.iter().any(|(_, value, _)| value.is_error()) {
            return Value::Error;
        }
        let zero = |value: &Value, g: &Graph| matches!(value, Value::Scalar(id) if g.is_zero(*id));
        let values = || terms.iter().map(|(_, value, _)| value);
        let Some(first) = values().find(|v| !zero(v, &self.graph)).or(values().next()) else {
            return Value::Scalar(self.graph.zero());
        };
        let expected = first.shape();
        let open = open && !expected.is_empty();
        // Terms of each component.
        let mut sums: Vec<Vec<(f64, Id)>> = vec![Vec::new(); first.entries().len()];
        for (sign, value, loc) in terms {
            if value.shape() != expected {
                if zero(value, &self.graph) {
                    continue;
                }
                let (expected, found) = (describe(expected), describe(value.shape()));
                return self.error(*loc, format!("expected {expected}, found {found}"));
            }
            for (sum, id) in sums.iter_mut().zip(value.entries()) {
                match open {
                    true => sum.extend(self.graph.open(*sign, *id)),
                    false => sum.push((*sign, *id)),
                }
            }
        }
        let clash = self.dimensions.is_some() && self.terms_clash(terms);
        let sums = sums.iter().map(|terms| self.graph.sum(terms));
        let value = Value::new(expected, sums.collect());
        if clash {
            self.told(&value);
        }
        value
    }
}

/// Why arrays of these shapes have no product.
fn no_product(left: &[usize], right: &[usize]) -> String {
    let (a, b) = (describe(left), describe(right));
    match (left, right) {
        ([_], [_]) => format!(
            "the product of two vectors is not defined ({a} and {b}); write `inner(u, v)` or `cross(u, v)`"
        ),
        ([_], [_, _]) => {
            format!("{a} times {b} is not defined; write `transpose(m) * v`")
        }
        _ => format!(
            "{a} times {b} is not defined; a matrix has as many columns as what it multiplies has rows"
        ),
    }
}
