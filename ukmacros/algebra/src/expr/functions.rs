//! The functions of the language, each in a row of one table: all that the compiler knows of a function stands there.
//!
//! Domains: where a function has no derivative, one is chosen and the emitted code follows it. abs′ is sign, with 0 at 0;
//! sign′ is 0; min and max take the branch of the smaller (larger) argument, the first at a tie. sqrt′ is unbounded at 0, asin′, acos′
//! and atanh′ at ±1, acosh′ at 1, ln′ and negative powers at 0, atan2′ and hypot′ at (0, 0): there the result is not finite.

use super::graph::{Graph, Id, Node};
use super::jet::Jet;

/// What a function is, and how it is differentiated and computed.
pub struct Function {
    /// Name in the declaration and of the method in the emitted code.
    pub name: &'static str,
    pub(super) form: Form,
    pub cost: Cost,
    pub(super) exact: Exact,
    pub(super) symmetry: Symmetry,
    /// A bound below all its values.
    pub least: Option<f64>,
}

/// The derivative of f(u, w): of u and w, each with its own, and of f(u, w).
type Derivative = fn(&mut Graph, (Id, Id), (Id, Id), Id) -> Id;

/// The function itself. Second derivatives serve the check of the symbolic ones, and are not made of them.
pub(super) enum Form {
    One {
        value: fn(f64) -> f64,
        /// f′(u), of u and f(u).
        slope: fn(&mut Graph, Id, Id) -> Id,
        /// f′ and f″ at x, of x and f(x).
        derivatives: fn(f64, f64) -> (f64, f64),
    },
    Two {
        value: fn(f64, f64) -> f64,
        derivative: Derivative,
        jet: fn(Jet, Jet) -> Jet,
    },
}

/// What an evaluation counts as.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Cost {
    Selection,
    SquareRoot,
    Transcendental,
}

/// The constants at which a value is exact, so that folding it does not make the emitted code depend on the compiling machine's libm.
pub(super) enum Exact {
    Never,
    /// f(x) = y.
    At(f64, f64),
    Always,
}

/// Nodes that one node serves.
#[derive(PartialEq, Eq)]
pub(super) enum Symmetry {
    None,
    /// f(−u) = f(u).
    Even,
    /// f(−u) = −f(u).
    Odd,
    /// f(u, w) = f(w, u).
    Commutative,
}

impl Function {
    const fn new(name: &'static str, form: Form) -> Self {
        Function {
            name,
            form,
            cost: Cost::Transcendental,
            exact: Exact::Never,
            symmetry: Symmetry::None,
            least: None,
        }
    }
    const fn counts(mut self, cost: Cost) -> Self {
        self.cost = cost;
        self
    }
    const fn exact(mut self, exact: Exact) -> Self {
        self.exact = exact;
        self
    }
    const fn is(mut self, symmetry: Symmetry) -> Self {
        self.symmetry = symmetry;
        self
    }
    const fn at_least(mut self, least: f64) -> Self {
        self.least = Some(least);
        self
    }
}

const fn one(
    name: &'static str,
    value: fn(f64) -> f64,
    slope: fn(&mut Graph, Id, Id) -> Id,
    derivatives: fn(f64, f64) -> (f64, f64),
) -> Function {
    Function::new(
        name,
        Form::One {
            value,
            slope,
            derivatives,
        },
    )
}

const fn two(
    name: &'static str,
    value: fn(f64, f64) -> f64,
    derivative: Derivative,
    jet: fn(Jet, Jet) -> Jet,
) -> Function {
    Function::new(
        name,
        Form::Two {
            value,
            derivative,
            jet,
        },
    )
}

/// constant + c · id².
fn quadratic(g: &mut Graph, constant: f64, c: f64, id: Id) -> Id {
    let (constant, square) = (g.constant(constant), g.square(id));
    g.sum(&[(1.0, constant), (c, square)])
}

/// c/√id.
fn per_root(g: &mut Graph, c: f64, id: Id) -> Id {
    let root = g.call1(Func::Sqrt, id);
    let r = g.pow(root, -1);
    g.scale(c, r)
}

