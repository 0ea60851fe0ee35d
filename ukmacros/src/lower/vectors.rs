//! The vocabulary of vectors and matrices: short for what could be written in components, which is what becomes of it.

use super::array::{Value, describe, sum_of_products};
use super::{Env, Lowering};
use crate::parse::{Expr, ExprKind};
use proc_macro2::Ident;
use ukalgebra::expr::Func;
use ukalgebra::expr::{Graph, Id};

/// A function of vectors or matrices. A declaration may give its name another meaning by `let`.
pub(super) struct Operation {
    pub(super) name: &'static str,
    arity: usize,
    /// What it takes, in words.
    takes: &'static str,
    /// The value of the operation, if the shapes of its arguments are right.
    value: fn(&mut Graph, &[Value]) -> Option<Value>,
}

macro_rules! operations {
    ($($name:literal($arity:literal, $takes:literal): $value:expr;)*) => {
        pub(super) static OPERATIONS: &[Operation] =
            &[$(Operation { name: $name, arity: $arity, takes: $takes, value: $value }),*];
    };
}

operations! {
    "sq"(1, "a number or a vector"): |g, v| match v[0].shape() {
        [] => Some(v[0].map(|id| g.square(id))),
        _ => inner(g, &v[0], &v[0]).map(Value::Scalar),
    };
    "inner"(2, "two vectors of one length"): |g, v| inner(g, &v[0], &v[1]).map(Value::Scalar);
    "cross"(2, "two vectors of 3, or two of 2"): |g, v| cross(g, &v[0], &v[1]);
    "norm"(1, "a vector"): |g, v| norm(g, &v[0]).map(Value::Scalar);
    "normalise"(1, "a vector"): |g, v| {
        let length = norm(g, &v[0])?;
        Some(v[0].map(|id| g.div(id, length)))
    };
    "normal"(1, "a vector of 2"): |g, v| {
        let ([2], Some(length)) = (v[0].shape(), norm(g, &v[0])) else {
            return None;
        };
        let [x, y] = [0, 1].map(|k| g.div(v[0].entries()[k], length));
        Some(Value::vector(vec![g.neg(y), x]))
    };
    "normals"(1, "a vector of 3"): |g, v| normals(g, &v[0]);
    "rot"(1, "a number"): |g, v| {
        let [s, c, minus] = turn(g, &v[0])?;
        Some(Value::new(&[2, 2], vec![c, minus, s, c]))
    };
    "rotx"(1, "a number"): |g, v| about(g, &v[0], 0);
    "roty"(1, "a number"): |g, v| about(g, &v[0], 1);
    "rotz"(1, "a number"): |g, v| about(g, &v[0], 2);
    "friction"(2, "a velocity, made with `dot` or of a body, and a number"): |g, v| {
        let &Value::Scalar(force) = &v[1] else {
            return None;
        };
        // The other way round it would push all the same.
        if !v[0].entries().iter().any(|id| g.uses(*id).velocity) {
            return None;
        }
        let against = g.neg(force);
        Some(match v[0].shape() {
            [] => v[0].map(|id| {
                let sign = g.call1(Func::Sign, id);
                g.mul(against, sign)
            }),
            _ => {
                let length = norm(g, &v[0])?;
                v[0].map(|id| g.product(&[(against, 1), (id, 1), (length, -1)]))
            }
        })
    };
    "transpose"(1, "a matrix"): |_, v| v[0].transposed();
}

/// The names of all operations.
#[cfg(test)]
pub(crate) fn vocabulary() -> impl Iterator<Item = &'static str> {
    OPERATIONS.iter().map(|operation| operation.name)
}

/// Σ uᵢ vᵢ.
fn inner(g: &mut Graph, u: &Value, v: &Value) -> Option<Id> {
    let vectors = u.shape().len() == 1 && u.shape() == v.shape();
    let pairs = u.entries().iter().zip(v.entries());
    vectors.then(|| sum_of_products(pairs, g))
}

/// √(Σ vᵢ²); of a single component, or of one beside zeros, its magnitude, whose kink is known.
fn norm(g: &mut Graph, v: &Value) -> Option<Id> {
    let squared = inner(g, v, v)?;
    let present = v.entries().iter().copied().filter(|id| !g.is_zero(*id));
    let present: Vec<Id> = present.collect();
    if let ([_, _, ..], Some(multiplier)) = (&present[..], common_multiplier(&present, g)) {
        let direction = v.map(|id| g.div(id, multiplier));
        let (size, length) = (g.call1(Func::Abs, multiplier), norm(g, &direction)?);
        return Some(g.mul(size, length));
    }
    Some(match present[..] {
        [id] => g.call1(Func::Abs, id),
        _ => g.call1(Func::Sqrt, squared),
    })
}

