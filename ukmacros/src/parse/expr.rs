//! Expressions: Rust's grammar, cut down to what can be differentiated.

use crate::diag::{Diagnostics, Loc, located};
use proc_macro2::{Ident, Span};
use syn::spanned::Spanned as _;
use ukunits::Unit;

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
    /// `0.3 [m]`, `[0.5, 2.0] [m]`: numbers of a unit.
    Quantity(Box<Expr>, Unit),
    Name(Ident),
    /// `x[i]`, `p[i][j]`, `(u + v)[0]`: what is indexed, and its indices.
    Index(Box<Expr>, Vec<Expr>),
    /// `link[i].angle`: what belongs to a body.
    Field(Box<Expr>, Ident),
    Neg(Box<Expr>),
    /// Operands joined by operators of one precedence, from left to right: flat, since sums may have thousands of terms.
    Chain(Box<Expr>, Vec<(BinaryOp, Expr)>),
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

impl BinaryOp {
    /// `+` or `-`.
    pub(crate) fn adds(self) -> bool {
        matches!(self, BinaryOp::Add | BinaryOp::Sub)
    }
}

/// `from..to`.
#[derive(Clone, Debug)]
pub(crate) struct Range {
    pub(crate) from: Box<Expr>,
    pub(crate) to: Box<Expr>,
    pub(crate) inclusive: bool,
}

impl Range {
    /// Makes a range of Rust's range expression; both ends are needed.
    pub(crate) fn convert(range: syn::Expr, diag: &Diagnostics) -> Option<Self> {
        let loc = location(&range);
        let syn::Expr::Range(r) = range else {
            diag.error(loc, "expected a range such as `0..N`");
            return None;
        };
        let (Some(from), Some(to)) = (r.start, r.end) else {
            diag.error(loc, "a range needs both ends, such as `0..N`");
            return None;
        };
        Some(Range {
            from: Box::new(Expr::convert(*from, diag)),
            to: Box::new(Expr::convert(*to, diag)),
            inclusive: matches!(r.limits, syn::RangeLimits::Closed(_)),
        })
    }
}

/// The expressions that one consists of, to be looked at or to be changed.
macro_rules! parts {
    ($parts:ident, $as_ref:ident $(, $mut:ident)?) => {
        /// The expressions that it consists of, in the order of the text.
        pub(crate) fn $parts(&$($mut)? self) -> Vec<&$($mut)? Expr> {
            match &$($mut)? self.kind {
                ExprKind::Int(_) | ExprKind::Float(_) | ExprKind::Name(_) | ExprKind::Error => Vec::new(),
                ExprKind::Quantity(inner, _)
                | ExprKind::Field(inner, _)
                | ExprKind::Neg(inner)
                | ExprKind::Group(inner) => vec![inner.$as_ref()],
                ExprKind::Index(base, indices) => {
                    std::iter::once(base.$as_ref()).chain(indices).collect()
                }
                ExprKind::Chain(first, rest) => {
                    let mut parts = vec![first.$as_ref()];
                    for (_, operand) in rest {
                        parts.push(operand);
                    }
                    parts
                }
                ExprKind::Call(_, list) | ExprKind::Vector(list) => Vec::from_iter(list),
                ExprKind::Sum { range, body, .. } => {
                    vec![range.from.$as_ref(), range.to.$as_ref(), body.$as_ref()]
                }
            }
        }
    };
}

impl Expr {
    /// Makes an expression of Rust's; what has no meaning here is reported and becomes [`ExprKind::Error`].
    pub(crate) fn convert(e: syn::Expr, diag: &Diagnostics) -> Self {
        let loc = location(&e);
        let kind = match e {
            syn::Expr::Binary(_) => chain(e, diag),
            // Everything is an `f64`: a cast to it says nothing.
            syn::Expr::Cast(c) if is_f64(&c.ty) => return Expr::convert(*c.expr, diag),
            other => simple(other, loc, diag),
        };
        Expr { loc, kind }
    }

