//! Declarations within declarations: what stands in a part is taken into the whole, under names of its own, once for each of its members.

use super::resolve::bare;
use super::types::{Variable, indexed};
use crate::diag::{Diagnostics, suggest};
use crate::parse::{
    Block, Declaration, Expr, ExprKind, Key, Let, LetValue, PartUse, Range, Section, Table,
};
use proc_macro2::{Ident, Span};
use std::collections::{HashMap, HashSet};

/// A member of a part, with the loop variables around it.
struct Member {
    part: PartUse,
    indices: Vec<i64>,
    variables: Vec<Variable>,
}

/// A part of `decl` whose declaration the `table` has not.
pub(crate) fn missing<'d>(
    decl: &'d Declaration,
    table: &Table,
    diag: &Diagnostics,
) -> Option<&'d PartUse> {
    let mut missing = None;
    for block in &decl.parts {
        block.each(&mut |part| {
            if part.name == decl.name {
                diag.error(
                    part.name.span(),
                    format!("`{}` cannot be a part of itself", part.name),
                );
            } else if table.find(&part.path).is_none() {
                missing = missing.or(Some(part));
            }
        });
    }
    missing.filter(|_| diag.is_empty())
}

/// Takes the parts of `decl` into it, the declarations of which the `table` has.
pub(crate) fn merge(decl: &mut Declaration, table: &Table, diag: &Diagnostics) {
    let parts = std::mem::take(&mut decl.parts);
    if parts.is_empty() {
        return;
    }
    let quiet = Diagnostics::default();
    let model = bare(decl, &Diagnostics::default());
    let mut members: Vec<Member> = Vec::new();
    for block in &parts {
        let looped = matches!(block, Block::For { .. });
        super::Scope::new(&model).unroll(std::slice::from_ref(block), diag, &mut |part, scope| {
            let numbers = part.key.indices.iter().map(|i| scope.integer(i, diag));
            let Some(numbers) = numbers.collect::<Option<Vec<i64>>>() else {
                return;
            };
            let sizes = if looped { &[][..] } else { &numbers[..] };
            let shape: Option<Vec<usize>> =
                sizes.iter().map(|n| usize::try_from(*n).ok()).collect();
            let count = shape
                .iter()
                .flatten()
                .try_fold(1, |n: usize, size| n.checked_mul(*size));
            let Some(shape) = shape.filter(|_| count.is_some_and(|n| (1..=MOST).contains(&n)))
            else {
                let message = format!("a family of parts has from 1 to {MOST} members");
                diag.error(part.key.loc, message);
                return;
            };
            let every = super::types::every(&shape).map(|indices| match looped {
                true => numbers.clone(),
                false => indices
                    .iter()
                    .filter_map(|i| i64::try_from(*i).ok())
                    .collect(),
            });
            for indices in every {
                members.push(Member {
                    part: part.clone(),
                    indices,
                    variables: scope.variables.clone(),
                });
            }
            if members.len() > MOST {
                diag.error(
                    part.key.loc,
                    format!("these are more than {MOST} parts in all"),
                );
                members.clear();
            }
        });
    }
    let mut own: HashSet<String> = HashSet::new();
    for block in &decl.lets {
        block.each(&mut |binding| {
            own.extend([binding.key.name.to_string()]);
        });
    }
    let mut grounds = false;
    let mut ground = |key: &Key| grounds |= key.name == "ground";
    decl.params
        .iter()
        .for_each(|b| b.each(&mut |param| ground(&param.key)));
    decl.coords
        .iter()
        .for_each(|b| b.each(&mut |coord| ground(&coord.key)));
    decl.bodies
        .iter()
        .for_each(|b| b.each(&mut |body| ground(&body.key)));
    own.extend(grounds.then(|| "ground".to_owned()));
    let mut kinds: HashMap<String, String> = HashMap::new();
    let mut lets = Vec::new();
    // What all members of a part have together is declared once.
    let mut common: HashSet<String> = HashSet::new();
    for member in &members {
        let base = member.part.key.name.to_string();
        let path: String = member.part.path.to_string().split_whitespace().collect();
        let families = decl.merged.families.entry(base.clone()).or_default();
        let reason = match kinds.get(&base) {
            Some(kind) if *kind != path => Some(format!(
                "`{base}` is declared as `{kind}` and as `{path}`; rename one"
            )),
            Some(_) if families.contains(&member.indices) => Some(format!(
                "`{}` is declared twice; names must be unique",
                indexed(&base, &member.indices)
            )),
            Some(_)
                if families
                    .iter()
                    .any(|other| other.len() != member.indices.len()) =>
            {
                Some(format!(
                    "`{base}` is declared with different numbers of indices; rename one"
                ))
            }
            _ => None,
        };
        if let Some(reason) = reason {
            diag.error(member.part.key.loc, reason);
            continue;
        }
        families.push(member.indices.clone());
        kinds.insert(base, path);
        let Some(known) = table.find(&member.part.path) else {
            continue;
        };
        decl.merged.faulty |= known.faulty;
        let Some(mut inner) = crate::parse::parse(known.declaration.clone(), &quiet) else {
            continue;
        };
        merge(&mut inner, &Table::parse(known.parts.clone()), &quiet);
        decl.merged.faulty |= inner.merged.faulty;
        if let (None, Some(_)) = (&decl.gravity, &inner.gravity) {
            let name = &member.part.name;
            let message = format!(
                "`{name}` has `gravity`, and this declaration, of which it is a part, has none; give it, for all bodies"
            );
            diag.error(member.part.name.span(), message);
            return;
        }
        if !known_parameters(&member.part, &inner, diag) {
            return;
        }
        take(decl, inner, member, &own, &mut common, &mut lets, diag);
    }
    if !quiet.is_empty() && diag.is_empty() && !decl.merged.faulty {
        // What is wrong is told where it is declared.
        let part = members.first().map(|member| member.part.name.clone());
        if let Some(name) = part {
            diag.damage(
                name.span(),
                format!("`{name}`, or another part, is in error where it is declared"),
            );
        }
    }
    let at = decl.before_parts.min(decl.lets.len());
    decl.lets.splice(at..at, lets);
}