/// The multiplier that all these have as a factor: of a force in one direction it decides the sign.
fn common_multiplier(ids: &[Id], g: &Graph) -> Option<Id> {
    let multipliers = |id: &Id| -> Vec<Id> {
        let factors = g.factors(*id).into_iter();
        let simple = factors.filter(|(base, power)| *power == 1 && g.uses(*base).multiplier);
        simple.map(|(base, _)| base).collect()
    };
    let (first, rest) = ids.split_first()?;
    let shared = |id: &Id| rest.iter().all(|other| multipliers(other).contains(id));
    multipliers(first).into_iter().find(shared)
}

/// u × v in space; its one component in the plane.
pub(super) fn cross(g: &mut Graph, u: &Value, v: &Value) -> Option<Value> {
    let mut minor = |i: usize, j: usize| {
        let (u, v) = (u.entries(), v.entries());
        let (plus, minus) = (g.mul(u[i], v[j]), g.mul(u[j], v[i]));
        g.sub(plus, minus)
    };
    match (u.shape(), v.shape()) {
        ([2], [2]) => Some(Value::Scalar(minor(0, 1))),
        ([3], [3]) => Some(Value::vector(vec![minor(1, 2), minor(2, 0), minor(0, 1)])),
        _ => None,
    }
}

/// Two unit vectors that make a right-handed frame with v, after Duff et al., Journal of Computer Graphics Techniques 6 (2017) 1: both are
/// smooth but where the third component of v changes its sign.
fn normals(g: &mut Graph, v: &Value) -> Option<Value> {
    let ([3], Some(length)) = (v.shape(), norm(g, v)) else {
        return None;
    };
    let [x, y, z] = [0, 1, 2].map(|k| g.div(v.entries()[k], length));
    let (zero, one) = (g.zero(), g.one());
    let minus = g.neg(one);
    let sign = match g.as_const(z) {
        Some(z) => g.constant(if z < 0.0 { -1.0 } else { 1.0 }),
        None => g.select(zero, z, one, minus),
    };
    let sum = g.add(sign, z);
    let sx = g.mul(sign, x);
    let quotient = |g: &mut Graph, a: Id, b: Id| g.product(&[(a, 1), (b, 1), (sum, -1)]);
    let (xx, xy, yy) = (quotient(g, sx, x), quotient(g, x, y), quotient(g, y, y));
    let (first, second) = (g.sub(one, xx), g.sub(sign, yy));
    let (twist, other) = (g.mul(sign, xy), g.neg(xy));
    let entries = vec![first, g.neg(twist), g.neg(sx), other, second, g.neg(y)];
    Some(Value::new(&[2, 3], entries))
}

/// sin a, cos a and −sin a.
fn turn(g: &mut Graph, a: &Value) -> Option<[Id; 3]> {
    let Value::Scalar(a) = *a else {
        return None;
    };
    let (c, s) = (g.call1(Func::Cos, a), g.call1(Func::Sin, a));
    Some([s, c, g.neg(s)])
}

/// The matrix that turns vectors by the angle `a` about the coordinate axis `axis`.
fn about(g: &mut Graph, a: &Value, axis: usize) -> Option<Value> {
    let [s, c, minus] = turn(g, a)?;
    let mut entries = vec![g.zero(); 9];
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    entries[4 * axis] = g.one();
    for (row, column, id) in [(j, j, c), (j, k, minus), (k, j, s), (k, k, c)] {
        entries[3 * row + column] = id;
    }
    Some(Value::new(&[3, 3], entries))
}

impl<'m> Lowering<'m> {
    /// The value of `operation` at `args`.
    pub(super) fn operate(
        &mut self,
        operation: &'static Operation,
        e: &Expr,
        name: &Ident,
        args: &[Expr],
        env: &Env<'m>,
    ) -> Value {
        if args.len() != operation.arity {
            return self.arity(name, operation.arity, args.len());
        }
        let values: Vec<Value> = args.iter().map(|a| self.value(a, env)).collect();
        if values.iter().any(Value::is_error) {
            return Value::Error;
        }
        let values = match operation.name {
            // Of directions lengths do not count.
            "normalise" | "normal" | "normals" => {
                values.into_iter().map(|v| self.plain_numbers(v)).collect()
            }
            _ => values,
        };
        (operation.value)(&mut self.graph, &values).unwrap_or_else(|| {
            let found: Vec<String> = values.iter().map(|v| describe(v.shape())).collect();
            let (takes, found) = (operation.takes, found.join(" and "));
            self.error(e.loc, format!("`{name}` takes {takes}, found {found}"))
        })
    }

    /// Whether `e` is short for a sum written without parentheses: its terms are added one by one to what stands beside it.
    pub(super) fn adds_up(&self, e: &Expr) -> bool {
        matches!(&e.kind, ExprKind::Call(name, _) if name == "sq"
            || name == "inner" && !self.is_function("inner"))
    }
}