    /// `name`.
    pub(crate) fn name(name: Ident) -> Self {
        Expr {
            loc: name.span().into(),
            kind: ExprKind::Name(name),
        }
    }

    /// `leg[2].foot[0].x` as names with their indices; nothing if it has another form.
    pub(crate) fn segments(&self) -> Option<Vec<(Ident, Vec<Expr>)>> {
        match &self.kind {
            ExprKind::Name(name) => Some(vec![(name.clone(), Vec::new())]),
            ExprKind::Field(base, name) => {
                let mut segments = base.segments()?;
                segments.push((name.clone(), Vec::new()));
                Some(segments)
            }
            ExprKind::Index(base, indices) => {
                let mut segments = base.segments()?;
                segments.last_mut()?.1.extend(indices.iter().cloned());
                Some(segments)
            }
            _ => None,
        }
    }

    parts!(parts, as_ref);
    parts!(parts_mut, as_mut, mut);

    /// Visits all names in it, of values and of functions.
    pub(crate) fn names(&self, visit: &mut dyn FnMut(&Ident)) {
        if let ExprKind::Name(name) | ExprKind::Call(name, _) = &self.kind {
            visit(name);
        }
        self.parts().iter().for_each(|part| part.names(visit));
    }

    /// What stands for an expression that is reported already.
    pub(crate) fn error(loc: Loc) -> Self {
        Expr {
            loc,
            kind: ExprKind::Error,
        }
    }
}

/// An expression of this compiler's own, whose every token stands where the macro is called.
pub(crate) fn own(text: &str) -> Expr {
    let diag = Diagnostics::default();
    match syn::parse_str(text) {
        Ok(e) => Expr::convert(e, &diag),
        Err(e) => Expr::error(e.span().into()),
    }
}

/// The range of `e`, found without walking through it: operands may be many.
pub(super) fn location(e: &syn::Expr) -> Loc {
    let (start, end) = (leftmost(e), rightmost(e));
    Loc {
        start: start.unwrap_or_else(|e| located(e).start),
        end: end.unwrap_or_else(|e| located(e).end),
    }
}

/// The span of the first token, or what to take it of.
fn leftmost(mut e: &syn::Expr) -> Result<Span, &syn::Expr> {
    loop {
        e = match e {
            syn::Expr::Binary(b) => &b.left,
            syn::Expr::MethodCall(m) => &m.receiver,
            syn::Expr::Call(c) => &c.func,
            syn::Expr::Index(i) => &i.expr,
            syn::Expr::Cast(c) => &c.expr,
            syn::Expr::Field(f) => &f.base,
            syn::Expr::Assign(a) => &a.left,
            syn::Expr::Group(g) => &g.expr,
            syn::Expr::Range(r) => match &r.start {
                Some(start) => start,
                None => return Ok(located(&r.limits).start),
            },
            syn::Expr::Paren(p) => return Ok(p.paren_token.span.open()),
            syn::Expr::Array(a) => return Ok(a.bracket_token.span.open()),
            syn::Expr::Unary(u) => return Ok(located(&u.op).start),
            other => return Err(other),
        };
    }
}

/// The span of the last token, or what to take it of.
fn rightmost(mut e: &syn::Expr) -> Result<Span, &syn::Expr> {
    loop {
        e = match e {
            syn::Expr::Binary(b) => &b.right,
            syn::Expr::Unary(u) => &u.expr,
            syn::Expr::Assign(a) => &a.right,
            syn::Expr::Closure(c) => &c.body,
            syn::Expr::Group(g) => &g.expr,
            syn::Expr::Range(r) => match &r.end {
                Some(end) => end,
                None => return Ok(located(&r.limits).end),
            },
            syn::Expr::Cast(c) => return Ok(located(&c.ty).end),
            syn::Expr::Field(f) => return Ok(located(&f.member).end),
            syn::Expr::Paren(p) => return Ok(p.paren_token.span.close()),
            syn::Expr::Call(c) => return Ok(c.paren_token.span.close()),
            syn::Expr::MethodCall(m) => return Ok(m.paren_token.span.close()),
            syn::Expr::Index(i) => return Ok(i.bracket_token.span.close()),
            syn::Expr::Array(a) => return Ok(a.bracket_token.span.close()),
            other => return Err(other),
        };
    }
}

