//! Declarations within declarations: what stands in a part is taken into the whole, under names of its own, once for each of its members.

use super::renaming::{Renaming, bound, uses};
use super::resolve::bare;
use super::types::{Model, Variable, every};
use crate::diag::{Diagnostics, suggest};
use crate::parse::{
    Applied, Block, Declaration, Entry, Equation, Given, Key, Let, LetValue, PartUse, Table, parse,
};
use proc_macro2::Ident;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;
use ukalgebra::expr::indexed;

/// More members of parts would keep the compiler busy.
const MOST: usize = 1_000;

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
    let members = members(&parts, &bare(decl, &quiet), diag);
    let inside = Diagnostics::default();
    let mut kinds: HashMap<String, String> = HashMap::new();
    let mut whole = Whole {
        own: Rc::new(own(decl)),
        common: HashSet::new(),
        lets: Vec::new(),
        decl,
    };
    for member in &members {
        if let Err(reason) = whole.enter(member, &mut kinds) {
            diag.error(member.part.key.loc, reason);
            continue;
        }
        let Some(known) = table.find(&member.part.path) else {
            continue;
        };
        if !known.is_part {
            let message = format!(
                "`{0}` is no part; write `#[ukcore(part)]` before `{0}` where it is declared",
                member.part.name
            );
            diag.error(member.part.name.span(), message);
            break;
        }
        whole.decl.merged.faulty |= known.faulty;
        let Some(mut inner) = parse(known.declaration.clone(), &inside) else {
            continue;
        };
        merge(&mut inner, &Table::parse(known.parts.clone()), &inside);
        whole.decl.merged.faulty |= inner.merged.faulty;
        let (name, before) = (&member.part.name, diag.len());
        let weighs = |decl: &Declaration| decl.sections.contains_key("gravity");
        if weighs(&inner) && !weighs(whole.decl) {
            let message = format!(
                "`{name}` has `gravity`, and this declaration, of which it is a part, has none; give it, for all bodies"
            );
            diag.error(name.span(), message);
        }
        known_parameters(&member.part, &inner, diag);
        if diag.len() == before {
            whole.take(inner, member, diag);
        }
        // What is wrong with one is wrong with all.
        if diag.len() > before {
            break;
        }
    }
    if let Some(member) = members.first()
        && !inside.is_empty()
        && !whole.decl.merged.faulty
    {
        let message = format!("`{}`, or another part, is in error", member.part.name);
        diag.damage(member.part.name.span(), message);
    }
    let Whole { decl, lets, .. } = whole;
    let at = decl.before_parts.min(decl.lets.len());
    decl.lets.splice(at..at, lets);
}