macro_rules! functions {
    ($($(#[$doc:meta])* $func:ident: $row:expr;)*) => {
        /// A function of one or two arguments, by its place in the table.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Func {
            $($(#[$doc])* $func,)*
        }

        static TABLE: &[(Func, Function)] = &[$((Func::$func, $row)),*];
    };
}

use Cost::{Selection, SquareRoot};
use Exact::{Always, At};
use Symmetry::{Commutative, Even, Odd};

functions! {
    Sqrt: one("sqrt", f64::sqrt, |g, _, y| { let r = g.pow(y, -1); g.scale(0.5, r) }, |x, y| (0.5 / y, -0.25 / (x * y)))
        .counts(SquareRoot).exact(Always).at_least(0.0);
    Sin: one("sin", f64::sin, |g, u, _| g.call1(Func::Cos, u), |x, y| (x.cos(), -y)).is(Odd).exact(At(0.0, 0.0));
    Cos: one("cos", f64::cos, |g, u, _| { let s = g.call1(Func::Sin, u); g.neg(s) }, |x, y| (-x.sin(), -y)).is(Even).exact(At(0.0, 1.0));
    Tan: one("tan", f64::tan, |g, _, y| quadratic(g, 1.0, 1.0, y), |_, y| (1.0 + y * y, 2.0 * y * (1.0 + y * y)))
        .is(Odd).exact(At(0.0, 0.0));
    Asin: one("asin", f64::asin, |g, u, _| { let r = quadratic(g, 1.0, -1.0, u); per_root(g, 1.0, r) }, |x, _| inverse(1.0 - x * x, x))
        .is(Odd).exact(At(0.0, 0.0));
    Acos: one("acos", f64::acos, |g, u, _| { let r = quadratic(g, 1.0, -1.0, u); per_root(g, -1.0, r) },
        |x, _| { let (slope, bend) = inverse(1.0 - x * x, x); (-slope, -bend) }).exact(At(1.0, 0.0)).at_least(0.0);
    Atan: one("atan", f64::atan, |g, u, _| { let d = quadratic(g, 1.0, 1.0, u); g.pow(d, -1) }, |x, _| rational(1.0 + x * x, -x))
        .is(Odd).exact(At(0.0, 0.0));
    Sinh: one("sinh", f64::sinh, |g, u, _| g.call1(Func::Cosh, u), |x, y| (x.cosh(), y)).is(Odd).exact(At(0.0, 0.0));
    Cosh: one("cosh", f64::cosh, |g, u, _| g.call1(Func::Sinh, u), |x, y| (x.sinh(), y)).is(Even).exact(At(0.0, 1.0)).at_least(1.0);
    Tanh: one("tanh", f64::tanh, |g, _, y| quadratic(g, 1.0, -1.0, y), |_, y| (1.0 - y * y, -2.0 * y * (1.0 - y * y)))
        .is(Odd).exact(At(0.0, 0.0));
    Asinh: one("asinh", f64::asinh, |g, u, _| { let r = quadratic(g, 1.0, 1.0, u); per_root(g, 1.0, r) }, |x, _| inverse(1.0 + x * x, -x))
        .is(Odd).exact(At(0.0, 0.0));
    Acosh: one("acosh", f64::acosh, |g, u, _| { let r = quadratic(g, -1.0, 1.0, u); per_root(g, 1.0, r) }, |x, _| inverse(x * x - 1.0, -x))
        .exact(At(1.0, 0.0)).at_least(0.0);
    Atanh: one("atanh", f64::atanh, |g, u, _| { let d = quadratic(g, 1.0, -1.0, u); g.pow(d, -1) }, |x, _| rational(1.0 - x * x, x))
        .is(Odd).exact(At(0.0, 0.0));
    Exp: one("exp", f64::exp, |_, _, y| y, |_, y| (y, y)).exact(At(0.0, 1.0)).at_least(0.0);
    Ln: one("ln", f64::ln, |g, u, _| g.pow(u, -1), |x, _| (1.0 / x, -1.0 / (x * x))).exact(At(1.0, 0.0));
    Abs: one("abs", f64::abs, |g, u, _| g.call1(Func::Sign, u), |x, _| (if x < 0.0 { -1.0 } else { 1.0 }, 0.0))
        .counts(Selection).is(Even).exact(Always).at_least(0.0);
    Sign: one("sign", |x| if x == 0.0 { 0.0 } else { x.signum() }, |g, _, _| g.zero(), |_, _| (0.0, 0.0))
        .counts(Selection).is(Odd).exact(Always);
    Atan2: two("atan2", f64::atan2, |g, (u, du), (w, dw), _| {
        let (a, b) = (g.mul(w, du), g.mul(u, dw));
        let top = g.sub(a, b);
        let (uu, ww) = (g.square(u), g.square(w));
        let bottom = g.add(uu, ww);
        g.div(top, bottom)
    }, Jet::atan2);
    Min: two("min", f64::min, |g, (u, du), (w, dw), _| g.select(u, w, du, dw), |u, w| if u.0 <= w.0 { u } else { w })
        .counts(Selection).is(Commutative).exact(Always);
    Max: two("max", f64::max, |g, (u, du), (w, dw), _| g.select(w, u, du, dw), |u, w| if u.0 >= w.0 { u } else { w })
        .counts(Selection).is(Commutative).exact(Always);
    Hypot: two("hypot", f64::hypot, |g, (u, du), (w, dw), y| {
        let (a, b) = (g.mul(u, du), g.mul(w, dw));
        let sum = g.add(a, b);
        g.div(sum, y)
    }, |u, w| Func::Sqrt.jet(u.times(u).plus(w.times(w)), None)).is(Commutative).at_least(0.0);
    Powf: two("powf", f64::powf, |g, (u, du), (w, dw), y| {
        // u^w: w u^(w−1) u′ + u^w ln u · w′; the second only where the exponent varies.
        let one = g.one();
        let lower = g.sub(w, one);
        let power = g.call2(Func::Powf, u, lower);
        let base = g.product(&[(w, 1), (power, 1), (du, 1)]);
        if g.is_zero(dw) {
            return base;
        }
        let ln = g.call1(Func::Ln, u);
        let exponent = g.product(&[(y, 1), (ln, 1), (dw, 1)]);
        g.add(base, exponent)
    }, |u, w| Func::Exp.jet(Func::Ln.jet(u, None).times(w), None));
    /// The branch held (second argument), or the switching function (first) where none is. No function of the language.
    Branch: two("branch", |u, w| if w == 0.0 { u } else { w * (2.0 - w.abs()) }, |g, _, _, _| g.zero(), |u, w| if w.0 == 0.0 { u } else { Jet::constant(w.0 * (2.0 - w.0.abs())) })
        .counts(Selection);
}

/// 1/√r and x/√r³: the derivatives of an inverse function whose slope is 1/√r, with −r′/2 = x.
fn inverse(r: f64, x: f64) -> (f64, f64) {
    (1.0 / r.sqrt(), x / (r * r.sqrt()))
}

/// 1/d and 2 x/d²: likewise for the slope 1/d with −d′ = 2 x.
fn rational(d: f64, x: f64) -> (f64, f64) {
    (1.0 / d, 2.0 * x / (d * d))
}

impl Func {
    /// The functions of the language.
    pub fn all() -> impl Iterator<Item = Func> {
        let functions = TABLE.iter().map(|(func, _)| *func);
        functions.filter(|func| *func != Func::Branch)
    }

    /// The function's row of the table.
    pub fn row(self) -> &'static Function {
        &TABLE[self as usize].1
    }

    /// Number of arguments.
    pub fn arity(self) -> usize {
        match self.row().form {
            Form::One { .. } => 1,
            Form::Two { .. } => 2,
        }
    }

    /// The value at x, or at (x, y).
    pub fn value(self, x: f64, y: f64) -> f64 {
        match self.row().form {
            Form::One { value, .. } => value(x),
            Form::Two { value, .. } => value(x, y),
        }
    }

    /// The value with its derivatives along a path.
    pub fn jet(self, u: Jet, w: Option<Jet>) -> Jet {
        match (&self.row().form, w) {
            (Form::Two { jet, .. }, Some(w)) => jet(u, w),
            (Form::Two { .. }, None) => Jet::constant(f64::NAN),
            (
                Form::One {
                    value, derivatives, ..
                },
                _,
            ) => {
                let y = value(u.0);
                let (slope, bend) = derivatives(u.0, y);
                u.chain(y, slope, bend)
            }
        }
    }

    /// The value at constants, if it is exact.
    pub(super) fn folded(self, x: f64, y: f64) -> Option<f64> {
        let value = match self.row().exact {
            Exact::Never => return None,
            Exact::At(at, value) => return (x == at).then_some(value),
            Exact::Always => self.value(x, y),
        };
        (!value.is_nan()).then_some(value)
    }
}

impl Graph {
    /// Two of the `terms` that are k c cos² u and k c sin² u, and c.
    pub(super) fn squares_of_an_angle(&mut self, terms: &[(Id, f64)]) -> Option<([usize; 2], Id)> {
        for (a, (id, k)) in terms.iter().enumerate() {
            let Node::Product(factors) = self.node(*id) else {
                continue;
            };
            for (at, (base, _)) in factors.iter().enumerate().filter(|(_, (_, e))| *e == 2) {
                let sin = match self.node(*base) {
                    Node::Call(Func::Cos, args) => self.find_call(Func::Sin, args[0]),
                    _ => None,
                };
                let Some(sin) = sin else { continue };
                let mut others = factors.to_vec();
                others[at].0 = sin;
                let alike = |(id, own): &(Id, f64)| match self.node(*id) {
                    Node::Product(factors) => {
                        own == k
                            && factors.len() == others.len()
                            && factors.iter().all(|f| others.contains(f))
                    }
                    _ => false,
                };
                if let Some(b) = terms.iter().position(alike) {
                    others.remove(at);
                    return Some(([a, b], self.product(&others)));
                }
            }
        }
        None
    }
}
