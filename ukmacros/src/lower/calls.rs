//! Functions: those of the table, of vectors, and of the declaration.

use super::array::Value;
use super::bodies::FIELDS;
use super::parts::{PARTS, joints};
use super::vectors::OPERATIONS;
use super::{Binding, Env, Lowering, Place};
use crate::diag::{Diagnostics, suggest};
use crate::model::{Reported, Scope, arity, elsewhere};
use crate::parse::{Expr, ExprKind};
use proc_macro2::Ident;
use ukalgebra::expr::Derivative;
use ukalgebra::expr::Func;
use ukalgebra::expr::Id;

/// Largest exponent of `powi`.
const MAX_POWER: i32 = 64;

/// The functions of the language that expressions use.
fn vocabulary() -> impl Iterator<Item = &'static str> {
    let table = Func::all().map(|f| f.row().name);
    let table = table.chain(["powi", "recip", "dot", "sum", "reaction", "moment"]);
    table.chain(OPERATIONS.iter().map(|o| o.name))
}

impl<'m> Lowering<'m> {
    pub(super) fn call(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        if let Some(value) = self.of_part(e, name, args, env) {
            return value;
        }
        if self.is_function(&text) {
            // Bodies keep what is theirs, whatever functions are called.
            let own = ["at", "along"].contains(&text.as_str());
            return match args.first().filter(|_| own).map(|a| self.argument(a, env)) {
                Some(Value::Body(_) | Value::Point(_)) => self.of_body(e, name, args, env),
                _ => self.apply(e, name, args, env),
            };
        }
        match text.as_str() {
            "dot" => return self.dot(e, name, args, env),
            "reaction" | "moment" => return self.reaction(e, name, args, env),
            "at" | "along" => return self.of_body(e, name, args, env),
            "ddot" => {
                let message = "accelerations are what is solved for; no section may use them";
                return self.error_once(name, message);
            }
            "powi" => return self.powi(name, args, env),
            "recip" => {
                let [u] = args else {
                    return self.arity(name, 1, args.len());
                };
                let Some(u) = self.number(u, env) else {
                    return Value::Error;
                };
                return Value::Scalar(self.graph.pow(u, -1));
            }
            "pow" => {
                let message =
                    "a power is written `x.powi(2)`, with a whole exponent, `x.powf(y)` or `sq(x)`";
                return self.error_once(name, message);
            }
            "signum" => {
                let message = "`signum(0.0)` is 1 in Rust; write `sign`, which is 0 at 0";
                return self.error_once(name, message);
            }
            _ => {}
        }
        if let Some(operation) = OPERATIONS.iter().find(|o| text == o.name) {
            return self.operate(operation, e, name, args, env);
        }
        if PARTS.iter().any(|part| text == part.name) {
            return self.joint(e, name, args, env);
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

    /// A power with a whole exponent.
    fn powi(&mut self, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let [base, exponent] = args else {
            return self.arity(name, 2, args.len());
        };
        let base = self.number(base, env);
        if let ExprKind::Float(number) = exponent.kind {
            let message =
                format!("`powi` takes a whole exponent, such as `2`; write `powf({number:?})`");
            return self.error(exponent.loc, message);
        }
        if let ExprKind::Name(given) = &exponent.kind
            && env
                .scope
                .integer(exponent, &Diagnostics::default())
                .is_none()
        {
            let message = format!(
                "`{given}` is not an integer constant, which `powi` takes; others go with `powf`"
            );
            return self.error(exponent.loc, message);
        }
        let (Some(base), Some(n)) = (base, env.scope.integer(exponent, self.diag)) else {
            return Value::Error;
        };
        match i32::try_from(n) {
            Ok(n) if (-MAX_POWER..=MAX_POWER).contains(&n) => {
                Value::Scalar(self.graph.pow(base, n))
            }
            _ => self.error(
                exponent.loc,
                format!("`powi` takes exponents from -{MAX_POWER} to {MAX_POWER}; use `powf`"),
            ),
        }
    }

    /// `leg[0].turn(a)`: the value of a function that the part `leg[0]` declares, if that is what is called.
    fn of_part(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Option<Value> {
        let (part, args) = args.split_first()?;
        let mut segments = part.segments().filter(|_| !self.written)?;
        if env.args.iter().any(|(n, _)| segments[0].0 == n) {
            return None;
        }
        segments.push((name.clone(), Vec::new()));
        let quiet = Diagnostics::default();
        match env.scope.in_part(&segments, &quiet)? {
            Ok(found) if found.used < segments.len() => None,
            Ok(found) if self.is_function(&found.name.to_string()) => {
                Some(self.apply(e, &found.name, args, env))
            }
            Ok(found) => Some(self.unknown_function(&found.name, env)),
            Err(Reported) if self.functions().contains(&name.to_string().as_str()) => None,
            // Told again, aloud.
            Err(Reported) => env
                .scope
                .in_part(&segments, self.diag)
                .map(|_| Value::Error),
        }
    }

    /// The names of all functions.
    fn functions(&self) -> Vec<&str> {
        let mut names: Vec<&str> = vocabulary().chain(["at", "along"]).collect();
        names.extend(PARTS.iter().map(|part| part.name));
        names.extend(self.own_functions());
        names
    }

    /// The names of the functions that the declaration has.
    fn own_functions(&self) -> impl Iterator<Item = &str> {
        let lets = self.lets.iter();
        let own = lets.filter(|(_, binding)| matches!(binding, Binding::Function(_)));
        own.map(|(name, _)| name.as_str())
    }

    /// Whether `let` declares a function of this name, where it is the modeller who calls.
    pub(super) fn is_function(&self, name: &str) -> bool {
        !self.written && matches!(self.lets.get(name), Some(Binding::Function(_)))
    }

    /// Whether a function of the declaration is being applied.
    pub(super) fn applying(&self) -> bool {
        !self.active.is_empty()
    }

    pub(super) fn arity(&mut self, name: &Ident, expected: usize, found: usize) -> Value {
        self.error(name.span(), arity(name, expected, found))
    }

    /// Reports what is wrong with calling `name`, once for all its calls.
    pub(super) fn error_once(&mut self, name: &Ident, message: impl Into<String>) -> Value {
        match self.unknown.insert(name.to_string()) {
            true => self.error(name.span(), message),
            false => Value::Error,
        }
    }

    fn unknown_function(&mut self, name: &Ident, env: &Env<'m>) -> Value {
        let text = name.to_string();
        if crate::parse::is_freed(&text) && !self.diag.is_empty() {
            return Value::Error;
        }
        let known = self.model.names.contains_key(&text) || self.lets.contains_key(&text);
        if known || env.args.iter().any(|(n, _)| *n == text) {
            let message =
                format!("`{text}` is not a function; write `*` for a product, `,` between entries");
            return self.error_once(name, message);
        }
        let list = vocabulary().collect::<Vec<_>>().join(", ");
        let mut remedy = format!("functions are {list}, and those declared by `let f = |u| …;`");
        if matches!(env.place, Place::Holonomic | Place::Nonholonomic) {
            remedy = format!("joints are {}; {remedy}", joints());
        }
        // What the declaration has is nearer than what other programs call so.
        let own = suggest(&text, self.own_functions(), "");
        let end = match elsewhere(&text) {
            Some(here) if own == "; " => format!("; {here}"),
            _ => suggest(&text, self.functions(), &remedy),
        };
        self.error_once(name, format!("unknown function `{text}`{end}"))
    }

    /// Applies a function declared by `let`.
    fn apply(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let text = name.to_string();
        let Some(Binding::Function(function)) = self.lets.get(&text) else {
            return self.unknown_function(name, env);
        };
        let function = function.clone();
        if args.len() != function.args.len() {
            return self.arity(name, function.args.len(), args.len());
        }
        if self.active.contains(&text) {
            return self.error(
                name.span(),
                format!("`{text}` calls itself; functions cannot be recursive"),
            );
        }
        if !env.scope.applies(e, self.diag) {
            return Value::Error;
        }
        let values: Vec<Value> = args.iter().map(|a| self.argument(a, env)).collect();
        if values.iter().any(Value::is_error) {
            return Value::Error;
        }
        // An integer argument may serve as an index inside the function; another hides a constant of its name.
        let names = || function.args.iter().map(Ident::to_string);
        let integers = names().zip(args).map(|(parameter, a)| {
            let integer = env.scope.is_integer(a);
            (
                parameter,
                integer.then(|| env.scope.integer(a, self.diag)).flatten(),
            )
        });
        let inner = Env {
            scope: Scope::with(self.model, integers.collect()),
            args: names().zip(values).collect(),
            place: Place::Let,
        };
        if self.active.is_empty() {
            self.outermost = Some(e.loc);
        }
        self.active.push(text);
        let value = self.argument(&function.body, &inner);
        self.active.pop();
        self.allowed_value(value, e.loc, env)
    }

    /// Whether this is a point of a body, or what belongs to one.
    fn is_of_body(&mut self, e: &Expr, env: &Env<'m>) -> bool {
        match &e.kind {
            ExprKind::Field(_, name) => FIELDS.iter().any(|field| name == field),
            _ => matches!(self.argument(e, env), Value::Point(_)),
        }
    }

    /// `dot(u)`: q̇ of a coordinate, the total time derivative of an expression of q and t.
    fn dot(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let [u] = args else {
            return self.arity(name, 1, args.len());
        };
        // The argument may use coordinates even where a velocity may not stand; the velocity itself is checked below.
        let value = self.value(u, env);
        if value.is_error() {
            return Value::Error;
        }
        let ids = value.entries();
        if ids.iter().any(|id| self.graph.uses(*id).velocity) {
            return self.error(
                e.loc,
                "the time derivative of a velocity is an acceleration, which is what is solved for; no section may use it",
            );
        }
        if ids.iter().any(|id| self.graph.uses(*id).multiplier) {
            return self.error(e.loc, "the time derivative of a reaction is not solved for");
        }
        // What is unknown stands as zero, and is reported. A point may stand still: of the ground, or of a body that is welded to it.
        let fixed = ids.iter().all(|id| self.graph.uses(*id).constant());
        if fixed && self.unknown.is_empty() && !self.is_of_body(u, env) {
            return self.error(u.loc, "this does not change with time; `dot` takes a coordinate or an expression of coordinates and `t`");
        }
        let mut total = Derivative::total();
        let value = value.map(|id| total.of(id, &mut self.graph));
        self.allowed_value(value, e.loc, env)
    }
}