/// The members of all parts, in their order.
fn members(parts: &[Block<PartUse>], model: &Model, diag: &Diagnostics) -> Vec<Member> {
    let mut members: Vec<Member> = Vec::new();
    for block in parts {
        let looped = matches!(block, Block::For { .. });
        super::Scope::new(model).unroll(std::slice::from_ref(block), diag, &mut |part, scope| {
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
            let all = every(&shape).map(|indices| match looped {
                true => numbers.clone(),
                false => indices
                    .iter()
                    .filter_map(|i| i64::try_from(*i).ok())
                    .collect(),
            });
            for indices in all {
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
    members
}

/// What `decl` declares by `let`, and the ground if it declares one: these may have names of the vocabulary, which parts mean otherwise.
fn own(decl: &Declaration) -> HashSet<String> {
    let (mut own, mut declared) = (HashSet::new(), Vec::new());
    names(&decl.params, |param| &param.key, &mut declared);
    names(&decl.coords, |coord| &coord.key, &mut declared);
    names(&decl.bodies, |body| &body.key, &mut declared);
    own.extend(declared.into_iter().filter(|name| name == "ground"));
    decl.lets
        .iter()
        .for_each(|block| block.each(&mut |binding| own.extend([binding.key.name.to_string()])));
    own
}

/// Adds the names of the `key`s of all entries.
fn names<T>(blocks: &[Block<T>], key: impl Fn(&T) -> &Key, out: &mut Vec<String>) {
    for block in blocks {
        block.each(&mut |entry| out.push(key(entry).name.to_string()));
    }
}

/// A declaration that parts are taken into.
struct Whole<'w> {
    decl: &'w mut Declaration,
    /// Names that parts may mean otherwise.
    own: Rc<HashSet<String>>,
    /// What all members of a part have together and is there already.
    common: HashSet<String>,
    /// What is declared by `let` in parts, or given to them.
    lets: Vec<Block<Let>>,
}

impl Member {
    /// What names in it begin with.
    fn prefix(&self) -> String {
        let base = self.part.key.name.to_string();
        self.indices
            .iter()
            .fold(base, |name, i| format!("{name}_{i}"))
    }

    /// The names of parameters of `inner`, which it is, that are given, or follow those that are.
    fn fixed(&self, inner: &Declaration) -> HashSet<String> {
        let given = self.part.given.iter();
        let mut fixed: HashSet<String> = given.map(|(name, _)| name.to_string()).collect();
        for block in &inner.params {
            block.each(&mut |param| {
                if uses(&param.value, &fixed) {
                    fixed.insert(param.key.name.to_string());
                }
            });
        }
        fixed
    }
}

impl Whole<'_> {
    /// Enters the name of a member; the reason if it is taken. `kinds` are the declarations that parts so far are.
    fn enter(
        &mut self,
        member: &Member,
        kinds: &mut HashMap<String, String>,
    ) -> Result<(), String> {
        let base = member.part.key.name.to_string();
        let path: String = member.part.path.to_string().split_whitespace().collect();
        let families = self.decl.merged.families.entry(base.clone()).or_default();
        let other_length = |other: &Vec<i64>| other.len() != member.indices.len();
        match kinds.get(&base) {
            Some(kind) if *kind != path => {
                return Err(format!(
                    "`{base}` is declared as `{kind}` and as `{path}`; rename one"
                ));
            }
            Some(_) if families.contains(&member.indices) => {
                let name = indexed(&base, &member.indices);
                return Err(format!("`{name}` is declared twice; names must be unique"));
            }
            Some(_) if families.iter().any(other_length) => {
                return Err(format!(
                    "`{base}` is declared with different numbers of indices; rename one"
                ));
            }
            _ => {}
        }
        families.push(member.indices.clone());
        kinds.insert(base, path);
        Ok(())
    }

    /// Takes the part `inner` in as this member.
    fn take(&mut self, mut inner: Declaration, member: &Member, diag: &Diagnostics) {
        self.decl.units |= inner.units;
        let fixed = member.fixed(&inner);
        let names = self.names(&inner, member, &fixed);
        let mut constraints = Vec::new();
        self::names(&inner.holonomic, |c| &c.key, &mut constraints);
        self::names(&inner.nonholonomic, |c| &c.key, &mut constraints);
        let prefix = member.prefix();
        let constraints = constraints.into_iter().map(|name| {
            let full = format!("{prefix}_{name}");
            (name, full)
        });
        let mut renaming = Renaming {
            names,
            constraints: constraints.collect(),
            parts: inner.merged.families.keys().cloned().collect(),
            hidden: Vec::new(),
            own: self.own.clone(),
            clash: None,
            span: member.part.key.name.span(),
        };
        self.values(&mut inner, member, &fixed, &mut renaming);
        self.sections(inner, &prefix, &mut renaming);
        if let Some(name) = &renaming.clash {
            let kind = &member.part.name;
            let message = format!(
                "this declares `{name}`, which `{kind}` uses with the meaning that it has everywhere; rename it"
            );
            diag.error(kind.span(), message);
        }
    }

    /// What names in `inner` become.
    fn names(
        &mut self,
        inner: &Declaration,
        member: &Member,
        fixed: &HashSet<String>,
    ) -> HashMap<String, String> {
        let (base, prefix) = (member.part.key.name.to_string(), member.prefix());
        let shown = indexed(&base, &member.indices);
        let merged = &mut self.decl.merged;
        let mut enter = |name: &str, shared: bool| {
            let own = inner.merged.shown.get(name).map_or(name, String::as_str);
            let (full, text) = match shared {
                true => (format!("{base}_{name}"), format!("{base}.{own}")),
                false => (format!("{prefix}_{name}"), format!("{shown}.{own}")),
            };
            merged.shown.insert(full.clone(), text);
            full
        };
        // Constraints and outputs have names of their own.
        let mut results = Vec::new();
        names(&inner.holonomic, |c| &c.key, &mut results);
        names(&inner.nonholonomic, |c| &c.key, &mut results);
        names(&inner.outputs, |output| &output.key, &mut results);
        names(&inner.integrals, |integral| &integral.key, &mut results);
        results.iter().for_each(|name| drop(enter(name, false)));
        let mut params = Vec::new();
        names(&inner.params, |param| &param.key, &mut params);
        let mut others = Vec::new();
        names(&inner.coords, |coord| &coord.key, &mut others);
        names(&inner.bodies, |body| &body.key, &mut others);
        names(&inner.tree, |joint| &joint.key, &mut others);
        names(&inner.lets, |binding| &binding.key, &mut others);
        others.extend(inner.merged.families.keys().cloned());
        let consts = inner
            .consts
            .iter()
            .map(|constant| constant.name.to_string());
        let shared = consts.map(|name| (name, true));
        let params = params.into_iter().map(|name| {
            let shared = !fixed.contains(&name);
            (name, shared)
        });
        let all = shared
            .chain(params)
            .chain(others.into_iter().map(|name| (name, false)));
        let names = all.map(|(name, shared)| {
            let full = enter(&name, shared);
            (name, full)
        });
        let names = names.collect();
        for (name, indices) in &inner.merged.families {
            let name = format!("{prefix}_{name}");
            merged.families.insert(name, indices.clone());
        }
        merged
            .places
            .push((member.part.key.name.span().into(), shown));
        names
    }

    /// Takes constants and parameters: what is given as values.
    fn values(
        &mut self,
        inner: &mut Declaration,
        member: &Member,
        fixed: &HashSet<String>,
        r: &mut Renaming,
    ) {
        for mut constant in std::mem::take(&mut inner.consts) {
            r.name(&mut constant.name);
            r.expr(&mut constant.value);
            if self.common.insert(constant.name.to_string()) {
                self.decl.consts.push(constant);
            }
        }
        for block in std::mem::take(&mut inner.params) {
            let mut param = match block {
                Block::One(param) => param,
                block => {
                    let mut blocks = vec![block];
                    r.blocks(&mut blocks, &mut Renaming::entry);
                    let mut first = String::new();
                    blocks[0].each(&mut |param| first = param.key.name.to_string());
                    if self.common.insert(first) {
                        self.decl.params.extend(blocks);
                    }
                    continue;
                }
            };
            let name = param.key.name.to_string();
            r.entry(&mut param);
            if fixed.contains(&name) {
                let given = member.part.given.iter().find(|(n, _)| *n == name);
                let value = given.map_or(&param.value, |(_, value)| value).clone();
                let sizes = std::mem::take(&mut param.key.indices);
                let binding = Let {
                    key: param.key,
                    given: Some(Given {
                        sizes,
                        default: param.value,
                    }),
                    value: LetValue::Value(value),
                };
                // The sizes are the part's, the value that of the loops around.
                self.lets.push(bound(binding, &member.variables, r.span));
            } else if self.common.insert(param.key.name.to_string()) {
                self.decl.params.push(Block::One(param));
            }
        }
    }

    /// Takes all other sections.
    fn sections(&mut self, inner: Declaration, prefix: &str, r: &mut Renaming) {
        let whole = &mut *self.decl;
        for (name, keyword) in inner.sections {
            // What is drawn is the whole.
            if name != "draw" {
                let keyword = Ident::new(&keyword.to_string(), r.span);
                whole.sections.entry(name).or_insert(keyword);
            }
        }
        take(&mut self.lets, inner.lets, r, |r, binding| {
            r.key(&mut binding.key);
            match &mut binding.value {
                LetValue::Value(value) => r.expr(value),
                LetValue::Function(function) => r.function(function),
            }
            if let Some(Given { sizes, default }) = &mut binding.given {
                sizes.iter_mut().for_each(|size| r.expr(size));
                r.expr(default);
            }
        });
        take(&mut whole.coords, inner.coords, r, |r, coord| {
            r.key(&mut coord.key);
        });
        take(&mut whole.bodies, inner.bodies, r, |r, body| {
            r.key(&mut body.key);
            let consists = [&mut body.mass, &mut body.inertia, &mut body.centre];
            consists.into_iter().flatten().for_each(|e| r.expr(e));
        });
        take(&mut whole.tree, inner.tree, r, Renaming::entry);
        take(&mut whole.kinetic, inner.kinetic, r, Renaming::expr);
        take(&mut whole.potential, inner.potential, r, Renaming::expr);
        take(&mut whole.dissipation, inner.dissipation, r, Renaming::expr);
        take(&mut whole.mass, inner.mass, r, |r, entry| {
            r.key(&mut entry.key);
            entry.other.iter_mut().for_each(|key| r.key(key));
            r.expr(&mut entry.value);
        });
        take(
            &mut whole.nonideal,
            inner.nonideal,
            r,
            |r, applied| match applied {
                Applied::To(entry) => r.entry(entry),
                Applied::By(e) => r.expr(e),
            },
        );
        take(&mut whole.force, inner.force, r, Renaming::entry);
        take(&mut whole.forces, inner.forces, r, Renaming::expr);
        let equation = |r: &mut Renaming, equation: &mut Equation| {
            r.result(&mut equation.key, prefix);
            r.expr(&mut equation.lhs);
            equation.rhs.iter_mut().for_each(|e| r.expr(e));
        };
        take(&mut whole.holonomic, inner.holonomic, r, equation);
        take(&mut whole.nonholonomic, inner.nonholonomic, r, equation);
        let reported = |r: &mut Renaming, reported: &mut Entry| {
            r.result(&mut reported.key, prefix);
            r.expr(&mut reported.value);
        };
        take(&mut whole.outputs, inner.outputs, r, reported);
        take(&mut whole.integrals, inner.integrals, r, reported);
    }
}

/// Adds the entries of a part's section to those of the whole, each as it is there.
fn take<T>(
    to: &mut Vec<Block<T>>,
    mut from: Vec<Block<T>>,
    r: &mut Renaming,
    mut each: impl FnMut(&mut Renaming, &mut T),
) {
    r.blocks(&mut from, &mut each);
    to.extend(from);
}

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