/// More members of parts would keep the compiler busy.
const MOST: usize = 1_000;

/// Whether what is given to a part are parameters of it; reports what is not.
fn known_parameters(part: &PartUse, inner: &Declaration, diag: &Diagnostics) -> bool {
    let mut names: Vec<String> = Vec::new();
    let mut looped: Vec<String> = Vec::new();
    for block in &inner.params {
        let list = match block {
            Block::One(_) => &mut names,
            Block::For { .. } => &mut looped,
        };
        block.each(&mut |param| list.push(param.key.name.to_string()));
    }
    let kind = &part.name;
    for (name, _) in &part.given {
        let text = name.to_string();
        if names.contains(&text) {
            continue;
        }
        let constant = inner.consts.iter().any(|constant| constant.name == text);
        let message = match (constant, looped.contains(&text)) {
            (true, _) => format!(
                "`{text}` is a constant of `{kind}`, the same in all parts; only parameters can be given"
            ),
            (_, true) => {
                format!("`{text}` is declared member by member in `{kind}` and cannot be given")
            }
            _ => {
                let remedy = match names.len() {
                    0 => "it has none".to_owned(),
                    _ => format!("they are `{}`", names.join("`, `")),
                };
                let end = suggest(&text, names.iter().map(String::as_str), &remedy);
                format!("`{kind}` has no parameter `{text}`{end}")
            }
        };
        diag.error(name.span(), message);
        return false;
    }
    true
}

