//! What is declared under `params`, by `let` or as an option of a start, and named nowhere.

use super::types::Model;
use crate::parse::{Applied, Block, Declaration, Expr, ExprKind, Key, Let, LetValue, Start};
use proc_macro2::Ident;
use std::collections::HashSet;

/// Names that no expression uses, those apart that begin with `_`.
#[derive(Default)]
pub(crate) struct Unused<'d> {
    pub(crate) params: Vec<&'d Ident>,
    /// Values declared by `let`.
    pub(crate) values: Vec<&'d Ident>,
    /// Functions declared by `let`.
    pub(crate) functions: Vec<&'d Ident>,
    /// Starts with options that none of their guesses uses, and these.
    pub(crate) options: Vec<(&'d Ident, Vec<&'d Ident>)>,
}

/// The names that are declared and not used.
pub(crate) fn unused<'d>(decl: &'d Declaration, model: &Model) -> Unused<'d> {
    let used = used(decl);
    let mut seen = HashSet::new();
    let mut idle = |name: &Ident| {
        let text = name.to_string();
        // What parts declare is told where they are declared.
        let own = !text.starts_with('_') && !model.shown.contains_key(&text);
        own && !used.contains(&text) && seen.insert(text)
    };
    let mut out = Unused::default();
    for block in &decl.params {
        block.each(&mut |param| out.params.extend(Some(&param.key.name).filter(|n| idle(n))));
    }
    // What a part declares by `let` is for those that it is a part of, too.
    for block in decl.lets.iter().filter(|_| !decl.part) {
        block.each(&mut |binding| {
            let list = match binding.value {
                LetValue::Value(_) => &mut out.values,
                LetValue::Function(_) => &mut out.functions,
            };
            list.extend(Some(&binding.key.name).filter(|n| idle(n)));
        });
    }
    for start in &decl.starts {
        let guessed = guessed(start);
        let idle = |name: &&Ident| {
            let text = name.to_string();
            !text.starts_with('_') && !guessed.contains(&text)
        };
        let options = start.options.iter().map(|option| &option.name);
        let options: Vec<&Ident> = options.filter(idle).collect();
        if !options.is_empty() {
            out.options.push((&start.name, options));
        }
    }
    out
}

/// The names that the guesses of a start use, its options among them.
fn guessed(start: &Start) -> HashSet<String> {
    let mut found = Names::default();
    found.blocks(&start.guesses, |guess| {
        (guess.keys.iter().collect(), vec![&guess.value])
    });
    found.used
}

/// Whether an expression uses `name`.
pub(crate) fn uses(decl: &Declaration, name: &str) -> bool {
    used(decl).contains(name)
}

/// All names that expressions use.
fn used(decl: &Declaration) -> HashSet<String> {
    let mut found = Names::default();
    for constant in &decl.consts {
        found.expr(&constant.value);
    }
    let named = [&decl.params, &decl.tree, &decl.force];
    for blocks in named.into_iter().chain([&decl.outputs, &decl.integrals]) {
        found.blocks(blocks, |entry| (vec![&entry.key], vec![&entry.value]));
    }
    found.blocks(&decl.coords, |coord| (vec![&coord.key], Vec::new()));
    found.blocks(&decl.bodies, |body| {
        let parts = body.mass.iter().chain(&body.inertia).chain(&body.centre);
        (vec![&body.key], parts.collect())
    });
    found.lets(&decl.lets);
    found.blocks(&decl.mass, |m| {
        (
            std::iter::once(&m.key).chain(&m.other).collect(),
            vec![&m.value],
        )
    });
    let terms = [&decl.gravity, &decl.kinetic, &decl.potential];
    for blocks in terms.into_iter().chain([&decl.dissipation, &decl.forces]) {
        found.blocks(blocks, |term| (Vec::new(), vec![term]));
    }
    found.blocks(&decl.nonideal, |applied| match applied {
        Applied::To(entry) => (vec![&entry.key], vec![&entry.value]),
        Applied::By(e) => (Vec::new(), vec![e]),
    });
    for blocks in [&decl.holonomic, &decl.nonholonomic] {
        found.blocks(blocks, |c| {
            (
                vec![&c.key],
                std::iter::once(&c.lhs).chain(&c.rhs).collect(),
            )
        });
    }
    found.blocks(&decl.drawing, |shape| {
        (Vec::new(), shape.args.iter().collect())
    });
    for start in &decl.starts {
        for option in &start.options {
            found.expr(&option.default);
        }
        start.until.iter().for_each(|until| found.expr(until));
        let mut guessed = guessed(start);
        for option in &start.options {
            guessed.remove(&option.name.to_string());
        }
        found.used.extend(guessed);
    }
    found.used
}

#[derive(Default)]
struct Names {
    used: HashSet<String>,
    /// Arguments of the functions around, which hide what has their names.
    hidden: Vec<String>,
}

impl Names {
    fn blocks<'d, T>(
        &mut self,
        blocks: &'d [Block<T>],
        parts: impl Fn(&'d T) -> (Vec<&'d Key>, Vec<&'d Expr>) + Copy,
    ) {
        for block in blocks {
            match block {
                Block::One(entry) => {
                    let (keys, values) = parts(entry);
                    let indices = keys.into_iter().flat_map(|key| &key.indices);
                    indices.chain(values).for_each(|e| self.expr(e));
                }
                Block::For { range, body, .. } => {
                    self.expr(&range.from);
                    self.expr(&range.to);
                    self.blocks(body, parts);
                }
            }
        }
    }

    fn lets(&mut self, lets: &[Block<Let>]) {
        self.blocks(lets, |binding| {
            let value = match &binding.value {
                LetValue::Value(value) => vec![value],
                LetValue::Function(_) => Vec::new(),
            };
            (vec![&binding.key], value)
        });
        let mut function = |binding: &Let| {
            if let LetValue::Function(function) = &binding.value {
                self.hidden = function.args.iter().map(Ident::to_string).collect();
                self.expr(&function.body);
                self.hidden.clear();
            }
        };
        lets.iter().for_each(|block| block.each(&mut function));
    }

    fn expr(&mut self, e: &Expr) {
        match &e.kind {
            ExprKind::Name(name) => {
                let text = name.to_string();
                if !self.hidden.contains(&text) {
                    self.used.insert(text);
                }
            }
            ExprKind::Call(name, _) => drop(self.used.insert(name.to_string())),
            ExprKind::Sum { var, range, body } => {
                self.expr(&range.from);
                self.expr(&range.to);
                self.hidden.push(var.to_string());
                self.expr(body);
                self.hidden.pop();
                return;
            }
            _ => {}
        }
        e.parts().into_iter().for_each(|part| self.expr(part));
    }
}