fn is_f64(ty: &syn::Type) -> bool {
    matches!(ty, syn::Type::Path(p) if p.path.is_ident("f64"))
}

/// Operands and operators, taken apart from the right: Rust nests them to the left.
fn chain(mut e: syn::Expr, diag: &Diagnostics) -> ExprKind {
    let mut operations = Vec::new();
    while let syn::Expr::Binary(b) = e {
        match binary_op(&b.op) {
            Ok(op) => operations.push((op, *b.right)),
            Err(message) => {
                diag.error(located(&b.op), message);
                return ExprKind::Error;
            }
        }
        e = *b.left;
    }
    let first = Expr::convert(e, diag);
    let start = first.loc.start;
    let mut done = first;
    let mut chain: Vec<(BinaryOp, Expr)> = Vec::new();
    let close = |first: Expr, chain: Vec<(BinaryOp, Expr)>| {
        let end = chain.last().map_or(first.loc.end, |(_, last)| last.loc.end);
        Expr {
            loc: Loc { start, end },
            kind: ExprKind::Chain(Box::new(first), chain),
        }
    };
    for (op, right) in operations.into_iter().rev() {
        // What binds more tightly comes first: `a * b` is the first operand of `a * b + c`.
        if chain
            .last()
            .is_some_and(|(last, _)| last.adds() != op.adds())
        {
            done = close(done, std::mem::take(&mut chain));
        }
        chain.push((op, Expr::convert(right, diag)));
    }
    let whole = close(done, chain);
    two_readings(&whole, diag);
    whole.kind
}

/// Reports a unit at the end of a product or sum of numbers that some read as that of all of it: `PI / 2 [rad]`, `1 + 2 [mm]`.
fn two_readings(whole: &Expr, diag: &Diagnostics) {
    let ExprKind::Chain(first, rest) = &whole.kind else {
        return;
    };
    let operands = std::iter::once((BinaryOp::Add, &**first));
    let operands = operands.chain(rest.iter().map(|(op, operand)| (*op, operand)));
    let quantity = |e: &Expr| matches!(e.kind, ExprKind::Quantity(..));
    let bare = |e: &Expr| match e.kind {
        ExprKind::Int(n) => n != 0,
        ExprKind::Float(x) => x != 0.0,
        _ => false,
    };
    let sum = rest.first().is_some_and(|(op, _)| op.adds());
    let beside = sum && operands.clone().any(|(_, e)| quantity(e));
    for (op, e) in operands {
        if op == BinaryOp::Div && quantity(e) {
            let message = "a unit belongs to the number before it, here a divisor; write `(a / b) [m]` for the unit of a quotient, and `a / (b [m])` for this";
            diag.error(e.loc, message);
        } else if beside && bare(e) {
            diag.error(
                e.loc,
                "a number without a unit beside one that has one; give it its own",
            );
        }
    }
}