/// Takes the part `inner` into `decl` as this member.
fn take(
    decl: &mut Declaration,
    mut inner: Declaration,
    member: &Member,
    own: &HashSet<String>,
    common: &mut HashSet<String>,
    lets: &mut Vec<Block<Let>>,
    diag: &Diagnostics,
) {
    let span = member.part.key.name.span();
    let base = member.part.key.name.to_string();
    let prefix: String = member
        .indices
        .iter()
        .fold(base.clone(), |name, i| format!("{name}_{i}"));
    let shown = indexed(&base, &member.indices);
    // Defaults that use what is given are values as well.
    let mut fixed: HashSet<String> = member
        .part
        .given
        .iter()
        .map(|(n, _)| n.to_string())
        .collect();
    for block in &inner.params {
        block.each(&mut |param| {
            if uses(&param.default, &fixed) {
                fixed.insert(param.key.name.to_string());
            }
        });
    }
    let merged = &mut decl.merged;
    let mut enter = |name: &str, shared: bool| {
        let own = inner.merged.shown.get(name).map_or(name, String::as_str);
        let (full, text) = match shared {
            true => (format!("{base}_{name}"), format!("{base}.{own}")),
            false => (format!("{prefix}_{name}"), format!("{shown}.{own}")),
        };
        merged.shown.insert(full.clone(), text);
        full
    };
    let mut names: HashMap<String, String> = HashMap::new();
    for constant in &inner.consts {
        let text = constant.name.to_string();
        names.insert(text.clone(), enter(&text, true));
    }
    for block in &inner.params {
        block.each(&mut |param| {
            let text = param.key.name.to_string();
            names.insert(text.clone(), enter(&text, !fixed.contains(&text)));
        });
    }
    let mut others: Vec<String> = Vec::new();
    inner
        .coords
        .iter()
        .for_each(|b| b.each(&mut |c| others.push(c.key.name.to_string())));
    inner
        .bodies
        .iter()
        .for_each(|b| b.each(&mut |c| others.push(c.key.name.to_string())));
    inner
        .tree
        .iter()
        .for_each(|b| b.each(&mut |c| others.push(c.key.name.to_string())));
    inner
        .lets
        .iter()
        .for_each(|b| b.each(&mut |c| others.push(c.key.name.to_string())));
    others.extend(inner.merged.families.keys().cloned());
    for text in others {
        names.insert(text.clone(), enter(&text, false));
    }
    // These have names of their own.
    let mut results: Vec<String> = Vec::new();
    inner
        .holonomic
        .iter()
        .chain(&inner.nonholonomic)
        .for_each(|b| b.each(&mut |c| results.push(c.key.name.to_string())));
    inner
        .outputs
        .iter()
        .for_each(|b| b.each(&mut |c| results.push(c.key.name.to_string())));
    for text in results {
        enter(&text, false);
    }
    for (name, indices) in &inner.merged.families {
        merged
            .families
            .insert(format!("{prefix}_{name}"), indices.clone());
    }
    merged.places.push((span.into(), shown));
    let r = &mut Renaming {
        names,
        hidden: Vec::new(),
        own,
        clash: None,
        span,
    };
    for mut constant in inner.consts {
        r.name(&mut constant.name);
        r.expr(&mut constant.value);
        if common.insert(constant.name.to_string()) {
            decl.consts.push(constant);
        }
    }
    for block in inner.params {
        let mut param = match block {
            Block::One(param) => param,
            block => {
                let mut blocks = vec![block];
                r.blocks(&mut blocks, &mut |r, param| {
                    r.key(&mut param.key);
                    r.expr(&mut param.default);
                });
                let mut first = String::new();
                blocks[0].each(&mut |param| first = param.key.name.to_string());
                if common.insert(first) {
                    decl.params.extend(blocks);
                }
                continue;
            }
        };
        let name = param.key.name.to_string();
        r.key(&mut param.key);
        r.expr(&mut param.default);
        if fixed.contains(&name) {
            let given = member.part.given.iter().find(|(n, _)| *n == name);
            let value = given.map_or(&param.default, |(_, value)| value).clone();
            let sizes = std::mem::take(&mut param.key.indices);
            let binding = Let {
                key: param.key,
                given: Some(sizes),
                value: LetValue::Value(value),
            };
            // The sizes are the part's, the value that of the loops around.
            lets.push(bound(binding, &member.variables, span));
        } else if common.insert(param.key.name.to_string()) {
            decl.params.push(Block::One(param));
        }
    }
    r.blocks(&mut inner.lets, &mut |r, binding| {
        r.key(&mut binding.key);
        match &mut binding.value {
            LetValue::Value(value) => r.expr(value),
            LetValue::Function(function) => {
                let args = function.args.iter().map(Ident::to_string);
                r.hidden.extend(args);
                r.expr(&mut function.body);
                r.hidden.clear();
            }
        }
        if let Some(sizes) = &mut binding.given {
            sizes.iter_mut().for_each(|size| r.expr(size));
        }
    });
    lets.extend(inner.lets);
    r.blocks(&mut inner.coords, &mut |r, coord| r.key(&mut coord.key));
    decl.coords.extend(inner.coords);
    r.blocks(&mut inner.bodies, &mut |r, body| {
        r.key(&mut body.key);
        let consists = [&mut body.mass, &mut body.inertia, &mut body.centre];
        consists.into_iter().flatten().for_each(|e| r.expr(e));
    });
    decl.bodies.extend(inner.bodies);
    r.blocks(&mut inner.tree, &mut |r, joint| {
        r.key(&mut joint.key);
        r.expr(&mut joint.value);
    });
    decl.tree.extend(inner.tree);
    let pairs = [
        (&mut decl.kinetic, inner.kinetic),
        (&mut decl.potential, inner.potential),
        (&mut decl.dissipation, inner.dissipation),
    ];
    for (to, from) in pairs {
        section(to, from, r, &mut |r, e| r.expr(e));
    }
    section(&mut decl.mass, inner.mass, r, &mut |r, entry| {
        r.key(&mut entry.key);
        entry.other.iter_mut().for_each(|key| r.key(key));
        r.expr(&mut entry.value);
    });
    section(&mut decl.nonideal, inner.nonideal, r, &mut |r, entry| {
        r.key(&mut entry.key);
        r.expr(&mut entry.value);
    });
    r.blocks(&mut inner.force, &mut |r, entry| {
        r.key(&mut entry.key);
        r.expr(&mut entry.value);
    });
    decl.force.extend(inner.force);
    r.blocks(&mut inner.forces, &mut |r, e| r.expr(e));
    decl.forces.extend(inner.forces);
    for (to, mut from) in [
        (&mut decl.holonomic, inner.holonomic),
        (&mut decl.nonholonomic, inner.nonholonomic),
    ] {
        r.blocks(&mut from, &mut |r, equation| {
            r.result(&mut equation.key, &prefix);
            r.expr(&mut equation.lhs);
            equation.rhs.iter_mut().for_each(|e| r.expr(e));
        });
        to.extend(from);
    }
    r.blocks(&mut inner.outputs, &mut |r, output| {
        r.result(&mut output.key, &prefix);
        r.expr(&mut output.value);
    });
    decl.outputs.extend(inner.outputs);
    if let Some(name) = &r.clash {
        let kind = &member.part.name;
        let message = format!(
            "this declares `{name}`, which `{kind}` uses with the meaning that it has everywhere; rename it"
        );
        diag.error(member.part.name.span(), message);
    }
}

