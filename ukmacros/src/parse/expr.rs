//! Expressions: Rust's grammar, cut down to what can be differentiated.

use crate::diag::{Diagnostics, Loc};
use proc_macro2::Ident;
use syn::spanned::Spanned as _;

/// An expression and where it stands.
#[derive(Clone, Debug)]
pub(crate) struct Expr {
    pub(crate) loc: Loc,
    pub(crate) kind: ExprKind,
}

#[derive(Clone, Debug)]
pub(crate) enum ExprKind {
    Int(i64),
    Float(f64),
    Name(Ident),
    Index(Ident, Box<Expr>),
    Neg(Box<Expr>),
    Binary(BinaryOp, Box<Expr>, Box<Expr>),
    /// Parentheses: they keep a sum together, as they do in floating-point arithmetic.
    Group(Box<Expr>),
    /// `f(a, b)` or `a.f(b)`.
    Call(Ident, Vec<Expr>),
    Vector(Vec<Expr>),
    /// `sum(0..N, |i| body)`.
    Sum {
        var: Ident,
        range: Range,
        body: Box<Expr>,
    },
    /// Something already reported.
    Error,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BinaryOp {
    Add,
    Sub,
    Mul,
    Div,
}

/// `from..to`.
#[derive(Clone, Debug)]
pub(crate) struct Range {
    pub(crate) from: Box<Expr>,
    pub(crate) to: Box<Expr>,
    pub(crate) inclusive: bool,
}

impl Range {
    /// From Rust's range expression; both ends are needed.
    pub(crate) fn convert(range: &syn::Expr, diag: &Diagnostics) -> Option<Self> {
        let syn::Expr::Range(r) = range else {
            diag.error(Loc::of(range), "expected a range such as `0..N`");
            return None;
        };
        let (Some(from), Some(to)) = (&r.start, &r.end) else {
            diag.error(Loc::of(r), "a range needs both ends, such as `0..N`");
            return None;
        };
        Some(Range {
            from: Box::new(Expr::convert(from, diag)),
            to: Box::new(Expr::convert(to, diag)),
            inclusive: matches!(r.limits, syn::RangeLimits::Closed(_)),
        })
    }
}

/// Nesting beyond this is refused: deeper trees would overflow the compiler's stack.
const MAX_DEPTH: usize = 200;

impl Expr {
    /// From Rust's expression; what has no meaning here is reported and becomes [`ExprKind::Error`].
    pub(crate) fn convert(e: &syn::Expr, diag: &Diagnostics) -> Self {
        convert(e, diag, 0)
    }
}

fn convert(e: &syn::Expr, diag: &Diagnostics, depth: usize) -> Expr {
    let loc = Loc::of(e);
    if depth > MAX_DEPTH {
        diag.error(
            loc,
            "expression is nested too deeply; name parts of it with `let`",
        );
        return Expr {
            loc,
            kind: ExprKind::Error,
        };
    }
    let go = |e: &syn::Expr| convert(e, diag, depth + 1);
    let boxed = |e: &syn::Expr| Box::new(go(e));
    let all = |list: &syn::punctuated::Punctuated<syn::Expr, syn::Token![,]>| -> Vec<Expr> {
        list.iter().map(go).collect()
    };
    let refuse = |loc: Loc, message: &str| {
        diag.error(loc, message);
        ExprKind::Error
    };
    let kind = match e {
        syn::Expr::Lit(l) => literal(&l.lit, diag),
        syn::Expr::Path(p) => match name_of(p) {
            Ok(name) => ExprKind::Name(name),
            Err(message) => refuse(loc, &message),
        },
        syn::Expr::Paren(p) => ExprKind::Group(boxed(&p.expr)),
        syn::Expr::Group(g) => ExprKind::Group(boxed(&g.expr)),
        syn::Expr::Unary(u) => match u.op {
            syn::UnOp::Neg(_) => ExprKind::Neg(boxed(&u.expr)),
            syn::UnOp::Deref(star) => refuse(
                star.span().into(),
                "`**` is not a power in Rust; write `x.powi(2)` or `sq(x)`",
            ),
            _ => refuse(loc, "`!` has no meaning in an equation"),
        },
        syn::Expr::Binary(b) => match binary_op(&b.op) {
            Ok(op) => ExprKind::Binary(op, boxed(&b.left), boxed(&b.right)),
            Err(message) => refuse(Loc::of(&b.op), message),
        },
        syn::Expr::Index(i) => match &*i.expr {
            syn::Expr::Path(p) => match name_of(p) {
                Ok(name) => ExprKind::Index(name, boxed(&i.index)),
                Err(message) => refuse(loc, &message),
            },
            other => refuse(
                Loc::of(other),
                "only a named family can be indexed, such as `x[i]`",
            ),
        },
        syn::Expr::Call(c) => match &*c.func {
            syn::Expr::Path(p) => match name_of(p) {
                Ok(name) if name == "sum" => sum(c, diag, depth),
                Ok(name) => ExprKind::Call(name, all(&c.args)),
                Err(message) => refuse(Loc::of(p), &message),
            },
            other => refuse(
                Loc::of(other),
                "only a function's name can be called, such as `sin(x)`",
            ),
        },
        syn::Expr::MethodCall(m) => {
            if let Some(turbofish) = &m.turbofish {
                refuse(
                    Loc::of(turbofish),
                    "a function takes no type arguments here",
                )
            } else {
                let mut args = vec![go(&m.receiver)];
                args.extend(all(&m.args));
                ExprKind::Call(m.method.clone(), args)
            }
        }
        syn::Expr::Array(a) => ExprKind::Vector(all(&a.elems)),
        syn::Expr::Cast(c) => match &*c.ty {
            syn::Type::Path(p) if p.path.is_ident("f64") => return go(&c.expr),
            ty => refuse(
                Loc::of(ty),
                "everything is an `f64` here; only `as f64` is allowed",
            ),
        },
        syn::Expr::Assign(a) => refuse(
            a.eq_token.span.into(),
            "an equation has one `=`: `lhs = rhs`",
        ),
        syn::Expr::Field(f) => refuse(
            Loc::of(&f.member),
            "no fields here; a parameter or coordinate is written by its name alone, such as `m`",
        ),
        syn::Expr::Closure(_) => refuse(
            loc,
            "a function must be named first: `let f = |u| …;`, then `f(x)`",
        ),
        syn::Expr::If(_) | syn::Expr::Match(_) => refuse(
            loc,
            "no branches in an equation; use `min`, `max`, `abs` or `sign`",
        ),
        syn::Expr::Range(_) => refuse(
            loc,
            "a range belongs in `for i in 0..N { … }` or `sum(0..N, |i| …)`",
        ),
        syn::Expr::Tuple(_) => refuse(loc, "a vector is written `[a, b]`"),
        _ => refuse(
            loc,
            "not an equation's expression; allowed are numbers, names, `+ - * /`, functions and vectors `[a, b]`",
        ),
    };
    Expr { loc, kind }
}

fn name_of(path: &syn::ExprPath) -> Result<Ident, String> {
    if let Some(ident) = path.path.get_ident().filter(|_| path.qself.is_none()) {
        return Ok(ident.clone());
    }
    let last = path.path.segments.last().map(|s| s.ident.to_string());
    let last = last.unwrap_or_default();
    Err(format!("no paths here; write `{last}`"))
}

fn literal(lit: &syn::Lit, diag: &Diagnostics) -> ExprKind {
    let refuse = |message: &str| {
        diag.error(lit.span(), message);
        ExprKind::Error
    };
    match lit {
        syn::Lit::Int(i) if i.suffix() == "f64" => match i.base10_digits().parse::<f64>() {
            Ok(x) => ExprKind::Float(x),
            Err(_) => refuse("not a number"),
        },
        syn::Lit::Int(i) if i.suffix().is_empty() || i.suffix() == "usize" => {
            match i.base10_parse::<i64>() {
                Ok(n) => ExprKind::Int(n),
                Err(_) => refuse("integer is too large; write it as a float, such as `1e20`"),
            }
        }
        syn::Lit::Float(f) if f.suffix().is_empty() || f.suffix() == "f64" => {
            match f.base10_parse::<f64>() {
                Ok(x) if x.is_finite() => ExprKind::Float(x),
                _ => refuse("number is too large for an `f64`"),
            }
        }
        syn::Lit::Int(_) | syn::Lit::Float(_) => refuse("only `f64` numbers here; drop the suffix"),
        _ => refuse("not a number"),
    }
}

fn binary_op(op: &syn::BinOp) -> Result<BinaryOp, &'static str> {
    use syn::BinOp;
    Ok(match op {
        BinOp::Add(_) => BinaryOp::Add,
        BinOp::Sub(_) => BinaryOp::Sub,
        BinOp::Mul(_) => BinaryOp::Mul,
        BinOp::Div(_) => BinaryOp::Div,
        BinOp::BitXor(_) => {
            return Err("`^` is not a power in Rust; write `x.powi(2)`, `x.powf(y)` or `sq(x)`");
        }
        BinOp::Rem(_) => return Err("`%` cannot be differentiated; remove it"),
        BinOp::Eq(_) => return Err("an equation is written with one `=`"),
        BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) | BinOp::Ne(_) => {
            return Err("no comparisons in an equation; use `min`, `max`, `abs` or `sign`");
        }
        _ => return Err("this operator has no meaning in an equation; use `+ - * /`"),
    })
}

fn sum(call: &syn::ExprCall, diag: &Diagnostics, depth: usize) -> ExprKind {
    let usage = "`sum` is written `sum(0..N, |i| …)`";
    let mut args = call.args.iter();
    let (Some(range), Some(syn::Expr::Closure(closure)), None) =
        (args.next(), args.next(), args.next())
    else {
        diag.error(Loc::of(call), usage);
        return ExprKind::Error;
    };
    let mut inputs = closure.inputs.iter();
    let (Some(syn::Pat::Ident(var)), None) = (inputs.next(), inputs.next()) else {
        diag.error(Loc::of(closure), usage);
        return ExprKind::Error;
    };
    match Range::convert(range, diag) {
        Some(range) => ExprKind::Sum {
            var: var.ident.clone(),
            range,
            body: Box::new(convert(&closure.body, diag, depth + 1)),
        },
        None => ExprKind::Error,
    }
}