/// Everything but operators between operands.
fn simple(e: syn::Expr, loc: Loc, diag: &Diagnostics) -> ExprKind {
    let boxed = |e: syn::Expr| Box::new(Expr::convert(e, diag));
    let all = |list: syn::punctuated::Punctuated<syn::Expr, syn::Token![,]>| -> Vec<Expr> {
        list.into_iter().map(|e| Expr::convert(e, diag)).collect()
    };
    let refuse = |loc: Loc, message: &str| {
        diag.error(loc, message);
        ExprKind::Error
    };
    match e {
        syn::Expr::Lit(l) => literal(&l.lit, diag),
        syn::Expr::Path(p) => match name_of(&p) {
            Ok(name) => ExprKind::Name(name),
            Err(message) => refuse(loc, &message),
        },
        syn::Expr::Paren(p) => ExprKind::Group(boxed(*p.expr)),
        syn::Expr::Group(g) => ExprKind::Group(boxed(*g.expr)),
        syn::Expr::Unary(u) => match u.op {
            syn::UnOp::Neg(_) => ExprKind::Neg(boxed(*u.expr)),
            syn::UnOp::Deref(star) => refuse(
                star.span().into(),
                "`**` is not a power in Rust; write `x.powi(2)` or `sq(x)`",
            ),
            _ => refuse(loc, "`!` has no meaning in an equation"),
        },
        syn::Expr::Index(i) => match text(&i.index) {
            Some(unit) => quantity(*i.expr, &unit, diag),
            None => indexed(i, diag),
        },
        syn::Expr::Call(c) => match &*c.func {
            syn::Expr::Path(p) => match name_of(p) {
                Ok(name) if name == "sum" => sum(c, loc, diag),
                Ok(name) => ExprKind::Call(name, all(c.args)),
                Err(message) => refuse(located(p), &message),
            },
            other => refuse(
                location(other),
                "only a function's name can be called, such as `sin(x)`; an entry that begins with a parenthesis needs a `,` before it",
            ),
        },
        syn::Expr::MethodCall(m) => {
            if let Some(turbofish) = &m.turbofish {
                refuse(
                    located(turbofish),
                    "a function takes no type arguments here",
                )
            } else if is_iteration(&m) {
                refuse(loc, "a sum over a range is written `sum(0..N, |i| …)`")
            } else {
                let mut args = vec![Expr::convert(*m.receiver, diag)];
                args.extend(all(m.args));
                ExprKind::Call(m.method, args)
            }
        }
        syn::Expr::Array(a) => ExprKind::Vector(all(a.elems)),
        syn::Expr::Cast(c) => refuse(
            located(&c.ty),
            "everything is an `f64` here; only `as f64` is allowed",
        ),
        syn::Expr::Assign(a) => refuse(
            a.eq_token.span.into(),
            "an equation has one `=`: `lhs = rhs`",
        ),
        syn::Expr::Field(f) => match f.member {
            syn::Member::Named(name) => ExprKind::Field(boxed(*f.base), name),
            syn::Member::Unnamed(index) => refuse(
                index.span.into(),
                "a component is written with brackets: `v[0]`",
            ),
        },
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
    }
}

/// `p[i][j]` with all its indices.
fn indexed(e: syn::ExprIndex, diag: &Diagnostics) -> ExprKind {
    let (mut base, mut indices) = (*e.expr, vec![Expr::convert(*e.index, diag)]);
    while let syn::Expr::Index(inner) = base {
        indices.push(Expr::convert(*inner.index, diag));
        base = *inner.expr;
    }
    indices.reverse();
    ExprKind::Index(Box::new(Expr::convert(base, diag)), indices)
}

/// What a unit became before it was read.
fn text(index: &syn::Expr) -> Option<String> {
    match index {
        syn::Expr::Lit(syn::ExprLit {
            lit: syn::Lit::Str(text),
            ..
        }) => Some(text.value()),
        _ => None,
    }
}

/// `e` in the unit that `text` names; one in error is told already.
fn quantity(e: syn::Expr, text: &str, diag: &Diagnostics) -> ExprKind {
    let e = Expr::convert(e, diag);
    let named = match &e.kind {
        ExprKind::Name(name) => name != "PI",
        ExprKind::Index(..) | ExprKind::Field(..) | ExprKind::Call(..) | ExprKind::Sum { .. } => {
            true
        }
        _ => false,
    };
    if named {
        diag.error(
            e.loc,
            "a unit stands behind numbers, such as `0.3 [m]`; what has a name has the unit that it is declared with",
        );
        return ExprKind::Error;
    }
    match Unit::parse(text) {
        Ok(unit) => ExprKind::Quantity(Box::new(e), unit),
        Err(_) => e.kind,
    }
}