/// Adds the entries of a part's section to the section of the whole.
fn section<T>(
    to: &mut Option<Section<T>>,
    from: Option<Section<T>>,
    r: &mut Renaming<'_>,
    each: &mut dyn FnMut(&mut Renaming<'_>, &mut T),
) {
    let Some(mut from) = from else {
        return;
    };
    r.blocks(&mut from.blocks, each);
    let keyword = Ident::new(&from.keyword.to_string(), r.span);
    let section = to.get_or_insert(Section {
        keyword,
        blocks: Vec::new(),
    });
    section.blocks.extend(from.blocks);
}

/// `binding` where the loop variables have these values.
fn bound(binding: Let, variables: &[Variable], span: Span) -> Block<Let> {
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
fn uses(e: &Expr, names: &HashSet<String>) -> bool {
    let mut found = false;
    e.names(&mut |name| found |= names.contains(&name.to_string()));
    found
}

/// Names of a part that become those of the whole, at the place where the part is declared.
struct Renaming<'d> {
    names: HashMap<String, String>,
    /// Arguments of the functions around.
    hidden: Vec<String>,
    /// What the whole declares by `let`, and the ground if it declares one: names of the vocabulary that the part means otherwise.
    own: &'d HashSet<String>,
    /// One of these that the part uses.
    clash: Option<String>,
    span: Span,
}

impl Renaming<'_> {
    fn name(&mut self, name: &mut Ident) {
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

    fn key(&mut self, key: &mut Key) {
        self.name(&mut key.name);
        self.exprs(&mut key.indices);
        for (name, indices) in &mut key.fields {
            name.set_span(self.span);
            self.exprs(indices);
        }
        key.loc = self.span.into();
    }

    /// The name of a constraint or an output.
    fn result(&mut self, key: &mut Key, prefix: &str) {
        let text = format!("{prefix}_{}", key.name);
        self.key(key);
        key.name = Ident::new(&text, self.span);
    }

    fn exprs(&mut self, list: &mut [Expr]) {
        list.iter_mut().for_each(|e| self.expr(e));
    }

    fn expr(&mut self, e: &mut Expr) {
        e.loc = self.span.into();
        match &mut e.kind {
            ExprKind::Int(_) | ExprKind::Float(_) | ExprKind::Error => {}
            ExprKind::Name(name) => self.name(name),
            ExprKind::Index(base, indices) => {
                self.expr(base);
                self.exprs(indices);
            }
            ExprKind::Field(base, name) => {
                self.expr(base);
                name.set_span(self.span);
            }
            ExprKind::Neg(inner) | ExprKind::Group(inner) => self.expr(inner),
            ExprKind::Chain(first, rest) => {
                self.expr(first);
                rest.iter_mut().for_each(|(_, operand)| self.expr(operand));
            }
            ExprKind::Call(name, args) => {
                // Arguments hide values, not functions.
                let hidden = std::mem::take(&mut self.hidden);
                self.name(name);
                self.hidden = hidden;
                self.exprs(args);
            }
            ExprKind::Vector(components) => self.exprs(components),
            ExprKind::Sum { var, range, body } => {
                self.range(range);
                var.set_span(self.span);
                self.hidden.push(var.to_string());
                self.expr(body);
                self.hidden.pop();
            }
        }
    }

    fn range(&mut self, range: &mut Range) {
        self.expr(&mut range.from);
        self.expr(&mut range.to);
    }

    fn blocks<T>(&mut self, blocks: &mut [Block<T>], each: &mut dyn FnMut(&mut Self, &mut T)) {
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
