//! Names, calls, and what may stand where.

use super::value::is_integer;
use super::{Binding, Env, Lowering, Place, Value};
use crate::diag::{Loc, suggest};
use crate::expr::diff::Derivative;
use crate::expr::functions::Func;
use crate::expr::graph::{Id, Symbol};
use crate::model::{Name, Scope};
use crate::parse::Expr;
use proc_macro2::Ident;

/// Largest exponent of `powi`.
const MAX_POWER: i32 = 64;

impl<'m> Lowering<'m> {
    pub(super) fn name(&mut self, name: &Ident, env: &Env<'m>) -> Value {
        let text = name.to_string();
        if let Some((_, value)) = env.args.iter().rev().find(|(n, _)| *n == text) {
            return value.clone();
        }
        if let Some(i) = env.scope.lookup(&text) {
            #[allow(
                clippy::cast_precision_loss,
                reason = "an integer in a formula is a number"
            )]
            return Value::Scalar(self.graph.constant(i as f64));
        }
        match text.as_str() {
            "t" => return self.allowed(Symbol::Time, name.span(), env),
            "PI" => return Value::Scalar(self.graph.constant(std::f64::consts::PI)),
            _ => {}
        }
        match self.model.names.get(&text) {
            Some(Name::Param(_) | Name::Coord(_)) => self.element(name, None, env),
            Some(Name::Float(i)) => match self.floats.get(*i) {
                Some(id) => Value::Scalar(*id),
                None => self.error(
                    name.span(),
                    format!("`{text}` is declared further down; move its declaration up"),
                ),
            },
            Some(Name::Integer) | None => match self.lets.get(&text) {
                Some(Binding::Value(value)) => {
                    let value = value.clone();
                    self.allowed_value(value, name.span().into(), env)
                }
                Some(Binding::Family(_)) => self.error(
                    name.span(),
                    format!("`{text}` is a family; index it: `{text}[i]`"),
                ),
                Some(Binding::Function(_)) => self.error(
                    name.span(),
                    format!("`{text}` is a function; call it: `{text}(…)`"),
                ),
                None => self.unknown(name, env),
            },
        }
    }

    fn unknown(&mut self, name: &Ident, env: &Env<'m>) -> Value {
        let text = name.to_string();
        // Once for all its uses.
        if !self.unknown.insert(text.clone()) {
            return Value::Error;
        }
        match self.results.get(&text) {
            Some(true) => {
                return self.error(
                    name.span(),
                    format!("`{text}` is a constraint: no expression can use it, and its multiplier and force are what is solved for"),
                );
            }
            Some(false) => {
                return self.error(
                    name.span(),
                    format!("`{text}` is an output, which no expression can use; declare its value by `let`"),
                );
            }
            None => {}
        }
        let names = self.model.names.keys().chain(self.lets.keys());
        let names = names.map(String::as_str);
        let names = names.chain(env.args.iter().map(|(n, _)| n.as_str()));
        let remedy = "declare it under `params`, `coords` or by `let` before its use";
        let end = suggest(&text, names.chain(["t", "PI"]), remedy);
        self.error(name.span(), format!("unknown name `{text}`{end}"))
    }

    /// A parameter or coordinate.
    fn element(&mut self, name: &Ident, index: Option<&Expr>, env: &Env<'m>) -> Value {
        let (model, names) = (self.model, &self.model.names);
        let (family, symbol): (_, fn(usize) -> Symbol) = match names.get(&name.to_string()) {
            Some(Name::Param(family)) => (&model.params[*family], Symbol::Param),
            Some(Name::Coord(family)) => (&model.coords[*family], Symbol::Coord),
            _ => return Value::Error,
        };
        match self.member(name, index, family, &env.scope) {
            Some(i) => self.allowed(symbol(i), name.span(), env),
            None => Value::Error,
        }
    }

    pub(super) fn indexed(&mut self, name: &Ident, index: &Expr, env: &Env<'m>) -> Value {
        let text = name.to_string();
        let zero = Value::Error;
        let argument = env.args.iter().rev().find(|(n, _)| *n == text);
        let argument = argument.map(|(_, v)| v.clone());
        let vector = argument.or_else(|| match self.lets.get(&text) {
            Some(Binding::Value(value)) => Some(value.clone()),
            _ => None,
        });
        if let Some(value) = vector {
            let components = match &value {
                Value::Vector(components) => components,
                Value::Error => return zero,
                Value::Scalar(_) => {
                    return self.error(
                        index.loc,
                        format!("`{text}` is a number; write it without an index"),
                    );
                }
            };
            let Some(i) = self.integer(index, &env.scope) else {
                return zero;
            };
            return match usize::try_from(i).ok().and_then(|i| components.get(i)) {
                Some(id) => self.allowed_value(Value::Scalar(*id), name.span().into(), env),
                None => self.error(
                    index.loc,
                    format!(
                        "index {i} is out of range: `{text}` has {} components",
                        components.len()
                    ),
                ),
            };
        }
        match self.model.names.get(&text) {
            Some(Name::Param(_) | Name::Coord(_)) => self.element(name, Some(index), env),
            Some(_) => self.error(name.span(), format!("`{text}` is not a family")),
            None => match self.lets.get(&text) {
                Some(Binding::Family(members)) => {
                    let Some(i) = self.integer(index, &env.scope) else {
                        return zero;
                    };
                    match members.get(&i).cloned() {
                        Some(value) => self.allowed_value(value, name.span().into(), env),
                        // The loop that declares it ended at an error.
                        None if members.values().any(|v| matches!(v, Value::Error)) => zero,
                        None => {
                            self.error(index.loc, format!("`{text}[{i}]` is not declared (yet)"))
                        }
                    }
                }
                Some(_) => self.error(
                    name.span(),
                    format!("`{text}` is a function; call it: `{text}(…)`"),
                ),
                None => self.unknown(name, env),
            },
        }
    }

    pub(super) fn call(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        if matches!(self.lets.get(&text), Some(Binding::Function(_))) {
            return self.apply(e, name, args, env);
        }
        match text.as_str() {
            "dot" => return self.dot(e, name, args, env),
            "ddot" => {
                return self.error(
                    name.span(),
                    "accelerations are what is solved for; no section may use them",
                );
            }
            "powi" => {
                let [base, exponent] = args else {
                    return self.arity(name, 2, args.len());
                };
                let base = self.number(base, env);
                let (Some(base), Some(n)) = (base, self.integer(exponent, &env.scope)) else {
                    return Value::Error;
                };
                return match i32::try_from(n) {
                    Ok(n) if (-MAX_POWER..=MAX_POWER).contains(&n) => {
                        Value::Scalar(self.graph.pow(base, n))
                    }
                    _ => self.error(
                        exponent.loc,
                        format!(
                            "`powi` takes exponents from -{MAX_POWER} to {MAX_POWER}; use `powf`"
                        ),
                    ),
                };
            }
            "sq" | "recip" => {
                let [u] = args else {
                    return self.arity(name, 1, args.len());
                };
                let Some(u) = self.number(u, env) else {
                    return Value::Error;
                };
                let exponent = if text == "sq" { 2 } else { -1 };
                return Value::Scalar(self.graph.pow(u, exponent));
            }
            "signum" => {
                return self.error(
                    name.span(),
                    "`signum(0.0)` is 1 in Rust; write `sign`, which is 0 at 0",
                );
            }
            _ => {}
        }
        let Some(func) = Func::all().find(|f| f.row().name == text) else {
            return self.unknown_function(name, env);
        };
        if args.len() != func.arity() {
            return self.arity(name, func.arity(), args.len());
        }
        let ids: Vec<Option<Id>> = args.iter().map(|a| self.number(a, env)).collect();
        match ids[..] {
            [Some(u), Some(w)] => Value::Scalar(self.graph.call2(func, u, w)),
            [Some(u)] => Value::Scalar(self.graph.call1(func, u)),
            _ => Value::Error,
        }
    }

    fn arity(&mut self, name: &Ident, expected: usize, found: usize) -> Value {
        let s = if expected == 1 { "" } else { "s" };
        self.error(
            name.span(),
            format!("`{name}` takes {expected} argument{s}, found {found}"),
        )
    }

    fn unknown_function(&mut self, name: &Ident, env: &Env<'m>) -> Value {
        let text = name.to_string();
        let known = self.model.names.contains_key(&text) || self.lets.contains_key(&text);
        if known || env.args.iter().any(|(n, _)| *n == text) {
            return self.error(
                name.span(),
                format!("`{text}` is not a function; write `*` for a product, `,` between entries"),
            );
        }
        if !self.unknown.insert(text.clone()) {
            return Value::Error;
        }
        let mut names: Vec<&str> = Func::all().map(|f| f.row().name).collect();
        names.extend(["sq", "powi", "recip", "dot", "sum"]);
        let list = names.join(", ");
        let lets = self.lets.iter();
        let functions = lets.filter(|(_, b)| matches!(b, Binding::Function(_)));
        names.extend(functions.map(|(n, _)| n.as_str()));
        let remedy = format!("functions are {list}, and those declared by `let f = |u| …;`");
        let end = suggest(&text, names, &remedy);
        self.error(name.span(), format!("unknown function `{text}`{end}"))
    }

    /// Applies a function declared by `let`.
    fn apply(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        let Some(Binding::Function(function)) = self.lets.get(&text) else {
            return self.unknown_function(name, env);
        };
        let (parameters, body) = (function.args.clone(), function.body.clone());
        if args.len() != parameters.len() {
            return self.arity(name, parameters.len(), args.len());
        }
        if self.active.contains(&text) {
            return self.error(
                name.span(),
                format!("`{text}` calls itself; functions cannot be recursive"),
            );
        }
        let values: Vec<Value> = args.iter().map(|a| self.value(a, env)).collect();
        if values.iter().any(|v| matches!(v, Value::Error)) {
            return Value::Error;
        }
        // An integer argument may serve as an index inside the function.
        let pairs = parameters.iter().zip(args);
        let pairs = pairs.filter(|(_, a)| is_integer(a, &env.scope));
        let integers =
            pairs.filter_map(|(p, a)| Some((p.to_string(), self.integer(a, &env.scope)?)));
        let integers = integers.collect();
        let arguments = parameters.iter().map(Ident::to_string);
        let inner = Env {
            scope: Scope::with(self.model, integers),
            args: arguments.zip(values).collect(),
            place: Place::Let,
        };
        if self.active.is_empty() {
            self.outermost = Some(e.loc);
        }
        self.active.push(text);
        let value = self.value(&body, &inner);
        self.active.pop();
        self.allowed_value(value, e.loc, env)
    }

    /// `dot(u)`: q̇ of a coordinate, the total time derivative of an expression of q and t.
    fn dot(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let [u] = args else {
            return self.arity(name, 1, args.len());
        };
        // The argument may use coordinates even where a velocity may not stand; the velocity itself is checked below.
        let value = self.value(u, env);
        let ids = match &value {
            Value::Scalar(id) => vec![*id],
            Value::Vector(ids) => ids.clone(),
            Value::Error => return Value::Error,
        };
        if ids.iter().any(|id| self.graph.uses(*id).velocity) {
            return self.error(
                e.loc,
                "the time derivative of a velocity is an acceleration, which is what is solved for; no section may use it",
            );
        }
        if ids.iter().all(|id| self.graph.uses(*id).constant()) {
            return self.error(u.loc, "this does not change with time; `dot` takes a coordinate or an expression of coordinates and `t`");
        }
        let mut total = Derivative::total();
        let dots = ids.iter().map(|id| total.of(*id, &mut self.graph));
        let dots: Vec<Id> = dots.collect();
        let value = match value {
            Value::Vector(_) => Value::Vector(dots),
            _ => Value::Scalar(dots[0]),
        };
        self.allowed_value(value, e.loc, env)
    }

    fn allowed(&mut self, symbol: Symbol, span: proc_macro2::Span, env: &Env<'m>) -> Value {
        let id = self.graph.symbol(symbol);
        if env.place == Place::Default
            && let Symbol::Param(i) = symbol
            && i >= self.known_params
        {
            return self.error(span, "a default may use parameters declared above it only");
        }
        self.allowed_value(Value::Scalar(id), span.into(), env)
    }

    /// Checks that what `value` depends on may stand in this section.
    fn allowed_value(&mut self, value: Value, loc: Loc, env: &Env<'m>) -> Value {
        let ids = match &value {
            Value::Scalar(id) => std::slice::from_ref(id),
            Value::Vector(ids) => ids.as_slice(),
            Value::Error => return Value::Error,
        };
        for id in ids {
            let uses = self.graph.uses(*id);
            let refusal = match env.place {
                Place::Const if uses.param || !uses.constant() => Some(
                    "a constant is known at compile time; make it a parameter, or a value by `let`",
                ),
                Place::Default if !uses.constant() => Some(
                    "a parameter is a number; what changes with coordinates or time is declared by `let`",
                ),
                Place::Mass if uses.velocity => Some(
                    "M depends on coordinates and time only; forces that depend on velocities go under `force`",
                ),
                Place::Potential if uses.velocity => Some(
                    "a potential depends on coordinates and time only; forces that depend on velocities go under `force`",
                ),
                Place::Holonomic if uses.velocity => Some(
                    "a velocity in a holonomic constraint; move the constraint under `nonholonomic`",
                ),
                _ => None,
            };
            if let Some(message) = refusal {
                return self.error(loc, message);
            }
        }
        value
    }
}