fn name_of(path: &syn::ExprPath) -> Result<Ident, String> {
    if let Some(ident) = path.path.get_ident().filter(|_| path.qself.is_none()) {
        return Ok(ident.clone());
    }
    let last = path.path.segments.last().map(|s| s.ident.to_string());
    let last = last.unwrap_or_default();
    let here = match last.as_str() {
        "TAU" => "2 * PI",
        "E" => "exp(1)",
        "SQRT_2" => "sqrt(2)",
        "LN_2" => "ln(2)",
        "LN_10" => "ln(10)",
        "INFINITY" | "NEG_INFINITY" | "NAN" | "MAX" | "MIN" | "EPSILON" | "MIN_POSITIVE" => {
            return Err(format!(
                "no paths here, and nothing is called `{last}`; numbers are finite, and written out: `1e9`"
            ));
        }
        last => match last.strip_prefix("FRAC_PI_") {
            Some(by) => return Err(format!("no paths here; write `PI / {by}`")),
            None => last,
        },
    };
    Err(format!("no paths here; write `{here}`"))
}

/// Whether this is what Rust sums over a range with: `(0..n).map(|i| …).sum()`.
fn is_iteration(call: &syn::ExprMethodCall) -> bool {
    let mut names = [
        "map",
        "fold",
        "product",
        "filter",
        "iter",
        "into_iter",
        "rev",
    ]
    .iter();
    let closure = |e: &syn::Expr| matches!(e, syn::Expr::Closure(_));
    call.method == "sum" || names.any(|name| call.method == name) && call.args.iter().any(closure)
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
        syn::Lit::Int(i) => refuse(&suffixed(i.base10_digits(), i.suffix())),
        syn::Lit::Float(f) => refuse(&suffixed(f.base10_digits(), f.suffix())),
        syn::Lit::Str(text) if text.value().trim().parse::<f64>().is_ok() => refuse(&format!(
            "a number has no quotes: `{}`",
            text.value().trim()
        )),
        syn::Lit::Str(text) if syn::parse_str::<syn::Expr>(&text.value()).is_ok() => {
            refuse(&format!(
                "not a number; a name has no quotes: `{}`",
                text.value().trim()
            ))
        }
        _ => refuse("not a number"),
    }
}

/// What is wrong with a number that ends in letters.
fn suffixed(digits: &str, suffix: &str) -> String {
    let bits = suffix.strip_prefix(['i', 'u', 'f']).unwrap_or_default();
    match bits == "size" || bits.parse::<u32>().is_ok() {
        true => "only `f64` numbers here; drop the suffix".to_owned(),
        false => format!("a product is written with its sign: `{digits} * {suffix}`"),
    }
}

/// What is wrong with `==`.
pub(super) const TWO_SIGNS: &str = "an equation is written with one `=`";

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
        BinOp::Eq(_) => return Err(TWO_SIGNS),
        BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) | BinOp::Ne(_) => {
            return Err("no comparisons in an equation; use `min`, `max`, `abs` or `sign`");
        }
        _ => return Err("this operator has no meaning in an equation; use `+ - * /`"),
    })
}

fn sum(call: syn::ExprCall, loc: Loc, diag: &Diagnostics) -> ExprKind {
    let usage = "`sum` is written `sum(0..N, |i| …)`";
    let mut args = call.args.into_iter();
    let (Some(range), Some(syn::Expr::Closure(closure)), None) =
        (args.next(), args.next(), args.next())
    else {
        diag.error(loc, usage);
        return ExprKind::Error;
    };
    let mut inputs = closure.inputs.iter();
    let (Some(syn::Pat::Ident(var)), None) = (inputs.next(), inputs.next()) else {
        diag.error(location(&syn::Expr::Closure(closure)), usage);
        return ExprKind::Error;
    };
    match Range::convert(range, diag) {
        Some(range) => ExprKind::Sum {
            var: var.ident.clone(),
            range,
            body: Box::new(Expr::convert(*closure.body, diag)),
        },
        None => ExprKind::Error,
    }
}
