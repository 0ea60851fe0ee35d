//! Names and places of a part's declaration, as they become those of the whole.

use super::LOADS;
use super::types::Variable;
use crate::parse::{Block, Entry, Expr, ExprKind, Function, Key, Let, Range};
use proc_macro2::{Ident, Span};
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

/// `binding` where the loop variables have these values.
pub(super) fn bound(binding: Let, variables: &[Variable], span: Span) -> Block<Let> {
    let mut block = Block::One(binding);
    for (name, value) in variables.iter().rev() {
        let Some(value) = value else {
            continue;
        };
        let int = |n: i64| {
            Box::new(Expr {
                loc: span.into(),
                kind: ExprKind::Int(n),
            })
        };
        block = Block::For {
            var: Ident::new(name, span),
            range: Range {
                from: int(*value),
                to: int(value.saturating_add(1)),
                inclusive: false,
            },
            body: vec![block],
        };
    }
    block
}

/// Whether `e` uses one of these names.
pub(super) fn uses(e: &Expr, names: &HashSet<String>) -> bool {
    let mut found = false;
    e.names(&mut |name| found |= names.contains(&name.to_string()));
    found
}

/// Names of a part that become those of the whole, at the place where the part is declared.
pub(super) struct Renaming {
    pub(super) names: HashMap<String, String>,
    /// Names of the part's constraints, which [`LOADS`] alone use.
    pub(super) constraints: HashMap<String, String>,
    /// Names of parts.
    pub(super) parts: HashSet<String>,
    /// Arguments of the functions around.
    pub(super) hidden: Vec<String>,
    /// What the whole declares by `let`, and the ground if it declares one: names of the vocabulary that the part means otherwise.
    pub(super) own: Rc<HashSet<String>>,
    /// A name of these that the part uses.
    pub(super) clash: Option<String>,
    pub(super) span: Span,
}

impl Renaming {
    pub(super) fn name(&mut self, name: &mut Ident) {
        let text = name.to_string();
        let hidden = self.hidden.contains(&text);
        let new = self.names.get(&text).filter(|_| !hidden);
        *name = match new {
            Some(new) => Ident::new(new, self.span),
            None => {
                if !hidden && self.own.contains(&text) {
                    self.clash = self.clash.take().or(Some(text));
                }
                let mut same = name.clone();
                same.set_span(self.span);
                same
            }
        };
    }

    pub(super) fn key(&mut self, key: &mut Key) {
        self.name(&mut key.name);
        self.exprs(&mut key.indices);
        for (name, indices) in &mut key.fields {
            name.set_span(self.span);
            self.exprs(indices);
        }
        key.loc = self.span.into();
    }

    pub(super) fn entry(&mut self, entry: &mut Entry) {
        self.key(&mut entry.key);
        self.expr(&mut entry.value);
    }

    /// The name of a constraint or an output.
    pub(super) fn result(&mut self, key: &mut Key, prefix: &str) {
        let text = format!("{prefix}_{}", key.name);
        self.key(key);
        key.name = Ident::new(&text, self.span);
    }

    /// The name of a constraint, with its indices and that of a row.
    fn constraint(&self, e: &mut Expr) {
        match &mut e.kind {
            ExprKind::Name(name) => {
                if let Some(full) = self.constraints.get(&name.to_string()) {
                    *name = Ident::new(full, self.span);
                }
            }
            ExprKind::Index(inner, _) | ExprKind::Field(inner, _) => self.constraint(inner),
            _ => {}
        }
    }

    /// Whether the function that is called with `args` is of a part: `foot.f(x)`.
    fn of_part(&self, args: &[Expr]) -> bool {
        let part = match args.first().map(|first| &first.kind) {
            Some(ExprKind::Index(base, _)) => &base.kind,
            Some(kind) => kind,
            None => return false,
        };
        let ExprKind::Name(part) = part else {
            return false;
        };
        let text = part.to_string();
        self.parts.contains(&text) && !self.hidden.contains(&text)
    }

    fn exprs(&mut self, list: &mut [Expr]) {
        list.iter_mut().for_each(|e| self.expr(e));
    }

    pub(super) fn expr(&mut self, e: &mut Expr) {
        e.loc = self.span.into();
        match &mut e.kind {
            ExprKind::Name(name) => self.name(name),
            ExprKind::Field(_, name) => name.set_span(self.span),
            ExprKind::Call(name, args) => {
                if self.of_part(args) {
                    name.set_span(self.span);
                } else {
                    // Arguments hide values, not functions.
                    let hidden = std::mem::take(&mut self.hidden);
                    self.name(name);
                    self.hidden = hidden;
                }
                if LOADS.iter().any(|load| name == load) {
                    args.iter_mut().for_each(|arg| self.constraint(arg));
                }
            }
            ExprKind::Sum { var, range, body } => {
                self.range(range);
                var.set_span(self.span);
                self.hidden.push(var.to_string());
                self.expr(body);
                self.hidden.pop();
                return;
            }
            _ => {}
        }
        e.parts_mut().into_iter().for_each(|part| self.expr(part));
    }

    pub(super) fn function(&mut self, function: &mut Function) {
        self.hidden = function.args.iter().map(Ident::to_string).collect();
        self.expr(&mut function.body);
        self.hidden.clear();
    }

    fn range(&mut self, range: &mut Range) {
        self.expr(&mut range.from);
        self.expr(&mut range.to);
    }

    pub(super) fn blocks<T>(
        &mut self,
        blocks: &mut [Block<T>],
        each: &mut dyn FnMut(&mut Self, &mut T),
    ) {
        for block in blocks {
            match block {
                Block::One(entry) => each(self, entry),
                Block::For { var, range, body } => {
                    self.range(range);
                    let text = var.to_string();
                    *var = Ident::new(&format!("{text}_of_part"), self.span);
                    let before = self.names.insert(text.clone(), var.to_string());
                    self.blocks(body, each);
                    match before {
                        Some(before) => self.names.insert(text, before),
                        None => self.names.remove(&text),
                    };
                }
            }
        }
    }
}
